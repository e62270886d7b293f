#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "bench/record/record.h"
#include "core/render/render.h"

namespace ptb {

/// Length of the union of the launches' [start, end] intervals, ns: overlapping launches count once.
std::int64_t union_ns(std::span<const LaunchTimes> launches);

/// What is wrong with the events of one pass that took `host_ns` by the host's clock, or nothing. Rules: 0 <
/// start <= end; queued <= submit <= start; no launch longer than the host saw (2 % and one tick of the timer
/// allowed).
std::string timer_fault(std::span<const LaunchTimes> launches, std::int64_t host_ns,
                        std::uint64_t resolution_ns);

/// From the first launch queued to the last one ended, ns: what the host should have waited. Longer than the
/// launches themselves where a runtime compiles before it starts one.
std::int64_t covered_ns(std::span<const LaunchTimes> launches);

/// Two clocks on the same work disagree: over 10 ms, the host waited more than 20 % longer than the events
/// cover; time for which it was ready to go on and got no CPU is not waited. One such sample may be a busy
/// machine; a timer is at fault when most samples show it.
bool clocks_disagree(std::int64_t covered_ns, std::int64_t host_ns);

/// Renders in a sample: as many as make it last 100 ticks of the timer, at most 10,000.
int renders_per_sample(double render_ns, std::uint64_t resolution_ns);

/// Greatest common divisor of all distances between the launches' timestamps, and of `so_far`: what the clock
/// advances by, whatever its driver says. 0 as long as nothing is known.
std::uint64_t tick_ns(std::span<const LaunchTimes> launches, std::uint64_t so_far);

/// Adds one pass to a sample: times of its launches, and the host's.
void add_pass(TimeSample& sample, std::span<const LaunchTimes> launches, std::int64_t host_ns);

/// Share of the launches' own times that ran beside another's, over all samples; nothing without times.
std::optional<double> overlap_of(std::span<const TimeSample> samples);

/// What the timer's rules found in one sample.
struct TimerEvidence {
    std::string fault;       ///< what contradicts itself in the events, or nothing
    bool disagrees = false;  ///< with the host's clock
    std::uint64_t tick_ns = 0;
};

/// Decides by which clock a device is measured: by its own until that is caught wrong, or as asked for
/// ("auto", "event", "host"). Clocks that disagree are a fault once most samples of a case show it, and of
/// the device if those were three or more.
class TimerWatch {
  public:
    explicit TimerWatch(std::string asked);
    /// Another case begins; what is known of the device stays.
    void restart();
    void observe(const TimerEvidence& evidence);
    bool host() const;
    /// How the device's clock contradicted itself, or nothing.
    const std::string& fault() const { return fault_; }
    /// Why the host's clock is used, or nothing.
    std::string reason() const;
    /// The coarser of what the driver says, what the timestamps show, and what the host's clock can.
    std::uint64_t resolution_ns(std::uint64_t claimed_ns) const;

  private:
    std::string asked_, fault_;
    int samples_ = 0, disagreeing_ = 0;
    std::uint64_t tick_ns_ = 0;
};

}  // namespace ptb
