//! Sequences: marginals, independence, strata, permutations, and the variances predicted by theory.

use etendue::Vec2;
use etendue::sequence::{CounterRng, Independent, Sequence, Stratified};
use etendue_judge::stats;
use etendue_judge::tolerances::SIGNIFICANCE;
use etendue_oracle::tier::cases;

/// A name, and a function of a counter.
type Counted<'a, T> = (&'a str, &'a dyn Fn(u32) -> T);
type Neighbours<'a, T> = Counted<'a, (T, T)>;

fn pair(sequence: &impl Sequence, pixel: u32, sample: u32, dimension: u32) -> [f64; 2] {
    let u: Vec2<f32> = sequence.pair(pixel, sample, dimension);
    assert!((0.0..1.0).contains(&u.x) && (0.0..1.0).contains(&u.y), "{u:?}");
    [f64::from(u.x), f64::from(u.y)]
}
fn likely(p: f64, what: &str) {
    println!("{what:40} p = {p:.2e}");
    assert!(p > SIGNIFICANCE, "{what}: p = {p:e}");
}

#[test]
fn independent_marginals() {
    // along samples, pixels, dimensions and seeds
    let along: [Counted<'_, [f64; 2]>; 4] = [
        ("samples", &|i| pair(&Independent::new(1), 17, i, 0)),
        ("pixels", &|i| pair(&Independent::new(1), i, 3, 1)),
        ("dimensions", &|i| pair(&Independent::new(1), 17, 3, i)),
        ("seeds", &|i| pair(&Independent::new(u64::from(i) << (i % 33)), 17, 3, 0)),
    ];
    for (name, f) in along {
        let n = 1 << 18;
        let (mut x, mut y, mut xy) = (vec![0_u64; 256], vec![0_u64; 256], vec![0_u64; 1024]);
        let mut low = vec![0_u64; 256];
        let mut last = f(0);
        let mut serial = vec![0_u64; 1024];
        for i in 1..n {
            let u = f(i);
            x[(u[0] * 256.0) as usize] += 1;
            y[(u[1] * 256.0) as usize] += 1;
            xy[(u[0] * 32.0) as usize + 32 * (u[1] * 32.0) as usize] += 1;
            serial[(u[0] * 32.0) as usize + 32 * (last[0] * 32.0) as usize] += 1;
            low[(u[0] * 16_777_216.0) as usize % 256] += 1;
            last = u;
        }
        if name == "seeds" {
            // some of these seeds are equal, so only the marginals are tested
            continue;
        }
        for (what, cells) in [("x", &x), ("y", &y), ("xy", &xy), ("serial", &serial), ("low bits", &low)] {
            likely(stats::uniform(cells), &format!("{name} {what}"));
        }
    }
}

#[test]
fn neighbours_are_not_correlated() {
    let n = 1 << 17;
    let at =
        |seed: u64, pixel: u32, sample: u32, dimension: u32| pair(&Independent::new(seed), pixel, sample, dimension);
    let neighbours: [Neighbours<'_, [f64; 2]>; 6] = [
        ("pixels", &|i| (at(1, i, 0, 0), at(1, i + 1, 0, 0))),
        ("rows of pixels", &|i| (at(1, i, 0, 0), at(1, i + 1920, 0, 0))),
        ("samples", &|i| (at(1, 9, i, 0), at(1, 9, i + 1, 0))),
        ("dimensions of a block", &|i| (at(1, i, 2, 0), at(1, i, 2, 1))),
        ("dimensions", &|i| (at(1, i, 2, 0), at(1, i, 2, 2))),
        ("seeds", &|i| (at(1, i, 2, 0), at(2, i, 2, 0))),
    ];
    for (name, f) in neighbours {
        let both: Vec<_> = (0..n).map(f).collect();
        for (a, b) in [(0, 0), (0, 1), (1, 1)] {
            let pairs: Vec<_> = both.iter().map(|(u, v)| (u[a], v[b])).collect();
            likely(stats::two_sided(stats::correlation(&pairs) * f64::from(n).sqrt()), &format!("{name} {a}{b}"));
        }
        let mut cells = vec![0_u64; 256];
        both.iter().for_each(|(u, v)| cells[(u[0] * 16.0) as usize + 16 * (v[0] * 16.0) as usize] += 1);
        likely(stats::uniform(&cells), &format!("{name} joint"));
    }
}

#[test]
fn counter_rng() {
    use rand_core::{Rng, SeedableRng};
    let mut rng = CounterRng::seed_from_u64(5);
    let mut cells = vec![0_u64; 4096];
    for _ in 0..1 << 20 {
        cells[rng.next_u32() as usize >> 20] += 1;
    }
    likely(stats::uniform(&cells), "words");
    let (mut a, mut b) = (CounterRng::seed_from_u64(5), CounterRng::seed_from_u64(6));
    assert_ne!(a.next_u64(), b.next_u64());
}

/// The cells along one axis that may contain `u`, which may be rounded across a boundary.
fn candidates(u: f64, n: u32) -> [u32; 2] {
    let place = u * f64::from(n);
    let step = f64::from(n) * 2.0_f64.powi(-23);
    [(place - step).max(0.0) as u32, ((place + step) as u32).min(n - 1)]
}

#[test]
fn every_stratum_has_one_sample() {
    for count in [1, 2, 3, 5, 7, 12, 13, 16, 64, 100, 1024, 1 << 17] {
        let sequence = Stratified::new(11, count);
        let [columns, rows] = sequence.grid();
        assert!(columns * rows >= count && columns <= rows && rows <= 2 * columns, "{count}: {columns} × {rows}");
        assert!(columns * rows < 2 * count || count < 4, "{count}: {columns} × {rows}");
        for (pixel, replicate, dimension) in [(0, 0, 0), (5, 0, 1), (5, 3, 2)] {
            let mut taken = vec![false; (columns * rows) as usize];
            let mut doubtful = Vec::new();
            for i in 0..count {
                let u = pair(&sequence, pixel, replicate * count + i, dimension);
                let (c, r) = (candidates(u[0], columns), candidates(u[1], rows));
                let cells =
                    [c[0] + columns * r[0], c[1] + columns * r[0], c[0] + columns * r[1], c[1] + columns * r[1]];
                if cells[0] == cells[3] {
                    let cell = cells[0] as usize;
                    assert!(!taken[cell], "{count}: stratum {cell} twice");
                    taken[cell] = true;
                } else {
                    doubtful.push(cells);
                }
            }
            assert!(doubtful.len() as f64 <= 3.0 + f64::from(count) * 2e-3, "{} samples at boundaries", doubtful.len());
            for cells in doubtful {
                let free = cells.into_iter().find(|&c| !taken[c as usize]);
                taken[free.expect("all strata beside a boundary sample are taken") as usize] = true;
            }
        }
    }
}

#[test]
fn permutations_are_uniform_and_independent() {
    for count in [4, 7, 12, 16, 64, 100] {
        let sequence = Stratified::new(12, count);
        let [columns, rows] = sequence.grid();
        let cells = columns * rows;
        let cell = |pixel, replicate, dimension, index| {
            let u = pair(&sequence, pixel, replicate * count + index, dimension);
            (u[0] * f64::from(columns)) as usize + columns as usize * (u[1] * f64::from(rows)) as usize
        };
        let n = 40_000;
        // the cells of two samples, over pixels, replicates and dimensions
        let over: [Neighbours<'_, usize>; 4] = [
            ("pixels", &|i| (cell(i, 0, 0, 0), cell(i, 0, 0, count - 1))),
            ("replicates", &|i| (cell(3, i, 0, 0), cell(3, i, 0, 1 % count))),
            ("dimensions", &|i| (cell(3, 0, i, 0), cell(3, 0, i, count / 2))),
            ("neighbouring dimensions", &|i| (cell(i, 0, 0, 2 % count), cell(i, 0, 1, 2 % count))),
        ];
        for (name, f) in over {
            let (mut first, mut second) = (vec![0_u64; cells as usize], vec![0_u64; cells as usize]);
            let mut joint = vec![0_u64; (cells * cells) as usize];
            for i in 0..n {
                let (a, b) = f(i);
                first[a] += 1;
                second[b] += 1;
                joint[a * cells as usize + b] += 1;
            }
            likely(stats::uniform(&first), &format!("{count} {name}: first"));
            likely(stats::uniform(&second), &format!("{count} {name}: second"));
            if cells <= 16 {
                // two samples in one permutation are never in the same cell; in two permutations they may be
                let same = name == "neighbouring dimensions";
                let expected = f64::from(n) / f64::from(if same { cells * cells } else { cells * (cells - 1) });
                let expected: Vec<f64> =
                    (0..cells * cells).map(|k| if !same && k % (cells + 1) == 0 { 0.0 } else { expected }).collect();
                likely(stats::chi_square(&joint, &expected), &format!("{count} {name}: joint"));
            }
        }
    }
}

/// Variance over replicates of the mean of `f`.
fn variance(sequence: &Stratified, replicates: u32, f: impl Fn(f64, f64, u32) -> f64) -> f64 {
    let n = sequence.count();
    let means: Vec<f64> = (0..replicates)
        .map(|r| {
            let sum: f64 = (0..n)
                .map(|i| {
                    let u = pair(sequence, r % 97, r / 97 * n + i, 0);
                    f(u[0], u[1], r)
                })
                .sum();
            sum / f64::from(n)
        })
        .collect();
    stats::mean_variance(&means).1
}

#[test]
fn variances() {
    let replicates = cases(5_000, 40_000);
    // the variance of nearly normal means has the relative standard error √(2/n); 5 of them, because it is tested 8 times
    let interval = 5.0 * (2.0 / f64::from(replicates)).sqrt();
    for count in [16, 64, 100] {
        let sequence = Stratified::new(21, count);
        let [columns, _] = sequence.grid();
        let n = f64::from(count);
        // f = x: each of the N points is jittered by 1/columns, so the variance is 1/(12 columns² N)
        let measured = variance(&sequence, replicates, |x, _, _| x);
        let truth = 1.0 / (12.0 * f64::from(columns).powi(2) * n);
        assert!((measured / truth - 1.0).abs() < interval, "f = x, {count}: {measured:e}, expected {truth:e}");
        // a straight edge at a uniform offset: N^(−3/2)/6; the means are bimodal with kurtosis up to 6, so the interval is wider
        let offset = |r: u32| pair(&Independent::new(77), r, 0, 0)[0];
        let measured = variance(&sequence, replicates, |x, _, r| f64::from(x < offset(r)) - offset(r));
        let truth = n.powf(-1.5) / 6.0;
        assert!((measured / truth - 1.0).abs() < 2.0 * interval, "edge, {count}: {measured:e}, expected {truth:e}");
    }
    // a single stratum is independent sampling
    let measured = variance(&Stratified::new(22, 1), replicates, |x, _, _| x);
    assert!((measured * 12.0 - 1.0).abs() < interval, "one stratum: {measured:e}");
    // with a count that does not factor, each point is still uniform
    for count in [7, 13] {
        let sequence = Stratified::new(23, count);
        let mut cells = vec![0_u64; 64];
        for i in 0..100_000 {
            let u = pair(&sequence, i, 3, 1);
            cells[(u[0] * 8.0) as usize + 8 * (u[1] * 8.0) as usize] += 1;
        }
        likely(stats::uniform(&cells), "marginal of one point");
    }
}
