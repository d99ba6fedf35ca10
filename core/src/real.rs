//! Scalars and packets under one trait. Only this module and its children name `libm`, and do arithmetic on packets of `wide`.
//!
//! A scalar operation that might round differently from its packet counterpart (`mul_add`, `sqrt`, rounding) is computed as
//! lane 0 of a packet, which the compiler reduces to the scalar instruction. So code written once over [`Real`] gives the same
//! bits at every width.

mod arctangent;
mod blend;
mod functions;
mod fused;
mod mask;
mod number;
mod trigonometry;
mod uint;

use core::fmt::Debug;
use core::ops::{Add, AddAssign, BitAnd, BitOr, BitXor, Div, Mul, MulAssign, Neg, Not, Sub, SubAssign};

pub use blend::Blend;
pub(crate) use blend::blended;
#[doc(hidden)]
pub use functions::polynomial;
#[doc(hidden)]
pub use mask::{MaskF64X4, MaskF64X8, MaskX4, MaskX8, MaskX16};

/// A truth value per lane.
pub trait Mask:
    Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + BitXor<Output = Self> + Not<Output = Self>
{
    /// The same truth value in every lane.
    fn splat(value: bool) -> Self;
    /// Lane `i` is bit `i`.
    fn from_bits(bits: u32) -> Self;
    /// Bit `i` is lane `i`; bits past the last lane are 0.
    fn bits(self) -> u32;
    /// True if any lane is.
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
    /// True if all lanes are.
    fn all(self) -> bool;
    /// The truth value of lane `i`; false past the last lane.
    #[inline(always)]
    fn lane(self, i: usize) -> bool {
        i < 32 && self.bits() >> i & 1 == 1
    }
}

/// 32-bit unsigned lanes, for counters, hashes and permutations; arithmetic wraps.
pub trait Uint: Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + BitXor<Output = Self> {
    /// Number of lanes.
    const LANES: usize;
    /// The same value in every lane.
    fn splat(value: u32) -> Self;
    /// Lane `i` is `f(i)`.
    fn from_fn(f: impl FnMut(usize) -> u32) -> Self;
    /// The value of lane `i`. Panics past the last lane.
    fn lane(self, i: usize) -> u32;
    /// Sum modulo 2³².
    fn wrapping_add(self, other: Self) -> Self;
    /// Difference modulo 2³².
    fn wrapping_sub(self, other: Self) -> Self;
    /// Product modulo 2³².
    fn wrapping_mul(self, other: Self) -> Self;
    /// Shifts towards the high bits; `bits` < 32.
    fn shl(self, bits: u32) -> Self;
    /// Shifts towards the low bits, filling with zeros; `bits` < 32.
    fn shr(self, bits: u32) -> Self;
    /// Reverses the bits: bit k becomes bit 31 − k.
    fn reverse_bits(self) -> Self;
    /// All ones in the lanes where `self < other`, zeros elsewhere.
    fn lt(self, other: Self) -> Self;
    /// True if any bit of any lane is set.
    fn any(self) -> bool;
}

/// Whether this build returns the same bits as builds for all other processors: where they multiply and add in one instruction, and with the
/// feature `same-bits`. In other builds each product and sum is rounded twice; all widths of them have the same bits.
pub const SAME_BITS: bool = fused::ALWAYS;

/// The greatest number of lanes of a packet: some routines keep a word for each lane, and do not compile for more.
pub(crate) const MOST_LANES: usize = 16;

/// A real number or a packet of them: everything that a warp needs, and no more.
///
/// Implemented for `f32`, `f64`, [`f32x4`](wide::f32x4), [`f32x8`](wide::f32x8), [`f32x16`](wide::f32x16),
/// [`f64x4`](wide::f64x4) and [`f64x8`](wide::f64x8). Comparisons with NaN are false, as for scalars. The trait is open, so that other number types can go through
/// the same routines; new required methods count as breaking changes.
pub trait Real:
    'static
    + Copy
    + Debug
    + Default
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// The type of one lane.
    type Scalar: Real<Scalar = Self::Scalar> + PartialOrd;
    /// A truth value per lane.
    type Mask: Mask;
    /// A 32-bit counter per lane.
    type Uint: Uint;
    /// Number of lanes, at most 16.
    const LANES: usize;
    /// True in double precision, where series are longer and iterations take more steps.
    const DOUBLE: bool;
    /// True where [`mul_add`](Real::mul_add) rounds once.
    const FUSED: bool = true;
    /// 0 in every lane.
    const ZERO: Self;
    /// The largest number below 1 on the grid of [`unit`](Real::unit): 1 − 2⁻²⁴ at every precision.
    const ONE_MINUS_EPSILON: Self;

    /// The same value in every lane.
    fn splat(value: Self::Scalar) -> Self;
    /// The constant nearest to `value`, in every lane.
    fn lit(value: f64) -> Self;
    /// Lane `i` is `f(i)`.
    fn from_fn(f: impl FnMut(usize) -> Self::Scalar) -> Self;
    /// The value of lane `i`. Panics past the last lane.
    fn lane(self, i: usize) -> Self::Scalar;
    /// The value of lane `i`, converted to f64 exactly. Panics past the last lane.
    fn lane_f64(self, i: usize) -> f64;

    /// `self < other`, per lane.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self <= other`, per lane.
    fn le(self, other: Self) -> Self::Mask;
    /// `self > other`, per lane.
    #[inline(always)]
    fn gt(self, other: Self) -> Self::Mask {
        other.lt(self)
    }
    /// `self >= other`, per lane.
    #[inline(always)]
    fn ge(self, other: Self) -> Self::Mask {
        other.le(self)
    }
    /// Takes the lanes of `yes` where the mask is true, and those of `no` elsewhere.
    fn blend(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// [`blend`](Real::blend) for counters.
    fn blend_uint(mask: Self::Mask, yes: Self::Uint, no: Self::Uint) -> Self::Uint;
    /// `self` where the mask is true, +0 elsewhere.
    fn keep(self, mask: Self::Mask) -> Self;
    /// `-self` where the mask is true, `self` elsewhere.
    fn negate_where(self, mask: Self::Mask) -> Self;
    /// `self < other ? self : other`: `other` where either is NaN.
    fn lesser(self, other: Self) -> Self;
    /// `self > other ? self : other`: `other` where either is NaN.
    fn greater(self, other: Self) -> Self;
    /// Clamps to [lo, hi]; a NaN becomes `lo`.
    #[inline(always)]
    fn clamped(self, lo: Self, hi: Self) -> Self {
        self.greater(lo).lesser(hi)
    }
    /// Absolute value.
    fn abs(self) -> Self;
    /// The magnitude of `self` with the sign bit of `sign`. A NaN counts as positive, because neither compilers nor processors
    /// promise the sign of a NaN that they compute.
    fn copysign(self, sign: Self) -> Self;
    /// Square root, correctly rounded; NaN for negative numbers.
    fn sqrt(self) -> Self;
    /// Nearest integer, ties to even.
    fn round_ties_even(self) -> Self;
    /// `self * a + b`, rounded once, or, where it is not [`FUSED`](Real::FUSED), twice.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// `a * b - rounded(a * b)`, exactly, barring overflow and underflow (TwoProd).
    #[inline(always)]
    fn two_prod_error(a: Self, b: Self, product: Self) -> Self {
        a.mul_add(b, -product)
    }
    /// a·b − c·d to within 1.5 ulp of the exact result (Kahan; Jeannerod, Louvet and Muller 2013).
    #[doc(hidden)]
    #[inline(always)]
    fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        functions::difference_of_products(a, b, c, d)
    }
    /// a·b of vectors, as an unevaluated sum in twice the working precision.
    #[doc(hidden)]
    #[inline(always)]
    fn dot_in_two(a: [Self; 3], b: [Self; 3]) -> [Self; 2] {
        functions::dot_in_two(a, b)
    }
    /// `self + other` and its rounding error, exactly, barring overflow (Knuth's TwoSum).
    #[inline(always)]
    fn two_sum(self, other: Self) -> (Self, Self) {
        let sum = self + other;
        let addend = sum - self;
        (sum, (self - (sum - addend)) + (other - addend))
    }
    /// 2⁻ᵉ, where e is the exponent of `self`: a power of two that scales a normal number to [1, 2), and has a
    /// finite reciprocal. Of 0 and subnormal numbers it is 2¹²⁷ (2¹⁰²³ in double precision).
    fn pow2_scale(self) -> Self;
    /// A number in [0, 1 − 2⁻²⁴] from the 24 high bits, on the same grid at every precision.
    fn unit(bits: Self::Uint) -> Self;
    /// Converts counters to reals: exact below 2²⁴.
    fn from_uint(value: Self::Uint) -> Self;
    /// The integer part of reals in [0, 2²⁴].
    fn to_uint(self) -> Self::Uint;
    /// Whether any bit of a counter is set, per lane.
    #[inline(always)]
    fn has_bits(value: Self::Uint) -> Self::Mask {
        let one = Self::Uint::splat(1);
        Self::from_uint(Self::Uint::splat(0).lt(value) & one).gt(Self::lit(0.0))
    }

    /// What `some` computes in the lanes where the mask is true, `none` in the others: a branch around a path that few calls need. Number types
    /// that write sources make a branch of it.
    #[inline(always)]
    fn where_any<T: Blend<Self>>(mask: Self::Mask, none: T, some: impl FnOnce() -> T) -> T {
        if mask.any() { T::blended(mask, some(), none) } else { none }
    }
    /// [`where_any`](Real::where_any) for what is too large to be copied: where any lane needs it, `take` blends into
    /// `what`, by the mask, what `some` has computed, and reads nothing that it has blended.
    #[inline(always)]
    fn take_any<T, S>(
        mask: Self::Mask,
        what: &mut T,
        some: impl FnOnce(&T) -> S,
        take: impl FnOnce(&mut T, Self::Mask, &S),
    ) {
        if mask.any() {
            let computed = some(what);
            take(what, mask, &computed);
        }
    }
    /// Calls `step` while any of the masks is true in any lane, at most `most` times: it gets the numbers and the masks, and returns the next
    /// ones. Lanes that are done must keep their numbers, so that they do not depend on their neighbours. Number types that write sources
    /// make a loop of it; everything else in a routine is a sequence of operations.
    ///
    /// ```
    /// use etendue::{Mask, Real, f32x4};
    /// /// Square root of a number ≥ 1 by Newton's method, from above.
    /// fn root<R: Real>(x: R) -> R {
    ///     let step = |[y]: [R; 1], [going]: [R::Mask; 1]| {
    ///         let next = (y + x / y) * R::lit(0.5);
    ///         ([R::blend(going, next, y)], [going & next.lt(y)])
    ///     };
    ///     R::iterate(20, [x], [R::Mask::splat(true)], step)[0]
    /// }
    /// let roots = root(f32x4::from([1.0, 4.0, 2.0, 9e8]));
    /// assert_eq!(roots.to_array(), [1.0_f32, 4.0, 2.0, 9e8].map(root)); // no lane depends on its neighbours
    /// assert!((roots.lane(2) - 2.0_f32.sqrt()).abs() < 1e-6 && roots.lane(3) == 3e4);
    /// ```
    #[inline(always)]
    fn iterate<const N: usize, const M: usize>(
        most: usize,
        mut numbers: [Self; N],
        mut going: [Self::Mask; M],
        mut step: impl FnMut([Self; N], [Self::Mask; M]) -> ([Self; N], [Self::Mask; M]),
    ) -> [Self; N] {
        if !going.into_iter().any(Mask::any) {
            return numbers;
        }
        for _ in 0..most {
            (numbers, going) = step(numbers, going);
            if !going.into_iter().any(Mask::any) {
                break;
            }
        }
        numbers
    }

    /// (sin 2πu, cos 2πu) for u = `self`; see [`math`](crate::math) for the errors of this function and of those below. Provided: the
    /// polynomials of single precision.
    #[inline(always)]
    fn sin_cos_turns(self) -> (Self, Self) {
        functions::sin_cos_turns_f32(self)
    }
    /// (sin πx/2, cos πx/2) for x = `self` in [−½, ½].
    #[inline(always)]
    fn sin_cos_quarters(self) -> (Self, Self) {
        functions::sin_cos_quarters_f32(self)
    }
    /// Arc cosine in radians of the argument clamped to [−1, 1].
    #[inline(always)]
    fn acos(self) -> Self {
        functions::acos_f32(self)
    }
    /// Angle of (x, y) = (`other`, `self`) in radians, in [−π, π]; 0 at the origin.
    #[inline(always)]
    fn atan2(self, other: Self) -> Self {
        functions::atan2_f32(self, other)
    }
    /// Arc tangent in radians of a number in [−tan π/8, tan π/8]: what [`atan2`](Real::atan2) reduces its arguments to.
    #[inline(always)]
    fn atan_eighth(self) -> Self {
        functions::atan_eighth_f32(self)
    }
    /// eˣ, lane by lane in double precision and rounded once. Too large for the number type, it is infinite; NaN stays NaN.
    #[inline(always)]
    fn exp(self) -> Self {
        Self::from_fn(|lane| Self::Scalar::lit(libm::exp(self.lane_f64(lane))))
    }
    /// Cube root of a number ≥ 0; 0 for a subnormal one.
    #[inline(always)]
    fn cbrt(self) -> Self {
        functions::cbrt_f32(self)
    }
    /// x^(−1/3) of a positive normal number within 3.5 %: where [`cbrt`](Real::cbrt) starts.
    fn inverse_cbrt_estimate(self) -> Self;
}

/// The greatest finite number of single precision; results stay within it at every precision.
pub(crate) const GREATEST: f64 = f32::MAX as f64;

/// Clamps to [0, 1 − 2⁻²⁴], the range of `u`; NaN becomes 0.
#[inline]
pub(crate) fn unit_interval<R: Real>(x: R) -> R {
    x.clamped(R::lit(0.0), R::ONE_MINUS_EPSILON)
}
