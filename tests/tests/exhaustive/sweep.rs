//! Goes over many inputs on all processors, keeps the greatest errors, and compares them with the documented ones.

use core::fmt::Write;
use etendue_oracle::Greatest;
use rayon::prelude::*;
use std::time::Instant;

/// Which inputs are taken: all, or one packet of [`SPARSE`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Extent {
    All,
    Part,
}

/// A prime, so that all patterns of the low bits occur.
pub(crate) const SPARSE: u64 = 257;

/// What the documentation states: the greatest error, rounded up, and the input at which it occurs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Figure {
    pub(crate) of: &'static str,
    pub(crate) documented: f64,
    /// The first of them if there are several.
    pub(crate) worst: u64,
}

/// What was found at the inputs so far.
#[derive(Clone, Debug)]
pub(crate) struct SweepErrors<const M: usize> {
    errors: [Greatest<u64>; M],
    counted: [u64; M],
    /// How many inputs are outside of the domain.
    outside: u64,
    broken: u64,
    first_broken: Option<(u64, &'static str)>,
}

impl<const M: usize> SweepErrors<M> {
    pub(crate) fn new() -> Self {
        Self { errors: [Greatest::NONE; M], counted: [0; M], outside: 0, broken: 0, first_broken: None }
    }
    /// Takes the error of one input into account: the one of a figure.
    pub(crate) fn error(&mut self, figure: usize, error: f64, at: u64) {
        self.counted[figure] += 1;
        self.errors[figure].take(error, at);
    }
    /// An input for which the documentation states more than an error.
    pub(crate) fn demand(&mut self, what: &'static str, holds: bool, at: u64) {
        if !holds {
            self.broken += 1;
            self.first_broken.get_or_insert((at, what));
        }
    }
    /// An input outside of the domain, for which the documentation states what is returned.
    pub(crate) fn outside(&mut self, what: &'static str, holds: bool, at: u64) {
        self.outside += 1;
        self.demand(what, holds, at);
    }
    /// An input for which nothing is promised.
    pub(crate) fn unspecified(&mut self) {
        self.outside += 1;
    }
    /// The union of two parts. Of equal errors it keeps the one with the least input, so that the result does not depend on threads.
    fn merge(&mut self, other: &Self) {
        for (k, theirs) in other.errors.iter().enumerate() {
            self.counted[k] += other.counted[k];
            let Some(at) = theirs.at() else { continue };
            let ours = &mut self.errors[k];
            if theirs.measured() == ours.measured() && Some(at) < ours.at() {
                *ours = Greatest::NONE;
            }
            ours.take(theirs.measured(), at);
        }
        self.outside += other.outside;
        self.broken += other.broken;
        self.first_broken = match (self.first_broken, other.first_broken) {
            (Some(a), Some(b)) => Some(if b.0 < a.0 { b } else { a }),
            (a, b) => a.or(b),
        };
    }
    /// Prints the figures and returns what contradicts the documentation.
    pub(crate) fn against(
        &self,
        name: &str,
        figures: &[Figure; M],
        extent: Extent,
        show: impl Fn(u64) -> String,
    ) -> String {
        let mut faults = String::new();
        let mut fault = |text: String| {
            println!("    FAULT {text}");
            writeln!(faults, "{name}: {text}").expect("text");
        };
        for (k, figure) in figures.iter().enumerate() {
            let Figure { of, documented, worst } = *figure;
            let error = self.errors[k].measured();
            let Some(at) = self.errors[k].at() else {
                fault(format!("{of}: no input"));
                continue;
            };
            let inputs = self.counted[k];
            println!("    {name}, {of}: {error:.4e} at {}, documented {documented:.2e}; {inputs} inputs", show(at));
            if error > documented {
                fault(format!("{of}: {error:e} at {}, more than the documented {documented:e}", show(at)));
            }
            if error < 0.9 * documented {
                fault(format!("{of}: the documented {documented:e} can be tightened to {error:e}"));
            }
            if extent == Extent::All && at != worst {
                fault(format!("{of}: the worst input is {} and not {}", show(at), show(worst)));
            }
        }
        if self.outside > 0 {
            println!("    {name}: {} inputs outside of the domain", self.outside);
        }
        if let Some((at, what)) = self.first_broken {
            fault(format!("not {what}: {} inputs, the first is {}", self.broken, show(at)));
        }
        faults
    }
}

/// Runs `each` for the numbers below `chunks`, on all processors, and merges what they found.
pub(crate) fn on_all_processors<const M: usize>(
    name: &str,
    chunks: u64,
    each: impl Fn(u64, &mut SweepErrors<M>) + Sync,
) -> SweepErrors<M> {
    let start = Instant::now();
    let parts = (0..chunks).into_par_iter().fold(SweepErrors::new, |mut found, chunk| {
        each(chunk, &mut found);
        found
    });
    let found = parts.reduce(SweepErrors::new, |mut sum, part| {
        sum.merge(&part);
        sum
    });
    println!("{name}: {:.1?}", start.elapsed());
    found
}
