#pragma once

#include "bench/cli/exit_code.h"
#include "bench/cli/options.h"
#include "bench/fleet/folder.h"

namespace ptb {

/// Merges what nodes have measured, shows the fleet, and says what it comes to.
Outcome show_fleet(const Options& options, const FleetFolder& folder);

/// `ptbench report DIR` of a fleet: shows it, or writes it where the flags say. Throws UsageError.
int fleet_report(const Options& options, const FleetFolder& folder);

}  // namespace ptb
