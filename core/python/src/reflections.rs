//! The light that rough surfaces reflect.

use crate::arrays::{Columns, Field, FieldKind, numbers, three, together, vector};
use crate::each::{Beside, Given};
use crate::results::{Object, array, map, run, zero_columns};
use crate::warps::Warp;
use etendue::reflection;
use etendue_batch::{Batch, ReflectedSphere};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

/// How many numbers a reflection consists of. The last two are the albedo and Schlick's weight.
const NUMBERS: usize = 16;

impl Beside for reflection::Reflection<f32> {
    fn one(reflection: &Object<'_>) -> PyResult<Self> {
        Ok(reflection.cast::<Reflection>()?.get().reflection)
    }
    fn fields<'a, 'py>(given: Given<'a, 'py>) -> PyResult<Vec<Field<'a, 'py>>> {
        let Given { n: Some(n), alpha: Some(alpha), view: Some(view), .. } = given else {
            let message =
                "by reflection, n, alpha and view are needed: normals, roughnesses and directions to the viewer";
            return Err(PyTypeError::new_err(message));
        };
        Ok(fields(alpha, n, view).into())
    }
    fn columns(py: Python<'_>, arguments: Columns) -> PyResult<Columns> {
        let (alpha, n, view) = (&arguments[0], vector(&arguments[1..4]), vector(&arguments[4..]));
        let mut columns = zero_columns(NUMBERS, alpha.len())?;
        run(py, alpha.len(), || {
            let mut to = columns.iter_mut();
            let out = Self::default().map(|_| to.next().map_or(&mut [][..], Vec::as_mut_slice));
            Batch::new().reflections(alpha, n, view, out);
        });
        Ok(columns)
    }
}
/// The arguments of which reflections are made.
fn fields<'a, 'py>(alpha: &'a Object<'py>, n: &'a Object<'py>, view: &'a Object<'py>) -> [Field<'a, 'py>; 3] {
    [("alpha", FieldKind::Number, alpha), ("n", FieldKind::Normal, n), ("view", FieldKind::Normal, view)]
}

/// The lobe of a GGX surface of the same roughness in all directions, seen from one direction, as a cosine after a linear map of directions, which
/// keeps the horizon: (2) to (3), the pdf of the fit per steradian, 0 below the horizon. Flat lights are prepared for it `by_reflection`, with
/// nearly no variance on an unoccluded glossy surface.
///
/// `alpha` is the roughness, taken to be from 3e-4 to 1, `n` (3) the unit normal of the surface and `view` (3) the unit vector towards the viewer.
/// A view below the horizon counts as one on the horizon, and has albedo 0.
#[pyclass(module = "etendue", extends = Warp, frozen)]
pub(crate) struct Reflection {
    pub(crate) reflection: reflection::Reflection<f32>,
}

#[pymethods]
impl Reflection {
    #[new]
    fn new(alpha: &Object<'_>, n: &Object<'_>, view: &Object<'_>) -> PyResult<PyClassInitializer<Self>> {
        let x = numbers(&fields(alpha, n, view))?;
        let reflection = reflection::Reflection::new(x[0], three(&x[1..]), three(&x[4..]));
        Ok(PyClassInitializer::from(Warp { map: Box::new(reflection) }).add_subclass(Self { reflection }))
    }
    /// The part of light from all directions alike that the surface reflects with a Fresnel factor of 1, in [0, 1].
    #[getter]
    fn albedo(&self) -> f32 {
        self.reflection.albedo()
    }
    /// The mean of Schlick's weight (1 − v·m)⁵ over the lobe, in [0, 1]: with the reflectance F₀ at normal incidence, the surface reflects about
    /// albedo · (F₀ + (1 − F₀) · this) of light from all directions alike.
    #[getter]
    fn schlick(&self) -> f32 {
        self.reflection.schlick()
    }
    /// The projected solid angles after the map, in [0, π], of the parts above the horizon of spheres with the centres center (..., 3) relative
    /// to the shading point and the radii radius (...): about π times the part of the lobe that a sphere covers. A radius ≤ 0 gives 0, and a point
    /// inside π.
    fn sphere<'py>(&self, py: Python<'py>, center: &Object<'py>, radius: &Object<'py>) -> PyResult<Object<'py>> {
        let (shape, columns) =
            together(&[("center", FieldKind::Row(3), center), ("radius", FieldKind::Number, radius)])?;
        array(py, &shape, map(py, &ReflectedSphere(self.reflection), &columns)?.0.remove(0))
    }
    /// The albedo and Schlick's weight of a reflection of its own for each row: arrays of the shape (...) to which roughnesses alpha (...), normals
    /// n (..., 3) and views view (..., 3) are broadcast.
    #[staticmethod]
    fn albedo_and_schlick_each<'py>(
        py: Python<'py>,
        alpha: &Object<'py>,
        n: &Object<'py>,
        view: &Object<'py>,
    ) -> PyResult<(Object<'py>, Object<'py>)> {
        let (shape, arguments) = together(&fields(alpha, n, view))?;
        let mut columns = reflection::Reflection::columns(py, arguments)?;
        let [albedo, schlick] = [NUMBERS - 2, NUMBERS - 1].map(|k| core::mem::take(&mut columns[k]));
        Ok((array(py, &shape, albedo)?, array(py, &shape, schlick)?))
    }
    fn __repr__(&self) -> String {
        format!("<etendue.Reflection of albedo {}>", self.reflection.albedo())
    }
}

/// Adds reflections to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Reflection>()
}
