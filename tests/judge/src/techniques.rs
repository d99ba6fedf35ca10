//! A light by one technique, and the properties of its samples.

use crate::packets::{Coordinates, squares_of};
use crate::tolerances::ULP;
use core::fmt::Debug;
use etendue::{LightSample, LightSampler, Mask, Real, Vec2, f32x8};
use etendue_oracle::{V3, length};

/// A light with its parameters, seen from a point, and one way of sampling it.
pub trait LightFixture: Copy + Debug {
    /// The light prepared for its shading point; lane `i` from `lanes[i % lanes.len()]`.
    fn prepare<R: Real>(lanes: &[Self]) -> Box<dyn LightSampler<R>>;
    /// Relative difference allowed between the pdf of a sample and the pdf of its direction; `None` where the direction says nothing.
    fn evaluated_to(&self, _sample: &LightSample<f32>) -> Option<f64> {
        Some(0.0)
    }
    /// How far from 1 the length of a direction may be.
    fn unit_to(&self) -> f64 {
        12.0 * ULP
    }
    /// Truth: density per steradian of a point of the light in the direction `w` at `distance`, and to what part of itself it is known
    /// for a rounded direction.
    fn truth(&self, _w: V3, _distance: f64) -> Option<(f64, f64)> {
        None
    }
    /// Truth: whether the surface coordinates of a hit are those of a point at its distance in its direction.
    fn has(&self, _hit: &LightSample<f32>) -> bool {
        true
    }
    /// All lengths times a power of two.
    #[must_use]
    fn scaled(&self, _factor: f32) -> Self {
        *self
    }
    /// What the pdf is multiplied by then: lines have one per unit of width.
    fn pdf_scaled(&self, _factor: f32) -> f32 {
        1.0
    }
}

/// All numbers of one lane of a sample.
fn figures<R: Real>(s: &LightSample<R>, i: usize) -> [f64; 12] {
    let ([x, y, z], [nx, ny, nz]) = (s.direction.at(i), s.normal.at(i));
    let truth = |m: R::Mask| f64::from(u8::from(m.lane(i)));
    let number = |x: R| x.lane_f64(i);
    let (u, v) = (number(s.uv.x), number(s.uv.y));
    [
        x,
        y,
        z,
        number(s.distance),
        number(s.pdf),
        truth(s.emits),
        truth(s.delta),
        number(s.weight()),
        nx,
        ny,
        nz,
        u + 2.0 * v,
    ]
}

/// All numbers that a sampler returns in one lane: a sample, and the pdf, inverse and hit of its direction.
fn every_figure<R: Real>(sampler: &dyn LightSampler<R>, u: Vec2<R>, i: usize) -> Vec<f64> {
    let s = sampler.sample(u);
    let mut all = figures(&s, i).to_vec();
    let inverse = sampler.invert(s.direction);
    let number = |x: R| x.lane_f64(i);
    all.extend([number(sampler.pdf(s.direction)), number(inverse.x), number(inverse.y)]);
    all.push(number(sampler.pdf_of_hit(s.direction)));
    all.extend(figures(&sampler.hit(s.direction), i));
    all
}

/// **Total** and **lane-identical**: every number is finite; pdf, distance and inverse are in range; the direction is a unit vector where
/// the pdf is not 0; the pdf of a hit is that of its direction; f32 and f32x8 give the same bits, as all widths do by `etendue-bits`.
pub fn any_bits<T: LightFixture>(lights: &[T; 8], us: &[[f32; 2]; 8]) {
    let eight = T::prepare::<f32x8>(lights);
    for i in 0..8 {
        let (light, u) = (lights[i], us[i]);
        let sampler = T::prepare::<f32>(&[light]);
        let alone = sampler.sample(squares_of(&[u]));
        let one = every_figure(&*sampler, squares_of(&[u]), 0);
        let [x, y, z, distance, pdf, ..] = figures(&alone, 0);
        assert!(one.iter().all(|x| x.is_finite()), "not finite: {light:?} at {u:?}: {alone:?}\n{one:?}");
        assert!(pdf >= 0.0 && distance >= 0.0 && one[12] >= 0.0, "negative: {light:?} at {u:?}: {alone:?}");
        assert!(one[12] == 0.0 || one[15].to_bits() == one[12].to_bits(), "pdf of a hit: {light:?} at {u:?}: {one:?}");
        assert!(one[13..15].iter().all(|x| (0.0..1.0).contains(x)), "inverse: {light:?} at {u:?}: {one:?}");
        let off = (length([x, y, z]) - 1.0).abs();
        assert!(
            pdf == 0.0 || off <= light.unit_to(),
            "not a unit vector, off by {off:e}: {light:?} at {u:?}: {alone:?}"
        );
        let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let packet = every_figure(&*eight, squares_of(us), i);
        assert_eq!(bits(&one), bits(&packet), "lane {i}: {light:?} at {u:?}:\n{one:?}\n{packet:?}");
        let wide = every_figure(&*T::prepare::<f64>(&[light]), squares_of(&[u]), 0);
        assert!(wide.iter().all(|x| x.is_finite()) && wide[4] >= 0.0, "f64: {light:?} at {u:?}: {wide:?}");
    }
}

/// **One pdf**: that of a sample is the one that is evaluated for its direction, to the bit where the direction determines it; and a ray in
/// that direction hits the light with it.
pub fn one_pdf<T: LightFixture>(light: &T, u: [f32; 2]) {
    let sampler = T::prepare::<f32>(&[*light]);
    let s = sampler.sample(squares_of(&[u]));
    let Some(allowed) = light.evaluated_to(&s) else { return };
    if s.pdf > 0.0 {
        let evaluated = sampler.pdf(s.direction);
        let hit = sampler.hit(s.direction);
        let aside = (hit.uv.x - s.uv.x).abs().max((hit.uv.y - s.uv.y).abs());
        if allowed > 0.0 && hit.distance < s.distance && (hit.distance < 0.999 * s.distance || aside > 0.01) {
            // another sheet of a twisted patch hides the sample, if there is one
            assert!(light.has(&hit), "no such point: {hit:?} for {s:?}: {light:?} at {u:?}");
            return;
        }
        let off = (f64::from(evaluated) / f64::from(s.pdf) - 1.0).abs();
        let same = if allowed == 0.0 { evaluated.to_bits() == s.pdf.to_bits() } else { off <= allowed };
        assert!(same, "two pdfs: {evaluated} evaluated, {} sampled, allowed {allowed:e}: {light:?} at {u:?}", s.pdf);
        let reached = hit.pdf.to_bits() == evaluated.to_bits() && hit.emits == s.emits;
        assert!(s.delta || reached, "not hit: {hit:?} for {s:?}: {light:?} at {u:?}");
    }
}

/// The density is the truth for the point that was drawn.
pub fn measure<T: LightFixture>(light: &T, u: [f32; 2]) {
    let s = T::prepare::<f32>(&[*light]).sample(squares_of(&[u]));
    let Some((truth, known)) = light.truth(s.direction.at(0), f64::from(s.distance)) else { return };
    // what is next to a number's end, or known to less than a tenth, tells nothing
    let fair = (1e-15..1e15).contains(&s.distance) && (1e-30..1e30).contains(&truth);
    if s.pdf > 0.0 && known < 0.1 && fair {
        let off = (f64::from(s.pdf) / truth - 1.0).abs();
        assert!(off <= known, "pdf {} for {truth}: off by {off:e}, allowed {known:e}: {light:?} at {u:?}", s.pdf);
    }
}

/// **Threshold-free**: lengths times a power of two change no bit of a direction, and none of a density, but for its exponent.
pub fn scale<T: LightFixture>(light: &T, u: [f32; 2]) {
    let one = T::prepare::<f32>(&[*light]).sample(squares_of(&[u]));
    for power in [-20, -7, 1, 20] {
        let factor = 2.0_f32.powi(power);
        let other = T::prepare::<f32>(&[light.scaled(factor)]).sample(squares_of(&[u]));
        let (mut expected, other) = (figures(&one, 0), figures(&other, 0));
        expected[3] *= f64::from(factor);
        expected[4] *= f64::from(light.pdf_scaled(factor));
        expected[7] /= f64::from(light.pdf_scaled(factor));
        assert_eq!(
            expected.map(f64::to_bits),
            other.map(f64::to_bits),
            "scaled by 2^{power}: {light:?} at {u:?}:\n{expected:?}\n{other:?}"
        );
    }
}
