//! Numbers of single and double precision, and packets of them.

use super::uint::lanes;
use super::{Mask, MaskF64X4, MaskF64X8, MaskX4, MaskX8, MaskX16, Real, arctangent, functions, fused, trigonometry};
use wide::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8, u32x4, u32x8, u32x16, u64x4, u64x8};

/// True where rounding to an integer is an instruction.
const ROUNDS: bool = cfg!(any(target_feature = "sse4.1", target_feature = "simd128", target_arch = "aarch64"));

/// What single precision needs beside the polynomials that [`Real`] provides. Where products and sums are rounded twice, double precision costs
/// less than the rests of products.
macro_rules! polynomials {
    () => {
        #[inline(always)]
        fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
            if Self::FUSED {
                return functions::difference_of_products(a, b, c, d);
            }
            Self::from_fn(|i| (a.lane_f64(i) * b.lane_f64(i) - c.lane_f64(i) * d.lane_f64(i)) as f32)
        }
        #[inline(always)]
        fn dot_in_two(a: [Self; 3], b: [Self; 3]) -> [Self; 2] {
            if Self::FUSED {
                return functions::dot_in_two(a, b);
            }
            let ([ax, ay, az], [bx, by, bz]) = (a, b);
            let product = |a: Self, b: Self, i: usize| a.lane_f64(i) * b.lane_f64(i);
            let sum = |i: usize| product(ax, bx, i) + product(ay, by, i) + product(az, bz, i);
            let rounded = Self::from_fn(|i| sum(i) as f32);
            [rounded, Self::from_fn(|i| (sum(i) - rounded.lane_f64(i)) as f32)]
        }
        #[inline(always)]
        fn inverse_cbrt_estimate(self) -> Self {
            // a third of the exponent and nearly a third of the mantissa
            let bits = Self::from_uint(self.to_bits());
            Self::from_bits((Self::lit(1_419_916_083.0) - bits * Self::lit(1.0 / 3.0)).to_uint())
        }
    };
}

/// Transcendental functions of double precision: `libm`, lane by lane but for sine, cosine, and the arctangent of vectors, which samples
/// and closed forms need.
macro_rules! lane_by_lane {
    () => {
        #[inline(always)]
        fn sin_cos_quarters(self) -> (Self, Self) {
            (self * Self::lit(0.25)).sin_cos_turns()
        }
        #[inline(always)]
        fn atan_eighth(self) -> Self {
            Self::from_fn(|i| libm::atan(self.lane(i)))
        }
        #[inline(always)]
        fn acos(self) -> Self {
            Self::from_fn(|i| libm::acos(self.lane(i).clamped(-1.0, 1.0)))
        }
        #[inline(always)]
        fn atan2(self, other: Self) -> Self {
            arctangent::atan2(self, other)
        }
        #[inline(always)]
        fn cbrt(self) -> Self {
            Self::from_fn(|i| libm::cbrt(self.lane(i)))
        }
        #[inline(always)]
        fn inverse_cbrt_estimate(self) -> Self {
            Self::from_fn(|i| 1.0 / libm::cbrt(self.lane(i)))
        }
    };
}

/// The same, of packets.
macro_rules! lanes_of_packet {
    () => {
        #[inline(always)]
        fn sin_cos_turns(self) -> (Self, Self) {
            trigonometry::sin_cos_turns(self)
        }
        lane_by_lane!();
    };
}

macro_rules! scalar_real {
    ($scalar:ident, $bits:ident, $packet:ident, $exponent:literal, $reflected:literal,
     $fused:ident, $product_error:ident, $functions:ident, $turns:path, $quarters:path) => {
        impl Real for $scalar {
            type Scalar = $scalar;
            type Mask = bool;
            type Uint = u32;
            const LANES: usize = 1;
            const DOUBLE: bool = size_of::<$scalar>() > 4;
            const FUSED: bool = fused::ALWAYS;
            const ZERO: Self = 0.0;
            const ONE_MINUS_EPSILON: Self = 1.0 - 1.0 / 16_777_216.0;
            #[inline(always)]
            fn splat(value: $scalar) -> Self {
                value
            }
            #[inline(always)]
            fn lit(value: f64) -> Self {
                value as $scalar
            }
            #[inline(always)]
            fn from_fn(mut f: impl FnMut(usize) -> $scalar) -> Self {
                f(0)
            }
            #[inline(always)]
            fn lane(self, i: usize) -> $scalar {
                [self][i]
            }
            #[inline(always)]
            fn lane_f64(self, i: usize) -> f64 {
                f64::from([self][i])
            }
            #[inline(always)]
            fn lt(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn le(self, other: Self) -> bool {
                self <= other
            }
            #[inline(always)]
            fn blend(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
            #[inline(always)]
            fn blend_uint(mask: bool, yes: u32, no: u32) -> u32 {
                if mask { yes } else { no }
            }
            #[inline(always)]
            fn has_bits(value: u32) -> bool {
                value != 0
            }
            #[inline(always)]
            fn keep(self, mask: bool) -> Self {
                if mask { self } else { 0.0 }
            }
            #[inline(always)]
            fn negate_where(self, mask: bool) -> Self {
                if mask { -self } else { self }
            }
            #[inline(always)]
            fn lesser(self, other: Self) -> Self {
                if self < other { self } else { other }
            }
            #[inline(always)]
            fn greater(self, other: Self) -> Self {
                if self > other { self } else { other }
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $scalar::from_bits(self.to_bits() & ($bits::MAX >> 1))
            }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                let magnitude = $bits::MAX >> 1;
                let sign = if sign.is_nan() { 0 } else { sign.to_bits() };
                $scalar::from_bits(self.to_bits() & magnitude | sign & !magnitude)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $packet::splat(self).sqrt().to_array()[0]
            }
            #[inline(always)]
            fn round_ties_even(self) -> Self {
                if ROUNDS {
                    return $packet::splat(self).round_ties_even().to_array()[0];
                }
                // the sum has no digits for a fraction
                let (x, most) = (Real::abs(self), 1.0 / $scalar::EPSILON);
                Real::copysign(if x < most { (x + most) - most } else { x }, self)
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                if fused::IN_HARDWARE {
                    $packet::splat(self).mul_add($packet::splat(a), $packet::splat(b)).to_array()[0]
                } else if Self::FUSED {
                    fused::$fused([self], [a], [b])[0]
                } else {
                    self * a + b
                }
            }
            #[inline(always)]
            fn two_prod_error(a: Self, b: Self, product: Self) -> Self {
                if Self::FUSED { Real::mul_add(a, b, -product) } else { fused::$product_error([a], [b], [product])[0] }
            }
            #[inline(always)]
            fn pow2_scale(self) -> Self {
                $scalar::from_bits($bits::wrapping_sub($reflected, self.to_bits() & $exponent))
                    .greater($scalar::MIN_POSITIVE * 0.5)
            }
            #[inline(always)]
            fn unit(bits: u32) -> Self {
                (bits >> 8) as $scalar * (1.0 / 16_777_216.0)
            }
            #[inline(always)]
            fn from_uint(value: u32) -> Self {
                value as i32 as $scalar
            }
            #[inline(always)]
            fn to_uint(self) -> u32 {
                self as i32 as u32
            }
            #[inline(always)]
            fn sin_cos_turns(self) -> (Self, Self) {
                let u4 = self * 4.0;
                // in numbers without digits for a fraction, the last bits are the quadrant
                let whole = 1.5 / $scalar::EPSILON;
                if Real::abs(u4) >= 0.25 / $scalar::EPSILON || u4.is_nan() {
                    return $turns(self);
                }
                let sum = u4 + whole;
                let (s, c) = $quarters(u4 + (whole - sum));
                let (quadrant, [s, c]) = (sum.to_bits(), [s, c].map($scalar::to_bits));
                let swapped = (s ^ c) & (quadrant & 1).wrapping_neg();
                let sign = |bit: $bits| (bit & 2) << ($bits::BITS - 2);
                let sin = s ^ swapped ^ sign(quadrant);
                let cos = c ^ swapped ^ sign(quadrant + 1);
                ($scalar::from_bits(sin), $scalar::from_bits(cos))
            }
            $functions!();
        }
    };
}
scalar_real!(
    f32,
    u32,
    f32x4,
    0x7f80_0000,
    0x7f00_0000,
    single,
    product_error,
    polynomials,
    functions::sin_cos_turns_f32,
    functions::sin_cos_quarters_f32
);
scalar_real!(
    f64,
    u64,
    f64x2,
    0x7ff0_0000_0000_0000,
    0x7fe0_0000_0000_0000,
    double,
    double_product_error,
    lane_by_lane,
    trigonometry::sin_cos_turns,
    trigonometry::sin_cos_quarters
);

macro_rules! packet_real {
    ($packet:ident, $scalar:ident, $bits:ident, $mask:ident, $uint:ident, $lanes:literal, $exponent:literal,
     $reflected:literal, $fused:ident, $product_error:ident, $from_int:ident, $functions:ident, $to_uint:expr,
     $mask_uint:expr, $has_bits:expr) => {
        impl Real for $packet {
            type Scalar = $scalar;
            type Mask = $mask;
            type Uint = $uint;
            const LANES: usize = $lanes;
            const DOUBLE: bool = size_of::<$scalar>() > 4;
            const FUSED: bool = fused::ALWAYS;
            const ZERO: Self = $packet::splat(0.0);
            const ONE_MINUS_EPSILON: Self = $packet::splat(1.0 - 1.0 / 16_777_216.0);
            #[inline(always)]
            fn splat(value: $scalar) -> Self {
                $packet::splat(value)
            }
            #[inline(always)]
            fn lit(value: f64) -> Self {
                $packet::splat(value as $scalar)
            }
            #[inline(always)]
            fn from_fn(f: impl FnMut(usize) -> $scalar) -> Self {
                $packet::new(lanes(f))
            }
            #[inline(always)]
            fn lane(self, i: usize) -> $scalar {
                self.as_array()[i]
            }
            #[inline(always)]
            fn lane_f64(self, i: usize) -> f64 {
                f64::from(self.as_array()[i])
            }
            #[inline(always)]
            fn lt(self, other: Self) -> $mask {
                $mask(self.simd_lt(other))
            }
            #[inline(always)]
            fn le(self, other: Self) -> $mask {
                $mask(self.simd_le(other))
            }
            #[inline(always)]
            fn blend(mask: $mask, yes: Self, no: Self) -> Self {
                mask.0.select(yes, no)
            }
            #[inline(always)]
            fn blend_uint(mask: $mask, yes: $uint, no: $uint) -> $uint {
                let bits: fn($mask) -> $uint = $mask_uint;
                no ^ ((no ^ yes) & bits(mask))
            }
            #[inline(always)]
            fn has_bits(value: $uint) -> $mask {
                let has_bits: fn($uint) -> $mask = $has_bits;
                has_bits(value)
            }
            #[inline(always)]
            fn keep(self, mask: $mask) -> Self {
                self & mask.0
            }
            #[inline(always)]
            fn negate_where(self, mask: $mask) -> Self {
                self ^ (mask.0 & $packet::splat(-0.0))
            }
            // on x86, `fast_min` is minps: `a < b ? a : b`, as for scalars; other targets treat NaN and ±0 differently
            #[inline(always)]
            fn lesser(self, other: Self) -> Self {
                if cfg!(any(target_arch = "x86", target_arch = "x86_64")) {
                    self.fast_min(other)
                } else {
                    self.simd_lt(other).select(self, other)
                }
            }
            #[inline(always)]
            fn greater(self, other: Self) -> Self {
                if cfg!(any(target_arch = "x86", target_arch = "x86_64")) {
                    self.fast_max(other)
                } else {
                    other.simd_lt(self).select(self, other)
                }
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $packet::abs(self)
            }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                $packet::copysign(self, sign & sign.simd_eq(sign))
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $packet::sqrt(self)
            }
            #[inline(always)]
            fn round_ties_even(self) -> Self {
                let rounded = $packet::round_ties_even(self);
                // without an instruction, `wide` goes through integers, which have no −0
                if ROUNDS { rounded } else { rounded.copysign(self) }
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                if fused::IN_HARDWARE {
                    $packet::mul_add(self, a, b)
                } else if Self::FUSED {
                    $packet::new(fused::$fused(self.to_array(), a.to_array(), b.to_array()))
                } else {
                    self * a + b
                }
            }
            #[inline(always)]
            fn two_prod_error(a: Self, b: Self, product: Self) -> Self {
                if Self::FUSED {
                    // not the packet's own `mul_add`, which rounds twice where no instruction does both
                    return Real::mul_add(a, b, -product);
                }
                $packet::new(fused::$product_error(a.to_array(), b.to_array(), product.to_array()))
            }
            #[inline(always)]
            fn pow2_scale(self) -> Self {
                $packet::from_bits($bits::splat($reflected) - (self.to_bits() & $bits::splat($exponent)))
                    .fast_max($packet::splat($scalar::MIN_POSITIVE * 0.5))
            }
            #[inline(always)]
            fn unit(bits: $uint) -> Self {
                $packet::$from_int((bits >> 8u32).cast_signed()) * $packet::splat(1.0 / 16_777_216.0)
            }
            #[inline(always)]
            fn from_uint(value: $uint) -> Self {
                $packet::$from_int(value.cast_signed())
            }
            #[inline(always)]
            fn to_uint(self) -> $uint {
                let convert: fn(Self) -> $uint = $to_uint;
                convert(self)
            }
            $functions!();
        }
    };
}
packet_real!(
    f32x4,
    f32,
    u32x4,
    MaskX4,
    u32x4,
    4,
    0x7f80_0000,
    0x7f00_0000,
    single,
    product_error,
    from_i32x4,
    polynomials,
    |x| x.fast_trunc_int().cast_unsigned(),
    |mask| mask.0.to_bits(),
    |value| MaskX4(f32x4::from_bits(value.simd_ne(u32x4::splat(0))))
);
packet_real!(
    f32x8,
    f32,
    u32x8,
    MaskX8,
    u32x8,
    8,
    0x7f80_0000,
    0x7f00_0000,
    single,
    product_error,
    from_i32x8,
    polynomials,
    |x| x.fast_trunc_int().cast_unsigned(),
    |mask| mask.0.to_bits(),
    |value| MaskX8(f32x8::from_bits(value.simd_ne(u32x8::splat(0))))
);
packet_real!(
    f32x16,
    f32,
    u32x16,
    MaskX16,
    u32x16,
    16,
    0x7f80_0000,
    0x7f00_0000,
    single,
    product_error,
    from_i32x16,
    polynomials,
    |x| x.fast_trunc_int().cast_unsigned(),
    |mask| mask.0.to_bits(),
    |value| MaskX16(f32x16::from_bits(value.simd_ne(u32x16::splat(0))))
);
packet_real!(
    f64x4,
    f64,
    u64x4,
    MaskF64X4,
    u32x4,
    4,
    0x7ff0_0000_0000_0000,
    0x7fe0_0000_0000_0000,
    double,
    double_product_error,
    from_i32x4,
    lanes_of_packet,
    |x| u32x4::new(core::array::from_fn(|i| x.as_array()[i] as i32 as u32)),
    |mask| u32x4::new(core::array::from_fn(|i| if mask.lane(i) { u32::MAX } else { 0 })),
    |value| MaskF64X4::from_bits(value.simd_ne(u32x4::splat(0)).to_bitmask())
);
packet_real!(
    f64x8,
    f64,
    u64x8,
    MaskF64X8,
    u32x8,
    8,
    0x7ff0_0000_0000_0000,
    0x7fe0_0000_0000_0000,
    double,
    double_product_error,
    from_i32x8,
    lanes_of_packet,
    |x| u32x8::new(core::array::from_fn(|i| x.as_array()[i] as i32 as u32)),
    |mask| u32x8::new(core::array::from_fn(|i| if mask.lane(i) { u32::MAX } else { 0 })),
    |value| MaskF64X8::from_bits(value.simd_ne(u32x8::splat(0)).to_bitmask())
);
