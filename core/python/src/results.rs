//! Results in numpy arrays, which are new or the caller's.

use etendue_batch::{Batch, BatchMap};
use numpy::{Element, PyArray1, PyArrayDyn, PyArrayMethods, PyReadwriteArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::ops::Range;

/// Returns a ValueError with this message.
macro_rules! refuse {
    ($($message:tt)+) => {
        return Err(pyo3::exceptions::PyValueError::new_err(format!($($message)+)))
    };
}
pub(crate) use refuse;

/// What a caller gives or gets.
pub(crate) type Object<'py> = Bound<'py, PyAny>;

/// Batches at least as long as this release Python's lock.
const LARGE: usize = 256;
/// Elements that are computed at a time, so that their columns stay in the processor's nearest memory until they are rows.
pub(crate) const BLOCK: usize = 1024;

/// Memory for so many numbers.
pub(crate) fn room<T>(n: usize) -> PyResult<Vec<T>> {
    let mut column = Vec::new();
    match column.try_reserve_exact(n) {
        Ok(()) => Ok(column),
        Err(_) => Err(PyMemoryError::new_err(format!("no memory for {n} numbers"))),
    }
}
/// So many zeros.
pub(crate) fn zeros<T: Default + Clone>(n: usize) -> PyResult<Vec<T>> {
    let mut column = room(n)?;
    column.resize(n, T::default());
    Ok(column)
}
/// So many columns of zeros.
pub(crate) fn zero_columns(count: usize, n: usize) -> PyResult<Vec<Vec<f32>>> {
    (0..count).map(|_| zeros(n)).collect()
}

/// Runs a batch of `n`, without Python's lock if it is large.
pub(crate) fn run<R: Send>(py: Python<'_>, n: usize, batch: impl FnOnce() -> R + Send) -> R {
    if n < LARGE { batch() } else { py.detach(batch) }
}

/// The table that `build` writes to so many zeros.
pub(crate) fn table<T: Default + Clone + Send, E: ToString>(
    py: Python<'_>,
    length: usize,
    build: impl FnOnce(&mut [T]) -> Result<(), E> + Send,
) -> PyResult<Vec<T>> {
    let mut table = zeros(length)?;
    let built = run(py, length, || build(&mut table).map_err(|e| e.to_string()));
    built.map_err(PyValueError::new_err)?;
    Ok(table)
}

/// The results of a map of columns of numbers, and whether they hold.
pub(crate) fn map<M: BatchMap + Sync>(
    py: Python<'_>,
    map: &M,
    columns: &[Vec<f32>],
) -> PyResult<(Vec<Vec<f32>>, Vec<bool>)> {
    let n = columns[0].len();
    let mut out = zero_columns(M::RESULTS, n)?;
    let mut holds = zeros::<u8>(n)?;
    let numbers: Vec<&[f32]> = columns.iter().map(Vec::as_slice).collect();
    run(py, n, || {
        let mut out: Vec<&mut [f32]> = out.iter_mut().map(Vec::as_mut_slice).collect();
        Batch::new().map(map, &numbers, &mut out, &mut holds);
    });
    Ok((out, holds.into_iter().map(|holds| holds != 0).collect()))
}

/// A numpy array of the shape `shape`.
pub(crate) fn array<'py, T: Element>(py: Python<'py>, shape: &[usize], numbers: Vec<T>) -> PyResult<Object<'py>> {
    let array = PyArray1::from_vec(py, numbers);
    debug_assert_eq!(array.len(), shape.iter().product::<usize>());
    Ok(array.reshape(shape.to_vec())?.into_any())
}
/// A numpy array of the shape `shape`, with the columns on one more axis.
pub(crate) fn rows<'py>(py: Python<'py>, shape: &[usize], columns: &[Vec<f32>]) -> PyResult<Object<'py>> {
    let n = columns.first().map_or(0, Vec::len);
    let mut numbers = zeros(n * columns.len())?;
    run(py, n, || {
        for (k, column) in columns.iter().enumerate() {
            for (to, from) in numbers.iter_mut().skip(k).step_by(columns.len()).zip(column) {
                *to = *from;
            }
        }
    });
    let shape: Vec<usize> = shape.iter().copied().chain([columns.len()]).collect();
    array(py, &shape, numbers)
}

/// A new array of zeros, whose memory the system clears only where it is written.
pub(crate) fn new_array<'py, T: Element>(py: Python<'py>, shape: &[usize]) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let shape = PyTuple::new(py, shape)?;
    Ok(py.import("numpy")?.call_method1("zeros", (shape, T::get_dtype(py)))?.cast_into()?)
}
/// The caller's array `out` if there is one, which must have the shape and the type of the results; else a new one.
pub(crate) fn given_or_new<'py, T: Element>(
    py: Python<'py>,
    shape: &[usize],
    out: Option<&Object<'py>>,
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let Some(out) = out else { return new_array(py, shape) };
    let Ok(array) = out.cast::<PyArrayDyn<T>>() else {
        let wanted = T::get_dtype(py);
        let found = out.getattr("dtype").or_else(|_| out.get_type().name().map(Bound::into_any))?;
        return Err(PyTypeError::new_err(format!("out must be an array of {wanted}, not of {found}")));
    };
    if array.shape() != shape {
        refuse!("out must have the shape {}, not {}", PyTuple::new(py, shape)?, out.getattr("shape")?);
    }
    Ok(array.clone())
}

/// The memory of an array of results, which no other call may use as long as this lives.
pub(crate) struct Target<'py, T: Element>(Option<PyReadwriteArrayDyn<'py, T>>);

impl<'py, T: Element> Target<'py, T> {
    /// None for an array that is not wanted.
    pub(crate) fn of(array: Option<&Bound<'py, PyArrayDyn<T>>>, length: usize) -> PyResult<Self> {
        let Some(array) = array else { return Ok(Self(None)) };
        let mut target =
            array.try_readwrite().map_err(|e| PyValueError::new_err(format!("out cannot be written: {e}")))?;
        if target.as_slice_mut().map_or(0, |numbers| numbers.len()) != length {
            refuse!("out must be contiguous, of {length} numbers");
        }
        Ok(Self(Some(target)))
    }
    /// Its numbers; none where the array is not wanted.
    pub(crate) fn numbers(&mut self) -> &mut [T] {
        self.0.as_mut().and_then(|target| target.as_slice_mut().ok()).unwrap_or_default()
    }
}

/// The numbers of a result for a range of elements, of `width` numbers each; none where it is not wanted.
pub(crate) fn part<T>(numbers: &mut [T], width: usize, range: Range<usize>) -> &mut [T] {
    if numbers.is_empty() { numbers } else { &mut numbers[width * range.start..width * range.end] }
}
/// Writes columns as rows; nothing where the rows are not wanted.
pub(crate) fn write_rows<const N: usize>(columns: [&[f32]; N], rows: &mut [f32]) {
    let (rows, _) = rows.as_chunks_mut::<N>();
    let columns = columns.map(|column| &column[..rows.len()]);
    for (i, row) in rows.iter_mut().enumerate() {
        *row = columns.map(|column| column[i]);
    }
}
/// Fills `rows` of N numbers each with what `batch` writes in columns for ranges of elements.
pub(crate) fn fill_rows<const N: usize>(n: usize, rows: &mut [f32], batch: impl Fn(Range<usize>, [&mut [f32]; N])) {
    let mut columns = [[0.0; BLOCK]; N];
    for start in (0..n).step_by(BLOCK) {
        let range = start..n.min(start + BLOCK);
        batch(range.clone(), columns.each_mut().map(|column| &mut column[..range.len()]));
        write_rows(columns.each_ref().map(|column| &column[..range.len()]), part(rows, N, range));
    }
}
