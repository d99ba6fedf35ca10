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
// concentric squares: keeps strata compact.
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
// squares: keeps strata compact.
ETENDUE_FUNCTION float etendue_concentric_disk_pdf(EtendueVec2 point) {
    const float x1 = (fmaf(point.x, point.x, point.y * point.y) <= 1.0000004f) ? 0.31830987f : 0.0f;
    return x1;
}

// Maps u, of which each number is in [0, 1), to a point. Directions with z >= 0 and the pdf z/pi per steradian.
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

// The density of a point; 0 outside of the range. Directions with z >= 0 and the pdf z/pi per steradian.
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

// The density of a point; 0 outside of the range. Visible normals of a GGX microsurface, per steradian.
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
// steradian. From inside, every direction.
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
    const float x18 = etendue_greater(etendue_greater(0.0f, etendue_greater(etendue_greater(fabsf(prepared.surface_center.x), fabsf(prepared.surface_center.y)), fabsf(prepared.surface_center.z))), etendue_greater(etendue_greater(fabsf(prepared.surface_radius), 0.0f), 0.0f));
    const bool b19 = x18 < INFINITY;
    const float x20 = etendue_pow2_scale(x18);
    const float x21 = x20 * (b19 ? prepared.surface_center.x : 0.0f);
    const float x22 = x20 * (b19 ? prepared.surface_center.y : 0.0f);
    const float x23 = x20 * (b19 ? prepared.surface_center.z : 0.0f);
    const float x24 = x20 * (b19 ? prepared.surface_radius : 0.0f);
    const float x25 = x21 * x21;
    const float x26 = x22 * x22;
    const float x27 = x23 * x23;
    const float x28 = x24 * x24;
    const float x29 = x25 - x28;
    const float x30 = x29 - x25;
    const float x31 = x26 + x29;
    const float x32 = x31 - x29;
    const float x33 = x27 + x31;
    const float x34 = x33 - x31;
    const float x35 = x25 - (x29 - x30) + (-x28 - x30) + (x29 - (x31 - x32) + (x26 - x32));
    const float x36 = fmaf(x21, x21, -x25) - fmaf(x24, x24, -x28) + (fmaf(x22, x22, -x26) + fmaf(x23, x23, -x27));
    const float x37 = x33 + (x31 - (x33 - x34) + (x27 - x34) + x35 + x36);
    const float x38 = fmaf(x13, x21, fmaf(x14, x22, x15 * x23));
    const float x39 = fmaf(x13, -x38, x21);
    const float x40 = fmaf(x14, -x38, x22);
    const float x41 = fmaf(x15, -x38, x23);
    const float x42 = sqrtf(etendue_greater(fmaf(x24, x24, -fmaf(x39, x39, fmaf(x40, x40, x41 * x41))), 0.0f));
    const float x43 = x42 + fabsf(x38);
    const bool b44 = 1e-37f < fabsf(x43);
    const float x45 = (!(0.0f <= x37) && (0.0f <= x38)) ? x43 : etendue_lesser(etendue_greater(b44 ? fabsf(x37) / (b44 ? x43 : 1.0f) : 0.0f, -1e37f), 1e37f);
    const float x46 = fmaf(x13, x45, -x21);
    const float x47 = fmaf(x14, x45, -x22);
    const float x48 = fmaf(x15, x45, -x23);
    const float x49 = fmaf(x46, x46, fmaf(x47, x47, x48 * x48));
    const float x50 = (0.0f < x49) ? 1.0f / sqrtf(x49) : 0.0f;
    const float x51 = x46 * x50;
    const float x52 = x47 * x50;
    const float x53 = x48 * x50;
    const float x54 = (0.5f < x53) ? fmaf(x51, x51, x52 * x52) / (1.0f + fabsf(x53)) : 1.0f - x53;
    const float x55 = etendue_lesser(etendue_greater(x54 / 2.0f, 0.0f), 0.99999994f);
    const float x56 = etendue_angle(x52, x51) * 0.15915494f;
    const float x57 = etendue_lesser(etendue_greater((x56 < 0.0f) ? 1.0f + x56 : x56, 0.0f), 0.99999994f);
    const bool b58 = 1e-37f < x6;
    const float x59 = b58 ? 0.15915494f / (b58 ? x6 : 1.0f) : 0.0f;
    const bool b60 = !(prepared.shape_power < 0.0f);
    const bool b61 = b60 && (1e-37f < x59);
    const float x62 = b61 ? 1.0f / (b61 ? x59 : 1.0f) : 0.0f;
    EtendueLightSample result;
    result.direction.x = x13;
    result.direction.y = x14;
    result.direction.z = x15;
    result.distance = x17;
    result.pdf = x59;
    result.weight = x62;
    result.normal.x = x51;
    result.normal.y = x52;
    result.normal.z = x53;
    result.uv.x = x55;
    result.uv.y = x57;
    result.emits = b60;
    result.delta = false;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the solid angle
// Omega at the point p: pdf 1/Omega per steradian. From inside, every direction.
ETENDUE_FUNCTION float etendue_sphere_by_solid_angle_pdf(EtendueSphereBySolidAngle prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.shape_frame_s.x, w.x, fmaf(prepared.shape_frame_s.y, w.y, prepared.shape_frame_s.z * w.z));
    const float x2 = fmaf(prepared.shape_frame_t.x, w.x, fmaf(prepared.shape_frame_t.y, w.y, prepared.shape_frame_t.z * w.z));
    const float x3 = fmaf(prepared.shape_frame_n.x, w.x, fmaf(prepared.shape_frame_n.y, w.y, prepared.shape_frame_n.z * w.z));
    const float x4 = etendue_lesser(etendue_greater(prepared.shape_cone_one_minus_cos, 0.0f), 2.0f);
    const bool b5 = 1e-37f < x4;
    const float x6 = (0.5f < x3) ? fmaf(x1, x1, x2 * x2) / (1.0f + fabsf(x3)) : 1.0f - x3;
    const float x7 = x4 + fmaf(5.9604645e-7f, etendue_greater(sqrtf(x4 * (2.0f - x4)), x4 - 1.0f), 1.7763568e-13f);
    const float x8 = (x6 <= x7) ? (b5 ? 0.15915494f / (b5 ? x4 : 1.0f) : 0.0f) : 0.0f;
    return x8;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian. From inside, every direction.
ETENDUE_FUNCTION EtendueLightSample etendue_sphere_by_solid_angle_hit(EtendueSphereBySolidAngle prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.shape_frame_s.x, w.x, fmaf(prepared.shape_frame_s.y, w.y, prepared.shape_frame_s.z * w.z));
    const float x2 = fmaf(prepared.shape_frame_t.x, w.x, fmaf(prepared.shape_frame_t.y, w.y, prepared.shape_frame_t.z * w.z));
    const float x3 = fmaf(prepared.shape_frame_n.x, w.x, fmaf(prepared.shape_frame_n.y, w.y, prepared.shape_frame_n.z * w.z));
    const float x4 = etendue_lesser(etendue_greater(prepared.shape_cone_one_minus_cos, 0.0f), 2.0f);
    const bool b5 = 1e-37f < x4;
    const float x6 = (0.5f < x3) ? fmaf(x1, x1, x2 * x2) / (1.0f + fabsf(x3)) : 1.0f - x3;
    const float x7 = x4 + fmaf(5.9604645e-7f, etendue_greater(sqrtf(x4 * (2.0f - x4)), x4 - 1.0f), 1.7763568e-13f);
    const float x8 = (x6 <= x7) ? (b5 ? 0.15915494f / (b5 ? x4 : 1.0f) : 0.0f) : 0.0f;
    const bool b9 = 0.0f < x8;
    const float x10 = etendue_greater(etendue_greater(0.0f, etendue_greater(etendue_greater(fabsf(prepared.surface_center.x), fabsf(prepared.surface_center.y)), fabsf(prepared.surface_center.z))), etendue_greater(etendue_greater(fabsf(prepared.surface_radius), 0.0f), 0.0f));
    const bool b11 = x10 < INFINITY;
    const float x12 = etendue_pow2_scale(x10);
    const float x13 = x12 * (b11 ? prepared.surface_center.x : 0.0f);
    const float x14 = x12 * (b11 ? prepared.surface_center.y : 0.0f);
    const float x15 = x12 * (b11 ? prepared.surface_center.z : 0.0f);
    const float x16 = x12 * (b11 ? prepared.surface_radius : 0.0f);
    const float x17 = x13 * x13;
    const float x18 = x14 * x14;
    const float x19 = x15 * x15;
    const float x20 = x16 * x16;
    const float x21 = x17 - x20;
    const float x22 = x21 - x17;
    const float x23 = x18 + x21;
    const float x24 = x23 - x21;
    const float x25 = x19 + x23;
    const float x26 = x25 - x23;
    const float x27 = x17 - (x21 - x22) + (-x20 - x22) + (x21 - (x23 - x24) + (x18 - x24));
    const float x28 = fmaf(x13, x13, -x17) - fmaf(x16, x16, -x20) + (fmaf(x14, x14, -x18) + fmaf(x15, x15, -x19));
    const float x29 = x25 + (x23 - (x25 - x26) + (x19 - x26) + x27 + x28);
    const float x30 = fmaf(w.x, x13, fmaf(w.y, x14, w.z * x15));
    const float x31 = fmaf(w.x, -x30, x13);
    const float x32 = fmaf(w.y, -x30, x14);
    const float x33 = fmaf(w.z, -x30, x15);
    const float x34 = sqrtf(etendue_greater(fmaf(x16, x16, -fmaf(x31, x31, fmaf(x32, x32, x33 * x33))), 0.0f));
    const float x35 = x34 + fabsf(x30);
    const bool b36 = 1e-37f < fabsf(x35);
    const float x37 = (!(0.0f <= x29) && (0.0f <= x30)) ? x35 : etendue_lesser(etendue_greater(b36 ? fabsf(x29) / (b36 ? x35 : 1.0f) : 0.0f, -1e37f), 1e37f);
    const float x38 = fmaf(w.x, x37, -x13);
    const float x39 = fmaf(w.y, x37, -x14);
    const float x40 = fmaf(w.z, x37, -x15);
    const float x41 = fmaf(x38, x38, fmaf(x39, x39, x40 * x40));
    const float x42 = (0.0f < x41) ? 1.0f / sqrtf(x41) : 0.0f;
    const float x43 = x38 * x42;
    const float x44 = x39 * x42;
    const float x45 = x40 * x42;
    const float x46 = (0.5f < x45) ? fmaf(x43, x43, x44 * x44) / (1.0f + fabsf(x45)) : 1.0f - x45;
    const float x47 = etendue_lesser(etendue_greater(x46 / 2.0f, 0.0f), 0.99999994f);
    const float x48 = 0.15915494f * etendue_angle(x44, x43);
    const float x49 = etendue_lesser(etendue_greater((x48 < 0.0f) ? 1.0f + x48 : x48, 0.0f), 0.99999994f);
    const float x50 = b9 ? etendue_lesser(x37 / x12, 3.4028235e38f) : 0.0f;
    const bool b51 = !(prepared.shape_power < 0.0f) && b9;
    const bool b52 = b51 && (1e-37f < x8);
    const float x53 = b52 ? 1.0f / (b52 ? x8 : 1.0f) : 0.0f;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = x50;
    result.pdf = x8;
    result.weight = x53;
    result.normal.x = x43;
    result.normal.y = x44;
    result.normal.z = x45;
    result.uv.x = x47;
    result.uv.y = x49;
    result.emits = b51;
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
    const bool b64 = 1e-37f < fabsf(x54);
    const float x65 = (x60 + (x62 + x63 + fmaf(x10, x31, fmaf(x11, x36, x12 * x41)))) / (b64 ? x54 : 1.0f);
    const float x66 = etendue_lesser(etendue_greater(b64 ? x65 : 0.0f, -1e37f), 1e37f);
    const float x67 = x54 / x19 / x20;
    const float x68 = x51 * x67;
    const float x69 = x52 * x67;
    const float x70 = x53 * x67;
    const float x71 = -(x12 * x14);
    const float x72 = fmaf(x11, x15, x71) - fmaf(x12, x14, x71);
    const float x73 = -(x10 * x15);
    const float x74 = fmaf(x12, x13, x73) - fmaf(x10, x15, x73);
    const float x75 = -(x11 * x13);
    const float x76 = fmaf(x10, x14, x75) - fmaf(x11, x13, x75);
    const float x77 = -(x12 * x17);
    const float x78 = fmaf(x11, x18, x77) - fmaf(x12, x17, x77);
    const float x79 = -(x10 * x18);
    const float x80 = fmaf(x12, x16, x79) - fmaf(x10, x18, x79);
    const float x81 = -(x11 * x16);
    const float x82 = fmaf(x10, x17, x81) - fmaf(x11, x16, x81);
    const float x83 = 1.0f / x9;
    const float x84 = light.e1.x + x1;
    const float x85 = light.e1.y + x2;
    const float x86 = light.e1.z + x3;
    const float x87 = light.e2.x + x1;
    const float x88 = light.e2.y + x2;
    const float x89 = light.e2.z + x3;
    const float x90 = etendue_greater(etendue_greater(x4, etendue_greater(etendue_greater(fabsf(x84), fabsf(x85)), fabsf(x86))), etendue_greater(etendue_greater(fabsf(x87), fabsf(x88)), fabsf(x89)));
    const float x91 = etendue_greater(etendue_greater(x90, x5), x6);
    const bool b92 = x91 < INFINITY;
    const float x93 = etendue_pow2_scale(x91);
    const float x94 = x93 * (b92 ? x1 : 0.0f);
    const float x95 = x93 * (b92 ? x2 : 0.0f);
    const float x96 = x93 * (b92 ? x3 : 0.0f);
    const float x97 = x93 * (b92 ? x84 : 0.0f);
    const float x98 = x93 * (b92 ? x85 : 0.0f);
    const float x99 = x93 * (b92 ? x86 : 0.0f);
    const float x100 = x93 * (b92 ? x87 : 0.0f);
    const float x101 = x93 * (b92 ? x88 : 0.0f);
    const float x102 = x93 * (b92 ? x89 : 0.0f);
    const float x103 = x93 * (b92 ? light.e1.x : 0.0f);
    const float x104 = x93 * (b92 ? light.e1.y : 0.0f);
    const float x105 = x93 * (b92 ? light.e1.z : 0.0f);
    const float x106 = x93 * (b92 ? light.e2.x : 0.0f);
    const float x107 = x93 * (b92 ? light.e2.y : 0.0f);
    const float x108 = x93 * (b92 ? light.e2.z : 0.0f);
    const float x109 = x104 * x108;
    const float x110 = x105 * x107;
    const float x111 = x109 - x110;
    const float x112 = x111 - x109;
    const float x113 = x109 - (x111 - x112) + (-x110 - x112) + (fmaf(x104, x108, -x109) - fmaf(x105, x107, -x110));
    const float x114 = x105 * x106;
    const float x115 = x103 * x108;
    const float x116 = x114 - x115;
    const float x117 = x116 - x114;
    const float x118 = x114 - (x116 - x117) + (-x115 - x117) + (fmaf(x105, x106, -x114) - fmaf(x103, x108, -x115));
    const float x119 = x103 * x107;
    const float x120 = x104 * x106;
    const float x121 = x119 - x120;
    const float x122 = x121 - x119;
    const float x123 = x119 - (x121 - x122) + (-x120 - x122) + (fmaf(x103, x107, -x119) - fmaf(x104, x106, -x120));
    const float x124 = x111 + x113;
    const float x125 = x116 + x118;
    const float x126 = x121 + x123;
    const float x127 = x94 * x111;
    const float x128 = x95 * x116;
    const float x129 = x96 * x121;
    const float x130 = x127 + x128;
    const float x131 = x130 - x127;
    const float x132 = x129 + x130;
    const float x133 = x132 - x130;
    const float x134 = x127 - (x130 - x131) + (x128 - x131) + (x130 - (x132 - x133) + (x129 - x133));
    const float x135 = fmaf(x94, x111, -x127) + (fmaf(x95, x116, -x128) + fmaf(x96, x121, -x129));
    const float x136 = x132 + (x134 + x135 + fmaf(x94, x113, fmaf(x95, x118, x96 * x123)));
    const float x137 = x95 * x108;
    const float x138 = x96 * x107;
    const float x139 = x137 - x138;
    const float x140 = x139 - x137;
    const float x141 = fmaf(x96, x107, -x138);
    const float x142 = x137 - (x139 - x140) + (-x138 - x140) + (fmaf(x95, x108, -x137) - x141);
    const float x143 = x96 * x106;
    const float x144 = x94 * x108;
    const float x145 = x143 - x144;
    const float x146 = x145 - x143;
    const float x147 = fmaf(x94, x108, -x144);
    const float x148 = x143 - (x145 - x146) + (-x144 - x146) + (fmaf(x96, x106, -x143) - x147);
    const float x149 = x94 * x107;
    const float x150 = x95 * x106;
    const float x151 = x149 - x150;
    const float x152 = x151 - x149;
    const float x153 = fmaf(x95, x106, -x150);
    const float x154 = x149 - (x151 - x152) + (-x150 - x152) + (fmaf(x94, x107, -x149) - x153);
    const float x155 = x96 * x104;
    const float x156 = x95 * x105;
    const float x157 = x155 - x156;
    const float x158 = x157 - x155;
    const float x159 = fmaf(x96, x104, -x155);
    const float x160 = x155 - (x157 - x158) + (-x156 - x158) + (x159 - fmaf(x95, x105, -x156));
    const float x161 = x94 * x105;
    const float x162 = x96 * x103;
    const float x163 = x161 - x162;
    const float x164 = x163 - x161;
    const float x165 = fmaf(x94, x105, -x161);
    const float x166 = x161 - (x163 - x164) + (-x162 - x164) + (x165 - fmaf(x96, x103, -x162));
    const float x167 = x95 * x103;
    const float x168 = x94 * x104;
    const float x169 = x167 - x168;
    const float x170 = x169 - x167;
    const float x171 = fmaf(x95, x103, -x167);
    const float x172 = x167 - (x169 - x170) + (-x168 - x170) + (x171 - fmaf(x94, x104, -x168));
    const float x173 = x139 + x157;
    const float x174 = x173 - x139;
    const float x175 = x145 + x163;
    const float x176 = x175 - x145;
    const float x177 = x151 + x169;
    const float x178 = x177 - x151;
    const float x179 = x111 + x173;
    const float x180 = x179 - x111;
    const float x181 = x116 + x175;
    const float x182 = x181 - x116;
    const float x183 = x121 + x177;
    const float x184 = x183 - x121;
    const float x185 = x113 + (x139 - (x173 - x174) + (x157 - x174) + (x142 + x160));
    const float x186 = x118 + (x145 - (x175 - x176) + (x163 - x176) + (x148 + x166));
    const float x187 = x123 + (x151 - (x177 - x178) + (x169 - x178) + (x154 + x172));
    const float x188 = fmaf(x95, x105, -x155) - x159;
    const float x189 = fmaf(x96, x103, -x161) - x165;
    const float x190 = fmaf(x94, x104, -x167) - x171;
    const float x191 = fmaf(x95, x108, -x138) - x141;
    const float x192 = fmaf(x96, x106, -x144) - x147;
    const float x193 = fmaf(x94, x107, -x150) - x153;
    const float x194 = x179 + (x111 - (x179 - x180) + (x173 - x180) + x185);
    const float x195 = x181 + (x116 - (x181 - x182) + (x175 - x182) + x186);
    const float x196 = x183 + (x121 - (x183 - x184) + (x177 - x184) + x187);
    const float x197 = fmaf(x94, x94, fmaf(x95, x95, x96 * x96));
    const float x198 = fmaf(x97, x97, fmaf(x98, x98, x99 * x99));
    const float x199 = fmaf(x100, x100, fmaf(x101, x101, x102 * x102));
    const float x200 = (1e-36f < x197) ? 1.0f / sqrtf(x197) : 0.0f;
    const float x201 = (1e-36f < x198) ? 1.0f / sqrtf(x198) : 0.0f;
    const float x202 = (1e-36f < x199) ? 1.0f / sqrtf(x199) : 0.0f;
    const float x203 = fmaf(x94, x97, fmaf(x95, x98, x96 * x99));
    const float x204 = x201 * (x200 * x203);
    const float x205 = fmaf(x94, x100, fmaf(x95, x101, x96 * x102));
    const float x206 = x202 * (x200 * x205);
    const float x207 = fmaf(x188, x188, fmaf(x189, x189, x190 * x190));
    const float x208 = sqrtf(x207);
    const float x209 = (1e-37f < x207) ? 1.0f / x208 : 0.0f;
    const float x210 = x197 * x200;
    const float x211 = x198 * x201;
    const float x212 = x201 * (x200 * (x207 * x209));
    const float x213 = x211 * (x209 * x210);
    const float x214 = x213 * 2.0f;
    const float x215 = x212 * x212 / (1.0f + fabsf(x204));
    const bool b216 = x204 < 0.0f;
    const float x217 = b216 ? x215 : 1.0f + x204;
    const float x218 = x213 * (b216 ? 1.0f - x204 : x215);
    const float x219 = fabsf(x136);
    const float x220 = x202 * (x201 * (x200 * x219));
    const float x221 = x97 * x201;
    const float x222 = x98 * x201;
    const float x223 = x99 * x201;
    const float x224 = x94 * x200;
    const float x225 = x95 * x200;
    const float x226 = x96 * x200;
    const float x227 = x221 + x224;
    const float x228 = x222 + x225;
    const float x229 = x223 + x226;
    const bool b230 = x136 < 0.0f;
    const float x231 = x188 * x209;
    const float x232 = x189 * x209;
    const float x233 = x190 * x209;
    const float x234 = -(x223 * x232);
    const float x235 = fmaf(x222, x233, x234) - fmaf(x223, x232, x234);
    const float x236 = -(x221 * x233);
    const float x237 = fmaf(x223, x231, x236) - fmaf(x221, x233, x236);
    const float x238 = -(x222 * x231);
    const float x239 = fmaf(x221, x232, x238) - fmaf(x222, x231, x238);
    const float x240 = x202 * fmaf(x100, x221, fmaf(x101, x222, x102 * x223));
    const float x241 = x202 * fmaf(x106 - x103, x235, fmaf(x107 - x104, x237, (x108 - x105) * x239));
    const float x242 = x202 * (x209 * x219);
    const float x243 = fmaf(x191, x191, fmaf(x192, x192, x193 * x193));
    const float x244 = x200 * x202;
    const float x245 = x244 * (x243 * x244);
    const bool b246 = etendue_lesser(etendue_lesser(x204, x206), x240) < -0.5f;
    const float x247 = fmaf(x97, x100, fmaf(x98, x101, x99 * x102));
    const float x248 = fmaf(x194, x194, fmaf(x195, x195, x196 * x196));
    const float x249 = b230 ? -x231 : x231;
    const float x250 = b230 ? -x232 : x232;
    const float x251 = b230 ? -x233 : x233;
    const float x252 = x210 * x219;
    const bool b253 = 1e-37f < x252;
    const float x254 = b253 ? fmaf(x188, x191, fmaf(x189, x192, x190 * x193)) / (b253 ? x252 : 1.0f) : 0.0f;
    const bool b255 = (0.0f < x200) && (0.0f < x201) && (0.0f < x202) && (0.0f < x220);
    const float x256 = 1.0f / ((1e-37f < x220) ? x220 : 1.0f);
    const float x257 = etendue_lesser(etendue_greater(-x204 / ((0.0f < x212) ? x212 : 1.0f), 1.0f), 1e18f);
    const float x258 = b230 ? -x188 : x188;
    const float x259 = b230 ? -x189 : x189;
    const float x260 = b230 ? -x190 : x190;
    const float x261 = b230 ? -x194 : x194;
    const float x262 = b230 ? -x195 : x195;
    const float x263 = b230 ? -x196 : x196;
    const float x264 = b230 ? x191 : -x191;
    const float x265 = b230 ? x192 : -x192;
    const float x266 = b230 ? x193 : -x193;
    const float x267 = etendue_greater(x208 * x257, -x203) * 7.1525574e-7f;
    const float x268 = etendue_greater(x257, -x206 * (1.0f / sqrtf(etendue_greater(x245, 1e-7f)))) * sqrtf(x248);
    const float x269 = 7.1525574e-7f * etendue_greater(x268, -x247);
    const float x270 = 7.1525574e-7f * etendue_greater(x257 * sqrtf(x243), -x205);
    const float x271 = etendue_greater(etendue_greater(x210, x211), x199 * x202);
    const float x272 = x217 * x256;
    const float x273 = etendue_pow2_scale(x93);
    float x274 = fmaf(x202, fmaf(x100, x227, fmaf(x101, x228, x102 * x229)), x217);
    float x275 = x241;
    bool b276 = false;
    bool b277 = false;
    float x278 = 0.0f;
    if (b246) {
        const float x279 = x97 - x94;
        const float x280 = x98 - x95;
        const float x281 = x99 - x96;
        const float x282 = fmaf(x279, x279, fmaf(x280, x280, x281 * x281));
        const bool b283 = 1e-36f < x282;
        const float x284 = 1.0f / sqrtf(b283 ? x282 : 1.0f);
        const float x285 = x284 * x284;
        const float x286 = -(x189 * x281);
        const float x287 = -(x190 * x279);
        const float x288 = -(x188 * x280);
        const float x289 = x207 * x285;
        const float x290 = x279 * x284;
        const float x291 = x280 * x284;
        const float x292 = x281 * x284;
        const float x293 = x200 + x201;
        const float x294 = x200 * (x200 * x289) / (1.0f + x200 * fabsf(fmaf(x94, x290, fmaf(x95, x291, x96 * x292))));
        const float x295 = x201 * (x201 * x289) / (1.0f + x201 * fabsf(fmaf(x97, x290, fmaf(x98, x291, x99 * x292))));
        const float x296 = x294 - x295;
        const bool b297 = (x203 < 0.0f) && b283;
        const float x298 = b297 ? fmaf(x285 * (fmaf(x190, x280, x286) - fmaf(x189, x281, x286)), x293, x290 * x296) : x227;
        const float x299 = b297 ? fmaf(x285 * (fmaf(x188, x281, x287) - fmaf(x190, x279, x287)), x293, x291 * x296) : x228;
        const float x300 = b297 ? fmaf(x285 * (fmaf(x189, x279, x288) - fmaf(x188, x280, x288)), x293, x292 * x296) : x229;
        const float x301 = x100 * x202;
        const float x302 = x101 * x202;
        const float x303 = x102 * x202;
        const float x304 = x100 - x94;
        const float x305 = x101 - x95;
        const float x306 = x102 - x96;
        const float x307 = fmaf(x304, x304, fmaf(x305, x305, x306 * x306));
        const bool b308 = 1e-36f < x307;
        const float x309 = 1.0f / sqrtf(b308 ? x307 : 1.0f);
        const float x310 = x309 * x309;
        const float x311 = -(x192 * x306);
        const float x312 = -(x193 * x304);
        const float x313 = -(x191 * x305);
        const float x314 = x243 * x310;
        const float x315 = x304 * x309;
        const float x316 = x305 * x309;
        const float x317 = x306 * x309;
        const float x318 = x200 + x202;
        const float x319 = x200 * (x200 * x314) / (1.0f + x200 * fabsf(fmaf(x94, x315, fmaf(x95, x316, x96 * x317))));
        const float x320 = x202 * (x202 * x314) / (1.0f + x202 * fabsf(fmaf(x100, x315, fmaf(x101, x316, x102 * x317))));
        const float x321 = x319 - x320;
        const bool b322 = (x205 < 0.0f) && b308;
        const float x323 = b322 ? fmaf(x310 * (fmaf(x193, x305, x311) - fmaf(x192, x306, x311)), x318, x315 * x321) : x224 + x301;
        const float x324 = b322 ? fmaf(x310 * (fmaf(x191, x306, x312) - fmaf(x193, x304, x312)), x318, x316 * x321) : x225 + x302;
        const float x325 = b322 ? fmaf(x310 * (fmaf(x192, x304, x313) - fmaf(x191, x305, x313)), x318, x317 * x321) : x226 + x303;
        const float x326 = x100 - x97;
        const float x327 = x101 - x98;
        const float x328 = x102 - x99;
        const float x329 = fmaf(x326, x326, fmaf(x327, x327, x328 * x328));
        const bool b330 = 1e-36f < x329;
        const float x331 = 1.0f / sqrtf(b330 ? x329 : 1.0f);
        const float x332 = x331 * x331;
        const float x333 = -(x195 * x328);
        const float x334 = -(x196 * x326);
        const float x335 = -(x194 * x327);
        const float x336 = x332 * x248;
        const float x337 = x326 * x331;
        const float x338 = x327 * x331;
        const float x339 = x328 * x331;
        const float x340 = x201 + x202;
        const float x341 = x201 * (x201 * x336) / (1.0f + x201 * fabsf(fmaf(x97, x337, fmaf(x98, x338, x99 * x339))));
        const float x342 = x202 * (x202 * x336) / (1.0f + x202 * fabsf(fmaf(x100, x337, fmaf(x101, x338, x102 * x339))));
        const float x343 = x341 - x342;
        const bool b344 = (x247 < 0.0f) && b330;
        const float x345 = b344 ? fmaf(x332 * (fmaf(x196, x327, x333) - fmaf(x195, x328, x333)), x340, x337 * x343) : x221 + x301;
        const float x346 = b344 ? fmaf(x332 * (fmaf(x194, x328, x334) - fmaf(x196, x326, x334)), x340, x338 * x343) : x222 + x302;
        const float x347 = b344 ? fmaf(x332 * (fmaf(x195, x326, x335) - fmaf(x194, x327, x335)), x340, x339 * x343) : x223 + x303;
        const float x348 = (x240 < x206) ? fmaf(x298, x345, fmaf(x299, x346, x300 * x347)) : fmaf(x298, x323, fmaf(x299, x324, x300 * x325));
        x274 = (etendue_greater(x206, x240) < x204) ? fmaf(x323, x345, fmaf(x324, x346, x325 * x347)) : x348;
        x275 = -(x202 * (x201 * (x209 * fmaf(x188, x194, fmaf(x189, x195, x190 * x196)))));
        b276 = x240 < 0.0f;
        b277 = x206 < 0.0f;
        x278 = x245 / (1.0f + fabsf(x206));
    }
    const float x349 = (b246 && b277) ? x278 : 1.0f + x206;
    const float x350 = b255 ? 2.0f * etendue_angle(x220, x274) : 0.0f;
    const float x351 = etendue_greater(fmaf(x220, x220, x274 * x274), 1e-36f);
    const float x352 = 1.0f / sqrtf(x351);
    const float x353 = x220 * x352;
    const float x354 = x274 * x352;
    const float x355 = x352 * (x256 * x351);
    const float x356 = x355 * (x212 * 0.5f);
    const bool b357 = x356 < 1e30f;
    const float x358 = x274 * x256;
    const float x359 = x274 - x217;
    float x360 = 0.0f;
    if (b246) {
        x360 = fmaf(x275, x275, x242 * x242) / (1.0f + fabsf(x240));
    }
    const float x361 = 1.0f / etendue_greater((b246 && b276) ? x360 : 1.0f + x240, 1e-30f);
    const float x362 = b357 ? etendue_lesser(x356 * (x242 * x361), 1e18f) : 0.0f;
    const float x363 = b357 ? etendue_lesser(etendue_greater(x356 * fmaf(x275, -x361, x218), -1e18f), 1e18f) : 0.0f;
    EtendueTriangleBySolidAngle result;
    result.surface_plane_cross.x = x68;
    result.surface_plane_cross.y = x69;
    result.surface_plane_cross.z = x70;
    result.surface_plane_normal.x = x51;
    result.surface_plane_normal.y = x52;
    result.surface_plane_normal.z = x53;
    result.surface_plane_height = x66;
    result.surface_plane_along_first.x = x72;
    result.surface_plane_along_first.y = x74;
    result.surface_plane_along_first.z = x76;
    result.surface_plane_along_second.x = x78;
    result.surface_plane_along_second.y = x80;
    result.surface_plane_along_second.z = x82;
    result.surface_plane_unit = x83;
    result.shape_side01.x = x258;
    result.shape_side01.y = x259;
    result.shape_side01.z = x260;
    result.shape_side12.x = x261;
    result.shape_side12.y = x262;
    result.shape_side12.z = x263;
    result.shape_side20.x = x264;
    result.shape_side20.y = x265;
    result.shape_side20.z = x266;
    result.shape_slack.x = x267;
    result.shape_slack.y = x269;
    result.shape_slack.z = x270;
    result.shape_normal.x = x124;
    result.shape_normal.y = x125;
    result.shape_normal.z = x126;
    result.shape_l1 = x211;
    result.shape_farthest = x271;
    result.shape_apex.x = x221;
    result.shape_apex.y = x222;
    result.shape_apex.z = x223;
    result.shape_along.x = x235;
    result.shape_along.y = x237;
    result.shape_along.z = x239;
    result.shape_across.x = x249;
    result.shape_across.y = x250;
    result.shape_across.z = x251;
    result.shape_cot_alpha = x254;
    result.shape_stretch = x214;
    result.shape_tan_half = x218;
    result.shape_half.x = x353;
    result.shape_half.y = x354;
    result.shape_turned.x = x362;
    result.shape_turned.y = x363;
    result.shape_sin_side = x212;
    result.shape_inv_l0 = x200;
    result.shape_inv_l2 = x202;
    result.shape_cot_half = x358;
    result.shape_inv_half_sin = x355;
    result.shape_g2 = x217;
    result.shape_g2_over_g0 = x272;
    result.shape_one_plus_d02 = x349;
    result.shape_sin02_squared = x245;
    result.shape_x2 = x275;
    result.shape_y2 = x242;
    result.shape_g1 = x359;
    result.shape_volume = x136;
    result.shape_solid_angle = x350;
    result.shape_unit = x273;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
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
    const bool b21 = 1e-37f < fabsf(prepared.shape_solid_angle);
    const float x22 = etendue_lesser(etendue_greater(b21 ? 1.0f / (b21 ? prepared.shape_solid_angle : 1.0f) : 0.0f, -1e37f), 1e37f);
    const bool b23 = prepared.shape_volume < 0.0f;
    const bool b24 = b23 && (1e-37f < x22);
    const float x25 = b24 ? 1.0f / (b24 ? x22 : 1.0f) : 0.0f;
    bool b26 = false;
    float x27 = 0.0f;
    float x28 = 0.0f;
    if (b11) {
        const float x29 = fmaf(x19, prepared.shape_one_plus_d02 - 1.0f, x18);
        const float x30 = (0.0f < x29) ? prepared.shape_sin02_squared * (x19 * x19) / (1.0f + etendue_greater(x29, 0.0f)) : 1.0f - x29;
        const float x31 = fmaf(prepared.shape_g2, x18, x30 + prepared.shape_g1 * x19);
        const float x32 = 1.0f / etendue_greater(x31, 1e-30f);
        const float x33 = x32 * (prepared.shape_sin_side * x18);
        const float x34 = x32 * (prepared.shape_x2 * x19);
        const bool b35 = (fmaf(prepared.shape_g2, x18, x30 + x19 * fabsf(prepared.shape_g1)) * 0.125f < x31) && (0.5f < x18 + x19);
        b26 = b35 && (x33 + fabsf(x34) < etendue_greater(prepared.shape_tan_half, fabsf(x8)));
        x27 = etendue_lesser(etendue_greater(x33 + x34, -1000000000000000.0f), 1000000000000000.0f);
        x28 = etendue_lesser(x32 * (prepared.shape_y2 * x19), 1000000000000000.0f);
    }
    const float x36 = b26 ? x27 : x8;
    const float x37 = b26 ? x28 : x9;
    const float x38 = fmaf(x36, x36, x37 * x37);
    const float x39 = 1.0f + x38;
    const float x40 = 2.0f / x39;
    const float x41 = u.y * x40;
    const float x42 = fmaf(x38, -x41, 1.0f);
    const float x43 = sqrtf(etendue_greater(x41 * (x40 * fmaf(x38, x20, 1.0f)), 0.0f));
    const float x44 = fmaf(prepared.shape_apex.x, x42, x43 * fmaf(prepared.shape_along.x, x36, prepared.shape_across.x * x37));
    const float x45 = fmaf(prepared.shape_apex.y, x42, x43 * fmaf(prepared.shape_along.y, x36, prepared.shape_across.y * x37));
    const float x46 = fmaf(prepared.shape_apex.z, x42, x43 * fmaf(prepared.shape_along.z, x36, prepared.shape_across.z * x37));
    const float x47 = fmaf(fmaf(x44, x44, fmaf(x45, x45, x46 * x46)), -0.5f, 1.5f);
    const float x48 = x44 * x47;
    const float x49 = x45 * x47;
    const float x50 = x46 * x47;
    const float x51 = x39 * (0.5f * x43);
    const bool b52 = 1.0f < x38;
    const float x53 = fabsf(1.0f - x38) / x39;
    const float x54 = (1.0f + x53) * fmaf(x51, x53, x42);
    const float x55 = fmaf(x51, prepared.shape_l1 * fmaf(prepared.shape_inv_l0, x18, prepared.shape_inv_l2 * x19), x20 * (x42 + x53) / ((0.0f < x54) ? x54 : 1.0f));
    const float x56 = b52 ? fabsf(fmaf(prepared.shape_normal.x, x48, fmaf(prepared.shape_normal.y, x49, prepared.shape_normal.z * x50))) : x55;
    const bool b57 = (0.0f < x56) && (0.0f < prepared.shape_solid_angle);
    const float x58 = etendue_lesser(prepared.shape_unit * etendue_lesser((b52 ? fabsf(prepared.shape_volume) : prepared.shape_l1) / (b57 ? x56 : 1.0f), prepared.shape_farthest), 3.4028235e38f);
    const float x59 = b57 ? x58 : 0.0f;
    const float x60 = fmaf(prepared.surface_plane_cross.x, x48, fmaf(prepared.surface_plane_cross.y, x49, prepared.surface_plane_cross.z * x50));
    const bool b61 = 1e-37f < fabsf(x60);
    const float x62 = b61 ? x60 : 1.0f;
    const float x63 = etendue_greater(b61 ? -fmaf(prepared.surface_plane_along_second.x, x48, fmaf(prepared.surface_plane_along_second.y, x49, prepared.surface_plane_along_second.z * x50)) / x62 : 0.0f, -1e37f);
    const float x64 = etendue_lesser(etendue_greater(b61 ? fmaf(prepared.surface_plane_along_first.x, x48, fmaf(prepared.surface_plane_along_first.y, x49, prepared.surface_plane_along_first.z * x50)) / x62 : 0.0f, -1e37f), 1e37f);
    const float x65 = etendue_lesser(etendue_greater(etendue_lesser(x63, 1e37f), 0.0f), 1.0f);
    const float x66 = etendue_lesser(etendue_greater(x64, 0.0f), 1.0f);
    EtendueLightSample result;
    result.direction.x = x48;
    result.direction.y = x49;
    result.direction.z = x50;
    result.distance = x59;
    result.pdf = x22;
    result.weight = x25;
    result.normal.x = prepared.surface_plane_normal.x;
    result.normal.y = prepared.surface_plane_normal.y;
    result.normal.z = prepared.surface_plane_normal.z;
    result.uv.x = x65;
    result.uv.y = x66;
    result.emits = b23;
    result.delta = false;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the solid angle
// Omega at the point p: pdf 1/Omega per steradian.
ETENDUE_FUNCTION float etendue_triangle_by_solid_angle_pdf(EtendueTriangleBySolidAngle prepared, EtendueVec3 w) {
    const bool b1 = 1e-37f < fabsf(prepared.shape_solid_angle);
    const bool b2 = (-prepared.shape_slack.y <= fmaf(prepared.shape_side12.x, w.x, fmaf(prepared.shape_side12.y, w.y, prepared.shape_side12.z * w.z))) && (-prepared.shape_slack.z <= fmaf(prepared.shape_side20.x, w.x, fmaf(prepared.shape_side20.y, w.y, prepared.shape_side20.z * w.z)));
    const float x3 = fmaf(prepared.shape_normal.x, w.x, fmaf(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z));
    const bool b4 = -(sqrtf(fmaf(prepared.shape_normal.x, prepared.shape_normal.x, fmaf(prepared.shape_normal.y, prepared.shape_normal.y, prepared.shape_normal.z * prepared.shape_normal.z))) * 7.1525574e-7f) <= ((prepared.shape_volume < 0.0f) ? -x3 : x3);
    const bool b5 = b2 && (-prepared.shape_slack.x <= fmaf(prepared.shape_side01.x, w.x, fmaf(prepared.shape_side01.y, w.y, prepared.shape_side01.z * w.z))) && b4;
    const float x6 = b5 ? etendue_lesser(etendue_greater(b1 ? 1.0f / (b1 ? prepared.shape_solid_angle : 1.0f) : 0.0f, -1e37f), 1e37f) : 0.0f;
    return x6;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian.
ETENDUE_FUNCTION EtendueLightSample etendue_triangle_by_solid_angle_hit(EtendueTriangleBySolidAngle prepared, EtendueVec3 w) {
    const bool b1 = 1e-37f < fabsf(prepared.shape_solid_angle);
    const bool b2 = (-prepared.shape_slack.y <= fmaf(prepared.shape_side12.x, w.x, fmaf(prepared.shape_side12.y, w.y, prepared.shape_side12.z * w.z))) && (-prepared.shape_slack.z <= fmaf(prepared.shape_side20.x, w.x, fmaf(prepared.shape_side20.y, w.y, prepared.shape_side20.z * w.z)));
    const float x3 = fmaf(prepared.shape_normal.x, w.x, fmaf(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z));
    const bool b4 = prepared.shape_volume < 0.0f;
    const bool b5 = -(sqrtf(fmaf(prepared.shape_normal.x, prepared.shape_normal.x, fmaf(prepared.shape_normal.y, prepared.shape_normal.y, prepared.shape_normal.z * prepared.shape_normal.z))) * 7.1525574e-7f) <= (b4 ? -x3 : x3);
    const bool b6 = b2 && (-prepared.shape_slack.x <= fmaf(prepared.shape_side01.x, w.x, fmaf(prepared.shape_side01.y, w.y, prepared.shape_side01.z * w.z))) && b5;
    const float x7 = b6 ? etendue_lesser(etendue_greater(b1 ? 1.0f / (b1 ? prepared.shape_solid_angle : 1.0f) : 0.0f, -1e37f), 1e37f) : 0.0f;
    const bool b8 = 0.0f < x7;
    const float x9 = fmaf(prepared.surface_plane_cross.x, w.x, fmaf(prepared.surface_plane_cross.y, w.y, prepared.surface_plane_cross.z * w.z));
    const bool b10 = 1e-37f < fabsf(x9);
    const float x11 = b10 ? x9 : 1.0f;
    const float x12 = etendue_greater(b10 ? -fmaf(prepared.surface_plane_along_second.x, w.x, fmaf(prepared.surface_plane_along_second.y, w.y, prepared.surface_plane_along_second.z * w.z)) / x11 : 0.0f, -1e37f);
    const float x13 = etendue_lesser(etendue_greater(b10 ? fmaf(prepared.surface_plane_along_first.x, w.x, fmaf(prepared.surface_plane_along_first.y, w.y, prepared.surface_plane_along_first.z * w.z)) / x11 : 0.0f, -1e37f), 1e37f);
    const float x14 = etendue_lesser(etendue_greater(etendue_lesser(x12, 1e37f), 0.0f), 1.0f);
    const float x15 = etendue_lesser(etendue_greater(x13, 0.0f), 1.0f);
    const float x16 = fmaf(prepared.surface_plane_normal.x, w.x, fmaf(prepared.surface_plane_normal.y, w.y, prepared.surface_plane_normal.z * w.z));
    const bool b17 = 1e-37f < fabsf(x16);
    const float x18 = prepared.surface_plane_unit * etendue_greater(etendue_lesser(etendue_greater(b17 ? prepared.surface_plane_height / (b17 ? x16 : 1.0f) : 0.0f, -1e37f), 1e37f), 0.0f);
    const float x19 = b8 ? etendue_lesser(x18, 3.4028235e38f) : 0.0f;
    const bool b20 = b4 && b8;
    const bool b21 = b20 && (1e-37f < x7);
    const float x22 = b21 ? 1.0f / (b21 ? x7 : 1.0f) : 0.0f;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = x19;
    result.pdf = x7;
    result.weight = x22;
    result.normal.x = prepared.surface_plane_normal.x;
    result.normal.y = prepared.surface_plane_normal.y;
    result.normal.z = prepared.surface_plane_normal.z;
    result.uv.x = x14;
    result.uv.y = x15;
    result.emits = b20;
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
    const bool b67 = 0.0f < x66;
    const float x68 = x10 * x41;
    const float x69 = x11 * x46;
    const float x70 = x12 * x51;
    const float x71 = x68 + x69;
    const float x72 = x71 - x68;
    const float x73 = x70 + x71;
    const float x74 = x73 - x71;
    const float x75 = x68 - (x71 - x72) + (x69 - x72) + (x71 - (x73 - x74) + (x70 - x74));
    const float x76 = fmaf(x10, x41, -x68) + (fmaf(x11, x46, -x69) + fmaf(x12, x51, -x70));
    const float x77 = (x73 + (x75 + x76 + fmaf(x10, x43, fmaf(x11, x48, x12 * x53)))) / (b67 ? x66 : 1.0f);
    const float x78 = b67 ? x77 : 0.0f;
    const float x79 = x10 + x13;
    const float x80 = x11 + x14;
    const float x81 = x12 + x15;
    const float x82 = x16 + x79;
    const float x83 = x17 + x80;
    const float x84 = x18 + x81;
    const float x85 = x10 + x16;
    const float x86 = x11 + x17;
    const float x87 = x12 + x18;
    const float x88 = fabsf(x78);
    const float x89 = etendue_copysign(1.0f, x78);
    const float x90 = x10 * x20;
    const float x91 = x11 * x21;
    const float x92 = x12 * x22;
    const float x93 = x90 + x91;
    const float x94 = x93 - x90;
    const float x95 = x92 + x93;
    const float x96 = x95 - x93;
    const float x97 = x90 - (x93 - x94) + (x91 - x94) + (x93 - (x95 - x96) + (x92 - x96));
    const float x98 = fmaf(x10, x20, -x90) + (fmaf(x11, x21, -x91) + fmaf(x12, x22, -x92));
    const float x99 = x97 + x98;
    const float x100 = x13 * x20;
    const float x101 = x14 * x21;
    const float x102 = x15 * x22;
    const float x103 = x100 + x101;
    const float x104 = x103 - x100;
    const float x105 = x102 + x103;
    const float x106 = x105 - x103;
    const float x107 = x100 - (x103 - x104) + (x101 - x104) + (x103 - (x105 - x106) + (x102 - x106));
    const float x108 = fmaf(x13, x20, -x100) + (fmaf(x14, x21, -x101) + fmaf(x15, x22, -x102));
    const float x109 = x24 * (x95 + x99);
    const float x110 = x95 + x105;
    const float x111 = x110 - x95;
    const float x112 = x95 - (x110 - x111) + (x105 - x111) + (x99 + (x107 + x108));
    const float x113 = x24 * (x110 + x112);
    const bool b114 = x109 + x113 < 0.0f;
    const float x115 = etendue_greater(b114 ? -x113 : x109, x28 * -0.5f);
    const float x116 = x28 + x115;
    const float x117 = x10 * x30;
    const float x118 = x11 * x31;
    const float x119 = x12 * x32;
    const float x120 = x117 + x118;
    const float x121 = x120 - x117;
    const float x122 = x119 + x120;
    const float x123 = x122 - x120;
    const float x124 = x117 - (x120 - x121) + (x118 - x121) + (x120 - (x122 - x123) + (x119 - x123));
    const float x125 = fmaf(x10, x30, -x117) + (fmaf(x11, x31, -x118) + fmaf(x12, x32, -x119));
    const float x126 = x124 + x125;
    const float x127 = x16 * x30;
    const float x128 = x17 * x31;
    const float x129 = x18 * x32;
    const float x130 = x127 + x128;
    const float x131 = x130 - x127;
    const float x132 = x129 + x130;
    const float x133 = x132 - x130;
    const float x134 = x127 - (x130 - x131) + (x128 - x131) + (x130 - (x132 - x133) + (x129 - x133));
    const float x135 = fmaf(x16, x30, -x127) + (fmaf(x17, x31, -x128) + fmaf(x18, x32, -x129));
    const float x136 = x34 * (x122 + x126);
    const float x137 = x122 + x132;
    const float x138 = x137 - x122;
    const float x139 = x122 - (x137 - x138) + (x132 - x138) + (x126 + (x134 + x135));
    const float x140 = x34 * (x137 + x139);
    const bool b141 = x136 + x140 < 0.0f;
    const float x142 = etendue_greater(b141 ? -x140 : x136, x38 * -0.5f);
    const float x143 = x38 + x142;
    const float x144 = b114 ? -x25 : x25;
    const float x145 = b114 ? -x26 : x26;
    const float x146 = b114 ? -x27 : x27;
    const float x147 = b141 ? -x35 : x35;
    const float x148 = b141 ? -x36 : x36;
    const float x149 = b141 ? -x37 : x37;
    const bool b150 = x116 <= x115 + x115;
    const bool b151 = x143 <= x142 + x142;
    const float x152 = b150 ? x116 : 0.0f;
    const float x153 = b151 ? x143 : 0.0f;
    const float x154 = x116 - x152;
    const float x155 = x143 - x153;
    const float x156 = (b114 ? (b141 ? x10 : x85) : (b141 ? x79 : x82)) - x144 * x154 - x147 * x155;
    const float x157 = (b114 ? (b141 ? x11 : x86) : (b141 ? x80 : x83)) - x145 * x154 - x148 * x155;
    const float x158 = (b114 ? (b141 ? x12 : x87) : (b141 ? x81 : x84)) - x146 * x154 - x149 * x155;
    const bool b159 = etendue_greater(x154, x155) <= etendue_greater(etendue_greater(x152, x153), x88);
    const float x160 = b159 ? x156 : fmaf(x144, x152, fmaf(x147, x153, x63 * x78));
    const float x161 = b159 ? x157 : fmaf(x145, x152, fmaf(x148, x153, x64 * x78));
    const float x162 = b159 ? x158 : fmaf(x146, x152, fmaf(x149, x153, x65 * x78));
    const float x163 = x88 * x88;
    const float x164 = x142 * x143;
    const float x165 = sqrtf(fmaf(x142, x142, x163) * fmaf(x143, x143, x163));
    const bool b166 = 0.0f < x165;
    const float x167 = b166 ? 1.0f / (b166 ? x165 : 1.0f) : 0.0f;
    const bool b168 = x142 < 0.0f;
    const float x169 = x116 * x116;
    const float x170 = x163 + x169;
    const float x171 = sqrtf(fmaf(x142, x142, x170));
    const float x172 = fmaf(x143, x143, x170);
    const float x173 = sqrtf(x172);
    const float x174 = x171 * x173;
    const bool b175 = 0.0f < x170;
    const float x176 = b175 ? 1.0f / (b175 ? x170 : 1.0f) : 0.0f;
    const float x177 = fabsf(x142);
    const float x178 = fmaf(x143, x171, x173 * x177);
    const float x179 = x38 * (x142 + x143);
    const bool b180 = 0.0f < x178;
    const float x181 = fabsf(x164);
    const float x182 = x174 + x181;
    const bool b183 = 0.0f < x182;
    const float x184 = (b168 ? x176 * x178 : (b180 ? x179 / (b180 ? x178 : 1.0f) : 0.0f)) * (x88 * x116);
    const float x185 = x167 * x184;
    const float x186 = x167 * (x176 * fmaf(x164, x169, x163 * x174));
    const float x187 = x167 * (x38 * (x38 * x163));
    const float x188 = 1.0f + (b183 ? fmaf(x142, x142, x172) / (b183 ? x182 : 1.0f) : 0.0f);
    const float x189 = x170 + x182;
    const float x190 = b168 ? x170 * x188 : x189;
    const bool b191 = 0.0f < x190;
    const float x192 = b191 ? x187 / (b191 ? x190 : 1.0f) : 0.0f;
    const float x193 = x163 * x167;
    const float x194 = x193 * (b168 ? x176 * x189 : x188);
    const bool b195 = x115 < 0.0f;
    const float x196 = -x115 * -x115;
    const float x197 = x163 + x196;
    const float x198 = sqrtf(fmaf(x142, x142, x197));
    const float x199 = fmaf(x143, x143, x197);
    const float x200 = sqrtf(x199);
    const float x201 = x198 * x200;
    const bool b202 = 0.0f < x197;
    const float x203 = b202 ? 1.0f / (b202 ? x197 : 1.0f) : 0.0f;
    const float x204 = fmaf(x143, x198, x177 * x200);
    const bool b205 = 0.0f < x204;
    const float x206 = x181 + x201;
    const bool b207 = 0.0f < x206;
    const float x208 = (b168 ? x203 * x204 : (b205 ? x179 / (b205 ? x204 : 1.0f) : 0.0f)) * (x88 * -x115);
    const float x209 = x167 * x208;
    const float x210 = x167 * (x203 * fmaf(x164, x196, x163 * x201));
    const float x211 = 1.0f + (b207 ? fmaf(x142, x142, x199) / (b207 ? x206 : 1.0f) : 0.0f);
    const float x212 = x197 + x206;
    const float x213 = b168 ? x197 * x211 : x212;
    const bool b214 = 0.0f < x213;
    const float x215 = b214 ? x187 / (b214 ? x213 : 1.0f) : 0.0f;
    const float x216 = x193 * (b168 ? x203 * x212 : x211);
    const bool b217 = b168 || b195;
    const bool b218 = b168 && !b195;
    const float x219 = b218 ? x142 : x115;
    const float x220 = b218 ? x115 : x142;
    const float x221 = b218 ? x143 : x116;
    const float x222 = b218 ? x116 : x143;
    const float x223 = fmaf(x219, x219, x163);
    const float x224 = fmaf(x221, x221, x163);
    const float x225 = sqrtf(fmaf(x220, x220, x223));
    const float x226 = sqrtf(fmaf(x222, x222, x223));
    const float x227 = sqrtf(fmaf(x220, x220, x224));
    const float x228 = sqrtf(fmaf(x222, x222, x224));
    const float x229 = x220 * x222;
    const bool b230 = 0.0f <= x220;
    const float x231 = fabsf(x220);
    const float x232 = fmaf(x222, x227, x228 * x231);
    const float x233 = (b218 ? x28 : x38) * (x220 + x222);
    const bool b234 = 0.0f < x232;
    const float x235 = (b230 ? (b234 ? x224 * x233 / (b234 ? x232 : 1.0f) : 0.0f) : x232) * (x88 * fabsf(x221));
    const float x236 = fmaf(x222, x225, x226 * x231);
    const bool b237 = 0.0f < x236;
    const float x238 = (b230 ? (b237 ? x223 * x233 / (b237 ? x236 : 1.0f) : 0.0f) : x236) * (x88 * fabsf(x219));
    const float x239 = x225 * x226;
    const float x240 = x38 * (x28 * x88);
    const float x241 = x219 * x221;
    const float x242 = x163 + (x229 + x241);
    const float x243 = fmaf(x228, x225 * x227, fmaf(x228, x241 + fmaf(x220, x220, x163), fmaf(x227, x242, x225 * (x224 + x229))));
    const float x244 = fmaf(x228, x239, fmaf(x225, x241 + fmaf(x222, x222, x163), fmaf(x226, x242, x228 * (x223 + x229))));
    const float x245 = etendue_angle(b217 ? x235 : x240, b217 ? fmaf(x229, x221 * x221, x163 * (x227 * x228)) : x243);
    const float x246 = x245 + etendue_angle(b217 ? x238 : x240, b217 ? fmaf(x229, x219 * x219, x163 * x239) : x244);
    const float x247 = x246 * (b217 ? 1.0f : 2.0f);
    const bool b248 = 0.0f < x185;
    const bool b249 = b8 && (1e-36f < x247) && (x247 < 7.0f) && b248 && (1e-18f < x88);
    const float x250 = x11 * x15;
    const float x251 = x12 * x14;
    const float x252 = x250 - x251;
    const float x253 = x252 - x250;
    const float x254 = x250 - (x252 - x253) + (-x251 - x253) + (fmaf(x11, x15, -x250) - fmaf(x12, x14, -x251));
    const float x255 = x12 * x13;
    const float x256 = x10 * x15;
    const float x257 = x255 - x256;
    const float x258 = x257 - x255;
    const float x259 = x255 - (x257 - x258) + (-x256 - x258) + (fmaf(x12, x13, -x255) - fmaf(x10, x15, -x256));
    const float x260 = x10 * x14;
    const float x261 = x11 * x13;
    const float x262 = x260 - x261;
    const float x263 = x262 - x260;
    const float x264 = x260 - (x262 - x263) + (-x261 - x263) + (fmaf(x10, x14, -x260) - fmaf(x11, x13, -x261));
    const float x265 = x11 * x18;
    const float x266 = x12 * x17;
    const float x267 = x265 - x266;
    const float x268 = x267 - x265;
    const float x269 = x265 - (x267 - x268) + (-x266 - x268) + (fmaf(x11, x18, -x265) - fmaf(x12, x17, -x266));
    const float x270 = x12 * x16;
    const float x271 = x10 * x18;
    const float x272 = x270 - x271;
    const float x273 = x272 - x270;
    const float x274 = x270 - (x272 - x273) + (-x271 - x273) + (fmaf(x12, x16, -x270) - fmaf(x10, x18, -x271));
    const float x275 = x10 * x17;
    const float x276 = x11 * x16;
    const float x277 = x275 - x276;
    const float x278 = x277 - x275;
    const float x279 = x275 - (x277 - x278) + (-x276 - x278) + (fmaf(x10, x17, -x275) - fmaf(x11, x16, -x276));
    const float x280 = x14 * x18;
    const float x281 = x15 * x17;
    const float x282 = x280 - x281;
    const float x283 = x282 - x280;
    const float x284 = x280 - (x282 - x283) + (-x281 - x283) + (fmaf(x14, x18, -x280) - fmaf(x15, x17, -x281));
    const float x285 = x15 * x16;
    const float x286 = x13 * x18;
    const float x287 = x285 - x286;
    const float x288 = x287 - x285;
    const float x289 = x285 - (x287 - x288) + (-x286 - x288) + (fmaf(x15, x16, -x285) - fmaf(x13, x18, -x286));
    const float x290 = x13 * x17;
    const float x291 = x14 * x16;
    const float x292 = x290 - x291;
    const float x293 = x292 - x290;
    const float x294 = x290 - (x292 - x293) + (-x291 - x293) + (fmaf(x13, x17, -x290) - fmaf(x14, x16, -x291));
    const float x295 = -x267 - x269;
    const float x296 = -x272 - x274;
    const float x297 = -x277 - x279;
    const float x298 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x295), fabsf(x296)), fabsf(x297)));
    const float x299 = x295 * x298;
    const float x300 = x296 * x298;
    const float x301 = x297 * x298;
    const float x302 = fmaf(x299, x299, fmaf(x300, x300, x301 * x301));
    const float x303 = (0.0f < x302) ? 1.0f / sqrtf(x302) : 0.0f;
    const float x304 = x299 * x303;
    const float x305 = x300 * x303;
    const float x306 = x301 * x303;
    const float x307 = x302 * x303 / x298;
    const bool b308 = x89 < 0.0f;
    const float x309 = b308 ? -x304 : x304;
    const float x310 = b308 ? -x305 : x305;
    const float x311 = b308 ? -x306 : x306;
    const bool b312 = 0.0f < x307;
    const float x313 = b312 ? -fmaf(x10, x85, fmaf(x11, x86, x12 * x87)) / (b312 ? x307 : 1.0f) : 0.0f;
    const float x314 = etendue_lesser(etendue_greater(x313, 1.0f), 1e18f) * 4.7683716e-7f;
    const float x315 = x267 + x282;
    const float x316 = x315 - x267;
    const float x317 = x272 + x287;
    const float x318 = x317 - x272;
    const float x319 = x277 + x292;
    const float x320 = x319 - x277;
    const float x321 = x315 + (x267 - (x315 - x316) + (x282 - x316) + (x269 + x284));
    const float x322 = x317 + (x272 - (x317 - x318) + (x287 - x318) + (x274 + x289));
    const float x323 = x319 + (x277 - (x319 - x320) + (x292 - x320) + (x279 + x294));
    const float x324 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x321), fabsf(x322)), fabsf(x323)));
    const float x325 = x321 * x324;
    const float x326 = x322 * x324;
    const float x327 = x323 * x324;
    const float x328 = fmaf(x325, x325, fmaf(x326, x326, x327 * x327));
    const float x329 = (0.0f < x328) ? 1.0f / sqrtf(x328) : 0.0f;
    const float x330 = x325 * x329;
    const float x331 = x326 * x329;
    const float x332 = x327 * x329;
    const float x333 = x328 * x329 / x324;
    const float x334 = b308 ? -x330 : x330;
    const float x335 = b308 ? -x331 : x331;
    const float x336 = b308 ? -x332 : x332;
    const bool b337 = 0.0f < x333;
    const float x338 = b337 ? -fmaf(x79, x82, fmaf(x80, x83, x81 * x84)) / (b337 ? x333 : 1.0f) : 0.0f;
    const float x339 = 4.7683716e-7f * etendue_lesser(etendue_greater(x338, 1.0f), 1e18f);
    const float x340 = x252 + x254;
    const float x341 = x257 + x259;
    const float x342 = x262 + x264;
    const float x343 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x340), fabsf(x341)), fabsf(x342)));
    const float x344 = x340 * x343;
    const float x345 = x341 * x343;
    const float x346 = x342 * x343;
    const float x347 = fmaf(x344, x344, fmaf(x345, x345, x346 * x346));
    const float x348 = (0.0f < x347) ? 1.0f / sqrtf(x347) : 0.0f;
    const float x349 = x344 * x348;
    const float x350 = x345 * x348;
    const float x351 = x346 * x348;
    const float x352 = x347 * x348 / x343;
    const float x353 = b308 ? -x349 : x349;
    const float x354 = b308 ? -x350 : x350;
    const float x355 = b308 ? -x351 : x351;
    const bool b356 = 0.0f < x352;
    const float x357 = b356 ? -fmaf(x10, x79, fmaf(x11, x80, x12 * x81)) / (b356 ? x352 : 1.0f) : 0.0f;
    const float x358 = 4.7683716e-7f * etendue_lesser(etendue_greater(x357, 1.0f), 1e18f);
    const float x359 = x282 - x252;
    const float x360 = x359 - x282;
    const float x361 = x287 - x257;
    const float x362 = x361 - x287;
    const float x363 = x292 - x262;
    const float x364 = x363 - x292;
    const float x365 = x282 - (x359 - x360) + (-x252 - x360) + (x284 - x254);
    const float x366 = x287 - (x361 - x362) + (-x257 - x362) + (x289 - x259);
    const float x367 = x292 - (x363 - x364) + (-x262 - x364) + (x294 - x264);
    const float x368 = x359 + x365;
    const float x369 = x361 + x366;
    const float x370 = x363 + x367;
    const float x371 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x368), fabsf(x369)), fabsf(x370)));
    const float x372 = x368 * x371;
    const float x373 = x369 * x371;
    const float x374 = x370 * x371;
    const float x375 = fmaf(x372, x372, fmaf(x373, x373, x374 * x374));
    const float x376 = (0.0f < x375) ? 1.0f / sqrtf(x375) : 0.0f;
    const float x377 = x372 * x376;
    const float x378 = x373 * x376;
    const float x379 = x374 * x376;
    const float x380 = x375 * x376 / x371;
    const float x381 = b308 ? -x377 : x377;
    const float x382 = b308 ? -x378 : x378;
    const float x383 = b308 ? -x379 : x379;
    const bool b384 = 0.0f < x380;
    const float x385 = b384 ? -fmaf(x82, x85, fmaf(x83, x86, x84 * x87)) / (b384 ? x380 : 1.0f) : 0.0f;
    const float x386 = 4.7683716e-7f * etendue_lesser(etendue_greater(x385, 1.0f), 1e18f);
    const float x387 = b114 ? x334 : x309;
    const float x388 = b114 ? x335 : x310;
    const float x389 = b114 ? x336 : x311;
    const float x390 = b114 ? x309 : x334;
    const float x391 = b114 ? x310 : x335;
    const float x392 = b114 ? x311 : x336;
    const float x393 = b141 ? x381 : x353;
    const float x394 = b141 ? x382 : x354;
    const float x395 = b141 ? x383 : x355;
    const float x396 = b141 ? x353 : x381;
    const float x397 = b141 ? x354 : x382;
    const float x398 = b141 ? x355 : x383;
    const float x399 = b114 ? x339 : x314;
    const float x400 = b141 ? x386 : x358;
    const float x401 = b114 ? x314 : x339;
    const float x402 = b141 ? x358 : x386;
    const float x403 = x63 * x89;
    const float x404 = x64 * x89;
    const float x405 = x65 * x89;
    const float x406 = b150 ? 1.0f : 0.0f;
    const float x407 = b151 ? 1.0f : 0.0f;
    const float x408 = b114 ? 1.0f : 0.0f;
    const float x409 = b141 ? 1.0f : 0.0f;
    const float x410 = b248 ? 1.0f / (b248 ? x185 : 1.0f) : 0.0f;
    const float x411 = b195 ? 0.5f : 2.0f;
    const float x412 = b249 ? x247 : 0.0f;
    const float x413 = 1.0f / x9;
    const float x414 = etendue_greater(etendue_greater(etendue_greater(0.0f, x4), x5), x6);
    const bool b415 = x414 < INFINITY;
    const float x416 = etendue_pow2_scale(x414);
    const float x417 = x416 * (b415 ? x1 : 0.0f);
    const float x418 = x416 * (b415 ? x2 : 0.0f);
    const float x419 = x416 * (b415 ? x3 : 0.0f);
    const float x420 = x416 * (b415 ? light.edge_s.x : 0.0f);
    const float x421 = x416 * (b415 ? light.edge_s.y : 0.0f);
    const float x422 = x416 * (b415 ? light.edge_s.z : 0.0f);
    const float x423 = x416 * (b415 ? light.edge_t.x : 0.0f);
    const float x424 = x416 * (b415 ? light.edge_t.y : 0.0f);
    const float x425 = x416 * (b415 ? light.edge_t.z : 0.0f);
    const float x426 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x420), fabsf(x421)), fabsf(x422)));
    const float x427 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x423), fabsf(x424)), fabsf(x425)));
    const float x428 = x420 * x426;
    const float x429 = x421 * x426;
    const float x430 = x422 * x426;
    const float x431 = x423 * x427;
    const float x432 = x424 * x427;
    const float x433 = x425 * x427;
    const float x434 = x429 * x433;
    const float x435 = x430 * x432;
    const float x436 = x434 - x435;
    const float x437 = x436 - x434;
    const float x438 = x434 - (x436 - x437) + (-x435 - x437) + (fmaf(x429, x433, -x434) - fmaf(x430, x432, -x435));
    const float x439 = x430 * x431;
    const float x440 = x428 * x433;
    const float x441 = x439 - x440;
    const float x442 = x441 - x439;
    const float x443 = x439 - (x441 - x442) + (-x440 - x442) + (fmaf(x430, x431, -x439) - fmaf(x428, x433, -x440));
    const float x444 = x428 * x432;
    const float x445 = x429 * x431;
    const float x446 = x444 - x445;
    const float x447 = x446 - x444;
    const float x448 = x444 - (x446 - x447) + (-x445 - x447) + (fmaf(x428, x432, -x444) - fmaf(x429, x431, -x445));
    const float x449 = x436 + x438;
    const float x450 = x441 + x443;
    const float x451 = x446 + x448;
    const float x452 = etendue_pow2_scale(etendue_greater(etendue_greater(fabsf(x449), fabsf(x450)), fabsf(x451)));
    const float x453 = x449 * x452;
    const float x454 = x450 * x452;
    const float x455 = x451 * x452;
    const float x456 = fmaf(x453, x453, fmaf(x454, x454, x455 * x455));
    const float x457 = (0.0f < x456) ? 1.0f / sqrtf(x456) : 0.0f;
    const float x458 = x453 * x457;
    const float x459 = x454 * x457;
    const float x460 = x455 * x457;
    const float x461 = x456 * x457 / x452;
    const float x462 = x417 * x436;
    const float x463 = x418 * x441;
    const float x464 = x419 * x446;
    const float x465 = x462 + x463;
    const float x466 = x465 - x462;
    const float x467 = x464 + x465;
    const float x468 = x467 - x465;
    const float x469 = x462 - (x465 - x466) + (x463 - x466) + (x465 - (x467 - x468) + (x464 - x468));
    const float x470 = fmaf(x417, x436, -x462) + (fmaf(x418, x441, -x463) + fmaf(x419, x446, -x464));
    const bool b471 = 1e-37f < fabsf(x461);
    const float x472 = (x467 + (x469 + x470 + fmaf(x417, x438, fmaf(x418, x443, x419 * x448)))) / (b471 ? x461 : 1.0f);
    const float x473 = etendue_lesser(etendue_greater(b471 ? x472 : 0.0f, -1e37f), 1e37f);
    const float x474 = x461 / x426 / x427;
    const float x475 = x458 * x474;
    const float x476 = x459 * x474;
    const float x477 = x460 * x474;
    const float x478 = -(x419 * x421);
    const float x479 = fmaf(x418, x422, x478) - fmaf(x419, x421, x478);
    const float x480 = -(x417 * x422);
    const float x481 = fmaf(x419, x420, x480) - fmaf(x417, x422, x480);
    const float x482 = -(x418 * x420);
    const float x483 = fmaf(x417, x421, x482) - fmaf(x418, x420, x482);
    const float x484 = -(x419 * x424);
    const float x485 = fmaf(x418, x425, x484) - fmaf(x419, x424, x484);
    const float x486 = -(x417 * x425);
    const float x487 = fmaf(x419, x423, x486) - fmaf(x417, x425, x486);
    const float x488 = -(x418 * x423);
    const float x489 = fmaf(x417, x424, x488) - fmaf(x418, x423, x488);
    const float x490 = 1.0f / x416;
    EtendueRectangleBySolidAngle result;
    result.surface_plane_cross.x = x475;
    result.surface_plane_cross.y = x476;
    result.surface_plane_cross.z = x477;
    result.surface_plane_normal.x = x458;
    result.surface_plane_normal.y = x459;
    result.surface_plane_normal.z = x460;
    result.surface_plane_height = x473;
    result.surface_plane_along_first.x = x479;
    result.surface_plane_along_first.y = x481;
    result.surface_plane_along_first.z = x483;
    result.surface_plane_along_second.x = x485;
    result.surface_plane_along_second.y = x487;
    result.surface_plane_along_second.z = x489;
    result.surface_plane_unit = x490;
    result.shape_base.x = x160;
    result.shape_base.y = x161;
    result.shape_base.z = x162;
    result.shape_side_x.x = x144;
    result.shape_side_x.y = x145;
    result.shape_side_x.z = x146;
    result.shape_side_y.x = x147;
    result.shape_side_y.y = x148;
    result.shape_side_y.z = x149;
    result.shape_near_x.x = x387;
    result.shape_near_x.y = x388;
    result.shape_near_x.z = x389;
    result.shape_far_x.x = x390;
    result.shape_far_x.y = x391;
    result.shape_far_x.z = x392;
    result.shape_near_y.x = x393;
    result.shape_near_y.y = x394;
    result.shape_near_y.z = x395;
    result.shape_far_y.x = x396;
    result.shape_far_y.y = x397;
    result.shape_far_y.z = x398;
    result.shape_slack.x = x399;
    result.shape_slack.y = x400;
    result.shape_slack_far.x = x401;
    result.shape_slack_far.y = x402;
    result.shape_normal.x = x403;
    result.shape_normal.y = x404;
    result.shape_normal.z = x405;
    result.shape_near.x = x115;
    result.shape_near.y = x142;
    result.shape_far.x = x116;
    result.shape_far.y = x143;
    result.shape_size.x = x28;
    result.shape_size.y = x38;
    result.shape_height = x88;
    result.shape_anchor.x = x406;
    result.shape_anchor.y = x407;
    result.shape_flip.x = x408;
    result.shape_flip.y = x409;
    result.shape_sin_w1 = x185;
    result.shape_cos_w1 = x186;
    result.shape_inv_sin_w1 = x410;
    result.shape_above_p = x192;
    result.shape_above_s = x194;
    result.shape_near_sin = x209;
    result.shape_near_cos = x210;
    result.shape_near_above_p = x215;
    result.shape_near_above_s = x216;
    result.shape_half = x411;
    result.shape_solid_angle = x412;
    result.shape_side = x89;
    result.shape_unit = x413;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
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
    const bool b29 = 0.0f < x28;
    const float x30 = b29 ? 1.0f / (b29 ? x28 : 1.0f) : 0.0f;
    const float x31 = x27 * x30;
    const float x32 = x25 * x31;
    const float x33 = prepared.shape_far.y * x32;
    const float x34 = (0.0f <= prepared.shape_near.y) ? x30 * (x22 * (prepared.shape_size.y * (prepared.shape_near.y + prepared.shape_far.y))) : x27 * x31;
    const float x35 = x31 * (prepared.shape_near.y * x26);
    const float x36 = (b23 ? u.y : x24) * x34;
    const float x37 = (b23 ? x24 : 1.0f - x24) * x34;
    const float x38 = x35 + x37;
    const bool b39 = x38 < 0.0f;
    const float x40 = b39 ? x38 : x33 - x36;
    const float x41 = (b39 ? -x37 : x36) * (x40 + (b39 ? x35 : x33));
    const float x42 = x31 * (b39 ? x26 : x25);
    const float x43 = sqrtf(etendue_greater(x22 * fmaf(x42, x22 * x42, x41), 0.0f));
    const bool b44 = 0.0f < prepared.shape_anchor.y;
    const float x45 = x43 * (b44 ? fmaf(x33, x43, x32 * (x22 * x40)) : 1.0f);
    const float x46 = x22 * (b44 ? -(x26 * x41) : x40) / ((0.0f < x45) ? x45 : 1.0f);
    const float x47 = etendue_lesser(etendue_greater(x46, b44 ? -prepared.shape_size.y : prepared.shape_near.y), b44 ? 0.0f : prepared.shape_far.y);
    const float x48 = fmaf(prepared.shape_side_x.x, x20, fmaf(prepared.shape_side_y.x, x47, prepared.shape_base.x));
    const float x49 = fmaf(prepared.shape_side_x.y, x20, fmaf(prepared.shape_side_y.y, x47, prepared.shape_base.y));
    const float x50 = fmaf(prepared.shape_side_x.z, x20, fmaf(prepared.shape_side_y.z, x47, prepared.shape_base.z));
    const float x51 = fmaf(x48, x48, fmaf(x49, x49, x50 * x50));
    const float x52 = (1e-37f < x51) ? 1.0f / sqrtf(x51) : 0.0f;
    const float x53 = x48 * x52;
    const float x54 = x49 * x52;
    const float x55 = x50 * x52;
    const bool b56 = 0.0f < prepared.shape_solid_angle;
    const float x57 = b56 ? prepared.shape_unit * (x51 * x52) : 0.0f;
    const float x58 = fmaf(prepared.surface_plane_cross.x, x53, fmaf(prepared.surface_plane_cross.y, x54, prepared.surface_plane_cross.z * x55));
    const bool b59 = 1e-37f < fabsf(x58);
    const float x60 = b59 ? x58 : 1.0f;
    const float x61 = etendue_greater(b59 ? -fmaf(prepared.surface_plane_along_second.x, x53, fmaf(prepared.surface_plane_along_second.y, x54, prepared.surface_plane_along_second.z * x55)) / x60 : 0.0f, -1e37f);
    const float x62 = etendue_lesser(etendue_greater(b59 ? fmaf(prepared.surface_plane_along_first.x, x53, fmaf(prepared.surface_plane_along_first.y, x54, prepared.surface_plane_along_first.z * x55)) / x60 : 0.0f, -1e37f), 1e37f);
    const float x63 = etendue_lesser(etendue_greater(etendue_lesser(x61, 1e37f), 0.0f), 1.0f);
    const float x64 = etendue_lesser(etendue_greater(x62, 0.0f), 1.0f);
    const float x65 = b56 ? 1.0f / (b56 ? prepared.shape_solid_angle : 1.0f) : 0.0f;
    const bool b66 = prepared.shape_side < 0.0f;
    const bool b67 = b66 && (1e-37f < x65);
    const float x68 = b67 ? 1.0f / (b67 ? x65 : 1.0f) : 0.0f;
    EtendueLightSample result;
    result.direction.x = x53;
    result.direction.y = x54;
    result.direction.z = x55;
    result.distance = x57;
    result.pdf = x65;
    result.weight = x68;
    result.normal.x = prepared.surface_plane_normal.x;
    result.normal.y = prepared.surface_plane_normal.y;
    result.normal.z = prepared.surface_plane_normal.z;
    result.uv.x = x63;
    result.uv.y = x64;
    result.emits = b66;
    result.delta = false;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the solid angle
// Omega at the point p: pdf 1/Omega per steradian.
ETENDUE_FUNCTION float etendue_rectangle_by_solid_angle_pdf(EtendueRectangleBySolidAngle prepared, EtendueVec3 w) {
    const bool b1 = (-prepared.shape_slack.x <= fmaf(prepared.shape_near_x.x, w.x, fmaf(prepared.shape_near_x.y, w.y, prepared.shape_near_x.z * w.z))) && (-prepared.shape_slack_far.x <= fmaf(prepared.shape_far_x.x, w.x, fmaf(prepared.shape_far_x.y, w.y, prepared.shape_far_x.z * w.z)));
    const bool b2 = b1 && (-prepared.shape_slack.y <= fmaf(prepared.shape_near_y.x, w.x, fmaf(prepared.shape_near_y.y, w.y, prepared.shape_near_y.z * w.z))) && (-prepared.shape_slack_far.y <= fmaf(prepared.shape_far_y.x, w.x, fmaf(prepared.shape_far_y.y, w.y, prepared.shape_far_y.z * w.z)));
    const bool b3 = 0.0f < prepared.shape_solid_angle;
    const float x4 = (b2 && (-4.7683716e-7f <= fmaf(prepared.shape_normal.x, w.x, fmaf(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z)))) ? (b3 ? 1.0f / (b3 ? prepared.shape_solid_angle : 1.0f) : 0.0f) : 0.0f;
    return x4;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian.
ETENDUE_FUNCTION EtendueLightSample etendue_rectangle_by_solid_angle_hit(EtendueRectangleBySolidAngle prepared, EtendueVec3 w) {
    const bool b1 = (-prepared.shape_slack.x <= fmaf(prepared.shape_near_x.x, w.x, fmaf(prepared.shape_near_x.y, w.y, prepared.shape_near_x.z * w.z))) && (-prepared.shape_slack_far.x <= fmaf(prepared.shape_far_x.x, w.x, fmaf(prepared.shape_far_x.y, w.y, prepared.shape_far_x.z * w.z)));
    const bool b2 = b1 && (-prepared.shape_slack.y <= fmaf(prepared.shape_near_y.x, w.x, fmaf(prepared.shape_near_y.y, w.y, prepared.shape_near_y.z * w.z))) && (-prepared.shape_slack_far.y <= fmaf(prepared.shape_far_y.x, w.x, fmaf(prepared.shape_far_y.y, w.y, prepared.shape_far_y.z * w.z)));
    const bool b3 = 0.0f < prepared.shape_solid_angle;
    const float x4 = (b2 && (-4.7683716e-7f <= fmaf(prepared.shape_normal.x, w.x, fmaf(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z)))) ? (b3 ? 1.0f / (b3 ? prepared.shape_solid_angle : 1.0f) : 0.0f) : 0.0f;
    const bool b5 = 0.0f < x4;
    const float x6 = fmaf(prepared.surface_plane_cross.x, w.x, fmaf(prepared.surface_plane_cross.y, w.y, prepared.surface_plane_cross.z * w.z));
    const bool b7 = 1e-37f < fabsf(x6);
    const float x8 = b7 ? x6 : 1.0f;
    const float x9 = etendue_greater(b7 ? -fmaf(prepared.surface_plane_along_second.x, w.x, fmaf(prepared.surface_plane_along_second.y, w.y, prepared.surface_plane_along_second.z * w.z)) / x8 : 0.0f, -1e37f);
    const float x10 = etendue_lesser(etendue_greater(b7 ? fmaf(prepared.surface_plane_along_first.x, w.x, fmaf(prepared.surface_plane_along_first.y, w.y, prepared.surface_plane_along_first.z * w.z)) / x8 : 0.0f, -1e37f), 1e37f);
    const float x11 = etendue_lesser(etendue_greater(etendue_lesser(x9, 1e37f), 0.0f), 1.0f);
    const float x12 = etendue_lesser(etendue_greater(x10, 0.0f), 1.0f);
    const float x13 = fmaf(prepared.surface_plane_normal.x, w.x, fmaf(prepared.surface_plane_normal.y, w.y, prepared.surface_plane_normal.z * w.z));
    const bool b14 = 1e-37f < fabsf(x13);
    const float x15 = prepared.surface_plane_unit * etendue_greater(etendue_lesser(etendue_greater(b14 ? prepared.surface_plane_height / (b14 ? x13 : 1.0f) : 0.0f, -1e37f), 1e37f), 0.0f);
    const float x16 = b5 ? etendue_lesser(x15, 3.4028235e38f) : 0.0f;
    const bool b17 = (prepared.shape_side < 0.0f) && b5;
    const bool b18 = b17 && (1e-37f < x4);
    const float x19 = b18 ? 1.0f / (b18 ? x4 : 1.0f) : 0.0f;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = x16;
    result.pdf = x4;
    result.weight = x19;
    result.normal.x = prepared.surface_plane_normal.x;
    result.normal.y = prepared.surface_plane_normal.y;
    result.normal.z = prepared.surface_plane_normal.z;
    result.uv.x = x11;
    result.uv.y = x12;
    result.emits = b17;
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
    const bool b30 = 1e-37f < x29;
    const float x31 = etendue_greater(etendue_lesser(etendue_greater(b30 ? prepared.surface_height / (b30 ? x28 : 1.0f) : 0.0f, -1e37f), 1e37f), 0.0f);
    const float x32 = prepared.surface_radius * prepared.surface_radius * 3.1415927f * x29;
    const bool b33 = 0.0f < x32;
    const float x34 = x31 * (x31 / (b33 ? x32 : 1.0f));
    const float x35 = (b33 && (x34 < 1e37f) && (0.0f < x31)) ? x34 : 0.0f;
    const bool b36 = x28 < 0.0f;
    const bool b37 = b36 && (1e-37f < x35);
    const float x38 = b37 ? 1.0f / (b37 ? x35 : 1.0f) : 0.0f;
    EtendueLightSample result;
    result.direction.x = x24;
    result.direction.y = x25;
    result.direction.z = x26;
    result.distance = x27;
    result.pdf = x35;
    result.weight = x38;
    result.normal.x = prepared.surface_frame_n.x;
    result.normal.y = prepared.surface_frame_n.y;
    result.normal.z = prepared.surface_frame_n.z;
    result.uv.x = x13;
    result.uv.y = x14;
    result.emits = b36;
    result.delta = false;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the surface of area
// A: pdf distance^2/(|cos(theta')| A) per steradian, theta' at the light.
ETENDUE_FUNCTION float etendue_disk_by_area_pdf(EtendueDiskByArea prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.surface_frame_n.x, w.x, fmaf(prepared.surface_frame_n.y, w.y, prepared.surface_frame_n.z * w.z));
    const float x2 = fabsf(x1);
    const bool b3 = 1e-37f < x2;
    const float x4 = etendue_greater(etendue_lesser(etendue_greater(b3 ? prepared.surface_height / (b3 ? x1 : 1.0f) : 0.0f, -1e37f), 1e37f), 0.0f);
    const float x5 = x2 * (prepared.surface_radius * prepared.surface_radius * 3.1415927f);
    const bool b6 = 0.0f < x5;
    const float x7 = x4 * (x4 / (b6 ? x5 : 1.0f));
    const float x8 = etendue_greater(etendue_greater(etendue_greater(fabsf(prepared.surface_center.x), fabsf(prepared.surface_center.y)), fabsf(prepared.surface_center.z)), fabsf(prepared.surface_radius));
    const float x9 = etendue_pow2_scale(x8);
    const float x10 = prepared.surface_center.x * x9;
    const float x11 = prepared.surface_center.y * x9;
    const float x12 = prepared.surface_center.z * x9;
    const float x13 = prepared.surface_height * x9;
    const float x14 = prepared.surface_radius * x9;
    const float x15 = w.x * x13 - x1 * x10;
    const float x16 = w.y * x13 - x1 * x11;
    const float x17 = w.z * x13 - x1 * x12;
    const float x18 = fmaf(x2, x14, (x14 + sqrtf(fmaf(x10, x10, fmaf(x11, x11, x12 * x12)))) * 7.1525574e-7f);
    const bool b19 = (sqrtf(fmaf(x15, x15, fmaf(x16, x16, x17 * x17))) <= x18) && (0.0f < x1 * x13);
    const float x20 = (b19 && (0.0f < x14)) ? ((b6 && (x7 < 1e37f) && (0.0f < x4)) ? x7 : 0.0f) : 0.0f;
    return x20;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the surface of area A: pdf distance^2/(|cos(theta')| A) per steradian, theta' at the light.
ETENDUE_FUNCTION EtendueLightSample etendue_disk_by_area_hit(EtendueDiskByArea prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.surface_frame_n.x, w.x, fmaf(prepared.surface_frame_n.y, w.y, prepared.surface_frame_n.z * w.z));
    const float x2 = fabsf(x1);
    const bool b3 = 1e-37f < x2;
    const float x4 = etendue_lesser(etendue_greater(b3 ? prepared.surface_height / (b3 ? x1 : 1.0f) : 0.0f, -1e37f), 1e37f);
    const float x5 = etendue_greater(x4, 0.0f);
    const float x6 = fmaf(w.x, x4, -prepared.surface_center.x);
    const float x7 = fmaf(w.y, x4, -prepared.surface_center.y);
    const float x8 = fmaf(w.z, x4, -prepared.surface_center.z);
    const float x9 = fabsf(prepared.surface_radius);
    const bool b10 = 1e-37f < x9;
    const float x11 = b10 ? prepared.surface_radius : 1.0f;
    const float x12 = etendue_lesser(etendue_greater(b10 ? fmaf(prepared.surface_frame_s.x, x6, fmaf(prepared.surface_frame_s.y, x7, prepared.surface_frame_s.z * x8)) / x11 : 0.0f, -1e37f), 1e37f);
    const float x13 = etendue_lesser(etendue_greater(b10 ? fmaf(prepared.surface_frame_t.x, x6, fmaf(prepared.surface_frame_t.y, x7, prepared.surface_frame_t.z * x8)) / x11 : 0.0f, -1e37f), 1e37f);
    const float x14 = etendue_lesser(etendue_greater(fmaf(etendue_lesser(etendue_greater(x12, -1000000000000000.0f), 1000000000000000.0f), 0.5f, 0.5f), 0.0f), 1.0f);
    const float x15 = etendue_lesser(etendue_greater(fmaf(etendue_lesser(etendue_greater(x13, -1000000000000000.0f), 1000000000000000.0f), 0.5f, 0.5f), 0.0f), 1.0f);
    const float x16 = x2 * (prepared.surface_radius * prepared.surface_radius * 3.1415927f);
    const bool b17 = 0.0f < x16;
    const float x18 = x5 * (x5 / (b17 ? x16 : 1.0f));
    const float x19 = etendue_pow2_scale(etendue_greater(etendue_greater(etendue_greater(fabsf(prepared.surface_center.x), fabsf(prepared.surface_center.y)), fabsf(prepared.surface_center.z)), x9));
    const float x20 = prepared.surface_center.x * x19;
    const float x21 = prepared.surface_center.y * x19;
    const float x22 = prepared.surface_center.z * x19;
    const float x23 = prepared.surface_height * x19;
    const float x24 = prepared.surface_radius * x19;
    const float x25 = w.x * x23 - x1 * x20;
    const float x26 = w.y * x23 - x1 * x21;
    const float x27 = w.z * x23 - x1 * x22;
    const float x28 = fmaf(x2, x24, (x24 + sqrtf(fmaf(x20, x20, fmaf(x21, x21, x22 * x22)))) * 7.1525574e-7f);
    const bool b29 = (sqrtf(fmaf(x25, x25, fmaf(x26, x26, x27 * x27))) <= x28) && (0.0f < x1 * x23);
    const float x30 = (b29 && (0.0f < x24)) ? ((b17 && (x18 < 1e37f) && (0.0f < x5)) ? x18 : 0.0f) : 0.0f;
    const bool b31 = 0.0f < x30;
    const float x32 = b31 ? x5 : 0.0f;
    const bool b33 = b31 && (x1 < 0.0f);
    const bool b34 = b33 && (1e-37f < x30);
    const float x35 = b34 ? 1.0f / (b34 ? x30 : 1.0f) : 0.0f;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = x32;
    result.pdf = x30;
    result.weight = x35;
    result.normal.x = prepared.surface_frame_n.x;
    result.normal.y = prepared.surface_frame_n.y;
    result.normal.z = prepared.surface_frame_n.z;
    result.uv.x = x14;
    result.uv.y = x15;
    result.emits = b33;
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
    const bool b11 = 1e-37f < x1;
    const float x12 = b11 ? 0.15915494f / (b11 ? x1 : 1.0f) : 0.0f;
    const float x13 = -x8;
    const float x14 = -x9;
    const float x15 = -x10;
    const bool b16 = 1e-37f < x12;
    const float x17 = b16 ? 1.0f / (b16 ? x12 : 1.0f) : 0.0f;
    EtendueLightSample result;
    result.direction.x = x8;
    result.direction.y = x9;
    result.direction.z = x10;
    result.distance = 3.4028235e38f;
    result.pdf = x12;
    result.weight = x17;
    result.normal.x = x13;
    result.normal.y = x14;
    result.normal.z = x15;
    result.uv.x = u.x;
    result.uv.y = u.y;
    result.emits = true;
    result.delta = false;
    return result;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the cone: pdf 1/(2
// pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
ETENDUE_FUNCTION float etendue_sun_by_solid_angle_pdf(EtendueSunBySolidAngle prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.frame_s.x, w.x, fmaf(prepared.frame_s.y, w.y, prepared.frame_s.z * w.z));
    const float x2 = fmaf(prepared.frame_t.x, w.x, fmaf(prepared.frame_t.y, w.y, prepared.frame_t.z * w.z));
    const float x3 = fmaf(prepared.frame_n.x, w.x, fmaf(prepared.frame_n.y, w.y, prepared.frame_n.z * w.z));
    const float x4 = etendue_lesser(etendue_greater(prepared.cone_one_minus_cos, 0.0f), 2.0f);
    const bool b5 = 1e-37f < x4;
    const float x6 = (0.5f < x3) ? fmaf(x1, x1, x2 * x2) / (1.0f + fabsf(x3)) : 1.0f - x3;
    const float x7 = x4 + fmaf(5.9604645e-7f, etendue_greater(sqrtf(x4 * (2.0f - x4)), x4 - 1.0f), 1.7763568e-13f);
    const float x8 = (x6 <= x7) ? (b5 ? 0.15915494f / (b5 ? x4 : 1.0f) : 0.0f) : 0.0f;
    return x8;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the cone: pdf 1/(2 pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
ETENDUE_FUNCTION EtendueLightSample etendue_sun_by_solid_angle_hit(EtendueSunBySolidAngle prepared, EtendueVec3 w) {
    const float x1 = fmaf(prepared.frame_s.x, w.x, fmaf(prepared.frame_s.y, w.y, prepared.frame_s.z * w.z));
    const float x2 = fmaf(prepared.frame_t.x, w.x, fmaf(prepared.frame_t.y, w.y, prepared.frame_t.z * w.z));
    const float x3 = fmaf(prepared.frame_n.x, w.x, fmaf(prepared.frame_n.y, w.y, prepared.frame_n.z * w.z));
    const float x4 = etendue_lesser(etendue_greater(prepared.cone_one_minus_cos, 0.0f), 2.0f);
    const bool b5 = 1e-37f < x4;
    const float x6 = (0.5f < x3) ? fmaf(x1, x1, x2 * x2) / (1.0f + fabsf(x3)) : 1.0f - x3;
    const float x7 = x4 + fmaf(5.9604645e-7f, etendue_greater(sqrtf(x4 * (2.0f - x4)), x4 - 1.0f), 1.7763568e-13f);
    const float x8 = (x6 <= x7) ? (b5 ? 0.15915494f / (b5 ? x4 : 1.0f) : 0.0f) : 0.0f;
    const float x9 = etendue_lesser(etendue_greater(x6 / ((0.0f < x4) ? x4 : 1.0f), 0.0f), 0.99999994f);
    const float x10 = 0.15915494f * etendue_angle(x2, x1);
    const float x11 = etendue_lesser(etendue_greater((x10 < 0.0f) ? 1.0f + x10 : x10, 0.0f), 0.99999994f);
    const bool b12 = 0.0f < x8;
    const float x13 = b12 ? 3.4028235e38f : 0.0f;
    const float x14 = -w.x;
    const float x15 = -w.y;
    const float x16 = -w.z;
    const bool b17 = b12 && (1e-37f < x8);
    const float x18 = b17 ? 1.0f / (b17 ? x8 : 1.0f) : 0.0f;
    EtendueLightSample result;
    result.direction.x = w.x;
    result.direction.y = w.y;
    result.direction.z = w.z;
    result.distance = x13;
    result.pdf = x8;
    result.weight = x18;
    result.normal.x = x14;
    result.normal.y = x15;
    result.normal.z = x16;
    result.uv.x = x9;
    result.uv.y = x11;
    result.emits = b12;
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
    const bool b5 = b1 && (1e-37f < prepared.pdf);
    const float x6 = b5 ? 1.0f / (b5 ? prepared.pdf : 1.0f) : 0.0f;
    EtendueLightSample result;
    result.direction.x = prepared.direction.x;
    result.direction.y = prepared.direction.y;
    result.direction.z = prepared.direction.z;
    result.distance = prepared.distance;
    result.pdf = prepared.pdf;
    result.weight = x6;
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
    const float x17 = fmaf(light.axis.x, -x13, fmaf(light.axis.y, -x14, light.axis.z * -x15));
    const float x18 = light.cos_inner - light.cos_outer;
    const bool b19 = 0.0f < x18;
    const float x20 = etendue_lesser(etendue_greater((x17 - light.cos_outer) / (b19 ? x18 : 1.0f), 0.0f), 1.0f);
    const float x21 = b19 ? x20 * x20 * (3.0f - (x20 + x20)) : ((light.cos_inner <= x17) ? 1.0f : 0.0f);
    const bool b22 = 0.0f < x21;
    const float x23 = x16 * x16;
    const float x24 = ((x23 < 1e37f) ? x23 : 0.0f) / (b22 ? x21 : 1.0f);
    const float x25 = (b22 && (x24 < 1e37f)) ? x24 : 0.0f;
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
    const bool b5 = b1 && (1e-37f < prepared.pdf);
    const float x6 = b5 ? 1.0f / (b5 ? prepared.pdf : 1.0f) : 0.0f;
    EtendueLightSample result;
    result.direction.x = prepared.direction.x;
    result.direction.y = prepared.direction.y;
    result.direction.z = prepared.direction.z;
    result.distance = prepared.distance;
    result.pdf = prepared.pdf;
    result.weight = x6;
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
    const etendue_word k13 = k12 ^ k12 * 89287766u;
    const etendue_word k14 = etendue_reverse_bits(k13 ^ k13 * 1403136100u);
    const etendue_word k15 = k14 ^ ((k14 >> 16u) & 65535u);
    const etendue_word k16 = k15 ^ ((k15 >> 8u) & 16711935u);
    const etendue_word k17 = k16 ^ ((k16 >> 4u) & 252645135u);
    const etendue_word k18 = k17 ^ ((k17 >> 2u) & 858993459u);
    const etendue_word k19 = (k10 + k14) * (1u | (k10 >> 16u));
    const etendue_word k20 = k19 ^ 89287766u * k19;
    const float x21 = etendue_unit(etendue_reverse_bits(k20 ^ 1403136100u * k20));
    const etendue_word k22 = (k11 + (k18 ^ ((k18 >> 1u) & 1431655765u))) * (1u | (k11 >> 16u));
    const etendue_word k23 = k22 ^ 89287766u * k22;
    const float x24 = etendue_unit(etendue_reverse_bits(k23 ^ 1403136100u * k23));
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
    const bool b9 = emits && (1e-37f < pdf);
    const float x10 = x7 / (b4 ? x8 * x8 + (0.0f + x7) : 1.0f) * (b9 ? 1.0f / (b9 ? pdf : 1.0f) : 0.0f);
    return x10;
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

#endif
