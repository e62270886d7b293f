#include "bench/doctor/surroundings.h"

#include <fstream>

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

}  // namespace

Surroundings look_around(const fs::path& root) {
    const fs::path cpus = root / "sys/devices/system/cpu";
    const std::string stat = kernel_text(root / "proc/stat");
    Surroundings found;
    found.load_1min = kernel_number(root / "proc/loadavg").value_or(0);
    found.cpus_online = count_cpus(word_of(cpus / "online"));
    found.cpus_allowed = cpus_allowed(root);
    found.ticks = parse_cpu_ticks(stat.substr(0, stat.find('\n')));
    found.virtual_machine = in_virtual_machine(root, kernel_text(root / "proc/cpuinfo"));
    found.governors = governors_in(cpus);
    found.boost = boost_in(cpus);
    found.quota = cpu_quota(root);
    return found;
}

}  // namespace ptb
