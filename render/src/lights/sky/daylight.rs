//! Daylight: the sky by CIE's formula.

use etendue::{Real, Vec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Gradations: a and b.
const GRADATIONS: [[f64; 2]; 6] = [[4.0, -0.7], [1.1, -0.8], [0.0, -1.0], [-1.0, -0.55], [-1.0, -0.32], [-1.0, -0.15]];
/// Indicatrices: c, d and e.
const INDICATRICES: [[f64; 3]; 6] =
    [[0.0, -1.0, 0.0], [2.0, -1.5, 0.15], [5.0, -2.5, 0.3], [10.0, -3.0, 0.45], [16.0, -3.0, 0.3], [24.0, -2.8, 0.15]];
/// Gradation and indicatrix of each type, counted from 1.
const TYPES: [[usize; 2]; 15] = [
    [1, 1],
    [1, 2],
    [2, 1],
    [2, 2],
    [3, 1],
    [3, 2],
    [3, 3],
    [3, 4],
    [4, 2],
    [4, 3],
    [4, 4],
    [5, 4],
    [5, 5],
    [6, 5],
    [6, 6],
];

/// The sky by CIE's standard general sky: how bright it is in each direction, relative to the zenith. z is up.
///
/// - Formula: φ(Z)f(χ)/(φ(0)f(Z₀)) at the angle Z from the zenith and χ from the sun, which is Z₀ from the zenith;
///   φ(Z) = 1 + a exp(b/cosZ), and f(χ) = 1 + c(exp(dχ) − exp(dπ/2)) + e cos²χ. The type of the sky gives a to e: 1 is overcast, 5 uniform, 12
///   clear, 15 turbid with a wide corona.
/// - Domain: any unit direction. 0 below the horizon.
/// - Greatest error: 1e−6 relative, in single precision.
/// - Source: ISO 15469:2004, which is CIE S 011/E:2003.
///
/// ```
/// use etendue::Vec3;
/// use etendue_render::lights::sky::GeneralSky;
/// let sky = GeneralSky::new(12, [0.6, 0.0, 0.8]).unwrap();
/// assert!((sky.luminance(Vec3::new(0.0_f32, 0.0, 1.0)) - 1.0).abs() < 1e-6);
/// assert!(sky.luminance(Vec3::new(0.6_f32, 0.0, 0.8)) > 3.0); // about the sun
/// assert_eq!(sky.luminance(Vec3::new(0.6_f32, 0.0, -0.8)), 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneralSky {
    gradation: [f64; 2],
    indicatrix: [f64; 3],
    sun: Vec3<f64>,
    /// 1/(φ(0)f(Z₀)).
    scale: f64,
}

impl GeneralSky {
    /// The sky of a type from 1 to 15 with the sun in this direction, of any length. `None` for another type, and if there is no direction.
    #[must_use]
    pub fn new(kind: u32, sun: [f64; 3]) -> Option<Self> {
        let [gradation, indicatrix] = *TYPES.get((kind as usize).checked_sub(1)?)?;
        // of any length, since its square might be none
        let most = sun.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if !(most > 0.0 && sun.iter().all(|x| x.is_finite())) {
            return None;
        }
        let sun = Vec3::from(sun.map(|x| x * most.pow2_scale())).normalize();
        let (gradation, indicatrix) = (GRADATIONS[gradation - 1], INDICATRICES[indicatrix - 1]);
        let own = Self { gradation, indicatrix, sun, scale: 1.0 };
        let zenith = own.luminance(Vec3::new(0.0, 0.0, 1.0));
        Some(Self { scale: 1.0 / zenith, ..own })
    }
    /// Luminance in this unit direction over that of the zenith; 0 below the horizon, and where the direction is NaN.
    #[inline(always)]
    pub fn luminance<R: Real>(&self, direction: Vec3<R>) -> R {
        let zero = R::lit(0.0);
        let sun = Vec3::lit([self.sun.x, self.sun.y, self.sun.z]);
        // near the sun its sine tells the angle, elsewhere its cosine does; + 0 is no −0, of which the angle would be π
        let (sin, cos) = (direction.cross(sun).length(), direction.dot(sun) + zero);
        let angle = sin.atan2(cos);
        let up = direction.z.greater(zero).lesser(R::lit(1.0));
        let above = direction.z.ge(zero) & direction.max_abs().lt(R::lit(2.0));
        let ([a, b], [c, d, e]) = (self.gradation, self.indicatrix);
        let some = up.gt(R::lit(1e-3));
        let steep = (R::lit(b) / R::blend(some, up, R::lit(1.0))).exp().keep(some);
        let gradation = R::lit(a).mul_add(steep, R::lit(1.0));
        let corona = (angle * R::lit(d)).exp() - R::lit(d * FRAC_PI_2).exp();
        let indicatrix = R::lit(c).mul_add(corona, R::lit(e).mul_add(cos * cos, R::lit(1.0)));
        (gradation * indicatrix * R::lit(self.scale)).keep(above)
    }
    /// Illuminance of the horizontal plane over the luminance of the zenith, in steradians: ∫ luminance cosZ dω, without the sun's disk.
    ///
    /// A sum over 512 × 1024 directions: within 2e−5.
    #[must_use]
    pub fn horizontal(&self) -> f64 {
        let (rows, columns) = (512, 1024);
        let (step, turn) = (FRAC_PI_2 / f64::from(rows), TAU / f64::from(columns));
        let mut sum = 0.0;
        for i in 0..rows {
            let (sin, cos) = ((f64::from(i) + 0.5) * step / TAU).sin_cos_turns();
            let row = (0..columns).map(|j| {
                let (s, c) = ((f64::from(j) + 0.5) / f64::from(columns)).sin_cos_turns();
                self.luminance(Vec3::new(sin * c, sin * s, cos))
            });
            sum += row.sum::<f64>() * sin * cos;
        }
        // ∫ sinZ cosZ dZ over a ring is exact: of a uniform sky the sum is π
        sum * (step / TAU).sin_cos_turns().0 * turn
    }
}
