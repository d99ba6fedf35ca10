//! Light from infinitely far away: a sky, its portals and its sun.

use super::params::MOST_RADIANCE;
use etendue::light::{EnvironmentMap, MOST_PORTALS, Portal};

/// Light from infinitely far away in all directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// Rows of the orthogonal matrix from world space to light space.
    pub to_light: [[f32; 3]; 3],
    /// Radiance by direction.
    pub sky: SkyRadiance,
    /// What the light comes through; if there are none, it comes from everywhere.
    pub portals: Vec<Portal>,
    /// A disk of light before the sky.
    pub sun: Option<SunDisk>,
}

/// A disk of constant radiance in the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunDisk {
    /// Unit vector towards its centre, in world space.
    pub direction: [f32; 3],
    /// 1 − cosσ of the angle σ that its radius spans, greater than 0.
    pub one_minus_cos: f32,
    /// Radiance in addition to the sky's, linear RGB; at least one channel is greater than 0.
    pub radiance: [f32; 3],
}

/// Radiance of an [`Environment`], linear RGB.
#[derive(Clone, Debug, PartialEq)]
pub enum SkyRadiance {
    /// The same in all directions.
    Constant([f32; 3]),
    /// An image, constant within each texel.
    Image {
        /// Number of columns.
        width: usize,
        /// How the image maps to directions.
        map: EnvironmentMap,
        /// Texels row by row; at least one channel is greater than 0.
        texels: Vec<[f32; 3]>,
    },
}

impl Environment {
    /// The sum of two skies, if one of them is the same in all directions, or if both are the same sky through other portals.
    pub(super) fn and(mut self, other: Self) -> Option<Self> {
        if !self.portals.is_empty()
            && !other.portals.is_empty()
            && (self.to_light, self.sun) == (other.to_light, other.sun)
        {
            let are_few = self.portals.len() + other.portals.len() <= MOST_PORTALS;
            if are_few && self.sky == other.sky {
                self.portals.extend(other.portals);
                return Some(self);
            }
        }
        if !(self.portals.is_empty() && other.portals.is_empty()) || self.sun.is_some() && other.sun.is_some() {
            return None;
        }
        let sun = self.sun.or(other.sun);
        let add = |a: [f32; 3], b: [f32; 3]| std::array::from_fn(|k| (a[k] + b[k]).min(MOST_RADIANCE));
        let (constant, other) = match (self.sky, other.sky) {
            (SkyRadiance::Constant(a), sky) => (a, Self { sky, ..other }),
            (sky, SkyRadiance::Constant(b)) => (b, Self { sky, to_light: self.to_light, ..other }),
            _ => return None,
        };
        let sky = match other.sky {
            SkyRadiance::Constant(b) => SkyRadiance::Constant(add(constant, b)),
            SkyRadiance::Image { width, map, texels } => {
                let texels = texels.into_iter().map(|texel| add(texel, constant)).collect();
                SkyRadiance::Image { width, map, texels }
            }
        };
        Some(Self { sky, sun, ..other })
    }
}
