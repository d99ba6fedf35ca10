//! The part of a polygon between two half-planes of constant azimuth and two great circles that meet in a vertex.
#![expect(unreachable_pub, reason = "the structs of lanewise! are declared pub")]

use crate::lanewise::lanewise;
use crate::light::direction::above_horizon;
use crate::math::{ratio, rsqrt};
use crate::real::{Real, unit_interval};
use crate::vector::{Vec2, Vec3};

/// Angle beside a sector within which a direction counts as on its border: the rounding of two directions.
#[inline(always)]
pub(super) fn border<R: Real>() -> R {
    R::lit(if R::DOUBLE { 1e-15 } else { 8.0 / 16_777_216.0 })
}
/// Up to this tangent of either arc, the area uses the form that keeps its digits at any size; beyond, the difference of arcs.
const NEAR: f64 = 0.7;
/// How far the inner arc may rise over the outer one in that form, relative to the cosine k of its plane.
const STEEP: f64 = 4.0;
const INV_TWO_PI: f64 = 0.5 / core::f64::consts::PI;
/// Part of the whole area below which a sector is so narrow that within the rounding of u₀ its arcs may move by more than 1e−5 of their
/// distance.
const NARROW: f64 = 1.0 / 128.0;

lanewise! {
    /// The region between an outer (lower) arc and an inner one, from the vertex in which they meet up to an azimuth.
    ///
    /// At the angle θ along the outer arc, its height over the horizon is z = ζ cosθ + τ sinθ, and the plane of the inner arc
    /// is D = sinδ sinθ away (δ is the angle between the arcs). With c and k the cosines of the outer and the inner plane to
    /// the horizon, squared distances to the zenith's axis are in the ratio k²/(k² + y), y = D(2kz + D), so the area is ½c ∫
    /// y/(k² + y) dθ: an integral of positive terms.
    pub struct Sector {
        /// unit vector to the vertex in which the arcs meet
        pub(super) apex: Vec3<R>,
        /// unit tangent there, along the outer arc
        tangent: Vec3<R>,
        /// ζ, the height of the apex
        height: R,
        /// τ, the height of the tangent
        slope: R,
        /// c
        outer: R,
        /// k; 0 stands for the zenith itself as the inner arc
        inner: R,
        /// c−k
        gap: R,
        /// sinδ
        fold: R,
        /// tanθ at the far end if both arcs are short, else 0
        near: R,
        /// θ at the far end if they are not, else 0
        wide: R,
        /// d log area / d log θ at the far end
        power: R,
        /// projected area, a part of Ω⊥
        pub(super) area: R,
    }
}

/// The inputs of [`Sector::new`].
pub(in crate::light) struct Corner<R> {
    /// as in [`Sector`]
    pub(super) apex: Vec3<R>,
    pub(super) tangent: Vec3<R>,
    pub(super) height: R,
    pub(super) slope: R,
    pub(super) outer: R,
    pub(super) inner: R,
    /// sinδ and cosδ
    pub(super) fold: [R; 2],
    /// proportional to the sine and the cosine of the outer arc's length
    pub(super) end: [R; 2],
}

/// Newton step, relative to its variable, below which `R` counts as converged: the next error is its square.
fn enough<R: Real>() -> R {
    R::lit(if R::DOUBLE { 1e-9 } else { 3e-4 })
}

/// ∫₀¹ t²/((1+at²)(1+bt²)) dt for a, b in [0, ½], given a+b and ab, by Gauss's rule for the weight t².
#[inline(always)]
fn mean_fall<R: Real>(sum: R, product: R) -> R {
    const FEW: [(f64, f64); 4] = [
        (0.937_334_249_363_463_9, 0.076_181_267_807_371),
        (0.698_948_012_417_800_8, 0.126_263_672_864_602_07),
        (0.376_224_514_453_174_9, 0.098_048_132_715_498_17),
        (0.105_140_282_589_087_79, 0.032_840_259_945_862_1),
    ];
    const MANY: [(f64, f64); 8] = [
        (0.981_239_772_294_383_8, 0.023_695_275_208_029_79),
        (0.903_783_947_690_318_8, 0.050_123_432_394_669_35),
        (0.774_820_967_754_000_3, 0.065_887_790_733_189_48),
        (0.610_764_138_286_809_7, 0.068_334_641_519_292_47),
        (0.432_531_353_665_425_8, 0.058_450_716_383_121_09),
        (0.262_851_586_818_020_2, 0.040_491_172_741_629_2),
        (0.123_363_751_658_919_72, 0.020_725_616_336_108_083),
        (0.031_856_603_044_242_76, 0.005_624_688_017_293_875),
    ];
    // one division for four quotients
    let pair = |&[(x, v), (y, w)]: &[(f64, f64); 2]| {
        let below = |t: f64| product.mul_add(R::lit(t * t), sum.mul_add(R::lit(t), R::lit(1.0)));
        let (p, q) = (below(x), below(y));
        (R::lit(v).mul_add(q, R::lit(w) * p), p * q)
    };
    let four = |nodes: &[(f64, f64)]| {
        let ((a, p), (b, q)) = (pair(&[nodes[0], nodes[1]]), pair(&[nodes[2], nodes[3]]));
        a.mul_add(q, b * p) / (p * q)
    };
    if R::DOUBLE { four(&MANY[..4]) + four(&MANY[4..]) } else { four(&FEW) }
}

/// An area and its derivative.
struct Swept<R> {
    area: R,
    density: R,
}

impl<R: Real> Sector<R> {
    #[inline]
    pub(in crate::light) fn new(corner: Corner<R>) -> Self {
        let Corner { apex, tangent, height, slope, outer, inner, fold: [sin, cos], end: [y, x] } = corner;
        let (zero, one, half) = (R::lit(0.0), R::lit(1.0), R::lit(0.5));
        // c − k = c(1−cosδ) + τ sinδ; near the zenith c and k are small, and the plain difference is better
        let versine = R::blend(cos.gt(zero), sin * sin / (one + cos.greater(zero)), one - cos);
        let gap = R::blend((outer + inner).le(sin), outer - inner, outer.mul_add(versine, slope * sin));
        let (near, steep) = (R::lit(NEAR), R::lit(STEEP));
        let rise = height * sin * y;
        let tangent_inner = near * inner.mul_add(x, rise);
        let limit = steep * inner * x;
        let small = y.le(near * x) & (outer * y).le(tangent_inner) & rise.lt(limit) & (sin * y).lt(limit);
        let mut sector = Self { apex, tangent, height, slope, outer, inner, gap, fold: sin, ..Self::default() };
        let [near, area, density] = R::where_any(small, [zero; 3], || {
            let near = y / R::blend(small, x, one);
            let swept = sector.by_tangent(&Self { near, ..sector }.narrow(), near);
            [near, swept.area, swept.density]
        });
        let [wide, area, density] = R::where_any(!small, [zero, area, density], || {
            let wide = y.atan2(x);
            let (s, c) = (wide * R::lit(INV_TWO_PI)).sin_cos_turns();
            let swept = sector.by_angle(wide, s, c);
            [wide, swept.area, swept.density]
        });
        (sector.near, sector.wide) = (near, wide);
        let area = area.greater(zero);
        sector.area = half * outer * area;
        let power = ratio(R::blend(small, near, wide) * density, area);
        sector.power = power.clamped(R::lit(0.25), R::lit(4.0));
        sector
    }

    /// c, c − k, ζ sinδ and sinδ, each over k.
    #[inline(always)]
    fn narrow(&self) -> [R; 4] {
        let inverse = ratio(R::lit(1.0), self.inner.keep(self.near.gt(R::lit(0.0))));
        let fold = self.fold * inverse;
        [self.outer * inverse, self.gap * inverse, self.height * fold, fold]
    }

    /// The area up to x = tanθ and its derivative by x, over ½c, both accurate relative to their own size.
    ///
    /// With B = k + ζ sinδ x the inner arc's tangent is v = cx/B; the area is c atan x − k atan v, with atan x/x = 1 − x²Ψ.
    #[inline(always)]
    fn by_tangent(&self, &[outer, gap, lift, fold]: &[R; 4], x: R) -> Swept<R> {
        let one = R::lit(1.0);
        let b = lift.mul_add(x, one);
        let inverse = one / b;
        let v = outer * x * inverse;
        let (x2, v2) = (x * x, v * v);
        let fall = mean_fall(x2 + v2, x2 * v2);
        let theta = x.atan2(one);
        let second = x2 * (gap - lift * x) * (outer + b) * inverse * fall;
        let area = inverse * lift.mul_add(x * theta, x * second * inverse);
        let bend = fold * (self.slope + self.slope + fold);
        let above = (x * bend.mul_add(x, lift + lift)).greater(R::lit(0.0));
        let square = one + x2;
        Swept { area, density: above / (square * (square + above)) }
    }

    /// y at θ, from its sine and the height z there.
    #[inline(always)]
    fn rise(&self, s: R, z: R) -> R {
        let away = self.fold * s;
        // if the inner arc is the zenith, the ratio is 1 even where the outer arc begins
        (away * (self.inner + self.inner).mul_add(z, away)).greater(R::lit(1e-37))
    }
    #[inline(always)]
    fn height(&self, s: R, c: R) -> R {
        self.height.mul_add(c, self.slope * s).greater(R::lit(0.0))
    }

    /// The area up to θ and its derivative by θ, over ½c, accurate relative to θ.
    #[inline(always)]
    fn by_angle(&self, theta: R, s: R, c: R) -> Swept<R> {
        let lift = self.height * self.fold;
        // the angle from the end of the outer arc to that of the inner one
        let y = s * lift.mul_add(s, -self.gap * c);
        let x = s.mul_add(lift.mul_add(c, self.gap * s), self.inner);
        let both = self.gap.mul_add(theta, self.inner * y.atan2(x));
        let rise = self.rise(s, self.height(s, c));
        Swept { area: ratio(both, self.outer), density: rise / self.inner.mul_add(self.inner, rise) }
    }

    /// Estimates the share of the far end's θ or tanθ for the share v of the area: exact at both ends to first order.
    #[inline(always)]
    fn start(&self, v: R) -> R {
        let root = v.sqrt();
        let two = R::lit(2.0);
        self.power * root / (self.power - two).mul_add(root, two)
    }

    /// Sine and cosine of the θ up to which the share `v` of the area lies.
    ///
    /// A packet may need both forms. Their iterations take turns, so that a processor works on both chains of operations at once.
    #[inline(never)]
    pub(in crate::light) fn sweep(&self, v: R) -> [R; 2] {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let small = self.near.gt(zero);
        let target = v * ratio(R::lit(2.0) * self.area, self.outer);
        let start = self.start(v);
        let narrow = self.narrow();
        let x = self.near * start;
        // about the zenith, the area is proportional to θ
        let theta = self.wide * R::blend(self.inner.gt(zero), start, v);
        let going = [x.gt(zero), theta.gt(zero) & self.inner.gt(zero)];
        let step = |[x, theta, low, high]: [R; 4], mut going: [R::Mask; 2]| {
            let [tangent, angle] = going;
            let [x] = R::where_any(tangent, [x], || {
                let mut x = x;
                self.step_tangent(&narrow, target, &mut x, &mut going[0]);
                [x]
            });
            let [theta, low, high] = R::where_any(angle, [theta, low, high], || {
                let (mut theta, mut bracket) = (theta, [low, high]);
                self.step_angle(target, &mut theta, &mut bracket, &mut going[1]);
                [theta, bracket[0], bracket[1]]
            });
            ([x, theta, low, high], going)
        };
        let [x, theta, ..] = R::iterate(24, [x, theta, zero, self.wide], going, step);
        let tangent = R::where_any(small, [zero, one], || {
            let c = one / x.mul_add(x, one).sqrt();
            [x * c, c]
        });
        R::where_any(!small, tangent, || (theta * R::lit(INV_TWO_PI)).sin_cos_turns().into())
    }

    /// A step of Newton's method in x², which is nearly proportional to the area.
    #[inline(always)]
    fn step_tangent(&self, narrow: &[R; 4], target: R, x: &mut R, going: &mut R::Mask) {
        let most = self.near * self.near;
        let swept = self.by_tangent(narrow, *x);
        let square = *x * *x;
        let step = R::lit(2.0) * *x * ratio(target - swept.area, swept.density);
        *x = (square + step).clamped(square * R::lit(0.0625), most).sqrt();
        *going = *going & step.abs().gt(enough::<R>() * square);
    }

    /// A step of Newton's method, within a bracket, in θ² or θ, whichever is more nearly proportional to the area.
    #[inline(always)]
    fn step_angle(&self, target: R, theta: &mut R, [low, high]: &mut [R; 2], going: &mut R::Mask) {
        let (zero, two, half) = (R::lit(0.0), R::lit(2.0), R::lit(0.5));
        let at = *theta;
        let (s, c) = (at * R::lit(INV_TWO_PI)).sin_cos_turns();
        let swept = self.by_angle(at, s, c);
        let short = swept.area.lt(target);
        *low = R::blend(short, at, *low);
        *high = R::blend(short, *high, at);
        let step = ratio(target - swept.area, swept.density);
        let quadratic = (at * swept.density).gt(R::lit(1.5) * swept.area);
        let square = at * (at + two * step);
        let moved = R::blend(quadratic, square.greater(zero).sqrt(), at + step);
        let inside = moved.ge(*low) & moved.le(*high);
        let moved = R::blend(inside, moved, half * (*low + *high));
        let far = (moved - at).abs().gt(enough::<R>() * at);
        *theta = moved;
        *going = *going & far;
    }

    /// The direction at the azimuth of θ on the outer arc, at `u` of the way there from the inner one.
    #[inline(always)]
    pub(in crate::light) fn direction(&self, normal: Vec3<R>, [s, c]: [R; 2], u: R) -> Vec3<R> {
        let one = R::lit(1.0);
        let z = self.height(s, c);
        let rise = self.rise(s, z);
        let whole = self.inner.mul_add(self.inner, rise);
        // squared distance to the axis: 1 − ν times that of the outer arc
        let nu = (one - u) * rise / whole;
        let keep = (self.inner.mul_add(self.inner, u * rise) / whole).sqrt();
        let arc = self.apex.mul_add(c, self.tangent * s);
        let flat = arc - normal * z;
        let squared = flat.length_squared();
        let up = squared.mul_add(nu, z * z).sqrt();
        // as a displacement, accurate relative to its own size
        let moved = normal * (ratio(squared, up + z) * nu) - flat * (nu / (one + keep));
        let w = arc + moved;
        // a unit vector up to rounding; from the triangle's own plane or corner its planes are pure rounding
        let squared = w.length_squared();
        above_horizon(w * rsqrt(R::blend(squared.gt(R::lit(1e-30)), squared, one)), normal)
    }

    /// Numbers proportional to the sine and the cosine of the angle θ on the outer arc at the azimuth of a direction, in a sector about
    /// the zenith. A direction beyond the arc, as rounding may place it, counts as the nearest one on the arc: along its azimuth that may
    /// be far.
    #[inline(always)]
    fn azimuth_about_zenith(&self, normal: Vec3<R>, w: Vec3<R>) -> [R; 2] {
        let pole = self.apex.cross(self.tangent);
        let (upright, side) = (pole.dot(normal), w.dot(pole));
        let inwards = side.negate_where(upright.lt(R::lit(0.0))).greater(R::lit(0.0));
        // the zenith is on the edge, to rounding: it does not tell the inner side, but the direction is there
        let inwards = R::blend(upright.abs().lt(border()), side.abs(), inwards);
        let along = (w - self.apex).dot(self.tangent);
        [self.outer * along - self.slope * inwards, self.outer * w.dot(self.apex) - self.height * inwards]
    }
    /// How far the azimuth of a direction is outside a sector about the zenith, as an angle along the outer arc.
    #[inline(always)]
    pub(in crate::light) fn miss(&self, normal: Vec3<R>, w: Vec3<R>) -> R {
        let [y, x] = self.azimuth_about_zenith(normal, w);
        let theta = y.atan2(x);
        (-theta).greater(theta - self.wide).greater(R::lit(0.0))
    }

    /// u₁ of a direction where `share` of the area is before its azimuth, which a rounded u₀ gives: `y`, unless this sector is narrow among
    /// the `whole`.
    #[inline(always)]
    pub(in crate::light) fn at_share(&self, normal: Vec3<R>, share: R, w: Vec3<R>, whole: R, y: R) -> R {
        let [y] = R::where_any(self.is_narrow(whole), [y], || [self.outwards(normal, self.sweep(share), w)]);
        y
    }

    #[inline(always)]
    pub(in crate::light) fn is_narrow(&self, whole: R) -> R::Mask {
        self.area.gt(R::lit(0.0)) & self.area.lt(whole * R::lit(NARROW))
    }

    /// The share of the area before the azimuth of a direction, and u₁.
    #[inline(never)]
    pub(in crate::light) fn locate(&self, normal: Vec3<R>, w: Vec3<R>) -> Vec2<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        // q_A × q_w and q_w × q_T for the horizontal parts q of apex, direction and tangent
        let (start, far) = (normal.cross(self.apex), normal.cross(self.tangent));
        let clockwise = start.dot(self.tangent).lt(zero);
        let y = start.dot(w - self.apex).negate_where(clockwise);
        let x = (-far.dot(w)).negate_where(clockwise);
        // over the sine of the way from the vertex, this is the cosine of a plane between the arcs; they bound it better than
        // the rounded direction does, since along a steep arc a unit of azimuth is a long way
        let way = w.cross(self.apex).length();
        let y = y.greater(way * self.outer.lesser(self.inner));
        let y = R::blend(self.slope.ge(zero), y.lesser(way * self.outer), y);
        let about = self.inner.le(zero);
        let [y, x] = R::where_any(about, [y, x], || {
            let [sin, cos] = self.azimuth_about_zenith(normal, w);
            [sin.greater(zero), cos]
        });
        let small = self.near.gt(zero);
        let tangent = R::where_any(small, [zero, one, zero], || {
            let tan = ratio(y, x).lesser(self.near);
            let c = one / tan.mul_add(tan, one).sqrt();
            [tan * c, c, self.by_tangent(&self.narrow(), tan).area]
        });
        let [s, c, area] = R::where_any(!small, tangent, || {
            let theta = y.atan2(x).lesser(self.wide);
            let (s, c) = (theta * R::lit(INV_TWO_PI)).sin_cos_turns();
            [s, c, self.by_angle(theta, s, c).area]
        });
        Vec2 {
            x: unit_interval(ratio(area * self.outer * R::lit(0.5), self.area)),
            y: self.outwards(normal, [s, c], w),
        }
    }
    /// u₁ of a direction at the azimuth of θ on the outer arc.
    #[inline(always)]
    pub(in crate::light) fn outwards(&self, normal: Vec3<R>, [s, c]: [R; 2], w: Vec3<R>) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let z = self.height(s, c);
        let rise = self.rise(s, z);
        let whole = self.inner.mul_add(self.inner, rise);
        let arc = self.apex.mul_add(c, self.tangent * s);
        // r₀² − r² = sin(angle between) · sin(sum of the angles to the axis)
        let (out, inward) = (arc.cross(normal), w.cross(normal));
        let (out2, in2) = (out.length_squared(), inward.length_squared());
        let (r0, r) = (out2.sqrt(), in2.sqrt());
        let between = (w - arc).dot(out.cross(arc));
        let sum = r0.mul_add(w.dot(normal).greater(zero), z * r);
        let nu = ratio(between, out2) * ratio(sum, r0);
        // from the nearer of the two arcs
        unit_interval(R::blend(
            nu.lt(R::lit(0.5)),
            one - nu * whole / rise,
            (ratio(in2, out2) * whole - self.inner * self.inner) / rise,
        ))
    }
}
