//! The oracles against each other: closed forms, quadrature, special values.

use core::f64::consts::{FRAC_PI_2, PI, TAU};
use etendue_oracle::*;
use etendue_properties::generators::Random;

#[test]
fn octant_and_facing_disk() {
    let octant = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|v| sum_dw(v, &[]));
    assert!((triangle_solid_angle(octant) - FRAC_PI_2).abs() < 1e-15);
    // the projected solid angle of a facing disk on the axis is that of its cone
    let (r, h) = (0.7, 1.3_f64);
    let sigma = (r / h).atan();
    assert!((PI * facing_disk(r, h, 0.0) - projected_cap(sigma, 0.0)).abs() < 1e-15);
}

#[test]
fn projected_cap_is_its_integral() {
    for (sigma, omega) in [(0.3, 0.4), (0.5, 1.3), (0.5, 1.8), (1.2, 1.0), (FRAC_PI_2, 2.0), (1.5, 3.0)] {
        let n = [f64::sin(omega), 0.0, f64::cos(omega)];
        let mut f = |s: f64, t: f64| {
            let (theta, phi) = (s * sigma, TAU * t);
            let w = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
            dot(w, n).max(0.0) * theta.sin() * sigma * TAU
        };
        let integral = integrate(&mut f, [0.0; 2], [1.0; 2], 1e-7);
        let closed = projected_cap(sigma, omega);
        assert!((integral - closed).abs() < 3e-6, "{sigma} {omega}: {closed} {integral}");
    }
}

#[test]
fn polygon_with_many_sides_is_a_disk() {
    let (r, h, a) = (0.8, 1.1, 0.9);
    let corner = |i: usize| {
        let phi = TAU * i as f64 / 4096.0;
        [a + r * phi.cos(), r * phi.sin(), h]
    };
    let polygon: Vec<_> = (0..4096).map(corner).collect();
    let facing = projected_polygon(&polygon, [0.0, 0.0, 1.0]) / PI;
    assert!((facing - facing_disk(r, h, a)).abs() < 1e-6, "{facing}");
    let perpendicular = projected_polygon(&polygon, [1.0, 0.0, 0.0]) / PI;
    assert!((perpendicular - perpendicular_disk(r, h, a)).abs() < 1e-6, "{perpendicular}");
}

#[test]
fn clipped_polygon_is_its_integral() {
    let mut random = Random::new(5);
    for _ in 0..20 {
        let (p, u, v) = (random.direction(), random.direction(), random.direction());
        let p = p.map(|x| 2.0 * x);
        let n = random.direction();
        let corners = [p, along(p, u, 1.0), along(along(p, u, 1.0), v, 1.0), along(p, v, 1.0)];
        let normal = cross(u, v);
        let mut f = |s: f64, t: f64| {
            let x = along(along(p, u, s), v, t);
            let d = length(x);
            dot(x, n).max(0.0) * dot(x, normal).abs() / d.powi(4)
        };
        let integral = integrate(&mut f, [0.0; 2], [1.0; 2], 1e-7);
        let closed = projected_polygon(&corners, n);
        assert!((integral - closed).abs() < 1e-5 * (1.0 + closed), "{integral} {closed}");
    }
}

#[test]
fn tiny_solid_angles() {
    // a facing right triangle at distance 1: its solid angle tends to its area
    let v = [0.0, 0.0, 1.0];
    for size in [1e-3, 1e-6, 1e-9] {
        let omega =
            triangle_solid_angle([sum_dw(v, &[]), sum_dw(v, &[[size, 0.0, 0.0]]), sum_dw(v, &[[0.0, size, 0.0]])]);
        assert!((omega / (0.5 * size * size) - 1.0).abs() < size * size + 1e-13, "{size}: {omega}");
        let (h, _) = cap([0.0, 0.6, 0.8], size);
        assert!((h / (0.5 * size * size) - 1.0).abs() < size * size + 1e-12);
    }
}
