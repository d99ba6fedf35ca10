//! Draws the charts of a scene.

use super::plot::{Bar, BarRow, Bars, Chart, Dot, Drawing, Line, Scale, short};
use super::stats::Estimate;
use super::summary::{Point, Series, Summary};

/// A chart with a file name and a caption.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Name of the chart in file names.
    pub file: &'static str,
    /// The drawing.
    pub drawing: Drawing,
    /// Caption for a page.
    pub caption: String,
}

/// Formats a value ± half of its interval.
#[must_use]
pub fn with_interval(e: &Estimate) -> String {
    if e.half.is_finite() { format!("{:.3} ± {:.3}", e.value, e.half) } else { format!("{:.3} ± ?", e.value) }
}

/// Identifier of a series in a page: technique/sampler.
#[must_use]
pub fn id(series: &Series) -> String {
    format!("{}/{}", series.way.method(), series.way.sampler.name())
}

fn lines(
    summary: &Summary,
    name: impl Fn(&Series) -> String,
    x: impl Fn(&Point) -> Bar,
    sure: impl Fn(&Point) -> bool,
) -> Vec<Line> {
    let shown = summary.leaders();
    let line = |(index, series): (usize, &Series)| Line {
        id: id(series),
        name: name(series),
        color: series.way.color(),
        dash: series.way.sampler as usize,
        shown: shown.contains(&index),
        dots: series.points.iter().map(|p| Dot { x: x(p), y: p.mse.into(), sure: sure(p) }).collect(),
    };
    summary.series.iter().enumerate().map(line).collect()
}

/// Draws error against time.
#[must_use]
pub fn error_over_time(summary: &Summary) -> Figure {
    let chart = Chart {
        title: format!("{}: error against time", summary.scene),
        x_label: "seconds per image".to_owned(),
        y_label: "mean squared error".to_owned(),
        scales: [Scale::Log, Scale::Log],
        lines: lines(summary, |s| s.way.title(), |p| p.seconds.into(), Point::is_sure),
        guides: vec![-1.0, -1.5],
    };
    let caption =
        "Lower and further left is better. Each point is one sample count per pixel. Bars are 95 % intervals over \
                   replicates. Hollow points have an interval too wide to support a claim."
            .to_owned();
    Figure { file: "error-time", drawing: chart.draw(), caption }
}

/// Draws error against samples per pixel, with slopes.
#[must_use]
pub fn error_over_samples(summary: &Summary) -> Figure {
    let name = |s: &Series| match &s.slope {
        Some(slope) => format!("{} {}", s.way.title(), with_interval(slope).replace('-', "−")),
        None => format!("{} slope ?", s.way.title()),
    };
    let chart = Chart {
        title: format!("{}: error against samples", summary.scene),
        x_label: "samples per pixel".to_owned(),
        y_label: "mean squared error".to_owned(),
        scales: [Scale::Binary, Scale::Log],
        lines: lines(summary, name, |p| Bar::exact(f64::from(p.spp)), |p| p.mse.is_sure()),
        guides: vec![-1.0, -1.5],
    };
    let caption =
        "Slopes of log error over log samples are fitted to each replicate: mean and 95 % interval.".to_owned();
    Figure { file: "error-samples", drawing: chart.draw(), caption }
}

/// A row for each series with its value, the best first: the greatest, or if `least_first` the least.
fn sorted(mut rows: Vec<BarRow>, least_first: bool) -> Vec<BarRow> {
    rows.sort_by(|a, b| b.bar.value.total_cmp(&a.bar.value));
    if least_first {
        rows.reverse();
    }
    rows
}

fn row(summary: &Summary, index: usize, bar: Bar, sure: bool, shown: &[usize]) -> BarRow {
    let series = &summary.series[index];
    let (color, shown) = (series.way.color(), shown.contains(&index));
    BarRow { id: id(series), name: series.way.title(), color, bar, sure, shown }
}

/// Draws efficiency relative to the baseline, the greatest first; `None` if there is no baseline.
#[must_use]
pub fn efficiency(summary: &Summary) -> Option<Figure> {
    let baseline = &summary.series[summary.baseline?];
    let shown = summary.leaders();
    let rows = summary.gains.iter().map(|g| {
        // the interval is that of a logarithm
        let factor = 1.0 + g.gain.half / g.gain.value;
        let bar = Bar { value: g.gain.value, low: g.gain.value / factor, high: g.gain.value * factor };
        let sure = g.gain.is_sure() || g.series == summary.baseline.unwrap_or(usize::MAX);
        row(summary, g.series, bar, sure, &shown)
    });
    let bars = Bars {
        title: format!("{}: efficiency at {} samples per pixel", summary.scene, summary.spp),
        label: format!("1/(error × time), relative to {}", baseline.way.title()),
        rows: sorted(rows.collect(), false),
        origin: 1.0,
        unit: "×".to_owned(),
    };
    let caption =
        "Further right is better: 10 means the same error in a tenth of the time, as long as error falls as 1/time. \
                   Ratios compare replicates rendered in the same round."
            .to_owned();
    Some(Figure { file: "efficiency", drawing: bars.draw(), caption })
}

/// Draws the seconds each series takes to reach the target error, the least first; `None` if no series reaches it.
#[must_use]
pub fn time_to_error(summary: &Summary) -> Option<Figure> {
    let shown = summary.leaders();
    let rows = summary.series.iter().enumerate().map(|(index, s)| {
        // unknown times come last
        let (seconds, beyond) = s.seconds_to(summary.target).unwrap_or((f64::NAN, true));
        row(summary, index, Bar::exact(seconds), !beyond, &shown)
    });
    let rows = sorted(rows.collect(), true);
    let least = rows.first()?.bar.value;
    if !least.is_finite() || summary.target <= 0.0 {
        return None;
    }
    let bars = Bars {
        title: format!("{}: time to a mean squared error of {}", summary.scene, short(summary.target)),
        label: "seconds".to_owned(),
        rows,
        origin: least * 0.7,
        unit: " s".to_owned(),
    };
    let caption =
        "Shorter is better. Hollow bars are extrapolated by the slope of the nearest two points, or rest on times with wide \
                   intervals."
            .to_owned();
    Some(Figure { file: "time-to-error", drawing: bars.draw(), caption })
}
