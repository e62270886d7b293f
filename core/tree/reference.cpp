#include "core/tree/reference.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace ptb::tree {
namespace {

/// Its largest coordinate by magnitude; infinity where one is not finite.
float largest_of(const Triangle& triangle) {
    float largest = 0;
    for (const auto& corner : triangle.corners)
        for (const float coordinate : corner) {
            const float magnitude = std::abs(coordinate);
            largest = magnitude <= largest ? largest : magnitude < infinity ? magnitude : infinity;
        }
    return largest;
}

float largest_of(std::span<const Triangle> triangles) {
    float largest = 0;
    for (const Triangle& triangle : triangles) largest = std::max(largest, largest_of(triangle));
    return largest;
}

[[noreturn]] void refuse_infinite(std::span<const Triangle> triangles) {
    const auto found = std::find_if(triangles.begin(), triangles.end(), [](const Triangle& triangle) {
        return largest_of(triangle) == infinity;
    });
    throw std::invalid_argument(
        fmt::format("triangle {}: a corner is not finite", found - triangles.begin()));
}

/// Where the edge meets the plane, rounded once.
Float4 meet(Float4 a, Float4 b, int axis, float plane) {
    const double way = (static_cast<double>(plane) - a[axis]) / (static_cast<double>(b[axis]) - a[axis]);
    Float4 point{};
    for (int i = 0; i < 3; ++i)
        point[i] = static_cast<float>(a[i] + way * (static_cast<double>(b[i]) - a[i]));
    return point;
}

}  // namespace

Soup::Soup(std::span<const Triangle> triangles, Crew& crew) : triangles_(triangles) {
    std::mutex mutex;
    crew.for_chunks(triangles.size(), 1u << 13, [&](std::size_t begin, std::size_t end) {
        const float largest = largest_of(triangles.subspan(begin, end - begin));
        const std::lock_guard lock(mutex);
        largest_ = std::max(largest_, largest);
    });
    if (largest_ == infinity) refuse_infinite(triangles);
    const int exponent = largest_ > 0 ? std::clamp(std::ilogb(largest_), -126, 126) : 0;
    unit_ = std::ldexp(1.0, exponent);
    scale_ = std::ldexp(1.0f, -exponent);
}

Reference Soup::whole(std::uint32_t number) const {
    Box box = nothing;
    for (std::size_t i = 0; i < 3; ++i) grow(box, corner(triangles_[number], i));
    return make_reference(box, number);
}

std::pair<Reference, Reference> Soup::cut(const Reference& reference, int axis, float plane) const {
    const Triangle& triangle = triangles_[reference.number()];
    Box below = nothing, above = nothing;
    Float4 a = corner(triangle, 2);
    for (std::size_t i = 0; i < 3; ++i) {
        const Float4 b = corner(triangle, i);
        if (b[axis] <= plane) grow(below, b);
        if (b[axis] >= plane) grow(above, b);
        if ((a[axis] < plane) != (b[axis] < plane) && a[axis] != plane && b[axis] != plane) {
            const Float4 on_plane = meet(a, b, axis, plane);
            grow(below, on_plane);
            grow(above, on_plane);
        }
        a = b;
    }
    below.high[axis] = std::min(below.high[axis], plane);
    above.low[axis] = std::max(above.low[axis], plane);
    return {make_reference(intersection(reference, below), reference.number()),
            make_reference(intersection(reference, above), reference.number())};
}

}  // namespace ptb::tree
