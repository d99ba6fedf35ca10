use super::{LightSample, finite_by_area};
use crate::real::{Mask, Real, unit_interval};
use crate::spherical::{DirectionSample, ProjectedPolygon, SphericalPolygon};
use crate::vector::{Vec2, Vec3};
use crate::warp::{AreaTriangle, Warp};

/// A convex polygon of N corners, 3 ≤ N ≤ 8, that emits on the side from which they run counterclockwise.
///
/// ```
/// use etendue::{Vec2, light::Polygon};
/// // a panel overhead that emits downwards
/// let corners = [[-1.0, 2.0, -1.0], [1.0, 2.0, -1.0], [1.0, 2.0, 1.0], [-1.0, 2.0, 1.0]];
/// let panel = Polygon { corners: corners.map(Into::into) };
/// let s = panel.by_solid_angle([0.0, 0.0, 0.0_f32].into(), Vec2::new(0.3, 0.6));
/// assert!(s.emits && s.pdf > 0.0 && (s.direction.y * s.distance - 2.0).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Polygon<R, const N: usize> {
    /// In order, in one plane.
    pub corners: [Vec3<R>; N],
}

impl<R: Real, const N: usize> Polygon<R, N> {
    /// The same in every lane.
    #[inline]
    pub fn splat(s: Polygon<R::Scalar, N>) -> Self {
        Self { corners: s.corners.map(Vec3::splat) }
    }
    /// Uniform over the surface, by a fan of triangles about the first corner. pdf = distance²/(|cosθ'| A).
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let origin = self.corners[0];
        let edge = |i: usize| self.corners[i] - origin;
        let scale = (1..N).fold(zero, |most, i| most.greater(edge(i).max_abs())).pow2_scale();
        // twice the area of a triangle, in units that neither over- nor underflow
        let size = |i: usize| (edge(i) * scale).cross(edge(i + 1) * scale).length();
        let mut whole = Vec3::default();
        let mut total = zero;
        for i in 1..N - 1 {
            whole += edge(i).cross(edge(i + 1));
            total += size(i);
        }
        let place = u.x * total;
        let (mut before, mut sum) = (zero, zero);
        let (mut first, mut second, mut width) = (edge(1), edge(2), zero);
        for i in 1..N - 1 {
            let size = size(i);
            // the first that has an area, and each that begins before the place
            let here = size.gt(zero) & (place.ge(sum) | width.le(zero));
            first = Vec3::blend(here, edge(i), first);
            second = Vec3::blend(here, edge(i + 1), second);
            before = R::blend(here, sum, before);
            width = R::blend(here, size, width);
            sum += size;
        }
        let x = unit_interval((place - before) / R::blend(width.gt(zero), width, one));
        let b: Vec2<R> = AreaTriangle.sample(Vec2::new(x, u.y));
        let point = first.mul_add(b.x, second.mul_add(b.y, origin - p));
        finite_by_area(point, whole * R::lit(0.5))
    }
    /// Uniform over the solid angle, [`SphericalPolygon`].
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let seen = SphericalPolygon::new(self.corners.map(|c| c - p));
        let DirectionSample { direction, distance } = seen.sample_direction(u);
        LightSample {
            direction,
            distance,
            pdf: seen.uniform_pdf(),
            emits: seen.in_front(),
            delta: R::Mask::splat(false),
        }
    }
    /// Uniform over the projected solid angle on a surface with the unit normal `normal`, [`ProjectedPolygon`]: f·L·cosθ/pdf is then the
    /// same for every sample of a diffuse surface. pdf = cosθ/Ω⊥.
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, normal: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let seen = ProjectedPolygon::new(self.corners.map(|c| c - p), normal);
        let DirectionSample { direction, distance } = seen.sample_direction(u);
        let pdf = seen.pdf_at_cosine(direction.dot(normal));
        LightSample { direction, distance, pdf, emits: seen.in_front(), delta: R::Mask::splat(false) }
    }
}
