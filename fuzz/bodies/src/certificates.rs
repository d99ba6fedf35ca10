//! Small scenes on a lattice, so that their parts touch, coincide and are parallel, whose proofs must agree with single segments.

use etendue_oracle::{V3, along, cross, dot, length, sub, unit, wide};
use etendue_visible::{Lift, Light, MOST, Occluder, Patch, Proof, Prover, Pyramid, Solid, Viewer};

/// Reads bytes as numbers; zeros follow the last.
struct Input<'a> {
    bytes: std::slice::Iter<'a, u8>,
    scale: f32,
    shift: f32,
}

impl Input<'_> {
    fn byte(&mut self) -> u8 {
        self.bytes.next().copied().unwrap_or(0)
    }
    fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }
    /// A lattice point in [−4, 4)³.
    fn vector(&mut self) -> [f32; 3] {
        std::array::from_fn(|_| f32::from(self.byte() as i8) / 32.0 * self.scale)
    }
    fn point(&mut self) -> [f32; 3] {
        self.vector().map(|x| x + self.shift * self.scale)
    }
    fn triangle(&mut self) -> [[f32; 3]; 3] {
        [0; 3].map(|_| self.point())
    }
    fn radius(&mut self) -> f32 {
        f32::from(self.byte()) / 64.0 * self.scale
    }
    fn light(&mut self) -> Solid {
        match self.below(3) {
            0 => Solid::Sphere { center: wide(self.point()).into(), radius: self.radius().into() },
            1 => Solid::triangle(self.triangle().map(|corner| wide(corner).into())),
            _ => Solid::Parallelogram {
                corner: wide(self.point()).into(),
                edges: [self.vector(), self.vector()].map(|edge| wide(edge).into()),
            },
        }
    }
    /// No coordinate of a scene is greater: a corner and three edges.
    fn reach(&self) -> f64 {
        f64::from((16.0 + self.shift) * self.scale)
    }
}

/// Whether a segment meets a triangle by a clear margin, or misses it by one.
fn meets_triangle(p: V3, y: V3, corners: [V3; 3]) -> [bool; 2] {
    let [a, b, c] = corners;
    let (d, e1, e2, s) = (sub(y, p), sub(b, a), sub(c, a), sub(p, a));
    let normal = cross(e1, e2);
    let slope = -dot(normal, d);
    let crosses = slope.abs() > 1e-7 * length(normal) * length(d);
    if !crosses {
        return [false; 2];
    }
    let moment = cross(s, d);
    let (t, u, v) = (dot(normal, s) / slope, dot(e2, moment) / slope, -dot(e1, moment) / slope);
    let least = u.min(v).min(1.0 - u - v).min(t * 100.0).min((1.0 - 1.0 / 131_072.0 - t) * 100.0);
    [least > 1e-5, least < -1e-5]
}

fn meets_polygon(p: V3, y: V3, corners: &[V3]) -> [bool; 2] {
    let parts = (2..corners.len()).map(|k| meets_triangle(p, y, [corners[0], corners[k - 1], corners[k]]));
    parts.fold([false, true], |all, part| [all[0] | part[0], all[1] & part[1]])
}

fn meets_sphere(p: V3, y: V3, center: V3, radius: f64) -> [bool; 2] {
    let d = sub(y, p);
    let t = (dot(sub(center, p), d) / dot(d, d)).clamp(0.0, 1.0);
    let distance = |q: V3| length(sub(q, center)) / radius;
    let (least, most) = (distance(along(p, d, t)), distance(p).max(distance(y)));
    let clear = 1e-5 * (1.0 + most);
    [least < 1.0 - clear && most > 1.0 + clear, least > 1.0 + clear]
}

fn parallelogram(p: V3, u: V3, v: V3) -> [V3; 4] {
    [p, along(p, u, 1.0), along(along(p, u, 1.0), v, 1.0), along(p, v, 1.0)]
}

fn meets(p: V3, y: V3, solid: &Solid) -> [bool; 2] {
    match *solid {
        Solid::Sphere { center, radius } => meets_sphere(p, y, center.into(), radius),
        Solid::Parallelogram { corner, edges: [u, v] } => {
            meets_polygon(p, y, &parallelogram(corner.into(), u.into(), v.into()))
        }
        Solid::Polygon { corners, count, .. } => meets_polygon(p, y, &corners.map(V3::from)[..count]),
        Solid::Polyhedron(_) => unreachable!("polyhedra are met as their faces are"),
    }
}

/// May a solid hide y from p? `body` tells the triangles of a polyhedron.
fn is_listed<'a, I: Iterator<Item = &'a Solid>>(p: V3, y: V3, solids: &[Solid], body: impl Fn(&Solid) -> I) -> bool {
    solids.iter().any(|solid| match solid {
        Solid::Polyhedron(_) => body(solid).any(|t| !meets(p, y, t)[1]),
        solid => !meets(p, y, solid)[1],
    })
}

/// What the light of a small scene is, as the bytes say.
struct Given {
    light: Solid,
    two_sided: bool,
}

/// Any small scene has a proof for a light as seen from a triangle or from a sphere. No segment from there to the light contradicts it.
pub fn certificates(bytes: &[u8]) {
    let mut input = Input { bytes: bytes.iter(), scale: 1.0, shift: 0.0 };
    let kind = input.below(16);
    input.scale = [1.0, 1e-6, 1e6, 1.0, 1e-30, 1e15, 1.0, 0.01][kind % 8];
    input.shift = [0.0, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0, 0.0][kind % 8];
    let two_sided = input.below(2) == 0;
    let given = Given { light: input.light(), two_sided };
    let view = input.below(4);
    let origin = wide(input.point());
    let place = input.below(256);
    let receiver = input.triangle();
    // solids, each with the box whose face it is
    let mut solids: Vec<(Solid, Option<usize>)> = Vec::new();
    let mut boxes: Vec<Solid> = Vec::new();
    let triangle = |corners: [[f32; 3]; 3]| Solid::triangle(corners.map(|corner| wide(corner).into()));
    for _ in 0..input.below(24) {
        match input.below(8) {
            0 => {
                let sphere = Solid::Sphere { center: wide(input.point()).into(), radius: input.radius().into() };
                solids.push((sphere, None));
            }
            // two triangles of a quadrilateral
            1..4 => {
                let [p, u, v] = [input.point(), input.vector(), input.vector()];
                let add = |a: [f32; 3], b: [f32; 3]| std::array::from_fn(|k| a[k] + b[k]);
                solids.push((triangle([p, add(p, u), add(add(p, u), v)]), None));
                solids.push((triangle([p, add(add(p, u), v), add(p, v)]), None));
            }
            // a box, or one with a triangle missing
            4 | 5 => {
                let [p, u, v, w] = [input.point(), input.vector(), input.vector(), input.vector()];
                let corner = |k: usize| {
                    let side = |bit: usize, v: f32| if k >> bit & 1 == 0 { 0.0 } else { v };
                    std::array::from_fn(|axis| p[axis] + side(0, u[axis]) + side(1, v[axis]) + side(2, w[axis]))
                };
                let faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
                let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [c, d, a]]);
                let mut triangles: Vec<_> = triangles.map(|t: [usize; 3]| t.map(corner)).collect();
                if input.below(8) == 0 {
                    triangles.pop();
                }
                let exact: Vec<_> = triangles.iter().map(|t| t.map(|corner| wide(corner).into())).collect();
                let body = Solid::polyhedron(&exact).filter(|_| kind < 12);
                let index = body.map(|body| {
                    boxes.push(body);
                    boxes.len() - 1
                });
                solids.extend(triangles.into_iter().map(|t| (triangle(t), index)));
            }
            _ => solids.push((triangle(input.triangle()), None)),
        }
    }
    let [a, b, c] = receiver.map(wide);
    let target = along(along(a, sub(b, a), place as f64 / 512.0), sub(c, a), 0.25);
    let forward = unit(sub(target, origin));
    let right = unit(cross(forward, [0.3, 1.0, 0.2]));
    let up = cross(right, forward);
    if length(up) == 0.0 {
        return;
    }
    let ray = |[x, y]: [f64; 2]| along(along(forward, right, 0.05 * x), up, 0.05 * y).into();
    let pyramid = Pyramid::new(origin.into(), [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]].map(ray));
    let viewer = [Viewer::Pixels(&pyramid), Viewer::Pixels(&pyramid), Viewer::Front, Viewer::Back][view];
    let reach = input.reach();
    let lift = Lift { relative: 1.0 / 8_388_608.0, least: reach / (1_u64 << 44) as f64 };
    // the patch lies on the receiver, or on the last solid if that is a sphere
    let ball = match solids.last() {
        Some((Solid::Sphere { center, radius }, _)) if view == 2 => Some((*center, *radius)),
        _ => None,
    };
    let patch = match ball {
        Some((center, radius)) => {
            solids.pop();
            solids.push((triangle(receiver), None));
            Patch::sphere(center, radius, viewer, lift)
        }
        None => Patch::triangle(receiver.map(|corner| wide(corner).into()), viewer, lift),
    };
    let (Some(patch), Some(light)) = (patch, Light::new(given.light.clone(), two_sided)) else { return };
    let mut prover = Prover::new(reach);
    let seen = prover.prove(&patch, &light, |_, found| {
        solids.iter().all(|(solid, of)| {
            found(match of {
                Some(of) => Occluder::Face(solid.clone(), &boxes[*of]),
                None => Occluder::Whole(solid.clone()),
            })
        })
    });
    let proof = seen.proof;
    if let Proof::Behind(solids) = proof {
        assert!((1..=MOST).contains(&solids.len()));
    }
    let of_body = |body: &Solid| {
        let index = boxes.iter().position(|other| other == body);
        solids.iter().filter(move |(_, of)| of.is_some() && *of == index).map(|(triangle, _)| triangle)
    };
    let corners: Vec<V3> = patch.corners().collect();
    for _ in 0..24 {
        let mut mix = || [0.0, 1.0, 0.5, 0.25, 0.9, 0.01][input.below(6)];
        let (p, normal) = match (patch.normal(), ball) {
            (Some(normal), _) => {
                let (s, t) = (mix(), mix());
                let at = |k: usize| corners[k % corners.len()];
                let k = input.below(8);
                let edge = along(at(k), sub(at(k + 1), at(k)), s);
                (along(along(edge, sub(at(k + 2), edge), t), normal, patch.margin() / 4.0), normal)
            }
            (None, Some((center, radius))) => {
                let normal = unit(along([mix(), mix(), mix()], [0.5; 3], -1.0));
                (along(center.into(), normal, radius + patch.margin() / 8.0), normal)
            }
            (None, None) => return,
        };
        let (s, t) = ([0.0, 1.0, 0.5, 0.3][input.below(4)], [0.0, 1.0, 0.5, 0.3][input.below(4)]);
        let (y, outward) = match given.light {
            Solid::Sphere { center, radius } => {
                let center = V3::from(center);
                let axis = unit(sub(p, center));
                let across = unit(cross(axis, wide(input.vector())));
                if across == [0.0; 3] {
                    continue;
                }
                let sin = 0.99 * s;
                let cos = f64::sqrt(1.0 - sin * sin);
                let y = along(along(center, axis, radius * cos), across, radius * sin);
                (y, sub(y, center))
            }
            Solid::Parallelogram { corner, edges: [u, v] } => {
                (along(along(corner.into(), u.into(), s), v.into(), t), cross(u.into(), v.into()))
            }
            Solid::Polygon { corners, .. } => {
                let [a, b, c, _] = corners.map(V3::from);
                (along(along(a, sub(b, a), s * (1.0 - t)), sub(c, a), t), cross(sub(b, a), sub(c, a)))
            }
            Solid::Polyhedron(_) => return,
        };
        let away = sub(p, y);
        let is_sphere = given.light.is_sphere();
        if !(dot(normal, away) < 0.0 && (dot(outward, away) > 0.0 || given.two_sided && !is_sphere)) {
            continue;
        }
        let all = solids.iter().map(|(solid, _)| meets(p, y, solid));
        let [met, missed] = all.fold([false, true], |all, one| [all[0] | one[0], all[1] & one[1]]);
        match proof {
            Proof::Lit => assert!(!met, "{p:?} → {y:?} is occluded, but lit"),
            Proof::Dark => assert!(!missed, "{p:?} → {y:?} is visible, but dark"),
            Proof::Behind(solids) => {
                assert!(!met || is_listed(p, y, solids, of_body), "{p:?} → {y:?} is occluded by none of {solids:?}");
            }
            Proof::Open => {}
        }
    }
}
