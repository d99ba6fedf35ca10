//! What a packet knows of the materials of its surfaces.

use super::fresnel::fresnel;
use super::records::{
    COAT, COATED_METAL, DIMMING_COAT, KIND, LAYERED, MIRROR, MaterialRecord, ROUGH_METAL, SMOOTH_METAL,
};
use crate::packet::{M8, V8, X8, equal};
use crate::surfaces::coat::{POLE, TERMS, range};
use crate::surfaces::lobe::{Lobe, cosine_of_schlick, schlick_of_diffuse};
use etendue::reflection::Reflection;
use etendue::{Mask, Real, u32x8};

/// Parameters of the metal or coat in each lane.
#[derive(Clone, Copy)]
pub struct Metal {
    /// Roughness along and across.
    pub(super) alpha: [X8; 2],
    /// The direction in which the surface has its roughness along, of any length, if that differs from the one across in any lane.
    pub(super) grain: Option<V8>,
    eta: V8,
    k: V8,
    kind: u32x8,
    /// The second halves of the records, if there is a layered coat or a coated metal.
    pub(super) through: Option<[X8; TERMS]>,
}

impl Metal {
    /// Gathers one record per lane.
    #[inline]
    pub fn new(rows: [&MaterialRecord; 8]) -> Self {
        let r = X8::transpose(rows.map(|r| X8::from(&r[0][..])));
        let (last, kind) = (r[7].to_bits(), u32x8::splat(KIND));
        let is_layered = rows.iter().any(|row| row[1][0] != 0.0);
        Self {
            through: is_layered.then(|| X8::transpose(rows.map(|r| X8::from(&r[1][..])))),
            alpha: [r[0], X8::from_bits(last & !kind)],
            grain: None,
            eta: V8::new(r[1], r[2], r[3]),
            k: V8::new(r[4], r[5], r[6]),
            kind: last & kind,
        }
    }
    /// Gives rough surfaces the direction of their roughness.
    #[inline]
    pub fn along(self, grain: V8) -> Self {
        Self { grain: Some(grain), ..self }
    }
    /// Replaces these lanes by those of another.
    #[inline]
    pub fn put(&mut self, lanes: M8, other: &Self) {
        (0..2).for_each(|i| self.alpha[i] = Real::blend(lanes, other.alpha[i], self.alpha[i]));
        if self.grain.is_some() || other.grain.is_some() {
            self.grain = Some(V8::blend(lanes, other.grain.unwrap_or_default(), self.grain.unwrap_or_default()));
        }
        self.eta = V8::blend(lanes, other.eta, self.eta);
        self.k = V8::blend(lanes, other.k, self.k);
        self.kind = crate::packet::pick(lanes, other.kind, self.kind);
        if self.through.is_some() || other.through.is_some() {
            let [yes, no] = [&other.through, &self.through].map(|of| of.unwrap_or_default());
            self.through = Some(std::array::from_fn(|k| Real::blend(lanes, yes[k], no[k])));
        }
    }
    /// Lanes of a kind.
    #[inline(always)]
    pub(super) fn is(&self, kind: u32) -> M8 {
        equal(self.kind, u32x8::splat(kind))
    }
    /// Lanes of perfect mirrors.
    #[inline]
    pub fn mirrors(&self) -> M8 {
        self.is(MIRROR) | self.is(SMOOTH_METAL) | self.is(COATED_METAL) & !self.walks()
    }
    /// Lanes of rough metals and of coats.
    #[inline]
    pub fn rough(&self) -> M8 {
        self.is(ROUGH_METAL) | self.coats() | self.walks()
    }
    /// Lanes of metals below coats of which either is rough.
    #[inline]
    pub fn walks(&self) -> M8 {
        let rough = |[_, a, b, c, d, ..]: &[X8; TERMS]| (*a).greater(*b).greater((*c).greater(*d)).gt(X8::lit(0.0));
        self.through.as_ref().map_or(M8::splat(false), |numbers| self.is(COATED_METAL) & rough(numbers))
    }
    /// Lanes of coats over diffuse surfaces.
    #[inline]
    pub(super) fn coats(&self) -> M8 {
        self.is(COAT) | self.is(DIMMING_COAT) | self.is(LAYERED)
    }
    /// T/η of layered coats at a cosine.
    #[inline(never)]
    pub(super) fn through(&self, terms: &[X8; TERMS], cos: X8) -> X8 {
        let [middle, half] = range();
        let cos = cos.greater(X8::lit(0.0));
        let x = (cos / (cos + X8::lit(POLE)) - X8::lit(middle)) * X8::lit(1.0 / half);
        terms.iter().rev().fold(X8::lit(0.0), |sum, term| sum.mul_add(x, *term)).greater(X8::lit(0.0))
    }
    /// The reflectance of coats at the cosine of the view to the normal of the microsurface, per channel.
    #[inline]
    pub(super) fn of_coat(&self, cos: X8) -> V8 {
        let schlick = self.schlick(cos);
        if self.through.is_none() { schlick } else { V8::blend(self.is(LAYERED), self.fresnel(cos), schlick) }
    }
    /// What coats let through to the diffuse surface below and back, where they reflect this, for the cosine of the light to the normal.
    /// Where coats are layered, the albedo has what the view gets through.
    #[inline]
    pub(super) fn under(&self, reflectance: V8, cos: X8) -> V8 {
        let one = X8::lit(1.0);
        let dimming = self.is(DIMMING_COAT);
        let mut through = V8::from([1.0; 3]) - reflectance;
        if dimming.any() {
            let least = one - reflectance.x.greater(reflectance.y).greater(reflectance.z);
            through = V8::blend(dimming, V8::new(least, least, least), through);
        }
        if let Some(terms) = &self.through {
            let layer = self.through(terms, cos);
            through = V8::blend(self.is(LAYERED), V8::new(layer, layer, layer), through);
        }
        through
    }
    /// The fit of the surfaces that are rough, and equally so in all directions, for their normals, the albedos below coats, and unit vectors
    /// towards the viewer.
    #[inline]
    pub fn lobe(&self, normal: V8, albedo: V8, view: V8) -> Option<Lobe> {
        let lanes = self.rough() & self.alpha[0].le(self.alpha[1]) & self.alpha[1].le(self.alpha[0]);
        if !lanes.any() {
            return None;
        }
        let one = X8::lit(1.0);
        let reflection = Reflection::new(self.alpha[0], normal, view);
        let (walks, weight) = (self.walks() & lanes, reflection.schlick());
        let coats = self.coats() & lanes;
        let mut fresnel = self.reflectance(cosine_of_schlick(weight));
        let mut diffuse = V8::default();
        if coats.any() {
            let layered = self.is(LAYERED);
            fresnel = V8::blend(coats & !layered, self.between(|f0, f90| (f90 - f0).mul_add(weight, f0)), fresnel);
            let away = schlick_of_diffuse(view.dot(normal));
            let reflected = self.between(|f0, f90| (f90 - f0).mul_add(away, f0));
            // light by the cosine comes at 2/3 in the mean; the view's part is not yet in the albedo
            let mut through = self.under(reflected, X8::lit(2.0 / 3.0));
            if let Some(terms) = &self.through {
                let layer = self.through(terms, view.dot(normal));
                through = through * Real::blend(layered, layer, one);
            }
            diffuse = V8::new(albedo.x * through.x, albedo.y * through.y, albedo.z * through.z);
            diffuse = V8::blend(coats, diffuse, V8::default());
        }
        let specular = (fresnel * reflection.albedo()).map(|part| part.keep(lanes));
        // coated metals reflect far beyond the lobe, too
        Some(Lobe { lanes, reflection, specular, diffuse, coats: coats | walks })
    }
    /// Reflectance of a mirror or a metal, smooth and below its coat, at this cosine of the angle of incidence, per channel.
    #[inline]
    pub fn reflectance(&self, cos: X8) -> V8 {
        let metal = V8::blend(self.is(MIRROR), self.eta, self.fresnel(cos));
        let coated = self.is(COATED_METAL);
        let Some([coat, ..]) = self.through.as_ref().filter(|_| coated.any()) else { return metal };
        // what goes back and forth between metal and coat is a geometric series
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let coat = Real::blend(coated, *coat, one);
        let cos = cos.greater(zero).lesser(one);
        let below = (one - (one - cos * cos) / (coat * coat)).greater(zero).sqrt();
        let above = fresnel(cos, coat, zero);
        let series = |metal: X8| {
            let left = one - above;
            left.mul_add(left * metal / (one - above * metal).greater(X8::lit(1e-6)), above)
        };
        let V8 { x, y, z } = self.fresnel(below);
        V8::blend(coated, V8::new(series(x), series(y), series(z)), metal)
    }
    /// Schlick's reflectance of a coat, per channel.
    #[inline]
    fn schlick(&self, cos: X8) -> V8 {
        let one = X8::lit(1.0);
        let away = one - cos.greater(X8::lit(0.0)).lesser(one);
        let square = away * away;
        let fifth = square * square * away;
        self.between(|f0, f90| (f90 - f0).mul_add(fifth, f0))
    }
    /// A function of η and k, or of a coat's reflectances at normal and at grazing incidence, per channel.
    #[inline(always)]
    fn between(&self, of: impl Fn(X8, X8) -> X8) -> V8 {
        V8::new(of(self.eta.x, self.k.x), of(self.eta.y, self.k.y), of(self.eta.z, self.k.z))
    }
    /// Reflectance of a smooth conductor for unpolarised light, per channel.
    #[inline]
    pub fn fresnel(&self, cos: X8) -> V8 {
        self.between(|eta, k| fresnel(cos, eta, k))
    }
}

/// G₂/G₁ of the height-correlated Smith masking-shadowing function (Heitz 2014, equations 86 and 99): (1 + Λᵢ)/(1 + Λᵢ + Λₒ), where
/// 1 + 2Λ = √(1 + (αx²x² + αy²y²)/z²), computed without division by a cosine z.
#[inline]
pub(super) fn shadowing(alpha: [X8; 2], i: V8, o: V8) -> X8 {
    let root = |w: V8| {
        let (x, y) = (alpha[0] * w.x, alpha[1] * w.y);
        x.mul_add(x, y.mul_add(y, w.z * w.z)).sqrt()
    };
    let (root_i, root_o) = (root(i), root(o));
    let denominator = root_i.mul_add(o.z, root_o * i.z);
    let some = denominator.gt(X8::lit(0.0));
    (o.z * (root_i + i.z) / Real::blend(some, denominator, X8::lit(1.0))).keep(some)
}
