#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/measure/advice.h"
#include "bench/record/record.h"

namespace ptb {

/// Why a sample is flagged (`TimeSample::cause`).
namespace cause {
inline constexpr auto first = "first";                  ///< nothing ran before it
inline constexpr auto clock_low = "clock_low";          ///< the device's clock was lower than its case's
inline constexpr auto steal = "steal";                  ///< the hypervisor took CPU time
inline constexpr auto busy = "busy";                    ///< other programs took CPU time
inline constexpr auto timer_fault = "timer_fault";      ///< its event times cannot be right
inline constexpr auto clocks_differ = "clocks_differ";  ///< the host waited far longer than its events cover
}  // namespace cause

/// Of a probe's time, how many times the usual one it may be.
inline constexpr double clock_limit = 1.05;
/// A share of CPU time that others took, from which on a sample is flagged: its time is at least that much
/// off.
inline constexpr double loss_limit = 0.05;
/// Half a median's 95 % interval, as a share of it, from which on the case is unstable.
inline constexpr double spread_limit = 0.05;

/// Flags the samples of one case whose probe took over 1.05 x the median of the case's probes: the clock was
/// lower than usual in it. Samples with another cause keep that.
void flag_low_clock(std::span<TimeSample> samples);

/// Of one render, where a sample holds `renders`; nanoseconds.
double time_ns(const TimeSample& sample, bool host_clock, int renders);

/// The times of one render that count. Flagged samples are left out while they are under half; else all stay.
/// By the host's clock, faulty event times are no flaw.
struct Kept {
    std::vector<double> times_ns;
    int flagged = 0;
};
Kept keep(std::span<const TimeSample> samples, bool host_clock, int renders);

/// Half or more of the samples lost time to something: all may be as wrong, whatever their interval is. What
/// it was, and what to do; empty when they did not. A clock that moves loses nothing: the interval tells it.
std::string lost_time(std::span<const TimeSample> samples, bool host_clock, const Place& place);

/// The exact 95 % interval of these samples' median is wider than +- 5 %: how wide, and what to do; empty
/// when it is not. Too few samples for an interval say nothing of their spread.
std::string vague_median(std::span<const TimeSample> samples, bool host_clock, int renders,
                         const Place& place);

}  // namespace ptb
