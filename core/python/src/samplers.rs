//! Lights prepared for a shading point.

use crate::arrays::{Field, FieldKind, cut, together, vector};
use crate::results::{Object, Target, fill_rows, given_or_new, run};
use crate::samples::{Samples, Wanted};
use etendue::{LightSampler, Vec2};
use etendue_batch::{Batch, Evaluations};
use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;
use std::ops::Range;

/// What is asked of a light for each row.
#[derive(Clone, Copy)]
pub(crate) enum Call {
    Sample,
    Hit,
    Pdf,
    PdfOfHit,
    Invert,
}

impl Call {
    /// What it takes: numbers u or directions w.
    pub(crate) fn field<'a, 'py>(self, at: &'a Object<'py>) -> Field<'a, 'py> {
        if let Self::Sample = self { ("u", FieldKind::Units, at) } else { ("w", FieldKind::Direction, at) }
    }
    /// Answers it by a prepared light, for columns of what it takes.
    pub(crate) fn answer<P: etendue_batch::Prepared>(self, sampler: &P, at: &[&[f32]], out: Evaluations<'_>) {
        let batch = Batch::new();
        match self {
            Self::Sample => batch.sample(sampler, Vec2::new(at[0], at[1]), out.hit),
            Self::Hit => batch.hit(sampler, vector(at), out.hit),
            Self::Pdf => batch.pdf(sampler, vector(at), out.pdf),
            Self::Invert => {
                let [x, y] = out.u;
                batch.invert(sampler, vector(at), Vec2::new(x, y));
            }
            // a few operations each, for which batches have no function
            Self::PdfOfHit => sampler.over::<f32, _>(|light| {
                let w = vector(at);
                for (i, pdf) in out.pdf.iter_mut().enumerate() {
                    *pdf = light.pdf_of_hit(w.map(|column| column[i]));
                }
            }),
        }
    }
    /// The arrays of the answers that `batch` writes for ranges of rows: the samples to `hit`.
    pub(crate) fn results<'py>(
        self,
        py: Python<'py>,
        shape: &[usize],
        wanted: Wanted<'_, 'py>,
        batch: impl Fn(Range<usize>, Evaluations<'_>) + Send,
    ) -> PyResult<Object<'py>> {
        let n = shape.iter().product();
        match self {
            Self::Sample | Self::Hit => Samples::of(py, shape, wanted, move |range, hit| {
                batch(range, Evaluations { hit, ..Evaluations::default() })
            }),
            Self::Pdf | Self::PdfOfHit => {
                let array = given_or_new(py, shape, wanted.out)?;
                let mut target = Target::of(Some(&array), n)?;
                let pdf = target.numbers();
                run(py, n, move || batch(0..n, Evaluations { pdf, ..Evaluations::default() }));
                Ok(array.clone().into_any())
            }
            Self::Invert => {
                let array = given_or_new(py, &[shape, &[2]].concat(), wanted.out)?;
                let mut target = Target::of(Some(&array), 2 * n)?;
                let rows = target.numbers();
                let write = move |range, u: [&mut [f32]; 2]| batch(range, Evaluations { u, ..Evaluations::default() });
                run(py, n, move || fill_rows(n, rows, write));
                Ok(array.clone().into_any())
            }
        }
    }
}

/// A light prepared by any technique.
pub(crate) trait Prepared: Send + Sync {
    /// Answers a call for columns of what it takes.
    fn answer(&self, call: Call, at: &[&[f32]], out: Evaluations<'_>);
}
impl<P: etendue_batch::Prepared + Send + Sync> Prepared for P {
    fn answer(&self, call: Call, at: &[&[f32]], out: Evaluations<'_>) {
        call.answer(self, at, out);
    }
}

/// A light prepared for one shading point by one technique: `light.by_…` makes it, and it draws as often as needed.
///
/// What is easily done wrong: directions and normals that are not of length 1 raise ValueError. With the opposite normal, a light by
/// projected solid angle is below the surface, and has pdf 0. A light seen from behind has a pdf, but `emits` is False and the weight 0;
/// one of two sides has the weight 1/pdf. From a point that was computed on a light, rounding decides on
/// which side it is, and a light must not light itself: pass over the light where `light.on_surface(p)`. A direction computed anew from the point of a sample has other last bits, and may miss beside an edge: keep the
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
    fn answer<'py>(&self, call: Call, at: &Object<'py>, wanted: Wanted<'_, 'py>) -> PyResult<Object<'py>> {
        let (shape, columns) = together(&[call.field(at)])?;
        let batch = |range, out: Evaluations<'_>| self.prepared.answer(call, &cut(&columns, range), out);
        call.results(at.py(), &shape, wanted, batch)
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
        u: &Object<'py>,
        fields: Option<&Object<'py>>,
        out: Option<&Object<'py>>,
    ) -> PyResult<Object<'py>> {
        self.answer(Call::Sample, u, Wanted { fields, out })
    }
    /// The points of the light that unit directions w hit, (..., 3), with the pdf with which `sample` draws them; the pdf is 0 where a
    /// direction misses the light. `fields` and `out` are those of `sample`.
    #[pyo3(signature = (w, *, fields=None, out=None))]
    fn hit<'py>(
        &self,
        w: &Object<'py>,
        fields: Option<&Object<'py>>,
        out: Option<&Object<'py>>,
    ) -> PyResult<Object<'py>> {
        self.answer(Call::Hit, w, Wanted { fields, out })
    }
    /// The probability density per steradian with which `sample` draws unit directions w, (..., 3); 0 where they miss the light. It is
    /// written to the array `out` of float32, if there is one.
    #[pyo3(signature = (w, *, out=None))]
    fn pdf<'py>(&self, w: &Object<'py>, out: Option<&Object<'py>>) -> PyResult<Object<'py>> {
        self.answer(Call::Pdf, w, Wanted { fields: None, out })
    }
    /// The same for unit directions w, (..., 3), that are known to hit the light, as where a ray of the host has hit it: the light is not
    /// intersected again, so that no rounding makes a direction beside an edge miss it. Where w misses, the result is finite, and of no
    /// meaning.
    #[pyo3(signature = (w, *, out=None))]
    fn pdf_of_hit<'py>(&self, w: &Object<'py>, out: Option<&Object<'py>>) -> PyResult<Object<'py>> {
        self.answer(Call::PdfOfHit, w, Wanted { fields: None, out })
    }
    /// The numbers u in [0, 1)² that `sample` maps to unit directions w, (..., 3); any numbers where they miss the light. They are written
    /// to the array `out` of float32 and the shape (..., 2), if there is one.
    #[pyo3(signature = (w, *, out=None))]
    fn invert<'py>(&self, w: &Object<'py>, out: Option<&Object<'py>>) -> PyResult<Object<'py>> {
        self.answer(Call::Invert, w, Wanted { fields: None, out })
    }
    /// Surface area of the light, in the square of the unit of the coordinates; of samplers by area.
    #[getter]
    fn area(&self) -> PyResult<f32> {
        self.measure("area")
    }
    /// Solid angle of the light in steradians; of samplers by solid angle.
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

/// Adds samplers to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Sampler>()
}
