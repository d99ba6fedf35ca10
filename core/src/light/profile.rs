//! Intensity by direction, as photometry tells it.

use super::environment::EnvironmentMap;
use crate::math::atan2_turns;
use crate::memory::{Memory, last_up_to};
use crate::real::{Real, Uint};
use crate::vector::Vec3;
use core::fmt::{self, Display, Formatter};

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
impl core::error::Error for ProfileError {}

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
/// vertical angle plus 90°. A host turns directions into this space. [`PointLight::by_profile`](super::PointLight::by_profile) samples a
/// light with a profile.
///
/// - Formula: bilinear in (polar angle, azimuth) between the angles of the table. Below the first and above the last polar angle, and
///   outside the azimuths, the light is dark. A single azimuth stands for all.
/// - Domain: 2 or more polar angles that ascend in [0, 180], in degrees; azimuths that ascend from one in (−360, 0] over at most 360°;
///   values from 0 to 1e37, in any unit.
/// - Degenerate: anything else is a [`ProfileError`]. Where all values are 0, so is the intensity.
/// - Greatest error: that of a direction that is off by 1e−6, and 4e−7 of the greatest of the four values between which it lies.
///
/// To sample it, as light tracing does, build an [`ImageEnvironment`](super::ImageEnvironment) over its [`means`](Self::means): its pdf is
/// exactly that of its directions, it has an inverse, and every direction with an intensity can be drawn.
///
/// ```
/// use etendue::light::{EnvironmentMap, ImageEnvironment, Profile};
/// use etendue::{Vec2, Vec3, Warp};
/// // a downlight: 100 on the axis, dark from 60° on
/// let lamp = Profile::new(&[0.0, 60.0], &[0.0], &[100.0, 0.0])?;
/// let half = lamp.intensity(Vec3::new(0.5_f32, 0.0, 0.75_f32.sqrt()));
/// assert!((half - 50.0).abs() < 1e-3 && lamp.cos_cone() == 0.5);
///
/// let (mut means, mut buffer) = ([0.0; 64 * 2], [0.0; ImageEnvironment::buffer(2, 64)]);
/// lamp.means(2, &mut means)?;
/// let emission = ImageEnvironment::build(&means, 2, EnvironmentMap::Equirectangular, &mut buffer)?;
/// let w = emission.sample(Vec2::new(0.3_f32, 0.6));
/// let flux = lamp.intensity(w) / emission.pdf(w);
/// assert!((f64::from(flux) / lamp.power() - 1.0).abs() < 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Profile<'a> {
    polar: &'a [f32],
    azimuth: &'a [f32],
    values: &'a [f32],
    /// Cosines of the polar angles from which and up to which there is light.
    cos: [f32; 2],
}

/// Whether each number is greater than the one before.
fn ascend(angles: &[f32]) -> bool {
    angles.windows(2).all(|pair| pair[0] < pair[1])
}

/// The position of x between two numbers, from 0 to 1.
#[inline(always)]
fn position<R: Real>(x: R, [start, end]: [R; 2]) -> R {
    let width = end - start;
    let t = (x - start) / R::blend(width.gt(R::lit(0.0)), width, R::lit(1.0));
    t.clamped(R::lit(0.0), R::lit(1.0))
}

/// Index of the interval of ascending numbers in which x lies, and the position in it, from 0 to 1.
#[inline(always)]
fn interval<R: Real>(angles: &[f32], x: R) -> (R::Uint, R) {
    let last = angles.len().saturating_sub(2);
    let index = R::Uint::from_fn(|lane| {
        let x = x.lane_f64(lane);
        (angles.partition_point(|&a| f64::from(a) <= x).saturating_sub(1).min(last)) as u32
    });
    let at = |next: usize| {
        R::from_fn(|lane| {
            let i = (index.lane(lane) as usize + next).min(angles.len() - 1);
            R::Scalar::lit(f64::from(angles[i]))
        })
    };
    (index, position(x, [at(0), at(1)]))
}

/// A table of intensities in memory.
trait Table<R: Real> {
    /// Cosines of the polar angles from which and up to which there is light.
    fn ends(&self) -> [R; 2];
    /// The first azimuth.
    fn first(&self) -> R;
    /// The mask, where an azimuth is not beyond the last one.
    fn up_to_last(&self, mask: R::Mask, azimuth: R) -> R::Mask;
    /// The intervals of a polar angle and an azimuth, and the positions in them.
    fn intervals(&self, polar: R, azimuth: R) -> [(R::Uint, R); 2];
    /// The values where intervals begin and end: for the first azimuth and the second one, at both polar angles.
    fn values(&self, interval: [R::Uint; 2]) -> [[R; 2]; 2];

    /// Intensity in the unit direction `w`.
    #[inline(always)]
    fn intensity_of(&self, w: Vec3<R>) -> R {
        let (one, [from, to]) = (R::lit(1.0), self.ends());
        let inside = w.z.lt(from) & w.z.gt(to);
        let degrees = R::lit(180.0 / core::f64::consts::PI);
        let polar = w.x.mul_add(w.x, w.y * w.y).sqrt().atan2(w.z) * degrees;
        let turn = atan2_turns(w.y, w.x) * R::lit(360.0);
        // the least of the equal azimuths that is not below the first
        let before = turn - R::lit(360.0);
        let azimuth = R::blend(before.ge(self.first()), before, turn);
        let inside = self.up_to_last(inside, azimuth);
        let [(row, t), (column, s)] = self.intervals(polar, azimuth);
        let [left, right] = self.values([row, column]).map(|[a, b]| a * (one - t) + b * t);
        (left * (one - s) + right * s).keep(inside)
    }
}

impl<R: Real> Table<R> for Profile<'_> {
    #[inline(always)]
    fn ends(&self) -> [R; 2] {
        self.cos.map(|x| R::lit(f64::from(x)))
    }
    #[inline(always)]
    fn first(&self) -> R {
        R::lit(f64::from(self.azimuth[0]))
    }
    #[inline(always)]
    fn up_to_last(&self, mask: R::Mask, azimuth: R) -> R::Mask {
        let last = R::lit(f64::from(self.azimuth[self.azimuth.len() - 1]));
        if self.azimuth.len() == 1 { mask } else { mask & azimuth.le(last) }
    }
    #[inline(always)]
    fn intervals(&self, polar: R, azimuth: R) -> [(R::Uint, R); 2] {
        [interval(self.polar, polar), interval(self.azimuth, azimuth)]
    }
    #[inline(always)]
    fn values(&self, [row, column]: [R::Uint; 2]) -> [[R; 2]; 2] {
        // a single azimuth stands for all
        let next = if self.azimuth.len() == 1 { 0 } else { self.polar.len() };
        let value = |offset: usize| {
            R::from_fn(|lane| {
                let (row, column) = (row.lane(lane) as usize, column.lane(lane) as usize);
                R::Scalar::lit(f64::from(self.values[column * self.polar.len() + row + offset]))
            })
        };
        [[value(0), value(1)], [value(next), value(next + 1)]]
    }
}

/// A [`Profile`] as words in [memory](crate::memory): what is read where number types write sources.
///
/// Of single precision, intensities have the bits of the profile.
///
/// - Domain: the memory has what [`Profile::words`] returns.
/// - Degenerate: any other contents give any intensity.
///
/// ```
/// use etendue::Vec3;
/// use etendue::light::{Profile, ProfileWords};
/// let lamp = Profile::new(&[0.0, 60.0], &[0.0], &[100.0, 0.0])?;
/// let words: Vec<u32> = lamp.words().collect();
/// let same = ProfileWords { memory: &words[..], first: 0, angles: [2, 1] };
/// let w = Vec3::new(0.5_f32, 0.0, 0.75_f32.sqrt());
/// assert_eq!(same.intensity(w), lamp.intensity(w));
/// # Ok::<(), etendue::light::ProfileError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ProfileWords<M, U> {
    /// The memory.
    pub memory: M,
    /// Index of the first word of the profile.
    pub first: U,
    /// Numbers of polar angles, at least 2, and of azimuths, at least 1.
    pub angles: [U; 2],
}

impl<M, U: Uint> ProfileWords<M, U> {
    /// Intensity in the unit direction `w`, in which light travels.
    #[inline]
    pub fn intensity<R: Real<Uint = U>>(&self, w: Vec3<R>) -> R
    where
        M: Memory<R>,
    {
        self.intensity_of(w)
    }
    /// Index of a word of the profile.
    #[inline(always)]
    fn at(&self, k: U) -> U {
        self.first.wrapping_add(k)
    }
    /// Index of the first azimuth.
    #[inline(always)]
    fn azimuths(&self) -> U {
        self.at(U::splat(2)).wrapping_add(self.angles[0])
    }
    /// Whether there are several azimuths.
    #[inline(always)]
    fn are_several<R: Real<Uint = U>>(&self) -> R::Mask {
        R::has_bits(U::splat(1).lt(self.angles[1]))
    }
}

impl<R: Real, M: Memory<R>> Table<R> for ProfileWords<M, R::Uint> {
    #[inline(always)]
    fn ends(&self) -> [R; 2] {
        [0, 1].map(|k| self.memory.number(self.at(R::Uint::splat(k))))
    }
    #[inline(always)]
    fn first(&self) -> R {
        self.memory.number(self.azimuths())
    }
    #[inline(always)]
    fn up_to_last(&self, mask: R::Mask, azimuth: R) -> R::Mask {
        let last = self.azimuths().wrapping_add(self.angles[1]).wrapping_sub(R::Uint::splat(1));
        mask & (!self.are_several::<R>() | azimuth.le(self.memory.number(last)))
    }
    #[inline(always)]
    fn intervals(&self, polar: R, azimuth: R) -> [(R::Uint, R); 2] {
        let one = R::Uint::splat(1);
        let interval = |first: R::Uint, count: R::Uint, x: R| {
            // of one number, none
            let several = R::has_bits(one.lt(count));
            let intervals = R::blend_uint(several, count.wrapping_sub(one), one);
            let index = last_up_to(&self.memory, first, intervals, x);
            let start = first.wrapping_add(index);
            let end = R::blend_uint(several, start.wrapping_add(one), start);
            (index, position(x, [self.memory.number(start), self.memory.number(end)]))
        };
        let polar = interval(self.at(R::Uint::splat(2)), self.angles[0], polar);
        [polar, interval(self.azimuths(), self.angles[1], azimuth)]
    }
    #[inline(always)]
    fn values(&self, [row, column]: [R::Uint; 2]) -> [[R; 2]; 2] {
        let (one, [rows, columns]) = (R::Uint::splat(1), self.angles);
        let next = R::blend_uint(self.are_several::<R>(), rows, R::Uint::splat(0));
        let left = self.azimuths().wrapping_add(columns).wrapping_add(column.wrapping_mul(rows)).wrapping_add(row);
        let pair = |at: R::Uint| [self.memory.number(at), self.memory.number(at.wrapping_add(one))];
        [pair(left), pair(left.wrapping_add(next))]
    }
}

impl<'a> Profile<'a> {
    /// The profile with these polar angles and azimuths in degrees, and a value for each pair: all polar angles of the first azimuth come
    /// first.
    ///
    /// # Errors
    /// See [`ProfileError`].
    pub fn new(polar: &'a [f32], azimuth: &'a [f32], values: &'a [f32]) -> Result<Self, ProfileError> {
        let count = polar.len().checked_mul(azimuth.len());
        let ([bottom, .., top], [first, ..], Some(count)) = (polar, azimuth, count) else {
            return Err(ProfileError::Length);
        };
        if values.len() != count {
            return Err(ProfileError::Length);
        }
        let last = azimuth[azimuth.len() - 1];
        let within = *bottom >= 0.0 && *top <= 180.0 && *first > -360.0 && *first <= 0.0 && last - *first <= 360.0;
        if !(within && ascend(polar) && ascend(azimuth)) {
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
        let cos = match ends {
            Some((from, to)) => [cos(polar[from.saturating_sub(1)]), cos(polar[(to + 1).min(polar.len() - 1)])],
            None => [-2.0, 2.0],
        };
        Ok(Self { polar, azimuth, values, cos })
    }
    /// The profile of a table that [`new`](Self::new) has accepted before, and its [`ends`](Self::ends) then, in no time. Of other tables,
    /// intensities are any numbers, or a panic where values are missing.
    #[inline]
    #[must_use]
    pub fn from_checked(polar: &'a [f32], azimuth: &'a [f32], values: &'a [f32], ends: [f32; 2]) -> Self {
        Self { polar, azimuth, values, cos: ends }
    }
    /// What [`from_checked`](Self::from_checked) takes: cosines of the polar angles from which and up to which there is light, beyond ±1
    /// at the poles.
    #[must_use]
    pub fn ends(&self) -> [f32; 2] {
        self.cos
    }

    /// Intensity in the unit direction `w`, in which light travels.
    #[inline(always)]
    pub fn intensity<R: Real>(&self, w: Vec3<R>) -> R {
        self.intensity_of(w)
    }
    /// The profile as words: the [`ends`](Self::ends), the polar angles, the azimuths, and the values, each by its bits. What other devices
    /// read.
    pub fn words(&self) -> impl Iterator<Item = u32> + use<'a> {
        let Self { polar, azimuth, values, cos } = *self;
        cos.into_iter().chain([polar, azimuth, values].into_iter().flatten().copied()).map(f32::to_bits)
    }

    /// Cosine of the angle from +z from which on the light is dark, at most 1; −1 if it may shine in all directions.
    #[must_use]
    pub fn cos_cone(&self) -> f32 {
        self.cos[1].clamped(-1.0, 1.0)
    }

    /// ∫ I dω over all directions: the power, for intensities per steradian. Exact to some 1e−14.
    #[must_use]
    pub fn power(&self) -> f64 {
        self.integral([0.0, 180.0], [0.0, 360.0])
    }

    /// Fills an image with the mean of the intensity over each texel of an
    /// [`Equirectangular`](super::EnvironmentMap::Equirectangular) map with so many columns, row by row. A texel in which there is light has
    /// a mean greater than 0, unless its means are too small for a number in single precision, where the least one stands for it.
    ///
    /// # Errors
    /// [`ProfileError::Length`] if the image has no texels, or no whole number of rows.
    pub fn means(&self, width: usize, means: &mut [f32]) -> Result<(), ProfileError> {
        if width == 0 || means.is_empty() || !means.len().is_multiple_of(width) {
            return Err(ProfileError::Length);
        }
        let height = means.len() / width;
        let edge = |i: usize, n: usize, whole: f64| i as f64 / n as f64 * whole;
        for (y, row) in means.chunks_exact_mut(width).enumerate() {
            let polar = [edge(y, height, 180.0), edge(y + 1, height, 180.0)];
            let solid_angle = EnvironmentMap::Equirectangular.texel_solid_angle(width, height, y);
            for (x, mean) in row.iter_mut().enumerate() {
                let integral = self.integral(polar, [edge(x, width, 360.0), edge(x + 1, width, 360.0)]);
                let least = if integral > 0.0 { f32::MIN_POSITIVE } else { 0.0 };
                *mean = ((integral / solid_angle) as f32).clamped(least, f32::MAX);
            }
        }
        Ok(())
    }

    /// ∫ I dω between two polar angles and two azimuths in [0, 360]. The quadrature between two angles of the table is exact to rounding, and
    /// sums only what is not negative.
    fn integral(&self, polar: [f64; 2], azimuth: [f64; 2]) -> f64 {
        let mut sum = 0.0;
        for (j, pair) in self.polar.windows(2).enumerate() {
            let [low, high] = [f64::from(pair[0]), f64::from(pair[1])];
            let (from, to) = (low.greater(polar[0]), high.lesser(polar[1]));
            if from >= to {
                continue;
            }
            for [x, weight] in GAUSS.into_iter().flat_map(|[x, weight]| [[x, weight], [-x, weight]]) {
                let at = 0.5 * (from + to) + 0.5 * (to - from) * x;
                let t = (at - low) / (high - low);
                let (sin, _) = (at / 360.0).sin_cos_turns();
                sum += 0.5 * (to - from) * weight * sin * self.around(j, t, azimuth);
            }
        }
        // two angles in degrees
        sum * (core::f64::consts::PI / 180.0) * (core::f64::consts::PI / 180.0)
    }

    /// The integral over azimuths in degrees at the position t between two polar angles.
    fn around(&self, j: usize, t: f64, azimuth: [f64; 2]) -> f64 {
        let value = |column: usize| {
            let [low, high] = [0, 1].map(|k| f64::from(self.values[column * self.polar.len() + j + k]));
            low * (1.0 - t) + high * t
        };
        if self.azimuth.len() == 1 {
            return value(0) * (azimuth[1] - azimuth[0]);
        }
        let mut sum = 0.0;
        for (column, pair) in self.azimuth.windows(2).enumerate() {
            let [low, high] = [f64::from(pair[0]), f64::from(pair[1])];
            for turn in [0.0, -360.0] {
                let (from, to) = (low.greater(azimuth[0] + turn), high.lesser(azimuth[1] + turn));
                if from < to {
                    // the mean of a linear function is that in the middle
                    let s = (0.5 * (from + to) - low) / (high - low);
                    sum += (to - from) * (value(column) * (1.0 - s) + value(column + 1) * s);
                }
            }
        }
        sum
    }
}
