//! Light shapes: for one technique, a sample with all that an estimator needs.
//!
//! A shape whose lanes are equal (`splat`) draws a packet of samples of one light; lanes may as well hold different lights, and
//! `p` different shading points. Each method is one technique. The estimator of reflected radiance is
//! `f · L · cosθ / pdf` where `emits` holds, else 0; with a shadow ray of length `distance` along `direction`.
//!
//! | shape | by area | by solid angle | by projected solid angle |
//! |---|---|---|---|
//! | [`Sphere`] | [`by_area`](Sphere::by_area) wastes all but (1−R/d)/2 of its samples | [`by_solid_angle`](Sphere::by_solid_angle), always better | [`by_projected_solid_angle`](Sphere::by_projected_solid_angle): for diffuse surfaces |
//! | [`Triangle`] | [`by_area`](Triangle::by_area): cheap; fine for a light that is small for its distance | [`by_solid_angle`](Triangle::by_solid_angle): for all others | [`by_projected_solid_angle`](Triangle::by_projected_solid_angle): for diffuse surfaces |
//! | [`Parallelogram`] | [`by_area`](Parallelogram::by_area) | [`by_solid_angle`](Parallelogram::by_solid_angle) | [`by_projected_solid_angle`](Parallelogram::by_projected_solid_angle) |
//! | [`Rectangle`] | [`by_area`](Rectangle::by_area) | [`by_solid_angle`](Rectangle::by_solid_angle) | |
//! | [`Polygon`], 3 to 8 corners | [`by_area`](Polygon::by_area) | [`by_solid_angle`](Polygon::by_solid_angle) | [`by_projected_solid_angle`](Polygon::by_projected_solid_angle) |
//! | [`Triangle`], [`Rectangle`] | | [`by_cosine_warp`](Rectangle::by_cosine_warp), times about the cosine | |
//! | [`BilinearPatch`] | [`by_area`](BilinearPatch::by_area) | | |
//! | [`Disk`] | [`by_area`](Disk::by_area) | [`by_solid_angle`](Disk::by_solid_angle) | |
//! | [`Cylinder`] | [`by_area`](Cylinder::by_area): half of it and more faces away | | |
//! | [`Line`] | by [length](Line::by_length) | by [angle](Line::by_angle) | [`by_projected_solid_angle`](Line::by_projected_solid_angle) |
//! | [`Sun`] | | [`by_solid_angle`](Sun::by_solid_angle) | |
//! | [`ConstantEnvironment`] | | [`by_solid_angle`](ConstantEnvironment::by_solid_angle), or by the cosine | |
//! | [`ImageEnvironment`] | | [`by_radiance`](ImageEnvironment::by_radiance): in proportion to an image | |
//! | [`PointLight`], [`SpotLight`], [`DirectionalLight`] | one direction: `delta` holds | | |

mod delta;
mod distant;
mod environment;
mod line;
mod patch;
mod polygon;
mod round;

pub use delta::{DirectionalLight, PointLight, SpotLight};
pub use distant::{ConstantEnvironment, Sun};
pub use environment::{EnvironmentMap, EnvironmentSample, ImageEnvironment, Texel};
pub use line::Line;
pub use patch::BilinearPatch;
pub use polygon::Polygon;
pub use round::{Cylinder, Disk};

use crate::lanewise::lanewise;
use crate::math::rsqrt;
use crate::real::{Mask, Real};
use crate::spherical::{
    CosineWarped, DirectionSample, ProjectedCap, ProjectedPolygon, ProjectedTriangle, SphericalCap,
    SphericalParallelogram, SphericalRectangle, SphericalTriangle,
};
use crate::vector::{Vec2, Vec3};
use crate::warp::{AreaTriangle, UniformSphere, Warp};

/// One sample of a light from a shading point.
#[derive(Clone, Copy, Debug)]
pub struct LightSample<R: Real> {
    /// Unit direction from the shading point to the light.
    pub direction: Vec3<R>,
    /// Distance to the light along it.
    pub distance: R,
    /// Density per steradian; 0 in lanes that hold no sample (a degenerate light, a point on the light).
    pub pdf: R,
    /// True where the point sees the side of the light that emits if the light is one-sided: the side of the normal.
    pub emits: R::Mask,
    /// True where no direction drawn otherwise can hit the light ([`PointLight`], [`SpotLight`], [`DirectionalLight`], [`Line`]). Then `pdf` is no density per
    /// steradian: it is what the estimator divides by, and multiple importance sampling must give the sample the weight 1.
    pub delta: R::Mask,
}

/// The distance to a light that is infinitely far: the largest single-precision number.
pub const FAR: f64 = f32::MAX as f64;

/// Area measure to solid angle: 1/area · distance² / |cosθ'|, finite or 0.
///
/// `along` = |direction · N| for a normal N of length `area`.
#[inline(always)]
fn solid_angle_pdf<R: Real>(distance: R, along: R) -> R {
    let pdf = distance * distance / R::blend(along.gt(R::lit(0.0)), along, R::lit(1.0));
    pdf.keep(along.gt(R::lit(0.0)) & pdf.lt(R::lit(1e37)) & distance.gt(R::lit(0.0)))
}

/// Direction and distance of a point relative to the viewpoint, at any scale; zeros where either is beyond the largest number.
#[inline(always)]
fn direction_to<R: Real>(point: Vec3<R>) -> DirectionSample<R> {
    let (zero, infinity) = (R::lit(0.0), R::lit(f64::INFINITY));
    let reach = point.max_abs();
    let finite = reach.lt(infinity);
    let scale = reach.keep(finite).pow2_scale();
    let scaled = Vec3::new(point.x.keep(finite), point.y.keep(finite), point.z.keep(finite)) * scale;
    let squared = scaled.length_squared();
    let inverse = rsqrt(squared).keep(squared.gt(zero));
    let distance = squared * inverse / scale;
    DirectionSample { direction: scaled * inverse, distance: distance.keep(distance.lt(infinity)) }
}

lanewise! {
    /// A sphere that emits outwards.
    pub struct Sphere {
        /// Centre.
        pub center: Vec3<R>,
        /// Radius.
        pub radius: R,
    }
}

impl<R: Real> Sphere<R> {
    /// Uniform over the surface: half of it and more faces away. pdf = distance²/(|cosθ'| 4πR²).
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let normal: Vec3<R> = UniformSphere.sample(u);
        let DirectionSample { direction, distance } = direction_to((self.center - p) + normal * self.radius);
        let cos = direction.dot(normal);
        let area = self.radius * self.radius * R::lit(4.0 * core::f64::consts::PI);
        let pdf = solid_angle_pdf(distance, cos.abs() * area);
        LightSample { direction, distance, pdf, emits: cos.lt(R::lit(0.0)), delta: R::Mask::splat(false) }
    }
    /// Uniform over the cone of directions, [`SphericalCap`]: every sample hits the near side.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let cap = SphericalCap::new(self.center - p, self.radius);
        let DirectionSample { direction, distance } = cap.sample_direction(u);
        LightSample { direction, distance, pdf: cap.uniform_pdf(), emits: !cap.inside(), delta: R::Mask::splat(false) }
    }
}

impl<R: Real> Sphere<R> {
    /// Uniform over the projected solid angle above the horizon of `normal`, [`ProjectedCap`]: on an unoccluded diffuse surface every
    /// sample is worth the same. pdf 0 where nothing of the sphere is above the horizon.
    #[inline]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, normal: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let cap = ProjectedCap::new(self.center - p, self.radius, normal);
        let DirectionSample { direction, distance } = cap.sample_direction(u);
        LightSample {
            direction,
            distance,
            pdf: cap.pdf_at_cosine(direction.dot(normal)),
            emits: !cap.inside(),
            delta: R::Mask::splat(false),
        }
    }
}

lanewise! {
    /// A triangle that emits on the side of (v1−v0)×(v2−v0).
    pub struct Triangle {
        /// First vertex.
        pub v0: Vec3<R>,
        /// v1 − v0.
        pub e1: Vec3<R>,
        /// v2 − v0.
        pub e2: Vec3<R>,
    }
}

impl<R: Real> Triangle<R> {
    /// Uniform over the surface. pdf = distance²/(|cosθ'| A).
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let b: Vec2<R> = AreaTriangle.sample(u);
        let point = self.e1.mul_add(b.x, self.e2.mul_add(b.y, self.v0 - p));
        flat_by_area(point, self.e1.cross(self.e2) * R::lit(0.5))
    }
    /// Uniform over the solid angle, [`SphericalTriangle`].
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let v0 = self.v0 - p;
        let seen = SphericalTriangle::with_edges(v0, v0 + self.e1, v0 + self.e2, self.e1, self.e2);
        let DirectionSample { direction, distance } = seen.sample_direction(u);
        LightSample {
            direction,
            distance,
            pdf: seen.uniform_pdf(),
            emits: seen.in_front(),
            delta: R::Mask::splat(false),
        }
    }
    /// Uniform over the projected solid angle above the horizon of `normal`, [`ProjectedTriangle`]: on an unoccluded diffuse surface
    /// every sample is worth the same. pdf 0 where nothing of the triangle is above the horizon.
    #[inline]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, normal: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let v0 = self.v0 - p;
        let seen = ProjectedTriangle::with_edges(v0, v0 + self.e1, v0 + self.e2, self.e1, self.e2, normal);
        let DirectionSample { direction, distance } = seen.sample_direction(u);
        LightSample {
            direction,
            distance,
            pdf: seen.pdf_at_cosine(direction.dot(normal)),
            emits: seen.in_front(),
            delta: R::Mask::splat(false),
        }
    }
}

impl<R: Real> Triangle<R> {
    /// By solid angle times a bilinear approximation of the cosine to the unit normal of the surface, [`CosineWarped`]: for diffuse surfaces,
    /// where the projected solid angle is too dear.
    #[inline(always)]
    pub fn by_cosine_warp(&self, p: Vec3<R>, normal: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let v0 = self.v0 - p;
        let (v1, v2) = (v0 + self.e1, v0 + self.e2);
        let seen = SphericalTriangle::with_edges(v0, v1, v2, self.e1, self.e2);
        let [a, b, c] = [v0, v1, v2].map(|v| direction_to(v).direction.dot(normal));
        // the map sweeps about v1, from v0 to v2
        let warped = CosineWarped::with_cosines(seen, [b, b, a, c]);
        let v = warped.weights.sample(u);
        let DirectionSample { direction, distance } = seen.sample_direction(v);
        let pdf = seen.uniform_pdf() * warped.weights.pdf(v);
        LightSample { direction, distance, pdf, emits: seen.in_front(), delta: R::Mask::splat(false) }
    }
}

lanewise! {
    /// A parallelogram p + su + tv, s and t in [0, 1], that emits on the side of u×v.
    pub struct Parallelogram {
        /// Corner.
        pub p: Vec3<R>,
        /// Edge.
        pub u: Vec3<R>,
        /// Edge.
        pub v: Vec3<R>,
    }
}

impl<R: Real> Parallelogram<R> {
    /// Uniform over the surface. pdf = distance²/(|cosθ'| A).
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let point = self.u.mul_add(u.x, self.v.mul_add(u.y, self.p - p));
        flat_by_area(point, self.u.cross(self.v))
    }
    /// Uniform over the solid angle, [`SphericalParallelogram`].
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let seen = SphericalParallelogram::new(self.p - p, self.u, self.v);
        let DirectionSample { direction, distance } = seen.sample_direction(u);
        LightSample {
            direction,
            distance,
            pdf: seen.uniform_pdf(),
            emits: seen.in_front(),
            delta: R::Mask::splat(false),
        }
    }
    /// Uniform over the projected solid angle above the horizon of `normal`, [`ProjectedPolygon`]: on an unoccluded diffuse surface
    /// every sample is worth the same. pdf 0 where nothing of the parallelogram is above the horizon.
    #[inline]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, normal: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let seen = ProjectedPolygon::parallelogram(self.p - p, self.u, self.v, normal);
        let DirectionSample { direction, distance } = seen.sample_direction(u);
        LightSample {
            direction,
            distance,
            pdf: seen.pdf_at_cosine(direction.dot(normal)),
            emits: seen.in_front(),
            delta: R::Mask::splat(false),
        }
    }
}

lanewise! {
    /// A rectangle p + su + tv, s and t in [0, 1], u perpendicular to v, that emits on the side of u×v.
    pub struct Rectangle {
        /// Corner.
        pub p: Vec3<R>,
        /// Edge.
        pub u: Vec3<R>,
        /// Edge, perpendicular to `u`.
        pub v: Vec3<R>,
    }
}

impl<R: Real> Rectangle<R> {
    /// Uniform over the surface. pdf = distance²/(|cosθ'| A).
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        Parallelogram { p: self.p, u: self.u, v: self.v }.by_area(p, u)
    }
    /// Uniform over the solid angle, [`SphericalRectangle`]: as the parallelogram, but strata keep their sides along the edges.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let seen = SphericalRectangle::new(self.p - p, self.u, self.v);
        let DirectionSample { direction, distance } = seen.sample_direction(u);
        LightSample {
            direction,
            distance,
            pdf: seen.uniform_pdf(),
            emits: seen.in_front(),
            delta: R::Mask::splat(false),
        }
    }
}

impl<R: Real> Rectangle<R> {
    /// By solid angle times a bilinear approximation of the cosine to the unit normal of the surface, [`CosineWarped`]: for diffuse surfaces.
    #[inline(always)]
    pub fn by_cosine_warp(&self, p: Vec3<R>, normal: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let corner = self.p - p;
        let seen = SphericalRectangle::new(corner, self.u, self.v);
        let corners = [corner, corner + self.u, corner + self.v, corner + self.u + self.v];
        let warped = CosineWarped::with_cosines(seen, corners.map(|v| direction_to(v).direction.dot(normal)));
        let v = warped.weights.sample(u);
        let DirectionSample { direction, distance } = seen.sample_direction(v);
        let pdf = seen.uniform_pdf() * warped.weights.pdf(v);
        LightSample { direction, distance, pdf, emits: seen.in_front(), delta: R::Mask::splat(false) }
    }
}

/// The sample at a point of a flat shape, uniform over the area |normal|.
#[inline(always)]
fn flat_by_area<R: Real>(point: Vec3<R>, normal: Vec3<R>) -> LightSample<R> {
    let DirectionSample { direction, distance } = direction_to(point);
    let along = direction.dot(normal);
    LightSample {
        direction,
        distance,
        pdf: solid_angle_pdf(distance, along.abs()),
        emits: along.lt(R::lit(0.0)),
        delta: R::Mask::splat(false),
    }
}
/// The same where sums of edges may have overflowed: then there is nothing to see.
#[inline(always)]
fn finite_by_area<R: Real>(point: Vec3<R>, normal: Vec3<R>) -> LightSample<R> {
    let below = |x: R| x.abs().lt(R::lit(f64::INFINITY));
    let finite = [point, normal].map(|v| below(v.x) & below(v.y) & below(v.z));
    let finite = finite[0] & finite[1];
    let kept = |v: Vec3<R>| Vec3::new(v.x.keep(finite), v.y.keep(finite), v.z.keep(finite));
    flat_by_area(kept(point), kept(normal))
}
