#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/compare/gate.h"
#include "bench/measure/surroundings.h"
#include "bench/worker/probe.h"

namespace ptb {

/// One thing that was looked at.
struct Remark {
    enum class Weight { fine, note, warning };
    Weight weight = Weight::fine;
    std::string about;   ///< "load", "steal", ...
    std::string device;  ///< key of the device it is about, or empty: the host
    std::string seen;
    std::string advice;  ///< what to do, with the command; empty where all is fine
    bool operator==(const Remark&) const = default;
};
std::string to_string(Remark::Weight weight);

/// Of what runs beside this process now.
Remark load_remark(int running, int cpus);
/// CPU time that a hypervisor took between two readings.
Remark steal_remark(const CpuTicks& before, const CpuTicks& after);
Remark governor_remark(const Surroundings& host);
Remark boost_remark(const Surroundings& host);
Remark virtualisation_remark(const Surroundings& host);
/// Control groups and affinity: CPUs that this process may not use.
Remark cpu_limit_remark(const Surroundings& host);

/// All of the above but steal; `running` beside this process.
std::vector<Remark> host_remarks(const Surroundings& host, int running);

/// Broken drivers, and devices that several drivers show; one that all is well when all is.
std::vector<Remark> driver_remarks(const DeviceList& list);

/// An A/A run of one device: the same binary as both sides of `ptbench ab`.
struct SelfComparison {
    DeviceInfo device;
    GateCase gate;
    Finding finding;
    std::string timer_reason;  ///< why event times are not believed, or empty
};

/// Whether the device can time its work, how finely it claims to, and what event times advance by.
Remark timer_remark(const SelfComparison& aa);
/// Whether two equal sides come out equal.
Remark self_remark(const SelfComparison& aa);
/// The smallest change that `ptbench ab` is likely to see here.
Remark sight_remark(const SelfComparison& aa);

/// The greatest time, ns, that all event times of these blocks are multiples of; 0 when there are none.
std::uint64_t shown_tick_ns(const std::vector<Block>& blocks);

/// That change for a tolerance: a ratio less 1.
double smallest_change(const SelfComparison& aa, double tolerance);

}  // namespace ptb
