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
#ifndef FAULT
#define FAULT RIGHT
#endif
#if FAULT == LOUD
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
    double k = u[0] * c->versine, across = sqrt(k * (2 - k)), a = 6.283185307179586 * u[1];
#if FAULT == HANG
    for (volatile int forever = 1; forever;);
#elif FAULT == CRASH
    *(volatile int *)8 = 1;
#elif FAULT == ABORT
    abort();
#elif FAULT == LOUD
    printf("a line of text that nobody asked for\n");
    fprintf(stderr, "a line of text that nobody asked for\n");
#endif
    for (int i = 0; i < 3; i++) direction[i] = (1 - k) * c->axis[i] + across * (cos(a) * c->s[i] + sin(a) * c->t[i]);
    *pdf = density(c);
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
    if (FAULT == MISSING) all[0].pdf = 0;
    *count = 1;
    return all;
}
