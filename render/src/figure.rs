//! Figures that a lecture on sampling lights would show, each with the number that it stands for.

mod convergence;
mod images;
mod integrals;
mod shapes;
mod sheet;
mod vignetting;

use crate::{Technique, image};
use clap::{Args, ValueEnum};
use std::error::Error;
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What `etendue figure` is asked for.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Which figure
    #[arg(value_enum)]
    pub name: Name,
    /// The folder to write NAME.svg to
    #[arg(short, long, default_value = "figures")]
    pub output: PathBuf,
    /// Threads; 0 is one per core
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// Figures of different seeds are independent
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
}

/// The figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Name {
    /// 16 shadow rays into the hemisphere, or to the lights
    HemisphereVsArea,
    /// A sphere light by its area, or by the cone that it covers
    SphereAreaVsCone,
    /// A triangle light by its area, its solid angle, and its projected solid angle
    TriangleAreaVsSolidAngle,
    /// What the integrand over a triangle's area is made of
    AreaFactors,
    /// A cap that the horizon cuts, by solid angle and by projected solid angle
    CapSolidAngleVsProjected,
    /// What four samples know of their variance
    SampleVariance,
    /// Independent and stratified samples, 1 to 1024 in a pixel
    QuadsConvergence,
    /// A density like the integrand, and one unlike it
    Importance,
    /// The rates of strata, with their integrands
    Stratification,
    /// Variance and cost of each technique in each scene
    Efficiency,
    /// Pixel and light sampled apart, or together
    Padding,
    /// The lens as points of the film see it, in and out of focus, cut by its barrel
    Vignetting,
    /// Pixel, lens and light sampled apart, or together
    Defocus,
    /// All of them
    All,
}

/// A figure and what it shows.
struct Finding {
    svg: sheet::Svg,
    headline: Vec<String>,
}

/// What figures are made with.
struct Studio<'a> {
    options: &'a Options,
    stop: &'a Arc<AtomicBool>,
}

/// The technique of this name, if this program has it.
fn technique(name: &str) -> Option<Technique> {
    Technique::from_str(name, false).ok()
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
            Name::Importance => Ok(integrals::importance(self.options.seed)),
            Name::Stratification => Ok(integrals::stratification(self.options.seed)),
            Name::QuadsConvergence => self.quads_convergence(),
            Name::Efficiency => self.efficiency(),
            Name::Padding => self.padding(),
            Name::Vignetting => self.vignetting(),
            Name::Defocus => self.defocus(),
            Name::All => Err("all is not one figure".into()),
        }
    }
}

/// Draws a figure or all of them, and says what they show.
///
/// # Errors
/// A file cannot be written.
pub fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let stop = crate::chart::interrupt()?;
    std::fs::create_dir_all(&options.output).map_err(|e| format!("{}: {e}", options.output.display()))?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(options.threads).build()?;
    let names: Vec<Name> = match options.name {
        Name::All => Name::value_variants().iter().copied().filter(|n| *n != Name::All).collect(),
        one => vec![one],
    };
    let studio = Studio { options, stop: &stop };
    for name in names {
        let title = crate::chart::name(name);
        let finding = pool.install(|| studio.draw(name).map_err(|e| e.to_string()))?;
        if stop.load(Ordering::Relaxed) {
            return Err(format!("stopped in the figure {title}").into());
        }
        let path = options.output.join(format!("{title}.svg"));
        image::replace(&path, finding.svg.file().as_bytes())?;
        let mut out = std::io::stdout().lock();
        writeln!(out, "{title}: wrote {}", path.display())?;
        for line in &finding.headline {
            writeln!(out, "  {line}")?;
        }
    }
    Ok(())
}
