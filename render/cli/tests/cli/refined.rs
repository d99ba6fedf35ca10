//! Images that are refined until their error or the time is what was asked for, and the error that images claim.

use super::{Folder, TEN_SCENES, json, keys};
use etendue_laboratory::chart::reference::Reference;
use etendue_oracle::tier::cases;
use etendue_render::film::compare::Comparison;
use etendue_render::film::image;
use serde_json::Value;

/// The error that a rendering claims, the error measured against a reference, and the report.
fn claimed_and_measured(scene: &str, more: &[&str]) -> (f64, f64, Value) {
    let folder = Folder::new();
    let arguments = [&["render", scene, "--size", "128x128", "-o", "a.exr", "--json"], more].concat();
    let report = json(&folder.succeed(&arguments));
    let picture = image::read_exr(&folder.path("a.exr")).unwrap();
    let reference = Reference::builtin(scene).unwrap().shrunk([128, 128]).unwrap();
    let comparison = Comparison::new(&reference.picture, &picture, reference.error).unwrap();
    let measured = (comparison.mse - reference.error).max(0.0).sqrt() / comparison.reference_mean;
    (report["error"].as_f64().unwrap(), measured, report)
}

/// Lights are sampled, since the error of `analytic` is soon less than that of the references.
const SAMPLED: [&str; 2] = ["--technique", "solid-angle"];

#[test]
fn the_error_asked_for_is_reached() {
    let claimed_and_measured = |scene, more: &[&str]| claimed_and_measured(scene, &[&SAMPLED, more].concat());
    for scene in ["quads", "triangle-light", "sphere-light"].into_iter().take(cases(1, 3)) {
        let (claimed, measured, report) = claimed_and_measured(scene, &["--error", "0.01"]);
        println!("{scene}: {claimed:.5} claimed, {measured:.5} measured, {}", report["passes"]);
        assert!(claimed <= 0.01, "{report}");
        assert!((measured / claimed - 1.0).abs() < 0.2, "{scene}: {claimed} claimed, {measured} measured");
        let passes = report["passes"].as_array().unwrap();
        let spp: Vec<u64> = passes.iter().map(|p| p["spp"].as_u64().unwrap()).collect();
        // the first of 16 is no part of the image beside one of 64 and more
        assert!(spp[0] >= 16 && spp.iter().sum::<u64>() == report["spp"].as_u64().unwrap(), "{spp:?}");
        assert!(spp.windows(2).all(|w| w[0] <= w[1] && w[1] < 4 * w[0]), "{spp:?}");
        assert_eq!(keys(&passes[0]), ["sampler", "seconds", "seed", "spp"]);
        assert_eq!((&report["sampler"], passes[0]["seed"] == 0), (&"adaptive".into(), spp[0] == 16));
    }
    // in percent, with another seed
    let (claimed, measured, report) = claimed_and_measured("quads", &["--error", cases("0.4%", "0.2%"), "--seed", "5"]);
    assert!(
        claimed <= cases(0.004, 0.002) && (measured / claimed - 1.0).abs() < 0.2,
        "{claimed} claimed, {measured} measured"
    );
    let passes = report["passes"].as_array().unwrap();
    assert_eq!(passes[0]["seed"] == 5, passes[0]["spp"] == 16, "{report}");
    assert!(passes[1..].iter().all(|pass| pass["seed"] != 5), "{report}");
}

#[test]
fn the_time_asked_for_is_kept() {
    let claimed_and_measured = |scene, more: &[&str]| claimed_and_measured(scene, &[&SAMPLED, more].concat());
    let (claimed, measured, report) = claimed_and_measured("quads", &["--time", cases("0.7", "1.5")]);
    println!("{claimed:.5} claimed, {measured:.5} measured, {report}");
    assert!((measured / claimed - 1.0).abs() < 0.2, "{claimed} claimed, {measured} measured");
    let seconds = report["seconds"]["render"].as_array().unwrap();
    assert_eq!(seconds.len(), 1);
    // other processes may take the processor in between
    assert!((0.3..3.0).contains(&seconds[0].as_f64().unwrap()), "{report}");
    // a preview by another sampler is no part of the image
    let passes = report["passes"].as_array().unwrap();
    assert!(passes.iter().all(|p| p["sampler"] == "adaptive" && p["spp"].as_u64() >= Some(8)), "{report}");
    // the first of both goals ends the rendering
    let (claimed, _, report) = claimed_and_measured("quads", &["--time", "60", "--error", "0.05"]);
    assert!(claimed <= 0.05 && report["seconds"]["render"][0].as_f64().unwrap() < 10.0, "{report}");
    let (claimed, _, report) = claimed_and_measured("quads", &["--time", "0.3", "--error", "1e-6"]);
    assert!(claimed > 1e-6 && report["seconds"]["render"][0].as_f64().unwrap() < 3.0, "{report}");
}

/// The trial of `auto` counts towards the time limit, and is included in the time that is reported.
#[test]
fn the_trial_counts_in_the_time() {
    let folder = Folder::new();
    let render = ["render", "quads", "--size", "256x256", "--threads", "1", "--json"];
    let report = |more: &[&str]| json(&folder.succeed(&[&render, more].concat()));
    let found = report(&["--time", "0.4"]);
    let number = |value: &Value| value.as_f64().unwrap();
    let [trial, all] = [&found["seconds"]["trial"], &found["seconds"]["render"][0]].map(number);
    let passes: f64 = found["passes"].as_array().unwrap().iter().map(|pass| number(&pass["seconds"])).sum();
    assert!(trial > 0.0 && all >= trial + passes, "{found}");
    // there is none if nothing is to be chosen
    assert_eq!(number(&report(&["--spp", "1", "--technique", "area"])["seconds"]["trial"]), 0.0);
}

#[test]
fn passes_do_not_depend_on_threads() {
    let folder = Folder::new();
    let bytes = |threads: &str| {
        let arguments = [
            "render",
            "quads",
            "--size",
            "40x30",
            "--error",
            cases("0.01", "0.005"),
            "-o",
            "a.exr",
            "--threads",
            threads,
        ];
        folder.succeed(&arguments);
        std::fs::read(folder.path("a.exr")).unwrap()
    };
    assert_eq!(bytes("1"), bytes("3"));
    // every sampler has valid numbers of samples
    let samplers = ["independent", "stratified", "sobol", "sobol-4d", "z-order", "adaptive"];
    for sampler in samplers.into_iter().step_by(cases(4, 1)) {
        for scene in ["quads", "defocus"] {
            let arguments = ["render", scene, "--size", "16x16", "--error", "5%", "--sampler", sampler, "--json"];
            let report = json(&folder.succeed(&arguments));
            assert!(report["error"].as_f64().unwrap() <= 0.05 && report["sampler"] == sampler, "{report}");
        }
    }
}

#[test]
fn goals_that_cannot_be() {
    let folder = Folder::new();
    for (more, message) in [
        (&["--error", "0.01", "--sets", "1"][..], "--error: with --sets 1, a pixel has no variance"),
        (&["--error", "0.01", "--spp", "4"], "--spp"),
        (&["--time", "1", "--spp", "4"], "--spp"),
        (&["--time", "1", "--repeat", "4"], "--repeat"),
        (&["--time=0"], "greater than 0"),
        (&["--time=-1"], "greater than 0"),
        (&["--time=inf"], "greater than 0"),
        (&["--error=0"], "0.01 or 1%"),
        (&["--error=-1%"], "0.01 or 1%"),
        (&["--error=nan"], "0.01 or 1%"),
        (&["--error=101%"], "0.01 or 1%"),
    ] {
        let error = folder.fail(&[&["render", "quads", "--size", "8x8"], more].concat());
        assert!(error.contains(message), "{more:?}: {error}");
    }
    assert!(folder.names().is_empty());
    // without a variance, time is still a goal
    let report = json(&folder.succeed(&["render", "quads", "--size", "8x8", "--time", "0.2", "--sets", "1", "--json"]));
    assert!(report["error"].is_null() && report["sets"] == 1, "{report}");
    // nothing is known about the error of a black image
    folder.write("black.pbrt", super::scene("").replace("AreaLightSource", "Translate 0 -9 0 AreaLightSource"));
    let error = folder.fail(&["render", "black.pbrt", "--size", "8x8", "--error", "1%"]);
    assert!(error.contains("the image is black"), "{error}");
}

#[test]
fn the_default_sampler_knows_its_error() {
    let folder = Folder::new();
    for (spp, sampler) in
        [("1", "independent"), ("2", "sobol"), ("3", "independent"), ("6", "sobol"), ("8", "adaptive")]
    {
        let run = |more: &[&str]| {
            let output = folder.run(&[&["render", "quads", "--size", "16x16", "--spp", spp], more].concat());
            // of an odd number, a hint says that an even one has less noise
            assert!(output.status.success() && output.stderr.is_empty() == (spp != "3"), "{spp}: {output:?}");
            String::from_utf8(output.stdout).unwrap()
        };
        let report = json(&run(&["--json"]));
        assert_eq!(report["sampler"], sampler, "{spp}");
        assert_eq!(report["error"].is_null(), spp == "1", "{report}");
        assert!(report["passes"].is_null());
        let text = run(&[]);
        assert!(text.contains(sampler), "{text}");
        assert!(text.contains(if spp == "1" { "estimated error not known" } else { " % (relative RMS)" }), "{text}");
    }
    // the error is that of the variance in the file
    let report = json(&folder.succeed(&["render", "quads", "--size", "64x64", "--spp", "64", "--json", "-o", "a.exr"]));
    let picture = image::read_exr(&folder.path("a.exr")).unwrap();
    let mean = |values: &[[f32; 3]]| values.iter().flatten().map(|&x| f64::from(x)).sum::<f64>() / (3.0 * 64.0 * 64.0);
    let expected = mean(&picture.variance.unwrap()).sqrt() / mean(&picture.radiance);
    let [error, systematic] = ["error", "systematic"].map(|key| report[key].as_f64().unwrap());
    assert!((error / expected.hypot(systematic) - 1.0).abs() < 1e-9, "{report}");
    // that of closed forms is 1e-5 of the light that would arrive if nothing hid it
    assert_eq!(report["chosen"], "analytic");
    assert!((1e-6..5e-5).contains(&systematic), "{report}");
}

/// Lamps in view of a thousandth of a pixel, which no sample has met yet: the image says so, and more samples are taken until they tell.
#[test]
fn lights_that_few_samples_meet_are_uncertain() {
    let folder = Folder::new();
    let lamp = |x: f64, z: f64| {
        format!(
            "AttributeBegin Translate {x} 1 {z} AreaLightSource \"diffuse\" \"rgb L\" [ 2000 2000 2000 ]
            Shape \"sphere\" \"float radius\" 0.008 AttributeEnd "
        )
    };
    let text = format!(
        "LookAt 0 1 8  0 0.5 0  0 1 0 Camera \"perspective\" \"float fov\" 45
        Film \"rgb\" \"integer xresolution\" 32 \"integer yresolution\" 32
        WorldBegin LightSource \"infinite\" \"rgb L\" [ .3 .3 .3 ] Shape \"bilinearmesh\" \"point3 P\" [ -5 0 -5  -5 0 5  5 0 -5  5 0 5 ] {}{}{}",
        lamp(-1.7, 0.5),
        lamp(-0.4, -0.5),
        lamp(1.2, -1.0)
    );
    folder.write("lamps.pbrt", &text);
    let report = |more: &[&str]| {
        let all = [&["render", "lamps.pbrt", "--json", "-o", "a.exr", "--technique", "solid-angle"], more].concat();
        json(&folder.succeed(&all))
    };
    let few = report(&["--spp", "16"]);
    assert_eq!(few["missed"], 3.0, "{few}");
    assert!(few["uncertain"].as_str().unwrap().contains("3 lights in view"), "{few}");
    // lamps of π·0.008² at distances of 7.2 to 9.1, and pixels of (2·8·tan 22.5°/32)² at 8
    let area = |squared: f64| {
        64.0 / squared * std::f64::consts::PI * (0.008 / (0.5 * (std::f64::consts::PI / 8.0).tan())).powi(2)
    };
    let mean = few["mean"][0].as_f64().unwrap();
    let squares: f64 = [7.7_f64, 8.5, 9.1].iter().map(|d| area(d * d) * 2000.0_f64.powi(2)).sum();
    let expected = (squares / 16.0 / 1024.0).sqrt() / mean;
    assert!((few["error"].as_f64().unwrap() / expected - 1.0).abs() < 0.1, "{few} {expected}");
    let many = report(&["--error", "50%"]);
    assert!(many["spp"].as_u64() > Some(1024) && many["missed"] == 0.0, "{many}");
    // few samples lack the lamps themselves
    let lamps = [7.7_f64, 8.5, 9.1].iter().map(|d| area(d * d) * 2000.0).sum::<f64>() / 1024.0;
    assert!(((many["mean"][0].as_f64().unwrap() - mean) / lamps - 1.0).abs() < 0.5, "{many} {lamps}");
    // behind a wall that shines they are not in view
    let wall = "AreaLightSource \"diffuse\" \"bool twosided\" true Shape \"bilinearmesh\" \"point3 P\" [ -5 -1 4  5 -1 4  -5 5 4  5 5 4 ]";
    folder.write("lamps.pbrt", format!("{text} {wall}"));
    assert_eq!(report(&["--spp", "16"])["missed"], 0.0);
}

/// The error of closed forms does not fall with samples, and images say what it is at most.
#[test]
fn closed_forms_have_an_error_of_their_own() {
    let folder = Folder::new();
    fn render<'a>(more: &[&'a str]) -> Vec<&'a str> {
        [&["render", "quads", "--size", "64x64", "-o", "a.exr"], more].concat()
    }
    let error = folder.fail(&render(&["--error", "1e-6"]));
    assert!(
        error.contains("no number of samples reaches an error of 1e-6: approximations of `analytic` may cause one of"),
        "{error}"
    );
    assert!(folder.names().is_empty());
    let text = folder.succeed(&render(&["--error", "1e-6", "--time", "0.2"]));
    assert!(text.contains("from approximations\nno time suffices for an error of"), "{text}");
    // samples have none
    let text = folder.succeed(&render(&["--spp", "64", "--technique", "solid-angle"]));
    assert!(text.contains(" (relative RMS)\n"), "{text}");
    let report = |more: &[&str]| json(&folder.succeed(&render(&[&["--json"], more].concat())));
    assert_eq!(report(&["--spp", "64", "--technique", "solid-angle"])["systematic"], 0.0);
    // nor does it depend on samples, but for the mean to which it is relative
    let [few, passes] =
        [&["--spp", "64"][..], &["--error", "0.05%"]].map(|more| report(more)["systematic"].as_f64().unwrap());
    assert!((few / passes - 1.0).abs() < 0.01, "{few} {passes}");
}

/// What an image took and reached: its error, seconds and samples per pixel, and whether its error is sure.
fn reached(folder: &Folder, scene: &str, more: &[&str]) -> ([f64; 3], bool) {
    let output = folder.run(&[&["render", scene, "--size", "256x256", "-o", "a.exr", "--json"], more].concat());
    let report = json(&String::from_utf8(output.stdout).unwrap());
    let seconds = report["seconds"]["render"][0].as_f64().unwrap();
    let [error, spp] = ["error", "spp"].map(|key| report[key].as_f64().unwrap());
    ([error, seconds, spp], report["uncertain"].is_null())
}

/// How much of the time images use, and how their error compares with that of an image of a fixed number of samples that takes the whole time.
#[test]
#[ignore = "ten scenes by five times: ten minutes"]
fn images_use_the_time_as_a_table() {
    let folder = Folder::new();
    println!("part of the time that is used, and the error over that of as many samples at once");
    for scene in TEN_SCENES {
        let cells = [0.5, 1.0, 2.0, 4.0, 8.0].map(|time| {
            let ([error, used, spp], _) = reached(&folder, scene, &["--time", &time.to_string()]);
            let fixed = (spp * time / used).round().max(8.0);
            let ([other, took, _], _) = reached(&folder, scene, &["--spp", &fixed.to_string()]);
            // as if it had taken exactly the time
            let other = other * (took / time).powf(0.75);
            format!("{:3.0} % {:4.2}", 100.0 * used / time, error / other)
        });
        println!("{scene:15} {}", cells.join("   "));
    }
}

/// Where images stop that are to reach an error: the error over that asked for, and the samples per pixel.
#[test]
#[ignore = "ten scenes by five errors: ten minutes"]
fn images_stop_at_the_error_as_a_table() {
    let folder = Folder::new();
    println!("error over that asked for, and samples per pixel");
    for scene in TEN_SCENES {
        let cells = ["10%", "3%", "1%", "0.3%", "0.1%"].map(|error| {
            let ([found, _, spp], is_sure) = reached(&folder, scene, &["--error", error]);
            let target = error.trim_end_matches('%').parse::<f64>().unwrap() / 100.0;
            assert!(found <= target, "{scene} to {error}: {found}");
            format!("{:4.2}{} {spp:6}", found / target, if is_sure { ' ' } else { '?' })
        });
        println!("{scene:15} {}", cells.join("  "));
    }
}
