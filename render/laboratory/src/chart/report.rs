//! Writes the report: a self-contained page of charts, tables and images, with a description of the machine.

use super::charts::{Figure, id, with_interval};
use super::measure::Key;
use super::outcome::Outcome;
use super::pictures::{Panel, Picture};
use super::plot::{color, dash, escape, short};
use super::reference::KNOWN_TO;
use super::stats::{Estimate, WIDEST};
use super::summary::{Summary, Way};
use base64::Engine;
use etendue_render::Sampler;
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt::Write;

/// What every page has, and no other file.
pub(super) const TITLE: &str = "<title>Speed against accuracy</title>";

/// Formats a value with half of its interval in per cent.
fn percent(e: &Estimate) -> String {
    let interval = match e.relative() {
        _ if !e.half.is_finite() => "?".to_owned(),
        wide if wide >= 10.0 => ">999 %".to_owned(),
        part => format!("{:.0} %", 100.0 * part),
    };
    format!("{} ±{interval}", short(e.value))
}

fn table(summary: &Summary) -> String {
    let base = summary.baseline.map_or_else(String::new, |b| summary.series[b].way.title());
    let mut text = format!(
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"series\"><table><tr><th>series</th><th>slope over samples</th><th>slope over time</th><th>error at {0} spp</th>\
         <th>seconds at {0} spp</th><th>efficiency relative to {1}</th><th>seconds to {2}</th><th>bias</th></tr>\n",
        summary.spp,
        escape(&base),
        short(summary.target)
    );
    let leaders = summary.leaders();
    for &index in &summary.ranking {
        let series = &summary.series[index];
        let unknown = || "?".to_owned();
        let slope = |s: &Option<Estimate>| s.as_ref().map_or_else(unknown, |s| with_interval(s).replace('-', "−"));
        let point = series.at(summary.spp);
        let gain = summary.gains.iter().find(|g| g.series == index).map_or_else(unknown, |g| percent(&g.gain));
        let seconds = series
            .seconds_to(summary.target)
            .map_or_else(unknown, |(s, beyond)| format!("{}{} s", if beyond { "≈ " } else { "" }, short(s)));
        let bias =
            series.points.iter().map(|p| p.bias).filter(|b| !b.is_nan()).max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let _ = writeln!(
            text,
            "<tr data-series=\"{}\"{}><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{gain}</td><td>{seconds}</td>\
             <td>{}</td></tr>",
            escape(&id(series)),
            if leaders.contains(&index) { " data-best=\"\"" } else { " class=\"off\"" },
            escape(&series.way.title()),
            slope(&series.slope),
            slope(&series.slope_in_time),
            point.map_or_else(unknown, |p| percent(&p.mse)),
            point.map_or_else(unknown, |p| percent(&p.seconds)),
            bias.map_or_else(unknown, |b| format!("{b:+.1}").replace('-', "−")),
        );
    }
    text + "</table></div>\n"
}

fn viewer(index: usize, panel: &Panel) -> String {
    format!(
        "<div class=\"viewer\" data-scene=\"{index}\" tabindex=\"0\"><div class=\"controls\"><span class=\"chips kinds\"></span>\
         <label>left <select class=\"pick\"></select></label><label>right <select class=\"pick\"></select></label></div>\
         <div class=\"stage\"><img alt=\"left image\"><img alt=\"right image\"><div class=\"edge\"></div><span class=\"left\"></span>\
         <span class=\"right\"></span></div><input type=\"range\" min=\"0\" max=\"100\" value=\"50\" \
         aria-label=\"position of the boundary between the two images\">\
         <p><small><span class=\"by-hand\">Drag the boundary, or click here and press <kbd>f</kbd> to flip between the two, \
         <kbd>←</kbd> <kbd>→</kbd> to step through all.</span> {}</small></p>\
         <div class=\"thumbs\"></div></div>\n",
        escape(&panel.caption)
    )
}

/// The whole page; `warps` is a figure and an HTML table.
#[must_use]
pub fn page(
    outcome: &Outcome,
    figures: &[Vec<Figure>],
    panels: &[Panel],
    warps: Option<&(Figure, String)>,
    command: &str,
) -> String {
    let mut scenes = String::new();
    for (index, summary) in outcome.summaries.iter().enumerate() {
        let _ =
            writeln!(scenes, "<section class=\"scene\">\n<h2>{}</h2>\n<div class=\"grid\">", escape(&summary.scene));
        for figure in &figures[index] {
            let caption = escape(&figure.caption);
            let _ = writeln!(scenes, "<figure>{}<figcaption>{caption}</figcaption></figure>", figure.drawing.inline());
        }
        scenes += "</div>\n";
        scenes += &table(summary);
        if let Some(panel) = panels.iter().find(|p| p.scene == summary.scene) {
            scenes += &viewer(index, panel);
        }
        scenes += "</section>\n";
    }
    if let Some((figure, table)) = warps {
        let (drawing, caption) = (figure.drawing.file(), escape(&figure.caption));
        let _ = writeln!(
            scenes,
            "<h2>Warps</h2>\n<div class=\"grid\"><figure>{drawing}<figcaption>{caption}</figcaption></figure></div>\n{table}"
        );
    }
    let chip = |value: &str, pressed: bool, sample: String| {
        format!(
            "<button class=\"chip\" aria-pressed=\"{pressed}\" data-value=\"{0}\">{sample}{0}</button>",
            escape(value)
        )
    };
    let ways = || outcome.summaries.iter().flat_map(|summary| &summary.series).map(|series| series.way);
    let methods: BTreeMap<_, Way> = ways().map(|way| ((way.technique as usize, way.choice as usize), way)).collect();
    let techniques: String = methods
        .values()
        .map(|way| {
            let [r, g, b] = color(way.color());
            chip(&way.method(), true, format!("<i style=\"background:rgb({r},{g},{b})\"></i>"))
        })
        .collect();
    let samplers: BTreeMap<usize, Sampler> = ways().map(|way| (way.sampler as usize, way.sampler)).collect();
    let samplers: String = samplers
        .into_iter()
        .map(|(n, sampler)| {
            let dashes = dash(n).map_or_else(String::new, |(on, off)| format!(" stroke-dasharray=\"{on} {off}\""));
            let sample = format!(
                "<svg viewBox=\"0 0 26 8\"><path d=\"M0 4H26\" stroke=\"#333\" stroke-width=\"2\"{dashes}/></svg>"
            );
            chip(sampler.name(), false, sample)
        })
        .collect();
    let mut facts = vec![("command", command.to_owned())];
    facts.extend(outcome.facts.iter().map(|(k, v)| (*k, v.clone())));
    let list = |f: &dyn Fn(&Key) -> u32| {
        let mut list: Vec<u32> = outcome.plan.keys.iter().map(f).collect();
        list.sort_unstable();
        list.dedup();
        list.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
    };
    facts.push(("samples per pixel", list(&|k| k.spp)));
    let seed = outcome.plan.seed;
    facts.push((
        "seeds",
        format!(
            "{seed}, from which the seed of each image derives (column seed of measurements.csv); {} replicates",
            outcome.plan.replicates
        ),
    ));
    let mut rows = String::new();
    for (key, value) in &facts {
        let _ = writeln!(rows, "<tr><td>{key}</td><td>{}</td></tr>", escape(value));
    }
    for subject in &outcome.plan.scenes {
        let [w, h] = subject.size;
        let _ = writeln!(
            rows,
            "<tr><td>{}</td><td>{w}×{h}; reference {}, mean squared standard error {}; settings {:016x}</td></tr>",
            escape(&subject.name),
            escape(&subject.reference.about),
            short(subject.reference.error),
            subject.settings
        );
    }
    let data: Vec<_> = outcome
        .summaries
        .iter()
        .map(|s| {
            let pictures = panels.iter().find(|p| p.scene == s.scene).map_or(&[][..], |p| &p.pictures);
            let one = |p: &Picture| {
                let uri = format!("data:image/png;base64,{}", base64::engine::general_purpose::STANDARD.encode(&p.png));
                json!({ "kind": p.kind, "title": p.title, "uri": uri })
            };
            pictures.iter().map(one).collect::<Vec<_>>()
        })
        .collect();
    // "</" could end the script
    let data = json!(data).to_string().replace("</", "<\\/");
    let best: String = outcome.summaries.iter().map(|s| format!("<li>{}</li>\n", escape(&s.headline()))).collect();
    let notes: String = outcome.notes.iter().map(|n| format!("<p>{}</p>\n", escape(n))).collect();
    // the data last, so that placeholders are not searched for in it
    include_str!("report.html")
        .replace("{{known}}", &format!("{:.0}", 100.0 * KNOWN_TO))
        .replace("{{widest}}", &format!("{:.0}", 100.0 * WIDEST))
        .replace("{{best}}", &best)
        .replace("{{notes}}", &notes)
        .replace("{{techniques}}", &techniques)
        .replace("{{samplers}}", &samplers)
        .replace("{{facts}}", &rows)
        .replace("{{scenes}}", &scenes)
        .replace("{{data}}", &data)
}
