//! Direct light, in packets: camera rays, light samples, shadow rays.

use crate::accel::{Accel, BuildError, Hits, M8, NOTHING, SHAPE, ShapeSet, V8, X8, pick, select};
use crate::camera::Pinhole;
use crate::film::{Film, Pixel, PixelSum};
use crate::lights::{Lights, Technique};
use crate::scene::{Camera, Geometry, Scene, Shape};
use etendue::sequence::{Independent, Sequence, Stratified};
use etendue::warp::{CosineHemisphere, UniformHemisphere};
use etendue::{Frame, Mask, Real, Vec2, Vec3, Warp, u32x8};
use rayon::prelude::*;

/// How random numbers are spread over the samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Sampler {
    /// Independent random numbers
    Independent,
    /// Jittered strata in the pixel and on the light, associated at random
    Stratified,
}

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
    materials: Vec<[f32; 3]>,
    /// Material of each place of the tree; empty where there is but one.
    place_materials: Vec<u32>,
    lights: Lights,
    camera: Camera,
}

/// A side of a square of pixels that one thread renders at a time.
const TILE: u32 = 16;
const INV_PI: f64 = std::f64::consts::FRAC_1_PI;

/// Random numbers for a pixel's samples.
enum Source {
    Independent(Independent),
    Stratified(Stratified),
}

impl Source {
    /// The pair for the position in the pixel and the pair for the light.
    #[inline]
    fn pairs(&self, pixel: u32x8, sample: u32x8) -> [Vec2<X8>; 2] {
        match self {
            Self::Independent(s) => s.two_pairs(pixel, sample, 0),
            Self::Stratified(s) => [s.pair(pixel, sample, 0), s.pair(pixel, sample, 1)],
        }
    }
    /// A number with which to choose among many lights.
    #[inline]
    fn choice(&self, pixel: u32x8, sample: u32x8) -> X8 {
        let pair: Vec2<X8> = match self {
            Self::Independent(s) => s.pair(pixel, sample, 2),
            Self::Stratified(s) => s.pair(pixel, sample, 2),
        };
        pair.x
    }
}

/// The points that eight rays meet.
struct Surface {
    point: V8,
    normal: V8,
    albedo: V8,
    emission: V8,
    /// Lanes that reflect.
    reflects: M8,
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
                (area, pixels, work.rays)
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
    fn surface(&self, hits: &Hits, direction: V8) -> Surface {
        let shapes = hits.shapes();
        let meshes = hits.any() & !shapes;
        let zero = V8::default();
        let mut surface =
            Surface { point: zero, normal: zero, albedo: zero, emission: zero, reflects: M8::splat(false) };
        if meshes.any() {
            self.mesh(hits, meshes, direction, &mut surface);
        }
        if shapes.any() {
            for lane in (0..8).filter(|&i| shapes.lane(i)) {
                self.shape(hits, lane, direction, &mut surface);
            }
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

    /// A lane that meets a sphere or an emitter.
    #[cold]
    fn shape(&self, hits: &Hits, lane: usize, direction: V8, surface: &mut Surface) {
        let shape = &self.shapes[(hits.place.as_array()[lane] & !SHAPE) as usize];
        let d = direction.lane(lane);
        let ray = |t: f32| d * t;
        let (outward, reach) = match shape.geometry {
            Geometry::Sphere { center, radius } => {
                let origin = Vec3::from(self.camera.origin.map(|x| x as f32));
                let offset = origin - Vec3::from(center) + ray(hits.distance.lane(lane));
                (offset.normalize(), Vec3::<f32>::from(center).max_abs() + radius)
            }
            Geometry::Triangle([a, b, c]) => {
                let [a, b, c] = [a, b, c].map(Vec3::<f32>::from);
                ((b - a).cross(c - a).normalize(), a.max_abs().max(b.max_abs()).max(c.max_abs()))
            }
            Geometry::Parallelogram { p, u, v } => {
                let [p, u, v] = [p, u, v].map(Vec3::<f32>::from);
                (u.cross(v).normalize(), p.max_abs() + u.max_abs() + v.max_abs())
            }
        };
        let here = M8::from_bits(1 << lane);
        let front = outward.dot(d) < 0.0;
        if let Some(emission) = shape.emission.filter(|e| front || e.two_sided) {
            surface.emission = V8::select(here, emission.radiance.into(), surface.emission);
        }
        let albedo = self.materials[shape.material as usize];
        if albedo != [0.0; 3] {
            let normal = if front { outward } else { -outward };
            let origin = Vec3::from(self.camera.origin.map(|x| x as f32));
            let point = lift(V8::splat(origin + ray(hits.distance.lane(lane))), V8::splat(normal), X8::splat(reach));
            surface.point = V8::select(here, point, surface.point);
            surface.normal = V8::select(here, V8::splat(normal), surface.normal);
            surface.albedo = V8::select(here, albedo.into(), surface.albedo);
            surface.reflects = surface.reflects | here;
        }
    }
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
    /// Samples in a replicate; 0 where each sample is one.
    replicate: u32,
    rays: RayCount,
}

impl<'a> Work<'a> {
    fn new(world: &'a World, settings: &'a Settings) -> Self {
        let spp = settings.spp;
        let (source, replicate) = match settings.sampler {
            Sampler::Independent => (Source::Independent(Independent::new(settings.seed)), 0),
            Sampler::Stratified => {
                // two replicates are the fewest that can tell their variance
                let replicate = if spp.is_multiple_of(2) { spp / 2 } else { spp };
                (Source::Stratified(Stratified::new(settings.seed, replicate)), replicate)
            }
        };
        let camera = Pinhole::new(&world.camera, settings.width, settings.height);
        Self { world, settings, camera, source, replicate, rays: RayCount::default() }
    }

    /// The pixels of an area [x0, y0, x1, y1), row by row.
    fn tile(&mut self, [x0, y0, x1, y1]: [u32; 4]) -> Vec<Pixel> {
        let spp = self.settings.spp;
        let across = x1 - x0;
        let count = across * (y1 - y0);
        let position = |i: u32| (x0 + i % across, y0 + i / across);
        let span = if self.replicate == 0 { spp } else { self.replicate };
        if span.is_multiple_of(8) {
            let mut sum = PixelSum::default();
            let pixel = |i| {
                let (x, y) = position(i);
                for start in (0..spp).step_by(8) {
                    let sample = u32x8::from(std::array::from_fn(|k| start + k as u32));
                    let (radiance, _) = self.packet(u32x8::splat(x), u32x8::splat(y), sample, M8::splat(true));
                    sum.push_packet(radiance);
                    if self.replicate != 0 && (start + 8).is_multiple_of(self.replicate) {
                        sum.end_replicate();
                    }
                }
                sum.finish()
            };
            return (0..count).map(pixel).collect();
        }
        // lanes run on from pixel to pixel
        let mut sums = vec![PixelSum::default(); count as usize];
        let total = u64::from(count) * u64::from(spp);
        for start in (0..total).step_by(8) {
            let item = |k: usize| (start + k as u64).min(total - 1);
            let pixel = |k: usize| (item(k) / u64::from(spp)) as u32;
            let sample = |k: usize| (item(k) % u64::from(spp)) as u32;
            let lanes = (total - start).min(8) as u32;
            let (radiance, _) = self.packet(
                u32x8::from(std::array::from_fn(|k| position(pixel(k)).0)),
                u32x8::from(std::array::from_fn(|k| position(pixel(k)).1)),
                u32x8::from(std::array::from_fn(sample)),
                M8::from_bits((1 << lanes) - 1),
            );
            for k in 0..lanes as usize {
                let sum = &mut sums[pixel(k) as usize];
                sum.push(radiance.lane(k).into());
                if self.replicate != 0 && (sample(k) + 1).is_multiple_of(self.replicate) {
                    sum.end_replicate();
                }
            }
        }
        sums.iter_mut().map(PixelSum::finish).collect()
    }

    /// Radiance of eight samples, and the lanes that met something.
    #[inline]
    fn packet(&mut self, x: u32x8, y: u32x8, sample: u32x8, active: M8) -> (V8, M8) {
        let pixel = y * u32x8::splat(self.settings.width) + x;
        let [film, light] = self.source.pairs(pixel, sample);
        let (origin, direction) = self.camera.ray(X8::from_uint(x) + film.x, X8::from_uint(y) + film.y);
        let world = self.world;
        let rays = world.accel.rays(origin, direction);
        self.rays.camera += u64::from(active.bits().count_ones());
        let hits = world.accel.closest(&rays, active, X8::lit(f64::INFINITY));
        let met = hits.any();
        let surface = world.surface(&hits, direction);
        let mut radiance = surface.emission;
        if surface.reflects.any() && !world.lights.is_empty() {
            radiance += match self.settings.technique {
                Technique::Area => self.light(&surface, pixel, sample, light, true),
                Technique::SolidAngle => self.light(&surface, pixel, sample, light, false),
                Technique::UniformHemisphere => self.hemisphere(&surface, light, false),
                Technique::CosineHemisphere => self.hemisphere(&surface, light, true),
            };
        }
        (radiance, met)
    }

    /// Reflected light by sampling a light.
    #[inline]
    fn light(&mut self, surface: &Surface, pixel: u32x8, sample: u32x8, mut u: Vec2<X8>, by_area: bool) -> V8 {
        let world = self.world;
        let chosen = if world.lights.many() {
            world.lights.choose(self.source.choice(pixel, sample)).0
        } else {
            let (chosen, rest) = world.lights.choose(u.x);
            u.x = rest;
            chosen
        };
        let zero = X8::lit(0.0);
        let light = world.lights.sample(&chosen, by_area, surface.point, u);
        let cos = light.direction.dot(surface.normal);
        let lit = surface.reflects & light.emits & light.pdf.gt(zero) & cos.gt(zero);
        if !lit.any() {
            return V8::default();
        }
        self.rays.shadow += u64::from(lit.bits().count_ones());
        let rays = world.accel.rays(surface.point, light.direction);
        // what touches the light does not hide it: 2⁻¹⁷ of the distance is spared
        let limit = light.distance * X8::lit(1.0 - 1.0 / 131_072.0);
        let visible = lit & !world.accel.occluded(&rays, lit, limit, chosen.shape);
        let density = select(lit, light.pdf * chosen.probability, X8::lit(1.0));
        let weight = (cos * X8::lit(INV_PI) / density).keep(visible);
        product(surface.albedo, chosen.radiance) * weight
    }

    /// Reflected light by sampling the hemisphere.
    #[inline]
    fn hemisphere(&mut self, surface: &Surface, u: Vec2<X8>, cosine: bool) -> V8 {
        let world = self.world;
        let local: V8 = if cosine { CosineHemisphere.sample(u) } else { UniformHemisphere.sample(u) };
        let direction = Frame::new(surface.normal).to_world(local);
        let rays = world.accel.rays(surface.point, direction);
        self.rays.shadow += u64::from(surface.reflects.bits().count_ones());
        let hits = world.accel.closest_shape(&rays, surface.reflects, X8::lit(f64::INFINITY));
        let mut radiance = V8::default();
        let mut lit = M8::splat(false);
        for lane in (0..8).filter(|&i| hits.any().lane(i)) {
            if let Some(emitted) = self.emitted(&hits, lane, surface.point.lane(lane), direction.lane(lane)) {
                let here = M8::from_bits(1 << lane);
                radiance = V8::select(here, emitted.into(), radiance);
                lit = lit | here;
            }
        }
        if !lit.any() {
            return radiance;
        }
        let target = pick(lit, hits.place ^ u32x8::splat(SHAPE), u32x8::splat(NOTHING));
        let limit = hits.distance * X8::lit(1.0 - 1.0 / 131_072.0);
        let visible = lit & !world.accel.occluded(&rays, lit, limit, target);
        // f·L·cos/pdf: cos/π for the cosine's density z/π leaves the albedo, for 1/2π it leaves 2cos
        let weight = if cosine { X8::lit(1.0) } else { local.z * X8::lit(2.0) };
        product(surface.albedo, radiance) * weight.keep(visible)
    }

    /// What the shape that a lane has hit sends back along the ray.
    fn emitted(&self, hits: &Hits, lane: usize, origin: Vec3<f32>, direction: Vec3<f32>) -> Option<[f32; 3]> {
        let shape = &self.world.shapes[(hits.place.as_array()[lane] & !SHAPE) as usize];
        let emission = shape.emission?;
        let outward = match shape.geometry {
            Geometry::Sphere { center, .. } => origin - center.into() + direction * hits.distance.lane(lane),
            Geometry::Triangle([a, b, c]) => {
                let [a, b, c] = [a, b, c].map(Vec3::<f32>::from);
                (b - a).cross(c - a)
            }
            Geometry::Parallelogram { u, v, .. } => Vec3::from(u).cross(Vec3::from(v)),
        };
        (emission.two_sided || outward.dot(direction) < 0.0).then_some(emission.radiance)
    }
}

#[inline]
fn product(a: V8, b: V8) -> V8 {
    V8::new(a.x * b.x, a.y * b.y, a.z * b.z)
}
