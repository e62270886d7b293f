#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// Why a sample is flagged (`TimeSample::cause`).
namespace cause {
inline constexpr auto first = "first";              ///< nothing ran before it
inline constexpr auto clock_low = "clock_low";      ///< the device's clock was below the session's best
inline constexpr auto steal = "steal";              ///< the hypervisor took CPU time
inline constexpr auto timer_fault = "timer_fault";  ///< its event times cannot be right
}  // namespace cause

/// Ticks that all CPUs together have counted since boot.
struct CpuTicks {
    std::uint64_t all = 0, stolen = 0;
};

/// The first line of /proc/stat; zeros for anything else.
CpuTicks parse_cpu_ticks(std::string_view line);

/// The hypervisor took over 2 % of the time between two readings, and more than one tick.
bool stolen(const CpuTicks& before, const CpuTicks& after);

/// The device's clock as the time of a fixed piece of work shows it. A time over 1.05 x the session's best is
/// a low clock.
class ClockWatch {
  public:
    bool low(std::int64_t probe_ns);

  private:
    std::int64_t best_ns_ = 0;
};

/// Of one render, where a sample holds `renders`; nanoseconds.
double time_ns(const TimeSample& sample, bool host_clock, int renders);

/// The times of one render that count. Flagged samples are left out while they are under half; else all stay
/// and the case is unstable. By the host's clock, faulty event times are no flaw.
struct Kept {
    std::vector<double> times_ns;
    int flagged = 0;
    bool unstable = false;
};
Kept keep(std::span<const TimeSample> samples, bool host_clock, int renders);

/// "5 of 9 samples are flagged (clock_low 5): ...", with what to do about it.
std::string flags_text(std::span<const TimeSample> samples, bool host_clock);

}  // namespace ptb
