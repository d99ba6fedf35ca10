//! The options that say which image is rendered.

use clap::Args;
use etendue_laboratory::options::{named, say, size, threads, whole};
use etendue_laboratory::progress::waiting;
use etendue_render::bvh::BuildError;
use etendue_render::sampler::default_sampler;
use etendue_render::scene::Scene;
use etendue_render::scene::limits::MOST_SAMPLES;
use etendue_render::{ChoiceBy, Sampler, Sensor, Settings, Technique, World};
use etendue_scene::Asked;
use rayon::ThreadPool;
use std::error::Error;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(crate) struct ImageOptions {
    /// Name of a built-in scene, or path of a pbrt-v4 or glTF 2.0 file
    pub(crate) scene: OsString,
    /// Take this many samples per pixel [default: from the scene]
    #[arg(long, value_name = "N", value_parser = whole::<u32>(1..=MOST_SAMPLES.into()))]
    pub(crate) spp: Option<u32>,
    /// Sample the lights by this technique
    #[arg(long, value_parser = named::<Technique>(&Technique::NAMES), default_value = "auto")]
    technique: Technique,
    /// Choose one of the lights in this way
    #[arg(long, value_parser = named::<ChoiceBy>(&ChoiceBy::NAMES), default_value = "auto")]
    choice: ChoiceBy,
    /// Follow a camera ray through at most this many perfect mirrors
    #[arg(long, value_name = "N", default_value_t = Settings::DEPTH, value_parser = whole::<u32>(0..=1024))]
    depth: u32,
    /// Generate the random numbers by this sampler [default: adaptive from 8 samples on, else sobol, or independent for odd numbers]
    #[arg(long, value_parser = named::<Sampler>(&Sampler::NAMES))]
    pub(crate) sampler: Option<Sampler>,
    /// Measure this quantity; irradiance and power need a camera with a lens
    #[arg(long, value_parser = named::<Sensor>(&Sensor::NAMES), default_value = "radiance")]
    pub(crate) sensor: Sensor,
    /// Split the samples of a pixel into this many independent sets: with 1 the error is not known [default: 2 or 4, if the number of samples allows; with adaptive one, and a second one in some pixels]
    #[arg(long, value_name = "1|2|4", value_parser = sets)]
    sets: Option<u32>,
    /// Render an image of this size in pixels [default: from the scene]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// Seed the random numbers with this; different seeds give independent images
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = whole::<u64>(0..=u64::MAX))]
    seed: u64,
    /// Use this many threads; 0 means one per core
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads)]
    pub(crate) threads: usize,
    /// Light the scene by this image of a sky (EXR, HDR, PFM or PNG), instead of its own sky
    #[arg(long, value_name = "FILE")]
    environment: Option<PathBuf>,
    /// Look through this camera of a glTF file: its name, or its number from 0 on [default: the first one]
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
    /// Render this scene of a glTF file: its name, or its number from 0 on [default: that of the file]
    #[arg(long = "scene", value_name = "NAME")]
    scene_of_file: Option<String>,
    /// Fail, rather than substitute unsupported features or ignore misspelt parameters
    #[arg(long)]
    strict: bool,
}

/// Bytes that an image takes for each pixel while it is rendered and written, at most: with the sampler adaptive, and with others.
const BYTES: [u64; 2] = [440, 90];

/// Fails at once if the system does not give the memory that an image of this size takes.
fn check_memory(settings: &Settings) -> Result<(), String> {
    let Settings { width, height, sampler, .. } = *settings;
    let bytes = u64::from(width) * u64::from(height) * BYTES[usize::from(sampler != Sampler::Adaptive)];
    let fits = usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok());
    let gigabytes = bytes as f64 / 1e9;
    let what = || format!("an image of {width}x{height} takes about {gigabytes:.1} GB, which the system does not give");
    if fits { Ok(()) } else { Err(what()) }
}

/// Parses `--sets`.
fn sets(text: &str) -> Result<u32, String> {
    [1, 2, 4].into_iter().find(|n| text == n.to_string()).ok_or_else(|| "must be 1, 2 or 4".to_owned())
}

impl ImageOptions {
    /// Reads the scene, prints its warnings, and completes the settings.
    pub(crate) fn load(&self) -> Result<(Scene, Settings), Box<dyn Error>> {
        let asked =
            Asked { sky: self.environment.clone(), camera: self.camera.clone(), scene: self.scene_of_file.clone() };
        let read = || etendue_scene::load_as(&self.scene, &asked);
        let mut scene = waiting(format!("reading {}", self.scene.display()), read)?;
        if let Some(stand_in) = scene.stand_ins.first().filter(|_| self.strict) {
            return Err(format!("--strict: {stand_in}").into());
        }
        for warning in &scene.warnings {
            say(format_args!("warning: {warning}"));
        }
        let (width, height) = self.size.unwrap_or((scene.film.width, scene.film.height));
        // an image of another size has no place in the whole one
        scene.film.place = scene.film.place.filter(|_| (width, height) == (scene.film.width, scene.film.height));
        let sets = self.sets.unwrap_or(0);
        let spp = self.spp.unwrap_or(scene.pixel_samples);
        if self.sensor != Sensor::Radiance && scene.camera.lens.is_none() {
            let (sensor, scene) = (self.sensor.name(), self.scene.display());
            return Err(format!(
                "--sensor {sensor}: the camera of {scene} is a pinhole: it needs a \"lensradius\" greater than 0"
            )
            .into());
        }
        let settings = Settings {
            width,
            height,
            spp,
            technique: self.technique,
            choice: self.choice,
            depth: self.depth,
            sampler: self.sampler.unwrap_or_else(|| default_sampler(spp, sets)),
            sets,
            seed: self.seed,
        };
        check_memory(&settings)?;
        Ok((scene, settings))
    }

    /// Builds the trees and tables of a scene with these threads.
    pub(crate) fn world(&self, scene: &mut Scene, pool: &ThreadPool) -> Result<World, BuildError> {
        let built = waiting(format!("building {}", scene.name), || pool.install(|| World::from_scene(scene)));
        Ok(built?.with_sensor(self.sensor))
    }

    /// Checks that the sampler supports the number of samples.
    pub(crate) fn check(&self, settings: &Settings) -> Result<(), String> {
        let checked = settings.sampler.check(settings.spp, settings.sets);
        checked.map_err(|what| format!("--sampler: {what}"))
    }

    /// The name of the scene, or of its file without its extension, for files that are named after it.
    pub(crate) fn stem(&self) -> &OsStr {
        Path::new(&self.scene).file_stem().unwrap_or(&self.scene)
    }
}
