//! Verdicts as text, as JSON and as a page.

use crate::lights::verdict::{Judgement, Map};
use std::fmt::Write as _;

/// The table that fits into a README: a row for each sampler.
#[must_use]
pub fn table(all: &[Judgement]) -> String {
    let mut out = String::from("| sampler | by | verdict | right at | worst error | ns |\n|---|---|---|---|---|---|\n");
    for j in all {
        let [right, tried] = j.share();
        let verdict = if j.is_right() { "right" } else { "**wrong**" };
        let nanoseconds = if j.nanoseconds > 0.0 { format!("{:.0}", j.nanoseconds) } else { "–".into() };
        let _ = writeln!(
            out,
            "| {} | {} | {verdict} | {right}/{tried} places | {:.1e} | {nanoseconds} |",
            j.name,
            j.measure,
            j.worst()
        );
    }
    out
}

/// What is wrong, in sentences, with the inputs that show it.
#[must_use]
pub fn text(all: &[Judgement]) -> String {
    let mut out = String::new();
    for j in all {
        let [right, tried] = j.share();
        let domain = if j.domain.is_empty() { String::new() } else { format!(", where {}", j.domain) };
        let verdict = if j.is_right() { "right" } else { "WRONG" };
        let _ = writeln!(out, "{}: {verdict} ({right} of {tried} places{domain}; {:.1} s)", j.name, j.seconds);
        for f in &j.findings {
            let _ = writeln!(out, "  - {}\n      {}", f.said, f.input.trim_end().replace('\n', "\n      "));
        }
    }
    out
}

/// For continuous integration.
#[must_use]
pub fn json(all: &[Judgement]) -> String {
    serde_json::to_string_pretty(&all).unwrap_or_else(|e| format!("\"{e}\""))
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// The colour of an error: blue to 1e−3, from there yellow to black.
fn colour(error: f64) -> String {
    const STOPS: [(f64, [f64; 3]); 7] = [
        (-7.0, [237.0, 244.0, 250.0]),
        (-5.0, [124.0, 178.0, 216.0]),
        (-3.01, [60.0, 134.0, 189.0]),
        (-3.0, [255.0, 236.0, 160.0]),
        (-2.0, [248.0, 141.0, 66.0]),
        (-1.0, [176.0, 20.0, 37.0]),
        (0.0, [40.0, 0.0, 16.0]),
    ];
    if error < 0.0 {
        return "#dcdcdc".into();
    }
    let log = if error.is_nan() { 0.0 } else { error.max(1e-30).log10().clamp(-7.0, 0.0) };
    let i = (1..STOPS.len()).find(|&i| log <= STOPS[i].0).unwrap_or(STOPS.len() - 1);
    let ((low, from), (high, to)) = (STOPS[i - 1], STOPS[i]);
    let part = ((log - low) / (high - low)).clamp(0.0, 1.0);
    let [r, g, b] = [0, 1, 2].map(|k| (from[k] + (to[k] - from[k]) * part) as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn map(map: &Map) -> String {
    const CELL: f64 = 26.0;
    let (nx, ny) = (map.across.1.len(), map.up.1.len());
    let (width, height) = (nx as f64 * CELL + 70.0, ny as f64 * CELL + 44.0);
    let mut out = format!(
        r#"<svg viewBox="0 0 {width} {height}" style="width:{width}px;max-width:100%" font-family="sans-serif" font-size="9" fill="currentColor" role="img" aria-label="errors over {:?} and {:?}">"#,
        map.across.0, map.up.0
    );
    for (i, error) in map.errors.iter().enumerate() {
        let (x, y) = (64.0 + (i % nx) as f64 * CELL, (ny - 1 - i / nx) as f64 * CELL);
        let fill = colour(*error);
        let said = if *error < 0.0 { "outside of its domain".into() } else { format!("{error:.1e}") };
        let _ = write!(
            out,
            r#"<rect x="{x}" y="{y}" width="{CELL}" height="{CELL}" fill="{fill}"><title>{said}</title></rect>"#
        );
    }
    let number = |x: f64| if (0.01..1000.0).contains(&x.abs()) || x == 0.0 { format!("{x}") } else { format!("{x:e}") };
    let bottom = ny as f64 * CELL;
    for (i, x) in map.across.1.iter().enumerate() {
        let at = 64.0 + (i as f64 + 0.5) * CELL;
        let _ = write!(out, r#"<text x="{at}" y="{}" text-anchor="middle">{}</text>"#, bottom + 12.0, number(*x));
    }
    for (i, y) in map.up.1.iter().enumerate() {
        let at = (ny - 1 - i) as f64 * CELL + 0.6 * CELL;
        let _ = write!(out, r#"<text x="60" y="{at}" text-anchor="end">{}</text>"#, number(*y));
    }
    let _ = write!(
        out,
        r#"<text x="64" y="{}">across: {}; up: {}</text></svg>"#,
        bottom + 30.0,
        map.across.0.name(),
        map.up.0.name()
    );
    out
}

/// All samplers: nanoseconds to the right, the worst error upwards.
fn chart(all: &[Judgement]) -> String {
    let shown: Vec<_> = all.iter().filter(|j| j.nanoseconds > 0.0).collect();
    if shown.is_empty() {
        return String::new();
    }
    let times = shown.iter().map(|j| j.nanoseconds.log10());
    let low = times.clone().fold(f64::INFINITY, f64::min).floor();
    let high = times.fold(0.0, f64::max).ceil().max(low + 1.0);
    let x = |ns: f64| 60.0 + 560.0 * (ns.log10() - low) / (high - low);
    let y = |error: f64| 20.0 + 40.0 * (0.0 - error.clamp(1e-7, 1.0).log10());
    let height = (24.0 + 14.0 * shown.len() as f64).max(350.0);
    let mut out = format!(
        r#"<svg viewBox="0 0 940 {height}" style="width:940px;max-width:100%" font-family="sans-serif" font-size="11" fill="currentColor" role="img" aria-label="speed against accuracy">"#,
    );
    for power in -7..=0 {
        let at = y(10.0_f64.powi(power));
        let _ = write!(
            out,
            r##"<path d="M60 {at}h560" stroke="#8886"/><text x="54" y="{}" text-anchor="end">1e{power}</text>"##,
            at + 4.0
        );
    }
    for power in low as i32..=high as i32 {
        let at = x(10.0_f64.powi(power));
        let _ = write!(
            out,
            r##"<path d="M{at} 20v280" stroke="#8886"/><text x="{at}" y="316" text-anchor="middle">{} ns</text>"##,
            10.0_f64.powi(power)
        );
    }
    let limit = y(1e-3);
    let _ = write!(out, r##"<path d="M60 {limit}h560" stroke="#c33" stroke-dasharray="5 4"/>"##);
    for (i, j) in shown.iter().enumerate() {
        let (cx, cy) = (x(j.nanoseconds), y(j.worst()));
        let fill = if j.is_right() { "#2a7ab8" } else { "#c0392b" };
        let name = escape(&j.name);
        let _ = write!(
            out,
            r#"<circle cx="{cx:.1}" cy="{cy:.1}" r="6" fill="{fill}" fill-opacity="0.8"><title>{name}</title></circle><text x="{:.1}" y="{:.1}" font-size="9">{}</text>"#,
            cx + 8.0,
            cy + 3.0,
            i + 1
        );
        let row = 24.0 + 14.0 * i as f64;
        let _ = write!(out, r#"<text x="632" y="{row}" fill="{fill}">{} {name}</text>"#, i + 1);
    }
    out.push_str(
        r#"<text x="340" y="338" text-anchor="middle">nanoseconds to prepare a light and draw a sample</text></svg>"#,
    );
    out
}

const STYLE: &str = "body{font:16px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#222;background:#fff}\
table{border-collapse:collapse}td,th{padding:.2rem .7rem;border-bottom:1px solid #ccc;text-align:left}\
.right{color:#1c6a2c}.wrong{color:#b3261e;font-weight:600}.wide{overflow-x:auto}pre{background:#f3f3f3;padding:.6rem;white-space:pre-wrap;overflow-wrap:anywhere;font-size:13px}\
@media(prefers-color-scheme:dark){body{color:#ddd;background:#181818}pre{background:#262626}.right{color:#7ecb8f}.wrong{color:#ff8a80}}";

/// A page that needs nothing else.
#[must_use]
pub fn html(all: &[Judgement]) -> String {
    let wrong = all.iter().filter(|j| !j.is_right()).count();
    let mut out = format!(
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\
         <title>Samplers of lights, judged</title><style>{STYLE}</style><h1>Samplers of lights, judged</h1><p>{} of {} samplers \
         are right wherever they claim to be. A sampler is wrong where a pdf or an estimate is off by more than 0.1 %, or a \
         direction misses the light.</p><div class=wide tabindex=0 role=region aria-label=verdicts><table><tr><th>sampler<th>verdict<th>right at<th>worst error<th>ns</tr>",
        all.len() - wrong,
        all.len()
    );
    for (i, j) in all.iter().enumerate() {
        let [right, tried] = j.share();
        let (class, verdict) = if j.is_right() { ("right", "right") } else { ("wrong", "wrong") };
        let _ = write!(
            out,
            "<tr><td><a href=\"#s{i}\">{}</a><td class={class}>{verdict}<td>{right} of {tried} places<td>{:.1e}<td>{:.0}</tr>",
            escape(&j.name),
            j.worst(),
            j.nanoseconds
        );
    }
    let _ = write!(out, "</table></div><h2>Speed against accuracy</h2>{}", chart(all));
    out.push_str("<p>Lower is more accurate, further left is faster; the dashed line is the limit of 0.1 %.</p>");
    for (i, j) in all.iter().enumerate() {
        let _ = write!(out, "<h2 id=\"s{i}\">{}</h2><p>", escape(&j.name));
        if j.is_right() {
            out.push_str("<span class=right>Right</span> at all places that were tried.");
        } else {
            out.push_str("<span class=wrong>Wrong:</span></p><ul>");
            for f in &j.findings {
                let _ = write!(out, "<li>{}</li>", escape(&f.said));
            }
            out.push_str("</ul><p>");
        }
        let _ = write!(out, " It claims to be by {}", escape(&j.measure));
        if !j.domain.is_empty() {
            let _ = write!(out, ", and to be right where {}", escape(&j.domain));
        }
        out.push_str(".</p>");
        if let Some(errors) = &j.map {
            let _ = write!(out, "{}<p>Blue: within 0.1 %. Grey: outside of its domain.</p>", map(errors));
        }
        for f in &j.findings {
            let _ = write!(out, "<pre>{}: {}\n{}</pre>", escape(&j.name), escape(&f.said), escape(f.input.trim_end()));
        }
    }
    out.push_str("</html>\n");
    out
}
