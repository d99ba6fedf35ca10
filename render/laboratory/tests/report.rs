//! The report of `etendue chart` is read at a glance: a line per scene, the best sampler of each technique, bars in order, notes last.

use etendue_laboratory::chart::charts::{self, Against, Measure};
use etendue_laboratory::chart::measure::{ChartedScene, Key, Measurement, Plan, Rows};
use etendue_laboratory::chart::reference::{Difference, Reference};
use etendue_laboratory::chart::summary::{Summary, Way};
use etendue_laboratory::chart::{Outcome, plot, report};
use etendue_render::{ChoiceBy, Sampler, Technique, World};
use std::collections::HashSet;

const SPP: [u32; 3] = [1, 4, 16];
const TECHNIQUES: [Technique; 3] = [Technique::Area, Technique::SolidAngle, Technique::MisPower];
const SAMPLERS: [Sampler; 3] = [Sampler::Independent, Sampler::Stratified, Sampler::Sobol];
/// Mean squared error and seconds at 1 sample per pixel; the errors of all but `Independent` fall faster than 1/N.
const COSTS: [[(f64, f64); 3]; 3] = [
    [(0.10, 0.010), (0.09, 0.011), (0.07, 0.012)],
    // sobol has the least error of all at any number of samples, but takes ten times as long
    [(0.02, 0.010), (0.015, 0.011), (0.012, 0.12)],
    [(0.03, 0.020), (0.025, 0.021), (0.02, 0.022)],
];

fn cost(key: &Key) -> (f64, f64) {
    let at = |list: &[Sampler]| list.iter().position(|s| *s == key.sampler).unwrap();
    let (error, seconds) = COSTS[TECHNIQUES.iter().position(|t| *t == key.technique).unwrap()][at(&SAMPLERS)];
    let slope = if key.sampler == Sampler::Independent { -1.0 } else { -1.3 };
    (error * f64::from(key.spp).powf(slope), seconds * f64::from(key.spp))
}

fn outcome(names: &[&str]) -> Outcome {
    let charted = |name: &&str| ChartedScene {
        name: (*name).to_owned(),
        world: World::new(&etendue_scene::load("quads").unwrap()).unwrap(),
        size: [16, 16],
        settings: 0,
        reference: Reference::builtin("quads").unwrap().shrunk([16, 16]).unwrap(),
    };
    let scenes: Vec<_> = names.iter().map(charted).collect();
    let mut keys = Vec::new();
    for scene in 0..names.len() {
        for (technique, sampler) in TECHNIQUES.iter().flat_map(|t| SAMPLERS.map(|s| (*t, s))) {
            keys.extend(SPP.map(|spp| Key { scene, technique, choice: ChoiceBy::Auto, sampler, spp }));
        }
    }
    let mut rows = Rows::new();
    for key in &keys {
        let (error, seconds) = cost(key);
        let row = |replicate: u32| {
            let noise = 1.0 + 0.01 * f64::from(replicate);
            let squared = error * noise + scenes[key.scene].reference.error;
            let difference = Difference { squared, relative: 9.0 * squared, mean: 0.0 };
            let rays = [256 * u64::from(key.spp), 0, 0, 0];
            Measurement { replicate, seed: 0, seconds, cpu: Some(2.0 * seconds), repeats: 1, difference, rays }
        };
        rows.insert(*key, (0..3).map(row).collect());
    }
    let plan = Plan { scenes, keys, replicates: 3, seed: 0 };
    let baseline = Way { technique: Technique::Area, choice: ChoiceBy::Auto, sampler: Sampler::Independent };
    let summaries = (0..names.len()).map(|scene| Summary::new(&plan, &rows, scene, baseline)).collect();
    Outcome { plan, rows, summaries, facts: Vec::new(), notes: vec!["a remark at the end".to_owned()] }
}

fn page(outcome: &Outcome) -> String {
    let figures: Vec<_> = outcome.summaries.iter().map(charts::all).collect();
    report::page(outcome, &figures, "etendue chart")
}

/// The identifiers of the series in a chart, and whether each is hidden at first.
fn series(part: &str) -> Vec<(&str, bool)> {
    part.split("data-series=\"")
        .skip(1)
        .map(|s| {
            let tag = &s[..s.find('>').unwrap()];
            (&s[..s.find('"').unwrap()], tag.contains("class=\"off\""))
        })
        .collect()
}

#[test]
fn the_page_begins_with_the_best_series_of_each_scene() {
    let outcome = outcome(&["quads", "boxes"]);
    let page = page(&outcome);
    let head = &page[page.find("<h1").unwrap()..page.find("<nav").unwrap()];
    for (line, summary) in head.split("<li>").skip(1).zip(&outcome.summaries) {
        // by definition: the least error in the same time, in these data a power of the time
        let seconds = summary.seconds;
        let error = |way: &Way| {
            let Way { technique, choice, sampler } = *way;
            let key = |spp| Key { scene: 0, technique, choice, sampler, spp };
            let ((one, t), (many, _)) = (cost(&key(1)), cost(&key(16)));
            let slope = (many / one).ln() / 16.0_f64.ln();
            // below one sample per pixel, errors count as proportional to 1/time
            if seconds < t { one * t / seconds } else { one * (seconds / t).powf(slope) }
        };
        let ways: Vec<Way> = summary.series.iter().map(|s| s.way).collect();
        let best = ways.iter().min_by(|a, b| error(a).total_cmp(&error(b))).unwrap();
        assert_eq!((best.technique, best.sampler), (Technique::SolidAngle, Sampler::Stratified));
        assert_eq!(summary.series[summary.ranking[0]].way, *best);
        // the best of the others, and points uniform over the area with independent numbers
        let others = ways.iter().filter(|w| w.technique != best.technique);
        let other = others.min_by(|a, b| error(a).total_cmp(&error(b))).unwrap();
        assert_eq!((other.technique, other.sampler), (Technique::MisPower, Sampler::Sobol));
        let plain = ways.iter().find(|w| (w.technique, w.sampler) == (Technique::Area, Sampler::Independent)).unwrap();
        let [factor, of_plain] = [other, plain].map(|way| error(way) / error(best));
        let expected = format!(
            "{} — best: solid-angle with stratified; its squared error after 0.16 s is 1/{factor:.2} of that of mis-power with sobol, the best \
             other technique, and 1/{of_plain:.1} of that of plain area sampling",
            summary.scene
        );
        assert!(line.starts_with(&expected), "{line}\n{expected}");
    }
    assert_eq!(head.matches("<li>").count(), 2);
    assert!(!head.contains("a remark"), "notes come last");
}

#[test]
fn one_series_of_each_technique_is_shown_at_first() {
    let outcome = outcome(&["quads"]);
    let page = page(&outcome);
    let parts: Vec<&str> = page.split("<figure").skip(1).collect();
    // two errors against four costs, and efficiency
    assert_eq!(parts.len(), 9);
    let at_first = |part: &&&str| !part.starts_with(" class=\"off\"");
    assert_eq!(parts.iter().filter(at_first).count(), 3);
    let table = parts[8].split_once("<table>").unwrap().1;
    for part in parts.iter().map(|p| p.split("</figure>").next().unwrap()).chain([table]) {
        let all = series(part);
        assert_eq!(all.len(), 9, "{all:?}");
        let mut shown: Vec<_> = all.iter().filter(|s| !s.1).map(|s| s.0).collect();
        shown.sort_unstable();
        assert_eq!(shown, ["area/sobol", "mis-power/sobol", "solid-angle/stratified"]);
    }
    // the same in files, which hold nothing else
    let summary = &outcome.summaries[0];
    let error = charts::error(summary, Against::Time, Measure::Mse);
    for figure in [error.unwrap(), charts::efficiency(summary).unwrap()] {
        assert_eq!(series(&figure.drawing.file()).len(), 3);
        assert!(!figure.drawing.file().contains(">area, independent</text>"));
    }
    assert!(page.contains("data-all"), "a button shows the rest");
}

#[test]
fn bars_are_sorted_and_notes_come_last() {
    let outcome = outcome(&["quads"]);
    let page = page(&outcome);
    let summary = &outcome.summaries[0];
    let part = |title: &str| {
        let figure = page.split("<figure").find(|p| p.contains(title)).unwrap();
        figure.split("</figure>").next().unwrap()
    };
    let value =
        |id: &str, f: &dyn Fn(usize) -> f64| f(summary.series.iter().position(|s| charts::id(s) == id).unwrap());
    let gain = |i: usize| summary.gains.iter().find(|g| g.series == i).unwrap().gain.value;
    let efficiency = series(part(": efficiency at")).iter().map(|s| value(s.0, &gain)).collect::<Vec<_>>();
    assert!(efficiency.len() == 9 && efficiency.is_sorted_by(|a, b| a >= b), "{efficiency:?}");
    // rows are stacked from the top without gaps, hidden ones aside
    let rows: Vec<&str> = part(": efficiency at").split("translate(0 ").skip(1).collect();
    let places: Vec<i32> = rows.iter().map(|r| r[..r.find(')').unwrap()].parse().unwrap()).collect();
    assert!(places.is_sorted() && places.last() <= Some(&(3 * places.iter().find(|y| **y > 0).unwrap())), "{places:?}");
    let at = |text: &str| page.rfind(text).unwrap();
    assert!(at("a remark at the end") > at("</figure>") && at("a remark at the end") > at("How this was measured"));
}

#[test]
fn every_technique_has_a_colour_and_every_sampler_a_line_of_its_own() {
    let dashes: HashSet<_> = Sampler::ALL.map(|s| plot::dash(s as usize)).into_iter().collect();
    assert_eq!(dashes.len(), Sampler::ALL.len());
    let colours: HashSet<_> = Technique::ALL.map(|t| plot::color(t as usize)).into_iter().collect();
    assert_eq!(colours.len(), Technique::ALL.len());
}

/// Differences of three replicates from the reference that no chance explains are named, and chance is not.
#[test]
fn a_bias_is_named_where_there_is_one() {
    let mut outcome = outcome(&["quads"]);
    let reference = outcome.plan.scenes[0].reference.mean();
    for (key, rows) in &mut outcome.rows {
        let is_biased = key.technique == Technique::Area && key.sampler == Sampler::Sobol && key.spp == 4;
        for row in rows {
            let noise = 1e-3 * (f64::from(row.replicate) - 1.0);
            row.difference.mean = reference * noise * if is_biased { 0.1 } else { 1.0 };
            row.difference.mean += if is_biased { 0.05 * reference } else { 1e-3 * reference };
        }
    }
    let baseline = Way { technique: Technique::Area, choice: ChoiceBy::Auto, sampler: Sampler::Independent };
    let summary = Summary::new(&outcome.plan, &outcome.rows, 0, baseline);
    // t of three values beyond which chance comes once in 20 × 27 times: its probability is 1 − t/√(2 + t²)
    let t = summary.bias_limit;
    assert!((1.0 - t / (2.0 + t * t).sqrt() - 0.05 / 27.0).abs() < 1e-9, "{t}");
    for series in &summary.series {
        let is_biased = series.way.technique == Technique::Area && series.way.sampler == Sampler::Sobol;
        let found = series.bias(summary.bias_limit);
        let expected = if is_biased { "+5.00 % at 4 spp" } else { "none found" };
        assert!(found.starts_with(expected) && !found.contains(','), "{}: {found}", series.way.title());
    }
}

#[test]
fn charts_of_choices_name_the_choices() {
    let mut outcome = outcome(&["quads"]);
    let choices = [ChoiceBy::Uniform, ChoiceBy::Power, ChoiceBy::Tree];
    let rename = |key: &Key| Key {
        technique: Technique::SolidAngle,
        choice: choices[TECHNIQUES.iter().position(|t| *t == key.technique).unwrap()],
        ..*key
    };
    outcome.rows = outcome.rows.iter().map(|(key, rows)| (rename(key), rows.clone())).collect();
    outcome.plan.keys.iter_mut().for_each(|key| *key = rename(key));
    let baseline = Way { technique: Technique::Area, choice: ChoiceBy::Uniform, sampler: Sampler::Independent };
    let summary = Summary::new(&outcome.plan, &outcome.rows, 0, baseline);
    let drawing = charts::error(&summary, Against::Rays, Measure::RelativeMse).unwrap().drawing.file();
    for name in ["by uniform, sobol", "by power, stratified", "by tree, sobol", "rays, solid-angle", "rays per image"] {
        assert!(drawing.contains(name), "{name}");
    }
    assert!(summary.headline().contains("the best other choice"), "{}", summary.headline());
}
