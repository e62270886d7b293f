#pragma once

#include <string>

#include "bench/report/grid.h"
#include "bench/tune/contest.h"

namespace ptb {

/// Candidates of a contest, the fastest first, and why the others did not race. `usual_lanes` is the lane
/// width that the device takes when nobody names one.
Section race_section(const Contest& contest, const std::string& title, int usual_lanes);

}  // namespace ptb
