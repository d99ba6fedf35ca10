//! The techniques for each kind of shape: those of the library, and textbook formulas.

use crate::pose::ShapeKind;
use etendue_judge::area_lights::{AreaLight, Measure};
use etendue_judge::lights::sampler::{Prepared, Sampler, Subject, technique};
use etendue_judge::textbook;

/// A technique.
pub struct Method {
    /// Short name.
    pub name: String,
    /// Whether it belongs to the library; otherwise it is a baseline.
    pub ours: bool,
    subject: Subject<'static>,
}

impl Method {
    /// Whether it is uniform over the area, with which others are compared.
    #[must_use]
    pub fn is_by_area(&self) -> bool {
        self.subject.by == Measure::Area
    }
    /// Prepares a light for the origin.
    #[must_use]
    pub fn prepare(&self, light: &AreaLight) -> Option<Box<dyn Sampler>> {
        match (self.subject.prepare)(light) {
            Prepared::Ready(sampler) => Some(sampler),
            Prepared::Nothing | Prepared::OutsideOfDomain => None,
        }
    }
}

/// The techniques for a kind of shape: by (projected) solid angle, then by area, then textbook formulas.
#[must_use]
pub fn methods(kind: ShapeKind) -> Vec<Method> {
    let (shape, by) = kind.light();
    let ours = [technique(shape, by), technique(shape, Measure::Area)];
    let textbooks = textbook::samplers().into_iter().filter(|subject| (subject.shape, subject.by) == (shape, by));
    let of = |(i, subject): (usize, Subject<'static>)| {
        // without whose it is
        let name = subject.name.split_once(' ').map_or("", |name| name.1);
        Method { name: name.into(), ours: i < 2, subject }
    };
    ours.into_iter().chain(textbooks).enumerate().map(of).collect()
}
