#include "bench/compare/shift.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "bench/compare/rank_tests.h"
#include "bench/measure/statistics.h"

namespace ptb {
namespace {

/// The median of `values` and the order statistics [c, count - 1 - c], c the most that the test's
/// distribution `cdf` allows to be cut off at each end.
Shift narrowed(std::vector<double> values, double confidence, const std::function<double(int)>& cdf) {
    std::sort(values.begin(), values.end());
    Shift shift{quantile(values, 0.5), std::nullopt};
    const int count = static_cast<int>(values.size());
    int low = -1, high = count;  // cdf(low) is small enough, cdf(high) is not
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        (2 * cdf(middle) <= 1 - confidence ? low : high) = middle;
    }
    if (low < 0 || 2 * low >= count) return shift;
    const auto cut = static_cast<std::size_t>(low);
    shift.interval = Interval{values[cut], values[values.size() - 1 - cut]};
    return shift;
}

}  // namespace

Shift centre(std::span<const double> differences, double confidence) {
    std::vector<double> means;
    for (std::size_t i = 0; i < differences.size(); ++i)
        for (std::size_t j = i; j < differences.size(); ++j)
            means.push_back((differences[i] + differences[j]) / 2);
    const int n = static_cast<int>(differences.size());
    return narrowed(std::move(means), confidence, [n](int w) { return signed_rank_cdf(n, w); });
}

Shift shift_between(std::span<const double> base, std::span<const double> now, double confidence) {
    std::vector<double> differences;
    for (const double b : base)
        for (const double n : now) differences.push_back(n - b);
    const int n = static_cast<int>(base.size()), m = static_cast<int>(now.size());
    return narrowed(std::move(differences), confidence, [=](int u) { return rank_sum_cdf(n, m, u); });
}

}  // namespace ptb
