//! What geometry alone tells about the light that reaches part of a surface, without rays.
//!
//! A [`Patch`] bounds the shading points of a rectangle of pixels on one primitive. A [`Certifier`] searches the tree for what may meet
//! the shaft between a patch and a light: the segments from any shading point to any point of the light that is above its horizon. Bounds
//! are computed in double precision, and are wider than the rounding of shading points, of points on lights and of directions.
//!
//! A shaft is an intersection of half-spaces. Any half-space that contains patch and light contains the shaft, so that their choice
//! affects only how narrow it is.

use super::blockers::{Blocker, Candidate};
use super::bodies::Bodies;
use super::patch::Patch;
use super::precision::{Behind, Precision};
use super::shaft::{Facing, Form, Lamp, Shaft};
use crate::bvh::{Region, SHAPE};
use crate::occlusion::Occlusion;
use crate::surfaces::Surfaces;
use etendue::f64x8;

/// Greatest number of blockers in a certificate.
pub const MOST: usize = 16;
/// Greatest number of primitives that may meet a shaft, before triangles are merged.
const CANDIDATES: usize = 32;
/// Greatest number of nodes that a search visits.
const NODES: usize = 160;

/// What geometry alone tells about a light as seen from a patch.
#[derive(Clone, Copy, Debug)]
pub enum Certificate<'a> {
    /// Nothing lies between any point of the patch and any point of the light above its horizon. A closed form of this precision is accurate.
    Lit(Precision),
    /// No point of the light is visible from any point of the patch: something convex covers it, or it lies below the horizon, or its back
    /// faces the patch.
    Dark,
    /// Only these can occlude the light, at most [`MOST`]. A closed form of this precision is accurate.
    Blockers(&'a [Blocker], Precision),
    /// There are too many blockers, or nothing is proved.
    Unknown,
}

/// Certifies lights, with reused memory.
#[derive(Debug)]
pub struct Certifier<'a> {
    surfaces: &'a Surfaces,
    bodies: &'a Bodies,
    lamps: Vec<Option<Lamp>>,
    region: Region,
    shaft: Shaft,
    stack: Vec<u32>,
    candidates: Vec<Candidate>,
    /// Bodies that may meet the shaft, and whether they can stand for their triangles.
    met: Vec<(u32, bool)>,
    blockers: Vec<Blocker>,
    /// For lights without blockers.
    occlusion: Box<Occlusion<f64x8>>,
}

impl<'a> Certifier<'a> {
    /// For lights that are shapes of these indices. [`Surfaces::light_shapes`] lists all of them.
    pub fn new(surfaces: &'a Surfaces, bodies: &'a Bodies, lights: impl IntoIterator<Item = u32>) -> Self {
        let lamp = |index: u32| Lamp::new(surfaces.shapes().get(index as usize)?, index);
        Self {
            surfaces,
            bodies,
            lamps: lights.into_iter().map(lamp).collect(),
            region: Region::new(surfaces.bvh.reach()),
            shaft: Shaft::default(),
            stack: Vec::with_capacity(256),
            candidates: Vec::with_capacity(CANDIDATES),
            met: Vec::with_capacity(MOST),
            blockers: Vec::with_capacity(MOST),
            occlusion: Box::default(),
        }
    }
    /// What is known about a light, by its index in the list, as seen from a patch.
    pub fn certify(&mut self, patch: &Patch, light: usize) -> Certificate<'_> {
        let Some(Some(lamp)) = self.lamps.get(light) else { return Certificate::Unknown };
        if patch.place == lamp.shape | SHAPE {
            // a convex light is below the horizon of each of its own points
            return Certificate::Dark;
        }
        let Self { surfaces, bodies, region, shaft, stack, candidates, met, blockers, occlusion, .. } = self;
        match shaft.set(patch, lamp, surfaces.bvh.reach(), region) {
            Facing::Towards => {}
            Facing::Away => return Certificate::Dark,
            Facing::Unknown => return Certificate::Unknown,
        }
        candidates.clear();
        met.clear();
        let mut has_gaps = false;
        let complete = surfaces.bvh.search(region, stack, NODES, |place| {
            if place == patch.place || place == lamp.shape | SHAPE {
                return true;
            }
            let outline = Candidate::outline(surfaces, place);
            let candidate = Candidate::of(outline.convex());
            if candidate.misses(shaft, outline.is_exact()) {
                return true;
            }
            // what has holes, or is not all of its outline, may hide the light, or not
            if !outline.is_exact() || place & SHAPE == 0 && surfaces.bvh.is_cut_out(place) {
                has_gaps = true;
                return true;
            }
            if let Some(body) = bodies.of(place) {
                let known = met.iter().find(|met| met.0 == body).copied();
                let (_, serves) = known.unwrap_or_else(|| {
                    met.push((body, bodies.serves(body, patch.place, shaft)));
                    met[met.len() - 1]
                });
                if serves {
                    return true;
                }
            }
            candidates.push(candidate);
            candidates.len() < CANDIDATES
        });
        let complete = complete && !has_gaps;
        met.retain(|met| met.1);
        let mut precision = |behind: &Behind| {
            let form = surfaces.shapes()[lamp.shape as usize].geometry.outline().convex();
            Precision::of(patch, lamp, &form, behind, occlusion)
        };
        if complete && candidates.is_empty() && met.is_empty() {
            return Certificate::Lit(precision(&Behind::default()));
        }
        let is_ball = matches!(lamp.form, Form::Ball);
        if is_ball && candidates.iter().any(|candidate| candidate.touches(&shaft.light, shaft.epsilon)) {
            return Certificate::Unknown;
        }
        if met.iter().any(|met| bodies.covers(met.0, shaft)) {
            return Certificate::Dark;
        }
        if !complete {
            return if any_covers(candidates, shaft) { Certificate::Dark } else { Certificate::Unknown };
        }
        merge(candidates);
        if candidates.iter().any(|candidate| candidate.covers(shaft)) {
            return Certificate::Dark;
        }
        if candidates.len() + met.len() > MOST || !candidates.iter().all(|candidate| candidate.is_outside(shaft)) {
            return Certificate::Unknown;
        }
        blockers.clear();
        blockers.extend(met.iter().map(|met| Blocker::Body(met.0)));
        blockers.extend(candidates.iter().map(|candidate| candidate.blocker(shaft)));
        let behind = behind(candidates, met, bodies, patch);
        Certificate::Blockers(blockers, precision(&behind))
    }
}

/// What matters of these blockers for the precision of a closed form.
fn behind(candidates: &[Candidate], met: &[(u32, bool)], bodies: &Bodies, patch: &Patch) -> Behind {
    Behind {
        blockers: candidates.len() + met.len(),
        spheres: candidates.iter().filter(|candidate| matches!(candidate, Candidate::Ball(..))).count(),
        displacement: met.iter().map(|met| bodies.displacement(met.0, &patch.hull)).sum::<f64>()
            + candidates.iter().map(|candidate| candidate.displacement(&patch.hull)).sum::<f64>(),
        stretch: met.iter().map(|met| bodies.stretch(met.0, &patch.hull) - 1.0).sum::<f64>()
            + candidates.iter().map(|candidate| candidate.stretch(&patch.hull) - 1.0).sum::<f64>(),
        flush: candidates.iter().any(|candidate| candidate.is_flush(&patch.hull)),
    }
}

/// Does a candidate cover the light, alone or merged with another? Only those between the centres need to be tried.
fn any_covers(candidates: &[Candidate], shaft: &Shaft) -> bool {
    candidates.iter().filter(|candidate| candidate.is_central(shaft)).any(|candidate| {
        let merged = || candidates.iter().filter_map(|other| candidate.merged(other));
        candidate.covers(shaft) || merged().any(|merged| merged.covers(shaft))
    })
}

/// Merges pairs of triangles.
fn merge(candidates: &mut Vec<Candidate>) {
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
