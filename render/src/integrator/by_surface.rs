//! Light that surfaces reflect, by sampling their BSDF or the hemisphere.

use super::end::{bsdf, keep, product};
use super::known::Fitted;
use super::paths::{COVERED, Paths};
use crate::bsdf::Scattered;
use crate::bvh::{GROUP, Hits, NOTHING, SHAPE};
use crate::lights::LightPmf;
use crate::lobe::Lobe;
use crate::packet::{M8, V8, X8, pick, select};
use crate::surfaces::Surface;
use etendue::select::Allocated;
use etendue::{Mask, Real, Vec2, u32x8};

impl Paths<'_> {
    /// Adds the light reflected by sampling the BSDF or the hemisphere, with its MIS weight if the technique combines two.
    pub(super) fn by_surface<const METAL: bool>(
        &mut self,
        count: usize,
        pairs: &[Vec2<X8>; GROUP],
        allocated: &[Allocated<'_, X8>],
        is_closed: bool,
        reflected: &mut [V8; GROUP],
    ) {
        let (scene, world) = (self.scene, &self.scene.surfaces);
        let (heuristic, is_mixed) = (self.heuristic(), self.is_mixed());
        let (zero, one, infinite) = (X8::lit(0.0), X8::lit(1.0), X8::lit(f64::INFINITY));
        let mut lit = [M8::splat(false); GROUP];
        let mut hits = [Hits::none(infinite); GROUP];
        let mut found = [V8::default(); GROUP];
        let mut factors = [zero; GROUP];
        let mut own = [one; GROUP];
        let Self { surfaces, ends, rays, places, .. } = self;
        for (p, surface) in surfaces[..count].iter().enumerate().filter(|(_, surface)| surface.reflects.any()) {
            let bsdf = bsdf::<METAL>(surface, &ends[p]);
            let Scattered { direction, color, factor, pdf } = bsdf.sample(self.technique, pairs[p]);
            let some = pdf.gt(zero);
            own[p] = select(some, pdf, one);
            (found[p], factors[p]) = (color, factor);
            lit[p] = surface.reflects & some;
            if is_mixed {
                lit[p] = lit[p] & ends[p].rough();
            }
            self.count.shadow += u64::from(lit[p].bits().count_ones());
            rays[1][p] = world.bvh.rays(surface.point, direction).leaving(places[p].primitives);
        }
        // finding the hit light is cheap; only rays that hit one need an occlusion test
        world.bvh.closest_shape(&self.rays[1][..count], &lit[..count], &mut hits[..count], &mut self.scratch);
        let mut target = [u32x8::splat(NOTHING); GROUP];
        let mut limit = [infinite; GROUP];
        for p in 0..count {
            if !lit[p].any() {
                continue;
            }
            let lobe = self.lobes[p].as_ref().filter(|_| METAL && is_closed && self.places[p].fitted.any());
            // spheres that metals reflect are sampled by the lobe alone
            let metals = self.lobes[p].as_ref().filter(|_| METAL && self.samples_lobes()).map(Lobe::metals);
            let mut known = Fitted::default();
            let Surface { point, normal, .. } = self.surfaces[p];
            let rays = &self.rays[1][p];
            let direction = rays.direction;
            let sent = lit[p];
            let met = sent & hits[p].any();
            let missed = sent & !hits[p].any();
            let mut radiance = V8::default();
            let mut light_pdf = zero;
            let weighted = heuristic.is_some() && (met.any() || scene.sky.is_some());
            let pmf = weighted.then(|| match allocated.get(p) {
                Some(allocated) => LightPmf::Allocated(allocated),
                None => {
                    let gloss = self.lobes[p].as_ref().filter(|_| METAL && !is_closed).map(Lobe::gloss);
                    scene.lights.pmf(point, normal, gloss.as_ref())
                }
            });
            lit[p] = M8::splat(false);
            world.each_shape(&hits[p], met, rays, |index, here, shape, outward| {
                let here = metals.filter(|_| shape.is_even_sphere()).map_or(here, |metals| here & !metals);
                if let Some((emitted, here)) = world.emitted(&hits[p], here, shape, outward, rays) {
                    radiance = V8::blend(here, emitted, radiance);
                    lit[p] = lit[p] | here;
                    if lobe.is_some() {
                        known.join(here, &self.fitted[scene.lights.of_shape(index)][p]);
                    }
                    if let Some(pmf) = pmf.as_ref().filter(|_| here.any()) {
                        let pdf = scene.lights.shape_pdf(pmf, index, &shape.geometry, point, direction);
                        light_pdf = select(here, pdf, light_pdf);
                    }
                }
            });
            target[p] = pick(lit[p], hits[p].place ^ u32x8::splat(SHAPE), u32x8::splat(NOTHING));
            limit[p] = hits[p].distance * X8::lit(COVERED);
            let mut beside = None;
            if let Some(sky) = scene.sky.as_ref().filter(|_| missed.any()) {
                let (seen, shown) = sky.sampled_radiance(point, direction);
                beside = sky.sun_beside().map(|sun| sun.radiance_and_pdf(point, direction));
                radiance = V8::blend(missed, seen, radiance);
                lit[p] = lit[p] | missed & shown;
                if let Some(pmf) = pmf.as_ref().filter(|_| (missed & shown).any()) {
                    light_pdf = select(missed, scene.lights.sky_pdf(pmf, point, normal, direction), light_pdf);
                }
            }
            let factor = |light_pdf: X8| match heuristic {
                None => factors[p],
                Some(by) => factors[p] * by.weights([own[p], light_pdf])[0],
            };
            let mut color = found[p];
            if let Some(lobe) = lobe {
                let fit = lobe.evaluate(direction, direction.dot(normal));
                color += keep(fit * (-one / own[p]), known.counted);
                lit[p] = lit[p] & !known.dark;
            }
            found[p] = product(color, radiance) * factor(light_pdf);
            if let Some((radiance, pdf)) = beside {
                found[p] += product(color, keep(radiance, missed)) * factor(pdf);
            }
            if lobe.is_some() {
                reflected[p] += keep(found[p], lit[p] & known.lit);
                lit[p] = lit[p] & !known.lit;
            }
        }
        self.add_unoccluded(count, &found, lit, &limit, &target, reflected);
    }
}
