//! Radiance along camera rays, by where it comes from.

use crate::packet::{M8, V8, X8, keep};

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
    /// The same radiance where the mask is true, and 0 elsewhere.
    #[inline]
    pub(super) fn keep(&self, mask: M8) -> Self {
        Self { seen: keep(self.seen, mask), known: keep(self.known, mask), reflected: keep(self.reflected, mask) }
    }
    #[inline]
    pub(super) fn times(&self, weight: X8) -> Self {
        Self { seen: self.seen * weight, known: self.known * weight, reflected: self.reflected * weight }
    }
}
