//! Forms that scenes are built from.

use super::draft::{Draft, Form, Look, Map, Part, V3};
use crate::random::Random;
use etendue_oracle::{along, basis, cross, dot, length, sub, unit};

/// The corners of a triangle.
pub(crate) type Triangle = [V3; 3];
/// A convex polyhedron: the corners of each face in order around, as seen from outside.
pub(crate) type Solid = Vec<Vec<V3>>;

/// The parallelogram p + s u + t v in two triangles, with the normal u × v.
pub(crate) fn quad(p: V3, u: V3, v: V3) -> Vec<Triangle> {
    let (a, b) = (along(p, u, 1.0), along(p, v, 1.0));
    let c = along(a, v, 1.0);
    vec![[p, a, c], [p, c, b]]
}

/// The square |x|, |z| ≤ `half` at the height `y`, with its normal upwards.
pub(crate) fn level(y: f64, half: f64) -> Vec<Triangle> {
    quad([-half, y, -half], [0.0, 0.0, 2.0 * half], [2.0 * half, 0.0, 0.0])
}

/// The box [−1, 1]³.
pub(crate) fn cube() -> Solid {
    let face = |axis: usize, side: f64| {
        let corner = |a: f64, b: f64| {
            let mut v = [0.0; 3];
            (v[axis], v[(axis + 1) % 3], v[(axis + 2) % 3]) = (side, a, b);
            v
        };
        vec![corner(-side, -1.0), corner(side, -1.0), corner(side, 1.0), corner(-side, 1.0)]
    };
    (0..3).flat_map(|axis| [face(axis, -1.0), face(axis, 1.0)]).collect()
}

/// A prism over a regular polygon of n corners, along y.
pub(crate) fn prism(n: usize) -> Solid {
    let corner = |k: usize, y: f64| {
        let angle = (k % n) as f64 / n as f64 * std::f64::consts::TAU;
        [libm::cos(angle), y, libm::sin(angle)]
    };
    let side = |k| vec![corner(k, -1.0), corner(k, 1.0), corner(k + 1, 1.0), corner(k + 1, -1.0)];
    let mut faces: Solid = (0..n).map(side).collect();
    faces.push((0..n).map(|k| corner(k, -1.0)).collect());
    faces.push((0..n).rev().map(|k| corner(k, 1.0)).collect());
    faces
}

/// A tetrahedron with its corners at four of those of the cube.
pub(crate) fn tetrahedron() -> Solid {
    let [a, b, c, d] = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    vec![vec![a, b, c], vec![a, d, b], vec![a, c, d], vec![b, d, c]]
}

/// The part of a solid with normal · x ≤ `most`.
pub(crate) fn cut(solid: &Solid, normal: V3, most: f64) -> Solid {
    let mut faces = Solid::new();
    let mut edge: Vec<V3> = Vec::new();
    for face in solid {
        let mut left = Vec::new();
        for (i, &a) in face.iter().enumerate() {
            let b = face[(i + 1) % face.len()];
            let [ha, hb] = [a, b].map(|v| dot(v, normal) - most);
            if ha <= 0.0 {
                left.push(a);
            }
            if (ha < 0.0) != (hb < 0.0) && ha != 0.0 && hb != 0.0 {
                // the same point for both faces of the edge
                let ([a, b], [ha, hb]) = if ha < hb { ([a, b], [ha, hb]) } else { ([b, a], [hb, ha]) };
                let point = along(a, sub(b, a), ha / (ha - hb));
                left.push(point);
                if !edge.contains(&point) {
                    edge.push(point);
                }
            }
        }
        if left.len() > 2 {
            faces.push(left);
        }
    }
    if edge.len() > 2 {
        let middle = edge.iter().fold([0.0; 3], |sum, v| along(sum, *v, 1.0 / edge.len() as f64));
        let (s, t) = basis(unit(normal));
        let angle = |v: &V3| libm::atan2(dot(sub(*v, middle), t), dot(sub(*v, middle), s));
        edge.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        faces.push(edge);
    }
    faces
}

/// Three orthonormal axes: those of the world, turned about the vertical, or turned anyhow.
pub(crate) fn axes(kind: usize, random: &mut Random) -> [V3; 3] {
    match kind {
        0 => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        1 => {
            let angle = random.between(0.0, std::f64::consts::TAU);
            let (s, c) = (libm::sin(angle), libm::cos(angle));
            [[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]]
        }
        _ => {
            let a = unit(random.point());
            let b = unit(cross(a, random.point()));
            [a, b, cross(a, b)]
        }
    }
}

/// A solid with these half sizes along its axes and this centre.
pub(crate) fn placed(solid: &Solid, half: V3, axes: &[V3; 3], center: V3) -> Solid {
    let place = |v: V3| (0..3).fold(center, |sum, k| along(sum, axes[k], v[k] * half[k]));
    solid.iter().map(|face| face.iter().map(|v| place(*v)).collect()).collect()
}

/// The map of a point to `center` plus its coordinates, times these factors, along the axes.
pub(crate) fn map(axes: &[V3; 3], factors: V3, center: V3) -> Map {
    let row = |k: usize| [0, 1, 2].map(|axis| axes[axis][k] * factors[axis]);
    [0, 1, 2].map(|k| {
        let [a, b, c] = row(k);
        [a, b, c, center[k]]
    })
}

/// First one map, then the other.
pub(crate) fn then(first: &Map, second: &Map) -> Map {
    second.map(|row| {
        let shift = |axis: usize| if axis == 3 { row[3] } else { 0.0 };
        [0, 1, 2, 3].map(|axis| shift(axis) + (0..3).map(|k| row[k] * first[k][axis]).sum::<f64>())
    })
}

/// The triangles of a solid; those without an area in f32 are left out.
pub(crate) fn triangles(solid: &Solid) -> Vec<Triangle> {
    let fan = |face: &Vec<V3>| (2..face.len()).map(|k| [face[0], face[k - 1], face[k]]).collect::<Vec<_>>();
    solid.iter().flat_map(fan).filter(has_area).collect()
}

/// Whether a triangle has an area in f32.
pub(crate) fn has_area(triangle: &Triangle) -> bool {
    let [a, b, c] = triangle.map(|v| v.map(|x| f64::from(x as f32)));
    cross(sub(b, a), sub(c, a)) != [0.0; 3]
}

/// A solid of a random kind.
pub(crate) fn any_solid(random: &mut Random) -> Solid {
    match random.below(6) {
        0 => tetrahedron(),
        1 => prism(3),
        2 => prism(6),
        _ => cube(),
    }
}

/// A random albedo.
pub(crate) fn albedo(random: &mut Random) -> f32 {
    random.of(&[0.3, 0.5, 0.7, 0.9])
}

/// A floor of this half size at height 0.
pub(crate) fn floor(half: f64, random: &mut Random) -> Part {
    Part::mesh(level(0.0, half), albedo(random))
}

/// A rectangle centred at `center` and turned towards `target`, of this size.
pub(crate) fn facing(center: V3, target: V3, [width, height]: [f64; 2], random: &mut Random) -> Form {
    let normal = unit(sub(target, center));
    let (s, t) = basis(normal);
    let angle = random.between(0.0, std::f64::consts::TAU);
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    let u = along(s.map(|x| x * cos), t, sin);
    let v = cross(normal, u);
    let p = along(along(center, u, -0.5 * width), v, -0.5 * height);
    Form::Parallelogram(p, u.map(|x| x * width), v.map(|x| x * height))
}

/// The radiance of a light that gives about 1 of irradiance to a surface of this distance.
pub(crate) fn radiance(form: &Form, distance: f64) -> f32 {
    let area = match form {
        Form::Mesh(triangles) => {
            triangles.iter().map(|[a, b, c]| 0.5 * length(cross(sub(*b, *a), sub(*c, *a)))).sum::<f64>()
        }
        Form::Sphere(_, radius) => std::f64::consts::PI * radius * radius,
        Form::Parallelogram(_, u, v) => length(cross(*u, *v)),
    };
    (distance * distance / area) as f32
}

/// A light of a random form at `center`, which faces `target` if it is flat, with this size and about 1 of irradiance there.
pub(crate) fn lamp(center: V3, target: V3, size: f64, random: &mut Random) -> Part {
    let distance = length(sub(target, center));
    let form = match random.below(5) {
        0 | 1 => Form::Sphere(center, 0.5 * size),
        2 => {
            let Form::Parallelogram(p, u, v) = facing(center, target, [size; 2], random) else { unreachable!() };
            Form::Mesh(vec![[p, along(p, u, 1.0), along(p, v, random.between(0.5, 1.0))]])
        }
        _ => facing(center, target, [size, size * random.between(0.3, 1.0)], random),
    };
    let radiance = radiance(&form, distance);
    Part::light(form, radiance, random.one_in(6))
}

/// A place above the floor, within a cone about the vertical, at this distance from the origin.
pub(crate) fn overhead(distance: f64, random: &mut Random) -> V3 {
    let (x, z) = (random.between(-0.7, 0.7), random.between(-0.7, 0.7));
    unit([x, 1.0, z]).map(|x| x * distance)
}

/// A camera at this distance that looks at a place from above, or at a part of it: images of few pixels have pixels as small as usual
/// only if they show little, and what is known of a light depends on the size of pixels.
pub(crate) fn look(place: V3, distance: f64, random: &mut Random) -> Look {
    let is_close = !random.one_in(4);
    let aside = if is_close { 0.3 * distance } else { 0.0 };
    let target = [0, 1, 2].map(|k| place[k] + [1.0, 0.1, 1.0][k] * aside * random.between(-0.6, 0.6));
    let angle = random.between(0.0, std::f64::consts::TAU);
    let height = random.between(0.35, 1.6);
    let towards = unit([libm::cos(angle), height, libm::sin(angle)]);
    // as the renderer keeps it
    let eye = along(target, towards, distance).map(|x| f64::from(x as f32));
    Look {
        eye,
        target,
        up: [0.0, 1.0, 0.0],
        fov: if is_close { random.power(0.3, 1.4) } else { random.between(25.0, 50.0) },
        lens: None,
        frame: None,
    }
}

/// A floor, one light above it and a camera; parts are added by the regimes.
pub(crate) fn stage(random: &mut Random) -> Draft {
    let distance = random.between(2.0, 5.0);
    let center = overhead(distance, random);
    let size = random.between(0.3, 2.0);
    let look = look([0.0, 0.3, 0.0], random.between(3.0, 5.0), random);
    let parts = vec![floor(2.0, random), lamp(center, [0.0; 3], size, random)];
    Draft::new(String::new(), look, parts)
}

/// Whether a light appears so small in the image that some images have a sample of it and others have not.
pub(crate) fn has_speck(draft: &Draft) -> bool {
    let Look { eye, target, fov, lens, .. } = &draft.look;
    let axis = unit(sub(*target, *eye));
    let half = 0.75 * fov.to_radians();
    draft.parts.iter().any(|part| {
        let Some(glow) = part.glow else { return false };
        let (center, size, normal) = match &part.form {
            Form::Sphere(center, radius) => (*center, *radius, None),
            Form::Parallelogram(p, u, v) => {
                (along(along(*p, *u, 0.5), *v, 0.5), 0.5 * length(*u).min(length(*v)), Some(cross(*u, *v)))
            }
            Form::Mesh(all) => {
                let [a, b, c] = all[0];
                let (u, v) = (sub(b, a), sub(c, a));
                (along(along(a, u, 0.33), v, 0.33), 0.25 * length(u).min(length(v)), Some(cross(u, v)))
            }
        };
        let to = sub(center, *eye);
        let is_seen = glow.two_sided || normal.is_none_or(|n| dot(n, to) < 0.0);
        let distance = length(to);
        let angle = libm::acos((dot(to, axis) / distance).clamp(-1.0, 1.0));
        let around = (size / distance).min(1.0).asin() + if lens.is_some() { 0.2 } else { 0.0 };
        is_seen && angle < half + around && size / distance < 0.12 * half
    })
}
