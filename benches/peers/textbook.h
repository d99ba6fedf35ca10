/* How textbooks sample lights, in single precision, one sample at a time: what a host has today (PBR, 4th edition: pbr-book.org).
 * Written from the formulas that are named at each function. */
#ifndef TEXTBOOK_H
#define TEXTBOOK_H

#include <math.h>

#define PI 3.14159265358979f

typedef struct {
    float x, y, z;
} V3;
typedef struct {
    V3 point, normal;
    float pdf, u, v; /* surface coordinates, for textures */
} Drawn;

static inline V3 v3(const float *x) { return (V3){x[0], x[1], x[2]}; }
static inline V3 add(V3 a, V3 b) { return (V3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline V3 sub(V3 a, V3 b) { return (V3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline V3 mul(float s, V3 a) { return (V3){s * a.x, s * a.y, s * a.z}; }
static inline float dot(V3 a, V3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline float product_difference(float a, float b, float c, float d) {
    float cd = c * d;
    return fmaf(a, b, -cd) + fmaf(-c, d, cd);
}
static inline V3 cross(V3 a, V3 b) {
    return (V3){product_difference(a.y, b.z, a.z, b.y), product_difference(a.z, b.x, a.x, b.z), product_difference(a.x, b.y, a.y, b.x)};
}
static inline float length(V3 a) { return sqrtf(dot(a, a)); }
static inline V3 unit(V3 a) { return mul(1 / length(a), a); }
static inline float clamp(float x, float low, float high) { return x < low ? low : x > high ? high : x; }
static inline float root(float x) { return sqrtf(x > 0 ? x : 0); }
static inline float angle(V3 a, V3 b) {
    float half = length(dot(a, b) < 0 ? add(a, b) : sub(b, a)) / 2;
    float twice = 2 * asinf(clamp(half, -1, 1));
    return dot(a, b) < 0 ? PI - twice : twice;
}

/* Solid angle of a triangle of unit vectors (Van Oosterom and Strackee 1983). */
static inline float triangle_solid_angle(V3 a, V3 b, V3 c) {
    return fabsf(2 * atan2f(dot(a, cross(b, c)), 1 + dot(a, b) + dot(a, c) + dot(b, c)));
}

/* The pdf of a triangle, uniform in solid angle (PBR 6.5.4). */
static inline float textbook_triangle_pdf(const V3 v[3], V3 p) {
    float solid_angle = triangle_solid_angle(unit(sub(v[0], p)), unit(sub(v[1], p)), unit(sub(v[2], p)));
    return solid_angle > 0 ? 1 / solid_angle : 0;
}

/* A triangle, uniform in solid angle (Arvo 1995; PBR 6.5.4). */
static inline Drawn textbook_triangle(const V3 v[3], V3 p, float u0, float u1) {
    Drawn none = {{0, 0, 0}, {0, 0, 0}, 0, 0, 0};
    V3 a = unit(sub(v[0], p)), b = unit(sub(v[1], p)), c = unit(sub(v[2], p));
    V3 ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
    if (dot(ab, ab) == 0 || dot(bc, bc) == 0 || dot(ca, ca) == 0) {
        return none;
    }
    ab = unit(ab), bc = unit(bc), ca = unit(ca);
    float alpha = angle(ab, mul(-1, ca)), beta = angle(bc, mul(-1, ab)), gamma = angle(ca, mul(-1, bc));
    float area = alpha + beta + gamma - PI;
    if (area <= 0) {
        return none;
    }
    float swept = PI + u0 * area, cos_alpha = cosf(alpha), sin_alpha = sinf(alpha);
    float sin_phi = sinf(swept) * cos_alpha - cosf(swept) * sin_alpha, cos_phi = cosf(swept) * cos_alpha + sinf(swept) * sin_alpha;
    float k1 = cos_phi + cos_alpha, k2 = sin_phi - sin_alpha * dot(a, b);
    float cos_side = (k2 + product_difference(k2, cos_phi, k1, sin_phi) * cos_alpha) / ((sin_phi * k2 + cos_phi * k1) * sin_alpha);
    cos_side = clamp(cos_side, -1, 1);
    V3 to_c = unit(sub(c, mul(dot(c, a), a)));
    V3 far = add(mul(cos_side, a), mul(root(1 - cos_side * cos_side), to_c));
    float z = 1 - u1 * (1 - dot(far, b));
    V3 w = add(mul(z, b), mul(root(1 - z * z), unit(sub(far, mul(dot(far, b), b)))));
    /* barycentric coordinates by the intersection of Moeller and Trumbore */
    V3 e1 = sub(v[1], v[0]), e2 = sub(v[2], v[0]), s1 = cross(w, e2);
    float divisor = dot(s1, e1);
    if (divisor == 0) {
        return none;
    }
    V3 s = sub(p, v[0]);
    float b1 = clamp(dot(s, s1) / divisor, 0, 1), b2 = clamp(dot(w, cross(s, e1)) / divisor, 0, 1);
    if (b1 + b2 > 1) {
        b1 /= b1 + b2, b2 = 1 - b1;
    }
    V3 point = add(v[0], add(mul(b1, e1), mul(b2, e2)));
    return (Drawn){point, unit(cross(e1, e2)), 1 / area, b1, b2};
}

static inline float linear(float u, float a, float b) {
    if (u == 0 && a == 0) {
        return 0;
    }
    float x = u * (a + b) / (a + sqrtf((1 - u) * a * a + u * b * b));
    return x < 0.99999994f ? x : 0.99999994f;
}
/* The bilinear warp of the unit square (PBR 2.4). */
static inline void textbook_bilinear(const float w[4], float u[2]) {
    u[1] = linear(u[1], w[0] + w[1], w[2] + w[3]);
    u[0] = linear(u[0], (1 - u[1]) * w[0] + u[1] * w[2], (1 - u[1]) * w[1] + u[1] * w[3]);
}

/* The cone of directions to a sphere (PBR 6.2.4). */
static inline float one_minus_cos_of_sphere(V3 center, float radius, V3 p) {
    V3 d = sub(p, center);
    float sin2 = radius * radius / dot(d, d), cosine = root(1 - sin2);
    return sin2 < 0.00068523f ? sin2 / 2 : 1 - cosine;
}
static inline float textbook_sphere_pdf(V3 center, float radius, V3 p) {
    return 1 / (2 * PI * one_minus_cos_of_sphere(center, radius, p));
}
static inline Drawn textbook_sphere(V3 center, float radius, V3 p, float u0, float u1) {
    V3 to = sub(center, p);
    float distance = length(to), sin_max = radius / distance, sin2_max = sin_max * sin_max, cos_max = root(1 - sin2_max);
    float one_minus_cos = 1 - cos_max, cosine = (cos_max - 1) * u0 + 1, sin2 = 1 - cosine * cosine;
    if (sin2_max < 0.00068523f) {
        sin2 = sin2_max * u0, cosine = sqrtf(1 - sin2), one_minus_cos = sin2_max / 2;
    }
    float cos_alpha = sin2 / sin_max + cosine * root(1 - sin2 / (sin_max * sin_max)), sin_alpha = root(1 - cos_alpha * cos_alpha);
    float phi = u1 * 2 * PI;
    V3 z = mul(-1 / distance, to);
    float sign = copysignf(1, z.z), a = -1 / (sign + z.z), b = z.x * z.y * a;
    V3 x = {1 + sign * z.x * z.x * a, sign * b, -sign * z.x}, y = {b, sign + z.y * z.y * a, -z.y};
    V3 normal = add(add(mul(sin_alpha * cosf(phi), x), mul(sin_alpha * sinf(phi), y)), mul(cos_alpha, z));
    float turn = atan2f(normal.y, normal.x);
    return (Drawn){add(center, mul(radius, normal)), normal, 1 / (2 * PI * one_minus_cos), (turn < 0 ? turn + 2 * PI : turn) / (2 * PI),
        acosf(clamp(normal.z, -1, 1)) / PI};
}

/* A rectangle, uniform in solid angle (Urena et al. 2013). */
static inline Drawn textbook_rectangle(V3 corner, V3 ex, V3 ey, V3 p, float u0, float u1) {
    float lx = length(ex), ly = length(ey);
    V3 x = mul(1 / lx, ex), y = mul(1 / ly, ey), z = cross(x, y), d = sub(corner, p);
    float x0 = dot(d, x), y0 = dot(d, y), z0 = dot(d, z), x1 = x0 + lx, y1 = y0 + ly;
    if (z0 > 0) {
        z = mul(-1, z), z0 = -z0;
    }
    V3 v00 = {x0, y0, z0}, v01 = {x0, y1, z0}, v10 = {x1, y0, z0}, v11 = {x1, y1, z0};
    V3 n0 = unit(cross(v00, v10)), n1 = unit(cross(v10, v11)), n2 = unit(cross(v11, v01)), n3 = unit(cross(v01, v00));
    float g0 = angle(mul(-1, n0), n1), g1 = angle(mul(-1, n1), n2), g2 = angle(mul(-1, n2), n3), g3 = angle(mul(-1, n3), n0);
    float area = g0 + g1 + g2 + g3 - 2 * PI, b0 = n0.z, b1 = n2.z;
    float au = u0 * area - g2 - g3 + 2 * PI, fu = (cosf(au) * b0 - b1) / sinf(au);
    float cu = clamp(copysignf(1 / sqrtf(fu * fu + b0 * b0), fu), -0.99999994f, 0.99999994f);
    float xu = clamp(-(cu * z0) / root(1 - cu * cu), x0, x1);
    float dd = sqrtf(xu * xu + z0 * z0), h0 = y0 / sqrtf(dd * dd + y0 * y0), h1 = y1 / sqrtf(dd * dd + y1 * y1);
    float hv = h0 + u1 * (h1 - h0), hv2 = hv * hv, yv = hv2 < 1 - 1e-6f ? hv * dd / sqrtf(1 - hv2) : y1;
    return (Drawn){add(p, add(add(mul(xu, x), mul(yv, y)), mul(z0, z))), z, area > 0 ? 1 / area : 0, (xu - x0) / lx,
        (yv - y0) / ly};
}

#endif
