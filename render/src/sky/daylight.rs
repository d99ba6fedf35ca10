//! Daylight: the sky by CIE's formula, and where the sun is.

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
/// use etendue_render::sky::GeneralSky;
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

/// A time, in the Gregorian calendar and universal time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// The year.
    pub year: i32,
    /// The month, from 1.
    pub month: u32,
    /// The day of the month, from 1.
    pub day: u32,
    /// Hours since midnight; any number: −1 is 23 o'clock of the day before.
    pub hours: f64,
}

impl Moment {
    /// Whether the calendar has this day, and the hours are finite.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        let is_leap = self.year % 4 == 0 && (self.year % 100 != 0 || self.year % 400 == 0);
        let days = match self.month {
            2 => 28 + u32::from(is_leap),
            4 | 6 | 9 | 11 => 30,
            1..=12 => 31,
            _ => 0,
        };
        (1..=days).contains(&self.day) && self.hours.is_finite()
    }
    /// Days since noon of 1 January 2000.
    fn days(&self) -> f64 {
        // the year begins with March, so that the day that may be missing is the last
        let year = i64::from(self.year) - i64::from(self.month < 3);
        let month = (i64::from(self.month) + 9) % 12;
        let whole = 365 * year + year.div_euclid(4) - year.div_euclid(100)
            + year.div_euclid(400)
            + (153 * month + 2) / 5
            + i64::from(self.day);
        // 1 January 2000 is day 730 426 of this count
        (whole - 730_426) as f64 - 0.5 + self.hours / 24.0
    }
}

/// Where the sun stands as seen from a place, without refraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunPosition {
    /// Angle above the horizon in radians.
    pub elevation: f64,
    /// Angle from north over east in radians, in [0, 2π).
    pub azimuth: f64,
}

impl SunPosition {
    /// The position at a time, from a latitude (north is positive) and longitude (east is positive) in degrees. `None` if the time is not
    /// [valid](Moment::is_valid), the latitude is not in [−90, 90] or the longitude not in [−180, 180].
    ///
    /// - Formula: mean longitude and anomaly, two terms of the equation of the centre, mean sidereal time.
    /// - Greatest error: 0.01° from 1950 to 2050; the sun's disk is 0.53° wide. Refraction would raise it by 0.5° at the horizon.
    /// - Source: Michalsky, "The Astronomical Almanac's Algorithm for Approximate Solar Position (1950–2050)", Solar Energy 40(3), 1988.
    ///
    /// ```
    /// use etendue_render::sky::{Moment, SunPosition};
    /// // noon in Greenwich at an equinox
    /// let time = Moment { year: 2026, month: 3, day: 20, hours: 12.0 };
    /// let sun = SunPosition::new(time, 51.48, 0.0).unwrap();
    /// assert!((sun.elevation.to_degrees() - 38.5).abs() < 0.2 && (sun.azimuth.to_degrees() - 177.3).abs() < 0.5);
    /// ```
    #[must_use]
    pub fn new(time: Moment, latitude: f64, longitude: f64) -> Option<Self> {
        if !time.is_valid() || !(-90.0..=90.0).contains(&latitude) || !(-180.0..=180.0).contains(&longitude) {
            return None;
        }
        // by the name of the trait, since the standard library's methods of f64 have other bits
        let days = time.days();
        // degrees of more than a turn keep their precision as turns
        let turn = |degrees: f64| (degrees / 360.0).sin_cos_turns();
        let anomaly = 357.528 + 0.985_600_3 * days;
        let mean = 280.46 + 0.985_647_4 * days;
        let longitude_of_sun = mean + 1.915 * turn(anomaly).0 + 0.02 * turn(2.0 * anomaly).0;
        let ((sin, cos), (tilt_sin, tilt_cos)) = (turn(longitude_of_sun), turn(23.439 - 4e-7 * days));
        let ascension = Real::atan2(tilt_cos * sin, cos);
        let height = tilt_sin * sin;
        let width = Real::sqrt(1.0 - height * height);
        let sidereal = 15.0 * (6.697_375 + 0.065_709_824_2 * days + time.hours) + longitude;
        let (h_sin, h_cos) = (sidereal / 360.0 - ascension / TAU).sin_cos_turns();
        let (lat_sin, lat_cos) = turn(latitude);
        let (east, north) = (-width * h_sin, height * lat_cos - width * lat_sin * h_cos);
        let up = height * lat_sin + width * lat_cos * h_cos;
        let azimuth = Real::atan2(east, north);
        let across = Real::sqrt(east * east + north * north);
        Some(Self { elevation: Real::atan2(up, across), azimuth: if azimuth < 0.0 { azimuth + TAU } else { azimuth } })
    }
    /// The direction to the sun: +x is east, +y north and +z up.
    #[must_use]
    pub fn direction(&self) -> [f64; 3] {
        let ((s, c), (sin, cos)) = ((self.elevation / TAU).sin_cos_turns(), (self.azimuth / TAU).sin_cos_turns());
        [c * sin, c * cos, s]
    }
}
