#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace ptb {

/// Mean and standard deviation of a sample (n - 1 in the denominator; 0 for fewer than two values).
struct Moments {
    double mean = 0, sd = 0;
};
Moments moments(std::span<const double> values);

/// p values that keep the chance of any false alarm among them: the k-th smallest times the number of those
/// not smaller. See "A Simple Sequentially Rejective Multiple Test Procedure", by S. Holm.
std::vector<double> holm(std::span<const double> p);

/// What `history` (of one normal quantity) says about the mean of the values that came next: p of lying so
/// far off, and the interval of their mean less its own by Student's t. Nothing for a history of fewer than
/// two.
struct Prediction {
    double difference = 0, p = 1, low = 0, high = 0;
    double standard_error = 0;  ///< of the difference
};
std::optional<Prediction> predict(std::span<const double> history, std::span<const double> next,
                                  double confidence);

/// The smallest change (a ratio less 1) that a decision with this tolerance is likely to see, from the
/// standard error of the log ratio, s/sqrt(blocks).
double smallest_effect(double tolerance, double standard_error);

}  // namespace ptb
