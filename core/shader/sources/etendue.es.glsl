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
    float cos_inner;
    float cos_outer;
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
// concentric squares: keeps strata compact.
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
// squares: keeps strata compact.
float etendue_concentric_disk_pdf(vec2 point) {
    float x1_4 = (((point.x * point.x + (point.y * point.y)) <= 1.0000004) ? 0.31830987 : 0.0);
    return x1_4;
}

// Maps u, of which each number is in [0, 1), to a point. Directions with z >= 0 and the pdf z/pi per steradian.
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

// The density of a point; 0 outside of the range. Directions with z >= 0 and the pdf z/pi per steradian.
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
    bool b24_ = ((b10_1 && b19_) && (1e-33 < x23_));
    float x25_ = (x20_ * x23_);
    float _e89 = etendue_lesser((b24_ ? (2.0 / ((x12_1 * (x11_2 * 3.1415927)) * (b24_ ? x23_ : 1.0))) : 0.0), 3.4028235e38);
    result_4.alpha.x = x11_2;
    result_4.alpha.y = x12_1;
    result_4.inverse_alpha.x = x13_1;
    result_4.inverse_alpha.y = x14_1;
    result_4.view.x = x7_4;
    result_4.view.y = x8_3;
    result_4.view.z = x9_2;
    result_4.stretched_x = x21_;
    result_4.stretched_y = x22_;
    result_4.height = x25_;
    result_4.scale = _e89;
    EtendueGgxVisibleNormals _e109 = result_4;
    return _e109;
}

// Maps u, of which each number is in [0, 1), to a point. Visible normals of a GGX microsurface, per steradian.
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
    bool b17_ = (0.5 < (x14_2 * x14_2 + (x15_1 * x15_1 + (x16_1 * x16_1))));
    float x18_1 = (b17_ ? x14_2 : 0.0);
    float x19_ = (b17_ ? x15_1 : 0.0);
    float x20_1 = (b17_ ? x16_1 : 1.0);
    result_5.x = x18_1;
    result_5.y = x19_;
    result_5.z = x20_1;
    vec3 _e76 = result_5;
    return _e76;
}

// The density of a point; 0 outside of the range. Visible normals of a GGX microsurface, per steradian.
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
    float x15_2 = (x11_4 * x11_4);
    float x16_2 = (x12_3 * x12_3);
    float x17_1 = (x13_3 * x13_3);
    float x18_2 = (x14_3 * x14_3);
    float x19_1 = (x15_2 - x18_2);
    float x20_2 = (x19_1 - x15_2);
    float x21_1 = (x16_2 + x19_1);
    float x22_1 = (x21_1 - x19_1);
    float x23_1 = (x17_1 + x21_1);
    float x24_ = (x23_1 - x21_1);
    float x25_1 = (((x15_2 - (x19_1 - x20_2)) + (-(x18_2) - x20_2)) + ((x19_1 - (x21_1 - x22_1)) + (x16_2 - x22_1)));
    float x26_ = (((x11_4 * x11_4 + -(x15_2)) - (x14_3 * x14_3 + -(x18_2))) + ((x12_3 * x12_3 + -(x16_2)) + (x13_3 * x13_3 + -(x17_1))));
    float x27_1 = (x23_1 + ((((x21_1 - (x23_1 - x24_)) + (x17_1 - x24_)) + x25_1) + x26_));
    float x28_1 = (x11_4 * x11_4 + (x12_3 * x12_3 + x17_1));
    bool b29_ = (0.0 < x28_1);
    float x30_ = (1.0 / (b29_ ? x28_1 : 1.0));
    float _e91 = etendue_lesser((x18_2 * x30_), 1.0);
    float _e94 = etendue_greater(x27_1, 0.0);
    float x31_ = (_e91 / (1.0 + sqrt((x30_ * _e94))));
    float x32_ = sqrt(x28_1);
    float _e100 = etendue_pow2_scale(_e35);
    float x34_ = (x5_4 * _e100);
    float x35_ = (x6_6 * _e100);
    float x36_ = (x7_5 * _e100);
    float x37_ = (x34_ * x34_ + (x35_ * x35_ + (x36_ * x36_)));
    float x38_ = ((0.0 < x37_) ? (1.0 / sqrt(x37_)) : 0.0);
    float x39_ = (x34_ * x38_);
    float x40_ = (x35_ * x38_);
    float x41_ = (x36_ * x38_);
    float _e121 = etendue_greater(abs(x39_), abs(x40_));
    float _e123 = etendue_greater(_e121, abs(x41_));
    float x42_ = ((0.0 < _e123) ? x41_ : 1.0);
    float _e127 = etendue_copysign(1.0, x42_);
    float x44_ = (-1.0 / (x42_ + _e127));
    float x45_ = (x44_ * (x39_ * x40_));
    float x46_ = (x39_ * _e127);
    float x47_ = (x39_ * (x44_ * x46_) + 1.0);
    float x48_ = (_e127 * x45_);
    float x49_ = -(x46_);
    float x50_ = (x40_ * (x40_ * x44_) + _e127);
    float x51_ = -(x40_);
    float x52_ = ((0.0 < x14_3) ? ((b29_ && (0.0 <= x27_1)) ? x31_ : 2.0) : 0.0);
    float x53_ = (1.0 / _e38);
    result_6.surface_center.x = x1_8;
    result_6.surface_center.y = x2_8;
    result_6.surface_center.z = x3_5;
    result_6.surface_radius = light.radius;
    result_6.shape_frame_s.x = x47_;
    result_6.shape_frame_s.y = x48_;
    result_6.shape_frame_s.z = x49_;
    result_6.shape_frame_t.x = x45_;
    result_6.shape_frame_t.y = x50_;
    result_6.shape_frame_t.z = x51_;
    result_6.shape_frame_n.x = x39_;
    result_6.shape_frame_n.y = x40_;
    result_6.shape_frame_n.z = x42_;
    result_6.shape_cone_one_minus_cos = x52_;
    result_6.shape_distance = x32_;
    result_6.shape_power = x27_1;
    result_6.shape_unit = x53_;
    EtendueSphereBySolidAngle _e184 = result_6;
    return _e184;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian. From inside, every direction.
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
    float _e119 = etendue_greater(abs(prepared_2.surface_radius), 0.0);
    float _e121 = etendue_greater(_e119, 0.0);
    float _e122 = etendue_greater(_e115, _e121);
    float _e124 = etendue_from_bits(2139095040u);
    bool b19_1 = (_e122 < _e124);
    float _e126 = etendue_pow2_scale(_e122);
    float x21_2 = (_e126 * (b19_1 ? prepared_2.surface_center.x : 0.0));
    float x22_2 = (_e126 * (b19_1 ? prepared_2.surface_center.y : 0.0));
    float x23_2 = (_e126 * (b19_1 ? prepared_2.surface_center.z : 0.0));
    float x24_1 = (_e126 * (b19_1 ? prepared_2.surface_radius : 0.0));
    float x25_2 = (x21_2 * x21_2);
    float x26_1 = (x22_2 * x22_2);
    float x27_2 = (x23_2 * x23_2);
    float x28_2 = (x24_1 * x24_1);
    float x29_ = (x25_2 - x28_2);
    float x30_1 = (x29_ - x25_2);
    float x31_1 = (x26_1 + x29_);
    float x32_1 = (x31_1 - x29_);
    float x33_ = (x27_2 + x31_1);
    float x34_1 = (x33_ - x31_1);
    float x35_1 = (((x25_2 - (x29_ - x30_1)) + (-(x28_2) - x30_1)) + ((x29_ - (x31_1 - x32_1)) + (x26_1 - x32_1)));
    float x36_1 = (((x21_2 * x21_2 + -(x25_2)) - (x24_1 * x24_1 + -(x28_2))) + ((x22_2 * x22_2 + -(x26_1)) + (x23_2 * x23_2 + -(x27_2))));
    float x37_1 = (x33_ + ((((x31_1 - (x33_ - x34_1)) + (x27_2 - x34_1)) + x35_1) + x36_1));
    float x38_1 = (x13_4 * x21_2 + (x14_4 * x22_2 + (x15_3 * x23_2)));
    float x39_1 = (x13_4 * -(x38_1) + x21_2);
    float x40_1 = (x14_4 * -(x38_1) + x22_2);
    float x41_1 = (x15_3 * -(x38_1) + x23_2);
    float _e199 = etendue_greater((x24_1 * x24_1 + -((x39_1 * x39_1 + (x40_1 * x40_1 + (x41_1 * x41_1))))), 0.0);
    float x42_1 = sqrt(_e199);
    float x43_ = (x42_1 + abs(x38_1));
    bool b44_ = (1e-37 < abs(x43_));
    float _e213 = etendue_greater((b44_ ? (abs(x37_1) / (b44_ ? x43_ : 1.0)) : 0.0), -1e37);
    float _e215 = etendue_lesser(_e213, 1e37);
    float x45_1 = ((!((0.0 <= x37_1)) && (0.0 <= x38_1)) ? x43_ : _e215);
    float x46_1 = (x13_4 * x45_1 + -(x21_2));
    float x47_1 = (x14_4 * x45_1 + -(x22_2));
    float x48_1 = (x15_3 * x45_1 + -(x23_2));
    float x49_1 = (x46_1 * x46_1 + (x47_1 * x47_1 + (x48_1 * x48_1)));
    float x50_1 = ((0.0 < x49_1) ? (1.0 / sqrt(x49_1)) : 0.0);
    float x51_1 = (x46_1 * x50_1);
    float x52_1 = (x47_1 * x50_1);
    float x53_1 = (x48_1 * x50_1);
    float x54_ = ((0.5 < x53_1) ? ((x51_1 * x51_1 + (x52_1 * x52_1)) / (1.0 + abs(x53_1))) : (1.0 - x53_1));
    float _e256 = etendue_greater((x54_ / 2.0), 0.0);
    float _e258 = etendue_lesser(_e256, 0.99999994);
    float _e259 = etendue_angle(x52_1, x51_1);
    float x56_ = (_e259 * 0.15915494);
    float _e268 = etendue_greater(((x56_ < 0.0) ? (1.0 + x56_) : x56_), 0.0);
    float _e270 = etendue_lesser(_e268, 0.99999994);
    bool b58_ = (1e-37 < _e42);
    float x59_ = (b58_ ? (0.15915494 / (b58_ ? _e42 : 1.0)) : 0.0);
    bool b60_ = !((prepared_2.shape_power < 0.0));
    bool b61_ = (b60_ && (1e-37 < x59_));
    float x62_ = (b61_ ? (1.0 / (b61_ ? x59_ : 1.0)) : 0.0);
    result_7.direction.x = x13_4;
    result_7.direction.y = x14_4;
    result_7.direction.z = x15_3;
    result_7.distance_ = _e102;
    result_7.pdf = x59_;
    result_7.weight = x62_;
    result_7.normal.x = x51_1;
    result_7.normal.y = x52_1;
    result_7.normal.z = x53_1;
    result_7.uv.x = _e258;
    result_7.uv.y = _e270;
    result_7.emits = b60_;
    result_7.delta = false;
    EtendueLightSample _e315 = result_7;
    return _e315;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the solid angle
// Omega at the point p: pdf 1/Omega per steradian. From inside, every direction.
float etendue_sphere_by_solid_angle_pdf(EtendueSphereBySolidAngle prepared_3, vec3 w) {
    float x1_10 = (prepared_3.shape_frame_s.x * w.x + (prepared_3.shape_frame_s.y * w.y + (prepared_3.shape_frame_s.z * w.z)));
    float x2_10 = (prepared_3.shape_frame_t.x * w.x + (prepared_3.shape_frame_t.y * w.y + (prepared_3.shape_frame_t.z * w.z)));
    float x3_6 = (prepared_3.shape_frame_n.x * w.x + (prepared_3.shape_frame_n.y * w.y + (prepared_3.shape_frame_n.z * w.z)));
    float _e40 = etendue_greater(prepared_3.shape_cone_one_minus_cos, 0.0);
    float _e42 = etendue_lesser(_e40, 2.0);
    bool b5_1 = (1e-37 < _e42);
    float x6_7 = ((0.5 < x3_6) ? ((x1_10 * x1_10 + (x2_10 * x2_10)) / (1.0 + abs(x3_6))) : (1.0 - x3_6));
    float _e63 = etendue_greater(sqrt((_e42 * (2.0 - _e42))), (_e42 - 1.0));
    float x7_7 = (_e42 + (5.9604645e-7 * _e63 + 1.7763568e-13));
    float x8_6 = ((x6_7 <= x7_7) ? (b5_1 ? (0.15915494 / (b5_1 ? _e42 : 1.0)) : 0.0) : 0.0);
    return x8_6;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian. From inside, every direction.
EtendueLightSample etendue_sphere_by_solid_angle_hit(EtendueSphereBySolidAngle prepared_4, vec3 w_1) {
    EtendueLightSample result_8 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_11 = (prepared_4.shape_frame_s.x * w_1.x + (prepared_4.shape_frame_s.y * w_1.y + (prepared_4.shape_frame_s.z * w_1.z)));
    float x2_11 = (prepared_4.shape_frame_t.x * w_1.x + (prepared_4.shape_frame_t.y * w_1.y + (prepared_4.shape_frame_t.z * w_1.z)));
    float x3_7 = (prepared_4.shape_frame_n.x * w_1.x + (prepared_4.shape_frame_n.y * w_1.y + (prepared_4.shape_frame_n.z * w_1.z)));
    float _e40 = etendue_greater(prepared_4.shape_cone_one_minus_cos, 0.0);
    float _e42 = etendue_lesser(_e40, 2.0);
    bool b5_2 = (1e-37 < _e42);
    float x6_8 = ((0.5 < x3_7) ? ((x1_11 * x1_11 + (x2_11 * x2_11)) / (1.0 + abs(x3_7))) : (1.0 - x3_7));
    float _e63 = etendue_greater(sqrt((_e42 * (2.0 - _e42))), (_e42 - 1.0));
    float x7_8 = (_e42 + (5.9604645e-7 * _e63 + 1.7763568e-13));
    float x8_7 = ((x6_8 <= x7_8) ? (b5_2 ? (0.15915494 / (b5_2 ? _e42 : 1.0)) : 0.0) : 0.0);
    bool b9_1 = (0.0 < x8_7);
    float _e85 = etendue_greater(abs(prepared_4.surface_center.x), abs(prepared_4.surface_center.y));
    float _e89 = etendue_greater(_e85, abs(prepared_4.surface_center.z));
    float _e90 = etendue_greater(0.0, _e89);
    float _e94 = etendue_greater(abs(prepared_4.surface_radius), 0.0);
    float _e96 = etendue_greater(_e94, 0.0);
    float _e97 = etendue_greater(_e90, _e96);
    float _e99 = etendue_from_bits(2139095040u);
    bool b11_ = (_e97 < _e99);
    float _e101 = etendue_pow2_scale(_e97);
    float x13_5 = (_e101 * (b11_ ? prepared_4.surface_center.x : 0.0));
    float x14_5 = (_e101 * (b11_ ? prepared_4.surface_center.y : 0.0));
    float x15_4 = (_e101 * (b11_ ? prepared_4.surface_center.z : 0.0));
    float x16_4 = (_e101 * (b11_ ? prepared_4.surface_radius : 0.0));
    float x17_2 = (x13_5 * x13_5);
    float x18_3 = (x14_5 * x14_5);
    float x19_2 = (x15_4 * x15_4);
    float x20_3 = (x16_4 * x16_4);
    float x21_3 = (x17_2 - x20_3);
    float x22_3 = (x21_3 - x17_2);
    float x23_3 = (x18_3 + x21_3);
    float x24_2 = (x23_3 - x21_3);
    float x25_3 = (x19_2 + x23_3);
    float x26_2 = (x25_3 - x23_3);
    float x27_3 = (((x17_2 - (x21_3 - x22_3)) + (-(x20_3) - x22_3)) + ((x21_3 - (x23_3 - x24_2)) + (x18_3 - x24_2)));
    float x28_3 = (((x13_5 * x13_5 + -(x17_2)) - (x16_4 * x16_4 + -(x20_3))) + ((x14_5 * x14_5 + -(x18_3)) + (x15_4 * x15_4 + -(x19_2))));
    float x29_1 = (x25_3 + ((((x23_3 - (x25_3 - x26_2)) + (x19_2 - x26_2)) + x27_3) + x28_3));
    float x30_2 = (w_1.x * x13_5 + (w_1.y * x14_5 + (w_1.z * x15_4)));
    float x31_2 = (w_1.x * -(x30_2) + x13_5);
    float x32_2 = (w_1.y * -(x30_2) + x14_5);
    float x33_1 = (w_1.z * -(x30_2) + x15_4);
    float _e180 = etendue_greater((x16_4 * x16_4 + -((x31_2 * x31_2 + (x32_2 * x32_2 + (x33_1 * x33_1))))), 0.0);
    float x34_2 = sqrt(_e180);
    float x35_2 = (x34_2 + abs(x30_2));
    bool b36_ = (1e-37 < abs(x35_2));
    float _e194 = etendue_greater((b36_ ? (abs(x29_1) / (b36_ ? x35_2 : 1.0)) : 0.0), -1e37);
    float _e196 = etendue_lesser(_e194, 1e37);
    float x37_2 = ((!((0.0 <= x29_1)) && (0.0 <= x30_2)) ? x35_2 : _e196);
    float x38_2 = (w_1.x * x37_2 + -(x13_5));
    float x39_2 = (w_1.y * x37_2 + -(x14_5));
    float x40_2 = (w_1.z * x37_2 + -(x15_4));
    float x41_2 = (x38_2 * x38_2 + (x39_2 * x39_2 + (x40_2 * x40_2)));
    float x42_2 = ((0.0 < x41_2) ? (1.0 / sqrt(x41_2)) : 0.0);
    float x43_1 = (x38_2 * x42_2);
    float x44_1 = (x39_2 * x42_2);
    float x45_2 = (x40_2 * x42_2);
    float x46_2 = ((0.5 < x45_2) ? ((x43_1 * x43_1 + (x44_1 * x44_1)) / (1.0 + abs(x45_2))) : (1.0 - x45_2));
    float _e240 = etendue_greater((x46_2 / 2.0), 0.0);
    float _e242 = etendue_lesser(_e240, 0.99999994);
    float _e244 = etendue_angle(x44_1, x43_1);
    float x48_2 = (0.15915494 * _e244);
    float _e252 = etendue_greater(((x48_2 < 0.0) ? (1.0 + x48_2) : x48_2), 0.0);
    float _e254 = etendue_lesser(_e252, 0.99999994);
    float _e258 = etendue_lesser((x37_2 / _e101), 3.4028235e38);
    float x50_2 = (b9_1 ? _e258 : 0.0);
    bool b51_ = (!((prepared_4.shape_power < 0.0)) && b9_1);
    bool b52_ = (b51_ && (1e-37 < x8_7));
    float x53_2 = (b52_ ? (1.0 / (b52_ ? x8_7 : 1.0)) : 0.0);
    result_8.direction.x = w_1.x;
    result_8.direction.y = w_1.y;
    result_8.direction.z = w_1.z;
    result_8.distance_ = x50_2;
    result_8.pdf = x8_7;
    result_8.weight = x53_2;
    result_8.normal.x = x43_1;
    result_8.normal.y = x44_1;
    result_8.normal.z = x45_2;
    result_8.uv.x = _e242;
    result_8.uv.y = _e254;
    result_8.emits = b51_;
    result_8.delta = false;
    EtendueLightSample _e300 = result_8;
    return _e300;
}

// Prepares a light for the shading point p. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
EtendueTriangleBySolidAngle etendue_triangle_by_solid_angle_prepare(EtendueTriangle light_1, vec3 p_1) {
    float x274_ = 0.0;
    float x275_ = 0.0;
    bool b276_ = false;
    bool b277_ = false;
    float x278_ = 0.0;
    float x360_ = 0.0;
    EtendueTriangleBySolidAngle result_9 = EtendueTriangleBySolidAngle(vec3(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, vec2(0.0), vec2(0.0), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    float x1_12 = (light_1.v0_.x - p_1.x);
    float x2_12 = (light_1.v0_.y - p_1.y);
    float x3_8 = (light_1.v0_.z - p_1.z);
    float _e17 = etendue_greater(abs(x1_12), abs(x2_12));
    float _e19 = etendue_greater(_e17, abs(x3_8));
    float _e20 = etendue_greater(0.0, _e19);
    float _e27 = etendue_greater(abs(light_1.e1_.x), abs(light_1.e1_.y));
    float _e31 = etendue_greater(_e27, abs(light_1.e1_.z));
    float _e38 = etendue_greater(abs(light_1.e2_.x), abs(light_1.e2_.y));
    float _e42 = etendue_greater(_e38, abs(light_1.e2_.z));
    float _e43 = etendue_greater(_e20, _e31);
    float _e44 = etendue_greater(_e43, _e42);
    float _e46 = etendue_from_bits(2139095040u);
    bool b8_ = (_e44 < _e46);
    float _e48 = etendue_pow2_scale(_e44);
    float x10_4 = (_e48 * (b8_ ? x1_12 : 0.0));
    float x11_6 = (_e48 * (b8_ ? x2_12 : 0.0));
    float x12_5 = (_e48 * (b8_ ? x3_8 : 0.0));
    float x13_6 = (_e48 * (b8_ ? light_1.e1_.x : 0.0));
    float x14_6 = (_e48 * (b8_ ? light_1.e1_.y : 0.0));
    float x15_5 = (_e48 * (b8_ ? light_1.e1_.z : 0.0));
    float x16_5 = (_e48 * (b8_ ? light_1.e2_.x : 0.0));
    float x17_3 = (_e48 * (b8_ ? light_1.e2_.y : 0.0));
    float x18_4 = (_e48 * (b8_ ? light_1.e2_.z : 0.0));
    float _e90 = etendue_greater(abs(x13_6), abs(x14_6));
    float _e92 = etendue_greater(_e90, abs(x15_5));
    float _e93 = etendue_pow2_scale(_e92);
    float _e96 = etendue_greater(abs(x16_5), abs(x17_3));
    float _e98 = etendue_greater(_e96, abs(x18_4));
    float _e99 = etendue_pow2_scale(_e98);
    float x21_4 = (x13_6 * _e93);
    float x22_4 = (x14_6 * _e93);
    float x23_4 = (x15_5 * _e93);
    float x24_3 = (x16_5 * _e99);
    float x25_4 = (x17_3 * _e99);
    float x26_3 = (x18_4 * _e99);
    float x27_4 = (x22_4 * x26_3);
    float x28_4 = (x23_4 * x25_4);
    float x29_2 = (x27_4 - x28_4);
    float x30_3 = (x29_2 - x27_4);
    float x31_3 = (((x27_4 - (x29_2 - x30_3)) + (-(x28_4) - x30_3)) + ((x22_4 * x26_3 + -(x27_4)) - (x23_4 * x25_4 + -(x28_4))));
    float x32_3 = (x23_4 * x24_3);
    float x33_2 = (x21_4 * x26_3);
    float x34_3 = (x32_3 - x33_2);
    float x35_3 = (x34_3 - x32_3);
    float x36_2 = (((x32_3 - (x34_3 - x35_3)) + (-(x33_2) - x35_3)) + ((x23_4 * x24_3 + -(x32_3)) - (x21_4 * x26_3 + -(x33_2))));
    float x37_3 = (x21_4 * x25_4);
    float x38_3 = (x22_4 * x24_3);
    float x39_3 = (x37_3 - x38_3);
    float x40_3 = (x39_3 - x37_3);
    float x41_3 = (((x37_3 - (x39_3 - x40_3)) + (-(x38_3) - x40_3)) + ((x21_4 * x25_4 + -(x37_3)) - (x22_4 * x24_3 + -(x38_3))));
    float x42_3 = (x29_2 + x31_3);
    float x43_2 = (x34_3 + x36_2);
    float x44_2 = (x39_3 + x41_3);
    float _e156 = etendue_greater(abs(x42_3), abs(x43_2));
    float _e158 = etendue_greater(_e156, abs(x44_2));
    float _e159 = etendue_pow2_scale(_e158);
    float x46_3 = (x42_3 * _e159);
    float x47_2 = (x43_2 * _e159);
    float x48_3 = (x44_2 * _e159);
    float x49_2 = (x46_3 * x46_3 + (x47_2 * x47_2 + (x48_3 * x48_3)));
    float x50_3 = ((0.0 < x49_2) ? (1.0 / sqrt(x49_2)) : 0.0);
    float x51_2 = (x46_3 * x50_3);
    float x52_2 = (x47_2 * x50_3);
    float x53_3 = (x48_3 * x50_3);
    float x54_1 = ((x49_2 * x50_3) / _e159);
    float x55_ = (x10_4 * x29_2);
    float x56_1 = (x11_6 * x34_3);
    float x57_ = (x12_5 * x39_3);
    float x58_ = (x55_ + x56_1);
    float x59_1 = (x58_ - x55_);
    float x60_ = (x57_ + x58_);
    float x61_ = (x60_ - x58_);
    float x62_1 = (((x55_ - (x58_ - x59_1)) + (x56_1 - x59_1)) + ((x58_ - (x60_ - x61_)) + (x57_ - x61_)));
    float x63_ = ((x10_4 * x29_2 + -(x55_)) + ((x11_6 * x34_3 + -(x56_1)) + (x12_5 * x39_3 + -(x57_))));
    bool b64_ = (1e-37 < abs(x54_1));
    float x65_ = ((x60_ + ((x62_1 + x63_) + (x10_4 * x31_3 + (x11_6 * x36_2 + (x12_5 * x41_3))))) / (b64_ ? x54_1 : 1.0));
    float _e217 = etendue_greater((b64_ ? x65_ : 0.0), -1e37);
    float _e219 = etendue_lesser(_e217, 1e37);
    float x67_ = ((x54_1 / _e93) / _e99);
    float x68_ = (x51_2 * x67_);
    float x69_ = (x52_2 * x67_);
    float x70_ = (x53_3 * x67_);
    float x71_ = -((x12_5 * x14_6));
    float x72_ = ((x11_6 * x15_5 + x71_) - (x12_5 * x14_6 + x71_));
    float x73_ = -((x10_4 * x15_5));
    float x74_ = ((x12_5 * x13_6 + x73_) - (x10_4 * x15_5 + x73_));
    float x75_ = -((x11_6 * x13_6));
    float x76_ = ((x10_4 * x14_6 + x75_) - (x11_6 * x13_6 + x75_));
    float x77_ = -((x12_5 * x17_3));
    float x78_ = ((x11_6 * x18_4 + x77_) - (x12_5 * x17_3 + x77_));
    float x79_ = -((x10_4 * x18_4));
    float x80_ = ((x12_5 * x16_5 + x79_) - (x10_4 * x18_4 + x79_));
    float x81_ = -((x11_6 * x16_5));
    float x82_ = ((x10_4 * x17_3 + x81_) - (x11_6 * x16_5 + x81_));
    float x83_ = (1.0 / _e48);
    float x84_ = (light_1.e1_.x + x1_12);
    float x85_ = (light_1.e1_.y + x2_12);
    float x86_ = (light_1.e1_.z + x3_8);
    float x87_ = (light_1.e2_.x + x1_12);
    float x88_ = (light_1.e2_.y + x2_12);
    float x89_ = (light_1.e2_.z + x3_8);
    float _e277 = etendue_greater(abs(x84_), abs(x85_));
    float _e279 = etendue_greater(_e277, abs(x86_));
    float _e280 = etendue_greater(_e20, _e279);
    float _e283 = etendue_greater(abs(x87_), abs(x88_));
    float _e285 = etendue_greater(_e283, abs(x89_));
    float _e286 = etendue_greater(_e280, _e285);
    float _e287 = etendue_greater(_e286, _e31);
    float _e288 = etendue_greater(_e287, _e42);
    float _e290 = etendue_from_bits(2139095040u);
    bool b92_ = (_e288 < _e290);
    float _e292 = etendue_pow2_scale(_e288);
    float x94_ = (_e292 * (b92_ ? x1_12 : 0.0));
    float x95_ = (_e292 * (b92_ ? x2_12 : 0.0));
    float x96_ = (_e292 * (b92_ ? x3_8 : 0.0));
    float x97_ = (_e292 * (b92_ ? x84_ : 0.0));
    float x98_ = (_e292 * (b92_ ? x85_ : 0.0));
    float x99_ = (_e292 * (b92_ ? x86_ : 0.0));
    float x100_ = (_e292 * (b92_ ? x87_ : 0.0));
    float x101_ = (_e292 * (b92_ ? x88_ : 0.0));
    float x102_ = (_e292 * (b92_ ? x89_ : 0.0));
    float x103_ = (_e292 * (b92_ ? light_1.e1_.x : 0.0));
    float x104_ = (_e292 * (b92_ ? light_1.e1_.y : 0.0));
    float x105_ = (_e292 * (b92_ ? light_1.e1_.z : 0.0));
    float x106_ = (_e292 * (b92_ ? light_1.e2_.x : 0.0));
    float x107_ = (_e292 * (b92_ ? light_1.e2_.y : 0.0));
    float x108_ = (_e292 * (b92_ ? light_1.e2_.z : 0.0));
    float x109_ = (x104_ * x108_);
    float x110_ = (x105_ * x107_);
    float x111_ = (x109_ - x110_);
    float x112_ = (x111_ - x109_);
    float x113_ = (((x109_ - (x111_ - x112_)) + (-(x110_) - x112_)) + ((x104_ * x108_ + -(x109_)) - (x105_ * x107_ + -(x110_))));
    float x114_ = (x105_ * x106_);
    float x115_ = (x103_ * x108_);
    float x116_ = (x114_ - x115_);
    float x117_ = (x116_ - x114_);
    float x118_ = (((x114_ - (x116_ - x117_)) + (-(x115_) - x117_)) + ((x105_ * x106_ + -(x114_)) - (x103_ * x108_ + -(x115_))));
    float x119_ = (x103_ * x107_);
    float x120_ = (x104_ * x106_);
    float x121_ = (x119_ - x120_);
    float x122_ = (x121_ - x119_);
    float x123_ = (((x119_ - (x121_ - x122_)) + (-(x120_) - x122_)) + ((x103_ * x107_ + -(x119_)) - (x104_ * x106_ + -(x120_))));
    float x124_ = (x111_ + x113_);
    float x125_ = (x116_ + x118_);
    float x126_ = (x121_ + x123_);
    float x127_ = (x94_ * x111_);
    float x128_ = (x95_ * x116_);
    float x129_ = (x96_ * x121_);
    float x130_ = (x127_ + x128_);
    float x131_ = (x130_ - x127_);
    float x132_ = (x129_ + x130_);
    float x133_ = (x132_ - x130_);
    float x134_ = (((x127_ - (x130_ - x131_)) + (x128_ - x131_)) + ((x130_ - (x132_ - x133_)) + (x129_ - x133_)));
    float x135_ = ((x94_ * x111_ + -(x127_)) + ((x95_ * x116_ + -(x128_)) + (x96_ * x121_ + -(x129_))));
    float x136_ = (x132_ + ((x134_ + x135_) + (x94_ * x113_ + (x95_ * x118_ + (x96_ * x123_)))));
    float x137_ = (x95_ * x108_);
    float x138_ = (x96_ * x107_);
    float x139_ = (x137_ - x138_);
    float x140_ = (x139_ - x137_);
    float x141_ = (x96_ * x107_ + -(x138_));
    float x142_ = (((x137_ - (x139_ - x140_)) + (-(x138_) - x140_)) + ((x95_ * x108_ + -(x137_)) - x141_));
    float x143_ = (x96_ * x106_);
    float x144_ = (x94_ * x108_);
    float x145_ = (x143_ - x144_);
    float x146_ = (x145_ - x143_);
    float x147_ = (x94_ * x108_ + -(x144_));
    float x148_ = (((x143_ - (x145_ - x146_)) + (-(x144_) - x146_)) + ((x96_ * x106_ + -(x143_)) - x147_));
    float x149_ = (x94_ * x107_);
    float x150_ = (x95_ * x106_);
    float x151_ = (x149_ - x150_);
    float x152_ = (x151_ - x149_);
    float x153_ = (x95_ * x106_ + -(x150_));
    float x154_ = (((x149_ - (x151_ - x152_)) + (-(x150_) - x152_)) + ((x94_ * x107_ + -(x149_)) - x153_));
    float x155_ = (x96_ * x104_);
    float x156_ = (x95_ * x105_);
    float x157_ = (x155_ - x156_);
    float x158_ = (x157_ - x155_);
    float x159_ = (x96_ * x104_ + -(x155_));
    float x160_ = (((x155_ - (x157_ - x158_)) + (-(x156_) - x158_)) + (x159_ - (x95_ * x105_ + -(x156_))));
    float x161_ = (x94_ * x105_);
    float x162_ = (x96_ * x103_);
    float x163_ = (x161_ - x162_);
    float x164_ = (x163_ - x161_);
    float x165_ = (x94_ * x105_ + -(x161_));
    float x166_ = (((x161_ - (x163_ - x164_)) + (-(x162_) - x164_)) + (x165_ - (x96_ * x103_ + -(x162_))));
    float x167_ = (x95_ * x103_);
    float x168_ = (x94_ * x104_);
    float x169_ = (x167_ - x168_);
    float x170_ = (x169_ - x167_);
    float x171_ = (x95_ * x103_ + -(x167_));
    float x172_ = (((x167_ - (x169_ - x170_)) + (-(x168_) - x170_)) + (x171_ - (x94_ * x104_ + -(x168_))));
    float x173_ = (x139_ + x157_);
    float x174_ = (x173_ - x139_);
    float x175_ = (x145_ + x163_);
    float x176_ = (x175_ - x145_);
    float x177_ = (x151_ + x169_);
    float x178_ = (x177_ - x151_);
    float x179_ = (x111_ + x173_);
    float x180_ = (x179_ - x111_);
    float x181_ = (x116_ + x175_);
    float x182_ = (x181_ - x116_);
    float x183_ = (x121_ + x177_);
    float x184_ = (x183_ - x121_);
    float x185_ = (x113_ + (((x139_ - (x173_ - x174_)) + (x157_ - x174_)) + (x142_ + x160_)));
    float x186_ = (x118_ + (((x145_ - (x175_ - x176_)) + (x163_ - x176_)) + (x148_ + x166_)));
    float x187_ = (x123_ + (((x151_ - (x177_ - x178_)) + (x169_ - x178_)) + (x154_ + x172_)));
    float x188_ = ((x95_ * x105_ + -(x155_)) - x159_);
    float x189_ = ((x96_ * x103_ + -(x161_)) - x165_);
    float x190_ = ((x94_ * x104_ + -(x167_)) - x171_);
    float x191_ = ((x95_ * x108_ + -(x138_)) - x141_);
    float x192_ = ((x96_ * x106_ + -(x144_)) - x147_);
    float x193_ = ((x94_ * x107_ + -(x150_)) - x153_);
    float x194_ = (x179_ + (((x111_ - (x179_ - x180_)) + (x173_ - x180_)) + x185_));
    float x195_ = (x181_ + (((x116_ - (x181_ - x182_)) + (x175_ - x182_)) + x186_));
    float x196_ = (x183_ + (((x121_ - (x183_ - x184_)) + (x177_ - x184_)) + x187_));
    float x197_ = (x94_ * x94_ + (x95_ * x95_ + (x96_ * x96_)));
    float x198_ = (x97_ * x97_ + (x98_ * x98_ + (x99_ * x99_)));
    float x199_ = (x100_ * x100_ + (x101_ * x101_ + (x102_ * x102_)));
    float x200_ = ((1e-36 < x197_) ? (1.0 / sqrt(x197_)) : 0.0);
    float x201_ = ((1e-36 < x198_) ? (1.0 / sqrt(x198_)) : 0.0);
    float x202_ = ((1e-36 < x199_) ? (1.0 / sqrt(x199_)) : 0.0);
    float x203_ = (x94_ * x97_ + (x95_ * x98_ + (x96_ * x99_)));
    float x204_ = (x201_ * (x200_ * x203_));
    float x205_ = (x94_ * x100_ + (x95_ * x101_ + (x96_ * x102_)));
    float x206_ = (x202_ * (x200_ * x205_));
    float x207_ = (x188_ * x188_ + (x189_ * x189_ + (x190_ * x190_)));
    float x208_ = sqrt(x207_);
    float x209_ = ((1e-37 < x207_) ? (1.0 / x208_) : 0.0);
    float x210_ = (x197_ * x200_);
    float x211_ = (x198_ * x201_);
    float x212_ = (x201_ * (x200_ * (x207_ * x209_)));
    float x213_ = (x211_ * (x209_ * x210_));
    float x214_ = (x213_ * 2.0);
    float x215_ = ((x212_ * x212_) / (1.0 + abs(x204_)));
    bool b216_ = (x204_ < 0.0);
    float x217_ = (b216_ ? x215_ : (1.0 + x204_));
    float x218_ = (x213_ * (b216_ ? (1.0 - x204_) : x215_));
    float x219_ = abs(x136_);
    float x220_ = (x202_ * (x201_ * (x200_ * x219_)));
    float x221_ = (x97_ * x201_);
    float x222_ = (x98_ * x201_);
    float x223_ = (x99_ * x201_);
    float x224_ = (x94_ * x200_);
    float x225_ = (x95_ * x200_);
    float x226_ = (x96_ * x200_);
    float x227_ = (x221_ + x224_);
    float x228_ = (x222_ + x225_);
    float x229_ = (x223_ + x226_);
    bool b230_ = (x136_ < 0.0);
    float x231_ = (x188_ * x209_);
    float x232_ = (x189_ * x209_);
    float x233_ = (x190_ * x209_);
    float x234_ = -((x223_ * x232_));
    float x235_ = ((x222_ * x233_ + x234_) - (x223_ * x232_ + x234_));
    float x236_ = -((x221_ * x233_));
    float x237_ = ((x223_ * x231_ + x236_) - (x221_ * x233_ + x236_));
    float x238_ = -((x222_ * x231_));
    float x239_ = ((x221_ * x232_ + x238_) - (x222_ * x231_ + x238_));
    float x240_ = (x202_ * (x100_ * x221_ + (x101_ * x222_ + (x102_ * x223_))));
    float x241_ = (x202_ * ((x106_ - x103_) * x235_ + ((x107_ - x104_) * x237_ + ((x108_ - x105_) * x239_))));
    float x242_ = (x202_ * (x209_ * x219_));
    float x243_ = (x191_ * x191_ + (x192_ * x192_ + (x193_ * x193_)));
    float x244_ = (x200_ * x202_);
    float x245_ = (x244_ * (x243_ * x244_));
    float _e712 = etendue_lesser(x204_, x206_);
    float _e713 = etendue_lesser(_e712, x240_);
    bool b246_ = (_e713 < -0.5);
    float x247_ = (x97_ * x100_ + (x98_ * x101_ + (x99_ * x102_)));
    float x248_ = (x194_ * x194_ + (x195_ * x195_ + (x196_ * x196_)));
    float x249_ = (b230_ ? -(x231_) : x231_);
    float x250_ = (b230_ ? -(x232_) : x232_);
    float x251_ = (b230_ ? -(x233_) : x233_);
    float x252_ = (x210_ * x219_);
    bool b253_ = (1e-37 < x252_);
    float x254_ = (b253_ ? ((x188_ * x191_ + (x189_ * x192_ + (x190_ * x193_))) / (b253_ ? x252_ : 1.0)) : 0.0);
    bool b255_ = ((((0.0 < x200_) && (0.0 < x201_)) && (0.0 < x202_)) && (0.0 < x220_));
    float x256_ = (1.0 / ((1e-37 < x220_) ? x220_ : 1.0));
    float _e763 = etendue_greater((-(x204_) / ((0.0 < x212_) ? x212_ : 1.0)), 1.0);
    float _e765 = etendue_lesser(_e763, 1e18);
    float x258_ = (b230_ ? -(x188_) : x188_);
    float x259_ = (b230_ ? -(x189_) : x189_);
    float x260_ = (b230_ ? -(x190_) : x190_);
    float x261_ = (b230_ ? -(x194_) : x194_);
    float x262_ = (b230_ ? -(x195_) : x195_);
    float x263_ = (b230_ ? -(x196_) : x196_);
    float x264_ = (b230_ ? x191_ : -(x191_));
    float x265_ = (b230_ ? x192_ : -(x192_));
    float x266_ = (b230_ ? x193_ : -(x193_));
    float _e786 = etendue_greater((x208_ * _e765), -(x203_));
    float x267_ = (_e786 * 7.1525574e-7);
    float _e792 = etendue_greater(x245_, 1e-7);
    float _e796 = etendue_greater(_e765, (-(x206_) * (1.0 / sqrt(_e792))));
    float x268_ = (_e796 * sqrt(x248_));
    float _e801 = etendue_greater(x268_, -(x247_));
    float x269_ = (7.1525574e-7 * _e801);
    float _e807 = etendue_greater((_e765 * sqrt(x243_)), -(x205_));
    float x270_ = (7.1525574e-7 * _e807);
    float _e809 = etendue_greater(x210_, x211_);
    float _e811 = etendue_greater(_e809, (x199_ * x202_));
    float x272_ = (x217_ * x256_);
    float _e813 = etendue_pow2_scale(_e292);
    x274_ = (x202_ * (x100_ * x227_ + (x101_ * x228_ + (x102_ * x229_))) + x217_);
    x275_ = x241_;
    if (b246_) {
        float x279_ = (x97_ - x94_);
        float x280_ = (x98_ - x95_);
        float x281_ = (x99_ - x96_);
        float x282_ = (x279_ * x279_ + (x280_ * x280_ + (x281_ * x281_)));
        bool b283_ = (1e-36 < x282_);
        float x284_ = (1.0 / sqrt((b283_ ? x282_ : 1.0)));
        float x285_ = (x284_ * x284_);
        float x286_ = -((x189_ * x281_));
        float x287_ = -((x190_ * x279_));
        float x288_ = -((x188_ * x280_));
        float x289_ = (x207_ * x285_);
        float x290_ = (x279_ * x284_);
        float x291_ = (x280_ * x284_);
        float x292_ = (x281_ * x284_);
        float x293_ = (x200_ + x201_);
        float x294_ = ((x200_ * (x200_ * x289_)) / (1.0 + (x200_ * abs((x94_ * x290_ + (x95_ * x291_ + (x96_ * x292_)))))));
        float x295_ = ((x201_ * (x201_ * x289_)) / (1.0 + (x201_ * abs((x97_ * x290_ + (x98_ * x291_ + (x99_ * x292_)))))));
        float x296_ = (x294_ - x295_);
        bool b297_ = ((x203_ < 0.0) && b283_);
        float x298_ = (b297_ ? ((x285_ * ((x190_ * x280_ + x286_) - (x189_ * x281_ + x286_))) * x293_ + (x290_ * x296_)) : x227_);
        float x299_ = (b297_ ? ((x285_ * ((x188_ * x281_ + x287_) - (x190_ * x279_ + x287_))) * x293_ + (x291_ * x296_)) : x228_);
        float x300_ = (b297_ ? ((x285_ * ((x189_ * x279_ + x288_) - (x188_ * x280_ + x288_))) * x293_ + (x292_ * x296_)) : x229_);
        float x301_ = (x100_ * x202_);
        float x302_ = (x101_ * x202_);
        float x303_ = (x102_ * x202_);
        float x304_ = (x100_ - x94_);
        float x305_ = (x101_ - x95_);
        float x306_ = (x102_ - x96_);
        float x307_ = (x304_ * x304_ + (x305_ * x305_ + (x306_ * x306_)));
        bool b308_ = (1e-36 < x307_);
        float x309_ = (1.0 / sqrt((b308_ ? x307_ : 1.0)));
        float x310_ = (x309_ * x309_);
        float x311_ = -((x192_ * x306_));
        float x312_ = -((x193_ * x304_));
        float x313_ = -((x191_ * x305_));
        float x314_ = (x243_ * x310_);
        float x315_ = (x304_ * x309_);
        float x316_ = (x305_ * x309_);
        float x317_ = (x306_ * x309_);
        float x318_ = (x200_ + x202_);
        float x319_ = ((x200_ * (x200_ * x314_)) / (1.0 + (x200_ * abs((x94_ * x315_ + (x95_ * x316_ + (x96_ * x317_)))))));
        float x320_ = ((x202_ * (x202_ * x314_)) / (1.0 + (x202_ * abs((x100_ * x315_ + (x101_ * x316_ + (x102_ * x317_)))))));
        float x321_ = (x319_ - x320_);
        bool b322_ = ((x205_ < 0.0) && b308_);
        float x323_ = (b322_ ? ((x310_ * ((x193_ * x305_ + x311_) - (x192_ * x306_ + x311_))) * x318_ + (x315_ * x321_)) : (x224_ + x301_));
        float x324_ = (b322_ ? ((x310_ * ((x191_ * x306_ + x312_) - (x193_ * x304_ + x312_))) * x318_ + (x316_ * x321_)) : (x225_ + x302_));
        float x325_ = (b322_ ? ((x310_ * ((x192_ * x304_ + x313_) - (x191_ * x305_ + x313_))) * x318_ + (x317_ * x321_)) : (x226_ + x303_));
        float x326_ = (x100_ - x97_);
        float x327_ = (x101_ - x98_);
        float x328_ = (x102_ - x99_);
        float x329_ = (x326_ * x326_ + (x327_ * x327_ + (x328_ * x328_)));
        bool b330_ = (1e-36 < x329_);
        float x331_ = (1.0 / sqrt((b330_ ? x329_ : 1.0)));
        float x332_ = (x331_ * x331_);
        float x333_ = -((x195_ * x328_));
        float x334_ = -((x196_ * x326_));
        float x335_ = -((x194_ * x327_));
        float x336_ = (x332_ * x248_);
        float x337_ = (x326_ * x331_);
        float x338_ = (x327_ * x331_);
        float x339_ = (x328_ * x331_);
        float x340_ = (x201_ + x202_);
        float x341_ = ((x201_ * (x201_ * x336_)) / (1.0 + (x201_ * abs((x97_ * x337_ + (x98_ * x338_ + (x99_ * x339_)))))));
        float x342_ = ((x202_ * (x202_ * x336_)) / (1.0 + (x202_ * abs((x100_ * x337_ + (x101_ * x338_ + (x102_ * x339_)))))));
        float x343_ = (x341_ - x342_);
        bool b344_ = ((x247_ < 0.0) && b330_);
        float x345_ = (b344_ ? ((x332_ * ((x196_ * x327_ + x333_) - (x195_ * x328_ + x333_))) * x340_ + (x337_ * x343_)) : (x221_ + x301_));
        float x346_ = (b344_ ? ((x332_ * ((x194_ * x328_ + x334_) - (x196_ * x326_ + x334_))) * x340_ + (x338_ * x343_)) : (x222_ + x302_));
        float x347_ = (b344_ ? ((x332_ * ((x195_ * x326_ + x335_) - (x194_ * x327_ + x335_))) * x340_ + (x339_ * x343_)) : (x223_ + x303_));
        float x348_ = ((x240_ < x206_) ? (x298_ * x345_ + (x299_ * x346_ + (x300_ * x347_))) : (x298_ * x323_ + (x299_ * x324_ + (x300_ * x325_))));
        float _e1053 = etendue_greater(x206_, x240_);
        x274_ = ((_e1053 < x204_) ? (x323_ * x345_ + (x324_ * x346_ + (x325_ * x347_))) : x348_);
        x275_ = -((x202_ * (x201_ * (x209_ * (x188_ * x194_ + (x189_ * x195_ + (x190_ * x196_)))))));
        b276_ = (x240_ < 0.0);
        b277_ = (x206_ < 0.0);
        x278_ = (x245_ / (1.0 + abs(x206_)));
    }
    float _e1073 = x278_;
    bool _e1074 = b277_;
    float x349_ = ((b246_ && _e1074) ? _e1073 : (1.0 + x206_));
    float _e1079 = x274_;
    float _e1080 = etendue_angle(x220_, _e1079);
    float x350_ = (b255_ ? (2.0 * _e1080) : 0.0);
    float _e1083 = x274_;
    float _e1084 = x274_;
    float _e1088 = etendue_greater((x220_ * x220_ + (_e1083 * _e1084)), 1e-36);
    float x352_ = (1.0 / sqrt(_e1088));
    float x353_ = (x220_ * x352_);
    float _e1093 = x274_;
    float x354_ = (_e1093 * x352_);
    float x355_ = (x352_ * (x256_ * _e1088));
    float x356_ = (x355_ * (x212_ * 0.5));
    bool b357_ = (x356_ < 1e30);
    float _e1102 = x274_;
    float x358_ = (_e1102 * x256_);
    float _e1104 = x274_;
    float x359_ = (_e1104 - x217_);
    if (b246_) {
        float _e1107 = x275_;
        float _e1108 = x275_;
        x360_ = ((_e1107 * _e1108 + (x242_ * x242_)) / (1.0 + abs(x240_)));
    }
    float _e1118 = x360_;
    bool _e1119 = b276_;
    float _e1123 = etendue_greater(((b246_ && _e1119) ? _e1118 : (1.0 + x240_)), 1e-30);
    float x361_ = (1.0 / _e1123);
    float _e1129 = etendue_lesser((x356_ * (x242_ * x361_)), 1e18);
    float x362_ = (b357_ ? _e1129 : 0.0);
    float _e1132 = x275_;
    float _e1137 = etendue_greater((x356_ * (_e1132 * -(x361_) + x218_)), -1e18);
    float _e1139 = etendue_lesser(_e1137, 1e18);
    float x363_ = (b357_ ? _e1139 : 0.0);
    result_9.surface_plane_cross.x = x68_;
    result_9.surface_plane_cross.y = x69_;
    result_9.surface_plane_cross.z = x70_;
    result_9.surface_plane_normal.x = x51_2;
    result_9.surface_plane_normal.y = x52_2;
    result_9.surface_plane_normal.z = x53_3;
    result_9.surface_plane_height = _e219;
    result_9.surface_plane_along_first.x = x72_;
    result_9.surface_plane_along_first.y = x74_;
    result_9.surface_plane_along_first.z = x76_;
    result_9.surface_plane_along_second.x = x78_;
    result_9.surface_plane_along_second.y = x80_;
    result_9.surface_plane_along_second.z = x82_;
    result_9.surface_plane_unit = x83_;
    result_9.shape_side01_.x = x258_;
    result_9.shape_side01_.y = x259_;
    result_9.shape_side01_.z = x260_;
    result_9.shape_side12_.x = x261_;
    result_9.shape_side12_.y = x262_;
    result_9.shape_side12_.z = x263_;
    result_9.shape_side20_.x = x264_;
    result_9.shape_side20_.y = x265_;
    result_9.shape_side20_.z = x266_;
    result_9.shape_slack.x = x267_;
    result_9.shape_slack.y = x269_;
    result_9.shape_slack.z = x270_;
    result_9.shape_normal.x = x124_;
    result_9.shape_normal.y = x125_;
    result_9.shape_normal.z = x126_;
    result_9.shape_l1_ = x211_;
    result_9.shape_farthest = _e811;
    result_9.shape_apex.x = x221_;
    result_9.shape_apex.y = x222_;
    result_9.shape_apex.z = x223_;
    result_9.shape_along.x = x235_;
    result_9.shape_along.y = x237_;
    result_9.shape_along.z = x239_;
    result_9.shape_across.x = x249_;
    result_9.shape_across.y = x250_;
    result_9.shape_across.z = x251_;
    result_9.shape_cot_alpha = x254_;
    result_9.shape_stretch = x214_;
    result_9.shape_tan_half = x218_;
    result_9.shape_half.x = x353_;
    result_9.shape_half.y = x354_;
    result_9.shape_turned.x = x362_;
    result_9.shape_turned.y = x363_;
    result_9.shape_sin_side = x212_;
    result_9.shape_inv_l0_ = x200_;
    result_9.shape_inv_l2_ = x202_;
    result_9.shape_cot_half = x358_;
    result_9.shape_inv_half_sin = x355_;
    result_9.shape_g2_ = x217_;
    result_9.shape_g2_over_g0_ = x272_;
    result_9.shape_one_plus_d02_ = x349_;
    result_9.shape_sin02_squared = x245_;
    float _e1239 = x275_;
    result_9.shape_x2_ = _e1239;
    result_9.shape_y2_ = x242_;
    result_9.shape_g1_ = x359_;
    result_9.shape_volume = x136_;
    result_9.shape_solid_angle = x350_;
    result_9.shape_unit = _e813;
    EtendueTriangleBySolidAngle _e1245 = result_9;
    return _e1245;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
EtendueLightSample etendue_triangle_by_solid_angle_sample(EtendueTriangleBySolidAngle prepared_5, vec2 u_4) {
    bool b26_ = false;
    float x27_ = 0.0;
    float x28_ = 0.0;
    EtendueLightSample result_10 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    bool b1_ = (0.5 < u_4.x);
    vec2 _e14 = etendue_sin_cos_turns(((prepared_5.shape_solid_angle * (b1_ ? (1.0 - u_4.x) : u_4.x)) * 0.07957747));
    float x3_9 = (b1_ ? ((prepared_5.shape_half.x * _e14.y) - (prepared_5.shape_half.y * _e14.x)) : _e14.x);
    float x4_5 = (b1_ ? prepared_5.shape_turned.x : 1.0);
    float x5_6 = (b1_ ? prepared_5.shape_turned.y : -(prepared_5.shape_cot_alpha));
    float x6_9 = (_e14.y * x5_6 + -((_e14.x * x4_5)));
    float x7_9 = (prepared_5.shape_stretch * x3_9);
    float _e48 = etendue_greater(((b1_ ? x6_9 : -(x6_9)) * -(x7_9) + prepared_5.shape_tan_half), -1000000000000000.0);
    float _e50 = etendue_lesser(_e48, 1000000000000000.0);
    float _e57 = etendue_greater(((_e14.y * x4_5 + (_e14.x * x5_6)) * x7_9), 0.0);
    float _e59 = etendue_lesser(_e57, 1000000000000000.0);
    float x10_5 = (b1_ ? (prepared_5.shape_inv_half_sin * _e14.x) : (prepared_5.shape_cot_half * -(_e14.x) + _e14.y));
    bool b11_1 = (prepared_5.shape_g2_ < 0.5);
    float x12_6 = (prepared_5.shape_g2_over_g0_ * x3_9);
    float _e78 = etendue_greater((x10_5 * (x12_6 + (x10_5 + x12_6))), 0.0);
    float x14_7 = (2.0 * x12_6);
    float _e85 = etendue_greater((x14_7 * (prepared_5.shape_one_plus_d02_ * x12_6 + x10_5)), 0.0);
    float x16_6 = ((prepared_5.shape_one_plus_d02_ * (x12_6 * x14_7)) - (x10_5 * x10_5));
    float _e99 = etendue_greater((x16_6 * x16_6 + (_e85 * (_e78 * (prepared_5.shape_one_plus_d02_ * 2.0)))), 1e-30);
    float x17_4 = (1.0 / sqrt(_e99));
    float x18_5 = (_e78 * x17_4);
    float x19_3 = (_e85 * x17_4);
    float x20_4 = (1.0 - u_4.y);
    bool b21_ = (1e-37 < abs(prepared_5.shape_solid_angle));
    float _e119 = etendue_greater((b21_ ? (1.0 / (b21_ ? prepared_5.shape_solid_angle : 1.0)) : 0.0), -1e37);
    float _e121 = etendue_lesser(_e119, 1e37);
    bool b23_ = (prepared_5.shape_volume < 0.0);
    bool b24_1 = (b23_ && (1e-37 < _e121));
    float x25_5 = (b24_1 ? (1.0 / (b24_1 ? _e121 : 1.0)) : 0.0);
    if (b11_1) {
        float x29_3 = (x19_3 * (prepared_5.shape_one_plus_d02_ - 1.0) + x18_5);
        float _e148 = etendue_greater(x29_3, 0.0);
        float x30_4 = ((0.0 < x29_3) ? ((prepared_5.shape_sin02_squared * (x19_3 * x19_3)) / (1.0 + _e148)) : (1.0 - x29_3));
        float x31_4 = (prepared_5.shape_g2_ * x18_5 + (x30_4 + (prepared_5.shape_g1_ * x19_3)));
        float _e161 = etendue_greater(x31_4, 1e-30);
        float x32_4 = (1.0 / _e161);
        float x33_3 = (x32_4 * (prepared_5.shape_sin_side * x18_5));
        float x34_4 = (x32_4 * (prepared_5.shape_x2_ * x19_3));
        bool b35_ = ((((prepared_5.shape_g2_ * x18_5 + (x30_4 + (x19_3 * abs(prepared_5.shape_g1_)))) * 0.125) < x31_4) && (0.5 < (x18_5 + x19_3)));
        float _e186 = etendue_greater(prepared_5.shape_tan_half, abs(_e50));
        b26_ = (b35_ && ((x33_3 + abs(x34_4)) < _e186));
        float _e191 = etendue_greater((x33_3 + x34_4), -1000000000000000.0);
        float _e193 = etendue_lesser(_e191, 1000000000000000.0);
        x27_ = _e193;
        float _e198 = etendue_lesser((x32_4 * (prepared_5.shape_y2_ * x19_3)), 1000000000000000.0);
        x28_ = _e198;
    }
    float _e199 = x27_;
    bool _e200 = b26_;
    float x36_3 = (_e200 ? _e199 : _e50);
    float _e202 = x28_;
    bool _e203 = b26_;
    float x37_4 = (_e203 ? _e202 : _e59);
    float x38_4 = (x36_3 * x36_3 + (x37_4 * x37_4));
    float x39_4 = (1.0 + x38_4);
    float x40_4 = (2.0 / x39_4);
    float x41_4 = (u_4.y * x40_4);
    float x42_4 = (x38_4 * -(x41_4) + 1.0);
    float _e221 = etendue_greater((x41_4 * (x40_4 * (x38_4 * x20_4 + 1.0))), 0.0);
    float x43_3 = sqrt(_e221);
    float x44_3 = (prepared_5.shape_apex.x * x42_4 + (x43_3 * (prepared_5.shape_along.x * x36_3 + (prepared_5.shape_across.x * x37_4))));
    float x45_3 = (prepared_5.shape_apex.y * x42_4 + (x43_3 * (prepared_5.shape_along.y * x36_3 + (prepared_5.shape_across.y * x37_4))));
    float x46_4 = (prepared_5.shape_apex.z * x42_4 + (x43_3 * (prepared_5.shape_along.z * x36_3 + (prepared_5.shape_across.z * x37_4))));
    float x47_3 = ((x44_3 * x44_3 + (x45_3 * x45_3 + (x46_4 * x46_4))) * -0.5 + 1.5);
    float x48_4 = (x44_3 * x47_3);
    float x49_3 = (x45_3 * x47_3);
    float x50_4 = (x46_4 * x47_3);
    float x51_3 = (x39_4 * (0.5 * x43_3));
    bool b52_1 = (1.0 < x38_4);
    float x53_4 = (abs((1.0 - x38_4)) / x39_4);
    float x54_2 = ((1.0 + x53_4) * (x51_3 * x53_4 + x42_4));
    float x55_1 = (x51_3 * (prepared_5.shape_l1_ * (prepared_5.shape_inv_l0_ * x18_5 + (prepared_5.shape_inv_l2_ * x19_3))) + ((x20_4 * (x42_4 + x53_4)) / ((0.0 < x54_2) ? x54_2 : 1.0)));
    float x56_2 = (b52_1 ? abs((prepared_5.shape_normal.x * x48_4 + (prepared_5.shape_normal.y * x49_3 + (prepared_5.shape_normal.z * x50_4)))) : x55_1);
    bool b57_ = ((0.0 < x56_2) && (0.0 < prepared_5.shape_solid_angle));
    float _e315 = etendue_lesser(((b52_1 ? abs(prepared_5.shape_volume) : prepared_5.shape_l1_) / (b57_ ? x56_2 : 1.0)), prepared_5.shape_farthest);
    float _e318 = etendue_lesser((prepared_5.shape_unit * _e315), 3.4028235e38);
    float x59_2 = (b57_ ? _e318 : 0.0);
    float x60_1 = (prepared_5.surface_plane_cross.x * x48_4 + (prepared_5.surface_plane_cross.y * x49_3 + (prepared_5.surface_plane_cross.z * x50_4)));
    bool b61_1 = (1e-37 < abs(x60_1));
    float x62_2 = (b61_1 ? x60_1 : 1.0);
    float _e349 = etendue_greater((b61_1 ? (-((prepared_5.surface_plane_along_second.x * x48_4 + (prepared_5.surface_plane_along_second.y * x49_3 + (prepared_5.surface_plane_along_second.z * x50_4)))) / x62_2) : 0.0), -1e37);
    float _e363 = etendue_greater((b61_1 ? ((prepared_5.surface_plane_along_first.x * x48_4 + (prepared_5.surface_plane_along_first.y * x49_3 + (prepared_5.surface_plane_along_first.z * x50_4))) / x62_2) : 0.0), -1e37);
    float _e365 = etendue_lesser(_e363, 1e37);
    float _e367 = etendue_lesser(_e349, 1e37);
    float _e369 = etendue_greater(_e367, 0.0);
    float _e371 = etendue_lesser(_e369, 1.0);
    float _e373 = etendue_greater(_e365, 0.0);
    float _e375 = etendue_lesser(_e373, 1.0);
    result_10.direction.x = x48_4;
    result_10.direction.y = x49_3;
    result_10.direction.z = x50_4;
    result_10.distance_ = x59_2;
    result_10.pdf = _e121;
    result_10.weight = x25_5;
    result_10.normal.x = prepared_5.surface_plane_normal.x;
    result_10.normal.y = prepared_5.surface_plane_normal.y;
    result_10.normal.z = prepared_5.surface_plane_normal.z;
    result_10.uv.x = _e371;
    result_10.uv.y = _e375;
    result_10.emits = b23_;
    result_10.delta = false;
    EtendueLightSample _e405 = result_10;
    return _e405;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the solid angle
// Omega at the point p: pdf 1/Omega per steradian.
float etendue_triangle_by_solid_angle_pdf(EtendueTriangleBySolidAngle prepared_6, vec3 w_2) {
    bool b1_1 = (1e-37 < abs(prepared_6.shape_solid_angle));
    bool b2_ = ((-(prepared_6.shape_slack.y) <= (prepared_6.shape_side12_.x * w_2.x + (prepared_6.shape_side12_.y * w_2.y + (prepared_6.shape_side12_.z * w_2.z)))) && (-(prepared_6.shape_slack.z) <= (prepared_6.shape_side20_.x * w_2.x + (prepared_6.shape_side20_.y * w_2.y + (prepared_6.shape_side20_.z * w_2.z)))));
    float x3_10 = (prepared_6.shape_normal.x * w_2.x + (prepared_6.shape_normal.y * w_2.y + (prepared_6.shape_normal.z * w_2.z)));
    bool b4_2 = (-((sqrt((prepared_6.shape_normal.x * prepared_6.shape_normal.x + (prepared_6.shape_normal.y * prepared_6.shape_normal.y + (prepared_6.shape_normal.z * prepared_6.shape_normal.z)))) * 7.1525574e-7)) <= ((prepared_6.shape_volume < 0.0) ? -(x3_10) : x3_10));
    bool b5_3 = ((b2_ && (-(prepared_6.shape_slack.x) <= (prepared_6.shape_side01_.x * w_2.x + (prepared_6.shape_side01_.y * w_2.y + (prepared_6.shape_side01_.z * w_2.z))))) && b4_2);
    float _e103 = etendue_greater((b1_1 ? (1.0 / (b1_1 ? prepared_6.shape_solid_angle : 1.0)) : 0.0), -1e37);
    float _e105 = etendue_lesser(_e103, 1e37);
    float x6_10 = (b5_3 ? _e105 : 0.0);
    return x6_10;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian.
EtendueLightSample etendue_triangle_by_solid_angle_hit(EtendueTriangleBySolidAngle prepared_7, vec3 w_3) {
    EtendueLightSample result_11 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    bool b1_2 = (1e-37 < abs(prepared_7.shape_solid_angle));
    bool b2_1 = ((-(prepared_7.shape_slack.y) <= (prepared_7.shape_side12_.x * w_3.x + (prepared_7.shape_side12_.y * w_3.y + (prepared_7.shape_side12_.z * w_3.z)))) && (-(prepared_7.shape_slack.z) <= (prepared_7.shape_side20_.x * w_3.x + (prepared_7.shape_side20_.y * w_3.y + (prepared_7.shape_side20_.z * w_3.z)))));
    float x3_11 = (prepared_7.shape_normal.x * w_3.x + (prepared_7.shape_normal.y * w_3.y + (prepared_7.shape_normal.z * w_3.z)));
    bool b4_3 = (prepared_7.shape_volume < 0.0);
    bool b5_4 = (-((sqrt((prepared_7.shape_normal.x * prepared_7.shape_normal.x + (prepared_7.shape_normal.y * prepared_7.shape_normal.y + (prepared_7.shape_normal.z * prepared_7.shape_normal.z)))) * 7.1525574e-7)) <= (b4_3 ? -(x3_11) : x3_11));
    bool b6_ = ((b2_1 && (-(prepared_7.shape_slack.x) <= (prepared_7.shape_side01_.x * w_3.x + (prepared_7.shape_side01_.y * w_3.y + (prepared_7.shape_side01_.z * w_3.z))))) && b5_4);
    float _e103 = etendue_greater((b1_2 ? (1.0 / (b1_2 ? prepared_7.shape_solid_angle : 1.0)) : 0.0), -1e37);
    float _e105 = etendue_lesser(_e103, 1e37);
    float x7_10 = (b6_ ? _e105 : 0.0);
    bool b8_1 = (0.0 < x7_10);
    float x9_4 = (prepared_7.surface_plane_cross.x * w_3.x + (prepared_7.surface_plane_cross.y * w_3.y + (prepared_7.surface_plane_cross.z * w_3.z)));
    bool b10_2 = (1e-37 < abs(x9_4));
    float x11_7 = (b10_2 ? x9_4 : 1.0);
    float _e143 = etendue_greater((b10_2 ? (-((prepared_7.surface_plane_along_second.x * w_3.x + (prepared_7.surface_plane_along_second.y * w_3.y + (prepared_7.surface_plane_along_second.z * w_3.z)))) / x11_7) : 0.0), -1e37);
    float _e160 = etendue_greater((b10_2 ? ((prepared_7.surface_plane_along_first.x * w_3.x + (prepared_7.surface_plane_along_first.y * w_3.y + (prepared_7.surface_plane_along_first.z * w_3.z))) / x11_7) : 0.0), -1e37);
    float _e162 = etendue_lesser(_e160, 1e37);
    float _e164 = etendue_lesser(_e143, 1e37);
    float _e166 = etendue_greater(_e164, 0.0);
    float _e168 = etendue_lesser(_e166, 1.0);
    float _e170 = etendue_greater(_e162, 0.0);
    float _e172 = etendue_lesser(_e170, 1.0);
    float x16_7 = (prepared_7.surface_plane_normal.x * w_3.x + (prepared_7.surface_plane_normal.y * w_3.y + (prepared_7.surface_plane_normal.z * w_3.z)));
    bool b17_1 = (1e-37 < abs(x16_7));
    float _e196 = etendue_greater((b17_1 ? (prepared_7.surface_plane_height / (b17_1 ? x16_7 : 1.0)) : 0.0), -1e37);
    float _e198 = etendue_lesser(_e196, 1e37);
    float _e200 = etendue_greater(_e198, 0.0);
    float x18_6 = (prepared_7.surface_plane_unit * _e200);
    float _e204 = etendue_lesser(x18_6, 3.4028235e38);
    float x19_4 = (b8_1 ? _e204 : 0.0);
    bool b20_ = (b4_3 && b8_1);
    bool b21_1 = (b20_ && (1e-37 < x7_10));
    float x22_5 = (b21_1 ? (1.0 / (b21_1 ? x7_10 : 1.0)) : 0.0);
    result_11.direction.x = w_3.x;
    result_11.direction.y = w_3.y;
    result_11.direction.z = w_3.z;
    result_11.distance_ = x19_4;
    result_11.pdf = x7_10;
    result_11.weight = x22_5;
    result_11.normal.x = prepared_7.surface_plane_normal.x;
    result_11.normal.y = prepared_7.surface_plane_normal.y;
    result_11.normal.z = prepared_7.surface_plane_normal.z;
    result_11.uv.x = _e168;
    result_11.uv.y = _e172;
    result_11.emits = b20_;
    result_11.delta = false;
    EtendueLightSample _e248 = result_11;
    return _e248;
}

// Prepares a light for the shading point p. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
EtendueRectangleBySolidAngle etendue_rectangle_by_solid_angle_prepare(EtendueRectangle light_2, vec3 p_2) {
    EtendueRectangleBySolidAngle result_12 = EtendueRectangleBySolidAngle(vec3(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec2(0.0), vec2(0.0), vec3(0.0), vec2(0.0), vec2(0.0), vec2(0.0), 0.0, vec2(0.0), vec2(0.0), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    float x1_13 = (light_2.corner.x - p_2.x);
    float x2_13 = (light_2.corner.y - p_2.y);
    float x3_12 = (light_2.corner.z - p_2.z);
    float _e16 = etendue_greater(abs(x1_13), abs(x2_13));
    float _e18 = etendue_greater(_e16, abs(x3_12));
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
    float x10_6 = (_e49 * (b8_2 ? x1_13 : 0.0));
    float x11_8 = (_e49 * (b8_2 ? x2_13 : 0.0));
    float x12_7 = (_e49 * (b8_2 ? x3_12 : 0.0));
    float x13_7 = (_e49 * (b8_2 ? light_2.edge_s.x : 0.0));
    float x14_8 = (_e49 * (b8_2 ? light_2.edge_s.y : 0.0));
    float x15_6 = (_e49 * (b8_2 ? light_2.edge_s.z : 0.0));
    float x16_8 = (_e49 * (b8_2 ? light_2.edge_t.x : 0.0));
    float x17_5 = (_e49 * (b8_2 ? light_2.edge_t.y : 0.0));
    float x18_7 = (_e49 * (b8_2 ? light_2.edge_t.z : 0.0));
    float _e91 = etendue_greater(abs(x13_7), abs(x14_8));
    float _e93 = etendue_greater(_e91, abs(x15_6));
    float _e94 = etendue_pow2_scale(_e93);
    float x20_5 = (x13_7 * _e94);
    float x21_5 = (x14_8 * _e94);
    float x22_6 = (x15_6 * _e94);
    float x23_5 = (x20_5 * x20_5 + (x21_5 * x21_5 + (x22_6 * x22_6)));
    float x24_4 = ((0.0 < x23_5) ? (1.0 / sqrt(x23_5)) : 0.0);
    float x25_6 = (x20_5 * x24_4);
    float x26_4 = (x21_5 * x24_4);
    float x27_5 = (x22_6 * x24_4);
    float x28_5 = ((x23_5 * x24_4) / _e94);
    float _e115 = etendue_greater(abs(x16_8), abs(x17_5));
    float _e117 = etendue_greater(_e115, abs(x18_7));
    float _e118 = etendue_pow2_scale(_e117);
    float x30_5 = (x16_8 * _e118);
    float x31_5 = (x17_5 * _e118);
    float x32_5 = (x18_7 * _e118);
    float x33_4 = (x30_5 * x30_5 + (x31_5 * x31_5 + (x32_5 * x32_5)));
    float x34_5 = ((0.0 < x33_4) ? (1.0 / sqrt(x33_4)) : 0.0);
    float x35_4 = (x30_5 * x34_5);
    float x36_4 = (x31_5 * x34_5);
    float x37_5 = (x32_5 * x34_5);
    float x38_5 = ((x33_4 * x34_5) / _e118);
    float x39_5 = (x21_5 * x32_5);
    float x40_5 = (x22_6 * x31_5);
    float x41_5 = (x39_5 - x40_5);
    float x42_5 = (x41_5 - x39_5);
    float x43_4 = (((x39_5 - (x41_5 - x42_5)) + (-(x40_5) - x42_5)) + ((x21_5 * x32_5 + -(x39_5)) - (x22_6 * x31_5 + -(x40_5))));
    float x44_4 = (x22_6 * x30_5);
    float x45_4 = (x20_5 * x32_5);
    float x46_5 = (x44_4 - x45_4);
    float x47_4 = (x46_5 - x44_4);
    float x48_5 = (((x44_4 - (x46_5 - x47_4)) + (-(x45_4) - x47_4)) + ((x22_6 * x30_5 + -(x44_4)) - (x20_5 * x32_5 + -(x45_4))));
    float x49_4 = (x20_5 * x31_5);
    float x50_5 = (x21_5 * x30_5);
    float x51_4 = (x49_4 - x50_5);
    float x52_3 = (x51_4 - x49_4);
    float x53_5 = (((x49_4 - (x51_4 - x52_3)) + (-(x50_5) - x52_3)) + ((x20_5 * x31_5 + -(x49_4)) - (x21_5 * x30_5 + -(x50_5))));
    float x54_3 = (x41_5 + x43_4);
    float x55_2 = (x46_5 + x48_5);
    float x56_3 = (x51_4 + x53_5);
    float _e187 = etendue_greater(abs(x54_3), abs(x55_2));
    float _e189 = etendue_greater(_e187, abs(x56_3));
    float _e190 = etendue_pow2_scale(_e189);
    float x58_1 = (x54_3 * _e190);
    float x59_3 = (x55_2 * _e190);
    float x60_2 = (x56_3 * _e190);
    float x61_1 = (x58_1 * x58_1 + (x59_3 * x59_3 + (x60_2 * x60_2)));
    float x62_3 = ((0.0 < x61_1) ? (1.0 / sqrt(x61_1)) : 0.0);
    float x63_1 = (x58_1 * x62_3);
    float x64_ = (x59_3 * x62_3);
    float x65_1 = (x60_2 * x62_3);
    float x66_ = ((x61_1 * x62_3) / _e190);
    bool b67_ = (0.0 < x66_);
    float x68_1 = (x10_6 * x41_5);
    float x69_1 = (x11_8 * x46_5);
    float x70_1 = (x12_7 * x51_4);
    float x71_1 = (x68_1 + x69_1);
    float x72_1 = (x71_1 - x68_1);
    float x73_1 = (x70_1 + x71_1);
    float x74_1 = (x73_1 - x71_1);
    float x75_1 = (((x68_1 - (x71_1 - x72_1)) + (x69_1 - x72_1)) + ((x71_1 - (x73_1 - x74_1)) + (x70_1 - x74_1)));
    float x76_1 = ((x10_6 * x41_5 + -(x68_1)) + ((x11_8 * x46_5 + -(x69_1)) + (x12_7 * x51_4 + -(x70_1))));
    float x77_1 = ((x73_1 + ((x75_1 + x76_1) + (x10_6 * x43_4 + (x11_8 * x48_5 + (x12_7 * x53_5))))) / (b67_ ? x66_ : 1.0));
    float x78_1 = (b67_ ? x77_1 : 0.0);
    float x79_1 = (x10_6 + x13_7);
    float x80_1 = (x11_8 + x14_8);
    float x81_1 = (x12_7 + x15_6);
    float x82_1 = (x16_8 + x79_1);
    float x83_1 = (x17_5 + x80_1);
    float x84_1 = (x18_7 + x81_1);
    float x85_1 = (x10_6 + x16_8);
    float x86_1 = (x11_8 + x17_5);
    float x87_1 = (x12_7 + x18_7);
    float x88_1 = abs(x78_1);
    float _e257 = etendue_copysign(1.0, x78_1);
    float x90_ = (x10_6 * x20_5);
    float x91_ = (x11_8 * x21_5);
    float x92_ = (x12_7 * x22_6);
    float x93_ = (x90_ + x91_);
    float x94_1 = (x93_ - x90_);
    float x95_1 = (x92_ + x93_);
    float x96_1 = (x95_1 - x93_);
    float x97_1 = (((x90_ - (x93_ - x94_1)) + (x91_ - x94_1)) + ((x93_ - (x95_1 - x96_1)) + (x92_ - x96_1)));
    float x98_1 = ((x10_6 * x20_5 + -(x90_)) + ((x11_8 * x21_5 + -(x91_)) + (x12_7 * x22_6 + -(x92_))));
    float x99_1 = (x97_1 + x98_1);
    float x100_1 = (x13_7 * x20_5);
    float x101_1 = (x14_8 * x21_5);
    float x102_1 = (x15_6 * x22_6);
    float x103_1 = (x100_1 + x101_1);
    float x104_1 = (x103_1 - x100_1);
    float x105_1 = (x102_1 + x103_1);
    float x106_1 = (x105_1 - x103_1);
    float x107_1 = (((x100_1 - (x103_1 - x104_1)) + (x101_1 - x104_1)) + ((x103_1 - (x105_1 - x106_1)) + (x102_1 - x106_1)));
    float x108_1 = ((x13_7 * x20_5 + -(x100_1)) + ((x14_8 * x21_5 + -(x101_1)) + (x15_6 * x22_6 + -(x102_1))));
    float x109_1 = (x24_4 * (x95_1 + x99_1));
    float x110_1 = (x95_1 + x105_1);
    float x111_1 = (x110_1 - x95_1);
    float x112_1 = (((x95_1 - (x110_1 - x111_1)) + (x105_1 - x111_1)) + (x99_1 + (x107_1 + x108_1)));
    float x113_1 = (x24_4 * (x110_1 + x112_1));
    bool b114_ = ((x109_1 + x113_1) < 0.0);
    float _e327 = etendue_greater((b114_ ? -(x113_1) : x109_1), (x28_5 * -0.5));
    float x116_1 = (x28_5 + _e327);
    float x117_1 = (x10_6 * x30_5);
    float x118_1 = (x11_8 * x31_5);
    float x119_1 = (x12_7 * x32_5);
    float x120_1 = (x117_1 + x118_1);
    float x121_1 = (x120_1 - x117_1);
    float x122_1 = (x119_1 + x120_1);
    float x123_1 = (x122_1 - x120_1);
    float x124_1 = (((x117_1 - (x120_1 - x121_1)) + (x118_1 - x121_1)) + ((x120_1 - (x122_1 - x123_1)) + (x119_1 - x123_1)));
    float x125_1 = ((x10_6 * x30_5 + -(x117_1)) + ((x11_8 * x31_5 + -(x118_1)) + (x12_7 * x32_5 + -(x119_1))));
    float x126_1 = (x124_1 + x125_1);
    float x127_1 = (x16_8 * x30_5);
    float x128_1 = (x17_5 * x31_5);
    float x129_1 = (x18_7 * x32_5);
    float x130_1 = (x127_1 + x128_1);
    float x131_1 = (x130_1 - x127_1);
    float x132_1 = (x129_1 + x130_1);
    float x133_1 = (x132_1 - x130_1);
    float x134_1 = (((x127_1 - (x130_1 - x131_1)) + (x128_1 - x131_1)) + ((x130_1 - (x132_1 - x133_1)) + (x129_1 - x133_1)));
    float x135_1 = ((x16_8 * x30_5 + -(x127_1)) + ((x17_5 * x31_5 + -(x128_1)) + (x18_7 * x32_5 + -(x129_1))));
    float x136_1 = (x34_5 * (x122_1 + x126_1));
    float x137_1 = (x122_1 + x132_1);
    float x138_1 = (x137_1 - x122_1);
    float x139_1 = (((x122_1 - (x137_1 - x138_1)) + (x132_1 - x138_1)) + (x126_1 + (x134_1 + x135_1)));
    float x140_1 = (x34_5 * (x137_1 + x139_1));
    bool b141_ = ((x136_1 + x140_1) < 0.0);
    float _e398 = etendue_greater((b141_ ? -(x140_1) : x136_1), (x38_5 * -0.5));
    float x143_1 = (x38_5 + _e398);
    float x144_1 = (b114_ ? -(x25_6) : x25_6);
    float x145_1 = (b114_ ? -(x26_4) : x26_4);
    float x146_1 = (b114_ ? -(x27_5) : x27_5);
    float x147_1 = (b141_ ? -(x35_4) : x35_4);
    float x148_1 = (b141_ ? -(x36_4) : x36_4);
    float x149_1 = (b141_ ? -(x37_5) : x37_5);
    bool b150_ = (x116_1 <= (_e327 + _e327));
    bool b151_ = (x143_1 <= (_e398 + _e398));
    float x152_1 = (b150_ ? x116_1 : 0.0);
    float x153_1 = (b151_ ? x143_1 : 0.0);
    float x154_1 = (x116_1 - x152_1);
    float x155_1 = (x143_1 - x153_1);
    float x156_1 = (((b114_ ? (b141_ ? x10_6 : x85_1) : (b141_ ? x79_1 : x82_1)) - (x144_1 * x154_1)) - (x147_1 * x155_1));
    float x157_1 = (((b114_ ? (b141_ ? x11_8 : x86_1) : (b141_ ? x80_1 : x83_1)) - (x145_1 * x154_1)) - (x148_1 * x155_1));
    float x158_1 = (((b114_ ? (b141_ ? x12_7 : x87_1) : (b141_ ? x81_1 : x84_1)) - (x146_1 * x154_1)) - (x149_1 * x155_1));
    float _e443 = etendue_greater(x154_1, x155_1);
    float _e444 = etendue_greater(x152_1, x153_1);
    float _e445 = etendue_greater(_e444, x88_1);
    bool b159_ = (_e443 <= _e445);
    float x160_1 = (b159_ ? x156_1 : (x144_1 * x152_1 + (x147_1 * x153_1 + (x63_1 * x78_1))));
    float x161_1 = (b159_ ? x157_1 : (x145_1 * x152_1 + (x148_1 * x153_1 + (x64_ * x78_1))));
    float x162_1 = (b159_ ? x158_1 : (x146_1 * x152_1 + (x149_1 * x153_1 + (x65_1 * x78_1))));
    float x163_1 = (x88_1 * x88_1);
    float x164_1 = (_e398 * x143_1);
    float x165_1 = sqrt(((_e398 * _e398 + x163_1) * (x143_1 * x143_1 + x163_1)));
    bool b166_ = (0.0 < x165_1);
    float x167_1 = (b166_ ? (1.0 / (b166_ ? x165_1 : 1.0)) : 0.0);
    bool b168_ = (_e398 < 0.0);
    float x169_1 = (x116_1 * x116_1);
    float x170_1 = (x163_1 + x169_1);
    float x171_1 = sqrt((_e398 * _e398 + x170_1));
    float x172_1 = (x143_1 * x143_1 + x170_1);
    float x173_1 = sqrt(x172_1);
    float x174_1 = (x171_1 * x173_1);
    bool b175_ = (0.0 < x170_1);
    float x176_1 = (b175_ ? (1.0 / (b175_ ? x170_1 : 1.0)) : 0.0);
    float x177_1 = abs(_e398);
    float x178_1 = (x143_1 * x171_1 + (x173_1 * x177_1));
    float x179_1 = (x38_5 * (_e398 + x143_1));
    bool b180_ = (0.0 < x178_1);
    float x181_1 = abs(x164_1);
    float x182_1 = (x174_1 + x181_1);
    bool b183_ = (0.0 < x182_1);
    float x184_1 = ((b168_ ? (x176_1 * x178_1) : (b180_ ? (x179_1 / (b180_ ? x178_1 : 1.0)) : 0.0)) * (x88_1 * x116_1));
    float x185_1 = (x167_1 * x184_1);
    float x186_1 = (x167_1 * (x176_1 * (x164_1 * x169_1 + (x163_1 * x174_1))));
    float x187_1 = (x167_1 * (x38_5 * (x38_5 * x163_1)));
    float x188_1 = (1.0 + (b183_ ? ((_e398 * _e398 + x172_1) / (b183_ ? x182_1 : 1.0)) : 0.0));
    float x189_1 = (x170_1 + x182_1);
    float x190_1 = (b168_ ? (x170_1 * x188_1) : x189_1);
    bool b191_ = (0.0 < x190_1);
    float x192_1 = (b191_ ? (x187_1 / (b191_ ? x190_1 : 1.0)) : 0.0);
    float x193_1 = (x163_1 * x167_1);
    float x194_1 = (x193_1 * (b168_ ? (x176_1 * x189_1) : x188_1));
    bool b195_ = (_e327 < 0.0);
    float x196_1 = (-(_e327) * -(_e327));
    float x197_1 = (x163_1 + x196_1);
    float x198_1 = sqrt((_e398 * _e398 + x197_1));
    float x199_1 = (x143_1 * x143_1 + x197_1);
    float x200_1 = sqrt(x199_1);
    float x201_1 = (x198_1 * x200_1);
    bool b202_ = (0.0 < x197_1);
    float x203_1 = (b202_ ? (1.0 / (b202_ ? x197_1 : 1.0)) : 0.0);
    float x204_1 = (x143_1 * x198_1 + (x177_1 * x200_1));
    bool b205_ = (0.0 < x204_1);
    float x206_1 = (x181_1 + x201_1);
    bool b207_ = (0.0 < x206_1);
    float x208_1 = ((b168_ ? (x203_1 * x204_1) : (b205_ ? (x179_1 / (b205_ ? x204_1 : 1.0)) : 0.0)) * (x88_1 * -(_e327)));
    float x209_1 = (x167_1 * x208_1);
    float x210_1 = (x167_1 * (x203_1 * (x164_1 * x196_1 + (x163_1 * x201_1))));
    float x211_1 = (1.0 + (b207_ ? ((_e398 * _e398 + x199_1) / (b207_ ? x206_1 : 1.0)) : 0.0));
    float x212_1 = (x197_1 + x206_1);
    float x213_1 = (b168_ ? (x197_1 * x211_1) : x212_1);
    bool b214_ = (0.0 < x213_1);
    float x215_1 = (b214_ ? (x187_1 / (b214_ ? x213_1 : 1.0)) : 0.0);
    float x216_ = (x193_1 * (b168_ ? (x203_1 * x212_1) : x211_1));
    bool b217_ = (b168_ || b195_);
    bool b218_ = (b168_ && !(b195_));
    float x219_1 = (b218_ ? _e398 : _e327);
    float x220_1 = (b218_ ? _e327 : _e398);
    float x221_1 = (b218_ ? x143_1 : x116_1);
    float x222_1 = (b218_ ? x116_1 : x143_1);
    float x223_1 = (x219_1 * x219_1 + x163_1);
    float x224_1 = (x221_1 * x221_1 + x163_1);
    float x225_1 = sqrt((x220_1 * x220_1 + x223_1));
    float x226_1 = sqrt((x222_1 * x222_1 + x223_1));
    float x227_1 = sqrt((x220_1 * x220_1 + x224_1));
    float x228_1 = sqrt((x222_1 * x222_1 + x224_1));
    float x229_1 = (x220_1 * x222_1);
    bool b230_1 = (0.0 <= x220_1);
    float x231_1 = abs(x220_1);
    float x232_1 = (x222_1 * x227_1 + (x228_1 * x231_1));
    float x233_1 = ((b218_ ? x28_5 : x38_5) * (x220_1 + x222_1));
    bool b234_ = (0.0 < x232_1);
    float x235_1 = ((b230_1 ? (b234_ ? ((x224_1 * x233_1) / (b234_ ? x232_1 : 1.0)) : 0.0) : x232_1) * (x88_1 * abs(x221_1)));
    float x236_1 = (x222_1 * x225_1 + (x226_1 * x231_1));
    bool b237_ = (0.0 < x236_1);
    float x238_1 = ((b230_1 ? (b237_ ? ((x223_1 * x233_1) / (b237_ ? x236_1 : 1.0)) : 0.0) : x236_1) * (x88_1 * abs(x219_1)));
    float x239_1 = (x225_1 * x226_1);
    float x240_1 = (x38_5 * (x28_5 * x88_1));
    float x241_1 = (x219_1 * x221_1);
    float x242_1 = (x163_1 + (x229_1 + x241_1));
    float x243_1 = (x228_1 * (x225_1 * x227_1) + (x228_1 * (x241_1 + (x220_1 * x220_1 + x163_1)) + (x227_1 * x242_1 + (x225_1 * (x224_1 + x229_1)))));
    float x244_1 = (x228_1 * x239_1 + (x225_1 * (x241_1 + (x222_1 * x222_1 + x163_1)) + (x226_1 * x242_1 + (x228_1 * (x223_1 + x229_1)))));
    float _e681 = etendue_angle((b217_ ? x235_1 : x240_1), (b217_ ? (x229_1 * (x221_1 * x221_1) + (x163_1 * (x227_1 * x228_1))) : x243_1));
    float _e687 = etendue_angle((b217_ ? x238_1 : x240_1), (b217_ ? (x229_1 * (x219_1 * x219_1) + (x163_1 * x239_1)) : x244_1));
    float x246_ = (_e681 + _e687);
    float x247_1 = (x246_ * (b217_ ? 1.0 : 2.0));
    bool b248_ = (0.0 < x185_1);
    bool b249_ = ((((b8_2 && (1e-36 < x247_1)) && (x247_1 < 7.0)) && b248_) && (1e-18 < x88_1));
    float x250_1 = (x11_8 * x15_6);
    float x251_1 = (x12_7 * x14_8);
    float x252_1 = (x250_1 - x251_1);
    float x253_ = (x252_1 - x250_1);
    float x254_1 = (((x250_1 - (x252_1 - x253_)) + (-(x251_1) - x253_)) + ((x11_8 * x15_6 + -(x250_1)) - (x12_7 * x14_8 + -(x251_1))));
    float x255_ = (x12_7 * x13_7);
    float x256_1 = (x10_6 * x15_6);
    float x257_ = (x255_ - x256_1);
    float x258_1 = (x257_ - x255_);
    float x259_1 = (((x255_ - (x257_ - x258_1)) + (-(x256_1) - x258_1)) + ((x12_7 * x13_7 + -(x255_)) - (x10_6 * x15_6 + -(x256_1))));
    float x260_1 = (x10_6 * x14_8);
    float x261_1 = (x11_8 * x13_7);
    float x262_1 = (x260_1 - x261_1);
    float x263_1 = (x262_1 - x260_1);
    float x264_1 = (((x260_1 - (x262_1 - x263_1)) + (-(x261_1) - x263_1)) + ((x10_6 * x14_8 + -(x260_1)) - (x11_8 * x13_7 + -(x261_1))));
    float x265_1 = (x11_8 * x18_7);
    float x266_1 = (x12_7 * x17_5);
    float x267_1 = (x265_1 - x266_1);
    float x268_1 = (x267_1 - x265_1);
    float x269_1 = (((x265_1 - (x267_1 - x268_1)) + (-(x266_1) - x268_1)) + ((x11_8 * x18_7 + -(x265_1)) - (x12_7 * x17_5 + -(x266_1))));
    float x270_1 = (x12_7 * x16_8);
    float x271_ = (x10_6 * x18_7);
    float x272_1 = (x270_1 - x271_);
    float x273_ = (x272_1 - x270_1);
    float x274_1 = (((x270_1 - (x272_1 - x273_)) + (-(x271_) - x273_)) + ((x12_7 * x16_8 + -(x270_1)) - (x10_6 * x18_7 + -(x271_))));
    float x275_1 = (x10_6 * x17_5);
    float x276_ = (x11_8 * x16_8);
    float x277_ = (x275_1 - x276_);
    float x278_1 = (x277_ - x275_1);
    float x279_1 = (((x275_1 - (x277_ - x278_1)) + (-(x276_) - x278_1)) + ((x10_6 * x17_5 + -(x275_1)) - (x11_8 * x16_8 + -(x276_))));
    float x280_1 = (x14_8 * x18_7);
    float x281_1 = (x15_6 * x17_5);
    float x282_1 = (x280_1 - x281_1);
    float x283_ = (x282_1 - x280_1);
    float x284_1 = (((x280_1 - (x282_1 - x283_)) + (-(x281_1) - x283_)) + ((x14_8 * x18_7 + -(x280_1)) - (x15_6 * x17_5 + -(x281_1))));
    float x285_1 = (x15_6 * x16_8);
    float x286_1 = (x13_7 * x18_7);
    float x287_1 = (x285_1 - x286_1);
    float x288_1 = (x287_1 - x285_1);
    float x289_1 = (((x285_1 - (x287_1 - x288_1)) + (-(x286_1) - x288_1)) + ((x15_6 * x16_8 + -(x285_1)) - (x13_7 * x18_7 + -(x286_1))));
    float x290_1 = (x13_7 * x17_5);
    float x291_1 = (x14_8 * x16_8);
    float x292_1 = (x290_1 - x291_1);
    float x293_1 = (x292_1 - x290_1);
    float x294_1 = (((x290_1 - (x292_1 - x293_1)) + (-(x291_1) - x293_1)) + ((x13_7 * x17_5 + -(x290_1)) - (x14_8 * x16_8 + -(x291_1))));
    float x295_1 = (-(x267_1) - x269_1);
    float x296_1 = (-(x272_1) - x274_1);
    float x297_ = (-(x277_) - x279_1);
    float _e848 = etendue_greater(abs(x295_1), abs(x296_1));
    float _e850 = etendue_greater(_e848, abs(x297_));
    float _e851 = etendue_pow2_scale(_e850);
    float x299_1 = (x295_1 * _e851);
    float x300_1 = (x296_1 * _e851);
    float x301_1 = (x297_ * _e851);
    float x302_1 = (x299_1 * x299_1 + (x300_1 * x300_1 + (x301_1 * x301_1)));
    float x303_1 = ((0.0 < x302_1) ? (1.0 / sqrt(x302_1)) : 0.0);
    float x304_1 = (x299_1 * x303_1);
    float x305_1 = (x300_1 * x303_1);
    float x306_1 = (x301_1 * x303_1);
    float x307_1 = ((x302_1 * x303_1) / _e851);
    bool b308_1 = (_e257 < 0.0);
    float x309_1 = (b308_1 ? -(x304_1) : x304_1);
    float x310_1 = (b308_1 ? -(x305_1) : x305_1);
    float x311_1 = (b308_1 ? -(x306_1) : x306_1);
    bool b312_ = (0.0 < x307_1);
    float x313_1 = (b312_ ? (-((x10_6 * x85_1 + (x11_8 * x86_1 + (x12_7 * x87_1)))) / (b312_ ? x307_1 : 1.0)) : 0.0);
    float _e890 = etendue_greater(x313_1, 1.0);
    float _e892 = etendue_lesser(_e890, 1e18);
    float x314_1 = (_e892 * 4.7683716e-7);
    float x315_1 = (x267_1 + x282_1);
    float x316_1 = (x315_1 - x267_1);
    float x317_1 = (x272_1 + x287_1);
    float x318_1 = (x317_1 - x272_1);
    float x319_1 = (x277_ + x292_1);
    float x320_1 = (x319_1 - x277_);
    float x321_1 = (x315_1 + (((x267_1 - (x315_1 - x316_1)) + (x282_1 - x316_1)) + (x269_1 + x284_1)));
    float x322_ = (x317_1 + (((x272_1 - (x317_1 - x318_1)) + (x287_1 - x318_1)) + (x274_1 + x289_1)));
    float x323_1 = (x319_1 + (((x277_ - (x319_1 - x320_1)) + (x292_1 - x320_1)) + (x279_1 + x294_1)));
    float _e924 = etendue_greater(abs(x321_1), abs(x322_));
    float _e926 = etendue_greater(_e924, abs(x323_1));
    float _e927 = etendue_pow2_scale(_e926);
    float x325_1 = (x321_1 * _e927);
    float x326_1 = (x322_ * _e927);
    float x327_1 = (x323_1 * _e927);
    float x328_1 = (x325_1 * x325_1 + (x326_1 * x326_1 + (x327_1 * x327_1)));
    float x329_1 = ((0.0 < x328_1) ? (1.0 / sqrt(x328_1)) : 0.0);
    float x330_ = (x325_1 * x329_1);
    float x331_1 = (x326_1 * x329_1);
    float x332_1 = (x327_1 * x329_1);
    float x333_1 = ((x328_1 * x329_1) / _e927);
    float x334_1 = (b308_1 ? -(x330_) : x330_);
    float x335_1 = (b308_1 ? -(x331_1) : x331_1);
    float x336_1 = (b308_1 ? -(x332_1) : x332_1);
    bool b337_ = (0.0 < x333_1);
    float x338_1 = (b337_ ? (-((x79_1 * x82_1 + (x80_1 * x83_1 + (x81_1 * x84_1)))) / (b337_ ? x333_1 : 1.0)) : 0.0);
    float _e965 = etendue_greater(x338_1, 1.0);
    float _e967 = etendue_lesser(_e965, 1e18);
    float x339_1 = (4.7683716e-7 * _e967);
    float x340_1 = (x252_1 + x254_1);
    float x341_1 = (x257_ + x259_1);
    float x342_1 = (x262_1 + x264_1);
    float _e974 = etendue_greater(abs(x340_1), abs(x341_1));
    float _e976 = etendue_greater(_e974, abs(x342_1));
    float _e977 = etendue_pow2_scale(_e976);
    float x344_ = (x340_1 * _e977);
    float x345_1 = (x341_1 * _e977);
    float x346_1 = (x342_1 * _e977);
    float x347_1 = (x344_ * x344_ + (x345_1 * x345_1 + (x346_1 * x346_1)));
    float x348_1 = ((0.0 < x347_1) ? (1.0 / sqrt(x347_1)) : 0.0);
    float x349_1 = (x344_ * x348_1);
    float x350_1 = (x345_1 * x348_1);
    float x351_ = (x346_1 * x348_1);
    float x352_1 = ((x347_1 * x348_1) / _e977);
    float x353_1 = (b308_1 ? -(x349_1) : x349_1);
    float x354_1 = (b308_1 ? -(x350_1) : x350_1);
    float x355_1 = (b308_1 ? -(x351_) : x351_);
    bool b356_ = (0.0 < x352_1);
    float x357_ = (b356_ ? (-((x10_6 * x79_1 + (x11_8 * x80_1 + (x12_7 * x81_1)))) / (b356_ ? x352_1 : 1.0)) : 0.0);
    float _e1015 = etendue_greater(x357_, 1.0);
    float _e1017 = etendue_lesser(_e1015, 1e18);
    float x358_1 = (4.7683716e-7 * _e1017);
    float x359_1 = (x282_1 - x252_1);
    float x360_1 = (x359_1 - x282_1);
    float x361_1 = (x287_1 - x257_);
    float x362_1 = (x361_1 - x287_1);
    float x363_1 = (x292_1 - x262_1);
    float x364_ = (x363_1 - x292_1);
    float x365_ = (((x282_1 - (x359_1 - x360_1)) + (-(x252_1) - x360_1)) + (x284_1 - x254_1));
    float x366_ = (((x287_1 - (x361_1 - x362_1)) + (-(x257_) - x362_1)) + (x289_1 - x259_1));
    float x367_ = (((x292_1 - (x363_1 - x364_)) + (-(x262_1) - x364_)) + (x294_1 - x264_1));
    float x368_ = (x359_1 + x365_);
    float x369_ = (x361_1 + x366_);
    float x370_ = (x363_1 + x367_);
    float _e1051 = etendue_greater(abs(x368_), abs(x369_));
    float _e1053 = etendue_greater(_e1051, abs(x370_));
    float _e1054 = etendue_pow2_scale(_e1053);
    float x372_ = (x368_ * _e1054);
    float x373_ = (x369_ * _e1054);
    float x374_ = (x370_ * _e1054);
    float x375_ = (x372_ * x372_ + (x373_ * x373_ + (x374_ * x374_)));
    float x376_ = ((0.0 < x375_) ? (1.0 / sqrt(x375_)) : 0.0);
    float x377_ = (x372_ * x376_);
    float x378_ = (x373_ * x376_);
    float x379_ = (x374_ * x376_);
    float x380_ = ((x375_ * x376_) / _e1054);
    float x381_ = (b308_1 ? -(x377_) : x377_);
    float x382_ = (b308_1 ? -(x378_) : x378_);
    float x383_ = (b308_1 ? -(x379_) : x379_);
    bool b384_ = (0.0 < x380_);
    float x385_ = (b384_ ? (-((x82_1 * x85_1 + (x83_1 * x86_1 + (x84_1 * x87_1)))) / (b384_ ? x380_ : 1.0)) : 0.0);
    float _e1092 = etendue_greater(x385_, 1.0);
    float _e1094 = etendue_lesser(_e1092, 1e18);
    float x386_ = (4.7683716e-7 * _e1094);
    float x387_ = (b114_ ? x334_1 : x309_1);
    float x388_ = (b114_ ? x335_1 : x310_1);
    float x389_ = (b114_ ? x336_1 : x311_1);
    float x390_ = (b114_ ? x309_1 : x334_1);
    float x391_ = (b114_ ? x310_1 : x335_1);
    float x392_ = (b114_ ? x311_1 : x336_1);
    float x393_ = (b141_ ? x381_ : x353_1);
    float x394_ = (b141_ ? x382_ : x354_1);
    float x395_ = (b141_ ? x383_ : x355_1);
    float x396_ = (b141_ ? x353_1 : x381_);
    float x397_ = (b141_ ? x354_1 : x382_);
    float x398_ = (b141_ ? x355_1 : x383_);
    float x399_ = (b114_ ? x339_1 : x314_1);
    float x400_ = (b141_ ? x386_ : x358_1);
    float x401_ = (b114_ ? x314_1 : x339_1);
    float x402_ = (b141_ ? x358_1 : x386_);
    float x403_ = (x63_1 * _e257);
    float x404_ = (x64_ * _e257);
    float x405_ = (x65_1 * _e257);
    float x406_ = (b150_ ? 1.0 : 0.0);
    float x407_ = (b151_ ? 1.0 : 0.0);
    float x408_ = (b114_ ? 1.0 : 0.0);
    float x409_ = (b141_ ? 1.0 : 0.0);
    float x410_ = (b248_ ? (1.0 / (b248_ ? x185_1 : 1.0)) : 0.0);
    float x411_ = (b195_ ? 0.5 : 2.0);
    float x412_ = (b249_ ? x247_1 : 0.0);
    float x413_ = (1.0 / _e49);
    float _e1141 = etendue_greater(0.0, _e18);
    float _e1142 = etendue_greater(_e1141, _e29);
    float _e1143 = etendue_greater(_e1142, _e40);
    float _e1145 = etendue_from_bits(2139095040u);
    bool b415_ = (_e1143 < _e1145);
    float _e1147 = etendue_pow2_scale(_e1143);
    float x417_ = (_e1147 * (b415_ ? x1_13 : 0.0));
    float x418_ = (_e1147 * (b415_ ? x2_13 : 0.0));
    float x419_ = (_e1147 * (b415_ ? x3_12 : 0.0));
    float x420_ = (_e1147 * (b415_ ? light_2.edge_s.x : 0.0));
    float x421_ = (_e1147 * (b415_ ? light_2.edge_s.y : 0.0));
    float x422_ = (_e1147 * (b415_ ? light_2.edge_s.z : 0.0));
    float x423_ = (_e1147 * (b415_ ? light_2.edge_t.x : 0.0));
    float x424_ = (_e1147 * (b415_ ? light_2.edge_t.y : 0.0));
    float x425_ = (_e1147 * (b415_ ? light_2.edge_t.z : 0.0));
    float _e1189 = etendue_greater(abs(x420_), abs(x421_));
    float _e1191 = etendue_greater(_e1189, abs(x422_));
    float _e1192 = etendue_pow2_scale(_e1191);
    float _e1195 = etendue_greater(abs(x423_), abs(x424_));
    float _e1197 = etendue_greater(_e1195, abs(x425_));
    float _e1198 = etendue_pow2_scale(_e1197);
    float x428_ = (x420_ * _e1192);
    float x429_ = (x421_ * _e1192);
    float x430_ = (x422_ * _e1192);
    float x431_ = (x423_ * _e1198);
    float x432_ = (x424_ * _e1198);
    float x433_ = (x425_ * _e1198);
    float x434_ = (x429_ * x433_);
    float x435_ = (x430_ * x432_);
    float x436_ = (x434_ - x435_);
    float x437_ = (x436_ - x434_);
    float x438_ = (((x434_ - (x436_ - x437_)) + (-(x435_) - x437_)) + ((x429_ * x433_ + -(x434_)) - (x430_ * x432_ + -(x435_))));
    float x439_ = (x430_ * x431_);
    float x440_ = (x428_ * x433_);
    float x441_ = (x439_ - x440_);
    float x442_ = (x441_ - x439_);
    float x443_ = (((x439_ - (x441_ - x442_)) + (-(x440_) - x442_)) + ((x430_ * x431_ + -(x439_)) - (x428_ * x433_ + -(x440_))));
    float x444_ = (x428_ * x432_);
    float x445_ = (x429_ * x431_);
    float x446_ = (x444_ - x445_);
    float x447_ = (x446_ - x444_);
    float x448_ = (((x444_ - (x446_ - x447_)) + (-(x445_) - x447_)) + ((x428_ * x432_ + -(x444_)) - (x429_ * x431_ + -(x445_))));
    float x449_ = (x436_ + x438_);
    float x450_ = (x441_ + x443_);
    float x451_ = (x446_ + x448_);
    float _e1255 = etendue_greater(abs(x449_), abs(x450_));
    float _e1257 = etendue_greater(_e1255, abs(x451_));
    float _e1258 = etendue_pow2_scale(_e1257);
    float x453_ = (x449_ * _e1258);
    float x454_ = (x450_ * _e1258);
    float x455_ = (x451_ * _e1258);
    float x456_ = (x453_ * x453_ + (x454_ * x454_ + (x455_ * x455_)));
    float x457_ = ((0.0 < x456_) ? (1.0 / sqrt(x456_)) : 0.0);
    float x458_ = (x453_ * x457_);
    float x459_ = (x454_ * x457_);
    float x460_ = (x455_ * x457_);
    float x461_ = ((x456_ * x457_) / _e1258);
    float x462_ = (x417_ * x436_);
    float x463_ = (x418_ * x441_);
    float x464_ = (x419_ * x446_);
    float x465_ = (x462_ + x463_);
    float x466_ = (x465_ - x462_);
    float x467_ = (x464_ + x465_);
    float x468_ = (x467_ - x465_);
    float x469_ = (((x462_ - (x465_ - x466_)) + (x463_ - x466_)) + ((x465_ - (x467_ - x468_)) + (x464_ - x468_)));
    float x470_ = ((x417_ * x436_ + -(x462_)) + ((x418_ * x441_ + -(x463_)) + (x419_ * x446_ + -(x464_))));
    bool b471_ = (1e-37 < abs(x461_));
    float x472_ = ((x467_ + ((x469_ + x470_) + (x417_ * x438_ + (x418_ * x443_ + (x419_ * x448_))))) / (b471_ ? x461_ : 1.0));
    float _e1316 = etendue_greater((b471_ ? x472_ : 0.0), -1e37);
    float _e1318 = etendue_lesser(_e1316, 1e37);
    float x474_ = ((x461_ / _e1192) / _e1198);
    float x475_ = (x458_ * x474_);
    float x476_ = (x459_ * x474_);
    float x477_ = (x460_ * x474_);
    float x478_ = -((x419_ * x421_));
    float x479_ = ((x418_ * x422_ + x478_) - (x419_ * x421_ + x478_));
    float x480_ = -((x417_ * x422_));
    float x481_ = ((x419_ * x420_ + x480_) - (x417_ * x422_ + x480_));
    float x482_ = -((x418_ * x420_));
    float x483_ = ((x417_ * x421_ + x482_) - (x418_ * x420_ + x482_));
    float x484_ = -((x419_ * x424_));
    float x485_ = ((x418_ * x425_ + x484_) - (x419_ * x424_ + x484_));
    float x486_ = -((x417_ * x425_));
    float x487_ = ((x419_ * x423_ + x486_) - (x417_ * x425_ + x486_));
    float x488_ = -((x418_ * x423_));
    float x489_ = ((x417_ * x424_ + x488_) - (x418_ * x423_ + x488_));
    float x490_ = (1.0 / _e1147);
    result_12.surface_plane_cross.x = x475_;
    result_12.surface_plane_cross.y = x476_;
    result_12.surface_plane_cross.z = x477_;
    result_12.surface_plane_normal.x = x458_;
    result_12.surface_plane_normal.y = x459_;
    result_12.surface_plane_normal.z = x460_;
    result_12.surface_plane_height = _e1318;
    result_12.surface_plane_along_first.x = x479_;
    result_12.surface_plane_along_first.y = x481_;
    result_12.surface_plane_along_first.z = x483_;
    result_12.surface_plane_along_second.x = x485_;
    result_12.surface_plane_along_second.y = x487_;
    result_12.surface_plane_along_second.z = x489_;
    result_12.surface_plane_unit = x490_;
    result_12.shape_base.x = x160_1;
    result_12.shape_base.y = x161_1;
    result_12.shape_base.z = x162_1;
    result_12.shape_side_x.x = x144_1;
    result_12.shape_side_x.y = x145_1;
    result_12.shape_side_x.z = x146_1;
    result_12.shape_side_y.x = x147_1;
    result_12.shape_side_y.y = x148_1;
    result_12.shape_side_y.z = x149_1;
    result_12.shape_near_x.x = x387_;
    result_12.shape_near_x.y = x388_;
    result_12.shape_near_x.z = x389_;
    result_12.shape_far_x.x = x390_;
    result_12.shape_far_x.y = x391_;
    result_12.shape_far_x.z = x392_;
    result_12.shape_near_y.x = x393_;
    result_12.shape_near_y.y = x394_;
    result_12.shape_near_y.z = x395_;
    result_12.shape_far_y.x = x396_;
    result_12.shape_far_y.y = x397_;
    result_12.shape_far_y.z = x398_;
    result_12.shape_slack.x = x399_;
    result_12.shape_slack.y = x400_;
    result_12.shape_slack_far.x = x401_;
    result_12.shape_slack_far.y = x402_;
    result_12.shape_normal.x = x403_;
    result_12.shape_normal.y = x404_;
    result_12.shape_normal.z = x405_;
    result_12.shape_near.x = _e327;
    result_12.shape_near.y = _e398;
    result_12.shape_far.x = x116_1;
    result_12.shape_far.y = x143_1;
    result_12.shape_size.x = x28_5;
    result_12.shape_size.y = x38_5;
    result_12.shape_height = x88_1;
    result_12.shape_anchor.x = x406_;
    result_12.shape_anchor.y = x407_;
    result_12.shape_flip.x = x408_;
    result_12.shape_flip.y = x409_;
    result_12.shape_sin_w1_ = x185_1;
    result_12.shape_cos_w1_ = x186_1;
    result_12.shape_inv_sin_w1_ = x410_;
    result_12.shape_above_p = x192_1;
    result_12.shape_above_s = x194_1;
    result_12.shape_near_sin = x209_1;
    result_12.shape_near_cos = x210_1;
    result_12.shape_near_above_p = x215_1;
    result_12.shape_near_above_s = x216_;
    result_12.shape_half = x411_;
    result_12.shape_solid_angle = x412_;
    result_12.shape_side = _e257;
    result_12.shape_unit = x413_;
    EtendueRectangleBySolidAngle _e1473 = result_12;
    return _e1473;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
EtendueLightSample etendue_rectangle_by_solid_angle_sample(EtendueRectangleBySolidAngle prepared_8, vec2 u_5) {
    EtendueLightSample result_13 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    bool b1_3 = (0.0 < prepared_8.shape_flip.x);
    float x2_14 = (1.0 - u_5.x);
    float x3_13 = (b1_3 ? u_5.x : x2_14);
    bool b4_4 = (prepared_8.shape_half < x3_13);
    float x5_7 = (b4_4 ? prepared_8.shape_near_sin : prepared_8.shape_sin_w1_);
    float x6_11 = (b4_4 ? prepared_8.shape_near_cos : prepared_8.shape_cos_w1_);
    vec2 _e27 = etendue_sin_cos_turns(((b4_4 ? (b1_3 ? x2_14 : (1.0 - x2_14)) : x3_13) * (prepared_8.shape_solid_angle * 0.07957747)));
    float _e37 = etendue_greater((x5_7 * _e27.y + -((x6_11 * _e27.x))), -((b4_4 ? 1.0 : 0.0)));
    float x9_5 = -((_e27.x * (x6_11 * _e27.y + (x5_7 * _e27.x))));
    float x10_7 = (_e37 + _e37);
    float x11_9 = (_e27.x * x10_7);
    float _e58 = etendue_greater(((x11_9 + (b4_4 ? prepared_8.shape_near_above_p : prepared_8.shape_above_p)) * (x11_9 + (b4_4 ? prepared_8.shape_near_above_s : prepared_8.shape_above_s))), 0.0);
    float x12_8 = sqrt(_e58);
    float x13_8 = ((prepared_8.shape_sin_w1_ * prepared_8.shape_sin_w1_) * (x11_9 + (prepared_8.shape_above_p + prepared_8.shape_above_s)) + ((x11_9 + (prepared_8.shape_cos_w1_ + prepared_8.shape_cos_w1_)) * (prepared_8.shape_above_p * prepared_8.shape_above_s)));
    float x14_9 = (prepared_8.shape_far.x * (prepared_8.shape_far.x * (x13_8 * ((prepared_8.shape_inv_sin_w1_ * x10_7) * (prepared_8.shape_inv_sin_w1_ * _e27.x)))));
    float x15_7 = (prepared_8.shape_height * (_e27.y * _e37 + x9_5));
    float x16_9 = (b4_4 ? -(x15_7) : x15_7);
    bool b17_2 = (0.0 < prepared_8.shape_anchor.x);
    float x18_8 = (x12_8 * (b17_2 ? (prepared_8.shape_far.x * x12_8 + x16_9) : 1.0));
    float _e118 = etendue_greater(((b17_2 ? -(x14_9) : x16_9) / ((0.0 < x18_8) ? x18_8 : 1.0)), (b17_2 ? -(prepared_8.shape_size.x) : prepared_8.shape_near.x));
    float _e123 = etendue_lesser(_e118, (b17_2 ? 0.0 : prepared_8.shape_far.x));
    float x21_6 = (_e123 + (b17_2 ? prepared_8.shape_far.x : 0.0));
    float x22_7 = (x21_6 * x21_6 + (prepared_8.shape_height * prepared_8.shape_height));
    bool b23_1 = (0.0 < prepared_8.shape_flip.y);
    float x24_5 = (1.0 - u_5.y);
    float x25_7 = sqrt((prepared_8.shape_near.y * prepared_8.shape_near.y + x22_7));
    float x26_5 = sqrt((prepared_8.shape_far.y * prepared_8.shape_far.y + x22_7));
    float x27_6 = (prepared_8.shape_far.y * x25_7 + (x26_5 * abs(prepared_8.shape_near.y)));
    float x28_6 = (x27_6 * (x25_7 * x26_5));
    bool b29_1 = (0.0 < x28_6);
    float x30_6 = (b29_1 ? (1.0 / (b29_1 ? x28_6 : 1.0)) : 0.0);
    float x31_6 = (x27_6 * x30_6);
    float x32_6 = (x25_7 * x31_6);
    float x33_5 = (prepared_8.shape_far.y * x32_6);
    float x34_6 = ((0.0 <= prepared_8.shape_near.y) ? (x30_6 * (x22_7 * (prepared_8.shape_size.y * (prepared_8.shape_near.y + prepared_8.shape_far.y)))) : (x27_6 * x31_6));
    float x35_5 = (x31_6 * (prepared_8.shape_near.y * x26_5));
    float x36_5 = ((b23_1 ? u_5.y : x24_5) * x34_6);
    float x37_6 = ((b23_1 ? x24_5 : (1.0 - x24_5)) * x34_6);
    float x38_6 = (x35_5 + x37_6);
    bool b39_ = (x38_6 < 0.0);
    float x40_6 = (b39_ ? x38_6 : (x33_5 - x36_5));
    float x41_6 = ((b39_ ? -(x37_6) : x36_5) * (x40_6 + (b39_ ? x35_5 : x33_5)));
    float x42_6 = (x31_6 * (b39_ ? x26_5 : x25_7));
    float _e217 = etendue_greater((x22_7 * (x42_6 * (x22_7 * x42_6) + x41_6)), 0.0);
    float x43_5 = sqrt(_e217);
    bool b44_1 = (0.0 < prepared_8.shape_anchor.y);
    float x45_5 = (x43_5 * (b44_1 ? (x33_5 * x43_5 + (x32_6 * (x22_7 * x40_6))) : 1.0));
    float x46_6 = ((x22_7 * (b44_1 ? -((x26_5 * x41_6)) : x40_6)) / ((0.0 < x45_5) ? x45_5 : 1.0));
    float _e244 = etendue_greater(x46_6, (b44_1 ? -(prepared_8.shape_size.y) : prepared_8.shape_near.y));
    float _e249 = etendue_lesser(_e244, (b44_1 ? 0.0 : prepared_8.shape_far.y));
    float x48_6 = (prepared_8.shape_side_x.x * _e123 + (prepared_8.shape_side_y.x * _e249 + prepared_8.shape_base.x));
    float x49_5 = (prepared_8.shape_side_x.y * _e123 + (prepared_8.shape_side_y.y * _e249 + prepared_8.shape_base.y));
    float x50_6 = (prepared_8.shape_side_x.z * _e123 + (prepared_8.shape_side_y.z * _e249 + prepared_8.shape_base.z));
    float x51_5 = (x48_6 * x48_6 + (x49_5 * x49_5 + (x50_6 * x50_6)));
    float x52_4 = ((1e-37 < x51_5) ? (1.0 / sqrt(x51_5)) : 0.0);
    float x53_6 = (x48_6 * x52_4);
    float x54_4 = (x49_5 * x52_4);
    float x55_3 = (x50_6 * x52_4);
    bool b56_ = (0.0 < prepared_8.shape_solid_angle);
    float x57_1 = (b56_ ? (prepared_8.shape_unit * (x51_5 * x52_4)) : 0.0);
    float x58_2 = (prepared_8.surface_plane_cross.x * x53_6 + (prepared_8.surface_plane_cross.y * x54_4 + (prepared_8.surface_plane_cross.z * x55_3)));
    bool b59_ = (1e-37 < abs(x58_2));
    float x60_3 = (b59_ ? x58_2 : 1.0);
    float _e323 = etendue_greater((b59_ ? (-((prepared_8.surface_plane_along_second.x * x53_6 + (prepared_8.surface_plane_along_second.y * x54_4 + (prepared_8.surface_plane_along_second.z * x55_3)))) / x60_3) : 0.0), -1e37);
    float _e337 = etendue_greater((b59_ ? ((prepared_8.surface_plane_along_first.x * x53_6 + (prepared_8.surface_plane_along_first.y * x54_4 + (prepared_8.surface_plane_along_first.z * x55_3))) / x60_3) : 0.0), -1e37);
    float _e339 = etendue_lesser(_e337, 1e37);
    float _e341 = etendue_lesser(_e323, 1e37);
    float _e343 = etendue_greater(_e341, 0.0);
    float _e345 = etendue_lesser(_e343, 1.0);
    float _e347 = etendue_greater(_e339, 0.0);
    float _e349 = etendue_lesser(_e347, 1.0);
    float x65_2 = (b56_ ? (1.0 / (b56_ ? prepared_8.shape_solid_angle : 1.0)) : 0.0);
    bool b66_ = (prepared_8.shape_side < 0.0);
    bool b67_1 = (b66_ && (1e-37 < x65_2));
    float x68_2 = (b67_1 ? (1.0 / (b67_1 ? x65_2 : 1.0)) : 0.0);
    result_13.direction.x = x53_6;
    result_13.direction.y = x54_4;
    result_13.direction.z = x55_3;
    result_13.distance_ = x57_1;
    result_13.pdf = x65_2;
    result_13.weight = x68_2;
    result_13.normal.x = prepared_8.surface_plane_normal.x;
    result_13.normal.y = prepared_8.surface_plane_normal.y;
    result_13.normal.z = prepared_8.surface_plane_normal.z;
    result_13.uv.x = _e345;
    result_13.uv.y = _e349;
    result_13.emits = b66_;
    result_13.delta = false;
    EtendueLightSample _e398 = result_13;
    return _e398;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the solid angle
// Omega at the point p: pdf 1/Omega per steradian.
float etendue_rectangle_by_solid_angle_pdf(EtendueRectangleBySolidAngle prepared_9, vec3 w_4) {
    bool b1_4 = ((-(prepared_9.shape_slack.x) <= (prepared_9.shape_near_x.x * w_4.x + (prepared_9.shape_near_x.y * w_4.y + (prepared_9.shape_near_x.z * w_4.z)))) && (-(prepared_9.shape_slack_far.x) <= (prepared_9.shape_far_x.x * w_4.x + (prepared_9.shape_far_x.y * w_4.y + (prepared_9.shape_far_x.z * w_4.z)))));
    bool b2_2 = ((b1_4 && (-(prepared_9.shape_slack.y) <= (prepared_9.shape_near_y.x * w_4.x + (prepared_9.shape_near_y.y * w_4.y + (prepared_9.shape_near_y.z * w_4.z))))) && (-(prepared_9.shape_slack_far.y) <= (prepared_9.shape_far_y.x * w_4.x + (prepared_9.shape_far_y.y * w_4.y + (prepared_9.shape_far_y.z * w_4.z)))));
    bool b3_3 = (0.0 < prepared_9.shape_solid_angle);
    float x4_6 = ((b2_2 && (-4.7683716e-7 <= (prepared_9.shape_normal.x * w_4.x + (prepared_9.shape_normal.y * w_4.y + (prepared_9.shape_normal.z * w_4.z))))) ? (b3_3 ? (1.0 / (b3_3 ? prepared_9.shape_solid_angle : 1.0)) : 0.0) : 0.0);
    return x4_6;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian.
EtendueLightSample etendue_rectangle_by_solid_angle_hit(EtendueRectangleBySolidAngle prepared_10, vec3 w_5) {
    EtendueLightSample result_14 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    bool b1_5 = ((-(prepared_10.shape_slack.x) <= (prepared_10.shape_near_x.x * w_5.x + (prepared_10.shape_near_x.y * w_5.y + (prepared_10.shape_near_x.z * w_5.z)))) && (-(prepared_10.shape_slack_far.x) <= (prepared_10.shape_far_x.x * w_5.x + (prepared_10.shape_far_x.y * w_5.y + (prepared_10.shape_far_x.z * w_5.z)))));
    bool b2_3 = ((b1_5 && (-(prepared_10.shape_slack.y) <= (prepared_10.shape_near_y.x * w_5.x + (prepared_10.shape_near_y.y * w_5.y + (prepared_10.shape_near_y.z * w_5.z))))) && (-(prepared_10.shape_slack_far.y) <= (prepared_10.shape_far_y.x * w_5.x + (prepared_10.shape_far_y.y * w_5.y + (prepared_10.shape_far_y.z * w_5.z)))));
    bool b3_4 = (0.0 < prepared_10.shape_solid_angle);
    float x4_7 = ((b2_3 && (-4.7683716e-7 <= (prepared_10.shape_normal.x * w_5.x + (prepared_10.shape_normal.y * w_5.y + (prepared_10.shape_normal.z * w_5.z))))) ? (b3_4 ? (1.0 / (b3_4 ? prepared_10.shape_solid_angle : 1.0)) : 0.0) : 0.0);
    bool b5_5 = (0.0 < x4_7);
    float x6_12 = (prepared_10.surface_plane_cross.x * w_5.x + (prepared_10.surface_plane_cross.y * w_5.y + (prepared_10.surface_plane_cross.z * w_5.z)));
    bool b7_ = (1e-37 < abs(x6_12));
    float x8_8 = (b7_ ? x6_12 : 1.0);
    float _e132 = etendue_greater((b7_ ? (-((prepared_10.surface_plane_along_second.x * w_5.x + (prepared_10.surface_plane_along_second.y * w_5.y + (prepared_10.surface_plane_along_second.z * w_5.z)))) / x8_8) : 0.0), -1e37);
    float _e149 = etendue_greater((b7_ ? ((prepared_10.surface_plane_along_first.x * w_5.x + (prepared_10.surface_plane_along_first.y * w_5.y + (prepared_10.surface_plane_along_first.z * w_5.z))) / x8_8) : 0.0), -1e37);
    float _e151 = etendue_lesser(_e149, 1e37);
    float _e153 = etendue_lesser(_e132, 1e37);
    float _e155 = etendue_greater(_e153, 0.0);
    float _e157 = etendue_lesser(_e155, 1.0);
    float _e159 = etendue_greater(_e151, 0.0);
    float _e161 = etendue_lesser(_e159, 1.0);
    float x13_9 = (prepared_10.surface_plane_normal.x * w_5.x + (prepared_10.surface_plane_normal.y * w_5.y + (prepared_10.surface_plane_normal.z * w_5.z)));
    bool b14_ = (1e-37 < abs(x13_9));
    float _e185 = etendue_greater((b14_ ? (prepared_10.surface_plane_height / (b14_ ? x13_9 : 1.0)) : 0.0), -1e37);
    float _e187 = etendue_lesser(_e185, 1e37);
    float _e189 = etendue_greater(_e187, 0.0);
    float x15_8 = (prepared_10.surface_plane_unit * _e189);
    float _e193 = etendue_lesser(x15_8, 3.4028235e38);
    float x16_10 = (b5_5 ? _e193 : 0.0);
    bool b17_3 = ((prepared_10.shape_side < 0.0) && b5_5);
    bool b18_ = (b17_3 && (1e-37 < x4_7));
    float x19_5 = (b18_ ? (1.0 / (b18_ ? x4_7 : 1.0)) : 0.0);
    result_14.direction.x = w_5.x;
    result_14.direction.y = w_5.y;
    result_14.direction.z = w_5.z;
    result_14.distance_ = x16_10;
    result_14.pdf = x4_7;
    result_14.weight = x19_5;
    result_14.normal.x = prepared_10.surface_plane_normal.x;
    result_14.normal.y = prepared_10.surface_plane_normal.y;
    result_14.normal.z = prepared_10.surface_plane_normal.z;
    result_14.uv.x = _e157;
    result_14.uv.y = _e161;
    result_14.emits = b17_3;
    result_14.delta = false;
    EtendueLightSample _e240 = result_14;
    return _e240;
}

// Prepares a light for the shading point p. Uniform over the surface of area A: pdf distance^2/(|cos(theta')| A) per
// steradian, theta' at the light.
EtendueDiskByArea etendue_disk_by_area_prepare(EtendueDisk light_3, vec3 p_3) {
    EtendueDiskByArea result_15 = EtendueDiskByArea(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0);
    float x1_14 = (light_3.center.x - p_3.x);
    float x2_15 = (light_3.center.y - p_3.y);
    float x3_14 = (light_3.center.z - p_3.z);
    float _e16 = etendue_greater(abs(x1_14), abs(x2_15));
    float _e18 = etendue_greater(_e16, abs(x3_14));
    float _e20 = etendue_from_bits(2139095040u);
    bool b4_5 = (_e18 < _e20);
    float x5_8 = (b4_5 ? x1_14 : 0.0);
    float x6_13 = (b4_5 ? x2_15 : 0.0);
    float x7_12 = (b4_5 ? x3_14 : 0.0);
    float x8_9 = (b4_5 ? light_3.radius : 0.0);
    float _e34 = etendue_copysign(1.0, light_3.normal.z);
    float x10_8 = (-1.0 / (light_3.normal.z + _e34));
    float x11_10 = (x10_8 * (light_3.normal.x * light_3.normal.y));
    float x12_9 = (light_3.normal.x * _e34);
    float x13_10 = (light_3.normal.x * (x10_8 * x12_9) + 1.0);
    float x14_10 = (_e34 * x11_10);
    float x15_9 = -(x12_9);
    float x16_11 = (light_3.normal.y * (light_3.normal.y * x10_8) + _e34);
    float x17_6 = -(light_3.normal.y);
    float x18_9 = (light_3.normal.x * x5_8);
    float x19_6 = (light_3.normal.y * x6_13);
    float x20_6 = (light_3.normal.z * x7_12);
    float x21_7 = (x18_9 + x19_6);
    float x22_8 = (x21_7 - x18_9);
    float x23_6 = (x20_6 + x21_7);
    float x24_6 = (x23_6 - x21_7);
    float x25_8 = (((x18_9 - (x21_7 - x22_8)) + (x19_6 - x22_8)) + ((x21_7 - (x23_6 - x24_6)) + (x20_6 - x24_6)));
    float x26_6 = ((light_3.normal.x * x5_8 + -(x18_9)) + ((light_3.normal.y * x6_13 + -(x19_6)) + (light_3.normal.z * x7_12 + -(x20_6))));
    float x27_7 = (x23_6 + (x25_8 + x26_6));
    result_15.surface_center.x = x5_8;
    result_15.surface_center.y = x6_13;
    result_15.surface_center.z = x7_12;
    result_15.surface_frame_s.x = x13_10;
    result_15.surface_frame_s.y = x14_10;
    result_15.surface_frame_s.z = x15_9;
    result_15.surface_frame_t.x = x11_10;
    result_15.surface_frame_t.y = x16_11;
    result_15.surface_frame_t.z = x17_6;
    result_15.surface_frame_n.x = light_3.normal.x;
    result_15.surface_frame_n.y = light_3.normal.y;
    result_15.surface_frame_n.z = light_3.normal.z;
    result_15.surface_radius = x8_9;
    result_15.surface_height = x27_7;
    EtendueDiskByArea _e136 = result_15;
    return _e136;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the surface of area A: pdf distance^2/(|cos(theta')|
// A) per steradian, theta' at the light.
EtendueLightSample etendue_disk_by_area_sample(EtendueDiskByArea prepared_11, vec2 u_6) {
    EtendueLightSample result_16 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_15 = (u_6.x * 2.0 + -1.0);
    float x2_16 = (u_6.y * 2.0 + -1.0);
    bool b3_5 = (abs(x2_16) < abs(x1_15));
    float x4_8 = (b3_5 ? x1_15 : x2_16);
    vec2 _e23 = etendue_sin_cos_quarters((((b3_5 ? x2_16 : x1_15) * 0.5) / ((0.0 < abs(x4_8)) ? x4_8 : 1.0)));
    float x6_14 = (x4_8 * (b3_5 ? _e23.y : _e23.x));
    float x7_13 = (x4_8 * (b3_5 ? _e23.x : _e23.y));
    float x8_10 = (prepared_11.surface_radius * x6_14);
    float x9_6 = (prepared_11.surface_radius * x7_13);
    float x10_9 = (prepared_11.surface_center.x + ((prepared_11.surface_frame_s.x * x8_10) + (prepared_11.surface_frame_t.x * x9_6)));
    float x11_11 = (prepared_11.surface_center.y + ((prepared_11.surface_frame_s.y * x8_10) + (prepared_11.surface_frame_t.y * x9_6)));
    float x12_10 = (prepared_11.surface_center.z + ((prepared_11.surface_frame_s.z * x8_10) + (prepared_11.surface_frame_t.z * x9_6)));
    float _e70 = etendue_greater((0.5 * x6_14 + 0.5), 0.0);
    float _e72 = etendue_lesser(_e70, 1.0);
    float _e77 = etendue_greater((0.5 * x7_13 + 0.5), 0.0);
    float _e79 = etendue_lesser(_e77, 1.0);
    float _e82 = etendue_greater(abs(x10_9), abs(x11_11));
    float _e84 = etendue_greater(_e82, abs(x12_10));
    float _e86 = etendue_from_bits(2139095040u);
    bool b16_ = (_e84 < _e86);
    float _e90 = etendue_pow2_scale((b16_ ? _e84 : 0.0));
    float x18_10 = (_e90 * (b16_ ? x10_9 : 0.0));
    float x19_7 = (_e90 * (b16_ ? x11_11 : 0.0));
    float x20_7 = (_e90 * (b16_ ? x12_10 : 0.0));
    float x21_8 = (x18_10 * x18_10 + (x19_7 * x19_7 + (x20_7 * x20_7)));
    float x22_9 = ((0.0 < x21_8) ? (1.0 / sqrt(x21_8)) : 0.0);
    float x23_7 = ((x21_8 * x22_9) / _e90);
    float x24_7 = (x18_10 * x22_9);
    float x25_9 = (x19_7 * x22_9);
    float x26_7 = (x20_7 * x22_9);
    float _e117 = etendue_from_bits(2139095040u);
    float x27_8 = ((x23_7 < _e117) ? x23_7 : 0.0);
    float x28_7 = (prepared_11.surface_frame_n.x * x24_7 + (prepared_11.surface_frame_n.y * x25_9 + (prepared_11.surface_frame_n.z * x26_7)));
    float x29_4 = abs(x28_7);
    bool b30_ = (1e-37 < x29_4);
    float _e139 = etendue_greater((b30_ ? (prepared_11.surface_height / (b30_ ? x28_7 : 1.0)) : 0.0), -1e37);
    float _e141 = etendue_lesser(_e139, 1e37);
    float _e143 = etendue_greater(_e141, 0.0);
    float x32_7 = (((prepared_11.surface_radius * prepared_11.surface_radius) * 3.1415927) * x29_4);
    bool b33_ = (0.0 < x32_7);
    float x34_7 = (_e143 * (_e143 / (b33_ ? x32_7 : 1.0)));
    float x35_6 = (((b33_ && (x34_7 < 1e37)) && (0.0 < _e143)) ? x34_7 : 0.0);
    bool b36_1 = (x28_7 < 0.0);
    bool b37_ = (b36_1 && (1e-37 < x35_6));
    float x38_7 = (b37_ ? (1.0 / (b37_ ? x35_6 : 1.0)) : 0.0);
    result_16.direction.x = x24_7;
    result_16.direction.y = x25_9;
    result_16.direction.z = x26_7;
    result_16.distance_ = x27_8;
    result_16.pdf = x35_6;
    result_16.weight = x38_7;
    result_16.normal.x = prepared_11.surface_frame_n.x;
    result_16.normal.y = prepared_11.surface_frame_n.y;
    result_16.normal.z = prepared_11.surface_frame_n.z;
    result_16.uv.x = _e72;
    result_16.uv.y = _e79;
    result_16.emits = b36_1;
    result_16.delta = false;
    EtendueLightSample _e204 = result_16;
    return _e204;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the surface of area
// A: pdf distance^2/(|cos(theta')| A) per steradian, theta' at the light.
float etendue_disk_by_area_pdf(EtendueDiskByArea prepared_12, vec3 w_6) {
    float x1_16 = (prepared_12.surface_frame_n.x * w_6.x + (prepared_12.surface_frame_n.y * w_6.y + (prepared_12.surface_frame_n.z * w_6.z)));
    float x2_17 = abs(x1_16);
    bool b3_6 = (1e-37 < x2_17);
    float _e24 = etendue_greater((b3_6 ? (prepared_12.surface_height / (b3_6 ? x1_16 : 1.0)) : 0.0), -1e37);
    float _e26 = etendue_lesser(_e24, 1e37);
    float _e28 = etendue_greater(_e26, 0.0);
    float x5_9 = (x2_17 * ((prepared_12.surface_radius * prepared_12.surface_radius) * 3.1415927));
    bool b6_1 = (0.0 < x5_9);
    float x7_14 = (_e28 * (_e28 / (b6_1 ? x5_9 : 1.0)));
    float _e47 = etendue_greater(abs(prepared_12.surface_center.x), abs(prepared_12.surface_center.y));
    float _e51 = etendue_greater(_e47, abs(prepared_12.surface_center.z));
    float _e54 = etendue_greater(_e51, abs(prepared_12.surface_radius));
    float _e55 = etendue_pow2_scale(_e54);
    float x10_10 = (prepared_12.surface_center.x * _e55);
    float x11_12 = (prepared_12.surface_center.y * _e55);
    float x12_11 = (prepared_12.surface_center.z * _e55);
    float x13_11 = (prepared_12.surface_height * _e55);
    float x14_11 = (prepared_12.surface_radius * _e55);
    float x15_10 = ((w_6.x * x13_11) - (x1_16 * x10_10));
    float x16_12 = ((w_6.y * x13_11) - (x1_16 * x11_12));
    float x17_7 = ((w_6.z * x13_11) - (x1_16 * x12_11));
    float x18_11 = (x2_17 * x14_11 + ((x14_11 + sqrt((x10_10 * x10_10 + (x11_12 * x11_12 + (x12_11 * x12_11))))) * 7.1525574e-7));
    bool b19_2 = ((sqrt((x15_10 * x15_10 + (x16_12 * x16_12 + (x17_7 * x17_7)))) <= x18_11) && (0.0 < (x1_16 * x13_11)));
    float x20_8 = ((b19_2 && (0.0 < x14_11)) ? (((b6_1 && (x7_14 < 1e37)) && (0.0 < _e28)) ? x7_14 : 0.0) : 0.0);
    return x20_8;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the surface of area A: pdf distance^2/(|cos(theta')| A) per steradian, theta' at the light.
EtendueLightSample etendue_disk_by_area_hit(EtendueDiskByArea prepared_13, vec3 w_7) {
    EtendueLightSample result_17 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_17 = (prepared_13.surface_frame_n.x * w_7.x + (prepared_13.surface_frame_n.y * w_7.y + (prepared_13.surface_frame_n.z * w_7.z)));
    float x2_18 = abs(x1_17);
    bool b3_7 = (1e-37 < x2_18);
    float _e24 = etendue_greater((b3_7 ? (prepared_13.surface_height / (b3_7 ? x1_17 : 1.0)) : 0.0), -1e37);
    float _e26 = etendue_lesser(_e24, 1e37);
    float _e28 = etendue_greater(_e26, 0.0);
    float x6_15 = (w_7.x * _e26 + -(prepared_13.surface_center.x));
    float x7_15 = (w_7.y * _e26 + -(prepared_13.surface_center.y));
    float x8_11 = (w_7.z * _e26 + -(prepared_13.surface_center.z));
    float x9_7 = abs(prepared_13.surface_radius);
    bool b10_3 = (1e-37 < x9_7);
    float x11_13 = (b10_3 ? prepared_13.surface_radius : 1.0);
    float _e64 = etendue_greater((b10_3 ? ((prepared_13.surface_frame_s.x * x6_15 + (prepared_13.surface_frame_s.y * x7_15 + (prepared_13.surface_frame_s.z * x8_11))) / x11_13) : 0.0), -1e37);
    float _e66 = etendue_lesser(_e64, 1e37);
    float _e80 = etendue_greater((b10_3 ? ((prepared_13.surface_frame_t.x * x6_15 + (prepared_13.surface_frame_t.y * x7_15 + (prepared_13.surface_frame_t.z * x8_11))) / x11_13) : 0.0), -1e37);
    float _e82 = etendue_lesser(_e80, 1e37);
    float _e84 = etendue_greater(_e66, -1000000000000000.0);
    float _e86 = etendue_lesser(_e84, 1000000000000000.0);
    float _e91 = etendue_greater((_e86 * 0.5 + 0.5), 0.0);
    float _e93 = etendue_lesser(_e91, 1.0);
    float _e95 = etendue_greater(_e82, -1000000000000000.0);
    float _e97 = etendue_lesser(_e95, 1000000000000000.0);
    float _e102 = etendue_greater((_e97 * 0.5 + 0.5), 0.0);
    float _e104 = etendue_lesser(_e102, 1.0);
    float x16_13 = (x2_18 * ((prepared_13.surface_radius * prepared_13.surface_radius) * 3.1415927));
    bool b17_4 = (0.0 < x16_13);
    float x18_12 = (_e28 * (_e28 / (b17_4 ? x16_13 : 1.0)));
    float _e123 = etendue_greater(abs(prepared_13.surface_center.x), abs(prepared_13.surface_center.y));
    float _e127 = etendue_greater(_e123, abs(prepared_13.surface_center.z));
    float _e128 = etendue_greater(_e127, x9_7);
    float _e129 = etendue_pow2_scale(_e128);
    float x20_9 = (prepared_13.surface_center.x * _e129);
    float x21_9 = (prepared_13.surface_center.y * _e129);
    float x22_10 = (prepared_13.surface_center.z * _e129);
    float x23_8 = (prepared_13.surface_height * _e129);
    float x24_8 = (prepared_13.surface_radius * _e129);
    float x25_10 = ((w_7.x * x23_8) - (x1_17 * x20_9));
    float x26_8 = ((w_7.y * x23_8) - (x1_17 * x21_9));
    float x27_9 = ((w_7.z * x23_8) - (x1_17 * x22_10));
    float x28_8 = (x2_18 * x24_8 + ((x24_8 + sqrt((x20_9 * x20_9 + (x21_9 * x21_9 + (x22_10 * x22_10))))) * 7.1525574e-7));
    bool b29_2 = ((sqrt((x25_10 * x25_10 + (x26_8 * x26_8 + (x27_9 * x27_9)))) <= x28_8) && (0.0 < (x1_17 * x23_8)));
    float x30_7 = ((b29_2 && (0.0 < x24_8)) ? (((b17_4 && (x18_12 < 1e37)) && (0.0 < _e28)) ? x18_12 : 0.0) : 0.0);
    bool b31_ = (0.0 < x30_7);
    float x32_8 = (b31_ ? _e28 : 0.0);
    bool b33_1 = (b31_ && (x1_17 < 0.0));
    bool b34_ = (b33_1 && (1e-37 < x30_7));
    float x35_7 = (b34_ ? (1.0 / (b34_ ? x30_7 : 1.0)) : 0.0);
    result_17.direction.x = w_7.x;
    result_17.direction.y = w_7.y;
    result_17.direction.z = w_7.z;
    result_17.distance_ = x32_8;
    result_17.pdf = x30_7;
    result_17.weight = x35_7;
    result_17.normal.x = prepared_13.surface_frame_n.x;
    result_17.normal.y = prepared_13.surface_frame_n.y;
    result_17.normal.z = prepared_13.surface_frame_n.z;
    result_17.uv.x = _e93;
    result_17.uv.y = _e104;
    result_17.emits = b33_1;
    result_17.delta = false;
    EtendueLightSample _e233 = result_17;
    return _e233;
}

// Prepares a light. Uniform over the cone: pdf 1/(2 pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
EtendueSunBySolidAngle etendue_sun_by_solid_angle_prepare(EtendueSun light_4) {
    EtendueSunBySolidAngle result_18 = EtendueSunBySolidAngle(vec3(0.0), vec3(0.0), vec3(0.0), 0.0);
    float _e4 = etendue_copysign(1.0, light_4.direction.z);
    float x2_19 = (-1.0 / (light_4.direction.z + _e4));
    float x3_15 = (x2_19 * (light_4.direction.x * light_4.direction.y));
    float x4_9 = (light_4.direction.x * _e4);
    float x5_10 = (light_4.direction.x * (x2_19 * x4_9) + 1.0);
    float x6_16 = (_e4 * x3_15);
    float x7_16 = -(x4_9);
    float x8_12 = (light_4.direction.y * (light_4.direction.y * x2_19) + _e4);
    float x9_8 = -(light_4.direction.y);
    result_18.frame_s.x = x5_10;
    result_18.frame_s.y = x6_16;
    result_18.frame_s.z = x7_16;
    result_18.frame_t.x = x3_15;
    result_18.frame_t.y = x8_12;
    result_18.frame_t.z = x9_8;
    result_18.frame_n.x = light_4.direction.x;
    result_18.frame_n.y = light_4.direction.y;
    result_18.frame_n.z = light_4.direction.z;
    result_18.cone_one_minus_cos = light_4.one_minus_cos;
    EtendueSunBySolidAngle _e62 = result_18;
    return _e62;
}

// Draws a direction to the light for u in [0, 1)^2. Uniform over the cone: pdf 1/(2 pi (1 - cos(sigma))) per
// steradian, 0 where the cone is empty.
EtendueLightSample etendue_sun_by_solid_angle_sample(EtendueSunBySolidAngle prepared_14, vec2 u_7) {
    EtendueLightSample result_19 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float _e4 = etendue_greater(prepared_14.cone_one_minus_cos, 0.0);
    float _e6 = etendue_lesser(_e4, 2.0);
    float x2_20 = (u_7.x * _e6);
    float _e17 = etendue_greater((x2_20 * (_e6 * (1.0 - u_7.x) + (2.0 - _e6))), 0.0);
    float x3_16 = sqrt(_e17);
    vec2 _e20 = etendue_sin_cos_turns(u_7.y);
    float x5_11 = (x3_16 * _e20.y);
    float x6_17 = (x3_16 * _e20.x);
    float x7_17 = (1.0 - x2_20);
    float x8_13 = (prepared_14.frame_s.x * x5_11 + (prepared_14.frame_t.x * x6_17 + (prepared_14.frame_n.x * x7_17)));
    float x9_9 = (prepared_14.frame_s.y * x5_11 + (prepared_14.frame_t.y * x6_17 + (prepared_14.frame_n.y * x7_17)));
    float x10_11 = (prepared_14.frame_s.z * x5_11 + (prepared_14.frame_t.z * x6_17 + (prepared_14.frame_n.z * x7_17)));
    bool b11_2 = (1e-37 < _e6);
    float x12_12 = (b11_2 ? (0.15915494 / (b11_2 ? _e6 : 1.0)) : 0.0);
    float x13_12 = -(x8_13);
    float x14_12 = -(x9_9);
    float x15_11 = -(x10_11);
    bool b16_1 = (1e-37 < x12_12);
    float x17_8 = (b16_1 ? (1.0 / (b16_1 ? x12_12 : 1.0)) : 0.0);
    result_19.direction.x = x8_13;
    result_19.direction.y = x9_9;
    result_19.direction.z = x10_11;
    result_19.distance_ = 3.4028235e38;
    result_19.pdf = x12_12;
    result_19.weight = x17_8;
    result_19.normal.x = x13_12;
    result_19.normal.y = x14_12;
    result_19.normal.z = x15_11;
    result_19.uv.x = u_7.x;
    result_19.uv.y = u_7.y;
    result_19.emits = true;
    result_19.delta = false;
    EtendueLightSample _e100 = result_19;
    return _e100;
}

// The density with which the unit direction w is drawn; 0 where it misses the light. Uniform over the cone: pdf 1/(2
// pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
float etendue_sun_by_solid_angle_pdf(EtendueSunBySolidAngle prepared_15, vec3 w_8) {
    float x1_18 = (prepared_15.frame_s.x * w_8.x + (prepared_15.frame_s.y * w_8.y + (prepared_15.frame_s.z * w_8.z)));
    float x2_21 = (prepared_15.frame_t.x * w_8.x + (prepared_15.frame_t.y * w_8.y + (prepared_15.frame_t.z * w_8.z)));
    float x3_17 = (prepared_15.frame_n.x * w_8.x + (prepared_15.frame_n.y * w_8.y + (prepared_15.frame_n.z * w_8.z)));
    float _e40 = etendue_greater(prepared_15.cone_one_minus_cos, 0.0);
    float _e42 = etendue_lesser(_e40, 2.0);
    bool b5_6 = (1e-37 < _e42);
    float x6_18 = ((0.5 < x3_17) ? ((x1_18 * x1_18 + (x2_21 * x2_21)) / (1.0 + abs(x3_17))) : (1.0 - x3_17));
    float _e63 = etendue_greater(sqrt((_e42 * (2.0 - _e42))), (_e42 - 1.0));
    float x7_18 = (_e42 + (5.9604645e-7 * _e63 + 1.7763568e-13));
    float x8_14 = ((x6_18 <= x7_18) ? (b5_6 ? (0.15915494 / (b5_6 ? _e42 : 1.0)) : 0.0) : 0.0);
    return x8_14;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the cone: pdf 1/(2 pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
EtendueLightSample etendue_sun_by_solid_angle_hit(EtendueSunBySolidAngle prepared_16, vec3 w_9) {
    EtendueLightSample result_20 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    float x1_19 = (prepared_16.frame_s.x * w_9.x + (prepared_16.frame_s.y * w_9.y + (prepared_16.frame_s.z * w_9.z)));
    float x2_22 = (prepared_16.frame_t.x * w_9.x + (prepared_16.frame_t.y * w_9.y + (prepared_16.frame_t.z * w_9.z)));
    float x3_18 = (prepared_16.frame_n.x * w_9.x + (prepared_16.frame_n.y * w_9.y + (prepared_16.frame_n.z * w_9.z)));
    float _e40 = etendue_greater(prepared_16.cone_one_minus_cos, 0.0);
    float _e42 = etendue_lesser(_e40, 2.0);
    bool b5_7 = (1e-37 < _e42);
    float x6_19 = ((0.5 < x3_18) ? ((x1_19 * x1_19 + (x2_22 * x2_22)) / (1.0 + abs(x3_18))) : (1.0 - x3_18));
    float _e63 = etendue_greater(sqrt((_e42 * (2.0 - _e42))), (_e42 - 1.0));
    float x7_19 = (_e42 + (5.9604645e-7 * _e63 + 1.7763568e-13));
    float x8_15 = ((x6_19 <= x7_19) ? (b5_7 ? (0.15915494 / (b5_7 ? _e42 : 1.0)) : 0.0) : 0.0);
    float _e82 = etendue_greater((x6_19 / ((0.0 < _e42) ? _e42 : 1.0)), 0.0);
    float _e84 = etendue_lesser(_e82, 0.99999994);
    float _e86 = etendue_angle(x2_22, x1_19);
    float x10_12 = (0.15915494 * _e86);
    float _e94 = etendue_greater(((x10_12 < 0.0) ? (1.0 + x10_12) : x10_12), 0.0);
    float _e96 = etendue_lesser(_e94, 0.99999994);
    bool b12_ = (0.0 < x8_15);
    float x13_13 = (b12_ ? 3.4028235e38 : 0.0);
    float x14_13 = -(w_9.x);
    float x15_12 = -(w_9.y);
    float x16_14 = -(w_9.z);
    bool b17_5 = (b12_ && (1e-37 < x8_15));
    float x18_13 = (b17_5 ? (1.0 / (b17_5 ? x8_15 : 1.0)) : 0.0);
    result_20.direction.x = w_9.x;
    result_20.direction.y = w_9.y;
    result_20.direction.z = w_9.z;
    result_20.distance_ = x13_13;
    result_20.pdf = x8_15;
    result_20.weight = x18_13;
    result_20.normal.x = x14_13;
    result_20.normal.y = x15_12;
    result_20.normal.z = x16_14;
    result_20.uv.x = _e84;
    result_20.uv.y = _e96;
    result_20.emits = b12_;
    result_20.delta = false;
    EtendueLightSample _e143 = result_20;
    return _e143;
}

// Prepares a light for the shading point p. Its one direction, whatever the random numbers. The pdf of a sample is
// distance^2, which is no density; that of a direction is 0.
EtenduePointLightByDelta etendue_point_light_by_delta_prepare(EtenduePointLight light_5, vec3 p_4) {
    EtenduePointLightByDelta result_21 = EtenduePointLightByDelta(vec3(0.0), 0.0, 0.0);
    float x1_20 = (light_5.position.x - p_4.x);
    float x2_23 = (light_5.position.y - p_4.y);
    float x3_19 = (light_5.position.z - p_4.z);
    float _e16 = etendue_greater(abs(x1_20), abs(x2_23));
    float _e18 = etendue_greater(_e16, abs(x3_19));
    float _e20 = etendue_from_bits(2139095040u);
    bool b5_8 = (_e18 < _e20);
    float _e24 = etendue_pow2_scale((b5_8 ? _e18 : 0.0));
    float x7_20 = (_e24 * (b5_8 ? x1_20 : 0.0));
    float x8_16 = (_e24 * (b5_8 ? x2_23 : 0.0));
    float x9_10 = (_e24 * (b5_8 ? x3_19 : 0.0));
    float x10_13 = (x7_20 * x7_20 + (x8_16 * x8_16 + (x9_10 * x9_10)));
    float x11_14 = ((0.0 < x10_13) ? (1.0 / sqrt(x10_13)) : 0.0);
    float x12_13 = ((x10_13 * x11_14) / _e24);
    float x13_14 = (x7_20 * x11_14);
    float x14_14 = (x8_16 * x11_14);
    float x15_13 = (x9_10 * x11_14);
    float _e51 = etendue_from_bits(2139095040u);
    float x16_15 = ((x12_13 < _e51) ? x12_13 : 0.0);
    float x17_9 = (x16_15 * x16_15);
    float x18_14 = ((x17_9 < 1e37) ? x17_9 : 0.0);
    result_21.direction.x = x13_14;
    result_21.direction.y = x14_14;
    result_21.direction.z = x15_13;
    result_21.distance_ = x16_15;
    result_21.pdf = x18_14;
    EtenduePointLightByDelta _e68 = result_21;
    return _e68;
}

// Draws a direction to the light for u in [0, 1)^2. Its one direction, whatever the random numbers. The pdf of a
// sample is distance^2, which is no density; that of a direction is 0.
EtendueLightSample etendue_point_light_by_delta_sample(EtenduePointLightByDelta prepared_17, vec2 u_8) {
    EtendueLightSample result_22 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    bool b1_6 = (0.0 < prepared_17.pdf);
    float x2_24 = -(prepared_17.direction.x);
    float x3_20 = -(prepared_17.direction.y);
    float x4_10 = -(prepared_17.direction.z);
    bool b5_9 = (b1_6 && (1e-37 < prepared_17.pdf));
    float x6_20 = (b5_9 ? (1.0 / (b5_9 ? prepared_17.pdf : 1.0)) : 0.0);
    result_22.direction.x = prepared_17.direction.x;
    result_22.direction.y = prepared_17.direction.y;
    result_22.direction.z = prepared_17.direction.z;
    result_22.distance_ = prepared_17.distance_;
    result_22.pdf = prepared_17.pdf;
    result_22.weight = x6_20;
    result_22.normal.x = x2_24;
    result_22.normal.y = x3_20;
    result_22.normal.z = x4_10;
    result_22.uv.x = 0.0;
    result_22.uv.y = 0.0;
    result_22.emits = b1_6;
    result_22.delta = true;
    EtendueLightSample _e58 = result_22;
    return _e58;
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
    float x1_21 = -(w_11.x);
    float x2_25 = -(w_11.y);
    float x3_21 = -(w_11.z);
    result_23.direction.x = w_11.x;
    result_23.direction.y = w_11.y;
    result_23.direction.z = w_11.z;
    result_23.distance_ = 0.0;
    result_23.pdf = 0.0;
    result_23.weight = 0.0;
    result_23.normal.x = x1_21;
    result_23.normal.y = x2_25;
    result_23.normal.z = x3_21;
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
    float x1_22 = (light_6.position.x - p_5.x);
    float x2_26 = (light_6.position.y - p_5.y);
    float x3_22 = (light_6.position.z - p_5.z);
    float _e16 = etendue_greater(abs(x1_22), abs(x2_26));
    float _e18 = etendue_greater(_e16, abs(x3_22));
    float _e20 = etendue_from_bits(2139095040u);
    bool b5_10 = (_e18 < _e20);
    float _e24 = etendue_pow2_scale((b5_10 ? _e18 : 0.0));
    float x7_21 = (_e24 * (b5_10 ? x1_22 : 0.0));
    float x8_17 = (_e24 * (b5_10 ? x2_26 : 0.0));
    float x9_11 = (_e24 * (b5_10 ? x3_22 : 0.0));
    float x10_14 = (x7_21 * x7_21 + (x8_17 * x8_17 + (x9_11 * x9_11)));
    float x11_15 = ((0.0 < x10_14) ? (1.0 / sqrt(x10_14)) : 0.0);
    float x12_14 = ((x10_14 * x11_15) / _e24);
    float x13_15 = (x7_21 * x11_15);
    float x14_15 = (x8_17 * x11_15);
    float x15_14 = (x9_11 * x11_15);
    float _e51 = etendue_from_bits(2139095040u);
    float x16_16 = ((x12_14 < _e51) ? x12_14 : 0.0);
    float x17_10 = (light_6.axis.x * -(x13_15) + (light_6.axis.y * -(x14_15) + (light_6.axis.z * -(x15_14))));
    float x18_15 = (light_6.cos_inner - light_6.cos_outer);
    bool b19_3 = (0.0 < x18_15);
    float _e77 = etendue_greater(((x17_10 - light_6.cos_outer) / (b19_3 ? x18_15 : 1.0)), 0.0);
    float _e79 = etendue_lesser(_e77, 1.0);
    float x21_10 = (b19_3 ? ((_e79 * _e79) * (3.0 - (_e79 + _e79))) : ((light_6.cos_inner <= x17_10) ? 1.0 : 0.0));
    bool b22_ = (0.0 < x21_10);
    float x23_9 = (x16_16 * x16_16);
    float x24_9 = (((x23_9 < 1e37) ? x23_9 : 0.0) / (b22_ ? x21_10 : 1.0));
    float x25_11 = ((b22_ && (x24_9 < 1e37)) ? x24_9 : 0.0);
    result_24.direction.x = x13_15;
    result_24.direction.y = x14_15;
    result_24.direction.z = x15_14;
    result_24.distance_ = x16_16;
    result_24.pdf = x25_11;
    EtendueSpotLightByDelta _e115 = result_24;
    return _e115;
}

// Draws a direction to the light for u in [0, 1)^2. Its one direction, whatever the random numbers. The pdf of a
// sample is distance^2 over the part of I that is emitted there, which is no density, and 0 outside of the cone; that
// of a direction is 0.
EtendueLightSample etendue_spot_light_by_delta_sample(EtendueSpotLightByDelta prepared_20, vec2 u_9) {
    EtendueLightSample result_25 = EtendueLightSample(vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false);
    bool b1_7 = (0.0 < prepared_20.pdf);
    float x2_27 = -(prepared_20.direction.x);
    float x3_23 = -(prepared_20.direction.y);
    float x4_11 = -(prepared_20.direction.z);
    bool b5_11 = (b1_7 && (1e-37 < prepared_20.pdf));
    float x6_21 = (b5_11 ? (1.0 / (b5_11 ? prepared_20.pdf : 1.0)) : 0.0);
    result_25.direction.x = prepared_20.direction.x;
    result_25.direction.y = prepared_20.direction.y;
    result_25.direction.z = prepared_20.direction.z;
    result_25.distance_ = prepared_20.distance_;
    result_25.pdf = prepared_20.pdf;
    result_25.weight = x6_21;
    result_25.normal.x = x2_27;
    result_25.normal.y = x3_23;
    result_25.normal.z = x4_11;
    result_25.uv.x = 0.0;
    result_25.uv.y = 0.0;
    result_25.emits = b1_7;
    result_25.delta = true;
    EtendueLightSample _e58 = result_25;
    return _e58;
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
    float x1_23 = -(w_13.x);
    float x2_28 = -(w_13.y);
    float x3_24 = -(w_13.z);
    result_26.direction.x = w_13.x;
    result_26.direction.y = w_13.y;
    result_26.direction.z = w_13.z;
    result_26.distance_ = 0.0;
    result_26.pdf = 0.0;
    result_26.weight = 0.0;
    result_26.normal.x = x1_23;
    result_26.normal.y = x2_28;
    result_26.normal.z = x3_24;
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
    float x1_24 = -(prepared_23.direction.x);
    float x2_29 = -(prepared_23.direction.y);
    float x3_25 = -(prepared_23.direction.z);
    result_28.direction.x = prepared_23.direction.x;
    result_28.direction.y = prepared_23.direction.y;
    result_28.direction.z = prepared_23.direction.z;
    result_28.distance_ = 3.4028235e38;
    result_28.pdf = 1.0;
    result_28.weight = 1.0;
    result_28.normal.x = x1_24;
    result_28.normal.y = x2_29;
    result_28.normal.z = x3_25;
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
    float x1_25 = -(w_15.x);
    float x2_30 = -(w_15.y);
    float x3_26 = -(w_15.z);
    result_29.direction.x = w_15.x;
    result_29.direction.y = w_15.y;
    result_29.direction.z = w_15.z;
    result_29.distance_ = 0.0;
    result_29.pdf = 0.0;
    result_29.weight = 0.0;
    result_29.normal.x = x1_25;
    result_29.normal.y = x2_30;
    result_29.normal.z = x3_26;
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
    float x16_17 = (b14_1 ? _e59 : _e56);
    result_30.x = x15_15;
    result_30.y = x16_17;
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
    float x1_26 = (delta ? _e9 : _e7);
    return x1_26;
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
    float x5_12 = (b4_6 ? _e8 : 1.0);
    float x6_22 = ((b4_6 && (0.0 < _e3)) ? ((_e8 <= _e3) ? 1.0 : (_e3 / x5_12)) : 0.0);
    float x7_22 = ((b4_6 && (0.0 < _e5)) ? ((_e8 <= _e5) ? 1.0 : (_e5 / x5_12)) : 0.0);
    float x8_18 = (b4_6 ? (x7_22 + (0.0 + x6_22)) : 1.0);
    float x9_12 = (x6_22 / x8_18);
    float x10_15 = (x7_22 / x8_18);
    result_32.x = x9_12;
    result_32.y = x10_15;
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
    float x5_13 = (b4_7 ? _e8 : 1.0);
    float x6_23 = ((b4_7 && (0.0 < _e3)) ? ((_e8 <= _e3) ? 1.0 : (_e3 / x5_13)) : 0.0);
    float x7_23 = (x6_23 * x6_23);
    float x8_19 = ((b4_7 && (0.0 < _e5)) ? ((_e8 <= _e5) ? 1.0 : (_e5 / x5_13)) : 0.0);
    float x9_13 = (x8_19 * x8_19);
    float x10_16 = (b4_7 ? (x9_13 + (0.0 + x7_23)) : 1.0);
    float x11_16 = (x7_23 / x10_16);
    float x12_15 = (x9_13 / x10_16);
    result_33.x = x11_16;
    result_33.y = x12_15;
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
    float x5_14 = (b4_8 ? _e17 : 1.0);
    float x6_24 = ((b4_8 && (0.0 < _e12)) ? ((_e17 <= _e12) ? 1.0 : (_e12 / x5_14)) : 0.0);
    float x7_24 = (x6_24 * x6_24);
    float x8_20 = ((b4_8 && (0.0 < _e14)) ? ((_e17 <= _e14) ? 1.0 : (_e14 / x5_14)) : 0.0);
    bool b9_2 = (emits && (1e-37 < pdf_1));
    float x10_17 = ((x7_24 / (b4_8 ? ((x8_20 * x8_20) + (0.0 + x7_24)) : 1.0)) * (b9_2 ? (1.0 / (b9_2 ? pdf_1 : 1.0)) : 0.0));
    return x10_17;
}

// The weight, over its density, of a direction that the surface drew with the density bsdf_pdf, where it hits a light
// with these fields: by the power heuristic, one sample each. 0 where the light is missed.
float etendue_power_bsdf_weight(float bsdf_pdf_1, float pdf_2, bool emits_1) {
    bool b1_8 = ((emits_1 && (1e-37 < bsdf_pdf_1)) && (0.0 < pdf_2));
    float _e10 = etendue_greater(bsdf_pdf_1, 0.0);
    float _e12 = etendue_greater(pdf_2, 0.0);
    float _e14 = etendue_greater(0.0, _e10);
    float _e15 = etendue_greater(_e14, _e12);
    bool b5_12 = (0.0 < _e15);
    float x6_25 = (b5_12 ? _e15 : 1.0);
    float x7_25 = ((b5_12 && (0.0 < _e10)) ? ((_e15 <= _e10) ? 1.0 : (_e10 / x6_25)) : 0.0);
    float x8_21 = (x7_25 * x7_25);
    float x9_14 = ((b5_12 && (0.0 < _e12)) ? ((_e15 <= _e12) ? 1.0 : (_e12 / x6_25)) : 0.0);
    float _e48 = etendue_from_bits(2139095040u);
    float x10_18 = ((x8_21 / (b5_12 ? ((x9_14 * x9_14) + (0.0 + x8_21)) : 1.0)) / ((b1_8 && !((_e48 <= bsdf_pdf_1))) ? bsdf_pdf_1 : 1.0));
    float x11_17 = (b1_8 ? x10_18 : 0.0);
    return x11_17;
}
