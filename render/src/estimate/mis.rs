//! Multiple importance sampling: how samples of lights and of surfaces are weighted where both are taken.

use crate::packet::{M8, X8};
use etendue::Real;
use etendue::estimate::Heuristic;

/// How samples of a light and of the BSDF are weighted (Veach 1997, chapter 9).
#[derive(Clone, Copy)]
pub(super) struct Mis {
    pub(super) heuristic: Heuristic,
    /// Whether rough surfaces alone are sampled both ways.
    pub(super) only_rough: bool,
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
        let weight = self.heuristic.weights([Heuristic::technique_pdf(one, pdf, delta), surface_pdf])[0];
        let weight = Real::blend(alone, one, weight);
        if self.only_rough { Real::blend(rough, weight, one) } else { weight }
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
