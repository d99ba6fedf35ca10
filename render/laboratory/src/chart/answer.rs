//! Which way reaches an error first, and after how many seconds, in sentences that can be checked.

use super::plot::short;
use super::stats::{Reach, UNKNOWN};
use super::summary::{ERRORS, Series, Summary};

/// An error in per cent, such as `0.3 %`.
#[must_use]
pub fn percent(error: f64) -> String {
    format!("{} %", short(100.0 * error))
}

/// Seconds with half of their interval, as many digits as that has; `about` stands before what lies beyond the measured images or has no
/// interval, `at most` before the time of the shortest image if its error is smaller already.
#[must_use]
pub fn seconds(reach: &Reach) -> String {
    let (value, half) = (reach.seconds, reach.seconds * (reach.factor - 1.0));
    if reach.is_upper_bound {
        return format!("at most {} s", short(value));
    }
    if reach.is_beyond || !(0.0..value).contains(&half) {
        let two = 10_f64.powf(value.log10().floor() - 1.0);
        return format!("about {} s", short((value / two).round() * two));
    }
    let places = |x: f64| -x.log10().floor() as i32;
    let places = if half > 0.0 { places(half).min(2 + places(value)) } else { 2 + places(value) }.max(0);
    let unit = 10_f64.powi(-places);
    let (half, places) = ((half / unit).round().max(1.0) * unit, places as usize);
    format!("{value:.places$} s ± {half:.places$}")
}

/// What a sentence lists at most of ways between which it does not decide.
const MOST_TIED: usize = 3;

impl Summary {
    /// The series of each method that reaches the error first, the first first.
    fn first_of_each(&self, error: usize) -> Vec<(&Series, &Reach)> {
        let mut list: Vec<_> = self.series.iter().filter_map(|s| Some((s, s.reaches[error].as_ref()?))).collect();
        list.sort_by(|a, b| a.1.seconds.total_cmp(&b.1.seconds));
        let mut methods = Vec::new();
        list.retain(|(series, _)| {
            let method = series.way.method();
            let is_first = !methods.contains(&method);
            methods.push(method);
            is_first
        });
        list
    }

    /// For each error: the way that reaches it first, the next one and the baseline, with their seconds; *no best* where the intervals of
    /// several methods overlap.
    #[must_use]
    pub fn sentences(&self) -> Vec<String> {
        (0..ERRORS.len()).filter_map(|error| self.sentence(error)).collect()
    }

    /// The series that may be the first to reach the error of this index, one of each method: those whose intervals overlap that of the
    /// shortest.
    #[must_use]
    pub fn undecided(&self, error: usize) -> Vec<&Series> {
        let list = self.first_of_each(error);
        let Some((_, best)) = list.first() else { return Vec::new() };
        list.iter().filter(|(_, reach)| reach.low() <= best.high()).map(|(series, _)| *series).collect()
    }

    fn sentence(&self, error: usize) -> Option<String> {
        let mut list = self.first_of_each(error);
        let (_, best) = *list.first()?;
        list.sort_by_key(|(_, reach)| reach.low() > best.high());
        let tied = self.undecided(error).len();
        let named = |(series, reach): &(&Series, &Reach)| (series.way.phrase(), seconds(reach));
        let mut shown: Vec<_> = list.iter().take(tied.min(MOST_TIED)).map(named).collect();
        let others = tied.saturating_sub(MOST_TIED);
        shown.extend(list.get(tied).map(named));
        let baseline = self.baseline.map(|b| &self.series[b]);
        let baseline = baseline.and_then(|b| Some(named(&(b, b.reaches[error].as_ref()?))));
        shown.extend(baseline.filter(|baseline| !shown.contains(baseline)));
        let is_tied = tied > 1;
        let mut text = format!(
            "to reach {}, {}",
            percent(ERRORS[error]),
            if is_tied { "no method is surely the fastest: " } else { "" }
        );
        for (i, (name, time)) in shown.iter().enumerate() {
            text += &match i {
                0 => format!("{name} takes {time}"),
                _ => format!(", {name} {time}"),
            };
            if others > 0 && i + 1 == MOST_TIED {
                text += &format!(", and {others} more about as long");
            }
        }
        Some(text)
    }
}

/// How sentences treat what is not known, for the page.
#[must_use]
pub fn convention() -> String {
    format!(
        "No method is surely the fastest where the interval of another method begins below the end of the shortest. An interval that is not known, because there \
         is one image, counts as a factor of {UNKNOWN} either way."
    )
}
