//! What convex occluders leave of a light.

use etendue::reflection::Reflection;
use etendue::{Vec3, f32x8};
use etendue_judge::fuzz_bodies::{Input, scalable};
use etendue_judge::occlusion::Scene;
use etendue_judge::packets::vectors_of;
use etendue_visible::{Occlusion, Solid, V64};
use std::f32::consts::PI;

fn shape(input: &mut Input<'_>, before: &mut Vec<[f32; 3]>) -> Solid {
    let mut vector = |input: &mut Input<'_>| {
        let v = input.vector(before);
        before.push(v);
        Vec3::<f32>::from(v)
    };
    let exact = |v: Vec3<f32>| v.map(f64::from);
    if input.below(3) == 0 {
        let center = exact(vector(input));
        return Solid::Sphere { center, radius: input.number().into() };
    }
    let count = 3 + usize::from(input.below(2));
    if input.below(4) == 0 {
        // flat for certain: a corner and two edges
        let [p, u, v] = [(); 3].map(|()| vector(input));
        if input.below(2) == 0 {
            return Solid::Parallelogram { corner: exact(p), edges: [u, v].map(exact) };
        }
        let corners = [p, p + u, p + u + v, p + v].map(|v| exact(finite(v)));
        return Solid::Polygon { corners, count, deviation: 0.0 };
    }
    Solid::Polygon { corners: [(); 4].map(|()| exact(vector(input))), count, deviation: 0.0 }
}

fn finite(v: Vec3<f32>) -> Vec3<f32> {
    if v.max_abs() <= f32::MAX { v } else { Vec3::default() }
}

/// Lights behind occluders, also as a rough surface reflects them.
pub fn occlusion(bytes: &[u8]) {
    let input = &mut Input::new(bytes);
    // the points first, so that shapes can have them as corners
    let mut before = Vec::new();
    let points: [[f32; 3]; 8] = std::array::from_fn(|_| {
        let p = input.vector(&before);
        before.push(p);
        p
    });
    let normals = std::array::from_fn(|_| input.direction());
    let light = shape(input, &mut before);
    let count = input.below(18) % (1 + input.below(17));
    let occluders = (0..count).map(|_| shape(input, &mut before)).collect();
    let scene = Scene { light, occluders, points, normals };
    scene.total();
    scene.lanes();
    let mut lengths: Vec<f32> = points.iter().flatten().copied().collect();
    let mut all: Vec<V64> = Vec::new();
    for shape in scene.occluders.iter().chain([&scene.light]) {
        match shape {
            Solid::Polygon { corners, .. } => all.extend(corners),
            Solid::Parallelogram { corner, edges: [u, v] } => all.extend([corner, u, v]),
            Solid::Sphere { center, radius } => all.extend([*center, V64::new(*radius, 0.0, 0.0)]),
            Solid::Polyhedron(_) => {}
        }
    }
    lengths.extend(all.into_iter().flat_map(|v| [v.x, v.y, v.z].map(|x| x as f32)));
    // products of up to four lengths neither overflow nor underflow
    if scalable(&lengths, 1e3) {
        scene.scale(12);
        scene.scale(-12);
    }
    reflected(input, &scene);
}

/// The same by the lobe of a surface of any roughness, seen from anywhere.
fn reflected(input: &mut Input<'_>, scene: &Scene) {
    let alpha = if input.below(2) == 0 { input.number() } else { input.unit() };
    let view = if input.below(8) == 0 { input.vector(&[]) } else { input.direction() };
    let [p, n] = [&scene.points, &scene.normals].map(|v| vectors_of::<f32x8>(|i| v[i]));
    let lobe = Reflection::new(f32x8::splat(alpha), n, vectors_of(|_| view));
    let mut occlusion = Occlusion::new();
    let [left, all] = [&scene.occluders[..], &[]]
        .map(|occluders| occlusion.reflected(p, n, &lobe, &scene.light, occluders).map(f32x8::to_array));
    let all = all.expect("there are no occluders");
    assert!(all.iter().all(|all| (0.0..=PI).contains(all)), "{all:?}");
    if let Some(left) = left {
        assert!(left.iter().zip(all).all(|(left, all)| (0.0..=all).contains(left)), "{left:?} of {all:?}");
    }
}
