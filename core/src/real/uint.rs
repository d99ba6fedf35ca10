//! 32-bit unsigned lanes.

use super::Uint;
use wide::{u32x4, u32x8, u32x16};

impl Uint for u32 {
    const LANES: usize = 1;
    #[inline(always)]
    fn splat(value: u32) -> Self {
        value
    }
    #[inline(always)]
    fn from_fn(mut f: impl FnMut(usize) -> u32) -> Self {
        f(0)
    }
    #[inline(always)]
    fn lane(self, i: usize) -> u32 {
        [self][i]
    }
    #[inline(always)]
    fn wrapping_add(self, other: Self) -> Self {
        u32::wrapping_add(self, other)
    }
    #[inline(always)]
    fn wrapping_sub(self, other: Self) -> Self {
        u32::wrapping_sub(self, other)
    }
    #[inline(always)]
    fn wrapping_mul(self, other: Self) -> Self {
        u32::wrapping_mul(self, other)
    }
    #[inline(always)]
    fn shl(self, bits: u32) -> Self {
        self << bits
    }
    #[inline(always)]
    fn shr(self, bits: u32) -> Self {
        self >> bits
    }
    #[inline(always)]
    fn reverse_bits(self) -> Self {
        u32::reverse_bits(self)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self {
        if self < other { u32::MAX } else { 0 }
    }
    #[inline(always)]
    fn any(self) -> bool {
        self != 0
    }
}

/// The lanes of a packet. `array::from_fn` would do, but it is several functions for each closure, and packets have very many closures.
#[inline(always)]
pub(super) fn lanes<T: Copy + Default, const N: usize>(mut f: impl FnMut(usize) -> T) -> [T; N] {
    let mut lanes = [T::default(); N];
    for (i, lane) in lanes.iter_mut().enumerate() {
        *lane = f(i);
    }
    lanes
}

macro_rules! packet_uint {
    ($vector:ident, $lanes:literal) => {
        impl Uint for $vector {
            const LANES: usize = $lanes;
            #[inline(always)]
            fn splat(value: u32) -> Self {
                $vector::splat(value)
            }
            #[inline(always)]
            fn from_fn(f: impl FnMut(usize) -> u32) -> Self {
                $vector::new(lanes(f))
            }
            #[inline(always)]
            fn lane(self, i: usize) -> u32 {
                self.as_array()[i]
            }
            #[inline(always)]
            fn wrapping_add(self, other: Self) -> Self {
                self + other
            }
            #[inline(always)]
            fn wrapping_sub(self, other: Self) -> Self {
                self - other
            }
            #[inline(always)]
            fn wrapping_mul(self, other: Self) -> Self {
                self * other
            }
            #[inline(always)]
            fn shl(self, bits: u32) -> Self {
                self << bits
            }
            #[inline(always)]
            fn shr(self, bits: u32) -> Self {
                self >> bits
            }
            // the compiler turns this into one reversal of the whole register: two table look-ups per four bits
            #[inline(always)]
            fn reverse_bits(self) -> Self {
                $vector::new(self.to_array().map(u32::reverse_bits))
            }
            #[inline(always)]
            fn lt(self, other: Self) -> Self {
                self.simd_lt(other)
            }
            #[inline(always)]
            fn any(self) -> bool {
                self.simd_ne($vector::splat(0)).any()
            }
        }
    };
}
packet_uint!(u32x4, 4);
packet_uint!(u32x8, 8);
packet_uint!(u32x16, 16);
