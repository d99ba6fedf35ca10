//! Direct light, in packets: camera rays, light samples, shadow rays.

use crate::accel::{Accel, BuildError, GROUP, Hits, M8, NOTHING, Rays, SHAPE, ShapeSet, Stack, V8, X8, pick, select};
use crate::camera::Pinhole;
use crate::film::{Film, Pixel, PixelSum};
use crate::lights::{Lights, Technique};
use crate::sampler::{CHOICE, Packet, Sampler, Source};
use crate::scene::{Camera, Geometry, Scene, Shape};
use etendue::warp::{CosineHemisphere, UniformHemisphere};
use etendue::{Frame, Mask, Real, Vec2, Vec3, Warp, u32x8};
use rayon::prelude::*;

/// All that an image depends on, beside the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Pixels across, at least 1.
    pub width: u32,
    /// Pixels down, at least 1.
    pub height: u32,
    /// Samples in each pixel, at least 1.
    pub spp: u32,
    /// How lights are sampled.
    pub technique: Technique,
    /// Where the random numbers come from.
    pub sampler: Sampler,
    /// Images of different seeds are independent.
    pub seed: u64,
}

/// Rays traced for an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCount {
    /// From the camera.
    pub camera: u64,
    /// Towards a light, or into the hemisphere to find one.
    pub shadow: u64,
}

/// A scene ready to be rendered.
#[derive(Debug)]
pub struct World {
    accel: Accel,
    shapes: Vec<Shape>,
    /// Of the flat ones among the shapes.
    normals: Vec<[f32; 3]>,
    materials: Vec<[f32; 3]>,
    /// Material of each place of the tree; empty where there is but one.
    place_materials: Vec<u32>,
    lights: Lights,
    camera: Camera,
}

/// A side of a square of pixels that one thread renders at a time.
const TILE: u32 = 16;
/// What touches a light does not hide it: a shadow ray ends 2⁻¹⁷ of its length before it.
const SPARED: f64 = 1.0 - 1.0 / 131_072.0;
const INV_PI: f64 = std::f64::consts::FRAC_1_PI;

/// The points that eight rays meet.
#[derive(Clone, Copy)]
struct Surface {
    point: V8,
    normal: V8,
    albedo: V8,
    emission: V8,
    /// Lanes that reflect.
    reflects: M8,
}

impl Default for Surface {
    fn default() -> Self {
        let zero = V8::default();
        Self { point: zero, normal: zero, albedo: zero, emission: zero, reflects: M8::splat(false) }
    }
}

impl World {
    /// Builds trees and tables.
    ///
    /// # Errors
    /// More primitives than a tree can index.
    pub fn new(scene: &Scene) -> Result<Self, BuildError> {
        let accel = Accel::new(&scene.triangles, ShapeSet::new(&scene.shapes)?)?;
        let one = scene.triangle_materials.windows(2).all(|w| w[0] == w[1]);
        let mut materials = scene.materials.clone();
        let place_materials = if one {
            // place 0 of the table serves all
            if let Some(&only) = scene.triangle_materials.first() {
                materials.swap(0, only as usize);
            }
            Vec::new()
        } else {
            accel.order().iter().map(|&id| scene.triangle_materials[id as usize]).collect()
        };
        Ok(Self {
            lights: Lights::new(scene),
            normals: scene.shapes.iter().map(|s| normal_of(&s.geometry)).collect(),
            shapes: scene.shapes.clone(),
            camera: scene.camera.clone(),
            accel,
            materials,
            place_materials,
        })
    }

    /// Renders an image; `progress` is told of pixels as they are finished.
    ///
    /// The result depends on scene and settings alone, whatever the threads do.
    pub fn render(&self, settings: &Settings, progress: impl Fn(u64) + Sync) -> (Film, RayCount) {
        let (width, height) = (settings.width, settings.height);
        let columns = width.div_ceil(TILE);
        let tiles = columns as usize * height.div_ceil(TILE) as usize;
        let rendered: Vec<_> = (0..tiles)
            .into_par_iter()
            .map(|tile| {
                let x = (tile as u32 % columns) * TILE;
                let y = (tile as u32 / columns) * TILE;
                let area = [x, y, (x + TILE).min(width), (y + TILE).min(height)];
                let mut work = Work::new(self, settings);
                let pixels = work.tile(area);
                progress(pixels.len() as u64);
                (area, pixels, work.count)
            })
            .collect();
        let mut pixels = vec![Pixel::default(); width as usize * height as usize];
        let mut rays = RayCount::default();
        for ([x0, y0, x1, y1], tile, count) in rendered {
            let across = (x1 - x0) as usize;
            for (row, y) in tile.chunks(across).zip(y0..y1) {
                let start = y as usize * width as usize + x0 as usize;
                pixels[start..start + across].copy_from_slice(row);
            }
            rays.camera += count.camera;
            rays.shadow += count.shadow;
        }
        (Film { width, height, samples: settings.spp, pixels }, rays)
    }

    /// Geometry and material where eight rays from the camera meet the scene.
    #[inline]
    fn surface(&self, hits: &Hits, rays: &Rays) -> Surface {
        let shapes = hits.shapes();
        let meshes = hits.any() & !shapes;
        let mut surface = Surface::default();
        if meshes.any() {
            self.mesh(hits, meshes, rays.direction, &mut surface);
        }
        if shapes.any() {
            self.shapes(hits, shapes, rays, &mut surface);
        }
        surface
    }

    #[inline]
    fn mesh(&self, hits: &Hits, lanes: M8, direction: V8, surface: &mut Surface) {
        let places = hits.place.as_array();
        let first = places[lanes.bits().trailing_zeros() as usize & 7];
        let uniform = (crate::accel::equal(hits.place, u32x8::splat(first)) | !lanes).all();
        let (v0, v1, v2, albedo);
        if uniform {
            let c = self.accel.corners(first);
            let corner = |k: usize| V8::from([c[k], c[k + 1], c[k + 2]]);
            (v0, v1, v2) = (corner(0), corner(3), corner(6));
            albedo = V8::from(self.albedo(first));
        } else {
            let nowhere = [0.0; 9];
            let rows: [&[f32; 9]; 8] =
                std::array::from_fn(|i| if lanes.lane(i) { self.accel.corners(places[i]) } else { &nowhere });
            let c = X8::transpose(rows.map(|r| X8::from(&r[..8])));
            let last = X8::from(rows.map(|r| r[8]));
            (v0, v1, v2) = (V8::new(c[0], c[1], c[2]), V8::new(c[3], c[4], c[5]), V8::new(c[6], c[7], last));
            albedo = if self.place_materials.is_empty() {
                V8::from(self.albedo(0))
            } else {
                let each: [[f32; 3]; 8] =
                    std::array::from_fn(|i| if lanes.lane(i) { self.albedo(places[i]) } else { [0.0; 3] });
                let channel = |k: usize| X8::from(each.map(|a| a[k]));
                V8::new(channel(0), channel(1), channel(2))
            };
        }
        let (e1, e2) = (v1 - v0, v2 - v0);
        let normal = e1.cross(e2).normalize();
        let normal = facing(normal, direction);
        let point = e1.mul_add(hits.b1, e2.mul_add(hits.b2, v0));
        let reach = v0.max_abs().max(v1.max_abs()).max(v2.max_abs());
        surface.point = lift(point, normal, reach);
        surface.normal = normal;
        surface.albedo = albedo;
        surface.reflects = lanes;
    }

    #[inline]
    fn albedo(&self, place: u32) -> [f32; 3] {
        let material = self.place_materials.get(place as usize).copied().unwrap_or(0);
        self.materials[material as usize]
    }

    /// Calls `f` for each of the shapes that lanes have met: the lanes, the shape, and its outward normal there.
    #[inline]
    fn each_shape(&self, hits: &Hits, mut lanes: M8, rays: &Rays, mut f: impl FnMut(M8, &Shape, V8)) {
        while lanes.any() {
            let lane = lanes.bits().trailing_zeros() as usize & 7;
            let place = hits.place.as_array()[lane];
            let here = lanes & crate::accel::equal(hits.place, u32x8::splat(place));
            let index = (place & !SHAPE) as usize;
            let shape = &self.shapes[index];
            let outward = match shape.geometry {
                Geometry::Sphere { center, .. } => {
                    rays.direction.mul_add(hits.distance, rays.origin - V8::from(center)).normalize()
                }
                Geometry::Triangle(_) | Geometry::Parallelogram { .. } => V8::from(self.normals[index]),
            };
            f(here, shape, outward);
            lanes = lanes & !here;
        }
    }

    /// Spheres and emitters that eight rays meet.
    fn shapes(&self, hits: &Hits, lanes: M8, rays: &Rays, surface: &mut Surface) {
        self.each_shape(hits, lanes, rays, |here, shape, outward| {
            if let Some((radiance, lit)) = emitted(here, shape, outward, rays.direction) {
                surface.emission = V8::select(lit, radiance, surface.emission);
            }
            let albedo = self.materials[shape.material as usize];
            if albedo != [0.0; 3] {
                let normal = facing(outward, rays.direction);
                let point = rays.direction.mul_add(hits.distance, rays.origin);
                let point = lift(point, normal, X8::splat(self.accel.shapes.reach()));
                surface.point = V8::select(here, point, surface.point);
                surface.normal = V8::select(here, normal, surface.normal);
                surface.albedo = V8::select(here, albedo.into(), surface.albedo);
                surface.reflects = surface.reflects | here;
            }
        });
    }
}

/// What a shape sends back along the rays, and in which of the lanes.
#[inline]
fn emitted(lanes: M8, shape: &Shape, outward: V8, direction: V8) -> Option<(V8, M8)> {
    let emission = shape.emission?;
    let front = outward.dot(direction).lt(X8::lit(0.0));
    Some((emission.radiance.into(), lanes & (front | M8::splat(emission.two_sided))))
}

/// The unit normal of a flat shape.
fn normal_of(geometry: &Geometry) -> [f32; 3] {
    let [a, b] = match *geometry {
        Geometry::Sphere { .. } => return [0.0; 3],
        Geometry::Triangle([a, b, c]) => [b, c].map(|p| std::array::from_fn(|k| f64::from(p[k]) - f64::from(a[k]))),
        Geometry::Parallelogram { u, v, .. } => [u, v].map(|e| e.map(f64::from)),
    };
    let normal = Vec3::<f64>::from(a).cross(b.into()).normalize();
    [normal.x as f32, normal.y as f32, normal.z as f32]
}

/// The normal on the side from which the ray comes.
#[inline]
fn facing(normal: V8, direction: V8) -> V8 {
    let away = normal.dot(direction).gt(X8::lit(0.0));
    V8::new(normal.x.negate_where(away), normal.y.negate_where(away), normal.z.negate_where(away))
}

/// Moves a point off its surface by 8 ulps of the largest coordinate of the primitive it lies on: more than the error of the
/// point and of the triangle test, whatever the unit of length.
#[inline]
fn lift(point: V8, normal: V8, reach: X8) -> V8 {
    normal.mul_add(reach * X8::lit(1.0 / 1_048_576.0), point)
}

/// Rendering of one tile.
struct Work<'a> {
    world: &'a World,
    settings: &'a Settings,
    camera: Pinhole,
    source: Source,
    count: RayCount,
    stack: Stack,
    /// Camera rays of a group, and their shadow rays.
    rays: Box<[[Rays; GROUP]; 2]>,
}

/// The pixels of an area [x0, y0, x1, y1) along a Z-order curve: neighbours in the list are neighbours in the image.
fn z_order([x0, y0, x1, y1]: [u32; 4]) -> Vec<[u32; 2]> {
    let even = |i: u32| (0..4).fold(0, |n, bit| n | (i >> (2 * bit) & 1) << bit);
    let all = (0..TILE * TILE).map(|i| [x0 + even(i), y0 + even(i >> 1)]);
    all.filter(|&[x, y]| x < x1 && y < y1).collect()
}

impl<'a> Work<'a> {
    fn new(world: &'a World, settings: &'a Settings) -> Self {
        let source = Source::new(settings.sampler, settings.seed, settings.spp, false, settings.width);
        let camera = Pinhole::new(&world.camera, settings.width, settings.height);
        Self {
            world,
            settings,
            camera,
            source,
            count: RayCount::default(),
            stack: Stack::default(),
            rays: Box::default(),
        }
    }

    /// The pixels of an area [x0, y0, x1, y1), row by row.
    fn tile(&mut self, area: [u32; 4]) -> Vec<Pixel> {
        let [x0, y0, x1, _] = area;
        let spp = self.settings.spp;
        let pixels = z_order(area);
        let mut sums = vec![PixelSum::default(); pixels.len()];
        let total = pixels.len() as u64 * u64::from(spp);
        let replicate = self.source.span();
        let span = if replicate == 0 { spp } else { replicate };
        // packets that hold samples of one pixel and replicate are summed in lanes, else sample by sample
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
        let mut packets = Vec::with_capacity(GROUP);
        for start in (0..total).step_by(8 * GROUP) {
            let starts = (start..total).step_by(8).take(GROUP);
            packets.clear();
            packets.extend(starts.clone().map(packet));
            let radiance = self.group(&packets);
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

    /// Radiance of the samples of a group of packets.
    fn group(&mut self, packets: &[Packet]) -> [V8; GROUP] {
        let world = self.world;
        let count = packets.len();
        let mut light = [Vec2::default(); GROUP];
        let rays = &mut self.rays[0];
        let mut active = [M8::splat(false); GROUP];
        let mut hits = [Hits::none(X8::lit(f64::INFINITY)); GROUP];
        for (p, packet) in packets.iter().enumerate() {
            let [film, second] = self.source.film_and_light(packet);
            let position = [X8::from_uint(packet.x) + film.x, X8::from_uint(packet.y) + film.y];
            let (origin, direction) = self.camera.ray(position[0], position[1]);
            light[p] = second;
            rays[p] = world.accel.rays(origin, direction);
            active[p] = packet.active;
            self.count.camera += u64::from(packet.active.bits().count_ones());
        }
        world.accel.closest(&rays[..count], &active[..count], &mut hits[..count], &mut self.stack);

        let mut radiance = [V8::default(); GROUP];
        let mut surfaces = [Surface::default(); GROUP];
        for p in 0..count {
            surfaces[p] = world.surface(&hits[p], &rays[p]);
            radiance[p] = surfaces[p].emission;
        }
        if world.lights.is_empty() {
            return radiance;
        }
        let surfaces = &surfaces[..count];
        let reflected = match self.settings.technique {
            Technique::Area | Technique::SolidAngle => {
                let choice = world.lights.many().then(|| {
                    let mut choice = [X8::lit(0.0); GROUP];
                    for (p, packet) in packets.iter().enumerate() {
                        choice[p] = self.source.pair(packet, CHOICE).x;
                    }
                    choice
                });
                self.light(surfaces, light, choice)
            }
            Technique::UniformHemisphere => self.hemisphere(surfaces, light, false),
            Technique::CosineHemisphere => self.hemisphere(surfaces, light, true),
        };
        for p in 0..count {
            radiance[p] += reflected[p];
        }
        radiance
    }

    /// Reflected light by sampling a light.
    #[inline]
    fn light(&mut self, surfaces: &[Surface], light: [Vec2<X8>; GROUP], choice: Option<[X8; GROUP]>) -> [V8; GROUP] {
        let world = self.world;
        let by_area = self.settings.technique == Technique::Area;
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let count = surfaces.len();
        let rays = &mut self.rays[1];
        let mut lit = [M8::splat(false); GROUP];
        let mut limit = [zero; GROUP];
        let mut target = [u32x8::splat(NOTHING); GROUP];
        let mut reflected = [V8::default(); GROUP];
        for (p, surface) in surfaces.iter().enumerate().filter(|(_, s)| s.reflects.any()) {
            let mut u = light[p];
            let (chosen, rest) = world.lights.choose(choice.map_or(u.x, |choice| choice[p]));
            if choice.is_none() {
                u.x = rest;
            }
            let sample = world.lights.sample(&chosen, by_area, surface.point, u);
            let cos = sample.direction.dot(surface.normal);
            lit[p] = surface.reflects & sample.emits & sample.pdf.gt(zero) & cos.gt(zero);
            self.count.shadow += u64::from(lit[p].bits().count_ones());
            rays[p] = world.accel.rays(surface.point, sample.direction);
            limit[p] = sample.distance * X8::lit(SPARED);
            target[p] = chosen.shape;
            let density = select(lit[p], sample.pdf * chosen.probability, one);
            reflected[p] = product(surface.albedo, chosen.radiance) * (cos * X8::lit(INV_PI) / density);
        }
        world.accel.occluded(&rays[..count], &mut lit[..count], &limit[..count], &target[..count], &mut self.stack);
        for p in 0..count {
            reflected[p] = keep(reflected[p], lit[p]);
        }
        reflected
    }

    /// Reflected light by sampling the hemisphere.
    fn hemisphere(&mut self, surfaces: &[Surface], light: [Vec2<X8>; GROUP], cosine: bool) -> [V8; GROUP] {
        let world = self.world;
        let count = surfaces.len();
        let infinite = X8::lit(f64::INFINITY);
        let rays = &mut self.rays[1];
        let mut lit = [M8::splat(false); GROUP];
        let mut hits = [Hits::none(infinite); GROUP];
        let mut weight = [X8::lit(1.0); GROUP];
        for (p, surface) in surfaces.iter().enumerate() {
            let local: V8 = if cosine { CosineHemisphere.sample(light[p]) } else { UniformHemisphere.sample(light[p]) };
            rays[p] = world.accel.rays(surface.point, Frame::new(surface.normal).to_world(local));
            lit[p] = surface.reflects;
            self.count.shadow += u64::from(surface.reflects.bits().count_ones());
            // f·L·cos/pdf: cos/π for the cosine's density z/π leaves the albedo, for 1/2π it leaves 2cos
            if !cosine {
                weight[p] = local.z * X8::lit(2.0);
            }
        }
        // lights are few and found at once; only what hits one is worth a shadow ray
        world.accel.closest_shape(&rays[..count], &lit[..count], &mut hits[..count], &mut self.stack);
        let mut reflected = [V8::default(); GROUP];
        let mut target = [u32x8::splat(NOTHING); GROUP];
        let mut limit = [infinite; GROUP];
        for (p, surface) in surfaces.iter().enumerate() {
            let met = lit[p] & hits[p].any();
            lit[p] = M8::splat(false);
            let mut found = V8::default();
            world.each_shape(&hits[p], met, &rays[p], |here, shape, outward| {
                if let Some((radiance, here)) = emitted(here, shape, outward, rays[p].direction) {
                    found = V8::select(here, radiance, found);
                    lit[p] = lit[p] | here;
                }
            });
            reflected[p] = product(surface.albedo, found) * weight[p];
            target[p] = pick(lit[p], hits[p].place ^ u32x8::splat(SHAPE), u32x8::splat(NOTHING));
            limit[p] = hits[p].distance * X8::lit(SPARED);
        }
        world.accel.occluded(&rays[..count], &mut lit[..count], &limit[..count], &target[..count], &mut self.stack);
        for p in 0..count {
            reflected[p] = keep(reflected[p], lit[p]);
        }
        reflected
    }
}

#[inline]
fn keep(v: V8, mask: M8) -> V8 {
    V8::new(v.x.keep(mask), v.y.keep(mask), v.z.keep(mask))
}

#[inline]
fn product(a: V8, b: V8) -> V8 {
    V8::new(a.x * b.x, a.y * b.y, a.z * b.z)
}
