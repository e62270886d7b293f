#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bench/measure/causes.h"
#include "bench/record/cpus.h"

namespace ptb {

/// What around this process may disturb measurements, as the kernel's files say; what cannot be read stays
/// as it is here.
struct Surroundings {
    double load_1min = 0;
    int cpus_online = 0, cpus_allowed = 0;  ///< of the machine, and to this process
    CpuTicks ticks;                         ///< since boot
    bool virtual_machine = false;
    std::map<std::string, int> governors;  ///< of CPU frequency, and how many CPUs have each
    std::optional<bool> boost;             ///< whether clocks may go over their nominal rate
    std::optional<CpuQuota> quota;         ///< the smallest of this process' control groups
};

/// Reads ROOT/proc and ROOT/sys.
Surroundings look_around(const std::filesystem::path& root = "/");

}  // namespace ptb
