//! Passes, their weights, and what the next one is.

use super::schedule::MOST_UNCERTAIN;
use super::*;
use crate::drive::pixel_counts::SamplePlan;
use crate::drive::view::GROUPS;
use crate::scene::{CameraSettings, Emission, Geometry, Material, Parallelogram, Scene, Screen, Shape};
use std::sync::Mutex;

const NOTHING: Beside<'_> = Beside::NOTHING;

#[test]
fn passes_are_averaged_by_their_weights() {
    let film = |mean: f32, variance: f32, samples| Film {
        width: 1,
        height: 1,
        pixels: vec![Pixel { mean: [mean; 3], variance: [variance; 3], samples, ..Pixel::default() }],
    };
    let (mut mean, mut weights) = (film(1.0, 8.0, 4), vec![1.0]);
    add(&mut mean, &mut weights, &film(2.0, 4.0, 8).pixels, [0, 0, 1, 1], 3.0);
    add(&mut mean, &mut weights, &film(5.0, 2.0, 16).pixels, [0, 0, 1, 1], 4.0);
    // weights 1/8, 3/8 and 1/2
    assert_eq!(mean, film(0.125 + 0.75 + 2.5, 8.0 / 64.0 + 4.0 * 9.0 / 64.0 + 0.5, 28));
    assert_eq!(weights, [8.0]);
    // of two pixels, a pass of the second
    let mut pair = Film { width: 2, height: 1, pixels: vec![film(1.0, 8.0, 4).pixels[0]; 2] };
    let mut weights = vec![1.0, 1.0];
    add(&mut pair, &mut weights, &film(2.0, 4.0, 8).pixels, [1, 0, 2, 1], 3.0);
    assert_eq!((pair.pixels[0], pair.pixels[1]), (film(1.0, 8.0, 4).pixels[0], film(1.75, 2.75, 12).pixels[0]));
    assert_eq!(weights, [1.0, 4.0]);
    assert_eq!(seed(7, 0), 7);
    // the first output of SplitMix64 of the seed 0
    assert_eq!(seed(0, 1), 0xe220_a839_7b1d_cdaf);
}

/// A floor under a square light, seen from above.
fn lit_floor() -> World {
    let (origin, forward, right, up) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let (screen, lens) = (Screen::Half(0.5), None);
    let camera = CameraSettings { origin, forward, right, up, is_orthographic: false, screen, lens };
    let square = Geometry::Parallelogram(Parallelogram { p: [0.0, 0.0, 1.5], u: [0.0, 0.5, 0.0], v: [0.5, 0.0, 0.0] });
    let emission = Some(Emission { radiance: [1.0; 3], ..Emission::default() });
    let mut scene = Scene::new(camera, [40, 32]);
    scene.materials.push(Material::Diffuse([0.5; 3]));
    scene.triangles.push([[-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [0.0, 9.0, 0.0]]);
    scene.triangle_materials.push(0);
    scene.shapes = [Shape { geometry: square, material: 0, emission }].into();
    World::new(&scene).unwrap()
}

/// Passes of a part change its pixels alone, and their number of samples follows the time of the last pass.
#[test]
fn a_part_takes_passes_of_its_own() {
    let world = lit_floor();
    for sampler in [Sampler::Adaptive, Sampler::Independent] {
        let technique = crate::Technique::SolidAngle;
        let settings = Settings { width: 40, height: 32, spp: 16, technique, sampler, seed: 3, ..Settings::DEFAULT };
        let plan = Refinement { settings, sampler: Some(sampler), goal: Goal::default() };
        let mut refined = Refined::new(&world, &plan).unwrap();
        assert_eq!(refined.lasting(100.0, settings.whole()), refined.schedule.counts[0]);
        let first = refined.pass(&world, 16, settings.whole(), NOTHING).unwrap().clone();
        assert_eq!(first.film, world.render(&settings, &|_| ()).0);
        let area = [16, 0, 40, 16];
        // a pass that is stopped leaves no trace
        assert_eq!(refined.pass(&world, 32, area, Beside { stop: &AtomicBool::new(true), ..NOTHING }), None);
        assert_eq!(refined.known(), Some(&first));
        let second = refined.pass(&world, 32, area, NOTHING).unwrap().clone();
        let inside = |i: usize| i % 40 >= 16 && i / 40 < 16;
        for (i, (a, b)) in first.film.pixels.iter().zip(&second.film.pixels).enumerate() {
            assert_eq!(a == b, !inside(i), "pixel {i}");
        }
        assert!(second.error.unwrap().total() < first.error.unwrap().total(), "{sampler:?}");
        // as the whole would have it, with a weight of its own in each pixel
        let third = refined.pass(&world, 16, settings.whole(), NOTHING).unwrap().clone();
        assert_eq!(third.spp, 32);
        assert!(third.film.pixels.iter().zip(&second.film.pixels).all(|(a, b)| a.samples > b.samples));
        // a second for the last pass, which had 16 samples per pixel; a fifth of the pixels takes a fifth of it
        refined.pace = 1.0 / (16.0 * 40.0 * 32.0);
        let least = refined.schedule.full;
        let lasting = |seconds| refined.lasting(seconds, settings.whole());
        assert_eq!([1e-3, 1.0, 4.0, 1e9].map(lasting), [least, 16, 64, 128]);
        let fifth = if sampler == Sampler::Adaptive { 80 } else { 64 };
        assert_eq!(refined.lasting(1.0, [0, 0, 16, 16]), fifth);
    }
}

/// While a pass is rendered, the listener receives each tile as the finished image will show it. With `adaptive` it first receives the tile
/// with the samples of the pilot alone.
#[test]
fn tiles_are_told_while_a_pass_is_rendered() {
    let world = lit_floor();
    for sampler in [Sampler::Adaptive, Sampler::Sobol] {
        let technique = crate::Technique::SolidAngle;
        let settings = Settings { width: 40, height: 32, spp: 16, technique, sampler, seed: 3, ..Settings::DEFAULT };
        let plan = Refinement { settings, sampler: Some(sampler), goal: Goal::default() };
        let mut refined = Refined::new(&world, &plan).unwrap();
        for (pass, area) in
            [settings.whole(), settings.whole(), [16, 0, 40, 16], settings.whole()].into_iter().enumerate()
        {
            let before = refined.known().map(|known| known.film.clone());
            let told = Mutex::new(Vec::new());
            let tile = |area: Area, pixels: &[Pixel]| told.lock().unwrap().push((area, pixels.to_vec()));
            let known = refined.pass(&world, 16, area, Beside { tile: Some(&tile), ..NOTHING }).unwrap();
            let told = told.into_inner().unwrap();
            let tiles = crate::settings::tiles(area).count();
            let early = if sampler == Sampler::Adaptive { tiles } else { 0 };
            assert_eq!(told.len(), early + tiles, "{sampler:?}, pass {pass}");
            let (first, last) = told.split_at(early);
            let mut film = before.unwrap_or_else(|| Film { pixels: vec![Pixel::default(); 40 * 32], ..known.film });
            for (tile, pixels) in first {
                let own = area::pixels(*tile).map(|[x, y]| &film.pixels[(y * 40 + x) as usize]);
                assert!(pixels.iter().zip(own).all(|(a, b)| a.samples == b.samples + 8), "{tile:?}");
            }
            for (tile, pixels) in last {
                area::paste(&mut film.pixels, settings.whole(), *tile, pixels.iter().copied());
            }
            assert!(film == known.film, "{sampler:?}, pass {pass}");
        }
    }
}

/// A preview shows the image early, and is no part of it later.
#[test]
fn a_preview_is_followed_by_passes_of_the_usual_sampler() {
    let world = lit_floor();
    let (technique, sampler) = (crate::Technique::SolidAngle, Sampler::Adaptive);
    let settings = Settings { width: 16, height: 16, spp: 16, technique, sampler, seed: 3, ..Settings::DEFAULT };
    let plan = Refinement { settings, sampler: None, goal: Goal::default() };
    let mut refined = Refined::new(&world, &plan).unwrap();
    assert_eq!(refined.lasting(1e9, settings.whole()), 2);
    assert_eq!(refined.pass(&world, 2, settings.whole(), NOTHING).unwrap().passes[0].sampler, Sampler::Sobol);
    assert_eq!([1e-9, 1e9].map(|seconds| refined.lasting(seconds, settings.whole())), [8, 16]);
    let known = refined.pass(&world, 16, settings.whole(), NOTHING).unwrap().clone();
    assert_eq!((known.spp, known.passes.len(), known.passes[0].sampler), (16, 1, Sampler::Adaptive));
    let alone = Settings { seed: seed(3, 1), ..settings };
    assert_eq!(known.film, world.render(&alone, &|_| ()).0);
}

#[test]
fn samplers_have_counts_with_a_variance() {
    let plan = |sampler, sets, error| {
        let technique = crate::Technique::Area;
        let (sampler, settings) = (
            Some(sampler),
            Settings { width: 1, height: 1, spp: 1, technique, depth: 0, sampler, sets, ..Settings::DEFAULT },
        );
        Refinement { settings, sampler, goal: Goal { seconds: None, error } }.counts()
    };
    let of = |sampler, sets| plan(sampler, sets, Some(0.1));
    assert_eq!(of(Sampler::Sobol, 0).unwrap()[..3], [2, 4, 8]);
    assert_eq!(of(Sampler::Sobol, 4).unwrap()[..2], [4, 8]);
    assert_eq!(of(Sampler::Adaptive, 0).unwrap()[..10], [8, 9, 10, 11, 12, 13, 14, 15, 16, 18]);
    assert_eq!(of(Sampler::Adaptive, 2).unwrap()[..3], [16, 18, 20]);
    assert_eq!(of(Sampler::Adaptive, 4).unwrap()[0], 32);
    assert!(of(Sampler::Sobol, 1).unwrap_err().contains("--sets"));
    assert_eq!(plan(Sampler::Sobol, 1, None).unwrap()[..2], [1, 2]);
}

/// A pass that outweighs all earlier ones eightfold replaces them, in the tiles reported to listeners as well. Passes of independent samples are
/// averaged instead.
#[test]
fn small_passes_are_left_out_beside_large_ones() {
    let world = lit_floor();
    for (sampler, is_left_out) in [(Sampler::Adaptive, true), (Sampler::Sobol, true), (Sampler::Independent, false)] {
        let technique = crate::Technique::SolidAngle;
        let settings = Settings { width: 32, height: 16, spp: 16, technique, sampler, seed: 3, ..Settings::DEFAULT };
        let plan = Refinement { settings, sampler: Some(sampler), goal: Goal::default() };
        let mut refined = Refined::new(&world, &plan).unwrap();
        let told = Mutex::new(vec![Pixel::default(); 32 * 16]);
        let tile = |area: Area, pixels: &[Pixel]| {
            area::paste(&mut told.lock().unwrap(), settings.whole(), area, pixels.iter().copied());
        };
        let beside = Beside { tile: Some(&tile), ..NOTHING };
        let mut pass = |spp| refined.pass(&world, spp, settings.whole(), beside).unwrap().clone();
        // weights of 1, 1 and 2.8
        let three = [16, 16, 32].map(&mut pass);
        assert_eq!((three[2].passes.len(), three[2].spp), (3, 64));
        // 22.6 is not eight times 4.8, but 64 is
        assert_eq!((pass(128).passes.len(), pass(16).spp), (4, 208), "{sampler:?}");
        let last = pass(1024);
        assert_eq!(last.passes.len(), if is_left_out { 1 } else { 6 }, "{sampler:?}");
        let alone = Settings { spp: 1024, seed: seed(3, 5), ..settings };
        assert_eq!(last.film == world.render(&alone, &|_| ()).0, is_left_out, "{sampler:?}");
        assert!(*told.lock().unwrap() == last.film.pixels, "{sampler:?}");
    }
}

/// A trial has the samples of the settings, or more if the time has room for more at a million a second; a number that a pass may have.
#[test]
fn the_trial_has_the_samples_that_fit() {
    let settings = Settings { width: 256, height: 256, spp: 16, sampler: Sampler::Adaptive, ..Settings::DEFAULT };
    let spp = |seconds| {
        let goal = Goal { seconds, error: Some(0.01) };
        Refinement { settings, sampler: None, goal }.of_trial().spp
    };
    // 60 seconds have room for 915 samples
    assert_eq!([None, Some(0.5), Some(60.0)].map(spp), [16, 16, 896]);
}

/// What is decided in view of the error: samples per pixel, for an image of 64 whose error is this claim.
#[test]
fn the_next_pass_fits_the_error() {
    let mut counts: Vec<u32> = (1..=22).map(|bits| 1 << bits).chain([272, 288]).collect();
    counts.sort_unstable();
    let film = Film { width: 0, height: 0, pixels: Vec::new() };
    let pass = Pass { spp: 64, sampler: Sampler::Sobol, seed: 0, seconds: 1.0 };
    let claim = Claim { random: 0.02, pixels: 100.0, ..Claim::default() };
    let mean = Progress { film, error: None, spp: 64, passes: vec![pass], seconds: 1.0, rays: RayCount::default() };
    let after = |claim: Claim, spp: u32, seconds, error| {
        let goal = Goal { seconds, error: Some(error) };
        let schedule = Schedule {
            goal,
            power: 1.5,
            counts: counts.clone(),
            full: 2,
            timing: Some(Timing::new(64, 1.0, (0, 0.0))),
        };
        let passes = vec![Pass { spp, ..pass }];
        let mean = Progress { error: Some(claim), spp: spp.into(), passes, ..mean.clone() };
        schedule.next(&mean, f64::from(spp).powf(1.5), 1.0).map(|(spp, _)| spp)
    };
    let next = |error| after(claim, 64, None, error);
    // reached
    assert_eq!(next(0.02), None);
    // half of the error: three times the weight, 2.08 times the samples
    assert_eq!([0.01, 0.019, 1e-5].map(next), [256, 64, 512].map(Some));
    // 9.3 times the weight, since what is known is left out beside 8.3
    assert_eq!(next(0.02 / f64::sqrt(9.3)), Some(288));
    // the first of both goals: a second for 64 samples
    assert_eq!([10.0, 1.6].map(|seconds| after(claim, 64, Some(seconds), 0.019)), [Some(64), Some(32)]);
    // of the error, samples lower the random part alone: by half, as above, and never to the other
    let both = Claim { systematic: 0.01, ..claim };
    assert_eq!([f64::sqrt(2e-4), 0.0224].map(|error| after(both, 64, None, error)), [Some(256), None]);
    assert_eq!(after(both, 64, Some(9.0), 0.01), Some(288));
    // where few pixels decide it, it goes on although it seems to be reached, but not for ever
    let few = Claim { random: 0.01, pixels: 2.0, ..Claim::default() };
    let next = |spp| after(few, spp, None, 0.02);
    assert_eq!([64, MOST_UNCERTAIN / 2, MOST_UNCERTAIN].map(next), [Some(64), Some(MOST_UNCERTAIN / 2), None]);
    assert!(after(few, MOST_UNCERTAIN, Some(1e9), 0.02).is_some());
}

/// The time of passes, in that of a sample of a pilot: of each pass besides its samples, of finding the numbers of samples after the pilot,
/// and of a sample after it and in the preview.
#[derive(Clone, Copy, Debug)]
struct Costs {
    fixed: f64,
    counts: f64,
    each: f64,
    preview: f64,
}

/// The part of a time that passes use, and the error of their average over that of one pass for the whole time, if that has room for `most`
/// samples per pixel, and the tiles that are rendered first take `early` times as long as their counts say.
fn used(refined: &Refined, most: f64, costs: Costs, early: f64) -> [f64; 2] {
    let Costs { fixed, counts, each, preview } = costs;
    let all = fixed + 16.0 + counts + each * (most - 16.0);
    let goal = Goal { seconds: Some(all), error: None };
    let mut schedule = Schedule { goal, ..refined.schedule.clone() };
    let film = Film { width: 0, height: 0, pixels: Vec::new() };
    let mut mean = Progress { film, error: None, spp: 0, passes: vec![], seconds: 0.0, rays: RayCount::default() };
    let (mut next, mut weight) = ((schedule.first(), f64::INFINITY), 0.0);
    loop {
        let mut pass = Pass { spp: next.0, sampler: Sampler::Sobol, seed: 0, seconds: preview * f64::from(next.0) };
        if next.0 >= schedule.full {
            let settings = Settings { spp: next.0, sampler: Sampler::Adaptive, ..refined.plan.settings };
            let samples = 8 * SamplePlan::new(&settings).pilot;
            let more = |spp: u32| each * f64::from(spp.saturating_sub(samples));
            let pilot = fixed + f64::from(samples);
            let mut begun = Begun { pilot: samples, spp: 0, part: 0.0, samples: 0.0, seconds: 0.0 };
            let mut now = pilot;
            for part in GROUPS.map(|eighths| eighths.len() as f64 / 8.0) {
                let spp = schedule.grown(next, begun, [pilot, now, mean.seconds + now]);
                let seconds = part * more(spp) * if begun.spp == 0 { early } else { (1.0 - 0.125 * early) / 0.875 };
                // numbers that are found again are shared out by what is known of the pixels
                let found = if begun.spp == 0 { 1.0 } else { 0.4 * f64::from(u8::from(spp != begun.spp)) };
                now += found * counts + seconds;
                begun = begun.and(spp, part, seconds);
            }
            pass = Pass { spp: begun.mean(), sampler: Sampler::Adaptive, seed: 0, seconds: now };
            schedule.timing = Some(Timing::new(pass.spp, now, (samples, pilot)));
        }
        let own = f64::from(pass.spp).powf(1.5);
        // a preview is no part of the image
        if mean.passes.last().is_some_and(|last| last.sampler != pass.sampler) || is_left_out(weight, own, 1.5) {
            (weight, mean.passes) = (0.0, Vec::new());
        }
        weight += own;
        mean.passes.push(pass);
        mean.seconds += pass.seconds;
        match schedule.next(&mean, weight, mean.seconds) {
            Some(following) => next = following,
            None => return [mean.seconds / all, (most.powf(1.5) / weight).sqrt()],
        }
    }
}

/// From 64 samples per pixel on, 85 % of a time are used or more, and passes have at most 1.3 times the error of as many samples at once.
#[test]
fn passes_use_the_time() {
    let settings = Settings { width: 256, height: 256, spp: 16, ..Settings::DEFAULT };
    let refined = Refined::new(&lit_floor(), &Refinement { settings, sampler: None, goal: Goal::default() }).unwrap();
    println!(
        "time of a pass, of counts, of samples after the pilot, of the preview, and early: least and greatest part, and error"
    );
    let mut all = [1.0_f64, 0.0, 1.0];
    // as studio, sphere-light, quads, mirror-room, delta-lights and sky take it by their CPU time at 128 × 128
    for [fixed, counts, each, preview] in [
        [5.0, 4.0, 0.5, 1.8],
        [4.0, 4.0, 0.9, 1.5],
        [3.0, 3.0, 1.4, 1.6],
        [2.0, 4.0, 1.5, 2.0],
        [0.0, 6.0, 0.85, 0.3],
        [0.0, 5.0, 1.2, 1.5],
    ] {
        for early in [0.7, 1.0, 1.3] {
            let mut worst = [1.0_f64, 0.0, 1.0, 0.0];
            for step in 0..200 {
                let most = 64.0 * (0.05 * f64::from(step)).exp2();
                let costs = Costs { fixed, counts, each, preview };
                let [part, error] = used(&refined, most, costs, early);
                let most = if error > worst[2] { most } else { worst[3] };
                worst = [worst[0].min(part), worst[1].max(part), worst[2].max(error), most];
            }
            println!("{fixed} {counts} {each} {preview} {early}: {worst:.3?}");
            if early <= 1.0 {
                all = [all[0].min(worst[0]), all[1].max(worst[1]), all[2].max(worst[2])];
            }
        }
    }
    assert!(all[0] >= 0.85 && all[1] <= 1.0 && all[2] <= 1.3, "{all:?}");
}
