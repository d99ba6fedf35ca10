//! Figures for a lecture on light sampling, each with the numbers it illustrates.

mod certificates;
mod convergence;
mod images;
mod integrals;
mod lights;
mod lobes;
mod shapes;
mod sheet;
mod studio;
mod vignetting;

use crate::interrupt::interrupt;
use clap::{Args, ValueEnum};
use etendue_render::files;
use etendue_render::options::{out, threads, whole};
use std::error::Error;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use studio::{Finding, Studio};

/// Options of `etendue figure`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// The figure to draw
    #[arg(value_enum)]
    pub name: Name,
    /// Folder for NAME.svg
    #[arg(short, long, default_value = "figures")]
    pub output: PathBuf,
    /// Number of threads; 0 means one per core
    #[arg(long, default_value_t = 0, value_parser = threads)]
    pub threads: usize,
    /// Seed of the random numbers; different seeds give independent figures
    #[arg(long, default_value_t = 0, value_parser = whole::<u64>(0..=u64::MAX))]
    pub seed: u64,
    /// Greatest number of lights in light-tree-scaling; 10000000 takes a minute and 1 GB of memory
    #[arg(long, default_value_t = 1_000_000, value_parser = whole::<usize>(0..=u32::MAX.into()))]
    pub most_lights: usize,
}

/// The figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Name {
    /// 16 shadow rays over the hemisphere, or towards the lights
    HemisphereVsArea,
    /// A sphere light sampled by area, or by the cone it subtends
    SphereAreaVsCone,
    /// A triangle light sampled by area, solid angle and projected solid angle
    TriangleAreaVsSolidAngle,
    /// The factors of the integrand over a triangle light
    AreaFactors,
    /// A cap cut by the horizon, sampled by solid angle and by projected solid angle
    CapSolidAngleVsProjected,
    /// How well four samples estimate their own variance
    SampleVariance,
    /// Independent and stratified samples, 1 to 1024 per pixel
    QuadsConvergence,
    /// Importance sampling with a pdf that matches the integrand, and with one that does not
    Importance,
    /// Convergence rates of independent and jittered samples, with their integrands
    Stratification,
    /// Variance and cost of each technique in each scene
    Efficiency,
    /// Pixel and light sampled separately, or jointly
    Padding,
    /// The lens as seen from points of the film, in and out of focus, vignetted by its barrel
    Vignetting,
    /// Pixel, lens and light sampled separately, or jointly
    Defocus,
    /// Where geometry proves that a light is lit, dark, or behind few blockers, and where it must be sampled
    Certificates,
    /// One light on glossy surfaces by every sampler: an atlas of lobes
    Lobes,
    /// Variance and time of a choice among 10³ to 10⁶ lights
    Lights,
    /// A tree of lights as their number grows
    LightTreeScaling,
    /// What the importance of the nodes of a tree of lights is worth
    LightTreeNodes,
    /// Efficiency of the choice between lamps, skies and suns against the size of the floor
    SkyAndLamp,
    /// All figures
    All,
}

impl Studio<'_> {
    fn draw(&self, name: Name) -> Result<Finding, Box<dyn Error>> {
        match name {
            Name::HemisphereVsArea => self.hemisphere_vs_area(),
            Name::SphereAreaVsCone => self.sphere_area_vs_cone(),
            Name::TriangleAreaVsSolidAngle => self.triangle_area_vs_solid_angle(),
            Name::SampleVariance => self.sample_variance(),
            Name::AreaFactors => Ok(shapes::area_factors()),
            Name::CapSolidAngleVsProjected => Ok(shapes::cap_solid_angle_vs_projected()),
            Name::Importance => Ok(integrals::importance(self.seed)),
            Name::Stratification => Ok(integrals::stratification(self.seed)),
            Name::QuadsConvergence => self.quads_convergence(),
            Name::Efficiency => self.efficiency(),
            Name::Padding => self.padding(),
            Name::Vignetting => self.vignetting(),
            Name::Defocus => self.defocus(),
            Name::Certificates => self.certificates(),
            Name::Lobes => Ok(lobes::lobes()),
            Name::Lights => self.lights(),
            Name::LightTreeScaling => Ok(self.light_tree_scaling()),
            Name::LightTreeNodes => self.light_tree_nodes(),
            Name::SkyAndLamp => self.sky_and_lamp(),
            Name::All => Err("all is not one figure".into()),
        }
    }
}

/// Draws one figure or all figures, and prints their numbers.
///
/// # Errors
/// Fails if a file cannot be written, or if Ctrl-C stops it.
pub fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let stop = interrupt()?;
    files::make_folder(&options.output)?;
    let pool = etendue_render::options::pool(options.threads)?;
    let names: Vec<Name> = match options.name {
        Name::All => Name::value_variants().iter().copied().filter(|n| *n != Name::All).collect(),
        one => vec![one],
    };
    let studio = Studio {
        output: &options.output,
        threads: options.threads,
        seed: options.seed,
        most_lights: options.most_lights,
        stop: &stop,
    };
    for name in names {
        let title = etendue_render::options::name(name);
        let finding = pool.install(|| studio.draw(name).map_err(|e| e.to_string()))?;
        if stop.load(Ordering::Relaxed) {
            return Err(format!("interrupted while drawing {title}").into());
        }
        let path = options.output.join(format!("{title}.svg"));
        files::replace(&path, finding.svg.file().as_bytes())?;
        let mut out = out();
        writeln!(out, "{title}: wrote {}", path.display())?;
        for line in &finding.headline {
            writeln!(out, "  {line}")?;
        }
    }
    Ok(())
}
