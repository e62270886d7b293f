#pragma once

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/record/record.h"
#include "bench/worker/icd.h"
#include "bench/worker/identity.h"
#include "bench/worker/process.h"
#include "bench/worker/waiting.h"

namespace ptb {

/// Every OpenCL device of this machine, and every driver that could not be asked.
struct DeviceList {
    std::vector<DeviceInfo> devices;
    std::vector<BrokenIcd> broken;
    bool operator==(const DeviceList&) const = default;
};

/// How worker processes are started.
struct WorkerLaunch {
    std::string executable;             ///< of ptbench itself
    std::vector<std::string> launcher;  ///< words before it: {"srun", "-n1", "-w", "node7"}
    std::chrono::milliseconds start_timeout = std::chrono::minutes(10);  ///< of the launcher
    TellWaiting waiting = {};                                            ///< for it; or nobody
};

/// Command of a worker that sees only the driver in `icd_folder`; `nonce` is a word of it.
ChildCommand worker_command(const WorkerLaunch& launch, const IcdFolder& icd_folder, const std::string& nonce,
                            std::vector<std::string> arguments);

/// A launcher that started no worker. Ends the run with exit code 1.
struct NoWorker : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// "--launcher: no worker within 600 s (--start-timeout)"
std::string no_start_text(const WorkerLaunch& launch);

inline constexpr std::chrono::seconds probe_patience(10);

/// Asks each driver in a process of its own, all at the same time. A driver that crashes, hangs or answers
/// nonsense, or does not before `stopped`, becomes one line in `broken`. Throws NoWorker and TwoWorkers.
DeviceList probe(const std::vector<Icd>& icds, const WorkerLaunch& launch,
                 std::chrono::milliseconds patience = probe_patience, const Stopped& stopped = {});

/// Numbers platforms and devices across drivers, makes keys unique and excludes devices found twice. `by_icd`
/// in the order of the drivers.
std::vector<DeviceInfo> join_devices(const std::vector<std::vector<DeviceInfo>>& by_icd);

/// Key of a device among those of its own driver: "pocl@2:0", the second driver that calls itself pocl, is
/// "pocl:0" to its worker.
std::string local_key(const std::string& key);

/// What `ptbench worker --probe` prints before it asks a driver, and its reader: nothing for another line.
std::string started_line(const WorkerIdentity& worker);
std::optional<WorkerIdentity> parse_started_line(const std::string& line);

/// The line it then prints, and its reader; throws std::runtime_error with the reason.
std::string probe_line(const std::vector<DeviceInfo>& devices);
std::string probe_error_line(const std::string& reason);
std::vector<DeviceInfo> parse_probe_line(const std::string& line);

}  // namespace ptb
