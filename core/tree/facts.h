#pragma once

#include "core/tree/rules.h"

namespace ptb::tree {

TreeFacts facts_of(const Tree& tree, std::size_t triangles, const Rules& rules);

}  // namespace ptb::tree
