//! Scenes of polygons and spheres, by regimes.

use super::truth::{polygon, sphere};
use crate::attack::build::{cube, placed};
use etendue_judge::generators::Random;
use etendue_judge::occlusion::Scene;
use etendue_oracle::{V3, along, basis, cross, dot, narrow, sub, unit, wide};
use etendue_visible::{Solid, V64};

/// An enumeration, and a list of all of its values.
macro_rules! kinds {
    ($(#[$doc:meta])* $name:ident, $all:ident: $($kind:ident)+) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Debug)]
        pub(crate) enum $name {
            $($kind),+
        }
        pub(crate) const $all: &[$name] = &[$($name::$kind),+];
    };
}
pub(super) use kinds;

kinds! {
    /// How shapes are placed.
    Difficulty, KINDS:
    Any Tiny Small Huge Far Near EdgeOn Horizon SliverLight SliverBlockers TouchLight TouchSurface Quads Fan Box Twice LightPlane CrossHorizon
    Axis Exact InPlane Sixteen
}

/// Which shapes are spheres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Round {
    None,
    Light,
    Occluders,
}

/// Four or three corners about `middle` in the plane of `s` and `t`.
pub(crate) fn corners(random: &mut Random, middle: V3, [s, t]: [V3; 2], [a, b]: [f64; 2]) -> Vec<V3> {
    let turn = random.range(0.0, core::f64::consts::TAU);
    let (n, skew) = (3 + random.word() as usize % 2, random.range(-0.3, 0.3));
    let at = |i: usize| {
        let turn = turn + core::f64::consts::TAU * (i as f64 + if i == 1 { skew } else { 0.0 }) / n as f64;
        along(along(middle, s, a * turn.cos()), t, b * turn.sin())
    };
    (0..n).map(at).collect()
}

pub(super) fn scene(random: &mut Random, kind: Difficulty, round: Round) -> Scene {
    let scene = unplaced(random, kind, round);
    Placement::new(random).scene(scene)
}

/// Any turn, then any place and unit of length.
pub(crate) struct Placement {
    axes: [V3; 3],
    shift: V3,
    unit_length: f64,
}

impl Placement {
    pub(crate) fn new(random: &mut Random) -> Self {
        let n = random.direction();
        let (s, t) = basis(n);
        let (unit_length, offset) = (random.magnitude(1e-3, 1e3), random.range(0.0, 4.0) as i32);
        let shift = random.direction().map(|x| if offset == 0 { 10.0 * x } else { 0.0 });
        Self { axes: [s, t, n], shift, unit_length }
    }
    pub(crate) fn point(&self, v: V3) -> [f32; 3] {
        let v = (0..3).fold(self.shift, |sum, k| along(sum, self.axes[k], v[k]));
        narrow(v.map(|x| x * self.unit_length))
    }
    fn normal(&self, v: [f32; 3]) -> [f32; 3] {
        let v = wide(v);
        narrow(unit((0..3).fold([0.0; 3], |sum, k| along(sum, self.axes[k], v[k]))))
    }
    /// A scene of polygons and spheres.
    pub(crate) fn scene(&self, mut scene: Scene) -> Scene {
        let point = |v: V64| V64::from(wide(self.point(v.into())));
        for shape in core::iter::once(&mut scene.light).chain(&mut scene.occluders) {
            match shape {
                Solid::Polygon { corners, .. } => *corners = corners.map(point),
                Solid::Sphere { center, radius } => {
                    *center = point(*center);
                    *radius = f64::from(*radius as f32 * self.unit_length as f32);
                }
                other => unreachable!("the regimes have polygons and spheres: {other:?}"),
            }
        }
        scene.points = scene.points.map(|p| self.point(wide(p)));
        scene.normals = scene.normals.map(|n| self.normal(n));
        scene
    }
}

/// A scene about the origin, where the points are, and the light at a distance of about 1.
fn unplaced(random: &mut Random, kind: Difficulty, round: Round) -> Scene {
    let toward = random.direction();
    let (s, t) = basis(toward);
    let size = match kind {
        Difficulty::Tiny => random.magnitude(5e-5, 1e-3),
        Difficulty::Small => random.magnitude(1e-3, 3e-2),
        Difficulty::Huge => random.magnitude(2.0, 8.0),
        Difficulty::Far => random.magnitude(0.05, 1.0),
        _ => random.magnitude(0.1, 1.5),
    };
    let size = if round == Round::Light { size.min(0.97) } else { size };
    let radii = match kind {
        Difficulty::SliverLight => [size, size * random.magnitude(1e-5, 1e-2)],
        _ => [size, size * random.magnitude(0.3, 1.0)],
    };
    // the plane of the light: any, or facing, or seen edge-on
    let tilt = match kind {
        Difficulty::EdgeOn => along(s, toward, random.magnitude(1e-4, 3e-2)),
        Difficulty::Huge | Difficulty::Exact => along(toward, random.direction(), 0.2),
        _ => along(toward, random.direction(), 0.9),
    };
    let plane = basis(unit(tilt));
    let flat = corners(random, toward, [plane.0, plane.1], radii);
    let light = if round == Round::Light { sphere(toward, size) } else { polygon(&flat) };
    // a place on or in the light
    let place = |random: &mut Random| {
        if round == Round::Light {
            return along(toward, random.direction(), size * random.range(0.0, 1.0));
        }
        let (x, y) = (random.unit_f64(), random.unit_f64());
        let (x, y) = if x + y > 1.0 { (1.0 - x, 1.0 - y) } else { (x, y) };
        along(along(flat[0], sub(flat[1], flat[0]), x), sub(flat[2], flat[0]), y)
    };
    let way = |random: &mut Random| match kind {
        Difficulty::Near => random.magnitude(1e-3, 1e-1),
        Difficulty::Far => 1.0 - random.magnitude(1e-4, 1e-1),
        _ => random.range(0.1, 0.9),
    };
    let spread = match kind {
        Difficulty::Near => 1e-3 * size,
        Difficulty::Exact => 0.0,
        _ => 0.2 * size.min(1.0),
    };
    let normal = match kind {
        Difficulty::Horizon => {
            let near = random.range(-0.9, 0.9) * size.min(1.0);
            along(along(s.map(|x| x * random.range(-1.0, 1.0)), t, random.range(-1.0, 1.0)), toward, near)
        }
        _ => along(toward, random.direction(), random.range(0.0, 1.5)),
    };
    let normal = unit(normal);
    let mut occluders = Vec::new();
    if round == Round::Occluders {
        let count = 1 + random.word() as usize % 3;
        for i in 0..count {
            let (at, f) = (place(random), way(random));
            // spheres beside each other, and a polygon after them now and then
            let radius = f * (size * random.magnitude(0.05, 0.8)).min(0.8 * (1.0 - f) / f).min(0.9);
            if i > 0 && random.unit() < 0.5 {
                let plane = basis(random.direction());
                occluders.push(polygon(&corners(random, at.map(|x| x * f), [plane.0, plane.1], [radius; 2])));
            } else {
                let center = match kind {
                    Difficulty::Axis => toward,
                    _ => at,
                };
                occluders.push(sphere(center.map(|x| x * f), radius));
            }
        }
    } else {
        let count = match kind {
            Difficulty::Sixteen => 16,
            Difficulty::Any => 1 + random.word() % 6,
            _ => 1 + random.word() % 4,
        };
        for i in 0..count {
            let (at, f) = (place(random), way(random));
            let middle = at.map(|x| x * f);
            let own = f * size * if kind == Difficulty::Sixteen { 0.2 } else { random.magnitude(0.1, 2.0) };
            let facing = basis(unit(along(toward, random.direction(), 0.7)));
            let mut plane = [facing.0, facing.1];
            let mut radii = [own, own * random.magnitude(0.3, 1.0)];
            match kind {
                Difficulty::SliverBlockers => radii[1] = own * random.magnitude(1e-6, 1e-2),
                Difficulty::InPlane => {
                    // the plane passes the points at a small distance
                    let along_it = unit(cross(middle, random.direction()));
                    let other = unit(along(middle, random.direction(), random.magnitude(1e-7, 1e-2)));
                    plane = [along_it, other];
                }
                _ => {}
            }
            let mut own_corners = corners(random, middle, plane, radii);
            if matches!(
                kind,
                Difficulty::TouchLight
                    | Difficulty::LightPlane
                    | Difficulty::CrossHorizon
                    | Difficulty::Axis
                    | Difficulty::Exact
            ) {
                // one of their corners moves out of the plane
                own_corners.truncate(3);
            }
            match kind {
                Difficulty::TouchLight => {
                    // a corner or an edge on a place of the light, on its edge or at its corner
                    let on = |random: &mut Random| match random.word() % 3 {
                        0 => flat[random.word() as usize % flat.len()],
                        1 => along(flat[0], sub(flat[1], flat[0]), random.unit_f64()),
                        _ => place(random),
                    };
                    if random.unit() < 0.5 {
                        own_corners[0] = on(random);
                    } else {
                        let (a, b) = (flat[0], flat[1]);
                        let out = along(a.map(|x| x * f), random.direction(), 0.3 * size);
                        own_corners = vec![a, b, along(out, sub(b, a), 1.0), out];
                    }
                }
                Difficulty::TouchSurface => {
                    // a wall that stands on the surface
                    let height = dot(middle, normal);
                    let foot = along(middle, normal, -height);
                    let aside = unit(cross(normal, random.direction()));
                    let wide = own + 0.3;
                    let (a, b) = (along(foot, aside, -wide), along(foot, aside, wide));
                    own_corners = vec![a, b, along(b, normal, height), along(a, normal, height)];
                }
                Difficulty::Quads if own_corners.len() == 4 => {
                    let half = [own_corners[0], own_corners[1], own_corners[2]];
                    occluders.push(polygon(&half));
                    own_corners.remove(1);
                }
                Difficulty::Fan if i == 0 => {
                    let n = 3 + random.word() as usize % 5;
                    for k in 0..n {
                        let rim = |k: usize| {
                            let turn = core::f64::consts::TAU * (k % n) as f64 / n as f64;
                            along(along(middle, plane[0], own * turn.cos()), plane[1], own * turn.sin())
                        };
                        occluders.push(polygon(&[middle, rim(k), rim(k + 1)]));
                    }
                    continue;
                }
                Difficulty::Fan => continue,
                Difficulty::Box if i == 0 => {
                    let axes = [plane[0], plane[1], cross(plane[0], plane[1])];
                    let half = [own, own * random.range(0.2, 1.0), own * random.range(0.2, 1.0)];
                    for quad in placed(&cube(), half, &axes, middle) {
                        if random.unit() < 0.3 {
                            occluders.push(polygon(&quad[..3]));
                            occluders.push(polygon(&[quad[2], quad[3], quad[0]]));
                        } else {
                            occluders.push(polygon(&quad));
                        }
                    }
                    continue;
                }
                Difficulty::Box => continue,
                Difficulty::Twice => {
                    let mut again = own_corners.clone();
                    match random.word() % 3 {
                        0 => again.reverse(),
                        1 => again.rotate_left(1),
                        _ => {}
                    }
                    // the same cone, from the origin at least
                    let nearer = if random.unit() < 0.5 { 1.0 } else { random.range(0.3, 0.9) };
                    occluders.push(polygon(&again.iter().map(|c| c.map(|x| x * nearer)).collect::<Vec<_>>()));
                }
                Difficulty::LightPlane => {
                    let far = random.range(0.5, 1.5);
                    own_corners[0] = place(random).map(|x| x * (1.0 + far));
                }
                Difficulty::CrossHorizon => {
                    let below = random.range(0.1, 1.0);
                    let height = dot(own_corners[0], normal);
                    own_corners[0] = along(own_corners[0], normal, -height - below);
                }
                Difficulty::Axis => {
                    // an edge or a corner on the axis of the light
                    if random.unit() < 0.5 {
                        own_corners[0] = toward.map(|x| x * f);
                    } else {
                        let across = random.direction();
                        own_corners[0] = along(toward.map(|x| x * f), across, own);
                        own_corners[1] = along(toward.map(|x| x * f), across, -own);
                    }
                }
                Difficulty::Exact => {
                    own_corners = flat.iter().map(|c| c.map(|x| x * f)).collect();
                    if flat.len() == 3 && random.unit() < 0.3 {
                        // and once a little off
                        own_corners[0] = along(own_corners[0], random.direction(), random.magnitude(1e-8, 1e-2));
                    }
                }
                _ => {}
            }
            occluders.push(polygon(&own_corners));
        }
    }
    occluders.truncate(16);
    let (points, normals) = surface(random, normal, spread, kind == Difficulty::TouchSurface);
    Scene { light, occluders, points, normals }
}

/// Points about the origin on a surface, and the normals there, which are nearly the same unless all are.
pub(crate) fn surface(random: &mut Random, normal: V3, spread: f64, is_flat: bool) -> ([[f32; 3]; 8], [[f32; 3]; 8]) {
    let points = core::array::from_fn(|i| {
        let off = random.direction();
        // on the surface, so that what stands on it touches the horizon
        let off = along(off, normal, -dot(off, normal));
        narrow(off.map(|x| if i == 0 { 0.0 } else { spread * x }))
    });
    let normals = core::array::from_fn(|i| {
        let off = if is_flat || i < 2 { 0.0 } else { 0.1 };
        narrow(unit(along(normal, random.direction(), off)))
    });
    (points, normals)
}
