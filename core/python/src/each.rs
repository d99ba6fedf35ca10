//! Lights and shading points of their own for each row.

use crate::arrays::{Columns, Field, FieldKind, cut, numbers, three, together, vector};
use crate::results::{Object, room};
use crate::samplers::Call;
use crate::samples::Wanted;
use etendue::{Vec2, Vec3};
use etendue_batch::{Batch, Technique};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

/// What techniques take beside the point, where they are given: unit normals, roughnesses and directions to the viewer.
#[derive(Clone, Copy, Default)]
pub(crate) struct Given<'a, 'py> {
    pub(crate) n: Option<&'a Object<'py>>,
    pub(crate) alpha: Option<&'a Object<'py>>,
    pub(crate) view: Option<&'a Object<'py>>,
}

/// What one technique takes beside the point.
pub(crate) trait Beside: Copy + Default {
    /// What a method takes for one point.
    fn one(object: &Object<'_>) -> PyResult<Self>;
    /// The arguments from which it is made for each row.
    fn fields<'a, 'py>(given: Given<'a, 'py>) -> PyResult<Vec<Field<'a, 'py>>>;
    /// Its numbers in columns, from those of the arguments.
    fn columns(_: Python<'_>, arguments: Columns) -> PyResult<Columns> {
        Ok(arguments)
    }
}
impl Beside for () {
    fn one(_: &Object<'_>) -> PyResult<Self> {
        Ok(())
    }
    fn fields<'a, 'py>(_: Given<'a, 'py>) -> PyResult<Vec<Field<'a, 'py>>> {
        Ok(Vec::new())
    }
}
impl Beside for Vec3<f32> {
    fn one(n: &Object<'_>) -> PyResult<Self> {
        Ok(three(&numbers(&[("n", FieldKind::Normal, n)])?))
    }
    fn fields<'a, 'py>(given: Given<'a, 'py>) -> PyResult<Vec<Field<'a, 'py>>> {
        let wrong = || PyTypeError::new_err("this technique needs n, the normals at the shading points");
        Ok(vec![("n", FieldKind::Normal, given.n.ok_or_else(wrong)?)])
    }
}

/// A call for rows with shading points of their own: what is asked, the points, and the numbers u or the directions w there.
#[derive(Clone, Copy)]
pub(crate) struct Rows<'a, 'py> {
    pub(crate) call: Call,
    pub(crate) p: &'a Object<'py>,
    pub(crate) at: &'a Object<'py>,
    pub(crate) given: Given<'a, 'py>,
    pub(crate) wanted: Wanted<'a, 'py>,
}

impl<'py> Rows<'_, 'py> {
    /// The results by the technique `T`, of lights whose numbers are in `fields`, or of one light for all rows where there are no fields.
    pub(crate) fn by<T>(self, light: T::Light<f32>, fields: &[Field<'_, 'py>]) -> PyResult<Object<'py>>
    where
        T: Technique<Light<f32>: Send + Sync, With<f32>: Beside>,
    {
        let Self { call, wanted, .. } = self;
        let (py, point, at) = (self.p.py(), ("p", FieldKind::Row(3), self.p), call.field(self.at));
        let (with, width) = (T::With::<f32>::fields(self.given)?, at.1.width());
        let (shape, mut lights) = together(&[fields, &[point, at], &with].concat())?;
        let mut p = lights.split_off(fields.iter().map(|field| field.1.width()).sum());
        let mut at = p.split_off(3);
        let with = T::With::<f32>::columns(py, at.split_off(width))?;
        if fields.is_empty() {
            let mut numbers = Vec::new();
            T::map_light(light, |number| numbers.push(number));
            for number in numbers {
                let mut column = room(at[0].len())?;
                column.resize(at[0].len(), number);
                lights.push(column);
            }
        }

        call.results(py, &shape, wanted, |range, out| {
            let [lights, p, with, at] = [&lights, &p, &with, &at].map(|columns| cut(columns, range.clone()));
            let (mut lights, mut with) = (lights.into_iter(), with.into_iter());
            let lights = T::map_light(light, |_| lights.next().expect("as many columns as a light has numbers"));
            let with = T::map_with(T::With::<f32>::default(), |_| with.next().expect("as many columns as numbers"));
            let batch = Batch::new();
            match call {
                Call::Sample => batch.sample_each::<T>(lights, vector(&p), with, Vec2::new(at[0], at[1]), out.hit),
                _ => batch.evaluate_each::<T>(lights, vector(&p), with, vector(&at), out),
            }
        })
    }
}

/// Implements the methods of a class: those in braces, and those for rows with shading points of their own. These begin with `$this` or, of a
/// class without it, with the arguments of a constructor; what they take beside the point is in `$given`, and `$body` calls [`Rows::by`].
macro_rules! with_each {
    (
        $class:ident { $($own:tt)* } $(#[$doc:meta])*
        ($($this:tt)*) [$($static:ident)?] $arguments:tt $given:tt $by:tt |$rows:ident| $body:expr
    ) => {
        $crate::each::with_each! { @ $class { $($own)* }
            $(#[$doc])* [$($static)?]
            sample_each Sample(fields, out) ($($this)*) $arguments u $given $by |$rows| $body;
            /// What unit directions w (..., 3) hit of the light, which is given as to `sample_each`.
            [$($static)?]
            hit_each Hit(fields, out) ($($this)*) $arguments w $given $by |$rows| $body;
            /// The probability densities of unit directions w (..., 3), of a light that is given as to `sample_each`.
            [$($static)?]
            pdf_each Pdf(out) ($($this)*) $arguments w $given $by |$rows| $body;
            /// The numbers u in [0, 1)² that are mapped to unit directions w (..., 3), by a light that is given as to `sample_each`.
            [$($static)?]
            invert_each Invert(out) ($($this)*) $arguments w $given $by |$rows| $body;
        }
    };
    (@ $class:ident { $($own:tt)* } $(
        $(#[$doc:meta])* [$($static:ident)?] $name:ident $call:ident($($wanted:ident),+) ($($this:tt)*)
        ($($argument:ident),*) $at:ident ($($given:ident),*) ($($by:ident: $type:ty = $default:tt)?) |$rows:ident| $body:expr;
    )+) => {
        #[pymethods]
        impl $class {
            $($own)*
            $(
            $(#[$doc])*
            $(#[$static])?
            #[pyo3(signature = ($($argument,)* *, p, $at, $($given=None,)* $($by=$default,)? $($wanted=None),+))]
            #[allow(clippy::too_many_arguments, clippy::needless_update)]
            fn $name<'py>(
                $($this)*
                $($argument: &Object<'py>,)*
                p: &Object<'py>,
                $at: &Object<'py>,
                $($given: Option<&Object<'py>>,)*
                $($by: $type,)?
                $($wanted: Option<&Object<'py>>),+
            ) -> PyResult<Object<'py>> {
                let given = Given { $($given,)* ..Given::default() };
                let wanted = Wanted { $($wanted,)+ ..Wanted::default() };
                let $rows = Rows { call: Call::$call, p, at: $at, given, wanted };
                $body
            }
            )+
        }
    };
}
pub(crate) use with_each;
