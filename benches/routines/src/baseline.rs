//! The baseline for the renderer's traversal: obvhs, ray by ray.

use obvhs::cwbvh::{CwBvh, builder::build_cwbvh_from_tris};
use obvhs::ray::{Ray, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::{BvhBuildParams, triangle::Triangle};
use std::time::Duration;

/// A compressed wide BVH (CWBVH) of obvhs over triangles.
pub struct Baseline {
    tree: CwBvh,
    triangles: Vec<RtTriangle>,
}

/// A ray of obvhs, prepared in advance.
pub type BaselineRay = Ray;

/// A ray of unit `direction` up to `limit`. Components of −0 become 0, because obvhs would miss everything with them.
#[must_use]
pub fn ray(origin: [f32; 3], direction: [f32; 3], limit: f32) -> BaselineRay {
    Ray::new(origin.into(), direction.map(|x| x + 0.0).into(), 0.0, limit)
}

impl Baseline {
    /// Builds with obvhs's medium settings.
    #[must_use]
    pub fn new(triangles: &[[[f32; 3]; 3]]) -> Self {
        let triangles: Vec<_> =
            triangles.iter().map(|&[a, b, c]| Triangle { v0: a.into(), v1: b.into(), v2: c.into() }).collect();
        let tree = build_cwbvh_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Duration::default());
        let triangles = tree.primitive_indices.iter().map(|&i| (&triangles[i as usize]).into()).collect();
        Self { tree, triangles }
    }
    /// Distance of the closest hit.
    #[must_use]
    pub fn closest(&self, ray: BaselineRay) -> Option<f32> {
        let mut hit = RayHit::none();
        self.tree.ray_traverse(ray, &mut hit, |ray, i| self.triangles[i].intersect(ray)).then_some(hit.t)
    }
    /// Whether the ray hits anything.
    #[must_use]
    pub fn occluded(&self, ray: BaselineRay) -> bool {
        !self.tree.ray_traverse_miss(ray, |ray, i| self.triangles[i].intersect(ray))
    }
}
