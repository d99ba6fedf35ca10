//! Lights prepared for a shading point, and their samples.

use crate::arrays::{Argument, FieldKind, array, rows, run, zero_columns, zeros};
use etendue::{Vec2, Vec3};
use etendue_batch::Batch;
use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;

/// A light prepared by any technique.
pub(crate) trait Prepared: Send + Sync {
    fn sample(&self, u: Vec2<&[f32]>, out: etendue_batch::Samples<'_>);
    fn hit(&self, w: Vec3<&[f32]>, out: etendue_batch::Samples<'_>);
    fn pdf(&self, w: Vec3<&[f32]>, out: &mut [f32]);
    fn invert(&self, w: Vec3<&[f32]>, out: Vec2<&mut [f32]>);
}
impl<T: etendue_batch::Prepared + Send + Sync> Prepared for T {
    fn sample(&self, u: Vec2<&[f32]>, out: etendue_batch::Samples<'_>) {
        Batch::new().sample(self, u, out);
    }
    fn hit(&self, w: Vec3<&[f32]>, out: etendue_batch::Samples<'_>) {
        Batch::new().hit(self, w, out);
    }
    fn pdf(&self, w: Vec3<&[f32]>, out: &mut [f32]) {
        Batch::new().pdf(self, w, out);
    }
    fn invert(&self, w: Vec3<&[f32]>, out: Vec2<&mut [f32]>) {
        Batch::new().invert(self, w, out);
    }
}

/// Three columns as a vector.
pub(crate) fn vector(columns: &[Vec<f32>]) -> Vec3<&[f32]> {
    Vec3::new(&columns[0], &columns[1], &columns[2])
}

/// Samples of a light, or the points of it that directions hit, in arrays of one shape (...).
///
/// The estimator of reflected radiance is f · L · cosθ · weight, where nothing is in the way from the shading point along `direction` up
/// to `distance`. The weight is 0 where there is no sample and where the light does not emit towards the point.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct Samples {
    /// Unit directions from the shading point to the light, (..., 3).
    #[pyo3(get)]
    direction: Py<PyAny>,
    /// Distances to the light along them, in the unit of the coordinates; the largest float32 for suns.
    #[pyo3(get)]
    distance: Py<PyAny>,
    /// Probability densities of the directions, per steradian (lines: see `Line`); 0 where there is no sample.
    #[pyo3(get)]
    pdf: Py<PyAny>,
    /// 1/pdf where there is a sample and the light emits towards the shading point, else 0.
    #[pyo3(get)]
    weight: Py<PyAny>,
    /// Unit normals of the light, (..., 3).
    #[pyo3(get)]
    normal: Py<PyAny>,
    /// Surface coordinates in [0, 1]², (..., 2).
    #[pyo3(get)]
    uv: Py<PyAny>,
    /// Whether the shading point is on the side of the light that emits: bool.
    #[pyo3(get)]
    emits: Py<PyAny>,
}

#[pymethods]
impl Samples {
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<etendue.Samples of shape {}>", self.pdf.bind(py).getattr("shape")?))
    }
}

impl Samples {
    /// The samples that `batch` writes, one for each element of `shape`.
    pub(crate) fn of(
        py: Python<'_>,
        shape: Vec<usize>,
        batch: impl FnOnce(etendue_batch::Samples<'_>) + Send,
    ) -> PyResult<Self> {
        let n = shape.iter().product();
        let mut columns = zero_columns::<11>(n)?;
        let mut emits = zeros::<u8>(n)?;
        run(py, n, || {
            let [x, y, z, distance, pdf, weight, nx, ny, nz, u, v] = columns.each_mut().map(Vec::as_mut_slice);
            let (direction, normal, uv) = ([x, y, z], [nx, ny, nz], [u, v]);
            batch(etendue_batch::Samples { direction, distance, pdf, weight, normal, uv, emits: &mut emits });
        });
        let direction = rows(py, &shape, &columns[..3])?.unbind();
        let normal = rows(py, &shape, &columns[6..9])?.unbind();
        let uv = rows(py, &shape, &columns[9..])?.unbind();
        let [_, _, _, distance, pdf, weight, ..] = columns;
        let [distance, pdf, weight] = [distance, pdf, weight].map(|column| array(py, &shape, column));
        let emits = array(py, &shape, emits.into_iter().map(|emits| emits != 0).collect())?.unbind();
        let (distance, pdf, weight) = (distance?.unbind(), pdf?.unbind(), weight?.unbind());
        Ok(Self { direction, distance, pdf, weight, normal, uv, emits })
    }
}

/// A light prepared for one shading point by one technique: `light.by_…` makes it, and it draws as often as needed.
///
/// What is easily done wrong: directions and normals that are not of length 1 raise ValueError. With the opposite normal, a light by
/// projected solid angle is below the surface, and has pdf 0. A light seen from behind has a pdf, but `emits` is False and the weight 0;
/// one of two sides has the weight 1/pdf. From a point on a flat light the pdf is 0; from one on a curved light rounding decides whether
/// it is inside. A direction computed anew from the point of a sample has other last bits, and may miss beside an edge: keep the
/// `direction` and the `pdf` of the sample.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct Sampler {
    prepared: Box<dyn Prepared>,
    technique: &'static str,
    /// The size of the light in the measure of the technique, and the name of that measure.
    measure: Option<(&'static str, f32)>,
}

impl Sampler {
    pub(crate) fn new(
        prepared: Box<dyn Prepared>,
        technique: &'static str,
        measure: Option<(&'static str, f32)>,
    ) -> Self {
        Self { prepared, technique, measure }
    }
    fn measure(&self, name: &str) -> PyResult<f32> {
        let found = self.measure.filter(|measure| measure.0 == name).map(|measure| measure.1);
        found.ok_or_else(|| PyAttributeError::new_err(format!("a sampler {} has no {name}", self.technique)))
    }
}

#[pymethods]
impl Sampler {
    /// Draws directions to the light for numbers u in [0, 1)², (..., 2). Lines use the first number alone.
    fn sample(&self, py: Python<'_>, u: &Bound<'_, PyAny>) -> PyResult<Samples> {
        let u = Argument::new("u", FieldKind::Units, u)?;
        let columns = u.columns(&u.shape)?;
        Samples::of(py, u.shape, |out| self.prepared.sample(Vec2::new(&columns[0], &columns[1]), out))
    }
    /// The points of the light that unit directions w hit, (..., 3), with the pdf with which `sample` draws them; the pdf is 0 where a
    /// direction misses the light.
    fn hit(&self, py: Python<'_>, w: &Bound<'_, PyAny>) -> PyResult<Samples> {
        let w = Argument::new("w", FieldKind::Direction, w)?;
        let columns = w.columns(&w.shape)?;
        Samples::of(py, w.shape, |out| self.prepared.hit(vector(&columns), out))
    }
    /// The probability density per steradian with which `sample` draws unit directions w, (..., 3); 0 where they miss the light.
    fn pdf<'py>(&self, py: Python<'py>, w: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let w = Argument::new("w", FieldKind::Direction, w)?;
        let columns = w.columns(&w.shape)?;
        let mut out = zeros(columns[0].len())?;
        run(py, out.len(), || self.prepared.pdf(vector(&columns), &mut out));
        array(py, &w.shape, out)
    }
    /// The numbers u in [0, 1)² that `sample` maps to unit directions w, (..., 3); any numbers where they miss the light.
    fn invert<'py>(&self, py: Python<'py>, w: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let w = Argument::new("w", FieldKind::Direction, w)?;
        let columns = w.columns(&w.shape)?;
        let mut out = zero_columns::<2>(columns[0].len())?;
        run(py, columns[0].len(), || {
            let [x, y] = &mut out;
            self.prepared.invert(vector(&columns), Vec2::new(x, y));
        });
        rows(py, &w.shape, &out)
    }
    /// Surface area of the light, in the square of the unit of the coordinates; of samplers by area.
    #[getter]
    fn area(&self) -> PyResult<f32> {
        self.measure("area")
    }
    /// Solid angle of the light in steradians; of samplers by solid angle and by cosine warp.
    #[getter]
    fn solid_angle(&self) -> PyResult<f32> {
        self.measure("solid_angle")
    }
    /// Projected solid angle of the light above the horizon, in [0, π]: the irradiance per unit of radiance; of samplers by projected
    /// solid angle, except lines. Of samplers by reflection, that after the map: π times the part of the lobe that the light covers.
    #[getter]
    fn projected_solid_angle(&self) -> PyResult<f32> {
        self.measure("projected_solid_angle")
    }
    /// The angle that a line subtends, in radians; of samplers by angle.
    #[getter]
    fn angle(&self) -> PyResult<f32> {
        self.measure("angle")
    }
    fn __repr__(&self) -> String {
        format!("<etendue.Sampler: {}>", self.technique)
    }
}

/// A point p, or a normal n.
pub(crate) fn single(name: &'static str, object: &Bound<'_, PyAny>) -> PyResult<Vec3<f32>> {
    let kind = if name == "n" { FieldKind::Direction } else { FieldKind::Row(3) };
    let columns = Argument::single(name, kind, object)?.columns(&[])?;
    Ok(Vec3::new(columns[0][0], columns[1][0], columns[2][0]))
}

/// Adds samplers to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Samples>()?;
    module.add_class::<Sampler>()
}
