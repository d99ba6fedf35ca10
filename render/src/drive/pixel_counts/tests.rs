//! Numbers of samples, weights of lights and variances, by definition.

use super::super::corners::packets_for;
use super::super::pixel_statistics::Outline;
use super::*;
use crate::sampler::Sampler;
use crate::technique::Technique;

/// Packets per set for each pixel, and with those that only look; and the lights with their weights.
fn count_packets(parts: &[Statistics], width: u32, plan: &SamplePlan) -> ([Vec<u32>; 2], Option<Shared>) {
    let (wanted, weights) = all_wanted(parts, width);
    (share_out(&wanted, width as usize, plan), weights)
}

const WIDTH: usize = 17;
const HEIGHT: usize = 15;

/// Small integers, whose sums are exact.
fn integers(step: usize) -> Vec<f64> {
    (0..WIDTH * HEIGHT).map(|i| (i * step % 31) as f64).collect()
}
/// Σ over the pixels within `reach` rows and columns that have another colour, by definition.
fn around(values: &[f64], i: usize, reach: usize) -> f64 {
    let near = |j: usize| (i % WIDTH).abs_diff(j % WIDTH) <= reach && (i / WIDTH).abs_diff(j / WIDTH) <= reach;
    let other = |j: usize| [i % WIDTH % 3, i / WIDTH % 3] != [j % WIDTH % 3, j / WIDTH % 3];
    (0..values.len()).filter(|&j| other(j) && near(j)).map(|j| values[j]).sum()
}

#[test]
fn neighbours_are_summed() {
    let values = integers(7);
    for reach in [1, NEAR, OUTERMOST, 40] {
        for (i, sum) in sums_around(&values, WIDTH, reach).into_iter().enumerate() {
            assert_eq!(sum, around(&values, i, reach), "pixel {i}, reach {reach}");
        }
    }
}
#[test]
fn means_weight_near_and_far_neighbours() {
    let (sums, mut counts) = (integers(7), integers(5));
    counts[..9].fill(0.0);
    for (i, mean) in mean_around(&sums, Some(&counts), WIDTH).into_iter().enumerate() {
        let both = |values: &[f64]| around(values, i, NEAR) + WEIGHT_OUTERMOST * around(values, i, OUTERMOST);
        let expected = both(&sums) / both(&counts);
        assert!((mean / expected - 1.0).abs() < 1e-14, "pixel {i}: {mean} instead of {expected}");
    }
    assert_eq!(mean_around(&sums, None, WIDTH), mean_around(&sums, Some(&vec![1.0; sums.len()]), WIDTH));
    assert!(mean_around(&sums, Some(&vec![0.0; sums.len()]), WIDTH).iter().all(|&mean| mean == 0.0));
}
#[test]
fn the_pilot_is_a_quarter_in_a_power_of_two() {
    for (spp, sets, pilot, packets) in
        [(8, 1, 1, 1.125), (16, 1, 1, 2.0), (24, 1, 1, 3.0), (32, 1, 2, 4.0), (64, 1, 2, 8.0), (100, 2, 2, 6.25)]
            .into_iter()
            .chain([(256, 4, 2, 8.0), (504, 1, 8, 63.0), (512, 1, 16, 64.0), (520, 1, 16, 65.0)])
    {
        let plan = SamplePlan::new(&settings([8, 8], spp, sets));
        assert_eq!((plan.pilot, plan.packets), (pilot, packets), "{spp} samples in {sets} sets");
    }
}

/// A pilot that lights need is larger, if that leaves two thirds of the samples.
#[test]
fn a_pilot_allocates_to_its_lights() {
    let pilot =
        |spp: u32, lights: usize| SamplePlan::new(&settings([256, 256], spp, 0)).with_pilot(packets_for(lights)).pilot;
    for (spp, lights, packets) in [
        (64, 1, 2),
        (64, 9, 2),
        (97, 9, 2),
        (98, 9, 4),
        (128, 8, 2),
        (128, 14, 4),
        (128, 17, 2),
        (196, 17, 8),
        (256, 14, 4),
        (256, 32, 8),
        (1024, 32, 16),
    ] {
        assert_eq!(pilot(spp, lights), packets, "{spp} samples, {lights} lights");
    }
}
fn settings([width, height]: [u32; 2], spp: u32, sets: u32) -> Settings {
    let (technique, sampler) = (Technique::SolidAngle, Sampler::Adaptive);
    Settings { width, height, spp, technique, sampler, sets, seed: 5, ..Settings::DEFAULT }
}
fn plan(sets: u32, pilot: u32, packets: f64) -> SamplePlan {
    SamplePlan { sets, pilot, packets, checks: 0.0 }
}

fn pilot(variance: impl Fn(usize) -> f64) -> Vec<Statistics> {
    (0..WIDTH * HEIGHT).map(|i| Statistics { variance: variance(i), ..Statistics::default() }).collect()
}
fn average(packets: &[u32]) -> f64 {
    packets.iter().copied().map(f64::from).sum::<f64>() / packets.len() as f64
}

/// The example in the documentation of [`crate::drive`].
#[test]
fn two_halves_of_an_image_share_its_samples() {
    let side = 1024;
    let settings = settings([side, side], 64, 0);
    let plan = SamplePlan::new(&settings);
    assert!((plan.checks, plan.pilot) == (1.0 / 48.0, 2) && (plan.packets - 7.84).abs() < 0.01, "{plan:?}");
    let variance = |i: usize| if i % 64 < 32 { 0.01 } else { 1.0 };
    let parts: Vec<_> = (0..64 * 64).map(|i| Statistics { variance: variance(i), ..Statistics::default() }).collect();
    let ([packets, _], _) = count_packets(&parts, 64, &plan);
    let [dark, bright] = [OUTERMOST..32 - OUTERMOST, 32 + OUTERMOST..64 - OUTERMOST].map(|columns| {
        packets.iter().enumerate().filter(|(i, _)| columns.contains(&(i % 64))).map(|(_, &n)| n).collect::<Vec<_>>()
    });
    assert!(dark.iter().all(|n| [2, 4].contains(n)) && bright.iter().all(|n| [8, 16].contains(n)));
    let means = [average(&dark), average(&bright)];
    assert!((means[0] - 2.1).abs() < 0.1 && (means[1] - 13.5).abs() < 0.3, "{means:?}");
}

/// Where the pilot bounds no number, variances in a ratio of 32 give numbers in that of 32^0.4 = 4.
#[test]
fn numbers_follow_the_variance_around() {
    let variance = |i: usize| if i % 64 < 32 { 1.0 } else { 32.0 };
    let parts: Vec<_> = (0..64 * 64).map(|i| Statistics { variance: variance(i), ..Statistics::default() }).collect();
    let ([packets, _], _) = count_packets(&parts, 64, &plan(1, 2, 100.0));
    assert!((average(&packets) / 100.0 - 1.0).abs() < 0.02, "{}", average(&packets));
    // away from the border by more than the far neighbours
    let columns = |from: usize, to: usize| -> Vec<u32> {
        packets.chunks(64).flat_map(|row| row[from..to].iter().copied()).collect()
    };
    let ratio = average(&columns(39, 64)) / average(&columns(0, 25));
    assert!((ratio / 4.0 - 1.0).abs() < 0.03, "{ratio}");
}

/// Differences of samples that overflow do not keep the search for a scale from ending.
#[test]
fn infinite_variance_gets_equal_numbers() {
    let of_light = Statistics {
        packets: 2,
        lights: 1,
        spread: [f32::INFINITY; APART],
        pairs: [8; APART],
        ..Statistics::default()
    };
    for parts in [vec![of_light; WIDTH * HEIGHT], pilot(|i| if i == 40 { f64::INFINITY } else { 1.0 })] {
        let ([packets, _], _) = count_packets(&parts, WIDTH as u32, &plan(1, 2, 16.0));
        assert!(packets.iter().all(|&packets| packets == 16));
    }
}
#[test]
fn equal_variance_gets_equal_numbers() {
    let plan = plan(1, 2, 16.0);
    for variance in [0.0, 3.0] {
        let ([packets, _], weights) = count_packets(&pilot(|_| variance), WIDTH as u32, &plan);
        assert!(packets.iter().all(|&n| n == 16), "{packets:?}");
        assert!(weights.is_none());
    }
    // without variance, never less than the pilot
    let ([packets, _], _) = count_packets(&pilot(|_| 0.0), WIDTH as u32, &self::plan(1, 2, 1.3));
    assert!(packets.iter().all(|&n| n == 2));
}
/// Weights of lights are the power 0.4 of the mean square of differences around, and numbers that of (Σ weight)^2.5, and what the
/// camera sees.
#[test]
fn lights_are_weighted_by_their_spread() {
    let mut spread = [0.0; APART];
    let mut pairs = [0; APART];
    spread[..3].copy_from_slice(&[64.0, 6.0, 0.0]);
    pairs[..3].copy_from_slice(&[2, 6, 4]);
    // mean squares of 32, 1 and 0: weights of 4, 1 and 0, (4 + 1)^2.5 = 55.9
    let part = |seen: f64| Statistics { lights: 3, spread, pairs, variance: seen, ..Statistics::default() };
    let side = 64;
    let (sets, seen) = (2, (15.0_f64.powf(2.5) - 5.0_f64.powf(2.5)) / 16.0);
    let parts: Vec<_> = (0..side * side).map(|i| part(if i % side < side / 2 { 0.0 } else { seen })).collect();
    let ([packets, looks], weights) = count_packets(&parts, side as u32, &plan(sets, 2, 100.0));
    assert_eq!(packets, looks);
    let (lights, weights) = weights.unwrap();
    assert_eq!(lights, 3);
    for own in weights.chunks(3) {
        assert!((own[0] - 4.0).abs() < 1e-5 && (own[1] - 1.0).abs() < 1e-6 && own[2] == 0.0, "{own:?}");
    }
    let columns = |from: usize, to: usize| -> Vec<u32> {
        packets.chunks(side).flat_map(|row| row[from..to].iter().copied()).collect()
    };
    // the mean of what is seen makes 15 of 5
    let ratio = average(&columns(39, 64)) / average(&columns(0, 25));
    assert!((ratio / 3.0 - 1.0).abs() < 0.03, "{ratio}");
}

/// Neither the count of a pixel nor its weights of lights depend on what the pilot found there: whatever it is, they are the same, bit for bit.
#[test]
fn no_count_depends_on_the_samples_of_its_pixel() {
    let random = |i: usize, k: usize| (crate::sampler::hash64((i * 64 + k) as u64) >> 40) as f32 / (1 << 24) as f32;
    for lights in [0, 3] {
        let part = |i: usize, scale: f32| Statistics {
            variance: f64::from(random(i, 0) * scale),
            outline: Outline { variance: f64::from(random(i, 20) * scale), part: 1.0 },
            lights,
            spread: std::array::from_fn(|k| if k < lights { random(i, 1 + k) * scale } else { 0.0 }),
            pairs: std::array::from_fn(|k| if k < lights { (random(i, 9 + k) * 4.0) as u32 } else { 0 }),
            ..Statistics::default()
        };
        let parts: Vec<_> = (0..WIDTH * HEIGHT).map(|i| part(i, 1.0)).collect();
        let of = |parts: &[Statistics], i: usize| {
            let ([packets, looks], weights) = count_packets(parts, WIDTH as u32, &plan(1, 2, 16.0));
            ([packets[i], looks[i]], weights.map(|(lights, of)| of[i * lights..][..lights].to_vec()), [packets, looks])
        };
        let mut others_change = false;
        for i in 0..parts.len() {
            let before = of(&parts, i);
            for scale in [0.0, 1e6] {
                let mut changed = parts.clone();
                changed[i] = part(i, scale);
                let after = of(&changed, i);
                assert_eq!((before.0, &before.1), (after.0, &after.1), "pixel {i}");
                others_change |= before.2 != after.2;
            }
        }
        assert!(others_change);
    }
}

/// What one pixel has found takes at most 0.42 of the samples, and all samples are spent.
#[test]
fn one_speck_does_not_take_all_samples() {
    let (side, mean) = (64, 16.0);
    for noise in [0.0, 1e-9] {
        let variance = |i: usize| if i == 20 * side + 31 { 1e12 } else { noise };
        let parts: Vec<_> =
            (0..side * side).map(|i| Statistics { variance: variance(i), ..Statistics::default() }).collect();
        let ([packets, _], _) = count_packets(&parts, side as u32, &plan(1, 2, mean));
        let all = packets.iter().copied().map(f64::from).sum::<f64>() / (side * side) as f64;
        assert!((all / mean - 1.0).abs() < 0.1, "{all}");
        let greatest = f64::from(*packets.iter().max().unwrap());
        assert!(greatest <= 2.0 * PART_OF_ALL * mean * (side * side) as f64, "{greatest}");
        let mut sorted = packets;
        sorted.sort_unstable();
        assert!(f64::from(sorted[side * side / 2]) >= 0.5 * mean, "{}", sorted[side * side / 2]);
    }
}

/// No other split of the same time between samples and looks has a smaller error than the one that `wanted` returns.
#[test]
fn wanted_numbers_have_the_least_error() {
    let time = |[samples, looks]: [f64; 2]| samples + (looks - samples) * LOOK;
    for (own, outlines) in [(1.0, 0.0), (1.0, 0.3), (1.0, 1.0), (1.0, 30.0), (0.0, 2.0), (1e-6, 1.0)] {
        let error = |n: [f64; 2]| {
            let scale = 1.0 / time(n);
            own * (n[0] * scale).powf(-1.5) + outlines * (n[1] * scale).powf(-1.5)
        };
        let wanted = wanted(own, outlines).map(|n: f64| n.max(1e-3));
        assert!(wanted[0] <= wanted[1], "{own}, {outlines}: {wanted:?}");
        for ratio in [1.0, 1.01, 1.1, 2.0, 5.0, 20.0] {
            let other = [wanted[1] / ratio, wanted[1]];
            assert!(error(wanted) <= error(other) * (1.0 + 1e-9), "{own}, {outlines}: {wanted:?} and {other:?}");
        }
    }
}

/// Where outlines of lights are all of the variance of some pixels, looks take the time, and no other pixel has any.
#[test]
fn outlines_take_looks() {
    let (side, mean) = (64, 16.0);
    let is_outline = |i: usize| (24..40).contains(&(i % side));
    let part = |i: usize| Statistics {
        variance: 1e-4,
        outline: Outline { variance: if is_outline(i) { 0.01 } else { 0.0 }, part: 1.0 },
        ..Statistics::default()
    };
    let parts: Vec<_> = (0..side * side).map(part).collect();
    let ([packets, looks], _) = count_packets(&parts, side as u32, &plan(1, 2, mean));
    let beside = |i: usize| (24 - OUTERMOST..40 + OUTERMOST).contains(&(i % side));
    assert!((0..side * side).all(|i| packets[i] <= looks[i] && (beside(i) || packets[i] == looks[i])));
    let of = |counts: &[u32]| {
        let own = counts.iter().enumerate().filter(|(i, _)| (30..34).contains(&(i % side)));
        own.map(|(_, &n)| f64::from(n)).sum::<f64>() / (4 * side) as f64
    };
    // in the ratio of (10² (1 − LOOK) / LOOK)^0.4
    let ratio = of(&looks) / of(&packets);
    let expected = (1e2 * (1.0 - LOOK) / LOOK).powf(POWER);
    assert!((0.95..1.05).contains(&(ratio / expected)), "{ratio} instead of {expected}");
    let time = (1.0 - LOOK) * average(&packets) + LOOK * average(&looks);
    assert!((time / mean - 1.0).abs() < 0.02, "{time}");
}

/// A pixel is the mean of what surfaces reflect over its samples, and of what is seen directly over all rays that look.
#[test]
fn pixels_are_sums_of_two_means() {
    let of = |packets: u32, sum: f64, seen: f64| Statistics {
        packets,
        sums: [[sum; 3]; 4],
        seen: [[seen; 3]; 4],
        ..Statistics::default()
    };
    // 2 packets of a pilot, 2 of the rest and 12 that look
    let (pilot, rest, looks) = (of(2, 5.0, 3.0), of(2, 4.0, 1.0), of(12, 20.0, 20.0));
    let sum = set_sum([&pilot.sums, &pilot.seen], [&rest, &looks], [4, 16], 1);
    let expected = (5.0 - 3.0 + 4.0 - 1.0) + (3.0 + 1.0 + 20.0) * 4.0 / 16.0;
    assert_eq!(sum, [expected; 3]);
    let none = Statistics::default();
    assert_eq!(set_sum([&pilot.sums, &pilot.seen], [&rest, &none], [4, 4], 0), [9.0; 3]);
}
