//! Spheres.

pub(super) mod area;
pub(super) mod projected;
mod reflected;
pub(super) mod solid_angle;

use super::bound::{LightBound, wide};
use super::sampler::{ByArea, ByProjectedSolidAngle, BySolidAngle};
use crate::lanewise::lanewise;
use crate::real::Real;
use crate::reflection::Reflection;
use crate::vector::Vec3;
use area::PlacedSphere;
use core::f64::consts::PI;
use projected::ProjectedCap;
pub use reflected::SphereByReflection;
use solid_angle::SphericalCap;

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
    /// Uniform over the cone of directions Ω at the point `p`: every sample hits the near side; pdf 1/Ω per steradian.
    ///
    /// - Formula: sin²σ = R²/d², cos²σ = (d²−R²)/d² with d²−R² in twice the working precision where
    ///   d² < 2R², h = 1−cosσ = sin²σ/(1+cosσ);
    ///   then the cone's map. From inside, h = 2.
    /// - Domain: any centre and radius > 0, at any distance; from a point on the surface, the half of the directions that look
    ///   inwards.
    /// - Density: the pdf is 1/(2πh) per steradian within the cone (and within 10 ulp beyond), 0 outside.
    /// - Degenerate input: a radius ≤ 0 (or too small for f32: R/d < 1e−18) has pdf 0 and samples the direction to the centre.
    /// - Greatest error: pdf 3.0e−7 relative (proved: 2e−6); direction 4.8e−7 (proved for all u: 1.5e−6, for R from 1e−4 of the
    ///   greatest coordinate to where the sphere nearly touches); distance 3.6e−7 relative, except at the limb, where its slope
    ///   is infinite.
    /// - Source: PBR 4th ed., 6.2.4, in a form without its switch to a series for small spheres.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> SphereBySolidAngle<R> {
        let shape = SphericalCap::new(self.center - p, self.radius);
        BySolidAngle { surface: self.placed(p), shape }
    }
    /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal `n` at the point `p`: pdf cosθ/Ω⊥
    /// per steradian, 0 where nothing of the sphere is above the horizon. On an unoccluded diffuse surface every sample has the same
    /// value.
    ///
    /// Let σ be the cap's half-angle and ω the angle from the normal to its axis. Projected to the disk below the hemisphere, the
    /// cap is an ellipse, which the horizon may cut. The density there is constant, and there are three cases:
    /// 1. whole, cosω ≥ sinσ: the concentric disk, scaled to the ellipse;
    /// 2. cut, with the axis above the horizon: slices across, starting at the far end. Beyond the two points where the cap meets
    ///    the horizon they end on the unit circle, before them on the ellipse. Either part is a circular segment, after scaling,
    ///    and u₀ solves φ − sinφ cosφ = its area;
    /// 3. cut, with the axis below the horizon: the lune between circle and ellipse, in slices along the azimuth plane of the
    ///    axis.
    ///
    /// - Formula: centre sinω cosσ, semi-axes sinσ cosω and sinσ; y = √((sinσ−cosω)(sinσ+cosω)) from the sphere and the normal
    ///   in twice the working precision, sinθ = y/sinω, cosθ = cosσ/sinω, κ = |cosω|/sinσ, cosψ = κ cosθ, S(φ) = φ − sinφ cosφ
    ///   and ρ(cosφ) = S(φ)/sin³φ, a polynomial of 1 − cosφ. Ω⊥ is π sin²σ cosω if whole; S(θ) + sin²σ cosω (π − S(ψ)) if cut
    ///   with the axis above, where no term is negative. With the axis below it is sin³θ (1−κ) D(cosθ, cosψ), where D(x, y) is
    ///   the divided difference of x ρ(x), itself a polynomial. At sinθ·t across, with m = 1−t², X = √(cos²θ + m sin²θ) on the
    ///   circle and Y = √(cos²ψ + m sin²ψ) on the ellipse, the width of the lune is sin²θ (1−κ) w with
    ///   w = (1+κ) m²/((cosθ+X)(cosψ+Y)(κX+Y)), and half its area up to t is sin³θ (1−κ) times
    ///   t w + ½t³ (1+κ)/Y·(m ρ(X)/(κX+Y) + t² cosθ cosψ D(X, Y)/(X+Y)): no difference is left. Halley's method inverts it.
    /// - Domain: u in [0, 1)²; any centre and radius > 0, from outside or inside; a normal of any length.
    /// - Density: the pdf is cosθ/Ω⊥ per steradian within the cone (and within 10 ulp beyond) and above the horizon, 0
    ///   elsewhere. From inside the sphere it is cosθ/π over the whole hemisphere.
    /// - Degenerate input: a radius ≤ 0, or a sphere wholly below the horizon: Ω⊥ = 0 and pdf 0; `sample` returns some unit
    ///   vector.
    /// - Greatest error: Ω⊥ 1.2e−6 relative. A sphere whose centre is below the horizon and that rises above it by less than 1e−6
    ///   of its distance has 1.6e−6, and 8e−14 over that fraction. Direction 4e−7, besides 4 steps of 2⁻²⁴ in u; where the
    ///   horizon touches the cap, the direction has the slope of a square root there and may be off by 1e−3 of the size. The
    ///   inverse leads back to the direction, except where the axis is within 4e−7 of the horizon: u may be off by 3e−3 there.
    ///   Directions have a cosine of at least 3 × 2⁻²⁴, so that none is lost below the horizon: a cap that rises less than 1e−6 above
    ///   it is sampled there by rounding, with an estimate without bias, to 1e−5.
    /// - Source: Ureña and Georgiev, "Stratified Sampling of Projected Spherical Caps", EGSR 2018, for the geometry; the two
    ///   maps of the cut cap and the forms without cancellation are derived here.
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> SphereByProjectedSolidAngle<R> {
        let shape = ProjectedCap::new(self.center - p, self.radius, n);
        ByProjectedSolidAngle { normal: n, surface: self.placed(p), shape }
    }
    /// Nearly in proportion to the lobe of a rough surface at the point `p`: [`SphereByReflection`]. The pdf is per steradian; 0 where nothing
    /// of the sphere is above the horizon.
    #[inline(always)]
    pub fn by_reflection(&self, p: Vec3<R>, reflection: &Reflection<R>) -> SphereByReflection<R> {
        SphereByReflection::new(self.placed(p), reflection)
    }
}

impl<R: Real<Scalar = R>> Sphere<R> {
    /// What it can contribute with this radiance. One that is not positive gives the power 0.
    #[must_use]
    pub fn bound(&self, radiance: R) -> LightBound {
        let radius = self.radius.lane_f64(0).greater(0.0);
        let flux = 4.0 * PI * PI * radius * radius * radiance.lane_f64(0);
        LightBound::about(wide(self.center), radius, flux)
    }
}

/// A [`Sphere`] sampled by area from a point.
pub type SphereByArea<R> = ByArea<PlacedSphere<R>>;
/// A [`Sphere`] sampled by solid angle from a point.
pub type SphereBySolidAngle<R> = BySolidAngle<PlacedSphere<R>, SphericalCap<R>>;
/// A [`Sphere`] sampled by projected solid angle from a point on a surface.
pub type SphereByProjectedSolidAngle<R> = ByProjectedSolidAngle<R, PlacedSphere<R>, ProjectedCap<R>>;
