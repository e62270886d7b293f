#include <algorithm>
#include <cmath>

#include "bench/report/html/pictures.h"
#include "bench/validate/blocks.h"

namespace ptb {
namespace {

constexpr double full_colour = 5;

/// Values of the pixels that picture and reference have in common, RGB interleaved.
struct Common {
    Size size;
    std::vector<double> picture, mean, variance;  ///< variance of the difference
};

std::vector<double> numbers(const Image& image) { return {image.rgb.begin(), image.rgb.end()}; }

/// Variance of a picture's value that was rounded to 8 bits of its square root.
double rounding_variance(double value) {
    const double step = 2 * std::sqrt(std::max(value, 0.0)) / 255;
    return step * step / 12;
}

std::optional<Common> in_common(const Image& picture, const Reference& reference, int spp) {
    const Size size = std::min(picture.size, reference.size);
    const auto shown = image_at(picture, size);
    const auto truth = moments_at({reference.mean, reference.variance}, size);
    if (!shown || !truth) return std::nullopt;
    const int shrink = picture.size.width / size.width, edge = reference.size.width / size.width;
    const double samples = 1.0 * spp * shrink * shrink, reference_samples = 1.0 * reference.spp * edge * edge;
    Common common{size, numbers(*shown), numbers(truth->mean), numbers(truth->variance)};
    for (std::size_t i = 0; i < common.variance.size(); ++i)
        common.variance[i] = common.variance[i] * (1 / samples + 1 / reference_samples) +
                             rounding_variance(common.mean[i]) / (shrink * shrink);
    return common;
}

/// In standard errors; 0 where both are as bright as a picture can be.
double z_of(const Common& common, std::size_t i) {
    if (common.picture[i] > 0.99 && common.mean[i] > 0.99) return 0;
    const double difference = common.picture[i] - common.mean[i];
    if (common.variance[i] > 0) return difference / std::sqrt(common.variance[i]);
    return difference == 0 ? 0 : std::copysign(full_colour, difference);
}

void append_colour(std::vector<float>& rgb, double z) {
    const auto pale = static_cast<float>(1 - std::min(std::abs(z) / full_colour, 1.0));
    const float red = z > 0 ? 1 : pale, blue = z < 0 ? 1 : pale;
    rgb.insert(rgb.end(), {red, pale, blue});
}

}  // namespace

std::optional<ZMap> z_map(const Image& picture, const Reference& reference, int spp) {
    const auto common = in_common(picture, reference, spp);
    if (!common) return std::nullopt;
    ZMap map{{common->size, {}}, 0, 0};
    for (std::size_t pixel = 0; pixel < common->size.pixels(); ++pixel) {
        double farthest = 0;
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            const double z = z_of(*common, i);
            map.rms += z * z;
            map.beyond_4 += std::abs(z) > 4 ? 1 : 0;
            if (std::abs(z) > std::abs(farthest)) farthest = z;
        }
        append_colour(map.image.rgb, farthest);
    }
    const auto values = static_cast<double>(common->picture.size());
    map.rms = std::sqrt(map.rms / values);
    map.beyond_4 /= values;
    return map;
}

}  // namespace ptb
