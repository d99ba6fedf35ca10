//! What a sampler is asked at a place, and what it answers.

use super::definition::{Chart, Definition, SIDE, middles};
use super::sampler::{Lacks, Sample, Sampler};
use crate::area_lights::Measure;
use crate::generators::{EDGES, Random, square};
use etendue_oracle::{V3, along, length, narrow, sub, unit, wide};

/// Independent sets of samples, whose spread tells how far their mean may be off.
pub const SETS: usize = 16;
/// Pairs of edges of the unit square, which come before the sets.
pub const CORNERS: usize = EDGES.len() * EDGES.len();
/// Places at which the map's derivative is taken, with four points each, which come after the sets.
pub const SLOPES: usize = 16;
/// Step in u of the derivative to either side.
pub const STEP: f64 = 1.0 / 64.0;

const EPSILON: f32 = 1.0 / 16_777_216.0;
/// What single precision does to an inverse, which is a share of a whole: the sum of the areas before a direction has up to five terms, one
/// for each side that a horizon leaves of a quadrilateral; their whole, the quotient and the product with the rest are rounded too. Each
/// changes the share by up to 2⁻²⁴. Where a map begins in a corner, whose areas grow with the square of the distance, that is visible:
/// 2⁻²⁴ of the square is 1/4096 of the light's length there.
const ROUNDINGS: f32 = 8.0 * EPSILON;

/// What is asked.
#[derive(Clone, Debug)]
pub struct Questions {
    /// Strata per dimension in each set.
    pub strata: usize,
    /// Points of the unit square: corners and edges, the sets one after another, and those of the derivatives.
    pub us: Vec<[f32; 2]>,
    /// The chart of what is claimed.
    pub chart: Chart,
    /// Directions of the light, row by row: uniform in the chart, then those of the definition's grid, if they are others.
    pub directions: Vec<[f32; 3]>,
    /// Directions a little outside of the light.
    pub outside: Vec<[f32; 3]>,
}

impl Questions {
    /// For a light as it is seen from its point.
    #[must_use]
    pub fn new(seen: &Definition, by: Measure, quick: bool, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let strata = if quick { 24 } else { 48 };
        let mut us = square(0, 0);
        for _ in 0..SETS {
            us.extend((0..strata * strata).map(|i| {
                let mut at = |k: usize| {
                    let x = (k as f32 + random.unit()) / strata as f32;
                    x.min(1.0 - 1.0 / 16_777_216.0)
                };
                [at(i % strata), at(i / strata)]
            }));
        }
        for _ in 0..SLOPES {
            let [x, y] = [(); 2].map(|()| 0.1 + 0.8 * random.unit());
            let step = STEP as f32;
            us.extend([[x - step, y], [x + step, y], [x, y - step], [x, y + step], [x, y]]);
        }
        let chart = if by == Measure::Area { Chart::Area } else { Chart::SolidAngle };
        let mut directions: Vec<[f32; 3]> = Vec::new();
        if chart == Chart::Area || seen.has_limb() {
            directions.extend(middles().map(|u| narrow(seen.at(chart, u).0)));
        }
        directions.extend(seen.grid().iter().map(|w| narrow(*w)));
        let outside = Self::outside(seen, chart, &mut random);
        Self { strata, us, chart, directions, outside }
    }
    /// Beyond the boundary by a fiftieth of the light's width, where that is more than the rounding of a direction, and of where it meets
    /// the light's plane.
    fn outside(seen: &Definition, chart: Chart, random: &mut Random) -> Vec<[f32; 3]> {
        let least = (0.02 * seen.size[1]).max(1e-5 + 16.0 * seen.rounding);
        if seen.size[0] > 1.2 || seen.is_inside() {
            return Vec::new();
        }
        let middle = seen.at(chart, [0.5, 0.5]).0;
        let one = |_| {
            let (t, side) = (random.unit_f64(), random.word() % 4);
            let u = [[t, 0.0], [t, 1.0], [0.0, t], [1.0, t]][side as usize];
            let edge = seen.at(chart, u).0;
            let far = least.max(seen.blur(edge));
            let out = sub(edge, middle);
            let w = unit(along(edge, out, 2.0 * far / length(out).max(1e-300)));
            (seen.beyond(wide(narrow(w))) > far).then_some(narrow(w))
        };
        (0..24).filter_map(one).collect()
    }
    /// Index of the grid's first direction.
    #[must_use]
    pub fn partner(&self) -> usize {
        self.directions.len() - SIDE * SIDE
    }
    /// The points of a set.
    #[must_use]
    pub fn set(&self, i: usize) -> core::ops::Range<usize> {
        let n = self.strata * self.strata;
        CORNERS + i * n..CORNERS + (i + 1) * n
    }
    /// Number of points whose samples are looked at one by one.
    #[must_use]
    pub fn single(&self) -> usize {
        CORNERS + self.strata * self.strata
    }
}

/// The inverse of a sample.
#[derive(Clone, Debug)]
pub struct Inverse {
    /// The index of the sample's own `u`.
    pub of: usize,
    /// What is answered.
    pub u: [f32; 2],
    /// What it draws, moved into the square, and then what is drawn eight units of 2⁻²⁴ to each side of it.
    pub again: [Option<Sample>; 5],
}
impl Inverse {
    fn new(sampler: &dyn Sampler, of: usize, u: [f32; 2]) -> Self {
        let again = |x: f32, y: f32| {
            let moved = [u[0] + x * ROUNDINGS, u[1] + y * ROUNDINGS].map(|x| x.clamp(0.0, 1.0 - EPSILON));
            if u.iter().all(|x| x.is_finite()) { sampler.sample(moved) } else { None }
        };
        Self { of, u, again: [(0.0, 0.0), (-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0)].map(|(x, y)| again(x, y)) }
    }
}

/// What is answered.
#[derive(Clone, Debug, Default)]
pub struct Answers {
    /// A sample for each `u`.
    pub samples: Vec<Option<Sample>>,
    /// The pdf evaluated for the first samples; empty if it was not.
    pub evaluated: Vec<f32>,
    /// The pdf of each direction; empty if the sampler evaluates none.
    pub pdfs: Vec<f32>,
    /// The pdf of each direction outside.
    pub outside: Vec<f32>,
    /// Inverses of some samples.
    pub inverses: Vec<Inverse>,
    /// Distances of the light in the direction of some samples, by the index of their `u`.
    pub hits: Vec<(usize, f32)>,
}

/// Asks a sampler what it does not lack.
#[must_use]
pub fn ask(sampler: &dyn Sampler, questions: &Questions, lacks: Lacks) -> Answers {
    let samples: Vec<_> = questions.us.iter().map(|&u| sampler.sample(u)).collect();
    let single = &samples[..questions.single()];
    let mut answers = Answers::default();
    if !lacks.pdf {
        let pdf = |w: &[f32; 3]| sampler.pdf(*w);
        answers.evaluated = single.iter().map(|s| s.map_or(0.0, |s| sampler.pdf(s.direction))).collect();
        answers.pdfs = questions.directions.iter().map(pdf).collect();
        answers.outside = questions.outside.iter().map(pdf).collect();
    }
    let drawn = samples.iter().enumerate().filter_map(|(i, s)| s.filter(|s| !s.is_hidden).map(|s| (i, s)));
    for (i, s) in drawn.step_by(7).take(64) {
        if let Some(u) = sampler.invert(s.direction).filter(|_| !lacks.map) {
            answers.inverses.push(Inverse::new(sampler, i, u));
        }
        if let Some(distance) = sampler.hit(s.direction) {
            answers.hits.push((i, distance));
        }
    }
    answers.samples = samples;
    answers
}

/// A direction of single precision in double precision, of length 1.
#[must_use]
pub fn direction(w: [f32; 3]) -> V3 {
    unit(wide(w))
}
