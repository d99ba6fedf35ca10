//! A cap cut by the horizon with its centre below: the lune between circle and ellipse.

use super::ProjectedCap;
use crate::math::{double, ratio};
use crate::real::{Mask, Real};
use crate::vector::{Vec2, Vec3};

/// C(x), and (C(x) − C(y))/(1 − x²/y²), for 0 ≤ x ≤ y, with C(x) = ∫₀¹ (1−s²)/(1+x²s²) ds.
///
/// Up to 1 (2.5 in single precision) by Gauss–Legendre quadrature, where (C(x)−C(y))/(y²−x²) = ∫ s²(1−s²)/((1+x²s²)(1+y²s²))
/// ds; beyond, in closed form.
#[inline]
pub(super) fn arcs<R: Real>(x: R, y: R) -> (R, R) {
    // s² and weight · (1−s²)
    const NARROW: [(f64, f64); 5] = [
        (0.022_163_568_807_217_638, 0.288_974_353_226_087_8),
        (0.187_831_567_652_445_52, 0.218_689_929_305_368_82),
        (0.461_597_361_496_266_73, 0.117_956_675_638_790_13),
        (0.748_334_627_387_280_5, 0.037_611_729_322_003_11),
        (0.948_493_926_288_368_7, 0.003_433_979_174_416_841),
    ];
    const WIDE: [(f64, f64); 10] = [
        (0.005_856_308_436_795_614_6, 0.151_858_816_180_923_5),
        (0.051_886_393_980_323_686, 0.141_432_938_125_265_2),
        (0.139_656_240_742_977, 0.122_251_500_866_774),
        (0.260_985_093_682_225_4, 0.097_319_866_806_633_61),
        (0.404_564_284_765_747_5, 0.070_377_245_675_284_54),
        (0.557_011_314_600_443_3, 0.045_153_889_780_458_76),
        (0.704_117_292_400_090_4, 0.024_640_147_777_813_36),
        (0.832_171_652_087_023_6, 0.010_518_146_332_235_684),
        (0.929_241_876_579_895_5, 0.002_872_880_980_848_451),
        (0.986_304_414_519_349_03, 0.000_241_234_140_431_037_57),
    ];
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    let quadrature = |nodes: &[(f64, f64)], reach: R| {
        let (x, y) = (x.lesser(reach), y.lesser(reach));
        let (x2, y2) = (x * x, y * y);
        let (mut first, mut both) = (zero, zero);
        for &(s2, weight) in nodes {
            let s2 = R::lit(s2);
            let (dx, dy) = (x2.mul_add(s2, one), y2.mul_add(s2, one));
            let term = R::lit(weight) / (dx * dy);
            first = term.mul_add(dy, first);
            both = term.mul_add(s2, both);
        }
        (first, both * y2)
    };
    let far = y.gt(one);
    let (first, difference) = quadrature(if double::<R>() { &WIDE } else { &NARROW }, one);
    if !far.any() {
        return (first, difference);
    }
    // in single precision, the closed form has too few digits below 2.5, where twice as many nodes suffice
    let reach = R::lit(if double::<R>() { 1.0 } else { 2.5 });
    let wide = if double::<R>() { (first, difference) } else { quadrature(&WIDE, reach) };
    let closed = |x: R| {
        // ((1+x²) atan x − x)/x³, in terms of 1/x
        let inverse = one / x.greater(one);
        let square = inverse * inverse;
        (one + square) * inverse * one.atan2(inverse) - square
    };
    let far_first = R::blend(x.gt(reach), closed(x), wide.0);
    let q = x / y.greater(one);
    let beyond = ratio(far_first - closed(y), (one - q) * (one + q));
    let far_difference = R::blend(y.gt(reach), beyond, wide.1);
    (R::blend(far, far_first, first), R::blend(far, far_difference, difference))
}

/// A slice of the lune at ±t: its half-area up to t and its width, in units common to all slices of a cap.
pub(super) struct Slice<R> {
    pub(super) area: R,
    width: R,
    /// (d width/dt)/width
    slope: R,
}

impl<R: Real> ProjectedCap<R> {
    /// Maps `u` to a direction in the local frame and (cosine to the axis) − cosσ.
    #[inline]
    pub(super) fn lune(&self, u: Vec2<R>) -> (Vec3<R>, R) {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        let side = two.mul_add(u.x, -one);
        let t = self.invert_lune(two * u.x.lesser(one - u.x));
        let width = self.width(t);
        let y = (self.sin_theta * t).copysign(side);
        let arc = ((one - y) * (one + y)).greater(zero).sqrt();
        let inward = width * u.y;
        let x = arc - inward;
        let z = (inward * (arc + x)).greater(zero).sqrt();
        // the rim at the same y
        let (rim_x, rim_z) = (arc - width, (width * (arc + arc - width)).greater(zero).sqrt());
        let beyond = width * (one - u.y) * (self.sin_omega - self.cos_omega * ratio(x + rim_x, z + rim_z));
        (Vec3::new(x, y, z), beyond)
    }
    /// Width of the lune at ±t, on the unit disk.
    #[inline(always)]
    pub(super) fn width(&self, t: R) -> R {
        self.sin_theta * self.tan_theta * self.sin_omega * self.sin_omega * self.slice(t, false).width
    }
    /// The slice at t; `area` is 0 without `with_area`.
    #[inline]
    pub(super) fn slice(&self, t: R, with_area: bool) -> Slice<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let (a, beta) = (self.tan_theta, self.beta);
        let m = ((one - t) * (one + t)).greater(zero);
        let p = (a * a).mul_add(m, one).sqrt();
        let q = beta.mul_add(beta, m).sqrt();
        let (p1, q1, pq) = (one + p, beta + q, beta.mul_add(p, q));
        // two divisions serve all the quotients below: P ≥ 1, and Q ≥ β ≥ 1e−9
        let (a_pair, a_triple) = (one / (p * q), one / (p1 * q1 * pq));
        let (by_p, by_q, by_pq) = (q * a_pair, p * a_pair, p1 * q1 * a_triple);
        let width = m * m * a_triple;
        let mut area = zero;
        if with_area {
            let (x, y) = (t * a * by_p, t * by_q);
            let (c, difference) = arcs(x.lesser(y), y);
            let tail = R::lit(0.5) * t * t * t * a_pair;
            area = t.mul_add(width, tail * (c * m * by_pq + beta * difference * by_p));
        }
        // derivative of log m² − log(1+P) − log(β+Q) − log(βP+Q) by m, times dm/dt = −2t
        let (dp, dq) = (R::lit(0.5) * a * a * by_p, R::lit(0.5) * by_q);
        let by_m = ratio(R::lit(2.0), m) - (dp * q1 + dq * p1) * pq * a_triple - beta.mul_add(dp, dq) * by_pq;
        Slice { area, width, slope: -(t + t) * by_m }
    }
    /// The half-lune's area beyond t, in the units of a slice, by quadrature: a difference would leave few digits.
    #[inline]
    pub(super) fn tail(&self, t: R) -> R {
        let one = R::lit(1.0);
        let rest = one - t;
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
            // in terms of √(1−t), where P and Q have no steep root
            sum = R::lit(2.0 * weight * x).mul_add(self.slice(rest.mul_add(R::lit(-x * x), one), false).width, sum);
        }
        sum * rest
    }
    /// Where single precision would leave few digits of the area beyond t: a share of less than 1/8 of the half.
    #[inline(always)]
    pub(super) fn ends(share: R) -> R::Mask {
        share.lt(R::lit(if double::<R>() { -1.0 } else { 0.125 }))
    }
    /// The t in [0, 1] beyond which lies the share `left` of the half-lune.
    #[inline]
    fn invert_lune(&self, left: R) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let v = one - left;
        let target = v * self.half;
        let ends = Self::ends(left);
        let start = self.slice(zero, false);
        // estimates from the two ends: area ≈ width · t; and near P = 1 and t = 1, with r = Q − β, the rest is r⁴/8 + βr³/6
        let near = v * ratio(self.half, start.width);
        let rest = left.greater(zero) * self.half;
        let mut r = (R::lit(8.0) * rest).sqrt().sqrt().lesser((R::lit(6.0) * ratio(rest, self.beta)).cbrt());
        for _ in 0..2 {
            let (cube, sum) = (r * r * r, R::lit(0.5) * (r + self.beta));
            let off = cube.mul_add(R::lit(0.125).mul_add(r, R::lit(1.0 / 6.0) * self.beta), -rest);
            r -= ratio(off, r * r * sum);
        }
        let far = (one - r * (r + self.beta + self.beta)).greater(zero).sqrt();
        let mut t = R::blend(v.lt(R::lit(0.5)), near, near.greater(far)).clamped(zero, one);
        // a step cubes the error, so one below `enough` of the rest is the last
        let (steps, enough) = if double::<R>() { (7, 0.0) } else { (4, 1.0 / 256.0) };
        let mut open = R::Mask::splat(true);
        for _ in 0..steps {
            let slice = self.slice(t, true);
            let mut off = slice.area - target;
            if (ends & open).any() {
                off = R::blend(ends, left * self.half - self.tail(t), off);
            }
            let newton = ratio(off, slice.width);
            // Halley: off/(1 − ½ off f′/f)
            let halley = one - R::lit(0.5) * newton * slice.slope;
            let step = newton / halley.greater(R::lit(0.5));
            // a converged lane stays as it is, so that it does not depend on its neighbours
            t = R::blend(open, (t - step).clamped(zero, one), t);
            open = open & (step.abs()).gt(R::lit(enough) * (one - t));
            if !open.any() {
                break;
            }
        }
        t
    }
}
