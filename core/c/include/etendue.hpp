// Etendue: light sampling for renderers, in C++17. MIT or Apache-2.0.
//
// A wrapper of etendue.h, whose rules hold here too: nothing is allocated but by Lights, nothing is thrown, and no type information is needed at run time.
//
//     etendue::Triangle lamp({0, 2, 0}, {1, 0, 0}, {0, 0, 1});
//     auto sampler = lamp.by_solid_angle({0, 0, 0});         // once for a shading point
//     etendue::LightSample s = sampler.sample({0.3f, 0.6f}); // as often as needed
//
// - Numbers: Vec3, Vec2. A vector class of the host that has members x, y, z, or an array of three floats, converts to Vec3. Vec3 converts
//   to every class with such members or an operator[] that three floats initialise: T{x, y, z}. The same holds for Vec2.
// - Lights: Sphere, Triangle, Parallelogram, Rectangle, Disk, BilinearPatch, Polygon, Line, Sun, PointLight, SpotLight,
//   DirectionalLight. Their methods by_... prepare them for a shading point. ImageEnvironment is the same at every point.
// - Picture::on puts a picture on a light. PortalEnvironment.
// - Batches: columns of one length, from anything with data() and size(). Every length is checked: a column of another length gives
//   ETENDUE_STATUS_COUNT. Empty columns stand for results that are not wanted.
// - Lights: a set of lights of any kind, chosen and sampled by one call.
// - Warps, sequences and LightTree. Reflection is a warp for which flat lights are prepared by_reflection; ReflectionColumns are many of them.
// - At the end, functions of the names and arguments of pbrt-v4, for hosts that replace those one by one.
#ifndef ETENDUE_HPP
#define ETENDUE_HPP

#include "etendue.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace etendue {

using Status = EtendueStatus;
// The fields are those of the C struct; `direction` and `normal` convert to Vec3, `uv` to Vec2.
using LightSample = EtendueLightSample;

// ---- numbers ----

namespace detail {
template <class T, class = void>
struct HasZ : std::false_type {};
template <class T>
struct HasZ<T, std::void_t<decltype(float(std::declval<const T&>().z))>> : std::true_type {};
template <class T, class = void>
struct HasXy : std::false_type {};
template <class T>
struct HasXy<T, std::void_t<decltype(float(std::declval<const T&>().x) + float(std::declval<const T&>().y))>> : std::true_type {};
template <class T, class = void>
struct HasIndex : std::false_type {};
template <class T>
struct HasIndex<T, std::void_t<decltype(float(std::declval<const T&>()[0]))>> : std::true_type {};

// conditions on a conversion: where one does not hold, the conversion is not considered, so that no vector loses its z on the way
template <class T>
using IsVec3 = std::enable_if_t<HasXy<T>::value && HasZ<T>::value, int>;
template <class T>
using IsVec2 = std::enable_if_t<HasXy<T>::value && !HasZ<T>::value, int>;
template <class T, class = void>
struct HasTwo : std::false_type {};
template <class T>
struct HasTwo<T, std::void_t<decltype(T{0.0f, 0.0f})>> : std::true_type {};
template <class T, class = void>
struct HasThree : std::false_type {};
template <class T>
struct HasThree<T, std::void_t<decltype(T{0.0f, 0.0f, 0.0f})>> : std::true_type {};
template <class T>
using FromTwo = std::enable_if_t<std::is_class_v<T> && (HasXy<T>::value || HasIndex<T>::value) && HasTwo<T>::value, int>;
template <class T>
using FromThree = std::enable_if_t<std::is_class_v<T> && (HasXy<T>::value || HasIndex<T>::value) && HasThree<T>::value, int>;
} // namespace detail

// Three numbers.
struct Vec3 {
    float x = 0, y = 0, z = 0;

    constexpr Vec3() = default;
    constexpr Vec3(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
    constexpr Vec3(const float (&v)[3]) : x(v[0]), y(v[1]), z(v[2]) {}
    template <class T, detail::IsVec3<T> = 0>
    constexpr Vec3(const T& v) : x(float(v.x)), y(float(v.y)), z(float(v.z)) {}
    template <class T, detail::FromThree<T> = 0>
    constexpr operator T() const { return T{x, y, z}; }

    constexpr float operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};

// Two numbers.
struct Vec2 {
    float x = 0, y = 0;

    constexpr Vec2() = default;
    constexpr Vec2(float x_, float y_) : x(x_), y(y_) {}
    constexpr Vec2(const float (&v)[2]) : x(v[0]), y(v[1]) {}
    template <class T, detail::IsVec2<T> = 0>
    constexpr Vec2(const T& v) : x(float(v.x)), y(float(v.y)) {}
    template <class T, detail::FromTwo<T> = 0>
    constexpr operator T() const { return T{x, y}; }

    constexpr float operator[](int i) const { return i == 0 ? x : y; }
};

namespace detail {
// numbers in a row, as the C functions take them
template <int N>
struct Row;
template <>
struct Row<1> {
    using Value = float;
    float v[1] = {};
    Row() = default;
    Row(float x) : v{x} {}
    float value() const { return v[0]; }
};
template <>
struct Row<2> {
    using Value = Vec2;
    float v[2] = {};
    Row() = default;
    Row(Vec2 a) : v{a.x, a.y} {}
    Vec2 value() const { return {v[0], v[1]}; }
};
template <>
struct Row<3> {
    using Value = Vec3;
    float v[3] = {};
    Row() = default;
    Row(Vec3 a) : v{a.x, a.y, a.z} {}
    Vec3 value() const { return {v[0], v[1], v[2]}; }
};
} // namespace detail

// ---- columns ----

// A pointer and a size: what std::span is in C++20.
template <class T>
class Span {
  public:
    constexpr Span() = default;
    constexpr Span(T* data, size_t size) : data_(data), size_(size) {}
    template <size_t N>
    constexpr Span(T (&array)[N]) : data_(array), size_(N) {}
    // from std::vector, std::array, std::span and their like
    template <class C, class = std::enable_if_t<std::is_convertible_v<decltype(std::declval<C&>().data()), T*>>,
              class = decltype(std::declval<C&>().size())>
    constexpr Span(C&& container) : data_(container.data()), size_(container.size()) {}

    constexpr T* data() const { return data_; }
    constexpr size_t size() const { return size_; }
    constexpr T& operator[](size_t i) const { return data_[i]; }

  private:
    T* data_ = nullptr;
    size_t size_ = 0;
};

// N columns, one for each coordinate.
template <class T, int N>
struct Columns {
    Span<T> column[N];

    constexpr Columns() = default;
    template <class... C, class = std::enable_if_t<sizeof...(C) == N && std::conjunction_v<std::is_convertible<C&&, Span<T>>...>>>
    constexpr Columns(C&&... columns) : column{Span<T>(std::forward<C>(columns))...} {}
    // columns that are written can be read
    template <class U, class = std::enable_if_t<std::is_same_v<const U, T>>>
    constexpr Columns(const Columns<U, N>& other) {
        for (int i = 0; i < N; i++) column[i] = other.column[i];
    }

    constexpr size_t size() const { return column[0].size(); }
};
template <int N>
using In = Columns<const float, N>;
template <int N>
using Out = Columns<float, N>;

namespace detail {
template <class T>
bool fits(Span<T> column, size_t n) {
    return column.size() == n;
}
template <class T, int N>
bool fits(const Columns<T, N>& columns, size_t n) {
    for (auto& column : columns.column)
        if (column.size() != n) return false;
    return true;
}
// for results, which may be absent
template <class T>
bool fits_or_absent(Span<T> column, size_t n) {
    return column.size() == n || column.size() == 0;
}
template <class T, int N>
bool fits_or_absent(const Columns<T, N>& columns, size_t n) {
    for (auto& column : columns.column)
        if (!fits_or_absent(column, n)) return false;
    return true;
}
// an empty column may have a pointer, but must not be written
template <class T>
T* pointer(Span<T> column) {
    return column.size() == 0 ? nullptr : column.data();
}
template <class T, int N>
struct Pointers {
    T* p[N];
    Pointers(const Columns<T, N>& columns) {
        for (int i = 0; i < N; i++) p[i] = pointer(columns.column[i]);
    }
};
} // namespace detail

// Columns of samples. Empty ones are not wanted.
struct SampleColumns {
    Out<3> direction;
    Span<float> distance, pdf, weight;
    Out<3> normal;
    Out<2> uv;
    Span<uint8_t> emits;

    bool fits(size_t n) const {
        using detail::fits_or_absent;
        return fits_or_absent(direction, n) && fits_or_absent(distance, n) && fits_or_absent(pdf, n) && fits_or_absent(weight, n) &&
               fits_or_absent(normal, n) && fits_or_absent(uv, n) && fits_or_absent(emits, n);
    }
    EtendueSampleColumns c() const {
        using detail::pointer;
        EtendueSampleColumns out;
        for (int i = 0; i < 3; i++) out.direction[i] = pointer(direction.column[i]);
        out.distance = pointer(distance);
        out.pdf = pointer(pdf);
        out.weight = pointer(weight);
        for (int i = 0; i < 3; i++) out.normal[i] = pointer(normal.column[i]);
        for (int i = 0; i < 2; i++) out.uv[i] = pointer(uv.column[i]);
        out.emits = pointer(emits);
        return out;
    }
};

// Columns of lights: the fields of the light in their order, each a Columns<.., 3> or a Span.
//
//     TriangleColumns lights({v0x, v0y, v0z}, {e1x, e1y, e1z}, {e2x, e2y, e2z});
template <class C>
class LightColumns {
    static constexpr size_t COUNT = sizeof(C) / sizeof(const float*);
    Span<const float> columns_[COUNT];
    size_t at_ = 0;

    void add(Span<const float> column) { columns_[at_++] = column; }
    void add(const In<3>& three) {
        for (auto& column : three.column) add(column);
    }

  public:
    // flat lights: three vectors
    template <size_t N = COUNT, class = std::enable_if_t<N == 9>>
    LightColumns(In<3> a, In<3> b, In<3> c) { add(a), add(b), add(c); }
    // spheres and suns
    template <size_t N = COUNT, class = std::enable_if_t<N == 4>>
    LightColumns(In<3> a, Span<const float> b) { add(a), add(b); }
    // disks
    template <size_t N = COUNT, class = std::enable_if_t<N == 7>>
    LightColumns(In<3> a, In<3> b, Span<const float> c) { add(a), add(b), add(c); }
    // lines
    template <size_t N = COUNT, class = std::enable_if_t<N == 6>>
    LightColumns(In<3> a, In<3> b) { add(a), add(b); }
    // patches
    template <size_t N = COUNT, class = std::enable_if_t<N == 12>>
    LightColumns(In<3> a, In<3> b, In<3> c, In<3> d) { add(a), add(b), add(c), add(d); }
    // polygons
    template <size_t N = COUNT, class = std::enable_if_t<N == 24>>
    LightColumns(const In<3> (&corners)[8]) {
        for (auto& corner : corners) add(corner);
    }

    bool fits(size_t n) const {
        for (auto& column : columns_)
            if (column.size() != n) return false;
        return true;
    }
    C c() const {
        const float* pointers[COUNT];
        for (size_t i = 0; i < COUNT; i++) pointers[i] = columns_[i].data();
        C out;
        std::memcpy(&out, pointers, sizeof out);
        return out;
    }
};

// Reflections in columns, in memory of the host: 16 columns of one length.
class ReflectionColumns {
    EtendueReflectionColumns c_ = {};
    size_t size_ = 0;

  public:
    static constexpr size_t COLUMNS = sizeof(EtendueReflection) / sizeof(float);

    // Prepares one for each roughness, unit normal and unit direction to the viewer, in memory for COLUMNS numbers of each.
    Status prepare(Span<const float> alphas, In<3> normals, In<3> views, Span<float> memory) {
        const size_t n = alphas.size();
        if (!detail::fits(normals, n) || !detail::fits(views, n) || memory.size() != COLUMNS * n) return ETENDUE_STATUS_COUNT;
        for (size_t i = 0; i < COLUMNS - 2; i++) c_.data[i] = memory.data() + i * n;
        c_.albedo = memory.data() + (COLUMNS - 2) * n;
        c_.schlick = memory.data() + (COLUMNS - 1) * n;
        size_ = n;
        return etendue_reflection_prepare_batch(n, alphas.data(), detail::Pointers<const float, 3>(normals).p,
                                                detail::Pointers<const float, 3>(views).p, &c_);
    }
    Span<const float> albedo() const { return {c_.albedo, size_}; }
    Span<const float> schlick() const { return {c_.schlick, size_}; }
    bool fits(size_t n) const { return size_ == n; }
    const EtendueReflectionColumns& c() const { return c_; }
};

// ---- lights ----

// What is done with a sampler c_.
#define ETENDUE_SAMPLER_METHODS(PREFIX)                                                                                                \
    /* Draws a direction for u; the pdf is 0 for a number that is not in [0, 1). */                                                    \
    LightSample sample(Vec2 u) const {                                                                                                 \
        LightSample out = {};                                                                                                              \
        PREFIX##_sample(&c_, detail::Row<2>(u).v, &out);                                                                               \
        return out;                                                                                                                    \
    }                                                                                                                                  \
    /* The pdf with which the unit direction w is drawn. */                                                                            \
    float pdf(Vec3 w) const { return PREFIX##_pdf(&c_, detail::Row<3>(w).v); }                                                         \
    /* The random numbers that are mapped to w. */                                                                                     \
    Vec2 invert(Vec3 w) const {                                                                                                        \
        detail::Row<2> u;                                                                                                              \
        PREFIX##_invert(&c_, detail::Row<3>(w).v, u.v);                                                                                \
        return u.value();                                                                                                              \
    }                                                                                                                                  \
    /* The nearest point of the light in the unit direction w; pdf 0 where w misses it. */                                             \
    LightSample hit(Vec3 w) const {                                                                                                    \
        LightSample out = {};                                                                                                              \
        PREFIX##_hit(&c_, detail::Row<3>(w).v, &out);                                                                                  \
        return out;                                                                                                                    \
    }                                                                                                                                  \
                                                                                                                                       \
    Status sample(In<2> u, const SampleColumns& out) const {                                                                           \
        const size_t n = u.size();                                                                                                     \
        if (!detail::fits(u, n) || !out.fits(n)) return ETENDUE_STATUS_COUNT;                                                          \
        const EtendueSampleColumns c_out = out.c();                                                                                    \
        return PREFIX##_sample_batch(&c_, n, detail::Pointers<const float, 2>(u).p, &c_out);                                           \
    }                                                                                                                                  \
    Status pdf(In<3> w, Span<float> out) const {                                                                                       \
        const size_t n = w.size();                                                                                                     \
        if (!detail::fits(w, n) || !detail::fits(out, n)) return ETENDUE_STATUS_COUNT;                                                 \
        return PREFIX##_pdf_batch(&c_, n, detail::Pointers<const float, 3>(w).p, out.data());                                          \
    }                                                                                                                                  \
    Status invert(In<3> w, Out<2> u) const {                                                                                           \
        const size_t n = w.size();                                                                                                     \
        if (!detail::fits(w, n) || !detail::fits_or_absent(u, n)) return ETENDUE_STATUS_COUNT;                                         \
        return PREFIX##_invert_batch(&c_, n, detail::Pointers<const float, 3>(w).p, detail::Pointers<float, 2>(u).p);                  \
    }                                                                                                                                  \
    Status hit(In<3> w, const SampleColumns& out) const {                                                                              \
        const size_t n = w.size();                                                                                                     \
        if (!detail::fits(w, n) || !out.fits(n)) return ETENDUE_STATUS_COUNT;                                                          \
        const EtendueSampleColumns c_out = out.c();                                                                                    \
        return PREFIX##_hit_batch(&c_, n, detail::Pointers<const float, 3>(w).p, &c_out);                                              \
    }

// One technique: a light prepared for a shading point.
//
// What it needs beside the point, a unit normal or a reflection, is in the last arguments: parameter, its C pointer, columns, their check and their
// C pointer.
#define ETENDUE_TECHNIQUE(NAME, SAMPLER, LIGHT, PREFIX, PARAMETER, POINTER, COLUMNS, COLUMNS_FIT, COLUMNS_POINTER)                               \
    class NAME {                                                                                                                       \
        Etendue##SAMPLER c_;                                                                                                           \
                                                                                                                                       \
      public:                                                                                                                          \
        NAME(const Etendue##LIGHT& light, Vec3 p PARAMETER) {                                                                          \
            if (PREFIX##_prepare(&light, detail::Row<3>(p).v POINTER, &c_) != ETENDUE_STATUS_OK) c_ = {};                              \
        }                                                                                                                              \
        const Etendue##SAMPLER& c() const { return c_; }                                                                               \
        ETENDUE_SAMPLER_METHODS(PREFIX)                                                                                                \
        /* Prepares a light of its own for each shading point, and draws a direction for each u. */                                    \
        static Status sample_each(const LightColumns<Etendue##LIGHT##Columns>& lights, In<3> p COLUMNS, In<2> u,                       \
                                  const SampleColumns& out) {                                                                          \
            const size_t n = u.size();                                                                                                 \
            if (!lights.fits(n) || !detail::fits(p, n) COLUMNS_FIT || !detail::fits(u, n) || !out.fits(n)) return ETENDUE_STATUS_COUNT; \
            const Etendue##LIGHT##Columns c_lights = lights.c();                                                                       \
            const EtendueSampleColumns c_out = out.c();                                                                                \
            return PREFIX##_sample_each(&c_lights, n, detail::Pointers<const float, 3>(p).p COLUMNS_POINTER,                           \
                                        detail::Pointers<const float, 2>(u).p, &c_out);                                                \
        }                                                                                                                              \
        /* The nearest point of a light of its own for each shading point in the unit direction w. */                                  \
        static Status hit_each(const LightColumns<Etendue##LIGHT##Columns>& lights, In<3> p COLUMNS, In<3> w,                          \
                             const SampleColumns& out) {                                                                               \
            const size_t n = w.size();                                                                                                 \
            if (!lights.fits(n) || !detail::fits(p, n) COLUMNS_FIT || !detail::fits(w, n) || !out.fits(n))                             \
                return ETENDUE_STATUS_COUNT;                                                                                           \
            const Etendue##LIGHT##Columns c_lights = lights.c();                                                                       \
            const EtendueSampleColumns c_out = out.c();                                                                                \
            return PREFIX##_hit_each(&c_lights, n, detail::Pointers<const float, 3>(p).p COLUMNS_POINTER,                              \
                detail::Pointers<const float, 3>(w).p, &c_out);                                                                        \
        }                                                                                                                              \
        /* The pdf of the unit direction w for each shading point and a light of its own. */                                           \
        static Status pdf_each(const LightColumns<Etendue##LIGHT##Columns>& lights, In<3> p COLUMNS, In<3> w,                          \
                             Span<float> out) {                                                                                        \
            const size_t n = w.size();                                                                                                 \
            if (!lights.fits(n) || !detail::fits(p, n) COLUMNS_FIT || !detail::fits(w, n) || !detail::fits(out, n))                    \
                return ETENDUE_STATUS_COUNT;                                                                                           \
            const Etendue##LIGHT##Columns c_lights = lights.c();                                                                       \
            return PREFIX##_pdf_each(&c_lights, n, detail::Pointers<const float, 3>(p).p COLUMNS_POINTER,                              \
                detail::Pointers<const float, 3>(w).p, out.data());                                                                    \
        }                                                                                                                              \
        /* The random numbers that are mapped to the unit direction w for each shading point and a light of its own. */                \
        static Status invert_each(const LightColumns<Etendue##LIGHT##Columns>& lights, In<3> p COLUMNS, In<3> w,                       \
                             Out<2> u) {                                                                                               \
            const size_t n = w.size();                                                                                                 \
            if (!lights.fits(n) || !detail::fits(p, n) COLUMNS_FIT || !detail::fits(w, n) || !detail::fits_or_absent(u, n))            \
                return ETENDUE_STATUS_COUNT;                                                                                           \
            const Etendue##LIGHT##Columns c_lights = lights.c();                                                                       \
            return PREFIX##_invert_each(&c_lights, n, detail::Pointers<const float, 3>(p).p COLUMNS_POINTER,                           \
                detail::Pointers<const float, 3>(w).p, detail::Pointers<float, 2>(u).p);                                               \
        }                                                                                                                              \
    };
#define ETENDUE_COMMA ,
#define ETENDUE_ANYWHERE(NAME, SAMPLER, LIGHT, PREFIX) ETENDUE_TECHNIQUE(NAME, SAMPLER, LIGHT, PREFIX, , , , , )
#define ETENDUE_ON_SURFACE(NAME, SAMPLER, LIGHT, PREFIX)                                                                                        \
    ETENDUE_TECHNIQUE(NAME, SAMPLER, LIGHT, PREFIX, ETENDUE_COMMA Vec3 normal, ETENDUE_COMMA detail::Row<3>(normal).v,                          \
                      ETENDUE_COMMA In<3> normals, || !detail::fits(normals, n),                                                       \
                      ETENDUE_COMMA detail::Pointers<const float ETENDUE_COMMA 3>(normals).p)
#define ETENDUE_REFLECTED(NAME, SAMPLER, LIGHT, PREFIX)                                                                                         \
    ETENDUE_TECHNIQUE(NAME, SAMPLER, LIGHT, PREFIX, ETENDUE_COMMA const EtendueReflection& reflection, ETENDUE_COMMA &reflection,               \
                      ETENDUE_COMMA const ReflectionColumns& reflections, || !reflections.fits(n), ETENDUE_COMMA &reflections.c())

// from the list of techniques: WRITE=1 cargo test -p etendue-tests bindings
ETENDUE_ANYWHERE(SphereByArea, SphereByArea, Sphere, etendue_sphere_by_area)
ETENDUE_ANYWHERE(SphereBySolidAngle, SphereBySolidAngle, Sphere, etendue_sphere_by_solid_angle)
ETENDUE_ON_SURFACE(SphereByProjectedSolidAngle, SphereByProjectedSolidAngle, Sphere, etendue_sphere_by_projected_solid_angle)
ETENDUE_REFLECTED(SphereByReflection, SphereByReflection, Sphere, etendue_sphere_by_reflection)
ETENDUE_ANYWHERE(TriangleByArea, TriangleByArea, Triangle, etendue_triangle_by_area)
ETENDUE_ANYWHERE(TriangleBySolidAngle, TriangleBySolidAngle, Triangle, etendue_triangle_by_solid_angle)
ETENDUE_ON_SURFACE(TriangleByProjectedSolidAngle, TriangleByProjectedSolidAngle, Triangle, etendue_triangle_by_projected_solid_angle)
ETENDUE_REFLECTED(TriangleByReflection, TriangleByReflection, Triangle, etendue_triangle_by_reflection)
ETENDUE_ANYWHERE(ParallelogramByArea, ParallelogramByArea, Parallelogram, etendue_parallelogram_by_area)
ETENDUE_ANYWHERE(ParallelogramBySolidAngle, ParallelogramBySolidAngle, Parallelogram, etendue_parallelogram_by_solid_angle)
ETENDUE_ON_SURFACE(ParallelogramByProjectedSolidAngle, ParallelogramByProjectedSolidAngle, Parallelogram, etendue_parallelogram_by_projected_solid_angle)
ETENDUE_REFLECTED(ParallelogramByReflection, ParallelogramByReflection, Parallelogram, etendue_parallelogram_by_reflection)
ETENDUE_ANYWHERE(RectangleByArea, ParallelogramByArea, Rectangle, etendue_rectangle_by_area)
ETENDUE_ANYWHERE(RectangleBySolidAngle, RectangleBySolidAngle, Rectangle, etendue_rectangle_by_solid_angle)
ETENDUE_ON_SURFACE(RectangleByProjectedSolidAngle, ParallelogramByProjectedSolidAngle, Rectangle, etendue_rectangle_by_projected_solid_angle)
ETENDUE_REFLECTED(RectangleByReflection, ParallelogramByReflection, Rectangle, etendue_rectangle_by_reflection)
ETENDUE_ANYWHERE(DiskByArea, DiskByArea, Disk, etendue_disk_by_area)
ETENDUE_ANYWHERE(DiskBySolidAngle, DiskBySolidAngle, Disk, etendue_disk_by_solid_angle)
ETENDUE_ANYWHERE(PolygonByArea, PolygonByArea, Polygon, etendue_polygon_by_area)
ETENDUE_ANYWHERE(PolygonBySolidAngle, PolygonBySolidAngle, Polygon, etendue_polygon_by_solid_angle)
ETENDUE_ON_SURFACE(PolygonByProjectedSolidAngle, PolygonByProjectedSolidAngle, Polygon, etendue_polygon_by_projected_solid_angle)
ETENDUE_REFLECTED(PolygonByReflection, PolygonByReflection, Polygon, etendue_polygon_by_reflection)
ETENDUE_ANYWHERE(PatchByArea, PatchByArea, BilinearPatch, etendue_patch_by_area)
ETENDUE_ANYWHERE(LineByLength, LineByLength, Line, etendue_line_by_length)
ETENDUE_ANYWHERE(LineByAngle, LineByAngle, Line, etendue_line_by_angle)
ETENDUE_ON_SURFACE(LineByProjectedSolidAngle, LineByProjectedSolidAngle, Line, etendue_line_by_projected_solid_angle)
ETENDUE_ANYWHERE(SunBySolidAngle, SunBySolidAngle, Sun, etendue_sun_by_solid_angle)
ETENDUE_ANYWHERE(PointLightByDelta, PointLightByDelta, PointLight, etendue_point_light_by_delta)
ETENDUE_ANYWHERE(SpotLightByDelta, SpotLightByDelta, SpotLight, etendue_spot_light_by_delta)
ETENDUE_ANYWHERE(DirectionalLightByDelta, DirectionalLightByDelta, DirectionalLight, etendue_directional_light_by_delta)

using SphereColumns = LightColumns<EtendueSphereColumns>;
using TriangleColumns = LightColumns<EtendueTriangleColumns>;
using ParallelogramColumns = LightColumns<EtendueParallelogramColumns>;
using RectangleColumns = LightColumns<EtendueRectangleColumns>;
using DiskColumns = LightColumns<EtendueDiskColumns>;
using PolygonColumns = LightColumns<EtenduePolygonColumns>;
using BilinearPatchColumns = LightColumns<EtendueBilinearPatchColumns>;
using LineColumns = LightColumns<EtendueLineColumns>;
using SunColumns = LightColumns<EtendueSunColumns>;
using PointLightColumns = LightColumns<EtenduePointLightColumns>;
using SpotLightColumns = LightColumns<EtendueSpotLightColumns>;
using DirectionalLightColumns = LightColumns<EtendueDirectionalLightColumns>;

// EtendueSphere with its constructors and techniques.
struct Sphere : EtendueSphere {
    Sphere(Vec3 center_, float radius_) : EtendueSphere{{center_.x, center_.y, center_.z}, radius_} {}
    SphereByArea by_area(Vec3 at) const { return {*this, at}; }
    SphereBySolidAngle by_solid_angle(Vec3 at) const { return {*this, at}; }
    SphereByProjectedSolidAngle by_projected_solid_angle(Vec3 at, Vec3 n) const { return {*this, at, n}; }
    SphereByReflection by_reflection(Vec3 at, const EtendueReflection& reflection) const { return {*this, at, reflection}; }
    // Whether a point is on the light, to within its rounding: see etendue_on_surface.
    bool on_surface(Vec3 at) const {
        const float p[3] = {at.x, at.y, at.z};
        return etendue_on_surface(ETENDUE_TECHNIQUE_SPHERE_BY_AREA, this, p) != 0;
    }
};
// EtendueTriangle with its constructors and techniques.
struct Triangle : EtendueTriangle {
    Triangle(Vec3 v0_, Vec3 e1_, Vec3 e2_) : EtendueTriangle{{v0_.x, v0_.y, v0_.z}, {e1_.x, e1_.y, e1_.z}, {e2_.x, e2_.y, e2_.z}} {}
    static Triangle from_vertices(Vec3 v0_, Vec3 v1_, Vec3 v2_) { return {v0_, {v1_.x - v0_.x, v1_.y - v0_.y, v1_.z - v0_.z}, {v2_.x - v0_.x, v2_.y - v0_.y, v2_.z - v0_.z}}; }
    TriangleByArea by_area(Vec3 at) const { return {*this, at}; }
    TriangleBySolidAngle by_solid_angle(Vec3 at) const { return {*this, at}; }
    TriangleByProjectedSolidAngle by_projected_solid_angle(Vec3 at, Vec3 n) const { return {*this, at, n}; }
    TriangleByReflection by_reflection(Vec3 at, const EtendueReflection& reflection) const { return {*this, at, reflection}; }
    // Whether a point is on the light, to within its rounding: see etendue_on_surface.
    bool on_surface(Vec3 at) const {
        const float p[3] = {at.x, at.y, at.z};
        return etendue_on_surface(ETENDUE_TECHNIQUE_TRIANGLE_BY_AREA, this, p) != 0;
    }
};
// EtendueParallelogram with its constructors and techniques.
struct Parallelogram : EtendueParallelogram {
    Parallelogram(Vec3 corner_, Vec3 edge_s_, Vec3 edge_t_) : EtendueParallelogram{{corner_.x, corner_.y, corner_.z}, {edge_s_.x, edge_s_.y, edge_s_.z}, {edge_t_.x, edge_t_.y, edge_t_.z}} {}
    ParallelogramByArea by_area(Vec3 at) const { return {*this, at}; }
    ParallelogramBySolidAngle by_solid_angle(Vec3 at) const { return {*this, at}; }
    ParallelogramByProjectedSolidAngle by_projected_solid_angle(Vec3 at, Vec3 n) const { return {*this, at, n}; }
    ParallelogramByReflection by_reflection(Vec3 at, const EtendueReflection& reflection) const { return {*this, at, reflection}; }
    // Whether a point is on the light, to within its rounding: see etendue_on_surface.
    bool on_surface(Vec3 at) const {
        const float p[3] = {at.x, at.y, at.z};
        return etendue_on_surface(ETENDUE_TECHNIQUE_PARALLELOGRAM_BY_AREA, this, p) != 0;
    }
};
// EtendueRectangle with its constructors and techniques.
struct Rectangle : EtendueRectangle {
    Rectangle(Vec3 corner_, Vec3 edge_s_, Vec3 edge_t_) : EtendueRectangle{{corner_.x, corner_.y, corner_.z}, {edge_s_.x, edge_s_.y, edge_s_.z}, {edge_t_.x, edge_t_.y, edge_t_.z}} {}
    RectangleByArea by_area(Vec3 at) const { return {*this, at}; }
    RectangleBySolidAngle by_solid_angle(Vec3 at) const { return {*this, at}; }
    RectangleByProjectedSolidAngle by_projected_solid_angle(Vec3 at, Vec3 n) const { return {*this, at, n}; }
    RectangleByReflection by_reflection(Vec3 at, const EtendueReflection& reflection) const { return {*this, at, reflection}; }
    // Whether a point is on the light, to within its rounding: see etendue_on_surface.
    bool on_surface(Vec3 at) const {
        const float p[3] = {at.x, at.y, at.z};
        return etendue_on_surface(ETENDUE_TECHNIQUE_RECTANGLE_BY_AREA, this, p) != 0;
    }
};
// EtendueDisk with its constructors and techniques.
struct Disk : EtendueDisk {
    Disk(Vec3 center_, Vec3 normal_, float radius_) : EtendueDisk{{center_.x, center_.y, center_.z}, {normal_.x, normal_.y, normal_.z}, radius_} {}
    DiskByArea by_area(Vec3 at) const { return {*this, at}; }
    DiskBySolidAngle by_solid_angle(Vec3 at) const { return {*this, at}; }
    // Whether a point is on the light, to within its rounding: see etendue_on_surface.
    bool on_surface(Vec3 at) const {
        const float p[3] = {at.x, at.y, at.z};
        return etendue_on_surface(ETENDUE_TECHNIQUE_DISK_BY_AREA, this, p) != 0;
    }
};
// EtenduePolygon with its constructors and techniques.
struct Polygon : EtenduePolygon {
    // Corners beyond the eighth are left out; without corners it is a point, whose pdf is 0.
    Polygon(const Vec3* given, size_t count) : EtenduePolygon{} {
        for (size_t i = 0; i < 8 && count > 0; i++) {
            const Vec3 corner = given[i < count ? i : count - 1];
            for (int k = 0; k < 3; k++) corners[i][k] = corner[k];
        }
    }
    template <size_t N>
    Polygon(const Vec3 (&given)[N]) : Polygon(given, N) {
        static_assert(N >= 3 && N <= 8, "a polygon has 3 to 8 corners");
    }
    PolygonByArea by_area(Vec3 at) const { return {*this, at}; }
    PolygonBySolidAngle by_solid_angle(Vec3 at) const { return {*this, at}; }
    PolygonByProjectedSolidAngle by_projected_solid_angle(Vec3 at, Vec3 n) const { return {*this, at, n}; }
    PolygonByReflection by_reflection(Vec3 at, const EtendueReflection& reflection) const { return {*this, at, reflection}; }
    // Whether a point is on the light, to within its rounding: see etendue_on_surface.
    bool on_surface(Vec3 at) const {
        const float p[3] = {at.x, at.y, at.z};
        return etendue_on_surface(ETENDUE_TECHNIQUE_POLYGON_BY_AREA, this, p) != 0;
    }
};
// EtendueBilinearPatch with its constructors and techniques.
struct BilinearPatch : EtendueBilinearPatch {
    BilinearPatch(Vec3 corner_, Vec3 edge_s_, Vec3 edge_t_, Vec3 diagonal_) : EtendueBilinearPatch{{corner_.x, corner_.y, corner_.z}, {edge_s_.x, edge_s_.y, edge_s_.z}, {edge_t_.x, edge_t_.y, edge_t_.z}, {diagonal_.x, diagonal_.y, diagonal_.z}} {}
    PatchByArea by_area(Vec3 at) const { return {*this, at}; }
};
// EtendueLine with its constructors and techniques.
struct Line : EtendueLine {
    Line(Vec3 start_, Vec3 edge_) : EtendueLine{{start_.x, start_.y, start_.z}, {edge_.x, edge_.y, edge_.z}} {}
    LineByLength by_length(Vec3 at) const { return {*this, at}; }
    LineByAngle by_angle(Vec3 at) const { return {*this, at}; }
    LineByProjectedSolidAngle by_projected_solid_angle(Vec3 at, Vec3 n) const { return {*this, at, n}; }
};
// EtendueSun with its constructors and techniques.
struct Sun : EtendueSun {
    Sun(Vec3 direction_, float one_minus_cos_) : EtendueSun{{direction_.x, direction_.y, direction_.z}, one_minus_cos_} {}
    // The same at every point.
    SunBySolidAngle by_solid_angle() const { return {*this, Vec3()}; }
};
// EtenduePointLight with its constructors and techniques.
struct PointLight : EtenduePointLight {
    PointLight(Vec3 position_) : EtenduePointLight{{position_.x, position_.y, position_.z}} {}
    PointLightByDelta by_delta(Vec3 at) const { return {*this, at}; }
};
// EtendueSpotLight with its constructors and techniques.
struct SpotLight : EtendueSpotLight {
    SpotLight(Vec3 position_, Vec3 axis_, float one_minus_cos_inner_, float one_minus_cos_outer_) : EtendueSpotLight{{position_.x, position_.y, position_.z}, {axis_.x, axis_.y, axis_.z}, one_minus_cos_inner_, one_minus_cos_outer_} {}
    SpotLightByDelta by_delta(Vec3 at) const { return {*this, at}; }
};
// EtendueDirectionalLight with its constructors and techniques.
struct DirectionalLight : EtendueDirectionalLight {
    DirectionalLight(Vec3 direction_) : EtendueDirectionalLight{{direction_.x, direction_.y, direction_.z}} {}
    // The same at every point.
    DirectionalLightByDelta by_delta() const { return {*this, Vec3()}; }
};
// end of what is from the list

// ---- light from an image ----

using EnvironmentMap = EtendueEnvironmentMap;

// Light from all around as an image tells it, in a table of the caller's, which must live as long as the environment is used: directions
// in proportion to the image, the same for all shading points. Before it is built, its samples have pdf 0.
class ImageEnvironment {
    EtendueImageEnvironment c_ = {};

  public:
    // Number of floats in the table of an image; 0 for a size that is not allowed.
    static size_t table(size_t width, size_t height) { return etendue_image_environment_table(width, height); }

    // Builds the table, of table(width, height) floats, from a weight for each texel, row by row, from the top.
    Status build(Span<const float> weights, size_t width, EnvironmentMap map, Span<float> table) {
        const size_t height = width == 0 ? 0 : weights.size() / width, floats = ImageEnvironment::table(width, height);
        if (floats == 0 || width * height != weights.size() || table.size() != floats) return ETENDUE_STATUS_COUNT;
        return etendue_image_environment_build(weights.data(), width, height, map, table.data(), &c_);
    }
    const EtendueImageEnvironment& c() const { return c_; }
    ETENDUE_SAMPLER_METHODS(etendue_image_environment)
};

// ---- pictures on lights ----

using PictureRegion = EtenduePictureRegion;

// Columns of lights with one picture.
template <class P, class C>
class PicturedColumns {
    EtenduePicture picture_;
    LightColumns<C> lights_;

  public:
    PicturedColumns(const EtenduePicture& picture, const LightColumns<C>& lights) : picture_(picture), lights_(lights) {}
    bool fits(size_t n) const { return lights_.fits(n); }
    P c() const { return {picture_, lights_.c()}; }
};
template <>
class LightColumns<EtenduePicturedParallelogramColumns>
    : public PicturedColumns<EtenduePicturedParallelogramColumns, EtendueParallelogramColumns> {
    using PicturedColumns::PicturedColumns;
};
template <>
class LightColumns<EtenduePicturedSphereColumns> : public PicturedColumns<EtenduePicturedSphereColumns, EtendueSphereColumns> {
    using PicturedColumns::PicturedColumns;
};
using PicturedParallelogramColumns = LightColumns<EtenduePicturedParallelogramColumns>;
using PicturedSphereColumns = LightColumns<EtenduePicturedSphereColumns>;

// A picture that is not built gives pdf 0.
ETENDUE_ANYWHERE(PictureByArea, PictureByArea, PicturedParallelogram, etendue_picture_by_area)
ETENDUE_ANYWHERE(PictureBySolidAngle, PictureBySolidAngle, PicturedParallelogram, etendue_picture_by_solid_angle)
ETENDUE_ON_SURFACE(PictureByProjectedSolidAngle, PictureByProjectedSolidAngle, PicturedParallelogram, etendue_picture_by_projected_solid_angle)
ETENDUE_ANYWHERE(PictureOnSphereByVisibleArea, PictureOnSphereByVisibleArea, PicturedSphere, etendue_picture_on_sphere_by_visible_area)

// A flat light with a picture.
struct PicturedParallelogram : EtenduePicturedParallelogram {
    PictureByArea by_area(Vec3 at) const { return {*this, at}; }
    PictureBySolidAngle by_solid_angle(Vec3 at) const { return {*this, at}; }
    PictureByProjectedSolidAngle by_projected_solid_angle(Vec3 at, Vec3 n) const { return {*this, at, n}; }
};
struct PicturedSphere : EtenduePicturedSphere {
    PictureOnSphereByVisibleArea by_visible_area(Vec3 at) const { return {*this, at}; }
};

// A picture for lights, in a table of the caller's, which must live as long as the picture is used.
class Picture {
    EtenduePicture c_ = {};

  public:
    // Number of floats in the table; 0 for a size that is not allowed, and for a single texel that is constant.
    static size_t table(size_t width, size_t height) { return etendue_picture_table(width, height); }
    static size_t interpolated_table(size_t width, size_t height) { return etendue_picture_interpolated_table(width, height); }

    // Builds the table, of table(width, height) floats, from the mean radiance of each texel, row by row.
    Status build(Span<const float> weights, size_t width, PictureRegion region, Span<float> table) {
        const size_t height = width == 0 ? 0 : weights.size() / width;
        if (width * height != weights.size() || table.size() != Picture::table(width, height)) return ETENDUE_STATUS_COUNT;
        return etendue_picture_build(weights.data(), width, height, region, table.data(), &c_);
    }
    // Builds the table, of interpolated_table(width, height) floats, of a picture that is interpolated between the values at the centres of
    // its texels, which must live as long, too.
    Status interpolate(Span<const float> values, size_t width, Span<float> table) {
        const size_t height = width == 0 ? 0 : values.size() / width, floats = interpolated_table(width, height);
        if (floats == 0 || width * height != values.size() || table.size() != floats) return ETENDUE_STATUS_COUNT;
        return etendue_picture_interpolate(values.data(), width, height, table.data(), &c_);
    }
    const EtenduePicture& c() const { return c_; }

    // The picture on a light, which must cover the region for which it was built.
    PicturedParallelogram on(const EtendueParallelogram& light) const { return {{c_, light}}; }
    PicturedParallelogram on(const EtendueRectangle& light) const { return on_flat(etendue_rectangle_coordinates, light); }
    PicturedParallelogram on(const EtendueTriangle& light) const { return on_flat(etendue_triangle_coordinates, light); }
    PicturedParallelogram on(const EtendueDisk& light) const { return on_flat(etendue_disk_coordinates, light); }
    PicturedSphere on(const EtendueSphere& light) const { return {{c_, light}}; }

  private:
    template <class Light>
    PicturedParallelogram on_flat(Status (*coordinates)(const Light*, EtendueParallelogram*), const Light& light) const {
        EtendueParallelogram parallelogram = {};
        coordinates(&light, &parallelogram);
        return on(parallelogram);
    }
};

// ---- the sky through portals ----

// A portal, with the map of its image.
struct Portal : EtenduePortal {
    Portal(Vec3 corner_, Vec3 s, Vec3 t) : EtenduePortal{{corner_.x, corner_.y, corner_.z}, {s.x, s.y, s.z}, {t.x, t.y, t.z}} {}
    // The direction at a position in the image, and the solid angle there per unit of its area.
    Vec3 direction(Vec2 uv, float* solid_angle = nullptr) const {
        detail::Row<3> w;
        etendue_portal_direction(this, detail::Row<2>(uv).v, w.v, solid_angle);
        return w.value();
    }
    Status direction(In<2> uv, Out<3> w, Span<float> solid_angle) const {
        using namespace detail;
        const size_t n = uv.size();
        if (!fits(uv, n) || !fits_or_absent(w, n) || !fits_or_absent(solid_angle, n)) return ETENDUE_STATUS_COUNT;
        return etendue_portal_direction_batch(this, n, Pointers<const float, 2>(uv).p, Pointers<float, 3>(w).p, pointer(solid_angle));
    }
};
// The sky in the coordinates of a portal, in a table of the caller's, which must live as long as it is used.
struct PortalTable : EtenduePortalTable {
    PortalTable() : EtenduePortalTable{} {}
    // Number of 64-bit words in the table of an image; 0 for a size that is not allowed.
    static size_t table(size_t width, size_t height) { return etendue_portal_table(width, height); }
    // Builds the table, of table(width, height) words, from the weight of each texel, row by row: radiance times solid angle.
    Status build(Span<const float> weights, size_t width, Span<uint64_t> table) {
        const size_t height = width == 0 ? 0 : weights.size() / width, words = PortalTable::table(width, height);
        if (words == 0 || width * height != weights.size() || table.size() != words) return ETENDUE_STATUS_COUNT;
        return etendue_portal_table_build(weights.data(), width, height, table.data(), this);
    }
};

template <>
class LightColumns<EtenduePortalEnvironment> {
    EtenduePortalEnvironment c_;

  public:
    LightColumns(const EtenduePortalEnvironment& environment) : c_(environment) {}
    bool fits(size_t) const { return true; }
    const EtenduePortalEnvironment& c() const { return c_; }
};
ETENDUE_ANYWHERE(PortalsByRadiance, PortalsByRadiance, PortalEnvironment, etendue_portals_by_radiance)

// The sky through at most 8 portals, with a table for each: both must live as long as the environment is used.
struct PortalEnvironment : EtenduePortalEnvironment {
    PortalEnvironment(Span<const Portal> portals_, Span<const PortalTable> tables_)
        : EtenduePortalEnvironment{portals_.data(), tables_.data(), portals_.size() == tables_.size() ? portals_.size() : 0} {
        static_assert(sizeof(Portal) == sizeof(EtenduePortal) && sizeof(PortalTable) == sizeof(EtenduePortalTable), "no other members");
    }
    PortalsByRadiance by_radiance(Vec3 at) const { return {*this, at}; }
    // Whether rays pass a portal towards the sky.
    Status sees(In<3> p, In<3> w, Span<uint8_t> out) const {
        using namespace detail;
        const size_t n = out.size();
        if (!fits(p, n) || !fits(w, n)) return ETENDUE_STATUS_COUNT;
        return etendue_portal_environment_sees_batch(this, n, Pointers<const float, 3>(p).p, Pointers<const float, 3>(w).p, out.data());
    }
};

// ---- warps ----

// One warp of two random numbers to P coordinates. SELF is its C struct, if it has one.
#define ETENDUE_WARP_METHODS(PREFIX, P, SELF)                                                                                          \
    using Point = detail::Row<P>::Value;                                                                                               \
    /* Maps random numbers to a point. */                                                                                              \
    Point sample(Vec2 u) const {                                                                                                       \
        detail::Row<P> point;                                                                                                          \
        PREFIX##_sample(SELF detail::Row<2>(u).v, point.v);                                                                            \
        return point.value();                                                                                                          \
    }                                                                                                                                  \
    /* The pdf at a point; 0 outside the range of the warp. */                                                                         \
    float pdf(Point point) const { return PREFIX##_pdf(SELF detail::Row<P>(point).v); }                                                \
    /* The random numbers that are mapped to a point. */                                                                               \
    Vec2 invert(Point point) const {                                                                                                   \
        detail::Row<2> u;                                                                                                              \
        PREFIX##_invert(SELF detail::Row<P>(point).v, u.v);                                                                            \
        return u.value();                                                                                                              \
    }                                                                                                                                  \
    Status sample(In<2> u, Out<P> points) const {                                                                                      \
        const size_t n = u.size();                                                                                                     \
        if (!detail::fits(u, n) || !detail::fits_or_absent(points, n)) return ETENDUE_STATUS_COUNT;                                    \
        return PREFIX##_sample_batch(SELF n, detail::Pointers<const float, 2>(u).p, detail::Pointers<float, P>(points).p);             \
    }                                                                                                                                  \
    Status pdf(In<P> points, Span<float> out) const {                                                                                  \
        const size_t n = points.size();                                                                                                \
        if (!detail::fits(points, n) || !detail::fits(out, n)) return ETENDUE_STATUS_COUNT;                                            \
        return PREFIX##_pdf_batch(SELF n, detail::Pointers<const float, P>(points).p, out.data());                                     \
    }                                                                                                                                  \
    Status invert(In<P> points, Out<2> u) const {                                                                                      \
        const size_t n = points.size();                                                                                                \
        if (!detail::fits(points, n) || !detail::fits_or_absent(u, n)) return ETENDUE_STATUS_COUNT;                                    \
        return PREFIX##_invert_batch(SELF n, detail::Pointers<const float, P>(points).p, detail::Pointers<float, 2>(u).p);             \
    }
#define ETENDUE_FIXED_WARP(NAME, PREFIX, P)                                                                                            \
    struct NAME {                                                                                                                      \
        ETENDUE_WARP_METHODS(PREFIX, P, )                                                                                              \
    };
#define ETENDUE_WARP(PREFIX, P) ETENDUE_WARP_METHODS(PREFIX, P, this ETENDUE_COMMA)

// warps from the list of techniques: WRITE=1 cargo test -p etendue-tests bindings
// Points of the unit disk, uniform in area (pdf 1/pi), by concentric squares: keeps strata compact.
ETENDUE_FIXED_WARP(ConcentricDisk, etendue_concentric_disk, 2)
// Directions with z >= 0, uniform in solid angle: pdf 1/(2pi) per steradian.
ETENDUE_FIXED_WARP(UniformHemisphere, etendue_uniform_hemisphere, 3)
// Directions, uniform in solid angle: pdf 1/(4pi) per steradian.
ETENDUE_FIXED_WARP(UniformSphere, etendue_uniform_sphere, 3)
// Directions with z >= 0 and the pdf z/pi per steradian.
ETENDUE_FIXED_WARP(CosineHemisphere, etendue_cosine_hemisphere, 3)
// Directions, uniform in solid angle, by a nearly continuous map: pdf 1/(4pi) per steradian.
ETENDUE_FIXED_WARP(Octahedral, etendue_octahedral, 3)
// Barycentric coordinates of the second and third vertex of a triangle, uniform in area: pdf 2.
ETENDUE_FIXED_WARP(AreaTriangle, etendue_area_triangle, 2)
// Barycentric coordinates of the second and third vertex of a triangle, by a map that keeps strata compact: pdf 2.
ETENDUE_FIXED_WARP(LowDistortionTriangle, etendue_low_distortion_triangle, 2)
// warps end of what is from the list

// Directions within an angle of +z, by 1 - cos of that angle.
struct Cone : EtendueCone {
    explicit Cone(float one_minus_cos_) : EtendueCone{one_minus_cos_} {}
    ETENDUE_WARP(etendue_cone, 3)
};
// Points of the unit square: relative densities at (0, 0), (1, 0), (0, 1) and (1, 1).
struct Bilinear : EtendueBilinear {
    Bilinear(float c00, float c10, float c01, float c11) : EtendueBilinear{{c00, c10, c01, c11}} {}
    ETENDUE_WARP(etendue_bilinear, 2)
};
// Visible normals of a GGX microsurface: roughnesses along x and y, and the unit direction to the viewer, where z is the normal.
struct GgxVisibleNormals : EtendueGgxVisibleNormals {
    GgxVisibleNormals(float alpha_x, float alpha_y, Vec3 wi) {
        etendue_ggx_visible_normals_prepare(alpha_x, alpha_y, detail::Row<3>(wi).v, this);
    }
    ETENDUE_WARP(etendue_ggx_visible_normals, 3)
};
// The lobe of a rough surface, by its roughness, its unit normal and the unit direction to the viewer: directions that it reflects there.
// Lights are prepared for it by_reflection. The fields albedo and schlick are those of the C struct.
struct Reflection : EtendueReflection {
    Reflection(float alpha, Vec3 normal, Vec3 view) : EtendueReflection{} {
        etendue_reflection_prepare(alpha, detail::Row<3>(normal).v, detail::Row<3>(view).v, this);
    }
    ETENDUE_WARP(etendue_reflection, 3)
    // The projected solid angle after the map of a sphere with this centre relative to the point: pi times the part of the lobe that it covers.
    float sphere(Vec3 center, float radius) const { return etendue_reflection_sphere(this, detail::Row<3>(center).v, radius); }
    Status sphere(In<3> centers, Span<const float> radii, Span<float> out) const {
        const size_t n = out.size();
        if (!detail::fits(centers, n) || !detail::fits(radii, n)) return ETENDUE_STATUS_COUNT;
        return etendue_reflection_sphere_batch(this, n, detail::Pointers<const float, 3>(centers).p, radii.data(), out.data());
    }
};
// A bilinear patch, by area.
struct PatchSurface : EtenduePatchSurface {
    PatchSurface(Vec3 corner, Vec3 s, Vec3 t, Vec3 opposite)
        : EtenduePatchSurface{{corner.x, corner.y, corner.z}, {s.x, s.y, s.z}, {t.x, t.y, t.z}, {opposite.x, opposite.y, opposite.z}} {}
    ETENDUE_WARP(etendue_patch_surface, 3)
};

// ---- sequences ----

// Which pairs of a sequence a batch needs: of one pixel and consecutive samples, unless there are columns of them.
struct Counters {
    uint32_t pixel = 0, sample = 0, dimension = 0;
    Span<const uint32_t> pixels = {}, samples = {};
};

#define ETENDUE_SEQUENCE(NAME, FUNCTION, FIELDS, ARGUMENTS)                                                                            \
    struct NAME {                                                                                                                      \
        FIELDS                                                                                                                         \
        /* One pair in [0, 1)^2. */                                                                                                    \
        Vec2 pair(uint32_t pixel, uint32_t sample, uint32_t dimension) const {                                                         \
            Vec2 u;                                                                                                                    \
            float* const out[2] = {&u.x, &u.y};                                                                                        \
            const EtendueCounters counters = {pixel, sample, dimension, nullptr, nullptr};                                             \
            FUNCTION(ARGUMENTS, &counters, 1, out);                                                                                    \
            return u;                                                                                                                  \
        }                                                                                                                              \
        Status pairs(const Counters& counters, Out<2> u) const {                                                                       \
            using namespace detail;                                                                                                    \
            const size_t n = u.size();                                                                                                 \
            if (!fits(u, n) || !fits_or_absent(counters.pixels, n) || !fits_or_absent(counters.samples, n)) return ETENDUE_STATUS_COUNT; \
            const EtendueCounters c = {counters.pixel, counters.sample, counters.dimension, pointer(counters.pixels),                  \
                                       pointer(counters.samples)};                                                                     \
            return FUNCTION(ARGUMENTS, &c, n, Pointers<float, 2>(u).p);                                                                \
        }                                                                                                                              \
    };
#define ETENDUE_SEEDED(NAME, FUNCTION) ETENDUE_SEQUENCE(NAME, FUNCTION, uint64_t seed = 0;, seed)
#define ETENDUE_COUNTED(NAME, FUNCTION)                                                                                                \
    ETENDUE_SEQUENCE(NAME, FUNCTION, uint64_t seed = 0; uint32_t count = 1;, seed ETENDUE_COMMA count)

ETENDUE_SEEDED(Independent, etendue_independent_pairs)
ETENDUE_SEEDED(OwenSobol, etendue_owen_sobol_pairs)
ETENDUE_SEEDED(JointSobol, etendue_joint_sobol_pairs)
// `count` is the number of samples of a pixel
ETENDUE_COUNTED(Stratified, etendue_stratified_pairs)

// ---- trees of lights ----

using LightBound = EtendueLightBound;
using LightTreeNode = EtendueLightTreeNode;

// A light that a tree chose: UINT32_MAX with pmf 0 where none can contribute. `u` is what is left of the random number.
struct Choice {
    uint32_t light = UINT32_MAX;
    float pmf = 0, u = 0;
};
// Columns of chosen lights. Empty ones are not wanted.
struct ChoiceColumns {
    Span<uint32_t> light;
    Span<float> pmf, u;
};

// A tree of lights in the caller's memory, which must live as long as the tree is used.
class LightTree {
    EtendueLightTree c_ = {};

  public:
    // Number of nodes for so many lights.
    static size_t nodes(size_t lights) { return etendue_light_tree_nodes(lights); }

    // Builds the tree: `nodes` has nodes(lights.size()) elements, `places` as many as there are lights.
    Status build(Span<const LightBound> lights, Span<LightTreeNode> nodes, Span<uint32_t> places) {
        if (nodes.size() != LightTree::nodes(lights.size()) || places.size() != lights.size()) return ETENDUE_STATUS_COUNT;
        return etendue_light_tree_build(lights.data(), lights.size(), nodes.data(), places.data(), &c_);
    }
    const EtendueLightTree& c() const { return c_; }

    // Chooses a light for the point p of a surface with the unit normal n.
    Choice choose(Vec3 p, Vec3 n, float u) const {
        Choice out;
        const EtendueChoiceColumns columns = {&out.light, &out.pmf, &out.u};
        const float *const ps[3] = {&p.x, &p.y, &p.z}, *const ns[3] = {&n.x, &n.y, &n.z};
        etendue_light_tree_choose_batch(&c_, 1, ps, ns, &u, &columns);
        return out;
    }
    // The probability with which that light is chosen there.
    float pmf(Vec3 p, Vec3 n, uint32_t light) const {
        float out = 0;
        const float *const ps[3] = {&p.x, &p.y, &p.z}, *const ns[3] = {&n.x, &n.y, &n.z};
        etendue_light_tree_pmf_batch(&c_, 1, ps, ns, &light, &out);
        return out;
    }
    Status choose(In<3> p, In<3> n, Span<const float> u, const ChoiceColumns& out) const {
        using namespace detail;
        const size_t count = u.size();
        if (!fits(p, count) || !fits(n, count)) return ETENDUE_STATUS_COUNT;
        if (!fits_or_absent(out.light, count) || !fits_or_absent(out.pmf, count) || !fits_or_absent(out.u, count)) return ETENDUE_STATUS_COUNT;
        const EtendueChoiceColumns columns = {pointer(out.light), pointer(out.pmf), pointer(out.u)};
        return etendue_light_tree_choose_batch(&c_, count, Pointers<const float, 3>(p).p, Pointers<const float, 3>(n).p, u.data(), &columns);
    }
    Status pmf(In<3> p, In<3> n, Span<const uint32_t> lights, Span<float> out) const {
        using namespace detail;
        const size_t count = lights.size();
        if (!fits(p, count) || !fits(n, count) || !fits(out, count)) return ETENDUE_STATUS_COUNT;
        return etendue_light_tree_pmf_batch(&c_, count, Pointers<const float, 3>(p).p, Pointers<const float, 3>(n).p, lights.data(), out.data());
    }
};

// ---- sets of lights ----

using Which = EtendueWhich;
using LightsSample = EtendueLightsSample;
using Side = EtendueSide;

namespace detail {
constexpr uint32_t kind(const EtendueSphere*) { return ETENDUE_LIGHT_KIND_SPHERE; }
constexpr uint32_t kind(const EtendueTriangle*) { return ETENDUE_LIGHT_KIND_TRIANGLE; }
constexpr uint32_t kind(const EtendueParallelogram*) { return ETENDUE_LIGHT_KIND_PARALLELOGRAM; }
constexpr uint32_t kind(const EtendueRectangle*) { return ETENDUE_LIGHT_KIND_RECTANGLE; }
constexpr uint32_t kind(const EtendueDisk*) { return ETENDUE_LIGHT_KIND_DISK; }
constexpr uint32_t kind(const EtenduePolygon*) { return ETENDUE_LIGHT_KIND_POLYGON; }
constexpr uint32_t kind(const EtendueBilinearPatch*) { return ETENDUE_LIGHT_KIND_BILINEAR_PATCH; }
constexpr uint32_t kind(const EtendueLine*) { return ETENDUE_LIGHT_KIND_LINE; }
constexpr uint32_t kind(const EtendueSun*) { return ETENDUE_LIGHT_KIND_SUN; }
constexpr uint32_t kind(const EtenduePointLight*) { return ETENDUE_LIGHT_KIND_POINT_LIGHT; }
constexpr uint32_t kind(const EtendueSpotLight*) { return ETENDUE_LIGHT_KIND_SPOT_LIGHT; }
constexpr uint32_t kind(const EtendueDirectionalLight*) { return ETENDUE_LIGHT_KIND_DIRECTIONAL_LIGHT; }
} // namespace detail

// A light of a set, with its radiance: see EtendueEmitter. The light must live until the set is built.
struct Emitter : EtendueEmitter {
    // A sky of one radiance.
    explicit Emitter(float radiance_) : EtendueEmitter{nullptr, 1, ETENDUE_LIGHT_KIND_CONSTANT_ENVIRONMENT, 0, {0, 0, 0}, radiance_} {}
    Emitter(const ImageEnvironment& sky, float radiance_) : EtendueEmitter{&sky.c(), 1, ETENDUE_LIGHT_KIND_IMAGE_ENVIRONMENT, 0, {0, 0, 0}, radiance_} {}
    template <class L, uint32_t KIND = detail::kind(static_cast<const L*>(nullptr))>
    Emitter(const L& light_, float radiance_) : EtendueEmitter{&light_, 1, KIND, 0, {0, 0, 0}, radiance_} {}
    // One light of several parts, such as the triangles of a mesh.
    template <class L, uint32_t KIND = detail::kind(static_cast<const L*>(nullptr))>
    Emitter(Span<const L> lights, float radiance_) : EtendueEmitter{lights.data(), lights.size(), KIND, 0, {0, 0, 0}, radiance_} {}

    // The same, which emits from both sides.
    Emitter both_sides() const {
        Emitter same = *this;
        same.two_sided = 1;
        return same;
    }
    // The same, which emits from the side to which the normal points.
    Emitter towards(Vec3 normal) const {
        Emitter same = *this;
        for (int i = 0; i < 3; i++) same.facing[i] = normal[i];
        return same;
    }
};
static_assert(sizeof(Emitter) == sizeof(EtendueEmitter));

// A set prepared for a receiver, for one thread; the set must live as long.
class LightsAt {
    EtendueLightsAt c_;
    Status status_;

  public:
    LightsAt(const EtendueLights* lights, const EtendueReceiver& receiver) : status_(etendue_lights_at(lights, &receiver, &c_)) {}

    // A sample by three numbers in [0, 1): the first one chooses the light, the others a direction to it. pdf 0 where there is none.
    LightsSample sample(float u0, float u1, float u2) {
        LightsSample out = {};
        const float u[3] = {u0, u1, u2};
        if (status_ == ETENDUE_STATUS_OK) etendue_lights_sample(&c_, u, &out);
        return out;
    }
    // The pdf with which a unit direction is drawn as one of that light.
    float pdf(Which which, Vec3 w) {
        const float direction[3] = {w.x, w.y, w.z};
        return status_ == ETENDUE_STATUS_OK ? etendue_lights_pdf(&c_, which, direction) : 0;
    }
};

// A set of lights of any kind, on the heap: it owns copies of its lights. Before it is built, its samples have pdf 0.
class Lights {
    EtendueLights* c_ = nullptr;

  public:
    Lights() = default;
    Lights(Lights&& other) noexcept : c_(std::exchange(other.c_, nullptr)) {}
    Lights& operator=(Lights&& other) noexcept {
        std::swap(c_, other.c_);
        return *this;
    }
    ~Lights() { etendue_lights_free(c_); }

    // Builds the set anew; where that fails, it is what it was.
    Status build(Span<const Emitter> lights) {
        Lights fresh;
        const Status status = etendue_lights_create(lights.size(), lights.data(), &fresh.c_);
        if (status == ETENDUE_STATUS_OK) std::swap(c_, fresh.c_);
        return status;
    }
    // For a point of a surface with the unit normal n, on its side; `on` is the light on which the point is.
    LightsAt at(Vec3 p, Vec3 n, const Which* on = nullptr) const { return {c_, {{p.x, p.y, p.z}, {n.x, n.y, n.z}, ETENDUE_SIDE_SURFACE, on}}; }
    // For a point that gathers light from both sides of a surface, or from all around.
    LightsAt at(Vec3 p, Side side, const Which* on = nullptr) const { return {c_, {{p.x, p.y, p.z}, {0, 0, 0}, uint32_t(side), on}}; }
};

// The instructions that batches use on this processor: 0, 3 or 4, see etendue_level.
inline uint32_t level() { return etendue_level(); }

// ---- the functions of pbrt-v4 ----
//
// Names, arguments and results are pbrt's, so that a host can replace one function at a time. Samples and inverses agree with each other,
// but not with pbrt's for the same u: replace both of a pair. Where there is no sample, pdf is 0 and the result zeros.

// What pbrt takes as an array or a span may be an array of any kind, or a list in braces.

namespace detail {
template <class T>
using IsIndexed = std::enable_if_t<HasIndex<T>::value, int>;
} // namespace detail

// Barycentric coordinates of a point of the triangle v[0], v[1], v[2], uniform in the solid angle at p.
template <class Vertices>
Vec3 SampleSphericalTriangle(const Vertices& v, Vec3 p, Vec2 u, float* pdf = nullptr) {
    const LightSample s = Triangle::from_vertices(v[0], v[1], v[2]).by_solid_angle(p).sample(u);
    if (pdf) *pdf = s.pdf;
    if (!(s.pdf > 0)) return {};
    return {1 - s.uv[0] - s.uv[1], s.uv[0], s.uv[1]};
}
template <class Vertex>
Vec3 SampleSphericalTriangle(const Vertex (&v)[3], Vec3 p, Vec2 u, float* pdf = nullptr) {
    return SampleSphericalTriangle(static_cast<const Vertex*>(v), p, u, pdf);
}
// The random numbers of the unit direction w.
template <class Vertices>
Vec2 InvertSphericalTriangleSample(const Vertices& v, Vec3 p, Vec3 w) {
    return Triangle::from_vertices(v[0], v[1], v[2]).by_solid_angle(p).invert(w);
}
template <class Vertex>
Vec2 InvertSphericalTriangleSample(const Vertex (&v)[3], Vec3 p, Vec3 w) {
    return InvertSphericalTriangleSample(static_cast<const Vertex*>(v), p, w);
}
// A point of the rectangle s + a ex + b ey, uniform in the solid angle at pRef.
inline Vec3 SampleSphericalRectangle(Vec3 pRef, Vec3 s, Vec3 ex, Vec3 ey, Vec2 u, float* pdf = nullptr) {
    const LightSample sample = Rectangle(s, ex, ey).by_solid_angle(pRef).sample(u);
    if (pdf) *pdf = sample.pdf;
    if (!(sample.pdf > 0)) return {};
    const float a = sample.uv[0], b = sample.uv[1];
    return {s.x + a * ex.x + b * ey.x, s.y + a * ex.y + b * ey.y, s.z + a * ex.z + b * ey.z};
}
// The random numbers of the point pRect of the rectangle.
inline Vec2 InvertSphericalRectangleSample(Vec3 pRef, Vec3 s, Vec3 ex, Vec3 ey, Vec3 pRect) {
    const Vec3 d = {pRect.x - pRef.x, pRect.y - pRef.y, pRect.z - pRef.z};
    const float length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    return Rectangle(s, ex, ey).by_solid_angle(pRef).invert({d.x / length, d.y / length, d.z / length});
}

inline Vec3 SampleUniformSphere(Vec2 u) { return UniformSphere().sample(u); }
inline float UniformSpherePDF() { return 0.0795774715f; }
inline Vec2 InvertUniformSphereSample(Vec3 w) { return UniformSphere().invert(w); }

inline Vec3 SampleUniformHemisphere(Vec2 u) { return UniformHemisphere().sample(u); }
inline float UniformHemispherePDF() { return 0.159154943f; }
inline Vec2 InvertUniformHemisphereSample(Vec3 w) { return UniformHemisphere().invert(w); }

inline Vec3 SampleCosineHemisphere(Vec2 u) { return CosineHemisphere().sample(u); }
inline float CosineHemispherePDF(float cosTheta) { return cosTheta * 0.318309886f; }
inline Vec2 InvertCosineHemisphereSample(Vec3 w) { return CosineHemisphere().invert(w); }

// These take the cosine, as pbrt's do, of which small angles leave few digits: there, use Cone, which takes 1 - cos.
inline Vec3 SampleUniformCone(Vec2 u, float cosThetaMax) { return Cone(1 - cosThetaMax).sample(u); }
inline float UniformConePDF(float cosThetaMax) { return 0.159154943f / (1 - cosThetaMax); }
inline Vec2 InvertUniformConeSample(Vec3 w, float cosThetaMax) { return Cone(1 - cosThetaMax).invert(w); }

inline Vec2 SampleUniformDiskConcentric(Vec2 u) { return ConcentricDisk().sample(u); }
inline Vec2 InvertUniformDiskConcentricSample(Vec2 p) { return ConcentricDisk().invert(p); }

// Barycentric coordinates of all three vertices.
inline Vec3 SampleUniformTriangle(Vec2 u) {
    const Vec2 b = LowDistortionTriangle().sample(u);
    return {1 - b.x - b.y, b.x, b.y};
}
inline Vec2 InvertUniformTriangleSample(Vec3 b) { return LowDistortionTriangle().invert({b.y, b.z}); }
template <class Barycentric, detail::IsIndexed<Barycentric> = 0>
Vec2 InvertUniformTriangleSample(const Barycentric& b) {
    return LowDistortionTriangle().invert({float(b[1]), float(b[2])});
}

// `w` are four densities, in pbrt's order: at (0, 0), (1, 0), (0, 1) and (1, 1).
template <class Weights>
Vec2 SampleBilinear(Vec2 u, const Weights& w) {
    return Bilinear(w[0], w[1], w[2], w[3]).sample(u);
}
template <class Weights>
float BilinearPDF(Vec2 p, const Weights& w) {
    return Bilinear(w[0], w[1], w[2], w[3]).pdf(p);
}
template <class Weights>
Vec2 InvertBilinearSample(Vec2 p, const Weights& w) {
    return Bilinear(w[0], w[1], w[2], w[3]).invert(p);
}
inline Vec2 SampleBilinear(Vec2 u, const float (&w)[4]) { return Bilinear(w[0], w[1], w[2], w[3]).sample(u); }
inline float BilinearPDF(Vec2 p, const float (&w)[4]) { return Bilinear(w[0], w[1], w[2], w[3]).pdf(p); }
inline Vec2 InvertBilinearSample(Vec2 p, const float (&w)[4]) { return Bilinear(w[0], w[1], w[2], w[3]).invert(p); }

#undef ETENDUE_TECHNIQUE
#undef ETENDUE_ANYWHERE
#undef ETENDUE_ON_SURFACE
#undef ETENDUE_REFLECTED
#undef ETENDUE_WARP_METHODS
#undef ETENDUE_FIXED_WARP
#undef ETENDUE_WARP
#undef ETENDUE_SEQUENCE
#undef ETENDUE_SEEDED
#undef ETENDUE_COUNTED
#undef ETENDUE_COMMA

} // namespace etendue

#endif // ETENDUE_HPP
