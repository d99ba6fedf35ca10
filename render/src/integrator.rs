//! Integrates direct light in packets: camera rays, light samples and shadow rays.

mod adaptive;
mod allocation;
mod bsdf;
mod direct;
mod paths;
mod surface;

use crate::bvh::{BuildError, Bvh, GROUP, Hits, Rays, Scratch, ShapeSet};
use crate::camera::{Camera, CameraSample};
use crate::film::{Film, Pixel, PixelSum};
use crate::lights::Lights;
use crate::packet::{M8, V8, X8};
use crate::sampler::{CHOICE, LENS, Packet, Sampler, Source};
use crate::scene::{CameraSettings, Material, Scene, Shape};
use crate::sensor::{Exposure, Sensor};
use crate::sky::Sky;
use crate::technique::Technique;
use adaptive::Effort;
use allocation::{Allocated, Blocks};
use bsdf::Finish;
use direct::keep;
use etendue::{Mask, Real, Vec2, u32x8};
use rayon::prelude::*;
use std::sync::Arc;
use surface::Surface;

/// Everything an image depends on besides the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Pixels across, at least 1.
    pub width: u32,
    /// Pixels down, at least 1.
    pub height: u32,
    /// Samples per pixel, at least 1.
    pub spp: u32,
    /// How to sample the lights.
    pub technique: Technique,
    /// Greatest number of perfect mirrors along a camera ray.
    pub depth: u32,
    /// How to generate the random numbers.
    pub sampler: Sampler,
    /// Independent sets of samples per pixel: 1, 2 or 4, or 0 for as few as give a variance, see [`Sampler::sets`]. The variance of
    /// a pixel is that of the means of its sets; with 1 set it is infinite.
    pub sets: u32,
    /// Seed of the random numbers; different seeds give independent images.
    pub seed: u64,
}

impl Settings {
    /// The default depth.
    pub const DEPTH: u32 = 8;
}

/// Numbers of rays traced for an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCount {
    /// Rays from the camera.
    pub camera: u64,
    /// Rays reflected by mirrors.
    pub mirror: u64,
    /// Rays towards a light, or over the hemisphere to find one.
    pub shadow: u64,
    /// Rays through the corners of pixels, which find the lights that matter there.
    pub corner: u64,
}

/// A scene ready to be rendered.
#[derive(Debug)]
pub struct World {
    bvh: Bvh,
    shapes: Vec<Shape>,
    /// Normals of the shapes; 0 for spheres.
    normals: Vec<[f32; 3]>,
    /// Albedos of the materials; white for metals and mirrors that are not black.
    albedos: Vec<[f32; 3]>,
    finishes: Vec<Finish>,
    /// Material of each triangle in tree order; empty if all have the same.
    place_materials: Vec<u32>,
    /// Material of all triangles if `place_materials` is empty.
    one_material: u32,
    lights: Lights,
    /// The delta lights among `lights`.
    deltas: Lights,
    sky: Option<Arc<Sky>>,
    /// Whether all materials are diffuse.
    only_diffuse: bool,
    camera: CameraSettings,
    /// Diagonal of the film in millimetres.
    diagonal: f64,
    sensor: Sensor,
}

/// Side of the square of pixels that a thread renders at a time.
const TILE: u32 = 16;

impl World {
    /// Builds the trees and tables of a scene.
    ///
    /// # Errors
    /// Fails if there are more primitives than a tree can index.
    pub fn new(scene: &Scene) -> Result<Self, BuildError> {
        let bvh = Bvh::new(&scene.triangles, ShapeSet::new(scene.shapes.iter().map(|s| &s.geometry))?)?;
        Ok(Self::with(scene, bvh))
    }

    /// Like [`World::new`], but takes the triangles out of the scene and builds the tree in their memory.
    ///
    /// # Errors
    /// Fails if there are more primitives than a tree can index.
    pub fn from_scene(scene: &mut Scene) -> Result<Self, BuildError> {
        let shapes = ShapeSet::new(scene.shapes.iter().map(|s| &s.geometry))?;
        let bvh = Bvh::taking(std::mem::take(&mut scene.triangles), shapes)?;
        let world = Self::with(scene, bvh);
        scene.triangle_materials = Vec::new();
        Ok(world)
    }

    fn with(scene: &Scene, bvh: Bvh) -> Self {
        let one = scene.triangle_materials.windows(2).all(|w| w[0] == w[1]);
        let place_materials = if one {
            Vec::new()
        } else {
            bvh.order().iter().map(|&id| scene.triangle_materials[id as usize]).collect()
        };
        let albedo = |material: &Material| match *material {
            Material::Diffuse(albedo) => albedo,
            _ if material.is_black() => [0.0; 3],
            Material::Mirror(_) | Material::Conductor { .. } => [1.0; 3],
        };
        let sky = scene.environment.as_ref().map(|environment| Arc::new(Sky::new(environment)));
        Self {
            lights: Lights::new(scene, sky.clone()),
            deltas: Lights::deltas(scene),
            sky,
            only_diffuse: scene.materials.iter().all(|m| matches!(m, Material::Diffuse(_))),
            normals: scene.shapes.iter().map(|s| s.geometry.normal()).collect(),
            shapes: scene.shapes.clone(),
            camera: scene.camera.clone(),
            diagonal: scene.film.diagonal,
            sensor: Sensor::default(),
            bvh,
            albedos: scene.materials.iter().map(albedo).collect(),
            finishes: scene.materials.iter().map(bsdf::finish).collect(),
            place_materials,
            one_material: scene.triangle_materials.first().copied().unwrap_or(0),
        }
    }

    /// Size of the trees and their primitives in bytes.
    pub fn bytes(&self) -> usize {
        self.bvh.bytes()
    }

    /// Whether the plain integrator suffices: diffuse surfaces and area lights, sampled by a single technique.
    fn plain(&self, technique: Technique) -> bool {
        let one = !matches!(technique, Technique::MisBalance | Technique::MisPower);
        one && self.only_diffuse && self.deltas.is_empty() && self.sky.is_none()
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
        if settings.sampler == Sampler::Adaptive {
            return self.render_adaptively(camera, settings, progress);
        }
        let (tiles, rays) = self.tiles(camera, settings, |work, area| {
            let pixels = work.tile(area);
            progress(pixels.len() as u64);
            pixels
        });
        (Film { width, height, pixels: tiles }, rays)
    }

    /// Renders the pilot, then the adaptive samples.
    fn render_adaptively(
        &self,
        camera: &Camera,
        settings: &Settings,
        progress: impl Fn(u64) + Sync,
    ) -> (Film, RayCount) {
        let (width, height) = (settings.width, settings.height);
        let sets = settings.sampler.sets(settings.spp, settings.sets, camera.has_lens());
        let effort = Effort::new(settings.spp, sets);
        let pilot = effort.pilot;
        let (first, rays) =
            self.tiles(camera, settings, |work, area| work.parts(area, &effort, None, |_, _| [0, pilot]));
        let (packets, weights) = adaptive::allot(&first, width, &effort);
        let (second, more) = self.tiles(camera, settings, |work, area| {
            let parts = work.parts(area, &effort, weights.as_ref(), |x, y| [pilot, packets[(y * width + x) as usize]]);
            progress(parts.len() as u64);
            parts
        });
        let pixels = first.iter().zip(&second).map(|(a, b)| a.finish(b, sets)).collect();
        let rays = RayCount {
            camera: rays.camera + more.camera,
            mirror: rays.mirror + more.mirror,
            shadow: rays.shadow + more.shadow,
            corner: rays.corner + more.corner,
        };
        (Film { width, height, pixels }, rays)
    }

    /// Calls `of` for each tile in parallel and assembles the rows it returns to an image.
    fn tiles<T: Copy + Default + Send>(
        &self,
        camera: &Camera,
        settings: &Settings,
        of: impl Fn(&mut Work, [u32; 4]) -> Vec<T> + Sync,
    ) -> (Vec<T>, RayCount) {
        let (width, height) = (settings.width, settings.height);
        let columns = width.div_ceil(TILE);
        let tiles = columns as usize * height.div_ceil(TILE) as usize;
        let rendered: Vec<_> = (0..tiles)
            .into_par_iter()
            .map(|tile| {
                let x = (tile as u32 % columns) * TILE;
                let y = (tile as u32 / columns) * TILE;
                let area = [x, y, (x + TILE).min(width), (y + TILE).min(height)];
                let mut work = Work::new(self, settings, *camera);
                let pixels = of(&mut work, area);
                (area, pixels, work.count)
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
            rays.camera += count.camera;
            rays.mirror += count.mirror;
            rays.shadow += count.shadow;
            rays.corner += count.corner;
        }
        (pixels, rays)
    }
}

/// Rendering of one tile.
struct Work<'a> {
    world: &'a World,
    settings: &'a Settings,
    camera: Camera,
    exposure: Option<Exposure>,
    /// Whether samples need a point of the lens.
    lens: bool,
    samples: [CameraSample; GROUP],
    source: Source,
    count: RayCount,
    stack: Scratch,
    /// Camera rays and shadow rays of a group.
    rays: Box<[[Rays; GROUP]; 2]>,
    /// Surfaces hit by the camera rays of a group.
    surfaces: Vec<Surface>,
}

/// The pixels of an area [x0, y0, x1, y1) along a Z-order curve, so that successive pixels are close in the image.
fn z_order([x0, y0, x1, y1]: [u32; 4]) -> Vec<[u32; 2]> {
    let even = |i: u32| (0..4).fold(0, |n, bit| n | (i >> (2 * bit) & 1) << bit);
    let all = (0..TILE * TILE).map(|i| [x0 + even(i), y0 + even(i >> 1)]);
    all.filter(|&[x, y]| x < x1 && y < y1).collect()
}

impl<'a> Work<'a> {
    fn new(world: &'a World, settings: &'a Settings, camera: Camera) -> Self {
        let source = Source::new(
            settings.sampler,
            settings.seed,
            settings.spp,
            settings.sets,
            camera.has_lens(),
            settings.width,
        );
        let exposure = world.exposure(settings.width, settings.height);
        Self {
            world,
            settings,
            camera,
            lens: camera.has_lens() || exposure.is_some(),
            samples: [CameraSample { film: Vec2::default(), lens: Vec2::default() }; GROUP],
            exposure,
            source,
            count: RayCount::default(),
            stack: Scratch::default(),
            rays: Box::default(),
            surfaces: Vec::with_capacity(GROUP),
        }
    }

    /// Renders the pixels of an area [x0, y0, x1, y1), row by row.
    fn tile(&mut self, area: [u32; 4]) -> Vec<Pixel> {
        let [x0, y0, x1, _] = area;
        let spp = self.settings.spp;
        let pixels = z_order(area);
        let mut sums = vec![PixelSum::default(); pixels.len()];
        let total = pixels.len() as u64 * u64::from(spp);
        let replicate = self.source.span();
        let span = if replicate == 0 { spp } else { replicate };
        // packets of a single pixel and replicate are summed in lanes, others sample by sample
        let whole = span.is_multiple_of(8);
        let replicate_of = |sample: u32| sample.checked_div(replicate).unwrap_or(0);
        let place = |item: u64| ((item / u64::from(spp)) as usize, (item % u64::from(spp)) as u32);
        let packet = |start: u64| {
            if whole {
                let (pixel, sample) = place(start);
                let [x, y] = pixels[pixel].map(u32x8::splat);
                let replicate = u32x8::splat(replicate_of(sample));
                let sample = u32x8::splat(sample) + u32x8::new([0, 1, 2, 3, 4, 5, 6, 7]);
                return Packet { x, y, sample, replicate, active: M8::splat(true) };
            }
            let lanes: [_; 8] = std::array::from_fn(|k| place((start + k as u64).min(total - 1)));
            let count = (total - start).min(8) as u32;
            Packet {
                x: u32x8::new(lanes.map(|(pixel, _)| pixels[pixel][0])),
                y: u32x8::new(lanes.map(|(pixel, _)| pixels[pixel][1])),
                sample: u32x8::new(lanes.map(|(_, sample)| sample)),
                replicate: u32x8::new(lanes.map(|(_, sample)| replicate_of(sample))),
                active: M8::from_bits((1 << count) - 1),
            }
        };
        let weights = if whole { self.weights(area, span) } else { None };
        let mut blocks = Blocks::new(span);
        let mut allocated = Vec::with_capacity(GROUP);
        let mut packets = Vec::with_capacity(GROUP);
        for start in (0..total).step_by(8 * GROUP) {
            let starts = (start..total).step_by(8).take(GROUP);
            packets.clear();
            packets.extend(starts.clone().map(packet));
            allocated.clear();
            if let Some(weights) = &weights {
                allocated.extend(starts.clone().map(|start| {
                    let (pixel, sample) = place(start);
                    blocks.packet(weights, pixels[pixel], sample % span)
                }));
            }
            let radiance = self.radiance(&packets, &allocated);
            for ((start, packet), radiance) in starts.zip(&packets).zip(radiance) {
                if whole {
                    let (pixel, sample) = place(start);
                    sums[pixel].push_packet(radiance);
                    if replicate != 0 && (sample + 8).is_multiple_of(replicate) {
                        sums[pixel].end_replicate();
                    }
                    continue;
                }
                for k in (0..8).filter(|&k| packet.active.lane(k)) {
                    let (pixel, sample) = place(start + k as u64);
                    sums[pixel].push(radiance.lane(k).into());
                    if replicate != 0 && (sample + 1).is_multiple_of(replicate) {
                        sums[pixel].end_replicate();
                    }
                }
            }
        }
        let mut rows = vec![Pixel::default(); pixels.len()];
        for ([x, y], sum) in pixels.into_iter().zip(&mut sums) {
            rows[((y - y0) * (x1 - x0) + (x - x0)) as usize] = sum.finish();
        }
        rows
    }

    /// Measured values of the samples of a group of packets. `allocated` is empty, or allocates each sample to a light.
    fn radiance(&mut self, packets: &[Packet], allocated: &[Allocated]) -> [V8; GROUP] {
        let plain = self.world.plain(self.settings.technique);
        let mut radiance = if plain { self.group(packets, allocated) } else { self.paths(packets) };
        for (radiance, sample) in radiance.iter_mut().zip(&self.samples[..packets.len()]) {
            if let Some(open) = self.camera.open(sample) {
                *radiance = keep(*radiance, open);
            }
            if let Some(exposure) = &self.exposure {
                *radiance = *radiance * exposure.weight(sample);
            }
        }
        radiance
    }

    /// Radiance of the samples of a group of packets by the plain integrator.
    fn group(&mut self, packets: &[Packet], allocated: &[Allocated]) -> [V8; GROUP] {
        let world = self.world;
        let count = packets.len();
        let mut light = [Vec2::default(); GROUP];
        let rays = &mut self.rays[0];
        let mut active = [M8::splat(false); GROUP];
        let mut hits = [Hits::none(X8::lit(f64::INFINITY)); GROUP];
        for (p, packet) in packets.iter().enumerate() {
            let [film, second] = match allocated.get(p) {
                Some(allocated) => self.source.film_and_light_of(packet, allocated.light, allocated.sample),
                None => self.source.film_and_light(packet),
            };
            let lens = self.lens.then(|| self.source.pair(packet, LENS));
            self.samples[p] = CameraSample::new(packet.x, packet.y, film, lens);
            let (origin, direction) = self.camera.rays(&self.samples[p]);
            light[p] = second;
            rays[p] = world.bvh.rays(origin, direction);
            active[p] = packet.active;
            self.count.camera += u64::from(packet.active.bits().count_ones());
        }
        world.bvh.closest(&rays[..count], &active[..count], &mut hits[..count], &mut self.stack);

        let mut radiance = [V8::default(); GROUP];
        let mut surfaces = std::mem::take(&mut self.surfaces);
        surfaces.clear();
        surfaces.extend(hits[..count].iter().zip(&*rays).map(|(hits, rays)| world.surface(hits, rays)));
        for (radiance, surface) in radiance.iter_mut().zip(&surfaces) {
            *radiance = surface.emission;
        }
        if world.lights.is_empty() {
            return radiance;
        }
        let reflected = match self.settings.technique {
            Technique::Area | Technique::SolidAngle | Technique::ProjectedSolidAngle => {
                let choice = world.lights.many().then(|| {
                    let mut choice = [X8::lit(0.0); GROUP];
                    for (p, packet) in packets.iter().enumerate() {
                        choice[p] = self.source.pair(packet, CHOICE).x;
                    }
                    choice
                });
                self.light(&surfaces, light, allocated, choice)
            }
            Technique::UniformHemisphere => self.hemisphere(&surfaces, light, false),
            Technique::CosineHemisphere | Technique::Brdf => self.hemisphere(&surfaces, light, true),
            Technique::MisBalance | Technique::MisPower => {
                unreachable!("the plain integrator does not combine techniques")
            }
        };
        for p in 0..count {
            radiance[p] += reflected[p];
        }
        self.surfaces = surfaces;
        radiance
    }
}
