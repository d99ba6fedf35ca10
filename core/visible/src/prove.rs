//! Proves what hides a light from a patch.

use crate::hull::V64;
use crate::light::Light;
use crate::measure::Occlusion;
use crate::patch::Patch;
use crate::precision::{ALLOWED, Behind, FAINT, Precision};
use crate::shaft::{Facing, Region, Shaft};
use crate::solid::Solid;
use alloc::boxed::Box;
use alloc::vec::Vec;
use etendue::f64x8;

/// Greatest number of solids behind which a light is.
pub const MOST: usize = 16;
/// Greatest number of shapes that may meet a shaft, before triangles are merged.
const CANDIDATES: usize = 32;

/// What a search finds in a region.
#[derive(Clone, Debug)]
pub enum Occluder<'a> {
    /// All of this shape.
    Whole(Solid),
    /// All of this face of a polyhedron, whose other faces are found, too, where they meet the region. The polyhedron is the same in memory
    /// for all of its faces.
    Face(Solid, &'a Solid),
    /// Something in this shape, which may be less than all of it: a cut-out, or another form in its bounds.
    Within(Solid),
}

impl Occluder<'_> {
    /// The shape, or what it is within.
    #[must_use]
    pub fn solid(self) -> Solid {
        let (Self::Whole(solid) | Self::Face(solid, _) | Self::Within(solid)) = self;
        solid
    }
    /// Whether this is all of the shape, and nothing else.
    #[must_use]
    pub const fn is_exact(&self) -> bool {
        !matches!(self, Self::Within(_))
    }
}

/// What is proved of a light, as seen from a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Proof<'a> {
    /// Nothing lies between any point of the patch and any point of the light above its horizon.
    Lit,
    /// No point of the light is visible from any point of the patch: a flat shape or a polyhedron covers it, or it lies below the horizon, or
    /// its back faces the patch.
    Dark,
    /// Only these can hide the light, at least 1 and at most [`MOST`]; polyhedra first.
    Behind(&'a [Solid]),
    /// Nothing is proved, or there is too much between them.
    Open,
}

/// What a patch sees of a light.
#[derive(Debug)]
pub struct Seen<'a> {
    /// What is proved.
    pub proof: Proof<'a>,
    /// In which precision the closed form of a light is accurate that is lit, or behind something.
    pub precision: Precision,
    light: &'a Light,
    /// The greatest projected solid angle of the light without occluders, at the corners and the centre of the patch.
    most: f64,
    occlusion: &'a mut Occlusion<f64>,
}

/// The irradiance of a point by a light of radiance 1: the projected solid angle of what is visible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Irradiance {
    /// In \[0, π\]; times a radiance in W/(m² sr), it is in W/m².
    pub value: f64,
    /// Its greatest error, where that is known.
    pub error: Option<f64>,
}

impl Seen<'_> {
    /// The irradiance of a point of the patch, on a surface with this unit normal, by a light of radiance 1, in double precision. `None` if
    /// nothing is proved, or if what hides the light has no closed form (see [`Occlusion::visible`]): then it must be sampled.
    pub fn irradiance(&mut self, point: V64, normal: V64) -> Option<Irradiance> {
        let solids = match self.proof {
            Proof::Lit => &[][..],
            Proof::Dark => return Some(Irradiance { value: 0.0, error: Some(0.0) }),
            Proof::Behind(solids) => solids,
            Proof::Open => return None,
        };
        let value = self.occlusion.visible(point, normal, &self.light.solid, solids)?;
        if self.precision == Precision::Neither {
            return Some(Irradiance { value, error: None });
        }
        let all = match solids {
            [] => value,
            _ => self.occlusion.visible(point, normal, &self.light.solid, &[])?,
        };
        Some(Irradiance { value, error: Some(ALLOWED * all.max(FAINT * self.most)) })
    }
}

/// Proves what hides lights, with reused memory: one for each thread.
#[derive(Debug)]
pub struct Prover {
    /// Greatest magnitude of a coordinate of the scene.
    reach: f64,
    shaft: Shaft,
    candidates: Vec<Solid>,
    /// Polyhedra that may meet the shaft, and whether they can stand for their faces.
    met: Vec<(Solid, bool)>,
    solids: Vec<Solid>,
    /// For lights without occluders.
    eight: Box<Occlusion<f64x8>>,
    one: Box<Occlusion<f64>>,
}

impl Prover {
    /// For a scene whose coordinates have magnitudes up to `reach`, in scene units.
    #[must_use]
    pub fn new(reach: f64) -> Self {
        let (candidates, met, solids) = (Vec::new(), Vec::new(), Vec::new());
        Self { reach, shaft: Shaft::default(), candidates, met, solids, eight: Box::default(), one: Box::default() }
    }

    /// What is known about a light as seen from a patch.
    ///
    /// `search` is called at most once, and must call its second argument with everything that may meet the region, but for what the patch
    /// lies on, if that is convex, and for the light itself. More than what meets it does no harm. It may stop when that returns false, or
    /// when it has visited more than is worth it, and returns whether it was completed.
    pub fn prove<'a>(
        &'a mut self,
        patch: &Patch,
        light: &'a Light,
        search: impl FnOnce(Region<'_>, &mut dyn FnMut(Occluder<'_>) -> bool) -> bool,
    ) -> Seen<'a> {
        let (proof, precision, most) = self.find(patch, light, search);
        let proof = if proof == Proof::Behind(&[]) { Proof::Behind(&self.solids) } else { proof };
        Seen { proof, precision, light, most, occlusion: &mut self.one }
    }

    /// What is proved, behind no solids yet; in which precision the closed form is accurate, and the greatest of the light without occluders.
    fn find(
        &mut self,
        patch: &Patch,
        light: &Light,
        search: impl FnOnce(Region<'_>, &mut dyn FnMut(Occluder<'_>) -> bool) -> bool,
    ) -> (Proof<'static>, Precision, f64) {
        let known = |proof: Proof<'static>| (proof, Precision::default(), 0.0);
        let Self { shaft, candidates, met, solids, eight, .. } = self;
        match shaft.set(patch, light, self.reach) {
            Facing::Towards => {}
            Facing::Away => return known(Proof::Dark),
            Facing::Unknown => return known(Proof::Open),
        }
        candidates.clear();
        met.clear();
        let mut has_gaps = false;
        let complete = search(shaft.region(), &mut |occluder| {
            let (Occluder::Whole(solid) | Occluder::Face(solid, _) | Occluder::Within(solid)) = &occluder;
            if solid.misses(shaft) {
                return true;
            }
            let mut serves = |solid: &Solid| {
                let Solid::Polyhedron(body) = solid else { return false };
                let known = met.iter().find(|met| met.0.is_same(solid)).map(|met| met.1);
                known.unwrap_or_else(|| {
                    met.push((solid.clone(), body.serves(shaft)));
                    met[met.len() - 1].1
                })
            };
            match occluder {
                Occluder::Face(_, body) if serves(body) => true,
                Occluder::Whole(solid @ Solid::Polyhedron(_)) => {
                    has_gaps |= !serves(&solid);
                    true
                }
                // what has holes, or is not all of its outline, may hide the light, or not
                Occluder::Within(_) => {
                    has_gaps = true;
                    true
                }
                Occluder::Whole(solid) | Occluder::Face(solid, _) => {
                    candidates.push(solid);
                    candidates.len() < CANDIDATES
                }
            }
        });
        let complete = complete && !has_gaps;
        met.retain(|met| met.1);
        if complete && candidates.is_empty() && met.is_empty() {
            let (precision, most) = Precision::of(patch, light, &Behind::default(), eight);
            return (Proof::Lit, precision, most);
        }
        if light.plane.is_none() && candidates.iter().any(|candidate| candidate.touches(&shaft.light, shaft.epsilon)) {
            return known(Proof::Open);
        }
        if met.iter().any(|met| met.0.covers(shaft)) {
            return known(Proof::Dark);
        }
        merge(candidates);
        if candidates.iter().any(|candidate| candidate.covers(shaft)) {
            return known(Proof::Dark);
        }
        let are_few = complete && candidates.len() + met.len() <= MOST;
        if !are_few || !candidates.iter().all(|candidate| candidate.is_outside(shaft)) {
            return known(Proof::Open);
        }
        solids.clear();
        solids.extend(met.drain(..).map(|met| met.0));
        solids.append(candidates);
        let (precision, most) = Precision::of(patch, light, &behind(solids, patch), eight);
        (Proof::Behind(&[]), precision, most)
    }
}

/// What matters of these solids for the precision of a closed form.
fn behind(solids: &[Solid], patch: &Patch) -> Behind {
    let sum = |of: &dyn Fn(&Solid) -> f64| {
        // bodies and all others apart
        let first = solids.iter().take_while(|solid| matches!(solid, Solid::Polyhedron(_))).count();
        solids[..first].iter().map(of).sum::<f64>() + solids[first..].iter().map(of).sum::<f64>()
    };
    Behind {
        occluders: solids.len(),
        spheres: solids.iter().filter(|solid| solid.is_sphere()).count(),
        displacement: sum(&|solid| solid.displacement(&patch.hull)),
        stretch: sum(&|solid| solid.stretch(&patch.hull) - 1.0),
        flush: solids.iter().any(|solid| solid.is_flush(&patch.hull)),
    }
}

/// Merges pairs of triangles.
fn merge(candidates: &mut Vec<Solid>) {
    let mut i = 0;
    while i < candidates.len() {
        let found = (i + 1..candidates.len()).find_map(|k| Some((k, candidates[i].merged(&candidates[k])?)));
        if let Some((k, merged)) = found {
            candidates[i] = merged;
            candidates.swap_remove(k);
        }
        i += 1;
    }
}
