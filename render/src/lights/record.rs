//! A light as it is kept in memory, and what a choice of lights knows of it.

use crate::bvh::PrimitiveId;
use crate::geometry::Extent;
use crate::geometry::spread::Spread;
use etendue::Vec3;

/// The bits of the kind in a record. Those of shapes are their [`Kind`](crate::geometry::Kind); the others follow. Flags are beyond.
pub(super) const KINDS: u32 = 15;
pub(super) const POINT: u32 = 8;
pub(super) const SPOT: u32 = 9;
pub(super) const SUN: u32 = 10;
pub(super) const SKY: u32 = 11;
pub(super) const DIRECTED: u32 = 12;
pub(super) const TWO_SIDED: u32 = 16;
pub(super) const SPREAD: u32 = 32;
pub(super) const PICTURED: u32 = 64;
pub(super) const PROFILED: u32 = 128;
pub(super) const UNSEEN: u32 = 256;

/// A flag as it is in sets of kinds, whose first bits are one for each kind.
pub(super) const fn in_set(flag: u32) -> u32 {
    flag << 11
}

/// A light. The file of its kind, or of its form, says what the three vectors are.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LightRecord {
    pub(super) place: [f32; 3],
    pub(super) first: [f32; 3],
    pub(super) second: [f32; 3],
    /// Radiance, the mean of a picture; intensity of a point or spot light, the greatest of a directed light, irradiance of a distant
    /// light.
    pub(super) radiance: [f32; 3],
    /// Its spread, where [`SPREAD`] is set; with a profile, the cone beyond which that is dark.
    pub(super) spread: Spread<f32>,
    /// Its kind, [`TWO_SIDED`], [`SPREAD`], [`PICTURED`], [`PROFILED`] and [`UNSEEN`].
    pub(super) kind: u32,
    /// Its shape, if it has one.
    pub(super) primitive: PrimitiveId,
    /// Its power in units of π; of a distant light, that of a point at the distance 1 that causes its irradiance, and of a sky, ∫L dω over
    /// all directions.
    pub(crate) power: f64,
}

/// A [`LightRecord`] in two halves of eight numbers: two transpositions gather eight lights. [`Chosen::new`](super::Chosen::new) unpacks it.
pub(super) type PackedLight = [[f32; 8]; 2];

impl LightRecord {
    /// A light that is no shape.
    pub(super) fn bare(kind: u32, place: [f32; 3], radiance: [f32; 3], power: f64) -> Self {
        Self { kind, place, radiance, power, primitive: PrimitiveId::NONE, ..Self::default() }
    }
    /// What it is, unless it is somewhere.
    pub(crate) const fn far(&self) -> Option<Far> {
        match self.kind & KINDS {
            SUN => Some(Far::Sun),
            SKY => Some(Far::Sky),
            _ => None,
        }
    }
    /// The direction to a sun.
    pub(crate) const fn direction(&self) -> [f32; 3] {
        self.place
    }
    /// Its three vectors.
    pub(super) const fn vectors(&self) -> [[f32; 3]; 3] {
        [self.place, self.first, self.second]
    }
    /// The extent of a light without an area that shines in all directions.
    pub(super) fn point(&self) -> Extent {
        Extent { center: wide(self.place), radius: 0.0, normal: Vec3::default() }
    }
    pub(super) fn pack(&self) -> PackedLight {
        let Self { place: [a, b, c], first: [d, e, f], second: [g, h, i], radiance: [red, green, blue], .. } = *self;
        let (kind, shape) = (f32::from_bits(self.kind), self.primitive.to_float());
        [[a, b, c, d, e, f, g, h], [i, red, green, blue, kind, shape, self.spread.tan_half, self.spread.gain]]
    }
}

/// A light infinitely far away.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Far {
    Sun,
    Sky,
}

pub(super) fn wide(v: [f32; 3]) -> Vec3<f64> {
    v.map(f64::from).into()
}

pub(super) fn sum(rgb: [f32; 3]) -> f64 {
    rgb.iter().map(|&x| f64::from(x)).sum()
}
