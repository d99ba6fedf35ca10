//! How long measurements take, by a short trial, and what of them fits into a time.

use super::measure::{Key, inapplicable, needs_repeats};
use super::options::Options;
use super::prepare::Loaded;
use super::reference::Reference;
use etendue_render::{Sampler, Settings};
use std::collections::HashMap;
use std::time::Instant;

/// What is measured of all scenes.
#[derive(Clone, Debug)]
pub(super) struct Extent {
    /// Samples per pixel, in ascending order.
    pub(super) spps: Vec<u32>,
    /// Number of images per key.
    pub(super) replicates: u32,
    /// Pixels across and down, for each scene.
    pub(super) sizes: Vec<[u32; 2]>,
    /// Samples per pixel of the references that are rendered.
    pub(super) reference_spp: u32,
    /// Whether series that cannot win are measured no further.
    pub(super) is_race: bool,
}

/// Seconds for each pixel of an image: some for any number of samples, as for certificates, and some for each sample.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rate {
    fixed: f64,
    sample: f64,
}

impl Rate {
    /// The rate at which images of `pixels` pixels with these samples per pixel took these seconds; the second has more samples.
    fn new(pixels: f64, [(n, a), (m, b)]: [(f64, f64); 2]) -> Self {
        let sample = (b - a) / (m - n);
        let fixed = a - n * sample;
        // noise: all is due to the samples
        let sound = sample > 0.0 && fixed > 0.0;
        let (fixed, sample) = if sound { (fixed, sample) } else { (0.0, b / m) };
        Self { fixed: fixed / pixels, sample: sample / pixels }
    }
    fn seconds(self, [width, height]: [u32; 2], spp: u32) -> f64 {
        f64::from(width) * f64::from(height) * (self.fixed + self.sample * f64::from(spp))
    }
}

/// Measured rates of all methods and samplers.
pub(super) struct Trial {
    /// Their rates, by keys whose number of samples is 0.
    rates: HashMap<Key, Rate>,
    /// The rates of references; `None` where the reference is already there.
    references: Vec<Option<Rate>>,
}

/// Images of a trial are repeated until this many seconds have passed, at most three times; the shortest counts.
const SECONDS: f64 = 0.03;
/// Part of the images after the first round, and of those with the most samples, that a race is taken to leave.
const RACE: f64 = 0.3;
/// Part of a time that the estimate may fill.
const FILLED: f64 = 0.85;

fn seconds(scene: &Loaded, settings: &Settings) -> f64 {
    let begin = Instant::now();
    let mut least = f64::INFINITY;
    for _ in 0..3 {
        let start = Instant::now();
        scene.world.render(settings, &|_| ());
        least = least.min(start.elapsed().as_secs_f64());
        if begin.elapsed().as_secs_f64() > SECONDS {
            break;
        }
    }
    least
}

/// The rate at which a way renders a scene: that of two images of a quarter of the width and height.
fn rate(scene: &Loaded, size: [u32; 2], spps: [u32; 2], settings: impl Fn([u32; 2], u32) -> Settings) -> Rate {
    let size = size.map(|side| side.div_ceil(4));
    let pixels = f64::from(size[0]) * f64::from(size[1]);
    Rate::new(pixels, spps.map(|spp| (f64::from(spp), seconds(scene, &settings(size, spp)))))
}

impl Trial {
    /// Renders small images by all methods and samplers, as far as these apply.
    pub(super) fn new(scenes: &[Loaded], samplers: &[Sampler], is_quick: bool) -> Self {
        let mut rates = HashMap::new();
        for (scene, loaded) in scenes.iter().enumerate() {
            for &(technique, choice) in &loaded.methods {
                for &sampler in samplers {
                    let applies = |spp: &u32| inapplicable(sampler, *spp).is_none();
                    let mut possible = (0..=14).map(|k| 1 << k).filter(applies);
                    let Some(few) = possible.next() else { continue };
                    let many = possible.find(|spp| *spp >= 4 * few).unwrap_or(2 * few);
                    let key = |spp| Key { scene, technique, choice, sampler, spp };
                    let found = rate(loaded, loaded.size, [few, many], |size, spp| key(spp).settings(size, 1));
                    rates.insert(key(0), found);
                }
            }
        }
        let of_reference = |scene: &Loaded| {
            scene
                .lacks_reference()
                .then(|| rate(scene, scene.size, [32, 64], |size, spp| Reference::settings(size, spp, is_quick)))
        };
        let references = scenes.iter().map(of_reference).collect();
        Self { rates, references }
    }

    /// Estimated seconds for the reference of a scene.
    fn reference(&self, extent: &Extent, scene: usize) -> f64 {
        self.references[scene].map_or(0.0, |rate| rate.seconds(extent.sizes[scene], extent.reference_spp))
    }

    /// Estimated seconds for a scene.
    fn of_scene(&self, extent: &Extent, scene: usize) -> f64 {
        let image = |key: &Key, rate: &Rate| {
            let possible = |spp: &&u32| inapplicable(key.sampler, **spp).is_none();
            let spps = extent.spps.iter().filter(possible);
            let seconds = |spp: &u32| needs_repeats(rate.seconds(extent.sizes[scene], *spp));
            let part = |spp: &u32| if extent.is_race && Some(spp) == extent.spps.last() { RACE } else { 1.0 };
            spps.map(|spp| part(spp) * seconds(spp)).sum::<f64>()
        };
        let keys = self.rates.iter().filter(|(key, _)| key.scene == scene);
        let more = f64::from(extent.replicates - 1) * if extent.is_race { RACE } else { 1.0 };
        let images = (1.0 + more) * keys.map(|(key, rate)| image(key, rate)).sum::<f64>();
        images + self.reference(extent, scene)
    }

    /// Estimated seconds for all.
    pub(super) fn estimate(&self, extent: &Extent) -> f64 {
        (0..extent.sizes.len()).map(|scene| self.of_scene(extent, scene)).sum()
    }

    /// Reduces what the options do not ask for until it fits into this many seconds, as far as it stays worth measuring: samples of
    /// references, sample counts from the greatest on, replicates, and the sides of images.
    pub(super) fn fit(&self, extent: &mut Extent, options: &Options, seconds: f64) {
        let goal = FILLED * seconds;
        let all = 0..extent.sizes.len();
        while self.estimate(extent) > goal {
            let counts = if options.spp.is_empty() { extent.spps.len() } else { 0 };
            let references: f64 = all.clone().map(|scene| self.reference(extent, scene)).sum();
            // of the scenes that can have a smaller image, the one that takes longest
            // in the smallest images a quick chart finds other winners, see `the_answer_of_a_quick_chart`
            let least = if options.quick { 128 } else { 64 };
            let can_halve =
                |scene: &usize| extent.sizes[*scene].iter().all(|side| *side > least && side.is_multiple_of(2));
            let is_free = options.size.is_none();
            let slow = all.clone().filter(|scene| is_free && can_halve(scene));
            let slow = slow.max_by(|a, b| self.of_scene(extent, *a).total_cmp(&self.of_scene(extent, *b)));
            if options.reference_spp.is_none() && extent.reference_spp > 64 && references > 0.25 * goal {
                extent.reference_spp /= 2;
            } else if counts > 4 {
                extent.spps.pop();
            } else if options.replicates.is_none() && extent.replicates > 4 {
                extent.replicates -= 1;
            } else if let Some(scene) = slow {
                extent.sizes[scene] = extent.sizes[scene].map(|side| side / 2);
            } else if options.replicates.is_none() && extent.replicates > 3 {
                extent.replicates -= 1;
            } else if counts > 2 {
                extent.spps.pop();
            } else {
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_render::{ChoiceBy, Technique};

    #[test]
    fn rates_are_those_of_the_images() {
        let close = |rate: Rate, fixed: f64, sample: f64| {
            assert!((rate.fixed - fixed).abs() < 1e-12 && (rate.sample - sample).abs() < 1e-12, "{rate:?}");
        };
        close(Rate::new(100.0, [(4.0, 0.9), (16.0, 2.1)]), 0.005, 0.001);
        // the larger image took less time
        close(Rate::new(100.0, [(4.0, 0.9), (16.0, 0.8)]), 0.0, 0.0005);
    }

    #[test]
    fn what_is_not_asked_for_shrinks_until_it_fits() {
        let key =
            Key { scene: 0, technique: Technique::Area, choice: ChoiceBy::Auto, sampler: Sampler::Independent, spp: 0 };
        let rates = HashMap::from([(key, Rate { fixed: 0.0, sample: 1e-6 })]);
        let trial = Trial { rates, references: vec![None] };
        let parse = |line: &str| {
            #[derive(clap::Parser)]
            struct Line {
                #[command(flatten)]
                options: Options,
            }
            <Line as clap::Parser>::parse_from(line.split(' ')).options
        };
        let fitted = |line: &str, seconds: f64| {
            let options = parse(line);
            let mut extent = Extent {
                spps: options.spps(),
                replicates: options.replicates.unwrap_or(5),
                sizes: vec![[256; 2]],
                reference_spp: 4096,
                is_race: false,
            };
            trial.fit(&mut extent, &options, seconds);
            let estimate = trial.estimate(&extent);
            (extent.spps.last().copied().unwrap_or(0), extent.replicates, extent.sizes[0][0], estimate <= seconds)
        };
        // five images of 341 samples in each of 65,536 pixels take 112 s
        assert_eq!(fitted("chart", 150.0), (256, 5, 256, true));
        assert_eq!(fitted("chart", 120.0), (64, 5, 256, true));
        assert_eq!(fitted("chart", 32.0), (64, 4, 256, true));
        assert_eq!(fitted("chart", 8.0), (64, 4, 128, true));
        // three of 21 samples take 4 s
        assert_eq!(fitted("chart --size 256x256", 8.0), (16, 3, 256, true));
        assert_eq!(fitted("chart --spp 1024 --replicates 5 --size 256x256", 6.0), (1024, 5, 256, false));
    }
}
