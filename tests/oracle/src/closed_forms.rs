//! Truth: closed forms, quadrature and double-double arithmetic. Nothing here calls the code under test.

use crate::double_double::{Dd, Dd3, determinant, dot as dd_dot};
use core::f64::consts::{FRAC_PI_2, PI};

/// A vector in f64.
pub type V3 = [f64; 3];

/// Dot product.
#[must_use]
pub fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
/// Cross product.
#[must_use]
pub fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
/// `a + b·s`.
#[must_use]
pub fn along(a: V3, b: V3, s: f64) -> V3 {
    [a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s]
}
/// `a − b`.
#[must_use]
pub fn sub(a: V3, b: V3) -> V3 {
    along(a, b, -1.0)
}
/// Length, without overflow or underflow.
#[must_use]
pub fn length(a: V3) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}
/// Unit vector; the zero vector stays zero.
#[must_use]
pub fn unit(a: V3) -> V3 {
    let l = length(a);
    if l > 0.0 { a.map(|x| x / l) } else { a }
}
/// Converts f32 to f64.
#[must_use]
pub fn wide(a: [f32; 3]) -> V3 {
    a.map(f64::from)
}
/// Two unit vectors perpendicular to the unit vector `n`.
#[must_use]
pub fn basis(n: V3) -> (V3, V3) {
    let helper = if n[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let s = unit(cross(helper, n));
    (s, cross(n, s))
}

/// Solid angle of a triangle by Van Oosterom and Strackee's formula on the vertices, in 106 bits: accurate to 1e−13 for shapes down to 1e−9
/// of the distance.
#[must_use]
pub fn triangle_solid_angle(v: [Dd3; 3]) -> f64 {
    let [l0, l1, l2] = v.map(|v| dd_dot(v, v).sqrt());
    let numerator = determinant(v[0], v[1], v[2]).abs();
    let denominator = l0 * l1 * l2 + dd_dot(v[0], v[1]) * l2 + dd_dot(v[0], v[2]) * l1 + dd_dot(v[1], v[2]) * l0;
    2.0 * numerator.to_f64().atan2(denominator.to_f64())
}

/// `v + Σ eᵢ`, unrounded.
#[must_use]
pub fn sum_dw(v: V3, e: &[V3]) -> Dd3 {
    core::array::from_fn(|i| e.iter().fold(Dd::from(v[i]), |sum, e| sum + Dd::from(e[i])))
}

/// 1 − cosσ and the half-angle σ of a sphere, by the half-angle formula from an arc tangent.
#[must_use]
pub fn cap(center: V3, radius: f64) -> (f64, f64) {
    let square = |x: f64| Dd::from(x) * Dd::from(x);
    let power = (square(center[0]) + square(center[1]) + square(center[2]) - square(radius)).to_f64();
    if power < 0.0 {
        return (2.0, PI);
    }
    let sigma = radius.atan2(power.sqrt());
    (2.0 * (sigma / 2.0).sin().powi(2), sigma)
}

/// Projected solid angle of a cap of half-angle σ ≤ π/2 whose axis is at the angle ω to the normal: above, across or below the horizon.
#[must_use]
pub fn projected_cap(sigma: f64, omega: f64) -> f64 {
    let (s, c, cos) = (sigma.sin(), sigma.cos(), omega.cos());
    if omega + sigma <= FRAC_PI_2 {
        return PI * s * s * cos;
    }
    if omega - sigma >= FRAC_PI_2 {
        return 0.0;
    }
    let y = ((s - cos) * (s + cos)).max(0.0).sqrt();
    y.atan2(c) + s * s * cos * y.atan2(-c * cos) - y * c
}

/// The same, integrated over rings about the axis, for caps so small that the closed form cancels; from σ and cosω.
#[must_use]
pub fn projected_cap_by_rings(sigma: f64, cos: f64) -> f64 {
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    if cos >= sigma.sin() {
        return PI * sigma.sin().powi(2) * cos;
    }
    if -cos >= sigma.sin() {
        return 0.0;
    }
    // the first ring that touches the horizon; beyond it, the part of a ring above the horizon grows as a square root
    let first = cos.abs().asin();
    let inner = if cos > 0.0 { PI * first.sin().powi(2) * cos } else { 0.0 };
    let panels = 8;
    let nodes = gauss_legendre::<16>();
    let mut sum = 0.0;
    for panel in 0..panels {
        for (x, weight) in nodes {
            let v = (f64::from(panel) + x) / f64::from(panels);
            let theta = first + (sigma - first) * v * v;
            let measure = theta.sin() * (sigma - first) * 2.0 * v / f64::from(panels);
            // a point of the ring is above the horizon where cosω cosθ + sinω sinθ cosφ ≥ 0
            let (a, b) = (cos * theta.cos(), sin * theta.sin());
            let root = ((theta - first).sin() * (theta + first).sin()).max(0.0).sqrt();
            let phi = root.atan2(-a);
            sum += weight * measure * 2.0 * (phi * a + b * phi.sin());
        }
    }
    inner + sum
}

/// Projected solid angle of a polygon: clipped to the horizon of `n`, then Lambert's sum over the edges.
#[must_use]
pub fn projected_polygon(vertices: &[V3], n: V3) -> f64 {
    let mut above = Vec::new();
    for (i, &a) in vertices.iter().enumerate() {
        let b = vertices[(i + 1) % vertices.len()];
        let (ha, hb) = (dot(a, n), dot(b, n));
        if ha >= 0.0 {
            above.push(a);
        }
        if (ha < 0.0) != (hb < 0.0) {
            above.push(along(a, sub(b, a), ha / (ha - hb)));
        }
    }
    let sum: f64 = (0..above.len())
        .map(|i| {
            let (a, b) = (above[i], above[(i + 1) % above.len()]);
            let normal = cross(a, b);
            let l = length(normal);
            if l > 0.0 { l.atan2(dot(a, b)) * dot(normal, n) / l } else { 0.0 }
        })
        .sum();
    0.5 * sum.abs()
}

pub use crate::double_double::{above_horizon, lambert};

/// Form factor from a point to a disk facing it: radius r, height h, offset a of the axis.
#[must_use]
pub fn facing_disk(r: f64, h: f64, a: f64) -> f64 {
    let (s, d) = (h * h + a * a + r * r, h * h + a * a - r * r);
    0.5 * (1.0 - d / (s * s - 4.0 * r * r * a * a).sqrt())
}

/// The same for a receiver whose normal is parallel to the disk's plane and points towards its axis, for r ≤ a.
#[must_use]
pub fn perpendicular_disk(r: f64, h: f64, a: f64) -> f64 {
    let s = h * h + a * a + r * r;
    h / (2.0 * a) * (s / (s * s - 4.0 * r * r * a * a).sqrt() - 1.0)
}

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
pub fn integrate(f: &mut impl FnMut(f64, f64) -> f64, low: [f64; 2], high: [f64; 2], tolerance: f64) -> f64 {
    let nodes = gauss_legendre::<8>();
    let whole = tensor(f, &nodes, low, high);
    refine(f, &nodes, low, high, whole, tolerance * whole.abs(), 20)
}

fn tensor(f: &mut impl FnMut(f64, f64) -> f64, nodes: &[(f64, f64); 8], low: [f64; 2], high: [f64; 2]) -> f64 {
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
    f: &mut impl FnMut(f64, f64) -> f64,
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
