//! Direct light by sampling the surface: its BSDF, or the hemisphere above it.

use super::mis::Mis;
use super::unoccluded::Unoccluded;
use super::which_light::pmf;
use crate::bvh::{GROUP, Hits, PrimitiveIds, Tracer};
use crate::camera::Group;
use crate::choose::LightPmf;
use crate::know::Ledger;
use crate::lights::NO_LIGHT;
use crate::packet::{M8, V8, X8, keep, pick, product};
use crate::surfaces::bsdf::Scattered;
use crate::surfaces::lobe::Lobe;
use crate::technique::Technique;
use etendue::{Mask, Real, Vec2, u32x8};

/// Samples the surface as a technique does.
pub(super) struct BySurface {
    pub(super) technique: Technique,
    /// If lights are sampled, too.
    pub(super) mis: Option<Mis>,
}

/// What the rays of a packet find.
struct Met {
    /// Lanes that find light.
    lit: M8,
    radiance: V8,
    /// The lights, or [`NO_LIGHT`].
    lights: u32x8,
    /// The pdf with which they are sampled in these directions, if that is asked for.
    pdf: X8,
    /// Radiance and pdf of the sun besides the sky.
    sun: Option<(V8, X8)>,
}

impl BySurface {
    /// Adds f · L · V · cosθ / pdf, for a direction in each lane in which rays may find a light.
    pub(super) fn add<const GENERAL: bool>(
        &self,
        pairs: &[Vec2<X8>; GROUP],
        group: &Group<'_>,
        ledger: &Ledger,
        tracer: &mut Tracer,
        reflected: &mut [V8; GROUP],
    ) {
        let (zero, one, bvh) = (X8::lit(0.0), X8::lit(1.0), &group.scene.surfaces.bvh);
        let mut hits = [Hits::none(X8::lit(f64::INFINITY)); GROUP];
        let (mut factors, mut pdfs) = ([zero; GROUP], [one; GROUP]);
        let mut rays = Unoccluded::new();
        // draw directions: f cosθ / pdf is the product of two numbers
        for (p, surface) in group.reflecting() {
            let Scattered { direction, color, factor, pdf } = group.bsdf::<GENERAL>(p).sample(self.technique, pairs[p]);
            let some = pdf.gt(zero);
            let reflects = surface.reflects & some;
            pdfs[p] = Real::blend(some, pdf, one);
            (rays.found[p], factors[p]) = (color, factor);
            rays.lanes[p] = self.mis.map_or(reflects, |mis| mis.by_surface(group.rough::<GENERAL>(p), reflects));
            tracer.shadow[p] = bvh.rays(surface.point, direction).leaving(group.points.places[p].primitives);
            tracer.count.shadow += u64::from(rays.lanes[p].bits().count_ones());
        }
        // finding the hit light is cheap; only rays that hit one need an occlusion test
        let Tracer { shadow, scratch, .. } = tracer;
        bvh.closest_shape(&shadow[..group.count], &rays.lanes[..group.count], &mut hits[..group.count], scratch);
        for p in 0..group.count {
            if !rays.lanes[p].any() {
                continue;
            }
            let met = self.meet::<GENERAL>(group, ledger, p, &hits[p], rays.lanes[p], tracer);
            let (direction, mut color, mut lit) = (tracer.shadow[p].direction, rays.found[p], met.lit);
            // less what is known of the integral
            let proven = if GENERAL { ledger.proven(p, met.lights) } else { None };
            if let Some(proven) = proven {
                let fit = group.fit(p, direction, direction.dot(group.points.surfaces[p].normal));
                color += keep(fit * (-one / pdfs[p]), proven.fitted);
                lit = lit & !proven.dark;
            }
            let weighted = |light_pdf: X8| match &self.mis {
                None => factors[p],
                Some(mis) => factors[p] * mis.of_surface([pdfs[p], light_pdf]),
            };
            let mut found = product(color, met.radiance) * weighted(met.pdf);
            if let Some((radiance, pdf)) = met.sun {
                found += product(color, radiance) * weighted(pdf);
            }
            if let Some(proven) = proven {
                reflected[p] += keep(found, lit & proven.lit);
                lit = lit & !proven.lit;
            }
            (rays.found[p], rays.lanes[p]) = (found, lit);
            rays.end_at(
                p,
                hits[p].distance,
                PrimitiveIds::pick(lit & hits[p].any(), hits[p].primitives, PrimitiveIds::none()),
            );
        }
        rays.add(group.count, bvh, tracer, reflected);
    }

    /// The light that the rays of a packet find, if nothing else occludes it.
    #[inline(always)]
    fn meet<const GENERAL: bool>(
        &self,
        group: &Group<'_>,
        ledger: &Ledger,
        packet: usize,
        hits: &Hits,
        sent: M8,
        tracer: &Tracer,
    ) -> Met {
        let (scene, world) = (group.scene, &group.scene.surfaces);
        let (rays, surface) = (&tracer.shadow[packet], &group.points.surfaces[packet]);
        let (hit, missed) = (sent & hits.any(), sent & !hits.any());
        let is_weighted = self.mis.is_some() && (hit.any() || scene.sky.is_some());
        // spheres that metals reflect are sampled by the lobe alone
        let by_lobes = GENERAL && self.mis.is_some_and(|mis| mis.by_lobes);
        let metals = group.points.lobes[packet].as_ref().filter(|_| by_lobes).map(Lobe::metals);
        let mut met = Met {
            lit: M8::splat(false),
            radiance: V8::default(),
            lights: u32x8::splat(NO_LIGHT),
            pdf: X8::lit(0.0),
            sun: None,
        };
        let find: &mut dyn FnMut(Option<LightPmf<'_>>) = &mut |pmf| {
            world.each_shape(hits, hit, rays, |index, here, shape, outward| {
                let here = metals.filter(|_| shape.is_even_sphere()).map_or(here, |metals| here & !metals);
                if let Some((emitted, here)) = world.emitted(hits, here, shape, outward, rays) {
                    met.radiance = V8::blend(here, emitted, met.radiance);
                    met.lit = met.lit | here;
                    let light = scene.lights.of_shape(index);
                    met.lights = pick(here, u32x8::splat(light), met.lights);
                    if let Some(pmf) = pmf.filter(|_| here.any()) {
                        let pdf =
                            scene.lights.shape_pdf(index, &shape.geometry, surface.point, rays.direction) * pmf(light);
                        met.pdf = Real::blend(here, pdf, met.pdf);
                    }
                }
            });
            if let Some(sky) = scene.sky.as_ref().filter(|_| missed.any()) {
                let (seen, shown) = sky.sampled_radiance(surface.point, rays.direction);
                let sun = sky.sun_beside().map(|sun| sun.radiance_and_pdf(surface.point, rays.direction));
                met.sun = sun.map(|(radiance, pdf)| (keep(radiance, missed), pdf));
                met.radiance = V8::blend(missed, seen, met.radiance);
                met.lit = met.lit | missed & shown;
                if let Some(pmf) = pmf.filter(|_| (missed & shown).any()) {
                    let pdf = scene.lights.sky_pdf(surface.point, surface.normal, rays.direction);
                    let pdf = pdf * pmf(scene.lights.of_sky());
                    met.pdf = Real::blend(missed, pdf, met.pdf);
                }
            }
        };
        if is_weighted {
            pmf::<GENERAL>(group, ledger, packet, |pmf| find(Some(pmf)))
        } else {
            find(None)
        }
        met
    }
}
