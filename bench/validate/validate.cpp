#include "bench/validate/validate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>

#include <boost/math/distributions/normal.hpp>
#include <fmt/format.h>

#include "bench/validate/blocks.h"
#include "bench/validate/neighbours.h"

namespace ptb {

namespace {

constexpr std::array channel_names{"red", "green", "blue"};

/// A difference in units of its standard error, of whose variance `estimated` more has these degrees of
/// freedom. Without variance there is nothing random: the value must be the same up to rounding.
double z_score(double value, double expected, double variance, double estimated = 0, double degrees = 1) {
    if (variance + estimated > 0) return student_z(value - expected, variance, estimated, degrees);
    const bool same = std::abs(value - expected) <= 1e-4 * std::max(std::abs(expected), 1e-6);
    return same ? 0 : std::numeric_limits<double>::infinity();
}

/// Variance of the difference of two means of n and m samples.
double difference_variance(double variance, double n, double m) { return variance * (1 / n + 1 / m); }

/// Degrees of freedom that the film's own variance was estimated with: of single samples as good as no end.
double degrees_of(const FilmEvidence& evidence) {
    return evidence.passes ? evidence.passes->degrees() : std::numeric_limits<double>::infinity();
}

/// Variance of one sample of the film. Paths that roulette spares weigh more than the reference's: the film
/// knows how its own samples vary.
const Image& film_variance(const FilmEvidence& evidence, const Reference& reference) {
    const bool other = evidence.roulette != Roulette::off && evidence.film.variance;
    return other ? *evidence.film.variance : reference.variance;
}

double samples_of(Size size, int spp) { return static_cast<double>(size.pixels()) * spp; }

std::array<double, 3> channel_means(const Image& image) {
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < image.rgb.size(); ++i) sum[i % 3] += image.rgb[i];
    for (double& s : sum) s /= static_cast<double>(image.size.pixels());
    return sum;
}

bool same_shape(Size a, Size b) {
    return static_cast<std::int64_t>(a.width) * b.height == static_cast<std::int64_t>(b.width) * a.height;
}

bool same_lengths(const FilmEvidence& evidence, const Reference& reference) {
    return evidence.roulette == Roulette::off && same_shape(evidence.size, reference.size);
}

/// Variances of the image's mean and of its reference's, each times the samples of its own.
struct MeanVariance {
    std::array<double, 3> of_film, of_reference;
    double degrees;  ///< of the first

    MeanVariance(const FilmEvidence& evidence, const Reference& reference)
        : of_film(channel_means(film_variance(evidence, reference))),
          of_reference(channel_means(reference.variance)),
          degrees(degrees_of(evidence)) {
        for (std::size_t c = 0; c < 3; ++c) of_film[c] = std::max(of_film[c], of_reference[c]);
        if (evidence.passes) of_film = image_variance_of_sample(*evidence.passes);
        for (std::size_t c = 0; c < 3; ++c)
            if (of_reference[c] == 0 && !evidence.film.reconstructed) of_film[c] = 0;  // but for rounding
    }
};

/// Image mean, worst channel. Pixels of equal shape cover the same field of view whatever their number.
void check_mean(Validation& validation, const FilmEvidence& evidence, const Reference& reference,
                double limit) {
    if (!same_shape(evidence.size, reference.size)) return;
    const auto mean = channel_means(evidence.film.mean);
    const auto expected = channel_means(reference.mean);
    const MeanVariance variance(evidence, reference);
    const double n = samples_of(evidence.size, evidence.spp), m = samples_of(reference.size, reference.spp);
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double z = z_score(mean[c], expected[c], variance.of_reference[c] / m, variance.of_film[c] / n,
                                 variance.degrees);
        if (std::abs(z) > std::abs(worst)) worst = z;
        if (std::abs(z) > limit)
            fail(validation,
                 fmt::format("image mean: {} is {:.5f}, the reference's is {:.5f} ({:.1f} standard errors)",
                             channel_names[c], mean[c], expected[c], z));
    }
    validation.mean_z = worst;
    validation.checks.push_back("mean");
}

void check_segments(Validation& validation, const FilmEvidence& evidence, const Reference& reference,
                    double limit) {
    if (!same_lengths(evidence, reference)) return;
    const double n = samples_of(evidence.size, evidence.spp), m = samples_of(reference.size, reference.spp);
    const double z = z_score(validation.segments_per_sample, reference.segments_per_sample,
                             difference_variance(reference.segments_variance, n, m));
    validation.reference_segments_per_sample = reference.segments_per_sample;
    validation.checks.push_back("segments");
    if (std::abs(z) > limit)
        fail(validation,
             fmt::format("{:.3f} segments a sample, the reference has {:.3f} ({:.1f} standard errors)",
                         validation.segments_per_sample, reference.segments_per_sample, z));
}

/// In single precision so many paths, at most, stay in glass that they should leave: they came in along its
/// surface, and rounding makes every reflection total. 1 to 4 of 10 million on the shipped scenes with PoCL,
/// some 20 on an H200.
constexpr double kept_in_glass = 4e-6;

void check_full_length(Validation& validation, const FilmEvidence& evidence, const Reference& reference,
                       double limit) {
    if (!evidence.film.full_length_paths || !same_lengths(evidence, reference)) return;
    const double n = samples_of(evidence.size, evidence.spp), m = samples_of(reference.size, reference.spp);
    const double share = static_cast<double>(*evidence.film.full_length_paths) / n;
    const double expected = reference.full_length_share;
    const double bearable = std::max(expected, std::min(share, kept_in_glass));
    const double likely = std::max(expected, kept_in_glass);
    const double z = z_score(share, bearable, difference_variance(likely * (1 - likely), n, m));
    validation.checks.push_back("full_length");
    if (std::abs(z) > limit)
        fail(validation,
             fmt::format("{:.5f} % of the paths reach full length, the reference has {:.5f} % ({:.1f} "
                         "standard errors)",
                         100 * share, 100 * expected, z));
}

/// Pixel blocks of a film, of its reference, and of the variances of both.
struct BlockFamily {
    int edge = 1;
    Blocks found, expected, variance, of_film;
    bool reconstructed;

    BlockFamily(const FilmEvidence& evidence, const Reference& reference, int block)
        : edge(block),
          found(block_means(evidence.film.mean, block)),
          expected(block_means(reference.mean, block)),
          variance(block_means(reference.variance, block)),
          of_film(evidence.passes ? block_variance_of_sample(*evidence.passes, block)
                                  : block_means(film_variance(evidence, reference), block)),
          reconstructed(evidence.film.reconstructed) {}

    /// Where nothing is random but rounding, the film has no variance of its own, unless pixels beside it
    /// tell what it is.
    double excess(std::size_t i) const {
        return variance.rgb[i] > 0 || reconstructed ? std::max(of_film.rgb[i] - variance.rgb[i], 0.0) : 0;
    }

    /// Variance of the difference of both means, of n and m samples: what the reference tells of it, and what
    /// the film does where its own is larger. Paths so rare that no sample of the film saw them are in the
    /// reference's.
    double known(std::size_t i, double n, double m) const {
        return variance.rgb[i] / m + (excess(i) > 0 ? 0 : variance.rgb[i] / n);
    }
    double estimated(std::size_t i, double n) const { return excess(i) > 0 ? of_film.rgb[i] / n : 0; }

    /// How many hits of the light this block's mean is worth: light is hit rarely, and a sum of few hits is
    /// not Gaussian.
    double hits(std::size_t i, int spp) const {
        const double of_sample = variance.rgb[i] + excess(i);
        if (of_sample == 0) return std::numeric_limits<double>::infinity();
        return expected.rgb[i] * expected.rgb[i] / of_sample * found.pixels[i / 3] * spp;
    }
    bool gaussian(std::size_t i, int spp) const { return hits(i, spp) >= block_hits; }
    bool mostly_gaussian(int spp) const {
        std::size_t poor = 0;
        for (std::size_t i = 0; i < found.rgb.size(); ++i) poor += gaussian(i, spp) ? 0 : 1;
        return 10 * poor <= found.rgb.size();
    }
};

void check_blocks(Validation& validation, const FilmEvidence& evidence, const Reference& reference) {
    const int spp = std::min(evidence.spp, reference.spp);
    const int largest = std::min(evidence.size.width, evidence.size.height) / 2;
    int edge = block_edge(block_samples, spp);
    if (evidence.size != reference.size || edge > largest) return;
    while (2 * edge <= largest && !BlockFamily(evidence, reference, edge).mostly_gaussian(spp)) edge *= 2;
    const BlockFamily blocks(evidence, reference, edge);
    const double limit = sidak_limit(family_alpha, blocks.found.rgb.size()), degrees = degrees_of(evidence);
    double worst = 0;
    for (std::size_t i = 0; i < blocks.found.rgb.size(); ++i) {
        if (!blocks.gaussian(i, spp)) continue;
        const double pixels = blocks.found.pixels[i / 3];
        const double found = blocks.found.rgb[i], expected = blocks.expected.rgb[i];
        const double n = pixels * evidence.spp, m = pixels * reference.spp;
        const double z = z_score(found, expected, blocks.known(i, n, m), blocks.estimated(i, n), degrees);
        worst = std::max(worst, std::abs(z));
        const int block = static_cast<int>(i / 3);
        if (std::abs(z) > limit)
            fail(validation,
                 fmt::format(
                     "{}x{} block at column {}, row {}: {} is {:.5f}, the reference's is {:.5f} ({:.1f} "
                     "standard errors, limit {:.1f})",
                     edge, edge, block % blocks.found.across * edge, block / blocks.found.across * edge,
                     channel_names[i % 3], found, expected, z, limit));
    }
    validation.max_abs_z = std::isfinite(worst) ? worst : 1e9;
    validation.z_limit = limit;
    validation.checks.push_back("blocks");
}

/// Pixels that share random numbers: no mean shows it, but an image needs more samples than it says.
void check_neighbours(Validation& validation, const FilmEvidence& evidence, const Reference& reference,
                      double limit) {
    if (evidence.size != reference.size || evidence.passes) return;
    validation.checks.push_back("neighbours");
    for (const auto& [dx, dy, where] : {std::tuple(1, 0, "beside"), std::tuple(0, 1, "above")}) {
        const double z = neighbour_z(evidence.film.mean, reference, dx, dy);
        if (std::abs(z) > limit)
            fail(validation,
                 fmt::format("the errors of pixels {} each other go together ({:.1f} standard errors): "
                             "their random numbers are not independent",
                             where, z));
    }
}

}  // namespace

FilmEvidence evidence_of(const Film& film, const RenderJob& job, const Passes* passes) {
    return {film, job.size, job.spp, job.path_length, job.variant.roulette, passes};
}

void fail(Validation& validation, const std::string& reason) {
    if (validation.valid) validation.reason = reason;
    validation.valid = false;
}

double sidak_limit(double alpha, std::size_t tests) {
    const double each = -std::expm1(std::log1p(-alpha) / static_cast<double>(tests));
    return boost::math::quantile(boost::math::complement(boost::math::normal(), each / 2));
}

Validation check_film(const FilmEvidence& evidence) {
    Validation validation;
    validation.valid = true;
    validation.checks = {"finite", "counts"};
    const double samples = samples_of(evidence.size, evidence.spp);
    validation.samples = static_cast<std::uint64_t>(samples);
    validation.segments_per_sample = static_cast<double>(evidence.film.segments) / samples;
    const auto& rgb = evidence.film.mean.rgb;
    const bool signs = evidence.film.reconstructed;
    const auto bad = std::find_if(rgb.begin(), rgb.end(),
                                  [&](float v) { return !((signs || v >= 0) && std::isfinite(v)); });
    if (bad != rgb.end()) {
        const auto pixel = (bad - rgb.begin()) / 3;
        fail(validation, fmt::format("{} at column {}, row {}", *bad, pixel % evidence.size.width,
                                     pixel / evidence.size.width));
    }
    if (evidence.film.samples && *evidence.film.samples != validation.samples)
        fail(validation,
             fmt::format("{} samples counted, {} asked for", *evidence.film.samples, validation.samples));
    if (validation.segments_per_sample < 1 || validation.segments_per_sample > evidence.path_length)
        fail(validation, fmt::format("{:.3f} segments a sample, between 1 and {} are possible",
                                     validation.segments_per_sample, evidence.path_length));
    if (evidence.film.variance)
        for (const float value : evidence.film.variance->rgb)
            if (!std::isfinite(value)) {
                fail(validation, "the variance of a pixel is no number");
                break;
            }
    return validation;
}

void check_against(Validation& validation, const FilmEvidence& evidence, const Reference& reference) {
    check_segments(validation, evidence, reference, 4);
    check_full_length(validation, evidence, reference, 4);
    if (evidence.film.biased) return;
    check_blocks(validation, evidence, reference);
    check_mean(validation, evidence, reference, 4);
    check_neighbours(validation, evidence, reference, 4);
}

void check_timed(Validation& validation, const FilmEvidence& evidence, const Reference& reference) {
    check_segments(validation, evidence, reference, 5);
    if (evidence.film.biased) return;
    check_mean(validation, evidence, reference, 5);
}

void check_same_bits(Validation& validation, const Film& film, const Film& other, const std::string& what) {
    validation.checks.push_back(what);
    const auto& a = film.mean.rgb;
    const auto& b = other.mean.rgb;
    const bool same = a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
    const bool same_work = film.segments == other.segments && film.shadow_rays == other.shadow_rays &&
                           film.light_segments == other.light_segments;
    if (!same || !same_work) fail(validation, "the same work gave other bits: " + what);
}

}  // namespace ptb
