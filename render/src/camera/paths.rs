//! Follows camera rays, without random numbers, through perfect mirrors to the first other surface.
//!
//! Mirrors occlude shadow rays. (Rays between mirrors keep their lanes: compacted into fewer packets they took as long in the mirror room,
//! 1.00 ± 0.03, and 1.04 times as long among three thousand balls.)

use super::points::Points;
use super::prepared::PreparedScene;
use crate::bvh::{GROUP, Hits, PrimitiveIds, Tracer};
use crate::packet::{M8, V8, X8, keep, product};
use crate::surfaces::Surface;
use crate::surfaces::bsdf::Metal;
use etendue::{Mask, Real};

/// The paths of a group of packets from the camera to the shading points.
pub(crate) struct Paths<'a> {
    scene: &'a PreparedScene,
    /// Greatest number of mirrors along a path.
    depth: u32,
    pub(crate) tracer: Tracer,
    pub(crate) points: Box<Points>,
    /// Radiance of the lights and the sky that the camera sees, directly and in mirrors.
    pub(crate) seen: [V8; GROUP],
}

impl<'a> Paths<'a> {
    pub(crate) fn new(scene: &'a PreparedScene, depth: u32) -> Self {
        let points = Box::new(Points::new());
        Self { scene, depth, tracer: Tracer::default(), points, seen: [V8::default(); GROUP] }
    }

    /// Sets the camera rays of a packet. `pixel` is the one that they belong to, if it is a single one.
    #[inline(always)]
    pub(crate) fn start(&mut self, packet: usize, (origin, direction): (V8, V8), pixel: Option<[u32; 2]>) {
        self.tracer.camera[packet] = self.scene.surfaces.bvh.rays(origin, direction);
        self.points.places[packet].pixel = pixel;
    }

    /// Follows these lanes of the rays that have been started.
    pub(crate) fn follow(&mut self, active: &[M8]) {
        // what a scene does not need costs it nothing
        if self.scene.surfaces.is_plain { self.hit(active) } else { self.reflect(active) }
    }

    /// Follows these lanes of the rays that have been started only as far as it takes to tell what is [seen](Self::seen).
    pub(crate) fn look(&mut self, active: &[M8]) {
        if !self.scene.surfaces.is_diffuse {
            return self.follow(active);
        }
        let Self { scene, tracer, seen, .. } = self;
        let count = active.len();
        let mut hits = [Hits::none(X8::lit(f64::INFINITY)); GROUP];
        scene.surfaces.bvh.closest(&tracer.camera[..count], active, &mut hits[..count], &mut tracer.scratch);
        for (p, (hits, active)) in hits[..count].iter().zip(active).enumerate() {
            let emitted = scene.surfaces.emission(hits, &tracer.camera[p]);
            seen[p] = emission(scene, tracer, p, emitted, *active & !hits.any());
        }
    }

    /// Notes what the fits of glossy surfaces are at the ends of the first packets.
    pub(crate) fn note_lobes(&mut self, count: usize) {
        if !self.scene.surfaces.is_plain {
            self.points.note_lobes(count);
        }
    }

    /// Follows rays in a scene whose surfaces are flat and diffuse: the first hit is the end.
    #[inline(always)]
    fn hit(&mut self, active: &[M8]) {
        let Self { scene, tracer, points, seen, .. } = self;
        let (world, count) = (&scene.surfaces, active.len());
        let mut hits = [Hits::none(X8::lit(f64::INFINITY)); GROUP];
        world.bvh.closest(&tracer.camera[..count], active, &mut hits[..count], &mut tracer.scratch);
        for (p, (hits, active)) in hits[..count].iter().zip(active).enumerate() {
            points.surfaces[p] = world.hit(hits, &tracer.camera[p]);
            points.places[p].primitives = hits.primitives;
            seen[p] = emission(scene, tracer, p, points.surfaces[p].emission, *active & !hits.any());
        }
    }

    /// Follows rays, also from mirror to mirror, and through what is not seen from the back.
    #[inline(always)]
    fn reflect(&mut self, active: &[M8]) {
        let Self { scene, tracer, points, seen, .. } = self;
        let (world, count) = (&scene.surfaces, active.len());
        let mut going = [M8::splat(false); GROUP];
        going[..count].copy_from_slice(active);
        seen[..count].fill(V8::default());
        for depth in 0.. {
            let mut hits = [Hits::none(X8::lit(f64::INFINITY)); GROUP];
            world.bvh.closest(&tracer.camera[..count], &going[..count], &mut hits[..count], &mut tracer.scratch);
            let mut on = false;
            for p in 0..count {
                if depth == 0 {
                    points.start(p);
                }
                let here = std::mem::replace(&mut going[p], M8::splat(false));
                if !here.any() {
                    continue;
                }
                let mut surface = world.hit(&hits[p], &tracer.camera[p]);
                let emitted = emission(scene, tracer, p, surface.emission, here & !hits[p].any());
                seen[p] += keep(product(points.ends[p].throughput, emitted), here);
                let (incoming, flat) = (tracer.camera[p].direction, surface.normal);
                let passed = world.unseen_backs(&hits[p], here, &tracer.camera[p]);
                let reflects = surface.reflects & here & !passed;
                // taken apart by reference, since a metal is large
                let (ref metal, smooth) = world.materials(&hits[p], reflects, incoming, &mut surface);
                let mirrors = metal.mirrors() & reflects;
                // the path ends at all but mirrors
                let ends = reflects & !mirrors;
                points.settle(p, ends, &surface, flat, (metal, smooth));
                let (end, place) = (&mut points.ends[p], &mut points.places[p]);
                end.direction = V8::blend(ends, incoming, end.direction);
                place.primitives = PrimitiveIds::pick(ends, hits[p].primitives, place.primitives);
                place.direct = if depth == 0 { ends } else { place.direct & !ends };
                if (mirrors | passed).any() && depth < self.depth {
                    let direction = mirrored(&surface, metal, mirrors, incoming, &mut end.throughput);
                    // the mirror image of a smooth normal may be below the flat surface
                    going[p] = mirrors & (direction.dot(flat).gt(X8::lit(0.0)) | !smooth);
                    let (mut from, mut to) = (surface.point, direction);
                    if passed.any() {
                        let rays = &tracer.camera[p];
                        from = V8::blend(passed, incoming.mul_add(hits[p].distance, rays.origin), from);
                        to = V8::blend(passed, incoming, to);
                        going[p] = going[p] | passed;
                    }
                    on |= going[p].any();
                    tracer.camera[p] = world.bvh.rays(from, to).leaving(hits[p].primitives);
                    tracer.count.mirror += u64::from(going[p].bits().count_ones());
                }
            }
            if !on {
                return;
            }
        }
    }
}

/// Radiance towards the rays of a packet: what is `emitted` where they hit, or that of the sky where they `missed`.
#[inline(always)]
fn emission(scene: &PreparedScene, tracer: &Tracer, packet: usize, emitted: V8, missed: M8) -> V8 {
    let rays = &tracer.camera[packet];
    match &scene.sky {
        Some(sky) if missed.any() => V8::blend(missed, sky.radiance(rays.origin, rays.direction), emitted),
        _ => emitted,
    }
}

/// The directions in which mirrors reflect rays in these lanes, whose throughput they reduce.
#[inline]
fn mirrored(surface: &Surface, metal: &Metal, lanes: M8, direction: V8, throughput: &mut V8) -> V8 {
    let cos = -direction.dot(surface.normal);
    *throughput = V8::blend(lanes, product(*throughput, metal.reflectance(cos)), *throughput);
    surface.normal.mul_add(cos + cos, direction).normalize()
}
