// Light sampling for renderers, in GLSL ES 3.00, for float and int of high precision. MIT or Apache-2.0.
// Written by `etendue-shader --language glsl-es --lights sphere_by_solid_angle,triangle_by_solid_angle,rectangle_by_solid_angle,disk_by_area,sun,point_light,spot_light,directional_light --warps concentric_disk,cosine_hemisphere,ggx_visible_normals --tools all --functions sample,pdf,hit`.
//
// Results have the bits of the Rust library etendue as far as the device rounds each operation correctly, and keeps
// subnormal numbers, infinities and NaN. This language has no fused multiply-add: double-word arithmetic keeps fewer
// digits.

precision highp float;
precision highp int;

struct EtendueGgxVisibleNormals {
    vec2 alpha;
    vec2 inverse_alpha;
    vec3 view;
    float stretched_x;
    float stretched_y;
    float height;
    float scale;
};
struct EtendueLightSample {
    vec3 direction;
    float distance_;
    float pdf;
    float weight;
    vec3 normal;
    vec2 uv;
    bool emits;
    bool delta;
};
struct EtendueSphereBySolidAngle {
    vec3 surface_center;
    float surface_radius;
    vec3 shape_frame_s;
    vec3 shape_frame_t;
    vec3 shape_frame_n;
    float shape_cone_one_minus_cos;
    float shape_distance;
    float shape_power;
    float shape_unit;
};
struct EtendueSphere {
    vec3 center;
    float radius;
};
struct EtendueTriangleBySolidAngle {
    vec3 surface_plane_cross;
    vec3 surface_plane_normal;
    float surface_plane_height;
    vec3 surface_plane_along_first;
    vec3 surface_plane_along_second;
    float surface_plane_unit;
    vec3 shape_side01_;
    vec3 shape_side12_;
    vec3 shape_side20_;
    vec3 shape_slack;
    vec3 shape_normal;
    float shape_l1_;
    float shape_farthest;
    vec3 shape_apex;
    vec3 shape_along;
    vec3 shape_across;
    float shape_cot_alpha;
    float shape_stretch;
    float shape_tan_half;
    vec2 shape_half;
    vec2 shape_turned;
    float shape_sin_side;
    float shape_inv_l0_;
    float shape_inv_l2_;
    float shape_cot_half;
    float shape_inv_half_sin;
    float shape_g2_;
    float shape_g2_over_g0_;
    float shape_one_plus_d02_;
    float shape_sin02_squared;
    float shape_x2_;
    float shape_y2_;
    float shape_g1_;
    float shape_volume;
    float shape_solid_angle;
    float shape_unit;
};
struct EtendueTriangle {
    vec3 v0_;
    vec3 e1_;
    vec3 e2_;
};
struct EtendueRectangleBySolidAngle {
    vec3 surface_plane_cross;
    vec3 surface_plane_normal;
    float surface_plane_height;
    vec3 surface_plane_along_first;
    vec3 surface_plane_along_second;
    float surface_plane_unit;
    vec3 shape_base;
    vec3 shape_side_x;
    vec3 shape_side_y;
    vec3 shape_near_x;
    vec3 shape_far_x;
    vec3 shape_near_y;
    vec3 shape_far_y;
    vec2 shape_slack;
    vec2 shape_slack_far;
    vec3 shape_normal;
    vec2 shape_near;
    vec2 shape_far;
    vec2 shape_size;
    float shape_height;
    vec2 shape_anchor;
    vec2 shape_flip;
    float shape_sin_w1_;
    float shape_cos_w1_;
    float shape_inv_sin_w1_;
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
};
struct EtendueRectangle {
    vec3 corner;
    vec3 edge_s;
    vec3 edge_t;
};
struct EtendueDiskByArea {
    vec3 surface_center;
    vec3 surface_frame_s;
    vec3 surface_frame_t;
    vec3 surface_frame_n;
    float surface_radius;
    float surface_height;
};
struct EtendueDisk {
    vec3 center;
    vec3 normal;
    float radius;
};
struct EtendueSunBySolidAngle {
    vec3 frame_s;
    vec3 frame_t;
    vec3 frame_n;
    float cone_one_minus_cos;
};
struct EtendueSun {
    vec3 direction;
    float one_minus_cos;
};
struct EtenduePointLightByDelta {
    vec3 direction;
    float distance_;
    float pdf;
};
struct EtenduePointLight {
    vec3 position;
};
struct EtendueSpotLightByDelta {
    vec3 direction;
    float distance_;
    float pdf;
};
struct EtendueSpotLight {
    vec3 position;
    vec3 axis;
    float one_minus_cos_inner;
    float one_minus_cos_outer;
};
struct EtendueDirectionalLightByDelta {
    vec3 direction;
};
struct EtendueDirectionalLight {
    vec3 direction;
};

float etendue_from_bits(uint bits) {
    return uintBitsToFloat(bits);
}

float etendue_lesser(float a, float b) {
    return ((a < b) ? a : b);
}

float etendue_greater(float a_1, float b_1) {
    return ((a_1 > b_1) ? a_1 : b_1);
}

float etendue_copysign(float x, float sign_) {
    uint magnitude = (floatBitsToUint(x) & 2147483647u);
    return uintBitsToFloat((magnitude | ((sign_ == sign_) ? (floatBitsToUint(sign_) & 2147483648u) : 0u)));
}

float etendue_pow2_scale(float x_1) {
    float _e8 = etendue_greater(uintBitsToFloat((2130706432u - (floatBitsToUint(x_1) & 2139095040u))), 5.877472e-39);
    return _e8;
}

float etendue_from_word(uint k) {
    return float(int(k));
}

uint etendue_to_word(float x_2) {
    return uint(int(x_2));
}

float etendue_inverse_cbrt_estimate(float x_3) {
    float _e3 = etendue_from_word(floatBitsToUint(x_3));
    uint _e7 = etendue_to_word((1419916000.0 - (_e3 * 0.33333334)));
    return uintBitsToFloat(_e7);
}

float etendue_unit(uint k_1) {
    return (float((k_1 >> 8u)) * 5.9604645e-8);
}

uint etendue_word_less(uint a_2, uint b_2) {
    return ((a_2 < b_2) ? 4294967295u : 0u);
}

uint etendue_word_quotient(uint a_3, uint b_3) {
    return ((b_3 == 0u) ? 0u : (a_3 / b_3));
}

// (sin 2 pix, cos 2 pix) within 8.5e-8, for |x| < 2^126.
vec2 etendue_sin_cos_turns(float x_4) {
    vec2 result = vec2(0.0);
    float x1_ = (x_4 * 4.0);
    float x2_ = roundEven(x1_);
    float x3_ = (x1_ - x2_);
    float x4_ = (x3_ * x3_);
    float x5_ = (x3_ * (x4_ * (x4_ * (x4_ * -0.004601658 + 0.07968003) + -0.6459635) + 1.5707964));
    float x6_ = (x4_ * (x4_ * (x4_ * (x4_ * 0.0009040217 + -0.020860288) + 0.25366923) + -1.2337005) + 1.0);
    float x7_ = (x2_ - (4.0 * roundEven((x2_ * 0.25))));
    float x8_ = abs(x7_);
    bool b9_ = (abs((x8_ - 1.0)) < 0.5);
    bool b10_ = (1.5 < x8_);
    float x11_ = (b9_ ? x6_ : x5_);
    float x12_ = ((b10_ || (x7_ < -0.5)) ? -(x11_) : x11_);
    float x13_ = (b9_ ? x5_ : x6_);
    float x14_ = ((b10_ || (0.5 < x7_)) ? -(x13_) : x13_);
    result.x = x12_;
    result.y = x14_;
    vec2 _e52 = result;
    return _e52;
}

// (sin pix/2, cos pix/2) within 8.5e-8, for x in [-0.5, 0.5].
vec2 etendue_sin_cos_quarters(float x_5) {
    vec2 result_1 = vec2(0.0);
    float x1_1 = (x_5 * x_5);
    float x2_1 = (x_5 * (x1_1 * (x1_1 * (x1_1 * -0.004601658 + 0.07968003) + -0.6459635) + 1.5707964));
    float x3_1 = (x1_1 * (x1_1 * (x1_1 * (x1_1 * 0.0009040217 + -0.020860288) + 0.25366923) + -1.2337005) + 1.0);
    result_1.x = x2_1;
    result_1.y = x3_1;
    vec2 _e22 = result_1;
    return _e22;
}

// Angle of (x, y) in radians, in [-pi, pi], within 2.1e-7 of itself; 0 at the origin.
float etendue_angle(float y, float x_6) {
    float x1_2 = abs(y);
    float x2_2 = abs(x_6);
    float _e4 = etendue_lesser(x1_2, x2_2);
    float _e5 = etendue_greater(x2_2, x1_2);
    bool b5_ = ((_e5 * 0.41421357) < _e4);
    float x6_1 = (b5_ ? (_e4 + _e5) : _e5);
    float x7_1 = ((b5_ ? (_e4 - _e5) : _e4) / ((0.0 < x6_1) ? x6_1 : 1.0));
    float x8_1 = (x7_1 * x7_1);
    float x9_ = ((x7_1 * (x8_1 * (x8_1 * (x8_1 * (x8_1 * 0.0806032 + -0.13879853) + 0.19977927) + -0.33332956)) + x7_1) + (b5_ ? 0.7853982 : 0.0));
    float x10_ = ((x2_2 < x1_2) ? (1.5707964 - x9_) : x9_);
    float _e39 = etendue_copysign(1.0, x_6);
    float x11_1 = (((_e39 < 0.0) && !((_e5 <= 0.0))) ? (3.1415927 - x10_) : x10_);
    float _e47 = etendue_copysign(x11_1, y);
    return _e47;
}

// Maps u, of which each number is in [0, 1), to a point. Points of the unit disk, uniform in area (pdf 1/pi), by
// concentric squares: keeps strata compact. Greatest error: 1.5e-7 in the point (proved for all u: 2.2e-7); 2e-7 in
// invert(sample(u)).
vec2 etendue_concentric_disk_sample(vec2 u) {
    vec2 result_2 = vec2(0.0);
    float x1_3 = (u.x * 2.0 + -1.0);
    float x2_3 = (u.y * 2.0 + -1.0);
    bool b3_ = (abs(x2_3) < abs(x1_3));
    float x4_1 = (b3_ ? x1_3 : x2_3);
    vec2 _e22 = etendue_sin_cos_quarters((((b3_ ? x2_3 : x1_3) * 0.5) / ((0.0 < abs(x4_1)) ? x4_1 : 1.0)));
    float x6_2 = (x4_1 * (b3_ ? _e22.y : _e22.x));
    float x7_2 = (x4_1 * (b3_ ? _e22.x : _e22.y));
    result_2.x = x6_2;
    result_2.y = x7_2;
    vec2 _e34 = result_2;
    return _e34;
}

// The density of a point; 0 outside of the range. Points of the unit disk, uniform in area (pdf 1/pi), by concentric
// squares: keeps strata compact. Greatest error: 1.5e-7 in the point (proved for all u: 2.2e-7); 2e-7 in
// invert(sample(u)).
float etendue_concentric_disk_pdf(vec2 point) {
    float x1_4 = (((point.x * point.x + (point.y * point.y)) <= 1.0000004) ? 0.31830987 : 0.0);
    return x1_4;
}

// Maps u, of which each number is in [0, 1), to a point. Directions with z >= 0 and the pdf z/pi per steradian.
// Greatest error: 1.5e-7 in the direction (proved for all u: 2.4e-7), 2e-7 relative in z (proved off the horizon, for
// the pdf: 2.7e-7).
vec3 etendue_cosine_hemisphere_sample(vec2 u_1) {
    vec3 result_3 = vec3(0.0);
    float x1_5 = (u_1.x * 2.0 + -1.0);
    float x2_4 = (u_1.y * 2.0 + -1.0);
    bool b3_1 = (abs(x2_4) < abs(x1_5));
    float x4_2 = (b3_1 ? x1_5 : x2_4);
    vec2 _e22 = etendue_sin_cos_quarters((((b3_1 ? x2_4 : x1_5) * 0.5) / ((0.0 < abs(x4_2)) ? x4_2 : 1.0)));
    float _e27 = etendue_lesser(u_1.x, (1.0 - u_1.x));
    float _e32 = etendue_lesser(u_1.y, (1.0 - u_1.y));
    float _e33 = etendue_lesser(_e27, _e32);
    float x7_3 = (_e33 + _e33);
    float _e39 = etendue_greater((x7_3 * (2.0 - x7_3)), 0.0);
    float x8_2 = sqrt(_e39);
    float x9_1 = (x4_2 * (b3_1 ? _e22.y : _e22.x));
    float x10_1 = (x4_2 * (b3_1 ? _e22.x : _e22.y));
    result_3.x = x9_1;
    result_3.y = x10_1;
    result_3.z = x8_2;
    vec3 _e53 = result_3;
    return _e53;
}

// The density of a point; 0 outside of the range. Directions with z >= 0 and the pdf z/pi per steradian. Greatest
// error: 1.5e-7 in the direction (proved for all u: 2.4e-7), 2e-7 relative in z (proved off the horizon, for the pdf:
// 2.7e-7).
float etendue_cosine_hemisphere_pdf(vec3 point_1) {
    float _e3 = etendue_greater(point_1.z, 0.0);
    float x1_6 = (_e3 * 0.31830987);
    return x1_6;
}

// Prepares the map. Visible normals of a GGX microsurface, per steradian.
EtendueGgxVisibleNormals etendue_ggx_visible_normals_prepare(float alpha_x, float alpha_y, vec3 wi) {
    EtendueGgxVisibleNormals result_4 = EtendueGgxVisibleNormals(vec2(0.0), vec2(0.0), vec3(0.0), 0.0, 0.0, 0.0, 0.0);
    float _e7 = etendue_greater(abs(wi.x), abs(wi.y));
    float _e10 = etendue_greater(_e7, abs(wi.z));
    float _e11 = etendue_pow2_scale(_e10);
    float x2_5 = (wi.x * _e11);
    float x3_2 = (wi.y * _e11);
    float x4_3 = (wi.z * _e11);
    float x5_1 = (x2_5 * x2_5 + (x3_2 * x3_2 + (x4_3 * x4_3)));
    float x6_3 = ((0.0 < x5_1) ? (1.0 / sqrt(x5_1)) : 0.0);
    float x7_4 = (x2_5 * x6_3);
    float x8_3 = (x3_2 * x6_3);
    float x9_2 = (x4_3 * x6_3);
    bool b10_1 = ((((1e-15 < alpha_x) && (1e-15 < alpha_y)) && (alpha_x < 1000000000000000.0)) && (alpha_y < 1000000000000000.0));
    float x11_2 = (b10_1 ? alpha_x : 1.0);
    float x12_1 = (b10_1 ? alpha_y : 1.0);
    float x13_1 = (1.0 / x11_2);
    float x14_1 = (1.0 / x12_1);
    float x15_ = (x7_4 * x11_2);
    float x16_ = (x8_3 * x12_1);
    float x17_ = (x15_ * x15_ + (x16_ * x16_));
    float x18_ = sqrt((x9_2 * x9_2 + x17_));
    bool b19_ = (0.0 < x18_);
    float x20_ = (1.0 / (b19_ ? x18_ : 1.0));
    float x21_ = (x15_ * x20_);
    float x22_ = (x16_ * x20_);
    float _e68 = etendue_greater((x18_ + abs(x9_2)), 1e-37);
    float x23_ = ((x9_2 < 0.0) ? (x17_ / _e68) : (x9_2 + x18_));
    bool b24_1 = ((b10_1 && b19_) && (1e-33 < x23_));
    float x25_1 = (x20_ * x23_);
    float _e89 = etendue_lesser((b24_1 ? (2.0 / ((x12_1 * (x11_2 * 3.1415927)) * (b24_1 ? x23_ : 1.0))) : 0.0), 3.4028235e38);
    result_4.alpha.x = x11_2;
    result_4.alpha.y = x12_1;
    result_4.inverse_alpha.x = x13_1;
    result_4.inverse_alpha.y = x14_1;
    result_4.view.x = x7_4;
    result_4.view.y = x8_3;
    result_4.view.z = x9_2;
    result_4.stretched_x = x21_;
    result_4.stretched_y = x22_;
    result_4.height = x25_1;
    result_4.scale = _e89;
    EtendueGgxVisibleNormals _e109 = result_4;
    return _e109;
}

// Maps u, of which each number is in [0, 1), to a point. Visible normals of a GGX microsurface, per steradian.
// Greatest error, in units of 2^-24: 8 in the stretched normal, 8 in the pdf relative to its value and to D_v/(wi*m),
// and 24/(1 + w.z) + 16/|c + w| in invert(sample(u)). The last is largest where a grazing view sees normals that turn
// away from it, c -> -w, which have almost no probability; rounding may make such a normal face away, with pdf 0.
vec3 etendue_ggx_visible_normals_sample(EtendueGgxVisibleNormals prepared, vec2 u_2) {
    vec3 result_5 = vec3(0.0);
    float _e4 = etendue_greater(prepared.height, 0.0);
    float _e6 = etendue_lesser(_e4, 2.0);
    float x2_6 = (1.0 - u_2.x);
    float _e17 = etendue_greater(((u_2.x * _e6) * (_e6 * x2_6 + (2.0 - _e6))), 0.0);
    float x3_3 = sqrt(_e17);
    vec2 _e20 = etendue_sin_cos_turns(u_2.y);
    float x5_2 = (prepared.alpha.x * (prepared.stretched_x + (x3_3 * _e20.y)));
    float x6_4 = (prepared.alpha.y * (prepared.stretched_y + (x3_3 * _e20.x)));
    float _e38 = etendue_greater((prepared.height * x2_6), 0.0);
    float _e41 = etendue_greater(abs(x5_2), abs(x6_4));
    float _e43 = etendue_greater(_e41, abs(_e38));
    float _e44 = etendue_pow2_scale(_e43);
    float x9_3 = (x5_2 * _e44);
    float x10_2 = (x6_4 * _e44);
    float x11_3 = (_e38 * _e44);
    float x12_2 = (x9_3 * x9_3 + (x10_2 * x10_2 + (x11_3 * x11_3)));
    float x13_2 = ((0.0 < x12_2) ? (1.0 / sqrt(x12_2)) : 0.0);
    float x14_2 = (x9_3 * x13_2);
    float x15_1 = (x10_2 * x13_2);
    float x16_1 = (x11_3 * x13_2);
    bool b17_1 = (0.5 < (x14_2 * x14_2 + (x15_1 * x15_1 + (x16_1 * x16_1))));
    float x18_1 = (b17_1 ? x14_2 : 0.0);
    float x19_ = (b17_1 ? x15_1 : 0.0);
    float x20_1 = (b17_1 ? x16_1 : 1.0);
    result_5.x = x18_1;
    result_5.y = x19_;
    result_5.z = x20_1;
    vec3 _e76 = result_5;
    return _e76;
}

// The density of a point; 0 outside of the range. Visible normals of a GGX microsurface, per steradian. Greatest
// error, in units of 2^-24: 8 in the stretched normal, 8 in the pdf relative to its value and to D_v/(wi*m), and 24/(1
// + w.z) + 16/|c + w| in invert(sample(u)). The last is largest where a grazing view sees normals that turn away from
// it, c -> -w, which have almost no probability; rounding may make such a normal face away, with pdf 0.
float etendue_ggx_visible_normals_pdf(EtendueGgxVisibleNormals prepared_1, vec3 point_2) {
    float x1_7 = (prepared_1.inverse_alpha.x * point_2.x);
    float x2_7 = (prepared_1.inverse_alpha.y * point_2.y);
    float x3_4 = (x1_7 * x1_7 + (x2_7 * x2_7 + (point_2.z * point_2.z)));
    bool b4_ = ((0.0 <= point_2.z) && (0.0 < x3_4));
    float x5_3 = (1.0 / (b4_ ? x3_4 : 1.0));
    float _e30 = etendue_lesser((x5_3 * (prepared_1.scale * x5_3)), 3.4028235e38);
    float _e45 = etendue_greater((prepared_1.view.x * point_2.x + (prepared_1.view.y * point_2.y + (prepared_1.view.z * point_2.z))), 0.0);
    float x6_5 = ((b4_ ? _e30 : 0.0) * _e45);
    float _e48 = etendue_lesser(x6_5, 3.4028235e38);
    return _e48;
}

// Prepares a light for the shading point p. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian. From inside, every direction.
EtendueSphereBySolidAngle etendue_sphere_by_solid_angle_prepare(EtendueSphere light, vec3 p) {
    float x42_ = 0.0;
    EtendueSphereBySolidAngle result_6 = EtendueSphereBySolidAngle(vec3(0.0), 0.0, vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, 0.0);
    float x1_8 = (light.center.x - p.x);
    float x2_8 = (light.center.y - p.y);
    float x3_5 = (light.center.z - p.z);
    float _e16 = etendue_greater(abs(x1_8), abs(x2_8));
    float _e18 = etendue_greater(_e16, abs(x3_5));
    float _e20 = etendue_from_bits(2139095040u);
    bool b4_1 = (_e18 < _e20);
    float x5_4 = (b4_1 ? x1_8 : 0.0);
    float x6_6 = (b4_1 ? x2_8 : 0.0);
    float x7_5 = (b4_1 ? x3_5 : 0.0);
    float x8_4 = (b4_1 ? light.radius : 0.0);
    float _e33 = etendue_greater(abs(x5_4), abs(x6_6));
    float _e35 = etendue_greater(_e33, abs(x7_5));
    float _e37 = etendue_greater(_e35, abs(x8_4));
    float _e38 = etendue_pow2_scale(_e37);
    float x11_4 = (x5_4 * _e38);
    float x12_3 = (x6_6 * _e38);
    float x13_3 = (x7_5 * _e38);
    float x14_3 = (x8_4 * _e38);
    float x15_2 = (x13_3 * x13_3);
    float x16_2 = (x11_4 * x11_4 + (x12_3 * x12_3 + x15_2));
    float x17_1 = (x14_3 * x14_3);
    bool b18_ = (x16_2 < (x17_1 * 2.0));
    bool b19_1 = (0.0 < x16_2);
    float x20_2 = (1.0 / (b19_1 ? x16_2 : 1.0));
    float x21_1 = sqrt(x16_2);
    float _e57 = etendue_pow2_scale(_e35);
    float x23_1 = (x5_4 * _e57);
    float x24_ = (x6_6 * _e57);
    float x25_2 = (x7_5 * _e57);
    float x26_1 = (x23_1 * x23_1 + (x24_ * x24_ + (x25_2 * x25_2)));
    float x27_ = ((0.0 < x26_1) ? (1.0 / sqrt(x26_1)) : 0.0);
    float x28_ = (x23_1 * x27_);
    float x29_ = (x24_ * x27_);
    float x30_ = (x25_2 * x27_);
    float _e78 = etendue_greater(abs(x28_), abs(x29_));
    float _e80 = etendue_greater(_e78, abs(x30_));
    float x31_ = ((0.0 < _e80) ? x30_ : 1.0);
    float _e84 = etendue_copysign(1.0, x31_);
    float x33_ = (-1.0 / (x31_ + _e84));
    float x34_ = (x33_ * (x28_ * x29_));
    float x35_ = (x28_ * _e84);
    float x36_ = (x28_ * (x33_ * x35_) + 1.0);
    float x37_ = (_e84 * x34_);
    float x38_ = -(x35_);
    float x39_ = (x29_ * (x29_ * x33_) + _e84);
    float x40_ = -(x29_);
    float x41_ = (1.0 / _e38);
    x42_ = (x16_2 - x17_1);
    if (b18_) {
        float x43_ = (x11_4 * x11_4);
        float x44_ = (x12_3 * x12_3);
        float x45_ = (x43_ - x17_1);
        float x46_ = (x45_ - x43_);
        float x47_ = (x44_ + x45_);
        float x48_ = (x47_ - x45_);
        float x49_ = (x15_2 + x47_);
        float x50_ = (x49_ - x47_);
        float x51_ = (((x43_ - (x45_ - x46_)) + (-(x17_1) - x46_)) + ((x45_ - (x47_ - x48_)) + (x44_ - x48_)));
        float x52_ = (((x11_4 * x11_4 + -(x43_)) - (x14_3 * x14_3 + -(x17_1))) + ((x12_3 * x12_3 + -(x44_)) + (x13_3 * x13_3 + -(x15_2))));
        x42_ = (x49_ + ((((x47_ - (x49_ - x50_)) + (x15_2 - x50_)) + x51_) + x52_));
    }
    float _e141 = etendue_lesser((x17_1 * x20_2), 1.0);
    float _e143 = x42_;
    float _e145 = etendue_greater(_e143, 0.0);
    float x53_ = (_e141 / (1.0 + sqrt((x20_2 * _e145))));
    float _e153 = x42_;
    float x54_ = (((0.0 < x14_3) && (0.0 <= x16_2)) ? ((b19_1 && (0.0 <= _e153)) ? x53_ : 2.0) : 0.0);
    result_6.surface_center.x = x1_8;
    result_6.surface_center.y = x2_8;
    result_6.surface_center.z = x3_5;
    result_6.surface_radius = light.radius;
    result_6.shape_frame_s.x = x36_;
    result_6.shape_frame_s.y = x37_;
    result_6.shape_frame_s.z = x38_;
    result_6.shape_frame_t.x = x34_;
    result_6.shape_frame_t.y = x39_;
    result_6.shape_frame_t.z = x40_;
    result_6.shape_frame_n.x = x28_;
    result_6.shape_frame_n.y = x29_;
    result_6.shape_frame_n.z = x31_;
    result_6.shape_cone_one_minus_cos = x54_;
    result_6.shape_distance = x21_1;
    float _e193 = x42_;
    result_6.shape_power = _e193;
    result_6.shape_unit = x41_;
    EtendueSphereBySolidAngle _e195 = result_6;
    return _e195;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian. From inside, every direction. Greatest error: pdf 3.0e-7 relative (proved: 2e-6); direction 4.8e-7
// (proved for all u: 1.5e-6, for R from 1e-4 of the greatest coordinate to where the sphere nearly touches); distance
// 3.6e-7 relative, except at the limb, where its slope is infinite.
EtendueLightSample etendue_sphere_by_solid_angle_sample(EtendueSphereBySolidAngle prepared_2, vec2 u_3) {
    EtendueLightSample result_7 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_9 = (prepared_2.shape_distance * (1.0 - (prepared_2.shape_cone_one_minus_cos * u_3.x)));
    float x2_9 = (1.0 - u_3.x);
    bool b3_2 = (0.0 <= prepared_2.shape_power);
    float x4_4 = (((prepared_2.shape_cone_one_minus_cos * x2_9) * (2.0 - (prepared_2.shape_cone_one_minus_cos * (u_3.x + 1.0)))) * (prepared_2.shape_distance * prepared_2.shape_distance));
    float _e34 = etendue_greater((b3_2 ? x4_4 : (x1_9 * x1_9 + -(prepared_2.shape_power))), 0.0);
    float x5_5 = (sqrt(_e34) + abs(x1_9));
    float _e40 = etendue_greater(prepared_2.shape_cone_one_minus_cos, 0.0);
    float _e42 = etendue_lesser(_e40, 2.0);
    float x7_6 = (u_3.x * _e42);
    float _e50 = etendue_greater((x7_6 * (x2_9 * _e42 + (2.0 - _e42))), 0.0);
    float x8_5 = sqrt(_e50);
    vec2 _e53 = etendue_sin_cos_turns(u_3.y);
    float x10_3 = (x8_5 * _e53.y);
    float x11_5 = (x8_5 * _e53.x);
    float x12_4 = (1.0 - x7_6);
    float x13_4 = (prepared_2.shape_frame_s.x * x10_3 + (prepared_2.shape_frame_t.x * x11_5 + (prepared_2.shape_frame_n.x * x12_4)));
    float x14_4 = (prepared_2.shape_frame_s.y * x10_3 + (prepared_2.shape_frame_t.y * x11_5 + (prepared_2.shape_frame_n.y * x12_4)));
    float x15_3 = (prepared_2.shape_frame_s.z * x10_3 + (prepared_2.shape_frame_t.z * x11_5 + (prepared_2.shape_frame_n.z * x12_4)));
    float x16_3 = ((!(b3_2) && (0.0 <= x1_9)) ? x5_5 : (abs(prepared_2.shape_power) / ((0.0 < x5_5) ? x5_5 : 1.0)));
    float _e102 = etendue_lesser((prepared_2.shape_unit * x16_3), 3.4028235e38);
    float _e110 = etendue_greater(abs(prepared_2.surface_center.x), abs(prepared_2.surface_center.y));
    float _e114 = etendue_greater(_e110, abs(prepared_2.surface_center.z));
    float _e115 = etendue_greater(0.0, _e114);
    float _e118 = etendue_greater(abs(_e102), 0.0);
    float _e120 = etendue_greater(_e118, 0.0);
    float _e121 = etendue_greater(_e115, _e120);
    float _e123 = etendue_from_bits(2139095040u);
    bool b19_2 = (_e121 < _e123);
    float _e125 = etendue_pow2_scale(_e121);
    float x21_2 = (_e125 * (b19_2 ? _e102 : 0.0));
    float x22_1 = (x13_4 * x21_2 + -((_e125 * (b19_2 ? prepared_2.surface_center.x : 0.0))));
    float x23_2 = (x14_4 * x21_2 + -((_e125 * (b19_2 ? prepared_2.surface_center.y : 0.0))));
    float x24_1 = (x15_3 * x21_2 + -((_e125 * (b19_2 ? prepared_2.surface_center.z : 0.0))));
    float x25_3 = (x22_1 * x22_1 + (x23_2 * x23_2 + (x24_1 * x24_1)));
    float x26_2 = ((0.0 < x25_3) ? (1.0 / sqrt(x25_3)) : 0.0);
    float x27_1 = (x22_1 * x26_2);
    float x28_1 = (x23_2 * x26_2);
    float x29_1 = (x24_1 * x26_2);
    float x30_1 = ((0.5 < x29_1) ? ((x27_1 * x27_1 + (x28_1 * x28_1)) / (1.0 + abs(x29_1))) : (1.0 - x29_1));
    float _e177 = etendue_greater((x30_1 / 2.0), 0.0);
    float _e179 = etendue_lesser(_e177, 0.99999994);
    float _e180 = etendue_angle(x28_1, x27_1);
    float x32_ = (_e180 * 0.15915494);
    float _e189 = etendue_greater(((x32_ < 0.0) ? (1.0 + x32_) : x32_), 0.0);
    float _e191 = etendue_lesser(_e189, 0.99999994);
    float x34_1 = ((1e-37 < _e42) ? (0.15915494 / _e42) : 0.0);
    bool b35_ = !((prepared_2.shape_power < 0.0));
    float x36_1 = ((b35_ && (1e-37 < x34_1)) ? (1.0 / x34_1) : 0.0);
    result_7.direction.x = x13_4;
    result_7.direction.y = x14_4;
    result_7.direction.z = x15_3;
    result_7.distance_ = _e102;
    result_7.pdf = x34_1;
    result_7.weight = x36_1;
    result_7.normal.x = x27_1;
    result_7.normal.y = x28_1;
    result_7.normal.z = x29_1;
    result_7.uv.x = _e179;
    result_7.uv.y = _e191;
    result_7.emits = b35_;
    result_7.delta = false;
    EtendueLightSample _e232 = result_7;
    return _e232;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the solid angle
// Omega at the point p: pdf 1/Omega per steradian. From inside, every direction. Greatest error: pdf 3.0e-7 relative
// (proved: 2e-6); direction 4.8e-7 (proved for all u: 1.5e-6, for R from 1e-4 of the greatest coordinate to where the
// sphere nearly touches); distance 3.6e-7 relative, except at the limb, where its slope is infinite.
float etendue_sphere_by_solid_angle_pdf(EtendueSphereBySolidAngle prepared_3, vec3 w) {
    bool b6_ = false;
    float x1_10 = (prepared_3.shape_frame_n.x * w.x + (prepared_3.shape_frame_n.y * w.y + (prepared_3.shape_frame_n.z * w.z)));
    float x2_10 = (1.0 - x1_10);
    float _e18 = etendue_greater(prepared_3.shape_cone_one_minus_cos, 0.0);
    float _e20 = etendue_lesser(_e18, 2.0);
    float x4_5 = (x2_10 - _e20);
    bool b5_1 = (abs(x4_5) <= 3.8146973e-6);
    if (b5_1) {
        float x7_7 = (prepared_3.shape_frame_s.x * w.x + (prepared_3.shape_frame_s.y * w.y + (prepared_3.shape_frame_s.z * w.z)));
        float x8_6 = (prepared_3.shape_frame_t.x * w.x + (prepared_3.shape_frame_t.y * w.y + (prepared_3.shape_frame_t.z * w.z)));
        float x9_4 = ((0.5 < x1_10) ? ((x7_7 * x7_7 + (x8_6 * x8_6)) / (1.0 + abs(x1_10))) : x2_10);
        float _e66 = etendue_greater(sqrt((_e20 * (2.0 - _e20))), (_e20 - 1.0));
        float x10_4 = (_e20 + (5.9604645e-7 * _e66 + 1.7763568e-13));
        b6_ = (x9_4 <= x10_4);
    }
    bool _e82 = b6_;
    float x11_6 = ((((x4_5 < 0.0) && !(b5_1)) || (b5_1 && _e82)) ? ((1e-37 < _e20) ? (0.15915494 / _e20) : 0.0) : 0.0);
    return x11_6;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian. From inside, every direction. Greatest error:
// pdf 3.0e-7 relative (proved: 2e-6); direction 4.8e-7 (proved for all u: 1.5e-6, for R from 1e-4 of the greatest
// coordinate to where the sphere nearly touches); distance 3.6e-7 relative, except at the limb, where its slope is
// infinite.
EtendueLightSample etendue_sphere_by_solid_angle_hit(EtendueSphereBySolidAngle prepared_4, vec3 w_1) {
    bool b46_ = false;
    EtendueLightSample result_8 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_11 = (prepared_4.shape_frame_n.x * w_1.x + (prepared_4.shape_frame_n.y * w_1.y + (prepared_4.shape_frame_n.z * w_1.z)));
    float x2_11 = (1.0 - x1_11);
    float _e18 = etendue_greater(prepared_4.shape_cone_one_minus_cos, 0.0);
    float _e20 = etendue_lesser(_e18, 2.0);
    float x4_6 = (x2_11 - _e20);
    bool b5_2 = (abs(x4_6) <= 3.8146973e-6);
    float _e32 = etendue_greater(abs(prepared_4.surface_center.x), abs(prepared_4.surface_center.y));
    float _e36 = etendue_greater(_e32, abs(prepared_4.surface_center.z));
    float _e37 = etendue_greater(0.0, _e36);
    float _e41 = etendue_greater(abs(prepared_4.surface_radius), 0.0);
    float _e43 = etendue_greater(_e41, 0.0);
    float _e44 = etendue_greater(_e37, _e43);
    float _e46 = etendue_from_bits(2139095040u);
    bool b7_ = (_e44 < _e46);
    float _e48 = etendue_pow2_scale(_e44);
    float x9_5 = (_e48 * (b7_ ? prepared_4.surface_center.x : 0.0));
    float x10_5 = (_e48 * (b7_ ? prepared_4.surface_center.y : 0.0));
    float x11_7 = (_e48 * (b7_ ? prepared_4.surface_center.z : 0.0));
    float x12_5 = (_e48 * (b7_ ? prepared_4.surface_radius : 0.0));
    float x13_5 = (x9_5 * x9_5);
    float x14_5 = (x10_5 * x10_5);
    float x15_4 = (x11_7 * x11_7);
    float x16_4 = (x12_5 * x12_5);
    float x17_2 = (x13_5 - x16_4);
    float x18_2 = (x17_2 - x13_5);
    float x19_1 = (x14_5 + x17_2);
    float x20_3 = (x19_1 - x17_2);
    float x21_3 = (x15_4 + x19_1);
    float x22_2 = (x21_3 - x19_1);
    float x23_3 = (((x13_5 - (x17_2 - x18_2)) + (-(x16_4) - x18_2)) + ((x17_2 - (x19_1 - x20_3)) + (x14_5 - x20_3)));
    float x24_2 = (((x9_5 * x9_5 + -(x13_5)) - (x12_5 * x12_5 + -(x16_4))) + ((x10_5 * x10_5 + -(x14_5)) + (x11_7 * x11_7 + -(x15_4))));
    float x25_4 = (x21_3 + ((((x19_1 - (x21_3 - x22_2)) + (x15_4 - x22_2)) + x23_3) + x24_2));
    float x26_3 = (w_1.x * x9_5 + (w_1.y * x10_5 + (w_1.z * x11_7)));
    float x27_2 = (w_1.x * -(x26_3) + x9_5);
    float x28_2 = (w_1.y * -(x26_3) + x10_5);
    float x29_2 = (w_1.z * -(x26_3) + x11_7);
    float _e127 = etendue_greater((x12_5 * x12_5 + -((x27_2 * x27_2 + (x28_2 * x28_2 + (x29_2 * x29_2))))), 0.0);
    float x30_2 = sqrt(_e127);
    float x31_1 = (x30_2 + abs(x26_3));
    float _e139 = etendue_greater(((1e-37 < abs(x31_1)) ? (abs(x25_4) / x31_1) : 0.0), -1e37);
    float _e141 = etendue_lesser(_e139, 1e37);
    float x33_1 = ((!((0.0 <= x25_4)) && (0.0 <= x26_3)) ? x31_1 : _e141);
    float x34_2 = (w_1.x * x33_1 + -(x9_5));
    float x35_1 = (w_1.y * x33_1 + -(x10_5));
    float x36_2 = (w_1.z * x33_1 + -(x11_7));
    float x37_1 = (x34_2 * x34_2 + (x35_1 * x35_1 + (x36_2 * x36_2)));
    float x38_1 = ((0.0 < x37_1) ? (1.0 / sqrt(x37_1)) : 0.0);
    float x39_1 = (x34_2 * x38_1);
    float x40_1 = (x35_1 * x38_1);
    float x41_1 = (x36_2 * x38_1);
    float x42_1 = ((0.5 < x41_1) ? ((x39_1 * x39_1 + (x40_1 * x40_1)) / (1.0 + abs(x41_1))) : (1.0 - x41_1));
    float _e185 = etendue_greater((x42_1 / 2.0), 0.0);
    float _e187 = etendue_lesser(_e185, 0.99999994);
    float _e189 = etendue_angle(x40_1, x39_1);
    float x44_1 = (0.15915494 * _e189);
    float _e197 = etendue_greater(((x44_1 < 0.0) ? (1.0 + x44_1) : x44_1), 0.0);
    float _e199 = etendue_lesser(_e197, 0.99999994);
    if (b5_2) {
        float x47_1 = (prepared_4.shape_frame_s.x * w_1.x + (prepared_4.shape_frame_s.y * w_1.y + (prepared_4.shape_frame_s.z * w_1.z)));
        float x48_1 = (prepared_4.shape_frame_t.x * w_1.x + (prepared_4.shape_frame_t.y * w_1.y + (prepared_4.shape_frame_t.z * w_1.z)));
        float x49_1 = ((0.5 < x1_11) ? ((x47_1 * x47_1 + (x48_1 * x48_1)) / (1.0 + abs(x1_11))) : x2_11);
        float _e241 = etendue_greater(sqrt((_e20 * (2.0 - _e20))), (_e20 - 1.0));
        float x50_1 = (_e20 + (5.9604645e-7 * _e241 + 1.7763568e-13));
        b46_ = (x49_1 <= x50_1);
    }
    bool _e257 = b46_;
    float x51_1 = ((((x4_6 < 0.0) && !(b5_2)) || (b5_2 && _e257)) ? ((1e-37 < _e20) ? (0.15915494 / _e20) : 0.0) : 0.0);
    bool b52_ = (0.0 < x51_1);
    float _e266 = etendue_lesser((x33_1 / _e48), 3.4028235e38);
    float x53_1 = (b52_ ? _e266 : 0.0);
    bool b54_ = (!((prepared_4.shape_power < 0.0)) && b52_);
    float x55_ = ((b54_ && (1e-37 < x51_1)) ? (1.0 / x51_1) : 0.0);
    result_8.direction.x = w_1.x;
    result_8.direction.y = w_1.y;
    result_8.direction.z = w_1.z;
    result_8.distance_ = x53_1;
    result_8.pdf = x51_1;
    result_8.weight = x55_;
    result_8.normal.x = x39_1;
    result_8.normal.y = x40_1;
    result_8.normal.z = x41_1;
    result_8.uv.x = _e187;
    result_8.uv.y = _e199;
    result_8.emits = b54_;
    result_8.delta = false;
    EtendueLightSample _e306 = result_8;
    return _e306;
}

// Prepares a light for the shading point p. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
EtendueTriangleBySolidAngle etendue_triangle_by_solid_angle_prepare(EtendueTriangle light_1, vec3 p_1) {
    float x199_ = 0.0;
    float x222_ = 0.0;
    float x250_ = 0.0;
    float x251_ = 0.0;
    float x252_ = 0.0;
    float x253_ = 0.0;
    float x254_ = 0.0;
    float x255_ = 0.0;
    float x256_ = 0.0;
    float x257_ = 0.0;
    float x258_ = 0.0;
    float x259_ = 0.0;
    float x260_ = 0.0;
    float x261_ = 0.0;
    float x262_ = 0.0;
    float x263_ = 0.0;
    float x264_ = 0.0;
    float x265_ = 0.0;
    float x266_ = 0.0;
    float x267_ = 0.0;
    float x268_ = 0.0;
    float x269_ = 0.0;
    bool b270_ = false;
    bool b271_ = false;
    bool b272_ = false;
    float x273_ = 0.0;
    float x361_ = 0.0;
    float x362_ = 0.0;
    float x384_ = 0.0;
    EtendueTriangleBySolidAngle result_9 = EtendueTriangleBySolidAngle(vec3(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, vec2(0.0), vec2(0.0), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    float x1_12 = (light_1.v0_.x - p_1.x);
    float x2_12 = (light_1.v0_.y - p_1.y);
    float x3_6 = (light_1.v0_.z - p_1.z);
    float _e20 = etendue_greater(abs(light_1.e1_.x), abs(light_1.e1_.y));
    float _e24 = etendue_greater(_e20, abs(light_1.e1_.z));
    float _e25 = etendue_pow2_scale(_e24);
    float _e27 = etendue_from_bits(2139095040u);
    bool b6_2 = (_e24 < _e27);
    float x7_8 = (_e25 * (b6_2 ? light_1.e1_.x : 0.0));
    float x8_7 = (_e25 * (b6_2 ? light_1.e1_.y : 0.0));
    float x9_6 = (_e25 * (b6_2 ? light_1.e1_.z : 0.0));
    float _e50 = etendue_greater(abs(light_1.e2_.x), abs(light_1.e2_.y));
    float _e54 = etendue_greater(_e50, abs(light_1.e2_.z));
    float _e55 = etendue_pow2_scale(_e54);
    float _e57 = etendue_from_bits(2139095040u);
    bool b12_ = (_e54 < _e57);
    float x13_6 = (_e55 * (b12_ ? light_1.e2_.x : 0.0));
    float x14_6 = (_e55 * (b12_ ? light_1.e2_.y : 0.0));
    float x15_5 = (_e55 * (b12_ ? light_1.e2_.z : 0.0));
    float x16_5 = (x9_6 * x14_6);
    float x17_3 = (x9_6 * x14_6 + -(x16_5));
    float x18_3 = ((x8_7 * x15_5 + -(x16_5)) - x17_3);
    float x19_2 = (x7_8 * x15_5);
    float x20_4 = (x7_8 * x15_5 + -(x19_2));
    float x21_4 = ((x9_6 * x13_6 + -(x19_2)) - x20_4);
    float x22_3 = (x8_7 * x13_6);
    float x23_4 = (x8_7 * x13_6 + -(x22_3));
    float x24_3 = ((x7_8 * x14_6 + -(x22_3)) - x23_4);
    float x25_5 = abs(x18_3);
    float x26_4 = abs(x21_4);
    float _e94 = etendue_greater(x25_5, x26_4);
    float _e96 = etendue_greater(_e94, abs(x24_3));
    float _e97 = etendue_pow2_scale(_e96);
    float x28_3 = (x18_3 * _e97);
    float x29_3 = (x21_4 * _e97);
    float x30_3 = (x24_3 * _e97);
    float x31_2 = (x28_3 * x28_3 + (x29_3 * x29_3 + (x30_3 * x30_3)));
    float x32_1 = ((0.0 < x31_2) ? (1.0 / sqrt(x31_2)) : 0.0);
    float x33_2 = (x28_3 * x32_1);
    float x34_3 = (x29_3 * x32_1);
    float x35_2 = (x30_3 * x32_1);
    float x36_3 = ((x31_2 * x32_1) / _e97);
    float _e119 = etendue_greater(abs(x1_12), abs(x2_12));
    float _e121 = etendue_greater(_e119, abs(x3_6));
    float _e122 = etendue_greater(0.0, _e121);
    float _e123 = etendue_greater(_e122, _e24);
    float _e124 = etendue_greater(_e123, _e54);
    float _e126 = etendue_from_bits(2139095040u);
    bool b39_ = (_e124 < _e126);
    float _e128 = etendue_pow2_scale(_e124);
    float x41_2 = (_e128 * (b39_ ? x1_12 : 0.0));
    float x42_2 = (_e128 * (b39_ ? x2_12 : 0.0));
    float x43_1 = (_e128 * (b39_ ? x3_6 : 0.0));
    float x44_2 = (_e128 * (b39_ ? light_1.e1_.x : 0.0));
    float x45_1 = (_e128 * (b39_ ? light_1.e1_.y : 0.0));
    float x46_1 = (_e128 * (b39_ ? light_1.e1_.z : 0.0));
    float x47_2 = (_e128 * (b39_ ? light_1.e2_.x : 0.0));
    float x48_2 = (_e128 * (b39_ ? light_1.e2_.y : 0.0));
    float x49_2 = (_e128 * (b39_ ? light_1.e2_.z : 0.0));
    float x50_2 = (x24_3 * x43_1);
    float x51_2 = (x18_3 * x41_2 + (x21_4 * x42_2 + x50_2));
    bool b52_1 = (abs((x51_2 + x51_2)) < (x25_5 * abs(x41_2) + (x26_4 * abs(x42_2) + abs(x50_2))));
    float x53_2 = ((x36_3 * (_e128 / _e25)) * (_e128 / _e55));
    float x54_1 = (x33_2 * x53_2);
    float x55_1 = (x34_3 * x53_2);
    float x56_ = (x35_2 * x53_2);
    float x57_ = -((x43_1 * x45_1));
    float x58_ = ((x42_2 * x46_1 + x57_) - (x43_1 * x45_1 + x57_));
    float x59_ = -((x41_2 * x46_1));
    float x60_ = ((x43_1 * x44_2 + x59_) - (x41_2 * x46_1 + x59_));
    float x61_ = -((x42_2 * x44_2));
    float x62_ = ((x41_2 * x45_1 + x61_) - (x42_2 * x44_2 + x61_));
    float x63_ = -((x43_1 * x48_2));
    float x64_ = ((x42_2 * x49_2 + x63_) - (x43_1 * x48_2 + x63_));
    float x65_ = -((x41_2 * x49_2));
    float x66_ = ((x43_1 * x47_2 + x65_) - (x41_2 * x49_2 + x65_));
    float x67_ = -((x42_2 * x47_2));
    float x68_ = ((x41_2 * x48_2 + x67_) - (x42_2 * x47_2 + x67_));
    float x69_ = (1.0 / _e128);
    float x70_ = (light_1.e1_.x + x1_12);
    float x71_ = (light_1.e1_.y + x2_12);
    float x72_ = (light_1.e1_.z + x3_6);
    float x73_ = (light_1.e2_.x + x1_12);
    float x74_ = (light_1.e2_.y + x2_12);
    float x75_ = (light_1.e2_.z + x3_6);
    float _e238 = etendue_greater(abs(x70_), abs(x71_));
    float _e240 = etendue_greater(_e238, abs(x72_));
    float _e241 = etendue_greater(_e122, _e240);
    float _e244 = etendue_greater(abs(x73_), abs(x74_));
    float _e246 = etendue_greater(_e244, abs(x75_));
    float _e247 = etendue_greater(_e241, _e246);
    float _e248 = etendue_greater(_e247, _e24);
    float _e249 = etendue_greater(_e248, _e54);
    float _e251 = etendue_from_bits(2139095040u);
    bool b78_ = (_e249 < _e251);
    float _e253 = etendue_pow2_scale(_e249);
    float x80_ = (_e253 * (b78_ ? x1_12 : 0.0));
    float x81_ = (_e253 * (b78_ ? x2_12 : 0.0));
    float x82_ = (_e253 * (b78_ ? x3_6 : 0.0));
    float x83_ = (_e253 * (b78_ ? x70_ : 0.0));
    float x84_ = (_e253 * (b78_ ? x71_ : 0.0));
    float x85_ = (_e253 * (b78_ ? x72_ : 0.0));
    float x86_ = (_e253 * (b78_ ? x73_ : 0.0));
    float x87_ = (_e253 * (b78_ ? x74_ : 0.0));
    float x88_ = (_e253 * (b78_ ? x75_ : 0.0));
    float x89_ = (_e253 * (b78_ ? light_1.e1_.x : 0.0));
    float x90_ = (_e253 * (b78_ ? light_1.e1_.y : 0.0));
    float x91_ = (_e253 * (b78_ ? light_1.e1_.z : 0.0));
    float x92_ = (_e253 * (b78_ ? light_1.e2_.x : 0.0));
    float x93_ = (_e253 * (b78_ ? light_1.e2_.y : 0.0));
    float x94_ = (_e253 * (b78_ ? light_1.e2_.z : 0.0));
    float x95_ = (x91_ * x93_);
    float x96_ = (x91_ * x93_ + -(x95_));
    float x97_ = ((x90_ * x94_ + -(x95_)) - x96_);
    float x98_ = (x89_ * x94_);
    float x99_ = (x89_ * x94_ + -(x98_));
    float x100_ = ((x91_ * x92_ + -(x98_)) - x99_);
    float x101_ = (x90_ * x92_);
    float x102_ = (x90_ * x92_ + -(x101_));
    float x103_ = ((x89_ * x93_ + -(x101_)) - x102_);
    float x104_ = (x82_ * x103_);
    float x105_ = (x80_ * x97_ + (x81_ * x100_ + x104_));
    float x106_ = (abs(x80_) * abs(x97_) + (abs(x81_) * abs(x100_) + abs(x104_)));
    bool b107_ = (abs((x105_ + x105_)) < x106_);
    float x108_ = (x90_ * x94_);
    float x109_ = (x108_ - x95_);
    float x110_ = (x109_ - x108_);
    float x111_ = (((x108_ - (x109_ - x110_)) + (-(x95_) - x110_)) + ((x90_ * x94_ + -(x108_)) - x96_));
    float x112_ = (x91_ * x92_);
    float x113_ = (x112_ - x98_);
    float x114_ = (x113_ - x112_);
    float x115_ = (((x112_ - (x113_ - x114_)) + (-(x98_) - x114_)) + ((x91_ * x92_ + -(x112_)) - x99_));
    float x116_ = (x89_ * x93_);
    float x117_ = (x116_ - x101_);
    float x118_ = (x117_ - x116_);
    float x119_ = (((x116_ - (x117_ - x118_)) + (-(x101_) - x118_)) + ((x89_ * x93_ + -(x116_)) - x102_));
    float x120_ = (x92_ - x89_);
    float x121_ = (x93_ - x90_);
    float x122_ = (x94_ - x91_);
    float x123_ = (x83_ * x83_ + (x84_ * x84_ + (x85_ * x85_)));
    float x124_ = (x86_ * x86_ + (x87_ * x87_ + (x88_ * x88_)));
    bool b125_ = (x123_ < x124_);
    float x126_ = (b125_ ? x83_ : x86_);
    float x127_ = (b125_ ? x84_ : x87_);
    float x128_ = (b125_ ? x85_ : x88_);
    float x129_ = (x82_ * x90_);
    float x130_ = (x82_ * x90_ + -(x129_));
    float x131_ = ((x81_ * x91_ + -(x129_)) - x130_);
    float x132_ = (x80_ * x91_);
    float x133_ = (x80_ * x91_ + -(x132_));
    float x134_ = ((x82_ * x89_ + -(x132_)) - x133_);
    float x135_ = (x81_ * x89_);
    float x136_ = (x81_ * x89_ + -(x135_));
    float x137_ = ((x80_ * x90_ + -(x135_)) - x136_);
    float x138_ = (x82_ * x93_);
    float x139_ = (x82_ * x93_ + -(x138_));
    float x140_ = ((x81_ * x94_ + -(x138_)) - x139_);
    float x141_ = (x80_ * x94_);
    float x142_ = (x80_ * x94_ + -(x141_));
    float x143_ = ((x82_ * x92_ + -(x141_)) - x142_);
    float x144_ = (x81_ * x92_);
    float x145_ = (x81_ * x92_ + -(x144_));
    float x146_ = ((x80_ * x93_ + -(x144_)) - x145_);
    float x147_ = -((x121_ * x128_));
    float x148_ = -((x122_ * x126_));
    float x149_ = -((x120_ * x127_));
    float x150_ = (x80_ * x80_ + (x81_ * x81_ + (x82_ * x82_)));
    float x151_ = ((1e-36 < x150_) ? (1.0 / sqrt(x150_)) : 0.0);
    float x152_ = ((1e-36 < x123_) ? (1.0 / sqrt(x123_)) : 0.0);
    float x153_ = ((1e-36 < x124_) ? (1.0 / sqrt(x124_)) : 0.0);
    float x154_ = (x80_ * x83_ + (x81_ * x84_ + (x82_ * x85_)));
    float x155_ = (x152_ * (x151_ * x154_));
    float x156_ = (x80_ * x86_ + (x81_ * x87_ + (x82_ * x88_)));
    float x157_ = (x153_ * (x151_ * x156_));
    float x158_ = (x131_ * x131_ + (x134_ * x134_ + (x137_ * x137_)));
    float x159_ = sqrt(x158_);
    float x160_ = ((1e-37 < x158_) ? (1.0 / x159_) : 0.0);
    float x161_ = (x150_ * x151_);
    float x162_ = (x123_ * x152_);
    float x163_ = (x152_ * (x151_ * (x158_ * x160_)));
    float x164_ = (x162_ * (x160_ * x161_));
    float x165_ = (x164_ * 2.0);
    float x166_ = ((x163_ * x163_) / (1.0 + abs(x155_)));
    bool b167_ = (x155_ < 0.0);
    float x168_ = (b167_ ? x166_ : (1.0 + x155_));
    float x169_ = (x164_ * (b167_ ? (1.0 - x155_) : x166_));
    float x170_ = (x83_ * x152_);
    float x171_ = (x84_ * x152_);
    float x172_ = (x85_ * x152_);
    float x173_ = (x80_ * x151_);
    float x174_ = (x81_ * x151_);
    float x175_ = (x82_ * x151_);
    float x176_ = (x170_ + x173_);
    float x177_ = (x171_ + x174_);
    float x178_ = (x172_ + x175_);
    float x179_ = (x131_ * x160_);
    float x180_ = (x134_ * x160_);
    float x181_ = (x137_ * x160_);
    float x182_ = -((x172_ * x180_));
    float x183_ = ((x171_ * x181_ + x182_) - (x172_ * x180_ + x182_));
    float x184_ = -((x170_ * x181_));
    float x185_ = ((x172_ * x179_ + x184_) - (x170_ * x181_ + x184_));
    float x186_ = -((x171_ * x179_));
    float x187_ = ((x170_ * x180_ + x186_) - (x171_ * x179_ + x186_));
    float x188_ = (x153_ * (x86_ * x170_ + (x87_ * x171_ + (x88_ * x172_))));
    float x189_ = (x140_ * x140_ + (x143_ * x143_ + (x146_ * x146_)));
    float x190_ = (x151_ * x153_);
    float x191_ = (x190_ * (x189_ * x190_));
    float _e537 = etendue_lesser(x155_, x157_);
    float _e538 = etendue_lesser(_e537, x188_);
    bool b192_ = (_e538 < -0.5);
    float x193_ = (x83_ * x86_ + (x84_ * x87_ + (x85_ * x88_)));
    float _e551 = etendue_greater((-(x155_) / ((0.0 < x163_) ? x163_ : 1.0)), 1.0);
    float _e553 = etendue_lesser(_e551, 1e18);
    float _e556 = etendue_greater((x159_ * _e553), -(x154_));
    float x195_ = (_e556 * 7.1525574e-7);
    float _e563 = etendue_greater((_e553 * sqrt(x189_)), -(x156_));
    float x196_ = (7.1525574e-7 * _e563);
    float _e565 = etendue_greater(x161_, x162_);
    float _e567 = etendue_greater(_e565, (x124_ * x153_));
    float _e568 = etendue_pow2_scale(_e253);
    if (b52_1) {
        float x200_ = (x8_7 * x15_5);
        float x201_ = (x200_ - x16_5);
        float x202_ = (x201_ - x200_);
        float x203_ = (((x200_ - (x201_ - x202_)) + (-(x16_5) - x202_)) + ((x8_7 * x15_5 + -(x200_)) - x17_3));
        float x204_ = (x9_6 * x13_6);
        float x205_ = (x204_ - x19_2);
        float x206_ = (x205_ - x204_);
        float x207_ = (((x204_ - (x205_ - x206_)) + (-(x19_2) - x206_)) + ((x9_6 * x13_6 + -(x204_)) - x20_4));
        float x208_ = (x7_8 * x14_6);
        float x209_ = (x208_ - x22_3);
        float x210_ = (x209_ - x208_);
        float x211_ = (((x208_ - (x209_ - x210_)) + (-(x22_3) - x210_)) + ((x7_8 * x14_6 + -(x208_)) - x23_4));
        float x212_ = (x41_2 * x201_);
        float x213_ = (x42_2 * x205_);
        float x214_ = (x43_1 * x209_);
        float x215_ = (x212_ + x213_);
        float x216_ = (x215_ - x212_);
        float x217_ = (x214_ + x215_);
        float x218_ = (x217_ - x215_);
        float x219_ = (((x212_ - (x215_ - x216_)) + (x213_ - x216_)) + ((x215_ - (x217_ - x218_)) + (x214_ - x218_)));
        float x220_ = ((x41_2 * x201_ + -(x212_)) + ((x42_2 * x205_ + -(x213_)) + (x43_1 * x209_ + -(x214_))));
        x199_ = (x217_ + ((x219_ + x220_) + (x41_2 * x203_ + (x42_2 * x207_ + (x43_1 * x211_)))));
    }
    float _e637 = x199_;
    float _e645 = etendue_greater(((1e-37 < abs(x36_3)) ? ((b52_1 ? _e637 : x51_2) / x36_3) : 0.0), -1e37);
    float _e647 = etendue_lesser(_e645, 1e37);
    x222_ = x105_;
    if (b107_) {
        float x223_ = (x80_ * x109_);
        float x224_ = (x81_ * x113_);
        float x225_ = (x82_ * x117_);
        float x226_ = (x223_ + x224_);
        float x227_ = (x226_ - x223_);
        float x228_ = (x225_ + x226_);
        float x229_ = (x228_ - x226_);
        float x230_ = (((x223_ - (x226_ - x227_)) + (x224_ - x227_)) + ((x226_ - (x228_ - x229_)) + (x225_ - x229_)));
        float x231_ = ((x80_ * x109_ + -(x223_)) + ((x81_ * x113_ + -(x224_)) + (x82_ * x117_ + -(x225_))));
        x222_ = (x228_ + ((x230_ + x231_) + (x80_ * x111_ + (x81_ * x115_ + (x82_ * x119_)))));
    }
    float _e679 = x222_;
    float x232_ = abs(_e679);
    float x233_ = (x153_ * (x152_ * (x151_ * x232_)));
    float _e684 = x222_;
    bool b234_ = (_e684 < 0.0);
    float x235_ = (x153_ * (x160_ * x232_));
    float x236_ = (b234_ ? -(x179_) : x179_);
    float x237_ = (b234_ ? -(x180_) : x180_);
    float x238_ = (b234_ ? -(x181_) : x181_);
    float x239_ = (x161_ * x232_);
    float x240_ = ((1e-37 < x239_) ? ((x131_ * x140_ + (x134_ * x143_ + (x137_ * x146_))) / x239_) : 0.0);
    bool b241_ = ((((0.0 < x151_) && (0.0 < x152_)) && (0.0 < x153_)) && (0.0 < x233_));
    float x242_ = (1.0 / ((1e-37 < x233_) ? x233_ : 1.0));
    float x243_ = (b234_ ? -(x131_) : x131_);
    float x244_ = (b234_ ? -(x134_) : x134_);
    float x245_ = (b234_ ? -(x137_) : x137_);
    float x246_ = (b234_ ? x140_ : -(x140_));
    float x247_ = (b234_ ? x143_ : -(x143_));
    float x248_ = (b234_ ? x146_ : -(x146_));
    float x249_ = (x168_ * x242_);
    x250_ = ((x122_ * x127_ + x147_) - (x121_ * x128_ + x147_));
    x251_ = ((x120_ * x128_ + x148_) - (x122_ * x126_ + x148_));
    x252_ = ((x121_ * x126_ + x149_) - (x120_ * x127_ + x149_));
    if (b192_) {
        float x274_ = (x81_ * x94_);
        float x275_ = (x274_ - x138_);
        float x276_ = (x275_ - x274_);
        float x277_ = (((x274_ - (x275_ - x276_)) + (-(x138_) - x276_)) + ((x81_ * x94_ + -(x274_)) - x139_));
        float x278_ = (x82_ * x92_);
        float x279_ = (x278_ - x141_);
        float x280_ = (x279_ - x278_);
        float x281_ = (((x278_ - (x279_ - x280_)) + (-(x141_) - x280_)) + ((x82_ * x92_ + -(x278_)) - x142_));
        float x282_ = (x80_ * x93_);
        float x283_ = (x282_ - x144_);
        float x284_ = (x283_ - x282_);
        float x285_ = (((x282_ - (x283_ - x284_)) + (-(x144_) - x284_)) + ((x80_ * x93_ + -(x282_)) - x145_));
        float x286_ = (x81_ * x91_);
        float x287_ = (x129_ - x286_);
        float x288_ = (x287_ - x129_);
        float x289_ = (((x129_ - (x287_ - x288_)) + (-(x286_) - x288_)) + (x130_ - (x81_ * x91_ + -(x286_))));
        float x290_ = (x82_ * x89_);
        float x291_ = (x132_ - x290_);
        float x292_ = (x291_ - x132_);
        float x293_ = (((x132_ - (x291_ - x292_)) + (-(x290_) - x292_)) + (x133_ - (x82_ * x89_ + -(x290_))));
        float x294_ = (x80_ * x90_);
        float x295_ = (x135_ - x294_);
        float x296_ = (x295_ - x135_);
        float x297_ = (((x135_ - (x295_ - x296_)) + (-(x294_) - x296_)) + (x136_ - (x80_ * x90_ + -(x294_))));
        float x298_ = (x275_ + x287_);
        float x299_ = (x298_ - x275_);
        float x300_ = (x279_ + x291_);
        float x301_ = (x300_ - x279_);
        float x302_ = (x283_ + x295_);
        float x303_ = (x302_ - x283_);
        float x304_ = (x109_ + x298_);
        float x305_ = (x304_ - x109_);
        float x306_ = (x113_ + x300_);
        float x307_ = (x306_ - x113_);
        float x308_ = (x117_ + x302_);
        float x309_ = (x308_ - x117_);
        float x310_ = (x111_ + (((x275_ - (x298_ - x299_)) + (x287_ - x299_)) + (x277_ + x289_)));
        float x311_ = (x115_ + (((x279_ - (x300_ - x301_)) + (x291_ - x301_)) + (x281_ + x293_)));
        float x312_ = (x119_ + (((x283_ - (x302_ - x303_)) + (x295_ - x303_)) + (x285_ + x297_)));
        x250_ = (x304_ + (((x109_ - (x304_ - x305_)) + (x298_ - x305_)) + x310_));
        x251_ = (x306_ + (((x113_ - (x306_ - x307_)) + (x300_ - x307_)) + x311_));
        x252_ = (x308_ + (((x117_ - (x308_ - x309_)) + (x302_ - x309_)) + x312_));
        float x313_ = (x83_ - x80_);
        float x314_ = (x84_ - x81_);
        float x315_ = (x85_ - x82_);
        float x316_ = (x313_ * x313_ + (x314_ * x314_ + (x315_ * x315_)));
        bool b317_ = (1e-36 < x316_);
        float x318_ = (1.0 / sqrt((b317_ ? x316_ : 1.0)));
        float x319_ = (x318_ * x318_);
        float x320_ = -((x134_ * x315_));
        float x321_ = -((x137_ * x313_));
        float x322_ = -((x131_ * x314_));
        float x323_ = (x158_ * x319_);
        float x324_ = (x313_ * x318_);
        float x325_ = (x314_ * x318_);
        float x326_ = (x315_ * x318_);
        float x327_ = (x151_ + x152_);
        float x328_ = ((x151_ * (x151_ * x323_)) / (1.0 + (x151_ * abs((x80_ * x324_ + (x81_ * x325_ + (x82_ * x326_)))))));
        float x329_ = ((x152_ * (x152_ * x323_)) / (1.0 + (x152_ * abs((x83_ * x324_ + (x84_ * x325_ + (x85_ * x326_)))))));
        float x330_ = (x328_ - x329_);
        bool b331_ = ((x154_ < 0.0) && b317_);
        x253_ = (b331_ ? ((x319_ * ((x137_ * x314_ + x320_) - (x134_ * x315_ + x320_))) * x327_ + (x324_ * x330_)) : x176_);
        x254_ = (b331_ ? ((x319_ * ((x131_ * x315_ + x321_) - (x137_ * x313_ + x321_))) * x327_ + (x325_ * x330_)) : x177_);
        x255_ = (b331_ ? ((x319_ * ((x134_ * x313_ + x322_) - (x131_ * x314_ + x322_))) * x327_ + (x326_ * x330_)) : x178_);
        x256_ = (x86_ * x153_);
        x257_ = (x87_ * x153_);
        x258_ = (x88_ * x153_);
        float x332_ = (x86_ - x80_);
        float x333_ = (x87_ - x81_);
        float x334_ = (x88_ - x82_);
        float x335_ = (x332_ * x332_ + (x333_ * x333_ + (x334_ * x334_)));
        bool b336_ = (1e-36 < x335_);
        float x337_ = (1.0 / sqrt((b336_ ? x335_ : 1.0)));
        float x338_ = (x337_ * x337_);
        float x339_ = -((x143_ * x334_));
        float x340_ = -((x146_ * x332_));
        float x341_ = -((x140_ * x333_));
        float x342_ = (x189_ * x338_);
        float x343_ = (x332_ * x337_);
        float x344_ = (x333_ * x337_);
        float x345_ = (x334_ * x337_);
        float x346_ = (x151_ + x153_);
        float x347_ = ((x151_ * (x151_ * x342_)) / (1.0 + (x151_ * abs((x80_ * x343_ + (x81_ * x344_ + (x82_ * x345_)))))));
        float x348_ = ((x153_ * (x153_ * x342_)) / (1.0 + (x153_ * abs((x86_ * x343_ + (x87_ * x344_ + (x88_ * x345_)))))));
        float x349_ = (x347_ - x348_);
        bool b350_ = ((x156_ < 0.0) && b336_);
        float _e1012 = x256_;
        x259_ = (b350_ ? ((x338_ * ((x146_ * x333_ + x339_) - (x143_ * x334_ + x339_))) * x346_ + (x343_ * x349_)) : (x173_ + _e1012));
        float _e1021 = x257_;
        x260_ = (b350_ ? ((x338_ * ((x140_ * x334_ + x340_) - (x146_ * x332_ + x340_))) * x346_ + (x344_ * x349_)) : (x174_ + _e1021));
        float _e1030 = x258_;
        x261_ = (b350_ ? ((x338_ * ((x143_ * x332_ + x341_) - (x140_ * x333_ + x341_))) * x346_ + (x345_ * x349_)) : (x175_ + _e1030));
        x262_ = (x86_ - x83_);
        x263_ = (x87_ - x84_);
        x264_ = (x88_ - x85_);
        float _e1042 = x262_;
        float _e1043 = x262_;
        float _e1044 = x263_;
        float _e1045 = x263_;
        float _e1046 = x264_;
        float _e1047 = x264_;
        float x351_ = (_e1042 * _e1043 + (_e1044 * _e1045 + (_e1046 * _e1047)));
        bool b352_ = (1e-36 < x351_);
        float x353_1 = (1.0 / sqrt((b352_ ? x351_ : 1.0)));
        x265_ = (x353_1 * x353_1);
        float _e1059 = x262_;
        x266_ = (_e1059 * x353_1);
        float _e1061 = x263_;
        x267_ = (_e1061 * x353_1);
        float _e1063 = x264_;
        x268_ = (_e1063 * x353_1);
        x269_ = (x152_ + x153_);
        b270_ = ((x193_ < 0.0) && b352_);
        b271_ = (x188_ < 0.0);
        b272_ = (x157_ < 0.0);
        x273_ = (x191_ / (1.0 + abs(x157_)));
    }
    float _e1077 = x250_;
    float _e1078 = x250_;
    float _e1079 = x251_;
    float _e1080 = x251_;
    float _e1081 = x252_;
    float _e1082 = x252_;
    float x354_ = (_e1077 * _e1078 + (_e1079 * _e1080 + (_e1081 * _e1082)));
    float _e1088 = x273_;
    bool _e1089 = b272_;
    float x355_ = ((b192_ && _e1089) ? _e1088 : (1.0 + x157_));
    float _e1092 = x250_;
    float _e1093 = x250_;
    float x356_ = (b234_ ? -(_e1093) : _e1092);
    float _e1096 = x251_;
    float _e1097 = x251_;
    float x357_ = (b234_ ? -(_e1097) : _e1096);
    float _e1100 = x252_;
    float _e1101 = x252_;
    float x358_ = (b234_ ? -(_e1101) : _e1100);
    float _e1107 = etendue_greater(x191_, 1e-7);
    float _e1111 = etendue_greater(_e553, (-(x157_) * (1.0 / sqrt(_e1107))));
    float x359_ = (_e1111 * sqrt(x354_));
    float _e1116 = etendue_greater(x359_, -(x193_));
    float x360_ = (7.1525574e-7 * _e1116);
    x361_ = (x153_ * (x86_ * x176_ + (x87_ * x177_ + (x88_ * x178_))) + x168_);
    x362_ = (x153_ * (x120_ * x183_ + (x121_ * x185_ + (x122_ * x187_))));
    if (b192_) {
        float _e1128 = x251_;
        float _e1129 = x264_;
        float x363_ = -((_e1128 * _e1129));
        float _e1132 = x252_;
        float _e1133 = x262_;
        float x364_ = -((_e1132 * _e1133));
        float _e1136 = x250_;
        float _e1137 = x263_;
        float x365_ = -((_e1136 * _e1137));
        float _e1140 = x265_;
        float x366_ = (_e1140 * x354_);
        float _e1145 = x266_;
        float _e1146 = x267_;
        float _e1147 = x268_;
        float x367_ = ((x152_ * (x152_ * x366_)) / (1.0 + (x152_ * abs((x83_ * _e1145 + (x84_ * _e1146 + (x85_ * _e1147)))))));
        float _e1158 = x266_;
        float _e1159 = x267_;
        float _e1160 = x268_;
        float x368_ = ((x153_ * (x153_ * x366_)) / (1.0 + (x153_ * abs((x86_ * _e1158 + (x87_ * _e1159 + (x88_ * _e1160)))))));
        float x369_ = (x367_ - x368_);
        float _e1169 = x256_;
        float _e1171 = x265_;
        float _e1172 = x252_;
        float _e1173 = x263_;
        float _e1175 = x251_;
        float _e1176 = x264_;
        float _e1180 = x269_;
        float _e1181 = x266_;
        bool _e1184 = b270_;
        float x370_ = (_e1184 ? ((_e1171 * ((_e1172 * _e1173 + x363_) - (_e1175 * _e1176 + x363_))) * _e1180 + (_e1181 * x369_)) : (x170_ + _e1169));
        float _e1186 = x257_;
        float _e1188 = x265_;
        float _e1189 = x250_;
        float _e1190 = x264_;
        float _e1192 = x252_;
        float _e1193 = x262_;
        float _e1197 = x269_;
        float _e1198 = x267_;
        bool _e1201 = b270_;
        float x371_ = (_e1201 ? ((_e1188 * ((_e1189 * _e1190 + x364_) - (_e1192 * _e1193 + x364_))) * _e1197 + (_e1198 * x369_)) : (x171_ + _e1186));
        float _e1203 = x258_;
        float _e1205 = x265_;
        float _e1206 = x251_;
        float _e1207 = x262_;
        float _e1209 = x250_;
        float _e1210 = x263_;
        float _e1214 = x269_;
        float _e1215 = x268_;
        bool _e1218 = b270_;
        float x372_ = (_e1218 ? ((_e1205 * ((_e1206 * _e1207 + x365_) - (_e1209 * _e1210 + x365_))) * _e1214 + (_e1215 * x369_)) : (x172_ + _e1203));
        float _e1220 = x253_;
        float _e1221 = x259_;
        float _e1222 = x254_;
        float _e1223 = x260_;
        float _e1224 = x255_;
        float _e1225 = x261_;
        float _e1229 = x253_;
        float _e1230 = x254_;
        float _e1231 = x255_;
        float x373_ = ((x188_ < x157_) ? (_e1229 * x370_ + (_e1230 * x371_ + (_e1231 * x372_))) : (_e1220 * _e1221 + (_e1222 * _e1223 + (_e1224 * _e1225))));
        float _e1237 = x259_;
        float _e1238 = x260_;
        float _e1239 = x261_;
        float _e1243 = etendue_greater(x157_, x188_);
        x361_ = ((_e1243 < x155_) ? (_e1237 * x370_ + (_e1238 * x371_ + (_e1239 * x372_))) : x373_);
        float _e1246 = x250_;
        float _e1247 = x251_;
        float _e1248 = x252_;
        x362_ = -((x153_ * (x152_ * (x160_ * (x131_ * _e1246 + (x134_ * _e1247 + (x137_ * _e1248)))))));
    }
    float _e1258 = x361_;
    float _e1259 = etendue_angle(x233_, _e1258);
    float x374_ = (b241_ ? (2.0 * _e1259) : 0.0);
    float _e1262 = x361_;
    float _e1263 = x361_;
    float _e1267 = etendue_greater((x233_ * x233_ + (_e1262 * _e1263)), 1e-36);
    float x376_ = (1.0 / sqrt(_e1267));
    float x377_ = (x233_ * x376_);
    float _e1272 = x361_;
    float x378_ = (_e1272 * x376_);
    float x379_ = (x376_ * (x242_ * _e1267));
    float x380_ = (x379_ * (x163_ * 0.5));
    bool b381_ = (x380_ < 1e30);
    float _e1281 = x361_;
    float x382_ = (_e1281 * x242_);
    float _e1283 = x361_;
    float x383_ = (_e1283 - x168_);
    if (b192_) {
        float _e1286 = x362_;
        float _e1287 = x362_;
        x384_ = ((_e1286 * _e1287 + (x235_ * x235_)) / (1.0 + abs(x188_)));
    }
    float _e1297 = x384_;
    bool _e1298 = b271_;
    float _e1302 = etendue_greater(((b192_ && _e1298) ? _e1297 : (1.0 + x188_)), 1e-30);
    float x385_ = (1.0 / _e1302);
    float _e1308 = etendue_lesser((x380_ * (x235_ * x385_)), 1e18);
    float x386_ = (b381_ ? _e1308 : 0.0);
    float _e1311 = x362_;
    float _e1316 = etendue_greater((x380_ * (_e1311 * -(x385_) + x169_)), -1e18);
    float _e1318 = etendue_lesser(_e1316, 1e18);
    float x387_ = (b381_ ? _e1318 : 0.0);
    result_9.surface_plane_cross.x = x54_1;
    result_9.surface_plane_cross.y = x55_1;
    result_9.surface_plane_cross.z = x56_;
    result_9.surface_plane_normal.x = x33_2;
    result_9.surface_plane_normal.y = x34_3;
    result_9.surface_plane_normal.z = x35_2;
    result_9.surface_plane_height = _e647;
    result_9.surface_plane_along_first.x = x58_;
    result_9.surface_plane_along_first.y = x60_;
    result_9.surface_plane_along_first.z = x62_;
    result_9.surface_plane_along_second.x = x64_;
    result_9.surface_plane_along_second.y = x66_;
    result_9.surface_plane_along_second.z = x68_;
    result_9.surface_plane_unit = x69_;
    result_9.shape_side01_.x = x243_;
    result_9.shape_side01_.y = x244_;
    result_9.shape_side01_.z = x245_;
    result_9.shape_side12_.x = x356_;
    result_9.shape_side12_.y = x357_;
    result_9.shape_side12_.z = x358_;
    result_9.shape_side20_.x = x246_;
    result_9.shape_side20_.y = x247_;
    result_9.shape_side20_.z = x248_;
    result_9.shape_slack.x = x195_;
    result_9.shape_slack.y = x360_;
    result_9.shape_slack.z = x196_;
    result_9.shape_normal.x = x97_;
    result_9.shape_normal.y = x100_;
    result_9.shape_normal.z = x103_;
    result_9.shape_l1_ = x162_;
    result_9.shape_farthest = _e567;
    result_9.shape_apex.x = x170_;
    result_9.shape_apex.y = x171_;
    result_9.shape_apex.z = x172_;
    result_9.shape_along.x = x183_;
    result_9.shape_along.y = x185_;
    result_9.shape_along.z = x187_;
    result_9.shape_across.x = x236_;
    result_9.shape_across.y = x237_;
    result_9.shape_across.z = x238_;
    result_9.shape_cot_alpha = x240_;
    result_9.shape_stretch = x165_;
    result_9.shape_tan_half = x169_;
    result_9.shape_half.x = x377_;
    result_9.shape_half.y = x378_;
    result_9.shape_turned.x = x386_;
    result_9.shape_turned.y = x387_;
    result_9.shape_sin_side = x163_;
    result_9.shape_inv_l0_ = x151_;
    result_9.shape_inv_l2_ = x153_;
    result_9.shape_cot_half = x382_;
    result_9.shape_inv_half_sin = x379_;
    result_9.shape_g2_ = x168_;
    result_9.shape_g2_over_g0_ = x249_;
    result_9.shape_one_plus_d02_ = x355_;
    result_9.shape_sin02_squared = x191_;
    float _e1418 = x362_;
    result_9.shape_x2_ = _e1418;
    result_9.shape_y2_ = x235_;
    result_9.shape_g1_ = x383_;
    float _e1422 = x222_;
    result_9.shape_volume = _e1422;
    result_9.shape_solid_angle = x374_;
    result_9.shape_unit = _e568;
    EtendueTriangleBySolidAngle _e1425 = result_9;
    return _e1425;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian. Greatest error over the atlas (size, elevation, aspect ratio and distance), for edges taken as given:
// Omega 5e-7 relative, except 7e-5 beside the middle of an edge that is a million times longer than the triangle is
// wide and than the point is far; direction 5.4e-7 (1.4e-5 of the angular size where that nears pi); distance 5.4e-7
// of itself over |cos| at the plane, and 5.4e-7 of the farthest vertex's. The inverse is that of a direction 6e-7
// away, times the triangle's apparent aspect ratio. From less than 1e-3 of its size above the plane of a triangle that
// surrounds the point, most of u0 lies within the rounding of a direction near the ends of the sweep: there u1 follows
// from the rounded u0, so that both lead back to the direction, and may itself be another one.
EtendueLightSample etendue_triangle_by_solid_angle_sample(EtendueTriangleBySolidAngle prepared_5, vec2 u_4) {
    bool b24_ = false;
    float x25_ = 0.0;
    float x26_ = 0.0;
    EtendueLightSample result_10 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    bool b1_ = (0.5 < u_4.x);
    vec2 _e14 = etendue_sin_cos_turns(((prepared_5.shape_solid_angle * (b1_ ? (1.0 - u_4.x) : u_4.x)) * 0.07957747));
    float x3_7 = (b1_ ? ((prepared_5.shape_half.x * _e14.y) - (prepared_5.shape_half.y * _e14.x)) : _e14.x);
    float x4_7 = (b1_ ? prepared_5.shape_turned.x : 1.0);
    float x5_6 = (b1_ ? prepared_5.shape_turned.y : -(prepared_5.shape_cot_alpha));
    float x6_7 = (_e14.y * x5_6 + -((_e14.x * x4_7)));
    float x7_9 = (prepared_5.shape_stretch * x3_7);
    float _e48 = etendue_greater(((b1_ ? x6_7 : -(x6_7)) * -(x7_9) + prepared_5.shape_tan_half), -1000000000000000.0);
    float _e50 = etendue_lesser(_e48, 1000000000000000.0);
    float _e57 = etendue_greater(((_e14.y * x4_7 + (_e14.x * x5_6)) * x7_9), 0.0);
    float _e59 = etendue_lesser(_e57, 1000000000000000.0);
    float x10_6 = (b1_ ? (prepared_5.shape_inv_half_sin * _e14.x) : (prepared_5.shape_cot_half * -(_e14.x) + _e14.y));
    bool b11_ = (prepared_5.shape_g2_ < 0.5);
    float x12_6 = (prepared_5.shape_g2_over_g0_ * x3_7);
    float _e78 = etendue_greater((x10_6 * (x12_6 + (x10_6 + x12_6))), 0.0);
    float x14_7 = (2.0 * x12_6);
    float _e85 = etendue_greater((x14_7 * (prepared_5.shape_one_plus_d02_ * x12_6 + x10_6)), 0.0);
    float x16_6 = ((prepared_5.shape_one_plus_d02_ * (x12_6 * x14_7)) - (x10_6 * x10_6));
    float _e99 = etendue_greater((x16_6 * x16_6 + (_e85 * (_e78 * (prepared_5.shape_one_plus_d02_ * 2.0)))), 1e-30);
    float x17_4 = (1.0 / sqrt(_e99));
    float x18_4 = (_e78 * x17_4);
    float x19_3 = (_e85 * x17_4);
    float x20_5 = (1.0 - u_4.y);
    float _e117 = etendue_greater(((1e-37 < abs(prepared_5.shape_solid_angle)) ? (1.0 / prepared_5.shape_solid_angle) : 0.0), -1e37);
    float _e119 = etendue_lesser(_e117, 1e37);
    bool b22_ = (prepared_5.shape_volume < 0.0);
    float x23_5 = ((b22_ && (1e-37 < _e119)) ? (1.0 / _e119) : 0.0);
    if (b11_) {
        float x27_3 = (x19_3 * (prepared_5.shape_one_plus_d02_ - 1.0) + x18_4);
        float _e144 = etendue_greater(x27_3, 0.0);
        float x28_4 = ((0.0 < x27_3) ? ((prepared_5.shape_sin02_squared * (x19_3 * x19_3)) / (1.0 + _e144)) : (1.0 - x27_3));
        float x29_4 = (prepared_5.shape_g2_ * x18_4 + (x28_4 + (prepared_5.shape_g1_ * x19_3)));
        float _e157 = etendue_greater(x29_4, 1e-30);
        float x30_4 = (1.0 / _e157);
        float x31_3 = (x30_4 * (prepared_5.shape_sin_side * x18_4));
        float x32_2 = (x30_4 * (prepared_5.shape_x2_ * x19_3));
        bool b33_ = ((((prepared_5.shape_g2_ * x18_4 + (x28_4 + (x19_3 * abs(prepared_5.shape_g1_)))) * 0.125) < x29_4) && (0.5 < (x18_4 + x19_3)));
        float _e182 = etendue_greater(prepared_5.shape_tan_half, abs(_e50));
        b24_ = (b33_ && ((x31_3 + abs(x32_2)) < _e182));
        float _e187 = etendue_greater((x31_3 + x32_2), -1000000000000000.0);
        float _e189 = etendue_lesser(_e187, 1000000000000000.0);
        x25_ = _e189;
        float _e194 = etendue_lesser((x30_4 * (prepared_5.shape_y2_ * x19_3)), 1000000000000000.0);
        x26_ = _e194;
    }
    float _e195 = x25_;
    bool _e196 = b24_;
    float x34_4 = (_e196 ? _e195 : _e50);
    float _e198 = x26_;
    bool _e199 = b24_;
    float x35_3 = (_e199 ? _e198 : _e59);
    float x36_4 = (x34_4 * x34_4 + (x35_3 * x35_3));
    float x37_2 = (1.0 + x36_4);
    float x38_2 = (2.0 / x37_2);
    float x39_2 = (u_4.y * x38_2);
    float x40_2 = (x36_4 * -(x39_2) + 1.0);
    float _e217 = etendue_greater((x39_2 * (x38_2 * (x36_4 * x20_5 + 1.0))), 0.0);
    float x41_3 = sqrt(_e217);
    float x42_3 = (prepared_5.shape_apex.x * x40_2 + (x41_3 * (prepared_5.shape_along.x * x34_4 + (prepared_5.shape_across.x * x35_3))));
    float x43_2 = (prepared_5.shape_apex.y * x40_2 + (x41_3 * (prepared_5.shape_along.y * x34_4 + (prepared_5.shape_across.y * x35_3))));
    float x44_3 = (prepared_5.shape_apex.z * x40_2 + (x41_3 * (prepared_5.shape_along.z * x34_4 + (prepared_5.shape_across.z * x35_3))));
    float x45_2 = ((x42_3 * x42_3 + (x43_2 * x43_2 + (x44_3 * x44_3))) * -0.5 + 1.5);
    float x46_2 = (x42_3 * x45_2);
    float x47_3 = (x43_2 * x45_2);
    float x48_3 = (x44_3 * x45_2);
    float x49_3 = (x37_2 * (0.5 * x41_3));
    bool b50_ = (1.0 < x36_4);
    float x51_3 = (abs((1.0 - x36_4)) / x37_2);
    float x52_1 = ((1.0 + x51_3) * (x49_3 * x51_3 + x40_2));
    float x53_3 = ((x20_5 * (x40_2 + x51_3)) / ((0.0 < x52_1) ? x52_1 : 1.0));
    float x54_2 = (b50_ ? abs((prepared_5.shape_normal.x * x46_2 + (prepared_5.shape_normal.y * x47_3 + (prepared_5.shape_normal.z * x48_3)))) : (x49_3 * (prepared_5.shape_l1_ * (prepared_5.shape_inv_l0_ * x18_4 + (prepared_5.shape_inv_l2_ * x19_3))) + x53_3));
    bool b55_ = ((0.0 < x54_2) && (0.0 < prepared_5.shape_solid_angle));
    float _e311 = etendue_lesser(((b50_ ? abs(prepared_5.shape_volume) : prepared_5.shape_l1_) / (b55_ ? x54_2 : 1.0)), prepared_5.shape_farthest);
    float x56_1 = (b55_ ? _e311 : 0.0);
    float _e318 = etendue_lesser((x56_1 * (prepared_5.shape_inv_l2_ * (x19_3 * x49_3))), 1.0);
    float _e325 = etendue_lesser((x56_1 * (prepared_5.shape_inv_l0_ * (x18_4 * x49_3))), 1.0);
    float _e329 = etendue_greater(((1.0 - _e325) - _e318), 0.0);
    float _e332 = etendue_greater(prepared_5.shape_l1_, 1e-37);
    float _e336 = etendue_lesser((x56_1 * (x53_3 / _e332)), 1.0);
    float x59_1 = (b50_ ? _e329 : _e336);
    float _e341 = etendue_lesser((prepared_5.shape_unit * x56_1), 3.4028235e38);
    result_10.direction.x = x46_2;
    result_10.direction.y = x47_3;
    result_10.direction.z = x48_3;
    result_10.distance_ = _e341;
    result_10.pdf = _e119;
    result_10.weight = x23_5;
    result_10.normal.x = prepared_5.surface_plane_normal.x;
    result_10.normal.y = prepared_5.surface_plane_normal.y;
    result_10.normal.z = prepared_5.surface_plane_normal.z;
    result_10.uv.x = x59_1;
    result_10.uv.y = _e318;
    result_10.emits = b22_;
    result_10.delta = false;
    EtendueLightSample _e371 = result_10;
    return _e371;
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
float etendue_triangle_by_solid_angle_pdf(EtendueTriangleBySolidAngle prepared_6, vec3 w_2) {
    bool b8_ = false;
    float x1_13 = (prepared_6.shape_side01_.x * w_2.x + (prepared_6.shape_side01_.y * w_2.y + (prepared_6.shape_side01_.z * w_2.z)));
    float x2_13 = (prepared_6.shape_side20_.x * w_2.x + (prepared_6.shape_side20_.y * w_2.y + (prepared_6.shape_side20_.z * w_2.z)));
    float x3_8 = (prepared_6.shape_normal.x * w_2.x + (prepared_6.shape_normal.y * w_2.y + (prepared_6.shape_normal.z * w_2.z)));
    float x4_8 = ((prepared_6.shape_volume < 0.0) ? -(x3_8) : x3_8);
    float _e49 = etendue_greater(abs(prepared_6.shape_side01_.x), abs(prepared_6.shape_side01_.y));
    float _e53 = etendue_greater(_e49, abs(prepared_6.shape_side01_.z));
    float _e60 = etendue_greater(abs(prepared_6.shape_side20_.x), abs(prepared_6.shape_side20_.y));
    float _e64 = etendue_greater(_e60, abs(prepared_6.shape_side20_.z));
    float x5_7 = (_e53 + _e64);
    float _e72 = etendue_greater(abs(prepared_6.shape_normal.x), abs(prepared_6.shape_normal.y));
    float _e76 = etendue_greater(_e72, abs(prepared_6.shape_normal.z));
    float x6_8 = ((x5_7 + _e76) * 1.9073486e-6);
    bool b7_1 = ((((0.0 <= x1_13) && (0.0 <= x2_13)) && (0.0 <= x4_8)) && (x6_8 < ((x4_8 - x2_13) - x1_13)));
    if (!(b7_1)) {
        bool b9_1 = ((-(prepared_6.shape_slack.y) <= (prepared_6.shape_side12_.x * w_2.x + (prepared_6.shape_side12_.y * w_2.y + (prepared_6.shape_side12_.z * w_2.z)))) && (-(prepared_6.shape_slack.z) <= x2_13));
        bool b10_2 = (-((sqrt((prepared_6.shape_normal.x * prepared_6.shape_normal.x + (prepared_6.shape_normal.y * prepared_6.shape_normal.y + (prepared_6.shape_normal.z * prepared_6.shape_normal.z)))) * 7.1525574e-7)) <= x4_8);
        b8_ = ((b9_1 && (-(prepared_6.shape_slack.x) <= x1_13)) && b10_2);
    }
    float _e152 = etendue_greater(((1e-37 < abs(prepared_6.shape_solid_angle)) ? (1.0 / prepared_6.shape_solid_angle) : 0.0), -1e37);
    float _e154 = etendue_lesser(_e152, 1e37);
    bool _e155 = b8_;
    float x11_8 = ((b7_1 || _e155) ? _e154 : 0.0);
    return x11_8;
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
EtendueLightSample etendue_triangle_by_solid_angle_hit(EtendueTriangleBySolidAngle prepared_7, vec3 w_3) {
    bool b17_ = false;
    EtendueLightSample result_11 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_14 = (prepared_7.shape_side01_.x * w_3.x + (prepared_7.shape_side01_.y * w_3.y + (prepared_7.shape_side01_.z * w_3.z)));
    float x2_14 = (prepared_7.shape_side20_.x * w_3.x + (prepared_7.shape_side20_.y * w_3.y + (prepared_7.shape_side20_.z * w_3.z)));
    float x3_9 = (prepared_7.shape_normal.x * w_3.x + (prepared_7.shape_normal.y * w_3.y + (prepared_7.shape_normal.z * w_3.z)));
    bool b4_2 = (prepared_7.shape_volume < 0.0);
    float x5_8 = (b4_2 ? -(x3_9) : x3_9);
    float _e49 = etendue_greater(abs(prepared_7.shape_side01_.x), abs(prepared_7.shape_side01_.y));
    float _e53 = etendue_greater(_e49, abs(prepared_7.shape_side01_.z));
    float _e60 = etendue_greater(abs(prepared_7.shape_side20_.x), abs(prepared_7.shape_side20_.y));
    float _e64 = etendue_greater(_e60, abs(prepared_7.shape_side20_.z));
    float x6_9 = (_e53 + _e64);
    float _e72 = etendue_greater(abs(prepared_7.shape_normal.x), abs(prepared_7.shape_normal.y));
    float _e76 = etendue_greater(_e72, abs(prepared_7.shape_normal.z));
    float x7_10 = ((x6_9 + _e76) * 1.9073486e-6);
    bool b8_1 = ((((0.0 <= x1_14) && (0.0 <= x2_14)) && (0.0 <= x5_8)) && (x7_10 < ((x5_8 - x2_14) - x1_14)));
    float x9_7 = (prepared_7.surface_plane_cross.x * w_3.x + (prepared_7.surface_plane_cross.y * w_3.y + (prepared_7.surface_plane_cross.z * w_3.z)));
    bool b10_3 = (1e-37 < abs(x9_7));
    float _e124 = etendue_greater((b10_3 ? (-((prepared_7.surface_plane_along_second.x * w_3.x + (prepared_7.surface_plane_along_second.y * w_3.y + (prepared_7.surface_plane_along_second.z * w_3.z)))) / x9_7) : 0.0), -1e37);
    float _e141 = etendue_greater((b10_3 ? ((prepared_7.surface_plane_along_first.x * w_3.x + (prepared_7.surface_plane_along_first.y * w_3.y + (prepared_7.surface_plane_along_first.z * w_3.z))) / x9_7) : 0.0), -1e37);
    float _e143 = etendue_lesser(_e141, 1e37);
    float _e145 = etendue_lesser(_e124, 1e37);
    float _e147 = etendue_greater(_e145, 0.0);
    float _e149 = etendue_lesser(_e147, 1.0);
    float _e151 = etendue_greater(_e143, 0.0);
    float _e153 = etendue_lesser(_e151, 1.0);
    float x15_6 = (prepared_7.surface_plane_normal.x * w_3.x + (prepared_7.surface_plane_normal.y * w_3.y + (prepared_7.surface_plane_normal.z * w_3.z)));
    float _e174 = etendue_greater(((1e-37 < abs(x15_6)) ? (prepared_7.surface_plane_height / x15_6) : 0.0), -1e37);
    float _e176 = etendue_lesser(_e174, 1e37);
    float _e178 = etendue_greater(_e176, 0.0);
    if (!(b8_1)) {
        bool b18_1 = ((-(prepared_7.shape_slack.y) <= (prepared_7.shape_side12_.x * w_3.x + (prepared_7.shape_side12_.y * w_3.y + (prepared_7.shape_side12_.z * w_3.z)))) && (-(prepared_7.shape_slack.z) <= x2_14));
        bool b19_3 = (-((sqrt((prepared_7.shape_normal.x * prepared_7.shape_normal.x + (prepared_7.shape_normal.y * prepared_7.shape_normal.y + (prepared_7.shape_normal.z * prepared_7.shape_normal.z)))) * 7.1525574e-7)) <= x5_8);
        b17_ = ((b18_1 && (-(prepared_7.shape_slack.x) <= x1_14)) && b19_3);
    }
    float _e239 = etendue_greater(((1e-37 < abs(prepared_7.shape_solid_angle)) ? (1.0 / prepared_7.shape_solid_angle) : 0.0), -1e37);
    float _e241 = etendue_lesser(_e239, 1e37);
    bool _e242 = b17_;
    float x20_6 = ((b8_1 || _e242) ? _e241 : 0.0);
    bool b21_ = (0.0 < x20_6);
    float _e251 = etendue_lesser((prepared_7.surface_plane_unit * _e178), 3.4028235e38);
    float x22_4 = (b21_ ? _e251 : 0.0);
    bool b23_ = (b4_2 && b21_);
    float x24_4 = ((b23_ && (1e-37 < x20_6)) ? (1.0 / x20_6) : 0.0);
    result_11.direction.x = w_3.x;
    result_11.direction.y = w_3.y;
    result_11.direction.z = w_3.z;
    result_11.distance_ = x22_4;
    result_11.pdf = x20_6;
    result_11.weight = x24_4;
    result_11.normal.x = prepared_7.surface_plane_normal.x;
    result_11.normal.y = prepared_7.surface_plane_normal.y;
    result_11.normal.z = prepared_7.surface_plane_normal.z;
    result_11.uv.x = _e149;
    result_11.uv.y = _e153;
    result_11.emits = b23_;
    result_11.delta = false;
    EtendueLightSample _e293 = result_11;
    return _e293;
}

// Prepares a light for the shading point p. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
EtendueRectangleBySolidAngle etendue_rectangle_by_solid_angle_prepare(EtendueRectangle light_2, vec3 p_2) {
    float x353_ = 0.0;
    float x469_ = 0.0;
    EtendueRectangleBySolidAngle result_12 = EtendueRectangleBySolidAngle(vec3(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec2(0.0), vec2(0.0), vec3(0.0), vec2(0.0), vec2(0.0), vec2(0.0), 0.0, vec2(0.0), vec2(0.0), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    float x1_15 = (light_2.corner.x - p_2.x);
    float x2_15 = (light_2.corner.y - p_2.y);
    float x3_10 = (light_2.corner.z - p_2.z);
    float _e16 = etendue_greater(abs(x1_15), abs(x2_15));
    float _e18 = etendue_greater(_e16, abs(x3_10));
    float _e25 = etendue_greater(abs(light_2.edge_s.x), abs(light_2.edge_s.y));
    float _e29 = etendue_greater(_e25, abs(light_2.edge_s.z));
    float _e36 = etendue_greater(abs(light_2.edge_t.x), abs(light_2.edge_t.y));
    float _e40 = etendue_greater(_e36, abs(light_2.edge_t.z));
    float x7_11 = (_e40 + (_e18 + _e29));
    float _e45 = etendue_from_bits(2139095040u);
    bool b8_2 = ((x7_11 + x7_11) < _e45);
    float _e47 = etendue_greater(_e18, _e29);
    float _e48 = etendue_greater(_e47, _e40);
    float _e49 = etendue_pow2_scale(_e48);
    float x10_7 = (_e49 * (b8_2 ? x1_15 : 0.0));
    float x11_9 = (_e49 * (b8_2 ? x2_15 : 0.0));
    float x12_7 = (_e49 * (b8_2 ? x3_10 : 0.0));
    float x13_7 = (_e49 * (b8_2 ? light_2.edge_s.x : 0.0));
    float x14_8 = (_e49 * (b8_2 ? light_2.edge_s.y : 0.0));
    float x15_7 = (_e49 * (b8_2 ? light_2.edge_s.z : 0.0));
    float x16_7 = (_e49 * (b8_2 ? light_2.edge_t.x : 0.0));
    float x17_5 = (_e49 * (b8_2 ? light_2.edge_t.y : 0.0));
    float x18_5 = (_e49 * (b8_2 ? light_2.edge_t.z : 0.0));
    float _e91 = etendue_greater(abs(x13_7), abs(x14_8));
    float _e93 = etendue_greater(_e91, abs(x15_7));
    float _e94 = etendue_pow2_scale(_e93);
    float x20_7 = (x13_7 * _e94);
    float x21_5 = (x14_8 * _e94);
    float x22_5 = (x15_7 * _e94);
    float x23_6 = (x20_7 * x20_7 + (x21_5 * x21_5 + (x22_5 * x22_5)));
    float x24_5 = ((0.0 < x23_6) ? (1.0 / sqrt(x23_6)) : 0.0);
    float x25_6 = (x20_7 * x24_5);
    float x26_5 = (x21_5 * x24_5);
    float x27_4 = (x22_5 * x24_5);
    float x28_5 = ((x23_6 * x24_5) / _e94);
    float _e115 = etendue_greater(abs(x16_7), abs(x17_5));
    float _e117 = etendue_greater(_e115, abs(x18_5));
    float _e118 = etendue_pow2_scale(_e117);
    float x30_5 = (x16_7 * _e118);
    float x31_4 = (x17_5 * _e118);
    float x32_3 = (x18_5 * _e118);
    float x33_3 = (x30_5 * x30_5 + (x31_4 * x31_4 + (x32_3 * x32_3)));
    float x34_5 = ((0.0 < x33_3) ? (1.0 / sqrt(x33_3)) : 0.0);
    float x35_4 = (x30_5 * x34_5);
    float x36_5 = (x31_4 * x34_5);
    float x37_3 = (x32_3 * x34_5);
    float x38_3 = ((x33_3 * x34_5) / _e118);
    float x39_3 = (x22_5 * x31_4);
    float x40_3 = (x22_5 * x31_4 + -(x39_3));
    float x41_4 = ((x21_5 * x32_3 + -(x39_3)) - x40_3);
    float x42_4 = (x20_7 * x32_3);
    float x43_3 = (x20_7 * x32_3 + -(x42_4));
    float x44_4 = ((x22_5 * x30_5 + -(x42_4)) - x43_3);
    float x45_3 = (x21_5 * x30_5);
    float x46_3 = (x21_5 * x30_5 + -(x45_3));
    float x47_4 = ((x20_7 * x31_4 + -(x45_3)) - x46_3);
    float x48_4 = abs(x41_4);
    float x49_4 = abs(x44_4);
    float _e157 = etendue_greater(x48_4, x49_4);
    float _e159 = etendue_greater(_e157, abs(x47_4));
    float _e160 = etendue_pow2_scale(_e159);
    float x51_4 = (x41_4 * _e160);
    float x52_2 = (x44_4 * _e160);
    float x53_4 = (x47_4 * _e160);
    float x54_3 = (x51_4 * x51_4 + (x52_2 * x52_2 + (x53_4 * x53_4)));
    float x55_2 = ((0.0 < x54_3) ? (1.0 / sqrt(x54_3)) : 0.0);
    float x56_2 = (x51_4 * x55_2);
    float x57_1 = (x52_2 * x55_2);
    float x58_1 = (x53_4 * x55_2);
    float x59_2 = ((x54_3 * x55_2) / _e160);
    float x60_1 = (x12_7 * x47_4);
    float x61_1 = (x10_7 * x41_4 + (x11_9 * x44_4 + x60_1));
    bool b62_ = (abs((x61_1 + x61_1)) < (x48_4 * abs(x10_7) + (x49_4 * abs(x11_9) + abs(x60_1))));
    float x63_1 = (x10_7 + x13_7);
    float x64_1 = (x11_9 + x14_8);
    float x65_1 = (x12_7 + x15_7);
    float x66_1 = (x16_7 + x63_1);
    float x67_1 = (x17_5 + x64_1);
    float x68_1 = (x18_5 + x65_1);
    float x69_1 = (x10_7 + x16_7);
    float x70_1 = (x11_9 + x17_5);
    float x71_1 = (x12_7 + x18_5);
    float x72_1 = (x10_7 * x20_7);
    float x73_1 = (x11_9 * x21_5);
    float x74_1 = (x12_7 * x22_5);
    float x75_1 = (x72_1 + x73_1);
    float x76_ = (x75_1 - x72_1);
    float x77_ = (x74_1 + x75_1);
    float x78_ = (x77_ - x75_1);
    float x79_ = (((x72_1 - (x75_1 - x76_)) + (x73_1 - x76_)) + ((x75_1 - (x77_ - x78_)) + (x74_1 - x78_)));
    float x80_1 = ((x10_7 * x20_7 + -(x72_1)) + ((x11_9 * x21_5 + -(x73_1)) + (x12_7 * x22_5 + -(x74_1))));
    float x81_1 = (x79_ + x80_1);
    float x82_1 = (x13_7 * x20_7);
    float x83_1 = (x14_8 * x21_5);
    float x84_1 = (x15_7 * x22_5);
    float x85_1 = (x82_1 + x83_1);
    float x86_1 = (x85_1 - x82_1);
    float x87_1 = (x84_1 + x85_1);
    float x88_1 = (x87_1 - x85_1);
    float x89_1 = (((x82_1 - (x85_1 - x86_1)) + (x83_1 - x86_1)) + ((x85_1 - (x87_1 - x88_1)) + (x84_1 - x88_1)));
    float x90_1 = ((x13_7 * x20_7 + -(x82_1)) + ((x14_8 * x21_5 + -(x83_1)) + (x15_7 * x22_5 + -(x84_1))));
    float x91_1 = (x24_5 * (x77_ + x81_1));
    float x92_1 = (x77_ + x87_1);
    float x93_1 = (x92_1 - x77_);
    float x94_1 = (((x77_ - (x92_1 - x93_1)) + (x87_1 - x93_1)) + (x81_1 + (x89_1 + x90_1)));
    float x95_1 = (x24_5 * (x92_1 + x94_1));
    bool b96_ = ((x91_1 + x95_1) < 0.0);
    float _e268 = etendue_greater((b96_ ? -(x95_1) : x91_1), (x28_5 * -0.5));
    float x98_1 = (x28_5 + _e268);
    float x99_1 = (x10_7 * x30_5);
    float x100_1 = (x11_9 * x31_4);
    float x101_1 = (x12_7 * x32_3);
    float x102_1 = (x99_1 + x100_1);
    float x103_1 = (x102_1 - x99_1);
    float x104_1 = (x101_1 + x102_1);
    float x105_1 = (x104_1 - x102_1);
    float x106_1 = (((x99_1 - (x102_1 - x103_1)) + (x100_1 - x103_1)) + ((x102_1 - (x104_1 - x105_1)) + (x101_1 - x105_1)));
    float x107_ = ((x10_7 * x30_5 + -(x99_1)) + ((x11_9 * x31_4 + -(x100_1)) + (x12_7 * x32_3 + -(x101_1))));
    float x108_1 = (x106_1 + x107_);
    float x109_1 = (x16_7 * x30_5);
    float x110_1 = (x17_5 * x31_4);
    float x111_1 = (x18_5 * x32_3);
    float x112_1 = (x109_1 + x110_1);
    float x113_1 = (x112_1 - x109_1);
    float x114_1 = (x111_1 + x112_1);
    float x115_1 = (x114_1 - x112_1);
    float x116_1 = (((x109_1 - (x112_1 - x113_1)) + (x110_1 - x113_1)) + ((x112_1 - (x114_1 - x115_1)) + (x111_1 - x115_1)));
    float x117_1 = ((x16_7 * x30_5 + -(x109_1)) + ((x17_5 * x31_4 + -(x110_1)) + (x18_5 * x32_3 + -(x111_1))));
    float x118_1 = (x34_5 * (x104_1 + x108_1));
    float x119_1 = (x104_1 + x114_1);
    float x120_1 = (x119_1 - x104_1);
    float x121_1 = (((x104_1 - (x119_1 - x120_1)) + (x114_1 - x120_1)) + (x108_1 + (x116_1 + x117_1)));
    float x122_1 = (x34_5 * (x119_1 + x121_1));
    bool b123_ = ((x118_1 + x122_1) < 0.0);
    float _e339 = etendue_greater((b123_ ? -(x122_1) : x118_1), (x38_3 * -0.5));
    float x125_ = (x38_3 + _e339);
    float x126_1 = (b96_ ? -(x25_6) : x25_6);
    float x127_1 = (b96_ ? -(x26_5) : x26_5);
    float x128_1 = (b96_ ? -(x27_4) : x27_4);
    float x129_1 = (b123_ ? -(x35_4) : x35_4);
    float x130_1 = (b123_ ? -(x36_5) : x36_5);
    float x131_1 = (b123_ ? -(x37_3) : x37_3);
    bool b132_ = (x98_1 <= (_e268 + _e268));
    bool b133_ = (x125_ <= (_e339 + _e339));
    float x134_1 = (b132_ ? x98_1 : 0.0);
    float x135_1 = (b133_ ? x125_ : 0.0);
    float x136_1 = (x98_1 - x134_1);
    float x137_1 = (x125_ - x135_1);
    float x138_1 = (((b96_ ? (b123_ ? x10_7 : x69_1) : (b123_ ? x63_1 : x66_1)) - (x126_1 * x136_1)) - (x129_1 * x137_1));
    float x139_1 = (((b96_ ? (b123_ ? x11_9 : x70_1) : (b123_ ? x64_1 : x67_1)) - (x127_1 * x136_1)) - (x130_1 * x137_1));
    float x140_1 = (((b96_ ? (b123_ ? x12_7 : x71_1) : (b123_ ? x65_1 : x68_1)) - (x128_1 * x136_1)) - (x131_1 * x137_1));
    float x141_1 = (_e339 * x125_);
    bool b142_ = (_e339 < 0.0);
    float x143_1 = (x98_1 * x98_1);
    float x144_1 = abs(_e339);
    float x145_1 = (x38_3 * (_e339 + x125_));
    float x146_1 = abs(x141_1);
    bool b147_ = (_e268 < 0.0);
    float x148_1 = (-(_e268) * -(_e268));
    bool b149_ = (b142_ || b147_);
    bool b150_ = (b142_ && !(b147_));
    float x151_1 = (b150_ ? _e339 : _e268);
    float x152_1 = (b150_ ? _e268 : _e339);
    float x153_1 = (b150_ ? x125_ : x98_1);
    float x154_1 = (b150_ ? x98_1 : x125_);
    float x155_1 = (x152_1 * x154_1);
    bool b156_ = (0.0 <= x152_1);
    float x157_1 = abs(x152_1);
    float x158_1 = ((b150_ ? x28_5 : x38_3) * (x152_1 + x154_1));
    float x159_1 = (x151_1 * x153_1);
    float x160_1 = (x11_9 * x15_7);
    float x161_1 = (x12_7 * x14_8);
    float x162_1 = (x160_1 - x161_1);
    float x163_1 = (x162_1 - x160_1);
    float x164_1 = (((x160_1 - (x162_1 - x163_1)) + (-(x161_1) - x163_1)) + ((x11_9 * x15_7 + -(x160_1)) - (x12_7 * x14_8 + -(x161_1))));
    float x165_1 = (x12_7 * x13_7);
    float x166_1 = (x10_7 * x15_7);
    float x167_ = (x165_1 - x166_1);
    float x168_1 = (x167_ - x165_1);
    float x169_1 = (((x165_1 - (x167_ - x168_1)) + (-(x166_1) - x168_1)) + ((x12_7 * x13_7 + -(x165_1)) - (x10_7 * x15_7 + -(x166_1))));
    float x170_1 = (x10_7 * x14_8);
    float x171_1 = (x11_9 * x13_7);
    float x172_1 = (x170_1 - x171_1);
    float x173_1 = (x172_1 - x170_1);
    float x174_1 = (((x170_1 - (x172_1 - x173_1)) + (-(x171_1) - x173_1)) + ((x10_7 * x14_8 + -(x170_1)) - (x11_9 * x13_7 + -(x171_1))));
    float x175_1 = (x11_9 * x18_5);
    float x176_1 = (x12_7 * x17_5);
    float x177_1 = (x175_1 - x176_1);
    float x178_1 = (x177_1 - x175_1);
    float x179_1 = (((x175_1 - (x177_1 - x178_1)) + (-(x176_1) - x178_1)) + ((x11_9 * x18_5 + -(x175_1)) - (x12_7 * x17_5 + -(x176_1))));
    float x180_1 = (x12_7 * x16_7);
    float x181_1 = (x10_7 * x18_5);
    float x182_1 = (x180_1 - x181_1);
    float x183_1 = (x182_1 - x180_1);
    float x184_1 = (((x180_1 - (x182_1 - x183_1)) + (-(x181_1) - x183_1)) + ((x12_7 * x16_7 + -(x180_1)) - (x10_7 * x18_5 + -(x181_1))));
    float x185_1 = (x10_7 * x17_5);
    float x186_1 = (x11_9 * x16_7);
    float x187_1 = (x185_1 - x186_1);
    float x188_1 = (x187_1 - x185_1);
    float x189_1 = (((x185_1 - (x187_1 - x188_1)) + (-(x186_1) - x188_1)) + ((x10_7 * x17_5 + -(x185_1)) - (x11_9 * x16_7 + -(x186_1))));
    float x190_1 = (x14_8 * x18_5);
    float x191_1 = (x15_7 * x17_5);
    float x192_ = (x190_1 - x191_1);
    float x193_1 = (x192_ - x190_1);
    float x194_ = (((x190_1 - (x192_ - x193_1)) + (-(x191_1) - x193_1)) + ((x14_8 * x18_5 + -(x190_1)) - (x15_7 * x17_5 + -(x191_1))));
    float x195_1 = (x15_7 * x16_7);
    float x196_1 = (x13_7 * x18_5);
    float x197_ = (x195_1 - x196_1);
    float x198_ = (x197_ - x195_1);
    float x199_1 = (((x195_1 - (x197_ - x198_)) + (-(x196_1) - x198_)) + ((x15_7 * x16_7 + -(x195_1)) - (x13_7 * x18_5 + -(x196_1))));
    float x200_1 = (x13_7 * x17_5);
    float x201_1 = (x14_8 * x16_7);
    float x202_1 = (x200_1 - x201_1);
    float x203_1 = (x202_1 - x200_1);
    float x204_1 = (((x200_1 - (x202_1 - x203_1)) + (-(x201_1) - x203_1)) + ((x13_7 * x17_5 + -(x200_1)) - (x14_8 * x16_7 + -(x201_1))));
    float x205_1 = (-(x177_1) - x179_1);
    float x206_1 = (-(x182_1) - x184_1);
    float x207_1 = (-(x187_1) - x189_1);
    float _e555 = etendue_greater(abs(x205_1), abs(x206_1));
    float _e557 = etendue_greater(_e555, abs(x207_1));
    float _e558 = etendue_pow2_scale(_e557);
    float x209_1 = (x205_1 * _e558);
    float x210_1 = (x206_1 * _e558);
    float x211_1 = (x207_1 * _e558);
    float x212_1 = (x209_1 * x209_1 + (x210_1 * x210_1 + (x211_1 * x211_1)));
    float x213_1 = ((0.0 < x212_1) ? (1.0 / sqrt(x212_1)) : 0.0);
    float x214_1 = (x209_1 * x213_1);
    float x215_1 = (x210_1 * x213_1);
    float x216_1 = (x211_1 * x213_1);
    float x217_1 = ((x212_1 * x213_1) / _e558);
    float x218_1 = ((0.0 < x217_1) ? (-((x10_7 * x69_1 + (x11_9 * x70_1 + (x12_7 * x71_1)))) / x217_1) : 0.0);
    float _e587 = etendue_greater(x218_1, 1.0);
    float _e589 = etendue_lesser(_e587, 1e18);
    float x219_1 = (_e589 * 4.7683716e-7);
    float x220_1 = (x177_1 + x192_);
    float x221_ = (x220_1 - x177_1);
    float x222_1 = (x182_1 + x197_);
    float x223_1 = (x222_1 - x182_1);
    float x224_1 = (x187_1 + x202_1);
    float x225_1 = (x224_1 - x187_1);
    float x226_1 = (x220_1 + (((x177_1 - (x220_1 - x221_)) + (x192_ - x221_)) + (x179_1 + x194_)));
    float x227_1 = (x222_1 + (((x182_1 - (x222_1 - x223_1)) + (x197_ - x223_1)) + (x184_1 + x199_1)));
    float x228_1 = (x224_1 + (((x187_1 - (x224_1 - x225_1)) + (x202_1 - x225_1)) + (x189_1 + x204_1)));
    float _e621 = etendue_greater(abs(x226_1), abs(x227_1));
    float _e623 = etendue_greater(_e621, abs(x228_1));
    float _e624 = etendue_pow2_scale(_e623);
    float x230_1 = (x226_1 * _e624);
    float x231_1 = (x227_1 * _e624);
    float x232_1 = (x228_1 * _e624);
    float x233_1 = (x230_1 * x230_1 + (x231_1 * x231_1 + (x232_1 * x232_1)));
    float x234_ = ((0.0 < x233_1) ? (1.0 / sqrt(x233_1)) : 0.0);
    float x235_1 = (x230_1 * x234_);
    float x236_1 = (x231_1 * x234_);
    float x237_1 = (x232_1 * x234_);
    float x238_1 = ((x233_1 * x234_) / _e624);
    float x239_1 = ((0.0 < x238_1) ? (-((x63_1 * x66_1 + (x64_1 * x67_1 + (x65_1 * x68_1)))) / x238_1) : 0.0);
    float _e654 = etendue_greater(x239_1, 1.0);
    float _e656 = etendue_lesser(_e654, 1e18);
    float x240_1 = (4.7683716e-7 * _e656);
    float x241_ = (x162_1 + x164_1);
    float x242_1 = (x167_ + x169_1);
    float x243_1 = (x172_1 + x174_1);
    float _e663 = etendue_greater(abs(x241_), abs(x242_1));
    float _e665 = etendue_greater(_e663, abs(x243_1));
    float _e666 = etendue_pow2_scale(_e665);
    float x245_1 = (x241_ * _e666);
    float x246_1 = (x242_1 * _e666);
    float x247_1 = (x243_1 * _e666);
    float x248_1 = (x245_1 * x245_1 + (x246_1 * x246_1 + (x247_1 * x247_1)));
    float x249_1 = ((0.0 < x248_1) ? (1.0 / sqrt(x248_1)) : 0.0);
    float x250_1 = (x245_1 * x249_1);
    float x251_1 = (x246_1 * x249_1);
    float x252_1 = (x247_1 * x249_1);
    float x253_1 = ((x248_1 * x249_1) / _e666);
    float x254_1 = ((0.0 < x253_1) ? (-((x10_7 * x63_1 + (x11_9 * x64_1 + (x12_7 * x65_1)))) / x253_1) : 0.0);
    float _e696 = etendue_greater(x254_1, 1.0);
    float _e698 = etendue_lesser(_e696, 1e18);
    float x255_1 = (4.7683716e-7 * _e698);
    float x256_1 = (x192_ - x162_1);
    float x257_1 = (x256_1 - x192_);
    float x258_1 = (x197_ - x167_);
    float x259_1 = (x258_1 - x197_);
    float x260_1 = (x202_1 - x172_1);
    float x261_1 = (x260_1 - x202_1);
    float x262_1 = (((x192_ - (x256_1 - x257_1)) + (-(x162_1) - x257_1)) + (x194_ - x164_1));
    float x263_1 = (((x197_ - (x258_1 - x259_1)) + (-(x167_) - x259_1)) + (x199_1 - x169_1));
    float x264_1 = (((x202_1 - (x260_1 - x261_1)) + (-(x172_1) - x261_1)) + (x204_1 - x174_1));
    float x265_1 = (x256_1 + x262_1);
    float x266_1 = (x258_1 + x263_1);
    float x267_1 = (x260_1 + x264_1);
    float _e732 = etendue_greater(abs(x265_1), abs(x266_1));
    float _e734 = etendue_greater(_e732, abs(x267_1));
    float _e735 = etendue_pow2_scale(_e734);
    float x269_1 = (x265_1 * _e735);
    float x270_ = (x266_1 * _e735);
    float x271_ = (x267_1 * _e735);
    float x272_ = (x269_1 * x269_1 + (x270_ * x270_ + (x271_ * x271_)));
    float x273_1 = ((0.0 < x272_) ? (1.0 / sqrt(x272_)) : 0.0);
    float x274_1 = (x269_1 * x273_1);
    float x275_1 = (x270_ * x273_1);
    float x276_1 = (x271_ * x273_1);
    float x277_1 = ((x272_ * x273_1) / _e735);
    float x278_1 = ((0.0 < x277_1) ? (-((x66_1 * x69_1 + (x67_1 * x70_1 + (x68_1 * x71_1)))) / x277_1) : 0.0);
    float _e765 = etendue_greater(x278_1, 1.0);
    float _e767 = etendue_lesser(_e765, 1e18);
    float x279_1 = (4.7683716e-7 * _e767);
    float x280_1 = (b96_ ? x240_1 : x219_1);
    float x281_1 = (b123_ ? x279_1 : x255_1);
    float x282_1 = (b96_ ? x219_1 : x240_1);
    float x283_1 = (b123_ ? x255_1 : x279_1);
    float x284_1 = (b132_ ? 1.0 : 0.0);
    float x285_1 = (b133_ ? 1.0 : 0.0);
    float x286_1 = (b96_ ? 1.0 : 0.0);
    float x287_1 = (b123_ ? 1.0 : 0.0);
    float x288_1 = (b147_ ? 0.5 : 2.0);
    float x289_1 = (1.0 / _e49);
    float _e790 = etendue_pow2_scale(_e29);
    float _e792 = etendue_from_bits(2139095040u);
    bool b291_ = (_e29 < _e792);
    float x292_1 = (_e790 * (b291_ ? light_2.edge_s.x : 0.0));
    float x293_1 = (_e790 * (b291_ ? light_2.edge_s.y : 0.0));
    float x294_1 = (_e790 * (b291_ ? light_2.edge_s.z : 0.0));
    float _e809 = etendue_pow2_scale(_e40);
    float _e811 = etendue_from_bits(2139095040u);
    bool b296_ = (_e40 < _e811);
    float x297_1 = (_e809 * (b296_ ? light_2.edge_t.x : 0.0));
    float x298_1 = (_e809 * (b296_ ? light_2.edge_t.y : 0.0));
    float x299_1 = (_e809 * (b296_ ? light_2.edge_t.z : 0.0));
    float x300_1 = (x294_1 * x298_1);
    float x301_1 = (x294_1 * x298_1 + -(x300_1));
    float x302_1 = ((x293_1 * x299_1 + -(x300_1)) - x301_1);
    float x303_1 = (x292_1 * x299_1);
    float x304_1 = (x292_1 * x299_1 + -(x303_1));
    float x305_1 = ((x294_1 * x297_1 + -(x303_1)) - x304_1);
    float x306_1 = (x293_1 * x297_1);
    float x307_1 = (x293_1 * x297_1 + -(x306_1));
    float x308_1 = ((x292_1 * x298_1 + -(x306_1)) - x307_1);
    float x309_1 = abs(x302_1);
    float x310_1 = abs(x305_1);
    float _e848 = etendue_greater(x309_1, x310_1);
    float _e850 = etendue_greater(_e848, abs(x308_1));
    float _e851 = etendue_pow2_scale(_e850);
    float x312_1 = (x302_1 * _e851);
    float x313_1 = (x305_1 * _e851);
    float x314_1 = (x308_1 * _e851);
    float x315_1 = (x312_1 * x312_1 + (x313_1 * x313_1 + (x314_1 * x314_1)));
    float x316_1 = ((0.0 < x315_1) ? (1.0 / sqrt(x315_1)) : 0.0);
    float x317_ = (x312_1 * x316_1);
    float x318_1 = (x313_1 * x316_1);
    float x319_1 = (x314_1 * x316_1);
    float x320_1 = ((x315_1 * x316_1) / _e851);
    float _e871 = etendue_greater(0.0, _e18);
    float _e872 = etendue_greater(_e871, _e29);
    float _e873 = etendue_greater(_e872, _e40);
    float _e875 = etendue_from_bits(2139095040u);
    bool b322_ = (_e873 < _e875);
    float _e877 = etendue_pow2_scale(_e873);
    float x324_1 = (_e877 * (b322_ ? x1_15 : 0.0));
    float x325_1 = (_e877 * (b322_ ? x2_15 : 0.0));
    float x326_1 = (_e877 * (b322_ ? x3_10 : 0.0));
    float x327_1 = (_e877 * (b322_ ? light_2.edge_s.x : 0.0));
    float x328_1 = (_e877 * (b322_ ? light_2.edge_s.y : 0.0));
    float x329_1 = (_e877 * (b322_ ? light_2.edge_s.z : 0.0));
    float x330_1 = (_e877 * (b322_ ? light_2.edge_t.x : 0.0));
    float x331_ = (_e877 * (b322_ ? light_2.edge_t.y : 0.0));
    float x332_1 = (_e877 * (b322_ ? light_2.edge_t.z : 0.0));
    float x333_1 = (x308_1 * x326_1);
    float x334_1 = (x302_1 * x324_1 + (x305_1 * x325_1 + x333_1));
    bool b335_ = (abs((x334_1 + x334_1)) < (x309_1 * abs(x324_1) + (x310_1 * abs(x325_1) + abs(x333_1))));
    float x336_ = ((x320_1 * (_e877 / _e790)) * (_e877 / _e809));
    float x337_1 = (x317_ * x336_);
    float x338_1 = (x318_1 * x336_);
    float x339_1 = (x319_1 * x336_);
    float x340_1 = -((x326_1 * x328_1));
    float x341_1 = ((x325_1 * x329_1 + x340_1) - (x326_1 * x328_1 + x340_1));
    float x342_1 = -((x324_1 * x329_1));
    float x343_1 = ((x326_1 * x327_1 + x342_1) - (x324_1 * x329_1 + x342_1));
    float x344_1 = -((x325_1 * x327_1));
    float x345_1 = ((x324_1 * x328_1 + x344_1) - (x325_1 * x327_1 + x344_1));
    float x346_1 = -((x326_1 * x331_));
    float x347_1 = ((x325_1 * x332_1 + x346_1) - (x326_1 * x331_ + x346_1));
    float x348_1 = -((x324_1 * x332_1));
    float x349_1 = ((x326_1 * x330_1 + x348_1) - (x324_1 * x332_1 + x348_1));
    float x350_ = -((x325_1 * x330_1));
    float x351_1 = ((x324_1 * x331_ + x350_) - (x325_1 * x330_1 + x350_));
    float x352_ = (1.0 / _e877);
    if (b62_) {
        float x354_1 = (x21_5 * x32_3);
        float x355_1 = (x354_1 - x39_3);
        float x356_1 = (x355_1 - x354_1);
        float x357_1 = (((x354_1 - (x355_1 - x356_1)) + (-(x39_3) - x356_1)) + ((x21_5 * x32_3 + -(x354_1)) - x40_3));
        float x358_1 = (x22_5 * x30_5);
        float x359_1 = (x358_1 - x42_4);
        float x360_1 = (x359_1 - x358_1);
        float x361_1 = (((x358_1 - (x359_1 - x360_1)) + (-(x42_4) - x360_1)) + ((x22_5 * x30_5 + -(x358_1)) - x43_3));
        float x362_1 = (x20_7 * x31_4);
        float x363_1 = (x362_1 - x45_3);
        float x364_1 = (x363_1 - x362_1);
        float x365_1 = (((x362_1 - (x363_1 - x364_1)) + (-(x45_3) - x364_1)) + ((x20_7 * x31_4 + -(x362_1)) - x46_3));
        float x366_1 = (x10_7 * x355_1);
        float x367_1 = (x11_9 * x359_1);
        float x368_1 = (x12_7 * x363_1);
        float x369_1 = (x366_1 + x367_1);
        float x370_1 = (x369_1 - x366_1);
        float x371_1 = (x368_1 + x369_1);
        float x372_1 = (x371_1 - x369_1);
        float x373_1 = (((x366_1 - (x369_1 - x370_1)) + (x367_1 - x370_1)) + ((x369_1 - (x371_1 - x372_1)) + (x368_1 - x372_1)));
        float x374_1 = ((x10_7 * x355_1 + -(x366_1)) + ((x11_9 * x359_1 + -(x367_1)) + (x12_7 * x363_1 + -(x368_1))));
        x353_ = (x371_1 + ((x373_1 + x374_1) + (x10_7 * x357_1 + (x11_9 * x361_1 + (x12_7 * x365_1)))));
    }
    float _e1035 = x353_;
    float x375_ = ((0.0 < x59_2) ? ((b62_ ? _e1035 : x61_1) / x59_2) : 0.0);
    float x376_1 = abs(x375_);
    float _e1043 = etendue_copysign(1.0, x375_);
    float _e1044 = etendue_greater(x136_1, x137_1);
    float _e1045 = etendue_greater(x134_1, x135_1);
    float _e1046 = etendue_greater(_e1045, x376_1);
    bool b378_ = (_e1044 <= _e1046);
    float x379_1 = (b378_ ? x138_1 : (x126_1 * x134_1 + (x129_1 * x135_1 + (x56_2 * x375_))));
    float x380_1 = (b378_ ? x139_1 : (x127_1 * x134_1 + (x130_1 * x135_1 + (x57_1 * x375_))));
    float x381_ = (b378_ ? x140_1 : (x128_1 * x134_1 + (x131_1 * x135_1 + (x58_1 * x375_))));
    float x382_1 = (x376_1 * x376_1);
    float x383_1 = sqrt(((_e339 * _e339 + x382_1) * (x125_ * x125_ + x382_1)));
    float x384_1 = ((0.0 < x383_1) ? (1.0 / x383_1) : 0.0);
    float x385_1 = (x382_1 + x143_1);
    float x386_1 = sqrt((_e339 * _e339 + x385_1));
    float x387_1 = (x125_ * x125_ + x385_1);
    float x388_ = sqrt(x387_1);
    float x389_ = (x386_1 * x388_);
    float x390_ = ((0.0 < x385_1) ? (1.0 / x385_1) : 0.0);
    float x391_ = (x125_ * x386_1 + (x388_ * x144_1));
    float x392_ = (x389_ + x146_1);
    float x393_ = ((b142_ ? (x390_ * x391_) : ((0.0 < x391_) ? (x145_1 / x391_) : 0.0)) * (x376_1 * x98_1));
    float x394_ = (x384_1 * x393_);
    float x395_ = (x384_1 * (x390_ * (x141_1 * x143_1 + (x382_1 * x389_))));
    float x396_ = (x384_1 * (x38_3 * (x38_3 * x382_1)));
    float x397_ = (1.0 + ((0.0 < x392_) ? ((_e339 * _e339 + x387_1) / x392_) : 0.0));
    float x398_ = (x385_1 + x392_);
    float x399_ = (b142_ ? (x385_1 * x397_) : x398_);
    float x400_ = ((0.0 < x399_) ? (x396_ / x399_) : 0.0);
    float x401_ = (x382_1 * x384_1);
    float x402_ = (x401_ * (b142_ ? (x390_ * x398_) : x397_));
    float x403_ = (x382_1 + x148_1);
    float x404_ = sqrt((_e339 * _e339 + x403_));
    float x405_ = (x125_ * x125_ + x403_);
    float x406_ = sqrt(x405_);
    float x407_ = (x404_ * x406_);
    float x408_ = ((0.0 < x403_) ? (1.0 / x403_) : 0.0);
    float x409_ = (x125_ * x404_ + (x144_1 * x406_));
    float x410_ = (x146_1 + x407_);
    float x411_ = ((b142_ ? (x408_ * x409_) : ((0.0 < x409_) ? (x145_1 / x409_) : 0.0)) * (x376_1 * -(_e268)));
    float x412_ = (x384_1 * x411_);
    float x413_ = (x384_1 * (x408_ * (x141_1 * x148_1 + (x382_1 * x407_))));
    float x414_ = (1.0 + ((0.0 < x410_) ? ((_e339 * _e339 + x405_) / x410_) : 0.0));
    float x415_ = (x403_ + x410_);
    float x416_ = (b142_ ? (x403_ * x414_) : x415_);
    float x417_ = ((0.0 < x416_) ? (x396_ / x416_) : 0.0);
    float x418_ = (x401_ * (b142_ ? (x408_ * x415_) : x414_));
    float x419_ = (x151_1 * x151_1 + x382_1);
    float x420_ = (x153_1 * x153_1 + x382_1);
    float x421_ = sqrt((x152_1 * x152_1 + x419_));
    float x422_ = sqrt((x154_1 * x154_1 + x419_));
    float x423_ = sqrt((x152_1 * x152_1 + x420_));
    float x424_ = sqrt((x154_1 * x154_1 + x420_));
    float x425_ = (x154_1 * x423_ + (x424_ * x157_1));
    float x426_ = ((b156_ ? ((0.0 < x425_) ? ((x420_ * x158_1) / x425_) : 0.0) : x425_) * (x376_1 * abs(x153_1)));
    float x427_ = (x154_1 * x421_ + (x422_ * x157_1));
    float x428_ = ((b156_ ? ((0.0 < x427_) ? ((x419_ * x158_1) / x427_) : 0.0) : x427_) * (x376_1 * abs(x151_1)));
    float x429_ = (x421_ * x422_);
    float x430_ = (x38_3 * (x28_5 * x376_1));
    float x431_ = (x382_1 + (x155_1 + x159_1));
    float x432_ = (x424_ * (x421_ * x423_) + (x424_ * (x159_1 + (x152_1 * x152_1 + x382_1)) + (x423_ * x431_ + (x421_ * (x420_ + x155_1)))));
    float x433_ = (x424_ * x429_ + (x421_ * (x159_1 + (x154_1 * x154_1 + x382_1)) + (x422_ * x431_ + (x424_ * (x419_ + x155_1)))));
    float _e1232 = etendue_angle((b149_ ? x426_ : x430_), (b149_ ? (x155_1 * (x153_1 * x153_1) + (x382_1 * (x423_ * x424_))) : x432_));
    float _e1238 = etendue_angle((b149_ ? x428_ : x430_), (b149_ ? (x155_1 * (x151_1 * x151_1) + (x382_1 * x429_)) : x433_));
    float x435_ = (_e1232 + _e1238);
    float x436_ = (x435_ * (b149_ ? 1.0 : 2.0));
    bool b437_ = (0.0 < x394_);
    bool b438_ = ((((b8_2 && (1e-36 < x436_)) && (x436_ < 7.0)) && b437_) && (1e-18 < x376_1));
    bool b439_ = (_e1043 < 0.0);
    float x440_ = (b439_ ? -(x214_1) : x214_1);
    float x441_ = (b439_ ? -(x215_1) : x215_1);
    float x442_ = (b439_ ? -(x216_1) : x216_1);
    float x443_ = (b439_ ? -(x235_1) : x235_1);
    float x444_ = (b439_ ? -(x236_1) : x236_1);
    float x445_ = (b439_ ? -(x237_1) : x237_1);
    float x446_ = (b439_ ? -(x250_1) : x250_1);
    float x447_ = (b439_ ? -(x251_1) : x251_1);
    float x448_ = (b439_ ? -(x252_1) : x252_1);
    float x449_ = (b439_ ? -(x274_1) : x274_1);
    float x450_ = (b439_ ? -(x275_1) : x275_1);
    float x451_ = (b439_ ? -(x276_1) : x276_1);
    float x452_ = (b96_ ? x443_ : x440_);
    float x453_ = (b96_ ? x444_ : x441_);
    float x454_ = (b96_ ? x445_ : x442_);
    float x455_ = (b96_ ? x440_ : x443_);
    float x456_ = (b96_ ? x441_ : x444_);
    float x457_ = (b96_ ? x442_ : x445_);
    float x458_ = (b123_ ? x449_ : x446_);
    float x459_ = (b123_ ? x450_ : x447_);
    float x460_ = (b123_ ? x451_ : x448_);
    float x461_ = (b123_ ? x446_ : x449_);
    float x462_ = (b123_ ? x447_ : x450_);
    float x463_ = (b123_ ? x448_ : x451_);
    float x464_ = (x56_2 * _e1043);
    float x465_ = (x57_1 * _e1043);
    float x466_ = (x58_1 * _e1043);
    float x467_ = (b437_ ? (1.0 / x394_) : 0.0);
    float x468_ = (b438_ ? x436_ : 0.0);
    if (b335_) {
        float x470_ = (x293_1 * x299_1);
        float x471_ = (x470_ - x300_1);
        float x472_ = (x471_ - x470_);
        float x473_ = (((x470_ - (x471_ - x472_)) + (-(x300_1) - x472_)) + ((x293_1 * x299_1 + -(x470_)) - x301_1));
        float x474_ = (x294_1 * x297_1);
        float x475_ = (x474_ - x303_1);
        float x476_ = (x475_ - x474_);
        float x477_ = (((x474_ - (x475_ - x476_)) + (-(x303_1) - x476_)) + ((x294_1 * x297_1 + -(x474_)) - x304_1));
        float x478_ = (x292_1 * x298_1);
        float x479_ = (x478_ - x306_1);
        float x480_ = (x479_ - x478_);
        float x481_ = (((x478_ - (x479_ - x480_)) + (-(x306_1) - x480_)) + ((x292_1 * x298_1 + -(x478_)) - x307_1));
        float x482_ = (x324_1 * x471_);
        float x483_ = (x325_1 * x475_);
        float x484_ = (x326_1 * x479_);
        float x485_ = (x482_ + x483_);
        float x486_ = (x485_ - x482_);
        float x487_ = (x484_ + x485_);
        float x488_ = (x487_ - x485_);
        float x489_ = (((x482_ - (x485_ - x486_)) + (x483_ - x486_)) + ((x485_ - (x487_ - x488_)) + (x484_ - x488_)));
        float x490_ = ((x324_1 * x471_ + -(x482_)) + ((x325_1 * x475_ + -(x483_)) + (x326_1 * x479_ + -(x484_))));
        x469_ = (x487_ + ((x489_ + x490_) + (x324_1 * x473_ + (x325_1 * x477_ + (x326_1 * x481_)))));
    }
    float _e1371 = x469_;
    float _e1379 = etendue_greater(((1e-37 < abs(x320_1)) ? ((b335_ ? _e1371 : x334_1) / x320_1) : 0.0), -1e37);
    float _e1381 = etendue_lesser(_e1379, 1e37);
    result_12.surface_plane_cross.x = x337_1;
    result_12.surface_plane_cross.y = x338_1;
    result_12.surface_plane_cross.z = x339_1;
    result_12.surface_plane_normal.x = x317_;
    result_12.surface_plane_normal.y = x318_1;
    result_12.surface_plane_normal.z = x319_1;
    result_12.surface_plane_height = _e1381;
    result_12.surface_plane_along_first.x = x341_1;
    result_12.surface_plane_along_first.y = x343_1;
    result_12.surface_plane_along_first.z = x345_1;
    result_12.surface_plane_along_second.x = x347_1;
    result_12.surface_plane_along_second.y = x349_1;
    result_12.surface_plane_along_second.z = x351_1;
    result_12.surface_plane_unit = x352_;
    result_12.shape_base.x = x379_1;
    result_12.shape_base.y = x380_1;
    result_12.shape_base.z = x381_;
    result_12.shape_side_x.x = x126_1;
    result_12.shape_side_x.y = x127_1;
    result_12.shape_side_x.z = x128_1;
    result_12.shape_side_y.x = x129_1;
    result_12.shape_side_y.y = x130_1;
    result_12.shape_side_y.z = x131_1;
    result_12.shape_near_x.x = x452_;
    result_12.shape_near_x.y = x453_;
    result_12.shape_near_x.z = x454_;
    result_12.shape_far_x.x = x455_;
    result_12.shape_far_x.y = x456_;
    result_12.shape_far_x.z = x457_;
    result_12.shape_near_y.x = x458_;
    result_12.shape_near_y.y = x459_;
    result_12.shape_near_y.z = x460_;
    result_12.shape_far_y.x = x461_;
    result_12.shape_far_y.y = x462_;
    result_12.shape_far_y.z = x463_;
    result_12.shape_slack.x = x280_1;
    result_12.shape_slack.y = x281_1;
    result_12.shape_slack_far.x = x282_1;
    result_12.shape_slack_far.y = x283_1;
    result_12.shape_normal.x = x464_;
    result_12.shape_normal.y = x465_;
    result_12.shape_normal.z = x466_;
    result_12.shape_near.x = _e268;
    result_12.shape_near.y = _e339;
    result_12.shape_far.x = x98_1;
    result_12.shape_far.y = x125_;
    result_12.shape_size.x = x28_5;
    result_12.shape_size.y = x38_3;
    result_12.shape_height = x376_1;
    result_12.shape_anchor.x = x284_1;
    result_12.shape_anchor.y = x285_1;
    result_12.shape_flip.x = x286_1;
    result_12.shape_flip.y = x287_1;
    result_12.shape_sin_w1_ = x394_;
    result_12.shape_cos_w1_ = x395_;
    result_12.shape_inv_sin_w1_ = x467_;
    result_12.shape_above_p = x400_;
    result_12.shape_above_s = x402_;
    result_12.shape_near_sin = x412_;
    result_12.shape_near_cos = x413_;
    result_12.shape_near_above_p = x417_;
    result_12.shape_near_above_s = x418_;
    result_12.shape_half = x288_1;
    result_12.shape_solid_angle = x468_;
    result_12.shape_side = _e1043;
    result_12.shape_unit = x289_1;
    EtendueRectangleBySolidAngle _e1499 = result_12;
    return _e1499;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian. Greatest error over the atlas: direction 6e-7 (4e-5 of the rectangle's size if that is 1e-6 and the point
// is 1e-7 above its plane), besides what 8 steps of 2^-24 in u do to it (Omega and u0Omega are rounded; u0 counts from
// the nearer end where the rectangle lies on both sides of the foot). pdf 5e-7 relative, since coordinates, and
// heights whose terms cancel, are formed in twice the working precision. Next to the plane of a rectangle that
// surrounds the point, nearly all of u0 lies within the rounding of a direction at the ends: the inverse is then one
// of the u that lead back to the direction.
EtendueLightSample etendue_rectangle_by_solid_angle_sample(EtendueRectangleBySolidAngle prepared_8, vec2 u_5) {
    EtendueLightSample result_13 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    bool b1_1 = (0.0 < prepared_8.shape_flip.x);
    float x2_16 = (1.0 - u_5.x);
    float x3_11 = (b1_1 ? u_5.x : x2_16);
    bool b4_3 = (prepared_8.shape_half < x3_11);
    float x5_9 = (b4_3 ? prepared_8.shape_near_sin : prepared_8.shape_sin_w1_);
    float x6_10 = (b4_3 ? prepared_8.shape_near_cos : prepared_8.shape_cos_w1_);
    vec2 _e27 = etendue_sin_cos_turns(((b4_3 ? (b1_1 ? x2_16 : (1.0 - x2_16)) : x3_11) * (prepared_8.shape_solid_angle * 0.07957747)));
    float _e37 = etendue_greater((x5_9 * _e27.y + -((x6_10 * _e27.x))), -((b4_3 ? 1.0 : 0.0)));
    float x9_8 = -((_e27.x * (x6_10 * _e27.y + (x5_9 * _e27.x))));
    float x10_8 = (_e37 + _e37);
    float x11_10 = (_e27.x * x10_8);
    float _e58 = etendue_greater(((x11_10 + (b4_3 ? prepared_8.shape_near_above_p : prepared_8.shape_above_p)) * (x11_10 + (b4_3 ? prepared_8.shape_near_above_s : prepared_8.shape_above_s))), 0.0);
    float x12_8 = sqrt(_e58);
    float x13_8 = ((prepared_8.shape_sin_w1_ * prepared_8.shape_sin_w1_) * (x11_10 + (prepared_8.shape_above_p + prepared_8.shape_above_s)) + ((x11_10 + (prepared_8.shape_cos_w1_ + prepared_8.shape_cos_w1_)) * (prepared_8.shape_above_p * prepared_8.shape_above_s)));
    float x14_9 = (prepared_8.shape_far.x * (prepared_8.shape_far.x * (x13_8 * ((prepared_8.shape_inv_sin_w1_ * x10_8) * (prepared_8.shape_inv_sin_w1_ * _e27.x)))));
    float x15_8 = (prepared_8.shape_height * (_e27.y * _e37 + x9_8));
    float x16_8 = (b4_3 ? -(x15_8) : x15_8);
    bool b17_2 = (0.0 < prepared_8.shape_anchor.x);
    float x18_6 = (x12_8 * (b17_2 ? (prepared_8.shape_far.x * x12_8 + x16_8) : 1.0));
    float _e118 = etendue_greater(((b17_2 ? -(x14_9) : x16_8) / ((0.0 < x18_6) ? x18_6 : 1.0)), (b17_2 ? -(prepared_8.shape_size.x) : prepared_8.shape_near.x));
    float _e123 = etendue_lesser(_e118, (b17_2 ? 0.0 : prepared_8.shape_far.x));
    float x21_6 = (_e123 + (b17_2 ? prepared_8.shape_far.x : 0.0));
    float x22_6 = (x21_6 * x21_6 + (prepared_8.shape_height * prepared_8.shape_height));
    bool b23_1 = (0.0 < prepared_8.shape_flip.y);
    float x24_6 = (1.0 - u_5.y);
    float x25_7 = sqrt((prepared_8.shape_near.y * prepared_8.shape_near.y + x22_6));
    float x26_6 = sqrt((prepared_8.shape_far.y * prepared_8.shape_far.y + x22_6));
    float x27_5 = (prepared_8.shape_far.y * x25_7 + (x26_6 * abs(prepared_8.shape_near.y)));
    float x28_6 = (x27_5 * (x25_7 * x26_6));
    float x29_5 = ((0.0 < x28_6) ? (1.0 / x28_6) : 0.0);
    float x30_6 = (x27_5 * x29_5);
    float x31_5 = (x25_7 * x30_6);
    float x32_4 = (prepared_8.shape_far.y * x31_5);
    float x33_4 = ((0.0 <= prepared_8.shape_near.y) ? (x29_5 * (x22_6 * (prepared_8.shape_size.y * (prepared_8.shape_near.y + prepared_8.shape_far.y)))) : (x27_5 * x30_6));
    float x34_6 = (x30_6 * (prepared_8.shape_near.y * x26_6));
    float x35_5 = ((b23_1 ? u_5.y : x24_6) * x33_4);
    float x36_6 = ((b23_1 ? x24_6 : (1.0 - x24_6)) * x33_4);
    float x37_4 = (x34_6 + x36_6);
    bool b38_ = (x37_4 < 0.0);
    float x39_4 = (b38_ ? x37_4 : (x32_4 - x35_5));
    float x40_4 = ((b38_ ? -(x36_6) : x35_5) * (x39_4 + (b38_ ? x34_6 : x32_4)));
    float x41_5 = (x30_6 * (b38_ ? x26_6 : x25_7));
    float _e215 = etendue_greater((x22_6 * (x41_5 * (x22_6 * x41_5) + x40_4)), 0.0);
    float x42_5 = sqrt(_e215);
    bool b43_ = (0.0 < prepared_8.shape_anchor.y);
    float x44_5 = (x42_5 * (b43_ ? (x32_4 * x42_5 + (x31_5 * (x22_6 * x39_4))) : 1.0));
    float x45_4 = ((x22_6 * (b43_ ? -((x26_6 * x40_4)) : x39_4)) / ((0.0 < x44_5) ? x44_5 : 1.0));
    float _e242 = etendue_greater(x45_4, (b43_ ? -(prepared_8.shape_size.y) : prepared_8.shape_near.y));
    float _e247 = etendue_lesser(_e242, (b43_ ? 0.0 : prepared_8.shape_far.y));
    float x47_5 = (prepared_8.shape_side_x.x * _e123 + (prepared_8.shape_side_y.x * _e247 + prepared_8.shape_base.x));
    float x48_5 = (prepared_8.shape_side_x.y * _e123 + (prepared_8.shape_side_y.y * _e247 + prepared_8.shape_base.y));
    float x49_5 = (prepared_8.shape_side_x.z * _e123 + (prepared_8.shape_side_y.z * _e247 + prepared_8.shape_base.z));
    float x50_3 = (x47_5 * x47_5 + (x48_5 * x48_5 + (x49_5 * x49_5)));
    float x51_5 = ((1e-37 < x50_3) ? (1.0 / sqrt(x50_3)) : 0.0);
    float x52_3 = (x47_5 * x51_5);
    float x53_5 = (x48_5 * x51_5);
    float x54_4 = (x49_5 * x51_5);
    bool b55_1 = (0.0 < prepared_8.shape_solid_angle);
    float x56_3 = (b55_1 ? (prepared_8.shape_unit * (x50_3 * x51_5)) : 0.0);
    float _e308 = etendue_greater(((0.0 < prepared_8.shape_size.x) ? ((b17_2 ? -(_e123) : (prepared_8.shape_far.x - _e123)) / prepared_8.shape_size.x) : 0.0), 0.0);
    float _e310 = etendue_lesser(_e308, 1.0);
    float x59_3 = (b1_1 ? _e310 : (1.0 - _e310));
    float _e329 = etendue_greater(((0.0 < prepared_8.shape_size.y) ? ((b43_ ? -(_e247) : (prepared_8.shape_far.y - _e247)) / prepared_8.shape_size.y) : 0.0), 0.0);
    float _e331 = etendue_lesser(_e329, 1.0);
    float x62_1 = (b23_1 ? _e331 : (1.0 - _e331));
    float x63_2 = (b55_1 ? (1.0 / prepared_8.shape_solid_angle) : 0.0);
    bool b64_ = (prepared_8.shape_side < 0.0);
    float x65_2 = ((b64_ && (1e-37 < x63_2)) ? (1.0 / x63_2) : 0.0);
    result_13.direction.x = x52_3;
    result_13.direction.y = x53_5;
    result_13.direction.z = x54_4;
    result_13.distance_ = x56_3;
    result_13.pdf = x63_2;
    result_13.weight = x65_2;
    result_13.normal.x = prepared_8.surface_plane_normal.x;
    result_13.normal.y = prepared_8.surface_plane_normal.y;
    result_13.normal.z = prepared_8.surface_plane_normal.z;
    result_13.uv.x = x59_3;
    result_13.uv.y = x62_1;
    result_13.emits = b64_;
    result_13.delta = false;
    EtendueLightSample _e379 = result_13;
    return _e379;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the solid angle
// Omega at the point p: pdf 1/Omega per steradian. Greatest error over the atlas: direction 6e-7 (4e-5 of the
// rectangle's size if that is 1e-6 and the point is 1e-7 above its plane), besides what 8 steps of 2^-24 in u do to it
// (Omega and u0Omega are rounded; u0 counts from the nearer end where the rectangle lies on both sides of the foot).
// pdf 5e-7 relative, since coordinates, and heights whose terms cancel, are formed in twice the working precision.
// Next to the plane of a rectangle that surrounds the point, nearly all of u0 lies within the rounding of a direction
// at the ends: the inverse is then one of the u that lead back to the direction.
float etendue_rectangle_by_solid_angle_pdf(EtendueRectangleBySolidAngle prepared_9, vec3 w_4) {
    bool b1_2 = ((-(prepared_9.shape_slack.x) <= (prepared_9.shape_near_x.x * w_4.x + (prepared_9.shape_near_x.y * w_4.y + (prepared_9.shape_near_x.z * w_4.z)))) && (-(prepared_9.shape_slack_far.x) <= (prepared_9.shape_far_x.x * w_4.x + (prepared_9.shape_far_x.y * w_4.y + (prepared_9.shape_far_x.z * w_4.z)))));
    bool b2_ = ((b1_2 && (-(prepared_9.shape_slack.y) <= (prepared_9.shape_near_y.x * w_4.x + (prepared_9.shape_near_y.y * w_4.y + (prepared_9.shape_near_y.z * w_4.z))))) && (-(prepared_9.shape_slack_far.y) <= (prepared_9.shape_far_y.x * w_4.x + (prepared_9.shape_far_y.y * w_4.y + (prepared_9.shape_far_y.z * w_4.z)))));
    float x3_12 = ((b2_ && (-4.7683716e-7 <= (prepared_9.shape_normal.x * w_4.x + (prepared_9.shape_normal.y * w_4.y + (prepared_9.shape_normal.z * w_4.z))))) ? ((0.0 < prepared_9.shape_solid_angle) ? (1.0 / prepared_9.shape_solid_angle) : 0.0) : 0.0);
    return x3_12;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian. Greatest error over the atlas: direction 6e-7
// (4e-5 of the rectangle's size if that is 1e-6 and the point is 1e-7 above its plane), besides what 8 steps of 2^-24
// in u do to it (Omega and u0Omega are rounded; u0 counts from the nearer end where the rectangle lies on both sides
// of the foot). pdf 5e-7 relative, since coordinates, and heights whose terms cancel, are formed in twice the working
// precision. Next to the plane of a rectangle that surrounds the point, nearly all of u0 lies within the rounding of a
// direction at the ends: the inverse is then one of the u that lead back to the direction.
EtendueLightSample etendue_rectangle_by_solid_angle_hit(EtendueRectangleBySolidAngle prepared_10, vec3 w_5) {
    EtendueLightSample result_14 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    bool b1_3 = ((-(prepared_10.shape_slack.x) <= (prepared_10.shape_near_x.x * w_5.x + (prepared_10.shape_near_x.y * w_5.y + (prepared_10.shape_near_x.z * w_5.z)))) && (-(prepared_10.shape_slack_far.x) <= (prepared_10.shape_far_x.x * w_5.x + (prepared_10.shape_far_x.y * w_5.y + (prepared_10.shape_far_x.z * w_5.z)))));
    bool b2_1 = ((b1_3 && (-(prepared_10.shape_slack.y) <= (prepared_10.shape_near_y.x * w_5.x + (prepared_10.shape_near_y.y * w_5.y + (prepared_10.shape_near_y.z * w_5.z))))) && (-(prepared_10.shape_slack_far.y) <= (prepared_10.shape_far_y.x * w_5.x + (prepared_10.shape_far_y.y * w_5.y + (prepared_10.shape_far_y.z * w_5.z)))));
    float x3_13 = ((b2_1 && (-4.7683716e-7 <= (prepared_10.shape_normal.x * w_5.x + (prepared_10.shape_normal.y * w_5.y + (prepared_10.shape_normal.z * w_5.z))))) ? ((0.0 < prepared_10.shape_solid_angle) ? (1.0 / prepared_10.shape_solid_angle) : 0.0) : 0.0);
    bool b4_4 = (0.0 < x3_13);
    float x5_10 = (prepared_10.surface_plane_cross.x * w_5.x + (prepared_10.surface_plane_cross.y * w_5.y + (prepared_10.surface_plane_cross.z * w_5.z)));
    bool b6_3 = (1e-37 < abs(x5_10));
    float _e128 = etendue_greater((b6_3 ? (-((prepared_10.surface_plane_along_second.x * w_5.x + (prepared_10.surface_plane_along_second.y * w_5.y + (prepared_10.surface_plane_along_second.z * w_5.z)))) / x5_10) : 0.0), -1e37);
    float _e145 = etendue_greater((b6_3 ? ((prepared_10.surface_plane_along_first.x * w_5.x + (prepared_10.surface_plane_along_first.y * w_5.y + (prepared_10.surface_plane_along_first.z * w_5.z))) / x5_10) : 0.0), -1e37);
    float _e147 = etendue_lesser(_e145, 1e37);
    float _e149 = etendue_lesser(_e128, 1e37);
    float _e151 = etendue_greater(_e149, 0.0);
    float _e153 = etendue_lesser(_e151, 1.0);
    float _e155 = etendue_greater(_e147, 0.0);
    float _e157 = etendue_lesser(_e155, 1.0);
    float x11_11 = (prepared_10.surface_plane_normal.x * w_5.x + (prepared_10.surface_plane_normal.y * w_5.y + (prepared_10.surface_plane_normal.z * w_5.z)));
    float _e178 = etendue_greater(((1e-37 < abs(x11_11)) ? (prepared_10.surface_plane_height / x11_11) : 0.0), -1e37);
    float _e180 = etendue_lesser(_e178, 1e37);
    float _e182 = etendue_greater(_e180, 0.0);
    float _e187 = etendue_lesser((prepared_10.surface_plane_unit * _e182), 3.4028235e38);
    float x13_9 = (b4_4 ? _e187 : 0.0);
    bool b14_ = ((prepared_10.shape_side < 0.0) && b4_4);
    float x15_9 = ((b14_ && (1e-37 < x3_13)) ? (1.0 / x3_13) : 0.0);
    result_14.direction.x = w_5.x;
    result_14.direction.y = w_5.y;
    result_14.direction.z = w_5.z;
    result_14.distance_ = x13_9;
    result_14.pdf = x3_13;
    result_14.weight = x15_9;
    result_14.normal.x = prepared_10.surface_plane_normal.x;
    result_14.normal.y = prepared_10.surface_plane_normal.y;
    result_14.normal.z = prepared_10.surface_plane_normal.z;
    result_14.uv.x = _e153;
    result_14.uv.y = _e157;
    result_14.emits = b14_;
    result_14.delta = false;
    EtendueLightSample _e232 = result_14;
    return _e232;
}

// Prepares a light for the shading point p. Uniform over the surface of area A: pdf distance^2/(|cos(theta')| A) per
// steradian, theta' at the light.
EtendueDiskByArea etendue_disk_by_area_prepare(EtendueDisk light_3, vec3 p_3) {
    EtendueDiskByArea result_15 = EtendueDiskByArea(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0);
    float x1_16 = (light_3.center.x - p_3.x);
    float x2_17 = (light_3.center.y - p_3.y);
    float x3_14 = (light_3.center.z - p_3.z);
    float _e16 = etendue_greater(abs(x1_16), abs(x2_17));
    float _e18 = etendue_greater(_e16, abs(x3_14));
    float _e20 = etendue_from_bits(2139095040u);
    bool b4_5 = (_e18 < _e20);
    float x5_11 = (b4_5 ? x1_16 : 0.0);
    float x6_11 = (b4_5 ? x2_17 : 0.0);
    float x7_12 = (b4_5 ? x3_14 : 0.0);
    float x8_8 = (b4_5 ? light_3.radius : 0.0);
    float _e34 = etendue_copysign(1.0, light_3.normal.z);
    float x10_9 = (-1.0 / (light_3.normal.z + _e34));
    float x11_12 = (x10_9 * (light_3.normal.x * light_3.normal.y));
    float x12_9 = (light_3.normal.x * _e34);
    float x13_10 = (light_3.normal.x * (x10_9 * x12_9) + 1.0);
    float x14_10 = (_e34 * x11_12);
    float x15_10 = -(x12_9);
    float x16_9 = (light_3.normal.y * (light_3.normal.y * x10_9) + _e34);
    float x17_6 = -(light_3.normal.y);
    float x18_7 = (light_3.normal.x * x5_11);
    float x19_4 = (light_3.normal.y * x6_11);
    float x20_8 = (light_3.normal.z * x7_12);
    float x21_7 = (x18_7 + x19_4);
    float x22_7 = (x21_7 - x18_7);
    float x23_7 = (x20_8 + x21_7);
    float x24_7 = (x23_7 - x21_7);
    float x25_8 = (((x18_7 - (x21_7 - x22_7)) + (x19_4 - x22_7)) + ((x21_7 - (x23_7 - x24_7)) + (x20_8 - x24_7)));
    float x26_7 = ((light_3.normal.x * x5_11 + -(x18_7)) + ((light_3.normal.y * x6_11 + -(x19_4)) + (light_3.normal.z * x7_12 + -(x20_8))));
    float x27_6 = (x23_7 + (x25_8 + x26_7));
    result_15.surface_center.x = x5_11;
    result_15.surface_center.y = x6_11;
    result_15.surface_center.z = x7_12;
    result_15.surface_frame_s.x = x13_10;
    result_15.surface_frame_s.y = x14_10;
    result_15.surface_frame_s.z = x15_10;
    result_15.surface_frame_t.x = x11_12;
    result_15.surface_frame_t.y = x16_9;
    result_15.surface_frame_t.z = x17_6;
    result_15.surface_frame_n.x = light_3.normal.x;
    result_15.surface_frame_n.y = light_3.normal.y;
    result_15.surface_frame_n.z = light_3.normal.z;
    result_15.surface_radius = x8_8;
    result_15.surface_height = x27_6;
    EtendueDiskByArea _e136 = result_15;
    return _e136;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the surface of area A: pdf distance^2/(|cos(theta')|
// A) per steradian, theta' at the light.
EtendueLightSample etendue_disk_by_area_sample(EtendueDiskByArea prepared_11, vec2 u_6) {
    EtendueLightSample result_16 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_17 = (u_6.x * 2.0 + -1.0);
    float x2_18 = (u_6.y * 2.0 + -1.0);
    bool b3_3 = (abs(x2_18) < abs(x1_17));
    float x4_9 = (b3_3 ? x1_17 : x2_18);
    vec2 _e23 = etendue_sin_cos_quarters((((b3_3 ? x2_18 : x1_17) * 0.5) / ((0.0 < abs(x4_9)) ? x4_9 : 1.0)));
    float x6_12 = (x4_9 * (b3_3 ? _e23.y : _e23.x));
    float x7_13 = (x4_9 * (b3_3 ? _e23.x : _e23.y));
    float x8_9 = (prepared_11.surface_radius * x6_12);
    float x9_9 = (prepared_11.surface_radius * x7_13);
    float x10_10 = (prepared_11.surface_center.x + ((prepared_11.surface_frame_s.x * x8_9) + (prepared_11.surface_frame_t.x * x9_9)));
    float x11_13 = (prepared_11.surface_center.y + ((prepared_11.surface_frame_s.y * x8_9) + (prepared_11.surface_frame_t.y * x9_9)));
    float x12_10 = (prepared_11.surface_center.z + ((prepared_11.surface_frame_s.z * x8_9) + (prepared_11.surface_frame_t.z * x9_9)));
    float _e70 = etendue_greater((0.5 * x6_12 + 0.5), 0.0);
    float _e72 = etendue_lesser(_e70, 1.0);
    float _e77 = etendue_greater((0.5 * x7_13 + 0.5), 0.0);
    float _e79 = etendue_lesser(_e77, 1.0);
    float _e82 = etendue_greater(abs(x10_10), abs(x11_13));
    float _e84 = etendue_greater(_e82, abs(x12_10));
    float _e86 = etendue_from_bits(2139095040u);
    bool b16_ = (_e84 < _e86);
    float _e90 = etendue_pow2_scale((b16_ ? _e84 : 0.0));
    float x18_8 = (_e90 * (b16_ ? x10_10 : 0.0));
    float x19_5 = (_e90 * (b16_ ? x11_13 : 0.0));
    float x20_9 = (_e90 * (b16_ ? x12_10 : 0.0));
    float x21_8 = (x18_8 * x18_8 + (x19_5 * x19_5 + (x20_9 * x20_9)));
    float x22_8 = ((0.0 < x21_8) ? (1.0 / sqrt(x21_8)) : 0.0);
    float x23_8 = ((x21_8 * x22_8) / _e90);
    float x24_8 = (x18_8 * x22_8);
    float x25_9 = (x19_5 * x22_8);
    float x26_8 = (x20_9 * x22_8);
    float _e117 = etendue_from_bits(2139095040u);
    float x27_7 = ((x23_8 < _e117) ? x23_8 : 0.0);
    float x28_7 = (prepared_11.surface_frame_n.x * x24_8 + (prepared_11.surface_frame_n.y * x25_9 + (prepared_11.surface_frame_n.z * x26_8)));
    float x29_6 = abs(x28_7);
    float _e137 = etendue_greater(((1e-37 < x29_6) ? (prepared_11.surface_height / x28_7) : 0.0), -1e37);
    float _e139 = etendue_lesser(_e137, 1e37);
    float _e141 = etendue_greater(_e139, 0.0);
    float x31_6 = (((prepared_11.surface_radius * prepared_11.surface_radius) * 3.1415927) * x29_6);
    bool b32_ = (0.0 < x31_6);
    float x33_5 = (_e141 * (_e141 / (b32_ ? x31_6 : 1.0)));
    float x34_7 = (((b32_ && (x33_5 < 1e37)) && (0.0 < _e141)) ? x33_5 : 0.0);
    bool b35_1 = (x28_7 < 0.0);
    float x36_7 = ((b35_1 && (1e-37 < x34_7)) ? (1.0 / x34_7) : 0.0);
    result_16.direction.x = x24_8;
    result_16.direction.y = x25_9;
    result_16.direction.z = x26_8;
    result_16.distance_ = x27_7;
    result_16.pdf = x34_7;
    result_16.weight = x36_7;
    result_16.normal.x = prepared_11.surface_frame_n.x;
    result_16.normal.y = prepared_11.surface_frame_n.y;
    result_16.normal.z = prepared_11.surface_frame_n.z;
    result_16.uv.x = _e72;
    result_16.uv.y = _e79;
    result_16.emits = b35_1;
    result_16.delta = false;
    EtendueLightSample _e200 = result_16;
    return _e200;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the surface of area
// A: pdf distance^2/(|cos(theta')| A) per steradian, theta' at the light.
float etendue_disk_by_area_pdf(EtendueDiskByArea prepared_12, vec3 w_6) {
    float x1_18 = (prepared_12.surface_frame_n.x * w_6.x + (prepared_12.surface_frame_n.y * w_6.y + (prepared_12.surface_frame_n.z * w_6.z)));
    float x2_19 = abs(x1_18);
    float _e22 = etendue_greater(((1e-37 < x2_19) ? (prepared_12.surface_height / x1_18) : 0.0), -1e37);
    float _e24 = etendue_lesser(_e22, 1e37);
    float _e26 = etendue_greater(_e24, 0.0);
    float x4_10 = (x2_19 * ((prepared_12.surface_radius * prepared_12.surface_radius) * 3.1415927));
    bool b5_3 = (0.0 < x4_10);
    float x6_13 = (_e26 * (_e26 / (b5_3 ? x4_10 : 1.0)));
    float _e45 = etendue_greater(abs(prepared_12.surface_center.x), abs(prepared_12.surface_center.y));
    float _e49 = etendue_greater(_e45, abs(prepared_12.surface_center.z));
    float _e52 = etendue_greater(_e49, abs(prepared_12.surface_radius));
    float _e53 = etendue_pow2_scale(_e52);
    float x9_10 = (prepared_12.surface_center.x * _e53);
    float x10_11 = (prepared_12.surface_center.y * _e53);
    float x11_14 = (prepared_12.surface_center.z * _e53);
    float x12_11 = (prepared_12.surface_height * _e53);
    float x13_11 = (prepared_12.surface_radius * _e53);
    float x14_11 = ((w_6.x * x12_11) - (x1_18 * x9_10));
    float x15_11 = ((w_6.y * x12_11) - (x1_18 * x10_11));
    float x16_10 = ((w_6.z * x12_11) - (x1_18 * x11_14));
    float x17_7 = (x2_19 * x13_11 + ((x13_11 + sqrt((x9_10 * x9_10 + (x10_11 * x10_11 + (x11_14 * x11_14))))) * 7.1525574e-7));
    bool b18_2 = ((sqrt((x14_11 * x14_11 + (x15_11 * x15_11 + (x16_10 * x16_10)))) <= x17_7) && (0.0 < (x1_18 * x12_11)));
    float x19_6 = ((b18_2 && (0.0 < x13_11)) ? (((b5_3 && (x6_13 < 1e37)) && (0.0 < _e26)) ? x6_13 : 0.0) : 0.0);
    return x19_6;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the surface of area A: pdf distance^2/(|cos(theta')| A) per steradian, theta' at the light.
EtendueLightSample etendue_disk_by_area_hit(EtendueDiskByArea prepared_13, vec3 w_7) {
    EtendueLightSample result_17 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_19 = (prepared_13.surface_frame_n.x * w_7.x + (prepared_13.surface_frame_n.y * w_7.y + (prepared_13.surface_frame_n.z * w_7.z)));
    float x2_20 = abs(x1_19);
    float _e22 = etendue_greater(((1e-37 < x2_20) ? (prepared_13.surface_height / x1_19) : 0.0), -1e37);
    float _e24 = etendue_lesser(_e22, 1e37);
    float _e26 = etendue_greater(_e24, 0.0);
    float x5_12 = (w_7.x * _e24 + -(prepared_13.surface_center.x));
    float x6_14 = (w_7.y * _e24 + -(prepared_13.surface_center.y));
    float x7_14 = (w_7.z * _e24 + -(prepared_13.surface_center.z));
    float x8_10 = abs(prepared_13.surface_radius);
    bool b9_2 = (1e-37 < x8_10);
    float _e60 = etendue_greater((b9_2 ? ((prepared_13.surface_frame_s.x * x5_12 + (prepared_13.surface_frame_s.y * x6_14 + (prepared_13.surface_frame_s.z * x7_14))) / prepared_13.surface_radius) : 0.0), -1e37);
    float _e62 = etendue_lesser(_e60, 1e37);
    float _e77 = etendue_greater((b9_2 ? ((prepared_13.surface_frame_t.x * x5_12 + (prepared_13.surface_frame_t.y * x6_14 + (prepared_13.surface_frame_t.z * x7_14))) / prepared_13.surface_radius) : 0.0), -1e37);
    float _e79 = etendue_lesser(_e77, 1e37);
    float _e81 = etendue_greater(_e62, -1000000000000000.0);
    float _e83 = etendue_lesser(_e81, 1000000000000000.0);
    float _e88 = etendue_greater((_e83 * 0.5 + 0.5), 0.0);
    float _e90 = etendue_lesser(_e88, 1.0);
    float _e92 = etendue_greater(_e79, -1000000000000000.0);
    float _e94 = etendue_lesser(_e92, 1000000000000000.0);
    float _e99 = etendue_greater((_e94 * 0.5 + 0.5), 0.0);
    float _e101 = etendue_lesser(_e99, 1.0);
    float x14_12 = (x2_20 * ((prepared_13.surface_radius * prepared_13.surface_radius) * 3.1415927));
    bool b15_1 = (0.0 < x14_12);
    float x16_11 = (_e26 * (_e26 / (b15_1 ? x14_12 : 1.0)));
    float _e120 = etendue_greater(abs(prepared_13.surface_center.x), abs(prepared_13.surface_center.y));
    float _e124 = etendue_greater(_e120, abs(prepared_13.surface_center.z));
    float _e125 = etendue_greater(_e124, x8_10);
    float _e126 = etendue_pow2_scale(_e125);
    float x18_9 = (prepared_13.surface_center.x * _e126);
    float x19_7 = (prepared_13.surface_center.y * _e126);
    float x20_10 = (prepared_13.surface_center.z * _e126);
    float x21_9 = (prepared_13.surface_height * _e126);
    float x22_9 = (prepared_13.surface_radius * _e126);
    float x23_9 = ((w_7.x * x21_9) - (x1_19 * x18_9));
    float x24_9 = ((w_7.y * x21_9) - (x1_19 * x19_7));
    float x25_10 = ((w_7.z * x21_9) - (x1_19 * x20_10));
    float x26_9 = (x2_20 * x22_9 + ((x22_9 + sqrt((x18_9 * x18_9 + (x19_7 * x19_7 + (x20_10 * x20_10))))) * 7.1525574e-7));
    bool b27_ = ((sqrt((x23_9 * x23_9 + (x24_9 * x24_9 + (x25_10 * x25_10)))) <= x26_9) && (0.0 < (x1_19 * x21_9)));
    float x28_8 = ((b27_ && (0.0 < x22_9)) ? (((b15_1 && (x16_11 < 1e37)) && (0.0 < _e26)) ? x16_11 : 0.0) : 0.0);
    bool b29_ = (0.0 < x28_8);
    float x30_7 = (b29_ ? _e26 : 0.0);
    bool b31_ = (b29_ && (x1_19 < 0.0));
    float x32_5 = ((b31_ && (1e-37 < x28_8)) ? (1.0 / x28_8) : 0.0);
    result_17.direction.x = w_7.x;
    result_17.direction.y = w_7.y;
    result_17.direction.z = w_7.z;
    result_17.distance_ = x30_7;
    result_17.pdf = x28_8;
    result_17.weight = x32_5;
    result_17.normal.x = prepared_13.surface_frame_n.x;
    result_17.normal.y = prepared_13.surface_frame_n.y;
    result_17.normal.z = prepared_13.surface_frame_n.z;
    result_17.uv.x = _e90;
    result_17.uv.y = _e101;
    result_17.emits = b31_;
    result_17.delta = false;
    EtendueLightSample _e228 = result_17;
    return _e228;
}

// Prepares a light. Uniform over the cone: pdf 1/(2 pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
EtendueSunBySolidAngle etendue_sun_by_solid_angle_prepare(EtendueSun light_4) {
    EtendueSunBySolidAngle result_18 = EtendueSunBySolidAngle(vec3(0.0), vec3(0.0), vec3(0.0), 0.0);
    float x1_20 = ((0.0 <= (light_4.direction.x * light_4.direction.x + (light_4.direction.y * light_4.direction.y + (light_4.direction.z * light_4.direction.z)))) ? light_4.one_minus_cos : 0.0);
    float _e24 = etendue_copysign(1.0, light_4.direction.z);
    float x3_15 = (-1.0 / (light_4.direction.z + _e24));
    float x4_11 = (x3_15 * (light_4.direction.x * light_4.direction.y));
    float x5_13 = (light_4.direction.x * _e24);
    float x6_15 = (light_4.direction.x * (x3_15 * x5_13) + 1.0);
    float x7_15 = (_e24 * x4_11);
    float x8_11 = -(x5_13);
    float x9_11 = (light_4.direction.y * (light_4.direction.y * x3_15) + _e24);
    float x10_12 = -(light_4.direction.y);
    result_18.frame_s.x = x6_15;
    result_18.frame_s.y = x7_15;
    result_18.frame_s.z = x8_11;
    result_18.frame_t.x = x4_11;
    result_18.frame_t.y = x9_11;
    result_18.frame_t.z = x10_12;
    result_18.frame_n.x = light_4.direction.x;
    result_18.frame_n.y = light_4.direction.y;
    result_18.frame_n.z = light_4.direction.z;
    result_18.cone_one_minus_cos = x1_20;
    EtendueSunBySolidAngle _e81 = result_18;
    return _e81;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the cone: pdf 1/(2 pi (1 - cos(sigma))) per
// steradian, 0 where the cone is empty.
EtendueLightSample etendue_sun_by_solid_angle_sample(EtendueSunBySolidAngle prepared_14, vec2 u_7) {
    EtendueLightSample result_19 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float _e4 = etendue_greater(prepared_14.cone_one_minus_cos, 0.0);
    float _e6 = etendue_lesser(_e4, 2.0);
    float x2_21 = (u_7.x * _e6);
    float _e17 = etendue_greater((x2_21 * (_e6 * (1.0 - u_7.x) + (2.0 - _e6))), 0.0);
    float x3_16 = sqrt(_e17);
    vec2 _e20 = etendue_sin_cos_turns(u_7.y);
    float x5_14 = (x3_16 * _e20.y);
    float x6_16 = (x3_16 * _e20.x);
    float x7_16 = (1.0 - x2_21);
    float x8_12 = (prepared_14.frame_s.x * x5_14 + (prepared_14.frame_t.x * x6_16 + (prepared_14.frame_n.x * x7_16)));
    float x9_12 = (prepared_14.frame_s.y * x5_14 + (prepared_14.frame_t.y * x6_16 + (prepared_14.frame_n.y * x7_16)));
    float x10_13 = (prepared_14.frame_s.z * x5_14 + (prepared_14.frame_t.z * x6_16 + (prepared_14.frame_n.z * x7_16)));
    float x11_15 = ((1e-37 < _e6) ? (0.15915494 / _e6) : 0.0);
    float x12_12 = -(x8_12);
    float x13_12 = -(x9_12);
    float x14_13 = -(x10_13);
    float x15_12 = ((1e-37 < x11_15) ? (1.0 / x11_15) : 0.0);
    result_19.direction.x = x8_12;
    result_19.direction.y = x9_12;
    result_19.direction.z = x10_13;
    result_19.distance_ = 3.4028235e38;
    result_19.pdf = x11_15;
    result_19.weight = x15_12;
    result_19.normal.x = x12_12;
    result_19.normal.y = x13_12;
    result_19.normal.z = x14_13;
    result_19.uv.x = u_7.x;
    result_19.uv.y = u_7.y;
    result_19.emits = true;
    result_19.delta = false;
    EtendueLightSample _e96 = result_19;
    return _e96;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the cone: pdf 1/(2
// pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
float etendue_sun_by_solid_angle_pdf(EtendueSunBySolidAngle prepared_15, vec3 w_8) {
    bool b6_1 = false;
    float x1_21 = (prepared_15.frame_n.x * w_8.x + (prepared_15.frame_n.y * w_8.y + (prepared_15.frame_n.z * w_8.z)));
    float x2_22 = (1.0 - x1_21);
    float _e18 = etendue_greater(prepared_15.cone_one_minus_cos, 0.0);
    float _e20 = etendue_lesser(_e18, 2.0);
    float x4_12 = (x2_22 - _e20);
    bool b5_4 = (abs(x4_12) <= 3.8146973e-6);
    if (b5_4) {
        float x7_17 = (prepared_15.frame_s.x * w_8.x + (prepared_15.frame_s.y * w_8.y + (prepared_15.frame_s.z * w_8.z)));
        float x8_13 = (prepared_15.frame_t.x * w_8.x + (prepared_15.frame_t.y * w_8.y + (prepared_15.frame_t.z * w_8.z)));
        float x9_13 = ((0.5 < x1_21) ? ((x7_17 * x7_17 + (x8_13 * x8_13)) / (1.0 + abs(x1_21))) : x2_22);
        float _e66 = etendue_greater(sqrt((_e20 * (2.0 - _e20))), (_e20 - 1.0));
        float x10_14 = (_e20 + (5.9604645e-7 * _e66 + 1.7763568e-13));
        b6_1 = (x9_13 <= x10_14);
    }
    bool _e82 = b6_1;
    float x11_16 = ((((x4_12 < 0.0) && !(b5_4)) || (b5_4 && _e82)) ? ((1e-37 < _e20) ? (0.15915494 / _e20) : 0.0) : 0.0);
    return x11_16;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the cone: pdf 1/(2 pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
EtendueLightSample etendue_sun_by_solid_angle_hit(EtendueSunBySolidAngle prepared_16, vec3 w_9) {
    bool b15_ = false;
    EtendueLightSample result_20 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_22 = (prepared_16.frame_n.x * w_9.x + (prepared_16.frame_n.y * w_9.y + (prepared_16.frame_n.z * w_9.z)));
    float x2_23 = (1.0 - x1_22);
    float _e18 = etendue_greater(prepared_16.cone_one_minus_cos, 0.0);
    float _e20 = etendue_lesser(_e18, 2.0);
    float x4_13 = (x2_23 - _e20);
    bool b5_5 = (abs(x4_13) <= 3.8146973e-6);
    float x6_17 = (prepared_16.frame_s.x * w_9.x + (prepared_16.frame_s.y * w_9.y + (prepared_16.frame_s.z * w_9.z)));
    float x7_18 = (prepared_16.frame_t.x * w_9.x + (prepared_16.frame_t.y * w_9.y + (prepared_16.frame_t.z * w_9.z)));
    float x8_14 = ((0.5 < x1_22) ? ((x6_17 * x6_17 + (x7_18 * x7_18)) / (1.0 + abs(x1_22))) : x2_23);
    float _e64 = etendue_greater((x8_14 / ((0.0 < _e20) ? _e20 : 1.0)), 0.0);
    float _e66 = etendue_lesser(_e64, 0.99999994);
    float _e68 = etendue_angle(x7_18, x6_17);
    float x10_15 = (0.15915494 * _e68);
    float _e76 = etendue_greater(((x10_15 < 0.0) ? (1.0 + x10_15) : x10_15), 0.0);
    float _e78 = etendue_lesser(_e76, 0.99999994);
    float x12_13 = -(w_9.x);
    float x13_13 = -(w_9.y);
    float x14_14 = -(w_9.z);
    if (b5_5) {
        float _e93 = etendue_greater(sqrt((_e20 * (2.0 - _e20))), (_e20 - 1.0));
        float x16_12 = (_e20 + (5.9604645e-7 * _e93 + 1.7763568e-13));
        b15_ = (x8_14 <= x16_12);
    }
    bool _e109 = b15_;
    float x17_8 = ((((x4_13 < 0.0) && !(b5_5)) || (b5_5 && _e109)) ? ((1e-37 < _e20) ? (0.15915494 / _e20) : 0.0) : 0.0);
    bool b18_3 = (0.0 < x17_8);
    float x19_8 = (b18_3 ? 3.4028235e38 : 0.0);
    float x20_11 = ((b18_3 && (1e-37 < x17_8)) ? (1.0 / x17_8) : 0.0);
    result_20.direction.x = w_9.x;
    result_20.direction.y = w_9.y;
    result_20.direction.z = w_9.z;
    result_20.distance_ = x19_8;
    result_20.pdf = x17_8;
    result_20.weight = x20_11;
    result_20.normal.x = x12_13;
    result_20.normal.y = x13_13;
    result_20.normal.z = x14_14;
    result_20.uv.x = _e66;
    result_20.uv.y = _e78;
    result_20.emits = b18_3;
    result_20.delta = false;
    EtendueLightSample _e151 = result_20;
    return _e151;
}

// Prepares a light for the shading point p. Its one direction, whatever the random numbers. The pdf of a sample is
// distance^2, which is no density; that of a direction is 0.
EtenduePointLightByDelta etendue_point_light_by_delta_prepare(EtenduePointLight light_5, vec3 p_4) {
    EtenduePointLightByDelta result_21 = EtenduePointLightByDelta(vec3(0.0), 0.0, 0.0);
    float x1_23 = (light_5.position.x - p_4.x);
    float x2_24 = (light_5.position.y - p_4.y);
    float x3_17 = (light_5.position.z - p_4.z);
    float _e16 = etendue_greater(abs(x1_23), abs(x2_24));
    float _e18 = etendue_greater(_e16, abs(x3_17));
    float _e20 = etendue_from_bits(2139095040u);
    bool b5_6 = (_e18 < _e20);
    float _e24 = etendue_pow2_scale((b5_6 ? _e18 : 0.0));
    float x7_19 = (_e24 * (b5_6 ? x1_23 : 0.0));
    float x8_15 = (_e24 * (b5_6 ? x2_24 : 0.0));
    float x9_14 = (_e24 * (b5_6 ? x3_17 : 0.0));
    float x10_16 = (x7_19 * x7_19 + (x8_15 * x8_15 + (x9_14 * x9_14)));
    float x11_17 = ((0.0 < x10_16) ? (1.0 / sqrt(x10_16)) : 0.0);
    float x12_14 = ((x10_16 * x11_17) / _e24);
    float x13_14 = (x7_19 * x11_17);
    float x14_15 = (x8_15 * x11_17);
    float x15_13 = (x9_14 * x11_17);
    float _e51 = etendue_from_bits(2139095040u);
    float x16_13 = ((x12_14 < _e51) ? x12_14 : 0.0);
    float x17_9 = (x16_13 * x16_13);
    float x18_10 = ((x17_9 < 1e37) ? x17_9 : 0.0);
    result_21.direction.x = x13_14;
    result_21.direction.y = x14_15;
    result_21.direction.z = x15_13;
    result_21.distance_ = x16_13;
    result_21.pdf = x18_10;
    EtenduePointLightByDelta _e68 = result_21;
    return _e68;
}

// Draws a direction to the light for u in [0, 1)^2. Its one direction, whatever the random numbers. The pdf of a
// sample is distance^2, which is no density; that of a direction is 0.
EtendueLightSample etendue_point_light_by_delta_sample(EtenduePointLightByDelta prepared_17, vec2 u_8) {
    EtendueLightSample result_22 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    bool b1_4 = (0.0 < prepared_17.pdf);
    float x2_25 = -(prepared_17.direction.x);
    float x3_18 = -(prepared_17.direction.y);
    float x4_14 = -(prepared_17.direction.z);
    float x5_15 = ((b1_4 && (1e-37 < prepared_17.pdf)) ? (1.0 / prepared_17.pdf) : 0.0);
    result_22.direction.x = prepared_17.direction.x;
    result_22.direction.y = prepared_17.direction.y;
    result_22.direction.z = prepared_17.direction.z;
    result_22.distance_ = prepared_17.distance_;
    result_22.pdf = prepared_17.pdf;
    result_22.weight = x5_15;
    result_22.normal.x = x2_25;
    result_22.normal.y = x3_18;
    result_22.normal.z = x4_14;
    result_22.uv.x = 0.0;
    result_22.uv.y = 0.0;
    result_22.emits = b1_4;
    result_22.delta = true;
    EtendueLightSample _e56 = result_22;
    return _e56;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Its one direction, whatever the
// random numbers. The pdf of a sample is distance^2, which is no density; that of a direction is 0.
float etendue_point_light_by_delta_pdf(EtenduePointLightByDelta prepared_18, vec3 w_10) {
    return 0.0;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Its one
// direction, whatever the random numbers. The pdf of a sample is distance^2, which is no density; that of a direction
// is 0.
EtendueLightSample etendue_point_light_by_delta_hit(EtenduePointLightByDelta prepared_19, vec3 w_11) {
    EtendueLightSample result_23 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_24 = -(w_11.x);
    float x2_26 = -(w_11.y);
    float x3_19 = -(w_11.z);
    result_23.direction.x = w_11.x;
    result_23.direction.y = w_11.y;
    result_23.direction.z = w_11.z;
    result_23.distance_ = 0.0;
    result_23.pdf = 0.0;
    result_23.weight = 0.0;
    result_23.normal.x = x1_24;
    result_23.normal.y = x2_26;
    result_23.normal.z = x3_19;
    result_23.uv.x = 0.0;
    result_23.uv.y = 0.0;
    result_23.emits = false;
    result_23.delta = false;
    EtendueLightSample _e40 = result_23;
    return _e40;
}

// Prepares a light for the shading point p. Its one direction, whatever the random numbers. The pdf of a sample is
// distance^2 over the part of I that is emitted there, which is no density, and 0 outside of the cone; that of a
// direction is 0.
EtendueSpotLightByDelta etendue_spot_light_by_delta_prepare(EtendueSpotLight light_6, vec3 p_5) {
    EtendueSpotLightByDelta result_24 = EtendueSpotLightByDelta(vec3(0.0), 0.0, 0.0);
    float x1_25 = (light_6.position.x - p_5.x);
    float x2_27 = (light_6.position.y - p_5.y);
    float x3_20 = (light_6.position.z - p_5.z);
    float _e16 = etendue_greater(abs(x1_25), abs(x2_27));
    float _e18 = etendue_greater(_e16, abs(x3_20));
    float _e20 = etendue_from_bits(2139095040u);
    bool b5_7 = (_e18 < _e20);
    float _e24 = etendue_pow2_scale((b5_7 ? _e18 : 0.0));
    float x7_20 = (_e24 * (b5_7 ? x1_25 : 0.0));
    float x8_16 = (_e24 * (b5_7 ? x2_27 : 0.0));
    float x9_15 = (_e24 * (b5_7 ? x3_20 : 0.0));
    float x10_17 = (x7_20 * x7_20 + (x8_16 * x8_16 + (x9_15 * x9_15)));
    float x11_18 = ((0.0 < x10_17) ? (1.0 / sqrt(x10_17)) : 0.0);
    float x12_15 = ((x10_17 * x11_18) / _e24);
    float x13_15 = (x7_20 * x11_18);
    float x14_16 = (x8_16 * x11_18);
    float x15_14 = (x9_15 * x11_18);
    float _e51 = etendue_from_bits(2139095040u);
    float x16_14 = ((x12_15 < _e51) ? x12_15 : 0.0);
    float x17_10 = (x16_14 * x16_14);
    float x18_11 = (-(x13_15) - light_6.axis.x);
    float x19_9 = (-(x14_16) - light_6.axis.y);
    float x20_12 = (-(x15_14) - light_6.axis.z);
    float x21_10 = ((x18_11 * x18_11 + (x19_9 * x19_9 + (x20_12 * x20_12))) * 0.5);
    float x22_10 = (light_6.one_minus_cos_outer - light_6.one_minus_cos_inner);
    bool b23_2 = (0.0 < x22_10);
    float _e83 = etendue_greater(((light_6.one_minus_cos_outer - x21_10) / (b23_2 ? x22_10 : 1.0)), 0.0);
    float _e85 = etendue_lesser(_e83, 1.0);
    float x25_11 = (b23_2 ? ((_e85 * _e85) * (3.0 - (_e85 + _e85))) : ((x21_10 <= light_6.one_minus_cos_inner) ? 1.0 : 0.0));
    bool b26_ = (0.0 < x25_11);
    float x27_8 = (((x17_10 < 1e37) ? x17_10 : 0.0) / (b26_ ? x25_11 : 1.0));
    float x28_9 = ((b26_ && (x27_8 < 1e37)) ? x27_8 : 0.0);
    result_24.direction.x = x13_15;
    result_24.direction.y = x14_16;
    result_24.direction.z = x15_14;
    result_24.distance_ = x16_14;
    result_24.pdf = x28_9;
    EtendueSpotLightByDelta _e120 = result_24;
    return _e120;
}

// Draws a direction to the light for u in [0, 1)^2. Its one direction, whatever the random numbers. The pdf of a
// sample is distance^2 over the part of I that is emitted there, which is no density, and 0 outside of the cone; that
// of a direction is 0.
EtendueLightSample etendue_spot_light_by_delta_sample(EtendueSpotLightByDelta prepared_20, vec2 u_9) {
    EtendueLightSample result_25 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    bool b1_5 = (0.0 < prepared_20.pdf);
    float x2_28 = -(prepared_20.direction.x);
    float x3_21 = -(prepared_20.direction.y);
    float x4_15 = -(prepared_20.direction.z);
    float x5_16 = ((b1_5 && (1e-37 < prepared_20.pdf)) ? (1.0 / prepared_20.pdf) : 0.0);
    result_25.direction.x = prepared_20.direction.x;
    result_25.direction.y = prepared_20.direction.y;
    result_25.direction.z = prepared_20.direction.z;
    result_25.distance_ = prepared_20.distance_;
    result_25.pdf = prepared_20.pdf;
    result_25.weight = x5_16;
    result_25.normal.x = x2_28;
    result_25.normal.y = x3_21;
    result_25.normal.z = x4_15;
    result_25.uv.x = 0.0;
    result_25.uv.y = 0.0;
    result_25.emits = b1_5;
    result_25.delta = true;
    EtendueLightSample _e56 = result_25;
    return _e56;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Its one direction, whatever the
// random numbers. The pdf of a sample is distance^2 over the part of I that is emitted there, which is no density, and
// 0 outside of the cone; that of a direction is 0.
float etendue_spot_light_by_delta_pdf(EtendueSpotLightByDelta prepared_21, vec3 w_12) {
    return 0.0;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Its one
// direction, whatever the random numbers. The pdf of a sample is distance^2 over the part of I that is emitted there,
// which is no density, and 0 outside of the cone; that of a direction is 0.
EtendueLightSample etendue_spot_light_by_delta_hit(EtendueSpotLightByDelta prepared_22, vec3 w_13) {
    EtendueLightSample result_26 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_26 = -(w_13.x);
    float x2_29 = -(w_13.y);
    float x3_22 = -(w_13.z);
    result_26.direction.x = w_13.x;
    result_26.direction.y = w_13.y;
    result_26.direction.z = w_13.z;
    result_26.distance_ = 0.0;
    result_26.pdf = 0.0;
    result_26.weight = 0.0;
    result_26.normal.x = x1_26;
    result_26.normal.y = x2_29;
    result_26.normal.z = x3_22;
    result_26.uv.x = 0.0;
    result_26.uv.y = 0.0;
    result_26.emits = false;
    result_26.delta = false;
    EtendueLightSample _e40 = result_26;
    return _e40;
}

// Prepares a light for the shading point p. Its one direction, whatever the random numbers. The pdf of a sample is 1,
// which is no density; that of a direction is 0.
EtendueDirectionalLightByDelta etendue_directional_light_by_delta_prepare(EtendueDirectionalLight light_7, vec3 p_6) {
    EtendueDirectionalLightByDelta result_27 = EtendueDirectionalLightByDelta(vec3(0.0));
    result_27.direction.x = light_7.direction.x;
    result_27.direction.y = light_7.direction.y;
    result_27.direction.z = light_7.direction.z;
    EtendueDirectionalLightByDelta _e15 = result_27;
    return _e15;
}

// Draws a direction to the light for u in [0, 1)^2. Its one direction, whatever the random numbers. The pdf of a
// sample is 1, which is no density; that of a direction is 0.
EtendueLightSample etendue_directional_light_by_delta_sample(EtendueDirectionalLightByDelta prepared_23, vec2 u_10) {
    EtendueLightSample result_28 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_27 = -(prepared_23.direction.x);
    float x2_30 = -(prepared_23.direction.y);
    float x3_23 = -(prepared_23.direction.z);
    result_28.direction.x = prepared_23.direction.x;
    result_28.direction.y = prepared_23.direction.y;
    result_28.direction.z = prepared_23.direction.z;
    result_28.distance_ = 3.4028235e38;
    result_28.pdf = 1.0;
    result_28.weight = 1.0;
    result_28.normal.x = x1_27;
    result_28.normal.y = x2_30;
    result_28.normal.z = x3_23;
    result_28.uv.x = 0.0;
    result_28.uv.y = 0.0;
    result_28.emits = true;
    result_28.delta = true;
    EtendueLightSample _e46 = result_28;
    return _e46;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Its one direction, whatever the
// random numbers. The pdf of a sample is 1, which is no density; that of a direction is 0.
float etendue_directional_light_by_delta_pdf(EtendueDirectionalLightByDelta prepared_24, vec3 w_14) {
    return 0.0;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Its one
// direction, whatever the random numbers. The pdf of a sample is 1, which is no density; that of a direction is 0.
EtendueLightSample etendue_directional_light_by_delta_hit(EtendueDirectionalLightByDelta prepared_25, vec3 w_15) {
    EtendueLightSample result_29 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_28 = -(w_15.x);
    float x2_31 = -(w_15.y);
    float x3_24 = -(w_15.z);
    result_29.direction.x = w_15.x;
    result_29.direction.y = w_15.y;
    result_29.direction.z = w_15.z;
    result_29.distance_ = 0.0;
    result_29.pdf = 0.0;
    result_29.weight = 0.0;
    result_29.normal.x = x1_28;
    result_29.normal.y = x2_31;
    result_29.normal.z = x3_24;
    result_29.uv.x = 0.0;
    result_29.uv.y = 0.0;
    result_29.emits = false;
    result_29.delta = false;
    EtendueLightSample _e40 = result_29;
    return _e40;
}

// The key of a seed of 64 bits, in two halves, which the sequences take; all bits count.
uint etendue_sequence_key(uint low, uint high) {
    uint k1_ = (1013904223u + (high * 1664525u));
    uint k2_ = ((1013904223u + (low * 1664525u)) + (k1_ * 4188214367u));
    uint k3_ = (k1_ + (192933365u * k2_));
    uint k4_ = (192933365u + (k2_ * k3_));
    uint k5_ = (4188214367u + (k3_ * k4_));
    uint k6_ = (k3_ ^ (k3_ >> 16u));
    uint k7_ = ((k2_ ^ (k2_ >> 16u)) + (k6_ * (k5_ ^ (k5_ >> 16u))));
    uint k8_ = (k6_ + ((k4_ ^ (k4_ >> 16u)) * k7_));
    uint k9_ = (k7_ ^ ((k8_ << 16u) | (k8_ >> 16u)));
    return k9_;
}

// Independent random numbers, multiples of 2^-24 in [0, 1), for any counters and the key of a seed.
vec2 etendue_independent_pair(uint pixel, uint sample_index, uint dimension, uint key) {
    vec2 result_30 = vec2(0.0);
    uint k1_1 = (1013904223u + (sample_index * 1664525u));
    uint k2_1 = (1013904223u + ((dimension >> 1u) * 1664525u));
    uint k3_1 = (1013904223u + (key * 1664525u));
    uint k4_1 = ((1013904223u + (pixel * 1664525u)) + (k1_1 * k3_1));
    uint k5_1 = (k1_1 + (k2_1 * k4_1));
    uint k6_1 = (k2_1 + (k4_1 * k5_1));
    uint k7_1 = (k3_1 + (k5_1 * k6_1));
    uint k8_1 = (k5_1 ^ (k5_1 >> 16u));
    uint k9_1 = (k6_1 ^ (k6_1 >> 16u));
    uint k10_ = (k7_1 ^ (k7_1 >> 16u));
    uint k11_ = ((k4_1 ^ (k4_1 >> 16u)) + (k8_1 * k10_));
    uint k12_ = (k8_1 + (k9_1 * k11_));
    uint k13_ = (k9_1 + (k11_ * k12_));
    float _e51 = etendue_from_word((dimension & 1u));
    bool b14_1 = (0.0 < _e51);
    float _e53 = etendue_unit(k11_);
    float _e54 = etendue_unit(k13_);
    float x15_15 = (b14_1 ? _e54 : _e53);
    float _e56 = etendue_unit(k12_);
    float _e59 = etendue_unit((k10_ + (k12_ * k13_)));
    float x16_15 = (b14_1 ? _e59 : _e56);
    result_30.x = x15_15;
    result_30.y = x16_15;
    vec2 _e64 = result_30;
    return _e64;
}

// Owen-scrambled Sobol pairs: in every dimension a (0, 2)-sequence in base 2. Best for counts that are a power of two.
vec2 etendue_owen_sobol_pair(uint pixel_1, uint sample_index_1, uint dimension_1, uint key_1) {
    vec2 result_31 = vec2(0.0);
    uint k1_2 = (1013904223u + (dimension_1 * 1664525u));
    uint k2_2 = (1013904223u + (key_1 * 1664525u));
    uint k3_2 = ((1013904223u + (pixel_1 * 1664525u)) + (3457715285u * k2_2));
    uint k4_2 = (3457715285u + (k1_2 * k3_2));
    uint k5_2 = (k1_2 + (k3_2 * k4_2));
    uint k6_2 = (k2_2 + (k4_2 * k5_2));
    uint k7_2 = (k4_2 ^ (k4_2 >> 16u));
    uint k8_2 = (k5_2 ^ (k5_2 >> 16u));
    uint k9_2 = ((k3_2 ^ (k3_2 >> 16u)) + (k7_2 * (k6_2 ^ (k6_2 >> 16u))));
    uint k10_1 = (k7_2 + (k8_2 * k9_2));
    uint k11_1 = (k8_2 + (k9_2 * k10_1));
    uint k12_1 = ((k9_2 + bitfieldReverse(sample_index_1)) * ((k9_2 >> 16u) | 1u));
    uint k13_1 = (k12_1 ^ (k12_1 * 89287766u));
    uint k14_ = bitfieldReverse((k13_1 ^ (k13_1 * 1403136100u)));
    uint k15_ = (k14_ ^ ((k14_ >> 16u) & 65535u));
    uint k16_ = (k15_ ^ ((k15_ >> 8u) & 16711935u));
    uint k17_ = (k16_ ^ ((k16_ >> 4u) & 252645135u));
    uint k18_ = (k17_ ^ ((k17_ >> 2u) & 858993459u));
    uint k19_ = ((k10_1 + k14_) * (1u | (k10_1 >> 16u)));
    uint k20_ = (k19_ ^ (89287766u * k19_));
    float _e91 = etendue_unit(bitfieldReverse((k20_ ^ (1403136100u * k20_))));
    uint k22_ = ((k11_1 + (k18_ ^ ((k18_ >> 1u) & 1431655765u))) * (1u | (k11_1 >> 16u)));
    uint k23_ = (k22_ ^ (89287766u * k22_));
    float _e110 = etendue_unit(bitfieldReverse((k23_ ^ (1403136100u * k23_))));
    result_31.x = _e91;
    result_31.y = _e110;
    vec2 _e114 = result_31;
    return _e114;
}

// What the weights take for a technique with this number of samples and this density; infinite where delta holds.
float etendue_technique_pdf(float samples, float pdf, bool delta) {
    float _e5 = etendue_greater((samples * pdf), 0.0);
    float _e7 = etendue_lesser(_e5, 3.4028235e38);
    float _e9 = etendue_from_bits(2139095040u);
    float x1_29 = (delta ? _e9 : _e7);
    return x1_29;
}

// The weights of two techniques by the balance heuristic, given the number of samples times the density of each; their
// sum is 1 within 2^-23, or 0 where both densities are.
vec2 etendue_balance_weights(float first, float second) {
    vec2 result_32 = vec2(0.0);
    float _e3 = etendue_greater(first, 0.0);
    float _e5 = etendue_greater(second, 0.0);
    float _e7 = etendue_greater(0.0, _e3);
    float _e8 = etendue_greater(_e7, _e5);
    bool b4_6 = (0.0 < _e8);
    float x5_17 = (b4_6 ? _e8 : 1.0);
    float x6_18 = ((b4_6 && (0.0 < _e3)) ? ((_e8 <= _e3) ? 1.0 : (_e3 / x5_17)) : 0.0);
    float x7_21 = ((b4_6 && (0.0 < _e5)) ? ((_e8 <= _e5) ? 1.0 : (_e5 / x5_17)) : 0.0);
    float x8_17 = (b4_6 ? (x7_21 + (0.0 + x6_18)) : 1.0);
    float x9_16 = (x6_18 / x8_17);
    float x10_18 = (x7_21 / x8_17);
    result_32.x = x9_16;
    result_32.y = x10_18;
    vec2 _e41 = result_32;
    return _e41;
}

// The weights of two techniques by the power heuristic with exponent 2, given the number of samples times the density
// of each; their sum is 1 within 2^-23, or 0 where both densities are.
vec2 etendue_power_weights(float first_1, float second_1) {
    vec2 result_33 = vec2(0.0);
    float _e3 = etendue_greater(first_1, 0.0);
    float _e5 = etendue_greater(second_1, 0.0);
    float _e7 = etendue_greater(0.0, _e3);
    float _e8 = etendue_greater(_e7, _e5);
    bool b4_7 = (0.0 < _e8);
    float x5_18 = (b4_7 ? _e8 : 1.0);
    float x6_19 = ((b4_7 && (0.0 < _e3)) ? ((_e8 <= _e3) ? 1.0 : (_e3 / x5_18)) : 0.0);
    float x7_22 = (x6_19 * x6_19);
    float x8_18 = ((b4_7 && (0.0 < _e5)) ? ((_e8 <= _e5) ? 1.0 : (_e5 / x5_18)) : 0.0);
    float x9_17 = (x8_18 * x8_18);
    float x10_19 = (b4_7 ? (x9_17 + (0.0 + x7_22)) : 1.0);
    float x11_19 = (x7_22 / x10_19);
    float x12_16 = (x9_17 / x10_19);
    result_33.x = x11_19;
    result_33.y = x12_16;
    vec2 _e43 = result_33;
    return _e43;
}

// The weight, over its density, of a sample of a light with these fields, where the surface draws the same direction
// with the density bsdf_pdf: by the power heuristic, one sample each. 0 where there is no sample.
float etendue_power_light_weight(float pdf_1, bool emits, bool delta_1, float bsdf_pdf) {
    float _e5 = etendue_greater(pdf_1, 0.0);
    float _e7 = etendue_lesser(_e5, 3.4028235e38);
    float _e9 = etendue_from_bits(2139095040u);
    float _e12 = etendue_greater((delta_1 ? _e9 : _e7), 0.0);
    float _e14 = etendue_greater(bsdf_pdf, 0.0);
    float _e16 = etendue_greater(0.0, _e12);
    float _e17 = etendue_greater(_e16, _e14);
    bool b4_8 = (0.0 < _e17);
    float x5_19 = (b4_8 ? _e17 : 1.0);
    float x6_20 = ((b4_8 && (0.0 < _e12)) ? ((_e17 <= _e12) ? 1.0 : (_e12 / x5_19)) : 0.0);
    float x7_23 = (x6_20 * x6_20);
    float x8_19 = ((b4_8 && (0.0 < _e14)) ? ((_e17 <= _e14) ? 1.0 : (_e14 / x5_19)) : 0.0);
    float x9_18 = ((x7_23 / (b4_8 ? ((x8_19 * x8_19) + (0.0 + x7_23)) : 1.0)) * ((emits && (1e-37 < pdf_1)) ? (1.0 / pdf_1) : 0.0));
    return x9_18;
}

// The weight, over its density, of a direction that the surface drew with the density bsdf_pdf, where it hits a light
// with these fields: by the power heuristic, one sample each. 0 where the light is missed.
float etendue_power_bsdf_weight(float bsdf_pdf_1, float pdf_2, bool emits_1) {
    bool b1_6 = ((emits_1 && (1e-37 < bsdf_pdf_1)) && (0.0 < pdf_2));
    float _e10 = etendue_greater(bsdf_pdf_1, 0.0);
    float _e12 = etendue_greater(pdf_2, 0.0);
    float _e14 = etendue_greater(0.0, _e10);
    float _e15 = etendue_greater(_e14, _e12);
    bool b5_8 = (0.0 < _e15);
    float x6_21 = (b5_8 ? _e15 : 1.0);
    float x7_24 = ((b5_8 && (0.0 < _e10)) ? ((_e15 <= _e10) ? 1.0 : (_e10 / x6_21)) : 0.0);
    float x8_20 = (x7_24 * x7_24);
    float x9_19 = ((b5_8 && (0.0 < _e12)) ? ((_e15 <= _e12) ? 1.0 : (_e12 / x6_21)) : 0.0);
    float _e48 = etendue_from_bits(2139095040u);
    float x10_20 = ((x8_20 / (b5_8 ? ((x9_19 * x9_19) + (0.0 + x8_20)) : 1.0)) / ((b1_6 && !((_e48 <= bsdf_pdf_1))) ? bsdf_pdf_1 : 1.0));
    float x11_20 = (b1_6 ? x10_20 : 0.0);
    return x11_20;
}

// The factor of the radiance in or against the unit direction w of a flat light with the unit normal n that emits
// within an angle of it, on either side: (tan_half - tan theta) gain, with theta the angle to the normal, tan_half the
// tangent of half the spread, and gain 1/(tan_half - half the spread); 0 beyond. Within 4e-7 of the factor on the
// axis.
float etendue_spread_attenuation(float tan_half, float gain, vec3 w_16, vec3 n) {
    float x1_30 = abs((w_16.x * n.x + (w_16.y * n.y + (w_16.z * n.z))));
    bool b2_2 = (0.0 < x1_30);
    float x3_25 = -((w_16.z * n.y));
    float x4_16 = ((w_16.y * n.z + x3_25) - (w_16.z * n.y + x3_25));
    float x5_20 = -((w_16.x * n.z));
    float x6_22 = ((w_16.z * n.x + x5_20) - (w_16.x * n.z + x5_20));
    float x7_25 = -((w_16.y * n.x));
    float x8_21 = ((w_16.x * n.y + x7_25) - (w_16.y * n.x + x7_25));
    float x9_20 = (tan_half - (sqrt((x4_16 * x4_16 + (x6_22 * x6_22 + (x8_21 * x8_21)))) / (b2_2 ? x1_30 : 1.0)));
    float _e60 = etendue_greater((gain * x9_20), 0.0);
    float x10_21 = (b2_2 ? _e60 : 0.0);
    return x10_21;
}

// The position in [0, 1)^2, from the upper left corner, of the unit direction w in an image that a light projects
// along +z, with these tangents of half the horizontal and vertical angle of view: (1 + w.x/(w.z tan_half.x))/2 and (1
// - w.y/(w.z tan_half.y))/2; 0 where w misses the image. Within 2e-7 over the cosine to the axis.
vec2 etendue_projector_place(vec2 tan_half_1, vec3 w_17) {
    vec2 result_34 = vec2(0.0);
    float x1_31 = (tan_half_1.x * w_17.z);
    float x2_32 = (tan_half_1.y * w_17.z);
    bool b3_4 = ((((0.0 < x1_31) && (0.0 < x2_32)) && (-(x1_31) <= w_17.x)) && (w_17.x < x1_31));
    bool b4_9 = ((b3_4 && (-(x2_32) < w_17.y)) && (w_17.y <= x2_32));
    float _e36 = etendue_greater((0.5 * (w_17.x / (b4_9 ? x1_31 : 1.0)) + 0.5), 0.0);
    float _e38 = etendue_lesser(_e36, 0.99999994);
    float x5_21 = (b4_9 ? _e38 : 0.0);
    float _e50 = etendue_greater((0.5 * (-(w_17.y) / (b4_9 ? x2_32 : 1.0)) + 0.5), 0.0);
    float _e52 = etendue_lesser(_e50, 0.99999994);
    float x6_23 = (b4_9 ? _e52 : 0.0);
    result_34.x = x5_21;
    result_34.y = x6_23;
    vec2 _e57 = result_34;
    return _e57;
}

// Whether the unit direction w is in an image that a light projects along +z, with these tangents of half the angles
// of view; false for tangents that are not greater than 0.
bool etendue_projector_has(vec2 tan_half_2, vec3 w_18) {
    float x1_32 = (tan_half_2.x * w_18.z);
    float x2_33 = (tan_half_2.y * w_18.z);
    bool b3_5 = ((((0.0 < x1_32) && (0.0 < x2_33)) && (-(x1_32) <= w_18.x)) && (w_18.x < x1_32));
    bool b4_10 = ((b3_5 && (-(x2_33) < w_18.y)) && (w_18.y <= x2_33));
    return b4_10;
}

// The unit direction in which the light of a position in a projected image travels: the inverse of projector_place.
vec3 etendue_projector_direction(vec2 tan_half_3, vec2 uv) {
    vec3 result_35 = vec3(0.0);
    float x1_33 = (tan_half_3.x * (uv.x * 2.0 + -1.0));
    float x2_34 = (tan_half_3.y * -((uv.y * 2.0 + -1.0)));
    float x3_26 = (x1_33 * x1_33 + (x2_34 * x2_34 + 1.0));
    float x4_17 = ((0.0 < x3_26) ? (1.0 / sqrt(x3_26)) : 0.0);
    float x5_22 = (x1_33 * x4_17);
    float x6_24 = (x2_34 * x4_17);
    result_35.x = x5_22;
    result_35.y = x6_24;
    result_35.z = x4_17;
    vec3 _e31 = result_35;
    return _e31;
}

// The unit direction of a position in [0, 1]^2 in the image of the sky for a portal with these unit edges and unit
// normal edge_s x edge_t: a direction x s + y t + z n has the position (atan(x/z)/pi + 1/2, atan(y/z)/pi + 1/2). The
// scale does not matter.
vec3 etendue_portal_direction(vec3 edge_s, vec3 edge_t, vec3 normal, float scale, vec2 uv_1) {
    vec3 result_36 = vec3(0.0);
    vec2 _e10 = etendue_sin_cos_turns((0.5 * (uv_1.x - 0.5)));
    vec2 _e16 = etendue_sin_cos_turns((0.5 * (uv_1.y - 0.5)));
    float x3_27 = (_e10.x * _e16.y);
    float x4_18 = (_e10.y * _e16.x);
    float x5_23 = (_e10.y * _e16.y);
    float x6_25 = (edge_s.x * x3_27 + (edge_t.x * x4_18 + (normal.x * x5_23)));
    float x7_26 = (edge_s.y * x3_27 + (edge_t.y * x4_18 + (normal.y * x5_23)));
    float x8_22 = (edge_s.z * x3_27 + (edge_t.z * x4_18 + (normal.z * x5_23)));
    float _e46 = etendue_greater(abs(x6_25), abs(x7_26));
    float _e48 = etendue_greater(_e46, abs(x8_22));
    float _e49 = etendue_pow2_scale(_e48);
    float x10_22 = (x6_25 * _e49);
    float x11_21 = (x7_26 * _e49);
    float x12_17 = (x8_22 * _e49);
    float x13_16 = (x10_22 * x10_22 + (x11_21 * x11_21 + (x12_17 * x12_17)));
    float x14_17 = ((0.0 < x13_16) ? (1.0 / sqrt(x13_16)) : 0.0);
    float x15_16 = (x10_22 * x14_17);
    float x16_16 = (x11_21 * x14_17);
    float x17_11 = (x12_17 * x14_17);
    result_36.x = x15_16;
    result_36.y = x16_16;
    result_36.z = x17_11;
    vec3 _e70 = result_36;
    return _e70;
}

// The solid angle at a position in the image of the sky for a portal, per unit of the image's area, in steradians:
// what portal_direction stretches. scale is pi^2 times the sine of the angle between the edges.
float etendue_portal_solid_angle(vec3 edge_s_1, vec3 edge_t_1, vec3 normal_1, float scale_1, vec2 uv_2) {
    vec2 _e10 = etendue_sin_cos_turns((0.5 * (uv_2.x - 0.5)));
    vec2 _e16 = etendue_sin_cos_turns((0.5 * (uv_2.y - 0.5)));
    float x3_28 = (_e10.x * _e16.y);
    float x4_19 = (_e10.y * _e16.x);
    float x5_24 = (_e10.y * _e16.y);
    float x6_26 = (edge_s_1.x * x3_28 + (edge_t_1.x * x4_19 + (normal_1.x * x5_24)));
    float x7_27 = (edge_s_1.y * x3_28 + (edge_t_1.y * x4_19 + (normal_1.y * x5_24)));
    float x8_23 = (edge_s_1.z * x3_28 + (edge_t_1.z * x4_19 + (normal_1.z * x5_24)));
    float _e46 = etendue_greater(abs(x6_26), abs(x7_27));
    float _e48 = etendue_greater(_e46, abs(x8_23));
    float _e49 = etendue_pow2_scale(_e48);
    float x10_23 = (x6_26 * _e49);
    float x11_22 = (x7_27 * _e49);
    float x12_18 = (x8_23 * _e49);
    float x13_17 = (x10_23 * x10_23 + (x11_22 * x11_22 + (x12_18 * x12_18)));
    float x14_18 = ((x13_17 * ((0.0 < x13_17) ? (1.0 / sqrt(x13_17)) : 0.0)) / _e49);
    bool b15_2 = (0.0 < x14_18);
    float x16_17 = (b15_2 ? x14_18 : 1.0);
    float x17_12 = (((scale_1 * (_e10.y / x16_17)) * (_e16.y / x16_17)) / x14_18);
    float _e79 = etendue_greater((b15_2 ? x17_12 : 0.0), 0.0);
    float _e81 = etendue_lesser(_e79, 3.4028235e38);
    return _e81;
}
