#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/cli/options.h"
#include "bench/worker/coordinator.h"
#include "bench/worker/progress.h"

namespace ptb {

/// Everything a run needs, found and checked before any device does work.
struct Prepared {
    std::optional<ResultFile> earlier;  ///< the run to go on with
    Config config;
    std::vector<std::string> remarks;  ///< on the scenes
    DeviceList list;
    std::vector<Case> tuned;  ///< what the plan takes where the config leaves a launch open
    std::vector<Case> planned;
    RunPlan plan;  ///< of the planned cases those that have no record
};

/// Throws UsageError for names in a config that nothing has. Returns what is left out of its scenes.
std::vector<std::string> check_before_devices(const Config& config, const CommonFlags& flags);

/// The plan of a config, but for devices and cases.
RunPlan empty_plan(const Config& config, const RunFlags& flags);

/// The order in which a plan runs: as planned; under a budget each device's cases of little work first, so
/// that kernels have times of it before one of them does what takes longest.
std::vector<Case> in_run_order(std::vector<Case> cases, const RunPlan& plan);

/// Puts into the plan what has no record.
void plan_missing(Prepared& prepared, const std::vector<Record>& records);

/// A result without a record.
ResultFile start_result(const Prepared& prepared, const Options& options,
                        const std::vector<std::string>& argv);

OpenChannel channels(const Options& options, const Config& config, const Stopped& stopped);

/// Throws UsageError where cases of several devices are to be measured in this process.
void check_isolation(const Config& config, const RunFlags& flags);

/// What drives the workers of a run.
Coordinator coordinator_of(const Options& options, const Config& config, const RunPlan& plan,
                           const Stopped& stopped);

/// Measures the cases of the plan, which the journal hears of, and adds their records to those that the
/// result has.
void measure_plan(const CommonFlags& flags, const Prepared& prepared, Coordinator& coordinator,
                  const Forecast& forecast, RunObserver& journal, ResultFile& result);

}  // namespace ptb
