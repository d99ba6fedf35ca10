// Light sampling for renderers, in one dialect of C99, C++, CUDA, HIP and OpenCL C. MIT or Apache-2.0.
// Written by `etendue-shader --language c --lights sphere_by_solid_angle,triangle_by_solid_angle,rectangle_by_solid_angle,disk_by_area,sun,point_light,spot_light,directional_light --warps concentric_disk,cosine_hemisphere,ggx_visible_normals --tools all --functions sample,pdf,hit`.
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
typedef uint etendue_word;
ETENDUE_FUNCTION etendue_word etendue_bits(float x) { return as_uint(x); }
ETENDUE_FUNCTION float etendue_from_bits(etendue_word bits) { return as_float(bits); }
#elif defined(__CUDACC_RTC__) || defined(__HIPCC_RTC__)
#define ETENDUE_FUNCTION static inline __device__
#ifndef INFINITY
#define INFINITY __uint_as_float(0x7f800000u)
#endif
typedef unsigned int etendue_word;
ETENDUE_FUNCTION etendue_word etendue_bits(float x) { return __float_as_uint(x); }
ETENDUE_FUNCTION float etendue_from_bits(etendue_word bits) { return __uint_as_float(bits); }
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
typedef uint32_t etendue_word;
ETENDUE_FUNCTION etendue_word etendue_bits(float x) {
    etendue_word bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
ETENDUE_FUNCTION float etendue_from_bits(etendue_word bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}
#endif

// Two numbers.
typedef struct {
    float x, y;
} EtendueVec2;
// Three numbers.
typedef struct {
    float x, y, z;
} EtendueVec3;

// b where either is NaN.
ETENDUE_FUNCTION float etendue_lesser(float a, float b) { return a < b ? a : b; }
// b where either is NaN.
ETENDUE_FUNCTION float etendue_greater(float a, float b) { return a > b ? a : b; }
// The magnitude of x with the sign of another number; a NaN counts as positive.
ETENDUE_FUNCTION float etendue_copysign(float x, float sign) {
    return etendue_from_bits((etendue_bits(x) & 0x7fffffffu) | (sign == sign ? etendue_bits(sign) & 0x80000000u : 0u));
}
// The power of two that scales a normal number to [1, 2); of 0 and subnormal numbers 2^127.
ETENDUE_FUNCTION float etendue_pow2_scale(float x) {
    return etendue_greater(etendue_from_bits(0x7f000000u - (etendue_bits(x) & 0x7f800000u)), 5.877471754111438e-39f);
}
// An unsigned number of less than 2^31 as the nearest number.
ETENDUE_FUNCTION float etendue_from_word(etendue_word k) { return (float)(int)k; }
// The integer part of a number in [0, 2^24]; others end at the least and the greatest integer of 32 bits, and NaN is 0.
ETENDUE_FUNCTION etendue_word etendue_to_word(float x) {
    if (x >= 2147483648.0f) {
        return 0x7fffffffu;
    }
    if (x < -2147483648.0f) {
        return 0x80000000u;
    }
    return x == x ? (etendue_word)(int)x : 0u;
}
// x^(-1/3) of a positive normal number within 3.5 %.
ETENDUE_FUNCTION float etendue_inverse_cbrt_estimate(float x) {
    const float third = etendue_from_word(etendue_bits(x)) * 0.33333334f;
    return etendue_from_bits(etendue_to_word(1419916083.0f - third));
}
// A number in [0, 1 - 2^-24] from the 24 high bits.
ETENDUE_FUNCTION float etendue_unit(etendue_word k) { return (float)(k >> 8) * 5.9604645e-8f; }
// All ones where a < b, else 0.
ETENDUE_FUNCTION etendue_word etendue_word_less(etendue_word a, etendue_word b) { return a < b ? 0xffffffffu : 0u; }
// The quotient, rounded down; 0 where the divisor is.
ETENDUE_FUNCTION etendue_word etendue_word_quotient(etendue_word a, etendue_word b) { return b == 0u ? 0u : a / b; }
// Bit k becomes bit 31 - k.
ETENDUE_FUNCTION etendue_word etendue_reverse_bits(etendue_word k) {
    k = (k >> 1 & 0x55555555u) | (k & 0x55555555u) << 1;
    k = (k >> 2 & 0x33333333u) | (k & 0x33333333u) << 2;
    k = (k >> 4 & 0x0f0f0f0fu) | (k & 0x0f0f0f0fu) << 4;
    k = (k >> 8 & 0x00ff00ffu) | (k & 0x00ff00ffu) << 8;
    return k >> 16 | k << 16;
}

// Visible normals of a GGX microsurface, per steradian.
typedef struct {
    EtendueVec2 alpha;
    EtendueVec2 inverse_alpha;
    EtendueVec3 view;
    float stretched_x;
    float stretched_y;
    float height;
    float scale;
} EtendueGgxVisibleNormals;

// A sample of a light as seen from a shading point, or the point of a light that a ray hits.
typedef struct {
    // Unit direction from the shading point to the light.
    EtendueVec3 direction;
    // Distance along it, in the unit of the coordinates; 3.4e38 for lights at infinity.
    float distance;
    // Density of the direction, per steradian unless the technique says otherwise; 0 where there is no sample.
    float pdf;
    // 1/pdf where there is a sample that emits this way, else 0: what an estimator multiplies by.
    float weight;
    // Unit normal of the light at the point.
    EtendueVec3 normal;
    // Surface coordinates of the point, in [0, 1].
    EtendueVec2 uv;
    // True on the side of the light that emits.
    bool emits;
    // True where no other technique can hit the light.
    bool delta;
} EtendueLightSample;

// A sphere prepared for a shading point. Uniform over the solid angle Omega at the point p: pdf 1/Omega per steradian.
// From inside, every direction.
typedef struct {
    EtendueVec3 surface_center;
    float surface_radius;
    EtendueVec3 shape_frame_s;
    EtendueVec3 shape_frame_t;
    EtendueVec3 shape_frame_n;
    float shape_cone_one_minus_cos;
    float shape_distance;
    float shape_power;
    float shape_unit;
} EtendueSphereBySolidAngle;

// A sphere that emits outwards. A radius <= 0 gives pdf 0; from inside, every direction hits it and it does not emit.
typedef struct {
    // Centre, in the coordinates of the scene.
    EtendueVec3 center;
    // Radius, in the unit of the coordinates.
    float radius;
} EtendueSphere;

// A triangle prepared for a shading point. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
typedef struct {
    EtendueVec3 surface_plane_cross;
    EtendueVec3 surface_plane_normal;
    float surface_plane_height;
    EtendueVec3 surface_plane_along_first;
    EtendueVec3 surface_plane_along_second;
    float surface_plane_unit;
    EtendueVec3 shape_side01;
    EtendueVec3 shape_side12;
    EtendueVec3 shape_side20;
    EtendueVec3 shape_slack;
    EtendueVec3 shape_normal;
    float shape_l1;
    float shape_farthest;
    EtendueVec3 shape_apex;
    EtendueVec3 shape_along;
    EtendueVec3 shape_across;
    float shape_cot_alpha;
    float shape_stretch;
    float shape_tan_half;
    EtendueVec2 shape_half;
    EtendueVec2 shape_turned;
    float shape_sin_side;
    float shape_inv_l0;
    float shape_inv_l2;
    float shape_cot_half;
    float shape_inv_half_sin;
    float shape_g2;
    float shape_g2_over_g0;
    float shape_one_plus_d02;
    float shape_sin02_squared;
    float shape_x2;
    float shape_y2;
    float shape_g1;
    float shape_volume;
    float shape_solid_angle;
    float shape_unit;
} EtendueTriangleBySolidAngle;

// A triangle that emits from the side on which its vertices run counterclockwise. Without area, and from a point in
// its plane, the pdf is 0. uv: the barycentric coordinates of the second and the third vertex.
typedef struct {
    // First vertex, in the coordinates of the scene.
    EtendueVec3 v0;
    // Second vertex, as the edge from the first one.
    EtendueVec3 e1;
    // Third vertex, as the edge from the first one.
    EtendueVec3 e2;
} EtendueTriangle;

// A rectangle prepared for a shading point. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
typedef struct {
    EtendueVec3 surface_plane_cross;
    EtendueVec3 surface_plane_normal;
    float surface_plane_height;
    EtendueVec3 surface_plane_along_first;
    EtendueVec3 surface_plane_along_second;
    float surface_plane_unit;
    EtendueVec3 shape_base;
    EtendueVec3 shape_side_x;
    EtendueVec3 shape_side_y;
    EtendueVec3 shape_near_x;
    EtendueVec3 shape_far_x;
    EtendueVec3 shape_near_y;
    EtendueVec3 shape_far_y;
    EtendueVec2 shape_slack;
    EtendueVec2 shape_slack_far;
    EtendueVec3 shape_normal;
    EtendueVec2 shape_near;
    EtendueVec2 shape_far;
    EtendueVec2 shape_size;
    float shape_height;
    EtendueVec2 shape_anchor;
    EtendueVec2 shape_flip;
    float shape_sin_w1;
    float shape_cos_w1;
    float shape_inv_sin_w1;
    float shape_above_p;
    float shape_above_s;
    float shape_near_sin;
    float shape_near_cos;
    float shape_near_above_p;
    float shape_near_above_s;
    float shape_half;
    float shape_solid_angle;
    float shape_side;
    float shape_unit;
} EtendueRectangleBySolidAngle;

// A rectangle, of a corner and two perpendicular edges from there, that emits from the side of the first edge x the
// second one. Its strata follow the edges. Without area, and from a point in its plane, the pdf is 0. uv: (s, t), the
// parts of the edges, in [0, 1].
typedef struct {
    // Corner, in the coordinates of the scene.
    EtendueVec3 corner;
    // Edge along s.
    EtendueVec3 edge_s;
    // Edge along t, perpendicular to the other one.
    EtendueVec3 edge_t;
} EtendueRectangle;

// A disk prepared for a shading point. Uniform over the surface of area A: pdf distance^2/(|cos(theta')| A) per
// steradian, theta' at the light.
typedef struct {
    EtendueVec3 surface_center;
    EtendueVec3 surface_frame_s;
    EtendueVec3 surface_frame_t;
    EtendueVec3 surface_frame_n;
    float surface_radius;
    float surface_height;
} EtendueDiskByArea;

// A disk that emits from the side of its normal. A radius <= 0, and a point in its plane, give pdf 0. uv: (1 + q)/2
// for the position q on the unit disk.
typedef struct {
    // Centre, in the coordinates of the scene.
    EtendueVec3 center;
    // Unit normal.
    EtendueVec3 normal;
    // Radius, in the unit of the coordinates.
    float radius;
} EtendueDisk;

// A sun prepared for a shading point. Uniform over the cone: pdf 1/(2 pi (1 - cos(sigma))) per steradian, 0 where the
// cone is empty.
typedef struct {
    EtendueVec3 frame_s;
    EtendueVec3 frame_t;
    EtendueVec3 frame_n;
    float cone_one_minus_cos;
} EtendueSunBySolidAngle;

// A sun: the same radiance from all directions within an angle sigma of one direction, at every point. The distance is
// the largest number of single precision.
typedef struct {
    // Unit vector towards the centre of the sun.
    EtendueVec3 direction;
    // 1 - cos(sigma), in [0, 2]: 1.09e-5 for the sun from the earth.
    float one_minus_cos;
} EtendueSun;

// A point light prepared for a shading point. Its one direction, whatever the random numbers. The pdf of a sample is
// distance^2, which is no density; that of a direction is 0.
typedef struct {
    EtendueVec3 direction;
    float distance;
    float pdf;
} EtenduePointLightByDelta;

// A point light, that emits the same intensity I in all directions. The estimator is f * I * cos(theta) * weight. No
// direction hits it: its weight in multiple importance sampling is 1.
typedef struct {
    // Position, in the coordinates of the scene.
    EtendueVec3 position;
} EtenduePointLight;

// A spot light prepared for a shading point. Its one direction, whatever the random numbers. The pdf of a sample is
// distance^2 over the part of I that is emitted there, which is no density, and 0 outside of the cone; that of a
// direction is 0.
typedef struct {
    EtendueVec3 direction;
    float distance;
    float pdf;
} EtendueSpotLightByDelta;

// A spot light: a point light that emits into a cone, with the intensity I on its axis. The estimator is f * I *
// cos(theta) * weight. No direction hits it: its weight in multiple importance sampling is 1.
typedef struct {
    // Position, in the coordinates of the scene.
    EtendueVec3 position;
    // Unit vector along which the light travels.
    EtendueVec3 axis;
    // Cosine of the angle to the axis up to which the intensity is I.
    float cos_inner;
    // Cosine of the angle from which it is 0; less than the other one.
    float cos_outer;
} EtendueSpotLight;

// A directional light prepared for a shading point. Its one direction, whatever the random numbers. The pdf of a
// sample is 1, which is no density; that of a direction is 0.
typedef struct {
    EtendueVec3 direction;
} EtendueDirectionalLightByDelta;

// A directional light, that reaches every point from one direction with the irradiance E on a surface that faces it.
// The estimator is f * E * cos(theta) * weight. No direction hits it: its weight in multiple importance sampling is 1.
typedef struct {
    // Unit vector towards the light.
    EtendueVec3 direction;
} EtendueDirectionalLight;

// (sin 2 pix, cos 2 pix) within 8.5e-8, for |x| < 2^126.
ETENDUE_FUNCTION EtendueVec2 etendue_sin_cos_turns(float x) {
    const float x1 = x * 4.0f;
    const float x2 = rintf(x1);
    const float x3 = x1 - x2;
    const float x4 = x3 * x3;
    const float x5 = x3 * fmaf(x4, fmaf(x4, fmaf(x4, -0.004601658f, 0.07968003f), -0.6459635f), 1.5707964f);
    const float x6 = fmaf(x4, fmaf(x4, fmaf(x4, fmaf(x4, 0.0009040217f, -0.020860288f), 0.25366923f), -1.2337005f), 1.0f);
    const float x7 = x2 - 4.0f * rintf(x2 * 0.25f);
    const float x8 = fabsf(x7);
    const bool b9 = fabsf(x8 - 1.0f) < 0.5f;
    const bool b10 = 1.5f < x8;
    const float x11 = b9 ? x6 : x5;
    const float x12 = (b10 || (x7 < -0.5f)) ? -x11 : x11;
    const float x13 = b9 ? x5 : x6;
    const float x14 = (b10 || (0.5f < x7)) ? -x13 : x13;
    EtendueVec2 result;
    result.x = x12;
    result.y = x14;
    return result;
}

// (sin pix/2, cos pix/2) within 8.5e-8, for x in [-0.5, 0.5].
ETENDUE_FUNCTION EtendueVec2 etendue_sin_cos_quarters(float x) {
    const float x1 = x * x;
    const float x2 = x * fmaf(x1, fmaf(x1, fmaf(x1, -0.004601658f, 0.07968003f), -0.6459635f), 1.5707964f);
    const float x3 = fmaf(x1, fmaf(x1, fmaf(x1, fmaf(x1, 0.0009040217f, -0.020860288f), 0.25366923f), -1.2337005f), 1.0f);
    EtendueVec2 result;
    result.x = x2;
    result.y = x3;
    return result;
}

// Angle of (x, y) in radians, in [-pi, pi], within 2.1e-7 of itself; 0 at the origin.
ETENDUE_FUNCTION float etendue_angle(float y, float x) {
    const float x1 = fabsf(y);
    const float x2 = fabsf(x);
    const float x3 = etendue_lesser(x1, x2);
    const float x4 = etendue_greater(x2, x1);
    const bool b5 = x4 * 0.41421357f < x3;
    const float x6 = b5 ? x3 + x4 : x4;
    const float x7 = (b5 ? x3 - x4 : x3) / ((0.0f < x6) ? x6 : 1.0f);
    const float x8 = x7 * x7;
    const float x9 = fmaf(x7, x8 * fmaf(x8, fmaf(x8, fmaf(x8, 0.0806032f, -0.13879853f), 0.19977927f), -0.33332956f), x7) + (b5 ? 0.7853982f : 0.0f);
    const float x10 = (x2 < x1) ? 1.5707964f - x9 : x9;
    const float x11 = ((etendue_copysign(1.0f, x) < 0.0f) && !(x4 <= 0.0f)) ? 3.1415927f - x10 : x10;
    const float x12 = etendue_copysign(x11, y);
    return x12;
}

// Maps u, of which each number is in [0, 1), to a point. Points of the unit disk, uniform in area (pdf 1/pi), by
// concentric squares: keeps strata compact. Greatest error: 1.5e-7 in the point (proved for all u: 2.2e-7); 2e-7 in
// invert(sample(u)).
ETENDUE_FUNCTION EtendueVec2 etendue_concentric_disk_sample(EtendueVec2 u) {
    const float x1 = fmaf(u.x, 2.0f, -1.0f);
    const float x2 = fmaf(u.y, 2.0f, -1.0f);
    const bool b3 = fabsf(x2) < fabsf(x1);
    const float x4 = b3 ? x1 : x2;
    const EtendueVec2 v5 = etendue_sin_cos_quarters((b3 ? x2 : x1) * 0.5f / ((0.0f < fabsf(x4)) ? x4 : 1.0f));
    const float x6 = x4 * (b3 ? v5.y : v5.x);
    const float x7 = x4 * (b3 ? v5.x : v5.y);
    EtendueVec2 result;
    result.x = x6;
    result.y = x7;
    return result;
}

// The density of a point; 0 outside of the range. Points of the unit disk, uniform in area (pdf 1/pi), by concentric
// squares: keeps strata compact. Greatest error: 1.5e-7 in the point (proved for all u: 2.2e-7); 2e-7 in
// invert(sample(u)).
ETENDUE_FUNCTION float etendue_concentric_disk_pdf(EtendueVec2 point) {
    const float x1 = (fmaf(point.x, point.x, point.y * point.y) <= 1.0000004f) ? 0.31830987f : 0.0f;
    return x1;
}

// Maps u, of which each number is in [0, 1), to a point. Directions with z >= 0 and the pdf z/pi per steradian.
// Greatest error: 1.5e-7 in the direction (proved for all u: 2.4e-7), 2e-7 relative in z (proved off the horizon, for
// the pdf: 2.7e-7).
ETENDUE_FUNCTION EtendueVec3 etendue_cosine_hemisphere_sample(EtendueVec2 u) {
    const float x1 = fmaf(u.x, 2.0f, -1.0f);
    const float x2 = fmaf(u.y, 2.0f, -1.0f);
    const bool b3 = fabsf(x2) < fabsf(x1);
    const float x4 = b3 ? x1 : x2;
    const EtendueVec2 v5 = etendue_sin_cos_quarters((b3 ? x2 : x1) * 0.5f / ((0.0f < fabsf(x4)) ? x4 : 1.0f));
    const float x6 = etendue_lesser(etendue_lesser(u.x, 1.0f - u.x), etendue_lesser(u.y, 1.0f - u.y));
    const float x7 = x6 + x6;
    const float x8 = sqrtf(etendue_greater(x7 * (2.0f - x7), 0.0f));
    const float x9 = x4 * (b3 ? v5.y : v5.x);
    const float x10 = x4 * (b3 ? v5.x : v5.y);
    EtendueVec3 result;
    result.x = x9;
    result.y = x10;
    result.z = x8;
    return result;
}

// The density of a point; 0 outside of the range. Directions with z >= 0 and the pdf z/pi per steradian. Greatest
// error: 1.5e-7 in the direction (proved for all u: 2.4e-7), 2e-7 relative in z (proved off the horizon, for the pdf:
// 2.7e-7).
ETENDUE_FUNCTION float etendue_cosine_hemisphere_pdf(EtendueVec3 point) {
    const float x1 = etendue_greater(point.z, 0.0f) * 0.31830987f;
    return x1;
}

// Prepares the map. Visible normals of a GGX microsurface, per steradian.
ETENDUE_FUNCTION EtendueGgxVisibleNormals etendue_ggx_visible_normals_prepare(float alpha_x, float alpha_y, EtendueVec3 wi) {
    const float x1 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(wi.x), fabsf(wi.y)), fabsf(wi.z)));
    const float x2 = wi.x * x1;
    const float x3 = wi.y * x1;
    const float x4 = wi.z * x1;
    const float x5 = fmaf(x2, x2, fmaf(x3, x3, x4 * x4));
    const float x6 = (0.0f < x5) ? 1.0f / sqrtf(x5) : 0.0f;
    const float x7 = x2 * x6;
    const float x8 = x3 * x6;
    const float x9 = x4 * x6;
    const bool b10 = (1e-15f < alpha_x) && (1e-15f < alpha_y) && (alpha_x < 1000000000000000.0f) && (alpha_y < 1000000000000000.0f);
    const float x11 = b10 ? alpha_x : 1.0f;
    const float x12 = b10 ? alpha_y : 1.0f;
    const float x13 = 1.0f / x11;
    const float x14 = 1.0f / x12;
    const float x15 = x7 * x11;
    const float x16 = x8 * x12;
    const float x17 = fmaf(x15, x15, x16 * x16);
    const float x18 = sqrtf(fmaf(x9, x9, x17));
    const bool b19 = 0.0f < x18;
    const float x20 = 1.0f / (b19 ? x18 : 1.0f);
    const float x21 = x15 * x20;
    const float x22 = x16 * x20;
    const float x23 = (x9 < 0.0f) ? x17 / etendue_greater(x18 + fabsf(x9), 1e-37f) : x9 + x18;
    const bool b24 = b10 && b19 && (1e-33f < x23);
    const float x25 = x20 * x23;
    const float x26 = etendue_lesser(b24 ? 2.0f / (x12 * (x11 * 3.1415927f) * (b24 ? x23 : 1.0f)) : 0.0f, 3.4028235e38f);
    EtendueGgxVisibleNormals result;
    result.alpha.x = x11;
    result.alpha.y = x12;
    result.inverse_alpha.x = x13;
    result.inverse_alpha.y = x14;
    result.view.x = x7;
    result.view.y = x8;
    result.view.z = x9;
    result.stretched_x = x21;
    result.stretched_y = x22;
    result.height = x25;
    result.scale = x26;
    return result;
}

// Maps u, of which each number is in [0, 1), to a point. Visible normals of a GGX microsurface, per steradian.
// Greatest error, in units of 2^-24: 8 in the stretched normal, 8 in the pdf relative to its value and to D_v/(wi*m),
// and 24/(1 + w.z) + 16/|c + w| in invert(sample(u)). The last is largest where a grazing view sees normals that turn
// away from it, c -> -w, which have almost no probability; rounding may make such a normal face away, with pdf 0.
ETENDUE_FUNCTION EtendueVec3 etendue_ggx_visible_normals_sample(EtendueGgxVisibleNormals prepared, EtendueVec2 u) {
    const float x1 = etendue_lesser(etendue_greater(prepared.height, 0.0f), 2.0f);
    const float x2 = 1.0f - u.x;
    const float x3 = sqrtf(etendue_greater(u.x * x1 * fmaf(x1, x2, 2.0f - x1), 0.0f));
    const EtendueVec2 v4 = etendue_sin_cos_turns(u.y);
    const float x5 = prepared.alpha.x * (prepared.stretched_x + x3 * v4.y);
    const float x6 = prepared.alpha.y * (prepared.stretched_y + x3 * v4.x);
    const float x7 = etendue_greater(prepared.height * x2, 0.0f);
    const float x8 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x5), fabsf(x6)), fabsf(x7)));
    const float x9 = x5 * x8;
    const float x10 = x6 * x8;
    const float x11 = x7 * x8;
    const float x12 = fmaf(x9, x9, fmaf(x10, x10, x11 * x11));
    const float x13 = (0.0f < x12) ? 1.0f / sqrtf(x12) : 0.0f;
    const float x14 = x9 * x13;
    const float x15 = x10 * x13;
    const float x16 = x11 * x13;
    const bool b17 = 0.5f < fmaf(x14, x14, fmaf(x15, x15, x16 * x16));
    const float x18 = b17 ? x14 : 0.0f;
    const float x19 = b17 ? x15 : 0.0f;
    const float x20 = b17 ? x16 : 1.0f;
    EtendueVec3 result;
    result.x = x18;
    result.y = x19;
    result.z = x20;
    return result;
}

// The density of a point; 0 outside of the range. Visible normals of a GGX microsurface, per steradian. Greatest
// error, in units of 2^-24: 8 in the stretched normal, 8 in the pdf relative to its value and to D_v/(wi*m), and 24/(1
// + w.z) + 16/|c + w| in invert(sample(u)). The last is largest where a grazing view sees normals that turn away from
// it, c -> -w, which have almost no probability; rounding may make such a normal face away, with pdf 0.
ETENDUE_FUNCTION float etendue_ggx_visible_normals_pdf(EtendueGgxVisibleNormals prepared, EtendueVec3 point) {
    const float x1 = prepared.inverse_alpha.x * point.x;
    const float x2 = prepared.inverse_alpha.y * point.y;
    const float x3 = fmaf(x1, x1, fmaf(x2, x2, point.z * point.z));
    const bool b4 = (0.0f <= point.z) && (0.0f < x3);
    const float x5 = 1.0f / (b4 ? x3 : 1.0f);
    const float x6 = (b4 ? etendue_lesser(x5 * (prepared.scale * x5), 3.4028235e38f) : 0.0f) * etendue_greater(fmaf(prepared.view.x, point.x, fmaf(prepared.view.y, point.y, prepared.view.z * point.z)), 0.0f);
    const float x7 = etendue_lesser(x6, 3.4028235e38f);
    return x7;
}

// Prepares a light for the shading point p. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian. From inside, every direction.
ETENDUE_FUNCTION EtendueSphereBySolidAngle etendue_sphere_by_solid_angle_prepare(EtendueSphere light, EtendueVec3 p) {
    const float x1 = light.center.x - p.x;
    const float x2 = light.center.y - p.y;
    const float x3 = light.center.z - p.z;
    const bool b4 = etendue_greater(etendue_greater(fabsf(x1), fabsf(x2)), fabsf(x3)) < INFINITY;
    const float x5 = b4 ? x1 : 0.0f;
    const float x6 = b4 ? x2 : 0.0f;
    const float x7 = b4 ? x3 : 0.0f;
    const float x8 = b4 ? light.radius : 0.0f;
    const float x9 = etendue_greater(etendue_greater(fabsf(x5), fabsf(x6)), fabsf(x7));
    const float x10 = etendue_pow2_scale(etendue_greater(x9, fabsf(x8)));
    const float x11 = x5 * x10;
    const float x12 = x6 * x10;
    const float x13 = x7 * x10;
    const float x14 = x8 * x10;
    const float x15 = x11 * x11;
    const float x16 = x12 * x12;
    const float x17 = x13 * x13;
    const float x18 = x14 * x14;
    const float x19 = x15 - x18;
    const float x20 = x19 - x15;
    const float x21 = x16 + x19;
    const float x22 = x21 - x19;
    const float x23 = x17 + x21;
    const float x24 = x23 - x21;
    const float x25 = x15 - (x19 - x20) + (-x18 - x20) + (x19 - (x21 - x22) + (x16 - x22));
    const float x26 = fmaf(x11, x11, -x15) - fmaf(x14, x14, -x18) + (fmaf(x12, x12, -x16) + fmaf(x13, x13, -x17));
    const float x27 = x23 + (x21 - (x23 - x24) + (x17 - x24) + x25 + x26);
    const float x28 = fmaf(x11, x11, fmaf(x12, x12, x17));
    const bool b29 = 0.0f < x28;
    const float x30 = 1.0f / (b29 ? x28 : 1.0f);
    const float x31 = etendue_lesser(x18 * x30, 1.0f) / (1.0f + sqrtf(x30 * etendue_greater(x27, 0.0f)));
    const float x32 = sqrtf(x28);
    const float x33 = etendue_pow2_scale(x9);
    const float x34 = x5 * x33;
    const float x35 = x6 * x33;
    const float x36 = x7 * x33;
    const float x37 = fmaf(x34, x34, fmaf(x35, x35, x36 * x36));
    const float x38 = (0.0f < x37) ? 1.0f / sqrtf(x37) : 0.0f;
    const float x39 = x34 * x38;
    const float x40 = x35 * x38;
    const float x41 = x36 * x38;
    const float x42 = (0.0f < etendue_greater(etendue_greater(fabsf(x39), fabsf(x40)), fabsf(x41))) ? x41 : 1.0f;
    const float x43 = etendue_copysign(1.0f, x42);
    const float x44 = -1.0f / (x42 + x43);
    const float x45 = x44 * (x39 * x40);
    const float x46 = x39 * x43;
    const float x47 = fmaf(x39, x44 * x46, 1.0f);
    const float x48 = x43 * x45;
    const float x49 = -x46;
    const float x50 = fmaf(x40, x40 * x44, x43);
    const float x51 = -x40;
    const float x52 = (0.0f < x14) ? ((b29 && (0.0f <= x27)) ? x31 : 2.0f) : 0.0f;
    const float x53 = 1.0f / x10;
    EtendueSphereBySolidAngle result;
    result.surface_center.x = x1;
    result.surface_center.y = x2;
    result.surface_center.z = x3;
    result.surface_radius = light.radius;
    result.shape_frame_s.x = x47;
    result.shape_frame_s.y = x48;
    result.shape_frame_s.z = x49;
    result.shape_frame_t.x = x45;
    result.shape_frame_t.y = x50;
    result.shape_frame_t.z = x51;
    result.shape_frame_n.x = x39;
    result.shape_frame_n.y = x40;
    result.shape_frame_n.z = x42;
    result.shape_cone_one_minus_cos = x52;
    result.shape_distance = x32;
    result.shape_power = x27;
    result.shape_unit = x53;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian. From inside, every direction. Greatest error: pdf 3.0e-7 relative (proved: 2e-6); direction 4.8e-7
// (proved for all u: 1.5e-6, for R from 1e-4 of the greatest coordinate to where the sphere nearly touches); distance
// 3.6e-7 relative, except at the limb, where its slope is infinite.
ETENDUE_FUNCTION EtendueLightSample etendue_sphere_by_solid_angle_sample(EtendueSphereBySolidAngle prepared, EtendueVec2 u) {
    const float x1 = prepared.shape_distance * (1.0f - prepared.shape_cone_one_minus_cos * u.x);
    const float x2 = 1.0f - u.x;
    const bool b3 = 0.0f <= prepared.shape_power;
    const float x4 = prepared.shape_cone_one_minus_cos * x2 * (2.0f - prepared.shape_cone_one_minus_cos * (u.x + 1.0f)) * (prepared.shape_distance * prepared.shape_distance);
    const float x5 = sqrtf(etendue_greater(b3 ? x4 : fmaf(x1, x1, -prepared.shape_power), 0.0f)) + fabsf(x1);
    const float x6 = etendue_lesser(etendue_greater(prepared.shape_cone_one_minus_cos, 0.0f), 2.0f);
    const float x7 = u.x * x6;
    const float x8 = sqrtf(etendue_greater(x7 * fmaf(x2, x6, 2.0f - x6), 0.0f));
    const EtendueVec2 v9 = etendue_sin_cos_turns(u.y);
    const float x10 = x8 * v9.y;
    const float x11 = x8 * v9.x;
    const float x12 = 1.0f - x7;
    const float x13 = fmaf(prepared.shape_frame_s.x, x10, fmaf(prepared.shape_frame_t.x, x11, prepared.shape_frame_n.x * x12));
    const float x14 = fmaf(prepared.shape_frame_s.y, x10, fmaf(prepared.shape_frame_t.y, x11, prepared.shape_frame_n.y * x12));
    const float x15 = fmaf(prepared.shape_frame_s.z, x10, fmaf(prepared.shape_frame_t.z, x11, prepared.shape_frame_n.z * x12));
    const float x16 = (!b3 && (0.0f <= x1)) ? x5 : fabsf(prepared.shape_power) / ((0.0f < x5) ? x5 : 1.0f);
    const float x17 = etendue_lesser(prepared.shape_unit * x16, 3.4028235e38f);
    const float x18 = (1e-37f < x6) ? 0.15915494f / x6 : 0.0f;
    const bool b19 = !(prepared.shape_power < 0.0f);
    const float x20 = etendue_greater(etendue_greater(0.0f, etendue_greater(etendue_greater(fabsf(prepared.surface_center.x), fabsf(prepared.surface_center.y)), fabsf(prepared.surface_center.z))), etendue_greater(etendue_greater(fabsf(prepared.surface_radius), 0.0f), 0.0f));
    const bool b21 = x20 < INFINITY;
    const float x22 = etendue_pow2_scale(x20);
    const float x23 = x22 * (b21 ? prepared.surface_center.x : 0.0f);
    const float x24 = x22 * (b21 ? prepared.surface_center.y : 0.0f);
    const float x25 = x22 * (b21 ? prepared.surface_center.z : 0.0f);
    const float x26 = x22 * (b21 ? prepared.surface_radius : 0.0f);
    const float x27 = x23 * x23;
    const float x28 = x24 * x24;
    const float x29 = x25 * x25;
    const float x30 = x26 * x26;
    const float x31 = x27 - x30;
    const float x32 = x31 - x27;
    const float x33 = x28 + x31;
    const float x34 = x33 - x31;
    const float x35 = x29 + x33;
    const float x36 = x35 - x33;
    const float x37 = x27 - (x31 - x32) + (-x30 - x32) + (x31 - (x33 - x34) + (x28 - x34));
    const float x38 = fmaf(x23, x23, -x27) - fmaf(x26, x26, -x30) + (fmaf(x24, x24, -x28) + fmaf(x25, x25, -x29));
    const float x39 = x35 + (x33 - (x35 - x36) + (x29 - x36) + x37 + x38);
    const float x40 = fmaf(x13, x23, fmaf(x14, x24, x15 * x25));
    const float x41 = fmaf(x13, -x40, x23);
    const float x42 = fmaf(x14, -x40, x24);
    const float x43 = fmaf(x15, -x40, x25);
    const float x44 = sqrtf(etendue_greater(fmaf(x26, x26, -fmaf(x41, x41, fmaf(x42, x42, x43 * x43))), 0.0f));
    const float x45 = x44 + fabsf(x40);
    const float x46 = etendue_lesser(etendue_greater((1e-37f < fabsf(x45)) ? fabsf(x39) / x45 : 0.0f, -1e37f), 1e37f);
    const float x47 = (!(0.0f <= x39) && (0.0f <= x40)) ? x45 : x46;
    const float x48 = fmaf(x13, x47, -x23);
    const float x49 = fmaf(x14, x47, -x24);
    const float x50 = fmaf(x15, x47, -x25);
    const float x51 = fmaf(x48, x48, fmaf(x49, x49, x50 * x50));
    const float x52 = (0.0f < x51) ? 1.0f / sqrtf(x51) : 0.0f;
    const float x53 = x48 * x52;
    const float x54 = x49 * x52;
    const float x55 = x50 * x52;
    const float x56 = (0.5f < x55) ? fmaf(x53, x53, x54 * x54) / (1.0f + fabsf(x55)) : 1.0f - x55;
    const float x57 = etendue_lesser(etendue_greater(x56 / 2.0f, 0.0f), 0.99999994f);
    const float x58 = 0.15915494f * etendue_angle(x54, x53);
    const float x59 = etendue_lesser(etendue_greater((x58 < 0.0f) ? 1.0f + x58 : x58, 0.0f), 0.99999994f);
    const float x60 = (b19 && (1e-37f < x18)) ? 1.0f / x18 : 0.0f;
    EtendueLightSample result;
    result.direction.x = x13;
    result.direction.y = x14;
    result.direction.z = x15;
    result.distance = x17;
    result.pdf = x18;
    result.weight = x60;
    result.normal.x = x53;
    result.normal.y = x54;
    result.normal.z = x55;
    result.uv.x = x57;
    result.uv.y = x59;
    result.emits = b19;
    result.delta = false;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the solid angle
// Omega at the point p: pdf 1/Omega per steradian. From inside, every direction. Greatest error: pdf 3.0e-7 relative
// (proved: 2e-6); direction 4.8e-7 (proved for all u: 1.5e-6, for R from 1e-4 of the greatest coordinate to where the
// sphere nearly touches); distance 3.6e-7 relative, except at the limb, where its slope is infinite.
ETENDUE_FUNCTION float etendue_sphere_by_solid_angle_pdf(EtendueSphereBySolidAngle prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.shape_frame_n.x, w.x, fmaf(prepared.shape_frame_n.y, w.y, prepared.shape_frame_n.z * w.z));
    const float x2 = 1.0f - x1;
    const float x3 = etendue_lesser(etendue_greater(prepared.shape_cone_one_minus_cos, 0.0f), 2.0f);
    const float x4 = x2 - x3;
    const bool b5 = fabsf(x4) <= 3.8146973e-6f;
    bool b6 = false;
    if (b5) {
        const float x7 = fmaf(prepared.shape_frame_s.x, w.x, fmaf(prepared.shape_frame_s.y, w.y, prepared.shape_frame_s.z * w.z));
        const float x8 = fmaf(prepared.shape_frame_t.x, w.x, fmaf(prepared.shape_frame_t.y, w.y, prepared.shape_frame_t.z * w.z));
        const float x9 = (0.5f < x1) ? fmaf(x7, x7, x8 * x8) / (1.0f + fabsf(x1)) : x2;
        const float x10 = x3 + fmaf(5.9604645e-7f, etendue_greater(sqrtf(x3 * (2.0f - x3)), x3 - 1.0f), 1.7763568e-13f);
        b6 = x9 <= x10;
    }
    const float x11 = (((x4 < 0.0f) && !b5) || (b5 && b6)) ? ((1e-37f < x3) ? 0.15915494f / x3 : 0.0f) : 0.0f;
    return x11;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian. From inside, every direction. Greatest error:
// pdf 3.0e-7 relative (proved: 2e-6); direction 4.8e-7 (proved for all u: 1.5e-6, for R from 1e-4 of the greatest
// coordinate to where the sphere nearly touches); distance 3.6e-7 relative, except at the limb, where its slope is
// infinite.
ETENDUE_FUNCTION EtendueLightSample etendue_sphere_by_solid_angle_hit(EtendueSphereBySolidAngle prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.shape_frame_n.x, w.x, fmaf(prepared.shape_frame_n.y, w.y, prepared.shape_frame_n.z * w.z));
    const float x2 = 1.0f - x1;
    const float x3 = etendue_lesser(etendue_greater(prepared.shape_cone_one_minus_cos, 0.0f), 2.0f);
    const float x4 = x2 - x3;
    const bool b5 = fabsf(x4) <= 3.8146973e-6f;
    const float x6 = etendue_greater(etendue_greater(0.0f, etendue_greater(etendue_greater(fabsf(prepared.surface_center.x), fabsf(prepared.surface_center.y)), fabsf(prepared.surface_center.z))), etendue_greater(etendue_greater(fabsf(prepared.surface_radius), 0.0f), 0.0f));
    const bool b7 = x6 < INFINITY;
    const float x8 = etendue_pow2_scale(x6);
    const float x9 = x8 * (b7 ? prepared.surface_center.x : 0.0f);
    const float x10 = x8 * (b7 ? prepared.surface_center.y : 0.0f);
    const float x11 = x8 * (b7 ? prepared.surface_center.z : 0.0f);
    const float x12 = x8 * (b7 ? prepared.surface_radius : 0.0f);
    const float x13 = x9 * x9;
    const float x14 = x10 * x10;
    const float x15 = x11 * x11;
    const float x16 = x12 * x12;
    const float x17 = x13 - x16;
    const float x18 = x17 - x13;
    const float x19 = x14 + x17;
    const float x20 = x19 - x17;
    const float x21 = x15 + x19;
    const float x22 = x21 - x19;
    const float x23 = x13 - (x17 - x18) + (-x16 - x18) + (x17 - (x19 - x20) + (x14 - x20));
    const float x24 = fmaf(x9, x9, -x13) - fmaf(x12, x12, -x16) + (fmaf(x10, x10, -x14) + fmaf(x11, x11, -x15));
    const float x25 = x21 + (x19 - (x21 - x22) + (x15 - x22) + x23 + x24);
    const float x26 = fmaf(w.x, x9, fmaf(w.y, x10, w.z * x11));
    const float x27 = fmaf(w.x, -x26, x9);
    const float x28 = fmaf(w.y, -x26, x10);
    const float x29 = fmaf(w.z, -x26, x11);
    const float x30 = sqrtf(etendue_greater(fmaf(x12, x12, -fmaf(x27, x27, fmaf(x28, x28, x29 * x29))), 0.0f));
    const float x31 = x30 + fabsf(x26);
    const float x32 = etendue_lesser(etendue_greater((1e-37f < fabsf(x31)) ? fabsf(x25) / x31 : 0.0f, -1e37f), 1e37f);
    const float x33 = (!(0.0f <= x25) && (0.0f <= x26)) ? x31 : x32;
    const float x34 = fmaf(w.x, x33, -x9);
    const float x35 = fmaf(w.y, x33, -x10);
    const float x36 = fmaf(w.z, x33, -x11);
    const float x37 = fmaf(x34, x34, fmaf(x35, x35, x36 * x36));
    const float x38 = (0.0f < x37) ? 1.0f / sqrtf(x37) : 0.0f;
    const float x39 = x34 * x38;
    const float x40 = x35 * x38;
    const float x41 = x36 * x38;
    const float x42 = (0.5f < x41) ? fmaf(x39, x39, x40 * x40) / (1.0f + fabsf(x41)) : 1.0f - x41;
    const float x43 = etendue_lesser(etendue_greater(x42 / 2.0f, 0.0f), 0.99999994f);
    const float x44 = 0.15915494f * etendue_angle(x40, x39);
    const float x45 = etendue_lesser(etendue_greater((x44 < 0.0f) ? 1.0f + x44 : x44, 0.0f), 0.99999994f);
    bool b46 = false;
    if (b5) {
        const float x47 = fmaf(prepared.shape_frame_s.x, w.x, fmaf(prepared.shape_frame_s.y, w.y, prepared.shape_frame_s.z * w.z));
        const float x48 = fmaf(prepared.shape_frame_t.x, w.x, fmaf(prepared.shape_frame_t.y, w.y, prepared.shape_frame_t.z * w.z));
        const float x49 = (0.5f < x1) ? fmaf(x47, x47, x48 * x48) / (1.0f + fabsf(x1)) : x2;
        const float x50 = x3 + fmaf(5.9604645e-7f, etendue_greater(sqrtf(x3 * (2.0f - x3)), x3 - 1.0f), 1.7763568e-13f);
        b46 = x49 <= x50;
    }
    const float x51 = (((x4 < 0.0f) && !b5) || (b5 && b46)) ? ((1e-37f < x3) ? 0.15915494f / x3 : 0.0f) : 0.0f;
    const bool b52 = 0.0f < x51;
    const float x53 = b52 ? etendue_lesser(x33 / x8, 3.4028235e38f) : 0.0f;
    const bool b54 = !(prepared.shape_power < 0.0f) && b52;
    const float x55 = (b54 && (1e-37f < x51)) ? 1.0f / x51 : 0.0f;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = x53;
    result.pdf = x51;
    result.weight = x55;
    result.normal.x = x39;
    result.normal.y = x40;
    result.normal.z = x41;
    result.uv.x = x43;
    result.uv.y = x45;
    result.emits = b54;
    result.delta = false;
    return result;
}

// Prepares a light for the shading point p. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
ETENDUE_FUNCTION EtendueTriangleBySolidAngle etendue_triangle_by_solid_angle_prepare(EtendueTriangle light, EtendueVec3 p) {
    const float x1 = light.v0.x - p.x;
    const float x2 = light.v0.y - p.y;
    const float x3 = light.v0.z - p.z;
    const float x4 = etendue_greater(0.0f, etendue_greater(etendue_greater(fabsf(x1), fabsf(x2)), fabsf(x3)));
    const float x5 = etendue_greater(etendue_greater(fabsf(light.e1.x), fabsf(light.e1.y)), fabsf(light.e1.z));
    const float x6 = etendue_greater(etendue_greater(fabsf(light.e2.x), fabsf(light.e2.y)), fabsf(light.e2.z));
    const float x7 = etendue_greater(etendue_greater(x4, x5), x6);
    const bool b8 = x7 < INFINITY;
    const float x9 = etendue_pow2_scale(x7);
    const float x10 = x9 * (b8 ? x1 : 0.0f);
    const float x11 = x9 * (b8 ? x2 : 0.0f);
    const float x12 = x9 * (b8 ? x3 : 0.0f);
    const float x13 = x9 * (b8 ? light.e1.x : 0.0f);
    const float x14 = x9 * (b8 ? light.e1.y : 0.0f);
    const float x15 = x9 * (b8 ? light.e1.z : 0.0f);
    const float x16 = x9 * (b8 ? light.e2.x : 0.0f);
    const float x17 = x9 * (b8 ? light.e2.y : 0.0f);
    const float x18 = x9 * (b8 ? light.e2.z : 0.0f);
    const float x19 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x13), fabsf(x14)), fabsf(x15)));
    const float x20 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x16), fabsf(x17)), fabsf(x18)));
    const float x21 = x13 * x19;
    const float x22 = x14 * x19;
    const float x23 = x15 * x19;
    const float x24 = x16 * x20;
    const float x25 = x17 * x20;
    const float x26 = x18 * x20;
    const float x27 = x22 * x26;
    const float x28 = x23 * x25;
    const float x29 = x27 - x28;
    const float x30 = x29 - x27;
    const float x31 = x27 - (x29 - x30) + (-x28 - x30) + (fmaf(x22, x26, -x27) - fmaf(x23, x25, -x28));
    const float x32 = x23 * x24;
    const float x33 = x21 * x26;
    const float x34 = x32 - x33;
    const float x35 = x34 - x32;
    const float x36 = x32 - (x34 - x35) + (-x33 - x35) + (fmaf(x23, x24, -x32) - fmaf(x21, x26, -x33));
    const float x37 = x21 * x25;
    const float x38 = x22 * x24;
    const float x39 = x37 - x38;
    const float x40 = x39 - x37;
    const float x41 = x37 - (x39 - x40) + (-x38 - x40) + (fmaf(x21, x25, -x37) - fmaf(x22, x24, -x38));
    const float x42 = x29 + x31;
    const float x43 = x34 + x36;
    const float x44 = x39 + x41;
    const float x45 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x42), fabsf(x43)), fabsf(x44)));
    const float x46 = x42 * x45;
    const float x47 = x43 * x45;
    const float x48 = x44 * x45;
    const float x49 = fmaf(x46, x46, fmaf(x47, x47, x48 * x48));
    const float x50 = (0.0f < x49) ? 1.0f / sqrtf(x49) : 0.0f;
    const float x51 = x46 * x50;
    const float x52 = x47 * x50;
    const float x53 = x48 * x50;
    const float x54 = x49 * x50 / x45;
    const float x55 = x10 * x29;
    const float x56 = x11 * x34;
    const float x57 = x12 * x39;
    const float x58 = x55 + x56;
    const float x59 = x58 - x55;
    const float x60 = x57 + x58;
    const float x61 = x60 - x58;
    const float x62 = x55 - (x58 - x59) + (x56 - x59) + (x58 - (x60 - x61) + (x57 - x61));
    const float x63 = fmaf(x10, x29, -x55) + (fmaf(x11, x34, -x56) + fmaf(x12, x39, -x57));
    const float x64 = (x60 + (x62 + x63 + fmaf(x10, x31, fmaf(x11, x36, x12 * x41)))) / x54;
    const float x65 = etendue_lesser(etendue_greater((1e-37f < fabsf(x54)) ? x64 : 0.0f, -1e37f), 1e37f);
    const float x66 = x54 / x19 / x20;
    const float x67 = x51 * x66;
    const float x68 = x52 * x66;
    const float x69 = x53 * x66;
    const float x70 = -(x12 * x14);
    const float x71 = fmaf(x11, x15, x70) - fmaf(x12, x14, x70);
    const float x72 = -(x10 * x15);
    const float x73 = fmaf(x12, x13, x72) - fmaf(x10, x15, x72);
    const float x74 = -(x11 * x13);
    const float x75 = fmaf(x10, x14, x74) - fmaf(x11, x13, x74);
    const float x76 = -(x12 * x17);
    const float x77 = fmaf(x11, x18, x76) - fmaf(x12, x17, x76);
    const float x78 = -(x10 * x18);
    const float x79 = fmaf(x12, x16, x78) - fmaf(x10, x18, x78);
    const float x80 = -(x11 * x16);
    const float x81 = fmaf(x10, x17, x80) - fmaf(x11, x16, x80);
    const float x82 = 1.0f / x9;
    const float x83 = light.e1.x + x1;
    const float x84 = light.e1.y + x2;
    const float x85 = light.e1.z + x3;
    const float x86 = light.e2.x + x1;
    const float x87 = light.e2.y + x2;
    const float x88 = light.e2.z + x3;
    const float x89 = etendue_greater(etendue_greater(x4, etendue_greater(etendue_greater(fabsf(x83), fabsf(x84)), fabsf(x85))), etendue_greater(etendue_greater(fabsf(x86), fabsf(x87)), fabsf(x88)));
    const float x90 = etendue_greater(etendue_greater(x89, x5), x6);
    const bool b91 = x90 < INFINITY;
    const float x92 = etendue_pow2_scale(x90);
    const float x93 = x92 * (b91 ? x1 : 0.0f);
    const float x94 = x92 * (b91 ? x2 : 0.0f);
    const float x95 = x92 * (b91 ? x3 : 0.0f);
    const float x96 = x92 * (b91 ? x83 : 0.0f);
    const float x97 = x92 * (b91 ? x84 : 0.0f);
    const float x98 = x92 * (b91 ? x85 : 0.0f);
    const float x99 = x92 * (b91 ? x86 : 0.0f);
    const float x100 = x92 * (b91 ? x87 : 0.0f);
    const float x101 = x92 * (b91 ? x88 : 0.0f);
    const float x102 = x92 * (b91 ? light.e1.x : 0.0f);
    const float x103 = x92 * (b91 ? light.e1.y : 0.0f);
    const float x104 = x92 * (b91 ? light.e1.z : 0.0f);
    const float x105 = x92 * (b91 ? light.e2.x : 0.0f);
    const float x106 = x92 * (b91 ? light.e2.y : 0.0f);
    const float x107 = x92 * (b91 ? light.e2.z : 0.0f);
    const float x108 = x103 * x107;
    const float x109 = x104 * x106;
    const float x110 = x108 - x109;
    const float x111 = x110 - x108;
    const float x112 = x108 - (x110 - x111) + (-x109 - x111) + (fmaf(x103, x107, -x108) - fmaf(x104, x106, -x109));
    const float x113 = x104 * x105;
    const float x114 = x102 * x107;
    const float x115 = x113 - x114;
    const float x116 = x115 - x113;
    const float x117 = x113 - (x115 - x116) + (-x114 - x116) + (fmaf(x104, x105, -x113) - fmaf(x102, x107, -x114));
    const float x118 = x102 * x106;
    const float x119 = x103 * x105;
    const float x120 = x118 - x119;
    const float x121 = x120 - x118;
    const float x122 = x118 - (x120 - x121) + (-x119 - x121) + (fmaf(x102, x106, -x118) - fmaf(x103, x105, -x119));
    const float x123 = x110 + x112;
    const float x124 = x115 + x117;
    const float x125 = x120 + x122;
    const float x126 = x93 * x110;
    const float x127 = x94 * x115;
    const float x128 = x95 * x120;
    const float x129 = x126 + x127;
    const float x130 = x129 - x126;
    const float x131 = x128 + x129;
    const float x132 = x131 - x129;
    const float x133 = x126 - (x129 - x130) + (x127 - x130) + (x129 - (x131 - x132) + (x128 - x132));
    const float x134 = fmaf(x93, x110, -x126) + (fmaf(x94, x115, -x127) + fmaf(x95, x120, -x128));
    const float x135 = x131 + (x133 + x134 + fmaf(x93, x112, fmaf(x94, x117, x95 * x122)));
    const float x136 = x94 * x107;
    const float x137 = x95 * x106;
    const float x138 = x136 - x137;
    const float x139 = x138 - x136;
    const float x140 = fmaf(x95, x106, -x137);
    const float x141 = x136 - (x138 - x139) + (-x137 - x139) + (fmaf(x94, x107, -x136) - x140);
    const float x142 = x95 * x105;
    const float x143 = x93 * x107;
    const float x144 = x142 - x143;
    const float x145 = x144 - x142;
    const float x146 = fmaf(x93, x107, -x143);
    const float x147 = x142 - (x144 - x145) + (-x143 - x145) + (fmaf(x95, x105, -x142) - x146);
    const float x148 = x93 * x106;
    const float x149 = x94 * x105;
    const float x150 = x148 - x149;
    const float x151 = x150 - x148;
    const float x152 = fmaf(x94, x105, -x149);
    const float x153 = x148 - (x150 - x151) + (-x149 - x151) + (fmaf(x93, x106, -x148) - x152);
    const float x154 = x95 * x103;
    const float x155 = x94 * x104;
    const float x156 = x154 - x155;
    const float x157 = x156 - x154;
    const float x158 = fmaf(x95, x103, -x154);
    const float x159 = x154 - (x156 - x157) + (-x155 - x157) + (x158 - fmaf(x94, x104, -x155));
    const float x160 = x93 * x104;
    const float x161 = x95 * x102;
    const float x162 = x160 - x161;
    const float x163 = x162 - x160;
    const float x164 = fmaf(x93, x104, -x160);
    const float x165 = x160 - (x162 - x163) + (-x161 - x163) + (x164 - fmaf(x95, x102, -x161));
    const float x166 = x94 * x102;
    const float x167 = x93 * x103;
    const float x168 = x166 - x167;
    const float x169 = x168 - x166;
    const float x170 = fmaf(x94, x102, -x166);
    const float x171 = x166 - (x168 - x169) + (-x167 - x169) + (x170 - fmaf(x93, x103, -x167));
    const float x172 = x138 + x156;
    const float x173 = x172 - x138;
    const float x174 = x144 + x162;
    const float x175 = x174 - x144;
    const float x176 = x150 + x168;
    const float x177 = x176 - x150;
    const float x178 = x110 + x172;
    const float x179 = x178 - x110;
    const float x180 = x115 + x174;
    const float x181 = x180 - x115;
    const float x182 = x120 + x176;
    const float x183 = x182 - x120;
    const float x184 = x112 + (x138 - (x172 - x173) + (x156 - x173) + (x141 + x159));
    const float x185 = x117 + (x144 - (x174 - x175) + (x162 - x175) + (x147 + x165));
    const float x186 = x122 + (x150 - (x176 - x177) + (x168 - x177) + (x153 + x171));
    const float x187 = fmaf(x94, x104, -x154) - x158;
    const float x188 = fmaf(x95, x102, -x160) - x164;
    const float x189 = fmaf(x93, x103, -x166) - x170;
    const float x190 = fmaf(x94, x107, -x137) - x140;
    const float x191 = fmaf(x95, x105, -x143) - x146;
    const float x192 = fmaf(x93, x106, -x149) - x152;
    const float x193 = x178 + (x110 - (x178 - x179) + (x172 - x179) + x184);
    const float x194 = x180 + (x115 - (x180 - x181) + (x174 - x181) + x185);
    const float x195 = x182 + (x120 - (x182 - x183) + (x176 - x183) + x186);
    const float x196 = fmaf(x93, x93, fmaf(x94, x94, x95 * x95));
    const float x197 = fmaf(x96, x96, fmaf(x97, x97, x98 * x98));
    const float x198 = fmaf(x99, x99, fmaf(x100, x100, x101 * x101));
    const float x199 = (1e-36f < x196) ? 1.0f / sqrtf(x196) : 0.0f;
    const float x200 = (1e-36f < x197) ? 1.0f / sqrtf(x197) : 0.0f;
    const float x201 = (1e-36f < x198) ? 1.0f / sqrtf(x198) : 0.0f;
    const float x202 = fmaf(x93, x96, fmaf(x94, x97, x95 * x98));
    const float x203 = x200 * (x199 * x202);
    const float x204 = fmaf(x93, x99, fmaf(x94, x100, x95 * x101));
    const float x205 = x201 * (x199 * x204);
    const float x206 = fmaf(x187, x187, fmaf(x188, x188, x189 * x189));
    const float x207 = sqrtf(x206);
    const float x208 = (1e-37f < x206) ? 1.0f / x207 : 0.0f;
    const float x209 = x196 * x199;
    const float x210 = x197 * x200;
    const float x211 = x200 * (x199 * (x206 * x208));
    const float x212 = x210 * (x208 * x209);
    const float x213 = x212 * 2.0f;
    const float x214 = x211 * x211 / (1.0f + fabsf(x203));
    const bool b215 = x203 < 0.0f;
    const float x216 = b215 ? x214 : 1.0f + x203;
    const float x217 = x212 * (b215 ? 1.0f - x203 : x214);
    const float x218 = fabsf(x135);
    const float x219 = x201 * (x200 * (x199 * x218));
    const float x220 = x96 * x200;
    const float x221 = x97 * x200;
    const float x222 = x98 * x200;
    const float x223 = x93 * x199;
    const float x224 = x94 * x199;
    const float x225 = x95 * x199;
    const float x226 = x220 + x223;
    const float x227 = x221 + x224;
    const float x228 = x222 + x225;
    const bool b229 = x135 < 0.0f;
    const float x230 = x187 * x208;
    const float x231 = x188 * x208;
    const float x232 = x189 * x208;
    const float x233 = -(x222 * x231);
    const float x234 = fmaf(x221, x232, x233) - fmaf(x222, x231, x233);
    const float x235 = -(x220 * x232);
    const float x236 = fmaf(x222, x230, x235) - fmaf(x220, x232, x235);
    const float x237 = -(x221 * x230);
    const float x238 = fmaf(x220, x231, x237) - fmaf(x221, x230, x237);
    const float x239 = x201 * fmaf(x99, x220, fmaf(x100, x221, x101 * x222));
    const float x240 = x201 * fmaf(x105 - x102, x234, fmaf(x106 - x103, x236, (x107 - x104) * x238));
    const float x241 = x201 * (x208 * x218);
    const float x242 = fmaf(x190, x190, fmaf(x191, x191, x192 * x192));
    const float x243 = x199 * x201;
    const float x244 = x243 * (x242 * x243);
    const bool b245 = etendue_lesser(etendue_lesser(x203, x205), x239) < -0.5f;
    const float x246 = fmaf(x96, x99, fmaf(x97, x100, x98 * x101));
    const float x247 = fmaf(x193, x193, fmaf(x194, x194, x195 * x195));
    const float x248 = b229 ? -x230 : x230;
    const float x249 = b229 ? -x231 : x231;
    const float x250 = b229 ? -x232 : x232;
    const float x251 = x209 * x218;
    const float x252 = (1e-37f < x251) ? fmaf(x187, x190, fmaf(x188, x191, x189 * x192)) / x251 : 0.0f;
    const bool b253 = (0.0f < x199) && (0.0f < x200) && (0.0f < x201) && (0.0f < x219);
    const float x254 = 1.0f / ((1e-37f < x219) ? x219 : 1.0f);
    const float x255 = etendue_lesser(etendue_greater(-x203 / ((0.0f < x211) ? x211 : 1.0f), 1.0f), 1e18f);
    const float x256 = b229 ? -x187 : x187;
    const float x257 = b229 ? -x188 : x188;
    const float x258 = b229 ? -x189 : x189;
    const float x259 = b229 ? -x193 : x193;
    const float x260 = b229 ? -x194 : x194;
    const float x261 = b229 ? -x195 : x195;
    const float x262 = b229 ? x190 : -x190;
    const float x263 = b229 ? x191 : -x191;
    const float x264 = b229 ? x192 : -x192;
    const float x265 = etendue_greater(x207 * x255, -x202) * 7.1525574e-7f;
    const float x266 = etendue_greater(x255, -x205 * (1.0f / sqrtf(etendue_greater(x244, 1e-7f)))) * sqrtf(x247);
    const float x267 = 7.1525574e-7f * etendue_greater(x266, -x246);
    const float x268 = 7.1525574e-7f * etendue_greater(x255 * sqrtf(x242), -x204);
    const float x269 = etendue_greater(etendue_greater(x209, x210), x198 * x201);
    const float x270 = x216 * x254;
    const float x271 = etendue_pow2_scale(x92);
    float x272 = fmaf(x201, fmaf(x99, x226, fmaf(x100, x227, x101 * x228)), x216);
    float x273 = x240;
    bool b274 = false;
    bool b275 = false;
    float x276 = 0.0f;
    if (b245) {
        const float x277 = x96 - x93;
        const float x278 = x97 - x94;
        const float x279 = x98 - x95;
        const float x280 = fmaf(x277, x277, fmaf(x278, x278, x279 * x279));
        const bool b281 = 1e-36f < x280;
        const float x282 = 1.0f / sqrtf(b281 ? x280 : 1.0f);
        const float x283 = x282 * x282;
        const float x284 = -(x188 * x279);
        const float x285 = -(x189 * x277);
        const float x286 = -(x187 * x278);
        const float x287 = x206 * x283;
        const float x288 = x277 * x282;
        const float x289 = x278 * x282;
        const float x290 = x279 * x282;
        const float x291 = x199 + x200;
        const float x292 = x199 * (x199 * x287) / (1.0f + x199 * fabsf(fmaf(x93, x288, fmaf(x94, x289, x95 * x290))));
        const float x293 = x200 * (x200 * x287) / (1.0f + x200 * fabsf(fmaf(x96, x288, fmaf(x97, x289, x98 * x290))));
        const float x294 = x292 - x293;
        const bool b295 = (x202 < 0.0f) && b281;
        const float x296 = b295 ? fmaf(x283 * (fmaf(x189, x278, x284) - fmaf(x188, x279, x284)), x291, x288 * x294) : x226;
        const float x297 = b295 ? fmaf(x283 * (fmaf(x187, x279, x285) - fmaf(x189, x277, x285)), x291, x289 * x294) : x227;
        const float x298 = b295 ? fmaf(x283 * (fmaf(x188, x277, x286) - fmaf(x187, x278, x286)), x291, x290 * x294) : x228;
        const float x299 = x99 * x201;
        const float x300 = x100 * x201;
        const float x301 = x101 * x201;
        const float x302 = x99 - x93;
        const float x303 = x100 - x94;
        const float x304 = x101 - x95;
        const float x305 = fmaf(x302, x302, fmaf(x303, x303, x304 * x304));
        const bool b306 = 1e-36f < x305;
        const float x307 = 1.0f / sqrtf(b306 ? x305 : 1.0f);
        const float x308 = x307 * x307;
        const float x309 = -(x191 * x304);
        const float x310 = -(x192 * x302);
        const float x311 = -(x190 * x303);
        const float x312 = x242 * x308;
        const float x313 = x302 * x307;
        const float x314 = x303 * x307;
        const float x315 = x304 * x307;
        const float x316 = x199 + x201;
        const float x317 = x199 * (x199 * x312) / (1.0f + x199 * fabsf(fmaf(x93, x313, fmaf(x94, x314, x95 * x315))));
        const float x318 = x201 * (x201 * x312) / (1.0f + x201 * fabsf(fmaf(x99, x313, fmaf(x100, x314, x101 * x315))));
        const float x319 = x317 - x318;
        const bool b320 = (x204 < 0.0f) && b306;
        const float x321 = b320 ? fmaf(x308 * (fmaf(x192, x303, x309) - fmaf(x191, x304, x309)), x316, x313 * x319) : x223 + x299;
        const float x322 = b320 ? fmaf(x308 * (fmaf(x190, x304, x310) - fmaf(x192, x302, x310)), x316, x314 * x319) : x224 + x300;
        const float x323 = b320 ? fmaf(x308 * (fmaf(x191, x302, x311) - fmaf(x190, x303, x311)), x316, x315 * x319) : x225 + x301;
        const float x324 = x99 - x96;
        const float x325 = x100 - x97;
        const float x326 = x101 - x98;
        const float x327 = fmaf(x324, x324, fmaf(x325, x325, x326 * x326));
        const bool b328 = 1e-36f < x327;
        const float x329 = 1.0f / sqrtf(b328 ? x327 : 1.0f);
        const float x330 = x329 * x329;
        const float x331 = -(x194 * x326);
        const float x332 = -(x195 * x324);
        const float x333 = -(x193 * x325);
        const float x334 = x330 * x247;
        const float x335 = x324 * x329;
        const float x336 = x325 * x329;
        const float x337 = x326 * x329;
        const float x338 = x200 + x201;
        const float x339 = x200 * (x200 * x334) / (1.0f + x200 * fabsf(fmaf(x96, x335, fmaf(x97, x336, x98 * x337))));
        const float x340 = x201 * (x201 * x334) / (1.0f + x201 * fabsf(fmaf(x99, x335, fmaf(x100, x336, x101 * x337))));
        const float x341 = x339 - x340;
        const bool b342 = (x246 < 0.0f) && b328;
        const float x343 = b342 ? fmaf(x330 * (fmaf(x195, x325, x331) - fmaf(x194, x326, x331)), x338, x335 * x341) : x220 + x299;
        const float x344 = b342 ? fmaf(x330 * (fmaf(x193, x326, x332) - fmaf(x195, x324, x332)), x338, x336 * x341) : x221 + x300;
        const float x345 = b342 ? fmaf(x330 * (fmaf(x194, x324, x333) - fmaf(x193, x325, x333)), x338, x337 * x341) : x222 + x301;
        const float x346 = (x239 < x205) ? fmaf(x296, x343, fmaf(x297, x344, x298 * x345)) : fmaf(x296, x321, fmaf(x297, x322, x298 * x323));
        x272 = (etendue_greater(x205, x239) < x203) ? fmaf(x321, x343, fmaf(x322, x344, x323 * x345)) : x346;
        x273 = -(x201 * (x200 * (x208 * fmaf(x187, x193, fmaf(x188, x194, x189 * x195)))));
        b274 = x239 < 0.0f;
        b275 = x205 < 0.0f;
        x276 = x244 / (1.0f + fabsf(x205));
    }
    const float x347 = (b245 && b275) ? x276 : 1.0f + x205;
    const float x348 = b253 ? 2.0f * etendue_angle(x219, x272) : 0.0f;
    const float x349 = etendue_greater(fmaf(x219, x219, x272 * x272), 1e-36f);
    const float x350 = 1.0f / sqrtf(x349);
    const float x351 = x219 * x350;
    const float x352 = x272 * x350;
    const float x353 = x350 * (x254 * x349);
    const float x354 = x353 * (x211 * 0.5f);
    const bool b355 = x354 < 1e30f;
    const float x356 = x272 * x254;
    const float x357 = x272 - x216;
    float x358 = 0.0f;
    if (b245) {
        x358 = fmaf(x273, x273, x241 * x241) / (1.0f + fabsf(x239));
    }
    const float x359 = 1.0f / etendue_greater((b245 && b274) ? x358 : 1.0f + x239, 1e-30f);
    const float x360 = b355 ? etendue_lesser(x354 * (x241 * x359), 1e18f) : 0.0f;
    const float x361 = b355 ? etendue_lesser(etendue_greater(x354 * fmaf(x273, -x359, x217), -1e18f), 1e18f) : 0.0f;
    EtendueTriangleBySolidAngle result;
    result.surface_plane_cross.x = x67;
    result.surface_plane_cross.y = x68;
    result.surface_plane_cross.z = x69;
    result.surface_plane_normal.x = x51;
    result.surface_plane_normal.y = x52;
    result.surface_plane_normal.z = x53;
    result.surface_plane_height = x65;
    result.surface_plane_along_first.x = x71;
    result.surface_plane_along_first.y = x73;
    result.surface_plane_along_first.z = x75;
    result.surface_plane_along_second.x = x77;
    result.surface_plane_along_second.y = x79;
    result.surface_plane_along_second.z = x81;
    result.surface_plane_unit = x82;
    result.shape_side01.x = x256;
    result.shape_side01.y = x257;
    result.shape_side01.z = x258;
    result.shape_side12.x = x259;
    result.shape_side12.y = x260;
    result.shape_side12.z = x261;
    result.shape_side20.x = x262;
    result.shape_side20.y = x263;
    result.shape_side20.z = x264;
    result.shape_slack.x = x265;
    result.shape_slack.y = x267;
    result.shape_slack.z = x268;
    result.shape_normal.x = x123;
    result.shape_normal.y = x124;
    result.shape_normal.z = x125;
    result.shape_l1 = x210;
    result.shape_farthest = x269;
    result.shape_apex.x = x220;
    result.shape_apex.y = x221;
    result.shape_apex.z = x222;
    result.shape_along.x = x234;
    result.shape_along.y = x236;
    result.shape_along.z = x238;
    result.shape_across.x = x248;
    result.shape_across.y = x249;
    result.shape_across.z = x250;
    result.shape_cot_alpha = x252;
    result.shape_stretch = x213;
    result.shape_tan_half = x217;
    result.shape_half.x = x351;
    result.shape_half.y = x352;
    result.shape_turned.x = x360;
    result.shape_turned.y = x361;
    result.shape_sin_side = x211;
    result.shape_inv_l0 = x199;
    result.shape_inv_l2 = x201;
    result.shape_cot_half = x356;
    result.shape_inv_half_sin = x353;
    result.shape_g2 = x216;
    result.shape_g2_over_g0 = x270;
    result.shape_one_plus_d02 = x347;
    result.shape_sin02_squared = x244;
    result.shape_x2 = x273;
    result.shape_y2 = x241;
    result.shape_g1 = x357;
    result.shape_volume = x135;
    result.shape_solid_angle = x348;
    result.shape_unit = x271;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian. Greatest error over the atlas (size, elevation, aspect ratio and distance), for edges taken as given:
// Omega 5e-7 relative, except 7e-5 beside the middle of an edge that is a million times longer than the triangle is
// wide and than the point is far; direction 5.4e-7 (1.4e-5 of the angular size where that nears pi); distance 5.4e-7
// of itself over |cos| at the plane, and 5.4e-7 of the farthest vertex's. The inverse is that of a direction 6e-7
// away, times the triangle's apparent aspect ratio. From less than 1e-3 of its size above the plane of a triangle that
// surrounds the point, most of u0 lies within the rounding of a direction near the ends of the sweep: there u1 follows
// from the rounded u0, so that both lead back to the direction, and may itself be another one.
ETENDUE_FUNCTION EtendueLightSample etendue_triangle_by_solid_angle_sample(EtendueTriangleBySolidAngle prepared, EtendueVec2 u) {
    const bool b1 = 0.5f < u.x;
    const EtendueVec2 v2 = etendue_sin_cos_turns(prepared.shape_solid_angle * (b1 ? 1.0f - u.x : u.x) * 0.07957747f);
    const float x3 = b1 ? prepared.shape_half.x * v2.y - prepared.shape_half.y * v2.x : v2.x;
    const float x4 = b1 ? prepared.shape_turned.x : 1.0f;
    const float x5 = b1 ? prepared.shape_turned.y : -prepared.shape_cot_alpha;
    const float x6 = fmaf(v2.y, x5, -(v2.x * x4));
    const float x7 = prepared.shape_stretch * x3;
    const float x8 = etendue_lesser(etendue_greater(fmaf(b1 ? x6 : -x6, -x7, prepared.shape_tan_half), -1000000000000000.0f), 1000000000000000.0f);
    const float x9 = etendue_lesser(etendue_greater(fmaf(v2.y, x4, v2.x * x5) * x7, 0.0f), 1000000000000000.0f);
    const float x10 = b1 ? prepared.shape_inv_half_sin * v2.x : fmaf(prepared.shape_cot_half, -v2.x, v2.y);
    const bool b11 = prepared.shape_g2 < 0.5f;
    const float x12 = prepared.shape_g2_over_g0 * x3;
    const float x13 = etendue_greater(x10 * (x12 + (x10 + x12)), 0.0f);
    const float x14 = 2.0f * x12;
    const float x15 = etendue_greater(x14 * fmaf(prepared.shape_one_plus_d02, x12, x10), 0.0f);
    const float x16 = prepared.shape_one_plus_d02 * (x12 * x14) - x10 * x10;
    const float x17 = 1.0f / sqrtf(etendue_greater(fmaf(x16, x16, x15 * (x13 * (prepared.shape_one_plus_d02 * 2.0f))), 1e-30f));
    const float x18 = x13 * x17;
    const float x19 = x15 * x17;
    const float x20 = 1.0f - u.y;
    const float x21 = etendue_lesser(etendue_greater((1e-37f < fabsf(prepared.shape_solid_angle)) ? 1.0f / prepared.shape_solid_angle : 0.0f, -1e37f), 1e37f);
    const bool b22 = prepared.shape_volume < 0.0f;
    const float x23 = (b22 && (1e-37f < x21)) ? 1.0f / x21 : 0.0f;
    bool b24 = false;
    float x25 = 0.0f;
    float x26 = 0.0f;
    if (b11) {
        const float x27 = fmaf(x19, prepared.shape_one_plus_d02 - 1.0f, x18);
        const float x28 = (0.0f < x27) ? prepared.shape_sin02_squared * (x19 * x19) / (1.0f + etendue_greater(x27, 0.0f)) : 1.0f - x27;
        const float x29 = fmaf(prepared.shape_g2, x18, x28 + prepared.shape_g1 * x19);
        const float x30 = 1.0f / etendue_greater(x29, 1e-30f);
        const float x31 = x30 * (prepared.shape_sin_side * x18);
        const float x32 = x30 * (prepared.shape_x2 * x19);
        const bool b33 = (fmaf(prepared.shape_g2, x18, x28 + x19 * fabsf(prepared.shape_g1)) * 0.125f < x29) && (0.5f < x18 + x19);
        b24 = b33 && (x31 + fabsf(x32) < etendue_greater(prepared.shape_tan_half, fabsf(x8)));
        x25 = etendue_lesser(etendue_greater(x31 + x32, -1000000000000000.0f), 1000000000000000.0f);
        x26 = etendue_lesser(x30 * (prepared.shape_y2 * x19), 1000000000000000.0f);
    }
    const float x34 = b24 ? x25 : x8;
    const float x35 = b24 ? x26 : x9;
    const float x36 = fmaf(x34, x34, x35 * x35);
    const float x37 = 1.0f + x36;
    const float x38 = 2.0f / x37;
    const float x39 = u.y * x38;
    const float x40 = fmaf(x36, -x39, 1.0f);
    const float x41 = sqrtf(etendue_greater(x39 * (x38 * fmaf(x36, x20, 1.0f)), 0.0f));
    const float x42 = fmaf(prepared.shape_apex.x, x40, x41 * fmaf(prepared.shape_along.x, x34, prepared.shape_across.x * x35));
    const float x43 = fmaf(prepared.shape_apex.y, x40, x41 * fmaf(prepared.shape_along.y, x34, prepared.shape_across.y * x35));
    const float x44 = fmaf(prepared.shape_apex.z, x40, x41 * fmaf(prepared.shape_along.z, x34, prepared.shape_across.z * x35));
    const float x45 = fmaf(fmaf(x42, x42, fmaf(x43, x43, x44 * x44)), -0.5f, 1.5f);
    const float x46 = x42 * x45;
    const float x47 = x43 * x45;
    const float x48 = x44 * x45;
    const float x49 = x37 * (0.5f * x41);
    const bool b50 = 1.0f < x36;
    const float x51 = fabsf(1.0f - x36) / x37;
    const float x52 = (1.0f + x51) * fmaf(x49, x51, x40);
    const float x53 = fmaf(x49, prepared.shape_l1 * fmaf(prepared.shape_inv_l0, x18, prepared.shape_inv_l2 * x19), x20 * (x40 + x51) / ((0.0f < x52) ? x52 : 1.0f));
    const float x54 = b50 ? fabsf(fmaf(prepared.shape_normal.x, x46, fmaf(prepared.shape_normal.y, x47, prepared.shape_normal.z * x48))) : x53;
    const bool b55 = (0.0f < x54) && (0.0f < prepared.shape_solid_angle);
    const float x56 = etendue_lesser(prepared.shape_unit * etendue_lesser((b50 ? fabsf(prepared.shape_volume) : prepared.shape_l1) / (b55 ? x54 : 1.0f), prepared.shape_farthest), 3.4028235e38f);
    const float x57 = b55 ? x56 : 0.0f;
    const float x58 = fmaf(prepared.surface_plane_cross.x, x46, fmaf(prepared.surface_plane_cross.y, x47, prepared.surface_plane_cross.z * x48));
    const bool b59 = 1e-37f < fabsf(x58);
    const float x60 = etendue_greater(b59 ? -fmaf(prepared.surface_plane_along_second.x, x46, fmaf(prepared.surface_plane_along_second.y, x47, prepared.surface_plane_along_second.z * x48)) / x58 : 0.0f, -1e37f);
    const float x61 = etendue_lesser(etendue_greater(b59 ? fmaf(prepared.surface_plane_along_first.x, x46, fmaf(prepared.surface_plane_along_first.y, x47, prepared.surface_plane_along_first.z * x48)) / x58 : 0.0f, -1e37f), 1e37f);
    const float x62 = etendue_lesser(etendue_greater(etendue_lesser(x60, 1e37f), 0.0f), 1.0f);
    const float x63 = etendue_lesser(etendue_greater(x61, 0.0f), 1.0f);
    EtendueLightSample result;
    result.direction.x = x46;
    result.direction.y = x47;
    result.direction.z = x48;
    result.distance = x57;
    result.pdf = x21;
    result.weight = x23;
    result.normal.x = prepared.surface_plane_normal.x;
    result.normal.y = prepared.surface_plane_normal.y;
    result.normal.z = prepared.surface_plane_normal.z;
    result.uv.x = x62;
    result.uv.y = x63;
    result.emits = b22;
    result.delta = false;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the solid angle
// Omega at the point p: pdf 1/Omega per steradian. Greatest error over the atlas (size, elevation, aspect ratio and
// distance), for edges taken as given: Omega 5e-7 relative, except 7e-5 beside the middle of an edge that is a million
// times longer than the triangle is wide and than the point is far; direction 5.4e-7 (1.4e-5 of the angular size where
// that nears pi); distance 5.4e-7 of itself over |cos| at the plane, and 5.4e-7 of the farthest vertex's. The inverse
// is that of a direction 6e-7 away, times the triangle's apparent aspect ratio. From less than 1e-3 of its size above
// the plane of a triangle that surrounds the point, most of u0 lies within the rounding of a direction near the ends
// of the sweep: there u1 follows from the rounded u0, so that both lead back to the direction, and may itself be
// another one.
ETENDUE_FUNCTION float etendue_triangle_by_solid_angle_pdf(EtendueTriangleBySolidAngle prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.shape_side01.x, w.x, fmaf(prepared.shape_side01.y, w.y, prepared.shape_side01.z * w.z));
    const float x2 = fmaf(prepared.shape_side20.x, w.x, fmaf(prepared.shape_side20.y, w.y, prepared.shape_side20.z * w.z));
    const float x3 = fmaf(prepared.shape_normal.x, w.x, fmaf(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z));
    const float x4 = (prepared.shape_volume < 0.0f) ? -x3 : x3;
    const float x5 = etendue_greater(etendue_greater(fabsf(prepared.shape_side01.x), fabsf(prepared.shape_side01.y)), fabsf(prepared.shape_side01.z)) + etendue_greater(etendue_greater(fabsf(prepared.shape_side20.x), fabsf(prepared.shape_side20.y)), fabsf(prepared.shape_side20.z));
    const float x6 = (x5 + etendue_greater(etendue_greater(fabsf(prepared.shape_normal.x), fabsf(prepared.shape_normal.y)), fabsf(prepared.shape_normal.z))) * 1.9073486e-6f;
    const bool b7 = (0.0f <= x1) && (0.0f <= x2) && (0.0f <= x4) && (x6 < x4 - x2 - x1);
    bool b8 = false;
    if (!b7) {
        const bool b9 = (-prepared.shape_slack.y <= fmaf(prepared.shape_side12.x, w.x, fmaf(prepared.shape_side12.y, w.y, prepared.shape_side12.z * w.z))) && (-prepared.shape_slack.z <= x2);
        const bool b10 = -(sqrtf(fmaf(prepared.shape_normal.x, prepared.shape_normal.x, fmaf(prepared.shape_normal.y, prepared.shape_normal.y, prepared.shape_normal.z * prepared.shape_normal.z))) * 7.1525574e-7f) <= x4;
        b8 = b9 && (-prepared.shape_slack.x <= x1) && b10;
    }
    const float x11 = (b7 || b8) ? etendue_lesser(etendue_greater((1e-37f < fabsf(prepared.shape_solid_angle)) ? 1.0f / prepared.shape_solid_angle : 0.0f, -1e37f), 1e37f) : 0.0f;
    return x11;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian. Greatest error over the atlas (size,
// elevation, aspect ratio and distance), for edges taken as given: Omega 5e-7 relative, except 7e-5 beside the middle
// of an edge that is a million times longer than the triangle is wide and than the point is far; direction 5.4e-7
// (1.4e-5 of the angular size where that nears pi); distance 5.4e-7 of itself over |cos| at the plane, and 5.4e-7 of
// the farthest vertex's. The inverse is that of a direction 6e-7 away, times the triangle's apparent aspect ratio.
// From less than 1e-3 of its size above the plane of a triangle that surrounds the point, most of u0 lies within the
// rounding of a direction near the ends of the sweep: there u1 follows from the rounded u0, so that both lead back to
// the direction, and may itself be another one.
ETENDUE_FUNCTION EtendueLightSample etendue_triangle_by_solid_angle_hit(EtendueTriangleBySolidAngle prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.shape_side01.x, w.x, fmaf(prepared.shape_side01.y, w.y, prepared.shape_side01.z * w.z));
    const float x2 = fmaf(prepared.shape_side20.x, w.x, fmaf(prepared.shape_side20.y, w.y, prepared.shape_side20.z * w.z));
    const float x3 = fmaf(prepared.shape_normal.x, w.x, fmaf(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z));
    const bool b4 = prepared.shape_volume < 0.0f;
    const float x5 = b4 ? -x3 : x3;
    const float x6 = etendue_greater(etendue_greater(fabsf(prepared.shape_side01.x), fabsf(prepared.shape_side01.y)), fabsf(prepared.shape_side01.z)) + etendue_greater(etendue_greater(fabsf(prepared.shape_side20.x), fabsf(prepared.shape_side20.y)), fabsf(prepared.shape_side20.z));
    const float x7 = (x6 + etendue_greater(etendue_greater(fabsf(prepared.shape_normal.x), fabsf(prepared.shape_normal.y)), fabsf(prepared.shape_normal.z))) * 1.9073486e-6f;
    const bool b8 = (0.0f <= x1) && (0.0f <= x2) && (0.0f <= x5) && (x7 < x5 - x2 - x1);
    const float x9 = fmaf(prepared.surface_plane_cross.x, w.x, fmaf(prepared.surface_plane_cross.y, w.y, prepared.surface_plane_cross.z * w.z));
    const bool b10 = 1e-37f < fabsf(x9);
    const float x11 = etendue_greater(b10 ? -fmaf(prepared.surface_plane_along_second.x, w.x, fmaf(prepared.surface_plane_along_second.y, w.y, prepared.surface_plane_along_second.z * w.z)) / x9 : 0.0f, -1e37f);
    const float x12 = etendue_lesser(etendue_greater(b10 ? fmaf(prepared.surface_plane_along_first.x, w.x, fmaf(prepared.surface_plane_along_first.y, w.y, prepared.surface_plane_along_first.z * w.z)) / x9 : 0.0f, -1e37f), 1e37f);
    const float x13 = etendue_lesser(etendue_greater(etendue_lesser(x11, 1e37f), 0.0f), 1.0f);
    const float x14 = etendue_lesser(etendue_greater(x12, 0.0f), 1.0f);
    const float x15 = fmaf(prepared.surface_plane_normal.x, w.x, fmaf(prepared.surface_plane_normal.y, w.y, prepared.surface_plane_normal.z * w.z));
    const float x16 = etendue_greater(etendue_lesser(etendue_greater((1e-37f < fabsf(x15)) ? prepared.surface_plane_height / x15 : 0.0f, -1e37f), 1e37f), 0.0f);
    bool b17 = false;
    if (!b8) {
        const bool b18 = (-prepared.shape_slack.y <= fmaf(prepared.shape_side12.x, w.x, fmaf(prepared.shape_side12.y, w.y, prepared.shape_side12.z * w.z))) && (-prepared.shape_slack.z <= x2);
        const bool b19 = -(sqrtf(fmaf(prepared.shape_normal.x, prepared.shape_normal.x, fmaf(prepared.shape_normal.y, prepared.shape_normal.y, prepared.shape_normal.z * prepared.shape_normal.z))) * 7.1525574e-7f) <= x5;
        b17 = b18 && (-prepared.shape_slack.x <= x1) && b19;
    }
    const float x20 = (b8 || b17) ? etendue_lesser(etendue_greater((1e-37f < fabsf(prepared.shape_solid_angle)) ? 1.0f / prepared.shape_solid_angle : 0.0f, -1e37f), 1e37f) : 0.0f;
    const bool b21 = 0.0f < x20;
    const float x22 = b21 ? etendue_lesser(prepared.surface_plane_unit * x16, 3.4028235e38f) : 0.0f;
    const bool b23 = b4 && b21;
    const float x24 = (b23 && (1e-37f < x20)) ? 1.0f / x20 : 0.0f;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = x22;
    result.pdf = x20;
    result.weight = x24;
    result.normal.x = prepared.surface_plane_normal.x;
    result.normal.y = prepared.surface_plane_normal.y;
    result.normal.z = prepared.surface_plane_normal.z;
    result.uv.x = x13;
    result.uv.y = x14;
    result.emits = b23;
    result.delta = false;
    return result;
}

// Prepares a light for the shading point p. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
ETENDUE_FUNCTION EtendueRectangleBySolidAngle etendue_rectangle_by_solid_angle_prepare(EtendueRectangle light, EtendueVec3 p) {
    const float x1 = light.corner.x - p.x;
    const float x2 = light.corner.y - p.y;
    const float x3 = light.corner.z - p.z;
    const float x4 = etendue_greater(etendue_greater(fabsf(x1), fabsf(x2)), fabsf(x3));
    const float x5 = etendue_greater(etendue_greater(fabsf(light.edge_s.x), fabsf(light.edge_s.y)), fabsf(light.edge_s.z));
    const float x6 = etendue_greater(etendue_greater(fabsf(light.edge_t.x), fabsf(light.edge_t.y)), fabsf(light.edge_t.z));
    const float x7 = x6 + (x4 + x5);
    const bool b8 = x7 + x7 < INFINITY;
    const float x9 = etendue_pow2_scale(etendue_greater(etendue_greater(x4, x5), x6));
    const float x10 = x9 * (b8 ? x1 : 0.0f);
    const float x11 = x9 * (b8 ? x2 : 0.0f);
    const float x12 = x9 * (b8 ? x3 : 0.0f);
    const float x13 = x9 * (b8 ? light.edge_s.x : 0.0f);
    const float x14 = x9 * (b8 ? light.edge_s.y : 0.0f);
    const float x15 = x9 * (b8 ? light.edge_s.z : 0.0f);
    const float x16 = x9 * (b8 ? light.edge_t.x : 0.0f);
    const float x17 = x9 * (b8 ? light.edge_t.y : 0.0f);
    const float x18 = x9 * (b8 ? light.edge_t.z : 0.0f);
    const float x19 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x13), fabsf(x14)), fabsf(x15)));
    const float x20 = x13 * x19;
    const float x21 = x14 * x19;
    const float x22 = x15 * x19;
    const float x23 = fmaf(x20, x20, fmaf(x21, x21, x22 * x22));
    const float x24 = (0.0f < x23) ? 1.0f / sqrtf(x23) : 0.0f;
    const float x25 = x20 * x24;
    const float x26 = x21 * x24;
    const float x27 = x22 * x24;
    const float x28 = x23 * x24 / x19;
    const float x29 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x16), fabsf(x17)), fabsf(x18)));
    const float x30 = x16 * x29;
    const float x31 = x17 * x29;
    const float x32 = x18 * x29;
    const float x33 = fmaf(x30, x30, fmaf(x31, x31, x32 * x32));
    const float x34 = (0.0f < x33) ? 1.0f / sqrtf(x33) : 0.0f;
    const float x35 = x30 * x34;
    const float x36 = x31 * x34;
    const float x37 = x32 * x34;
    const float x38 = x33 * x34 / x29;
    const float x39 = x21 * x32;
    const float x40 = x22 * x31;
    const float x41 = x39 - x40;
    const float x42 = x41 - x39;
    const float x43 = x39 - (x41 - x42) + (-x40 - x42) + (fmaf(x21, x32, -x39) - fmaf(x22, x31, -x40));
    const float x44 = x22 * x30;
    const float x45 = x20 * x32;
    const float x46 = x44 - x45;
    const float x47 = x46 - x44;
    const float x48 = x44 - (x46 - x47) + (-x45 - x47) + (fmaf(x22, x30, -x44) - fmaf(x20, x32, -x45));
    const float x49 = x20 * x31;
    const float x50 = x21 * x30;
    const float x51 = x49 - x50;
    const float x52 = x51 - x49;
    const float x53 = x49 - (x51 - x52) + (-x50 - x52) + (fmaf(x20, x31, -x49) - fmaf(x21, x30, -x50));
    const float x54 = x41 + x43;
    const float x55 = x46 + x48;
    const float x56 = x51 + x53;
    const float x57 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x54), fabsf(x55)), fabsf(x56)));
    const float x58 = x54 * x57;
    const float x59 = x55 * x57;
    const float x60 = x56 * x57;
    const float x61 = fmaf(x58, x58, fmaf(x59, x59, x60 * x60));
    const float x62 = (0.0f < x61) ? 1.0f / sqrtf(x61) : 0.0f;
    const float x63 = x58 * x62;
    const float x64 = x59 * x62;
    const float x65 = x60 * x62;
    const float x66 = x61 * x62 / x57;
    const float x67 = x10 * x41;
    const float x68 = x11 * x46;
    const float x69 = x12 * x51;
    const float x70 = x67 + x68;
    const float x71 = x70 - x67;
    const float x72 = x69 + x70;
    const float x73 = x72 - x70;
    const float x74 = x67 - (x70 - x71) + (x68 - x71) + (x70 - (x72 - x73) + (x69 - x73));
    const float x75 = fmaf(x10, x41, -x67) + (fmaf(x11, x46, -x68) + fmaf(x12, x51, -x69));
    const float x76 = (x72 + (x74 + x75 + fmaf(x10, x43, fmaf(x11, x48, x12 * x53)))) / x66;
    const float x77 = (0.0f < x66) ? x76 : 0.0f;
    const float x78 = x10 + x13;
    const float x79 = x11 + x14;
    const float x80 = x12 + x15;
    const float x81 = x16 + x78;
    const float x82 = x17 + x79;
    const float x83 = x18 + x80;
    const float x84 = x10 + x16;
    const float x85 = x11 + x17;
    const float x86 = x12 + x18;
    const float x87 = fabsf(x77);
    const float x88 = etendue_copysign(1.0f, x77);
    const float x89 = x10 * x20;
    const float x90 = x11 * x21;
    const float x91 = x12 * x22;
    const float x92 = x89 + x90;
    const float x93 = x92 - x89;
    const float x94 = x91 + x92;
    const float x95 = x94 - x92;
    const float x96 = x89 - (x92 - x93) + (x90 - x93) + (x92 - (x94 - x95) + (x91 - x95));
    const float x97 = fmaf(x10, x20, -x89) + (fmaf(x11, x21, -x90) + fmaf(x12, x22, -x91));
    const float x98 = x96 + x97;
    const float x99 = x13 * x20;
    const float x100 = x14 * x21;
    const float x101 = x15 * x22;
    const float x102 = x99 + x100;
    const float x103 = x102 - x99;
    const float x104 = x101 + x102;
    const float x105 = x104 - x102;
    const float x106 = x99 - (x102 - x103) + (x100 - x103) + (x102 - (x104 - x105) + (x101 - x105));
    const float x107 = fmaf(x13, x20, -x99) + (fmaf(x14, x21, -x100) + fmaf(x15, x22, -x101));
    const float x108 = x24 * (x94 + x98);
    const float x109 = x94 + x104;
    const float x110 = x109 - x94;
    const float x111 = x94 - (x109 - x110) + (x104 - x110) + (x98 + (x106 + x107));
    const float x112 = x24 * (x109 + x111);
    const bool b113 = x108 + x112 < 0.0f;
    const float x114 = etendue_greater(b113 ? -x112 : x108, x28 * -0.5f);
    const float x115 = x28 + x114;
    const float x116 = x10 * x30;
    const float x117 = x11 * x31;
    const float x118 = x12 * x32;
    const float x119 = x116 + x117;
    const float x120 = x119 - x116;
    const float x121 = x118 + x119;
    const float x122 = x121 - x119;
    const float x123 = x116 - (x119 - x120) + (x117 - x120) + (x119 - (x121 - x122) + (x118 - x122));
    const float x124 = fmaf(x10, x30, -x116) + (fmaf(x11, x31, -x117) + fmaf(x12, x32, -x118));
    const float x125 = x123 + x124;
    const float x126 = x16 * x30;
    const float x127 = x17 * x31;
    const float x128 = x18 * x32;
    const float x129 = x126 + x127;
    const float x130 = x129 - x126;
    const float x131 = x128 + x129;
    const float x132 = x131 - x129;
    const float x133 = x126 - (x129 - x130) + (x127 - x130) + (x129 - (x131 - x132) + (x128 - x132));
    const float x134 = fmaf(x16, x30, -x126) + (fmaf(x17, x31, -x127) + fmaf(x18, x32, -x128));
    const float x135 = x34 * (x121 + x125);
    const float x136 = x121 + x131;
    const float x137 = x136 - x121;
    const float x138 = x121 - (x136 - x137) + (x131 - x137) + (x125 + (x133 + x134));
    const float x139 = x34 * (x136 + x138);
    const bool b140 = x135 + x139 < 0.0f;
    const float x141 = etendue_greater(b140 ? -x139 : x135, x38 * -0.5f);
    const float x142 = x38 + x141;
    const float x143 = b113 ? -x25 : x25;
    const float x144 = b113 ? -x26 : x26;
    const float x145 = b113 ? -x27 : x27;
    const float x146 = b140 ? -x35 : x35;
    const float x147 = b140 ? -x36 : x36;
    const float x148 = b140 ? -x37 : x37;
    const bool b149 = x115 <= x114 + x114;
    const bool b150 = x142 <= x141 + x141;
    const float x151 = b149 ? x115 : 0.0f;
    const float x152 = b150 ? x142 : 0.0f;
    const float x153 = x115 - x151;
    const float x154 = x142 - x152;
    const float x155 = (b113 ? (b140 ? x10 : x84) : (b140 ? x78 : x81)) - x143 * x153 - x146 * x154;
    const float x156 = (b113 ? (b140 ? x11 : x85) : (b140 ? x79 : x82)) - x144 * x153 - x147 * x154;
    const float x157 = (b113 ? (b140 ? x12 : x86) : (b140 ? x80 : x83)) - x145 * x153 - x148 * x154;
    const bool b158 = etendue_greater(x153, x154) <= etendue_greater(etendue_greater(x151, x152), x87);
    const float x159 = b158 ? x155 : fmaf(x143, x151, fmaf(x146, x152, x63 * x77));
    const float x160 = b158 ? x156 : fmaf(x144, x151, fmaf(x147, x152, x64 * x77));
    const float x161 = b158 ? x157 : fmaf(x145, x151, fmaf(x148, x152, x65 * x77));
    const float x162 = x87 * x87;
    const float x163 = x141 * x142;
    const float x164 = sqrtf(fmaf(x141, x141, x162) * fmaf(x142, x142, x162));
    const float x165 = (0.0f < x164) ? 1.0f / x164 : 0.0f;
    const bool b166 = x141 < 0.0f;
    const float x167 = x115 * x115;
    const float x168 = x162 + x167;
    const float x169 = sqrtf(fmaf(x141, x141, x168));
    const float x170 = fmaf(x142, x142, x168);
    const float x171 = sqrtf(x170);
    const float x172 = x169 * x171;
    const float x173 = (0.0f < x168) ? 1.0f / x168 : 0.0f;
    const float x174 = fabsf(x141);
    const float x175 = fmaf(x142, x169, x171 * x174);
    const float x176 = x38 * (x141 + x142);
    const float x177 = fabsf(x163);
    const float x178 = x172 + x177;
    const float x179 = (b166 ? x173 * x175 : ((0.0f < x175) ? x176 / x175 : 0.0f)) * (x87 * x115);
    const float x180 = x165 * x179;
    const float x181 = x165 * (x173 * fmaf(x163, x167, x162 * x172));
    const float x182 = x165 * (x38 * (x38 * x162));
    const float x183 = 1.0f + ((0.0f < x178) ? fmaf(x141, x141, x170) / x178 : 0.0f);
    const float x184 = x168 + x178;
    const float x185 = b166 ? x168 * x183 : x184;
    const float x186 = (0.0f < x185) ? x182 / x185 : 0.0f;
    const float x187 = x162 * x165;
    const float x188 = x187 * (b166 ? x173 * x184 : x183);
    const bool b189 = x114 < 0.0f;
    const float x190 = -x114 * -x114;
    const float x191 = x162 + x190;
    const float x192 = sqrtf(fmaf(x141, x141, x191));
    const float x193 = fmaf(x142, x142, x191);
    const float x194 = sqrtf(x193);
    const float x195 = x192 * x194;
    const float x196 = (0.0f < x191) ? 1.0f / x191 : 0.0f;
    const float x197 = fmaf(x142, x192, x174 * x194);
    const float x198 = x177 + x195;
    const float x199 = (b166 ? x196 * x197 : ((0.0f < x197) ? x176 / x197 : 0.0f)) * (x87 * -x114);
    const float x200 = x165 * x199;
    const float x201 = x165 * (x196 * fmaf(x163, x190, x162 * x195));
    const float x202 = 1.0f + ((0.0f < x198) ? fmaf(x141, x141, x193) / x198 : 0.0f);
    const float x203 = x191 + x198;
    const float x204 = b166 ? x191 * x202 : x203;
    const float x205 = (0.0f < x204) ? x182 / x204 : 0.0f;
    const float x206 = x187 * (b166 ? x196 * x203 : x202);
    const bool b207 = b166 || b189;
    const bool b208 = b166 && !b189;
    const float x209 = b208 ? x141 : x114;
    const float x210 = b208 ? x114 : x141;
    const float x211 = b208 ? x142 : x115;
    const float x212 = b208 ? x115 : x142;
    const float x213 = fmaf(x209, x209, x162);
    const float x214 = fmaf(x211, x211, x162);
    const float x215 = sqrtf(fmaf(x210, x210, x213));
    const float x216 = sqrtf(fmaf(x212, x212, x213));
    const float x217 = sqrtf(fmaf(x210, x210, x214));
    const float x218 = sqrtf(fmaf(x212, x212, x214));
    const float x219 = x210 * x212;
    const bool b220 = 0.0f <= x210;
    const float x221 = fabsf(x210);
    const float x222 = fmaf(x212, x217, x218 * x221);
    const float x223 = (b208 ? x28 : x38) * (x210 + x212);
    const float x224 = (b220 ? ((0.0f < x222) ? x214 * x223 / x222 : 0.0f) : x222) * (x87 * fabsf(x211));
    const float x225 = fmaf(x212, x215, x216 * x221);
    const float x226 = (b220 ? ((0.0f < x225) ? x213 * x223 / x225 : 0.0f) : x225) * (x87 * fabsf(x209));
    const float x227 = x215 * x216;
    const float x228 = x38 * (x28 * x87);
    const float x229 = x209 * x211;
    const float x230 = x162 + (x219 + x229);
    const float x231 = fmaf(x218, x215 * x217, fmaf(x218, x229 + fmaf(x210, x210, x162), fmaf(x217, x230, x215 * (x214 + x219))));
    const float x232 = fmaf(x218, x227, fmaf(x215, x229 + fmaf(x212, x212, x162), fmaf(x216, x230, x218 * (x213 + x219))));
    const float x233 = etendue_angle(b207 ? x224 : x228, b207 ? fmaf(x219, x211 * x211, x162 * (x217 * x218)) : x231);
    const float x234 = x233 + etendue_angle(b207 ? x226 : x228, b207 ? fmaf(x219, x209 * x209, x162 * x227) : x232);
    const float x235 = x234 * (b207 ? 1.0f : 2.0f);
    const bool b236 = 0.0f < x180;
    const bool b237 = b8 && (1e-36f < x235) && (x235 < 7.0f) && b236 && (1e-18f < x87);
    const float x238 = x11 * x15;
    const float x239 = x12 * x14;
    const float x240 = x238 - x239;
    const float x241 = x240 - x238;
    const float x242 = x238 - (x240 - x241) + (-x239 - x241) + (fmaf(x11, x15, -x238) - fmaf(x12, x14, -x239));
    const float x243 = x12 * x13;
    const float x244 = x10 * x15;
    const float x245 = x243 - x244;
    const float x246 = x245 - x243;
    const float x247 = x243 - (x245 - x246) + (-x244 - x246) + (fmaf(x12, x13, -x243) - fmaf(x10, x15, -x244));
    const float x248 = x10 * x14;
    const float x249 = x11 * x13;
    const float x250 = x248 - x249;
    const float x251 = x250 - x248;
    const float x252 = x248 - (x250 - x251) + (-x249 - x251) + (fmaf(x10, x14, -x248) - fmaf(x11, x13, -x249));
    const float x253 = x11 * x18;
    const float x254 = x12 * x17;
    const float x255 = x253 - x254;
    const float x256 = x255 - x253;
    const float x257 = x253 - (x255 - x256) + (-x254 - x256) + (fmaf(x11, x18, -x253) - fmaf(x12, x17, -x254));
    const float x258 = x12 * x16;
    const float x259 = x10 * x18;
    const float x260 = x258 - x259;
    const float x261 = x260 - x258;
    const float x262 = x258 - (x260 - x261) + (-x259 - x261) + (fmaf(x12, x16, -x258) - fmaf(x10, x18, -x259));
    const float x263 = x10 * x17;
    const float x264 = x11 * x16;
    const float x265 = x263 - x264;
    const float x266 = x265 - x263;
    const float x267 = x263 - (x265 - x266) + (-x264 - x266) + (fmaf(x10, x17, -x263) - fmaf(x11, x16, -x264));
    const float x268 = x14 * x18;
    const float x269 = x15 * x17;
    const float x270 = x268 - x269;
    const float x271 = x270 - x268;
    const float x272 = x268 - (x270 - x271) + (-x269 - x271) + (fmaf(x14, x18, -x268) - fmaf(x15, x17, -x269));
    const float x273 = x15 * x16;
    const float x274 = x13 * x18;
    const float x275 = x273 - x274;
    const float x276 = x275 - x273;
    const float x277 = x273 - (x275 - x276) + (-x274 - x276) + (fmaf(x15, x16, -x273) - fmaf(x13, x18, -x274));
    const float x278 = x13 * x17;
    const float x279 = x14 * x16;
    const float x280 = x278 - x279;
    const float x281 = x280 - x278;
    const float x282 = x278 - (x280 - x281) + (-x279 - x281) + (fmaf(x13, x17, -x278) - fmaf(x14, x16, -x279));
    const float x283 = -x255 - x257;
    const float x284 = -x260 - x262;
    const float x285 = -x265 - x267;
    const float x286 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x283), fabsf(x284)), fabsf(x285)));
    const float x287 = x283 * x286;
    const float x288 = x284 * x286;
    const float x289 = x285 * x286;
    const float x290 = fmaf(x287, x287, fmaf(x288, x288, x289 * x289));
    const float x291 = (0.0f < x290) ? 1.0f / sqrtf(x290) : 0.0f;
    const float x292 = x287 * x291;
    const float x293 = x288 * x291;
    const float x294 = x289 * x291;
    const float x295 = x290 * x291 / x286;
    const bool b296 = x88 < 0.0f;
    const float x297 = b296 ? -x292 : x292;
    const float x298 = b296 ? -x293 : x293;
    const float x299 = b296 ? -x294 : x294;
    const float x300 = (0.0f < x295) ? -fmaf(x10, x84, fmaf(x11, x85, x12 * x86)) / x295 : 0.0f;
    const float x301 = etendue_lesser(etendue_greater(x300, 1.0f), 1e18f) * 4.7683716e-7f;
    const float x302 = x255 + x270;
    const float x303 = x302 - x255;
    const float x304 = x260 + x275;
    const float x305 = x304 - x260;
    const float x306 = x265 + x280;
    const float x307 = x306 - x265;
    const float x308 = x302 + (x255 - (x302 - x303) + (x270 - x303) + (x257 + x272));
    const float x309 = x304 + (x260 - (x304 - x305) + (x275 - x305) + (x262 + x277));
    const float x310 = x306 + (x265 - (x306 - x307) + (x280 - x307) + (x267 + x282));
    const float x311 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x308), fabsf(x309)), fabsf(x310)));
    const float x312 = x308 * x311;
    const float x313 = x309 * x311;
    const float x314 = x310 * x311;
    const float x315 = fmaf(x312, x312, fmaf(x313, x313, x314 * x314));
    const float x316 = (0.0f < x315) ? 1.0f / sqrtf(x315) : 0.0f;
    const float x317 = x312 * x316;
    const float x318 = x313 * x316;
    const float x319 = x314 * x316;
    const float x320 = x315 * x316 / x311;
    const float x321 = b296 ? -x317 : x317;
    const float x322 = b296 ? -x318 : x318;
    const float x323 = b296 ? -x319 : x319;
    const float x324 = (0.0f < x320) ? -fmaf(x78, x81, fmaf(x79, x82, x80 * x83)) / x320 : 0.0f;
    const float x325 = 4.7683716e-7f * etendue_lesser(etendue_greater(x324, 1.0f), 1e18f);
    const float x326 = x240 + x242;
    const float x327 = x245 + x247;
    const float x328 = x250 + x252;
    const float x329 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x326), fabsf(x327)), fabsf(x328)));
    const float x330 = x326 * x329;
    const float x331 = x327 * x329;
    const float x332 = x328 * x329;
    const float x333 = fmaf(x330, x330, fmaf(x331, x331, x332 * x332));
    const float x334 = (0.0f < x333) ? 1.0f / sqrtf(x333) : 0.0f;
    const float x335 = x330 * x334;
    const float x336 = x331 * x334;
    const float x337 = x332 * x334;
    const float x338 = x333 * x334 / x329;
    const float x339 = b296 ? -x335 : x335;
    const float x340 = b296 ? -x336 : x336;
    const float x341 = b296 ? -x337 : x337;
    const float x342 = (0.0f < x338) ? -fmaf(x10, x78, fmaf(x11, x79, x12 * x80)) / x338 : 0.0f;
    const float x343 = 4.7683716e-7f * etendue_lesser(etendue_greater(x342, 1.0f), 1e18f);
    const float x344 = x270 - x240;
    const float x345 = x344 - x270;
    const float x346 = x275 - x245;
    const float x347 = x346 - x275;
    const float x348 = x280 - x250;
    const float x349 = x348 - x280;
    const float x350 = x270 - (x344 - x345) + (-x240 - x345) + (x272 - x242);
    const float x351 = x275 - (x346 - x347) + (-x245 - x347) + (x277 - x247);
    const float x352 = x280 - (x348 - x349) + (-x250 - x349) + (x282 - x252);
    const float x353 = x344 + x350;
    const float x354 = x346 + x351;
    const float x355 = x348 + x352;
    const float x356 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x353), fabsf(x354)), fabsf(x355)));
    const float x357 = x353 * x356;
    const float x358 = x354 * x356;
    const float x359 = x355 * x356;
    const float x360 = fmaf(x357, x357, fmaf(x358, x358, x359 * x359));
    const float x361 = (0.0f < x360) ? 1.0f / sqrtf(x360) : 0.0f;
    const float x362 = x357 * x361;
    const float x363 = x358 * x361;
    const float x364 = x359 * x361;
    const float x365 = x360 * x361 / x356;
    const float x366 = b296 ? -x362 : x362;
    const float x367 = b296 ? -x363 : x363;
    const float x368 = b296 ? -x364 : x364;
    const float x369 = (0.0f < x365) ? -fmaf(x81, x84, fmaf(x82, x85, x83 * x86)) / x365 : 0.0f;
    const float x370 = 4.7683716e-7f * etendue_lesser(etendue_greater(x369, 1.0f), 1e18f);
    const float x371 = b113 ? x321 : x297;
    const float x372 = b113 ? x322 : x298;
    const float x373 = b113 ? x323 : x299;
    const float x374 = b113 ? x297 : x321;
    const float x375 = b113 ? x298 : x322;
    const float x376 = b113 ? x299 : x323;
    const float x377 = b140 ? x366 : x339;
    const float x378 = b140 ? x367 : x340;
    const float x379 = b140 ? x368 : x341;
    const float x380 = b140 ? x339 : x366;
    const float x381 = b140 ? x340 : x367;
    const float x382 = b140 ? x341 : x368;
    const float x383 = b113 ? x325 : x301;
    const float x384 = b140 ? x370 : x343;
    const float x385 = b113 ? x301 : x325;
    const float x386 = b140 ? x343 : x370;
    const float x387 = x63 * x88;
    const float x388 = x64 * x88;
    const float x389 = x65 * x88;
    const float x390 = b149 ? 1.0f : 0.0f;
    const float x391 = b150 ? 1.0f : 0.0f;
    const float x392 = b113 ? 1.0f : 0.0f;
    const float x393 = b140 ? 1.0f : 0.0f;
    const float x394 = b236 ? 1.0f / x180 : 0.0f;
    const float x395 = b189 ? 0.5f : 2.0f;
    const float x396 = b237 ? x235 : 0.0f;
    const float x397 = 1.0f / x9;
    const float x398 = etendue_greater(etendue_greater(etendue_greater(0.0f, x4), x5), x6);
    const bool b399 = x398 < INFINITY;
    const float x400 = etendue_pow2_scale(x398);
    const float x401 = x400 * (b399 ? x1 : 0.0f);
    const float x402 = x400 * (b399 ? x2 : 0.0f);
    const float x403 = x400 * (b399 ? x3 : 0.0f);
    const float x404 = x400 * (b399 ? light.edge_s.x : 0.0f);
    const float x405 = x400 * (b399 ? light.edge_s.y : 0.0f);
    const float x406 = x400 * (b399 ? light.edge_s.z : 0.0f);
    const float x407 = x400 * (b399 ? light.edge_t.x : 0.0f);
    const float x408 = x400 * (b399 ? light.edge_t.y : 0.0f);
    const float x409 = x400 * (b399 ? light.edge_t.z : 0.0f);
    const float x410 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x404), fabsf(x405)), fabsf(x406)));
    const float x411 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x407), fabsf(x408)), fabsf(x409)));
    const float x412 = x404 * x410;
    const float x413 = x405 * x410;
    const float x414 = x406 * x410;
    const float x415 = x407 * x411;
    const float x416 = x408 * x411;
    const float x417 = x409 * x411;
    const float x418 = x413 * x417;
    const float x419 = x414 * x416;
    const float x420 = x418 - x419;
    const float x421 = x420 - x418;
    const float x422 = x418 - (x420 - x421) + (-x419 - x421) + (fmaf(x413, x417, -x418) - fmaf(x414, x416, -x419));
    const float x423 = x414 * x415;
    const float x424 = x412 * x417;
    const float x425 = x423 - x424;
    const float x426 = x425 - x423;
    const float x427 = x423 - (x425 - x426) + (-x424 - x426) + (fmaf(x414, x415, -x423) - fmaf(x412, x417, -x424));
    const float x428 = x412 * x416;
    const float x429 = x413 * x415;
    const float x430 = x428 - x429;
    const float x431 = x430 - x428;
    const float x432 = x428 - (x430 - x431) + (-x429 - x431) + (fmaf(x412, x416, -x428) - fmaf(x413, x415, -x429));
    const float x433 = x420 + x422;
    const float x434 = x425 + x427;
    const float x435 = x430 + x432;
    const float x436 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x433), fabsf(x434)), fabsf(x435)));
    const float x437 = x433 * x436;
    const float x438 = x434 * x436;
    const float x439 = x435 * x436;
    const float x440 = fmaf(x437, x437, fmaf(x438, x438, x439 * x439));
    const float x441 = (0.0f < x440) ? 1.0f / sqrtf(x440) : 0.0f;
    const float x442 = x437 * x441;
    const float x443 = x438 * x441;
    const float x444 = x439 * x441;
    const float x445 = x440 * x441 / x436;
    const float x446 = x401 * x420;
    const float x447 = x402 * x425;
    const float x448 = x403 * x430;
    const float x449 = x446 + x447;
    const float x450 = x449 - x446;
    const float x451 = x448 + x449;
    const float x452 = x451 - x449;
    const float x453 = x446 - (x449 - x450) + (x447 - x450) + (x449 - (x451 - x452) + (x448 - x452));
    const float x454 = fmaf(x401, x420, -x446) + (fmaf(x402, x425, -x447) + fmaf(x403, x430, -x448));
    const float x455 = (x451 + (x453 + x454 + fmaf(x401, x422, fmaf(x402, x427, x403 * x432)))) / x445;
    const float x456 = etendue_lesser(etendue_greater((1e-37f < fabsf(x445)) ? x455 : 0.0f, -1e37f), 1e37f);
    const float x457 = x445 / x410 / x411;
    const float x458 = x442 * x457;
    const float x459 = x443 * x457;
    const float x460 = x444 * x457;
    const float x461 = -(x403 * x405);
    const float x462 = fmaf(x402, x406, x461) - fmaf(x403, x405, x461);
    const float x463 = -(x401 * x406);
    const float x464 = fmaf(x403, x404, x463) - fmaf(x401, x406, x463);
    const float x465 = -(x402 * x404);
    const float x466 = fmaf(x401, x405, x465) - fmaf(x402, x404, x465);
    const float x467 = -(x403 * x408);
    const float x468 = fmaf(x402, x409, x467) - fmaf(x403, x408, x467);
    const float x469 = -(x401 * x409);
    const float x470 = fmaf(x403, x407, x469) - fmaf(x401, x409, x469);
    const float x471 = -(x402 * x407);
    const float x472 = fmaf(x401, x408, x471) - fmaf(x402, x407, x471);
    const float x473 = 1.0f / x400;
    EtendueRectangleBySolidAngle result;
    result.surface_plane_cross.x = x458;
    result.surface_plane_cross.y = x459;
    result.surface_plane_cross.z = x460;
    result.surface_plane_normal.x = x442;
    result.surface_plane_normal.y = x443;
    result.surface_plane_normal.z = x444;
    result.surface_plane_height = x456;
    result.surface_plane_along_first.x = x462;
    result.surface_plane_along_first.y = x464;
    result.surface_plane_along_first.z = x466;
    result.surface_plane_along_second.x = x468;
    result.surface_plane_along_second.y = x470;
    result.surface_plane_along_second.z = x472;
    result.surface_plane_unit = x473;
    result.shape_base.x = x159;
    result.shape_base.y = x160;
    result.shape_base.z = x161;
    result.shape_side_x.x = x143;
    result.shape_side_x.y = x144;
    result.shape_side_x.z = x145;
    result.shape_side_y.x = x146;
    result.shape_side_y.y = x147;
    result.shape_side_y.z = x148;
    result.shape_near_x.x = x371;
    result.shape_near_x.y = x372;
    result.shape_near_x.z = x373;
    result.shape_far_x.x = x374;
    result.shape_far_x.y = x375;
    result.shape_far_x.z = x376;
    result.shape_near_y.x = x377;
    result.shape_near_y.y = x378;
    result.shape_near_y.z = x379;
    result.shape_far_y.x = x380;
    result.shape_far_y.y = x381;
    result.shape_far_y.z = x382;
    result.shape_slack.x = x383;
    result.shape_slack.y = x384;
    result.shape_slack_far.x = x385;
    result.shape_slack_far.y = x386;
    result.shape_normal.x = x387;
    result.shape_normal.y = x388;
    result.shape_normal.z = x389;
    result.shape_near.x = x114;
    result.shape_near.y = x141;
    result.shape_far.x = x115;
    result.shape_far.y = x142;
    result.shape_size.x = x28;
    result.shape_size.y = x38;
    result.shape_height = x87;
    result.shape_anchor.x = x390;
    result.shape_anchor.y = x391;
    result.shape_flip.x = x392;
    result.shape_flip.y = x393;
    result.shape_sin_w1 = x180;
    result.shape_cos_w1 = x181;
    result.shape_inv_sin_w1 = x394;
    result.shape_above_p = x186;
    result.shape_above_s = x188;
    result.shape_near_sin = x200;
    result.shape_near_cos = x201;
    result.shape_near_above_p = x205;
    result.shape_near_above_s = x206;
    result.shape_half = x395;
    result.shape_solid_angle = x396;
    result.shape_side = x88;
    result.shape_unit = x397;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian. Greatest error over the atlas: direction 6e-7 (4e-5 of the rectangle's size if that is 1e-6 and the point
// is 1e-7 above its plane), besides what 8 steps of 2^-24 in u do to it (Omega and u0Omega are rounded; u0 counts from
// the nearer end where the rectangle lies on both sides of the foot). pdf 5e-7 relative, since heights and coordinates
// are formed in twice the working precision. Next to the plane of a rectangle that surrounds the point, nearly all of
// u0 lies within the rounding of a direction at the ends: the inverse is then one of the u that lead back to the
// direction.
ETENDUE_FUNCTION EtendueLightSample etendue_rectangle_by_solid_angle_sample(EtendueRectangleBySolidAngle prepared, EtendueVec2 u) {
    const bool b1 = 0.0f < prepared.shape_flip.x;
    const float x2 = 1.0f - u.x;
    const float x3 = b1 ? u.x : x2;
    const bool b4 = prepared.shape_half < x3;
    const float x5 = b4 ? prepared.shape_near_sin : prepared.shape_sin_w1;
    const float x6 = b4 ? prepared.shape_near_cos : prepared.shape_cos_w1;
    const EtendueVec2 v7 = etendue_sin_cos_turns((b4 ? (b1 ? x2 : 1.0f - x2) : x3) * (prepared.shape_solid_angle * 0.07957747f));
    const float x8 = etendue_greater(fmaf(x5, v7.y, -(x6 * v7.x)), -(b4 ? 1.0f : 0.0f));
    const float x9 = -(v7.x * fmaf(x6, v7.y, x5 * v7.x));
    const float x10 = x8 + x8;
    const float x11 = v7.x * x10;
    const float x12 = sqrtf(etendue_greater((x11 + (b4 ? prepared.shape_near_above_p : prepared.shape_above_p)) * (x11 + (b4 ? prepared.shape_near_above_s : prepared.shape_above_s)), 0.0f));
    const float x13 = fmaf(prepared.shape_sin_w1 * prepared.shape_sin_w1, x11 + (prepared.shape_above_p + prepared.shape_above_s), (x11 + (prepared.shape_cos_w1 + prepared.shape_cos_w1)) * (prepared.shape_above_p * prepared.shape_above_s));
    const float x14 = prepared.shape_far.x * (prepared.shape_far.x * (x13 * (prepared.shape_inv_sin_w1 * x10 * (prepared.shape_inv_sin_w1 * v7.x))));
    const float x15 = prepared.shape_height * fmaf(v7.y, x8, x9);
    const float x16 = b4 ? -x15 : x15;
    const bool b17 = 0.0f < prepared.shape_anchor.x;
    const float x18 = x12 * (b17 ? fmaf(prepared.shape_far.x, x12, x16) : 1.0f);
    const float x19 = etendue_greater((b17 ? -x14 : x16) / ((0.0f < x18) ? x18 : 1.0f), b17 ? -prepared.shape_size.x : prepared.shape_near.x);
    const float x20 = etendue_lesser(x19, b17 ? 0.0f : prepared.shape_far.x);
    const float x21 = x20 + (b17 ? prepared.shape_far.x : 0.0f);
    const float x22 = fmaf(x21, x21, prepared.shape_height * prepared.shape_height);
    const bool b23 = 0.0f < prepared.shape_flip.y;
    const float x24 = 1.0f - u.y;
    const float x25 = sqrtf(fmaf(prepared.shape_near.y, prepared.shape_near.y, x22));
    const float x26 = sqrtf(fmaf(prepared.shape_far.y, prepared.shape_far.y, x22));
    const float x27 = fmaf(prepared.shape_far.y, x25, x26 * fabsf(prepared.shape_near.y));
    const float x28 = x27 * (x25 * x26);
    const float x29 = (0.0f < x28) ? 1.0f / x28 : 0.0f;
    const float x30 = x27 * x29;
    const float x31 = x25 * x30;
    const float x32 = prepared.shape_far.y * x31;
    const float x33 = (0.0f <= prepared.shape_near.y) ? x29 * (x22 * (prepared.shape_size.y * (prepared.shape_near.y + prepared.shape_far.y))) : x27 * x30;
    const float x34 = x30 * (prepared.shape_near.y * x26);
    const float x35 = (b23 ? u.y : x24) * x33;
    const float x36 = (b23 ? x24 : 1.0f - x24) * x33;
    const float x37 = x34 + x36;
    const bool b38 = x37 < 0.0f;
    const float x39 = b38 ? x37 : x32 - x35;
    const float x40 = (b38 ? -x36 : x35) * (x39 + (b38 ? x34 : x32));
    const float x41 = x30 * (b38 ? x26 : x25);
    const float x42 = sqrtf(etendue_greater(x22 * fmaf(x41, x22 * x41, x40), 0.0f));
    const bool b43 = 0.0f < prepared.shape_anchor.y;
    const float x44 = x42 * (b43 ? fmaf(x32, x42, x31 * (x22 * x39)) : 1.0f);
    const float x45 = x22 * (b43 ? -(x26 * x40) : x39) / ((0.0f < x44) ? x44 : 1.0f);
    const float x46 = etendue_lesser(etendue_greater(x45, b43 ? -prepared.shape_size.y : prepared.shape_near.y), b43 ? 0.0f : prepared.shape_far.y);
    const float x47 = fmaf(prepared.shape_side_x.x, x20, fmaf(prepared.shape_side_y.x, x46, prepared.shape_base.x));
    const float x48 = fmaf(prepared.shape_side_x.y, x20, fmaf(prepared.shape_side_y.y, x46, prepared.shape_base.y));
    const float x49 = fmaf(prepared.shape_side_x.z, x20, fmaf(prepared.shape_side_y.z, x46, prepared.shape_base.z));
    const float x50 = fmaf(x47, x47, fmaf(x48, x48, x49 * x49));
    const float x51 = (1e-37f < x50) ? 1.0f / sqrtf(x50) : 0.0f;
    const float x52 = x47 * x51;
    const float x53 = x48 * x51;
    const float x54 = x49 * x51;
    const bool b55 = 0.0f < prepared.shape_solid_angle;
    const float x56 = b55 ? prepared.shape_unit * (x50 * x51) : 0.0f;
    const float x57 = b55 ? 1.0f / prepared.shape_solid_angle : 0.0f;
    const bool b58 = prepared.shape_side < 0.0f;
    const float x59 = fmaf(prepared.surface_plane_cross.x, x52, fmaf(prepared.surface_plane_cross.y, x53, prepared.surface_plane_cross.z * x54));
    const bool b60 = 1e-37f < fabsf(x59);
    const float x61 = etendue_greater(b60 ? -fmaf(prepared.surface_plane_along_second.x, x52, fmaf(prepared.surface_plane_along_second.y, x53, prepared.surface_plane_along_second.z * x54)) / x59 : 0.0f, -1e37f);
    const float x62 = etendue_lesser(etendue_greater(b60 ? fmaf(prepared.surface_plane_along_first.x, x52, fmaf(prepared.surface_plane_along_first.y, x53, prepared.surface_plane_along_first.z * x54)) / x59 : 0.0f, -1e37f), 1e37f);
    const float x63 = etendue_lesser(etendue_greater(etendue_lesser(x61, 1e37f), 0.0f), 1.0f);
    const float x64 = etendue_lesser(etendue_greater(x62, 0.0f), 1.0f);
    const float x65 = (b58 && (1e-37f < x57)) ? 1.0f / x57 : 0.0f;
    EtendueLightSample result;
    result.direction.x = x52;
    result.direction.y = x53;
    result.direction.z = x54;
    result.distance = x56;
    result.pdf = x57;
    result.weight = x65;
    result.normal.x = prepared.surface_plane_normal.x;
    result.normal.y = prepared.surface_plane_normal.y;
    result.normal.z = prepared.surface_plane_normal.z;
    result.uv.x = x63;
    result.uv.y = x64;
    result.emits = b58;
    result.delta = false;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the solid angle
// Omega at the point p: pdf 1/Omega per steradian. Greatest error over the atlas: direction 6e-7 (4e-5 of the
// rectangle's size if that is 1e-6 and the point is 1e-7 above its plane), besides what 8 steps of 2^-24 in u do to it
// (Omega and u0Omega are rounded; u0 counts from the nearer end where the rectangle lies on both sides of the foot).
// pdf 5e-7 relative, since heights and coordinates are formed in twice the working precision. Next to the plane of a
// rectangle that surrounds the point, nearly all of u0 lies within the rounding of a direction at the ends: the
// inverse is then one of the u that lead back to the direction.
ETENDUE_FUNCTION float etendue_rectangle_by_solid_angle_pdf(EtendueRectangleBySolidAngle prepared, EtendueVec3 w) {
    const bool b1 = (-prepared.shape_slack.x <= fmaf(prepared.shape_near_x.x, w.x, fmaf(prepared.shape_near_x.y, w.y, prepared.shape_near_x.z * w.z))) && (-prepared.shape_slack_far.x <= fmaf(prepared.shape_far_x.x, w.x, fmaf(prepared.shape_far_x.y, w.y, prepared.shape_far_x.z * w.z)));
    const bool b2 = b1 && (-prepared.shape_slack.y <= fmaf(prepared.shape_near_y.x, w.x, fmaf(prepared.shape_near_y.y, w.y, prepared.shape_near_y.z * w.z))) && (-prepared.shape_slack_far.y <= fmaf(prepared.shape_far_y.x, w.x, fmaf(prepared.shape_far_y.y, w.y, prepared.shape_far_y.z * w.z)));
    const float x3 = (b2 && (-4.7683716e-7f <= fmaf(prepared.shape_normal.x, w.x, fmaf(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z)))) ? ((0.0f < prepared.shape_solid_angle) ? 1.0f / prepared.shape_solid_angle : 0.0f) : 0.0f;
    return x3;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian. Greatest error over the atlas: direction 6e-7
// (4e-5 of the rectangle's size if that is 1e-6 and the point is 1e-7 above its plane), besides what 8 steps of 2^-24
// in u do to it (Omega and u0Omega are rounded; u0 counts from the nearer end where the rectangle lies on both sides
// of the foot). pdf 5e-7 relative, since heights and coordinates are formed in twice the working precision. Next to
// the plane of a rectangle that surrounds the point, nearly all of u0 lies within the rounding of a direction at the
// ends: the inverse is then one of the u that lead back to the direction.
ETENDUE_FUNCTION EtendueLightSample etendue_rectangle_by_solid_angle_hit(EtendueRectangleBySolidAngle prepared, EtendueVec3 w) {
    const bool b1 = (-prepared.shape_slack.x <= fmaf(prepared.shape_near_x.x, w.x, fmaf(prepared.shape_near_x.y, w.y, prepared.shape_near_x.z * w.z))) && (-prepared.shape_slack_far.x <= fmaf(prepared.shape_far_x.x, w.x, fmaf(prepared.shape_far_x.y, w.y, prepared.shape_far_x.z * w.z)));
    const bool b2 = b1 && (-prepared.shape_slack.y <= fmaf(prepared.shape_near_y.x, w.x, fmaf(prepared.shape_near_y.y, w.y, prepared.shape_near_y.z * w.z))) && (-prepared.shape_slack_far.y <= fmaf(prepared.shape_far_y.x, w.x, fmaf(prepared.shape_far_y.y, w.y, prepared.shape_far_y.z * w.z)));
    const float x3 = (b2 && (-4.7683716e-7f <= fmaf(prepared.shape_normal.x, w.x, fmaf(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z)))) ? ((0.0f < prepared.shape_solid_angle) ? 1.0f / prepared.shape_solid_angle : 0.0f) : 0.0f;
    const bool b4 = 0.0f < x3;
    const float x5 = fmaf(prepared.surface_plane_cross.x, w.x, fmaf(prepared.surface_plane_cross.y, w.y, prepared.surface_plane_cross.z * w.z));
    const bool b6 = 1e-37f < fabsf(x5);
    const float x7 = etendue_greater(b6 ? -fmaf(prepared.surface_plane_along_second.x, w.x, fmaf(prepared.surface_plane_along_second.y, w.y, prepared.surface_plane_along_second.z * w.z)) / x5 : 0.0f, -1e37f);
    const float x8 = etendue_lesser(etendue_greater(b6 ? fmaf(prepared.surface_plane_along_first.x, w.x, fmaf(prepared.surface_plane_along_first.y, w.y, prepared.surface_plane_along_first.z * w.z)) / x5 : 0.0f, -1e37f), 1e37f);
    const float x9 = etendue_lesser(etendue_greater(etendue_lesser(x7, 1e37f), 0.0f), 1.0f);
    const float x10 = etendue_lesser(etendue_greater(x8, 0.0f), 1.0f);
    const float x11 = fmaf(prepared.surface_plane_normal.x, w.x, fmaf(prepared.surface_plane_normal.y, w.y, prepared.surface_plane_normal.z * w.z));
    const float x12 = etendue_greater(etendue_lesser(etendue_greater((1e-37f < fabsf(x11)) ? prepared.surface_plane_height / x11 : 0.0f, -1e37f), 1e37f), 0.0f);
    const float x13 = b4 ? etendue_lesser(prepared.surface_plane_unit * x12, 3.4028235e38f) : 0.0f;
    const bool b14 = (prepared.shape_side < 0.0f) && b4;
    const float x15 = (b14 && (1e-37f < x3)) ? 1.0f / x3 : 0.0f;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = x13;
    result.pdf = x3;
    result.weight = x15;
    result.normal.x = prepared.surface_plane_normal.x;
    result.normal.y = prepared.surface_plane_normal.y;
    result.normal.z = prepared.surface_plane_normal.z;
    result.uv.x = x9;
    result.uv.y = x10;
    result.emits = b14;
    result.delta = false;
    return result;
}

// Prepares a light for the shading point p. Uniform over the surface of area A: pdf distance^2/(|cos(theta')| A) per
// steradian, theta' at the light.
ETENDUE_FUNCTION EtendueDiskByArea etendue_disk_by_area_prepare(EtendueDisk light, EtendueVec3 p) {
    const float x1 = light.center.x - p.x;
    const float x2 = light.center.y - p.y;
    const float x3 = light.center.z - p.z;
    const bool b4 = etendue_greater(etendue_greater(fabsf(x1), fabsf(x2)), fabsf(x3)) < INFINITY;
    const float x5 = b4 ? x1 : 0.0f;
    const float x6 = b4 ? x2 : 0.0f;
    const float x7 = b4 ? x3 : 0.0f;
    const float x8 = b4 ? light.radius : 0.0f;
    const float x9 = etendue_copysign(1.0f, light.normal.z);
    const float x10 = -1.0f / (light.normal.z + x9);
    const float x11 = x10 * (light.normal.x * light.normal.y);
    const float x12 = light.normal.x * x9;
    const float x13 = fmaf(light.normal.x, x10 * x12, 1.0f);
    const float x14 = x9 * x11;
    const float x15 = -x12;
    const float x16 = fmaf(light.normal.y, light.normal.y * x10, x9);
    const float x17 = -light.normal.y;
    const float x18 = light.normal.x * x5;
    const float x19 = light.normal.y * x6;
    const float x20 = light.normal.z * x7;
    const float x21 = x18 + x19;
    const float x22 = x21 - x18;
    const float x23 = x20 + x21;
    const float x24 = x23 - x21;
    const float x25 = x18 - (x21 - x22) + (x19 - x22) + (x21 - (x23 - x24) + (x20 - x24));
    const float x26 = fmaf(light.normal.x, x5, -x18) + (fmaf(light.normal.y, x6, -x19) + fmaf(light.normal.z, x7, -x20));
    const float x27 = x23 + (x25 + x26);
    EtendueDiskByArea result;
    result.surface_center.x = x5;
    result.surface_center.y = x6;
    result.surface_center.z = x7;
    result.surface_frame_s.x = x13;
    result.surface_frame_s.y = x14;
    result.surface_frame_s.z = x15;
    result.surface_frame_t.x = x11;
    result.surface_frame_t.y = x16;
    result.surface_frame_t.z = x17;
    result.surface_frame_n.x = light.normal.x;
    result.surface_frame_n.y = light.normal.y;
    result.surface_frame_n.z = light.normal.z;
    result.surface_radius = x8;
    result.surface_height = x27;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the surface of area A: pdf distance^2/(|cos(theta')|
// A) per steradian, theta' at the light.
ETENDUE_FUNCTION EtendueLightSample etendue_disk_by_area_sample(EtendueDiskByArea prepared, EtendueVec2 u) {
    const float x1 = fmaf(u.x, 2.0f, -1.0f);
    const float x2 = fmaf(u.y, 2.0f, -1.0f);
    const bool b3 = fabsf(x2) < fabsf(x1);
    const float x4 = b3 ? x1 : x2;
    const EtendueVec2 v5 = etendue_sin_cos_quarters((b3 ? x2 : x1) * 0.5f / ((0.0f < fabsf(x4)) ? x4 : 1.0f));
    const float x6 = x4 * (b3 ? v5.y : v5.x);
    const float x7 = x4 * (b3 ? v5.x : v5.y);
    const float x8 = prepared.surface_radius * x6;
    const float x9 = prepared.surface_radius * x7;
    const float x10 = prepared.surface_center.x + (prepared.surface_frame_s.x * x8 + prepared.surface_frame_t.x * x9);
    const float x11 = prepared.surface_center.y + (prepared.surface_frame_s.y * x8 + prepared.surface_frame_t.y * x9);
    const float x12 = prepared.surface_center.z + (prepared.surface_frame_s.z * x8 + prepared.surface_frame_t.z * x9);
    const float x13 = etendue_lesser(etendue_greater(fmaf(0.5f, x6, 0.5f), 0.0f), 1.0f);
    const float x14 = etendue_lesser(etendue_greater(fmaf(0.5f, x7, 0.5f), 0.0f), 1.0f);
    const float x15 = etendue_greater(etendue_greater(fabsf(x10), fabsf(x11)), fabsf(x12));
    const bool b16 = x15 < INFINITY;
    const float x17 = etendue_pow2_scale(b16 ? x15 : 0.0f);
    const float x18 = x17 * (b16 ? x10 : 0.0f);
    const float x19 = x17 * (b16 ? x11 : 0.0f);
    const float x20 = x17 * (b16 ? x12 : 0.0f);
    const float x21 = fmaf(x18, x18, fmaf(x19, x19, x20 * x20));
    const float x22 = (0.0f < x21) ? 1.0f / sqrtf(x21) : 0.0f;
    const float x23 = x21 * x22 / x17;
    const float x24 = x18 * x22;
    const float x25 = x19 * x22;
    const float x26 = x20 * x22;
    const float x27 = (x23 < INFINITY) ? x23 : 0.0f;
    const float x28 = fmaf(prepared.surface_frame_n.x, x24, fmaf(prepared.surface_frame_n.y, x25, prepared.surface_frame_n.z * x26));
    const float x29 = fabsf(x28);
    const float x30 = etendue_greater(etendue_lesser(etendue_greater((1e-37f < x29) ? prepared.surface_height / x28 : 0.0f, -1e37f), 1e37f), 0.0f);
    const float x31 = prepared.surface_radius * prepared.surface_radius * 3.1415927f * x29;
    const bool b32 = 0.0f < x31;
    const float x33 = x30 * (x30 / (b32 ? x31 : 1.0f));
    const float x34 = (b32 && (x33 < 1e37f) && (0.0f < x30)) ? x33 : 0.0f;
    const bool b35 = x28 < 0.0f;
    const float x36 = (b35 && (1e-37f < x34)) ? 1.0f / x34 : 0.0f;
    EtendueLightSample result;
    result.direction.x = x24;
    result.direction.y = x25;
    result.direction.z = x26;
    result.distance = x27;
    result.pdf = x34;
    result.weight = x36;
    result.normal.x = prepared.surface_frame_n.x;
    result.normal.y = prepared.surface_frame_n.y;
    result.normal.z = prepared.surface_frame_n.z;
    result.uv.x = x13;
    result.uv.y = x14;
    result.emits = b35;
    result.delta = false;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the surface of area
// A: pdf distance^2/(|cos(theta')| A) per steradian, theta' at the light.
ETENDUE_FUNCTION float etendue_disk_by_area_pdf(EtendueDiskByArea prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.surface_frame_n.x, w.x, fmaf(prepared.surface_frame_n.y, w.y, prepared.surface_frame_n.z * w.z));
    const float x2 = fabsf(x1);
    const float x3 = etendue_greater(etendue_lesser(etendue_greater((1e-37f < x2) ? prepared.surface_height / x1 : 0.0f, -1e37f), 1e37f), 0.0f);
    const float x4 = x2 * (prepared.surface_radius * prepared.surface_radius * 3.1415927f);
    const bool b5 = 0.0f < x4;
    const float x6 = x3 * (x3 / (b5 ? x4 : 1.0f));
    const float x7 = etendue_greater(etendue_greater(etendue_greater(fabsf(prepared.surface_center.x), fabsf(prepared.surface_center.y)), fabsf(prepared.surface_center.z)), fabsf(prepared.surface_radius));
    const float x8 = etendue_pow2_scale(x7);
    const float x9 = prepared.surface_center.x * x8;
    const float x10 = prepared.surface_center.y * x8;
    const float x11 = prepared.surface_center.z * x8;
    const float x12 = prepared.surface_height * x8;
    const float x13 = prepared.surface_radius * x8;
    const float x14 = w.x * x12 - x1 * x9;
    const float x15 = w.y * x12 - x1 * x10;
    const float x16 = w.z * x12 - x1 * x11;
    const float x17 = fmaf(x2, x13, (x13 + sqrtf(fmaf(x9, x9, fmaf(x10, x10, x11 * x11)))) * 7.1525574e-7f);
    const bool b18 = (sqrtf(fmaf(x14, x14, fmaf(x15, x15, x16 * x16))) <= x17) && (0.0f < x1 * x12);
    const float x19 = (b18 && (0.0f < x13)) ? ((b5 && (x6 < 1e37f) && (0.0f < x3)) ? x6 : 0.0f) : 0.0f;
    return x19;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the surface of area A: pdf distance^2/(|cos(theta')| A) per steradian, theta' at the light.
ETENDUE_FUNCTION EtendueLightSample etendue_disk_by_area_hit(EtendueDiskByArea prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.surface_frame_n.x, w.x, fmaf(prepared.surface_frame_n.y, w.y, prepared.surface_frame_n.z * w.z));
    const float x2 = fabsf(x1);
    const float x3 = etendue_lesser(etendue_greater((1e-37f < x2) ? prepared.surface_height / x1 : 0.0f, -1e37f), 1e37f);
    const float x4 = etendue_greater(x3, 0.0f);
    const float x5 = fmaf(w.x, x3, -prepared.surface_center.x);
    const float x6 = fmaf(w.y, x3, -prepared.surface_center.y);
    const float x7 = fmaf(w.z, x3, -prepared.surface_center.z);
    const float x8 = fabsf(prepared.surface_radius);
    const bool b9 = 1e-37f < x8;
    const float x10 = etendue_lesser(etendue_greater(b9 ? fmaf(prepared.surface_frame_s.x, x5, fmaf(prepared.surface_frame_s.y, x6, prepared.surface_frame_s.z * x7)) / prepared.surface_radius : 0.0f, -1e37f), 1e37f);
    const float x11 = etendue_lesser(etendue_greater(b9 ? fmaf(prepared.surface_frame_t.x, x5, fmaf(prepared.surface_frame_t.y, x6, prepared.surface_frame_t.z * x7)) / prepared.surface_radius : 0.0f, -1e37f), 1e37f);
    const float x12 = etendue_lesser(etendue_greater(fmaf(etendue_lesser(etendue_greater(x10, -1000000000000000.0f), 1000000000000000.0f), 0.5f, 0.5f), 0.0f), 1.0f);
    const float x13 = etendue_lesser(etendue_greater(fmaf(etendue_lesser(etendue_greater(x11, -1000000000000000.0f), 1000000000000000.0f), 0.5f, 0.5f), 0.0f), 1.0f);
    const float x14 = x2 * (prepared.surface_radius * prepared.surface_radius * 3.1415927f);
    const bool b15 = 0.0f < x14;
    const float x16 = x4 * (x4 / (b15 ? x14 : 1.0f));
    const float x17 = etendue_pow2_scale(etendue_greater(etendue_greater(etendue_greater(fabsf(prepared.surface_center.x), fabsf(prepared.surface_center.y)), fabsf(prepared.surface_center.z)), x8));
    const float x18 = prepared.surface_center.x * x17;
    const float x19 = prepared.surface_center.y * x17;
    const float x20 = prepared.surface_center.z * x17;
    const float x21 = prepared.surface_height * x17;
    const float x22 = prepared.surface_radius * x17;
    const float x23 = w.x * x21 - x1 * x18;
    const float x24 = w.y * x21 - x1 * x19;
    const float x25 = w.z * x21 - x1 * x20;
    const float x26 = fmaf(x2, x22, (x22 + sqrtf(fmaf(x18, x18, fmaf(x19, x19, x20 * x20)))) * 7.1525574e-7f);
    const bool b27 = (sqrtf(fmaf(x23, x23, fmaf(x24, x24, x25 * x25))) <= x26) && (0.0f < x1 * x21);
    const float x28 = (b27 && (0.0f < x22)) ? ((b15 && (x16 < 1e37f) && (0.0f < x4)) ? x16 : 0.0f) : 0.0f;
    const bool b29 = 0.0f < x28;
    const float x30 = b29 ? x4 : 0.0f;
    const bool b31 = b29 && (x1 < 0.0f);
    const float x32 = (b31 && (1e-37f < x28)) ? 1.0f / x28 : 0.0f;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = x30;
    result.pdf = x28;
    result.weight = x32;
    result.normal.x = prepared.surface_frame_n.x;
    result.normal.y = prepared.surface_frame_n.y;
    result.normal.z = prepared.surface_frame_n.z;
    result.uv.x = x12;
    result.uv.y = x13;
    result.emits = b31;
    result.delta = false;
    return result;
}

// Prepares a light. Uniform over the cone: pdf 1/(2 pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
ETENDUE_FUNCTION EtendueSunBySolidAngle etendue_sun_by_solid_angle_prepare(EtendueSun light) {
    const float x1 = etendue_copysign(1.0f, light.direction.z);
    const float x2 = -1.0f / (light.direction.z + x1);
    const float x3 = x2 * (light.direction.x * light.direction.y);
    const float x4 = light.direction.x * x1;
    const float x5 = fmaf(light.direction.x, x2 * x4, 1.0f);
    const float x6 = x1 * x3;
    const float x7 = -x4;
    const float x8 = fmaf(light.direction.y, light.direction.y * x2, x1);
    const float x9 = -light.direction.y;
    EtendueSunBySolidAngle result;
    result.frame_s.x = x5;
    result.frame_s.y = x6;
    result.frame_s.z = x7;
    result.frame_t.x = x3;
    result.frame_t.y = x8;
    result.frame_t.z = x9;
    result.frame_n.x = light.direction.x;
    result.frame_n.y = light.direction.y;
    result.frame_n.z = light.direction.z;
    result.cone_one_minus_cos = light.one_minus_cos;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the cone: pdf 1/(2 pi (1 - cos(sigma))) per
// steradian, 0 where the cone is empty.
ETENDUE_FUNCTION EtendueLightSample etendue_sun_by_solid_angle_sample(EtendueSunBySolidAngle prepared, EtendueVec2 u) {
    const float x1 = etendue_lesser(etendue_greater(prepared.cone_one_minus_cos, 0.0f), 2.0f);
    const float x2 = u.x * x1;
    const float x3 = sqrtf(etendue_greater(x2 * fmaf(x1, 1.0f - u.x, 2.0f - x1), 0.0f));
    const EtendueVec2 v4 = etendue_sin_cos_turns(u.y);
    const float x5 = x3 * v4.y;
    const float x6 = x3 * v4.x;
    const float x7 = 1.0f - x2;
    const float x8 = fmaf(prepared.frame_s.x, x5, fmaf(prepared.frame_t.x, x6, prepared.frame_n.x * x7));
    const float x9 = fmaf(prepared.frame_s.y, x5, fmaf(prepared.frame_t.y, x6, prepared.frame_n.y * x7));
    const float x10 = fmaf(prepared.frame_s.z, x5, fmaf(prepared.frame_t.z, x6, prepared.frame_n.z * x7));
    const float x11 = (1e-37f < x1) ? 0.15915494f / x1 : 0.0f;
    const float x12 = -x8;
    const float x13 = -x9;
    const float x14 = -x10;
    const float x15 = (1e-37f < x11) ? 1.0f / x11 : 0.0f;
    EtendueLightSample result;
    result.direction.x = x8;
    result.direction.y = x9;
    result.direction.z = x10;
    result.distance = 3.4028235e38f;
    result.pdf = x11;
    result.weight = x15;
    result.normal.x = x12;
    result.normal.y = x13;
    result.normal.z = x14;
    result.uv.x = u.x;
    result.uv.y = u.y;
    result.emits = true;
    result.delta = false;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the cone: pdf 1/(2
// pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
ETENDUE_FUNCTION float etendue_sun_by_solid_angle_pdf(EtendueSunBySolidAngle prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.frame_n.x, w.x, fmaf(prepared.frame_n.y, w.y, prepared.frame_n.z * w.z));
    const float x2 = 1.0f - x1;
    const float x3 = etendue_lesser(etendue_greater(prepared.cone_one_minus_cos, 0.0f), 2.0f);
    const float x4 = x2 - x3;
    const bool b5 = fabsf(x4) <= 3.8146973e-6f;
    bool b6 = false;
    if (b5) {
        const float x7 = fmaf(prepared.frame_s.x, w.x, fmaf(prepared.frame_s.y, w.y, prepared.frame_s.z * w.z));
        const float x8 = fmaf(prepared.frame_t.x, w.x, fmaf(prepared.frame_t.y, w.y, prepared.frame_t.z * w.z));
        const float x9 = (0.5f < x1) ? fmaf(x7, x7, x8 * x8) / (1.0f + fabsf(x1)) : x2;
        const float x10 = x3 + fmaf(5.9604645e-7f, etendue_greater(sqrtf(x3 * (2.0f - x3)), x3 - 1.0f), 1.7763568e-13f);
        b6 = x9 <= x10;
    }
    const float x11 = (((x4 < 0.0f) && !b5) || (b5 && b6)) ? ((1e-37f < x3) ? 0.15915494f / x3 : 0.0f) : 0.0f;
    return x11;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the cone: pdf 1/(2 pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
ETENDUE_FUNCTION EtendueLightSample etendue_sun_by_solid_angle_hit(EtendueSunBySolidAngle prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.frame_n.x, w.x, fmaf(prepared.frame_n.y, w.y, prepared.frame_n.z * w.z));
    const float x2 = 1.0f - x1;
    const float x3 = etendue_lesser(etendue_greater(prepared.cone_one_minus_cos, 0.0f), 2.0f);
    const float x4 = x2 - x3;
    const bool b5 = fabsf(x4) <= 3.8146973e-6f;
    const float x6 = fmaf(prepared.frame_s.x, w.x, fmaf(prepared.frame_s.y, w.y, prepared.frame_s.z * w.z));
    const float x7 = fmaf(prepared.frame_t.x, w.x, fmaf(prepared.frame_t.y, w.y, prepared.frame_t.z * w.z));
    const float x8 = (0.5f < x1) ? fmaf(x6, x6, x7 * x7) / (1.0f + fabsf(x1)) : x2;
    const float x9 = etendue_lesser(etendue_greater(x8 / ((0.0f < x3) ? x3 : 1.0f), 0.0f), 0.99999994f);
    const float x10 = 0.15915494f * etendue_angle(x7, x6);
    const float x11 = etendue_lesser(etendue_greater((x10 < 0.0f) ? 1.0f + x10 : x10, 0.0f), 0.99999994f);
    const float x12 = -w.x;
    const float x13 = -w.y;
    const float x14 = -w.z;
    bool b15 = false;
    if (b5) {
        const float x16 = x3 + fmaf(5.9604645e-7f, etendue_greater(sqrtf(x3 * (2.0f - x3)), x3 - 1.0f), 1.7763568e-13f);
        b15 = x8 <= x16;
    }
    const float x17 = (((x4 < 0.0f) && !b5) || (b5 && b15)) ? ((1e-37f < x3) ? 0.15915494f / x3 : 0.0f) : 0.0f;
    const bool b18 = 0.0f < x17;
    const float x19 = b18 ? 3.4028235e38f : 0.0f;
    const float x20 = (b18 && (1e-37f < x17)) ? 1.0f / x17 : 0.0f;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = x19;
    result.pdf = x17;
    result.weight = x20;
    result.normal.x = x12;
    result.normal.y = x13;
    result.normal.z = x14;
    result.uv.x = x9;
    result.uv.y = x11;
    result.emits = b18;
    result.delta = false;
    return result;
}

// Prepares a light for the shading point p. Its one direction, whatever the random numbers. The pdf of a sample is
// distance^2, which is no density; that of a direction is 0.
ETENDUE_FUNCTION EtenduePointLightByDelta etendue_point_light_by_delta_prepare(EtenduePointLight light, EtendueVec3 p) {
    const float x1 = light.position.x - p.x;
    const float x2 = light.position.y - p.y;
    const float x3 = light.position.z - p.z;
    const float x4 = etendue_greater(etendue_greater(fabsf(x1), fabsf(x2)), fabsf(x3));
    const bool b5 = x4 < INFINITY;
    const float x6 = etendue_pow2_scale(b5 ? x4 : 0.0f);
    const float x7 = x6 * (b5 ? x1 : 0.0f);
    const float x8 = x6 * (b5 ? x2 : 0.0f);
    const float x9 = x6 * (b5 ? x3 : 0.0f);
    const float x10 = fmaf(x7, x7, fmaf(x8, x8, x9 * x9));
    const float x11 = (0.0f < x10) ? 1.0f / sqrtf(x10) : 0.0f;
    const float x12 = x10 * x11 / x6;
    const float x13 = x7 * x11;
    const float x14 = x8 * x11;
    const float x15 = x9 * x11;
    const float x16 = (x12 < INFINITY) ? x12 : 0.0f;
    const float x17 = x16 * x16;
    const float x18 = (x17 < 1e37f) ? x17 : 0.0f;
    EtenduePointLightByDelta result;
    result.direction.x = x13;
    result.direction.y = x14;
    result.direction.z = x15;
    result.distance = x16;
    result.pdf = x18;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Its one direction, whatever the random numbers. The pdf of a
// sample is distance^2, which is no density; that of a direction is 0.
ETENDUE_FUNCTION EtendueLightSample etendue_point_light_by_delta_sample(EtenduePointLightByDelta prepared, EtendueVec2 u) {
    (void)u;
    const bool b1 = 0.0f < prepared.pdf;
    const float x2 = -prepared.direction.x;
    const float x3 = -prepared.direction.y;
    const float x4 = -prepared.direction.z;
    const float x5 = (b1 && (1e-37f < prepared.pdf)) ? 1.0f / prepared.pdf : 0.0f;
    EtendueLightSample result;
    result.direction.x = prepared.direction.x;
    result.direction.y = prepared.direction.y;
    result.direction.z = prepared.direction.z;
    result.distance = prepared.distance;
    result.pdf = prepared.pdf;
    result.weight = x5;
    result.normal.x = x2;
    result.normal.y = x3;
    result.normal.z = x4;
    result.uv.x = 0.0f;
    result.uv.y = 0.0f;
    result.emits = b1;
    result.delta = true;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Its one direction, whatever the
// random numbers. The pdf of a sample is distance^2, which is no density; that of a direction is 0.
ETENDUE_FUNCTION float etendue_point_light_by_delta_pdf(EtenduePointLightByDelta prepared, EtendueVec3 w) {
    (void)prepared;
    (void)w;
    return 0.0f;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Its one
// direction, whatever the random numbers. The pdf of a sample is distance^2, which is no density; that of a direction
// is 0.
ETENDUE_FUNCTION EtendueLightSample etendue_point_light_by_delta_hit(EtenduePointLightByDelta prepared, EtendueVec3 w) {
    (void)prepared;
    const float x1 = -w.x;
    const float x2 = -w.y;
    const float x3 = -w.z;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = 0.0f;
    result.pdf = 0.0f;
    result.weight = 0.0f;
    result.normal.x = x1;
    result.normal.y = x2;
    result.normal.z = x3;
    result.uv.x = 0.0f;
    result.uv.y = 0.0f;
    result.emits = false;
    result.delta = false;
    return result;
}

// Prepares a light for the shading point p. Its one direction, whatever the random numbers. The pdf of a sample is
// distance^2 over the part of I that is emitted there, which is no density, and 0 outside of the cone; that of a
// direction is 0.
ETENDUE_FUNCTION EtendueSpotLightByDelta etendue_spot_light_by_delta_prepare(EtendueSpotLight light, EtendueVec3 p) {
    const float x1 = light.position.x - p.x;
    const float x2 = light.position.y - p.y;
    const float x3 = light.position.z - p.z;
    const float x4 = etendue_greater(etendue_greater(fabsf(x1), fabsf(x2)), fabsf(x3));
    const bool b5 = x4 < INFINITY;
    const float x6 = etendue_pow2_scale(b5 ? x4 : 0.0f);
    const float x7 = x6 * (b5 ? x1 : 0.0f);
    const float x8 = x6 * (b5 ? x2 : 0.0f);
    const float x9 = x6 * (b5 ? x3 : 0.0f);
    const float x10 = fmaf(x7, x7, fmaf(x8, x8, x9 * x9));
    const float x11 = (0.0f < x10) ? 1.0f / sqrtf(x10) : 0.0f;
    const float x12 = x10 * x11 / x6;
    const float x13 = x7 * x11;
    const float x14 = x8 * x11;
    const float x15 = x9 * x11;
    const float x16 = (x12 < INFINITY) ? x12 : 0.0f;
    const float x17 = x16 * x16;
    const float x18 = fmaf(light.axis.x, -x13, fmaf(light.axis.y, -x14, light.axis.z * -x15));
    const float x19 = light.cos_inner - light.cos_outer;
    const bool b20 = 0.0f < x19;
    const float x21 = etendue_lesser(etendue_greater((x18 - light.cos_outer) / (b20 ? x19 : 1.0f), 0.0f), 1.0f);
    const float x22 = b20 ? x21 * x21 * (3.0f - (x21 + x21)) : ((light.cos_inner <= x18) ? 1.0f : 0.0f);
    const bool b23 = 0.0f < x22;
    const float x24 = ((x17 < 1e37f) ? x17 : 0.0f) / (b23 ? x22 : 1.0f);
    const float x25 = (b23 && (x24 < 1e37f)) ? x24 : 0.0f;
    EtendueSpotLightByDelta result;
    result.direction.x = x13;
    result.direction.y = x14;
    result.direction.z = x15;
    result.distance = x16;
    result.pdf = x25;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Its one direction, whatever the random numbers. The pdf of a
// sample is distance^2 over the part of I that is emitted there, which is no density, and 0 outside of the cone; that
// of a direction is 0.
ETENDUE_FUNCTION EtendueLightSample etendue_spot_light_by_delta_sample(EtendueSpotLightByDelta prepared, EtendueVec2 u) {
    (void)u;
    const bool b1 = 0.0f < prepared.pdf;
    const float x2 = -prepared.direction.x;
    const float x3 = -prepared.direction.y;
    const float x4 = -prepared.direction.z;
    const float x5 = (b1 && (1e-37f < prepared.pdf)) ? 1.0f / prepared.pdf : 0.0f;
    EtendueLightSample result;
    result.direction.x = prepared.direction.x;
    result.direction.y = prepared.direction.y;
    result.direction.z = prepared.direction.z;
    result.distance = prepared.distance;
    result.pdf = prepared.pdf;
    result.weight = x5;
    result.normal.x = x2;
    result.normal.y = x3;
    result.normal.z = x4;
    result.uv.x = 0.0f;
    result.uv.y = 0.0f;
    result.emits = b1;
    result.delta = true;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Its one direction, whatever the
// random numbers. The pdf of a sample is distance^2 over the part of I that is emitted there, which is no density, and
// 0 outside of the cone; that of a direction is 0.
ETENDUE_FUNCTION float etendue_spot_light_by_delta_pdf(EtendueSpotLightByDelta prepared, EtendueVec3 w) {
    (void)prepared;
    (void)w;
    return 0.0f;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Its one
// direction, whatever the random numbers. The pdf of a sample is distance^2 over the part of I that is emitted there,
// which is no density, and 0 outside of the cone; that of a direction is 0.
ETENDUE_FUNCTION EtendueLightSample etendue_spot_light_by_delta_hit(EtendueSpotLightByDelta prepared, EtendueVec3 w) {
    (void)prepared;
    const float x1 = -w.x;
    const float x2 = -w.y;
    const float x3 = -w.z;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = 0.0f;
    result.pdf = 0.0f;
    result.weight = 0.0f;
    result.normal.x = x1;
    result.normal.y = x2;
    result.normal.z = x3;
    result.uv.x = 0.0f;
    result.uv.y = 0.0f;
    result.emits = false;
    result.delta = false;
    return result;
}

// Prepares a light for the shading point p. Its one direction, whatever the random numbers. The pdf of a sample is 1,
// which is no density; that of a direction is 0.
ETENDUE_FUNCTION EtendueDirectionalLightByDelta etendue_directional_light_by_delta_prepare(EtendueDirectionalLight light, EtendueVec3 p) {
    (void)p;
    EtendueDirectionalLightByDelta result;
    result.direction.x = light.direction.x;
    result.direction.y = light.direction.y;
    result.direction.z = light.direction.z;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Its one direction, whatever the random numbers. The pdf of a
// sample is 1, which is no density; that of a direction is 0.
ETENDUE_FUNCTION EtendueLightSample etendue_directional_light_by_delta_sample(EtendueDirectionalLightByDelta prepared, EtendueVec2 u) {
    (void)u;
    const float x1 = -prepared.direction.x;
    const float x2 = -prepared.direction.y;
    const float x3 = -prepared.direction.z;
    EtendueLightSample result;
    result.direction.x = prepared.direction.x;
    result.direction.y = prepared.direction.y;
    result.direction.z = prepared.direction.z;
    result.distance = 3.4028235e38f;
    result.pdf = 1.0f;
    result.weight = 1.0f;
    result.normal.x = x1;
    result.normal.y = x2;
    result.normal.z = x3;
    result.uv.x = 0.0f;
    result.uv.y = 0.0f;
    result.emits = true;
    result.delta = true;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Its one direction, whatever the
// random numbers. The pdf of a sample is 1, which is no density; that of a direction is 0.
ETENDUE_FUNCTION float etendue_directional_light_by_delta_pdf(EtendueDirectionalLightByDelta prepared, EtendueVec3 w) {
    (void)prepared;
    (void)w;
    return 0.0f;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Its one
// direction, whatever the random numbers. The pdf of a sample is 1, which is no density; that of a direction is 0.
ETENDUE_FUNCTION EtendueLightSample etendue_directional_light_by_delta_hit(EtendueDirectionalLightByDelta prepared, EtendueVec3 w) {
    (void)prepared;
    const float x1 = -w.x;
    const float x2 = -w.y;
    const float x3 = -w.z;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = 0.0f;
    result.pdf = 0.0f;
    result.weight = 0.0f;
    result.normal.x = x1;
    result.normal.y = x2;
    result.normal.z = x3;
    result.uv.x = 0.0f;
    result.uv.y = 0.0f;
    result.emits = false;
    result.delta = false;
    return result;
}

// The key of a seed of 64 bits, in two halves, which the sequences take; all bits count.
ETENDUE_FUNCTION etendue_word etendue_sequence_key(etendue_word low, etendue_word high) {
    const etendue_word k1 = 1013904223u + high * 1664525u;
    const etendue_word k2 = 1013904223u + low * 1664525u + k1 * 4188214367u;
    const etendue_word k3 = k1 + 192933365u * k2;
    const etendue_word k4 = 192933365u + k2 * k3;
    const etendue_word k5 = 4188214367u + k3 * k4;
    const etendue_word k6 = k3 ^ (k3 >> 16u);
    const etendue_word k7 = (k2 ^ (k2 >> 16u)) + k6 * (k5 ^ (k5 >> 16u));
    const etendue_word k8 = k6 + (k4 ^ (k4 >> 16u)) * k7;
    const etendue_word k9 = k7 ^ ((k8 << 16u) | (k8 >> 16u));
    return k9;
}

// Independent random numbers, multiples of 2^-24 in [0, 1), for any counters and the key of a seed.
ETENDUE_FUNCTION EtendueVec2 etendue_independent_pair(etendue_word pixel, etendue_word sample_index, etendue_word dimension, etendue_word key) {
    const etendue_word k1 = 1013904223u + sample_index * 1664525u;
    const etendue_word k2 = 1013904223u + (dimension >> 1u) * 1664525u;
    const etendue_word k3 = 1013904223u + key * 1664525u;
    const etendue_word k4 = 1013904223u + pixel * 1664525u + k1 * k3;
    const etendue_word k5 = k1 + k2 * k4;
    const etendue_word k6 = k2 + k4 * k5;
    const etendue_word k7 = k3 + k5 * k6;
    const etendue_word k8 = k5 ^ (k5 >> 16u);
    const etendue_word k9 = k6 ^ (k6 >> 16u);
    const etendue_word k10 = k7 ^ (k7 >> 16u);
    const etendue_word k11 = (k4 ^ (k4 >> 16u)) + k8 * k10;
    const etendue_word k12 = k8 + k9 * k11;
    const etendue_word k13 = k9 + k11 * k12;
    const bool b14 = 0.0f < etendue_from_word(dimension & 1u);
    const float x15 = b14 ? etendue_unit(k13) : etendue_unit(k11);
    const float x16 = b14 ? etendue_unit(k10 + k12 * k13) : etendue_unit(k12);
    EtendueVec2 result;
    result.x = x15;
    result.y = x16;
    return result;
}

// Owen-scrambled Sobol pairs: in every dimension a (0, 2)-sequence in base 2. Best for counts that are a power of two.
ETENDUE_FUNCTION EtendueVec2 etendue_owen_sobol_pair(etendue_word pixel, etendue_word sample_index, etendue_word dimension, etendue_word key) {
    const etendue_word k1 = 1013904223u + dimension * 1664525u;
    const etendue_word k2 = 1013904223u + key * 1664525u;
    const etendue_word k3 = 1013904223u + pixel * 1664525u + 3457715285u * k2;
    const etendue_word k4 = 3457715285u + k1 * k3;
    const etendue_word k5 = k1 + k3 * k4;
    const etendue_word k6 = k2 + k4 * k5;
    const etendue_word k7 = k4 ^ (k4 >> 16u);
    const etendue_word k8 = k5 ^ (k5 >> 16u);
    const etendue_word k9 = (k3 ^ (k3 >> 16u)) + k7 * (k6 ^ (k6 >> 16u));
    const etendue_word k10 = k7 + k8 * k9;
    const etendue_word k11 = k8 + k9 * k10;
    const etendue_word k12 = (k9 + etendue_reverse_bits(sample_index)) * ((k9 >> 16u) | 1u);
    const etendue_word k13 = k12 ^ (k12 * 89287766u);
    const etendue_word k14 = etendue_reverse_bits(k13 ^ (k13 * 1403136100u));
    const etendue_word k15 = k14 ^ ((k14 >> 16u) & 65535u);
    const etendue_word k16 = k15 ^ ((k15 >> 8u) & 16711935u);
    const etendue_word k17 = k16 ^ ((k16 >> 4u) & 252645135u);
    const etendue_word k18 = k17 ^ ((k17 >> 2u) & 858993459u);
    const etendue_word k19 = (k10 + k14) * (1u | (k10 >> 16u));
    const etendue_word k20 = k19 ^ (89287766u * k19);
    const float x21 = etendue_unit(etendue_reverse_bits(k20 ^ (1403136100u * k20)));
    const etendue_word k22 = (k11 + (k18 ^ ((k18 >> 1u) & 1431655765u))) * (1u | (k11 >> 16u));
    const etendue_word k23 = k22 ^ (89287766u * k22);
    const float x24 = etendue_unit(etendue_reverse_bits(k23 ^ (1403136100u * k23)));
    EtendueVec2 result;
    result.x = x21;
    result.y = x24;
    return result;
}

// What the weights take for a technique with this number of samples and this density; infinite where delta holds.
ETENDUE_FUNCTION float etendue_technique_pdf(float samples, float pdf, bool delta) {
    const float x1 = delta ? INFINITY : etendue_lesser(etendue_greater(samples * pdf, 0.0f), 3.4028235e38f);
    return x1;
}

// The weights of two techniques by the balance heuristic, given the number of samples times the density of each; their
// sum is 1 within 2^-23, or 0 where both densities are.
ETENDUE_FUNCTION EtendueVec2 etendue_balance_weights(float first, float second) {
    const float x1 = etendue_greater(first, 0.0f);
    const float x2 = etendue_greater(second, 0.0f);
    const float x3 = etendue_greater(etendue_greater(0.0f, x1), x2);
    const bool b4 = 0.0f < x3;
    const float x5 = b4 ? x3 : 1.0f;
    const float x6 = (b4 && (0.0f < x1)) ? ((x3 <= x1) ? 1.0f : x1 / x5) : 0.0f;
    const float x7 = (b4 && (0.0f < x2)) ? ((x3 <= x2) ? 1.0f : x2 / x5) : 0.0f;
    const float x8 = b4 ? x7 + (0.0f + x6) : 1.0f;
    const float x9 = x6 / x8;
    const float x10 = x7 / x8;
    EtendueVec2 result;
    result.x = x9;
    result.y = x10;
    return result;
}

// The weights of two techniques by the power heuristic with exponent 2, given the number of samples times the density
// of each; their sum is 1 within 2^-23, or 0 where both densities are.
ETENDUE_FUNCTION EtendueVec2 etendue_power_weights(float first, float second) {
    const float x1 = etendue_greater(first, 0.0f);
    const float x2 = etendue_greater(second, 0.0f);
    const float x3 = etendue_greater(etendue_greater(0.0f, x1), x2);
    const bool b4 = 0.0f < x3;
    const float x5 = b4 ? x3 : 1.0f;
    const float x6 = (b4 && (0.0f < x1)) ? ((x3 <= x1) ? 1.0f : x1 / x5) : 0.0f;
    const float x7 = x6 * x6;
    const float x8 = (b4 && (0.0f < x2)) ? ((x3 <= x2) ? 1.0f : x2 / x5) : 0.0f;
    const float x9 = x8 * x8;
    const float x10 = b4 ? x9 + (0.0f + x7) : 1.0f;
    const float x11 = x7 / x10;
    const float x12 = x9 / x10;
    EtendueVec2 result;
    result.x = x11;
    result.y = x12;
    return result;
}

// The weight, over its density, of a sample of a light with these fields, where the surface draws the same direction
// with the density bsdf_pdf: by the power heuristic, one sample each. 0 where there is no sample.
ETENDUE_FUNCTION float etendue_power_light_weight(float pdf, bool emits, bool delta, float bsdf_pdf) {
    const float x1 = etendue_greater(delta ? INFINITY : etendue_lesser(etendue_greater(pdf, 0.0f), 3.4028235e38f), 0.0f);
    const float x2 = etendue_greater(bsdf_pdf, 0.0f);
    const float x3 = etendue_greater(etendue_greater(0.0f, x1), x2);
    const bool b4 = 0.0f < x3;
    const float x5 = b4 ? x3 : 1.0f;
    const float x6 = (b4 && (0.0f < x1)) ? ((x3 <= x1) ? 1.0f : x1 / x5) : 0.0f;
    const float x7 = x6 * x6;
    const float x8 = (b4 && (0.0f < x2)) ? ((x3 <= x2) ? 1.0f : x2 / x5) : 0.0f;
    const float x9 = x7 / (b4 ? x8 * x8 + (0.0f + x7) : 1.0f) * ((emits && (1e-37f < pdf)) ? 1.0f / pdf : 0.0f);
    return x9;
}

// The weight, over its density, of a direction that the surface drew with the density bsdf_pdf, where it hits a light
// with these fields: by the power heuristic, one sample each. 0 where the light is missed.
ETENDUE_FUNCTION float etendue_power_bsdf_weight(float bsdf_pdf, float pdf, bool emits) {
    const bool b1 = emits && (1e-37f < bsdf_pdf) && (0.0f < pdf);
    const float x2 = etendue_greater(bsdf_pdf, 0.0f);
    const float x3 = etendue_greater(pdf, 0.0f);
    const float x4 = etendue_greater(etendue_greater(0.0f, x2), x3);
    const bool b5 = 0.0f < x4;
    const float x6 = b5 ? x4 : 1.0f;
    const float x7 = (b5 && (0.0f < x2)) ? ((x4 <= x2) ? 1.0f : x2 / x6) : 0.0f;
    const float x8 = x7 * x7;
    const float x9 = (b5 && (0.0f < x3)) ? ((x4 <= x3) ? 1.0f : x3 / x6) : 0.0f;
    const float x10 = x8 / (b5 ? x9 * x9 + (0.0f + x8) : 1.0f) / ((b1 && !(INFINITY <= bsdf_pdf)) ? bsdf_pdf : 1.0f);
    const float x11 = b1 ? x10 : 0.0f;
    return x11;
}

// The factor of the radiance in or against the unit direction w of a flat light with the unit normal n that emits
// within an angle of it, on either side: (tan_half - tan theta) gain, with theta the angle to the normal, tan_half the
// tangent of half the spread, and gain 1/(tan_half - half the spread); 0 beyond. Within 4e-7 of the factor on the
// axis.
ETENDUE_FUNCTION float etendue_spread_attenuation(float tan_half, float gain, EtendueVec3 w, EtendueVec3 n) {
    const float x1 = fabsf(fmaf(w.x, n.x, fmaf(w.y, n.y, w.z * n.z)));
    const bool b2 = 0.0f < x1;
    const float x3 = -(w.z * n.y);
    const float x4 = fmaf(w.y, n.z, x3) - fmaf(w.z, n.y, x3);
    const float x5 = -(w.x * n.z);
    const float x6 = fmaf(w.z, n.x, x5) - fmaf(w.x, n.z, x5);
    const float x7 = -(w.y * n.x);
    const float x8 = fmaf(w.x, n.y, x7) - fmaf(w.y, n.x, x7);
    const float x9 = tan_half - sqrtf(fmaf(x4, x4, fmaf(x6, x6, x8 * x8))) / (b2 ? x1 : 1.0f);
    const float x10 = b2 ? etendue_greater(gain * x9, 0.0f) : 0.0f;
    return x10;
}

// The position in [0, 1)^2, from the upper left corner, of the unit direction w in an image that a light projects
// along +z, with these tangents of half the horizontal and vertical angle of view: (1 + w.x/(w.z tan_half.x))/2 and (1
// - w.y/(w.z tan_half.y))/2; 0 where w misses the image. Within 2e-7 over the cosine to the axis.
ETENDUE_FUNCTION EtendueVec2 etendue_projector_place(EtendueVec2 tan_half, EtendueVec3 w) {
    const float x1 = tan_half.x * w.z;
    const float x2 = tan_half.y * w.z;
    const bool b3 = (0.0f < x1) && (0.0f < x2) && (-x1 <= w.x) && (w.x < x1);
    const bool b4 = b3 && (-x2 < w.y) && (w.y <= x2);
    const float x5 = b4 ? etendue_lesser(etendue_greater(fmaf(0.5f, w.x / (b4 ? x1 : 1.0f), 0.5f), 0.0f), 0.99999994f) : 0.0f;
    const float x6 = b4 ? etendue_lesser(etendue_greater(fmaf(0.5f, -w.y / (b4 ? x2 : 1.0f), 0.5f), 0.0f), 0.99999994f) : 0.0f;
    EtendueVec2 result;
    result.x = x5;
    result.y = x6;
    return result;
}

// Whether the unit direction w is in an image that a light projects along +z, with these tangents of half the angles
// of view; false for tangents that are not greater than 0.
ETENDUE_FUNCTION bool etendue_projector_has(EtendueVec2 tan_half, EtendueVec3 w) {
    const float x1 = tan_half.x * w.z;
    const float x2 = tan_half.y * w.z;
    const bool b3 = (0.0f < x1) && (0.0f < x2) && (-x1 <= w.x) && (w.x < x1);
    const bool b4 = b3 && (-x2 < w.y) && (w.y <= x2);
    return b4;
}

// The unit direction in which the light of a position in a projected image travels: the inverse of projector_place.
ETENDUE_FUNCTION EtendueVec3 etendue_projector_direction(EtendueVec2 tan_half, EtendueVec2 uv) {
    const float x1 = tan_half.x * fmaf(uv.x, 2.0f, -1.0f);
    const float x2 = tan_half.y * -fmaf(uv.y, 2.0f, -1.0f);
    const float x3 = fmaf(x1, x1, fmaf(x2, x2, 1.0f));
    const float x4 = (0.0f < x3) ? 1.0f / sqrtf(x3) : 0.0f;
    const float x5 = x1 * x4;
    const float x6 = x2 * x4;
    EtendueVec3 result;
    result.x = x5;
    result.y = x6;
    result.z = x4;
    return result;
}

// The unit direction of a position in [0, 1]^2 in the image of the sky for a portal with these unit edges and unit
// normal edge_s x edge_t: a direction x s + y t + z n has the position (atan(x/z)/pi + 1/2, atan(y/z)/pi + 1/2). The
// scale does not matter.
ETENDUE_FUNCTION EtendueVec3 etendue_portal_direction(EtendueVec3 edge_s, EtendueVec3 edge_t, EtendueVec3 normal, float scale, EtendueVec2 uv) {
    (void)scale;
    const EtendueVec2 v1 = etendue_sin_cos_turns(0.5f * (uv.x - 0.5f));
    const EtendueVec2 v2 = etendue_sin_cos_turns(0.5f * (uv.y - 0.5f));
    const float x3 = v1.x * v2.y;
    const float x4 = v1.y * v2.x;
    const float x5 = v1.y * v2.y;
    const float x6 = fmaf(edge_s.x, x3, fmaf(edge_t.x, x4, normal.x * x5));
    const float x7 = fmaf(edge_s.y, x3, fmaf(edge_t.y, x4, normal.y * x5));
    const float x8 = fmaf(edge_s.z, x3, fmaf(edge_t.z, x4, normal.z * x5));
    const float x9 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x6), fabsf(x7)), fabsf(x8)));
    const float x10 = x6 * x9;
    const float x11 = x7 * x9;
    const float x12 = x8 * x9;
    const float x13 = fmaf(x10, x10, fmaf(x11, x11, x12 * x12));
    const float x14 = (0.0f < x13) ? 1.0f / sqrtf(x13) : 0.0f;
    const float x15 = x10 * x14;
    const float x16 = x11 * x14;
    const float x17 = x12 * x14;
    EtendueVec3 result;
    result.x = x15;
    result.y = x16;
    result.z = x17;
    return result;
}

// The solid angle at a position in the image of the sky for a portal, per unit of the image's area, in steradians:
// what portal_direction stretches. scale is pi^2 times the sine of the angle between the edges.
ETENDUE_FUNCTION float etendue_portal_solid_angle(EtendueVec3 edge_s, EtendueVec3 edge_t, EtendueVec3 normal, float scale, EtendueVec2 uv) {
    const EtendueVec2 v1 = etendue_sin_cos_turns(0.5f * (uv.x - 0.5f));
    const EtendueVec2 v2 = etendue_sin_cos_turns(0.5f * (uv.y - 0.5f));
    const float x3 = v1.x * v2.y;
    const float x4 = v1.y * v2.x;
    const float x5 = v1.y * v2.y;
    const float x6 = fmaf(edge_s.x, x3, fmaf(edge_t.x, x4, normal.x * x5));
    const float x7 = fmaf(edge_s.y, x3, fmaf(edge_t.y, x4, normal.y * x5));
    const float x8 = fmaf(edge_s.z, x3, fmaf(edge_t.z, x4, normal.z * x5));
    const float x9 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x6), fabsf(x7)), fabsf(x8)));
    const float x10 = x6 * x9;
    const float x11 = x7 * x9;
    const float x12 = x8 * x9;
    const float x13 = fmaf(x10, x10, fmaf(x11, x11, x12 * x12));
    const float x14 = x13 * ((0.0f < x13) ? 1.0f / sqrtf(x13) : 0.0f) / x9;
    const bool b15 = 0.0f < x14;
    const float x16 = b15 ? x14 : 1.0f;
    const float x17 = scale * (v1.y / x16) * (v2.y / x16) / x14;
    const float x18 = etendue_lesser(etendue_greater(b15 ? x17 : 0.0f, 0.0f), 3.4028235e38f);
    return x18;
}

#endif
