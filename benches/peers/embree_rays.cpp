// Speed of Embree 3 on triangles and rays from files, for rays.py; the formats are those of benches/examples/trace.rs.
//
//     embree_rays REPETITIONS TRIANGLES RAYS…
//
// Prints a line "build SECONDS", then for each file of rays, query and entry a line "FILE QUERY WIDTH SPEED HITS": the median speed in
// million rays per second of calls with 1, 8 or 16 rays. Rays go to packets in the order of the file; what does not fill the last packet is
// left out. One thread traces and builds, and the scene has Embree's default quality.
#include <embree3/rtcore.h>
#include <immintrin.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

struct Row {
    float origin[3], least, direction[3], limit;
};

static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class T> static std::vector<T> read(const char *path) {
    std::FILE *file = std::fopen(path, "rb");
    if (!file) {
        std::perror(path);
        std::exit(2);
    }
    std::vector<T> rows;
    for (T row; std::fread(&row, sizeof row, 1, file) == 1;) rows.push_back(row);
    std::fclose(file);
    return rows;
}

static double median(std::vector<double> numbers) {
    std::sort(numbers.begin(), numbers.end());
    return numbers[numbers.size() / 2];
}

template <class Trace> static void measure(const char *file, const char *query, int width, size_t rays, int repetitions, Trace trace) {
    std::vector<double> speeds;
    size_t hits = trace();
    for (int i = 0; i < repetitions; i++) {
        double start = now();
        hits = trace();
        speeds.push_back(rays / (now() - start) / 1e6);
    }
    std::printf("%s %s %d %.4f %zu\n", file, query, width, median(speeds), hits);
}

// The fields of a structure of one ray and of packets alike.
static float &lane(float &field, int) { return field; }
static unsigned &lane(unsigned &field, int) { return field; }
template <class T> static T &lane(T *field, int i) { return field[i]; }

// Traces the rays of a file by one pair of entries. `intersect` and `occlude` take a pointer to a packet.
template <class Ray, class RayHit, int WIDTH, class Intersect, class Occlude>
static void trace(const char *file, const std::vector<Row> &rows, int repetitions, Intersect intersect, Occlude occlude) {
    std::vector<Ray> rays(rows.size() / WIDTH);
    for (size_t i = 0; i < rays.size() * WIDTH; i++) {
        Ray &ray = rays[i / WIDTH];
        const Row &row = rows[i];
        int k = i % WIDTH;
        lane(ray.org_x, k) = row.origin[0], lane(ray.org_y, k) = row.origin[1], lane(ray.org_z, k) = row.origin[2];
        lane(ray.dir_x, k) = row.direction[0], lane(ray.dir_y, k) = row.direction[1], lane(ray.dir_z, k) = row.direction[2];
        lane(ray.tnear, k) = row.least, lane(ray.tfar, k) = row.limit, lane(ray.time, k) = 0;
        lane(ray.mask, k) = -1u, lane(ray.id, k) = k, lane(ray.flags, k) = 0;
    }
    measure(file, "closest", WIDTH, rays.size() * WIDTH, repetitions, [&] {
        size_t hits = 0;
        for (const Ray &ray : rays) {
            RayHit hit;
            hit.ray = ray;
            for (int k = 0; k < WIDTH; k++) lane(hit.hit.geomID, k) = RTC_INVALID_GEOMETRY_ID;
            intersect(&hit);
            for (int k = 0; k < WIDTH; k++) hits += lane(hit.hit.geomID, k) != RTC_INVALID_GEOMETRY_ID;
        }
        return hits;
    });
    measure(file, "any", WIDTH, rays.size() * WIDTH, repetitions, [&] {
        size_t hits = 0;
        for (Ray ray : rays) {
            occlude(&ray);
            for (int k = 0; k < WIDTH; k++) hits += lane(ray.tfar, k) < 0;
        }
        return hits;
    });
}

int main(int count, char **arguments) {
    int repetitions = count > 3 ? std::atoi(arguments[1]) : 0;
    if (repetitions < 1) {
        std::fprintf(stderr, "usage: embree_rays REPETITIONS TRIANGLES RAYS...\n");
        return 2;
    }
    // flush to zero and denormals are zero, as Embree's manual asks
    _mm_setcsr(_mm_getcsr() | 0x8040);
    RTCDevice device = rtcNewDevice("threads=1");
    struct Triangle {
        float corners[9];
    };
    std::vector<Triangle> triangles = read<Triangle>(arguments[2]);
    double start = now();
    RTCScene scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void *corners = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, triangles.size() * 3);
    std::memcpy(corners, triangles.data(), triangles.size() * sizeof(Triangle));
    void *indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles.size());
    for (size_t i = 0; i < triangles.size() * 3; i++) static_cast<unsigned *>(indices)[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);
    std::printf("build %.4f\n", now() - start);
    RTCIntersectContext alone, together;
    rtcInitIntersectContext(&alone);
    rtcInitIntersectContext(&together);
    together.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) int all[16];
    std::fill(all, all + 16, -1);
    for (int i = 3; i < count; i++) {
        const char *file = arguments[i];
        std::vector<Row> rows = read<Row>(file);
        trace<RTCRay, RTCRayHit, 1>(
            file, rows, repetitions, [&](RTCRayHit *hit) { rtcIntersect1(scene, &alone, hit); },
            [&](RTCRay *ray) { rtcOccluded1(scene, &alone, ray); });
        for (RTCIntersectContext *context : {&alone, &together}) {
            trace<RTCRay8, RTCRayHit8, 8>(
                file, rows, repetitions, [&](RTCRayHit8 *hit) { rtcIntersect8(all, scene, context, hit); },
                [&](RTCRay8 *rays) { rtcOccluded8(all, scene, context, rays); });
            trace<RTCRay16, RTCRayHit16, 16>(
                file, rows, repetitions, [&](RTCRayHit16 *hit) { rtcIntersect16(all, scene, context, hit); },
                [&](RTCRay16 *rays) { rtcOccluded16(all, scene, context, rays); });
        }
    }
}
