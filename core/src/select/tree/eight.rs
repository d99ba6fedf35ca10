//! Eight lanes on their way down a tree at once. What follows from the weights of the children is computed for all lanes together.

use super::node::{self, LEAST, LIGHT, Node8, Place, WHOLE, mask_bits};
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

/// The shares of the children of a node, for a node in each lane: where they end, in units of 2⁻¹⁶.
struct Ends {
    ends: [u32x8; 8],
    /// Where any child has a share.
    some: MaskOf,
}

/// A child of a node in each lane: its slot, the start of its share, and the share.
struct Found {
    slot: u32x8,
    start: u32x8,
    share: u32x8,
}

impl Ends {
    /// From the weights of the children of a node in each row. See [`Shares`](super::Shares), whose bits these are.
    #[inline(always)]
    fn of(rows: [f32x8; 8]) -> Self {
        let mut weights = f32x8::transpose(rows);
        let bright = weights.map(|weight| !weight.le(f32x8::splat(DARK)));
        for (weight, bright) in weights.iter_mut().zip(bright) {
            *weight = weight.keep(bright);
        }
        let sum = |w: &[f32x8; 8]| ((w[0] + w[1]) + (w[2] + w[3])) + ((w[4] + w[5]) + (w[6] + w[7]));
        let mut total = sum(&weights);
        let some = bright.into_iter().fold(MaskOf::splat(false), |some, bright| some | bright);
        let usual = total.ge(f32x8::splat(LEAST)) & total.le(f32x8::lit(GREATEST));
        if (some & !usual).any() {
            for (weight, bright) in weights.iter_mut().zip(bright) {
                *weight = Real::blend(usual, *weight, f32x8::splat(1.0).keep(bright));
            }
            total = Real::blend(usual, total, sum(&weights).greater(f32x8::splat(1.0)));
        }
        let scale = f32x8::splat((WHOLE - 8) as f32) / total;
        let (mut units, mut later) = ([u32x8::splat(0); 8], MaskOf::splat(false));
        for k in (0..8).rev() {
            let unit = (weights[k] * scale).to_uint().wrapping_add(u32x8::splat(1));
            // what rounding left goes to the last
            units[k] = f32x8::blend_uint(later, unit, u32x8::splat(WHOLE)) & mask_bits(bright[k]);
            later = later | bright[k];
        }
        let mut end = u32x8::splat(0);
        let ends = units.map(|units| {
            end = end.wrapping_add(units);
            end
        });
        Self { ends, some }
    }
    /// The child where it is told, by slot and end, which shares come before.
    #[inline(always)]
    fn find(&self, is_before: impl Fn(u32, u32x8) -> u32x8) -> Found {
        let (mut slot, mut start, mut end) = (u32x8::splat(0), u32x8::splat(0), u32x8::splat(WHOLE));
        for (k, ends) in (0..).zip(self.ends) {
            let before = is_before(k, ends);
            slot = slot.wrapping_sub(before);
            start = start.max(ends & before);
            end = end.min(ends | before);
        }
        Found { slot, start, share: end.wrapping_sub(start) }
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
    let (mut light, mut at) = ([NO_LIGHT; 8], [0_u32; 8]);
    let mut rows = [f32x8::splat(DARK); 8];
    let mut going = 0xff_u32 >> (8 - lanes);
    for _ in 0..DEEPEST {
        for lane in Lanes(going) {
            rows[lane] = match nodes.get(at[lane] as usize) {
                Some(node) => weigh(lane, node),
                None => f32x8::splat(DARK),
            };
        }
        let ends = Ends::of(rows);
        let moves = ends.some & MaskOf::from_bits(going);
        let target = word.shr(16);
        let Found { slot, start, share } = ends.find(|_, end| !target.lt(end));
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
            let is_light = child & LIGHT != 0;
            light[lane] = if is_light { child & !LIGHT } else { NO_LIGHT };
            at[lane] = child;
            left |= u32::from(!is_light) << lane;
            if let Some(node) = nodes.get(child as usize) {
                touched ^= node.touch();
            }
        }
        core::hint::black_box(touched);
        going = left;
        if going == 0 {
            break;
        }
    }
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
