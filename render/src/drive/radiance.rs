//! Radiance along camera rays, by where it comes from.

use crate::packet::{V8, X8};

/// Radiance along camera rays.
#[derive(Clone, Copy, Default)]
pub(super) struct Radiance {
    /// Radiance of the lights and the sky that the camera sees.
    pub(super) seen: V8,
    /// Radiance reflected by surfaces that is computed without samples of lights.
    pub(super) known: V8,
    /// Radiance reflected by surfaces, apart from that.
    pub(super) reflected: V8,
}

impl Radiance {
    pub(super) fn total(&self) -> V8 {
        self.seen + self.known + self.reflected
    }
    #[inline]
    pub(super) fn times(&self, weight: X8) -> Self {
        Self { seen: self.seen * weight, known: self.known * weight, reflected: self.reflected * weight }
    }
}
