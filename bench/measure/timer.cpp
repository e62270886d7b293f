#include "bench/measure/timer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace ptb {

namespace {

constexpr int fewest_to_convict = 3;  ///< samples; one that disagrees may be a busy machine
constexpr double ticks_per_sample = 100, most_renders = 10'000;
constexpr std::uint64_t host_resolution_ns = 1000;  ///< of waking up, more than of the clock itself

std::int64_t span_ns(std::uint64_t from, std::uint64_t to) { return static_cast<std::int64_t>(to - from); }

/// The order of one launch's timestamps, or what is wrong with it.
std::string order_fault(const LaunchTimes& t) {
    if (t.start == 0 || t.end == 0) return "the device's event times are zero";
    if (t.end < t.start) return fmt::format("an event ends {} ns before it starts", t.start - t.end);
    if (t.submit < t.queued || t.start < t.submit) return "an event starts before it was submitted";
    return "";
}

}  // namespace

std::int64_t union_ns(std::span<const LaunchTimes> launches) {
    std::vector<LaunchTimes> sorted(launches.begin(), launches.end());
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.start < b.start; });
    std::int64_t total = 0;
    std::uint64_t covered = 0;
    for (const LaunchTimes& t : sorted) {
        const std::uint64_t from = std::max(t.start, covered);
        if (t.end <= from) continue;
        total += span_ns(from, t.end);
        covered = t.end;
    }
    return total;
}

std::string timer_fault(std::span<const LaunchTimes> launches, std::int64_t host_ns,
                        std::uint64_t resolution_ns) {
    const double allowed = static_cast<double>(host_ns) * 1.02 + static_cast<double>(resolution_ns);
    for (const LaunchTimes& t : launches) {
        const std::string fault = order_fault(t);
        if (!fault.empty()) return fault;
        if (static_cast<double>(t.end - t.start) > allowed)
            return fmt::format("an event lasts {} ns where the host waited {} ns", t.end - t.start, host_ns);
    }
    return "";
}

std::int64_t covered_ns(std::span<const LaunchTimes> launches) {
    if (launches.empty()) return 0;
    std::uint64_t first = launches.front().queued, last = 0;
    for (const LaunchTimes& t : launches) {
        first = std::min(first, t.queued);
        last = std::max(last, t.end);
    }
    return span_ns(first, last);
}

bool clocks_disagree(std::int64_t covered_ns, std::int64_t host_ns) {
    return host_ns > 10'000'000 && static_cast<double>(host_ns) > 1.2 * static_cast<double>(covered_ns);
}

int renders_per_sample(double render_ns, std::uint64_t resolution_ns) {
    const double wanted_ns = ticks_per_sample * static_cast<double>(resolution_ns);
    return static_cast<int>(std::clamp(std::ceil(wanted_ns / std::max(render_ns, 1.0)), 1.0, most_renders));
}

std::uint64_t tick_ns(std::span<const LaunchTimes> launches, std::uint64_t so_far) {
    if (launches.empty()) return so_far;
    const std::uint64_t origin = launches.front().start;
    for (const LaunchTimes& t : launches)
        for (const std::uint64_t at : {t.queued, t.submit, t.start, t.end})
            so_far = std::gcd(so_far, std::max(at, origin) - std::min(at, origin));
    return so_far;
}

void add_pass(TimeSample& sample, std::span<const LaunchTimes> launches, std::int64_t host_ns) {
    sample.host_ns += host_ns;
    sample.kernel_ns += union_ns(launches);
    for (const LaunchTimes& t : launches) {
        if (!order_fault(t).empty()) continue;
        sample.sum_ns += span_ns(t.start, t.end);
        sample.queued_ns += span_ns(t.queued, t.submit);
        sample.submit_ns += span_ns(t.submit, t.start);
    }
}

std::optional<double> overlap_of(std::span<const TimeSample> samples) {
    double sum_ns = 0, covered_ns = 0;
    for (const TimeSample& sample : samples) {
        sum_ns += static_cast<double>(sample.sum_ns);
        covered_ns += static_cast<double>(sample.kernel_ns);
    }
    return sum_ns > 0 ? std::optional(std::max(0.0, 1 - covered_ns / sum_ns)) : std::nullopt;
}

TimerWatch::TimerWatch(std::string asked) : asked_(std::move(asked)) {}

void TimerWatch::restart() {
    if (asked_ == "auto" && samples_ >= fewest_to_convict) fault_ = reason();
    samples_ = disagreeing_ = 0;
}

void TimerWatch::observe(const TimerEvidence& evidence) {
    ++samples_;
    disagreeing_ += evidence.disagrees ? 1 : 0;
    if (evidence.fault.empty()) tick_ns_ = std::gcd(tick_ns_, evidence.tick_ns);
    if (fault_.empty()) fault_ = evidence.fault;
}

bool TimerWatch::host() const { return asked_ == "host" || (asked_ == "auto" && !reason().empty()); }

std::string TimerWatch::reason() const {
    if (asked_ == "event") return "";
    if (asked_ == "host") return "asked for";
    if (!fault_.empty()) return fault_;
    if (2 * disagreeing_ <= samples_) return "";
    return fmt::format("the events miss over a sixth of the host's time in {} of {} samples", disagreeing_,
                       samples_);
}

std::uint64_t TimerWatch::resolution_ns(std::uint64_t claimed_ns) const {
    return host() ? host_resolution_ns : std::max(claimed_ns, tick_ns_);
}

}  // namespace ptb
