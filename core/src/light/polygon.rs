//! Convex polygons.

pub(super) mod area;
mod corners;
pub(super) mod projected;
pub(super) mod solid_angle;

use super::bound::{LightBound, wide};
use super::sampler::{ByArea, ByProjectedSolidAngle, ByReflection, BySolidAngle};
use crate::lanewise::lanewise_by_map;
use crate::real::Real;
use crate::reflection::Reflection;
use crate::vector::Vec3;
use area::PlacedPolygon;
use corners::PlacedCorners;
use projected::ProjectedPolygon;
use solid_angle::SphericalPolygon;

/// A convex polygon light of N corners, 3 ≤ N ≤ 8, that emits from the side on which they run counterclockwise.
///
/// Each technique samples a fan of triangles about the first corner. A point in the plane of the polygon, or a polygon without area,
/// gives pdf 0. Surface coordinates: the parts of the edges from the first corner to the second and to the last, clamped to [0, 1].
///
/// ```
/// use etendue::{LightSampler, Vec2, light::Polygon};
/// // a panel overhead that emits downwards
/// let panel = Polygon::new([[-1.0, 2.0, -1.0], [1.0, 2.0, -1.0], [1.0, 2.0, 1.0], [-1.0, 2.0, 1.0]].map(Into::into));
/// let s = panel.by_solid_angle([0.0, 0.0, 0.0_f32].into()).sample(Vec2::new(0.3, 0.6));
/// assert!(s.valid() && (s.direction.y * s.distance - 2.0).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Polygon<R, const N: usize> {
    /// Corners in order, in one plane, in the coordinates of the scene.
    pub corners: [Vec3<R>; N],
}

impl<R, const N: usize> Polygon<R, N> {
    /// Replaces each number x by `f(x)`.
    #[inline(always)]
    pub fn map<S>(self, mut f: impl FnMut(R) -> S) -> Polygon<S, N> {
        Polygon { corners: self.corners.map(|corner| corner.map(&mut f)) }
    }
}

lanewise_by_map!(Polygon, N);

impl<R: Copy + Default, const N: usize> Default for Polygon<R, N> {
    #[inline(always)]
    fn default() -> Self {
        Self { corners: [Vec3::default(); N] }
    }
}

impl<R: Real, const N: usize> Polygon<R, N> {
    /// The polygon with these corners, which must be in order and in one plane.
    #[inline(always)]
    pub fn new(corners: [Vec3<R>; N]) -> Self {
        Self { corners }
    }
    /// Uniform over the surface, seen from the point `p`: pdf distance²/(|cosθ'| A) per steradian, which follows from
    /// the rounded corners.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> PolygonByArea<R, N> {
        ByArea { surface: PlacedPolygon::new(self.corners, p) }
    }
    /// Uniform over the solid angle Ω at the point `p`: pdf 1/Ω per steradian.
    ///
    /// It is a fan of N − 2 spherical triangles about the first corner: u₀ sweeps about that corner from the second corner to
    /// the last, from one triangle into the next without a jump, so that strata of the square stay connected.
    ///
    /// - Formula: Ω = ΣΩᵢ; the first triangle i with Ω₁ + … + Ωᵢ > u₀Ω, at the rest of u₀Ω over Ωᵢ. Each lane selects its triangle,
    ///   and the map is computed once.
    /// - Domain: u in [0, 1)²; corners in order, either way round, coplanar to within their rounding.
    /// - Density: the pdf is 1/Ω per steradian inside (and within the triangle's 12 ulp beyond), 0 outside.
    /// - Degenerate input: corners may coincide or be collinear; otherwise as for the triangle.
    /// - Greatest error: as for the parallelogram, if the point is farther from the plane than the rounding of the corners. From
    ///   nearer, the fan overlaps itself, and up to all of Ω may be wrong. Where the corners are given in the coordinates of a scene, that
    ///   rounding is theirs, and for a small and far polygon it is what limits Ω.
    /// - Source: as for [`Triangle::by_solid_angle`](crate::Triangle::by_solid_angle).
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> PolygonBySolidAngle<R, N> {
        let shape = SphericalPolygon::seen_from(self.corners, p);
        BySolidAngle { surface: PlacedPolygon::new(self.corners, p), shape }
    }
    /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal `n` at the point `p`: pdf
    /// cosθ/Ω⊥ per steradian, 0 where nothing of the polygon is above the horizon. On an unoccluded diffuse surface every sample has the
    /// same value.
    ///
    /// It is a fan of N − 2 projected triangles about the first corner, which u₀ takes in turn. Each is clipped to the horizon
    /// by itself; nothing is sorted by azimuth, whose order is noise where azimuths are close. A polygon that contains the zenith
    /// is swept all around it from the first corner instead, as a triangle is, without edges inside.
    ///
    /// - Formula: Ω⊥ = ΣΩ⊥ᵢ; the first triangle i with Ω⊥₁ + … + Ω⊥ᵢ > u₀Ω⊥, at the rest of u₀Ω⊥ over Ω⊥ᵢ.
    /// - Domain: u in [0, 1)²; corners in order, either way round, coplanar to within their rounding.
    /// - Density: the pdf is cosθ/Ω⊥ per steradian inside (and within 8 ulp beyond) and above the horizon, 0 elsewhere.
    /// - Degenerate input: corners may coincide or be collinear; otherwise as for the triangle.
    /// - Greatest error: as for the triangle. Unless the polygon contains the zenith, the map jumps from one triangle to the next: a
    ///   `u₀` within the rounding of the areas before it may belong to either. As with
    ///   [`Polygon::by_solid_angle`](crate::Polygon::by_solid_angle), up to all of Ω⊥ may be wrong where the point is no farther from the plane
    ///   than the rounding of the corners, which then may not even be convex.
    /// - Source: as for [`Triangle::by_projected_solid_angle`](crate::Triangle::by_projected_solid_angle).
    ///
    /// `ROOM` is how many triangles it has memory for, at least N − 2: a prepared packet is kilobytes, and a parallelogram, the most frequent
    /// polygon, needs no more than two.
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> PolygonByProjectedSolidAngle<R, N> {
        let (surface, shape) = (PlacedPolygon::new(self.corners, p), ProjectedPolygon::default());
        let mut sampler = ByProjectedSolidAngle { normal: n, surface, shape };
        sampler.shape.prepare_corners(&PlacedCorners::new(self.corners, p), n);
        sampler
    }
    /// In proportion to the lobe of a rough surface at the point `p`: as [`Triangle::by_reflection`](crate::Triangle::by_reflection).
    #[inline(always)]
    pub fn by_reflection(&self, p: Vec3<R>, reflection: &Reflection<R>) -> PolygonByReflection<R, N> {
        let placed = |v: Vec3<R>| [reflection.to_cosine(v), Vec3::default()];
        let corners =
            PlacedCorners::with_edges(placed(self.corners[0] - p), self.corners.map(|c| placed(c - self.corners[0])));
        let (surface, shape) = (PlacedPolygon::new(self.corners, p), ProjectedPolygon::default());
        let mut sampler = ByReflection { reflection: *reflection, surface, shape };
        sampler.shape.prepare_corners(&corners, Vec3::lit([0.0, 0.0, 1.0]));
        sampler
    }
}

impl<R: Real<Scalar = R>, const N: usize> Polygon<R, N> {
    /// What it can contribute with this radiance. One that is not positive gives the power 0.
    #[must_use]
    pub fn bound(&self, radiance: R) -> LightBound {
        let first = wide(self.corners[0]);
        LightBound::flat(first, &self.corners.map(|corner| wide(corner) - first), radiance.lane_f64(0))
    }
}

/// A [`Polygon`] sampled by area from a point.
pub type PolygonByArea<R, const N: usize> = ByArea<PlacedPolygon<R, N>>;
/// A [`Polygon`] sampled by solid angle from a point.
pub type PolygonBySolidAngle<R, const N: usize> = BySolidAngle<PlacedPolygon<R, N>, SphericalPolygon<R, N>>;
/// A [`Polygon`] sampled by projected solid angle from a point on a surface.
pub type PolygonByProjectedSolidAngle<R, const N: usize> =
    ByProjectedSolidAngle<R, PlacedPolygon<R, N>, ProjectedPolygon<R, N>>;

/// A [`Polygon`] sampled by the lobe of a rough surface.
pub type PolygonByReflection<R, const N: usize> = ByReflection<R, PlacedPolygon<R, N>, ProjectedPolygon<R, N>>;
