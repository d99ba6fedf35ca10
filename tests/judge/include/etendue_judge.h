/* Samplers of lights for `etendue-judge run ./libmine.so`.
 *
 * A library exports one function, `etendue_judge_samplers`, which returns an array of samplers. The judge calls everything from one thread,
 * in a process of its own: what aborts, hangs or writes nonsense there becomes a finding. Memory that the library returns stays its own.
 *
 * All coordinates are of one space, which may lie far from the origin, and all lengths have one unit. Every vector is three floats.
 */
#ifndef ETENDUE_JUDGE_H
#define ETENDUE_JUDGE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Changes with every change of this header. */
#define ETENDUE_JUDGE_ABI 2

/* What `sample` returns. */
#define ETENDUE_JUDGE_NONE 0   /* no sample for this u: it counts as a draw, and the estimate is 0 */
#define ETENDUE_JUDGE_SAMPLE 1 /* a direction in which the light is seen, with its pdf */
#define ETENDUE_JUDGE_HIDDEN 2 /* a point that the light itself hides, or a side that does not emit: a draw whose estimate is 0 */

typedef struct etendue_judge_sampler {
    /* ETENDUE_JUDGE_ABI. */
    uint32_t abi;
    /* sizeof(etendue_judge_sampler). */
    uint32_t size;
    /* A name for tables, unique in the library, such as "pbrt-v4 Triangle". */
    const char *name;
    /* The shape, which says what `light` points to:
     *   "sphere"         4 numbers: centre, radius
     *   "triangle"       9 numbers: the three corners
     *   "rectangle"      9 numbers: corner, edge, edge (perpendicular to one another, to rounding)
     *   "parallelogram"  9 numbers: corner, edge, edge
     *   "disk"           7 numbers: centre, unit normal, radius
     * A point is always on the side to which the normal of a disk, or the cross product of the edges (from the first corner), points. A
     * sphere is seen from inside, too. */
    const char *shape;
    /* What samples are distributed by, which says what their pdf has to be, per solid angle at p:
     *   "solid angle"            uniform over the directions of the light: 1/solid angle
     *   "projected solid angle"  proportional to the cosine to n, over what is above the horizon of n
     *   "area"                   uniform over the surface: distance^2/(area * cosine at the light)
     *   "other"                  anything else: only what has to hold of every density is judged
     * Null means "other". */
    const char *measure;
    /* In words, where the sampler claims to be right, such as "p outside the sphere"; null if everywhere. */
    const char *domain;
    /* Whether the sampler claims to be right here; null if everywhere. It is called before `prepare`. */
    int (*in_domain)(const float *light, const float p[3], const float n[3]);
    /* Prepares the light for the shading point p with the unit normal n. A null result means that the light cannot be sampled from p,
     * which is right where nothing of it can be seen. */
    void *(*prepare)(const float *light, const float p[3], const float n[3]);
    /* Draws a sample for u in [0, 1)^2: the unit vector from p towards the light, and the pdf per solid angle at p, whatever the sampler's
     * own measure is. Returns one of the three values above. */
    int (*sample)(void *state, const float u[2], float direction[3], float *pdf);
    /* The pdf per solid angle at p with which `sample` draws a unit direction; 0 in directions in which no light is seen. Null if the
     * sampler evaluates none: it is judged by what is left, among that the pdfs of its samples. */
    float (*pdf)(void *state, const float direction[3]);
    /* Optional: the u for which `sample` draws a direction; returns 0 if there is none. */
    int (*invert)(void *state, const float direction[3], float u[2]);
    /* Optional: the distance of the light in a direction; returns 0 if the light is not there. */
    int (*hit)(void *state, const float direction[3], float *distance);
    /* Optional: frees the state. */
    void (*release)(void *state);
    /* 1 if the sampler has no map from the square, as where it draws by rejection: u is only what its generator starts from. It must then
     * be the same for the same u. It has no inverse, and its parts of the square are not compared. */
    int is_generator;
} etendue_judge_sampler;

/* What a library exports: its samplers, and their number. */
const etendue_judge_sampler *etendue_judge_samplers(uint32_t *count);

#ifdef __cplusplus
}
#endif

#endif
