//! Progress bars and durations.

use indicatif::{ProgressBar, ProgressStyle};
use std::error::Error;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// Work that takes no longer than this needs no words.
const PATIENCE: Duration = Duration::from_secs(1);
/// Time from one picture of a spinner to the next.
const TURN: Duration = Duration::from_millis(120);

/// Does something, and says on a terminal what that is, if it takes longer than a second.
pub fn waiting<T>(what: String, work: impl FnOnce() -> T) -> T {
    let style = ProgressStyle::with_template("{spinner} {msg}, {elapsed}");
    let bar = ProgressBar::no_length().with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
    let bar = bar.with_message(what);
    let (working, end) = mpsc::channel::<()>();
    let shown = &bar;
    thread::scope(|scope| {
        scope.spawn(move || {
            if end.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                shown.enable_steady_tick(TURN);
            }
        });
        let result = work();
        bar.finish_and_clear();
        drop(working);
        result
    })
}

/// A progress bar, which draws nothing unless stderr is a terminal.
pub fn bar(total: u64, what: &str) -> Result<ProgressBar, Box<dyn Error>> {
    let style = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} %  {elapsed}, {eta} left")?;
    Ok(ProgressBar::new(total).with_style(style).with_message(what.to_owned()))
}

/// A number of seconds in words, such as `4 min 10 s`.
pub(crate) fn duration(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match whole {
        0..60 => format!("{} s", whole.max(1)),
        60..3600 => format!("{} min {} s", whole / 60, whole % 60),
        _ => format!("{} h {} min", whole / 3600, whole % 3600 / 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_in_words() {
        assert_eq!([0.2, 59.4, 250.0, 4800.0].map(duration), ["1 s", "59 s", "4 min 10 s", "1 h 20 min"]);
    }
}
