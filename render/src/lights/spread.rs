//! Flat lights that emit within an angle of their normal.

use crate::packet::{M8, V8, X8, select};
use etendue::light::Spread;

/// A cosine of the angle to the normal from which on it is dark: less a rounding, so that nothing is lost.
pub(super) fn cos_cone(spread: &Spread<f32>) -> f32 {
    let tangent = f64::from(spread.tan_half);
    ((1.0 - 1e-5) / (1.0 + tangent * tangent).sqrt()) as f32
}

/// The factor of the radiance in lanes with a spread, and 1 elsewhere. The normal may have any length.
#[inline(never)]
pub(super) fn attenuation(normal: V8, direction: V8, spread: &Spread<X8>, lanes: M8) -> X8 {
    select(lanes, spread.attenuation(direction, normal.normalize()), X8::splat(1.0))
}
