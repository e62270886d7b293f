#include "bench/measure/timer.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace ptb {

namespace {

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

}  // namespace ptb
