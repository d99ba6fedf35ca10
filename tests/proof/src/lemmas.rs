//! The errors of elementary functions, by trying all arguments.

use crate::limits::{self, Error};
use etendue::{Real, f32x8};
use etendue_oracle::Greatest;
use rayon::prelude::*;

/// The slack for the reference, `libm` in double precision, whose errors are below 1 ulp: relative to the argument.
const REFERENCE: f64 = 1e-15;

/// A function of the core, and how far it may be from the true one.
pub struct Lemma {
    /// What it says.
    pub statement: &'static str,
    most: f32,
    limits: [Error; 4],
    routine: fn(f32x8) -> [f32x8; 2],
    /// The errors of what is computed for an argument.
    errors: fn(f64, [f64; 2]) -> [f64; 4],
}

/// What was found for a lemma.
pub struct LemmaErrors {
    /// How many arguments were tried.
    pub tried: u64,
    /// For sine, cosine, the component along and the one across: the greatest error and the greatest error over the argument, each with its argument.
    pub greatest: [[Greatest<f32>; 2]; 4],
    /// Whether all errors are within the limits.
    pub holds: bool,
}

/// All lemmas on which the theorems stand.
#[must_use]
pub fn all() -> Vec<Lemma> {
    vec![
        Lemma {
            statement: "sin_cos_turns: sine and cosine of x turns, x in [0, 1]",
            most: 1.0,
            limits: wave_limits(limits::TURNS),
            routine: |x| x.sin_cos_turns().into(),
            errors: |x, computed| wave_errors(core::f64::consts::TAU * x, computed),
        },
        Lemma {
            statement: "sin_cos_quarters: sine and cosine of x quarter turns, x in [0, 0.51]",
            most: limits::MOST_QUARTERS as f32,
            limits: wave_limits(limits::QUARTERS),
            routine: |x| x.sin_cos_quarters().into(),
            errors: |x, computed| wave_errors(core::f64::consts::FRAC_PI_2 * x, computed),
        },
        Lemma {
            statement: "atan_eighth: arc tangent of x, x in [0, 0.42]",
            most: limits::EIGHTH as f32,
            limits: [limits::ATAN_EIGHTH; 4],
            routine: |x| [x.atan_eighth(); 2],
            errors: |x, computed| [computed[0] - libm::atan(x); 4],
        },
    ]
}

fn wave_limits(limits: limits::WaveError) -> [Error; 4] {
    [limits.sin, limits.cos, limits.along, limits.across]
}
/// The errors of a sine and a cosine: each, along the true direction, and across.
fn wave_errors(angle: f64, [sin, cos]: [f64; 2]) -> [f64; 4] {
    let (s, c) = libm::sincos(angle);
    let (ds, dc) = (sin - s, cos - c);
    [ds, dc, ds * s + dc * c, ds * c - dc * s]
}

impl Lemma {
    /// Tries all numbers of single precision in the domain; if not `whole`, all from 2⁻⁸ up, and below every 1,021st. Negative arguments give
    /// the same results but for signs, which a test checks.
    #[must_use]
    pub fn check(&self, whole: bool) -> LemmaErrors {
        const CHUNK: u32 = 1 << 16;
        let dense = if whole { 0 } else { (1.0_f32 / 256.0).to_bits() };
        let last = self.most.to_bits();
        let chunks: Vec<u32> = (0..=last / CHUNK).collect();
        let none = || (0_u64, [[Greatest::NONE; 2]; 4]);
        let (tried, greatest) = chunks
            .into_par_iter()
            .map(|chunk| {
                let mut found = none();
                let step = if chunk * CHUNK >= dense { 1 } else { 1021 };
                let mut bits = chunk * CHUNK;
                let end = (chunk + 1).saturating_mul(CHUNK).min(last + 1);
                while bits < end {
                    let x = f32x8::from_fn(|k| f32::from_bits((bits + k as u32 * step).min(last)));
                    let results = (self.routine)(x);
                    for k in 0..8 {
                        let computed = results.map(|r| f64::from(r.lane(k)));
                        let errors = (self.errors)(f64::from(x.lane(k)), computed);
                        for (most, error) in found.1.iter_mut().zip(errors) {
                            let error = error.abs() + REFERENCE * f64::from(x.lane(k)).min(1.0);
                            let over = if x.lane(k) >= f32::MIN_POSITIVE { error / f64::from(x.lane(k)) } else { 0.0 };
                            most[0].take(error, x.lane(k));
                            most[1].take(over, x.lane(k));
                        }
                    }
                    found.0 += 8;
                    bits += 8 * step;
                }
                found
            })
            .reduce(none, |mut a, b| {
                a.0 += b.0;
                for (a, b) in a.1.iter_mut().flatten().zip(b.1.into_iter().flatten()) {
                    b.at().into_iter().for_each(|at| a.take(b.error(), at));
                }
                a
            });
        let holds = greatest
            .iter()
            .zip(self.limits)
            .all(|(found, limit)| found[0].error() <= limit.absolute && found[1].error() <= limit.slope);
        LemmaErrors { tried, greatest, holds }
    }
}
