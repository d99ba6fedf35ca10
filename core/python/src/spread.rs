//! Flat lights that emit within an angle of their normal.

use crate::arrays::{Columns, Field, FieldKind, point, together};
use crate::each::{Beside, Given};
use crate::lights;
use crate::results::{Object, array, map};
use etendue::light::{self, FlatLight};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// How a flat light emits within a cone about its normal, as through a honeycomb before it: the spread of Cycles. `angle` is the full angle in
/// radians, taken to be from 1e-3 to π.
///
/// A host multiplies the radiance of the light by `attenuation`, which leaves its power as it is. A point sees only a disk of the plane of the
/// light, which `by_spread` of the lights samples.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct Spread {
    spread: light::Spread<f32>,
    angle: f64,
}

impl Beside for light::Spread<f32> {
    fn one(spread: &Object<'_>) -> PyResult<Self> {
        Ok(spread.cast::<Spread>()?.get().spread)
    }
    fn fields<'a, 'py>(given: Given<'a, 'py>) -> PyResult<Vec<Field<'a, 'py>>> {
        let wrong = || PyTypeError::new_err("by spread, spread is needed: full angles in radians");
        Ok(vec![("spread", FieldKind::Number, given.spread.ok_or_else(wrong)?)])
    }
    fn columns(_: Python<'_>, angles: Columns) -> PyResult<Columns> {
        let spreads = angles[0].iter().map(|&angle| Self::new(f64::from(angle)));
        let (tan_half, gain) = spreads.map(|spread| (spread.tan_half, spread.gain)).unzip();
        Ok(vec![tan_half, gain])
    }
}

#[pymethods]
impl Spread {
    #[new]
    fn new(angle: f64) -> PyResult<Self> {
        if angle.is_nan() {
            return Err(PyValueError::new_err("angle must be a number, not NaN"));
        }
        Ok(Self { spread: light::Spread::new(angle), angle })
    }
    /// The factor of the radiance in or against unit directions w (..., 3) of lights with the unit normals n (..., 3), on either side:
    /// (tanσ − tanθ)/(tanσ − σ) at the angle θ < σ to the normal, with σ half of the spread; 0 beyond.
    fn attenuation<'py>(&self, py: Python<'py>, w: &Object<'py>, n: &Object<'py>) -> PyResult<Object<'py>> {
        let (shape, columns) = together(&[("w", FieldKind::Direction, w), ("n", FieldKind::Normal, n)])?;
        array(py, &shape, map(py, &self.spread, &columns)?.0.remove(0))
    }
    /// The part of a Parallelogram or Rectangle with this spread that the point p (3) sees: the smallest parallelogram with edges along its own
    /// about what of its plane is within the angle. It is without area where the point sees nothing.
    fn visible_part(&self, light: &Object<'_>, p: &Object<'_>) -> PyResult<lights::Parallelogram> {
        let light = if let Ok(light) = light.cast::<lights::Parallelogram>() {
            lights::Parallelogram::build(&light.get().numbers)
        } else if let Ok(light) = light.cast::<lights::Rectangle>() {
            lights::Rectangle::build(&light.get().numbers).coordinates()
        } else {
            let message = format!("light must be a Parallelogram or Rectangle, not {}", light.get_type().name()?);
            return Err(PyTypeError::new_err(message));
        };
        let part = light.visible_part(point(p)?, &self.spread);
        Ok(lights::Parallelogram { numbers: [part.corner, part.edge_s, part.edge_t].map(|v| [v.x, v.y, v.z]).concat() })
    }
    fn __repr__(&self) -> String {
        format!("<etendue.Spread {}>", self.angle)
    }
}

/// Adds the spread to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Spread>()
}
