//! A dielectric coat over a diffuse surface: what passes its interface, and what that sends back to the surface.
//!
//! The coat has a GGX interface of roughness α and relative index of refraction η. With the visible normals m for the unit vector v (Heitz 2018),
//! the transmittance is T(v·n) = E[(1 − F(v·m)) G₂/G₁], where F is Fresnel's reflectance for unpolarised light, G₂ = 1/(1 + Λ(v) + Λ(t)) the
//! height-correlated masking-shadowing function for the refracted direction t, and G₁ = 1/(1 + Λ(v)). From below, light that is diffuse meets
//! the interface, which sends the part F̄ = 2∫μ E[F G₂/G₁] dμ of it back (for η⁻¹). As the surface below scatters evenly, the sum of all orders is
//!
//! f = F D G₂/(4 cosθᵢ cosθₒ) + T(cosθᵢ) T(cosθₒ)/η² · ρ/(π (1 − ρ F̄)).
//!
//! This is the mean of pbrt-v4's random walk in a coat without a medium, and Mitsuba's `plastic` (`nonlinear`); its `roughplastic` has G₁(t) for
//! G₂/G₁, which is darker where α is great. T is a polynomial of degree 7 in μ/(μ + 0.4), interpolated in α and η: off by at most 0.5 % for μ ≥ 0.05 and η from
//! 1.1 to 2; F̄ by 0.001.

use std::sync::OnceLock;

/// Coefficients of the polynomial for T.
pub const TERMS: usize = 8;
/// The pole of the variable μ/(μ + `POLE`), and the least μ of the fit.
pub const POLE: f64 = 0.4;
const LEAST: f64 = 0.02;

/// Steps of √α, and of √r for r = (η − 1)/(η + 1).
const ROUGHNESSES: usize = 40;
const INDICES: usize = 32;
/// Points of the quadrature over the disk of visible normals: along its radius and around half of it.
const RADII: usize = 24;
const ANGLES: usize = 16;

/// What passes a coat, and what it sends back.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coat {
    /// T/η: coefficients of the powers of x = (μ/(μ + 0.4) − middle) / half, where μ from 0.02 to 1 is x from −1 to 1.
    pub through: [f64; TERMS],
    /// F̄, the part of diffuse light from below that is reflected.
    pub inside: f64,
}

/// Middle and half of the range of the variable of the polynomial.
#[must_use]
pub const fn range() -> [f64; 2] {
    let [low, high] = [LEAST / (LEAST + POLE), 1.0 / (1.0 + POLE)];
    [0.5 * (low + high), 0.5 * (high - low)]
}

impl Coat {
    /// For a roughness α from 0 to 1 and an index of refraction; below 1 counts as 1.
    #[must_use]
    pub fn new(alpha: f64, eta: f64) -> Self {
        // what a scene does not need is not computed
        static NODES: [[OnceLock<Coat>; ROUGHNESSES + 1]; INDICES + 1] =
            [const { [const { OnceLock::new() }; ROUGHNESSES + 1] }; INDICES + 1];
        let eta = eta.max(1.0);
        let split = |x: f64, steps: usize| {
            let at = (x.clamp(0.0, 1.0) * steps as f64).min(steps as f64);
            let before = (at as usize).min(steps - 1);
            (before, at - before as f64)
        };
        let (i, s) = split(((eta - 1.0) / (eta + 1.0)).sqrt(), INDICES);
        let (j, t) = split(alpha.max(0.0).sqrt(), ROUGHNESSES);
        let node = |i: usize, j: usize| NODES[i][j].get_or_init(|| Self::at(i, j));
        let of = |i: usize| if t == 0.0 { *node(i, j) } else { Self::mix(node(i, j), node(i, j + 1), t) };
        let found = Self::mix(&of(i), &of(i + 1), s);
        Self { through: found.through.map(|x| x / eta), ..found }
    }
    fn mix(a: &Self, b: &Self, t: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * t;
        Self { through: std::array::from_fn(|k| mix(a.through[k], b.through[k])), inside: mix(a.inside, b.inside) }
    }
    /// At a node of the table; `through` is T.
    fn at(index: usize, roughness: usize) -> Self {
        let root = index as f64 / INDICES as f64;
        let ratio = (root * root).min(0.999);
        let eta = (1.0 + ratio) / (1.0 - ratio);
        let alpha = (roughness as f64 / ROUGHNESSES as f64).powi(2);
        let [middle, half] = range();
        // Chebyshev's polynomials through the values at their nodes, by powers
        let node = |k: usize| libm::cos(std::f64::consts::PI * (k as f64 + 0.5) / TERMS as f64);
        let value = |k: usize| {
            let t = node(k).mul_add(half, middle);
            transmitted(POLE * t / (1.0 - t), alpha, eta)
        };
        let values: [f64; TERMS] = std::array::from_fn(value);
        let mut powers = [[0.0; TERMS]; TERMS];
        powers[0][0] = 1.0;
        powers[1][1] = 1.0;
        for n in 2..TERMS {
            for k in 0..TERMS {
                let above = if k > 0 { powers[n - 1][k - 1] } else { 0.0 };
                powers[n][k] = 2.0 * above - powers[n - 2][k];
            }
        }
        let mut through = [0.0; TERMS];
        for (n, polynomial) in powers.iter().enumerate() {
            let norm = if n == 0 { 1.0 } else { 2.0 } / TERMS as f64;
            let angle = |k: usize| std::f64::consts::PI * n as f64 * (k as f64 + 0.5) / TERMS as f64;
            let weight: f64 = (0..TERMS).map(|k| values[k] * libm::cos(angle(k))).sum::<f64>() * norm;
            (0..TERMS).for_each(|k| through[k] += weight * polynomial[k]);
        }
        Self { through, inside: reflected_inside(alpha, eta) }
    }
    /// T/η at a cosine, from the polynomial.
    #[must_use]
    pub fn through_at(&self, mu: f64) -> f64 {
        let [middle, half] = range();
        let x = (mu / (mu + POLE) - middle) / half;
        self.through.iter().rev().fold(0.0, |sum, c| sum * x + c).max(0.0)
    }
}

/// Fresnel's reflectance of a dielectric for unpolarised light, and the cosine of the refracted direction, which is 0 where all is reflected.
fn fresnel(cos: f64, eta: f64) -> [f64; 2] {
    let square = 1.0 - (1.0 - cos * cos) / (eta * eta);
    if square <= 0.0 {
        return [1.0, 0.0];
    }
    let refracted = square.sqrt();
    let across = (cos - eta * refracted) / (cos + eta * refracted);
    let along = (eta * cos - refracted) / (eta * cos + refracted);
    [0.5 * (across * across + along * along), refracted]
}

/// G₂/G₁ of GGX for directions at these cosines; 0 if the second one is below the horizon.
fn unmasked(from: f64, to: f64, alpha: f64) -> f64 {
    if to <= 0.0 {
        return 0.0;
    }
    // 1 + 2Λ is this root over the cosine
    let [a, b] = [from, to].map(|cos| (cos * cos + alpha * alpha * (1.0 - cos * cos)).sqrt());
    to * (from + a) / (a * to + b * from)
}

/// The mean of a function of v·m and m·n over the visible normals m of a GGX surface for a view at this cosine.
fn over_normals(mu: f64, alpha: f64, of: impl Fn(f64, f64) -> f64) -> f64 {
    let view = [(1.0 - mu * mu).max(0.0).sqrt(), mu];
    // Heitz 2018: a half disk, stretched along the view
    let length = (alpha * alpha * view[0] * view[0] + mu * mu).sqrt();
    let stretched = [alpha * view[0] / length, mu / length];
    let lift = 0.5 * (1.0 + stretched[1]);
    let mut sum = 0.0;
    for (i, j) in (0..RADII).flat_map(|i| (0..ANGLES).map(move |j| (i, j))) {
        // by the height above the disk, which resolves steep normals at its edge; both halves are alike
        let height = (i as f64 + 0.5) / RADII as f64;
        let radius = (1.0 - height * height).sqrt();
        let (sin, cos) = libm::sincos(std::f64::consts::PI * ((j as f64 + 0.5) / ANGLES as f64 - 0.5));
        let (t1, flat) = (radius * cos, radius * sin);
        let t2 = (1.0 - lift) * (1.0 - t1 * t1).max(0.0).sqrt() + lift * flat;
        let up = (1.0 - t1 * t1 - t2 * t2).max(0.0).sqrt();
        // along the view, and up; across it is t1
        let x = up * stretched[0] - t2 * stretched[1];
        let z = up * stretched[1] + t2 * stretched[0];
        let normal = [alpha * x, alpha * t1, z.max(1e-12)];
        let scale = 1.0 / (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
        let cos_view = ((normal[0] * view[0] + normal[2] * view[1]) * scale).clamp(0.0, 1.0);
        sum += 2.0 * height * of(cos_view, normal[2] * scale);
    }
    sum / (RADII * ANGLES) as f64
}

/// T: the part of light from a direction at this cosine that passes the interface.
fn transmitted(mu: f64, alpha: f64, eta: f64) -> f64 {
    if alpha == 0.0 {
        return 1.0 - fresnel(mu, eta)[0];
    }
    over_normals(mu, alpha, |cos, up| {
        let [reflected, refracted] = fresnel(cos, eta);
        (1.0 - reflected) * unmasked(mu, mu / eta - (cos / eta - refracted) * up, alpha)
    })
}

/// F̄: the part of diffuse light from below that the interface reflects.
fn reflected_inside(alpha: f64, eta: f64) -> f64 {
    const STEPS: usize = 48;
    let mean = |of: &dyn Fn(f64) -> f64| -> f64 {
        let middles = (0..STEPS).map(|k| (k as f64 + 0.5) / STEPS as f64);
        middles.map(|mu| 2.0 * mu * of(mu)).sum::<f64>() / STEPS as f64
    };
    if alpha == 0.0 {
        // of light that a smooth interface lets through, both ways have the same, but for solid angles (Judd 1942)
        return 1.0 - (1.0 - mean(&|mu| fresnel(mu, eta)[0])) / (eta * eta);
    }
    let inner = 1.0 / eta;
    mean(&|mu| over_normals(mu, alpha, |cos, up| fresnel(cos, inner)[0] * unmasked(mu, 2.0 * cos * up - mu, alpha)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// T at the cosines 0.1, 0.3, 0.7 and 1, and F̄, by other quadratures in double precision, of 200² visible normals by spherical caps, or of
    /// Fresnel's formula alone.
    #[test]
    fn coats_let_through_what_quadrature_says() {
        for (alpha, eta, through, inside) in [
            (0.0, 1.1, [0.6157, 0.9367, 0.9960, 0.9977], 0.1945),
            (0.0, 1.5, [0.4284, 0.7922, 0.9491, 0.9600], 0.5962),
            (0.0, 2.0, [0.4076, 0.7313, 0.8766, 0.8889], 0.7900),
            (0.05, 1.5, [0.5112, 0.7963, 0.9479, 0.9599], 0.5856),
            (0.1, 1.1, [0.7597, 0.9287, 0.9931, 0.9976], 0.1603),
            (0.22, 1.7, [0.7099, 0.7964, 0.9077, 0.9289], 0.5818),
            (0.3, 1.5, [0.7564, 0.8236, 0.9270, 0.9530], 0.4244),
            (0.3, 2.0, [0.7115, 0.7671, 0.8577, 0.8813], 0.6207),
            (0.6, 1.33, [0.7424, 0.7754, 0.8985, 0.9566], 0.1679),
            (1.0, 1.5, [0.6824, 0.6697, 0.7827, 0.8807], 0.1352),
            (1.0, 2.0, [0.6556, 0.6282, 0.7089, 0.7893], 0.2433),
        ] {
            let coat = Coat::new(alpha, eta);
            for (mu, right) in [0.1, 0.3, 0.7, 1.0].into_iter().zip(through) {
                let found = coat.through_at(mu) * eta;
                assert!((found / right - 1.0).abs() < 6e-3, "{alpha} {eta} {mu}: {found}, not {right}");
            }
            assert!((coat.inside - inside).abs() < 1.5e-3, "{alpha} {eta}: {}, not {inside}", coat.inside);
        }
        // no coat at all
        let none = Coat::new(0.0, 1.0);
        assert!((none.through_at(0.5) - 1.0).abs() < 1e-6 && none.inside < 1e-6, "{none:?}");
    }
}
