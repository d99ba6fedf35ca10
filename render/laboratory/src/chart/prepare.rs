//! Loads the scenes of a chart and their references, and finds the methods that apply.

use super::measure::{ChartedScene, method};
use super::options::{Options, chosen};
use super::reference::Reference;
use crate::hash::fnv1a;
use crate::progress::bar;
use etendue_render::scene::{Material, Scene};
use etendue_render::{ChoiceBy, Sampler, Settings, Technique, World};
use etendue_scene::Asked;
use std::error::Error;
use std::ffi::OsStr;
use std::io::Write;

/// A technique, and a choice of a light.
pub(super) type Method = (Technique, ChoiceBy);

/// A scene that is loaded, without its reference.
pub(super) struct Loaded {
    pub(super) name: String,
    scene: Scene,
    pub(super) world: World,
    /// Pixels across and down.
    pub(super) size: [u32; 2],
    /// The methods that apply to the scene and differ from one another there.
    pub(super) methods: Vec<Method>,
    /// Remarks for the report.
    pub(super) notes: Vec<String>,
    /// The reference, unless it is to be rendered.
    reference: Option<Reference>,
}

impl Loaded {
    /// Loads a scene, and its reference if it has one.
    pub(super) fn new(options: &Options, path: &OsStr) -> Result<Self, Box<dyn Error>> {
        let asked = Asked { sky: options.environment.clone(), ..Asked::default() };
        let scene = etendue_scene::load_as(path, &asked)?;
        let name = path.to_string_lossy().into_owned();
        let (width, height) = options.size.unwrap_or((scene.film.width, scene.film.height));
        let size = [width, height];
        let is_builtin = etendue_scene::builtin().iter().any(|(builtin, _)| *builtin == name);
        let is_own = is_builtin && options.reference_spp.is_none() && options.environment.is_none();
        let reference = Reference::builtin(&name).filter(|_| is_own).and_then(|r| r.shrunk(size));
        let notes = scene.warnings.iter().map(|w| format!("warning: {w}")).collect();
        let world = World::new(&scene)?;
        let mut loaded = Self { name, scene, world, size, methods: Vec::new(), notes, reference };
        loaded.find_methods(options);
        Ok(loaded)
    }

    /// Whether the reference is still to be rendered.
    pub(super) fn lacks_reference(&self) -> bool {
        self.reference.is_none()
    }

    /// Finds the methods that apply and differ, and notes those that are left out.
    fn find_methods(&mut self, options: &Options) {
        let is_glossy = self.scene.materials.iter().any(Material::is_glossy);
        let choices = chosen(&options.choices, &ChoiceBy::ALL);
        // several choices are compared by one technique, which samples the light that was chosen
        let one = [if is_glossy { Technique::MisLobe } else { Technique::SolidAngle }];
        let techniques = chosen(&options.techniques, if choices.len() > 1 { &one } else { &Technique::ALL });
        let mut images: Vec<Vec<PixelMean>> = Vec::new();
        for (technique, choice) in techniques.iter().flat_map(|t| choices.iter().map(move |c| (*t, *c))) {
            let found = self.probe(technique, choice, is_glossy).and_then(|image| {
                let same = images.iter().position(|other| *other == image).map(|first| self.methods[first]);
                same.map_or(Ok(image), |(technique, choice)| {
                    Err(format!("it gives the same image as {} in this scene", method(technique, choice)))
                })
            });
            match found {
                Ok(image) => {
                    self.methods.push((technique, choice));
                    images.push(image);
                }
                Err(why) => self.notes.push(format!("{}: {} is left out: {why}", self.name, method(technique, choice))),
            }
        }
    }

    /// A remark on images that are smaller than the scene's, if `analytic` is compared there: its proofs hold for squares of pixels, so
    /// that they take the same time for fewer samples.
    pub(super) fn note_on_size(&self, size: [u32; 2]) -> Option<String> {
        let [width, height] = size;
        let film = &self.scene.film;
        let is_analytic = |(technique, _): &Method| *technique == Technique::Analytic;
        let matters = width < film.width && self.methods.len() > 1 && self.methods.iter().any(is_analytic);
        matters.then(|| {
            let whole = format!("{}x{}", film.width, film.height);
            format!(
                "{}: images of {width}x{height} pixels save time; at the scene's {whole}, analytic usually compares better",
                self.name
            )
        })
    }

    /// A small image by a method, or why the method does not apply.
    fn probe(&self, technique: Technique, choice: ChoiceBy, is_glossy: bool) -> Result<Vec<PixelMean>, String> {
        let is_blind = matches!(technique, Technique::UniformHemisphere | Technique::CosineHemisphere);
        if is_blind && is_glossy {
            let why =
                "it finds reflections of lights in this scene's rough metals too rarely for its error to be measured";
            return Err(why.to_owned());
        }
        let [width, height] = self.size.map(|side| side.min(64));
        let (sampler, depth) = (Sampler::Independent, Settings::DEPTH);
        let settings = Settings { width, height, spp: 8, technique, choice, depth, sampler, sets: 1, seed: 1 };
        self.world.check(&settings)?;
        // `auto` chooses by the whole image
        let [width, height] = self.size;
        let technique = self.world.view(&Settings { width, height, ..settings }).technique();
        let film = self.world.render(&Settings { technique, ..settings }, &|_| ()).0;
        Ok(film.pixels.iter().map(|p| p.mean).collect())
    }

    /// The scene at its size, with its reference, which is rendered with `reference_spp` samples per pixel unless there is one. What a
    /// measurement depends on includes the `circumstances`.
    pub(super) fn finish(
        self,
        options: &Options,
        size: [u32; 2],
        reference_spp: u32,
        circumstances: &str,
    ) -> Result<ChartedScene, Box<dyn Error>> {
        let Self { name, scene, world, reference, .. } = self;
        let reference = match reference.and_then(|r| r.shrunk(size)) {
            Some(reference) => reference,
            None => {
                let bar = bar(size.map(u64::from).iter().product(), &format!("reference of {name}"))?;
                let settings = Reference::settings(size, reference_spp, options.quick);
                let reference = Reference::render(&world, &settings, &|done| bar.inc(done));
                bar.finish_and_clear();
                reference
            }
        };
        let mut bytes = Vec::new();
        // what a built-in scene computes is in no file: its settings as text, its mesh as bytes
        let files = scene.digest();
        write!(
            bytes,
            "{files}{:?}{:?}{:?}{circumstances}{}",
            scene.camera, scene.materials, scene.shapes, options.seed
        )?;
        bytes.extend(scene.triangles.iter().flatten().flatten().flat_map(|x| x.to_le_bytes()));
        bytes.extend(scene.triangle_materials.iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend(size.iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend(reference.picture.radiance.iter().flatten().flat_map(|x| x.to_le_bytes()));
        Ok(ChartedScene { name, world, size, settings: fnv1a(&bytes), reference })
    }
}

/// Mean radiance of a pixel.
type PixelMean = [f32; 3];
