#include "bench/cli/prepared.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "bench/cli/check.h"
#include "bench/cli/commands.h"
#include "bench/cli/tell.h"
#include "bench/measure/counted.h"
#include "bench/measure/surroundings.h"
#include "bench/plan/data_dir.h"
#include "bench/plan/scene_file.h"
#include "bench/record/continued.h"
#include "bench/record/host.h"
#include "bench/together/shared_case.h"
#include "core/scene/content.h"

namespace ptb {
namespace {

std::vector<std::string> warnings_before(const HostInfo& host, const Options& options) {
    std::vector<std::string> warnings;
    if (const int running = running_now(); is_busy(running, host.cores)) {
        warnings.push_back(fmt::format(
            "threads of other programs that ran before the run: {}, on {} cores; times on CPUs will "
            "vary: end what `top` shows, or take more --min-samples",
            running, host.cores));
    }
    if (options.run.no_isolate) {
        warnings.push_back("--no-isolate: one driver's crash ends the run, and drivers share a process");
    }
    return warnings;
}

std::vector<std::string> hashed_scenes(const std::vector<Case>& cases) {
    std::set<std::string> names;
    for (const Case& c : cases) names.insert(c.scene);
    std::vector<std::string> scenes;
    for (const auto& name : names) scenes.push_back(name + " " + scene_hash(scene_file(name, data_dir())));
    return scenes;
}

ProgressStyle progress_style(const CommonFlags& flags) {
    if (flags.quiet) return ProgressStyle::silent;
    return is_live(stderr) ? ProgressStyle::live : ProgressStyle::lines;
}

}  // namespace

std::vector<std::string> check_before_devices(const Config& config, const CommonFlags& flags) {
    return check_names(expand(config, {DeviceInfo()}), flags);
}

void check_isolation(const Config& config, const RunFlags& flags) {
    if (flags.no_isolate) refuse_several_devices(expand(config, {DeviceInfo()}), "--no-isolate");
}

Coordinator coordinator_of(const Options& options, const Config& config, const RunPlan& plan,
                           const Stopped& stopped) {
    const OpenChannel open = channels(options, config, stopped);
    return {plan, open, stopped, steady_seconds, shared_measurer(plan.measure, open, stopped)};
}

RunPlan empty_plan(const Config& config, const RunFlags& flags) {
    RunPlan plan;
    plan.measure = config.measure;
    plan.measure.count = flags.peaks;
    plan.max_total_time_s = config.max_total_time_s;
    return plan;
}

std::vector<Case> in_run_order(std::vector<Case> cases, const RunPlan& plan) {
    if (plan.max_total_time_s <= 0) return cases;
    const auto rank = [&](const Case& c) {
        const auto same = [&](const DeviceInfo& device) { return device.key == c.device; };
        const auto device = std::find_if(plan.devices.begin(), plan.devices.end(), same);
        return std::pair(device, c.size.pixels() * static_cast<std::size_t>(c.spp));
    };
    std::stable_sort(cases.begin(), cases.end(),
                     [&](const Case& a, const Case& b) { return rank(a) < rank(b); });
    return cases;
}

void plan_missing(Prepared& prepared, const std::vector<Record>& records) {
    prepared.plan.cases = in_run_order(missing(prepared.planned, records), prepared.plan);
}

ResultFile start_result(const Prepared& prepared, const Options& options,
                        const std::vector<std::string>& argv) {
    ResultFile result;
    result.run = run_info(argv, prepared.config.name, prepared.config.measure.seed);
    result.run.settings.json = dump_config(prepared.config);
    result.run.scenes = hashed_scenes(prepared.planned);
    result.host = host_info();
    result.devices = prepared.plan.devices;
    std::copy_if(prepared.list.devices.begin(), prepared.list.devices.end(),
                 std::back_inserter(result.devices),
                 [](const DeviceInfo& device) { return !device.excluded.empty(); });
    result.broken_icds = prepared.list.broken;
    result.warnings = warnings_before(result.host, options);
    result.warnings.insert(result.warnings.end(), prepared.remarks.begin(), prepared.remarks.end());
    return result;
}

OpenChannel channels(const Options& options, const Config& config, const Stopped& stopped) {
    if (options.run.no_isolate) return in_process_channels();
    const std::chrono::duration<double> silence(config.timeout_s);
    return process_channels(worker_launch(options.common),
                            std::chrono::duration_cast<std::chrono::milliseconds>(silence), stopped);
}

void measure_plan(const CommonFlags& flags, const Prepared& prepared, Coordinator& coordinator,
                  const Forecast& forecast, RunObserver& journal, ResultFile& result) {
    ProgressPrinter progress(stderr, progress_style(flags), prepared.plan, forecast,
                             use_colour(flags, stderr));
    const std::vector<Record> measured = coordinator.run(forecast, {&journal, &progress});
    result.cases.insert(result.cases.end(), measured.begin(), measured.end());
    result.cases = in_plan_order(prepared.planned, result.cases);
    add_shares(result.cases, result.peaks);
}

}  // namespace ptb
