#include "core/tree/facts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "core/tree/plane_grid.h"

namespace ptb::tree {
namespace {

/// In double precision, since areas of large scenes overflow.
struct Bounds {
    std::array<double, 3> low, high;
};

struct Below {
    std::uint32_t link;
    Bounds bounds;
};

Bounds bounds_of(const ptb_float4& centre, const ptb_float4& half) {
    const auto corner = [&](double side) {
        return std::array{centre.x + side * half.x, centre.y + side * half.y, centre.z + side * half.z};
    };
    return {corner(-1), corner(1)};
}

/// By the lower and the upper halves of three words.
Bounds bounds_of(const TreeGrid& grid, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const auto corner = [&](unsigned shift) {
        const auto from_corner = [&](std::uint32_t planes) { return plane(planes >> shift & 0xffffu) - 0.5; };
        return std::array{from_corner(x) / grid.cells.x, from_corner(y) / grid.cells.y,
                          from_corner(z) / grid.cells.z};
    };
    return {corner(0), corner(16)};
}

std::array<Below, 2> children_of(const Tree&, const TreeNode2& node) {
    return {
        Below{std::bit_cast<std::uint32_t>(node.centre0_link.w), bounds_of(node.centre0_link, node.half0)},
        Below{std::bit_cast<std::uint32_t>(node.centre1_link.w), bounds_of(node.centre1_link, node.half1)}};
}

/// Seen from the grid's own corner.
std::array<Below, 2> children_of(const Tree& tree, const TreeNode2q& node) {
    return {Below{node.link0, bounds_of(tree.grid, node.x0, node.y0, node.z0)},
            Below{node.link1, bounds_of(tree.grid, node.x1, node.y1, node.z1)}};
}

std::array<Below, 8> children_of(const Tree&, const TreeNode8& node) {
    std::array<Below, 8> children{};
    for (std::size_t i = 0; i < 8; ++i) {
        children[i].link = node.link[i];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            children[i].bounds.low[axis] = node.low[axis][i];
            children[i].bounds.high[axis] = node.high[axis][i];
        }
    }
    return children;
}

double area(const Bounds& b) {
    const double x = b.high[0] - b.low[0], y = b.high[1] - b.low[1], z = b.high[2] - b.low[2];
    return x * y + y * z + z * x;
}

template <class Node>
Bounds around(const Tree& tree, const Node& node) {
    constexpr double far = std::numeric_limits<double>::infinity();
    Bounds bounds{{far, far, far}, {-far, -far, -far}};
    for (const Below& child : children_of(tree, node)) {
        if (child.link == TREE_NOTHING) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            bounds.low[axis] = std::min(bounds.low[axis], child.bounds.low[axis]);
            bounds.high[axis] = std::max(bounds.high[axis], child.bounds.high[axis]);
        }
    }
    return bounds;
}

/// How deep it goes, and how many links wait for it.
struct Extent {
    int depth = 0, stack_most = 0;
};

template <class Node>
Extent extent_of(const Tree& tree, const std::vector<Node>& nodes, std::uint32_t node) {
    Extent extent;
    int children = 0;
    for (const Below& child : children_of(tree, nodes[node])) {
        if (child.link == TREE_NOTHING) continue;
        ++children;
        if (child.link & TREE_LEAF) continue;
        const Extent below = extent_of(tree, nodes, child.link);
        extent.depth = std::max(extent.depth, below.depth);
        extent.stack_most = std::max(extent.stack_most, below.stack_most);
    }
    return {extent.depth + 1, extent.stack_most + std::max(0, children - 1)};
}

/// Tests that a leaf takes: of single triangles, or one of a block.
int tests_of(const TreeNode8&, std::uint32_t) { return 1; }
template <class Node>
int tests_of(const Node&, std::uint32_t link) {
    return static_cast<int>(link % TREE_LEAF_MOST) + 1;
}

template <class Node>
TreeFacts facts_of_nodes(const Tree& tree, const std::vector<Node>& nodes, double test_cost) {
    TreeFacts facts;
    facts.nodes = nodes.size();
    double work = 0;  // area times cost
    for (const Node& node : nodes) {
        for (const Below& child : children_of(tree, node)) {
            if (child.link == TREE_NOTHING) continue;
            const bool leaf = (child.link & TREE_LEAF) != 0;
            facts.leaves += leaf ? 1 : 0;
            work += area(child.bounds) * (leaf ? test_cost * tests_of(node, child.link) : 1.0);
        }
    }
    const double whole = area(around(tree, nodes[0]));
    if (facts.leaves > 0) facts.sah_cost = 1 + (whole > 0 ? work / whole : 0);
    const Extent extent = extent_of(tree, nodes, 0);
    facts.depth = extent.depth;
    facts.stack_most = extent.stack_most;
    return facts;
}

std::size_t references_of(const Tree& tree) {
    std::size_t references = tree.triangles.size();
    for (const TreeBlock8& block : tree.blocks)
        for (const ptb_uint number : block.number) references += number != TREE_NOTHING ? 1 : 0;
    return references;
}

}  // namespace

TreeFacts facts_of(const Tree& tree, std::size_t triangles, const TreeSettings& settings) {
    TreeFacts facts = !tree.nodes8.empty()    ? facts_of_nodes(tree, tree.nodes8, settings.cost.block)
                      : !tree.nodes2q.empty() ? facts_of_nodes(tree, tree.nodes2q, settings.cost.triangle)
                                              : facts_of_nodes(tree, tree.nodes2, settings.cost.triangle);
    facts.triangles = triangles;
    facts.references = references_of(tree);
    facts.bytes = tree.nodes().size() + tree.leaf_rows().size();
    return facts;
}

}  // namespace ptb::tree
