//! The lights of a set, of any kind.

use super::mixture::Source;
use crate::light::{
    Affine, BilinearPatch, ConstantEnvironment, DirectionalLight, Disk, Line, Parallelogram, PointLight, Polygon,
    Rectangle, Rotated, Sphere, SpotLight, Sun, Triangle,
};
use crate::owned::OwnedEnvironment;
use crate::real::{Mask, Real};
use crate::select::LightBound;
use crate::vector::{Frame, Vec3};
use alloc::boxed::Box;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::f64::consts::PI;

/// A light of any kind, as `Lights` take it: what the shapes, their images under an [`Affine`] map, suns, a constant sky, and one that is an
/// image convert into. Normals and directions may be of any length. Its radiance is given beside it; of point and spot lights their intensity, of directional lights the irradiance on a
/// surface that faces them, of lines the radiance times the width, and of an image the mean of its radiance over all directions.
///
/// ```
/// use etendue::{Triangle, Vec3, lights::Emitter};
/// let [a, b, c] = [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]].map(Vec3::<f32>::lit);
/// let lamp: Emitter<f32> = Triangle::new(a, b, c).into();
/// let leaf = lamp.clone().two_sided();
/// let ceiling = lamp.facing(Vec3::lit([0.0, -1.0, 0.0])); // whatever the order of its vertices is
/// ```
#[derive(Clone, Debug)]
pub struct Emitter<R: Real<Scalar = R>> {
    pub(super) pieces: Vec<Piece<R>>,
}

/// A shape, and from which sides it emits.
#[derive(Clone, Debug)]
pub(super) struct Piece<R: Real<Scalar = R>> {
    pub(super) shape: Shape<R>,
    pub(super) two_sided: bool,
    /// The normal of what may emit from the other side than the shape's.
    pub(super) facing: Option<Vec3<R>>,
}

impl<R: Real<Scalar = R>> Emitter<R> {
    fn one(shape: Shape<R>) -> Self {
        Self { pieces: [Piece { shape, two_sided: false, facing: None }].into() }
    }
    /// Several lights as one, such as the triangles of a mesh: one light for its owner, of as many parts, and as many for the choice among
    /// lights.
    pub fn group<E: Into<Self>>(parts: impl IntoIterator<Item = E>) -> Self {
        Self { pieces: parts.into_iter().flat_map(|part| part.into().pieces).collect() }
    }
    /// The same light, which emits from both sides; a sphere, inwards too.
    #[must_use]
    pub fn two_sided(mut self) -> Self {
        self.pieces.iter_mut().for_each(|piece| piece.two_sided = true);
        self
    }
    /// The same light, which emits from the side to which the vector `normal` points, whatever the order of its vertices is. It changes
    /// nothing of lights that are not flat.
    #[must_use]
    pub fn facing(mut self, normal: Vec3<R>) -> Self {
        self.pieces.iter_mut().for_each(|piece| piece.facing = Some(normal));
        self
    }
}

/// The plane of a flat light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane<R> {
    /// A point of it.
    pub(super) on: Vec3<R>,
    /// Its unit normal on the side of the shape's.
    pub(super) normal: Vec3<R>,
    /// The greatest coordinate of what spans it.
    pub(super) reach: R,
}

impl<R: Real> Plane<R> {
    /// Whether a point is in it, to within the rounding of its own computation: as [`on_surface`](Triangle::on_surface).
    #[inline(always)]
    pub(super) fn holds(&self, p: Vec3<R>) -> R::Mask {
        let slack = R::lit(if R::DOUBLE { 16.0 / 9_007_199_254_740_992.0 } else { 16.0 / 16_777_216.0 });
        let is_plane = self.normal.max_abs().gt(R::lit(0.0));
        (p - self.on).dot(self.normal).abs().le((p.max_abs() + self.reach) * slack) & is_plane
    }
}

/// What an emitter consists of.
#[derive(Clone, Debug)]
pub(super) enum Shape<R: Real<Scalar = R>> {
    Sphere(Sphere<R>),
    Triangle(Triangle<R>),
    Parallelogram(Parallelogram<R>),
    Rectangle(Rectangle<R>),
    Disk(Disk<R>),
    Polygon(Box<Polygon<R, 8>>),
    Patch(BilinearPatch<R>),
    Line(Line<R>),
    Ellipsoid(Box<Affine<Sphere<R>, R>>),
    Ellipse(Box<Affine<Disk<R>, R>>),
    Point(PointLight<R>),
    Spot(SpotLight<R>),
    Directional(DirectionalLight<R>),
    Sun(Sun<R>),
    Sky,
    Image(Arc<Rotated<OwnedEnvironment, R>>),
}

/// A sun with a unit direction; without any direction, it has no extent.
fn somewhere<R: Real>(sun: Sun<R>) -> Sun<R> {
    let direction = unit(sun.direction);
    Sun { direction, one_minus_cos: sun.one_minus_cos.keep(direction.max_abs().gt(R::lit(0.0))) }
}
/// The unit vector in the direction of one of any length, in which no host's number overflows.
fn unit<R: Real>(v: Vec3<R>) -> Vec3<R> {
    v.unit_and_length().0
}
fn upright<R: Real>(disk: Disk<R>) -> Disk<R> {
    Disk { normal: unit(disk.normal), ..disk }
}

fn rounding<R: Real>() -> R {
    R::lit(if R::DOUBLE { f64::EPSILON } else { f64::from(f32::EPSILON) })
}

/// The image of a sphere if it is one, to within the rounding of the axes: cheaper, and uniform by solid angle.
fn round<R: Real<Scalar = R>>(light: &Affine<Sphere<R>, R>) -> Option<Sphere<R>> {
    let lengths = light.axes.map(|axis| axis.unit_and_length().1);
    let [x, y, z] = light.axes.map(unit);
    let slack = R::lit(4.0) * rounding();
    let is_small = |x: R| x.abs().le(slack).any();
    let is_equal = |other: R| is_small((other - lengths[0]) / lengths[0]);
    let is_round =
        [x.dot(y), y.dot(z), z.dot(x)].into_iter().all(is_small) && is_equal(lengths[1]) && is_equal(lengths[2]);
    is_round.then(|| Sphere::new(light.image(light.shape.center), light.shape.radius * lengths[0]))
}

/// The image of a disk if it is one, to within the rounding of the axes.
fn circle<R: Real<Scalar = R>>(light: &Affine<Disk<R>, R>) -> Option<Disk<R>> {
    let [x, y, z] = light.axes;
    let Frame { s, t, n } = Frame::new(unit(light.shape.normal));
    let image = |v: Vec3<R>| (x * v.x + y * v.y + z * v.z).unit_and_length();
    let ([(s, length), (t, other), (n, _)], slack) = ([s, t, n].map(image), R::lit(8.0) * rounding());
    let (normal, zero) = (s.cross(t), R::lit(0.0));
    let is_small = |x: R| x.abs().le(slack);
    let is_round = is_small(s.dot(t)) & is_small((other - length) / length) & normal.dot(n).abs().gt(zero);
    let disk = || Disk {
        center: light.image(light.shape.center),
        normal: unit(normal) * R::lit(1.0).copysign(normal.dot(n)),
        radius: light.shape.radius * length,
    };
    is_round.any().then(disk)
}

macro_rules! shapes {
    ($($shape:ident = $from:ty => $value:expr;)+) => {$(
        impl<R: Real<Scalar = R>> From<$from> for Emitter<R> {
            fn from(light: $from) -> Self {
                let convert: fn($from) -> Shape<R> = $value;
                Self::one(convert(light))
            }
        }
    )+};
}
shapes! {
    Sphere = Sphere<R> => Shape::Sphere;
    Triangle = Triangle<R> => Shape::Triangle;
    Parallelogram = Parallelogram<R> => Shape::Parallelogram;
    Rectangle = Rectangle<R> => Shape::Rectangle;
    Disk = Disk<R> => |light| Shape::Disk(upright(light));
    Patch = BilinearPatch<R> => Shape::Patch;
    Line = Line<R> => Shape::Line;
    Ellipsoid = Affine<Sphere<R>, R> => |light| round(&light).map_or_else(|| Shape::Ellipsoid(Box::new(light)), Shape::Sphere);
    Ellipse = Affine<Disk<R>, R> => |light| circle(&light).map_or_else(|| Shape::Ellipse(Box::new(Affine { shape: upright(light.shape), ..light })), Shape::Disk);
    Point = PointLight<R> => Shape::Point;
    Spot = SpotLight<R> => |light| Shape::Spot(SpotLight { axis: unit(light.axis), ..light });
    Directional = DirectionalLight<R> => |light| Shape::Directional(DirectionalLight::new(unit(light.direction)));
    Sun = Sun<R> => |light| Shape::Sun(somewhere(light));
    Sky = ConstantEnvironment => |_| Shape::Sky;
    Image = OwnedEnvironment => |sampler| Shape::Image(Arc::new(Rotated { sampler, frame: Frame { s: Vec3::lit([1.0, 0.0, 0.0]), t: Vec3::lit([0.0, 1.0, 0.0]), n: Vec3::lit([0.0, 0.0, 1.0]) } }));
    Turned = Rotated<OwnedEnvironment, R> => |sky| Shape::Image(Arc::new(sky));
}
impl<R: Real<Scalar = R>, const N: usize> From<Polygon<R, N>> for Emitter<R> {
    fn from(light: Polygon<R, N>) -> Self {
        const { assert!(N >= 3 && N <= 8) };
        let corners = core::array::from_fn(|i| light.corners[i.min(N - 1)]);
        Self::one(Shape::Polygon(Box::new(Polygon { corners })))
    }
}

/// 1 − cosθ of a spot light's cone below which a tree cannot tell which points it lights.
const NARROWEST: f64 = 1.0 - 253.0 / 254.0;

impl<R: Real<Scalar = R>> Shape<R> {
    /// The plane of a flat light, with its unit normal.
    pub(super) fn plane(&self) -> Option<Plane<R>> {
        let of = |on: Vec3<R>, s: Vec3<R>, t: Vec3<R>| {
            // edges of any lengths
            let normal = unit(unit(s).cross(unit(t)));
            Plane { on, normal, reach: on.max_abs() + s.max_abs() + t.max_abs() }
        };
        Some(match self {
            Self::Triangle(light) => of(light.v0, light.e1, light.e2),
            Self::Parallelogram(light) => of(light.corner, light.edge_s, light.edge_t),
            Self::Rectangle(light) => of(light.corner, light.edge_s, light.edge_t),
            Self::Disk(light) => {
                let Disk { center: on, normal, radius } = *light;
                Plane { on, normal, reach: on.max_abs() + radius.abs() }
            }
            Self::Polygon(light) => {
                let on = light.corners[0];
                let edges = light.corners.map(|corner| corner - on);
                let scale = edges.iter().fold(R::lit(0.0), |most, edge| most.greater(edge.max_abs())).pow2_scale();
                let cross = |pair: &[Vec3<R>]| (pair[0] * scale).cross(pair[1] * scale);
                let normal = unit(edges.windows(2).fold(Vec3::ZERO, |sum, pair| sum + cross(pair)));
                let reach = light.corners.iter().fold(R::lit(0.0), |most, corner| most.greater(corner.max_abs()));
                Plane { on, normal, reach: reach + on.max_abs() }
            }
            Self::Ellipse(light) => {
                let ([x, y, z], n) = (light.axes, light.shape.normal);
                let scale = x.max_abs().greater(y.max_abs()).greater(z.max_abs()).pow2_scale();
                let [x, y, z] = [x, y, z].map(|axis| axis * scale);
                let cofactors = y.cross(z) * n.x + z.cross(x) * n.y + x.cross(y) * n.z;
                let normal = unit(cofactors * R::lit(1.0).copysign(x.dot(y.cross(z))));
                let on = light.image(light.shape.center);
                Plane { on, normal, reach: on.max_abs() + light.origin.max_abs() }
            }
            _ => return None,
        })
    }
    /// Whether a point is on a curved light, to within the rounding of its own computation, or on an ellipse. A patch may light itself.
    pub(super) fn on_surface(&self, p: Vec3<R>) -> bool {
        match self {
            Self::Sphere(light) => light.on_surface(p).any(),
            Self::Ellipsoid(light) => light.on_surface(p).any(),
            Self::Ellipse(light) => light.on_surface(p).any(),
            _ => false,
        }
    }
    /// What it can contribute with the radiance 1, and what it is for a [`Mixture`](super::mixture::Mixture).
    pub(super) fn bound(&self) -> (LightBound, Source) {
        let one = R::lit(1.0);
        let far = |irradiance: f64| LightBound { power: (4.0 * PI * irradiance) as f32, ..LightBound::default() };
        let narrow = |v: Vec3<R>| v.map(|x| x.lane_f64(0) as f32).to_array();
        let bound = match self {
            Self::Sphere(light) => light.bound(one),
            Self::Triangle(light) => light.bound(one),
            Self::Parallelogram(light) => light.bound(one),
            Self::Rectangle(light) => light.bound(one),
            Self::Disk(light) => light.bound(one),
            Self::Polygon(light) => light.bound(one),
            Self::Patch(light) => light.bound(one),
            Self::Line(light) => light.bound(one),
            Self::Ellipsoid(light) => image(light, light.shape.center),
            Self::Ellipse(light) => {
                let bound = image(light, light.shape.center);
                LightBound { normal: narrow(self.plane().map_or(Vec3::ZERO, |plane| plane.normal)), ..bound }
            }
            Self::Point(light) => light.bound(one),
            Self::Spot(light) => {
                let bound = light.bound(one);
                let is_narrow = light.one_minus_cos_outer.lane_f64(0) < NARROWEST;
                return (bound, if is_narrow { Source::Beam(light.map(|x| x.lane_f64(0)), 1.0) } else { Source::Lamp });
            }
            Self::Directional(light) => return (far(1.0), Source::Sun(narrow(light.direction), 1e-6, 0.0)),
            Self::Sun(light) => {
                let c = light.one_minus_cos.lane_f64(0).clamped(0.0, 2.0);
                // π sin²σ of a sun less than half a sphere wide
                let irradiance = if c < 1.0 { PI * c * (2.0 - c) } else { PI };
                let reach = ((2.0 * c).sqrt() * (1.0 + 1e-6) + 1e-6) as f32;
                return (far(irradiance), Source::Sun(narrow(light.direction), reach, 0.0));
            }
            Self::Sky | Self::Image(_) => return (far(PI), Source::Sky),
        };
        (bound, Source::Lamp)
    }
}

/// The bound of an ellipsoid or an ellipse, but for its normal.
fn image<S: Round<R>, R: Real<Scalar = R>>(light: &Affine<S, R>, center: Vec3<R>) -> LightBound {
    let wide = |v: Vec3<R>| v.map(|x| x.lane_f64(0));
    let [x, y, z] = light.axes.map(wide);
    let radius = light.shape.radius().lane_f64(0).greater(0.0);
    // Frobenius' norm is at least the greatest stretch
    let reach = (x.length_squared() + y.length_squared() + z.length_squared()).sqrt() * radius * (1.0 + 1e-6);
    let area = light.shape.area([x, y, z], radius);
    let middle = wide(light.image(center));
    LightBound::about(middle, reach, PI * area)
}

/// Shapes whose images have no corners.
trait Round<R> {
    fn radius(&self) -> R;
    /// The area of the image under the map to these axes, or an estimate of it.
    fn area(&self, axes: [Vec3<f64>; 3], radius: f64) -> f64;
}
impl<R: Real<Scalar = R>> Round<R> for Sphere<R> {
    fn radius(&self) -> R {
        self.radius
    }
    /// About the quadratic mean over directions of what the map makes of an element of the sphere, which is at least the mean.
    fn area(&self, [x, y, z]: [Vec3<f64>; 3], radius: f64) -> f64 {
        let squares = [y.cross(z), z.cross(x), x.cross(y)].map(Vec3::length_squared);
        4.0 * PI * radius * radius * (squares.iter().sum::<f64>() / 3.0).sqrt()
    }
}
impl<R: Real<Scalar = R>> Round<R> for Disk<R> {
    fn radius(&self) -> R {
        self.radius
    }
    fn area(&self, [x, y, z]: [Vec3<f64>; 3], radius: f64) -> f64 {
        let n = self.normal.map(|x| x.lane_f64(0));
        PI * radius * radius * (y.cross(z) * n.x + z.cross(x) * n.y + x.cross(y) * n.z).length()
    }
}
