//! Eight lanes on their way down a tree at once. What follows from the weights of the children is computed for all lanes together.

use super::node::{self, DARK, LEAST, LIGHT, Node8, TreePoint, WHOLE};
use super::{DEEPEST, NO_LIGHT};
use crate::real::{GREATEST, Mask, Real, Uint};
use crate::select::Gloss;
use wide::{f32x8, u32x8};

type MaskOf = <f32x8 as Real>::Mask;

/// Eight lanes from `first` on, the last one for those that do not exist.
#[inline(always)]
pub(super) fn of<R: Real>(x: R, first: usize) -> f32x8 {
    f32x8::from_fn(|i| x.lane_f64((first + i).min(R::LANES - 1)) as f32)
}
/// The same of counters.
#[inline(always)]
pub(super) fn words_of<R: Real>(x: R::Uint, first: usize) -> u32x8 {
    u32x8::from_fn(|i| x.lane((first + i).min(R::LANES - 1)))
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
struct FoundChild {
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
    fn find(&self, target: u32x8) -> FoundChild {
        // what rounding left belongs to the last as well
        let target = target.min(self.all.wrapping_sub(u32x8::splat(1)));
        self.halve(|_, middle| !target.lt(middle))
    }
    /// The child of a slot.
    #[inline(always)]
    fn of_slot(&self, slot: u32x8) -> FoundChild {
        self.halve(|bit, _| u32x8::splat(0).lt(slot & u32x8::splat(bit)))
    }
    /// Halves the eight children three times. `is_late(bit, end)` returns whether the child is beyond the first half, which ends at `end`; `bit`
    /// is the bit of the slot that tells the halves apart.
    #[inline(always)]
    fn halve(&self, is_late: impl Fn(u32, u32x8) -> u32x8) -> FoundChild {
        let Self { units, pairs, half, all } = *self;
        let choose = |is_late: u32x8, early: u32x8, late: u32x8| early ^ ((early ^ late) & is_late);
        let (mut slot, mut start) = (u32x8::splat(0), u32x8::splat(0));
        let mut go = |bit: u32, half: u32x8| {
            let is_late = is_late(bit, start.wrapping_add(half));
            slot |= is_late & u32x8::splat(bit);
            start = start.wrapping_add(half & is_late);
            is_late
        };
        let a = go(4, half);
        let b = go(2, choose(a, pairs[0], pairs[2]));
        let early = choose(b, choose(a, units[0], units[4]), choose(a, units[2], units[6]));
        let late = choose(b, choose(a, units[1], units[5]), choose(a, units[3], units[7]));
        let unit = choose(go(1, early), early, late);
        // the last that can contribute
        let is_last = !start.wrapping_add(unit).lt(all);
        let share = choose(is_last, unit, u32x8::splat(WHOLE).wrapping_sub(start));
        FoundChild { slot, start, share: share & u32x8::splat(0).lt(unit) }
    }
}

/// What eight lanes have chosen.
#[derive(Clone, Copy, Default)]
pub(super) struct Chosen {
    pub(super) light: [u32; 8],
    pub(super) pmf: [f32; 8],
    pub(super) word: [u32; 8],
}

/// Chooses in the first `lanes` of eight lanes.
#[inline(always)]
pub(super) fn choose(
    nodes: &[Node8],
    lanes: usize,
    bits: [u32x8; 2],
    (place, gloss): (&TreePoint<[f32; 8]>, Option<&Gloss<[f32; 8]>>),
) -> Chosen {
    let [mut word, mut more] = bits;
    let mut pmf = f32x8::splat(1.0);
    let mut at = [0_u32; 8];
    let mut rows = [f32x8::splat(1.0); 8];
    let mut going = 0xff_u32 >> (8 - lanes);
    for _ in 0..DEEPEST {
        for lane in Lanes(going) {
            rows[lane] = match nodes.get(at[lane] as usize) {
                Some(node) => node.weigh_at(lane, place, gloss),
                None => f32x8::splat(DARK),
            };
        }
        let lanes = MaskOf::from_bits(going);
        let FoundChild { slot, start, share } = Units::of(rows, lanes).find(word.shr(16));
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
    let at = u32x8::from(at);
    let some = f32x8::has_bits(at & u32x8::splat(LIGHT));
    let light = f32x8::blend_uint(some, at & u32x8::splat(!LIGHT), u32x8::splat(NO_LIGHT)).to_array();
    let pmf = pmf.greater(f32x8::splat(f32::MIN_POSITIVE)).keep(some).to_array();
    Chosen { light, pmf, word: word.to_array() }
}

/// The pmfs of lights of the first `lanes` of eight lanes, by the same products.
#[inline(always)]
pub(super) fn pmf(
    nodes: &[Node8],
    places: &[u32],
    lanes: usize,
    lights: [u32; 8],
    (place, gloss): (&TreePoint<[f32; 8]>, Option<&Gloss<[f32; 8]>>),
) -> [f32; 8] {
    let mut paths = [[0; DEEPEST]; 8];
    let (mut levels, mut touched) = ([0_usize; 8], 0);
    for (lane, &light) in lights.iter().enumerate().take(lanes) {
        if let Some(&place) = places.get(light as usize) {
            levels[lane] = climb(nodes, place, &mut paths[lane], |node| touched ^= node.touch());
        }
    }
    core::hint::black_box(touched);
    let is_below = |level: usize| (0..8).map(|lane| u32::from(level < levels[lane]) << lane).sum();
    let mut going: u32 = is_below(0);
    let (mut pmf, mut rows) = (f32x8::splat(1.0).keep(MaskOf::from_bits(going)), [f32x8::splat(1.0); 8]);
    for level in 0..DEEPEST {
        if going == 0 {
            break;
        }
        let mut slots = [0; 8];
        for lane in Lanes(going) {
            let link = paths[lane][(levels[lane] - 1 - level) % DEEPEST];
            slots[lane] = link & 7;
            rows[lane] = match nodes.get((link >> 3) as usize) {
                Some(node) => node.weigh_at(lane, place, gloss),
                None => f32x8::splat(DARK),
            };
        }
        let lanes = MaskOf::from_bits(going);
        let share = Units::of(rows, lanes).of_slot(u32x8::from(slots)).share;
        let some = f32x8::has_bits(share);
        let product = pmf * (f32x8::from_uint(share) * f32x8::splat(1.0 / WHOLE as f32));
        pmf = Real::blend(lanes, product.greater(f32x8::splat(f32::MIN_POSITIVE)).keep(some), pmf);
        going = (lanes & some).bits() & is_below(level + 1);
    }
    pmf.to_array()
}

/// Climbs from the place of a light to the root. Returns the number of nodes, and leaves the way in `path`.
#[inline(always)]
pub(super) fn climb(nodes: &[Node8], place: u32, path: &mut [u32; DEEPEST], mut meet: impl FnMut(&Node8)) -> usize {
    let (mut levels, mut link) = (0, place);
    while levels < DEEPEST {
        path[levels] = link;
        levels += 1;
        let node = nodes.get((link >> 3) as usize);
        if let Some(node) = node {
            meet(node);
        }
        if link >> 3 == 0 {
            break;
        }
        link = node.map_or(0, |node| node.link);
    }
    levels
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

/// As [`node::stretched`] does, for lanes where the share is not 0.
#[inline(always)]
fn stretched(within: u32x8, sixteen: u32x8, share: u32x8) -> u32x8 {
    // 2⁵² and half of it: the sum with a smaller number is rounded to an integer, which is in its low bits
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let [within, sixteen, share] = [within, sixteen, share].map(u32x8::to_array);
    u32x8::from_fn(|i| {
        // 48 bits, which are exact, over at most 2¹⁶: no quotient is nearer than 2⁻¹⁶ to an integer above, and none is rounded by 2⁻²⁰
        let quotient = (f64::from(within[i]) * 65_536.0 + f64::from(sixteen[i])) / f64::from(share[i]);
        ((quotient - (0.5 - 1.0 / 131_072.0)) + ROUND).to_bits() as u32
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In double precision, positions within shares have the bits of the long division.
    #[test]
    fn quotients_are_those_of_integers() {
        let mut state = 1_u32;
        let mut bits = || {
            let (next, sixteen) = node::sixteen(state);
            state = next;
            sixteen
        };
        for round in 0..200_000 {
            let share = match round % 4 {
                0 => 1 + bits() % 16,
                1 => WHOLE - bits() % 16,
                _ => 1 + bits(),
            };
            let whole = u64::from(share) << 16;
            // next to 0, to the end, and to multiples of the share
            let within = match bits() % 4 {
                0 => u64::from(bits() % 4),
                1 => whole - 1 - u64::from(bits() % 4),
                2 => (u64::from(share) * u64::from(bits()) + u64::from(bits() % 3)).saturating_sub(1),
                _ => (u64::from(bits()) << 16 | u64::from(bits())) % whole,
            };
            let within = within.min(whole - 1) as u32;
            for sixteen in [0, 1, 65_535, bits()] {
                let found = stretched(u32x8::splat(within), u32x8::splat(sixteen), u32x8::splat(share));
                assert_eq!(found.lane(3), node::stretched(within, sixteen, share), "{within} {sixteen} {share}");
            }
        }
    }
}
