//! Summaries of lights and of sets of lights.

use crate::real::Real;
use crate::select::LightBound;

/// The least extent of a light relative to that of all.
pub(super) const SMALL: f64 = 1.0 / (1_u64 << 30) as f64;
/// The least power relative to the strongest light.
pub(super) const WEAK: f64 = 1.0 / (1_u64 << 40) as f64;

/// The places of a symmetric matrix.
pub(super) const PLACES: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];

/// The mean cosine that the importance has for lights without a direction.
const ISOTROPIC: f64 = 0.230_329_433;

/// A light, or a set of lights, in scaled units.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Part {
    /// Mean position by power.
    pub(super) center: [f64; 3],
    /// A box around all lights.
    pub(super) low: [f64; 3],
    pub(super) high: [f64; 3],
    /// Variances of the positions along the axes.
    pub(super) variances: [f64; 3],
    /// Intensity along the normal.
    pub(super) power: f64,
    /// Mean normal by power; its length is 1 if all are the same, and 0 for lights that emit in all directions.
    pub(super) normal: [f64; 3],
    /// Covariances of the normals, at [`PLACES`].
    pub(super) turns: [f64; 6],
    /// The greatest distance of a normal from the mean; 1 for lights that emit in all directions.
    pub(super) spread: f64,
    /// A bound of |(x − centre)·m| over the points x of a light and its normals m.
    pub(super) offset: f64,
    /// The least cosine of a cone.
    pub(super) cone: f64,
    /// Whether all are flat and emit from both sides.
    pub(super) two_sided: bool,
}

/// The powers of two by which lengths and powers are multiplied.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    pub(super) length: f32,
    pub(super) power: f32,
}

fn sane(light: &LightBound) -> bool {
    let finite = light.center.iter().all(|x| x.is_finite()) && light.radius.is_finite();
    finite && light.power > 0.0 && light.power < f32::INFINITY
}

fn square(x: f64) -> f64 {
    x * x
}

fn length(v: [f64; 3]) -> f64 {
    v.map(square).iter().sum::<f64>().sqrt()
}

impl Units {
    pub(super) fn of(lights: &[LightBound]) -> Self {
        let (mut extent, mut strongest) = (0.0_f32, 0.0_f32);
        for light in lights.iter().filter(|light| sane(light)) {
            let [x, y, z] = light.center.map(Real::abs);
            extent = extent.greater(x.greater(y)).greater(z.greater(light.radius));
            strongest = strongest.greater(light.power);
        }
        let [length, power] = [extent, strongest].map(|x| if x > 0.0 { x.pow2_scale() } else { 1.0 });
        Self { length, power }
    }
}

impl Part {
    /// A light.
    pub(super) fn light(light: &LightBound, units: Units) -> Self {
        if !sane(light) {
            return Self::default();
        }
        let center = light.center.map(|x| f64::from(x * units.length));
        let radius = f64::from(light.radius.greater(0.0) * units.length).greater(SMALL);
        let power = f64::from(light.power * units.power).greater(WEAK) * core::f64::consts::FRAC_1_PI;
        let normal = light.normal.map(f64::from);
        let length = length(normal);
        // the centre of a light with an extent may be rounded
        let rounded =
            if light.radius > 0.0 { center.map(square).iter().sum::<f64>().sqrt() * (1.0 / 16_777_216.0) } else { 0.0 };
        let extent = |half: [f64; 3]| {
            let end = |sign: f64| core::array::from_fn(|k| center[k] + sign * (half[k] + rounded));
            (end(-1.0), end(1.0))
        };
        // the cone of a spot light beyond a hemisphere bounds nothing
        if !(length > 0.0 && length < f64::INFINITY && light.cos_cone >= 0.0) {
            let (low, high) = extent([radius; 3]);
            let power = power * (0.25 / ISOTROPIC);
            // the disk that a point sees, and all directions
            let (variances, third) = ([radius * radius * 0.25; 3], 1.0 / 3.0);
            let turns = [third, third, third, 0.0, 0.0, 0.0];
            return Self { center, low, high, variances, power, turns, spread: 1.0, offset: radius, ..Self::default() };
        }
        let normal = normal.map(|x| x / length);
        // a disk, whose normal may be rounded
        let (low, high) = extent(normal.map(|m| radius * ((1.0 - m * m).greater(0.0).sqrt() + 1e-6).lesser(1.0)));
        let cone = f64::from(light.cos_cone).clamped(0.0, 1.0);
        let power = if cone > 0.0 { power * 0.5 / (1.0 - cone).greater(SMALL) } else { power };
        // a square in that disk
        let variances = normal.map(|m| radius * radius * (1.0 - m * m).greater(0.0) * (1.0 / 6.0));
        let (offset, two_sided) = (radius * 1e-6 + rounded, light.two_sided);
        let spread = if two_sided { 2.0 } else { 0.0 };
        Self { center, low, high, variances, power, normal, turns: [0.0; 6], spread, offset, cone, two_sided }
    }

    /// A set of lights, from its parts.
    pub(super) fn union(parts: &[Self]) -> Self {
        let lit = || parts.iter().filter(|part| part.power > 0.0);
        let power: f64 = lit().map(|part| part.power).sum();
        if power <= 0.0 {
            return Self::default();
        }
        let (infinity, mut all) = (f64::INFINITY, Self { power, cone: 1.0, two_sided: true, ..Self::default() });
        (all.low, all.high) = ([infinity; 3], [-infinity; 3]);
        for part in lit() {
            for k in 0..3 {
                all.center[k] += part.center[k] * (part.power / power);
                all.low[k] = all.low[k].lesser(part.low[k]);
                all.high[k] = all.high[k].greater(part.high[k]);
            }
            all.cone = all.cone.lesser(part.cone);
            all.two_sided &= part.two_sided;
        }
        for part in lit() {
            let share = part.power / power;
            // lights with two sides have no sign; among others, they have no direction
            let along: f64 = (0..3).map(|k| all.normal[k] * part.normal[k]).sum();
            let sign = match (all.two_sided, part.two_sided) {
                (true, _) => 1.0_f64.copysign(along),
                (false, true) => 0.0,
                (false, false) => 1.0,
            };
            for k in 0..3 {
                all.normal[k] += part.normal[k] * (share * sign);
                all.variances[k] += share * (part.variances[k] + square(part.center[k] - all.center[k]));
            }
            for (to, (turn, [i, j])) in all.turns.iter_mut().zip(part.turns.into_iter().zip(PLACES)) {
                *to += share * (turn + part.normal[i] * part.normal[j]);
            }
        }
        for (turn, [i, j]) in all.turns.iter_mut().zip(PLACES) {
            *turn -= all.normal[i] * all.normal[j];
        }
        for part in lit() {
            let mut turned = 0.0;
            let mut along = [0.0; 2];
            for k in 0..3 {
                let away = part.center[k] - all.center[k];
                turned += square(part.normal[k] - all.normal[k]);
                along[0] += away * part.normal[k];
                along[1] += square(away);
            }
            all.spread = all.spread.greater(part.spread + turned.sqrt());
            all.offset = all.offset.greater(part.offset + Real::abs(along[0]) + along[1].sqrt() * part.spread);
        }
        all.spread = if all.two_sided { 2.0 } else { all.spread.lesser(1.0 + length(all.normal)) };
        all
    }
}
