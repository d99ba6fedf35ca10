//! Lights and shading points of their own for each row.

use crate::arrays::{Argument, FieldKind, broadcast};
use crate::reflections::reflections;
use crate::results::{Target, given_or_new, room, run};
use crate::samplers::{cut, numbers as numbers_of, vector};
use crate::samples::{Samples, Wanted};
use etendue::Vec2;
use etendue::light::Spread;
use etendue_batch::{Batch, Evaluations, Technique};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use std::ops::Range;

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

/// What techniques take beside the point, where they are given: unit normals, roughnesses and directions to the viewer, and angles of spreads.
#[derive(Clone, Copy, Default)]
pub(crate) struct Given<'a, 'py> {
    pub(crate) n: Option<&'a Bound<'py, PyAny>>,
    pub(crate) alpha: Option<&'a Bound<'py, PyAny>>,
    pub(crate) view: Option<&'a Bound<'py, PyAny>>,
    pub(crate) spread: Option<&'a Bound<'py, PyAny>>,
}

/// What one technique takes beside the point.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Needs {
    Nothing,
    Normal,
    Reflection,
    Spread,
}

impl Needs {
    /// The arguments from which it is made.
    fn arguments<'py>(self, given: Given<'_, 'py>) -> PyResult<Vec<Argument<'py>>> {
        let wrong = |message: &str| Err(PyTypeError::new_err(message.to_owned()));
        let direction = |name, object| Argument::new(name, FieldKind::Normal, object);
        match (self, given) {
            (Self::Nothing, _) => Ok(Vec::new()),
            (Self::Normal, Given { n: Some(n), .. }) => Ok(vec![direction("n", n)?]),
            (Self::Reflection, Given { n: Some(n), alpha: Some(alpha), view: Some(view), .. }) => Ok(vec![
                Argument::new("alpha", FieldKind::Number, alpha)?,
                direction("n", n)?,
                direction("view", view)?,
            ]),
            (Self::Spread, Given { spread: Some(spread), .. }) => {
                Ok(vec![Argument::new("spread", FieldKind::Number, spread)?])
            }
            (Self::Normal, _) => wrong("this technique needs n, the normals at the shading points"),
            (Self::Reflection, _) => {
                wrong("by reflection, n, alpha and view are needed: normals, roughnesses and directions to the viewer")
            }
            (Self::Spread, _) => wrong("by spread, spread is needed: full angles in radians"),
        }
    }
    /// Its numbers in columns.
    fn columns(self, py: Python<'_>, arguments: &[Argument<'_>], shape: &[usize]) -> PyResult<Vec<Vec<f32>>> {
        let columns = arguments.iter().map(|argument| argument.columns(shape)).collect::<PyResult<Vec<_>>>()?;
        match (self, &columns[..]) {
            (Self::Reflection, [alpha, n, view]) => reflections(py, &alpha[0], n, view),
            (Self::Spread, [angles]) => {
                let spreads = angles[0].iter().map(|&angle| Spread::<f32>::new(f64::from(angle)));
                let (tan_half, gain) = spreads.map(|spread| (spread.tan_half, spread.gain)).unzip();
                Ok(vec![tan_half, gain])
            }
            _ => Ok(columns.concat()),
        }
    }
}

/// Lights and shading points of their own for each row, and the numbers u or the directions w there.
pub(crate) struct Each {
    shape: Vec<usize>,
    light: Vec<Vec<f32>>,
    p: Vec<Vec<f32>>,
    with: Vec<Vec<f32>>,
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
        (needs, given): (Needs, Given<'_, '_>),
        (name, kind, at): (&'static str, FieldKind, &Bound<'_, PyAny>),
    ) -> PyResult<Self> {
        let arguments = fields.iter().map(|&(name, kind, _, object)| Argument::new(name, kind, object));
        let arguments = arguments.collect::<PyResult<Vec<_>>>()?;
        let with = needs.arguments(given)?;
        let (p, at) = (Argument::new("p", FieldKind::Row(3), p)?, Argument::new(name, kind, at)?);
        let all = arguments.iter().chain([&p, &at]).chain(&with);
        let shape = broadcast(py, &all.collect::<Vec<_>>())?;
        let (light, with) = (numbers(fields, &arguments, &shape)?, needs.columns(py, &with, &shape)?);
        Ok(Self { light, p: p.columns(&shape)?, with, at: at.columns(&shape)?, shape })
    }
    /// One light, of these numbers, for all rows.
    pub(crate) fn of_one(
        py: Python<'_>,
        numbers: &[f32],
        p: &Bound<'_, PyAny>,
        with: (Needs, Given<'_, '_>),
        call: Call,
        at: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let mut this = Self::new(py, &[], p, with, call.argument(at))?;
        for &number in numbers {
            let mut column = room(this.at[0].len())?;
            column.resize(this.at[0].len(), number);
            this.light.push(column);
        }
        Ok(this)
    }
    /// Calls a function of the technique `T` for all rows.
    pub(crate) fn call<'py, T: Technique>(
        self,
        py: Python<'py>,
        (call, wanted): (Call, Wanted<'_, 'py>),
        light_of: impl for<'a> Fn(&[&'a [f32]]) -> T::Light<&'a [f32]> + Send + Sync,
        with_of: impl for<'a> Fn(&[&'a [f32]]) -> T::With<&'a [f32]> + Send + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        let Self { shape, light, p, with, at } = self;
        let [light, p, with, at] = &[light, p, with, at];
        let evaluate = |range: Range<usize>, out: Evaluations<'_>| {
            let [light, p, with, w] = [light, p, with, at].map(|columns| cut(columns, range.clone()));
            Batch::new().evaluate_each::<T>(light_of(&light), vector(&p), with_of(&with), vector(&w), out);
        };
        let count = at[0].len();
        Ok(match call {
            Call::Sample => {
                let sample = |range: Range<usize>, out: etendue_batch::Samples<'_>| {
                    let [light, p, with, u] = [light, p, with, at].map(|columns| cut(columns, range.clone()));
                    let u = Vec2::new(u[0], u[1]);
                    Batch::new().sample_each::<T>(light_of(&light), vector(&p), with_of(&with), u, out);
                };
                Samples::of(py, &shape, wanted, sample)?.into_any()
            }
            Call::Hit => {
                let hit = |range: Range<usize>, hit: etendue_batch::Samples<'_>| {
                    evaluate(range, Evaluations { hit, ..Evaluations::default() });
                };
                Samples::of(py, &shape, wanted, hit)?.into_any()
            }
            Call::Pdf => {
                let array = given_or_new(py, &shape, wanted.out)?;
                let mut target = Target::of(Some(&array), count)?;
                let pdf = target.numbers();
                run(py, count, || evaluate(0..count, Evaluations { pdf, ..Evaluations::default() }));
                array.clone().into_any()
            }
            Call::Invert => numbers_of(py, &shape, wanted.out, |range, u| {
                evaluate(range, Evaluations { u, ..Evaluations::default() });
            })?,
        })
    }
}
