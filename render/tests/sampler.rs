//! The random numbers that samplers generate for the pixel, the light and the lens.

use etendue::{Mask, Real, Vec2, u32x8};
use etendue_oracle::tier::cases;
use etendue_render::Sampler;
use etendue_render::film::compare::differs;
use etendue_render::packet::X8;
use etendue_render::sampler::{CHOICE, FILM, LENS, LIGHT, NumberSource, Packet};
use std::collections::HashMap;

type M8 = <X8 as Real>::Mask;

/// Eight samples of a pixel, each of which is in a set.
fn packet([x, y]: [u32; 2], sample: u32x8, set: u32x8) -> Packet {
    Packet { x: u32x8::splat(x), y: u32x8::splat(y), sample, set, active: M8::splat(true) }
}

/// The bits of the first numbers of eight pairs.
fn bits(pairs: Vec2<X8>) -> Vec<u32> {
    (0..8).map(|k| pairs.lane(k).x.to_bits()).collect()
}

const LANES: [u32; 8] = [0, 1, 2, 3, 4, 5, 6, 7];

/// Film, light and lens numbers of every sample of one pixel, in order.
fn points(sampler: Sampler, spp: u32, pixel: [u32; 2], seed: u64) -> (Vec<[f64; 6]>, u32) {
    let source = NumberSource::new(sampler, seed, [spp, 0], 256, true);
    let set = |i: u32| i.checked_div(source.set_size()).unwrap_or(0);
    let mut all = Vec::new();
    for start in (0..spp).step_by(8) {
        let sample = |k: u32| (start + k).min(spp - 1);
        let lanes = LANES.map(sample);
        let packet = packet(pixel, u32x8::from(lanes), u32x8::from(lanes.map(set)));
        let pairs = [FILM, LIGHT, LENS].map(|dimension| source.pair(&packet, dimension));
        let [film, light] = source.film_and_light(&packet);
        assert_eq!([film, light], [pairs[0], pairs[1]], "{sampler:?}");
        for k in 0..(spp - start).min(8) as usize {
            all.push(std::array::from_fn(|c| {
                let pair = pairs[c / 2].lane(k);
                f64::from(if c % 2 == 0 { pair.x } else { pair.y })
            }));
        }
    }
    (all, source.set_size())
}

/// Whether each of `side`ᵈ cells holds the same number of points, by their first d coordinates.
fn even(points: &[[f64; 6]], side: usize, d: usize) -> bool {
    let mut cells = vec![0; side.pow(d as u32)];
    for p in points {
        cells[p[..d].iter().fold(0, |cell, u| cell * side + (u * side as f64) as usize)] += 1;
    }
    cells.iter().all(|&n| n * cells.len() == points.len())
}

#[test]
fn joint_samplers_are_joint() {
    for pixel in [[0, 0], [255, 255], [17, 3]] {
        // with t = 3 in four dimensions and t = 8 in six, 2⁴⁺³ and 2⁶⁺⁸ points fill halves evenly
        for (spp, d) in [(512, 4), (1 << 16, 6)] {
            let (points, span) = points(Sampler::Sobol4d, spp, pixel, 1);
            assert_eq!(span, spp / 4);
            assert!(points.chunks(span as usize).all(|set| even(set, 2, d)), "{spp}");
        }
        // padded samplers are not joint
        for sampler in [Sampler::Independent, Sampler::Stratified, Sampler::Sobol, Sampler::ZOrder] {
            let (points, _) = points(sampler, 512, pixel, 1);
            assert!(!points.chunks(128).all(|set| even(set, 2, 4)), "{sampler:?}");
        }
    }
}

#[test]
fn every_pair_of_a_set_is_even() {
    for sampler in [Sampler::Stratified, Sampler::Sobol, Sampler::Sobol4d, Sampler::ZOrder] {
        for spp in [64, 256] {
            let (points, span) = points(sampler, spp, [9, 200], 2);
            assert_eq!(span, spp / 4);
            let side = span.isqrt() as usize;
            for set in points.chunks(span as usize) {
                for pair in 0..3 {
                    // joint Sobol points are a net in the first pair; the other pairs only together with it
                    if sampler != Sampler::Sobol4d || pair == 0 {
                        let pair: Vec<_> = set.iter().map(|p| [p[2 * pair], p[2 * pair + 1], 0., 0., 0., 0.]).collect();
                        assert!(even(&pair, side, 2), "{sampler:?}");
                    }
                }
            }
        }
    }
}

/// The means of sets, pixels and seeds are uncorrelated, except those of pixels with Z-order.
#[test]
fn sets_are_independent() {
    for sampler in [Sampler::Stratified, Sampler::Sobol, Sampler::Sobol4d, Sampler::ZOrder] {
        // 100 and 24 are not powers of two: a set ends within one of the sequence, and the next one starts anew
        for spp in [32, 256, 100, 24] {
            let means = |pixel: [u32; 2], seed| -> Vec<f64> {
                let (points, span) = points(sampler, spp, pixel, seed);
                let f = |p: &[f64; 6]| (p[0] + 0.3) * (p[2] + 0.1) + p[3] * p[4] + (p[1] - p[5]).powi(2);
                points.chunks(span as usize).map(|set| set.iter().map(f).sum::<f64>() / f64::from(span)).collect()
            };
            let n = cases(400, 2000);
            let (mut sets, mut pixels, mut seeds) = (Vec::new(), Vec::new(), Vec::new());
            for i in 0..n {
                let pixel = [i % 256, i / 256];
                let a = means(pixel, 5);
                sets.push((a[0], a[1]));
                pixels.push((a[0], means([pixel[0] ^ 1, pixel[1]], 5)[0]));
                seeds.push((a[0], means(pixel, 6)[0]));
            }
            for (what, pairs) in [("sets", &sets), ("pixels", &pixels), ("seeds", &seeds)] {
                if what == "pixels" && sampler == Sampler::ZOrder {
                    continue;
                }
                let mean = |f: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>() / f64::from(n);
                let (a, b) = (mean(&|p| p.0), mean(&|p| p.1));
                let covariance = mean(&|p| (p.0 - a) * (p.1 - b));
                let spread = mean(&|p| (p.0 - a).powi(2)) * mean(&|p| (p.1 - b).powi(2));
                // pairs of pixels count twice, in either order
                let z = covariance / spread.sqrt() * f64::from(if what == "pixels" { n / 2 } else { n }).sqrt();
                assert!(!differs(z), "{sampler:?}, {spp} samples: {what} are correlated, z = {z:.2}");
            }
        }
    }
}

#[test]
fn the_choice_of_a_light_has_numbers_of_its_own() {
    for sampler in [Sampler::Independent, Sampler::Sobol, Sampler::Sobol4d, Sampler::ZOrder] {
        let source = NumberSource::new(sampler, 1, [64, 0], 8, true);
        let packet = packet([0; 2], u32x8::from(LANES), u32x8::splat(0));
        let all = [FILM, LIGHT, CHOICE, LENS, 4, 5, 9].map(|dimension| source.pair(&packet, dimension));
        for (i, a) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|b| a != b), "{sampler:?}");
        }
    }
}

/// Each pixel and set has numbers of its own, of whatever sampler.
#[test]
fn each_set_has_numbers_of_its_own() {
    for sampler in [Sampler::Independent, Sampler::Stratified, Sampler::Sobol, Sampler::Sobol4d, Sampler::ZOrder] {
        let source = NumberSource::new(sampler, 5, [64, 4], 16, true);
        let mut seen = HashMap::new();
        for pixel in (0..256).map(|i| [i % 16, i / 16]) {
            for first in (0..64_u32).step_by(8) {
                let set = u32x8::splat(first.checked_div(source.set_size()).unwrap_or(0));
                let packet = packet(pixel, u32x8::from(LANES) + u32x8::splat(first), set);
                let other = seen.insert(bits(source.pair(&packet, LIGHT)), (pixel, first));
                assert_eq!(other, None, "{sampler:?}: the numbers of {:?}", (pixel, first));
            }
        }
    }
}

/// Samples that are counted per light: each pixel, set and light has numbers of its own on the light, and the pixel's own on the film.
#[test]
fn each_light_has_numbers_of_its_own() {
    let source = NumberSource::new(Sampler::Sobol, 3, [64, 4], 256, true);
    assert!(source.allocates());
    let lanes = u32x8::from(LANES);
    let mut seen = HashMap::new();
    for pixel in (0..64).map(|i| [i % 8 * 36, i / 8]).chain([[1, 0], [255, 255]]) {
        for set in 0..4 {
            let packet = packet(pixel, lanes + u32x8::splat(set * source.set_size()), u32x8::splat(set));
            for light in 0..5 {
                let [film, pair] = source.film_and_light_of(&packet, u32x8::splat(light), lanes);
                assert_eq!(film, source.pair(&packet, FILM));
                let other = seen.insert(bits(pair), (pixel, set, light));
                assert_eq!(other, None, "the numbers of {:?}", (pixel, set, light));
            }
        }
    }
}
