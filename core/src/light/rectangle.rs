//! Rectangles.

pub(super) mod solid_angle;

use super::bound::LightBound;
use super::parallelogram::area::PlacedParallelogram;
use super::parallelogram::{
    Parallelogram, ParallelogramByArea, ParallelogramByProjectedSolidAngle, ParallelogramByReflection,
};
use super::sampler::{ByArea, BySolidAngle};
use crate::lanewise::lanewise;
use crate::real::Real;
use crate::reflection::Reflection;
use crate::vector::Vec3;
use solid_angle::SphericalRectangle;

lanewise! {
    /// A rectangle light corner + s·edge_s + t·edge_t, s and t in [0, 1], with perpendicular edges, that emits from the side of
    /// edge_s × edge_t.
    ///
    /// Its map by solid angle keeps the sides of strata along the edges, for 1.7 times the cost of the [`Parallelogram`]'s. A point in
    /// the plane of the rectangle, or a rectangle without area, gives pdf 0. Surface coordinates: (s, t).
    pub struct Rectangle {
        /// Corner, in the coordinates of the scene.
        pub corner: Vec3<R>,
        /// Edge along s.
        pub edge_s: Vec3<R>,
        /// Edge along t, perpendicular to `edge_s`.
        pub edge_t: Vec3<R>,
    }
}

impl<R: Real> Rectangle<R> {
    /// The rectangle with this corner and these edges from there, which must be perpendicular.
    #[inline(always)]
    pub fn new(corner: Vec3<R>, edge_s: Vec3<R>, edge_t: Vec3<R>) -> Self {
        Self { corner, edge_s, edge_t }
    }
    #[inline(always)]
    fn placed(&self, p: Vec3<R>) -> PlacedParallelogram<R> {
        PlacedParallelogram::new(self.corner - p, self.edge_s, self.edge_t)
    }
    /// Uniform over the surface, seen from the point `p`: pdf distance²/(|cosθ'| A) per steradian, with the error of
    /// [`Triangle::by_area`](crate::Triangle::by_area).
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> ParallelogramByArea<R> {
        ByArea { surface: self.placed(p) }
    }
    /// Uniform over the solid angle Ω at the point `p`: pdf 1/Ω per steradian.
    ///
    /// The map is that of Ureña et al.: u₀ moves along `u` so that the area swept on the sphere is u₀Ω, and u₁ moves along `v`
    /// uniformly in y/√(x²+y²+z²). Where the rectangle lies to one side of the foot of the perpendicular, both coordinates are
    /// differences from the far edge, formed without cancellation; elsewhere they are distances from the foot. So a rectangle
    /// of 1e−9 of its distance is sampled as well as one that fills the hemisphere.
    ///
    /// - Formula: x, y, z are coordinates along the edges and the normal, y₀, y₁ the ends in y, x₁ the far end in x, mᵢ² =
    ///   yᵢ²+z², ψᵢ = atan(yᵢ/z). The strip \[0, x\]×\[y₀, y₁\] has the solid angle w = asin(X sinψ₁) − asin(X sinψ₀), X =
    ///   x/√(x²+z²); therefore x = z sinw/√M, M = (cosw−p)(cosw+s) with p = cos(ψ₁−ψ₀), s = cos(ψ₁+ψ₀). With w = w₁ − 2e, 2e =
    ///   (1−u₀)Ω, and the difference k = cosw − cosw₁ = 2 sin(w₁−e) sin e, M is (k + (cosw₁−p))(k + (cosw₁+s)), and x₁−x =
    ///   (x₁/sinw₁)² kQ/(√M(x₁√M + z sinw)), Q = sin²w₁(A+B+k) + (cosw+cosw₁)AB with A = cosw₁−p, B = cosw₁+s. With D² = x²+z²,
    ///   h = y/√(D²+y²) = h₁ − (1−u₁)(h₁−h₀): y = Dh/√(1−h²), 1−h² = (1−h₁²) + (h₁−h)(h₁+h).
    /// - Domain: u in [0, 1)²; any rectangle, from either side. The map ignores any shear of the edges: for edges that are not
    ///   perpendicular, use [`Parallelogram::by_solid_angle`](crate::Parallelogram::by_solid_angle).
    /// - Density: the pdf is 1/Ω per steradian inside (and within 8 ulp beyond), 0 outside.
    /// - Degenerate input: the point in the plane, zero area, edges less than 1e−3 from parallel, or lengths whose sums overflow: Ω = 0 and
    ///   pdf 0.
    /// - Greatest error: direction 6e−7 (4e−5 of the rectangle's size if that is 1e−6 and the point is 1e−7
    ///   above its plane), besides what 8 steps of 2⁻²⁴ in u do to it (Ω and u₀Ω are rounded; u₀ counts from the nearer end
    ///   where the rectangle lies on both sides of the foot). pdf 5e−7 relative, since coordinates, and heights
    ///   whose terms cancel, are formed in twice the working precision. Next to the plane of a rectangle that surrounds the
    ///   point, nearly all of u₀ lies within the
    ///   rounding of a direction at the ends: the inverse is then one of the `u` that lead back to the direction.
    /// - Source: Ureña, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles"; the forms without
    ///   cancellation are derived here from w = w₁ − 2e.
    #[doc(alias = "Urena")]
    #[doc(alias = "SampleSphericalRectangle")]
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> RectangleBySolidAngle<R> {
        let shape = SphericalRectangle::new(self.corner - p, self.edge_s, self.edge_t);
        BySolidAngle { surface: self.placed(p), shape }
    }
    /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal `n` at the point `p`, as a parallelogram:
    /// [`Parallelogram::by_projected_solid_angle`].
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> ParallelogramByProjectedSolidAngle<R> {
        Parallelogram::from(*self).by_projected_solid_angle(p, n)
    }
    /// In proportion to the lobe of a rough surface at the point `p`, as a parallelogram: [`Triangle::by_reflection`](crate::Triangle::by_reflection).
    #[inline(always)]
    pub fn by_reflection(&self, p: Vec3<R>, reflection: &Reflection<R>) -> ParallelogramByReflection<R> {
        Parallelogram::from(*self).by_reflection(p, reflection)
    }
}

impl<R: Real<Scalar = R>> Rectangle<R> {
    /// What it can contribute with this radiance. One that is not positive gives the power 0.
    #[must_use]
    pub fn bound(&self, radiance: R) -> LightBound {
        Parallelogram::from(*self).bound(radiance)
    }
}

impl<R> From<Rectangle<R>> for Parallelogram<R> {
    #[inline(always)]
    fn from(Rectangle { corner, edge_s, edge_t }: Rectangle<R>) -> Self {
        Self { corner, edge_s, edge_t }
    }
}

/// A [`Rectangle`] sampled by solid angle from a point.
pub type RectangleBySolidAngle<R> = BySolidAngle<PlacedParallelogram<R>, SphericalRectangle<R>>;
