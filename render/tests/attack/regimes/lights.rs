//! Scenes with difficult lights.

use super::places::furnish;
use crate::attack::build::{
    albedo, axes, cube, facing, lamp, level, look, overhead, placed, quad, radiance, stage, triangles,
};
use crate::attack::draft::{Draft, Form, Part, V3};
use crate::random::Random;
use etendue_oracle::{along, length, sub, unit};

/// Something to cast a shadow around the origin, between it and a light.
fn shade(draft: &mut Draft, towards: V3, random: &mut Random) {
    let center = towards.map(|x| x * random.between(0.6, 1.4));
    let size = random.between(0.15, 0.6);
    if random.one_in(2) {
        draft.parts.push(Part::ball(center, size, albedo(random)));
    } else {
        let (half, kind) = ([0; 3].map(|_| size * random.between(0.3, 1.0)), random.below(3));
        let body = placed(&cube(), half, &axes(kind, random), center);
        draft.parts.push(Part::mesh(triangles(&body), albedo(random)));
    }
}

pub(crate) fn tiny(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let towards = overhead(1.0, random);
    let distance = random.between(1.5, 5.0);
    let size = random.power(-5.0, -2.0);
    draft.parts[1] = lamp(towards.map(|x| x * distance), [0.0; 3], size, random);
    if random.one_in(4) {
        // above a ball, very close
        draft.parts.push(Part::ball(towards.map(|x| x * 0.9), 0.05, albedo(random)));
    }
    shade(&mut draft, towards, random);
    draft
}

/// A light at a distance of 1e2 to 1e6 that appears under this angle in radians.
fn distant(angle: f64, random: &mut Random) -> (V3, Part) {
    let towards = overhead(1.0, random);
    let distance = random.power(2.0, 6.0);
    let center = towards.map(|x| x * distance);
    let form = if random.one_in(3) {
        facing(center, [0.0; 3], [distance * angle; 2], random)
    } else {
        Form::Sphere(center, 0.5 * distance * angle)
    };
    let radiance = radiance(&form, distance);
    (towards, Part::light(form, radiance, false))
}

pub(crate) fn far(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let (towards, sun) = distant(0.5_f64.to_radians(), random);
    draft.parts[1] = sun;
    shade(&mut draft, towards, random);
    if random.one_in(2) {
        furnish(&mut draft, random);
    }
    draft
}

pub(crate) fn far_speck(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let angle = random.power(-4.0, -2.0);
    let (towards, sun) = distant(angle, random);
    draft.parts[1] = sun;
    shade(&mut draft, towards, random);
    draft
}

pub(crate) fn millimetres(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let towards = overhead(1.0, random);
    let size = random.power(-3.0, -1.0);
    let form = facing(towards.map(|x| x * random.between(0.8, 2.0)), [0.0; 3], [size, size], random);
    let radiance = radiance(&form, 1.0);
    draft.parts[1] = Part::light(form, radiance, false);
    if random.one_in(2) {
        shade(&mut draft, towards.map(|x| 0.5 * x), random);
    }
    draft.shift([0; 3].map(|_| random.between(40.0, 700.0).round()));
    draft.look.eye = draft.look.eye.map(|x| f64::from(x as f32));
    draft
}

pub(crate) fn sun_and_lamp(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let (_, sun) = distant(0.5_f64.to_radians(), random);
    draft.parts.push(sun);
    furnish(&mut draft, random);
    draft
}

pub(crate) fn lampshade(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let towards = overhead(1.0, random);
    let distance = random.power(0.5, 4.0);
    let radius = distance * random.power(-2.5, -1.0);
    let center = towards.map(|x| x * distance);
    let form = Form::Sphere(center, radius);
    let radiance = radiance(&form, distance);
    draft.parts[1] = Part::light(form, radiance, false);
    // a screen just before it, which hides some of it
    let near = along(center, unit(center), -radius * random.between(1.000_01, 1.2));
    let aside: V3 = random.point().map(|x| 0.8 * radius * x);
    let near = std::array::from_fn(|k| near[k] + aside[k]);
    let size = radius * random.between(0.3, 1.5);
    if let Form::Parallelogram(p, u, v) = facing(near, [0.0; 3], [size; 2], random) {
        let corner = along(p, u, 1.0);
        let mesh = vec![[p, corner, along(corner, v, 1.0)], [p, along(corner, v, 1.0), along(p, v, 1.0)]];
        draft.parts.push(Part::mesh(mesh, albedo(random)));
    }
    if random.one_in(2) {
        shade(&mut draft, towards, random);
    }
    draft
}

pub(crate) fn flush(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let y = 2.0;
    let lamp_y = random.of(&[y, y, y - 1e-4, y - 1e-2, y + 1e-2]);
    let (x, z) = (random.between(-0.5, 0.1), random.between(-0.5, 0.1));
    let (u, v) = ([random.between(0.1, 0.8), 0.0, 0.0], [0.0, 0.0, random.between(0.1, 0.8)]);
    let form = Form::Parallelogram([x, lamp_y, z], u, v);
    let radiance = radiance(&form, y);
    draft.parts[1] = Part::light(form, radiance, random.one_in(4));
    draft.parts.push(Part::mesh(level(y, 2.0), albedo(random)));
    if random.one_in(2) {
        // a frame below the lamp
        draft.parts.push(Part::mesh(level(y - 0.05, 0.2), albedo(random)));
    }
    furnish(&mut draft, random);
    draft.look = look([0.0, 0.2, 0.0], 1.9, random);
    draft
}

/// Width of the images in whose pixels what is rare is measured.
pub(crate) const RARE_SIDE: u32 = 16;

/// A speck or a sliver in view, or the light of a lamp through a keyhole, that has most of the light of the image, besides up to 40 lamps.
pub(crate) fn rare(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    furnish(&mut draft, random);
    let count = random.power(0.0, 1.6) as usize;
    let faint = 0.3 / count.max(1) as f32;
    draft.parts[1].glow.iter_mut().for_each(|glow| glow.radiance *= faint);
    for _ in 1..count {
        let center = overhead(random.between(1.5, 4.0), random);
        let mut part = lamp(center, [0.0; 3], random.between(0.1, 0.5), random);
        part.glow.iter_mut().for_each(|glow| glow.radiance *= faint);
        draft.parts.push(part);
    }
    let side = f64::from(RARE_SIDE);
    // the light of the speck, relative to that of the rest of the image
    let share = random.power(-0.3, 0.7);
    if random.one_in(3) {
        // four sheets leave a hole between a bright lamp and the floor
        let (hole, height) = (0.5 * random.power(-1.5, -0.7), random.between(0.6, 1.2));
        let [x, z] = [0; 2].map(|_| random.between(-0.5, 0.5));
        let sheet = |[left, right]: [f64; 2], [near, far]: [f64; 2]| {
            Part::mesh(quad([left, height, near], [right - left, 0.0, 0.0], [0.0, 0.0, far - near]), 0.5)
        };
        let wide = [-0.8, 0.8];
        draft.parts.push(sheet(wide, [-0.8, z - hole]));
        draft.parts.push(sheet(wide, [z + hole, 0.8]));
        draft.parts.push(sheet([-0.8, x - hole], [z - hole, z + hole]));
        draft.parts.push(sheet([x + hole, 0.8], [z - hole, z + hole]));
        let from = along([x, height, z], [random.between(-0.3, 0.3), 1.0, random.between(-0.3, 0.3)], 1.0);
        let mut bright = lamp(from, [x, height, z], random.power(-2.0, -0.5), random);
        let lit = (side * hole / 1.5).powi(2) / (side * side);
        bright.glow.iter_mut().for_each(|glow| glow.radiance *= (share * 0.3 / lit.max(1e-3)) as f32);
        draft.parts.push(bright);
        return draft;
    }
    let center = [random.between(-0.8, 0.8), random.between(0.2, 1.2), random.between(-0.8, 0.8)];
    let distance = length(sub(center, draft.look.eye));
    let pixel = 2.0 * libm::tan(0.5 * draft.look.fov.to_radians()) * distance / side;
    // in pixels
    let area = random.power(-2.0, -0.3);
    let form = if random.one_in(2) {
        Form::Sphere(center, pixel * (area / std::f64::consts::PI).sqrt())
    } else {
        let long = random.between(1.0, 3.0).max(area.sqrt());
        facing(center, draft.look.eye, [pixel * long, pixel * area / long], random)
    };
    draft.parts.push(Part::light(form, (share * 0.1 * side * side / area) as f32, false));
    draft
}
