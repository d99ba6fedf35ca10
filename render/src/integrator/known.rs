//! What is known of the lights without rays.

use crate::certificates::Precision;
use crate::lights::PictureIrradiance;
use etendue::occlusion::Convex;
use std::ops::Range;

/// A light with an area.
pub(super) struct AreaLight<'a> {
    pub(super) form: Convex<f32>,
    /// Radiance; its mean, if it varies.
    pub(super) radiance: [f32; 3],
    /// How its integral is known.
    pub(super) closed: Closed<'a>,
}

/// The closed form of a light's integral.
#[derive(Clone, Copy)]
pub(super) enum Closed<'a> {
    /// The radiance is constant.
    Constant,
    /// The light shows a picture. Behind blockers, the part of it that is visible is computed as if the radiance was constant, and samples
    /// correct that.
    Picture(&'a PictureIrradiance),
    /// The radiance varies by point or direction, and no closed form has its integral. The light is sampled unless it is dark.
    No,
}

/// What is known of a light, as seen from a part of a surface. What it contributes is computed in a precision that suffices there.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Known {
    Lit(Precision),
    Dark,
    /// Only these forms and bodies can occlude it.
    Behind(Range<usize>, Range<usize>, Precision),
    /// It is sampled, although its blockers are known.
    Crowded,
    /// It is sampled, unless a smaller patch decides.
    Nothing,
    /// It is sampled: smaller patches are not worth asking for.
    Never,
}

impl Known {
    /// Whether the light must be sampled.
    pub(super) const fn is_open(&self) -> bool {
        matches!(self, Self::Crowded | Self::Nothing | Self::Never)
    }
}

/// What is known of the lights at a point that the camera sees: numbers of lights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Survey {
    /// The primitive there, as in hits; nothing else counts where a path ends without a surface that reflects.
    pub place: Option<u32>,
    /// Lights that nothing can occlude.
    pub lit: u32,
    /// Lights that no point of the surface nearby sees.
    pub dark: u32,
    /// Lights with 1 to 4 possible blockers.
    pub few: u32,
    /// Lights with 5 to 8 possible blockers.
    pub many: u32,
    /// Lights with at most 16 possible blockers that are sampled, because that takes less time, because spheres overlap, because closed forms
    /// are not accurate enough, because it has a spread, or because it shows a picture behind blockers.
    pub crowded: u32,
    /// Lights of which nothing is proved.
    pub unknown: u32,
}

impl Survey {
    /// The number of lights that are sampled.
    pub fn sampled(&self) -> u32 {
        self.crowded + self.unknown
    }
    /// The number of lights.
    pub fn lights(&self) -> u32 {
        self.lit + self.dark + self.few + self.many + self.crowded + self.unknown
    }
}
