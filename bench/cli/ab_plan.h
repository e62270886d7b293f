#pragma once

#include <string>
#include <vector>

#include "bench/cli/options.h"
#include "bench/compare/gate_file.h"
#include "bench/plan/tolerance.h"
#include "bench/worker/paired.h"

namespace ptb {

/// What `ab` compares, known before any device works.
struct AbPlan {
    GateSide base, now;
    Config base_config, now_config;
};

/// Throws UsageError for anything that does not exist or is not well-formed.
AbPlan plan_ab(const AbFlags& flags, const CommonFlags& common);

/// The cases of both sides on one device, paired in their order. Throws UsageError unless they are as many.
std::vector<PairedCase> paired_cases(const AbPlan& plan, const DeviceInfo& device,
                                     const Tolerances& tolerances);

/// Two workers on one device.
PairedRun paired_run(const AbPlan& plan, const DeviceInfo& device, const CommonFlags& common,
                     const Stopped& stopped);

}  // namespace ptb
