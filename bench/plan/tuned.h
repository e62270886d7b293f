#pragma once

#include <vector>

#include "bench/plan/config.h"

namespace ptb {

/// Fills what the series leaves to the program with what `ptbench tune` found for the case's device and
/// kernel: the lane width, and the work-group that was best with it. An axis that the series names stays as
/// it is, `auto` and `implicit` included; so does a case of another variant than was raced.
void apply_tuned(Case& c, const Series& series, const std::vector<Case>& tuned);

/// The case as the plan asked for it, before tuning.
Case as_asked(Case c);

/// "lanes 16, work-group 64"
std::string launch_text(const Case& c);

}  // namespace ptb
