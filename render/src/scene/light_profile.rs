//! Flat lights whose intensity differs by direction.

use super::intensity::{Intensity, integral};
use crate::packet::{V8, X8};
use etendue::{Real, Vec3};
use std::f64::consts::PI;
use std::sync::Arc;

/// Cosine of the angle to the normal, 85°, from which on the radiance no longer grows as the area that is seen shrinks.
const LEAST_COS: f64 = 0.087_155_742_747_658_17;

/// How a flat light emits by a table of intensities: the luminous opening of a luminaire, as LM-63 calls it, seen from near.
///
/// The radiance L of the light is multiplied by [`factor`](Self::factor). Photometry measures luminaires from so far that all of the
/// opening is in one direction, and an opening of the area A emits the intensity I there with the mean radiance I/(A cosθ). The table
/// tells only how light is distributed: the power is that of the light without it, πLA for each side that emits.
///
/// - Formula: π I(w)/(Φ max(|cosθ|, c)) with the angle θ of w to the normal, c = cos 85°, and Φ = ∫ I(w) min(|cosθ|/c, 1) dω over the
///   directions in which the light emits, half of that if both sides do. Intensities are kept but for the 5° next to the plane of the
///   light, where they fall to 0.
/// - Domain: intensities that are finite and at least 0, in any unit; beams of half a degree or more. Where the table is dark in all
///   directions of the light there is no opening.
/// - Density: none; ∫ factor · |cosθ| dω = π for each side, in the mean of both.
/// - Greatest error: that of the intensity and 1e−6. Φ is a sum over 77,760 directions of each side: to 1e−6 for tables whose polar
///   axis is the normal, by half degrees from it and by 2.5° around it; to 1e−3 for others.
///
/// ```
/// use etendue::{Vec3, f32x8};
/// use etendue_render::scene::intensity::{Intensity, Profile};
/// use etendue_render::scene::light_profile::LuminousOpening;
/// // a downlight: 100 on the axis, dark from 60° on
/// let lamp = Intensity::Angles(Profile::new(vec![0.0, 60.0], vec![0.0], vec![100.0, 0.0])?);
/// let opening = LuminousOpening::new([0.0, 0.0, 1.0], false, &lamp).unwrap();
/// // with an area of 1, the radiance on the axis is the intensity; the power πL is that of the table
/// let radiance = f32x8::splat(lamp.flux() as f32 / std::f32::consts::PI);
/// let on_axis = lamp.at(Vec3::lit([0.0, 0.0, 1.0]));
/// assert!(((radiance * opening.factor(f32x8::splat(1.0), on_axis)).to_array()[0] - 100.0).abs() < 0.01);
/// # Ok::<(), etendue_render::scene::intensity::ProfileError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LuminousOpening {
    /// π/Φ.
    pub gain: f32,
}

impl LuminousOpening {
    /// The opening of a light on one side or both. `normal` is its unit normal in the space of the intensity. `None` if there is no light.
    #[must_use]
    pub fn new(normal: [f64; 3], two_sided: bool, intensity: &Intensity) -> Option<Self> {
        let (turns, sides) = if two_sided { (0.5, 2.0) } else { (0.25, 1.0) };
        let seen = |cos: f64| X8::lit((cos.abs() / LEAST_COS).min(1.0));
        // profiles are grey
        let flux = integral(normal.into(), turns, |w, cos| intensity.at(w) * seen(cos));
        let gain = sides * PI / flux;
        (flux > 0.0 && gain < f64::from(f32::MAX)).then_some(Self { gain: gain as f32 })
    }
    /// The factor of the radiance in directions with this cosine to the normal, by the intensity there. It is finite, also in a beam that has
    /// passed between the directions of which Φ is the sum.
    pub fn factor(&self, cos: X8, intensity: X8) -> X8 {
        let seen = cos.abs().greater(X8::lit(LEAST_COS));
        (intensity * X8::splat(self.gain) / seen).lesser(X8::splat(f32::MAX))
    }
}

/// How a flat shape distributes what it emits.
#[derive(Clone, Debug, PartialEq)]
pub struct LightProfile {
    /// Rows of the orthogonal matrix from world space to that of the intensity.
    pub to_light: [[f32; 3]; 3],
    /// Relative intensities.
    pub intensity: Arc<Intensity>,
    /// What makes factors of them.
    pub opening: LuminousOpening,
}

impl LightProfile {
    /// The factor of the radiance in the unit directions `w`, in which light travels, of a shape with this unit normal.
    pub fn factor(&self, w: V8, normal: V8) -> X8 {
        let [x, y, z] = self.to_light.map(|row| V8::from(row).dot(w));
        self.opening.factor(w.dot(normal), self.intensity.at(Vec3::new(x, y, z)))
    }
}
