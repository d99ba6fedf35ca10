//! Packets of eight numbers, points or masks, and the functions of them that the whole renderer shares.

use etendue::{Mask, Real, Vec3, f32x8, f64x8, u32x8};

/// Eight numbers, one per lane.
pub type X8 = f32x8;
/// Eight points or directions.
pub type V8 = Vec3<f32x8>;
/// A mask of eight lanes.
pub type M8 = <f32x8 as Real>::Mask;

/// The mask of lanes whose bits are all set, where those of the others are 0.
#[inline]
fn mask(lanes: u32x8) -> M8 {
    // not by a number of eight bits, from which the lanes would have to be found again
    X8::from_bits(lanes & u32x8::splat(1.0_f32.to_bits())).gt(X8::lit(0.0))
}

/// `a == b` per lane.
#[inline]
pub fn equal(a: u32x8, b: u32x8) -> M8 {
    mask(a.simd_eq(b))
}

/// `a < b` per lane.
#[inline]
pub fn below(a: u32x8, b: u32x8) -> M8 {
    mask(a.simd_lt(b))
}

/// `yes` where the mask is true, `no` elsewhere.
#[inline]
pub fn pick(mask: M8, yes: u32x8, no: u32x8) -> u32x8 {
    let chosen: X8 = Real::blend(mask, X8::from_bits(yes), X8::from_bits(no));
    chosen.to_bits()
}

/// The vectors in these lanes, and 0 elsewhere.
#[inline]
pub fn keep(v: V8, mask: M8) -> V8 {
    V8::new(v.x.keep(mask), v.y.keep(mask), v.z.keep(mask))
}

/// The product of each coordinate.
#[inline]
pub fn product(a: V8, b: V8) -> V8 {
    V8::new(a.x * b.x, a.y * b.y, a.z * b.z)
}

/// Calls `f` with the index of each set bit.
#[inline(always)]
pub fn each_bit(bits: impl Into<u64>, mut f: impl FnMut(usize)) {
    let mut bits = bits.into();
    while bits != 0 {
        f(bits.trailing_zeros() as usize & 63);
        bits &= bits - 1;
    }
}

/// The first lane that is set; 0 if there is none.
#[inline(always)]
pub fn first_lane(lanes: M8) -> usize {
    lanes.bits().trailing_zeros() as usize & 7
}

/// Calls `f` with each index that some of these lanes have, and the lanes that share it.
#[inline(always)]
pub fn each_group(index: u32x8, mut lanes: M8, mut f: impl FnMut(u32, M8)) {
    while lanes.any() {
        let shared = index.as_array()[first_lane(lanes)];
        let here = lanes & equal(index, u32x8::splat(shared));
        lanes = lanes & !here;
        f(shared, here);
    }
}

/// The numbers in double precision.
#[inline(always)]
pub fn widen(x: X8) -> f64x8 {
    f64x8::new(x.to_array().map(f64::from))
}

/// The points in double precision.
#[inline(always)]
pub fn widen_points(v: V8) -> Vec3<f64x8> {
    Vec3::new(widen(v.x), widen(v.y), widen(v.z))
}

/// The points in single precision, each coordinate rounded to the nearest.
#[inline(always)]
pub fn narrow_points(v: Vec3<f64x8>) -> V8 {
    let narrow = |x: f64x8| X8::from(x.to_array().map(|x| x as f32));
    Vec3::new(narrow(v.x), narrow(v.y), narrow(v.z))
}
