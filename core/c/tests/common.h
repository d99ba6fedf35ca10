// What the tests in C have in common: checks, memory that shows what is written and read, and samples in columns. For inclusion after
// _DEFAULT_SOURCE is defined.
#ifndef ETENDUE_TESTS_COMMON_H
#define ETENDUE_TESTS_COMMON_H

#include "etendue.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *current = "";
static long checks;
static int failures;
#define CHECK(condition)                                                                   \
    do {                                                                                   \
        checks++;                                                                          \
        if (!(condition) && failures++ < 20)                                               \
            fprintf(stderr, "%s:%d: %s: not so: %s\n", __FILE__, __LINE__, current, #condition); \
    } while (0)
#define OK ETENDUE_STATUS_OK
#define REFUSED ETENDUE_STATUS_NULL_POINTER

// ---- memory ----

// Columns for results, of n elements each, with a gap around each of them, at addresses that are not multiples of 4.
enum { GAP = 13, PATTERN = 0xA5, COLUMNS = 12 };
typedef struct {
    unsigned char *memory;
    size_t n, bytes;
    float *column[COLUMNS];
} Results;

static Results results(size_t n) {
    Results r;
    r.n = n;
    r.bytes = COLUMNS * (4 * n + GAP) + GAP;
    r.memory = malloc(r.bytes);
    memset(r.memory, PATTERN, r.bytes);
    for (size_t k = 0; k < COLUMNS; k++) r.column[k] = (float *)(void *)(r.memory + GAP + k * (4 * n + GAP));
    return r;
}
static int is_untouched(const unsigned char *at, size_t bytes) {
    for (size_t i = 0; i < bytes; i++)
        if (at[i] != PATTERN) return 0;
    return 1;
}
// Whether all bytes outside of the columns from `first` to `end` are as they were.
static int only_written(const Results *r, int first, int end) {
    int so = is_untouched(r->memory, GAP);
    for (int k = 0; k < COLUMNS; k++) {
        const unsigned char *column = (const unsigned char *)r->column[k];
        so = so && is_untouched(column + 4 * r->n, GAP) && ((k >= first && k < end) || is_untouched(column, 4 * r->n));
    }
    return so;
}
static float at(const float *column, size_t i) {
    float x;
    memcpy(&x, (const unsigned char *)column + 4 * i, 4);
    return x;
}
static int same(float a, float b) { return memcmp(&a, &b, 4) == 0; }

static uint32_t state = 1;
static float uniform(void) {
    state = state * 1664525u + 1013904223u;
    return (float)(state >> 8) / 16777216.0f;
}
// a unit vector towards y > 0, or anywhere
static void direction(float *w, int any) {
    float length = 0;
    do {
        for (int k = 0; k < 3; k++) w[k] = 2 * uniform() - 1;
        if (!any) w[1] = fabsf(w[1]);
        length = sqrtf(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    } while (length < 0.1f || length > 1);
    for (int k = 0; k < 3; k++) w[k] /= length;
}

// ---- samples ----

static EtendueSampleColumns sample_columns(float *const *column) {
    EtendueSampleColumns out;
    for (int k = 0; k < 3; k++) {
        out.direction[k] = column[k];
        out.normal[k] = column[6 + k];
    }
    out.distance = column[3];
    out.pdf = column[4];
    out.weight = column[5];
    out.uv[0] = column[9];
    out.uv[1] = column[10];
    out.emits = (uint8_t *)column[11];
    return out;
}
// Whether element i of the columns that are there is this sample, bit for bit.
static int is_sample(float *const *column, size_t i, const EtendueLightSample *s) {
    const float fields[] = {s->direction[0], s->direction[1], s->direction[2], s->distance, s->pdf, s->weight,
                            s->normal[0],    s->normal[1],    s->normal[2],    s->uv[0],    s->uv[1]};
    for (int k = 0; k < 11; k++)
        if (column[k] && !same(at(column[k], i), fields[k])) return 0;
    return !column[11] || ((const uint8_t *)column[11])[i] == s->emits;
}
static int is_finite(const EtendueLightSample *s) {
    int so = isfinite(s->distance) && isfinite(s->pdf) && isfinite(s->weight) && s->emits <= 1;
    for (int k = 0; k < 3; k++) so = so && isfinite(s->direction[k]) && isfinite(s->normal[k]);
    return so && isfinite(s->uv[0]) && isfinite(s->uv[1]);
}
// The greatest difference of two vectors' coordinates.
static float difference(const float *a, const float *b, int count) {
    float most = 0;
    for (int k = 0; k < count; k++) most = fmaxf(most, fabsf(a[k] - b[k]));
    return most;
}

#endif
