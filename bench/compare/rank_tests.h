#pragma once

#include <span>
#include <vector>

namespace ptb {

/// Exact two-sided p of Wilcoxon's signed-rank test that `differences` lie symmetrically about 0. Zeros are
/// left out, ties share the mean of their ranks, and the distribution is that of the ranks as they are; 1
/// when nothing is left. See "Individual Comparisons by Ranking Methods", by F. Wilcoxon.
double signed_rank_p(std::span<const double> differences);

/// Two-sided p of the Mann-Whitney test that `base` and `now` come from one distribution: exact, ties
/// included, up to `most_exact` values in all; beyond, the normal limit with correction for ties and
/// continuity. 1 when either is empty. See "On a Test of Whether one of Two Random Variables is
/// Stochastically Larger than the Other", by H. Mann and D. Whitney.
double rank_sum_p(std::span<const double> base, std::span<const double> now);
inline constexpr std::size_t most_exact = 60;

/// P(W <= w) and P(U <= u) of the two tests' statistics under the null, without ties, for every w and u: by
/// how many order statistics an interval may be narrowed.
std::vector<double> signed_rank_cdf(int n);
std::vector<double> rank_sum_cdf(int n, int m);

}  // namespace ptb
