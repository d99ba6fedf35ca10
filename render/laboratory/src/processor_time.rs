//! The time that the processors spend for this program.

/// Seconds that all threads of the program have run so far, together; `None` where the system does not tell.
#[cfg(unix)]
#[must_use]
pub fn processor_seconds() -> Option<f64> {
    use nix::time::{ClockId, clock_gettime};
    let time = clock_gettime(ClockId::CLOCK_PROCESS_CPUTIME_ID).ok()?;
    Some(time.tv_sec() as f64 + 1e-9 * time.tv_nsec() as f64)
}

/// `None`: this system has no such clock.
#[cfg(not(unix))]
#[must_use]
pub fn processor_seconds() -> Option<f64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    #[test]
    fn work_counts() {
        let Some(before) = processor_seconds() else { return };
        let start = Instant::now();
        let mut sum = 0_u64;
        while start.elapsed() < Duration::from_millis(50) {
            sum = std::hint::black_box(sum.wrapping_mul(3) + 1);
        }
        let worked = processor_seconds().unwrap() - before;
        assert!(worked > 0.001, "{worked}");
    }
}
