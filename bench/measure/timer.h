#pragma once

#include <cstdint>
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
/// cover. One such sample is a busy machine; a timer is at fault when most samples show it.
bool clocks_disagree(std::int64_t covered_ns, std::int64_t host_ns);

/// Adds one pass to a sample: times of its launches, and the host's.
void add_pass(TimeSample& sample, std::span<const LaunchTimes> launches, std::int64_t host_ns);

}  // namespace ptb
