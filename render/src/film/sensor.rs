//! What a pixel measures: radiance, irradiance or power.
//!
//! The film lies at the distance z behind the lens where its shorter side spans the camera's field of view. The scene sets the
//! film's diagonal (35 mm by default). Camera space is in metres, as in pbrt.

use crate::camera::{CameraSample, Slopes};
use crate::named::named;
use crate::packet::X8;
use crate::scene;
use etendue::Real;
use std::f64::consts::PI;

named! {
    /// The quantity that a pixel measures.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum Sensor {
        /// Mean radiance over pixel and lens, W/(m² sr)
        #[default]
        Radiance = "radiance",
        /// Mean irradiance of the film over the pixel, W/m²
        Irradiance = "irradiance",
        /// Power incident on the pixel, W
        Power = "power",
    }
}

/// The weight of radiance that arrives at the film through a lens.
///
/// E(p) = ∫ L cosθ cosθ' / ‖p' − p‖² dA' over points p' of the exit pupil, which is the lens. Film and lens are parallel at distance
/// z, so E(p) = z² ∫ L / ‖p' − p‖⁴ dA'. In units of z, with p' = k ℓ for ℓ in the unit disk, k = r/z, and p = −t, E is π k² times
/// the mean of L / (1 + ‖k ℓ + t‖²)². For small k that is π k² L cos⁴θ.
#[derive(Clone, Copy, Debug)]
pub struct Exposure {
    /// Radius of the lens over its distance from the film.
    ratio: f64,
    slopes: Slopes,
    /// Area over which irradiance is integrated: that of a pixel in m² for power, 1 for irradiance.
    area: f64,
}

impl Exposure {
    /// The exposure of an image of `width` × `height` square pixels on a film of this diagonal in millimetres; `None` for radiance,
    /// which needs no weight. All weights of a pinhole are 0.
    #[must_use]
    pub fn new(
        sensor: Sensor,
        camera: &scene::CameraSettings,
        diagonal: f64,
        [width, height]: [u32; 2],
    ) -> Option<Self> {
        let [left, right, ..] = camera.edges(width, height);
        let [w, h] = [width, height].map(f64::from);
        let pitch = 1e-3 * diagonal / libm::hypot(w, h);
        let distance = pitch * w / (right - left);
        let area = match sensor {
            Sensor::Radiance => return None,
            Sensor::Irradiance => 1.0,
            Sensor::Power => pitch * pitch,
        };
        let ratio = camera.lens.map_or(0.0, |lens| lens.radius) / distance;
        Some(Self { ratio, slopes: Slopes::new(camera, width, height), area })
    }
    /// The same weights, for positions that are counted from this pixel.
    #[must_use]
    pub fn counted_from(&self, pixel: [u32; 2]) -> Self {
        Self { slopes: self.slopes.counted_from(pixel), ..*self }
    }
    /// The value at the middle of the film if all radiance is 1: π sin²α with tan α = k, times the pixel's area for power.
    #[must_use]
    pub fn on_axis(&self) -> f64 {
        PI * self.ratio.powi(2) / (1.0 + self.ratio.powi(2)) * self.area
    }
    /// The weights by which the radiance of eight samples contributes to the measurement.
    #[inline]
    pub fn weight(&self, CameraSample { film, lens }: &CameraSample) -> X8 {
        let q = *lens * X8::lit(self.ratio) + self.slopes.at(film.x, film.y);
        let square = X8::lit(1.0) + q.length_squared();
        X8::lit(PI * self.ratio.powi(2) * self.area) / (square * square)
    }
}
