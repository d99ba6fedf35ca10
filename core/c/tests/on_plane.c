// Points that are computed on lights are on them, as etendue_on_surface says; about half of them are in front through rounding.
#include "etendue.h"

#include <math.h>
#include <stdio.h>

static long checks;
static int failures;
#define CHECK(condition)                                                             \
    do {                                                                             \
        checks++;                                                                    \
        if (!(condition) && failures++ < 20) fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
    } while (0)

static float uniform(void) {
    static uint32_t state = 1;
    state = state * 1664525u + 1013904223u;
    return (float)(state >> 8) / 16777216.0f;
}

enum { POINTS = 20000 };
static void vector(float v[3], float size) {
    for (int k = 0; k < 3; k++) v[k] = size * (2 * uniform() - 1);
}
static void cross(const float a[3], const float b[3], float n[3]) {
    for (int k = 0; k < 3; k++) n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}
static void normalize(float v[3]) {
    const float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++) v[k] /= length;
}

typedef enum { TRIANGLE, PARALLELOGRAM, RECTANGLE, DISK, POLYGON, KINDS } Kind;
static const uint32_t by_area[] = {
    ETENDUE_TECHNIQUE_TRIANGLE_BY_AREA, ETENDUE_TECHNIQUE_PARALLELOGRAM_BY_AREA, ETENDUE_TECHNIQUE_RECTANGLE_BY_AREA,
    ETENDUE_TECHNIQUE_DISK_BY_AREA, ETENDUE_TECHNIQUE_POLYGON_BY_AREA,
};

int main(void) {
    for (Kind kind = TRIANGLE; kind < KINDS; kind++) {
        int in_front = 0;
        for (int i = 0; i < POINTS; i++) {
            // a corner far from the origin and two edges, which are perpendicular for rectangles and disks
            float a[3], s[3], t[3], n[3], p[3], off[3], u = uniform(), v = uniform();
            vector(a, 30);
            vector(s, 1);
            vector(t, 1);
            cross(s, t, n);
            normalize(n);
            if (kind == RECTANGLE || kind == DISK) cross(n, s, t);
            union {
                float numbers[24];
                EtendueTriangle flat;
                EtendueDisk disk;
            } light;
            for (int k = 0; k < 3; k++) {
                light.numbers[k] = a[k];
                light.numbers[3 + k] = kind == DISK ? n[k] : s[k];
                light.numbers[6 + k] = t[k];
            }
            if (kind == DISK) {
                light.disk.radius = sqrtf(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
                u -= 0.5f;
                v -= 0.5f;
            } else if (kind == TRIANGLE && u + v > 1) {
                u = 1 - u;
                v = 1 - v;
            } else if (kind == POLYGON) {
                for (int c = 0; c < 8; c++) {
                    for (int k = 0; k < 3; k++) light.numbers[3 * c + k] = a[k] + (c == 1 || c == 2 ? s[k] : 0) + (c >= 2 ? t[k] : 0);
                }
            }
            for (int k = 0; k < 3; k++) {
                p[k] = a[k] + u * s[k] + v * t[k];
                off[k] = p[k] + 0.01f * n[k];
            }
            CHECK(etendue_on_surface(by_area[kind], &light, p) == 1);
            CHECK(etendue_on_surface(by_area[kind], &light, off) == 0);
            EtenduePolygonByArea sampler; // the largest of these
            EtendueLightSample sample;
            const float half[2] = {0.3f, 0.6f};
            CHECK(etendue_prepare(by_area[kind], &light, p, NULL, &sampler) == ETENDUE_STATUS_OK);
            CHECK(etendue_sample(by_area[kind], &sampler, half, &sample) == ETENDUE_STATUS_OK);
            in_front += sample.weight > 0;
        }
        CHECK(in_front > POINTS / 5);
    }
    const float light[24] = {0};
    CHECK(etendue_on_surface(by_area[TRIANGLE], NULL, light) == 0 && etendue_on_surface(by_area[TRIANGLE], light, NULL) == 0);
    CHECK(etendue_on_surface(1000, light, light) == 0 && etendue_on_surface(ETENDUE_TECHNIQUE_SUN_BY_SOLID_ANGLE, light, light) == 0);
    printf("on_plane: %ld checks, %d failures\n", checks, failures);
    return failures != 0;
}
