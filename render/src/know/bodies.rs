//! Closed convex parts of meshes, such as boxes: each is one occluder instead of many triangles.

use crate::bvh::{Bvh, PrimitiveId};
use etendue::Vec3;
use etendue_visible::{Solid, V64};
use std::collections::HashMap;

/// Greatest number of triangles of a mesh that is searched for bodies. To search so many takes 15 ms in a height field, and 76 ms if all of
/// them are boxes.
const SEARCHED: usize = 65_536;
/// Greatest number of triangles of a body.
const TRIANGLES: usize = 28;

/// The bodies of a scene.
#[derive(Debug, Default)]
pub struct Bodies {
    /// Polyhedra.
    bodies: Vec<Solid>,
    /// The body of each triangle in tree order; empty without bodies.
    of_places: Vec<Option<u32>>,
}

impl Bodies {
    /// Finds the bodies among the triangles of a mesh that share corners, bit for bit. Finds none in large meshes.
    pub fn new(bvh: &Bvh) -> Self {
        let count = bvh.count();
        let mut found = Self::default();
        if count > SEARCHED {
            return found;
        }
        // triangles that are connected by common corners have the same root
        let mut roots: Vec<usize> = (0..count).collect();
        fn root(roots: &mut [usize], mut i: usize) -> usize {
            while roots[i] != i {
                roots[i] = roots[roots[i]];
                i = roots[i];
            }
            i
        }
        let mut first_with = HashMap::new();
        for place in 0..count {
            for corner in corners(bvh, place as u32) {
                // −0 is 0
                let bits = [corner.x, corner.y, corner.z].map(|x| (x + 0.0).to_bits());
                let other = *first_with.entry(bits).or_insert(place);
                let (a, b) = (root(&mut roots, place), root(&mut roots, other));
                roots[a] = b;
            }
        }
        let mut parts: HashMap<usize, Vec<u32>> = HashMap::new();
        for place in 0..count {
            parts.entry(root(&mut roots, place)).or_default().push(place as u32);
        }
        let mut parts: Vec<_> = parts.into_values().filter(|part| (4..=TRIANGLES).contains(&part.len())).collect();
        parts.sort_unstable();
        for part in parts {
            if part.iter().any(|&place| bvh.is_cut_out(PrimitiveId::of_triangle(place))) {
                continue;
            }
            let triangles: Vec<[V64; 3]> =
                part.iter().map(|&place| corners(bvh, place).map(|corner| corner.map(f64::from))).collect();
            if let Some(body) = Solid::polyhedron(&triangles) {
                found.of_places.resize(count, None);
                for place in part {
                    found.of_places[place as usize] = Some(found.bodies.len() as u32);
                }
                found.bodies.push(body);
            }
        }
        found
    }
    /// Index of the body to which a primitive belongs.
    pub fn of(&self, primitive: PrimitiveId) -> Option<u32> {
        *self.of_places.get(primitive.triangle()? as usize)?
    }
    /// The bodies.
    pub fn solids(&self) -> &[Solid] {
        &self.bodies
    }
}

fn corners(bvh: &Bvh, place: u32) -> [Vec3<f32>; 3] {
    let c = bvh.corners(PrimitiveId::of_triangle(place));
    [Vec3::new(c[0], c[1], c[2]), Vec3::new(c[3], c[4], c[5]), Vec3::new(c[6], c[7], c[8])]
}
