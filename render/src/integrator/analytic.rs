//! Direct light of diffuse surfaces without random numbers, where geometry tells what occludes it.

use super::tile::TILE;
use crate::bvh::GROUP;
use crate::camera::{Camera, Pinhole};
use crate::certificates::{Blocker, Certificate, Certifier, Bodies, Patch, Pyramid, Viewer};
use crate::geometry::Geometry;
use crate::packet::{M8, V8, X8, equal};
use crate::surfaces::{Surface, Surfaces};
use etendue::occlusion::{Convex, Occlusion};
use etendue::{Mask, Real, Vec3, u32x8};
use std::f64::consts::FRAC_1_PI;
use std::ops::Range;

/// A light with an area.
struct AreaLight {
    /// Index of its shape.
    shape: usize,
    form: Convex<'static, f32>,
    radiance: [f32; 3],
    /// A point and the normal of the side that emits, if only one does.
    side: Option<[V8; 2]>,
}

/// What is known of a light, as seen from a part of a surface.
#[derive(Clone, Debug)]
enum Known {
    Lit,
    Dark,
    /// Only these of the blockers can occlude it.
    Behind(Range<usize>),
    /// It must be sampled.
    Nothing,
}

/// The certificates of all lights for the part of a surface that a square of pixels sees.
#[derive(Debug)]
struct Entry {
    place: u32,
    /// Index of the first of its certificates, one for each light.
    first: usize,
}

/// Sides of the squares of pixels with certificates of their own, which lie within each other.
const SIDES: [u32; 3] = [16, 4, 1];

/// The lights of a scene, and certificates for the surfaces in a tile.
pub(super) struct Analytic<'a> {
    surfaces: &'a Surfaces,
    bodies: &'a Bodies,
    lights: Vec<AreaLight>,
    certifier: Certifier<'a>,
    occlusion: Box<Occlusion<X8>>,
    /// For each level, the certificates of each square of the tile, row by row.
    squares: [Vec<Vec<Entry>>; SIDES.len()],
    known: Vec<Known>,
    forms: Vec<Convex<'a, f32>>,
    camera: Option<Pinhole>,
    origin: [u32; 2],
    pub(super) counts: [u64; 4],
}

fn corner(v: [f32; 3]) -> Vec3<f32> {
    v.into()
}

fn convex<'a>(blocker: &Blocker, bodies: &'a Bodies) -> Convex<'a, f32> {
    match *blocker {
        Blocker::Polygon { corners, count, .. } => Convex::Polygon { corners: corners.map(corner), count },
        Blocker::Sphere { center, radius, .. } => Convex::Sphere { center: corner(center), radius },
        Blocker::Body(body) => Convex::Polyhedron(bodies.polyhedron(body)),
    }
}

fn form(geometry: &Geometry) -> Convex<'static, f32> {
    match *geometry {
        Geometry::Sphere { center, radius } => Convex::Sphere { center: corner(center), radius },
        Geometry::Triangle([a, b, c]) => Convex::Polygon { corners: [a, b, c, c].map(corner), count: 3 },
        Geometry::Parallelogram { p, u, v } => {
            let (p, u, v) = (corner(p), corner(u), corner(v));
            Convex::Polygon { corners: [p, p + u, p + u + v, p + v], count: 4 }
        }
    }
}

impl<'a> Analytic<'a> {
    pub(super) fn new(surfaces: &'a Surfaces, bodies: &'a Bodies) -> Self {
        let light = |(shape, all): (usize, &crate::scene::Shape)| {
            let emission = all.emission?;
            let side = match all.geometry {
                Geometry::Sphere { .. } => None,
                _ if emission.two_sided => None,
                Geometry::Triangle([p, _, _]) | Geometry::Parallelogram { p, .. } => {
                    Some([p.into(), all.geometry.normal().into()])
                }
            };
            Some(AreaLight { shape, form: form(&all.geometry), radiance: emission.radiance, side })
        };
        Self {
            surfaces,
            bodies,
            lights: surfaces.shapes().iter().enumerate().filter_map(light).collect(),
            certifier: Certifier::new(surfaces, bodies, surfaces.light_shapes()),
            occlusion: Box::default(),
            squares: SIDES.map(|side| (0..(TILE / side).pow(2)).map(|_| Vec::new()).collect()),
            known: Vec::new(),
            forms: Vec::new(),
            camera: None,
            origin: [0; 2],
            counts: [0; 4],
        }
    }

    /// Number of lights.
    pub(super) fn lights(&self) -> usize {
        self.lights.len()
    }

    /// Forgets the certificates, and prepares for the samples of a tile.
    pub(super) fn begin(&mut self, camera: &Camera, origin: [u32; 2]) {
        self.squares.iter_mut().flatten().for_each(Vec::clear);
        self.known.clear();
        self.forms.clear();
        self.camera = if let Camera::Pinhole(pinhole) = camera { Some(*pinhole) } else { None };
        self.origin = origin;
    }

    /// Index of the first certificate for what the square of a level about a pixel sees of a primitive.
    fn find(&mut self, place: u32, pixel: [u32; 2], level: usize) -> usize {
        let side = SIDES[level];
        let [x, y] = [0, 1].map(|k| (pixel[k] - self.origin[k]) / side);
        let square = (y * (TILE / side) + x) as usize;
        if let Some(entry) = self.squares[level][square].iter().find(|entry| entry.place == place) {
            return entry.first;
        }
        let parent = (level > 0).then(|| self.find(place, pixel, level - 1));
        let first = self.known.len();
        let open = parent.is_none_or(|parent| {
            self.known[parent..parent + self.lights.len()].iter().any(|k| matches!(k, Known::Behind(_) | Known::Nothing))
        });
        let Self { surfaces, bodies, lights, certifier, forms, .. } = self;
        let corner = [0, 1].map(|k| self.origin[k] + [x, y][k] * side);
        let patch = self.camera.filter(|_| open).and_then(|camera| {
            let [x, y] = corner.map(f64::from);
            let side = f64::from(side);
            let pyramid = Pyramid::of(&camera, [x, y, x + side, y + side]);
            Patch::of(surfaces, place, Viewer::Pixels(&pyramid))
        });
        for k in 0..lights.len() {
            let before = parent.map_or(Known::Nothing, |parent| self.known[parent + k].clone());
            if matches!(before, Known::Lit | Known::Dark) {
                self.known.push(before);
                continue;
            }
            let Some(patch) = &patch else {
                self.known.push(before);
                continue;
            };
            let known = match certifier.certify(patch, k) {
                Certificate::Lit => Known::Lit,
                Certificate::Dark => Known::Dark,
                Certificate::Unknown => Known::Nothing,
                Certificate::Blockers(found) => {
                    let start = forms.len();
                    forms.extend(found.iter().map(|blocker| convex(blocker, bodies)));
                    Known::Behind(start..forms.len())
                }
            };
            self.counts[match known {
                Known::Lit => 0,
                Known::Dark => 1,
                Known::Behind(_) => 2,
                Known::Nothing => 3,
            }] += 1;
            self.known.push(known);
        }
        self.squares[level][square].push(Entry { place, first });
        first
    }

    /// Adds the light that is known, and returns for each light the lanes in which it must be sampled.
    pub(super) fn gather(
        &mut self,
        surfaces: &[Surface],
        places: &[u32x8; GROUP],
        squares: &[([u32; 2], usize); GROUP],
        reflected: &mut [V8; GROUP],
        unknown: &mut [[M8; GROUP]],
    ) {
        for (p, surface) in surfaces.iter().enumerate().filter(|(_, surface)| surface.reflects.any()) {
            let mut parts = [(0, M8::splat(false)); 8];
            let mut count = 0;
            let mut left = surface.reflects;
            while left.any() {
                let place = places[p].as_array()[left.bits().trailing_zeros() as usize & 7];
                let here = left & equal(places[p], u32x8::splat(place));
                parts[count] = (self.find(place, squares[p].0, squares[p].1), here);
                count += 1;
                left = left & !here;
            }
            let mut sum = V8::default();
            for (k, light) in self.lights.iter().enumerate() {
                let mut lit = M8::splat(false);
                let mut part = X8::lit(0.0);
                for (first, lanes) in &parts[..count] {
                    match &self.known[first + k] {
                        Known::Lit => lit = lit | *lanes,
                        Known::Dark => {}
                        Known::Nothing => unknown[k][p] = unknown[k][p] | *lanes,
                        Known::Behind(range) => {
                            let blockers = &self.forms[range.clone()];
                            // the other lanes repeat one of these, so that what they see does not matter
                            let one = surface.point.lane(lanes.bits().trailing_zeros() as usize & 7);
                            let point = V8::blend(*lanes, surface.point, V8::splat(one));
                            match self.occlusion.visible(point, surface.normal, &light.form, blockers) {
                                Some(visible) => part += visible.keep(*lanes),
                                None => unknown[k][p] = unknown[k][p] | *lanes,
                            }
                        }
                    }
                }
                if lit.any() {
                    let all = self.occlusion.visible(surface.point, surface.normal, &light.form, &[]);
                    part += all.unwrap_or_default().keep(lit);
                }
                if let Some([corner, normal]) = &light.side {
                    part = part.keep((surface.point - *corner).dot(*normal).gt(X8::lit(0.0)));
                }
                sum += V8::from(light.radiance) * part;
            }
            let scale = X8::lit(FRAC_1_PI);
            let V8 { x, y, z } = surface.albedo;
            reflected[p] += V8::new(x * sum.x, y * sum.y, z * sum.z) * scale;
        }
    }
}
