//! Lights.

use crate::arrays::{Argument, FieldKind};
use crate::each::{Call, Each, Field, Given, Needs, numbers};
use crate::reflections::{self, Reflection};
use crate::samplers::{Sampler, single};
use crate::samples::Wanted;
use crate::spread::Spread;
use etendue::{Vec3, light};
use etendue_batch::{Batch, technique};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The numbers of one light.
fn one(fields: &[Field<'_, '_>]) -> PyResult<Vec<f32>> {
    let arguments = fields.iter().map(|&(name, kind, _, object)| Argument::single(name, kind, object));
    let columns = numbers(fields, &arguments.collect::<PyResult<Vec<_>>>()?, &[])?;
    Ok(columns.iter().flatten().copied().collect())
}

/// What a technique takes beside the point: what that is, of one light, and of columns of its numbers.
macro_rules! with {
    (needs (p, n)) => {
        Needs::Normal
    };
    (needs (p, reflection)) => {
        Needs::Reflection
    };
    (needs (p, spread)) => {
        Needs::Spread
    };
    (needs $place:tt) => {
        Needs::Nothing
    };
    (one n, $object:expr) => {
        single("n", $object)?
    };
    (one reflection, $object:expr) => {
        $object.cast::<Reflection>()?.get().reflection
    };
    (one spread, $object:expr) => {
        $object.cast::<Spread>()?.get().spread
    };
    (columns (p, n)) => {
        |x| Vec3::new(x[0], x[1], x[2])
    };
    (columns (p, reflection)) => {
        |x| reflections::build(x)
    };
    (columns (p, spread)) => {
        |x| light::Spread { tan_half: x[0], gain: x[1] }
    };
    (columns $place:tt) => {
        |_| ()
    };
}
/// A light prepared by a technique for what its method takes.
macro_rules! prepared {
    ($technique:ident, $light:expr;) => {
        Batch::new().prepare::<technique::$technique>(&$light, Vec3::default(), ())
    };
    ($technique:ident, $light:expr; $p:ident) => {
        Batch::new().prepare::<technique::$technique>(&$light, single("p", $p)?, ())
    };
    ($technique:ident, $light:expr; $p:ident, $with:ident) => {
        Batch::new().prepare::<technique::$technique>(&$light, single("p", $p)?, with!(one $with, $with))
    };
}
/// The kind of an argument.
macro_rules! kind {
    (number) => {
        FieldKind::Number
    };
    (direction) => {
        FieldKind::Normal
    };
    (corners) => {
        FieldKind::Corners
    };
    ($vector:ident) => {
        FieldKind::Row(3)
    };
}
/// A field of a light from the next numbers.
macro_rules! next {
    (number $numbers:ident) => {
        $numbers.next().expect("a light has so many numbers")
    };
    (corners $numbers:ident) => {
        core::array::from_fn(|_| next!(point $numbers))
    };
    ($vector:ident $numbers:ident) => {{
        let [x, y, z] = core::array::from_fn(|_| next!(number $numbers));
        Vec3::new(x, y, z)
    }};
}

/// The class of each light of the list, and what adds them to the module.
macro_rules! lights {
    ($(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident {
            $($(#[$field_doc:meta])* $field:ident as $argument:ident: $kind:ident,)+
        } by $default:tt {
            $(
                $(#[$doc:meta])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        $(light! {
            $(#[$light_doc])* $light $([$corners])? { $($(#[$field_doc])* $field as $argument: $kind,)+ } by $default {
                $($(#[$doc])* $technique: $by $place $place $($measure)?;)+
            }
        })+
        /// Adds the lights to the module.
        pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
            $(module.add_class::<$light>()?;)+
            Ok(())
        }
    };
}
/// The class of a light.
macro_rules! light {
    (
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? {
            $($(#[$field_doc:meta])* $field:ident as $argument:ident: $kind:ident,)+
        } by $default:tt {
            $($(#[$doc:meta])* $technique:ident: $by:ident($($place:ident),*) $whole:tt $($measure:ident)?;)+
        }
    ) => {
        $(#[$light_doc])*
        ///
        /// Arguments:
        $(
        #[doc = concat!("\n`", stringify!($argument), "`:")]
        $(#[$field_doc])*
        )+
        #[pyclass(module = "etendue", frozen)]
        pub(crate) struct $light {
            pub(crate) numbers: Vec<f32>,
        }
        impl $light {
            fn fields<'a, 'py, const N: usize>(values: [&'a Bound<'py, PyAny>; N]) -> [Field<'a, 'py>; N] {
                const FIELDS: &[(&str, FieldKind, &str)] = &[$((stringify!($argument), kind!($kind), stringify!($kind))),+];
                core::array::from_fn(|k| (FIELDS[k].0, FIELDS[k].1, FIELDS[k].2 == "vertex", values[k]))
            }
            pub(crate) fn build<X: Copy>(numbers: &[X]) -> light::$light<X $(, $corners)?> {
                let mut numbers = numbers.iter().copied();
                light::$light { $($field: next!($kind numbers)),+ }
            }
            fn each<'py>(
                py: Python<'py>,
                fields: &[Field<'_, 'py>],
                p: &Bound<'py, PyAny>,
                (given, by): (Given<'_, 'py>, &str),
                (call, wanted): (Call, Wanted<'_, 'py>),
                at: &Bound<'py, PyAny>,
            ) -> PyResult<Bound<'py, PyAny>> {
                $(if by == &stringify!($by)[3..] {
                    let each = Each::new(py, fields, p, (with!(needs $whole), given), call.argument(at))?;
                    return each.call::<technique::$technique>(py, (call, wanted), |x| Self::build(x), with!(columns $whole));
                })+
                let names = [$(&stringify!($by)[3..]),+];
                Err(PyValueError::new_err(format!("by must be one of {names:?}, not {by:?}")))
            }
        }
        #[pymethods]
        impl $light {
            #[new]
            fn new($($argument: &Bound<'_, PyAny>),+) -> PyResult<Self> {
                let fields = Self::fields([$($argument),+]);
                Ok(Self { numbers: one(&fields)? })
            }
            $($(#[$doc])*
            fn $by(&self $(, $place: &Bound<'_, PyAny>)*) -> PyResult<Sampler> {
                let sampler = prepared!($technique, Self::build(&self.numbers); $($place),*);
                let measure = None $(.or(Some((stringify!($measure), sampler.$measure()))))?;
                let technique = concat!(stringify!($light), " ", stringify!($by));
                Ok(Sampler::new(Box::new(sampler), technique, measure))
            })+
            /// Samples of a light of its own for each row, from a shading point of its own. All arrays are broadcast to one shape (...)
            /// beside their last axis: the constructor's arguments (..., 3) or (...), shading points p (..., 3), numbers u in [0, 1)²
            /// (..., 2), and the unit normals n (..., 3) at the shading points, for techniques that need them. `by` names the
            /// technique: "area" for `by_area`, and so on. By "reflection", which spheres and flat lights have, the arguments of a
            /// `Reflection` are needed, too: roughnesses alpha (...) and unit vectors view (..., 3) towards the viewer; by "spread", full angles
            /// spread (...) in radians. `fields` and `out` are those of `Sampler.sample`.
            #[staticmethod]
            #[pyo3(signature = ($($argument),+, *, p, u, n=None, alpha=None, view=None, spread=None, by=$default, fields=None, out=None))]
            #[allow(clippy::too_many_arguments)]
            fn sample_each<'py>(
                py: Python<'py>,
                $($argument: &Bound<'py, PyAny>,)+
                p: &Bound<'py, PyAny>,
                u: &Bound<'py, PyAny>,
                n: Option<&Bound<'py, PyAny>>,
                alpha: Option<&Bound<'py, PyAny>>,
                view: Option<&Bound<'py, PyAny>>,
                spread: Option<&Bound<'py, PyAny>>,
                by: &str,
                fields: Option<&Bound<'py, PyAny>>,
                out: Option<&Bound<'py, PyAny>>,
            ) -> PyResult<Bound<'py, PyAny>> {
                let light = Self::fields([$($argument),+]);
                Self::each(py, &light, p, (Given { n, alpha, view, spread }, by), (Call::Sample, Wanted { fields, out }), u)
            }
            /// The points of a light of its own for each row that unit directions w (..., 3) hit, as `sample_each` takes lights and points.
            #[staticmethod]
            #[pyo3(signature = ($($argument),+, *, p, w, n=None, alpha=None, view=None, spread=None, by=$default, fields=None, out=None))]
            #[allow(clippy::too_many_arguments)]
            fn hit_each<'py>(
                py: Python<'py>,
                $($argument: &Bound<'py, PyAny>,)+
                p: &Bound<'py, PyAny>,
                w: &Bound<'py, PyAny>,
                n: Option<&Bound<'py, PyAny>>,
                alpha: Option<&Bound<'py, PyAny>>,
                view: Option<&Bound<'py, PyAny>>,
                spread: Option<&Bound<'py, PyAny>>,
                by: &str,
                fields: Option<&Bound<'py, PyAny>>,
                out: Option<&Bound<'py, PyAny>>,
            ) -> PyResult<Bound<'py, PyAny>> {
                let light = Self::fields([$($argument),+]);
                Self::each(py, &light, p, (Given { n, alpha, view, spread }, by), (Call::Hit, Wanted { fields, out }), w)
            }
            /// The probability densities of unit directions w (..., 3), as `sample_each` takes lights and points.
            #[staticmethod]
            #[pyo3(signature = ($($argument),+, *, p, w, n=None, alpha=None, view=None, spread=None, by=$default, out=None))]
            #[allow(clippy::too_many_arguments)]
            fn pdf_each<'py>(
                py: Python<'py>,
                $($argument: &Bound<'py, PyAny>,)+
                p: &Bound<'py, PyAny>,
                w: &Bound<'py, PyAny>,
                n: Option<&Bound<'py, PyAny>>,
                alpha: Option<&Bound<'py, PyAny>>,
                view: Option<&Bound<'py, PyAny>>,
                spread: Option<&Bound<'py, PyAny>>,
                by: &str,
                out: Option<&Bound<'py, PyAny>>,
            ) -> PyResult<Bound<'py, PyAny>> {
                let light = Self::fields([$($argument),+]);
                Self::each(py, &light, p, (Given { n, alpha, view, spread }, by), (Call::Pdf, Wanted { fields: None, out }), w)
            }
            /// The numbers u in [0, 1)² that are mapped to unit directions w (..., 3), as `sample_each` takes lights and points.
            #[staticmethod]
            #[pyo3(signature = ($($argument),+, *, p, w, n=None, alpha=None, view=None, spread=None, by=$default, out=None))]
            #[allow(clippy::too_many_arguments)]
            fn invert_each<'py>(
                py: Python<'py>,
                $($argument: &Bound<'py, PyAny>,)+
                p: &Bound<'py, PyAny>,
                w: &Bound<'py, PyAny>,
                n: Option<&Bound<'py, PyAny>>,
                alpha: Option<&Bound<'py, PyAny>>,
                view: Option<&Bound<'py, PyAny>>,
                spread: Option<&Bound<'py, PyAny>>,
                by: &str,
                out: Option<&Bound<'py, PyAny>>,
            ) -> PyResult<Bound<'py, PyAny>> {
                let light = Self::fields([$($argument),+]);
                Self::each(py, &light, p, (Given { n, alpha, view, spread }, by), (Call::Invert, Wanted { fields: None, out }), w)
            }
            fn __repr__(&self) -> String {
                format!("<etendue.{} {:?}>", stringify!($light), self.numbers)
            }
        }
    };
}
etendue::techniques!(lights! {});
