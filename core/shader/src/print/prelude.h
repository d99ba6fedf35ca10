//
// The functions return the bits of the Rust library `etendue` where the compiler neither contracts a product and a sum into one
// operation nor reorders any:
// - C99 and C++: gcc and clang with -ffp-contract=off, without -ffast-math; link with -lm.
// - CUDA: nvcc --fmad=false, which keeps division and square roots correctly rounded and subnormal numbers.
// - HIP: -ffp-contract=off.
// - OpenCL C: -cl-fp32-correctly-rounded-divide-sqrt, on devices with subnormal numbers.
// With other flags the results differ in their last digits, and degenerate input may return what is not finite.
// One such file in a program: ask for all functions that it needs together.

#ifndef ETENDUE_FUNCTIONS_H
#define ETENDUE_FUNCTIONS_H

#if defined(__OPENCL_VERSION__) || defined(__OPENCL_C_VERSION__)
#pragma OPENCL FP_CONTRACT OFF
#define ETENDUE_FUNCTION static inline
#define fmaf fma
#define sqrtf sqrt
#define fabsf fabs
#define rintf rint
typedef uint etendue_shader_word;
ETENDUE_FUNCTION etendue_shader_word etendue_shader_bits(float x) { return as_uint(x); }
ETENDUE_FUNCTION float etendue_shader_from_bits(etendue_shader_word bits) { return as_float(bits); }
#elif defined(__CUDACC_RTC__) || defined(__HIPCC_RTC__)
#define ETENDUE_FUNCTION static inline __device__
#ifndef INFINITY
#define INFINITY __uint_as_float(0x7f800000u)
#endif
typedef unsigned int etendue_shader_word;
ETENDUE_FUNCTION etendue_shader_word etendue_shader_bits(float x) { return __float_as_uint(x); }
ETENDUE_FUNCTION float etendue_shader_from_bits(etendue_shader_word bits) { return __uint_as_float(bits); }
#else
#if defined(__CUDACC__) || defined(__HIPCC__)
#define ETENDUE_FUNCTION static inline __host__ __device__
#else
#define ETENDUE_FUNCTION static inline
#endif
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
typedef uint32_t etendue_shader_word;
ETENDUE_FUNCTION etendue_shader_word etendue_shader_bits(float x) {
    etendue_shader_word bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
ETENDUE_FUNCTION float etendue_shader_from_bits(etendue_shader_word bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}
#endif

// Two numbers.
typedef struct {
    float x, y;
} EtendueShaderVec2;
// Three numbers.
typedef struct {
    float x, y, z;
} EtendueShaderVec3;

// b where either is NaN.
ETENDUE_FUNCTION float etendue_shader_lesser(float a, float b) { return a < b ? a : b; }
// b where either is NaN.
ETENDUE_FUNCTION float etendue_shader_greater(float a, float b) { return a > b ? a : b; }
// The magnitude of x with the sign of another number; a NaN counts as positive.
ETENDUE_FUNCTION float etendue_shader_copysign(float x, float sign) {
    return etendue_shader_from_bits((etendue_shader_bits(x) & 0x7fffffffu) | (sign == sign ? etendue_shader_bits(sign) & 0x80000000u : 0u));
}
// The power of two that scales a normal number to [1, 2); of 0 and subnormal numbers 2^127.
ETENDUE_FUNCTION float etendue_shader_pow2_scale(float x) {
    return etendue_shader_greater(etendue_shader_from_bits(0x7f000000u - (etendue_shader_bits(x) & 0x7f800000u)), 5.877471754111438e-39f);
}
// An unsigned number of less than 2^31 as the nearest number.
ETENDUE_FUNCTION float etendue_shader_from_word(etendue_shader_word k) { return (float)(int)k; }
// The integer part of a number in [0, 2^24]; others end at the least and the greatest integer of 32 bits, and NaN is 0.
ETENDUE_FUNCTION etendue_shader_word etendue_shader_to_word(float x) {
    if (x >= 2147483648.0f) {
        return 0x7fffffffu;
    }
    if (x < -2147483648.0f) {
        return 0x80000000u;
    }
    return x == x ? (etendue_shader_word)(int)x : 0u;
}
// x^(-1/3) of a positive normal number within 3.5 %.
ETENDUE_FUNCTION float etendue_shader_inverse_cbrt_estimate(float x) {
    const float third = etendue_shader_from_word(etendue_shader_bits(x)) * 0.33333334f;
    return etendue_shader_from_bits(etendue_shader_to_word(1419916083.0f - third));
}
// A number in [0, 1 - 2^-24] from the 24 high bits.
ETENDUE_FUNCTION float etendue_shader_unit(etendue_shader_word k) { return (float)(k >> 8) * 5.9604645e-8f; }
// All ones where a < b, else 0.
ETENDUE_FUNCTION etendue_shader_word etendue_shader_word_less(etendue_shader_word a, etendue_shader_word b) { return a < b ? 0xffffffffu : 0u; }
// Bit k becomes bit 31 - k.
ETENDUE_FUNCTION etendue_shader_word etendue_shader_reverse_bits(etendue_shader_word k) {
    k = (k >> 1 & 0x55555555u) | (k & 0x55555555u) << 1;
    k = (k >> 2 & 0x33333333u) | (k & 0x33333333u) << 2;
    k = (k >> 4 & 0x0f0f0f0fu) | (k & 0x0f0f0f0fu) << 4;
    k = (k >> 8 & 0x00ff00ffu) | (k & 0x00ff00ffu) << 8;
    return k >> 16 | k << 16;
}
