// Tests of etendue.hpp: its values are those of the C functions, its batches check lengths, and the functions of pbrt's names close.
#include "etendue.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <vector>

using namespace etendue;

static int checks = 0, failures = 0;
#define CHECK(condition)                                                               \
    do {                                                                               \
        checks++;                                                                      \
        if (!(condition) && failures++ < 20)                                           \
            std::fprintf(stderr, "test.cpp:%d: not so: %s\n", __LINE__, #condition);   \
    } while (0)

// A host's own types, of the forms that renderers have.
struct Point2 {
    float x, y;
};
struct Point3 {
    float x, y, z;
};
struct Direction {
    Direction(float a, float b, float c) : x(a), y(b), z(c) {}
    double x, y, z;
};

static bool near(Vec2 a, Vec2 b, float tolerance = 2e-5f) { return std::fabs(a.x - b.x) < tolerance && std::fabs(a.y - b.y) < tolerance; }
static bool near(Vec3 a, Vec3 b, float tolerance = 2e-5f) { return near(Vec2(a.x, a.y), Vec2(b.x, b.y), tolerance) && std::fabs(a.z - b.z) < tolerance; }

static const Vec3 p = {0.1f, 0, -0.2f}, n = {0, 1, 0};
static const Vec2 u = {0.3f, 0.6f};

// One prepared light: singles agree with each other, and batches with singles.
template <class Sampler>
static void test(const Sampler& sampler, bool is_never_hit = false) {
    const LightSample s = sampler.sample(u);
    CHECK(s.pdf > 0);
    const Vec3 w = s.direction;
    CHECK(is_never_hit || (sampler.pdf(w) > 0 && sampler.hit(w).pdf == sampler.pdf(w)));
    CHECK(near(Vec3(sampler.sample(sampler.invert(w)).direction), w));

    std::vector<float> x(37), y(37), a(37), b(37), c(37), pdf(37), back(37), front(37), other(36);
    CHECK(OwenSobol{7}.pairs({}, {x, y}) == ETENDUE_STATUS_OK);
    SampleColumns out;
    out.direction = {a, b, c};
    out.pdf = pdf;
    CHECK(sampler.sample({x, y}, out) == ETENDUE_STATUS_OK);
    for (size_t i = 0; i < x.size(); i++) {
        const LightSample one = sampler.sample({x[i], y[i]});
        CHECK(one.direction[0] == a[i] && one.direction[1] == b[i] && one.direction[2] == c[i] && one.pdf == pdf[i]);
    }
    CHECK(sampler.pdf({a, b, c}, pdf) == ETENDUE_STATUS_OK && sampler.invert({a, b, c}, {back, front}) == ETENDUE_STATUS_OK);
    CHECK(sampler.invert({a, b, c}, {back, Span<float>()}) == ETENDUE_STATUS_OK);
    SampleColumns hits;
    hits.distance = front;
    CHECK(sampler.hit({a, b, c}, hits) == ETENDUE_STATUS_OK);
    for (size_t i = 0; i < x.size(); i++) {
        const Vec3 d = {a[i], b[i], c[i]};
        CHECK(sampler.pdf(d) == pdf[i] && sampler.invert(d).x == back[i] && sampler.hit(d).distance == front[i]);
    }
    // one column too short
    CHECK(sampler.sample({x, other}, out) == ETENDUE_STATUS_COUNT && sampler.pdf({a, b, other}, pdf) == ETENDUE_STATUS_COUNT);
    CHECK(sampler.pdf({a, b, c}, other) == ETENDUE_STATUS_COUNT && sampler.invert({a, other, c}, {back, front}) == ETENDUE_STATUS_COUNT);
    CHECK(sampler.invert({a, b, c}, {back, other}) == ETENDUE_STATUS_COUNT && sampler.hit({other, b, c}, hits) == ETENDUE_STATUS_COUNT);
    hits.distance = other;
    CHECK(sampler.hit({a, b, c}, hits) == ETENDUE_STATUS_COUNT);
    std::vector<uint8_t> bytes(38);
    out.emits = bytes;
    CHECK(sampler.sample({x, y}, out) == ETENDUE_STATUS_COUNT);
    CHECK(sampler.pdf(In<3>(), Span<float>()) == ETENDUE_STATUS_OK);
}

template <class W>
static void test_warp(const W& warp) {
    const auto point = warp.sample(u);
    CHECK(warp.pdf(point) > 0);
    CHECK(near(Vec2(warp.invert(point)), u));
}

static void test_lights() {
    const Sphere sphere({0.3f, 2, 0.1f}, 0.5f);
    test(sphere.by_area(p)), test(sphere.by_solid_angle(p)), test(sphere.by_projected_solid_angle(p, n));
    const Triangle triangle({-0.5f, 2, -0.3f}, {1.2f, 0.1f, 0.2f}, {0.1f, 0.2f, 1.1f});
    test(triangle.by_area(p)), test(triangle.by_solid_angle(p)), test(triangle.by_projected_solid_angle(p, n));
    const Parallelogram parallelogram({-0.5f, 2, -0.3f}, {1.2f, 0.1f, 0.2f}, {0.1f, 0.2f, 1.1f});
    test(parallelogram.by_area(p)), test(parallelogram.by_solid_angle(p)), test(parallelogram.by_projected_solid_angle(p, n));
    const Rectangle rectangle({-0.5f, 2, -0.3f}, {1.2f, 0, 0}, {0, 0.3f, 0.9f});
    test(rectangle.by_solid_angle(p));
    const Disk disk({0.3f, 2, 0.1f}, {0, -1, 0}, 0.5f);
    test(disk.by_area(p)), test(disk.by_solid_angle(p));
    test(BilinearPatch({-0.5f, 2, -0.3f}, {1.2f, 0.1f, 0.2f}, {0.1f, 0.2f, 1.1f}, {1.3f, 0.6f, 1.2f}).by_area(p));
    const Polygon polygon({{-0.5f, 2, -0.3f}, {0.6f, 2, -0.4f}, {0.9f, 2, 0.4f}, {0.2f, 2, 0.9f}, {-0.6f, 2, 0.5f}});
    test(polygon.by_area(p)), test(polygon.by_solid_angle(p)), test(polygon.by_projected_solid_angle(p, n));
    const Reflection lobe(0.3f, n, {0.6f, 0.8f, 0});
    test(triangle.by_reflection(p, lobe)), test(parallelogram.by_reflection(p, lobe)), test(rectangle.by_reflection(p, lobe));
    test(polygon.by_reflection(p, lobe));
    CHECK(Polygon(nullptr, 0).by_solid_angle(p).sample(u).pdf == 0);
    const Line line({-1, 2, 0.3f}, {2, 0.1f, 0.2f});
    test(line.by_length(p), true), test(line.by_angle(p), true), test(line.by_projected_solid_angle(p, n), true);
    test(Sun({0.36f, 0.8f, 0.48f}, 1e-3f).by_solid_angle());
    // delta lights: no direction hits them
    test(PointLight({0.3f, 2, 0.1f}).by_delta(p), true);
    test(SpotLight({0.3f, 2, 0.1f}, {0, -1, 0}, 0.1f, 0.5f).by_delta(p), true);
    test(DirectionalLight({0.36f, 0.8f, 0.48f}).by_delta(), true);

    // the same light for each point, in columns
    std::vector<float> zeros(5), ones(5, 1), twos(5, 2), x(5), y(5), pdf(5), shorter(4), p0(5, 0.1f), p2(5, -0.2f);
    CHECK(Independent{3}.pairs({}, {x, y}) == ETENDUE_STATUS_OK);
    const TriangleColumns lights({zeros, twos, zeros}, {ones, zeros, zeros}, {zeros, zeros, ones});
    SampleColumns out;
    out.pdf = pdf;
    CHECK(TriangleBySolidAngle::sample_each(lights, {p0, zeros, p2}, {x, y}, out) == ETENDUE_STATUS_OK);
    const auto own = Triangle({0, 2, 0}, {1, 0, 0}, {0, 0, 1}).by_solid_angle(p);
    for (size_t i = 0; i < 5; i++) CHECK(pdf[i] == own.sample({x[i], y[i]}).pdf);
    CHECK(TriangleBySolidAngle::pdf_each(lights, {p0, zeros, p2}, {zeros, ones, zeros}, pdf) == ETENDUE_STATUS_OK);
    for (size_t i = 0; i < 5; i++) CHECK(pdf[i] == own.pdf({0, 1, 0}));
    std::vector<float> back_x(5), back_y(5);
    CHECK(TriangleBySolidAngle::invert_each(lights, {p0, zeros, p2}, {zeros, ones, zeros}, {back_x, back_y}) == ETENDUE_STATUS_OK);
    CHECK(back_x[3] == own.invert({0, 1, 0}).x && back_y[3] == own.invert({0, 1, 0}).y);
    CHECK(TriangleBySolidAngle::hit_each(lights, {p0, zeros, p2}, {zeros, ones, zeros}, out) == ETENDUE_STATUS_OK);
    CHECK(pdf[2] == own.hit({0, 1, 0}).pdf);
    CHECK(TriangleBySolidAngle::pdf_each(lights, {p0, zeros, p2}, {zeros, ones, zeros}, shorter) == ETENDUE_STATUS_COUNT);
    CHECK(TriangleByProjectedSolidAngle::pdf_each(lights, {p0, zeros, p2}, {zeros, shorter, zeros}, {zeros, ones, zeros}, pdf) == ETENDUE_STATUS_COUNT);
    CHECK(TriangleByProjectedSolidAngle::sample_each(lights, {p0, zeros, p2}, {zeros, ones, zeros}, {x, y}, out) == ETENDUE_STATUS_OK);
    CHECK(pdf[4] == Triangle({0, 2, 0}, {1, 0, 0}, {0, 0, 1}).by_projected_solid_angle(p, n).sample({x[4], y[4]}).pdf);
    CHECK(TriangleByProjectedSolidAngle::sample_each(lights, {p0, zeros, p2}, {zeros, shorter, zeros}, {x, y}, out) == ETENDUE_STATUS_COUNT);
    CHECK(TriangleBySolidAngle::sample_each(lights, {p0, shorter, p2}, {x, y}, out) == ETENDUE_STATUS_COUNT);
    const TriangleColumns uneven({zeros, twos, zeros}, {ones, zeros, zeros}, {zeros, zeros, shorter});
    CHECK(TriangleBySolidAngle::sample_each(uneven, {p0, zeros, p2}, {x, y}, out) == ETENDUE_STATUS_COUNT);
    // the same reflection for each
    std::vector<float> rough(5, 0.3f), side(5, 0.6f), height(5, 0.8f), memory(5 * ReflectionColumns::COLUMNS);
    ReflectionColumns reflections;
    CHECK(reflections.prepare(rough, {zeros, ones, zeros}, {side, height, zeros}, Span<float>(memory.data(), 5)) == ETENDUE_STATUS_COUNT);
    CHECK(reflections.prepare(rough, {zeros, shorter, zeros}, {side, height, zeros}, memory) == ETENDUE_STATUS_COUNT);
    CHECK(TriangleByReflection::sample_each(lights, {p0, zeros, p2}, reflections, {x, y}, out) == ETENDUE_STATUS_COUNT);
    CHECK(reflections.prepare(rough, {zeros, ones, zeros}, {side, height, zeros}, memory) == ETENDUE_STATUS_OK);
    CHECK(reflections.albedo()[3] == lobe.albedo && reflections.schlick()[4] == lobe.schlick);
    CHECK(TriangleByReflection::sample_each(lights, {p0, zeros, p2}, reflections, {x, y}, out) == ETENDUE_STATUS_OK);
    const auto reflected = Triangle({0, 2, 0}, {1, 0, 0}, {0, 0, 1}).by_reflection(p, lobe);
    for (size_t i = 0; i < 5; i++) CHECK(pdf[i] > 0 && pdf[i] == reflected.sample({x[i], y[i]}).pdf);
    CHECK(TriangleByReflection::pdf_each(lights, {p0, zeros, p2}, reflections, {zeros, ones, zeros}, pdf) == ETENDUE_STATUS_OK);
    CHECK(pdf[2] == reflected.pdf({0, 1, 0}) && lobe.sphere({-6, 8, 0}, 2) > lobe.sphere({6, 8, 0}, 2));
    CHECK(lobe.sphere({p0, ones, p2}, ones, pdf) == ETENDUE_STATUS_OK && pdf[1] == lobe.sphere({0.1f, 1, -0.2f}, 1));
    CHECK(lobe.sphere({p0, ones, p2}, ones, shorter) == ETENDUE_STATUS_COUNT);
    const SphereColumns spheres({zeros, twos, zeros}, ones);
    CHECK(SphereBySolidAngle::sample_each(spheres, {p0, zeros, p2}, {x, y}, out) == ETENDUE_STATUS_OK);
    CHECK(pdf[1] == Sphere({0, 2, 0}, 1).by_solid_angle(p).sample({x[1], y[1]}).pdf);
}

static void test_warps() {
    test_warp(ConcentricDisk()), test_warp(UniformHemisphere()), test_warp(UniformSphere()), test_warp(CosineHemisphere());
    test_warp(Octahedral()), test_warp(AreaTriangle()), test_warp(LowDistortionTriangle()), test_warp(Cone(0.3f));
    test_warp(Bilinear(1, 2, 0.5f, 3)), test_warp(GgxVisibleNormals(0.3f, 0.5f, {0.48f, 0.36f, 0.8f}));
    test_warp(Reflection(0.3f, {0.6f, 0, 0.8f}, {0.48f, 0.36f, 0.8f}));
    test_warp(PatchSurface({-0.5f, 2, -0.3f}, {1.2f, 0.1f, 0.2f}, {0.1f, 0.2f, 1.1f}, {1.3f, 0.6f, 1.2f}));

    std::array<float, 20> x, y, a, b, c, pdf;
    CHECK(OwenSobol{1}.pairs({}, {x, y}) == ETENDUE_STATUS_OK);
    CHECK(CosineHemisphere().sample({x, y}, {a, b, c}) == ETENDUE_STATUS_OK && CosineHemisphere().pdf({a, b, c}, pdf) == ETENDUE_STATUS_OK);
    CHECK(Vec3(CosineHemisphere().sample({x[7], y[7]})).y == b[7] && std::fabs(pdf[7] - c[7] * 0.318309886f) < 1e-6f);
    CHECK(CosineHemisphere().invert({a, b, c}, {a, b}) == ETENDUE_STATUS_OK && std::fabs(a[7] - x[7]) < 1e-5f);
    CHECK(CosineHemisphere().sample({x, y}, {a, b, Span<float>(c.data(), 19)}) == ETENDUE_STATUS_COUNT);
}

static void test_sequences() {
    float x[9], y[9];
    const auto test = [&](const auto& sequence) {
        CHECK(sequence.pairs({5, 3, 1}, {x, y}) == ETENDUE_STATUS_OK);
        for (uint32_t i = 0; i < 9; i++) CHECK(x[i] == sequence.pair(5, 3 + i, 1).x && y[i] == sequence.pair(5, 3 + i, 1).y);
    };
    test(Independent{1}), test(OwenSobol{1}), test(JointSobol{1}), test(Stratified{1, 16});
    const uint32_t samples[9] = {8, 7, 6, 5, 4, 3, 2, 1, 0};
    CHECK(OwenSobol{1}.pairs({5, 0, 1, {}, samples}, {x, y}) == ETENDUE_STATUS_OK && x[2] == OwenSobol{1}.pair(5, 6, 1).x);
    CHECK(OwenSobol{1}.pairs({5, 0, 1, {}, Span<const uint32_t>(samples, 8)}, {x, y}) == ETENDUE_STATUS_COUNT);
    CHECK(OwenSobol{1}.pairs({}, {x, Span<float>(y, 8)}) == ETENDUE_STATUS_COUNT);
}

static void test_tree() {
    std::vector<LightBound> lights(100);
    for (size_t i = 0; i < lights.size(); i++) lights[i] = {{float(i % 10), 3, float(i / 10)}, 0.1f, {0, -1, 0}, 0, 0, 1};
    std::vector<LightTreeNode> nodes(LightTree::nodes(lights.size()));
    std::vector<uint32_t> places(lights.size());
    LightTree tree;
    CHECK(tree.choose(p, n, 0.5f).pmf == 0 && tree.pmf(p, n, 0) == 0); // not built
    CHECK(tree.build(lights, nodes, Span<uint32_t>(places.data(), 99)) == ETENDUE_STATUS_COUNT);
    CHECK(tree.build(lights, nodes, places) == ETENDUE_STATUS_OK);
    std::vector<float> x(13), y(13), z(13), up(13, 1), flat(13), r(13), pmf(13), rest(13);
    std::vector<uint32_t> light(13);
    CHECK(Independent{1}.pairs({}, {r, x}) == ETENDUE_STATUS_OK);
    CHECK(tree.choose({x, y, z}, {flat, up, flat}, r, {light, pmf, rest}) == ETENDUE_STATUS_OK);
    for (size_t i = 0; i < 13; i++) {
        const Choice one = tree.choose({x[i], 0, 0}, n, r[i]);
        CHECK(one.light == light[i] && one.pmf == pmf[i] && one.u == rest[i] && tree.pmf({x[i], 0, 0}, n, one.light) == one.pmf);
    }
    CHECK(tree.pmf({x, y, z}, {flat, up, flat}, light, rest) == ETENDUE_STATUS_OK && rest == pmf);
    CHECK(tree.choose({x, y, z}, {flat, up, flat}, r, {{}, Span<float>(pmf.data(), 5), {}}) == ETENDUE_STATUS_COUNT);
    CHECK(tree.pmf({x, y, z}, {flat, up, flat}, light, Span<float>(pmf.data(), 5)) == ETENDUE_STATUS_COUNT);
}

static void test_sets() {
    const Sphere ball({0, 2, 0}, 0.5f);
    const PointLight bulb(Vec3(1, 2, 0));
    const Triangle mesh[] = {{{-1, 3, 0}, {1, 0, 0}, {0, 0, 1}}, {{-2, 3, 0}, {1, 0, 0}, {0, 0, 1}}};
    const Emitter lights[] = {{ball, 3}, {bulb, 1}, Emitter(Span<const Triangle>(mesh), 2).towards({0, -1, 0}), Emitter(0.1f)};
    Lights set;
    CHECK(set.at(p, n).sample(0.3f, 0.6f, 0.2f).pdf == 0 && set.build(lights) == ETENDUE_STATUS_OK);
    Lights moved = std::move(set);
    set = std::move(moved);
    LightsAt at = set.at(p, n), around = set.at(p, ETENDUE_SIDE_NONE);
    uint32_t found = 0;
    for (uint32_t i = 0; i < 64; i++) {
        const Vec2 a = OwenSobol{1}.pair(0, i, 0), b = OwenSobol{1}.pair(0, i, 1);
        for (LightsAt* prepared : {&at, &around}) {
            const LightsSample s = prepared->sample(b.x, a.x, a.y);
            CHECK(s.pdf > 0 && (s.delta ? s.which.light == 1 : prepared->pdf(s.which, s.direction) == s.pdf));
            found |= 1u << s.which.light;
        }
    }
    CHECK(found == 15);
    const Which on = {0, 0};
    CHECK(set.at(p, n, &on).pdf(on, Vec3(0, 1, 0)) == 0);
    const Emitter wrong[] = {{ball, 1}, {ImageEnvironment(), 1}};
    CHECK(set.build(wrong) != ETENDUE_STATUS_OK && set.at(p, n).sample(0.3f, 0.6f, 0.2f).pdf > 0);
}
static_assert(!std::is_copy_constructible_v<Lights> && std::is_nothrow_move_assignable_v<Lights>);

static void test_image() {
    const std::vector<float> weights = {1, 2, 0, 4, 5, 6};
    std::vector<float> table(ImageEnvironment::table(3, 2));
    ImageEnvironment sky;
    CHECK(sky.sample({0.3f, 0.6f}).pdf == 0 && sky.pdf(n) == 0 && sky.hit(n).weight == 0); // not built
    CHECK(sky.build(weights, 4, ETENDUE_ENVIRONMENT_MAP_EQUIRECTANGULAR, table) == ETENDUE_STATUS_COUNT);
    CHECK(sky.build(weights, 0, ETENDUE_ENVIRONMENT_MAP_EQUIRECTANGULAR, table) == ETENDUE_STATUS_COUNT);
    CHECK(sky.build(weights, 3, ETENDUE_ENVIRONMENT_MAP_EQUIRECTANGULAR, Span<float>(table.data(), 7)) == ETENDUE_STATUS_COUNT);
    CHECK(sky.build(weights, 3, ETENDUE_ENVIRONMENT_MAP_EQUIRECTANGULAR, table) == ETENDUE_STATUS_OK);
    std::array<float, 20> x, y, a, b, c, pdf;
    CHECK(OwenSobol{1}.pairs({}, {x, y}) == ETENDUE_STATUS_OK);
    CHECK(sky.sample({x, y}, {{a, b, c}, {}, pdf, {}, {}, {}, {}}) == ETENDUE_STATUS_OK);
    for (size_t i = 0; i < 20; i++) {
        const LightSample one = sky.sample({x[i], y[i]});
        CHECK(one.direction[0] == a[i] && one.direction[2] == c[i] && one.pdf == pdf[i]);
        CHECK(sky.pdf(one.direction) == one.pdf && sky.hit(one.direction).uv[0] == one.uv[0]);
        // of the lower row in proportion to 4, 5 and 6, of the upper one to 1, 2 and 0, by solid angle
        const float density = weights[(c[i] < 0 ? 3 : 0) + size_t(one.uv[0] * 3)] / 37.6991118f;
        CHECK(std::fabs(one.pdf / density - 1) < 1e-5f);
        CHECK(std::fabs(Vec2(sky.invert(one.direction)).x - x[i]) < 1e-4f);
    }
    CHECK(sky.pdf({a, b, c}, x) == ETENDUE_STATUS_OK && x == pdf);
    CHECK(sky.pdf({a, b, c}, Span<float>(x.data(), 5)) == ETENDUE_STATUS_COUNT);
}

static void test_pictures() {
    const std::vector<float> weights = {1, 2, 0, 4, 5, 6};
    std::vector<float> table(Picture::table(3, 2)), other(Picture::interpolated_table(3, 2));
    const Rectangle rectangle({-0.5f, 2, -0.5f}, {0, 0, 1}, {1, 0, 0});
    Picture picture, smooth;
    const auto unbuilt = picture.on(rectangle).by_area(p);
    CHECK(unbuilt.sample(u).pdf == 0 && unbuilt.pdf(n) == 0 && unbuilt.hit(n).weight == 0); // not built
    CHECK(picture.build(weights, 4, ETENDUE_PICTURE_REGION_SQUARE, table) == ETENDUE_STATUS_COUNT);
    CHECK(picture.build(weights, 0, ETENDUE_PICTURE_REGION_SQUARE, table) == ETENDUE_STATUS_COUNT);
    CHECK(picture.build(weights, 3, ETENDUE_PICTURE_REGION_SQUARE, Span<float>(table.data(), 1)) == ETENDUE_STATUS_COUNT);
    CHECK(smooth.interpolate(weights, 3, Span<float>(other.data(), 1)) == ETENDUE_STATUS_COUNT);
    CHECK(picture.build(weights, 3, ETENDUE_PICTURE_REGION_SQUARE, table) == ETENDUE_STATUS_OK);
    CHECK(smooth.interpolate(weights, 3, other) == ETENDUE_STATUS_OK);
    test(picture.on(rectangle).by_area(p));
    test(picture.on(Parallelogram({-0.5f, 2, -0.5f}, {0, 0.1f, 1}, {1, 0, 0})).by_solid_angle(p));
    test(smooth.on(rectangle).by_projected_solid_angle(p, n));
    test(smooth.on(Sphere({0, 2, 0}, 0.5f)).by_visible_area(p));
    // a texel without radiance is not drawn; seen from behind, the light has no weight
    const LightSample s = picture.on(rectangle).by_solid_angle(p).sample(u);
    const size_t texel = size_t(s.uv[0] * 3) + 3 * size_t(s.uv[1] * 2);
    CHECK(weights[texel] > 0 && s.pdf > 0 && s.weight == 0);

    // triangles and disks by their surface coordinates
    CHECK(picture.build(weights, 3, ETENDUE_PICTURE_REGION_TRIANGLE, table) == ETENDUE_STATUS_OK);
    const Triangle triangle({-0.5f, 2, -0.3f}, {0, 0, 1}, {1, 0, 0});
    int on_it = 0;
    for (int i = 0; i < 64; i++) {
        const LightSample one = picture.on(triangle).by_solid_angle(p).sample(OwenSobol{3}.pair(0, i, 0));
        CHECK(one.pdf == 0 || one.uv[0] + one.uv[1] < 1);
        on_it += one.pdf > 0;
    }
    CHECK(on_it > 20);
    CHECK(picture.on(Disk({0, 2, 0}, {0, -1, 0}, 0.5f)).light.edge_s[1] == 0);

    // columns of lights with one picture
    std::vector<float> x(20), y(20), zero(20, 0.0f), one(20, 1.0f), two(20, 2.0f), half(20, -0.5f), pdf(20), up(20, 1.0f);
    CHECK(OwenSobol{1}.pairs({}, {x, y}) == ETENDUE_STATUS_OK);
    CHECK(picture.build(weights, 3, ETENDUE_PICTURE_REGION_SQUARE, table) == ETENDUE_STATUS_OK);
    const PicturedParallelogramColumns lights(picture.c(), {{half, two, half}, {zero, zero, one}, {one, zero, zero}});
    SampleColumns out;
    out.pdf = pdf;
    CHECK(PictureBySolidAngle::sample_each(lights, {zero, zero, zero}, {x, y}, out) == ETENDUE_STATUS_OK);
    for (size_t i = 0; i < 20; i++) CHECK(pdf[i] == picture.on(rectangle).by_solid_angle({0, 0, 0}).sample({x[i], y[i]}).pdf);
    CHECK(PictureByProjectedSolidAngle::sample_each(lights, {zero, zero, zero}, {zero, up, zero}, {x, y}, out) == ETENDUE_STATUS_OK);
    x.pop_back();
    CHECK(PictureBySolidAngle::sample_each(lights, {zero, zero, zero}, {x, y}, out) == ETENDUE_STATUS_COUNT);
}

static void test_skies() {
    const std::vector<float> weights = {1, 2, 0, 4, 5, 6};
    const Portal portals[] = {{{-0.5f, 1, -0.5f}, {0, 0.25f, 1}, {1, 0, 0}}, {{0.25f, 1.5f, 0}, {0, 0.25f, 1}, {1, 0, 0}}};
    PortalTable tables[2];
    std::vector<uint64_t> sums(PortalTable::table(3, 2));
    CHECK(tables[0].build(weights, 4, sums) == ETENDUE_STATUS_COUNT && tables[0].build(weights, 3, sums) == ETENDUE_STATUS_OK);
    tables[1] = tables[0];
    const PortalEnvironment sky(portals, tables);
    test(sky.by_radiance(p));
    CHECK(PortalEnvironment(portals, Span<const PortalTable>(tables, 1)).by_radiance(p).sample(u).pdf == 0);
    float solid_angle = 0;
    CHECK(near(portals[0].direction({0.5f, 0.5f}, &solid_angle), Vec3(0, 0.9701425f, -0.2425356f)) && std::fabs(solid_angle - 9.869604f) < 1e-4f);
    const std::array<float, 2> px = {p.x, p.x}, py = {p.y, 9}, pz = {p.z, p.z}, zero = {0, 0}, one = {1, 1};
    std::array<uint8_t, 2> sees;
    CHECK(sky.sees({px, py, pz}, {zero, one, zero}, sees) == ETENDUE_STATUS_OK && sees[0] == 1 && sees[1] == 0);
    CHECK(sky.sees({px, py, pz}, {zero, one, zero}, Span<uint8_t>(sees.data(), 1)) == ETENDUE_STATUS_COUNT);
}

static void test_pbrt() {
    const std::array<Point3, 3> v = {Point3{-0.5f, 2, -0.3f}, {0.7f, 2.1f, -0.1f}, {-0.4f, 2.2f, 0.8f}};
    const Point2 number = {0.3f, 0.6f};
    const Point3 at = {0.1f, 0, -0.2f};
    float pdf = -1;
    const std::array<float, 3> b = SampleSphericalTriangle(v, at, number, &pdf);
    CHECK(std::fabs(b[0] + b[1] + b[2] - 1) < 1e-6f && pdf == Triangle::from_vertices(v[0], v[1], v[2]).by_solid_angle(at).sample(u).pdf);
    Direction w(0, 0, 0);
    float length = 0;
    for (int k = 0; k < 3; k++) {
        w.x += double(b[size_t(k)]) * v[size_t(k)].x, w.y += double(b[size_t(k)]) * v[size_t(k)].y, w.z += double(b[size_t(k)]) * v[size_t(k)].z;
    }
    w = Direction(float(w.x - at.x), float(w.y - at.y), float(w.z - at.z));
    length = float(std::sqrt(w.x * w.x + w.y * w.y + w.z * w.z));
    w = Direction(float(w.x) / length, float(w.y) / length, float(w.z) / length);
    const Point2 back = InvertSphericalTriangleSample(v, at, w);
    CHECK(near(back, number));
    const std::array<Point3, 3> flat = {Point3{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    const Vec3 none = SampleSphericalTriangle(flat, at, number, &pdf);
    CHECK(pdf == 0 && none.x == 0 && none.y == 0 && none.z == 0);
    SampleSphericalTriangle(v, at, number, nullptr);

    const Point3 s = {-0.5f, 2, -0.3f}, ex = {1.2f, 0, 0}, ey = {0, 0.3f, 0.9f};
    const Point3 on = SampleSphericalRectangle(at, s, ex, ey, number, &pdf);
    CHECK(pdf > 0 && near(InvertSphericalRectangleSample(at, s, ex, ey, on), u));
    CHECK(near(Rectangle(s, ex, ey).by_solid_angle(at).hit(Vec3(Rectangle(s, ex, ey).by_solid_angle(at).sample(u).direction)).uv,
               Vec2((on.x - s.x) / 1.2f, (on.z - s.z) / 0.9f)));

    CHECK(near(InvertUniformSphereSample(SampleUniformSphere(u)), u) && near(InvertUniformHemisphereSample(SampleUniformHemisphere(u)), u));
    CHECK(near(InvertCosineHemisphereSample(SampleCosineHemisphere(u)), u) && near(InvertUniformConeSample(SampleUniformCone(u, 0.75f), 0.75f), u));
    CHECK(near(InvertUniformDiskConcentricSample(SampleUniformDiskConcentric(u)), u));
    CHECK(near(InvertUniformTriangleSample(SampleUniformTriangle(u)), u));
    CHECK(UniformSpherePDF() == UniformSphere().pdf({0, 0, 1}) && UniformHemispherePDF() == UniformHemisphere().pdf({0, 0, 1}));
    CHECK(std::fabs(CosineHemispherePDF(0.5f) - CosineHemisphere().pdf({0.866025404f, 0, 0.5f})) < 1e-7f);
    CHECK(std::fabs(UniformConePDF(0.75f) / Cone(0.25f).pdf({0, 0, 1}) - 1) < 1e-6f);
    const float weights[4] = {1, 2, 0.5f, 3};
    CHECK(near(InvertBilinearSample(SampleBilinear(u, weights), weights), u) && std::fabs(BilinearPDF({1, 0}, weights) - 2 / 1.625f) < 1e-6f);
}

// pbrt-v4's own types, as far as its calls need them.
namespace renderer {
template <class T, int N>
class array {
  public:
    array() = default;
    array(std::initializer_list<T> v) {
        size_t i = 0;
        for (const T& x : v) values[i++] = x;
    }
    T& operator[](size_t i) { return values[i]; }
    const T& operator[](size_t i) const { return values[i]; }

  private:
    T values[N] = {};
};
template <class T>
class span {
  public:
    template <class V>
    span(const V& v) : first(&v[0]) {}
    const T& operator[](size_t i) const { return first[i]; }

  private:
    const T* first;
};
template <template <class> class Child, class T>
struct Tuple3 {
    Tuple3() = default;
    Tuple3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
    T operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
    T x{}, y{}, z{};
};
template <class T>
struct Point3;
template <class T>
struct Vector3 : Tuple3<Vector3, T> {
    using Tuple3<renderer::Vector3, T>::Tuple3;
    template <class U>
    explicit Vector3(Point3<U> p) : Tuple3<renderer::Vector3, T>(p.x, p.y, p.z) {}
};
template <class T>
struct Point3 : Tuple3<Point3, T> {
    using Tuple3<renderer::Point3, T>::Tuple3;
    template <class U>
    explicit Point3(Vector3<U> v) : Tuple3<renderer::Point3, T>(v.x, v.y, v.z) {}
    Vector3<T> operator-(Point3 o) const { return {this->x - o.x, this->y - o.y, this->z - o.z}; }
};
struct Point2f {
    Point2f() = default;
    Point2f(float x_, float y_) : x(x_), y(y_) {}
    float operator[](int i) const { return i == 0 ? x : y; }
    float x = 0, y = 0;
};
using Point3f = Point3<float>;
using Vector3f = Vector3<float>;
} // namespace renderer

// Calls as they are in pbrt-v4.
static void test_calls_of_pbrt() {
    using namespace renderer;
    const Point3f p0(-0.5f, 2, -0.3f), p1(0.7f, 2.1f, -0.1f), p2(-0.4f, 2.2f, 0.8f), at(0.1f, 0, -0.2f);
    const Point2f number(0.3f, 0.6f);
    float pdf = 0;
    renderer::array<float, 3> b = SampleSphericalTriangle({p0, p1, p2}, at, number, &pdf);
    const renderer::array<Point3f, 3> v = {p0, p1, p2};
    b = SampleSphericalTriangle(v, at, number);
    CHECK(pdf > 0 && std::fabs(b[0] + b[1] + b[2] - 1) < 1e-6f);
    const Vector3f w = Vec3(Triangle::from_vertices(p0, p1, p2).by_solid_angle(at).sample(number).direction);
    Point2f u2 = InvertSphericalTriangleSample({p0, p1, p2}, at, w);
    CHECK(near(u2, u) && near(InvertSphericalTriangleSample(v, at, w), u));

    const Point3f corner(-0.5f, 2, -0.3f), right(0.7f, 2, -0.3f), up(-0.5f, 2.3f, 0.6f);
    Point3f p3 = SampleSphericalRectangle(at, corner, right - corner, up - corner, number, &pdf);
    p3 = SampleSphericalRectangle(at, corner, right - corner, up - corner, number);
    u2 = InvertSphericalRectangleSample(at, corner, right - corner, up - corner, p3);
    CHECK(pdf > 0 && near(u2, u));

    Vector3f d = SampleUniformSphere(number);
    CHECK(near(InvertUniformSphereSample(d), u));
    d = SampleUniformHemisphere(number);
    u2 = InvertUniformHemisphereSample(d);
    d = SampleCosineHemisphere(number);
    CHECK(near(u2, u) && near(InvertCosineHemisphereSample(d), u));
    d = SampleUniformCone(number, 0.75f);
    CHECK(near(InvertUniformConeSample(d, 0.75f), u) && UniformConePDF(0.75f) > 0);
    const Point2f disk = SampleUniformDiskConcentric(number);
    CHECK(near(InvertUniformDiskConcentricSample(disk), u));
    b = SampleUniformTriangle(number);
    CHECK(near(InvertUniformTriangleSample(b), u) && near(InvertUniformTriangleSample({b[0], b[1], b[2]}), u));
    const renderer::array<float, 4> weights = {1, 2, 0.5f, 3};
    u2 = SampleBilinear(number, weights);
    CHECK(near(InvertBilinearSample(u2, weights), u) && BilinearPDF(u2, renderer::span<float>(weights)) == BilinearPDF(u2, weights));
    CHECK(near(InvertBilinearSample(SampleBilinear(number, {1, 2, 0.5f, 3}), {1, 2, 0.5f, 3}), u) && BilinearPDF(u2, {1, 2, 0.5f, 3}) > 0);
}

// What converts to what.
static_assert(std::is_convertible_v<Point3, Vec3> && std::is_convertible_v<Vec3, Point3> && std::is_convertible_v<Vec3, Direction>);
static_assert(std::is_convertible_v<Point2, Vec2> && std::is_convertible_v<Vec2, Point2> && std::is_convertible_v<Vec3, std::array<float, 3>>);
static_assert(!std::is_convertible_v<Vec3, Vec2> && !std::is_convertible_v<Point3, Vec2> && !std::is_convertible_v<Vec3, LightSample>);
static_assert(std::is_trivially_copyable_v<TriangleBySolidAngle> && sizeof(Triangle) == sizeof(EtendueTriangle));

int main() {
    test_lights();
    test_warps();
    test_sequences();
    test_tree();
    test_sets();
    test_image();
    test_pictures();
    test_skies();
    test_pbrt();
    test_calls_of_pbrt();
    std::printf("%d checks, %d failed\n", checks, failures);
    return failures > 0;
}
