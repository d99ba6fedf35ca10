//! Writes the maps, the table and the page.

use super::pose::{ShapeKind, Sweep};
use super::survey::{ErrorMap, Figures, LIMIT};
use crate::chart::plot::escape;
use etendue_oracle::Greatest;
use etendue_render::files;
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

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
const ERRORS: [(f64, [u8; 3]); 11] = [
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
const RATIOS: [(f64, [u8; 3]); 7] = [
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

/// Interpolates a colour, rounded to quarter decades, so that equal neighbours form one shape.
fn blend(stops: &[(f64, [u8; 3])], log: f64) -> String {
    let log = ((log * 4.0).floor() / 4.0).clamp(stops[0].0, stops[stops.len() - 1].0);
    let above = stops.iter().position(|s| s.0 > log).unwrap_or(stops.len() - 1).max(1);
    let ((a, from), (b, to)) = (stops[above - 1], stops[above]);
    let t = ((log - a) / (b - a)).clamp(0.0, 1.0);
    let mix = |k: usize| (f64::from(from[k]) + t * (f64::from(to[k]) - f64::from(from[k]))).round() as u8;
    format!("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2))
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
fn sheet(charts: &[&ErrorMap]) -> String {
    let sweep = &charts[0].sweep;
    let (columns, rows) = (charts.len() as f64, MEASURES.len() as f64);
    let (width, height) = (MARGIN[0] + STEP[0] * columns + 4.0, MARGIN[1] + STEP[1] * rows + 30.0);
    let mut out = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="10" fill="currentColor">"#
    );
    let _ = write!(out, r##"<rect width="{width}" height="{height}" fill="#fff"/><g fill="#222">"##);
    for (i, chart) in charts.iter().enumerate() {
        let x = MARGIN[0] + STEP[0] * i as f64;
        let (weight, whose) = if chart.method.ours { ("bold", "étendue: ") } else { ("normal", "textbook: ") };
        let _ = write!(
            out,
            r#"<text x="{x}" y="15" font-size="12" font-weight="{weight}">{whose}{}</text>"#,
            escape(chart.method.name)
        );
        for (j, (measure, name)) in MEASURES.iter().enumerate() {
            let y = MARGIN[1] + STEP[1] * j as f64;
            let _ = write!(out, r#"<g transform="translate({x} {y})">"#);
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

/// Greatest errors of a technique over all its sweeps.
#[derive(Clone, Debug)]
pub struct Summary {
    /// ShapeKind of shape.
    pub kind: ShapeKind,
    /// Name of the technique, and whether it belongs to the library.
    pub method: (&'static str, bool),
    /// Greatest errors of direction, pdf and round trip, and greatest bias; NaN if not measured.
    pub greatest: [Greatest; 4],
    /// Numbers of cells within the contract, of cells with an invalid sample, and of all measured cells.
    pub cells: [usize; 3],
    /// Numbers of cells whose bias is within the limit, and of all cells with a measured bias.
    pub unbiased: [usize; 2],
    /// Nanoseconds to prepare for a point and draw one sample.
    pub cost: f64,
}

impl Summary {
    fn unbiased_part(&self) -> String {
        format!("{:.1} %", 100.0 * self.unbiased[0] as f64 / self.unbiased[1].max(1) as f64)
    }
}

/// Summaries of each kind and technique, in order.
#[must_use]
pub fn summary(charts: &[ErrorMap]) -> Vec<Summary> {
    let mut all: Vec<Summary> = Vec::new();
    for chart in charts {
        let method = (chart.method.name, chart.method.ours);
        let at = all.iter().position(|s| s.kind == chart.kind && s.method == method).unwrap_or_else(|| {
            all.push(Summary {
                kind: chart.kind,
                method,
                greatest: [Greatest::NONE; 4],
                cells: [0; 3],
                unbiased: [0; 2],
                cost: chart.cost,
            });
            all.len() - 1
        });
        let entry = &mut all[at];
        for cell in &chart.cells {
            for (most, x) in entry.greatest.iter_mut().zip([cell.direction, cell.pdf, cell.round_trip, cell.bias]) {
                if !x.is_nan() {
                    most.take(x, ());
                }
            }
            entry.cells[0] += usize::from(cell.measured() && cell.meets());
            entry.cells[1] += usize::from(cell.invalid > 0.0);
            entry.cells[2] += usize::from(cell.measured());
            entry.unbiased[0] += usize::from(cell.bias <= LIMIT);
            entry.unbiased[1] += usize::from(!cell.bias.is_nan());
        }
    }
    all
}

fn figure(x: f64) -> String {
    if x.is_nan() { "–".into() } else { format!("{x:.1e}") }
}

/// The summary as text.
#[must_use]
pub fn table(charts: &[ErrorMap]) -> String {
    let mut out = format!(
        "{:23} {:40} {:>9} {:>8} {:>10} {:>8}  {:>11} {:>8} {:>8}\n",
        "shape", "technique", "direction", "pdf", "round trip", "bias", "within 1e-5", "unbiased", "invalid"
    );
    for s in summary(charts) {
        let [direction, pdf, round_trip, bias] = s.greatest.map(|g| figure(g.measured()));
        let name = format!("{}{}", if s.method.1 { "" } else { "textbook: " }, s.method.0);
        let part = |n: usize| format!("{:.1} %", 100.0 * n as f64 / s.cells[2] as f64);
        let (within, unbiased, invalid) = (part(s.cells[0]), s.unbiased_part(), part(s.cells[1]));
        let _ = writeln!(
            out,
            "{:23} {name:40} {direction:>9} {pdf:>8} {round_trip:>10} {bias:>8}  {within:>11} {unbiased:>8} {invalid:>8}",
            s.kind.name()
        );
    }
    out
}

fn legend(stops: &[(f64, [u8; 3])], low: i32, high: i32, first: &str, last: &str) -> String {
    let width = f64::from(high - low) * 40.0 + 46.0;
    let mut out = format!(
        r#"<svg viewBox="0 0 {width} 34" style="width:{width}px;max-width:100%" font-family="sans-serif" font-size="10">"#
    );
    for quarter in low * 4..high * 4 {
        let x = f64::from(quarter - low * 4) * 10.0 + 18.0;
        let fill = blend(stops, f64::from(quarter) / 4.0 + 0.01);
        let _ = write!(out, r#"<rect x="{x}" y="2" width="10.5" height="14" fill="{fill}"/>"#);
    }
    for power in low..=high {
        let x = f64::from(power - low) * 40.0 + 18.0;
        let text = match power {
            p if p == low => format!("{first}1e{p}"),
            p if p == high => format!("{last}1e{p}"),
            p => format!("1e{p}"),
        };
        let _ = write!(out, r#"<text x="{x}" y="29" text-anchor="middle">{text}</text>"#);
    }
    out.push_str("</svg>");
    out
}

fn html(charts: &[ErrorMap], sheets: &[(ShapeKind, Sweep, String)], quick: bool) -> String {
    let mut rows = String::new();
    let mut last = None;
    for s in summary(charts) {
        let class = if s.method.1 { "ours" } else { "textbook" };
        let shape = if last == Some(s.kind) { String::new() } else { format!("<b>{}</b>", s.kind.name()) };
        last = Some(s.kind);
        let cells: String = s
            .greatest
            .iter()
            .map(|greatest| {
                let x = greatest.measured();
                let colour = if x.is_nan() { "#fff".into() } else { blend(&ERRORS, x.max(1e-9).log10()) };
                let ink = if x > 3e-3 { "#fff" } else { "#000" };
                format!(r#"<td style="background:{colour};color:{ink}">{}</td>"#, figure(x))
            })
            .collect();
        let part = |n: usize| format!("{:.1} %", 100.0 * n as f64 / s.cells[2] as f64);
        let _ = writeln!(
            rows,
            r#"<tr class="{class}"><td>{shape}</td><td>{}</td>{cells}<td>{}</td><td>{}</td><td>{}</td><td>{:.0}</td></tr>"#,
            escape(s.method.0),
            part(s.cells[0]),
            s.unbiased_part(),
            part(s.cells[1]),
            s.cost
        );
    }
    let mut maps = String::new();
    let mut last = None;
    for (kind, sweep, svg) in sheets {
        if last != Some(*kind) {
            let _ = writeln!(maps, r#"<h2 id="{}">{}</h2>"#, kind.name(), escape(&kind.about()));
            last = Some(*kind);
        }
        // a narrow screen scrolls it, also by keyboard
        let title = escape(sweep.title);
        let _ = writeln!(
            maps,
            r#"<h3>{title}</h3><div class="sheet" tabindex="0" role="region" aria-label="maps: {title}">{svg}</div>"#
        );
    }
    include_str!("atlas.html")
        .replace("{{DETAIL}}", if quick { "This is a quick survey with coarse axes. " } else { "" })
        .replace("{{ERRORS}}", &legend(&ERRORS, -8, 0, "≤", "≥"))
        .replace("{{RATIOS}}", &legend(&RATIOS, -3, 8, "≤", "≥"))
        .replace("{{SUMMARY}}", &rows)
        .replace("{{MAPS}}", &maps)
}

fn table_of_cells(charts: &[ErrorMap]) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut out = csv::Writer::from_writer(Vec::new());
    out.write_record([
        "shape",
        "sweep",
        "technique",
        "ours",
        "x",
        "y",
        "direction",
        "pdf",
        "round_trip",
        "invertible",
        "invalid",
        "bias",
        "variance_ratio",
        "efficiency",
        "meets",
    ])?;
    for chart in charts {
        let nx = chart.sweep.x.len();
        for (i, cell) in chart.cells.iter().enumerate() {
            let number = |x: f64| if x.is_nan() { String::new() } else { format!("{x:e}") };
            out.write_record([
                chart.kind.name(),
                chart.sweep.name.into(),
                chart.method.name.into(),
                chart.method.ours.to_string(),
                number(chart.sweep.x[i % nx].value),
                number(chart.sweep.y[i / nx].value),
                number(cell.direction),
                number(cell.pdf),
                number(cell.round_trip),
                number(cell.invertible),
                number(cell.invalid),
                number(cell.bias),
                number(cell.variance_ratio),
                number(chart.efficiency(cell)),
                cell.meets().to_string(),
            ])?;
        }
    }
    Ok(out.into_inner()?)
}

/// Writes `atlas.csv`, one SVG of maps per sweep, and finally `atlas.html`, which contains everything.
///
/// # Errors
/// Fails if a file cannot be written.
pub fn write(charts: &[ErrorMap], directory: &Path, quick: bool) -> Result<(), Box<dyn Error>> {
    let mut sheets: Vec<(ShapeKind, Sweep, String)> = Vec::new();
    let mut rest = charts;
    while let Some(first) = rest.first() {
        let same = |c: &&ErrorMap| c.kind == first.kind && c.sweep.name == first.sweep.name;
        let n = rest.iter().take_while(same).count();
        let (these, others) = rest.split_at(n);
        sheets.push((first.kind, first.sweep.clone(), sheet(&these.iter().collect::<Vec<_>>())));
        rest = others;
    }
    files::replace(&directory.join("atlas.csv"), &table_of_cells(charts)?)?;
    for (kind, sweep, svg) in &sheets {
        let path = directory.join(format!("{}-{}.svg", kind.name(), sweep.name));
        files::replace(&path, svg.as_bytes())?;
    }
    let path = directory.join("atlas.html");
    files::replace(&path, html(charts, &sheets, quick).as_bytes())?;
    Ok(())
}
