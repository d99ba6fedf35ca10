//! Spheres by area.

use crate::lanewise::lanewise;
use crate::light::direction::to_unit;
use crate::light::surface::{AreaSurface, SURFACE_SLACK, Surface, SurfaceHit, SurfacePoint};
use crate::math::{quotient, ratio};
use crate::real::Real;
use crate::vector::{Vec2, Vec3};
use crate::warp::{UniformSphere, Warp};
use core::f64::consts::PI;

lanewise! {
    /// A sphere relative to the shading point. Its surface coordinates are those that [`UniformSphere`] maps to the normal: height and
    /// azimuth.
    pub struct PlacedSphere {
        pub(in crate::light) center: Vec3<R>,
        pub(in crate::light) radius: R,
    }
}
impl<R: Real> PlacedSphere<R> {
    #[inline(always)]
    pub(in crate::light) fn new(center: Vec3<R>, radius: R) -> Self {
        Self { center, radius }
    }
    /// True where the point is not strictly inside.
    #[inline(always)]
    pub(super) fn outside(&self) -> R::Mask {
        let ([center, Vec3 { x: radius, .. }], _) =
            to_unit([self.center, Vec3::new(self.radius, R::lit(0.0), R::lit(0.0))]);
        center.length_squared_minus_square(radius).ge(R::lit(0.0))
    }
    /// The unit vector, or the nearest one within the angular radius R/d where rounding has taken it beyond.
    #[inline(always)]
    pub(super) fn inwards(&self, w: Vec3<R>) -> Vec3<R> {
        let one = R::lit(1.0);
        let (axis, distance) = self.center.unit_and_length();
        let sine = ratio(self.radius, distance);
        let along = w.dot(axis);
        let across = axis.mul_add(-along, w);
        let length = across.length();
        let beyond = length.gt(sine) & along.gt(R::lit(0.0)) & sine.gt(R::lit(0.0));
        let cos = ((one - sine) * (one + sine)).greater(R::lit(0.0)).sqrt();
        Vec3::blend(beyond, across.mul_add(ratio(sine, length), axis * cos), w)
    }
}
impl<R: Real> Surface<R> for PlacedSphere<R> {
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        let zero = R::lit(0.0);
        let ([center, Vec3 { x: radius, .. }], scale) = to_unit([self.center, Vec3::new(self.radius, zero, zero)]);
        let power = center.length_squared_minus_square(radius);
        let along = w.dot(center);
        let across = w.mul_add(-along, center);
        let root = radius.mul_add(radius, -across.length_squared()).greater(zero).sqrt();
        let outside = power.ge(zero);
        // the root that is a sum, and the other one by their product
        let sum = root + along.abs();
        let near = quotient(power.abs(), sum);
        let distance = R::blend(!outside & along.ge(zero), sum, near);
        let normal = w.mul_add(distance, -center).normalize();
        let distance = (distance / scale).lesser(R::lit(f64::from(f32::MAX)));
        SurfaceHit { distance, normal, uv: UniformSphere.invert(normal) }
    }
    #[inline(always)]
    fn at_distance(&self, w: Vec3<R>, distance: R) -> SurfaceHit<R> {
        let zero = R::lit(0.0);
        let ([center, Vec3 { x: reach, .. }], _) = to_unit([self.center, Vec3::new(distance, zero, zero)]);
        let normal = w.mul_add(reach, -center).normalize();
        SurfaceHit { distance, normal, uv: UniformSphere.invert(normal) }
    }
}
impl<R: Real> AreaSurface<R> for PlacedSphere<R> {
    const FLAT: bool = false;
    #[inline(always)]
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R> {
        let normal: Vec3<R> = UniformSphere.sample(u);
        SurfacePoint { position: self.center + normal * self.radius, normal, uv: u, inverse_pdf: self.area() }
    }
    #[inline(always)]
    fn inverse_pdf(&self, _: Vec2<R>) -> R {
        self.area()
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        let zero = R::lit(0.0);
        let ([center, Vec3 { x: radius, .. }], _) = to_unit([self.center, Vec3::new(self.radius, zero, zero)]);
        let along = w.dot(center);
        let reach = center.length().mul_add(R::lit(SURFACE_SLACK), radius);
        let outside = center.length_squared_minus_square(radius).ge(zero);
        let hit = w.mul_add(-along, center).length().le(reach) & along.gt(zero);
        (hit | !outside) & radius.gt(zero)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.at(w).uv
    }
    #[inline(always)]
    fn area(&self) -> R {
        self.radius * self.radius * R::lit(4.0 * PI)
    }
}
