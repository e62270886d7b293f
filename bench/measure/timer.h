#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "bench/record/record.h"
#include "core/render/render.h"

namespace ptb {

/// Length of the union of the launches' [start, end] intervals, ns: overlapping launches count once.
std::int64_t union_ns(std::span<const LaunchTimes> launches);

/// What is wrong with the events of one pass that took `host_ns` by the host's clock, or nothing. Rules: 0 < start <=
/// end; queued <= submit <= start; no launch longer than the host saw (2 % and one tick of the timer allowed); over 10
/// ms, the host waited at most 20 % longer than from the first launch queued to the last one ended.
std::string timer_fault(std::span<const LaunchTimes> launches, std::int64_t host_ns, std::uint64_t resolution_ns);

/// Adds one pass to a sample: times of its launches, and the host's.
void add_pass(TimeSample& sample, std::span<const LaunchTimes> launches, std::int64_t host_ns);

}  // namespace ptb
