//! Polyhedra of triangles, and what is none.

use etendue::Vec3;
use etendue_visible::{Edge, Light, Occluder, Occlusion, Patch, Polyhedron, Prover, Solid, V64};
use std::sync::Arc;

type Triangle = [[f32; 3]; 3];

fn exact(triangles: &[Triangle]) -> Vec<[V64; 3]> {
    triangles.iter().map(|triangle| triangle.map(|corner| corner.map(f64::from).into())).collect()
}
fn found(triangles: &[Triangle]) -> Option<Polyhedron> {
    Polyhedron::new(&exact(triangles))
}
fn faces(corners: &[[f32; 3]], faces: &[&[usize]]) -> Vec<Triangle> {
    let fan = |face: &&[usize]| {
        (2..face.len()).map(|k| [face[0], face[k - 1], face[k]].map(|i| corners[i])).collect::<Vec<_>>()
    };
    faces.iter().flat_map(fan).collect()
}
/// A box, turned unless its sides are to be axis-aligned.
fn block(low: [f32; 3], high: [f32; 3], turned: bool) -> Vec<Triangle> {
    let corner = |k: usize| {
        let [x, y, z] = [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
        if turned { [0.8 * x - 0.6 * z, y + 0.3 * x, 0.6 * x + 0.8 * z] } else { [x, y, z] }
    };
    let corners: Vec<_> = (0..8).map(corner).collect();
    faces(&corners, &[&[0, 1, 3, 2], &[4, 5, 7, 6], &[0, 1, 5, 4], &[2, 3, 7, 6], &[0, 2, 6, 4], &[1, 3, 7, 5]])
}
/// A prism over a regular polygon.
fn prism(n: usize) -> Vec<Triangle> {
    let corner = |k: usize| {
        let (sin, cos) = etendue::Real::sin_cos_turns((k % n) as f32 / n as f32);
        [cos, if k < n { 0.0 } else { 1.0 }, sin]
    };
    let corners: Vec<_> = (0..2 * n).map(corner).collect();
    let sides: Vec<_> = (0..n).map(|k| vec![k, (k + 1) % n, n + (k + 1) % n, n + k]).collect();
    let ends = [(0..n).collect::<Vec<_>>(), (n..2 * n).collect()];
    faces(&corners, &sides.iter().chain(&ends).map(Vec::as_slice).collect::<Vec<_>>())
}
/// Asserts that all triangles form one polyhedron with so many faces and edges.
fn assert_found(triangles: &[Triangle], faces: usize, edges: usize) {
    let body = found(triangles).expect("a polyhedron");
    assert_eq!((body.faces().len(), body.edges().len()), (faces, edges));
    for &[normal, on] in body.faces() {
        assert!((on - body.center()).dot(normal) > 0.0 && (normal.length() - 1.0).abs() < 1e-6);
    }
    for Edge { ends, faces: [i, j] } in body.edges() {
        for (end, [normal, on]) in ends.iter().flat_map(|end| [(end, body.faces()[*i]), (end, body.faces()[*j])]) {
            assert!((*end - on).dot(normal).abs() < 1e-5);
        }
    }
}

/// Boxes are found in any order and orientation of their triangles and corners.
#[test]
fn boxes_are_polyhedra() {
    for turned in [false, true] {
        let mut triangles = block([1.0, -2.0, 0.5], [2.0, 3.0, 0.75], turned);
        let mut state = 1_usize;
        for _ in 0..200 {
            for k in (1..12).rev() {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                triangles.swap(k, (state >> 33) % (k + 1));
                triangles[k].rotate_left((state >> 40) % 3);
                if state >> 50 & 1 == 1 {
                    triangles[k].swap(0, 1);
                }
            }
            assert_found(&triangles, 6, 12);
        }
    }
    assert_found(&block([-1.0; 3], [-0.0, 1.0, 1e-4], true), 6, 12);
}

/// A box whose corner at the origin is cut off.
fn chamfered(cut: f32, side: f32, shift: [f32; 3]) -> Vec<Triangle> {
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { 0.0 } else { side });
    let mut corners: Vec<_> = (0..8).map(corner).collect();
    corners.extend([[cut, 0.0, 0.0], [0.0, cut, 0.0], [0.0, 0.0, cut]]);
    let corners: Vec<_> = corners.iter().map(|p| [0, 1, 2].map(|k| p[k] + shift[k])).collect();
    let sides: [&[usize]; 7] = [
        &[8, 1, 3, 2, 9],
        &[9, 2, 6, 4, 10],
        &[10, 4, 5, 1, 8],
        &[4, 5, 7, 6],
        &[2, 6, 7, 3],
        &[1, 3, 7, 5],
        &[8, 9, 10],
    ];
    faces(&corners, &sides)
}

/// However little of a corner is cut off, or however thin a box is, a polyhedron hides as much as its triangles do.
#[test]
fn narrow_faces_do_not_displace_outlines() {
    let square = [[-0.5, 9.0, -0.5], [0.5, 9.0, -0.5], [0.5, 9.0, 0.5], [-0.5, 9.0, 0.5]];
    let light = Solid::quadrilateral(square.map(V64::from));
    let up = Vec3::<f32>::new(0.0, 1.0, 0.0);
    let lift = |t: &Triangle| t.map(|[x, y, z]| [x, y + 5.0, z]);
    let cuts = [3e-7, 1e-6, 1e-5, 1e-3].map(|cut| (cut, chamfered(cut, 1.8, [-0.9, 5.1, -0.9])));
    let sheets = [1e-5, 1e-4, 1e-2].map(|thick| {
        let sheet = block([-0.9, 0.0, -0.9], [0.9, thick, 0.9], true);
        (thick, sheet.iter().map(lift).collect())
    });
    let (mut compared, mut greatest) = (0, 0.0_f64);
    for (size, triangles) in cuts.into_iter().chain(sheets) {
        let Some(body) = found(&triangles) else { continue };
        let ends = body.edges().iter().flat_map(|edge| edge.ends);
        let extent = ends.map(|end| (end - body.center()).length()).fold(0.0, f64::max);
        let (center, deviation) = (body.center(), body.deviation());
        let body = Solid::Polyhedron(Arc::new(body));
        let sides: Vec<Solid> = exact(&triangles).into_iter().map(Solid::triangle).collect();
        for k in 0..400 {
            let point = Vec3::<f32>::new((k % 20) as f32 * 0.4 - 3.9, 0.0, (k / 20) as f32 * 0.4 - 4.1);
            // the angle by which its outline may be displaced
            let displacement = deviation / ((center - point.map(f64::from)).length() - extent).max(0.0);
            let single = Occlusion::<f32>::new().visible(point, up, &light, std::slice::from_ref(&body));
            let (p, n) = (point.map(f64::from), up.map(f64::from));
            let all = Occlusion::<f64>::new().visible(p, n, &light, &[]).unwrap();
            let truth = Occlusion::<f64>::new().visible(p, n, &light, &sides);
            let (Some(single), Some(truth)) = (single, truth) else { continue };
            // 4/9 radian around the light
            let allowed = 4.0 / 9.0 * (2e-7 + displacement);
            let error = (f64::from(single) - truth).abs();
            assert!(error < allowed, "{size}, {point:?}: {single} instead of {truth} of {all}");
            greatest = greatest.max(displacement);
            compared += 1;
        }
    }
    assert!(compared > 2000 && greatest < 1e-6, "{compared}, {greatest:e}");
}

/// The triangles of what the corners of a polyhedron hide from a point, on a plane across the direction `along`.
fn shadow(body: &Polyhedron, point: V64, along: V64, [s, t]: [V64; 2]) -> Vec<Solid> {
    let project = |v: V64| {
        let v = v - point;
        let scale = 2.0 / v.dot(along);
        [s.dot(v) * scale, t.dot(v) * scale]
    };
    let mut corners: Vec<_> = body.edges().iter().flat_map(|edge| edge.ends).map(project).collect();
    corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
    // both chains of the convex hull (Andrew 1979)
    let turns = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut hull: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while hull.len() > 1 && turns(hull[hull.len() - 2], hull[hull.len() - 1], p) <= 0.0 {
                hull.pop();
            }
            hull.push(p);
        }
        hull.pop();
        hull
    };
    let hull = [chain(&mut corners.iter().copied()), chain(&mut corners.iter().rev().copied())].concat();
    let at = |k: usize| point + along * 2.0 + s * hull[k][0] + t * hull[k][1];
    (2..hull.len()).map(|k| Solid::triangle([at(0), at(k - 1), at(k)])).collect()
}

/// Near the line of an edge, between it and the plane of a face that does not quite contain it, the outline of a polyhedron is displaced by far
/// more than the rounding of its corners: then no error is stated.
#[test]
fn outlines_seen_along_an_edge_have_the_error_that_is_stated() {
    let (mut counts, mut greatest) = ([0; 2], 0.0_f64);
    for k in 0..60 {
        let [x, y, z] = [0.3 + 0.037 * k as f32, 0.2 + 0.011 * k as f32, 0.5 - 0.007 * k as f32];
        let wide = 0.01 + 0.002 * (k % 20) as f32;
        let along_axes = block([x, y, z], [x + wide, y + 0.2, z + 1.3 * wide], false);
        let turn =
            |[x, y, z]: [f32; 3]| [0.36 * x + 0.48 * y - 0.8 * z, -0.8 * x + 0.6 * y, 0.48 * x + 0.64 * y + 0.6 * z];
        let Some(body) = found(&along_axes.iter().map(|t| t.map(turn)).collect::<Vec<_>>()) else { continue };
        let solid = Solid::Polyhedron(Arc::new(body.clone()));
        let long = body.edges().iter().filter(|edge| (edge.ends[1] - edge.ends[0]).length() > 0.1);
        for (edge, face) in long.flat_map(|edge| edge.faces.map(|face| (edge, face))) {
            let ([a, b], [normal, on]) = (edge.ends, body.faces()[face]);
            let (along, normal) = ((b - a).normalize(), normal.normalize());
            let across = along.cross(normal);
            let square = |at: V64, half: f64| {
                [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]]
                    .map(|[s, t]| at + across * (half * s) + normal * (half * t))
            };
            let light = square(b + along * 0.7, 0.1).map(|p| p.map(|x| f64::from(x as f32)));
            let light = Light::new(Solid::quadrilateral(light), true).unwrap();
            for beside in [-3e-3, -8e-4, 8e-4, 3e-3] {
                // between the line of the edge and the plane
                let line = a - along * 2.0;
                let point = line - normal * (0.5 * normal.dot(line - on)) + across * beside;
                let patch = Patch::polygon(&square(point, 1e-3), 1e-9, 0.0).unwrap();
                let mut prover = Prover::new(30.0);
                let mut seen = prover.prove(&patch, &light, |_, found| found(Occluder::Whole(solid.clone())));
                let value = seen.irradiance(point, along).unwrap();
                let truth = shadow(&body, point, along, [across, normal]);
                let truth = Occlusion::<f64>::new().visible(point, along, light.solid(), &truth).unwrap();
                counts[usize::from(value.error.is_some())] += 1;
                greatest = greatest.max(value.error.map_or(0.0, |error| (value.value - truth).abs() / error));
            }
        }
    }
    println!("{counts:?}, at most {greatest:.2} of the error that is stated");
    assert!(counts.iter().all(|&count| count > 500) && greatest < 1.0);
}

#[test]
fn other_solids_are_polyhedra() {
    let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]];
    assert_found(&faces(&corners, &[&[0, 1, 2], &[0, 1, 3], &[1, 2, 3], &[0, 2, 3]]), 4, 6);
    for n in 3..=8 {
        assert_found(&prism(n), n + 2, 3 * n);
    }
}

#[test]
fn other_meshes_are_no_polyhedra() {
    let unit = block([0.0; 3], [1.0; 3], false);
    let with = |more: &[Triangle]| [&unit, more].concat();
    let moved = |from: [f32; 3], to: [f32; 3]| {
        let place = |v: [f32; 3]| if v == from { to } else { v };
        unit.iter().map(|t| t.map(place)).collect::<Vec<_>>()
    };
    for missing in 0..12 {
        let open: Vec<_> = (0..12).filter(|&k| k != missing).map(|k| unit[k]).collect();
        assert!(found(&open).is_none(), "without triangle {missing}");
    }
    let quad = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, z]| [x, 1.0, z]);
    let tent = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.5, 1.0, 0.0], [0.5, 1.0, 1.0]];
    let ridge = [0.5, 1.0, 0.5];
    let not = [
        ("a triangle twice", with(&unit[3..4])),
        ("all triangles twice", with(&unit)),
        ("a triangle turned and twice", with(&[[unit[3][1], unit[3][0], unit[3][2]]])),
        ("a dent", moved([1.0; 3], [0.5; 3])),
        ("a face with a valley", moved([1.0; 3], [1.0, 0.999_99, 1.0])),
        ("boxes that share a corner", with(&block([1.0; 3], [2.0; 3], false))),
        ("boxes that share an edge", with(&block([1.0, 1.0, 0.0], [2.0, 2.0, 1.0], false))),
        ("boxes that share a face", with(&block([1.0, 0.0, 0.0], [2.0, 1.0, 1.0], false))),
        ("a triangle at a corner", with(&[[[1.0; 3], [2.0; 3], [2.0, 1.0, 2.0]]])),
        ("a cell within, at a corner", with(&block([0.0; 3], [0.5; 3], false))),
        ("a flat box", block([0.0; 3], [1.0, 0.0, 1.0], false)),
        ("a box thinner than its rounding", block([0.0, 1.0, 0.0], [1.0, 1.000_000_5, 1.0], false)),
        ("a quadrilateral cut both ways", faces(&quad, &[&[0, 1, 2, 3], &[1, 2, 3, 0]])),
        ("15 sides and two ends", prism(15)),
        ("a degenerate triangle", with(&[[unit[0][0], unit[0][1], unit[0][1]]])),
        // two sheets that both cover two sides of a roof, one with a corner on the ridge
        (
            "a folded sheet",
            [
                faces(&tent, &[&[0, 2, 5, 4], &[1, 3, 5, 4]]),
                [[0, 2], [1, 3]]
                    .map(|[i, k]| [tent[i], tent[k], ridge])
                    .into_iter()
                    .chain([[0, 4], [2, 5], [1, 4], [3, 5]].map(|[i, k]| [tent[i], tent[k], ridge]))
                    .collect(),
            ]
            .concat(),
        ),
    ];
    for (what, triangles) in not {
        assert!(found(&triangles).is_none(), "{what}");
    }
    assert_found(&unit, 6, 12);
    assert_found(&moved([1.0; 3], [1.0, 1.01, 1.0]), 7, 13);
    assert_found(&moved([1.0; 3], [1.0, 0.999_999_9, 1.0]), 6, 12);
}
