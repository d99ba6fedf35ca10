/* Nanoseconds per call of one sample, one pdf: the textbook's formulas, the C library, and the header that needs none. See single_calls.py.
 *
 * Each is a translation unit of its own (this one, thrice), which exports a table. */
#define _POSIX_C_SOURCE 199309L
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { INPUTS = 1024, ROWS = 10 };
typedef struct {
    /* numbers of a light, a point of a surface, its normal, a direction to the light, random numbers */
    float light[9], p[3], n[3], w[3], u[2];
} Input;
typedef float (*Row)(const Input *);
/* A row that is not there is NULL. Each returns a number that depends on all that was asked for. */
typedef Row Column[ROWS];
extern const Column TEXTBOOK, LIBRARY, HEADER;
#define APART __attribute__((noinline)) static

#ifdef OF_TEXTBOOK
#include "textbook.h"
static float sum(Drawn s) { return s.point.x + s.point.y + s.point.z + s.normal.x + s.normal.y + s.normal.z + s.pdf + s.u + s.v; }
#define TRIANGLE(i) const V3 v[3] = {v3(i->light), v3(i->light + 3), v3(i->light + 6)}
APART float triangle(const Input *i) { TRIANGLE(i); return sum(textbook_triangle(v, v3(i->p), i->u[0], i->u[1])); }
APART float triangle_pdf(const Input *i) { TRIANGLE(i); return textbook_triangle_pdf(v, v3(i->p)); }
APART float sphere(const Input *i) { return sum(textbook_sphere(v3(i->light), 0.5f, v3(i->p), i->u[0], i->u[1])); }
APART float sphere_pdf(const Input *i) { return textbook_sphere_pdf(v3(i->light), 0.5f, v3(i->p)); }
APART float rectangle(const Input *i) {
    V3 x = {1, 0, 0}, y = {0, 0.5f, 0.5f};
    return sum(textbook_rectangle(v3(i->light), x, y, v3(i->p), i->u[0], i->u[1]));
}
APART float bilinear(const Input *i) {
    float u[2] = {i->u[0], i->u[1]}, weights[4] = {i->w[0] + 1, i->w[1] + 1, i->w[2] + 1, 1};
    textbook_bilinear(weights, u);
    return u[0] + u[1];
}
const Column TEXTBOOK = {triangle, NULL, triangle_pdf, NULL, sphere, sphere_pdf, rectangle, NULL, bilinear, NULL};
#endif

#ifdef OF_LIBRARY
#include "etendue.h"
static float sum(EtendueLightSample s) { return s.direction[0] + s.direction[1] + s.direction[2] + s.distance + s.pdf + s.normal[0] + s.normal[1] + s.normal[2] + s.uv[0] + s.uv[1]; }
/* A light is written where it is used: to copy what was just written takes the processor longer than to write it. */
static void a_triangle(const Input *i, EtendueTriangle *light) {
    for (int k = 0; k < 3; k++) {
        light->v0[k] = i->light[k];
        light->e1[k] = i->light[3 + k] - i->light[k];
        light->e2[k] = i->light[6 + k] - i->light[k];
    }
}
static EtendueSphere a_sphere(const Input *i) { return (EtendueSphere){{i->light[0], i->light[1], i->light[2]}, 0.5f}; }
static EtendueRectangle a_rectangle(const Input *i) { return (EtendueRectangle){{i->light[0], i->light[1], i->light[2]}, {1, 0, 0}, {0, 0.5f, 0.5f}}; }
#define SAMPLE(name, type, light, ...) \
    APART float name(const Input *i) { \
        EtendueLightSample s; \
        Etendue##type prepared; \
        light; \
        etendue_##name##_prepare(&l, i->p, __VA_ARGS__ &prepared); \
        etendue_##name##_sample(&prepared, i->u, &s); \
        return sum(s); \
    }
#define PDF(name, type, light, ...) \
    APART float name##_pdf(const Input *i) { \
        Etendue##type prepared; \
        light; \
        etendue_##name##_prepare(&l, i->p, __VA_ARGS__ &prepared); \
        return etendue_##name##_pdf(&prepared, i->w); \
    }
#define NORMAL i->n,
SAMPLE(triangle_by_solid_angle, TriangleBySolidAngle, EtendueTriangle l; a_triangle(i, &l), )
SAMPLE(triangle_by_projected_solid_angle, TriangleByProjectedSolidAngle, EtendueTriangle l; a_triangle(i, &l), NORMAL)
SAMPLE(sphere_by_solid_angle, SphereBySolidAngle, EtendueSphere l = a_sphere(i), )
SAMPLE(rectangle_by_solid_angle, RectangleBySolidAngle, EtendueRectangle l = a_rectangle(i), )
PDF(triangle_by_solid_angle, TriangleBySolidAngle, EtendueTriangle l; a_triangle(i, &l), )
PDF(triangle_by_projected_solid_angle, TriangleByProjectedSolidAngle, EtendueTriangle l; a_triangle(i, &l), NORMAL)
PDF(sphere_by_solid_angle, SphereBySolidAngle, EtendueSphere l = a_sphere(i), )
PDF(rectangle_by_solid_angle, RectangleBySolidAngle, EtendueRectangle l = a_rectangle(i), )
APART float bilinear(const Input *i) {
    EtendueBilinear warp = {{i->w[0] + 1, i->w[1] + 1, i->w[2] + 1, 1}};
    float point[2];
    etendue_bilinear_sample(&warp, i->u, point);
    return point[0] + point[1];
}
static EtendueTriangleBySolidAngle kept;
APART float prepared(const Input *i) {
    EtendueLightSample s;
    etendue_triangle_by_solid_angle_sample(&kept, i->u, &s);
    return sum(s);
}
__attribute__((constructor)) static void prepare(void) {
    const EtendueTriangle light = {{0, 2, 0}, {1, 0, 0}, {0, 0, 1}};
    const float p[3] = {0};
    etendue_triangle_by_solid_angle_prepare(&light, p, &kept);
}
const Column LIBRARY = {triangle_by_solid_angle, triangle_by_projected_solid_angle, triangle_by_solid_angle_pdf,
    triangle_by_projected_solid_angle_pdf, sphere_by_solid_angle, sphere_by_solid_angle_pdf, rectangle_by_solid_angle,
    rectangle_by_solid_angle_pdf, bilinear, prepared};
#endif

#ifdef OF_HEADER
#include "etendue_header.h"
static EtendueShaderVec3 v3(const float *x) { return (EtendueShaderVec3){x[0], x[1], x[2]}; }
static float sum(EtendueShaderLightSample s) { return s.direction.x + s.direction.y + s.direction.z + s.distance + s.pdf + s.normal.x + s.normal.y + s.normal.z + s.uv.x + s.uv.y; }
static EtendueShaderTriangle a_triangle(const Input *i) {
    const float *a = i->light, *b = a + 3, *c = a + 6;
    return (EtendueShaderTriangle){v3(a), {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, {c[0] - a[0], c[1] - a[1], c[2] - a[2]}};
}
static EtendueShaderSphere a_sphere(const Input *i) { return (EtendueShaderSphere){v3(i->light), 0.5f}; }
static EtendueShaderRectangle a_rectangle(const Input *i) { return (EtendueShaderRectangle){v3(i->light), {1, 0, 0}, {0, 0.5f, 0.5f}}; }
#define U (EtendueShaderVec2){i->u[0], i->u[1]}
#define ONCE(name, ...) APART float name(const Input *i) { return sum(etendue_shader_##name##_sample(etendue_shader_##name##_prepare(__VA_ARGS__), U)); }
#define PDF(name, ...) APART float name##_pdf(const Input *i) { return etendue_shader_##name##_pdf(etendue_shader_##name##_prepare(__VA_ARGS__), v3(i->w)); }
ONCE(triangle_by_solid_angle, a_triangle(i), v3(i->p))
ONCE(triangle_by_projected_solid_angle, a_triangle(i), v3(i->p), v3(i->n))
ONCE(sphere_by_solid_angle, a_sphere(i), v3(i->p))
ONCE(rectangle_by_solid_angle, a_rectangle(i), v3(i->p))
PDF(triangle_by_solid_angle, a_triangle(i), v3(i->p))
PDF(triangle_by_projected_solid_angle, a_triangle(i), v3(i->p), v3(i->n))
PDF(sphere_by_solid_angle, a_sphere(i), v3(i->p))
PDF(rectangle_by_solid_angle, a_rectangle(i), v3(i->p))
APART float bilinear(const Input *i) {
    EtendueShaderBilinear warp = {i->w[0] + 1, i->w[1] + 1, i->w[2] + 1, 1};
    EtendueShaderVec2 point = etendue_shader_bilinear_sample(warp, U);
    return point.x + point.y;
}
static EtendueShaderTriangleBySolidAngle kept;
APART float prepared(const Input *i) { return sum(etendue_shader_triangle_by_solid_angle_sample(kept, U)); }
__attribute__((constructor)) static void prepare(void) {
    EtendueShaderTriangle light = {{0, 2, 0}, {1, 0, 0}, {0, 0, 1}};
    EtendueShaderVec3 p = {0, 0, 0};
    kept = etendue_shader_triangle_by_solid_angle_prepare(light, p);
}
const Column HEADER = {triangle_by_solid_angle, triangle_by_projected_solid_angle, triangle_by_solid_angle_pdf,
    triangle_by_projected_solid_angle_pdf, sphere_by_solid_angle, sphere_by_solid_angle_pdf, rectangle_by_solid_angle,
    rectangle_by_solid_angle_pdf, bilinear, prepared};
#endif

#ifdef OF_PROGRAM
static const char *const NAMES[ROWS] = {"triangle: sample", "triangle, projected: sample", "triangle: pdf",
    "triangle, projected: pdf", "sphere: sample", "sphere: pdf", "rectangle: sample", "rectangle: pdf", "bilinear warp: sample", "triangle, prepared: sample"};
static Input inputs[INPUTS];
static unsigned state = 1;
static float next(void) {
    state = state * 747796405u + 2891336453u;
    unsigned word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (float)(((word >> 22) ^ word) >> 8) / 16777216.0f;
}
static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}
static volatile float sink;
static double time_of(Row row) {
    if (!row) {
        return 0;
    }
    double least = 1e30;
    for (int k = 0; k < 200; k++) {
        float total = 0;
        double start = now();
        for (int i = 0; i < INPUTS; i++) {
            total += row(&inputs[i]);
        }
        double each = (now() - start) / INPUTS;
        sink = total;
        least = each < least ? each : least;
    }
    return least;
}
int main(void) {
    for (int i = 0; i < INPUTS; i++) {
        Input *input = &inputs[i];
        for (int k = 0; k < 9; k++) {
            input->light[k] = next() * 2 + (k % 3 == 1 ? 1.5f : 0);
        }
        float length = 0;
        for (int k = 0; k < 3; k++) {
            input->p[k] = next();
            input->n[k] = k == 1 ? 1 : 0;
            /* towards the middle of the triangle */
            input->w[k] = (input->light[k] + input->light[3 + k] + input->light[6 + k]) / 3 - input->p[k];
            length += input->w[k] * input->w[k];
        }
        for (int k = 0; k < 3; k++) {
            float root = length;
            for (int step = 0; step < 20; step++) {
                root = (root + length / root) / 2;
            }
            input->w[k] /= root;
        }
        input->u[0] = next();
        input->u[1] = next();
    }
    /* in turns, so that a pause of the machine does not favour one */
    const Row *columns[3] = {TEXTBOOK, LIBRARY, HEADER};
    double times[ROWS][3];
    for (int r = 0; r < ROWS; r++) {
        for (int c = 0; c < 3; c++) {
            double first = time_of(columns[c][r]);
            times[r][c] = first;
        }
        for (int c = 0; c < 3; c++) {
            double again = time_of(columns[c][r]);
            times[r][c] = again < times[r][c] ? again : times[r][c];
        }
        printf("%-32s", NAMES[r]);
        for (int c = 0; c < 3; c++) {
            if (columns[c][r]) {
                printf(" %9.1f", times[r][c]);
            } else {
                printf("         -");
            }
        }
        printf("\n");
    }
    return 0;
}
#endif
