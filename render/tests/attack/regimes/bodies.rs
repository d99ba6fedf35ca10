//! Scenes with difficult bodies.

use crate::attack::build::{
    Solid, albedo, any_solid, axes, cube, cut, facing, floor, lamp, level, look, overhead, placed, prism, quad,
    radiance, stage, triangles,
};
use crate::attack::draft::{Draft, Finish, Form, Part, V3};
use crate::random::Random;
use etendue_oracle::{along, length, sub, unit};

/// Half sizes of a body.
fn half(random: &mut Random) -> V3 {
    [0; 3].map(|_| random.between(0.1, 0.6))
}

/// A place above the floor.
fn above(random: &mut Random) -> V3 {
    [random.between(-0.8, 0.8), random.between(0.2, 1.5), random.between(-0.8, 0.8)]
}

/// A body anywhere above the floor.
fn free(random: &mut Random) -> Solid {
    let (solid, half, kind, center) = (any_solid(random), half(random), random.below(3), above(random));
    placed(&solid, half, &axes(kind, random), center)
}

/// A body high above the floor, and a light beyond it, so that its shadow is around the origin.
fn high(body: &Solid, height: f64, random: &mut Random) -> Draft {
    let mut draft = stage(random);
    // often right above, so that the body's upright edges appear foreshortened
    let aside = if random.one_in(2) { 1.0 } else { random.power(-3.0, -1.0) };
    let up = overhead(height, random).map(|x| x * aside);
    let up = [up[0], height, up[2]];
    // far beyond the body, or just beyond it
    let beyond = if random.one_in(2) { random.between(0.5, 2.0) * height } else { random.between(0.7, 2.0) };
    let lamp_at = up.map(|x| x * (1.0 + beyond / height));
    let size = random.between(0.5, 2.0);
    draft.parts[1] = lamp(lamp_at, [0.0; 3], size, random);
    let moved = |v: &V3| std::array::from_fn(|k| v[k] + up[k]);
    let body: Solid = body.iter().map(|face| face.iter().map(moved).collect()).collect();
    draft.parts.push(Part::mesh(triangles(&body), albedo(random)));
    draft
}

fn height(random: &mut Random) -> f64 {
    if random.one_in(2) { random.between(0.7, 2.0) } else { random.power(0.0, 2.5) }
}

pub(crate) fn thin(random: &mut Random) -> Draft {
    let size = random.between(0.3, 0.8);
    let solid = if random.one_in(4) { prism(5) } else { cube() };
    let half = [size, 0.5 * size * random.power(-5.0, -2.0), size * random.between(0.3, 1.0)];
    let kind = random.below(3);
    let body = placed(&solid, half, &axes(kind, random), [0.0; 3]);
    let height = height(random);
    high(&body, height, random)
}

pub(crate) fn chamfered(random: &mut Random) -> Draft {
    let mut solid = cube();
    for _ in 0..1 + random.below(3) {
        let corner: V3 = [0; 3].map(|_| random.of(&[-1.0, 1.0]));
        let normal = std::array::from_fn(|k| corner[k] * random.between(0.5, 1.5));
        let most = (0..3).map(|k| normal[k] * corner[k]).sum::<f64>() - random.power(-7.0, -1.0);
        solid = cut(&solid, normal, most);
    }
    let half = [0; 3].map(|_| random.between(0.3, 0.9));
    let kind = random.below(3);
    let body = placed(&solid, half, &axes(kind, random), [0.0; 3]);
    let height = height(random).max(1.2);
    high(&body, height, random)
}

pub(crate) fn open(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    for _ in 0..1 + random.below(3) {
        let mut mesh = triangles(&free(random));
        for _ in 0..1 + random.below(3) {
            let chosen = random.below(mesh.len());
            mesh.remove(chosen);
        }
        draft.parts.push(Part::mesh(mesh, albedo(random)));
    }
    draft
}

pub(crate) fn inverted(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    for _ in 0..1 + random.below(3) {
        let mut mesh = triangles(&free(random));
        let all = random.one_in(2);
        for triangle in &mut mesh {
            if all || random.one_in(2) {
                triangle.swap(1, 2);
            }
        }
        draft.parts.push(Part::mesh(mesh, albedo(random)));
    }
    let turned = random.one_in(3);
    if let Form::Parallelogram(_, u, v) = &mut draft.parts[1].form
        && turned
    {
        std::mem::swap(u, v);
    }
    draft
}

pub(crate) fn nested(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let (solid, half, center, kind) = (any_solid(random), half(random), above(random), random.below(3));
    let axes = axes(kind, random);
    for size in [1.0, random.between(0.9, 0.999_99), random.between(0.2, 0.7)] {
        let body = placed(&solid, half.map(|x| x * size), &axes, center);
        draft.parts.push(Part::mesh(triangles(&body), albedo(random)));
    }
    if random.one_in(2) {
        draft.parts.push(Part::ball(center, random.between(0.05, 0.5), albedo(random)));
    }
    draft
}

pub(crate) fn touching(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let unit_axes = axes(0, random);
    // sides that f32 has, so that what touches does so exactly
    let length = |random: &mut Random| 0.0625 * (1 + random.below(8)) as f64;
    let (a, b) = ([0; 3].map(|_| length(random)), [0; 3].map(|_| length(random)));
    let center = [-0.25, a[1], 0.125];
    let beside = [center[0] + a[0] + b[0], a[1], center[2] + 0.0625];
    let on_top = [center[0] + 0.0625, 2.0 * a[1] + b[1], center[2]];
    for (half, center) in [(a, center), ([b[0], a[1], b[2]], beside), (b, on_top)] {
        let mesh = triangles(&placed(&cube(), half, &unit_axes, center));
        draft.parts.push(Part::mesh(mesh, albedo(random)));
    }
    if random.one_in(2) {
        let radius = length(random);
        draft.parts.push(Part::ball([center[0] - a[0] - radius, radius, center[2]], radius, albedo(random)));
    }
    draft
}

pub(crate) fn coplanar(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    // what is twice in the same place has one albedo
    let Finish::Diffuse(ground) = draft.parts[0].finish else { return draft };
    for _ in 0..1 + random.below(2) {
        let (x, z) = (random.between(-1.0, 0.5), random.between(-1.0, 0.5));
        let mesh = quad([x, 0.0, z], [0.0, 0.0, 0.75], [0.5, 0.0, random.between(0.0, 0.2)]);
        draft.parts.push(Part::mesh(mesh, ground));
    }
    for _ in 0..1 + random.below(3) {
        let mut mesh = triangles(&free(random));
        for _ in 0..1 + random.below(4) {
            let mut again = mesh[random.below(mesh.len())];
            if random.one_in(2) {
                again.swap(0, 1);
            }
            mesh.push(again);
        }
        draft.parts.push(Part::mesh(mesh, albedo(random)));
    }
    draft
}

pub(crate) fn soup(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    for _ in 0..1 + random.below(8) {
        let (center, size) = (above(random), random.power(-2.0, 0.0));
        let corner = |random: &mut Random| {
            let by = random.point();
            std::array::from_fn(|k| center[k] + size * by[k])
        };
        let mesh = vec![[0; 3].map(|_| corner(random))];
        draft.parts.push(Part::mesh(mesh, albedo(random)));
    }
    if random.one_in(3) {
        let (center, size) = (overhead(3.0, random), random.between(0.2, 1.0));
        draft.parts.push(lamp(center, [0.0; 3], size, random));
    }
    draft
}

pub(crate) fn balls(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    for _ in 0..1 + random.below(3) {
        let radius = random.power(-1.5, -0.2);
        let mut center = above(random);
        if random.one_in(2) {
            center[1] = radius;
        }
        draft.parts.push(Part::ball(center, radius, albedo(random)));
    }
    if random.one_in(3) {
        // one that the light reaches into
        let center = unit(random.point()).map(|x| 3.0 * x.abs());
        let form = facing(center, [0.0; 3], [1.0, 1.0], random);
        let radiance = radiance(&form, 3.0);
        draft.parts.push(Part::light(form, radiance, true));
        draft.parts.push(Part::ball(center, random.between(0.1, 0.9), albedo(random)));
    }
    if random.one_in(3) {
        draft.parts.push(Part::mesh(level(0.9, 0.4), albedo(random)));
    }
    if random.one_in(4) {
        draft.parts[0] = floor(20.0, random);
        draft.look = look([0.0, 0.2, 0.0], 6.0, random);
    }
    draft
}

/// Points next to a wall see its edges under nearly 180°.
pub(crate) fn walls(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    let (height, reach) = (random.power(-1.3, 0.3), random.between(5.0, 50.0));
    let half = [reach, 0.5 * height, 0.5 * height * random.power(-3.0, 0.0)];
    draft.parts[0] = floor(2.0 * reach, random);
    let (kind, center) = (random.below(2), [0.0, half[1], 0.0]);
    let axes = axes(kind, random);
    let at = |v: V3| -> V3 { (0..3).fold(center, |sum, k| along(sum, axes[k], v[k] * half[k])) };
    let mesh = if random.one_in(4) {
        quad(at([-1.0, -1.0, 0.0]), axes[0].map(|x| 2.0 * half[0] * x), axes[1].map(|x| 2.0 * half[1] * x))
    } else {
        triangles(&placed(&cube(), half, &axes, center))
    };
    draft.parts.push(Part::mesh(mesh, albedo(random)));
    // a lamp behind it, seen past its upper edge
    let top = at([random.between(-1.0, 1.0), 1.0, 0.0]);
    let foot = along([top[0], 0.0, top[2]], axes[2], height * random.between(0.1, 5.0));
    let beyond = along(foot, sub(top, foot), random.between(1.3, 30.0));
    let size = length(sub(beyond, foot)) * random.power(-3.0, 0.0);
    draft.parts[1] = lamp(beyond, foot, size, random);
    draft.look = look(foot, random.between(1.0, 5.0), random);
    draft
}
