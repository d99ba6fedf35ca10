//! 106-bit arithmetic on pairs of f64, accurate to about 2⁻¹⁰⁴, and vectors of such numbers. Source: Dekker 1971; Knuth, TAOCP 2, 4.2.2.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// An unevaluated sum of two f64.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dd(f64, f64);

fn two_sum(a: f64, b: f64) -> Dd {
    let s = a + b;
    let t = s - a;
    Dd(s, (a - (s - t)) + (b - t))
}

impl Dd {
    /// Rounds to f64.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        self.0 + self.1
    }
    /// Square root by one Newton step.
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.0 <= 0.0 {
            return Self(0.0, 0.0);
        }
        let x = self.0.sqrt();
        let rest = self - Self(x, 0.0) * Self(x, 0.0);
        Self(x, 0.0) + Self(rest.to_f64() / (2.0 * x), 0.0)
    }
    /// Angle of (x, y) = (`other`, `self`): the f64 arc tangent, corrected by its sine and cosine.
    #[must_use]
    pub fn atan2(self, other: Self) -> Self {
        let angle = self.to_f64().atan2(other.to_f64());
        let (s, c) = Self(angle, 0.0).sin_cos();
        let length = (self * self + other * other).sqrt();
        if length.to_f64() > 0.0 { Self(angle, 0.0) + (self * c - other * s) / length } else { Self(angle, 0.0) }
    }
    /// Sine and cosine by their series at a sixteenth of the angle, followed by doublings.
    #[must_use]
    pub fn sin_cos(self) -> (Self, Self) {
        let part = Self(self.0 / 16.0, self.1 / 16.0);
        let square = part * part;
        let (mut s, mut versine, mut term) = (part, Self::default(), part);
        // until the terms are below the last bits
        let mut k = 1.0;
        while k < 14.0 && term.0.abs() > part.0.abs() * f64::EPSILON * f64::EPSILON {
            let even = (term * part).over(2.0 * k);
            term = -(term * square).over(2.0 * k * (2.0 * k + 1.0));
            versine = versine + even;
            s = s + term;
            k += 1.0;
        }
        for _ in 0..4 {
            let c = Self(1.0, 0.0) - versine;
            (s, versine) = (s * c + s * c, s * s + s * s);
        }
        (s, Self(1.0, 0.0) - versine)
    }
    /// The quotient by an f64.
    fn over(self, divisor: f64) -> Self {
        let q = self.0 / divisor;
        let rest = (-q).mul_add(divisor, self.0) + self.1;
        two_sum(q, rest / divisor)
    }
    /// Absolute value.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.0 < 0.0 { -self } else { self }
    }
}

impl From<f64> for Dd {
    fn from(x: f64) -> Self {
        Self(x, 0.0)
    }
}
impl Add for Dd {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        let (high, low) = (two_sum(self.0, o.0), two_sum(self.1, o.1));
        let s = two_sum(high.0, high.1 + low.0);
        two_sum(s.0, s.1 + low.1)
    }
}
impl Neg for Dd {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}
impl Sub for Dd {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}
impl Mul for Dd {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let p = self.0 * o.0;
        let e = self.0.mul_add(o.0, -p);
        two_sum(p, e + (self.0 * o.1 + self.1 * o.0))
    }
}
impl Div for Dd {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let q = self.0 / o.0;
        let rest = self - Self(q, 0.0) * o;
        two_sum(q, rest.to_f64() / o.0)
    }
}

/// A vector of 106-bit numbers.
pub type Dd3 = [Dd; 3];

/// Converts a vector from f64.
#[must_use]
pub fn dd(a: [f64; 3]) -> Dd3 {
    a.map(Dd::from)
}

/// Rounds a vector to f64.
#[must_use]
pub fn narrow(a: Dd3) -> [f64; 3] {
    a.map(Dd::to_f64)
}

/// A number of 53 or of 106 bits, of which vectors are.
pub trait Number:
    Copy
    + Default
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Rounds to f64.
    fn to_f64(self) -> f64;
    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Angle of (x, y) = (`other`, `self`).
    #[must_use]
    fn atan2(self, other: Self) -> Self;
}
macro_rules! number {
    ($number:ident, $to_f64:expr) => {
        impl Number for $number {
            fn to_f64(self) -> f64 {
                $to_f64(self)
            }
            fn sqrt(self) -> Self {
                Self::sqrt(self)
            }
            fn atan2(self, other: Self) -> Self {
                Self::atan2(self, other)
            }
        }
    };
}
number!(f64, |x| x);
number!(Dd, Dd::to_f64);

/// a + b.
pub fn add<T: Number>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    core::array::from_fn(|i| a[i] + b[i])
}

/// a − b.
pub fn sub<T: Number>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    core::array::from_fn(|i| a[i] - b[i])
}

/// sa.
pub fn times<T: Number>(a: [T; 3], s: T) -> [T; 3] {
    a.map(|x| x * s)
}

/// |a|.
pub fn length<T: Number>(a: [T; 3]) -> T {
    dot(a, a).sqrt()
}

/// a/|a|, or a if |a| is 0.
#[must_use]
pub fn normalized<T: Number>(a: [T; 3]) -> [T; 3] {
    let l = length(a);
    if l.to_f64() > 0.0 { a.map(|x| x / l) } else { a }
}

/// a·b.
pub fn dot<T: Number>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a×b.
pub fn cross<T: Number>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Two unit vectors perpendicular to the unit vector `n`.
#[must_use]
pub fn basis<T: Number>(n: [T; 3]) -> ([T; 3], [T; 3]) {
    let helper = if n[0].to_f64().abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let s = normalized(cross(helper.map(T::from), n));
    (s, cross(n, s))
}

/// a·(b×c).
#[must_use]
pub fn determinant(a: Dd3, b: Dd3, c: Dd3) -> Dd {
    dot(a, cross(b, c))
}

/// `v + Σ eᵢ`, unrounded.
#[must_use]
pub fn exact_sum(v: [f64; 3], e: &[[f64; 3]]) -> Dd3 {
    e.iter().fold(dd(v), |sum, e| add(sum, dd(*e)))
}

#[cfg(test)]
mod tests {
    use super::*;
    /// Sines and cosines to 106 bits, as sums of two f64.
    #[test]
    fn sines_and_cosines() {
        for (x, sin, cos) in [
            (1e-8, [1e-8, -1.666_666_666_666_666_8e-25], [1.0, -5e-17]),
            (
                0.75,
                [0.681_638_760_023_334_1, 4.410_467_313_197_903e-17],
                [0.731_688_868_873_820_9, -1.047_582_430_651_276_8e-17],
            ),
            (
                2.5,
                [0.598_472_144_103_956_5, -5.521_403_334_082_375e-17],
                [-0.801_143_615_546_933_7, -1.867_474_270_508_555_4e-17],
            ),
            (
                6.25,
                [-0.033_179_216_547_556_82, -5.874_750_421_802_62e-20],
                [0.999_449_418_224_499_4, 1.186_959_728_790_143_1e-17],
            ),
        ] {
            let found = Dd::from(x).sin_cos();
            for (found, [high, low]) in [(found.0, sin), (found.1, cos)] {
                let off = (found - Dd(high, low)).to_f64().abs();
                assert!(off < 1e-30 * x.max(1e-2), "{x}: {found:?}, off by {off:e}");
            }
        }
    }
    #[test]
    fn third_and_root() {
        let third = Dd::from(1.0) / Dd::from(3.0);
        assert!((third * Dd::from(3.0) - Dd::from(1.0)).to_f64().abs() < 1e-31);
        let root = Dd::from(2.0).sqrt();
        assert!((root * root - Dd::from(2.0)).to_f64().abs() < 1e-31);
        let eighth = Dd::from(1.0).atan2(Dd::from(1.0));
        // π/4 to 106 bits
        let rest = (eighth - Dd::from(core::f64::consts::FRAC_PI_4)).to_f64();
        assert!((rest / 3.061_616_997_868_383e-17 - 1.0).abs() < 1e-12, "{rest:e}");
        let (s, c) = Dd::from(2.5).sin_cos();
        assert!(
            (s * s + c * c - Dd::from(1.0)).to_f64().abs() < 1e-30
                && (s.atan2(c) - Dd::from(2.5)).to_f64().abs() < 1e-30
        );
        let tiny = (Dd::from(1.0) + Dd::from(1e-25)) - Dd::from(1.0);
        assert!((tiny.to_f64() / 1e-25 - 1.0).abs() < 1e-6);
    }
}
