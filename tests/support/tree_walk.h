#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "core/scene/vec3.h"
#include "core/tree/tree.h"

namespace ptb {

struct Ray {
    std::array<float, 3> origin, direction;
    std::uint32_t left = TREE_NOTHING;  ///< number of the triangle it leaves
};

/// What a ray met first, the lowest number of those at the same distance; and what that took.
struct Met {
    std::uint32_t number = TREE_NOTHING;
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t nodes = 0, tests = 0;  ///< steps; triangles or blocks
};

/// By the tree, boxes in single precision as kernels have them.
Met walk(const Tree& tree, const Ray& ray);

/// By looking at every triangle.
Met look_everywhere(std::span<const Triangle> triangles, const Ray& ray);

Vec3 to_vec3(const std::array<float, 3>& v);
Vec3 normal_of(const Triangle& triangle);  ///< not of unit length

/// From the point to which `from` leads in a cosine-weighted direction on this side of what it met.
Ray bounce(const Ray& from, const Met& met, const Triangle& triangle, double u, double v);

}  // namespace ptb
