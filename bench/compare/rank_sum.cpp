#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <boost/math/distributions/normal.hpp>

#include "bench/compare/rank_tests.h"
#include "bench/compare/ranks.h"

namespace ptb {
namespace {

/// In how many of all choices of `chosen` ranks they add up to s, for each s.
std::vector<double> sum_counts(const std::vector<int>& ranks, std::size_t chosen) {
    const auto most = static_cast<std::size_t>(std::accumulate(ranks.begin(), ranks.end(), 0));
    std::vector<std::vector<double>> counts(chosen + 1, std::vector<double>(most + 1));
    counts[0][0] = 1;
    for (const int rank : ranks) {
        const auto r = static_cast<std::size_t>(rank);
        for (std::size_t k = chosen; k > 0; --k)
            for (std::size_t s = most; s >= r; --s) counts[k][s] += counts[k - 1][s - r];
    }
    return counts[chosen];
}

/// P(sum of the chosen ranks <= `sum`).
double share_up_to(const std::vector<double>& counts, int sum) {
    const auto end = counts.begin() + std::clamp(sum + 1, 0, static_cast<int>(counts.size()));
    return std::accumulate(counts.begin(), end, 0.0) / std::accumulate(counts.begin(), counts.end(), 0.0);
}

double normal_cdf(double z) { return boost::math::cdf(boost::math::normal(), z); }

/// The normal limit, for `ranks` of which the first n add up to `sum` (all doubled).
double normal_p(const std::vector<int>& ranks, std::size_t n, int sum) {
    const double total = static_cast<double>(ranks.size()), chosen = static_cast<double>(n);
    const double mean = total + 1;  // of a doubled rank
    double squares = 0;
    for (const int rank : ranks) squares += (rank - mean) * (rank - mean);
    const double sd = std::sqrt(chosen * (total - chosen) / (total * (total - 1)) * squares);
    if (sd == 0) return 1;
    const double continuity = 1;  // half a rank, doubled
    return std::min(1.0, 2 * normal_cdf(-(std::abs(sum - chosen * mean) - continuity) / sd));
}

}  // namespace

double rank_sum_p(std::span<const double> base, std::span<const double> now) {
    if (base.empty() || now.empty()) return 1;
    std::vector<double> all(base.begin(), base.end());
    all.insert(all.end(), now.begin(), now.end());
    const std::vector<int> ranks = doubled_ranks(all);
    const auto end = ranks.begin() + static_cast<std::ptrdiff_t>(base.size());
    const int sum = std::accumulate(ranks.begin(), end, 0);
    if (ranks.size() > most_exact) return normal_p(ranks, base.size(), sum);
    const auto counts = sum_counts(ranks, base.size());
    return std::min(1.0, 2 * std::min(share_up_to(counts, sum), 1 - share_up_to(counts, sum - 1)));
}

std::vector<double> rank_sum_cdf(int n, int m) {
    std::vector<double> cdf;
    const double sd = std::sqrt(n * m * (n + m + 1.0) / 12);
    if (n + m > static_cast<int>(most_exact)) {
        for (int u = 0; u <= n * m; ++u) cdf.push_back(normal_cdf((u + 0.5 - n * m / 2.0) / sd));
        return cdf;
    }
    std::vector<int> ranks(static_cast<std::size_t>(n + m));
    std::iota(ranks.begin(), ranks.end(), 1);
    const auto counts = sum_counts(ranks, static_cast<std::size_t>(n));
    const double all = std::accumulate(counts.begin(), counts.end(), 0.0);
    double so_far = 0;
    auto count = counts.begin() + n * (n + 1) / 2;  // of the least sum, U = 0
    for (int u = 0; u <= n * m; ++u) cdf.push_back((so_far += *count++) / all);
    return cdf;
}

}  // namespace ptb
