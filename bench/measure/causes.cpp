#include "bench/measure/causes.h"

#include <algorithm>
#include <charconv>
#include <map>

#include <fmt/format.h>

namespace ptb {

namespace {

constexpr double steal_limit = 0.02, clock_limit = 1.05;
constexpr std::size_t counters = 8;  ///< user nice system idle iowait irq softirq steal; guests are in user

bool counts(const TimeSample& sample, bool host_clock) {
    return sample.cause.empty() || (host_clock && sample.cause == cause::timer_fault);
}

std::string advice(const std::string& why) {
    if (why == cause::clock_low)
        return "the device runs below its best clock: let it cool, or lock its clock";
    if (why == cause::steal) return "other virtual machines take this one's CPU time: use a quieter machine";
    if (why == cause::timer_fault) return "the device's event times are wrong: use --timer auto or host";
    return "take more samples (--min-samples)";
}

}  // namespace

CpuTicks parse_cpu_ticks(std::string_view line) {
    if (!line.starts_with("cpu ")) return {};
    CpuTicks ticks;
    const char* at = line.data();
    const char* const end = at + line.size();
    at += 4;
    for (std::size_t i = 0; i < counters; ++i) {
        while (at != end && *at == ' ') ++at;
        std::uint64_t value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc()) return {};
        at = next;
        ticks.all += value;
        if (i + 1 == counters) ticks.stolen = value;
    }
    return ticks;
}

bool stolen(const CpuTicks& before, const CpuTicks& after) {
    if (after.all <= before.all || after.stolen <= before.stolen + 1) return false;
    return static_cast<double>(after.stolen - before.stolen) >
           steal_limit * static_cast<double>(after.all - before.all);
}

bool ClockWatch::low(std::int64_t probe_ns) {
    if (probe_ns <= 0) return false;
    best_ns_ = best_ns_ == 0 ? probe_ns : std::min(best_ns_, probe_ns);
    return static_cast<double>(probe_ns) > clock_limit * static_cast<double>(best_ns_);
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
    kept.unstable = kept.flagged > 0 && 2 * kept.times_ns.size() <= all.size();
    if (kept.unstable) kept.times_ns = all;
    return kept;
}

std::string flags_text(std::span<const TimeSample> samples, bool host_clock) {
    std::map<std::string, int> causes;
    int flagged = 0;
    for (const TimeSample& sample : samples) {
        if (counts(sample, host_clock)) continue;
        ++causes[sample.cause];
        ++flagged;
    }
    std::vector<std::string> counted;
    for (const auto& [why, count] : causes) counted.push_back(fmt::format("{} {}", why, count));
    const auto most = std::max_element(causes.begin(), causes.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return fmt::format("{} of {} samples are flagged ({}): {}", flagged, samples.size(),
                       fmt::join(counted, ", "), most == causes.end() ? "" : advice(most->first));
}

}  // namespace ptb
