//! Packets of eight numbers, points or masks, and the functions of them that the whole renderer shares.

use etendue::{Mask, Real, Vec3, f32x8, u32x8};

/// Eight numbers, one per lane.
pub type X8 = f32x8;
/// Eight points or directions.
pub type V8 = Vec3<f32x8>;
/// A mask of eight lanes.
pub type M8 = <f32x8 as Real>::Mask;

/// `yes` where the mask is true, `no` elsewhere. (Free functions, like [`min`] and [`max`], because the packet type has methods of
/// these names with other arguments or with checks for NaN.)
#[inline]
pub fn select(mask: M8, yes: X8, no: X8) -> X8 {
    Real::blend(mask, yes, no)
}

/// The lesser per lane; `b` where either is NaN.
#[inline]
pub fn min(a: X8, b: X8) -> X8 {
    Real::lesser(a, b)
}

/// The greater per lane; `b` where either is NaN.
#[inline]
pub fn max(a: X8, b: X8) -> X8 {
    Real::greater(a, b)
}

/// `a == b` per lane.
#[inline]
pub fn equal(a: u32x8, b: u32x8) -> M8 {
    M8::from_bits(a.simd_eq(b).to_bitmask())
}

/// `a < b` per lane.
#[inline]
pub fn below(a: u32x8, b: u32x8) -> M8 {
    M8::from_bits(a.simd_lt(b).to_bitmask())
}

/// `yes` where the mask is true, `no` elsewhere.
#[inline]
pub fn pick(mask: M8, yes: u32x8, no: u32x8) -> u32x8 {
    select(mask, X8::from_bits(yes), X8::from_bits(no)).to_bits()
}
