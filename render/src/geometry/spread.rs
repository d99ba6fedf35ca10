//! Flat lights that emit within an angle of their normal.

use crate::packet::{M8, V8, X8};
use etendue::math::{quotient, ratio};
use etendue::{Parallelogram, Real, Vec3};

/// Rounding of the visible part, relative to the lengths that it comes from: it is enlarged by so much.
const SLACK: f64 = 32.0 / 16_777_216.0;

/// How a flat light emits within a cone about its normal, as through a honeycomb before it: the spread of Cycles.
///
/// The radiance of the light is multiplied by [`attenuation`](Self::attenuation). The power does not depend on the spread, so that a narrow
/// cone is bright. A point sees only a disk of the plane of the light, within its [`visible_part`](Self::visible_part).
///
/// - Formula: (tan σ − tan θ)/(tan σ − σ) for θ < σ, with the angle θ to the normal and σ half of the spread; 0 beyond.
/// - Domain: full angles from 1e−3 to below π, in radians. As the spread nears π the factor nears 1.
/// - Density: none; ∫ attenuation · cosθ dω = π, as without a spread.
/// - Greatest error: 4e−7 of the factor on the axis, tan σ/(tan σ − σ).
/// - Source: Cycles, `intern/cycles/kernel/light/area.h`, derived anew.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread<R> {
    /// tan σ.
    pub tan_half: R,
    /// 1/(tan σ − σ).
    pub gain: R,
}

impl<R: Real> Spread<R> {
    /// A spread with this full angle in radians.
    #[must_use]
    pub fn new(angle: f64) -> Self {
        let half = 0.5 * angle.clamp(1e-3, core::f64::consts::PI);
        let (sin, cos) = (half / core::f64::consts::TAU).sin_cos_turns();
        let tangent = sin / cos.max(1e-6);
        // where the difference cancels, its series
        let square = half * half;
        let series =
            (square * (2.0 / 5.0 + square * (17.0 / 105.0 + square * (62.0 / 945.0))) + 1.0) * half * square / 3.0;
        let excess = if half < 0.05 { series } else { tangent - half };
        Self { tan_half: R::lit(tangent), gain: R::lit(1.0 / excess) }
    }
    /// The factor of the radiance in or against the unit direction `w` of a light with the unit normal `n`, on either side.
    #[inline(always)]
    pub fn attenuation(&self, w: Vec3<R>, n: Vec3<R>) -> R {
        let (zero, cos) = (R::lit(0.0), w.dot(n).abs());
        let some = cos.gt(zero);
        let tangent = w.cross(n).length() / R::blend(some, cos, R::lit(1.0));
        ((self.tan_half - tangent) * self.gain).greater(zero).keep(some)
    }
    /// The part of a light with this spread that the point `p` sees: the smallest parallelogram with edges along its own about what of its
    /// plane is within the angle. It is without area where the point sees nothing, and the light itself where it sees all.
    #[inline(always)]
    #[must_use]
    pub fn visible_part(&self, light: &Parallelogram<R>, p: Vec3<R>) -> Parallelogram<R> {
        let corner = light.corner - p;
        let [s, t] = self.ranges([corner, light.edge_s, light.edge_t], light.corner.max_abs() + p.max_abs());
        let (edge_s, edge_t) = (light.edge_s * (s[1] - s[0]), light.edge_t * (t[1] - t[0]));
        let corner = light.edge_s.mul_add(s[0], light.edge_t.mul_add(t[0], corner)) + p;
        let whole = edge_s.max_abs().ge(light.edge_s.max_abs()) & edge_t.max_abs().ge(light.edge_t.max_abs());
        Parallelogram::blend(whole, *light, Parallelogram { corner, edge_s, edge_t })
    }
    /// The ranges of s and t within which corner + s·edge_s + t·edge_t, relative to the point, has what the point sees of the plane. They
    /// are empty where it sees nothing. Coordinates are rounded numbers of up to `reach`.
    #[inline(always)]
    fn ranges(&self, vectors: [Vec3<R>; 3], reach: R) -> [[R; 2]; 2] {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let unit = vectors.iter().fold(reach, |most, v| most.greater(v.max_abs())).pow2_scale();
        let [corner, edge_s, edge_t] = vectors.map(|v| v * unit);
        let (long_s, long_t) = (edge_s.length(), edge_t.length());
        let cross = edge_s.cross(edge_t);
        let area = cross.length();
        let normal = cross * ratio(one, area);
        let height = corner.dot(normal);
        // the normal of edges that are nearly parallel is known less well
        let slack = (corner.length() + long_s + long_t + reach * unit) * ratio(long_s * long_t, area) * R::lit(SLACK);
        let radius = (height.abs() + slack).mul_add(self.tan_half, slack);
        let foot = normal * height - corner;
        let range = |along: Vec3<R>, other: Vec3<R>, length: R| {
            let upright = other.cross(normal);
            let across = along.dot(upright);
            let middle = quotient(foot.dot(upright), across);
            let half = ratio(radius * length, across.abs());
            [middle - half, middle + half].map(|x| x.clamped(zero, one))
        };
        [range(edge_s, edge_t, long_t), range(edge_t, edge_s, long_s)]
    }
}

impl Spread<f32> {
    /// The same spread in all lanes.
    #[must_use]
    pub fn splat(self) -> Spread<X8> {
        Spread { tan_half: X8::splat(self.tan_half), gain: X8::splat(self.gain) }
    }
    /// A cosine of the angle to the normal from which on it is dark: less a rounding, so that nothing is lost.
    pub(crate) fn cos_cone(self) -> f32 {
        let tangent = f64::from(self.tan_half);
        ((1.0 - 1e-5) / (1.0 + tangent * tangent).sqrt()) as f32
    }
}

impl Spread<X8> {
    /// The attenuation in lanes with a spread, and 1 elsewhere. The normal may have any length.
    #[inline(never)]
    pub(crate) fn attenuation_in(&self, lanes: M8, direction: V8, normal: V8) -> X8 {
        Real::blend(lanes, self.attenuation(direction, normal.normalize()), X8::splat(1.0))
    }
}
