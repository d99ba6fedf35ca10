//! Directions in a cone.

use super::{INSIDE, STEPS, at_least, direction, length, limit, margins, outputs, over_margin, pair, relative};
use crate::interval::Interval;
use crate::search::{Range, Statement, Theorem};
use crate::tape;
use crate::traced::Traced;
use core::f64::consts::TAU;
use etendue::Real;
use etendue::warp::{Cone, Warp};

/// In the last values of u₀, the worst roundings of all operations together could move a sample out of a cone.
const EXCEPTED: u32 = 16;
pub(super) struct Directions {
    pub(super) heights: [f32; 2],
}
impl Directions {
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        let cone = Self::cone(x);
        direction(cone.sample(pair(x))).into_iter().chain([cone.uniform_pdf()]).collect()
    }
    fn cone<R: Real>(x: &[R]) -> Cone<R> {
        Cone { one_minus_cos: x[2] }
    }
    /// The least sin σ, or 1 beyond 90°.
    fn width(h: Interval) -> f64 {
        let sin = (h * (Interval::point(2.0) - h)).sqrt().map_or(0.0, |s| s.lo);
        if h.lo >= 1.0 { 1.0 } else { sin }
    }
    /// The least tolerance of the cone in 1 − cosθ: 4 units of 2⁻²⁴ times the greater of sin σ and 1 − cosσ − 1.
    fn tolerance(h: Interval) -> f64 {
        let sin = (h * (Interval::point(2.0) - h)).sqrt().map_or(0.0, |s| s.lo);
        4.0 / f64::from(STEPS) * sin.max(h.lo - 1.0) * (1.0 - 1e-6)
    }
}
impl Theorem for Directions {
    outputs!();
    fn statement(&self) -> Statement {
        Statement {
            name: "Cone",
            domain: format!(
                "all 2⁴⁸ pairs u (the pdf of samples is proved to be positive up to u₀ = 1 − 2⁻²⁰), 1 − cosσ from {:e} to {}, where 2 and more is the sphere",
                self.heights[0], self.heights[1]
            ),
            ranges: vec![Range::UNIT, Range::UNIT, Range::Logarithmic(self.heights[0], self.heights[1])],
            limits: vec![
                limit("error across the axis, in sin σ, or in 1 beyond 90°", 4e-7),
                limit("error along the axis, in 1", 1.3e-7),
                limit("relative error of the pdf", 1.7e-7),
                INSIDE,
            ],
        }
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let cone = Self::cone(x);
        let w = cone.sample(pair(x));
        let (pdf, assumed) = tape::assume(|| cone.pdf(w));
        // 1 − cosθ = u₀h in exact arithmetic
        let h = x[2].computed().lesser(Interval::point(2.0));
        let margin = h.lo * (1.0 - x[0].computed().hi) + Self::tolerance(h);
        let inside = if at_least(x[0], STEPS - EXCEPTED) { 0.0 } else { over_margin(&assumed, margin) };
        vec![length(&[w.x, w.y]) / Self::width(h), w.z.error(), relative(pdf), inside]
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let cone = Self::cone(x);
        let w = cone.sample(pair(x));
        let assumed = tape::assume(|| cone.pdf(w)).1;
        let (h, angle) = (values[2].min(2.0), TAU * values[1]);
        let k = values[0] * h;
        let sin = (k * (2.0 - k)).sqrt();
        let width = if h < 1.0 { (h * (2.0 - h)).sqrt() } else { 1.0 };
        vec![
            [w.x.exact(), sin * angle.cos(), width],
            [w.y.exact(), sin * angle.sin(), width],
            [w.z.exact(), 1.0 - k, 1.0],
            [cone.uniform_pdf().exact(), 1.0 / (TAU * h), 1.0 / (TAU * h)],
        ]
        .into_iter()
        .chain(margins(&assumed, h * (1.0 - values[0]) + Self::tolerance(Interval::point(h))))
        .collect()
    }
}
