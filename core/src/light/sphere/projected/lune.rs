//! A cap cut by the horizon with its centre below: the lune between circle and ellipse.
//!
//! All slices have one unit, sin³θ (1 − κ) for areas and sin²θ (1 − κ) for widths, so that nothing here under- or overflows.

use super::ProjectedCap;
use super::segment::{segment_difference, segment_ratio};
use crate::math::ratio;
use crate::real::{Mask, Real};
use crate::vector::{Vec2, Vec3};

/// Area of half a lune, from t = 0 to 1, from cosθ and κ cosθ.
#[inline(always)]
pub(super) fn half<R: Real>(cos_theta: R, near: R) -> R {
    R::lit(0.5) * segment_difference(cos_theta, near)
}

/// The slice of a lune at ±t.
struct Slice<R> {
    /// the half-area up to t
    area: R,
    /// the width
    width: R,
    /// m = 1 − t²
    m: R,
    /// m (d width/dt)/width
    slope: R,
}

impl<R: Real> ProjectedCap<R> {
    /// Maps `u` to a direction in the local frame and (cosine to the axis) − cosσ.
    #[inline]
    pub(super) fn lune(&self, u: Vec2<R>) -> (Vec3<R>, R) {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        let side = two.mul_add(u.x, -one);
        let rest = self.invert_lune(two * u.x.lesser(one - u.x));
        let (arc, width) = self.width(rest * (two - rest));
        let y = (self.sin_theta * (one - rest)).copysign(side);
        let inward = width * u.y;
        let x = arc - inward;
        let z = (inward * (arc + x)).greater(zero).sqrt();
        // the rim at the same y
        let (rim_x, rim_z) = (arc - width, (width * (arc + arc - width)).greater(zero).sqrt());
        let beyond = width * (one - u.y) * (self.sin_omega - self.cos_omega * ratio(x + rim_x, z + rim_z));
        (Vec3::new(x, y, z), beyond)
    }
    /// The inverse of [`lune`](Self::lune).
    #[inline]
    pub(super) fn invert_in_lune(&self, w: Vec3<R>) -> Vec2<R> {
        let (zero, one, half) = (R::lit(0.0), R::lit(1.0), R::lit(0.5));
        let (x, z) = (w.x.greater(zero), w.z.greater(zero));
        // near y = ±1, x and z determine 1 − t² better than y does
        let tall = w.y.abs().gt(R::lit(0.7));
        let arc = R::blend(tall, x.mul_add(x, z * z), (one - w.y) * (one + w.y)).greater(zero).sqrt();
        let m =
            ratio((arc - self.cos_theta) * (arc + self.cos_theta), self.sin_theta * self.sin_theta).clamped(zero, one);
        let t = ratio(w.y.abs(), self.sin_theta).lesser(one);
        let rest = R::blend(tall, m / (one + (one - m).sqrt()), one - t);
        let left = half - half * ratio(self.slice(rest).area, self.part);
        let left = R::where_any(Self::ends(left + left), left, || half * ratio(self.tail(rest), self.part));
        let inward = ratio(z * z, arc + x);
        Vec2 {
            x: R::blend(w.y.lt(zero), left, one - left),
            y: ratio(inward, self.width(rest * (R::lit(2.0) - rest)).1),
        }
    }
    /// κ cosθ, the cosine of the ellipse's angle at the horizon.
    #[inline(always)]
    fn near(&self) -> R {
        self.kappa * self.cos_theta
    }
    /// For m = 1 − t²: x on the circle and the ellipse's cosψ, both from sums of positive terms.
    #[inline(always)]
    fn cosines(&self, m: R) -> (R, R) {
        let (one, near) = (R::lit(1.0), self.near());
        let sin_squared = self.sin_theta * self.sin_theta;
        let arc = (self.cos_theta * self.cos_theta + sin_squared * m).sqrt();
        let ellipse = ((one - near) * (one + near)).mul_add(m, near * near).sqrt();
        (arc, ellipse)
    }
    /// For m = 1 − t²: x on the circle, and the width of the lune on the unit disk.
    #[inline(always)]
    fn width(&self, m: R) -> (R, R) {
        let (arc, width) = self.shape(m);
        (arc, self.sin_theta * self.sin_theta * self.rest * width)
    }
    /// For m = 1 − t²: x on the circle, and the width in the units of the slices.
    #[inline(always)]
    fn shape(&self, m: R) -> (R, R) {
        let (arc, ellipse) = self.cosines(m);
        let below = (self.cos_theta + arc) * (self.near() + ellipse) * self.kappa.mul_add(arc, ellipse);
        (arc, (R::lit(1.0) + self.kappa) * ratio(m * m, below))
    }
    /// The slice at t = 1 − `rest`.
    #[inline(always)]
    fn slice(&self, rest: R) -> Slice<R> {
        let (one, half) = (R::lit(1.0), R::lit(0.5));
        let (t, m) = (one - rest, rest * (R::lit(2.0) - rest));
        let (arc, ellipse) = self.cosines(m);
        let near = self.near();
        let (outer, inner, c) = (self.cos_theta + arc, near + ellipse, self.kappa.mul_add(arc, ellipse));
        let (ends, sum) = (outer * inner, arc + ellipse);
        // two divisions serve all the quotients below
        let (by_ends, by_both) = (ratio(one, ends * c), ratio(one, arc * ellipse * sum));
        let (by_c, by_sum) = (ends * by_ends, arc * ellipse * by_both);
        let (by_arc, by_ellipse) = (ellipse * (sum * by_both), arc * (sum * by_both));
        let up = one + self.kappa;
        let width = up * (m * m) * by_ends;
        let across = m * by_c * segment_ratio(arc);
        let along = near * self.cos_theta * (t * t) * by_sum * segment_difference(arc, ellipse);
        let area = t * (half * (t * t) * up * by_ellipse).mul_add(across + along, width);
        // m times the derivative of log width by t, at most 4
        let shares = self.cos_theta.mul_add(by_arc, near * by_ellipse);
        let slope = -t * (one + (near * by_c).mul_add(shares, shares));
        Slice { area, width, m, slope }
    }
    /// The half-area beyond t = 1 − `rest`, by quadrature: a difference would leave few digits.
    #[inline]
    fn tail(&self, rest: R) -> R {
        let two = R::lit(2.0);
        let mut sum = R::lit(0.0);
        for (x, weight) in [
            (0.0198550717512319, 0.0506142681451885),
            (0.1016667612931866, 0.1111905172266872),
            (0.2372337950418355, 0.1568533229389434),
            (0.4082826787521751, 0.1813418916891808),
            (0.5917173212478248, 0.1813418916891808),
            (0.7627662049581645, 0.1568533229389434),
            (0.8983332387068134, 0.1111905172266872),
            (0.9801449282487681, 0.0506142681451885),
        ] {
            // in terms of √(1−t), where the lune has no steep root
            let part = rest * R::lit(x * x);
            sum = R::lit(2.0 * weight * x).mul_add(self.shape(part * (two - part)).1, sum);
        }
        sum * rest
    }
    /// Where single precision would leave few digits of the area beyond t: a share of less than 1/64 of the half.
    #[inline(always)]
    fn ends(share: R) -> R::Mask {
        share.lt(R::lit(if R::DOUBLE { -1.0 } else { 1.0 / 64.0 }))
    }
    /// 1 − t for the t in [0, 1] beyond which lies the share `left` of the half-lune.
    #[inline]
    fn invert_lune(&self, left: R) -> R {
        // fitted within 0.013, over all lunes, to polynomials of ∛left and of the mean width over the greatest
        const START: [[f64; 3]; 4] = [
            [3.79463, -7.63498, 3.56300],
            [-6.93468, 20.43162, -13.23997],
            [6.91802, -22.14491, 16.69282],
            [-2.79944, 9.41089, -7.06435],
        ];
        let (one, half) = (R::lit(1.0), R::lit(0.5));
        let target = (one - left) * self.part;
        let ends = Self::ends(left);
        let mean = (one + self.cos_theta) * (one + self.near()) * self.part;
        // ∛left within 1e−4
        let guess = left.greater(R::lit(1e-30)).inverse_cbrt_estimate();
        let off = one - left * guess * guess * guess;
        let guess = (guess * off).mul_add(R::lit(2.0 / 9.0).mul_add(off, R::lit(1.0 / 3.0)), guess);
        let root = left * guess * guess;
        let start = START.map(|[c0, c1, c2]| mean.mul_add(mean.mul_add(R::lit(c2), R::lit(c1)), R::lit(c0)));
        let series = root.mul_add(root.mul_add(root.mul_add(start[3], start[2]), start[1]), start[0]);
        // the thickest lune has 0.88 root² near its ends
        let rest = (root * series).greater(half * root * root).lesser(one);
        // a step cubes the error, so one below `enough` of the rest is the last
        let (steps, enough) = if R::DOUBLE { (7, 0.0) } else { (4, 1.0 / 128.0) };
        let step = |[rest]: [R; 1], [open]: [R::Mask; 1]| {
            let slice = self.slice(rest);
            let off = R::where_any(ends & open, slice.area - target, || left * self.part - self.tail(rest));
            // Halley's method, off/(f − ½ off f′/f), and at most twice Newton's step
            let steep = slice.m * slice.width;
            let step = ratio(slice.m * off, (steep - half * off * slice.slope).greater(half * steep));
            // a converged lane stays as it is, so that it does not depend on its neighbours
            let next = (rest + step).greater(R::lit(0.125) * rest).lesser(one);
            let moves = (next - rest).abs().gt(R::lit(enough) * next);
            ([R::blend(open, next, rest)], [open & moves])
        };
        let [rest] = R::iterate(steps, [rest], [R::Mask::splat(true)], step);
        rest
    }
}
