// Etendue: the functions of etendue.h with the types of each technique and each warp. MIT or Apache-2.0.
//
//     EtendueTriangle lamp = {{0, 2, 0}, {1, 0, 0}, {0, 0, 1}};
//     EtendueTriangleBySolidAngle sampler;
//     etendue_triangle_by_solid_angle_prepare(&lamp, p, &sampler);
//     etendue_triangle_by_solid_angle_sample(&sampler, u, &s);
//
// Each is etendue_prepare, etendue_sample, and so on, with the number of the technique in its name. Where a technique takes more than the point, it is
// the argument after the point: a unit normal `n` or an EtendueReflection, or columns of them. etendue.h includes this header.
#ifndef ETENDUE_TYPED_H
#define ETENDUE_TYPED_H

#include "etendue.h"

#define ETENDUE_COMMA_ ,

// What is done with a sampler.
#define ETENDUE_SAMPLER_(NAME, ID, SAMPLER)                                                                                              \
    static inline EtendueStatus etendue_##NAME##_sample(const Etendue##SAMPLER *sampler, const float *u, EtendueLightSample *out) {      \
        return etendue_sample(ETENDUE_TECHNIQUE_##ID, sampler, u, out);                                                                  \
    }                                                                                                                                    \
    static inline float etendue_##NAME##_pdf(const Etendue##SAMPLER *sampler, const float *w) {                                          \
        return etendue_pdf(ETENDUE_TECHNIQUE_##ID, sampler, w);                                                                          \
    }                                                                                                                                    \
    static inline EtendueStatus etendue_##NAME##_invert(const Etendue##SAMPLER *sampler, const float *w, float *u) {                     \
        return etendue_invert(ETENDUE_TECHNIQUE_##ID, sampler, w, u);                                                                    \
    }                                                                                                                                    \
    static inline EtendueStatus etendue_##NAME##_hit(const Etendue##SAMPLER *sampler, const float *w, EtendueLightSample *out) {         \
        return etendue_hit(ETENDUE_TECHNIQUE_##ID, sampler, w, out);                                                                     \
    }                                                                                                                                    \
    static inline EtendueStatus etendue_##NAME##_sample_batch(const Etendue##SAMPLER *sampler, size_t n, const float *const *u,          \
                                                              const EtendueSampleColumns *out) {                                         \
        return etendue_sample_batch(ETENDUE_TECHNIQUE_##ID, sampler, n, u, out);                                                         \
    }                                                                                                                                    \
    static inline EtendueStatus etendue_##NAME##_pdf_batch(const Etendue##SAMPLER *sampler, size_t n, const float *const *w,             \
                                                           float *out) {                                                                 \
        return etendue_pdf_batch(ETENDUE_TECHNIQUE_##ID, sampler, n, w, out);                                                            \
    }                                                                                                                                    \
    static inline EtendueStatus etendue_##NAME##_invert_batch(const Etendue##SAMPLER *sampler, size_t n, const float *const *w,          \
                                                              float *const *u) {                                                         \
        return etendue_invert_batch(ETENDUE_TECHNIQUE_##ID, sampler, n, w, u);                                                           \
    }                                                                                                                                    \
    static inline EtendueStatus etendue_##NAME##_hit_batch(const Etendue##SAMPLER *sampler, size_t n, const float *const *w,             \
                                                           const EtendueSampleColumns *out) {                                            \
        return etendue_hit_batch(ETENDUE_TECHNIQUE_##ID, sampler, n, w, out);                                                            \
    }
// And with its light. ONE and MANY are what it takes beside the point, each with a comma, and WITH and WITHS their names.
#define ETENDUE_LIGHT_(NAME, ID, LIGHT, SAMPLER, ONE, WITH, MANY, WITHS)                                                                 \
    static inline EtendueStatus etendue_##NAME##_prepare(const Etendue##LIGHT *light, const float *p, ONE Etendue##SAMPLER *sampler) {   \
        return etendue_prepare(ETENDUE_TECHNIQUE_##ID, light, p, WITH, sampler);                                                         \
    }                                                                                                                                    \
    ETENDUE_SAMPLER_(NAME, ID, SAMPLER)                                                                                                  \
    static inline EtendueStatus etendue_##NAME##_sample_each(const Etendue##LIGHT##Columns *lights, size_t n, const float *const *p,     \
                                                             MANY const float *const *u, const EtendueSampleColumns *out) {              \
        return etendue_sample_each(ETENDUE_TECHNIQUE_##ID, lights, n, p, WITHS, u, out);                                                 \
    }                                                                                                                                    \
    static inline EtendueStatus etendue_##NAME##_pdf_each(const Etendue##LIGHT##Columns *lights, size_t n, const float *const *p,        \
                                                          MANY const float *const *w, float *out) {                                      \
        return etendue_pdf_each(ETENDUE_TECHNIQUE_##ID, lights, n, p, WITHS, w, out);                                                    \
    }                                                                                                                                    \
    static inline EtendueStatus etendue_##NAME##_invert_each(const Etendue##LIGHT##Columns *lights, size_t n, const float *const *p,     \
                                                             MANY const float *const *w, float *const *u) {                              \
        return etendue_invert_each(ETENDUE_TECHNIQUE_##ID, lights, n, p, WITHS, w, u);                                                   \
    }                                                                                                                                    \
    static inline EtendueStatus etendue_##NAME##_hit_each(const Etendue##LIGHT##Columns *lights, size_t n, const float *const *p,        \
                                                          MANY const float *const *w, const EtendueSampleColumns *out) {                 \
        return etendue_hit_each(ETENDUE_TECHNIQUE_##ID, lights, n, p, WITHS, w, out);                                                    \
    }
#define ETENDUE_ANYWHERE_(NAME, ID, LIGHT, SAMPLER) ETENDUE_LIGHT_(NAME, ID, LIGHT, SAMPLER, , NULL, , NULL)
#define ETENDUE_ON_SURFACE_(NAME, ID, LIGHT, SAMPLER)                                                                                    \
    ETENDUE_LIGHT_(NAME, ID, LIGHT, SAMPLER, const float *n ETENDUE_COMMA_, n, const float *const *normals ETENDUE_COMMA_, normals)
#define ETENDUE_REFLECTED_(NAME, ID, LIGHT, SAMPLER)                                                                                     \
    ETENDUE_LIGHT_(NAME, ID, LIGHT, SAMPLER, const EtendueReflection *reflection ETENDUE_COMMA_, reflection,                             \
                   const EtendueReflectionColumns *reflections ETENDUE_COMMA_, reflections)

// A warp with the struct of its parameters. SELF is that with a comma, and PARAMETERS its name.
#define ETENDUE_WARP_OF_(NAME, ID, SELF, PARAMETERS)                                                                                     \
    static inline EtendueStatus etendue_##NAME##_sample(SELF const float *u, float *point) {                                             \
        return etendue_warp_sample(ETENDUE_WARP_##ID, PARAMETERS, u, point);                                                             \
    }                                                                                                                                    \
    static inline float etendue_##NAME##_pdf(SELF const float *point) { return etendue_warp_pdf(ETENDUE_WARP_##ID, PARAMETERS, point); } \
    static inline EtendueStatus etendue_##NAME##_invert(SELF const float *point, float *u) {                                             \
        return etendue_warp_invert(ETENDUE_WARP_##ID, PARAMETERS, point, u);                                                             \
    }                                                                                                                                    \
    static inline EtendueStatus etendue_##NAME##_sample_batch(SELF size_t n, const float *const *u, float *const *points) {              \
        return etendue_warp_sample_batch(ETENDUE_WARP_##ID, PARAMETERS, n, u, points);                                                   \
    }                                                                                                                                    \
    static inline EtendueStatus etendue_##NAME##_pdf_batch(SELF size_t n, const float *const *points, float *out) {                      \
        return etendue_warp_pdf_batch(ETENDUE_WARP_##ID, PARAMETERS, n, points, out);                                                    \
    }                                                                                                                                    \
    static inline EtendueStatus etendue_##NAME##_invert_batch(SELF size_t n, const float *const *points, float *const *u) {              \
        return etendue_warp_invert_batch(ETENDUE_WARP_##ID, PARAMETERS, n, points, u);                                                   \
    }
#define ETENDUE_WARP_(NAME, ID, STRUCT) ETENDUE_WARP_OF_(NAME, ID, const Etendue##STRUCT *warp ETENDUE_COMMA_, warp)
#define ETENDUE_FIXED_WARP_(NAME, ID) ETENDUE_WARP_OF_(NAME, ID, , NULL)

// from the list of techniques: WRITE=1 cargo test -p etendue-tests bindings
ETENDUE_ANYWHERE_(sphere_by_area, SPHERE_BY_AREA, Sphere, SphereByArea)
ETENDUE_ANYWHERE_(sphere_by_solid_angle, SPHERE_BY_SOLID_ANGLE, Sphere, SphereBySolidAngle)
ETENDUE_ON_SURFACE_(sphere_by_projected_solid_angle, SPHERE_BY_PROJECTED_SOLID_ANGLE, Sphere, SphereByProjectedSolidAngle)
ETENDUE_REFLECTED_(sphere_by_reflection, SPHERE_BY_REFLECTION, Sphere, SphereByReflection)
ETENDUE_ANYWHERE_(triangle_by_area, TRIANGLE_BY_AREA, Triangle, TriangleByArea)
ETENDUE_ANYWHERE_(triangle_by_solid_angle, TRIANGLE_BY_SOLID_ANGLE, Triangle, TriangleBySolidAngle)
ETENDUE_ON_SURFACE_(triangle_by_projected_solid_angle, TRIANGLE_BY_PROJECTED_SOLID_ANGLE, Triangle, TriangleByProjectedSolidAngle)
ETENDUE_REFLECTED_(triangle_by_reflection, TRIANGLE_BY_REFLECTION, Triangle, TriangleByReflection)
ETENDUE_ANYWHERE_(parallelogram_by_area, PARALLELOGRAM_BY_AREA, Parallelogram, ParallelogramByArea)
ETENDUE_ANYWHERE_(parallelogram_by_solid_angle, PARALLELOGRAM_BY_SOLID_ANGLE, Parallelogram, ParallelogramBySolidAngle)
ETENDUE_ON_SURFACE_(parallelogram_by_projected_solid_angle, PARALLELOGRAM_BY_PROJECTED_SOLID_ANGLE, Parallelogram, ParallelogramByProjectedSolidAngle)
ETENDUE_REFLECTED_(parallelogram_by_reflection, PARALLELOGRAM_BY_REFLECTION, Parallelogram, ParallelogramByReflection)
ETENDUE_ANYWHERE_(rectangle_by_area, RECTANGLE_BY_AREA, Rectangle, ParallelogramByArea)
ETENDUE_ANYWHERE_(rectangle_by_solid_angle, RECTANGLE_BY_SOLID_ANGLE, Rectangle, RectangleBySolidAngle)
ETENDUE_ON_SURFACE_(rectangle_by_projected_solid_angle, RECTANGLE_BY_PROJECTED_SOLID_ANGLE, Rectangle, ParallelogramByProjectedSolidAngle)
ETENDUE_REFLECTED_(rectangle_by_reflection, RECTANGLE_BY_REFLECTION, Rectangle, ParallelogramByReflection)
ETENDUE_ANYWHERE_(disk_by_area, DISK_BY_AREA, Disk, DiskByArea)
ETENDUE_ANYWHERE_(disk_by_solid_angle, DISK_BY_SOLID_ANGLE, Disk, DiskBySolidAngle)
ETENDUE_ANYWHERE_(polygon_by_area, POLYGON_BY_AREA, Polygon, PolygonByArea)
ETENDUE_ANYWHERE_(polygon_by_solid_angle, POLYGON_BY_SOLID_ANGLE, Polygon, PolygonBySolidAngle)
ETENDUE_ON_SURFACE_(polygon_by_projected_solid_angle, POLYGON_BY_PROJECTED_SOLID_ANGLE, Polygon, PolygonByProjectedSolidAngle)
ETENDUE_REFLECTED_(polygon_by_reflection, POLYGON_BY_REFLECTION, Polygon, PolygonByReflection)
ETENDUE_ANYWHERE_(patch_by_area, PATCH_BY_AREA, BilinearPatch, PatchByArea)
ETENDUE_ANYWHERE_(line_by_length, LINE_BY_LENGTH, Line, LineByLength)
ETENDUE_ANYWHERE_(line_by_angle, LINE_BY_ANGLE, Line, LineByAngle)
ETENDUE_ON_SURFACE_(line_by_projected_solid_angle, LINE_BY_PROJECTED_SOLID_ANGLE, Line, LineByProjectedSolidAngle)
ETENDUE_ANYWHERE_(sun_by_solid_angle, SUN_BY_SOLID_ANGLE, Sun, SunBySolidAngle)
ETENDUE_ANYWHERE_(point_light_by_delta, POINT_LIGHT_BY_DELTA, PointLight, PointLightByDelta)
ETENDUE_ANYWHERE_(spot_light_by_delta, SPOT_LIGHT_BY_DELTA, SpotLight, SpotLightByDelta)
ETENDUE_ANYWHERE_(directional_light_by_delta, DIRECTIONAL_LIGHT_BY_DELTA, DirectionalLight, DirectionalLightByDelta)
// end of what is from the list
ETENDUE_ANYWHERE_(picture_by_area, PICTURE_BY_AREA, PicturedParallelogram, PictureByArea)
ETENDUE_ANYWHERE_(picture_by_solid_angle, PICTURE_BY_SOLID_ANGLE, PicturedParallelogram, PictureBySolidAngle)
ETENDUE_ON_SURFACE_(picture_by_projected_solid_angle, PICTURE_BY_PROJECTED_SOLID_ANGLE, PicturedParallelogram, PictureByProjectedSolidAngle)
ETENDUE_ANYWHERE_(picture_on_sphere_by_visible_area, PICTURE_ON_SPHERE_BY_VISIBLE_AREA, PicturedSphere, PictureOnSphereByVisibleArea)
// the environment has no columns: it is the same for all points
typedef EtenduePortalEnvironment EtenduePortalEnvironmentColumns;
ETENDUE_ANYWHERE_(portals_by_radiance, PORTALS_BY_RADIANCE, PortalEnvironment, PortalsByRadiance)
ETENDUE_SAMPLER_(image_environment, IMAGE_BY_RADIANCE, ImageEnvironment)

ETENDUE_FIXED_WARP_(concentric_disk, CONCENTRIC_DISK)
ETENDUE_FIXED_WARP_(uniform_hemisphere, UNIFORM_HEMISPHERE)
ETENDUE_FIXED_WARP_(uniform_sphere, UNIFORM_SPHERE)
ETENDUE_FIXED_WARP_(cosine_hemisphere, COSINE_HEMISPHERE)
ETENDUE_FIXED_WARP_(octahedral, OCTAHEDRAL)
ETENDUE_FIXED_WARP_(area_triangle, AREA_TRIANGLE)
ETENDUE_FIXED_WARP_(low_distortion_triangle, LOW_DISTORTION_TRIANGLE)
ETENDUE_WARP_(cone, CONE, Cone)
ETENDUE_WARP_(bilinear, BILINEAR, Bilinear)
ETENDUE_WARP_(ggx_visible_normals, GGX_VISIBLE_NORMALS, GgxVisibleNormals)
ETENDUE_WARP_(reflection, REFLECTION, Reflection)
ETENDUE_WARP_(patch_surface, PATCH_SURFACE, PatchSurface)

#undef ETENDUE_COMMA_
#undef ETENDUE_SAMPLER_
#undef ETENDUE_LIGHT_
#undef ETENDUE_ANYWHERE_
#undef ETENDUE_ON_SURFACE_
#undef ETENDUE_REFLECTED_
#undef ETENDUE_WARP_OF_
#undef ETENDUE_WARP_
#undef ETENDUE_FIXED_WARP_

#endif // ETENDUE_TYPED_H
