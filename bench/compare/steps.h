#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/compare/shift.h"

namespace ptb {

/// A run with which another level begins.
struct Step {
    std::size_t at = 0;      ///< the first value of the new level
    Shift shift;             ///< of log time, against the level before
    double p = 1;            ///< of such a change in values whose order means nothing, corrected
    bool suspected = false;  ///< of the newest values alone, too few for ranks
    bool operator==(const Step&) const = default;
};

/// Fewer values are no level, but for the newest, which may be the beginning of one.
inline constexpr std::size_t fewest_of_level = 5;

/// A step is told under this p: less than of a comparison, since a history is looked at again and again.
inline constexpr double step_p = 0.005;

struct StepRules {
    double least_shift = 0;  ///< of log time; smaller changes are not told
    double correction = 1;   ///< each p is multiplied by it, for the series that are searched together
};

/// Where the level of `logs` changes, in order. The mean of a stretch of values against that of the others,
/// farthest off over all stretches that begin or end the series (a step) and over all within it (an
/// excursion), is held against the same of the values in random order, and against the Mann-Whitney test;
/// each piece is searched again. Of the newest values, too few for that, Student's interval of their mean.
/// See "Circular Binary Segmentation for the Analysis of Array-Based DNA Copy Number Data", by A. Olshen, E.
/// Venkatraman, R. Lucito and M. Wigler.
std::vector<Step> steps(std::span<const double> logs, const StepRules& rules);

/// How likely the surest change of such a search is in values whose order means nothing.
double surest_p(std::span<const double> logs, double least_shift);

}  // namespace ptb
