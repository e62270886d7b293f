#include "bench/compare/shift.h"

#include <algorithm>
#include <vector>

#include "bench/compare/rank_tests.h"
#include "bench/measure/statistics.h"

namespace ptb {
namespace {

/// The median of `values` and the order statistics [c, count - 1 - c], c the most that the test's
/// distribution allows to be cut off at each end.
Shift narrowed(std::vector<double> values, double confidence, const std::vector<double>& cdf) {
    std::sort(values.begin(), values.end());
    Shift shift{quantile(values, 0.5), std::nullopt};
    const auto end = std::upper_bound(cdf.begin(), cdf.end(), (1 - confidence) / 2);
    const auto may_go = static_cast<std::size_t>(end - cdf.begin());
    if (may_go == 0 || 2 * may_go > values.size()) return shift;
    shift.interval = Interval{values[may_go - 1], values[values.size() - may_go]};
    return shift;
}

}  // namespace

Shift centre(std::span<const double> differences, double confidence) {
    std::vector<double> means;
    for (std::size_t i = 0; i < differences.size(); ++i)
        for (std::size_t j = i; j < differences.size(); ++j)
            means.push_back((differences[i] + differences[j]) / 2);
    const int n = static_cast<int>(differences.size());
    return narrowed(std::move(means), confidence, signed_rank_cdf(n));
}

Shift shift_between(std::span<const double> base, std::span<const double> now, double confidence) {
    std::vector<double> differences;
    for (const double b : base)
        for (const double n : now) differences.push_back(n - b);
    const int n = static_cast<int>(base.size()), m = static_cast<int>(now.size());
    return narrowed(std::move(differences), confidence, rank_sum_cdf(n, m));
}

}  // namespace ptb
