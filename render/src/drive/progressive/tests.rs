//! Passes, their weights, and what the next one is.

use super::*;
use crate::scene::{CameraSettings, Emission, Geometry, Material, Parallelogram, Scene, Screen, Shape};
use std::sync::Mutex;

static NEVER: AtomicBool = AtomicBool::new(false);
const NOTHING: Beside<'_> = Beside { stop: &NEVER, progress: &|_| (), tile: None };

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
        assert_eq!(refined.lasting(100.0, settings.whole()), refined.counts[0]);
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
        let least = refined.full;
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

#[test]
fn the_next_pass_fits_the_goal() {
    let counts: Vec<u32> = (1..=22).map(|bits| 1 << bits).collect();
    let film = Film { width: 0, height: 0, pixels: Vec::new() };
    let pass = Pass { spp: 64, sampler: Sampler::Sobol, seed: 0, seconds: 1.0 };
    let error = Some(Claim { random: 0.02, pixels: 100.0, ..Claim::default() });
    let mean = Progress { film, error, spp: 64, passes: vec![pass], seconds: 1.0, rays: RayCount::default() };
    let weight = 64_f64.powf(1.5);
    let next = |seconds, error| decide(&mean, Goal { seconds, error }, weight, 1.5, &counts, 2, 1.0);
    // after a preview, the least number for the sampler of larger passes
    let preview = Progress { passes: vec![Pass { spp: 2, ..pass }], spp: 2, ..mean.clone() };
    let after = |seconds| decide(&preview, Goal { seconds: Some(seconds), error: None }, 2.8, 1.5, &counts, 32, 1.0);
    assert_eq!([100.0, 17.0, 9.5].map(after), [Some(32), Some(16), Some(16)]);
    // reached
    assert_eq!(next(None, Some(0.02)), None);
    // half of the error: three times the weight, 2.08 times the samples
    assert_eq!(next(None, Some(0.01)), Some(256));
    assert_eq!(next(None, Some(0.019)), Some(64));
    assert_eq!(next(None, Some(1e-5)), Some(512));
    // nine seconds are left, but a pass has at most eight times the samples
    assert_eq!(next(Some(10.0), None), Some(512));
    assert_eq!(next(Some(9.0), None), Some(256));
    assert_eq!(next(Some(1.5), None), Some(16));
    assert_eq!(next(Some(1.05), None), None);
    assert_eq!(next(Some(10.0), Some(0.019)), Some(64));
    assert_eq!(next(Some(1.6), Some(1e-5)), Some(32));
    // of the error, samples lower the random part alone: by half, as above, and never to the other
    let error = Some(Claim { random: 0.02, systematic: 0.01, pixels: 100.0, ..Claim::default() });
    let mean = Progress { error, ..mean.clone() };
    let next = |seconds, error| decide(&mean, Goal { seconds, error }, weight, 1.5, &counts, 2, 1.0);
    assert_eq!(next(None, Some(f64::sqrt(2e-4))), Some(256));
    assert_eq!(next(None, Some(0.0224)), None);
    assert_eq!(next(Some(9.0), Some(0.01)), Some(256));
    // where few pixels decide it, it goes on although it seems to be reached, but not for ever
    let error = Some(Claim { random: 0.01, pixels: 2.0, ..Claim::default() });
    let after = |spp: u32, seconds| {
        let mean = Progress { error, spp: spp.into(), passes: vec![Pass { spp, ..pass }], ..mean.clone() };
        decide(&mean, Goal { seconds, error: Some(0.02) }, weight, 1.5, &counts, 2, 1.0)
    };
    assert_eq!(after(64, None), Some(64));
    assert_eq!(after(MOST_UNCERTAIN / 2, None), Some(MOST_UNCERTAIN / 2));
    assert_eq!(after(MOST_UNCERTAIN, None), None);
    assert!(after(MOST_UNCERTAIN, Some(1e9)).is_some());
}

/// The part of a time that passes use, and the error of their average over that of one pass for the whole time, if that has room for `most`
/// samples per pixel, and a thread makes `speed` times as many samples per second as the first pass counts on.
fn used(refined: &Refined, most: f64, speed: f64) -> [f64; 2] {
    let (counts, full) = (&refined.counts, refined.full);
    let goal = Goal { seconds: Some(most), error: None };
    // a second for each sample per pixel
    let pixels = speed * SLOW * rayon::current_num_threads() as f64;
    let film = Film { width: 0, height: 0, pixels: Vec::new() };
    let mut mean = Progress { film, error: None, spp: 0, passes: vec![], seconds: 0.0, rays: RayCount::default() };
    let mut next = at_most(counts, first(goal, pixels)).filter(|&n| n >= full).unwrap_or(counts[0]);
    let mut weight = 0.0;
    loop {
        let pass = Pass { spp: next, sampler: Sampler::Adaptive, seed: 0, seconds: next.into() };
        // a preview is no part of the image
        if weight > 0.0 && mean.passes[0].spp < full {
            (weight, mean.passes) = (0.0, Vec::new());
        }
        weight += f64::from(next).powf(1.5);
        mean.passes.push(pass);
        mean.seconds += pass.seconds;
        match decide(&mean, goal, weight, 1.5, refined.following(next), full, mean.seconds) {
            Some(spp) => next = spp,
            None => return [mean.seconds / most, (most.powf(1.5) / weight).sqrt()],
        }
    }
}

/// From 12 samples per pixel on, 85 % of a time are used or more, and passes have at most 1.3 times the error of as many samples at once.
#[test]
fn passes_use_the_time() {
    let settings = Settings { width: 16, height: 16, spp: 16, ..Settings::DEFAULT };
    let refined = Refined::new(&lit_floor(), &Refinement { settings, sampler: None, goal: Goal::default() }).unwrap();
    println!("samples at once: part of the time that is used, and error, for three speeds");
    let mut worst = [1.0_f64, 1.0];
    for step in 0..200 {
        let most = 12.0 * (0.05 * f64::from(step)).exp2();
        let found = [1.0, 4.0, 16.0].map(|speed| used(&refined, most, speed));
        if step % 20 == 0 {
            println!("{most:7.1}: {:.2?} {:.2?} {:.2?}", found[0], found[1], found[2]);
        }
        for [part, error] in found {
            worst = [worst[0].min(part), worst[1].max(error)];
            assert!((0.85..=1.0).contains(&part) && error <= 1.3, "{most}: {found:?}");
        }
    }
    println!("at worst {worst:.3?}");
}
