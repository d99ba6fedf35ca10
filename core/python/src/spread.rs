//! Flat lights that emit within an angle of their normal.

use crate::arrays::{Argument, FieldKind, broadcast};
use crate::lights;
use crate::results::{array, map};
use crate::samplers::single;
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
    pub(crate) spread: light::Spread<f32>,
    angle: f64,
}

fn wrong(light: &Bound<'_, PyAny>, kinds: &str) -> PyErr {
    match light.get_type().name() {
        Ok(name) => PyTypeError::new_err(format!("light must be a {kinds}, not {name}")),
        Err(e) => e,
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
    fn attenuation<'py>(
        &self,
        py: Python<'py>,
        w: &Bound<'py, PyAny>,
        n: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (w, n) = (Argument::new("w", FieldKind::Direction, w)?, Argument::new("n", FieldKind::Normal, n)?);
        let shape = broadcast(py, &[&w, &n])?;
        let mut columns = w.columns(&shape)?;
        columns.extend(n.columns(&shape)?);
        array(py, &shape, map(py, &self.spread, &columns)?.0.remove(0))
    }
    /// The part of a Parallelogram or Rectangle with this spread that the point p (3) sees: the smallest parallelogram with edges along its own
    /// about what of its plane is within the angle. It is without area where the point sees nothing.
    fn visible_part(&self, light: &Bound<'_, PyAny>, p: &Bound<'_, PyAny>) -> PyResult<lights::Parallelogram> {
        let light = if let Ok(light) = light.cast::<lights::Parallelogram>() {
            lights::Parallelogram::build(&light.get().numbers)
        } else if let Ok(light) = light.cast::<lights::Rectangle>() {
            lights::Rectangle::build(&light.get().numbers).coordinates()
        } else {
            return Err(wrong(light, "Parallelogram or Rectangle"));
        };
        let part = light.visible_part(single("p", p)?, &self.spread);
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
