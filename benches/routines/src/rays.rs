//! Rays as a renderer traces them through the triangles of a scene: camera rays, shadow rays, and ambient occlusion.

use crate::baseline::{self, Baseline, BaselineRay};
use etendue::sequence::{Independent, Sequence};
use etendue::warp::{CosineHemisphere, Warp};
use etendue::{Frame, Mask, Real, u32x8};
use etendue_render::bvh::{Bvh, GROUP, Hits, PrimitiveIds, Rays, Scratch, ShapeSet, Traversal};
use etendue_render::camera::Pinhole;
use etendue_render::packet::{M8, V8, X8};
use etendue_render::{
    choose::{ChoiceBy, Chooser, Choosers},
    lights::Lights,
    technique::Measure,
};
use std::path::Path;

/// Side of the image that pixels are taken from.
const SIDE: u32 = 256;

/// The kinds of rays, each in groups of 64.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// Camera rays through one pixel, closest hit.
    Pixel,
    /// Camera rays through 8 × 8 pixels, closest hit.
    Camera,
    /// Shadow rays from the hits of one pixel to lights, any hit.
    ShadowOfPoint,
    /// Shadow rays from the hits of 8 × 8 pixels to lights, any hit.
    ShadowOfPixels,
    /// Rays of length 1 from the hits of 8 × 8 pixels into the hemisphere, any hit.
    Ambient,
    /// The shadow rays of 8 × 8 pixels from all groups, in random order.
    Shuffled,
}

impl RayKind {
    /// All kinds, with names.
    pub const ALL: [(Self, &'static str); 6] = [
        (Self::Pixel, "camera, a pixel"),
        (Self::Camera, "camera, 8x8 pixels"),
        (Self::ShadowOfPoint, "shadow, a pixel"),
        (Self::ShadowOfPixels, "shadow, 8x8 pixels"),
        (Self::Ambient, "ambient occlusion"),
        (Self::Shuffled, "shadow, shuffled"),
    ];
    fn nearest(self) -> bool {
        matches!(self, Self::Pixel | Self::Camera)
    }
}

/// The ways to trace rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum How {
    /// obvhs, ray by ray.
    Obvhs,
    /// The renderer's tree, ray by ray.
    Single,
    /// The renderer's tree, in groups.
    Groups,
}

impl How {
    /// All ways, with names.
    pub const ALL: [(Self, &'static str); 3] =
        [(Self::Obvhs, "obvhs, per ray"), (Self::Single, "single"), (Self::Groups, "groups")];
}

/// Eight rays, before the preparation for tracing.
#[derive(Clone, Copy)]
struct Packet {
    origin: V8,
    direction: V8,
    active: M8,
    limit: X8,
}

type Group = [Packet; GROUP];

/// Rays of every kind through one scene.
pub struct Workload {
    single: Bvh,
    groups: Bvh,
    baseline: Baseline,
    kinds: Vec<(Vec<Group>, Vec<BaselineRay>)>,
}

/// The active rays, one by one.
fn each(groups: &[Group]) -> impl Iterator<Item = ([f32; 3], [f32; 3], f32)> {
    groups.iter().flatten().flat_map(|p| {
        (0..8)
            .filter(|&i| p.active.lane(i))
            .map(|i| (p.origin.lane(i).into(), p.direction.lane(i).into(), p.limit.lane(i)))
    })
}

impl Workload {
    /// Prepares `groups` groups of 64 rays of each kind, spread over the image of a built-in scene.
    ///
    /// # Panics
    /// If there is no such scene.
    #[must_use]
    pub fn new(name: &str, groups: u32) -> Self {
        let scene = etendue_scene::load(name).expect("a built-in scene");
        let tree = |way| {
            let none = ShapeSet::none();
            Bvh::new(&scene.triangles, none).expect("as many triangles as fit").with_traversal(way)
        };
        let (single, bvh) = (tree(Traversal::Single), tree(Traversal::Choose));
        let random = Independent::new(1);
        let lanes = u32x8::from([0, 1, 2, 3, 4, 5, 6, 7]);
        let pinhole = Pinhole::new(&scene.camera, SIDE, SIDE);
        let camera = |block: bool| -> Vec<Group> {
            let group = |group| {
                let [x, y] = random.words(group, 0, 3).map(|w| ((w >> 16) * (SIDE - 8)) >> 16)[..2] else {
                    unreachable!()
                };
                std::array::from_fn(|p| {
                    let p = p as u32;
                    let (dx, dy) = if block { (lanes, p) } else { (u32x8::splat(0), 0) };
                    let jitter = random.pair::<X8>(u32x8::splat(group), lanes + u32x8::splat(8 * p), 0);
                    let across = X8::from_uint(u32x8::splat(x) + dx) + jitter.x;
                    let down = X8::from_uint(u32x8::splat(y + dy)) + jitter.y;
                    let (origin, direction) = pinhole.ray(across, down);
                    Packet { origin, direction, active: M8::splat(true), limit: X8::lit(f64::INFINITY) }
                })
            };
            (0..groups).map(group).collect()
        };
        let lights = Lights::new(&scene, None);
        let choosers = Choosers::new(&lights, bvh.reach()).expect("few lights");
        let chooser = choosers.by(&lights, ChoiceBy::Auto).expect("the default");
        let mut stack = Scratch::default();
        let mut from_hits = |camera: &[Group], make: &dyn Fn(&Point, etendue::Vec2<X8>) -> Packet| -> Vec<Group> {
            let group = |(group, index): (&Group, u32)| {
                let hits = closest(&bvh, group, &mut stack);
                std::array::from_fn(|p| {
                    let u = random.pair(u32x8::splat(index), lanes + u32x8::splat(8 * p as u32), 1);
                    make(&Point::new(&bvh, &group[p], &hits[p]), u)
                })
            };
            camera.iter().zip(0..).map(group).collect()
        };
        let (pixel, block) = (camera(false), camera(true));
        let to_light = |point: &Point, u| point.to_light(&lights, chooser, u);
        let of_point = from_hits(&pixel, &to_light);
        let of_pixels = from_hits(&block, &to_light);
        let ambient = from_hits(&block, &|point, u| point.hemisphere(u));
        let shuffled = shuffled(&of_pixels);
        let kinds = [pixel, block, of_point, of_pixels, ambient, shuffled].map(|groups| {
            let rays = each(&groups).map(|(o, d, limit)| baseline::ray(o, d, limit)).collect();
            (groups, rays)
        });
        Self { single, groups: bvh, baseline: Baseline::new(&scene.triangles), kinds: kinds.into() }
    }

    /// Writes the triangles of the scene and some kinds of rays to files that `benches/examples/trace.rs` reads: `triangles`, `camera`,
    /// `shadow` and `shuffled`, and `bounce`, which are the rays into the hemisphere without a limit.
    ///
    /// # Errors
    /// Fails if a file cannot be written.
    ///
    /// # Panics
    /// If there is no such scene.
    pub fn write(&self, name: &str, folder: &Path) -> std::io::Result<()> {
        let write = |file: &str, numbers: &mut dyn Iterator<Item = f32>| {
            std::fs::write(folder.join(file), numbers.flat_map(f32::to_le_bytes).collect::<Vec<_>>())
        };
        let triangles = etendue_scene::load(name).expect("a built-in scene").triangles;
        write("triangles", &mut triangles.into_flattened().into_flattened().into_iter())?;
        for (file, kind) in [
            ("camera", RayKind::Camera),
            ("shadow", RayKind::ShadowOfPixels),
            ("shuffled", RayKind::Shuffled),
            ("bounce", RayKind::Ambient),
        ] {
            let limit = |limit: f32| if kind == RayKind::Ambient { f32::INFINITY } else { limit };
            let row = |(o, d, far): ([f32; 3], [f32; 3], f32)| [o[0], o[1], o[2], 0.0, d[0], d[1], d[2], limit(far)];
            write(file, &mut each(&self.kinds[kind as usize].0).flat_map(row))?;
        }
        Ok(())
    }

    /// The number of rays of a kind.
    #[must_use]
    pub fn rays(&self, kind: RayKind) -> u64 {
        self.kinds[kind as usize].1.len() as u64
    }

    /// Traces all rays of a kind and returns the number of hits.
    pub fn trace(&self, kind: RayKind, how: How, stack: &mut Scratch) -> u64 {
        let (groups, rays) = &self.kinds[kind as usize];
        let bvh = match how {
            How::Obvhs if kind.nearest() => {
                return rays.iter().filter_map(|&r| self.baseline.closest(r)).count() as u64;
            }
            How::Obvhs => return rays.iter().filter(|&&r| self.baseline.occluded(r)).count() as u64,
            How::Single => &self.single,
            How::Groups => &self.groups,
        };
        let count = |m: M8| u64::from(m.bits().count_ones());
        if kind.nearest() {
            let met = |group| closest(bvh, group, stack).map(|h| count(h.any())).iter().sum::<u64>();
            return groups.iter().map(met).sum();
        }
        let hidden = |group: &Group| {
            let rays: [Rays; GROUP] = std::array::from_fn(|p| bvh.rays(group[p].origin, group[p].direction));
            let before = group.map(|p| p.active);
            let mut active = before;
            bvh.occluded(&rays, &mut active, &group.map(|p| p.limit), &[PrimitiveIds::none(); GROUP], stack);
            before.iter().zip(active).map(|(&b, a)| count(b & !a)).sum::<u64>()
        };
        groups.iter().map(hidden).sum()
    }
}

/// The active rays of all groups in random order; an incomplete last group is dropped.
fn shuffled(groups: &[Group]) -> Vec<Group> {
    let mut rays: Vec<_> = each(groups).collect();
    let random = Independent::new(2);
    for i in (1..rays.len()).rev() {
        let [word, ..] = random.words(0, i as u32, 0);
        rays.swap(i, ((u64::from(word) * (i as u64 + 1)) >> 32) as usize);
    }
    let whole = rays.chunks_exact(8 * GROUP).map(|rays| {
        std::array::from_fn(|p| {
            let vector = |f: &dyn Fn(usize) -> [f32; 3]| {
                let axis = |k: usize| X8::from_fn(|i| f(8 * p + i)[k]);
                V8::new(axis(0), axis(1), axis(2))
            };
            Packet {
                origin: vector(&|i| rays[i].0),
                direction: vector(&|i| rays[i].1),
                active: M8::splat(true),
                limit: X8::from_fn(|i| rays[8 * p + i].2),
            }
        })
    });
    whole.collect()
}

fn closest(bvh: &Bvh, group: &Group, stack: &mut Scratch) -> [Hits; GROUP] {
    let rays: [Rays; GROUP] = std::array::from_fn(|p| bvh.rays(group[p].origin, group[p].direction));
    let mut hits = group.map(|p| Hits::none(p.limit));
    bvh.closest(&rays, &group.map(|p| p.active), &mut hits, stack);
    hits
}

/// Points at which rays hit triangles.
struct Point {
    met: M8,
    normal: V8,
    place: V8,
}

impl Point {
    fn new(bvh: &Bvh, packet: &Packet, hits: &Hits) -> Self {
        let met = hits.any();
        let mut normal = V8::default();
        for lane in (0..8).filter(|&i| met.lane(i)) {
            let c = bvh.corners(hits.primitives.lane(lane));
            let corner = |k: usize| V8::from([c[k], c[k + 1], c[k + 2]]);
            let n = (corner(3) - corner(0)).cross(corner(6) - corner(0)).normalize();
            normal = V8::blend(M8::from_bits(1 << lane), n, normal);
        }
        let away = normal.dot(packet.direction).gt(X8::lit(0.0));
        let normal = V8::new(normal.x.negate_where(away), normal.y.negate_where(away), normal.z.negate_where(away));
        let place = packet.direction.mul_add(hits.distance.keep(met), packet.origin) + normal * X8::lit(1e-4);
        Self { met, normal, place }
    }
    /// Rays to points on lights, sampled by solid angle.
    fn to_light(&self, lights: &Lights, chooser: &Chooser, u: etendue::Vec2<X8>) -> Packet {
        let zero = X8::lit(0.0);
        let choice = chooser.choose(self.place, self.normal, None, [u.x, zero]);
        let (chosen, u) = (lights.chosen(choice.index), etendue::Vec2::new(choice.u, u.y));
        let sample = lights.sample(&chosen, Measure::SolidAngle, self.place, self.normal, u).to;
        let active = self.met & sample.emits & sample.pdf.gt(zero) & sample.direction.dot(self.normal).gt(zero);
        let limit = sample.distance * X8::lit(1.0 - 1.0 / 131_072.0);
        Packet { origin: self.place, direction: sample.direction, active, limit }
    }
    /// Rays into the hemisphere, cosine-distributed.
    fn hemisphere(&self, u: etendue::Vec2<X8>) -> Packet {
        let direction = Frame::new(self.normal).to_world(CosineHemisphere.sample(u));
        Packet { origin: self.place, direction, active: self.met, limit: X8::lit(1.0) }
    }
}
