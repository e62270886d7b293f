#include "bench/measure/method.h"

#include <algorithm>

#include "bench/measure/causes.h"
#include "bench/measure/statistics.h"

namespace ptb {

namespace {

double headline_ns(const TimeSample& sample, const TimerWatch& timer) {
    return static_cast<double>(timer.host() ? sample.host_ns : sample.kernel_ns);
}

/// Untimed samples until the device is steady; long ones were warmed up by the validation.
std::vector<double> warm_up(const Method& method, TimerWatch& timer, const TakeSample& take,
                            const Seconds& now_s) {
    std::vector<double> times_ns;
    if (method.predicted_s > long_sample_s) return times_ns;
    const double begin_s = now_s();
    const auto enough = [&] {
        const double elapsed_s = now_s() - begin_s;
        if (elapsed_s + method.predicted_s > method.stop.time_left_s / 2) return true;
        if (method.warmup) return static_cast<int>(times_ns.size()) >= *method.warmup;
        return warm(times_ns, elapsed_s, method.stop.max_time_s);
    };
    while (!enough()) {
        const TimedRender timed = take("warmup", 1);
        timer.observe(timed.timer);
        times_ns.push_back(headline_ns(timed.time, timer));
    }
    return times_ns;
}

/// Shortest render seen, or predicted.
double render_ns(const Method& method, const std::vector<double>& warm_ups_ns) {
    if (warm_ups_ns.empty()) return method.predicted_s * 1e9;
    return *std::min_element(warm_ups_ns.begin(), warm_ups_ns.end());
}

/// Cold, the first of three or more samples does not count.
void flag_first(std::vector<TimeSample>& samples) {
    if (samples.size() == 3 && samples.front().cause.empty()) samples.front().cause = cause::first;
}

}  // namespace

Measurement measure(const Method& method, TimerWatch& timer, const TakeSample& take, const Seconds& now_s) {
    Measurement result;
    const double start_s = now_s();
    const std::vector<double> warm_ups_ns = warm_up(method, timer, take, now_s);
    const bool cold = warm_ups_ns.empty() && method.predicted_s <= long_sample_s;
    result.renders =
        renders_per_sample(render_ns(method, warm_ups_ns), timer.resolution_ns(method.resolution_ns));

    StopRule rule = method.stop;
    rule.time_left_s -= now_s() - start_s;
    const double begin_s = now_s();
    while (result.stop_reason.empty()) {
        const TimedRender timed = take("sample", result.renders);
        timer.observe(timed.timer);
        result.samples.push_back(timed.time);
        if (cold) flag_first(result.samples);
        flag_low_clock(result.samples);
        const Kept kept = keep(result.samples, timer.host(), result.renders);
        result.stop_reason = rule.stop({kept.times_ns, static_cast<int>(result.samples.size()),
                                        static_cast<double>(timed.time.host_ns) * 1e-9, now_s() - begin_s});
    }
    return result;
}

Statistics describe(const Measurement& measurement, const TimerWatch& timer) {
    const Kept kept = keep(measurement.samples, timer.host(), measurement.renders);
    Statistics statistics = describe_times(kept.times_ns);
    statistics.timer = timer.host() ? "host" : "event";
    statistics.timer_reason = timer.reason();
    statistics.stop_reason = measurement.stop_reason;
    statistics.flagged = kept.flagged;
    return statistics;
}

std::string wrong_times(const Measurement& measurement, const TimerWatch& timer, const Place& place) {
    if (describe(measurement, timer).median_ns <= 0)
        return "the device's event times do not advance during a sample: use --timer host";
    return lost_time(measurement.samples, timer.host(), place);
}

std::string unstable_reason(const Measurement& measurement, const TimerWatch& timer, const Place& place) {
    const std::string wrong = wrong_times(measurement, timer, place);
    if (!wrong.empty()) return wrong;
    return vague_median(measurement.samples, timer.host(), measurement.renders, place);
}

}  // namespace ptb
