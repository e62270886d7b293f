#include "bench/validate/neighbours.h"

#include <array>
#include <cmath>
#include <vector>

namespace ptb {

namespace {

/// Differences from the reference; each channel in its own unit, so that they add up.
std::vector<double> errors(const Image& film, const Reference& reference) {
    std::array<double, 3> variance{};
    for (std::size_t i = 0; i < film.rgb.size(); ++i) variance[i % 3] += reference.variance.rgb[i];
    std::vector<double> result(film.rgb.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double scale = variance[i % 3];
        const double difference = static_cast<double>(film.rgb[i]) - reference.mean.rgb[i];
        result[i] = scale > 0 ? difference / std::sqrt(scale) : 0;
    }
    return result;
}

}  // namespace

double neighbour_z(const Image& film, const Reference& reference, int dx, int dy) {
    const std::vector<double> error = errors(film, reference);
    const auto at = [&](int x, int y) { return 3 * static_cast<std::size_t>(y * film.size.width + x); };
    double sum = 0, squares = 0;
    for (int y = 0; y + dy < film.size.height; ++y) {
        for (int x = 0; x + dx < film.size.width; ++x) {
            double product = 0;
            for (std::size_t c = 0; c < 3; ++c)
                product += error[at(x, y) + c] * error[at(x + dx, y + dy) + c];
            sum += product;
            squares += product * product;
        }
    }
    return squares > 0 ? sum / std::sqrt(squares) : 0;
}

}  // namespace ptb
