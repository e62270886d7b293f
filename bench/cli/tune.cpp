#include <map>

#include <fmt/format.h>

#include "bench/cli/check.h"
#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/outputs.h"
#include "bench/cli/tell.h"
#include "bench/cli/tuned.h"
#include "bench/compare/row.h"
#include "bench/plan/tuned.h"
#include "bench/report/race.h"
#include "bench/tune/store.h"
#include "core/integrator/registry.h"
#include "core/source/source.h"

namespace ptb {
namespace {

/// What a candidate's launch is left out of: all candidates of a kernel do this work.
Case work_of(Case c) {
    c.lanes = 0;
    c.work_group = {};
    return c;
}

using Heats = std::map<std::string, std::vector<Case>>;  ///< candidates by kernel

/// Throws UsageError where they differ in more than their launch.
Heats heats_of(const Config& config, const DeviceInfo& device) {
    Heats heats;
    for (const Case& c : expand(config, {device})) {
        auto& heat = heats[c.kernel];
        heat.push_back(c);
        if (work_of(c) != work_of(heat.front()))
            throw UsageError(
                fmt::format("tune: found \"{}\" and \"{}\"; allowed: one work, candidates differ in "
                            "lanes and work_group alone",
                            case_text(work_of(heat.front())), case_text(work_of(c))));
    }
    return heats;
}

std::filesystem::path checked_file(const RunFlags& flags) {
    const std::filesystem::path file = tune_file(flags);
    if (file.empty())
        throw UsageError("--tune-file: is missing, and neither XDG_CONFIG_HOME nor HOME is set");
    read_tuned(file);
    std::error_code ignored;  // the next line says it better
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ignored);
    check_writable("--tune-file", file);
    return file;
}

/// Races the kernels of one device, and stores what each race found.
class Tuning {
  public:
    Tuning(const Options& options, const Config& config, std::filesystem::path file, Stopped stopped)
        : options_(options), config_(config), file_(std::move(file)), stopped_(std::move(stopped)) {}

    void tune(const DeviceInfo& device) {
        const std::chrono::duration<double> silence(config_.timeout_s);
        DeviceWorker worker(
            device,
            process_channels(worker_launch(options_.common),
                             std::chrono::duration_cast<std::chrono::milliseconds>(silence), stopped_),
            config_.measure);
        for (const auto& [kernel, candidates] : heats_of(config_, device)) {
            const auto say = [&, &name = kernel](const std::string& what) {
                tell(options_.common, fmt::format("[{}] {}: {}", device.key, name, what));
            };
            const Contest contest =
                hold_contest(worker, candidates, {.seed = config_.measure.seed}, stopped_, say);
            if (stopped_()) return;
            conclude(device, contest);
        }
    }

    const Outcome& outcome() const { return outcome_; }

  private:
    void conclude(const DeviceInfo& device, const Contest& contest) {
        const Case& work = contest.records.front().params;
        const Integrator& kernel = integrator(work.kernel);
        put(stdout, to_text(race_section(contest, fmt::format("{}: {}", device.key, case_text(work_of(work))),
                                         default_lanes(kernel, device))));
        outcome_ |= outcome_of(contest.records);
        outcome_.not_comparable |= !contest.race.leader;
        if (!contest.race.leader) return;
        store_tuned(
            file_, result_of(device, contest, kernel_source(kernel.file(), config_.measure.kernel_dir).hash));
        tell(options_.common, fmt::format("written: {}", file_.string()));
    }

    static TunedKernel result_of(const DeviceInfo& device, const Contest& contest, const std::string& hash) {
        const Race& race = contest.race;
        const auto launch = [&](std::size_t runner) { return contest.records[contest.raced[runner]].params; };
        TunedKernel result = tuned_kernel(device, hash, launch(*race.leader));
        result.samples = static_cast<int>(race.runners[*race.leader].times.size());
        for (std::size_t i = 0; i < race.runners.size(); ++i)
            if (race.runners[i].state == Runner::State::tied) result.ties.push_back(launch(i));
        return result;
    }

    const Options& options_;
    const Config& config_;
    std::filesystem::path file_;
    Stopped stopped_;
    Outcome outcome_;
};

}  // namespace

int tune_command(const Options& options) {
    const RunFlags& flags = options.tune.run;
    const Config config = configured(flags, options.common);
    refuse_several_devices(expand(config, {DeviceInfo()}), "tune");
    check_names_and_tell(expand(config, {DeviceInfo()}), options.common);
    heats_of(config, DeviceInfo());
    const auto file = checked_file(flags);
    const DeviceList list = find_devices(options.common);
    if (!any_usable(list)) {
        put(stderr, no_device_text(list) + "\n");
        return exit_codes::no_device;
    }
    const Stopped stopped = [&stop = watch_for_interruption()] { return stop.load(); };
    Tuning tuning(options, config, file, stopped);
    for (const DeviceInfo& device : select_devices(config.devices, list.devices))
        if (!stopped()) tuning.tune(device);
    return stopped() ? exit_codes::interrupted : exit_code(tuning.outcome());
}

}  // namespace ptb
