//! Draws the charts of a scene.

use super::plot::{Bar, BarRow, Bars, Chart, Dot, Drawing, Line, Scale, short};
use super::stats::Estimate;
use super::summary::{Gain, Point, Series, Summary};

/// A chart with a file name and a caption.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Name of the chart in file names.
    pub file: String,
    /// What a page must ask for to show the chart; `None` if it always does.
    pub shown_for: Option<(Against, Measure)>,
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

/// What errors are drawn against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// Wall time.
    Time,
    /// Time of all threads together.
    Cpu,
    /// Rays of all kinds.
    Rays,
    /// Samples per pixel.
    Samples,
}

/// Which error is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Mean squared error.
    Mse,
    /// Mean squared error relative to the square of the reference.
    RelativeMse,
}

impl Against {
    /// All of them, in the order of a page.
    pub const ALL: [Self; 4] = [Self::Time, Self::Cpu, Self::Rays, Self::Samples];
    /// Name in file names and pages.
    #[must_use]
    pub const fn name(self) -> &'static str {
        ["time", "cpu", "rays", "samples"][self as usize]
    }
    /// Whether a page shows errors against it at first.
    #[must_use]
    pub const fn is_shown(self) -> bool {
        matches!(self, Self::Time | Self::Samples)
    }
    const fn title(self) -> &'static str {
        ["time", "CPU time", "rays", "samples"][self as usize]
    }
    const fn label(self) -> &'static str {
        ["seconds per image", "seconds of all threads together per image", "rays per image", "samples per pixel"]
            [self as usize]
    }
    /// Where a point is; `None` where the system does not tell.
    fn at(self, point: &Point) -> Option<Bar> {
        match self {
            Self::Time => Some(point.seconds.into()),
            Self::Cpu => point.cpu.map(Bar::from),
            Self::Rays => Some(Bar::exact(point.rays)),
            Self::Samples => Some(Bar::exact(f64::from(point.spp))),
        }
    }
}

impl Measure {
    /// All of them, in the order of a page.
    pub const ALL: [Self; 2] = [Self::Mse, Self::RelativeMse];
    /// Name in pages.
    #[must_use]
    pub const fn name(self) -> &'static str {
        ["MSE", "relMSE"][self as usize]
    }
    fn of(self, point: &Point) -> Estimate {
        if self == Self::Mse { point.mse } else { point.relative }
    }
}

/// Draws an error; `None` if no point has a place.
#[must_use]
pub fn error(summary: &Summary, against: Against, measure: Measure) -> Option<Figure> {
    let shown = summary.leaders();
    let is_samples = against == Against::Samples;
    let name = |s: &Series| match &s.slope {
        _ if !is_samples || measure != Measure::Mse => summary.name(&s.way),
        Some(slope) => format!("{} {}", summary.name(&s.way), with_interval(slope).replace('-', "−")),
        None => format!("{} slope ?", summary.name(&s.way)),
    };
    let dot = |p: &Point| {
        let (x, y) = (against.at(p)?, measure.of(p));
        let sure = y.is_sure() && (against != Against::Time || p.seconds.is_sure());
        Some(Dot { x, y: y.into(), sure })
    };
    let line = |(index, series): (usize, &Series)| Line {
        id: id(series),
        name: name(series),
        color: series.way.color(),
        dash: series.way.sampler as usize,
        shown: shown.contains(&index),
        dots: series.points.iter().filter_map(dot).collect(),
    };
    let lines: Vec<Line> = summary.series.iter().enumerate().map(line).collect();
    if lines.iter().all(|line| line.dots.is_empty()) {
        return None;
    }
    let [title, y_label] = match measure {
        Measure::Mse => ["error", "mean squared error"],
        Measure::RelativeMse => ["relative error", "mean of squared error / squared reference"],
    };
    let chart = Chart {
        title: format!("{}: {title} against {}{}", summary.scene, against.title(), summary.common()),
        x_label: against.label().to_owned(),
        y_label: y_label.to_owned(),
        scales: [if is_samples { Scale::Binary } else { Scale::Log }, Scale::Log],
        lines,
        guides: vec![-1.0, -1.5],
    };
    let mut caption =
        "Lower and further left is better. Each point is one sample count per pixel. Bars are 95 % intervals over \
                       replicates. Hollow points have an interval too wide to support a claim."
            .to_owned();
    if is_samples && measure == Measure::Mse {
        caption += " Slopes of log error over log samples are fitted to each replicate: mean and 95 % interval; ? is one of fewer than two \
                    points.";
    }
    let file = format!("{}error-{}", if measure == Measure::Mse { "" } else { "relative-" }, against.name());
    Some(Figure { file, shown_for: Some((against, measure)), drawing: chart.draw(), caption })
}

/// All charts of a scene, in the order of a page.
#[must_use]
pub fn all(summary: &Summary) -> Vec<Figure> {
    let errors = Measure::ALL.iter().flat_map(|m| Against::ALL.map(|a| error(summary, a, *m)));
    errors.chain([efficiency(summary)]).flatten().collect()
}

/// Draws efficiency relative to the baseline, the greatest first; `None` if there is no baseline.
#[must_use]
pub fn efficiency(summary: &Summary) -> Option<Figure> {
    let baseline = &summary.series[summary.baseline?];
    let leaders = summary.leaders();
    let row = |g: &Gain| {
        // the interval is that of a logarithm
        let factor = 1.0 + g.gain.half / g.gain.value;
        let bar = Bar { value: g.gain.value, low: g.gain.value / factor, high: g.gain.value * factor };
        let sure = g.gain.is_sure() || Some(g.series) == summary.baseline;
        let text = format!("{}×{}", short(g.gain.value), if sure { "" } else { " ?" });
        let (series, shown) = (&summary.series[g.series], leaders.contains(&g.series));
        let (name, color) = (summary.name(&series.way), series.way.color());
        BarRow { id: id(series), name, color, bar, text, sure, shown }
    };
    let mut rows: Vec<BarRow> = summary.gains.iter().map(row).collect();
    rows.sort_by(|a, b| b.bar.value.total_cmp(&a.bar.value));
    let bars = Bars {
        title: format!("{}: efficiency at {} samples per pixel{}", summary.scene, summary.spp, summary.common()),
        label: format!("1/(error × time), relative to {}", baseline.way.title()),
        rows,
        origin: 1.0,
    };
    let caption =
        "Further right is better: 10 means the same error in a tenth of the time, as long as error falls as 1/time. \
                   Ratios compare replicates rendered in the same round. Hollow bars with ? have an interval too wide to support a claim."
            .to_owned();
    Some(Figure { file: "efficiency".to_owned(), shown_for: None, drawing: bars.draw(), caption })
}
