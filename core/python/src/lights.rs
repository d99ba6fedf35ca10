//! Lights.

use crate::arrays::{Field, FieldKind, numbers, point};
use crate::each::{Beside, Given, Rows, with_each};
use crate::results::{Object, refuse};
use crate::samplers::{Call, Sampler};
use crate::samples::Wanted;
use etendue::{Vec3, light};
use etendue_batch::{Batch, technique};
use pyo3::prelude::*;

/// The most numbers of a light: those of a polygon.
const MOST_NUMBERS: usize = 24;

/// A light prepared by a technique for what its method takes.
macro_rules! prepared {
    ($technique:ident, $light:expr;) => {
        Batch::new().prepare::<technique::$technique>(&$light, Vec3::default(), ())
    };
    ($technique:ident, $light:expr; $p:ident) => {
        Batch::new().prepare::<technique::$technique>(&$light, point($p)?, ())
    };
    ($technique:ident, $light:expr; $p:ident, $with:ident) => {
        Batch::new().prepare::<technique::$technique>(&$light, point($p)?, Beside::one($with)?)
    };
}
/// The kind of an argument.
macro_rules! kind {
    (radius: number) => {
        FieldKind::Radius
    };
    ($name:ident: $kind:ident) => {
        kind!($kind)
    };
    (number) => {
        FieldKind::Number
    };
    (direction) => {
        FieldKind::Normal
    };
    (corners) => {
        FieldKind::Corners
    };
    (vertex) => {
        FieldKind::Vertex
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
            pub(crate) fn build<X: Copy>(numbers: &[X]) -> light::$light<X $(, $corners)?> {
                let mut numbers = numbers.iter().copied();
                light::$light { $($field: next!($kind numbers)),+ }
            }
            fn each<'py>(by: &str, rows: Rows<'_, 'py>, fields: &[Field<'_, 'py>]) -> PyResult<Object<'py>> {
                $(if by == &stringify!($by)[3..] {
                    return rows.by::<technique::$technique>(Self::build(&[0.0; MOST_NUMBERS]), fields);
                })+
                let names = [$(&stringify!($by)[3..]),+];
                refuse!("by must be one of {names:?}, not {by:?}")
            }
        }
        with_each! { $light {
            #[new]
            fn new($($argument: &Object<'_>),+) -> PyResult<Self> {
                Ok(Self { numbers: numbers(&[$((stringify!($argument), kind!($argument: $kind), $argument)),+])? })
            }
            $($(#[$doc])*
            fn $by(&self $(, $place: &Object<'_>)*) -> PyResult<Sampler> {
                let sampler = prepared!($technique, Self::build(&self.numbers); $($place),*);
                let measure = None $(.or(Some((stringify!($measure), sampler.$measure()))))?;
                let technique = concat!(stringify!($light), " ", stringify!($by));
                Ok(Sampler::new(Box::new(sampler), technique, measure))
            })+
            /// Whether the point p is on the light, or in the plane of a flat one, to within the rounding of its own computation: 16 units of the
            /// last place of the greatest coordinate. True of every point of the light that was computed, about half of which are in
            /// front of it through rounding and would be lit by it: pass over the light then. False for lights without a surface.
            fn on_surface(&self, p: &Object<'_>) -> PyResult<bool> {
                Ok(Self::build(&self.numbers).on_surface(point(p)?))
            }
            fn __repr__(&self) -> String {
                format!("<etendue.{} {:?}>", stringify!($light), self.numbers)
            }
        }
        /// Samples of a light of its own for each row, from a shading point of its own. All arrays are broadcast to one shape (...)
        /// beside their last axis: the constructor's arguments (..., 3) or (...), shading points p (..., 3), numbers u in [0, 1)²
        /// (..., 2), and the unit normals n (..., 3) at the shading points, for techniques that need them. `by` names the
        /// technique: "area" for `by_area`, and so on. By "reflection", which spheres and flat lights have, the arguments of a
        /// `Reflection` are needed, too: roughnesses alpha (...) and unit vectors view (..., 3) towards the viewer. `fields` and `out` are those of `Sampler.sample`.
        () [staticmethod] ($($argument),+) (n, alpha, view) (by: &str = $default)
        |rows| Self::each(by, rows, &[$((stringify!($argument), kind!($argument: $kind), $argument)),+]) }
    };
}
etendue::techniques!(lights! {});
