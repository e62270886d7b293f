#pragma once

#include "core/tree/binary_tree.h"
#include "core/tree/tree.h"

namespace ptb::tree {

/// What a layout's leaves may be, and what they cost.
struct LeafRules {
    std::uint32_t most;      ///< references
    std::uint32_t per_test;  ///< references that one test takes
    float test_cost;         ///< in node steps
};

LeafRules leaf_rules(TreeLayout layout, const TreeSettings& settings);

/// Makes leaves of subtrees that cost more to go through than to test as a whole; all leaves were of one
/// reference.
void gather_leaves(BinaryTree& tree, const LeafRules& rules);

}  // namespace ptb::tree
