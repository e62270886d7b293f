#include "bench/validate/passes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace ptb {

namespace {

/// Unbiased variance of the values that `of_pass` has of each pass.
std::vector<double> variance_over_passes(const std::vector<std::vector<double>>& of_pass) {
    const auto count = static_cast<double>(of_pass.size());
    std::vector<double> variance(of_pass.front().size());
    for (std::size_t i = 0; i < variance.size(); ++i) {
        double mean = 0;
        for (const auto& values : of_pass) mean += values[i] / count;
        for (const auto& values : of_pass) variance[i] += std::pow(values[i] - mean, 2) / (count - 1);
    }
    return variance;
}

void add_counts(Film& sum, const Film& film) {
    sum.segments += film.segments;
    sum.shadow_rays += film.shadow_rays;
    sum.light_segments += film.light_segments;
    if (film.samples) *sum.samples += *film.samples;
    if (film.full_length_paths) *sum.full_length_paths += *film.full_length_paths;
}

}  // namespace

Film together(const Passes& passes) {
    Film sum = passes.films.front();
    sum.variance.reset();
    std::vector<double> rgb(sum.mean.rgb.size());
    for (const Film& film : passes.films) {
        if (&film != &passes.films.front()) add_counts(sum, film);
        for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] += film.mean.rgb[i];
    }
    for (std::size_t i = 0; i < rgb.size(); ++i)
        sum.mean.rgb[i] = static_cast<float>(rgb[i] / static_cast<double>(passes.films.size()));
    return sum;
}

Blocks block_variance_of_sample(const Passes& passes, int edge) {
    std::vector<std::vector<double>> means;
    for (const Film& film : passes.films) means.push_back(block_means(film.mean, edge).rgb);
    Blocks variance = block_means(passes.films.front().mean, edge);
    variance.rgb = variance_over_passes(means);
    for (std::size_t i = 0; i < variance.rgb.size(); ++i)
        variance.rgb[i] *= static_cast<double>(variance.pixels[i / 3]) * passes.spp;
    return variance;
}

std::array<double, 3> image_variance_of_sample(const Passes& passes) {
    const Size size = passes.films.front().mean.size;
    const Blocks all = block_variance_of_sample(passes, std::max(size.width, size.height));
    return {all.rgb[0], all.rgb[1], all.rgb[2]};
}

double student_z(double difference, double known_variance, double estimated_variance, double degrees) {
    const double variance = known_variance + estimated_variance;
    const double t = difference / std::sqrt(variance);
    if (!(estimated_variance > 0) || std::isinf(degrees)) return t;
    const double of_sum = degrees * std::pow(variance / estimated_variance, 2);
    const boost::math::students_t student(of_sum);
    const double tail = boost::math::cdf(boost::math::complement(student, std::abs(t)));
    const double least = std::numeric_limits<double>::min();
    const double z =
        boost::math::quantile(boost::math::complement(boost::math::normal(), std::max(tail, least)));
    return std::copysign(z, t);
}

}  // namespace ptb
