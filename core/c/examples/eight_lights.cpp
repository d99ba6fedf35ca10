// Direct light of eight lights on a diffuse surface in C++17, as a renderer with the types and the interfaces of pbrt-v4 calls it: lights have
// SampleLi and PDF_Li, and a sample of the light and one of the surface are combined. Nothing is in the way, so that each light has a closed
// form; the program prints the errors, and returns 1 if one is too large.
//
//     c++ -std=c++17 -O2 eight_lights.cpp $(pkg-config --cflags --libs etendue) -o eight_lights

#include <etendue.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

// ---- types of the host, which know nothing of the library ----

using Float = float;
template <class T>
struct Tuple3 {
    Float x = 0, y = 0, z = 0;
};
struct Point3f : Tuple3<Point3f> {};
struct Vector3f : Tuple3<Vector3f> {};
struct Normal3f : Tuple3<Normal3f> {};
struct Point2f {
    Float x = 0, y = 0;
};
template <class A, class B>
double Dot(const A& a, const B& b) { return double(a.x) * b.x + double(a.y) * b.y + double(a.z) * b.z; }
template <class A, class B>
Vector3f Minus(const A& a, const B& b) { return {{a.x - b.x, a.y - b.y, a.z - b.z}}; }

constexpr double Pi = 3.14159265358979323846;
constexpr uint32_t Samples = 1 << 16;
constexpr double Most = 1e-3; // the greatest relative error that is right for so many samples

struct LightSampleContext {
    Point3f p;
    Normal3f n;
};
struct LightLiSample {
    Float L;
    Vector3f wi;
    Float pdf;
    Float distance; // of the shadow ray that a renderer traces
};

class Light {
  public:
    virtual ~Light() = default;
    virtual std::optional<LightLiSample> SampleLi(LightSampleContext ctx, Point2f u) const = 0;
    virtual Float PDF_Li(LightSampleContext ctx, Vector3f wi) const = 0;
};

// A light of one side with a radiance of 1. `Prepare` makes the sampler of the shape for a shading point; a renderer that samples a light more
// than once from a point keeps it.
template <class Shape, class Prepare>
class ShapeLight final : public Light {
  public:
    ShapeLight(Shape shape, Prepare prepare) : shape_(shape), prepare_(prepare) {}
    std::optional<LightLiSample> SampleLi(LightSampleContext ctx, Point2f u) const override {
        const etendue::LightSample s = prepare_(shape_, ctx).sample(u);
        if (s.weight == 0) return {};
        return LightLiSample{1, {{s.direction[0], s.direction[1], s.direction[2]}}, s.pdf, s.distance};
    }
    Float PDF_Li(LightSampleContext ctx, Vector3f wi) const override { return prepare_(shape_, ctx).pdf(wi); }

  private:
    Shape shape_;
    Prepare prepare_;
};
template <class Shape, class Prepare>
std::unique_ptr<Light> MakeLight(Shape shape, Prepare prepare) {
    return std::make_unique<ShapeLight<Shape, Prepare>>(shape, prepare);
}

// ---- closed forms of the irradiance ----

// Of a polygon: Lambert 1760.
static double Lambert(const LightSampleContext& ctx, const std::vector<Point3f>& corners) {
    double sum = 0;
    for (size_t i = 0; i < corners.size(); i++) {
        const Vector3f a = Minus(corners[i], ctx.p), b = Minus(corners[(i + 1) % corners.size()], ctx.p);
        const double c[3] = {double(a.y) * b.z - double(a.z) * b.y, double(a.z) * b.x - double(a.x) * b.z, double(a.x) * b.y - double(a.y) * b.x};
        const double sine = std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
        sum += std::atan2(sine, Dot(a, b)) * (c[0] * ctx.n.x + c[1] * ctx.n.y + c[2] * ctx.n.z) / sine;
    }
    return std::fabs(sum) / 2;
}

struct Row {
    const char* name;
    double exact;
    std::unique_ptr<Light> light;
};

static std::vector<Row> MakeLights(const LightSampleContext& ctx) {
    const auto by_solid_angle = [](const auto& shape, const LightSampleContext& c) { return shape.by_solid_angle(c.p); };
    const auto by_projected = [](const auto& shape, const LightSampleContext& c) { return shape.by_projected_solid_angle(c.p, c.n); };
    const auto by_area = [](const auto& shape, const LightSampleContext& c) { return shape.by_area(c.p); };
    const auto anywhere = [](const auto& shape, const LightSampleContext&) { return shape.by_solid_angle(); };

    const Point3f center{{-1, 1.5f, 0.5f}};
    const Vector3f to = Minus(center, ctx.p);
    const double square = Dot(to, to), sphere = Pi * 0.25 / square * Dot(to, ctx.n) / std::sqrt(square);
    // a disk parallel to the surface: its height, its distance from the normal, and its radius
    const double h = 1.5, a = 0.5, r = 0.7f, sum = h * h + a * a + r * r;
    const double disk = Pi / 2 * (1 - (sum - 2 * r * r) / std::sqrt(sum * sum - 4 * r * r * a * a));
    const Vector3f sun{{0, 0.6f, 0.8f}};
    const double narrow = 0.02f;
    const etendue::Vec3 corners[5] = {{0, 2, 0}, {1, 2, 0}, {1.5f, 2, 1}, {1, 2, 2}, {0, 2, 2}};

    std::vector<Row> rows;
    const auto add = [&](const char* name, double exact, std::unique_ptr<Light> light) { rows.push_back({name, exact, std::move(light)}); };
    add("sphere", sphere, MakeLight(etendue::Sphere(center, 0.5f), by_projected));
    add("triangle", Lambert(ctx, {{{0, 1, 0}}, {{1, 1, 0}}, {{0, 1, 1}}}),
        MakeLight(etendue::Triangle::from_vertices({0, 1, 0}, {1, 1, 0}, {0, 1, 1}), by_projected));
    add("parallelogram", Lambert(ctx, {{{-1, 2, 0}}, {{0, 2.2f, 0}}, {{0.1f, 2.3f, 1}}, {{-0.9f, 2.1f, 1}}}),
        MakeLight(etendue::Parallelogram({-1, 2, 0}, {1, 0.2f, 0}, {0.1f, 0.1f, 1}), by_solid_angle));
    add("rectangle", Lambert(ctx, {{{-0.5f, 1.5f, 0.2f}}, {{0.5f, 1.5f, 0.2f}}, {{0.5f, 1.5f, 1.2f}}, {{-0.5f, 1.5f, 1.2f}}}),
        MakeLight(etendue::Rectangle({-0.5f, 1.5f, 0.2f}, {1, 0, 0}, {0, 0, 1}), by_solid_angle));
    add("disk", disk, MakeLight(etendue::Disk({0.7f, 1.2f, 1}, {0, -0.8f, -0.6f}, 0.7f), by_solid_angle));
    add("polygon", Lambert(ctx, {{{0, 2, 0}}, {{1, 2, 0}}, {{1.5f, 2, 1}}, {{1, 2, 2}}, {{0, 2, 2}}}),
        MakeLight(etendue::Polygon(corners), by_solid_angle));
    // flat, and no parallelogram
    add("patch", Lambert(ctx, {{{-0.5f, 2, 0.3f}}, {{0.5f, 2, 0.3f}}, {{1, 2, 1.55f}}, {{-0.5f, 2, 1.3f}}}),
        MakeLight(etendue::BilinearPatch({-0.5f, 2, 0.3f}, {1, 0, 0}, {0, 0, 1}, {1.5f, 0, 1.25f}), by_area));
    add("sun", Pi * narrow * (2 - narrow) * Dot(sun, ctx.n), MakeLight(etendue::Sun(sun, 0.02f), anywhere));
    return rows;
}

// ---- the integrator ----

static Float PowerHeuristic(Float f, Float g) { return f * f / (f * f + g * g); }

// The irradiance by one sample of the light and one of the surface, whose pdf is cosine/π.
static double Estimate(const Light& light, const LightSampleContext& ctx, Point2f uLight, Point2f uSurface) {
    double sum = 0;
    if (const auto ls = light.SampleLi(ctx, uLight)) {
        const double cosine = std::max(0.0, Dot(ls->wi, ctx.n));
        sum += ls->L * cosine / ls->pdf * PowerHeuristic(ls->pdf, Float(cosine / Pi));
    }
    // a frame about the normal (0, 0.8, 0.6)
    const etendue::Vec3 local = etendue::SampleCosineHemisphere(uSurface);
    const Vector3f wi{{local.x, Float(0.6f * local.y + ctx.n.y * local.z), Float(-0.8f * local.y + ctx.n.z * local.z)}};
    const Float pdf = Float(std::max(0.0, Dot(wi, ctx.n)) / Pi), lightPdf = light.PDF_Li(ctx, wi);
    if (pdf > 0 && lightPdf > 0) sum += Pi * PowerHeuristic(pdf, lightPdf);
    return sum;
}

int main() {
    const LightSampleContext ctx{{{0.2f, 0, 0.1f}}, {{0, 0.8f, 0.6f}}};
    const etendue::OwenSobol sequence{1};
    double worst = 0;
    bool right = true;
    std::printf("%-14s %10s %12s\n", "light", "irradiance", "error");
    for (const Row& row : MakeLights(ctx)) {
        double sum = 0;
        for (uint32_t i = 0; i < Samples; i++) sum += Estimate(*row.light, ctx, sequence.pair(0, i, 0), sequence.pair(0, i, 1)) / Samples;
        const double error = std::fabs(sum / row.exact - 1);
        std::printf("%-14s %10.6f %12.1e\n", row.name, row.exact, error);
        worst = std::fmax(worst, error);
        right = right && error < Most; // which a number that is none is not
    }
    std::printf("the largest error is %.1e, and %.0e is allowed\n", worst, Most);
    return !right;
}
