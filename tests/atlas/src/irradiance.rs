//! Bias and variance of the irradiance that a technique estimates.

use crate::methods::Method;
use crate::pose::ShapeKind;
use crate::truth::Truth;
use etendue::Vec3;
use etendue_judge::area_lights::{AreaLight, LightShape};
use etendue_judge::lights::sampler::Sample;
use etendue_oracle::{V3, dot, unit, wide};

/// Smaller solid angles have a reciprocal close to overflow, and are not measured.
pub(super) const NOTHING: f64 = 1e-36;

/// One point in each stratum of the unit square.
fn strata(side: usize) -> Vec<[f32; 2]> {
    let at = |k: usize, j: f64| ((k as f64 + j) / side as f64).min(1.0 - 1.0 / 16_777_216.0) as f32;
    (0..side * side)
        .map(|i| {
            // jittered by a lattice, so that edges along an axis do not line up
            let jitter = [0.754_877_666, 0.569_840_291].map(|step| ((i as f64 + 0.5) * step).fract());
            [at(i % side, jitter[0]), at(i / side, jitter[1])]
        })
        .collect()
}
fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The bias of each method in a pose: the mean of (estimate − exact estimate for the same u), relative to the closed form. By area, no
/// estimate is exact.
pub(super) fn biases(kind: ShapeKind, light: &AreaLight, methods: &[Method], side: usize) -> Vec<f64> {
    let none = vec![f64::NAN; methods.len()];
    let Some(truth) = Truth::new(kind, light) else { return none };
    let normal = truth.receiver();
    // the sum over a grid is no closed form of a disk
    let closed = (kind != ShapeKind::Disk).then(|| truth.seen.irradiance(normal));
    if !(truth.measure > NOTHING && truth.measure.is_finite()) || closed.is_some_and(|closed| closed <= NOTHING) {
        return none;
    }
    let us = strata(side);
    let value = |w: V3, pdf: f64| {
        let cos = dot(w, normal);
        if pdf > 0.0 && cos > 0.0 { cos / pdf } else { 0.0 }
    };
    let [x, y, z] = light.n;
    let estimate = |s: &Sample| {
        let [a, b, c] = s.direction;
        // the cosine in f32 as a renderer computes it, since the pdf contains it too
        let cos = Vec3::new(a, b, c).dot(Vec3::new(x, y, z));
        match kind.projected() {
            true if s.pdf > 0.0 && cos > 0.0 => f64::from(cos) / f64::from(s.pdf),
            true => 0.0,
            false => value(wide(s.direction), f64::from(s.pdf)),
        }
    };
    let exact: Vec<f64> = us
        .iter()
        .map(|u| {
            let w = truth.direction(u.map(f64::from));
            // projected techniques have a constant estimate, on the horizon too
            if kind.projected() { truth.measure } else { value(w, truth.pdf(w)[0]) }
        })
        .collect();
    let closed = closed.unwrap_or_else(|| mean(&exact));
    let of = |method: &Method| {
        let Some(sampler) = method.prepare(light).filter(|_| !method.is_by_area()) else { return f64::NAN };
        let estimates = us.iter().map(|u| sampler.sample(*u).as_ref().map_or(0.0, estimate));
        let off: f64 = estimates.zip(&exact).map(|(estimate, exact)| estimate - exact).sum();
        (off / us.len() as f64 / closed).abs()
    };
    methods.iter().map(of).collect()
}

/// Relative variance of one sample of the irradiance of a diffuse receiver.
pub(super) fn variance(light: &AreaLight, method: &Method) -> f64 {
    let normal = unit(wide(light.n));
    let value = |s: Sample| {
        let cos = dot(wide(s.direction), normal);
        // a sphere hides half of itself; the other side of flat lights shines too
        let is_hidden = s.is_hidden && light.shape == LightShape::Sphere;
        if !is_hidden && s.pdf > 0.0 && cos > 0.0 { cos / f64::from(s.pdf) } else { 0.0 }
    };
    let Some(sampler) = method.prepare(light) else { return f64::NAN };
    let values: Vec<f64> = strata(24).into_iter().map(|u| sampler.sample(u).map_or(0.0, value)).collect();
    let mean = mean(&values);
    let square = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64;
    // at least the variance that rounding to f32 causes
    if mean > 0.0 { (square / (mean * mean)).max(1e-13) } else { f64::NAN }
}
