//! Trees of lights, and the properties of their choices.

mod lamp;
mod regimes;

use crate::packets::{lanes_of, twice, vectors_of};
use etendue::select::{Choice, Gloss, Join, LightBound, LightChoice, LightTree, Node8, TreeAt, TreeChild};
use etendue::{Real, Uint, f32x4, f32x8, f32x16};
pub use lamp::Lamp;
pub use regimes::{Regime, place};

/// The number of levels that the tree may have.
const LEVELS: usize = 64;
/// Units of a node's shares.
const WHOLE: u32 = 1 << 16;

/// A point of a surface and its unit normal.
pub type PointAndNormal = ([f32; 3], [f32; 3]);

/// A tree with its memory.
#[derive(Clone, Debug)]
pub struct Grove {
    /// The lights.
    pub bounds: Vec<LightBound>,
    /// The nodes.
    pub nodes: Vec<Node8>,
    /// The place of each light.
    pub places: Vec<u32>,
}

/// A light that the walk over a tree has reached.
#[derive(Clone, Copy, Debug)]
pub struct Reached {
    /// Its index.
    pub light: u32,
    /// Its probability.
    pub pmf: f64,
    /// The number of nodes above it.
    pub levels: usize,
}

#[cfg(feature = "checks")]
impl Grove {
    /// Builds a tree.
    ///
    /// # Panics
    /// If the memory does not suffice.
    #[must_use]
    pub fn new(bounds: Vec<LightBound>) -> Self {
        Self::with(bounds, &())
    }
    /// Builds a tree on the threads of `join`.
    ///
    /// # Panics
    /// If the memory does not suffice.
    #[must_use]
    pub fn with(bounds: Vec<LightBound>, join: &impl Join) -> Self {
        let mut nodes = vec![Node8::default(); LightTree::nodes_for(bounds.len())];
        let mut places = vec![0; bounds.len()];
        LightTree::build_with(&bounds, &mut nodes, &mut places, join).expect("there is enough memory");
        Self { bounds, nodes, places }
    }
    /// The tree of lamps, as a renderer states them.
    #[must_use]
    pub fn of(lamps: &[Lamp]) -> Self {
        Self::new(lamps.iter().map(Lamp::bound).collect())
    }
    /// The tree.
    #[must_use]
    pub fn tree(&self) -> LightTree<'_> {
        LightTree::from_buffers(&self.nodes, &self.places)
    }
    /// The choice at a place.
    #[must_use]
    pub fn at(&self, (p, n): PointAndNormal) -> TreeAt<'_, f32> {
        self.tree().at(p.into(), n.into())
    }
    /// The pmf of a light at a place.
    #[must_use]
    pub fn pmf(&self, place: PointAndNormal, light: u32) -> f32 {
        self.at(place).pmf(light)
    }

    /// The shares of the node, which sum to the whole, or are all 0.
    fn shares(&self, at: &TreeAt<f32>, node: u32) -> [(u32, TreeChild); 8] {
        let shares = at.shares(0, node);
        let sum: u32 = shares.iter().map(|(units, _)| *units).sum();
        assert!(sum == 0 || sum == WHOLE, "the shares of node {node} sum to {sum}: {shares:?}");
        for (units, child) in shares {
            assert!(units == 0 || child != TreeChild::Nothing, "node {node} has no such child: {shares:?}");
        }
        shares
    }

    /// **Exact**: the probabilities of all lights and of none sum to 1 without any rounding, since the shares of every node do; and each light's
    /// pmf is its own, rounded. Returns the lights that can be chosen, and the probability that none is.
    ///
    /// # Panics
    /// If that is not so.
    #[must_use]
    pub fn exact(&self, place: PointAndNormal) -> (Vec<Reached>, f64) {
        let at = self.at(place);
        let (mut none, mut reached, mut todo) = (0.0, Vec::new(), vec![(0, 1.0, 1)]);
        while let Some((node, mass, levels)) = todo.pop() {
            assert!(levels <= LEVELS, "{levels} levels");
            let shares = self.shares(&at, node);
            if shares.iter().all(|(units, _)| *units == 0) {
                none += mass;
            }
            for (units, child) in shares.into_iter().filter(|(units, _)| *units > 0) {
                let mass = mass * f64::from(units) / f64::from(WHOLE);
                match child {
                    TreeChild::Light(light) => {
                        let pmf = f64::from(at.pmf(light));
                        let least = mass.max(f64::from(f32::MIN_POSITIVE));
                        let rounding = 1e-7 * levels as f64 * least;
                        assert!((pmf - least).abs() <= rounding, "light {light}: pmf {pmf:e}, {mass:e}: {place:?}");
                        reached.push(Reached { light, pmf: mass, levels });
                    }
                    TreeChild::Node(node) => todo.push((node, mass, levels + 1)),
                    TreeChild::Nothing => {}
                }
            }
        }
        let mut lights: Vec<u32> = reached.iter().map(|reached| reached.light).collect();
        lights.sort_unstable();
        assert!(lights.windows(2).all(|two| two[0] < two[1]), "a light has two places");
        // the others have none; of many lights, some are looked at
        let count = self.bounds.len() as u32;
        for light in (0..count).step_by(1 + self.bounds.len() / 2000) {
            let pmf = at.pmf(light);
            assert_eq!(pmf > 0.0, lights.binary_search(&light).is_ok(), "light {light} at {place:?}: pmf {pmf:e}");
        }
        assert_eq!([at.pmf(count), at.pmf(LightTree::NO_LIGHT)], [0.0; 2]);
        (reached, none)
    }

    /// **One pmf** and **lane-identical**: the chosen light's pmf is the one that is evaluated, and every width gives the same bits.
    ///
    /// # Panics
    /// If that is not so.
    pub fn choices(&self, places: &[PointAndNormal; 8], words: &[[u32; 2]; 8], us: &[f32; 8]) {
        let alone = |i: usize| {
            let one = self.at(places[i]);
            [one.choose_by(words[i]), one.choose(us[i])].map(|choice| self.one_choice(places[i], choice))
        };
        let alone = core::array::from_fn(alone);
        self.in_lanes::<f32x4>(places, words, us, &alone);
        self.in_lanes::<f32x8>(places, words, us, &alone);
        self.in_lanes::<f32x16>(places, words, us, &alone);
    }
    /// Whether packets choose what their lanes choose alone, with the same pmf, also evaluated. Sixteen lanes have all [`twice`].
    fn in_lanes<R: Real<Scalar = f32>>(
        &self,
        places: &[PointAndNormal; 8],
        words: &[[u32; 2]; 8],
        us: &[f32; 8],
        alone: &[[Choice<f32>; 2]; 8],
    ) {
        let (all, words, us, alone) = (twice(places), twice(words), twice(us), twice(alone));
        let at = self.tree().at(vectors_of::<R>(|i| all[i].0), vectors_of(|i| all[i].1));
        let by_words = at.choose_by([0, 1].map(|k| R::Uint::from_fn(|i| words[i][k])));
        for (k, choice) in [by_words, at.choose(lanes_of(|i| us[i].into()))].iter().enumerate() {
            let evaluated = at.pmf(choice.index);
            for (i, alone) in alone.iter().enumerate().take(R::LANES) {
                let one = &alone[k];
                assert_eq!(figures(one, 0), figures(choice, i), "lane {i} of {} at {places:?}", R::LANES);
                assert_eq!(evaluated.lane(i).to_bits(), one.pmf.to_bits(), "lane {i} of {} at {places:?}", R::LANES);
            }
        }
    }
    fn one_choice(&self, place: PointAndNormal, choice: Choice<f32>) -> Choice<f32> {
        let Choice { index, pmf, u } = choice;
        let evaluated = self.pmf(place, index);
        assert_eq!(evaluated.to_bits(), pmf.to_bits(), "two pmfs: {choice:?} {evaluated:e} at {place:?}");
        assert!((0.0..1.0).contains(&u) && (0.0..=1.0).contains(&pmf), "{choice:?} at {place:?}");
        assert_eq!(pmf == 0.0, index == LightTree::NO_LIGHT, "{choice:?} at {place:?}");
        assert!(index == LightTree::NO_LIGHT || (index as usize) < self.bounds.len(), "{choice:?} at {place:?}");
        choice
    }

    /// **Gloss loses no light**: with it, the same lights have a pmf as without, and the pmf of a choice is the one that is evaluated.
    ///
    /// # Panics
    /// If that is not so.
    pub fn glossy(&self, place: PointAndNormal, gloss: &Gloss<f32>, u: f32) {
        let (matt, glossy) = (self.at(place), self.tree().at_glossy(place.0.into(), place.1.into(), gloss));
        let count = self.bounds.len() as u32;
        for light in (0..count).step_by(1 + self.bounds.len() / 100) {
            let (without, with) = (matt.pmf(light), glossy.pmf(light));
            assert_eq!(without > 0.0, with > 0.0, "light {light} at {place:?}: {without:e}, {with:e} with {gloss:?}");
        }
        let choice = glossy.choose(u);
        let Choice { index, pmf, u } = choice;
        assert_eq!(glossy.pmf(index).to_bits(), pmf.to_bits(), "two pmfs: {choice:?} at {place:?} with {gloss:?}");
        assert!((0.0..1.0).contains(&u) && (0.0..=1.0).contains(&pmf), "{choice:?} at {place:?} with {gloss:?}");
        assert_eq!(pmf == 0.0, index == LightTree::NO_LIGHT, "{choice:?} at {place:?} with {gloss:?}");
    }

    /// **No light is lost**: a light with a sample that contributes has a pmf. Returns whether this one has.
    ///
    /// # Panics
    /// If it has a sample, but no pmf.
    pub fn law(&self, (p, n): PointAndNormal, light: usize, lamp: &Lamp, u: [f32; 2]) -> bool {
        let power = self.bounds[light].power;
        if !(power > 0.0 && power < f32::INFINITY) {
            return false;
        }
        let Some(sample) = lamp.contribution(p, n, u) else { return false };
        // a projected light of less than 1e-15 of its distance has no digits: its sample may point anywhere
        let LightBound { center, radius, .. } = self.bounds[light];
        let [x, y, z] = [sample.direction.x, sample.direction.y, sample.direction.z].map(f64::from);
        let distance = f64::from(sample.distance);
        let off = |k: usize, w: f64| f64::from(p[k]) + distance * w - f64::from(center[k]);
        let missed = [off(0, x), off(1, y), off(2, z)].iter().map(|x| x * x).sum::<f64>().sqrt();
        if missed > f64::from(radius) + 0.01 * distance {
            return false;
        }
        let pmf = self.pmf((p, n), light as u32);
        assert!(pmf > 0.0, "light {light} is lost at {p:?} over {n:?}: {lamp:?}, {:?}, {sample:?}", self.bounds[light]);
        true
    }

    /// The same tree adapted to lights that have moved.
    ///
    /// # Panics
    /// If the number of lights differs.
    #[must_use]
    pub fn refitted(&self, bounds: Vec<LightBound>) -> Self {
        let mut nodes = self.nodes.clone();
        LightTree::refit(&bounds, &mut nodes, &self.places).expect("as many lights as before");
        Self { bounds, nodes, places: self.places.clone() }
    }

    /// **Threshold-free**: lengths times a power of two change no bit.
    ///
    /// # Panics
    /// If they do.
    pub fn scale(&self, places: &[PointAndNormal], words: &[[u32; 2]], exponent: i32) {
        let factor = 2.0_f32.powi(exponent);
        let bound =
            |l: &LightBound| LightBound { center: l.center.map(|x| x * factor), radius: l.radius * factor, ..*l };
        let other = Self::new(self.bounds.iter().map(bound).collect());
        for (&(p, n), &words) in places.iter().zip(words) {
            let one = self.at((p, n)).choose_by(words);
            let scaled = other.at((p.map(|x| x * factor), n)).choose_by(words);
            assert_eq!(figures(&one, 0), figures(&scaled, 0), "2^{exponent}, at {p:?} over {n:?}: {one:?}, {scaled:?}");
        }
    }
}

/// The bits of a lane of a choice.
pub fn figures<R: Real>(choice: &Choice<R>, lane: usize) -> (u32, u64, u64) {
    let [pmf, u] = [choice.pmf, choice.u].map(|x| x.lane_f64(lane).to_bits());
    (choice.index.lane(lane), pmf, u)
}
