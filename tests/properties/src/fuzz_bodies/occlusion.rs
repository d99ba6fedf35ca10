//! The body of the target of visible parts.

use super::{Input, scalable};
use crate::occlusion::Scene;
use etendue::occlusion::Convex;

fn shape(input: &mut Input<'_>, before: &mut Vec<[f32; 3]>) -> Convex<f32> {
    let mut vector = |input: &mut Input<'_>| {
        let v = input.vector(before);
        before.push(v);
        v.into()
    };
    if input.below(3) == 0 {
        let center = vector(input);
        return Convex::Sphere { center, radius: input.number() };
    }
    let count = 3 + usize::from(input.below(2));
    if input.below(4) == 0 {
        // flat for certain: a corner and two edges
        let [p, u, v] = [(); 3].map(|()| vector(input));
        if input.below(2) == 0 {
            return Convex::Parallelogram { corner: p, edges: [u, v] };
        }
        return Convex::Polygon { corners: [p, p + u, p + u + v, p + v].map(finite), count };
    }
    Convex::Polygon { corners: [(); 4].map(|()| vector(input)), count }
}

fn finite(v: etendue::Vec3<f32>) -> etendue::Vec3<f32> {
    if v.max_abs() <= f32::MAX { v } else { etendue::Vec3::default() }
}

/// Lights behind blockers.
pub(super) fn occlusion(input: &mut Input<'_>) {
    // the points first, so that shapes can have them as corners
    let mut before = Vec::new();
    let points: [[f32; 3]; 8] = core::array::from_fn(|_| {
        let p = input.vector(&before);
        before.push(p);
        p
    });
    let normals = core::array::from_fn(|_| input.direction());
    let light = shape(input, &mut before);
    let count = input.below(18) % (1 + input.below(17));
    let blockers = (0..count).map(|_| shape(input, &mut before)).collect();
    let scene = Scene { light, blockers, solids: Vec::new(), points, normals };
    scene.total();
    scene.lanes();
    let mut lengths: Vec<f32> = points.iter().flatten().copied().collect();
    for shape in scene.blockers.iter().chain([&scene.light]) {
        match shape {
            Convex::Polygon { corners, .. } => lengths.extend(corners.iter().flat_map(|c| [c.x, c.y, c.z])),
            Convex::Parallelogram { corner, edges: [u, v] } => {
                lengths.extend([corner, u, v].iter().flat_map(|c| [c.x, c.y, c.z]));
            }
            Convex::Sphere { center, radius } => lengths.extend([center.x, center.y, center.z, *radius]),
        }
    }
    // products of up to four lengths neither overflow nor underflow
    if scalable(&lengths, 1e3) {
        scene.scale(12);
        scene.scale(-12);
    }
}
