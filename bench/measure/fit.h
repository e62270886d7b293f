#pragma once

#include <span>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// A point of a line to fit: SPP and the median's time.
struct SppPoint {
    double spp = 0, ns = 0;
};

/// Least squares of relative errors (weights 1/t^2), so that a small SPP counts as much as a large one: the
/// overhead is what they show. Needs two different SPPs.
SppFit fit_line(std::span<const SppPoint> points);

/// A line for each set of three or more timed cases that differ in SPP alone.
std::vector<SppFit> fits_over_spp(const std::vector<Record>& records);

}  // namespace ptb
