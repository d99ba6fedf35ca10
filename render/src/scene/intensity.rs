//! Intensities of point lights that differ by direction, looked up in packets.

mod profile;
mod rings;

use crate::packet::{V8, X8};
use etendue::light::{EnvironmentMap, ImageEnvironment};
use etendue::{Real, SpotLight};
pub use profile::{Profile, ProfileError};
pub(crate) use rings::integral;
use std::f64::consts::TAU;

/// Relative radiant intensities by direction in the space of the light, whose greatest is 1. They all are finite and at least 0.
#[derive(Clone, Debug, PartialEq)]
pub enum Intensity {
    /// A photometric table, bilinear between its angles.
    Angles(Profile),
    /// An image of all directions, constant within each texel.
    Sphere {
        /// How the image maps to directions.
        map: EnvironmentMap,
        /// Number of columns.
        width: usize,
        /// Texels row by row.
        texels: Vec<f32>,
        /// The table by which its texels are sampled, of [`ImageEnvironment`].
        table: Vec<f32>,
    },
    /// A cone about +z that falls off by the square of a linear step of the cosine, as glTF suggests.
    Cone {
        /// 1 − cosθ of the angle θ up to which the intensity is 1.
        inner: f32,
        /// 1 − cosθ of the angle from which on it is 0; at least `inner`.
        outer: f32,
    },
}

impl Intensity {
    /// An image of all directions; `None` if it is black.
    pub fn sphere(map: EnvironmentMap, width: usize, texels: Vec<f32>) -> Option<Self> {
        let mut table = vec![0.0; ImageEnvironment::buffer(width, texels.len() / width)];
        ImageEnvironment::build(&texels, width, map, &mut table).ok()?;
        Some(Self::Sphere { map, width, texels, table })
    }
    /// Intensity in the unit direction `w`, in which light travels.
    pub fn at(&self, w: V8) -> X8 {
        match self {
            Self::Angles(profile) => profile.intensity(w),
            Self::Sphere { map, width, texels, table } => {
                let image = ImageEnvironment::from_buffer(table, *width, *map).expect("a table of its own size");
                let texel = image.texel(w);
                let (x, y) = (texel.x.to_array(), texel.y.to_array());
                X8::from(std::array::from_fn(|lane| texels[y[lane] as usize * width + x[lane] as usize]))
            }
            Self::Cone { inner, outer } => {
                // 1 − cosθ, which is precise for narrow cones
                let above = w.x.mul_add(w.x, w.y * w.y) / (X8::splat(1.0) + w.z.abs());
                let away = Real::blend(w.z.lt(X8::splat(0.0)), X8::splat(1.0) - w.z, above);
                // a step where both angles are equal
                let width = X8::splat((outer - inner).max(f32::MIN_POSITIVE));
                let t = ((X8::splat(*outer) - away) / width).clamped(X8::splat(0.0), X8::splat(1.0));
                t * t
            }
        }
    }
    /// ∫I dω.
    pub fn flux(&self) -> f64 {
        match self {
            Self::Angles(profile) => profile.power(),
            Self::Sphere { map, width, texels, .. } => {
                let height = texels.len() / width;
                let row = |(y, row): (usize, &[f32])| {
                    row.iter().map(|&x| f64::from(x)).sum::<f64>() * map.texel_solid_angle(*width, height, y)
                };
                texels.chunks(*width).enumerate().map(row).sum()
            }
            // the mean of t² over t is a third
            Self::Cone { inner, outer } => TAU / 3.0 * (2.0 * f64::from(*inner) + f64::from(*outer)),
        }
    }
    /// ∫I·falloff dω within the cone of a spot light: its power, for intensities per steradian. It is a sum over 6,912
    /// directions or more in the cone: to 1e−5 for tables whose polar axis is that of the light, by half degrees from it and by 2.5° around
    /// it, and to 1e−3 for others. Beams of less than half a degree may pass between these directions.
    pub fn flux_of_spot(&self, light: &SpotLight<f32>) -> f64 {
        let light = light.map(f64::from);
        let turns = Real::acos((1.0 - light.one_minus_cos_outer).clamp(-1.0, 1.0)) / TAU;
        integral(light.axis, turns, |w, cos| self.at(w) * X8::lit(light.falloff_at(1.0 - cos)))
    }
    /// Cosine of an angle to +z from which on it is dark; −1 if it may shine in all directions.
    pub fn cos_cone(&self) -> f32 {
        match self {
            Self::Angles(profile) => profile.cos_cone(),
            Self::Sphere { .. } => -1.0,
            Self::Cone { outer, .. } => (1.0 - outer).next_down(),
        }
    }
}
