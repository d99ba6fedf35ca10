use super::sampler::{ByArea, ByProjectedSolidAngle, BySolidAngle};
use super::surface::PlacedPolygon;
use crate::lanewise::lanewise_by_map;
use crate::real::Real;
use crate::spherical::{ProjectedPolygon, SphericalPolygon};
use crate::vector::Vec3;

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
#[derive(Clone, Copy, Debug)]
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

impl<R: Real, const N: usize> Polygon<R, N> {
    /// The polygon with these corners, which must be in order and in one plane.
    #[inline(always)]
    pub fn new(corners: [Vec3<R>; N]) -> Self {
        Self { corners }
    }
    /// Repeats one polygon in every lane.
    #[inline]
    pub fn splat(s: Polygon<R::Scalar, N>) -> Self {
        s.map(R::splat)
    }
    /// Uniform over the surface, seen from the point `p`: pdf distance²/(|cosθ'| A) per steradian, which follows from
    /// the rounded corners.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> PolygonByArea<R, N> {
        ByArea { origin: p, surface: PlacedPolygon::new(self.corners, p) }
    }
    /// Uniform over the solid angle Ω at the point `p`, [`SphericalPolygon`]: pdf 1/Ω per steradian.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> PolygonBySolidAngle<R, N> {
        let shape = SphericalPolygon::new(self.corners.map(|c| c - p));
        BySolidAngle { origin: p, surface: PlacedPolygon::new(self.corners, p), shape }
    }
    /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal `n` at the point `p`, [`ProjectedPolygon`]: pdf
    /// cosθ/Ω⊥ per steradian, 0 where nothing of the polygon is above the horizon. On an unoccluded diffuse surface every sample has the
    /// same value.
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> PolygonByProjectedSolidAngle<R, N> {
        let shape = ProjectedPolygon::new(self.corners.map(|c| c - p), n);
        ByProjectedSolidAngle { origin: p, normal: n, surface: PlacedPolygon::new(self.corners, p), shape }
    }
}

/// A [`Polygon`] sampled by area from a point.
pub type PolygonByArea<R, const N: usize> = ByArea<R, PlacedPolygon<R, N>>;
/// A [`Polygon`] sampled by solid angle from a point.
pub type PolygonBySolidAngle<R, const N: usize> = BySolidAngle<R, PlacedPolygon<R, N>, SphericalPolygon<R, N>>;
/// A [`Polygon`] sampled by projected solid angle from a point on a surface.
pub type PolygonByProjectedSolidAngle<R, const N: usize> =
    ByProjectedSolidAngle<R, PlacedPolygon<R, N>, ProjectedPolygon<R, N>>;
