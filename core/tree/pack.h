#pragma once

#include <span>

#include "core/tree/binary_tree.h"
#include "core/tree/tree.h"

namespace ptb::tree {

/// Boxes as trees have them: in scene units, and so much larger that rounding of a ray's way loses nothing.
class Padding {
  public:
    /// By 2 units in the last place of the largest coordinate, its margin.
    Padding(const Soup& soup, const TreeSettings& settings);

    Box pad(const BinaryNode& node) const;

    float margin() const { return margin_; }
    float origin_most() const { return origin_most_; }
    float unit() const { return unit_; }

  private:
    float unit_, margin_, origin_most_;
};

/// What is packed, and what of it is needed.
struct Load {
    const BinaryTree& binary;
    std::span<const Triangle> triangles;
    const Padding& padding;
    Crew& crew;
};

/// Without facts. Throw std::logic_error where a leaf is larger than the layout's.
Tree pack2(const Load& load);
Tree pack2q(const Load& load);
Tree pack8(const Load& load);

/// Throws std::logic_error if a leaf of this many references is none of a layout.
void check_leaf(std::size_t count, std::size_t most);

}  // namespace ptb::tree
