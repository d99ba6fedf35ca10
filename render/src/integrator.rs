//! Integrates direct light in packets: camera rays, light samples and shadow rays.

mod adaptive;
mod allocation;
mod analytic;
mod paths;
mod prepared;
mod settings;
mod tile;

pub use analytic::Survey;
pub use settings::{RayCount, Settings};

use crate::bvh::BuildError;
use crate::camera::Camera;
use crate::film::{Film, Pixel, PixelSum};
use crate::sampler::Sampler;
use crate::scene::{CameraSettings, Scene};
use crate::sensor::{Exposure, Sensor};
use crate::sums::{Moments, Sample, Sum};
use crate::technique::Technique;
use adaptive::Effort;
use prepared::PreparedScene;
use rayon::prelude::*;
use settings::TILE;
use std::collections::HashSet;
use tile::TileRenderer;

/// Greatest number of pixels that are looked at to choose a technique.
const PROBES: usize = 256;

/// A scene ready to be rendered.
#[derive(Debug)]
pub struct World {
    scene: PreparedScene,
    camera: CameraSettings,
    /// Diagonal of the film in millimetres.
    diagonal: f64,
    sensor: Sensor,
}

impl World {
    /// Builds the trees and tables of a scene.
    ///
    /// # Errors
    /// Fails if there are more primitives than a tree can index.
    pub fn new(scene: &Scene) -> Result<Self, BuildError> {
        Ok(Self::with(PreparedScene::new(scene)?, scene))
    }

    /// Like [`World::new`], but takes the triangles out of the scene and builds the tree in their memory.
    ///
    /// # Errors
    /// Fails if there are more primitives than a tree can index.
    pub fn from_scene(scene: &mut Scene) -> Result<Self, BuildError> {
        Ok(Self::with(PreparedScene::from_scene(scene)?, scene))
    }

    fn with(prepared: PreparedScene, scene: &Scene) -> Self {
        Self { scene: prepared, camera: scene.camera.clone(), diagonal: scene.film.diagonal, sensor: Sensor::default() }
    }

    /// Size of the trees and their primitives in bytes.
    pub fn bytes(&self) -> usize {
        self.scene.surfaces.bvh.bytes()
    }

    /// The same world, with another sensor.
    #[must_use]
    pub fn with_sensor(self, sensor: Sensor) -> Self {
        Self { sensor, ..self }
    }

    /// The weights of radiance in an image of this size; `None` if the sensor measures radiance itself.
    pub fn exposure(&self, width: u32, height: u32) -> Option<Exposure> {
        Exposure::new(self.sensor, &self.camera, self.diagonal, [width, height])
    }

    /// Renders an image; calls `progress` with the number of newly finished pixels.
    ///
    /// The result depends only on scene and settings, not on the threads.
    pub fn render(&self, settings: &Settings, progress: impl Fn(u64) + Sync) -> (Film, RayCount) {
        self.render_through(&Camera::new(&self.camera, settings.width, settings.height), settings, progress)
    }

    /// Like [`World::render`], with a camera other than the scene's, made for an image of this size.
    pub fn render_through(
        &self,
        camera: &Camera,
        settings: &Settings,
        progress: impl Fn(u64) + Sync,
    ) -> (Film, RayCount) {
        let (width, height) = (settings.width, settings.height);
        let settings = &Settings { technique: self.technique(camera, settings), ..*settings };
        let (pixels, rays) = match settings.sampler {
            Sampler::Adaptive => self.render_adaptively(camera, settings, progress),
            Sampler::Independent => self.render_evenly::<Moments>(camera, settings, progress),
            _ => self.render_evenly::<Sum>(camera, settings, progress),
        };
        (Film { width, height, pixels }, rays)
    }

    /// The technique of an image: a fixed one in place of [`Technique::Auto`].
    ///
    /// [`Technique::Analytic`] is chosen if the lights are known at half of the probes or more, and if these do not all see primitives of
    /// their own: a certificate takes as long as some samples.
    fn technique(&self, camera: &Camera, settings: &Settings) -> Technique {
        if settings.technique != Technique::Auto {
            return settings.technique;
        }
        let (mut probes, mut lights, mut sampled, mut places) = (0, 0, 0, HashSet::new());
        if self.scene.lights.only_few_areas() && !self.scene.surfaces.has_rough() {
            for survey in self.probe(camera, settings) {
                lights += survey.lights();
                sampled += survey.sampled();
                probes += usize::from(survey.place.is_some());
                places.extend(survey.place);
            }
        }
        if probes > 0 && 2 * sampled <= lights && 4 * places.len() <= probes {
            Technique::Analytic
        } else if self.scene.surfaces.has_rough() {
            Technique::MisPower
        } else {
            Technique::SolidAngle
        }
    }

    /// The technique that the scene's camera uses for an image.
    pub fn chosen(&self, settings: &Settings) -> Technique {
        self.technique(&Camera::new(&self.camera, settings.width, settings.height), settings)
    }

    /// What is known of the lights in the middle of each pixel, row by row.
    pub fn survey(&self, camera: &Camera, settings: &Settings) -> Vec<Survey> {
        let settings = &Settings { technique: Technique::Analytic, ..*settings };
        let (surveys, _) = self.tiles(camera, settings, |renderer, [x0, y0, x1, y1]| {
            let pixels: Vec<_> = (y0..y1).flat_map(|y| (x0..x1).map(move |x| [x, y])).collect();
            renderer.begin([x0, y0, x1, y1]);
            renderer.try_out([x0, y0, x1, y1]);
            renderer.survey(&pixels)
        });
        surveys
    }

    /// What is known of the lights in the middle of every tile, or, in large images, of every second, third, … tile: at most [`PROBES`].
    fn probe(&self, camera: &Camera, settings: &Settings) -> Vec<Survey> {
        let settings = &Settings { technique: Technique::Analytic, ..*settings };
        let apart = areas(settings).len().div_ceil(PROBES).max(1);
        let probed = areas(settings).step_by(apart).map(|[x0, y0, x1, y1]| {
            let mut renderer = self.renderer(camera, settings);
            renderer.begin([x0, y0, x1, y1]);
            renderer.survey(&[[x0.midpoint(x1), y0.midpoint(y1)]])[0]
        });
        probed.collect()
    }

    /// Renders the same number of samples for each pixel.
    fn render_evenly<V: Sample>(
        &self,
        camera: &Camera,
        settings: &Settings,
        progress: impl Fn(u64) + Sync,
    ) -> (Vec<Pixel>, RayCount) {
        self.tiles(camera, settings, |renderer, area| {
            let pixels = renderer.range(area, 0..settings.spp, PixelSum::<V>::default());
            progress(pixels.len() as u64);
            pixels
        })
    }

    /// Renders the pilot, then the adaptive samples.
    fn render_adaptively(
        &self,
        camera: &Camera,
        settings: &Settings,
        progress: impl Fn(u64) + Sync,
    ) -> (Vec<Pixel>, RayCount) {
        let width = settings.width;
        let sets = settings.sampler.sets(settings.spp, settings.sets, camera.has_lens());
        let effort = Effort::new(settings.spp, sets);
        let pilot = effort.pilot;
        let (first, mut rays) =
            self.tiles(camera, settings, |renderer, area| renderer.parts(area, [pilot, sets], None, |_| [0, pilot]));
        let (packets, weights) = adaptive::allot(&first, width, sets, &effort);
        let (second, more) = self.tiles(camera, settings, |renderer, area| {
            let range = |[x, y]: [u32; 2]| [pilot, packets[(y * width + x) as usize]];
            let parts = renderer.parts(area, [pilot, sets], weights.as_ref(), range);
            progress(parts.len() as u64);
            parts
        });
        rays += more;
        (first.iter().zip(&second).map(|(a, b)| a.finish(b, sets)).collect(), rays)
    }

    fn renderer<'a>(&'a self, camera: &Camera, settings: &'a Settings) -> TileRenderer<'a> {
        TileRenderer::new(&self.scene, settings, *camera, self.exposure(settings.width, settings.height))
    }

    /// Calls `of` for each tile in parallel and assembles the rows it returns to an image.
    fn tiles<T: Copy + Default + Send>(
        &self,
        camera: &Camera,
        settings: &Settings,
        of: impl Fn(&mut TileRenderer, [u32; 4]) -> Vec<T> + Sync,
    ) -> (Vec<T>, RayCount) {
        let (width, height) = (settings.width, settings.height);
        let rendered: Vec<_> = areas(settings)
            .map(|area| {
                let mut renderer = self.renderer(camera, settings);
                let pixels = of(&mut renderer, area);
                (area, pixels, renderer.count())
            })
            .collect();
        let mut pixels = vec![T::default(); width as usize * height as usize];
        let mut rays = RayCount::default();
        for ([x0, y0, x1, y1], tile, count) in rendered {
            let across = (x1 - x0) as usize;
            for (row, y) in tile.chunks(across).zip(y0..y1) {
                let start = y as usize * width as usize + x0 as usize;
                pixels[start..start + across].copy_from_slice(row);
            }
            rays += count;
        }
        (pixels, rays)
    }
}

/// The area [x0, y0, x1, y1) of each tile of an image.
fn areas(settings: &Settings) -> impl IndexedParallelIterator<Item = [u32; 4]> + use<> {
    let (width, height) = (settings.width, settings.height);
    let columns = width.div_ceil(TILE);
    let tiles = columns as usize * height.div_ceil(TILE) as usize;
    (0..tiles).into_par_iter().map(move |tile| {
        let x = (tile as u32 % columns) * TILE;
        let y = (tile as u32 / columns) * TILE;
        [x, y, (x + TILE).min(width), (y + TILE).min(height)]
    })
}
