//! The estimator of a technique: with or without closed forms around samples.

use super::world::World;
use crate::camera::Camera;
use crate::certify::Analytic;
use crate::estimate::{Estimator, Group, Plain, Reflected, Sampled, Tracer};
use crate::settings::Settings;

/// What the technique of an image does at shading points.
pub(super) enum OfTechnique<'a> {
    Sampled(Sampled),
    Analytic(Box<Analytic<'a, Sampled>>),
}

impl<'a> OfTechnique<'a> {
    pub(super) fn new(World { scene, certifiable, .. }: &'a World, settings: &Settings, camera: &Camera) -> Self {
        let Settings { technique, .. } = *settings;
        if technique.is_analytic(scene.has_closed_forms(settings.choice)) {
            let sampled = Sampled::new(technique, scene.surfaces.has_rough());
            Self::Analytic(Box::new(Analytic::new(scene, certifiable, camera, settings, sampled)))
        } else {
            Self::Sampled(Sampled::new(technique, false))
        }
    }
    /// The closed forms, if there are any.
    pub(super) fn analytic(&mut self) -> Option<&mut Analytic<'a, Sampled>> {
        if let Self::Analytic(analytic) = self { Some(analytic) } else { None }
    }
    /// Whether certificates are asked for in this tile.
    pub(super) fn asks(&self) -> bool {
        matches!(self, Self::Analytic(analytic) if analytic.asks())
    }
    /// Whether certificates are asked for, and all lights were known at the places of the tile that were looked at first.
    pub(super) fn knows_all(&self) -> bool {
        matches!(self, Self::Analytic(analytic) if analytic.knows_all())
    }
    /// Whether a sample needs a pair of numbers for the surface besides that for the light.
    pub(super) const fn is_combined(&self) -> bool {
        match self {
            Self::Sampled(sampled) => sampled.is_combined(),
            Self::Analytic(analytic) => analytic.inner().is_combined(),
        }
    }
    /// Radiance that a group of shading points reflects towards the camera rays.
    pub(super) fn reflected(&mut self, group: &Group<'_>, tracer: &mut Tracer) -> Reflected {
        let mut reflected = Reflected::default();
        // what a scene does not need is not compiled in
        match (self, group.scene.surfaces.is_plain) {
            (Self::Sampled(sampled), true) => sampled.add::<false>(group, &Plain, tracer, &mut reflected),
            (Self::Sampled(sampled), false) => sampled.add::<true>(group, &Plain, tracer, &mut reflected),
            (Self::Analytic(analytic), true) => analytic.add::<false>(group, &Plain, tracer, &mut reflected),
            (Self::Analytic(analytic), false) => analytic.add::<true>(group, &Plain, tracer, &mut reflected),
        }
        reflected
    }
}
