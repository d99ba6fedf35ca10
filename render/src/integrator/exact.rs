//! Closed forms in double precision, for packets of single precision.

use crate::packet::{V8, X8, widen, widen_points};
use etendue::f64x8;
use etendue::occlusion::{Convex, Occlusion, Polyhedron};
use etendue::reflection::Reflection;
use std::ops::Range;

/// What closed forms in double precision need.
#[derive(Default)]
pub(super) struct Exact<'a> {
    /// Made when it is first needed.
    occlusion: Option<Box<Occlusion<f64x8>>>,
    pub(super) polyhedra: Vec<Polyhedron<'a, f64>>,
    pub(super) forms: Vec<Convex<f64>>,
}

impl Exact<'_> {
    /// As of [`Occlusion::visible_past`], or with a lobe of [`Occlusion::reflected`], in double precision.
    pub(super) fn visible_past(
        &mut self,
        point: V8,
        normal: V8,
        lobe: Option<&Reflection<X8>>,
        light: &Convex<f32>,
        forms: Range<usize>,
        bodies: Range<usize>,
    ) -> Option<X8> {
        let (light, forms, bodies) = (light.map(f64::from), &self.forms[forms], &self.polyhedra[bodies]);
        let occlusion = self.occlusion.get_or_insert_default();
        let (point, normal) = (widen_points(point), widen_points(normal));
        let visible = match lobe {
            Some(lobe) => occlusion.reflected(point, normal, &lobe.map(widen), &light, forms, bodies)?,
            None => occlusion.visible_past(point, normal, &light, forms, bodies)?,
        };
        Some(X8::from(visible.to_array().map(|part| part as f32)))
    }
}
