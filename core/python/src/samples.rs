//! Samples of lights in numpy arrays.

use crate::results::{BLOCK, Target, new_array, part, run, write_rows};
use numpy::{Element, PyArrayDyn};
use pyo3::exceptions::{PyAttributeError, PyTypeError, PyValueError};
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
    /// Those of [`FIELDS`] that are numbers, where they are wanted.
    numbers: [Option<Py<PyArrayDyn<f32>>>; NUMBERS],
    emits: Option<Py<PyArrayDyn<bool>>>,
}

#[pymethods]
impl Samples {
    /// Unit directions from the shading point to the light, (..., 3).
    #[getter]
    fn direction(&self, py: Python<'_>) -> PyResult<Py<PyArrayDyn<f32>>> {
        self.number(py, 0)
    }
    /// Distances to the light along them, in the unit of the coordinates; the largest float32 for suns.
    #[getter]
    fn distance(&self, py: Python<'_>) -> PyResult<Py<PyArrayDyn<f32>>> {
        self.number(py, 1)
    }
    /// Probability densities of the directions, per steradian (lines: see `Line`); 0 where there is no sample.
    #[getter]
    fn pdf(&self, py: Python<'_>) -> PyResult<Py<PyArrayDyn<f32>>> {
        self.number(py, 2)
    }
    /// 1/pdf where there is a sample and the light emits towards the shading point, else 0.
    #[getter]
    fn weight(&self, py: Python<'_>) -> PyResult<Py<PyArrayDyn<f32>>> {
        self.number(py, 3)
    }
    /// Unit normals of the light, (..., 3).
    #[getter]
    fn normal(&self, py: Python<'_>) -> PyResult<Py<PyArrayDyn<f32>>> {
        self.number(py, 4)
    }
    /// Surface coordinates in [0, 1]², (..., 2).
    #[getter]
    fn uv(&self, py: Python<'_>) -> PyResult<Py<PyArrayDyn<f32>>> {
        self.number(py, 5)
    }
    /// Whether the shading point is on the side of the light that emits: bool.
    #[getter]
    fn emits(&self, py: Python<'_>) -> PyResult<Py<PyArrayDyn<bool>>> {
        found(py, &self.emits, FIELDS[NUMBERS].0)
    }
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let has = self.numbers.iter().map(Option::is_some).chain([self.emits.is_some()]);
        let names: Vec<_> = FIELDS.iter().zip(has).filter(|(_, has)| *has).map(|((name, _), _)| *name).collect();
        Ok(format!("<etendue.Samples of shape {}: {}>", PyTuple::new(py, &self.shape)?, names.join(", ")))
    }
}

/// A field, if it is there.
fn found<T>(py: Python<'_>, field: &Option<Py<T>>, name: &str) -> PyResult<Py<T>> {
    let missing = || PyAttributeError::new_err(format!("these samples have no {name}: `fields` did not name it"));
    field.as_ref().map(|field| field.clone_ref(py)).ok_or_else(missing)
}

/// What is wanted of samples, as the caller says it: names of fields, and samples to write over.
#[derive(Clone, Copy, Default)]
pub(crate) struct Wanted<'a, 'py> {
    pub(crate) fields: Option<&'a Bound<'py, PyAny>>,
    pub(crate) out: Option<&'a Bound<'py, PyAny>>,
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
            return Err(PyValueError::new_err(format!("fields must be of {known:?}, not {name:?}")));
        }
        Ok(known.map(|known| names.iter().any(|name| name == known)))
    }
    /// The samples to write over, or new ones.
    fn samples(self, py: Python<'py>, shape: &[usize]) -> PyResult<Bound<'py, Samples>> {
        let Some(out) = self.out else {
            let which = self.which()?;
            let mut numbers = [const { None }; NUMBERS];
            for (k, field) in numbers.iter_mut().enumerate().filter(|(k, _)| which[*k]) {
                *field = Some(new_field(py, shape, FIELDS[k].1)?);
            }
            let emits = if which[NUMBERS] { Some(new_field(py, shape, 1)?) } else { None };
            return Bound::new(py, Samples { shape: shape.to_vec(), numbers, emits });
        };
        if self.fields.is_some() {
            return Err(PyTypeError::new_err("out has its fields: give either fields or out"));
        }
        let Ok(samples) = out.cast::<Samples>() else {
            return Err(PyTypeError::new_err(format!("out must be Samples, not {}", out.get_type().name()?)));
        };
        if samples.get().shape != shape {
            let [wanted, found] = [shape, &samples.get().shape].map(|shape| PyTuple::new(py, shape));
            return Err(PyValueError::new_err(format!("out must have the shape {}, not {}", wanted?, found?)));
        }
        Ok(samples.clone())
    }
}

/// An array of `width` numbers for each element.
fn new_field<T: Element>(py: Python<'_>, shape: &[usize], width: usize) -> PyResult<Py<PyArrayDyn<T>>> {
    let own: &[usize] = if width > 1 { &[width] } else { &[] };
    Ok(new_array(py, &[shape, own].concat())?.unbind())
}

impl Samples {
    fn number(&self, py: Python<'_>, k: usize) -> PyResult<Py<PyArrayDyn<f32>>> {
        found(py, &self.numbers[k], FIELDS[k].0)
    }
    /// The samples that `batch` writes for ranges of elements, one for each element of `shape`.
    pub(crate) fn of<'py>(
        py: Python<'py>,
        shape: &[usize],
        wanted: Wanted<'_, 'py>,
        batch: impl Fn(Range<usize>, etendue_batch::Samples<'_>) + Send,
    ) -> PyResult<Bound<'py, Self>> {
        let samples = wanted.samples(py, shape)?;
        let n = shape.iter().product::<usize>();
        let Self { numbers, emits, .. } = samples.get();
        let mut targets = Vec::with_capacity(NUMBERS);
        for (field, (_, width)) in numbers.iter().zip(FIELDS) {
            targets.push(Target::of(field.as_ref().map(|field| field.bind(py)), n * width)?);
        }
        let mut emits = Target::of(emits.as_ref().map(|field| field.bind(py)), n)?;
        let [direction, distance, pdf, weight, normal, uv] = &mut targets[..] else {
            unreachable!("as many as numbers")
        };
        let numbers = [direction, distance, pdf, weight, normal, uv].map(Target::numbers);
        let emits = emits.numbers();
        run(py, n, || fill(n, numbers, emits, batch));
        Ok(samples)
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
