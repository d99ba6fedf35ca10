//! Numbers of samples, weights of lights and variances, by definition.

use super::*;
use crate::sampler::Sampler;
use crate::technique::Technique;
use etendue::select::Allocation;

const WIDTH: usize = 17;
const HEIGHT: usize = 15;

/// Small integers, whose sums are exact.
fn integers(step: usize) -> Vec<f64> {
    (0..WIDTH * HEIGHT).map(|i| (i * step % 31) as f64).collect()
}
/// Σ over the pixels within `reach` rows and columns, excluding the pixel itself, by definition.
fn around(values: &[f64], i: usize, reach: usize) -> f64 {
    let near = |j: usize| (i % WIDTH).abs_diff(j % WIDTH) <= reach && (i / WIDTH).abs_diff(j / WIDTH) <= reach;
    (0..values.len()).filter(|&j| j != i && near(j)).map(|j| values[j]).sum()
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
    for (i, mean) in mean_around(&sums, &counts, WIDTH).into_iter().enumerate() {
        let both = |values: &[f64]| around(values, i, NEAR) + WEIGHT_OUTERMOST * around(values, i, OUTERMOST);
        let expected = both(&sums) / both(&counts);
        assert!((mean / expected - 1.0).abs() < 1e-14, "pixel {i}: {mean} instead of {expected}");
    }
    assert!(mean_around(&sums, &vec![0.0; sums.len()], WIDTH).iter().all(|&mean| mean == 0.0));
}
#[test]
fn the_pilot_is_a_quarter_in_a_power_of_two() {
    for (spp, sets, pilot, packets) in
        [(8, 1, 1, 1.0), (16, 1, 1, 2.0), (24, 1, 1, 3.0), (32, 1, 2, 4.0), (64, 1, 2, 8.0), (100, 2, 2, 6.25)]
            .into_iter()
            .chain([(256, 4, 2, 8.0), (504, 1, 8, 63.0), (512, 1, 16, 64.0), (520, 1, 16, 65.0)])
    {
        let effort = Effort::new(&settings([8, 8], spp, sets), false);
        assert_eq!((effort.pilot, effort.packets), (pilot, packets), "{spp} samples in {sets} sets");
    }
}
fn settings([width, height]: [u32; 2], spp: u32, sets: u32) -> Settings {
    let (technique, sampler) = (Technique::SolidAngle, Sampler::Adaptive);
    Settings { width, height, spp, technique, sampler, sets, seed: 5, ..Settings::DEFAULT }
}
fn effort(sets: u32, pilot: u32, packets: f64) -> Effort {
    Effort { sets, pilot, packets, checks: 0.0 }
}

fn pilot(variance: impl Fn(usize) -> f64) -> Vec<Statistics> {
    (0..WIDTH * HEIGHT).map(|i| Statistics { variance: variance(i), ..Statistics::default() }).collect()
}
fn average(packets: &[u32]) -> f64 {
    packets.iter().copied().map(f64::from).sum::<f64>() / packets.len() as f64
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
        let (packets, _) = allot(&parts, WIDTH as u32, &effort(1, 2, 16.0));
        assert!(packets.iter().all(|&packets| packets == 16));
    }
}
#[test]
fn equal_variance_gets_equal_numbers() {
    let effort = effort(1, 2, 16.0);
    for variance in [0.0, 3.0] {
        let (packets, weights) = allot(&pilot(|_| variance), WIDTH as u32, &effort);
        assert!(packets.iter().all(|&n| n == 16), "{packets:?}");
        assert!(weights.is_none());
    }
    // without variance, never less than the pilot
    let (packets, _) = allot(&pilot(|_| 0.0), WIDTH as u32, &self::effort(1, 2, 1.3));
    assert!(packets.iter().all(|&n| n == 2));
}
/// Two halves of a large image, whose variances have a ratio of 32: the numbers have that of 32^0.4 = 4.
#[test]
fn numbers_follow_the_variance_around() {
    let side = 64;
    let part =
        |i: usize| Statistics { variance: if i % side < side / 2 { 1.0 } else { 32.0 }, ..Statistics::default() };
    let parts: Vec<_> = (0..side * side).map(part).collect();
    let (packets, _) = allot(&parts, side as u32, &self::effort(1, 2, 100.0));
    assert!((average(&packets) / 100.0 - 1.0).abs() < 0.02, "{}", average(&packets));
    // away from the border by more than the far neighbours
    let columns = |from: usize, to: usize| -> Vec<u32> {
        packets.chunks(side).flat_map(|row| row[from..to].iter().copied()).collect()
    };
    let ratio = average(&columns(39, 64)) / average(&columns(0, 25));
    assert!((ratio / 4.0 - 1.0).abs() < 0.03, "{ratio}");
    assert!(packets.iter().all(|&n| n.is_power_of_two()));
    // and the pilot is the least
    let (packets, _) = allot(&parts, side as u32, &self::effort(1, 64, 100.0));
    assert!(packets.chunks(side).all(|row| row[..25].iter().all(|&n| n == 64)));
    assert!((average(&packets) / 100.0 - 1.0).abs() < 0.02, "{}", average(&packets));
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
    let (packets, weights) = allot(&parts, side as u32, &effort(sets, 2, 100.0));
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

fn packet(of: impl Fn(usize) -> [f32; 3]) -> V8 {
    let lane = |channel: usize| X8::from_fn(|k| of(k)[channel]);
    V8::new(lane(0), lane(1), lane(2))
}

/// Without allocated samples, the variance is that of the means of four samples.
#[test]
fn variances_are_of_means_of_four() {
    let mut sum = StatisticsSum::new(0);
    let mut means: [Vec<f64>; 3] = Default::default();
    for set in 0..2 {
        sum.begin(0);
        for n in 0..2 {
            let sample = |k: usize| [k as f32, (k * k) as f32, (set * 2 + n) as f32 * 3.0 + k as f32 % 2.0];
            sum.push_packet(packet(sample), packet(|_| [100.0; 3]), None);
            for first in [0, 4] {
                for (channel, means) in means.iter_mut().enumerate() {
                    means.push((first..first + 4).map(|k| f64::from(sample(k)[channel])).sum::<f64>() / 4.0);
                }
            }
        }
    }
    let variance = |x: &Vec<f64>| {
        let mean = x.iter().sum::<f64>() / x.len() as f64;
        x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (x.len() - 1) as f64
    };
    let expected: f64 = means.iter().map(variance).sum();
    let found = sum.finish();
    assert!((found.variance / expected - 1.0).abs() < 1e-14, "{} {expected}", found.variance);
    assert_eq!((found.packets, found.lights), (2, 0));
    assert_eq!(found.sums[1], [56.0, 280.0, 8.0 * (6.0 + 9.0) + 8.0]);
    // and the next pixel begins anew
    sum.begin(0);
    sum.push_packet(packet(|_| [1.0; 3]), packet(|_| [0.0; 3]), None);
    assert_eq!(sum.finish().variance, 0.0);
}
/// Allocated samples are compared in pairs of the same light, times its squared share, without what the camera sees.
#[test]
fn spreads_are_of_pairs_of_one_light() {
    // five samples of the first light and three of the second: pairs 0-1, 2-3 and 6-7
    let mut before = Allocation::NONE;
    let allocation = Allocation::new(&[5.0, 3.0], 8, &mut before);
    let counts = [before[0], before[1]];
    let allocated = allocation.samples::<X8>(0);
    let light = allocated.light.to_array();
    let reflected = |k: usize| [(k * k) as f32, 2.0 * k as f32, 1.0];
    let seen = |k: usize| [if k < 4 { 3.0 } else { 5.0 }, 0.0, 0.0];
    let both = |k: usize| std::array::from_fn(|channel| reflected(k)[channel] + seen(k)[channel]);
    let mut expected = [[0.0; 2]; 2];
    for k in [0, 2, 4, 6].into_iter().filter(|&k| light[k] == light[k + 1]) {
        let [a, b] = [reflected(k), reflected(k + 1)];
        let square: f32 = (0..3).map(|channel| (a[channel] - b[channel]).powi(2)).sum();
        let own = &mut expected[light[k] as usize];
        *own = [own[0] + f64::from(square) * (f64::from(counts[light[k] as usize]) / 8.0).powi(2), own[1] + 1.0];
    }
    assert!(expected.iter().any(|own| own[1] > 0.0) && counts.iter().all(|&n| n > 0), "{light:?}");
    let mut sum = StatisticsSum::new(2);
    for _ in 0..2 {
        sum.begin(0);
        sum.push_packet(packet(both), packet(seen), Some(&allocated));
    }
    let found = sum.finish();
    assert_eq!(found.lights, 2);
    for k in 0..2 {
        assert_eq!(f64::from(found.spread[k]), expected[k][0], "light {k}");
        assert_eq!([found.pairs[k], found.taken[k]], [expected[k][1] as u32, counts[k]], "light {k}");
    }
    // four means: 3, 5, 3, 5
    assert!((found.variance - 4.0 / 3.0).abs() < 1e-14, "{}", found.variance);
    // among more lights than are kept apart: the mean square of four pairs of each set, in the unit of the variance, and this
    let mut sum = StatisticsSum::new(APART + 1);
    for _ in 0..2 {
        sum.begin(0);
        sum.push_packet(packet(both), packet(seen), Some(&allocated));
    }
    let squares: f64 = [0, 2, 4, 6]
        .into_iter()
        .filter(|&k| light[k] == light[k + 1])
        .map(|k| ((k + 1) * (k + 1) - k * k).pow(2) as f64 + 4.0)
        .sum();
    let found = sum.finish();
    assert_eq!(found.lights, 0);
    let all = squares / (4.0 * 16.0) + 4.0 / 3.0;
    assert!((found.variance / all - 1.0).abs() < 1e-14, "{} {all}", found.variance);
}

/// A light with a quarter of the samples has 8 times the variance of one with all of them: (1/4)^−1.5.
#[test]
fn squares_count_the_samples_of_each_light() {
    let (mut spread, mut pairs, mut taken) = ([0.0; APART], [0; APART], [0; APART]);
    spread[..3].copy_from_slice(&[6.0, 5.0, 7.0]);
    pairs[..3].copy_from_slice(&[3, 1, 0]);
    taken[..3].copy_from_slice(&[4, 11, 1]);
    let part = Statistics { packets: 2, variance: 0.25, lights: 3, spread, pairs, taken, ..Statistics::default() };
    let expected = 16.0 * 0.25 + 2.0 * 8.0 + 5.0 * (16.0 / 11.0_f64).powf(1.5);
    assert!((part.square() / expected - 1.0).abs() < 1e-12, "{}", part.square());
    assert_eq!(Statistics { packets: 2, variance: 0.5, ..Statistics::default() }.square(), 8.0);
}
