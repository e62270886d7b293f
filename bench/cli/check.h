#pragma once

#include <vector>

#include "bench/plan/case.h"

namespace ptb {

/// Throws UsageError for a kernel or scene that does not exist, and for a scene file that cannot be used.
void check_names(const std::vector<Case>& cases);

}  // namespace ptb
