#pragma once

#include <limits>
#include <span>
#include <string>

namespace ptb {

inline constexpr double precision = 0.01;   ///< wanted of a median: half its 95 % interval, as a share of it
inline constexpr double long_sample_s = 3;  ///< a longer sample had its warm-up in the validation

/// True once the last two windows of three samples have medians within 1 %, or after 10 samples, 5 s or half
/// of the time for the timed samples.
bool warm(std::span<const double> times_ns, double elapsed_s, double max_time_s);

/// Samples that a steady device warms up with.
int usual_warmup(double sample_s, double max_time_s);

/// Samples that a case of such long samples needs: `min_samples`, over 3 s 6, over 30 s 3, over 5 min one.
int enough_samples(double sample_s, int min_samples);

/// How far the sampling of a case has come.
struct Sampled {
    std::span<const double> kept_ns;  ///< times that count
    int taken = 0;                    ///< samples, flagged ones included
    double sample_s = 0;              ///< what the next one will take, as far as anybody knows
    double elapsed_s = 0;             ///< since the first timed sample began
};

/// When to stop sampling. One sample is always taken, and `max_samples` wins over `min_samples`.
struct StopRule {
    int min_samples = 10, max_samples = 1000;
    double max_time_s = 30;
    double time_left_s = std::numeric_limits<double>::infinity();  ///< of the run's budget

    /// Empty: go on. Else why to stop: "low_n", "precision", "max_samples", "max_total_time", "max_time".
    std::string stop(const Sampled& sampled) const;
};

}  // namespace ptb
