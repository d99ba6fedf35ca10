//! Direct light of rough surfaces, where geometry tells what can occlude it: the closed form of the fit, to which samples add what the BSDF
//! reflects beyond it.

use super::analytic::{Analytic, Places};
use super::end::product;
use super::known::{AreaLight, Closed, Fitted, Known};
use crate::bvh::GROUP;
use crate::certificates::Precision;
use crate::lobe::Lobe;
use crate::packet::{M8, V8, X8};
use crate::surfaces::Surface;
use etendue::reflection::Reflection;
use etendue::{Mask, Real};
use std::f64::consts::FRAC_1_PI;

/// Greatest error of a closed form, as a fraction of what the light covers of the lobe, and of [`SLIVER`]. Measured by
/// `cargo test -p etendue-tests --test reflection -- --nocapture`: 3.9e−5.
const ALLOWED: f64 = 5e-5;
const SLIVER: f64 = 0.01;

impl Analytic<'_> {
    /// Adds what the fits of rough surfaces in a packet reflect of the lights that are known. All their lights are sampled, for the rest.
    // not inlined, so that it does not burden scenes without rough surfaces
    #[inline(never)]
    pub(super) fn gather_fitted(
        &mut self,
        surface: &Surface,
        places: &Places,
        lobe: &Lobe,
        packet: usize,
        reflected: &mut V8,
        fitted: &mut [[Fitted; GROUP]],
    ) {
        let mut left = surface.reflects & places.fitted;
        while left.any() {
            let (first, lanes) = self.find(surface, places, left);
            left = left & !lanes;
            if first == 0 {
                continue;
            }
            for (light, fitted) in fitted[..self.lights.len()].iter_mut().enumerate() {
                let fitted = &mut fitted[packet];
                let is_lit = matches!(self.known[first + light], Known::Lit(_));
                if is_lit {
                    fitted.lit = fitted.lit | lanes;
                } else if self.known[first + light] == Known::Dark {
                    fitted.dark = fitted.dark | lanes;
                }
                if let Some(sum) = self.fit(surface, lobe, lanes, first, light) {
                    *reflected += V8::blend(lanes, sum, V8::default());
                    fitted.counted = fitted.counted | lanes;
                }
            }
        }
    }

    /// What the fits in some lanes, whose certificates begin at `first`, reflect of a light, if that is known.
    fn fit(&mut self, surface: &Surface, lobe: &Lobe, lanes: M8, first: usize, light: usize) -> Option<V8> {
        let (forms, bodies, precision) = match &self.known[first + light] {
            Known::Lit(_) => (0..0, 0..0, Precision::Single),
            Known::Behind(forms, bodies, precision) => (forms.clone(), bodies.clone(), *precision),
            _ => return None,
        };
        let AreaLight { form, radiance, closed } = self.lights[light];
        if !matches!(closed, Closed::Constant) {
            return None;
        }
        // the other lanes repeat one of these: what is not seen from here does not matter
        let lane = lanes.bits().trailing_zeros() as usize & 7;
        let of = |v: V8| V8::blend(lanes, v, V8::splat(v.lane(lane)));
        let (point, normal) = (of(surface.point), of(surface.normal));
        let one = Reflection::splat(lobe.reflection.map(|x| x.lane(lane)));
        let reflection = Reflection::blend(lanes, lobe.reflection, one);
        let mut part = |lobe: Option<&Reflection<X8>>| {
            if precision == Precision::Double {
                return self.exact.visible_past(point, normal, lobe, &form, forms.clone(), bodies.clone());
            }
            let (forms, bodies) = (&self.forms[forms.clone()], &self.polyhedra[bodies.clone()]);
            match lobe {
                Some(lobe) => self.visible.one.reflected(point, normal, lobe, &form, forms, bodies),
                None => self.visible.one.visible_past(point, normal, &form, forms, bodies),
            }
        };
        let shine = part(Some(&reflection))?;
        let diffuse = if (lobe.coats & lanes).any() { part(None)? } else { X8::default() };
        let all = (lobe.specular * shine + lobe.diffuse * diffuse) * X8::lit(FRAC_1_PI);
        Some(product(all, V8::from(radiance)))
    }

    /// A bound of the error of what [`gather_fitted`](Self::gather_fitted) adds at the surface in the first lane.
    pub(super) fn doubt_fitted(&mut self, surface: &Surface, places: &Places, lobe: &Lobe) -> V8 {
        let (first, _) = self.find(surface, places, M8::from_bits(1));
        let mut sum = V8::default();
        for light in 0..self.lights.len() {
            if first > 0 && self.fit(surface, lobe, M8::from_bits(1), first, light).is_some() {
                let AreaLight { form, radiance, .. } = self.lights[light];
                let shine =
                    self.visible.one.reflected(surface.point, surface.normal, &lobe.reflection, &form, &[], &[]);
                let shine = shine.unwrap_or_default() + X8::lit(SLIVER);
                sum += product(lobe.specular + lobe.diffuse, V8::from(radiance)) * shine;
            }
        }
        sum * X8::lit(FRAC_1_PI * ALLOWED)
    }
}
