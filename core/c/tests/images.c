// Tests of the lights with images in etendue.h, in C99: images
//
// Closed forms, inverses, sums of probabilities, degenerate input, null pointers, and that batches are their elements one by one and write
// nothing else. core/c/tests/bits.rs compares the functions with the core.
#define _DEFAULT_SOURCE
#include "common.h"

#define WRONG ETENDUE_STATUS_VALUE
#define COUNT ETENDUE_STATUS_COUNT
enum { WIDTH = 5, HEIGHT = 3, TEXELS = WIDTH * HEIGHT, N = 100 };
static const double PI = 3.14159265358979324;
static const float p[3] = {0.1f, 0.2f, 0.3f}, n[3] = {0, 0.8f, 0.6f};
static const float weights[TEXELS] = {0, 1, 0.3f, 1e-3f, 7, 2, 0, 0.5f, 3, 1, 4, 0.25f, 1, 0, 6};
static float u_numbers[2][N], w_numbers[3][N], p_numbers[3][N], n_numbers[3][N];
static const float *const u_in[2] = {u_numbers[0], u_numbers[1]};
static const float *const w_in[3] = {w_numbers[0], w_numbers[1], w_numbers[2]};
static const float *const p_in[3] = {p_numbers[0], p_numbers[1], p_numbers[2]};
static const float *const n_in[3] = {n_numbers[0], n_numbers[1], n_numbers[2]};

// Cosine at the light. The pdf per steradian of a rounded direction is as uncertain as this is small.
static float cosine(const EtendueLightSample *s) {
    return fabsf(s->direction[0] * s->normal[0] + s->direction[1] * s->normal[1] + s->direction[2] * s->normal[2]);
}

// Tests all functions of a technique. AT and EACH are the normals with a comma before them, if the technique needs them, and SAME is
// whether the pdf of a sample is that of its direction to the bit.
#define TECHNIQUE(NAME, LIGHT, COLUMNS_OF, PREFIX, AT, EACH, AT_I, SAME)                                                             \
    static void PREFIX##_test(const LIGHT *light, const COLUMNS_OF *columns, const LIGHT *wrong, EtendueStatus status) {             \
        NAME sampler, other, zero;                                                                                                   \
        EtendueLightSample s, hit, again;                                                                                            \
        float back[2];                                                                                                               \
        current = #PREFIX;                                                                                                           \
        memset(&zero, 0, sizeof zero);                                                                                               \
        memset(&other, PATTERN, sizeof other);                                                                                       \
        CHECK(PREFIX##_prepare(NULL, p AT, &other) == REFUSED && PREFIX##_prepare(light, NULL AT, &other) == REFUSED);               \
        CHECK(PREFIX##_prepare(light, p AT, NULL) == REFUSED && PREFIX##_prepare(wrong, p AT, &other) == status);                    \
        CHECK(is_untouched((unsigned char *)&other, sizeof other));                                                                  \
        CHECK(PREFIX##_prepare(light, p AT, &sampler) == OK);                                                                        \
        for (int i = 0; i < N; i += 2) {                                                                                             \
            const float u[2] = {u_numbers[0][i], u_numbers[1][i]};                                                                   \
            CHECK(PREFIX##_sample(&sampler, u, &s) == OK && is_finite(&s) && s.pdf >= 0);                                            \
            for (int c = 0; c < 3; c++) w_numbers[c][i] = s.direction[c];                                                            \
            if (!(s.pdf > 0)) continue;                                                                                              \
            const float pdf = PREFIX##_pdf(&sampler, s.direction);                                                                   \
            CHECK(SAME ? same(pdf, s.pdf) : !s.emits || fabsf(pdf / s.pdf - 1) * cosine(&s) < 2e-5f);                                \
            CHECK(PREFIX##_hit(&sampler, s.direction, &hit) == OK && same(hit.pdf, pdf));                                            \
            CHECK(PREFIX##_invert(&sampler, s.direction, back) == OK && back[0] >= 0 && back[0] < 1 && back[1] >= 0 && back[1] < 1); \
            CHECK(PREFIX##_sample(&sampler, back, &again) == OK && difference(again.direction, s.direction, 3) < 1e-5f);             \
        }                                                                                                                            \
        Results a = results(N), b = results(N), c = results(N), d = results(N);                                                      \
        const EtendueSampleColumns a_out = sample_columns(a.column), b_out = sample_columns(b.column);                               \
        CHECK(PREFIX##_sample_batch(&sampler, N, u_in, &a_out) == OK && only_written(&a, 0, COLUMNS));                               \
        CHECK(PREFIX##_hit_batch(&sampler, N, w_in, &b_out) == OK && only_written(&b, 0, COLUMNS));                                  \
        CHECK(PREFIX##_pdf_batch(&sampler, N, w_in, c.column[0]) == OK && only_written(&c, 0, 1));                                   \
        CHECK(PREFIX##_invert_batch(&sampler, N, w_in, c.column + 1) == OK && only_written(&c, 0, 3));                               \
        for (size_t i = 0; i < N; i++) {                                                                                             \
            const float u[2] = {u_numbers[0][i], u_numbers[1][i]}, w[3] = {w_numbers[0][i], w_numbers[1][i], w_numbers[2][i]};       \
            CHECK(PREFIX##_sample(&sampler, u, &s) == OK && is_sample(a.column, i, &s));                                             \
            CHECK(PREFIX##_hit(&sampler, w, &hit) == OK && is_sample(b.column, i, &hit));                                            \
            CHECK(same(PREFIX##_pdf(&sampler, w), at(c.column[0], i)) && PREFIX##_invert(&sampler, w, back) == OK);                  \
            CHECK(same(back[0], at(c.column[1], i)) && same(back[1], at(c.column[2], i)));                                           \
        }                                                                                                                            \
        CHECK(PREFIX##_sample_each(columns, N, p_in EACH, u_in, &a_out) == OK && only_written(&a, 0, COLUMNS));                      \
        CHECK(PREFIX##_hit_each(columns, N, p_in EACH, w_in, &b_out) == OK && only_written(&b, 0, COLUMNS));                         \
        CHECK(PREFIX##_pdf_each(columns, N, p_in EACH, w_in, d.column[0]) == OK && only_written(&d, 0, 1));                          \
        CHECK(PREFIX##_invert_each(columns, N, p_in EACH, w_in, d.column + 1) == OK && only_written(&d, 0, 3));                      \
        for (size_t i = 0; i < N; i++) {                                                                                             \
            const float u[2] = {u_numbers[0][i], u_numbers[1][i]}, w[3] = {w_numbers[0][i], w_numbers[1][i], w_numbers[2][i]};       \
            const float p_i[3] = {p_numbers[0][i], p_numbers[1][i], p_numbers[2][i]};                                                \
            const float n_i[3] = {n_numbers[0][i], n_numbers[1][i], n_numbers[2][i]};                                                \
            (void)n_i;                                                                                                               \
            CHECK(PREFIX##_prepare(light, p_i AT_I, &other) == OK);                                                                  \
            CHECK(PREFIX##_sample(&other, u, &s) == OK && is_sample(a.column, i, &s));                                               \
            CHECK(PREFIX##_hit(&other, w, &hit) == OK && is_sample(b.column, i, &hit));                                              \
            CHECK(same(PREFIX##_pdf(&other, w), at(d.column[0], i)) && PREFIX##_invert(&other, w, back) == OK);                      \
            CHECK(same(back[0], at(d.column[1], i)) && same(back[1], at(d.column[2], i)));                                           \
        }                                                                                                                            \
        CHECK(PREFIX##_sample(NULL, *u_in, &s) == REFUSED && PREFIX##_sample(&sampler, NULL, &s) == REFUSED);                        \
        CHECK(PREFIX##_sample(&sampler, *u_in, NULL) == REFUSED && PREFIX##_sample(&zero, *u_in, &s) == REFUSED);                    \
        CHECK(PREFIX##_pdf(NULL, p) == 0 && PREFIX##_pdf(&sampler, NULL) == 0 && PREFIX##_pdf(&zero, p) == 0);                       \
        CHECK(PREFIX##_hit(NULL, p, &s) == REFUSED && PREFIX##_invert(&sampler, p, NULL) == REFUSED);                                \
        CHECK(PREFIX##_sample_batch(&sampler, N, NULL, &a_out) == REFUSED && PREFIX##_sample_batch(NULL, N, u_in, &a_out) == REFUSED); \
        CHECK(PREFIX##_sample_batch(&sampler, N, u_in, NULL) == REFUSED && PREFIX##_pdf_batch(&sampler, N, w_in, NULL) == REFUSED);  \
        CHECK(PREFIX##_invert_batch(&sampler, N, w_in, NULL) == REFUSED && PREFIX##_hit_batch(&sampler, N, NULL, &a_out) == REFUSED); \
        CHECK(PREFIX##_sample_each(NULL, N, p_in EACH, u_in, &a_out) == REFUSED);                                                    \
        CHECK(PREFIX##_sample_each(columns, N, NULL EACH, u_in, &a_out) == REFUSED);                                                 \
        CHECK(PREFIX##_sample_each(columns, N, p_in EACH, NULL, &a_out) == REFUSED);                                                 \
        CHECK(PREFIX##_sample_each(columns, N, p_in EACH, u_in, NULL) == REFUSED);                                                   \
        CHECK(PREFIX##_pdf_each(columns, N, p_in EACH, w_in, NULL) == REFUSED);                                                      \
        CHECK(PREFIX##_hit_each(columns, N, p_in EACH, NULL, &a_out) == REFUSED);                                                    \
        CHECK(PREFIX##_invert_each(columns, N, p_in EACH, w_in, NULL) == REFUSED);                                                   \
        CHECK(PREFIX##_sample_each(NULL, 0, NULL EACH, NULL, NULL) == OK && PREFIX##_sample_batch(NULL, 0, NULL, NULL) == OK);       \
        free(a.memory), free(b.memory), free(c.memory), free(d.memory);                                                              \
    }
#define COMMA ,
#define ANYWHERE(NAME, LIGHT, COLUMNS_OF, PREFIX, SAME) TECHNIQUE(NAME, LIGHT, COLUMNS_OF, PREFIX, , , , SAME)
ANYWHERE(EtenduePictureByArea, EtenduePicturedParallelogram, EtenduePicturedParallelogramColumns, etendue_picture_by_area, 1)
ANYWHERE(EtenduePictureBySolidAngle, EtenduePicturedParallelogram, EtenduePicturedParallelogramColumns, etendue_picture_by_solid_angle, 1)
TECHNIQUE(EtenduePictureByProjectedSolidAngle, EtenduePicturedParallelogram, EtenduePicturedParallelogramColumns,
          etendue_picture_by_projected_solid_angle, COMMA n, COMMA n_in, COMMA n_i, 1)
ANYWHERE(EtenduePictureOnSphereByVisibleArea, EtenduePicturedSphere, EtenduePicturedSphereColumns, etendue_picture_on_sphere_by_visible_area, 0)
ANYWHERE(EtenduePortalsByRadiance, EtenduePortalEnvironment, EtenduePortalEnvironment, etendue_portals_by_radiance, 1)

// Tables, and what cannot be built.
static void test_tables(void) {
    enum { FLOATS = 13 * (TEXELS + 9) };
    float table[FLOATS + 1], wrong[TEXELS], means[TEXELS];
    EtenduePicture picture, untouched;
    current = "picture";
    memset(table, PATTERN, sizeof table);
    memset(&picture, PATTERN, sizeof picture);
    memset(&untouched, PATTERN, sizeof untouched);
    memcpy(wrong, weights, sizeof wrong);
    const size_t most = (size_t)1 << 24, floats = etendue_picture_table(WIDTH, HEIGHT), smooth = etendue_picture_interpolated_table(WIDTH, HEIGHT);
    CHECK(etendue_picture_table(16, 16) == 272 && etendue_picture_table(1, 1) == 0 && etendue_picture_table(most, 1) == 16 * ((most - 1) / 3));
    CHECK(etendue_picture_table(0, 3) == 0 && etendue_picture_table(3, 0) == 0 && etendue_picture_table(most + 1, 1) == 0);
    CHECK(etendue_picture_table(most, 127) > 0 && etendue_picture_table(most, 128) == 0 && etendue_picture_table(SIZE_MAX, SIZE_MAX) == 0);
    CHECK(etendue_picture_interpolated_table(7, 3) == etendue_picture_table(8, 4) && etendue_picture_interpolated_table(0, 1) == 0);
    CHECK(etendue_picture_interpolated_table(most, 1) == 0 && etendue_picture_interpolated_table(SIZE_MAX, 1) == 0);
    CHECK(floats > 0 && floats <= FLOATS && smooth >= floats && smooth <= FLOATS);
    CHECK(etendue_picture_build(NULL, WIDTH, HEIGHT, 0, table, &picture) == REFUSED);
    CHECK(etendue_picture_build(weights, WIDTH, HEIGHT, 0, NULL, &picture) == REFUSED);
    CHECK(etendue_picture_build(weights, WIDTH, HEIGHT, 0, table, NULL) == REFUSED);
    CHECK(etendue_picture_build(weights, 0, HEIGHT, 0, table, &picture) == COUNT);
    CHECK(etendue_picture_build(weights, most + 1, 1, 0, table, &picture) == COUNT);
    CHECK(etendue_picture_build(weights, WIDTH, HEIGHT, 3, table, &picture) == WRONG);
    CHECK(etendue_picture_interpolate(NULL, WIDTH, HEIGHT, table, &picture) == REFUSED);
    CHECK(etendue_picture_interpolate(weights, WIDTH, HEIGHT, NULL, &picture) == REFUSED);
    CHECK(etendue_picture_interpolate(weights, WIDTH, HEIGHT, table, NULL) == REFUSED);
    CHECK(etendue_picture_interpolate(weights, WIDTH, 0, table, &picture) == COUNT);
    const float values[] = {-1, -1e-30f, (float)INFINITY, (float)NAN};
    for (int k = 0; k < 4; k++) {
        wrong[TEXELS - 1] = values[k];
        CHECK(etendue_picture_build(wrong, WIDTH, HEIGHT, 0, table, &picture) == WRONG);
        CHECK(etendue_picture_interpolate(wrong, WIDTH, HEIGHT, table, &picture) == WRONG);
    }
    const float dark[TEXELS] = {0};
    CHECK(etendue_picture_build(dark, WIDTH, HEIGHT, 0, table, &picture) == WRONG);
    CHECK(etendue_picture_interpolate(dark, WIDTH, HEIGHT, table, &picture) == WRONG);
    CHECK(is_untouched((unsigned char *)table, sizeof table) && memcmp(&picture, &untouched, sizeof picture) == 0);
    CHECK(etendue_picture_build(weights, WIDTH, HEIGHT, 0, table, &picture) == OK && picture.table == table && picture.values == NULL);
    CHECK(is_untouched((unsigned char *)(table + floats), sizeof table - floats * sizeof *table));
    // only the last texel has radiance, and that is beyond the diagonal
    float corner[4] = {0, 0, 0, 1};
    CHECK(etendue_picture_build(corner, 2, 2, ETENDUE_PICTURE_REGION_TRIANGLE, table, &picture) == WRONG);

    CHECK(etendue_picture_means_of_bilinear(NULL, WIDTH, HEIGHT, means) == REFUSED);
    CHECK(etendue_picture_means_of_bilinear(weights, WIDTH, HEIGHT, NULL) == REFUSED);
    CHECK(etendue_picture_means_of_bilinear(weights, 0, HEIGHT, means) == COUNT);
    CHECK(etendue_picture_means_of_bilinear(corner, 2, 2, means) == OK);
    CHECK(means[0] == 0.015625f && means[1] == 0.109375f && means[2] == 0.109375f && means[3] == 0.765625f);
}

// A picture on a rectangle that fills a small solid angle: closed forms.
static void test_closed_forms(void) {
    current = "closed forms of pictures";
    float table[256], smooth[256];
    EtenduePicture picture;
    CHECK(etendue_picture_build(weights, WIDTH, HEIGHT, 0, table, &picture) == OK);
    const EtendueParallelogram panel = {{-0.5f, 3, -0.5f}, {0, 0, 1}, {1, 0, 0}};
    const EtenduePicturedParallelogram light = {picture, panel};
    const float origin[3] = {0, 0, 0};
    EtenduePictureByArea by_area;
    CHECK(etendue_picture_by_area_prepare(&light, origin, &by_area) == OK);
    double total = 0, sum = 0;
    for (int k = 0; k < TEXELS; k++) total += weights[k];
    for (int k = 0; k < TEXELS; k++) {
        const float s = (k % WIDTH + 0.5f) / WIDTH, t = (k / WIDTH + 0.5f) / HEIGHT;
        const float v[3] = {panel.corner[0] + t, 3, panel.corner[2] + s};
        const float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        const float w[3] = {v[0] / length, v[1] / length, v[2] / length};
        // the pdf by area of a texel is its part of the radiance over its area
        const double pmf = weights[k] / total, pdf = pmf * TEXELS * length * length / w[1];
        const float found = etendue_picture_by_area_pdf(&by_area, w);
        CHECK(weights[k] > 0 ? fabs(found / pdf - 1) < 1e-4 : found == 0);
        sum += found * w[1] / (length * length) / TEXELS;
        // and uv is the position
        EtendueLightSample hit;
        CHECK(etendue_picture_by_area_hit(&by_area, w, &hit) == OK);
        if (weights[k] > 0) CHECK(fabsf(hit.uv[0] - s) < 1e-5f && fabsf(hit.uv[1] - t) < 1e-5f && fabsf(hit.distance - length) < 1e-5f);
    }
    CHECK(fabs(sum - 1) < 1e-6);

    // of an interpolated picture, the pdf by area is in proportion to the interpolated radiance
    const float ramp[2] = {1, 3};
    CHECK(etendue_picture_interpolate(ramp, 2, 1, smooth, &picture) == OK && picture.values == ramp);
    const EtenduePicturedParallelogram smooth_light = {picture, panel};
    CHECK(etendue_picture_by_area_prepare(&smooth_light, origin, &by_area) == OK);
    for (int k = 1; k < 20; k++) {
        const float s = k / 20.0f, v[3] = {0, 3, panel.corner[2] + s}, length = sqrtf(9 + v[2] * v[2]);
        const float w[3] = {0, v[1] / length, v[2] / length};
        const double radiance = s < 0.25f ? 1 : s > 0.75f ? 3 : 1 + 4 * (s - 0.25), mean = 2;
        CHECK(fabs(etendue_picture_by_area_pdf(&by_area, w) / (radiance / mean * length * length / w[1]) - 1) < 1e-4);
    }

    // triangles and disks by their surface coordinates: a picture of one texel has the pdf of the light alone
    const float one = 1;
    float none = 0;
    const EtendueTriangle triangle = {{-0.5f, 3, -0.3f}, {0.1f, 0.2f, 1.1f}, {1.2f, 0.1f, 0.2f}};
    const EtendueDisk disk = {{0.3f, 3, 0.1f}, {0, -1, 0}, 0.5f};
    const EtendueRectangle rectangle = {{-0.5f, 3, -0.5f}, {0, 0, 1}, {1, 0, 0}};
    EtendueTriangleByArea triangle_by_area;
    EtendueDiskByArea disk_by_area;
    EtenduePicturedParallelogram other;
    CHECK(etendue_triangle_coordinates(NULL, &other.light) == REFUSED && etendue_triangle_coordinates(&triangle, NULL) == REFUSED);
    CHECK(etendue_rectangle_coordinates(&rectangle, &other.light) == OK && memcmp(&other.light, &rectangle, sizeof rectangle) == 0);
    CHECK(etendue_triangle_by_area_prepare(&triangle, p, &triangle_by_area) == OK && etendue_disk_by_area_prepare(&disk, p, &disk_by_area) == OK);
    for (int shape = 0; shape < 2; shape++) {
        const uint32_t region = shape ? ETENDUE_PICTURE_REGION_DISK : ETENDUE_PICTURE_REGION_TRIANGLE;
        const double part = shape ? PI / 4 : 0.5;
        CHECK(etendue_picture_build(&one, 1, 1, region, &none, &other.picture) == OK);
        CHECK((shape ? etendue_disk_coordinates(&disk, &other.light) : etendue_triangle_coordinates(&triangle, &other.light)) == OK);
        CHECK(etendue_picture_by_area_prepare(&other, p, &by_area) == OK);
        int hits = 0;
        for (int i = 0; i < N; i++) {
            const float u[2] = {u_numbers[0][i], u_numbers[1][i]};
            EtendueLightSample s;
            CHECK(etendue_picture_by_area_sample(&by_area, u, &s) == OK);
            const float alone = shape ? etendue_disk_by_area_pdf(&disk_by_area, s.direction) : etendue_triangle_by_area_pdf(&triangle_by_area, s.direction);
            // beyond the rim, the pdf is 0
            CHECK(s.pdf > 0 ? fabs(s.pdf / (alone * part) - 1) < 1e-4 : alone == 0);
            hits += s.pdf > 0;
        }
        CHECK(hits > N / 4 && hits < N);
    }
}

static void test_techniques(void) {
    float table[256], smooth[256];
    EtenduePicture picture, interpolated;
    CHECK(etendue_picture_build(weights, WIDTH, HEIGHT, 0, table, &picture) == OK);
    CHECK(etendue_picture_interpolate(weights, WIDTH, HEIGHT, smooth, &interpolated) == OK);
    const EtenduePicturedParallelogram flat = {picture, {{-0.5f, 2, -0.3f}, {0.1f, 0.2f, 1.1f}, {1.2f, 0.1f, 0.2f}}};
    const EtenduePicturedSphere sphere = {interpolated, {{0.3f, 2, 0.1f}, 0.5f}};
    // the same light in all rows
    static float numbers[9][N];
    EtenduePicturedParallelogramColumns flats;
    EtenduePicturedSphereColumns spheres;
    flats.picture = picture;
    spheres.picture = interpolated;
    const float *const rows[2] = {flat.light.corner, sphere.light.center};
    const float **const to[2] = {flats.lights.corner, spheres.lights.center};
    const int counts[2] = {9, 4};
    for (int which = 0; which < 2; which++) {
        for (int k = 0; k < counts[which]; k++) {
            for (int i = 0; i < N; i++) numbers[k][i] = rows[which][k];
            to[which][k] = numbers[k];
        }
        if (which == 0) {
            EtenduePicturedParallelogram wrong = flat;
            wrong.picture.region = 7;
            etendue_picture_by_area_test(&flat, &flats, &wrong, WRONG);
            wrong.picture.region = 0;
            wrong.picture.width = 0;
            etendue_picture_by_solid_angle_test(&flat, &flats, &wrong, COUNT);
            wrong.picture.table = NULL;
            etendue_picture_by_projected_solid_angle_test(&flat, &flats, &wrong, REFUSED);
        } else {
            EtenduePicturedSphere wrong = sphere;
            wrong.picture.height = SIZE_MAX;
            etendue_picture_on_sphere_by_visible_area_test(&sphere, &spheres, &wrong, COUNT);
        }
    }
}

static void test_portals(void) {
    static uint64_t sums[(16 + 1) * (16 + 1) + 1];
    static float image[256];
    current = "portals";
    const EtenduePortal portals[2] = {{{-0.5f, 1, -0.5f}, {0, 0.25f, 1}, {1, 0, 0}}, {{0.25f, 1.5f, 0}, {0, 0.25f, 1}, {1, 0, 0}}};
    const EtenduePortal flat = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    CHECK(etendue_portal_table(16, 16) == sizeof sums / sizeof *sums && etendue_portal_table(0, 1) == 0 && etendue_portal_table(1, 4097) == 0);
    // a sky of the same radiance everywhere
    for (int k = 0; k < 256; k++) {
        const float uv[2] = {(k % 16 + 0.5f) / 16, (k / 16 + 0.5f) / 16};
        float w[3], solid_angle;
        CHECK(etendue_portal_direction(portals, uv, w, &solid_angle) == OK && fabsf(w[0] * w[0] + w[1] * w[1] + w[2] * w[2] - 1) < 1e-6f);
        CHECK(etendue_portal_direction(portals, uv, w, NULL) == OK);
        image[k] = solid_angle;
    }
    // straight ahead, and 45 degrees along the first edge: pi^2 times the cosine
    const float ahead[2] = {0.5f, 0.5f}, along[2] = {0.75f, 0.5f}, normal[3] = {0, 0.9701425f, -0.2425356f};
    const float oblique[3] = {0, (float)((0.9701425 + 0.2425356) * sqrt(0.5)), (float)((0.9701425 - 0.2425356) * sqrt(0.5))};
    float forward[3], ahead_angle, along_angle;
    CHECK(etendue_portal_direction(portals, ahead, forward, &ahead_angle) == OK && difference(forward, normal, 3) < 1e-6f);
    CHECK(etendue_portal_direction(portals, along, forward, &along_angle) == OK && difference(forward, oblique, 3) < 1e-6f);
    CHECK(fabs(ahead_angle / (PI * PI) - 1) < 1e-6 && fabs(along_angle / (PI * PI * sqrt(0.5)) - 1) < 1e-6);
    float direction[3];
    CHECK(etendue_portal_direction(NULL, u_in[0], direction, NULL) == REFUSED && etendue_portal_direction(portals, NULL, direction, NULL) == REFUSED);
    CHECK(etendue_portal_direction(&flat, u_in[0], direction, NULL) == WRONG);
    EtenduePortalTable tables[2], table;
    memset(&table, PATTERN, sizeof table);
    image[3] = -1;
    CHECK(etendue_portal_table_build(image, 16, 16, sums, &table) == WRONG);
    image[3] = 0;
    CHECK(etendue_portal_table_build(NULL, 16, 16, sums, &table) == REFUSED && etendue_portal_table_build(image, 16, 16, NULL, &table) == REFUSED);
    CHECK(etendue_portal_table_build(image, 4097, 1, sums, &table) == COUNT && is_untouched((unsigned char *)&table, sizeof table));
    CHECK(etendue_portal_table_build(image, 16, 16, sums, tables) == OK && tables->sums == sums);
    tables[1] = tables[0];

    const EtenduePortalEnvironment sky = {portals, tables, 2};
    EtenduePortalEnvironment wrong = {&flat, tables, 1};
    etendue_portals_by_radiance_test(&sky, &sky, &wrong, WRONG);
    wrong.portals = portals;
    wrong.count = 9;
    EtenduePortalsByRadiance sampler;
    CHECK(etendue_portals_by_radiance_prepare(&wrong, p, &sampler) == COUNT);
    wrong.count = 0;
    CHECK(etendue_portals_by_radiance_prepare(&wrong, p, &sampler) == COUNT);

    // what is sampled is seen, and what is not seen has pdf 0; from behind, nothing is
    Results r = results(N), d = results(N);
    uint8_t sees[N];
    CHECK(etendue_portals_by_radiance_pdf_each(&sky, N, p_in, w_in, r.column[0]) == OK);
    CHECK(etendue_portal_environment_sees_batch(&sky, N, p_in, w_in, sees) == OK);
    int seen = 0;
    for (int i = 0; i < N; i++) {
        CHECK(sees[i] == (at(r.column[0], i) > 0));
        seen += sees[i];
    }
    CHECK(seen > 5 && seen < N);
    CHECK(etendue_portal_environment_sees_batch(NULL, N, p_in, w_in, sees) == REFUSED && etendue_portal_environment_sees_batch(&sky, N, NULL, w_in, sees) == REFUSED);
    CHECK(etendue_portal_environment_sees_batch(&wrong, N, p_in, w_in, sees) == COUNT);
    CHECK(etendue_portal_direction_batch(portals, N, u_in, d.column, d.column[3]) == OK && only_written(&d, 0, 4));
    for (size_t i = 0; i < N; i++) {
        const float uv[2] = {u_numbers[0][i], u_numbers[1][i]};
        float w[3], solid_angle;
        CHECK(etendue_portal_direction(portals, uv, w, &solid_angle) == OK && same(solid_angle, at(d.column[3], i)) && same(w[1], at(d.column[1], i)));
    }
    const float above[3] = {0, 9, 0};
    const float first[2] = {u_numbers[0][0], u_numbers[1][0]};
    EtenduePortalsByRadiance unlit;
    EtendueLightSample s;
    CHECK(etendue_portals_by_radiance_prepare(&sky, above, &unlit) == OK && etendue_portals_by_radiance_sample(&unlit, first, &s) == OK);
    CHECK(s.pdf == 0 && s.weight == 0 && is_finite(&s));
    free(r.memory), free(d.memory);
}

int main(void) {
    for (size_t i = 0; i < N; i++) {
        float w[3], m[3];
        direction(w, 1);
        direction(m, 0);
        for (int k = 0; k < 3; k++) {
            p_numbers[k][i] = k == 1 ? 0.9f * uniform() : 2 * uniform() - 1;
            n_numbers[k][i] = m[k];
            w_numbers[k][i] = w[k];
        }
        u_numbers[0][i] = uniform();
        u_numbers[1][i] = uniform();
    }
    test_tables();
    test_closed_forms();
    test_techniques();
    test_portals();
    printf("%ld checks, %d failed\n", checks, failures);
    return failures > 0;
}
