#include "bench/workbench/validator.h"

#include <algorithm>
#include <utility>

#include "bench/validate/rays.h"
#include "bench/validate/validate.h"
#include "bench/workbench/host_reference.h"
#include "bench/workbench/seeded.h"

namespace ptb {
namespace {

constexpr double validation_s = 15;  ///< a slow device validates on the samples that this time gives
constexpr int fewest_spp = 4;
constexpr int unstored_spp = 64;  ///< at most, where the host's few samples are the truth
constexpr int listed_spp = 2;     ///< of rays that are judged one by one

/// Samples a pixel of the validation, by the kernel's speed.
int validation_spp(double ns_per_sample) {
    const double pixels = static_cast<double>(validation_size.pixels());
    const double by_time = validation_s * 1e9 / std::max(ns_per_sample, 1e-3);
    return static_cast<int>(
        std::clamp(by_time, fewest_spp * pixels, static_cast<double>(validation_samples)) / pixels);
}

}  // namespace

Validator::Validator(Builds& builds, Pace& pace, std::filesystem::path references, std::uint64_t seed)
    : builds_(builds), pace_(pace), references_(std::move(references)), seed_(seed) {}

const Validation& Validator::verdict(const CaseJob& job, const Stage& stage) {
    const CaseJob plain = job.plain();
    const auto found = verdicts_.find(plain.key());
    if (found != verdicts_.end()) return found->second;
    return verdicts_[plain.key()] = judged(plain, stage);
}

Validation Validator::judged(const CaseJob& plain, const Stage& stage) {
    if (plain.kernel->lists_rays) return judged_by_rays(plain.sized(validation_size, listed_spp), stage);
    const auto stored = stored_reference(plain);
    const int spp = validation_spp(pace_.ns_per_sample(plain));
    CaseJob job = plain.sized(validation_size, stored ? spp : std::min(spp, unstored_spp));
    const Film film = rendered(plain, job, stage);
    return judged_by(stored, job, film);
}

Validation Validator::judged_by_rays(CaseJob job, const Stage& stage) {
    const Film film = rendered(job, job, stage);
    Validation validation = check_film(evidence_of(film, job.work));
    check_rays(validation, *film.rays);
    validation.against = "a search of all triangles, one by one";
    return validation;
}

/// Where pixels share paths, by passes, whose samples `job` is then told.
Film Validator::rendered(const CaseJob& plain, CaseJob& job, const Stage& stage) {
    if (plain.kernel->independent_pixels) {
        const auto render = builds_.make(job);
        timed_render(*render, pace_.timing(job, passes(stage, "validate")));
        return render->read_film();
    }
    Passes& all = passes_[plain.key()];
    all = Passes{std::max(job.work.spp / enough_passes, 1), {}};
    render_seeds(builds_, pace_, job.sized(validation_size, all.spp), enough_passes,
                 passes(stage, "validate"), [&](Film film) { all.films.push_back(std::move(film)); });
    job.work.spp = all.spp * enough_passes;
    return together(all);
}

const Passes* Validator::passes_of(const CaseJob& job) const {
    const auto found = passes_.find(job.plain().key());
    return found == passes_.end() ? nullptr : &found->second;
}

Validation Validator::judged_by(const std::optional<Reference>& stored, const CaseJob& job,
                                const Film& film) const {
    const FilmEvidence evidence = evidence_of(film, job.work, passes_of(job));
    Validation validation = check_film(evidence);
    if (stored) {
        check_against(validation, evidence, *stored);
        validation.against = reference_name(stored->scene, stored->kernel, stored->size, stored->path_length);
    } else {
        check_timed(validation, evidence, host_reference(job, seed_));
        validation.against = "the host's tracer, a few samples (there is no stored reference)";
    }
    if (film.biased) validation.against += ", by its counts alone: the picture is biased";
    return validation;
}

void Validator::check_timed_film(const CaseJob& job, const Film& film, Validation& validation) const {
    const FilmEvidence evidence = evidence_of(film, job.work, passes_of(job));
    Validation own = check_film(evidence);
    if (const auto stored = stored_reference(job)) check_timed(own, evidence, *stored);
    if (film.rays) check_rays(own, *film.rays);
    validation.checks.emplace_back("timed image");
    if (!own.valid) fail(validation, "the timed image: " + own.reason);
}

std::optional<Reference> Validator::stored_reference(const CaseJob& job) const {
    if (job.work.variant.pixel_filter == PixelFilter::centre) return std::nullopt;  // theirs is another image
    const std::string name =
        reference_name(job.scene->name, truth_of(job.params.kernel), validation_size, job.work.path_length);
    return load_reference(references_, name, job.scene->content);
}

}  // namespace ptb
