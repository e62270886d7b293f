#include <stdexcept>

#include "bench/cli/ab_plan.h"
#include "bench/cli/commands.h"
#include "bench/cli/device_gate.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/outputs.h"
#include "bench/cli/tell.h"
#include "bench/doctor/diagnosis.h"
#include "bench/record/file.h"
#include "bench/record/host.h"

namespace ptb {
namespace {

constexpr double tolerance = 0.05;

/// This binary as both sides of `ptbench ab`, on the one case of config `doctor`.
AbFlags both_sides(const DoctorFlags& flags) {
    AbFlags ab;
    ab.run.config = "doctor";
    ab.run.devices = flags.devices;
    return ab;
}

SelfComparison compare_with_itself(const AbPlan& plan, const DeviceInfo& device, const CommonFlags& flags,
                                   const Stopped& stopped) {
    auto cases = paired_cases(plan, device, {plan.base_config, tolerance, tolerance});
    PairedCase& only = cases.front();
    try {
        PairedRun run = paired_run(plan, device, flags, stopped);
        measure_pairs(run, device.key, flags, 1, cases);
    } catch (const std::runtime_error& error) {
        only.gate.not_measured = error.what();
    }
    std::string reason;
    for (const Record* side : {&only.base, &only.now})
        if (side->statistics && reason.empty()) reason = side->statistics->timer_reason;
    return {device, only.gate, decide({&only.gate, 1}).front(), reason};
}

/// Measures each device in turn, or only looks.
void measure(const Options& options, const AbPlan& plan, const Stopped& stopped, Diagnosis& diagnosis) {
    for (const DeviceInfo& device : select_devices(plan.base_config.devices, diagnosis.list.devices)) {
        if (stopped()) return;
        diagnosis.devices.push_back(options.doctor.no_aa
                                        ? SelfComparison{device, {}, {}, ""}
                                        : compare_with_itself(plan, device, options.common, stopped));
    }
}

void show(const DoctorFlags& flags, const Diagnosis& diagnosis) {
    put(flags.json == "-" ? stderr : stdout, diagnosis_text(diagnosis));
    if (flags.json == "-") put(stdout, diagnosis_json(diagnosis));
    if (!flags.json.empty() && flags.json != "-") write_file(flags.json, diagnosis_json(diagnosis));
}

}  // namespace

int doctor_command(const Options& options) {
    const DoctorFlags& flags = options.doctor;
    if (!flags.json.empty() && flags.json != "-") check_writable("--json", flags.json);
    const AbPlan plan = plan_ab(both_sides(flags), options.common);
    const Surroundings before = look_around();
    Diagnosis diagnosis{host_info(), find_devices(options.common), {}, host_remarks(before, running_now())};
    const bool any = any_usable(diagnosis.list);
    const Stopped stopped = [&stop = watch_for_interruption()] { return stop.load(); };
    if (any) measure(options, plan, stopped, diagnosis);
    diagnosis.remarks.push_back(
        steal_remark(any && !flags.no_aa ? before.ticks : CpuTicks(), look_around().ticks));
    add_device_remarks(diagnosis);
    show(flags, diagnosis);
    if (!any) put(stderr, no_device_text(diagnosis.list) + "\n");
    if (stopped()) return exit_codes::interrupted;
    return any ? exit_codes::done : exit_codes::no_device;
}

}  // namespace ptb
