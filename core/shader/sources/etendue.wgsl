// Light sampling for renderers, in WGSL. MIT or Apache-2.0.
// Written by `etendue-shader --language wgsl --lights sphere_by_solid_angle,triangle_by_solid_angle,rectangle_by_solid_angle,disk_by_area,sun,point_light,spot_light,directional_light --warps concentric_disk,cosine_hemisphere,ggx_visible_normals --tools all --functions sample,pdf,hit`.
//
// WGSL promises neither that `fma` rounds once, nor correctly rounded division and square roots, nor subnormal numbers, infinities and
// NaN. Where a device has all these, the functions return the bits of the Rust library `etendue`. Elsewhere results differ: mostly in their last
// digits, but hostile input can return NaN, or a pdf where there is none. `--exact` writes the first three out.

fn etendue_from_bits(bits: u32) -> f32 {
    return bitcast<f32>(bits);
}
// b where either is NaN.
fn etendue_lesser(a: f32, b: f32) -> f32 {
    return select(b, a, a < b);
}
// b where either is NaN.
fn etendue_greater(a: f32, b: f32) -> f32 {
    return select(b, a, a > b);
}
// The magnitude of x with the sign of another number; a NaN counts as positive.
fn etendue_copysign(x: f32, sign: f32) -> f32 {
    let magnitude = bitcast<u32>(x) & 0x7fffffffu;
    return bitcast<f32>(magnitude | select(0u, bitcast<u32>(sign) & 0x80000000u, sign == sign));
}
// The power of two that scales a normal number to [1, 2); of 0 and subnormal numbers 2^127.
fn etendue_pow2_scale(x: f32) -> f32 {
    return etendue_greater(bitcast<f32>(0x7f000000u - (bitcast<u32>(x) & 0x7f800000u)), 5.877471754111438e-39f);
}
// An unsigned number of less than 2^31 as the nearest number.
fn etendue_from_word(k: u32) -> f32 {
    return f32(i32(k));
}
// The integer part of a number in [0, 2^24].
fn etendue_to_word(x: f32) -> u32 {
    return u32(i32(x));
}
// x^(-1/3) of a positive normal number within 3.5 %.
fn etendue_inverse_cbrt_estimate(x: f32) -> f32 {
    return bitcast<f32>(etendue_to_word(1419916083.0f - etendue_from_word(bitcast<u32>(x)) * 0.33333334f));
}
// A number in [0, 1 - 2^-24] from the 24 high bits.
fn etendue_unit(k: u32) -> f32 {
    return f32(k >> 8u) * 5.9604645e-8f;
}
// All ones where a < b, else 0.
fn etendue_word_less(a: u32, b: u32) -> u32 {
    return select(0u, 0xffffffffu, a < b);
}
// The quotient, rounded down; 0 where the divisor is.
fn etendue_word_quotient(a: u32, b: u32) -> u32 {
    return select(a / b, 0u, b == 0u);
}

// Visible normals of a GGX microsurface, per steradian.
struct EtendueGgxVisibleNormals {
    alpha: vec2<f32>,
    inverse_alpha: vec2<f32>,
    view: vec3<f32>,
    stretched_x: f32,
    stretched_y: f32,
    height: f32,
    scale: f32,
}

// A sample of a light as seen from a shading point, or the point of a light that a ray hits.
struct EtendueLightSample {
    // Unit direction from the shading point to the light.
    direction: vec3<f32>,
    // Distance along it, in the unit of the coordinates; 3.4e38 for lights at infinity.
    distance: f32,
    // Density of the direction, per steradian unless the technique says otherwise; 0 where there is no sample.
    pdf: f32,
    // 1/pdf where there is a sample that emits this way, else 0: what an estimator multiplies by.
    weight: f32,
    // Unit normal of the light at the point.
    normal: vec3<f32>,
    // Surface coordinates of the point, in [0, 1].
    uv: vec2<f32>,
    // True on the side of the light that emits.
    emits: bool,
    // True where no other technique can hit the light.
    delta: bool,
}

// A sphere prepared for a shading point. Uniform over the solid angle Omega at the point p: pdf 1/Omega per steradian.
// From inside, every direction.
struct EtendueSphereBySolidAngle {
    surface_center: vec3<f32>,
    surface_radius: f32,
    shape_frame_s: vec3<f32>,
    shape_frame_t: vec3<f32>,
    shape_frame_n: vec3<f32>,
    shape_cone_one_minus_cos: f32,
    shape_distance: f32,
    shape_power: f32,
    shape_unit: f32,
}

// A sphere that emits outwards. A radius <= 0 gives pdf 0; from inside, every direction hits it and it does not emit.
struct EtendueSphere {
    // Centre, in the coordinates of the scene.
    center: vec3<f32>,
    // Radius, in the unit of the coordinates.
    radius: f32,
}

// A triangle prepared for a shading point. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
struct EtendueTriangleBySolidAngle {
    surface_plane_cross: vec3<f32>,
    surface_plane_normal: vec3<f32>,
    surface_plane_height: f32,
    surface_plane_along_first: vec3<f32>,
    surface_plane_along_second: vec3<f32>,
    surface_plane_unit: f32,
    shape_side01: vec3<f32>,
    shape_side12: vec3<f32>,
    shape_side20: vec3<f32>,
    shape_slack: vec3<f32>,
    shape_normal: vec3<f32>,
    shape_l1: f32,
    shape_farthest: f32,
    shape_apex: vec3<f32>,
    shape_along: vec3<f32>,
    shape_across: vec3<f32>,
    shape_cot_alpha: f32,
    shape_stretch: f32,
    shape_tan_half: f32,
    shape_half: vec2<f32>,
    shape_turned: vec2<f32>,
    shape_sin_side: f32,
    shape_inv_l0: f32,
    shape_inv_l2: f32,
    shape_cot_half: f32,
    shape_inv_half_sin: f32,
    shape_g2: f32,
    shape_g2_over_g0: f32,
    shape_one_plus_d02: f32,
    shape_sin02_squared: f32,
    shape_x2: f32,
    shape_y2: f32,
    shape_g1: f32,
    shape_volume: f32,
    shape_solid_angle: f32,
    shape_unit: f32,
}

// A triangle that emits from the side on which its vertices run counterclockwise. Without area, and from a point in
// its plane, the pdf is 0. uv: the barycentric coordinates of the second and the third vertex.
struct EtendueTriangle {
    // First vertex, in the coordinates of the scene.
    v0: vec3<f32>,
    // Second vertex, as the edge from the first one.
    e1: vec3<f32>,
    // Third vertex, as the edge from the first one.
    e2: vec3<f32>,
}

// A rectangle prepared for a shading point. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian.
struct EtendueRectangleBySolidAngle {
    surface_plane_cross: vec3<f32>,
    surface_plane_normal: vec3<f32>,
    surface_plane_height: f32,
    surface_plane_along_first: vec3<f32>,
    surface_plane_along_second: vec3<f32>,
    surface_plane_unit: f32,
    shape_base: vec3<f32>,
    shape_side_x: vec3<f32>,
    shape_side_y: vec3<f32>,
    shape_near_x: vec3<f32>,
    shape_far_x: vec3<f32>,
    shape_near_y: vec3<f32>,
    shape_far_y: vec3<f32>,
    shape_slack: vec2<f32>,
    shape_slack_far: vec2<f32>,
    shape_normal: vec3<f32>,
    shape_near: vec2<f32>,
    shape_far: vec2<f32>,
    shape_size: vec2<f32>,
    shape_height: f32,
    shape_anchor: vec2<f32>,
    shape_flip: vec2<f32>,
    shape_sin_w1: f32,
    shape_cos_w1: f32,
    shape_inv_sin_w1: f32,
    shape_above_p: f32,
    shape_above_s: f32,
    shape_near_sin: f32,
    shape_near_cos: f32,
    shape_near_above_p: f32,
    shape_near_above_s: f32,
    shape_half: f32,
    shape_solid_angle: f32,
    shape_side: f32,
    shape_unit: f32,
}

// A rectangle, of a corner and two perpendicular edges from there, that emits from the side of the first edge x the
// second one. Its strata follow the edges. Without area, and from a point in its plane, the pdf is 0. uv: (s, t), the
// parts of the edges, in [0, 1].
struct EtendueRectangle {
    // Corner, in the coordinates of the scene.
    corner: vec3<f32>,
    // Edge along s.
    edge_s: vec3<f32>,
    // Edge along t, perpendicular to the other one.
    edge_t: vec3<f32>,
}

// A disk prepared for a shading point. Uniform over the surface of area A: pdf distance^2/(|cos(theta')| A) per
// steradian, theta' at the light.
struct EtendueDiskByArea {
    surface_center: vec3<f32>,
    surface_frame_s: vec3<f32>,
    surface_frame_t: vec3<f32>,
    surface_frame_n: vec3<f32>,
    surface_radius: f32,
    surface_height: f32,
}

// A disk that emits from the side of its normal. A radius <= 0, and a point in its plane, give pdf 0. uv: (1 + q)/2
// for the position q on the unit disk.
struct EtendueDisk {
    // Centre, in the coordinates of the scene.
    center: vec3<f32>,
    // Unit normal.
    normal: vec3<f32>,
    // Radius, in the unit of the coordinates.
    radius: f32,
}

// A sun prepared for a shading point. Uniform over the cone: pdf 1/(2 pi (1 - cos(sigma))) per steradian, 0 where the
// cone is empty.
struct EtendueSunBySolidAngle {
    frame_s: vec3<f32>,
    frame_t: vec3<f32>,
    frame_n: vec3<f32>,
    cone_one_minus_cos: f32,
}

// A sun: the same radiance from all directions within an angle sigma of one direction, at every point. The distance is
// the largest number of single precision.
struct EtendueSun {
    // Unit vector towards the centre of the sun.
    direction: vec3<f32>,
    // 1 - cos(sigma), in [0, 2]: 1.09e-5 for the sun from the earth.
    one_minus_cos: f32,
}

// A point light prepared for a shading point. Its one direction, whatever the random numbers. The pdf of a sample is
// distance^2, which is no density; that of a direction is 0.
struct EtenduePointLightByDelta {
    direction: vec3<f32>,
    distance: f32,
    pdf: f32,
}

// A point light, that emits the same intensity I in all directions. The estimator is f * I * cos(theta) * weight. No
// direction hits it: its weight in multiple importance sampling is 1.
struct EtenduePointLight {
    // Position, in the coordinates of the scene.
    position: vec3<f32>,
}

// A spot light prepared for a shading point. Its one direction, whatever the random numbers. The pdf of a sample is
// distance^2 over the part of I that is emitted there, which is no density, and 0 outside of the cone; that of a
// direction is 0.
struct EtendueSpotLightByDelta {
    direction: vec3<f32>,
    distance: f32,
    pdf: f32,
}

// A spot light: a point light that emits into a cone, with the intensity I on its axis. The estimator is f * I *
// cos(theta) * weight. No direction hits it: its weight in multiple importance sampling is 1.
struct EtendueSpotLight {
    // Position, in the coordinates of the scene.
    position: vec3<f32>,
    // Unit vector along which the light travels.
    axis: vec3<f32>,
    // Cosine of the angle to the axis up to which the intensity is I.
    cos_inner: f32,
    // Cosine of the angle from which it is 0; less than the other one.
    cos_outer: f32,
}

// A directional light prepared for a shading point. Its one direction, whatever the random numbers. The pdf of a
// sample is 1, which is no density; that of a direction is 0.
struct EtendueDirectionalLightByDelta {
    direction: vec3<f32>,
}

// A directional light, that reaches every point from one direction with the irradiance E on a surface that faces it.
// The estimator is f * E * cos(theta) * weight. No direction hits it: its weight in multiple importance sampling is 1.
struct EtendueDirectionalLight {
    // Unit vector towards the light.
    direction: vec3<f32>,
}

// (sin 2 pix, cos 2 pix) within 8.5e-8, for |x| < 2^126.
fn etendue_sin_cos_turns(x: f32) -> vec2<f32> {
    let x1 = x * 4.0f;
    let x2 = round(x1);
    let x3 = x1 - x2;
    let x4 = x3 * x3;
    let x5 = x3 * fma(x4, fma(x4, fma(x4, -0.004601658f, 0.07968003f), -0.6459635f), 1.5707964f);
    let x6 = fma(x4, fma(x4, fma(x4, fma(x4, 0.0009040217f, -0.020860288f), 0.25366923f), -1.2337005f), 1.0f);
    let x7 = x2 - 4.0f * round(x2 * 0.25f);
    let x8 = abs(x7);
    let b9 = abs(x8 - 1.0f) < 0.5f;
    let b10 = 1.5f < x8;
    let x11 = select(x5, x6, b9);
    let x12 = select(x11, -x11, b10 | (x7 < -0.5f));
    let x13 = select(x6, x5, b9);
    let x14 = select(x13, -x13, b10 | (0.5f < x7));
    var result: vec2<f32>;
    result.x = x12;
    result.y = x14;
    return result;
}

// (sin pix/2, cos pix/2) within 8.5e-8, for x in [-0.5, 0.5].
fn etendue_sin_cos_quarters(x: f32) -> vec2<f32> {
    let x1 = x * x;
    let x2 = x * fma(x1, fma(x1, fma(x1, -0.004601658f, 0.07968003f), -0.6459635f), 1.5707964f);
    let x3 = fma(x1, fma(x1, fma(x1, fma(x1, 0.0009040217f, -0.020860288f), 0.25366923f), -1.2337005f), 1.0f);
    var result: vec2<f32>;
    result.x = x2;
    result.y = x3;
    return result;
}

// Angle of (x, y) in radians, in [-pi, pi], within 2.1e-7 of itself; 0 at the origin.
fn etendue_angle(y: f32, x: f32) -> f32 {
    let x1 = abs(y);
    let x2 = abs(x);
    let x3 = etendue_lesser(x1, x2);
    let x4 = etendue_greater(x2, x1);
    let b5 = x4 * 0.41421357f < x3;
    let x6 = select(x4, x3 + x4, b5);
    let x7 = select(x3, x3 - x4, b5) / select(1.0f, x6, 0.0f < x6);
    let x8 = x7 * x7;
    let x9 = fma(x7, x8 * fma(x8, fma(x8, fma(x8, 0.0806032f, -0.13879853f), 0.19977927f), -0.33332956f), x7) + select(0.0f, 0.7853982f, b5);
    let x10 = select(x9, 1.5707964f - x9, x2 < x1);
    let x11 = select(x10, 3.1415927f - x10, (etendue_copysign(1.0f, x) < 0.0f) & !(x4 <= 0.0f));
    let x12 = etendue_copysign(x11, y);
    return x12;
}

// Maps u, of which each number is in [0, 1), to a point. Points of the unit disk, uniform in area (pdf 1/pi), by
// concentric squares: keeps strata compact. Greatest error: 1.5e-7 in the point (proved for all u: 2.2e-7); 2e-7 in
// invert(sample(u)).
fn etendue_concentric_disk_sample(u: vec2<f32>) -> vec2<f32> {
    let x1 = fma(u.x, 2.0f, -1.0f);
    let x2 = fma(u.y, 2.0f, -1.0f);
    let b3 = abs(x2) < abs(x1);
    let x4 = select(x2, x1, b3);
    let v5 = etendue_sin_cos_quarters(select(x1, x2, b3) * 0.5f / select(1.0f, x4, 0.0f < abs(x4)));
    let x6 = x4 * select(v5.x, v5.y, b3);
    let x7 = x4 * select(v5.y, v5.x, b3);
    var result: vec2<f32>;
    result.x = x6;
    result.y = x7;
    return result;
}

// The density of a point; 0 outside of the range. Points of the unit disk, uniform in area (pdf 1/pi), by concentric
// squares: keeps strata compact. Greatest error: 1.5e-7 in the point (proved for all u: 2.2e-7); 2e-7 in
// invert(sample(u)).
fn etendue_concentric_disk_pdf(point: vec2<f32>) -> f32 {
    let x1 = select(0.0f, 0.31830987f, fma(point.x, point.x, point.y * point.y) <= 1.0000004f);
    return x1;
}

// Maps u, of which each number is in [0, 1), to a point. Directions with z >= 0 and the pdf z/pi per steradian.
// Greatest error: 1.5e-7 in the direction (proved for all u: 2.4e-7), 2e-7 relative in z (proved off the horizon, for
// the pdf: 2.7e-7).
fn etendue_cosine_hemisphere_sample(u: vec2<f32>) -> vec3<f32> {
    let x1 = fma(u.x, 2.0f, -1.0f);
    let x2 = fma(u.y, 2.0f, -1.0f);
    let b3 = abs(x2) < abs(x1);
    let x4 = select(x2, x1, b3);
    let v5 = etendue_sin_cos_quarters(select(x1, x2, b3) * 0.5f / select(1.0f, x4, 0.0f < abs(x4)));
    let x6 = etendue_lesser(etendue_lesser(u.x, 1.0f - u.x), etendue_lesser(u.y, 1.0f - u.y));
    let x7 = x6 + x6;
    let x8 = sqrt(etendue_greater(x7 * (2.0f - x7), 0.0f));
    let x9 = x4 * select(v5.x, v5.y, b3);
    let x10 = x4 * select(v5.y, v5.x, b3);
    var result: vec3<f32>;
    result.x = x9;
    result.y = x10;
    result.z = x8;
    return result;
}

// The density of a point; 0 outside of the range. Directions with z >= 0 and the pdf z/pi per steradian. Greatest
// error: 1.5e-7 in the direction (proved for all u: 2.4e-7), 2e-7 relative in z (proved off the horizon, for the pdf:
// 2.7e-7).
fn etendue_cosine_hemisphere_pdf(point: vec3<f32>) -> f32 {
    let x1 = etendue_greater(point.z, 0.0f) * 0.31830987f;
    return x1;
}

// Prepares the map. Visible normals of a GGX microsurface, per steradian.
fn etendue_ggx_visible_normals_prepare(alpha_x: f32, alpha_y: f32, wi: vec3<f32>) -> EtendueGgxVisibleNormals {
    let x1 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(wi.x), abs(wi.y)), abs(wi.z)));
    let x2 = wi.x * x1;
    let x3 = wi.y * x1;
    let x4 = wi.z * x1;
    let x5 = fma(x2, x2, fma(x3, x3, x4 * x4));
    let x6 = select(0.0f, 1.0f / sqrt(x5), 0.0f < x5);
    let x7 = x2 * x6;
    let x8 = x3 * x6;
    let x9 = x4 * x6;
    let b10 = (1e-15f < alpha_x) & (1e-15f < alpha_y) & (alpha_x < 1000000000000000.0f) & (alpha_y < 1000000000000000.0f);
    let x11 = select(1.0f, alpha_x, b10);
    let x12 = select(1.0f, alpha_y, b10);
    let x13 = 1.0f / x11;
    let x14 = 1.0f / x12;
    let x15 = x7 * x11;
    let x16 = x8 * x12;
    let x17 = fma(x15, x15, x16 * x16);
    let x18 = sqrt(fma(x9, x9, x17));
    let b19 = 0.0f < x18;
    let x20 = 1.0f / select(1.0f, x18, b19);
    let x21 = x15 * x20;
    let x22 = x16 * x20;
    let x23 = select(x9 + x18, x17 / etendue_greater(x18 + abs(x9), 1e-37f), x9 < 0.0f);
    let b24 = b10 & b19 & (1e-33f < x23);
    let x25 = x20 * x23;
    let x26 = etendue_lesser(select(0.0f, 2.0f / (x12 * (x11 * 3.1415927f) * select(1.0f, x23, b24)), b24), 3.4028235e38f);
    var result: EtendueGgxVisibleNormals;
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
fn etendue_ggx_visible_normals_sample(prepared: EtendueGgxVisibleNormals, u: vec2<f32>) -> vec3<f32> {
    let x1 = etendue_lesser(etendue_greater(prepared.height, 0.0f), 2.0f);
    let x2 = 1.0f - u.x;
    let x3 = sqrt(etendue_greater(u.x * x1 * fma(x1, x2, 2.0f - x1), 0.0f));
    let v4 = etendue_sin_cos_turns(u.y);
    let x5 = prepared.alpha.x * (prepared.stretched_x + x3 * v4.y);
    let x6 = prepared.alpha.y * (prepared.stretched_y + x3 * v4.x);
    let x7 = etendue_greater(prepared.height * x2, 0.0f);
    let x8 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x5), abs(x6)), abs(x7)));
    let x9 = x5 * x8;
    let x10 = x6 * x8;
    let x11 = x7 * x8;
    let x12 = fma(x9, x9, fma(x10, x10, x11 * x11));
    let x13 = select(0.0f, 1.0f / sqrt(x12), 0.0f < x12);
    let x14 = x9 * x13;
    let x15 = x10 * x13;
    let x16 = x11 * x13;
    let b17 = 0.5f < fma(x14, x14, fma(x15, x15, x16 * x16));
    let x18 = select(0.0f, x14, b17);
    let x19 = select(0.0f, x15, b17);
    let x20 = select(1.0f, x16, b17);
    var result: vec3<f32>;
    result.x = x18;
    result.y = x19;
    result.z = x20;
    return result;
}

// The density of a point; 0 outside of the range. Visible normals of a GGX microsurface, per steradian. Greatest
// error, in units of 2^-24: 8 in the stretched normal, 8 in the pdf relative to its value and to D_v/(wi*m), and 24/(1
// + w.z) + 16/|c + w| in invert(sample(u)). The last is largest where a grazing view sees normals that turn away from
// it, c -> -w, which have almost no probability; rounding may make such a normal face away, with pdf 0.
fn etendue_ggx_visible_normals_pdf(prepared: EtendueGgxVisibleNormals, point: vec3<f32>) -> f32 {
    let x1 = prepared.inverse_alpha.x * point.x;
    let x2 = prepared.inverse_alpha.y * point.y;
    let x3 = fma(x1, x1, fma(x2, x2, point.z * point.z));
    let b4 = (0.0f <= point.z) & (0.0f < x3);
    let x5 = 1.0f / select(1.0f, x3, b4);
    let x6 = select(0.0f, etendue_lesser(x5 * (prepared.scale * x5), 3.4028235e38f), b4) * etendue_greater(fma(prepared.view.x, point.x, fma(prepared.view.y, point.y, prepared.view.z * point.z)), 0.0f);
    let x7 = etendue_lesser(x6, 3.4028235e38f);
    return x7;
}

// Prepares a light for the shading point p. Uniform over the solid angle Omega at the point p: pdf 1/Omega per
// steradian. From inside, every direction.
fn etendue_sphere_by_solid_angle_prepare(light: EtendueSphere, p: vec3<f32>) -> EtendueSphereBySolidAngle {
    let x1 = light.center.x - p.x;
    let x2 = light.center.y - p.y;
    let x3 = light.center.z - p.z;
    let b4 = etendue_greater(etendue_greater(abs(x1), abs(x2)), abs(x3)) < etendue_from_bits(0x7f800000u);
    let x5 = select(0.0f, x1, b4);
    let x6 = select(0.0f, x2, b4);
    let x7 = select(0.0f, x3, b4);
    let x8 = select(0.0f, light.radius, b4);
    let x9 = etendue_greater(etendue_greater(abs(x5), abs(x6)), abs(x7));
    let x10 = etendue_pow2_scale(etendue_greater(x9, abs(x8)));
    let x11 = x5 * x10;
    let x12 = x6 * x10;
    let x13 = x7 * x10;
    let x14 = x8 * x10;
    let x15 = x11 * x11;
    let x16 = x12 * x12;
    let x17 = x13 * x13;
    let x18 = x14 * x14;
    let x19 = x15 - x18;
    let x20 = x19 - x15;
    let x21 = x16 + x19;
    let x22 = x21 - x19;
    let x23 = x17 + x21;
    let x24 = x23 - x21;
    let x25 = x15 - (x19 - x20) + (-x18 - x20) + (x19 - (x21 - x22) + (x16 - x22));
    let x26 = fma(x11, x11, -x15) - fma(x14, x14, -x18) + (fma(x12, x12, -x16) + fma(x13, x13, -x17));
    let x27 = x23 + (x21 - (x23 - x24) + (x17 - x24) + x25 + x26);
    let x28 = fma(x11, x11, fma(x12, x12, x17));
    let b29 = 0.0f < x28;
    let x30 = 1.0f / select(1.0f, x28, b29);
    let x31 = etendue_lesser(x18 * x30, 1.0f) / (1.0f + sqrt(x30 * etendue_greater(x27, 0.0f)));
    let x32 = sqrt(x28);
    let x33 = etendue_pow2_scale(x9);
    let x34 = x5 * x33;
    let x35 = x6 * x33;
    let x36 = x7 * x33;
    let x37 = fma(x34, x34, fma(x35, x35, x36 * x36));
    let x38 = select(0.0f, 1.0f / sqrt(x37), 0.0f < x37);
    let x39 = x34 * x38;
    let x40 = x35 * x38;
    let x41 = x36 * x38;
    let x42 = select(1.0f, x41, 0.0f < etendue_greater(etendue_greater(abs(x39), abs(x40)), abs(x41)));
    let x43 = etendue_copysign(1.0f, x42);
    let x44 = -1.0f / (x42 + x43);
    let x45 = x44 * (x39 * x40);
    let x46 = x39 * x43;
    let x47 = fma(x39, x44 * x46, 1.0f);
    let x48 = x43 * x45;
    let x49 = -x46;
    let x50 = fma(x40, x40 * x44, x43);
    let x51 = -x40;
    let x52 = select(0.0f, select(2.0f, x31, b29 & (0.0f <= x27)), 0.0f < x14);
    let x53 = 1.0f / x10;
    var result: EtendueSphereBySolidAngle;
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
fn etendue_sphere_by_solid_angle_sample(prepared: EtendueSphereBySolidAngle, u: vec2<f32>) -> EtendueLightSample {
    let x1 = prepared.shape_distance * (1.0f - prepared.shape_cone_one_minus_cos * u.x);
    let x2 = 1.0f - u.x;
    let b3 = 0.0f <= prepared.shape_power;
    let x4 = prepared.shape_cone_one_minus_cos * x2 * (2.0f - prepared.shape_cone_one_minus_cos * (u.x + 1.0f)) * (prepared.shape_distance * prepared.shape_distance);
    let x5 = sqrt(etendue_greater(select(fma(x1, x1, -prepared.shape_power), x4, b3), 0.0f)) + abs(x1);
    let x6 = etendue_lesser(etendue_greater(prepared.shape_cone_one_minus_cos, 0.0f), 2.0f);
    let x7 = u.x * x6;
    let x8 = sqrt(etendue_greater(x7 * fma(x2, x6, 2.0f - x6), 0.0f));
    let v9 = etendue_sin_cos_turns(u.y);
    let x10 = x8 * v9.y;
    let x11 = x8 * v9.x;
    let x12 = 1.0f - x7;
    let x13 = fma(prepared.shape_frame_s.x, x10, fma(prepared.shape_frame_t.x, x11, prepared.shape_frame_n.x * x12));
    let x14 = fma(prepared.shape_frame_s.y, x10, fma(prepared.shape_frame_t.y, x11, prepared.shape_frame_n.y * x12));
    let x15 = fma(prepared.shape_frame_s.z, x10, fma(prepared.shape_frame_t.z, x11, prepared.shape_frame_n.z * x12));
    let x16 = select(abs(prepared.shape_power) / select(1.0f, x5, 0.0f < x5), x5, !b3 & (0.0f <= x1));
    let x17 = etendue_lesser(prepared.shape_unit * x16, 3.4028235e38f);
    let x18 = select(0.0f, 0.15915494f / x6, 1e-37f < x6);
    let b19 = !(prepared.shape_power < 0.0f);
    let x20 = etendue_greater(etendue_greater(0.0f, etendue_greater(etendue_greater(abs(prepared.surface_center.x), abs(prepared.surface_center.y)), abs(prepared.surface_center.z))), etendue_greater(etendue_greater(abs(prepared.surface_radius), 0.0f), 0.0f));
    let b21 = x20 < etendue_from_bits(0x7f800000u);
    let x22 = etendue_pow2_scale(x20);
    let x23 = x22 * select(0.0f, prepared.surface_center.x, b21);
    let x24 = x22 * select(0.0f, prepared.surface_center.y, b21);
    let x25 = x22 * select(0.0f, prepared.surface_center.z, b21);
    let x26 = x22 * select(0.0f, prepared.surface_radius, b21);
    let x27 = x23 * x23;
    let x28 = x24 * x24;
    let x29 = x25 * x25;
    let x30 = x26 * x26;
    let x31 = x27 - x30;
    let x32 = x31 - x27;
    let x33 = x28 + x31;
    let x34 = x33 - x31;
    let x35 = x29 + x33;
    let x36 = x35 - x33;
    let x37 = x27 - (x31 - x32) + (-x30 - x32) + (x31 - (x33 - x34) + (x28 - x34));
    let x38 = fma(x23, x23, -x27) - fma(x26, x26, -x30) + (fma(x24, x24, -x28) + fma(x25, x25, -x29));
    let x39 = x35 + (x33 - (x35 - x36) + (x29 - x36) + x37 + x38);
    let x40 = fma(x13, x23, fma(x14, x24, x15 * x25));
    let x41 = fma(x13, -x40, x23);
    let x42 = fma(x14, -x40, x24);
    let x43 = fma(x15, -x40, x25);
    let x44 = sqrt(etendue_greater(fma(x26, x26, -fma(x41, x41, fma(x42, x42, x43 * x43))), 0.0f));
    let x45 = x44 + abs(x40);
    let x46 = etendue_lesser(etendue_greater(select(0.0f, abs(x39) / x45, 1e-37f < abs(x45)), -1e37f), 1e37f);
    let x47 = select(x46, x45, !(0.0f <= x39) & (0.0f <= x40));
    let x48 = fma(x13, x47, -x23);
    let x49 = fma(x14, x47, -x24);
    let x50 = fma(x15, x47, -x25);
    let x51 = fma(x48, x48, fma(x49, x49, x50 * x50));
    let x52 = select(0.0f, 1.0f / sqrt(x51), 0.0f < x51);
    let x53 = x48 * x52;
    let x54 = x49 * x52;
    let x55 = x50 * x52;
    let x56 = select(1.0f - x55, fma(x53, x53, x54 * x54) / (1.0f + abs(x55)), 0.5f < x55);
    let x57 = etendue_lesser(etendue_greater(x56 / 2.0f, 0.0f), 0.99999994f);
    let x58 = 0.15915494f * etendue_angle(x54, x53);
    let x59 = etendue_lesser(etendue_greater(select(x58, 1.0f + x58, x58 < 0.0f), 0.0f), 0.99999994f);
    let x60 = select(0.0f, 1.0f / x18, b19 & (1e-37f < x18));
    var result: EtendueLightSample;
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
fn etendue_sphere_by_solid_angle_pdf(prepared: EtendueSphereBySolidAngle, w: vec3<f32>) -> f32 {
    let x1 = fma(prepared.shape_frame_n.x, w.x, fma(prepared.shape_frame_n.y, w.y, prepared.shape_frame_n.z * w.z));
    let x2 = 1.0f - x1;
    let x3 = etendue_lesser(etendue_greater(prepared.shape_cone_one_minus_cos, 0.0f), 2.0f);
    let x4 = x2 - x3;
    let b5 = abs(x4) <= 3.8146973e-6f;
    var b6: bool;
    if (b5) {
        let x7 = fma(prepared.shape_frame_s.x, w.x, fma(prepared.shape_frame_s.y, w.y, prepared.shape_frame_s.z * w.z));
        let x8 = fma(prepared.shape_frame_t.x, w.x, fma(prepared.shape_frame_t.y, w.y, prepared.shape_frame_t.z * w.z));
        let x9 = select(x2, fma(x7, x7, x8 * x8) / (1.0f + abs(x1)), 0.5f < x1);
        let x10 = x3 + fma(5.9604645e-7f, etendue_greater(sqrt(x3 * (2.0f - x3)), x3 - 1.0f), 1.7763568e-13f);
        b6 = x9 <= x10;
    }
    let x11 = select(0.0f, select(0.0f, 0.15915494f / x3, 1e-37f < x3), ((x4 < 0.0f) & !b5) | (b5 & b6));
    return x11;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian. From inside, every direction. Greatest error:
// pdf 3.0e-7 relative (proved: 2e-6); direction 4.8e-7 (proved for all u: 1.5e-6, for R from 1e-4 of the greatest
// coordinate to where the sphere nearly touches); distance 3.6e-7 relative, except at the limb, where its slope is
// infinite.
fn etendue_sphere_by_solid_angle_hit(prepared: EtendueSphereBySolidAngle, w: vec3<f32>) -> EtendueLightSample {
    let x1 = fma(prepared.shape_frame_n.x, w.x, fma(prepared.shape_frame_n.y, w.y, prepared.shape_frame_n.z * w.z));
    let x2 = 1.0f - x1;
    let x3 = etendue_lesser(etendue_greater(prepared.shape_cone_one_minus_cos, 0.0f), 2.0f);
    let x4 = x2 - x3;
    let b5 = abs(x4) <= 3.8146973e-6f;
    let x6 = etendue_greater(etendue_greater(0.0f, etendue_greater(etendue_greater(abs(prepared.surface_center.x), abs(prepared.surface_center.y)), abs(prepared.surface_center.z))), etendue_greater(etendue_greater(abs(prepared.surface_radius), 0.0f), 0.0f));
    let b7 = x6 < etendue_from_bits(0x7f800000u);
    let x8 = etendue_pow2_scale(x6);
    let x9 = x8 * select(0.0f, prepared.surface_center.x, b7);
    let x10 = x8 * select(0.0f, prepared.surface_center.y, b7);
    let x11 = x8 * select(0.0f, prepared.surface_center.z, b7);
    let x12 = x8 * select(0.0f, prepared.surface_radius, b7);
    let x13 = x9 * x9;
    let x14 = x10 * x10;
    let x15 = x11 * x11;
    let x16 = x12 * x12;
    let x17 = x13 - x16;
    let x18 = x17 - x13;
    let x19 = x14 + x17;
    let x20 = x19 - x17;
    let x21 = x15 + x19;
    let x22 = x21 - x19;
    let x23 = x13 - (x17 - x18) + (-x16 - x18) + (x17 - (x19 - x20) + (x14 - x20));
    let x24 = fma(x9, x9, -x13) - fma(x12, x12, -x16) + (fma(x10, x10, -x14) + fma(x11, x11, -x15));
    let x25 = x21 + (x19 - (x21 - x22) + (x15 - x22) + x23 + x24);
    let x26 = fma(w.x, x9, fma(w.y, x10, w.z * x11));
    let x27 = fma(w.x, -x26, x9);
    let x28 = fma(w.y, -x26, x10);
    let x29 = fma(w.z, -x26, x11);
    let x30 = sqrt(etendue_greater(fma(x12, x12, -fma(x27, x27, fma(x28, x28, x29 * x29))), 0.0f));
    let x31 = x30 + abs(x26);
    let x32 = etendue_lesser(etendue_greater(select(0.0f, abs(x25) / x31, 1e-37f < abs(x31)), -1e37f), 1e37f);
    let x33 = select(x32, x31, !(0.0f <= x25) & (0.0f <= x26));
    let x34 = fma(w.x, x33, -x9);
    let x35 = fma(w.y, x33, -x10);
    let x36 = fma(w.z, x33, -x11);
    let x37 = fma(x34, x34, fma(x35, x35, x36 * x36));
    let x38 = select(0.0f, 1.0f / sqrt(x37), 0.0f < x37);
    let x39 = x34 * x38;
    let x40 = x35 * x38;
    let x41 = x36 * x38;
    let x42 = select(1.0f - x41, fma(x39, x39, x40 * x40) / (1.0f + abs(x41)), 0.5f < x41);
    let x43 = etendue_lesser(etendue_greater(x42 / 2.0f, 0.0f), 0.99999994f);
    let x44 = 0.15915494f * etendue_angle(x40, x39);
    let x45 = etendue_lesser(etendue_greater(select(x44, 1.0f + x44, x44 < 0.0f), 0.0f), 0.99999994f);
    var b46: bool;
    if (b5) {
        let x47 = fma(prepared.shape_frame_s.x, w.x, fma(prepared.shape_frame_s.y, w.y, prepared.shape_frame_s.z * w.z));
        let x48 = fma(prepared.shape_frame_t.x, w.x, fma(prepared.shape_frame_t.y, w.y, prepared.shape_frame_t.z * w.z));
        let x49 = select(x2, fma(x47, x47, x48 * x48) / (1.0f + abs(x1)), 0.5f < x1);
        let x50 = x3 + fma(5.9604645e-7f, etendue_greater(sqrt(x3 * (2.0f - x3)), x3 - 1.0f), 1.7763568e-13f);
        b46 = x49 <= x50;
    }
    let x51 = select(0.0f, select(0.0f, 0.15915494f / x3, 1e-37f < x3), ((x4 < 0.0f) & !b5) | (b5 & b46));
    let b52 = 0.0f < x51;
    let x53 = select(0.0f, etendue_lesser(x33 / x8, 3.4028235e38f), b52);
    let b54 = !(prepared.shape_power < 0.0f) & b52;
    let x55 = select(0.0f, 1.0f / x51, b54 & (1e-37f < x51));
    var result: EtendueLightSample;
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
fn etendue_triangle_by_solid_angle_prepare(light: EtendueTriangle, p: vec3<f32>) -> EtendueTriangleBySolidAngle {
    let x1 = light.v0.x - p.x;
    let x2 = light.v0.y - p.y;
    let x3 = light.v0.z - p.z;
    let x4 = etendue_greater(0.0f, etendue_greater(etendue_greater(abs(x1), abs(x2)), abs(x3)));
    let x5 = etendue_greater(etendue_greater(abs(light.e1.x), abs(light.e1.y)), abs(light.e1.z));
    let x6 = etendue_greater(etendue_greater(abs(light.e2.x), abs(light.e2.y)), abs(light.e2.z));
    let x7 = etendue_greater(etendue_greater(x4, x5), x6);
    let b8 = x7 < etendue_from_bits(0x7f800000u);
    let x9 = etendue_pow2_scale(x7);
    let x10 = x9 * select(0.0f, x1, b8);
    let x11 = x9 * select(0.0f, x2, b8);
    let x12 = x9 * select(0.0f, x3, b8);
    let x13 = x9 * select(0.0f, light.e1.x, b8);
    let x14 = x9 * select(0.0f, light.e1.y, b8);
    let x15 = x9 * select(0.0f, light.e1.z, b8);
    let x16 = x9 * select(0.0f, light.e2.x, b8);
    let x17 = x9 * select(0.0f, light.e2.y, b8);
    let x18 = x9 * select(0.0f, light.e2.z, b8);
    let x19 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x13), abs(x14)), abs(x15)));
    let x20 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x16), abs(x17)), abs(x18)));
    let x21 = x13 * x19;
    let x22 = x14 * x19;
    let x23 = x15 * x19;
    let x24 = x16 * x20;
    let x25 = x17 * x20;
    let x26 = x18 * x20;
    let x27 = x22 * x26;
    let x28 = x23 * x25;
    let x29 = x27 - x28;
    let x30 = x29 - x27;
    let x31 = x27 - (x29 - x30) + (-x28 - x30) + (fma(x22, x26, -x27) - fma(x23, x25, -x28));
    let x32 = x23 * x24;
    let x33 = x21 * x26;
    let x34 = x32 - x33;
    let x35 = x34 - x32;
    let x36 = x32 - (x34 - x35) + (-x33 - x35) + (fma(x23, x24, -x32) - fma(x21, x26, -x33));
    let x37 = x21 * x25;
    let x38 = x22 * x24;
    let x39 = x37 - x38;
    let x40 = x39 - x37;
    let x41 = x37 - (x39 - x40) + (-x38 - x40) + (fma(x21, x25, -x37) - fma(x22, x24, -x38));
    let x42 = x29 + x31;
    let x43 = x34 + x36;
    let x44 = x39 + x41;
    let x45 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x42), abs(x43)), abs(x44)));
    let x46 = x42 * x45;
    let x47 = x43 * x45;
    let x48 = x44 * x45;
    let x49 = fma(x46, x46, fma(x47, x47, x48 * x48));
    let x50 = select(0.0f, 1.0f / sqrt(x49), 0.0f < x49);
    let x51 = x46 * x50;
    let x52 = x47 * x50;
    let x53 = x48 * x50;
    let x54 = x49 * x50 / x45;
    let x55 = x10 * x29;
    let x56 = x11 * x34;
    let x57 = x12 * x39;
    let x58 = x55 + x56;
    let x59 = x58 - x55;
    let x60 = x57 + x58;
    let x61 = x60 - x58;
    let x62 = x55 - (x58 - x59) + (x56 - x59) + (x58 - (x60 - x61) + (x57 - x61));
    let x63 = fma(x10, x29, -x55) + (fma(x11, x34, -x56) + fma(x12, x39, -x57));
    let x64 = (x60 + (x62 + x63 + fma(x10, x31, fma(x11, x36, x12 * x41)))) / x54;
    let x65 = etendue_lesser(etendue_greater(select(0.0f, x64, 1e-37f < abs(x54)), -1e37f), 1e37f);
    let x66 = x54 / x19 / x20;
    let x67 = x51 * x66;
    let x68 = x52 * x66;
    let x69 = x53 * x66;
    let x70 = -(x12 * x14);
    let x71 = fma(x11, x15, x70) - fma(x12, x14, x70);
    let x72 = -(x10 * x15);
    let x73 = fma(x12, x13, x72) - fma(x10, x15, x72);
    let x74 = -(x11 * x13);
    let x75 = fma(x10, x14, x74) - fma(x11, x13, x74);
    let x76 = -(x12 * x17);
    let x77 = fma(x11, x18, x76) - fma(x12, x17, x76);
    let x78 = -(x10 * x18);
    let x79 = fma(x12, x16, x78) - fma(x10, x18, x78);
    let x80 = -(x11 * x16);
    let x81 = fma(x10, x17, x80) - fma(x11, x16, x80);
    let x82 = 1.0f / x9;
    let x83 = light.e1.x + x1;
    let x84 = light.e1.y + x2;
    let x85 = light.e1.z + x3;
    let x86 = light.e2.x + x1;
    let x87 = light.e2.y + x2;
    let x88 = light.e2.z + x3;
    let x89 = etendue_greater(etendue_greater(x4, etendue_greater(etendue_greater(abs(x83), abs(x84)), abs(x85))), etendue_greater(etendue_greater(abs(x86), abs(x87)), abs(x88)));
    let x90 = etendue_greater(etendue_greater(x89, x5), x6);
    let b91 = x90 < etendue_from_bits(0x7f800000u);
    let x92 = etendue_pow2_scale(x90);
    let x93 = x92 * select(0.0f, x1, b91);
    let x94 = x92 * select(0.0f, x2, b91);
    let x95 = x92 * select(0.0f, x3, b91);
    let x96 = x92 * select(0.0f, x83, b91);
    let x97 = x92 * select(0.0f, x84, b91);
    let x98 = x92 * select(0.0f, x85, b91);
    let x99 = x92 * select(0.0f, x86, b91);
    let x100 = x92 * select(0.0f, x87, b91);
    let x101 = x92 * select(0.0f, x88, b91);
    let x102 = x92 * select(0.0f, light.e1.x, b91);
    let x103 = x92 * select(0.0f, light.e1.y, b91);
    let x104 = x92 * select(0.0f, light.e1.z, b91);
    let x105 = x92 * select(0.0f, light.e2.x, b91);
    let x106 = x92 * select(0.0f, light.e2.y, b91);
    let x107 = x92 * select(0.0f, light.e2.z, b91);
    let x108 = x103 * x107;
    let x109 = x104 * x106;
    let x110 = x108 - x109;
    let x111 = x110 - x108;
    let x112 = x108 - (x110 - x111) + (-x109 - x111) + (fma(x103, x107, -x108) - fma(x104, x106, -x109));
    let x113 = x104 * x105;
    let x114 = x102 * x107;
    let x115 = x113 - x114;
    let x116 = x115 - x113;
    let x117 = x113 - (x115 - x116) + (-x114 - x116) + (fma(x104, x105, -x113) - fma(x102, x107, -x114));
    let x118 = x102 * x106;
    let x119 = x103 * x105;
    let x120 = x118 - x119;
    let x121 = x120 - x118;
    let x122 = x118 - (x120 - x121) + (-x119 - x121) + (fma(x102, x106, -x118) - fma(x103, x105, -x119));
    let x123 = x110 + x112;
    let x124 = x115 + x117;
    let x125 = x120 + x122;
    let x126 = x93 * x110;
    let x127 = x94 * x115;
    let x128 = x95 * x120;
    let x129 = x126 + x127;
    let x130 = x129 - x126;
    let x131 = x128 + x129;
    let x132 = x131 - x129;
    let x133 = x126 - (x129 - x130) + (x127 - x130) + (x129 - (x131 - x132) + (x128 - x132));
    let x134 = fma(x93, x110, -x126) + (fma(x94, x115, -x127) + fma(x95, x120, -x128));
    let x135 = x131 + (x133 + x134 + fma(x93, x112, fma(x94, x117, x95 * x122)));
    let x136 = x94 * x107;
    let x137 = x95 * x106;
    let x138 = x136 - x137;
    let x139 = x138 - x136;
    let x140 = fma(x95, x106, -x137);
    let x141 = x136 - (x138 - x139) + (-x137 - x139) + (fma(x94, x107, -x136) - x140);
    let x142 = x95 * x105;
    let x143 = x93 * x107;
    let x144 = x142 - x143;
    let x145 = x144 - x142;
    let x146 = fma(x93, x107, -x143);
    let x147 = x142 - (x144 - x145) + (-x143 - x145) + (fma(x95, x105, -x142) - x146);
    let x148 = x93 * x106;
    let x149 = x94 * x105;
    let x150 = x148 - x149;
    let x151 = x150 - x148;
    let x152 = fma(x94, x105, -x149);
    let x153 = x148 - (x150 - x151) + (-x149 - x151) + (fma(x93, x106, -x148) - x152);
    let x154 = x95 * x103;
    let x155 = x94 * x104;
    let x156 = x154 - x155;
    let x157 = x156 - x154;
    let x158 = fma(x95, x103, -x154);
    let x159 = x154 - (x156 - x157) + (-x155 - x157) + (x158 - fma(x94, x104, -x155));
    let x160 = x93 * x104;
    let x161 = x95 * x102;
    let x162 = x160 - x161;
    let x163 = x162 - x160;
    let x164 = fma(x93, x104, -x160);
    let x165 = x160 - (x162 - x163) + (-x161 - x163) + (x164 - fma(x95, x102, -x161));
    let x166 = x94 * x102;
    let x167 = x93 * x103;
    let x168 = x166 - x167;
    let x169 = x168 - x166;
    let x170 = fma(x94, x102, -x166);
    let x171 = x166 - (x168 - x169) + (-x167 - x169) + (x170 - fma(x93, x103, -x167));
    let x172 = x138 + x156;
    let x173 = x172 - x138;
    let x174 = x144 + x162;
    let x175 = x174 - x144;
    let x176 = x150 + x168;
    let x177 = x176 - x150;
    let x178 = x110 + x172;
    let x179 = x178 - x110;
    let x180 = x115 + x174;
    let x181 = x180 - x115;
    let x182 = x120 + x176;
    let x183 = x182 - x120;
    let x184 = x112 + (x138 - (x172 - x173) + (x156 - x173) + (x141 + x159));
    let x185 = x117 + (x144 - (x174 - x175) + (x162 - x175) + (x147 + x165));
    let x186 = x122 + (x150 - (x176 - x177) + (x168 - x177) + (x153 + x171));
    let x187 = fma(x94, x104, -x154) - x158;
    let x188 = fma(x95, x102, -x160) - x164;
    let x189 = fma(x93, x103, -x166) - x170;
    let x190 = fma(x94, x107, -x137) - x140;
    let x191 = fma(x95, x105, -x143) - x146;
    let x192 = fma(x93, x106, -x149) - x152;
    let x193 = x178 + (x110 - (x178 - x179) + (x172 - x179) + x184);
    let x194 = x180 + (x115 - (x180 - x181) + (x174 - x181) + x185);
    let x195 = x182 + (x120 - (x182 - x183) + (x176 - x183) + x186);
    let x196 = fma(x93, x93, fma(x94, x94, x95 * x95));
    let x197 = fma(x96, x96, fma(x97, x97, x98 * x98));
    let x198 = fma(x99, x99, fma(x100, x100, x101 * x101));
    let x199 = select(0.0f, 1.0f / sqrt(x196), 1e-36f < x196);
    let x200 = select(0.0f, 1.0f / sqrt(x197), 1e-36f < x197);
    let x201 = select(0.0f, 1.0f / sqrt(x198), 1e-36f < x198);
    let x202 = fma(x93, x96, fma(x94, x97, x95 * x98));
    let x203 = x200 * (x199 * x202);
    let x204 = fma(x93, x99, fma(x94, x100, x95 * x101));
    let x205 = x201 * (x199 * x204);
    let x206 = fma(x187, x187, fma(x188, x188, x189 * x189));
    let x207 = sqrt(x206);
    let x208 = select(0.0f, 1.0f / x207, 1e-37f < x206);
    let x209 = x196 * x199;
    let x210 = x197 * x200;
    let x211 = x200 * (x199 * (x206 * x208));
    let x212 = x210 * (x208 * x209);
    let x213 = x212 * 2.0f;
    let x214 = x211 * x211 / (1.0f + abs(x203));
    let b215 = x203 < 0.0f;
    let x216 = select(1.0f + x203, x214, b215);
    let x217 = x212 * select(x214, 1.0f - x203, b215);
    let x218 = abs(x135);
    let x219 = x201 * (x200 * (x199 * x218));
    let x220 = x96 * x200;
    let x221 = x97 * x200;
    let x222 = x98 * x200;
    let x223 = x93 * x199;
    let x224 = x94 * x199;
    let x225 = x95 * x199;
    let x226 = x220 + x223;
    let x227 = x221 + x224;
    let x228 = x222 + x225;
    let b229 = x135 < 0.0f;
    let x230 = x187 * x208;
    let x231 = x188 * x208;
    let x232 = x189 * x208;
    let x233 = -(x222 * x231);
    let x234 = fma(x221, x232, x233) - fma(x222, x231, x233);
    let x235 = -(x220 * x232);
    let x236 = fma(x222, x230, x235) - fma(x220, x232, x235);
    let x237 = -(x221 * x230);
    let x238 = fma(x220, x231, x237) - fma(x221, x230, x237);
    let x239 = x201 * fma(x99, x220, fma(x100, x221, x101 * x222));
    let x240 = x201 * fma(x105 - x102, x234, fma(x106 - x103, x236, (x107 - x104) * x238));
    let x241 = x201 * (x208 * x218);
    let x242 = fma(x190, x190, fma(x191, x191, x192 * x192));
    let x243 = x199 * x201;
    let x244 = x243 * (x242 * x243);
    let b245 = etendue_lesser(etendue_lesser(x203, x205), x239) < -0.5f;
    let x246 = fma(x96, x99, fma(x97, x100, x98 * x101));
    let x247 = fma(x193, x193, fma(x194, x194, x195 * x195));
    let x248 = select(x230, -x230, b229);
    let x249 = select(x231, -x231, b229);
    let x250 = select(x232, -x232, b229);
    let x251 = x209 * x218;
    let x252 = select(0.0f, fma(x187, x190, fma(x188, x191, x189 * x192)) / x251, 1e-37f < x251);
    let b253 = (0.0f < x199) & (0.0f < x200) & (0.0f < x201) & (0.0f < x219);
    let x254 = 1.0f / select(1.0f, x219, 1e-37f < x219);
    let x255 = etendue_lesser(etendue_greater(-x203 / select(1.0f, x211, 0.0f < x211), 1.0f), 1e18f);
    let x256 = select(x187, -x187, b229);
    let x257 = select(x188, -x188, b229);
    let x258 = select(x189, -x189, b229);
    let x259 = select(x193, -x193, b229);
    let x260 = select(x194, -x194, b229);
    let x261 = select(x195, -x195, b229);
    let x262 = select(-x190, x190, b229);
    let x263 = select(-x191, x191, b229);
    let x264 = select(-x192, x192, b229);
    let x265 = etendue_greater(x207 * x255, -x202) * 7.1525574e-7f;
    let x266 = etendue_greater(x255, -x205 * (1.0f / sqrt(etendue_greater(x244, 1e-7f)))) * sqrt(x247);
    let x267 = 7.1525574e-7f * etendue_greater(x266, -x246);
    let x268 = 7.1525574e-7f * etendue_greater(x255 * sqrt(x242), -x204);
    let x269 = etendue_greater(etendue_greater(x209, x210), x198 * x201);
    let x270 = x216 * x254;
    let x271 = etendue_pow2_scale(x92);
    var x272 = fma(x201, fma(x99, x226, fma(x100, x227, x101 * x228)), x216);
    var x273 = x240;
    var b274: bool;
    var b275: bool;
    var x276: f32;
    if (b245) {
        let x277 = x96 - x93;
        let x278 = x97 - x94;
        let x279 = x98 - x95;
        let x280 = fma(x277, x277, fma(x278, x278, x279 * x279));
        let b281 = 1e-36f < x280;
        let x282 = 1.0f / sqrt(select(1.0f, x280, b281));
        let x283 = x282 * x282;
        let x284 = -(x188 * x279);
        let x285 = -(x189 * x277);
        let x286 = -(x187 * x278);
        let x287 = x206 * x283;
        let x288 = x277 * x282;
        let x289 = x278 * x282;
        let x290 = x279 * x282;
        let x291 = x199 + x200;
        let x292 = x199 * (x199 * x287) / (1.0f + x199 * abs(fma(x93, x288, fma(x94, x289, x95 * x290))));
        let x293 = x200 * (x200 * x287) / (1.0f + x200 * abs(fma(x96, x288, fma(x97, x289, x98 * x290))));
        let x294 = x292 - x293;
        let b295 = (x202 < 0.0f) & b281;
        let x296 = select(x226, fma(x283 * (fma(x189, x278, x284) - fma(x188, x279, x284)), x291, x288 * x294), b295);
        let x297 = select(x227, fma(x283 * (fma(x187, x279, x285) - fma(x189, x277, x285)), x291, x289 * x294), b295);
        let x298 = select(x228, fma(x283 * (fma(x188, x277, x286) - fma(x187, x278, x286)), x291, x290 * x294), b295);
        let x299 = x99 * x201;
        let x300 = x100 * x201;
        let x301 = x101 * x201;
        let x302 = x99 - x93;
        let x303 = x100 - x94;
        let x304 = x101 - x95;
        let x305 = fma(x302, x302, fma(x303, x303, x304 * x304));
        let b306 = 1e-36f < x305;
        let x307 = 1.0f / sqrt(select(1.0f, x305, b306));
        let x308 = x307 * x307;
        let x309 = -(x191 * x304);
        let x310 = -(x192 * x302);
        let x311 = -(x190 * x303);
        let x312 = x242 * x308;
        let x313 = x302 * x307;
        let x314 = x303 * x307;
        let x315 = x304 * x307;
        let x316 = x199 + x201;
        let x317 = x199 * (x199 * x312) / (1.0f + x199 * abs(fma(x93, x313, fma(x94, x314, x95 * x315))));
        let x318 = x201 * (x201 * x312) / (1.0f + x201 * abs(fma(x99, x313, fma(x100, x314, x101 * x315))));
        let x319 = x317 - x318;
        let b320 = (x204 < 0.0f) & b306;
        let x321 = select(x223 + x299, fma(x308 * (fma(x192, x303, x309) - fma(x191, x304, x309)), x316, x313 * x319), b320);
        let x322 = select(x224 + x300, fma(x308 * (fma(x190, x304, x310) - fma(x192, x302, x310)), x316, x314 * x319), b320);
        let x323 = select(x225 + x301, fma(x308 * (fma(x191, x302, x311) - fma(x190, x303, x311)), x316, x315 * x319), b320);
        let x324 = x99 - x96;
        let x325 = x100 - x97;
        let x326 = x101 - x98;
        let x327 = fma(x324, x324, fma(x325, x325, x326 * x326));
        let b328 = 1e-36f < x327;
        let x329 = 1.0f / sqrt(select(1.0f, x327, b328));
        let x330 = x329 * x329;
        let x331 = -(x194 * x326);
        let x332 = -(x195 * x324);
        let x333 = -(x193 * x325);
        let x334 = x330 * x247;
        let x335 = x324 * x329;
        let x336 = x325 * x329;
        let x337 = x326 * x329;
        let x338 = x200 + x201;
        let x339 = x200 * (x200 * x334) / (1.0f + x200 * abs(fma(x96, x335, fma(x97, x336, x98 * x337))));
        let x340 = x201 * (x201 * x334) / (1.0f + x201 * abs(fma(x99, x335, fma(x100, x336, x101 * x337))));
        let x341 = x339 - x340;
        let b342 = (x246 < 0.0f) & b328;
        let x343 = select(x220 + x299, fma(x330 * (fma(x195, x325, x331) - fma(x194, x326, x331)), x338, x335 * x341), b342);
        let x344 = select(x221 + x300, fma(x330 * (fma(x193, x326, x332) - fma(x195, x324, x332)), x338, x336 * x341), b342);
        let x345 = select(x222 + x301, fma(x330 * (fma(x194, x324, x333) - fma(x193, x325, x333)), x338, x337 * x341), b342);
        let x346 = select(fma(x296, x321, fma(x297, x322, x298 * x323)), fma(x296, x343, fma(x297, x344, x298 * x345)), x239 < x205);
        x272 = select(x346, fma(x321, x343, fma(x322, x344, x323 * x345)), etendue_greater(x205, x239) < x203);
        x273 = -(x201 * (x200 * (x208 * fma(x187, x193, fma(x188, x194, x189 * x195)))));
        b274 = x239 < 0.0f;
        b275 = x205 < 0.0f;
        x276 = x244 / (1.0f + abs(x205));
    }
    let x347 = select(1.0f + x205, x276, b245 & b275);
    let x348 = select(0.0f, 2.0f * etendue_angle(x219, x272), b253);
    let x349 = etendue_greater(fma(x219, x219, x272 * x272), 1e-36f);
    let x350 = 1.0f / sqrt(x349);
    let x351 = x219 * x350;
    let x352 = x272 * x350;
    let x353 = x350 * (x254 * x349);
    let x354 = x353 * (x211 * 0.5f);
    let b355 = x354 < 1e30f;
    let x356 = x272 * x254;
    let x357 = x272 - x216;
    var x358: f32;
    if (b245) {
        x358 = fma(x273, x273, x241 * x241) / (1.0f + abs(x239));
    }
    let x359 = 1.0f / etendue_greater(select(1.0f + x239, x358, b245 & b274), 1e-30f);
    let x360 = select(0.0f, etendue_lesser(x354 * (x241 * x359), 1e18f), b355);
    let x361 = select(0.0f, etendue_lesser(etendue_greater(x354 * fma(x273, -x359, x217), -1e18f), 1e18f), b355);
    var result: EtendueTriangleBySolidAngle;
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
fn etendue_triangle_by_solid_angle_sample(prepared: EtendueTriangleBySolidAngle, u: vec2<f32>) -> EtendueLightSample {
    let b1 = 0.5f < u.x;
    let v2 = etendue_sin_cos_turns(prepared.shape_solid_angle * select(u.x, 1.0f - u.x, b1) * 0.07957747f);
    let x3 = select(v2.x, prepared.shape_half.x * v2.y - prepared.shape_half.y * v2.x, b1);
    let x4 = select(1.0f, prepared.shape_turned.x, b1);
    let x5 = select(-prepared.shape_cot_alpha, prepared.shape_turned.y, b1);
    let x6 = fma(v2.y, x5, -(v2.x * x4));
    let x7 = prepared.shape_stretch * x3;
    let x8 = etendue_lesser(etendue_greater(fma(select(-x6, x6, b1), -x7, prepared.shape_tan_half), -1000000000000000.0f), 1000000000000000.0f);
    let x9 = etendue_lesser(etendue_greater(fma(v2.y, x4, v2.x * x5) * x7, 0.0f), 1000000000000000.0f);
    let x10 = select(fma(prepared.shape_cot_half, -v2.x, v2.y), prepared.shape_inv_half_sin * v2.x, b1);
    let b11 = prepared.shape_g2 < 0.5f;
    let x12 = prepared.shape_g2_over_g0 * x3;
    let x13 = etendue_greater(x10 * (x12 + (x10 + x12)), 0.0f);
    let x14 = 2.0f * x12;
    let x15 = etendue_greater(x14 * fma(prepared.shape_one_plus_d02, x12, x10), 0.0f);
    let x16 = prepared.shape_one_plus_d02 * (x12 * x14) - x10 * x10;
    let x17 = 1.0f / sqrt(etendue_greater(fma(x16, x16, x15 * (x13 * (prepared.shape_one_plus_d02 * 2.0f))), 1e-30f));
    let x18 = x13 * x17;
    let x19 = x15 * x17;
    let x20 = 1.0f - u.y;
    let x21 = etendue_lesser(etendue_greater(select(0.0f, 1.0f / prepared.shape_solid_angle, 1e-37f < abs(prepared.shape_solid_angle)), -1e37f), 1e37f);
    let b22 = prepared.shape_volume < 0.0f;
    let x23 = select(0.0f, 1.0f / x21, b22 & (1e-37f < x21));
    var b24: bool;
    var x25: f32;
    var x26: f32;
    if (b11) {
        let x27 = fma(x19, prepared.shape_one_plus_d02 - 1.0f, x18);
        let x28 = select(1.0f - x27, prepared.shape_sin02_squared * (x19 * x19) / (1.0f + etendue_greater(x27, 0.0f)), 0.0f < x27);
        let x29 = fma(prepared.shape_g2, x18, x28 + prepared.shape_g1 * x19);
        let x30 = 1.0f / etendue_greater(x29, 1e-30f);
        let x31 = x30 * (prepared.shape_sin_side * x18);
        let x32 = x30 * (prepared.shape_x2 * x19);
        let b33 = (fma(prepared.shape_g2, x18, x28 + x19 * abs(prepared.shape_g1)) * 0.125f < x29) & (0.5f < x18 + x19);
        b24 = b33 & (x31 + abs(x32) < etendue_greater(prepared.shape_tan_half, abs(x8)));
        x25 = etendue_lesser(etendue_greater(x31 + x32, -1000000000000000.0f), 1000000000000000.0f);
        x26 = etendue_lesser(x30 * (prepared.shape_y2 * x19), 1000000000000000.0f);
    }
    let x34 = select(x8, x25, b24);
    let x35 = select(x9, x26, b24);
    let x36 = fma(x34, x34, x35 * x35);
    let x37 = 1.0f + x36;
    let x38 = 2.0f / x37;
    let x39 = u.y * x38;
    let x40 = fma(x36, -x39, 1.0f);
    let x41 = sqrt(etendue_greater(x39 * (x38 * fma(x36, x20, 1.0f)), 0.0f));
    let x42 = fma(prepared.shape_apex.x, x40, x41 * fma(prepared.shape_along.x, x34, prepared.shape_across.x * x35));
    let x43 = fma(prepared.shape_apex.y, x40, x41 * fma(prepared.shape_along.y, x34, prepared.shape_across.y * x35));
    let x44 = fma(prepared.shape_apex.z, x40, x41 * fma(prepared.shape_along.z, x34, prepared.shape_across.z * x35));
    let x45 = fma(fma(x42, x42, fma(x43, x43, x44 * x44)), -0.5f, 1.5f);
    let x46 = x42 * x45;
    let x47 = x43 * x45;
    let x48 = x44 * x45;
    let x49 = x37 * (0.5f * x41);
    let b50 = 1.0f < x36;
    let x51 = abs(1.0f - x36) / x37;
    let x52 = (1.0f + x51) * fma(x49, x51, x40);
    let x53 = fma(x49, prepared.shape_l1 * fma(prepared.shape_inv_l0, x18, prepared.shape_inv_l2 * x19), x20 * (x40 + x51) / select(1.0f, x52, 0.0f < x52));
    let x54 = select(x53, abs(fma(prepared.shape_normal.x, x46, fma(prepared.shape_normal.y, x47, prepared.shape_normal.z * x48))), b50);
    let b55 = (0.0f < x54) & (0.0f < prepared.shape_solid_angle);
    let x56 = etendue_lesser(prepared.shape_unit * etendue_lesser(select(prepared.shape_l1, abs(prepared.shape_volume), b50) / select(1.0f, x54, b55), prepared.shape_farthest), 3.4028235e38f);
    let x57 = select(0.0f, x56, b55);
    let x58 = fma(prepared.surface_plane_cross.x, x46, fma(prepared.surface_plane_cross.y, x47, prepared.surface_plane_cross.z * x48));
    let b59 = 1e-37f < abs(x58);
    let x60 = etendue_greater(select(0.0f, -fma(prepared.surface_plane_along_second.x, x46, fma(prepared.surface_plane_along_second.y, x47, prepared.surface_plane_along_second.z * x48)) / x58, b59), -1e37f);
    let x61 = etendue_lesser(etendue_greater(select(0.0f, fma(prepared.surface_plane_along_first.x, x46, fma(prepared.surface_plane_along_first.y, x47, prepared.surface_plane_along_first.z * x48)) / x58, b59), -1e37f), 1e37f);
    let x62 = etendue_lesser(etendue_greater(etendue_lesser(x60, 1e37f), 0.0f), 1.0f);
    let x63 = etendue_lesser(etendue_greater(x61, 0.0f), 1.0f);
    var result: EtendueLightSample;
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
fn etendue_triangle_by_solid_angle_pdf(prepared: EtendueTriangleBySolidAngle, w: vec3<f32>) -> f32 {
    let x1 = fma(prepared.shape_side01.x, w.x, fma(prepared.shape_side01.y, w.y, prepared.shape_side01.z * w.z));
    let x2 = fma(prepared.shape_side20.x, w.x, fma(prepared.shape_side20.y, w.y, prepared.shape_side20.z * w.z));
    let x3 = fma(prepared.shape_normal.x, w.x, fma(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z));
    let x4 = select(x3, -x3, prepared.shape_volume < 0.0f);
    let x5 = etendue_greater(etendue_greater(abs(prepared.shape_side01.x), abs(prepared.shape_side01.y)), abs(prepared.shape_side01.z)) + etendue_greater(etendue_greater(abs(prepared.shape_side20.x), abs(prepared.shape_side20.y)), abs(prepared.shape_side20.z));
    let x6 = (x5 + etendue_greater(etendue_greater(abs(prepared.shape_normal.x), abs(prepared.shape_normal.y)), abs(prepared.shape_normal.z))) * 1.9073486e-6f;
    let b7 = (0.0f <= x1) & (0.0f <= x2) & (0.0f <= x4) & (x6 < x4 - x2 - x1);
    var b8: bool;
    if (!b7) {
        let b9 = (-prepared.shape_slack.y <= fma(prepared.shape_side12.x, w.x, fma(prepared.shape_side12.y, w.y, prepared.shape_side12.z * w.z))) & (-prepared.shape_slack.z <= x2);
        let b10 = -(sqrt(fma(prepared.shape_normal.x, prepared.shape_normal.x, fma(prepared.shape_normal.y, prepared.shape_normal.y, prepared.shape_normal.z * prepared.shape_normal.z))) * 7.1525574e-7f) <= x4;
        b8 = b9 & (-prepared.shape_slack.x <= x1) & b10;
    }
    let x11 = select(0.0f, etendue_lesser(etendue_greater(select(0.0f, 1.0f / prepared.shape_solid_angle, 1e-37f < abs(prepared.shape_solid_angle)), -1e37f), 1e37f), b7 | b8);
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
fn etendue_triangle_by_solid_angle_hit(prepared: EtendueTriangleBySolidAngle, w: vec3<f32>) -> EtendueLightSample {
    let x1 = fma(prepared.shape_side01.x, w.x, fma(prepared.shape_side01.y, w.y, prepared.shape_side01.z * w.z));
    let x2 = fma(prepared.shape_side20.x, w.x, fma(prepared.shape_side20.y, w.y, prepared.shape_side20.z * w.z));
    let x3 = fma(prepared.shape_normal.x, w.x, fma(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z));
    let b4 = prepared.shape_volume < 0.0f;
    let x5 = select(x3, -x3, b4);
    let x6 = etendue_greater(etendue_greater(abs(prepared.shape_side01.x), abs(prepared.shape_side01.y)), abs(prepared.shape_side01.z)) + etendue_greater(etendue_greater(abs(prepared.shape_side20.x), abs(prepared.shape_side20.y)), abs(prepared.shape_side20.z));
    let x7 = (x6 + etendue_greater(etendue_greater(abs(prepared.shape_normal.x), abs(prepared.shape_normal.y)), abs(prepared.shape_normal.z))) * 1.9073486e-6f;
    let b8 = (0.0f <= x1) & (0.0f <= x2) & (0.0f <= x5) & (x7 < x5 - x2 - x1);
    let x9 = fma(prepared.surface_plane_cross.x, w.x, fma(prepared.surface_plane_cross.y, w.y, prepared.surface_plane_cross.z * w.z));
    let b10 = 1e-37f < abs(x9);
    let x11 = etendue_greater(select(0.0f, -fma(prepared.surface_plane_along_second.x, w.x, fma(prepared.surface_plane_along_second.y, w.y, prepared.surface_plane_along_second.z * w.z)) / x9, b10), -1e37f);
    let x12 = etendue_lesser(etendue_greater(select(0.0f, fma(prepared.surface_plane_along_first.x, w.x, fma(prepared.surface_plane_along_first.y, w.y, prepared.surface_plane_along_first.z * w.z)) / x9, b10), -1e37f), 1e37f);
    let x13 = etendue_lesser(etendue_greater(etendue_lesser(x11, 1e37f), 0.0f), 1.0f);
    let x14 = etendue_lesser(etendue_greater(x12, 0.0f), 1.0f);
    let x15 = fma(prepared.surface_plane_normal.x, w.x, fma(prepared.surface_plane_normal.y, w.y, prepared.surface_plane_normal.z * w.z));
    let x16 = etendue_greater(etendue_lesser(etendue_greater(select(0.0f, prepared.surface_plane_height / x15, 1e-37f < abs(x15)), -1e37f), 1e37f), 0.0f);
    var b17: bool;
    if (!b8) {
        let b18 = (-prepared.shape_slack.y <= fma(prepared.shape_side12.x, w.x, fma(prepared.shape_side12.y, w.y, prepared.shape_side12.z * w.z))) & (-prepared.shape_slack.z <= x2);
        let b19 = -(sqrt(fma(prepared.shape_normal.x, prepared.shape_normal.x, fma(prepared.shape_normal.y, prepared.shape_normal.y, prepared.shape_normal.z * prepared.shape_normal.z))) * 7.1525574e-7f) <= x5;
        b17 = b18 & (-prepared.shape_slack.x <= x1) & b19;
    }
    let x20 = select(0.0f, etendue_lesser(etendue_greater(select(0.0f, 1.0f / prepared.shape_solid_angle, 1e-37f < abs(prepared.shape_solid_angle)), -1e37f), 1e37f), b8 | b17);
    let b21 = 0.0f < x20;
    let x22 = select(0.0f, etendue_lesser(prepared.surface_plane_unit * x16, 3.4028235e38f), b21);
    let b23 = b4 & b21;
    let x24 = select(0.0f, 1.0f / x20, b23 & (1e-37f < x20));
    var result: EtendueLightSample;
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
fn etendue_rectangle_by_solid_angle_prepare(light: EtendueRectangle, p: vec3<f32>) -> EtendueRectangleBySolidAngle {
    let x1 = light.corner.x - p.x;
    let x2 = light.corner.y - p.y;
    let x3 = light.corner.z - p.z;
    let x4 = etendue_greater(etendue_greater(abs(x1), abs(x2)), abs(x3));
    let x5 = etendue_greater(etendue_greater(abs(light.edge_s.x), abs(light.edge_s.y)), abs(light.edge_s.z));
    let x6 = etendue_greater(etendue_greater(abs(light.edge_t.x), abs(light.edge_t.y)), abs(light.edge_t.z));
    let x7 = x6 + (x4 + x5);
    let b8 = x7 + x7 < etendue_from_bits(0x7f800000u);
    let x9 = etendue_pow2_scale(etendue_greater(etendue_greater(x4, x5), x6));
    let x10 = x9 * select(0.0f, x1, b8);
    let x11 = x9 * select(0.0f, x2, b8);
    let x12 = x9 * select(0.0f, x3, b8);
    let x13 = x9 * select(0.0f, light.edge_s.x, b8);
    let x14 = x9 * select(0.0f, light.edge_s.y, b8);
    let x15 = x9 * select(0.0f, light.edge_s.z, b8);
    let x16 = x9 * select(0.0f, light.edge_t.x, b8);
    let x17 = x9 * select(0.0f, light.edge_t.y, b8);
    let x18 = x9 * select(0.0f, light.edge_t.z, b8);
    let x19 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x13), abs(x14)), abs(x15)));
    let x20 = x13 * x19;
    let x21 = x14 * x19;
    let x22 = x15 * x19;
    let x23 = fma(x20, x20, fma(x21, x21, x22 * x22));
    let x24 = select(0.0f, 1.0f / sqrt(x23), 0.0f < x23);
    let x25 = x20 * x24;
    let x26 = x21 * x24;
    let x27 = x22 * x24;
    let x28 = x23 * x24 / x19;
    let x29 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x16), abs(x17)), abs(x18)));
    let x30 = x16 * x29;
    let x31 = x17 * x29;
    let x32 = x18 * x29;
    let x33 = fma(x30, x30, fma(x31, x31, x32 * x32));
    let x34 = select(0.0f, 1.0f / sqrt(x33), 0.0f < x33);
    let x35 = x30 * x34;
    let x36 = x31 * x34;
    let x37 = x32 * x34;
    let x38 = x33 * x34 / x29;
    let x39 = x21 * x32;
    let x40 = x22 * x31;
    let x41 = x39 - x40;
    let x42 = x41 - x39;
    let x43 = x39 - (x41 - x42) + (-x40 - x42) + (fma(x21, x32, -x39) - fma(x22, x31, -x40));
    let x44 = x22 * x30;
    let x45 = x20 * x32;
    let x46 = x44 - x45;
    let x47 = x46 - x44;
    let x48 = x44 - (x46 - x47) + (-x45 - x47) + (fma(x22, x30, -x44) - fma(x20, x32, -x45));
    let x49 = x20 * x31;
    let x50 = x21 * x30;
    let x51 = x49 - x50;
    let x52 = x51 - x49;
    let x53 = x49 - (x51 - x52) + (-x50 - x52) + (fma(x20, x31, -x49) - fma(x21, x30, -x50));
    let x54 = x41 + x43;
    let x55 = x46 + x48;
    let x56 = x51 + x53;
    let x57 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x54), abs(x55)), abs(x56)));
    let x58 = x54 * x57;
    let x59 = x55 * x57;
    let x60 = x56 * x57;
    let x61 = fma(x58, x58, fma(x59, x59, x60 * x60));
    let x62 = select(0.0f, 1.0f / sqrt(x61), 0.0f < x61);
    let x63 = x58 * x62;
    let x64 = x59 * x62;
    let x65 = x60 * x62;
    let x66 = x61 * x62 / x57;
    let x67 = x10 * x41;
    let x68 = x11 * x46;
    let x69 = x12 * x51;
    let x70 = x67 + x68;
    let x71 = x70 - x67;
    let x72 = x69 + x70;
    let x73 = x72 - x70;
    let x74 = x67 - (x70 - x71) + (x68 - x71) + (x70 - (x72 - x73) + (x69 - x73));
    let x75 = fma(x10, x41, -x67) + (fma(x11, x46, -x68) + fma(x12, x51, -x69));
    let x76 = (x72 + (x74 + x75 + fma(x10, x43, fma(x11, x48, x12 * x53)))) / x66;
    let x77 = select(0.0f, x76, 0.0f < x66);
    let x78 = x10 + x13;
    let x79 = x11 + x14;
    let x80 = x12 + x15;
    let x81 = x16 + x78;
    let x82 = x17 + x79;
    let x83 = x18 + x80;
    let x84 = x10 + x16;
    let x85 = x11 + x17;
    let x86 = x12 + x18;
    let x87 = abs(x77);
    let x88 = etendue_copysign(1.0f, x77);
    let x89 = x10 * x20;
    let x90 = x11 * x21;
    let x91 = x12 * x22;
    let x92 = x89 + x90;
    let x93 = x92 - x89;
    let x94 = x91 + x92;
    let x95 = x94 - x92;
    let x96 = x89 - (x92 - x93) + (x90 - x93) + (x92 - (x94 - x95) + (x91 - x95));
    let x97 = fma(x10, x20, -x89) + (fma(x11, x21, -x90) + fma(x12, x22, -x91));
    let x98 = x96 + x97;
    let x99 = x13 * x20;
    let x100 = x14 * x21;
    let x101 = x15 * x22;
    let x102 = x99 + x100;
    let x103 = x102 - x99;
    let x104 = x101 + x102;
    let x105 = x104 - x102;
    let x106 = x99 - (x102 - x103) + (x100 - x103) + (x102 - (x104 - x105) + (x101 - x105));
    let x107 = fma(x13, x20, -x99) + (fma(x14, x21, -x100) + fma(x15, x22, -x101));
    let x108 = x24 * (x94 + x98);
    let x109 = x94 + x104;
    let x110 = x109 - x94;
    let x111 = x94 - (x109 - x110) + (x104 - x110) + (x98 + (x106 + x107));
    let x112 = x24 * (x109 + x111);
    let b113 = x108 + x112 < 0.0f;
    let x114 = etendue_greater(select(x108, -x112, b113), x28 * -0.5f);
    let x115 = x28 + x114;
    let x116 = x10 * x30;
    let x117 = x11 * x31;
    let x118 = x12 * x32;
    let x119 = x116 + x117;
    let x120 = x119 - x116;
    let x121 = x118 + x119;
    let x122 = x121 - x119;
    let x123 = x116 - (x119 - x120) + (x117 - x120) + (x119 - (x121 - x122) + (x118 - x122));
    let x124 = fma(x10, x30, -x116) + (fma(x11, x31, -x117) + fma(x12, x32, -x118));
    let x125 = x123 + x124;
    let x126 = x16 * x30;
    let x127 = x17 * x31;
    let x128 = x18 * x32;
    let x129 = x126 + x127;
    let x130 = x129 - x126;
    let x131 = x128 + x129;
    let x132 = x131 - x129;
    let x133 = x126 - (x129 - x130) + (x127 - x130) + (x129 - (x131 - x132) + (x128 - x132));
    let x134 = fma(x16, x30, -x126) + (fma(x17, x31, -x127) + fma(x18, x32, -x128));
    let x135 = x34 * (x121 + x125);
    let x136 = x121 + x131;
    let x137 = x136 - x121;
    let x138 = x121 - (x136 - x137) + (x131 - x137) + (x125 + (x133 + x134));
    let x139 = x34 * (x136 + x138);
    let b140 = x135 + x139 < 0.0f;
    let x141 = etendue_greater(select(x135, -x139, b140), x38 * -0.5f);
    let x142 = x38 + x141;
    let x143 = select(x25, -x25, b113);
    let x144 = select(x26, -x26, b113);
    let x145 = select(x27, -x27, b113);
    let x146 = select(x35, -x35, b140);
    let x147 = select(x36, -x36, b140);
    let x148 = select(x37, -x37, b140);
    let b149 = x115 <= x114 + x114;
    let b150 = x142 <= x141 + x141;
    let x151 = select(0.0f, x115, b149);
    let x152 = select(0.0f, x142, b150);
    let x153 = x115 - x151;
    let x154 = x142 - x152;
    let x155 = select(select(x81, x78, b140), select(x84, x10, b140), b113) - x143 * x153 - x146 * x154;
    let x156 = select(select(x82, x79, b140), select(x85, x11, b140), b113) - x144 * x153 - x147 * x154;
    let x157 = select(select(x83, x80, b140), select(x86, x12, b140), b113) - x145 * x153 - x148 * x154;
    let b158 = etendue_greater(x153, x154) <= etendue_greater(etendue_greater(x151, x152), x87);
    let x159 = select(fma(x143, x151, fma(x146, x152, x63 * x77)), x155, b158);
    let x160 = select(fma(x144, x151, fma(x147, x152, x64 * x77)), x156, b158);
    let x161 = select(fma(x145, x151, fma(x148, x152, x65 * x77)), x157, b158);
    let x162 = x87 * x87;
    let x163 = x141 * x142;
    let x164 = sqrt(fma(x141, x141, x162) * fma(x142, x142, x162));
    let x165 = select(0.0f, 1.0f / x164, 0.0f < x164);
    let b166 = x141 < 0.0f;
    let x167 = x115 * x115;
    let x168 = x162 + x167;
    let x169 = sqrt(fma(x141, x141, x168));
    let x170 = fma(x142, x142, x168);
    let x171 = sqrt(x170);
    let x172 = x169 * x171;
    let x173 = select(0.0f, 1.0f / x168, 0.0f < x168);
    let x174 = abs(x141);
    let x175 = fma(x142, x169, x171 * x174);
    let x176 = x38 * (x141 + x142);
    let x177 = abs(x163);
    let x178 = x172 + x177;
    let x179 = select(select(0.0f, x176 / x175, 0.0f < x175), x173 * x175, b166) * (x87 * x115);
    let x180 = x165 * x179;
    let x181 = x165 * (x173 * fma(x163, x167, x162 * x172));
    let x182 = x165 * (x38 * (x38 * x162));
    let x183 = 1.0f + select(0.0f, fma(x141, x141, x170) / x178, 0.0f < x178);
    let x184 = x168 + x178;
    let x185 = select(x184, x168 * x183, b166);
    let x186 = select(0.0f, x182 / x185, 0.0f < x185);
    let x187 = x162 * x165;
    let x188 = x187 * select(x183, x173 * x184, b166);
    let b189 = x114 < 0.0f;
    let x190 = -x114 * -x114;
    let x191 = x162 + x190;
    let x192 = sqrt(fma(x141, x141, x191));
    let x193 = fma(x142, x142, x191);
    let x194 = sqrt(x193);
    let x195 = x192 * x194;
    let x196 = select(0.0f, 1.0f / x191, 0.0f < x191);
    let x197 = fma(x142, x192, x174 * x194);
    let x198 = x177 + x195;
    let x199 = select(select(0.0f, x176 / x197, 0.0f < x197), x196 * x197, b166) * (x87 * -x114);
    let x200 = x165 * x199;
    let x201 = x165 * (x196 * fma(x163, x190, x162 * x195));
    let x202 = 1.0f + select(0.0f, fma(x141, x141, x193) / x198, 0.0f < x198);
    let x203 = x191 + x198;
    let x204 = select(x203, x191 * x202, b166);
    let x205 = select(0.0f, x182 / x204, 0.0f < x204);
    let x206 = x187 * select(x202, x196 * x203, b166);
    let b207 = b166 | b189;
    let b208 = b166 & !b189;
    let x209 = select(x114, x141, b208);
    let x210 = select(x141, x114, b208);
    let x211 = select(x115, x142, b208);
    let x212 = select(x142, x115, b208);
    let x213 = fma(x209, x209, x162);
    let x214 = fma(x211, x211, x162);
    let x215 = sqrt(fma(x210, x210, x213));
    let x216 = sqrt(fma(x212, x212, x213));
    let x217 = sqrt(fma(x210, x210, x214));
    let x218 = sqrt(fma(x212, x212, x214));
    let x219 = x210 * x212;
    let b220 = 0.0f <= x210;
    let x221 = abs(x210);
    let x222 = fma(x212, x217, x218 * x221);
    let x223 = select(x38, x28, b208) * (x210 + x212);
    let x224 = select(x222, select(0.0f, x214 * x223 / x222, 0.0f < x222), b220) * (x87 * abs(x211));
    let x225 = fma(x212, x215, x216 * x221);
    let x226 = select(x225, select(0.0f, x213 * x223 / x225, 0.0f < x225), b220) * (x87 * abs(x209));
    let x227 = x215 * x216;
    let x228 = x38 * (x28 * x87);
    let x229 = x209 * x211;
    let x230 = x162 + (x219 + x229);
    let x231 = fma(x218, x215 * x217, fma(x218, x229 + fma(x210, x210, x162), fma(x217, x230, x215 * (x214 + x219))));
    let x232 = fma(x218, x227, fma(x215, x229 + fma(x212, x212, x162), fma(x216, x230, x218 * (x213 + x219))));
    let x233 = etendue_angle(select(x228, x224, b207), select(x231, fma(x219, x211 * x211, x162 * (x217 * x218)), b207));
    let x234 = x233 + etendue_angle(select(x228, x226, b207), select(x232, fma(x219, x209 * x209, x162 * x227), b207));
    let x235 = x234 * select(2.0f, 1.0f, b207);
    let b236 = 0.0f < x180;
    let b237 = b8 & (1e-36f < x235) & (x235 < 7.0f) & b236 & (1e-18f < x87);
    let x238 = x11 * x15;
    let x239 = x12 * x14;
    let x240 = x238 - x239;
    let x241 = x240 - x238;
    let x242 = x238 - (x240 - x241) + (-x239 - x241) + (fma(x11, x15, -x238) - fma(x12, x14, -x239));
    let x243 = x12 * x13;
    let x244 = x10 * x15;
    let x245 = x243 - x244;
    let x246 = x245 - x243;
    let x247 = x243 - (x245 - x246) + (-x244 - x246) + (fma(x12, x13, -x243) - fma(x10, x15, -x244));
    let x248 = x10 * x14;
    let x249 = x11 * x13;
    let x250 = x248 - x249;
    let x251 = x250 - x248;
    let x252 = x248 - (x250 - x251) + (-x249 - x251) + (fma(x10, x14, -x248) - fma(x11, x13, -x249));
    let x253 = x11 * x18;
    let x254 = x12 * x17;
    let x255 = x253 - x254;
    let x256 = x255 - x253;
    let x257 = x253 - (x255 - x256) + (-x254 - x256) + (fma(x11, x18, -x253) - fma(x12, x17, -x254));
    let x258 = x12 * x16;
    let x259 = x10 * x18;
    let x260 = x258 - x259;
    let x261 = x260 - x258;
    let x262 = x258 - (x260 - x261) + (-x259 - x261) + (fma(x12, x16, -x258) - fma(x10, x18, -x259));
    let x263 = x10 * x17;
    let x264 = x11 * x16;
    let x265 = x263 - x264;
    let x266 = x265 - x263;
    let x267 = x263 - (x265 - x266) + (-x264 - x266) + (fma(x10, x17, -x263) - fma(x11, x16, -x264));
    let x268 = x14 * x18;
    let x269 = x15 * x17;
    let x270 = x268 - x269;
    let x271 = x270 - x268;
    let x272 = x268 - (x270 - x271) + (-x269 - x271) + (fma(x14, x18, -x268) - fma(x15, x17, -x269));
    let x273 = x15 * x16;
    let x274 = x13 * x18;
    let x275 = x273 - x274;
    let x276 = x275 - x273;
    let x277 = x273 - (x275 - x276) + (-x274 - x276) + (fma(x15, x16, -x273) - fma(x13, x18, -x274));
    let x278 = x13 * x17;
    let x279 = x14 * x16;
    let x280 = x278 - x279;
    let x281 = x280 - x278;
    let x282 = x278 - (x280 - x281) + (-x279 - x281) + (fma(x13, x17, -x278) - fma(x14, x16, -x279));
    let x283 = -x255 - x257;
    let x284 = -x260 - x262;
    let x285 = -x265 - x267;
    let x286 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x283), abs(x284)), abs(x285)));
    let x287 = x283 * x286;
    let x288 = x284 * x286;
    let x289 = x285 * x286;
    let x290 = fma(x287, x287, fma(x288, x288, x289 * x289));
    let x291 = select(0.0f, 1.0f / sqrt(x290), 0.0f < x290);
    let x292 = x287 * x291;
    let x293 = x288 * x291;
    let x294 = x289 * x291;
    let x295 = x290 * x291 / x286;
    let b296 = x88 < 0.0f;
    let x297 = select(x292, -x292, b296);
    let x298 = select(x293, -x293, b296);
    let x299 = select(x294, -x294, b296);
    let x300 = select(0.0f, -fma(x10, x84, fma(x11, x85, x12 * x86)) / x295, 0.0f < x295);
    let x301 = etendue_lesser(etendue_greater(x300, 1.0f), 1e18f) * 4.7683716e-7f;
    let x302 = x255 + x270;
    let x303 = x302 - x255;
    let x304 = x260 + x275;
    let x305 = x304 - x260;
    let x306 = x265 + x280;
    let x307 = x306 - x265;
    let x308 = x302 + (x255 - (x302 - x303) + (x270 - x303) + (x257 + x272));
    let x309 = x304 + (x260 - (x304 - x305) + (x275 - x305) + (x262 + x277));
    let x310 = x306 + (x265 - (x306 - x307) + (x280 - x307) + (x267 + x282));
    let x311 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x308), abs(x309)), abs(x310)));
    let x312 = x308 * x311;
    let x313 = x309 * x311;
    let x314 = x310 * x311;
    let x315 = fma(x312, x312, fma(x313, x313, x314 * x314));
    let x316 = select(0.0f, 1.0f / sqrt(x315), 0.0f < x315);
    let x317 = x312 * x316;
    let x318 = x313 * x316;
    let x319 = x314 * x316;
    let x320 = x315 * x316 / x311;
    let x321 = select(x317, -x317, b296);
    let x322 = select(x318, -x318, b296);
    let x323 = select(x319, -x319, b296);
    let x324 = select(0.0f, -fma(x78, x81, fma(x79, x82, x80 * x83)) / x320, 0.0f < x320);
    let x325 = 4.7683716e-7f * etendue_lesser(etendue_greater(x324, 1.0f), 1e18f);
    let x326 = x240 + x242;
    let x327 = x245 + x247;
    let x328 = x250 + x252;
    let x329 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x326), abs(x327)), abs(x328)));
    let x330 = x326 * x329;
    let x331 = x327 * x329;
    let x332 = x328 * x329;
    let x333 = fma(x330, x330, fma(x331, x331, x332 * x332));
    let x334 = select(0.0f, 1.0f / sqrt(x333), 0.0f < x333);
    let x335 = x330 * x334;
    let x336 = x331 * x334;
    let x337 = x332 * x334;
    let x338 = x333 * x334 / x329;
    let x339 = select(x335, -x335, b296);
    let x340 = select(x336, -x336, b296);
    let x341 = select(x337, -x337, b296);
    let x342 = select(0.0f, -fma(x10, x78, fma(x11, x79, x12 * x80)) / x338, 0.0f < x338);
    let x343 = 4.7683716e-7f * etendue_lesser(etendue_greater(x342, 1.0f), 1e18f);
    let x344 = x270 - x240;
    let x345 = x344 - x270;
    let x346 = x275 - x245;
    let x347 = x346 - x275;
    let x348 = x280 - x250;
    let x349 = x348 - x280;
    let x350 = x270 - (x344 - x345) + (-x240 - x345) + (x272 - x242);
    let x351 = x275 - (x346 - x347) + (-x245 - x347) + (x277 - x247);
    let x352 = x280 - (x348 - x349) + (-x250 - x349) + (x282 - x252);
    let x353 = x344 + x350;
    let x354 = x346 + x351;
    let x355 = x348 + x352;
    let x356 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x353), abs(x354)), abs(x355)));
    let x357 = x353 * x356;
    let x358 = x354 * x356;
    let x359 = x355 * x356;
    let x360 = fma(x357, x357, fma(x358, x358, x359 * x359));
    let x361 = select(0.0f, 1.0f / sqrt(x360), 0.0f < x360);
    let x362 = x357 * x361;
    let x363 = x358 * x361;
    let x364 = x359 * x361;
    let x365 = x360 * x361 / x356;
    let x366 = select(x362, -x362, b296);
    let x367 = select(x363, -x363, b296);
    let x368 = select(x364, -x364, b296);
    let x369 = select(0.0f, -fma(x81, x84, fma(x82, x85, x83 * x86)) / x365, 0.0f < x365);
    let x370 = 4.7683716e-7f * etendue_lesser(etendue_greater(x369, 1.0f), 1e18f);
    let x371 = select(x297, x321, b113);
    let x372 = select(x298, x322, b113);
    let x373 = select(x299, x323, b113);
    let x374 = select(x321, x297, b113);
    let x375 = select(x322, x298, b113);
    let x376 = select(x323, x299, b113);
    let x377 = select(x339, x366, b140);
    let x378 = select(x340, x367, b140);
    let x379 = select(x341, x368, b140);
    let x380 = select(x366, x339, b140);
    let x381 = select(x367, x340, b140);
    let x382 = select(x368, x341, b140);
    let x383 = select(x301, x325, b113);
    let x384 = select(x343, x370, b140);
    let x385 = select(x325, x301, b113);
    let x386 = select(x370, x343, b140);
    let x387 = x63 * x88;
    let x388 = x64 * x88;
    let x389 = x65 * x88;
    let x390 = select(0.0f, 1.0f, b149);
    let x391 = select(0.0f, 1.0f, b150);
    let x392 = select(0.0f, 1.0f, b113);
    let x393 = select(0.0f, 1.0f, b140);
    let x394 = select(0.0f, 1.0f / x180, b236);
    let x395 = select(2.0f, 0.5f, b189);
    let x396 = select(0.0f, x235, b237);
    let x397 = 1.0f / x9;
    let x398 = etendue_greater(etendue_greater(etendue_greater(0.0f, x4), x5), x6);
    let b399 = x398 < etendue_from_bits(0x7f800000u);
    let x400 = etendue_pow2_scale(x398);
    let x401 = x400 * select(0.0f, x1, b399);
    let x402 = x400 * select(0.0f, x2, b399);
    let x403 = x400 * select(0.0f, x3, b399);
    let x404 = x400 * select(0.0f, light.edge_s.x, b399);
    let x405 = x400 * select(0.0f, light.edge_s.y, b399);
    let x406 = x400 * select(0.0f, light.edge_s.z, b399);
    let x407 = x400 * select(0.0f, light.edge_t.x, b399);
    let x408 = x400 * select(0.0f, light.edge_t.y, b399);
    let x409 = x400 * select(0.0f, light.edge_t.z, b399);
    let x410 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x404), abs(x405)), abs(x406)));
    let x411 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x407), abs(x408)), abs(x409)));
    let x412 = x404 * x410;
    let x413 = x405 * x410;
    let x414 = x406 * x410;
    let x415 = x407 * x411;
    let x416 = x408 * x411;
    let x417 = x409 * x411;
    let x418 = x413 * x417;
    let x419 = x414 * x416;
    let x420 = x418 - x419;
    let x421 = x420 - x418;
    let x422 = x418 - (x420 - x421) + (-x419 - x421) + (fma(x413, x417, -x418) - fma(x414, x416, -x419));
    let x423 = x414 * x415;
    let x424 = x412 * x417;
    let x425 = x423 - x424;
    let x426 = x425 - x423;
    let x427 = x423 - (x425 - x426) + (-x424 - x426) + (fma(x414, x415, -x423) - fma(x412, x417, -x424));
    let x428 = x412 * x416;
    let x429 = x413 * x415;
    let x430 = x428 - x429;
    let x431 = x430 - x428;
    let x432 = x428 - (x430 - x431) + (-x429 - x431) + (fma(x412, x416, -x428) - fma(x413, x415, -x429));
    let x433 = x420 + x422;
    let x434 = x425 + x427;
    let x435 = x430 + x432;
    let x436 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x433), abs(x434)), abs(x435)));
    let x437 = x433 * x436;
    let x438 = x434 * x436;
    let x439 = x435 * x436;
    let x440 = fma(x437, x437, fma(x438, x438, x439 * x439));
    let x441 = select(0.0f, 1.0f / sqrt(x440), 0.0f < x440);
    let x442 = x437 * x441;
    let x443 = x438 * x441;
    let x444 = x439 * x441;
    let x445 = x440 * x441 / x436;
    let x446 = x401 * x420;
    let x447 = x402 * x425;
    let x448 = x403 * x430;
    let x449 = x446 + x447;
    let x450 = x449 - x446;
    let x451 = x448 + x449;
    let x452 = x451 - x449;
    let x453 = x446 - (x449 - x450) + (x447 - x450) + (x449 - (x451 - x452) + (x448 - x452));
    let x454 = fma(x401, x420, -x446) + (fma(x402, x425, -x447) + fma(x403, x430, -x448));
    let x455 = (x451 + (x453 + x454 + fma(x401, x422, fma(x402, x427, x403 * x432)))) / x445;
    let x456 = etendue_lesser(etendue_greater(select(0.0f, x455, 1e-37f < abs(x445)), -1e37f), 1e37f);
    let x457 = x445 / x410 / x411;
    let x458 = x442 * x457;
    let x459 = x443 * x457;
    let x460 = x444 * x457;
    let x461 = -(x403 * x405);
    let x462 = fma(x402, x406, x461) - fma(x403, x405, x461);
    let x463 = -(x401 * x406);
    let x464 = fma(x403, x404, x463) - fma(x401, x406, x463);
    let x465 = -(x402 * x404);
    let x466 = fma(x401, x405, x465) - fma(x402, x404, x465);
    let x467 = -(x403 * x408);
    let x468 = fma(x402, x409, x467) - fma(x403, x408, x467);
    let x469 = -(x401 * x409);
    let x470 = fma(x403, x407, x469) - fma(x401, x409, x469);
    let x471 = -(x402 * x407);
    let x472 = fma(x401, x408, x471) - fma(x402, x407, x471);
    let x473 = 1.0f / x400;
    var result: EtendueRectangleBySolidAngle;
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
fn etendue_rectangle_by_solid_angle_sample(prepared: EtendueRectangleBySolidAngle, u: vec2<f32>) -> EtendueLightSample {
    let b1 = 0.0f < prepared.shape_flip.x;
    let x2 = 1.0f - u.x;
    let x3 = select(x2, u.x, b1);
    let b4 = prepared.shape_half < x3;
    let x5 = select(prepared.shape_sin_w1, prepared.shape_near_sin, b4);
    let x6 = select(prepared.shape_cos_w1, prepared.shape_near_cos, b4);
    let v7 = etendue_sin_cos_turns(select(x3, select(1.0f - x2, x2, b1), b4) * (prepared.shape_solid_angle * 0.07957747f));
    let x8 = etendue_greater(fma(x5, v7.y, -(x6 * v7.x)), -select(0.0f, 1.0f, b4));
    let x9 = -(v7.x * fma(x6, v7.y, x5 * v7.x));
    let x10 = x8 + x8;
    let x11 = v7.x * x10;
    let x12 = sqrt(etendue_greater((x11 + select(prepared.shape_above_p, prepared.shape_near_above_p, b4)) * (x11 + select(prepared.shape_above_s, prepared.shape_near_above_s, b4)), 0.0f));
    let x13 = fma(prepared.shape_sin_w1 * prepared.shape_sin_w1, x11 + (prepared.shape_above_p + prepared.shape_above_s), (x11 + (prepared.shape_cos_w1 + prepared.shape_cos_w1)) * (prepared.shape_above_p * prepared.shape_above_s));
    let x14 = prepared.shape_far.x * (prepared.shape_far.x * (x13 * (prepared.shape_inv_sin_w1 * x10 * (prepared.shape_inv_sin_w1 * v7.x))));
    let x15 = prepared.shape_height * fma(v7.y, x8, x9);
    let x16 = select(x15, -x15, b4);
    let b17 = 0.0f < prepared.shape_anchor.x;
    let x18 = x12 * select(1.0f, fma(prepared.shape_far.x, x12, x16), b17);
    let x19 = etendue_greater(select(x16, -x14, b17) / select(1.0f, x18, 0.0f < x18), select(prepared.shape_near.x, -prepared.shape_size.x, b17));
    let x20 = etendue_lesser(x19, select(prepared.shape_far.x, 0.0f, b17));
    let x21 = x20 + select(0.0f, prepared.shape_far.x, b17);
    let x22 = fma(x21, x21, prepared.shape_height * prepared.shape_height);
    let b23 = 0.0f < prepared.shape_flip.y;
    let x24 = 1.0f - u.y;
    let x25 = sqrt(fma(prepared.shape_near.y, prepared.shape_near.y, x22));
    let x26 = sqrt(fma(prepared.shape_far.y, prepared.shape_far.y, x22));
    let x27 = fma(prepared.shape_far.y, x25, x26 * abs(prepared.shape_near.y));
    let x28 = x27 * (x25 * x26);
    let x29 = select(0.0f, 1.0f / x28, 0.0f < x28);
    let x30 = x27 * x29;
    let x31 = x25 * x30;
    let x32 = prepared.shape_far.y * x31;
    let x33 = select(x27 * x30, x29 * (x22 * (prepared.shape_size.y * (prepared.shape_near.y + prepared.shape_far.y))), 0.0f <= prepared.shape_near.y);
    let x34 = x30 * (prepared.shape_near.y * x26);
    let x35 = select(x24, u.y, b23) * x33;
    let x36 = select(1.0f - x24, x24, b23) * x33;
    let x37 = x34 + x36;
    let b38 = x37 < 0.0f;
    let x39 = select(x32 - x35, x37, b38);
    let x40 = select(x35, -x36, b38) * (x39 + select(x32, x34, b38));
    let x41 = x30 * select(x25, x26, b38);
    let x42 = sqrt(etendue_greater(x22 * fma(x41, x22 * x41, x40), 0.0f));
    let b43 = 0.0f < prepared.shape_anchor.y;
    let x44 = x42 * select(1.0f, fma(x32, x42, x31 * (x22 * x39)), b43);
    let x45 = x22 * select(x39, -(x26 * x40), b43) / select(1.0f, x44, 0.0f < x44);
    let x46 = etendue_lesser(etendue_greater(x45, select(prepared.shape_near.y, -prepared.shape_size.y, b43)), select(prepared.shape_far.y, 0.0f, b43));
    let x47 = fma(prepared.shape_side_x.x, x20, fma(prepared.shape_side_y.x, x46, prepared.shape_base.x));
    let x48 = fma(prepared.shape_side_x.y, x20, fma(prepared.shape_side_y.y, x46, prepared.shape_base.y));
    let x49 = fma(prepared.shape_side_x.z, x20, fma(prepared.shape_side_y.z, x46, prepared.shape_base.z));
    let x50 = fma(x47, x47, fma(x48, x48, x49 * x49));
    let x51 = select(0.0f, 1.0f / sqrt(x50), 1e-37f < x50);
    let x52 = x47 * x51;
    let x53 = x48 * x51;
    let x54 = x49 * x51;
    let b55 = 0.0f < prepared.shape_solid_angle;
    let x56 = select(0.0f, prepared.shape_unit * (x50 * x51), b55);
    let x57 = select(0.0f, 1.0f / prepared.shape_solid_angle, b55);
    let b58 = prepared.shape_side < 0.0f;
    let x59 = fma(prepared.surface_plane_cross.x, x52, fma(prepared.surface_plane_cross.y, x53, prepared.surface_plane_cross.z * x54));
    let b60 = 1e-37f < abs(x59);
    let x61 = etendue_greater(select(0.0f, -fma(prepared.surface_plane_along_second.x, x52, fma(prepared.surface_plane_along_second.y, x53, prepared.surface_plane_along_second.z * x54)) / x59, b60), -1e37f);
    let x62 = etendue_lesser(etendue_greater(select(0.0f, fma(prepared.surface_plane_along_first.x, x52, fma(prepared.surface_plane_along_first.y, x53, prepared.surface_plane_along_first.z * x54)) / x59, b60), -1e37f), 1e37f);
    let x63 = etendue_lesser(etendue_greater(etendue_lesser(x61, 1e37f), 0.0f), 1.0f);
    let x64 = etendue_lesser(etendue_greater(x62, 0.0f), 1.0f);
    let x65 = select(0.0f, 1.0f / x57, b58 & (1e-37f < x57));
    var result: EtendueLightSample;
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
fn etendue_rectangle_by_solid_angle_pdf(prepared: EtendueRectangleBySolidAngle, w: vec3<f32>) -> f32 {
    let b1 = (-prepared.shape_slack.x <= fma(prepared.shape_near_x.x, w.x, fma(prepared.shape_near_x.y, w.y, prepared.shape_near_x.z * w.z))) & (-prepared.shape_slack_far.x <= fma(prepared.shape_far_x.x, w.x, fma(prepared.shape_far_x.y, w.y, prepared.shape_far_x.z * w.z)));
    let b2 = b1 & (-prepared.shape_slack.y <= fma(prepared.shape_near_y.x, w.x, fma(prepared.shape_near_y.y, w.y, prepared.shape_near_y.z * w.z))) & (-prepared.shape_slack_far.y <= fma(prepared.shape_far_y.x, w.x, fma(prepared.shape_far_y.y, w.y, prepared.shape_far_y.z * w.z)));
    let x3 = select(0.0f, select(0.0f, 1.0f / prepared.shape_solid_angle, 0.0f < prepared.shape_solid_angle), b2 & (-4.7683716e-7f <= fma(prepared.shape_normal.x, w.x, fma(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z))));
    return x3;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian. Greatest error over the atlas: direction 6e-7
// (4e-5 of the rectangle's size if that is 1e-6 and the point is 1e-7 above its plane), besides what 8 steps of 2^-24
// in u do to it (Omega and u0Omega are rounded; u0 counts from the nearer end where the rectangle lies on both sides
// of the foot). pdf 5e-7 relative, since heights and coordinates are formed in twice the working precision. Next to
// the plane of a rectangle that surrounds the point, nearly all of u0 lies within the rounding of a direction at the
// ends: the inverse is then one of the u that lead back to the direction.
fn etendue_rectangle_by_solid_angle_hit(prepared: EtendueRectangleBySolidAngle, w: vec3<f32>) -> EtendueLightSample {
    let b1 = (-prepared.shape_slack.x <= fma(prepared.shape_near_x.x, w.x, fma(prepared.shape_near_x.y, w.y, prepared.shape_near_x.z * w.z))) & (-prepared.shape_slack_far.x <= fma(prepared.shape_far_x.x, w.x, fma(prepared.shape_far_x.y, w.y, prepared.shape_far_x.z * w.z)));
    let b2 = b1 & (-prepared.shape_slack.y <= fma(prepared.shape_near_y.x, w.x, fma(prepared.shape_near_y.y, w.y, prepared.shape_near_y.z * w.z))) & (-prepared.shape_slack_far.y <= fma(prepared.shape_far_y.x, w.x, fma(prepared.shape_far_y.y, w.y, prepared.shape_far_y.z * w.z)));
    let x3 = select(0.0f, select(0.0f, 1.0f / prepared.shape_solid_angle, 0.0f < prepared.shape_solid_angle), b2 & (-4.7683716e-7f <= fma(prepared.shape_normal.x, w.x, fma(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z))));
    let b4 = 0.0f < x3;
    let x5 = fma(prepared.surface_plane_cross.x, w.x, fma(prepared.surface_plane_cross.y, w.y, prepared.surface_plane_cross.z * w.z));
    let b6 = 1e-37f < abs(x5);
    let x7 = etendue_greater(select(0.0f, -fma(prepared.surface_plane_along_second.x, w.x, fma(prepared.surface_plane_along_second.y, w.y, prepared.surface_plane_along_second.z * w.z)) / x5, b6), -1e37f);
    let x8 = etendue_lesser(etendue_greater(select(0.0f, fma(prepared.surface_plane_along_first.x, w.x, fma(prepared.surface_plane_along_first.y, w.y, prepared.surface_plane_along_first.z * w.z)) / x5, b6), -1e37f), 1e37f);
    let x9 = etendue_lesser(etendue_greater(etendue_lesser(x7, 1e37f), 0.0f), 1.0f);
    let x10 = etendue_lesser(etendue_greater(x8, 0.0f), 1.0f);
    let x11 = fma(prepared.surface_plane_normal.x, w.x, fma(prepared.surface_plane_normal.y, w.y, prepared.surface_plane_normal.z * w.z));
    let x12 = etendue_greater(etendue_lesser(etendue_greater(select(0.0f, prepared.surface_plane_height / x11, 1e-37f < abs(x11)), -1e37f), 1e37f), 0.0f);
    let x13 = select(0.0f, etendue_lesser(prepared.surface_plane_unit * x12, 3.4028235e38f), b4);
    let b14 = (prepared.shape_side < 0.0f) & b4;
    let x15 = select(0.0f, 1.0f / x3, b14 & (1e-37f < x3));
    var result: EtendueLightSample;
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
fn etendue_disk_by_area_prepare(light: EtendueDisk, p: vec3<f32>) -> EtendueDiskByArea {
    let x1 = light.center.x - p.x;
    let x2 = light.center.y - p.y;
    let x3 = light.center.z - p.z;
    let b4 = etendue_greater(etendue_greater(abs(x1), abs(x2)), abs(x3)) < etendue_from_bits(0x7f800000u);
    let x5 = select(0.0f, x1, b4);
    let x6 = select(0.0f, x2, b4);
    let x7 = select(0.0f, x3, b4);
    let x8 = select(0.0f, light.radius, b4);
    let x9 = etendue_copysign(1.0f, light.normal.z);
    let x10 = -1.0f / (light.normal.z + x9);
    let x11 = x10 * (light.normal.x * light.normal.y);
    let x12 = light.normal.x * x9;
    let x13 = fma(light.normal.x, x10 * x12, 1.0f);
    let x14 = x9 * x11;
    let x15 = -x12;
    let x16 = fma(light.normal.y, light.normal.y * x10, x9);
    let x17 = -light.normal.y;
    let x18 = light.normal.x * x5;
    let x19 = light.normal.y * x6;
    let x20 = light.normal.z * x7;
    let x21 = x18 + x19;
    let x22 = x21 - x18;
    let x23 = x20 + x21;
    let x24 = x23 - x21;
    let x25 = x18 - (x21 - x22) + (x19 - x22) + (x21 - (x23 - x24) + (x20 - x24));
    let x26 = fma(light.normal.x, x5, -x18) + (fma(light.normal.y, x6, -x19) + fma(light.normal.z, x7, -x20));
    let x27 = x23 + (x25 + x26);
    var result: EtendueDiskByArea;
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
fn etendue_disk_by_area_sample(prepared: EtendueDiskByArea, u: vec2<f32>) -> EtendueLightSample {
    let x1 = fma(u.x, 2.0f, -1.0f);
    let x2 = fma(u.y, 2.0f, -1.0f);
    let b3 = abs(x2) < abs(x1);
    let x4 = select(x2, x1, b3);
    let v5 = etendue_sin_cos_quarters(select(x1, x2, b3) * 0.5f / select(1.0f, x4, 0.0f < abs(x4)));
    let x6 = x4 * select(v5.x, v5.y, b3);
    let x7 = x4 * select(v5.y, v5.x, b3);
    let x8 = prepared.surface_radius * x6;
    let x9 = prepared.surface_radius * x7;
    let x10 = prepared.surface_center.x + (prepared.surface_frame_s.x * x8 + prepared.surface_frame_t.x * x9);
    let x11 = prepared.surface_center.y + (prepared.surface_frame_s.y * x8 + prepared.surface_frame_t.y * x9);
    let x12 = prepared.surface_center.z + (prepared.surface_frame_s.z * x8 + prepared.surface_frame_t.z * x9);
    let x13 = etendue_lesser(etendue_greater(fma(0.5f, x6, 0.5f), 0.0f), 1.0f);
    let x14 = etendue_lesser(etendue_greater(fma(0.5f, x7, 0.5f), 0.0f), 1.0f);
    let x15 = etendue_greater(etendue_greater(abs(x10), abs(x11)), abs(x12));
    let b16 = x15 < etendue_from_bits(0x7f800000u);
    let x17 = etendue_pow2_scale(select(0.0f, x15, b16));
    let x18 = x17 * select(0.0f, x10, b16);
    let x19 = x17 * select(0.0f, x11, b16);
    let x20 = x17 * select(0.0f, x12, b16);
    let x21 = fma(x18, x18, fma(x19, x19, x20 * x20));
    let x22 = select(0.0f, 1.0f / sqrt(x21), 0.0f < x21);
    let x23 = x21 * x22 / x17;
    let x24 = x18 * x22;
    let x25 = x19 * x22;
    let x26 = x20 * x22;
    let x27 = select(0.0f, x23, x23 < etendue_from_bits(0x7f800000u));
    let x28 = fma(prepared.surface_frame_n.x, x24, fma(prepared.surface_frame_n.y, x25, prepared.surface_frame_n.z * x26));
    let x29 = abs(x28);
    let x30 = etendue_greater(etendue_lesser(etendue_greater(select(0.0f, prepared.surface_height / x28, 1e-37f < x29), -1e37f), 1e37f), 0.0f);
    let x31 = prepared.surface_radius * prepared.surface_radius * 3.1415927f * x29;
    let b32 = 0.0f < x31;
    let x33 = x30 * (x30 / select(1.0f, x31, b32));
    let x34 = select(0.0f, x33, b32 & (x33 < 1e37f) & (0.0f < x30));
    let b35 = x28 < 0.0f;
    let x36 = select(0.0f, 1.0f / x34, b35 & (1e-37f < x34));
    var result: EtendueLightSample;
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
fn etendue_disk_by_area_pdf(prepared: EtendueDiskByArea, w: vec3<f32>) -> f32 {
    let x1 = fma(prepared.surface_frame_n.x, w.x, fma(prepared.surface_frame_n.y, w.y, prepared.surface_frame_n.z * w.z));
    let x2 = abs(x1);
    let x3 = etendue_greater(etendue_lesser(etendue_greater(select(0.0f, prepared.surface_height / x1, 1e-37f < x2), -1e37f), 1e37f), 0.0f);
    let x4 = x2 * (prepared.surface_radius * prepared.surface_radius * 3.1415927f);
    let b5 = 0.0f < x4;
    let x6 = x3 * (x3 / select(1.0f, x4, b5));
    let x7 = etendue_greater(etendue_greater(etendue_greater(abs(prepared.surface_center.x), abs(prepared.surface_center.y)), abs(prepared.surface_center.z)), abs(prepared.surface_radius));
    let x8 = etendue_pow2_scale(x7);
    let x9 = prepared.surface_center.x * x8;
    let x10 = prepared.surface_center.y * x8;
    let x11 = prepared.surface_center.z * x8;
    let x12 = prepared.surface_height * x8;
    let x13 = prepared.surface_radius * x8;
    let x14 = w.x * x12 - x1 * x9;
    let x15 = w.y * x12 - x1 * x10;
    let x16 = w.z * x12 - x1 * x11;
    let x17 = fma(x2, x13, (x13 + sqrt(fma(x9, x9, fma(x10, x10, x11 * x11)))) * 7.1525574e-7f);
    let b18 = (sqrt(fma(x14, x14, fma(x15, x15, x16 * x16))) <= x17) & (0.0f < x1 * x12);
    let x19 = select(0.0f, select(0.0f, x6, b5 & (x6 < 1e37f) & (0.0f < x3)), b18 & (0.0f < x13));
    return x19;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the surface of area A: pdf distance^2/(|cos(theta')| A) per steradian, theta' at the light.
fn etendue_disk_by_area_hit(prepared: EtendueDiskByArea, w: vec3<f32>) -> EtendueLightSample {
    let x1 = fma(prepared.surface_frame_n.x, w.x, fma(prepared.surface_frame_n.y, w.y, prepared.surface_frame_n.z * w.z));
    let x2 = abs(x1);
    let x3 = etendue_lesser(etendue_greater(select(0.0f, prepared.surface_height / x1, 1e-37f < x2), -1e37f), 1e37f);
    let x4 = etendue_greater(x3, 0.0f);
    let x5 = fma(w.x, x3, -prepared.surface_center.x);
    let x6 = fma(w.y, x3, -prepared.surface_center.y);
    let x7 = fma(w.z, x3, -prepared.surface_center.z);
    let x8 = abs(prepared.surface_radius);
    let b9 = 1e-37f < x8;
    let x10 = etendue_lesser(etendue_greater(select(0.0f, fma(prepared.surface_frame_s.x, x5, fma(prepared.surface_frame_s.y, x6, prepared.surface_frame_s.z * x7)) / prepared.surface_radius, b9), -1e37f), 1e37f);
    let x11 = etendue_lesser(etendue_greater(select(0.0f, fma(prepared.surface_frame_t.x, x5, fma(prepared.surface_frame_t.y, x6, prepared.surface_frame_t.z * x7)) / prepared.surface_radius, b9), -1e37f), 1e37f);
    let x12 = etendue_lesser(etendue_greater(fma(etendue_lesser(etendue_greater(x10, -1000000000000000.0f), 1000000000000000.0f), 0.5f, 0.5f), 0.0f), 1.0f);
    let x13 = etendue_lesser(etendue_greater(fma(etendue_lesser(etendue_greater(x11, -1000000000000000.0f), 1000000000000000.0f), 0.5f, 0.5f), 0.0f), 1.0f);
    let x14 = x2 * (prepared.surface_radius * prepared.surface_radius * 3.1415927f);
    let b15 = 0.0f < x14;
    let x16 = x4 * (x4 / select(1.0f, x14, b15));
    let x17 = etendue_pow2_scale(etendue_greater(etendue_greater(etendue_greater(abs(prepared.surface_center.x), abs(prepared.surface_center.y)), abs(prepared.surface_center.z)), x8));
    let x18 = prepared.surface_center.x * x17;
    let x19 = prepared.surface_center.y * x17;
    let x20 = prepared.surface_center.z * x17;
    let x21 = prepared.surface_height * x17;
    let x22 = prepared.surface_radius * x17;
    let x23 = w.x * x21 - x1 * x18;
    let x24 = w.y * x21 - x1 * x19;
    let x25 = w.z * x21 - x1 * x20;
    let x26 = fma(x2, x22, (x22 + sqrt(fma(x18, x18, fma(x19, x19, x20 * x20)))) * 7.1525574e-7f);
    let b27 = (sqrt(fma(x23, x23, fma(x24, x24, x25 * x25))) <= x26) & (0.0f < x1 * x21);
    let x28 = select(0.0f, select(0.0f, x16, b15 & (x16 < 1e37f) & (0.0f < x4)), b27 & (0.0f < x22));
    let b29 = 0.0f < x28;
    let x30 = select(0.0f, x4, b29);
    let b31 = b29 & (x1 < 0.0f);
    let x32 = select(0.0f, 1.0f / x28, b31 & (1e-37f < x28));
    var result: EtendueLightSample;
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
fn etendue_sun_by_solid_angle_prepare(light: EtendueSun) -> EtendueSunBySolidAngle {
    let x1 = etendue_copysign(1.0f, light.direction.z);
    let x2 = -1.0f / (light.direction.z + x1);
    let x3 = x2 * (light.direction.x * light.direction.y);
    let x4 = light.direction.x * x1;
    let x5 = fma(light.direction.x, x2 * x4, 1.0f);
    let x6 = x1 * x3;
    let x7 = -x4;
    let x8 = fma(light.direction.y, light.direction.y * x2, x1);
    let x9 = -light.direction.y;
    var result: EtendueSunBySolidAngle;
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
fn etendue_sun_by_solid_angle_sample(prepared: EtendueSunBySolidAngle, u: vec2<f32>) -> EtendueLightSample {
    let x1 = etendue_lesser(etendue_greater(prepared.cone_one_minus_cos, 0.0f), 2.0f);
    let x2 = u.x * x1;
    let x3 = sqrt(etendue_greater(x2 * fma(x1, 1.0f - u.x, 2.0f - x1), 0.0f));
    let v4 = etendue_sin_cos_turns(u.y);
    let x5 = x3 * v4.y;
    let x6 = x3 * v4.x;
    let x7 = 1.0f - x2;
    let x8 = fma(prepared.frame_s.x, x5, fma(prepared.frame_t.x, x6, prepared.frame_n.x * x7));
    let x9 = fma(prepared.frame_s.y, x5, fma(prepared.frame_t.y, x6, prepared.frame_n.y * x7));
    let x10 = fma(prepared.frame_s.z, x5, fma(prepared.frame_t.z, x6, prepared.frame_n.z * x7));
    let x11 = select(0.0f, 0.15915494f / x1, 1e-37f < x1);
    let x12 = -x8;
    let x13 = -x9;
    let x14 = -x10;
    let x15 = select(0.0f, 1.0f / x11, 1e-37f < x11);
    var result: EtendueLightSample;
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
fn etendue_sun_by_solid_angle_pdf(prepared: EtendueSunBySolidAngle, w: vec3<f32>) -> f32 {
    let x1 = fma(prepared.frame_n.x, w.x, fma(prepared.frame_n.y, w.y, prepared.frame_n.z * w.z));
    let x2 = 1.0f - x1;
    let x3 = etendue_lesser(etendue_greater(prepared.cone_one_minus_cos, 0.0f), 2.0f);
    let x4 = x2 - x3;
    let b5 = abs(x4) <= 3.8146973e-6f;
    var b6: bool;
    if (b5) {
        let x7 = fma(prepared.frame_s.x, w.x, fma(prepared.frame_s.y, w.y, prepared.frame_s.z * w.z));
        let x8 = fma(prepared.frame_t.x, w.x, fma(prepared.frame_t.y, w.y, prepared.frame_t.z * w.z));
        let x9 = select(x2, fma(x7, x7, x8 * x8) / (1.0f + abs(x1)), 0.5f < x1);
        let x10 = x3 + fma(5.9604645e-7f, etendue_greater(sqrt(x3 * (2.0f - x3)), x3 - 1.0f), 1.7763568e-13f);
        b6 = x9 <= x10;
    }
    let x11 = select(0.0f, select(0.0f, 0.15915494f / x3, 1e-37f < x3), ((x4 < 0.0f) & !b5) | (b5 & b6));
    return x11;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the cone: pdf 1/(2 pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
fn etendue_sun_by_solid_angle_hit(prepared: EtendueSunBySolidAngle, w: vec3<f32>) -> EtendueLightSample {
    let x1 = fma(prepared.frame_n.x, w.x, fma(prepared.frame_n.y, w.y, prepared.frame_n.z * w.z));
    let x2 = 1.0f - x1;
    let x3 = etendue_lesser(etendue_greater(prepared.cone_one_minus_cos, 0.0f), 2.0f);
    let x4 = x2 - x3;
    let b5 = abs(x4) <= 3.8146973e-6f;
    let x6 = fma(prepared.frame_s.x, w.x, fma(prepared.frame_s.y, w.y, prepared.frame_s.z * w.z));
    let x7 = fma(prepared.frame_t.x, w.x, fma(prepared.frame_t.y, w.y, prepared.frame_t.z * w.z));
    let x8 = select(x2, fma(x6, x6, x7 * x7) / (1.0f + abs(x1)), 0.5f < x1);
    let x9 = etendue_lesser(etendue_greater(x8 / select(1.0f, x3, 0.0f < x3), 0.0f), 0.99999994f);
    let x10 = 0.15915494f * etendue_angle(x7, x6);
    let x11 = etendue_lesser(etendue_greater(select(x10, 1.0f + x10, x10 < 0.0f), 0.0f), 0.99999994f);
    let x12 = -w.x;
    let x13 = -w.y;
    let x14 = -w.z;
    var b15: bool;
    if (b5) {
        let x16 = x3 + fma(5.9604645e-7f, etendue_greater(sqrt(x3 * (2.0f - x3)), x3 - 1.0f), 1.7763568e-13f);
        b15 = x8 <= x16;
    }
    let x17 = select(0.0f, select(0.0f, 0.15915494f / x3, 1e-37f < x3), ((x4 < 0.0f) & !b5) | (b5 & b15));
    let b18 = 0.0f < x17;
    let x19 = select(0.0f, 3.4028235e38f, b18);
    let x20 = select(0.0f, 1.0f / x17, b18 & (1e-37f < x17));
    var result: EtendueLightSample;
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
fn etendue_point_light_by_delta_prepare(light: EtenduePointLight, p: vec3<f32>) -> EtenduePointLightByDelta {
    let x1 = light.position.x - p.x;
    let x2 = light.position.y - p.y;
    let x3 = light.position.z - p.z;
    let x4 = etendue_greater(etendue_greater(abs(x1), abs(x2)), abs(x3));
    let b5 = x4 < etendue_from_bits(0x7f800000u);
    let x6 = etendue_pow2_scale(select(0.0f, x4, b5));
    let x7 = x6 * select(0.0f, x1, b5);
    let x8 = x6 * select(0.0f, x2, b5);
    let x9 = x6 * select(0.0f, x3, b5);
    let x10 = fma(x7, x7, fma(x8, x8, x9 * x9));
    let x11 = select(0.0f, 1.0f / sqrt(x10), 0.0f < x10);
    let x12 = x10 * x11 / x6;
    let x13 = x7 * x11;
    let x14 = x8 * x11;
    let x15 = x9 * x11;
    let x16 = select(0.0f, x12, x12 < etendue_from_bits(0x7f800000u));
    let x17 = x16 * x16;
    let x18 = select(0.0f, x17, x17 < 1e37f);
    var result: EtenduePointLightByDelta;
    result.direction.x = x13;
    result.direction.y = x14;
    result.direction.z = x15;
    result.distance = x16;
    result.pdf = x18;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Its one direction, whatever the random numbers. The pdf of a
// sample is distance^2, which is no density; that of a direction is 0.
fn etendue_point_light_by_delta_sample(prepared: EtenduePointLightByDelta, u: vec2<f32>) -> EtendueLightSample {
    let b1 = 0.0f < prepared.pdf;
    let x2 = -prepared.direction.x;
    let x3 = -prepared.direction.y;
    let x4 = -prepared.direction.z;
    let x5 = select(0.0f, 1.0f / prepared.pdf, b1 & (1e-37f < prepared.pdf));
    var result: EtendueLightSample;
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
fn etendue_point_light_by_delta_pdf(prepared: EtenduePointLightByDelta, w: vec3<f32>) -> f32 {
    return 0.0f;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Its one
// direction, whatever the random numbers. The pdf of a sample is distance^2, which is no density; that of a direction
// is 0.
fn etendue_point_light_by_delta_hit(prepared: EtenduePointLightByDelta, w: vec3<f32>) -> EtendueLightSample {
    let x1 = -w.x;
    let x2 = -w.y;
    let x3 = -w.z;
    var result: EtendueLightSample;
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
fn etendue_spot_light_by_delta_prepare(light: EtendueSpotLight, p: vec3<f32>) -> EtendueSpotLightByDelta {
    let x1 = light.position.x - p.x;
    let x2 = light.position.y - p.y;
    let x3 = light.position.z - p.z;
    let x4 = etendue_greater(etendue_greater(abs(x1), abs(x2)), abs(x3));
    let b5 = x4 < etendue_from_bits(0x7f800000u);
    let x6 = etendue_pow2_scale(select(0.0f, x4, b5));
    let x7 = x6 * select(0.0f, x1, b5);
    let x8 = x6 * select(0.0f, x2, b5);
    let x9 = x6 * select(0.0f, x3, b5);
    let x10 = fma(x7, x7, fma(x8, x8, x9 * x9));
    let x11 = select(0.0f, 1.0f / sqrt(x10), 0.0f < x10);
    let x12 = x10 * x11 / x6;
    let x13 = x7 * x11;
    let x14 = x8 * x11;
    let x15 = x9 * x11;
    let x16 = select(0.0f, x12, x12 < etendue_from_bits(0x7f800000u));
    let x17 = x16 * x16;
    let x18 = fma(light.axis.x, -x13, fma(light.axis.y, -x14, light.axis.z * -x15));
    let x19 = light.cos_inner - light.cos_outer;
    let b20 = 0.0f < x19;
    let x21 = etendue_lesser(etendue_greater((x18 - light.cos_outer) / select(1.0f, x19, b20), 0.0f), 1.0f);
    let x22 = select(select(0.0f, 1.0f, light.cos_inner <= x18), x21 * x21 * (3.0f - (x21 + x21)), b20);
    let b23 = 0.0f < x22;
    let x24 = select(0.0f, x17, x17 < 1e37f) / select(1.0f, x22, b23);
    let x25 = select(0.0f, x24, b23 & (x24 < 1e37f));
    var result: EtendueSpotLightByDelta;
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
fn etendue_spot_light_by_delta_sample(prepared: EtendueSpotLightByDelta, u: vec2<f32>) -> EtendueLightSample {
    let b1 = 0.0f < prepared.pdf;
    let x2 = -prepared.direction.x;
    let x3 = -prepared.direction.y;
    let x4 = -prepared.direction.z;
    let x5 = select(0.0f, 1.0f / prepared.pdf, b1 & (1e-37f < prepared.pdf));
    var result: EtendueLightSample;
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
fn etendue_spot_light_by_delta_pdf(prepared: EtendueSpotLightByDelta, w: vec3<f32>) -> f32 {
    return 0.0f;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Its one
// direction, whatever the random numbers. The pdf of a sample is distance^2 over the part of I that is emitted there,
// which is no density, and 0 outside of the cone; that of a direction is 0.
fn etendue_spot_light_by_delta_hit(prepared: EtendueSpotLightByDelta, w: vec3<f32>) -> EtendueLightSample {
    let x1 = -w.x;
    let x2 = -w.y;
    let x3 = -w.z;
    var result: EtendueLightSample;
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
fn etendue_directional_light_by_delta_prepare(light: EtendueDirectionalLight, p: vec3<f32>) -> EtendueDirectionalLightByDelta {
    var result: EtendueDirectionalLightByDelta;
    result.direction.x = light.direction.x;
    result.direction.y = light.direction.y;
    result.direction.z = light.direction.z;
    return result;
}

// Draws a direction to the light for u in [0, 1)^2. Its one direction, whatever the random numbers. The pdf of a
// sample is 1, which is no density; that of a direction is 0.
fn etendue_directional_light_by_delta_sample(prepared: EtendueDirectionalLightByDelta, u: vec2<f32>) -> EtendueLightSample {
    let x1 = -prepared.direction.x;
    let x2 = -prepared.direction.y;
    let x3 = -prepared.direction.z;
    var result: EtendueLightSample;
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
fn etendue_directional_light_by_delta_pdf(prepared: EtendueDirectionalLightByDelta, w: vec3<f32>) -> f32 {
    return 0.0f;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Its one
// direction, whatever the random numbers. The pdf of a sample is 1, which is no density; that of a direction is 0.
fn etendue_directional_light_by_delta_hit(prepared: EtendueDirectionalLightByDelta, w: vec3<f32>) -> EtendueLightSample {
    let x1 = -w.x;
    let x2 = -w.y;
    let x3 = -w.z;
    var result: EtendueLightSample;
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
fn etendue_sequence_key(low: u32, high: u32) -> u32 {
    let k1 = 1013904223u + high * 1664525u;
    let k2 = 1013904223u + low * 1664525u + k1 * 4188214367u;
    let k3 = k1 + 192933365u * k2;
    let k4 = 192933365u + k2 * k3;
    let k5 = 4188214367u + k3 * k4;
    let k6 = k3 ^ (k3 >> 16u);
    let k7 = (k2 ^ (k2 >> 16u)) + k6 * (k5 ^ (k5 >> 16u));
    let k8 = k6 + (k4 ^ (k4 >> 16u)) * k7;
    let k9 = k7 ^ ((k8 << 16u) | (k8 >> 16u));
    return k9;
}

// Independent random numbers, multiples of 2^-24 in [0, 1), for any counters and the key of a seed.
fn etendue_independent_pair(pixel: u32, sample_index: u32, dimension: u32, key: u32) -> vec2<f32> {
    let k1 = 1013904223u + sample_index * 1664525u;
    let k2 = 1013904223u + (dimension >> 1u) * 1664525u;
    let k3 = 1013904223u + key * 1664525u;
    let k4 = 1013904223u + pixel * 1664525u + k1 * k3;
    let k5 = k1 + k2 * k4;
    let k6 = k2 + k4 * k5;
    let k7 = k3 + k5 * k6;
    let k8 = k5 ^ (k5 >> 16u);
    let k9 = k6 ^ (k6 >> 16u);
    let k10 = k7 ^ (k7 >> 16u);
    let k11 = (k4 ^ (k4 >> 16u)) + k8 * k10;
    let k12 = k8 + k9 * k11;
    let k13 = k9 + k11 * k12;
    let b14 = 0.0f < etendue_from_word(dimension & 1u);
    let x15 = select(etendue_unit(k11), etendue_unit(k13), b14);
    let x16 = select(etendue_unit(k12), etendue_unit(k10 + k12 * k13), b14);
    var result: vec2<f32>;
    result.x = x15;
    result.y = x16;
    return result;
}

// Owen-scrambled Sobol pairs: in every dimension a (0, 2)-sequence in base 2. Best for counts that are a power of two.
fn etendue_owen_sobol_pair(pixel: u32, sample_index: u32, dimension: u32, key: u32) -> vec2<f32> {
    let k1 = 1013904223u + dimension * 1664525u;
    let k2 = 1013904223u + key * 1664525u;
    let k3 = 1013904223u + pixel * 1664525u + 3457715285u * k2;
    let k4 = 3457715285u + k1 * k3;
    let k5 = k1 + k3 * k4;
    let k6 = k2 + k4 * k5;
    let k7 = k4 ^ (k4 >> 16u);
    let k8 = k5 ^ (k5 >> 16u);
    let k9 = (k3 ^ (k3 >> 16u)) + k7 * (k6 ^ (k6 >> 16u));
    let k10 = k7 + k8 * k9;
    let k11 = k8 + k9 * k10;
    let k12 = (k9 + reverseBits(sample_index)) * ((k9 >> 16u) | 1u);
    let k13 = k12 ^ (k12 * 89287766u);
    let k14 = reverseBits(k13 ^ (k13 * 1403136100u));
    let k15 = k14 ^ ((k14 >> 16u) & 65535u);
    let k16 = k15 ^ ((k15 >> 8u) & 16711935u);
    let k17 = k16 ^ ((k16 >> 4u) & 252645135u);
    let k18 = k17 ^ ((k17 >> 2u) & 858993459u);
    let k19 = (k10 + k14) * (1u | (k10 >> 16u));
    let k20 = k19 ^ (89287766u * k19);
    let x21 = etendue_unit(reverseBits(k20 ^ (1403136100u * k20)));
    let k22 = (k11 + (k18 ^ ((k18 >> 1u) & 1431655765u))) * (1u | (k11 >> 16u));
    let k23 = k22 ^ (89287766u * k22);
    let x24 = etendue_unit(reverseBits(k23 ^ (1403136100u * k23)));
    var result: vec2<f32>;
    result.x = x21;
    result.y = x24;
    return result;
}

// What the weights take for a technique with this number of samples and this density; infinite where delta holds.
fn etendue_technique_pdf(samples: f32, pdf: f32, delta: bool) -> f32 {
    let x1 = select(etendue_lesser(etendue_greater(samples * pdf, 0.0f), 3.4028235e38f), etendue_from_bits(0x7f800000u), delta);
    return x1;
}

// The weights of two techniques by the balance heuristic, given the number of samples times the density of each; their
// sum is 1 within 2^-23, or 0 where both densities are.
fn etendue_balance_weights(first: f32, second: f32) -> vec2<f32> {
    let x1 = etendue_greater(first, 0.0f);
    let x2 = etendue_greater(second, 0.0f);
    let x3 = etendue_greater(etendue_greater(0.0f, x1), x2);
    let b4 = 0.0f < x3;
    let x5 = select(1.0f, x3, b4);
    let x6 = select(0.0f, select(x1 / x5, 1.0f, x3 <= x1), b4 & (0.0f < x1));
    let x7 = select(0.0f, select(x2 / x5, 1.0f, x3 <= x2), b4 & (0.0f < x2));
    let x8 = select(1.0f, x7 + (0.0f + x6), b4);
    let x9 = x6 / x8;
    let x10 = x7 / x8;
    var result: vec2<f32>;
    result.x = x9;
    result.y = x10;
    return result;
}

// The weights of two techniques by the power heuristic with exponent 2, given the number of samples times the density
// of each; their sum is 1 within 2^-23, or 0 where both densities are.
fn etendue_power_weights(first: f32, second: f32) -> vec2<f32> {
    let x1 = etendue_greater(first, 0.0f);
    let x2 = etendue_greater(second, 0.0f);
    let x3 = etendue_greater(etendue_greater(0.0f, x1), x2);
    let b4 = 0.0f < x3;
    let x5 = select(1.0f, x3, b4);
    let x6 = select(0.0f, select(x1 / x5, 1.0f, x3 <= x1), b4 & (0.0f < x1));
    let x7 = x6 * x6;
    let x8 = select(0.0f, select(x2 / x5, 1.0f, x3 <= x2), b4 & (0.0f < x2));
    let x9 = x8 * x8;
    let x10 = select(1.0f, x9 + (0.0f + x7), b4);
    let x11 = x7 / x10;
    let x12 = x9 / x10;
    var result: vec2<f32>;
    result.x = x11;
    result.y = x12;
    return result;
}

// The weight, over its density, of a sample of a light with these fields, where the surface draws the same direction
// with the density bsdf_pdf: by the power heuristic, one sample each. 0 where there is no sample.
fn etendue_power_light_weight(pdf: f32, emits: bool, delta: bool, bsdf_pdf: f32) -> f32 {
    let x1 = etendue_greater(select(etendue_lesser(etendue_greater(pdf, 0.0f), 3.4028235e38f), etendue_from_bits(0x7f800000u), delta), 0.0f);
    let x2 = etendue_greater(bsdf_pdf, 0.0f);
    let x3 = etendue_greater(etendue_greater(0.0f, x1), x2);
    let b4 = 0.0f < x3;
    let x5 = select(1.0f, x3, b4);
    let x6 = select(0.0f, select(x1 / x5, 1.0f, x3 <= x1), b4 & (0.0f < x1));
    let x7 = x6 * x6;
    let x8 = select(0.0f, select(x2 / x5, 1.0f, x3 <= x2), b4 & (0.0f < x2));
    let x9 = x7 / select(1.0f, x8 * x8 + (0.0f + x7), b4) * select(0.0f, 1.0f / pdf, emits & (1e-37f < pdf));
    return x9;
}

// The weight, over its density, of a direction that the surface drew with the density bsdf_pdf, where it hits a light
// with these fields: by the power heuristic, one sample each. 0 where the light is missed.
fn etendue_power_bsdf_weight(bsdf_pdf: f32, pdf: f32, emits: bool) -> f32 {
    let b1 = emits & (1e-37f < bsdf_pdf) & (0.0f < pdf);
    let x2 = etendue_greater(bsdf_pdf, 0.0f);
    let x3 = etendue_greater(pdf, 0.0f);
    let x4 = etendue_greater(etendue_greater(0.0f, x2), x3);
    let b5 = 0.0f < x4;
    let x6 = select(1.0f, x4, b5);
    let x7 = select(0.0f, select(x2 / x6, 1.0f, x4 <= x2), b5 & (0.0f < x2));
    let x8 = x7 * x7;
    let x9 = select(0.0f, select(x3 / x6, 1.0f, x4 <= x3), b5 & (0.0f < x3));
    let x10 = x8 / select(1.0f, x9 * x9 + (0.0f + x8), b5) / select(1.0f, bsdf_pdf, b1 & !(etendue_from_bits(0x7f800000u) <= bsdf_pdf));
    let x11 = select(0.0f, x10, b1);
    return x11;
}

// The factor of the radiance in or against the unit direction w of a flat light with the unit normal n that emits
// within an angle of it, on either side: (tan_half - tan theta) gain, with theta the angle to the normal, tan_half the
// tangent of half the spread, and gain 1/(tan_half - half the spread); 0 beyond. Within 4e-7 of the factor on the
// axis.
fn etendue_spread_attenuation(tan_half: f32, gain: f32, w: vec3<f32>, n: vec3<f32>) -> f32 {
    let x1 = abs(fma(w.x, n.x, fma(w.y, n.y, w.z * n.z)));
    let b2 = 0.0f < x1;
    let x3 = -(w.z * n.y);
    let x4 = fma(w.y, n.z, x3) - fma(w.z, n.y, x3);
    let x5 = -(w.x * n.z);
    let x6 = fma(w.z, n.x, x5) - fma(w.x, n.z, x5);
    let x7 = -(w.y * n.x);
    let x8 = fma(w.x, n.y, x7) - fma(w.y, n.x, x7);
    let x9 = tan_half - sqrt(fma(x4, x4, fma(x6, x6, x8 * x8))) / select(1.0f, x1, b2);
    let x10 = select(0.0f, etendue_greater(gain * x9, 0.0f), b2);
    return x10;
}

// The position in [0, 1)^2, from the upper left corner, of the unit direction w in an image that a light projects
// along +z, with these tangents of half the horizontal and vertical angle of view: (1 + w.x/(w.z tan_half.x))/2 and (1
// - w.y/(w.z tan_half.y))/2; 0 where w misses the image. Within 2e-7 over the cosine to the axis.
fn etendue_projector_place(tan_half: vec2<f32>, w: vec3<f32>) -> vec2<f32> {
    let x1 = tan_half.x * w.z;
    let x2 = tan_half.y * w.z;
    let b3 = (0.0f < x1) & (0.0f < x2) & (-x1 <= w.x) & (w.x < x1);
    let b4 = b3 & (-x2 < w.y) & (w.y <= x2);
    let x5 = select(0.0f, etendue_lesser(etendue_greater(fma(0.5f, w.x / select(1.0f, x1, b4), 0.5f), 0.0f), 0.99999994f), b4);
    let x6 = select(0.0f, etendue_lesser(etendue_greater(fma(0.5f, -w.y / select(1.0f, x2, b4), 0.5f), 0.0f), 0.99999994f), b4);
    var result: vec2<f32>;
    result.x = x5;
    result.y = x6;
    return result;
}

// Whether the unit direction w is in an image that a light projects along +z, with these tangents of half the angles
// of view; false for tangents that are not greater than 0.
fn etendue_projector_has(tan_half: vec2<f32>, w: vec3<f32>) -> bool {
    let x1 = tan_half.x * w.z;
    let x2 = tan_half.y * w.z;
    let b3 = (0.0f < x1) & (0.0f < x2) & (-x1 <= w.x) & (w.x < x1);
    let b4 = b3 & (-x2 < w.y) & (w.y <= x2);
    return b4;
}

// The unit direction in which the light of a position in a projected image travels: the inverse of projector_place.
fn etendue_projector_direction(tan_half: vec2<f32>, uv: vec2<f32>) -> vec3<f32> {
    let x1 = tan_half.x * fma(uv.x, 2.0f, -1.0f);
    let x2 = tan_half.y * -fma(uv.y, 2.0f, -1.0f);
    let x3 = fma(x1, x1, fma(x2, x2, 1.0f));
    let x4 = select(0.0f, 1.0f / sqrt(x3), 0.0f < x3);
    let x5 = x1 * x4;
    let x6 = x2 * x4;
    var result: vec3<f32>;
    result.x = x5;
    result.y = x6;
    result.z = x4;
    return result;
}

// The unit direction of a position in [0, 1]^2 in the image of the sky for a portal with these unit edges and unit
// normal edge_s x edge_t: a direction x s + y t + z n has the position (atan(x/z)/pi + 1/2, atan(y/z)/pi + 1/2). The
// scale does not matter.
fn etendue_portal_direction(edge_s: vec3<f32>, edge_t: vec3<f32>, normal: vec3<f32>, scale: f32, uv: vec2<f32>) -> vec3<f32> {
    let v1 = etendue_sin_cos_turns(0.5f * (uv.x - 0.5f));
    let v2 = etendue_sin_cos_turns(0.5f * (uv.y - 0.5f));
    let x3 = v1.x * v2.y;
    let x4 = v1.y * v2.x;
    let x5 = v1.y * v2.y;
    let x6 = fma(edge_s.x, x3, fma(edge_t.x, x4, normal.x * x5));
    let x7 = fma(edge_s.y, x3, fma(edge_t.y, x4, normal.y * x5));
    let x8 = fma(edge_s.z, x3, fma(edge_t.z, x4, normal.z * x5));
    let x9 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x6), abs(x7)), abs(x8)));
    let x10 = x6 * x9;
    let x11 = x7 * x9;
    let x12 = x8 * x9;
    let x13 = fma(x10, x10, fma(x11, x11, x12 * x12));
    let x14 = select(0.0f, 1.0f / sqrt(x13), 0.0f < x13);
    let x15 = x10 * x14;
    let x16 = x11 * x14;
    let x17 = x12 * x14;
    var result: vec3<f32>;
    result.x = x15;
    result.y = x16;
    result.z = x17;
    return result;
}

// The solid angle at a position in the image of the sky for a portal, per unit of the image's area, in steradians:
// what portal_direction stretches. scale is pi^2 times the sine of the angle between the edges.
fn etendue_portal_solid_angle(edge_s: vec3<f32>, edge_t: vec3<f32>, normal: vec3<f32>, scale: f32, uv: vec2<f32>) -> f32 {
    let v1 = etendue_sin_cos_turns(0.5f * (uv.x - 0.5f));
    let v2 = etendue_sin_cos_turns(0.5f * (uv.y - 0.5f));
    let x3 = v1.x * v2.y;
    let x4 = v1.y * v2.x;
    let x5 = v1.y * v2.y;
    let x6 = fma(edge_s.x, x3, fma(edge_t.x, x4, normal.x * x5));
    let x7 = fma(edge_s.y, x3, fma(edge_t.y, x4, normal.y * x5));
    let x8 = fma(edge_s.z, x3, fma(edge_t.z, x4, normal.z * x5));
    let x9 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x6), abs(x7)), abs(x8)));
    let x10 = x6 * x9;
    let x11 = x7 * x9;
    let x12 = x8 * x9;
    let x13 = fma(x10, x10, fma(x11, x11, x12 * x12));
    let x14 = x13 * select(0.0f, 1.0f / sqrt(x13), 0.0f < x13) / x9;
    let b15 = 0.0f < x14;
    let x16 = select(1.0f, x14, b15);
    let x17 = scale * (v1.y / x16) * (v2.y / x16) / x14;
    let x18 = etendue_lesser(etendue_greater(select(0.0f, x17, b15), 0.0f), 3.4028235e38f);
    return x18;
}

