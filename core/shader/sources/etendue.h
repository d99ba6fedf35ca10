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
    // 1 - cos(theta) of the angle to the axis up to which the intensity is I, in [0, 2].
    float one_minus_cos_inner;
    // 1 - cos(theta) of the angle from which it is 0, in [0, 2]; at least the other one.
    float one_minus_cos_outer;
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
    const float x15 = x13 * x13;
    const float x16 = fmaf(x11, x11, fmaf(x12, x12, x15));
    const float x17 = x14 * x14;
    const bool b18 = x16 < x17 * 2.0f;
    const bool b19 = 0.0f < x16;
    const float x20 = 1.0f / (b19 ? x16 : 1.0f);
    const float x21 = sqrtf(x16);
    const float x22 = etendue_pow2_scale(x9);
    const float x23 = x5 * x22;
    const float x24 = x6 * x22;
    const float x25 = x7 * x22;
    const float x26 = fmaf(x23, x23, fmaf(x24, x24, x25 * x25));
    const float x27 = (0.0f < x26) ? 1.0f / sqrtf(x26) : 0.0f;
    const float x28 = x23 * x27;
    const float x29 = x24 * x27;
    const float x30 = x25 * x27;
    const float x31 = (0.0f < etendue_greater(etendue_greater(fabsf(x28), fabsf(x29)), fabsf(x30))) ? x30 : 1.0f;
    const float x32 = etendue_copysign(1.0f, x31);
    const float x33 = -1.0f / (x31 + x32);
    const float x34 = x33 * (x28 * x29);
    const float x35 = x28 * x32;
    const float x36 = fmaf(x28, x33 * x35, 1.0f);
    const float x37 = x32 * x34;
    const float x38 = -x35;
    const float x39 = fmaf(x29, x29 * x33, x32);
    const float x40 = -x29;
    const float x41 = 1.0f / x10;
    float x42 = x16 - x17;
    if (b18) {
        const float x43 = x11 * x11;
        const float x44 = x12 * x12;
        const float x45 = x43 - x17;
        const float x46 = x45 - x43;
        const float x47 = x44 + x45;
        const float x48 = x47 - x45;
        const float x49 = x15 + x47;
        const float x50 = x49 - x47;
        const float x51 = x43 - (x45 - x46) + (-x17 - x46) + (x45 - (x47 - x48) + (x44 - x48));
        const float x52 = fmaf(x11, x11, -x43) - fmaf(x14, x14, -x17) + (fmaf(x12, x12, -x44) + fmaf(x13, x13, -x15));
        x42 = x49 + (x47 - (x49 - x50) + (x15 - x50) + x51 + x52);
    }
    const float x53 = etendue_lesser(x17 * x20, 1.0f) / (1.0f + sqrtf(x20 * etendue_greater(x42, 0.0f)));
    const float x54 = ((0.0f < x14) && (0.0f <= x16)) ? ((b19 && (0.0f <= x42)) ? x53 : 2.0f) : 0.0f;
    EtendueSphereBySolidAngle result;
    result.surface_center.x = x1;
    result.surface_center.y = x2;
    result.surface_center.z = x3;
    result.surface_radius = light.radius;
    result.shape_frame_s.x = x36;
    result.shape_frame_s.y = x37;
    result.shape_frame_s.z = x38;
    result.shape_frame_t.x = x34;
    result.shape_frame_t.y = x39;
    result.shape_frame_t.z = x40;
    result.shape_frame_n.x = x28;
    result.shape_frame_n.y = x29;
    result.shape_frame_n.z = x31;
    result.shape_cone_one_minus_cos = x54;
    result.shape_distance = x21;
    result.shape_power = x42;
    result.shape_unit = x41;
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
    const float x18 = etendue_greater(etendue_greater(0.0f, etendue_greater(etendue_greater(fabsf(prepared.surface_center.x), fabsf(prepared.surface_center.y)), fabsf(prepared.surface_center.z))), etendue_greater(etendue_greater(fabsf(x17), 0.0f), 0.0f));
    const bool b19 = x18 < INFINITY;
    const float x20 = etendue_pow2_scale(x18);
    const float x21 = x20 * (b19 ? x17 : 0.0f);
    const float x22 = fmaf(x13, x21, -(x20 * (b19 ? prepared.surface_center.x : 0.0f)));
    const float x23 = fmaf(x14, x21, -(x20 * (b19 ? prepared.surface_center.y : 0.0f)));
    const float x24 = fmaf(x15, x21, -(x20 * (b19 ? prepared.surface_center.z : 0.0f)));
    const float x25 = fmaf(x22, x22, fmaf(x23, x23, x24 * x24));
    const float x26 = (0.0f < x25) ? 1.0f / sqrtf(x25) : 0.0f;
    const float x27 = x22 * x26;
    const float x28 = x23 * x26;
    const float x29 = x24 * x26;
    const float x30 = (0.5f < x29) ? fmaf(x27, x27, x28 * x28) / (1.0f + fabsf(x29)) : 1.0f - x29;
    const float x31 = etendue_lesser(etendue_greater(x30 / 2.0f, 0.0f), 0.99999994f);
    const float x32 = etendue_angle(x28, x27) * 0.15915494f;
    const float x33 = etendue_lesser(etendue_greater((x32 < 0.0f) ? 1.0f + x32 : x32, 0.0f), 0.99999994f);
    const float x34 = (1e-37f < x6) ? 0.15915494f / x6 : 0.0f;
    const bool b35 = !(prepared.shape_power < 0.0f);
    const float x36 = (b35 && (1e-37f < x34)) ? 1.0f / x34 : 0.0f;
    EtendueLightSample result;
    result.direction.x = x13;
    result.direction.y = x14;
    result.direction.z = x15;
    result.distance = x17;
    result.pdf = x34;
    result.weight = x36;
    result.normal.x = x27;
    result.normal.y = x28;
    result.normal.z = x29;
    result.uv.x = x31;
    result.uv.y = x33;
    result.emits = b35;
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
    const float x4 = etendue_greater(etendue_greater(fabsf(light.e1.x), fabsf(light.e1.y)), fabsf(light.e1.z));
    const float x5 = etendue_pow2_scale(x4);
    const bool b6 = x4 < INFINITY;
    const float x7 = x5 * (b6 ? light.e1.x : 0.0f);
    const float x8 = x5 * (b6 ? light.e1.y : 0.0f);
    const float x9 = x5 * (b6 ? light.e1.z : 0.0f);
    const float x10 = etendue_greater(etendue_greater(fabsf(light.e2.x), fabsf(light.e2.y)), fabsf(light.e2.z));
    const float x11 = etendue_pow2_scale(x10);
    const bool b12 = x10 < INFINITY;
    const float x13 = x11 * (b12 ? light.e2.x : 0.0f);
    const float x14 = x11 * (b12 ? light.e2.y : 0.0f);
    const float x15 = x11 * (b12 ? light.e2.z : 0.0f);
    const float x16 = x9 * x14;
    const float x17 = fmaf(x9, x14, -x16);
    const float x18 = fmaf(x8, x15, -x16) - x17;
    const float x19 = x7 * x15;
    const float x20 = fmaf(x7, x15, -x19);
    const float x21 = fmaf(x9, x13, -x19) - x20;
    const float x22 = x8 * x13;
    const float x23 = fmaf(x8, x13, -x22);
    const float x24 = fmaf(x7, x14, -x22) - x23;
    const float x25 = fabsf(x18);
    const float x26 = fabsf(x21);
    const float x27 = etendue_pow2_scale(etendue_greater(etendue_greater(x25, x26), fabsf(x24)));
    const float x28 = x18 * x27;
    const float x29 = x21 * x27;
    const float x30 = x24 * x27;
    const float x31 = fmaf(x28, x28, fmaf(x29, x29, x30 * x30));
    const float x32 = (0.0f < x31) ? 1.0f / sqrtf(x31) : 0.0f;
    const float x33 = x28 * x32;
    const float x34 = x29 * x32;
    const float x35 = x30 * x32;
    const float x36 = x31 * x32 / x27;
    const float x37 = etendue_greater(0.0f, etendue_greater(etendue_greater(fabsf(x1), fabsf(x2)), fabsf(x3)));
    const float x38 = etendue_greater(etendue_greater(x37, x4), x10);
    const bool b39 = x38 < INFINITY;
    const float x40 = etendue_pow2_scale(x38);
    const float x41 = x40 * (b39 ? x1 : 0.0f);
    const float x42 = x40 * (b39 ? x2 : 0.0f);
    const float x43 = x40 * (b39 ? x3 : 0.0f);
    const float x44 = x40 * (b39 ? light.e1.x : 0.0f);
    const float x45 = x40 * (b39 ? light.e1.y : 0.0f);
    const float x46 = x40 * (b39 ? light.e1.z : 0.0f);
    const float x47 = x40 * (b39 ? light.e2.x : 0.0f);
    const float x48 = x40 * (b39 ? light.e2.y : 0.0f);
    const float x49 = x40 * (b39 ? light.e2.z : 0.0f);
    const float x50 = x24 * x43;
    const float x51 = fmaf(x18, x41, fmaf(x21, x42, x50));
    const bool b52 = fabsf(x51 + x51) < fmaf(x25, fabsf(x41), fmaf(x26, fabsf(x42), fabsf(x50)));
    const float x53 = x36 * (x40 / x5) * (x40 / x11);
    const float x54 = x33 * x53;
    const float x55 = x34 * x53;
    const float x56 = x35 * x53;
    const float x57 = -(x43 * x45);
    const float x58 = fmaf(x42, x46, x57) - fmaf(x43, x45, x57);
    const float x59 = -(x41 * x46);
    const float x60 = fmaf(x43, x44, x59) - fmaf(x41, x46, x59);
    const float x61 = -(x42 * x44);
    const float x62 = fmaf(x41, x45, x61) - fmaf(x42, x44, x61);
    const float x63 = -(x43 * x48);
    const float x64 = fmaf(x42, x49, x63) - fmaf(x43, x48, x63);
    const float x65 = -(x41 * x49);
    const float x66 = fmaf(x43, x47, x65) - fmaf(x41, x49, x65);
    const float x67 = -(x42 * x47);
    const float x68 = fmaf(x41, x48, x67) - fmaf(x42, x47, x67);
    const float x69 = 1.0f / x40;
    const float x70 = light.e1.x + x1;
    const float x71 = light.e1.y + x2;
    const float x72 = light.e1.z + x3;
    const float x73 = light.e2.x + x1;
    const float x74 = light.e2.y + x2;
    const float x75 = light.e2.z + x3;
    const float x76 = etendue_greater(etendue_greater(x37, etendue_greater(etendue_greater(fabsf(x70), fabsf(x71)), fabsf(x72))), etendue_greater(etendue_greater(fabsf(x73), fabsf(x74)), fabsf(x75)));
    const float x77 = etendue_greater(etendue_greater(x76, x4), x10);
    const bool b78 = x77 < INFINITY;
    const float x79 = etendue_pow2_scale(x77);
    const float x80 = x79 * (b78 ? x1 : 0.0f);
    const float x81 = x79 * (b78 ? x2 : 0.0f);
    const float x82 = x79 * (b78 ? x3 : 0.0f);
    const float x83 = x79 * (b78 ? x70 : 0.0f);
    const float x84 = x79 * (b78 ? x71 : 0.0f);
    const float x85 = x79 * (b78 ? x72 : 0.0f);
    const float x86 = x79 * (b78 ? x73 : 0.0f);
    const float x87 = x79 * (b78 ? x74 : 0.0f);
    const float x88 = x79 * (b78 ? x75 : 0.0f);
    const float x89 = x79 * (b78 ? light.e1.x : 0.0f);
    const float x90 = x79 * (b78 ? light.e1.y : 0.0f);
    const float x91 = x79 * (b78 ? light.e1.z : 0.0f);
    const float x92 = x79 * (b78 ? light.e2.x : 0.0f);
    const float x93 = x79 * (b78 ? light.e2.y : 0.0f);
    const float x94 = x79 * (b78 ? light.e2.z : 0.0f);
    const float x95 = x91 * x93;
    const float x96 = fmaf(x91, x93, -x95);
    const float x97 = fmaf(x90, x94, -x95) - x96;
    const float x98 = x89 * x94;
    const float x99 = fmaf(x89, x94, -x98);
    const float x100 = fmaf(x91, x92, -x98) - x99;
    const float x101 = x90 * x92;
    const float x102 = fmaf(x90, x92, -x101);
    const float x103 = fmaf(x89, x93, -x101) - x102;
    const float x104 = x82 * x103;
    const float x105 = fmaf(x80, x97, fmaf(x81, x100, x104));
    const float x106 = fmaf(fabsf(x80), fabsf(x97), fmaf(fabsf(x81), fabsf(x100), fabsf(x104)));
    const bool b107 = fabsf(x105 + x105) < x106;
    const float x108 = x90 * x94;
    const float x109 = x108 - x95;
    const float x110 = x109 - x108;
    const float x111 = x108 - (x109 - x110) + (-x95 - x110) + (fmaf(x90, x94, -x108) - x96);
    const float x112 = x91 * x92;
    const float x113 = x112 - x98;
    const float x114 = x113 - x112;
    const float x115 = x112 - (x113 - x114) + (-x98 - x114) + (fmaf(x91, x92, -x112) - x99);
    const float x116 = x89 * x93;
    const float x117 = x116 - x101;
    const float x118 = x117 - x116;
    const float x119 = x116 - (x117 - x118) + (-x101 - x118) + (fmaf(x89, x93, -x116) - x102);
    const float x120 = x92 - x89;
    const float x121 = x93 - x90;
    const float x122 = x94 - x91;
    const float x123 = fmaf(x83, x83, fmaf(x84, x84, x85 * x85));
    const float x124 = fmaf(x86, x86, fmaf(x87, x87, x88 * x88));
    const bool b125 = x123 < x124;
    const float x126 = b125 ? x83 : x86;
    const float x127 = b125 ? x84 : x87;
    const float x128 = b125 ? x85 : x88;
    const float x129 = x82 * x90;
    const float x130 = fmaf(x82, x90, -x129);
    const float x131 = fmaf(x81, x91, -x129) - x130;
    const float x132 = x80 * x91;
    const float x133 = fmaf(x80, x91, -x132);
    const float x134 = fmaf(x82, x89, -x132) - x133;
    const float x135 = x81 * x89;
    const float x136 = fmaf(x81, x89, -x135);
    const float x137 = fmaf(x80, x90, -x135) - x136;
    const float x138 = x82 * x93;
    const float x139 = fmaf(x82, x93, -x138);
    const float x140 = fmaf(x81, x94, -x138) - x139;
    const float x141 = x80 * x94;
    const float x142 = fmaf(x80, x94, -x141);
    const float x143 = fmaf(x82, x92, -x141) - x142;
    const float x144 = x81 * x92;
    const float x145 = fmaf(x81, x92, -x144);
    const float x146 = fmaf(x80, x93, -x144) - x145;
    const float x147 = -(x121 * x128);
    const float x148 = -(x122 * x126);
    const float x149 = -(x120 * x127);
    const float x150 = fmaf(x80, x80, fmaf(x81, x81, x82 * x82));
    const float x151 = (1e-36f < x150) ? 1.0f / sqrtf(x150) : 0.0f;
    const float x152 = (1e-36f < x123) ? 1.0f / sqrtf(x123) : 0.0f;
    const float x153 = (1e-36f < x124) ? 1.0f / sqrtf(x124) : 0.0f;
    const float x154 = fmaf(x80, x83, fmaf(x81, x84, x82 * x85));
    const float x155 = x152 * (x151 * x154);
    const float x156 = fmaf(x80, x86, fmaf(x81, x87, x82 * x88));
    const float x157 = x153 * (x151 * x156);
    const float x158 = fmaf(x131, x131, fmaf(x134, x134, x137 * x137));
    const float x159 = sqrtf(x158);
    const float x160 = (1e-37f < x158) ? 1.0f / x159 : 0.0f;
    const float x161 = x150 * x151;
    const float x162 = x123 * x152;
    const float x163 = x152 * (x151 * (x158 * x160));
    const float x164 = x162 * (x160 * x161);
    const float x165 = x164 * 2.0f;
    const float x166 = x163 * x163 / (1.0f + fabsf(x155));
    const bool b167 = x155 < 0.0f;
    const float x168 = b167 ? x166 : 1.0f + x155;
    const float x169 = x164 * (b167 ? 1.0f - x155 : x166);
    const float x170 = x83 * x152;
    const float x171 = x84 * x152;
    const float x172 = x85 * x152;
    const float x173 = x80 * x151;
    const float x174 = x81 * x151;
    const float x175 = x82 * x151;
    const float x176 = x170 + x173;
    const float x177 = x171 + x174;
    const float x178 = x172 + x175;
    const float x179 = x131 * x160;
    const float x180 = x134 * x160;
    const float x181 = x137 * x160;
    const float x182 = -(x172 * x180);
    const float x183 = fmaf(x171, x181, x182) - fmaf(x172, x180, x182);
    const float x184 = -(x170 * x181);
    const float x185 = fmaf(x172, x179, x184) - fmaf(x170, x181, x184);
    const float x186 = -(x171 * x179);
    const float x187 = fmaf(x170, x180, x186) - fmaf(x171, x179, x186);
    const float x188 = x153 * fmaf(x86, x170, fmaf(x87, x171, x88 * x172));
    const float x189 = fmaf(x140, x140, fmaf(x143, x143, x146 * x146));
    const float x190 = x151 * x153;
    const float x191 = x190 * (x189 * x190);
    const bool b192 = etendue_lesser(etendue_lesser(x155, x157), x188) < -0.5f;
    const float x193 = fmaf(x83, x86, fmaf(x84, x87, x85 * x88));
    const float x194 = etendue_lesser(etendue_greater(-x155 / ((0.0f < x163) ? x163 : 1.0f), 1.0f), 1e18f);
    const float x195 = etendue_greater(x159 * x194, -x154) * 7.1525574e-7f;
    const float x196 = 7.1525574e-7f * etendue_greater(x194 * sqrtf(x189), -x156);
    const float x197 = etendue_greater(etendue_greater(x161, x162), x124 * x153);
    const float x198 = etendue_pow2_scale(x79);
    float x199 = 0.0f;
    if (b52) {
        const float x200 = x8 * x15;
        const float x201 = x200 - x16;
        const float x202 = x201 - x200;
        const float x203 = x200 - (x201 - x202) + (-x16 - x202) + (fmaf(x8, x15, -x200) - x17);
        const float x204 = x9 * x13;
        const float x205 = x204 - x19;
        const float x206 = x205 - x204;
        const float x207 = x204 - (x205 - x206) + (-x19 - x206) + (fmaf(x9, x13, -x204) - x20);
        const float x208 = x7 * x14;
        const float x209 = x208 - x22;
        const float x210 = x209 - x208;
        const float x211 = x208 - (x209 - x210) + (-x22 - x210) + (fmaf(x7, x14, -x208) - x23);
        const float x212 = x41 * x201;
        const float x213 = x42 * x205;
        const float x214 = x43 * x209;
        const float x215 = x212 + x213;
        const float x216 = x215 - x212;
        const float x217 = x214 + x215;
        const float x218 = x217 - x215;
        const float x219 = x212 - (x215 - x216) + (x213 - x216) + (x215 - (x217 - x218) + (x214 - x218));
        const float x220 = fmaf(x41, x201, -x212) + (fmaf(x42, x205, -x213) + fmaf(x43, x209, -x214));
        x199 = x217 + (x219 + x220 + fmaf(x41, x203, fmaf(x42, x207, x43 * x211)));
    }
    const float x221 = etendue_lesser(etendue_greater((1e-37f < fabsf(x36)) ? (b52 ? x199 : x51) / x36 : 0.0f, -1e37f), 1e37f);
    float x222 = x105;
    if (b107) {
        const float x223 = x80 * x109;
        const float x224 = x81 * x113;
        const float x225 = x82 * x117;
        const float x226 = x223 + x224;
        const float x227 = x226 - x223;
        const float x228 = x225 + x226;
        const float x229 = x228 - x226;
        const float x230 = x223 - (x226 - x227) + (x224 - x227) + (x226 - (x228 - x229) + (x225 - x229));
        const float x231 = fmaf(x80, x109, -x223) + (fmaf(x81, x113, -x224) + fmaf(x82, x117, -x225));
        x222 = x228 + (x230 + x231 + fmaf(x80, x111, fmaf(x81, x115, x82 * x119)));
    }
    const float x232 = fabsf(x222);
    const float x233 = x153 * (x152 * (x151 * x232));
    const bool b234 = x222 < 0.0f;
    const float x235 = x153 * (x160 * x232);
    const float x236 = b234 ? -x179 : x179;
    const float x237 = b234 ? -x180 : x180;
    const float x238 = b234 ? -x181 : x181;
    const float x239 = x161 * x232;
    const float x240 = (1e-37f < x239) ? fmaf(x131, x140, fmaf(x134, x143, x137 * x146)) / x239 : 0.0f;
    const bool b241 = (0.0f < x151) && (0.0f < x152) && (0.0f < x153) && (0.0f < x233);
    const float x242 = 1.0f / ((1e-37f < x233) ? x233 : 1.0f);
    const float x243 = b234 ? -x131 : x131;
    const float x244 = b234 ? -x134 : x134;
    const float x245 = b234 ? -x137 : x137;
    const float x246 = b234 ? x140 : -x140;
    const float x247 = b234 ? x143 : -x143;
    const float x248 = b234 ? x146 : -x146;
    const float x249 = x168 * x242;
    float x250 = fmaf(x122, x127, x147) - fmaf(x121, x128, x147);
    float x251 = fmaf(x120, x128, x148) - fmaf(x122, x126, x148);
    float x252 = fmaf(x121, x126, x149) - fmaf(x120, x127, x149);
    float x253 = 0.0f;
    float x254 = 0.0f;
    float x255 = 0.0f;
    float x256 = 0.0f;
    float x257 = 0.0f;
    float x258 = 0.0f;
    float x259 = 0.0f;
    float x260 = 0.0f;
    float x261 = 0.0f;
    float x262 = 0.0f;
    float x263 = 0.0f;
    float x264 = 0.0f;
    float x265 = 0.0f;
    float x266 = 0.0f;
    float x267 = 0.0f;
    float x268 = 0.0f;
    float x269 = 0.0f;
    bool b270 = false;
    bool b271 = false;
    bool b272 = false;
    float x273 = 0.0f;
    if (b192) {
        const float x274 = x81 * x94;
        const float x275 = x274 - x138;
        const float x276 = x275 - x274;
        const float x277 = x274 - (x275 - x276) + (-x138 - x276) + (fmaf(x81, x94, -x274) - x139);
        const float x278 = x82 * x92;
        const float x279 = x278 - x141;
        const float x280 = x279 - x278;
        const float x281 = x278 - (x279 - x280) + (-x141 - x280) + (fmaf(x82, x92, -x278) - x142);
        const float x282 = x80 * x93;
        const float x283 = x282 - x144;
        const float x284 = x283 - x282;
        const float x285 = x282 - (x283 - x284) + (-x144 - x284) + (fmaf(x80, x93, -x282) - x145);
        const float x286 = x81 * x91;
        const float x287 = x129 - x286;
        const float x288 = x287 - x129;
        const float x289 = x129 - (x287 - x288) + (-x286 - x288) + (x130 - fmaf(x81, x91, -x286));
        const float x290 = x82 * x89;
        const float x291 = x132 - x290;
        const float x292 = x291 - x132;
        const float x293 = x132 - (x291 - x292) + (-x290 - x292) + (x133 - fmaf(x82, x89, -x290));
        const float x294 = x80 * x90;
        const float x295 = x135 - x294;
        const float x296 = x295 - x135;
        const float x297 = x135 - (x295 - x296) + (-x294 - x296) + (x136 - fmaf(x80, x90, -x294));
        const float x298 = x275 + x287;
        const float x299 = x298 - x275;
        const float x300 = x279 + x291;
        const float x301 = x300 - x279;
        const float x302 = x283 + x295;
        const float x303 = x302 - x283;
        const float x304 = x109 + x298;
        const float x305 = x304 - x109;
        const float x306 = x113 + x300;
        const float x307 = x306 - x113;
        const float x308 = x117 + x302;
        const float x309 = x308 - x117;
        const float x310 = x111 + (x275 - (x298 - x299) + (x287 - x299) + (x277 + x289));
        const float x311 = x115 + (x279 - (x300 - x301) + (x291 - x301) + (x281 + x293));
        const float x312 = x119 + (x283 - (x302 - x303) + (x295 - x303) + (x285 + x297));
        x250 = x304 + (x109 - (x304 - x305) + (x298 - x305) + x310);
        x251 = x306 + (x113 - (x306 - x307) + (x300 - x307) + x311);
        x252 = x308 + (x117 - (x308 - x309) + (x302 - x309) + x312);
        const float x313 = x83 - x80;
        const float x314 = x84 - x81;
        const float x315 = x85 - x82;
        const float x316 = fmaf(x313, x313, fmaf(x314, x314, x315 * x315));
        const bool b317 = 1e-36f < x316;
        const float x318 = 1.0f / sqrtf(b317 ? x316 : 1.0f);
        const float x319 = x318 * x318;
        const float x320 = -(x134 * x315);
        const float x321 = -(x137 * x313);
        const float x322 = -(x131 * x314);
        const float x323 = x158 * x319;
        const float x324 = x313 * x318;
        const float x325 = x314 * x318;
        const float x326 = x315 * x318;
        const float x327 = x151 + x152;
        const float x328 = x151 * (x151 * x323) / (1.0f + x151 * fabsf(fmaf(x80, x324, fmaf(x81, x325, x82 * x326))));
        const float x329 = x152 * (x152 * x323) / (1.0f + x152 * fabsf(fmaf(x83, x324, fmaf(x84, x325, x85 * x326))));
        const float x330 = x328 - x329;
        const bool b331 = (x154 < 0.0f) && b317;
        x253 = b331 ? fmaf(x319 * (fmaf(x137, x314, x320) - fmaf(x134, x315, x320)), x327, x324 * x330) : x176;
        x254 = b331 ? fmaf(x319 * (fmaf(x131, x315, x321) - fmaf(x137, x313, x321)), x327, x325 * x330) : x177;
        x255 = b331 ? fmaf(x319 * (fmaf(x134, x313, x322) - fmaf(x131, x314, x322)), x327, x326 * x330) : x178;
        x256 = x86 * x153;
        x257 = x87 * x153;
        x258 = x88 * x153;
        const float x332 = x86 - x80;
        const float x333 = x87 - x81;
        const float x334 = x88 - x82;
        const float x335 = fmaf(x332, x332, fmaf(x333, x333, x334 * x334));
        const bool b336 = 1e-36f < x335;
        const float x337 = 1.0f / sqrtf(b336 ? x335 : 1.0f);
        const float x338 = x337 * x337;
        const float x339 = -(x143 * x334);
        const float x340 = -(x146 * x332);
        const float x341 = -(x140 * x333);
        const float x342 = x189 * x338;
        const float x343 = x332 * x337;
        const float x344 = x333 * x337;
        const float x345 = x334 * x337;
        const float x346 = x151 + x153;
        const float x347 = x151 * (x151 * x342) / (1.0f + x151 * fabsf(fmaf(x80, x343, fmaf(x81, x344, x82 * x345))));
        const float x348 = x153 * (x153 * x342) / (1.0f + x153 * fabsf(fmaf(x86, x343, fmaf(x87, x344, x88 * x345))));
        const float x349 = x347 - x348;
        const bool b350 = (x156 < 0.0f) && b336;
        x259 = b350 ? fmaf(x338 * (fmaf(x146, x333, x339) - fmaf(x143, x334, x339)), x346, x343 * x349) : x173 + x256;
        x260 = b350 ? fmaf(x338 * (fmaf(x140, x334, x340) - fmaf(x146, x332, x340)), x346, x344 * x349) : x174 + x257;
        x261 = b350 ? fmaf(x338 * (fmaf(x143, x332, x341) - fmaf(x140, x333, x341)), x346, x345 * x349) : x175 + x258;
        x262 = x86 - x83;
        x263 = x87 - x84;
        x264 = x88 - x85;
        const float x351 = fmaf(x262, x262, fmaf(x263, x263, x264 * x264));
        const bool b352 = 1e-36f < x351;
        const float x353 = 1.0f / sqrtf(b352 ? x351 : 1.0f);
        x265 = x353 * x353;
        x266 = x262 * x353;
        x267 = x263 * x353;
        x268 = x264 * x353;
        x269 = x152 + x153;
        b270 = (x193 < 0.0f) && b352;
        b271 = x188 < 0.0f;
        b272 = x157 < 0.0f;
        x273 = x191 / (1.0f + fabsf(x157));
    }
    const float x354 = fmaf(x250, x250, fmaf(x251, x251, x252 * x252));
    const float x355 = (b192 && b272) ? x273 : 1.0f + x157;
    const float x356 = b234 ? -x250 : x250;
    const float x357 = b234 ? -x251 : x251;
    const float x358 = b234 ? -x252 : x252;
    const float x359 = etendue_greater(x194, -x157 * (1.0f / sqrtf(etendue_greater(x191, 1e-7f)))) * sqrtf(x354);
    const float x360 = 7.1525574e-7f * etendue_greater(x359, -x193);
    float x361 = fmaf(x153, fmaf(x86, x176, fmaf(x87, x177, x88 * x178)), x168);
    float x362 = x153 * fmaf(x120, x183, fmaf(x121, x185, x122 * x187));
    if (b192) {
        const float x363 = -(x251 * x264);
        const float x364 = -(x252 * x262);
        const float x365 = -(x250 * x263);
        const float x366 = x265 * x354;
        const float x367 = x152 * (x152 * x366) / (1.0f + x152 * fabsf(fmaf(x83, x266, fmaf(x84, x267, x85 * x268))));
        const float x368 = x153 * (x153 * x366) / (1.0f + x153 * fabsf(fmaf(x86, x266, fmaf(x87, x267, x88 * x268))));
        const float x369 = x367 - x368;
        const float x370 = b270 ? fmaf(x265 * (fmaf(x252, x263, x363) - fmaf(x251, x264, x363)), x269, x266 * x369) : x170 + x256;
        const float x371 = b270 ? fmaf(x265 * (fmaf(x250, x264, x364) - fmaf(x252, x262, x364)), x269, x267 * x369) : x171 + x257;
        const float x372 = b270 ? fmaf(x265 * (fmaf(x251, x262, x365) - fmaf(x250, x263, x365)), x269, x268 * x369) : x172 + x258;
        const float x373 = (x188 < x157) ? fmaf(x253, x370, fmaf(x254, x371, x255 * x372)) : fmaf(x253, x259, fmaf(x254, x260, x255 * x261));
        x361 = (etendue_greater(x157, x188) < x155) ? fmaf(x259, x370, fmaf(x260, x371, x261 * x372)) : x373;
        x362 = -(x153 * (x152 * (x160 * fmaf(x131, x250, fmaf(x134, x251, x137 * x252)))));
    }
    const float x374 = b241 ? 2.0f * etendue_angle(x233, x361) : 0.0f;
    const float x375 = etendue_greater(fmaf(x233, x233, x361 * x361), 1e-36f);
    const float x376 = 1.0f / sqrtf(x375);
    const float x377 = x233 * x376;
    const float x378 = x361 * x376;
    const float x379 = x376 * (x242 * x375);
    const float x380 = x379 * (x163 * 0.5f);
    const bool b381 = x380 < 1e30f;
    const float x382 = x361 * x242;
    const float x383 = x361 - x168;
    float x384 = 0.0f;
    if (b192) {
        x384 = fmaf(x362, x362, x235 * x235) / (1.0f + fabsf(x188));
    }
    const float x385 = 1.0f / etendue_greater((b192 && b271) ? x384 : 1.0f + x188, 1e-30f);
    const float x386 = b381 ? etendue_lesser(x380 * (x235 * x385), 1e18f) : 0.0f;
    const float x387 = b381 ? etendue_lesser(etendue_greater(x380 * fmaf(x362, -x385, x169), -1e18f), 1e18f) : 0.0f;
    EtendueTriangleBySolidAngle result;
    result.surface_plane_cross.x = x54;
    result.surface_plane_cross.y = x55;
    result.surface_plane_cross.z = x56;
    result.surface_plane_normal.x = x33;
    result.surface_plane_normal.y = x34;
    result.surface_plane_normal.z = x35;
    result.surface_plane_height = x221;
    result.surface_plane_along_first.x = x58;
    result.surface_plane_along_first.y = x60;
    result.surface_plane_along_first.z = x62;
    result.surface_plane_along_second.x = x64;
    result.surface_plane_along_second.y = x66;
    result.surface_plane_along_second.z = x68;
    result.surface_plane_unit = x69;
    result.shape_side01.x = x243;
    result.shape_side01.y = x244;
    result.shape_side01.z = x245;
    result.shape_side12.x = x356;
    result.shape_side12.y = x357;
    result.shape_side12.z = x358;
    result.shape_side20.x = x246;
    result.shape_side20.y = x247;
    result.shape_side20.z = x248;
    result.shape_slack.x = x195;
    result.shape_slack.y = x360;
    result.shape_slack.z = x196;
    result.shape_normal.x = x97;
    result.shape_normal.y = x100;
    result.shape_normal.z = x103;
    result.shape_l1 = x162;
    result.shape_farthest = x197;
    result.shape_apex.x = x170;
    result.shape_apex.y = x171;
    result.shape_apex.z = x172;
    result.shape_along.x = x183;
    result.shape_along.y = x185;
    result.shape_along.z = x187;
    result.shape_across.x = x236;
    result.shape_across.y = x237;
    result.shape_across.z = x238;
    result.shape_cot_alpha = x240;
    result.shape_stretch = x165;
    result.shape_tan_half = x169;
    result.shape_half.x = x377;
    result.shape_half.y = x378;
    result.shape_turned.x = x386;
    result.shape_turned.y = x387;
    result.shape_sin_side = x163;
    result.shape_inv_l0 = x151;
    result.shape_inv_l2 = x153;
    result.shape_cot_half = x382;
    result.shape_inv_half_sin = x379;
    result.shape_g2 = x168;
    result.shape_g2_over_g0 = x249;
    result.shape_one_plus_d02 = x355;
    result.shape_sin02_squared = x191;
    result.shape_x2 = x362;
    result.shape_y2 = x235;
    result.shape_g1 = x383;
    result.shape_volume = x222;
    result.shape_solid_angle = x374;
    result.shape_unit = x198;
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
    const float x53 = x20 * (x40 + x51) / ((0.0f < x52) ? x52 : 1.0f);
    const float x54 = b50 ? fabsf(fmaf(prepared.shape_normal.x, x46, fmaf(prepared.shape_normal.y, x47, prepared.shape_normal.z * x48))) : fmaf(x49, prepared.shape_l1 * fmaf(prepared.shape_inv_l0, x18, prepared.shape_inv_l2 * x19), x53);
    const bool b55 = (0.0f < x54) && (0.0f < prepared.shape_solid_angle);
    const float x56 = b55 ? etendue_lesser((b50 ? fabsf(prepared.shape_volume) : prepared.shape_l1) / (b55 ? x54 : 1.0f), prepared.shape_farthest) : 0.0f;
    const float x57 = etendue_lesser(x56 * (prepared.shape_inv_l2 * (x19 * x49)), 1.0f);
    const float x58 = etendue_greater(1.0f - etendue_lesser(x56 * (prepared.shape_inv_l0 * (x18 * x49)), 1.0f) - x57, 0.0f);
    const float x59 = b50 ? x58 : etendue_lesser(x56 * (x53 / etendue_greater(prepared.shape_l1, 1e-37f)), 1.0f);
    const float x60 = etendue_lesser(prepared.shape_unit * x56, 3.4028235e38f);
    EtendueLightSample result;
    result.direction.x = x46;
    result.direction.y = x47;
    result.direction.z = x48;
    result.distance = x60;
    result.pdf = x21;
    result.weight = x23;
    result.normal.x = prepared.surface_plane_normal.x;
    result.normal.y = prepared.surface_plane_normal.y;
    result.normal.z = prepared.surface_plane_normal.z;
    result.uv.x = x59;
    result.uv.y = x57;
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
    const float x39 = x22 * x31;
    const float x40 = fmaf(x22, x31, -x39);
    const float x41 = fmaf(x21, x32, -x39) - x40;
    const float x42 = x20 * x32;
    const float x43 = fmaf(x20, x32, -x42);
    const float x44 = fmaf(x22, x30, -x42) - x43;
    const float x45 = x21 * x30;
    const float x46 = fmaf(x21, x30, -x45);
    const float x47 = fmaf(x20, x31, -x45) - x46;
    const float x48 = fabsf(x41);
    const float x49 = fabsf(x44);
    const float x50 = etendue_pow2_scale(etendue_greater(etendue_greater(x48, x49), fabsf(x47)));
    const float x51 = x41 * x50;
    const float x52 = x44 * x50;
    const float x53 = x47 * x50;
    const float x54 = fmaf(x51, x51, fmaf(x52, x52, x53 * x53));
    const float x55 = (0.0f < x54) ? 1.0f / sqrtf(x54) : 0.0f;
    const float x56 = x51 * x55;
    const float x57 = x52 * x55;
    const float x58 = x53 * x55;
    const float x59 = x54 * x55 / x50;
    const float x60 = x12 * x47;
    const float x61 = fmaf(x10, x41, fmaf(x11, x44, x60));
    const bool b62 = fabsf(x61 + x61) < fmaf(x48, fabsf(x10), fmaf(x49, fabsf(x11), fabsf(x60)));
    const float x63 = x10 + x13;
    const float x64 = x11 + x14;
    const float x65 = x12 + x15;
    const float x66 = x16 + x63;
    const float x67 = x17 + x64;
    const float x68 = x18 + x65;
    const float x69 = x10 + x16;
    const float x70 = x11 + x17;
    const float x71 = x12 + x18;
    const float x72 = x10 * x20;
    const float x73 = x11 * x21;
    const float x74 = x12 * x22;
    const float x75 = x72 + x73;
    const float x76 = x75 - x72;
    const float x77 = x74 + x75;
    const float x78 = x77 - x75;
    const float x79 = x72 - (x75 - x76) + (x73 - x76) + (x75 - (x77 - x78) + (x74 - x78));
    const float x80 = fmaf(x10, x20, -x72) + (fmaf(x11, x21, -x73) + fmaf(x12, x22, -x74));
    const float x81 = x79 + x80;
    const float x82 = x13 * x20;
    const float x83 = x14 * x21;
    const float x84 = x15 * x22;
    const float x85 = x82 + x83;
    const float x86 = x85 - x82;
    const float x87 = x84 + x85;
    const float x88 = x87 - x85;
    const float x89 = x82 - (x85 - x86) + (x83 - x86) + (x85 - (x87 - x88) + (x84 - x88));
    const float x90 = fmaf(x13, x20, -x82) + (fmaf(x14, x21, -x83) + fmaf(x15, x22, -x84));
    const float x91 = x24 * (x77 + x81);
    const float x92 = x77 + x87;
    const float x93 = x92 - x77;
    const float x94 = x77 - (x92 - x93) + (x87 - x93) + (x81 + (x89 + x90));
    const float x95 = x24 * (x92 + x94);
    const bool b96 = x91 + x95 < 0.0f;
    const float x97 = etendue_greater(b96 ? -x95 : x91, x28 * -0.5f);
    const float x98 = x28 + x97;
    const float x99 = x10 * x30;
    const float x100 = x11 * x31;
    const float x101 = x12 * x32;
    const float x102 = x99 + x100;
    const float x103 = x102 - x99;
    const float x104 = x101 + x102;
    const float x105 = x104 - x102;
    const float x106 = x99 - (x102 - x103) + (x100 - x103) + (x102 - (x104 - x105) + (x101 - x105));
    const float x107 = fmaf(x10, x30, -x99) + (fmaf(x11, x31, -x100) + fmaf(x12, x32, -x101));
    const float x108 = x106 + x107;
    const float x109 = x16 * x30;
    const float x110 = x17 * x31;
    const float x111 = x18 * x32;
    const float x112 = x109 + x110;
    const float x113 = x112 - x109;
    const float x114 = x111 + x112;
    const float x115 = x114 - x112;
    const float x116 = x109 - (x112 - x113) + (x110 - x113) + (x112 - (x114 - x115) + (x111 - x115));
    const float x117 = fmaf(x16, x30, -x109) + (fmaf(x17, x31, -x110) + fmaf(x18, x32, -x111));
    const float x118 = x34 * (x104 + x108);
    const float x119 = x104 + x114;
    const float x120 = x119 - x104;
    const float x121 = x104 - (x119 - x120) + (x114 - x120) + (x108 + (x116 + x117));
    const float x122 = x34 * (x119 + x121);
    const bool b123 = x118 + x122 < 0.0f;
    const float x124 = etendue_greater(b123 ? -x122 : x118, x38 * -0.5f);
    const float x125 = x38 + x124;
    const float x126 = b96 ? -x25 : x25;
    const float x127 = b96 ? -x26 : x26;
    const float x128 = b96 ? -x27 : x27;
    const float x129 = b123 ? -x35 : x35;
    const float x130 = b123 ? -x36 : x36;
    const float x131 = b123 ? -x37 : x37;
    const bool b132 = x98 <= x97 + x97;
    const bool b133 = x125 <= x124 + x124;
    const float x134 = b132 ? x98 : 0.0f;
    const float x135 = b133 ? x125 : 0.0f;
    const float x136 = x98 - x134;
    const float x137 = x125 - x135;
    const float x138 = (b96 ? (b123 ? x10 : x69) : (b123 ? x63 : x66)) - x126 * x136 - x129 * x137;
    const float x139 = (b96 ? (b123 ? x11 : x70) : (b123 ? x64 : x67)) - x127 * x136 - x130 * x137;
    const float x140 = (b96 ? (b123 ? x12 : x71) : (b123 ? x65 : x68)) - x128 * x136 - x131 * x137;
    const float x141 = x124 * x125;
    const bool b142 = x124 < 0.0f;
    const float x143 = x98 * x98;
    const float x144 = fabsf(x124);
    const float x145 = x38 * (x124 + x125);
    const float x146 = fabsf(x141);
    const bool b147 = x97 < 0.0f;
    const float x148 = -x97 * -x97;
    const bool b149 = b142 || b147;
    const bool b150 = b142 && !b147;
    const float x151 = b150 ? x124 : x97;
    const float x152 = b150 ? x97 : x124;
    const float x153 = b150 ? x125 : x98;
    const float x154 = b150 ? x98 : x125;
    const float x155 = x152 * x154;
    const bool b156 = 0.0f <= x152;
    const float x157 = fabsf(x152);
    const float x158 = (b150 ? x28 : x38) * (x152 + x154);
    const float x159 = x151 * x153;
    const float x160 = x11 * x15;
    const float x161 = x12 * x14;
    const float x162 = x160 - x161;
    const float x163 = x162 - x160;
    const float x164 = x160 - (x162 - x163) + (-x161 - x163) + (fmaf(x11, x15, -x160) - fmaf(x12, x14, -x161));
    const float x165 = x12 * x13;
    const float x166 = x10 * x15;
    const float x167 = x165 - x166;
    const float x168 = x167 - x165;
    const float x169 = x165 - (x167 - x168) + (-x166 - x168) + (fmaf(x12, x13, -x165) - fmaf(x10, x15, -x166));
    const float x170 = x10 * x14;
    const float x171 = x11 * x13;
    const float x172 = x170 - x171;
    const float x173 = x172 - x170;
    const float x174 = x170 - (x172 - x173) + (-x171 - x173) + (fmaf(x10, x14, -x170) - fmaf(x11, x13, -x171));
    const float x175 = x11 * x18;
    const float x176 = x12 * x17;
    const float x177 = x175 - x176;
    const float x178 = x177 - x175;
    const float x179 = x175 - (x177 - x178) + (-x176 - x178) + (fmaf(x11, x18, -x175) - fmaf(x12, x17, -x176));
    const float x180 = x12 * x16;
    const float x181 = x10 * x18;
    const float x182 = x180 - x181;
    const float x183 = x182 - x180;
    const float x184 = x180 - (x182 - x183) + (-x181 - x183) + (fmaf(x12, x16, -x180) - fmaf(x10, x18, -x181));
    const float x185 = x10 * x17;
    const float x186 = x11 * x16;
    const float x187 = x185 - x186;
    const float x188 = x187 - x185;
    const float x189 = x185 - (x187 - x188) + (-x186 - x188) + (fmaf(x10, x17, -x185) - fmaf(x11, x16, -x186));
    const float x190 = x14 * x18;
    const float x191 = x15 * x17;
    const float x192 = x190 - x191;
    const float x193 = x192 - x190;
    const float x194 = x190 - (x192 - x193) + (-x191 - x193) + (fmaf(x14, x18, -x190) - fmaf(x15, x17, -x191));
    const float x195 = x15 * x16;
    const float x196 = x13 * x18;
    const float x197 = x195 - x196;
    const float x198 = x197 - x195;
    const float x199 = x195 - (x197 - x198) + (-x196 - x198) + (fmaf(x15, x16, -x195) - fmaf(x13, x18, -x196));
    const float x200 = x13 * x17;
    const float x201 = x14 * x16;
    const float x202 = x200 - x201;
    const float x203 = x202 - x200;
    const float x204 = x200 - (x202 - x203) + (-x201 - x203) + (fmaf(x13, x17, -x200) - fmaf(x14, x16, -x201));
    const float x205 = -x177 - x179;
    const float x206 = -x182 - x184;
    const float x207 = -x187 - x189;
    const float x208 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x205), fabsf(x206)), fabsf(x207)));
    const float x209 = x205 * x208;
    const float x210 = x206 * x208;
    const float x211 = x207 * x208;
    const float x212 = fmaf(x209, x209, fmaf(x210, x210, x211 * x211));
    const float x213 = (0.0f < x212) ? 1.0f / sqrtf(x212) : 0.0f;
    const float x214 = x209 * x213;
    const float x215 = x210 * x213;
    const float x216 = x211 * x213;
    const float x217 = x212 * x213 / x208;
    const float x218 = (0.0f < x217) ? -fmaf(x10, x69, fmaf(x11, x70, x12 * x71)) / x217 : 0.0f;
    const float x219 = etendue_lesser(etendue_greater(x218, 1.0f), 1e18f) * 4.7683716e-7f;
    const float x220 = x177 + x192;
    const float x221 = x220 - x177;
    const float x222 = x182 + x197;
    const float x223 = x222 - x182;
    const float x224 = x187 + x202;
    const float x225 = x224 - x187;
    const float x226 = x220 + (x177 - (x220 - x221) + (x192 - x221) + (x179 + x194));
    const float x227 = x222 + (x182 - (x222 - x223) + (x197 - x223) + (x184 + x199));
    const float x228 = x224 + (x187 - (x224 - x225) + (x202 - x225) + (x189 + x204));
    const float x229 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x226), fabsf(x227)), fabsf(x228)));
    const float x230 = x226 * x229;
    const float x231 = x227 * x229;
    const float x232 = x228 * x229;
    const float x233 = fmaf(x230, x230, fmaf(x231, x231, x232 * x232));
    const float x234 = (0.0f < x233) ? 1.0f / sqrtf(x233) : 0.0f;
    const float x235 = x230 * x234;
    const float x236 = x231 * x234;
    const float x237 = x232 * x234;
    const float x238 = x233 * x234 / x229;
    const float x239 = (0.0f < x238) ? -fmaf(x63, x66, fmaf(x64, x67, x65 * x68)) / x238 : 0.0f;
    const float x240 = 4.7683716e-7f * etendue_lesser(etendue_greater(x239, 1.0f), 1e18f);
    const float x241 = x162 + x164;
    const float x242 = x167 + x169;
    const float x243 = x172 + x174;
    const float x244 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x241), fabsf(x242)), fabsf(x243)));
    const float x245 = x241 * x244;
    const float x246 = x242 * x244;
    const float x247 = x243 * x244;
    const float x248 = fmaf(x245, x245, fmaf(x246, x246, x247 * x247));
    const float x249 = (0.0f < x248) ? 1.0f / sqrtf(x248) : 0.0f;
    const float x250 = x245 * x249;
    const float x251 = x246 * x249;
    const float x252 = x247 * x249;
    const float x253 = x248 * x249 / x244;
    const float x254 = (0.0f < x253) ? -fmaf(x10, x63, fmaf(x11, x64, x12 * x65)) / x253 : 0.0f;
    const float x255 = 4.7683716e-7f * etendue_lesser(etendue_greater(x254, 1.0f), 1e18f);
    const float x256 = x192 - x162;
    const float x257 = x256 - x192;
    const float x258 = x197 - x167;
    const float x259 = x258 - x197;
    const float x260 = x202 - x172;
    const float x261 = x260 - x202;
    const float x262 = x192 - (x256 - x257) + (-x162 - x257) + (x194 - x164);
    const float x263 = x197 - (x258 - x259) + (-x167 - x259) + (x199 - x169);
    const float x264 = x202 - (x260 - x261) + (-x172 - x261) + (x204 - x174);
    const float x265 = x256 + x262;
    const float x266 = x258 + x263;
    const float x267 = x260 + x264;
    const float x268 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x265), fabsf(x266)), fabsf(x267)));
    const float x269 = x265 * x268;
    const float x270 = x266 * x268;
    const float x271 = x267 * x268;
    const float x272 = fmaf(x269, x269, fmaf(x270, x270, x271 * x271));
    const float x273 = (0.0f < x272) ? 1.0f / sqrtf(x272) : 0.0f;
    const float x274 = x269 * x273;
    const float x275 = x270 * x273;
    const float x276 = x271 * x273;
    const float x277 = x272 * x273 / x268;
    const float x278 = (0.0f < x277) ? -fmaf(x66, x69, fmaf(x67, x70, x68 * x71)) / x277 : 0.0f;
    const float x279 = 4.7683716e-7f * etendue_lesser(etendue_greater(x278, 1.0f), 1e18f);
    const float x280 = b96 ? x240 : x219;
    const float x281 = b123 ? x279 : x255;
    const float x282 = b96 ? x219 : x240;
    const float x283 = b123 ? x255 : x279;
    const float x284 = b132 ? 1.0f : 0.0f;
    const float x285 = b133 ? 1.0f : 0.0f;
    const float x286 = b96 ? 1.0f : 0.0f;
    const float x287 = b123 ? 1.0f : 0.0f;
    const float x288 = b147 ? 0.5f : 2.0f;
    const float x289 = 1.0f / x9;
    const float x290 = etendue_pow2_scale(x5);
    const bool b291 = x5 < INFINITY;
    const float x292 = x290 * (b291 ? light.edge_s.x : 0.0f);
    const float x293 = x290 * (b291 ? light.edge_s.y : 0.0f);
    const float x294 = x290 * (b291 ? light.edge_s.z : 0.0f);
    const float x295 = etendue_pow2_scale(x6);
    const bool b296 = x6 < INFINITY;
    const float x297 = x295 * (b296 ? light.edge_t.x : 0.0f);
    const float x298 = x295 * (b296 ? light.edge_t.y : 0.0f);
    const float x299 = x295 * (b296 ? light.edge_t.z : 0.0f);
    const float x300 = x294 * x298;
    const float x301 = fmaf(x294, x298, -x300);
    const float x302 = fmaf(x293, x299, -x300) - x301;
    const float x303 = x292 * x299;
    const float x304 = fmaf(x292, x299, -x303);
    const float x305 = fmaf(x294, x297, -x303) - x304;
    const float x306 = x293 * x297;
    const float x307 = fmaf(x293, x297, -x306);
    const float x308 = fmaf(x292, x298, -x306) - x307;
    const float x309 = fabsf(x302);
    const float x310 = fabsf(x305);
    const float x311 = etendue_pow2_scale(etendue_greater(etendue_greater(x309, x310), fabsf(x308)));
    const float x312 = x302 * x311;
    const float x313 = x305 * x311;
    const float x314 = x308 * x311;
    const float x315 = fmaf(x312, x312, fmaf(x313, x313, x314 * x314));
    const float x316 = (0.0f < x315) ? 1.0f / sqrtf(x315) : 0.0f;
    const float x317 = x312 * x316;
    const float x318 = x313 * x316;
    const float x319 = x314 * x316;
    const float x320 = x315 * x316 / x311;
    const float x321 = etendue_greater(etendue_greater(etendue_greater(0.0f, x4), x5), x6);
    const bool b322 = x321 < INFINITY;
    const float x323 = etendue_pow2_scale(x321);
    const float x324 = x323 * (b322 ? x1 : 0.0f);
    const float x325 = x323 * (b322 ? x2 : 0.0f);
    const float x326 = x323 * (b322 ? x3 : 0.0f);
    const float x327 = x323 * (b322 ? light.edge_s.x : 0.0f);
    const float x328 = x323 * (b322 ? light.edge_s.y : 0.0f);
    const float x329 = x323 * (b322 ? light.edge_s.z : 0.0f);
    const float x330 = x323 * (b322 ? light.edge_t.x : 0.0f);
    const float x331 = x323 * (b322 ? light.edge_t.y : 0.0f);
    const float x332 = x323 * (b322 ? light.edge_t.z : 0.0f);
    const float x333 = x308 * x326;
    const float x334 = fmaf(x302, x324, fmaf(x305, x325, x333));
    const bool b335 = fabsf(x334 + x334) < fmaf(x309, fabsf(x324), fmaf(x310, fabsf(x325), fabsf(x333)));
    const float x336 = x320 * (x323 / x290) * (x323 / x295);
    const float x337 = x317 * x336;
    const float x338 = x318 * x336;
    const float x339 = x319 * x336;
    const float x340 = -(x326 * x328);
    const float x341 = fmaf(x325, x329, x340) - fmaf(x326, x328, x340);
    const float x342 = -(x324 * x329);
    const float x343 = fmaf(x326, x327, x342) - fmaf(x324, x329, x342);
    const float x344 = -(x325 * x327);
    const float x345 = fmaf(x324, x328, x344) - fmaf(x325, x327, x344);
    const float x346 = -(x326 * x331);
    const float x347 = fmaf(x325, x332, x346) - fmaf(x326, x331, x346);
    const float x348 = -(x324 * x332);
    const float x349 = fmaf(x326, x330, x348) - fmaf(x324, x332, x348);
    const float x350 = -(x325 * x330);
    const float x351 = fmaf(x324, x331, x350) - fmaf(x325, x330, x350);
    const float x352 = 1.0f / x323;
    float x353 = 0.0f;
    if (b62) {
        const float x354 = x21 * x32;
        const float x355 = x354 - x39;
        const float x356 = x355 - x354;
        const float x357 = x354 - (x355 - x356) + (-x39 - x356) + (fmaf(x21, x32, -x354) - x40);
        const float x358 = x22 * x30;
        const float x359 = x358 - x42;
        const float x360 = x359 - x358;
        const float x361 = x358 - (x359 - x360) + (-x42 - x360) + (fmaf(x22, x30, -x358) - x43);
        const float x362 = x20 * x31;
        const float x363 = x362 - x45;
        const float x364 = x363 - x362;
        const float x365 = x362 - (x363 - x364) + (-x45 - x364) + (fmaf(x20, x31, -x362) - x46);
        const float x366 = x10 * x355;
        const float x367 = x11 * x359;
        const float x368 = x12 * x363;
        const float x369 = x366 + x367;
        const float x370 = x369 - x366;
        const float x371 = x368 + x369;
        const float x372 = x371 - x369;
        const float x373 = x366 - (x369 - x370) + (x367 - x370) + (x369 - (x371 - x372) + (x368 - x372));
        const float x374 = fmaf(x10, x355, -x366) + (fmaf(x11, x359, -x367) + fmaf(x12, x363, -x368));
        x353 = x371 + (x373 + x374 + fmaf(x10, x357, fmaf(x11, x361, x12 * x365)));
    }
    const float x375 = (0.0f < x59) ? (b62 ? x353 : x61) / x59 : 0.0f;
    const float x376 = fabsf(x375);
    const float x377 = etendue_copysign(1.0f, x375);
    const bool b378 = etendue_greater(x136, x137) <= etendue_greater(etendue_greater(x134, x135), x376);
    const float x379 = b378 ? x138 : fmaf(x126, x134, fmaf(x129, x135, x56 * x375));
    const float x380 = b378 ? x139 : fmaf(x127, x134, fmaf(x130, x135, x57 * x375));
    const float x381 = b378 ? x140 : fmaf(x128, x134, fmaf(x131, x135, x58 * x375));
    const float x382 = x376 * x376;
    const float x383 = sqrtf(fmaf(x124, x124, x382) * fmaf(x125, x125, x382));
    const float x384 = (0.0f < x383) ? 1.0f / x383 : 0.0f;
    const float x385 = x382 + x143;
    const float x386 = sqrtf(fmaf(x124, x124, x385));
    const float x387 = fmaf(x125, x125, x385);
    const float x388 = sqrtf(x387);
    const float x389 = x386 * x388;
    const float x390 = (0.0f < x385) ? 1.0f / x385 : 0.0f;
    const float x391 = fmaf(x125, x386, x388 * x144);
    const float x392 = x389 + x146;
    const float x393 = (b142 ? x390 * x391 : ((0.0f < x391) ? x145 / x391 : 0.0f)) * (x376 * x98);
    const float x394 = x384 * x393;
    const float x395 = x384 * (x390 * fmaf(x141, x143, x382 * x389));
    const float x396 = x384 * (x38 * (x38 * x382));
    const float x397 = 1.0f + ((0.0f < x392) ? fmaf(x124, x124, x387) / x392 : 0.0f);
    const float x398 = x385 + x392;
    const float x399 = b142 ? x385 * x397 : x398;
    const float x400 = (0.0f < x399) ? x396 / x399 : 0.0f;
    const float x401 = x382 * x384;
    const float x402 = x401 * (b142 ? x390 * x398 : x397);
    const float x403 = x382 + x148;
    const float x404 = sqrtf(fmaf(x124, x124, x403));
    const float x405 = fmaf(x125, x125, x403);
    const float x406 = sqrtf(x405);
    const float x407 = x404 * x406;
    const float x408 = (0.0f < x403) ? 1.0f / x403 : 0.0f;
    const float x409 = fmaf(x125, x404, x144 * x406);
    const float x410 = x146 + x407;
    const float x411 = (b142 ? x408 * x409 : ((0.0f < x409) ? x145 / x409 : 0.0f)) * (x376 * -x97);
    const float x412 = x384 * x411;
    const float x413 = x384 * (x408 * fmaf(x141, x148, x382 * x407));
    const float x414 = 1.0f + ((0.0f < x410) ? fmaf(x124, x124, x405) / x410 : 0.0f);
    const float x415 = x403 + x410;
    const float x416 = b142 ? x403 * x414 : x415;
    const float x417 = (0.0f < x416) ? x396 / x416 : 0.0f;
    const float x418 = x401 * (b142 ? x408 * x415 : x414);
    const float x419 = fmaf(x151, x151, x382);
    const float x420 = fmaf(x153, x153, x382);
    const float x421 = sqrtf(fmaf(x152, x152, x419));
    const float x422 = sqrtf(fmaf(x154, x154, x419));
    const float x423 = sqrtf(fmaf(x152, x152, x420));
    const float x424 = sqrtf(fmaf(x154, x154, x420));
    const float x425 = fmaf(x154, x423, x424 * x157);
    const float x426 = (b156 ? ((0.0f < x425) ? x420 * x158 / x425 : 0.0f) : x425) * (x376 * fabsf(x153));
    const float x427 = fmaf(x154, x421, x422 * x157);
    const float x428 = (b156 ? ((0.0f < x427) ? x419 * x158 / x427 : 0.0f) : x427) * (x376 * fabsf(x151));
    const float x429 = x421 * x422;
    const float x430 = x38 * (x28 * x376);
    const float x431 = x382 + (x155 + x159);
    const float x432 = fmaf(x424, x421 * x423, fmaf(x424, x159 + fmaf(x152, x152, x382), fmaf(x423, x431, x421 * (x420 + x155))));
    const float x433 = fmaf(x424, x429, fmaf(x421, x159 + fmaf(x154, x154, x382), fmaf(x422, x431, x424 * (x419 + x155))));
    const float x434 = etendue_angle(b149 ? x426 : x430, b149 ? fmaf(x155, x153 * x153, x382 * (x423 * x424)) : x432);
    const float x435 = x434 + etendue_angle(b149 ? x428 : x430, b149 ? fmaf(x155, x151 * x151, x382 * x429) : x433);
    const float x436 = x435 * (b149 ? 1.0f : 2.0f);
    const bool b437 = 0.0f < x394;
    const bool b438 = b8 && (1e-36f < x436) && (x436 < 7.0f) && b437 && (1e-18f < x376);
    const bool b439 = x377 < 0.0f;
    const float x440 = b439 ? -x214 : x214;
    const float x441 = b439 ? -x215 : x215;
    const float x442 = b439 ? -x216 : x216;
    const float x443 = b439 ? -x235 : x235;
    const float x444 = b439 ? -x236 : x236;
    const float x445 = b439 ? -x237 : x237;
    const float x446 = b439 ? -x250 : x250;
    const float x447 = b439 ? -x251 : x251;
    const float x448 = b439 ? -x252 : x252;
    const float x449 = b439 ? -x274 : x274;
    const float x450 = b439 ? -x275 : x275;
    const float x451 = b439 ? -x276 : x276;
    const float x452 = b96 ? x443 : x440;
    const float x453 = b96 ? x444 : x441;
    const float x454 = b96 ? x445 : x442;
    const float x455 = b96 ? x440 : x443;
    const float x456 = b96 ? x441 : x444;
    const float x457 = b96 ? x442 : x445;
    const float x458 = b123 ? x449 : x446;
    const float x459 = b123 ? x450 : x447;
    const float x460 = b123 ? x451 : x448;
    const float x461 = b123 ? x446 : x449;
    const float x462 = b123 ? x447 : x450;
    const float x463 = b123 ? x448 : x451;
    const float x464 = x56 * x377;
    const float x465 = x57 * x377;
    const float x466 = x58 * x377;
    const float x467 = b437 ? 1.0f / x394 : 0.0f;
    const float x468 = b438 ? x436 : 0.0f;
    float x469 = 0.0f;
    if (b335) {
        const float x470 = x293 * x299;
        const float x471 = x470 - x300;
        const float x472 = x471 - x470;
        const float x473 = x470 - (x471 - x472) + (-x300 - x472) + (fmaf(x293, x299, -x470) - x301);
        const float x474 = x294 * x297;
        const float x475 = x474 - x303;
        const float x476 = x475 - x474;
        const float x477 = x474 - (x475 - x476) + (-x303 - x476) + (fmaf(x294, x297, -x474) - x304);
        const float x478 = x292 * x298;
        const float x479 = x478 - x306;
        const float x480 = x479 - x478;
        const float x481 = x478 - (x479 - x480) + (-x306 - x480) + (fmaf(x292, x298, -x478) - x307);
        const float x482 = x324 * x471;
        const float x483 = x325 * x475;
        const float x484 = x326 * x479;
        const float x485 = x482 + x483;
        const float x486 = x485 - x482;
        const float x487 = x484 + x485;
        const float x488 = x487 - x485;
        const float x489 = x482 - (x485 - x486) + (x483 - x486) + (x485 - (x487 - x488) + (x484 - x488));
        const float x490 = fmaf(x324, x471, -x482) + (fmaf(x325, x475, -x483) + fmaf(x326, x479, -x484));
        x469 = x487 + (x489 + x490 + fmaf(x324, x473, fmaf(x325, x477, x326 * x481)));
    }
    const float x491 = etendue_lesser(etendue_greater((1e-37f < fabsf(x320)) ? (b335 ? x469 : x334) / x320 : 0.0f, -1e37f), 1e37f);
    EtendueRectangleBySolidAngle result;
    result.surface_plane_cross.x = x337;
    result.surface_plane_cross.y = x338;
    result.surface_plane_cross.z = x339;
    result.surface_plane_normal.x = x317;
    result.surface_plane_normal.y = x318;
    result.surface_plane_normal.z = x319;
    result.surface_plane_height = x491;
    result.surface_plane_along_first.x = x341;
    result.surface_plane_along_first.y = x343;
    result.surface_plane_along_first.z = x345;
    result.surface_plane_along_second.x = x347;
    result.surface_plane_along_second.y = x349;
    result.surface_plane_along_second.z = x351;
    result.surface_plane_unit = x352;
    result.shape_base.x = x379;
    result.shape_base.y = x380;
    result.shape_base.z = x381;
    result.shape_side_x.x = x126;
    result.shape_side_x.y = x127;
    result.shape_side_x.z = x128;
    result.shape_side_y.x = x129;
    result.shape_side_y.y = x130;
    result.shape_side_y.z = x131;
    result.shape_near_x.x = x452;
    result.shape_near_x.y = x453;
    result.shape_near_x.z = x454;
    result.shape_far_x.x = x455;
    result.shape_far_x.y = x456;
    result.shape_far_x.z = x457;
    result.shape_near_y.x = x458;
    result.shape_near_y.y = x459;
    result.shape_near_y.z = x460;
    result.shape_far_y.x = x461;
    result.shape_far_y.y = x462;
    result.shape_far_y.z = x463;
    result.shape_slack.x = x280;
    result.shape_slack.y = x281;
    result.shape_slack_far.x = x282;
    result.shape_slack_far.y = x283;
    result.shape_normal.x = x464;
    result.shape_normal.y = x465;
    result.shape_normal.z = x466;
    result.shape_near.x = x97;
    result.shape_near.y = x124;
    result.shape_far.x = x98;
    result.shape_far.y = x125;
    result.shape_size.x = x28;
    result.shape_size.y = x38;
    result.shape_height = x376;
    result.shape_anchor.x = x284;
    result.shape_anchor.y = x285;
    result.shape_flip.x = x286;
    result.shape_flip.y = x287;
    result.shape_sin_w1 = x394;
    result.shape_cos_w1 = x395;
    result.shape_inv_sin_w1 = x467;
    result.shape_above_p = x400;
    result.shape_above_s = x402;
    result.shape_near_sin = x412;
    result.shape_near_cos = x413;
    result.shape_near_above_p = x417;
    result.shape_near_above_s = x418;
    result.shape_half = x288;
    result.shape_solid_angle = x468;
    result.shape_side = x377;
    result.shape_unit = x289;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian. Greatest error over the atlas: direction 6e-7 (4e-5 of the rectangle's size if that is 1e-6 and the point
// is 1e-7 above its plane), besides what 8 steps of 2^-24 in u do to it (Omega and u0Omega are rounded; u0 counts from
// the nearer end where the rectangle lies on both sides of the foot). pdf 5e-7 relative, since coordinates, and
// heights whose terms cancel, are formed in twice the working precision. Next to the plane of a rectangle that
// surrounds the point, nearly all of u0 lies within the rounding of a direction at the ends: the inverse is then one
// of the u that lead back to the direction.
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
    const float x57 = etendue_greater((0.0f < prepared.shape_size.x) ? (b17 ? -x20 : prepared.shape_far.x - x20) / prepared.shape_size.x : 0.0f, 0.0f);
    const float x58 = etendue_lesser(x57, 1.0f);
    const float x59 = b1 ? x58 : 1.0f - x58;
    const float x60 = etendue_greater((0.0f < prepared.shape_size.y) ? (b43 ? -x46 : prepared.shape_far.y - x46) / prepared.shape_size.y : 0.0f, 0.0f);
    const float x61 = etendue_lesser(x60, 1.0f);
    const float x62 = b23 ? x61 : 1.0f - x61;
    const float x63 = b55 ? 1.0f / prepared.shape_solid_angle : 0.0f;
    const bool b64 = prepared.shape_side < 0.0f;
    const float x65 = (b64 && (1e-37f < x63)) ? 1.0f / x63 : 0.0f;
    EtendueLightSample result;
    result.direction.x = x52;
    result.direction.y = x53;
    result.direction.z = x54;
    result.distance = x56;
    result.pdf = x63;
    result.weight = x65;
    result.normal.x = prepared.surface_plane_normal.x;
    result.normal.y = prepared.surface_plane_normal.y;
    result.normal.z = prepared.surface_plane_normal.z;
    result.uv.x = x59;
    result.uv.y = x62;
    result.emits = b64;
    result.delta = false;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the solid angle
// Omega at the point p: pdf 1/Omega per steradian. Greatest error over the atlas: direction 6e-7 (4e-5 of the
// rectangle's size if that is 1e-6 and the point is 1e-7 above its plane), besides what 8 steps of 2^-24 in u do to it
// (Omega and u0Omega are rounded; u0 counts from the nearer end where the rectangle lies on both sides of the foot).
// pdf 5e-7 relative, since coordinates, and heights whose terms cancel, are formed in twice the working precision.
// Next to the plane of a rectangle that surrounds the point, nearly all of u0 lies within the rounding of a direction
// at the ends: the inverse is then one of the u that lead back to the direction.
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
// of the foot). pdf 5e-7 relative, since coordinates, and heights whose terms cancel, are formed in twice the working
// precision. Next to the plane of a rectangle that surrounds the point, nearly all of u0 lies within the rounding of a
// direction at the ends: the inverse is then one of the u that lead back to the direction.
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
    const float x1 = (0.0f <= fmaf(light.direction.x, light.direction.x, fmaf(light.direction.y, light.direction.y, light.direction.z * light.direction.z))) ? light.one_minus_cos : 0.0f;
    const float x2 = etendue_copysign(1.0f, light.direction.z);
    const float x3 = -1.0f / (light.direction.z + x2);
    const float x4 = x3 * (light.direction.x * light.direction.y);
    const float x5 = light.direction.x * x2;
    const float x6 = fmaf(light.direction.x, x3 * x5, 1.0f);
    const float x7 = x2 * x4;
    const float x8 = -x5;
    const float x9 = fmaf(light.direction.y, light.direction.y * x3, x2);
    const float x10 = -light.direction.y;
    EtendueSunBySolidAngle result;
    result.frame_s.x = x6;
    result.frame_s.y = x7;
    result.frame_s.z = x8;
    result.frame_t.x = x4;
    result.frame_t.y = x9;
    result.frame_t.z = x10;
    result.frame_n.x = light.direction.x;
    result.frame_n.y = light.direction.y;
    result.frame_n.z = light.direction.z;
    result.cone_one_minus_cos = x1;
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
    const float x18 = -x13 - light.axis.x;
    const float x19 = -x14 - light.axis.y;
    const float x20 = -x15 - light.axis.z;
    const float x21 = fmaf(x18, x18, fmaf(x19, x19, x20 * x20)) * 0.5f;
    const float x22 = light.one_minus_cos_outer - light.one_minus_cos_inner;
    const bool b23 = 0.0f < x22;
    const float x24 = etendue_lesser(etendue_greater((light.one_minus_cos_outer - x21) / (b23 ? x22 : 1.0f), 0.0f), 1.0f);
    const float x25 = b23 ? x24 * x24 * (3.0f - (x24 + x24)) : ((x21 <= light.one_minus_cos_inner) ? 1.0f : 0.0f);
    const bool b26 = 0.0f < x25;
    const float x27 = ((x17 < 1e37f) ? x17 : 0.0f) / (b26 ? x25 : 1.0f);
    const float x28 = (b26 && (x27 < 1e37f)) ? x27 : 0.0f;
    EtendueSpotLightByDelta result;
    result.direction.x = x13;
    result.direction.y = x14;
    result.direction.z = x15;
    result.distance = x16;
    result.pdf = x28;
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
