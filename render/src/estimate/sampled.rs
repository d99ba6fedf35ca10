//! Lights and surfaces sampled one after the other, as a technique does.

use super::by_light::ByLight;
use super::by_surface::BySurface;
use super::mis::Mis;
use super::which_light::Which;
use crate::bvh::{GROUP, Tracer};
use crate::camera::Group;
use crate::know::Ledger;
use crate::packet::V8;
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
    /// Whether a sample needs a pair of numbers for the surface besides that for the light.
    pub(crate) const fn is_combined(&self) -> bool {
        self.mis.is_some()
    }
    /// Adds an unbiased estimate, for each point, of the light that it reflects, less what the ledger has counted. What a scene does not need is
    /// not compiled in.
    pub(crate) fn add(&self, group: &Group<'_>, ledger: &Ledger, tracer: &mut Tracer, sampled: &mut [V8; GROUP]) {
        match group.scene.surfaces.is_plain {
            true => self.add_by::<false>(group, ledger, tracer, sampled),
            false => self.add_by::<true>(group, ledger, tracer, sampled),
        }
    }
    /// `GENERAL` compiles in what surfaces need that are not flat and diffuse.
    fn add_by<const GENERAL: bool>(
        &self,
        group: &Group<'_>,
        ledger: &Ledger,
        tracer: &mut Tracer,
        sampled: &mut [V8; GROUP],
    ) {
        if let Some(each) = group.chooser.each() {
            for light in 0..each {
                self.by_light.add::<GENERAL>(&Which::One(light), group, ledger, tracer, sampled);
            }
        } else if !ledger.is_closed {
            self.by_light.add::<GENERAL>(&Which::Chosen, group, ledger, tracer, sampled);
            if let Some(sun) = group.scene.sky.as_ref().filter(|_| !self.finds_lights).and_then(|sky| sky.sun_beside())
            {
                self.by_light.add_sun::<GENERAL>(sun, group, ledger, tracer, sampled);
            }
        }
        let pairs = if self.finds_lights { Some(&group.numbers.light) } else { group.numbers.surface.as_ref() };
        if let Some(pairs) = pairs {
            self.by_surface.add::<GENERAL>(pairs, group, ledger, tracer, sampled);
        }
    }
}
