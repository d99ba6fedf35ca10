/* Direct light of eight lights on a diffuse surface, one sample at a time, in batches, and of all as one set, in C99. Nothing is in the way, so that each has a
   closed form; the program prints the errors, and returns 1 if one is too large.

       cc -std=c99 eight_lights.c $(pkg-config --cflags --libs etendue) -lm -o eight_lights */

#include <etendue.h>
#include <math.h>
#include <stdio.h>

enum { SAMPLES = 1 << 16, BATCH = 1024 };
static const double MOST = 1e-5; /* the greatest relative error that is right for so many samples */
static const double MOST_OF_SET = 1e-3; /* the same for a set, whose samples are also distributed among the lights */
static const double PI = 3.14159265358979323846;

/* the shading point and its unit normal */
static const float P[3] = {0.2f, 0, 0.1f}, N[3] = {0, 0.8f, 0.6f};

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* The irradiance from a polygon with these corners and a radiance of 1: Lambert 1760. */
static double lambert(const float (*corners)[3], int count) {
    const double n[3] = {N[0], N[1], N[2]};
    double sum = 0;
    for (int i = 0; i < count; i++) {
        double a[3], b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = (double)corners[i][k] - P[k];
            b[k] = (double)corners[(i + 1) % count][k] - P[k];
        }
        const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        const double sin = sqrt(dot(c, c));
        sum += atan2(sin, dot(a, b)) * dot(c, n) / sin;
    }
    return fabs(sum) / 2;
}
/* The same for a corner and vectors from there to the next corners. */
static double fan(const float *corner, const float *s, const float *diagonal, const float *t) {
    float corners[4][3];
    for (int k = 0; k < 3; k++) {
        corners[0][k] = corner[k];
        corners[1][k] = corner[k] + s[k];
        corners[2][k] = corner[k] + (diagonal ? diagonal[k] : s[k] + t[k]);
        corners[3][k] = corner[k] + t[k];
    }
    return lambert((const float(*)[3])corners, 4);
}

/* A light by a technique, prepared for the point; all samplers fit. */
typedef struct {
    const char *name;
    uint32_t technique;
    double exact;
    union {
        EtendueSphereByProjectedSolidAngle sphere;
        EtendueTriangleByProjectedSolidAngle triangle;
        EtendueParallelogramBySolidAngle parallelogram;
        EtendueRectangleBySolidAngle rectangle;
        EtendueDiskBySolidAngle disk;
        EtenduePolygonBySolidAngle polygon;
        EtenduePatchByArea patch;
        EtendueSunBySolidAngle sun;
    } sampler;
} Prepared;

static int prepare(Prepared *lights, EtendueLights **set) {
    /* all of them emit towards the point */
    static const EtendueSphere sphere = {{-1, 1.5f, 0.5f}, 0.5f};
    static const EtendueTriangle triangle = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
    static const EtendueParallelogram parallelogram = {{-1, 2, 0}, {1, 0.2f, 0}, {0.1f, 0.1f, 1}};
    static const EtendueRectangle rectangle = {{-0.5f, 1.5f, 0.2f}, {1, 0, 0}, {0, 0, 1}};
    static const EtendueDisk disk = {{0.7f, 1.2f, 1}, {0, -0.8f, -0.6f}, 0.7f};
    static const EtenduePolygon polygon = {{{0, 2, 0}, {1, 2, 0}, {1.5f, 2, 1}, {1, 2, 2}, {0, 2, 2}, {0, 2, 2}, {0, 2, 2}, {0, 2, 2}}};
    static const EtendueBilinearPatch patch = {{-0.5f, 2, 0.3f}, {1, 0, 0}, {0, 0, 1}, {1.5f, 0, 1.25f}};
    static const EtendueSun sun = {{0, 0.6f, 0.8f}, 0.02f};
    const void *light[8] = {&sphere, &triangle, &parallelogram, &rectangle, &disk, &polygon, &patch, &sun};
    static const uint32_t kinds[8] = {
        ETENDUE_LIGHT_KIND_SPHERE, ETENDUE_LIGHT_KIND_TRIANGLE, ETENDUE_LIGHT_KIND_PARALLELOGRAM, ETENDUE_LIGHT_KIND_RECTANGLE,
        ETENDUE_LIGHT_KIND_DISK, ETENDUE_LIGHT_KIND_POLYGON, ETENDUE_LIGHT_KIND_BILINEAR_PATCH, ETENDUE_LIGHT_KIND_SUN,
    };
    EtendueEmitter emitters[8];
    for (int i = 0; i < 8; i++) {
        /* one part, which emits with a radiance of 1 from the side of its own normal */
        const EtendueEmitter emitter = {light[i], 1, kinds[i], 0, {0, 0, 0}, 1};
        emitters[i] = emitter;
    }
    if (etendue_lights_create(8, emitters, set) != ETENDUE_STATUS_OK) return 0;
    const double n[3] = {N[0], N[1], N[2]}, w[3] = {sun.direction[0], sun.direction[1], sun.direction[2]};
    double c[3];
    for (int k = 0; k < 3; k++) c[k] = (double)sphere.center[k] - P[k];
    const double square = dot(c, c), r = disk.radius, h = 1.5, a = 0.5, sum = h * h + a * a + r * r;
    const float triangle_corners[3][3] = {{0, 1, 0}, {1, 1, 0}, {0, 1, 1}};
    const Prepared rows[8] = {
        {"sphere", ETENDUE_TECHNIQUE_SPHERE_BY_PROJECTED_SOLID_ANGLE, PI * sphere.radius * sphere.radius / square * dot(c, n) / sqrt(square), {{{0}}}},
        {"triangle", ETENDUE_TECHNIQUE_TRIANGLE_BY_PROJECTED_SOLID_ANGLE, lambert(triangle_corners, 3), {{{0}}}},
        {"parallelogram", ETENDUE_TECHNIQUE_PARALLELOGRAM_BY_SOLID_ANGLE, fan(parallelogram.corner, parallelogram.edge_s, NULL, parallelogram.edge_t), {{{0}}}},
        {"rectangle", ETENDUE_TECHNIQUE_RECTANGLE_BY_SOLID_ANGLE, fan(rectangle.corner, rectangle.edge_s, NULL, rectangle.edge_t), {{{0}}}},
        /* a disk parallel to the surface, at the height h and the distance a from the normal */
        {"disk", ETENDUE_TECHNIQUE_DISK_BY_SOLID_ANGLE, PI / 2 * (1 - (sum - 2 * r * r) / sqrt(sum * sum - 4 * r * r * a * a)), {{{0}}}},
        {"polygon", ETENDUE_TECHNIQUE_POLYGON_BY_SOLID_ANGLE, lambert(polygon.corners, 5), {{{0}}}},
        {"patch", ETENDUE_TECHNIQUE_PATCH_BY_AREA, fan(patch.corner, patch.edge_s, patch.diagonal, patch.edge_t), {{{0}}}},
        {"sun", ETENDUE_TECHNIQUE_SUN_BY_SOLID_ANGLE, PI * sun.one_minus_cos * (2.0 - sun.one_minus_cos) * dot(w, n), {{{0}}}},
    };
    for (int i = 0; i < 8; i++) {
        lights[i] = rows[i];
        if (etendue_prepare(lights[i].technique, light[i], P, N, &lights[i].sampler) != ETENDUE_STATUS_OK) return 0;
    }
    return 1;
}

/* What a sample adds to the irradiance: a renderer traces a shadow ray first, along `direction` up to `distance`. */
static double contribution(float x, float y, float z, float weight) {
    const float cosine = x * N[0] + y * N[1] + z * N[2];
    return cosine > 0 ? (double)(cosine * weight) : 0;
}

/* The irradiance from a set, whose samples choose a light by a third number. */
static double of_set(const EtendueLights *set) {
    const EtendueReceiver receiver = {{P[0], P[1], P[2]}, {N[0], N[1], N[2]}, ETENDUE_SIDE_SURFACE, NULL};
    EtendueLightsAt at;
    double sum = 0;
    if (etendue_lights_at(set, &receiver, &at) != ETENDUE_STATUS_OK) return NAN;
    for (uint32_t first = 0; first < SAMPLES; first += BATCH) {
        static float u[2][BATCH], choice[2][BATCH];
        float *const numbers[2] = {u[0], u[1]}, *const choices[2] = {choice[0], choice[1]};
        const EtendueCounters counters = {0, first, 0, NULL, NULL}, next = {0, first, 1, NULL, NULL};
        etendue_owen_sobol_pairs(1, &counters, BATCH, numbers);
        etendue_owen_sobol_pairs(1, &next, BATCH, choices);
        for (int k = 0; k < BATCH; k++) {
            const float three[3] = {choice[0][k], u[0][k], u[1][k]};
            EtendueLightsSample s;
            if (etendue_lights_sample(&at, three, &s) != ETENDUE_STATUS_OK) return NAN;
            /* here a renderer multiplies by the radiance of s.which, and traces a shadow ray up to s.reach */
            sum += contribution(s.direction[0], s.direction[1], s.direction[2], s.weight) / SAMPLES;
        }
    }
    return sum;
}

int main(void) {
    static Prepared lights[8];
    EtendueLights *set = NULL;
    if (!prepare(lights, &set)) return 1;
    double worst = 0, sum = 0;
    int right = 1;
    printf("%-14s %10s %12s %12s\n", "light", "irradiance", "error, one", "batch");
    for (int i = 0; i < 8; i++) {
        static float u[2][BATCH], x[BATCH], y[BATCH], z[BATCH], weight[BATCH];
        float *const numbers[2] = {u[0], u[1]};
        const float *const in[2] = {u[0], u[1]};
        EtendueSampleColumns wanted = {{x, y, z}, NULL, NULL, weight, {NULL, NULL, NULL}, {NULL, NULL}, NULL};
        double one = 0, many = 0;
        for (uint32_t first = 0; first < SAMPLES; first += BATCH) {
            const EtendueCounters counters = {0, first, 0, NULL, NULL};
            etendue_owen_sobol_pairs(1, &counters, BATCH, numbers);
            if (etendue_sample_batch(lights[i].technique, &lights[i].sampler, BATCH, in, &wanted) != ETENDUE_STATUS_OK) return 1;
            for (int k = 0; k < BATCH; k++) {
                const float pair[2] = {u[0][k], u[1][k]};
                EtendueLightSample s;
                if (etendue_sample(lights[i].technique, &lights[i].sampler, pair, &s) != ETENDUE_STATUS_OK) return 1;
                one += contribution(s.direction[0], s.direction[1], s.direction[2], s.weight) / SAMPLES;
                many += contribution(x[k], y[k], z[k], weight[k]) / SAMPLES;
            }
        }
        sum += lights[i].exact;
        const double exact = lights[i].exact, errors[2] = {fabs(one / exact - 1), fabs(many / exact - 1)};
        printf("%-14s %10.6f %12.1e %12.1e\n", lights[i].name, exact, errors[0], errors[1]);
        for (int k = 0; k < 2; k++) {
            worst = fmax(worst, errors[k]);
            right = right && errors[k] < MOST; /* which a number that is none is not */
        }
    }
    printf("the largest error is %.1e, and %.0e is allowed\n", worst, MOST);
    const double error = fabs(of_set(set) / sum - 1);
    printf("%-14s %10.6f %12.1e, and %.0e is allowed\n", "all as a set", sum, error, MOST_OF_SET);
    etendue_lights_free(set);
    return !(right && error < MOST_OF_SET);
}
