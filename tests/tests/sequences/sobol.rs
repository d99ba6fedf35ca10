//! What Sobol's points in two dimensions are worth, and how pixels and dimensions share them.

use super::nets::position;
use super::point;
use etendue::sequence::{Independent, OwenSobol, Sequence, Stratified, ZOrder};
use etendue::{Real, Uint, Vec2};
use etendue_judge::generators::AlongCurve;
use etendue_judge::stats;
use etendue_judge::tolerances::SIGNIFICANCE;
use etendue_oracle::tier::cases;

/// The base-4 digits take all 24 orders, nearly equally often; nested permutations in base 2 would only take 8.
#[test]
fn z_order_permutes_digits_in_every_way() {
    for samples in [1, 2, 4] {
        let z = AlongCurve(ZOrder::new(11, samples));
        let mut orders = std::collections::BTreeMap::new();
        for block in 0..24_000 {
            // one sample of each of four neighbours: with one sample per pixel, the quarter that contains it was the last digit of its
            // index, and the scramble of the leading bits is the same for all four
            let x = [0, 1, 2, 3].map(|k| point(&z, block * 4 + k, 0, 3)[0]);
            let mut order = [0, 1, 2, 3];
            order.sort_by(|&a, &b| x[a].total_cmp(&x[b]));
            *orders.entry(order).or_insert(0_u64) += 1;
        }
        println!("{samples}: {:?}", orders.values().collect::<Vec<_>>());
        assert_eq!(orders.len(), 24, "{orders:?}");
        if samples == 1 {
            // 0.344/8 and 0.656/16 instead of 1/24: 1031 and 984; the bounds are five standard deviations beyond
            assert!(orders.values().all(|n| (826..1190).contains(n)), "{orders:?}");
        }
    }
}

/// Power of the errors in an image of 64 × 64 pixels at frequencies below an eighth of the sampling rate, relative to the power at all
/// frequencies: 1 if the errors of neighbours are independent.
fn low_frequencies(sequence: impl Fn(u64) -> Box<dyn Fn([u32; 2], u32) -> [f64; 2]>, f: fn([f64; 2]) -> f64) -> f64 {
    const SIDE: usize = 64;
    const SAMPLES: u32 = 4;
    let (mut low, mut count, mut all) = (0.0, 0, 0.0);
    for seed in 0..32 {
        let point = sequence(seed);
        let mut errors = vec![[0.0; SIDE]; SIDE];
        for (y, row) in errors.iter_mut().enumerate() {
            for (x, error) in row.iter_mut().enumerate() {
                *error = (0..SAMPLES).map(|i| f(point([x as u32, y as u32], i))).sum::<f64>() / f64::from(SAMPLES);
            }
        }
        let mean = errors.as_flattened().iter().sum::<f64>() / (SIDE * SIDE) as f64;
        let wave = |k: usize, i: usize| (core::f64::consts::TAU * (k * i % SIDE) as f64 / SIDE as f64).sin_cos();
        // Fourier transform along the rows, then along the columns
        for kx in 0..SIDE {
            let rows: Vec<[f64; 2]> = errors
                .iter()
                .map(|row| {
                    row.iter().enumerate().fold([0.0; 2], |[re, im], (x, e)| {
                        let (s, c) = wave(kx, x);
                        [re + (e - mean) * c, im - (e - mean) * s]
                    })
                })
                .collect();
            for ky in 0..SIDE {
                let [re, im] = rows.iter().enumerate().fold([0.0; 2], |[re, im], (y, [a, b])| {
                    let (s, c) = wave(ky, y);
                    [re + a * c + b * s, im + b * c - a * s]
                });
                let power = re * re + im * im;
                all += power / (SIDE * SIDE) as f64;
                let frequency = |k: usize| k.min(SIDE - k) as f64;
                if (1.0..=8.0).contains(&frequency(kx).hypot(frequency(ky))) {
                    low += power;
                    count += 1;
                }
            }
        }
    }
    low / (all * f64::from(count) / 32.0)
}

/// Errors of neighbours cancel, which leaves blue noise; the same points assigned to pixels independently leave white noise.
#[test]
fn blue_noise_of_z_order() {
    let smooth = |[x, y]: [f64; 2]| (-3.0 * (x * x + y)).exp();
    let edge = |[x, y]: [f64; 2]| f64::from(u8::from(0.6 * x + 0.8 * y < 0.6));
    for (name, f, most) in [("smooth", smooth as fn(_) -> _, 0.15), ("edge", edge, 0.45)] {
        let blue = low_frequencies(
            |seed| {
                let z = AlongCurve(ZOrder::new(seed, 4));
                Box::new(move |[x, y], i| point(&z, position(x, y), i, 0))
            },
            f,
        );
        let white = low_frequencies(
            |seed| {
                let sobol = OwenSobol::new(seed);
                Box::new(move |[x, y], i| point(&sobol, x + 64 * y, i, 0))
            },
            f,
        );
        println!("power at low frequencies, {name}: Z-order {blue:.4}, independent pixels {white:.4}");
        // 32 images of 196 frequencies: a standard error of 1.3 %
        assert!((white - 1.0).abs() < 0.06 && blue < most, "{name}: {blue} {white}");
    }
}

/// Rank, among the 24 permutations of four, of the one from the order of x in one dimension to that in the other.
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
    let strata = orders(&Stratified::new(1, 4));
    assert!(stats::uniform(&strata) > SIGNIFICANCE, "{strata:?}");
    let sobol = orders(&OwenSobol::new(1));
    // a nested shuffle keeps (0, 1) and (2, 3) together, the order along x keeps (0, 2) and (1, 3): any of 8 permutations, then any of 8
    // others
    let kept = [0, 1, 6, 7, 16, 17, 22, 23];
    let expected: Vec<f64> = (0..24).map(|rank| if kept.contains(&rank) { 3750.0 } else { 1875.0 }).collect();
    let p = stats::chi_square(&sobol, &expected);
    assert!(p > SIGNIFICANCE, "p = {p}: {sobol:?}");
}

/// Owen scrambling by definition, with a random bit for each prefix, applied to Sobol points from the generator matrices.
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

/// The half-plane c·x + s·y < d through a random point of the square at a random angle.
struct HalfPlane {
    c: f64,
    s: f64,
    d: f64,
    area: f64,
    flip: bool,
}

impl HalfPlane {
    fn new(trial: u32) -> Self {
        let [a, x] = point(&Independent::new(77), trial, 0, 0);
        let [y, flip] = point(&Independent::new(77), trial, 0, 1);
        let (s, c) = (a * std::f64::consts::FRAC_PI_2 + 1e-9).sin_cos();
        let d = c * x + s * y;
        let half_square = |d: f64| 0.5 * d.max(0.0).powi(2);
        let area = (half_square(d) - half_square(d - c) - half_square(d - s) + half_square(d - c - s)) / (c * s);
        Self { c, s, d, area, flip: flip < 0.5 }
    }
    fn value(&self, [x, y]: [f64; 2]) -> f64 {
        let x = if self.flip { 1.0 - x } else { x };
        f64::from(u8::from(self.c * x + self.s * y < self.d)) - self.area
    }
}

/// Factor by which the variance of exp(x + y) and of straight edges is below that of independent samples, each with its standard error.
fn gains(sequence: &impl Sequence, n: u32) -> [[f64; 2]; 2] {
    let trials: u32 = cases(2500, 20_000);
    let integral = (std::f64::consts::E - 1.0).powi(2);
    let square = ((1.0_f64.exp().powi(2) - 1.0) / 2.0).powi(2);
    let mut squares = [Vec::new(), Vec::new()];
    let mut random = [square - integral * integral, 0.0];
    for trial in 0..trials {
        let plane = HalfPlane::new(trial);
        let (mut smooth, mut edge) = (0.0, 0.0);
        for i in 0..n {
            let u = point(sequence, trial, i, 1);
            smooth += (u[0] + u[1]).exp() - integral;
            edge += plane.value(u);
        }
        squares[0].push((smooth / f64::from(n)).powi(2));
        squares[1].push((edge / f64::from(n)).powi(2));
        random[1] += plane.area * (1.0 - plane.area) / f64::from(trials);
    }
    [0, 1].map(|k| {
        let (mean, variance) = stats::mean_variance(&squares[k]);
        let gain = random[k] / f64::from(n) / mean;
        [gain, gain * (variance / f64::from(trials)).sqrt() / mean]
    })
}

/// Asserts that a gain is the known one, within five standard errors and half a unit of its last digit.
fn gain_is([gain, error]: [f64; 2], known: f64, half_unit: f64) {
    assert!((gain - known).abs() < 5.0 * error + half_unit, "{gain} ± {error}, expected {known}");
}

#[test]
fn variance_against_independent_samples() {
    let table = [16, 64].map(|n| {
        [
            gains(&Independent::new(1), n),
            gains(&Stratified::new(1, n), n),
            gains(&OwenSobol::new(1), n),
            gains(&TrueOwen { seed: 1 }, n),
            gains(&AlongCurve(ZOrder::new(1, n)), n),
        ]
    });
    for (n, row) in [16, 64].iter().zip(&table) {
        for (name, gain) in ["independent", "jitter", "owen sobol", "true owen", "z-order"].iter().zip(row) {
            println!("{n} {name:12} smooth {:.4?} edge {:.4?}", gain[0], gain[1]);
        }
    }
    let [sixteen, sixty_four] = table;
    for row in [sixteen, sixty_four] {
        gain_is(row[0][0], 1.0, 0.0);
        gain_is(row[0][1], 1.0, 0.0);
        // the hash scrambles as well as an independent random bit for each prefix
        for (hashed, exact) in row[2].iter().zip(row[3]) {
            gain_is([hashed[0], hashed[1].hypot(exact[1])], exact[0], 0.0);
        }
    }
    gain_is(sixteen[1][0], 14.0, 0.5);
    gain_is(sixty_four[1][0], 56.0, 0.5);
    gain_is(sixteen[1][1], 4.3, 0.05);
    gain_is(sixty_four[1][1], 8.7, 0.05);
    gain_is(sixteen[2][1], 6.1, 0.05);
    gain_is(sixty_four[2][1], 12.3, 0.05);
    gain_is(sixteen[2][0], 126.0, 0.5);
    gain_is(sixty_four[2][0], 1630.0, 5.0);
}
