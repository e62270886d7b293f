#include "core/tree/leaves.h"

#include <algorithm>

namespace ptb::tree {
namespace {

/// What going through a subtree costs, in half areas; and what it holds.
struct Subtree {
    float cost = 0;
    std::uint32_t references = 1;
    bool is_leaf = true;
};

float cost_of_leaf(const BinaryNode& node, std::uint32_t references, const LeafRules& rules) {
    const std::uint32_t tests = (references + rules.per_test - 1) / rules.per_test;
    return half_area(box_of(node)) * rules.test_cost * static_cast<float>(tests);
}

Subtree subtree_of(const BinaryNode& node, const Subtree& left, const Subtree& right,
                   const LeafRules& rules) {
    const std::uint32_t references = left.references + right.references;
    const float cost = half_area(box_of(node)) + left.cost + right.cost;
    const float as_leaf = cost_of_leaf(node, references, rules);
    if (references <= rules.most && as_leaf <= cost) return {as_leaf, references, true};
    return {cost, references, false};
}

std::vector<Subtree> price(const std::vector<BinaryNode>& nodes, const LeafRules& rules) {
    std::vector<Subtree> subtrees(nodes.size());
    for (std::size_t i = nodes.size(); i-- > 0;) {
        subtrees[i] = nodes[i].count > 0
                          ? Subtree{cost_of_leaf(nodes[i], 1, rules), 1, true}
                          : subtree_of(nodes[i], subtrees[i + 1], subtrees[i + nodes[i].link], rules);
    }
    return subtrees;
}

/// Moves `count` numbers down to `to`, each one once: both parts of a triangle may have come to one leaf.
/// Returns how many there are.
std::uint32_t keep_different(std::vector<std::uint32_t>& numbers, std::uint32_t from, std::uint32_t count,
                             std::uint32_t to) {
    const auto begin = numbers.begin() + to;
    auto end = begin;
    for (std::uint32_t i = from; i < from + count; ++i)
        if (std::find(begin, end, numbers[i]) == end) *end++ = numbers[i];
    return static_cast<std::uint32_t>(end - begin);
}

}  // namespace

LeafRules leaf_rules(TreeLayout layout, const TreeSettings& settings) {
    return layout == TreeLayout::wide8 ? LeafRules{8, 8, settings.cost.block}
                                       : LeafRules{TREE_LEAF_MOST, 1, settings.cost.triangle};
}

void gather_leaves(BinaryTree& tree, const LeafRules& rules) {
    const std::vector<Subtree> subtrees = price(tree.nodes, rules);
    std::vector<std::uint32_t> moved_to(tree.nodes.size());
    std::uint32_t kept = 0, read = 0, written = 0;  // nodes; references
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++kept) {
        BinaryNode& node = tree.nodes[kept] = tree.nodes[i];
        moved_to[i] = kept;
        if (!subtrees[i].is_leaf) {
            node.link += i;  // until all have moved
            ++i;
            continue;
        }
        const std::uint32_t references = subtrees[i].references;
        node.link = written;
        node.count = keep_different(tree.numbers, read, references, written);
        written += node.count;
        read += references;
        i += 2 * references - 1;
    }
    tree.nodes.resize(kept);
    tree.numbers.resize(written);
    for (std::uint32_t i = 0; i < kept; ++i)
        if (tree.nodes[i].count == 0) tree.nodes[i].link = moved_to[tree.nodes[i].link] - i;
}

}  // namespace ptb::tree
