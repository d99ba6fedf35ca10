//! What `auto` takes: the most efficient of a few ways to sample, as a trial on scattered tiles of the image finds it.
//!
//! Each way renders each tile in two independent sets of samples. Half of the squared differences of both tell its variance, and counts of what
//! it did tell its cost, so that nothing depends on clocks or threads. The samples of the trial are no part of the image, whose mean is right
//! whatever was found.
//!
//! A way that misses some light looks exact, so each is compared with that of the rule, too, which misses none: the squared
//! difference of their images is the sum of their variances. What is taken instead of it must be better whichever tile is left out.

use super::pixel_counts::{SamplePlan, shares};
use super::pixel_statistics::fall;
use crate::bvh::RayCount;
use crate::choose::ChoiceBy;
use crate::film::Pixel;
use crate::sampler::{Sampler, hash64};
use crate::scene::area::{self, Area, TILE};
use crate::settings::{Settings, tiles};
use crate::technique::Technique;

/// How lights are sampled and chosen.
pub type TechniqueChoice = (Technique, ChoiceBy);

/// What a trial has found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AutoTrial {
    /// Whether the rule was kept.
    pub is_rule: bool,
    /// The best of the ways that were not taken.
    pub over: TechniqueChoice,
    /// How many times as efficient as that is what was taken: the inverse ratio of variance × cost.
    pub times: f64,
    /// Number of tiles in which both were tried.
    pub tiles: usize,
    /// The samples of the trial relative to those of the image.
    pub part: f64,
}

/// The greatest samples of a trial relative to those of the image.
const PART: f64 = 0.03;
/// Samples per pixel of each set.
const SPP: [u32; 3] = [8, 16, 32];
/// Numbers of tiles after which is decided which ways are worth more.
const STAGES: [usize; 3] = [4, 8, 16];
/// Nothing is taken instead of the rule by fewer tiles, in which most of what makes an image noisy might not be seen.
const FEWEST: usize = 6;
/// A way that the best exceeds by more than this factor in the first tiles, whichever is left out, is not tried in others. (In 40 times four of
/// 16 tiles, that ends the trials of `cornell-box` 35 times, and with 2 never; it leaves out the best way of `plates` 12 times, and with 2 11
/// times, since one of its tiles has nearly all of the variance.)
const FAR: f64 = 1.25;
/// A way must be so many times as efficient as that of the rule: costs by counts are right to about a fifth, since closed forms take 100 to 420 ns,
/// by the shape of the light.
const MARGIN: f64 = 1.2;
/// A way misses light if its sets differ from those of the rule as if they had more than so many times their own variance.
const MISSED: f64 = 2.0;
/// The seed of all tiles, which no other image uses by chance: images of all seeds take the same.
pub(super) const SEED: u64 = hash64(0x7472_6961_6c00_0000);

/// What one way made of a tile.
pub(super) struct Tried {
    means: Vec<[f32; 3]>,
    /// The variance of a set, summed over each block of 4 × 4 pixels.
    own: [f64; BLOCKS],
    cost: Cost,
}

/// The cost of a tile of an image.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cost {
    /// That of its samples, if all pixels of the image have the same number.
    pub(super) samples: f64,
    /// That of its proofs and corners, however many samples there are.
    pub(super) fixed: f64,
}

/// Side of the blocks of pixels that are taken to need the same numbers of samples.
const BLOCK: usize = 4;
const BLOCKS: usize = (TILE as usize / BLOCK).pow(2);

/// Some ways, and what each made of the first of some tiles.
pub(super) struct Trial {
    /// The first is that of the rule.
    ways: Vec<TechniqueChoice>,
    tiles: Vec<Area>,
    /// Samples per pixel of each set.
    spp: u32,
    /// The samples of one way in one tile relative to those of the image.
    part: f64,
    /// How many samples pixels have, if they share them.
    shares: Option<SamplePlan>,
    /// What each way made of the tiles, in order; those that are not worth more have fewer.
    tried: Vec<Vec<Tried>>,
}

impl Trial {
    /// A trial of these ways; `None` if it would take too large a part of the image.
    pub(super) fn new(ways: Vec<TechniqueChoice>, settings: &Settings) -> Option<Self> {
        let [across, down] = [settings.width, settings.height].map(|side| side.div_ceil(Settings::TILE));
        let all = f64::from(across) * f64::from(down);
        let part = |spp: u32| f64::from(2 * spp) / (all * f64::from(settings.spp));
        let fits = |spp: &u32| *spp <= settings.spp && settings.sampler.check(2 * spp, 2).is_ok();
        let most = STAGES[STAGES.len() - 1].min((all / 2.0) as usize);
        // as many tiles as possible, then as many samples
        let count = |spp: u32| ((PART / (part(spp) * ways.len() as f64)) as usize).min(most);
        let spp = SPP.into_iter().filter(fits).max_by_key(|&spp| count(spp))?;
        if ways.len() < 2 || count(spp) < FEWEST {
            return None;
        }
        // the sequence R2 (Roberts 2018), whose points are scattered evenly for any number of them
        let place = |k: usize, side: u32, step: f64| ((0.5 + step * (k + 1) as f64).fract() * f64::from(side)) as u32;
        let mut found: Vec<usize> = Vec::new();
        for k in 0..64 * most {
            let index = place(k, down, 0.569_840_290_998_053_2) * across + place(k, across, 0.754_877_666_246_692_7);
            if !found.contains(&(index as usize)) && found.len() < most {
                found.push(index as usize);
            }
        }
        let every: Vec<Area> = tiles(settings.whole()).collect();
        let shares = (settings.sampler == Sampler::Adaptive).then(|| SamplePlan::new(settings));
        let tried = ways.iter().map(|_| Vec::new()).collect();
        let tiles = found.into_iter().map(|index| every[index]).collect();
        Some(Self { ways, tiles, spp, part: part(spp), shares, tried })
    }

    /// The settings of a way in the trial of an image.
    pub(super) fn settings(&self, way: usize, settings: &Settings) -> Settings {
        let (technique, choice) = self.ways[way];
        Settings { technique, choice, spp: 2 * self.spp, sets: 2, seed: SEED, ..*settings }
    }

    /// Ways and tiles to try next, way by way; none if enough is known.
    pub(super) fn next(&self) -> Vec<(usize, Area)> {
        let (done, ways) = (self.tried[0].len(), self.left());
        let fits = ((PART / self.part) as usize - self.count()) / ways.len();
        let end = STAGES.into_iter().find(|&end| end > done).unwrap_or(done).min(done + fits).min(self.tiles.len());
        let ways = if ways.len() > 1 { &ways[..] } else { &[] };
        ways.iter().flat_map(|&way| self.tiles[done..end].iter().map(move |&tile| (way, tile))).collect()
    }

    /// How many tiles were rendered so far, each in one way.
    fn count(&self) -> usize {
        self.tried.iter().map(Vec::len).sum()
    }

    /// The samples so far relative to those of the image.
    fn spent(&self) -> f64 {
        self.part * self.count() as f64
    }

    /// Adds what a way made of the next tile.
    pub(super) fn add(&mut self, way: usize, tried: Tried) {
        self.tried[way].push(tried);
    }

    /// The ways that are worth another tile, that of the rule among them.
    fn left(&self) -> Vec<usize> {
        let done = self.tried[0].len();
        let others: Vec<usize> = (1..self.ways.len()).filter(|&way| self.tried[way].len() == done).collect();
        let worth: Vec<usize> = if done < FEWEST {
            let is_far = |&way: &usize| {
                done > 0
                    && (0..done).all(|i| {
                        let best = others.iter().map(|&other| self.score(other, done, Some(i)));
                        let best = best.fold(self.score(0, done, Some(i)), f64::min);
                        self.score(way, done, Some(i)) > FAR * best
                    })
            };
            others.iter().copied().filter(|way| !is_far(way)).collect()
        } else if others.iter().any(|&way| self.is_better(way)) {
            Vec::new()
        } else {
            // better so far, but not certainly
            others.into_iter().filter(|&way| MARGIN * self.score(way, done, None) < self.score(0, done, None)).collect()
        };
        std::iter::once(0).chain(worth).collect()
    }

    /// Whether a way is certainly better than that of the rule.
    fn is_better(&self, way: usize) -> bool {
        let count = self.tried[way].len();
        let of = |way: usize, without: Option<usize>| self.score(way, count, without);
        count >= FEWEST && MARGIN * of(way, None) < of(0, None) && (0..count).all(|i| of(way, Some(i)) < of(0, Some(i)))
    }

    /// Variance × cost of a way in the first tiles, but for one of them, and but for a common factor. If pixels share samples, these go where
    /// variance is, and cost what they cost there.
    fn score(&self, way: usize, count: usize, without: Option<usize>) -> f64 {
        let of = |way: usize| {
            let tried = self.tried[way][..count].iter().enumerate();
            tried.filter(move |(i, _)| Some(*i) != without).map(|(_, tried)| tried)
        };
        let tiles: Vec<&Tried> = of(way).collect();
        let variances = variances(&tiles, &if way > 0 { of(0).collect() } else { Vec::new() });
        let shares = self.shares.as_ref().and_then(|plan| shares(&variances, plan));
        let shares = shares.unwrap_or_else(|| vec![1.0; variances.len()]);
        let variance: f64 = variances.iter().zip(&shares).map(|(v, n)| v * fall(*n)).sum();
        let mean = |shares: &[f64]| shares.iter().sum::<f64>() / BLOCKS as f64;
        let cost = |(tile, shares): (&&Tried, &[f64])| tile.cost.fixed + tile.cost.samples * mean(shares);
        variance * tiles.iter().zip(shares.chunks(BLOCKS)).map(cost).sum::<f64>()
    }

    /// The best of the ways, and what tells; the first unless another is certainly better.
    pub(super) fn best(&self) -> (TechniqueChoice, Option<AutoTrial>) {
        let relative = |&way: &usize| {
            let count = self.tried[way].len();
            self.score(way, count, None) / self.score(0, count, None)
        };
        let least = |a: &usize, b: &usize| relative(a).total_cmp(&relative(b));
        let ways = 0..self.ways.len();
        let best = ways.clone().skip(1).filter(|&way| self.is_better(way)).min_by(least).unwrap_or(0);
        let next = ways.filter(|&way| way != best).min_by(least).unwrap_or(0);
        let times = relative(&next) / relative(&best);
        let (way, tiles) = (self.ways[best], self.tried[best].len().min(self.tried[next].len()));
        let trial = AutoTrial { is_rule: best == 0, over: self.ways[next], times, tiles, part: self.spent() };
        // where nothing was seen, there is no ratio
        (way, (times > 0.0 && times.is_finite()).then_some(trial))
    }
}

impl Tried {
    /// From the pixels of a tile in two sets.
    pub(super) fn new(tile: Area, pixels: &[Pixel], cost: Cost) -> Self {
        let mut own = [0.0; BLOCKS];
        for (pixel, [x, y]) in pixels.iter().zip(area::pixels(tile)) {
            let [column, row] = [x - tile[0], y - tile[1]].map(|at| at as usize / BLOCK);
            // the mean of both has half of it
            own[row * TILE as usize / BLOCK + column] += 2.0 * pixel.variance.into_iter().map(f64::from).sum::<f64>();
        }
        Self { means: pixels.iter().map(|pixel| pixel.mean).collect(), own, cost }
    }

    /// The variance of a set, by the means and those of the rule.
    fn beside(&self, rule: &Self) -> f64 {
        let square =
            |(a, b): (&[f32; 3], &[f32; 3])| a.iter().zip(b).map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>();
        let squares: f64 = self.means.iter().zip(&rule.means).map(square).sum();
        2.0 * squares - rule.own.iter().sum::<f64>()
    }
}

/// The variance of each block of the tiles of a way, which are beside those of the rule, if it is another.
fn variances(tiles: &[&Tried], rule: &[&Tried]) -> Vec<f64> {
    let own = || tiles.iter().flat_map(|tile| tile.own);
    let (all, beside) = (own().sum::<f64>(), tiles.iter().zip(rule).map(|(tile, rule)| tile.beside(rule)).sum::<f64>());
    let missed = beside > MISSED * all;
    match (missed, all > 0.0) {
        (false, _) => own().collect(),
        (true, true) => own().map(|own| beside / all * own).collect(),
        // what its sets do not tell is taken to be everywhere
        (true, false) => vec![beside / (tiles.len() * BLOCKS) as f64; tiles.len() * BLOCKS],
    }
}

/// What images consist of.
const KINDS: usize = 11;

/// What each is called, and the nanoseconds that it takes: `cargo test --release -p etendue-render-tests --test all -- --ignored regret_of_auto
/// --nocapture` prints these beside those that fit the times of its images best. Only ratios matter.
const TIMES: [(&str, f64); KINDS] = [
    ("rays from the camera", 35.0),
    ("rays from mirrors", 25.0),
    ("shadow rays", 15.0),
    ("proofs", 3000.0),
    ("what proofs meet", 300.0),
    ("closed forms", 130.0),
    ("samples allocated to lights", 44.0),
    ("lights chosen at points", 27.0),
    ("samples of light or surface", 16.0),
    ("samples by projected solid angle", 60.0),
    ("other samples", 8.0),
];

/// How many of these were counted: those that more samples need more of, and those that they do not. `is_few` says whether samples may be
/// allocated to a few lights.
fn kinds((technique, choice): TechniqueChoice, is_few: bool, count: &RayCount) -> [[f64; KINDS]; 2] {
    let RayCount { camera, look, mirror, shadow, corner, proofs, met, forms } = *count;
    // where lights are known, none is sampled
    let sampled = if technique == Technique::Analytic { shadow.min(camera) } else { camera };
    let chosen = if technique == Technique::Brdf { 0 } else { sampled };
    let allocated = if choice == ChoiceBy::Auto && is_few { chosen } else { 0 };
    let at_points = if choice == ChoiceBy::Spatial { chosen } else { 0 };
    let drawn = match technique {
        Technique::MisPower | Technique::MisLobe => [sampled, 0, 0],
        Technique::ProjectedSolidAngle => [0, sampled, 0],
        _ => [0, 0, sampled],
    };
    let [mis, projected, plain] = drawn;
    let samples = [camera + look, mirror, shadow, 0, 0, forms, allocated, at_points, mis, projected, plain];
    [samples, [corner, 0, 0, proofs, met, 0, 0, 0, 0, 0, 0]].map(|all| all.map(|n| n as f64))
}

/// The cost of what was counted in a tile, with `times` as many samples but the same proofs.
pub(super) fn cost(way: TechniqueChoice, is_few: bool, count: &RayCount, times: f64) -> Cost {
    let [samples, fixed] =
        kinds(way, is_few, count).map(|all| all.iter().zip(TIMES).map(|(n, (_, time))| n * time).sum::<f64>());
    Cost { samples: times * samples, fixed }
}

/// What [`View::kinds`](super::View::kinds) tells.
pub(super) fn named(way: TechniqueChoice, is_few: bool, count: &RayCount) -> Vec<(&'static str, f64, f64)> {
    let [samples, fixed] = kinds(way, is_few, count);
    TIMES.iter().zip(samples).zip(fixed).map(|((&(name, time), n), m)| (name, time, n + m)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A trial takes at most its part of the samples, on different tiles in all quarters of the image; small images take none.
    #[test]
    fn trials_are_small_and_scattered() {
        let mut planned = 0;
        for (size, spp, ways) in [64, 128, 200, 256, 512, 1000]
            .into_iter()
            .flat_map(|size| [4, 8, 12, 64, 256, 4096].map(|spp| [2, 4, 8].map(|ways| (size, spp, ways))))
            .flatten()
        {
            let sampler = Sampler::Adaptive;
            let settings = Settings { width: size, height: size / 2 + 3, spp, sampler, ..Settings::DEFAULT };
            let Some(mut trial) = Trial::new(vec![(Technique::Area, ChoiceBy::Auto); ways], &settings) else {
                assert!(size < 256 || spp <= 64, "{size} {spp}");
                continue;
            };
            planned += 1;
            // all are as good as the first, so that none is left out in the first tiles, and none is worth more than the second
            let mut stages = Vec::new();
            while let next = trial.next()
                && !next.is_empty()
            {
                next.iter().for_each(|&(way, _)| trial.add(way, tried([1.0, 3.0], 0.5, 1.0)));
                stages.push(trial.tried[0].len());
            }
            assert!(
                stages.len() == 2 && stages[0] == STAGES[0] && (FEWEST..=STAGES[1]).contains(&stages[1]),
                "{stages:?}"
            );
            assert!(trial.tried.iter().all(|tried| tried.len() == stages[1]));
            let tiles = &trial.tiles[..stages[1]];
            let all = f64::from(size) * f64::from(size / 2 + 3) * f64::from(spp);
            let pixels: usize = tiles.iter().map(|&tile| area::count(tile)).sum();
            let samples = (ways * pixels) as f64 * f64::from(2 * trial.spp);
            assert!(trial.spent() <= PART && samples <= 1.1 * PART * all, "{size} {spp}: {samples} of {all}");
            let mut corners: Vec<[u32; 2]> = tiles.iter().map(|&[x, y, ..]| [x, y]).collect();
            corners.sort_unstable();
            corners.dedup();
            assert_eq!(corners.len(), tiles.len());
            for k in 0..2 {
                let middle = [size, size / 2][k] / 2;
                let first = corners.iter().filter(|corner| corner[k] < middle).count();
                assert!((corners.len() / 4..=3 * corners.len() / 4 + 1).contains(&first), "{size}: {corners:?}");
            }
        }
        assert!(planned > 20, "{planned}");
    }

    fn tried(means: [f32; 2], own: f64, samples: f64) -> Tried {
        let own = std::array::from_fn(|i| if i == 3 { own } else { 0.0 });
        Tried { means: means.map(|x| [x; 3]).into(), own, cost: Cost { samples, fixed: 0.0 } }
    }

    /// The tiles of each way when the trial ends, and what is best, by the cost of each way in tile after tile.
    fn end(costs: &[[f64; 16]], shares: Option<SamplePlan>) -> (Vec<usize>, TechniqueChoice, Option<AutoTrial>) {
        let settings = Settings { width: 1024, height: 1024, spp: 64, sampler: Sampler::Sobol, ..Settings::DEFAULT };
        let ways = [Technique::Analytic, Technique::SolidAngle, Technique::Area, Technique::MisPower];
        let ways = ways.map(|technique| (technique, ChoiceBy::Auto))[..costs.len()].to_vec();
        let mut trial = Trial::new(ways, &settings).unwrap();
        trial.shares = shares;
        while let next = trial.next()
            && !next.is_empty()
        {
            for (way, _) in next {
                let cost = costs[way][trial.tried[way].len()];
                trial.add(way, tried([1.0, 3.0], 0.5, cost));
            }
        }
        let (way, found) = trial.best();
        (trial.tried.iter().map(Vec::len).collect(), way, found)
    }

    /// What is far from the best is tried in four tiles, what is certain after eight ends there, and only what is better, but not certainly, takes
    /// all tiles.
    #[test]
    fn trials_end_when_enough_is_known() {
        let rule = (Technique::Analytic, ChoiceBy::Auto);
        let (tiles, way, found) = end(&[[1.0; 16], [3.0; 16]], None);
        assert_eq!((tiles, way), (vec![4, 4], rule));
        let found = found.unwrap();
        assert!(found.is_rule && found.tiles == 4 && (found.times - 3.0).abs() < 1e-12, "{found:?}");
        // of two that are better, the best is taken
        let (tiles, way, found) = end(&[[1.0; 16], [0.8; 16], [0.7; 16], [3.0; 16]], None);
        assert_eq!((tiles, way), (vec![8, 8, 8, 4], (Technique::Area, ChoiceBy::Auto)));
        let found = found.unwrap();
        assert!(!found.is_rule && found.tiles == 8 && (found.times - 0.8 / 0.7).abs() < 1e-12, "{found:?}");
        assert_eq!(found.over.0, Technique::SolidAngle);
        // by one tile alone, nothing is taken
        let mut costs = [1.0; 16];
        costs[3] = 30.0;
        let (tiles, way, _) = end(&[costs, [1.0; 16]], None);
        assert_eq!((tiles, way), (vec![16, 16], rule));
        costs[14] = 30.0;
        assert_eq!(end(&[costs, [1.0; 16]], None).1, (Technique::SolidAngle, ChoiceBy::Auto));
    }

    /// A way that meets no light has two equal sets, and yet the variance of what it misses.
    #[test]
    fn what_misses_light_does_not_look_exact() {
        let rule = tried([1.0, 3.0], 0.5, 1.0);
        let of = |way: &Tried| variances(&[way], &[&rule]).iter().sum::<f64>();
        assert_eq!(of(&tried([1.0, 3.0], 0.25, 1.0)), 0.25);
        // Σ (x − y)² is 3 + 27, and half of each variance
        let missing = tried([0.0, 0.0], 0.0, 1.0);
        assert!((of(&missing) - 59.5).abs() < 1e-12);
        assert!(variances(&[&missing], &[&rule]).iter().all(|&v| v > 0.0));
    }

    /// Where pixels share samples, tiles with all of the variance have nearly all of the samples, and their cost counts.
    #[test]
    fn shared_samples_cost_what_they_cost_where_variance_is() {
        let settings = Settings { spp: 64, sampler: Sampler::Adaptive, ..Settings::DEFAULT };
        let mut trial =
            Trial::new(vec![(Technique::Area, ChoiceBy::Auto); 2], &Settings { width: 1024, height: 1024, ..settings })
                .unwrap();
        for (own, cost) in [(0.0, 1.0), (0.5, 9.0)] {
            trial.add(0, tried([1.0; 2], own, cost));
            trial.add(1, tried([1.0; 2], own, 5.0));
        }
        let times = trial.score(0, 2, None) / trial.score(1, 2, None);
        assert!((1.05..=1.8).contains(&times), "{times}");
        trial.shares = None;
        assert_eq!(trial.score(0, 2, None), trial.score(1, 2, None));
    }
}
