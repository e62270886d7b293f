#include <algorithm>
#include <limits>

#include "core/tree/pack.h"

namespace ptb::tree {
namespace {

constexpr std::size_t width = 8;

/// Numbers of nodes of the binary tree that become children of one node.
struct Children {
    std::size_t node[width];
    std::size_t count = 0;
};

/// Opens the largest inner node until there are eight; or none is left.
Children open_largest(const std::vector<BinaryNode>& nodes, std::size_t root) {
    Children children{{root}, 1};
    while (children.count < width) {
        std::size_t* largest = nullptr;
        float area = -1;
        for (std::size_t i = 0; i < children.count; ++i) {
            const BinaryNode& node = nodes[children.node[i]];
            if (node.count > 0 || half_area(box_of(node)) <= area) continue;
            area = half_area(box_of(node));
            largest = &children.node[i];
        }
        if (!largest) break;
        const std::size_t opened = *largest;
        std::copy_backward(largest + 1, children.node + children.count, children.node + children.count + 1);
        *largest = opened + 1;
        *(largest + 1) = opened + nodes[opened].link;
        ++children.count;
    }
    return children;
}

TreeNode8 empty_node() {
    TreeNode8 node{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::fill_n(node.low[axis], width, infinity);  // unreachable
        std::fill_n(node.high[axis], width, infinity);
    }
    std::fill_n(node.link, width, TREE_NOTHING);
    return node;
}

/// Nodes are made depth first; leaves are noted and filled later.
class Collapse {
  public:
    explicit Collapse(const Load& load) : load_(load) {}

    std::uint32_t add(std::size_t root) {
        const auto& nodes = load_.binary.nodes;
        const Children children = open_largest(nodes, root);
        const auto number = static_cast<std::uint32_t>(tree.nodes8.size());
        tree.nodes8.push_back(empty_node());
        for (std::size_t i = 0; i < children.count; ++i)
            set_box(tree.nodes8[number], i, nodes[children.node[i]]);
        for (std::size_t i = 0; i < children.count; ++i)
            if (nodes[children.node[i]].count > 0)
                tree.nodes8[number].link[i] = add_leaf(nodes[children.node[i]]);
        for (std::size_t i = 0; i < children.count; ++i) {
            if (nodes[children.node[i]].count > 0) continue;
            const std::uint32_t child = add(children.node[i]);
            tree.nodes8[number].link[i] = child;
        }
        return number;
    }

    Tree tree;
    std::vector<const BinaryNode*> leaves;

  private:
    std::uint32_t add_leaf(const BinaryNode& leaf) {
        check_leaf(leaf.count, width);
        leaves.push_back(&leaf);
        return TREE_LEAF | static_cast<std::uint32_t>(leaves.size() - 1);
    }

    void set_box(TreeNode8& node, std::size_t place, const BinaryNode& child) const {
        const Box box = load_.padding.pad(child);
        for (int axis = 0; axis < 3; ++axis) {
            node.low[axis][place] = box.low[axis];
            node.high[axis][place] = box.high[axis];
        }
    }

    const Load& load_;
};

TreeBlock8 block_of(const Load& load, const BinaryNode& leaf) {
    TreeBlock8 block;
    for (auto& corner : block.corner)
        for (auto& coordinate : corner)
            std::fill_n(coordinate, width, std::numeric_limits<float>::quiet_NaN());
    std::fill_n(block.number, width, TREE_NOTHING);
    for (std::size_t i = 0; i < leaf.count; ++i) {
        const std::uint32_t number = load.binary.numbers[leaf.link + i];
        const auto& corners = load.triangles[number].corners;
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t axis = 0; axis < 3; ++axis) block.corner[c][axis][i] = corners[c][axis];
        block.number[i] = number;
    }
    return block;
}

}  // namespace

Tree pack8(const Load& load) {
    Collapse collapse(load);
    if (load.binary.nodes.empty())
        collapse.tree.nodes8.push_back(empty_node());
    else
        collapse.add(0);
    Tree& tree = collapse.tree;
    tree.blocks.resize(collapse.leaves.size());
    load.crew.for_chunks(tree.blocks.size(), 1u << 12, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) tree.blocks[i] = block_of(load, *collapse.leaves[i]);
    });
    return std::move(tree);
}

}  // namespace ptb::tree
