#pragma once

#include <vector>

#include "core/tree/crew.h"
#include "core/tree/reference.h"
#include "core/tree/settings.h"

namespace ptb::tree {

/// Depth first: a node's left child follows it. Boxes are in the soup's units.
struct BinaryNode {
    float low[3];
    std::uint32_t
        link;  ///< of an inner node: the right child's number less its own; of a leaf: first reference
    float high[3];
    std::uint32_t count;  ///< references of a leaf; 0: an inner node
};

/// A tree before it is laid out. Without triangles it has no nodes.
struct BinaryTree {
    std::vector<BinaryNode> nodes;
    std::vector<std::uint32_t> numbers;  ///< of triangles, as leaves refer to them
};

inline Box box_of(const BinaryNode& node) {
    return {Float4{node.low[0], node.low[1], node.low[2], 0},
            Float4{node.high[0], node.high[1], node.high[2], 0}};
}

/// Depth first trees grow at the end: a node, what is below it on the left, what is below it on the right.
std::size_t add_node(BinaryTree& tree, const Box& box);
void end_left_child(BinaryTree& tree, std::size_t node);
void add_to_leaf(BinaryTree& tree, std::uint32_t number);  ///< the last node

/// Down to leaves of one reference each.
BinaryTree build_binary_tree(const Soup& soup, const TreeSettings& settings, Crew& crew);

}  // namespace ptb::tree
