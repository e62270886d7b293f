#include "bench/measure/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <boost/math/distributions/binomial.hpp>

namespace ptb {

std::optional<std::pair<double, double>> median_interval(std::span<const double> sorted, double confidence) {
    const int n = static_cast<int>(sorted.size());
    if (n == 0) return std::nullopt;
    const boost::math::binomial_distribution<> below_median(n, 0.5);
    // [x_(k), x_(n+1-k)] misses the median with probability 2 P(B < k); take the largest k that covers
    // enough.
    int k = 0;
    while (k + 1 <= n / 2 && 2 * boost::math::cdf(below_median, k) <= 1 - confidence) ++k;
    if (k == 0) return std::nullopt;
    return std::pair{sorted[static_cast<std::size_t>(k - 1)], sorted[static_cast<std::size_t>(n - k)]};
}

double quantile(std::span<const double> sorted, double p) {
    if (sorted.empty()) return 0;
    const double at = p * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - std::floor(at)) * (sorted[above] - sorted[below]);
}

Statistics describe_times(std::span<const double> times_ns) {
    Statistics s;
    s.n = static_cast<int>(times_ns.size());
    if (times_ns.empty()) return s;
    std::vector<double> sorted(times_ns.begin(), times_ns.end());
    std::sort(sorted.begin(), sorted.end());
    s.median_ns = quantile(sorted, 0.5);
    s.q1_ns = quantile(sorted, 0.25);
    s.q3_ns = quantile(sorted, 0.75);
    s.min_ns = sorted.front();
    s.max_ns = sorted.back();
    s.mean_ns = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size());
    std::vector<double> deviations;
    for (const double t : sorted) deviations.push_back(std::abs(t - s.median_ns));
    std::sort(deviations.begin(), deviations.end());
    s.mad_ns = quantile(deviations, 0.5);
    if (const auto interval = median_interval(sorted, 0.95)) {
        s.ci_low_ns = interval->first;
        s.ci_high_ns = interval->second;
    }
    return s;
}

void add_rates(Statistics& statistics, const Work& work) {
    const auto millions_per_s = [&](std::uint64_t count) {
        return static_cast<double>(count) / statistics.median_ns * 1e3;
    };
    statistics.msamples_per_s = millions_per_s(work.samples);
    statistics.msegments_per_s = millions_per_s(work.segments);
    const std::uint64_t more = work.shadow_rays + work.light_segments;
    if (more > 0 || work.listed_rays > 0) statistics.mrays_per_s = millions_per_s(work.segments + more);
}

}  // namespace ptb
