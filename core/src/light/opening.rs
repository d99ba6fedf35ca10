//! Flat lights whose intensity differs by direction.

use super::around::integral;
use crate::lanewise::lanewise;
use crate::real::{GREATEST, Real};
use crate::vector::Vec3;
use core::f64::consts::PI;

/// Cosine of the angle to the normal, 85°, from which on the radiance no longer grows as the area that is seen shrinks.
const LEAST_COS: f64 = 0.087_155_742_747_658_17;

lanewise! {
    /// How a flat light emits by a table of intensities: the luminous opening of a luminaire, as LM-63 calls it, seen from near.
    ///
    /// A host multiplies the radiance L of the light by [`factor`](Self::factor). Photometry measures luminaires from so far that all of the
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
    /// use etendue::Vec3;
    /// use etendue::light::{LuminousOpening, Profile};
    /// // a downlight: 100 on the axis, dark from 60° on
    /// let lamp = Profile::new(&[0.0, 60.0], &[0.0], &[100.0, 0.0])?;
    /// let down = Vec3::new(0.0, 0.0, 1.0);
    /// let opening = LuminousOpening::new(down, false, |w: Vec3<f32>| lamp.intensity(w)).unwrap();
    /// // with an area of 1, the radiance on the axis is the intensity; the power πL is that of the table
    /// let radiance = lamp.power() as f32 / std::f32::consts::PI;
    /// assert!((radiance * opening.factor(1.0, lamp.intensity(Vec3::new(0.0, 0.0, 1.0))) - 100.0).abs() < 0.01);
    /// # Ok::<(), etendue::light::ProfileError>(())
    /// ```
    pub struct LuminousOpening {
        /// π/Φ.
        pub gain: R,
    }
}

impl<R: Real> LuminousOpening<R> {
    /// The opening of a light on one side or both. `normal` is its unit normal in the space of the intensity, whose argument is the unit
    /// direction in which light travels. `None` if there is no light.
    #[must_use]
    pub fn new<S: Real>(normal: Vec3<f64>, two_sided: bool, intensity: impl Fn(Vec3<S>) -> S) -> Option<Self> {
        let (turns, sides) = if two_sided { (0.5, 2.0) } else { (0.25, 1.0) };
        let seen = |cos: f64| (cos.abs() / LEAST_COS).lesser(1.0);
        let flux = integral(normal, turns, |w, cos| intensity(w) * S::lit(seen(cos)));
        let gain = sides * PI / flux;
        (flux > 0.0 && gain < GREATEST).then(|| Self { gain: R::lit(gain) })
    }
    /// The factor of the radiance in a direction with this cosine to the normal, by the intensity there. It is finite, also in a beam that has
    /// passed between the directions of which Φ is the sum.
    #[inline(always)]
    pub fn factor(&self, cos: R, intensity: R) -> R {
        (intensity * self.gain / cos.abs().greater(R::lit(LEAST_COS))).lesser(R::lit(GREATEST))
    }
}
