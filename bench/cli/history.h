#pragma once

#include "bench/cli/options.h"

namespace ptb {

/// `report --history`: what a folder of result files has over time. Returns the exit code.
int report_history(const Options& options);

}  // namespace ptb
