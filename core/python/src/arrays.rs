//! numpy arrays as columns of numbers.

use crate::results::{Object, refuse, room};
use etendue::Vec3;
use numpy::{Element, PyReadonlyArrayDyn};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::ops::Range;

/// An argument: its name, what it is made of, and its value.
pub(crate) type Field<'a, 'py> = (&'static str, FieldKind, &'a Object<'py>);
/// Columns of numbers, all of one length.
pub(crate) type Columns = Vec<Vec<f32>>;

/// The largest number below 1.
const LAST: f32 = 1.0 - 1.0 / 16_777_216.0;

/// What an argument is made of.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum FieldKind {
    /// A number.
    Number,
    /// The radius of a light, which is not negative.
    Radius,
    /// A number in [0, 1).
    Unit,
    /// So many numbers on the last axis.
    Row(usize),
    /// Two numbers in [0, 1).
    Units,
    /// A point, from which the first argument is subtracted: the core keeps the edge.
    Vertex,
    /// A unit vector.
    Direction,
    /// A unit vector, or what makes a light or a surface degenerate: 0, or numbers that are not finite.
    Normal,
    /// 3 to 8 points, on the last two axes.
    Corners,
    /// An index.
    Index,
}

impl FieldKind {
    /// How many columns it takes.
    pub(crate) fn width(self) -> usize {
        match self {
            Self::Number | Self::Radius | Self::Unit | Self::Index => 1,
            Self::Units => 2,
            Self::Row(width) => width,
            Self::Vertex | Self::Direction | Self::Normal => 3,
            Self::Corners => 24,
        }
    }
    /// Whether its numbers are in [0, 1).
    fn is_unit(self) -> bool {
        matches!(self, Self::Unit | Self::Units)
    }
    /// The number of its own axes.
    fn rank(self) -> usize {
        match self {
            Self::Number | Self::Radius | Self::Unit | Self::Index => 0,
            Self::Corners => 2,
            _ => 1,
        }
    }
    /// Its own axes, as messages say them.
    fn axes(self) -> String {
        match self.rank() {
            0 => "()".into(),
            1 => self.width().to_string(),
            _ => "3 to 8, 3".into(),
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
    kind: FieldKind,
    array: Object<'py>,
    /// The axes before its own.
    pub(crate) shape: Vec<usize>,
    axes: Vec<usize>,
}

impl<'py> Argument<'py> {
    pub(crate) fn new(name: &'static str, kind: FieldKind, object: &Object<'py>) -> PyResult<Self> {
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
        let wanted = if kind == FieldKind::Index { "iu" } else { "biuf" };
        // an empty list is an array of floats
        if !wanted.contains(&letter) && !shape.contains(&0) {
            let numbers = if kind == FieldKind::Index { "integers" } else { "real numbers" };
            return Err(PyTypeError::new_err(format!("{name} must be an array of {numbers}, not of {dtype}")));
        }
        // an empty list stands for no rows
        let (array, axes) = if shape == [0] && kind.rank() > 0 && kind != FieldKind::Corners {
            let axes = vec![kind.width()];
            (array.call_method1("reshape", ((0, kind.width()),))?, axes)
        } else {
            let own = shape.len().checked_sub(kind.rank());
            let axes = own.map(|own| shape.split_off(own)).filter(|axes| kind.fits(axes));
            let Some(axes) = axes else {
                refuse!("{name} must have the shape (..., {}), not {}", kind.axes(), array.getattr("shape")?);
            };
            (array, axes)
        };
        Ok(Self { name, kind, array, shape, axes })
    }
    /// An argument of one element.
    fn single(name: &'static str, kind: FieldKind, object: &Object<'py>) -> PyResult<Self> {
        let this = Self::new(name, kind, object)?;
        if this.shape.is_empty() {
            return Ok(this);
        }
        let wanted = kind.axes();
        let wanted = if kind.rank() == 0 { "be one number".into() } else { format!("have the shape ({wanted})") };
        refuse!("{name} must {wanted}, not {}", this.array.getattr("shape")?)
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
    fn columns(&self, shape: &[usize]) -> PyResult<Columns> {
        let columns = if self.kind.is_unit() && !self.is_single()? {
            // a number of double precision that is below 1 may round to 1: what it is shows only before
            let columns = self.split(self.spread::<f64>(shape, "float64")?.as_slice()?, shape)?;
            self.check_unit(&columns, shape)?;
            let mut rounded = Vec::with_capacity(columns.len());
            for column in columns {
                let mut to = room(column.len())?;
                to.extend(column.iter().map(|&x| (x as f32).min(LAST)));
                rounded.push(to);
            }
            rounded
        } else {
            let columns = self.split(self.spread::<f32>(shape, "float32")?.as_slice()?, shape)?;
            if self.kind.is_unit() {
                self.check_unit(&columns, shape)?;
            }
            columns
        };
        if let FieldKind::Direction | FieldKind::Normal = self.kind {
            self.check_length(&columns, shape)?;
        }
        if self.kind == FieldKind::Radius
            && let Some(at) = first(&columns[0], |x| *x < 0.0)
        {
            refuse!("{} must be at least 0, not {}", self.index(at, shape, None), columns[0][at]);
        }
        Ok(columns)
    }
    /// Whether its numbers are of single precision.
    fn is_single(&self) -> PyResult<bool> {
        let letter: String = self.array.getattr("dtype")?.getattr("char")?.extract()?;
        Ok(letter == "f")
    }
    /// Rows of numbers as columns.
    fn split<T: Copy>(&self, numbers: &[T], shape: &[usize]) -> PyResult<Vec<Vec<T>>> {
        let n = shape.iter().product();
        let width = self.axes.iter().product::<usize>();
        let mut columns = Vec::with_capacity(self.kind.width());
        for k in 0..self.kind.width() {
            // a polygon repeats its last corner
            let k = if k < width { k } else { width - 3 + k % 3 };
            let mut column = room(n)?;
            match width {
                2 => column.extend(numbers.as_chunks::<2>().0.iter().map(|row| row[k])),
                3 => column.extend(numbers.as_chunks::<3>().0.iter().map(|row| row[k])),
                _ => column.extend(numbers.iter().skip(k).step_by(width.max(1)).take(n)),
            }
            columns.push(column);
        }
        Ok(columns)
    }
    fn check_unit<T: Copy + Into<f64>>(&self, columns: &[Vec<T>], shape: &[usize]) -> PyResult<()> {
        let is_wrong = |x: &T| !(0.0..1.0).contains(&(*x).into());
        for (k, column) in columns.iter().enumerate() {
            if let Some(at) = first(column, is_wrong) {
                let x = column[at].into();
                refuse!("{} must be in [0, 1), not {x}", self.index(at, shape, (columns.len() > 1).then_some(k)));
            }
        }
        Ok(())
    }
    fn check_length(&self, columns: &[Vec<f32>], shape: &[usize]) -> PyResult<()> {
        let [x, y, z] = columns else { return Ok(()) };
        let may_be_degenerate = self.kind == FieldKind::Normal;
        let is_wrong = |&square: &f32| {
            let is_degenerate = !(square > 0.0 && square < f32::INFINITY);
            if is_degenerate { !may_be_degenerate } else { (square - 1.0).abs() > 0.01 }
        };
        let squares: Vec<f32> = x.iter().zip(y).zip(z).map(|((x, y), z)| x * x + y * y + z * z).collect();
        if let Some(at) = first(&squares, is_wrong) {
            let length = squares[at].sqrt();
            refuse!("{} must be a unit vector, not of length {length}", self.index(at, shape, None));
        }
        Ok(())
    }
    /// Its element that is the `at`-th of those of `shape`, as one writes it in Python.
    fn index(&self, mut at: usize, shape: &[usize], last: Option<usize>) -> String {
        let mut places: Vec<usize> = last.into_iter().collect();
        // from the last axis on, which is where the argument's own axes end, too
        for (i, &length) in shape.iter().rev().enumerate() {
            if let Some(&own) = self.shape.iter().rev().nth(i) {
                places.insert(0, if own == 1 { 0 } else { at % length });
            }
            at /= length;
        }
        if places.is_empty() {
            return self.name.into();
        }
        let places: Vec<String> = places.iter().map(usize::to_string).collect();
        format!("{}[{}]", self.name, places.join(", "))
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

/// The place of the first number that is wrong. It asks all of them without a branch for each, since nearly always none is.
fn first<T>(column: &[T], is_wrong: impl Fn(&T) -> bool) -> Option<usize> {
    let any = column.iter().fold(false, |any, x| any | is_wrong(x));
    if any { column.iter().position(is_wrong) } else { None }
}

/// The most columns or rows of an image.
const MOST_TEXELS: usize = 1 << 24;

/// An image of one number for each texel, row by row.
pub(crate) struct Image {
    pub(crate) weights: Vec<f32>,
    pub(crate) width: usize,
    pub(crate) height: usize,
}

impl Image {
    /// An argument of the shape (height, width), of numbers that are finite and not negative.
    pub(crate) fn new(name: &'static str, object: &Object<'_>) -> PyResult<Self> {
        let argument = Argument::new(name, FieldKind::Number, object)?;
        let &[height, width] = &argument.shape[..] else {
            refuse!("{name} must have the shape (height, width), not {}", argument.array.getattr("shape")?);
        };
        let sizes = 1..=MOST_TEXELS;
        if !sizes.contains(&width) || !sizes.contains(&height) {
            refuse!("{name} must have 1 to {MOST_TEXELS} rows and columns, not {height} and {width}");
        }
        let weights = argument.columns(&argument.shape)?.remove(0);
        if let Some(at) = weights.iter().position(|&weight| !(0.0..f32::INFINITY).contains(&weight)) {
            let place = argument.index(at, &argument.shape, None);
            refuse!("{place} must be finite in float32 and not negative, not {}", weights[at]);
        }
        Ok(Self { weights, width, height })
    }
}

/// The common shape of arguments, by numpy's rules.
pub(crate) fn broadcast(arguments: &[Argument<'_>]) -> PyResult<Vec<usize>> {
    let [first, _, ..] = arguments else { return Ok(arguments[0].shape.clone()) };
    let py = first.array.py();
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
/// The columns of all arguments, of one number for each element of `shape`.
pub(crate) fn columns(arguments: &[Argument<'_>], shape: &[usize]) -> PyResult<Columns> {
    let mut columns = Columns::new();
    for argument in arguments {
        let mut own = argument.columns(shape)?;
        if argument.kind == FieldKind::Vertex {
            for (column, first) in own.iter_mut().zip(&columns) {
                column.iter_mut().zip(first).for_each(|(x, from)| *x -= from);
            }
        }
        columns.append(&mut own);
    }
    Ok(columns)
}
/// The shape to which arguments are broadcast, and their columns.
pub(crate) fn together(fields: &[Field<'_, '_>]) -> PyResult<(Vec<usize>, Columns)> {
    let arguments = fields.iter().map(|&(name, kind, object)| Argument::new(name, kind, object));
    let arguments = arguments.collect::<PyResult<Vec<_>>>()?;
    let shape = broadcast(&arguments)?;
    let columns = columns(&arguments, &shape)?;
    Ok((shape, columns))
}
/// The numbers of arguments of one element each.
pub(crate) fn numbers(fields: &[Field<'_, '_>]) -> PyResult<Vec<f32>> {
    let arguments = fields.iter().map(|&(name, kind, object)| Argument::single(name, kind, object));
    Ok(columns(&arguments.collect::<PyResult<Vec<_>>>()?, &[])?.concat())
}
/// The point p.
pub(crate) fn point(p: &Object<'_>) -> PyResult<Vec3<f32>> {
    Ok(three(&numbers(&[("p", FieldKind::Row(3), p)])?))
}

/// The first three numbers as a vector.
pub(crate) fn three(numbers: &[f32]) -> Vec3<f32> {
    Vec3::new(numbers[0], numbers[1], numbers[2])
}
/// The first three columns as a vector.
pub(crate) fn vector<C: AsRef<[f32]>>(columns: &[C]) -> Vec3<&[f32]> {
    Vec3::new(columns[0].as_ref(), columns[1].as_ref(), columns[2].as_ref())
}
/// The columns for a range of elements.
pub(crate) fn cut(columns: &[Vec<f32>], range: Range<usize>) -> Vec<&[f32]> {
    columns.iter().map(|column| &column[range.clone()]).collect()
}
