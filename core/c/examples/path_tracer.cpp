// A path tracer on etendue.hpp: three boxes on a plane under five rectangular lights.
//
//     path_tracer [--size N] [--spp N] [--bounces N] [--seed N] [-o OUT.pfm] [--compare MEAN.pfm [--variance VARIANCE.pfm]]
//
// Without --bounces it renders direct light alone, which is the scene `quads` of etendue's renderer. --compare says whether an image of
// that renderer agrees with this one within the errors of both, and exits with 1 if it does not. exr_to_pfm makes these files.
#include "etendue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

// A host's own vector: etendue::Vec3 converts from it and to it.
struct V {
    float x, y, z;
    V operator+(V b) const { return {x + b.x, y + b.y, z + b.z}; }
    V operator-(V b) const { return {x - b.x, y - b.y, z - b.z}; }
    V operator*(V b) const { return {x * b.x, y * b.y, z * b.z}; }
    V operator*(float s) const { return {x * s, y * s, z * s}; }
    float operator[](int k) const { return k == 0 ? x : k == 1 ? y : z; }
};
static V vec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
static float dot(V a, V b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static V cross(V a, V b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
static V unit(V a) { return a * (1 / std::sqrt(dot(a, a))); }

// ---- the scene ----

struct Box {
    V least, most, albedo;
};
// A rectangle p + s u + t v, 0 <= s, t <= 1, that emits from the side of u x v.
struct Light {
    V p, u, v, radiance;
};
static const std::vector<Box> boxes = {
    {{-1.5f, 0, -1}, {-0.7f, 1.2f, -0.2f}, {0.5f, 0.5f, 0.5f}},
    {{0.4f, 0, -0.6f}, {1.4f, 0.6f, 0.2f}, {0.7f, 0.7f, 0.7f}},
    {{-0.4f, 0, 1}, {0.1f, 0.9f, 1.5f}, {0.6f, 0.3f, 0.3f}},
};
static const std::vector<Light> lights = {
    {{-0.8f, 3.8f, -1}, {1.6f, 0, 0}, {0, 0, 1}, {8, 8, 8}},               // ceiling panel
    {{-4.5f, 1.2f, 0.3f}, {0, 0, -0.6f}, {0, 0.6f, 0}, {60, 15, 8}},       // small, red, at the left
    {{4.5f, 0.85f, -1.5f}, {0, 0, 3}, {0, 0.3f, 0}, {6, 12, 40}},          // long, blue, at the right
    {{1.1f, 2.6f, -4}, {0.8f, 0, 0}, {0, 0.32f, 0.24f}, {8, 40, 8}},       // green, at the back, tilted
    {{-1.6f, 4.2f, 1.4f}, {0.2f, 0, 0}, {0, 0, 0.2f}, {150, 140, 120}},    // tiny and bright
};
static const V ground = {0.5f, 0.5f, 0.5f}; // y = 0, |x| and |z| up to 10
static const float AWAY = 1e-4f;            // shadow rays start and end so far from surfaces

struct Hit {
    float distance = 1e30f;
    V point{}, normal{}, albedo{};
    int light = -1;
    bool is_front = false; // of a light, the side that emits
};

static void intersect_ground(V o, V d, Hit& hit) {
    const float t = -o.y / d.y;
    if (!(t > 0 && t < hit.distance)) return;
    const V p = o + d * t;
    if (std::fabs(p.x) > 10 || std::fabs(p.z) > 10) return;
    hit = {t, p, {0, d.y < 0 ? 1.0f : -1.0f, 0}, ground, -1, false};
}
static void intersect(const Box& box, V o, V d, Hit& hit) {
    float from = 0, to = hit.distance;
    int axis = -1;
    for (int k = 0; k < 3; k++) {
        const float a = (box.least[k] - o[k]) / d[k], b = (box.most[k] - o[k]) / d[k];
        const float near = std::min(a, b), far = std::max(a, b);
        if (near > from) from = near, axis = k;
        to = std::min(to, far);
    }
    if (axis < 0 || from >= to) return;
    const float side = d[axis] < 0 ? 1.0f : -1.0f;
    hit = {from, o + d * from, {axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0}, box.albedo, -1, false};
}
static void intersect(int index, V o, V d, Hit& hit) {
    const Light& light = lights[size_t(index)];
    const V n = cross(light.u, light.v), to = light.p - o;
    const float slope = dot(n, d), t = dot(n, to) / slope;
    if (!(t > 0 && t < hit.distance)) return;
    const V q = d * t - to;
    const float a = dot(q, light.u) / dot(light.u, light.u), b = dot(q, light.v) / dot(light.v, light.v);
    if (a < 0 || a > 1 || b < 0 || b > 1) return;
    hit = {t, o + d * t, unit(n), {0, 0, 0}, index, slope < 0};
}
static Hit trace(V o, V d, float distance = 1e30f) {
    Hit hit;
    hit.distance = distance;
    intersect_ground(o, d, hit);
    for (auto& box : boxes) intersect(box, o, d, hit);
    for (int k = 0; k < int(lights.size()); k++) intersect(k, o, d, hit);
    return hit;
}
static bool is_free(V o, V d, float distance) { return trace(o, d, distance).distance == distance; }

// ---- light transport ----

// One path from the eye. `next` gives pairs of random numbers, one after the other.
//
// At every surface, a sample of each light is combined with one direction in proportion to the cosine, by the power heuristic. The last
// surface has samples of lights alone: without bounces that is direct light by solid angle.
template <class Next>
static V radiance(V o, V d, int bounces, Next&& next) {
    V sum = {0, 0, 0}, throughput = {1, 1, 1};
    std::vector<etendue::RectangleBySolidAngle> samplers; // of the last surface
    Hit hit = trace(o, d);
    if (hit.light >= 0) return hit.is_front ? lights[size_t(hit.light)].radiance : sum;
    for (int depth = 0; hit.distance < 1e30f; depth++) {
        const bool is_last = depth == bounces;
        const V p = hit.point + hit.normal * AWAY, n = hit.normal;
        const float inverse_pi = 0.318309886f;
        samplers.clear();
        for (auto& light : lights) {
            samplers.push_back(etendue::Rectangle(light.p, light.u, light.v).by_solid_angle(p));
            const etendue::LightSample s = samplers.back().sample(next());
            const V w = vec(s.direction);
            const float cosine = dot(w, n);
            // the weight is 0 where the light does not emit
            if (!(s.weight > 0 && cosine > 0) || !is_free(p, w, s.distance - AWAY)) continue;
            const float other = is_last ? 0 : cosine * inverse_pi, mis = s.pdf * s.pdf / (s.pdf * s.pdf + other * other);
            sum = sum + throughput * hit.albedo * light.radiance * (inverse_pi * cosine * s.weight * mis);
        }
        if (is_last) break;

        const V local = etendue::SampleCosineHemisphere(next());
        const V x = unit(std::fabs(n.x) > 0.5f ? cross(n, {0, 1, 0}) : cross(n, {1, 0, 0})), y = cross(n, x);
        const V w = x * local.x + y * local.y + n * local.z;
        throughput = throughput * hit.albedo;
        hit = trace(p, w);
        if (hit.light >= 0) {
            const float own = local.z * inverse_pi, other = samplers[size_t(hit.light)].pdf(w);
            if (hit.is_front) sum = sum + throughput * lights[size_t(hit.light)].radiance * (own * own / (own * own + other * other));
            break;
        }
    }
    return sum;
}

// ---- images ----

struct Image {
    int size = 0;
    std::vector<V> mean, variance; // of the mean
};

static Image render(int size, uint32_t spp, int bounces, uint64_t seed) {
    const V eye = {0, 6, 7}, forward = unit(V{0, 0, 0} - eye), right = unit(cross(forward, {0, 1, 0})), up = cross(right, forward);
    const float k = std::tan(20 * 3.14159265f / 180);
    Image image{size, std::vector<V>(size_t(size) * size_t(size)), std::vector<V>(size_t(size) * size_t(size))};
    auto rows = [&](int first, int step) {
        const etendue::Independent sequence{seed};
        // all random numbers of a pixel: one batch for each pair of coordinates
        const size_t dimensions = 1 + size_t(bounces + 1) * (lights.size() + 1);
        std::vector<float> numbers(2 * dimensions * spp);
        for (int row = first; row < size; row += step) {
            for (int column = 0; column < size; column++) {
                const size_t pixel = size_t(row) * size_t(size) + size_t(column);
                for (size_t dimension = 0; dimension < dimensions; dimension++) {
                    float* at = numbers.data() + 2 * dimension * spp;
                    const etendue::Counters counters{uint32_t(pixel), 0, uint32_t(dimension)};
                    if (sequence.pairs(counters, {etendue::Span<float>(at, spp), etendue::Span<float>(at + spp, spp)})) std::abort();
                }
                double sum[3] = {}, squares[3] = {};
                for (uint32_t sample = 0; sample < spp; sample++) {
                    size_t dimension = 0;
                    auto next = [&]() -> etendue::Vec2 {
                        const float* at = numbers.data() + 2 * dimension++ * spp + sample;
                        return {at[0], at[spp]};
                    };
                    const etendue::Vec2 u = next();
                    const float s = 2 * (float(column) + u.x) / float(size) - 1, t = 1 - 2 * (float(row) + u.y) / float(size);
                    const V l = radiance(eye, unit(forward + right * (s * k) + up * (t * k)), bounces, next);
                    for (int c = 0; c < 3; c++) sum[c] += l[c], squares[c] += double(l[c]) * l[c];
                }
                float mean[3], variance[3];
                for (int c = 0; c < 3; c++) {
                    const double m = sum[c] / spp;
                    mean[c] = float(m);
                    variance[c] = float(std::max(squares[c] / spp - m * m, 0.0) / (spp - 1));
                }
                image.mean[pixel] = vec(mean);
                image.variance[pixel] = vec(variance);
            }
        }
    };
    const int count = int(std::max(1u, std::thread::hardware_concurrency()));
    std::vector<std::thread> threads;
    for (int first = 0; first < count; first++) threads.emplace_back(rows, first, count);
    for (auto& thread : threads) thread.join();
    return image;
}

[[noreturn]] static void fail(const std::string& message) {
    std::fprintf(stderr, "path_tracer: %s\n", message.c_str());
    std::exit(2);
}
// PFM files hold rows from the bottom, in the processor's order of bytes where the scale is negative.
static void write_pfm(const char* name, int size, const std::vector<V>& pixels) {
    FILE* file = std::fopen(name, "wb");
    if (!file) fail(std::string("cannot write ") + name);
    std::fprintf(file, "PF\n%d %d\n-1.0\n", size, size);
    for (int row = size - 1; row >= 0; row--) std::fwrite(&pixels[size_t(row) * size_t(size)], sizeof(V), size_t(size), file);
    if (std::fclose(file) != 0) fail(std::string("cannot write ") + name);
}
static std::vector<V> read_pfm(const char* name, int size) {
    FILE* file = std::fopen(name, "rb");
    if (!file) fail(std::string("cannot read ") + name);
    int width = 0, height = 0;
    float scale = 0;
    std::vector<V> pixels(size_t(size) * size_t(size));
    if (std::fscanf(file, "PF %d %d %f", &width, &height, &scale) != 3 || std::fgetc(file) != '\n' || scale >= 0)
        fail(std::string(name) + " is not a PFM file with the least byte first");
    if (width != size || height != size) fail(std::string(name) + " has another size");
    for (int row = size - 1; row >= 0; row--)
        if (std::fread(&pixels[size_t(row) * size_t(size)], sizeof(V), size_t(size), file) != size_t(size)) fail(std::string(name) + " is short");
    std::fclose(file);
    return pixels;
}

// Whether the image agrees with another: in its mean, in its squared difference, which should be the sum of both variances, and in each
// block of an eighth of its size. Deviations are counted in standard errors.
static bool agrees(const Image& image, const std::vector<V>& other, const std::vector<V>& other_variance) {
    const int size = image.size, blocks = 8;
    struct Sums {
        double difference = 0, variance = 0;
        double z() const { return variance > 0 ? difference / std::sqrt(variance) : difference == 0 ? 0 : 1e9; }
    };
    bool is_good = true;
    double worst = 0;
    for (int c = 0; c < 3; c++) {
        Sums all, block[blocks * blocks];
        double mean = 0, other_mean = 0, squares = 0, excess = 0, excess_squares = 0;
        const double n = double(size) * size;
        for (size_t i = 0; i < other.size(); i++) {
            const double d = double(image.mean[i][c]) - other[i][c], variance = double(image.variance[i][c]) + other_variance[i][c];
            const int row = int(i) / size * blocks / size, column = int(i) % size * blocks / size;
            for (Sums* sums : {&all, &block[row * blocks + column]}) sums->difference += d, sums->variance += variance;
            mean += image.mean[i][c] / n;
            other_mean += other[i][c] / n;
            squares += d * d / n;
            excess += d * d - variance;
            excess_squares += (d * d - variance) * (d * d - variance);
        }
        for (auto& sums : block) worst = std::max(worst, std::fabs(sums.z()));
        const double excess_z = excess / std::sqrt(excess_squares);
        std::printf("%s: mean %.6f, other %.6f, z %+.2f; RMSE %.6f, expected %.6f, z %+.2f\n", c == 0 ? "red  " : c == 1 ? "green" : "blue ",
                    mean, other_mean, all.z(), std::sqrt(squares), std::sqrt(all.variance / n), excess_z);
        // one image in 10,000 is farther off by chance
        is_good = is_good && std::fabs(all.z()) < 4.5 && std::fabs(excess_z) < 4.5;
    }
    std::printf("greatest deviation of %d blocks: %.2f standard errors\n", 3 * blocks * blocks, worst);
    is_good = is_good && worst < 5.5;
    std::printf("the images %s\n", is_good ? "agree" : "DISAGREE");
    return is_good;
}

int main(int argc, char** argv) {
    int size = 256, spp = 64, bounces = 0, seed = 1;
    const char *output = nullptr, *compare = nullptr, *variance = nullptr;
    const auto number = [&](const char* text, int least) {
        char* end = nullptr;
        const long value = std::strtol(text, &end, 10);
        if (*end || end == text || value < least || value > 1 << 20) fail(std::string(text) + " is not a number in the range");
        return int(value);
    };
    for (int i = 1; i < argc; i += 2) {
        const std::string option = argv[i];
        if (i + 1 == argc) fail(option + " needs a value");
        const char* value = argv[i + 1];
        if (option == "--size") size = number(value, 1);
        else if (option == "--spp") spp = number(value, 2);
        else if (option == "--bounces") bounces = number(value, 0);
        else if (option == "--seed") seed = number(value, 0);
        else if (option == "-o") output = value;
        else if (option == "--compare") compare = value;
        else if (option == "--variance") variance = value;
        else fail("unknown option " + option);
    }
    if (size > 16384 || bounces > 1000) fail("too large");
    const Image image = render(size, uint32_t(spp), bounces, uint64_t(seed));
    if (output) write_pfm(output, size, image.mean);
    if (!compare) return 0;
    const std::vector<V> other = read_pfm(compare, size);
    return agrees(image, other, variance ? read_pfm(variance, size) : std::vector<V>(other.size(), V{0, 0, 0})) ? 0 : 1;
}
