#include "core/oracle/pixel_tally.h"

#include <algorithm>
#include <mutex>
#include <thread>
#include <vector>

namespace ptb {
namespace {

void store(Image& image, std::size_t pixel, const Vec3& value) {
    image.rgb[3 * pixel] = static_cast<float>(value.x);
    image.rgb[3 * pixel + 1] = static_cast<float>(value.y);
    image.rgb[3 * pixel + 2] = static_cast<float>(value.z);
}

double unbiased_variance(double count, double sum, double sum_of_squares) {
    return count < 2 ? 0 : std::max(0.0, (sum_of_squares - sum * sum / count) / (count - 1));
}

/// Hands out rows and gathers what their pixels left.
class RowQueue {
  public:
    RowQueue(const OracleJob& job, const PixelSampler& sample_pixel)
        : job_(job), sample_pixel_(sample_pixel) {
        result_.mean = result_.variance = {job.size, std::vector<float>(3 * job.size.pixels())};
    }

    void work() {
        for (int y = take(); y < job_.size.height; y = take()) {
            std::vector<PixelTally> row;
            for (int x = 0; x < job_.size.width; ++x) row.push_back(sample_pixel_(x, y));
            finish(y, row);
        }
    }

    OracleResult result() {
        result_.segments_variance =
            unbiased_variance(static_cast<double>(result_.samples), static_cast<double>(result_.segments),
                              static_cast<double>(segments_squared_));
        return result_;
    }

  private:
    int take() {
        const std::lock_guard lock(mutex_);
        return next_row_++;
    }

    void finish(int y, const std::vector<PixelTally>& row) {
        const std::lock_guard lock(mutex_);
        std::size_t pixel = static_cast<std::size_t>(y) * row.size();
        for (const PixelTally& tally : row) {
            store(result_.mean, pixel, tally.mean);
            store(result_.variance, pixel++, tally.variance());
            result_.samples += tally.samples;
            result_.segments += tally.segments;
            result_.full_length_paths += tally.full_length_paths;
            segments_squared_ += tally.segments_squared;
        }
        if (job_.on_row) job_.on_row(++rows_done_);
    }

    const OracleJob& job_;
    const PixelSampler& sample_pixel_;
    std::mutex mutex_;
    int next_row_ = 0, rows_done_ = 0;
    std::uint64_t segments_squared_ = 0;
    OracleResult result_;
};

}  // namespace

OracleResult sample_pixels(const OracleJob& job, const PixelSampler& sample_pixel) {
    RowQueue rows(job, sample_pixel);
    std::vector<std::jthread> helpers;
    for (int i = 1; i < job.threads; ++i) helpers.emplace_back([&rows] { rows.work(); });
    rows.work();
    helpers.clear();
    return rows.result();
}

}  // namespace ptb
