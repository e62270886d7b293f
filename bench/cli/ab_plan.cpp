#include "bench/cli/ab_plan.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "bench/cli/check.h"
#include "bench/cli/commands.h"
#include "bench/plan/data_dir.h"

namespace ptb {
namespace {

/// The blocks measure; what a validation measures beside only chooses the clock.
constexpr double most_seconds_before = 0.5;

Config side_config(const AbFlags& flags, const CommonFlags& common, const GateSide& side) {
    RunFlags run = flags.run;
    run.config = side.config;
    Config config = configured(run, common);
    if (!side.kernel_dir.empty()) config.measure.kernel_dir = side.kernel_dir;
    config.measure.max_time_s = std::min(config.measure.max_time_s, most_seconds_before);
    config.measure.skip_time = false;
    return config;
}

GateSide side_of(const AbFlags& flags, const CommonFlags& common, const std::string& binary,
                 const std::string& kernels, const std::string& config) {
    return {binary.empty() ? self_path().string() : binary, kernels.empty() ? common.kernel_dir : kernels,
            config.empty() ? flags.run.config : config};
}

Side running(const std::string& name, const GateSide& side, const Config& config, const CommonFlags& common,
             const Stopped& stopped) {
    const auto silence = std::chrono::duration_cast<std::chrono::milliseconds>(
        std::chrono::duration<double>(config.timeout_s));
    std::error_code ignored;
    WorkerLaunch launch = worker_launch(common);
    launch.executable = std::filesystem::absolute(side.binary, ignored).string();
    return {name, process_channels(launch, silence, stopped), config.measure};
}

}  // namespace

AbPlan plan_ab(const AbFlags& flags, const CommonFlags& common) {
    AbPlan plan;
    plan.base = side_of(flags, common, flags.base, flags.base_kernels, flags.base_config);
    plan.now = side_of(flags, common, flags.now, flags.new_kernels, flags.new_config);
    plan.base_config = side_config(flags, common, plan.base);
    plan.now_config = side_config(flags, common, plan.now);
    std::vector<Case> cases = expand(plan.base_config, {DeviceInfo()});
    const std::vector<Case> others = expand(plan.now_config, {DeviceInfo()});
    cases.insert(cases.end(), others.begin(), others.end());
    refuse_several_devices(cases, "ab");
    check_names_and_tell(cases, common);
    return plan;
}

std::vector<PairedCase> paired_cases(const AbPlan& plan, const DeviceInfo& device,
                                     const Tolerances& tolerances) {
    const auto base = expand(plan.base_config, {device}), now = expand(plan.now_config, {device});
    if (base.size() != now.size())
        throw UsageError(
            fmt::format("--new-config: found {} cases; allowed: {}, as many as the base has: they "
                        "are paired in their order",
                        now.size(), base.size()));
    std::vector<PairedCase> cases(base.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        cases[i].gate.base = cases[i].base.params = base[i];
        cases[i].gate.now = cases[i].now.params = now[i];
        cases[i].gate.tolerance = tolerances.of(base[i]);
    }
    return cases;
}

PairedRun paired_run(const AbPlan& plan, const DeviceInfo& device, const CommonFlags& common,
                     const Stopped& stopped) {
    return {device, running("--base", plan.base, plan.base_config, common, stopped),
            running("--new", plan.now, plan.now_config, common, stopped), stopped};
}

}  // namespace ptb
