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
    // 1 - cos(theta) of the angle to the axis up to which the intensity is I, in [0, 2].
    one_minus_cos_inner: f32,
    // 1 - cos(theta) of the angle from which it is 0, in [0, 2]; at least the other one.
    one_minus_cos_outer: f32,
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
    let x15 = x13 * x13;
    let x16 = fma(x11, x11, fma(x12, x12, x15));
    let x17 = x14 * x14;
    let b18 = x16 < x17 * 2.0f;
    let b19 = 0.0f < x16;
    let x20 = 1.0f / select(1.0f, x16, b19);
    let x21 = sqrt(x16);
    let x22 = etendue_pow2_scale(x9);
    let x23 = x5 * x22;
    let x24 = x6 * x22;
    let x25 = x7 * x22;
    let x26 = fma(x23, x23, fma(x24, x24, x25 * x25));
    let x27 = select(0.0f, 1.0f / sqrt(x26), 0.0f < x26);
    let x28 = x23 * x27;
    let x29 = x24 * x27;
    let x30 = x25 * x27;
    let x31 = select(1.0f, x30, 0.0f < etendue_greater(etendue_greater(abs(x28), abs(x29)), abs(x30)));
    let x32 = etendue_copysign(1.0f, x31);
    let x33 = -1.0f / (x31 + x32);
    let x34 = x33 * (x28 * x29);
    let x35 = x28 * x32;
    let x36 = fma(x28, x33 * x35, 1.0f);
    let x37 = x32 * x34;
    let x38 = -x35;
    let x39 = fma(x29, x29 * x33, x32);
    let x40 = -x29;
    let x41 = 1.0f / x10;
    var x42 = x16 - x17;
    if (b18) {
        let x43 = x11 * x11;
        let x44 = x12 * x12;
        let x45 = x43 - x17;
        let x46 = x45 - x43;
        let x47 = x44 + x45;
        let x48 = x47 - x45;
        let x49 = x15 + x47;
        let x50 = x49 - x47;
        let x51 = x43 - (x45 - x46) + (-x17 - x46) + (x45 - (x47 - x48) + (x44 - x48));
        let x52 = fma(x11, x11, -x43) - fma(x14, x14, -x17) + (fma(x12, x12, -x44) + fma(x13, x13, -x15));
        x42 = x49 + (x47 - (x49 - x50) + (x15 - x50) + x51 + x52);
    }
    let x53 = etendue_lesser(x17 * x20, 1.0f) / (1.0f + sqrt(x20 * etendue_greater(x42, 0.0f)));
    let x54 = select(0.0f, select(2.0f, x53, b19 & (0.0f <= x42)), (0.0f < x14) & (0.0f <= x16));
    var result: EtendueSphereBySolidAngle;
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
    let x18 = etendue_greater(etendue_greater(0.0f, etendue_greater(etendue_greater(abs(prepared.surface_center.x), abs(prepared.surface_center.y)), abs(prepared.surface_center.z))), etendue_greater(etendue_greater(abs(x17), 0.0f), 0.0f));
    let b19 = x18 < etendue_from_bits(0x7f800000u);
    let x20 = etendue_pow2_scale(x18);
    let x21 = x20 * select(0.0f, x17, b19);
    let x22 = fma(x13, x21, -(x20 * select(0.0f, prepared.surface_center.x, b19)));
    let x23 = fma(x14, x21, -(x20 * select(0.0f, prepared.surface_center.y, b19)));
    let x24 = fma(x15, x21, -(x20 * select(0.0f, prepared.surface_center.z, b19)));
    let x25 = fma(x22, x22, fma(x23, x23, x24 * x24));
    let x26 = select(0.0f, 1.0f / sqrt(x25), 0.0f < x25);
    let x27 = x22 * x26;
    let x28 = x23 * x26;
    let x29 = x24 * x26;
    let x30 = select(1.0f - x29, fma(x27, x27, x28 * x28) / (1.0f + abs(x29)), 0.5f < x29);
    let x31 = etendue_lesser(etendue_greater(x30 / 2.0f, 0.0f), 0.99999994f);
    let x32 = etendue_angle(x28, x27) * 0.15915494f;
    let x33 = etendue_lesser(etendue_greater(select(x32, 1.0f + x32, x32 < 0.0f), 0.0f), 0.99999994f);
    let x34 = select(0.0f, 0.15915494f / x6, 1e-37f < x6);
    let b35 = !(prepared.shape_power < 0.0f);
    let x36 = select(0.0f, 1.0f / x34, b35 & (1e-37f < x34));
    var result: EtendueLightSample;
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
    let x4 = etendue_greater(etendue_greater(abs(light.e1.x), abs(light.e1.y)), abs(light.e1.z));
    let x5 = etendue_pow2_scale(x4);
    let b6 = x4 < etendue_from_bits(0x7f800000u);
    let x7 = x5 * select(0.0f, light.e1.x, b6);
    let x8 = x5 * select(0.0f, light.e1.y, b6);
    let x9 = x5 * select(0.0f, light.e1.z, b6);
    let x10 = etendue_greater(etendue_greater(abs(light.e2.x), abs(light.e2.y)), abs(light.e2.z));
    let x11 = etendue_pow2_scale(x10);
    let b12 = x10 < etendue_from_bits(0x7f800000u);
    let x13 = x11 * select(0.0f, light.e2.x, b12);
    let x14 = x11 * select(0.0f, light.e2.y, b12);
    let x15 = x11 * select(0.0f, light.e2.z, b12);
    let x16 = x9 * x14;
    let x17 = fma(x9, x14, -x16);
    let x18 = fma(x8, x15, -x16) - x17;
    let x19 = x7 * x15;
    let x20 = fma(x7, x15, -x19);
    let x21 = fma(x9, x13, -x19) - x20;
    let x22 = x8 * x13;
    let x23 = fma(x8, x13, -x22);
    let x24 = fma(x7, x14, -x22) - x23;
    let x25 = abs(x18);
    let x26 = abs(x21);
    let x27 = etendue_pow2_scale(etendue_greater(etendue_greater(x25, x26), abs(x24)));
    let x28 = x18 * x27;
    let x29 = x21 * x27;
    let x30 = x24 * x27;
    let x31 = fma(x28, x28, fma(x29, x29, x30 * x30));
    let x32 = select(0.0f, 1.0f / sqrt(x31), 0.0f < x31);
    let x33 = x28 * x32;
    let x34 = x29 * x32;
    let x35 = x30 * x32;
    let x36 = x31 * x32 / x27;
    let x37 = etendue_greater(0.0f, etendue_greater(etendue_greater(abs(x1), abs(x2)), abs(x3)));
    let x38 = etendue_greater(etendue_greater(x37, x4), x10);
    let b39 = x38 < etendue_from_bits(0x7f800000u);
    let x40 = etendue_pow2_scale(x38);
    let x41 = x40 * select(0.0f, x1, b39);
    let x42 = x40 * select(0.0f, x2, b39);
    let x43 = x40 * select(0.0f, x3, b39);
    let x44 = x40 * select(0.0f, light.e1.x, b39);
    let x45 = x40 * select(0.0f, light.e1.y, b39);
    let x46 = x40 * select(0.0f, light.e1.z, b39);
    let x47 = x40 * select(0.0f, light.e2.x, b39);
    let x48 = x40 * select(0.0f, light.e2.y, b39);
    let x49 = x40 * select(0.0f, light.e2.z, b39);
    let x50 = x24 * x43;
    let x51 = fma(x18, x41, fma(x21, x42, x50));
    let b52 = abs(x51 + x51) < fma(x25, abs(x41), fma(x26, abs(x42), abs(x50)));
    let x53 = x36 * (x40 / x5) * (x40 / x11);
    let x54 = x33 * x53;
    let x55 = x34 * x53;
    let x56 = x35 * x53;
    let x57 = -(x43 * x45);
    let x58 = fma(x42, x46, x57) - fma(x43, x45, x57);
    let x59 = -(x41 * x46);
    let x60 = fma(x43, x44, x59) - fma(x41, x46, x59);
    let x61 = -(x42 * x44);
    let x62 = fma(x41, x45, x61) - fma(x42, x44, x61);
    let x63 = -(x43 * x48);
    let x64 = fma(x42, x49, x63) - fma(x43, x48, x63);
    let x65 = -(x41 * x49);
    let x66 = fma(x43, x47, x65) - fma(x41, x49, x65);
    let x67 = -(x42 * x47);
    let x68 = fma(x41, x48, x67) - fma(x42, x47, x67);
    let x69 = 1.0f / x40;
    let x70 = light.e1.x + x1;
    let x71 = light.e1.y + x2;
    let x72 = light.e1.z + x3;
    let x73 = light.e2.x + x1;
    let x74 = light.e2.y + x2;
    let x75 = light.e2.z + x3;
    let x76 = etendue_greater(etendue_greater(x37, etendue_greater(etendue_greater(abs(x70), abs(x71)), abs(x72))), etendue_greater(etendue_greater(abs(x73), abs(x74)), abs(x75)));
    let x77 = etendue_greater(etendue_greater(x76, x4), x10);
    let b78 = x77 < etendue_from_bits(0x7f800000u);
    let x79 = etendue_pow2_scale(x77);
    let x80 = x79 * select(0.0f, x1, b78);
    let x81 = x79 * select(0.0f, x2, b78);
    let x82 = x79 * select(0.0f, x3, b78);
    let x83 = x79 * select(0.0f, x70, b78);
    let x84 = x79 * select(0.0f, x71, b78);
    let x85 = x79 * select(0.0f, x72, b78);
    let x86 = x79 * select(0.0f, x73, b78);
    let x87 = x79 * select(0.0f, x74, b78);
    let x88 = x79 * select(0.0f, x75, b78);
    let x89 = x79 * select(0.0f, light.e1.x, b78);
    let x90 = x79 * select(0.0f, light.e1.y, b78);
    let x91 = x79 * select(0.0f, light.e1.z, b78);
    let x92 = x79 * select(0.0f, light.e2.x, b78);
    let x93 = x79 * select(0.0f, light.e2.y, b78);
    let x94 = x79 * select(0.0f, light.e2.z, b78);
    let x95 = x91 * x93;
    let x96 = fma(x91, x93, -x95);
    let x97 = fma(x90, x94, -x95) - x96;
    let x98 = x89 * x94;
    let x99 = fma(x89, x94, -x98);
    let x100 = fma(x91, x92, -x98) - x99;
    let x101 = x90 * x92;
    let x102 = fma(x90, x92, -x101);
    let x103 = fma(x89, x93, -x101) - x102;
    let x104 = x82 * x103;
    let x105 = fma(x80, x97, fma(x81, x100, x104));
    let x106 = fma(abs(x80), abs(x97), fma(abs(x81), abs(x100), abs(x104)));
    let b107 = abs(x105 + x105) < x106;
    let x108 = x90 * x94;
    let x109 = x108 - x95;
    let x110 = x109 - x108;
    let x111 = x108 - (x109 - x110) + (-x95 - x110) + (fma(x90, x94, -x108) - x96);
    let x112 = x91 * x92;
    let x113 = x112 - x98;
    let x114 = x113 - x112;
    let x115 = x112 - (x113 - x114) + (-x98 - x114) + (fma(x91, x92, -x112) - x99);
    let x116 = x89 * x93;
    let x117 = x116 - x101;
    let x118 = x117 - x116;
    let x119 = x116 - (x117 - x118) + (-x101 - x118) + (fma(x89, x93, -x116) - x102);
    let x120 = x92 - x89;
    let x121 = x93 - x90;
    let x122 = x94 - x91;
    let x123 = fma(x83, x83, fma(x84, x84, x85 * x85));
    let x124 = fma(x86, x86, fma(x87, x87, x88 * x88));
    let b125 = x123 < x124;
    let x126 = select(x86, x83, b125);
    let x127 = select(x87, x84, b125);
    let x128 = select(x88, x85, b125);
    let x129 = x82 * x90;
    let x130 = fma(x82, x90, -x129);
    let x131 = fma(x81, x91, -x129) - x130;
    let x132 = x80 * x91;
    let x133 = fma(x80, x91, -x132);
    let x134 = fma(x82, x89, -x132) - x133;
    let x135 = x81 * x89;
    let x136 = fma(x81, x89, -x135);
    let x137 = fma(x80, x90, -x135) - x136;
    let x138 = x82 * x93;
    let x139 = fma(x82, x93, -x138);
    let x140 = fma(x81, x94, -x138) - x139;
    let x141 = x80 * x94;
    let x142 = fma(x80, x94, -x141);
    let x143 = fma(x82, x92, -x141) - x142;
    let x144 = x81 * x92;
    let x145 = fma(x81, x92, -x144);
    let x146 = fma(x80, x93, -x144) - x145;
    let x147 = -(x121 * x128);
    let x148 = -(x122 * x126);
    let x149 = -(x120 * x127);
    let x150 = fma(x80, x80, fma(x81, x81, x82 * x82));
    let x151 = select(0.0f, 1.0f / sqrt(x150), 1e-36f < x150);
    let x152 = select(0.0f, 1.0f / sqrt(x123), 1e-36f < x123);
    let x153 = select(0.0f, 1.0f / sqrt(x124), 1e-36f < x124);
    let x154 = fma(x80, x83, fma(x81, x84, x82 * x85));
    let x155 = x152 * (x151 * x154);
    let x156 = fma(x80, x86, fma(x81, x87, x82 * x88));
    let x157 = x153 * (x151 * x156);
    let x158 = fma(x131, x131, fma(x134, x134, x137 * x137));
    let x159 = sqrt(x158);
    let x160 = select(0.0f, 1.0f / x159, 1e-37f < x158);
    let x161 = x150 * x151;
    let x162 = x123 * x152;
    let x163 = x152 * (x151 * (x158 * x160));
    let x164 = x162 * (x160 * x161);
    let x165 = x164 * 2.0f;
    let x166 = x163 * x163 / (1.0f + abs(x155));
    let b167 = x155 < 0.0f;
    let x168 = select(1.0f + x155, x166, b167);
    let x169 = x164 * select(x166, 1.0f - x155, b167);
    let x170 = x83 * x152;
    let x171 = x84 * x152;
    let x172 = x85 * x152;
    let x173 = x80 * x151;
    let x174 = x81 * x151;
    let x175 = x82 * x151;
    let x176 = x170 + x173;
    let x177 = x171 + x174;
    let x178 = x172 + x175;
    let x179 = x131 * x160;
    let x180 = x134 * x160;
    let x181 = x137 * x160;
    let x182 = -(x172 * x180);
    let x183 = fma(x171, x181, x182) - fma(x172, x180, x182);
    let x184 = -(x170 * x181);
    let x185 = fma(x172, x179, x184) - fma(x170, x181, x184);
    let x186 = -(x171 * x179);
    let x187 = fma(x170, x180, x186) - fma(x171, x179, x186);
    let x188 = x153 * fma(x86, x170, fma(x87, x171, x88 * x172));
    let x189 = fma(x140, x140, fma(x143, x143, x146 * x146));
    let x190 = x151 * x153;
    let x191 = x190 * (x189 * x190);
    let b192 = etendue_lesser(etendue_lesser(x155, x157), x188) < -0.5f;
    let x193 = fma(x83, x86, fma(x84, x87, x85 * x88));
    let x194 = etendue_lesser(etendue_greater(-x155 / select(1.0f, x163, 0.0f < x163), 1.0f), 1e18f);
    let x195 = etendue_greater(x159 * x194, -x154) * 7.1525574e-7f;
    let x196 = 7.1525574e-7f * etendue_greater(x194 * sqrt(x189), -x156);
    let x197 = etendue_greater(etendue_greater(x161, x162), x124 * x153);
    let x198 = etendue_pow2_scale(x79);
    var x199: f32;
    if (b52) {
        let x200 = x8 * x15;
        let x201 = x200 - x16;
        let x202 = x201 - x200;
        let x203 = x200 - (x201 - x202) + (-x16 - x202) + (fma(x8, x15, -x200) - x17);
        let x204 = x9 * x13;
        let x205 = x204 - x19;
        let x206 = x205 - x204;
        let x207 = x204 - (x205 - x206) + (-x19 - x206) + (fma(x9, x13, -x204) - x20);
        let x208 = x7 * x14;
        let x209 = x208 - x22;
        let x210 = x209 - x208;
        let x211 = x208 - (x209 - x210) + (-x22 - x210) + (fma(x7, x14, -x208) - x23);
        let x212 = x41 * x201;
        let x213 = x42 * x205;
        let x214 = x43 * x209;
        let x215 = x212 + x213;
        let x216 = x215 - x212;
        let x217 = x214 + x215;
        let x218 = x217 - x215;
        let x219 = x212 - (x215 - x216) + (x213 - x216) + (x215 - (x217 - x218) + (x214 - x218));
        let x220 = fma(x41, x201, -x212) + (fma(x42, x205, -x213) + fma(x43, x209, -x214));
        x199 = x217 + (x219 + x220 + fma(x41, x203, fma(x42, x207, x43 * x211)));
    }
    let x221 = etendue_lesser(etendue_greater(select(0.0f, select(x51, x199, b52) / x36, 1e-37f < abs(x36)), -1e37f), 1e37f);
    var x222 = x105;
    if (b107) {
        let x223 = x80 * x109;
        let x224 = x81 * x113;
        let x225 = x82 * x117;
        let x226 = x223 + x224;
        let x227 = x226 - x223;
        let x228 = x225 + x226;
        let x229 = x228 - x226;
        let x230 = x223 - (x226 - x227) + (x224 - x227) + (x226 - (x228 - x229) + (x225 - x229));
        let x231 = fma(x80, x109, -x223) + (fma(x81, x113, -x224) + fma(x82, x117, -x225));
        x222 = x228 + (x230 + x231 + fma(x80, x111, fma(x81, x115, x82 * x119)));
    }
    let x232 = abs(x222);
    let x233 = x153 * (x152 * (x151 * x232));
    let b234 = x222 < 0.0f;
    let x235 = x153 * (x160 * x232);
    let x236 = select(x179, -x179, b234);
    let x237 = select(x180, -x180, b234);
    let x238 = select(x181, -x181, b234);
    let x239 = x161 * x232;
    let x240 = select(0.0f, fma(x131, x140, fma(x134, x143, x137 * x146)) / x239, 1e-37f < x239);
    let b241 = (0.0f < x151) & (0.0f < x152) & (0.0f < x153) & (0.0f < x233);
    let x242 = 1.0f / select(1.0f, x233, 1e-37f < x233);
    let x243 = select(x131, -x131, b234);
    let x244 = select(x134, -x134, b234);
    let x245 = select(x137, -x137, b234);
    let x246 = select(-x140, x140, b234);
    let x247 = select(-x143, x143, b234);
    let x248 = select(-x146, x146, b234);
    let x249 = x168 * x242;
    var x250 = fma(x122, x127, x147) - fma(x121, x128, x147);
    var x251 = fma(x120, x128, x148) - fma(x122, x126, x148);
    var x252 = fma(x121, x126, x149) - fma(x120, x127, x149);
    var x253: f32;
    var x254: f32;
    var x255: f32;
    var x256: f32;
    var x257: f32;
    var x258: f32;
    var x259: f32;
    var x260: f32;
    var x261: f32;
    var x262: f32;
    var x263: f32;
    var x264: f32;
    var x265: f32;
    var x266: f32;
    var x267: f32;
    var x268: f32;
    var x269: f32;
    var b270: bool;
    var b271: bool;
    var b272: bool;
    var x273: f32;
    if (b192) {
        let x274 = x81 * x94;
        let x275 = x274 - x138;
        let x276 = x275 - x274;
        let x277 = x274 - (x275 - x276) + (-x138 - x276) + (fma(x81, x94, -x274) - x139);
        let x278 = x82 * x92;
        let x279 = x278 - x141;
        let x280 = x279 - x278;
        let x281 = x278 - (x279 - x280) + (-x141 - x280) + (fma(x82, x92, -x278) - x142);
        let x282 = x80 * x93;
        let x283 = x282 - x144;
        let x284 = x283 - x282;
        let x285 = x282 - (x283 - x284) + (-x144 - x284) + (fma(x80, x93, -x282) - x145);
        let x286 = x81 * x91;
        let x287 = x129 - x286;
        let x288 = x287 - x129;
        let x289 = x129 - (x287 - x288) + (-x286 - x288) + (x130 - fma(x81, x91, -x286));
        let x290 = x82 * x89;
        let x291 = x132 - x290;
        let x292 = x291 - x132;
        let x293 = x132 - (x291 - x292) + (-x290 - x292) + (x133 - fma(x82, x89, -x290));
        let x294 = x80 * x90;
        let x295 = x135 - x294;
        let x296 = x295 - x135;
        let x297 = x135 - (x295 - x296) + (-x294 - x296) + (x136 - fma(x80, x90, -x294));
        let x298 = x275 + x287;
        let x299 = x298 - x275;
        let x300 = x279 + x291;
        let x301 = x300 - x279;
        let x302 = x283 + x295;
        let x303 = x302 - x283;
        let x304 = x109 + x298;
        let x305 = x304 - x109;
        let x306 = x113 + x300;
        let x307 = x306 - x113;
        let x308 = x117 + x302;
        let x309 = x308 - x117;
        let x310 = x111 + (x275 - (x298 - x299) + (x287 - x299) + (x277 + x289));
        let x311 = x115 + (x279 - (x300 - x301) + (x291 - x301) + (x281 + x293));
        let x312 = x119 + (x283 - (x302 - x303) + (x295 - x303) + (x285 + x297));
        x250 = x304 + (x109 - (x304 - x305) + (x298 - x305) + x310);
        x251 = x306 + (x113 - (x306 - x307) + (x300 - x307) + x311);
        x252 = x308 + (x117 - (x308 - x309) + (x302 - x309) + x312);
        let x313 = x83 - x80;
        let x314 = x84 - x81;
        let x315 = x85 - x82;
        let x316 = fma(x313, x313, fma(x314, x314, x315 * x315));
        let b317 = 1e-36f < x316;
        let x318 = 1.0f / sqrt(select(1.0f, x316, b317));
        let x319 = x318 * x318;
        let x320 = -(x134 * x315);
        let x321 = -(x137 * x313);
        let x322 = -(x131 * x314);
        let x323 = x158 * x319;
        let x324 = x313 * x318;
        let x325 = x314 * x318;
        let x326 = x315 * x318;
        let x327 = x151 + x152;
        let x328 = x151 * (x151 * x323) / (1.0f + x151 * abs(fma(x80, x324, fma(x81, x325, x82 * x326))));
        let x329 = x152 * (x152 * x323) / (1.0f + x152 * abs(fma(x83, x324, fma(x84, x325, x85 * x326))));
        let x330 = x328 - x329;
        let b331 = (x154 < 0.0f) & b317;
        x253 = select(x176, fma(x319 * (fma(x137, x314, x320) - fma(x134, x315, x320)), x327, x324 * x330), b331);
        x254 = select(x177, fma(x319 * (fma(x131, x315, x321) - fma(x137, x313, x321)), x327, x325 * x330), b331);
        x255 = select(x178, fma(x319 * (fma(x134, x313, x322) - fma(x131, x314, x322)), x327, x326 * x330), b331);
        x256 = x86 * x153;
        x257 = x87 * x153;
        x258 = x88 * x153;
        let x332 = x86 - x80;
        let x333 = x87 - x81;
        let x334 = x88 - x82;
        let x335 = fma(x332, x332, fma(x333, x333, x334 * x334));
        let b336 = 1e-36f < x335;
        let x337 = 1.0f / sqrt(select(1.0f, x335, b336));
        let x338 = x337 * x337;
        let x339 = -(x143 * x334);
        let x340 = -(x146 * x332);
        let x341 = -(x140 * x333);
        let x342 = x189 * x338;
        let x343 = x332 * x337;
        let x344 = x333 * x337;
        let x345 = x334 * x337;
        let x346 = x151 + x153;
        let x347 = x151 * (x151 * x342) / (1.0f + x151 * abs(fma(x80, x343, fma(x81, x344, x82 * x345))));
        let x348 = x153 * (x153 * x342) / (1.0f + x153 * abs(fma(x86, x343, fma(x87, x344, x88 * x345))));
        let x349 = x347 - x348;
        let b350 = (x156 < 0.0f) & b336;
        x259 = select(x173 + x256, fma(x338 * (fma(x146, x333, x339) - fma(x143, x334, x339)), x346, x343 * x349), b350);
        x260 = select(x174 + x257, fma(x338 * (fma(x140, x334, x340) - fma(x146, x332, x340)), x346, x344 * x349), b350);
        x261 = select(x175 + x258, fma(x338 * (fma(x143, x332, x341) - fma(x140, x333, x341)), x346, x345 * x349), b350);
        x262 = x86 - x83;
        x263 = x87 - x84;
        x264 = x88 - x85;
        let x351 = fma(x262, x262, fma(x263, x263, x264 * x264));
        let b352 = 1e-36f < x351;
        let x353 = 1.0f / sqrt(select(1.0f, x351, b352));
        x265 = x353 * x353;
        x266 = x262 * x353;
        x267 = x263 * x353;
        x268 = x264 * x353;
        x269 = x152 + x153;
        b270 = (x193 < 0.0f) & b352;
        b271 = x188 < 0.0f;
        b272 = x157 < 0.0f;
        x273 = x191 / (1.0f + abs(x157));
    }
    let x354 = fma(x250, x250, fma(x251, x251, x252 * x252));
    let x355 = select(1.0f + x157, x273, b192 & b272);
    let x356 = select(x250, -x250, b234);
    let x357 = select(x251, -x251, b234);
    let x358 = select(x252, -x252, b234);
    let x359 = etendue_greater(x194, -x157 * (1.0f / sqrt(etendue_greater(x191, 1e-7f)))) * sqrt(x354);
    let x360 = 7.1525574e-7f * etendue_greater(x359, -x193);
    var x361 = fma(x153, fma(x86, x176, fma(x87, x177, x88 * x178)), x168);
    var x362 = x153 * fma(x120, x183, fma(x121, x185, x122 * x187));
    if (b192) {
        let x363 = -(x251 * x264);
        let x364 = -(x252 * x262);
        let x365 = -(x250 * x263);
        let x366 = x265 * x354;
        let x367 = x152 * (x152 * x366) / (1.0f + x152 * abs(fma(x83, x266, fma(x84, x267, x85 * x268))));
        let x368 = x153 * (x153 * x366) / (1.0f + x153 * abs(fma(x86, x266, fma(x87, x267, x88 * x268))));
        let x369 = x367 - x368;
        let x370 = select(x170 + x256, fma(x265 * (fma(x252, x263, x363) - fma(x251, x264, x363)), x269, x266 * x369), b270);
        let x371 = select(x171 + x257, fma(x265 * (fma(x250, x264, x364) - fma(x252, x262, x364)), x269, x267 * x369), b270);
        let x372 = select(x172 + x258, fma(x265 * (fma(x251, x262, x365) - fma(x250, x263, x365)), x269, x268 * x369), b270);
        let x373 = select(fma(x253, x259, fma(x254, x260, x255 * x261)), fma(x253, x370, fma(x254, x371, x255 * x372)), x188 < x157);
        x361 = select(x373, fma(x259, x370, fma(x260, x371, x261 * x372)), etendue_greater(x157, x188) < x155);
        x362 = -(x153 * (x152 * (x160 * fma(x131, x250, fma(x134, x251, x137 * x252)))));
    }
    let x374 = select(0.0f, 2.0f * etendue_angle(x233, x361), b241);
    let x375 = etendue_greater(fma(x233, x233, x361 * x361), 1e-36f);
    let x376 = 1.0f / sqrt(x375);
    let x377 = x233 * x376;
    let x378 = x361 * x376;
    let x379 = x376 * (x242 * x375);
    let x380 = x379 * (x163 * 0.5f);
    let b381 = x380 < 1e30f;
    let x382 = x361 * x242;
    let x383 = x361 - x168;
    var x384: f32;
    if (b192) {
        x384 = fma(x362, x362, x235 * x235) / (1.0f + abs(x188));
    }
    let x385 = 1.0f / etendue_greater(select(1.0f + x188, x384, b192 & b271), 1e-30f);
    let x386 = select(0.0f, etendue_lesser(x380 * (x235 * x385), 1e18f), b381);
    let x387 = select(0.0f, etendue_lesser(etendue_greater(x380 * fma(x362, -x385, x169), -1e18f), 1e18f), b381);
    var result: EtendueTriangleBySolidAngle;
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
    let x53 = x20 * (x40 + x51) / select(1.0f, x52, 0.0f < x52);
    let x54 = select(fma(x49, prepared.shape_l1 * fma(prepared.shape_inv_l0, x18, prepared.shape_inv_l2 * x19), x53), abs(fma(prepared.shape_normal.x, x46, fma(prepared.shape_normal.y, x47, prepared.shape_normal.z * x48))), b50);
    let b55 = (0.0f < x54) & (0.0f < prepared.shape_solid_angle);
    let x56 = select(0.0f, etendue_lesser(select(prepared.shape_l1, abs(prepared.shape_volume), b50) / select(1.0f, x54, b55), prepared.shape_farthest), b55);
    let x57 = etendue_lesser(x56 * (prepared.shape_inv_l2 * (x19 * x49)), 1.0f);
    let x58 = etendue_greater(1.0f - etendue_lesser(x56 * (prepared.shape_inv_l0 * (x18 * x49)), 1.0f) - x57, 0.0f);
    let x59 = select(etendue_lesser(x56 * (x53 / etendue_greater(prepared.shape_l1, 1e-37f)), 1.0f), x58, b50);
    let x60 = etendue_lesser(prepared.shape_unit * x56, 3.4028235e38f);
    var result: EtendueLightSample;
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
    let x39 = x22 * x31;
    let x40 = fma(x22, x31, -x39);
    let x41 = fma(x21, x32, -x39) - x40;
    let x42 = x20 * x32;
    let x43 = fma(x20, x32, -x42);
    let x44 = fma(x22, x30, -x42) - x43;
    let x45 = x21 * x30;
    let x46 = fma(x21, x30, -x45);
    let x47 = fma(x20, x31, -x45) - x46;
    let x48 = abs(x41);
    let x49 = abs(x44);
    let x50 = etendue_pow2_scale(etendue_greater(etendue_greater(x48, x49), abs(x47)));
    let x51 = x41 * x50;
    let x52 = x44 * x50;
    let x53 = x47 * x50;
    let x54 = fma(x51, x51, fma(x52, x52, x53 * x53));
    let x55 = select(0.0f, 1.0f / sqrt(x54), 0.0f < x54);
    let x56 = x51 * x55;
    let x57 = x52 * x55;
    let x58 = x53 * x55;
    let x59 = x54 * x55 / x50;
    let x60 = x12 * x47;
    let x61 = fma(x10, x41, fma(x11, x44, x60));
    let b62 = abs(x61 + x61) < fma(x48, abs(x10), fma(x49, abs(x11), abs(x60)));
    let x63 = x10 + x13;
    let x64 = x11 + x14;
    let x65 = x12 + x15;
    let x66 = x16 + x63;
    let x67 = x17 + x64;
    let x68 = x18 + x65;
    let x69 = x10 + x16;
    let x70 = x11 + x17;
    let x71 = x12 + x18;
    let x72 = x10 * x20;
    let x73 = x11 * x21;
    let x74 = x12 * x22;
    let x75 = x72 + x73;
    let x76 = x75 - x72;
    let x77 = x74 + x75;
    let x78 = x77 - x75;
    let x79 = x72 - (x75 - x76) + (x73 - x76) + (x75 - (x77 - x78) + (x74 - x78));
    let x80 = fma(x10, x20, -x72) + (fma(x11, x21, -x73) + fma(x12, x22, -x74));
    let x81 = x79 + x80;
    let x82 = x13 * x20;
    let x83 = x14 * x21;
    let x84 = x15 * x22;
    let x85 = x82 + x83;
    let x86 = x85 - x82;
    let x87 = x84 + x85;
    let x88 = x87 - x85;
    let x89 = x82 - (x85 - x86) + (x83 - x86) + (x85 - (x87 - x88) + (x84 - x88));
    let x90 = fma(x13, x20, -x82) + (fma(x14, x21, -x83) + fma(x15, x22, -x84));
    let x91 = x24 * (x77 + x81);
    let x92 = x77 + x87;
    let x93 = x92 - x77;
    let x94 = x77 - (x92 - x93) + (x87 - x93) + (x81 + (x89 + x90));
    let x95 = x24 * (x92 + x94);
    let b96 = x91 + x95 < 0.0f;
    let x97 = etendue_greater(select(x91, -x95, b96), x28 * -0.5f);
    let x98 = x28 + x97;
    let x99 = x10 * x30;
    let x100 = x11 * x31;
    let x101 = x12 * x32;
    let x102 = x99 + x100;
    let x103 = x102 - x99;
    let x104 = x101 + x102;
    let x105 = x104 - x102;
    let x106 = x99 - (x102 - x103) + (x100 - x103) + (x102 - (x104 - x105) + (x101 - x105));
    let x107 = fma(x10, x30, -x99) + (fma(x11, x31, -x100) + fma(x12, x32, -x101));
    let x108 = x106 + x107;
    let x109 = x16 * x30;
    let x110 = x17 * x31;
    let x111 = x18 * x32;
    let x112 = x109 + x110;
    let x113 = x112 - x109;
    let x114 = x111 + x112;
    let x115 = x114 - x112;
    let x116 = x109 - (x112 - x113) + (x110 - x113) + (x112 - (x114 - x115) + (x111 - x115));
    let x117 = fma(x16, x30, -x109) + (fma(x17, x31, -x110) + fma(x18, x32, -x111));
    let x118 = x34 * (x104 + x108);
    let x119 = x104 + x114;
    let x120 = x119 - x104;
    let x121 = x104 - (x119 - x120) + (x114 - x120) + (x108 + (x116 + x117));
    let x122 = x34 * (x119 + x121);
    let b123 = x118 + x122 < 0.0f;
    let x124 = etendue_greater(select(x118, -x122, b123), x38 * -0.5f);
    let x125 = x38 + x124;
    let x126 = select(x25, -x25, b96);
    let x127 = select(x26, -x26, b96);
    let x128 = select(x27, -x27, b96);
    let x129 = select(x35, -x35, b123);
    let x130 = select(x36, -x36, b123);
    let x131 = select(x37, -x37, b123);
    let b132 = x98 <= x97 + x97;
    let b133 = x125 <= x124 + x124;
    let x134 = select(0.0f, x98, b132);
    let x135 = select(0.0f, x125, b133);
    let x136 = x98 - x134;
    let x137 = x125 - x135;
    let x138 = select(select(x66, x63, b123), select(x69, x10, b123), b96) - x126 * x136 - x129 * x137;
    let x139 = select(select(x67, x64, b123), select(x70, x11, b123), b96) - x127 * x136 - x130 * x137;
    let x140 = select(select(x68, x65, b123), select(x71, x12, b123), b96) - x128 * x136 - x131 * x137;
    let x141 = x124 * x125;
    let b142 = x124 < 0.0f;
    let x143 = x98 * x98;
    let x144 = abs(x124);
    let x145 = x38 * (x124 + x125);
    let x146 = abs(x141);
    let b147 = x97 < 0.0f;
    let x148 = -x97 * -x97;
    let b149 = b142 | b147;
    let b150 = b142 & !b147;
    let x151 = select(x97, x124, b150);
    let x152 = select(x124, x97, b150);
    let x153 = select(x98, x125, b150);
    let x154 = select(x125, x98, b150);
    let x155 = x152 * x154;
    let b156 = 0.0f <= x152;
    let x157 = abs(x152);
    let x158 = select(x38, x28, b150) * (x152 + x154);
    let x159 = x151 * x153;
    let x160 = x11 * x15;
    let x161 = x12 * x14;
    let x162 = x160 - x161;
    let x163 = x162 - x160;
    let x164 = x160 - (x162 - x163) + (-x161 - x163) + (fma(x11, x15, -x160) - fma(x12, x14, -x161));
    let x165 = x12 * x13;
    let x166 = x10 * x15;
    let x167 = x165 - x166;
    let x168 = x167 - x165;
    let x169 = x165 - (x167 - x168) + (-x166 - x168) + (fma(x12, x13, -x165) - fma(x10, x15, -x166));
    let x170 = x10 * x14;
    let x171 = x11 * x13;
    let x172 = x170 - x171;
    let x173 = x172 - x170;
    let x174 = x170 - (x172 - x173) + (-x171 - x173) + (fma(x10, x14, -x170) - fma(x11, x13, -x171));
    let x175 = x11 * x18;
    let x176 = x12 * x17;
    let x177 = x175 - x176;
    let x178 = x177 - x175;
    let x179 = x175 - (x177 - x178) + (-x176 - x178) + (fma(x11, x18, -x175) - fma(x12, x17, -x176));
    let x180 = x12 * x16;
    let x181 = x10 * x18;
    let x182 = x180 - x181;
    let x183 = x182 - x180;
    let x184 = x180 - (x182 - x183) + (-x181 - x183) + (fma(x12, x16, -x180) - fma(x10, x18, -x181));
    let x185 = x10 * x17;
    let x186 = x11 * x16;
    let x187 = x185 - x186;
    let x188 = x187 - x185;
    let x189 = x185 - (x187 - x188) + (-x186 - x188) + (fma(x10, x17, -x185) - fma(x11, x16, -x186));
    let x190 = x14 * x18;
    let x191 = x15 * x17;
    let x192 = x190 - x191;
    let x193 = x192 - x190;
    let x194 = x190 - (x192 - x193) + (-x191 - x193) + (fma(x14, x18, -x190) - fma(x15, x17, -x191));
    let x195 = x15 * x16;
    let x196 = x13 * x18;
    let x197 = x195 - x196;
    let x198 = x197 - x195;
    let x199 = x195 - (x197 - x198) + (-x196 - x198) + (fma(x15, x16, -x195) - fma(x13, x18, -x196));
    let x200 = x13 * x17;
    let x201 = x14 * x16;
    let x202 = x200 - x201;
    let x203 = x202 - x200;
    let x204 = x200 - (x202 - x203) + (-x201 - x203) + (fma(x13, x17, -x200) - fma(x14, x16, -x201));
    let x205 = -x177 - x179;
    let x206 = -x182 - x184;
    let x207 = -x187 - x189;
    let x208 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x205), abs(x206)), abs(x207)));
    let x209 = x205 * x208;
    let x210 = x206 * x208;
    let x211 = x207 * x208;
    let x212 = fma(x209, x209, fma(x210, x210, x211 * x211));
    let x213 = select(0.0f, 1.0f / sqrt(x212), 0.0f < x212);
    let x214 = x209 * x213;
    let x215 = x210 * x213;
    let x216 = x211 * x213;
    let x217 = x212 * x213 / x208;
    let x218 = select(0.0f, -fma(x10, x69, fma(x11, x70, x12 * x71)) / x217, 0.0f < x217);
    let x219 = etendue_lesser(etendue_greater(x218, 1.0f), 1e18f) * 4.7683716e-7f;
    let x220 = x177 + x192;
    let x221 = x220 - x177;
    let x222 = x182 + x197;
    let x223 = x222 - x182;
    let x224 = x187 + x202;
    let x225 = x224 - x187;
    let x226 = x220 + (x177 - (x220 - x221) + (x192 - x221) + (x179 + x194));
    let x227 = x222 + (x182 - (x222 - x223) + (x197 - x223) + (x184 + x199));
    let x228 = x224 + (x187 - (x224 - x225) + (x202 - x225) + (x189 + x204));
    let x229 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x226), abs(x227)), abs(x228)));
    let x230 = x226 * x229;
    let x231 = x227 * x229;
    let x232 = x228 * x229;
    let x233 = fma(x230, x230, fma(x231, x231, x232 * x232));
    let x234 = select(0.0f, 1.0f / sqrt(x233), 0.0f < x233);
    let x235 = x230 * x234;
    let x236 = x231 * x234;
    let x237 = x232 * x234;
    let x238 = x233 * x234 / x229;
    let x239 = select(0.0f, -fma(x63, x66, fma(x64, x67, x65 * x68)) / x238, 0.0f < x238);
    let x240 = 4.7683716e-7f * etendue_lesser(etendue_greater(x239, 1.0f), 1e18f);
    let x241 = x162 + x164;
    let x242 = x167 + x169;
    let x243 = x172 + x174;
    let x244 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x241), abs(x242)), abs(x243)));
    let x245 = x241 * x244;
    let x246 = x242 * x244;
    let x247 = x243 * x244;
    let x248 = fma(x245, x245, fma(x246, x246, x247 * x247));
    let x249 = select(0.0f, 1.0f / sqrt(x248), 0.0f < x248);
    let x250 = x245 * x249;
    let x251 = x246 * x249;
    let x252 = x247 * x249;
    let x253 = x248 * x249 / x244;
    let x254 = select(0.0f, -fma(x10, x63, fma(x11, x64, x12 * x65)) / x253, 0.0f < x253);
    let x255 = 4.7683716e-7f * etendue_lesser(etendue_greater(x254, 1.0f), 1e18f);
    let x256 = x192 - x162;
    let x257 = x256 - x192;
    let x258 = x197 - x167;
    let x259 = x258 - x197;
    let x260 = x202 - x172;
    let x261 = x260 - x202;
    let x262 = x192 - (x256 - x257) + (-x162 - x257) + (x194 - x164);
    let x263 = x197 - (x258 - x259) + (-x167 - x259) + (x199 - x169);
    let x264 = x202 - (x260 - x261) + (-x172 - x261) + (x204 - x174);
    let x265 = x256 + x262;
    let x266 = x258 + x263;
    let x267 = x260 + x264;
    let x268 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x265), abs(x266)), abs(x267)));
    let x269 = x265 * x268;
    let x270 = x266 * x268;
    let x271 = x267 * x268;
    let x272 = fma(x269, x269, fma(x270, x270, x271 * x271));
    let x273 = select(0.0f, 1.0f / sqrt(x272), 0.0f < x272);
    let x274 = x269 * x273;
    let x275 = x270 * x273;
    let x276 = x271 * x273;
    let x277 = x272 * x273 / x268;
    let x278 = select(0.0f, -fma(x66, x69, fma(x67, x70, x68 * x71)) / x277, 0.0f < x277);
    let x279 = 4.7683716e-7f * etendue_lesser(etendue_greater(x278, 1.0f), 1e18f);
    let x280 = select(x219, x240, b96);
    let x281 = select(x255, x279, b123);
    let x282 = select(x240, x219, b96);
    let x283 = select(x279, x255, b123);
    let x284 = select(0.0f, 1.0f, b132);
    let x285 = select(0.0f, 1.0f, b133);
    let x286 = select(0.0f, 1.0f, b96);
    let x287 = select(0.0f, 1.0f, b123);
    let x288 = select(2.0f, 0.5f, b147);
    let x289 = 1.0f / x9;
    let x290 = etendue_pow2_scale(x5);
    let b291 = x5 < etendue_from_bits(0x7f800000u);
    let x292 = x290 * select(0.0f, light.edge_s.x, b291);
    let x293 = x290 * select(0.0f, light.edge_s.y, b291);
    let x294 = x290 * select(0.0f, light.edge_s.z, b291);
    let x295 = etendue_pow2_scale(x6);
    let b296 = x6 < etendue_from_bits(0x7f800000u);
    let x297 = x295 * select(0.0f, light.edge_t.x, b296);
    let x298 = x295 * select(0.0f, light.edge_t.y, b296);
    let x299 = x295 * select(0.0f, light.edge_t.z, b296);
    let x300 = x294 * x298;
    let x301 = fma(x294, x298, -x300);
    let x302 = fma(x293, x299, -x300) - x301;
    let x303 = x292 * x299;
    let x304 = fma(x292, x299, -x303);
    let x305 = fma(x294, x297, -x303) - x304;
    let x306 = x293 * x297;
    let x307 = fma(x293, x297, -x306);
    let x308 = fma(x292, x298, -x306) - x307;
    let x309 = abs(x302);
    let x310 = abs(x305);
    let x311 = etendue_pow2_scale(etendue_greater(etendue_greater(x309, x310), abs(x308)));
    let x312 = x302 * x311;
    let x313 = x305 * x311;
    let x314 = x308 * x311;
    let x315 = fma(x312, x312, fma(x313, x313, x314 * x314));
    let x316 = select(0.0f, 1.0f / sqrt(x315), 0.0f < x315);
    let x317 = x312 * x316;
    let x318 = x313 * x316;
    let x319 = x314 * x316;
    let x320 = x315 * x316 / x311;
    let x321 = etendue_greater(etendue_greater(etendue_greater(0.0f, x4), x5), x6);
    let b322 = x321 < etendue_from_bits(0x7f800000u);
    let x323 = etendue_pow2_scale(x321);
    let x324 = x323 * select(0.0f, x1, b322);
    let x325 = x323 * select(0.0f, x2, b322);
    let x326 = x323 * select(0.0f, x3, b322);
    let x327 = x323 * select(0.0f, light.edge_s.x, b322);
    let x328 = x323 * select(0.0f, light.edge_s.y, b322);
    let x329 = x323 * select(0.0f, light.edge_s.z, b322);
    let x330 = x323 * select(0.0f, light.edge_t.x, b322);
    let x331 = x323 * select(0.0f, light.edge_t.y, b322);
    let x332 = x323 * select(0.0f, light.edge_t.z, b322);
    let x333 = x308 * x326;
    let x334 = fma(x302, x324, fma(x305, x325, x333));
    let b335 = abs(x334 + x334) < fma(x309, abs(x324), fma(x310, abs(x325), abs(x333)));
    let x336 = x320 * (x323 / x290) * (x323 / x295);
    let x337 = x317 * x336;
    let x338 = x318 * x336;
    let x339 = x319 * x336;
    let x340 = -(x326 * x328);
    let x341 = fma(x325, x329, x340) - fma(x326, x328, x340);
    let x342 = -(x324 * x329);
    let x343 = fma(x326, x327, x342) - fma(x324, x329, x342);
    let x344 = -(x325 * x327);
    let x345 = fma(x324, x328, x344) - fma(x325, x327, x344);
    let x346 = -(x326 * x331);
    let x347 = fma(x325, x332, x346) - fma(x326, x331, x346);
    let x348 = -(x324 * x332);
    let x349 = fma(x326, x330, x348) - fma(x324, x332, x348);
    let x350 = -(x325 * x330);
    let x351 = fma(x324, x331, x350) - fma(x325, x330, x350);
    let x352 = 1.0f / x323;
    var x353: f32;
    if (b62) {
        let x354 = x21 * x32;
        let x355 = x354 - x39;
        let x356 = x355 - x354;
        let x357 = x354 - (x355 - x356) + (-x39 - x356) + (fma(x21, x32, -x354) - x40);
        let x358 = x22 * x30;
        let x359 = x358 - x42;
        let x360 = x359 - x358;
        let x361 = x358 - (x359 - x360) + (-x42 - x360) + (fma(x22, x30, -x358) - x43);
        let x362 = x20 * x31;
        let x363 = x362 - x45;
        let x364 = x363 - x362;
        let x365 = x362 - (x363 - x364) + (-x45 - x364) + (fma(x20, x31, -x362) - x46);
        let x366 = x10 * x355;
        let x367 = x11 * x359;
        let x368 = x12 * x363;
        let x369 = x366 + x367;
        let x370 = x369 - x366;
        let x371 = x368 + x369;
        let x372 = x371 - x369;
        let x373 = x366 - (x369 - x370) + (x367 - x370) + (x369 - (x371 - x372) + (x368 - x372));
        let x374 = fma(x10, x355, -x366) + (fma(x11, x359, -x367) + fma(x12, x363, -x368));
        x353 = x371 + (x373 + x374 + fma(x10, x357, fma(x11, x361, x12 * x365)));
    }
    let x375 = select(0.0f, select(x61, x353, b62) / x59, 0.0f < x59);
    let x376 = abs(x375);
    let x377 = etendue_copysign(1.0f, x375);
    let b378 = etendue_greater(x136, x137) <= etendue_greater(etendue_greater(x134, x135), x376);
    let x379 = select(fma(x126, x134, fma(x129, x135, x56 * x375)), x138, b378);
    let x380 = select(fma(x127, x134, fma(x130, x135, x57 * x375)), x139, b378);
    let x381 = select(fma(x128, x134, fma(x131, x135, x58 * x375)), x140, b378);
    let x382 = x376 * x376;
    let x383 = sqrt(fma(x124, x124, x382) * fma(x125, x125, x382));
    let x384 = select(0.0f, 1.0f / x383, 0.0f < x383);
    let x385 = x382 + x143;
    let x386 = sqrt(fma(x124, x124, x385));
    let x387 = fma(x125, x125, x385);
    let x388 = sqrt(x387);
    let x389 = x386 * x388;
    let x390 = select(0.0f, 1.0f / x385, 0.0f < x385);
    let x391 = fma(x125, x386, x388 * x144);
    let x392 = x389 + x146;
    let x393 = select(select(0.0f, x145 / x391, 0.0f < x391), x390 * x391, b142) * (x376 * x98);
    let x394 = x384 * x393;
    let x395 = x384 * (x390 * fma(x141, x143, x382 * x389));
    let x396 = x384 * (x38 * (x38 * x382));
    let x397 = 1.0f + select(0.0f, fma(x124, x124, x387) / x392, 0.0f < x392);
    let x398 = x385 + x392;
    let x399 = select(x398, x385 * x397, b142);
    let x400 = select(0.0f, x396 / x399, 0.0f < x399);
    let x401 = x382 * x384;
    let x402 = x401 * select(x397, x390 * x398, b142);
    let x403 = x382 + x148;
    let x404 = sqrt(fma(x124, x124, x403));
    let x405 = fma(x125, x125, x403);
    let x406 = sqrt(x405);
    let x407 = x404 * x406;
    let x408 = select(0.0f, 1.0f / x403, 0.0f < x403);
    let x409 = fma(x125, x404, x144 * x406);
    let x410 = x146 + x407;
    let x411 = select(select(0.0f, x145 / x409, 0.0f < x409), x408 * x409, b142) * (x376 * -x97);
    let x412 = x384 * x411;
    let x413 = x384 * (x408 * fma(x141, x148, x382 * x407));
    let x414 = 1.0f + select(0.0f, fma(x124, x124, x405) / x410, 0.0f < x410);
    let x415 = x403 + x410;
    let x416 = select(x415, x403 * x414, b142);
    let x417 = select(0.0f, x396 / x416, 0.0f < x416);
    let x418 = x401 * select(x414, x408 * x415, b142);
    let x419 = fma(x151, x151, x382);
    let x420 = fma(x153, x153, x382);
    let x421 = sqrt(fma(x152, x152, x419));
    let x422 = sqrt(fma(x154, x154, x419));
    let x423 = sqrt(fma(x152, x152, x420));
    let x424 = sqrt(fma(x154, x154, x420));
    let x425 = fma(x154, x423, x424 * x157);
    let x426 = select(x425, select(0.0f, x420 * x158 / x425, 0.0f < x425), b156) * (x376 * abs(x153));
    let x427 = fma(x154, x421, x422 * x157);
    let x428 = select(x427, select(0.0f, x419 * x158 / x427, 0.0f < x427), b156) * (x376 * abs(x151));
    let x429 = x421 * x422;
    let x430 = x38 * (x28 * x376);
    let x431 = x382 + (x155 + x159);
    let x432 = fma(x424, x421 * x423, fma(x424, x159 + fma(x152, x152, x382), fma(x423, x431, x421 * (x420 + x155))));
    let x433 = fma(x424, x429, fma(x421, x159 + fma(x154, x154, x382), fma(x422, x431, x424 * (x419 + x155))));
    let x434 = etendue_angle(select(x430, x426, b149), select(x432, fma(x155, x153 * x153, x382 * (x423 * x424)), b149));
    let x435 = x434 + etendue_angle(select(x430, x428, b149), select(x433, fma(x155, x151 * x151, x382 * x429), b149));
    let x436 = x435 * select(2.0f, 1.0f, b149);
    let b437 = 0.0f < x394;
    let b438 = b8 & (1e-36f < x436) & (x436 < 7.0f) & b437 & (1e-18f < x376);
    let b439 = x377 < 0.0f;
    let x440 = select(x214, -x214, b439);
    let x441 = select(x215, -x215, b439);
    let x442 = select(x216, -x216, b439);
    let x443 = select(x235, -x235, b439);
    let x444 = select(x236, -x236, b439);
    let x445 = select(x237, -x237, b439);
    let x446 = select(x250, -x250, b439);
    let x447 = select(x251, -x251, b439);
    let x448 = select(x252, -x252, b439);
    let x449 = select(x274, -x274, b439);
    let x450 = select(x275, -x275, b439);
    let x451 = select(x276, -x276, b439);
    let x452 = select(x440, x443, b96);
    let x453 = select(x441, x444, b96);
    let x454 = select(x442, x445, b96);
    let x455 = select(x443, x440, b96);
    let x456 = select(x444, x441, b96);
    let x457 = select(x445, x442, b96);
    let x458 = select(x446, x449, b123);
    let x459 = select(x447, x450, b123);
    let x460 = select(x448, x451, b123);
    let x461 = select(x449, x446, b123);
    let x462 = select(x450, x447, b123);
    let x463 = select(x451, x448, b123);
    let x464 = x56 * x377;
    let x465 = x57 * x377;
    let x466 = x58 * x377;
    let x467 = select(0.0f, 1.0f / x394, b437);
    let x468 = select(0.0f, x436, b438);
    var x469: f32;
    if (b335) {
        let x470 = x293 * x299;
        let x471 = x470 - x300;
        let x472 = x471 - x470;
        let x473 = x470 - (x471 - x472) + (-x300 - x472) + (fma(x293, x299, -x470) - x301);
        let x474 = x294 * x297;
        let x475 = x474 - x303;
        let x476 = x475 - x474;
        let x477 = x474 - (x475 - x476) + (-x303 - x476) + (fma(x294, x297, -x474) - x304);
        let x478 = x292 * x298;
        let x479 = x478 - x306;
        let x480 = x479 - x478;
        let x481 = x478 - (x479 - x480) + (-x306 - x480) + (fma(x292, x298, -x478) - x307);
        let x482 = x324 * x471;
        let x483 = x325 * x475;
        let x484 = x326 * x479;
        let x485 = x482 + x483;
        let x486 = x485 - x482;
        let x487 = x484 + x485;
        let x488 = x487 - x485;
        let x489 = x482 - (x485 - x486) + (x483 - x486) + (x485 - (x487 - x488) + (x484 - x488));
        let x490 = fma(x324, x471, -x482) + (fma(x325, x475, -x483) + fma(x326, x479, -x484));
        x469 = x487 + (x489 + x490 + fma(x324, x473, fma(x325, x477, x326 * x481)));
    }
    let x491 = etendue_lesser(etendue_greater(select(0.0f, select(x334, x469, b335) / x320, 1e-37f < abs(x320)), -1e37f), 1e37f);
    var result: EtendueRectangleBySolidAngle;
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
    let x57 = etendue_greater(select(0.0f, select(prepared.shape_far.x - x20, -x20, b17) / prepared.shape_size.x, 0.0f < prepared.shape_size.x), 0.0f);
    let x58 = etendue_lesser(x57, 1.0f);
    let x59 = select(1.0f - x58, x58, b1);
    let x60 = etendue_greater(select(0.0f, select(prepared.shape_far.y - x46, -x46, b43) / prepared.shape_size.y, 0.0f < prepared.shape_size.y), 0.0f);
    let x61 = etendue_lesser(x60, 1.0f);
    let x62 = select(1.0f - x61, x61, b23);
    let x63 = select(0.0f, 1.0f / prepared.shape_solid_angle, b55);
    let b64 = prepared.shape_side < 0.0f;
    let x65 = select(0.0f, 1.0f / x63, b64 & (1e-37f < x63));
    var result: EtendueLightSample;
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
// of the foot). pdf 5e-7 relative, since coordinates, and heights whose terms cancel, are formed in twice the working
// precision. Next to the plane of a rectangle that surrounds the point, nearly all of u0 lies within the rounding of a
// direction at the ends: the inverse is then one of the u that lead back to the direction.
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
    let x1 = select(0.0f, light.one_minus_cos, 0.0f <= fma(light.direction.x, light.direction.x, fma(light.direction.y, light.direction.y, light.direction.z * light.direction.z)));
    let x2 = etendue_copysign(1.0f, light.direction.z);
    let x3 = -1.0f / (light.direction.z + x2);
    let x4 = x3 * (light.direction.x * light.direction.y);
    let x5 = light.direction.x * x2;
    let x6 = fma(light.direction.x, x3 * x5, 1.0f);
    let x7 = x2 * x4;
    let x8 = -x5;
    let x9 = fma(light.direction.y, light.direction.y * x3, x2);
    let x10 = -light.direction.y;
    var result: EtendueSunBySolidAngle;
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
    let x18 = -x13 - light.axis.x;
    let x19 = -x14 - light.axis.y;
    let x20 = -x15 - light.axis.z;
    let x21 = fma(x18, x18, fma(x19, x19, x20 * x20)) * 0.5f;
    let x22 = light.one_minus_cos_outer - light.one_minus_cos_inner;
    let b23 = 0.0f < x22;
    let x24 = etendue_lesser(etendue_greater((light.one_minus_cos_outer - x21) / select(1.0f, x22, b23), 0.0f), 1.0f);
    let x25 = select(select(0.0f, 1.0f, x21 <= light.one_minus_cos_inner), x24 * x24 * (3.0f - (x24 + x24)), b23);
    let b26 = 0.0f < x25;
    let x27 = select(0.0f, x17, x17 < 1e37f) / select(1.0f, x25, b26);
    let x28 = select(0.0f, x27, b26 & (x27 < 1e37f));
    var result: EtendueSpotLightByDelta;
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

