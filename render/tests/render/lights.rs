//! Laws of the choice and the sampling of lights, which an image cannot show: a wrong weight of two percent hides in its noise.

use etendue::sequence::{Independent, Sequence};
use etendue::{Mask, Real, Uint, Vec2, u32x8};
use etendue_render::lights::Lights;
use etendue_render::packet::{V8, X8};
use etendue_render::scene::{self, Scene};
use etendue_render::technique::Measure;

/// Points about the lights of a scene, each with a unit normal, and four random numbers.
fn packet(scene: &Scene, number: u32) -> (V8, V8, [X8; 4]) {
    let lanes = u32x8::from_fn(|k| number * 8 + k as u32);
    let pairs: [Vec2<X8>; 5] =
        core::array::from_fn(|dimension| Independent::new(7).pair(u32x8::splat(0), lanes, dimension as u32));
    let shape = &scene.shapes[number as usize * 7919 % scene.shapes.len()];
    let [low, high] = shape.geometry.bounds();
    let size = (0..3).map(|k| high[k] - low[k]).fold(0.0, f32::max).max(1e-3);
    // up to ten sizes away
    let [x, y, z] = [pairs[0].x, pairs[0].y, pairs[1].x];
    let away = |u: X8, k: usize| X8::splat(low[k]) + (u - X8::lit(0.5)) * X8::splat(20.0 * size);
    let p = V8::new(away(x, 0), away(y, 1), away(z, 2));
    let normal = V8::new(pairs[1].y - X8::lit(0.5), pairs[2].x - X8::lit(0.5), pairs[2].y - X8::lit(0.4)).normalize();
    (p, normal, [pairs[3].x, pairs[3].y, pairs[4].x, pairs[4].y])
}

/// The pdf of a direction, with which MIS weights it, is bit for bit the product of the probability with which its light was chosen and the
/// pdf with which the light was sampled.
#[test]
fn the_pdf_of_a_direction_is_that_with_which_it_was_drawn() {
    let mut kinds = [0_u32; 3];
    for (name, _) in scene::builtin() {
        let scene = scene::load(name).unwrap();
        let lights = Lights::new(&scene, None).unwrap();
        if scene.shapes.is_empty() || lights.is_empty() || lights.only_deltas() {
            continue;
        }
        let mut compared = 0;
        for number in 0..200 {
            let (p, normal, [u, second, x, y]) = packet(&scene, number);
            let choice = lights.choose(p, normal, [u, second]);
            let mut chosen = lights.chosen(choice.index);
            let drawn = lights.sample(&mut chosen, Measure::SolidAngle, p, normal, Vec2::new(x, y));
            let pmf = lights.pmf(p, normal);
            let sampled = choice.pmf.gt(X8::lit(0.0)) & drawn.pdf.gt(X8::lit(0.0)) & !drawn.delta;
            for lane in (0..8).filter(|&lane| sampled.lane(lane)) {
                let index = chosen.shape.lane(lane) as usize;
                let geometry = &scene.shapes[index].geometry;
                let pdf = lights.shape_pdf(&pmf, index, geometry, p, drawn.direction).lane(lane);
                let own = drawn.pdf.lane(lane) * choice.pmf.lane(lane);
                assert_eq!(pdf.to_bits(), own.to_bits(), "{name}, shape {index}: {pdf} and {own}");
                compared += 1;
            }
        }
        assert!(compared > 100, "{name}: only {compared} directions");
        kinds[if lights.len() == 1 {
            0
        } else if lights.few().is_some() {
            1
        } else {
            2
        }] += 1;
    }
    println!("scenes with one light, few and many: {kinds:?}");
    assert!(kinds.iter().all(|&scenes| scenes > 0), "{kinds:?}");
}

/// At each point that a light can reach, the probabilities of all lights sum to 1; to less where some of several lights are infinitely far
/// away, since a choice among the others may find none.
#[test]
fn the_pmf_of_all_lights_sums_to_one() {
    let mut exact = 0;
    for (name, _) in scene::builtin_of_few_lights() {
        let scene = scene::load(name).unwrap();
        let lights = Lights::new(&scene, None).unwrap();
        if scene.shapes.is_empty() || lights.is_empty() {
            continue;
        }
        for number in 0..200 {
            let (p, normal, [u, second, ..]) = packet(&scene, number);
            let chosen = lights.choose(p, normal, [u, second]).pmf.gt(X8::lit(0.0));
            let pmf = lights.pmf(p, normal);
            for lane in (0..8).filter(|&lane| chosen.lane(lane)) {
                let sum: f64 = (0..lights.len() as u32).map(|light| pmf.of(light).lane_f64(lane)).sum();
                assert!(sum < 1.0 + 2e-6, "{name}: {sum}");
                if lights.only_few_areas() {
                    assert!(sum > 1.0 - 2e-6, "{name}: {sum}");
                    exact += 1;
                }
            }
        }
    }
    assert!(exact > 1000, "{exact}");
}
