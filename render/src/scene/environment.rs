//! Light from infinitely far away: a sky, its portals and its sun.

use etendue::light::{EnvironmentMap, Portal};

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
