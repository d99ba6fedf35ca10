//! Bilinear patches.

use super::bound::{LightBound, power, wide};
use super::direction::to_unit;
use super::sampler::ByArea;
use super::surface::{AreaSurface, SURFACE_SLACK, Surface, SurfaceHit, SurfacePoint};
use crate::lanewise::lanewise;
use crate::math::{quotient, quotient_if_any};
use crate::real::Real;
use crate::vector::{Vec2, Vec3};
use crate::warp::{PatchSurface, Warp};
use core::f64::consts::PI;

lanewise! {
    /// A bilinear patch light corner + s·edge_s + t·edge_t + st(diagonal − edge_s − edge_t), s and t in [0, 1], that emits from the side of
    /// ∂s×∂t.
    ///
    /// It is sampled by area only. A patch without area gives pdf 0. Surface coordinates: (s, t).
    pub struct BilinearPatch {
        /// Corner, in the coordinates of the scene.
        pub corner: Vec3<R>,
        /// From there to the next corner, s = 1.
        pub edge_s: Vec3<R>,
        /// From there to the other next corner, t = 1.
        pub edge_t: Vec3<R>,
        /// From there to the opposite corner.
        pub diagonal: Vec3<R>,
    }
}

impl<R: Real> BilinearPatch<R> {
    /// The patch with this corner, and the others at these vectors from there: s = 1, t = 1, and s = t = 1.
    #[inline(always)]
    pub fn new(corner: Vec3<R>, edge_s: Vec3<R>, edge_t: Vec3<R>, diagonal: Vec3<R>) -> Self {
        Self { corner, edge_s, edge_t, diagonal }
    }
    /// Nearly uniform over the surface, seen from the point `p`: [`PatchSurface`]. The pdf is exact for that map: its pdf per unit area
    /// times distance²/|cosθ'|. The pdf of a direction is that of the nearest point in it.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> PatchByArea<R> {
        ByArea { surface: self.placed(p) }
    }
    #[inline(always)]
    fn placed(&self, p: Vec3<R>) -> PlacedPatch<R> {
        let Self { corner, edge_s, edge_t, diagonal } = *self;
        PlacedPatch::new(PatchSurface { corner: corner - p, edge_s, edge_t, diagonal })
    }
}

impl<R: Real<Scalar = R>> BilinearPatch<R> {
    /// What it can contribute with this radiance. It counts as a light that emits in all directions, as its normals differ.
    #[must_use]
    pub fn bound(&self, radiance: R) -> LightBound {
        let [s, t, diagonal] = [self.edge_s, self.edge_t, self.diagonal].map(wide);
        let area = self.map(|x| x.lane_f64(0)).by_area(wide(self.corner)).area();
        let middle = (s + t + diagonal) * 0.25;
        let bound = LightBound::around(wide(self.corner), &[Vec3::default(), s, t, diagonal], middle);
        LightBound { power: power(area * PI * radiance.lane_f64(0)), ..bound }
    }
}

/// A [`BilinearPatch`] sampled by area from a point.
pub type PatchByArea<R> = ByArea<PlacedPatch<R>>;

lanewise! {
    /// A bilinear patch relative to the shading point. Its surface coordinates are (s, t).
    pub struct PlacedPatch {
        surface: PatchSurface<R>,
        /// The same in units in which no coordinate exceeds 2, so that products neither over- nor underflow.
        small: PatchSurface<R>,
        /// 1 over that unit.
        scale: R,
    }
}

impl<R: Real> PlacedPatch<R> {
    #[inline(always)]
    fn new(surface: PatchSurface<R>) -> Self {
        let PatchSurface { corner, edge_s, edge_t, diagonal } = surface;
        let ([corner, edge_s, edge_t, diagonal], scale) = to_unit([corner, edge_s, edge_t, diagonal]);
        Self { surface, small: PatchSurface { corner, edge_s, edge_t, diagonal }, scale }
    }
    /// Unit normal and its length before that, |∂s×∂t|, in units.
    #[inline(always)]
    fn normal(&self, st: Vec2<R>) -> (Vec3<R>, R) {
        self.small.normal(st).unit_and_length()
    }
    /// (s, t) of the nearest point in the direction `ray` and its distance, in [0, 1]² where the ray hits; and whether it does.
    ///
    /// The line of constant s that meets the ray makes the plane through both contain the shading point: a quadratic equation in s
    /// (Pharr, Jakob and Humphreys, PBR 4th ed., 6.6.1). Or the same for t, if those lines are longer: the rounding of the equation is that
    /// of the longest, and the place on a short one would be lost in it.
    #[inline(always)]
    fn meet(&self, ray: Vec3<R>) -> (Vec2<R>, R, R::Mask) {
        let (zero, one, half) = (R::lit(0.0), R::lit(1.0), R::lit(0.5));
        let PatchSurface { corner: p, edge_s: u, edge_t: v, diagonal: w } = self.small;
        let twist = (w - u) - v;
        let shorter = |a: Vec3<R>, b: Vec3<R>| a.length_squared().lesser(b.length_squared());
        let across = shorter(v, w - u).lt(shorter(u, w - v));
        let (u, v) = (Vec3::blend(across, v, u), Vec3::blend(across, u, v));
        let (a, b, c) = (ray.dot(u.cross(twist)), ray.dot(p.cross(twist) + u.cross(v)), ray.dot(p.cross(v)));
        let root = (b * b - R::lit(4.0) * a * c).greater(zero).sqrt();
        let sum = b + root.copysign(b);
        let size = p.max_abs() + one;
        let candidate = |(s, root): (R, R::Mask)| {
            let (start, line) = (u.mul_add(s, p), twist.mul_add(s, v));
            let across = ray.cross(line);
            let (t, meets) = quotient_if_any(-ray.cross(start).dot(across), across.length_squared());
            let point = line.mul_add(t, start);
            let distance = ray.dot(point);
            let other = twist.mul_add(t.clamped(zero, one), u);
            let (seen_s, seen_t) = (ray.cross(other).length(), across.length());
            // by as much as a direction is rounded, over the lengths of both lines as they are seen and the sine of the angle between them
            let oblique = quotient(seen_s * seen_t, ray.dot(line.cross(other)).abs()).greater(one);
            let slack = |length: R| R::lit(SURFACE_SLACK) * (quotient(size, length) * oblique).lesser(R::lit(1e3));
            let beyond = |x: R| (x - x.clamped(zero, one)).abs();
            let inside = beyond(s).le(slack(seen_s)) & beyond(t).le(slack(seen_t));
            // the ray passes the point of the line that is nearest to it: so do neither a line that is only a point nor a root that is not
            // real; the plane through ray and line is known to one over the sine of their angle
            let aside = (ray.cross(point).length() * across.length()).le(R::lit(SURFACE_SLACK) * size * line.length());
            let found = root & meets & inside & aside & distance.gt(zero);
            (Vec2::new(s.clamped(zero, one), t.clamped(zero, one)), distance, found)
        };
        // where the coefficient of s² is 0 there is one root, and where that of s is 0 too there is none
        let first = candidate(quotient_if_any(R::lit(-2.0) * c, sum));
        let second = candidate(quotient_if_any(-half * sum, a));
        let take = second.2 & (!first.2 | second.1.lt(first.1));
        let st = Vec2::blend(take, second.0, first.0);
        let st = Vec2::blend(across, Vec2::new(st.y, st.x), st);
        (st, R::blend(take, second.1, first.1) / self.scale, first.2 | second.2)
    }
}

impl<R: Real> Surface<R> for PlacedPatch<R> {
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        let (uv, distance, hit) = self.meet(w);
        let distance = distance.keep(hit).clamped(R::lit(0.0), R::lit(f64::from(f32::MAX)));
        SurfaceHit { distance, normal: self.normal(uv).0, uv }
    }
}

impl<R: Real> AreaSurface<R> for PlacedPatch<R> {
    const FLAT: bool = false;
    #[inline(always)]
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R> {
        let uv = self.surface.parameters().sample(u);
        let position = self.surface.corner + self.surface.offset(uv);
        // too far away to be a number
        let finite = position.is_within(R::lit(f64::INFINITY));
        let (normal, inverse_pdf) = (self.normal(uv).0, self.inverse_pdf(uv));
        SurfacePoint { position: position.keep(finite), normal, uv, inverse_pdf }
    }
    #[inline(always)]
    fn inverse_pdf(&self, uv: Vec2<R>) -> R {
        // |∂s×∂t| over the density of (s, t) is what a flat light has for its area
        let pdf = self.surface.parameters().pdf(uv);
        let some = pdf.gt(R::lit(0.0));
        let area = self.normal(uv).1 / R::blend(some, pdf, R::lit(1.0)) / self.scale / self.scale;
        area.keep(some & area.lt(R::lit(1e37)))
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        self.meet(w).2
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.surface.parameters().invert(self.meet(w).0)
    }
    /// By the rule of Gauss with three by three points: exact for a flat patch.
    #[inline(always)]
    fn area(&self) -> R {
        let nodes = [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
        let mut sum = R::lit(0.0);
        for (s, a) in nodes {
            for (t, b) in nodes {
                sum += R::lit(a * b) * self.normal(Vec2::lit([s, t])).1;
            }
        }
        sum / self.scale / self.scale
    }
}
