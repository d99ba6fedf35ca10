//! Quadrature and a root finder.

use core::f64::consts::PI;

/// Gauss–Legendre nodes and weights on [0, 1].
#[must_use]
pub fn gauss_legendre<const N: usize>() -> [(f64, f64); N] {
    core::array::from_fn(|i| {
        let n = N as f64;
        let mut x = (PI * (i as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..50 {
            let (mut p, mut last) = (x, 1.0);
            for k in 2..=N {
                let k = k as f64;
                (p, last) = (((2.0 * k - 1.0) * x * p - (k - 1.0) * last) / k, p);
            }
            slope = n * (x * p - last) / (x * x - 1.0);
            x -= p / slope;
            if (p / slope).abs() < 1e-17 {
                break;
            }
        }
        (0.5 + 0.5 * x, 1.0 / ((1.0 - x * x) * slope * slope))
    })
}

/// ∫ f over the rectangle [low, high], split until a split changes the sum by less than `tolerance` times the first estimate (at most 20
/// times).
pub fn integrate(f: &mut dyn FnMut(f64, f64) -> f64, low: [f64; 2], high: [f64; 2], tolerance: f64) -> f64 {
    let nodes = gauss_legendre::<8>();
    let whole = tensor(f, &nodes, low, high);
    refine(f, &nodes, low, high, whole, tolerance * whole.abs(), 20)
}

fn tensor(f: &mut dyn FnMut(f64, f64) -> f64, nodes: &[(f64, f64); 8], low: [f64; 2], high: [f64; 2]) -> f64 {
    let (dx, dy) = (high[0] - low[0], high[1] - low[1]);
    let mut sum = 0.0;
    for &(x, wx) in nodes {
        for &(y, wy) in nodes {
            sum += wx * wy * f(low[0] + dx * x, low[1] + dy * y);
        }
    }
    sum * dx * dy
}

fn refine(
    f: &mut dyn FnMut(f64, f64) -> f64,
    nodes: &[(f64, f64); 8],
    low: [f64; 2],
    high: [f64; 2],
    whole: f64,
    tolerance: f64,
    depth: u32,
) -> f64 {
    let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
    let corners = |i: usize| {
        let pick = |k: usize| if i >> k & 1 == 0 { (low[k], middle[k]) } else { (middle[k], high[k]) };
        let (x, y) = (pick(0), pick(1));
        ([x.0, y.0], [x.1, y.1])
    };
    let parts: [f64; 4] = core::array::from_fn(|i| tensor(f, nodes, corners(i).0, corners(i).1));
    let sum: f64 = parts.iter().sum();
    // a sum that is not finite does not become so
    if depth == 0 || (sum - whole).abs() <= tolerance || !sum.is_finite() {
        return sum;
    }
    (0..4).map(|i| refine(f, nodes, corners(i).0, corners(i).1, parts[i], tolerance, depth - 1)).sum()
}

/// ∫ f from `low` to `high` by one Gauss–Legendre rule.
pub(crate) fn integral(nodes: &[(f64, f64); 16], low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    (high - low) * nodes.iter().map(|&(x, weight)| weight * f(low + (high - low) * x)).sum::<f64>()
}

/// Solves f(x) = `target` for an increasing f with f(0) = 0 and f(`end`) = `top`, by false position (Illinois), with bisection if that is
/// slow.
pub(crate) fn root(end: f64, top: f64, target: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, end);
    let (mut f_low, mut f_high) = (-target, top - target);
    if f_high <= 0.0 {
        return end;
    }
    for step in 0..80 {
        let width = high - low;
        let x = if step % 4 == 3 { low + 0.5 * width } else { low + width * (f_low / (f_low - f_high)) };
        let value = f(x) - target;
        if value.abs() <= 1e-15 * target || width <= 1e-15 * high {
            return x;
        }
        if value < 0.0 {
            (low, f_low) = (x, value);
            f_high *= 0.5;
        } else {
            (high, f_high) = (x, value);
            f_low *= 0.5;
        }
    }
    0.5 * (low + high)
}
