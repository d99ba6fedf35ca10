//! Choice among any number of lights by a tree.

mod build;
mod eight;
mod node;
mod part;

use super::{Choice, Gloss, LightBound, LightChoice, LightsError};
use crate::real::{MOST_LANES, Real, Uint};
use crate::vector::Vec3;
pub use build::Join;
use build::{Build, nodes_for};
use eight::Chosen;
pub use node::Node8;
use node::{LIGHT, NONE, Shares, TreePoint, WHOLE};
use part::{Part, Units};

/// See [`LightTree::NO_LIGHT`].
const NO_LIGHT: u32 = u32::MAX;

/// More than the number of levels of 2²⁷ lights: seven splits, each of which leaves at most 15/16, leave a child at most 0.64 of a node.
const DEEPEST: usize = 64;

/// Chooses among any number of lights by what they can contribute to a point of a surface, in a tree of eight children a node.
///
/// The tree lives in the caller's memory and needs about 58 bytes a light. [`build`](Self::build) makes it, [`refit`](Self::refit) adapts it
/// to lights that have moved, and [`at`](Self::at) prepares a choice for the shading point of each lane. Directional lights, suns and
/// environments have no place in it: choose between them and the tree by [`LightsAt::by_weights`](super::LightsAt::by_weights) and what each
/// can contribute at the point, which for the tree is its [`irradiance`](TreeAt::irradiance). The power of a sky, which grows with the scene
/// that it lights, would hide every lamp.
///
/// - Formula: at each node, a child has the weight I · M · (cosθ cosθ' + B/32). I is the intensity along its normals, from its power. M is
///   the mean of 1/d² over the positions of its lights to the second order, 1/(d² + Σσₖ² − 4Σσₖ²vₖ²/d²), where v is the vector to their
///   mean position, d its length, and σₖ are the standard deviations along the axes; the denominator is at least (d² + Σσₖ²)/4. The cosine
///   at the surface is the mean of the positive part of a normal variable, nearly (μ + √(μ² + 2σ²/π))/2, with the mean and the variance
///   of the lights' heights above the surface. The cosine at the lights is the same, with the covariances of their normals. B is the
///   product of upper bounds of the two cosines, from a box around the positions, a ball around the normals, and the widest cone of spot
///   lights.
/// - Exact probabilities: the weights are rounded to shares, integers that sum to 2¹⁶ at each node. Each child whose bound B is positive
///   has a share, no other child has any. A child is drawn by sixteen bits, exactly as often as its share says, and the pmf is the
///   product of the shares.
/// - No light is lost: where a sample of a light contributes, B is positive at all nodes above it, in spite of all rounding, so its pmf is
///   positive.
/// - Dead ends: where all children of a node have no share, the outcome is "no light", with its own probability; then the index is
///   [`NO_LIGHT`](Self::NO_LIGHT) and the pmf is 0. The pmfs of all lights and the probability of "no light" sum to 1.
/// - Domain: up to [`MOST`](Self::MOST) lights; finite bounds, points and unit normals. A light whose power is 0, negative, infinite or
///   NaN, or whose place is not finite, is never chosen. Multiplying all lengths by a power of two changes no bit. Powers count as at
///   least 2⁻⁴⁰ of the strongest, radii as at least 2⁻³⁰ of the extent of the lights.
/// - Degenerate: without lights, or where none can contribute, the pmf is 0.
/// - Precision: the pmf is rounded once a level, by 2⁻²⁴ of itself.
/// - Source: the tree and its bounds of cosines after Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree
///   Splitting", HPG 2018; the weights are derived here.
///
/// ```
/// use etendue::select::{LightBound, LightChoice, LightTree, Node8};
/// let lamp = |x: usize| LightBound { center: [x as f32, 0.0, 3.0], radius: 0.1, power: 1.0, ..LightBound::default() };
/// let lamps: Vec<_> = (0..1000).map(lamp).collect();
/// let mut nodes = vec![Node8::default(); LightTree::nodes_for(lamps.len())];
/// let mut places = vec![0; lamps.len()];
/// let tree = LightTree::build(&lamps, &mut nodes, &mut places)?;
/// let at = tree.at::<f32>([500.0, 0.0, 0.0].into(), [0.0, 0.0, 1.0].into());
/// let choice = at.choose_by([0x8000_0000, 1]);
/// assert!((400..600).contains(&choice.index) && choice.pmf == at.pmf(choice.index));
/// # Ok::<(), etendue::select::LightsError>(())
/// ```
#[doc(alias = "light BVH")]
#[derive(Clone, Copy, Debug)]
pub struct LightTree<'a> {
    nodes: &'a [Node8],
    /// 8 · node + slot of each light.
    places: &'a [u32],
}

impl<'a> LightTree<'a> {
    /// The greatest number of lights.
    pub const MOST: usize = 1 << 27;
    /// The index of a [`Choice`] where no light can contribute.
    pub const NO_LIGHT: u32 = NO_LIGHT;

    /// Number of nodes that so many lights need.
    #[must_use]
    pub const fn nodes_for(count: usize) -> usize {
        nodes_for(count)
    }

    /// Builds a tree in the caller's memory: at least [`nodes_for`](Self::nodes_for) nodes, and a word for each light.
    ///
    /// A range of lights is split where the sum of power · squared extent · (3 − 2·squared mean normal) is least, in sixteen bins along
    /// the widest axes of positions and of normals, until a node has eight children. The lowest nodes are full.
    ///
    /// # Errors
    /// If the nodes are too few, the lengths of `lights` and `places` differ, or there are more than [`MOST`](Self::MOST) lights.
    pub fn build(lights: &[LightBound], nodes: &'a mut [Node8], places: &'a mut [u32]) -> Result<Self, LightsError> {
        Self::build_with(lights, nodes, places, &())
    }

    /// Like [`build`](Self::build), on the threads of `join`. The tree is the same.
    ///
    /// # Errors
    /// Those of [`build`](Self::build).
    pub fn build_with(
        lights: &[LightBound],
        nodes: &'a mut [Node8],
        places: &'a mut [u32],
        join: &impl Join,
    ) -> Result<Self, LightsError> {
        let count = lights.len();
        if count > Self::MOST {
            return Err(LightsError::TooMany);
        }
        if count != places.len() || nodes.len() < nodes_for(count) {
            return Err(LightsError::Length);
        }
        for (place, light) in places.iter_mut().zip(0..) {
            *place = light;
        }
        let units = Units::of(lights);
        let nodes = &mut nodes[..nodes_for(count)];
        nodes.fill(Node8::default());
        Build { lights, units, join }.range(places, nodes, 0, units.length.to_bits());
        for (index, node) in (0_u32..).zip(&*nodes) {
            for (slot, &child) in (0..).zip(&node.child) {
                if child != NONE && child & LIGHT != 0 {
                    places[(child & !LIGHT) as usize] = index << 3 | slot;
                }
            }
        }
        Ok(Self { nodes, places })
    }

    /// The tree that [`build`](Self::build) has left in this memory.
    #[must_use]
    pub const fn from_buffers(nodes: &'a [Node8], places: &'a [u32]) -> Self {
        Self { nodes, places }
    }

    /// Adapts a tree to lights that have moved or changed, from the leaves up. The same lights stay together, so the choice stays exact but
    /// becomes less good as neighbours part.
    ///
    /// # Errors
    /// If the number of lights is not that of the tree, or the memory does not hold a tree of so many.
    pub fn refit(lights: &[LightBound], nodes: &mut [Node8], places: &[u32]) -> Result<(), LightsError> {
        if lights.len() != places.len() || nodes.len() < nodes_for(lights.len()) {
            return Err(LightsError::Length);
        }
        // what is beyond may be left of a larger tree
        let nodes = &mut nodes[..nodes_for(lights.len())];
        let units = Units::of(lights);
        for index in (0..nodes.len()).rev() {
            nodes[index].forget_kinds();
            for slot in 0..8 {
                let part = match nodes[index].child[slot] {
                    NONE => continue,
                    light if light & LIGHT != 0 => {
                        let light = lights.get((light & !LIGHT) as usize).ok_or(LightsError::Length)?;
                        Part::light(light, units)
                    }
                    node => nodes.get(node as usize).ok_or(LightsError::Length)?.union(),
                };
                let child = nodes[index].child[slot];
                nodes[index].set(slot, child, &part);
            }
        }
        if let Some(root) = nodes.first_mut() {
            root.link = units.length.to_bits();
        }
        Ok(())
    }

    /// Number of lights.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.places.len()
    }
    /// Whether there is no light.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// The choice for points `p` of surfaces with unit normals `n`, on the side of `n`. Where `n` is 0, as in fog, all cosines at the point are 1.
    #[inline]
    #[must_use]
    pub fn at<R: Real>(&self, p: Vec3<R>, n: Vec3<R>) -> TreeAt<'a, R> {
        let scale = self.nodes.first().map_or(1.0, |root| f32::from_bits(root.link));
        TreeAt { tree: *self, p: node::scaled(p, R::lit(f64::from(scale))), n, gloss: None }
    }
    /// The same for glossy surfaces, by what they reflect towards the viewer.
    #[inline]
    #[must_use]
    pub fn at_glossy<R: Real>(&self, p: Vec3<R>, n: Vec3<R>, gloss: &Gloss<R>) -> TreeAt<'a, R> {
        TreeAt { gloss: Some(*gloss), ..self.at(p, n) }
    }
}

/// The choice of a [`LightTree`] at the shading point of each lane.
#[derive(Clone, Copy, Debug)]
pub struct TreeAt<'a, R: Real> {
    tree: LightTree<'a>,
    p: Vec3<R>,
    n: Vec3<R>,
    gloss: Option<Gloss<R>>,
}

impl<'a, R: Real> TreeAt<'a, R> {
    /// The gloss of a lane, if there is any.
    #[inline(always)]
    fn gloss(&self, lane: usize) -> Option<Gloss<f32>> {
        self.gloss.map(|gloss| gloss.map(|x| x.lane_f64(lane) as f32))
    }
    #[inline(always)]
    fn place(&self, lane: usize) -> TreePoint<f32> {
        let [p, n] = [self.p, self.n].map(|v| {
            let [x, y, z] = [v.x, v.y, v.z].map(|x| x.lane_f64(lane) as f32);
            Vec3::new(x, y, z)
        });
        TreePoint::new(p, n)
    }

    /// Chooses by 64 random bits a lane.
    ///
    /// The first word decides, from its high bits down: well distributed words give well distributed lights, which are in spatial
    /// order. The tree stretches what is left of it by sixteen bits a level, which a generator makes from the second word; so 10⁷ lights
    /// keep all digits. `u` of the choice is what is left in the end.
    #[inline]
    #[must_use]
    pub fn choose_by(&self, bits: [R::Uint; 2]) -> Choice<R> {
        // compiled twice: without gloss, nothing asks for it
        match &self.gloss {
            None => self.descend(bits, None),
            Some(gloss) => self.descend(bits, Some(gloss)),
        }
    }
    /// Chooses by the 24 bits of `u`, and by those of `second` for the digits below, hashed with the first ones, so that it may be any
    /// number where there is no second one. Where there is no light, the index is 0.
    #[inline]
    #[must_use]
    pub fn choose_with(&self, u: R, second: R) -> Choice<R> {
        let [high, low] = [u, second].map(|u| (u * R::lit(16_777_216.0)).to_uint());
        let low = (low ^ high.wrapping_mul(R::Uint::splat(0x9e37_79b9))).wrapping_mul(R::Uint::splat(0x85eb_ca6b));
        let choice = self.choose_by([high.shl(8) | low.shr(24), low]);
        let some = choice.pmf.gt(R::lit(0.0));
        Choice { index: R::blend_uint(some, choice.index, R::Uint::splat(0)), ..choice }
    }
    #[inline(always)]
    fn descend(&self, bits: [R::Uint; 2], gloss: Option<&Gloss<R>>) -> Choice<R> {
        const { assert!(R::LANES <= MOST_LANES) };
        let mut chosen = [Chosen::default(); MOST_LANES / 8];
        let nodes = self.tree.nodes;
        if R::LANES == 1 {
            let [word, more] = bits.map(|bits| bits.lane(0));
            let mut lane = Descent { word, more, node: 0, pmf: 1.0, light: NO_LIGHT };
            let (place, gloss) = (self.place(0), gloss.and_then(|_| self.gloss(0)));
            for _ in 0..DEEPEST {
                let Some(node) = nodes.get(lane.node as usize) else { break };
                lane.step(node, &node.shares(&place, gloss.as_ref()));
            }
            let pmf = if lane.light == NO_LIGHT { 0.0 } else { lane.pmf.greater(f32::MIN_POSITIVE) };
            chosen[0] = Chosen { light: [lane.light; 8], pmf: [pmf; 8], word: [lane.word; 8] };
        } else {
            for (chosen, first) in chosen.iter_mut().zip((0..R::LANES).step_by(8)) {
                let (place, gloss) = self.eight(gloss, first);
                let (lanes, bits) = ((R::LANES - first).min(8), bits.map(|bits| eight::words_of::<R>(bits, first)));
                *chosen = eight::choose(nodes, lanes, bits, (&place, gloss.as_ref()));
            }
        }
        let pmf = |lane: usize| chosen[lane / 8].pmf[lane % 8];
        Choice {
            index: R::Uint::from_fn(|lane| chosen[lane / 8].light[lane % 8]),
            pmf: R::from_fn(|lane| R::Scalar::lit(f64::from(pmf(lane)))),
            u: R::unit(R::Uint::from_fn(|lane| chosen[lane / 8].word[lane % 8])),
        }
    }
    #[inline(always)]
    fn pmfs(&self, index: R::Uint, gloss: Option<&Gloss<R>>) -> [[f32; 8]; MOST_LANES / 8] {
        let LightTree { nodes, places } = self.tree;
        const { assert!(R::LANES <= MOST_LANES) };
        let mut pmfs = [[0.0; 8]; MOST_LANES / 8];
        if R::LANES == 1 {
            let gloss = gloss.and_then(|_| self.gloss(0));
            pmfs[0][0] = self.tree.pmf(&self.place(0), gloss.as_ref(), index.lane(0));
        } else {
            for (pmfs, first) in pmfs.iter_mut().zip((0..R::LANES).step_by(8)) {
                let (place, gloss) = self.eight(gloss, first);
                let lights = eight::words_of::<R>(index, first).to_array();
                *pmfs = eight::pmf(nodes, places, (R::LANES - first).min(8), lights, (&place, gloss.as_ref()));
            }
        }
        pmfs
    }
    /// The places of eight lanes from `first` on, and what their surfaces reflect.
    #[inline(always)]
    fn eight(&self, gloss: Option<&Gloss<R>>, first: usize) -> (TreePoint<[f32; 8]>, Option<Gloss<[f32; 8]>>) {
        let of = |x: R| eight::of(x, first);
        let place = TreePoint::new(self.p.map(of), self.n.map(of)).map(|x| x.to_array());
        (place, gloss.map(|gloss| gloss.map(|x| of(x).to_array())))
    }

    /// An estimate of the irradiance that all lights together would cause if nothing hid them, by which a choice between the tree and lights
    /// that are infinitely far away can be made. `strongest` is the greatest finite power of the lights that were given, as the flux of a light.
    /// On glossy surfaces, the estimate is the radiant exitance. It is 0 only where no light can contribute.
    ///
    /// - Formula: Σ I · M · (cosθ cosθ' + B/32) over the children of the root, as in [`LightTree`].
    /// - Units: flux over squared length.
    /// - Degenerate: without lights it is 0. It is finite where the quotient of strongest power and squared extent is at most 10²⁰.
    /// - Error: beside lights that are far away for the extent of them all, and where cosines are at least 0.3, it is 0.98 to 1.17 times the
    ///   irradiance. Nearer ones count by their mean cosines and distances.
    #[inline]
    #[must_use]
    pub fn irradiance(&self, strongest: f32) -> R {
        let Some(root) = self.tree.nodes.first() else { return R::lit(0.0) };
        let length = f64::from(f32::from_bits(root.link));
        // lengths are multiplied by one power of two, powers by the other; the weights are four times the irradiance
        let power = if strongest > 0.0 && strongest < f32::INFINITY { f64::from(strongest.pow2_scale()) } else { 1.0 };
        let unit = 0.25 * length * length / power;
        R::from_fn(|lane| {
            let sum = root.sum(&self.place(lane), self.gloss(lane).as_ref());
            R::Scalar::lit((f64::from(sum) * unit).greater(f64::from(f32::MIN_POSITIVE)).keep(sum > 0.0))
        })
    }

    /// The share of each child of a node at the point of a lane, in units of 2⁻¹⁶, and the children. Node 0 is the root. Renderers do
    /// not need this; it shows the whole distribution.
    pub fn shares(&self, lane: usize, node: u32) -> [(u32, TreeChild); 8] {
        let place = self.place(lane);
        let Some(node) = self.tree.nodes.get(node as usize) else { return [(0, TreeChild::Nothing); 8] };
        let shares = node.shares(&place, self.gloss(lane).as_ref());
        core::array::from_fn(|slot| {
            let child = match node.child[slot] {
                NONE => TreeChild::Nothing,
                child if child & LIGHT != 0 => TreeChild::Light(child & !LIGHT),
                child => TreeChild::Node(child),
            };
            (shares.of(slot), child)
        })
    }
}

/// A lane on its way from the root to a light.
struct Descent {
    word: u32,
    more: u32,
    /// [`NONE`] at the end.
    node: u32,
    pmf: f32,
    light: u32,
}

impl Descent {
    /// Goes to a child of its node, or to a light.
    #[inline(always)]
    fn step(&mut self, node: &Node8, shares: &Shares) {
        let (slot, start, share) = shares.find(self.word >> 16);
        if share == 0 {
            self.node = NONE;
            return;
        }
        let (more, sixteen) = node::sixteen(self.more);
        self.more = more;
        self.word = node::stretched(self.word - (start << 16), sixteen, share);
        self.pmf *= share as f32 * (1.0 / WHOLE as f32);
        let child = node.child[slot];
        if child & LIGHT == 0 {
            self.node = child;
        } else {
            (self.light, self.node) = (child & !LIGHT, NONE);
        }
    }
}

/// A child of a node of a [`LightTree`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeChild {
    /// The node has fewer children.
    Nothing,
    /// The node of this index.
    Node(u32),
    /// The light of this index.
    Light(u32),
}

impl LightTree<'_> {
    /// The pmf of a light, by the same products.
    #[inline]
    fn pmf(&self, at: &TreePoint<f32>, gloss: Option<&Gloss<f32>>, light: u32) -> f32 {
        let Some(&place) = self.places.get(light as usize) else { return 0.0 };
        let mut path = [0; DEEPEST];
        let levels = eight::climb(self.nodes, place, &mut path, |_| ());
        let mut pmf = 1.0_f32;
        for &link in path[..levels].iter().rev() {
            let Some(node) = self.nodes.get((link >> 3) as usize) else { return 0.0 };
            let share = node.shares(at, gloss).of((link & 7) as usize);
            if share == 0 {
                return 0.0;
            }
            pmf *= share as f32 * (1.0 / WHOLE as f32);
        }
        pmf.greater(f32::MIN_POSITIVE)
    }
}

impl<R: Real> LightChoice<R> for TreeAt<'_, R> {
    /// Chooses by the 24 bits of `u`, and a hash of them for the digits below.
    #[inline]
    fn choose(&self, u: R) -> Choice<R> {
        self.choose_by(node::bits_of(u))
    }
    #[inline]
    fn pmf(&self, index: R::Uint) -> R {
        let pmfs = match &self.gloss {
            None => self.pmfs(index, None),
            Some(gloss) => self.pmfs(index, Some(gloss)),
        };
        R::from_fn(|lane| R::Scalar::lit(f64::from(pmfs[lane / 8][lane % 8])))
    }
}
