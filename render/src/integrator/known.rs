//! What is known of the lights without rays.

use crate::bvh::GROUP;
use crate::certificates::Precision;
use crate::lights::PictureIrradiance;
use crate::packet::M8;
use etendue::occlusion::Convex;
use etendue::{Mask, u32x8};
use std::ops::Range;

/// A light with an area.
#[derive(Clone, Copy)]
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

/// Lanes of rough surfaces with a fit, for one light and packet.
#[derive(Clone, Copy)]
pub(super) struct Fitted {
    /// Lanes where the closed form of the fit has been added: samples add what the BSDF reflects beyond the fit.
    pub(super) counted: M8,
    /// Lanes that see all of the light, so that samples need no shadow ray.
    pub(super) lit: M8,
    /// Lanes that see nothing of the light.
    pub(super) dark: M8,
}

impl Default for Fitted {
    fn default() -> Self {
        let none = M8::splat(false);
        Self { counted: none, lit: none, dark: none }
    }
}

impl Fitted {
    /// What is known in each lane of the light with an index of its own, in a packet.
    #[inline]
    pub(super) fn of(all: &[[Self; GROUP]], packet: usize, index: u32x8) -> Self {
        let mut own = Self::default();
        for (lane, &light) in index.as_array().iter().enumerate() {
            own.join(M8::from_bits(1 << lane), &all[light as usize][packet]);
        }
        own
    }
    /// Takes these lanes of another.
    #[inline]
    pub(super) fn join(&mut self, lanes: M8, other: &Self) {
        let Self { counted, lit, dark } = self;
        for (own, other) in [(counted, other.counted), (lit, other.lit), (dark, other.dark)] {
            *own = *own & !lanes | other & lanes;
        }
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
