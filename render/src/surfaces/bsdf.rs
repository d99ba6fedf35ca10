//! BSDFs in packets: diffuse surfaces, perfect mirrors, rough metals, and coats over diffuse surfaces and metals.

mod coated;
mod fresnel;
mod metal;
mod records;
mod walk;

use crate::packet::{M8, V8, X8};
use crate::technique::Technique;
use coated::{Coated, LAST};
use etendue::warp::{CosineHemisphere, GgxVisibleNormals, UniformHemisphere};
use etendue::{Frame, Mask, Real, Vec2, Warp};
pub use metal::Metal;
use metal::shadowing;
use records::LAYERED;
pub use records::{MaterialRecord, PLAIN, albedo, record};

const INV_PI: f64 = std::f64::consts::FRAC_1_PI;

/// The BSDFs of eight surfaces for given outgoing directions. `GENERAL` compiles in the code of all that is not flat and diffuse.
///
/// Where the normal is that of a smooth surface, light from below the flat surface counts for nothing, nor does light from below the
/// smooth one: so no light leaks through (PBR 4th ed., 9.1.1 and 10.1.1).
#[derive(Clone, Copy)]
pub struct Bsdf<'a, const GENERAL: bool> {
    normal: V8,
    /// Normal of the flat surface.
    flat: V8,
    albedo: V8,
    rough: Option<Rough<'a>>,
}

/// Rough metals and coats in some of the lanes.
#[derive(Clone, Copy)]
struct Rough<'a> {
    lanes: M8,
    /// Not a copy: it is large.
    metal: &'a Metal,
    frame: Frame<X8>,
    /// Outgoing directions in the frame.
    view: V8,
    coats: Option<Coats>,
    coated: Option<Coated>,
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

impl<'a, const GENERAL: bool> Bsdf<'a, GENERAL> {
    /// The BSDFs of surfaces with these normals, that of a smooth surface and that of the flat one, and albedo for camera rays along
    /// `direction`. What is estimated, by `numbers` of the sample, is right in the mean: coated metals.
    #[inline(always)]
    pub fn new(
        [normal, flat]: [V8; 2],
        mut albedo: V8,
        direction: V8,
        metal: Option<&'a Metal>,
        numbers: Vec2<X8>,
    ) -> Self {
        // not by a closure, whose result would be copied
        let rough = if let Some(metal) = metal.filter(|metal| GENERAL && metal.rough().any()) {
            let frame = metal.grain.map_or_else(|| Frame::new(normal), |grain| about(normal, grain));
            let view = frame.to_local(-direction);
            let lanes = metal.coats();
            if let Some(terms) = &metal.through {
                albedo = albedo * Real::blend(metal.is(LAYERED), metal.through(terms, view.z), X8::lit(1.0));
            }
            let coats = lanes.any().then(|| Coats { lanes, share: coat_share(metal.of_coat(view.z), albedo) });
            let coated = metal.walks().any().then(|| Coated::new(metal, view, numbers));
            Some(Rough { lanes: metal.rough(), metal, frame, view, coats, coated })
        } else {
            None
        };
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
        let Some(Rough { lanes, metal, frame, view, coats, coated }) = &self.rough else {
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
        let mut density = Real::blend(*lanes, density, pdf);
        if let Some(Coats { lanes, share: chosen }) = coats {
            let reflectance = metal.of_coat(cos);
            let through = metal.under(reflectance, local.z);
            let under = V8::new(value.x * through.x, value.y * through.y, value.z * through.z);
            color = V8::blend(*lanes, reflectance * share + under, color);
            density = Real::blend(*lanes, (density - pdf).mul_add(*chosen, pdf), density);
        }
        if let Some(coated) = coated {
            let (of, all) = coated.evaluate(metal, [*view, local], [density, pdf]);
            color = V8::blend(coated.lanes, of.map(|x| x.keep(above)), color);
            density = Real::blend(coated.lanes, all.keep(above), density);
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
        if let Some(Rough { lanes, metal, view, coats, coated, .. }) = self.rough.as_ref().filter(|_| !by_cosine) {
            let (mut by_normals, mut u, mut alpha) = (*lanes, u, metal.alpha);
            if let Some(coated) = coated {
                let by_cosine;
                (u, alpha, by_cosine) = coated.choose(u, alpha);
                local = V8::blend(coated.lanes, CosineHemisphere.sample(u), local);
                by_normals = by_normals & !by_cosine;
            }
            let normals = GgxVisibleNormals::new(alpha[0], alpha[1], *view);
            if let Some(Coats { lanes, share }) = coats {
                let first = u.x.lt(*share);
                let rest = one - *share;
                let left = Real::blend(first, u.x / *share, (u.x - *share) / Real::blend(rest.gt(zero), rest, one));
                u.x = Real::blend(*lanes, left.lesser(X8::lit(LAST)), u.x);
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
        Scattered { direction, color: color * (one / Real::blend(some, pdf, one)), factor: one, pdf }
    }
}

/// The probability with which a coat's rough part is sampled: its share of the reflectance, but at least a tenth, and at most nine unless
/// nothing is below it.
#[inline]
fn coat_share(reflectance: V8, albedo: V8) -> X8 {
    let most = |v: V8| v.x.greater(v.y).greater(v.z);
    let (above, below) = (most(reflectance), most(albedo) * (X8::lit(1.0) - most(reflectance)));
    let sum = above + below;
    let share = above / Real::blend(sum.gt(X8::lit(0.0)), sum, X8::lit(1.0));
    Real::blend(below.gt(X8::lit(0.0)), share.greater(X8::lit(0.1)).lesser(X8::lit(0.9)), X8::lit(1.0))
}

/// The frame about the normals whose first axis is the projection of these directions, or any where that is 0.
#[inline]
fn about(normal: V8, along: V8) -> Frame<X8> {
    let any = Frame::new(normal);
    let across = normal.cross(along);
    let square = across.length_squared();
    // a direction that nearly is the normal has no projection worth the name
    let some = square.gt(X8::lit(1e-12) * along.length_squared());
    let t = V8::blend(some, across * (X8::lit(1.0) / Real::blend(some, square, X8::lit(1.0)).sqrt()), any.t);
    Frame { s: V8::blend(some, t.cross(normal), any.s), t, n: normal }
}

#[cfg(test)]
mod tests;
