//! Rays that leave the lights of a set.

use super::emitter::Shape;
use super::prepared;
use crate::light::{Affine, AreaSurface, EnvironmentBySolidAngle, LightSampler, Sphere, SpotLight, SurfacePoint};
use crate::math::ratio;
use crate::real::{Real, unit_interval};
use crate::vector::{Frame, Vec2, Vec3};
use crate::warp::{ConcentricDisk, Cone, CosineHemisphere, UniformSphere, Warp};
use core::f64::consts::PI;

/// A ray that leaves a light, for methods that trace from the lights.
#[derive(Clone, Copy, Debug)]
pub struct Emission<R> {
    /// Where it begins, in the coordinates of the scene.
    pub origin: Vec3<R>,
    /// Unit direction in which the light travels.
    pub direction: Vec3<R>,
    /// Unit normal of the light there, on the side of the ray; of lights without a surface, the direction.
    pub normal: Vec3<R>,
    /// Probability density of the ray: of lights with a surface per unit of area there and per steradian, of lines per unit of length and
    /// steradian, of point and spot lights per steradian; of suns and skies per steradian and per unit of area across the ray, and of
    /// directional lights per unit of that area. 0 where there is no ray.
    pub pdf: R,
    /// What the radiance of the light, or what stands for it, is to be multiplied by for the power that the ray carries; its mean is the
    /// power of the light. 0 where there is no ray.
    pub weight: R,
}

/// A ray, its density, and what the density is to be divided into for its weight.
struct Ray<R> {
    origin: Vec3<R>,
    direction: Vec3<R>,
    normal: Vec3<R>,
    pdf: R,
    factor: R,
}

/// Uniform over an area, and in proportion to the cosine above it.
fn from_surface<R: Real>(
    SurfacePoint { position, normal, inverse_pdf, .. }: SurfacePoint<R>,
    u: Vec2<R>,
    side: Face,
) -> Ray<R> {
    let (half, mut share) = (R::lit(0.5), R::lit(1.0 / PI));
    let mut u = u;
    let mut normal = normal.normalize();
    if side == Face::Both {
        // the first half of the numbers is for the front
        let is_behind = u.x.ge(half);
        u.x = unit_interval(u.x + u.x - R::lit(1.0).keep(is_behind));
        normal = Vec3::blend(is_behind, -normal, normal);
        share *= half;
    } else if side == Face::Back {
        normal = -normal;
    }
    let local = CosineHemisphere.sample(u);
    let direction = Frame::new(normal).to_world(local);
    let pdf = ratio(local.z * share, inverse_pdf);
    Ray { origin: position, direction, normal, pdf, factor: local.z }
}

/// The sides from which a light emits.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Face {
    Front,
    Back,
    Both,
}

/// A point of the image of a shape.
fn image<S, R: Real>(light: &Affine<S, R>, local: SurfacePoint<R>) -> SurfacePoint<R> {
    let ([x, y, z], n) = (light.axes, local.normal);
    let cofactors = y.cross(z) * n.x + z.cross(x) * n.y + x.cross(y) * n.z;
    let (normal, stretch) = cofactors.unit_and_length();
    let position = light.image(local.position);
    let normal = normal * R::lit(1.0).copysign(x.dot(y.cross(z)));
    SurfacePoint { position, normal, inverse_pdf: local.inverse_pdf * stretch, ..local }
}

/// From infinitely far away, from a direction of the density `pdf`: through a disk across the sphere `scene`, from before it.
fn from_afar<R: Real>(to_light: Vec3<R>, pdf: R, scene: Sphere<R>, u: Vec2<R>) -> Ray<R> {
    let across = ConcentricDisk.sample(u);
    let radius = scene.radius.greater(R::lit(0.0));
    let Frame { s, t, n } = Frame::new(to_light);
    let origin = (s * across.x + t * across.y + n).mul_add(radius, scene.center);
    let pdf = ratio(pdf, radius * radius * R::lit(PI));
    Ray { origin, direction: -to_light, normal: -to_light, pdf, factor: R::lit(1.0) }
}

/// A ray that leaves a light, by two numbers for its place and two for its direction.
pub(super) fn emit<R: Real<Scalar = R>>(shape: &Shape<R>, face: Face, u: [R; 4], scene: Sphere<R>) -> Emission<R> {
    let (zero, one, here) = (R::lit(0.0), R::lit(1.0), Vec3::ZERO);
    let is_number = u.iter().fold(zero, |sum, u| sum + *u * zero).ge(zero);
    let [a, b, c, d] = u.map(unit_interval);
    let (place, turn) = (Vec2::new(a, b), Vec2::new(c, d));
    let flat = |point: SurfacePoint<R>| from_surface(point, turn, face);
    let everywhere = R::lit(0.25 / PI);
    let ray = match shape {
        Shape::Sphere(light) => flat(light.by_area(here).surface().draw(place)),
        Shape::Triangle(light) => flat(light.by_area(here).surface().draw(place)),
        Shape::Parallelogram(light) => flat(light.by_area(here).surface().draw(place)),
        Shape::Rectangle(light) => flat(light.by_area(here).surface().draw(place)),
        Shape::Disk(light) => flat(light.by_area(here).surface().draw(place)),
        Shape::Polygon(light) => flat(light.by_area(here).surface().draw(place)),
        Shape::Patch(light) => flat(light.by_area(here).surface().draw(place)),
        Shape::Ellipsoid(light) => flat(image(light, light.shape.by_area(here).surface().draw(place))),
        Shape::Ellipse(light) => flat(image(light, light.shape.by_area(here).surface().draw(place))),
        Shape::Line(light) => {
            let (along, length) = light.edge.unit_and_length();
            let direction = UniformSphere.sample(turn);
            let factor = along.cross(direction).length();
            let origin = light.edge.mul_add(a, light.start);
            Ray { origin, direction, normal: direction, pdf: ratio(everywhere, length), factor }
        }
        Shape::Point(light) => {
            let direction = UniformSphere.sample(turn);
            Ray { origin: light.position, direction, normal: direction, pdf: everywhere, factor: one }
        }
        Shape::Spot(light) => {
            let cone = Cone { one_minus_cos: light.one_minus_cos_outer };
            let direction = Frame::new(light.axis).to_world(cone.sample(turn));
            // of a point at the distance 1, the pdf is 1 over the falloff
            let falloff = ratio(one, SpotLight { position: here, ..*light }.by_delta(direction).sample(turn).pdf);
            Ray { origin: light.position, direction, normal: direction, pdf: cone.uniform_pdf(), factor: falloff }
        }
        Shape::Directional(light) => from_afar(light.direction, one, scene, place),
        Shape::Sun(light) => {
            let s = light.by_solid_angle().sample(turn);
            from_afar(s.direction, s.pdf, scene, place)
        }
        Shape::Image(sky) => {
            let s = prepared::sky(sky).sample(turn);
            from_afar(s.direction, s.pdf, scene, place)
        }
        Shape::Sky => {
            let s = EnvironmentBySolidAngle.sample(turn);
            from_afar(s.direction, s.pdf, scene, place)
        }
    };
    let Ray { origin, direction, normal, pdf, factor } = ray;
    let finite = |v: Vec3<R>| v.is_within(R::lit(f64::INFINITY));
    let some = is_number & pdf.gt(R::lit(1e-37)) & pdf.lt(R::lit(1e37)) & finite(origin) & finite(direction);
    let weight = ratio(factor, pdf).lesser(R::lit(f64::from(f32::MAX))).keep(some);
    let kept = |v: Vec3<R>| v.keep(finite(v));
    Emission { origin: kept(origin), direction: kept(direction), normal: kept(normal), pdf: pdf.keep(some), weight }
}
