//! An image of a scene through a camera: its technique, its samples, and what is known of its lights.

use super::auto::{AutoTrial, TechniqueChoice, Trial, Tried, cost, named};
use super::corners::packets_for;
use super::pixel_counts::{PixelCounts, SamplePlan};
use super::pixel_statistics::Statistics;
use super::specks::specks;
use super::tile::TileRenderer;
use super::world::World;

use crate::bvh::RayCount;
use crate::camera::Camera;
use crate::choose::ChoiceBy;
use crate::film::claim::Foreseen;
use crate::film::sums::{Moments, Sample, Sum};
use crate::film::{Film, Pixel, PixelSum};
use crate::sampler::Sampler;
use crate::scene::area::{self, Area};
use crate::settings::{Settings, tiles};
use crate::technique::Technique;
use rayon::prelude::*;
use std::cmp::Reverse;
use std::fmt::{self, Debug, Formatter};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Greatest number of tiles that are looked at to bound what closed forms leave.
const BOUNDED: usize = 16;

/// What a pass has rendered when it decides how many samples per pixel there are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Begun {
    /// Samples per pixel of the pilot.
    pub(super) pilot: u32,
    /// Samples per pixel of the last tiles that are finished, if any are.
    pub(super) spp: u32,
    /// The part of the time after the pilot that those that are finished take by their counts.
    pub(super) part: f64,
    /// Their samples after the pilot, over the pixels of the image.
    pub(super) samples: f64,
    /// Seconds that they took after the pilot.
    pub(super) seconds: f64,
}

impl Begun {
    /// With tiles that have `spp` samples per pixel, are such a part, and took so long.
    pub(super) fn and(self, spp: u32, part: f64, seconds: f64) -> Self {
        let samples = self.samples + part * f64::from(spp.saturating_sub(self.pilot));
        Self { spp, part: self.part + part, samples, seconds: self.seconds + seconds, ..self }
    }
    /// The mean number of samples per pixel.
    pub(super) fn mean(&self) -> u32 {
        self.pilot + (self.samples / self.part.max(f64::MIN_POSITIVE)).round() as u32
    }
}

/// The groups of scattered tiles that are rendered one after the other where time is given, in eighths of the image.
pub(super) const GROUPS: [Range<u32>; 3] = [0..1, 1..4, 4..8];

/// Which of the eighths of the image a tile is in: no two of one are in a row or column of eight.
const fn scattered([x, y, ..]: Area) -> u32 {
    (x / Settings::TILE + 3 * (y / Settings::TILE) + 5) % 8
}

/// A function that is called with each finished tile: its area, its pixels row by row, and their mean number of samples.
pub type Listener<'a> = &'a (dyn Fn(Area, &[Pixel], u32) + Sync);

/// A [`Listener`] with the `Debug` that functions lack.
#[derive(Clone, Copy)]
struct Told<'a>(Listener<'a>);

impl Debug for Told<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("Told")
    }
}

/// A world seen through a camera, with settings whose technique is fixed: for [`Technique::Auto`], a trial has found it. Nothing that a view
/// returns depends on the number of threads.
///
/// # Panics
/// Whatever renders panics if [`World::check`] fails.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    world: &'a World,
    camera: Camera,
    settings: Settings,
    /// Samples per pixel of the image that decide what is worth knowing: a trial takes fewer.
    worth: u32,
    /// Packets of the pilot, if that has been rendered.
    pilot: Option<u32>,
    trial: Option<AutoTrial>,
    stop: Option<&'a AtomicBool>,
    told: Option<Told<'a>>,
}

impl World {
    /// The image of the scene's camera with these settings.
    ///
    /// # Panics
    /// Panics unless [`Settings::check`] allows them.
    pub fn view(&self, settings: &Settings) -> View<'_> {
        assert_eq!(settings.check(), Ok(()));
        let camera = Camera::new(&self.camera, settings.width, settings.height);
        let worth = settings.spp;
        let (trial, stop, told) = (None, None, None);
        let view = View { world: self, camera, settings: *settings, worth, pilot: None, trial, stop, told };
        if settings.technique != Technique::Auto {
            return view;
        }
        let ((technique, choice), trial) = view.decide();
        View { trial, settings: Settings { technique, choice, ..*settings }, ..view }
    }

    /// Renders the image of the scene's camera, as [`View::image`] does.
    ///
    /// # Panics
    /// Panics unless [`Settings::check`] allows them.
    pub fn render(&self, settings: &Settings, progress: &(dyn Fn(u64) + Sync)) -> (Film, RayCount) {
        self.view(settings).image(progress)
    }
}

impl<'a> View<'a> {
    /// The same, but as soon as `stop` is true, all tiles that have not begun are left as they are: black and without samples, or with those of
    /// the pilot alone.
    #[must_use]
    pub const fn stopped_by(self, stop: &'a AtomicBool) -> Self {
        Self { stop: Some(stop), ..self }
    }

    /// The same, but `listener` receives each tile as soon as its samples are rendered: with [`Sampler::Adaptive`] first with those of the pilot,
    /// and later with all of them.
    #[must_use]
    pub const fn told_to(self, listener: Listener<'a>) -> Self {
        Self { told: Some(Told(listener)), ..self }
    }
}

impl View<'_> {
    /// What `auto` takes, and the trial that found it; without one, the rule.
    fn decide(&self) -> (TechniqueChoice, Option<AutoTrial>) {
        let ways = self.ways();
        let rule = ways[0];
        let Some(mut trial) = Trial::new(ways, &self.settings) else { return (rule, None) };
        loop {
            let next = trial.next();
            if next.is_empty() {
                return trial.best();
            }
            let tried = next
                .into_par_iter()
                .map(|(way, tile)| (way, self.try_tile(&trial.settings(way, &self.settings), tile)));
            for (way, tried) in tried.collect::<Vec<_>>() {
                trial.add(way, tried);
            }
        }
    }

    /// Renders a tile with the settings of a trial.
    fn try_tile(&self, settings: &Settings, tile: Area) -> Tried {
        let view = Self { settings: *settings, ..*self };
        let (pixels, count) = view.render(tile, &|_| ());
        let times = f64::from(self.settings.spp) / f64::from(settings.spp);
        Tried::new(tile, &pixels, cost((settings.technique, settings.choice), self.has_few(), &count, times))
    }

    /// The technique that samples the lights: the one of the settings, or the one taken for [`Technique::Auto`].
    #[must_use]
    pub const fn technique(&self) -> Technique {
        self.settings.technique
    }

    /// The settings, with the technique and the choice of a light that are taken for [`Technique::Auto`].
    #[must_use]
    pub const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The trial that chose them, if there was one.
    #[must_use]
    pub const fn trial(&self) -> Option<&AutoTrial> {
        self.trial.as_ref()
    }

    /// What the time of an image consists of, by its counts: what each part is called, how many nanoseconds one of it takes according to the
    /// weights of [trials](Technique::Auto), and how many there are.
    #[must_use]
    pub fn kinds(&self, count: &RayCount) -> Vec<(&'static str, f64, f64)> {
        named((self.settings.technique, self.settings.choice), self.has_few(), count)
    }

    /// The ways that may be best for [`Technique::Auto`]. The first is taken without a trial: the rule. All others have bounded weights, or none
    /// that they could miss, so that few tiles tell: points uniform over the area of a lamp, and lamps chosen by their power, are not tried.
    /// Uniform over projected solid angle they are bounded where surfaces are diffuse.
    ///
    /// Through a lens most of the error is often that of the image's edges: closed forms then take time that they do not save, and are not the
    /// rule. (By `etendue render SCENE --spp 64 --size 256x256 --threads 1`, `analytic` takes twice as long on `defocus`.) Of lights with
    /// pictures, parallelograms have one.
    fn ways(&self) -> Vec<TechniqueChoice> {
        let (scene, choice) = (&self.world.scene, self.settings.choice);
        let is_rough = scene.surfaces.has_rough();
        let sampled = if is_rough { Technique::MisLobe } else { Technique::SolidAngle };
        let mut ways = vec![(sampled, choice)];
        if self.world.has_closed_forms(&self.settings) {
            let index = if self.camera.has_lens() { 1 } else { 0 };
            ways.insert(index, (Technique::Analytic, choice));
        }
        // no sample is below the horizon, and none counts more than another
        if !is_rough && scene.lights.is_one_projected() {
            ways.push((Technique::ProjectedSolidAngle, choice));
        }
        if choice != ChoiceBy::Auto {
            return ways;
        }
        // lights are then chosen at the points themselves, not at the corners of their pixel
        if self.has_few() {
            ways.push((sampled, ChoiceBy::Spatial));
        }
        if let Some(sky) = &scene.sky {
            // most of it may be hidden, as behind the walls of a room
            if sky.is_soft && scene.lights.len() == 1 {
                ways.push((Technique::Brdf, choice));
            } else if !is_rough {
                ways.push((Technique::MisPower, choice));
            }
        }
        ways
    }

    /// Whether samples can be allocated to a few lights.
    fn has_few(&self) -> bool {
        let lights = &self.world.scene.lights;
        lights.only_few_areas() && lights.len() > 1
    }

    /// What the scene tells of the error of its image, whatever the samples.
    #[must_use]
    pub fn foreseen(&self) -> Foreseen {
        let Settings { width, height, .. } = self.settings;
        let exposure = self.world.exposure(width, height).map_or(1.0, |exposure| exposure.on_axis());
        let specks = specks(&self.world.scene, &self.camera, [width, height], exposure);
        Foreseen { systematic: self.systematic(), specks }
    }

    /// A bound of the error that closed forms leave in an image, whatever its samples: the RMS over pixels and channels. It is
    /// 1e−5 of what the lights that are computed would contribute if nothing hid them, seen from four pixels of some of the tiles.
    fn systematic(&self) -> f64 {
        if !self.world.is_analytic(&self.settings) {
            return 0.0;
        }
        // an odd number, so that not all are in the same columns
        let apart = tiles(self.settings.whole()).count().div_ceil(BOUNDED) | 1;
        let tiles: Vec<Area> = tiles(self.settings.whole()).step_by(apart).collect();
        let tiles = tiles.into_par_iter().map_init(
            || self.renderer(),
            |renderer, area| {
                renderer.begin(area);
                let [x0, y0, x1, y1] = area;
                let quarters = |a: u32, b: u32| [(3 * a + b) / 4, (a + 3 * b) / 4];
                let pixels = quarters(y0, y1).into_iter().flat_map(|y| quarters(x0, x1).map(|x| [x, y]));
                let squares = pixels.flat_map(|pixel| renderer.error_bound(pixel)).map(|x| f64::from(x).powi(2));
                squares.sum::<f64>() / 12.0
            },
        );
        // in order, whatever the threads
        let squares: Vec<f64> = tiles.collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }

    /// Renders the image; calls `progress` with the number of newly finished pixels.
    pub fn image(&self, progress: &(dyn Fn(u64) + Sync)) -> (Film, RayCount) {
        let (pixels, rays) = self.render(self.settings.whole(), progress);
        (Film { width: self.settings.width, height: self.settings.height, pixels }, rays)
    }

    /// Renders the pixels of an area, which must consist of [tiles](Settings::is_of_tiles); calls `progress` with the number of newly finished
    /// ones. With [`Sampler::Adaptive`], the pixels of the area share all samples among themselves, so that they differ from those of a larger
    /// area.
    ///
    /// # Panics
    /// Panics if the area does not consist of tiles.
    pub fn render(&self, area: Area, progress: &(dyn Fn(u64) + Sync)) -> (Vec<Pixel>, RayCount) {
        let (pixels, rays, _) = self.render_up_to(area, progress, None);
        (pixels, rays)
    }

    /// Like [`View::render`], but with [`Sampler::Adaptive`] `grown` decides how many samples per pixel there are, before each of some groups of
    /// scattered tiles. It may depend on time, never on samples. Returns the mean number, too.
    ///
    /// # Panics
    /// Panics if the area does not consist of tiles, or if the image cannot have so many samples.
    pub(super) fn render_up_to(
        &self,
        area: Area,
        progress: &(dyn Fn(u64) + Sync),
        grown: Option<&dyn Fn(Begun) -> u32>,
    ) -> (Vec<Pixel>, RayCount, u32) {
        assert!(self.settings.is_of_tiles(area));
        let mut pixels = vec![Pixel::default(); area::count(area)];
        let (mut pilot, mut spp) = (Vec::new(), self.settings.spp);
        let rays = match self.settings.sampler {
            Sampler::Adaptive => {
                let (found, mut rays) = self.pilot(area);
                pilot = found;
                let plan = self.plan();
                let mut begun =
                    Begun { pilot: 8 * plan.pilot * plan.sets, spp: 0, part: 0.0, samples: 0.0, seconds: 0.0 };
                let mut known = None;
                for eighths in if grown.is_some() { &GROUPS[..] } else { std::slice::from_ref(&(0..8)) } {
                    let spp = grown.map_or(spp, |grown| grown(begun));
                    let settings = Settings { spp, ..self.settings };
                    assert_eq!(settings.check(), Ok(()));
                    let view = Self { settings, pilot: Some(plan.pilot), ..*self };
                    let counts = match known.take() {
                        None => PixelCounts::new(&settings, area, &pilot),
                        Some(counts) if spp == begun.spp => counts,
                        Some(counts) => counts.shared(&settings),
                    };
                    let counts = known.insert(counts);
                    let is_now = |tile: Area| eighths.contains(&scattered(tile));
                    let (part, start) = (counts.part(&is_now), Instant::now());
                    rays += view.rest(counts, progress, &is_now, &mut pixels);
                    begun = begun.and(spp, part, start.elapsed().as_secs_f64());
                }
                if grown.is_some() {
                    spp = begun.mean();
                }
                rays
            }
            Sampler::Independent => self.pixels::<Moments>(area, progress, &mut pixels),
            _ => self.pixels::<Sum>(area, progress, &mut pixels),
        };
        self.fill(&mut pixels, &pilot);
        (pixels, rays, spp)
    }

    /// Renders the samples that follow a pilot in some tiles.
    fn rest(
        &self,
        counts: &PixelCounts<'_>,
        progress: &(dyn Fn(u64) + Sync),
        is_now: &dyn Fn(Area) -> bool,
        pixels: &mut [Pixel],
    ) -> RayCount {
        let (weights, plan) = (counts.weights(), self.plan());
        // the longest first, so that none is left alone at the end
        let mut order: Vec<_> = tiles(counts.area).filter(|&tile| is_now(tile)).collect();
        order.sort_by_cached_key(|&tile| Reverse(counts.time(tile).to_bits()));
        self.tiles(counts.area, order.into_iter(), pixels, &|renderer, tile| {
            let pixels = counts.rest(renderer, tile, weights.as_ref(), &plan);
            self.tell(tile, &pixels);
            progress(pixels.len() as u64);
            pixels
        })
    }

    /// Fills the pixels of tiles that have not begun, since the view was stopped: by the pilot as far as that was rendered. (When that is depends
    /// on time, and never on samples.)
    fn fill(&self, pixels: &mut [Pixel], pilot: &[Statistics]) {
        if self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
            let sets = self.plan().sets;
            let pilot = |i: usize| pilot.get(i).copied().unwrap_or_default().pixel(sets);
            pixels.iter_mut().enumerate().filter(|(_, p)| p.samples == 0).for_each(|(i, p)| *p = pilot(i));
        }
    }

    /// The packets of a pilot after which samples can be counted per light, if there are so few lights.
    fn asked_of_a_pilot(&self) -> Option<u32> {
        let Settings { technique, choice, .. } = self.settings;
        let sampled = self.world.scene.sampled(technique, choice).ok().filter(|_| !technique.finds_lights());
        sampled.and_then(|(_, chooser)| chooser.few()).map(packets_for)
    }

    fn plan(&self) -> SamplePlan {
        let plan = SamplePlan::new(&self.settings);
        // after a pilot that is too small for the lights, all samples choose among them at random
        let before = || plan.with_pilot(self.asked_of_a_pilot().unwrap_or(0));
        self.pilot.map_or_else(before, |packets| plan.after_pilot(packets))
    }

    fn pilot(&self, area: Area) -> (Vec<Statistics>, RayCount) {
        let SamplePlan { sets, pilot, .. } = self.plan();
        let mut all = vec![Statistics::default(); area::count(area)];
        let rays = self.tiles(area, tiles(area), &mut all, &|renderer, area| {
            renderer.begin(area);
            let parts = renderer.parts(area, pilot, 0..sets, None, |_| [0, pilot]);
            if let Some(Told(listener)) = self.told {
                let pixels: Vec<Pixel> = parts.iter().map(|part| part.pixel(sets)).collect();
                listener(area, &pixels, 8 * pilot * sets);
            }
            parts
        });
        (all, rays)
    }

    /// Tells of a tile that has all of its samples.
    fn tell(&self, tile: Area, pixels: &[Pixel]) {
        if let Some(Told(listener)) = self.told {
            listener(tile, pixels, self.settings.spp);
        }
    }

    /// The same number of samples for each pixel.
    fn pixels<V: Sample>(&self, area: Area, progress: &(dyn Fn(u64) + Sync), pixels: &mut [Pixel]) -> RayCount {
        self.tiles(area, tiles(area), pixels, &|renderer, area| {
            let pixels = renderer.all(area, PixelSum::<V>::default());
            self.tell(area, &pixels);
            progress(pixels.len() as u64);
            pixels
        })
    }

    fn renderer(&self) -> TileRenderer<'_> {
        let Settings { width, height, .. } = self.settings;
        let know = self.world.know(&Settings { spp: self.worth, ..self.settings }, &self.camera);
        let is_counted = self.world.scene.lights.len() > 1
            && self.asked_of_a_pilot().is_some_and(|packets| self.plan().pilot >= packets);
        let exposure = self.world.exposure(width, height);
        TileRenderer::new(self.world, &self.settings, self.camera, exposure, know, is_counted)
    }

    /// Calls `of` for each tile, in parallel, and puts the rows it returns into those of the area. Tiles differ in time by orders of magnitude, so
    /// each thread takes the next one as soon as it is free.
    fn tiles<T: Clone + Default + Send>(
        &self,
        area: Area,
        order: impl Iterator<Item = Area> + Send,
        pixels: &mut [T],
        of: &(dyn Fn(&mut TileRenderer, Area) -> Vec<T> + Sync),
    ) -> RayCount {
        let rendered: Vec<_> = order
            .par_bridge()
            .map_init(
                || self.renderer(),
                |renderer, area| {
                    if self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
                        return (area, vec![T::default(); area::count(area)], RayCount::default());
                    }
                    let pixels = of(renderer, area);
                    (area, pixels, renderer.take_count())
                },
            )
            .collect();
        let mut rays = RayCount::default();
        for (part, tile, count) in rendered {
            area::paste(pixels, area, part, tile);
            rays += count;
        }
        rays
    }
}
