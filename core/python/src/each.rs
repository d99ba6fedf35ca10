//! Lights and shading points of their own for each row.

use crate::arrays::{Argument, FieldKind, array, broadcast, room, rows, run, zero_columns, zeros};
use crate::reflections::reflections;
use crate::samplers::{Samples, vector};
use etendue::{Vec2, Vec3};
use etendue_batch::{Batch, BatchTechnique, Evaluations};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

/// An argument of a light's constructor: its name, its kind, whether it is a vertex of which the core keeps the edge from the first one, and
/// its value.
pub(crate) type Field<'a, 'py> = (&'static str, FieldKind, bool, &'a Bound<'py, PyAny>);

/// The numbers of a light in columns, in the order of the core.
pub(crate) fn numbers(
    fields: &[Field<'_, '_>],
    arguments: &[Argument<'_>],
    shape: &[usize],
) -> PyResult<Vec<Vec<f32>>> {
    let mut columns: Vec<Vec<f32>> = Vec::new();
    for (&(_, _, is_vertex, _), argument) in fields.iter().zip(arguments) {
        let mut own = argument.columns(shape)?;
        if is_vertex {
            for (column, first) in own.iter_mut().zip(&columns) {
                column.iter_mut().zip(first).for_each(|(x, from)| *x -= from);
            }
        }
        columns.append(&mut own);
    }
    Ok(columns)
}

/// Lights and shading points of their own for each row, and the numbers u or the directions w there.
pub(crate) struct Each {
    shape: Vec<usize>,
    light: Vec<Vec<f32>>,
    p: Vec<Vec<f32>>,
    n: Option<Vec<Vec<f32>>>,
    at: Vec<Vec<f32>>,
}

/// What is done with each row.
#[derive(Clone, Copy)]
pub(crate) enum Call {
    Sample,
    Hit,
    Pdf,
    Invert,
}

impl Call {
    /// What it takes, for each row: numbers u or directions w.
    pub(crate) fn argument<'a, 'py>(
        self,
        at: &'a Bound<'py, PyAny>,
    ) -> (&'static str, FieldKind, &'a Bound<'py, PyAny>) {
        if let Self::Sample = self { ("u", FieldKind::Units, at) } else { ("w", FieldKind::Direction, at) }
    }
}

impl Each {
    pub(crate) fn new(
        py: Python<'_>,
        fields: &[Field<'_, '_>],
        p: &Bound<'_, PyAny>,
        n: Option<&Bound<'_, PyAny>>,
        lobe: Option<[&Bound<'_, PyAny>; 2]>,
        (name, kind, at): (&'static str, FieldKind, &Bound<'_, PyAny>),
    ) -> PyResult<Self> {
        let arguments = fields.iter().map(|&(name, kind, _, object)| Argument::new(name, kind, object));
        let arguments = arguments.collect::<PyResult<Vec<_>>>()?;
        let lobe = lobe.map(|[alpha, view]| {
            Ok::<_, PyErr>([
                Argument::new("alpha", FieldKind::Number, alpha)?,
                Argument::new("view", FieldKind::Direction, view)?,
            ])
        });
        let lobe = lobe.transpose()?;
        let (p, at) = (Argument::new("p", FieldKind::Row(3), p)?, Argument::new(name, kind, at)?);
        let n = n.map(|n| Argument::new("n", FieldKind::Direction, n)).transpose()?;
        let all = arguments.iter().chain([&p, &at]).chain(&n).chain(lobe.iter().flatten());
        let shape = broadcast(py, &all.collect::<Vec<_>>())?;
        let mut light = numbers(fields, &arguments, &shape)?;
        let n = n.map(|n| n.columns(&shape)).transpose()?;
        if let (Some(n), Some([alpha, view])) = (&n, lobe) {
            light.extend(reflections(py, &alpha.columns(&shape)?[0], n, &view.columns(&shape)?)?);
        }
        Ok(Self { light, p: p.columns(&shape)?, n, at: at.columns(&shape)?, shape })
    }
    /// One light, of these numbers, for all rows.
    pub(crate) fn of_one(
        py: Python<'_>,
        numbers: &[f32],
        p: &Bound<'_, PyAny>,
        n: Option<&Bound<'_, PyAny>>,
        call: Call,
        at: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let mut this = Self::new(py, &[], p, n, None, call.argument(at))?;
        for &number in numbers {
            let mut column = room(this.at[0].len())?;
            column.resize(this.at[0].len(), number);
            this.light.push(column);
        }
        Ok(this)
    }
    /// Calls a function of the technique `T` for all rows.
    pub(crate) fn call<T: BatchTechnique>(
        self,
        py: Python<'_>,
        call: Call,
        build: impl for<'a> Fn(&[&'a [f32]]) -> T::Light<&'a [f32]> + Send + Sync,
    ) -> PyResult<Py<PyAny>> {
        let Self { shape, light, p, n, at } = self;
        if T::ON_SURFACE && n.is_none() {
            return Err(PyTypeError::new_err("this technique needs n, the normals at the shading points"));
        }
        let light: Vec<_> = light.iter().map(Vec::as_slice).collect();
        let normals = n.as_deref().map_or(Vec3::new(&[][..], &[][..], &[][..]), vector);
        let evaluate = |out: Evaluations<'_>| {
            Batch::new().evaluate_each::<T>(build(&light), vector(&p), normals, vector(&at), out);
        };
        let count = at[0].len();
        Ok(match call {
            Call::Sample => {
                let u = Vec2::new(&at[0][..], &at[1][..]);
                let sample = |out: etendue_batch::Samples<'_>| {
                    Batch::new().sample_each::<T>(build(&light), vector(&p), normals, u, out);
                };
                Py::new(py, Samples::of(py, shape, sample)?)?.into_any()
            }
            Call::Hit => {
                let hit = |hit: etendue_batch::Samples<'_>| evaluate(Evaluations { hit, ..Evaluations::default() });
                Py::new(py, Samples::of(py, shape, hit)?)?.into_any()
            }
            Call::Pdf => {
                let mut out = zeros(count)?;
                run(py, count, || evaluate(Evaluations { pdf: &mut out, ..Evaluations::default() }));
                array(py, &shape, out)?.unbind()
            }
            Call::Invert => {
                let mut out = zero_columns::<2>(count)?;
                run(py, count, || {
                    let [x, y] = &mut out;
                    evaluate(Evaluations { u: [x, y], ..Evaluations::default() });
                });
                rows(py, &shape, &out)?.unbind()
            }
        })
    }
}
