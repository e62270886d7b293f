#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace ptb {

/// Ticks that all CPUs together have counted since boot.
struct CpuTicks {
    std::uint64_t all = 0, stolen = 0;
};

/// The first line of /proc/stat; zeros for anything else.
CpuTicks parse_cpu_ticks(std::string_view line);

/// What the hypervisor took of the time between two readings; a single tick may be rounding.
double stolen_share(const CpuTicks& before, const CpuTicks& after);

/// What the system's scheduler gave to threads: time on a CPU, and time that they were ready and had none.
struct Scheduled {
    std::int64_t ran_ns = 0, waited_ns = 0;
    bool operator==(const Scheduled&) const = default;
};

/// "296562452 898261 29", as the kernel's schedstat files have it; zeros for anything else.
Scheduled parse_scheduled(std::string_view text);

/// Of all threads of this process, from ROOT/proc/self/task; zeros where the kernel does not count.
Scheduled scheduled_process(const std::filesystem::path& root = "/");

/// Of the calling thread.
Scheduled scheduled_thread();

/// Share of the CPU time that a process could have had on `cpus` CPUs in `wall_ns` and others had instead.
/// More threads than CPUs wait for each other: that is no loss.
double lost_share(const Scheduled& before, const Scheduled& after, double wall_ns, double cpus);

}  // namespace ptb
