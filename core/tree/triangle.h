#pragma once

#include <array>
#include <compare>

namespace ptb {

/// Corners in world space, scene units, counter-clockwise seen from outside.
struct Triangle {
    std::array<std::array<float, 3>, 3> corners{};
    auto operator<=>(const Triangle&) const = default;
};

}  // namespace ptb
