//! Points for each value of one counter are uniform and independent of each other.

use super::{both, joint, point};
use etendue::sequence::{CounterRng, Independent, JointSobol, OwenSobol, Stratified, ZOrder};
use etendue_judge::generators::AlongCurve;
use etendue_judge::stats;
use etendue_judge::tolerances::SIGNIFICANCE;
use rand_core::{Rng, SeedableRng};

/// Points for the values of a counter are uniform: in each coordinate and its low bits, and together with each other coordinate, of the
/// point and of the one before.
fn uniform_over<const S: usize>(name: &str, point: impl FnMut(u32) -> [f64; S]) {
    let points: Vec<_> = (0..150_000).map(point).collect();
    let likely = |p: f64, what: &dyn Fn() -> String| assert!(p > SIGNIFICANCE, "{name}, {}: p = {p:e}", what());
    let cells = |count: usize, cell: &dyn Fn(usize) -> f64| {
        let mut cells = vec![0_u64; count];
        (1..points.len()).for_each(|i| cells[cell(i) as usize] += 1);
        stats::uniform(&cells)
    };
    for a in 0..S {
        likely(cells(4096, &|i| points[i][a] * 4096.0), &|| format!("coordinate {a}"));
        let steps = |i: usize| points[i][a] * 16_777_216.0;
        // of what is a multiple of 2⁻²⁴
        if (0..points.len()).all(|i| steps(i).fract() == 0.0) {
            likely(cells(256, &|i| steps(i) % 256.0), &|| format!("low bits of coordinate {a}"));
        }
        for (b, before) in (0..S).flat_map(|b| [(b, 0), (b, 1)]).filter(|&(b, before)| before == 1 || b < a) {
            let pair = |i: usize| (points[i][a], points[i - before][b]);
            let said = || format!("coordinates {a} and {b}, {before} before");
            let joint = |i: usize| (pair(i).0 * 32.0).floor() * 32.0 + pair(i).1 * 32.0;
            likely(cells(1024, &joint), &said);
            let pairs: Vec<_> = (1..points.len()).map(pair).collect();
            likely(stats::two_sided(stats::correlation(&pairs) * (pairs.len() as f64).sqrt()), &said);
        }
    }
}

#[test]
fn independent_numbers() {
    let at = |seed, pixel, sample, dimension| point(&Independent::new(seed), pixel, sample, dimension);
    uniform_over("samples", |i| at(1, 17, i, 0));
    uniform_over("pixels", |i| both(at(1, i, 3, 1), at(1, i + 1920, 3, 1)));
    uniform_over("dimensions", |i| at(1, 17, 3, i));
    uniform_over("pairs of a block", |i| both(at(1, i, 2, 0), at(1, i, 2, 1)));
    uniform_over("pairs of two blocks", |i| both(at(1, i, 2, 0), at(1, i, 2, 2)));
    uniform_over("two seeds", |i| both(at(1, i, 2, 0), at(2, i, 2, 0)));
    for shift in [0, 15, 32, 46] {
        uniform_over("seeds", |i| at(u64::from(i) << shift, 17, 3, 0));
    }
    let mut rng = CounterRng::seed_from_u64(5);
    uniform_over("words", |_| [f64::from(rng.next_u32() >> 8) / 16_777_216.0]);
    let (mut a, mut b) = (CounterRng::seed_from_u64(5), CounterRng::seed_from_u64(6));
    assert_ne!(a.next_u64(), b.next_u64());
}

/// Of sequences whose samples depend on each other, each sample alone.
#[test]
fn each_sample_alone() {
    let sobol = OwenSobol::new(1);
    for sample in [0, 1, 5, 70_000] {
        uniform_over("sobol, pixels", |i| point(&sobol, i, sample, 0));
        uniform_over("sobol, dimensions", |i| point(&sobol, 3, sample, i));
        uniform_over("sobol, seeds", |i| point(&OwenSobol::new(u64::from(i)), 3, sample, 1));
    }
    uniform_over("z-order, seeds", |i| point(&AlongCurve(ZOrder::new(u64::from(i), 4)), 1000, 3, 1));
    uniform_over("z-order, dimensions", |i| point(&AlongCurve(ZOrder::new(1, 4)), 1000, 3, i));
    uniform_over("z-order, tiles", |i| point(&AlongCurve(ZOrder::new(1, 1 << 31)), 2 * i, 3, 0));
    for sample in [0, 1, 77] {
        uniform_over("joint sobol, pixels", |i| joint(&JointSobol::new(1), i, sample));
        uniform_over("joint sobol, seeds", |i| joint(&JointSobol::new(u64::from(i)), 9, sample));
    }
    // of one stratum, and with counts that do not factor
    for count in [1, 7, 13] {
        uniform_over("strata, pixels", |i| point(&Stratified::new(23, count), i, 3, 1));
    }
}
