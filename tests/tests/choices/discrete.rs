//! Tables over slices: the frequencies of the cells over every possible `u` match the reported pmf.

use etendue::discrete::{PiecewiseConstant1d, PiecewiseConstant2d};
use etendue::{Vec2, Warp, f32x4, u32x4};
use etendue_judge::generators::Random;
use etendue_oracle::tier::cases;

const STEPS: u32 = 1 << 24;
fn step(i: u32) -> f32 {
    i as f32 / STEPS as f32
}

/// Weights of n cells by regime.
fn regimes(n: usize) -> Vec<(&'static str, Vec<f32>)> {
    let mut random = Random::new(n as u64);
    let mut of = |f: &mut dyn FnMut(usize, &mut Random) -> f64| (0..n).map(|i| f(i, &mut random) as f32).collect();
    vec![
        ("flat", of(&mut |_, _| 1.0)),
        ("ordinary", of(&mut |_, r| r.range(0.1, 1.0))),
        (
            "many zeros, also first and last",
            of(&mut |i, r| if i % 3 == 1 && i + 1 < n { r.unit_f64() + 0.1 } else { 0.0 }),
        ),
        ("twelve decades", of(&mut |_, r| r.magnitude(1e-6, 1e6))),
        ("one cell", of(&mut |i, _| if i == n / 2 { 7.0 } else { 0.0 })),
        ("a peak", of(&mut |i, _| if i == n / 3 { 1e9 } else { 1.0 })),
        ("tiny units", of(&mut |_, r| 1e-38 * r.unit_f64())),
        ("huge units", of(&mut |_, r| 1e38 * r.unit_f64())),
    ]
}

/// Over all 2²⁴ values of u, each cell is drawn exactly as often as its pmf says, never without weight, and within 2⁻²⁴ of its share (or
/// within the one step that any weight is guaranteed).
#[test]
fn piecewise_constant_1d_counts() {
    for n in [1, 2, 3, 7, 1000, 1_000_000].into_iter().take(cases(5, 6)) {
        for (name, weights) in regimes(n) {
            if weights.iter().all(|w| *w == 0.0) {
                continue;
            }
            let mut cdf = vec![0.0; n];
            let table = PiecewiseConstant1d::build(&weights, &mut cdf).unwrap();
            // cells come in order, so their first and last u give the counts
            let total: f64 = weights.iter().map(|&w| f64::from(w)).sum();
            let least = weights.iter().filter(|w| **w > 0.0).fold(f64::MAX, |m, &w| m.min(w.into())) / total;
            let mut start = 0;
            let mut sum = 0.0;
            for (i, &w) in weights.iter().enumerate() {
                let p: f32 = table.pmf(i as u32);
                assert_eq!(p > 0.0, w > 0.0, "{name} {n}: cell {i}");
                let share = f64::from(w) / total;
                if least > 2.0 / f64::from(STEPS) {
                    assert!(
                        (f64::from(p) - share).abs() <= 1.0 / f64::from(STEPS),
                        "{name} {n}: {p}, expected {share}"
                    );
                }
                let count = (p * STEPS as f32) as u32;
                if count > 0 {
                    for u in [start, start + count / 2, start + count - 1] {
                        let cell = table.cell(step(u));
                        assert_eq!((cell.index, cell.pmf), (i as u32, p), "{name} {n} at {u}");
                        assert!((0.0..1.0).contains(&cell.offset));
                        let back: f32 = table.invert_cell(cell.index, cell.offset);
                        assert!((back - step(u)).abs() <= 1.0 / STEPS as f32, "{name} {n}: {} to {back}", step(u));
                        // the point on the line stays in its cell, which has this pdf
                        let x = table.sample(step(u));
                        let pdf: f32 = table.pdf(x);
                        assert_eq!(pdf, p * n as f32, "{name} {n}: {x} at {u}");
                    }
                }
                start += count;
                sum += f64::from(p);
            }
            assert_eq!((start, sum), (STEPS, 1.0), "{name} {n}");
            assert_eq!(table.pdf(-1e-9_f32) + table.pdf(1.0_f32), 0.0);
            assert!(table.cell(1.0_f32).pmf > 0.0 && table.cell(f32::NAN).pmf > 0.0);
        }
    }
}

#[test]
fn piecewise_constant_2d_counts() {
    for [w, h] in [[1, 1], [1, 5], [6, 1], [16, 8], [13, 11], [1000, 500]].into_iter().take(cases(5, 6)) {
        for (name, weights) in regimes(w * h) {
            if weights.iter().all(|w| *w == 0.0) {
                continue;
            }
            let mut buffer = vec![0.0; PiecewiseConstant2d::buffer(w, h)];
            let table = PiecewiseConstant2d::build(&weights, w, &mut buffer).unwrap();
            let mut sum = 0.0;
            for y in 0..h {
                for x in 0..w {
                    let p: f32 = table.pmf(x as u32, y as u32);
                    assert_eq!(p > 0.0, weights[x + y * w] > 0.0, "{name} {w}×{h}: {x} {y}");
                    sum += f64::from(p);
                }
            }
            assert!((sum - 1.0).abs() < 1e-6, "{name} {w}×{h}: {sum}");
            let mut random = Random::new(3);
            for _ in 0..20_000 {
                let mut axis = || match random.word() % 8 {
                    0 => 0.0,
                    1 => 1.0 - step(1),
                    _ => random.unit(),
                };
                let u = Vec2::new(axis(), axis());
                let (cell, p) = (table.cell(u), table.sample(u));
                let weight = weights[cell.x as usize + cell.y as usize * w];
                assert!(weight > 0.0 && cell.pmf > 0.0, "{name} {w}×{h}: {u:?} gives {cell:?}");
                // the same product, perhaps in another order
                let pdf = table.pdf(p);
                assert!((pdf / (cell.pmf * (w * h) as f32) - 1.0).abs() < 3e-7, "{name}: {u:?} {pdf} {cell:?}");
                let back = table.invert_cell(cell.x, cell.y, cell.offset);
                assert!((back.x - u.x).abs().max((back.y - u.y).abs()) <= step(1), "{name} {w}×{h}: {u:?} {back:?}");
                // the point is rounded to 2⁻²⁴ of the whole, which is n times as much of a cell
                let back = table.invert(p);
                let allowed = [(w as f32, cell.x), (h as f32, cell.y)].map(|(n, _)| step(2) * (1.0 + n));
                assert!(
                    (back.x - u.x).abs() <= allowed[0] && (back.y - u.y).abs() <= allowed[1],
                    "{name}: {u:?} {back:?}"
                );
            }
        }
    }
}

/// Cells outside the image, and past the last one of a line, have pmf 0, however far outside.
#[test]
fn cells_outside_have_no_probability() {
    let mut buffer = vec![0.0; PiecewiseConstant2d::buffer(3, 2)];
    let table = PiecewiseConstant2d::build(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 3, &mut buffer).unwrap();
    for far in [2, 3, 4, 1 << 24, u32::MAX] {
        assert_eq!(table.pmf::<f32>(1, far), 0.0, "row {far}");
        if far > 2 {
            assert_eq!(table.pmf::<f32>(far, 1), 0.0, "column {far}");
        }
    }
    assert!((table.pmf::<f32>(2, 1) - 6.0 / 21.0).abs() < 1e-6);
    for outside in [-1e-9, 1.0, 1.0 + step(2)] {
        let points = [Vec2::new(outside, 0.5), Vec2::new(0.5, outside)];
        assert_eq!(points.map(|p| table.pdf(p)), [0.0; 2], "{outside}");
    }
    let mut cdf = [0.0; 3];
    let line = PiecewiseConstant1d::build(&[1.0; 3], &mut cdf).unwrap();
    for past in [3, u32::MAX] {
        assert_eq!(line.pmf::<f32x4>(u32x4::splat(past)), f32x4::splat(0.0));
    }
}
