#include "bench/record/cpus.h"

#include <fstream>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "bench/record/host.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

/// Version 2 has quota and period in one file ("max 100000" is no limit), version 1 in two (-1 is none).
std::optional<CpuQuota> quota_in(const fs::path& group) {
    double quota = 0, period = 0;
    if (std::ifstream(group / "cpu.max") >> quota >> period && period > 0)
        return CpuQuota{quota / period, (group / "cpu.max").string()};
    const auto v1 = kernel_number(group / "cpu.cfs_quota_us"),
               of = kernel_number(group / "cpu.cfs_period_us");
    if (!v1 || !of || *v1 <= 0 || *of <= 0) return std::nullopt;
    return CpuQuota{*v1 / *of, (group / "cpu.cfs_quota_us").string()};
}

/// The folders of a group and of those that it is in. Within a container its path may not be seen; what can
/// be seen above it counts.
std::vector<fs::path> groups_up_from(const fs::path& mount, fs::path group) {
    std::vector<fs::path> folders;
    for (group = group.relative_path(); !group.empty(); group = group.parent_path())
        folders.push_back(mount / group);
    folders.push_back(mount);
    return folders;
}

}  // namespace

int count_cpus(const std::string& list) {
    int count = 0;
    std::istringstream ranges(list);
    for (std::string range; std::getline(ranges, range, ',');) {
        int first = 0, last = 0;
        char dash = 0;
        std::istringstream text(range);
        if (!(text >> first)) continue;
        count += text >> dash >> last && last >= first ? last - first + 1 : 1;
    }
    return count;
}

int cpus_allowed(const fs::path& root) {
    return count_cpus(value_after(kernel_text(root / "proc/self/status"), "Cpus_allowed_list", ':'));
}

// Lines of /proc/self/cgroup: "0::/user.slice" (version 2), "4:cpu,cpuacct:/docker/9f86" (version 1).
std::optional<CpuQuota> cpu_quota(const fs::path& root) {
    std::optional<CpuQuota> smallest;
    std::ifstream lines(root / "proc/self/cgroup");
    for (std::string id, controllers, path;
         std::getline(lines, id, ':') && std::getline(lines, controllers, ':') && std::getline(lines, path);)
        for (const char* mount : {"", "unified", "cpu", "cpu,cpuacct"})
            for (const fs::path& group : groups_up_from(root / "sys/fs/cgroup" / mount, path))
                if (const auto quota = quota_in(group); quota && (!smallest || quota->cpus < smallest->cpus))
                    smallest = quota;
    return smallest;
}

std::string quota_text(const std::optional<double>& cpus) {
    return cpus ? fmt::format("{:.6g}", *cpus) : "none";
}

}  // namespace ptb
