//! Disks.

use super::sampler::{ByArea, BySolidAngle};
use super::surface::{AreaSurface, SURFACE_SLACK, Surface, SurfaceHit, SurfacePoint};
use crate::lanewise::lanewise;
use crate::math::quotient;
use crate::real::Real;
use crate::spherical::{SphericalDisk, compensated_dot};
use crate::vector::{Frame, Vec2, Vec3};
use crate::warp::{ConcentricDisk, Warp};
use core::f64::consts::PI;

lanewise! {
    /// A disk light that emits from the side of its normal.
    ///
    /// Take [`by_solid_angle`](Self::by_solid_angle) unless the disk is small for its distance, where [`by_area`](Self::by_area) is
    /// cheaper and as good. A radius ≤ 0, or a point in the plane of the disk, gives pdf 0. Surface coordinates: (1 + q)/2 for the
    /// position q on the unit disk, along the axes of the [`Frame`](crate::Frame) of the normal.
    pub struct Disk {
        /// Centre, in the coordinates of the scene.
        pub center: Vec3<R>,
        /// Unit normal.
        pub normal: Vec3<R>,
        /// Radius, in the unit of the coordinates.
        pub radius: R,
    }
}

impl<R: Real> Disk<R> {
    /// The disk with this centre, unit normal and radius.
    #[inline(always)]
    pub fn new(center: Vec3<R>, normal: Vec3<R>, radius: R) -> Self {
        Self { center, normal, radius }
    }
    #[inline(always)]
    fn placed(&self, p: Vec3<R>) -> PlacedDisk<R> {
        PlacedDisk::new(self.center - p, self.normal, self.radius)
    }
    /// Uniform over the surface, seen from the point `p`: [`ConcentricDisk`](crate::warp::ConcentricDisk).
    ///
    /// - Formula: x = c + R(q₀s + q₁t), q uniform on the unit disk, s and t perpendicular to the normal.
    /// - Domain: u in [0, 1)²; any unit normal, radius > 0.
    /// - pdf: distance²/(|cosθ'| πR²) per steradian; the tests allow a relative error of (48 + 36/|cosθ'|)·2⁻²⁴.
    /// - Degenerate: a radius of 0, a point in the plane: pdf 0.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> DiskByArea<R> {
        ByArea { surface: self.placed(p) }
    }
    /// Uniform over the solid angle Ω at the point `p`, [`SphericalDisk`]: pdf 1/Ω per steradian.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> DiskBySolidAngle<R> {
        let shape = SphericalDisk::new(self.center - p, self.normal, self.radius);
        BySolidAngle { surface: self.placed(p), shape }
    }
}

/// A [`Disk`] sampled by area from a point.
pub type DiskByArea<R> = ByArea<PlacedDisk<R>>;
/// A [`Disk`] sampled by solid angle from a point.
pub type DiskBySolidAngle<R> = BySolidAngle<PlacedDisk<R>, SphericalDisk<R>>;

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
    pub(super) fn new(center: Vec3<R>, normal: Vec3<R>, radius: R) -> Self {
        let finite = center.max_abs().lt(R::lit(f64::INFINITY));
        let (center, radius) = (center.keep(finite), radius.keep(finite));
        Self { center, frame: Frame::new(normal), radius, height: compensated_dot(center, normal) }
    }
    /// Position on the unit disk in the direction `w`; beyond it too, but finite.
    #[inline(always)]
    pub(super) fn position(&self, w: Vec3<R>) -> Vec2<R> {
        let distance = quotient(self.height, w.dot(self.frame.n));
        let offset = w.mul_add(distance, -self.center);
        let most = R::lit(1e15);
        let part = |x: R| quotient(x, self.radius).clamped(-most, most);
        Vec2::new(part(offset.dot(self.frame.s)), part(offset.dot(self.frame.t)))
    }
    /// The point at the position q on the unit disk.
    #[inline(always)]
    pub(super) fn point(&self, q: Vec2<R>, inverse_pdf: R) -> SurfacePoint<R> {
        let offset = self.frame.s * (q.x * self.radius) + self.frame.t * (q.y * self.radius);
        SurfacePoint { position: self.center + offset, normal: self.frame.n, uv: Self::to_uv(q), inverse_pdf }
    }
    /// Where the unit direction `w` hits the disk; by how much it misses the centre within the plane, times the cosine, so that nothing is
    /// divided by it; the radius times the cosine; and the rounding of both.
    #[inline(always)]
    pub(super) fn within(&self, w: Vec3<R>) -> (R::Mask, R, R, R) {
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
