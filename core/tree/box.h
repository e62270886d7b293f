#pragma once

#include <cstdint>
#include <limits>

namespace ptb::tree {

/// Four numbers that every CPU has an instruction for; GCC's and clang's own vectors.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 all(float value) { return Float4{value, value, value, value}; }
inline Float4 min(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 to_float(Int4 a) { return __builtin_convertvector(a, Float4); }
inline Int4 to_int(Float4 a) { return __builtin_convertvector(a, Int4); }

inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// Axis-parallel; what the last lanes hold is up to the user.
struct Box {
    Float4 low, high;
};

inline constexpr Box nothing{{infinity, infinity, infinity, infinity},
                             {-infinity, -infinity, -infinity, -infinity}};

inline void grow(Box& box, Float4 point) {
    box.low = min(box.low, point);
    box.high = max(box.high, point);
}

inline void grow(Box& box, const Box& other) {
    box.low = min(box.low, other.low);
    box.high = max(box.high, other.high);
}

inline Box join(Box a, const Box& b) {
    grow(a, b);
    return a;
}

inline Box intersection(const Box& a, const Box& b) { return {max(a.low, b.low), min(a.high, b.high)}; }

/// Whether no point is in it.
inline bool empty(const Box& box) {
    return box.low[0] > box.high[0] || box.low[1] > box.high[1] || box.low[2] > box.high[2];
}

/// Half of its surface; 0 of an empty box.
inline float half_area(const Box& box) {
    const Float4 edge = max(box.high - box.low, all(0));
    return edge[0] * edge[1] + edge[1] * edge[2] + edge[2] * edge[0];
}

/// Of four boxes at once.
inline Float4 half_areas(const Box (&box)[4]) {
    Float4 edge[4];
    for (int i = 0; i < 4; ++i) edge[i] = max(box[i].high - box[i].low, all(0));
    const Float4 xy01 = __builtin_shufflevector(edge[0], edge[1], 0, 4, 1, 5);
    const Float4 xy23 = __builtin_shufflevector(edge[2], edge[3], 0, 4, 1, 5);
    const Float4 z01 = __builtin_shufflevector(edge[0], edge[1], 2, 6, 3, 7);
    const Float4 z23 = __builtin_shufflevector(edge[2], edge[3], 2, 6, 3, 7);
    const Float4 x = __builtin_shufflevector(xy01, xy23, 0, 1, 4, 5);
    const Float4 y = __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7);
    const Float4 z = __builtin_shufflevector(z01, z23, 0, 1, 4, 5);
    return x * y + y * z + z * x;
}

}  // namespace ptb::tree
