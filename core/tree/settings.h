#pragma once

#include <compare>
#include <limits>

namespace ptb {

/// Object splits only, or also splits of space, which put a triangle on both sides.
enum class TreeMethod { sah, spatial };

/// How a tree is built.
struct TreeSettings {
    TreeMethod method = TreeMethod::spatial;
    bool size_axis = true;  ///< large boxes may be parted from small ones, as left is from right
    int bins = 16;          ///< of an axis, 2 to 32
    int depth_most = 40;    ///< inner nodes on the way to a triangle, 30 to 64: near it nodes are halved

    /// Largest coordinate, by magnitude, of where rays begin that begin on no triangle: a camera far away.
    /// Boxes grow with it.
    float origin_most = 0;

    /// A quantised tree is laid out in whole floats where its grid is coarser: TreeFacts::grid_growth.
    double grid_growth_most = std::numeric_limits<double>::infinity();

    struct Spatial {
        float alpha = 1e-3f;  ///< tried where the children's boxes share more than this of the root's area
        int depth_most = 32;  ///< not tried below it
        float room = 0.5f;    ///< most further references, per triangle; 0 to 3
        auto operator<=>(const Spatial&) const = default;
    } spatial;

    /// Subtrees are moved to better places, pass after pass while one gains.
    struct Reinsertion {
        int passes_most = 8;  ///< 0 to 100
        float gain_least =
            1e-3f;  ///< share of the inner nodes' area that makes another pass worth it; 0 to 1
        auto operator<=>(const Reinsertion&) const = default;
    } reinsertion;

    /// In node steps.
    struct Cost {
        float triangle = 1;  ///< of a test of a single triangle
        float block = 1;     ///< of a test of a block of eight
        auto operator<=>(const Cost&) const = default;
    } cost;

    auto operator<=>(const TreeSettings&) const = default;
};

/// Throws std::invalid_argument that names the first setting out of its range, with the range.
void check(const TreeSettings& settings);

}  // namespace ptb
