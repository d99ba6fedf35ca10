//! Scenes as people make them: under a sky, smooth anyhow, with many lights, and on any film.

use super::places::furnish;
use crate::attack::build::{
    albedo, axes, cube, facing, floor, lamp, level, look, map, overhead, placed, radiance, stage, triangles,
};
use crate::attack::draft::{Draft, Form, Frame, Kind, Part, SourceDraft, V3};
use crate::attack::skin::{Bend, Picture, Wild};
use crate::random::Random;
use etendue_oracle::along;

fn source(kind: Kind, strength: f64) -> SourceDraft {
    SourceDraft { kind, strength: strength as f32, map: None, picture: None }
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
fn sky(random: &mut Random) -> SourceDraft {
    let mut sky = source(Kind::Sky, random.power(-1.5, 1.0));
    let axes = axes(random.below(2), random);
    // the pole of axes without a turn is +y
    sky.map = Some(map(&[axes[2], axes[0], axes[1]], [1.0; 3], [0.0; 3]));
    if random.one_in(2) {
        let size = random.of(&[[1, 1], [2, 2], [4, 4], [8, 8], [2, 1], [6, 3], [16, 8], [3, 5]]);
        sky.picture = Some(picture(size, random));
    }
    sky
}

fn sun(strength: f64, random: &mut Random) -> SourceDraft {
    let from = overhead(random.power(-1.0, 3.0), random);
    source(Kind::Distant([from, [0.0; 3]]), strength)
}

/// A point or a spot light with about this irradiance at the origin.
fn bulb(irradiance: f64, from: V3, random: &mut Random) -> SourceDraft {
    let kind = if random.one_in(2) {
        Kind::Point(from)
    } else {
        let angle = if random.one_in(3) { random.power(-2.0, 1.0) } else { random.between(10.0, 80.0) };
        let to = if angle < 10.0 { [0.0; 3] } else { random.point().map(|x| 0.3 * x) };
        Kind::Spot([from, to], [angle, angle * random.of(&[0.0, 0.2, 1.0])])
    };
    source(kind, irradiance * etendue_oracle::dot(from, from))
}

pub(crate) fn skies(random: &mut Random) -> Draft {
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

pub(crate) fn wild(random: &mut Random) -> Draft {
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

pub(crate) fn one_of_many(random: &mut Random) -> Draft {
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

pub(crate) fn films(random: &mut Random) -> Draft {
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
