#include <fmt/format.h>

#include "bench/cli/ab_plan.h"
#include "bench/cli/commands.h"
#include "bench/cli/device_gate.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/judged.h"
#include "bench/cli/outputs.h"
#include "bench/cli/tell.h"
#include "bench/record/host.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

GateFile started(const AbPlan& plan, const Options& options, const std::vector<std::string>& argv) {
    GateFile gate;
    gate.run = run_info(argv, plan.base.config, plan.base_config.measure.seed);
    gate.host = host_info();
    gate.base = plan.base;
    gate.now = plan.now;
    gate.shuffle_seed = options.ab.shuffle_seed;
    return gate;
}

/// Where the decision goes. Throws UsageError when it cannot be written.
fs::path decision_file(const JudgeFlags& flags, const RunInfo& run) {
    if (flags.json == "-") throw UsageError("--json: found -; allowed: a file, which --replay reads");
    check_outputs(flags);
    if (!flags.json.empty()) return flags.json;
    const fs::path folder = "ptbench-results";
    std::error_code error;
    fs::create_directories(folder, error);
    const fs::path file = folder / (file_safe(run.started_at + "-ab-" + run.config) + ".json");
    check_writable("--json", file);
    return file;
}

using CasesOfDevices = std::vector<std::vector<PairedCase>>;

CasesOfDevices all_cases(const AbPlan& plan, const Options& options, GateFile& gate) {
    const Tolerances tolerances = tolerances_of(options.ab.judge, plan.base_config);
    CasesOfDevices cases;
    std::vector<double> used;
    for (const DeviceInfo& device : gate.devices) {
        cases.push_back(paired_cases(plan, device, tolerances));
        for (const PairedCase& c : cases.back()) used.push_back(c.gate.tolerance);
    }
    gate.rules = rules_of(options.ab.judge, used);
    return cases;
}

void measure(const AbPlan& plan, const Options& options, CasesOfDevices& cases, GateFile& gate) {
    const Stopped stopped = [&stop = watch_for_interruption()] { return stop.load(); };
    const double start_s = steady_seconds();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        PairedRun run = paired_run(plan, gate.devices[i], options.common, stopped);
        measure_pairs(run, gate.devices[i].key, options.common, options.ab.shuffle_seed, cases[i]);
        for (const PairedCase& c : cases[i]) {
            gate.cases.push_back(c.gate);
            gate.base_records.push_back(c.base);
            gate.now_records.push_back(c.now);
        }
    }
    gate.run.wall_s = steady_seconds() - start_s;
    gate.run.interrupted = stopped();
    gate.findings = decide(gate.cases);
}

}  // namespace

int ab_command(const Options& options, const std::vector<std::string>& argv) {
    const AbPlan plan = plan_ab(options.ab, options.common);
    const DeviceList list = find_devices(options.common);
    if (!any_usable(list)) {
        put(stderr, no_device_text(list) + "\n");
        return exit_codes::no_device;
    }
    GateFile gate = started(plan, options, argv);
    gate.devices = select_devices(plan.base_config.devices, list.devices);
    auto cases = all_cases(plan, options, gate);
    const fs::path file = decision_file(options.ab.judge, gate.run);
    measure(plan, options, cases, gate);
    write_gate(file, gate);
    show_rows(rows_of(gate), title_of(gate), options.ab.judge, table_stream(options.ab.judge));
    write_page({rows_of(gate), title_of(gate), {}, read_text(file)}, options.ab.judge);
    tell(options.common, fmt::format("written: {}", file.string()));
    return exit_code(outcome_of(gate));
}

}  // namespace ptb
