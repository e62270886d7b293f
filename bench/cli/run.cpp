#include <algorithm>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "bench/cli/baseline.h"
#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/hints.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/journal_writer.h"
#include "bench/cli/outputs.h"
#include "bench/cli/plan_text.h"
#include "bench/cli/prepared.h"
#include "bench/cli/resume.h"
#include "bench/cli/tell.h"
#include "bench/cli/tuned.h"
#include "bench/measure/clock.h"
#include "bench/measure/fit.h"
#include "bench/plan/data_dir.h"
#include "bench/record/continued.h"
#include "bench/report/table.h"

namespace ptb {
namespace {

Config config_for(const Options& options, const std::optional<ResultFile>& earlier) {
    const auto began = earlier ? std::optional(config_of(*earlier, options.run.resume)) : std::nullopt;
    return configured(options.run, options.common, began);
}

Prepared prepare(const Options& options) {
    Prepared prepared;
    prepared.earlier = earlier_run(options.run);
    prepared.config = config_for(options, prepared.earlier);
    prepared.remarks = check_before_devices(prepared.config, options.common);
    check_isolation(prepared.config, options.run);
    prepared.list = find_devices(options.common);
    if (!any_usable(prepared.list)) return prepared;
    RunPlan& plan = prepared.plan = empty_plan(prepared.config, options.run);
    plan.devices = select_devices(prepared.config.devices, prepared.list.devices);
    prepared.tuned = prepared.earlier && !options.run.no_tuned
                         ? prepared.earlier->run.tuned
                         : stored_launches(options, prepared.config, plan.devices);
    prepared.planned = expand(prepared.config, plan.devices, prepared.tuned);
    plan_missing(prepared, {});
    return prepared;
}

/// In this process the loader shall see what a worker's would: one driver, if one is all that is needed.
std::unique_ptr<IcdFolder> only_driver(const std::vector<DeviceInfo>& devices) {
    const auto same = [&](const DeviceInfo& device) { return device.icd == devices.front().icd; };
    if (!std::all_of(devices.begin(), devices.end(), same)) return std::make_unique<IcdFolder>(any_icd);
    return std::make_unique<IcdFolder>(icd_from_file(devices.front().icd));
}

/// Leaves to be measured what the earlier run has not.
void resume(const Options& options, Prepared& prepared, ResultFile& result) {
    go_on(result, *prepared.earlier, prepared.planned, "--resume: " + options.run.resume,
          prepared.config.measure.kernel_dir);
    plan_missing(prepared, result.cases);
    tell(options.common, fmt::format("resumed: {} of {} cases are in {}", result.cases.size(),
                                     prepared.planned.size(), options.run.resume));
}

void run_plan(const Options& options, const Prepared& prepared, const Outputs& outputs,
              Coordinator& coordinator, ResultFile& result) {
    const Forecast forecast = coordinator.estimate_within_budget();
    tell(options.common, prediction_text(forecast, prepared.plan.cases, prepared.config.max_total_time_s));
    if (options.run.peaks) result.peaks = coordinator.peaks();
    JournalWriter journal(outputs.journal(), result);
    measure_plan(options.common, prepared, coordinator, forecast, journal, result);
    result.fits = fits_over_spp(result.cases);
}

void report(const Options& options, const Prepared& prepared, const PublishedTable& published,
            Outputs& outputs, const ResultFile& result) {
    const bool taken = outputs.stdout_is_taken();
    std::FILE* const out = taken ? stderr : stdout;
    if (!taken || !options.common.quiet) put(out, table(result, published, text_style(options.common, out)));
    tell_build_logs(options.common, result.cases);
    outputs.write(result, published);
    tell(options.common, fmt::format("written: {}", fmt::join(outputs.written(), " ")));
    if (result.run.interrupted) {
        tell(options.common, fmt::format("go on with: ptbench --resume {}", outputs.journal().string()));
        return;
    }
    for (const auto& hint :
         hints(prepared.config, prepared.list.devices, prepared.plan.devices, result.cases)) {
        tell(options.common, "hint: " + hint);
    }
}

int measure(const Options& options, Prepared& prepared, ResultFile& result, const Stopped& stopped) {
    const double start_s = steady_seconds();
    const PublishedTable published = read_published(data_dir() / "results" / "thesis-2016.json");
    Baseline baseline(options.run);
    Outputs outputs(options.run, prepared.config.name, result.run.started_at);
    prepared.plan.image_files = outputs.pictures(prepared.config.pictures, prepared.planned, result.cases);
    Coordinator coordinator = coordinator_of(options, prepared.config, prepared.plan, stopped);
    run_plan(options, prepared, outputs, coordinator, result);
    result.run.wall_s += steady_seconds() - start_s;
    result.run.coordinator_cpu_s += process_cpu_s();
    result.run.interrupted = stopped();
    const auto& remarks = coordinator.remarks();
    result.warnings.insert(result.warnings.end(), remarks.begin(), remarks.end());
    result.pictures = outputs.made(result.cases);
    if (!result.run.interrupted) outputs.keep(result.pictures);
    baseline.judge(result, prepared.config);
    report(options, prepared, published, outputs, result);
    Outcome outcome = outcome_of(result.cases);
    baseline.conclude(result, options.common, outputs.stdout_is_taken() ? stderr : stdout, outcome);
    outcome.failed |= coordinator.has_given_up();
    outcome.interrupted = result.run.interrupted;
    return exit_code(outcome);
}

int dry_run(const Options& options, const Prepared& prepared, const Stopped& stopped) {
    const RunPlan& plan = prepared.plan;
    Coordinator coordinator = coordinator_of(options, prepared.config, plan, stopped);
    const Forecast forecast = options.common.quiet ? Forecast(plan.measure) : coordinator.estimate();
    tell(options.common, prediction_text(forecast, plan.cases, plan.max_total_time_s));
    put(stdout, plan_text(plan.cases, forecast));
    return stopped() ? exit_codes::interrupted : exit_codes::done;
}

}  // namespace

int run_command(const Options& options, const std::vector<std::string>& argv) {
    if (options.run.dump_config) {
        put(stdout, dump_config(config_for(options, earlier_run(options.run))));
        return exit_codes::done;
    }
    if (options.run.confirm) return confirm_command(options);
    if (!options.run.fleet.empty() && !options.run.dry_run) return fleet_command(options, argv);
    Prepared prepared = prepare(options);
    if (prepared.plan.devices.empty()) {
        put(stderr, no_device_text(prepared.list) + "\n");
        return exit_codes::no_device;
    }
    tell_what_is_left_out(options.common, prepared.list);
    ResultFile result = start_result(prepared, options, argv);
    result.run.tuned = used_launches(prepared.tuned, prepared.planned);
    if (prepared.earlier) resume(options, prepared, result);
    const auto driver = only_driver(prepared.plan.devices);
    if (options.run.no_isolate) see_only(*driver);
    const Stopped stopped = [&stop = watch_for_interruption()] { return stop.load(); };
    if (options.run.dry_run) return dry_run(options, prepared, stopped);
    return measure(options, prepared, result, stopped);
}

}  // namespace ptb
