//! Sequences of several pairs at once: they are the nets and the strata that they claim to be.

use etendue::Vec2;
use etendue::sequence::{Independent, JointSobol, OwenSobol, Sequence};
use etendue_judge::stats;
use etendue_judge::tolerances::SIGNIFICANCE;

fn point(sequence: &impl Sequence, pixel: u32, sample: u32) -> [f64; 8] {
    let mut all = [0.0; 8];
    for (dimension, u) in all.chunks_mut(2).enumerate() {
        let pair: Vec2<f64> = sequence.pair(pixel, sample, dimension as u32);
        (u[0], u[1]) = (pair.x, pair.y);
    }
    all
}

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

/// The least t for which the 2ᵐ points are a (t, m, s)-net in the given dimensions: each box of volume 2ᵗ⁻ᵐ holds 2ᵗ of them.
fn quality(points: &[[f64; 8]], dimensions: &[usize]) -> u32 {
    let m = points.len().ilog2();
    assert_eq!(points.len(), 1 << m);
    let even = |t: u32| {
        splits(m - t, &mut vec![0; dimensions.len()], &mut |split| {
            let mut count = vec![0_u32; 1 << (m - t)];
            for p in points {
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

/// Sobol's bound on t: the sum of the polynomials' degrees, each less one.
const BOUND: [u32; 9] = [0, 0, 0, 1, 3, 5, 8, 11, 15];

#[test]
fn joint_sobol_is_a_net() {
    for m in [0, 1, 3, 4, 6, 8, 10] {
        for (seed, pixel) in [(1, 0), (2, 12_345), (3, u32::MAX)] {
            let sobol = JointSobol::new(seed);
            for first in [0, 5 << m, 65_536 + (3 << m), u32::MAX - ((1 << m) - 1)] {
                let points: Vec<_> = (0..1 << m).map(|i| point(&sobol, pixel, first + i)).collect();
                for (s, &bound) in BOUND.iter().enumerate().take(if m > 8 { 7 } else { 9 }).skip(1) {
                    let dimensions: Vec<usize> = (0..s).collect();
                    let t = quality(&points, &dimensions);
                    assert!(t <= bound, "2^{m} points from {first} in {s} dimensions: t = {t}");
                }
                for d in 0..8 {
                    assert_eq!(quality(&points, &[d]), 0, "2^{m} points from {first}, dimension {d}");
                }
            }
        }
    }
    let points: Vec<_> = (0..1 << 10).map(|i| point(&JointSobol::new(1), 0, i)).collect();
    // in three dimensions no sequence is better; in four, this many points are better than the bound
    assert_eq!([3, 4].map(|s| quality(&points, &(0..s).collect::<Vec<_>>())), [1, 2]);
    // each pair alone: unlike in the padded sequence, t is not always 0
    let pairs = [[0, 1], [2, 3], [4, 5], [6, 7]].map(|pair| quality(&points, &pair));
    println!("1024 points, t of the pairs: {pairs:?}");
    assert_eq!(pairs[0], 0);
    assert!(pairs.iter().all(|&t| t <= 5), "{pairs:?}");
}

#[test]
fn net_check_can_fail() {
    let worst = |f: &dyn Fn(u32) -> [f64; 8]| quality(&(0..1024).map(f).collect::<Vec<_>>(), &[0, 1, 2, 3]);
    assert!(worst(&|i| point(&Independent::new(1), 0, i)) > 3);
    assert!(worst(&|i| point(&OwenSobol::new(1), 0, i)) > 3, "padded pairs together are no net");
    assert!(worst(&|i| point(&JointSobol::new(1), 0, i + 512)) > 3, "unaligned points are no net");
    assert!(worst(&|i| point(&JointSobol::new(1), i / 512, i % 512)) > 3, "points of two pixels are no net");
    assert!(worst(&|i| point(&JointSobol::new(1), 0, i)) <= 3);
}

/// Any single sample is uniform over pixels and over seeds, in all pairs of coordinates.
#[test]
fn each_point_is_uniform() {
    fn check(name: &str, point: impl Fn(u32) -> [f64; 8]) {
        let points: Vec<_> = (0..100_000).map(point).collect();
        for a in 0..8 {
            for b in 0..a {
                let mut cells = vec![0_u64; 24 * 24];
                points.iter().for_each(|p| cells[(p[a] * 24.0) as usize * 24 + (p[b] * 24.0) as usize] += 1);
                let p = stats::uniform(&cells);
                assert!(p > SIGNIFICANCE, "{name}: coordinates {a} and {b}: p = {p:e}");
            }
        }
    }
    for sample in [0, 1, 77] {
        check("sobol, pixels", |i| point(&JointSobol::new(1), i, sample));
        check("sobol, seeds", |i| point(&JointSobol::new(u64::from(i)), 9, sample));
    }
}

#[test]
fn pairs_beyond_the_joint_ones_are_padded() {
    let padded: Vec2<f32> = OwenSobol::new(3).pair(5, 6, 4);
    assert_eq!(JointSobol::new(3).pair::<f32>(5, 6, 4), padded);
}
