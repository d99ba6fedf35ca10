//! Scenes in difficult places, or seen from them.

use crate::attack::build::{
    albedo, any_solid, axes, cube, facing, floor, lamp, level, overhead, placed, quad, radiance, stage, triangles,
};
use crate::attack::draft::{Draft, Finish, Form, Look, Part, V3};
use crate::random::Random;
use etendue_oracle::{along, unit};

/// A few boxes and balls that stand on the floor or float.
pub(crate) fn furnish(draft: &mut Draft, random: &mut Random) {
    for _ in 0..1 + random.below(3) {
        let size = random.between(0.1, 0.45);
        let mut center = [random.between(-0.8, 0.8), size, random.between(-0.8, 0.8)];
        if random.one_in(2) {
            center[1] += random.between(0.0, 1.0);
        }
        if random.one_in(3) {
            draft.parts.push(Part::ball(center, size, albedo(random)));
            continue;
        }
        let (solid, kind) = (any_solid(random), random.below(2));
        let half = [random.between(0.5, 1.0) * size, size, random.between(0.5, 1.0) * size];
        let body = placed(&solid, half, &axes(kind, random), center);
        draft.parts.push(Part::mesh(triangles(&body), albedo(random)));
    }
}

/// A floor and a camera within ±0.5 of the origin, and lights that may be in or outside of what encloses them.
fn enclosed(shell: Part, outside: f64, random: &mut Random) -> Draft {
    let y = random.between(-0.4, 0.0);
    let mut parts = vec![Part::mesh(level(y, 0.5), albedo(random)), shell];
    if random.one_in(2) {
        let size = random.between(0.05, 0.15);
        let center = [random.between(-0.3, 0.3), y + size, random.between(-0.3, 0.3)];
        if random.one_in(2) {
            parts.push(Part::ball(center, size, albedo(random)));
        } else {
            let body = placed(&cube(), [size; 3], &axes(1, random), center);
            parts.push(Part::mesh(triangles(&body), albedo(random)));
        }
    }
    let which = random.below(4);
    if which != 1 {
        let center = overhead(outside * random.between(1.1, 3.0), random);
        let size = outside * random.between(0.3, 2.0);
        parts.push(lamp(center, [0.0; 3], size, random));
    }
    if which != 0 {
        let size = random.between(0.1, 0.3);
        let center = [random.between(-0.2, 0.2), random.between(0.3, 0.45), random.between(-0.2, 0.2)];
        parts.push(lamp(center, [0.0, y, 0.0], size, random));
    }
    let angle = random.between(0.0, std::f64::consts::TAU);
    let eye = [0.5 * libm::cos(angle), random.between(0.1, 0.4), 0.5 * libm::sin(angle)];
    let lens = random.one_in(3).then(|| [random.between(0.01, 0.1), random.between(0.5, 1.0)]);
    let eye = eye.map(|x| f64::from(x as f32));
    let look =
        Look { eye, target: [0.0, y, 0.0], up: [0.0, 1.0, 0.0], fov: random.between(40.0, 90.0), lens, frame: None };
    Draft::new(String::new(), look, parts)
}

pub(crate) fn in_sphere(random: &mut Random) -> Draft {
    let radius = random.between(0.9, 1.5);
    let center = random.point().map(|x| 0.1 * x);
    let mut shell = Part::ball(center, radius, albedo(random));
    if random.one_in(4) {
        shell.finish = Finish::Mirror(0.8);
    }
    enclosed(shell, radius + 0.2, random)
}

pub(crate) fn in_box(random: &mut Random) -> Draft {
    let half = [0; 3].map(|_| random.between(0.9, 1.5));
    let (kind, center) = (random.below(3), random.point().map(|x| 0.05 * x));
    let mut mesh = triangles(&placed(&cube(), half, &axes(kind, random), center));
    if random.one_in(3) {
        let chosen = random.below(mesh.len());
        mesh.remove(chosen);
    }
    enclosed(Part::mesh(mesh, albedo(random)), 2.7, random)
}

pub(crate) fn far_away(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    furnish(&mut draft, random);
    let distance = random.power(1.0, 3.0);
    let by = unit(random.point()).map(|x| f64::from((x * distance) as f32));
    draft.shift(by);
    draft.look.eye = draft.look.eye.map(|x| f64::from(x as f32));
    draft
}

pub(crate) fn vast_floor(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let half = random.power(2.0, 7.0);
    draft.parts[0] = match random.below(3) {
        // a fan around a corner
        0 => {
            let (a, b, c) = ([half, 0.0, -half], [-half, 0.0, -half], [0.0, 0.0, half]);
            Part::mesh(vec![[a, b, c]], albedo(random))
        }
        1 => {
            let slope = random.between(-0.2, 0.2);
            let (u, v) = ([0.0, 0.0, 2.0 * half], [2.0 * half, 2.0 * slope * half, 0.0]);
            Part::mesh(quad([-half, -slope * half, -half], u, v), albedo(random))
        }
        _ => floor(half, random),
    };
    furnish(&mut draft, random);
    draft
}

pub(crate) fn camera(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    furnish(&mut draft, random);
    let half = [0.25, 0.5, 0.25];
    let (x, z) = (0.125 * random.below(8) as f64 - 0.5, 0.125 * random.below(8) as f64 - 0.5);
    let mesh = triangles(&placed(&cube(), half, &axes(0, random), [x, 0.5, z]));
    let away = unit(random.point());
    // on a surface, but not in its plane: what a camera there sees is a matter of taste
    let just = f64::from(random.power(-5.0, -2.0) as f32);
    match random.below(4) {
        // on top of a box, over its edge
        0 => {
            draft.parts.push(Part::mesh(mesh, albedo(random)));
            draft.look.eye = [x, 1.0 + just, z];
            draft.look.target = [x + away[0], 1.0 - 0.5 * away[1].abs(), z + away[2]];
        }
        // in a box that may be open
        1 => {
            let mut mesh = mesh;
            if random.one_in(2) {
                mesh.remove(random.below(12));
            }
            draft.parts.push(Part::mesh(mesh, albedo(random)));
            draft.look.eye = [x, 0.5, z];
            draft.look.target = along([x, 0.5, z], away, 1.0);
        }
        // in a ball, with another around it
        2 => {
            draft.parts.push(Part::ball([x, 0.5, z], 0.25, albedo(random)));
            draft.parts.push(Part::ball([x, 0.5, z], 0.5, albedo(random)));
            draft.look.eye = [x, 0.5, z];
            draft.look.target = along([x, 0.5, z], away, 1.0);
        }
        // on the floor
        _ => {
            draft.look.eye = [x + 1.0, just, z];
            draft.look.target = [x, random.between(0.05, 0.3), z];
        }
    }
    draft.look.fov = random.between(40.0, 100.0);
    // seen from inside, a body that stands on the floor has two faces in the same place: they have one albedo
    let finish = draft.parts[0].finish;
    for part in &mut draft.parts {
        if part.glow.is_none() && matches!(part.form, Form::Mesh(_)) {
            part.finish = finish;
        }
    }
    draft
}

pub(crate) fn lens(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    furnish(&mut draft, random);
    draft.look.lens = Some([random.power(-2.0, -0.7), random.between(2.0, 6.0)]);
    draft
}

/// A stage with lights that are large enough to be reflected.
pub(crate) fn bright(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let center: V3 = overhead(3.0, random);
    let form = match random.below(2) {
        0 => Form::Sphere(center, random.between(0.4, 0.8)),
        _ => facing(center, [0.0; 3], [random.between(0.8, 2.0); 2], random),
    };
    let radiance = radiance(&form, 3.0);
    draft.parts[1] = Part::light(form, radiance, false);
    furnish(&mut draft, random);
    draft
}

pub(crate) fn mirrors(random: &mut Random) -> Draft {
    let mut draft = bright(random);
    let finish = if random.one_in(2) { Finish::Mirror(0.9) } else { Finish::Metal { eta: 0.2, k: 3.5, alpha: 0.0 } };
    for _ in 0..1 + random.below(2) {
        let center = [random.between(-1.0, 1.0), random.between(0.3, 0.6), random.between(-1.0, 1.0)];
        let form = if random.one_in(2) {
            Form::Sphere(center, random.between(0.15, 0.3))
        } else {
            let angle = random.between(0.0, std::f64::consts::TAU);
            let u = [1.5 * libm::cos(angle), 0.0, 1.5 * libm::sin(angle)];
            Form::Mesh(quad([-0.5 * u[0], 0.0, -0.5 * u[2]], u, [0.1, 1.2, 0.0]))
        };
        draft.parts.push(Part { form, finish, ..Part::mesh(Vec::new(), 0.0) });
    }
    draft
}

pub(crate) fn metals(random: &mut Random) -> Draft {
    let mut draft = bright(random);
    let alpha = random.of(&[0.2, 0.35, 0.5, 0.8]);
    let finish = Finish::Metal { eta: random.of(&[0.2, 1.1]), k: random.of(&[2.0, 3.5]), alpha };
    if random.one_in(2) {
        draft.parts[0].finish = finish;
    }
    for part in draft.parts.iter_mut().skip(2) {
        if random.one_in(2) {
            part.finish = finish;
        }
    }
    draft
}
