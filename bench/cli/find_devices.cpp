#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "bench/cli/commands.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/tell.h"
#include "bench/plan/data_dir.h"

namespace ptb {

WorkerLaunch worker_launch(const CommonFlags& flags) {
    const std::chrono::duration<double> start_timeout(flags.start_timeout_s);
    return {self_path().string(), split_words(flags.launcher),
            std::chrono::duration_cast<std::chrono::milliseconds>(start_timeout),
            [flags](const std::string& words) { tell_waiting(flags, words); }};
}

namespace {

DeviceList probe_through(const WorkerLaunch& launch, const Stopped& stopped) {
    if (launch.launcher.empty()) return probe(find_icds(), launch, probe_patience, stopped);
    try {
        // Behind a launcher may be another machine, or a tool that stands in for all drivers: its loader
        // decides.
        return probe({any_icd}, launch, probe_patience, stopped);
    } catch (const NoWorker&) {
        throw;
    } catch (const TwoWorkers&) {
        throw;
    } catch (const std::exception& error) {
        throw UsageError(fmt::format("--launcher: {}", error.what()));
    }
}

}  // namespace

DeviceList find_devices(const CommonFlags& flags) {
    const auto& stop = watch_for_interruption();
    DeviceList list = probe_through(worker_launch(flags), [&stop] { return stop.load(); });
    if (stop) throw Interrupted();
    return list;
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
