//! The report of `etendue chart` is read at a glance: a line per scene, the best sampler of each technique, series in order, notes last.

use etendue_laboratory::chart::charts::{self, Against, Measure};
use etendue_laboratory::chart::clock::Clock;
use etendue_laboratory::chart::measure::{ChartedScene, Key, Measurement, Plan, Rows};
use etendue_laboratory::chart::reference::{Difference, Reference};
use etendue_laboratory::chart::summary::{ERRORS, Summary, Way};
use etendue_laboratory::chart::{Outcome, answer, plot, report};
use etendue_render::{ChoiceBy, Sampler, Technique, World};
use std::collections::HashSet;
use std::sync::atomic::AtomicBool;

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
    let plan = Plan { scenes, keys, replicates: 3, seed: 0, is_race: false };
    let baseline = Way { technique: Technique::Area, choice: ChoiceBy::Auto, sampler: Sampler::Independent };
    let clock = Clock::Wall;
    let summaries = (0..names.len()).map(|scene| Summary::new(&plan, &rows, scene, baseline, clock)).collect();
    Outcome { plan, rows, clock, summaries, facts: Vec::new(), notes: vec!["a remark at the end".to_owned()] }
}

fn page(outcome: &Outcome) -> String {
    let figures: Vec<_> = outcome.summaries.iter().map(charts::all).collect();
    let stems: Vec<String> = outcome.summaries.iter().map(|s| s.scene.clone()).collect();
    report::page(outcome, &figures, &stems, "etendue chart")
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

/// The page begins with the seconds to each error, by definition a power of the time in these data, and with who needs the least.
#[test]
fn the_page_begins_with_the_seconds_to_each_error() {
    let outcome = outcome(&["quads", "boxes"]);
    let page = page(&outcome);
    let head = &page[page.find("<h1").unwrap()..page.find("<nav").unwrap()];
    let found: Vec<String> = head.split("<li>").skip(1).map(|li| li[..li.find("</li>").unwrap()].to_owned()).collect();
    let expected: Vec<String> = outcome.summaries.iter().flat_map(Summary::sentences).collect();
    assert_eq!(found, expected);
    let summary = &outcome.summaries[0];
    // replicates have 1.00, 1.01 and 1.02 of the error
    let to = |way: &Way, error: f64| {
        let Way { technique, choice, sampler } = *way;
        let key = |spp| Key { scene: 0, technique, choice, sampler, spp };
        let mse = (error * summary.mean).powi(2) / 1.01;
        let ((one, t), (many, last)) = (cost(&key(1)), cost(&key(16)));
        let slope = (many / one).ln() / 16.0_f64.ln();
        if mse < many { last * many / mse } else { t * (mse / one).powf(1.0 / slope) }
    };
    for series in &summary.series {
        for (error, reach) in ERRORS.iter().zip(series.reaches) {
            let ratio = reach.unwrap().seconds / to(&series.way, *error);
            assert!((ratio - 1.0).abs() < 1e-9, "{} {error}: {ratio}", series.way.title());
        }
    }
    // series are in the order of their seconds to 1 %
    let order: Vec<f64> = summary.ranking.iter().map(|i| to(&summary.series[*i].way, 0.01)).collect();
    assert!(order.is_sorted(), "{order:?}");
    let way = |technique, sampler| Way { technique, choice: ChoiceBy::Auto, sampler };
    let best = way(Technique::SolidAngle, Sampler::Stratified);
    assert_eq!(summary.series[summary.ranking[0]].way, best);
    let named = |sentence: &str| sentence.replace("about ", "").replace(" s", "").replace(',', "");
    let sentence = &summary.sentences()[1];
    let [first, second, plain] =
        [best, way(Technique::MisPower, Sampler::Sobol), way(Technique::Area, Sampler::Independent)].map(|w| {
            let series = summary.series.iter().find(|s| s.way == w).unwrap();
            answer::seconds(series.reaches[1].as_ref().unwrap())
        });
    let expected = format!(
        "to reach 1 %, solid-angle with stratified takes {first}, mis-power with sobol {second}, area with independent {plain}"
    );
    assert_eq!(named(sentence), named(&expected));
    assert!(!head.contains("a remark"), "notes come last");
}

/// Where the intervals of two techniques overlap, none is called the best, and on a busy machine the time of the processors counts.
#[test]
fn no_best_is_named_where_intervals_overlap() {
    let sentences = |noise: f64| {
        let mut outcome = outcome(&["quads"]);
        for (key, rows) in &mut outcome.rows {
            let times = if key.technique == Technique::MisPower { 0.65 } else { 1.0 };
            for row in rows {
                row.seconds *= times * (1.0 + noise * (f64::from(row.replicate) - 1.0));
            }
        }
        let baseline = Way { technique: Technique::Area, choice: ChoiceBy::Auto, sampler: Sampler::Independent };
        Summary::new(&outcome.plan, &outcome.rows, 0, baseline, Clock::Wall).sentences()
    };
    assert!(sentences(0.001).iter().all(|sentence| !sentence.contains("no best")), "{:?}", sentences(0.001));
    assert!(sentences(0.2)[1].starts_with("to reach 1 %, no method is surely the fastest: "), "{:?}", sentences(0.2));

    let mut outcome = outcome(&["quads"]);
    // two threads that ran all the time, and two that ran for half of it
    let clock = |outcome: &Outcome| Clock::of(outcome.rows.values().flatten().map(Measurement::times), 2);
    assert_eq!(clock(&outcome), Clock::Wall);
    outcome.rows.values_mut().flatten().for_each(|row| row.seconds *= 2.0);
    outcome.clock = clock(&outcome);
    assert_eq!(outcome.clock, Clock::Processors(0.5));
    let page = page(&outcome);
    assert!(page.contains("the threads ran for 50 % of the time"), "the page says so");
    let shown = page.split("<figure").find(|part| part.contains(": error against CPU time")).unwrap();
    assert!(!shown.starts_with(" class=\"off\""), "and shows it");
}

/// A race leaves out the images of a series whose squared error × time is over eight times the best, and no others.
#[test]
fn a_race_goes_on_with_those_that_can_win() {
    let Outcome { plan, rows, .. } = outcome(&["quads"]);
    let plan = Plan { is_race: true, ..plan };
    let mut rows: Rows = rows.into_iter().map(|(key, rows)| (key, rows[..1].to_vec())).collect();
    let kept = &mut |_: &ChartedScene, _: &Key, _: &Measurement| Ok(());
    let left_out = plan.run(&mut rows, kept, &AtomicBool::new(false), &|_| ()).unwrap();
    let product = |key: &Key| {
        let (error, seconds) = cost(key);
        error * seconds
    };
    let best = |spp: u32| plan.keys.iter().filter(|k| k.spp <= spp).map(product).fold(f64::INFINITY, f64::min);
    let hopeless: Vec<&Key> = plan.keys.iter().filter(|key| product(key) > 8.0 * best(key.spp)).collect();
    assert!(!hopeless.is_empty() && hopeless.len() < plan.keys.len(), "{}", hopeless.len());
    assert!(hopeless.iter().all(|key| rows[key].len() == 1), "no further image");
    // images of the others were added, which are those of the renderer: what they tell leaves out others
    assert!(left_out >= 2 * hopeless.len() && rows.values().any(|rows| rows.len() == 3), "{left_out}");
}

#[test]
fn one_series_of_each_technique_is_shown_at_first() {
    let outcome = outcome(&["quads"]);
    let page = page(&outcome);
    let parts: Vec<&str> = page.split("<figure").skip(1).collect();
    // three errors against four costs
    assert_eq!(parts.len(), 12);
    let at_first = |part: &&&str| !part.starts_with(" class=\"off\"");
    assert_eq!(parts.iter().filter(at_first).count(), 2);
    let table = parts[11].split_once("<table>").unwrap().1;
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
    let file = error.unwrap().drawing.file();
    assert!(series(&file).len() == 3 && !file.contains(">area, independent</text>"));
    assert!(page.contains("data-all"), "a button shows the rest");
    // the table is in the order of the seconds to an error of 1 %, and notes come last
    let rows = series(table).into_iter().map(|s| summary.series.iter().position(|t| charts::id(t) == s.0).unwrap());
    assert!(rows.eq(summary.ranking.iter().copied()));
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
    let summary = Summary::new(&outcome.plan, &outcome.rows, 0, baseline, Clock::Wall);
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
    let summary = Summary::new(&outcome.plan, &outcome.rows, 0, baseline, Clock::Wall);
    let drawing = charts::error(&summary, Against::Rays, Measure::RelativeMse).unwrap().drawing.file();
    for name in ["by uniform, sobol", "by power, stratified", "by tree, sobol", "rays, solid-angle", "rays per image"] {
        assert!(drawing.contains(name), "{name}");
    }
    assert!(summary.sentences()[1].contains("solid-angle by tree with sobol"), "{:?}", summary.sentences());
}
