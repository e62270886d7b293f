#include <fmt/format.h>

#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/tell.h"
#include "bench/plan/data_dir.h"
#include "bench/record/json.h"
#include "bench/report/sections.h"
#include "bench/worker/coordinator.h"
#include "core/input/printable.h"
#include "core/integrator/registry.h"

namespace ptb {
namespace {

std::vector<std::string> kernel_names() {
    std::vector<std::string> names;
    for (const auto& integrator : integrators()) names.push_back(std::string(integrator.id));
    return names;
}

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

void print_text(const DeviceList& list, const std::vector<DevicePeaks>& peaks) {
    put(stdout, fmt::format("{}{}{}\nkernels: {}\nscenes:  {}\nconfigs: {}\naxes:    {}\n",
                            devices_text(list.devices), broken_text(list.broken),
                            peaks.empty() ? "" : "\n" + to_text(peaks_section(peaks)),
                            fmt::join(kernel_names(), " "), fmt::join(scene_names(), " "),
                            fmt::join(config_names(), " "), fmt::join(axis_names(), " ")));
}

void print_json(const DeviceList& list, const std::vector<DevicePeaks>& peaks) {
    const Json json{{"peaks", encode(peaks)},    {"devices", list.devices}, {"broken_icds", list.broken},
                    {"kernels", kernel_names()}, {"scenes", scene_names()}, {"configs", config_names()},
                    {"axes", axis_names()}};
    put(stdout, dump_json(json, 2) + "\n");
}

/// Each in a worker of its own.
std::vector<DevicePeaks> peaks_of(const DeviceList& list, const CommonFlags& flags) {
    const Stopped stopped = [&stop = watch_for_interruption()] { return stop.load(); };
    const OpenChannel open = process_channels(worker_launch(flags), std::chrono::minutes(2), stopped);
    MeasureOptions how;
    how.kernel_dir = flags.kernel_dir;
    std::vector<DevicePeaks> all;
    for (const DeviceInfo& device : list.devices) {
        if (!device.excluded.empty() || stopped()) continue;
        tell(flags, fmt::format("measuring {}", device.key));
        DeviceWorker worker(device, open, how);
        all.push_back(ask_peaks(worker, device.key));
    }
    return all;
}

}  // namespace

int list_command(const Options& options) {
    const DeviceList list = find_devices(options.common);
    const auto peaks = options.list.peaks ? peaks_of(list, options.common) : std::vector<DevicePeaks>();
    options.list.json ? print_json(list, peaks) : print_text(list, peaks);
    if (any_usable(list)) return exit_codes::done;
    put(stderr, no_device_text(list) + "\n");
    return exit_codes::no_device;
}

}  // namespace ptb
