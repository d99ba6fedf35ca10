//! Flat lights whose intensity differs by direction.

use crate::intensity::Intensity;
use crate::packet::{V8, X8};
use etendue::Vec3;
use etendue::light::LuminousOpening;
use std::sync::Arc;

/// How a flat shape distributes what it emits.
#[derive(Clone, Debug, PartialEq)]
pub struct LightProfile {
    /// Rows of the orthogonal matrix from world space to that of the intensity.
    pub to_light: [[f32; 3]; 3],
    /// Relative intensities.
    pub intensity: Arc<Intensity>,
    /// What makes factors of them.
    pub opening: LuminousOpening<f32>,
}

impl LightProfile {
    /// The factor of the radiance in the unit directions `w`, in which light travels, of a shape with this unit normal.
    pub fn factor(&self, w: V8, normal: V8) -> X8 {
        let [x, y, z] = self.to_light.map(|row| V8::from(row).dot(w));
        // profiles are grey
        let intensity = self.intensity.at(Vec3::new(x, y, z)).x;
        LuminousOpening::splat(self.opening).factor(w.dot(normal), intensity)
    }
}
