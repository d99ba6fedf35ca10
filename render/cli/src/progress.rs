//! Progress bars.

use indicatif::{ProgressBar, ProgressStyle};

/// A progress bar, which draws nothing unless stderr is a terminal.
pub(crate) fn bar(length: u64, template: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length).with_style(style)
}
