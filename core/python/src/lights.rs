//! Lights, and lights prepared for a shading point.

use crate::arrays::{Argument, FieldKind, array, broadcast, room, rows, run, zero_columns, zeros};
use crate::reflections::{self, Reflection, reflections};
use etendue::{Vec2, Vec3, light};
use etendue_batch::{Batch, BatchTechnique, Evaluations, InTable, LightFunctions, Reflected};
use pyo3::exceptions::{PyAttributeError, PyTypeError, PyValueError};
use pyo3::prelude::*;

/// A light prepared by any technique.
pub(crate) trait Prepared: Send + Sync {
    fn sample(&self, u: Vec2<&[f32]>, out: etendue_batch::Samples<'_>);
    fn hit(&self, w: Vec3<&[f32]>, out: etendue_batch::Samples<'_>);
    fn pdf(&self, w: Vec3<&[f32]>, out: &mut [f32]);
    fn invert(&self, w: Vec3<&[f32]>, out: Vec2<&mut [f32]>);
}
impl<T: BatchTechnique + InTable<Functions = LightFunctions<T>> + Send + Sync> Prepared for T {
    fn sample(&self, u: Vec2<&[f32]>, out: etendue_batch::Samples<'_>) {
        Batch::new().sample(self, u, out);
    }
    fn hit(&self, w: Vec3<&[f32]>, out: etendue_batch::Samples<'_>) {
        Batch::new().hit(self, w, out);
    }
    fn pdf(&self, w: Vec3<&[f32]>, out: &mut [f32]) {
        Batch::new().pdf(self, w, out);
    }
    fn invert(&self, w: Vec3<&[f32]>, out: Vec2<&mut [f32]>) {
        Batch::new().invert(self, w, out);
    }
}

/// Three columns as a vector.
pub(crate) fn vector(columns: &[Vec<f32>]) -> Vec3<&[f32]> {
    Vec3::new(&columns[0], &columns[1], &columns[2])
}

/// Samples of a light, or the points of it that directions hit, in arrays of one shape (...).
///
/// The estimator of reflected radiance is f · L · cosθ · weight, where nothing is in the way from the shading point along `direction` up
/// to `distance`. The weight is 0 where there is no sample and where the light does not emit towards the point.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct Samples {
    /// Unit directions from the shading point to the light, (..., 3).
    #[pyo3(get)]
    direction: Py<PyAny>,
    /// Distances to the light along them, in the unit of the coordinates; the largest float32 for suns.
    #[pyo3(get)]
    distance: Py<PyAny>,
    /// Probability densities of the directions, per steradian (lines: see `Line`); 0 where there is no sample.
    #[pyo3(get)]
    pdf: Py<PyAny>,
    /// 1/pdf where there is a sample and the light emits towards the shading point, else 0.
    #[pyo3(get)]
    weight: Py<PyAny>,
    /// Unit normals of the light, (..., 3).
    #[pyo3(get)]
    normal: Py<PyAny>,
    /// Surface coordinates in [0, 1]², (..., 2).
    #[pyo3(get)]
    uv: Py<PyAny>,
    /// Whether the shading point is on the side of the light that emits: bool.
    #[pyo3(get)]
    emits: Py<PyAny>,
}

#[pymethods]
impl Samples {
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<etendue.Samples of shape {}>", self.pdf.bind(py).getattr("shape")?))
    }
}

impl Samples {
    /// The samples that `batch` writes, one for each element of `shape`.
    fn of(py: Python<'_>, shape: Vec<usize>, batch: impl FnOnce(etendue_batch::Samples<'_>) + Send) -> PyResult<Self> {
        let n = shape.iter().product();
        let mut columns = zero_columns::<11>(n)?;
        let mut emits = zeros::<u8>(n)?;
        run(py, n, || {
            let [x, y, z, distance, pdf, weight, nx, ny, nz, u, v] = columns.each_mut().map(Vec::as_mut_slice);
            let (direction, normal, uv) = ([x, y, z], [nx, ny, nz], [u, v]);
            batch(etendue_batch::Samples { direction, distance, pdf, weight, normal, uv, emits: &mut emits });
        });
        let direction = rows(py, &shape, &columns[..3])?.unbind();
        let normal = rows(py, &shape, &columns[6..9])?.unbind();
        let uv = rows(py, &shape, &columns[9..])?.unbind();
        let [_, _, _, distance, pdf, weight, ..] = columns;
        let [distance, pdf, weight] = [distance, pdf, weight].map(|column| array(py, &shape, column));
        let emits = array(py, &shape, emits.into_iter().map(|emits| emits != 0).collect())?.unbind();
        let (distance, pdf, weight) = (distance?.unbind(), pdf?.unbind(), weight?.unbind());
        Ok(Self { direction, distance, pdf, weight, normal, uv, emits })
    }
}

/// A light prepared for one shading point by one technique: `light.by_…` makes it, and it draws as often as needed.
///
/// What is easily done wrong: directions and normals that are not of length 1 raise ValueError. With the opposite normal, a light by
/// projected solid angle is below the surface, and has pdf 0. A light seen from behind has a pdf, but `emits` is False and the weight 0;
/// one of two sides has the weight 1/pdf. From a point on a flat light the pdf is 0; from one on a curved light rounding decides whether
/// it is inside. A direction computed anew from the point of a sample has other last bits, and may miss beside an edge: keep the
/// `direction` and the `pdf` of the sample.
#[pyclass(module = "etendue", frozen)]
pub(crate) struct Sampler {
    prepared: Box<dyn Prepared>,
    technique: &'static str,
    /// The size of the light in the measure of the technique, and the name of that measure.
    measure: Option<(&'static str, f32)>,
}

impl Sampler {
    pub(crate) fn new(
        prepared: Box<dyn Prepared>,
        technique: &'static str,
        measure: Option<(&'static str, f32)>,
    ) -> Self {
        Self { prepared, technique, measure }
    }
    fn measure(&self, name: &str) -> PyResult<f32> {
        let found = self.measure.filter(|measure| measure.0 == name).map(|measure| measure.1);
        found.ok_or_else(|| PyAttributeError::new_err(format!("a sampler {} has no {name}", self.technique)))
    }
}

#[pymethods]
impl Sampler {
    /// Draws directions to the light for numbers u in [0, 1)², (..., 2). Lines use the first number alone.
    fn sample(&self, py: Python<'_>, u: &Bound<'_, PyAny>) -> PyResult<Samples> {
        let u = Argument::new("u", FieldKind::Units, u)?;
        let columns = u.columns(&u.shape)?;
        Samples::of(py, u.shape, |out| self.prepared.sample(Vec2::new(&columns[0], &columns[1]), out))
    }
    /// The points of the light that unit directions w hit, (..., 3), with the pdf with which `sample` draws them; the pdf is 0 where a
    /// direction misses the light.
    fn hit(&self, py: Python<'_>, w: &Bound<'_, PyAny>) -> PyResult<Samples> {
        let w = Argument::new("w", FieldKind::Direction, w)?;
        let columns = w.columns(&w.shape)?;
        Samples::of(py, w.shape, |out| self.prepared.hit(vector(&columns), out))
    }
    /// The probability density per steradian with which `sample` draws unit directions w, (..., 3); 0 where they miss the light.
    fn pdf<'py>(&self, py: Python<'py>, w: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let w = Argument::new("w", FieldKind::Direction, w)?;
        let columns = w.columns(&w.shape)?;
        let mut out = zeros(columns[0].len())?;
        run(py, out.len(), || self.prepared.pdf(vector(&columns), &mut out));
        array(py, &w.shape, out)
    }
    /// The numbers u in [0, 1)² that `sample` maps to unit directions w, (..., 3); any numbers where they miss the light.
    fn invert<'py>(&self, py: Python<'py>, w: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let w = Argument::new("w", FieldKind::Direction, w)?;
        let columns = w.columns(&w.shape)?;
        let mut out = zero_columns::<2>(columns[0].len())?;
        run(py, columns[0].len(), || {
            let [x, y] = &mut out;
            self.prepared.invert(vector(&columns), Vec2::new(x, y));
        });
        rows(py, &w.shape, &out)
    }
    /// Surface area of the light, in the square of the unit of the coordinates; of samplers by area.
    #[getter]
    fn area(&self) -> PyResult<f32> {
        self.measure("area")
    }
    /// Solid angle of the light in steradians; of samplers by solid angle and by cosine warp.
    #[getter]
    fn solid_angle(&self) -> PyResult<f32> {
        self.measure("solid_angle")
    }
    /// Projected solid angle of the light above the horizon, in [0, π]: the irradiance per unit of radiance; of samplers by projected
    /// solid angle, except lines. Of samplers by reflection, that after the map: π times the part of the lobe that the light covers.
    #[getter]
    fn projected_solid_angle(&self) -> PyResult<f32> {
        self.measure("projected_solid_angle")
    }
    /// The angle that a line subtends, in radians; of samplers by angle.
    #[getter]
    fn angle(&self) -> PyResult<f32> {
        self.measure("angle")
    }
    fn __repr__(&self) -> String {
        format!("<etendue.Sampler: {}>", self.technique)
    }
}

/// An argument of a light's constructor: its name, its kind, whether it is a vertex of which the core keeps the edge from the first one, and
/// its value.
type Field<'a, 'py> = (&'static str, FieldKind, bool, &'a Bound<'py, PyAny>);

/// The numbers of a light in columns, in the order of the core.
fn numbers(fields: &[Field<'_, '_>], arguments: &[Argument<'_>], shape: &[usize]) -> PyResult<Vec<Vec<f32>>> {
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
/// A point p, or a normal n.
pub(crate) fn single(name: &'static str, object: &Bound<'_, PyAny>) -> PyResult<Vec3<f32>> {
    let kind = if name == "n" { FieldKind::Direction } else { FieldKind::Row(3) };
    let columns = Argument::single(name, kind, object)?.columns(&[])?;
    Ok(Vec3::new(columns[0][0], columns[1][0], columns[2][0]))
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
    fn argument<'a, 'py>(self, at: &'a Bound<'py, PyAny>) -> (&'static str, FieldKind, &'a Bound<'py, PyAny>) {
        if let Self::Sample = self { ("u", FieldKind::Units, at) } else { ("w", FieldKind::Direction, at) }
    }
}

impl Each {
    fn new(
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
            module.add_class::<Samples>()?;
            module.add_class::<Sampler>()?;
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
                n: Option<&Bound<'_, PyAny>>,
                lobe: &[Option<&Bound<'_, PyAny>>],
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
            /// technique: "area" for `by_area`, and so on. By "reflection", which flat lights have, the arguments of a `Reflection` are
            /// needed, too: roughnesses alpha (...) and unit vectors view (..., 3) towards the viewer.
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
                Self::each(py, &fields, p, n, &[$($more),*], by, Call::Sample, u)
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
                Self::each(py, &fields, p, n, &[$($more),*], by, Call::Hit, w)
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
                Self::each(py, &fields, p, n, &[$($more),*], by, Call::Pdf, w)
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
                Self::each(py, &fields, p, n, &[$($more),*], by, Call::Invert, w)
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
