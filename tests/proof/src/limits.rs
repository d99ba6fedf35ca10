//! Errors of elementary functions, which the lemmas prove for all arguments.

/// The greatest error at x: an absolute one, and one times |x| where x is not subnormal. Both hold.
#[derive(Clone, Copy, Debug)]
pub struct Error {
    /// The greatest error.
    pub absolute: f64,
    /// The greatest error over |x|.
    pub slope: f64,
}
impl Error {
    /// The greatest error up to this argument.
    #[must_use]
    pub fn at(self, most: f64) -> f64 {
        self.absolute.min((self.slope * most.max(f64::from(f32::MIN_POSITIVE))).next_up())
    }
}
/// The errors of a sine and a cosine: each, and as a vector.
#[derive(Clone, Copy, Debug)]
pub struct WaveError {
    /// Error of the sine.
    pub sin: Error,
    /// Error of the cosine.
    pub cos: Error,
    /// The component of both along the true (cos, sin): the error of the length.
    pub along: Error,
    /// The component across: the error of the angle in radians.
    pub across: Error,
}
/// Sine and cosine of x turns, x in [0, 1].
pub const TURNS: WaveError = WaveError {
    sin: Error { absolute: 8.5e-8, slope: 8.5e-7 },
    cos: Error { absolute: 8.5e-8, slope: f64::INFINITY },
    along: Error { absolute: 9.6e-8, slope: f64::INFINITY },
    across: Error { absolute: 8.5e-8, slope: 9.8e-7 },
};
/// Greatest argument in quarter turns. The routines need ½, but intervals exceed it.
pub const MOST_QUARTERS: f64 = 0.51;
/// Sine and cosine of x quarter turns, |x| at most [`MOST_QUARTERS`].
pub const QUARTERS: WaveError = WaveError {
    sin: Error { absolute: 8.5e-8, slope: 2.1e-7 },
    cos: Error { absolute: 7.0e-8, slope: f64::INFINITY },
    along: Error { absolute: 9.8e-8, slope: f64::INFINITY },
    across: Error { absolute: 8.5e-8, slope: 2.5e-7 },
};
/// Greatest argument of the arc tangent: a little more than tan(π/8).
pub const EIGHTH: f64 = 0.42;
/// Arc tangent of x, |x| at most [`EIGHTH`].
pub const ATAN_EIGHTH: Error = Error { absolute: 6e-8, slope: 1.2e-7 };
