#pragma once

#include "core/tree/pack.h"

namespace ptb::tree {

/// The grid coordinate of the plane of this number, at most 0xffff.
double plane(std::uint32_t number);

/// Planes of boxes by their numbers on a grid around a whole tree: see TreeNode2q. Its first and last planes
/// are the walls of the tree's box, so that walls of a room are on planes.
class PlaneGrid {
  public:
    explicit PlaneGrid(const Load& load);

    const TreeGrid& facts() const { return facts_; }

    /// The planes around a box on an axis, the low one's number in the lower half.
    std::uint32_t around(const Box& box, int axis) const;
    /// A box as large as these make it.
    Box rounded(const Box& box) const;

  private:
    double extent(const Box& box, int axis) const;
    double seen(float coordinate, int axis) const;  ///< in grid coordinates

    double unit_;
    TreeGrid facts_{};
};

/// TreeFacts::grid_growth of what pack2q makes; infinite where the grid holds no box.
double grid_growth(const Load& load);

}  // namespace ptb::tree
