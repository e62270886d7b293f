#include <algorithm>

#include <fmt/format.h>

#include "bench/cli/commands.h"
#include "bench/plan/data_dir.h"

namespace ptb {

WorkerLaunch worker_launch(const CommonFlags& flags) {
    return {self_path().string(), split_words(flags.launcher)};
}

DeviceList find_devices(const CommonFlags& flags) {
    const WorkerLaunch launch = worker_launch(flags);
    if (launch.launcher.empty()) return probe(find_icds(), launch);
    try {
        // Behind a launcher may be another machine, or a tool that stands in for all drivers: its loader
        // decides.
        return probe({any_icd}, launch);
    } catch (const std::exception& error) {
        throw UsageError(fmt::format("--launcher: {}", error.what()));
    }
}

bool any_usable(const DeviceList& list) {
    return std::any_of(list.devices.begin(), list.devices.end(),
                       [](const DeviceInfo& device) { return device.excluded.empty(); });
}

std::string no_device_text(const DeviceList& list) {
    std::string text = "no OpenCL device found; install a driver, e.g. `apt-get install pocl-opencl-icd`";
    for (const BrokenIcd& broken : list.broken) text += fmt::format("; {}: {}", broken.icd, broken.reason);
    return text;
}

}  // namespace ptb
