//! The visible part of lights past convex blockers, against an oracle that subtracts the blockers one after another.

use etendue::occlusion::Convex;
use etendue::{Real, Vec3, f32x8};
use etendue_oracle::visible::{Shape, Visible, visible};
use etendue_oracle::{Greatest, V3, along, basis, cross, dot, length, narrow, sub, unit, wide};
use etendue_properties::generators::{NASTY, Random};
use etendue_properties::occlusion::Scene;

/// The fraction of the way to a flat light within which blockers do not occlude, as documented.
const SPARED: f64 = 1.0 / 131_072.0;

fn polygon(corners: &[V3]) -> Convex<f32> {
    let corner = |i: usize| Vec3::from(narrow(corners[i.min(corners.len() - 1)]));
    Convex::Polygon { corners: core::array::from_fn(corner), count: corners.len() }
}
fn sphere(center: V3, radius: f64) -> Convex<f32> {
    Convex::Sphere { center: narrow(center).into(), radius: radius as f32 }
}
/// The shape relative to a point.
fn from_point(shape: &Convex<f32>, point: [f32; 3]) -> Shape {
    match *shape {
        Convex::Polygon { corners, count } => {
            Shape::Polygon(corners[..count].iter().map(|&c| sub(wide(c.into()), wide(point))).collect())
        }
        Convex::Sphere { center, radius } => Shape::Sphere(sub(wide(center.into()), wide(point)), f64::from(radius)),
    }
}

/// The truth about a scene.
trait Truth {
    /// What the least sine of an edge seen under more than a right angle divides, and the least cosine of a sphere's half-angle.
    fn condition(&self, lane: usize) -> f64;
    /// Whether the point lies within a flat blocker, nearer to its plane than single precision tells, which then hides one half of the
    /// directions or the other.
    fn surrounded(&self, lane: usize) -> bool;
    /// The truth for a lane, with a limit in front of the light that is a fifth nearer and farther.
    fn truth(&self, lane: usize) -> Option<[Visible; 2]>;
}
impl Truth for Scene {
    fn condition(&self, lane: usize) -> f64 {
        let sine = |shape: &Convex<f32>| match from_point(shape, self.points[lane]) {
            Shape::Polygon(corners) => (0..corners.len())
                .map(|i| (corners[i], corners[(i + 1) % corners.len()]))
                .filter(|(a, b)| dot(*a, *b) < 0.0)
                .map(|(a, b)| length(cross(unit(a), unit(b))))
                .fold(1.0, f64::min),
            Shape::Sphere(center, radius) => (1.0 - (radius / length(center)).powi(2)).max(0.0).sqrt(),
        };
        self.blockers.iter().map(sine).fold(sine(&self.light), f64::min)
    }
    fn surrounded(&self, lane: usize) -> bool {
        self.blockers.iter().any(|blocker| {
            let Shape::Polygon(c) = from_point(blocker, self.points[lane]) else { return false };
            let last = c[c.len() - 1];
            let across = unit(cross(sub(c[1], c[0]), sub(last, c[0])));
            let size = c.iter().map(|c| length(*c)).fold(0.0, f64::max);
            let angle = |i: usize| dot(unit(c[i]), unit(c[(i + 1) % c.len()])).clamp(-1.0, 1.0).acos();
            dot(across, c[0]).abs() < 1e-6 * size && (0..c.len()).map(angle).sum::<f64>() > 5.0
        })
    }
    fn truth(&self, lane: usize) -> Option<[Visible; 2]> {
        let light = from_point(&self.light, self.points[lane]);
        let blockers: Vec<_> = self.blockers.iter().map(|b| from_point(b, self.points[lane])).collect();
        let at = |share: f64| visible(&light, &blockers, wide(self.normals[lane]), share * SPARED);
        Some([at(0.8)?, at(1.2)?])
    }
}

/// How shapes are placed.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Kind {
    Any,
    Tiny,
    Small,
    Huge,
    Far,
    Near,
    EdgeOn,
    Horizon,
    SliverLight,
    SliverBlockers,
    TouchLight,
    TouchSurface,
    Quads,
    Fan,
    Box,
    Twice,
    LightPlane,
    CrossHorizon,
    Axis,
    Exact,
    InPlane,
    Sixteen,
}
const KINDS: [Kind; 22] = [
    Kind::Any,
    Kind::Tiny,
    Kind::Small,
    Kind::Huge,
    Kind::Far,
    Kind::Near,
    Kind::EdgeOn,
    Kind::Horizon,
    Kind::SliverLight,
    Kind::SliverBlockers,
    Kind::TouchLight,
    Kind::TouchSurface,
    Kind::Quads,
    Kind::Fan,
    Kind::Box,
    Kind::Twice,
    Kind::LightPlane,
    Kind::CrossHorizon,
    Kind::Axis,
    Kind::Exact,
    Kind::InPlane,
    Kind::Sixteen,
];

/// Which shapes are spheres.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Round {
    None,
    Light,
    Blockers,
}

/// Four or three corners about `middle` in the plane of `s` and `t`.
fn corners(random: &mut Random, middle: V3, [s, t]: [V3; 2], [a, b]: [f64; 2]) -> Vec<V3> {
    let turn = random.range(0.0, core::f64::consts::TAU);
    let (n, skew) = (3 + random.word() as usize % 2, random.range(-0.3, 0.3));
    let at = |i: usize| {
        let turn = turn + core::f64::consts::TAU * (i as f64 + if i == 1 { skew } else { 0.0 }) / n as f64;
        along(along(middle, s, a * turn.cos()), t, b * turn.sin())
    };
    (0..n).map(at).collect()
}

fn scene(random: &mut Random, kind: Kind, round: Round) -> Scene {
    let mut scene = unplaced(random, kind, round);
    // any turn, then any place
    let n = random.direction();
    let (s, t) = basis(n);
    let (unit_length, offset) = (random.magnitude(1e-3, 1e3), random.range(0.0, 4.0) as i32);
    let shift = random.direction().map(|x| if offset == 0 { 10.0 * x } else { 0.0 });
    let turned = |v: Vec3<f32>| {
        let v = wide(v.into());
        let v = along(along(along(shift, s, v[0]), t, v[1]), n, v[2]);
        Vec3::from(narrow(v.map(|x| x * unit_length)))
    };
    for shape in core::iter::once(&mut scene.light).chain(&mut scene.blockers) {
        match shape {
            Convex::Polygon { corners, .. } => *corners = corners.map(turned),
            Convex::Sphere { center, radius } => {
                *center = turned(*center);
                *radius *= unit_length as f32;
            }
        }
    }
    scene.points = scene.points.map(|p| turned(p.into()).into());
    scene.normals = scene.normals.map(|v| {
        let v = wide(v);
        narrow(unit(along(along(s.map(|x| x * v[0]), t, v[1]), n, v[2])))
    });
    scene
}

/// A scene about the origin, where the points are, and the light at a distance of about 1.
fn unplaced(random: &mut Random, kind: Kind, round: Round) -> Scene {
    let toward = random.direction();
    let (s, t) = basis(toward);
    let size = match kind {
        Kind::Tiny => random.magnitude(5e-5, 1e-3),
        Kind::Small => random.magnitude(1e-3, 3e-2),
        Kind::Huge => random.magnitude(2.0, 8.0),
        Kind::Far => random.magnitude(0.05, 1.0),
        _ => random.magnitude(0.1, 1.5),
    };
    let size = if round == Round::Light { size.min(0.97) } else { size };
    let radii = match kind {
        Kind::SliverLight => [size, size * random.magnitude(1e-5, 1e-2)],
        _ => [size, size * random.magnitude(0.3, 1.0)],
    };
    // the plane of the light: any, or facing, or seen edge-on
    let tilt = match kind {
        Kind::EdgeOn => along(s, toward, random.magnitude(1e-4, 3e-2)),
        Kind::Huge | Kind::Exact => along(toward, random.direction(), 0.2),
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
        Kind::Near => random.magnitude(1e-3, 1e-1),
        Kind::Far => 1.0 - random.magnitude(1e-4, 1e-1),
        _ => random.range(0.1, 0.9),
    };
    let spread = match kind {
        Kind::Near => 1e-3 * size,
        Kind::Exact => 0.0,
        _ => 0.2 * size.min(1.0),
    };
    let normal = match kind {
        Kind::Horizon => {
            let near = random.range(-0.9, 0.9) * size.min(1.0);
            along(along(s.map(|x| x * random.range(-1.0, 1.0)), t, random.range(-1.0, 1.0)), toward, near)
        }
        _ => along(toward, random.direction(), random.range(0.0, 1.5)),
    };
    let normal = unit(normal);
    let mut blockers = Vec::new();
    if round == Round::Blockers {
        let count = 1 + random.word() as usize % 3;
        for i in 0..count {
            let (at, f) = (place(random), way(random));
            // spheres beside each other, and a polygon after them now and then
            let radius = f * (size * random.magnitude(0.05, 0.8)).min(0.8 * (1.0 - f) / f).min(0.9);
            if i > 0 && random.unit() < 0.5 {
                let plane = basis(random.direction());
                blockers.push(polygon(&corners(random, at.map(|x| x * f), [plane.0, plane.1], [radius; 2])));
            } else {
                let center = match kind {
                    Kind::Axis => toward,
                    _ => at,
                };
                blockers.push(sphere(center.map(|x| x * f), radius));
            }
        }
    } else {
        let count = match kind {
            Kind::Sixteen => 16,
            Kind::Any => 1 + random.word() % 6,
            _ => 1 + random.word() % 4,
        };
        for i in 0..count {
            let (at, f) = (place(random), way(random));
            let middle = at.map(|x| x * f);
            let own = f * size * if kind == Kind::Sixteen { 0.2 } else { random.magnitude(0.1, 2.0) };
            let facing = basis(unit(along(toward, random.direction(), 0.7)));
            let mut plane = [facing.0, facing.1];
            let mut radii = [own, own * random.magnitude(0.3, 1.0)];
            match kind {
                Kind::SliverBlockers => radii[1] = own * random.magnitude(1e-6, 1e-2),
                Kind::InPlane => {
                    // the plane passes the points at a small distance
                    let along_it = unit(cross(middle, random.direction()));
                    let other = unit(along(middle, random.direction(), random.magnitude(1e-7, 1e-2)));
                    plane = [along_it, other];
                }
                _ => {}
            }
            let mut own_corners = corners(random, middle, plane, radii);
            if matches!(kind, Kind::TouchLight | Kind::LightPlane | Kind::CrossHorizon | Kind::Axis | Kind::Exact) {
                // one of their corners moves out of the plane
                own_corners.truncate(3);
            }
            match kind {
                Kind::TouchLight => {
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
                Kind::TouchSurface => {
                    // a wall that stands on the surface
                    let height = dot(middle, normal);
                    let foot = along(middle, normal, -height);
                    let aside = unit(cross(normal, random.direction()));
                    let wide = own + 0.3;
                    let (a, b) = (along(foot, aside, -wide), along(foot, aside, wide));
                    own_corners = vec![a, b, along(b, normal, height), along(a, normal, height)];
                }
                Kind::Quads if own_corners.len() == 4 => {
                    let half = [own_corners[0], own_corners[1], own_corners[2]];
                    blockers.push(polygon(&half));
                    own_corners.remove(1);
                }
                Kind::Fan if i == 0 => {
                    let n = 3 + random.word() as usize % 5;
                    for k in 0..n {
                        let rim = |k: usize| {
                            let turn = core::f64::consts::TAU * (k % n) as f64 / n as f64;
                            along(along(middle, plane[0], own * turn.cos()), plane[1], own * turn.sin())
                        };
                        blockers.push(polygon(&[middle, rim(k), rim(k + 1)]));
                    }
                    continue;
                }
                Kind::Fan => continue,
                Kind::Box if i == 0 => {
                    let (x, y) = (plane[0], plane[1]);
                    let z = cross(x, y);
                    let extent = [own, own * random.range(0.2, 1.0), own * random.range(0.2, 1.0)];
                    for axis in 0..3 {
                        for side in [-1.0, 1.0] {
                            let axes = [x, y, z];
                            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                            let face = along(middle, axes[axis], side * extent[axis]);
                            let corner =
                                |p: f64, q: f64| along(along(face, axes[u], p * extent[u]), axes[v], q * extent[v]);
                            let quad = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
                            if random.unit() < 0.3 {
                                blockers.push(polygon(&quad[..3]));
                                blockers.push(polygon(&[quad[2], quad[3], quad[0]]));
                            } else {
                                blockers.push(polygon(&quad));
                            }
                        }
                    }
                    continue;
                }
                Kind::Box => continue,
                Kind::Twice => {
                    let mut again = own_corners.clone();
                    match random.word() % 3 {
                        0 => again.reverse(),
                        1 => again.rotate_left(1),
                        _ => {}
                    }
                    // the same cone, from the origin at least
                    let nearer = if random.unit() < 0.5 { 1.0 } else { random.range(0.3, 0.9) };
                    blockers.push(polygon(&again.iter().map(|c| c.map(|x| x * nearer)).collect::<Vec<_>>()));
                }
                Kind::LightPlane => {
                    let far = random.range(0.5, 1.5);
                    own_corners[0] = place(random).map(|x| x * (1.0 + far));
                }
                Kind::CrossHorizon => {
                    let below = random.range(0.1, 1.0);
                    let height = dot(own_corners[0], normal);
                    own_corners[0] = along(own_corners[0], normal, -height - below);
                }
                Kind::Axis => {
                    // an edge or a corner on the axis of the light
                    if random.unit() < 0.5 {
                        own_corners[0] = toward.map(|x| x * f);
                    } else {
                        let across = random.direction();
                        own_corners[0] = along(toward.map(|x| x * f), across, own);
                        own_corners[1] = along(toward.map(|x| x * f), across, -own);
                    }
                }
                Kind::Exact => {
                    own_corners = flat.iter().map(|c| c.map(|x| x * f)).collect();
                    if flat.len() == 3 && random.unit() < 0.3 {
                        // and once a little off
                        own_corners[0] = along(own_corners[0], random.direction(), random.magnitude(1e-8, 1e-2));
                    }
                }
                _ => {}
            }
            blockers.push(polygon(&own_corners));
        }
    }
    blockers.truncate(16);
    let points = core::array::from_fn(|i| {
        let off = random.direction();
        // on the surface, so that what stands on it touches the horizon
        let off = along(off, normal, -dot(off, normal));
        narrow(off.map(|x| if i == 0 { 0.0 } else { spread * x }))
    });
    let normals = core::array::from_fn(|i| {
        let off = if kind == Kind::TouchSurface || i < 2 { 0.0 } else { 0.1 };
        narrow(unit(along(normal, random.direction(), off)))
    });
    Scene { light, blockers, points, normals }
}

/// Greatest errors of a regime.
#[derive(Clone, Copy, Default)]
struct Errors {
    points: u32,
    occluded: u32,
    none: u32,
    unknown: u32,
    single: Greatest<u32>,
    relative: Greatest<u32>,
    double: Greatest<u32>,
}

fn measure(kind: Kind, round: Round, packets: u32, seed: u64) -> Errors {
    let mut random = Random::new(seed);
    let mut errors = Errors::default();
    for i in 0..packets {
        let scene = scene(&mut random, kind, round);
        let found = scene.found::<f32x8>(0);
        for lane in 0..8 {
            errors.points += 1;
            let truth = if scene.surrounded(lane) { None } else { scene.truth(lane) };
            let Some([near, far]) = truth else {
                errors.unknown += 1;
                continue;
            };
            let Some(found) = found else {
                errors.none += 1;
                continue;
            };
            let (least, most) = (near.left.min(far.left), near.left.max(far.left));
            let off = |found: f64| (least - found).max(found - most).max(0.0);
            let unit = near.around * near.occluders.max(1) as f64 / scene.condition(lane);
            errors.occluded += u32::from(near.occluders > 0);
            let error = off(found.lane_f64(lane));
            if unit > 0.0 {
                errors.single.take(error / unit, i);
                if let Some(double) = scene.found::<f64>(lane) {
                    errors.double.take(off(double) / unit, i);
                }
            } else {
                assert!(error < 1e-30, "{scene:?}");
            }
            if near.all > 0.0 {
                errors.relative.take(error / near.all, i);
            }
        }
    }
    errors
}
/// Greatest error allowed, relative to the angle around the light times the number of occluders, over the condition.
const BOUND: f64 = 1e-6;

fn accuracy(packets: u32) {
    println!("regime, spheres             points  occluded   none  unknown  f32, per angle  of Ω⊥     f64");
    let (mut all, mut double) = (Greatest::NONE, Greatest::NONE);
    let mut points = 0;
    for round in [Round::None, Round::Light, Round::Blockers] {
        for (k, &kind) in KINDS.iter().enumerate() {
            let e = measure(kind, round, packets, 1000 * round as u64 + k as u64);
            let name = format!("{kind:?}, {round:?}");
            println!(
                "{name:26} {:7} {:9} {:6} {:8}  {:14.1e}  {:8.1e}  {:8.1e}",
                e.points,
                e.occluded,
                e.none,
                e.unknown,
                e.single.error(),
                e.relative.error(),
                e.double.error(),
            );
            assert!(e.occluded > 0 && 4 * e.none <= 4 * e.points, "{name}: nothing is tested");
            assert!(e.single.error() < BOUND, "{name}: {:?}", e.single);
            // spheres in double precision have the accuracy of `ProjectedCap`, and corners in single precision do not lie in planes
            assert!(e.double.error() < 1e-7, "{name}: {:?}", e.double);
            all.take(e.single.error(), (kind, round));
            double.take(e.double.error(), (kind, round));
            points += e.points;
        }
    }
    println!("{points} points: greatest error {:.1e} of the angle times the occluders, {:?}", all.error(), all.at());
}

#[test]
fn visible_parts() {
    accuracy(150);
}
#[test]
#[ignore = "a million points: a minute"]
fn visible_parts_of_a_million_points() {
    accuracy(1900);
}

/// Scenes of all regimes, with their greatest rounding error in a lane.
fn scenes(count: u32, seed: u64, mut f: impl FnMut(Scene, &mut Random)) {
    let mut random = Random::new(seed);
    for _ in 0..count {
        for round in [Round::None, Round::Light, Round::Blockers] {
            for kind in KINDS {
                let scene = scene(&mut random, kind, round);
                f(scene, &mut random);
            }
        }
    }
}

/// Total, within [0, Ω⊥], lane-identical and independent of the unit of length, in all regimes.
#[test]
fn properties_in_all_regimes() {
    scenes(30, 71, |scene, _| {
        scene.total();
        scene.lanes();
        scene.scale(20);
        scene.scale(-20);
    });
}

/// Total and lane-identical for any numbers.
#[test]
fn any_numbers() {
    let mut random = Random::new(72);
    for round in 0..20_000 {
        let mut seen: Vec<[f32; 3]> = Vec::new();
        let mut vector = |random: &mut Random| {
            let word = random.word();
            let v: [f32; 3] = match word % 5 {
                0 if !seen.is_empty() => seen[(word >> 8) as usize % seen.len()],
                1 => core::array::from_fn(|_| NASTY[random.word() as usize % NASTY.len()]),
                2 => [(); 3].map(|()| random.any_f32()),
                _ => narrow(random.direction()),
            };
            seen.push(v);
            v
        };
        let mut shape = |random: &mut Random| {
            let word = random.word();
            if word.is_multiple_of(3) {
                let radius = if word & 8 == 0 { random.unit() } else { random.any_f32() };
                return Convex::Sphere { center: vector(random).into(), radius };
            }
            Convex::Polygon { corners: [(); 4].map(|()| vector(random).into()), count: 3 + (word >> 10) as usize % 2 }
        };
        let light = shape(&mut random);
        let blockers = (0..round % 6).map(|_| shape(&mut random)).collect();
        let points = [(); 8].map(|()| vector(&mut random));
        let normals = [(); 8].map(|()| narrow(random.direction()));
        let scene = Scene { light, blockers, points, normals };
        scene.total();
        scene.lanes();
    }
}

/// The order of corners and of blockers, and the direction around, only change the rounding; a further blocker never adds light.
#[test]
fn orders() {
    let (mut order, mut more) = (Greatest::NONE, Greatest::NONE);
    scenes(30, 73, |scene, random| {
        let mut other = scene.clone();
        for shape in core::iter::once(&mut other.light).chain(&mut other.blockers) {
            if let Convex::Polygon { corners, count } = shape {
                corners[..*count].rotate_left(random.word() as usize % *count);
                if random.word() & 1 == 0 {
                    corners[..*count].reverse();
                }
            }
        }
        for i in (1..other.blockers.len()).rev() {
            other.blockers.swap(i, random.word() as usize % (i + 1));
        }
        let mut fewer = scene.clone();
        fewer.blockers.pop();
        let (Some(found), others, fewer) = (scene.found::<f32x8>(0), other.found::<f32x8>(0), fewer.found::<f32x8>(0))
        else {
            return;
        };
        for lane in 0..8 {
            let Some([truth, far]) = scene.truth(lane) else { continue };
            let unit = truth.around * truth.occluders.max(1) as f64 / scene.condition(lane);
            // where the limit in front of the light decides, rounding may too
            if unit <= 0.0 || (truth.left - far.left).abs() > 1e-9 * unit {
                continue;
            }
            let found = found.lane_f64(lane);
            if let Some(others) = others {
                order.take((others.lane_f64(lane) - found).abs() / unit, ());
                if (others.lane_f64(lane) - found).abs() / unit > 2e-6 {
                    println!(
                        "ORDER {lane} {found} {:?} {:?} {truth:?} {scene:?}",
                        other.found::<f32>(lane),
                        other.truth(lane)
                    );
                }
            }
            if let Some(fewer) = fewer {
                more.take((found - fewer.lane_f64(lane)) / unit, ());
            }
        }
    });
    println!("another order: {:.1e} of the angle; light added by a blocker: {:.1e}", order.error(), more.error());
    assert!(order.error() < 2.0 * BOUND && more.error() < 2.0 * BOUND, "{order:?} {more:?}");
}

/// What has no area hides nothing, covered lights have 0, and what cannot be computed is `None`.
#[test]
fn special_cases() {
    let square = |y: f64, half: f64| polygon(&[[-half, y, -half], [half, y, -half], [half, y, half], [-half, y, half]]);
    let scene = |light, blockers| Scene { light, blockers, points: [[0.0; 3]; 8], normals: [[0.0, 1.0, 0.0]; 8] };
    let value = |light, blockers: Vec<_>| scene(light, blockers).found::<f32>(0);
    let light = square(2.0, 1.0);
    let all = value(light, vec![]).unwrap();
    // a plane, a point, an edge, a blocker seen edge-on, and those behind the light and below the horizon
    let edge = polygon(&[[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    let edge_on = polygon(&[[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.5, 0.0]]);
    for hidden in [square(1.0, 0.0), edge, edge_on, square(2.0, 1.0), square(3.0, 1.0), square(-1.0, 1.0)] {
        assert_eq!(value(light, vec![hidden]), Some(all), "{hidden:?}");
    }
    // a quadrilateral whose corners coincide is a triangle, in any order
    let triangle = [[-0.4, 1.0, -0.3], [0.5, 1.0, -0.2], [0.1, 1.0, 0.6]];
    let part = value(light, vec![polygon(&triangle)]).unwrap();
    for k in 0..3 {
        let mut twice = triangle.to_vec();
        twice.insert(k, triangle[k]);
        let found = value(light, vec![polygon(&twice)]).unwrap();
        assert!((found - part).abs() < 1e-6 && part < 0.99 * all, "{found} {part} {all}");
        let found = value(polygon(&twice), vec![]).unwrap();
        assert!((found - value(polygon(&triangle), vec![]).unwrap()).abs() < 1e-6);
    }
    assert_eq!(value(light, vec![square(1.0, 0.6)]), Some(0.0));
    assert_eq!(value(light, vec![square(1.0, 0.5)]), Some(0.0));
    assert_eq!(value(light, vec![square(1.0, 0.5); 16]), Some(0.0));
    assert_eq!(value(light, vec![square(1.0, 0.1); 17]), None);
    // spheres beside each other, and spheres that overlap
    let ball = |x: f64| sphere([x, 1.0, 0.0], 0.1);
    assert!(value(light, vec![ball(-0.2), ball(0.2)]).is_some());
    assert_eq!(value(light, vec![ball(-0.05), ball(0.05)]), None);
    assert_eq!(value(sphere([0.0, 2.0, 0.0], 0.5), vec![ball(0.0)]), None);
    // a sphere cut by the plane of the light
    assert_eq!(value(light, vec![sphere([0.0, 2.0, 0.0], 0.1)]), None);
    assert_eq!(value(light, vec![sphere([0.0, 3.0, 0.0], 0.1)]), Some(all));
}
