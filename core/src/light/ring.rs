//! Rings: disks with a hole.

use super::bound::LightBound;
use super::disk::Disk;
use super::disk::area::PlacedDisk;
use super::sampler::ByArea;
use super::surface::{AreaSurface, Surface, SurfaceHit, SurfacePoint};
use crate::lanewise::lanewise;
use crate::math::quotient;
use crate::real::Real;
use crate::vector::{Vec2, Vec3};
use crate::warp::{ConcentricDisk, Warp};

lanewise! {
    /// A flat ring that emits from the side of its normal: what a [`Disk`](crate::Disk) has outside of a smaller one with the same centre.
    ///
    /// A radius ≤ 0, an inner radius that is not below the outer one, or a point in the plane, gives pdf 0. Surface coordinates: those of
    /// the disk without its hole.
    pub struct Ring {
        /// Centre, in the coordinates of the scene.
        pub center: Vec3<R>,
        /// Unit normal.
        pub normal: Vec3<R>,
        /// Radius of the hole, in the unit of the coordinates.
        pub inner: R,
        /// Outer radius, in the same unit.
        pub radius: R,
    }
}
impl<R: Real> Ring<R> {
    /// The ring with this centre, unit normal, inner and outer radius.
    #[inline(always)]
    pub fn new(center: Vec3<R>, normal: Vec3<R>, inner: R, radius: R) -> Self {
        Self { center, normal, inner, radius }
    }
    /// Uniform over the surface, seen from the point `p`.
    ///
    /// - Formula: of the disk, with the position q scaled to |q'|² = h + (1 − h)|q|², h the square of the inner over the outer radius.
    /// - Domain: u in [0, 1)²; any unit normal, 0 ≤ inner radius < radius.
    /// - pdf: distance²/(|cosθ'| π(R² − r²)) per steradian.
    /// - Degenerate: no area, a point in the plane: pdf 0.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> RingByArea<R> {
        let part = quotient(self.inner.greater(R::lit(0.0)), self.radius);
        let disk = PlacedDisk::new(self.center - p, self.normal, self.radius.keep(self.inner.lt(self.radius)));
        ByArea { surface: PlacedRing { disk, hole: part * part } }
    }
}
impl Ring<f32> {
    /// What it can contribute with this radiance: that of the disk without the hole, with the part of its area.
    #[must_use]
    pub fn bound(&self, radiance: f32) -> LightBound {
        let part = (self.inner.greater(0.0) / self.radius.greater(f32::MIN_POSITIVE)).lesser(1.0);
        Disk::new(self.center, self.normal, self.radius).bound(radiance * (1.0 - part * part))
    }
}
/// A [`Ring`] sampled by area from a point.
pub type RingByArea<R> = ByArea<PlacedRing<R>>;

lanewise! {
    /// A ring relative to the shading point: the disk without its hole, and the part of its area that is the hole.
    pub struct PlacedRing {
        disk: PlacedDisk<R>,
        hole: R,
    }
}
impl<R: Real> Surface<R> for PlacedRing<R> {
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        self.disk.at(w)
    }
}
impl<R: Real> AreaSurface<R> for PlacedRing<R> {
    const FLAT: bool = true;
    #[inline(always)]
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R> {
        let q = ConcentricDisk.sample(u);
        let squared = q.dot(q);
        let wanted = (R::lit(1.0) - self.hole).mul_add(squared, self.hole);
        // the middle of the disk, which has no direction, is a point of the rim of the hole
        let middle = squared.le(R::lit(0.0));
        let scale = (wanted / R::blend(middle, R::lit(1.0), squared)).sqrt();
        let x = R::blend(middle, scale, q.x * scale);
        self.disk.point(Vec2::new(x, q.y * scale), self.area())
    }
    #[inline(always)]
    fn inverse_pdf(&self, _: Vec2<R>) -> R {
        self.area()
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        let (hit, off, rim, slack) = self.disk.within(w);
        hit & off.ge(rim.mul_add(self.hole.sqrt(), -slack))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let q = self.disk.position(w);
        let length = q.length();
        let squared =
            quotient(length.mul_add(length, -self.hole), R::lit(1.0) - self.hole).clamped(R::lit(0.0), R::lit(1.0));
        ConcentricDisk.invert(q * quotient(squared.sqrt(), length))
    }
    #[inline(always)]
    fn area(&self) -> R {
        self.disk.area() * (R::lit(1.0) - self.hole)
    }
}
