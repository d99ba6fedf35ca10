//! Samples of lights in numpy arrays.

use crate::results::{BLOCK, Object, Target, new_array, part, refuse, run, write_rows};
use numpy::Element;
use pyo3::exceptions::{PyAttributeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyString, PyTuple};
use std::ops::Range;

/// The fields of samples, each with how many numbers it has.
const FIELDS: [(&str, usize); 7] =
    [("direction", 3), ("distance", 1), ("pdf", 1), ("weight", 1), ("normal", 3), ("uv", 2), ("emits", 1)];
/// The fields of numbers come before that of truth values.
const NUMBERS: usize = 6;

/// Samples of a light, or the points of it that directions hit, in arrays of one shape (...).
///
/// The estimator of reflected radiance is f · L · cosθ · weight, where nothing is in the way from the shading point along `direction` up
/// to `distance`. The weight is 0 where there is no sample and where the light does not emit towards the point. A field that was not
/// wanted raises AttributeError.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct Samples {
    shape: Vec<usize>,
    /// The arrays of [`FIELDS`], where they are wanted.
    fields: [Option<Py<PyAny>>; FIELDS.len()],
}

#[pymethods]
impl Samples {
    /// Unit directions from the shading point to the light, (..., 3).
    #[getter]
    fn direction(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.field(py, 0)
    }
    /// Distances to the light along them, in the unit of the coordinates; the largest float32 for suns.
    #[getter]
    fn distance(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.field(py, 1)
    }
    /// Probability densities of the directions, per steradian (lines: see `Line`); 0 where there is no sample.
    #[getter]
    fn pdf(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.field(py, 2)
    }
    /// 1/pdf where there is a sample and the light emits towards the shading point, else 0.
    #[getter]
    fn weight(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.field(py, 3)
    }
    /// Unit normals of the light, (..., 3).
    #[getter]
    fn normal(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.field(py, 4)
    }
    /// Surface coordinates in [0, 1]², (..., 2).
    #[getter]
    fn uv(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.field(py, 5)
    }
    /// Whether the shading point is on the side of the light that emits: bool.
    #[getter]
    fn emits(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.field(py, NUMBERS)
    }
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let names = FIELDS.iter().zip(&self.fields).filter_map(|((name, _), field)| field.as_ref().map(|_| *name));
        let names: Vec<_> = names.collect();
        Ok(format!("<etendue.Samples of shape {}: {}>", PyTuple::new(py, &self.shape)?, names.join(", ")))
    }
}

/// What is wanted of samples, as the caller says it: names of fields, and samples to write over.
#[derive(Clone, Copy, Default)]
pub(crate) struct Wanted<'a, 'py> {
    pub(crate) fields: Option<&'a Object<'py>>,
    pub(crate) out: Option<&'a Object<'py>>,
}

impl<'py> Wanted<'_, 'py> {
    /// Which fields are wanted.
    fn which(self) -> PyResult<[bool; FIELDS.len()]> {
        let Some(fields) = self.fields else { return Ok([true; FIELDS.len()]) };
        let names: Vec<String> = match fields.cast::<PyString>() {
            Ok(name) => vec![name.extract()?],
            Err(_) => fields.try_iter()?.map(|name| name?.extract()).collect::<PyResult<_>>()?,
        };
        let known = FIELDS.map(|(name, _)| name);
        if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
            refuse!("fields must be of {known:?}, not {name:?}");
        }
        Ok(known.map(|known| names.iter().any(|name| name == known)))
    }
    /// The samples to write over, or new ones.
    fn samples(self, py: Python<'py>, shape: &[usize]) -> PyResult<Bound<'py, Samples>> {
        let Some(out) = self.out else {
            let which = self.which()?;
            let mut fields = [const { None }; FIELDS.len()];
            for (k, field) in fields.iter_mut().enumerate().filter(|(k, _)| which[*k]) {
                let own: &[usize] = if FIELDS[k].1 > 1 { &[FIELDS[k].1] } else { &[] };
                let shape = [shape, own].concat();
                *field = Some(if k < NUMBERS {
                    new_array::<f32>(py, &shape)?.into_any().unbind()
                } else {
                    new_array::<bool>(py, &shape)?.into_any().unbind()
                });
            }
            return Bound::new(py, Samples { shape: shape.to_vec(), fields });
        };
        if self.fields.is_some() {
            return Err(PyTypeError::new_err("out has its fields: give either fields or out"));
        }
        let Ok(samples) = out.cast::<Samples>() else {
            return Err(PyTypeError::new_err(format!("out must be Samples, not {}", out.get_type().name()?)));
        };
        if samples.get().shape != shape {
            let [wanted, found] = [shape, &samples.get().shape].map(|shape| PyTuple::new(py, shape));
            refuse!("out must have the shape {}, not {}", wanted?, found?);
        }
        Ok(samples.clone())
    }
}

impl Samples {
    fn field(&self, py: Python<'_>, k: usize) -> PyResult<Py<PyAny>> {
        let missing =
            || PyAttributeError::new_err(format!("these samples have no {}: `fields` did not name it", FIELDS[k].0));
        self.fields[k].as_ref().map(|field| field.clone_ref(py)).ok_or_else(missing)
    }
    /// The memory of a field of so many numbers.
    fn target<'py, T: Element>(&self, py: Python<'py>, k: usize, count: usize) -> PyResult<Target<'py, T>> {
        Target::of(self.fields[k].as_ref().map(|field| field.bind(py).cast()).transpose()?, count)
    }
    /// The samples that `batch` writes for ranges of elements, one for each element of `shape`.
    pub(crate) fn of<'py>(
        py: Python<'py>,
        shape: &[usize],
        wanted: Wanted<'_, 'py>,
        batch: impl Fn(Range<usize>, etendue_batch::Samples<'_>) + Send,
    ) -> PyResult<Object<'py>> {
        let samples = wanted.samples(py, shape)?;
        let n = shape.iter().product::<usize>();
        let mut targets = Vec::with_capacity(NUMBERS);
        for (k, (_, width)) in FIELDS[..NUMBERS].iter().enumerate() {
            targets.push(samples.get().target(py, k, n * width)?);
        }
        let mut emits = samples.get().target(py, NUMBERS, n)?;
        let [direction, distance, pdf, weight, normal, uv] = &mut targets[..] else {
            unreachable!("as many as numbers")
        };
        let numbers = [direction, distance, pdf, weight, normal, uv].map(Target::numbers);
        let emits = emits.numbers();
        run(py, n, || fill(n, numbers, emits, batch));
        Ok(samples.into_any())
    }
}

/// Fills the fields with what `batch` writes for ranges of elements.
fn fill(
    n: usize,
    [direction, distance, pdf, weight, normal, uv]: [&mut [f32]; NUMBERS],
    emits: &mut [bool],
    batch: impl Fn(Range<usize>, etendue_batch::Samples<'_>),
) {
    let wants = [&*direction, normal, uv].map(|rows| !rows.is_empty());
    let (mut columns, mut sides) = ([[0.0; BLOCK]; 8], [0; BLOCK]);
    for start in (0..n).step_by(BLOCK) {
        let range = start..n.min(start + BLOCK);
        let count = range.len();
        let [x, y, z, nx, ny, nz, u, v] = columns.each_mut().map(|column| &mut column[..count]);
        let out = etendue_batch::Samples {
            direction: [x, y, z].map(|column| some(wants[0], column)),
            distance: part(distance, 1, range.clone()),
            pdf: part(pdf, 1, range.clone()),
            weight: part(weight, 1, range.clone()),
            normal: [nx, ny, nz].map(|column| some(wants[1], column)),
            uv: [u, v].map(|column| some(wants[2], column)),
            emits: if emits.is_empty() { &mut [] } else { &mut sides[..count] },
        };
        batch(range.clone(), out);
        let [x, y, z, nx, ny, nz, u, v] = columns.each_ref().map(|column| &column[..count]);
        write_rows([x, y, z], part(direction, 3, range.clone()));
        write_rows([nx, ny, nz], part(normal, 3, range.clone()));
        write_rows([u, v], part(uv, 2, range.clone()));
        for (emits, side) in part(emits, 1, range).iter_mut().zip(sides) {
            *emits = side != 0;
        }
    }
}
/// The column where it is wanted, else none.
fn some(wanted: bool, column: &mut [f32]) -> &mut [f32] {
    if wanted { column } else { &mut [] }
}

/// Adds samples to the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Samples>()
}
