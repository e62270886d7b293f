#pragma once

#include "bench/fleet/folder.h"
#include "bench/plan/config.h"
#include "bench/record/fingerprint.h"

namespace ptb {

/// What all nodes of a fleet measure, as the first of them was asked.
struct FleetPlan {
    RunInfo run;
    RunFingerprint facts;  ///< ptbench, its kernels, scenes, options: what must be the same everywhere

    Config config() const;
    /// Cases that these devices are to measure, in order; excluded ones have none.
    std::vector<Case> cases(const std::vector<DeviceInfo>& devices) const;
};

/// Of a run that is to begin here; `kernel_dir` as in its config.
FleetPlan plan_here(const RunInfo& run, const std::string& kernel_dir);

/// Throws UsageError. Paths are from the folder in which the fleet began.
FleetPlan read_plan(const FleetFolder& folder);
/// With paths as they are called from `here`.
FleetPlan seen_from(const std::filesystem::path& here, FleetPlan plan);

/// Whoever comes first writes the plan. Returns what is there, and adds what differs from `mine` in it.
/// Throws std::runtime_error.
FleetPlan join_plan(const FleetFolder& folder, const FleetPlan& mine, std::vector<std::string>& differing);

/// A node's journal, with paths as in the plan. Throws UsageError, also for records that are not of the plan.
ResultFile read_node(const FleetFolder& folder, const FleetPlan& plan, const std::string& node);
/// Its header alone.
ResultFile read_header(const std::filesystem::path& journal);

}  // namespace ptb
