// Tests of all functions of etendue.h, in C99: test [--few | --huge]
//
// --few leaves out the long batches, for valgrind; --huge tests batches of more than 2^31 elements alone: some 20 s.
//
// Every technique, warp and sequence has one row in a table of functions of the same form, which macros write; the tests are loops over
// these tables. Outputs lie at odd addresses between bytes that must not change; inputs lie at odd addresses before a page that cannot
// be read.
#define _DEFAULT_SOURCE
#include "common.h"

#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

enum { MOST = 1000, SIZES = 5, LIGHT_NUMBERS = 24, SAMPLER_NUMBERS = 1200 };
static size_t sizes[SIZES] = {0, 1, 7, 64, MOST};

// ---- memory ----

// A column for input that ends a byte before a page that cannot be read.
typedef struct {
    unsigned char *memory;
    size_t bytes;
    float *column;
} Input;
static Input input(const float *from, size_t n) {
    const size_t page = (size_t)sysconf(_SC_PAGESIZE), bytes = (4 * n + page) / page * page;
    Input in;
    in.bytes = bytes + page;
    in.memory = mmap(NULL, in.bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if ((void *)in.memory == MAP_FAILED || mprotect(in.memory + bytes, page, PROT_NONE) != 0) abort();
    in.column = (float *)(void *)(in.memory + bytes - 1 - 4 * n);
    memcpy(in.column, from, 4 * n);
    return in;
}
static void release(Input in) { munmap(in.memory, in.bytes); }

// ---- techniques ----

typedef struct {
    const char *name;
    const float *light;
    size_t light_numbers, sampler_numbers;
    // what it needs beside the point: 1 the normal `n`, 2 a reflection, of which `n` is the normal
    int on_surface;
    EtendueStatus (*prepare)(const float *light, const float *p, const float *n, float *sampler);
    EtendueStatus (*sample)(const float *sampler, const float *u, EtendueLightSample *out);
    float (*pdf)(const float *sampler, const float *w);
    EtendueStatus (*invert)(const float *sampler, const float *w, float *u);
    EtendueStatus (*hit)(const float *sampler, const float *w, EtendueLightSample *out);
    EtendueStatus (*sample_batch)(const float *sampler, size_t n, const float *const *u, const EtendueSampleColumns *out);
    EtendueStatus (*pdf_batch)(const float *sampler, size_t n, const float *const *w, float *out);
    EtendueStatus (*invert_batch)(const float *sampler, size_t n, const float *const *w, float *const *u);
    EtendueStatus (*hit_batch)(const float *sampler, size_t n, const float *const *w, const EtendueSampleColumns *out);
    EtendueStatus (*each)(const float *const *lights, size_t n, const float *const *p, const float *const *normals,
                          const float *const *u, const EtendueSampleColumns *out);
    EtendueStatus (*hit_each)(const float *const *lights, size_t n, const float *const *p, const float *const *normals,
                              const float *const *w, const EtendueSampleColumns *out);
    EtendueStatus (*pdf_each)(const float *const *lights, size_t n, const float *const *p, const float *const *normals,
                              const float *const *w, float *out);
    EtendueStatus (*invert_each)(const float *const *lights, size_t n, const float *const *p, const float *const *normals,
                                 const float *const *w, float *const *u);
} Technique;

// Reflections of floors with the normals `n`, which a viewer sees along them, as functions of normals take them.
static const float alpha = 0.3f;
static EtendueReflection reflection_memory;
static const EtendueReflection *reflection(const float *n) {
    return n && etendue_reflection_prepare(alpha, n, n, &reflection_memory) == ETENDUE_STATUS_OK ? &reflection_memory : NULL;
}
static float reflection_numbers[16][MOST], alphas[MOST];
static EtendueReflectionColumns reflection_columns;
static const EtendueReflectionColumns *reflections(size_t n, const float *const *normals) {
    for (int k = 0; k < 14; k++) reflection_columns.data[k] = reflection_numbers[k];
    reflection_columns.albedo = reflection_numbers[14];
    reflection_columns.schlick = reflection_numbers[15];
    for (size_t i = 0; i < MOST; i++) alphas[i] = alpha;
    const int prepared = normals && etendue_reflection_prepare_batch(n, alphas, normals, normals, &reflection_columns) == ETENDUE_STATUS_OK;
    return prepared ? &reflection_columns : NULL;
}

// The functions of a technique with all structs as arrays of numbers or pointers. N and NORMALS are the arguments for normals, if any.
#define FUNCTIONS(NAME, LIGHT, PREFIX, N, NORMALS)                                                                                  \
    static EtendueStatus PREFIX##_1(const float *light, const float *p, const float *n, float *sampler) {                           \
        (void)n;                                                                                                                    \
        return etendue_##PREFIX##_prepare((const Etendue##LIGHT *)light, p, N(Etendue##NAME *) sampler);                            \
    }                                                                                                                               \
    static EtendueStatus PREFIX##_2(const float *sampler, const float *u, EtendueLightSample *out) {                                \
        return etendue_##PREFIX##_sample((const Etendue##NAME *)sampler, u, out);                                                   \
    }                                                                                                                               \
    static float PREFIX##_3(const float *sampler, const float *w) {                                                                 \
        return etendue_##PREFIX##_pdf((const Etendue##NAME *)sampler, w);                                                           \
    }                                                                                                                               \
    static EtendueStatus PREFIX##_4(const float *sampler, const float *w, float *u) {                                               \
        return etendue_##PREFIX##_invert((const Etendue##NAME *)sampler, w, u);                                                     \
    }                                                                                                                               \
    static EtendueStatus PREFIX##_5(const float *sampler, const float *w, EtendueLightSample *out) {                                \
        return etendue_##PREFIX##_hit((const Etendue##NAME *)sampler, w, out);                                                      \
    }                                                                                                                               \
    static EtendueStatus PREFIX##_6(const float *sampler, size_t n, const float *const *u, const EtendueSampleColumns *out) {       \
        return etendue_##PREFIX##_sample_batch((const Etendue##NAME *)sampler, n, u, out);                                          \
    }                                                                                                                               \
    static EtendueStatus PREFIX##_7(const float *sampler, size_t n, const float *const *w, float *out) {                            \
        return etendue_##PREFIX##_pdf_batch((const Etendue##NAME *)sampler, n, w, out);                                             \
    }                                                                                                                               \
    static EtendueStatus PREFIX##_8(const float *sampler, size_t n, const float *const *w, float *const *u) {                       \
        return etendue_##PREFIX##_invert_batch((const Etendue##NAME *)sampler, n, w, u);                                            \
    }                                                                                                                               \
    static EtendueStatus PREFIX##_9(const float *sampler, size_t n, const float *const *w, const EtendueSampleColumns *out) {      \
        return etendue_##PREFIX##_hit_batch((const Etendue##NAME *)sampler, n, w, out);                                             \
    }                                                                                                                               \
    static EtendueStatus PREFIX##_10(const float *const *lights, size_t n, const float *const *p, const float *const *normals,      \
                                     const float *const *u, const EtendueSampleColumns *out) {                                      \
        (void)normals;                                                                                                              \
        return etendue_##PREFIX##_sample_each((const Etendue##LIGHT##Columns *)(const void *)lights, n, p, NORMALS u, out);         \
    }                                                                                                                               \
    static EtendueStatus PREFIX##_11(const float *const *lights, size_t n, const float *const *p, const float *const *normals,      \
                                     const float *const *w, const EtendueSampleColumns *out) {                                      \
        (void)normals;                                                                                                              \
        return etendue_##PREFIX##_hit_each((const Etendue##LIGHT##Columns *)(const void *)lights, n, p, NORMALS w, out);            \
    }                                                                                                                               \
    static EtendueStatus PREFIX##_12(const float *const *lights, size_t n, const float *const *p, const float *const *normals,      \
                                     const float *const *w, float *out) {                                                           \
        (void)normals;                                                                                                              \
        return etendue_##PREFIX##_pdf_each((const Etendue##LIGHT##Columns *)(const void *)lights, n, p, NORMALS w, out);            \
    }                                                                                                                               \
    static EtendueStatus PREFIX##_13(const float *const *lights, size_t n, const float *const *p, const float *const *normals,      \
                                     const float *const *w, float *const *out) {                                                    \
        (void)normals;                                                                                                              \
        return etendue_##PREFIX##_invert_each((const Etendue##LIGHT##Columns *)(const void *)lights, n, p, NORMALS w, out);         \
    }
#define COMMA ,
#define FUNCTIONS_0(NAME, LIGHT, PREFIX) FUNCTIONS(NAME, LIGHT, PREFIX, , )
#define FUNCTIONS_1(NAME, LIGHT, PREFIX) FUNCTIONS(NAME, LIGHT, PREFIX, n COMMA, normals COMMA)
#define FUNCTIONS_2(NAME, LIGHT, PREFIX) FUNCTIONS(NAME, LIGHT, PREFIX, reflection(n) COMMA, reflections(n COMMA normals) COMMA)

// name, light, functions, what it needs beside the point: 1 a normal, 2 a reflection
// from the list of techniques: WRITE=1 cargo test -p etendue-tests bindings
#define TECHNIQUES(T) \
    T(SphereByArea, Sphere, sphere_by_area, 0) \
    T(SphereBySolidAngle, Sphere, sphere_by_solid_angle, 0) \
    T(SphereByProjectedSolidAngle, Sphere, sphere_by_projected_solid_angle, 1) \
    T(SphereByReflection, Sphere, sphere_by_reflection, 2) \
    T(TriangleByArea, Triangle, triangle_by_area, 0) \
    T(TriangleBySolidAngle, Triangle, triangle_by_solid_angle, 0) \
    T(TriangleByProjectedSolidAngle, Triangle, triangle_by_projected_solid_angle, 1) \
    T(TriangleByReflection, Triangle, triangle_by_reflection, 2) \
    T(ParallelogramByArea, Parallelogram, parallelogram_by_area, 0) \
    T(ParallelogramBySolidAngle, Parallelogram, parallelogram_by_solid_angle, 0) \
    T(ParallelogramByProjectedSolidAngle, Parallelogram, parallelogram_by_projected_solid_angle, 1) \
    T(ParallelogramByReflection, Parallelogram, parallelogram_by_reflection, 2) \
    T(ParallelogramByArea, Rectangle, rectangle_by_area, 0) \
    T(RectangleBySolidAngle, Rectangle, rectangle_by_solid_angle, 0) \
    T(ParallelogramByProjectedSolidAngle, Rectangle, rectangle_by_projected_solid_angle, 1) \
    T(ParallelogramByReflection, Rectangle, rectangle_by_reflection, 2) \
    T(DiskByArea, Disk, disk_by_area, 0) \
    T(DiskBySolidAngle, Disk, disk_by_solid_angle, 0) \
    T(PolygonByArea, Polygon, polygon_by_area, 0) \
    T(PolygonBySolidAngle, Polygon, polygon_by_solid_angle, 0) \
    T(PolygonByProjectedSolidAngle, Polygon, polygon_by_projected_solid_angle, 1) \
    T(PolygonByReflection, Polygon, polygon_by_reflection, 2) \
    T(PatchByArea, BilinearPatch, patch_by_area, 0) \
    T(LineByLength, Line, line_by_length, 0) \
    T(LineByAngle, Line, line_by_angle, 0) \
    T(LineByProjectedSolidAngle, Line, line_by_projected_solid_angle, 1) \
    T(SunBySolidAngle, Sun, sun_by_solid_angle, 0) \
    T(PointLightByDelta, PointLight, point_light_by_delta, 0) \
    T(SpotLightByDelta, SpotLight, spot_light_by_delta, 0) \
    T(DirectionalLightByDelta, DirectionalLight, directional_light_by_delta, 0)
// end of what is from the list

static const float Sphere[] = {0.3f, 2, 0.1f, 0.5f};
static const float Triangle[] = {-0.5f, 2, -0.3f, 1.2f, 0.1f, 0.2f, 0.1f, 0.2f, 1.1f};
static const float Parallelogram[] = {-0.5f, 2, -0.3f, 1.2f, 0.1f, 0.2f, 0.1f, 0.2f, 1.1f};
static const float Rectangle[] = {-0.5f, 2, -0.3f, 1.2f, 0, 0, 0, 0.3f, 0.9f};
static const float Disk[] = {0.3f, 2, 0.1f, 0, -1, 0, 0.5f};
static const float BilinearPatch[] = {-0.5f, 2, -0.3f, 1.2f, 0.1f, 0.2f, 0.1f, 0.2f, 1.1f, 1.3f, 0.6f, 1.2f};
static const float Polygon[] = {-0.5f, 2, -0.3f, 0.6f, 2, -0.4f, 0.9f, 2, 0.4f, 0.2f, 2, 0.9f, -0.6f, 2, 0.5f,
                                -0.6f, 2, 0.5f, -0.6f, 2, 0.5f, -0.6f, 2, 0.5f};
static const float Line[] = {-1, 2, 0.3f, 2, 0.1f, 0.2f};
static const float Sun[] = {0.36f, 0.8f, 0.48f, 1e-3f};
static const float PointLight[] = {0.3f, 2, 0.1f};
static const float SpotLight[] = {0.3f, 2, 0.1f, 0, -1, 0, 0.1f, 0.5f};
static const float DirectionalLight[] = {0.36f, 0.8f, 0.48f};

#define WRITE_FUNCTIONS(NAME, LIGHT, PREFIX, ON_SURFACE) FUNCTIONS_##ON_SURFACE(NAME, LIGHT, PREFIX)
TECHNIQUES(WRITE_FUNCTIONS)
#define ROW(NAME, LIGHT, PREFIX, ON_SURFACE)                                                                         \
    {#PREFIX, LIGHT, sizeof(Etendue##LIGHT) / 4, sizeof(Etendue##NAME) / 4, ON_SURFACE, PREFIX##_1, PREFIX##_2,      \
     PREFIX##_3, PREFIX##_4, PREFIX##_5, PREFIX##_6, PREFIX##_7, PREFIX##_8, PREFIX##_9, PREFIX##_10, PREFIX##_11,      \
     PREFIX##_12, PREFIX##_13},
static const Technique techniques[] = {TECHNIQUES(ROW)};

static int is_delta(const Technique *t) {
    return strstr(t->name, "by_delta") != NULL;
}
// Whether the pdf of a sample is that of its direction, bit for bit: not of a point of a curved light, nor of a line or a delta light.
static int is_closed(const Technique *t) {
    const int is_curved = t->light == Sphere || t->light == BilinearPatch;
    return t->light != Line && !is_delta(t) && !(is_curved && strstr(t->name, "by_area"));
}

static float u_numbers[2][MOST], w_numbers[3][MOST], p_numbers[3][MOST], n_numbers[3][MOST];
static const float origin[3] = {0.1f, 0, -0.2f}, up[3] = {0, 1, 0};

static void test_values(const Technique *t, const float *sampler) {
    float worst = 0;
    for (int i = 0; i < 200; i++) {
        const float u[2] = {u_numbers[0][i], u_numbers[1][i]};
        EtendueLightSample s, hit, again;
        float back[2];
        CHECK(t->sample(sampler, u, &s) == OK && is_finite(&s) && s.pdf > 0);
        CHECK(s.emits ? fabsf(s.weight * s.pdf - 1) < 1e-6f : s.weight == 0);
        const float length = s.direction[0] * s.direction[0] + s.direction[1] * s.direction[1] + s.direction[2] * s.direction[2];
        CHECK(fabsf(length - 1) < 1e-6f);
        const float pdf = t->pdf(sampler, s.direction);
        if (is_closed(t)) CHECK(same(pdf, s.pdf));
        // rays do not hit lines, and delta lights have no density
        CHECK(t->hit(sampler, s.direction, &hit) == OK && is_finite(&hit) && same(hit.pdf, t->light == Line ? 0 : pdf));
        if (is_delta(t)) CHECK(pdf == 0 && s.weight > 0);
        CHECK(t->invert(sampler, s.direction, back) == OK);
        CHECK(back[0] >= 0 && back[0] < 1 && back[1] >= 0 && back[1] < 1);
        if (pdf > 0) {
            CHECK(difference(hit.direction, s.direction, 3) == 0);
            // the far side of a curved light by area is mapped to the near side, but in the same direction
            CHECK(t->sample(sampler, back, &again) == OK);
            worst = fmaxf(worst, difference(again.direction, s.direction, 3));
        }
    }
    CHECK(worst < 1e-5f);
    // a direction away from the light, and a light without extent
    const float down[3] = {0, -1, 0}, nothing[LIGHT_NUMBERS] = {0}, u[2] = {0.3f, 0.6f};
    float degenerate[SAMPLER_NUMBERS];
    EtendueLightSample s;
    CHECK(t->pdf(sampler, down) == 0);
    CHECK(t->hit(sampler, down, &s) == OK && is_finite(&s) && s.pdf == 0 && s.weight == 0);
    CHECK(t->prepare(nothing, origin, up, degenerate) == OK);
    // a delta light has none anyway
    CHECK(t->sample(degenerate, u, &s) == OK && is_finite(&s) && (is_delta(t) || (s.pdf == 0 && s.weight == 0)));
}

// Batches equal single calls, at all sizes, with unaligned columns, with results in the place of inputs and with some results absent.
static void test_batches(const Technique *t, const float *sampler) {
    for (int size = 0; size < SIZES; size++) {
        const size_t n = sizes[size];
        Input u[2], w[3], p[3], normal[3], light[LIGHT_NUMBERS];
        const float *u_in[2], *w_in[3], *p_in[3], *n_in[3], *light_in[LIGHT_NUMBERS];
        float numbers[MOST];
        for (int k = 0; k < 2; k++) u_in[k] = (u[k] = input(u_numbers[k], n)).column;
        for (int k = 0; k < 3; k++) {
            w_in[k] = (w[k] = input(w_numbers[k], n)).column;
            p_in[k] = (p[k] = input(p_numbers[k], n)).column;
            n_in[k] = (normal[k] = input(n_numbers[k], n)).column;
        }
        // every fifth light has no extent, which must not disturb its neighbours
        for (size_t k = 0; k < t->light_numbers; k++) {
            for (size_t i = 0; i < n; i++) numbers[i] = i % 5 == 4 ? 0 : t->light[k];
            light_in[k] = (light[k] = input(numbers, n)).column;
        }
        // absent: none, each column alone, all
        for (int absent = -1; absent <= COLUMNS; absent++) {
            Results s = results(n), h = results(n), e = results(n), g = results(n), few = results(n);
            Results *const all[] = {&s, &h, &e, &g};
            for (int r = 0; r < 4; r++) {
                for (int k = 0; k < COLUMNS; k++)
                    if (k == absent || absent == COLUMNS) all[r]->column[k] = NULL;
            }
            const EtendueSampleColumns s_out = sample_columns(s.column), h_out = sample_columns(h.column), e_out = sample_columns(e.column);
            const EtendueSampleColumns g_out = sample_columns(g.column);
            CHECK(t->sample_batch(sampler, n, u_in, &s_out) == OK);
            CHECK(t->hit_batch(sampler, n, w_in, &h_out) == OK);
            const float *const *normals = t->on_surface ? n_in : NULL;
            CHECK(t->each(light_in, n, p_in, normals, u_in, &e_out) == OK);
            CHECK(t->hit_each(light_in, n, p_in, normals, w_in, &g_out) == OK);
            CHECK(t->pdf_each(light_in, n, p_in, normals, w_in, few.column[0]) == OK);
            CHECK(t->invert_each(light_in, n, p_in, normals, w_in, few.column + 1) == OK);
            CHECK(only_written(&few, 0, 3));
            for (size_t i = 0; i < n; i++) {
                EtendueLightSample one;
                float own[SAMPLER_NUMBERS], own_light[LIGHT_NUMBERS];
                const float u_i[2] = {u_numbers[0][i], u_numbers[1][i]}, w_i[3] = {w_numbers[0][i], w_numbers[1][i], w_numbers[2][i]};
                const float p_i[3] = {p_numbers[0][i], p_numbers[1][i], p_numbers[2][i]};
                const float n_i[3] = {n_numbers[0][i], n_numbers[1][i], n_numbers[2][i]};
                t->sample(sampler, u_i, &one);
                CHECK(is_sample(s.column, i, &one));
                t->hit(sampler, w_i, &one);
                CHECK(is_sample(h.column, i, &one));
                for (size_t k = 0; k < t->light_numbers; k++) own_light[k] = at(light_in[k], i);
                t->prepare(own_light, p_i, n_i, own);
                t->sample(own, u_i, &one);
                CHECK(is_sample(e.column, i, &one) && is_finite(&one));
                t->hit(own, w_i, &one);
                CHECK(is_sample(g.column, i, &one) && is_finite(&one));
                float back[2];
                t->invert(own, w_i, back);
                CHECK(same(at(few.column[0], i), t->pdf(own, w_i)));
                CHECK(same(at(few.column[1], i), back[0]) && same(at(few.column[2], i), back[1]));
            }
            free(few.memory);
            for (int r = 0; r < 4; r++) {
                // the last column is one of bytes
                for (int k = 0; k < COLUMNS; k++)
                    all[r]->column[k] = (float *)(void *)(all[r]->memory + GAP + (size_t)k * (4 * n + GAP));
                CHECK(is_untouched((unsigned char *)all[r]->column[11] + n, 3 * n));
                CHECK(absent < 0 || absent == COLUMNS || is_untouched((unsigned char *)all[r]->column[absent], 4 * n));
                CHECK(only_written(all[r], 0, absent == COLUMNS ? 0 : COLUMNS));
                free(all[r]->memory);
            }
        }
        Results r = results(n), over = results(n);
        CHECK(t->pdf_batch(sampler, n, w_in, r.column[0]) == OK);
        CHECK(t->invert_batch(sampler, n, w_in, r.column + 1) == OK);
        CHECK(only_written(&r, 0, 3));
        // results in the place of inputs
        for (size_t k = 0; k < 3; k++) {
            memcpy(over.column[k], w_in[k], 4 * n);
            memcpy(over.column[3 + k], w_in[k], 4 * n);
            if (k < 2) memcpy(over.column[6 + k], u_in[k], 4 * n);
        }
        const float *const o[] = {over.column[0], over.column[1], over.column[2], over.column[3],
                                  over.column[4], over.column[5], over.column[6], over.column[7]};
        CHECK(t->pdf_batch(sampler, n, o, over.column[1]) == OK);
        CHECK(t->invert_batch(sampler, n, o + 3, over.column + 4) == OK);
        float *in_place[COLUMNS] = {over.column[7], NULL, NULL, NULL, over.column[6]};
        const EtendueSampleColumns in_place_out = sample_columns(in_place);
        CHECK(t->sample_batch(sampler, n, o + 6, &in_place_out) == OK);
        CHECK(only_written(&over, 0, 8));
        for (size_t i = 0; i < n; i++) {
            const float w_i[3] = {w_numbers[0][i], w_numbers[1][i], w_numbers[2][i]}, u_i[2] = {u_numbers[0][i], u_numbers[1][i]};
            float back[2];
            EtendueLightSample one;
            CHECK(t->invert(sampler, w_i, back) == OK && t->sample(sampler, u_i, &one) == OK);
            CHECK(same(at(r.column[0], i), t->pdf(sampler, w_i)));
            CHECK(same(at(r.column[1], i), back[0]) && same(at(r.column[2], i), back[1]));
            CHECK(same(at(over.column[1], i), at(r.column[0], i)));
            CHECK(same(at(over.column[4], i), back[0]) && same(at(over.column[5], i), back[1]));
            CHECK(same(at(over.column[7], i), one.direction[0]) && same(at(over.column[6], i), one.pdf));
        }
        free(r.memory);
        free(over.memory);
        for (int k = 0; k < 3; k++) {
            if (k < 2) release(u[k]);
            release(w[k]);
            release(p[k]);
            release(normal[k]);
        }
        for (size_t k = 0; k < t->light_numbers; k++) release(light[k]);
    }
}

// NULL for each pointer in turn: the call is refused and writes nothing. A count of 0 needs no pointer.
static void test_nulls(const Technique *t, const float *sampler) {
    const float u[2] = {0.3f, 0.6f}, w[3] = {0, 1, 0};
    Results r = results(64);
    float *const out = r.column[0];
    EtendueLightSample s, before;
    memset(&s, PATTERN, sizeof s);
    memset(&before, PATTERN, sizeof before);
    float prepared[SAMPLER_NUMBERS];
    memset(prepared, PATTERN, sizeof prepared);
    CHECK(t->prepare(NULL, origin, up, prepared) == REFUSED && t->prepare(t->light, NULL, up, prepared) == REFUSED);
    CHECK(t->prepare(t->light, origin, up, NULL) == REFUSED);
    CHECK(!t->on_surface || t->prepare(t->light, origin, NULL, prepared) == REFUSED);
    CHECK(is_untouched((unsigned char *)prepared, sizeof prepared));
    CHECK(t->sample(NULL, u, &s) == REFUSED && t->sample(sampler, NULL, &s) == REFUSED && t->sample(sampler, u, NULL) == REFUSED);
    CHECK(t->hit(NULL, w, &s) == REFUSED && t->hit(sampler, NULL, &s) == REFUSED && t->hit(sampler, w, NULL) == REFUSED);
    CHECK(memcmp(&s, &before, sizeof s) == 0);
    CHECK(t->pdf(NULL, w) == 0 && t->pdf(sampler, NULL) == 0);
    CHECK(t->invert(NULL, w, out) == REFUSED && t->invert(sampler, NULL, out) == REFUSED && t->invert(sampler, w, NULL) == REFUSED);

    const float *const u_in[2] = {u_numbers[0], u_numbers[1]}, *const w_in[3] = {w_numbers[0], w_numbers[1], w_numbers[2]};
    const float *const p_in[3] = {p_numbers[0], p_numbers[1], p_numbers[2]}, *const n_in[3] = {n_numbers[0], n_numbers[1], n_numbers[2]};
    const float *light_in[LIGHT_NUMBERS];
    for (int k = 0; k < LIGHT_NUMBERS; k++) light_in[k] = u_numbers[0];
    const EtendueSampleColumns columns = sample_columns(r.column);
    for (size_t n = 1; n <= 64; n += 63) {
        CHECK(t->sample_batch(NULL, n, u_in, &columns) == REFUSED && t->sample_batch(sampler, n, NULL, &columns) == REFUSED);
        CHECK(t->sample_batch(sampler, n, u_in, NULL) == REFUSED);
        CHECK(t->hit_batch(NULL, n, w_in, &columns) == REFUSED && t->hit_batch(sampler, n, NULL, &columns) == REFUSED);
        CHECK(t->hit_batch(sampler, n, w_in, NULL) == REFUSED);
        const float *const *normals = t->on_surface ? n_in : NULL;
        CHECK(t->hit_each(NULL, n, p_in, normals, w_in, &columns) == REFUSED && t->hit_each(light_in, n, NULL, normals, w_in, &columns) == REFUSED);
        CHECK(t->hit_each(light_in, n, p_in, normals, NULL, &columns) == REFUSED && t->hit_each(light_in, n, p_in, normals, w_in, NULL) == REFUSED);
        CHECK(t->pdf_each(light_in, n, p_in, normals, w_in, NULL) == REFUSED && t->invert_each(light_in, n, p_in, normals, w_in, NULL) == REFUSED);
        CHECK(!t->on_surface || t->pdf_each(light_in, n, p_in, NULL, w_in, out) == REFUSED);
        CHECK(t->pdf_batch(NULL, n, w_in, out) == REFUSED && t->pdf_batch(sampler, n, NULL, out) == REFUSED);
        CHECK(t->pdf_batch(sampler, n, w_in, NULL) == REFUSED);
        CHECK(t->invert_batch(NULL, n, w_in, r.column) == REFUSED && t->invert_batch(sampler, n, NULL, r.column) == REFUSED);
        CHECK(t->invert_batch(sampler, n, w_in, NULL) == REFUSED);
        CHECK(t->each(NULL, n, p_in, n_in, u_in, &columns) == REFUSED && t->each(light_in, n, NULL, n_in, u_in, &columns) == REFUSED);
        CHECK(t->each(light_in, n, p_in, n_in, NULL, &columns) == REFUSED && t->each(light_in, n, p_in, n_in, u_in, NULL) == REFUSED);
        CHECK(!t->on_surface || t->each(light_in, n, p_in, NULL, u_in, &columns) == REFUSED);
        // one column missing
        for (int k = 0; k < 3; k++) {
            const float *u_less[3] = {u_in[0], u_in[1], u_in[0]}, *w_less[3] = {w_in[0], w_in[1], w_in[2]};
            u_less[k] = w_less[k] = NULL;
            CHECK(k == 2 || t->sample_batch(sampler, n, u_less, &columns) == REFUSED);
            CHECK(k == 2 || t->each(light_in, n, p_in, n_in, u_less, &columns) == REFUSED);
            CHECK(t->hit_batch(sampler, n, w_less, &columns) == REFUSED && t->pdf_batch(sampler, n, w_less, out) == REFUSED);
            CHECK(t->invert_batch(sampler, n, w_less, r.column) == REFUSED);
            CHECK(t->each(light_in, n, w_less, n_in, u_in, &columns) == REFUSED);
            CHECK(!t->on_surface || t->each(light_in, n, p_in, w_less, u_in, &columns) == REFUSED);
        }
        for (size_t k = 0; k < t->light_numbers; k++) {
            light_in[k] = NULL;
            CHECK(t->each(light_in, n, p_in, n_in, u_in, &columns) == REFUSED);
            light_in[k] = u_numbers[0];
        }
    }
    CHECK(only_written(&r, 0, 0));
    CHECK(t->sample_batch(NULL, 0, NULL, NULL) == OK && t->hit_batch(NULL, 0, NULL, NULL) == OK && t->pdf_batch(NULL, 0, NULL, NULL) == OK);
    CHECK(t->invert_batch(NULL, 0, NULL, NULL) == OK && t->each(NULL, 0, NULL, NULL, NULL, NULL) == OK);
    // random numbers that are not wanted
    float *none[2] = {NULL, NULL}, *second[2] = {NULL, r.column[1]};
    CHECK(t->invert_batch(sampler, 64, w_in, none) == OK && only_written(&r, 0, 0));
    CHECK(t->invert_batch(sampler, 64, w_in, second) == OK && only_written(&r, 1, 2));
    free(r.memory);
}

// ---- warps ----

typedef struct {
    const char *name;
    const float *parameters; // NULL for warps without
    int coordinates;
    EtendueStatus (*sample)(const float *warp, const float *u, float *point);
    float (*pdf)(const float *warp, const float *point);
    EtendueStatus (*invert)(const float *warp, const float *point, float *u);
    EtendueStatus (*sample_batch)(const float *warp, size_t n, const float *const *u, float *const *points);
    EtendueStatus (*pdf_batch)(const float *warp, size_t n, const float *const *points, float *out);
    EtendueStatus (*invert_batch)(const float *warp, size_t n, const float *const *points, float *const *u);
} Warp;

#define WARP_FUNCTIONS(PREFIX, SELF)                                                                                             \
    static EtendueStatus PREFIX##_1(const float *warp, const float *u, float *point) {                                           \
        (void)warp;                                                                                                              \
        return etendue_##PREFIX##_sample(SELF u, point);                                                                         \
    }                                                                                                                            \
    static float PREFIX##_2(const float *warp, const float *point) {                                                             \
        (void)warp;                                                                                                              \
        return etendue_##PREFIX##_pdf(SELF point);                                                                               \
    }                                                                                                                            \
    static EtendueStatus PREFIX##_3(const float *warp, const float *point, float *u) {                                           \
        (void)warp;                                                                                                              \
        return etendue_##PREFIX##_invert(SELF point, u);                                                                         \
    }                                                                                                                            \
    static EtendueStatus PREFIX##_4(const float *warp, size_t n, const float *const *u, float *const *points) {                  \
        (void)warp;                                                                                                              \
        return etendue_##PREFIX##_sample_batch(SELF n, u, points);                                                               \
    }                                                                                                                            \
    static EtendueStatus PREFIX##_5(const float *warp, size_t n, const float *const *points, float *out) {                       \
        (void)warp;                                                                                                              \
        return etendue_##PREFIX##_pdf_batch(SELF n, points, out);                                                                \
    }                                                                                                                            \
    static EtendueStatus PREFIX##_6(const float *warp, size_t n, const float *const *points, float *const *u) {                  \
        (void)warp;                                                                                                              \
        return etendue_##PREFIX##_invert_batch(SELF n, points, u);                                                               \
    }
// warps from the list of techniques: WRITE=1 cargo test -p etendue-tests bindings
#define WARPS_WITHOUT(W) \
    W(concentric_disk, 2) \
    W(uniform_hemisphere, 3) \
    W(uniform_sphere, 3) \
    W(cosine_hemisphere, 3) \
    W(octahedral, 3) \
    W(area_triangle, 2) \
    W(low_distortion_triangle, 2)
// warps end of what is from the list
#define WARPS_WITH(W)                                 \
    W(cone, Cone, 3)                               \
    W(bilinear, Bilinear, 2)                       \
    W(ggx_visible_normals, GgxVisibleNormals, 3)   \
    W(reflection, Reflection, 3)                   \
    W(patch_surface, PatchSurface, 3)
static const float Cone[] = {0.3f}, Bilinear[] = {1, 2, 0.5f, 3};
static float GgxVisibleNormals[12], Reflection[16];
static const float PatchSurface[] = {-0.5f, 2, -0.3f, 1.2f, 0.1f, 0.2f, 0.1f, 0.2f, 1.1f, 1.3f, 0.6f, 1.2f};
#define WRITE_WITHOUT(PREFIX, P) WARP_FUNCTIONS(PREFIX, )
#define WRITE_WITH(PREFIX, TYPE, P) WARP_FUNCTIONS(PREFIX, (const Etendue##TYPE *)warp COMMA)
#define FUNCTIONS_OF(PREFIX) PREFIX##_1, PREFIX##_2, PREFIX##_3, PREFIX##_4, PREFIX##_5, PREFIX##_6
#define ROW_WITHOUT(PREFIX, P) {#PREFIX, NULL, P, FUNCTIONS_OF(PREFIX)},
#define ROW_WITH(PREFIX, TYPE, P) {#PREFIX, TYPE, P, FUNCTIONS_OF(PREFIX)},
WARPS_WITHOUT(WRITE_WITHOUT)
WARPS_WITH(WRITE_WITH)
static const Warp warps[] = {WARPS_WITHOUT(ROW_WITHOUT) WARPS_WITH(ROW_WITH)};

static void test_warp(const Warp *w) {
    const float *const self = w->parameters;
    for (int size = 0; size < SIZES; size++) {
        const size_t n = sizes[size];
        Input u[2];
        const float *u_in[2];
        for (int k = 0; k < 2; k++) u_in[k] = (u[k] = input(u_numbers[k], n)).column;
        Results r = results(n);
        float *const *const points = r.column, *const *const back = r.column + 4;
        CHECK(w->sample_batch(self, n, u_in, points) == OK && only_written(&r, 0, w->coordinates));
        const float *const points_in[3] = {points[0], points[1], points[2]};
        CHECK(w->pdf_batch(self, n, points_in, r.column[3]) == OK && w->invert_batch(self, n, points_in, back) == OK);
        // in the place of the inputs
        float *in_place[3] = {r.column[7], r.column[6], r.column[8]};
        const float *const u_in_place[2] = {r.column[6], r.column[7]};
        for (int k = 0; k < 2; k++) memcpy(r.column[6 + k], u_in[k], 4 * n);
        CHECK(w->sample_batch(self, n, u_in_place, in_place) == OK);
        for (size_t i = 0; i < n; i++) {
            const float u_i[2] = {u_numbers[0][i], u_numbers[1][i]};
            float point[3] = {0, 0, 0}, u_back[2] = {0, 0}, again[3] = {0, 0, 0};
            CHECK(w->sample(self, u_i, point) == OK && w->invert(self, point, u_back) == OK && w->sample(self, u_back, again) == OK);
            for (int k = 0; k < w->coordinates; k++) {
                CHECK(isfinite(point[k]) && same(point[k], at(points[k], i)) && same(point[k], at(in_place[k], i)));
            }
            for (int k = 0; k < 2; k++) CHECK(u_back[k] >= 0 && u_back[k] < 1 && same(u_back[k], at(back[k], i)));
            CHECK(w->pdf(self, point) > 0 && same(w->pdf(self, point), at(r.column[3], i)));
            CHECK(difference(point, again, w->coordinates) < 1e-5f);
        }
        free(r.memory);
        for (int k = 0; k < 2; k++) release(u[k]);
    }

    Results r = results(64);
    const float u[2] = {0.3f, 0.6f};
    const float *const u_in[2] = {u_numbers[0], u_numbers[1]}, *const points_in[3] = {w_numbers[0], w_numbers[1], w_numbers[2]};
    float *const out = r.column[0];
    CHECK(w->sample(self, NULL, out) == REFUSED && w->sample(self, u, NULL) == REFUSED && w->pdf(self, NULL) == 0);
    CHECK(w->invert(self, NULL, out) == REFUSED && w->invert(self, u, NULL) == REFUSED);
    CHECK(w->sample_batch(self, 64, NULL, r.column) == REFUSED && w->sample_batch(self, 64, u_in, NULL) == REFUSED);
    CHECK(w->pdf_batch(self, 64, NULL, out) == REFUSED && w->pdf_batch(self, 64, points_in, NULL) == REFUSED);
    CHECK(w->invert_batch(self, 64, NULL, r.column) == REFUSED && w->invert_batch(self, 64, points_in, NULL) == REFUSED);
    if (self) {
        CHECK(w->sample(NULL, u, out) == REFUSED && w->pdf(NULL, w_numbers[0]) == 0 && w->invert(NULL, w_numbers[0], out) == REFUSED);
        CHECK(w->sample_batch(NULL, 64, u_in, r.column) == REFUSED && w->pdf_batch(NULL, 64, points_in, out) == REFUSED);
        CHECK(w->invert_batch(NULL, 64, points_in, r.column) == REFUSED);
    }
    for (int k = 0; k < 3; k++) {
        const float *u_less[2] = {u_in[0], u_in[1]}, *less[3] = {points_in[0], points_in[1], points_in[2]};
        less[k] = NULL;
        if (k < 2) {
            u_less[k] = NULL;
            CHECK(w->sample_batch(self, 64, u_less, r.column) == REFUSED);
        }
        if (k < w->coordinates) CHECK(w->pdf_batch(self, 64, less, out) == REFUSED && w->invert_batch(self, 64, less, r.column) == REFUSED);
    }
    CHECK(only_written(&r, 0, 0));
    float *none[3] = {NULL, NULL, NULL};
    CHECK(w->sample_batch(self, 64, u_in, none) == OK && w->invert_batch(self, 64, points_in, none) == OK && only_written(&r, 0, 0));
    none[w->coordinates - 1] = r.column[w->coordinates - 1];
    CHECK(w->sample_batch(self, 64, u_in, none) == OK && only_written(&r, w->coordinates - 1, w->coordinates));
    CHECK(w->sample_batch(NULL, 0, NULL, NULL) == OK && w->pdf_batch(NULL, 0, NULL, NULL) == OK && w->invert_batch(NULL, 0, NULL, NULL) == OK);
    free(r.memory);
}

// ---- reflections ----

static void test_reflections(void) {
    EtendueReflection *const lobe = (EtendueReflection *)Reflection, untouched;
    const float view[3] = {-0.48f, 0.8f, 0.36f};
    memset(&untouched, 0, sizeof untouched);
    CHECK(sizeof *lobe == sizeof Reflection && memcmp(lobe, &untouched, sizeof untouched) == 0);
    CHECK(etendue_reflection_prepare(0.2f, NULL, view, lobe) == REFUSED && etendue_reflection_prepare(0.2f, up, NULL, lobe) == REFUSED);
    CHECK(etendue_reflection_prepare(0.2f, up, view, NULL) == REFUSED && memcmp(lobe, &untouched, sizeof untouched) == 0);
    CHECK(etendue_reflection_prepare(0.2f, up, view, lobe) == OK);
    CHECK(lobe->albedo > 0.9f && lobe->albedo <= 1 && lobe->schlick > 0 && lobe->schlick < 0.1f);
    const float mirror[3] = {0.48f, 0.8f, -0.36f};
    CHECK(etendue_reflection_pdf(lobe, mirror) > 1 && etendue_reflection_pdf(lobe, up) < etendue_reflection_pdf(lobe, mirror));

    // spheres in the mirror direction cover what of the lobe is within their angle; from inside all of it
    const float far[3] = {4.8f, 8, -3.6f}, within[3] = {0.1f, 0.2f, 0.1f};
    CHECK(etendue_reflection_sphere(lobe, far, 0) == 0 && etendue_reflection_sphere(lobe, within, 1) == (float)3.14159265358979324);
    CHECK(etendue_reflection_sphere(lobe, far, 1) > 0 && etendue_reflection_sphere(lobe, far, 1) < etendue_reflection_sphere(lobe, far, 9));
    CHECK(etendue_reflection_sphere(NULL, far, 1) == 0 && etendue_reflection_sphere(lobe, NULL, 1) == 0);

    for (int size = 0; size < SIZES; size++) {
        const size_t n = sizes[size];
        Input roughness = input(u_numbers[0], n), radii = input(u_numbers[1], n), normals[3], views[3];
        const float *n_in[3], *v_in[3];
        for (int k = 0; k < 3; k++) {
            n_in[k] = (normals[k] = input(n_numbers[k], n)).column;
            v_in[k] = (views[k] = input(w_numbers[k], n)).column;
        }
        // absent: none, and each column alone
        for (int absent = -1; absent < 16; absent++) {
            Results low = results(n), high = results(n);
            EtendueReflectionColumns out;
            float **const columns = (float **)(void *)&out;
            for (int k = 0; k < 16; k++) columns[k] = k == absent ? NULL : k < 8 ? low.column[k] : high.column[k - 8];
            CHECK(etendue_reflection_prepare_batch(n, roughness.column, n_in, v_in, &out) == OK);
            for (size_t i = 0; i < n; i++) {
                const float n_i[3] = {n_numbers[0][i], n_numbers[1][i], n_numbers[2][i]}, v_i[3] = {w_numbers[0][i], w_numbers[1][i], w_numbers[2][i]};
                EtendueReflection one;
                CHECK(etendue_reflection_prepare(u_numbers[0][i], n_i, v_i, &one) == OK);
                for (int k = 0; k < 16; k++) {
                    const float number = ((const float *)&one)[k];
                    CHECK(isfinite(number) && (k == absent || same(number, at(columns[k], i))));
                }
            }
            if (absent < 0) CHECK(only_written(&low, 0, 8) && only_written(&high, 0, 8));
            if (absent >= 0 && absent < 8) CHECK(is_untouched((unsigned char *)low.column[absent], 4 * n));
            if (absent >= 8) CHECK(is_untouched((unsigned char *)high.column[absent - 8], 4 * n));
            free(low.memory);
            free(high.memory);
        }
        Results r = results(n);
        CHECK(etendue_reflection_sphere_batch(lobe, n, v_in, radii.column, r.column[0]) == OK && only_written(&r, 0, 1));
        for (size_t i = 0; i < n; i++) {
            const float v_i[3] = {w_numbers[0][i], w_numbers[1][i], w_numbers[2][i]}, one = etendue_reflection_sphere(lobe, v_i, u_numbers[1][i]);
            CHECK(one >= 0 && one <= (float)3.14159265358979324 && same(one, at(r.column[0], i)));
        }
        free(r.memory);
        release(roughness), release(radii);
        for (int k = 0; k < 3; k++) release(normals[k]), release(views[k]);
    }

    Results r = results(64);
    EtendueReflectionColumns out;
    memset(&out, 0, sizeof out);
    out.albedo = r.column[0];
    const float *const n_in[3] = {n_numbers[0], n_numbers[1], n_numbers[2]}, *const u = u_numbers[0];
    CHECK(etendue_reflection_prepare_batch(64, NULL, n_in, n_in, &out) == REFUSED && etendue_reflection_prepare_batch(64, u, NULL, n_in, &out) == REFUSED);
    CHECK(etendue_reflection_prepare_batch(64, u, n_in, NULL, &out) == REFUSED && etendue_reflection_prepare_batch(64, u, n_in, n_in, NULL) == REFUSED);
    CHECK(etendue_reflection_sphere_batch(NULL, 64, n_in, u, r.column[0]) == REFUSED && etendue_reflection_sphere_batch(lobe, 64, NULL, u, r.column[0]) == REFUSED);
    CHECK(etendue_reflection_sphere_batch(lobe, 64, n_in, NULL, r.column[0]) == REFUSED && etendue_reflection_sphere_batch(lobe, 64, n_in, u, NULL) == REFUSED);
    for (int k = 0; k < 3; k++) {
        const float *less[3] = {n_in[0], n_in[1], n_in[2]};
        less[k] = NULL;
        CHECK(etendue_reflection_prepare_batch(64, u, less, n_in, &out) == REFUSED && etendue_reflection_prepare_batch(64, u, n_in, less, &out) == REFUSED);
        CHECK(etendue_reflection_sphere_batch(lobe, 64, less, u, r.column[0]) == REFUSED);
    }
    CHECK(only_written(&r, 0, 0));
    CHECK(etendue_reflection_prepare_batch(0, NULL, NULL, NULL, NULL) == OK && etendue_reflection_sphere_batch(NULL, 0, NULL, NULL, NULL) == OK);
    // lights need all columns
    const float *const u_in[2] = {u_numbers[0], u_numbers[1]}, *light_in[LIGHT_NUMBERS];
    for (int k = 0; k < LIGHT_NUMBERS; k++) light_in[k] = u_numbers[0];
    const EtendueSampleColumns columns = sample_columns(r.column);
    for (int k = 0; k < 16; k++) {
        EtendueReflectionColumns less = *reflections(64, n_in);
        ((float **)(void *)&less)[k] = NULL;
        CHECK(etendue_triangle_by_reflection_sample_each((const EtendueTriangleColumns *)(const void *)light_in, 64, n_in, &less, u_in, &columns) == REFUSED);
    }
    CHECK(only_written(&r, 0, 0));
    free(r.memory);
}

// ---- sequences ----

typedef struct {
    const char *name;
    EtendueStatus (*pairs)(uint64_t seed, uint32_t count, const EtendueCounters *counters, size_t n, float *const *u);
} Sequence;
#define SEQUENCES(S) S(independent, ) S(owen_sobol, ) S(joint_sobol, ) S(stratified, count COMMA)
#define WRITE_SEQUENCE(NAME, COUNT)                                                                                                   \
    static EtendueStatus NAME##_1(uint64_t seed, uint32_t count, const EtendueCounters *counters, size_t n, float *const *u) {        \
        (void)count;                                                                                                                  \
        return etendue_##NAME##_pairs(seed, COUNT counters, n, u);                                                                    \
    }
#define ROW_SEQUENCE(NAME, COUNT) {#NAME, NAME##_1},
SEQUENCES(WRITE_SEQUENCE)
static const Sequence sequences[] = {SEQUENCES(ROW_SEQUENCE)};

static void test_sequence(const Sequence *s) {
    const uint32_t counts[] = {1, 21, 1024, 0, UINT32_MAX};
    for (int c = 0; c < 5; c++) {
        for (int size = 0; size < SIZES; size++) {
            const size_t n = sizes[size];
            // all samples from 17 on; or pixels and samples of their own, at odd addresses
            Results all = results(n), own = results(n);
            float pixel_bits[MOST], sample_bits[MOST];
            for (size_t i = 0; i < n; i++) {
                const uint32_t pixel = 5 + (uint32_t)i % 3, sample = 4000000000u + (uint32_t)(i * i) * 977u;
                memcpy(pixel_bits + i, &pixel, 4);
                memcpy(sample_bits + i, &sample, 4);
            }
            Input pixels = input(pixel_bits, n), samples = input(sample_bits, n);
            const EtendueCounters from = {5, 17, 2, NULL, NULL};
            const EtendueCounters given = {0, 0, 2, (const uint32_t *)pixels.column, (const uint32_t *)samples.column};
            CHECK(s->pairs(7, counts[c], &from, n, all.column) == OK && only_written(&all, 0, 2));
            CHECK(s->pairs(7, counts[c], &given, n, own.column) == OK && only_written(&own, 0, 2));
            for (size_t i = 0; i < n; i++) {
                EtendueCounters one = {5, 17 + (uint32_t)i, 2, NULL, NULL};
                float x, y;
                float *const u[2] = {&x, &y};
                CHECK(s->pairs(7, counts[c], &one, 1, u) == OK && x >= 0 && x < 1 && y >= 0 && y < 1);
                CHECK(same(x, at(all.column[0], i)) && same(y, at(all.column[1], i)));
                memcpy(&one.pixel, pixel_bits + i, 4);
                memcpy(&one.sample, sample_bits + i, 4);
                CHECK(s->pairs(7, counts[c], &one, 1, u) == OK);
                CHECK(same(x, at(own.column[0], i)) && same(y, at(own.column[1], i)));
            }
            free(all.memory);
            free(own.memory);
            release(pixels);
            release(samples);
        }
    }
    Results r = results(64);
    const EtendueCounters from = {5, 17, 2, NULL, NULL};
    CHECK(s->pairs(7, 16, NULL, 64, r.column) == REFUSED && s->pairs(7, 16, &from, 64, NULL) == REFUSED && only_written(&r, 0, 0));
    float *const none[2] = {NULL, NULL}, *const second[2] = {NULL, r.column[1]};
    CHECK(s->pairs(7, 16, &from, 64, none) == OK && only_written(&r, 0, 0));
    CHECK(s->pairs(7, 16, &from, 64, second) == OK && only_written(&r, 1, 2));
    CHECK(s->pairs(7, 16, NULL, 0, NULL) == OK);
    free(r.memory);
}

// ---- trees of lights ----

static void test_tree(size_t light_count) {
    enum { LIGHTS = 300 };
    static EtendueLightBound lights[LIGHTS];
    for (size_t i = 0; i < light_count; i++) {
        EtendueLightBound *light = lights + i;
        memset(light, 0, sizeof *light);
        for (int k = 0; k < 3; k++) light->center[k] = 10 * uniform() - 5;
        light->radius = i % 4 == 0 ? 0 : 0.3f;
        if (i % 2) direction(light->normal, 1);
        light->two_sided = i % 6 == 1;
        light->power = i % 10 == 9 ? 0 : 1 + uniform();
    }
    const size_t node_count = etendue_light_tree_nodes(light_count);
    // more than there are, so that no allocation is empty; what is beyond must not change
    EtendueLightTreeNode *nodes = malloc((node_count + 1) * sizeof *nodes);
    uint32_t *places = malloc((light_count + 1) * sizeof *places);
    EtendueLightTree tree, untouched;
    memset(nodes, PATTERN, (node_count + 1) * sizeof *nodes);
    memset(places, PATTERN, (light_count + 1) * sizeof *places);
    memset(&tree, PATTERN, sizeof tree);
    memset(&untouched, PATTERN, sizeof untouched);
    const size_t count = light_count;
    CHECK(etendue_light_tree_build(NULL, count, nodes, places, &tree) == REFUSED);
    CHECK(etendue_light_tree_build(lights, count, NULL, places, &tree) == REFUSED);
    CHECK(etendue_light_tree_build(lights, count, nodes, NULL, &tree) == REFUSED);
    CHECK(etendue_light_tree_build(lights, count, nodes, places, NULL) == REFUSED);
    CHECK(etendue_light_tree_build(lights, ((size_t)1 << 27) + 1, nodes, places, &tree) == ETENDUE_STATUS_COUNT);
    CHECK(etendue_light_tree_build(lights, SIZE_MAX, nodes, places, &tree) == ETENDUE_STATUS_COUNT);
    if (count > 0) {
        lights[count - 1].two_sided = 2;
        CHECK(etendue_light_tree_build(lights, count, nodes, places, &tree) == ETENDUE_STATUS_VALUE);
        lights[count - 1].two_sided = 0;
    }
    CHECK(is_untouched((unsigned char *)nodes, (node_count + 1) * sizeof *nodes));
    CHECK(is_untouched((unsigned char *)places, (light_count + 1) * sizeof *places));
    CHECK(memcmp(&tree, &untouched, sizeof tree) == 0);
    CHECK(etendue_light_tree_build(lights, count, nodes, places, &tree) == OK);
    CHECK(is_untouched((unsigned char *)(nodes + node_count), sizeof *nodes) && is_untouched((unsigned char *)(places + count), 4));

    const float *const p_in[3] = {p_numbers[0], p_numbers[1], p_numbers[2]}, *const n_in[3] = {n_numbers[0], n_numbers[1], n_numbers[2]};
    for (int size = 0; size < SIZES; size++) {
        const size_t n = sizes[size];
        Results r = results(n), one = results(1);
        Input u = input(u_numbers[0], n);
        const EtendueChoiceColumns out = {(uint32_t *)r.column[0], r.column[1], r.column[2]};
        const EtendueChoiceColumns single = {(uint32_t *)one.column[0], one.column[1], one.column[2]};
        CHECK(etendue_light_tree_choose_batch(&tree, n, p_in, n_in, u.column, &out) == OK && only_written(&r, 0, 3));
        CHECK(etendue_light_tree_pmf_batch(&tree, n, p_in, n_in, (const uint32_t *)r.column[0], r.column[3]) == OK);
        CHECK(only_written(&r, 0, 4));
        for (size_t i = 0; i < n; i++) {
            uint32_t light;
            memcpy(&light, (unsigned char *)r.column[0] + 4 * i, 4);
            const float pmf = at(r.column[1], i), rest = at(r.column[2], i);
            CHECK(light == UINT32_MAX ? pmf == 0 : (light < count && pmf > 0 && lights[light].power > 0));
            CHECK(rest >= 0 && rest < 1 && same(pmf, at(r.column[3], i)));
            const float *const p_i[3] = {p_numbers[0] + i, p_numbers[1] + i, p_numbers[2] + i};
            const float *const n_i[3] = {n_numbers[0] + i, n_numbers[1] + i, n_numbers[2] + i};
            CHECK(etendue_light_tree_choose_batch(&tree, 1, p_i, n_i, u_numbers[0] + i, &single) == OK);
            CHECK(memcmp(one.column[0], &light, 4) == 0 && same(at(one.column[1], 0), pmf) && same(at(one.column[2], 0), rest));
            if (i < 10 && n == sizes[SIZES - 1]) {
                // the pmfs sum to the share of random numbers that choose a light: the others end where no light can contribute
                float sum = 0, chosen = 0;
                for (uint32_t k = 0; k < count; k++) {
                    CHECK(etendue_light_tree_pmf_batch(&tree, 1, p_i, n_i, &k, one.column[3]) == OK);
                    CHECK(lights[k].power > 0 || at(one.column[3], 0) == 0);
                    sum += at(one.column[3], 0);
                }
                for (size_t k = 0; k < MOST; k++) {
                    CHECK(etendue_light_tree_choose_batch(&tree, 1, p_i, n_i, u_numbers[0] + k, &single) == OK);
                    chosen += at(one.column[1], 0) > 0 ? 1.0f / MOST : 0;
                }
                CHECK(fabsf(sum - chosen) < 1e-5f + 5 * sqrtf(fmaxf(sum * (1 - sum), 0) / MOST));
            }
        }
        free(r.memory);
        free(one.memory);
        release(u);
    }

    Results r = results(64);
    const EtendueChoiceColumns out = {(uint32_t *)r.column[0], r.column[1], r.column[2]}, none = {NULL, NULL, NULL};
    const EtendueChoiceColumns third = {NULL, NULL, r.column[2]};
    const float *const u = u_numbers[0];
    static const uint32_t chosen[64];
    EtendueLightTree broken = tree;
    broken.nodes = NULL;
    CHECK(etendue_light_tree_choose_batch(&broken, 64, p_in, n_in, u, &out) == REFUSED);
    broken = tree;
    broken.places = NULL;
    CHECK(etendue_light_tree_choose_batch(&broken, 64, p_in, n_in, u, &out) == REFUSED);
    CHECK(etendue_light_tree_pmf_batch(&broken, 64, p_in, n_in, chosen, r.column[0]) == REFUSED);
    CHECK(etendue_light_tree_choose_batch(NULL, 64, p_in, n_in, u, &out) == REFUSED);
    CHECK(etendue_light_tree_choose_batch(&tree, 64, NULL, n_in, u, &out) == REFUSED);
    CHECK(etendue_light_tree_choose_batch(&tree, 64, p_in, NULL, u, &out) == REFUSED);
    CHECK(etendue_light_tree_choose_batch(&tree, 64, p_in, n_in, NULL, &out) == REFUSED);
    CHECK(etendue_light_tree_choose_batch(&tree, 64, p_in, n_in, u, NULL) == REFUSED);
    CHECK(etendue_light_tree_pmf_batch(NULL, 64, p_in, n_in, chosen, r.column[0]) == REFUSED);
    CHECK(etendue_light_tree_pmf_batch(&tree, 64, NULL, n_in, chosen, r.column[0]) == REFUSED);
    CHECK(etendue_light_tree_pmf_batch(&tree, 64, p_in, NULL, chosen, r.column[0]) == REFUSED);
    CHECK(etendue_light_tree_pmf_batch(&tree, 64, p_in, n_in, NULL, r.column[0]) == REFUSED);
    CHECK(etendue_light_tree_pmf_batch(&tree, 64, p_in, n_in, chosen, NULL) == REFUSED);
    for (int k = 0; k < 3; k++) {
        const float *less[3] = {p_in[0], p_in[1], p_in[2]};
        less[k] = NULL;
        CHECK(etendue_light_tree_choose_batch(&tree, 64, less, n_in, u, &out) == REFUSED);
        CHECK(etendue_light_tree_choose_batch(&tree, 64, p_in, less, u, &out) == REFUSED);
        CHECK(etendue_light_tree_pmf_batch(&tree, 64, less, n_in, chosen, r.column[0]) == REFUSED);
        CHECK(etendue_light_tree_pmf_batch(&tree, 64, p_in, less, chosen, r.column[0]) == REFUSED);
    }
    CHECK(etendue_light_tree_choose_batch(&tree, 64, p_in, n_in, u, &none) == OK && only_written(&r, 0, 0));
    CHECK(etendue_light_tree_choose_batch(&tree, 64, p_in, n_in, u, &third) == OK && only_written(&r, 2, 3));
    CHECK(etendue_light_tree_choose_batch(NULL, 0, NULL, NULL, NULL, NULL) == OK);
    CHECK(etendue_light_tree_pmf_batch(NULL, 0, NULL, NULL, NULL, NULL) == OK);
    free(r.memory);
    free(nodes);
    free(places);
}

// ---- light from an image ----

static void test_image(uint32_t map) {
    enum { WIDTH = 8, HEIGHT = 6, TEXELS = WIDTH * HEIGHT, TABLE = TEXELS + HEIGHT };
    float weights[TEXELS], table[TABLE + 1];
    for (int k = 0; k < TEXELS; k++) weights[k] = k == 13 ? 0 : uniform();
    EtendueImageEnvironment sky, untouched;
    memset(table, PATTERN, sizeof table);
    memset(&sky, PATTERN, sizeof sky);
    memset(&untouched, PATTERN, sizeof untouched);
    const size_t most = (size_t)1 << 24;
    CHECK(etendue_image_environment_table(WIDTH, HEIGHT) == TABLE && etendue_image_environment_table(most, 3) == 3 * most + 3);
    CHECK(etendue_image_environment_table(0, 3) == 0 && etendue_image_environment_table(3, 0) == 0);
    CHECK(etendue_image_environment_table(most + 1, 3) == 0 && etendue_image_environment_table(3, SIZE_MAX) == 0);
    CHECK(etendue_image_environment_build(NULL, WIDTH, HEIGHT, map, table, &sky) == REFUSED);
    CHECK(etendue_image_environment_build(weights, WIDTH, HEIGHT, map, NULL, &sky) == REFUSED);
    CHECK(etendue_image_environment_build(weights, WIDTH, HEIGHT, map, table, NULL) == REFUSED);
    CHECK(etendue_image_environment_build(weights, 0, HEIGHT, map, table, &sky) == ETENDUE_STATUS_COUNT);
    CHECK(etendue_image_environment_build(weights, WIDTH, SIZE_MAX, map, table, &sky) == ETENDUE_STATUS_COUNT);
    CHECK(etendue_image_environment_build(weights, WIDTH, HEIGHT, 2, table, &sky) == ETENDUE_STATUS_VALUE);
    const float wrong[] = {-1, -1e-30f, (float)INFINITY, (float)NAN};
    for (int k = 0; k < 4; k++) {
        weights[TEXELS - 1] = wrong[k];
        CHECK(etendue_image_environment_build(weights, WIDTH, HEIGHT, map, table, &sky) == ETENDUE_STATUS_VALUE);
    }
    const float dark[TEXELS] = {0};
    CHECK(etendue_image_environment_build(dark, WIDTH, HEIGHT, map, table, &sky) == ETENDUE_STATUS_VALUE);
    CHECK(is_untouched((unsigned char *)table, sizeof table) && memcmp(&sky, &untouched, sizeof sky) == 0);
    weights[TEXELS - 1] = 0.5f;
    CHECK(etendue_image_environment_build(weights, WIDTH, HEIGHT, map, table, &sky) == OK);
    CHECK(is_untouched((unsigned char *)(table + TABLE), 4) && sky.table == table && sky.width == WIDTH && sky.height == HEIGHT);

    float mean = 0;
    for (int size = 0; size < SIZES; size++) {
        const size_t n = sizes[size];
        Results s = results(n), h = results(n), e = results(n);
        Input u[2] = {input(u_numbers[0], n), input(u_numbers[1], n)};
        Input w[3] = {input(w_numbers[0], n), input(w_numbers[1], n), input(w_numbers[2], n)};
        const float *const u_in[2] = {u[0].column, u[1].column}, *const w_in[3] = {w[0].column, w[1].column, w[2].column};
        const EtendueSampleColumns s_out = sample_columns(s.column), h_out = sample_columns(h.column);
        CHECK(etendue_image_environment_sample_batch(&sky, n, u_in, &s_out) == OK && only_written(&s, 0, COLUMNS));
        CHECK(etendue_image_environment_hit_batch(&sky, n, w_in, &h_out) == OK && only_written(&h, 0, COLUMNS));
        CHECK(etendue_image_environment_pdf_batch(&sky, n, w_in, e.column[0]) == OK && only_written(&e, 0, 1));
        CHECK(etendue_image_environment_invert_batch(&sky, n, w_in, e.column + 1) == OK && only_written(&e, 0, 3));
        mean = 0;
        for (size_t i = 0; i < n; i++) {
            EtendueLightSample one;
            float back[2];
            const float u_i[2] = {u_numbers[0][i], u_numbers[1][i]}, w_i[3] = {w_numbers[0][i], w_numbers[1][i], w_numbers[2][i]};
            CHECK(etendue_image_environment_sample(&sky, u_i, &one) == OK && is_finite(&one) && is_sample(s.column, i, &one));
            CHECK(one.pdf > 0 && fabsf(one.pdf * one.weight - 1) < 1e-6f && same(one.pdf, etendue_image_environment_pdf(&sky, one.direction)));
            // the weight is constant in each texel, which is that of the position in the image
            const int x = (int)(one.uv[0] * WIDTH), y = (int)(one.uv[1] * HEIGHT);
            CHECK(x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT && weights[y * WIDTH + x] > 0);
            mean += weights[y * WIDTH + x] * one.weight / (float)n;
            CHECK(etendue_image_environment_hit(&sky, w_i, &one) == OK && is_finite(&one) && is_sample(h.column, i, &one));
            CHECK(etendue_image_environment_invert(&sky, w_i, back) == OK && same(at(e.column[0], i), etendue_image_environment_pdf(&sky, w_i)));
            CHECK(same(at(e.column[1], i), back[0]) && same(at(e.column[2], i), back[1]));
        }
        free(s.memory), free(h.memory), free(e.memory);
        release(u[0]), release(u[1]), release(w[0]), release(w[1]), release(w[2]);
    }
    // every sample is worth the integral of the weights over the sphere
    const double pi = 3.14159265358979324;
    double integral = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            integral += weights[y * WIDTH + x] * (map == 0 ? 4 * pi / TEXELS : 2 * pi / WIDTH * (cos(pi * y / HEIGHT) - cos(pi * (y + 1) / HEIGHT)));
    CHECK(fabs(mean / integral - 1) < 1e-5);

    EtendueLightSample one;
    Results r = results(64);
    float sampled[2];
    const float u[2] = {0.3f, 0.6f};
    const float *const w_in[3] = {w_numbers[0], w_numbers[1], w_numbers[2]}, *const u_in[2] = {u_numbers[0], u_numbers[1]};
    const EtendueSampleColumns columns = sample_columns(r.column);
    CHECK(etendue_image_environment_sample(NULL, u, &one) == REFUSED && etendue_image_environment_sample(&sky, NULL, &one) == REFUSED);
    CHECK(etendue_image_environment_sample(&sky, u, NULL) == REFUSED && etendue_image_environment_pdf(NULL, up) == 0);
    CHECK(etendue_image_environment_invert(NULL, up, sampled) == REFUSED && etendue_image_environment_hit(NULL, up, &one) == REFUSED);
    CHECK(etendue_image_environment_sample_batch(NULL, 64, u_in, &columns) == REFUSED);
    CHECK(etendue_image_environment_sample_batch(&sky, 64, NULL, &columns) == REFUSED);
    CHECK(etendue_image_environment_sample_batch(&sky, 64, u_in, NULL) == REFUSED);
    CHECK(etendue_image_environment_hit_batch(NULL, 64, w_in, &columns) == REFUSED);
    CHECK(etendue_image_environment_pdf_batch(NULL, 64, w_in, r.column[0]) == REFUSED);
    CHECK(etendue_image_environment_invert_batch(NULL, 64, w_in, r.column) == REFUSED);
    EtendueImageEnvironment broken = sky;
    broken.table = NULL;
    CHECK(etendue_image_environment_sample_batch(&broken, 64, u_in, &columns) == REFUSED);
    broken = sky;
    broken.map = 2;
    CHECK(etendue_image_environment_sample_batch(&broken, 64, u_in, &columns) == ETENDUE_STATUS_VALUE);
    broken = sky;
    broken.width = 0;
    CHECK(etendue_image_environment_sample_batch(&broken, 64, u_in, &columns) == ETENDUE_STATUS_COUNT);
    CHECK(etendue_image_environment_sample_batch(NULL, 0, NULL, NULL) == OK && only_written(&r, 0, 0));
    free(r.memory);
}

// ---- more than 2^31 elements ----

// A set of one light of each kind, and a mesh: the pdf of a sample is that of its direction, the light of the receiver is passed over, and what is refused writes
// nothing.
enum { KINDS = ETENDUE_LIGHT_KIND_IMAGE_ENVIRONMENT + 1 };
static const void *const kind_of[KINDS - 1] = {Sphere, Triangle, Parallelogram, Rectangle, Disk, Polygon, BilinearPatch, Line, Sun, PointLight, SpotLight, DirectionalLight, NULL};
static int is_lights_sample(const EtendueLightsSample *s) {
    int so = isfinite(s->distance) && isfinite(s->bound) && isfinite(s->pmf) && isfinite(s->weight) && isfinite(s->reach) && s->delta <= 1;
    for (int k = 0; k < 3; k++) so = so && isfinite(s->direction[k]) && isfinite(s->point[k]) && isfinite(s->normal[k]);
    return so && s->pdf >= 0 && s->weight >= 0 && s->reach <= s->distance && s->pmf <= 1;
}
static void test_lights(void) {
    float weights[8] = {1, 2, 3, 4, 5, 6, 7, 8}, table[18], mesh[18];
    EtendueImageEnvironment sky;
    CHECK(etendue_image_environment_table(2, 4) <= 18 && etendue_image_environment_build(weights, 2, 4, ETENDUE_ENVIRONMENT_MAP_EQUIRECTANGULAR, table, &sky) == OK);
    memcpy(mesh, Triangle, sizeof Triangle);
    memcpy(mesh + 9, Triangle, sizeof Triangle);
    mesh[9] += 2;
    EtendueEmitter emitters[KINDS + 1];
    for (uint32_t k = 0; k <= KINDS; k++) {
        const EtendueEmitter one = {k < KINDS - 1 ? kind_of[k] : k < KINDS ? (const void *)&sky : mesh, k < KINDS ? 1 : 2, k < KINDS ? k : ETENDUE_LIGHT_KIND_TRIANGLE, k % 2, {0, -1, 0}, 1 + (float)k};
        emitters[k] = one;
    }
    EtendueLights *lights = NULL;
    CHECK(etendue_lights_create(KINDS + 1, emitters, NULL) == REFUSED && etendue_lights_create(1, NULL, &lights) == REFUSED && !lights);
    EtendueEmitter wrong = emitters[0];
    wrong.light = NULL;
    CHECK(etendue_lights_create(1, &wrong, &lights) == REFUSED && !lights);
    wrong = emitters[0];
    wrong.two_sided = 2;
    CHECK(etendue_lights_create(1, &wrong, &lights) == ETENDUE_STATUS_VALUE && !lights);
    wrong = emitters[0];
    wrong.kind = KINDS;
    CHECK(etendue_lights_create(1, &wrong, &lights) == ETENDUE_STATUS_VALUE && !lights);
    wrong = emitters[KINDS - 1];
    wrong.parts = 2;
    CHECK(etendue_lights_create(1, &wrong, &lights) == ETENDUE_STATUS_VALUE && !lights);
    wrong = emitters[0];
    wrong.parts = SIZE_MAX;
    CHECK(etendue_lights_create(1, &wrong, &lights) == ETENDUE_STATUS_COUNT && !lights);
    CHECK(etendue_lights_create(0, NULL, &lights) == OK && lights);
    EtendueReceiver receiver = {{0.1f, 0, -0.2f}, {0, 1, 0}, ETENDUE_SIDE_SURFACE, NULL};
    EtendueLightsAt prepared;
    EtendueLightsSample s, before;
    const float middle[3] = {0.3f, 0.6f, 0.2f};
    CHECK(etendue_lights_at(lights, &receiver, &prepared) == OK && etendue_lights_sample(&prepared, middle, &s) == OK && s.pdf == 0 && s.weight == 0);
    etendue_lights_free(lights);
    etendue_lights_free(NULL);
    CHECK(etendue_lights_create(KINDS + 1, emitters, &lights) == OK);
    // the set has copies
    memset(table, PATTERN, sizeof table);
    memset(mesh, PATTERN, sizeof mesh);
    CHECK(etendue_lights_at(NULL, &receiver, &prepared) == REFUSED && etendue_lights_at(lights, NULL, &prepared) == REFUSED);
    CHECK(etendue_lights_at(lights, &receiver, NULL) == REFUSED);
    receiver.side = 3;
    CHECK(etendue_lights_at(lights, &receiver, &prepared) == ETENDUE_STATUS_VALUE);
    int drawn[KINDS + 1] = {0}, second = 0;
    for (receiver.side = ETENDUE_SIDE_SURFACE; receiver.side <= ETENDUE_SIDE_NONE; receiver.side++) {
        CHECK(etendue_lights_at(lights, &receiver, &prepared) == OK);
        for (int i = 0; i < 20000; i++) {
            const float u[3] = {uniform(), uniform(), uniform()};
            CHECK(etendue_lights_sample(&prepared, u, &s) == OK && is_lights_sample(&s) && s.which.light <= KINDS);
            drawn[s.which.light] += s.pdf > 0;
            second += s.which.light == KINDS && s.which.part == 1;
            const float pdf = etendue_lights_pdf(&prepared, s.which, s.direction);
            if (s.which.light == ETENDUE_LIGHT_KIND_LINE || emitters[s.which.light].kind == ETENDUE_LIGHT_KIND_BILINEAR_PATCH)
                CHECK(s.which.light == ETENDUE_LIGHT_KIND_LINE ? pdf == 0 : fabsf(pdf / s.pdf - 1) < 1e-3f || s.pdf == 0);
            else
                CHECK(s.delta ? pdf == 0 : same(pdf, s.pdf));
        }
    }
    for (int k = 0; k <= KINDS; k++) CHECK(drawn[k] > 0);
    CHECK(second > 0 && second < drawn[KINDS]);
    // a receiver on a light
    const EtendueWhich on = {ETENDUE_LIGHT_KIND_SPHERE, 0};
    receiver.side = ETENDUE_SIDE_SURFACE;
    receiver.on = &on;
    CHECK(etendue_lights_at(lights, &receiver, &prepared) == OK);
    for (int i = 0; i < 20000; i++) {
        const float u[3] = {uniform(), uniform(), uniform()};
        CHECK(etendue_lights_sample(&prepared, u, &s) == OK && (s.which.light != on.light || s.pdf == 0));
        CHECK(etendue_lights_pdf(&prepared, on, s.direction) == 0);
    }
    memset(&before, PATTERN, sizeof before);
    s = before;
    const float outside[4] = {-1, 1, NAN, INFINITY};
    for (int k = 0; k < 12; k++) {
        float u[3] = {0.3f, 0.6f, 0.2f};
        u[k % 3] = outside[k / 3];
        CHECK(etendue_lights_sample(&prepared, u, &s) == ETENDUE_STATUS_VALUE && memcmp(&s, &before, sizeof s) == 0);
    }
    CHECK(etendue_lights_sample(NULL, middle, &s) == REFUSED && etendue_lights_sample(&prepared, NULL, &s) == REFUSED);
    CHECK(etendue_lights_sample(&prepared, middle, NULL) == REFUSED && memcmp(&s, &before, sizeof s) == 0);
    const EtendueWhich none = {KINDS + 1, 0};
    CHECK(etendue_lights_pdf(NULL, on, up) == 0 && etendue_lights_pdf(&prepared, on, NULL) == 0 && etendue_lights_pdf(&prepared, none, up) == 0);
    etendue_lights_free(lights);
}

// Inputs are 8 GB of zeros, which need no memory while they are only read; outputs lie in 64 MB that are mapped again and again, so that
// the last elements remain.
// Numbers that are no technique or no warp are refused, and nothing is written.
static void test_unknown(void) {
    const uint32_t numbers[] = {ETENDUE_TECHNIQUE_IMAGE_BY_RADIANCE + 1, 1000, 0x80000000u, UINT32_MAX};
    const float light[64] = {0}, w[3] = {0, 1, 0};
    const float *const columns[3] = {u_numbers[0], u_numbers[1], w_numbers[0]};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        const uint32_t t = numbers[k];
        Results r = results(17);
        const EtendueSampleColumns out = sample_columns(r.column);
        float *const sampler = r.column[0];
        EtendueLightSample s, before;
        memset(&before, PATTERN, sizeof before);
        s = before;
        CHECK(etendue_prepare(t, light, w, w, sampler) == ETENDUE_STATUS_VALUE && etendue_sample(t, light, w, &s) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_hit(t, light, w, &s) == ETENDUE_STATUS_VALUE && etendue_invert(t, light, w, sampler) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_pdf(t, light, w) == 0 && memcmp(&s, &before, sizeof s) == 0);
        CHECK(etendue_sample_batch(t, light, 17, columns, &out) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_hit_batch(t, light, 17, columns, &out) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_pdf_batch(t, light, 17, columns, r.column[0]) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_invert_batch(t, light, 17, columns, r.column) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_sample_each(t, light, 17, columns, columns, columns, &out) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_hit_each(t, light, 17, columns, columns, columns, &out) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_pdf_each(t, light, 17, columns, columns, columns, r.column[0]) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_invert_each(t, light, 17, columns, columns, columns, r.column) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_warp_sample(t, light, w, sampler) == ETENDUE_STATUS_VALUE && etendue_warp_invert(t, light, w, sampler) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_warp_pdf(t, light, w) == 0 && etendue_warp_pdf_batch(t, light, 17, columns, r.column[0]) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_warp_sample_batch(t, light, 17, columns, r.column) == ETENDUE_STATUS_VALUE);
        CHECK(etendue_warp_invert_batch(t, light, 17, columns, r.column) == ETENDUE_STATUS_VALUE);
        CHECK(only_written(&r, 0, 0));
        free(r.memory);
    }
    CHECK(etendue_warp_sample(ETENDUE_WARP_PATCH_SURFACE + 1, light, w, NULL) == REFUSED && etendue_warp_pdf(ETENDUE_WARP_PATCH_SURFACE + 1, light, w) == 0);
}

// Random numbers outside of [0, 1) are refused by single calls, which write nothing. Batches take them: the neighbours are as they are without
// them, and for NaN the pdf is 0 unless the technique does not use the number.
enum { OUTSIDE = 8 };
static void test_outside(void) {
    const float outside[OUTSIDE] = {-1e-30f, -1, 1, 1.5f, 1e30f, INFINITY, -INFINITY, NAN};
    EtendueLightSample s, before;
    memset(&before, PATTERN, sizeof before);
    for (size_t k = 0; k < sizeof techniques / sizeof *techniques; k++) {
        const Technique *t = techniques + k;
        float sampler[SAMPLER_NUMBERS];
        current = t->name;
        CHECK(t->prepare(t->light, origin, up, sampler) == OK);
        for (int which = 0; which < 2; which++) {
            float numbers[2][OUTSIDE + 1];
            for (int i = 0; i < OUTSIDE; i++) {
                numbers[which][i] = outside[i];
                numbers[!which][i] = 0.3f;
                const float u[2] = {numbers[0][i], numbers[1][i]};
                s = before;
                CHECK(t->sample(sampler, u, &s) == ETENDUE_STATUS_VALUE && memcmp(&s, &before, sizeof s) == 0);
            }
            const float edge[2] = {which ? 0.3f : -0.0f, which ? 1 - FLT_EPSILON / 2 : 0.3f};
            CHECK(t->sample(sampler, edge, &s) == OK);
            numbers[0][OUTSIDE] = edge[0];
            numbers[1][OUTSIDE] = edge[1];
            const float *const u_in[2] = {numbers[0], numbers[1]};
            Results r = results(OUTSIDE + 1);
            const EtendueSampleColumns out = sample_columns(r.column);
            CHECK(t->sample_batch(sampler, OUTSIDE + 1, u_in, &out) == OK && is_sample(r.column, OUTSIDE, &s));
            // lights of one dimension use the first number alone, delta lights none
            int unused = 1;
            for (int i = 0; i < OUTSIDE - 1; i++) unused = unused && same(at(r.column[4], OUTSIDE - 1), at(r.column[4], i));
            CHECK((at(r.column[4], OUTSIDE - 1) == 0 && at(r.column[5], OUTSIDE - 1) == 0) || unused);
            free(r.memory);
        }
    }
    for (size_t k = 0; k < sizeof warps / sizeof *warps; k++) {
        const Warp *w = warps + k;
        current = w->name;
        for (int which = 0; which < 2; which++) {
            for (int i = 0; i < OUTSIDE; i++) {
                float point[3], u[2] = {0.3f, 0.6f};
                memset(point, PATTERN, sizeof point);
                u[which] = outside[i];
                CHECK(w->sample(w->parameters, u, point) == ETENDUE_STATUS_VALUE && is_untouched((unsigned char *)point, sizeof point));
            }
        }
    }
}

static void test_huge(void) {
    current = "2^31 + 5 elements";
    const size_t n = ((size_t)1 << 31) + 5, window = (size_t)1 << 26, windows = 4 * n / window + 1;
    const clock_t start = clock();
    float *const zeros = mmap(NULL, 4 * n, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    unsigned char *const out = mmap(NULL, windows * window, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    FILE *const file = tmpfile();
    CHECK(zeros != MAP_FAILED && (void *)out != MAP_FAILED && file && ftruncate(fileno(file), (off_t)window) == 0);
    for (size_t k = 0; k < windows; k++)
        CHECK(mmap(out + k * window, window, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, fileno(file), 0) != MAP_FAILED);
    if (failures) return;
    float *const column = (float *)(void *)out;

    const EtendueCounters from = {5, 0, 2, NULL, NULL};
    EtendueCounters last = {5, (uint32_t)(n - 1), 2, NULL, NULL};
    float *const u[2] = {column, NULL};
    float x;
    float *const one[2] = {&x, NULL};
    CHECK(etendue_owen_sobol_pairs(1, &from, n, u) == OK && etendue_owen_sobol_pairs(1, &last, 1, one) == OK && same(x, column[n - 1]));
    // beyond the end is what the last window but one left
    last.sample = (uint32_t)(n - window / 4);
    CHECK(etendue_owen_sobol_pairs(1, &last, 1, one) == OK && same(x, column[n]));

    const float *const u_in[2] = {zeros, zeros};
    EtendueSphereBySolidAngle sampler;
    EtendueSampleColumns none;
    memset(&none, 0, sizeof none);
    CHECK(etendue_sphere_by_solid_angle_prepare((const EtendueSphere *)Sphere, origin, &sampler) == OK);
    CHECK(etendue_sphere_by_solid_angle_sample_batch(&sampler, n, u_in, &none) == OK);
    munmap(zeros, 4 * n);
    munmap(out, windows * window);
    fclose(file);
    printf("2^31 + 5 elements, twice: %.1f s\n", (double)(clock() - start) / CLOCKS_PER_SEC);
}

int main(int argc, char **argv) {
    for (size_t i = 0; i < MOST; i++) {
        float w[3], n[3];
        direction(w, 1);
        direction(n, 0);
        for (int k = 0; k < 3; k++) {
            p_numbers[k][i] = k == 1 ? uniform() : 2 * uniform() - 1;
            n_numbers[k][i] = n[k];
            w_numbers[k][i] = w[k];
        }
        u_numbers[0][i] = uniform();
        u_numbers[1][i] = uniform();
    }
    if (argc > 1 && strcmp(argv[1], "--few") == 0) sizes[3] = sizes[4] = 17;
    if (argc > 1 && strcmp(argv[1], "--huge") == 0) {
        test_huge();
    } else {
        for (size_t k = 0; k < sizeof techniques / sizeof *techniques; k++) {
            const Technique *t = techniques + k;
            float sampler[SAMPLER_NUMBERS];
            current = t->name;
            CHECK(t->light_numbers <= LIGHT_NUMBERS && t->sampler_numbers <= SAMPLER_NUMBERS);
            memset(sampler, PATTERN, sizeof sampler);
            CHECK(t->prepare(t->light, origin, up, sampler) == OK);
            CHECK(is_untouched((unsigned char *)(sampler + t->sampler_numbers), 4 * (SAMPLER_NUMBERS - t->sampler_numbers)));
            // half of the directions are samples, so that they hit
            for (size_t i = 0; i < MOST; i += 2) {
                const float u[2] = {u_numbers[0][i], u_numbers[1][i]};
                EtendueLightSample s;
                CHECK(t->sample(sampler, u, &s) == OK);
                for (int c = 0; c < 3; c++) w_numbers[c][i] = s.direction[c];
            }
            test_values(t, sampler);
            test_batches(t, sampler);
            test_nulls(t, sampler);
        }
        const float wi[3] = {0.48f, 0.36f, 0.8f};
        current = "ggx_visible_normals_prepare";
        EtendueGgxVisibleNormals *const ggx = (EtendueGgxVisibleNormals *)GgxVisibleNormals;
        CHECK(sizeof *ggx == sizeof GgxVisibleNormals);
        CHECK(etendue_ggx_visible_normals_prepare(0.3f, 0.5f, NULL, ggx) == REFUSED && GgxVisibleNormals[0] == 0);
        CHECK(etendue_ggx_visible_normals_prepare(0.3f, 0.5f, wi, NULL) == REFUSED);
        CHECK(etendue_ggx_visible_normals_prepare(0.3f, 0.5f, wi, ggx) == OK);
        current = "reflections";
        test_reflections();
        for (size_t k = 0; k < sizeof warps / sizeof *warps; k++) {
            current = warps[k].name;
            test_warp(warps + k);
        }
        for (size_t k = 0; k < sizeof sequences / sizeof *sequences; k++) {
            current = sequences[k].name;
            test_sequence(sequences + k);
        }
        current = "unknown";
        test_unknown();
        test_outside();
        current = "light_tree";
        test_tree(300);
        test_tree(1);
        test_tree(0);
        CHECK(etendue_light_tree_nodes(0) < 2);
        current = "image_environment";
        test_image(ETENDUE_ENVIRONMENT_MAP_EQUAL_AREA);
        test_image(ETENDUE_ENVIRONMENT_MAP_EQUIRECTANGULAR);
        current = "lights";
        test_lights();
    }
    const uint32_t level = etendue_level();
    CHECK(level == 0 || level == 3 || level == 4);
    printf("%ld checks at level %u, %d failed\n", checks, (unsigned)level, failures);
    return failures > 0;
}
