//! Which time counts: that on the wall, unless the threads were kept from running.

/// Which time counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Clock {
    /// From the beginning to the end of an image.
    Wall,
    /// The processor time of all threads together. They ran for only this part of the time on the wall, from 0 to 0.9.
    Processors(f64),
}

/// Threads that run for less than this part of the time were kept from it.
const KEPT: f64 = 0.9;

impl Clock {
    /// The clock for these times on the wall and of the processors: wall time, unless the threads ran for less than nine tenths of it, as on
    /// a machine that does something else.
    #[must_use]
    pub fn of(times: impl Iterator<Item = (f64, Option<f64>)> + Clone, threads: usize) -> Self {
        let wall: f64 = times.clone().map(|(wall, _)| wall).sum::<f64>() * threads as f64;
        match times.map(|(_, cpu)| cpu).sum::<Option<f64>>() {
            Some(cpu) if cpu < KEPT * wall => Self::Processors(cpu / wall),
            _ => Self::Wall,
        }
    }

    /// The seconds that count, of those on the wall and of the processors.
    pub(super) fn seconds(self, wall: f64, cpu: Option<f64>) -> f64 {
        if self == Self::Wall { wall } else { cpu.unwrap_or(wall) }
    }

    /// What a reader must know of the times; `None` if they are those of the wall.
    #[must_use]
    pub fn remark(self) -> Option<String> {
        let Self::Processors(share) = self else { return None };
        Some(format!(
            "times are those of the processors, all threads together: the threads ran for {:.0} % of the time on the wall, because the machine was busy or \
             images were too small for all threads",
            100.0 * share
        ))
    }
}
