#include <fmt/format.h>

#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/tell.h"
#include "bench/plan/data_dir.h"
#include "bench/record/json.h"
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
            text += fmt::format("platform {}: {}, {} ({})\n", d.platform_index, printable(d.platform),
                                printable(d.platform_version), d.icd.empty() ? "any driver" : d.icd);
        }
        platform = d.platform_index;
        text += device_text(d);
    }
    return text;
}

std::string broken_text(const std::vector<BrokenIcd>& broken) {
    std::string text;
    for (const BrokenIcd& each : broken) {
        text += fmt::format("not usable: {}: {}\n", each.icd, printable(each.reason));
    }
    return text;
}

void print_text(const DeviceList& list) {
    put(stdout,
        fmt::format("{}{}\nkernels: {}\nscenes:  {}\nconfigs: {}\naxes:    {}\n", devices_text(list.devices),
                    broken_text(list.broken), fmt::join(kernel_names(), " "), fmt::join(scene_names(), " "),
                    fmt::join(config_names(), " "), fmt::join(axis_names(), " ")));
}

void print_json(const DeviceList& list) {
    const Json json{{"devices", list.devices}, {"broken_icds", list.broken}, {"kernels", kernel_names()},
                    {"scenes", scene_names()}, {"configs", config_names()},  {"axes", axis_names()}};
    put(stdout, dump_json(json, 2) + "\n");
}

}  // namespace

int list_command(const Options& options) {
    const DeviceList list = find_devices(options.common);
    options.list.json ? print_json(list) : print_text(list);
    if (any_usable(list)) return exit_codes::done;
    put(stderr, no_device_text(list) + "\n");
    return exit_codes::no_device;
}

}  // namespace ptb
