/* A sphere by solid angle, right or with the fault that FAULT names. */
#include "../include/etendue_judge.h"
#include <math.h>
#include <stdlib.h>

#define RIGHT 0
#define PDF 1
#define HANG 2
#define CRASH 3
#define ABORT 4
#define HALF 5
#define OLD 6
#define NOT_A_NUMBER 7
#define SHAPE 8
#define LOUD 9
#define MISSING 10
#define SAYS_WHY 11
#define NO_PDF 12
#define REJECTION 13
#define MAP 14
#define MANY 15
#ifndef FAULT
#define FAULT RIGHT
#endif
#if FAULT == LOUD || FAULT == SAYS_WHY
#include <stdio.h>
#endif

typedef struct {
    double axis[3], s[3], t[3], versine;
} cone;

static void *prepare(const float *light, const float p[3], const float n[3]) {
    double v[3], d = 0, r = light[3];
    cone *c = malloc(sizeof *c);
    (void)n;
    for (int k = 0; k < 3; k++) v[k] = (double)light[k] - p[k], d += v[k] * v[k];
    d = sqrt(d);
    for (int k = 0; k < 3; k++) c->axis[k] = v[k] / d;
    /* 1 - cos from the sine, without cancellation */
    c->versine = d > r ? r * r / (d * d) / (1 + sqrt((d - r) * (d + r)) / d) : 2;
    double h[3] = {fabs(c->axis[0]) < 0.6, fabs(c->axis[0]) >= 0.6, 0}, l = 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        c->s[k] = h[i] * c->axis[j] - h[j] * c->axis[i];
        l += c->s[k] * c->s[k];
    }
    for (int k = 0; k < 3; k++) c->s[k] /= sqrt(l);
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        c->t[k] = c->axis[i] * c->s[j] - c->axis[j] * c->s[i];
    }
    return c;
}
static float density(const cone *c) {
    double pdf = 1 / (6.283185307179586 * c->versine);
    if (FAULT == PDF && c->versine < 5e-6) pdf *= 1.01; /* smaller than 1/300 of the distance */
    return FAULT == NOT_A_NUMBER ? NAN : pdf;
}
static int sample(void *state, const float u[2], float direction[3], float *pdf) {
    const cone *c = state;
#if FAULT == REJECTION || FAULT == MAP
    /* a generator that starts from u, until a point of the square is in the disk */
    uint32_t seed = (uint32_t)(u[0] * 16777216.f) * 2654435761u ^ (uint32_t)(u[1] * 16777216.f);
    double x, y;
    do {
        double v[2];
        for (int i = 0; i < 2; i++) {
            seed ^= seed >> 16, seed *= 0x7feb352du, seed ^= seed >> 15, seed *= 0x846ca68bu, seed ^= seed >> 16, seed += 0x9e3779b9u;
            v[i] = seed / 4294967296.0 * 2 - 1;
        }
        x = v[0], y = v[1];
    } while (x * x + y * y > 1 || x * x + y * y == 0);
    float drawn[2] = {(float)(x * x + y * y), (float)(atan2(y, x) / 6.283185307179586 + 0.5)};
    u = drawn;
#endif
    double k = u[0] * c->versine, across = sqrt(k * (2 - k)), a = 6.283185307179586 * u[1];
#if FAULT == HANG
    for (volatile int forever = 1; forever;);
#elif FAULT == CRASH
    *(volatile int *)8 = 1;
#elif FAULT == ABORT
    abort();
#elif FAULT == SAYS_WHY
    fprintf(stderr, "a line of text that nobody asked for\nsphere.c: the radius is no number\n\n");
    abort();
#elif FAULT == LOUD
    printf("a line of text that nobody asked for\n");
    fprintf(stderr, "a line of text that nobody asked for\n");
#endif
    for (int i = 0; i < 3; i++) direction[i] = (1 - k) * c->axis[i] + across * (cos(a) * c->s[i] + sin(a) * c->t[i]);
    *pdf = density(c);
#if FAULT == MANY
    double off = direction[0] + 0.1, length = sqrt(off * off + direction[1] * direction[1] + direction[2] * direction[2]);
    direction[0] = off / length, direction[1] /= length, direction[2] /= length;
    *pdf *= 2;
#endif
    return ETENDUE_JUDGE_SAMPLE;
}
static float pdf(void *state, const float w[3]) {
    const cone *c = state;
    double d = 0;
    for (int k = 0; k < 3; k++) d += (w[k] - c->axis[k]) * (w[k] - c->axis[k]);
    return 0.5 * d <= c->versine * (1 + 1e-6) + 1e-12 ? density(c) : 0;
}
static int in_domain(const float *light, const float p[3], const float n[3]) {
    double d = 0;
    (void)n;
    for (int k = 0; k < 3; k++) d += ((double)light[k] - p[k]) * ((double)light[k] - p[k]);
    return sqrt(d) * 3e-3 < light[3];
}

const etendue_judge_sampler *etendue_judge_samplers(uint32_t *count) {
    static etendue_judge_sampler all[1] = {{
        .abi = FAULT == OLD ? 0 : ETENDUE_JUDGE_ABI,
        .size = sizeof all[0],
        .name = "cone",
        .shape = FAULT == SHAPE ? "torus" : "sphere",
        .measure = "solid angle",
        .prepare = prepare,
        .sample = sample,
        .pdf = pdf,
        .release = free,
    }};
    if (FAULT == HALF) all[0].domain = "the light is larger than 1/300 of its distance", all[0].in_domain = in_domain;
    if (FAULT == MISSING) all[0].prepare = 0;
    if (FAULT == NO_PDF) all[0].pdf = 0;
    if (FAULT == REJECTION) all[0].is_generator = 1;
    *count = 1;
    return all;
}
