//! Scenes of many lights, and points that their cameras see.

use super::published::{Cluster, PublishedTree};
use etendue::occlusion::SPARED;
use etendue::select::LightBound;
use etendue::sequence::{Independent, Sequence};
use etendue::{Mask, Real, Vec2, u32x8};
use etendue_render::bvh::{Hits, Rays, Scratch};
use etendue_render::camera::{Camera, CameraSample};
use etendue_render::light_tree::{OwnedTree, Threads};
use etendue_render::lights::{Chosen, Drawn, Lights};
use etendue_render::packet::{M8, V8, X8, select};
use etendue_render::scene::{self, Scene};
use etendue_render::surfaces::{Surface, Surfaces};
use etendue_render::technique::Measure;
use std::error::Error;

/// Packets in a block of neighbouring pixels, a row of eight each.
pub const ROWS: usize = 8;

/// A scene whose lights all have an area, with both trees.
pub struct Stage {
    /// Its name.
    pub name: String,
    /// What rays hit.
    pub surfaces: Surfaces,
    /// The lights.
    pub lights: Lights,
    /// Their bounds.
    pub bounds: Vec<LightBound>,
    /// The library's tree.
    pub own: OwnedTree,
    /// The tree of the literature.
    pub published: PublishedTree,
    /// The same tree where the power of a sphere is a quarter, so that its importance is its intensity times π, as that of flat lights.
    pub intensity: PublishedTree,
    /// The lights as that tree knows them.
    pub clusters: Vec<Cluster>,
    /// Power of each light.
    pub powers: Vec<f32>,
    camera: Camera,
    size: [u32; 2],
}

/// The mean of the channels.
pub fn mean(rgb: V8) -> X8 {
    (rgb.x + rgb.y + rgb.z) * X8::lit(1.0 / 3.0)
}

/// The lights of a scene as the published tree knows them.
fn clusters(scene: &Scene) -> Vec<Cluster> {
    let lit = scene.shapes.iter().filter_map(|shape| Some((&shape.geometry, shape.emission?)));
    lit.map(|(geometry, emission)| {
        let radiance = emission.radiance.iter().sum::<f32>() / 3.0;
        let sides = if emission.two_sided { 2.0 } else { 1.0 };
        let power = radiance * geometry.area() as f32 * sides;
        Cluster::light(geometry.bounds(), geometry.normal(), power, emission.two_sided)
    })
    .collect()
}

impl Stage {
    /// Loads a scene and builds its trees.
    ///
    /// # Errors
    /// Fails if there is no such scene, or if it has lights without area.
    pub fn load(name: &str) -> Result<Self, Box<dyn Error>> {
        let scene = scene::load(name)?;
        let lights = Lights::new(&scene, None)?;
        let (bounds, clusters) = (Lights::bounds(&scene), clusters(&scene));
        if bounds.len() != lights.len() || scene.environment.is_some() {
            return Err(format!("{name} has lights without area").into());
        }
        let intensities: Vec<Cluster> = clusters
            .iter()
            .zip(&bounds)
            .map(|(&cluster, bound)| {
                let factor = if bound.normal == [0.0; 3] { 0.25 } else { 1.0 };
                Cluster { power: cluster.power * factor, ..cluster }
            })
            .collect();
        let size = [scene.film.width, scene.film.height];
        Ok(Self {
            name: name.to_owned(),
            surfaces: Surfaces::new(&scene)?,
            lights,
            own: OwnedTree::new(&bounds, &Threads)?,
            published: PublishedTree::new(&clusters),
            intensity: PublishedTree::new(&intensities),
            powers: clusters.iter().map(|cluster| cluster.power).collect(),
            bounds,
            clusters,
            camera: Camera::new(&scene.camera, size[0], size[1]),
            size,
        })
    }
    /// Diffuse surfaces that the camera sees in random blocks of 8 × 8 pixels.
    pub fn blocks(&self, count: u32, seed: u64) -> Vec<[Surface; ROWS]> {
        let (sequence, mut scratch) = (Independent::new(seed), Scratch::default());
        let block = |block: u32| {
            let place: Vec2<f32> = sequence.pair(u32::MAX, block, 0);
            let start = |u: f32, size: u32| (u * (size - 7) as f32) as u32;
            let [x, y] = [start(place.x, self.size[0]), start(place.y, self.size[1])];
            let rays: [Rays; ROWS] = std::array::from_fn(|row| {
                let columns = u32x8::new(std::array::from_fn(|k| x + k as u32));
                let pixel = u32x8::splat(block << 3) + u32x8::splat(row as u32);
                let pair = |dimension| sequence.pair::<X8>(pixel, columns, dimension);
                let sample = CameraSample::new(
                    columns,
                    u32x8::splat(y + row as u32),
                    pair(1),
                    self.camera.has_lens().then(|| pair(2)),
                );
                let (origin, direction) = self.camera.rays(&sample);
                self.surfaces.bvh.rays(origin, direction)
            });
            let mut hits = [Hits::none(X8::splat(f32::INFINITY)); ROWS];
            self.surfaces.bvh.closest(&rays, &[M8::splat(true); ROWS], &mut hits, &mut scratch);
            std::array::from_fn(|row| {
                let mut surface = self.surfaces.hit(&hits[row], &rays[row]);
                if !self.surfaces.is_plain {
                    let metal = self.surfaces.metal(&hits[row], surface.reflects);
                    surface.reflects = surface.reflects & !(metal.mirrors() | metal.rough());
                }
                surface
            })
        };
        (0..count).map(block).collect()
    }
    /// Samples these lights by a measure. Returns the lights, the samples, and what each contributes to the reflected radiance unless it is
    /// occluded, over its pdf.
    #[inline]
    pub fn sample(&self, index: u32x8, measure: Measure, at: &Point<V8>, u: Vec2<X8>) -> (Chosen, Drawn, X8) {
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let mut chosen = self.lights.chosen(index);
        let sample = self.lights.sample(&mut chosen, measure, at.p, at.n, u);
        let cos = sample.direction.dot(at.n);
        let lit = sample.emits & sample.pdf.gt(zero) & cos.gt(zero);
        let pdf = select(lit, sample.pdf, one);
        let color =
            V8::new(chosen.radiance.x * at.albedo.x, chosen.radiance.y * at.albedo.y, chosen.radiance.z * at.albedo.z);
        let value = mean(color) * X8::lit(std::f64::consts::FRAC_1_PI) * cos / pdf;
        (chosen, sample, value.keep(lit))
    }
    /// The shadow ray of a sample, and the distance that it covers.
    #[inline]
    pub fn shadow(&self, at: &Point<V8>, sample: &Drawn) -> (Rays, X8) {
        (self.surfaces.bvh.rays(at.p, sample.direction), sample.distance * X8::lit(1.0 - SPARED))
    }
    /// The reflected radiance of each light at a point, in closed form: what it contributes unless it is occluded.
    pub fn contributions(&self, at: &Point<[f32; 3]>) -> Vec<f64> {
        let (at, count) = (at.splat(), self.lights.len() as u32);
        let middle = Vec2::new(X8::lit(0.5), X8::lit(0.5));
        let mut all = Vec::with_capacity(count as usize + 8);
        for start in (0..count).step_by(8) {
            let index = u32x8::new(std::array::from_fn(|k| (start + k as u32).min(count - 1)));
            // by projected solid angle, every sample is worth the integral
            let (.., value) = self.sample(index, Measure::Projected, &at, middle);
            all.extend(value.to_array().map(f64::from));
        }
        all.truncate(count as usize);
        all
    }
}

/// A point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Point<V> {
    /// The point.
    pub p: V,
    /// Its unit normal.
    pub n: V,
    /// Its albedo.
    pub albedo: V,
}

impl Point<[f32; 3]> {
    /// The same in all lanes.
    pub fn splat(&self) -> Point<V8> {
        Point { p: self.p.into(), n: self.n.into(), albedo: self.albedo.into() }
    }
    /// A lane of a surface.
    pub fn lane(surface: &Surface, lane: usize) -> Self {
        let of = |v: V8| [v.x, v.y, v.z].map(|x| x.to_array()[lane]);
        Self { p: of(surface.point), n: of(surface.normal), albedo: of(surface.albedo) }
    }
    /// One point of each block that shows a surface.
    pub fn of(blocks: &[[Surface; ROWS]]) -> Vec<Self> {
        let lanes = |block: &[Surface; ROWS]| {
            let all = block.iter().flat_map(|s| (0..8).filter(|&k| s.reflects.lane(k)).map(move |k| Self::lane(s, k)));
            let all: Vec<_> = all.collect();
            // the blocks are random, so that any place in them will do
            all.get(all.len() / 2).copied()
        };
        blocks.iter().filter_map(lanes).collect()
    }
}
