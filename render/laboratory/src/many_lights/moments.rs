//! The variance of one sample, exact in the choice of the light: at each point, all lights are sampled with a shadow ray each.

use super::stage::{Point, Stage};
use etendue::select::{LightTree, TreeChild};
use etendue::sequence::{Independent, Sequence};
use etendue::{Mask, Real, Vec2, Vec3, u32x8};
use etendue_render::bvh::{GROUP, Rays, Scratch};
use etendue_render::packet::{M8, X8};
use etendue_render::technique::Measure;
use rayon::prelude::*;

/// How a light is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Each with the same probability.
    Uniform,
    /// By power.
    Power,
    /// By the tree of the literature.
    Published,
    /// By the tree of the literature, with spheres by intensity.
    Intensity,
    /// By the library's tree.
    Own,
    /// In proportion to the true contribution without occlusion.
    Exhaustive,
}

/// All methods, with names.
pub const METHODS: [(Method, &str); 6] = [
    (Method::Uniform, "uniform"),
    (Method::Power, "power"),
    (Method::Published, "published tree"),
    (Method::Intensity, "by intensity"),
    (Method::Own, "this tree"),
    (Method::Exhaustive, "exhaustive"),
];
/// Places of the last two.
pub const OWN: usize = 4;
/// The exhaustive choice.
pub const EXHAUSTIVE: usize = 5;
/// Samples of each light.
const SAMPLES: u32 = 2;

/// The light whose share of the variance at a point is greatest with the library's tree.
#[derive(Clone, Copy, Debug, Default)]
pub struct Culprit {
    /// Its index.
    pub light: usize,
    /// Its share of the second moment.
    pub share: f64,
    /// Its pmf.
    pub pmf: f64,
    /// Its share of the contributions.
    pub ideal: f64,
}

/// The moments at a point.
#[derive(Clone, Debug)]
pub struct Moments {
    /// The point.
    pub point: Point<[f32; 3]>,
    /// The squared radiance, without bias.
    pub squared: f64,
    /// Variance of one sample of each of the [`METHODS`].
    pub variance: [f64; METHODS.len()],
    /// The same without occlusion, and its squared radiance.
    pub open: [f64; METHODS.len()],
    /// The squared radiance without occlusion.
    pub open_squared: f64,
    /// Lights that contribute although their pmf is 0.
    pub lost: [u64; METHODS.len()],
    /// The worst light.
    pub culprit: Culprit,
}

/// Probabilities of all lights by the library's tree.
#[must_use]
pub fn own_pmf(tree: LightTree<'_>, point: &Point<[f32; 3]>) -> Vec<f64> {
    let at = tree.at::<f32>(Vec3::from(point.p), Vec3::from(point.n));
    let mut all = vec![0.0; tree.len()];
    let mut pending = vec![(0, 1.0)];
    while let Some((node, probability)) = pending.pop() {
        for (units, child) in at.shares(0, node) {
            let probability = probability * f64::from(units) / 65_536.0;
            match child {
                TreeChild::Light(light) => all[light as usize] = probability,
                TreeChild::Node(child) if units > 0 => pending.push((child, probability)),
                _ => {}
            }
        }
    }
    all
}

impl Stage {
    /// The moments at one point.
    fn moments_at(&self, point: &Point<[f32; 3]>, number: u32, seed: u64) -> Moments {
        let count = self.lights.len() as u32;
        let contributions = self.contributions(point);
        let total: f64 = contributions.iter().sum();
        let power: f64 = self.powers.iter().map(|&x| f64::from(x)).sum();
        let published = self.published.all(point.p, point.n);
        let intensity = self.intensity.all(point.p, point.n);
        let own = own_pmf(self.own.get(), point);
        let pmf = |light: usize| {
            [
                1.0 / f64::from(count),
                f64::from(self.powers[light]) / power,
                published[light],
                intensity[light],
                own[light],
                contributions[light] / if total > 0.0 { total } else { 1.0 },
            ]
        };
        let (mut scratch, at, sequence) = (Scratch::default(), point.splat(), Independent::new(seed));
        let mut radiance = [[0.0; 2]; SAMPLES as usize];
        let (mut second, mut open) = ([0.0; METHODS.len()], [0.0; METHODS.len()]);
        let mut lost = [0; METHODS.len()];
        let mut culprit = Culprit::default();
        let per_group = (8 * GROUP) as u32;
        for start in (0..count).step_by(per_group as usize) {
            for replicate in 0..SAMPLES {
                let mut rays: [Rays; GROUP] = Default::default();
                let (mut lit, mut limit) = ([M8::splat(false); GROUP], [X8::lit(0.0); GROUP]);
                let (mut target, mut values) = ([u32x8::splat(0); GROUP], [X8::lit(0.0); GROUP]);
                for p in 0..GROUP {
                    let index = u32x8::new(std::array::from_fn(|k| start + (8 * p + k) as u32));
                    let within = M8::from_bits(index.simd_lt(u32x8::splat(count)).to_bitmask());
                    let index = X8::blend_uint(within, index, u32x8::splat(count - 1));
                    let u: Vec2<X8> = sequence.pair(u32x8::splat(number), index, replicate);
                    let (chosen, sample, value) = self.sample(index, Measure::SolidAngle, &at, u);
                    (rays[p], limit[p]) = self.shadow(&at, &sample);
                    (values[p], target[p]) = (value, chosen.shape);
                    lit[p] = within & value.gt(X8::lit(0.0));
                }
                let facing = lit;
                if facing.iter().any(|lanes| lanes.any()) {
                    self.surfaces.bvh.occluded(&rays, &mut lit, &limit, &target, &mut scratch);
                }
                for p in 0..GROUP {
                    let values = values[p].to_array();
                    for lane in (0..8).filter(|&lane| facing[p].lane(lane)) {
                        let light = start as usize + 8 * p + lane;
                        let (g, visible) = (f64::from(values[lane]), lit[p].lane(lane));
                        let pmf = pmf(light);
                        radiance[replicate as usize][0] += if visible { g } else { 0.0 };
                        radiance[replicate as usize][1] += g;
                        for (method, pmf) in pmf.into_iter().enumerate() {
                            if pmf <= 0.0 {
                                lost[method] += 1;
                                continue;
                            }
                            let moment = g * g / pmf / f64::from(SAMPLES);
                            open[method] += moment;
                            second[method] += if visible { moment } else { 0.0 };
                        }
                        let moment = if visible { g * g / pmf[OWN] } else { 0.0 };
                        if moment > culprit.share {
                            culprit = Culprit { light, share: moment, pmf: pmf[OWN], ideal: pmf[EXHAUSTIVE] };
                        }
                    }
                }
            }
        }
        culprit.share /= second[OWN];
        let squared: [f64; 2] = std::array::from_fn(|k| radiance[0][k] * radiance[1][k]);
        Moments {
            point: *point,
            squared: squared[0],
            variance: second.map(|s| s - squared[0]),
            open: open.map(|s| s - squared[1]),
            open_squared: squared[1],
            lost,
            culprit,
        }
    }
    /// The moments at these points.
    pub fn moments(&self, points: &[Point<[f32; 3]>], seed: u64) -> Vec<Moments> {
        (0..points.len()).into_par_iter().map(|k| self.moments_at(&points[k], k as u32, seed)).collect()
    }
}

/// A ratio of sums and half of its 95 % interval, to first order.
#[must_use]
pub fn ratio(pairs: impl Iterator<Item = (f64, f64)> + Clone) -> (f64, f64) {
    let (a, b) = pairs.clone().fold((0.0, 0.0), |(a, b), (x, y)| (a + x, b + y));
    let ratio = a / b;
    let squares: f64 = pairs.map(|(x, y)| (x - ratio * y).powi(2)).sum();
    (ratio, 1.96 * squares.sqrt() / b)
}
