//! The sides of cylinders.

use super::sample::direction_to;
use super::sampler::ByArea;
use super::surface::{AreaSurface, SURFACE_SLACK, Surface, SurfaceHit, SurfacePoint};
use crate::lanewise::lanewise;
use crate::math::{atan2_turns, quotient};
use crate::real::{Real, unit_interval};
use crate::spherical::to_unit;
use crate::vector::{Frame, Vec2, Vec3};
use core::f64::consts::PI;

lanewise! {
    /// The side of a cylinder, without its ends, that emits outwards.
    ///
    /// It is sampled by area only, and more than half of it faces away: for thin tubes take a [`Line`](super::Line). A radius ≤ 0 or an
    /// axis of length 0 gives pdf 0. Surface coordinates: height along the axis, and azimuth in turns.
    pub struct Cylinder {
        /// Centre of one end, in the coordinates of the scene.
        pub start: Vec3<R>,
        /// From there to the centre of the other end.
        pub axis: Vec3<R>,
        /// Radius, in the unit of the coordinates.
        pub radius: R,
    }
}

impl<R: Real> Cylinder<R> {
    /// The cylinder from the end at `start` along `axis`.
    #[inline(always)]
    pub fn new(start: Vec3<R>, axis: Vec3<R>, radius: R) -> Self {
        Self { start, axis, radius }
    }
    /// Uniform over the surface, seen from the point `p`.
    ///
    /// - Formula: x = start + u₀·axis + R(s cosφ + t sinφ), φ = 2πu₁, s and t perpendicular to the axis.
    /// - Domain: u in [0, 1)²; any axis that is not 0, radius > 0.
    /// - pdf of a sample: distance²/(|cosθ'| 2πR·|axis|) per steradian, of the point that was drawn; of a direction: that of the nearest
    ///   point in it, which a rounded direction determines only as well as it
    ///   determines the point.
    /// - Degenerate: a radius or axis of 0: pdf 0.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> CylinderByArea<R> {
        ByArea { origin: p, surface: PlacedCylinder::new(self.start - p, self.axis, self.radius) }
    }
}

/// A [`Cylinder`] sampled by area from a point.
pub type CylinderByArea<R> = ByArea<R, PlacedCylinder<R>>;

lanewise! {
    /// The side of a cylinder relative to the shading point. Its surface coordinates are the height along the axis and the azimuth in
    /// turns.
    pub struct PlacedCylinder {
        end: Vec3<R>,
        axis: Vec3<R>,
        radius: R,
        /// Its z axis is that of the cylinder.
        frame: Frame<R>,
        length: R,
    }
}

/// Where a ray meets the infinite cylinder, within the ends or not.
struct Crossing<R: Real> {
    distance: R,
    height: R,
    /// Position across the axis, in units of the greatest length.
    across: Vec2<R>,
    /// Ahead of the ray, and between the ends to within the rounding of the direction.
    valid: R::Mask,
}

impl<R: Real> PlacedCylinder<R> {
    #[inline(always)]
    pub(super) fn new(end: Vec3<R>, axis: Vec3<R>, radius: R) -> Self {
        let along = direction_to(axis);
        Self { end, axis, radius, frame: Frame::new(along.direction), length: along.distance }
    }
    #[inline(always)]
    fn normal(&self, turns: R) -> Vec3<R> {
        let (sin, cos) = turns.sin_cos_turns();
        self.frame.s * cos + self.frame.t * sin
    }
    /// The nearest crossing of a ray with the side, the shading point across the axis, and whether there is one.
    #[inline(always)]
    fn meet(&self, w: Vec3<R>) -> (Crossing<R>, R::Mask) {
        let zero = R::lit(0.0);
        // in units of the greatest length, so that squares neither over- nor underflow
        let sizes = Vec3::new(self.radius, self.length, zero);
        let ([end, Vec3 { x: radius, y: length, .. }], scale) = to_unit([self.end, sizes]);
        let (w, o) = (self.frame.to_local(w), self.frame.to_local(-end));
        let a = w.x.mul_add(w.x, w.y * w.y);
        let b = w.x.mul_add(o.x, w.y * o.y);
        let c = Vec3::new(o.x, o.y, zero).length_squared_minus_square(radius);
        // how far the ray passes from the axis, times √a
        let across = w.x.mul_add(o.y, -(w.y * o.x));
        let root = (radius * radius * a - across * across).greater(zero).sqrt();
        // (−b ∓ root)/a, each without cancellation
        let sum = root + b.abs();
        let (large, small) = (quotient(sum, a), quotient(c, sum));
        let negative = b.lt(zero);
        let near = R::blend(negative, small, -large);
        let far = R::blend(negative, large, -small);
        let size = o.max_abs() + radius + length;
        let slack = size * R::lit(SURFACE_SLACK);
        let crossing = |t: R| {
            let height = w.z.mul_add(t, o.z);
            let valid = t.gt(zero) & height.ge(-slack) & height.le(length + slack);
            Crossing { distance: t, height, across: Vec2::lit([0.0; 2]), valid }
        };
        let (near, far) = (crossing(near), crossing(far));
        // a ray along the axis meets nothing
        let touches = across.abs().le((radius + slack) * a.sqrt()) & radius.gt(zero) & length.gt(zero) & a.gt(zero);
        let hit = (near.valid | far.valid) & touches;
        let t = R::blend(near.valid, near.distance, far.distance);
        let first = Crossing {
            distance: t / scale,
            height: R::blend(near.valid, near.height, far.height) / scale,
            across: Vec2::new(w.x.mul_add(t, o.x), w.y.mul_add(t, o.y)),
            valid: hit,
        };
        (first, hit)
    }
}

impl<R: Real> Surface<R> for PlacedCylinder<R> {
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        let zero = R::lit(0.0);
        let (Crossing { distance, height, across, .. }, hit) = self.meet(w);
        let most = R::lit(f64::from(f32::MAX));
        let distance = distance.keep(hit).clamped(zero, most);
        let turns = atan2_turns(across.y, across.x);
        let across = Vec3::new(across.x, across.y, zero);
        let normal = self.frame.to_world((across * across.max_abs().pow2_scale()).normalize());
        SurfaceHit { distance, normal, uv: Vec2::new(unit_interval(quotient(height, self.length)), turns) }
    }
}

impl<R: Real> AreaSurface<R> for PlacedCylinder<R> {
    const FLAT: bool = false;
    #[inline(always)]
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R> {
        let normal = self.normal(u.y);
        let position = self.axis.mul_add(u.x, self.end) + normal * self.radius;
        SurfacePoint { position, normal, uv: u, inverse_pdf: self.area() }
    }
    #[inline(always)]
    fn inverse_pdf(&self, _: Vec2<R>) -> R {
        self.area()
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        self.meet(w).1
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.at(w).uv
    }
    #[inline(always)]
    fn area(&self) -> R {
        self.radius * self.length * R::lit(2.0 * PI)
    }
}
