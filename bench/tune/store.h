#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// What a race found for one kernel on one device.
struct TunedKernel {
    std::string device_name, device_uuid, driver;  ///< of whom it is true
    std::string kernel_hash;
    Case best;               ///< as it was raced; its lanes and work_group are the result
    std::vector<Case> ties;  ///< as good as the best, it included
    int samples = 0;         ///< of the best
    std::string tuned_at;    ///< ISO 8601, UTC
    bool operator==(const TunedKernel&) const = default;
};

/// "Portable Computing Language OpenCL 3.0 PoCL 3.1, 3.1": a driver that differs may be fast elsewhere.
std::string driver_of(const DeviceInfo& device);

/// The result of a race on this device.
TunedKernel tuned_kernel(const DeviceInfo& device, const std::string& kernel_hash, const Case& best);

/// $XDG_CONFIG_HOME/ptbench/tune.json, or below ~/.config; empty when neither variable is set.
std::filesystem::path default_tune_file();

/// Results in `file`, schema "ptbench.tune.v1"; none when it does not exist. Throws UsageError, one line, on
/// anything else.
std::vector<TunedKernel> read_tuned(const std::filesystem::path& file);

/// Puts `fresh` in the place of an older result for the same device and kernel; the file is replaced whole.
/// Throws UsageError when the file holds something else, std::runtime_error when it cannot be written.
void store_tuned(const std::filesystem::path& file, const TunedKernel& fresh);

/// What is true of this device and kernel text, or why what is stored is not, or neither.
struct TunedLookup {
    const TunedKernel* found = nullptr;
    std::string stale;  ///< "tuned for driver 3.0, this is 3.1"
};
TunedLookup look_up(const std::vector<TunedKernel>& stored, const DeviceInfo& device,
                    const std::string& kernel, const std::string& kernel_hash);

}  // namespace ptb
