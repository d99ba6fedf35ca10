//! The maps of a sweep: colours by error, contours between decades, axes.

use crate::pose::{Sweep, Tick};
use crate::survey::{ErrorMap, Figures};
use etendue_laboratory::chart::plot::escape;
use std::fmt::Write as _;

/// The quantity that a map shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Measure {
    Direction,
    Pdf,
    RoundTrip,
    Invalid,
    Bias,
    Efficiency,
}
const MEASURES: [(Measure, &str); 6] = [
    (Measure::Direction, "error of direction"),
    (Measure::Pdf, "error of pdf"),
    (Measure::RoundTrip, "round trip"),
    (Measure::Invalid, "invalid samples"),
    (Measure::Bias, "bias of irradiance"),
    (Measure::Efficiency, "efficiency vs. area"),
];
impl Measure {
    fn of(self, chart: &ErrorMap, cell: &Figures) -> f64 {
        match self {
            Self::Direction => cell.direction,
            Self::Pdf => cell.pdf,
            Self::RoundTrip => cell.round_trip,
            Self::Invalid => cell.invalid,
            Self::Bias => cell.bias,
            Self::Efficiency => chart.efficiency(cell),
        }
    }
    fn is_error(self) -> bool {
        matches!(self, Self::Direction | Self::Pdf | Self::RoundTrip | Self::Bias)
    }
}

/// Colours by log₁₀ of the error: blue within the contract, yellow to black outside.
pub(super) const ERRORS: [(f64, [u8; 3]); 11] = [
    (-8.0, [0xed, 0xf4, 0xfa]),
    (-7.0, [0xc3, 0xdc, 0xee]),
    (-6.0, [0x7c, 0xb2, 0xd8]),
    (-5.001, [0x3c, 0x86, 0xbd]),
    (-5.0, [0xff, 0xec, 0xa0]),
    (-4.0, [0xfd, 0xc4, 0x62]),
    (-3.0, [0xf8, 0x8d, 0x42]),
    (-2.0, [0xe3, 0x4a, 0x2c]),
    (-1.0, [0xb0, 0x14, 0x25]),
    (0.0, [0x66, 0x00, 0x1a]),
    (0.1, [0x33, 0x00, 0x10]),
];
/// Colours by log₁₀ of a fraction of the samples.
const PARTS: [(f64, [u8; 3]); 3] = [(-3.5, [0xff, 0xec, 0xa0]), (-1.5, [0xe3, 0x4a, 0x2c]), (0.0, [0x66, 0x00, 0x1a])];
/// Colours by log₁₀ of the efficiency: brown is worse than sampling by area, green is better.
pub(super) const RATIOS: [(f64, [u8; 3]); 7] = [
    (-3.0, [0x54, 0x30, 0x05]),
    (-1.0, [0xc9, 0x8f, 0x45]),
    (-0.1, [0xf5, 0xea, 0xd2]),
    (0.1, [0xe4, 0xf2, 0xef]),
    (1.0, [0x8c, 0xcf, 0xc3]),
    (3.0, [0x35, 0x97, 0x8f]),
    (8.0, [0x00, 0x3c, 0x30]),
];
const NONE: &str = "#dcdcdc";
const BROKEN: &str = "#000000";
const CLEAN: &str = "#edf4fa";

/// Interpolates a colour between stops, whose numbers ascend, rounded to quarter decades, so that equal neighbours form one shape.
pub(super) fn blend(stops: &[(f64, [u8; 3])], log: f64) -> String {
    let x = ((log * 4.0).floor() / 4.0).clamp(stops[0].0, stops[stops.len() - 1].0);
    let above = stops.iter().position(|s| s.0 > x).unwrap_or(stops.len() - 1).max(1);
    let ((a, from), (b, to)) = (stops[above - 1], stops[above]);
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    let mixed = |k: usize| (f64::from(from[k]) + t * (f64::from(to[k]) - f64::from(from[k]))).round() as u8;
    format!("#{:02x}{:02x}{:02x}", mixed(0), mixed(1), mixed(2))
}

fn colour(measure: Measure, value: f64, cell: &Figures) -> String {
    if value.is_nan() {
        return if measure.is_error() && cell.invalid > 0.0 { BROKEN.into() } else { NONE.into() };
    }
    match measure {
        Measure::Invalid if value <= 0.0 => CLEAN.into(),
        Measure::Invalid => blend(&PARTS, value.log10()),
        Measure::Efficiency => blend(&RATIOS, value.max(1e-9).log10()),
        _ => blend(&ERRORS, value.max(1e-9).log10()),
    }
}
/// The decade of a value; contours separate cells of different decades.
fn decade(measure: Measure, value: f64) -> Option<i32> {
    let lowest = if measure == Measure::Efficiency { -3.0 } else { -8.0 };
    (!value.is_nan() && value.is_finite()).then(|| value.max(1e-30).log10().floor().clamp(lowest, 12.0) as i32)
}

const PLOT: [f64; 2] = [250.0, 190.0];
const MARGIN: [f64; 2] = [62.0, 22.0];
const STEP: [f64; 2] = [PLOT[0] + 14.0, PLOT[1] + 22.0];

/// What a page tells of each cell under the pointer: the measure, and a hundred times the logarithms of its values row by row from below;
/// nothing where there is none, and `z` for 0.
fn values(chart: &ErrorMap, measure: Measure, name: &str) -> String {
    let number = |cell: &Figures| match measure.of(chart, cell) {
        x if x.is_nan() => String::new(),
        x if x <= 0.0 => "z".to_owned(),
        x => format!("{:.0}", 100.0 * x.log10()),
    };
    let list: Vec<String> = chart.cells.iter().map(number).collect();
    format!(r#" data-measure="{name}" data-cells="{}""#, list.join(","))
}

/// Draws one map, scaled to the size of a plot.
fn map(chart: &ErrorMap, measure: Measure, out: &mut String) {
    let (nx, ny) = (chart.sweep.x.len(), chart.sweep.y.len());
    let at = |i: usize, j: usize| &chart.cells[j * nx + i];
    let value = |i: usize, j: usize| measure.of(chart, at(i, j));
    let (w, h) = (PLOT[0] / nx as f64, PLOT[1] / ny as f64);
    // horizontal runs of cells, grouped by colour
    let mut runs: Vec<(String, String)> = Vec::new();
    for j in 0..ny {
        let mut i = 0;
        while i < nx {
            let fill = colour(measure, value(i, j), at(i, j));
            let start = i;
            while i < nx && colour(measure, value(i, j), at(i, j)) == fill {
                i += 1;
            }
            let run = format!("M{start} {}h{}v1h-{}z", ny - 1 - j, i - start, i - start);
            match runs.iter_mut().find(|r| r.0 == fill) {
                Some(of_colour) => of_colour.1.push_str(&run),
                None => runs.push((fill, run)),
            }
        }
    }
    let _ = write!(out, r#"<g transform="scale({w:.4} {h:.4})" shape-rendering="crispEdges">"#);
    for (fill, path) in runs {
        let _ = write!(out, r#"<path fill="{fill}" d="{path}"/>"#);
    }
    let (mut thin, mut thick) = (String::new(), String::new());
    for j in 0..ny {
        for i in 0..nx {
            let here = decade(measure, value(i, j));
            let mut edge = |other: Option<i32>, path: String| {
                let (Some(a), Some(b)) = (here, other) else { return };
                if a == b || measure == Measure::Invalid {
                    return;
                }
                let limit = if measure == Measure::Efficiency { 0 } else { -5 };
                if (a < limit) == (b < limit) { thin.push_str(&path) } else { thick.push_str(&path) }
            };
            let top = ny - 1 - j;
            if i + 1 < nx {
                edge(decade(measure, value(i + 1, j)), format!("M{} {top}v1", i + 1));
            }
            if j + 1 < ny {
                edge(decade(measure, value(i, j + 1)), format!("M{i} {top}h1"));
            }
        }
    }
    for (path, width, opacity) in [(thin, 0.6, 0.45), (thick, 1.8, 1.0)] {
        if !path.is_empty() {
            let _ = write!(
                out,
                r##"<path d="{path}" fill="none" stroke="#000" stroke-width="{width}" stroke-opacity="{opacity}" vector-effect="non-scaling-stroke"/>"##
            );
        }
    }
    out.push_str("</g>");
    let _ = write!(
        out,
        r##"<rect width="{}" height="{}" fill="none" stroke="#555" stroke-width="0.8"/>"##,
        PLOT[0], PLOT[1]
    );
}

fn ticks(sweep: &Sweep, x_axis: bool, y_axis: bool, out: &mut String) {
    let (nx, ny) = (sweep.x.len() as f64, sweep.y.len() as f64);
    if x_axis {
        let mut free = f64::NEG_INFINITY;
        for (i, tick) in sweep.x.iter().enumerate().filter(|t| !t.1.label.is_empty()) {
            let x = (i as f64 + 0.5) * PLOT[0] / nx;
            let half = 2.9 * tick.label.len() as f64 + 2.0;
            if x - half >= free {
                free = x + half;
                let _ = write!(
                    out,
                    r##"<path d="M{x:.1} {}v3" stroke="#555"/><text x="{x:.1}" y="{}" text-anchor="middle">{}</text>"##,
                    PLOT[1],
                    PLOT[1] + 12.0,
                    tick.label
                );
            }
        }
    }
    if y_axis {
        let mut free = f64::INFINITY;
        for (j, tick) in sweep.y.iter().enumerate().filter(|t| !t.1.label.is_empty()) {
            let y = PLOT[1] - (j as f64 + 0.5) * PLOT[1] / ny;
            if y + 5.5 <= free {
                free = y - 5.5;
                let _ = write!(
                    out,
                    r##"<path d="M0 {y:.1}h-3" stroke="#555"/><text x="-5" y="{:.1}" text-anchor="end">{}</text>"##,
                    y + 3.2,
                    tick.label
                );
            }
        }
    }
}

/// Draws all maps of one sweep, with techniques across and measures down.
pub(super) fn sheet(charts: &[&ErrorMap]) -> String {
    let sweep = &charts[0].sweep;
    let (columns, rows) = (charts.len() as f64, MEASURES.len() as f64);
    let (width, height) = (MARGIN[0] + STEP[0] * columns + 4.0, MARGIN[1] + STEP[1] * rows + 30.0);
    let axis = |ticks: &[Tick]| ticks.iter().map(|t| format!("{:e}", t.value)).collect::<Vec<_>>().join(",");
    let axes = [axis(&sweep.x), axis(&sweep.y)];
    let titles = [sweep.x_title, sweep.y_title].map(escape);
    let told = format!(r#"data-x="{}" data-y="{}" data-titles="{}|{}""#, axes[0], axes[1], titles[0], titles[1]);
    let mut out = format!(
        r#"<svg {told} xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="10" fill="currentColor">"#
    );
    let _ = write!(out, r##"<rect width="{width}" height="{height}" fill="#fff"/><g fill="#222">"##);
    for (i, chart) in charts.iter().enumerate() {
        let x = MARGIN[0] + STEP[0] * i as f64;
        let (weight, whose) = if chart.method.1 { ("bold", "étendue: ") } else { ("normal", "textbook: ") };
        let _ = write!(
            out,
            r#"<text x="{x}" y="15" font-size="12" font-weight="{weight}">{whose}{}</text>"#,
            escape(&chart.method.0)
        );
        for (j, (measure, name)) in MEASURES.iter().enumerate() {
            let y = MARGIN[1] + STEP[1] * j as f64;
            let _ = write!(out, r#"<g transform="translate({x} {y})"{}>"#, values(chart, *measure, name));
            map(chart, *measure, &mut out);
            ticks(sweep, true, i == 0, &mut out);
            out.push_str("</g>");
            if i == 0 {
                let middle = y + PLOT[1] / 2.0;
                let _ = write!(
                    out,
                    r#"<text transform="translate(11 {middle}) rotate(-90)" text-anchor="middle" font-size="11" font-weight="bold">{name}</text>"#
                );
            }
        }
    }
    let bottom = MARGIN[1] + STEP[1] * rows + 12.0;
    let _ = write!(
        out,
        r#"<text x="{}" y="{bottom}" font-size="11">x: {}; y: {}</text>"#,
        MARGIN[0], sweep.x_title, sweep.y_title
    );
    out.push_str("</g></svg>");
    out
}
