//! What some pixels see of a primitive.

use crate::meshes::Random;
use etendue::{Mask, Real, f32x8};
use etendue_oracle::{V3, along, cross, dot, length, sub, unit, wide};
use etendue_render::bvh::{GROUP, Hits, NOTHING, SHAPE, Scratch};
use etendue_render::camera::Pinhole;
use etendue_render::certify::{Patch, Pyramid, Viewer};
use etendue_render::packet::M8;
use etendue_render::scene::{CameraSettings, Geometry, Scene, Screen, Sphere};
use etendue_render::surfaces::Surfaces;

/// A scene to be tested.
pub(crate) struct World {
    pub(crate) name: String,
    pub(crate) scene: Scene,
    pub(crate) surfaces: Surfaces,
}

/// What some pixels show of a primitive, and shading points there, each with the normal on the side of the viewer.
pub(crate) struct View {
    pub(crate) receiver: u32,
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
    fn normal(&self, place: u32, p: V3, viewer: V3) -> V3 {
        if place & SHAPE != 0 {
            let Geometry::Sphere(Sphere { center, .. }) = self.scene.shapes[(place & !SHAPE) as usize].geometry else {
                unreachable!("flat shapes are no receivers")
            };
            return unit(sub(p, wide(center)));
        }
        let [a, b, c] = self.scene.triangles[self.surfaces.bvh.order()[place as usize] as usize].map(wide);
        let normal = unit(cross(sub(b, a), sub(c, a)));
        if dot(normal, sub(viewer, a)) < 0.0 { normal.map(|x| -x) } else { normal }
    }
    /// Looks from a place at a target through random pixels.
    pub(crate) fn look_at(&self, origin: V3, target: V3, random: &mut Random, fit: &mut Fit) -> Option<View> {
        let forward = unit(sub(target, origin));
        let right = unit(cross(forward, wide(random.point())));
        let up = cross(right, forward);
        let camera = CameraSettings {
            origin,
            forward,
            right,
            up,
            // the tangents of half of 60, 1 and 0.001 degrees
            screen: Screen::Half(libm::tan([60.0_f64, 60.0, 1.0, 0.001][random.below(4)].to_radians() / 2.0)),
            ..self.scene.camera.clone()
        };
        let size = [8, 64, 512, 4096][random.below(4)];
        let pinhole = Pinhole::new(&camera, size, size);
        let corner = [0; 2].map(|_| (f64::from(size) * (0.5 + 0.1 * f64::from(random.signed()))).floor());
        let wideness = [1.0, 1.0, 4.0][random.below(3)];
        let area = [corner[0], corner[1], corner[0] + wideness, corner[1] + wideness];
        let pyramid = Pyramid::new(&pinhole, area);
        // rays anywhere in the rectangle, often at its corners and edges
        let mut hits = [Hits::none(f32x8::splat(f32::INFINITY)); GROUP];
        let mut inside = || {
            let x = random.unit();
            (((x * 1.5 - 0.25).clamp(0.0, 1.0)) * wideness as f32).min(wideness as f32)
        };
        let mut coordinates = |k: usize| f32x8::from_fn(|_| corner[k] as f32 + inside());
        let rays: [_; GROUP] = std::array::from_fn(|_| {
            let (x, y) = (coordinates(0), coordinates(1));
            let (origin, direction) = pinhole.ray(x, y);
            self.surfaces.bvh.rays(origin, direction)
        });
        self.surfaces.bvh.closest(&rays, &[M8::splat(true); GROUP], &mut hits, &mut Scratch::default());
        let places = |i: usize| hits[i / 8].place.to_array()[i % 8];
        let receiver = places(random.below(8 * GROUP));
        if receiver == NOTHING {
            return None;
        }
        let patch = Patch::of(&self.surfaces, receiver, Viewer::Pixels(&pyramid))?;
        let mut points: Vec<(V3, V3)> = Vec::new();
        let viewer = wide(origin.map(|x| x as f32));
        for (hits, rays) in hits.iter().zip(&rays) {
            let surface = self.surfaces.hit(hits, rays);
            for lane in (0..8).filter(|&i| hits.place.to_array()[i] == receiver) {
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
            if receiver & SHAPE == 0 {
                let mix = if k < 3 { 0.0 } else { f64::from(random.unit()) };
                let (a, b) = (corners[random.below(corners.len())], corners[random.below(corners.len())]);
                let normal = patch.normal().unwrap();
                let p = along(along(a, sub(b, a), mix), normal, patch.margin() / 4.0);
                points.push((p, normal));
            }
        }
        Some(View { receiver, patch, points })
    }
}
