//! What some pixels see of a primitive.

use super::counts::Counts;
use super::scenes::light_point;
use super::segments::{EXACT, Meets, meets, meets_triangle};
use crate::meshes::Random;
use etendue::{Mask, Real, Vec3, f32x8, u32x8};
use etendue_oracle::{V3, along, cross, dot, length, sub, unit, wide};
use etendue_render::bvh::{GROUP, Hits, NOTHING, SHAPE, Scratch};
use etendue_render::camera::Pinhole;
use etendue_render::certify::{Patch, Pyramid, Viewer};
use etendue_render::packet::M8;
use etendue_render::scene::{CameraSettings, Geometry, Scene, Screen};
use etendue_render::surfaces::Surfaces;

/// A scene to be tested.
pub(crate) struct World {
    pub(crate) name: String,
    pub(crate) scene: Scene,
    pub(crate) surfaces: Surfaces,
}

/// A shading point, with the normal on the side of the viewer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) p: V3,
    pub(crate) normal: V3,
    /// Whether a ray has found it.
    pub(crate) traced: bool,
    /// A point of the light to be tested first.
    pub(crate) to: Option<V3>,
}

/// What some pixels show of a primitive.
pub(crate) struct View {
    pub(crate) pyramid: Pyramid,
    pub(crate) receiver: u32,
    pub(crate) patch: Patch,
    pub(crate) points: Vec<Point>,
    /// The only light to be tested.
    pub(crate) light: Option<u32>,
}

impl World {
    /// Does a primitive meet the segment from p to y, up to the fraction of shadow rays?
    pub(crate) fn occluded(&self, p: V3, y: V3, receiver: u32, light: usize) -> Meets {
        let segment = [p, along(p, sub(y, p), 1.0 - 1.0 / 131_072.0)];
        let own = if receiver & SHAPE == 0 { self.surfaces.bvh.order()[receiver as usize] } else { NOTHING };
        let mut worst = Meets::No;
        let triangles = (0..).zip(&self.scene.triangles).filter(|(id, _)| *id != own);
        let shapes = (0..).zip(self.scene.shapes.iter());
        let shapes = shapes.filter(|(id, _)| id | SHAPE != receiver && *id as usize != light);
        let all = triangles.map(|(_, t)| meets_triangle(segment, t.map(wide), EXACT));
        for met in all.chain(shapes.map(|(_, s)| meets(segment, &s.geometry))) {
            match met {
                Meets::Yes => return Meets::Yes,
                Meets::Unclear => worst = Meets::Unclear,
                Meets::No => {}
            }
        }
        worst
    }
    /// The normal on the side of a viewer.
    fn normal(&self, place: u32, p: V3, viewer: V3) -> V3 {
        if place & SHAPE != 0 {
            let Geometry::Sphere { center, .. } = self.scene.shapes[(place & !SHAPE) as usize].geometry else {
                unreachable!("flat shapes are no receivers")
            };
            return unit(sub(p, wide(center)));
        }
        let [a, b, c] = self.scene.triangles[self.surfaces.bvh.order()[place as usize] as usize].map(wide);
        let normal = unit(cross(sub(b, a), sub(c, a)));
        if dot(normal, sub(viewer, a)) < 0.0 { normal.map(|x| -x) } else { normal }
    }
    /// Looks at the scene through random pixels: what they show of a primitive, and shading points there.
    pub(crate) fn look(
        &self,
        random: &mut Random,
        place: impl Fn([f32; 3]) -> [f32; 3],
        c: &mut Counts,
    ) -> Option<View> {
        let distance = if random.below(4) == 0 { 20.0 } else { 1.9 };
        let origin = wide(place(random.point().map(|x| x * distance)));
        let target = if self.scene.triangles.is_empty() || random.below(8) == 0 {
            wide(place(random.point()))
        } else {
            let t = self.scene.triangles[random.below(self.scene.triangles.len())].map(wide);
            let (u, v) = (f64::from(random.unit()), f64::from(random.unit()));
            along(along(t[0], sub(t[1], t[0]), u * (1.0 - v)), sub(t[2], t[0]), v)
        };
        self.look_at(origin, target, random, c)
    }
    /// Looks from a place at a target through random pixels.
    pub(crate) fn look_at(&self, origin: V3, target: V3, random: &mut Random, c: &mut Counts) -> Option<View> {
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
        let mut points: Vec<Point> = Vec::new();
        let viewer = wide(origin.map(|x| x as f32));
        for (hits, rays) in hits.iter().zip(&rays) {
            let surface = self.surfaces.hit(hits, rays);
            for lane in (0..8).filter(|&i| hits.place.to_array()[i] == receiver) {
                let p = surface.point.lane(lane);
                let p = wide([p.x, p.y, p.z]);
                points.push(Point { p, normal: self.normal(receiver, p, viewer), traced: true, to: None });
                self.measure(&patch, p, c);
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
                points.push(Point { p, normal, traced: false, to: None });
            }
        }
        Some(View { pyramid, receiver, patch, points, light: None })
    }
    /// The world with one more triangle, that just touches a segment of the view: it is either a needle with its tip beyond the segment,
    /// or a large triangle with an edge that does not reach the segment.
    pub(crate) fn with_edge(&self, view: &View, random: &mut Random) -> Option<(Self, View)> {
        if view.receiver & SHAPE != 0 {
            return None;
        }
        let lights: Vec<u32> = self.surfaces.light_shapes().collect();
        let light = *lights.get(random.below(lights.len()))?;
        let Point { p, normal, traced, .. } = view.points[random.below(view.points.len())];
        let y = light_point(&self.scene.shapes[light as usize].geometry, p, random);
        let to_light = sub(y, p);
        let at = match random.below(8) {
            0 => 1.0 - f64::from(random.unit()) / 8192.0,
            1 => f64::from(random.unit()) / 8192.0,
            _ => f64::from(random.unit()),
        };
        let x = along(p, to_light, at);
        let out = unit(cross(to_light, wide(random.point())));
        let side = unit(along(cross(to_light, out), to_light, 0.5 * f64::from(random.signed())));
        let scale = length(to_light);
        let reach = x.iter().fold(scale, |m: f64, x| m.max(x.abs()));
        let beyond = [1e-5, 1e-4, 1e-6][random.below(3)] * reach;
        let corners = if random.below(2) == 0 {
            let end = along(x, out, 0.3 * scale);
            [along(x, out, -beyond), along(end, side, 0.1 * scale), along(end, side, -0.1 * scale)]
        } else {
            let edge = along(x, out, -beyond);
            [along(edge, side, 20.0 * scale), along(edge, side, -20.0 * scale), along(edge, out, -20.0 * scale)]
        };
        let mut scene = self.scene.clone();
        scene.triangles.push(corners.map(|v| v.map(|x| x as f32)));
        scene.triangle_materials.push(0);
        let surfaces = Surfaces::new(&scene).unwrap();
        let id = self.surfaces.bvh.order()[view.receiver as usize];
        let receiver = surfaces.bvh.order().iter().position(|&other| other == id)? as u32;
        let patch = Patch::of(&surfaces, receiver, Viewer::Pixels(&view.pyramid))?;
        let points = vec![Point { p, normal, traced, to: Some(y) }];
        let view = View { pyramid: view.pyramid, receiver, patch, points, light: Some(light) };
        Some((Self { name: format!("an edge in {}", self.name), scene, surfaces }, view))
    }
    /// How far a shading point is outside of its patch, and how high above it.
    fn measure(&self, patch: &Patch, p: V3, c: &mut Counts) {
        c.points += 1;
        let corners: Vec<V3> = patch.corners().collect();
        let Some(normal) = patch.normal() else {
            for k in 0..3 {
                let low = corners.iter().map(|q| q[k]).fold(f64::INFINITY, f64::min);
                let high = corners.iter().map(|q| q[k]).fold(f64::NEG_INFINITY, f64::max);
                c.off = c.off.max((low - p[k]).max(p[k] - high) / patch.margin());
            }
            return;
        };
        let height = dot(normal, sub(p, corners[0]));
        c.height = c.height.min(height / patch.least_height());
        c.off = c.off.max(height / patch.margin());
        let center = corners.iter().fold([0.0; 3], |s, &q| along(s, q, 1.0 / corners.len() as f64));
        for (i, &a) in corners.iter().enumerate() {
            let edge = sub(corners[(i + 1) % corners.len()], a);
            let out = unit(cross(edge, normal));
            // short edges of a clipped polygon are nothing but rounding
            if out[0].is_finite() && length(edge) > patch.margin() {
                let out = if dot(out, sub(center, a)) > 0.0 { out.map(|x| -x) } else { out };
                c.off = c.off.max(dot(out, sub(p, a)) / patch.margin());
            }
        }
    }
    /// Is a shadow ray of the renderer unoccluded?
    pub(crate) fn sees(&self, p: V3, y: V3, light: u32) -> bool {
        let d = sub(y, p);
        let splat = |v: V3| Vec3::<f32x8>::from(v.map(|x| x as f32));
        let ray = self.surfaces.bvh.rays(splat(p), splat(unit(d)));
        let limit = f32x8::splat(length(d) as f32) * f32x8::lit(1.0 - 1.0 / 131_072.0);
        let mut open = [M8::splat(true)];
        self.surfaces.bvh.occluded(&[ray], &mut open, &[limit], &[u32x8::splat(light)], &mut Scratch::default());
        open[0].any()
    }
}
