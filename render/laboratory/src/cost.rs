//! Time per sample: the one way in which the benchmarks measure it.
//!
//! Every routine is called once to warm up. Then the routines take turns, round after round (A B C A B C …), so that a change of the
//! processor's clock or another program affects all of them alike. Each value is the mean over a few calls. The [`median`] over the rounds
//! leaves out the rounds that were interrupted.
//!
//! A routine must pass its results to [`black_box`](std::hint::black_box), and its arguments must come from there or from memory.

use std::time::Instant;

/// How much to measure.
#[derive(Clone, Copy, Debug)]
pub struct Rounds {
    /// Number of rounds, in each of which every routine is timed once.
    pub count: usize,
    /// Number of calls that are timed together.
    pub calls: u32,
    /// Number of samples that a call computes.
    pub samples: usize,
}

/// Nanoseconds per sample of each routine, one value per round. `go_on` gets the number of finished rounds and says whether to continue.
pub fn measure<F: FnMut()>(routines: &mut [F], rounds: Rounds, mut go_on: impl FnMut(usize) -> bool) -> Vec<Vec<f64>> {
    let mut times = vec![Vec::with_capacity(rounds.count); routines.len()];
    routines.iter_mut().for_each(|routine| routine());
    for round in 0..rounds.count {
        for (routine, times) in routines.iter_mut().zip(&mut times) {
            let start = Instant::now();
            for _ in 0..rounds.calls {
                routine();
            }
            let samples = f64::from(rounds.calls) * rounds.samples as f64;
            times.push(start.elapsed().as_secs_f64() * 1e9 / samples);
        }
        if !go_on(round + 1) {
            break;
        }
    }
    times
}

/// The median, or the upper of the two middle values; NaN without values.
#[must_use]
pub fn median(values: &[f64]) -> f64 {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;
    use std::time::Duration;

    #[test]
    fn routines_take_turns() {
        let calls = RefCell::new(String::new());
        let mut routines = [('a', 1), ('b', 4)].map(|(name, milliseconds)| {
            let calls = &calls;
            move || {
                calls.borrow_mut().push(name);
                std::thread::sleep(Duration::from_millis(milliseconds));
            }
        });
        let times = measure(&mut routines, Rounds { count: 9, calls: 2, samples: 10 }, |done| done < 3);
        assert_eq!(calls.into_inner(), "abaabbaabbaabb");
        assert!(times.iter().all(|t| t.len() == 3));
        let [a, b] = [0, 1].map(|k| median(&times[k]));
        assert!(a >= 1e5 && b >= 4e5, "{a} {b}");
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert!(median(&[]).is_nan());
    }
}
