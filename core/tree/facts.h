#pragma once

#include "core/tree/binary_tree.h"
#include "core/tree/tree.h"

namespace ptb::tree {

TreeFacts facts_of(const Tree& tree, std::size_t triangles, const TreeSettings& settings);

/// As in TreeFacts, of boxes as they are.
double sah_cost(const BinaryTree& binary, double test_cost);

}  // namespace ptb::tree
