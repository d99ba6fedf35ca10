//! BSDFs in packets: diffuse surfaces, perfect mirrors, rough metals, and rough coats over diffuse surfaces.

mod fresnel;

use super::coat::{Coat, POLE, TERMS, range};
use super::lobe::{Lobe, cosine_of_schlick, schlick_of_diffuse};
use crate::packet::{M8, V8, X8, equal, max, min, select};
use crate::scene::{Material, Roughness};
use crate::technique::Technique;
use etendue::reflection::Reflection;
use etendue::warp::{CosineHemisphere, GgxVisibleNormals, UniformHemisphere};
use etendue::{Frame, Mask, Real, Vec2, Warp, u32x8};
use fresnel::fresnel;

const INV_PI: f64 = std::f64::consts::FRAC_1_PI;

/// The numbers of a material, so that one transposition gathers eight lanes: roughness α along, η (3), k (3), roughness α across. A
/// mirror has its reflectance in place of η, and k = 0; a coat its reflectances at normal and at grazing incidence. The three low bits of the
/// last number are the kind, and those of the first are 0, so that a roughness that is the same in all directions stays so. The second half
/// is the polynomial of what a layered coat lets through; of a coated mirror, its first number is the η of the coat.
pub type MaterialRecord = [[f32; 8]; 2];

// kind 0 is diffuse
const MIRROR: u32 = 1;
const SMOOTH_METAL: u32 = 2;
const ROUGH_METAL: u32 = 3;
const COAT: u32 = 4;
/// A coat that dims by the greatest channel of its reflectance.
const DIMMING_COAT: u32 = 5;
const LAYERED: u32 = 6;
const COATED_MIRROR: u32 = 7;
const KIND: u32 = 7;

/// The record of a diffuse surface, with an arbitrary valid roughness.
pub const PLAIN: MaterialRecord = [[1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0], [0.0; 8]];

/// The record of a material; of a varying one it is that of a diffuse surface, since its own depends on the place.
pub fn record(material: &Material) -> MaterialRecord {
    let of = |kind, Roughness { along, across, .. }, [a, b, c]: [f32; 3], [x, y, z]: [f32; 3]| {
        let [along, across] = [along, across].map(|alpha| alpha.to_bits() & !KIND);
        [[f32::from_bits(along), a, b, c, x, y, z, f32::from_bits(across | kind)], [0.0; 8]]
    };
    let smooth = Roughness::from(1.0);
    match *material {
        Material::Diffuse(_) | Material::Varying(_) => PLAIN,
        Material::Glossy { specular, grazing, roughness, greatest, .. } => {
            of(if greatest { DIMMING_COAT } else { COAT }, roughness, specular, grazing)
        }
        Material::Layered { eta, roughness, .. } => {
            let [numbers, _] = of(LAYERED, roughness, [eta; 3], [0.0; 3]);
            [numbers, layer(eta, roughness).through.map(|x| x as f32)]
        }
        Material::CoatedMirror { eta, k, coat } => {
            let [eta, k] = [eta, k].map(|of| of.map(|x| x / coat));
            let [numbers, _] = of(COATED_MIRROR, smooth, eta, k);
            [numbers, [coat, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]]
        }
        Material::Mirror(reflectance) => of(MIRROR, smooth, reflectance, [0.0; 3]),
        Material::Conductor { eta, k, .. } if material.is_mirror() => of(SMOOTH_METAL, smooth, eta, k),
        Material::Conductor { eta, k, roughness } => of(ROUGH_METAL, roughness, eta, k),
    }
}

/// The coat of a layered material; that of the least roughness is smooth.
fn layer(eta: f32, roughness: Roughness) -> Coat {
    let alpha = roughness.mean().along;
    Coat::new(if alpha > Roughness::LEAST { alpha.into() } else { 0.0 }, eta.into())
}

/// The albedo of a material's diffuse part, with what the coat of a layered one sends back to it; white for metals and mirrors that are not
/// black.
pub fn albedo(material: &Material) -> [f32; 3] {
    match *material {
        Material::Layered { diffuse, eta, roughness } => {
            let inside = layer(eta, roughness).inside;
            diffuse.map(|x| (f64::from(x) / (1.0 - f64::from(x) * inside).max(1e-6)) as f32)
        }
        Material::Diffuse(albedo) | Material::Glossy { diffuse: albedo, .. } => albedo,
        _ if material.is_black() => [0.0; 3],
        Material::Mirror(_) | Material::CoatedMirror { .. } | Material::Conductor { .. } | Material::Varying(_) => {
            [1.0; 3]
        }
    }
}

/// Parameters of the metal or coat in each lane.
#[derive(Clone, Copy)]
pub struct Metal {
    /// Roughness along and across.
    alpha: [X8; 2],
    /// The direction in which the surface has its roughness along, of any length, if that differs from the one across in any lane.
    grain: Option<V8>,
    eta: V8,
    k: V8,
    kind: u32x8,
    /// The second halves of the records, if there is a layered coat or a coated mirror.
    through: Option<[X8; TERMS]>,
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
    /// `yes` where the mask is true, `no` elsewhere.
    #[inline]
    pub fn select(mask: M8, yes: &Self, no: &Self) -> Self {
        let grain = |metal: &Self| metal.grain.unwrap_or_default();
        Self {
            alpha: std::array::from_fn(|i| select(mask, yes.alpha[i], no.alpha[i])),
            grain: (yes.grain.is_some() || no.grain.is_some()).then(|| V8::blend(mask, grain(yes), grain(no))),
            eta: V8::blend(mask, yes.eta, no.eta),
            k: V8::blend(mask, yes.k, no.k),
            kind: crate::packet::pick(mask, yes.kind, no.kind),
            through: match (&yes.through, &no.through) {
                (None, None) => None,
                (yes, no) => {
                    let [yes, no] = [yes, no].map(|of| of.unwrap_or_default());
                    Some(std::array::from_fn(|k| select(mask, yes[k], no[k])))
                }
            },
        }
    }
    /// Lanes of a kind.
    #[inline(always)]
    fn is(&self, kind: u32) -> M8 {
        equal(self.kind, u32x8::splat(kind))
    }
    /// Lanes of perfect mirrors.
    #[inline]
    pub fn mirrors(&self) -> M8 {
        self.is(MIRROR) | self.is(SMOOTH_METAL) | self.is(COATED_MIRROR)
    }
    /// Lanes of rough metals and of coats.
    #[inline]
    pub fn rough(&self) -> M8 {
        self.is(ROUGH_METAL) | self.coats()
    }
    /// Lanes of coats.
    #[inline]
    fn coats(&self) -> M8 {
        self.is(COAT) | self.is(DIMMING_COAT) | self.is(LAYERED)
    }
    /// T/η of layered coats at a cosine.
    #[inline(never)]
    fn through(&self, terms: &[X8; TERMS], cos: X8) -> X8 {
        let [middle, half] = range();
        let cos = max(cos, X8::lit(0.0));
        let x = (cos / (cos + X8::lit(POLE)) - X8::lit(middle)) * X8::lit(1.0 / half);
        max(terms.iter().rev().fold(X8::lit(0.0), |sum, term| sum.mul_add(x, *term)), X8::lit(0.0))
    }
    /// The reflectance of coats at the cosine of the view to the normal of the microsurface, per channel.
    #[inline]
    fn of_coat(&self, cos: X8) -> V8 {
        let schlick = self.schlick(cos);
        if self.through.is_none() { schlick } else { V8::blend(self.is(LAYERED), self.fresnel(cos), schlick) }
    }
    /// What coats let through to the diffuse surface below and back, where they reflect this, for the cosine of the light to the normal.
    /// Where coats are layered, the albedo has what the view gets through.
    #[inline]
    fn under(&self, reflectance: V8, cos: X8) -> V8 {
        let one = X8::lit(1.0);
        let dimming = self.is(DIMMING_COAT);
        let mut through = V8::from([1.0; 3]) - reflectance;
        if dimming.any() {
            let least = one - max(max(reflectance.x, reflectance.y), reflectance.z);
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
        let (coats, weight) = (self.coats() & lanes, reflection.schlick());
        let mut fresnel = self.fresnel(cosine_of_schlick(weight));
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
                through = through * select(layered, layer, one);
            }
            diffuse = V8::new(albedo.x * through.x, albedo.y * through.y, albedo.z * through.z);
            diffuse = V8::blend(coats, diffuse, V8::default());
        }
        let specular = (fresnel * reflection.albedo()).map(|part| part.keep(lanes));
        Some(Lobe { lanes, reflection, specular, diffuse, coats })
    }
    /// Reflectance of a perfect mirror at this cosine of the angle of incidence, per channel.
    #[inline]
    pub fn reflectance(&self, cos: X8) -> V8 {
        let metal = V8::blend(self.is(MIRROR), self.eta, self.fresnel(cos));
        let coated = self.is(COATED_MIRROR);
        let Some([coat, ..]) = self.through.filter(|_| coated.any()) else { return metal };
        // what goes back and forth between metal and coat is a geometric series
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let coat = select(coated, coat, one);
        let cos = min(max(cos, zero), one);
        let below = max(one - (one - cos * cos) / (coat * coat), zero).sqrt();
        let above = fresnel(cos, coat, zero);
        let series = |metal: X8| {
            let left = one - above;
            left.mul_add(left * metal / max(one - above * metal, X8::lit(1e-6)), above)
        };
        let V8 { x, y, z } = self.fresnel(below);
        V8::blend(coated, V8::new(series(x), series(y), series(z)), metal)
    }
    /// Schlick's reflectance of a coat, per channel.
    #[inline]
    fn schlick(&self, cos: X8) -> V8 {
        let one = X8::lit(1.0);
        let away = one - min(max(cos, X8::lit(0.0)), one);
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

/// The BSDFs of eight surfaces for given outgoing directions. `GENERAL` compiles in the code of all that is not flat and diffuse.
///
/// Where the normal is that of a smooth surface, light from below the flat surface counts for nothing, nor does light from below the
/// smooth one: so no light leaks through (PBR 4th ed., 9.1.1 and 10.1.1).
#[derive(Clone, Copy)]
pub struct Bsdf<const GENERAL: bool> {
    normal: V8,
    /// Normal of the flat surface.
    flat: V8,
    albedo: V8,
    rough: Option<Rough>,
}

/// Rough metals and coats in some of the lanes.
#[derive(Clone, Copy)]
struct Rough {
    lanes: M8,
    metal: Metal,
    frame: Frame<X8>,
    /// Outgoing directions in the frame.
    view: V8,
    coats: Option<Coats>,
}

/// Coats in some of the lanes.
#[derive(Clone, Copy)]
struct Coats {
    lanes: M8,
    /// Probability with which the rough part is sampled, and not the diffuse one.
    share: X8,
}

/// A BSDF for a pair of directions.
pub struct Evaluated {
    /// f·cosθ is the product of `color` and `factor`.
    pub color: V8,
    /// The part that all channels share.
    pub factor: X8,
    /// Pdf of a direction sampled from the BSDF (solid angle, 1/sr); 0 below the horizon.
    pub pdf: X8,
}

/// A direction sampled from a BSDF or over the hemisphere.
pub struct Scattered {
    /// Unit direction in world space.
    pub direction: V8,
    /// f·cosθ/pdf is the product of `color` and `factor`.
    pub color: V8,
    /// The part that all channels share.
    pub factor: X8,
    /// Pdf of the direction (solid angle, 1/sr); 0 where there is no sample.
    pub pdf: X8,
}

impl<const GENERAL: bool> Bsdf<GENERAL> {
    /// The BSDFs of surfaces with this normal and albedo for camera rays along `direction`; `flat` is the normal of the flat surface.
    #[inline(always)]
    pub fn new(normal: V8, flat: V8, mut albedo: V8, direction: V8, metal: Option<Metal>) -> Self {
        let rough = metal.filter(|metal| GENERAL && metal.rough().any()).map(|metal| {
            let frame = metal.grain.map_or_else(|| Frame::new(normal), |grain| about(normal, grain));
            let view = frame.to_local(-direction);
            let lanes = metal.coats();
            if let Some(terms) = &metal.through {
                albedo = albedo * select(metal.is(LAYERED), metal.through(terms, view.z), X8::lit(1.0));
            }
            let coats = lanes.any().then(|| Coats { lanes, share: coat_share(metal.of_coat(view.z), albedo) });
            Rough { lanes: metal.rough(), metal, frame, view, coats }
        });
        Self { normal, flat, albedo, rough }
    }
    /// Evaluates the BSDF for the unit vector `w`; 0 below the horizon, where diffuse lanes of a scene without metals have a negative
    /// `factor`.
    #[inline(always)]
    pub fn evaluate(&self, w: V8) -> Evaluated {
        let cos = w.dot(self.normal);
        let above = cos.gt(X8::lit(0.0));
        let factor = cos * X8::lit(INV_PI);
        if !GENERAL {
            return Evaluated { color: self.albedo, factor, pdf: factor.keep(above) };
        }
        let above = above & w.dot(self.flat).gt(X8::lit(0.0));
        let pdf = factor.keep(above);
        let value = self.albedo * factor.keep(above);
        let one = X8::lit(1.0);
        let Some(Rough { lanes, metal, frame, view, coats }) = &self.rough else {
            return Evaluated { color: value, factor: one, pdf };
        };
        let local = frame.to_local(w);
        let normals = GgxVisibleNormals::new(metal.alpha[0], metal.alpha[1], *view);
        let m = (local + *view).normalize();
        let density = normals.reflected_pdf(m).keep(above);
        // f cosθ = F D G₂/(4 cosθᵢ) and the pdf is D G₁/(4 cosθᵢ), so their quotient is F G₂/G₁
        let share = density * shadowing(metal.alpha, *view, local);
        let cos = view.dot(m);
        let mut color = V8::blend(*lanes, metal.fresnel(cos) * share, value);
        let mut density = select(*lanes, density, pdf);
        if let Some(Coats { lanes, share: chosen }) = coats {
            let reflectance = metal.of_coat(cos);
            let through = metal.under(reflectance, local.z);
            let under = V8::new(value.x * through.x, value.y * through.y, value.z * through.z);
            color = V8::blend(*lanes, reflectance * share + under, color);
            density = select(*lanes, (density - pdf).mul_add(*chosen, pdf), density);
        }
        Evaluated { color, factor: one, pdf: density }
    }
    /// Samples a direction for the technique: uniform or by the cosine over the hemisphere, and otherwise from the BSDF, which is by the
    /// cosine for diffuse surfaces and by visible normals for rough metals.
    #[inline(always)]
    pub fn sample(&self, technique: Technique, u: Vec2<X8>) -> Scattered {
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let frame = self.rough.as_ref().map_or_else(|| Frame::new(self.normal), |rough| rough.frame);
        let uniform = technique == Technique::UniformHemisphere;
        let mut local: V8 = if uniform { UniformHemisphere.sample(u) } else { CosineHemisphere.sample(u) };
        let by_cosine = uniform || technique == Technique::CosineHemisphere;
        if !GENERAL {
            // f = albedo/π: the pdf cosθ/π leaves the albedo, the pdf 1/(2π) leaves 2 cosθ times the albedo
            let (factor, pdf): (X8, X8) = if uniform {
                (local.z * X8::lit(2.0), UniformHemisphere.pdf(local))
            } else {
                (one, CosineHemisphere.pdf(local))
            };
            return Scattered { direction: frame.to_world(local), color: self.albedo, factor, pdf };
        }
        if let Some(Rough { lanes, metal, view, coats, .. }) = self.rough.as_ref().filter(|_| !by_cosine) {
            let normals = GgxVisibleNormals::new(metal.alpha[0], metal.alpha[1], *view);
            let (mut by_normals, mut u) = (*lanes, u);
            if let Some(Coats { lanes, share }) = coats {
                let first = u.x.lt(*share);
                let rest = one - *share;
                let left = select(first, u.x / *share, (u.x - *share) / select(rest.gt(zero), rest, one));
                u.x = select(*lanes, min(left, X8::lit(LAST)), u.x);
                local = V8::blend(*lanes, CosineHemisphere.sample(u), local);
                by_normals = by_normals & (first | !*lanes);
            }
            local = V8::blend(by_normals, normals.reflect(normals.sample(u)), local);
        }
        let direction = frame.to_world(local);
        let Evaluated { color, pdf, .. } = self.evaluate(direction);
        let pdf = match technique {
            Technique::UniformHemisphere => UniformHemisphere.pdf(frame.to_local(direction)),
            Technique::CosineHemisphere => CosineHemisphere.pdf(frame.to_local(direction)),
            _ => pdf,
        };
        let some = pdf.gt(zero);
        Scattered { direction, color: color * (one / select(some, pdf, one)), factor: one, pdf }
    }
}

/// The largest number below 1.
const LAST: f64 = 1.0 - 1.0 / 16_777_216.0;

/// The probability with which a coat's rough part is sampled: its share of the reflectance, but at least a tenth, and at most nine unless
/// nothing is below it.
#[inline]
fn coat_share(reflectance: V8, albedo: V8) -> X8 {
    let most = |v: V8| max(max(v.x, v.y), v.z);
    let (above, below) = (most(reflectance), most(albedo) * (X8::lit(1.0) - most(reflectance)));
    let sum = above + below;
    let share = above / select(sum.gt(X8::lit(0.0)), sum, X8::lit(1.0));
    select(below.gt(X8::lit(0.0)), min(max(share, X8::lit(0.1)), X8::lit(0.9)), X8::lit(1.0))
}

/// The frame about the normals whose first axis is the projection of these directions, or any where that is 0.
#[inline]
fn about(normal: V8, along: V8) -> Frame<X8> {
    let any = Frame::new(normal);
    let across = normal.cross(along);
    let square = across.length_squared();
    // a direction that nearly is the normal has no projection worth the name
    let some = square.gt(X8::lit(1e-12) * along.length_squared());
    let t = V8::blend(some, across * (X8::lit(1.0) / select(some, square, X8::lit(1.0)).sqrt()), any.t);
    Frame { s: V8::blend(some, t.cross(normal), any.s), t, n: normal }
}

/// G₂/G₁ of the height-correlated Smith masking-shadowing function (Heitz 2014, equations 86 and 99): (1 + Λᵢ)/(1 + Λᵢ + Λₒ), where
/// 1 + 2Λ = √(1 + (αx²x² + αy²y²)/z²), computed without division by a cosine z.
#[inline]
fn shadowing(alpha: [X8; 2], i: V8, o: V8) -> X8 {
    let root = |w: V8| {
        let (x, y) = (alpha[0] * w.x, alpha[1] * w.y);
        x.mul_add(x, y.mul_add(y, w.z * w.z)).sqrt()
    };
    let (root_i, root_o) = (root(i), root(o));
    let denominator = root_i.mul_add(o.z, root_o * i.z);
    let some = denominator.gt(X8::lit(0.0));
    (o.z * (root_i + i.z) / select(some, denominator, X8::lit(1.0))).keep(some)
}

#[cfg(test)]
mod tests;
