//! The lights of a scene as records, with their powers and bounds.

use super::spread::cos_cone;
use crate::bvh::NOTHING;
use crate::geometry::Geometry;
use crate::scene::{Cone, DeltaLight, Scene, Shape};
use etendue::Vec3;
use etendue::light::Spread;
use etendue::select::LightBound;
use std::f64::consts::{FRAC_1_PI, PI};

// kinds of lights, and flags beside them
pub(super) const SPHERE: u32 = 0;
pub(super) const TRIANGLE: u32 = 1;
pub(super) const PARALLELOGRAM: u32 = 2;
pub(crate) const POINT: u32 = 3;
pub(crate) const SPOT: u32 = 4;
pub(crate) const DISTANT: u32 = 5;
pub(super) const SKY: u32 = 6;
pub(super) const DIRECTED: u32 = 7;
pub(super) const KINDS: u32 = 7;
pub(super) const TWO_SIDED: u32 = 8;
pub(super) const SPREAD: u32 = 16;
pub(super) const PICTURED: u32 = 32;
pub(super) const PROFILED: u32 = 64;
/// Beside the bits of the kinds: there is a light with a spread.
pub(super) const SPREADS: u32 = 1 << 8;
/// Beside the bits of the kinds: there is a light that shows a picture.
pub(super) const PICTURES: u32 = 1 << 9;
/// Beside the bits of the kinds: there is a light with an area and a profile.
pub(super) const PROFILES: u32 = 1 << 10;
/// Lights whose radiance or intensity differs by direction, but for the sky.
pub(super) const UNEVEN: u32 = 1 << DIRECTED | SPREADS | PROFILES;
pub(super) const ONLY_DELTAS: u32 = 1 << POINT | 1 << SPOT | 1 << DISTANT | 1 << DIRECTED;
pub(super) const ONLY_AREAS: u32 = 1 << SPHERE | 1 << TRIANGLE | 1 << PARALLELOGRAM | SPREADS | PICTURES | PROFILES;

/// The cosine of the narrowest cone that a tree tells from its axis. A narrower light counts as if it filled this cone: as bright as it is
/// on its axis, it would take the samples of all points around its cone, which it does not light.
const NARROWEST: f32 = 253.0 / 254.0;

/// A light.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LightRecord {
    /// Centre of a sphere, corner of a triangle or parallelogram, position of a light without an area, direction to a distant light.
    pub(crate) place: [f32; 3],
    /// First edge of a triangle or parallelogram, axis of a spot or directed light; a sphere has its radius in x.
    pub(crate) first: [f32; 3],
    /// Second edge of a triangle or parallelogram; a spot light has 1 − cosθ of its inner and outer angle in x and y, a directed light its
    /// index among those in x, and both in z a cosine of an angle from which on they are dark.
    pub(crate) second: [f32; 3],
    /// Radiance, the mean of a picture; intensity of a point or spot light, the greatest of a directed light, irradiance of a distant
    /// light.
    pub(super) radiance: [f32; 3],
    /// Its spread, where [`SPREAD`] is set; with a profile, the cone beyond which that is dark.
    pub(super) spread: Spread<f32>,
    /// Its kind, [`TWO_SIDED`], [`SPREAD`], [`PICTURED`] and [`PROFILED`].
    pub(crate) kind: u32,
    /// Index of its shape, or [`NOTHING`].
    pub(super) shape: u32,
}

/// A [`LightRecord`] in two halves of eight numbers: two transpositions gather eight lights. [`Chosen::new`] unpacks it.
pub(super) type PackedLight = [[f32; 8]; 2];

impl LightRecord {
    /// A shape that emits.
    pub(super) fn of(index: u32, shape: &Shape) -> Option<Candidate> {
        let emission = shape.emission?;
        let (kind, [place, first, second]) = match shape.geometry {
            Geometry::Sphere { center, radius } => (SPHERE, [center, [radius, 0.0, 0.0], [0.0; 3]]),
            Geometry::Triangle([a, b, c]) => {
                let edge = |to: [f32; 3]| std::array::from_fn(|k| to[k] - a[k]);
                (TRIANGLE, [a, edge(b), edge(c)])
            }
            Geometry::Parallelogram { p, u, v } => (PARALLELOGRAM, [p, u, v]),
        };
        let (sides, flag) = if emission.two_sided { (2.0, TWO_SIDED) } else { (1.0, 0) };
        let flag = if emission.picture.is_some() { flag | PICTURED } else { flag };
        let power = sum(emission.radiance) * shape.geometry.area() * sides;
        let radiance = emission.radiance;
        let mut record = Self { place, first, second, radiance, kind: kind | flag, shape: index, ..Self::default() };
        if emission.profile.is_some() {
            record.kind |= PROFILED;
        }
        if let Some(spread) = emission.spread {
            (record.spread, record.kind) = (spread, record.kind | SPREAD);
        }
        Some(Candidate { record, power })
    }
    pub(super) fn pack(&self) -> PackedLight {
        let Self { place: [a, b, c], first: [d, e, f], second: [g, h, i], radiance: [red, green, blue], .. } = *self;
        [
            [a, b, c, d, e, f, g, h],
            [
                i,
                red,
                green,
                blue,
                f32::from_bits(self.kind),
                f32::from_bits(self.shape),
                self.spread.tan_half,
                self.spread.gain,
            ],
        ]
    }
    /// Whether it is a distant light.
    pub(crate) fn is_sun(&self) -> bool {
        self.kind & KINDS == DISTANT
    }
    /// Whether it is a sky.
    pub(crate) fn is_sky(&self) -> bool {
        self.kind & KINDS == SKY
    }
    /// Whether the light is infinitely far away.
    pub(crate) fn is_distant(&self) -> bool {
        self.is_sun() || self.is_sky()
    }
    /// The bound of what a light of finite extent contributes, by its power. The bound of another light has no power.
    pub(crate) fn bound(&self, power: f64) -> LightBound {
        let wide = |v: [f32; 3]| Vec3::<f64>::from(v.map(f64::from));
        let (p, u, v) = (wide(self.place), wide(self.first), wide(self.second));
        let (center, radius, normal) = match self.kind & KINDS {
            SPHERE => (p, f64::from(self.first[0]), Vec3::default()),
            TRIANGLE => {
                let center = p + (u + v) * (1.0 / 3.0);
                let corners = [p, p + u, p + v];
                (center, corners.into_iter().map(|c| (c - center).length()).fold(0.0, f64::max), u.cross(v))
            }
            PARALLELOGRAM => {
                let center = p + (u + v) * 0.5;
                (center, 0.5 * (u + v).length().max((u - v).length()), u.cross(v))
            }
            // beyond a hemisphere, a cone bounds nothing
            SPOT | DIRECTED if self.second[2] > 0.0 => (p, 0.0, u),
            _ => (p, 0.0, Vec3::default()),
        };
        let length = normal.length();
        let narrow = |v: Vec3<f64>| [v.x, v.y, v.z].map(|x| x as f32);
        let two_sided = self.kind & TWO_SIDED != 0;
        LightBound {
            center: narrow(center),
            // the rounding of the centre moves the sphere by less than this
            radius: (radius * (1.0 + 1e-6)) as f32,
            normal: narrow(if length > 0.0 { normal * (1.0 / length) } else { normal }),
            cos_cone: match self.kind & KINDS {
                SPOT | DIRECTED => self.second[2].clamp(0.0, NARROWEST),
                _ if self.kind & SPREAD != 0 => cos_cone(&self.spread),
                _ => 0.0,
            },
            two_sided: two_sided && length > 0.0,
            power: if self.is_distant() {
                0.0
            } else {
                (power as f32 * if two_sided { 0.5 } else { 1.0 }).max(f32::MIN_POSITIVE)
            },
        }
    }
}

/// The cosine, less a rounding, of an angle given by 1 − cosθ.
fn cosine_below(one_minus_cos: f32) -> f32 {
    (1.0 - one_minus_cos).next_down()
}

pub(super) fn sum(rgb: [f32; 3]) -> f64 {
    rgb.iter().map(|&x| f64::from(x)).sum()
}

/// A light as a choice of lights knows it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    /// The light.
    pub(crate) record: LightRecord,
    /// Its power in units of π; of a distant light, that of a point at the distance 1 that causes its irradiance, and of a sky, ∫L dω over
    /// all directions.
    pub(crate) power: f64,
}

impl Candidate {
    /// A sky with this ∫L dω, summed over channels.
    pub(super) fn sky(flux: f64) -> Self {
        let record = LightRecord { kind: SKY, shape: NOTHING, ..LightRecord::default() };
        Self { record, power: flux * FRAC_1_PI }
    }
}

pub(super) fn area_lights(shapes: &[Shape]) -> impl Iterator<Item = Candidate> {
    (0..).zip(shapes).filter_map(|(index, shape)| LightRecord::of(index, shape))
}

pub(super) fn delta_lights(scene: &Scene) -> Vec<Candidate> {
    let mut directed = 0;
    let light = |light: &DeltaLight| {
        let none = LightRecord { shape: NOTHING, ..LightRecord::default() };
        let (record, power) = match *light {
            DeltaLight::Point { position: place, intensity: radiance } => {
                (LightRecord { place, radiance, kind: POINT, ..none }, 4.0 * sum(radiance))
            }
            DeltaLight::Spot {
                position: place,
                axis: first,
                one_minus_cos_inner: inner,
                one_minus_cos_outer: outer,
                intensity: radiance,
            } => {
                let cone = f64::from(inner) + f64::from(outer);
                let second = [inner, outer, cosine_below(outer)];
                // a cone too narrow for numbers still has a chance
                (LightRecord { place, first, second, radiance, kind: SPOT, ..none }, cone.max(1e-30) * sum(radiance))
            }
            DeltaLight::Directed { position: place, to_light: [_, _, pole], intensity: radiance, table, cone } => {
                let shape = &scene.intensities[table as usize];
                // the narrower of two cones
                let own = (pole, shape.cos_cone());
                let (first, cos) = match cone {
                    Some(Cone { axis, one_minus_cos_outer: outer, .. }) if cosine_below(outer) >= own.1 => {
                        (axis, cosine_below(outer))
                    }
                    _ => own,
                };
                let second = [f32::from_bits(directed), 0.0, cos];
                directed += 1;
                let flux = cone.map_or_else(|| shape.flux(), |cone| [cone.flux; 3]);
                let power = (0..3).map(|k| f64::from(radiance[k]) * flux[k]).sum::<f64>() / PI;
                (LightRecord { place, first, second, radiance, kind: DIRECTED, ..none }, power)
            }
            DeltaLight::Distant { direction: place, irradiance: radiance } => {
                // of a point at the distance 1 that causes this irradiance
                (LightRecord { place, radiance, kind: DISTANT, ..none }, 4.0 * sum(radiance))
            }
        };
        Candidate { record, power }
    };
    scene.delta_lights.iter().map(light).collect()
}
