#pragma once

#include <bit>
#include <cstddef>

#include "core/tree/settings.h"
#include "core/tree/tree.h"

namespace ptb::tree {

/// Settings and what the layout asks for.
struct Rules {
    TreeSettings settings;
    std::size_t leaf_most = 4;  ///< references
    int per_test_log2 = 0;      ///< references that one test takes
    float test = 0.7f;          ///< its cost, in node steps

    /// Tests that so many references take.
    int tests(std::size_t count) const {
        return static_cast<int>((count + (std::size_t{1} << per_test_log2) - 1) >> per_test_log2);
    }
    /// Levels of halving until leaves are small enough.
    int levels_to_leaf(std::size_t count) const {
        return static_cast<int>(std::bit_width((count - 1) / leaf_most));
    }
};

inline Rules rules_of(const TreeSettings& settings, TreeLayout layout) {
    if (layout == TreeLayout::bvh2) return {settings, TREE_LEAF_MOST, 0, settings.cost.triangle};
    return {settings, 8, 3, settings.cost.block};
}

}  // namespace ptb::tree
