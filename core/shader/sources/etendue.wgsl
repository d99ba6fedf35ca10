// Light sampling for renderers, in WGSL. MIT or Apache-2.0.
// Written by `etendue-shader --language wgsl --lights sphere_by_solid_angle,triangle_by_solid_angle,rectangle_by_solid_angle,disk_by_area,sun,point_light,spot_light,directional_light --warps concentric_disk,cosine_hemisphere,ggx_visible_normals --tools all --functions sample,pdf,hit`.
//
// WGSL promises neither that `fma` rounds once, nor correctly rounded division and square roots, nor subnormal numbers, infinities and
// NaN. Where a device has all these, as most do, the functions return the bits of the Rust library `etendue`; elsewhere results differ in
// their last digits.

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
// concentric squares: keeps strata compact.
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
// squares: keeps strata compact.
fn etendue_concentric_disk_pdf(point: vec2<f32>) -> f32 {
    let x1 = select(0.0f, 0.31830987f, fma(point.x, point.x, point.y * point.y) <= 1.0000004f);
    return x1;
}

// Maps u, of which each number is in [0, 1), to a point. Directions with z >= 0 and the pdf z/pi per steradian.
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

// The density of a point; 0 outside of the range. Directions with z >= 0 and the pdf z/pi per steradian.
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

// The density of a point; 0 outside of the range. Visible normals of a GGX microsurface, per steradian.
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
// steradian. From inside, every direction.
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
    let x18 = etendue_greater(etendue_greater(0.0f, etendue_greater(etendue_greater(abs(prepared.surface_center.x), abs(prepared.surface_center.y)), abs(prepared.surface_center.z))), etendue_greater(etendue_greater(abs(prepared.surface_radius), 0.0f), 0.0f));
    let b19 = x18 < etendue_from_bits(0x7f800000u);
    let x20 = etendue_pow2_scale(x18);
    let x21 = x20 * select(0.0f, prepared.surface_center.x, b19);
    let x22 = x20 * select(0.0f, prepared.surface_center.y, b19);
    let x23 = x20 * select(0.0f, prepared.surface_center.z, b19);
    let x24 = x20 * select(0.0f, prepared.surface_radius, b19);
    let x25 = x21 * x21;
    let x26 = x22 * x22;
    let x27 = x23 * x23;
    let x28 = x24 * x24;
    let x29 = x25 - x28;
    let x30 = x29 - x25;
    let x31 = x26 + x29;
    let x32 = x31 - x29;
    let x33 = x27 + x31;
    let x34 = x33 - x31;
    let x35 = x25 - (x29 - x30) + (-x28 - x30) + (x29 - (x31 - x32) + (x26 - x32));
    let x36 = fma(x21, x21, -x25) - fma(x24, x24, -x28) + (fma(x22, x22, -x26) + fma(x23, x23, -x27));
    let x37 = x33 + (x31 - (x33 - x34) + (x27 - x34) + x35 + x36);
    let x38 = fma(x13, x21, fma(x14, x22, x15 * x23));
    let x39 = fma(x13, -x38, x21);
    let x40 = fma(x14, -x38, x22);
    let x41 = fma(x15, -x38, x23);
    let x42 = sqrt(etendue_greater(fma(x24, x24, -fma(x39, x39, fma(x40, x40, x41 * x41))), 0.0f));
    let x43 = x42 + abs(x38);
    let b44 = 1e-37f < abs(x43);
    let x45 = select(etendue_lesser(etendue_greater(select(0.0f, abs(x37) / select(1.0f, x43, b44), b44), -1e37f), 1e37f), x43, !(0.0f <= x37) & (0.0f <= x38));
    let x46 = fma(x13, x45, -x21);
    let x47 = fma(x14, x45, -x22);
    let x48 = fma(x15, x45, -x23);
    let x49 = fma(x46, x46, fma(x47, x47, x48 * x48));
    let x50 = select(0.0f, 1.0f / sqrt(x49), 0.0f < x49);
    let x51 = x46 * x50;
    let x52 = x47 * x50;
    let x53 = x48 * x50;
    let x54 = select(1.0f - x53, fma(x51, x51, x52 * x52) / (1.0f + abs(x53)), 0.5f < x53);
    let x55 = etendue_lesser(etendue_greater(x54 / 2.0f, 0.0f), 0.99999994f);
    let x56 = etendue_angle(x52, x51) * 0.15915494f;
    let x57 = etendue_lesser(etendue_greater(select(x56, 1.0f + x56, x56 < 0.0f), 0.0f), 0.99999994f);
    let b58 = 1e-37f < x6;
    let x59 = select(0.0f, 0.15915494f / select(1.0f, x6, b58), b58);
    let b60 = !(prepared.shape_power < 0.0f);
    let b61 = b60 & (1e-37f < x59);
    let x62 = select(0.0f, 1.0f / select(1.0f, x59, b61), b61);
    var result: EtendueLightSample;
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
fn etendue_sphere_by_solid_angle_pdf(prepared: EtendueSphereBySolidAngle, w: vec3<f32>) -> f32 {
    let x1 = fma(prepared.shape_frame_s.x, w.x, fma(prepared.shape_frame_s.y, w.y, prepared.shape_frame_s.z * w.z));
    let x2 = fma(prepared.shape_frame_t.x, w.x, fma(prepared.shape_frame_t.y, w.y, prepared.shape_frame_t.z * w.z));
    let x3 = fma(prepared.shape_frame_n.x, w.x, fma(prepared.shape_frame_n.y, w.y, prepared.shape_frame_n.z * w.z));
    let x4 = etendue_lesser(etendue_greater(prepared.shape_cone_one_minus_cos, 0.0f), 2.0f);
    let b5 = 1e-37f < x4;
    let x6 = select(1.0f - x3, fma(x1, x1, x2 * x2) / (1.0f + abs(x3)), 0.5f < x3);
    let x7 = x4 + fma(5.9604645e-7f, etendue_greater(sqrt(x4 * (2.0f - x4)), x4 - 1.0f), 1.7763568e-13f);
    let x8 = select(0.0f, select(0.0f, 0.15915494f / select(1.0f, x4, b5), b5), x6 <= x7);
    return x8;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian. From inside, every direction.
fn etendue_sphere_by_solid_angle_hit(prepared: EtendueSphereBySolidAngle, w: vec3<f32>) -> EtendueLightSample {
    let x1 = fma(prepared.shape_frame_s.x, w.x, fma(prepared.shape_frame_s.y, w.y, prepared.shape_frame_s.z * w.z));
    let x2 = fma(prepared.shape_frame_t.x, w.x, fma(prepared.shape_frame_t.y, w.y, prepared.shape_frame_t.z * w.z));
    let x3 = fma(prepared.shape_frame_n.x, w.x, fma(prepared.shape_frame_n.y, w.y, prepared.shape_frame_n.z * w.z));
    let x4 = etendue_lesser(etendue_greater(prepared.shape_cone_one_minus_cos, 0.0f), 2.0f);
    let b5 = 1e-37f < x4;
    let x6 = select(1.0f - x3, fma(x1, x1, x2 * x2) / (1.0f + abs(x3)), 0.5f < x3);
    let x7 = x4 + fma(5.9604645e-7f, etendue_greater(sqrt(x4 * (2.0f - x4)), x4 - 1.0f), 1.7763568e-13f);
    let x8 = select(0.0f, select(0.0f, 0.15915494f / select(1.0f, x4, b5), b5), x6 <= x7);
    let b9 = 0.0f < x8;
    let x10 = etendue_greater(etendue_greater(0.0f, etendue_greater(etendue_greater(abs(prepared.surface_center.x), abs(prepared.surface_center.y)), abs(prepared.surface_center.z))), etendue_greater(etendue_greater(abs(prepared.surface_radius), 0.0f), 0.0f));
    let b11 = x10 < etendue_from_bits(0x7f800000u);
    let x12 = etendue_pow2_scale(x10);
    let x13 = x12 * select(0.0f, prepared.surface_center.x, b11);
    let x14 = x12 * select(0.0f, prepared.surface_center.y, b11);
    let x15 = x12 * select(0.0f, prepared.surface_center.z, b11);
    let x16 = x12 * select(0.0f, prepared.surface_radius, b11);
    let x17 = x13 * x13;
    let x18 = x14 * x14;
    let x19 = x15 * x15;
    let x20 = x16 * x16;
    let x21 = x17 - x20;
    let x22 = x21 - x17;
    let x23 = x18 + x21;
    let x24 = x23 - x21;
    let x25 = x19 + x23;
    let x26 = x25 - x23;
    let x27 = x17 - (x21 - x22) + (-x20 - x22) + (x21 - (x23 - x24) + (x18 - x24));
    let x28 = fma(x13, x13, -x17) - fma(x16, x16, -x20) + (fma(x14, x14, -x18) + fma(x15, x15, -x19));
    let x29 = x25 + (x23 - (x25 - x26) + (x19 - x26) + x27 + x28);
    let x30 = fma(w.x, x13, fma(w.y, x14, w.z * x15));
    let x31 = fma(w.x, -x30, x13);
    let x32 = fma(w.y, -x30, x14);
    let x33 = fma(w.z, -x30, x15);
    let x34 = sqrt(etendue_greater(fma(x16, x16, -fma(x31, x31, fma(x32, x32, x33 * x33))), 0.0f));
    let x35 = x34 + abs(x30);
    let b36 = 1e-37f < abs(x35);
    let x37 = select(etendue_lesser(etendue_greater(select(0.0f, abs(x29) / select(1.0f, x35, b36), b36), -1e37f), 1e37f), x35, !(0.0f <= x29) & (0.0f <= x30));
    let x38 = fma(w.x, x37, -x13);
    let x39 = fma(w.y, x37, -x14);
    let x40 = fma(w.z, x37, -x15);
    let x41 = fma(x38, x38, fma(x39, x39, x40 * x40));
    let x42 = select(0.0f, 1.0f / sqrt(x41), 0.0f < x41);
    let x43 = x38 * x42;
    let x44 = x39 * x42;
    let x45 = x40 * x42;
    let x46 = select(1.0f - x45, fma(x43, x43, x44 * x44) / (1.0f + abs(x45)), 0.5f < x45);
    let x47 = etendue_lesser(etendue_greater(x46 / 2.0f, 0.0f), 0.99999994f);
    let x48 = 0.15915494f * etendue_angle(x44, x43);
    let x49 = etendue_lesser(etendue_greater(select(x48, 1.0f + x48, x48 < 0.0f), 0.0f), 0.99999994f);
    let x50 = select(0.0f, etendue_lesser(x37 / x12, 3.4028235e38f), b9);
    let b51 = !(prepared.shape_power < 0.0f) & b9;
    let b52 = b51 & (1e-37f < x8);
    let x53 = select(0.0f, 1.0f / select(1.0f, x8, b52), b52);
    var result: EtendueLightSample;
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
    let b64 = 1e-37f < abs(x54);
    let x65 = (x60 + (x62 + x63 + fma(x10, x31, fma(x11, x36, x12 * x41)))) / select(1.0f, x54, b64);
    let x66 = etendue_lesser(etendue_greater(select(0.0f, x65, b64), -1e37f), 1e37f);
    let x67 = x54 / x19 / x20;
    let x68 = x51 * x67;
    let x69 = x52 * x67;
    let x70 = x53 * x67;
    let x71 = -(x12 * x14);
    let x72 = fma(x11, x15, x71) - fma(x12, x14, x71);
    let x73 = -(x10 * x15);
    let x74 = fma(x12, x13, x73) - fma(x10, x15, x73);
    let x75 = -(x11 * x13);
    let x76 = fma(x10, x14, x75) - fma(x11, x13, x75);
    let x77 = -(x12 * x17);
    let x78 = fma(x11, x18, x77) - fma(x12, x17, x77);
    let x79 = -(x10 * x18);
    let x80 = fma(x12, x16, x79) - fma(x10, x18, x79);
    let x81 = -(x11 * x16);
    let x82 = fma(x10, x17, x81) - fma(x11, x16, x81);
    let x83 = 1.0f / x9;
    let x84 = light.e1.x + x1;
    let x85 = light.e1.y + x2;
    let x86 = light.e1.z + x3;
    let x87 = light.e2.x + x1;
    let x88 = light.e2.y + x2;
    let x89 = light.e2.z + x3;
    let x90 = etendue_greater(etendue_greater(x4, etendue_greater(etendue_greater(abs(x84), abs(x85)), abs(x86))), etendue_greater(etendue_greater(abs(x87), abs(x88)), abs(x89)));
    let x91 = etendue_greater(etendue_greater(x90, x5), x6);
    let b92 = x91 < etendue_from_bits(0x7f800000u);
    let x93 = etendue_pow2_scale(x91);
    let x94 = x93 * select(0.0f, x1, b92);
    let x95 = x93 * select(0.0f, x2, b92);
    let x96 = x93 * select(0.0f, x3, b92);
    let x97 = x93 * select(0.0f, x84, b92);
    let x98 = x93 * select(0.0f, x85, b92);
    let x99 = x93 * select(0.0f, x86, b92);
    let x100 = x93 * select(0.0f, x87, b92);
    let x101 = x93 * select(0.0f, x88, b92);
    let x102 = x93 * select(0.0f, x89, b92);
    let x103 = x93 * select(0.0f, light.e1.x, b92);
    let x104 = x93 * select(0.0f, light.e1.y, b92);
    let x105 = x93 * select(0.0f, light.e1.z, b92);
    let x106 = x93 * select(0.0f, light.e2.x, b92);
    let x107 = x93 * select(0.0f, light.e2.y, b92);
    let x108 = x93 * select(0.0f, light.e2.z, b92);
    let x109 = x104 * x108;
    let x110 = x105 * x107;
    let x111 = x109 - x110;
    let x112 = x111 - x109;
    let x113 = x109 - (x111 - x112) + (-x110 - x112) + (fma(x104, x108, -x109) - fma(x105, x107, -x110));
    let x114 = x105 * x106;
    let x115 = x103 * x108;
    let x116 = x114 - x115;
    let x117 = x116 - x114;
    let x118 = x114 - (x116 - x117) + (-x115 - x117) + (fma(x105, x106, -x114) - fma(x103, x108, -x115));
    let x119 = x103 * x107;
    let x120 = x104 * x106;
    let x121 = x119 - x120;
    let x122 = x121 - x119;
    let x123 = x119 - (x121 - x122) + (-x120 - x122) + (fma(x103, x107, -x119) - fma(x104, x106, -x120));
    let x124 = x111 + x113;
    let x125 = x116 + x118;
    let x126 = x121 + x123;
    let x127 = x94 * x111;
    let x128 = x95 * x116;
    let x129 = x96 * x121;
    let x130 = x127 + x128;
    let x131 = x130 - x127;
    let x132 = x129 + x130;
    let x133 = x132 - x130;
    let x134 = x127 - (x130 - x131) + (x128 - x131) + (x130 - (x132 - x133) + (x129 - x133));
    let x135 = fma(x94, x111, -x127) + (fma(x95, x116, -x128) + fma(x96, x121, -x129));
    let x136 = x132 + (x134 + x135 + fma(x94, x113, fma(x95, x118, x96 * x123)));
    let x137 = x95 * x108;
    let x138 = x96 * x107;
    let x139 = x137 - x138;
    let x140 = x139 - x137;
    let x141 = fma(x96, x107, -x138);
    let x142 = x137 - (x139 - x140) + (-x138 - x140) + (fma(x95, x108, -x137) - x141);
    let x143 = x96 * x106;
    let x144 = x94 * x108;
    let x145 = x143 - x144;
    let x146 = x145 - x143;
    let x147 = fma(x94, x108, -x144);
    let x148 = x143 - (x145 - x146) + (-x144 - x146) + (fma(x96, x106, -x143) - x147);
    let x149 = x94 * x107;
    let x150 = x95 * x106;
    let x151 = x149 - x150;
    let x152 = x151 - x149;
    let x153 = fma(x95, x106, -x150);
    let x154 = x149 - (x151 - x152) + (-x150 - x152) + (fma(x94, x107, -x149) - x153);
    let x155 = x96 * x104;
    let x156 = x95 * x105;
    let x157 = x155 - x156;
    let x158 = x157 - x155;
    let x159 = fma(x96, x104, -x155);
    let x160 = x155 - (x157 - x158) + (-x156 - x158) + (x159 - fma(x95, x105, -x156));
    let x161 = x94 * x105;
    let x162 = x96 * x103;
    let x163 = x161 - x162;
    let x164 = x163 - x161;
    let x165 = fma(x94, x105, -x161);
    let x166 = x161 - (x163 - x164) + (-x162 - x164) + (x165 - fma(x96, x103, -x162));
    let x167 = x95 * x103;
    let x168 = x94 * x104;
    let x169 = x167 - x168;
    let x170 = x169 - x167;
    let x171 = fma(x95, x103, -x167);
    let x172 = x167 - (x169 - x170) + (-x168 - x170) + (x171 - fma(x94, x104, -x168));
    let x173 = x139 + x157;
    let x174 = x173 - x139;
    let x175 = x145 + x163;
    let x176 = x175 - x145;
    let x177 = x151 + x169;
    let x178 = x177 - x151;
    let x179 = x111 + x173;
    let x180 = x179 - x111;
    let x181 = x116 + x175;
    let x182 = x181 - x116;
    let x183 = x121 + x177;
    let x184 = x183 - x121;
    let x185 = x113 + (x139 - (x173 - x174) + (x157 - x174) + (x142 + x160));
    let x186 = x118 + (x145 - (x175 - x176) + (x163 - x176) + (x148 + x166));
    let x187 = x123 + (x151 - (x177 - x178) + (x169 - x178) + (x154 + x172));
    let x188 = fma(x95, x105, -x155) - x159;
    let x189 = fma(x96, x103, -x161) - x165;
    let x190 = fma(x94, x104, -x167) - x171;
    let x191 = fma(x95, x108, -x138) - x141;
    let x192 = fma(x96, x106, -x144) - x147;
    let x193 = fma(x94, x107, -x150) - x153;
    let x194 = x179 + (x111 - (x179 - x180) + (x173 - x180) + x185);
    let x195 = x181 + (x116 - (x181 - x182) + (x175 - x182) + x186);
    let x196 = x183 + (x121 - (x183 - x184) + (x177 - x184) + x187);
    let x197 = fma(x94, x94, fma(x95, x95, x96 * x96));
    let x198 = fma(x97, x97, fma(x98, x98, x99 * x99));
    let x199 = fma(x100, x100, fma(x101, x101, x102 * x102));
    let x200 = select(0.0f, 1.0f / sqrt(x197), 1e-36f < x197);
    let x201 = select(0.0f, 1.0f / sqrt(x198), 1e-36f < x198);
    let x202 = select(0.0f, 1.0f / sqrt(x199), 1e-36f < x199);
    let x203 = fma(x94, x97, fma(x95, x98, x96 * x99));
    let x204 = x201 * (x200 * x203);
    let x205 = fma(x94, x100, fma(x95, x101, x96 * x102));
    let x206 = x202 * (x200 * x205);
    let x207 = fma(x188, x188, fma(x189, x189, x190 * x190));
    let x208 = sqrt(x207);
    let x209 = select(0.0f, 1.0f / x208, 1e-37f < x207);
    let x210 = x197 * x200;
    let x211 = x198 * x201;
    let x212 = x201 * (x200 * (x207 * x209));
    let x213 = x211 * (x209 * x210);
    let x214 = x213 * 2.0f;
    let x215 = x212 * x212 / (1.0f + abs(x204));
    let b216 = x204 < 0.0f;
    let x217 = select(1.0f + x204, x215, b216);
    let x218 = x213 * select(x215, 1.0f - x204, b216);
    let x219 = abs(x136);
    let x220 = x202 * (x201 * (x200 * x219));
    let x221 = x97 * x201;
    let x222 = x98 * x201;
    let x223 = x99 * x201;
    let x224 = x94 * x200;
    let x225 = x95 * x200;
    let x226 = x96 * x200;
    let x227 = x221 + x224;
    let x228 = x222 + x225;
    let x229 = x223 + x226;
    let b230 = x136 < 0.0f;
    let x231 = x188 * x209;
    let x232 = x189 * x209;
    let x233 = x190 * x209;
    let x234 = -(x223 * x232);
    let x235 = fma(x222, x233, x234) - fma(x223, x232, x234);
    let x236 = -(x221 * x233);
    let x237 = fma(x223, x231, x236) - fma(x221, x233, x236);
    let x238 = -(x222 * x231);
    let x239 = fma(x221, x232, x238) - fma(x222, x231, x238);
    let x240 = x202 * fma(x100, x221, fma(x101, x222, x102 * x223));
    let x241 = x202 * fma(x106 - x103, x235, fma(x107 - x104, x237, (x108 - x105) * x239));
    let x242 = x202 * (x209 * x219);
    let x243 = fma(x191, x191, fma(x192, x192, x193 * x193));
    let x244 = x200 * x202;
    let x245 = x244 * (x243 * x244);
    let b246 = etendue_lesser(etendue_lesser(x204, x206), x240) < -0.5f;
    let x247 = fma(x97, x100, fma(x98, x101, x99 * x102));
    let x248 = fma(x194, x194, fma(x195, x195, x196 * x196));
    let x249 = select(x231, -x231, b230);
    let x250 = select(x232, -x232, b230);
    let x251 = select(x233, -x233, b230);
    let x252 = x210 * x219;
    let b253 = 1e-37f < x252;
    let x254 = select(0.0f, fma(x188, x191, fma(x189, x192, x190 * x193)) / select(1.0f, x252, b253), b253);
    let b255 = (0.0f < x200) & (0.0f < x201) & (0.0f < x202) & (0.0f < x220);
    let x256 = 1.0f / select(1.0f, x220, 1e-37f < x220);
    let x257 = etendue_lesser(etendue_greater(-x204 / select(1.0f, x212, 0.0f < x212), 1.0f), 1e18f);
    let x258 = select(x188, -x188, b230);
    let x259 = select(x189, -x189, b230);
    let x260 = select(x190, -x190, b230);
    let x261 = select(x194, -x194, b230);
    let x262 = select(x195, -x195, b230);
    let x263 = select(x196, -x196, b230);
    let x264 = select(-x191, x191, b230);
    let x265 = select(-x192, x192, b230);
    let x266 = select(-x193, x193, b230);
    let x267 = etendue_greater(x208 * x257, -x203) * 7.1525574e-7f;
    let x268 = etendue_greater(x257, -x206 * (1.0f / sqrt(etendue_greater(x245, 1e-7f)))) * sqrt(x248);
    let x269 = 7.1525574e-7f * etendue_greater(x268, -x247);
    let x270 = 7.1525574e-7f * etendue_greater(x257 * sqrt(x243), -x205);
    let x271 = etendue_greater(etendue_greater(x210, x211), x199 * x202);
    let x272 = x217 * x256;
    let x273 = etendue_pow2_scale(x93);
    var x274 = fma(x202, fma(x100, x227, fma(x101, x228, x102 * x229)), x217);
    var x275 = x241;
    var b276: bool;
    var b277: bool;
    var x278: f32;
    if (b246) {
        let x279 = x97 - x94;
        let x280 = x98 - x95;
        let x281 = x99 - x96;
        let x282 = fma(x279, x279, fma(x280, x280, x281 * x281));
        let b283 = 1e-36f < x282;
        let x284 = 1.0f / sqrt(select(1.0f, x282, b283));
        let x285 = x284 * x284;
        let x286 = -(x189 * x281);
        let x287 = -(x190 * x279);
        let x288 = -(x188 * x280);
        let x289 = x207 * x285;
        let x290 = x279 * x284;
        let x291 = x280 * x284;
        let x292 = x281 * x284;
        let x293 = x200 + x201;
        let x294 = x200 * (x200 * x289) / (1.0f + x200 * abs(fma(x94, x290, fma(x95, x291, x96 * x292))));
        let x295 = x201 * (x201 * x289) / (1.0f + x201 * abs(fma(x97, x290, fma(x98, x291, x99 * x292))));
        let x296 = x294 - x295;
        let b297 = (x203 < 0.0f) & b283;
        let x298 = select(x227, fma(x285 * (fma(x190, x280, x286) - fma(x189, x281, x286)), x293, x290 * x296), b297);
        let x299 = select(x228, fma(x285 * (fma(x188, x281, x287) - fma(x190, x279, x287)), x293, x291 * x296), b297);
        let x300 = select(x229, fma(x285 * (fma(x189, x279, x288) - fma(x188, x280, x288)), x293, x292 * x296), b297);
        let x301 = x100 * x202;
        let x302 = x101 * x202;
        let x303 = x102 * x202;
        let x304 = x100 - x94;
        let x305 = x101 - x95;
        let x306 = x102 - x96;
        let x307 = fma(x304, x304, fma(x305, x305, x306 * x306));
        let b308 = 1e-36f < x307;
        let x309 = 1.0f / sqrt(select(1.0f, x307, b308));
        let x310 = x309 * x309;
        let x311 = -(x192 * x306);
        let x312 = -(x193 * x304);
        let x313 = -(x191 * x305);
        let x314 = x243 * x310;
        let x315 = x304 * x309;
        let x316 = x305 * x309;
        let x317 = x306 * x309;
        let x318 = x200 + x202;
        let x319 = x200 * (x200 * x314) / (1.0f + x200 * abs(fma(x94, x315, fma(x95, x316, x96 * x317))));
        let x320 = x202 * (x202 * x314) / (1.0f + x202 * abs(fma(x100, x315, fma(x101, x316, x102 * x317))));
        let x321 = x319 - x320;
        let b322 = (x205 < 0.0f) & b308;
        let x323 = select(x224 + x301, fma(x310 * (fma(x193, x305, x311) - fma(x192, x306, x311)), x318, x315 * x321), b322);
        let x324 = select(x225 + x302, fma(x310 * (fma(x191, x306, x312) - fma(x193, x304, x312)), x318, x316 * x321), b322);
        let x325 = select(x226 + x303, fma(x310 * (fma(x192, x304, x313) - fma(x191, x305, x313)), x318, x317 * x321), b322);
        let x326 = x100 - x97;
        let x327 = x101 - x98;
        let x328 = x102 - x99;
        let x329 = fma(x326, x326, fma(x327, x327, x328 * x328));
        let b330 = 1e-36f < x329;
        let x331 = 1.0f / sqrt(select(1.0f, x329, b330));
        let x332 = x331 * x331;
        let x333 = -(x195 * x328);
        let x334 = -(x196 * x326);
        let x335 = -(x194 * x327);
        let x336 = x332 * x248;
        let x337 = x326 * x331;
        let x338 = x327 * x331;
        let x339 = x328 * x331;
        let x340 = x201 + x202;
        let x341 = x201 * (x201 * x336) / (1.0f + x201 * abs(fma(x97, x337, fma(x98, x338, x99 * x339))));
        let x342 = x202 * (x202 * x336) / (1.0f + x202 * abs(fma(x100, x337, fma(x101, x338, x102 * x339))));
        let x343 = x341 - x342;
        let b344 = (x247 < 0.0f) & b330;
        let x345 = select(x221 + x301, fma(x332 * (fma(x196, x327, x333) - fma(x195, x328, x333)), x340, x337 * x343), b344);
        let x346 = select(x222 + x302, fma(x332 * (fma(x194, x328, x334) - fma(x196, x326, x334)), x340, x338 * x343), b344);
        let x347 = select(x223 + x303, fma(x332 * (fma(x195, x326, x335) - fma(x194, x327, x335)), x340, x339 * x343), b344);
        let x348 = select(fma(x298, x323, fma(x299, x324, x300 * x325)), fma(x298, x345, fma(x299, x346, x300 * x347)), x240 < x206);
        x274 = select(x348, fma(x323, x345, fma(x324, x346, x325 * x347)), etendue_greater(x206, x240) < x204);
        x275 = -(x202 * (x201 * (x209 * fma(x188, x194, fma(x189, x195, x190 * x196)))));
        b276 = x240 < 0.0f;
        b277 = x206 < 0.0f;
        x278 = x245 / (1.0f + abs(x206));
    }
    let x349 = select(1.0f + x206, x278, b246 & b277);
    let x350 = select(0.0f, 2.0f * etendue_angle(x220, x274), b255);
    let x351 = etendue_greater(fma(x220, x220, x274 * x274), 1e-36f);
    let x352 = 1.0f / sqrt(x351);
    let x353 = x220 * x352;
    let x354 = x274 * x352;
    let x355 = x352 * (x256 * x351);
    let x356 = x355 * (x212 * 0.5f);
    let b357 = x356 < 1e30f;
    let x358 = x274 * x256;
    let x359 = x274 - x217;
    var x360: f32;
    if (b246) {
        x360 = fma(x275, x275, x242 * x242) / (1.0f + abs(x240));
    }
    let x361 = 1.0f / etendue_greater(select(1.0f + x240, x360, b246 & b276), 1e-30f);
    let x362 = select(0.0f, etendue_lesser(x356 * (x242 * x361), 1e18f), b357);
    let x363 = select(0.0f, etendue_lesser(etendue_greater(x356 * fma(x275, -x361, x218), -1e18f), 1e18f), b357);
    var result: EtendueTriangleBySolidAngle;
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
    let b21 = 1e-37f < abs(prepared.shape_solid_angle);
    let x22 = etendue_lesser(etendue_greater(select(0.0f, 1.0f / select(1.0f, prepared.shape_solid_angle, b21), b21), -1e37f), 1e37f);
    let b23 = prepared.shape_volume < 0.0f;
    let b24 = b23 & (1e-37f < x22);
    let x25 = select(0.0f, 1.0f / select(1.0f, x22, b24), b24);
    var b26: bool;
    var x27: f32;
    var x28: f32;
    if (b11) {
        let x29 = fma(x19, prepared.shape_one_plus_d02 - 1.0f, x18);
        let x30 = select(1.0f - x29, prepared.shape_sin02_squared * (x19 * x19) / (1.0f + etendue_greater(x29, 0.0f)), 0.0f < x29);
        let x31 = fma(prepared.shape_g2, x18, x30 + prepared.shape_g1 * x19);
        let x32 = 1.0f / etendue_greater(x31, 1e-30f);
        let x33 = x32 * (prepared.shape_sin_side * x18);
        let x34 = x32 * (prepared.shape_x2 * x19);
        let b35 = (fma(prepared.shape_g2, x18, x30 + x19 * abs(prepared.shape_g1)) * 0.125f < x31) & (0.5f < x18 + x19);
        b26 = b35 & (x33 + abs(x34) < etendue_greater(prepared.shape_tan_half, abs(x8)));
        x27 = etendue_lesser(etendue_greater(x33 + x34, -1000000000000000.0f), 1000000000000000.0f);
        x28 = etendue_lesser(x32 * (prepared.shape_y2 * x19), 1000000000000000.0f);
    }
    let x36 = select(x8, x27, b26);
    let x37 = select(x9, x28, b26);
    let x38 = fma(x36, x36, x37 * x37);
    let x39 = 1.0f + x38;
    let x40 = 2.0f / x39;
    let x41 = u.y * x40;
    let x42 = fma(x38, -x41, 1.0f);
    let x43 = sqrt(etendue_greater(x41 * (x40 * fma(x38, x20, 1.0f)), 0.0f));
    let x44 = fma(prepared.shape_apex.x, x42, x43 * fma(prepared.shape_along.x, x36, prepared.shape_across.x * x37));
    let x45 = fma(prepared.shape_apex.y, x42, x43 * fma(prepared.shape_along.y, x36, prepared.shape_across.y * x37));
    let x46 = fma(prepared.shape_apex.z, x42, x43 * fma(prepared.shape_along.z, x36, prepared.shape_across.z * x37));
    let x47 = fma(fma(x44, x44, fma(x45, x45, x46 * x46)), -0.5f, 1.5f);
    let x48 = x44 * x47;
    let x49 = x45 * x47;
    let x50 = x46 * x47;
    let x51 = x39 * (0.5f * x43);
    let b52 = 1.0f < x38;
    let x53 = abs(1.0f - x38) / x39;
    let x54 = (1.0f + x53) * fma(x51, x53, x42);
    let x55 = fma(x51, prepared.shape_l1 * fma(prepared.shape_inv_l0, x18, prepared.shape_inv_l2 * x19), x20 * (x42 + x53) / select(1.0f, x54, 0.0f < x54));
    let x56 = select(x55, abs(fma(prepared.shape_normal.x, x48, fma(prepared.shape_normal.y, x49, prepared.shape_normal.z * x50))), b52);
    let b57 = (0.0f < x56) & (0.0f < prepared.shape_solid_angle);
    let x58 = etendue_lesser(prepared.shape_unit * etendue_lesser(select(prepared.shape_l1, abs(prepared.shape_volume), b52) / select(1.0f, x56, b57), prepared.shape_farthest), 3.4028235e38f);
    let x59 = select(0.0f, x58, b57);
    let x60 = fma(prepared.surface_plane_cross.x, x48, fma(prepared.surface_plane_cross.y, x49, prepared.surface_plane_cross.z * x50));
    let b61 = 1e-37f < abs(x60);
    let x62 = select(1.0f, x60, b61);
    let x63 = etendue_greater(select(0.0f, -fma(prepared.surface_plane_along_second.x, x48, fma(prepared.surface_plane_along_second.y, x49, prepared.surface_plane_along_second.z * x50)) / x62, b61), -1e37f);
    let x64 = etendue_lesser(etendue_greater(select(0.0f, fma(prepared.surface_plane_along_first.x, x48, fma(prepared.surface_plane_along_first.y, x49, prepared.surface_plane_along_first.z * x50)) / x62, b61), -1e37f), 1e37f);
    let x65 = etendue_lesser(etendue_greater(etendue_lesser(x63, 1e37f), 0.0f), 1.0f);
    let x66 = etendue_lesser(etendue_greater(x64, 0.0f), 1.0f);
    var result: EtendueLightSample;
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
fn etendue_triangle_by_solid_angle_pdf(prepared: EtendueTriangleBySolidAngle, w: vec3<f32>) -> f32 {
    let b1 = 1e-37f < abs(prepared.shape_solid_angle);
    let b2 = (-prepared.shape_slack.y <= fma(prepared.shape_side12.x, w.x, fma(prepared.shape_side12.y, w.y, prepared.shape_side12.z * w.z))) & (-prepared.shape_slack.z <= fma(prepared.shape_side20.x, w.x, fma(prepared.shape_side20.y, w.y, prepared.shape_side20.z * w.z)));
    let x3 = fma(prepared.shape_normal.x, w.x, fma(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z));
    let b4 = -(sqrt(fma(prepared.shape_normal.x, prepared.shape_normal.x, fma(prepared.shape_normal.y, prepared.shape_normal.y, prepared.shape_normal.z * prepared.shape_normal.z))) * 7.1525574e-7f) <= select(x3, -x3, prepared.shape_volume < 0.0f);
    let b5 = b2 & (-prepared.shape_slack.x <= fma(prepared.shape_side01.x, w.x, fma(prepared.shape_side01.y, w.y, prepared.shape_side01.z * w.z))) & b4;
    let x6 = select(0.0f, etendue_lesser(etendue_greater(select(0.0f, 1.0f / select(1.0f, prepared.shape_solid_angle, b1), b1), -1e37f), 1e37f), b5);
    return x6;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian.
fn etendue_triangle_by_solid_angle_hit(prepared: EtendueTriangleBySolidAngle, w: vec3<f32>) -> EtendueLightSample {
    let b1 = 1e-37f < abs(prepared.shape_solid_angle);
    let b2 = (-prepared.shape_slack.y <= fma(prepared.shape_side12.x, w.x, fma(prepared.shape_side12.y, w.y, prepared.shape_side12.z * w.z))) & (-prepared.shape_slack.z <= fma(prepared.shape_side20.x, w.x, fma(prepared.shape_side20.y, w.y, prepared.shape_side20.z * w.z)));
    let x3 = fma(prepared.shape_normal.x, w.x, fma(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z));
    let b4 = prepared.shape_volume < 0.0f;
    let b5 = -(sqrt(fma(prepared.shape_normal.x, prepared.shape_normal.x, fma(prepared.shape_normal.y, prepared.shape_normal.y, prepared.shape_normal.z * prepared.shape_normal.z))) * 7.1525574e-7f) <= select(x3, -x3, b4);
    let b6 = b2 & (-prepared.shape_slack.x <= fma(prepared.shape_side01.x, w.x, fma(prepared.shape_side01.y, w.y, prepared.shape_side01.z * w.z))) & b5;
    let x7 = select(0.0f, etendue_lesser(etendue_greater(select(0.0f, 1.0f / select(1.0f, prepared.shape_solid_angle, b1), b1), -1e37f), 1e37f), b6);
    let b8 = 0.0f < x7;
    let x9 = fma(prepared.surface_plane_cross.x, w.x, fma(prepared.surface_plane_cross.y, w.y, prepared.surface_plane_cross.z * w.z));
    let b10 = 1e-37f < abs(x9);
    let x11 = select(1.0f, x9, b10);
    let x12 = etendue_greater(select(0.0f, -fma(prepared.surface_plane_along_second.x, w.x, fma(prepared.surface_plane_along_second.y, w.y, prepared.surface_plane_along_second.z * w.z)) / x11, b10), -1e37f);
    let x13 = etendue_lesser(etendue_greater(select(0.0f, fma(prepared.surface_plane_along_first.x, w.x, fma(prepared.surface_plane_along_first.y, w.y, prepared.surface_plane_along_first.z * w.z)) / x11, b10), -1e37f), 1e37f);
    let x14 = etendue_lesser(etendue_greater(etendue_lesser(x12, 1e37f), 0.0f), 1.0f);
    let x15 = etendue_lesser(etendue_greater(x13, 0.0f), 1.0f);
    let x16 = fma(prepared.surface_plane_normal.x, w.x, fma(prepared.surface_plane_normal.y, w.y, prepared.surface_plane_normal.z * w.z));
    let b17 = 1e-37f < abs(x16);
    let x18 = prepared.surface_plane_unit * etendue_greater(etendue_lesser(etendue_greater(select(0.0f, prepared.surface_plane_height / select(1.0f, x16, b17), b17), -1e37f), 1e37f), 0.0f);
    let x19 = select(0.0f, etendue_lesser(x18, 3.4028235e38f), b8);
    let b20 = b4 & b8;
    let b21 = b20 & (1e-37f < x7);
    let x22 = select(0.0f, 1.0f / select(1.0f, x7, b21), b21);
    var result: EtendueLightSample;
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
    let b67 = 0.0f < x66;
    let x68 = x10 * x41;
    let x69 = x11 * x46;
    let x70 = x12 * x51;
    let x71 = x68 + x69;
    let x72 = x71 - x68;
    let x73 = x70 + x71;
    let x74 = x73 - x71;
    let x75 = x68 - (x71 - x72) + (x69 - x72) + (x71 - (x73 - x74) + (x70 - x74));
    let x76 = fma(x10, x41, -x68) + (fma(x11, x46, -x69) + fma(x12, x51, -x70));
    let x77 = (x73 + (x75 + x76 + fma(x10, x43, fma(x11, x48, x12 * x53)))) / select(1.0f, x66, b67);
    let x78 = select(0.0f, x77, b67);
    let x79 = x10 + x13;
    let x80 = x11 + x14;
    let x81 = x12 + x15;
    let x82 = x16 + x79;
    let x83 = x17 + x80;
    let x84 = x18 + x81;
    let x85 = x10 + x16;
    let x86 = x11 + x17;
    let x87 = x12 + x18;
    let x88 = abs(x78);
    let x89 = etendue_copysign(1.0f, x78);
    let x90 = x10 * x20;
    let x91 = x11 * x21;
    let x92 = x12 * x22;
    let x93 = x90 + x91;
    let x94 = x93 - x90;
    let x95 = x92 + x93;
    let x96 = x95 - x93;
    let x97 = x90 - (x93 - x94) + (x91 - x94) + (x93 - (x95 - x96) + (x92 - x96));
    let x98 = fma(x10, x20, -x90) + (fma(x11, x21, -x91) + fma(x12, x22, -x92));
    let x99 = x97 + x98;
    let x100 = x13 * x20;
    let x101 = x14 * x21;
    let x102 = x15 * x22;
    let x103 = x100 + x101;
    let x104 = x103 - x100;
    let x105 = x102 + x103;
    let x106 = x105 - x103;
    let x107 = x100 - (x103 - x104) + (x101 - x104) + (x103 - (x105 - x106) + (x102 - x106));
    let x108 = fma(x13, x20, -x100) + (fma(x14, x21, -x101) + fma(x15, x22, -x102));
    let x109 = x24 * (x95 + x99);
    let x110 = x95 + x105;
    let x111 = x110 - x95;
    let x112 = x95 - (x110 - x111) + (x105 - x111) + (x99 + (x107 + x108));
    let x113 = x24 * (x110 + x112);
    let b114 = x109 + x113 < 0.0f;
    let x115 = etendue_greater(select(x109, -x113, b114), x28 * -0.5f);
    let x116 = x28 + x115;
    let x117 = x10 * x30;
    let x118 = x11 * x31;
    let x119 = x12 * x32;
    let x120 = x117 + x118;
    let x121 = x120 - x117;
    let x122 = x119 + x120;
    let x123 = x122 - x120;
    let x124 = x117 - (x120 - x121) + (x118 - x121) + (x120 - (x122 - x123) + (x119 - x123));
    let x125 = fma(x10, x30, -x117) + (fma(x11, x31, -x118) + fma(x12, x32, -x119));
    let x126 = x124 + x125;
    let x127 = x16 * x30;
    let x128 = x17 * x31;
    let x129 = x18 * x32;
    let x130 = x127 + x128;
    let x131 = x130 - x127;
    let x132 = x129 + x130;
    let x133 = x132 - x130;
    let x134 = x127 - (x130 - x131) + (x128 - x131) + (x130 - (x132 - x133) + (x129 - x133));
    let x135 = fma(x16, x30, -x127) + (fma(x17, x31, -x128) + fma(x18, x32, -x129));
    let x136 = x34 * (x122 + x126);
    let x137 = x122 + x132;
    let x138 = x137 - x122;
    let x139 = x122 - (x137 - x138) + (x132 - x138) + (x126 + (x134 + x135));
    let x140 = x34 * (x137 + x139);
    let b141 = x136 + x140 < 0.0f;
    let x142 = etendue_greater(select(x136, -x140, b141), x38 * -0.5f);
    let x143 = x38 + x142;
    let x144 = select(x25, -x25, b114);
    let x145 = select(x26, -x26, b114);
    let x146 = select(x27, -x27, b114);
    let x147 = select(x35, -x35, b141);
    let x148 = select(x36, -x36, b141);
    let x149 = select(x37, -x37, b141);
    let b150 = x116 <= x115 + x115;
    let b151 = x143 <= x142 + x142;
    let x152 = select(0.0f, x116, b150);
    let x153 = select(0.0f, x143, b151);
    let x154 = x116 - x152;
    let x155 = x143 - x153;
    let x156 = select(select(x82, x79, b141), select(x85, x10, b141), b114) - x144 * x154 - x147 * x155;
    let x157 = select(select(x83, x80, b141), select(x86, x11, b141), b114) - x145 * x154 - x148 * x155;
    let x158 = select(select(x84, x81, b141), select(x87, x12, b141), b114) - x146 * x154 - x149 * x155;
    let b159 = etendue_greater(x154, x155) <= etendue_greater(etendue_greater(x152, x153), x88);
    let x160 = select(fma(x144, x152, fma(x147, x153, x63 * x78)), x156, b159);
    let x161 = select(fma(x145, x152, fma(x148, x153, x64 * x78)), x157, b159);
    let x162 = select(fma(x146, x152, fma(x149, x153, x65 * x78)), x158, b159);
    let x163 = x88 * x88;
    let x164 = x142 * x143;
    let x165 = sqrt(fma(x142, x142, x163) * fma(x143, x143, x163));
    let b166 = 0.0f < x165;
    let x167 = select(0.0f, 1.0f / select(1.0f, x165, b166), b166);
    let b168 = x142 < 0.0f;
    let x169 = x116 * x116;
    let x170 = x163 + x169;
    let x171 = sqrt(fma(x142, x142, x170));
    let x172 = fma(x143, x143, x170);
    let x173 = sqrt(x172);
    let x174 = x171 * x173;
    let b175 = 0.0f < x170;
    let x176 = select(0.0f, 1.0f / select(1.0f, x170, b175), b175);
    let x177 = abs(x142);
    let x178 = fma(x143, x171, x173 * x177);
    let x179 = x38 * (x142 + x143);
    let b180 = 0.0f < x178;
    let x181 = abs(x164);
    let x182 = x174 + x181;
    let b183 = 0.0f < x182;
    let x184 = select(select(0.0f, x179 / select(1.0f, x178, b180), b180), x176 * x178, b168) * (x88 * x116);
    let x185 = x167 * x184;
    let x186 = x167 * (x176 * fma(x164, x169, x163 * x174));
    let x187 = x167 * (x38 * (x38 * x163));
    let x188 = 1.0f + select(0.0f, fma(x142, x142, x172) / select(1.0f, x182, b183), b183);
    let x189 = x170 + x182;
    let x190 = select(x189, x170 * x188, b168);
    let b191 = 0.0f < x190;
    let x192 = select(0.0f, x187 / select(1.0f, x190, b191), b191);
    let x193 = x163 * x167;
    let x194 = x193 * select(x188, x176 * x189, b168);
    let b195 = x115 < 0.0f;
    let x196 = -x115 * -x115;
    let x197 = x163 + x196;
    let x198 = sqrt(fma(x142, x142, x197));
    let x199 = fma(x143, x143, x197);
    let x200 = sqrt(x199);
    let x201 = x198 * x200;
    let b202 = 0.0f < x197;
    let x203 = select(0.0f, 1.0f / select(1.0f, x197, b202), b202);
    let x204 = fma(x143, x198, x177 * x200);
    let b205 = 0.0f < x204;
    let x206 = x181 + x201;
    let b207 = 0.0f < x206;
    let x208 = select(select(0.0f, x179 / select(1.0f, x204, b205), b205), x203 * x204, b168) * (x88 * -x115);
    let x209 = x167 * x208;
    let x210 = x167 * (x203 * fma(x164, x196, x163 * x201));
    let x211 = 1.0f + select(0.0f, fma(x142, x142, x199) / select(1.0f, x206, b207), b207);
    let x212 = x197 + x206;
    let x213 = select(x212, x197 * x211, b168);
    let b214 = 0.0f < x213;
    let x215 = select(0.0f, x187 / select(1.0f, x213, b214), b214);
    let x216 = x193 * select(x211, x203 * x212, b168);
    let b217 = b168 | b195;
    let b218 = b168 & !b195;
    let x219 = select(x115, x142, b218);
    let x220 = select(x142, x115, b218);
    let x221 = select(x116, x143, b218);
    let x222 = select(x143, x116, b218);
    let x223 = fma(x219, x219, x163);
    let x224 = fma(x221, x221, x163);
    let x225 = sqrt(fma(x220, x220, x223));
    let x226 = sqrt(fma(x222, x222, x223));
    let x227 = sqrt(fma(x220, x220, x224));
    let x228 = sqrt(fma(x222, x222, x224));
    let x229 = x220 * x222;
    let b230 = 0.0f <= x220;
    let x231 = abs(x220);
    let x232 = fma(x222, x227, x228 * x231);
    let x233 = select(x38, x28, b218) * (x220 + x222);
    let b234 = 0.0f < x232;
    let x235 = select(x232, select(0.0f, x224 * x233 / select(1.0f, x232, b234), b234), b230) * (x88 * abs(x221));
    let x236 = fma(x222, x225, x226 * x231);
    let b237 = 0.0f < x236;
    let x238 = select(x236, select(0.0f, x223 * x233 / select(1.0f, x236, b237), b237), b230) * (x88 * abs(x219));
    let x239 = x225 * x226;
    let x240 = x38 * (x28 * x88);
    let x241 = x219 * x221;
    let x242 = x163 + (x229 + x241);
    let x243 = fma(x228, x225 * x227, fma(x228, x241 + fma(x220, x220, x163), fma(x227, x242, x225 * (x224 + x229))));
    let x244 = fma(x228, x239, fma(x225, x241 + fma(x222, x222, x163), fma(x226, x242, x228 * (x223 + x229))));
    let x245 = etendue_angle(select(x240, x235, b217), select(x243, fma(x229, x221 * x221, x163 * (x227 * x228)), b217));
    let x246 = x245 + etendue_angle(select(x240, x238, b217), select(x244, fma(x229, x219 * x219, x163 * x239), b217));
    let x247 = x246 * select(2.0f, 1.0f, b217);
    let b248 = 0.0f < x185;
    let b249 = b8 & (1e-36f < x247) & (x247 < 7.0f) & b248 & (1e-18f < x88);
    let x250 = x11 * x15;
    let x251 = x12 * x14;
    let x252 = x250 - x251;
    let x253 = x252 - x250;
    let x254 = x250 - (x252 - x253) + (-x251 - x253) + (fma(x11, x15, -x250) - fma(x12, x14, -x251));
    let x255 = x12 * x13;
    let x256 = x10 * x15;
    let x257 = x255 - x256;
    let x258 = x257 - x255;
    let x259 = x255 - (x257 - x258) + (-x256 - x258) + (fma(x12, x13, -x255) - fma(x10, x15, -x256));
    let x260 = x10 * x14;
    let x261 = x11 * x13;
    let x262 = x260 - x261;
    let x263 = x262 - x260;
    let x264 = x260 - (x262 - x263) + (-x261 - x263) + (fma(x10, x14, -x260) - fma(x11, x13, -x261));
    let x265 = x11 * x18;
    let x266 = x12 * x17;
    let x267 = x265 - x266;
    let x268 = x267 - x265;
    let x269 = x265 - (x267 - x268) + (-x266 - x268) + (fma(x11, x18, -x265) - fma(x12, x17, -x266));
    let x270 = x12 * x16;
    let x271 = x10 * x18;
    let x272 = x270 - x271;
    let x273 = x272 - x270;
    let x274 = x270 - (x272 - x273) + (-x271 - x273) + (fma(x12, x16, -x270) - fma(x10, x18, -x271));
    let x275 = x10 * x17;
    let x276 = x11 * x16;
    let x277 = x275 - x276;
    let x278 = x277 - x275;
    let x279 = x275 - (x277 - x278) + (-x276 - x278) + (fma(x10, x17, -x275) - fma(x11, x16, -x276));
    let x280 = x14 * x18;
    let x281 = x15 * x17;
    let x282 = x280 - x281;
    let x283 = x282 - x280;
    let x284 = x280 - (x282 - x283) + (-x281 - x283) + (fma(x14, x18, -x280) - fma(x15, x17, -x281));
    let x285 = x15 * x16;
    let x286 = x13 * x18;
    let x287 = x285 - x286;
    let x288 = x287 - x285;
    let x289 = x285 - (x287 - x288) + (-x286 - x288) + (fma(x15, x16, -x285) - fma(x13, x18, -x286));
    let x290 = x13 * x17;
    let x291 = x14 * x16;
    let x292 = x290 - x291;
    let x293 = x292 - x290;
    let x294 = x290 - (x292 - x293) + (-x291 - x293) + (fma(x13, x17, -x290) - fma(x14, x16, -x291));
    let x295 = -x267 - x269;
    let x296 = -x272 - x274;
    let x297 = -x277 - x279;
    let x298 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x295), abs(x296)), abs(x297)));
    let x299 = x295 * x298;
    let x300 = x296 * x298;
    let x301 = x297 * x298;
    let x302 = fma(x299, x299, fma(x300, x300, x301 * x301));
    let x303 = select(0.0f, 1.0f / sqrt(x302), 0.0f < x302);
    let x304 = x299 * x303;
    let x305 = x300 * x303;
    let x306 = x301 * x303;
    let x307 = x302 * x303 / x298;
    let b308 = x89 < 0.0f;
    let x309 = select(x304, -x304, b308);
    let x310 = select(x305, -x305, b308);
    let x311 = select(x306, -x306, b308);
    let b312 = 0.0f < x307;
    let x313 = select(0.0f, -fma(x10, x85, fma(x11, x86, x12 * x87)) / select(1.0f, x307, b312), b312);
    let x314 = etendue_lesser(etendue_greater(x313, 1.0f), 1e18f) * 4.7683716e-7f;
    let x315 = x267 + x282;
    let x316 = x315 - x267;
    let x317 = x272 + x287;
    let x318 = x317 - x272;
    let x319 = x277 + x292;
    let x320 = x319 - x277;
    let x321 = x315 + (x267 - (x315 - x316) + (x282 - x316) + (x269 + x284));
    let x322 = x317 + (x272 - (x317 - x318) + (x287 - x318) + (x274 + x289));
    let x323 = x319 + (x277 - (x319 - x320) + (x292 - x320) + (x279 + x294));
    let x324 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x321), abs(x322)), abs(x323)));
    let x325 = x321 * x324;
    let x326 = x322 * x324;
    let x327 = x323 * x324;
    let x328 = fma(x325, x325, fma(x326, x326, x327 * x327));
    let x329 = select(0.0f, 1.0f / sqrt(x328), 0.0f < x328);
    let x330 = x325 * x329;
    let x331 = x326 * x329;
    let x332 = x327 * x329;
    let x333 = x328 * x329 / x324;
    let x334 = select(x330, -x330, b308);
    let x335 = select(x331, -x331, b308);
    let x336 = select(x332, -x332, b308);
    let b337 = 0.0f < x333;
    let x338 = select(0.0f, -fma(x79, x82, fma(x80, x83, x81 * x84)) / select(1.0f, x333, b337), b337);
    let x339 = 4.7683716e-7f * etendue_lesser(etendue_greater(x338, 1.0f), 1e18f);
    let x340 = x252 + x254;
    let x341 = x257 + x259;
    let x342 = x262 + x264;
    let x343 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x340), abs(x341)), abs(x342)));
    let x344 = x340 * x343;
    let x345 = x341 * x343;
    let x346 = x342 * x343;
    let x347 = fma(x344, x344, fma(x345, x345, x346 * x346));
    let x348 = select(0.0f, 1.0f / sqrt(x347), 0.0f < x347);
    let x349 = x344 * x348;
    let x350 = x345 * x348;
    let x351 = x346 * x348;
    let x352 = x347 * x348 / x343;
    let x353 = select(x349, -x349, b308);
    let x354 = select(x350, -x350, b308);
    let x355 = select(x351, -x351, b308);
    let b356 = 0.0f < x352;
    let x357 = select(0.0f, -fma(x10, x79, fma(x11, x80, x12 * x81)) / select(1.0f, x352, b356), b356);
    let x358 = 4.7683716e-7f * etendue_lesser(etendue_greater(x357, 1.0f), 1e18f);
    let x359 = x282 - x252;
    let x360 = x359 - x282;
    let x361 = x287 - x257;
    let x362 = x361 - x287;
    let x363 = x292 - x262;
    let x364 = x363 - x292;
    let x365 = x282 - (x359 - x360) + (-x252 - x360) + (x284 - x254);
    let x366 = x287 - (x361 - x362) + (-x257 - x362) + (x289 - x259);
    let x367 = x292 - (x363 - x364) + (-x262 - x364) + (x294 - x264);
    let x368 = x359 + x365;
    let x369 = x361 + x366;
    let x370 = x363 + x367;
    let x371 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x368), abs(x369)), abs(x370)));
    let x372 = x368 * x371;
    let x373 = x369 * x371;
    let x374 = x370 * x371;
    let x375 = fma(x372, x372, fma(x373, x373, x374 * x374));
    let x376 = select(0.0f, 1.0f / sqrt(x375), 0.0f < x375);
    let x377 = x372 * x376;
    let x378 = x373 * x376;
    let x379 = x374 * x376;
    let x380 = x375 * x376 / x371;
    let x381 = select(x377, -x377, b308);
    let x382 = select(x378, -x378, b308);
    let x383 = select(x379, -x379, b308);
    let b384 = 0.0f < x380;
    let x385 = select(0.0f, -fma(x82, x85, fma(x83, x86, x84 * x87)) / select(1.0f, x380, b384), b384);
    let x386 = 4.7683716e-7f * etendue_lesser(etendue_greater(x385, 1.0f), 1e18f);
    let x387 = select(x309, x334, b114);
    let x388 = select(x310, x335, b114);
    let x389 = select(x311, x336, b114);
    let x390 = select(x334, x309, b114);
    let x391 = select(x335, x310, b114);
    let x392 = select(x336, x311, b114);
    let x393 = select(x353, x381, b141);
    let x394 = select(x354, x382, b141);
    let x395 = select(x355, x383, b141);
    let x396 = select(x381, x353, b141);
    let x397 = select(x382, x354, b141);
    let x398 = select(x383, x355, b141);
    let x399 = select(x314, x339, b114);
    let x400 = select(x358, x386, b141);
    let x401 = select(x339, x314, b114);
    let x402 = select(x386, x358, b141);
    let x403 = x63 * x89;
    let x404 = x64 * x89;
    let x405 = x65 * x89;
    let x406 = select(0.0f, 1.0f, b150);
    let x407 = select(0.0f, 1.0f, b151);
    let x408 = select(0.0f, 1.0f, b114);
    let x409 = select(0.0f, 1.0f, b141);
    let x410 = select(0.0f, 1.0f / select(1.0f, x185, b248), b248);
    let x411 = select(2.0f, 0.5f, b195);
    let x412 = select(0.0f, x247, b249);
    let x413 = 1.0f / x9;
    let x414 = etendue_greater(etendue_greater(etendue_greater(0.0f, x4), x5), x6);
    let b415 = x414 < etendue_from_bits(0x7f800000u);
    let x416 = etendue_pow2_scale(x414);
    let x417 = x416 * select(0.0f, x1, b415);
    let x418 = x416 * select(0.0f, x2, b415);
    let x419 = x416 * select(0.0f, x3, b415);
    let x420 = x416 * select(0.0f, light.edge_s.x, b415);
    let x421 = x416 * select(0.0f, light.edge_s.y, b415);
    let x422 = x416 * select(0.0f, light.edge_s.z, b415);
    let x423 = x416 * select(0.0f, light.edge_t.x, b415);
    let x424 = x416 * select(0.0f, light.edge_t.y, b415);
    let x425 = x416 * select(0.0f, light.edge_t.z, b415);
    let x426 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x420), abs(x421)), abs(x422)));
    let x427 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x423), abs(x424)), abs(x425)));
    let x428 = x420 * x426;
    let x429 = x421 * x426;
    let x430 = x422 * x426;
    let x431 = x423 * x427;
    let x432 = x424 * x427;
    let x433 = x425 * x427;
    let x434 = x429 * x433;
    let x435 = x430 * x432;
    let x436 = x434 - x435;
    let x437 = x436 - x434;
    let x438 = x434 - (x436 - x437) + (-x435 - x437) + (fma(x429, x433, -x434) - fma(x430, x432, -x435));
    let x439 = x430 * x431;
    let x440 = x428 * x433;
    let x441 = x439 - x440;
    let x442 = x441 - x439;
    let x443 = x439 - (x441 - x442) + (-x440 - x442) + (fma(x430, x431, -x439) - fma(x428, x433, -x440));
    let x444 = x428 * x432;
    let x445 = x429 * x431;
    let x446 = x444 - x445;
    let x447 = x446 - x444;
    let x448 = x444 - (x446 - x447) + (-x445 - x447) + (fma(x428, x432, -x444) - fma(x429, x431, -x445));
    let x449 = x436 + x438;
    let x450 = x441 + x443;
    let x451 = x446 + x448;
    let x452 = etendue_pow2_scale(etendue_greater(etendue_greater(abs(x449), abs(x450)), abs(x451)));
    let x453 = x449 * x452;
    let x454 = x450 * x452;
    let x455 = x451 * x452;
    let x456 = fma(x453, x453, fma(x454, x454, x455 * x455));
    let x457 = select(0.0f, 1.0f / sqrt(x456), 0.0f < x456);
    let x458 = x453 * x457;
    let x459 = x454 * x457;
    let x460 = x455 * x457;
    let x461 = x456 * x457 / x452;
    let x462 = x417 * x436;
    let x463 = x418 * x441;
    let x464 = x419 * x446;
    let x465 = x462 + x463;
    let x466 = x465 - x462;
    let x467 = x464 + x465;
    let x468 = x467 - x465;
    let x469 = x462 - (x465 - x466) + (x463 - x466) + (x465 - (x467 - x468) + (x464 - x468));
    let x470 = fma(x417, x436, -x462) + (fma(x418, x441, -x463) + fma(x419, x446, -x464));
    let b471 = 1e-37f < abs(x461);
    let x472 = (x467 + (x469 + x470 + fma(x417, x438, fma(x418, x443, x419 * x448)))) / select(1.0f, x461, b471);
    let x473 = etendue_lesser(etendue_greater(select(0.0f, x472, b471), -1e37f), 1e37f);
    let x474 = x461 / x426 / x427;
    let x475 = x458 * x474;
    let x476 = x459 * x474;
    let x477 = x460 * x474;
    let x478 = -(x419 * x421);
    let x479 = fma(x418, x422, x478) - fma(x419, x421, x478);
    let x480 = -(x417 * x422);
    let x481 = fma(x419, x420, x480) - fma(x417, x422, x480);
    let x482 = -(x418 * x420);
    let x483 = fma(x417, x421, x482) - fma(x418, x420, x482);
    let x484 = -(x419 * x424);
    let x485 = fma(x418, x425, x484) - fma(x419, x424, x484);
    let x486 = -(x417 * x425);
    let x487 = fma(x419, x423, x486) - fma(x417, x425, x486);
    let x488 = -(x418 * x423);
    let x489 = fma(x417, x424, x488) - fma(x418, x423, x488);
    let x490 = 1.0f / x416;
    var result: EtendueRectangleBySolidAngle;
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
    let b29 = 0.0f < x28;
    let x30 = select(0.0f, 1.0f / select(1.0f, x28, b29), b29);
    let x31 = x27 * x30;
    let x32 = x25 * x31;
    let x33 = prepared.shape_far.y * x32;
    let x34 = select(x27 * x31, x30 * (x22 * (prepared.shape_size.y * (prepared.shape_near.y + prepared.shape_far.y))), 0.0f <= prepared.shape_near.y);
    let x35 = x31 * (prepared.shape_near.y * x26);
    let x36 = select(x24, u.y, b23) * x34;
    let x37 = select(1.0f - x24, x24, b23) * x34;
    let x38 = x35 + x37;
    let b39 = x38 < 0.0f;
    let x40 = select(x33 - x36, x38, b39);
    let x41 = select(x36, -x37, b39) * (x40 + select(x33, x35, b39));
    let x42 = x31 * select(x25, x26, b39);
    let x43 = sqrt(etendue_greater(x22 * fma(x42, x22 * x42, x41), 0.0f));
    let b44 = 0.0f < prepared.shape_anchor.y;
    let x45 = x43 * select(1.0f, fma(x33, x43, x32 * (x22 * x40)), b44);
    let x46 = x22 * select(x40, -(x26 * x41), b44) / select(1.0f, x45, 0.0f < x45);
    let x47 = etendue_lesser(etendue_greater(x46, select(prepared.shape_near.y, -prepared.shape_size.y, b44)), select(prepared.shape_far.y, 0.0f, b44));
    let x48 = fma(prepared.shape_side_x.x, x20, fma(prepared.shape_side_y.x, x47, prepared.shape_base.x));
    let x49 = fma(prepared.shape_side_x.y, x20, fma(prepared.shape_side_y.y, x47, prepared.shape_base.y));
    let x50 = fma(prepared.shape_side_x.z, x20, fma(prepared.shape_side_y.z, x47, prepared.shape_base.z));
    let x51 = fma(x48, x48, fma(x49, x49, x50 * x50));
    let x52 = select(0.0f, 1.0f / sqrt(x51), 1e-37f < x51);
    let x53 = x48 * x52;
    let x54 = x49 * x52;
    let x55 = x50 * x52;
    let b56 = 0.0f < prepared.shape_solid_angle;
    let x57 = select(0.0f, prepared.shape_unit * (x51 * x52), b56);
    let x58 = fma(prepared.surface_plane_cross.x, x53, fma(prepared.surface_plane_cross.y, x54, prepared.surface_plane_cross.z * x55));
    let b59 = 1e-37f < abs(x58);
    let x60 = select(1.0f, x58, b59);
    let x61 = etendue_greater(select(0.0f, -fma(prepared.surface_plane_along_second.x, x53, fma(prepared.surface_plane_along_second.y, x54, prepared.surface_plane_along_second.z * x55)) / x60, b59), -1e37f);
    let x62 = etendue_lesser(etendue_greater(select(0.0f, fma(prepared.surface_plane_along_first.x, x53, fma(prepared.surface_plane_along_first.y, x54, prepared.surface_plane_along_first.z * x55)) / x60, b59), -1e37f), 1e37f);
    let x63 = etendue_lesser(etendue_greater(etendue_lesser(x61, 1e37f), 0.0f), 1.0f);
    let x64 = etendue_lesser(etendue_greater(x62, 0.0f), 1.0f);
    let x65 = select(0.0f, 1.0f / select(1.0f, prepared.shape_solid_angle, b56), b56);
    let b66 = prepared.shape_side < 0.0f;
    let b67 = b66 & (1e-37f < x65);
    let x68 = select(0.0f, 1.0f / select(1.0f, x65, b67), b67);
    var result: EtendueLightSample;
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
fn etendue_rectangle_by_solid_angle_pdf(prepared: EtendueRectangleBySolidAngle, w: vec3<f32>) -> f32 {
    let b1 = (-prepared.shape_slack.x <= fma(prepared.shape_near_x.x, w.x, fma(prepared.shape_near_x.y, w.y, prepared.shape_near_x.z * w.z))) & (-prepared.shape_slack_far.x <= fma(prepared.shape_far_x.x, w.x, fma(prepared.shape_far_x.y, w.y, prepared.shape_far_x.z * w.z)));
    let b2 = b1 & (-prepared.shape_slack.y <= fma(prepared.shape_near_y.x, w.x, fma(prepared.shape_near_y.y, w.y, prepared.shape_near_y.z * w.z))) & (-prepared.shape_slack_far.y <= fma(prepared.shape_far_y.x, w.x, fma(prepared.shape_far_y.y, w.y, prepared.shape_far_y.z * w.z)));
    let b3 = 0.0f < prepared.shape_solid_angle;
    let x4 = select(0.0f, select(0.0f, 1.0f / select(1.0f, prepared.shape_solid_angle, b3), b3), b2 & (-4.7683716e-7f <= fma(prepared.shape_normal.x, w.x, fma(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z))));
    return x4;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the solid angle Omega at the point p: pdf 1/Omega per steradian.
fn etendue_rectangle_by_solid_angle_hit(prepared: EtendueRectangleBySolidAngle, w: vec3<f32>) -> EtendueLightSample {
    let b1 = (-prepared.shape_slack.x <= fma(prepared.shape_near_x.x, w.x, fma(prepared.shape_near_x.y, w.y, prepared.shape_near_x.z * w.z))) & (-prepared.shape_slack_far.x <= fma(prepared.shape_far_x.x, w.x, fma(prepared.shape_far_x.y, w.y, prepared.shape_far_x.z * w.z)));
    let b2 = b1 & (-prepared.shape_slack.y <= fma(prepared.shape_near_y.x, w.x, fma(prepared.shape_near_y.y, w.y, prepared.shape_near_y.z * w.z))) & (-prepared.shape_slack_far.y <= fma(prepared.shape_far_y.x, w.x, fma(prepared.shape_far_y.y, w.y, prepared.shape_far_y.z * w.z)));
    let b3 = 0.0f < prepared.shape_solid_angle;
    let x4 = select(0.0f, select(0.0f, 1.0f / select(1.0f, prepared.shape_solid_angle, b3), b3), b2 & (-4.7683716e-7f <= fma(prepared.shape_normal.x, w.x, fma(prepared.shape_normal.y, w.y, prepared.shape_normal.z * w.z))));
    let b5 = 0.0f < x4;
    let x6 = fma(prepared.surface_plane_cross.x, w.x, fma(prepared.surface_plane_cross.y, w.y, prepared.surface_plane_cross.z * w.z));
    let b7 = 1e-37f < abs(x6);
    let x8 = select(1.0f, x6, b7);
    let x9 = etendue_greater(select(0.0f, -fma(prepared.surface_plane_along_second.x, w.x, fma(prepared.surface_plane_along_second.y, w.y, prepared.surface_plane_along_second.z * w.z)) / x8, b7), -1e37f);
    let x10 = etendue_lesser(etendue_greater(select(0.0f, fma(prepared.surface_plane_along_first.x, w.x, fma(prepared.surface_plane_along_first.y, w.y, prepared.surface_plane_along_first.z * w.z)) / x8, b7), -1e37f), 1e37f);
    let x11 = etendue_lesser(etendue_greater(etendue_lesser(x9, 1e37f), 0.0f), 1.0f);
    let x12 = etendue_lesser(etendue_greater(x10, 0.0f), 1.0f);
    let x13 = fma(prepared.surface_plane_normal.x, w.x, fma(prepared.surface_plane_normal.y, w.y, prepared.surface_plane_normal.z * w.z));
    let b14 = 1e-37f < abs(x13);
    let x15 = prepared.surface_plane_unit * etendue_greater(etendue_lesser(etendue_greater(select(0.0f, prepared.surface_plane_height / select(1.0f, x13, b14), b14), -1e37f), 1e37f), 0.0f);
    let x16 = select(0.0f, etendue_lesser(x15, 3.4028235e38f), b5);
    let b17 = (prepared.shape_side < 0.0f) & b5;
    let b18 = b17 & (1e-37f < x4);
    let x19 = select(0.0f, 1.0f / select(1.0f, x4, b18), b18);
    var result: EtendueLightSample;
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
    let b30 = 1e-37f < x29;
    let x31 = etendue_greater(etendue_lesser(etendue_greater(select(0.0f, prepared.surface_height / select(1.0f, x28, b30), b30), -1e37f), 1e37f), 0.0f);
    let x32 = prepared.surface_radius * prepared.surface_radius * 3.1415927f * x29;
    let b33 = 0.0f < x32;
    let x34 = x31 * (x31 / select(1.0f, x32, b33));
    let x35 = select(0.0f, x34, b33 & (x34 < 1e37f) & (0.0f < x31));
    let b36 = x28 < 0.0f;
    let b37 = b36 & (1e-37f < x35);
    let x38 = select(0.0f, 1.0f / select(1.0f, x35, b37), b37);
    var result: EtendueLightSample;
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
fn etendue_disk_by_area_pdf(prepared: EtendueDiskByArea, w: vec3<f32>) -> f32 {
    let x1 = fma(prepared.surface_frame_n.x, w.x, fma(prepared.surface_frame_n.y, w.y, prepared.surface_frame_n.z * w.z));
    let x2 = abs(x1);
    let b3 = 1e-37f < x2;
    let x4 = etendue_greater(etendue_lesser(etendue_greater(select(0.0f, prepared.surface_height / select(1.0f, x1, b3), b3), -1e37f), 1e37f), 0.0f);
    let x5 = x2 * (prepared.surface_radius * prepared.surface_radius * 3.1415927f);
    let b6 = 0.0f < x5;
    let x7 = x4 * (x4 / select(1.0f, x5, b6));
    let x8 = etendue_greater(etendue_greater(etendue_greater(abs(prepared.surface_center.x), abs(prepared.surface_center.y)), abs(prepared.surface_center.z)), abs(prepared.surface_radius));
    let x9 = etendue_pow2_scale(x8);
    let x10 = prepared.surface_center.x * x9;
    let x11 = prepared.surface_center.y * x9;
    let x12 = prepared.surface_center.z * x9;
    let x13 = prepared.surface_height * x9;
    let x14 = prepared.surface_radius * x9;
    let x15 = w.x * x13 - x1 * x10;
    let x16 = w.y * x13 - x1 * x11;
    let x17 = w.z * x13 - x1 * x12;
    let x18 = fma(x2, x14, (x14 + sqrt(fma(x10, x10, fma(x11, x11, x12 * x12)))) * 7.1525574e-7f);
    let b19 = (sqrt(fma(x15, x15, fma(x16, x16, x17 * x17))) <= x18) & (0.0f < x1 * x13);
    let x20 = select(0.0f, select(0.0f, x7, b6 & (x7 < 1e37f) & (0.0f < x4)), b19 & (0.0f < x14));
    return x20;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the surface of area A: pdf distance^2/(|cos(theta')| A) per steradian, theta' at the light.
fn etendue_disk_by_area_hit(prepared: EtendueDiskByArea, w: vec3<f32>) -> EtendueLightSample {
    let x1 = fma(prepared.surface_frame_n.x, w.x, fma(prepared.surface_frame_n.y, w.y, prepared.surface_frame_n.z * w.z));
    let x2 = abs(x1);
    let b3 = 1e-37f < x2;
    let x4 = etendue_lesser(etendue_greater(select(0.0f, prepared.surface_height / select(1.0f, x1, b3), b3), -1e37f), 1e37f);
    let x5 = etendue_greater(x4, 0.0f);
    let x6 = fma(w.x, x4, -prepared.surface_center.x);
    let x7 = fma(w.y, x4, -prepared.surface_center.y);
    let x8 = fma(w.z, x4, -prepared.surface_center.z);
    let x9 = abs(prepared.surface_radius);
    let b10 = 1e-37f < x9;
    let x11 = select(1.0f, prepared.surface_radius, b10);
    let x12 = etendue_lesser(etendue_greater(select(0.0f, fma(prepared.surface_frame_s.x, x6, fma(prepared.surface_frame_s.y, x7, prepared.surface_frame_s.z * x8)) / x11, b10), -1e37f), 1e37f);
    let x13 = etendue_lesser(etendue_greater(select(0.0f, fma(prepared.surface_frame_t.x, x6, fma(prepared.surface_frame_t.y, x7, prepared.surface_frame_t.z * x8)) / x11, b10), -1e37f), 1e37f);
    let x14 = etendue_lesser(etendue_greater(fma(etendue_lesser(etendue_greater(x12, -1000000000000000.0f), 1000000000000000.0f), 0.5f, 0.5f), 0.0f), 1.0f);
    let x15 = etendue_lesser(etendue_greater(fma(etendue_lesser(etendue_greater(x13, -1000000000000000.0f), 1000000000000000.0f), 0.5f, 0.5f), 0.0f), 1.0f);
    let x16 = x2 * (prepared.surface_radius * prepared.surface_radius * 3.1415927f);
    let b17 = 0.0f < x16;
    let x18 = x5 * (x5 / select(1.0f, x16, b17));
    let x19 = etendue_pow2_scale(etendue_greater(etendue_greater(etendue_greater(abs(prepared.surface_center.x), abs(prepared.surface_center.y)), abs(prepared.surface_center.z)), x9));
    let x20 = prepared.surface_center.x * x19;
    let x21 = prepared.surface_center.y * x19;
    let x22 = prepared.surface_center.z * x19;
    let x23 = prepared.surface_height * x19;
    let x24 = prepared.surface_radius * x19;
    let x25 = w.x * x23 - x1 * x20;
    let x26 = w.y * x23 - x1 * x21;
    let x27 = w.z * x23 - x1 * x22;
    let x28 = fma(x2, x24, (x24 + sqrt(fma(x20, x20, fma(x21, x21, x22 * x22)))) * 7.1525574e-7f);
    let b29 = (sqrt(fma(x25, x25, fma(x26, x26, x27 * x27))) <= x28) & (0.0f < x1 * x23);
    let x30 = select(0.0f, select(0.0f, x18, b17 & (x18 < 1e37f) & (0.0f < x5)), b29 & (0.0f < x24));
    let b31 = 0.0f < x30;
    let x32 = select(0.0f, x5, b31);
    let b33 = b31 & (x1 < 0.0f);
    let b34 = b33 & (1e-37f < x30);
    let x35 = select(0.0f, 1.0f / select(1.0f, x30, b34), b34);
    var result: EtendueLightSample;
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
    let b11 = 1e-37f < x1;
    let x12 = select(0.0f, 0.15915494f / select(1.0f, x1, b11), b11);
    let x13 = -x8;
    let x14 = -x9;
    let x15 = -x10;
    let b16 = 1e-37f < x12;
    let x17 = select(0.0f, 1.0f / select(1.0f, x12, b16), b16);
    var result: EtendueLightSample;
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
fn etendue_sun_by_solid_angle_pdf(prepared: EtendueSunBySolidAngle, w: vec3<f32>) -> f32 {
    let x1 = fma(prepared.frame_s.x, w.x, fma(prepared.frame_s.y, w.y, prepared.frame_s.z * w.z));
    let x2 = fma(prepared.frame_t.x, w.x, fma(prepared.frame_t.y, w.y, prepared.frame_t.z * w.z));
    let x3 = fma(prepared.frame_n.x, w.x, fma(prepared.frame_n.y, w.y, prepared.frame_n.z * w.z));
    let x4 = etendue_lesser(etendue_greater(prepared.cone_one_minus_cos, 0.0f), 2.0f);
    let b5 = 1e-37f < x4;
    let x6 = select(1.0f - x3, fma(x1, x1, x2 * x2) / (1.0f + abs(x3)), 0.5f < x3);
    let x7 = x4 + fma(5.9604645e-7f, etendue_greater(sqrt(x4 * (2.0f - x4)), x4 - 1.0f), 1.7763568e-13f);
    let x8 = select(0.0f, select(0.0f, 0.15915494f / select(1.0f, x4, b5), b5), x6 <= x7);
    return x8;
}

// The nearest point of the light in the unit direction w, with the density of that; pdf 0 where it misses. Uniform
// over the cone: pdf 1/(2 pi (1 - cos(sigma))) per steradian, 0 where the cone is empty.
fn etendue_sun_by_solid_angle_hit(prepared: EtendueSunBySolidAngle, w: vec3<f32>) -> EtendueLightSample {
    let x1 = fma(prepared.frame_s.x, w.x, fma(prepared.frame_s.y, w.y, prepared.frame_s.z * w.z));
    let x2 = fma(prepared.frame_t.x, w.x, fma(prepared.frame_t.y, w.y, prepared.frame_t.z * w.z));
    let x3 = fma(prepared.frame_n.x, w.x, fma(prepared.frame_n.y, w.y, prepared.frame_n.z * w.z));
    let x4 = etendue_lesser(etendue_greater(prepared.cone_one_minus_cos, 0.0f), 2.0f);
    let b5 = 1e-37f < x4;
    let x6 = select(1.0f - x3, fma(x1, x1, x2 * x2) / (1.0f + abs(x3)), 0.5f < x3);
    let x7 = x4 + fma(5.9604645e-7f, etendue_greater(sqrt(x4 * (2.0f - x4)), x4 - 1.0f), 1.7763568e-13f);
    let x8 = select(0.0f, select(0.0f, 0.15915494f / select(1.0f, x4, b5), b5), x6 <= x7);
    let x9 = etendue_lesser(etendue_greater(x6 / select(1.0f, x4, 0.0f < x4), 0.0f), 0.99999994f);
    let x10 = 0.15915494f * etendue_angle(x2, x1);
    let x11 = etendue_lesser(etendue_greater(select(x10, 1.0f + x10, x10 < 0.0f), 0.0f), 0.99999994f);
    let b12 = 0.0f < x8;
    let x13 = select(0.0f, 3.4028235e38f, b12);
    let x14 = -w.x;
    let x15 = -w.y;
    let x16 = -w.z;
    let b17 = b12 & (1e-37f < x8);
    let x18 = select(0.0f, 1.0f / select(1.0f, x8, b17), b17);
    var result: EtendueLightSample;
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
    let b5 = b1 & (1e-37f < prepared.pdf);
    let x6 = select(0.0f, 1.0f / select(1.0f, prepared.pdf, b5), b5);
    var result: EtendueLightSample;
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
    let x17 = fma(light.axis.x, -x13, fma(light.axis.y, -x14, light.axis.z * -x15));
    let x18 = light.cos_inner - light.cos_outer;
    let b19 = 0.0f < x18;
    let x20 = etendue_lesser(etendue_greater((x17 - light.cos_outer) / select(1.0f, x18, b19), 0.0f), 1.0f);
    let x21 = select(select(0.0f, 1.0f, light.cos_inner <= x17), x20 * x20 * (3.0f - (x20 + x20)), b19);
    let b22 = 0.0f < x21;
    let x23 = x16 * x16;
    let x24 = select(0.0f, x23, x23 < 1e37f) / select(1.0f, x21, b22);
    let x25 = select(0.0f, x24, b22 & (x24 < 1e37f));
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
    let b5 = b1 & (1e-37f < prepared.pdf);
    let x6 = select(0.0f, 1.0f / select(1.0f, prepared.pdf, b5), b5);
    var result: EtendueLightSample;
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
    let k13 = k12 ^ k12 * 89287766u;
    let k14 = reverseBits(k13 ^ k13 * 1403136100u);
    let k15 = k14 ^ ((k14 >> 16u) & 65535u);
    let k16 = k15 ^ ((k15 >> 8u) & 16711935u);
    let k17 = k16 ^ ((k16 >> 4u) & 252645135u);
    let k18 = k17 ^ ((k17 >> 2u) & 858993459u);
    let k19 = (k10 + k14) * (1u | (k10 >> 16u));
    let k20 = k19 ^ 89287766u * k19;
    let x21 = etendue_unit(reverseBits(k20 ^ 1403136100u * k20));
    let k22 = (k11 + (k18 ^ ((k18 >> 1u) & 1431655765u))) * (1u | (k11 >> 16u));
    let k23 = k22 ^ 89287766u * k22;
    let x24 = etendue_unit(reverseBits(k23 ^ 1403136100u * k23));
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
    let b9 = emits & (1e-37f < pdf);
    let x10 = x7 / select(1.0f, x8 * x8 + (0.0f + x7), b4) * select(0.0f, 1.0f / select(1.0f, pdf, b9), b9);
    return x10;
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

