#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/tree/settings.h"
#include "core/tree/triangle.h"
#include "shared/tree.h"

namespace ptb {

/// How a tree lies in memory: see kernels/shared/tree.h.
enum class TreeLayout { bvh2, bvh2q, wide8 };

/// What a tree is like, for records.
struct TreeFacts {
    std::size_t triangles = 0;
    std::size_t references = 0;  ///< of leaves to triangles; spatial splits make more of them than triangles
    std::size_t nodes = 0;
    std::size_t leaves = 0;
    std::size_t bytes = 0;  ///< of all that a device is given
    int depth = 0;          ///< inner nodes on the longest way from the root to a leaf
    int stack_most = 0;  ///< most links that wait while one is followed, in whatever order children are taken
    /// Expected nodes + cost.triangle (or cost.block) x leaves' contents of a random ray through the scene's
    /// box.
    double sah_cost = 0;
    /// By what a grid makes leaves' boxes larger: the geometric mean of their surfaces' growth. 1 of layouts
    /// without a grid, and where no box has a surface. TreeSettings::grid_growth_most is the most that
    /// it may be.
    double grid_growth = 1;
    auto operator<=>(const TreeFacts&) const = default;
};

/// A tree in one of the layouts; the others' arrays are empty. Node 0 is the root, also where there is
/// nothing below it but a leaf or nothing at all.
struct Tree {
    std::vector<TreeNode2> nodes2;
    std::vector<TreeNode2q> nodes2q;
    TreeGrid grid{};                      ///< of nodes2q
    std::vector<TreeTriangle> triangles;  ///< of both
    std::vector<TreeNode8> nodes8;
    std::vector<TreeBlock8> blocks;
    TreeFacts facts;

    std::span<const std::byte> nodes() const;
    std::span<const std::byte> leaf_rows() const;
};

/// The same tree, byte for byte, whatever the number of threads. No triangles make a tree without leaves.
/// Throws std::invalid_argument: a corner that is not finite, senseless settings, threads below 1;
/// std::length_error: more references than links can tell apart.
Tree build_tree(std::span<const Triangle> triangles, TreeLayout layout, const TreeSettings& settings,
                int threads);

/// What decides how a tree comes out; trees of equal keys are equal. Triangles take part by a 64-bit hash.
struct TreeKey {
    std::uint64_t triangles_hash = 0;
    std::size_t triangles = 0;
    TreeLayout layout = TreeLayout::bvh2;
    TreeSettings settings;
    auto operator<=>(const TreeKey&) const = default;
};

TreeKey tree_key(std::span<const Triangle> triangles, TreeLayout layout, const TreeSettings& settings);

}  // namespace ptb
