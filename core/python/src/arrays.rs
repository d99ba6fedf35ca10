//! numpy arrays as columns of numbers, and back.

use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// Batches at least as long as this release Python's lock.
const LARGE: usize = 256;
/// The largest number below 1.
const LAST: f32 = 1.0 - 1.0 / 16_777_216.0;

/// What an argument is made of.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A number.
    Number,
    /// A number in [0, 1).
    Unit,
    /// So many numbers on the last axis.
    Row(usize),
    /// Two numbers in [0, 1).
    Units,
    /// A unit vector, or 0.
    Direction,
    /// 3 to 8 points, on the last two axes.
    Corners,
    /// An index.
    Index,
}

impl Kind {
    /// The lengths of its own axes, where they are fixed.
    fn axes(self) -> &'static str {
        match self {
            Self::Number | Self::Unit | Self::Index => "",
            Self::Row(2) | Self::Units => "2",
            Self::Row(4) => "4",
            Self::Row(_) | Self::Direction => "3",
            Self::Corners => "3 to 8, 3",
        }
    }
    /// How many columns it takes.
    fn width(self) -> usize {
        match self {
            Self::Number | Self::Unit | Self::Index => 1,
            Self::Units => 2,
            Self::Row(width) => width,
            Self::Direction => 3,
            Self::Corners => 24,
        }
    }
    /// The number of its own axes.
    fn rank(self) -> usize {
        match self {
            Self::Number | Self::Unit | Self::Index => 0,
            Self::Corners => 2,
            _ => 1,
        }
    }
    fn fits(self, axes: &[usize]) -> bool {
        match (self, axes) {
            (Self::Corners, [corners, 3]) => (3..=8).contains(corners),
            (_, [width]) => *width == self.width(),
            (_, axes) => axes.is_empty(),
        }
    }
}

/// An argument as a numpy array whose shape and type were checked.
pub(crate) struct Argument<'py> {
    name: &'static str,
    kind: Kind,
    array: Bound<'py, PyAny>,
    /// The axes before its own.
    pub(crate) shape: Vec<usize>,
    axes: Vec<usize>,
}

impl<'py> Argument<'py> {
    pub(crate) fn new(name: &'static str, kind: Kind, object: &Bound<'py, PyAny>) -> PyResult<Self> {
        let py = object.py();
        let named = |e: PyErr| {
            let message = format!("{name}: {}", e.value(py));
            if e.is_instance_of::<PyValueError>(py) {
                PyValueError::new_err(message)
            } else {
                PyTypeError::new_err(message)
            }
        };
        let array = py.import("numpy")?.call_method1("asarray", (object,)).map_err(named)?;
        let mut shape: Vec<usize> = array.getattr("shape")?.extract()?;
        let dtype = array.getattr("dtype")?;
        let letter: String = dtype.getattr("kind")?.extract()?;
        let wanted = if kind == Kind::Index { "iu" } else { "biuf" };
        // an empty list is an array of floats
        if !wanted.contains(&letter) && !shape.contains(&0) {
            let numbers = if kind == Kind::Index { "integers" } else { "real numbers" };
            return Err(PyTypeError::new_err(format!("{name} must be an array of {numbers}, not of {dtype}")));
        }
        // an empty list stands for no rows
        let (array, axes) = if shape == [0] && kind.rank() > 0 && kind != Kind::Corners {
            let axes = vec![kind.width()];
            (array.call_method1("reshape", ((0, kind.width()),))?, axes)
        } else {
            let own = shape.len().checked_sub(kind.rank());
            let axes = own.map(|own| shape.split_off(own)).filter(|axes| kind.fits(axes));
            let Some(axes) = axes else {
                let whole = array.getattr("shape")?;
                let wanted = if kind.rank() == 0 { "()" } else { kind.axes() };
                return Err(PyValueError::new_err(format!("{name} must have the shape (..., {wanted}), not {whole}")));
            };
            (array, axes)
        };
        Ok(Self { name, kind, array, shape, axes })
    }
    /// An argument of one element.
    pub(crate) fn single(name: &'static str, kind: Kind, object: &Bound<'py, PyAny>) -> PyResult<Self> {
        let this = Self::new(name, kind, object)?;
        if this.shape.is_empty() {
            return Ok(this);
        }
        let wanted =
            if kind.rank() == 0 { "be one number".into() } else { format!("have the shape ({})", kind.axes()) };
        Err(PyValueError::new_err(format!("{name} must {wanted}, not {}", this.array.getattr("shape")?)))
    }
    /// The array with the axes `shape` before its own, as contiguous memory.
    fn spread<T: Element>(&self, shape: &[usize], dtype: &str) -> PyResult<PyReadonlyArrayDyn<'py, T>> {
        let py = self.array.py();
        let numpy = py.import("numpy")?;
        let whole = PyTuple::new(py, [shape, &self.axes].concat())?;
        let array = numpy.call_method1("broadcast_to", (&self.array, whole))?;
        let array = numpy.call_method1("require", (array, dtype, ["C", "A", "E"]))?;
        array.extract()
    }
    /// Its columns, of one number for each element of `shape`.
    pub(crate) fn columns(&self, shape: &[usize]) -> PyResult<Vec<Vec<f32>>> {
        let array = self.spread::<f32>(shape, "float32")?;
        let numbers = array.as_slice()?;
        let n = shape.iter().product();
        let width = self.axes.iter().product::<usize>();
        let mut columns = Vec::with_capacity(self.kind.width());
        for k in 0..self.kind.width() {
            // a polygon repeats its last corner
            let k = if k < width { k } else { width - 3 + k % 3 };
            let mut column = room(n)?;
            column.extend(numbers.iter().skip(k).step_by(width.max(1)).take(n));
            columns.push(column);
        }
        self.check(&mut columns)?;
        Ok(columns)
    }
    fn check(&self, columns: &mut [Vec<f32>]) -> PyResult<()> {
        let name = self.name;
        match self.kind {
            Kind::Unit | Kind::Units => {
                for x in columns.iter_mut().flatten() {
                    if !(0.0..=1.0).contains(x) {
                        return Err(PyValueError::new_err(format!("{name} must be in [0, 1), not {x}")));
                    }
                    // numbers of double precision round to 1
                    *x = x.min(LAST);
                }
            }
            Kind::Direction => {
                let [x, y, z] = columns else { return Ok(()) };
                for ((x, y), z) in x.iter().zip(y).zip(z) {
                    let square = x * x + *y * *y + *z * *z;
                    if square > 0.0 && square.is_finite() && (square - 1.0).abs() > 0.01 {
                        let message = format!("{name} must be unit vectors, not of length {}", square.sqrt());
                        return Err(PyValueError::new_err(message));
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }
    /// Its indices, one for each element of `shape`.
    pub(crate) fn indices(&self, shape: &[usize]) -> PyResult<Vec<u32>> {
        let array = self.spread::<i64>(shape, "int64")?;
        let index = |&i: &i64| {
            u32::try_from(i).map_err(|_| PyValueError::new_err(format!("{} must be in [0, 2**32), not {i}", self.name)))
        };
        array.as_slice()?.iter().map(index).collect()
    }
}

/// The common shape of arguments, by numpy's rules.
pub(crate) fn broadcast(py: Python<'_>, arguments: &[&Argument<'_>]) -> PyResult<Vec<usize>> {
    let shapes = PyTuple::new(py, arguments.iter().map(|a| PyTuple::new(py, &a.shape)).collect::<PyResult<Vec<_>>>()?)?;
    let shape = py.import("numpy")?.getattr("broadcast_shapes")?.call1(shapes).map_err(|_| {
        let shapes = arguments.iter().filter(|a| !a.shape.is_empty());
        let shapes = shapes.map(|a| Ok(format!("{} {}", a.name, a.array.getattr("shape")?)));
        match shapes.collect::<PyResult<Vec<_>>>() {
            Ok(shapes) => PyValueError::new_err(format!("the shapes do not agree: {}", shapes.join(", "))),
            Err(e) => e,
        }
    })?;
    shape.extract()
}

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
/// So many zeros in each of K columns.
pub(crate) fn zero_columns<const K: usize>(n: usize) -> PyResult<[Vec<f32>; K]> {
    let mut columns = [const { Vec::new() }; K];
    for column in &mut columns {
        *column = zeros(n)?;
    }
    Ok(columns)
}

/// Runs a batch of `n`, without Python's lock if it is large.
pub(crate) fn run<R: Send>(py: Python<'_>, n: usize, batch: impl FnOnce() -> R + Send) -> R {
    if n < LARGE { batch() } else { py.detach(batch) }
}

/// A numpy array of the shape `shape`.
pub(crate) fn array<'py, T: Element>(py: Python<'py>, shape: &[usize], numbers: Vec<T>) -> PyResult<Bound<'py, PyAny>> {
    let array = PyArray1::from_vec(py, numbers);
    debug_assert_eq!(array.len(), shape.iter().product::<usize>());
    Ok(array.reshape(shape.to_vec())?.into_any())
}
/// A numpy array of the shape `shape`, with the columns on one more axis.
pub(crate) fn rows<'py>(py: Python<'py>, shape: &[usize], columns: &[Vec<f32>]) -> PyResult<Bound<'py, PyAny>> {
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
