#include "bench/validate/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "bench/measure/statistics.h"
#include "bench/plan/config.h"
#include "bench/validate/blocks.h"

namespace ptb {

namespace {

constexpr double median_weight = 0.01;
constexpr double normal_95 = 1.959964;  ///< two-sided quantile
/// Sums of single precision leave so much; an image with less has no noise that could be seen.
constexpr double rounding = 0x1p-23;

std::array<double, 3> channel_medians(const Image& image) {
    std::array<double, 3> medians{};
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double> values;
        for (std::size_t i = c; i < image.rgb.size(); i += 3) values.push_back(image.rgb[i]);
        std::sort(values.begin(), values.end());
        medians[c] = quantile(values, 0.5);
    }
    return medians;
}

/// Where nothing is random there is no error, however dark it is.
double relative(double variance, double mean, double median) {
    return variance > 0 ? variance / (mean * mean + median_weight * median * median) : 0;
}

/// Of each pixel, the mean over its channels; the smallest first.
std::vector<double> sorted_errors(const Image& variance, const Image& mean, int spp) {
    const auto medians = channel_medians(mean);
    std::vector<double> errors(mean.size.pixels());
    for (std::size_t i = 0; i < mean.rgb.size(); ++i)
        errors[i / 3] +=
            relative(variance.rgb[i] / static_cast<double>(spp), mean.rgb[i], medians[i % 3]) / 3;
    std::sort(errors.begin(), errors.end());
    return errors;
}

/// The mean of the `kept` smallest. Its standard error is that of a mean whose largest values are cut, by the
/// variance with these set to the last one kept: see "Less Vulnerable Confidence and Significance Procedures
/// for Location Based on a Single Sample", by J. W. Tukey and D. H. McLaughlin.
Noise mean_of(std::span<const double> sorted, std::size_t kept) {
    const auto n = static_cast<double>(sorted.size()), share = static_cast<double>(kept) / n;
    const double last = sorted[kept - 1];
    const auto smallest = sorted.first(kept);
    const double sum = std::accumulate(smallest.begin(), smallest.end(), 0.0);
    const double levelled = (sum + (n - static_cast<double>(kept)) * last) / n;
    double squares = 0;
    for (const double error : sorted) squares += std::pow(std::min(error, last) - levelled, 2);
    Noise noise;
    noise.rel_mse = sum / static_cast<double>(kept);
    noise.standard_error = std::sqrt(squares / (n - 1) / n) / share;
    return noise;
}

void rate(Noise& noise, const Statistics& s) {
    if (!(noise.rel_mse > rounding)) return;
    noise.efficiency = 1 / (noise.rel_mse * s.median_ns * 1e-9);
    if (!s.ci_low_ns || !s.ci_high_ns) return;
    const double error = normal_95 * noise.standard_error / noise.rel_mse;
    noise.low = *noise.efficiency * std::exp(-std::hypot(error, std::log(*s.ci_high_ns / s.median_ns)));
    noise.high = *noise.efficiency * std::exp(std::hypot(error, std::log(s.median_ns / *s.ci_low_ns)));
}

Efficiency without(const std::string& reason) {
    Efficiency none;
    none.reason = reason;
    return none;
}

}  // namespace

Efficiency noise_of(const FilmEvidence& evidence, const Reference& reference) {
    const auto truth = moments_at({reference.mean, reference.variance}, evidence.size);
    if (!truth)
        return without(fmt::format("size {}: neither a multiple nor a part of the reference's {}",
                                   to_string(evidence.size), to_string(reference.size)));
    const auto& own = evidence.film.variance;
    if (own && evidence.spp < 2) return without("spp 1: a single sample per pixel has no variance");
    if (evidence.size.pixels() < 2) return without("size 1x1: a single pixel says nothing of its error");
    const auto errors = sorted_errors(own ? *own : truth->variance, truth->mean, evidence.spp);
    if (!std::isfinite(errors.back())) return without("the image has noise where its reference is black");
    Efficiency efficiency;
    efficiency.variance_from = own ? "film" : "reference";
    efficiency.all = mean_of(errors, errors.size());
    efficiency.best_99 = mean_of(errors, errors.size() - errors.size() / 100);
    return efficiency;
}

void add_efficiency(Efficiency& efficiency, const Statistics& statistics) {
    if (!efficiency.all || !efficiency.best_99) return;
    rate(*efficiency.all, statistics);
    rate(*efficiency.best_99, statistics);
    if (!efficiency.all->efficiency)
        efficiency.reason = "the image has no noise beyond the rounding of single precision";
}

}  // namespace ptb
