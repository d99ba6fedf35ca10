//! Closed forms of the visible part of a light, in single and in double precision, for packets of single precision.

use super::blockers::Blocker;
use super::bodies::Bodies;
use super::visible::Visible;
use crate::packet::{V8, X8, widen, widen_points};
use etendue::f64x8;
use etendue::occlusion::{Convex, Occlusion, Polyhedron};
use etendue::reflection::Reflection;
use std::ops::Range;

/// What may occlude lights, in both precisions.
#[derive(Default)]
pub(super) struct Scenery<'a> {
    pub(super) forms: Vec<Convex<f32>>,
    pub(super) bodies: Vec<Polyhedron<'a, f32>>,
    pub(super) exact_forms: Vec<Convex<f64>>,
    pub(super) exact_bodies: Vec<Polyhedron<'a, f64>>,
}

/// Those of a [`Scenery`] that may occlude one light.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Blocking {
    pub(super) forms: Range<usize>,
    pub(super) bodies: Range<usize>,
}

impl Blocking {
    /// Nothing occludes the light.
    pub(super) const NONE: Self = Self { forms: 0..0, bodies: 0..0 };

    /// Their number.
    pub(super) fn count(&self) -> usize {
        self.forms.len() + self.bodies.len()
    }
}

impl<'a> Scenery<'a> {
    pub(super) fn clear(&mut self) {
        self.forms.clear();
        self.bodies.clear();
        self.exact_forms.clear();
        self.exact_bodies.clear();
    }
    /// Adds the blockers of a light.
    pub(super) fn push(&mut self, blockers: &[Blocker], bodies: &'a Bodies) -> Blocking {
        let (first_form, first_body) = (self.forms.len(), self.bodies.len());
        for blocker in blockers {
            match *blocker {
                Blocker::Convex { form, .. } => {
                    self.forms.push(form);
                    self.exact_forms.push(form.map(f64::from));
                }
                Blocker::Body(body) => {
                    self.bodies.push(bodies.polyhedron(body));
                    self.exact_bodies.push(bodies.exact_polyhedron(body));
                }
            }
        }
        Blocking { forms: first_form..self.forms.len(), bodies: first_body..self.bodies.len() }
    }
    /// What may occlude a light.
    pub(super) fn of(&self, blocking: &Blocking) -> (&[Convex<f32>], &[Polyhedron<'a, f32>]) {
        (&self.forms[blocking.forms.clone()], &self.bodies[blocking.bodies.clone()])
    }
}

/// Computes closed forms, and holds the memory for it.
#[derive(Default)]
pub(super) struct ClosedForms {
    pub(super) visible: Visible,
    /// Made when it is first needed.
    exact: Option<Box<Occlusion<f64x8>>>,
}

impl ClosedForms {
    /// As of [`Occlusion::visible_past`], or with a lobe of [`Occlusion::reflected`], in single precision.
    pub(super) fn part(
        &mut self,
        point: V8,
        normal: V8,
        lobe: Option<&Reflection<X8>>,
        light: &Convex<f32>,
        (forms, bodies): (&[Convex<f32>], &[Polyhedron<'_, f32>]),
    ) -> Option<X8> {
        let occlusion = &mut self.visible.one;
        match lobe {
            Some(lobe) => occlusion.reflected(point, normal, lobe, light, forms, bodies),
            None => occlusion.visible_past(point, normal, light, forms, bodies),
        }
    }
    /// The same in double precision.
    pub(super) fn exact_part(
        &mut self,
        point: V8,
        normal: V8,
        lobe: Option<&Reflection<X8>>,
        light: &Convex<f32>,
        (scenery, blocking): (&Scenery<'_>, &Blocking),
    ) -> Option<X8> {
        let light = light.map(f64::from);
        let forms = &scenery.exact_forms[blocking.forms.clone()];
        let bodies = &scenery.exact_bodies[blocking.bodies.clone()];
        let occlusion = self.exact.get_or_insert_default();
        let (point, normal) = (widen_points(point), widen_points(normal));
        let visible = match lobe {
            Some(lobe) => occlusion.reflected(point, normal, &lobe.map(widen), &light, forms, bodies)?,
            None => occlusion.visible_past(point, normal, &light, forms, bodies)?,
        };
        Some(X8::from(visible.to_array().map(|part| part as f32)))
    }
}
