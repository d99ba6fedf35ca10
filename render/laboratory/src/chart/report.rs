//! Writes the report: a self-contained page of charts and tables, with a description of the machine.

use super::charts::{Against, Figure, Measure, id, with_interval};
use super::outcome::Outcome;
use super::plot::{color, dash, escape, short};
use super::reference::KNOWN_TO;
use super::stats::{Estimate, WIDEST};
use super::summary::{Summary, Way};
use etendue_render::Sampler;
use std::collections::{BTreeMap, BTreeSet};
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
         <th>seconds at {0} spp</th><th>efficiency relative to {1}</th><th>bias</th></tr>\n",
        summary.spp,
        escape(&base),
    );
    let leaders = summary.leaders();
    for &index in &summary.ranking {
        let series = &summary.series[index];
        let unknown = || "?".to_owned();
        let slope = |s: &Option<Estimate>| s.as_ref().map_or_else(unknown, |s| with_interval(s).replace('-', "−"));
        let point = series.at(summary.spp);
        let gain = summary.gains.iter().find(|g| g.series == index).map_or_else(unknown, |g| percent(&g.gain));
        let _ = writeln!(
            text,
            "<tr data-series=\"{}\"{}><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{gain}</td>\
             <td>{}</td></tr>",
            escape(&id(series)),
            if leaders.contains(&index) { " data-best=\"\"" } else { " class=\"off\"" },
            escape(&series.way.title()),
            slope(&series.slope),
            slope(&series.slope_in_time),
            point.map_or_else(unknown, |p| percent(&p.mse)),
            point.map_or_else(unknown, |p| percent(&p.seconds)),
            series.bias(summary.bias_limit),
        );
    }
    text + "</table></div>\n"
}

/// A section for each scene: charts and a table.
fn sections(outcome: &Outcome, figures: &[Vec<Figure>]) -> String {
    let mut text = String::new();
    for (summary, figures) in outcome.summaries.iter().zip(figures) {
        let _ = writeln!(text, "<section class=\"scene\">\n<h2>{}</h2>\n<div class=\"grid\">", escape(&summary.scene));
        for figure in figures {
            let shown_for = figure.shown_for.map_or_else(String::new, |(against, measure)| {
                let is_shown = against.is_shown() && measure == Measure::Mse;
                let class = if is_shown { "" } else { " class=\"off\"" };
                format!("{class} data-against=\"{}\" data-measure=\"{}\"", against.name(), measure.name())
            });
            let caption = escape(&figure.caption);
            let drawing = figure.drawing.inline();
            let _ = writeln!(text, "<figure{shown_for}>{drawing}<figcaption>{caption}</figcaption></figure>");
        }
        text += "</div>\n";
        text += &table(summary);
        text += "</section>\n";
    }
    text
}

/// A button that shows or hides what has this value; `sample` shows its colour or line.
fn chip(value: &str, is_pressed: bool, sample: &str) -> String {
    let value = escape(value);
    format!("<button class=\"chip\" aria-pressed=\"{is_pressed}\" data-value=\"{value}\">{sample}{value}</button>")
}

/// Buttons for the techniques, the samplers, what errors are drawn against and which errors are drawn.
fn chips(outcome: &Outcome) -> [String; 4] {
    let ways = || outcome.summaries.iter().flat_map(|summary| &summary.series).map(|series| series.way);
    let methods: BTreeMap<_, Way> = ways().map(|way| ((way.technique as usize, way.choice as usize), way)).collect();
    let technique =
        |way: &Way| chip(&way.method(), true, &format!("<i style=\"background:{}\"></i>", color(way.color())));
    let sampler = |sampler: &Sampler| {
        let dash = dash(*sampler as usize);
        let line = format!("<path d=\"M0 4H26\" stroke=\"#333\" stroke-width=\"2\" stroke-dasharray=\"{dash}\"/>");
        chip(sampler.name(), false, &format!("<svg viewBox=\"0 0 26 8\">{line}</svg>"))
    };
    let measured = |sampler: &&Sampler| ways().any(|way| way.sampler == **sampler);
    [
        methods.values().map(technique).collect(),
        Sampler::ALL.iter().filter(measured).map(sampler).collect(),
        Against::ALL.map(|against| chip(against.name(), against.is_shown(), "")).concat(),
        Measure::ALL.map(|measure| chip(measure.name(), measure == Measure::Mse, "")).concat(),
    ]
}

/// Rows of a table: how and on what this was measured.
fn facts(outcome: &Outcome, command: &str) -> String {
    let plan = &outcome.plan;
    let spps: BTreeSet<u32> = plan.keys.iter().map(|key| key.spp).collect();
    let spps: Vec<String> = spps.iter().map(ToString::to_string).collect();
    let seeds = format!(
        "{}, from which the seed of each image derives (column seed of measurements.csv); {} replicates",
        plan.seed, plan.replicates
    );
    let mut facts = vec![("command", command.to_owned())];
    facts.extend(outcome.facts.iter().cloned());
    facts.extend([("samples per pixel", spps.join(", ")), ("seeds", seeds)]);
    let scenes = plan.scenes.iter().map(|subject| {
        let ([w, h], reference) = (subject.size, &subject.reference);
        let (about, error, settings) = (&reference.about, short(reference.error), subject.settings);
        let text = format!("{w}×{h}; reference {about}, mean squared standard error {error}; settings {settings:016x}");
        (&*subject.name, text)
    });
    let row =
        |(name, value): (&str, String)| format!("<tr><td>{}</td><td>{}</td></tr>\n", escape(name), escape(&value));
    facts.into_iter().chain(scenes).map(row).collect()
}

/// The whole page.
#[must_use]
pub fn page(outcome: &Outcome, figures: &[Vec<Figure>], command: &str) -> String {
    let [techniques, samplers, against, measures] = chips(outcome);
    let best: String = outcome.summaries.iter().map(|s| format!("<li>{}</li>\n", escape(&s.headline()))).collect();
    let notes: String = outcome.notes.iter().map(|n| format!("<p>{}</p>\n", escape(n))).collect();
    include_str!("report.html")
        .replace("{{known}}", &format!("{:.0}", 100.0 * KNOWN_TO))
        .replace("{{widest}}", &format!("{:.0}", 100.0 * WIDEST))
        .replace("{{best}}", &best)
        .replace("{{notes}}", &notes)
        .replace("{{techniques}}", &techniques)
        .replace("{{samplers}}", &samplers)
        .replace("{{against}}", &against)
        .replace("{{measures}}", &measures)
        .replace("{{facts}}", &facts(outcome, command))
        .replace("{{scenes}}", &sections(outcome, figures))
}
