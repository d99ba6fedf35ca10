//! Eight lanes on their way down a tree at once. What follows from the weights of the children is computed for all lanes together.

use super::node::{self, LEAST, LIGHT, Node8, Place, WHOLE};
use super::{DEEPEST, NO_LIGHT};
use crate::real::{GREATEST, Mask, Real, Uint};
use crate::select::Gloss;
use crate::vector::Vec3;
use wide::{f32x8, u32x8};

type MaskOf = <f32x8 as Real>::Mask;

/// In place of the weight of a child that cannot contribute.
const DARK: f32 = f32::NEG_INFINITY;

/// Eight lanes from `first` on, the last one for those that do not exist.
#[inline(always)]
pub(super) fn eight<R: Real>(x: R, first: usize) -> f32x8 {
    f32x8::from_fn(|i| x.lane_f64((first + i).min(R::LANES - 1)) as f32)
}
/// The same of counters.
#[inline(always)]
pub(super) fn eight_words<R: Real>(x: R::Uint, first: usize) -> u32x8 {
    u32x8::from_fn(|i| x.lane((first + i).min(R::LANES - 1)))
}

/// The places of eight lanes, in memory: from there, one lane is as soon in all lanes of a packet.
pub(super) struct Places(Place<[f32; 8]>);

impl Places {
    #[inline(always)]
    pub(super) fn new(p: Vec3<f32x8>, n: Vec3<f32x8>) -> Self {
        Self(Place::new(p, n).map(|x: f32x8| x.to_array()))
    }
    /// The weights of a node's children at the place of a lane.
    #[inline(always)]
    pub(super) fn weigh(&self, lane: usize, node: &Node8, gloss: Option<&Gloss<[f32; 8]>>) -> f32x8 {
        let gloss = gloss.map(|gloss| gloss.only(lane));
        let (weight, bright) = node.weigh(&self.0.only(lane), gloss.as_ref());
        Real::blend(bright, weight, f32x8::splat(DARK))
    }
}

/// The shares of the children of a node, for a node in each lane, but for what rounding left to the last that can contribute.
struct Units {
    units: [u32x8; 8],
    /// Sums of two, of four, and of all.
    pairs: [u32x8; 4],
    half: u32x8,
    all: u32x8,
}

/// A child of a node in each lane: its slot, the start of its share, and the share.
struct Found {
    slot: u32x8,
    start: u32x8,
    share: u32x8,
}

impl Units {
    /// From the weights of the children of a node in each row. See [`Shares`](node::Shares), whose bits these are where a lane is `going`.
    #[inline(always)]
    fn of(rows: [f32x8; 8], going: MaskOf) -> Self {
        let mut weights = f32x8::transpose(rows);
        let [zero, one, dark] = [0.0, 1.0, DARK].map(f32x8::splat);
        let sum = |w: [f32x8; 8]| {
            let w = w.map(|w| w.greater(zero));
            ((w[0] + w[1]) + (w[2] + w[3])) + ((w[4] + w[5]) + (w[6] + w[7]))
        };
        let mut total = sum(weights);
        let usual = total.ge(f32x8::splat(LEAST)) & total.le(f32x8::lit(GREATEST));
        if (going & !usual).any() {
            let same = weights.map(|weight| Real::blend(weight.gt(dark), one, dark));
            for (weight, same) in weights.iter_mut().zip(same) {
                *weight = Real::blend(usual, *weight, same);
            }
            total = Real::blend(usual, total, sum(same).greater(one));
        }
        let scale = f32x8::splat((WHOLE - 8) as f32) / total;
        // those that cannot contribute have −1 + 1
        let units = weights.map(|weight| (weight * scale).greater(-one).to_uint().wrapping_add(u32x8::splat(1)));
        let pairs: [u32x8; 4] = [0, 2, 4, 6].map(|k| units[k].wrapping_add(units[k + 1]));
        let half = pairs[0].wrapping_add(pairs[1]);
        Self { units, pairs, half, all: half.wrapping_add(pairs[2].wrapping_add(pairs[3])) }
    }
    /// The child that a number of 16 bits belongs to. Where no child can contribute, the share is 0.
    #[inline(always)]
    fn find(&self, target: u32x8) -> Found {
        let Self { units, pairs, half, all } = *self;
        let (zero, one) = (u32x8::splat(0), u32x8::splat(1));
        // what rounding left belongs to the last as well
        let target = target.min(all.wrapping_sub(one));
        let choose = |is_late: u32x8, early: u32x8, late: u32x8| early ^ ((early ^ late) & is_late);
        let mut within = target;
        let late = |end: u32x8, within: &mut u32x8| {
            let is_late = !within.lt(end);
            *within = within.wrapping_sub(end & is_late);
            is_late
        };
        let a = late(half, &mut within);
        let b = late(choose(a, pairs[0], pairs[2]), &mut within);
        let early = choose(b, choose(a, units[0], units[4]), choose(a, units[2], units[6]));
        let other = choose(b, choose(a, units[1], units[5]), choose(a, units[3], units[7]));
        let c = late(early, &mut within);
        let unit = choose(c, early, other);
        let slot = (a & u32x8::splat(4)) | (b & u32x8::splat(2)) | (c & one);
        let start = target.wrapping_sub(within);
        let is_last = !start.wrapping_add(unit).lt(all);
        let share = choose(is_last, unit, u32x8::splat(WHOLE).wrapping_sub(start));
        Found { slot, start, share: share & zero.lt(all) }
    }
}

/// What eight lanes have chosen.
pub(super) struct Chosen {
    pub(super) light: [u32; 8],
    pub(super) pmf: [f32; 8],
    pub(super) word: [u32; 8],
}

/// Chooses in the first `lanes` of eight lanes, by the weights of the children of a node for a lane.
#[inline(always)]
pub(super) fn choose(
    nodes: &[Node8],
    lanes: usize,
    bits: [u32x8; 2],
    weigh: impl Fn(usize, &Node8) -> f32x8,
) -> Chosen {
    let [mut word, mut more] = bits;
    let mut pmf = f32x8::splat(1.0);
    let mut at = [0_u32; 8];
    let mut rows = [f32x8::splat(1.0); 8];
    let mut going = 0xff_u32 >> (8 - lanes);
    for _ in 0..DEEPEST {
        for lane in Lanes(going) {
            rows[lane] = match nodes.get(at[lane] as usize) {
                Some(node) => weigh(lane, node),
                None => f32x8::splat(DARK),
            };
        }
        let lanes = MaskOf::from_bits(going);
        let Found { slot, start, share } = Units::of(rows, lanes).find(word.shr(16));
        let moves = lanes & f32x8::has_bits(share);
        let (next, sixteen) = node::sixteen(more);
        let stretched = stretched(word.wrapping_sub(start.shl(16)), sixteen, share);
        let product = pmf * (f32x8::from_uint(share) * f32x8::splat(1.0 / WHOLE as f32));
        pmf = Real::blend(moves, product, pmf);
        word = f32x8::blend_uint(moves, stretched, word);
        more = f32x8::blend_uint(moves, next, more);
        let (slots, mut left, mut touched) = (slot.to_array(), 0, 0);
        for lane in Lanes(moves.bits()) {
            let Some(node) = nodes.get(at[lane] as usize) else { continue };
            let child = node.child[slots[lane] as usize & 7];
            at[lane] = child;
            let is_node = !child >> 31;
            left |= is_node << lane;
            // all lines of its memory are on their way before the first is needed
            if let Some(node) = nodes.get((child * is_node) as usize) {
                touched ^= node.touch();
            }
        }
        core::hint::black_box(touched);
        going = left;
        if going == 0 {
            break;
        }
    }
    let light = at.map(|at| if at & LIGHT == 0 { NO_LIGHT } else { at & !LIGHT });
    Chosen { light, pmf: pmf.to_array(), word: word.to_array() }
}

/// The lanes of a mask, one after the other.
struct Lanes(u32);

impl Iterator for Lanes {
    type Item = usize;
    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        if self.0 == 0 {
            return None;
        }
        let lane = self.0.trailing_zeros() as usize & 7;
        self.0 &= self.0 - 1;
        Some(lane)
    }
}

/// As [`node::stretched`] does. In double precision the quotient of 48 bits and 17 is far enough from all integers that it is not.
#[inline(always)]
fn stretched(within: u32x8, sixteen: u32x8, share: u32x8) -> u32x8 {
    let [within, sixteen, share] = [within, sixteen, share].map(u32x8::to_array);
    u32x8::from_fn(|i| {
        let all = f64::from(within[i]) * 65_536.0 + f64::from(sixteen[i]);
        let quotient = all / f64::from(share[i]);
        ((quotient - (0.5 - 1.0 / 131_072.0)) + 4_503_599_627_370_496.0).to_bits() as u32
    })
}
