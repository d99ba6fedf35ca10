//! Disks by area.

use crate::lanewise::lanewise;
use crate::light::surface::{AreaSurface, SURFACE_SLACK, Surface, SurfaceHit, SurfacePoint};
use crate::math::quotient;
use crate::real::Real;
use crate::vector::double_word::compensated_dot;
use crate::vector::{Frame, Vec2, Vec3};
use crate::warp::{ConcentricDisk, Warp};
use core::f64::consts::PI;

lanewise! {
    /// A disk relative to the shading point. Its surface coordinates are (1 + q)/2 for the position q on the unit disk, along the axes of
    /// the [`Frame`] of its normal.
    pub struct PlacedDisk {
        center: Vec3<R>,
        frame: Frame<R>,
        radius: R,
        height: R,
    }
}
impl<R: Real> PlacedDisk<R> {
    #[inline(always)]
    pub(in crate::light) fn new(center: Vec3<R>, normal: Vec3<R>, radius: R) -> Self {
        let finite = center.max_abs().lt(R::lit(f64::INFINITY));
        let (center, radius) = (center.keep(finite), radius.keep(finite));
        Self { center, frame: Frame::new(normal), radius, height: compensated_dot(center, normal) }
    }
    /// Position on the unit disk in the direction `w`; beyond it too, but finite.
    #[inline(always)]
    pub(in crate::light) fn position(&self, w: Vec3<R>) -> Vec2<R> {
        let distance = quotient(self.height, w.dot(self.frame.n));
        let offset = w.mul_add(distance, -self.center);
        let most = R::lit(1e15);
        let part = |x: R| quotient(x, self.radius).clamped(-most, most);
        Vec2::new(part(offset.dot(self.frame.s)), part(offset.dot(self.frame.t)))
    }
    /// The point at the position q on the unit disk.
    #[inline(always)]
    pub(in crate::light) fn point(&self, q: Vec2<R>, inverse_pdf: R) -> SurfacePoint<R> {
        let offset = self.frame.s * (q.x * self.radius) + self.frame.t * (q.y * self.radius);
        SurfacePoint { position: self.center + offset, normal: self.frame.n, uv: Self::to_uv(q), inverse_pdf }
    }
    /// Where the unit direction `w` hits the disk; by how much it misses the centre within the plane, times the cosine, so that nothing is
    /// divided by it; the radius times the cosine; and the rounding of both.
    #[inline(always)]
    pub(in crate::light) fn within(&self, w: Vec3<R>) -> (R::Mask, R, R, R) {
        let zero = R::lit(0.0);
        let scale = self.center.max_abs().greater(self.radius.abs()).pow2_scale();
        let (center, height, radius) = (self.center * scale, self.height * scale, self.radius * scale);
        let cos = w.dot(self.frame.n);
        let off = (w * height - center * cos).length();
        let slack = (center.length() + radius) * R::lit(SURFACE_SLACK);
        let hit = off.le(radius.mul_add(cos.abs(), slack)) & (cos * height).gt(zero) & radius.gt(zero);
        (hit, off, radius * cos.abs(), slack)
    }
    #[inline(always)]
    fn to_uv(q: Vec2<R>) -> Vec2<R> {
        let half = |x: R| x.mul_add(R::lit(0.5), R::lit(0.5)).clamped(R::lit(0.0), R::lit(1.0));
        Vec2::new(half(q.x), half(q.y))
    }
}
impl<R: Real> Surface<R> for PlacedDisk<R> {
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        let distance = quotient(self.height, w.dot(self.frame.n)).greater(R::lit(0.0));
        SurfaceHit { distance, normal: self.frame.n, uv: Self::to_uv(self.position(w)) }
    }
}
impl<R: Real> AreaSurface<R> for PlacedDisk<R> {
    const FLAT: bool = true;
    #[inline(always)]
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R> {
        self.point(ConcentricDisk.sample(u), self.area())
    }
    #[inline(always)]
    fn inverse_pdf(&self, _: Vec2<R>) -> R {
        self.area()
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        self.within(w).0
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let q = self.position(w);
        ConcentricDisk.invert(q * (R::lit(1.0) / q.length().greater(R::lit(1.0))))
    }
    #[inline(always)]
    fn area(&self) -> R {
        self.radius * self.radius * R::lit(PI)
    }
}
