//! Closed convex parts of meshes.

use etendue_render::bvh::{Bvh, PrimitiveId, ShapeSet};
use etendue_render::know::Bodies;

/// A box, by its triangles.
fn block(low: [f32; 3], high: [f32; 3]) -> Vec<[[f32; 3]; 3]> {
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c].map(corner), [a, c, d].map(corner)]).collect()
}

/// Bodies are found among other triangles, and next to each other.
#[test]
fn bodies_are_told_apart() {
    let mut triangles = block([0.0; 3], [1.0; 3]);
    triangles.extend(block([1.0, 0.125, 0.25], [2.0, 0.5, 0.75]));
    triangles.push([[-9.0, 0.0, -9.0], [9.0, 0.0, -9.0], [0.0, 0.0, 9.0]]);
    let bvh = Bvh::new(&triangles, ShapeSet::new(std::iter::empty()).unwrap()).unwrap();
    let found = Bodies::new(&bvh);
    assert_eq!(found.solids().len(), 2);
    let of = |id: u32| {
        let place = bvh.order().iter().position(|&other| other == id).unwrap();
        found.of(PrimitiveId::of_triangle(place as u32))
    };
    assert!((0..12).all(|id| of(id) == of(0)) && (12..24).all(|id| of(id) == of(12)));
    assert!(of(0).is_some() && of(12).is_some() && of(0) != of(12) && of(24).is_none());
    assert_eq!(found.of(PrimitiveId::of_shape(0)), None);
}
