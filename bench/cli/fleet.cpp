#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/fleet_report.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/journal_writer.h"
#include "bench/cli/prepared.h"
#include "bench/cli/tell.h"
#include "bench/fleet/claim.h"
#include "bench/fleet/lease.h"
#include "bench/fleet/merge.h"
#include "bench/fleet/nodes.h"
#include "bench/fleet/rejoin.h"
#include "bench/measure/clock.h"
#include "bench/measure/fit.h"
#include "bench/plan/data_dir.h"
#include "bench/record/continued.h"
#include "bench/record/host.h"
#include "bench/record/journal.h"
#include "bench/record/seen_from.h"
#include "bench/record/status.h"

namespace ptb {
namespace {

/// A node's part of a fleet.
struct Part {
    FleetFolder folder;
    std::string node;
    std::vector<std::string> told;  ///< all nodes, as far as this one was told
    FleetPlan plan;
    Prepared prepared;
    ResultFile result;
    std::vector<Record> of_gone;  ///< records of devices that left
};

/// Devices, config and plan; what was measured before is told apart later.
Prepared prepared_for(const Options& options, const FleetFolder& folder) {
    Prepared prepared;
    std::error_code unknown;
    const auto here = std::filesystem::current_path(unknown);
    const auto asked =
        is_fleet(folder.path) ? std::optional(seen_from(here, read_plan(folder)).config()) : std::nullopt;
    prepared.config = configured(options.run, options.common, asked);
    prepared.remarks = check_before_devices(prepared.config, options.common);
    prepared.planned = expand(prepared.config, {DeviceInfo()});
    prepared.plan = empty_plan(prepared.config, options.run);
    return prepared;
}

std::vector<std::string> sorted(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

std::vector<std::string> told_nodes(const RunFlags& flags, const std::string& node) {
    std::vector<std::string> nodes =
        flags.expect.empty() ? nodes_of_job() : nodes_in(flags.expect, "--expect");
    nodes.push_back(node);
    return sorted(std::move(nodes));
}

/// Ends with NotComparable where the fleet measures something else.
FleetPlan join(const Options& options, const FleetFolder& folder, const Prepared& prepared,
               const std::vector<std::string>& argv, const std::vector<std::string>& nodes) {
    RunInfo run = start_result(prepared, options, argv).run;
    run.expected = nodes;
    std::vector<std::string> differing;
    FleetPlan plan = join_plan(folder, plan_here(run, prepared.config.measure.kernel_dir), differing);
    if (!differing.empty())
        throw NotComparable(fmt::format("--fleet: {} measures something else: {}", folder.path.string(),
                                        fmt::join(differing, "; ")));
    return plan;
}

void choose_devices(const Options& options, Prepared& prepared) {
    prepared.list = find_devices(options.common);
    if (!any_usable(prepared.list)) return;
    prepared.plan.devices = select_devices(prepared.config.devices, prepared.list.devices);
}

/// Keeps what is measured; leaves to be measured what is not.
void take_up(Part& part, const Options& options, const ResultFile& journal) {
    Prepared& prepared = part.prepared;
    std::error_code unknown;
    ResultFile earlier = journal;
    see_from(std::filesystem::current_path(unknown), earlier, data_dir());
    Rejoined parts = rejoined(earlier, prepared.list.devices, prepared.plan.devices);
    prepared.plan.devices = parts.devices;
    prepared.planned = expand(prepared.config, parts.devices);
    ResultFile& result = part.result;
    std::erase_if(result.devices, [](const DeviceInfo& device) { return device.excluded.empty(); });
    result.devices.insert(result.devices.begin(), parts.devices.begin(), parts.devices.end());
    go_on(result, parts.earlier, prepared.planned, part.folder.journal(part.node).string(),
          prepared.config.measure.kernel_dir);
    result.peaks = parts.earlier.peaks;
    result.devices.insert(result.devices.end(), parts.gone.begin(), parts.gone.end());
    part.of_gone = parts.of_gone;
    tell(options.common, fmt::format("{}: resumed: {} of {} cases are measured", part.node,
                                     result.cases.size(), prepared.planned.size()));
}

/// All but measuring.
void begin(Part& part, const Options& options, const std::vector<std::string>& argv, const NodeClaim& claim) {
    part.plan = join(options, part.folder, part.prepared, argv, part.told);
    Prepared& prepared = part.prepared;
    choose_devices(options, prepared);
    prepared.planned = expand(prepared.config, prepared.plan.devices);
    part.result = start_result(prepared, options, argv);
    if (claim.earlier() && !prepared.plan.devices.empty()) take_up(part, options, *claim.earlier());
    RunInfo& run = part.result.run;
    run.expected.insert(run.expected.end(), part.told.begin(), part.told.end());
    run.expected = sorted(std::move(run.expected));
    run.lease = this_lease();
    part.result.host.node = part.node;
    plan_missing(prepared, part.result.cases);
    if (!prepared.plan.cases.empty()) run.finished_at.clear();
}

/// The journal's records: the plan's, then those of devices that left.
void add_gone(Part& part) {
    part.result.cases.insert(part.result.cases.end(), part.of_gone.begin(), part.of_gone.end());
}

void run_part(const Options& options, Part& part, Coordinator& coordinator) {
    const Prepared& prepared = part.prepared;
    ResultFile& result = part.result;
    add_gone(part);
    JournalWriter journal(part.folder.journal(part.node), result);
    part.folder.refuse(part.node, "");
    const Forecast forecast = coordinator.estimate_within_budget();
    tell(options.common, prediction_text(forecast, prepared.plan.cases, prepared.config.max_total_time_s));
    if (options.run.peaks && result.peaks.empty()) result.peaks = coordinator.peaks();
    measure_plan(options.common, prepared, coordinator, forecast, journal, result);
}

/// The journal once more, with what is known at the end.
void conclude(Part& part, const Coordinator& coordinator, double wall_s, bool interrupted) {
    ResultFile& result = part.result;
    result.run.wall_s += wall_s;
    result.run.coordinator_cpu_s += process_cpu_s();
    result.run.interrupted = interrupted;
    if (!interrupted) result.run.finished_at = utc_now();
    const auto& remarks = coordinator.remarks();
    result.warnings.insert(result.warnings.end(), remarks.begin(), remarks.end());
    ResultFile whole = result;
    whole.cases.insert(whole.cases.end(), part.of_gone.begin(), part.of_gone.end());
    Journal(part.folder.journal(part.node), whole);
}

/// "n1: 2 devices, 12 of 12 cases are measured: 11 ok, 1 unstable"
std::string summary(const Part& part) {
    std::map<std::string, int> counts;
    for (const Record& record : part.result.cases) ++counts[to_string(record.status)];
    std::vector<std::string> texts;
    for (const auto& [status, count] : counts) texts.push_back(fmt::format("{} {}", count, status));
    return fmt::format("{}: {} devices, {} of {} cases: {}\n", part.node, part.prepared.plan.devices.size(),
                       part.result.cases.size(), part.prepared.planned.size(), fmt::join(texts, ", "));
}

Outcome measure_part(const Options& options, Part& part) {
    const double start_s = steady_seconds();
    const Stopped stopped = [&stop = watch_for_interruption()] { return stop.load(); };
    Coordinator coordinator = coordinator_of(options, part.prepared.config, part.prepared.plan, stopped);
    run_part(options, part, coordinator);
    const bool interrupted = stopped();
    conclude(part, coordinator, steady_seconds() - start_s, interrupted);
    tell_build_logs(options.common, part.result.cases);
    return {.interrupted = interrupted, .failed = coordinator.has_given_up()};
}

/// What is finished stays as it is, to the byte, unless there is more to wait for.
int measure_and_show(const Options& options, Part& part, const NodeClaim& claim) {
    Outcome outcome;
    const RunInfo& run = part.result.run;
    if (run.finished_at.empty() || claim.earlier()->run.expected != run.expected)
        outcome = measure_part(options, part);
    put(stdout, summary(part));
    outcome |= outcome_of(part.result.cases);
    if (!outcome.interrupted && is_whole(part.folder, part.plan)) outcome |= show_fleet(options, part.folder);
    return exit_code(outcome);
}

int take_part(const Options& options, const std::vector<std::string>& argv, Part& part) {
    const NodeClaim claim(part.folder, part.node);
    begin(part, options, argv, claim);
    if (!part.prepared.plan.devices.empty()) return measure_and_show(options, part, claim);
    const std::string reason = no_device_text(part.prepared.list);
    part.folder.refuse(part.node, reason);
    put(stderr, reason + "\n");
    return exit_codes::no_device;
}

}  // namespace

int fleet_command(const Options& options, const std::vector<std::string>& argv) {
    const FleetFolder folder{options.run.fleet};
    const std::string node = this_node();
    try {
        Part part;
        part.folder = folder;
        part.node = node;
        part.told = told_nodes(options.run, node);
        part.prepared = prepared_for(options, folder);
        return take_part(options, argv, part);
    } catch (const NodeInUse&) {
        throw;  // its writer knows better what becomes of it
    } catch (const std::exception& error) {
        if (is_fleet(folder.path)) folder.refuse(node, error.what());
        throw;
    }
}

}  // namespace ptb
