//! Sobol's points are the nets that they claim to be.

use super::{joint, point};
use etendue::Vec2;
use etendue::sequence::{Independent, JointSobol, OwenSobol, Sequence, Stratified, ZOrder, ZOrderIndex};
use etendue_judge::generators::AlongCurve;

/// Visits every way to write `sum` as `split.len()` natural numbers, until `visit` returns false.
fn splits(sum: u32, split: &mut [u32], visit: &mut impl FnMut(&[u32]) -> bool) -> bool {
    fn rest(sum: u32, split: &mut [u32], at: usize, visit: &mut impl FnMut(&[u32]) -> bool) -> bool {
        if at + 1 == split.len() {
            split[at] = sum;
            return visit(split);
        }
        (0..=sum).all(|first| {
            split[at] = first;
            rest(sum - first, split, at + 1, visit)
        })
    }
    rest(sum, split, 0, visit)
}

/// The least t for which 2ᵐ points are a (t, m, s)-net in the given dimensions: each box of volume 2ᵗ⁻ᵐ holds 2ᵗ of them.
fn quality<const S: usize>(points: impl Iterator<Item = [f64; S]>, dimensions: &[usize]) -> u32 {
    let points: Vec<_> = points.collect();
    let m = points.len().ilog2();
    assert_eq!(points.len(), 1 << m);
    let even = |t: u32| {
        splits(m - t, &mut vec![0; dimensions.len()], &mut |split| {
            let mut count = vec![0_u32; 1 << (m - t)];
            for p in &points {
                let cell = dimensions
                    .iter()
                    .zip(split)
                    .fold(0, |cell, (&d, &bits)| cell << bits | (p[d] * f64::from(1_u32 << bits)) as usize);
                count[cell] += 1;
            }
            count.iter().all(|&n| n == 1 << t)
        })
    };
    (0..=m).find(|&t| even(t)).unwrap()
}
/// Whether every box of 2⁻ᵃ × 2ᵃ⁻ᵐ holds one of 2ᵐ points.
fn is_net(points: impl Iterator<Item = [f64; 2]>) -> bool {
    quality(points, &[0, 1]) == 0
}

#[test]
fn owen_sobol() {
    for m in 0..=14 {
        for (scramble, pixel, dimension) in [(1, 0, 0), (1, 1, 0), (2, 12_345, 7), (3, u32::MAX, u32::MAX)] {
            let sobol = OwenSobol::new(scramble);
            // the first block, one among the first 2¹⁶ samples, two beyond, and the last
            for first in [0, 3 << m, 65_536 + (5 << m), 0x8765_4000, u32::MAX - ((1 << m) - 1)] {
                let points = (0..1 << m).map(|i| point(&sobol, pixel, first + i, dimension));
                assert!(is_net(points), "2^{m} points from {first}, pixel {pixel}");
            }
        }
    }
    // as fine as the grid of u resolves: 2²⁰ points in one scramble
    assert!(is_net((0..1 << 20).map(|i| point(&OwenSobol::new(9), 4, i, 2))), "2^20 points");
}

/// The position of a pixel along the Z-order curve.
pub(super) fn position(x: u32, y: u32) -> u32 {
    (0..16).map(|bit| (x >> bit & 1) << (2 * bit) | (y >> bit & 1) << (2 * bit + 1)).sum()
}

#[test]
fn z_order_in_a_pixel_and_over_squares() {
    for samples in [1, 2, 3, 4, 8, 16, 32] {
        let z = AlongCurve(ZOrder::new(5, samples));
        let held = z.0.samples();
        assert_eq!(held, samples.next_power_of_two());
        for dimension in [0, 1, 6] {
            for [x0, y0, side] in [[0, 0, 1], [3, 5, 1], [6, 4, 2], [24, 40, 8], [4096, 8192, 16]] {
                // the first net of a pixel, and later ones
                for replicate in [0, 1, 1000] {
                    let pixels = (0..side * side).map(|i| position(x0 + i % side, y0 + i / side));
                    let samples = pixels.flat_map(|pixel| (0..held).map(move |i| (pixel, replicate * held + i)));
                    let points = samples.map(|(pixel, sample)| point(&z, pixel, sample, dimension));
                    assert!(is_net(points), "{held} samples, {side}² pixels, dimension {dimension}");
                }
            }
        }
    }
    // 2³¹ samples in a pixel: the shift must not become 32
    assert!(is_net((0..1024).map(|i| point(&AlongCurve(ZOrder::new(5, u32::MAX)), 7, (1 << 30) + i, 0))));
    // one sample in a pixel: all 32 bits belong to the pixel
    assert!(is_net((0..1024).map(|i| point(&AlongCurve(ZOrder::new(5, 0)), (1 << 31) + i, 0, 0))));
    let z = ZOrder::new(3, 4);
    for (x, y) in [(0, 0), (1, 0), (0, 1), (5, 6), (255, 3), (65_535, 65_535), (40_000, 1_234)] {
        let (by_index, by_position) = (ZOrderIndex::new(x, y), ZOrderIndex::from_position(position(x, y)));
        assert_eq!(z.pair::<f32>(by_index, 1, 0), z.pair(by_position, 1, 0), "{x}, {y}");
    }
}

/// Sobol's bound on t: the sum of the polynomials' degrees, each less one.
const BOUND: [u32; 9] = [0, 0, 0, 1, 3, 5, 8, 11, 15];

#[test]
fn joint_sobol() {
    for m in [0, 1, 3, 4, 6, 8, 10] {
        for (seed, pixel) in [(1, 0), (2, 12_345), (3, u32::MAX)] {
            let sobol = JointSobol::new(seed);
            for first in [0, 5 << m, 65_536 + (3 << m), u32::MAX - ((1 << m) - 1)] {
                let points = || (0..1 << m).map(|i| joint(&sobol, pixel, first + i));
                for (s, &bound) in BOUND.iter().enumerate().take(if m > 8 { 7 } else { 9 }).skip(1) {
                    let t = quality(points(), &(0..s).collect::<Vec<_>>());
                    assert!(t <= bound, "2^{m} points from {first} in {s} dimensions: t = {t}");
                }
                for d in 0..8 {
                    assert_eq!(quality(points(), &[d]), 0, "2^{m} points from {first}, dimension {d}");
                }
            }
        }
    }
    let points = || (0..1 << 10).map(|i| joint(&JointSobol::new(1), 0, i));
    // in three dimensions no sequence is better; in four, this many points are better than the bound
    assert_eq!([3, 4].map(|s| quality(points(), &(0..s).collect::<Vec<_>>())), [1, 2]);
    // each pair alone: unlike in the padded sequence, t is not always 0
    let pairs = [[0, 1], [2, 3], [4, 5], [6, 7]].map(|pair| quality(points(), &pair));
    println!("1024 points, t of the pairs: {pairs:?}");
    assert_eq!(pairs[0], 0);
    assert!(pairs.iter().all(|&t| t <= 5), "{pairs:?}");
    let padded: Vec2<f32> = OwenSobol::new(3).pair(5, 6, 4);
    assert_eq!(JointSobol::new(3).pair::<f32>(5, 6, 4), padded);
}

#[test]
fn the_check_can_fail() {
    assert!(!is_net((0..16).map(|i| point(&Independent::new(1), 0, i, 0))), "independent");
    assert!(!is_net((0..16).map(|i| point(&Stratified::new(1, 16), 0, i, 0))), "jitter");
    assert!(!is_net((2..18).map(|i| point(&OwenSobol::new(1), 0, i, 0))), "unaligned");
    assert!(!is_net((0..16).map(|i| point(&OwenSobol::new(1), i / 8, i, 0))), "two pixels");
    let worst = |f: &dyn Fn(u32) -> [f64; 8]| quality((0..1024).map(f), &[0, 1, 2, 3]);
    assert!(worst(&|i| joint(&Independent::new(1), 0, i)) > 3);
    assert!(worst(&|i| joint(&OwenSobol::new(1), 0, i)) > 3, "padded pairs together are no net");
    assert!(worst(&|i| joint(&JointSobol::new(1), 0, i + 512)) > 3, "unaligned points are no net");
    assert!(worst(&|i| joint(&JointSobol::new(1), i / 512, i % 512)) > 3, "points of two pixels are no net");
    assert!(worst(&|i| joint(&JointSobol::new(1), 0, i)) <= 3);
}
