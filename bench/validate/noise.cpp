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

/// The mean over these pixels of the mean over pairs, with its standard error by that of each pair.
Noise mean_over_pairs(const std::vector<std::vector<float>>& errors, std::span<const std::size_t> pixels) {
    const auto pairs = static_cast<double>(errors.size());
    std::vector<double> means;
    for (const auto& of_pair : errors) {
        double sum = 0;
        for (const std::size_t pixel : pixels) sum += of_pair[pixel];
        means.push_back(sum / static_cast<double>(pixels.size()));
    }
    Noise noise;
    noise.rel_mse = std::accumulate(means.begin(), means.end(), 0.0) / pairs;
    double squares = 0;
    for (const double mean : means) squares += std::pow(mean - noise.rel_mse, 2);
    noise.standard_error = std::sqrt(squares / (pairs - 1) / pairs);
    return noise;
}

constexpr const char* single_pixel = "size 1x1: a single pixel says nothing of its error";
constexpr const char* noise_in_black = "the image has noise where its reference is black";

std::string other_size(Size size, const Reference& reference) {
    return fmt::format("size {}: neither a multiple nor a part of the reference's {}", to_string(size),
                       to_string(reference.size));
}

std::size_t best(std::size_t pixels) { return pixels - pixels / 100; }

Efficiency without(const std::string& reason) {
    Efficiency none;
    none.reason = reason;
    return none;
}

}  // namespace

Efficiency noise_of(const FilmEvidence& evidence, const Reference& reference) {
    const auto truth = moments_at({reference.mean, reference.variance}, evidence.size);
    if (!truth) return without(other_size(evidence.size, reference));
    const auto& own = evidence.film.variance;
    if (own && evidence.spp < 2) return without("spp 1: a single sample per pixel has no variance");
    if (evidence.size.pixels() < 2) return without(single_pixel);
    const auto errors = sorted_errors(own ? *own : truth->variance, truth->mean, evidence.spp);
    if (!std::isfinite(errors.back())) return without(noise_in_black);
    Efficiency efficiency;
    efficiency.variance_from = own ? "film" : "reference";
    efficiency.all = mean_of(errors, errors.size());
    efficiency.best_99 = mean_of(errors, best(errors.size()));
    return efficiency;
}

PairedNoise::PairedNoise(const Reference& reference, Size size, int spp, int pass_spp) {
    const auto truth = image_at(reference.mean, size);
    if (!truth) refusal_ = other_size(size, reference);
    if (size.pixels() < 2) refusal_ = single_pixel;
    if (!refusal_.empty()) return;
    const auto medians = channel_medians(*truth);
    const double of_pair = 0.5 * pass_spp / spp / 3;
    for (std::size_t i = 0; i < truth->rgb.size(); ++i)
        weights_.push_back(of_pair * relative(1, truth->rgb[i], medians[i % 3]));
}

void PairedNoise::add(const Image& first, const Image& second) {
    std::vector<float> errors(weights_.size() / 3);
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        const double difference = static_cast<double>(first.rgb[i]) - static_cast<double>(second.rgb[i]);
        if (difference != 0) errors[i / 3] += static_cast<float>(weights_[i] * difference * difference);
    }
    errors_.push_back(std::move(errors));
}

Efficiency PairedNoise::noise() const {
    std::vector<double> errors(errors_.front().size());
    for (const auto& of_pair : errors_)
        for (std::size_t i = 0; i < errors.size(); ++i) errors[i] += of_pair[i];
    std::vector<std::size_t> order(errors.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return errors[a] < errors[b]; });
    if (!std::isfinite(errors[order.back()])) return without(noise_in_black);
    Efficiency efficiency;
    efficiency.variance_from = "passes";
    efficiency.all = mean_over_pairs(errors_, order);
    efficiency.best_99 = mean_over_pairs(errors_, std::span(order).first(best(order.size())));
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
