//! Point sets: that they are what they claim (nets, strata, lattices), at every width, and how much variance they save.

use etendue::sequence::{Independent, LatinHypercube, Lattice, OwenSobol, Sequence, Stratified, ZOrder};
use etendue::{Real, Uint, Vec2, f32x4, f32x8, f64x4, u32x4};
use etendue_tests::stats;
use etendue_tests::tolerances::SIGNIFICANCE;

fn point(sequence: &impl Sequence, pixel: u32, sample: u32, dimension: u32) -> [f64; 2] {
    let u: Vec2<f64> = sequence.pair(pixel, sample, dimension);
    [u.x, u.y]
}

/// Does every box of 2⁻ᵃ × 2ᵃ⁻ᵐ hold one of the 2ᵐ points? The first a where one does not.
fn failed_shape(points: &[[f64; 2]]) -> Option<u32> {
    let m = points.len().ilog2();
    assert_eq!(points.len(), 1 << m);
    (0..=m).find(|&a| {
        let mut seen = vec![false; points.len()];
        for [x, y] in points {
            let (column, row) = ((x * f64::from(1_u32 << a)) as usize, (y * f64::from(1_u32 << (m - a))) as usize);
            seen[column << (m - a) | row] = true;
        }
        seen.contains(&false)
    })
}

#[test]
fn owen_sobol_is_a_net() {
    for m in 0..=14 {
        for (scramble, pixel, dimension) in [(1, 0, 0), (1, 1, 0), (2, 12_345, 7), (3, u32::MAX, u32::MAX)] {
            let sobol = OwenSobol::new(scramble);
            // the first block, one amid 2¹⁶ samples, one past them, the last of all
            for first in [0, 3 << m, 65_536 + (5 << m), 0x8765_4000, u32::MAX - ((1 << m) - 1)] {
                let points: Vec<_> = (0..1 << m).map(|i| point(&sobol, pixel, first + i, dimension)).collect();
                assert_eq!(failed_shape(&points), None, "2^{m} points from {first}, pixel {pixel}");
            }
        }
    }
    // as fine as the grid of u lets one see: 2²⁰ points in one scramble
    let points: Vec<_> = (0..1 << 20).map(|i| point(&OwenSobol::new(9), 4, i, 2)).collect();
    assert_eq!(failed_shape(&points), None, "2^20 points");
}

#[test]
fn the_check_of_nets_can_fail() {
    for (name, points) in [
        ("independent", (0..16).map(|i| point(&Independent::new(1), 0, i, 0)).collect::<Vec<_>>()),
        ("jitter", (0..16).map(|i| point(&Stratified::new(1, 16), 0, i, 0)).collect()),
        ("latin", (0..16).map(|i| point(&LatinHypercube::new(1, 16), 0, i, 0)).collect()),
        ("unaligned", (2..18).map(|i| point(&OwenSobol::new(1), 0, i, 0)).collect()),
        ("two pixels", (0..16).map(|i| point(&OwenSobol::new(1), i / 8, i, 0)).collect()),
    ] {
        assert!(failed_shape(&points).is_some(), "{name}");
    }
}

#[test]
fn z_order_is_a_net_in_a_pixel_and_over_squares() {
    for samples in [1, 2, 3, 4, 8, 16, 32] {
        let z = ZOrder::new(5, samples);
        let held = z.samples();
        assert_eq!(held, samples.next_power_of_two());
        for dimension in [0, 1, 6] {
            for [x0, y0, side] in [[0, 0, 1], [3, 5, 1], [6, 4, 2], [24, 40, 8], [4096, 8192, 16]] {
                // in the first net of a pixel and in later ones
                for replicate in [0, 1, 1000] {
                    let mut points = Vec::new();
                    for y in y0..y0 + side {
                        for x in x0..x0 + side {
                            let pixel = ZOrder::pixel(x, y);
                            points.extend((0..held).map(|i| point(&z, pixel, replicate * held + i, dimension)));
                        }
                    }
                    assert_eq!(failed_shape(&points), None, "{samples} samples, {side}² pixels, dimension {dimension}");
                }
            }
        }
    }
    // 2³¹ samples in a pixel: no shift may be by 32
    let points: Vec<_> = (0..1024).map(|i| point(&ZOrder::new(5, u32::MAX), 7, (1 << 30) + i, 0)).collect();
    assert_eq!(failed_shape(&points), None);
    // and one, where all 32 bits are the pixel's
    let points: Vec<_> = (0..1024).map(|i| point(&ZOrder::new(5, 0), (1 << 31) + i, 0, 0)).collect();
    assert_eq!(failed_shape(&points), None);
}

/// The base-4 digits take all 24 orders, each equally often: with base 2 there would be 8.
#[test]
fn z_order_permutes_digits_in_every_way() {
    // with one sample a pixel the quarter of the net that each of four neighbours gets is told by its quarter of the square
    // only up to the scramble; the scramble is the same in all 2×2 blocks, so the orders of the blocks can be compared
    for samples in [1, 2] {
        let z = ZOrder::new(11, samples);
        let mut orders = std::collections::BTreeMap::new();
        for block in 0..24_000 {
            let quarter = |k| {
                let [x, y] = point(&z, block * 4 + k, 0, 3);
                // finest strata of the 2¹⁶ pixels' net are out of reach; the quarter within the block's own square is not
                (x, y)
            };
            let mut by_x: Vec<u32> = (0..4).collect();
            by_x.sort_by(|&a, &b| quarter(a).0.total_cmp(&quarter(b).0));
            *orders.entry(by_x).or_insert(0_u64) += 1;
        }
        assert_eq!(orders.len(), 24, "{orders:?}");
        let p = stats::uniform(&orders.into_values().collect::<Vec<_>>());
        assert!(p > SIGNIFICANCE, "p = {p}");
    }
}

#[test]
fn latin_hypercube_is_latin() {
    for count in [1, 2, 3, 7, 16, 60, 1000, 4096] {
        let latin = LatinHypercube::new(3, count);
        for (pixel, replicate, dimension) in [(0, 0, 0), (7, 5, 3), (u32::MAX, 1000, 9)] {
            for axis in 0..2 {
                let mut seen = vec![false; count as usize];
                for i in 0..count {
                    let u = point(&latin, pixel, replicate * count + i, dimension)[axis];
                    seen[(u * f64::from(count) + 1e-9) as usize] = true;
                }
                assert!(!seen.contains(&false), "{count} in pixel {pixel}");
            }
        }
    }
    // the axes are permuted apart
    let points: Vec<_> =
        (0..4096).map(|i| point(&LatinHypercube::new(3, 4096), 2, i, 0)).map(|[x, y]| (x, y)).collect();
    assert!(stats::correlation(&points).abs() < 5.0 / 64.0);
}

#[test]
fn lattice_is_exact_far_out() {
    let unit = 1.0 / 16_777_216.0;
    for lattice in [Lattice::r2(2), Lattice::fibonacci(2, 89)] {
        let at = |i| point(&lattice, 9, i, 0);
        let steps = [0, 1].map(|axis| at(1)[axis] - at(0)[axis]);
        for i in [1, 65_535, 65_536, 1 << 24, 0x7fff_ffff, 0xffff_fff0] {
            for axis in 0..2 {
                let off = at(i + 1)[axis] - at(i)[axis] - steps[axis];
                assert!((off - off.round()).abs() <= unit, "sample {i}: {off}");
            }
        }
    }
    // Fibonacci's lattice of 89: neighbours on the torus are at least 0.93 √(2/(√3·89))·… apart; a random set comes to about 1/89·½
    let points: Vec<_> = (0..89).map(|i| point(&Lattice::fibonacci(2, 89), 3, i, 0)).collect();
    let mut least = f64::INFINITY;
    for (i, a) in points.iter().enumerate() {
        for b in &points[..i] {
            let along = |k: usize| (a[k] - b[k]) - (a[k] - b[k]).round();
            least = least.min(along(0).hypot(along(1)));
        }
    }
    assert!(least * 89_f64.sqrt() > 0.93, "{}", least * 89_f64.sqrt());
    // R2: the same measure is at least ½ at every count
    let points: Vec<_> = (0..2000).map(|i| point(&Lattice::r2(2), 3, i, 0)).collect();
    for count in [10_usize, 50, 89, 500, 2000] {
        let mut least = f64::INFINITY;
        for (i, a) in points[..count].iter().enumerate() {
            for b in &points[..i] {
                let along = |k: usize| (a[k] - b[k]) - (a[k] - b[k]).round();
                least = least.min(along(0).hypot(along(1)));
            }
        }
        assert!(least * (count as f64).sqrt() > 0.5, "{count}: {}", least * (count as f64).sqrt());
    }
}

/// One sample of each of many pixels, seeds or dimensions: uniform, and independent of one another.
fn uniform_over(name: &str, sequence: impl Fn(u32) -> [f64; 2]) {
    const SIDE: usize = 32;
    let mut cells = vec![0_u64; SIDE * SIDE];
    let mut axes = [vec![0_u64; 4096], vec![0_u64; 4096]];
    let mut successive = Vec::new();
    let mut last = [0.0; 2];
    for i in 0..200_000 {
        let [x, y] = sequence(i);
        cells[(x * SIDE as f64) as usize * SIDE + (y * SIDE as f64) as usize] += 1;
        axes[0][(x * 4096.0) as usize] += 1;
        axes[1][(y * 4096.0) as usize] += 1;
        successive.extend([(x, y), (last[0], x), (last[1], y), (last[1], x)]);
        last = [x, y];
    }
    for p in [&cells, &axes[0], &axes[1]].map(|observed| stats::uniform(observed)) {
        assert!(p > SIGNIFICANCE, "{name}: p = {p}");
    }
    for k in 0..4 {
        let pairs: Vec<_> = successive.iter().copied().skip(k).step_by(4).collect();
        let p = stats::two_sided(stats::correlation(&pairs) * (pairs.len() as f64).sqrt());
        assert!(p > SIGNIFICANCE, "{name}: correlation {k}, p = {p}");
    }
}

#[test]
fn each_point_is_uniform_over_pixels_dimensions_and_seeds() {
    let (sobol, latin, r2) = (OwenSobol::new(1), LatinHypercube::new(1, 48), Lattice::r2(1));
    for sample in [0, 1, 5, 70_000] {
        uniform_over("sobol, pixels", |i| point(&sobol, i, sample, 0));
        uniform_over("sobol, dimensions", |i| point(&sobol, 3, sample, i));
        uniform_over("sobol, seeds", |i| point(&OwenSobol::new(u64::from(i)), 3, sample, 1));
    }
    uniform_over("latin, pixels", |i| point(&latin, i, 5, 0));
    uniform_over("latin, dimensions", |i| point(&latin, 3, 5, i));
    uniform_over("lattice, pixels", |i| point(&r2, i, 5, 0));
    uniform_over("lattice, dimensions", |i| point(&r2, 3, 5, i));
    uniform_over("z-order, seeds", |i| point(&ZOrder::new(u64::from(i), 4), 1000, 3, 1));
    uniform_over("z-order, dimensions", |i| point(&ZOrder::new(1, 4), 1000, 3, i));
    uniform_over("z-order, tiles", |i| point(&ZOrder::new(1, 1 << 31), 2 * i, 3, 0));
}

/// Rank among the permutations of four of the one that takes the order of x in one dimension to that in another.
fn association(sequence: &impl Sequence, pixel: u32, dimensions: [u32; 2]) -> usize {
    let order = |dimension| {
        let x = [0, 1, 2, 3].map(|sample| point(sequence, pixel, sample, dimension)[0]);
        let mut order = [0, 1, 2, 3];
        order.sort_by(|&a, &b| x[a].total_cmp(&x[b]));
        order
    };
    let (a, b) = (order(dimensions[0]), order(dimensions[1]));
    let mut map = [0; 4];
    for k in 0..4 {
        map[a[k]] = b[k];
    }
    (0..4).fold(0, |rank, k| rank * (4 - k) + map[k + 1..].iter().filter(|m| **m < map[k]).count())
}

#[test]
fn dimensions_are_padded_at_random() {
    fn orders(sequence: &impl Sequence) -> Vec<u64> {
        let mut counts = vec![0; 24];
        for pixel in 0..60_000 {
            counts[association(sequence, pixel, [1, 2])] += 1;
        }
        counts
    }
    let latin = orders(&LatinHypercube::new(1, 4));
    assert!(stats::uniform(&latin) > SIGNIFICANCE, "{latin:?}");
    // a nested shuffle keeps pairs of samples together: samples 0 and 1 are in opposite halves in both dimensions
    let sobol = orders(&OwenSobol::new(1));
    let kept: Vec<u64> = sobol.iter().copied().filter(|&n| n > 0).collect();
    println!("{sobol:?}");
    assert!(kept.len() >= 16, "{sobol:?}");
    assert!(stats::uniform(&orders(&Lattice::r2(1))) < SIGNIFICANCE, "24 orders of a lattice of four are not alike");
}

/// Variance of the mean of `n` samples: mean square error over pixels and dimensions, f over integral.
fn variance(sequence: &impl Sequence, n: u32, trials: u32, f: impl Fn([f64; 2], u32) -> f64) -> f64 {
    (0..trials)
        .map(|trial| {
            let mean = (0..n).map(|i| f(point(sequence, trial, i, 1), trial)).sum::<f64>() / f64::from(n);
            mean * mean
        })
        .sum::<f64>()
        / f64::from(trials)
}

/// Owen's scrambling as it is defined: a random bit for each prefix, here of Sobol's points from their matrices.
struct TrueOwen {
    seed: u64,
}

impl TrueOwen {
    fn coordinate(&self, value: u32, pixel: u32, axis: u32) -> f64 {
        let mut result = 0;
        for bit in 0..24 {
            let prefix = if bit == 0 { 0 } else { value >> (32 - bit) };
            let [word, ..] = Independent::new(self.seed ^ 0x1234).words(pixel, prefix, bit << 1 | axis);
            result |= ((value >> (31 - bit)) ^ (word >> 31)) << 31 >> bit;
        }
        f64::from(result >> 8) / 16_777_216.0
    }
    fn point(&self, pixel: u32, index: u32) -> [f64; 2] {
        let mut second = 0;
        let mut column = 0x8000_0000_u32;
        for bit in 0..32 {
            if index >> bit & 1 == 1 {
                second ^= column;
            }
            column ^= column >> 1;
        }
        [self.coordinate(index.reverse_bits(), pixel, 0), self.coordinate(second, pixel, 1)]
    }
}

impl Sequence for TrueOwen {
    fn pair<R: Real>(&self, pixel: R::Uint, sample: R::Uint, _: u32) -> Vec2<R> {
        let [x, y] = [0, 1].map(|axis| {
            let at = |i| (self.point(pixel.lane(i), sample.lane(i))[axis] * 4_294_967_296.0) as u32;
            R::unit(R::Uint::from_fn(at))
        });
        Vec2::new(x, y)
    }
}

/// How many times less variance than independent samples have, of f = xy − ¼ and of a straight edge.
fn gains(sequence: &impl Sequence, n: u32, trials: u32) -> [f64; 2] {
    // Var xy = 1/9 − 1/16
    let smooth = 7.0 / 144.0 / f64::from(n) / variance(sequence, n, trials, |[x, y], _| x * y - 0.25);
    // half-planes through the centre of the square, at any angle: half of it each
    let edge = variance(sequence, n, trials, |[x, y], trial| {
        let (s, c) = (f64::from(trial) * 2.399_963_2).sin_cos();
        if (x - 0.5) * c + (y - 0.5) * s > 0.0 { 0.5 } else { -0.5 }
    });
    [smooth, 0.25 / f64::from(n) / edge]
}

#[test]
fn variance_against_independent_samples() {
    const TRIALS: u32 = 20_000;
    for n in [16, 64] {
        println!("{n} owen sobol {:?}", gains(&OwenSobol::new(1), n, TRIALS));
        println!("{n} true owen {:?}", gains(&TrueOwen { seed: 1 }, n, TRIALS / 4));
        println!("{n} jitter {:?}", gains(&Stratified::new(1, n), n, TRIALS));
        println!("{n} latin {:?}", gains(&LatinHypercube::new(1, n), n, TRIALS));
        println!("{n} r2 {:?}", gains(&Lattice::r2(1), n, TRIALS));
        println!("{n} fibonacci {:?}", gains(&Lattice::fibonacci(1, n), n, TRIALS));
        println!("{n} z-order {:?}", gains(&ZOrder::new(1, n), n, TRIALS));
        println!("{n} independent {:?}", gains(&Independent::new(1), n, TRIALS));
    }
}

#[test]
fn packets_are_scalars() {
    fn check(name: &str, sequence: &impl Sequence) {
        for start in [0, 1, 65_535, 1 << 24, 0x7fff_fff0, u32::MAX - 8] {
            for dimension in [0, 1, 5, u32::MAX] {
                let pixels = |k: usize| start.wrapping_add(k as u32 * 977);
                let samples = |k: usize| (start / 2).wrapping_add(k as u32 * 3);
                let eight: Vec2<f32x8> = sequence.pair(Uint::from_fn(pixels), Uint::from_fn(samples), dimension);
                let four: Vec2<f32x4> = sequence.pair(Uint::from_fn(pixels), Uint::from_fn(samples), dimension);
                let double: Vec2<f64x4> = sequence.pair(u32x4::from_fn(pixels), u32x4::from_fn(samples), dimension);
                for k in 0..8 {
                    let one: Vec2<f32> = sequence.pair(pixels(k), samples(k), dimension);
                    assert!((0.0..1.0).contains(&one.x) && (0.0..1.0).contains(&one.y), "{name}: {one:?}");
                    assert_eq!(eight.lane(k), one, "{name}, lane {k}");
                    let wide: Vec2<f64> = sequence.pair(pixels(k), samples(k), dimension);
                    assert!((wide.x - f64::from(one.x)).abs() < 2.4e-7, "{name}: {one:?} {wide:?}");
                    if k < 4 {
                        assert_eq!(four.lane(k), one, "{name}, lane {k} of 4");
                        assert_eq!(double.lane(k), wide, "{name}, lane {k} in f64");
                    }
                }
            }
        }
    }
    check("owen sobol", &OwenSobol::new(3));
    check("lattice", &Lattice::r2(3));
    for count in [0, 1, 2, 7, 64, 100, 4096, u32::MAX] {
        check("latin", &LatinHypercube::new(3, count));
        check("z-order", &ZOrder::new(3, count));
        check("fibonacci", &Lattice::fibonacci(3, count));
    }
}

#[test]
fn bits_are_reversed_at_every_width() {
    let value = |k: usize| (k as u32 + 1).wrapping_mul(0x9e37_79b1);
    for k in 0..8 {
        assert_eq!(etendue::u32x8::from_fn(value).reverse_bits().lane(k), value(k).reverse_bits());
    }
    for k in 0..4 {
        assert_eq!(u32x4::from_fn(value).reverse_bits().lane(k), value(k).reverse_bits());
    }
}
