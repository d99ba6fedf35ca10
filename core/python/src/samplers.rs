//! Lights prepared for a shading point.

use crate::arrays::{Argument, FieldKind};
use crate::results::{Target, fill_rows, given_or_new, run};
use crate::samples::{Samples, Wanted};
use etendue::{LightSampler, Vec2, Vec3};
use etendue_batch::Batch;
use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;
use std::ops::Range;

/// A light prepared by any technique.
pub(crate) trait Prepared: Send + Sync {
    fn sample(&self, u: Vec2<&[f32]>, out: etendue_batch::Samples<'_>);
    fn hit(&self, w: Vec3<&[f32]>, out: etendue_batch::Samples<'_>);
    fn pdf(&self, w: Vec3<&[f32]>, out: &mut [f32]);
    fn pdf_of_hit(&self, w: Vec3<&[f32]>, out: &mut [f32]);
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
    fn pdf_of_hit(&self, w: Vec3<&[f32]>, out: &mut [f32]) {
        pdf_of_hit(self, w, out);
    }
    fn invert(&self, w: Vec3<&[f32]>, out: Vec2<&mut [f32]>) {
        Batch::new().invert(self, w, out);
    }
}

/// The pdfs of directions that are known to hit: a few operations each, for which batches have no function.
pub(crate) fn pdf_of_hit<T: etendue_batch::Prepared>(sampler: &T, w: Vec3<&[f32]>, out: &mut [f32]) {
    sampler.over::<f32, _>(|light| {
        for (i, pdf) in out.iter_mut().enumerate() {
            *pdf = light.pdf_of_hit(w.map(|column| column[i]));
        }
    });
}

/// Three columns as a vector.
pub(crate) fn vector<C: AsRef<[f32]>>(columns: &[C]) -> Vec3<&[f32]> {
    Vec3::new(columns[0].as_ref(), columns[1].as_ref(), columns[2].as_ref())
}
/// The columns for a range of elements.
pub(crate) fn cut(columns: &[Vec<f32>], range: Range<usize>) -> Vec<&[f32]> {
    columns.iter().map(|column| &column[range.clone()]).collect()
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
    ///
    /// `fields` names what is wanted, as in ("direction", "weight"): the rest is not computed and takes no memory. `out` are samples of the
    /// same shape that are written over and returned, with the fields that they have.
    #[pyo3(signature = (u, *, fields=None, out=None))]
    fn sample<'py>(
        &self,
        py: Python<'py>,
        u: &Bound<'py, PyAny>,
        fields: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, Samples>> {
        let u = Argument::new("u", FieldKind::Units, u)?;
        let columns = u.columns(&u.shape)?;
        Samples::of(py, &u.shape, Wanted { fields, out }, |range, out| {
            self.prepared.sample(Vec2::new(&columns[0][range.clone()], &columns[1][range]), out);
        })
    }
    /// The points of the light that unit directions w hit, (..., 3), with the pdf with which `sample` draws them; the pdf is 0 where a
    /// direction misses the light. `fields` and `out` are those of `sample`.
    #[pyo3(signature = (w, *, fields=None, out=None))]
    fn hit<'py>(
        &self,
        py: Python<'py>,
        w: &Bound<'py, PyAny>,
        fields: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, Samples>> {
        let w = Argument::new("w", FieldKind::Direction, w)?;
        let columns = w.columns(&w.shape)?;
        Samples::of(py, &w.shape, Wanted { fields, out }, |range, out| {
            self.prepared.hit(vector(&cut(&columns, range)), out);
        })
    }
    /// The probability density per steradian with which `sample` draws unit directions w, (..., 3); 0 where they miss the light. It is
    /// written to the array `out` of float32, if there is one.
    #[pyo3(signature = (w, *, out=None))]
    fn pdf<'py>(
        &self,
        py: Python<'py>,
        w: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        pdfs(py, w, out, |w, out| self.prepared.pdf(w, out))
    }
    /// The same for unit directions w, (..., 3), that are known to hit the light, as where a ray of the host has hit it: the light is not
    /// intersected again, so that no rounding makes a direction beside an edge miss it. Where w misses, the result is finite, and of no
    /// meaning.
    #[pyo3(signature = (w, *, out=None))]
    fn pdf_of_hit<'py>(
        &self,
        py: Python<'py>,
        w: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        pdfs(py, w, out, |w, out| self.prepared.pdf_of_hit(w, out))
    }
    /// The numbers u in [0, 1)² that `sample` maps to unit directions w, (..., 3); any numbers where they miss the light. They are written
    /// to the array `out` of float32 and the shape (..., 2), if there is one.
    #[pyo3(signature = (w, *, out=None))]
    fn invert<'py>(
        &self,
        py: Python<'py>,
        w: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let w = Argument::new("w", FieldKind::Direction, w)?;
        let columns = w.columns(&w.shape)?;
        numbers(py, &w.shape, out, |range, [x, y]| {
            self.prepared.invert(vector(&cut(&columns, range)), Vec2::new(x, y));
        })
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

/// The pdfs of unit directions w by `pdf`.
fn pdfs<'py>(
    py: Python<'py>,
    w: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
    pdf: impl FnOnce(Vec3<&[f32]>, &mut [f32]) + Send,
) -> PyResult<Bound<'py, PyAny>> {
    let w = Argument::new("w", FieldKind::Direction, w)?;
    let columns = w.columns(&w.shape)?;
    let n = columns[0].len();
    let array = given_or_new(py, &w.shape, out)?;
    let mut target = Target::of(Some(&array), n)?;
    let numbers = target.numbers();
    run(py, n, || pdf(vector(&columns), numbers));
    Ok(array.clone().into_any())
}
/// The numbers u, (..., 2), that `batch` writes for ranges of the elements of `shape`.
pub(crate) fn numbers<'py>(
    py: Python<'py>,
    shape: &[usize],
    out: Option<&Bound<'py, PyAny>>,
    batch: impl Fn(Range<usize>, [&mut [f32]; 2]) + Send,
) -> PyResult<Bound<'py, PyAny>> {
    let n = shape.iter().product();
    let array = given_or_new(py, &[shape, &[2]].concat(), out)?;
    let mut target = Target::of(Some(&array), 2 * n)?;
    let rows = target.numbers();
    run(py, n, || fill_rows(n, rows, batch));
    Ok(array.clone().into_any())
}

/// A point p, or a normal n.
pub(crate) fn single(name: &'static str, object: &Bound<'_, PyAny>) -> PyResult<Vec3<f32>> {
    let kind = if name == "n" { FieldKind::Normal } else { FieldKind::Row(3) };
    let columns = Argument::single(name, kind, object)?.columns(&[])?;
    Ok(Vec3::new(columns[0][0], columns[1][0], columns[2][0]))
}

/// Adds samplers to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Sampler>()
}
