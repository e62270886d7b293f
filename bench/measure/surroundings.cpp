#include "bench/measure/surroundings.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <thread>

#include "bench/record/host.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

std::string word_of(const fs::path& file) {
    std::string word;
    std::ifstream(file) >> word;
    return word;
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
    if (const auto on = kernel_number(cpus / "cpufreq/boost")) return *on != 0;
    if (const auto off = kernel_number(cpus / "intel_pstate/no_turbo")) return *off == 0;
    return std::nullopt;
}

bool in_virtual_machine(const fs::path& root, const std::string& cpuinfo) {
    const std::string flags = " " + value_after(cpuinfo, "flags", ':') + " ";
    std::error_code ignored;
    return flags.find(" hypervisor ") != std::string::npos ||
           fs::exists(root / "sys/hypervisor/type", ignored);
}

/// Container runtimes leave a file in the root or a word in the group's name.
bool in_container(const fs::path& root) {
    for (const char* file : {".dockerenv", "run/.containerenv", "run/systemd/container"})
        if (std::error_code ignored; fs::exists(root / file, ignored)) return true;
    const std::string groups = kernel_text(root / "proc/self/cgroup");
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
    const std::string found = value_after(kernel_text(root / "proc/stat"), "procs_running", ' ');
    return found.empty() ? 0 : std::max(std::atoi(found.c_str()) - 1, 0);
}

}  // namespace

Surroundings look_around(const fs::path& root) {
    const fs::path cpus = root / "sys/devices/system/cpu";
    const std::string stat = kernel_text(root / "proc/stat");
    Surroundings found;
    found.cpus_online = count_cpus(word_of(cpus / "online"));
    found.cpus_allowed = cpus_allowed(root);
    found.ticks = parse_cpu_ticks(stat.substr(0, stat.find('\n')));
    found.virtual_machine = in_virtual_machine(root, kernel_text(root / "proc/cpuinfo"));
    found.container = in_container(root);
    found.battery = has_battery(root / "sys/class/power_supply");
    found.governors = governors_in(cpus);
    found.boost = boost_in(cpus);
    found.quota = cpu_quota(root);
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
