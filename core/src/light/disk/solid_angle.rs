//! Disks by solid angle.

use crate::lanewise::lanewise;
use crate::light::direction::DirectionSample;
use crate::light::seen::SphericalShape;
use crate::math::{ratio, rsqrt};
use crate::real::{Real, blended, unit_interval};
use crate::vector::double_word::compensated_dot;
use crate::vector::{Frame, Vec2, Vec3};
use crate::warp::{Linear, Warp};

/// Angle by which the rounding of its direction and of the frame may move a sample out of the disk: 6 ulp of a component near
/// 1.
const DISK_SLACK: f64 = 6.0 / 16_777_216.0;

lanewise! {
    /// Directions from a point to a disk (the interior of a spherical ellipse), uniform in solid angle: for every disk that is
    /// not far.
    ///
    /// [`Disk::by_solid_angle`](crate::Disk::by_solid_angle) says how.
    pub struct SphericalDisk {
        /// x along the minor axis, y along the major axis, z along the axis of the cone
        frame: Frame<R>,
        /// sinα, the semi-axis along x
        sin_minor: R,
        /// sinβ, the semi-axis along y
        sin_major: R,
        /// cosα
        cos_minor: R,
        /// cosβ
        cos_major: R,
        /// ∫dχ/(1+D) up to t = 1/256, 16/256, 81/256 and 1
        sums: Quarter<R>,
        /// Ω in steradians
        solid_angle: R,
        /// unit normal of the disk's plane, away from the viewpoint
        normal: Vec3<R>,
        /// z, the distance to the disk's plane, in units of `unit`
        height: R,
        /// d + R, the greatest distance, in units of `unit`
        reach: R,
        /// −1 where the point is on the side to which the normal points, else 1
        side: R,
        /// unit of the lengths above, a power of two
        unit: R,
    }
}

/// One value per panel of the quadrature.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
struct Quarter<R>([R; 4]);
impl<R> Quarter<R> {
    #[inline(always)]
    fn map<S>(self, f: impl FnMut(R) -> S) -> Quarter<S> {
        Quarter(self.0.map(f))
    }
}
blended!(Quarter { 0 });

const NARROW: [(f64, f64); 5] = [
    (0.046_910_077_030_668_02, 0.118_463_442_528_094_64),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_15),
    (0.5, 0.284_444_444_444_444_33),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_15),
    (0.953_089_922_969_331_9, 0.118_463_442_528_094_64),
];
const WIDE: [(f64, f64); 20] = [
    (0.003_435_700_407_452_502, 0.008_807_003_569_575_447),
    (0.018_014_036_361_043_095, 0.020_300_714_900_193_223),
    (0.043_882_785_874_337_03, 0.031_336_024_167_054_395),
    (0.080_441_514_088_890_61, 0.041_638_370_788_352_36),
    (0.126_834_046_769_924_6, 0.050_965_059_908_620_35),
    (0.181_973_159_636_742_5, 0.059_097_265_980_759_3),
    (0.244_566_499_024_586_44, 0.065_844_319_224_588_44),
    (0.313_146_955_642_290_2, 0.071_048_054_659_191_2),
    (0.386_107_074_429_177_47, 0.074_586_493_236_302_12),
    (0.461_736_739_433_251_33, 0.076_376_693_565_363_14),
    (0.538_263_260_566_748_7, 0.076_376_693_565_363_14),
    (0.613_892_925_570_822_5, 0.074_586_493_236_302_12),
    (0.686_853_044_357_709_8, 0.071_048_054_659_191_2),
    (0.755_433_500_975_413_6, 0.065_844_319_224_588_44),
    (0.818_026_840_363_257_6, 0.059_097_265_980_759_3),
    (0.873_165_953_230_075_4, 0.050_965_059_908_620_35),
    (0.919_558_485_911_109_4, 0.041_638_370_788_352_36),
    (0.956_117_214_125_663, 0.031_336_024_167_054_395),
    (0.981_985_963_638_957, 0.020_300_714_900_193_223),
    (0.996_564_299_592_547_4, 0.008_807_003_569_575_447),
];

impl<R: Real> SphericalDisk<R> {
    /// Prepares for a disk with its centre at `center` relative to the point, a `normal` of any length, and `radius` in the
    /// unit of `center`.
    #[inline(always)]
    pub fn new(center: Vec3<R>, normal: Vec3<R>, radius: R) -> Self {
        let (zero, one, half) = (R::lit(0.0), R::lit(1.0), R::lit(0.5));
        let reach = center.max_abs().greater(radius.abs());
        let finite = reach.lt(R::lit(f64::INFINITY));
        let scale = reach.keep(finite).pow2_scale();
        let (c, r) = (center.keep(finite) * scale, radius.greater(zero).keep(finite) * scale);
        let normal = normal * normal.max_abs().pow2_scale();
        let squared = normal.length_squared();
        let some = squared.gt(zero);
        let shrink = rsqrt(R::blend(some, squared, one)).keep(some);
        let signed = compensated_dot(c, normal) * shrink;
        // before the normal is rounded: near the disk's axis this determines the azimuth
        let across = normal.cross(c);
        let normal = normal * shrink;
        let (z, side) = (signed.abs(), one.copysign(signed));
        let towards = normal * side;

        let power = c.length_squared_minus_square(r);
        let cross = r * z;
        let both = cross + cross;
        let h = power.mul_add(power, both * both).sqrt();
        let (cos_2a, sin_2a) = (ratio(power.abs(), h).lesser(one), ratio(both, h));
        // the larger of cosine and sine by the half-angle formula, the smaller from sin 2α
        let large = (half * (one + cos_2a)).sqrt();
        let small = sin_2a / (large + large);
        let outside = power.ge(zero);
        let (cos_minor, sin_minor) = (R::blend(outside, large, small), R::blend(outside, small, large));
        let hcc = h * cos_minor * cos_minor;
        let inverse = ratio(one, r.mul_add(r, hcc));
        let root = inverse.sqrt();
        let (sin_major, cos_major) = (r * root, h.sqrt() * cos_minor * root);
        let cos_major_squared = hcc * inverse;

        // axis: z towards the foot on the disk's plane, plus what is left of the offset
        let offset = c - towards * z;
        let axis = towards * z + offset * cos_major_squared;
        let axis = (axis * axis.max_abs().pow2_scale()).normalize();
        let somewhere = axis.max_abs().gt(zero);
        // if the point lies in the disk's plane: the normal, or any direction if that is 0
        let axis = Vec3::blend(somewhere, axis, towards);
        let axis = Vec3::new(axis.x, axis.y, R::blend(axis.max_abs().gt(zero), axis.z, one));
        let across = (across * across.max_abs().pow2_scale()).normalize();
        let any = Frame::new(axis);
        let y = Vec3::blend(across.max_abs().gt(zero), across, any.t);
        let x = y.cross(axis).normalize();
        let frame = Frame { s: x, t: axis.cross(x), n: axis };

        let this = Self {
            frame,
            sin_minor,
            sin_major,
            cos_minor,
            cos_major,
            sums: Quarter::default(),
            solid_angle: zero,
            normal: towards,
            height: z,
            reach: c.length() + r,
            side,
            unit: one / scale,
        };
        let mut sums = [zero; 4];
        let mut sum = zero;
        for (i, s) in sums.iter_mut().enumerate() {
            let (low, high) = (0.25 * i as f64, 0.25 * (i + 1) as f64);
            sum += this.panel(R::lit(low), R::lit(high));
            *s = sum;
        }
        let solid_angle = R::lit(4.0) * (sin_minor * sin_major) * sum;
        let seen = z.gt(zero) & r.gt(zero) & solid_angle.gt(R::lit(1e-37));
        Self { sums: Quarter(sums), solid_angle: solid_angle.keep(seen), ..this }
    }

    /// 2/((1+t²)(1+D)), the integrand in t, given t².
    #[inline(always)]
    fn integrand(&self, tt: R) -> R {
        let one = R::lit(1.0);
        let (a, b) = (self.cos_major * (one - tt), self.cos_minor + self.cos_minor);
        let root = a.mul_add(a, b * b * tt).sqrt();
        R::lit(2.0) / ((one + tt) + root)
    }
    /// The integral from t = low⁴ to t = high⁴.
    #[inline(always)]
    fn panel(&self, low: R, high: R) -> R {
        let width = high - low;
        let nodes: &[(f64, f64)] = if R::DOUBLE { &WIDE } else { &NARROW };
        let mut sum = R::lit(0.0);
        for &(x, weight) in nodes {
            let s = width.mul_add(R::lit(x), low);
            let (ss, weight) = (s * s, R::lit(4.0 * weight));
            let t = ss * ss;
            sum = (weight * ss * s).mul_add(self.integrand(t * t), sum);
        }
        sum * width
    }
    /// The panel that the masks choose, as (low, high, integral up to low, integral over the panel); `beyond` tells whether the
    /// target lies past the first, second and third panel.
    #[inline(always)]
    fn choose(&self, beyond: [R::Mask; 3]) -> (R, R, R, R) {
        let [a, b, c, d] = self.sums.0;
        let pick = |v: [R; 4]| R::blend(beyond[2], v[3], R::blend(beyond[1], v[2], R::blend(beyond[0], v[1], v[0])));
        let edges = [0.0, 0.25, 0.5, 0.75, 1.0].map(R::lit);
        let low = pick([edges[0], edges[1], edges[2], edges[3]]);
        (low, low + R::lit(0.25), pick([R::lit(0.0), a, b, c]), pick([a, b - a, c - b, d - c]))
    }
    /// The t = tan(χ/2) in [0, 1] up to which the integral is `part`.
    #[inline(always)]
    fn invert_integral(&self, part: R) -> R {
        let [a, b, c, _] = self.sums.0;
        let (low, high, before, whole) = self.choose([part.gt(a), part.gt(b), part.gt(c)]);
        let square = |x: R| x * x;
        let (first, last) = (square(square(low)), square(square(high)));
        let share = part - before;
        let guess = Linear { a: self.integrand(first * first), b: self.integrand(last * last) };
        let mut t = (last - first).mul_add(guess.sample(unit_interval(ratio(share, whole))), first);
        let steps = if R::DOUBLE { 4 } else { 2 };
        for _ in 0..steps {
            let off = self.panel(low, t.sqrt().sqrt()) - share;
            t = (t - off / self.integrand(t * t)).clamped(first, last);
        }
        t
    }
    /// The integral from 0 to t.
    #[inline(always)]
    fn integral(&self, t: R) -> R {
        let s = t.sqrt().sqrt();
        let (low, _, before, _) = self.choose([0.25, 0.5, 0.75].map(|edge| s.gt(R::lit(edge))));
        before + self.panel(low, s)
    }

    /// D and 1−D² at the boundary point with the given cosine and sine of χ.
    #[inline(always)]
    fn rim(&self, cos: R, sin: R) -> (R, R) {
        let (a, b) = (self.cos_major * cos, self.cos_minor * sin);
        let (x, y) = (self.sin_minor * sin, self.sin_major * cos);
        (a.mul_add(a, b * b).sqrt(), x.mul_add(x, y * y))
    }
}

impl<R: Real> SphericalShape<R> for SphericalDisk<R> {
    #[inline(always)]
    fn sample_point(&self, u: Vec2<R>) -> (DirectionSample<R>, Option<Vec2<R>>) {
        let direction = self.sample(u);
        let cos = direction.dot(self.normal);
        let distance = ratio(self.height, cos).lesser(self.reach).greater(self.height) * self.unit;
        let distance = distance.lesser(R::lit(f64::from(f32::MAX)));
        (DirectionSample { direction, distance: distance.keep(self.solid_angle.gt(R::lit(0.0))) }, None)
    }
    #[inline(always)]
    fn solid_angle(&self) -> R {
        self.solid_angle
    }
    #[inline(always)]
    fn in_front(&self) -> R::Mask {
        self.side.lt(R::lit(0.0))
    }
}

impl<R: Real> Warp<R> for SphericalDisk<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        // quadrants, every second one backwards
        let turned = R::lit(4.0) * u.x;
        let quadrant = [1.0, 2.0, 3.0].map(|k| turned.ge(R::lit(k)));
        let of = |values: [f64; 4]| {
            let v = values.map(R::lit);
            let upper = R::blend(quadrant[2], v[3], v[2]);
            R::blend(quadrant[1], upper, R::blend(quadrant[0], v[1], v[0]))
        };
        let part = (turned - of([0.0, 2.0, 2.0, 4.0])).abs().lesser(one);
        let t = self.invert_integral(part * self.sums.0[3]);
        let tt = t * t;
        let inverse = one / (one + tt);
        let (cos, sin) = ((one - t) * (one + t) * inverse, (t + t) * inverse);
        let (d, radius_squared) = self.rim(cos, sin);
        // sinθ over that of the rim: √(k(2−k)/(h(2−h)))
        let h = radius_squared / (one + d);
        let k = u.y * h;
        let factor = (u.y.greater(zero) * ratio(R::lit(2.0) - k, one + d)).sqrt();
        let x = self.sin_minor * sin * factor * of([1.0, 1.0, -1.0, -1.0]);
        let y = self.sin_major * cos * factor * of([1.0, -1.0, -1.0, 1.0]);
        self.frame.to_world(Vec3::new(x, y, one - k))
    }
    /// The pdf per steradian; 0 for a direction that misses the disk.
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        let at = self.locate(w);
        // 6 ulp across the boundary, and more along the radius by its slant to the boundary
        let radius = at.rim_squared.sqrt();
        let slack = R::lit(DISK_SLACK) * radius * (ratio(at.sin, self.sin_minor) + ratio(at.cos, self.sin_major));
        let beyond = slack * R::lit(0.5).mul_add(slack, radius);
        self.uniform_pdf().keep(at.one_minus_cos.le(at.rim_squared / (R::lit(1.0) + at.rim_cos) + beyond))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let (zero, one, half) = (R::lit(0.0), R::lit(1.0), R::lit(0.5));
        let at = self.locate(w);
        let part = ratio(self.integral(at.t), self.sums.0[3]).lesser(one) * R::lit(0.25);
        let upper = at.y.ge(zero);
        let right = R::blend(upper, part, half - part);
        let left = R::blend(upper, one - part, half + part);
        Vec2 {
            x: unit_interval(R::blend(at.x.lt(zero), left, right)),
            y: unit_interval(ratio(at.one_minus_cos * (one + at.rim_cos), at.rim_squared)),
        }
    }
}

/// A direction, and the rim point at the same azimuth.
struct DirectionAndRim<R> {
    /// components of the direction along the minor and the major axis
    x: R,
    y: R,
    /// 1−cosθ of the direction, θ from the axis of the cone
    one_minus_cos: R,
    /// tan(χ/2) of the rim point, in the first quadrant
    t: R,
    /// cosχ and sinχ
    cos: R,
    sin: R,
    /// D
    rim_cos: R,
    /// 1−D²
    rim_squared: R,
}
impl<R: Real> SphericalDisk<R> {
    #[inline(always)]
    fn locate(&self, w: Vec3<R>) -> DirectionAndRim<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let Vec3 { x, y, z } = self.frame.to_local(w);
        // a disk may be thinner than the resolution of a direction: move back to it across, not towards the centre
        let rounding = R::lit(if R::DOUBLE { 8.0 / 9_007_199_254_740_992.0 } else { 8.0 / 16_777_216.0 });
        let high = ratio(y.abs(), self.sin_major).lesser(one);
        let wide = self.sin_minor * ((one - high) * (one + high)).sqrt();
        let x = R::blend((x.abs() - wide).le(rounding), x.clamped(-wide, wide), x);
        let flat = x.mul_add(x, y * y);
        let one_minus_cos = R::blend(z.gt(R::lit(0.5)), flat / (one + z.greater(zero)), one - z);
        let (a, b) = (x.abs() * self.sin_major, y.abs() * self.sin_minor);
        let scale = a.greater(b).pow2_scale();
        let (a, b) = (a * scale, b * scale);
        let t = ratio(a, a.mul_add(a, b * b).sqrt() + b).lesser(one);
        let inverse = one / t.mul_add(t, one);
        let (cos, sin) = ((one - t) * (one + t) * inverse, (t + t) * inverse);
        let (rim_cos, rim_squared) = self.rim(cos, sin);
        DirectionAndRim { x, y, one_minus_cos, t, cos, sin, rim_cos, rim_squared }
    }
}
