//! What is proved of the lights of a scene, as its parts see them: the prover of `etendue-visible`, with this renderer's tree and shapes.

use super::bodies::Bodies;
use crate::bvh::{PrimitiveId, Region};
use crate::geometry::{Geometry, LEAST, LIFT};
use crate::surfaces::Surfaces;
use etendue_visible::{Lift, Light, Occluder, Patch, Precision, Proof, Prover, Solid, Viewer};

/// Greatest number of nodes that a search visits.
const NODES: usize = 160;

/// Certifies lights, with reused memory.
#[derive(Debug)]
pub struct Certifier<'a> {
    surfaces: &'a Surfaces,
    bodies: &'a Bodies,
    /// Each with the index of its shape.
    lights: Vec<Option<(u32, Light)>>,
    region: Region,
    stack: Vec<u32>,
    prover: Prover,
    /// [`RayCount::proofs`](crate::bvh::RayCount::proofs) and `met` since the last look.
    pub(super) count: [u64; 2],
}

/// The part of a primitive that a viewer sees, regardless of occlusion. `None` if there is no such part,
/// and for what is not supported: shapes but spheres, spheres from inside, triangles without area, and triangles seen edge-on.
pub fn patch(surfaces: &Surfaces, primitive: PrimitiveId, viewer: Viewer<'_>) -> Option<Patch> {
    let lift = Lift { relative: LIFT, least: LEAST * f64::from(surfaces.bvh.reach_of_points()) };
    match outline(surfaces, primitive) {
        Occluder::Whole(Solid::Sphere { center, radius }) => Patch::sphere(center, radius, viewer, lift),
        Occluder::Whole(Solid::Polygon { corners: [a, b, c, _], .. }) if primitive.triangle().is_some() => {
            Patch::triangle([a, b, c], viewer, lift)
        }
        _ => None,
    }
}

/// What a primitive is, or is within.
fn outline(surfaces: &Surfaces, primitive: PrimitiveId) -> Occluder<'static> {
    if let Some(shape) = primitive.shape() {
        return surfaces.shapes()[shape].geometry.outline();
    }
    let c = surfaces.bvh.corners(primitive);
    Geometry::Triangle([[c[0], c[1], c[2]], [c[3], c[4], c[5]], [c[6], c[7], c[8]]]).outline()
}

impl<'a> Certifier<'a> {
    /// For lights that are shapes of these indices. [`Surfaces::light_shapes`] lists all of them.
    pub fn new(surfaces: &'a Surfaces, bodies: &'a Bodies, lights: impl IntoIterator<Item = u32>) -> Self {
        let light = |shape: u32| {
            let of = surfaces.shapes().get(shape as usize)?;
            Some((shape, Light::new(of.geometry.outline().solid(), of.emission?.two_sided)?))
        };
        let reach = surfaces.bvh.reach();
        Self {
            surfaces,
            bodies,
            lights: lights.into_iter().map(light).collect(),
            region: Region::new(reach),
            stack: Vec::with_capacity(256),
            prover: Prover::new(reach.into()),
            count: [0; 2],
        }
    }
    /// What is proved of a light, by its index in the list, as seen from a patch of a primitive, and in which precision its
    /// closed form is accurate.
    pub fn certify(&mut self, primitive: PrimitiveId, patch: &Patch, light: usize) -> (Proof<'_>, Precision) {
        let Self { surfaces, bodies, lights, region, stack, prover, count } = self;
        count[0] += 1;
        let Some(Some((shape, light))) = lights.get(light) else { return (Proof::Open, Precision::default()) };
        let own = [primitive, PrimitiveId::of_shape(*shape)];
        if own[0] == own[1] {
            // a convex light is below the horizon of each of its own points
            return (Proof::Dark, Precision::default());
        }
        let own_body = bodies.of(primitive);
        let seen = prover.prove(patch, light, |within, found| {
            region.clear();
            within.half_spaces().iter().for_each(|&(normal, limit)| region.push(normal.into(), limit));
            let (mut left, mut met) = (NODES, 0);
            let complete = surfaces.bvh.search(region, stack, &mut left, |primitive| {
                met += 1;
                if own.contains(&primitive) {
                    return true;
                }
                found(match outline(surfaces, primitive) {
                    Occluder::Whole(solid) if primitive.triangle().is_some() && surfaces.bvh.is_cut_out(primitive) => {
                        Occluder::Within(solid)
                    }
                    Occluder::Whole(solid) => match bodies.of(primitive).filter(|&body| own_body != Some(body)) {
                        Some(body) => Occluder::Face(solid, &bodies.solids()[body as usize]),
                        None => Occluder::Whole(solid),
                    },
                    other => other,
                })
            });
            count[1] += (NODES - left + met) as u64;
            complete
        });
        (seen.proof, seen.precision)
    }
}
