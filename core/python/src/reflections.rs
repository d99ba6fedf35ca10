//! The light that rough surfaces reflect.

use crate::arrays::{Argument, FieldKind, broadcast};
use crate::results::{array, map, run, zeros};
use crate::samplers::{single, vector};
use crate::warps::Warp;
use etendue::reflection;
use etendue_batch::{Batch, ReflectedSphere};
use pyo3::prelude::*;

/// How many numbers a reflection consists of. The last two are the albedo and Schlick's weight.
pub(crate) const NUMBERS: usize = 16;

/// A reflection of its numbers in their order, or of columns of them.
pub(crate) fn build<X: Copy>(numbers: &[X]) -> reflection::Reflection<X> {
    let mut numbers = numbers.iter();
    reflection::Reflection::<f32>::default().map(|_| *numbers.next().expect("a reflection has so many numbers"))
}

/// The numbers of reflections in columns.
pub(crate) fn reflections(py: Python<'_>, alpha: &[f32], n: &[Vec<f32>], view: &[Vec<f32>]) -> PyResult<Vec<Vec<f32>>> {
    let mut columns = Vec::with_capacity(NUMBERS);
    for _ in 0..NUMBERS {
        columns.push(zeros(alpha.len())?);
    }
    run(py, alpha.len(), || {
        let mut to = columns.iter_mut();
        let out = reflection::Reflection::<f32>::default().map(|_| to.next().map_or(&mut [][..], Vec::as_mut_slice));
        Batch::new().reflections(alpha, vector(n), vector(view), out);
    });
    Ok(columns)
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
    fn new(
        alpha: &Bound<'_, PyAny>,
        n: &Bound<'_, PyAny>,
        view: &Bound<'_, PyAny>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let alpha = Argument::single("alpha", FieldKind::Number, alpha)?.columns(&[])?[0][0];
        let view = Argument::single("view", FieldKind::Normal, view)?.columns(&[])?;
        let view = etendue::Vec3::new(view[0][0], view[1][0], view[2][0]);
        let reflection = reflection::Reflection::new(alpha, single("n", n)?, view);
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
    fn sphere<'py>(
        &self,
        py: Python<'py>,
        center: &Bound<'py, PyAny>,
        radius: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let center = Argument::new("center", FieldKind::Row(3), center)?;
        let radius = Argument::new("radius", FieldKind::Number, radius)?;
        let shape = broadcast(py, &[&center, &radius])?;
        let mut columns = center.columns(&shape)?;
        columns.extend(radius.columns(&shape)?);
        array(py, &shape, map(py, &ReflectedSphere(self.reflection), &columns)?.0.remove(0))
    }
    /// The albedo and Schlick's weight of a reflection of its own for each row: arrays of the shape (...) to which roughnesses alpha (...), normals
    /// n (..., 3) and views view (..., 3) are broadcast.
    #[staticmethod]
    fn albedo_and_schlick_each<'py>(
        py: Python<'py>,
        alpha: &Bound<'py, PyAny>,
        n: &Bound<'py, PyAny>,
        view: &Bound<'py, PyAny>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let alpha = Argument::new("alpha", FieldKind::Number, alpha)?;
        let (n, view) = (Argument::new("n", FieldKind::Normal, n)?, Argument::new("view", FieldKind::Normal, view)?);
        let shape = broadcast(py, &[&alpha, &n, &view])?;
        let mut numbers = reflections(py, &alpha.columns(&shape)?[0], &n.columns(&shape)?, &view.columns(&shape)?)?;
        let [albedo, schlick] = [NUMBERS - 2, NUMBERS - 1].map(|k| core::mem::take(&mut numbers[k]));
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
