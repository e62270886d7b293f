#include "bench/measure/causes.h"

#include <algorithm>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "bench/measure/statistics.h"

namespace ptb {

namespace {

bool counts(const TimeSample& sample, bool host_clock) {
    const bool of_events = sample.cause == cause::timer_fault || sample.cause == cause::clocks_differ;
    return sample.cause.empty() || (host_clock && of_events);
}

/// Flagged samples by their cause.
using Causes = std::map<std::string, int>;

Causes causes_of(std::span<const TimeSample> samples, bool host_clock) {
    Causes causes;
    for (const TimeSample& sample : samples)
        if (!counts(sample, host_clock)) ++causes[sample.cause];
    return causes;
}

/// "busy 5, steal 1"
std::string text(const Causes& causes) {
    std::vector<std::string> counted;
    for (const auto& [why, count] : causes) counted.push_back(fmt::format("{} {}", why, count));
    return fmt::format("{}", fmt::join(counted, ", "));
}

int total(const Causes& causes) {
    return std::accumulate(causes.begin(), causes.end(), 0,
                           [](int sum, const auto& cause) { return sum + cause.second; });
}

std::string most_frequent(const Causes& causes) {
    const auto most = std::max_element(causes.begin(), causes.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == causes.end() ? "" : most->first;
}

/// Half the interval as a share of the median; 0 where there is none.
double spread(const Statistics& s) {
    return s.ci_low_ns && s.ci_high_ns && s.median_ns > 0 ? (*s.ci_high_ns - *s.ci_low_ns) / 2 / s.median_ns
                                                          : 0;
}

}  // namespace

void flag_low_clock(std::span<TimeSample> samples) {
    std::vector<double> probes_ns;
    for (const TimeSample& sample : samples)
        if (sample.probe_ns > 0) probes_ns.push_back(static_cast<double>(sample.probe_ns));
    const double usual_ns = describe_times(probes_ns).median_ns;
    for (TimeSample& sample : samples) {
        if (!sample.cause.empty() && sample.cause != cause::clock_low) continue;
        const bool low = static_cast<double>(sample.probe_ns) > clock_limit * usual_ns;
        sample.cause = low ? cause::clock_low : "";
    }
}

double time_ns(const TimeSample& sample, bool host_clock, int renders) {
    return static_cast<double>(host_clock ? sample.host_ns : sample.kernel_ns) / renders;
}

Kept keep(std::span<const TimeSample> samples, bool host_clock, int renders) {
    Kept kept;
    std::vector<double> all;
    for (const TimeSample& sample : samples) {
        all.push_back(time_ns(sample, host_clock, renders));
        if (counts(sample, host_clock)) kept.times_ns.push_back(all.back());
    }
    kept.flagged = static_cast<int>(all.size() - kept.times_ns.size());
    if (2 * kept.times_ns.size() <= all.size()) kept.times_ns = all;
    return kept;
}

std::string lost_time(std::span<const TimeSample> samples, bool host_clock, const Place& place) {
    const Causes causes = causes_of(samples, host_clock);
    Causes lost = causes;
    lost.erase(cause::clock_low);
    if (lost.empty() || 2 * total(lost) < static_cast<int>(samples.size())) return "";
    return fmt::format("{} of {} samples are flagged ({}): {}", total(causes), samples.size(), text(causes),
                       advice(most_frequent(lost), place));
}

std::string vague_median(std::span<const TimeSample> samples, bool host_clock, int renders,
                         const Place& place) {
    const double half_width = spread(describe_times(keep(samples, host_clock, renders).times_ns));
    if (half_width <= spread_limit) return "";
    const Causes causes = causes_of(samples, host_clock);
    const std::string flagged = causes.empty() ? "" : fmt::format(", flagged: {}", text(causes));
    return fmt::format("the median is known to {:.1f} % only ({} samples{}): {}", 100 * half_width,
                       samples.size(), flagged, advice(most_frequent(causes), place));
}

}  // namespace ptb
