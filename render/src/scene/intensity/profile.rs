//! Intensity by direction, as photometry tells it.

use crate::packet::{V8, X8};
use etendue::Real;
use etendue::math::atan2_turns;
use std::array::from_fn;
use std::f64::consts::PI;
use std::fmt::{self, Display, Formatter};

/// Why angles and values are no profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProfileError {
    /// There are fewer than two polar angles, no azimuths, or not one value for each pair of them.
    Length,
    /// Angles do not ascend, are NaN, or are out of their range.
    Angle,
    /// A value is negative, NaN, or greater than 1e37.
    Value,
}
impl Display for ProfileError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Length => "the numbers of angles and values do not match, or are too few",
            Self::Angle => "angles do not ascend, or are out of their range",
            Self::Value => "a value is negative, NaN, or greater than 1e37",
        })
    }
}
impl std::error::Error for ProfileError {}

/// Abscissas and weights of the Gauss-Legendre quadrature of 8 points on [−1, 1], of which half are listed (Abramowitz and Stegun, 25.4).
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
];

/// The radiant intensity of a light by direction: a table over two angles, between which it is bilinear, as photometry interpolates.
///
/// Directions are those in which light travels, in the space of the profile. The polar angle is that from +z, and the azimuth that from +x
/// towards +y. IES files (LM-63) of type C have the nadir as +z; those of types A and B have their axis as z, and the polar angle is their
/// vertical angle plus 90°.
///
/// - Formula: bilinear in (polar angle, azimuth) between the angles of the table. Below the first and above the last polar angle, and
///   outside the azimuths, the light is dark. A single azimuth stands for all.
/// - Domain: 2 or more polar angles that ascend in [0, 180], in degrees; azimuths that ascend from one in (−360, 0] over at most 360°;
///   values from 0 to 1e37, in any unit.
/// - Degenerate: anything else is a [`ProfileError`]. Where all values are 0, so is the intensity.
/// - Greatest error: that of a direction that is off by 1e−6, and 4e−7 of the greatest of the four values between which it lies.
///
/// ```
/// use etendue::{Vec3, f32x8};
/// use etendue_render::scene::intensity::Profile;
/// // a downlight: 100 on the axis, dark from 60° on
/// let lamp = Profile::new(vec![0.0, 60.0], vec![0.0], vec![100.0, 0.0])?;
/// let half = lamp.intensity(Vec3::lit([0.5, 0.0, 0.75_f64.sqrt()])).to_array();
/// assert!((half[0] - 50.0).abs() < 1e-3 && lamp.cos_cone() == 0.5);
/// # Ok::<(), etendue_render::scene::intensity::ProfileError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Polar angles in degrees.
    polar: Vec<f32>,
    /// Azimuths in degrees.
    azimuth: Vec<f32>,
    /// All polar angles of the first azimuth come first.
    values: Vec<f32>,
    /// Cosines of the polar angles from which and up to which there is light, beyond ±1 at the poles.
    ends: [f32; 2],
}

/// Whether each number is greater than the one before.
fn ascend(angles: &[f32]) -> bool {
    angles.windows(2).all(|pair| pair[0] < pair[1])
}

/// Index of the interval of ascending numbers in which x lies, and the position in it, from 0 to 1.
fn interval(angles: &[f32], x: X8) -> ([usize; 8], X8) {
    let last = angles.len().saturating_sub(2);
    let index = x.to_array().map(|x| angles.partition_point(|&a| a <= x).saturating_sub(1).min(last));
    let [start, end] = [0, 1].map(|next| X8::from(index.map(|i| angles[(i + next).min(angles.len() - 1)])));
    let (zero, one, width) = (X8::lit(0.0), X8::lit(1.0), end - start);
    (index, ((x - start) / Real::blend(width.gt(zero), width, one)).clamped(zero, one))
}

impl Profile {
    /// The profile with these polar angles and azimuths in degrees, and a value for each pair: all polar angles of the first azimuth come
    /// first.
    ///
    /// # Errors
    /// See [`ProfileError`].
    pub fn new(polar: Vec<f32>, azimuth: Vec<f32>, values: Vec<f32>) -> Result<Self, ProfileError> {
        let count = polar.len().checked_mul(azimuth.len());
        let ([bottom, .., top], [first, ..], Some(count)) = (&polar[..], &azimuth[..], count) else {
            return Err(ProfileError::Length);
        };
        if values.len() != count {
            return Err(ProfileError::Length);
        }
        let last = azimuth[azimuth.len() - 1];
        let within = *bottom >= 0.0 && *top <= 180.0 && *first > -360.0 && *first <= 0.0 && last - *first <= 360.0;
        if !(within && ascend(&polar) && ascend(&azimuth)) {
            return Err(ProfileError::Angle);
        }
        if !values.iter().all(|value| (0.0..=1e37).contains(value)) {
            return Err(ProfileError::Value);
        }
        let lit = |i: &usize| values.chunks_exact(polar.len()).any(|row| row[*i] > 0.0);
        // beyond the poles rounding decides nothing
        let cos = |degrees: f32| match degrees {
            0.0 => 2.0,
            180.0 => -2.0,
            degrees => (f64::from(degrees) / 360.0).sin_cos_turns().1 as f32,
        };
        // an angle with a value lights its neighbours up to the next angles
        let ends = (0..polar.len()).find(lit).zip((0..polar.len()).rfind(lit));
        let ends = match ends {
            Some((from, to)) => [cos(polar[from.saturating_sub(1)]), cos(polar[(to + 1).min(polar.len() - 1)])],
            None => [-2.0, 2.0],
        };
        Ok(Self { polar, azimuth, values, ends })
    }

    /// Intensity in the unit directions `w`, in which light travels.
    pub fn intensity(&self, w: V8) -> X8 {
        let Self { polar, azimuth, values, ends } = self;
        let (one, [from, to]) = (X8::lit(1.0), ends.map(X8::splat));
        let mut inside = w.z.lt(from) & w.z.gt(to);
        // by the name of the trait, since the packet's own methods have other bits
        let across = Real::sqrt(Real::mul_add(w.x, w.x, w.y * w.y));
        let angle = Real::atan2(across, w.z) * X8::lit(180.0 / PI);
        let turn = atan2_turns(w.y, w.x) * X8::lit(360.0);
        // the least of the equal azimuths that is not below the first
        let before = turn - X8::lit(360.0);
        let around = Real::blend(before.ge(X8::splat(azimuth[0])), before, turn);
        // a single azimuth stands for all
        let (mut next, is_single) = (0, azimuth.len() == 1);
        if !is_single {
            inside = inside & around.le(X8::splat(azimuth[azimuth.len() - 1]));
            next = polar.len();
        }
        let ((row, t), (column, s)) = (interval(polar, angle), interval(azimuth, around));
        let value = |offset: usize| X8::from(from_fn(|lane| values[column[lane] * polar.len() + row[lane] + offset]));
        let [left, right] = [0, next].map(|offset| value(offset) * (one - t) + value(offset + 1) * t);
        (left * (one - s) + right * s).keep(inside)
    }

    /// Cosine of the angle from +z from which on the light is dark, at most 1; −1 if it may shine in all directions.
    #[must_use]
    pub fn cos_cone(&self) -> f32 {
        self.ends[1].clamp(-1.0, 1.0)
    }

    /// ∫ I dω over all directions: the power, for intensities per steradian. Exact to some 1e−14, since the quadrature between two angles of
    /// the table is exact to rounding, and sums only what is not negative.
    #[must_use]
    pub fn power(&self) -> f64 {
        let mut sum = 0.0;
        for (j, pair) in self.polar.windows(2).enumerate() {
            let [low, high] = [f64::from(pair[0]), f64::from(pair[1])];
            for [x, weight] in GAUSS.into_iter().flat_map(|[x, weight]| [[x, weight], [-x, weight]]) {
                let at = 0.5 * (low + high) + 0.5 * (high - low) * x;
                let t = (at - low) / (high - low);
                let (sin, _) = (at / 360.0).sin_cos_turns();
                sum += 0.5 * (high - low) * weight * sin * self.around(j, t);
            }
        }
        // two angles in degrees
        sum * (PI / 180.0) * (PI / 180.0)
    }

    /// The integral over all azimuths in degrees at the position t between two polar angles.
    fn around(&self, j: usize, t: f64) -> f64 {
        let value = |column: usize| {
            let [low, high] = [0, 1].map(|k| f64::from(self.values[column * self.polar.len() + j + k]));
            low * (1.0 - t) + high * t
        };
        if self.azimuth.len() == 1 {
            return value(0) * 360.0;
        }
        // the mean of a linear function is that in the middle
        let between = |(column, pair): (usize, &[f32])| {
            (f64::from(pair[1]) - f64::from(pair[0])) * (0.5 * value(column) + 0.5 * value(column + 1))
        };
        self.azimuth.windows(2).enumerate().map(between).sum()
    }
}
