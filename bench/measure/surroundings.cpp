#include "bench/measure/surroundings.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <thread>
#include <vector>

#include "bench/record/host.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string word_of(const fs::path& file) {
    std::string word;
    std::ifstream(file) >> word;
    return word;
}

std::optional<double> number_of(const fs::path& file) {
    double value = 0;
    return std::ifstream(file) >> value ? std::optional(value) : std::nullopt;
}

std::map<std::string, int> governors_in(const fs::path& cpus) {
    std::map<std::string, int> governors;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(cpus, ignored))
        if (const auto word = word_of(entry.path() / "cpufreq/scaling_governor"); !word.empty())
            ++governors[word];
    return governors;
}

/// The generic switch, or Intel's, which says the opposite.
std::optional<bool> boost_in(const fs::path& cpus) {
    if (const auto on = number_of(cpus / "cpufreq/boost")) return *on != 0;
    if (const auto off = number_of(cpus / "intel_pstate/no_turbo")) return *off == 0;
    return std::nullopt;
}

/// Version 2 has quota and period in one file ("max 100000" is no limit), version 1 in two (-1 is none).
std::optional<CpuQuota> quota_in(const fs::path& group) {
    double quota = 0, period = 0;
    if (std::ifstream(group / "cpu.max") >> quota >> period && period > 0)
        return CpuQuota{quota / period, (group / "cpu.max").string()};
    const auto v1 = number_of(group / "cpu.cfs_quota_us"), of = number_of(group / "cpu.cfs_period_us");
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

/// Lines of /proc/self/cgroup: "0::/user.slice" (version 2), "4:cpu,cpuacct:/docker/9f86" (version 1).
std::optional<CpuQuota> smallest_quota(const fs::path& root) {
    std::optional<CpuQuota> smallest;
    std::istringstream lines(text_of(root / "proc/self/cgroup"));
    for (std::string id, controllers, path;
         std::getline(lines, id, ':') && std::getline(lines, controllers, ':') && std::getline(lines, path);)
        for (const char* mount : {"", "unified", "cpu", "cpu,cpuacct"})
            for (const fs::path& group : groups_up_from(root / "sys/fs/cgroup" / mount, path))
                if (const auto quota = quota_in(group); quota && (!smallest || quota->cpus < smallest->cpus))
                    smallest = quota;
    return smallest;
}

bool in_virtual_machine(const fs::path& root, const std::string& cpuinfo) {
    const std::string flags = " " + value_after(cpuinfo, "flags", ':') + " ";
    return flags.find(" hypervisor ") != std::string::npos || fs::exists(root / "sys/hypervisor/type");
}

/// Container runtimes leave a file in the root or a word in the group's name.
bool in_container(const fs::path& root) {
    for (const char* file : {".dockerenv", "run/.containerenv", "run/systemd/container"})
        if (fs::exists(root / file)) return true;
    const std::string groups = text_of(root / "proc/self/cgroup");
    constexpr std::array words{"/docker", "/kubepods", "/lxc", "/containerd"};
    return std::any_of(words.begin(), words.end(),
                       [&](const char* word) { return groups.find(word) != std::string::npos; });
}

bool has_battery(const fs::path& supplies) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(supplies, ignored))
        if (word_of(entry.path() / "type") == "Battery" && word_of(entry.path() / "scope") != "Device")
            return true;
    return false;
}

int procs_running(const fs::path& root) {
    const std::string found = value_after(text_of(root / "proc/stat"), "procs_running", ' ');
    return found.empty() ? 0 : std::max(std::atoi(found.c_str()) - 1, 0);
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

Surroundings look_around(const fs::path& root) {
    const fs::path cpus = root / "sys/devices/system/cpu";
    const std::string stat = text_of(root / "proc/stat");
    Surroundings found;
    found.cpus_online = count_cpus(word_of(cpus / "online"));
    found.cpus_allowed =
        count_cpus(value_after(text_of(root / "proc/self/status"), "Cpus_allowed_list", ':'));
    found.ticks = parse_cpu_ticks(stat.substr(0, stat.find('\n')));
    found.virtual_machine = in_virtual_machine(root, text_of(root / "proc/cpuinfo"));
    found.container = in_container(root);
    found.battery = has_battery(root / "sys/class/power_supply");
    found.governors = governors_in(cpus);
    found.boost = boost_in(cpus);
    found.quota = smallest_quota(root);
    return found;
}

double usable_cpus(const Surroundings& host) {
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    const double allowed = host.cpus_allowed > 0 ? host.cpus_allowed : unlimited;
    return std::min(allowed, host.quota ? host.quota->cpus : unlimited);
}

int running_now(const fs::path& root) {
    std::array<int, 5> looks{};
    for (int& look : looks) {
        if (&look != looks.data()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        look = procs_running(root);
    }
    std::sort(looks.begin(), looks.end());
    return looks[looks.size() / 2];
}

}  // namespace ptb
