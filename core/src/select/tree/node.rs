//! Nodes of eight children: how they are packed, and what share of the samples each child receives.

use super::part::{Part, SMALL, WEAK};
use crate::lanewise::{lanewise, only};
use crate::real::{Mask, Real, Uint, unit_interval};
use crate::select::Gloss;
use crate::vector::Vec3;
use wide::{f32x4, f32x8};

/// Shares of a node are in units of 2⁻¹⁶.
pub(super) const WHOLE: u32 = 1 << 16;
/// A child that does not exist.
pub(super) const NONE: u32 = u32::MAX;
/// Set in the index of a child that is a light.
pub(super) const LIGHT: u32 = 1 << 31;

/// The part of the bound in the weight of a child.
const BOUND: f64 = 1.0 / 32.0;
/// E max(0, x) of a normal variable is near (μ + √(μ² + 2σ²/π))/2.
const SMOOTH: f64 = core::f64::consts::FRAC_2_PI;
/// Cosines below which a bound is negative in spite of all rounding.
const MARGIN: f64 = 1.0 / 16_384.0;
/// Sums of weights below this have no reciprocal that can be multiplied by [`WHOLE`].
pub(super) const LEAST: f32 = 1e-33;
/// The least mean of squared distances, relative to the sum of squared distance and variance.
const NEAR: f64 = 0.25;
/// In place of the weight of a child that cannot contribute.
pub(super) const DARK: f32 = f32::NEG_INFINITY;
/// In place of the cosine of a cone, this byte says that the lights emit from both sides.
const TWO_SIDED: u32 = 255;

/// A node of a [`LightTree`](super::LightTree): eight lights or sets of lights. Its contents are private; what is needed is the memory.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Node8 {
    center: [[f32; 8]; 3],
    /// The greatest half extent around the centre.
    reach: [f32; 8],
    /// Intensity along the normal, over 1 − cosine of the cone.
    power: [f32; 8],
    /// Half extents and offset, a byte each, relative to the reach.
    bounds: [u32; 8],
    /// Mean normal, and the greatest distance from it.
    normal: [u32; 8],
    /// Standard deviations of the positions, relative to the reach, and cosine of the cone.
    deviation: [u32; 8],
    /// Covariances of the normals, xx, yy, zz, xy and xz, yz.
    turns: [[u32; 8]; 2],
    pub(super) child: [u32; 8],
    /// 1 where no child is a spot light or emits from both sides, else 0.
    plain: u32,
    /// 8 · parent + slot; for the root, the bits of the scale.
    pub(super) link: u32,
}

/// Children of nodes, one in each lane.
pub(super) struct Children<C: Real> {
    center: Vec3<C>,
    reach: C,
    power: C,
    bounds: C::Uint,
    normals: C::Uint,
    deviations: C::Uint,
    turns: [C::Uint; 2],
}

impl<C: Real> Children<C> {
    /// Their weights at a point of a surface, and whether they can contribute: else the weight is any number. `plain` says that none is a
    /// spot light or emits from both sides. On glossy surfaces, the weights are by what these reflect.
    #[inline(always)]
    pub(super) fn weigh(&self, plain: bool, at: &TreePoint<C>, gloss: Option<&Gloss<C>>) -> (C, C::Mask) {
        let lit = C::lit;
        let zero = lit(0.0);
        let TreePoint { p, n, slope, squares, around } = *at;
        let v = self.center - p;
        let three = |word: C::Uint| Vec3::new(byte(word, 0), byte(word, 1), byte(word, 2));
        let Self { bounds, normals, deviations, turns, power, .. } = *self;
        let unit = self.reach * lit(1.0 / 255.0);
        // variances of the positions along the axes are these times `scale`
        let (varied, scale) = (three(deviations), unit * unit);
        let varied = Vec3::new(varied.x * varied.x, varied.y * varied.y, varied.z * varied.z);
        let variance = (varied.x + varied.y + varied.z) * scale;
        let square = Vec3::new(v.x * v.x, v.y * v.y, v.z * v.z);
        let near = square.x + square.y + square.z + lit(SMALL * SMALL);
        let squared = fused(variance, lit(1.0 / 3.0), near);
        let distance = squared.sqrt();
        // what 1/d² is on average, to the second order of the extent
        let along = varied.dot(square) * scale;
        let mean = (near + variance) - lit(4.0) * along / fused(variance, lit(0.01), near);
        let mean = mean.greater((near + variance) * lit(NEAR));
        // all cosines are multiplied by the distance, so that the square roots do not wait for each other
        let above = v.dot(n);
        let estimate = above + fused(above, above, varied.dot(squares) * (scale * lit(SMOOTH))).sqrt();
        let estimate = fused(around + around, distance, estimate);
        let bias = lit(-128.0 / 127.0);
        let normal = three(normals).mul_add(lit(1.0 / 127.0), Vec3::new(bias, bias, bias));
        let ahead = -v.dot(normal);
        let [xy, xz, yz] = [byte(turns[0], 3), byte(turns[1], 0), byte(turns[1], 1)].map(|x: C| x - lit(128.0));
        let mixed = xy * (v.x * v.y) + xz * (v.x * v.z) + yz * (v.y * v.z);
        let turned = three(turns[0]).dot(square) * lit(SMOOTH / 255.0) + mixed * lit(2.0 * SMOOTH / 254.0);
        let turned = fused(variance, lit(SMOOTH / 3.0), turned.greater(zero));
        let bound =
            fused(lit(MARGIN) + around, distance, fused(three(bounds).dot(slope), unit, above)).lesser(distance);
        let spread = fused(byte(normals, 3), lit(1.0 / 127.5), lit(MARGIN));
        let mut front = fused(spread, distance, fused(byte::<C>(bounds, 3) + byte(bounds, 3), unit, ahead));
        let facing = if plain {
            ahead + fused(ahead, ahead, turned).sqrt()
        } else {
            let top: C = byte(deviations, 3);
            let both = top.gt(lit(254.0));
            let cone = (top * lit(1.0 / 254.0)).keep(!both);
            // no position is nearer than this
            let near = distance - lit(3.5 * 255.0) * unit;
            front = fused(-near, cone, front);
            let y = ahead - cone * distance;
            let root = fused(y, y, turned).sqrt();
            C::blend(both, root + root, y + root)
        };
        let front = front.lesser(distance);
        let bright = bound.lesser(front).lesser(power).gt(zero);
        let mut cosines = fused(bound * front, lit(4.0 * BOUND), estimate * facing);
        if let Some(gloss) = gloss {
            cosines *= gloss.factor(v, varied * scale);
        }
        (power * cosines / (mean * squared), bright)
    }
}

lanewise! {
    /// A point of a surface, or one that light reaches from all around.
    pub(super) struct TreePoint {
        p: Vec3<R>,
        n: Vec3<R>,
        /// |n| and n², component by component.
        slope: Vec3<R>,
        squares: Vec3<R>,
        /// 1 where there is no normal, so that all cosines are 1; else 0.
        around: R,
    }
}
only!(TreePoint { p: Vec3, n: Vec3, slope: Vec3, squares: Vec3, around: R });

impl<R: Real> TreePoint<R> {
    #[inline(always)]
    pub(super) fn new(p: Vec3<R>, n: Vec3<R>) -> Self {
        Self {
            p,
            n,
            slope: Vec3::new(n.x.abs(), n.y.abs(), n.z.abs()),
            squares: Vec3::new(n.x * n.x, n.y * n.y, n.z * n.z),
            around: R::lit(1.0).keep(n.max_abs().le(R::lit(0.0))),
        }
    }
}

impl Default for Node8 {
    fn default() -> Self {
        Self {
            center: [[0.0; 8]; 3],
            reach: [0.0; 8],
            power: [0.0; 8],
            bounds: [0; 8],
            normal: [0; 8],
            deviation: [0; 8],
            turns: [[0; 8]; 2],
            child: [NONE; 8],
            plain: 1,
            link: 0,
        }
    }
}

/// Byte `k` of each word.
#[inline(always)]
fn byte<C: Real>(word: C::Uint, k: u32) -> C {
    C::from_uint(word.shr(8 * k) & C::Uint::splat(255))
}

/// The smallest integer that is not less, from 0 to `most`.
fn ceiling(x: f64, most: f64) -> u32 {
    let down = x.clamped(0.0, most) as u32;
    if f64::from(down) < x && f64::from(down) < most { down + 1 } else { down }
}

impl Node8 {
    /// To be called before all children are stored again.
    pub(super) fn forget_kinds(&mut self) {
        self.plain = 1;
    }
    /// Stores a child.
    pub(super) fn set(&mut self, slot: usize, child: u32, part: &Part) {
        self.child[slot] = child;
        // what rounding may take from a bound
        const MORE: f64 = 1.0 + 1.0 / 1_048_576.0;
        let center = part.center.map(|x| x as f32);
        let half: [f64; 3] = core::array::from_fn(|k| {
            let center = f64::from(center[k]);
            (part.high[k] - center).greater(center - part.low[k]) * MORE
        });
        let reach = half[0].greater(half[1]).greater(half[2]).greater(SMALL) * MORE;
        let relative = 255.0 / reach;
        let byte = |x: f64| ceiling(x * relative * MORE, 255.0);
        let [x, y, z] = half.map(byte);
        self.bounds[slot] = x | y << 8 | z << 16 | byte(part.offset * 0.5) << 24;
        let mean = part.normal.map(|x| ((x * 127.0).round_ties_even() + 128.0).clamped(0.0, 255.0) as u32);
        let [x, y, z] = mean;
        let mean = mean.map(|byte| (f64::from(byte) - 128.0) / 127.0);
        let off: f64 = (0..3).map(|k| part.normal[k] - mean[k]).map(|x| x * x).sum();
        let spread = ceiling((part.spread + off.sqrt() + 1e-6) * 127.5, 255.0);
        self.normal[slot] = x | y << 8 | z << 16 | spread << 24;
        let cone = if part.two_sided { TWO_SIDED } else { (part.cone * 254.0).clamped(0.0, 253.0) as u32 };
        let [xx, yy, zz] = [0, 1, 2].map(|k| (part.turns[k] * 255.0).round_ties_even().clamped(0.0, 255.0) as u32);
        let [xy, xz, yz] = [3, 4, 5]
            .map(|k| (part.turns[k] * 254.0).round_ties_even().clamped(-127.0, 127.0) + 128.0)
            .map(|x| x as u32);
        let [x, y, z] = part.variances.map(|x| (x.sqrt() * relative).round_ties_even().clamped(0.0, 255.0) as u32);
        self.deviation[slot] = x | y << 8 | z << 16 | cone << 24;
        self.turns[0][slot] = xx | yy << 8 | zz << 16 | xy << 24;
        self.turns[1][slot] = xz | yz << 8;
        self.plain &= u32::from(part.power <= 0.0 || cone == 0);
        self.center.iter_mut().zip(center).for_each(|(to, x)| to[slot] = x);
        self.reach[slot] = reach as f32;
        let cone = if part.two_sided { 0.0 } else { f64::from(cone) / 254.0 };
        self.power[slot] = if part.power > 0.0 { (part.power.greater(WEAK) / (1.0 - cone)) as f32 } else { 0.0 };
    }

    /// A child, with the bounds as they are stored.
    fn part(&self, slot: usize) -> Part {
        let byte = |word: &[u32; 8], k: u32| f64::from(word[slot] >> (8 * k) & 255);
        let three = |word| [0, 1, 2].map(|k| byte(word, k));
        let (center, reach) = ([0, 1, 2].map(|k| f64::from(self.center[k][slot])), f64::from(self.reach[slot]));
        let half = three(&self.bounds).map(|x| x * reach * (1.0 / 255.0));
        let normal = three(&self.normal).map(|x| (x - 128.0) / 127.0);
        let spread = byte(&self.normal, 3) * (1.0 / 127.5);
        let two_sided = byte(&self.deviation, 3) as u32 == TWO_SIDED;
        let cone = if two_sided { 0.0 } else { byte(&self.deviation, 3) / 254.0 };
        let end = |a: [f64; 3], sign: f64, b: [f64; 3]| core::array::from_fn(|k| a[k] + sign * b[k]);
        Part {
            center,
            low: end(center, -1.0, half),
            high: end(center, 1.0, half),
            variances: three(&self.deviation).map(|x| x * reach * (1.0 / 255.0)).map(|x| x * x),
            power: f64::from(self.power[slot]) * (1.0 - cone),
            normal,
            spread,
            turns: [
                byte(&self.turns[0], 0) / 255.0,
                byte(&self.turns[0], 1) / 255.0,
                byte(&self.turns[0], 2) / 255.0,
                (byte(&self.turns[0], 3) - 128.0) / 254.0,
                (byte(&self.turns[1], 0) - 128.0) / 254.0,
                (byte(&self.turns[1], 1) - 128.0) / 254.0,
            ],
            offset: byte(&self.bounds, 3) * reach * (2.0 / 255.0),
            cone,
            two_sided,
        }
    }
    /// All lights below this node.
    pub(super) fn union(&self) -> Part {
        Part::union(&core::array::from_fn::<_, 8, _>(|slot| self.part(slot)))
    }

    /// The first children: all of them in eight lanes.
    #[inline(always)]
    fn children<C: Real<Scalar = f32>>(&self) -> Children<C> {
        let number = |x: &[f32; 8]| C::from_fn(|slot| x[slot]);
        let word = |x: &[u32; 8]| C::Uint::from_fn(|slot| x[slot]);
        let [x, y, z] = &self.center;
        Children {
            center: Vec3::new(number(x), number(y), number(z)),
            reach: number(&self.reach),
            power: number(&self.power),
            bounds: word(&self.bounds),
            normals: word(&self.normal),
            deviations: word(&self.deviation),
            turns: [word(&self.turns[0]), word(&self.turns[1])],
        }
    }
    /// The children's weights at the point of one of eight lanes, in negative where they cannot contribute.
    #[inline(always)]
    pub(super) fn weigh_at(&self, lane: usize, at: &TreePoint<[f32; 8]>, gloss: Option<&Gloss<[f32; 8]>>) -> f32x8 {
        let gloss = gloss.map(|gloss| gloss.only(lane));
        let (weight, bright) = self.children::<f32x8>().weigh(self.plain != 0, &at.only(lane), gloss.as_ref());
        Real::blend(bright, weight, f32x8::splat(DARK))
    }
    /// Reads a word of each line of memory, so that all lines are on their way.
    #[inline(always)]
    pub(super) fn touch(&self) -> u32 {
        let [x, _, z] = &self.center;
        (x[0].to_bits() ^ z[0].to_bits())
            ^ (self.power[0].to_bits() ^ self.normal[0])
            ^ (self.turns[0][0] ^ self.child[0])
    }
    /// The sum of the children's weights at a point of a surface: 0 only where none can contribute, and finite.
    pub(super) fn sum(&self, at: &TreePoint<f32>, gloss: Option<&Gloss<f32>>) -> f32 {
        let (weight, bright) = self.weighed::<f32x8>(at, gloss);
        let sum: f32 = weight.greater(f32x8::splat(f32::MIN_POSITIVE)).keep(bright).to_array().iter().sum();
        sum.lesser(f32::MAX)
    }
    /// The first children's weights at a point of a surface, and which can contribute.
    #[inline(always)]
    fn weighed<C: Real<Scalar = f32>>(&self, at: &TreePoint<f32>, gloss: Option<&Gloss<f32>>) -> (C, C::Mask) {
        let gloss = gloss.map(|gloss| Gloss::splat(*gloss));
        self.children().weigh(self.plain != 0, &TreePoint::splat(*at), gloss.as_ref())
    }
    /// The children's shares at a point of a surface.
    #[inline(always)]
    pub(super) fn shares(&self, at: &TreePoint<f32>, gloss: Option<&Gloss<f32>>) -> Shares {
        // of few lights, the same in fewer lanes
        if self.child[4] == NONE { self.shares_of::<f32x4>(at, gloss) } else { self.shares_of::<f32x8>(at, gloss) }
    }
    #[inline(always)]
    fn shares_of<C: Real<Scalar = f32>>(&self, at: &TreePoint<f32>, gloss: Option<&Gloss<f32>>) -> Shares {
        let (weight, lanes) = self.weighed::<C>(at, gloss);
        let bright = lanes.bits();
        let sum = |w: C| {
            let w: [f32; 8] = core::array::from_fn(|slot| if slot < C::LANES { w.lane(slot) } else { 0.0 });
            ((w[0] + w[1]) + (w[2] + w[3])) + ((w[4] + w[5]) + (w[6] + w[7]))
        };
        let mut weight = weight.keep(lanes);
        let mut total = sum(weight);
        if !(LEAST..f32::INFINITY).contains(&total) {
            weight = C::lit(1.0).keep(lanes);
            total = sum(weight).greater(1.0);
        }
        let scaled = weight * C::lit(f64::from((WHOLE - 8) as f32 / total));
        // what rounding left goes to the last
        let last = C::Mask::from_bits(1 << (bright | 1).ilog2());
        let (one, whole, none) = (C::Uint::splat(1), C::Uint::splat(WHOLE), C::Uint::splat(0));
        let units = C::blend_uint(lanes, C::blend_uint(last, whole, scaled.to_uint().wrapping_add(one)), none);
        Shares { units: core::array::from_fn(|slot| if slot < C::LANES { units.lane(slot) } else { 0 }) }
    }
}

/// What each child of a node receives, in units of 2⁻¹⁶. A child that can contribute has at least one unit, no other child has any. The
/// last that can contribute receives what the others leave, and has [`WHOLE`] here; where none can, all have 0.
#[derive(Clone, Copy, Default)]
pub(super) struct Shares {
    units: [u32; 8],
}

impl Shares {
    /// The child that a number of 16 bits belongs to, the start of its share, and the share; 0 if there is none.
    #[inline(always)]
    pub(super) fn find(&self, target: u32) -> (usize, u32, u32) {
        let (mut slot, mut start, mut end) = (0, 0, 0);
        for units in self.units {
            end += units;
            let passed = end <= target;
            slot += usize::from(passed);
            start = if passed { end } else { start };
        }
        let slot = slot & 7;
        (slot, start, self.units[slot].min(WHOLE - start))
    }
    /// The share of a child.
    #[inline(always)]
    pub(super) fn of(&self, slot: usize) -> u32 {
        let before: u32 = self.units.iter().take(slot).sum();
        self.units[slot & 7].min(WHOLE.wrapping_sub(before))
    }
}

/// Points farther away than this, relative to the extent of the lights, count as this far.
const FARTHEST: f64 = (1_u64 << 30) as f64;

/// A point in the units of a tree. One that is too far keeps its direction; at the origin, the quotient is infinite.
#[inline(always)]
pub(super) fn scaled<R: Real>(p: Vec3<R>, scale: R) -> Vec3<R> {
    p * (R::lit(FARTHEST) / p.max_abs()).lesser(scale)
}

/// The bits of a choice by `u`: its 24 bits, and a hash of them for the digits below.
#[inline(always)]
pub(super) fn bits_of<R: Real>(u: R) -> [R::Uint; 2] {
    let bits = (unit_interval(u) * R::lit(16_777_216.0)).to_uint();
    let more = bits.wrapping_mul(R::Uint::splat(0x9e37_79b9)) ^ R::Uint::splat(0x5bd1_e995);
    [bits.shl(8) | more.shr(24), more]
}

/// The next state of a generator of random bits, and the sixteen bits that come with it.
#[inline(always)]
pub(super) fn sixteen<U: Uint>(state: U) -> (U, U) {
    // a linear congruential generator, and the output function of PCG (O'Neill 2014)
    let state = state.wrapping_mul(U::splat(747_796_405)).wrapping_add(U::splat(2_891_336_453));
    let down = U::from_fn(|lane| state.lane(lane) >> ((state.lane(lane) >> 28) + 4));
    let word = down ^ state;
    let word = word.wrapping_mul(U::splat(277_803_737));
    (state, (word.shr(22) ^ word).shr(16) ^ (word & U::splat(0xffff)))
}

/// The position within a share, which is less than 2¹⁶ times the share, stretched to all of 32 bits with sixteen new ones: exactly uniform.
/// The share is at most 2¹⁶.
#[inline(always)]
pub(super) fn stretched(within: u32, sixteen: u32, share: u32) -> u32 {
    // long division of 48 bits
    let quotient = |x: u32| x.checked_div(share).unwrap_or(0);
    let high = quotient(within);
    let rest = within.wrapping_sub(high.wrapping_mul(share));
    high << 16 | quotient(rest << 16 | sixteen)
}

/// `a·b + c`, rounded once: the packet's own method of that name rounds twice where the target has no such instruction.
#[inline(always)]
fn fused<R: Real>(a: R, b: R, c: R) -> R {
    a.mul_add(b, c)
}
