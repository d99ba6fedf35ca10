//! Integrals over directions about an axis, of functions that only tables know.

use crate::packet::{V8, X8};
use etendue::{Frame, Real, Vec3};
use std::f64::consts::TAU;

/// The greatest width of a ring about the axis, half a degree in turns: tables have their kinks between rings.
const RING: f64 = 1.0 / 720.0;
/// The least number of rings.
const RINGS: usize = 16;
/// Steps around the axis, 2.5°, a whole number of packets.
const AROUND: usize = 144;
/// Abscissas and weights of the Gauss-Legendre quadrature of 3 points on [−1, 1] (Abramowitz and Stegun, 25.4).
const GAUSS: [[f64; 2]; 3] = [
    [-0.774_596_669_241_483_4, 0.555_555_555_555_555_6],
    [0.0, 0.888_888_888_888_888_9],
    [0.774_596_669_241_483_4, 0.555_555_555_555_555_6],
];

/// ∫ f(w, cosθ) dω over the directions w whose angle θ to the unit vector `axis` is below `most`, in turns: by Gauss's quadrature in θ within
/// rings, and by the midpoint rule around the axis. Of what is a polynomial of degree 4 in θ within each ring, and linear in each step around
/// it, the sum is the integral but for rounding.
pub(crate) fn integral(axis: Vec3<f64>, most: f64, f: impl Fn(V8, f64) -> X8) -> f64 {
    let frame = Frame::new(axis);
    let narrow = |v: Vec3<f64>| V8::lit([v.x, v.y, v.z]);
    let (s, t, n) = (narrow(frame.s), narrow(frame.t), narrow(frame.n));
    let width = RING.min(most / RINGS as f64);
    let (mut sum, mut ring) = (0.0, 0_usize);
    loop {
        let from = width * ring as f64;
        let half = 0.5 * width.min(most - from);
        // rounding may leave a sliver
        if half.is_nan() || half <= 1e-9 * width {
            return sum * (TAU * TAU / AROUND as f64);
        }
        for [x, weight] in GAUSS {
            let (sin, cos) = (half * x + (from + half)).sin_cos_turns();
            let mut row = 0.0;
            for j in (0..AROUND).step_by(8) {
                let turn = X8::from_fn(|lane| (((j + lane) as f64 + 0.5) / AROUND as f64) as f32);
                let (up, across) = turn.sin_cos_turns();
                let w = n * X8::lit(cos) + (s * across + t * up) * X8::lit(sin);
                f(w, cos).to_array().into_iter().for_each(|value| row += f64::from(value));
            }
            sum += half * weight * sin * row;
        }
        ring += 1;
    }
}
