//! Closed forms in double precision, for packets of single precision.

use crate::packet::{V8, X8, widen_points};
use etendue::f64x4;
use etendue::occlusion::{Convex, Occlusion, Polyhedron};
use std::ops::Range;

/// What closed forms in double precision need.
#[derive(Default)]
pub(super) struct Exact<'a> {
    /// Made when it is first needed.
    occlusion: Option<Box<Occlusion<f64x4>>>,
    pub(super) polyhedra: Vec<Polyhedron<'a, f64>>,
    pub(super) forms: Vec<Convex<f64>>,
}

impl Exact<'_> {
    /// As of [`Occlusion::visible_past`], for four lanes at a time.
    pub(super) fn visible_past(
        &mut self,
        point: V8,
        normal: V8,
        light: &Convex<f32>,
        forms: Range<usize>,
        bodies: Range<usize>,
    ) -> Option<X8> {
        let (light, forms, bodies) = (light.map(f64::from), &self.forms[forms], &self.polyhedra[bodies]);
        let occlusion = self.occlusion.get_or_insert_default();
        let mut visible = [0.0; 8];
        for (half, (point, normal)) in widen_points(point).into_iter().zip(widen_points(normal)).enumerate() {
            let part = occlusion.visible_past(point, normal, &light, forms, bodies)?.to_array();
            (0..4).for_each(|lane| visible[4 * half + lane] = part[lane] as f32);
        }
        Some(X8::from(visible))
    }
}
