//! Rectangles by solid angle.

mod prepare;

use crate::lanewise::lanewise;
use crate::light::direction::DirectionSample;
use crate::light::seen::SphericalShape;
use crate::math::{ratio, rsqrt};
use crate::real::{Real, unit_interval};
use crate::vector::{Vec2, Vec3};
use crate::warp::Warp;
use core::f64::consts::{PI, TAU};

/// Angle by which the rounding of its direction may move a sample out of the rectangle: 8 ulp of a component near 1.
const RECTANGLE_SLACK: f64 = 8.0 / 16_777_216.0;
const INV_FOUR_PI: f64 = 0.25 / PI;

lanewise! {
    /// Directions from a point to a rectangle, uniform in solid angle: take it where strata shall follow the edges, and the
    /// cheaper [`Parallelogram::by_solid_angle`](crate::Parallelogram::by_solid_angle) elsewhere.
    ///
    /// [`Rectangle::by_solid_angle`](crate::Rectangle::by_solid_angle) says how.
    pub struct SphericalRectangle {
        /// the point X = Y = 0: the foot, or on the far edge where `anchor` is 1; P = base + X·side_x + Y·side_y
        base: Vec3<R>,
        /// unit vector of x, towards the far end x₁
        side_x: Vec3<R>,
        /// unit vector of y, towards the far end y₁
        side_y: Vec3<R>,
        /// unit normal of the plane through the viewpoint and the side at x₀, pointing inwards
        near_x: Vec3<R>,
        /// the same at x₁
        far_x: Vec3<R>,
        /// the same at y₀
        near_y: Vec3<R>,
        /// the same at y₁
        far_y: Vec3<R>,
        /// tolerances of the planes at x₀ and y₀: w is inside if w·plane ≥ −slack
        slack: Vec2<R>,
        /// the same at x₁ and y₁
        slack_far: Vec2<R>,
        /// unit normal of the rectangle's plane, away from the viewpoint
        normal: Vec3<R>,
        /// (x₀, y₀), with |x₀| ≤ x₁ and |y₀| ≤ y₁
        near: Vec2<R>,
        /// (x₁, y₁)
        far: Vec2<R>,
        /// (x₁−x₀, y₁−y₀)
        size: Vec2<R>,
        /// z, the distance to the plane
        height: R,
        /// 1 where X or Y is measured from the far edge, 0 where from the foot
        anchor: Vec2<R>,
        /// 1 where `side_x` or `side_y` points against the edge
        flip: Vec2<R>,
        /// the strip from the foot to x₁
        strip: Strip<R>,
        /// 1/sinw₁
        inv_sin_w1: R,
        /// the strip from the foot to x₀ if x₀ < 0, else 0
        near_strip: Strip<R>,
        /// where more than this share of the area lies towards x₁, the map counts from x₀: ½ if x₀ < 0, else 2 (never)
        half: R,
        /// Ω in steradians
        solid_angle: R,
        /// −1 where the point is on the side to which u×v points, else 1
        side: R,
        /// unit of the lengths above, a power of two
        unit: R,
    }
}

lanewise! {
    /// The strip [0, x]×[y₀, y₁], whose solid angle is w.
    struct Strip {
        /// sinw
        sin: R,
        /// cosw
        cos: R,
        /// A = cosw − p
        above_p: R,
        /// B = cosw + s
        above_s: R,
    }
}

/// Height over the plane in units of the far end, and share of the area, below which a change of the strips counts as steep.
const STEEP: f64 = 1.0 / 16.0;

/// Distances of the corners of a window, the first index that of x.
type Corners<R> = [[R; 2]; 2];

/// Those of [near.x, far.x]×[near.y, far.y] at the height z.
#[inline(always)]
fn corners<R: Real>(near: Vec2<R>, far: Vec2<R>, z: R) -> Corners<R> {
    let zz = z * z;
    let row = |x: R| {
        let d = x.mul_add(x, zz);
        [near.y.mul_add(near.y, d).sqrt(), far.y.mul_add(far.y, d).sqrt()]
    };
    [row(near.x), row(far.x)]
}

/// Solid angle of [near.x, far.x]×[near.y, far.y] at the height z, with |near| ≤ far and `size` = far − near.
///
/// A window in one quadrant is two triangles: tan(Ω/2) = zΔxΔy/(…), where all terms are positive. Elsewhere it is the two
/// strips on either side of the foot: tan w = az(b₁r₀−b₀r₁)/(a²b₀b₁ + z²r₀r₁). Both angles are less than π; that of the product of
/// both vectors, as complex numbers, is their sum.
#[inline(always)]
fn window<R: Real>([[r00, r01], [r10, r11]]: Corners<R>, near: Vec2<R>, far: Vec2<R>, size: Vec2<R>, z: R) -> R {
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    let (across_x, across_y) = (near.x.lt(zero), near.y.lt(zero));
    let straddles = across_x | across_y;
    // the strips run along the axis that crosses the foot
    let swap = across_y & !across_x;
    let (a0, b0) = (R::blend(swap, near.y, near.x), R::blend(swap, near.x, near.y));
    let (a1, b1) = (R::blend(swap, far.y, far.x), R::blend(swap, far.x, far.y));
    let db = R::blend(swap, size.x, size.y);
    let (r01, r10) = (R::blend(swap, r10, r01), R::blend(swap, r01, r10));
    let zz = z * z;
    let (aa0, aa1) = (a0 * a0, a1 * a1);
    let (d0, d1) = (aa0 + zz, aa1 + zz);
    let bb = b0 * b1;
    let one_sided = b0.ge(zero);
    let both = db * (b1 + b0);
    let strip = |a: R, aa: R, d: R, r0: R, r1: R| {
        // b₁r₀ − b₀r₁
        let sum = b1.mul_add(r0, b0.abs() * r1);
        let cross = R::blend(one_sided, ratio(both * d, sum), sum);
        (a.abs() * z * cross, aa.mul_add(bb, zz * (r0 * r1)))
    };
    let (s1, c1) = strip(a1, aa1, d1, r10, r11);
    let (s0, c0) = strip(a0, aa0, d0, r00, r01);
    let volume = z * size.x * size.y;
    let aa = a0 * a1;
    // inner products of corners
    let (b0b0, b1b1) = (b0.mul_add(b0, zz), b1.mul_add(b1, zz));
    let diagonal = aa + bb + zz;
    let t1 = (r00 * r10).mul_add(r11, (aa + b0b0).mul_add(r11, diagonal.mul_add(r10, (d1 + bb) * r00)));
    let t0 = (r00 * r01).mul_add(r11, (aa + b1b1).mul_add(r00, diagonal.mul_add(r01, (d0 + bb) * r11)));
    let (s1, c1) = (R::blend(straddles, s1, volume), R::blend(straddles, c1, t1));
    let (s0, c0) = (R::blend(straddles, s0, volume), R::blend(straddles, c0, t0));
    let angle = s1.mul_add(c0, c1 * s0).atan2(c1.mul_add(c0, -(s1 * s0)));
    let angle = R::blend(angle.lt(zero), angle + R::lit(TAU), angle);
    angle * R::blend(straddles, one, R::lit(2.0))
}

impl<R: Real> SphericalRectangle<R> {
    /// X and x² + z² for u₀.
    #[inline(always)]
    fn strip_end(&self, u: R) -> (R, R) {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let Self { far: Vec2 { x: x1, .. }, near: Vec2 { x: x0, .. }, height: z, .. } = *self;
        // u or 1 − u
        let (left, swept) = (((one - self.flip.x) - u).abs(), (self.flip.x - u).abs());
        // from k = cosw − cosw₁, counted from the nearer end on either side of the foot
        let near = left.gt(self.half);
        let part = R::blend(near, swept, left);
        let strip = Strip::blend(near, self.near_strip, self.strip);
        let (sin_e, cos_e) = (part * (self.solid_angle * R::lit(INV_FOUR_PI))).sin_cos_turns();
        let sin_d = strip.sin.mul_add(cos_e, -(strip.cos * sin_e)).greater(-one.keep(near));
        let cos_d = strip.cos.mul_add(cos_e, strip.sin * sin_e);
        let sin_w = sin_d.mul_add(cos_e, -(cos_d * sin_e));
        let k = (sin_d + sin_d) * sin_e;
        let (above_p, above_s) = (k + strip.above_p, k + strip.above_s);
        let root = (above_p * above_s).greater(zero).sqrt();
        // where cosw₁ < 0, the difference still leaves at least half of the first term
        let Strip { sin: sin_w1, cos: cos_w1, above_p: far_p, above_s: far_s } = self.strip;
        let square = sin_w1 * sin_w1;
        let q = square.mul_add(far_p + far_s + k, (cos_w1 + cos_w1 + k) * (far_p * far_s));
        let from_far = (sin_d + sin_d) * self.inv_sin_w1 * (sin_e * self.inv_sin_w1) * q * x1 * x1;
        let foot = (z * sin_w).negate_where(near);
        let anchored = self.anchor.x.gt(zero);
        let numerator = R::blend(anchored, -from_far, foot);
        let denominator = root * R::blend(anchored, x1.mul_add(root, foot), one);
        // of 0/0, too
        let x = (numerator / denominator).clamped(R::blend(anchored, -self.size.x, x0), R::blend(anchored, zero, x1));
        let from_foot = x + x1.keep(anchored);
        (x, from_foot.mul_add(from_foot, z * z))
    }

    /// X and Y of the point for `u`.
    #[inline(always)]
    fn place(&self, u: Vec2<R>) -> Vec2<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let Self { far: Vec2 { y: y1, .. }, near: Vec2 { y: y0, .. }, .. } = *self;
        let (x, d) = self.strip_end(u.x);
        let (v, rest) = (((one - self.flip.y) - u.y).abs(), (self.flip.y - u.y).abs());
        // y: from h₁ − h
        let (r0, r1) = (y0.mul_add(y0, d).sqrt(), y1.mul_add(y1, d).sqrt());
        let sum = y1.mul_add(r0, y0.abs() * r1);
        let product = r0 * r1 * sum;
        let inverse = one / product;
        let inverse_r = inverse * sum;
        let inverse_r1 = r0 * inverse_r;
        let h1 = y1 * inverse_r1;
        let range = R::blend(y0.ge(zero), self.size.y * (y1 + y0) * d * inverse, sum * inverse_r);
        // before the foot, count from the near edge, so that both ends keep 1−h²
        let (h0, down, up) = (y0 * r1 * inverse_r, v * range, rest * range);
        let before = h0 + up;
        let below = before.lt(zero);
        let h = R::blend(below, before, h1 - down);
        let rise = R::blend(below, -up, down) * (h + R::blend(below, h0, h1));
        let inverse_end = inverse_r * R::blend(below, r1, r0);
        // √(x²+z²)·√(1−h²)
        let root = (d * (d * inverse_end).mul_add(inverse_end, rise)).greater(zero).sqrt();
        let anchored = self.anchor.y.gt(zero);
        let numerator = d * R::blend(anchored, -(r1 * rise), h);
        let denominator = root * R::blend(anchored, h1.mul_add(root, h * d * inverse_r1), one);
        let y = (numerator / denominator).clamped(R::blend(anchored, -self.size.y, y0), R::blend(anchored, zero, y1));
        Vec2::new(x, y)
    }
    /// The point of the rectangle at X and Y.
    #[inline(always)]
    fn point(&self, Vec2 { x, y }: Vec2<R>) -> Vec3<R> {
        self.side_x.mul_add(x, self.side_y.mul_add(y, self.base))
    }
}

impl<R: Real> SphericalShape<R> for SphericalRectangle<R> {
    #[inline(always)]
    fn sample_point(&self, u: Vec2<R>) -> (DirectionSample<R>, Option<Vec2<R>>) {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let place = self.place(u);
        let point = self.point(place);
        let squared = point.length_squared();
        let inverse = rsqrt(squared).keep(squared.gt(R::lit(1e-37)));
        let distance = squared * inverse * self.unit;
        let sample = DirectionSample { direction: point * inverse, distance: distance.keep(self.solid_angle.gt(zero)) };
        let part = |x: R, far: R, size: R, anchor: R, flip: R| {
            let gap = R::blend(anchor.gt(zero), -x, far - x);
            let share = ratio(gap, size).clamped(zero, one);
            R::blend(flip.gt(zero), share, one - share)
        };
        let (far, size, anchor, flip) = (self.far, self.size, self.anchor, self.flip);
        let coordinates =
            Vec2::new(part(place.x, far.x, size.x, anchor.x, flip.x), part(place.y, far.y, size.y, anchor.y, flip.y));
        (sample, Some(coordinates))
    }
    #[inline(always)]
    fn solid_angle(&self) -> R {
        self.solid_angle
    }
    #[inline(always)]
    fn uniform_pdf(&self) -> R {
        ratio(R::lit(1.0), self.solid_angle)
    }
    #[inline(always)]
    fn in_front(&self) -> R::Mask {
        self.side.lt(R::lit(0.0))
    }
}

impl<R: Real> Warp<R> for SphericalRectangle<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let point = self.point(self.place(u));
        let squared = point.length_squared();
        point * rsqrt(squared).keep(squared.gt(R::lit(1e-37)))
    }
    /// The pdf per steradian; 0 for a direction that misses the rectangle.
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        let inside = w.dot(self.near_x).ge(-self.slack.x)
            & w.dot(self.far_x).ge(-self.slack_far.x)
            & w.dot(self.near_y).ge(-self.slack.y)
            & w.dot(self.far_y).ge(-self.slack_far.y)
            & w.dot(self.normal).ge(R::lit(-RECTANGLE_SLACK));
        self.uniform_pdf().keep(inside)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let Self { far: Vec2 { x: x1, y: y1 }, near: Vec2 { x: x0, y: y0 }, height: z, .. } = *self;
        let elevation = w.dot(self.normal).greater(R::lit(1e-18));
        // as in the map: from the far edge, where (x₁−x)/D₁ is the sine of the angle to the edge's plane over that to the
        // rectangle's; or from the foot, where a wrong elevation moves the point along the direction
        let number = |side: Vec3<R>, plane: Vec3<R>, far: R, anchor: R| {
            let anchored = anchor.gt(zero);
            let distance = far.mul_add(far, z * z).sqrt();
            R::blend(anchored, distance, z) * w.dot(Vec3::blend(anchored, plane, side)) / elevation
        };
        let along_x = number(self.side_x, self.far_x, x1, self.anchor.x);
        let along_y = number(self.side_y, self.far_y, y1, self.anchor.y);
        // a point beyond an edge by more than its own rounding has a wrong elevation: take the point of the direction on the
        // edge
        let known = (one - R::ONE_MINUS_EPSILON) * R::lit(4.0) * z / elevation;
        let within = |number: R, near: R, far: R, anchor: R| {
            let bound = R::blend(number.lt(zero), near, far).abs();
            let least = number.abs() - known;
            R::blend(least.gt(bound) & anchor.le(zero), bound / least, one)
        };
        let scale = within(along_x, x0, x1, self.anchor.x).lesser(within(along_y, y0, y1, self.anchor.y));
        let place = |number: R, near: R, far: R, size: R, anchor: R| {
            let anchored = anchor.gt(zero);
            let number = R::blend(anchored, number, number * scale);
            let gap = R::blend(anchored, number, far - number.greater(near)).clamped(zero, size);
            (R::blend(anchored, far - gap, number).clamped(near, far), gap)
        };
        let (x, dx) = place(along_x, x0, x1, self.size.x, self.anchor.x);
        let (y, dy) = place(along_y, y0, y1, self.size.y, self.anchor.y);
        // the strip from x to the nearer end: before the foot, mirrored
        let before = x.lt(zero);
        let ends = [R::blend(before, -x, x), R::blend(before, -x0, x1), R::blend(before, x - x0, dx)];
        let (near, far) = (Vec2::new(ends[0], y0), Vec2::new(ends[1], y1));
        let strip = window(corners(near, far, z), near, far, Vec2::new(ends[2], self.size.y), z);
        let share = ratio(strip, self.solid_angle);
        let from_far = self.flip.x.gt(zero) ^ before;
        let u = unit_interval(R::blend(from_far, share, one - share));
        let d = x.mul_add(x, z * z);
        let fall = |low: R, gap: R, d: R| {
            // h(y₁) − h(low), times r₁
            let (r0, r1) = (low.mul_add(low, d).sqrt(), y1.mul_add(y1, d).sqrt());
            let sum = y1.mul_add(r0, low.abs() * r1);
            (ratio(R::blend(low.ge(zero), ratio(gap * (y1 + low) * d, sum), sum), r0), r1)
        };
        let (fallen, r1) = fall(y, dy, d);
        let v = ratio(fallen, fall(y0, self.size.y, d).0);
        // next to u₀ = 1 and near the plane, the strip ends elsewhere within the rounding of u₀, and the pair must lead back to h
        let steep = z.lt(R::lit(STEEP) * x1) & share.lt(R::lit(STEEP)) & !from_far;
        let v = R::where_any(steep, v, || {
            let (end, rounded) = self.strip_end(u);
            let end = end + x1.keep(self.anchor.x.gt(zero));
            let (all, r) = fall(y0, self.size.y, rounded);
            let moved = y1 * ratio((x - end) * (x + end), r1 + r);
            ratio(fallen.mul_add(r, moved), r1 * all)
        });
        Vec2 { x: u, y: unit_interval(R::blend(self.flip.y.gt(zero), v, one - v)) }
    }
}
