//! Branch and bound: divides a box until a theorem holds on every part.

use crate::defect::{self, Defect};
use crate::tape;
use crate::traced::Traced;
use etendue::{Real, Vec2, f32x8};
use etendue_oracle::Random;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// The values of one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Multiples of 2⁻²⁴, from and to these.
    Steps(u32, u32),
    /// Numbers of single precision about 1 and below, divided at the mean.
    Linear(f32, f32),
    /// Positive numbers of single precision, divided at the geometric mean.
    Logarithmic(f32, f32),
}

impl Range {
    /// All values of a random number in [0, 1).
    pub const UNIT: Self = Self::Steps(0, (1 << 24) - 1);

    /// The values as the parameter of this index.
    #[must_use]
    pub fn traced(self, index: usize) -> Traced {
        match self {
            Self::Steps(from, to) => Traced::steps(from, to, index),
            Self::Linear(lo, hi) | Self::Logarithmic(lo, hi) => Traced::range(lo, hi, index),
        }
    }
    /// The parameters of a part.
    #[must_use]
    pub fn all_traced(part: &[Self]) -> Vec<Traced> {
        part.iter().enumerate().map(|(index, range)| range.traced(index)).collect()
    }
    /// Two halves that have no number in common; `None` for one number.
    #[must_use]
    pub fn halves(self) -> Option<[Self; 2]> {
        let at = |lo: f32, hi: f32, middle: f32| {
            (lo < hi).then(|| {
                let middle = middle.clamp(lo, hi.next_down());
                [(lo, middle), (middle.next_up(), hi)]
            })
        };
        match self {
            Self::Steps(from, to) => {
                let middle = from + (to - from) / 2;
                (from < to).then(|| [Self::Steps(from, middle), Self::Steps(middle + 1, to)])
            }
            Self::Linear(lo, hi) => {
                at(lo, hi, (0.5 * (f64::from(lo) + f64::from(hi))) as f32).map(|h| h.map(|(a, b)| Self::Linear(a, b)))
            }
            Self::Logarithmic(lo, hi) => at(lo, hi, (f64::from(lo) * f64::from(hi)).sqrt() as f32)
                .map(|h| h.map(|(a, b)| Self::Logarithmic(a, b))),
        }
    }
    /// The value at a fraction of the range.
    #[must_use]
    pub fn at(self, fraction: f64) -> Self {
        match self {
            Self::Steps(from, to) => {
                let step = from + (fraction * f64::from(to - from)).round() as u32;
                Self::Steps(step, step)
            }
            Self::Linear(lo, hi) => {
                let x = (f64::from(lo) + fraction * (f64::from(hi) - f64::from(lo))) as f32;
                Self::Linear(x.clamp(lo, hi), x.clamp(lo, hi))
            }
            Self::Logarithmic(lo, hi) => {
                let x = (f64::from(lo) * (f64::from(hi) / f64::from(lo)).powf(fraction)) as f32;
                Self::Logarithmic(x.clamp(lo, hi), x.clamp(lo, hi))
            }
        }
    }
    /// A number of one value.
    #[must_use]
    pub fn value(self) -> f64 {
        match self {
            Self::Steps(from, _) => f64::from(from) / 16_777_216.0,
            Self::Linear(lo, _) | Self::Logarithmic(lo, _) => f64::from(lo),
        }
    }
    /// The logarithm of the number of values; of a linear range, as if they were 2⁻²⁴ apart.
    fn bits(self) -> f64 {
        let values = match self {
            Self::Steps(from, to) => f64::from(to - from) + 1.0,
            Self::Linear(lo, hi) => (f64::from(hi) - f64::from(lo)) * f64::from(1 << 24) + 1.0,
            Self::Logarithmic(lo, hi) => f64::from(hi.to_bits() - lo.to_bits()) + 1.0,
        };
        values.log2()
    }
}

/// What a theorem bounds.
#[derive(Clone, Debug)]
pub struct Limit {
    /// The quantity and its unit.
    pub what: &'static str,
    /// Its greatest value.
    pub most: f64,
}

/// What is tried instead of proved, one pair u by one.
pub struct Trial {
    /// What holds for all of them.
    pub what: &'static str,
    /// These ranges of u₀ and u₁.
    pub ranges: Vec<[(u32, u32); 2]>,
    /// Whether it holds for eight pairs.
    pub holds: fn(Vec2<f32x8>) -> bool,
}
impl Trial {
    /// Tries all pairs, and returns how many; `None` if one fails.
    #[must_use]
    pub fn run(&self) -> Option<u64> {
        let count = |range: (u32, u32)| u64::from(range.1 - range.0) + 1;
        let u = |step: u32| step as f32 / 16_777_216.0;
        let holds = self.ranges.iter().all(|&[x, y]| {
            (y.0 / 4096..=y.1 / 4096).into_par_iter().all(|block| {
                let (from, to) = (y.0.max(block * 4096), y.1.min(block * 4096 + 4095));
                (x.0..=x.1).all(|x| {
                    (from..=to).step_by(8).all(|y| {
                        let y = f32x8::from_fn(|k| u((y + k as u32).min(to)));
                        (self.holds)(Vec2::new(f32x8::splat(u(x)), y))
                    })
                })
            })
        });
        holds.then(|| self.ranges.iter().map(|&[x, y]| count(x) * count(y)).sum())
    }
}

/// What a theorem states.
#[derive(Clone, Debug)]
pub struct Statement {
    /// Name of the routine.
    pub name: &'static str,
    /// The box of the parameters, in words.
    pub domain: String,
    /// That box.
    pub ranges: Vec<Range>,
    /// What is bounded.
    pub limits: Vec<Limit>,
}

/// A statement about all values of the parameters, and how it follows from the routine.
pub trait Theorem: Sync {
    /// What is stated.
    fn statement(&self) -> Statement;
    /// Runs the routine itself: what it returns for some of its results.
    fn run(&self, x: &[f32]) -> Vec<f32>;
    /// Traces the same results.
    fn trace(&self, x: &[Traced]) -> Vec<Traced>;
    /// Runs the routine and bounds its errors on the path that it takes, in the order of the limits. Infinite where nothing is known.
    fn bounds(&self, x: &[Traced]) -> Vec<f64>;
    /// What is tried and not proved.
    fn trial(&self) -> Option<Trial> {
        None
    }
    /// Runs the routine at a point, and returns its results in exact arithmetic beside those of an independent formula, and
    /// a scale for their difference.
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]>;
}

/// The outcome of a proof.
#[derive(Clone, Debug)]
pub struct Proof {
    /// The greatest bound of each limit over all parts.
    pub greatest: Vec<f64>,
    /// The number of parts.
    pub boxes: u64,
    /// A part on which the theorem was not proved, with its bounds.
    pub failed: Option<(Vec<Range>, Vec<f64>)>,
}

/// More paths than this through one part are not followed: it is divided instead.
const MOST_PATHS: usize = 64;

/// The greatest bounds over all paths through a part; stops early where a limit is passed, if `hasty`.
fn bounds(theorem: &dyn Theorem, limits: &[Limit], part: &[Range], hasty: bool) -> Vec<f64> {
    let mut greatest = vec![0.0_f64; limits.len()];
    let complete = tape::all_paths(
        MOST_PATHS,
        || {
            defect::begin();
            theorem.bounds(&Range::all_traced(part))
        },
        |bounds| {
            assert_eq!(bounds.len(), greatest.len(), "{}: a bound for each limit", theorem.statement().name);
            for (most, bound) in greatest.iter_mut().zip(bounds) {
                *most = if bound.is_nan() { f64::INFINITY } else { most.max(bound) };
            }
            !hasty || score(&greatest, limits) <= 1.0
        },
    );
    let passed = hasty && score(&greatest, limits) > 1.0;
    if !complete && !passed {
        greatest.fill(f64::INFINITY);
    }
    greatest
}
/// The greatest bound over its limit.
fn score(bounds: &[f64], limits: &[Limit]) -> f64 {
    let over = |(bound, limit): (&f64, &Limit)| if *bound == 0.0 { 0.0 } else { bound / limit.most };
    bounds.iter().zip(limits).map(over).fold(0.0, f64::max)
}

/// The two parts after the division that brings the bounds nearest to their limits.
fn divide(theorem: &dyn Theorem, limits: &[Limit], part: &[Range]) -> Option<[Vec<Range>; 2]> {
    let mut best = None;
    let mut least = (f64::INFINITY, f64::INFINITY);
    for (i, range) in part.iter().enumerate() {
        let Some(halves) = range.halves() else { continue };
        let parts = halves.map(|half| {
            let mut part = part.to_vec();
            part[i] = half;
            part
        });
        let score = |part: &[Range]| {
            let score = score(&bounds(theorem, limits, part, false), limits);
            // finite, so that one of two infinite halves is better than both
            if score.is_finite() { score.max(1.0).ln() } else { 1e3 }
        };
        let both = if let Range::Linear(..) = range {
            // the halves of what contains 0 may have the same squares, so look further: at a quarter
            let mut quarter = parts[1].clone();
            if let Some([_, upper]) = quarter[i].halves() {
                quarter[i] = upper;
            }
            2.0 * score(&quarter)
        } else {
            score(&parts[0]) + score(&parts[1])
        };
        // a small gain may be chance: then the one with the most values
        let key = ((16.0 * both).round(), -range.bits());
        if best.is_none() || key < least {
            (least, best) = (key, Some(parts));
        }
    }
    best
}

/// Proves a theorem, with at most this many parts and divisions.
#[must_use]
pub fn prove(theorem: &dyn Theorem, most_boxes: u64) -> Proof {
    let Statement { ranges, limits, .. } = theorem.statement();
    let defect = defect::planted();
    let none = || Proof { greatest: vec![0.0; limits.len()], boxes: 0, failed: None };
    // many parts at first, so that all threads have work
    let (mut open, mut done) = (vec![ranges], none());
    while !open.is_empty() && open.len() < 256 && done.boxes < 1000 {
        let mut next = Vec::new();
        for part in open {
            step(theorem, &limits, part, &mut done, &mut next);
        }
        if done.failed.is_some() {
            return done;
        }
        open = next;
    }
    let boxes = AtomicU64::new(done.boxes);
    let parts = open.into_par_iter().map(|part| {
        defect::plant(defect);
        let (mut open, mut done) = (vec![part], none());
        while let Some(part) = open.pop() {
            if boxes.fetch_add(1, Ordering::Relaxed) > most_boxes {
                let bounds = bounds(theorem, &limits, &part, false);
                done.failed = Some((part, bounds));
                break;
            }
            step(theorem, &limits, part, &mut done, &mut open);
            if done.failed.is_some() {
                break;
            }
        }
        done
    });
    parts.chain(rayon::iter::once(done)).reduce(none, |mut a, b| {
        for (a, b) in a.greatest.iter_mut().zip(&b.greatest) {
            *a = a.max(*b);
        }
        a.boxes += b.boxes;
        a.failed = a.failed.or(b.failed);
        a
    })
}

/// Proves one part, or divides it.
fn step(theorem: &dyn Theorem, limits: &[Limit], part: Vec<Range>, done: &mut Proof, open: &mut Vec<Vec<Range>>) {
    let bounds = bounds(theorem, limits, &part, true);
    if score(&bounds, limits) <= 1.0 {
        for (most, bound) in done.greatest.iter_mut().zip(&bounds) {
            *most = most.max(*bound);
        }
        done.boxes += 1;
        return;
    }
    match divide(theorem, limits, &part) {
        Some(halves) => open.extend(halves),
        None => done.failed = Some((part, bounds)),
    }
}

/// Tries points spread over the box. Returns the greatest difference, over its scale, of the routine in exact arithmetic from its
/// definition, and where that is; it is infinite if the routine itself leaves the intervals or the bounds of its errors.
#[must_use]
pub fn try_points(theorem: &dyn Theorem, points: u64) -> (f64, Vec<f64>) {
    let ranges = theorem.statement().ranges;
    let defect = defect::planted();
    // these defects are in the traced routine alone
    let is_the_same_routine = !matches!(defect, Defect::Constant { .. } | Defect::NoClamp(_));
    (0..points)
        .into_par_iter()
        .map(|i| {
            let point: Vec<Range> =
                ranges.iter().enumerate().map(|(k, range)| range.at(fraction(i, k as u64))).collect();
            let values: Vec<f64> = point.iter().map(|range| range.value()).collect();
            let mut greatest = 0.0_f64;
            let numbers: Vec<f32> = values.iter().map(|x| *x as f32).collect();
            let computed = theorem.run(&numbers);
            defect::plant(defect);
            let mut follows_a_path = false;
            tape::all_paths(
                MOST_PATHS,
                || {
                    defect::begin();
                    theorem.trace(&Range::all_traced(&point))
                },
                |traced| {
                    let encloses = |(x, computed): (&Traced, &f32)| x.encloses(f64::from(*computed));
                    follows_a_path |= traced.iter().zip(&computed).all(encloses);
                    true
                },
            );
            if !follows_a_path && is_the_same_routine {
                greatest = f64::INFINITY;
            }
            tape::all_paths(
                MOST_PATHS,
                || {
                    defect::begin();
                    theorem.definition(&Range::all_traced(&point), &values)
                },
                |pairs| {
                    for [routine, truth, scale] in pairs {
                        let difference = (routine - truth).abs() / scale;
                        greatest = if difference.is_nan() { f64::INFINITY } else { greatest.max(difference) };
                    }
                    true
                },
            );
            (greatest, values)
        })
        .reduce(|| (0.0, Vec::new()), |a, b| if b.0 > a.0 { b } else { a })
}

/// A hash of point and parameter as a number in [0, 1).
fn fraction(point: u64, parameter: u64) -> f64 {
    let point = point.wrapping_mul(31).wrapping_add(parameter).wrapping_add(1);
    Random(point.wrapping_mul(0x9e37_79b9_7f4a_7c15)).unit()
}
