//! Which random numbers the error of an image comes from: a table by scene and technique.
//!
//! `cargo run --release -p etendue-benches --example causes -- SCENE… [--size 128] [--spp 64] [--seeds 16]`
//!
//! Scenes are built-in ones or files. Two images with the same seed, of which one draws all pairs of numbers anew but some, share only what
//! these cause: the covariance of both is the part of the variance that they cause alone (Sobol' 1993, "Sensitivity estimates for nonlinear
//! mathematical models"; pick-freeze). So `pixel` is the place in the pixel and on the lens, `point` the point on the light or the
//! direction, `choice` the choice of a light, and `together` is the rest: what only several of them explain. The technique
//! `projected-solid-angle` has no variance on unoccluded diffuse surfaces, so what `point` is there comes from visibility; with
//! `solid-angle` the shape of the light adds to it. The error is the root of the mean variance of the pixels over the mean of the image.
//! Shares have their standard error, from four groups of seeds; negative ones are noise.

use etendue_render::options::name;
use etendue_render::sampler::{CHOICE, FILM, LENS, LIGHT, Redrawn, SURFACE};
use etendue_render::{Sampler, Settings, Technique, World, scene};
use std::process::ExitCode;

const TECHNIQUES: [Technique; 3] = [Technique::SolidAngle, Technique::ProjectedSolidAngle, Technique::Analytic];
/// Names of the causes, and the pairs of each.
const CAUSES: [(&str, &[u32]); 3] = [("pixel", &[FILM, LENS]), ("point", &[LIGHT, SURFACE]), ("choice", &[CHOICE])];
/// Groups of seeds.
const GROUPS: u64 = 4;

struct Options {
    scenes: Vec<String>,
    size: u32,
    spp: u32,
    seeds: u64,
}

fn main() -> ExitCode {
    match options().and_then(|options| run(&options)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

fn options() -> Result<Options, String> {
    let mut options = Options { scenes: Vec::new(), size: 128, spp: 64, seeds: 16 };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        if !argument.starts_with("--") {
            options.scenes.push(argument);
            continue;
        }
        let value = arguments.next().unwrap_or_default();
        let number = value.parse::<u32>().ok().filter(|n| *n > 0);
        let number = number.ok_or_else(|| format!("{argument} needs a whole number greater than 0, not {value:?}"))?;
        match &*argument {
            "--size" => options.size = number,
            "--spp" => options.spp = number,
            "--seeds" => options.seeds = number.into(),
            _ => return Err(format!("unknown option {argument}")),
        }
    }
    if options.scenes.is_empty() {
        return Err("name a scene".into());
    }
    if options.seeds < 2 * GROUPS {
        return Err(format!("--seeds must be at least {}, two in each of {GROUPS} groups", 2 * GROUPS));
    }
    Sampler::Adaptive.check(options.spp, 0, false)?;
    Ok(options)
}

fn run(options: &Options) -> Result<(), String> {
    let columns = CAUSES.map(|(name, _)| format!("{name:>13}")).concat();
    println!("{:22} {:22} {:>8} {columns} {:>13}", "scene", "technique", "error", "together");
    for path in &options.scenes {
        let scene = scene::load(path).map_err(|error| error.to_string())?;
        let mut world = World::new(&scene).map_err(|error| error.to_string())?;
        rows(&scene.name, &mut world, options);
    }
    Ok(())
}

/// The mean colours of an image.
type Image = Vec<[f32; 3]>;

fn rows(scene: &str, world: &mut World, options: &Options) {
    for technique in TECHNIQUES {
        let settings = |seed| Settings {
            width: options.size,
            height: options.size,
            spp: options.spp,
            technique,
            depth: Settings::DEPTH,
            sampler: Sampler::Adaptive,
            sets: 0,
            seed,
        };
        let image = |world: &World, seed| -> Image {
            let (film, _) = world.render(&settings(seed), &|_| ());
            film.pixels.iter().map(|pixel| pixel.mean).collect()
        };
        let mut groups = [[0.0; CAUSES.len() + 2]; GROUPS as usize];
        for (group, row) in (0..GROUPS).zip(&mut groups) {
            let seeds = (options.seeds * group / GROUPS)..(options.seeds * (group + 1) / GROUPS);
            let mut images = |redrawn| -> Vec<Image> {
                world.redraw(redrawn);
                seeds.clone().map(|seed| image(world, seed)).collect()
            };
            let originals = images(Redrawn::default());
            let total = covariance(&originals, &originals);
            row[0] = 100.0 * total.sqrt() / mean(&originals);
            for (share, (_, pairs)) in row[1..].iter_mut().zip(CAUSES) {
                *share = 100.0 * covariance(&originals, &images(Redrawn::all_but(pairs))) / total;
            }
            row[CAUSES.len() + 1] = 100.0 - row[1..=CAUSES.len()].iter().sum::<f64>();
        }
        let statistics = |column: usize| {
            let values = groups.map(|row| row[column]);
            let mean = values.iter().sum::<f64>() / GROUPS as f64;
            let square = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
            (mean, (square / (GROUPS * (GROUPS - 1)) as f64).sqrt())
        };
        let shares: String = (1..CAUSES.len() + 2)
            .map(|column| {
                let (mean, error) = statistics(column);
                format!("{mean:>6.0} ± {error:>2.0} %")
            })
            .collect();
        println!("{scene:22} {:22} {:>6.2} % {shares}", name(technique), statistics(0).0);
    }
    world.redraw(Redrawn::default());
}

fn mean(images: &[Image]) -> f64 {
    let values = images.iter().flatten().flatten();
    values.clone().map(|x| f64::from(*x)).sum::<f64>() / values.count() as f64
}

/// The mean of the pixels' covariances over pairs of images.
fn covariance(a: &[Image], b: &[Image]) -> f64 {
    let count = a.len() as f64;
    let (pixels, mut sum) = (a[0].len(), 0.0);
    for (pixel, channel) in (0..pixels).flat_map(|pixel| (0..3).map(move |channel| (pixel, channel))) {
        let values =
            |images: &[Image]| -> Vec<f64> { images.iter().map(|image| image[pixel][channel].into()).collect() };
        let (x, y) = (values(a), values(b));
        let [mean_x, mean_y] = [&x, &y].map(|values| values.iter().sum::<f64>() / count);
        sum += x.iter().zip(&y).map(|(x, y)| (x - mean_x) * (y - mean_y)).sum::<f64>() / (count - 1.0);
    }
    sum / (3 * pixels) as f64
}
