#pragma once

#include "core/tree/tree.h"

namespace ptb::tree {

TreeFacts facts_of(const Tree& tree, std::size_t triangles, const TreeSettings& settings);

}  // namespace ptb::tree
