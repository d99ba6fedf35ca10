//! Direct light by sampling a light: f L V cosθ / pdf, less what the [`Ledger`] has of it, as (f cosθ − fit) L V or f cosθ L (V − fraction).

use super::mis::Mis;
use super::unoccluded::Unoccluded;
use super::which_light::Which;
use crate::bvh::{GROUP, PrimitiveIds, Tracer};
use crate::camera::Group;
use crate::know::Ledger;
use crate::lights::sky::SunBeside;
use crate::lights::{Chosen, Drawn, LightDirection};
use crate::packet::{M8, V8, X8, keep, product};
use crate::surfaces::bsdf::Evaluated;
use crate::technique::Measure;
use etendue::{Mask, Real, Vec2};

/// Samples a light, uniformly by a measure.
pub(super) struct ByLight {
    pub(super) measure: Measure,
    /// If the surface is sampled, too.
    pub(super) mis: Option<Mis>,
}

impl ByLight {
    /// Adds f · L · V · cosθ / pdf, for a light and a direction to it in each lane.
    #[inline(always)]
    pub(super) fn add<const GENERAL: bool>(
        &self,
        which: &Which<'_>,
        group: &Group<'_>,
        ledger: &Ledger,
        tracer: &mut Tracer,
        reflected: &mut [V8; GROUP],
    ) {
        let (zero, one, bvh) = (X8::lit(0.0), X8::lit(1.0), &group.scene.surfaces.bvh);
        let mut rays = Unoccluded::new();
        for (p, surface) in group.reflecting() {
            // choose a light, and draw a direction to it
            let primitives = group.points.places[p].primitives;
            let (choice, lanes, u) = which.choose::<GENERAL>(group, ledger, p);
            let light = group.lights.chosen(choice.index);
            let (drawn, alone) = self.draw::<GENERAL>(which, group, p, u, &light);
            let Drawn { to: LightDirection { direction, distance, pdf, emits, delta }, radiance, primitives: target } =
                drawn;
            let cos = direction.dot(surface.normal);
            let own = light.is_own(primitives, surface.point, surface.normal);
            let some = pdf.gt(zero) & choice.pmf.gt(zero);
            let mut counts = lanes & emits & some & cos.gt(zero) & !own;
            // evaluate f cosθ, less what is known of its integral
            let Evaluated { mut color, factor, pdf: surface_pdf } = group.bsdf::<GENERAL>(p).evaluate(direction);
            let proven = if GENERAL { ledger.proven(p, choice.index) } else { None };
            if let Some(proven) = proven {
                color += keep(-group.fit(p, direction, cos), proven.fitted);
                counts = counts & !proven.dark;
            }
            // weigh f L cosθ / pdf
            let pdf = Real::blend(counts, pdf * choice.pmf, one);
            let rough = group.rough::<GENERAL>(p);
            let factor = match &self.mis {
                None => factor,
                Some(mis) => factor * mis.of_light([pdf, surface_pdf], delta, alone, rough),
            };
            let found = product(color, radiance) * (factor / pdf);
            if let Some(counted) = ledger.counted(p, choice.index) {
                reflected[p] += keep(found * -counted, counts);
            }
            if let Some(proven) = proven {
                reflected[p] += keep(found, counts & proven.lit);
                counts = counts & !proven.lit;
            }
            // trace a shadow ray, unless a sky or a profile is dark in that direction, or the surface black
            counts = counts & found.max_abs().gt(zero);
            (rays.found[p], rays.lanes[p]) = (found, counts);
            rays.end_at(p, distance, target);
            tracer.shadow[p] = bvh.rays(surface.point, direction).leaving(primitives);
            tracer.count.shadow += u64::from(counts.bits().count_ones());
        }
        rays.add(group.count, bvh, tracer, reflected);
    }

    /// The same for the sun that is sampled besides all other lights. Not inlined, so that it does not burden scenes without portals.
    #[inline(never)]
    pub(super) fn add_sun<const GENERAL: bool>(
        &self,
        sun: SunBeside<'_>,
        group: &Group<'_>,
        ledger: &Ledger,
        tracer: &mut Tracer,
        reflected: &mut [V8; GROUP],
    ) {
        self.add::<GENERAL>(&Which::Sun(sun), group, ledger, tracer, reflected);
    }

    /// Directions to the chosen lights, and the lanes in which the light is sampled alone although the surface is sampled, too.
    #[inline(always)]
    fn draw<const GENERAL: bool>(
        &self,
        which: &Which<'_>,
        group: &Group<'_>,
        packet: usize,
        u: Vec2<X8>,
        light: &Chosen,
    ) -> (Drawn, M8) {
        let surface = &group.points.surfaces[packet];
        let Drawn { mut to, radiance, primitives } = if let Which::Sun(sun) = which {
            let (sample, radiance) = sun.sample(surface.point, u);
            Drawn { to: sample.into(), radiance, primitives: PrimitiveIds::none() }
        } else {
            group.lights.sample(light, self.measure, surface.point, surface.normal, u)
        };
        let lobe = group.points.lobes[packet].as_ref().filter(|_| GENERAL && self.mis.is_some_and(|mis| mis.by_lobes));
        let alone = lobe.map(|lobe| light.sample_lobe(&mut to, lobe, surface.point, u));
        (Drawn { to, radiance, primitives }, alone.unwrap_or(M8::splat(false)))
    }
}
