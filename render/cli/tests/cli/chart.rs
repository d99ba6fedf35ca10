//! Runs `etendue chart` as a user would, and checks their measurements.

use super::{Folder, TEN_SCENES, until};
use etendue_laboratory::chart::measure::{Measurement, Rows};
use etendue_laboratory::chart::reference::Reference;
use etendue_laboratory::chart::{self, Options};
use etendue_oracle::tier::cases;
use etendue_render::film::compare::{Comparison, differs};
use etendue_render::film::image::Picture;
use etendue_render::{ChoiceBy, Sampler, Settings, Technique, World};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};
use std::{env, fs};

impl Folder {
    fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_etendue"));
        command.current_dir(&self.0).args(arguments.split(' '));
        command
    }
    /// Runs the program, which must succeed, and returns its standard output.
    fn chart(&self, arguments: &str) -> String {
        text(&self.command(arguments).output().unwrap(), 0).0
    }
    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }
}

fn text(output: &Output, code: i32) -> (String, String) {
    let [out, error] = [&output.stdout, &output.stderr].map(|b| String::from_utf8(b.clone()).unwrap());
    assert_eq!(output.status.code(), Some(code), "{out}\n{error}");
    (out, error)
}

const SMALL: &str = "chart triangle-light --size 32x32 --spp 1,4 --techniques area,solid-angle --samplers independent";

#[test]
fn a_run_is_resumed_and_its_page_needs_nothing_else() {
    let folder = Folder::new();
    let out = folder.chart(&format!("{SMALL} --replicates 2 -o out"));
    assert!(
        out.contains("triangle-light") && out.contains("area, independent") && out.contains("report.html"),
        "{out}"
    );
    let table = folder.read("out/measurements.csv");
    assert_eq!(table.lines().count(), 1 + 2 * 2 * 2, "{table}");
    // interleaved: no technique has successive replicates
    let order: Vec<_> = table.lines().skip(1).map(|l| l.split(',').nth(2).unwrap()).collect();
    assert_eq!(order, ["area", "solid-angle"].repeat(4));

    let page = folder.read("out/report.html");
    // output and page begin with the seconds to three errors
    let head = &page[page.find("<h1").unwrap()..page.find("<nav").unwrap()];
    for (line, error) in out.lines().zip(["3 %", "1 %", "0.3 %"]) {
        let sentence = line.strip_prefix("triangle-light: ").unwrap();
        assert!(
            sentence.starts_with(&format!("to reach {error}, ")) && sentence.contains(" with independent"),
            "{line}"
        );
        assert!(head.contains(&format!("<li>{sentence}</li>")), "{head}");
    }
    let outside = page.replace("http://www.w3.org/2000/svg", "");
    for word in ["http:", "https:", "@import", "url(", "<link", "{{"] {
        assert!(!outside.contains(word), "the page has {word}");
    }
    for word in ["commit", "opt-level", "data-series=\"area/independent\"", "--replicates 2"] {
        assert!(page.contains(word), "the page lacks {word}");
    }
    let open = |tag: &str| page.matches(&format!("<{tag}")).count() - page.matches(&format!("</{tag}>")).count();
    assert_eq!(["svg", "figure", "table", "div"].map(open), [0; 4]);
    let errors =
        ["time", "cpu", "rays", "samples"].map(|x| ["", "squared-", "relative-"].map(|e| format!("{e}error-{x}")));
    let has_cpu = |name: &String| cfg!(unix) || !name.ends_with("cpu");
    for name in errors.into_iter().flatten().filter(has_cpu) {
        let svg = folder.read(&format!("out/triangle-light-{name}.svg"));
        assert!(page.contains(&format!("href=\"triangle-light-{name}.svg\"")), "{name}: a link");
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n") && svg.contains("solid-angle"), "{name}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
        assert_eq!(svg.matches("data-series=").count(), 2, "{name}: one series of each technique");
    }

    // the same command measures nothing; one more replicate adds four lines and removes an incomplete one
    assert!(
        folder.chart(&format!("{SMALL} --replicates 2 -o out")).contains("8 measurements come from an earlier run")
    );
    assert_eq!(folder.read("out/measurements.csv"), table);
    fs::write(folder.0.join("out/measurements.csv"), format!("{table}0123,triangle-li")).unwrap();
    folder.chart(&format!("{SMALL} --replicates 3 -o out"));
    let more = folder.read("out/measurements.csv");
    assert!(more.starts_with(&table) && more.lines().count() == 1 + 3 * 2 * 2, "{more}");
    // other settings are measured anew, and the earlier measurements are kept
    let out = folder.chart(&format!("{SMALL} --replicates 2 --seed 9 -o out"));
    assert!(out.contains("12 measurements with other settings"), "{out}");
    assert!(folder.read("out/measurements.csv").starts_with(&more));
}

#[test]
fn equal_techniques_are_left_out_and_choices_are_curves() {
    let folder = Folder::new();
    // a technique that equals another one in a scene is left out, with a note
    let out =
        folder.chart("chart delta-lights --quick --size 16x16 --spp 4 --replicates 2 --samplers stratified -o other");
    assert!(out.contains("cosine-hemisphere is left out: it gives the same image as uniform-hemisphere"), "{out}");
    assert!(!folder.read("other/measurements.csv").contains("cosine-hemisphere"));
    // a page of somebody else stays as it is
    fs::create_dir(folder.0.join("theirs")).unwrap();
    fs::write(folder.0.join("theirs/report.html"), "<title>A year</title>").unwrap();
    let error = folder.fail(&format!("{SMALL} -o theirs").split(' ').collect::<Vec<_>>());
    assert!(error.contains("theirs/report.html: this is no report of a chart: choose another folder"), "{error}");
    assert_eq!(folder.read("theirs/report.html"), "<title>A year</title>");
    // one chart with a curve for each choice of a light, by its name
    let out = folder.chart(
        "chart quads --size 16x16 --spp 4 --replicates 2 --reference-spp 32 --samplers sobol --choice uniform,power,spatial,tree,kinds -o by",
    );
    let chart = folder.read("by/quads-error-time.svg");
    for choice in ["uniform", "power", "spatial", "tree", "kinds"] {
        assert!(
            out.contains(&format!("solid-angle by {choice}, sobol")) && chart.contains(&format!(">by {choice}<")),
            "{choice}: {out}"
        );
    }
    assert_eq!(chart.matches("data-series=").count(), 5);
}

#[test]
fn faults_are_reported() {
    let folder = Folder::new();
    let says = |arguments: &str, words: &[&str]| {
        let error = folder.fail(&arguments.split(' ').collect::<Vec<_>>());
        assert!(words.iter().all(|w| error.contains(w)), "{arguments}: {error}");
    };
    fs::create_dir(folder.0.join("out")).unwrap();
    fs::write(folder.0.join("out/measurements.csv"), "a,b\n1,2\n").unwrap();
    says(&format!("{SMALL} -o out"), &["measurements.csv", "line 1"]);
    fs::remove_file(folder.0.join("out/measurements.csv")).unwrap();
    folder.chart(&format!("{SMALL} --replicates 1 -o out"));
    let table = folder.read("out/measurements.csv");
    fs::write(folder.0.join("out/measurements.csv"), table.replacen(",1,0,", ",1,one,", 1)).unwrap();
    says(&format!("{SMALL} -o out"), &["measurements.csv", "line 2", "\"one\"", "replicate"]);
    fs::write(folder.0.join("file"), "").unwrap();
    says(&format!("{SMALL} -o file"), &["file"]);
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_a_report() {
    let folder = Folder::new();
    let command = "chart quads --size 64x64 --spp 1,2,4,1048576 --replicates 1000 --techniques area --samplers independent -o out";
    let mut child = folder.command(command).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let table = folder.0.join("out/measurements.csv");
    let has_lines = |count: usize| fs::read_to_string(&table).is_ok_and(|text| text.lines().count() >= count);
    until("all images but the one with a million samples are measured", || has_lines(4));
    // a million samples per pixel would take minutes: the second signal ends the program at once, and the table remains. In a job of a
    // script, Ctrl-C is ignored, but not SIGTERM
    until("a second signal ends it", || {
        // two that come before the program has taken note of one are one
        assert!(Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap().success());
        child.try_wait().unwrap().is_some()
    });
    let before = fs::read_to_string(&table).unwrap();
    // now with many quick images
    let command = command.replace(",1048576", "");
    let child = folder.command(&command).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    until("more images are measured", || has_lines(before.lines().count() + 3));
    assert!(Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap().success());
    let (out, _) = text(&child.wait_with_output().unwrap(), 143);
    assert!(out.starts_with("stopped early: ") && out.contains("3 measurements come from an earlier run"), "{out}");
    assert!(fs::read_to_string(&table).unwrap().starts_with(&before));
    assert!(folder.read("out/report.html").contains("stopped early"));
}

fn options(output: &Path, scene: &str) -> Options {
    Options {
        environment: None,
        scenes: vec![scene.into()],
        output: output.to_owned(),
        techniques: vec![Technique::Area, Technique::SolidAngle],
        choices: vec![ChoiceBy::Auto],
        samplers: vec![Sampler::Independent, Sampler::Stratified],
        spp: vec![4, 16, 64],
        replicates: Some(cases(4, 6)),
        reference_spp: None,
        size: Some((64, 64)),
        seed: 5,
        threads: 0,
        baseline: Technique::Area,
        time_limit: None,
        quick: false,
        long: false,
    }
}

fn all(rows: &Rows) -> impl Iterator<Item = &Measurement> {
    rows.values().flatten()
}

/// The table holds the error of the image of each seed, and the error is the one that the image's own variance predicts.
#[test]
fn errors_are_those_of_the_images() {
    let folder = Folder::new();
    let outcome = chart::measure(&options(&folder.0, "quads"), &Arc::new(AtomicBool::new(false))).unwrap();
    let world = World::new(&etendue_scene::load("quads").unwrap()).unwrap();
    let reference = Reference::builtin("quads").unwrap().shrunk([64, 64]).unwrap();
    let mut seeds: Vec<u64> = all(&outcome.rows).map(|r| r.seed).collect();
    seeds.sort_unstable();
    seeds.dedup();
    assert_eq!(seeds.len(), 2 * 2 * 3 * cases(4, 6), "each image has a seed of its own");
    for (key, rows) in &outcome.rows {
        let settings = Settings {
            width: 64,
            height: 64,
            spp: key.spp,
            technique: key.technique,
            choice: key.choice,
            depth: Settings::DEPTH,
            sampler: key.sampler,
            sets: 1,
            seed: rows[0].seed,
        };
        let image = Picture::from(&world.render(&settings, &|_| ()).0);
        let comparison = Comparison::new(&reference.picture, &image, reference.error).unwrap();
        assert!((rows[0].difference.squared / comparison.mse - 1.0).abs() < 1e-12, "{key:?}");
        assert!(rows[0].seconds > 0.0 && rows[0].rays[0] == 64 * 64 * u64::from(key.spp));
        // by definition: over the squared reference, and a little more where that is dark
        let truth = || reference.picture.radiance.iter().flatten().map(|x| f64::from(*x));
        let floor = (0.1 * truth().sum::<f64>() / truth().count() as f64).powi(2);
        let both = truth().zip(image.radiance.iter().flatten());
        let relative =
            both.map(|(r, x)| (f64::from(*x) - r).powi(2) / (r * r + floor)).sum::<f64>() / truth().count() as f64;
        assert!((rows[0].difference.relative / relative - 1.0).abs() < 1e-12, "{key:?}");
    }
    let summary = &outcome.summaries[0];
    for series in &summary.series {
        for point in &series.points {
            // predicted by the images' own variances: the mean over pixels of the variance of the mean
            let of = |seed| {
                let (technique, sampler) = (series.way.technique, series.way.sampler);
                let settings =
                    Settings { width: 64, height: 64, spp: point.spp, technique, sampler, seed, ..Settings::DEFAULT };
                let film = world.render(&settings, &|_| ()).0;
                film.pixels.iter().flat_map(|p| p.variance).map(f64::from).sum::<f64>() / (3.0 * 64.0 * 64.0)
            };
            let predicted = (100..103).map(of).sum::<f64>() / 3.0;
            let ratio = point.mse.value / predicted;
            // one set of strata has less error than the two or four that provide a variance
            let range = if series.way.sampler == Sampler::Independent { 0.88..1.12 } else { 0.4..0.9 };
            assert!(range.contains(&ratio), "{} {}: {ratio}", series.way.title(), point.spp);
            assert!(!differs(point.bias), "{} {}: bias {}", series.way.title(), point.spp, point.bias);
        }
        let slope = series.slope.as_ref().unwrap();
        let truth = if series.way.sampler == Sampler::Independent { -1.03..-0.97 } else { -1.5..-1.1 };
        assert!(truth.contains(&slope.value) && slope.half < 0.1, "{}: {slope:?}", series.way.title());
    }
}

/// The error of a reference with as few samples as the images themselves is subtracted.
#[test]
fn the_references_own_error_is_taken_off() {
    let folder = Folder::new();
    let measured = |reference_spp: Option<u32>, name: &str| {
        let output = folder.0.join(name);
        let options = Options {
            reference_spp,
            spp: vec![64],
            replicates: Some(cases(5, 8)),
            ..options(&output, "triangle-light")
        };
        let outcome = chart::measure(&options, &Arc::new(AtomicBool::new(false))).unwrap();
        let error = outcome.plan.scenes[0].reference.error;
        let summary = outcome.summaries.into_iter().next().unwrap();
        let area = summary.series.into_iter().find(|s| s.way.technique == Technique::Area).unwrap();
        (area.points[0].mse, error)
    };
    let ((precise, none), (rough, some)) = (measured(None, "precise"), measured(Some(32), "rough"));
    // the rough reference's error is a good part of the measured one, and hardly any of it remains
    assert!(some > 0.05 * rough.value && none < 1e-3 * precise.value, "{some:e} {none:e} {precise:?}");
    assert!((rough.value / precise.value - 1.0).abs() < 0.05, "{rough:?} {precise:?}");
}

/// The way that a quick chart finds best at half the size is that of the scene's own size: in nine of ten scenes. A chart that names no best
/// must not exclude the winner. About 10 minutes.
#[test]
#[ignore = "takes minutes of an idle machine"]
fn the_answer_of_a_quick_chart_is_that_of_the_scenes_own_size_at_length() {
    let mut agree = 0;
    for name in TEN_SCENES {
        let film = &etendue_scene::load(name).unwrap().film;
        let [half, own] = [2, 1].map(|part| {
            let folder = Folder::new();
            let options = Options {
                quick: true,
                samplers: vec![],
                techniques: vec![],
                spp: vec![],
                replicates: None,
                size: Some((film.width / part, film.height / part)),
                time_limit: Some(3600),
                ..options(&folder.0, name)
            };
            let outcome = chart::measure(&options, &Arc::new(AtomicBool::new(false))).unwrap();
            outcome.summaries[0].undecided(1).iter().map(|series| series.way.method()).collect::<Vec<_>>()
        });
        let is_same = half.iter().any(|method| own.contains(method));
        println!("{name}: {} at half the size, {} at its own: {is_same}", half.join(" or "), own.join(" or "));
        agree += usize::from(is_same);
    }
    assert!(agree >= 9, "{agree} of 10");
}

/// What is not asked for shrinks to the time, which is said before anything is measured, and kept.
#[test]
fn a_chart_says_how_long_it_takes_and_keeps_to_it() {
    let folder = Folder::new();
    let start = Instant::now();
    let output = folder.command("chart quads --techniques area,solid-angle --time-limit 12 -o out").output().unwrap();
    let took = start.elapsed();
    let (out, error) = text(&output, 0);
    assert!(
        error.starts_with("quads (") && error.contains("about ") && error.contains(", and at most 12 s"),
        "{error}"
    );
    assert!(out.contains("quads: to reach 3 %, "), "{out}");
    // and the images that were begun, on a machine that does something else
    assert!(took < Duration::from_secs(30), "{took:?}");
}
