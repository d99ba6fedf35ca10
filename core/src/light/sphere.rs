//! Spheres.

use super::sample::LightSample;
use super::sampler::{ByArea, ByProjectedSolidAngle, BySolidAngle, LightSampler, drawn, found};
use super::surface::{AreaSurface, SURFACE_SLACK, Surface, SurfaceHit, SurfacePoint};
use crate::lanewise::lanewise;
use crate::math::{quotient, ratio};
use crate::real::Real;
use crate::reflection::{ReflectedCap, Reflection};
use crate::spherical::{ProjectedCap, SphericalCap, above_horizon, to_unit};
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
        ByArea { surface: self.placed(p) }
    }
    /// Uniform over the cone of directions Ω at the point `p`, [`SphericalCap`]: every sample hits the near side; pdf 1/Ω per steradian.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> SphereBySolidAngle<R> {
        let shape = SphericalCap::new(self.center - p, self.radius);
        BySolidAngle { surface: self.placed(p), shape }
    }
    /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal `n` at the point `p`, [`ProjectedCap`]: pdf cosθ/Ω⊥
    /// per steradian, 0 where nothing of the sphere is above the horizon. On an unoccluded diffuse surface every sample has the same
    /// value.
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> SphereByProjectedSolidAngle<R> {
        let shape = ProjectedCap::new(self.center - p, self.radius, n);
        ByProjectedSolidAngle { normal: n, surface: self.placed(p), shape }
    }
    /// Nearly in proportion to the lobe of a rough surface at the point `p`: [`SphereByReflection`]. The pdf is per steradian; 0 where nothing
    /// of the sphere is above the horizon.
    #[inline(always)]
    pub fn by_reflection(&self, p: Vec3<R>, reflection: &Reflection<R>) -> SphereByReflection<R> {
        let shape = reflection.cap(self.center - p, self.radius);
        SphereByReflection { reflection: *reflection, surface: self.placed(p), shape }
    }
}

/// A [`Sphere`] sampled by area from a point.
pub type SphereByArea<R> = ByArea<PlacedSphere<R>>;
/// A [`Sphere`] sampled by solid angle from a point.
pub type SphereBySolidAngle<R> = BySolidAngle<PlacedSphere<R>, SphericalCap<R>>;
/// A [`Sphere`] sampled by projected solid angle from a point on a surface.
pub type SphereByProjectedSolidAngle<R> = ByProjectedSolidAngle<R, PlacedSphere<R>, ProjectedCap<R>>;

lanewise! {
    /// A [`Sphere`] sampled by the lobe of a rough surface.
    ///
    /// - Formula: the map of the [`Reflection`] makes an elliptic cone of the cone of directions to the sphere. Half planes about a horizontal
    ///   line sweep it, and directions have a latitude in them; the projected solid angle is ∫∫ sinφ cos²λ dλ dφ. The density over an
    ///   angle φ₀ + Φ sin²θ has eight cells of equal width in θ, exact at their ends: two parabolas and lines between. The density
    ///   over the latitude is two lines, exact at both ends and in the middle.
    /// - Domain: u in [0, 1)²; any centre and radius, also where the horizon cuts the sphere.
    /// - Density: the pdf, per steradian, is known exactly and integrates to 1 over the sphere above the horizon. It is nearly π times that of
    ///   the [`Reflection`] over the projected solid angle after its map: the ratio of both has a standard deviation of 0.03 on average for
    ///   small spheres, 0.09 for those that nearly touch the point, and 0.2 from inside. Measured by
    ///   `LONG=1 cargo test -p etendue-tests --test reflection -- samples_vary_little --nocapture`.
    /// - Degenerate input: a radius ≤ 0, and a sphere below the horizon, give pdf 0; from inside, all directions above the horizon are
    ///   sampled, and `emits` is false.
    /// - Greatest error: a direction is rounded to 10⁻⁷, times what the inverse of the map stretches there. For spheres with an angular
    ///   radius σ that moves the mean of weights by up to 4·10⁻⁹/σ, and more where the sphere is within 10⁻⁵ of the horizon: of spheres with
    ///   σ = 10⁻⁶, samples there are rounding.
    /// - Source: derived here.
    pub struct SphereByReflection {
        reflection: Reflection<R>,
        surface: PlacedSphere<R>,
        /// The sphere after the map of the reflection.
        shape: ReflectedCap<R>,
    }
}
impl<R: Real> SphereByReflection<R> {
    /// Projected solid angle of the sphere above the horizon after the map of the reflection, in [0, π]: π times the part of the lobe that
    /// the sphere covers. It is computed anew, by [`Reflection::sphere`]; samples do not need it.
    #[inline]
    pub fn projected_solid_angle(&self) -> R {
        self.reflection.sphere(self.surface.center, self.surface.radius)
    }
}
impl<R: Real> LightSampler<R> for SphereByReflection<R> {
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        let direction = self.surface.inwards(self.reflection.from_cosine(self.shape.sample(u)).unit_and_length().0);
        let direction = above_horizon(direction, self.reflection.normal());
        drawn(direction, self.pdf(direction), self.surface.at(direction), self.surface.outside())
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        let (mapped, length) = self.reflection.to_cosine(w).unit_and_length();
        let inverse = ratio(R::lit(1.0), length);
        let pdf = self.shape.pdf(mapped) * (self.reflection.determinant() * inverse * inverse * inverse);
        pdf.keep(self.surface.contains(w) & mapped.z.gt(R::lit(0.0)) & pdf.lt(R::lit(1e37)))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.shape.invert(self.reflection.to_cosine(w).unit_and_length().0)
    }
    #[inline(always)]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        found(w, self.pdf(w), &self.surface, Some(self.surface.outside()))
    }
}

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
    /// True where the point is not strictly inside.
    #[inline(always)]
    fn outside(&self) -> R::Mask {
        let ([center, Vec3 { x: radius, .. }], _) =
            to_unit([self.center, Vec3::new(self.radius, R::lit(0.0), R::lit(0.0))]);
        center.length_squared_minus_square(radius).ge(R::lit(0.0))
    }
    /// The unit vector, or the nearest one within the angular radius R/d where rounding has taken it beyond.
    #[inline(always)]
    fn inwards(&self, w: Vec3<R>) -> Vec3<R> {
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
