//! Spheres.

use super::sampler::{ByArea, ByProjectedSolidAngle, BySolidAngle};
use super::surface::{AreaSurface, SURFACE_SLACK, Surface, SurfaceHit, SurfacePoint};
use crate::lanewise::lanewise;
use crate::math::quotient;
use crate::real::Real;
use crate::spherical::{ProjectedCap, SphericalCap, to_unit};
use crate::vector::{Vec2, Vec3};
use crate::warp::{UniformSphere, Warp};
use core::f64::consts::PI;

lanewise! {
    /// A sphere light that emits outwards.
    ///
    /// Take [`by_solid_angle`](Self::by_solid_angle), or [`by_projected_solid_angle`](Self::by_projected_solid_angle) on diffuse
    /// surfaces; [`by_area`](Self::by_area) wastes more than half of its samples. A radius ≤ 0 gives pdf 0; from inside every direction
    /// hits the sphere and `emits` is false.
    ///
    /// ```
    /// use etendue::{LightSampler, Sphere, Vec2};
    /// let bulb = Sphere::new([0.0, 3.0, 0.0].into(), 0.5_f32).by_solid_angle([0.0; 3].into());
    /// let s = bulb.sample(Vec2::new(0.3, 0.6));
    /// assert!(s.valid() && s.distance >= 2.5 && bulb.hit(s.direction).valid());
    /// ```
    ///
    /// Surface coordinates: those that [`UniformSphere`](crate::warp::UniformSphere) maps to the normal.
    pub struct Sphere {
        /// Centre, in the coordinates of the scene.
        pub center: Vec3<R>,
        /// Radius, in the unit of the coordinates.
        pub radius: R,
    }
}

impl<R: Real> Sphere<R> {
    /// The sphere with this centre and radius.
    #[inline(always)]
    pub fn new(center: Vec3<R>, radius: R) -> Self {
        Self { center, radius }
    }
    #[inline(always)]
    fn placed(&self, p: Vec3<R>) -> PlacedSphere<R> {
        PlacedSphere::new(self.center - p, self.radius)
    }
    /// Uniform over the surface: (1 + R/d)/2 of the samples, at the distance d, face away and have `emits` false.
    ///
    /// - pdf of a sample: distance²/(|cosθ'| 4πR²) per steradian, of the point that was drawn.
    /// - pdf of a direction: that of the nearest point in it, which a rounded direction determines only as well as it
    ///   determines the point.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> SphereByArea<R> {
        ByArea { origin: p, surface: self.placed(p) }
    }
    /// Uniform over the cone of directions Ω at the point `p`, [`SphericalCap`]: every sample hits the near side; pdf 1/Ω per steradian.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> SphereBySolidAngle<R> {
        let shape = SphericalCap::new(self.center - p, self.radius);
        BySolidAngle { origin: p, surface: self.placed(p), shape }
    }
    /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal `n` at the point `p`, [`ProjectedCap`]: pdf cosθ/Ω⊥
    /// per steradian, 0 where nothing of the sphere is above the horizon. On an unoccluded diffuse surface every sample has the same
    /// value.
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> SphereByProjectedSolidAngle<R> {
        let shape = ProjectedCap::new(self.center - p, self.radius, n);
        ByProjectedSolidAngle { origin: p, normal: n, surface: self.placed(p), shape }
    }
}

/// A [`Sphere`] sampled by area from a point.
pub type SphereByArea<R> = ByArea<R, PlacedSphere<R>>;
/// A [`Sphere`] sampled by solid angle from a point.
pub type SphereBySolidAngle<R> = BySolidAngle<R, PlacedSphere<R>, SphericalCap<R>>;
/// A [`Sphere`] sampled by projected solid angle from a point on a surface.
pub type SphereByProjectedSolidAngle<R> = ByProjectedSolidAngle<R, PlacedSphere<R>, ProjectedCap<R>>;

lanewise! {
    /// A sphere relative to the shading point. Its surface coordinates are those that [`UniformSphere`] maps to the normal: height and
    /// azimuth.
    pub struct PlacedSphere {
        pub(super) center: Vec3<R>,
        pub(super) radius: R,
    }
}
impl<R: Real> PlacedSphere<R> {
    #[inline(always)]
    pub(super) fn new(center: Vec3<R>, radius: R) -> Self {
        Self { center, radius }
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
