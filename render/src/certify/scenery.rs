//! What may occlude lights.

use super::blockers::Blocker;
use super::bodies::Bodies;
use crate::occlusion::{Convex, Polyhedron};
use std::ops::Range;

/// What may occlude lights, in single and in double precision.
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
