//! Annuli.

use super::disk::PlacedDisk;
use super::sampler::ByArea;
use super::surface::{AreaSurface, Surface, SurfaceHit, SurfacePoint};
use crate::lanewise::lanewise;
use crate::math::{atan2_turns, quotient};
use crate::real::{Real, unit_interval};
use crate::vector::{Vec2, Vec3};

lanewise! {
    /// An annulus light, a disk without its middle, that emits from the side of its normal: ring lamps.
    ///
    /// It is sampled by area only. An inner radius ≤ 0 makes it a disk. A radius ≤ 0 or no greater than the inner one, and a point in the
    /// plane of the annulus, give pdf 0. Surface coordinates: (1 + q)/2 for the position q on the unit disk, as of a
    /// [`Disk`](super::Disk).
    ///
    /// ```
    /// use etendue::{Annulus, LightSampler, Vec2};
    /// let ring = Annulus::new([0.0, 2.0, 0.0].into(), [0.0, -1.0, 0.0].into(), 1.0_f32, 0.75).by_area([0.0; 3].into());
    /// let s = ring.sample(Vec2::new(0.3, 0.6));
    /// assert!(s.valid() && ring.hit(s.direction).valid() && ring.pdf([0.0, 1.0, 0.0].into()) == 0.0);
    /// ```
    pub struct Annulus {
        /// Centre, in the coordinates of the scene.
        pub center: Vec3<R>,
        /// Unit normal.
        pub normal: Vec3<R>,
        /// Radius, in the unit of the coordinates.
        pub radius: R,
        /// Radius of the hole, in the unit of the coordinates.
        pub inner_radius: R,
    }
}

impl<R: Real> Annulus<R> {
    /// The annulus with this centre, unit normal, radius and radius of its hole.
    #[inline(always)]
    pub fn new(center: Vec3<R>, normal: Vec3<R>, radius: R, inner_radius: R) -> Self {
        Self { center, normal, radius, inner_radius }
    }
    /// Uniform over the surface, seen from the point `p`.
    ///
    /// - Formula: x = c + Rρ(s cosφ + t sinφ), ρ² = k² + u₀(1 − k²), φ = 2πu₁, with k the ratio of the radii, s and t perpendicular to the
    ///   normal.
    /// - Domain: u in [0, 1)²; any unit normal, radius > 0.
    /// - pdf: distance²/(|cosθ'| πR²(1 − k²)) per steradian; the tests allow a relative error of (48 + 36/|cosθ'|)·2⁻²⁴ for
    ///   k = ½.
    /// - Degenerate: no width, a point in the plane: pdf 0.
    /// - Source: inversion of the distribution of ρ².
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> AnnulusByArea<R> {
        let ratio = quotient(self.inner_radius, self.radius).clamped(R::lit(0.0), R::lit(1.0));
        ByArea {
            origin: p,
            surface: PlacedAnnulus { disk: PlacedDisk::new(self.center - p, self.normal, self.radius), ratio },
        }
    }
}

/// An [`Annulus`] sampled by area from a point.
pub type AnnulusByArea<R> = ByArea<R, PlacedAnnulus<R>>;

lanewise! {
    /// An annulus relative to the shading point. Its surface coordinates are those of the disk.
    pub struct PlacedAnnulus {
        disk: PlacedDisk<R>,
        /// Inner radius over the radius, in [0, 1].
        ratio: R,
    }
}

impl<R: Real> PlacedAnnulus<R> {
    /// 1 − ratio², without cancellation.
    #[inline(always)]
    fn width(&self) -> R {
        let one = R::lit(1.0);
        (one - self.ratio) * (one + self.ratio)
    }
}

impl<R: Real> Surface<R> for PlacedAnnulus<R> {
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        self.disk.at(w)
    }
}

impl<R: Real> AreaSurface<R> for PlacedAnnulus<R> {
    const FLAT: bool = true;
    #[inline(always)]
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R> {
        let (sin, cos) = u.y.sin_cos_turns();
        let r = self.width().mul_add(u.x, self.ratio * self.ratio).sqrt();
        self.disk.point(Vec2::new(r * cos, r * sin), self.area())
    }
    #[inline(always)]
    fn inverse_pdf(&self, _: Vec2<R>) -> R {
        self.area()
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        let (hit, off, rim, slack) = self.disk.within(w);
        hit & off.ge(self.ratio * rim - slack)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let q = self.disk.position(w);
        let r = q.length();
        Vec2::new(unit_interval(quotient((r - self.ratio) * (r + self.ratio), self.width())), atan2_turns(q.y, q.x))
    }
    #[inline(always)]
    fn area(&self) -> R {
        self.disk.area() * self.width()
    }
}
