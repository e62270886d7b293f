#include <cmath>
#include <numeric>
#include <vector>

#include "bench/compare/rank_tests.h"
#include "bench/compare/ranks.h"

namespace ptb {
namespace {

/// share[s]: probability that the (doubled) ranks whose sign is positive add up to s, all signs being equally
/// likely.
std::vector<double> sum_distribution(const std::vector<int>& ranks) {
    std::vector<double> share{1};
    for (const int rank : ranks) {
        std::vector<double> next(share.size() + static_cast<std::size_t>(rank));
        for (std::size_t s = 0; s < share.size(); ++s) {
            next[s] += share[s] / 2;
            next[s + static_cast<std::size_t>(rank)] += share[s] / 2;
        }
        share = std::move(next);
    }
    return share;
}

double sum_up_to(const std::vector<double>& share, int last) {
    double sum = 0;
    for (int s = 0; s <= last && s < static_cast<int>(share.size()); ++s)
        sum += share[static_cast<std::size_t>(s)];
    return sum;
}

}  // namespace

double signed_rank_p(std::span<const double> differences) {
    std::vector<double> sizes;
    std::vector<bool> positive;
    for (const double d : differences) {
        if (d == 0) continue;
        sizes.push_back(std::abs(d));
        positive.push_back(d > 0);
    }
    const std::vector<int> ranks = doubled_ranks(sizes);
    int above = 0, below = 0;
    for (std::size_t i = 0; i < ranks.size(); ++i) (positive[i] ? above : below) += ranks[i];
    return std::min(1.0, 2 * sum_up_to(sum_distribution(ranks), std::min(above, below)));
}

std::vector<double> signed_rank_cdf(int n) {
    std::vector<int> ranks(static_cast<std::size_t>(n));
    std::iota(ranks.begin(), ranks.end(), 1);
    auto cdf = sum_distribution(ranks);
    std::partial_sum(cdf.begin(), cdf.end(), cdf.begin());
    return cdf;
}

}  // namespace ptb
