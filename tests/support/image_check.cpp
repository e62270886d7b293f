#include "tests/support/image_check.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/image/image_io.h"

namespace ptb {

namespace {

/// Mean over the channels of (film - reference) in standard errors of one pixel.
double pixel_z(const Film& film, int spp, const Reference& reference, std::size_t pixel) {
    double sum = 0;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
        const double variance = reference.variance.rgb[i] * (1.0 / spp + 1.0 / reference.spp);
        const double difference = static_cast<double>(film.mean.rgb[i]) - reference.mean.rgb[i];
        sum += difference / std::sqrt(std::max(variance, 1e-12));
    }
    return sum / 3;
}

Image z_map(const Film& film, int spp, const Reference& reference) {
    Image map{reference.size, {}};
    for (std::size_t pixel = 0; pixel < reference.size.pixels(); ++pixel) {
        const auto z = static_cast<float>(std::clamp(pixel_z(film, spp, reference, pixel) / 5, -1.0, 1.0));
        map.rgb.insert(map.rgb.end(), {std::max(z, 0.0f), 0.0f, std::max(-z, 0.0f)});
    }
    return map;
}

std::filesystem::path leave_images(const std::string& name, const Film& film, int spp,
                                   const Reference& reference) {
    const auto folder = std::filesystem::path(PTB_BINARY_DIR) / "failed_images";
    std::filesystem::create_directories(folder);
    write_image(folder / (name + "_image.png"), film.mean);
    write_image(folder / (name + "_reference.png"), reference.mean);
    if (film.mean.size == reference.size)
        write_image(folder / (name + "_z.png"), z_map(film, spp, reference));
    return folder;
}

}  // namespace

Reference reference_of(const OracleResult& truth, const Scene& scene, const std::string& kernel,
                       const OracleJob& job) {
    const auto samples = static_cast<double>(truth.samples);
    Reference reference;
    reference.scene = scene.name;
    reference.kernel = kernel;
    reference.size = job.size;
    reference.path_length = job.path_length;
    reference.spp = job.spp;
    reference.segments_per_sample = static_cast<double>(truth.segments) / samples;
    reference.segments_variance = truth.segments_variance;
    reference.full_length_share = static_cast<double>(truth.full_length_paths) / samples;
    reference.mean = truth.mean;
    reference.variance = truth.variance;
    return reference;
}

testing::AssertionResult agrees(const std::string& name, const Film& film, const RenderJob& job,
                                const Reference& reference) {
    const FilmEvidence evidence{film, job.size, job.spp, job.path_length,
                                job.variant.roulette != Roulette::off};
    Validation validation = check_film(evidence);
    check_against(validation, evidence, reference);
    if (validation.valid) return testing::AssertionSuccess();
    return testing::AssertionFailure() << name << ": " << validation.reason << "; images in "
                                       << leave_images(name, film, job.spp, reference).string();
}

}  // namespace ptb
