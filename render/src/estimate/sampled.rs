//! Lights and surfaces sampled one after the other, as a technique does.

use super::by_light::ByLight;
use super::by_surface::BySurface;
use super::group::{Estimator, Group, Reflected, TileEstimator};
use super::integrand::{Integrand, Plain};
use super::mis::Mis;
use super::tracer::Tracer;
use super::which_light::Which;
use crate::technique::Technique;
use etendue::estimate::Heuristic;

/// Samples lights, surfaces or both, as a technique does.
pub(crate) struct Sampled {
    by_light: ByLight,
    by_surface: BySurface,
    mis: Option<Mis>,
    finds_lights: bool,
}

impl Sampled {
    /// The estimator of a technique. `only_rough` surfaces combine lights and BSDF, where the technique itself does not.
    pub(crate) fn new(technique: Technique, only_rough: bool) -> Self {
        let heuristic = if only_rough { Some(Heuristic::POWER) } else { technique.heuristic() };
        let by_lobes = technique.samples_lobes();
        let mis = heuristic.map(|heuristic| Mis { heuristic, only_rough, by_lobes });
        Self {
            by_light: ByLight { measure: technique.measure(), mis },
            by_surface: BySurface { technique, mis },
            mis,
            finds_lights: technique.finds_lights(),
        }
    }
}

impl TileEstimator for Sampled {
    fn is_combined(&self) -> bool {
        self.mis.is_some()
    }
    fn reflected(&mut self, group: &Group<'_>, tracer: &mut Tracer) -> Reflected {
        self.estimate(group, &Plain, tracer)
    }
}

impl<I: Integrand> Estimator<I> for Sampled {
    fn add<const GENERAL: bool>(
        &mut self,
        group: &Group<'_>,
        integrand: &I,
        tracer: &mut Tracer,
        Reflected { sampled, .. }: &mut Reflected,
    ) {
        if let Some(each) = group.chooser.each() {
            for light in 0..each {
                self.by_light.add::<GENERAL, _>(&Which::One(light), group, integrand, tracer, sampled);
            }
        } else if !integrand.is_empty() {
            self.by_light.add::<GENERAL, _>(&Which::Chosen, group, integrand, tracer, sampled);
            if let Some(sun) = group.scene.sky.as_ref().filter(|_| !self.finds_lights).and_then(|sky| sky.sun_beside())
            {
                self.by_light.add_sun::<GENERAL, _>(sun, group, integrand, tracer, sampled);
            }
        }
        let pairs = if self.finds_lights { Some(&group.numbers.light) } else { group.numbers.surface.as_ref() };
        if let Some(pairs) = pairs {
            self.by_surface.add::<GENERAL, _>(pairs, group, integrand, tracer, sampled);
        }
    }
}
