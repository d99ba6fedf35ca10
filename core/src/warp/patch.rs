//! Bilinear patches.

use super::{Bilinear, Warp};
use crate::lanewise::lanewise;
use crate::math::quotient;
use crate::real::Real;
use crate::vector::{Vec2, Vec3};

/// Clamps each component to the range of f32, for a point that does not fit it.
#[inline(always)]
fn finite<R: Real>(point: Vec3<R>) -> Vec3<R> {
    let most = R::lit(f64::from(f32::MAX));
    let within = |x: R| x.clamped(-most, most);
    Vec3::new(within(point.x), within(point.y), within(point.z))
}

/// Rounding of coordinates, relative to the largest: 4 ulp.
const PATCH_SLACK: f64 = 4.0 / 16_777_216.0;

lanewise! {
    /// Points of a bilinear patch corner + s·edge_s + t·edge_t + st(diagonal − edge_s − edge_t), s and t in [0, 1], nearly uniform in area: for twisted quads.
    ///
    /// Set the four corners, then call `sample`, `pdf` or `invert`. A patch without area gives pdf 0.
    ///
    /// - Formula: (s, t) from the [`Bilinear`] distribution whose corner values are the patch's area per unit of s and t there,
    ///   |∂s×∂t|.
    /// - Domain: u in [0, 1)²; corners planar or not, of a patch that does not fold back on itself: along its
    ///   middle normal, it projects to a convex quadrilateral.
    /// - Density: the pdf per unit area is that of (s, t) over the exact |∂s×∂t| (not over its bilinear approximation); 0
    ///   beyond the edges. It is constant on a parallelogram. A point off the patch counts as one near it.
    ///   Per steradian, it is distance²/|cosθ'| times that, θ' to [`normal`](Self::normal).
    /// - Degenerate input: no area, or |∂s×∂t| outside 1e−37 … 1e37, gives pdf 0.
    /// - Greatest error: 6 steps of 2⁻²⁴ in (s, t) and half an ulp of the coordinates; the pdf 5e−7 relative, times the ratio
    ///   of the longest side to the shortest. `invert` solves a quadratic equation for s and takes two Gauss–Newton steps, with
    ///   the same error.
    /// - Source: Pharr, Jakob and Humphreys, PBR 4th ed., 6.6.
    pub struct PatchSurface {
        /// Corner s = t = 0, in any unit of length.
        pub corner: Vec3<R>,
        /// Vector from there to the corner s = 1, t = 0, in the unit of `corner`.
        pub edge_s: Vec3<R>,
        /// Vector from there to the corner s = 0, t = 1, in the unit of `corner`.
        pub edge_t: Vec3<R>,
        /// Vector from there to the opposite corner s = t = 1, in the unit of `corner`.
        pub diagonal: Vec3<R>,
    }
}
impl<R: Real> PatchSurface<R> {
    #[inline(always)]
    fn twist(&self) -> Vec3<R> {
        (self.diagonal - self.edge_s) - self.edge_t
    }
    /// The normal ∂s×∂t at (s, t), not normalised.
    #[inline(always)]
    pub fn normal(&self, st: Vec2<R>) -> Vec3<R> {
        let d = self.twist();
        d.mul_add(st.y, self.edge_s).cross(d.mul_add(st.x, self.edge_t))
    }
    /// The point at (s, t), relative to the corner.
    #[inline(always)]
    pub fn offset(&self, st: Vec2<R>) -> Vec3<R> {
        self.twist().mul_add(st.y, self.edge_s).mul_add(st.x, self.edge_t * st.y)
    }
    /// The distribution of (s, t).
    #[inline(always)]
    pub fn parameters(&self) -> Bilinear<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let unit = self.in_units().0;
        let at = |s: R, t: R| unit.normal(Vec2::new(s, t)).length();
        Bilinear { corners: [at(zero, zero), at(one, zero), at(zero, one), at(one, one)] }
    }
    /// The patch with edges near 1 and its corner at the origin; the reciprocal of its unit of length; and whether it is finite.
    #[inline(always)]
    fn in_units(&self) -> (Self, R, R::Mask) {
        let reach = self.edge_s.max_abs().greater(self.edge_t.max_abs()).greater(self.diagonal.max_abs());
        let (scale, finite) = (reach.pow2_scale(), reach.lt(R::lit(1e37)));
        let scaled = |e: Vec3<R>| Vec3::new(e.x.keep(finite), e.y.keep(finite), e.z.keep(finite)) * scale;
        let unit = Self {
            corner: Vec3::default(),
            edge_s: scaled(self.edge_s),
            edge_t: scaled(self.edge_t),
            diagonal: scaled(self.diagonal),
        };
        (unit, scale, finite)
    }
    /// The (s, t) of a point; may lie outside [0, 1]².
    #[inline(always)]
    pub fn locate(&self, point: Vec3<R>) -> Vec2<R> {
        let (zero, one, half, most) = (R::lit(0.0), R::lit(1.0), R::lit(0.5), R::lit(4.0));
        let (unit, scale, _) = self.in_units();
        let far = R::lit(64.0);
        let q = (point - self.corner) * scale;
        let q = Vec3::new(q.x.clamped(-far, far), q.y.clamped(-far, far), q.z.clamped(-far, far));
        let d = unit.twist();
        // (q − su)×(v + sd) = 0, projected along the middle normal
        let n = unit.normal(Vec2::new(half, half));
        let (a, b, c) = (
            -n.dot(unit.edge_s.cross(d)),
            n.dot(q.cross(d) - unit.edge_s.cross(unit.edge_t)),
            n.dot(q.cross(unit.edge_t)),
        );
        let root = (b * b - R::lit(4.0) * a * c).greater(zero).sqrt();
        let sum = b + root.copysign(b);
        let quotient = |x: R, y: R| {
            let some = y.abs().gt(R::lit(1e-30));
            (x / R::blend(some, y, one)).keep(some).clamped(-most, most)
        };
        let (first, second) = (quotient(R::lit(-2.0) * c, sum), quotient(-half * sum, a));
        let nearer = (second - half).abs().lt((first - half).abs()) & a.abs().gt(R::lit(1e-6) * b.abs());
        let s = R::blend(nearer, second, first);
        let line = d.mul_add(s, unit.edge_t);
        let t = quotient((q - unit.edge_s * s).dot(line), line.length_squared());
        let mut st = Vec2::new(s, t);
        for _ in 0..2 {
            let (by_s, by_t) = (d.mul_add(st.y, unit.edge_s), d.mul_add(st.x, unit.edge_t));
            let (left, normal) = (q - unit.offset(st), by_s.cross(by_t));
            let square = normal.length_squared();
            let step = |x: Vec3<R>| quotient(x.dot(normal), square).clamped(-half, half);
            st = Vec2 { x: st.x + step(left.cross(by_t)), y: st.y + step(by_s.cross(left)) };
        }
        st
    }
    /// The pdf per unit area at (s, t).
    #[inline(always)]
    pub fn pdf_at(&self, st: Vec2<R>) -> R {
        let area = self.normal(st).length();
        (self.parameters().pdf(st) * quotient(R::lit(1.0), area)).keep(area.lt(R::lit(1e37)))
    }
}
impl<R: Real> Warp<R> for PatchSurface<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let (unit, scale, _) = self.in_units();
        finite(self.corner + unit.offset(self.parameters().sample(u)) * scale.pow2_scale())
    }
    /// The pdf per unit area of the patch.
    #[inline(always)]
    fn pdf(&self, point: Vec3<R>) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let st = self.locate(point);
        let (unit, scale, finite) = self.in_units();
        let d = unit.twist();
        // coordinates are rounded, so allow for that, relative to the sides
        let slack = R::lit(PATCH_SLACK) * (self.corner.max_abs() * scale + R::lit(2.0));
        let beyond = |x: R, side: Vec3<R>| (x - x.clamped(zero, one)).abs() * side.length();
        let inside =
            beyond(st.x, d.mul_add(st.y, unit.edge_s)).le(slack) & beyond(st.y, d.mul_add(st.x, unit.edge_t)).le(slack);
        self.pdf_at(Vec2 { x: st.x.clamped(zero, one), y: st.y.clamped(zero, one) }).keep(inside & finite)
    }
    #[inline(always)]
    fn invert(&self, point: Vec3<R>) -> Vec2<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let st = self.locate(point);
        self.parameters().invert(Vec2 { x: st.x.clamped(zero, one), y: st.y.clamped(zero, one) })
    }
}
