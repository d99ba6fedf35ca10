//! Where samplers are tried: an ordinary place, from which one thing after another is taken to its extremes.

use crate::area_lights::{AreaLight, LightShape, Measure};
use crate::random::Random;
use core::f64::consts::TAU;
use etendue_oracle::{V3, along, basis, cross, dot, sub, unit};
use serde::{Deserialize, Serialize};

/// What is varied.
#[derive(Deserialize, Serialize, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Axis {
    /// Nothing.
    Ordinary,
    /// Size over distance; a radius over the distance of the centre.
    Size,
    /// Sine of the elevation of the point above the plane of a flat light.
    Elevation,
    /// Length over width.
    Aspect,
    /// Height of the centre above the receiver's horizon, over half of the light's size.
    Horizon,
    /// Distance of light and point from the origin, over the distance between them.
    Away,
    /// The unit: what all lengths are multiplied by.
    Unit,
    /// Whether the receiver's normal is flipped: the light is below its horizon.
    Flipped,
}
impl Axis {
    /// All axes that a shape has.
    #[must_use]
    pub fn all(shape: LightShape) -> &'static [Self] {
        use Axis::{Aspect, Away, Elevation, Flipped, Horizon, Ordinary, Size, Unit};
        match shape {
            LightShape::Sphere => &[Ordinary, Size, Horizon, Away, Unit, Flipped],
            LightShape::Disk => &[Ordinary, Size, Elevation, Horizon, Away, Unit, Flipped],
            _ => &[Ordinary, Size, Elevation, Aspect, Horizon, Away, Unit, Flipped],
        }
    }
    /// Its values, from the least to the greatest; every second one, about, if `quick`.
    #[must_use]
    pub fn values(self, shape: LightShape, quick: bool) -> Vec<f64> {
        let all: &[f64] = match (self, shape) {
            (Self::Ordinary | Self::Flipped, _) => return vec![1.0; if quick { 3 } else { 8 }],
            (Self::Size, LightShape::Sphere) => {
                &[1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2, 0.1, 0.5, 0.9, 0.99, 0.9999, 1.01, 2.0, 100.0]
            }
            (Self::Size, _) => &[1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2, 0.1, 0.5, 2.0, 5.0, 10.0, 30.0, 100.0, 1000.0],
            (Self::Elevation, _) => &[1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0],
            (Self::Aspect, _) => &[1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4],
            (Self::Horizon, _) => &[-0.8, -0.4, -0.1, 0.0, 0.1, 0.4, 0.8],
            (Self::Away, _) => &[1.0, 10.0, 100.0, 300.0, 1e3, 3e3, 1e4],
            (Self::Unit, _) => &[1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9],
        };
        all.iter().copied().skip(usize::from(quick)).step_by(if quick { 2 } else { 1 }).collect()
    }
    /// In words, what it is.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Ordinary => "ordinary places",
            Self::Size => "size over distance",
            Self::Elevation => "sine of the elevation above the light's plane",
            Self::Aspect => "length over width",
            Self::Horizon => "height above the horizon, over half of the size",
            Self::Away => "distance from the origin, over that of the light",
            Self::Unit => "unit of length",
            Self::Flipped => "flipped normal",
        }
    }
    /// In words, where a value of this axis is within these bounds, of which one may be missing.
    #[must_use]
    pub fn said(self, [least, most]: [Option<f64>; 2]) -> String {
        let times = |x: f64| if x >= 1.0 || x <= 0.0 { format!("{x}") } else { format!("1/{:.0}", 1.0 / x) };
        let number = |x: f64| match self {
            Self::Size | Self::Elevation => times(x),
            Self::Unit => format!("{x:e}"),
            _ => format!("{x}"),
        };
        let bounds = match (least, most) {
            (Some(a), Some(b)) if a == b => number(a),
            (Some(a), Some(b)) => format!("{} to {}", number(a), number(b)),
            (Some(a), None) => format!("at least {}", number(a)),
            (None, Some(b)) => format!("at most {}", number(b)),
            (None, None) => "anything".into(),
        };
        match self {
            Self::Ordinary => "at ordinary places".into(),
            Self::Size => format!("where the light's size is {bounds} of its distance"),
            Self::Elevation => format!("where the point is {bounds} of its distance above the light's plane"),
            Self::Aspect => format!("where the light is {bounds} times as long as it is wide"),
            Self::Horizon => format!("where the light is cut by the horizon ({bounds} of half its size above it)"),
            Self::Away => format!("where the scene is {bounds} times as far from the origin as the light is"),
            Self::Unit => format!("where the light is {bounds} units of length away"),
            Self::Flipped => "where the receiver's normal is flipped".into(),
        }
    }
}

/// A place at which a sampler is judged.
#[derive(Clone, Copy, Debug)]
pub struct JudgedPlace {
    /// What is not ordinary there.
    pub axis: Axis,
    /// Its value.
    pub value: f64,
    /// The light, the point and the normal.
    pub light: AreaLight,
}

/// All places for a shape, in random positions that the seed decides.
#[must_use]
pub fn places(shape: LightShape, by: Measure, quick: bool, seed: u64) -> Vec<JudgedPlace> {
    let mut random = Random::new(seed ^ 0x60);
    let mut all = Vec::new();
    for &axis in Axis::all(shape) {
        for value in axis.values(shape, quick) {
            let light = place(shape, by, &[(axis, value)], &mut random);
            all.push(JudgedPlace { axis, value, light });
        }
    }
    all
}

/// A light in a random position whose axes have the values.
#[must_use]
pub fn place(shape: LightShape, by: Measure, at: &[(Axis, f64)], random: &mut Random) -> AreaLight {
    let or = |this: Axis, ordinary: f64| at.iter().find(|a| a.0 == this).map_or(ordinary, |a| a.1);
    let size = or(Axis::Size, random.range(0.2, 0.8));
    let height = or(Axis::Elevation, random.range(0.3, 0.9));
    let aspect = or(Axis::Aspect, random.range(1.0, 2.0));
    let unit_of_length = or(Axis::Unit, 1.0);
    let axes = orthonormal(random);
    let from = |x: f64, y: f64, z: f64| -> V3 {
        let sum = along(along(axes[0].map(|c| c * x), axes[1], y), axes[2], z);
        sum.map(|c| c * unit_of_length)
    };
    // the light is about the origin, so that a small one has all its digits
    let level = ((1.0 - height) * (1.0 + height)).sqrt();
    let (sine, cosine) = random.range(0.0, TAU).sin_cos();
    let p = from(level * cosine, level * sine, height);
    let away = or(Axis::Away, 0.0);
    let origin = random.direction().map(|x| x * away * unit_of_length);
    let half = 0.5 * size;
    // a corner and two edges whose cross product points to the side of the point
    let skew = if matches!(shape, LightShape::Rectangle) { 0.0 } else { random.range(-0.4, 0.4) };
    let (b, c) = (from(size, 0.0, 0.0), from(skew * size, size / aspect, 0.0));
    let part = if shape == LightShape::Triangle { 1.0 / 3.0 } else { 0.5 };
    let a = along(along([0.0; 3], b, -part), c, -part);
    let grid = |v: V3, size: f64| snapped(v, size * unit_of_length);
    let rounded = |v: V3| etendue_oracle::narrow(along(origin, v, 1.0));
    let mut light =
        AreaLight { shape, by, p: rounded(p), a: [0.0; 3], b: [0.0; 3], c: [0.0; 3], n: [0.0; 3], radius: 0.0 };
    match shape {
        LightShape::Sphere => (light.a, light.radius) = (rounded([0.0; 3]), (size * unit_of_length) as f32),
        LightShape::Disk => {
            light.a = rounded([0.0; 3]);
            light.b = etendue_oracle::narrow(axes[2]);
            light.radius = (half * unit_of_length) as f32;
        }
        LightShape::Triangle => {
            // corners on a grid, so that edges and corners say the same
            let [v0, v1, v2] = [a, along(a, b, 1.0), along(a, c, 1.0)].map(|v| rounded(grid(v, size)));
            light.a = v0;
            (light.b, light.c) = (difference(v1, v0), difference(v2, v0));
        }
        _ => (light.a, light.b, light.c) = (rounded(a), etendue_oracle::narrow(b), etendue_oracle::narrow(c)),
    }
    let towards = unit(p.map(|x| -x));
    light.n = etendue_oracle::narrow(normal(at, towards, size, random));
    light
}

/// The receiver's normal: it sees all of the light, or what the axis says.
fn normal(at: &[(Axis, f64)], towards: V3, size: f64, random: &mut Random) -> V3 {
    let (s, t) = basis(towards);
    let (sine, cosine) = random.range(0.0, TAU).sin_cos();
    let aside = along(s.map(|x| x * cosine), t, sine);
    let cut = at.iter().find(|a| a.0 == Axis::Horizon);
    let up = cut.map_or_else(|| random.range(0.85, 1.0), |cut| (cut.1 * 0.5 * size).clamp(-0.99, 0.99));
    let n = unit(along(towards.map(|x| x * up), aside, ((1.0 - up) * (1.0 + up)).sqrt()));
    if at.iter().any(|a| a.0 == Axis::Flipped) { n.map(|x| -x) } else { n }
}

fn orthonormal(random: &mut Random) -> [V3; 3] {
    let n = random.direction();
    let (s, t) = basis(n);
    let (sine, cosine) = random.range(0.0, TAU).sin_cos();
    let x = along(s.map(|v| v * cosine), t, sine);
    [x, cross(n, x), n]
}
/// Rounds to a grid of 2⁻¹⁸ of the size.
fn snapped(v: V3, size: f64) -> V3 {
    let step = (size.log2().ceil() - 18.0).exp2();
    v.map(|x| (x / step).round() * step)
}
fn difference(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    core::array::from_fn(|k| a[k] - b[k])
}

/// Whether the numbers are those of a light that is seen from its front: corners and edges agree, the edges of a rectangle are
/// perpendicular, directions have length 1.
#[must_use]
pub fn is_sound(light: &AreaLight) -> bool {
    let [b, c, n] = [light.b, light.c, light.n].map(etendue_oracle::wide);
    let up = sub(etendue_oracle::wide(light.p), etendue_oracle::wide(light.a));
    let is_unit = |v: V3| (dot(v, v) - 1.0).abs() < 1e-6;
    let exact =
        |edge: [f32; 3]| (0..3).all(|k| f64::from(light.a[k]) + f64::from(edge[k]) == f64::from(light.a[k] + edge[k]));
    is_unit(n)
        && match light.shape {
            LightShape::Sphere => light.radius > 0.0,
            LightShape::Disk => light.radius > 0.0 && is_unit(b) && dot(b, up) > 0.0,
            LightShape::Triangle => exact(light.b) && exact(light.c) && dot(cross(b, c), up) > 0.0,
            LightShape::Rectangle => {
                dot(b, c).abs() <= 1e-6 * (dot(b, b) * dot(c, c)).sqrt() && dot(cross(b, c), up) > 0.0
            }
            _ => dot(cross(b, c), up) > 0.0,
        }
}
