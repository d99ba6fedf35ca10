//! Spheres by the lobes of rough surfaces.

mod cone;
mod ellipse;

use super::area::PlacedSphere;
use super::solid_angle::SphericalCap;
use crate::lanewise::lanewise;
use crate::light::direction::above_horizon;
use crate::light::sample::LightSample;
use crate::light::sampler::{LightSampler, drawn, found};
use crate::light::surface::{AreaSurface, Surface};
use crate::math::ratio;
use crate::real::Real;
use crate::reflection::Reflection;
use crate::vector::{Frame, Vec2, Vec3};
use core::f64::consts::PI;
use ellipse::ReflectedCap;

impl<R: Real> Reflection<R> {
    /// The directions to a sphere with this centre relative to the point, after the map.
    #[inline(always)]
    fn cap(&self, center: Vec3<R>, radius: R) -> ReflectedCap<R> {
        let cap = SphericalCap::new(center, radius);
        let (Frame { s, t, n }, height, spread) = cap.rim();
        let axes = [n * height, s, t].map(|v| self.to_cosine(v));
        ReflectedCap::new(axes, [height, spread], self.determinant(), cap.inside() & radius.gt(R::lit(0.0)))
    }
    /// The projected solid angle after the map, in [0, π], of the part above the horizon of a sphere with this centre relative to the point:
    /// about π times the part of the lobe that the sphere covers. A radius ≤ 0 gives 0, and a point inside π.
    ///
    /// Greatest error in single precision: 4e−5 of the result plus 1e−4, and 5e−4 of it where the horizon cuts the sphere (measured by
    /// `LONG=1 cargo test -p etendue-tests reflection -- --nocapture` down to angular radii of 1e−3).
    #[inline]
    pub fn sphere(&self, center: Vec3<R>, radius: R) -> R {
        let (zero, pi) = (R::lit(0.0), R::lit(PI));
        let cap = SphericalCap::new(center, radius);
        let [middle, u, v] = cap.circle().map(|v| self.to_cosine(v));
        let covered = cone::projected_solid_angle(middle, u, v).clamped(zero, pi);
        R::blend(cap.inside(), pi, covered).keep(radius.gt(zero))
    }
}

lanewise! {
    /// A [`Sphere`](crate::Sphere) sampled by the lobe of a rough surface.
    ///
    /// - Formula: the map of the [`Reflection`] makes an elliptic cone of the cone of directions to the sphere. Half planes about a horizontal
    ///   line sweep it, and directions have a latitude in them; the projected solid angle is ∫∫ sinφ cos²λ dλ dφ. The density over an
    ///   angle φ₀ + Φ sin²θ has eight cells of equal width in θ, exact at their ends: two parabolas and lines between. The density
    ///   over the latitude is two lines, exact at both ends and in the middle.
    /// - Domain: u in [0, 1)²; any centre and radius, also where the horizon cuts the sphere.
    /// - Density: the pdf, per steradian, is known exactly and integrates to 1 over the sphere above the horizon. It is nearly π times that of
    ///   the [`Reflection`] over the projected solid angle after its map: the ratio of both has a standard deviation of 0.03 on average for
    ///   small spheres, 0.09 for those that nearly touch the point, and 0.2 from inside. Measured by
    ///   `LONG=1 cargo test -p etendue-tests samples_vary_little -- --nocapture`.
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
    #[inline(always)]
    pub(super) fn new(surface: PlacedSphere<R>, reflection: &Reflection<R>) -> Self {
        let shape = reflection.cap(surface.center, surface.radius);
        Self { reflection: *reflection, surface, shape }
    }
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
        let normal = self.reflection.normal();
        // of a sphere whose angular radius underflows, the map has no axes
        let direction = Vec3::blend(direction.is_within(R::lit(2.0)), direction, normal);
        let direction = above_horizon(direction, normal);
        drawn(direction, self.pdf(direction), self.surface.at(direction), self.surface.outside()).drawn_from(u)
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
