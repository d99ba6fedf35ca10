//! What the samplers draw in single precision: the mean and the standard deviation of their samples.

use super::cell::Cell;
use super::moments::{AREA, BSDF, HEURISTIC, METHODS, MIS, PROJECTED, REFLECTION, REST, SOLID_ANGLE, Samplers};
use etendue::sequence::{Sequence, Stratified};
use etendue::{LightSample, LightSampler, Vec2, Vec3, Warp};
use etendue_oracle::V3;

/// The mean of stratified samples and the standard deviation of one, per estimator, for a light of radiance 1.
#[derive(Clone, Copy, Debug)]
pub struct Drawn {
    /// Means.
    pub means: [f64; METHODS.len()],
    /// Standard deviations.
    pub deviations: [f64; METHODS.len()],
}

fn wide(w: Vec3<f32>) -> V3 {
    [w.x, w.y, w.z].map(f64::from)
}

impl Drawn {
    /// Draws one sample from each of `side`² strata, by each sampler.
    #[must_use]
    pub fn new(cell: &Cell, side: u32) -> Self {
        let samplers = Samplers::<f32>::new(cell);
        let albedo = f64::from(samplers.fit.albedo());
        let closed = albedo * f64::from(samplers.by_reflection.projected_solid_angle()) / std::f64::consts::PI;
        let strata = Stratified::new(1, side * side);
        let (mut sums, mut squares) = ([0.0; 2 + METHODS.len()], [0.0; 2 + METHODS.len()]);
        for k in 0..side * side {
            let [u, other]: [Vec2<f32>; 2] = [0, 1].map(|key| strata.pair(0_u32, k, key));
            // radiance over the pdf, of one sampler
            let of = |LightSample { direction, pdf, emits, .. }: LightSample<f32>| {
                let value = if pdf > 0.0 && emits { cell.reflected(wide(direction)) / f64::from(pdf) } else { 0.0 };
                (value, direction)
            };
            let (light, w) = of(samplers.solid_angle.sample(u));
            let reflected = samplers.normals.reflect(samplers.normals.sample(other));
            let hit = samplers.solid_angle.pdf(reflected) > 0.0 && reflected.z > 0.0;
            let own = f64::from(samplers.by_normals(reflected));
            let surface = if hit && own > 0.0 { cell.reflected(wide(reflected)) / own } else { 0.0 };
            // the weights of both samples, and the part of each that is beyond the fit
            let [by_light, by_surface] = [w, reflected].map(|w| {
                let both = [samplers.solid_angle.pdf(w), samplers.by_normals(w)].map(f64::from);
                let f = cell.reflected(wide(w));
                let rest = if f > 0.0 { 1.0 - albedo * f64::from(samplers.fit.pdf(w)) / f } else { 0.0 };
                (HEURISTIC.weights(both), rest)
            });
            let (a, b) = (light * by_light.0[0], surface * by_surface.0[1]);
            let mut values = [0.0; 2 + METHODS.len()];
            values[AREA] = of(samplers.area.sample(u)).0;
            values[SOLID_ANGLE] = light;
            values[PROJECTED] = of(samplers.projected.sample(u)).0;
            values[BSDF] = surface;
            values[REFLECTION] = of(samplers.by_reflection.sample(u)).0;
            // the two samples of an estimator are independent: their variances add
            (values[MIS], values[REST]) = (a, a * by_light.1);
            (values[METHODS.len()], values[METHODS.len() + 1]) = (b, b * by_surface.1);
            for (k, value) in values.into_iter().enumerate() {
                sums[k] += value;
                squares[k] += value * value;
            }
        }
        let count = f64::from(side * side);
        let (mut means, mut variances) = (sums.map(|sum| sum / count), [0.0; 2 + METHODS.len()]);
        for (variance, (mean, square)) in variances.iter_mut().zip(means.iter().zip(squares)) {
            *variance = (square / count - mean * mean).max(0.0);
        }
        for (k, method) in [MIS, REST].into_iter().enumerate() {
            means[method] += means[METHODS.len() + k];
            variances[method] += variances[METHODS.len() + k];
        }
        means[REST] += closed;
        Self { means: std::array::from_fn(|k| means[k]), deviations: std::array::from_fn(|k| variances[k].sqrt()) }
    }
}
