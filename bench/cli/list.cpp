#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/tell.h"
#include "bench/measure/counted.h"
#include "bench/plan/data_dir.h"
#include "bench/record/json.h"
#include "bench/record/status.h"
#include "bench/report/sections.h"
#include "bench/worker/coordinator.h"
#include "core/input/printable.h"
#include "core/integrator/registry.h"

namespace ptb {
namespace {

std::string bytes_text(std::uint64_t bytes) {
    const double kib = static_cast<double>(bytes) / 1024;
    if (kib < 1024) return fmt::format("{:.0f} KiB", kib);
    if (kib < 1024 * 1024) return fmt::format("{:.0f} MiB", kib / 1024);
    return fmt::format("{:.1f} GiB", kib / 1024 / 1024);
}

/// "0:0 pocl:0  CPU  AMD EPYC", and the facts that matter below it.
std::string device_text(const DeviceInfo& d) {
    std::string text = fmt::format("  {}:{}  {}  {}  {}\n", d.platform_index, d.device_index, d.key, d.type,
                                   printable(d.name));
    if (!d.excluded.empty()) return text + fmt::format("       not used: {}\n", printable(d.excluded));
    text +=
        fmt::format("       {} compute units, {} MHz, {} memory, {} local, work-groups up to {}, {} lanes\n",
                    d.compute_units, d.clock_mhz, bytes_text(d.global_bytes), bytes_text(d.local_bytes),
                    d.max_work_group, d.default_lanes);
    text += fmt::format("       {}, driver {}, images {}, timer {}\n", printable(d.version),
                        printable(d.driver_version), d.images ? "yes" : "no",
                        d.profiling ? fmt::format("{} ns", d.timer_resolution_ns) : "of the host only");
    return text;
}

std::string devices_text(const std::vector<DeviceInfo>& devices) {
    std::string text;
    int platform = -1;
    for (const DeviceInfo& d : devices) {
        if (d.platform_index != platform) {
            text +=
                fmt::format("platform {}: {}, {} ({})\n", d.platform_index, printable(d.platform),
                            printable(d.platform_version), d.icd.empty() ? "any driver" : printable(d.icd));
        }
        platform = d.platform_index;
        text += device_text(d);
    }
    return text;
}

std::string broken_text(const std::vector<BrokenIcd>& broken) {
    std::string text;
    for (const BrokenIcd& each : broken) {
        text += fmt::format("not usable: {}: {}\n", printable(each.icd), printable(each.reason));
    }
    return text;
}

/// What --peaks measures.
struct Limits {
    std::vector<DevicePeaks> peaks;
    std::vector<Record> cases;  ///< each kernel on each device
};

std::string limits_text(const Limits& limits) {
    if (limits.peaks.empty()) return "";
    Section kernels = limits_section(limits.cases);
    for (const Record& record : limits.cases)
        if (!record.counted)
            kernels.notes.push_back(fmt::format("{}, {}: {}: {}", record.params.device, record.params.kernel,
                                                to_string(record.status), record.reason));
    return fmt::format("\n{}\n{}", to_text(peaks_section(limits.peaks)), to_text(kernels));
}

void print_text(const DeviceList& list, const Limits& limits) {
    put(stdout, fmt::format("{}{}{}\nkernels: {}\nscenes:  {}\nconfigs: {}\naxes:    {}\n",
                            devices_text(list.devices), broken_text(list.broken), limits_text(limits),
                            fmt::join(integrator_ids(), " "), fmt::join(scene_names(), " "),
                            fmt::join(config_names(), " "), fmt::join(axis_names(), " ")));
}

void print_json(const DeviceList& list, const Limits& limits) {
    const Json json{{"peaks", encode(limits.peaks)}, {"cases", encode(limits.cases)},
                    {"devices", list.devices},       {"broken_icds", list.broken},
                    {"kernels", integrator_ids()},   {"scenes", scene_names()},
                    {"configs", config_names()},     {"axes", axis_names()}};
    put(stdout, dump_json(json, 2) + "\n");
}

constexpr double pass_ns = 3e8;  ///< of the cases: a device is busy, a user not bored

/// The thesis' picture, with as many samples as fill a moment; asks a worker that is ready.
Case case_of(DeviceWorker& worker, const std::string& device, const std::string& kernel) {
    Request request;
    request.kind = Request::Kind::estimate;
    request.params = {device, kernel, "thesis", {512, 512}, 1, 128, {}, 0};
    if (!worker.ready()) return request.params;
    const Reply reply = worker.request(request, [](const Response&) {});
    const double ns = reply.response.ns_per_sample * static_cast<double>(request.params.size.pixels());
    if (ns > 0) request.params.spp = static_cast<int>(std::clamp(pass_ns / ns, 1.0, 1000.0));
    return request.params;
}

std::vector<Record> kernels_on(DeviceWorker& worker, const std::string& device) {
    std::vector<Record> records;
    for (const std::string& kernel : integrator_ids()) {
        if (!integrator(kernel).spheres) continue;
        Request request;
        request.kind = Request::Kind::run;
        request.params = case_of(worker, device, kernel);
        records.push_back(ask(worker, request, [](const Response&) {}));
    }
    return records;
}

MeasureOptions short_cases(const CommonFlags& flags) {
    MeasureOptions how;
    how.kernel_dir = flags.kernel_dir;
    how.max_time_s = 3;
    how.count = true;
    return how;
}

/// Each device in a worker of its own.
Limits limits_of(const DeviceList& list, const CommonFlags& flags) {
    const Stopped stopped = [&stop = watch_for_interruption()] { return stop.load(); };
    const OpenChannel open = process_channels(worker_launch(flags), std::chrono::minutes(2), stopped);
    Limits limits;
    for (const DeviceInfo& device : list.devices) {
        if (!device.excluded.empty() || stopped()) continue;
        tell(flags, fmt::format("measuring {}", device.key));
        DeviceWorker worker(device, open, short_cases(flags));
        limits.peaks.push_back(ask_peaks(worker, device.key));
        for (Record& record : kernels_on(worker, device.key)) limits.cases.push_back(std::move(record));
    }
    add_shares(limits.cases, limits.peaks);
    return limits;
}

}  // namespace

int list_command(const Options& options) {
    const DeviceList list = find_devices(options.common);
    const Limits limits = options.list.peaks ? limits_of(list, options.common) : Limits();
    options.list.json ? print_json(list, limits) : print_text(list, limits);
    if (any_usable(list)) return exit_codes::done;
    put(stderr, no_device_text(list) + "\n");
    return exit_codes::no_device;
}

}  // namespace ptb
