//! The choice of a tree from words in memory.

use super::node::{self, CHILD, Children, LEAST, LIGHT, LINK, Node8, TreePoint, WHOLE};
use super::{DEEPEST, NO_LIGHT};
use crate::memory::Memory;
use crate::real::{GREATEST, Mask, Real, State, Uint};
use crate::select::{Choice, LightChoice};
use crate::vector::Vec3;

/// A [`LightTree`](super::LightTree) as words in [memory](crate::memory): what a choice reads where number types write sources.
///
/// Of single precision, choices and pmfs have the bits of the tree. On a processor the tree itself is the faster one.
///
/// - Domain: the tree's; the memory has the words of its nodes one after another, and those of its places.
/// - Degenerate: any other contents give any choice; a choice goes down at most 64 levels.
///
/// ```
/// use etendue::select::{LightBound, LightChoice, LightTree, Node8, TreeWords};
/// let lamp = |x: usize| LightBound { center: [x as f32, 0.0, 3.0], radius: 0.1, power: 1.0, ..LightBound::default() };
/// let lamps: Vec<_> = (0..100).map(lamp).collect();
/// let (mut nodes, mut places) = (vec![Node8::default(); LightTree::nodes_for(100)], vec![0; 100]);
/// LightTree::build(&lamps, &mut nodes, &mut places)?;
/// let words: Vec<u32> = places.iter().copied().chain(nodes.iter().flat_map(Node8::words)).collect();
/// let tree = TreeWords { memory: &words[..], nodes: 100, places: 0, count: 100 };
/// let (p, n) = ([50.0_f32, 0.0, 0.0].into(), [0.0, 0.0, 1.0].into());
/// let choice = tree.at(p, n).choose(0.7);
/// let same = LightTree::from_buffers(&nodes, &places).at(p, n).choose(0.7);
/// assert_eq!((choice.index, choice.pmf, choice.u), (same.index, same.pmf, same.u));
/// # Ok::<(), etendue::select::LightsError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct TreeWords<M, U> {
    /// The memory.
    pub memory: M,
    /// Index of the first word of the nodes: see [`Node8::words`].
    pub nodes: U,
    /// Index of the first of the places, which are one word for each light.
    pub places: U,
    /// Number of lights.
    pub count: U,
}

impl<M, U: Uint> TreeWords<M, U> {
    /// The choice for points `p` of surfaces with unit normals `n`, on the side of `n`.
    #[inline]
    pub fn at<R: Real<Uint = U>>(&self, p: Vec3<R>, n: Vec3<R>) -> TreeWordsAt<R, M>
    where
        M: Memory<R>,
    {
        let scale = self.memory.number(self.nodes.wrapping_add(U::splat(LINK)));
        TreeWordsAt { tree: *self, place: TreePoint::new(node::scaled(p, scale), n) }
    }
}

/// The choice of [`TreeWords`] at a shading point.
#[derive(Clone, Copy, Debug)]
pub struct TreeWordsAt<R: Real, M> {
    tree: TreeWords<M, R::Uint>,
    place: TreePoint<R>,
}

impl<R: Real, M: Memory<R>> TreeWordsAt<R, M> {
    /// Index of a word of a node.
    #[inline(always)]
    fn at(&self, node: R::Uint, word: u32) -> R::Uint {
        let first = node.wrapping_mul(R::Uint::splat(Node8::WORDS as u32)).wrapping_add(self.tree.nodes);
        first.wrapping_add(R::Uint::splat(word))
    }
    /// The child of a node in a slot.
    #[inline(always)]
    fn child(&self, node: R::Uint, slot: R::Uint) -> R::Uint {
        self.tree.memory.word(self.at(node, CHILD).wrapping_add(slot))
    }

    /// What each child of a node receives, as [`Shares`](node::Shares) has it.
    #[inline(always)]
    fn units(&self, node: R::Uint) -> [R::Uint; 8] {
        let word = R::Uint::splat;
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let first = self.at(node, 0);
        let step = |(weights, [slot, bit, bright]): State<R, 8, 3>, going: [R::Mask; 1]| {
            let child = Children::read(&self.tree.memory, first.wrapping_add(slot));
            // what a node of plain lights leaves out changes no bit
            let (weight, contributes) = child.weigh(false, &self.place, None);
            let weights = core::array::from_fn(|k| {
                let is_other = R::has_bits(slot ^ word(k as u32));
                R::blend(is_other, weights[k], weight.keep(contributes))
            });
            let bright = bright | R::blend_uint(contributes, bit, word(0));
            ((weights, [slot.wrapping_add(word(1)), bit.shl(1), bright]), going)
        };
        let start = ([zero; 8], [word(0), word(1), word(0)]);
        let (weights, [.., bright]) = R::iterate_with_words(8, start, [R::Mask::splat(true)], step);
        let contributes = |k: usize| R::has_bits(bright & word(1 << k));

        let sum = |w: [R; 8]| ((w[0] + w[1]) + (w[2] + w[3])) + ((w[4] + w[5]) + (w[6] + w[7]));
        let total = sum(weights);
        let usual = total.ge(R::lit(f64::from(LEAST))) & total.le(R::lit(GREATEST));
        let same: [R; 8] = core::array::from_fn(|k| one.keep(contributes(k)));
        let total = R::blend(usual, total, sum(same).greater(one));
        let scale = R::lit(f64::from(WHOLE - 8)) / total;
        core::array::from_fn(|k| {
            let unit = (R::blend(usual, weights[k], same[k]) * scale).to_uint().wrapping_add(word(1));
            // what rounding left goes to the last
            let has_later = R::has_bits(bright.shr(1).shr(k as u32));
            R::blend_uint(contributes(k), R::blend_uint(has_later, unit, word(WHOLE)), word(0))
        })
    }
    /// The lesser of a number of units and of what is left of all of them.
    #[inline(always)]
    fn at_most(units: R::Uint, before: R::Uint) -> R::Uint {
        let left = R::Uint::splat(WHOLE).wrapping_sub(before);
        R::blend_uint(R::has_bits(units.lt(left)), units, left)
    }

    /// Chooses by 64 random bits a lane, as [`TreeAt::choose_by`](super::TreeAt::choose_by) does.
    #[inline]
    pub fn choose_by(&self, [word, more]: [R::Uint; 2]) -> Choice<R> {
        let splat = R::Uint::splat;
        let step = |([pmf], [word, more, node, light]): State<R, 1, 4>, [going]: [R::Mask; 1]| {
            let units = self.units(node);
            let target = word.shr(16);
            // the first child whose units end above the target
            let (mut end, mut slot, mut start) = (splat(0), splat(0), splat(0));
            let mut own = units[7];
            let mut passed = [R::Mask::splat(false); 8];
            for k in 0..8 {
                end = end.wrapping_add(units[k]);
                passed[k] = !R::has_bits(target.lt(end));
                slot = slot.wrapping_add(R::blend_uint(passed[k], splat(1), splat(0)));
                start = R::blend_uint(passed[k], end, start);
            }
            for k in (0..7).rev() {
                own = R::blend_uint(passed[k], own, units[k]);
            }
            let share = Self::at_most(own, start);
            let going = going & R::has_bits(share);
            let (next, sixteen) = node::sixteen(more);
            let stretched = node::stretched(word.wrapping_sub(start.shl(16)), sixteen, share);
            let child = self.child(node, slot);
            let is_light = R::has_bits(child & splat(LIGHT));
            let pmf = R::blend(going, pmf * (R::from_uint(share) * R::lit(1.0 / f64::from(WHOLE))), pmf);
            let keep = |new: R::Uint, old: R::Uint| R::blend_uint(going, new, old);
            let light = R::blend_uint(going & is_light, child & splat(!LIGHT), light);
            (([pmf], [keep(stretched, word), keep(next, more), keep(child, node), light]), [going & !is_light])
        };
        let start = ([R::lit(1.0)], [word, more, splat(0), splat(NO_LIGHT)]);
        let going = [R::Mask::splat(true)];
        let ([pmf], [word, _, _, light]) = R::iterate_with_words(DEEPEST, start, going, step);
        let some = R::has_bits(light ^ splat(NO_LIGHT));
        Choice { index: light, pmf: pmf.greater(R::lit(f64::from(f32::MIN_POSITIVE))).keep(some), u: R::unit(word) }
    }
}

impl<R: Real, M: Memory<R>> LightChoice<R> for TreeWordsAt<R, M> {
    /// As [`TreeAt`](super::TreeAt) chooses.
    #[inline]
    fn choose(&self, u: R) -> Choice<R> {
        self.choose_by(node::bits_of(u))
    }
    /// The same products, from the root down: the way to the light is found anew from each node, by the links upwards.
    #[inline]
    fn pmf(&self, index: R::Uint) -> R {
        let splat = R::Uint::splat;
        let TreeWords { memory, places, count, .. } = self.tree;
        let is_some = R::has_bits(index.lt(count));
        let place = memory.word(places.wrapping_add(index));
        let lost = R::lit(-1.0);
        let step = |([pmf], [node]): State<R, 1, 1>, [going]: [R::Mask; 1]| {
            let is_below = |link: R::Uint| R::has_bits(link.shr(3) ^ node);
            let climb = |([], [link]): State<R, 0, 1>, [more]: [R::Mask; 1]| {
                let link = R::blend_uint(more, memory.word(self.at(link.shr(3), LINK)), link);
                (([], [link]), [more & is_below(link)])
            };
            let ([], [link]) = R::iterate_with_words(DEEPEST, ([], [place]), [going & is_below(place)], climb);
            let slot = link & splat(7);
            let units = self.units(node);
            let (mut own, mut before) = (units[0], splat(0));
            for k in 1..8 {
                let reaches = R::has_bits(splat(k - 1).lt(slot));
                before = before.wrapping_add(R::blend_uint(reaches, units[k as usize - 1], splat(0)));
                own = R::blend_uint(R::has_bits(slot ^ splat(k)), own, units[k as usize]);
            }
            let share = Self::at_most(own, before);
            let some = R::has_bits(share);
            let product = pmf * (R::from_uint(share) * R::lit(1.0 / f64::from(WHOLE)));
            let pmf = R::blend(going, R::blend(some, product, lost), pmf);
            let node = R::blend_uint(going, self.child(node, slot), node);
            (([pmf], [node]), [going & some & R::has_bits(link ^ place)])
        };
        let ([pmf], _) = R::iterate_with_words(DEEPEST, ([R::lit(1.0)], [splat(0)]), [is_some], step);
        pmf.greater(R::lit(f64::from(f32::MIN_POSITIVE))).keep(is_some & pmf.ge(R::lit(0.0)))
    }
}
