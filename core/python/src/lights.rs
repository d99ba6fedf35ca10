//! Lights, and lights prepared for a shading point.

use crate::arrays::{Argument, Kind, array, broadcast, rows, run, zero_columns, zeros};
use etendue::light::*;
use etendue::{Vec2, Vec3};
use etendue_batch::{Batch, InTable, LightFunctions, Technique};
use pyo3::exceptions::{PyAttributeError, PyTypeError, PyValueError};
use pyo3::prelude::*;

/// A light prepared by any technique.
trait Prepared: Send + Sync {
    fn sample(&self, u: Vec2<&[f32]>, out: etendue_batch::Samples<'_>);
    fn hit(&self, w: Vec3<&[f32]>, out: etendue_batch::Samples<'_>);
    fn pdf(&self, w: Vec3<&[f32]>, out: &mut [f32]);
    fn invert(&self, w: Vec3<&[f32]>, out: Vec2<&mut [f32]>);
}
impl<T: Technique + InTable<Functions = LightFunctions<T>> + Send + Sync> Prepared for T {
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
fn vector(columns: &[Vec<f32>]) -> Vec3<&[f32]> {
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
    fn measure(&self, name: &str) -> PyResult<f32> {
        let found = self.measure.filter(|measure| measure.0 == name).map(|measure| measure.1);
        found.ok_or_else(|| PyAttributeError::new_err(format!("a sampler {} has no {name}", self.technique)))
    }
}

#[pymethods]
impl Sampler {
    /// Draws directions to the light for numbers u in [0, 1)², (..., 2). Lines use the first number alone.
    fn sample(&self, py: Python<'_>, u: &Bound<'_, PyAny>) -> PyResult<Samples> {
        let u = Argument::new("u", Kind::Units, u)?;
        let columns = u.columns(&u.shape)?;
        Samples::of(py, u.shape, |out| self.prepared.sample(Vec2::new(&columns[0], &columns[1]), out))
    }
    /// The points of the light that unit directions w hit, (..., 3), with the pdf with which `sample` draws them; the pdf is 0 where a
    /// direction misses the light.
    fn hit(&self, py: Python<'_>, w: &Bound<'_, PyAny>) -> PyResult<Samples> {
        let w = Argument::new("w", Kind::Direction, w)?;
        let columns = w.columns(&w.shape)?;
        Samples::of(py, w.shape, |out| self.prepared.hit(vector(&columns), out))
    }
    /// The probability density per steradian with which `sample` draws unit directions w, (..., 3); 0 where they miss the light.
    fn pdf<'py>(&self, py: Python<'py>, w: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let w = Argument::new("w", Kind::Direction, w)?;
        let columns = w.columns(&w.shape)?;
        let mut out = zeros(columns[0].len())?;
        run(py, out.len(), || self.prepared.pdf(vector(&columns), &mut out));
        array(py, &w.shape, out)
    }
    /// The numbers u in [0, 1)² that `sample` maps to unit directions w, (..., 3); any numbers where they miss the light.
    fn invert<'py>(&self, py: Python<'py>, w: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let w = Argument::new("w", Kind::Direction, w)?;
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
    /// solid angle, except lines.
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

type Field<'a, 'py> = (&'static str, Kind, &'a Bound<'py, PyAny>);

/// The numbers of a light in columns, in the order of the core.
fn numbers(light: &str, arguments: &[Argument<'_>], shape: &[usize]) -> PyResult<Vec<Vec<f32>>> {
    let mut columns = Vec::new();
    for argument in arguments {
        columns.append(&mut argument.columns(shape)?);
    }
    if light == "Triangle" {
        // the core keeps edges, not vertices
        let (first, others) = columns.split_at_mut(3);
        for (k, column) in others.iter_mut().enumerate() {
            column.iter_mut().zip(&first[k % 3]).for_each(|(x, from)| *x -= from);
        }
    }
    Ok(columns)
}
/// The numbers of one light.
fn one(light: &str, fields: &[Field<'_, '_>]) -> PyResult<Vec<f32>> {
    let arguments = fields.iter().map(|&(name, kind, object)| Argument::single(name, kind, object));
    let columns = numbers(light, &arguments.collect::<PyResult<Vec<_>>>()?, &[])?;
    Ok(columns.iter().flatten().copied().collect())
}

/// Prepares a light for a point p and a normal n, or for those of them that the technique needs.
fn prepare<T>(light: &T::Light<f32>, place: &[(&'static str, &Bound<'_, PyAny>)]) -> PyResult<T>
where
    T: Technique + InTable<Functions = LightFunctions<T>>,
{
    let mut vectors = [Vec3::default(); 2];
    for (&(name, object), vector) in place.iter().zip(&mut vectors) {
        let kind = if name == "n" { Kind::Direction } else { Kind::Row(3) };
        let columns = Argument::single(name, kind, object)?.columns(&[])?;
        *vector = Vec3::new(columns[0][0], columns[1][0], columns[2][0]);
    }
    Ok(Batch::new().prepare::<T>(light, vectors[0], vectors[1]))
}

/// Lights, shading points and numbers for `sample_each`.
struct Each {
    shape: Vec<usize>,
    light: Vec<Vec<f32>>,
    p: Vec<Vec<f32>>,
    n: Option<Vec<Vec<f32>>>,
    u: Vec<Vec<f32>>,
}

impl Each {
    fn new(
        py: Python<'_>,
        light: &str,
        fields: &[Field<'_, '_>],
        [p, u]: [&Bound<'_, PyAny>; 2],
        n: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let fields = fields.iter().map(|&(name, kind, object)| Argument::new(name, kind, object));
        let fields = fields.collect::<PyResult<Vec<_>>>()?;
        let (p, u) = (Argument::new("p", Kind::Row(3), p)?, Argument::new("u", Kind::Units, u)?);
        let n = n.map(|n| Argument::new("n", Kind::Direction, n)).transpose()?;
        let shape = broadcast(py, &fields.iter().chain([&p, &u]).chain(&n).collect::<Vec<_>>())?;
        let light = numbers(light, &fields, &shape)?;
        let n = n.map(|n| n.columns(&shape)).transpose()?;
        Ok(Self { light, p: p.columns(&shape)?, n, u: u.columns(&shape)?, shape })
    }
    fn sample<T>(
        self,
        py: Python<'_>,
        build: impl for<'a> Fn(&[&'a [f32]]) -> T::Light<&'a [f32]> + Send + Sync,
    ) -> PyResult<Samples>
    where
        T: Technique + InTable<Functions = LightFunctions<T>>,
    {
        let Self { shape, light, p, n, u } = self;
        if T::ON_SURFACE && n.is_none() {
            return Err(PyTypeError::new_err("this technique needs n, the normals at the shading points"));
        }
        Samples::of(py, shape, |out| {
            let light: Vec<_> = light.iter().map(Vec::as_slice).collect();
            let normals = n.as_deref().map_or(Vec3::new(&[][..], &[][..], &[][..]), vector);
            Batch::new().sample_each::<T>(build(&light), vector(&p), normals, Vec2::new(&u[0], &u[1]), out);
        })
    }
}

/// The lights of the core; polygons have eight corners.
mod shapes {
    pub(super) use etendue::{BilinearPatch, Cylinder, Disk, Line, Parallelogram, Rectangle, Sphere, Sun, Triangle};
    pub(super) type Polygon<X> = etendue::Polygon<X, 8>;
}

fn v<X: Copy>(numbers: &[X], at: usize) -> Vec3<X> {
    Vec3::new(numbers[at], numbers[at + 1], numbers[at + 2])
}

macro_rules! lights {
    ($($(#[$doc:meta])* $name:ident($($field:ident: $kind:expr),+) by $default:tt |$x:ident| $build:expr => {
        $($(#[$technique_doc:meta])* $by:ident($($place:ident),*) $technique:ty $(, $measure:ident)?;)+
    })+) => {
        $($(#[$doc])*
        #[pyclass(module = "etendue", frozen)]
        pub(crate) struct $name {
            numbers: Vec<f32>,
        }
        impl $name {
            fn build<X: Copy>($x: &[X]) -> shapes::$name<X> {
                $build
            }
        }
        #[pymethods]
        impl $name {
            #[new]
            fn new($($field: &Bound<'_, PyAny>),+) -> PyResult<Self> {
                let fields = [$((stringify!($field), $kind, $field)),+];
                Ok(Self { numbers: one(stringify!($name), &fields)? })
            }
            $($(#[$technique_doc])*
            fn $by(&self $(, $place: &Bound<'_, PyAny>)*) -> PyResult<Sampler> {
                let place = [$((stringify!($place), $place)),*];
                let sampler = prepare::<$technique>(&Self::build(&self.numbers), &place)?;
                let measure = None $(.or(Some((stringify!($measure), sampler.$measure()))))?;
                let technique = concat!(stringify!($name), " ", stringify!($by));
                Ok(Sampler { prepared: Box::new(sampler), technique, measure })
            })+
            /// Samples of a light of its own for each row, from a shading point of its own. All arrays are broadcast to one shape (...)
            /// beside their last axis: the constructor's arguments (..., 3) or (...), shading points p (..., 3), numbers u in [0, 1)²
            /// (..., 2), and the unit normals n (..., 3) at the shading points, for techniques that need them. `by` names the
            /// technique: "area" for `by_area`, and so on.
            #[staticmethod]
            #[pyo3(signature = ($($field),+, *, p, u, n=None, by=$default))]
            #[allow(clippy::too_many_arguments)]
            fn sample_each(
                py: Python<'_>,
                $($field: &Bound<'_, PyAny>,)+
                p: &Bound<'_, PyAny>,
                u: &Bound<'_, PyAny>,
                n: Option<&Bound<'_, PyAny>>,
                by: &str,
            ) -> PyResult<Samples> {
                let names = [$(&stringify!($by)[3..]),+];
                if !names.contains(&by) {
                    return Err(PyValueError::new_err(format!("by must be one of {names:?}, not {by:?}")));
                }
                let fields = [$((stringify!($field), $kind, $field)),+];
                let each = Each::new(py, stringify!($name), &fields, [p, u], n)?;
                $(if by == &stringify!($by)[3..] {
                    return each.sample::<$technique>(py, |x| Self::build(x));
                })+
                unreachable!("by is one of the names")
            }
            fn __repr__(&self) -> String {
                format!("<etendue.{} {:?}>", stringify!($name), self.numbers)
            }
        })+
        /// Adds the lights to the module.
        pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
            module.add_class::<Samples>()?;
            module.add_class::<Sampler>()?;
            $(module.add_class::<$name>()?;)+
            Ok(())
        }
    };
}
use Kind::{Corners, Direction, Number};
const POINT: Kind = Kind::Row(3);
lights! {
    /// A sphere light about `center` (3) that emits outwards. A radius ≤ 0 gives pdf 0; from inside, every direction hits it and it does
    /// not emit.
    Sphere(center: POINT, radius: Number) by "solid_angle" |x| shapes::Sphere { center: v(x, 0), radius: x[3] } => {
        /// Uniform over the surface: pdf distance²/(|cosθ'| 4πR²) per steradian, θ' at the light. More than half of the samples face away.
        by_area(p) SphereByArea<f32>, area;
        /// Uniform over the solid angle Ω at the point p: pdf 1/Ω per steradian.
        by_solid_angle(p) SphereBySolidAngle<f32>, solid_angle;
        /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal n at the point p: pdf cosθ/Ω⊥ per steradian, 0
        /// where nothing of the light is above the horizon.
        by_projected_solid_angle(p, n) SphereByProjectedSolidAngle<f32>, projected_solid_angle;
    }
    /// A triangle light with the vertices v0, v1 and v2 (3), that emits from the side of (v1 − v0) × (v2 − v0). A triangle without area,
    /// and a point in its plane, give pdf 0. uv: the barycentric coordinates of v1 and v2.
    Triangle(v0: POINT, v1: POINT, v2: POINT) by "solid_angle"
    |x| shapes::Triangle { v0: v(x, 0), e1: v(x, 3), e2: v(x, 6) } => {
        /// Uniform over the surface of area A: pdf distance²/(|cosθ'| A) per steradian, θ' at the light.
        by_area(p) TriangleByArea<f32>, area;
        /// Uniform over the solid angle Ω at the point p: pdf 1/Ω per steradian.
        by_solid_angle(p) TriangleBySolidAngle<f32>, solid_angle;
        /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal n at the point p: pdf cosθ/Ω⊥ per steradian, 0
        /// where nothing of the light is above the horizon.
        by_projected_solid_angle(p, n) TriangleByProjectedSolidAngle<f32>, projected_solid_angle;
        /// By solid angle times a bilinear approximation of the cosine to the unit normal n at the point p; pdf per steradian.
        by_cosine_warp(p, n) TriangleByCosineWarp<f32>, solid_angle;
    }
    /// A parallelogram light corner + s·edge_s + t·edge_t, s and t in [0, 1], that emits from the side of edge_s × edge_t; all arguments
    /// have 3 coordinates. Without area, and from a point in its plane, the pdf is 0. uv: (s, t).
    Parallelogram(corner: POINT, edge_s: POINT, edge_t: POINT) by "solid_angle"
    |x| shapes::Parallelogram { p: v(x, 0), u: v(x, 3), v: v(x, 6) } => {
        /// Uniform over the surface of area A: pdf distance²/(|cosθ'| A) per steradian, θ' at the light.
        by_area(p) ParallelogramByArea<f32>, area;
        /// Uniform over the solid angle Ω at the point p: pdf 1/Ω per steradian.
        by_solid_angle(p) ParallelogramBySolidAngle<f32>, solid_angle;
        /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal n at the point p: pdf cosθ/Ω⊥ per steradian, 0
        /// where nothing of the light is above the horizon.
        by_projected_solid_angle(p, n) ParallelogramByProjectedSolidAngle<f32>, projected_solid_angle;
    }
    /// A rectangle light corner + s·edge_s + t·edge_t with perpendicular edges, s and t in [0, 1], that emits from the side of
    /// edge_s × edge_t; all arguments have 3 coordinates. Its strata follow the edges. Without area, and from a point in its plane, the
    /// pdf is 0. uv: (s, t).
    Rectangle(corner: POINT, edge_s: POINT, edge_t: POINT) by "solid_angle"
    |x| shapes::Rectangle { p: v(x, 0), u: v(x, 3), v: v(x, 6) } => {
        /// Uniform over the solid angle Ω at the point p: pdf 1/Ω per steradian.
        by_solid_angle(p) RectangleBySolidAngle<f32>, solid_angle;
        /// By solid angle times a bilinear approximation of the cosine to the unit normal n at the point p; pdf per steradian.
        by_cosine_warp(p, n) RectangleByCosineWarp<f32>, solid_angle;
    }
    /// A disk light about `center` (3) with the unit vector `normal` (3), from whose side it emits. A radius ≤ 0, and a point in its plane,
    /// give pdf 0. uv: (1 + q)/2 for the position q on the unit disk.
    Disk(center: POINT, normal: Direction, radius: Number) by "solid_angle"
    |x| shapes::Disk { center: v(x, 0), normal: v(x, 3), radius: x[6] } => {
        /// Uniform over the surface of area A: pdf distance²/(|cosθ'| A) per steradian, θ' at the light.
        by_area(p) DiskByArea<f32>, area;
        /// Uniform over the solid angle Ω at the point p: pdf 1/Ω per steradian.
        by_solid_angle(p) DiskBySolidAngle<f32>, solid_angle;
    }
    /// The side of a cylinder from the centre `start` (3) of one end along `axis` (3) to the other, that emits outwards. More than half of
    /// the samples face away. A radius ≤ 0 or an axis of length 0 gives pdf 0. uv: height along the axis, and azimuth in turns.
    Cylinder(start: POINT, axis: POINT, radius: Number) by "area"
    |x| shapes::Cylinder { p: v(x, 0), axis: v(x, 3), radius: x[6] } => {
        /// Uniform over the surface of area A: pdf distance²/(|cosθ'| A) per steradian, θ' at the light.
        by_area(p) CylinderByArea<f32>, area;
    }
    /// A bilinear patch light corner + s·edge_s + t·edge_t + st(diagonal − edge_s − edge_t), s and t in [0, 1], that emits from the side of
    /// ∂s × ∂t; `diagonal` leads from the corner to the opposite one, and all arguments have 3 coordinates. Without area the pdf is 0.
    /// uv: (s, t).
    BilinearPatch(corner: POINT, edge_s: POINT, edge_t: POINT, diagonal: POINT) by "area"
    |x| shapes::BilinearPatch { p: v(x, 0), u: v(x, 3), v: v(x, 6), w: v(x, 9) } => {
        /// Nearly uniform over the surface: the pdf per unit area, times distance²/|cosθ'|, is exact for the map.
        by_area(p) PatchByArea<f32>, area;
    }
    /// A flat convex polygon light with 3 to 8 corners in order, (3 to 8, 3), that emits from the side on which they run
    /// counterclockwise. Without area, and from a point in its plane, the pdf is 0. uv: the parts of the edges from the first corner to
    /// the second and to the last, clamped to [0, 1].
    Polygon(corners: Corners) by "solid_angle" |x| shapes::Polygon { corners: core::array::from_fn(|i| v(x, 3 * i)) } => {
        /// Uniform over the surface of area A: pdf distance²/(|cosθ'| A) per steradian, θ' at the light.
        by_area(p) PolygonByArea<f32, 8>, area;
        /// Uniform over the solid angle Ω at the point p: pdf 1/Ω per steradian.
        by_solid_angle(p) PolygonBySolidAngle<f32, 8>, solid_angle;
        /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal n at the point p: pdf cosθ/Ω⊥ per steradian, 0
        /// where nothing of the light is above the horizon.
        by_projected_solid_angle(p, n) PolygonByProjectedSolidAngle<f32, 8>, projected_solid_angle;
    }
    /// A line light from `start` along `edge` (3 each): a cylinder so thin that only its width times its radiance counts, which emits in all
    /// directions. Samplers use the first random number alone. The pdf is in the measure sinγ ds/r² (γ from the line, s along it), so the
    /// estimator is f · L · width · cosθ · weight. No direction hits a line. A length of 0, and a point on the line, give pdf 0. uv: the
    /// part of the length, and 0.
    Line(start: POINT, edge: POINT) by "angle" |x| shapes::Line { p: v(x, 0), edge: v(x, 3) } => {
        /// Uniform over the length: pdf r²/(length · sinγ).
        by_length(p) LineByLength<f32>;
        /// Uniform over the angle α that the line subtends at the point p: pdf r/α, with r its least distance.
        by_angle(p) LineByAngle<f32>, angle;
        /// By projected solid angle above the horizon of the unit normal n at the point p; pdf 0 where nothing of the line is above it.
        by_projected_solid_angle(p, n) LineByProjectedSolidAngle<f32>;
    }
    /// A sun: the same radiance from all directions within an angle σ of the unit vector `direction` (3), for all points, with
    /// `one_minus_cos` = 1 − cosσ in [0, 2]: 1.09e-5 for the sun from the earth. The distance is the largest float32.
    Sun(direction: Direction, one_minus_cos: Number) by "solid_angle"
    |x| shapes::Sun { direction: v(x, 0), one_minus_cos: x[3] } => {
        /// Uniform over the cone: pdf 1/(2π(1 − cosσ)) per steradian, 0 where the cone is empty.
        by_solid_angle() SunBySolidAngle<f32>, solid_angle;
    }
}
