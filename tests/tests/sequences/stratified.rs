//! Each stratum of a set has one sample, and sets are permuted at random.

use super::point;
use etendue::sequence::Stratified;
use etendue_judge::stats;
use etendue_judge::tolerances::SIGNIFICANCE;

/// A name, and a function of a counter.
type Neighbours<'a> = (&'a str, &'a dyn Fn(u32) -> (usize, usize));

fn likely(p: f64, what: &str) {
    assert!(p > SIGNIFICANCE, "{what}: p = {p:e}");
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
                let u = point(&sequence, pixel, replicate * count + i, dimension);
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
            let u = point(&sequence, pixel, replicate * count + index, dimension);
            (u[0] * f64::from(columns)) as usize + columns as usize * (u[1] * f64::from(rows)) as usize
        };
        let n = 40_000;
        // the cells of two samples, over pixels, replicates and dimensions
        let over: [Neighbours<'_>; 4] = [
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
