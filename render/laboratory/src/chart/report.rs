//! Writes the report: a self-contained page of charts and tables, with a description of the machine.

use super::answer::{convention, percent as error_percent, seconds};
use super::charts::{Against, Figure, Measure, id, with_interval};
use super::outcome::Outcome;
use super::plot::{color, dash, escape, short};
use super::stats::WIDEST;
use super::summary::{ERRORS, Summary, Way};
use etendue_render::Sampler;
use std::collections::BTreeSet;
use std::fmt::Write;

/// What every page has, and no other file.
pub(super) const TITLE: &str = "<title>Speed against accuracy</title>";

fn table(summary: &Summary) -> String {
    let columns = ERRORS.map(|error| format!("<th>seconds to {}</th>", error_percent(error))).concat();
    let mut text = format!(
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"series\"><table><tr><th>series</th>{columns}\
         <th>slope of squared error over samples</th><th>bias</th></tr>\n"
    );
    let leaders = summary.leaders();
    for &index in &summary.ranking {
        let series = &summary.series[index];
        let unknown = || "?".to_owned();
        let slope = series.slope.as_ref().map_or_else(unknown, |s| with_interval(s).replace('-', "−"));
        let reached = series.reaches.map(|reach| reach.map_or_else(unknown, |reach| seconds(&reach)));
        let _ = writeln!(
            text,
            "<tr data-series=\"{}\"{}><td>{}</td><td>{}</td><td>{slope}</td><td>{}</td></tr>",
            escape(&id(series)),
            if leaders.contains(&index) { " data-best=\"\"" } else { " class=\"off\"" },
            escape(&series.way.title()),
            reached.join("</td><td>"),
            series.bias(summary.bias_limit),
        );
    }
    text + "</table></div>\n"
}

/// A section for each scene: charts and a table.
fn sections(outcome: &Outcome, figures: &[Vec<Figure>], stems: &[String]) -> String {
    let mut text = String::new();
    for ((summary, figures), stem) in outcome.summaries.iter().zip(figures).zip(stems) {
        let _ = writeln!(text, "<section class=\"scene\">\n<h2>{}</h2>\n<div class=\"grid\">", escape(&summary.scene));
        for figure in figures {
            let (against, measure) = figure.shown_for;
            let is_shown = against.is_shown(outcome.clock) && measure == Measure::Rms;
            let class = if is_shown { "" } else { " class=\"off\"" };
            let shown_for = format!("{class} data-against=\"{}\" data-measure=\"{}\"", against.name(), measure.name());
            let caption = escape(&figure.caption);
            let drawing = figure.drawing.inline();
            let file = format!("{stem}-{}.svg", figure.file);
            let link = format!(
                "<a href=\"{0}\" title=\"{0}: the series shown at first, with a legend\">SVG</a>",
                escape(&file)
            );
            let _ = writeln!(text, "<figure{shown_for}>{drawing}<figcaption>{caption} {link}</figcaption></figure>");
        }
        text += "</div>\n<p class=\"empty off\">No series is selected: choose a technique and a sampler above.</p>\n";
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
    // in the order in which they reach an error
    let ranked = || outcome.summaries.iter().flat_map(|s| s.ranking.iter().map(|index| s.series[*index].way));
    let mut methods: Vec<Way> = Vec::new();
    for way in ranked() {
        if methods.iter().all(|other| other.method() != way.method()) {
            methods.push(way);
        }
    }
    let technique =
        |way: &Way| chip(&way.method(), true, &format!("<i style=\"background:{}\"></i>", color(way.color())));
    let sampler = |sampler: &Sampler| {
        let dash = dash(*sampler as usize);
        let line = format!("<path d=\"M0 4H26\" stroke=\"#333\" stroke-width=\"2\" stroke-dasharray=\"{dash}\"/>");
        chip(sampler.name(), false, &format!("<svg viewBox=\"0 0 26 8\">{line}</svg>"))
    };
    let measured = |sampler: &&Sampler| ways().any(|way| way.sampler == **sampler);
    [
        methods.iter().map(technique).collect(),
        Sampler::ALL.iter().filter(measured).map(sampler).collect(),
        Against::ALL.map(|against| chip(against.name(), against.is_shown(outcome.clock), "")).concat(),
        Measure::ALL.map(|measure| chip(measure.name(), measure == Measure::Rms, "")).concat(),
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

/// What the page begins with: for each scene, after how many seconds which errors are reached.
fn answers(outcome: &Outcome) -> String {
    let mut text = String::new();
    for summary in &outcome.summaries {
        let sentences = summary.sentences();
        let none = || vec!["no error is large enough to be measured".to_owned()];
        let sentences = if sentences.is_empty() { none() } else { sentences };
        let items: String = sentences.iter().map(|sentence| format!("<li>{}</li>\n", escape(sentence))).collect();
        let _ =
            writeln!(text, "<h2 class=\"answer\">{}</h2>\n<ul class=\"best\">\n{items}</ul>", escape(&summary.scene));
    }
    let remark =
        outcome.clock.remark().map_or_else(String::new, |remark| format!("<p>Here {}.</p>\n", escape(&remark)));
    text + &remark
}

/// The whole page, beside which are the charts, in files that begin with these stems.
#[must_use]
pub fn page(outcome: &Outcome, figures: &[Vec<Figure>], stems: &[String], command: &str) -> String {
    let [techniques, samplers, against, measures] = chips(outcome);
    let notes: String = outcome.notes.iter().map(|n| format!("<p>{}</p>\n", escape(n))).collect();
    include_str!("report.html")
        .replace("{{widest}}", &format!("{:.0}", 100.0 * WIDEST))
        .replace("{{answers}}", &answers(outcome))
        .replace("{{convention}}", &escape(&convention()))
        .replace("{{notes}}", &notes)
        .replace("{{techniques}}", &techniques)
        .replace("{{samplers}}", &samplers)
        .replace("{{against}}", &against)
        .replace("{{measures}}", &measures)
        .replace("{{facts}}", &facts(outcome, command))
        .replace("{{scenes}}", &sections(outcome, figures, stems))
}
