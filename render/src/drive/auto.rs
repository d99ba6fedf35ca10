//! What `auto` takes: the most efficient of a few ways to sample, as a trial on scattered tiles of the image finds it.
//!
//! Each way renders each tile twice. Half of the squared differences of both images tell its variance, and counts of what it did tell its cost, so
//! that nothing depends on clocks or threads. The samples of the trial are no part of the image, whose mean is right whatever was found.
//!
//! A way that misses some light looks exact, so each is compared with that of the rule, too, which misses none: the squared
//! difference of their images is the sum of their variances. What is taken instead of it must be better whichever tile is left out.

use super::pixel_counts::POWER;
use crate::bvh::RayCount;
use crate::choose::ChoiceBy;
use crate::film::Pixel;
use crate::sampler::hash64;
use crate::scene::area::{self, Area, TILE};
use crate::settings::{Settings, tiles};
use crate::technique::Technique;
use libm::pow;

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
    /// Number of tiles.
    pub tiles: usize,
    /// The samples of the trial relative to those of the image.
    pub part: f64,
}

/// The greatest samples of a trial relative to those of the image.
const PART: f64 = 0.03;
/// Samples per pixel of each image of a tile.
const SPP: [u32; 3] = [8, 16, 32];
/// Numbers of tiles. In fewer, most of what makes an image noisy would not be seen.
const TILES: [usize; 2] = [6, 16];
/// A way must be so many times as efficient as that of the rule.
const MARGIN: f64 = 1.1;
/// A way misses light if its images differ from those of the rule as if they had more than so many times their own variance.
const MISSED: f64 = 2.0;
/// The seeds of both images of a tile, which no other image uses by chance: images of all seeds take the same.
pub(super) const SEEDS: [u64; 2] = [hash64(0x7472_6961_6c00_0000), hash64(0x7472_6961_6c00_0001)];

/// What one way made of a tile.
pub(super) struct Tried {
    /// Means of both images.
    means: Vec<[f32; 3]>,
    /// Half the sum of the squared differences of both images, in each block of 4 × 4 pixels: the variance of each.
    own: [f64; BLOCKS],
    /// The cost of as many samples as the image has.
    cost: f64,
}

/// Side of the blocks of pixels that are taken to need the same numbers of samples.
const BLOCK: usize = 4;
const BLOCKS: usize = (TILE as usize / BLOCK).pow(2);

/// The tiles of a trial, and the samples per pixel of each of its images.
pub(super) struct Plan {
    pub(super) tiles: Vec<Area>,
    pub(super) spp: u32,
    part: f64,
}

impl Plan {
    /// The trial of so many ways; `None` if it would take too large a part of the image.
    pub(super) fn new(settings: &Settings, ways: usize) -> Option<Self> {
        let [across, down] = [settings.width, settings.height].map(|side| side.div_ceil(Settings::TILE));
        let all = f64::from(across) * f64::from(down);
        // samples per pixel over all tiles, for each image of each way
        let each = PART * all * f64::from(settings.spp) / (2.0 * ways as f64);
        let fits = |spp: &u32| *spp <= settings.spp && settings.sampler.check(*spp, settings.sets).is_ok();
        let numbers = SPP.into_iter().filter(fits);
        // as many tiles as possible, then as many samples
        let count = |spp: u32| ((each / f64::from(spp)) as usize).min(TILES[1]).min((all / 2.0) as usize);
        let spp = numbers.max_by_key(|&spp| count(spp))?;
        let count = count(spp);
        if count < TILES[0] {
            return None;
        }
        // the sequence R2 (Roberts 2018), whose points are scattered evenly for any number of them
        let place = |k: usize, side: u32, step: f64| ((0.5 + step * (k + 1) as f64).fract() * f64::from(side)) as u32;
        let mut found: Vec<usize> = Vec::new();
        for k in 0.. {
            let index = place(k, down, 0.569_840_290_998_053_2) * across + place(k, across, 0.754_877_666_246_692_7);
            if found.len() == count || k > 64 * count {
                break;
            }
            if !found.contains(&(index as usize)) {
                found.push(index as usize);
            }
        }
        let every: Vec<Area> = tiles(settings.whole()).collect();
        let part = (2 * ways * found.len()) as f64 * f64::from(spp) / (all * f64::from(settings.spp));
        Some(Self { tiles: found.into_iter().map(|index| every[index]).collect(), spp, part })
    }
}

/// The best of these ways by what each made of the tiles, way by way, and the trial that tells; the first unless another is certainly better. If
/// pixels share samples, these go where variance is.
pub(super) fn best(
    ways: &[TechniqueChoice],
    plan: &Plan,
    tried: &[Tried],
    is_shared: bool,
) -> (TechniqueChoice, Option<AutoTrial>) {
    let by_way: Vec<&[Tried]> = tried.chunks(plan.tiles.len()).collect();
    let all = |way: usize, without: Option<usize>| {
        let of = |way: usize| by_way[way].iter().enumerate().filter(move |(i, _)| Some(*i) != without).map(|(_, t)| t);
        variance(of(way), (way > 0).then(|| of(0)), is_shared) * of(way).map(|tile| tile.cost).sum::<f64>()
    };
    let scores: Vec<f64> = (0..ways.len()).map(|way| all(way, None)).collect();
    let holds = |&way: &usize| {
        MARGIN * scores[way] < scores[0] && (0..plan.tiles.len()).all(|i| all(way, Some(i)) < all(0, Some(i)))
    };
    let best = (1..ways.len()).filter(holds).min_by(|a, b| scores[*a].total_cmp(&scores[*b])).unwrap_or(0);
    let next = (0..ways.len()).filter(|&way| way != best).min_by(|a, b| scores[*a].total_cmp(&scores[*b]));
    let Some(next) = next.filter(|&next| scores[best] > 0.0 && scores[next] > 0.0) else { return (ways[0], None) };
    let (times, tiles) = (scores[next] / scores[best], plan.tiles.len());
    (ways[best], Some(AutoTrial { is_rule: best == 0, over: ways[next], times, tiles, part: plan.part }))
}

impl Tried {
    /// From two images of a tile.
    pub(super) fn new(tile: Area, [first, second]: [&[Pixel]; 2], cost: f64) -> Self {
        let pairs = || first.iter().zip(second);
        let mut own = [0.0; BLOCKS];
        for ((a, b), [x, y]) in pairs().zip(area::pixels(tile)) {
            let [column, row] = [x - tile[0], y - tile[1]].map(|at| at as usize / BLOCK);
            own[row * TILE as usize / BLOCK + column] += 0.5 * square(&a.mean, &b.mean);
        }
        Self { means: pairs().map(|(a, b)| [0, 1, 2].map(|k| 0.5 * (a.mean[k] + b.mean[k]))).collect(), own, cost }
    }
}

fn square(a: &[f32; 3], b: &[f32; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| f64::from(a - b).powi(2)).sum()
}

/// The variance of the image, but for a common factor, by tiles of a way and those of the rule, if it is another. If pixels share samples, these go
/// where variance is: see `pixel_counts`.
fn variance<'a>(
    tiles: impl Iterator<Item = &'a Tried> + Clone,
    rule: Option<impl Iterator<Item = &'a Tried>>,
    is_shared: bool,
) -> f64 {
    let own = tiles.clone().flat_map(|tile| tile.own).sum::<f64>();
    // the mean of two images has half the variance of each
    let beside = rule.map_or(0.0, |rule| tiles.clone().zip(rule).map(|(tile, rule)| tile.beside(rule)).sum());
    // what its images do not tell is taken to be everywhere
    let count = (tiles.clone().count() * BLOCKS) as f64;
    let missed = beside > MISSED * own;
    let (factor, more) =
        if own > 0.0 && missed { (beside / own, 0.0) } else { (1.0, if missed { beside / count } else { 0.0 }) };
    let blocks = tiles.flat_map(|tile| tile.own).map(|own| factor * own + more);
    if is_shared { pow(blocks.map(|x| pow(x, POWER)).sum(), POWER.recip()) } else { blocks.sum() }
}

impl Tried {
    /// The variance of each image, by the mean of both and that of the rule's images.
    fn beside(&self, rule: &Self) -> f64 {
        let squares: f64 = self.means.iter().zip(&rule.means).map(|(a, b)| square(a, b)).sum();
        2.0 * squares - rule.own.iter().sum::<f64>()
    }
}

/// Nanoseconds of what an image consists of. They are fits to the times and counts that `regret_of_auto_as_a_table` of the tests prints; only
/// ratios matter.
const CAMERA: f64 = 35.0;
const MIRROR: f64 = 25.0;
const SHADOW: f64 = 15.0;
const PROOF: f64 = 3000.0;
const FORM: f64 = 250.0;

/// The same for a sample of a light, without its ray; `is_few` says whether samples may be allocated to a few lights.
fn of_sample((technique, choice): TechniqueChoice, is_few: bool) -> f64 {
    let chosen = match choice {
        ChoiceBy::Auto if is_few => 44.0,
        ChoiceBy::Spatial => 27.0,
        _ => 0.0,
    };
    let drawn = match technique {
        Technique::Brdf => return 8.0,
        Technique::MisPower | Technique::MisLobe => 16.0,
        Technique::ProjectedSolidAngle => 60.0,
        _ => 8.0,
    };
    chosen + drawn
}

/// The cost of what was counted, with `times` as many samples but the same proofs.
pub(super) fn cost(way: TechniqueChoice, is_few: bool, count: &RayCount, times: f64) -> f64 {
    let RayCount { camera, look, mirror, shadow, corner, proofs, forms } = count;
    let [camera, look, mirror, shadow, corner, proofs, forms] =
        [camera, look, mirror, shadow, corner, proofs, forms].map(|n| *n as f64);
    // where lights are known, none is sampled
    let sampled = if way.0 == Technique::Analytic { shadow.min(camera) } else { camera };
    let samples =
        (camera + look) * CAMERA + mirror * MIRROR + shadow * SHADOW + forms * FORM + sampled * of_sample(way, is_few);
    times * samples + corner * CAMERA + proofs * PROOF
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Sampler;

    /// A trial takes at most its part of the samples, on different tiles in all quarters of the image; small images take none.
    #[test]
    fn trials_are_small_and_scattered() {
        let mut planned = 0;
        for (size, spp, ways) in [64, 128, 200, 256, 512, 1000]
            .into_iter()
            .flat_map(|size| [4, 8, 12, 64, 256, 4096].map(|spp| [1, 2, 4].map(|ways| (size, spp, 2 * ways))))
            .flatten()
        {
            let sampler = Sampler::Adaptive;
            let settings = Settings { width: size, height: size / 2 + 3, spp, sampler, ..Settings::DEFAULT };
            let Some(plan) = Plan::new(&settings, ways) else {
                assert!(size < 256 || spp <= 64, "{size} {spp}");
                continue;
            };
            planned += 1;
            let all = f64::from(size) * f64::from(size / 2 + 3) * f64::from(spp);
            let pixels: usize = plan.tiles.iter().map(|&tile| area::count(tile)).sum();
            let samples = (2 * ways * pixels) as f64 * f64::from(plan.spp);
            assert!(plan.part <= PART && samples <= 1.1 * PART * all, "{size} {spp}: {samples} of {all}");
            assert!((TILES[0]..=TILES[1]).contains(&plan.tiles.len()) && plan.spp <= spp);
            let mut corners: Vec<[u32; 2]> = plan.tiles.iter().map(|&[x, y, ..]| [x, y]).collect();
            corners.sort_unstable();
            corners.dedup();
            assert_eq!(corners.len(), plan.tiles.len());
            for k in 0..2 {
                let middle = [size, size / 2][k] / 2;
                let first = corners.iter().filter(|corner| corner[k] < middle).count();
                assert!((corners.len() / 4..=3 * corners.len() / 4 + 1).contains(&first), "{size}: {corners:?}");
            }
        }
        assert!(planned > 20, "{planned}");
    }

    /// A way that meets no light has two equal images, and yet the variance of what it misses.
    #[test]
    fn what_misses_light_does_not_look_exact() {
        let tried = |means: [f32; 2], own: f64| {
            let own = std::array::from_fn(|i| if i == 3 { own } else { 0.0 });
            Tried { means: means.map(|x| [x; 3]).into(), own, cost: 1.0 }
        };
        let rule = [tried([1.0, 3.0], 0.5)];
        let of = |way: Tried, is_shared| variance([way].iter(), Some(rule.iter()), is_shared);
        assert!((of(tried([1.0, 3.0], 0.25), true) - 0.25).abs() < 1e-12);
        assert_eq!(of(tried([1.0, 3.0], 0.25), false), 0.25);
        // Σ (x − y)² is 3 + 27, and half of each variance
        assert!((of(tried([0.0, 0.0], 0.0), false) - 59.5).abs() < 1e-12);
        assert!(of(tried([0.0, 0.0], 0.0), true) > 59.5);
    }
}
