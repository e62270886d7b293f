#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/doctor/remarks.h"

namespace ptb {
namespace {

using Weight = Remark::Weight;

constexpr double steal_limit = 0.02;  ///< of the CPUs' time

Remark fine(const char* about, std::string seen) { return {Weight::fine, about, "", std::move(seen), ""}; }

}  // namespace

std::string to_string(Remark::Weight weight) {
    return weight == Weight::fine ? "fine" : weight == Weight::note ? "note" : "warning";
}

Remark load_remark(int running, int cpus) {
    const std::string seen =
        fmt::format("threads of other programs that run now: {}, on {} CPUs", running, cpus);
    if (!is_busy(running, cpus)) return fine("load", seen);
    return {Weight::warning, "load", "", seen,
            "times on CPUs will vary: end what `top` shows, or keep it off some CPUs and measure there, e.g. "
            "`taskset -c 0 ptbench ...`"};
}

Remark steal_remark(const CpuTicks& before, const CpuTicks& after) {
    const double share = stolen_share(before, after);
    const std::string seen = fmt::format("the hypervisor took {:.1f} % of the CPUs' time {}", 100 * share,
                                         before.all == 0 ? "since boot" : "during the A/A runs");
    if (share <= steal_limit) return fine("steal", seen);
    return {Weight::warning, "steal", "", seen,
            "other virtual machines take this one's CPUs: use dedicated ones, or gate with `ptbench ab "
            "--require-mde 10%`"};
}

Remark governor_remark(const Surroundings& host) {
    std::vector<std::string> names;
    for (const auto& [name, cpus] : host.governors) names.push_back(fmt::format("{} ({} CPUs)", name, cpus));
    if (names.empty())
        return {host.virtual_machine ? Weight::fine : Weight::note, "governor", "",
                "the kernel shows no control of CPU frequency",
                host.virtual_machine ? "" : "look for it in the firmware's settings"};
    const std::string seen = fmt::format("CPU frequency is governed by {}", fmt::join(names, ", "));
    if (names.size() == 1 && host.governors.contains("performance")) return fine("governor", seen);
    return {
        Weight::warning, "governor", "", seen,
        "clocks rise and fall with the load: `sudo cpupower frequency-set -g performance` (apt-get install "
        "linux-cpupower)"};
}

Remark boost_remark(const Surroundings& host) {
    if (!host.boost) return fine("boost", "the kernel shows no switch for boost clocks");
    if (!*host.boost) return fine("boost", "boost clocks are off");
    return {Weight::note, "boost", "", "boost clocks are on: heat and neighbours decide how high they go",
            "for steady times: `echo 0 | sudo tee /sys/devices/system/cpu/cpufreq/boost`, on Intel `echo 1 | "
            "sudo "
            "tee /sys/devices/system/cpu/intel_pstate/no_turbo`"};
}

Remark virtualisation_remark(const Surroundings& host) {
    if (!host.virtual_machine) return fine("virtualisation", "no hypervisor");
    return {
        Weight::note, "virtualisation", "",
        "a virtual machine: neighbours share caches, memory and clocks, and no counter shows it",
        "compare versions side by side (`ptbench ab`), not with times of another day (`ptbench compare`)"};
}

Remark cpu_limit_remark(const Surroundings& host) {
    if (host.quota && host.quota->cpus < host.cpus_online)
        return {
            Weight::warning, "cpu limit", "",
            fmt::format("a quota of {:g} CPUs of {} ({})", host.quota->cpus, host.cpus_online,
                        host.quota->file),
            "work is halted when the quota of a period is used up: give whole CPUs instead, e.g. `docker run "
            "--cpuset-cpus=0-3`, `systemd-run -p AllowedCPUs=0-3`"};
    const std::string seen = fmt::format("{} of {} CPUs, no quota", host.cpus_allowed, host.cpus_online);
    if (host.cpus_allowed == host.cpus_online) return fine("cpu limit", seen);
    return {Weight::note, "cpu limit", "", seen, "to see or change it: `taskset -p $$`"};
}

std::vector<Remark> host_remarks(const Surroundings& host, int running) {
    return {load_remark(running, std::max(host.cpus_online, 1)), governor_remark(host), boost_remark(host),
            virtualisation_remark(host), cpu_limit_remark(host)};
}

}  // namespace ptb
