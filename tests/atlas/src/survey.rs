//! Measures the errors and the cost of every technique over the sweeps.

use crate::irradiance::{NOTHING, biases, variance};
use crate::methods::{self, Method};
use crate::pose::{self, ShapeKind, Sweep};
use crate::truth::Truth;
use etendue_judge::lights::sampler::{Sample, Sampler};
use etendue_laboratory::cost::{self, Rounds};
use etendue_oracle::{Greatest, V3, cross, length, sub, unit, wide};
use rayon::prelude::*;
use std::hint::black_box;

/// Greatest error that the contract allows: of a pdf, of a direction relative to the shape's angular size, and of a round trip.
pub const LIMIT: f64 = 1e-5;
/// The contract also allows this error in each component of a direction: 2 ulp.
const DIRECTION_ULP: f64 = 2.0 * f32::EPSILON as f64;
/// It allows the same in each coordinate of u: 2 ulp of a number below 1.
const U_ULP: f64 = f32::EPSILON as f64;
/// Step of u for the derivatives of directions.
const STEP: f64 = 1.0 / 4_294_967_296.0;

/// The measurements of a cell; NaN if there was nothing to measure.
#[derive(Clone, Copy, Debug)]
pub struct Figures {
    /// Greatest error of a direction in any component, relative to the angular size or to 0.024, whichever is greater. At 0.024 the
    /// limit is 2 ulp. Where the map is so steep that 2 ulp of u turn the direction by more than the limit, it is the distance to the
    /// nearest true direction of a u that near.
    pub direction: f64,
    /// Greatest relative error of the pdf, in excess of the change that 2 ulp of the direction cause.
    pub pdf: f64,
    /// Greatest error of u after sampling and inverting, beyond 2 ulp of u. If 4 ulp of the direction (2 of the sample, 2 of the inverse)
    /// change u by more than the limit, the error is relative to that change, times the limit. Samples where they change u by more than 0.1 do not count,
    /// as f32 has no inverse there. At a discontinuity of the map (about the zenith, or between two parts) two values of u are equally
    /// good: there the error is the distance from the sample to the direction of the inverse, relative to 6 ulp (2 of each
    /// direction, 2 of the inverse), times the limit; or, if that is less, to the nearest true direction of a u within 2 ulp of the
    /// inverse, relative to 4 ulp.
    pub round_trip: f64,
    /// Fraction of the samples that have an inverse in f32.
    pub invertible: f64,
    /// Fraction of the samples with a NaN, an infinity, a pdf of 0 where there is light, or a positive pdf where there is none.
    pub invalid: f64,
    /// Variance of area sampling over that of the technique, for the irradiance of a diffuse receiver without shadows.
    pub variance_ratio: f64,
    /// Error of the mean estimate of that irradiance over a stratified set, relative to the closed form and beyond the error of the
    /// exact estimator on the same set; not for sampling by area. The receiver is the pose's for projected techniques; otherwise it faces the light.
    pub bias: f64,
}
impl Figures {
    const NONE: Self = Self {
        direction: f64::NAN,
        pdf: f64::NAN,
        round_trip: f64::NAN,
        invertible: f64::NAN,
        invalid: f64::NAN,
        variance_ratio: f64::NAN,
        bias: f64::NAN,
    };
    /// Whether there was a shape to measure: rounding may leave a polygon that is none.
    #[must_use]
    pub fn measured(&self) -> bool {
        !self.invalid.is_nan()
    }
    /// Whether all measured errors are within the contract.
    #[must_use]
    pub fn meets(&self) -> bool {
        let within = |x: f64| x.is_nan() || x <= LIMIT;
        [self.direction, self.pdf, self.round_trip].into_iter().all(within)
            && (self.invalid.is_nan() || self.invalid <= 0.0)
    }
}

/// The errors of one technique over one sweep.
#[derive(Clone, Debug)]
pub struct ErrorMap {
    /// ShapeKind of shape.
    pub kind: ShapeKind,
    /// Axes of the map.
    pub sweep: Sweep,
    /// Name of the technique, and whether it belongs to the library; otherwise it is a baseline.
    pub method: (String, bool),
    /// Cells row by row, from the bottom.
    pub cells: Vec<Figures>,
    /// Nanoseconds to prepare for a point and draw one sample, in scalar code.
    pub cost: f64,
    /// Nanoseconds for the same by area.
    pub area_cost: f64,
}
impl ErrorMap {
    /// Efficiency 1/(variance × cost), relative to area sampling.
    #[must_use]
    pub fn efficiency(&self, cell: &Figures) -> f64 {
        cell.variance_ratio * self.area_cost / self.cost
    }
}

/// How densely to measure.
#[derive(Clone, Copy, Debug)]
pub struct Detail {
    /// Number of rotated poses per cell.
    pub turns: u64,
    /// Number of samples per pose.
    pub samples: usize,
    /// Strata per dimension for the bias.
    pub strata: usize,
    /// Whether the axes are coarse.
    pub quick: bool,
}
impl Detail {
    /// Details for a coarse map (`quick`) or for a fine one.
    #[must_use]
    pub fn new(quick: bool) -> Self {
        if quick {
            Self { turns: 4, samples: 40, strata: 8, quick }
        } else {
            Self { turns: 12, samples: 128, strata: 16, quick }
        }
    }
}

/// Number of cells of these kinds of shapes.
#[must_use]
pub fn cells(kinds: &[ShapeKind], detail: Detail) -> usize {
    let of = |&kind: &ShapeKind| pose::sweeps(kind, detail.quick).iter().map(|s| s.x.len() * s.y.len()).sum::<usize>();
    kinds.iter().map(of).sum()
}

/// Measures these kinds of shapes, and calls `tick` after each cell.
pub fn survey(kinds: &[ShapeKind], detail: Detail, tick: impl Fn() + Sync) -> Vec<ErrorMap> {
    let mut charts = Vec::new();
    for &kind in kinds {
        for sweep in pose::sweeps(kind, detail.quick) {
            let cells: Vec<(f64, f64)> =
                sweep.y.iter().flat_map(|y| sweep.x.iter().map(|x| (x.value, y.value))).collect();
            let rows: Vec<Vec<Figures>> = cells
                .par_iter()
                .map(|&(x, y)| {
                    let figures = cell(kind, &sweep, [x, y], detail);
                    tick();
                    figures
                })
                .collect();
            let methods = methods::methods(kind);
            let costs = costs(kind, &sweep, &methods);
            let area_cost = methods.iter().position(Method::is_by_area).map_or(f64::NAN, |i| costs[i]);
            for (i, method) in methods.into_iter().enumerate() {
                let cells = rows.iter().map(|row| row[i]).collect();
                let method = (method.name, method.ours);
                charts.push(ErrorMap { kind, sweep: sweep.clone(), method, cells, cost: costs[i], area_cost });
            }
        }
    }
    charts
}

/// Nanoseconds to prepare for a point and draw one sample, of each method.
fn costs(kind: ShapeKind, sweep: &Sweep, methods: &[Method]) -> Vec<f64> {
    let us = pose::square(64, 1);
    let pose = sweep.pose(kind, if sweep.touches() { 2.0 } else { 0.3 }, 0.6, 1);
    let routine = |method| {
        let us = us.clone();
        move || {
            for u in &us {
                let sampler = Method::prepare(method, black_box(&pose));
                black_box(sampler.and_then(|sampler| sampler.sample(*u)));
            }
        }
    };
    let mut routines: Vec<_> = methods.iter().map(routine).collect();
    let times = cost::measure(&mut routines, Rounds { count: 21, calls: 32, samples: us.len() }, |_| true);
    times.iter().map(|t| cost::median(t)).collect()
}

/// The exact result for one `u`.
struct Reference {
    direction: V3,
    /// Greatest change of each coordinate of u per radian of the direction.
    sensitivity: [f64; 2],
}

fn reference(truth: &Truth, u: [f32; 2]) -> Reference {
    let u = u.map(f64::from);
    let direction = truth.direction(u);
    let slope = |axis: usize| -> V3 {
        // far less than the spacing of u, within which the slope changes at the ends of a sweep
        let h = if u[axis] < 0.5 { STEP } else { -STEP };
        let mut moved = u;
        moved[axis] += h;
        let w = truth.direction(moved);
        core::array::from_fn(|i| (w[i] - direction[i]) / h)
    };
    let (a, b) = (slope(0), slope(1));
    let area = length(cross(a, b));
    // without a derivative there is no inverse
    let per = |across: f64| if area > 0.0 { across / area } else { f64::INFINITY };
    Reference { direction, sensitivity: [per(length(b)), per(length(a))] }
}

/// Distance in any component from a direction to the nearest true direction of any u within 2 ulp; searches until it is at most
/// `enough`, and not at all if it is far more.
fn nearest(truth: &Truth, u: [f32; 2], w: V3, enough: f64) -> f64 {
    let distance = |a: V3, b: V3| sub(a, b).into_iter().map(f64::abs).collect::<Greatest>().error();
    // the inverse of a textbook's formula may be outside
    let center = u.map(|u| f64::from(u).clamp(0.0, LAST));
    let within = |x: f64, axis: usize| x.clamp((center[axis] - U_ULP).max(0.0), (center[axis] + U_ULP).min(LAST));
    let middle = truth.direction(center);
    let (mut best, mut at, mut reached) = (distance(w, middle), center, 0.0_f64);
    // finer and finer grids about the nearest point so far: the direction may turn within a small part of a step
    let (mut reach, mut points) = (U_ULP, 8);
    while best > enough && reach > U_ULP * 1e-8 {
        let from = at;
        for i in -points..=points {
            for j in -1..=1 {
                let moved = [
                    within(from[0] + reach * f64::from(i) / f64::from(points), 0),
                    within(from[1] + reach * f64::from(j), 1),
                ];
                let direction = truth.direction(moved);
                let off = distance(w, direction);
                reached = reached.max(distance(middle, direction));
                if off < best {
                    (best, at) = (off, moved);
                }
            }
        }
        if best > enough + 4.0 * reached {
            // no u that near has a direction that far from the middle
            break;
        }
        reach *= if points == 8 { 0.125 } else { 0.5 };
        points = 2;
    }
    best
}
/// The greatest u in f64.
const LAST: f64 = 1.0 - 0.5 * f64::EPSILON;

/// Measures one cell with all methods.
#[must_use]
pub fn cell(kind: ShapeKind, sweep: &Sweep, [x, y]: [f64; 2], detail: Detail) -> Vec<Figures> {
    let methods = methods::methods(kind);
    let mut tallies: Vec<_> = methods.iter().map(|_| Tally::default()).collect();
    for turn in 0..detail.turns {
        let light = sweep.pose(kind, x, y, turn);
        let Some(truth) = Truth::new(kind, &light) else { continue };
        let us = pose::square(detail.samples, turn);
        let seen = truth.measure > NOTHING && truth.measure.is_finite();
        let references: Vec<_> = if seen { us.iter().map(|&u| reference(&truth, u)).collect() } else { Vec::new() };
        for (method, tally) in methods.iter().zip(&mut tallies) {
            let Some(sampler) = method.prepare(&light) else { continue };
            for (i, &u) in us.iter().enumerate() {
                let sample = sampler.sample(u);
                match references.get(i) {
                    _ if method.is_by_area() => tally.add_by_area(&truth, u, sample),
                    Some(reference) => tally.add(&truth, reference, u, sample, &*sampler),
                    None => tally.count(sample.is_some_and(|s| !is_finite(&s) || truth.measure <= 0.0)),
                }
            }
        }
    }
    let pose = |turn| sweep.pose(kind, x, y, turn);
    let variances: Vec<_> = methods.iter().map(|m| variance(&pose(0), m)).collect();
    let by_area = methods.iter().position(Method::is_by_area).map_or(f64::NAN, |i| variances[i]);
    let biases = biases(kind, &pose(1), &methods, detail.strata);
    tallies
        .iter()
        .zip(&variances)
        .zip(biases)
        .map(|((tally, v), bias)| Figures { bias, ..tally.figures(by_area / v) })
        .collect()
}

fn is_finite(s: &Sample) -> bool {
    s.direction.iter().chain(&[s.pdf]).all(|x| x.is_finite())
}

#[derive(Default)]
struct Tally {
    /// Greatest errors, and the `u` of each.
    direction: Greatest<[f32; 2]>,
    pdf: Greatest<[f32; 2]>,
    round_trip: Greatest<[f32; 2]>,
    inverses: f64,
    inverted: f64,
    invalid: f64,
    /// Numbers of samples of a light that is seen, and of all.
    drawn: f64,
    all: f64,
}
impl Tally {
    /// Counts a sample, whether it is invalid.
    fn count(&mut self, is_invalid: bool) {
        self.all += 1.0;
        self.invalid += f64::from(u8::from(is_invalid));
    }
    /// Adds the error of a pdf, beyond what the rounding of the direction changes.
    fn add_pdf(&mut self, pdf: f32, [truth, slope]: [f64; 2], u: [f32; 2]) {
        let off = (f64::from(pdf) - truth).abs() - slope * DIRECTION_ULP;
        self.pdf.take(off.max(0.0) / truth.max(slope * DIRECTION_ULP), u);
    }
    /// Adds a sample that is uniform by area: of its direction nothing is known.
    fn add_by_area(&mut self, truth: &Truth, u: [f32; 2], sample: Option<Sample>) {
        self.count(sample.is_some_and(|s| !is_finite(&s)));
        let Some(s) = sample.filter(is_finite) else { return };
        self.drawn += 1.0;
        // a sphere hides half of itself
        if s.is_hidden && truth.seen.corners().is_empty() {
            return;
        }
        let density = truth.pdf_by_area(unit(wide(s.direction)));
        if density[0] > 0.0 {
            self.add_pdf(s.pdf, density, u);
        }
    }
    /// Adds a sample.
    fn add(
        &mut self,
        truth: &Truth,
        reference: &Reference,
        u: [f32; 2],
        sample: Option<Sample>,
        sampler: &dyn Sampler,
    ) {
        let Some(sample) = sample else {
            // within the rounding of a direction from the horizon, the pdf may be 0
            let there = truth.pdf(reference.direction);
            return self.count(there[0] > there[1] * 2.0 * DIRECTION_ULP);
        };
        let inverse = sampler.invert(sample.direction);
        let is_invalid = !is_finite(&sample) || inverse.is_some_and(|u| !u.iter().all(|u| u.is_finite()));
        self.count(is_invalid || sample.pdf < 0.0);
        if is_invalid {
            return;
        }
        self.drawn += 1.0;
        let w = wide(sample.direction);
        let apart = |a: V3| sub(w, a).into_iter().map(f64::abs).collect::<Greatest>().error();
        let size = truth.seen.size[0].max(DIRECTION_ULP / LIMIT);
        let mut error = apart(reference.direction) / size;
        if error > LIMIT {
            error = error.min(nearest(truth, u, w, LIMIT * size) / size);
        }
        self.direction.take(error, u);
        self.add_pdf(sample.pdf, truth.pdf(w), u);
        let Some(inverse) = inverse else { return };
        self.inverses += 1.0;
        let worth = reference.sensitivity.map(|s| 2.0 * DIRECTION_ULP * s);
        if worth[0].max(worth[1]) > 0.1 {
            return;
        }
        self.inverted += 1.0;
        let off = |axis: usize| {
            let mut error = f64::from((inverse[axis] - u[axis]).abs());
            if truth.periodic(axis) {
                error = error.min((1.0 - error).abs());
            }
            // the inverse is itself rounded
            (error - U_ULP).max(0.0) * (LIMIT / worth[axis]).min(1.0)
        };
        let mut error = off(0).max(off(1));
        if error > LIMIT {
            let again = sampler.sample(inverse).map_or([0.0; 3], |s| s.direction);
            error = error.min(apart(wide(again)) / (3.0 * DIRECTION_ULP) * LIMIT);
        }
        if error > LIMIT {
            let enough = 2.0 * DIRECTION_ULP;
            error = error.min(nearest(truth, inverse, w, enough) / enough * LIMIT);
        }
        self.round_trip.take(error, u);
    }
    fn figures(&self, variance_ratio: f64) -> Figures {
        if self.all == 0.0 {
            return Figures::NONE;
        }
        let if_any = |n: f64, x: f64| if n > 0.0 { x } else { f64::NAN };
        Figures {
            direction: self.direction.measured(),
            pdf: self.pdf.measured(),
            round_trip: self.round_trip.measured(),
            invertible: if_any(self.inverses, self.inverted / self.inverses),
            invalid: self.invalid / self.all,
            variance_ratio: if_any(self.drawn, variance_ratio),
            bias: f64::NAN,
        }
    }
}
