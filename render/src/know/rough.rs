//! Direct light of rough surfaces, where geometry tells what can occlude it: the closed form of the fit, to which samples add what the BSDF
//! reflects beyond it.

use super::certificates::{AreaLight, Closed, Known};
use super::knowledge::Knowledge;
use super::ledger::Ledger;
use crate::camera::{Group, PointIdentity};
use crate::packet::{M8, V8, X8, first_lane, product};
use crate::surfaces::Surface;
use crate::surfaces::lobe::Lobe;
use etendue::reflection::Reflection;
use etendue::{Mask, Real};
use etendue_visible::Precision;
use std::f64::consts::FRAC_1_PI;

/// Greatest error of a closed form, as a fraction of what the light covers of the lobe, and of [`SLIVER`]. Measured by
/// `cargo test -p etendue-tests reflection -- --nocapture`: 3.9e−5.
const ALLOWED: f64 = 5e-5;
const SLIVER: f64 = 0.01;

impl Knowledge<'_> {
    /// Adds what the fits of rough surfaces in a packet reflect of the lights that are known.
    // not inlined, so that it does not burden scenes without rough surfaces
    #[inline(never)]
    pub(super) fn add_fits(
        &mut self,
        group: &Group<'_>,
        packet: usize,
        lobe: &Lobe,
        ledger: &mut Ledger,
        reflected: &mut V8,
    ) {
        let (surface, place) = (&group.points.surfaces[packet], &group.points.places[packet]);
        let mut left = surface.reflects & place.fitted;
        while left.any() {
            let (first, lanes) = self.certificates.find(surface, place, left);
            left = left & !lanes;
            if first == 0 {
                continue;
            }
            for light in 0..self.certificates.lights.len() {
                let sum = self.fit(surface, lobe, lanes, first, light);
                let proven = &mut ledger.proven[light][packet];
                match self.certificates.known[first + light] {
                    Known::Lit(_) => proven.lit = proven.lit | lanes,
                    Known::Dark => proven.dark = proven.dark | lanes,
                    _ => {}
                }
                if let Some(sum) = sum {
                    *reflected += V8::blend(lanes, sum, V8::default());
                    proven.fitted = proven.fitted | lanes;
                }
            }
        }
    }

    /// What the fits in some lanes, whose certificates begin at `first`, reflect of a light, if that is known.
    fn fit(&mut self, surface: &Surface, lobe: &Lobe, lanes: M8, first: usize, light: usize) -> Option<V8> {
        let (behind, precision) = match &self.certificates.known[first + light] {
            Known::Lit(_) => (0..0, Precision::Single),
            Known::Behind(behind, precision) => (behind.clone(), *precision),
            _ => return None,
        };
        let AreaLight { form, radiance, closed } = &self.certificates.lights[light];
        if !matches!(closed, Closed::Constant) {
            return None;
        }
        // the other lanes repeat one of these: what is not seen from here does not matter
        let lane = first_lane(lanes);
        let of = |v: V8| V8::blend(lanes, v, V8::splat(v.lane(lane)));
        let (point, normal) = (of(surface.point), of(surface.normal));
        let one = Reflection::splat(lobe.reflection.map(|x| x.lane(lane)));
        let reflection = Reflection::blend(lanes, lobe.reflection, one);
        let (forms, occluders) = (&mut self.forms, &self.certificates.solids[behind]);
        let mut part = |lobe| forms.part([point, normal], lobe, form, (occluders, precision));
        let shine = part(Some(&reflection))?;
        let diffuse = if (lobe.coats & lanes).any() { part(None)? } else { X8::default() };
        let all = (lobe.specular * shine + lobe.diffuse * diffuse) * X8::lit(FRAC_1_PI);
        Some(product(all, V8::from(*radiance)))
    }

    /// A bound of the error of what [`add_fits`](Self::add_fits) adds at the surface in the first lane.
    pub(super) fn error_bound_of_fit(&mut self, surface: &Surface, place: &PointIdentity, lobe: &Lobe) -> V8 {
        let (first, _) = self.certificates.find(surface, place, M8::from_bits(1));
        let mut sum = V8::default();
        for light in 0..self.certificates.lights.len() {
            if first > 0 && self.fit(surface, lobe, M8::from_bits(1), first, light).is_some() {
                let AreaLight { form, radiance, .. } = &self.certificates.lights[light];
                let shine = self.forms.part(
                    [surface.point, surface.normal],
                    Some(&lobe.reflection),
                    form,
                    (&[], Precision::Single),
                );
                let shine = shine.unwrap_or_default() + X8::lit(SLIVER);
                sum += product(lobe.specular + lobe.diffuse, V8::from(*radiance)) * shine;
            }
        }
        sum * X8::lit(FRAC_1_PI * ALLOWED)
    }
}
