//! A row of the table: a scene whose only pixel has one right value.

use etendue_oracle::V3;
use etendue_render::film::compare::LIMIT;
use etendue_render::{Sampler, Settings, Technique, World};
use std::path::Path;

/// f32 holds what a light emits, and where it is, to 6e-8 of itself; some twenty operations follow.
pub(super) const ROUNDING: f64 = 3e-5;
/// Albedo of the floor.
const ALBEDO: f64 = 0.5;

pub(super) enum Text {
    Pbrt(String),
    Gltf(Vec<u8>),
}

/// A scene and its right value.
pub(super) struct Row {
    pub(super) name: String,
    pub(super) text: Text,
    pub(super) right: V3,
    /// How much of the right value it may be off, apart from noise.
    pub(super) tolerance: f64,
    pub(super) samples: u32,
    pub(super) techniques: &'static [Technique],
    /// Whether there is no noise.
    pub(super) is_exact: bool,
    /// What the renderer shows by choice instead, and why.
    pub(super) differs: Option<(V3, &'static str)>,
}

impl Row {
    pub(super) fn new(name: impl Into<String>, text: String, right: V3) -> Self {
        let (name, text) = (name.into(), Text::Pbrt(text));
        let techniques = &[Technique::Auto];
        Self { name, text, right, tolerance: ROUNDING, samples: 64, techniques, is_exact: false, differs: None }
    }
    pub(super) fn within(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }
    pub(super) fn samples(self, samples: u32) -> Self {
        Self { samples, ..self }
    }
    pub(super) fn by(self, techniques: &'static [Technique]) -> Self {
        Self { techniques, ..self }
    }
    /// By every technique, without noise.
    pub(super) fn exactly(self) -> Self {
        Self { techniques: &Technique::ALL, is_exact: true, ..self }
    }
    pub(super) fn differs(self, shown: V3, why: &'static str) -> Self {
        Self { differs: Some((shown, why)), ..self }
    }
    /// What the pixel shows, as a line of the table; an error if that is neither right nor what differs by choice.
    pub(super) fn check(&self, folder: &Path) -> Result<String, String> {
        let name = &self.name;
        let scene = match &self.text {
            Text::Pbrt(text) => etendue_scene::parse(text, "row.pbrt", folder),
            Text::Gltf(text) => etendue_scene::parse_gltf(text, "row.gltf"),
        };
        let scene = scene.map_err(|error| format!("{name}: {error}"))?;
        let world = World::new(&scene).map_err(|error| format!("{name}: {error}"))?;
        let lines: Result<Vec<_>, _> = self.techniques.iter().map(|technique| self.seen(&world, *technique)).collect();
        Ok(lines?.join("\n"))
    }
    fn seen(&self, world: &World, technique: Technique) -> Result<String, String> {
        let name = if self.techniques.len() > 1 { format!("{}, {technique:?}", self.name) } else { self.name.clone() };
        let (sampler, spp) = (Sampler::Independent, self.samples);
        let settings = Settings { width: 1, height: 1, spp, technique, sampler, seed: 5, ..Settings::DEFAULT };
        let pixel = world.render(&settings, &|_| ()).0.pixels[0];
        let (seen, errors) = (pixel.mean.map(f64::from), pixel.variance.map(|v| f64::from(v).sqrt()));
        let (wanted, why) = self.differs.map_or((self.right, ""), |(shown, why)| (shown, why));
        let greatest = wanted.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for k in 0..3 {
            if LIMIT * errors[k] > if self.is_exact { 1e-4 } else { 0.04 } * greatest {
                return Err(format!("{name}: too noisy to tell: {seen:?} ± {errors:?}, right {:?}", self.right));
            }
            let error = (seen[k] - wanted[k]).abs();
            // a value of 0 is exactly that
            if error > self.tolerance * wanted[k].abs() + LIMIT * errors[k] || error.is_nan() {
                return Err(format!("{name}: {seen:?} ± {errors:?}, right {wanted:?} {why}"));
            }
        }
        Ok(format!("{name}: {seen:?}, right {:?} {why}", self.right))
    }
}

pub(super) const fn grey(value: f64) -> V3 {
    [value; 3]
}

pub(super) fn times(color: V3, factor: f64) -> V3 {
    color.map(|x| x * factor)
}

/// Radiance of the floor, where it has this irradiance.
pub(super) fn reflected(irradiance: V3) -> V3 {
    times(irradiance, ALBEDO / std::f64::consts::PI)
}

/// A camera at `eye` that sees `target`, and nothing beside it.
pub(super) fn look(eye: V3, target: V3) -> String {
    let [a, b, c] = eye;
    let [x, y, z] = target;
    format!("LookAt {a} {b} {c} {x} {y} {z} .1 .7 .3 Camera \"perspective\" \"float fov\" 1e-4\nWorldBegin\n")
}

/// The plane z = 0, and one with the albedo.
pub(super) const FLOOR: &str = "Shape \"bilinearmesh\" \"point3 P\" [-900 -900 0  900 -900 0  -900 900 0  900 900 0]\n";
pub(super) const WHITE_FLOOR: &str = "Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]\n\
    Shape \"bilinearmesh\" \"point3 P\" [-900 -900 0  900 -900 0  -900 900 0  900 900 0]\n";

/// A camera that sees the origin on a floor, which is the plane z = 0.
pub(super) fn on_floor(lights: &str) -> String {
    format!("{}{WHITE_FLOOR}{lights}", look([0.01, 0.02, 0.5], [0.0; 3]))
}
