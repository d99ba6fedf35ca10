//! Writes the table and the page.

use crate::maps::{ERRORS, RATIOS, blend, sheet};
use crate::pose::{ShapeKind, Sweep};
use crate::survey::{ErrorMap, LIMIT};
use etendue_laboratory::chart::plot::escape;
use etendue_oracle::Greatest;
use etendue_render::film::files;
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

/// Greatest errors of a technique over all its sweeps.
#[derive(Clone, Debug)]
pub struct Summary {
    /// ShapeKind of shape.
    pub kind: ShapeKind,
    /// Name of the technique, and whether it belongs to the library.
    pub method: (String, bool),
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
        let at = all.iter().position(|s| s.kind == chart.kind && s.method == chart.method).unwrap_or_else(|| {
            all.push(Summary {
                kind: chart.kind,
                method: chart.method.clone(),
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
            escape(&s.method.0),
            part(s.cells[0]),
            s.unbiased_part(),
            part(s.cells[1]),
            s.cost
        );
    }
    let mut maps = String::new();
    let mut contents =
        r##"<nav aria-label="Contents"><a href="#summary">Greatest errors</a><a href="#key">How to read the maps</a>"##
            .to_owned();
    let mut last = None;
    for (kind, sweep, svg) in sheets {
        if last != Some(*kind) {
            let (name, about) = (kind.name(), escape(&kind.about()));
            let _ = writeln!(maps, r#"<h2 id="{name}">{about}</h2>"#);
            let _ = write!(contents, r##"<a href="#{name}">{about}</a>"##);
            last = Some(*kind);
        }
        // a narrow screen scrolls it, also by keyboard
        let [title, across, up] = [sweep.title, sweep.x_title, sweep.y_title].map(escape);
        let _ = writeln!(
            maps,
            r#"<h3>{title} <small>(across: {across}; up: {up})</small></h3><div class="sheet" tabindex="0" role="region" aria-label="maps: {title}">{svg}</div>"#
        );
    }
    include_str!("atlas.html")
        .replace("{{DETAIL}}", if quick { "This is a quick survey with coarse axes. " } else { "" })
        .replace("{{ERRORS}}", &legend(&ERRORS, -8, 0, "≤", "≥"))
        .replace("{{RATIOS}}", &legend(&RATIOS, -3, 8, "≤", "≥"))
        .replace("{{CONTENTS}}", &(contents + "</nav>"))
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
                chart.method.0.clone(),
                chart.method.1.to_string(),
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
