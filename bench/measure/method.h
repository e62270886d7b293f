#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/measure/advice.h"
#include "bench/measure/sampler.h"
#include "bench/measure/stop_rule.h"
#include "bench/measure/timer.h"
#include "bench/record/record.h"

namespace ptb {

/// How one case is to be measured.
struct Method {
    StopRule stop;
    std::optional<int> warmup;  ///< untimed samples; absent: until steady
    double predicted_s = 0;     ///< of one render
    std::uint64_t resolution_ns = 0;
};

/// What came of it.
struct Measurement {
    std::vector<TimeSample> samples;
    int renders = 1;  ///< in each sample
    std::string stop_reason;
};

/// Takes one sample of so many renders; the stage is "warmup" or "sample".
using TakeSample = std::function<TimedRender(const std::string& stage, int renders)>;
/// Seconds since any fixed moment.
using Seconds = std::function<double()>;

/// Measures one case: warms up, then samples until the rule says stop. `timer` hears of every sample, and
/// says which clock to believe.
Measurement measure(const Method& method, TimerWatch& timer, const TakeSample& take, const Seconds& now_s);

/// Describes what was measured by the clock to believe, per render.
Statistics describe(const Measurement& measurement, const TimerWatch& timer);

/// Why the times are not those of the device, and what to do; empty when they are.
std::string wrong_times(const Measurement& measurement, const TimerWatch& timer, const Place& place);

/// Why the median is not to be trusted: wrong times, or an interval that is too wide. Empty when it is.
std::string unstable_reason(const Measurement& measurement, const TimerWatch& timer, const Place& place);

}  // namespace ptb
