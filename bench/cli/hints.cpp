#include "bench/cli/hints.h"

#include <algorithm>

#include <fmt/format.h>

namespace ptb {
namespace {

bool any_has(const std::vector<Record>& records, Status status) {
    return std::any_of(records.begin(), records.end(), [=](const Record& r) { return r.status == status; });
}

bool all_smaller_than(const std::vector<Record>& records, int width) {
    return std::all_of(records.begin(), records.end(),
                       [=](const Record& r) { return r.params.size.width < width; });
}

/// A device that was there and not measured.
std::string unused_device_hint(const std::vector<DeviceInfo>& all, const std::vector<DeviceInfo>& used) {
    for (const DeviceInfo& device : all) {
        const bool measured =
            std::any_of(used.begin(), used.end(), [&](const DeviceInfo& u) { return u.key == device.key; });
        if (!measured && device.excluded.empty())
            return fmt::format("-d {} measures {}", device.key, device.name);
    }
    return {};
}

}  // namespace

std::vector<std::string> hints(const Config& config, const std::vector<DeviceInfo>& all_devices,
                               const std::vector<DeviceInfo>& used, const std::vector<Record>& records) {
    std::vector<std::string> lines;
    const std::string unused = unused_device_hint(all_devices, used);
    if (!unused.empty()) lines.push_back(unused);
    if (any_has(records, Status::skipped) && config.max_total_time_s > 0) {
        lines.push_back("--max-total-time 0 runs what did not fit into the budget");
    }
    if (config.name == "quick" && all_smaller_than(records, 1024)) {
        lines.push_back("--size 1024 gives GPUs enough work");
        lines.push_back("--config thesis measures the thesis' Table 1 as it was");
    }
    return lines;
}

}  // namespace ptb
