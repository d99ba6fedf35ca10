//! Scenes as other renderers have them: instances, textures, holes and smooth surfaces.

use super::{bodies, lights, places};
use crate::attack::build::{
    Triangle, albedo, any_solid, axes, has_area, lamp, map, overhead, placed, quad, stage, then, triangles,
};
use crate::attack::draft::{Draft, Finish, Form, Map, Part, V3};
use crate::attack::skin::{Bend, Pattern, Picture, Uv};
use crate::random::Random;
use etendue_oracle::{cross, sub, unit};

type Make = fn(&mut Random) -> Draft;

/// The regimes without any of this in which nothing is in the same place as something else.
const PLAIN: [Make; 23] = [
    bodies::thin,
    bodies::chamfered,
    bodies::open,
    bodies::inverted,
    bodies::nested,
    bodies::touching,
    bodies::soup,
    bodies::balls,
    places::in_sphere,
    places::in_box,
    places::far_away,
    places::vast_floor,
    places::camera,
    places::lens,
    places::mirrors,
    places::metals,
    lights::tiny,
    lights::far,
    lights::far_speck,
    lights::millimetres,
    lights::sun_and_lamp,
    lights::lampshade,
    lights::flush,
];

/// A scene of any of the regimes without any of this.
fn plain(random: &mut Random) -> Draft {
    if random.one_in(PLAIN.len() + 1) { bodies::coplanar(random) } else { apart(random) }
}

/// One in which what is seen does not depend on which of two surfaces in the same place is first.
fn apart(random: &mut Random) -> Draft {
    random.of(&PLAIN)(random)
}

/// The meshes that do not emit.
fn meshes(draft: &mut Draft) -> impl Iterator<Item = &mut Part> {
    draft.parts.iter_mut().filter(|part| part.glow.is_none() && matches!(part.form, Form::Mesh(_)))
}

/// A map without shift that single precision applies without rounding, and its inverse: axes are exchanged and turned, and one power of 2
/// is the factor.
fn exact(random: &mut Random) -> [Map; 2] {
    let order = random.of(&[[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]]);
    let factor = libm::exp2(random.below(17) as f64 - 8.0);
    let signs: V3 = [0; 3].map(|_| random.of(&[-1.0, 1.0]));
    let mut both = [[[0.0; 4]; 3]; 2];
    for k in 0..3 {
        both[0][k][order[k]] = signs[k] * factor;
        both[1][order[k]][k] = signs[k] / factor;
    }
    both
}

fn moved(map: &Map, p: V3) -> V3 {
    map.map(|[a, b, c, d]| a * p[0] + b * p[1] + c * p[2] + d)
}

/// Replaces a mesh by an instance that is in the same place.
fn replace(part: &mut Part, random: &mut Random) {
    let [there, back] = exact(random);
    if let Form::Mesh(triangles) = &mut part.form {
        triangles.iter_mut().for_each(|triangle| *triangle = triangle.map(|p| moved(&back, p)));
        part.copies = vec![there];
    }
}

pub(crate) fn copies(random: &mut Random) -> Draft {
    let mut draft = plain(random);
    let all = random.one_in(2);
    draft.is_shared = true;
    for part in meshes(&mut draft) {
        if all || random.one_in(2) {
            replace(part, random);
        }
    }
    draft
}

/// A mesh within about [−1, 1]³.
fn object(random: &mut Random) -> Vec<Triangle> {
    let corner = |random: &mut Random| random.point();
    match random.below(6) {
        0 => vec![[0; 3].map(|_| corner(random))],
        1 => (0..2 + random.below(6)).map(|_| [0; 3].map(|_| corner(random))).collect(),
        2 => quad([-1.0, 0.0, -1.0], [0.0, 0.0, 2.0], [2.0, 0.0, 0.0]),
        3 => {
            let mut mesh = triangles(&any_solid(random));
            let chosen = random.below(mesh.len());
            mesh.remove(chosen);
            mesh
        }
        _ => triangles(&any_solid(random)),
    }
}

/// Factors of an instance: the same, different or very different ones, each of them perhaps a mirror.
fn factors(random: &mut Random) -> V3 {
    let signs: V3 = [0; 3].map(|_| if random.one_in(3) { -1.0 } else { 1.0 });
    let sizes = match random.below(4) {
        0 => [1.0; 3],
        1 | 2 => [0; 3].map(|_| random.between(0.3, 1.0)),
        _ => {
            let mut sizes = [1.0; 3];
            sizes[random.below(3)] = random.power(-4.0, -1.0);
            sizes
        }
    };
    [0, 1, 2].map(|k| signs[k] * sizes[k])
}

/// Instances of an object, of about this size in world space, whose own coordinates are of size `own` about `middle`.
fn instances(own: f64, middle: V3, random: &mut Random) -> Part {
    let mut mesh = object(random);
    for triangle in &mut mesh {
        *triangle = triangle.map(|p| [0, 1, 2].map(|k| middle[k] + own * p[k]));
    }
    mesh.retain(has_area);
    let mut part = Part::mesh(mesh, albedo(random));
    let to_unit = map(&axes(0, random), [1.0 / own; 3], middle.map(|x| -x / own));
    for _ in 0..1 + random.below(6) {
        let (size, kind) = (random.between(0.1, 0.6), random.below(3));
        let center = [random.between(-0.8, 0.8), random.between(0.2, 1.5), random.between(-0.8, 0.8)];
        let mut place = then(&to_unit, &map(&axes(kind, random), factors(random).map(|x| x * size), [0.0; 3]));
        if random.one_in(3) {
            // stretched again along other axes, as by a node above
            let factors = factors(random);
            place = then(&place, &map(&axes(2, random), factors, [0.0; 3]));
        }
        let mut center = center;
        let heights = part.form.triangles().iter().flatten().map(|p| moved(&place, *p)[1]);
        let [low, high] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)]);
        // on the floor; but what lies on it would be in the same place
        if random.one_in(3) && high - low > 1e-3 {
            center[1] = -low;
        }
        (0..3).for_each(|k| place[k][3] += center[k]);
        let flat = |triangle: &Triangle| !has_area(&triangle.map(|p| moved(&place, p)));
        if !part.form.triangles().iter().any(flat) {
            part.copies.push(place);
        }
    }
    part
}

/// Leaves out what has no copy.
fn with(mut draft: Draft, parts: Vec<Part>, is_shared: bool) -> Draft {
    draft.parts.extend(parts.into_iter().filter(|part| !part.copies.is_empty() && part.size() > 0));
    draft.is_shared = is_shared;
    draft
}

pub(crate) fn instanced(random: &mut Random) -> Draft {
    let draft = stage(random);
    let mut parts: Vec<Part> = (0..1 + random.below(3)).map(|_| instances(1.0, [0.0; 3], random)).collect();
    for part in &mut parts {
        if random.one_in(3) {
            bend(part, random);
        }
    }
    let is_shared = !random.one_in(4);
    with(draft, parts, is_shared)
}

pub(crate) fn odd_units(random: &mut Random) -> Draft {
    let draft = stage(random);
    let mut parts = Vec::new();
    for _ in 0..1 + random.below(3) {
        let own = random.power(-4.0, 4.0);
        let middle = if random.one_in(2) { [0.0; 3] } else { random.point().map(|x| own * x * random.power(0.0, 2.0)) };
        parts.push(instances(own, middle, random));
    }
    let mut draft = with(draft, parts, true);
    if random.one_in(2) {
        let by = random.point().map(|x| x * random.power(0.0, 3.0));
        draft.shift(by);
        draft.look.eye = draft.look.eye.map(|x| f64::from(x as f32));
    }
    draft
}

/// Texture coordinates across the greatest extents of a mesh: some parts of the picture or many, of any sign, or the same everywhere.
fn uv(triangles: &[Triangle], random: &mut Random) -> Uv {
    let corners = triangles.as_flattened();
    let bound = |k: usize, by: fn(f64, f64) -> f64, from: f64| corners.iter().map(|p| p[k]).fold(from, by);
    let low = [0, 1, 2].map(|k| bound(k, f64::min, f64::INFINITY));
    let size = [0, 1, 2].map(|k| bound(k, f64::max, f64::NEG_INFINITY) - low[k]);
    let least = 1e-3 * size.iter().fold(0.0, |m: f64, x| m.max(*x));
    let size = size.map(|x| x.max(least));
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| size[*b].total_cmp(&size[*a]));
    if random.one_in(3) {
        order.rotate_left(1);
    }
    let times = if random.one_in(5) { random.power(0.0, 2.0) } else { random.between(0.3, 3.0) };
    let row = |axis: usize, random: &mut Random| {
        let factor = times * random.of(&[-1.0, 1.0, 1.0]) / size[axis];
        let shift = random.between(-2.0, 2.0);
        let mut row = [0.0; 4];
        (row[axis], row[3]) = (factor, shift - factor * low[axis]);
        if random.one_in(6) {
            // the other axis, too
            row[order[2]] = times * random.between(-1.0, 1.0) / size[order[2]];
        }
        row
    };
    let rows = [row(order[0], random), row(order[1], random)];
    let noise = if random.one_in(4) { random.power(-1.0, 0.7) } else { 0.0 };
    match random.below(12) {
        0 => Uv { rows: [[0.0, 0.0, 0.0, random.between(-1.0, 2.0)], rows[1]], noise: 0.0 },
        1 => Uv { rows: [[0.0, 0.0, 0.0, 0.3], [0.0, 0.0, 0.0, random.between(0.0, 1.0)]], noise: 0.0 },
        _ => Uv { rows, noise },
    }
}

/// Numbers of this list, or any from 0 to 1.
fn pattern(list: &[f32], random: &mut Random) -> Pattern {
    let number = |random: &mut Random| if random.one_in(8) { random.unit() as f32 } else { random.of(list) };
    let picture = if random.one_in(5) {
        Err([number(random), number(random)])
    } else {
        let (width, height) = (1 + random.below(5), 1 + random.below(5));
        Ok(Picture { width, texels: (0..width * height).map(|_| number(random)).collect() })
    };
    let is_scaled = random.one_in(3);
    let scale = |random: &mut Random| {
        if is_scaled { [random.of(&[-1.0, 1.0, 2.0, 0.25]), random.between(-3.0, 3.0)] } else { [1.0, 0.0] }
    };
    Pattern {
        picture,
        wrap: random.of(&["repeat", "repeat", "clamp", "black", "octahedralsphere"]),
        is_bilinear: random.one_in(2),
        scale: [scale(random), scale(random)],
        is_inverted: random.one_in(5),
    }
}

/// Gives a mesh holes.
fn punch(part: &mut Part, random: &mut Random) {
    let uv = uv(part.form.triangles(), random);
    part.skin.uv.get_or_insert(uv);
    let list: &[f32] = if random.one_in(2) { &[0.0, 1.0] } else { &[0.0, 0.25, 0.5, 1.0, 1.0] };
    part.skin.opacity = Some(pattern(list, random));
}

/// Gives a mesh an albedo that varies.
fn paint(part: &mut Part, random: &mut Random) {
    let uv = uv(part.form.triangles(), random);
    part.skin.uv.get_or_insert(uv);
    if matches!(part.finish, Finish::Diffuse(_) | Finish::Coat { .. }) {
        part.skin.albedo = Some(pattern(&[0.0, 0.2, 0.5, 0.9], random));
    }
}

/// Gives a mesh the normals of a smooth surface.
fn bend(part: &mut Part, random: &mut Random) {
    let corners = part.form.triangles().as_flattened();
    let Some(first) = corners.first().copied() else { return };
    let count = corners.len() as f64;
    let middle = corners.iter().fold([0.0; 3], |sum, p| [0, 1, 2].map(|k| sum[k] + p[k] / count));
    let [a, b, c] = part.form.triangles()[0];
    let normal = unit(cross(sub(b, a), sub(c, a)));
    let size = corners.iter().map(|p| etendue_oracle::length(sub(*p, middle))).fold(0.0, f64::max);
    part.skin.bend = Some(if random.one_in(2) {
        Bend::Bumps(random.power(-2.0, 0.7))
    } else {
        // near the middle, or far below the first triangle
        let depth = size * random.of(&[0.0, 0.3, 1.0, 4.0]);
        let from = if random.one_in(2) { middle } else { first };
        Bend::Ball([0, 1, 2].map(|k| from[k] - depth * normal[k] + 1e-3 * size))
    });
}

/// Gives a diffuse mesh a coat.
fn coat(part: &mut Part, random: &mut Random) {
    if let Finish::Diffuse(albedo) = part.finish {
        let reflectance = random.of(&[0.04, 0.04, 0.3, 0.9]);
        part.finish = Finish::Coat { albedo, reflectance, alpha: random.power(-0.7, 0.0) as f32 };
    }
}

/// Screens between the floor and the light, and other things with holes.
pub(crate) fn holes(random: &mut Random) -> Draft {
    let mut draft = stage(random);
    if random.one_in(3) {
        // one that a small body can hide
        let (center, size) = (overhead(random.between(2.0, 5.0), random), random.power(-2.0, -0.5));
        draft.parts[1] = lamp(center, [0.0; 3], size, random);
    }
    for _ in 0..1 + random.below(3) {
        let center = overhead(random.between(0.4, 1.6), random);
        let mut part = if random.one_in(3) {
            let (solid, kind) = (any_solid(random), random.below(3));
            let half = [0; 3].map(|_| random.between(0.1, 0.5));
            Part::mesh(triangles(&placed(&solid, half, &axes(kind, random), center)), albedo(random))
        } else {
            let kind = random.below(3);
            let [u, _, v] = axes(kind, random).map(|axis| axis.map(|x| x * random.between(0.3, 1.2)));
            let p = [0, 1, 2].map(|k| center[k] - 0.5 * (u[k] + v[k]));
            Part::mesh(quad(p, v, u), albedo(random))
        };
        // sometimes only some of the triangles of a body
        if random.one_in(4)
            && let Form::Mesh(triangles) = &mut part.form
            && triangles.len() > 1
        {
            let whole = triangles.split_off(1 + random.below(triangles.len() - 1));
            draft.parts.push(Part { form: Form::Mesh(whole), ..part.clone() });
        }
        if !random.one_in(5) {
            punch(&mut part, random);
        }
        draft.parts.push(part);
    }
    if random.one_in(3) {
        places::furnish(&mut draft, random);
    }
    draft
}

/// Changes what a mesh looks like.
type Dress = fn(&mut Part, &mut Random);

/// Dresses meshes, each of them once in so many times.
fn dressed(mut draft: Draft, how: &[(usize, Dress)], random: &mut Random) -> Draft {
    for part in meshes(&mut draft) {
        for (often, dress) in how {
            if random.one_in(*often) {
                dress(part, random);
            }
        }
    }
    draft
}

pub(crate) fn punched(random: &mut Random) -> Draft {
    dressed(plain(random), &[(2, punch)], random)
}

pub(crate) fn painted(random: &mut Random) -> Draft {
    dressed(apart(random), &[(1, paint)], random)
}

pub(crate) fn smooth(random: &mut Random) -> Draft {
    let mut draft = apart(random);
    meshes(&mut draft).filter(|_| random.one_in(6)).for_each(|part| part.finish = Finish::Mirror(0.8));
    dressed(draft, &[(1, bend)], random)
}

pub(crate) fn coated(random: &mut Random) -> Draft {
    let mut draft = places::bright(random);
    meshes(&mut draft).for_each(|part| coat(part, random));
    dressed(draft, &[(3, paint), (3, bend), (4, punch)], random)
}

pub(crate) fn everything(random: &mut Random) -> Draft {
    let mut draft = if random.one_in(2) {
        let mut draft = instanced(random);
        if random.one_in(2) {
            places::furnish(&mut draft, random);
        }
        draft
    } else {
        apart(random)
    };
    draft.is_shared = true;
    for part in meshes(&mut draft) {
        if part.copies.is_empty() && random.one_in(2) {
            replace(part, random);
        }
        if random.one_in(8) {
            part.finish = Finish::Mirror(0.8);
        }
    }
    dressed(draft, &[(3, punch), (2, paint), (3, bend)], random)
}
