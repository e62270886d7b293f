#pragma once

#include <optional>
#include <span>

namespace ptb {

struct Interval {
    double low = 0, high = 0;
    bool operator==(const Interval&) const = default;
};

/// How far values lie from 0, or from others, and between which bounds at the asked confidence; no bounds
/// where there are too few values for it.
struct Shift {
    double value = 0;
    std::optional<Interval> interval;
    bool operator==(const Shift&) const = default;
};

/// The Hodges-Lehmann estimate of the centre of `differences`: the median of the means of all pairs, each
/// with itself included; the interval is the one that inverts the exact signed-rank test. See "Estimates of
/// Location Based on Rank Tests", by J. Hodges and E. Lehmann. Expects at least one value.
Shift centre(std::span<const double> differences, double confidence);

/// The Hodges-Lehmann estimate of how much larger `now` is than `base`: the median of all differences; the
/// interval inverts the Mann-Whitney test. Expects at least one value each.
Shift shift_between(std::span<const double> base, std::span<const double> now, double confidence);

}  // namespace ptb
