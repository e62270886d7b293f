#pragma once

#include "core/tree/binary_tree.h"

namespace ptb::tree {

/// Puts subtrees where the boxes' area grows least, and the tree not too deep; see "Parallel Reinsertion for
/// Bounding Volume Hierarchy Optimization", by D. Meister and J. Bittner.
void reinsert(BinaryTree& tree, const TreeSettings& settings, Crew& crew);

}  // namespace ptb::tree
