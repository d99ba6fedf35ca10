//! Bias and variance of the irradiance that a technique estimates.

use super::methods::Method;
use super::pose::{Pose, ShapeKind, Sweep};
use super::sample::{Draw, Sample};
use super::truth::Truth;
use etendue::Vec3;
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

/// The bias of each method in a pose: the mean of (estimate − exact estimate for the same u), relative to the closed form.
pub(super) fn biases(kind: ShapeKind, pose: &Pose, methods: &[Method], side: usize) -> Vec<f64> {
    let truth = Truth::new(kind, pose);
    let normal = if kind.projected() { unit(wide(pose.normal)) } else { truth.towards() };
    let closed = truth.irradiance(normal);
    if !(truth.defined && truth.measure > NOTHING && truth.measure.is_finite()) || closed <= NOTHING {
        return vec![f64::NAN; methods.len()];
    }
    let us = strata(side);
    // the weight of a line is its pdf per radian times the distance
    let height = truth.height();
    let value = |w: V3, weight: f64| {
        let cos = dot(w, normal);
        if weight > 0.0 && cos > 0.0 { cos * height / weight } else { 0.0 }
    };
    let [x, y, z] = pose.normal;
    let by_technique = |s: &Sample| {
        let [a, b, c] = s.direction;
        // the cosine in f32 as a renderer computes it, since the pdf contains it too
        let cos = Vec3::new(a, b, c).dot(Vec3::new(x, y, z));
        if s.weight > 0.0 && cos > 0.0 { f64::from(cos) * height / f64::from(s.weight) } else { 0.0 }
    };
    let value_of = |w: V3, pdf: f64| value(w, pdf * height * truth.stretch(w));
    let exact: Vec<f64> = us
        .iter()
        .map(|u| {
            let w = truth.direction(u.map(f64::from));
            // projected techniques have a constant estimate, on the horizon too
            if kind.projected() { truth.measure } else { value_of(w, truth.pdf(w)[0]) }
        })
        .collect();
    let exact_by_area: Vec<f64> = us
        .iter()
        .map(|u| {
            let (w, pdf) = truth.by_area(u.map(f64::from));
            value_of(w, pdf)
        })
        .collect();
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    // a disk has no closed form
    let closed = if closed.is_nan() { mean(&exact) } else { closed };
    let mut samples = Vec::new();
    let of = |method: &Method| {
        samples.clear();
        (method.run)(pose, &mut Draw { us: &us, invert: false, out: &mut samples });
        let by_area = samples.iter().any(|s| s.by_area);
        let exact = if by_area { &exact_by_area } else { &exact };
        let off: f64 = samples
            .iter()
            .zip(exact)
            .map(|(s, exact)| {
                let own = kind.projected() && !by_area;
                let of = if own { by_technique(s) } else { value(wide(s.direction), f64::from(s.weight)) };
                of - exact
            })
            .sum();
        (off / us.len() as f64 / closed).abs()
    };
    methods.iter().map(of).collect()
}

/// Relative variance of one sample of the irradiance of a diffuse receiver.
pub(super) fn variance(kind: ShapeKind, sweep: &Sweep, [x, y]: [f64; 2], method: &Method) -> f64 {
    let us = strata(24);
    let pose: Pose = sweep.pose(kind, x, y, 0);
    let mut samples = Vec::with_capacity(us.len());
    (method.run)(&pose, &mut Draw { us: &us, invert: false, out: &mut samples });
    let normal = unit(wide(pose.normal));
    let value = |s: &Sample| {
        let cos = dot(wide(s.direction), normal);
        if s.emits && s.weight > 0.0 && cos > 0.0 { cos / f64::from(s.weight) } else { 0.0 }
    };
    let n = samples.len() as f64;
    let mean = samples.iter().map(value).sum::<f64>() / n;
    let square = samples.iter().map(|s| (value(s) - mean).powi(2)).sum::<f64>() / n;
    // at least the variance that rounding to f32 causes
    if mean > 0.0 { (square / (mean * mean)).max(1e-13) } else { f64::NAN }
}
