//! Lights.

use crate::arrays::{Argument, FieldKind};
use crate::each::{Call, Each, Field, numbers};
use crate::reflections::{self, Reflection};
use crate::samplers::{Sampler, single};
use etendue::{Vec3, light};
use etendue_batch::{Batch, BatchTechnique, InTable, LightFunctions, Reflected};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// What techniques need of surfaces: the normals, and by reflection roughnesses and directions to the viewer.
type Surface<'a, 'py> = (Option<&'a Bound<'py, PyAny>>, &'a [Option<&'a Bound<'py, PyAny>>]);

/// The numbers of one light.
fn one(fields: &[Field<'_, '_>]) -> PyResult<Vec<f32>> {
    let arguments = fields.iter().map(|&(name, kind, _, object)| Argument::single(name, kind, object));
    let columns = numbers(fields, &arguments.collect::<PyResult<Vec<_>>>()?, &[])?;
    Ok(columns.iter().flatten().copied().collect())
}

/// Prepares a light for a point p and a normal n, or for those of them that the technique needs.
fn prepare<T>(light: &T::Light<f32>, place: &[(&'static str, &Bound<'_, PyAny>)]) -> PyResult<T>
where
    T: BatchTechnique + InTable<Functions = LightFunctions<T>>,
{
    let mut vectors = [Vec3::default(); 2];
    for (&(name, object), vector) in place.iter().zip(&mut vectors) {
        *vector = single(name, object)?;
    }
    Ok(Batch::new().prepare::<T>(light, vectors[0], vectors[1]))
}
/// The kind of an argument.
macro_rules! kind {
    (number) => {
        FieldKind::Number
    };
    (direction) => {
        FieldKind::Direction
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

/// What `by` is by reflection.
macro_rules! by_reflection {
    ($lobe:ident) => {
        "reflection"
    };
}

/// Each light of the list, and what adds them to the module.
macro_rules! lights {
    ($(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident { $($fields:tt)* }
        $(reflected { $($lobe:tt)* })? by $default:tt { $($techniques:tt)* }
    )+) => {
        $(light! {
            $(reflected { $($lobe)* })?
            $(#[$light_doc])* $light $([$corners])? { $($fields)* } by $default { $($techniques)* }
        })+
        /// Adds the lights to the module.
        pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
            $(module.add_class::<$light>()?;)+
            Ok(())
        }
    };
}
/// The class of a light. By reflection, its functions with a light of its own for each row take two arguments more.
macro_rules! light {
    (reflected { $($lobe:tt)* } $($light:tt)+) => {
        light! { @ [alpha, view] [$($lobe)*] $($light)+ }
    };
    (@ [$($more:ident),*] [$(
        $(#[$lobe_doc:meta])* $lobe:ident $([$lobe_n:literal])? $(= $lobe_c:ident, $lobe_name:ident[$lobe_size:literal])?;
    )?]
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? {
            $($(#[$field_doc:meta])* $field:ident as $argument:ident: $kind:ident,)+
        } by $default:tt {
            $(
                $(#[$doc:meta])* $sampler:ident $([$n:literal])?
                    $(= $sampler_c:ident, $technique:ident[$size:literal])?: $by:ident($($place:ident),*) $($measure:ident)?;
            )+
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
            fn each(
                py: Python<'_>,
                fields: &[Field<'_, '_>],
                p: &Bound<'_, PyAny>,
                (n, lobe): Surface<'_, '_>,
                by: &str,
                call: Call,
                at: &Bound<'_, PyAny>,
            ) -> PyResult<Py<PyAny>> {
                let names = [$(&stringify!($by)[3..],)+ $(by_reflection!($lobe))?];
                if !names.contains(&by) {
                    return Err(PyValueError::new_err(format!("by must be one of {names:?}, not {by:?}")));
                }
                $(if by == by_reflection!($lobe) {
                    let (Some(_), &[Some(alpha), Some(view)]) = (n, lobe) else {
                        let message = "by reflection, n, alpha and view are needed: normals, roughnesses and directions to the viewer";
                        return Err(PyTypeError::new_err(message));
                    };
                    let each = Each::new(py, fields, p, n, Some([alpha, view]), call.argument(at))?;
                    return each.call::<light::$lobe<f32 $(, $lobe_n)?>>(py, call, |x| {
                        let (light, numbers) = x.split_at(x.len() - reflections::NUMBERS);
                        Reflected { light: Self::build(light).into(), reflection: reflections::build(numbers) }
                    });
                })?
                let _ = lobe;
                let each = Each::new(py, fields, p, n, None, call.argument(at))?;
                $(if by == &stringify!($by)[3..] {
                    return each.call::<light::$sampler<f32 $(, $n)?>>(py, call, |x| Self::build(x).into());
                })+
                unreachable!("by is one of the names")
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
                let place = [$((stringify!($place), $place)),*];
                let sampler = prepare::<light::$sampler<f32 $(, $n)?>>(&Self::build(&self.numbers).into(), &place)?;
                let measure = None $(.or(Some((stringify!($measure), sampler.$measure()))))?;
                let technique = concat!(stringify!($light), " ", stringify!($by));
                Ok(Sampler::new(Box::new(sampler), technique, measure))
            })+
            $($(#[$lobe_doc])*
            fn by_reflection(&self, p: &Bound<'_, PyAny>, reflection: &Bound<'_, Reflection>) -> PyResult<Sampler> {
                let reflected = Reflected { light: Self::build(&self.numbers).into(), reflection: reflection.get().reflection };
                let sampler = Batch::new().prepare::<light::$lobe<f32 $(, $lobe_n)?>>(&reflected, single("p", p)?, Vec3::default());
                let measure = Some(("projected_solid_angle", sampler.projected_solid_angle()));
                Ok(Sampler::new(Box::new(sampler), concat!(stringify!($light), " by_reflection"), measure))
            })?
            /// Samples of a light of its own for each row, from a shading point of its own. All arrays are broadcast to one shape (...)
            /// beside their last axis: the constructor's arguments (..., 3) or (...), shading points p (..., 3), numbers u in [0, 1)²
            /// (..., 2), and the unit normals n (..., 3) at the shading points, for techniques that need them. `by` names the
            /// technique: "area" for `by_area`, and so on. By "reflection", which spheres and flat lights have, the arguments of a
            /// `Reflection` are needed, too: roughnesses alpha (...) and unit vectors view (..., 3) towards the viewer.
            #[staticmethod]
            #[pyo3(signature = ($($argument),+, *, p, u, n=None $(, $more=None)*, by=$default))]
            #[allow(clippy::too_many_arguments)]
            fn sample_each(
                py: Python<'_>,
                $($argument: &Bound<'_, PyAny>,)+
                p: &Bound<'_, PyAny>,
                u: &Bound<'_, PyAny>,
                n: Option<&Bound<'_, PyAny>>,
                $($more: Option<&Bound<'_, PyAny>>,)*
                by: &str,
            ) -> PyResult<Py<PyAny>> {
                let fields = Self::fields([$($argument),+]);
                Self::each(py, &fields, p, (n, &[$($more),*]), by, Call::Sample, u)
            }
            /// The points of a light of its own for each row that unit directions w (..., 3) hit, as `sample_each` takes lights and points.
            #[staticmethod]
            #[pyo3(signature = ($($argument),+, *, p, w, n=None $(, $more=None)*, by=$default))]
            #[allow(clippy::too_many_arguments)]
            fn hit_each(
                py: Python<'_>,
                $($argument: &Bound<'_, PyAny>,)+
                p: &Bound<'_, PyAny>,
                w: &Bound<'_, PyAny>,
                n: Option<&Bound<'_, PyAny>>,
                $($more: Option<&Bound<'_, PyAny>>,)*
                by: &str,
            ) -> PyResult<Py<PyAny>> {
                let fields = Self::fields([$($argument),+]);
                Self::each(py, &fields, p, (n, &[$($more),*]), by, Call::Hit, w)
            }
            /// The probability densities of unit directions w (..., 3), as `sample_each` takes lights and points.
            #[staticmethod]
            #[pyo3(signature = ($($argument),+, *, p, w, n=None $(, $more=None)*, by=$default))]
            #[allow(clippy::too_many_arguments)]
            fn pdf_each(
                py: Python<'_>,
                $($argument: &Bound<'_, PyAny>,)+
                p: &Bound<'_, PyAny>,
                w: &Bound<'_, PyAny>,
                n: Option<&Bound<'_, PyAny>>,
                $($more: Option<&Bound<'_, PyAny>>,)*
                by: &str,
            ) -> PyResult<Py<PyAny>> {
                let fields = Self::fields([$($argument),+]);
                Self::each(py, &fields, p, (n, &[$($more),*]), by, Call::Pdf, w)
            }
            /// The numbers u in [0, 1)² that are mapped to unit directions w (..., 3), as `sample_each` takes lights and points.
            #[staticmethod]
            #[pyo3(signature = ($($argument),+, *, p, w, n=None $(, $more=None)*, by=$default))]
            #[allow(clippy::too_many_arguments)]
            fn invert_each(
                py: Python<'_>,
                $($argument: &Bound<'_, PyAny>,)+
                p: &Bound<'_, PyAny>,
                w: &Bound<'_, PyAny>,
                n: Option<&Bound<'_, PyAny>>,
                $($more: Option<&Bound<'_, PyAny>>,)*
                by: &str,
            ) -> PyResult<Py<PyAny>> {
                let fields = Self::fields([$($argument),+]);
                Self::each(py, &fields, p, (n, &[$($more),*]), by, Call::Invert, w)
            }
            fn __repr__(&self) -> String {
                format!("<etendue.{} {:?}>", stringify!($light), self.numbers)
            }
        }
    };
    ($($light:tt)+) => {
        light! { @ [] [] $($light)+ }
    };
}
etendue::techniques!(lights! {});
