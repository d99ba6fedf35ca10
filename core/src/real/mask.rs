//! Masks of scalars and packets.

use super::Mask;
use core::ops::{BitAnd, BitOr, BitXor, Not};
use wide::{f32x4, f32x8, f32x16, f64x4, f64x8, u32x4, u32x8, u32x16, u64x8};

impl Mask for bool {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        value
    }
    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        bits & 1 == 1
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self as u32
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
}

macro_rules! packet_mask {
    ($(#[$doc:meta])* $mask:ident, $vector:ident, $from_bits:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $mask(pub(super) $vector);
        impl BitAnd for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitand(self, other: Self) -> Self {
                Self(self.0 & other.0)
            }
        }
        impl BitOr for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitor(self, other: Self) -> Self {
                Self(self.0 | other.0)
            }
        }
        impl BitXor for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitxor(self, other: Self) -> Self {
                Self(self.0 ^ other.0)
            }
        }
        impl Not for $mask {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                Self(!self.0)
            }
        }
        impl Mask for $mask {
            #[inline(always)]
            fn splat(value: bool) -> Self {
                Self::from_bits(if value { u32::MAX } else { 0 })
            }
            #[inline(always)]
            fn from_bits(bits: u32) -> Self {
                let from: fn(u32) -> $vector = $from_bits;
                Self(from(bits))
            }
            #[inline(always)]
            fn bits(self) -> u32 {
                self.0.to_bitmask() as u32
            }
            #[inline(always)]
            fn any(self) -> bool {
                self.0.any()
            }
            #[inline(always)]
            fn all(self) -> bool {
                self.0.all()
            }
        }
    };
}
packet_mask!(
    /// The [`Mask`] of [`f32x4`].
    MaskX4, f32x4, |bits| {
        let each = u32x4::new([1, 2, 4, 8]);
        f32x4::from_bits((u32x4::splat(bits) & each).simd_eq(each))
    }
);
packet_mask!(
    /// The [`Mask`] of [`f32x8`].
    MaskX8, f32x8, |bits| {
        let each = u32x8::new([1, 2, 4, 8, 16, 32, 64, 128]);
        f32x8::from_bits((u32x8::splat(bits) & each).simd_eq(each))
    }
);
packet_mask!(
    /// The [`Mask`] of [`f32x16`].
    MaskX16, f32x16, |bits| {
        let each = u32x16::new(core::array::from_fn(|i| 1 << i));
        f32x16::from_bits((u32x16::splat(bits) & each).simd_eq(each))
    }
);
packet_mask!(
    /// The [`Mask`] of [`f64x4`].
    MaskF64X4, f64x4, |bits| {
        f64x4::new(core::array::from_fn(|i| f64::from_bits(if bits >> i & 1 == 1 { u64::MAX } else { 0 })))
    }
);
packet_mask!(
    /// The [`Mask`] of [`f64x8`].
    MaskF64X8, f64x8, |bits| {
        let each = u64x8::new(core::array::from_fn(|i| 1 << i));
        f64x8::from_bits((u64x8::splat(u64::from(bits)) & each).simd_eq(each))
    }
);
