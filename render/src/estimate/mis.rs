//! Lights and surfaces sampled one after the other, and how their samples are weighted if both are.

use super::by_light::ByLight;
use super::by_surface::BySurface;
use super::choice::Which;
use super::group::{Estimator, Group, Reflected};
use super::integrand::Integrand;
use super::tracer::Tracer;
use crate::packet::{M8, X8, select};
use crate::prepared::PreparedScene;
use crate::technique::Technique;
use etendue::Real;
use etendue::estimate::{Heuristic, technique_pdf};

/// How samples of a light and of the BSDF are weighted (Veach 1997, chapter 9).
#[derive(Clone, Copy)]
pub(super) struct Mis {
    heuristic: Heuristic,
    /// Whether rough surfaces alone are sampled both ways.
    only_rough: bool,
    /// Whether spheres that rough metals reflect are sampled by the lobe of the metal alone.
    pub(super) by_lobes: bool,
}

impl Mis {
    /// The weight of a direction to a light, with its pdf and the pdf with which the surface draws it: 1 for delta lights, where the light
    /// is sampled `alone`, and on surfaces that do not combine both.
    #[inline(always)]
    pub(super) fn of_light(&self, pdfs: [X8; 2], delta: M8, alone: M8, rough: M8) -> X8 {
        let one = X8::lit(1.0);
        let [pdf, surface_pdf] = pdfs;
        let weight = self.heuristic.weights([technique_pdf(one, pdf, delta), surface_pdf])[0];
        let weight = select(alone, one, weight);
        if self.only_rough { select(rough, weight, one) } else { weight }
    }
    /// The weight of a direction drawn by the surface, with its pdf and the pdf with which the light is sampled there.
    #[inline(always)]
    pub(super) fn of_surface(&self, pdfs: [X8; 2]) -> X8 {
        self.heuristic.weights(pdfs)[0]
    }
    /// The lanes that the surface samples, of those that reflect.
    #[inline(always)]
    pub(super) fn by_surface(&self, rough: M8, reflects: M8) -> M8 {
        if self.only_rough { reflects & rough } else { reflects }
    }
}

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
    /// Whether a sample needs a pair of numbers for the surface besides that for the light.
    pub(crate) const fn is_combined(&self) -> bool {
        self.mis.is_some()
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
        let PreparedScene { sky, .. } = group.scene;
        let lights = group.scene.sampled(self.finds_lights);
        if let Some(each) = lights.each() {
            for light in 0..each {
                self.by_light.add::<GENERAL, _>(lights, &Which::One(light), group, integrand, tracer, sampled);
            }
        } else if !integrand.is_empty() {
            self.by_light.add::<GENERAL, _>(lights, &Which::Chosen, group, integrand, tracer, sampled);
            if let Some(sun) = sky.as_ref().filter(|_| !self.finds_lights).and_then(|sky| sky.sun_beside()) {
                self.by_light.add_sun::<GENERAL, _>(sun, group, integrand, tracer, sampled);
            }
        }
        let pairs = if self.finds_lights { Some(&group.numbers.light) } else { group.numbers.surface.as_ref() };
        if let Some(pairs) = pairs {
            self.by_surface.add::<GENERAL, _>(pairs, group, integrand, tracer, sampled);
        }
    }
}
