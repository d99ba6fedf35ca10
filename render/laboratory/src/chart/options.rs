//! Options of `etendue chart`.

use crate::options::{named, size, threads, whole};
use clap::Args;
use etendue_render::scene::limits::MOST_SAMPLES;
use etendue_render::{ChoiceBy, Sampler, Technique};
use std::ffi::OsString;
use std::path::PathBuf;

/// Options of `etendue chart`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Names of built-in scenes, or paths of pbrt-v4 or glTF files
    #[arg(default_values_os_t = ["quads", "sphere-light", "triangle-light"].map(OsString::from))]
    pub scenes: Vec<OsString>,
    /// Folder for the report; measurements it already holds are not repeated
    #[arg(short, long, default_value = "chart")]
    pub output: PathBuf,
    /// How to sample the lights [default: all techniques; one to compare several choices]
    #[arg(long, value_parser = named::<Technique>(&Technique::NAMES), value_delimiter = ',')]
    pub techniques: Vec<Technique>,
    /// How to choose one of the lights
    #[arg(long = "choice", value_name = "CHOICES", value_parser = named::<ChoiceBy>(&ChoiceBy::NAMES), value_delimiter = ',', default_value = "auto")]
    pub choices: Vec<ChoiceBy>,
    /// How to generate the random numbers [default: independent, sobol and adaptive; all with --long]
    #[arg(long, value_parser = named::<Sampler>(&Sampler::NAMES), value_delimiter = ',')]
    pub samplers: Vec<Sampler>,
    /// Samples per pixel [default: 1,4,16,64,256, as far as the time allows; with --quick 4,8,16,64; with --long 1,2,4,…,1024]
    #[arg(long, value_delimiter = ',', value_parser = whole::<u32>(1..=MOST_SAMPLES.into()))]
    pub spp: Vec<u32>,
    /// Number of images per measurement, with different seeds [default: 5, or fewer if the time is short]
    #[arg(long, value_parser = whole::<u32>(1..=10_000))]
    pub replicates: Option<u32>,
    /// Light the scenes by this image of a sky (EXR, HDR, PFM or PNG), instead of their own skies
    #[arg(long, value_name = "FILE")]
    pub environment: Option<PathBuf>,
    /// Render the reference with this many samples per pixel [default without a built-in one: 4096, or fewer if the time is short; with --quick 256 by auto and adaptive]
    #[arg(long, value_name = "SPP", value_parser = whole::<u32>(32..=MOST_SAMPLES.into()))]
    pub reference_spp: Option<u32>,
    /// Image size in pixels [default: from the scene, or smaller if the time is short]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Seed of the random numbers; different seeds give independent measurements
    #[arg(long, default_value_t = 0, value_parser = whole::<u64>(0..=u64::MAX))]
    pub seed: u64,
    /// Number of threads; 0 means one per core
    #[arg(long, default_value_t = 0, value_parser = threads)]
    pub threads: usize,
    /// The technique that all others are compared with
    #[arg(long, value_name = "TECHNIQUE", value_parser = named::<Technique>(&Technique::NAMES), hide_possible_values = true, default_value = "area")]
    pub baseline: Technique,
    /// Take at most this many seconds [default: 300; with --quick 60; as long as needed with --long or --spp]
    #[arg(long, value_name = "SECONDS", value_parser = whole::<u64>(0..=u64::MAX))]
    pub time_limit: Option<u64>,
    /// Measure in a minute: few samples, and of series that cannot win, few images
    #[arg(long)]
    pub quick: bool,
    /// Measure all samplers up to 1024 samples per pixel, for as long as that takes
    #[arg(long, conflicts_with = "quick")]
    pub long: bool,
}

impl Options {
    /// The samplers to measure.
    pub(super) fn samplers(&self) -> Vec<Sampler> {
        let some = [Sampler::Independent, Sampler::Sobol, Sampler::Adaptive];
        chosen(&self.samplers, if self.long { &Sampler::ALL } else { &some })
    }

    /// The numbers of samples per pixel to measure, in ascending order.
    pub(super) fn spps(&self) -> Vec<u32> {
        let mut spps: Vec<u32> = match (self.quick, self.long) {
            _ if !self.spp.is_empty() => self.spp.clone(),
            (_, true) => (0..11).map(|k| 1 << k).collect(),
            (true, _) => vec![4, 8, 16, 64],
            _ => (0..5).map(|k| 1 << (2 * k)).collect(),
        };
        spps.sort_unstable();
        spps.dedup();
        spps
    }

    /// The greatest number of seconds to take; `None` if that is not limited.
    pub(super) fn limit(&self) -> Option<u64> {
        let default = match () {
            () if self.quick => Some(60),
            () if self.long || !self.spp.is_empty() => None,
            () => Some(300),
        };
        self.time_limit.or(default)
    }
}

/// The requested values without duplicates, or all values if none is requested.
pub(super) fn chosen<T: Copy + PartialEq>(asked: &[T], all: &[T]) -> Vec<T> {
    let mut list: Vec<T> = Vec::new();
    for &value in if asked.is_empty() { all } else { asked } {
        if !list.contains(&value) {
            list.push(value);
        }
    }
    list
}
