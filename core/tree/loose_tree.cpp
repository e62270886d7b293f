#include "core/tree/loose_tree.h"

#include <algorithm>

namespace ptb::tree {

LooseTree::LooseTree(const BinaryTree& tree) : nodes_(tree.nodes.size()) {
    for (auto i = static_cast<std::uint32_t>(nodes_.size()); i-- > 0;) {
        LooseNode& node = nodes_[i];
        node.box = box_of(tree.nodes[i]);
        node.half_area = half_area(node.box);
        if (tree.nodes[i].count > 0) {
            node.number = tree.numbers[tree.nodes[i].link];
            continue;
        }
        node.child = {i + 1, i + tree.nodes[i].link};
        for (const std::uint32_t child : node.child) {
            nodes_[child].parent = i;
            node.height = std::max(node.height, nodes_[child].height + 1);
        }
    }
}

bool LooseTree::may_move(std::uint32_t node, std::uint32_t to, int depth_most) const {
    int depth = std::max(nodes_[node].height, nodes_[to].height) + 1;
    for (std::uint32_t i = to; i != LooseNode::none; i = nodes_[i].parent) {
        if (i == node) return false;
        if (i != to) ++depth;
    }
    return depth <= depth_most;
}

void LooseTree::move(std::uint32_t node, std::uint32_t to) {
    const std::uint32_t parent = nodes_[node].parent, sibling = sibling_of(node);
    const std::uint32_t grandparent = nodes_[parent].parent;
    replace_child(grandparent, parent, sibling);
    replace_child(nodes_[to].parent, to, parent);
    nodes_[parent].child = {to, node};
    nodes_[to].parent = parent;
    refit(grandparent);
    refit(parent);
}

/// Of no parent: the root.
void LooseTree::replace_child(std::uint32_t parent, std::uint32_t old, std::uint32_t child) {
    nodes_[child].parent = parent;
    if (parent == LooseNode::none)
        root_ = child;
    else
        *std::find(nodes_[parent].child.begin(), nodes_[parent].child.end(), old) = child;
}

void LooseTree::refit(std::uint32_t from) {
    for (std::uint32_t i = from; i != LooseNode::none; i = nodes_[i].parent) {
        LooseNode& node = nodes_[i];
        const LooseNode &first = nodes_[node.child[0]], &second = nodes_[node.child[1]];
        node.box = join(first.box, second.box);
        node.half_area = half_area(node.box);
        node.height = std::max(first.height, second.height) + 1;
    }
}

double LooseTree::inner_area() const {
    double sum = 0;
    for (const LooseNode& node : nodes_)
        if (!node.leaf()) sum += static_cast<double>(node.half_area);
    return sum;
}

BinaryTree LooseTree::tidy() const {
    BinaryTree tree;
    tree.nodes.reserve(nodes_.size());
    tree.numbers.reserve(nodes_.size() / 2 + 1);
    append(root_, tree);
    return tree;
}

void LooseTree::append(std::uint32_t i, BinaryTree& tree) const {
    const auto number = add_node(tree, nodes_[i].box);
    if (nodes_[i].leaf()) return add_to_leaf(tree, nodes_[i].number);
    append(nodes_[i].child[0], tree);
    end_left_child(tree, number);
    append(nodes_[i].child[1], tree);
}

}  // namespace ptb::tree
