//! The unit disk, uniform in area, by polar coordinates.

use super::Warp;
use crate::real::{Real, unit_interval};
use crate::vector::Vec2;
use core::f64::consts::{FRAC_1_PI, TAU};

/// Points of the unit disk, uniform in area, by radius and azimuth.
///
/// Call `PolarDisk.sample(u)`; there is nothing to set up and no degenerate input.
///
/// - Formula: r = √u₀, φ = 2πu₁.
/// - Domain: u in [0, 1)²; u₀ = 0 maps to the origin.
/// - Density: the pdf is 1/π per unit area inside, 0 outside.
/// - Source: Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th ed., A.5.1.
#[derive(Clone, Copy, Debug, Default)]
pub struct PolarDisk;

impl<R: Real> Warp<R> for PolarDisk {
    type Point = Vec2<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec2<R> {
        let (s, c) = u.y.sin_cos_turns();
        Vec2::new(c, s) * u.x.sqrt()
    }
    /// The pdf per unit area.
    #[inline(always)]
    fn pdf(&self, p: Vec2<R>) -> R {
        R::lit(FRAC_1_PI).keep(p.length_squared().le(R::lit(1.0 + 4e-7)))
    }
    #[inline(always)]
    fn invert(&self, p: Vec2<R>) -> Vec2<R> {
        let turns = p.y.atan2(p.x) * R::lit(1.0 / TAU);
        let turns = R::blend(turns.lt(R::lit(0.0)), turns + R::lit(1.0), turns);
        Vec2::new(unit_interval(p.length_squared()), unit_interval(turns))
    }
}
