//! Scenes as people make them: under a sky, by the watt, turned over, smooth anyhow, with many lights, and on any film.

use super::others::factors;
use super::places::furnish;
use crate::attack::build::{
    albedo, any_solid, axes, cube, facing, floor, lamp, level, look, map, overhead, placed, quad, radiance, stage,
    triangles,
};
use crate::attack::draft::{Draft, Finish, Form, Frame, Kind, Map, Measure, Part, Place, Source, Swept, V3};
use crate::attack::skin::{Bend, Picture, Uv, Wild};
use crate::random::Random;
use etendue_oracle::along;
use std::f64::consts::PI;

fn source(kind: Kind, strength: f64) -> Source {
    Source { kind, strength: strength as f32, measure: Measure::default(), map: None, picture: None }
}

/// A picture with texels of about 1, and often one that is much brighter.
fn picture([width, height]: [usize; 2], random: &mut Random) -> Picture {
    let mut texels: Vec<f32> = (0..width * height).map(|_| random.between(0.0, 2.0) as f32).collect();
    if random.one_in(2) {
        let spot = random.below(texels.len());
        texels[spot] = random.power(0.0, 3.0) as f32;
    }
    Picture { width, texels }
}

/// A sky whose +z is upwards, often with a picture.
fn sky(random: &mut Random) -> Source {
    let mut sky = source(Kind::Sky, random.power(-1.5, 1.0));
    let axes = axes(random.below(2), random);
    // the pole of axes without a turn is +y
    sky.map = Some(map(&[axes[2], axes[0], axes[1]], [1.0; 3], [0.0; 3]));
    if random.one_in(2) {
        let size = random.of(&[[1, 1], [2, 2], [4, 4], [8, 8], [2, 1], [6, 3], [16, 8], [3, 5]]);
        sky.picture = Some(picture(size, random));
        sky.measure.scale = Some(sky.strength);
    }
    sky
}

fn sun(strength: f64, random: &mut Random) -> Source {
    let from = overhead(random.power(-1.0, 3.0), random);
    source(Kind::Distant([from, [0.0; 3]]), strength)
}

/// A point or a spot light with about this irradiance at the origin.
fn bulb(irradiance: f64, from: V3, random: &mut Random) -> Source {
    let kind = if random.one_in(2) {
        Kind::Point(from)
    } else {
        let angle = if random.one_in(3) { random.power(-2.0, 1.0) } else { random.between(10.0, 80.0) };
        let to = if angle < 10.0 { [0.0; 3] } else { random.point().map(|x| 0.3 * x) };
        Kind::Spot([from, to], [angle, angle * random.of(&[0.0, 0.2, 1.0])])
    };
    source(kind, irradiance * etendue_oracle::dot(from, from))
}

pub(super) fn skies(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let half = random.power(0.0, 5.0);
    draft.parts[0] = floor(half, random);
    let has_roof = random.one_in(4);
    let (height, irradiance) =
        (if has_roof { random.between(0.5, 1.7) } else { random.power(-0.5, 0.7) }, random.power(-1.5, 1.0));
    let size = height * random.power(-2.0, 0.0);
    draft.parts[1] = lamp(overhead(height, random), [0.0; 3], size, random);
    if let Some(glow) = &mut draft.parts[1].glow {
        glow.radiance *= irradiance as f32;
    }
    match random.below(4) {
        0 => drop(draft.parts.remove(1)),
        1 => {
            draft.parts.remove(1);
            draft.sources.push(bulb(irradiance, overhead(height, random), random));
        }
        _ => {}
    }
    if has_roof {
        draft.parts.push(Part::mesh(level(2.0, random.of(&[1.0, 4.0, 100.0])), albedo(random)));
    }
    for _ in 0..random.of(&[0, 0, 1, 1, 2, 3, 20]) {
        let strength = random.power(-1.5, 1.0);
        draft.sources.push(sun(strength, random));
    }
    if draft.sources.is_empty() || random.one_in(2) {
        draft.sources.push(sky(random));
        if random.one_in(4) {
            draft.sources.push(source(Kind::Sky, random.power(-1.5, 1.0)));
        }
    }
    if random.one_in(2) {
        furnish(&mut draft, random);
    }
    draft
}

/// The form of a light, of size 1 about the origin.
fn form(random: &mut Random) -> Form {
    let sweep = |random: &mut Random| if random.one_in(2) { 360.0 } else { random.between(40.0, 350.0).round() };
    let ends = |random: &mut Random| [random.between(-1.0, -0.1), random.between(0.1, 1.2)];
    match random.below(8) {
        0 => {
            let radii = [0.5, random.of(&[0.0, 0.2])];
            Form::Swept(Swept::Disk { radii, height: random.of(&[0.0, 0.1]), sweep: sweep(random) })
        }
        1 => Form::Swept(Swept::Cylinder { radius: 0.4, z: ends(random).map(|z| 0.5 * z), sweep: sweep(random) }),
        2 => Form::Swept(Swept::Sphere { radius: 0.5, z: ends(random).map(|z| 0.5 * z), sweep: sweep(random) }),
        3 => {
            let corner = |x: f64, y: f64, random: &mut Random| along([x, y, 0.0], random.point(), 0.15);
            let corners = [[-0.5, -0.5], [0.5, -0.5], [-0.5, 0.5], [0.5, 0.5]];
            let mut corners = corners.map(|[x, y]| corner(x, y, random));
            if random.one_in(2) {
                corners.iter_mut().for_each(|p| p[2] = 0.0);
            }
            Form::Swept(Swept::Patch(corners))
        }
        4 => Form::Sphere([0.0; 3], 0.5),
        5 => Form::Mesh(triangles(&placed(&any_solid(random), [0.3; 3], &axes(2, random), [0.0; 3]))),
        6 => Form::Mesh(quad([-0.5, -0.5, 0.0], [1.0, 0.0, 0.0], [random.between(-0.5, 0.5), 1.0, 0.0])),
        _ => Form::Parallelogram([-0.5, -0.5, 0.0], [1.0, 0.0, 0.0], [random.between(-0.5, 0.5), 1.0, 0.0]),
    }
}

/// A light at a distance above the origin, towards which its +z is, with about 1 of irradiance there.
fn shape(factors: V3, random: &mut Random) -> Part {
    let center = overhead(random.between(1.5, 3.0), random);
    let Form::Parallelogram(_, u, v) = facing(center, [0.0; 3], [1.0; 2], random) else { unreachable!() };
    let axes = if random.one_in(4) { axes(2, random) } else { [u, v, etendue_oracle::cross(u, v)] };
    let mut part = Part::light(form(random), 0.0, random.one_in(4));
    part.place = Some(Place { map: map(&axes, factors, center), is_reversed: false });
    let size = factors.iter().map(|x| x.abs()).product::<f64>().powf(2.0 / 3.0);
    if let Some(glow) = &mut part.glow {
        glow.radiance = (etendue_oracle::dot(center, center) / size) as f32;
    }
    // all of them reflect, on both sides
    part.finish = Finish::Diffuse(random.of(&[0.0, 0.0, 0.7]));
    part
}

/// Turns the camera to a light.
fn look_at(draft: &mut Draft, part: usize, random: &mut Random) {
    if let Some(Place { map, .. }) = &draft.parts[part].place {
        let center = map.map(|row| f64::from(row[3] as f32));
        draft.look = look(center, random.between(4.0, 6.0), random);
        draft.look.fov = random.between(15.0, 30.0);
        if random.one_in(2) {
            // from below
            draft.look.eye[1] = center[1].mul_add(0.4, 0.1);
        }
        draft.look.eye = draft.look.eye.map(|x| f64::from(x as f32));
    }
}

fn measure(watts: f64, random: &mut Random) -> Measure {
    let wanted = (!random.one_in(3)).then(|| (watts * random.power(-0.5, 0.5)) as f32);
    Measure { scale: random.one_in(2).then(|| random.power(-1.0, 1.0) as f32), wanted }
}

pub(super) fn watts(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    draft.parts[1] = shape([random.between(0.3, 1.5); 3], random);
    let part = &mut draft.parts[1];
    let watts = 10.0 * PI;
    if random.one_in(2) {
        let size = [1 + random.below(4), 1 + random.below(4)];
        part.skin.glow = Some(picture(size, random));
        part.skin.uv = matches!(part.form, Form::Mesh(_))
            .then(|| Uv { rows: [[1.0, 0.2, 0.3, 0.5], [-0.1, 1.0, 0.2, 0.5]], noise: random.of(&[0.0, 0.0, 0.5]) });
        if matches!(part.form, Form::Sphere(..)) {
            // without a map, since the axes of a sphere are those of its picture
            let center = part.place.take().map_or([0.0; 3], |place| place.map.map(|row| row[3]));
            part.form = Form::Sphere(center, random.between(0.2, 0.6));
        }
    }
    if let Some(glow) = &mut part.glow {
        glow.measure = measure(watts, random);
    }
    if random.one_in(4) {
        draft.parts.remove(1);
    }
    if draft.parts.len() < 2 || random.one_in(3) {
        let mut other = match random.below(4) {
            0 => sun(1.0, random),
            1 => sky(random),
            _ => bulb(1.0, overhead(random.between(1.0, 4.0), random), random),
        };
        let is_far = matches!(other.kind, Kind::Distant(_) | Kind::Sky);
        other.measure = measure(if is_far { 1.0 } else { watts }, random);
        draft.sources.push(other);
    }
    match draft.parts.len() {
        2 if random.one_in(3) => look_at(&mut draft, 1, random),
        _ if random.one_in(3) => furnish(&mut draft, random),
        _ => {}
    }
    draft
}

/// A map that turns, and mirrors or not; and if it may, stretches.
fn turn(stretches: bool, center: V3, random: &mut Random) -> Map {
    let size = random.power(-1.0, 1.0);
    let factors = if stretches { factors(random) } else { [0; 3].map(|_| random.of(&[-size, size])) };
    map(&axes(random.below(3), random), factors, center)
}

pub(super) fn turned(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    draft.parts.remove(1);
    match random.below(4) {
        0 => {
            let irradiance = random.power(-0.5, 0.5);
            let mut other = match random.below(4) {
                0 => sun(irradiance, random),
                1 => sky(random),
                _ => bulb(irradiance, overhead(2.0, random), random),
            };
            let stretches = matches!(other.kind, Kind::Point(_) | Kind::Distant(_));
            let map = turn(stretches, [0.0; 3], random);
            // so that it still shines on the floor
            let lifted = |p: V3| {
                let [x, y, z] = map.map(|[a, b, c, _]| etendue_oracle::dot([a, b, c], p));
                y > 0.3 * (x.abs() + z.abs()) && y < 20.0 && y > 0.2
            };
            match other.kind {
                Kind::Point(from) | Kind::Spot([from, _], _) | Kind::Distant([from, _]) if !lifted(from) => {}
                _ => other.map = Some(map),
            }
            draft.sources.push(other);
        }
        1 => {
            // all around the scene
            let (radius, size) = (random.between(4.0, 8.0), random.between(1.0, 3.0));
            let mut around = Part::light(Form::Sphere([0.0; 3], radius), 0.5, false);
            let factors = [0; 3].map(|_| random.of(&[-size, size]));
            let map = map(&axes(random.below(3), random), factors, [0.0; 3]);
            around.place = Some(Place { map, is_reversed: !random.one_in(4) });
            draft.parts.push(around);
        }
        _ => {
            let size = random.between(0.5, 1.5);
            let factors = if random.one_in(3) {
                [0; 3].map(|_| random.of(&[-size, size]))
            } else {
                factors(random).map(|x| size * x.signum() * x.abs().max(0.1))
            };
            let mut part = shape(factors, random);
            part.place = part.place.map(|place| Place { is_reversed: random.one_in(3), ..place });
            draft.parts.push(part);
            if random.one_in(3) {
                look_at(&mut draft, 1, random);
                return draft;
            }
        }
    }
    if random.one_in(3) {
        furnish(&mut draft, random);
    }
    draft
}

pub(super) fn wild(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    furnish(&mut draft, random);
    if random.one_in(3) {
        draft.sources.push(sun(1.0, random));
    }
    let wild = match random.below(5) {
        0 => Wild::Any,
        1 => Wild::Opposite,
        2 => Wild::Missing,
        _ => Wild::Beyond(random.between(0.3, 3.0)),
    };
    let length = if random.one_in(2) { 1.0 } else { random.power(-30.0, 10.0) };
    for part in &mut draft.parts {
        if part.glow.is_none() && matches!(part.form, Form::Mesh(_)) {
            part.skin.bend = Some(Bend::Wild(wild, length));
        }
    }
    draft
}

pub(super) fn one_of_many(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    // a box in which lights are hidden
    let hidden = [1.5, 0.3, -1.5];
    draft.parts.push(Part::mesh(triangles(&placed(&cube(), [0.3; 3], &axes(0, random), hidden)), albedo(random)));
    let kinds = [random.below(6), random.below(6)];
    for _ in 0..1 + random.power(0.0, 1.6) as usize {
        let bright = random.power(-1.0, 1.5) as f32;
        let mut part = match random.of(&kinds) {
            0 => lamp(along(hidden, random.point(), 0.15), [0.0; 3], 0.05, random),
            1 => {
                // facing away
                let center = overhead(random.between(1.5, 4.0), random);
                let form = facing(center, center.map(|x| 2.0 * x), [random.between(0.1, 0.5); 2], random);
                Part::light(form, 10.0, false)
            }
            2 => {
                let distance = random.power(1.5, 4.0);
                let form = facing(overhead(distance, random), [0.0; 3], [1.0; 2], random);
                let power = radiance(&form, 1.0);
                Part::light(form, power, false)
            }
            3 => {
                // below the floor
                let [x, y, z] = overhead(random.between(0.2, 1.0), random);
                lamp([x, -y, z], [0.0; 3], 0.1, random)
            }
            4 => {
                draft.sources.push(bulb(bright.into(), along(hidden, random.point(), 0.15), random));
                continue;
            }
            _ => {
                // tiny, and perhaps visible
                let center = [random.between(-1.5, 1.5), random.between(0.2, 1.5), random.between(-1.0, 1.0)];
                Part::light(Form::Sphere(center, random.between(0.002, 0.02)), 200.0, false)
            }
        };
        part.glow.iter_mut().for_each(|glow| glow.radiance *= bright);
        draft.parts.push(part);
    }
    if random.one_in(3) {
        draft.look = look([0.0, 0.5, 0.0], 5.0, random);
        draft.look.fov = 40.0;
    }
    draft
}

pub(super) fn films(random: &mut Random) -> Draft {
    let mut draft = if random.one_in(3) { skies(random) } else { stage(random) };
    furnish(&mut draft, random);
    let long = random.power(1.0, 4.8) as u32;
    let short = if random.one_in(3) { long.min(1 << 12) } else { random.power(0.0, 1.5) as u32 };
    let size = if random.one_in(2) { [long, short] } else { [short, long] };
    let window = size.map(|side| {
        let count = side.min(1 + random.below(32) as u32);
        // in the middle, at an edge, or anywhere
        let start = match random.below(4) {
            0 => (side - count) * random.below(2) as u32,
            1 => random.below((side - count + 1) as usize) as u32,
            _ => (side - count) / 2,
        };
        [start, start + count]
    });
    let screen = random.one_in(3).then(|| random.power(-1.0, 0.3));
    draft.look.frame = Some(Frame { size, window, screen });
    draft.look.lens = None;
    draft
}
