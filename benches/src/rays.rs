//! Rays as a renderer traces them: from the camera, and from what they meet to the lights.

use etendue::sequence::{Independent, Sequence};
use etendue::{Mask, Real, u32x8};
use etendue_render::accel::{Accel, GROUP, Hits, M8, NOTHING, Rays, ShapeSet, Stack, V8, X8};
use etendue_render::camera::Pinhole;
use etendue_render::{
    lights::{Lights, Measure},
    scene,
};

/// Pixels across the image whose pixels are drawn from.
const SIDE: u32 = 256;

/// How the 64 rays of a group lie in the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// 64 samples of one pixel.
    Pixel,
    /// One sample of each of 8 × 8 pixels.
    Block,
}

/// Eight rays, as far as a renderer has them before it traces them.
#[derive(Clone, Copy)]
struct Packet {
    origin: V8,
    direction: V8,
    active: M8,
    limit: X8,
    target: u32x8,
}

type Group = [Packet; GROUP];

/// Camera rays and shadow rays of one scene.
pub struct Workload {
    accel: Accel,
    camera: Vec<Group>,
    shadow: Vec<Group>,
}

/// Rays that are alive.
fn count(groups: &[Group]) -> u64 {
    groups.iter().flatten().map(|p| u64::from(p.active.bits().count_ones())).sum()
}

impl Workload {
    /// Of a built-in scene; `groups` groups of 64 camera rays, spread over the image, and as many of shadow rays.
    ///
    /// # Panics
    /// There is no such scene.
    #[must_use]
    pub fn new(name: &str, groups: u32, spread: Spread) -> Self {
        let scene = scene::load(name).expect("a built-in scene");
        let shapes = ShapeSet::new(&scene.shapes).expect("few shapes");
        let accel = Accel::new(&scene.triangles, shapes).expect("as many triangles as fit");
        let pinhole = Pinhole::new(&scene.camera, SIDE, SIDE);
        let random = Independent::new(1);
        let lanes = u32x8::from([0, 1, 2, 3, 4, 5, 6, 7]);

        let camera: Vec<Group> = (0..groups)
            .map(|group| {
                // places in order of a bit-reversed index are spread evenly
                let [x, y] = random.words(group, 0, 3).map(|w| ((w >> 16) * (SIDE - 8)) >> 16)[..2] else {
                    unreachable!()
                };
                std::array::from_fn(|p| {
                    let p = p as u32;
                    let (dx, dy) = match spread {
                        Spread::Pixel => (u32x8::splat(0), 0),
                        Spread::Block => (lanes, p),
                    };
                    let jitter = random.pair::<X8>(u32x8::splat(group), lanes + u32x8::splat(8 * p), 0);
                    let across = X8::from_uint(u32x8::splat(x) + dx) + jitter.x;
                    let down = X8::from_uint(u32x8::splat(y + dy)) + jitter.y;
                    let (origin, direction) = pinhole.ray(across, down);
                    let limit = X8::lit(f64::INFINITY);
                    Packet { origin, direction, active: M8::splat(true), limit, target: u32x8::splat(NOTHING) }
                })
            })
            .collect();

        let lights = Lights::new(&scene, None);
        let mut stack = Stack::default();
        let shadow = camera
            .iter()
            .zip(0..)
            .map(|(group, index)| {
                let hits = closest(&accel, group, &mut stack);
                std::array::from_fn(|p| {
                    let u = random.pair(u32x8::splat(index), lanes + u32x8::splat(8 * p as u32), 1);
                    towards_light(&accel, &lights, &group[p], &hits[p], u)
                })
            })
            .collect();
        Self { accel, camera, shadow }
    }

    /// Number of camera rays and of shadow rays.
    #[must_use]
    pub fn rays(&self) -> [u64; 2] {
        [count(&self.camera), count(&self.shadow)]
    }

    /// Traces all camera rays: how many meet something.
    pub fn closest(&self, stack: &mut Stack) -> u64 {
        let met = |group| closest(&self.accel, group, stack).map(|h| u64::from(h.any().bits().count_ones()));
        self.camera.iter().flat_map(met).sum()
    }

    /// Traces all shadow rays: how many reach their light.
    pub fn occluded(&self, stack: &mut Stack) -> u64 {
        let visible = |group: &Group| {
            let rays: [Rays; GROUP] = std::array::from_fn(|p| self.accel.rays(group[p].origin, group[p].direction));
            let mut active = group.map(|p| p.active);
            self.accel.occluded(&rays, &mut active, &group.map(|p| p.limit), &group.map(|p| p.target), stack);
            active.map(|a| u64::from(a.bits().count_ones())).iter().sum::<u64>()
        };
        self.shadow.iter().map(visible).sum()
    }
}

fn closest(accel: &Accel, group: &Group, stack: &mut Stack) -> [Hits; GROUP] {
    let rays: [Rays; GROUP] = std::array::from_fn(|p| accel.rays(group[p].origin, group[p].direction));
    let mut hits = group.map(|p| Hits::none(p.limit));
    accel.closest(&rays, &group.map(|p| p.active), &mut hits, stack);
    hits
}

/// From where mesh triangles are met to a point of a light, by solid angle.
fn towards_light(accel: &Accel, lights: &Lights, packet: &Packet, hits: &Hits, u: etendue::Vec2<X8>) -> Packet {
    let zero = X8::lit(0.0);
    let met = hits.any() & !hits.shapes();
    let mut normal = V8::default();
    for lane in (0..8).filter(|&i| met.lane(i)) {
        let c = accel.corners(hits.place.as_array()[lane]);
        let corner = |k: usize| V8::from([c[k], c[k + 1], c[k + 2]]);
        let n = (corner(3) - corner(0)).cross(corner(6) - corner(0)).normalize();
        normal = V8::select(M8::from_bits(1 << lane), n, normal);
    }
    let away = normal.dot(packet.direction).gt(zero);
    let normal = V8::new(normal.x.negate_where(away), normal.y.negate_where(away), normal.z.negate_where(away));
    let origin = packet.direction.mul_add(hits.distance.keep(met), packet.origin) + normal * X8::lit(1e-4);
    let (mut chosen, rest) = lights.choose(u.x);
    let sample = lights.sample(&mut chosen, Measure::SolidAngle, origin, normal, etendue::Vec2::new(rest, u.y));
    let active = met & sample.emits & sample.pdf.gt(zero) & sample.direction.dot(normal).gt(zero);
    Packet {
        origin,
        direction: sample.direction,
        active,
        limit: sample.distance * X8::lit(1.0 - 1.0 / 131_072.0),
        target: chosen.shape,
    }
}
