// What the functions use of the standard library of Metal, for a C++ compiler.
#include <cmath>
#include <cstdint>
#include <cstring>

// where variables are
#define device
#define constant const

namespace metal {
using uint = std::uint32_t;
struct float2 {
    float x, y;
};
struct float3 {
    float x, y, z;
};
inline float abs(float x) { return std::fabs(x); }
inline float sqrt(float x) { return std::sqrt(x); }
inline float rint(float x) { return std::rint(x); }
inline float fma(float a, float b, float c) { return std::fma(a, b, c); }
inline float clamp(float x, float least, float most) { return std::fmin(std::fmax(x, least), most); }
inline uint select(uint no, uint yes, bool mask) { return mask ? yes : no; }
inline uint min(uint a, uint b) { return a < b ? a : b; }
inline uint reverse_bits(uint k) {
    uint reversed = 0;
    for (int bit = 0; bit < 32; ++bit) {
        reversed |= (k >> bit & 1u) << (31 - bit);
    }
    return reversed;
}
} // namespace metal

template <class To, class From> To as_type(From from) {
    static_assert(sizeof(To) == sizeof(From), "the bits of one are those of the other");
    To to;
    std::memcpy(&to, &from, sizeof to);
    return to;
}

// as the program around the functions calls them
using etendue_shader_word = metal::uint;
using EtendueShaderVec2 = metal::float2;
using EtendueShaderVec3 = metal::float3;
inline metal::uint etendue_shader_bits(float x) { return as_type<metal::uint>(x); }
