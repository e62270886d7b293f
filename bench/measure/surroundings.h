#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bench/measure/cpu_time.h"
#include "bench/record/cpus.h"

namespace ptb {

/// What around this process may disturb measurements, as the kernel's files say; what cannot be read stays
/// as it is here.
struct Surroundings {
    int cpus_online = 0, cpus_allowed = 0;  ///< of the machine, and to this process
    CpuTicks ticks;                         ///< since boot
    bool virtual_machine = false, container = false, battery = false;
    std::map<std::string, int> governors;  ///< of CPU frequency, and how many CPUs have each
    std::optional<bool> boost;             ///< whether clocks may go over their nominal rate
    std::optional<CpuQuota> quota;         ///< the smallest of this process' control groups
};

/// Reads ROOT/proc and ROOT/sys.
Surroundings look_around(const std::filesystem::path& root = "/");

/// CPUs' worth of time that this process may use at most; infinite where nothing is known.
double usable_cpus(const Surroundings& host);

/// Threads that run or wait for a CPU now, this one left out: the median of five looks within 40 ms. A load
/// average would still hold what ended a minute ago.
int running_now(const std::filesystem::path& root = "/");

/// Whether times on that many CPUs will vary.
constexpr bool is_busy(int running, int cpus) { return running > 0 && 2 * running >= cpus; }

}  // namespace ptb
