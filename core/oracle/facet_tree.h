#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/vec3.h"

namespace ptb {

struct PathRay {
    Vec3 origin, direction;  ///< direction of unit length
};

struct FacetBox {
    Vec3 low, high;
};

/// Finds the boxes that a ray goes through, those of a scene's triangles: halves of halves, each cut where
/// the surface area heuristic finds it best. Which box a ray goes through is up to rounding; they are to be
/// larger than what they hold by more than that.
class FacetTree {
  public:
    FacetTree() = default;
    explicit FacetTree(std::span<const FacetBox> boxes);

    /// Calls `meet(numbers)` with a few boxes at a time, by their numbers, until all that the ray enters
    /// within `reach` were named. `reach` may shrink meanwhile.
    template <class Meet>
    void along(const PathRay& ray, const double& reach, Meet&& meet) const;

    static constexpr int depth_most = 64;  ///< of cuts by the heuristic; below them halves are equal

  private:
    struct Node {
        FacetBox box;
        std::uint32_t first = 0;  ///< of a leaf, in `numbers_`; else the second child: the first one is next
        std::uint32_t count = 0;  ///< of a leaf's numbers; else 0
        int axis = 0;             ///< of the cut
    };

    void grow(std::span<const FacetBox> boxes, std::uint32_t begin, std::uint32_t end, int depth);

    std::vector<Node> nodes_;
    std::vector<int> numbers_;
};

/// Asks boxes whether a ray goes through them.
class BoxTest {
  public:
    explicit BoxTest(const PathRay& ray)
        : origin_{ray.origin.x, ray.origin.y, ray.origin.z},
          inverse_{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z} {}

    bool goes_back(int axis) const { return inverse_[static_cast<std::size_t>(axis)] < 0; }

    bool enters(const FacetBox& box, double reach) const {
        double begin = 0, end = reach;
        clip(0, box.low.x, box.high.x, begin, end);
        clip(1, box.low.y, box.high.y, begin, end);
        clip(2, box.low.z, box.high.z, begin, end);
        return begin <= end;
    }

  private:
    /// Narrows [begin, end] to where the ray is between two planes. Of a ray in one of them, and along it,
    /// 0 x infinity changes nothing.
    void clip(std::size_t axis, double low, double high, double& begin, double& end) const {
        const bool back = inverse_[axis] < 0;
        const double entry = ((back ? high : low) - origin_[axis]) * inverse_[axis];
        const double exit = ((back ? low : high) - origin_[axis]) * inverse_[axis];
        if (entry > begin) begin = entry;
        if (exit < end) end = exit;
    }

    std::array<double, 3> origin_, inverse_;
};

template <class Meet>
void FacetTree::along(const PathRay& ray, const double& reach, Meet&& meet) const {
    if (nodes_.empty()) return;
    const BoxTest test(ray);
    std::array<std::uint32_t, depth_most + 32> waiting;  // NOLINT: a number is written before it is read
    std::size_t height = 0;
    waiting[height++] = 0;
    while (height > 0) {
        const std::uint32_t number = waiting[--height];
        const Node& node = nodes_[number];
        if (!test.enters(node.box, reach)) continue;
        if (node.count > 0) {
            meet(std::span(numbers_).subspan(node.first, node.count));
        } else {
            const bool back = test.goes_back(node.axis);
            waiting[height++] = back ? number + 1 : node.first;
            waiting[height++] = back ? node.first : number + 1;
        }
    }
}

}  // namespace ptb
