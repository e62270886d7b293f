#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace ptb {

/// A limit of CPU time that a control group has.
struct CpuQuota {
    double cpus = 0;
    std::string file;  ///< that says so
    bool operator==(const CpuQuota&) const = default;
};

/// CPUs in a list of the kernel's: "0-3,8" has 5.
int count_cpus(const std::string& list);

/// CPUs that this process may run on (its affinity), as ROOT/proc says; 0 where that cannot be read.
int cpus_allowed(const std::filesystem::path& root = "/");

/// The smallest limit of this process' control groups, as ROOT/proc and ROOT/sys say.
std::optional<CpuQuota> cpu_quota(const std::filesystem::path& root = "/");

/// "1.5", or "none"
std::string quota_text(const std::optional<double>& cpus);

}  // namespace ptb
