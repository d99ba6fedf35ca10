//! Draws the charts of a scene.

use super::clock::Clock;
use super::plot::{Bar, Chart, Dot, Drawing, Line, Scale, short};
use super::stats::Estimate;
use super::summary::{Point, Series, Summary};

/// A chart with a file name and a caption.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Name of the chart in file names.
    pub file: String,
    /// What a page must ask for to show the chart.
    pub shown_for: (Against, Measure),
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
    /// Root of the mean squared error over the mean of the reference, in per cent.
    Rms,
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
    /// Whether a page shows errors against it at first: the time that counts, and samples.
    #[must_use]
    pub fn is_shown(self, clock: Clock) -> bool {
        self == Self::Samples || self == if clock == Clock::Wall { Self::Time } else { Self::Cpu }
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
            Self::Time => Some(point.wall.into()),
            Self::Cpu => point.cpu.map(Bar::from),
            Self::Rays => Some(Bar::exact(point.rays)),
            Self::Samples => Some(Bar::exact(f64::from(point.spp))),
        }
    }
}

impl Measure {
    /// All of them, in the order of a page.
    pub const ALL: [Self; 3] = [Self::Rms, Self::Mse, Self::RelativeMse];
    /// Name in pages.
    #[must_use]
    pub const fn name(self) -> &'static str {
        ["RMS %", "MSE", "relMSE"][self as usize]
    }
    const fn label(self) -> &'static str {
        ["error (relative RMS, %)", "mean squared error", "mean of squared error / squared reference"][self as usize]
    }
    /// Where a point is, and whether its interval is narrow.
    fn of(self, summary: &Summary, point: &Point) -> (Bar, bool) {
        let estimate = if self == Self::RelativeMse { point.relative } else { point.mse };
        let bar = Bar::from(estimate);
        let percent = |mse: f64| 100.0 * mse.max(0.0).sqrt() / summary.mean;
        let is_root = self == Self::Rms;
        let bar = if is_root {
            Bar { value: percent(bar.value), low: percent(bar.low), high: percent(bar.high) }
        } else {
            bar
        };
        (bar, estimate.is_sure())
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
    let dot = |series: &Series, p: &Point| {
        let (x, (y, is_sure)) = (against.at(p)?, measure.of(summary, p));
        let sure = is_sure && (against != Against::Time || p.wall.is_sure());
        let seconds = p.cpu.map_or_else(
            || short(p.wall.value),
            |cpu| format!("{} ({} of CPU)", short(p.wall.value), short(cpu.value)),
        );
        let error = format!("{} {}", short(y.value), if measure == Measure::Rms { "%" } else { measure.name() });
        let images = p.costs.len();
        let about = format!(
            "{}: {} spp, {seconds} s, error {error}, {images} image{}",
            series.way.title(),
            p.spp,
            if images == 1 { "" } else { "s" }
        );
        Some(Dot { x, y, sure, about })
    };
    let line = |index: &usize| {
        let series = &summary.series[*index];
        Line {
            id: id(series),
            name: name(series),
            color: series.way.color(),
            dash: series.way.sampler as usize,
            shown: shown.contains(index),
            dots: series.points.iter().filter_map(|p| dot(series, p)).collect(),
        }
    };
    let lines: Vec<Line> = summary.ranking.iter().map(line).collect();
    if lines.iter().all(|line| line.dots.is_empty()) {
        return None;
    }
    let chart = Chart {
        title: format!("{}: error against {}{}", summary.scene, against.title(), summary.common()),
        x_label: against.label().to_owned(),
        y_label: measure.label().to_owned(),
        scales: [if is_samples { Scale::Binary } else { Scale::Log }, Scale::Log],
        lines,
        guides: if measure == Measure::Rms { vec![-0.5, -0.75] } else { vec![-1.0, -1.5] },
    };
    let slopes = if measure == Measure::Rms { "−½ and −¾" } else { "−1 and −1½" };
    let mut caption = format!(
        "Lower and further left is better. Each point is one sample count per pixel. Bars are 95 % intervals over replicates. Hollow points have \
         an interval too wide to support a claim. Dotted lines have slopes of {slopes}."
    );
    if is_samples && measure == Measure::Mse {
        caption += " Slopes of log error over log samples are fitted to each replicate: mean and 95 % interval; ? is one of fewer than two \
                    points.";
    }
    let file = format!("{}error-{}", ["", "squared-", "relative-"][measure as usize], against.name());
    Some(Figure { file, shown_for: (against, measure), drawing: chart.draw(), caption })
}

/// All charts of a scene, in the order of a page.
#[must_use]
pub fn all(summary: &Summary) -> Vec<Figure> {
    Measure::ALL.iter().flat_map(|m| Against::ALL.map(|a| error(summary, a, *m))).flatten().collect()
}
