//! What padding costs: pairs of dimensions associated at random, against points that are well distributed in all dimensions at once.
//!
//! An integrand of two pairs is f = μ + f₁(x) + f₂(y) + f₁₂(x, y), each part with mean 0 over any of its arguments, of variances σ₁², σ₂²,
//! σ₁₂². The parts' errors are uncorrelated (a scrambled or jittered point alone is uniform), so the variance of the mean of N samples is
//! the sum of theirs. Here f₁ = g(x₀), f₂ = g(y₀), f₁₂ = g(x₀)g(y₀) with g(u) = √12 (u − ½): mean 0, variance 1.
//!
//! | | variance of g(x₀): V | of the product g(x₀)g(y₀) |
//! |---|---|---|
//! | independent | 1/N | 1/N |
//! | padded strata, k × k = N | 1/N² | V² + (1 − V)²/(N − 1) |
//! | joint strata, n⁴ = N | 1/(n²N) | (1 − (1 − 1/n²)²)/N |
//! | padded Owen–Sobol, N = 2ᵐ | 1/N³ | V² + (49/31)(1 − 32⁻ᵐ)/N |
//! | joint Owen–Sobol | 1/N³ | Σ Γ(k, l) σ²(k, l)/N |
//!
//! *Strata.* A cell of width w holds the fraction w² of g's variance, and Var = Σ Var(cell)/N². Random association: for values a_i, b_i and
//! a uniform permutation π, E[(Σ a_i b_π(i))²] = N·M_a·M_b + N(N−1)·P_a·P_b, with M the mean square and P the mean product of two different
//! values, E[P] = (N V − 1)/(N − 1). More pairs give more factors.
//!
//! *Padded Sobol.* The association is a nested shuffle, uniform over the automorphisms of the binary tree of the indices. The 2^(m−1−b)
//! differences between the halves of the blocks of 2ᵇ⁺¹ indices are an irreducible representation of that group. So the mean of the
//! products has the variance V² + Σ_b S_b²/(N²·2^(m−1−b)), where S_b is the expected sum of squares of g in these differences. The halves
//! of such a block differ in digit b of x, in each of its 2ᵇ prefixes by an independent sign: D = (u − u')/2 with u, u' uniform in halves
//! of width w = 2⁻ᵇ⁻¹, E[D²] = w²(1 + 2/12)/4; the mean of 2ᵇ of these squared, times 12 N, is S_b = (7/8) N 8⁻ᵇ. (All S_b and N V add up
//! to N.) So a product is sampled worse than by independent numbers, by a factor of 49/31 = 1.58.
//!
//! *Joint Sobol.* Owen, "Monte Carlo Variance of Scrambled Net Quadrature", SIAM J. Numer. Anal. 34, 1997: σ²(k, l) is the variance of the
//! part of f in digits k and l; the gain Γ = (1/N) Σ_ij Π_d (2·[i, j agree in k_d + 1 digits of dimension d] − [in k_d]) depends on the net
//! alone. Digit k of g has the variance ¾·4⁻ᵏ.

use etendue::Vec2;
use etendue::sequence::{Independent, JointSobol, OwenSobol, Sequence, Stratified};
use etendue_oracle::tier::cases;

/// An integrand of mean 0 and variance 1.
fn g(u: f64) -> f64 {
    12.0_f64.sqrt() * (u - 0.5)
}

/// g of one coordinate of each pair.
fn point<const PAIRS: usize>(sequence: &impl Sequence, pixel: u32, sample: u32) -> [f64; PAIRS] {
    std::array::from_fn(|dimension| {
        let u: Vec2<f64> = sequence.pair(pixel, sample, dimension as u32);
        g(u.x)
    })
}

/// Means that a variance is measured from.
fn replicates() -> u32 {
    cases(1500, 10_000)
}

/// Mean square over pixels of the mean of `n` samples of `f`, whose integral is 0, with its standard error.
fn measured<const PAIRS: usize>(sequence: &impl Sequence, n: u32, f: impl Fn([f64; PAIRS]) -> f64) -> [f64; 2] {
    let squares: Vec<f64> = (0..replicates())
        .map(|pixel| ((0..n).map(|i| f(point(sequence, pixel, i))).sum::<f64>() / f64::from(n)).powi(2))
        .collect();
    let (mean, variance) = etendue_judge::stats::mean_variance(&squares);
    [mean, (variance / f64::from(replicates())).sqrt()]
}

/// Theoretical variances of g(x₀), of g(x₀)g(y₀), and of g(x₀)g(y₀)g(z₀).
#[derive(Clone, Copy, Debug)]
struct Theory {
    one: f64,
    two: f64,
    three: Option<f64>,
}

/// Compares measured variances with theory: of a sum, which does not couple the pairs, of a product, which does nothing else, and of both
/// together.
fn check(name: &str, sequence: &impl Sequence, n: u32, theory: Theory) {
    let sum = measured(sequence, n, |[x, y]: [f64; 2]| x + y);
    let product = measured(sequence, n, |[x, y]: [f64; 2]| x * y);
    let both = measured(sequence, n, |[x, y]: [f64; 2]| 0.5 * x + 2.0 * y + 3.0 * x * y);
    let Theory { one, two, three } = theory;
    let mut all = vec![("sum", sum, 2.0 * one), ("product", product, two), ("both", both, 4.25 * one + 9.0 * two)];
    if let Some(three) = three {
        all.push(("triple", measured(sequence, n, |[x, y, z]: [f64; 3]| x * y * z), three));
    }
    for (what, [value, error], truth) in all {
        let z = (value - truth) / error;
        println!("{name:20} N = {n:3}, {what:8}: {value:.4e}, expected {truth:.4e}, z = {z:+.2}");
        assert!(z.abs() < 5.0, "{name}, {n} samples, {what}: {value:e} ± {error:e}, expected {truth:e}");
        // small enough for the test to detect a deviation of a tenth
        assert!(
            error < cases(0.08, 0.02) * truth,
            "{name}, {n} samples, {what}: the error {error:e} is too large to judge {truth:e}"
        );
    }
}

/// Variance of a product of `pairs` randomly associated values whose means have the variance `v`.
fn associated_at_random(n: f64, v: f64, pairs: i32) -> f64 {
    (1.0 + (n - 1.0) * ((n * v - 1.0) / (n - 1.0)).powi(pairs)) / n
}

#[test]
fn independent_pairs() {
    for n in [16, 64] {
        let one = 1.0 / f64::from(n);
        check("independent", &Independent::new(1), n, Theory { one, two: one, three: Some(one) });
    }
}

#[test]
fn padded_strata() {
    for n in [16, 64, 256] {
        let m = f64::from(n);
        let one = m.powi(-2);
        let two = associated_at_random(m, one, 2);
        assert!((two / (one * one + (1.0 - one).powi(2) / (m - 1.0)) - 1.0).abs() < 1e-12);
        let three = Some(associated_at_random(m, one, 3));
        check("padded strata", &Stratified::new(1, n), n, Theory { one, two, three });
    }
}

#[test]
fn padded_sobol() {
    for m in [2, 4, 6, 8] {
        let n = f64::from(1_u32 << m);
        let one = n.powi(-3);
        // the sum over the levels of the tree, compared with its closed form
        let energy = |b: i32| 7.0 / 8.0 * n * 8.0_f64.powi(-b);
        let levels: f64 = (0..m).map(|b| energy(b).powi(2) / (n * n * 2.0_f64.powi(m - 1 - b))).sum();
        assert!(((0..m).map(energy).sum::<f64>() / n + one - 1.0).abs() < 1e-12);
        assert!((levels / (49.0 / 31.0 * (1.0 - 32.0_f64.powi(-m)) / n) - 1.0).abs() < 1e-12);
        check("padded sobol", &OwenSobol::new(1), 1 << m, Theory { one, two: one * one + levels, three: None });
    }
}

/// Owen's gain Γ for digits `k` of the first coordinates of pairs 0, 1, ….
fn gain<const PAIRS: usize>(points: &[[f64; PAIRS]], k: [u32; PAIRS]) -> f64 {
    let agree = |a: f64, b: f64, digits: u32| {
        let cell = |u: f64| (u * f64::from(1_u32 << digits)) as u32;
        f64::from(u8::from(cell(a) == cell(b)))
    };
    let mut sum = 0.0;
    for a in points {
        for b in points {
            let factor = |d: usize| 2.0 * agree(a[d], b[d], k[d] + 1) - agree(a[d], b[d], k[d]);
            sum += (0..PAIRS).map(factor).product::<f64>();
        }
    }
    sum / points.len() as f64
}

#[test]
fn joint_sobol() {
    for m in [4, 6, 8] {
        let n = f64::from(1_u32 << m);
        let first = |i: u32| -> [f64; 3] { std::array::from_fn(|d| JointSobol::new(9).pair::<f64>(0, i, d as u32).x) };
        let points: Vec<[f64; 3]> = (0..1 << m).map(first).collect();
        let pairs: Vec<[f64; 2]> = points.iter().map(|p| [p[0], p[1]]).collect();
        let digit = |k: u32| 0.75 * 0.25_f64.powi(k as i32);
        // for digits beyond those that the net resolves, the gain is 1
        let (mut two, mut three, mut known) = (0.0, 0.0, [0.0; 2]);
        for k in 0..m {
            for l in 0..m {
                let share = digit(k) * digit(l);
                two += gain(&pairs, [k, l]) * share;
                known[0] += share;
                // three dimensions at 256 points would take 2²⁵ comparisons for each gain
                for j in (0..m).take_while(|_| m < 8) {
                    three += gain(&points, [k, l, j]) * share * digit(j);
                    known[1] += share * digit(j);
                }
            }
        }
        let variance = |sum: f64, known: f64| (sum + 1.0 - known) / n;
        let three = (m < 8).then(|| variance(three, known[1]));
        let theory = Theory { one: n.powi(-3), two: variance(two, known[0]), three };
        println!("{m}: {theory:?}");
        check("joint sobol", &JointSobol::new(1), 1 << m, theory);
    }
}

/// The recommendation in the table: padding wins on sums, joint points on products.
#[test]
fn padding_wins_on_sums_joint_points_on_products() {
    let n = 256;
    let [sum, product] = [|[x, y]: [f64; 2]| x + y, |[x, y]: [f64; 2]| x * y];
    let of = |f: fn([f64; 2]) -> f64| {
        [
            measured(&Stratified::new(1, n), n, f)[0],
            measured(&OwenSobol::new(1), n, f)[0],
            measured(&JointSobol::new(1), n, f)[0],
        ]
    };
    let [padded, padded_sobol, joint_sobol] = of(sum);
    assert!(padded > 100.0 * padded_sobol && joint_sobol < 1.1 * padded_sobol);
    let [padded, padded_sobol, joint_sobol] = of(product);
    assert!(padded_sobol > 1.5 * padded && padded > 80.0 * joint_sobol);
}
