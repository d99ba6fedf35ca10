//! Integrates direct light in packets: camera rays, light samples and shadow rays.

mod adaptive;
mod allocation;
mod analytic;
mod paths;
mod prepared;
mod settings;
mod tile;

pub use adaptive::{Allotment, Statistics};
pub use allocation::APART;
pub use analytic::Survey;
pub use settings::{RayCount, Settings};

use crate::area;
use crate::area::Area;
use crate::bvh::BuildError;
use crate::camera::Camera;
use crate::film::{BlockSum, Film, Pixel, PixelSum};
use crate::sampler::Sampler;
use crate::scene::{CameraSettings, Scene};
use crate::sensor::{Exposure, Sensor};
use crate::sums::{Moments, Planes, Sample, Sum};
use crate::technique::Technique;
use adaptive::Effort;
use prepared::PreparedScene;
use rayon::prelude::*;
use settings::TILE;
use std::collections::HashSet;
use std::ops::Range;
use tile::TileRenderer;

/// Greatest number of pixels that are looked at to choose a technique.
const PROBES: usize = 256;
/// Greatest number of tiles that are looked at to bound what closed forms leave.
const BOUNDED: usize = 16;

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
            Sampler::Independent => self.render_evenly::<Moments>(camera, settings, settings.whole(), progress),
            _ => self.render_evenly::<Sum>(camera, settings, settings.whole(), progress),
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

    /// A bound of the error that closed forms leave in an image, whatever its samples: the RMS over pixels and channels. It is
    /// 1e−5 of what the lights that are computed would contribute if nothing hid them, seen from four pixels of some of the tiles.
    pub fn systematic(&self, settings: &Settings) -> f64 {
        let (camera, settings) = self.resolve(settings);
        if !settings.technique.is_analytic(self.scene.lights.only_few_areas()) {
            return 0.0;
        }
        // an odd number, so that not all are in the same columns
        let apart = areas(settings.whole()).len().div_ceil(BOUNDED) | 1;
        let tiles = areas(settings.whole()).step_by(apart);
        let tiles = tiles.map_init(
            || self.renderer(&camera, &settings),
            |renderer, area| {
                renderer.begin(area);
                renderer.try_out(area);
                let [x0, y0, x1, y1] = area;
                let quarters = |a: u32, b: u32| [(3 * a + b) / 4, (a + 3 * b) / 4];
                let pixels = quarters(y0, y1).into_iter().flat_map(|y| quarters(x0, x1).map(|x| [x, y]));
                let squares = pixels.flat_map(|pixel| renderer.doubt(pixel)).map(|x| f64::from(x).powi(2));
                squares.sum::<f64>() / 12.0
            },
        );
        // in order, whatever the threads
        let squares: Vec<f64> = tiles.collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }

    /// What is known of the lights in the middle of each pixel, row by row.
    pub fn survey(&self, camera: &Camera, settings: &Settings) -> Vec<Survey> {
        let settings = &Settings { technique: Technique::Analytic, ..*settings };
        let (surveys, _) = self.tiles(camera, settings, settings.whole(), |renderer, [x0, y0, x1, y1]| {
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
        let apart = areas(settings.whole()).len().div_ceil(PROBES).max(1);
        let probed = areas(settings.whole()).step_by(apart);
        let probed = probed.map_init(
            || self.renderer(camera, settings),
            |renderer, [x0, y0, x1, y1]| {
                renderer.begin([x0, y0, x1, y1]);
                renderer.survey(&[[x0.midpoint(x1), y0.midpoint(y1)]])[0]
            },
        );
        probed.collect()
    }

    /// Renders the same number of samples for each pixel.
    fn render_evenly<V: Sample>(
        &self,
        camera: &Camera,
        settings: &Settings,
        area: Area,
        progress: impl Fn(u64) + Sync,
    ) -> (Vec<Pixel>, RayCount) {
        self.tiles(camera, settings, area, |renderer, area| {
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
        let (pilot, mut rays) = self.pilot(camera, settings, settings.whole(), |_| {});
        let (pixels, more) =
            self.rest(camera, settings, &Allotment::new(settings, camera.has_lens(), &pilot), progress);
        rays += more;
        (pixels, rays)
    }

    /// Sets of each pixel, and the effort of adaptive sampling.
    fn effort(camera: &Camera, settings: &Settings) -> (u32, Effort) {
        let sets = settings.sampler.sets(settings.spp, settings.sets, camera.has_lens());
        (sets, Effort::new(settings.spp, sets))
    }

    fn pilot(
        &self,
        camera: &Camera,
        settings: &Settings,
        area: Area,
        progress: impl Fn(u64) + Sync,
    ) -> (Vec<Statistics>, RayCount) {
        let (sets, Effort { pilot, .. }) = Self::effort(camera, settings);
        self.tiles(camera, settings, area, |renderer, area| {
            let parts = renderer.parts(area, [pilot, sets], None, |_| [0, pilot]);
            progress(parts.len() as u64);
            parts
        })
    }

    fn rest(
        &self,
        camera: &Camera,
        settings: &Settings,
        allotment: &Allotment,
        progress: impl Fn(u64) + Sync,
    ) -> (Vec<Pixel>, RayCount) {
        let (sets, Effort { pilot, .. }) = Self::effort(camera, settings);
        let weights = allotment.weights();
        let [x0, y0, x1, _] = allotment.area;
        let index = |x: u32, y: u32| ((y - y0) * (x1 - x0) + (x - x0)) as usize;
        self.tiles(camera, settings, allotment.area, |renderer, area| {
            let range = |[x, y]: [u32; 2]| [pilot, allotment.packets[index(x, y)]];
            let rest = renderer.parts(area, [pilot, sets], weights.as_ref(), range);
            progress(rest.len() as u64);
            let [x0, y0, x1, y1] = area;
            let places = (y0..y1).flat_map(|y| (x0..x1).map(move |x| (x, y)));
            places.zip(&rest).map(|((x, y), rest)| allotment.finish(index(x, y), rest, sets)).collect()
        })
    }

    /// Renders a range of the samples of the pixels of an area: the largest blocks of samples in it, and their sums. The area must
    /// consist of [tiles](Settings::is_of_tiles).
    ///
    /// # Panics
    /// Panics if the sampler is [`Sampler::Adaptive`], or if area or range are not within the image and its samples.
    pub fn render_range(
        &self,
        settings: &Settings,
        area: Area,
        range: Range<u32>,
        progress: impl Fn(u64) + Sync,
    ) -> (Vec<Planes>, RayCount) {
        assert!(settings.is_of_tiles(area) && range.end <= settings.spp && settings.sampler != Sampler::Adaptive);
        if settings.sampler == Sampler::Independent {
            self.planes::<Moments>(settings, area, &range, progress)
        } else {
            self.planes::<Sum>(settings, area, &range, progress)
        }
    }

    fn planes<V: Sample>(
        &self,
        settings: &Settings,
        area: Area,
        range: &Range<u32>,
        progress: impl Fn(u64) + Sync,
    ) -> (Vec<Planes>, RayCount) {
        let (camera, settings) = self.resolve(settings);
        let (pixels, rays) = self.tiles(&camera, &settings, area, |renderer, area| {
            let pixels = renderer.range(area, range.clone(), BlockSum::<V>::default());
            progress(pixels.len() as u64);
            pixels
        });
        let moments = |block: usize| pixels.iter().map(move |pixel: &Vec<V>| pixel[block].moments());
        let planes = |block: usize| Planes {
            sums: moments(block).map(|moments| moments.sum).collect(),
            squares: if V::INDEPENDENT { moments(block).map(|moments| moments.squares).collect() } else { Vec::new() },
        };
        ((0..pixels.first().map_or(0, Vec::len)).map(planes).collect(), rays)
    }

    /// Renders all samples of the pixels of an area, which must consist of [tiles](Settings::is_of_tiles).
    ///
    /// # Panics
    /// Panics if the sampler is [`Sampler::Adaptive`], or if the area does not consist of tiles.
    pub fn render_area(
        &self,
        settings: &Settings,
        area: Area,
        progress: impl Fn(u64) + Sync,
    ) -> (Vec<Pixel>, RayCount) {
        assert!(settings.is_of_tiles(area) && settings.sampler != Sampler::Adaptive);
        let (camera, settings) = self.resolve(settings);
        if settings.sampler == Sampler::Independent {
            self.render_evenly::<Moments>(&camera, &settings, area, progress)
        } else {
            self.render_evenly::<Sum>(&camera, &settings, area, progress)
        }
    }

    /// Renders the pilot of [`Sampler::Adaptive`] for the pixels of an area, which must consist of [tiles](Settings::is_of_tiles).
    ///
    /// # Panics
    /// Panics if the sampler is another, or if the area does not consist of tiles.
    pub fn render_pilot(
        &self,
        settings: &Settings,
        area: Area,
        progress: impl Fn(u64) + Sync,
    ) -> (Vec<Statistics>, RayCount) {
        assert!(settings.is_of_tiles(area) && settings.sampler == Sampler::Adaptive);
        let (camera, settings) = self.resolve(settings);
        self.pilot(&camera, &settings, area, progress)
    }

    /// Renders the samples after the pilot of [`Sampler::Adaptive`] in the area of an allotment, which must consist of
    /// [tiles](Settings::is_of_tiles). Returns the finished pixels.
    ///
    /// # Panics
    /// Panics if the sampler is another, or if the area does not consist of tiles.
    pub fn render_rest(
        &self,
        settings: &Settings,
        allotment: &Allotment,
        progress: impl Fn(u64) + Sync,
    ) -> (Vec<Pixel>, RayCount) {
        assert!(settings.is_of_tiles(allotment.area) && settings.sampler == Sampler::Adaptive);
        let (camera, settings) = self.resolve(settings);
        self.rest(&camera, &settings, allotment, progress)
    }

    /// The scene's camera for an image, and its settings with a fixed technique.
    fn resolve(&self, settings: &Settings) -> (Camera, Settings) {
        let camera = Camera::new(&self.camera, settings.width, settings.height);
        (camera, Settings { technique: self.technique(&camera, settings), ..*settings })
    }

    fn renderer<'a>(&'a self, camera: &Camera, settings: &'a Settings) -> TileRenderer<'a> {
        TileRenderer::new(&self.scene, settings, *camera, self.exposure(settings.width, settings.height))
    }

    /// Calls `of` for each tile in parallel and assembles the rows it returns to an image.
    fn tiles<T: Clone + Default + Send>(
        &self,
        camera: &Camera,
        settings: &Settings,
        area: Area,
        of: impl Fn(&mut TileRenderer, Area) -> Vec<T> + Sync,
    ) -> (Vec<T>, RayCount) {
        let rendered: Vec<_> = areas(area)
            .map_init(
                || self.renderer(camera, settings),
                |renderer, area| {
                    let pixels = of(renderer, area);
                    (area, pixels, renderer.take_count())
                },
            )
            .collect();
        let mut pixels = vec![T::default(); area::count(area)];
        let mut rays = RayCount::default();
        for (part, tile, count) in rendered {
            area::paste(&mut pixels, area, part, tile);
            rays += count;
        }
        (pixels, rays)
    }
}

/// The area [x0, y0, x1, y1) of each tile of an area that consists of tiles.
fn areas([left, top, right, bottom]: Area) -> impl IndexedParallelIterator<Item = Area> + use<> {
    let columns = (right - left).div_ceil(TILE);
    let tiles = columns as usize * (bottom - top).div_ceil(TILE) as usize;
    (0..tiles).into_par_iter().map(move |tile| {
        let x = left + (tile as u32 % columns) * TILE;
        let y = top + (tile as u32 / columns) * TILE;
        [x, y, (x + TILE).min(right), (y + TILE).min(bottom)]
    })
}
