#include "tests/support/poisson.h"

#include <cmath>
#include <memory>
#include <numbers>

#include <fftw3.h>

namespace ptb {

namespace {

/// In both directions: FFTW_REDFT10, or FFTW_REDFT01, which is its inverse times 4 x pixels.
void transform(Size size, std::vector<double>& numbers, fftw_r2r_kind kind) {
    const std::unique_ptr<fftw_plan_s, void (*)(fftw_plan)> plan(
        fftw_plan_r2r_2d(size.height, size.width, numbers.data(), numbers.data(), kind, kind, FFTW_ESTIMATE),
        fftw_destroy_plan);
    fftw_execute(plan.get());
}

std::size_t pixel_at(Size size, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x);
}

/// What second differences make of a cosine that has so many half waves.
double stiffness(int half_waves, int length) {
    return 2 - 2 * std::cos(std::numbers::pi * half_waves / length);
}

/// Calls `visit(pixel, neighbour, more)` for every edge between pixels.
template <class Visit>
void each_edge(const Differences& d, Visit&& visit) {
    for (int y = 0; y < d.size.height; ++y)
        for (int x = 0; x < d.size.width; ++x) {
            const std::size_t here = pixel_at(d.size, x, y);
            if (x + 1 < d.size.width) visit(here, pixel_at(d.size, x + 1, y), d.across[here]);
            if (y + 1 < d.size.height) visit(here, pixel_at(d.size, x, y + 1), d.down[here]);
        }
}

}  // namespace

std::vector<double> least_squares(const Differences& differences, double alpha) {
    const Size size = differences.size;
    std::vector<double> numbers = differences.pixels;
    for (double& number : numbers) number *= alpha * alpha;
    each_edge(differences, [&](std::size_t pixel, std::size_t neighbour, double more) {
        numbers[pixel] -= more;
        numbers[neighbour] += more;
    });
    transform(size, numbers, FFTW_REDFT10);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            numbers[pixel_at(size, x, y)] /=
                (alpha * alpha + stiffness(x, size.width) + stiffness(y, size.height)) * 4 *
                static_cast<double>(size.pixels());
    transform(size, numbers, FFTW_REDFT01);
    return numbers;
}

double squared_errors(const Differences& differences, double alpha, const std::vector<double>& picture) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.size(); ++i)
        sum += std::pow(alpha * (picture[i] - differences.pixels[i]), 2);
    each_edge(differences, [&](std::size_t pixel, std::size_t neighbour, double more) {
        sum += std::pow(picture[neighbour] - picture[pixel] - more, 2);
    });
    return sum;
}

Differences differences_of(Size size, const std::vector<double>& picture) {
    Differences d{size, picture, std::vector<double>(picture.size()), std::vector<double>(picture.size())};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const std::size_t here = pixel_at(size, x, y);
            if (x + 1 < size.width) d.across[here] = picture[pixel_at(size, x + 1, y)] - picture[here];
            if (y + 1 < size.height) d.down[here] = picture[pixel_at(size, x, y + 1)] - picture[here];
        }
    return d;
}

}  // namespace ptb
