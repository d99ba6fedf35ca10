//! Spheres by solid angle.

use crate::lanewise::lanewise;
use crate::light::direction::DirectionSample;
use crate::light::seen::SphericalShape;
use crate::math::rsqrt;
use crate::real::Real;
use crate::vector::{Frame, Vec2, Vec3};
use crate::warp::{Cone, Warp};

lanewise! {
    /// Directions from a point to a sphere, uniform in solid angle: a [`Cone`] about the direction to its centre.
    ///
    /// [`Sphere::by_solid_angle`](crate::Sphere::by_solid_angle) says how.
    pub struct SphericalCap {
        frame: Frame<R>,
        cone: Cone<R>,
        /// d and d²−R² in units of `unit`, the power of two by which the lengths were divided
        distance: R,
        power: R,
        unit: R,
    }
}

impl<R: Real> SphericalCap<R> {
    /// Prepares for a sphere with its centre at `center` relative to the point; both lengths in one unit.
    #[inline]
    pub fn new(center: Vec3<R>, radius: R) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let scale = center.max_abs().greater(radius.abs()).pow2_scale();
        let (c, r) = (center * scale, radius * scale);
        let (squared, square) = (c.length_squared(), r * r);
        // a small difference near the sphere, where it needs twice the working precision; and what is no vector, as where a difference has
        // overflowed: of that nothing is visible
        let unusual = !(squared.gt(square + square) & squared.lt(R::lit(16.0)));
        let plain = [squared - square, c.x, c.y, c.z];
        let [power, x, y, z] = R::where_any(unusual, plain, || {
            // scaled by itself: the centre may be arbitrarily near a point inside a large sphere
            let axis = center * center.max_abs().pow2_scale();
            let somewhere = axis.length_squared().gt(zero) & axis.is_within(R::lit(4.0));
            let axis = axis.keep(somewhere);
            [c.length_squared_minus_square(r), axis.x, axis.y, R::blend(somewhere, axis.z, one)]
        });
        let inverse = one / squared;
        let sin_squared = (square * inverse).lesser(one);
        let cos = (power.greater(zero) * inverse).sqrt();
        let h = R::blend(power.ge(zero), sin_squared / (one + cos), R::lit(2.0));
        let distance = squared.sqrt();
        let axis = Vec3::new(x, y, z);
        Self {
            frame: Frame::new(axis * rsqrt(axis.length_squared())),
            // nothing where the centre is no number
            cone: Cone { one_minus_cos: h.keep(r.gt(zero) & power.lt(R::lit(16.0))) },
            distance,
            power,
            unit: one / scale,
        }
    }

    /// The circle in which the sphere is seen, on the unit sphere around the point: the frame of its axis, its distance from the point, and
    /// its radius. From inside, and without a sphere, it has no radius.
    #[inline(always)]
    pub(in crate::light) fn rim(&self) -> (Frame<R>, R, R) {
        let height = self.cone.one_minus_cos;
        let radius = (height * (R::lit(2.0) - height)).greater(R::lit(0.0)).sqrt();
        (self.frame, R::lit(1.0) - height, radius)
    }
    /// The same circle by its centre and two radii at a right angle.
    #[inline(always)]
    pub(in crate::light) fn circle(&self) -> [Vec3<R>; 3] {
        let (Frame { s, t, n }, height, radius) = self.rim();
        [n * height, s * radius, t * radius]
    }

    /// True where the point lies strictly inside the sphere and so sees its inner side.
    #[inline]
    pub fn inside(&self) -> R::Mask {
        self.power.lt(R::lit(0.0))
    }
}

impl<R: Real> SphericalShape<R> for SphericalCap<R> {
    #[inline]
    // without cancellation at grazing or near contact: with k = 1−cosθ, from outside, R²−d²sin²θ = d²(h−k)(2−h−k), and the near root is
    // (d²−R²)/(d cosθ + √·)
    fn sample_point(&self, u: Vec2<R>) -> (DirectionSample<R>, Option<Vec2<R>>) {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        let h = self.cone.one_minus_cos;
        let k = u.x * h;
        let along = self.distance * (one - k);
        let across = (h * (one - u.x)) * (two - h * (one + u.x));
        let outside = self.power.ge(zero);
        let square = R::blend(outside, self.distance * self.distance * across, along.mul_add(along, -self.power));
        let sum = square.greater(zero).sqrt() + along.abs();
        let quotient = self.power.abs() / R::blend(sum.gt(zero), sum, one);
        let far = !outside & along.ge(zero);
        let distance = (R::blend(far, sum, quotient) * self.unit).lesser(R::lit(f64::from(f32::MAX)));
        (DirectionSample { direction: self.sample(u), distance }, None)
    }
    #[inline]
    fn solid_angle(&self) -> R {
        self.cone.solid_angle()
    }
    #[inline]
    fn uniform_pdf(&self) -> R {
        self.cone.uniform_pdf()
    }
    #[inline(always)]
    fn in_front(&self) -> R::Mask {
        !self.inside()
    }
}

impl<R: Real> Warp<R> for SphericalCap<R> {
    type Point = Vec3<R>;
    #[inline]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        self.frame.to_world(self.cone.sample(u))
    }
    /// The pdf per steradian; 0 for a direction that misses the sphere.
    #[inline]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.cone.pdf_in_frame(&self.frame, w)
    }
    #[inline]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.cone.invert(self.frame.to_local(w))
    }
}
