//! How well lights of several kinds are chosen: the efficiency of the renderer's choice over that of the better of two pure ones, which are
//! known from images of each kind alone.

use super::bridge::sources;
use super::build::{facing, floor, quad};
use super::draft::{Draft, Finish, Form, Glow, Kind, Look, Measure, Part, Source, V3};
use super::judge::read;
use super::regimes::Regime;
use crate::random::Random;
use etendue_oracle::{cross, direct, length, sub};
use etendue_render::film::Film;
use etendue_render::{Sampler, Settings, Technique, World};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::fmt::{self, Display, Formatter};
use std::ops::Range;

/// A reference has this many times the samples, and there are two of them.
const FINER: u32 = 16;
/// Images of the renderer.
const SEEDS: u64 = 4;
/// The least efficiency that a choice should have, relative to the better of the pure ones, …
pub const LEAST: f64 = 0.5;
/// … unless it has this one. Where one kind gives all the light without noise, as a sun does, its pure choice has no error. Of three kinds it
/// has at least 0.6 of the samples, so that the choice has a relative squared error of 0.67 over their number.
const ENOUGH: f64 = 1.5;

/// Efficiency of choices, each 1/(squared error × samples) relative to the squared radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The renderer's.
    pub own: f64,
    /// The same chance for each kind.
    pub equal: f64,
    /// Each kind by its power.
    pub by_power: f64,
}

impl Choice {
    /// The renderer's efficiency relative to the better of the others.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.own / self.equal.max(self.by_power)
    }
    /// Whether it is worse than it may be.
    #[must_use]
    pub fn is_poor(&self) -> bool {
        self.ratio() < LEAST && self.own < ENOUGH
    }
}

/// What the scenes of a regime have shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Tally {
    /// Name of the regime.
    pub regime: &'static str,
    /// The efficiency in each scene that has lights of several kinds, with its seed, in ascending order of ratios.
    pub choices: Vec<(Choice, u64)>,
}

/// The kinds of lights: those that are somewhere, skies, and suns.
fn kind(source: &Source) -> usize {
    match source.kind {
        Kind::Point(_) | Kind::Spot(..) => 0,
        Kind::Sky => 1,
        Kind::Distant(_) => 2,
    }
}

/// The power of each kind, as what enters a sphere around all surfaces.
fn powers(draft: &Draft) -> [f64; 3] {
    let (mut powers, mut low, mut high) = ([0.0; 3], [f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let mut hold = |p: V3, radius: f64| {
        low = [0, 1, 2].map(|k| low[k].min(p[k] - radius));
        high = [0, 1, 2].map(|k| high[k].max(p[k] + radius));
    };
    for part in &draft.parts {
        let area = match &part.form {
            Form::Sphere(center, radius) => {
                hold(*center, *radius);
                4.0 * PI * radius * radius
            }
            Form::Parallelogram(p, u, v) => {
                let far = [0, 1, 2].map(|k| p[k] + u[k] + v[k]);
                hold(*p, 0.0);
                hold(far, 0.0);
                length(cross(*u, *v))
            }
            form => {
                form.triangles().as_flattened().iter().for_each(|p| hold(*p, 0.0));
                form.triangles().iter().map(|[a, b, c]| 0.5 * length(cross(sub(*b, *a), sub(*c, *a)))).sum()
            }
        };
        let sides = |glow: Glow| if glow.two_sided { 2.0 } else { 1.0 };
        powers[0] += part.glow.map_or(0.0, |glow| PI * area * sides(glow) * f64::from(glow.radiance));
    }
    let squared = PI * 0.25 * (0..3).map(|k| (high[k] - low[k]).powi(2)).sum::<f64>();
    for (source, exact) in draft.sources.iter().zip(sources(&draft.sources)) {
        powers[kind(source)] += match exact {
            direct::Source::Point { intensity, cone, .. } => {
                let versines = |cone: direct::Cone| cone.angles.map(|angle| 1.0 - libm::cos(angle)).iter().sum::<f64>();
                PI * intensity * cone.map_or(4.0, versines)
            }
            direct::Source::Distant { irradiance, .. } => irradiance * squared,
            direct::Source::Sky(sky) => sky.flux() * squared,
        };
    }
    powers
}

/// Measures the choice at so many samples per pixel, by one sample of a light each; `None` if the lights are of one kind, or if nothing is
/// lit.
///
/// # Errors
/// Fails if the scene cannot be rendered.
pub fn measure(draft: &Draft, [side, spp]: [u32; 2], seed: u64) -> Result<Option<Choice>, String> {
    let draft = draft.meant();
    let only = |which: usize| {
        let mut only = if which == 0 { draft.clone() } else { draft.dark() };
        only.sources = draft.sources.iter().filter(|source| kind(source) == which).cloned().collect();
        only
    };
    let powers = powers(&draft);
    let kinds: Vec<usize> = (0..3).filter(|&kind| powers[kind] > 0.0).collect();
    if kinds.len() < 2 {
        return Ok(None);
    }
    let image = |draft: &Draft, spp: u32, seed: u64| -> Result<Film, String> {
        let world = World::new(&read(draft)?).map_err(|error| error.to_string())?;
        let settings = Settings {
            width: side,
            height: side,
            spp,
            technique: Technique::SolidAngle,
            sampler: Sampler::Independent,
            seed,
            ..Settings::DEFAULT
        };
        Ok(world.render(&settings, &|_| ()).0)
    };
    let base = seed.wrapping_mul(0x9e37_79b9) << 8;
    let pair = |&kind: &usize| -> Result<[Film; 2], String> {
        let alone = only(kind);
        let of = |k: u64| image(&alone, FINER * spp, base + 2 * kind as u64 + k);
        Ok([of(0)?, of(1)?])
    };
    let alone: Vec<[Film; 2]> = kinds.iter().map(pair).collect::<Result<_, _>>()?;
    // what the camera sees of lights is not chosen
    let mut black = draft.clone();
    black.parts.iter_mut().for_each(|part| {
        part.finish = Finish::Diffuse(0.0);
        part.skin.albedo = None;
    });
    let seen = image(&black, 64, base + 100)?;
    let own = (0..SEEDS).map(|k| image(&draft, spp, base + 200 + k)).collect::<Result<Vec<_>, _>>()?;
    let all: f64 = powers.iter().sum();
    let chances =
        [kinds.iter().map(|_| 1.0 / kinds.len() as f64).collect(), kinds.iter().map(|&k| powers[k] / all).collect()];
    let chances: [Vec<f64>; 2] = chances;
    let (mut errors, mut square) = ([0.0; 3], 0.0);
    for i in (0..seen.pixels.len()).filter(|&i| seen.pixels[i].mean[1] == 0.0) {
        let value = |film: &Film| f64::from(film.pixels[i].mean[1]);
        let [a, b] = [0, 1].map(|k| alone.iter().map(|pair| value(&pair[k])).sum::<f64>());
        square += a * b;
        errors[0] += own.iter().map(|film| (value(film) - a) * (value(film) - b)).sum::<f64>() / SEEDS as f64;
        for (error, chances) in errors[1..].iter_mut().zip(&chances) {
            // the second moment of one sample, over the chance to take it
            let moment =
                |film: &Film| f64::from(film.pixels[i].variance[1]) * f64::from(FINER * spp) + value(film).powi(2);
            let moments = alone.iter().map(|[a, b]| 0.5 * (moment(a) + moment(b)));
            *error +=
                (moments.zip(chances).map(|(moment, chance)| moment / chance).sum::<f64>() - a * b) / f64::from(spp);
        }
    }
    let [own, equal, by_power] = errors.map(|error| square / (error * f64::from(spp)));
    Ok((square > 0.0 && own > 0.0).then_some(Choice { own, equal, by_power }))
}

/// Measures the scenes of a regime with these seeds, on the threads of the current pool.
///
/// # Errors
/// Fails if a scene cannot be rendered.
pub fn run(regime: &Regime, seeds: Range<u64>, quality: [u32; 2]) -> Result<Tally, String> {
    let of = |seed: u64| Ok(measure(&regime.draft(seed), quality, seed)?.map(|choice| (choice, seed)));
    let found = seeds.into_par_iter().map(of).collect::<Result<Vec<_>, String>>()?;
    let mut choices: Vec<(Choice, u64)> = found.into_iter().flatten().collect();
    choices.sort_by(|a, b| a.0.ratio().total_cmp(&b.0.ratio()));
    Ok(Tally { regime: regime.name, choices })
}

impl Display for Tally {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{:13} {:5} scenes with lights of several kinds", self.regime, self.choices.len())?;
        if self.choices.is_empty() {
            return Ok(());
        }
        let middle = self.choices[self.choices.len() / 2].0.ratio();
        write!(f, ", efficiency over that of the better pure choice: median {middle:.3}")?;
        let poor = self.choices.iter().filter(|(choice, _)| choice.is_poor()).count();
        let below = self.choices.iter().filter(|(choice, _)| choice.ratio() < LEAST).count();
        let rest = &self.choices[below..];
        if let Some((least, seed)) = rest.first() {
            write!(f, ", least {:.3} ({seed})", least.ratio())?;
        }
        write!(f, ", {below} below {LEAST}, of which {poor} have an error")?;
        for (choice, seed) in &self.choices[..below] {
            write!(f, "; {seed}: {:.3} at an efficiency of {:.2}", choice.ratio(), choice.own)?;
        }
        Ok(())
    }
}

/// A lamp above a floor, and how it is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lamp {
    /// 1 × 1 at a height of 2.
    Panel,
    /// A sphere of radius 0.02 at a height of 0.5.
    Candle,
    /// A point.
    Bulb,
}

/// Scenes with lights of several kinds: a lamp, the radiance of a sky, and a number of suns.
pub const STAGES: [(&str, Lamp, f32, usize); 6] = [
    ("sky and panel", Lamp::Panel, 1.0, 0),
    ("sky and candle", Lamp::Candle, 1.0, 0),
    ("sky and bulb", Lamp::Bulb, 1.0, 0),
    ("sun and panel", Lamp::Panel, 0.0, 1),
    ("sun and bulb", Lamp::Bulb, 0.0, 1),
    ("sky, twenty suns and panel", Lamp::Panel, 1.0, 20),
];

/// The scene of one of [`STAGES`] over a floor of this half size, with a ball and a box beside the camera's target.
#[must_use]
pub fn stage((name, lamp, sky, suns): (&str, Lamp, f32, usize), half: f64) -> Draft {
    let random = &mut Random::new(1);
    let eye = [0.0, 2.0, 3.0];
    let look = Look { eye, target: [0.0; 3], up: [0.0, 1.0, 0.0], fov: 20.0, lens: None, frame: None };
    let screen = quad([-0.4, 0.3, -0.2], [0.3, 0.0, 0.0], [0.0, 0.0, 0.3]);
    let parts = vec![floor(half, random), Part::ball([0.3, 0.15, 0.0], 0.15, 0.5), Part::mesh(screen, 0.5)];
    let mut draft = Draft::new(name.to_owned(), look, parts);
    let mut add = |kind: Kind, strength: f32| {
        draft.sources.push(Source { kind, strength, measure: Measure::default(), map: None, picture: None });
    };
    match lamp {
        Lamp::Panel => {
            draft.parts.push(Part::light(facing([0.0, 2.0, 0.0], [0.0; 3], [1.0; 2], random), 5.0, false));
        }
        Lamp::Candle => draft.parts.push(Part::light(Form::Sphere([-0.3, 0.5, 0.0], 0.02), 500.0, false)),
        Lamp::Bulb => add(Kind::Point([-0.3, 1.0, 0.0]), 2.0),
    }
    if sky > 0.0 {
        add(Kind::Sky, sky);
    }
    for _ in 0..suns {
        let from = [random.between(-0.5, 0.5), 1.0, random.between(-0.5, 0.5)];
        add(Kind::Distant([from, [0.0; 3]]), 3.0 / suns as f32);
    }
    draft
}
