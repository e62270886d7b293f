#pragma once

#include "bench/fleet/fleet.h"

namespace ptb {

/// Reads a fleet and writes its result file: all nodes' journals, in the order of nodes, devices and plan.
/// The same bytes whoever does it. A device's key has its node before it: "n1/nvidia:0". Throws UsageError on
/// a journal that is none, std::runtime_error where it cannot be written.
Fleet merge(const FleetFolder& folder);

/// Nodes that a fleet is told of, by the plan's writer and in all journals' headers; sorted.
std::vector<std::string> expected_nodes(const FleetPlan& plan, const std::vector<ResultFile>& headers);

/// Whether each of them has finished.
bool is_whole(const FleetFolder& folder, const FleetPlan& plan);

}  // namespace ptb
