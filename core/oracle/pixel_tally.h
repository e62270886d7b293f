#pragma once

#include <cstdint>
#include <functional>

#include "core/oracle/oracle.h"

namespace ptb {

/// What one path leaves.
struct PathSample {
    Vec3 radiance;
    int segments = 0;
};

/// Running mean and squared deviations of one pixel's radiance, and its counts. Equal samples leave a
/// deviation of exactly zero; see "Note on a Method for Calculating Corrected Sums of Squares and Products",
/// by Welford.
struct PixelTally {
    Vec3 mean, squared_deviations;
    std::uint64_t samples = 0, segments = 0, segments_squared = 0, full_length_paths = 0;

    void add(const PathSample& sample, int path_length) {
        ++samples;
        const Vec3 before = sample.radiance - mean;
        mean = mean + before * (1 / static_cast<double>(samples));
        squared_deviations = squared_deviations + before * (sample.radiance - mean);
        const auto count = static_cast<std::uint64_t>(sample.segments);
        segments += count;
        segments_squared += count * count;
        full_length_paths += sample.segments == path_length ? 1 : 0;
    }
    /// Unbiased variance of one sample; zero for a single one.
    Vec3 variance() const {
        return samples < 2 ? Vec3{} : squared_deviations * (1 / static_cast<double>(samples - 1));
    }
};

/// Takes all samples of the pixel in column `x` and row `y`; called from several threads.
using PixelSampler = std::function<PixelTally(int x, int y)>;

/// Samples every pixel of the job, rows shared out among its threads. Sums are kept by pixel or are integers,
/// so the result does not depend on the number of threads.
OracleResult sample_pixels(const OracleJob& job, const PixelSampler& sample_pixel);

}  // namespace ptb
