//! What some pixels see of a primitive.

use super::pinned::Pinned;
use crate::random::Random;
use etendue::{Mask, Real, f32x8};
use etendue_oracle::{V3, along, cross, dot, length, sub, unit, wide};
use etendue_render::bvh::{GROUP, Hits, PrimitiveId, Scratch};
use etendue_render::camera::Pinhole;
use etendue_render::know::patch;
use etendue_render::packet::M8;
use etendue_render::scene::{CameraSettings, Geometry, Parallelogram, Scene, Screen, Sphere};
use etendue_render::surfaces::Surfaces;
use etendue_visible::{Patch, Viewer};

/// A scene to be tested.
pub(crate) struct World {
    pub(crate) name: String,
    pub(crate) scene: Scene,
    pub(crate) surfaces: Surfaces,
}

/// What some pixels show of a primitive, and shading points there, each with the normal on the side of the viewer.
pub(crate) struct View {
    pub(crate) receiver: PrimitiveId,
    pub(crate) patch: Patch,
    pub(crate) points: Vec<(V3, V3)>,
}

/// How well shading points fit their patches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit {
    /// The greatest share of its margin by which a point is outside of its patch.
    pub(crate) off: f64,
    /// Least height of a point over its plane, in units of the least height that the patch allows.
    pub(crate) height: f64,
}

impl Default for Fit {
    fn default() -> Self {
        Self { off: 0.0, height: f64::INFINITY }
    }
}

impl Fit {
    /// Includes what other points have shown.
    pub(crate) fn add(&mut self, other: Self) {
        *self = Self { off: self.off.max(other.off), height: self.height.min(other.height) };
    }
    fn of(patch: &Patch, p: V3) -> Self {
        let mut fit = Self::default();
        let corners: Vec<V3> = patch.corners().collect();
        let Some(normal) = patch.normal() else {
            for k in 0..3 {
                let low = corners.iter().map(|q| q[k]).fold(f64::INFINITY, f64::min);
                let high = corners.iter().map(|q| q[k]).fold(f64::NEG_INFINITY, f64::max);
                fit.off = fit.off.max((low - p[k]).max(p[k] - high) / patch.margin());
            }
            return fit;
        };
        let height = dot(normal, sub(p, corners[0]));
        fit.height = height / patch.least_height();
        fit.off = fit.off.max(height / patch.margin());
        let center = corners.iter().fold([0.0; 3], |s, &q| along(s, q, 1.0 / corners.len() as f64));
        for (i, &a) in corners.iter().enumerate() {
            let edge = sub(corners[(i + 1) % corners.len()], a);
            let out = unit(cross(edge, normal));
            // short edges of a clipped polygon are nothing but rounding
            if out[0].is_finite() && length(edge) > patch.margin() {
                let out = if dot(out, sub(center, a)) > 0.0 { out.map(|x| -x) } else { out };
                fit.off = fit.off.max(dot(out, sub(p, a)) / patch.margin());
            }
        }
        fit
    }
}

impl World {
    /// The normal on the side of a viewer.
    fn normal(&self, receiver: PrimitiveId, p: V3, viewer: V3) -> V3 {
        let Some(place) = receiver.triangle() else {
            let Some(&Geometry::Sphere(Sphere { center, .. })) =
                receiver.shape().map(|id| &self.scene.shapes[id].geometry)
            else {
                unreachable!("flat shapes are no receivers")
            };
            return unit(sub(p, wide(center)));
        };
        let [a, b, c] = self.scene.triangles[self.surfaces.bvh.order()[place as usize] as usize].map(wide);
        let normal = unit(cross(sub(b, a), sub(c, a)));
        if dot(normal, sub(viewer, a)) < 0.0 { normal.map(|x| -x) } else { normal }
    }
    /// What the pixels of a pinned view see.
    pub(crate) fn pinned(&self, pinned: &Pinned) -> Option<View> {
        let [origin, forward, right, up] = pinned.axes;
        let screen = Screen::Half(pinned.half);
        let camera = CameraSettings { origin, forward, right, up, screen, ..self.scene.camera.clone() };
        let pyramid = Pinhole::new(&camera, pinned.size, pinned.size).pyramid(pinned.area);
        let patch = patch(&self.surfaces, pinned.receiver, Viewer::Pixels(&pyramid))?;
        Some(View { receiver: pinned.receiver, patch, points: pinned.points.to_vec() })
    }
    /// Looks from a place at a target through random pixels.
    pub(crate) fn look_at(&self, origin: V3, target: V3, random: &mut Random, fit: &mut Fit) -> Option<View> {
        let forward = unit(sub(target, origin));
        let right = unit(cross(forward, random.point()));
        let up = cross(right, forward);
        let camera = CameraSettings {
            origin,
            forward,
            right,
            up,
            // the tangents of half of 60, 1 and 0.001 degrees
            screen: Screen::Half(libm::tan(random.of(&[60.0_f64, 60.0, 1.0, 0.001]).to_radians() / 2.0)),
            lens: None,
            ..self.scene.camera.clone()
        };
        let size = random.of(&[8, 64, 512, 4096]);
        let pinhole = Pinhole::new(&camera, size, size);
        let corner = [0; 2].map(|_| (f64::from(size) * random.between(0.4, 0.6)).floor());
        let wideness = random.of(&[1.0, 1.0, 4.0]);
        let area = [corner[0], corner[1], corner[0] + wideness, corner[1] + wideness];
        let pyramid = pinhole.pyramid(area);
        // rays anywhere in the rectangle, often at its corners and edges
        let mut hits = [Hits::none(f32x8::splat(f32::INFINITY)); GROUP];
        let mut inside = || random.between(-0.25, 1.25).clamp(0.0, 1.0) * wideness;
        let mut coordinates = |k: usize| f32x8::from_fn(|_| (corner[k] + inside()) as f32);
        let rays: [_; GROUP] = std::array::from_fn(|_| {
            let (x, y) = (coordinates(0), coordinates(1));
            let (origin, direction) = pinhole.ray(x, y);
            self.surfaces.bvh.rays(origin, direction)
        });
        self.surfaces.bvh.closest(&rays, &[M8::splat(true); GROUP], &mut hits, &mut Scratch::default());
        let primitives = |i: usize| hits[i / 8].primitives.lane(i % 8);
        let receiver = primitives(random.below(8 * GROUP));
        // lights of drafts reflect nothing
        let is_light = |index: usize| self.scene.shapes[index].emission.is_some();
        if receiver == PrimitiveId::NONE || receiver.shape().is_some_and(is_light) {
            return None;
        }
        let patch = patch(&self.surfaces, receiver, Viewer::Pixels(&pyramid))?;
        let mut points: Vec<(V3, V3)> = Vec::new();
        let viewer = wide(origin.map(|x| x as f32));
        for (hits, rays) in hits.iter().zip(&rays) {
            let surface = self.surfaces.hit(hits, rays);
            for lane in (0..8).filter(|&i| hits.primitives.lane(i) == receiver) {
                let p = surface.point.lane(lane);
                let p = wide([p.x, p.y, p.z]);
                points.push((p, self.normal(receiver, p, viewer)));
                fit.add(Fit::of(&patch, p));
            }
        }
        // some of them, and points of the patch that no ray has found
        while points.len() > 6 {
            points.swap_remove(random.below(points.len()));
        }
        let corners: Vec<V3> = patch.corners().collect();
        for k in 0..6 {
            if receiver.triangle().is_some() {
                let mix = if k < 3 { 0.0 } else { random.unit() };
                let (a, b) = (corners[random.below(corners.len())], corners[random.below(corners.len())]);
                let normal = patch.normal().unwrap();
                let p = along(along(a, sub(b, a), mix), normal, patch.margin() / 4.0);
                points.push((p, normal));
            }
        }
        Some(View { receiver, patch, points })
    }
    /// A view of a place where a light is seen past the edge of something, on one of the first `floors` triangles or on a sphere.
    pub(crate) fn look_past_edges(&self, floors: usize, random: &mut Random, fit: &mut Fit) -> Option<View> {
        let lights: Vec<u32> = self.surfaces.light_shapes().collect();
        let light = &self.scene.shapes[*lights.get(random.below(lights.len().max(1)))? as usize].geometry;
        let spheres = self.scene.shapes.iter().filter(|shape| shape.emission.is_none());
        let spheres: Vec<_> = spheres.collect();
        let y = light_point(light, random.point(), random);
        if !spheres.is_empty() && random.one_in(8) {
            let Geometry::Sphere(Sphere { center, radius }) = spheres[random.below(spheres.len())].geometry else {
                return None;
            };
            let target = along(wide(center), unit(random.point()), f64::from(radius));
            let out = unit(along(sub(target, wide(center)), random.point(), 0.5 * f64::from(radius)));
            let origin = along(target, out, f64::from(radius) * random.power(-1.0, 1.0));
            return self.look_at(origin, target, random, fit);
        }
        let [a, b, d] = self.scene.triangles[random.below(floors)].map(wide);
        let normal = unit(cross(sub(b, a), sub(d, a)));
        let triangles = &self.scene.triangles;
        let occluders = &triangles[if floors < triangles.len() { floors } else { 0 }..];
        let choice = random.below(occluders.len() + spheres.len());
        let x = if let Some(triangle) = occluders.get(choice).map(|t| t.map(wide)) {
            let k = random.below(3);
            along(triangle[k], sub(triangle[(k + 1) % 3], triangle[k]), random.unit())
        } else {
            let Geometry::Sphere(Sphere { center, radius }) = spheres[choice - occluders.len()].geometry else {
                return None;
            };
            let out = unit(cross(sub(wide(center), y), random.point()));
            along(wide(center), out, f64::from(radius))
        };
        let fall = dot(normal, sub(x, y));
        let target = along(y, sub(x, y), dot(normal, sub(a, y)) / fall);
        let inside = |p: V3, q: V3| dot(normal, cross(sub(q, p), sub(target, p))) >= 0.0;
        let is_met = inside(a, b) && inside(b, d) && inside(d, a) && length(sub(target, x)).is_finite();
        let target = if is_met {
            target
        } else {
            let (u, v) = (random.unit(), random.unit());
            along(along(a, sub(b, a), u * (1.0 - v)), sub(d, a), v)
        };
        let side = dot(normal, sub(y, target)).signum();
        let up = normal.map(|x| x * side);
        let out = unit(along(up, random.point(), random.power(-1.0, 1.0)));
        let out = if dot(out, up) > 0.0 { out } else { out.map(|x| -x) };
        let distance = length(sub(target, x)) * random.power(-1.7, 0.7);
        self.look_at(along(target, out, distance), target, random, fit)
    }
}

/// A point of a light that may be visible from p, often on its boundary.
fn light_point(geometry: &Geometry, p: V3, random: &mut Random) -> V3 {
    let snap = |x: f64| match (x * 8.0) as u32 {
        0 | 1 => 0.0,
        2 | 3 => 1.0,
        _ => (x * 2.0 - 1.0).clamp(0.0, 1.0),
    };
    let [mut s, mut t] = [random.unit(), random.unit()].map(snap);
    match *geometry {
        Geometry::Sphere(Sphere { center, radius }) => {
            let (c, r) = (wide(center), f64::from(radius));
            let axis = sub(p, c);
            let across = unit(cross(axis, random.point()));
            // from the middle of the visible cap to the silhouette
            let most = (r / length(axis)).clamp(-1.0, 1.0).acos();
            let angle = s.sqrt() * most;
            along(along(c, unit(axis), r * angle.cos()), across, r * angle.sin())
        }
        Geometry::Triangle(corners) => {
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            let [a, b, c] = corners.map(wide);
            along(along(a, sub(b, a), s), sub(c, a), t)
        }
        Geometry::Parallelogram(Parallelogram { p, u, v }) => along(along(wide(p), wide(u), s), wide(v), t),
        ref other => panic!("no points of {other:?}"),
    }
}
