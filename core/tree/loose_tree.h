#pragma once

#include <array>
#include <vector>

#include "core/tree/binary_tree.h"

namespace ptb::tree {

/// A node that knows its parent and both children, so that it can move.
struct LooseNode {
    static constexpr std::uint32_t none = 0xffffffff;

    Box box;
    float half_area = 0;
    int height = 0;  ///< inner nodes on the longest way down, itself included
    std::uint32_t parent = none;
    std::array<std::uint32_t, 2> child = {none, none};
    std::uint32_t number = none;  ///< of a leaf's triangle

    bool leaf() const { return height == 0; }
};

/// A binary tree whose subtrees can be moved.
class LooseTree {
  public:
    explicit LooseTree(const BinaryTree& tree);

    std::size_t size() const { return nodes_.size(); }
    const LooseNode& operator[](std::uint32_t i) const { return nodes_[i]; }

    /// Nodes that have a grandparent.
    bool can_move(std::uint32_t i) const { return i != root_ && nodes_[i].parent != root_; }
    std::uint32_t sibling_of(std::uint32_t i) const {
        const auto& child = nodes_[nodes_[i].parent].child;
        return child[0] == i ? child[1] : child[0];
    }

    /// Whether `to` is not below the node, and the tree no deeper than allowed afterwards.
    bool may_move(std::uint32_t node, std::uint32_t to, int depth_most) const;

    /// Makes the node the sibling of `to`. Its parent goes along and becomes the parent of both; its old
    /// sibling takes the parent's place.
    void move(std::uint32_t node, std::uint32_t to);

    double inner_area() const;  ///< half of it, of all nodes that are no leaves

    /// Depth first again.
    BinaryTree tidy() const;

  private:
    void replace_child(std::uint32_t parent, std::uint32_t old, std::uint32_t child);
    void refit(std::uint32_t from);
    void append(std::uint32_t i, BinaryTree& tree) const;

    std::vector<LooseNode> nodes_;
    std::uint32_t root_ = 0;
};

}  // namespace ptb::tree
