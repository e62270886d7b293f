#pragma once

#include <optional>
#include <span>
#include <utility>

#include "bench/record/record.h"

namespace ptb {

/// Distribution-free interval of the median: order statistics of `sorted` whose coverage is at least
/// `confidence`, or nothing when `sorted` is too short for it (n < 6 at 95 %). See "Nonparametric Statistical
/// Inference", by Gibbons and Chakraborti, chapter 5.
std::optional<std::pair<double, double>> median_interval(std::span<const double> sorted, double confidence);

/// Quantile of sorted numbers, linear between order statistics; `p` in [0, 1].
double quantile(std::span<const double> sorted, double p);

/// Median, spread and range of times in ns; n == 0 gives zeros.
Statistics describe_times(std::span<const double> times_ns);

/// Adds how much of a render's work was done a second, by the median.
void add_rates(Statistics& statistics, const Work& work);

}  // namespace ptb
