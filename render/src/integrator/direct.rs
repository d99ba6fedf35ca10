//! Light reflected by diffuse surfaces, by sampling a light or the hemisphere.

use super::Work;
use super::allocation::Allocated;
use super::surface::{Surface, emitted};
use crate::bvh::{GROUP, Hits, NOTHING, SHAPE};
use crate::packet::{M8, V8, X8, pick, select};
use etendue::warp::{CosineHemisphere, UniformHemisphere};
use etendue::{Frame, Mask, Real, Vec2, Warp, u32x8};

/// Fraction of the distance to a light that a shadow ray covers: it stops 2⁻¹⁷ short, so that surfaces touching the light do not
/// occlude it.
pub(super) const SPARED: f64 = 1.0 - 1.0 / 131_072.0;
const INV_PI: f64 = std::f64::consts::FRAC_1_PI;

impl Work<'_> {
    /// Reflected light by sampling a light: the `allocated` one of each sample, or else one chosen at random.
    #[inline]
    pub(super) fn light(
        &mut self,
        surfaces: &[Surface],
        light: [Vec2<X8>; GROUP],
        allocated: &[Allocated],
        choice: Option<[X8; GROUP]>,
    ) -> [V8; GROUP] {
        let world = self.world;
        let measure = self.settings.technique.measure();
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let count = surfaces.len();
        let rays = &mut self.rays[1];
        let mut lit = [M8::splat(false); GROUP];
        let mut limit = [zero; GROUP];
        let mut target = [u32x8::splat(NOTHING); GROUP];
        let mut reflected = [V8::default(); GROUP];
        for (p, surface) in surfaces.iter().enumerate().filter(|(_, s)| s.reflects.any()) {
            let mut u = light[p];
            let mut chosen = if let Some(allocated) = allocated.get(p) {
                world.lights.allocated(allocated.light, allocated.share)
            } else {
                let number = choice.map_or(u.x, |choice| choice[p]);
                let near = world.lights.near(surface.point, surface.normal);
                let (chosen, rest) = world.lights.choose_near(near.as_ref(), number);
                if choice.is_none() {
                    u.x = rest;
                }
                chosen
            };
            let sample = world.lights.sample(&mut chosen, measure, surface.point, surface.normal, u);
            let cos = sample.direction.dot(surface.normal);
            let some = sample.pdf.gt(zero) & chosen.pmf.gt(zero);
            lit[p] = surface.reflects & sample.emits & some & cos.gt(zero);
            self.count.shadow += u64::from(lit[p].bits().count_ones());
            rays[p] = world.bvh.rays(surface.point, sample.direction);
            limit[p] = sample.distance * X8::lit(SPARED);
            target[p] = chosen.shape;
            let density = select(lit[p], sample.pdf * chosen.pmf, one);
            reflected[p] = product(surface.albedo, chosen.radiance) * (cos * X8::lit(INV_PI) / density);
        }
        world.bvh.occluded(&rays[..count], &mut lit[..count], &limit[..count], &target[..count], &mut self.stack);
        for p in 0..count {
            reflected[p] = keep(reflected[p], lit[p]);
        }
        reflected
    }

    /// Reflected light by sampling the hemisphere.
    pub(super) fn hemisphere(&mut self, surfaces: &[Surface], light: [Vec2<X8>; GROUP], cosine: bool) -> [V8; GROUP] {
        let world = self.world;
        let count = surfaces.len();
        let infinite = X8::lit(f64::INFINITY);
        let rays = &mut self.rays[1];
        let mut lit = [M8::splat(false); GROUP];
        let mut hits = [Hits::none(infinite); GROUP];
        let mut weight = [X8::lit(1.0); GROUP];
        for (p, surface) in surfaces.iter().enumerate() {
            let local: V8 = if cosine { CosineHemisphere.sample(light[p]) } else { UniformHemisphere.sample(light[p]) };
            rays[p] = world.bvh.rays(surface.point, Frame::new(surface.normal).to_world(local));
            lit[p] = surface.reflects;
            self.count.shadow += u64::from(surface.reflects.bits().count_ones());
            // f·L·cosθ/pdf: with f = albedo/π, the pdf cosθ/π leaves the albedo, the pdf 1/(2π) leaves 2 cosθ times the albedo
            if !cosine {
                weight[p] = local.z * X8::lit(2.0);
            }
        }
        // finding the hit light is cheap; only rays that hit one need an occlusion test
        world.bvh.closest_shape(&rays[..count], &lit[..count], &mut hits[..count], &mut self.stack);
        let mut reflected = [V8::default(); GROUP];
        let mut target = [u32x8::splat(NOTHING); GROUP];
        let mut limit = [infinite; GROUP];
        for (p, surface) in surfaces.iter().enumerate() {
            let met = lit[p] & hits[p].any();
            lit[p] = M8::splat(false);
            let mut found = V8::default();
            world.each_shape(&hits[p], met, &rays[p], |_, here, shape, outward| {
                if let Some((radiance, here)) = emitted(here, shape, outward, rays[p].direction) {
                    found = V8::blend(here, radiance, found);
                    lit[p] = lit[p] | here;
                }
            });
            reflected[p] = product(surface.albedo, found) * weight[p];
            target[p] = pick(lit[p], hits[p].place ^ u32x8::splat(SHAPE), u32x8::splat(NOTHING));
            limit[p] = hits[p].distance * X8::lit(SPARED);
        }
        world.bvh.occluded(&rays[..count], &mut lit[..count], &limit[..count], &target[..count], &mut self.stack);
        for p in 0..count {
            reflected[p] = keep(reflected[p], lit[p]);
        }
        reflected
    }
}

#[inline]
pub(super) fn keep(v: V8, mask: M8) -> V8 {
    V8::new(v.x.keep(mask), v.y.keep(mask), v.z.keep(mask))
}

#[inline]
pub(super) fn product(a: V8, b: V8) -> V8 {
    V8::new(a.x * b.x, a.y * b.y, a.z * b.z)
}
