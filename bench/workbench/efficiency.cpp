#include "bench/workbench/efficiency.h"

#include <algorithm>
#include <utility>

#include "bench/validate/noise.h"
#include "bench/workbench/seeded.h"

namespace ptb {
namespace {

/// Why an image's noise does not follow from its film, or nothing.
std::string no_noise_reason(const CaseJob& job, bool has_reference) {
    if (!has_reference)
        return "there is no stored reference of this kernel, scene, path length and pixel filter";
    if (job.work.variant.reconstruction == Reconstruction::l1)
        return "reconstruction l1: its error is not noise alone, the picture is biased";
    if (job.work.variant.pixel_filter == PixelFilter::stratified)
        return "pixel_filter stratified: the samples of a pixel are not independent";
    return "";
}

Efficiency refused(const std::string& reason) {
    Efficiency none;
    none.reason = reason;
    return none;
}

constexpr double noise_s = 5;  ///< of renders for an image's noise, at most, where each has some samples

/// Samples a pixel of one of the renders, all of which together have as many as the image; where a picture is
/// made of gradients each has, since what that gains grows with them.
int pass_spp(Pace& pace, const CaseJob& job) {
    const double ns = pace.ns_per_sample(job) * static_cast<double>(job.work.size.pixels());
    const double affordable = noise_s * 1e9 / ns / enough_passes;
    const double wanted = job.kernel->gradients ? job.work.spp : 1.0 * job.work.spp / enough_passes;
    return static_cast<int>(std::max(1.0, std::min(wanted, affordable)));
}

/// By independent renders.
Efficiency noise_of_passes(Builds& builds, Pace& pace, const CaseJob& job, const Reference& reference,
                           const Stage& stage) {
    CaseJob pass = job.plain().sized(job.work.size, pass_spp(pace, job));
    PairedNoise paired(reference, job.work.size, job.work.spp, pass.work.spp);
    if (!paired.refusal().empty()) return refused(paired.refusal());
    std::optional<Film> first;
    render_seeds(builds, pace, pass, enough_passes, passes(stage, "noise"), [&](Film film) {
        if (!first) {
            first = std::move(film);
            return;
        }
        paired.add(first->mean, film.mean);
        first.reset();
    });
    return paired.noise();
}

}  // namespace

Efficiency efficiency_of(Builds& builds, Pace& pace, const CaseJob& job, const Film& film,
                         const Statistics& statistics, const std::optional<Reference>& reference,
                         const Stage& stage) {
    const std::string reason = no_noise_reason(job, reference.has_value());
    if (!reason.empty()) return refused(reason);
    Efficiency efficiency = job.kernel->independent_pixels
                                ? noise_of(evidence_of(film, job.work), *reference)
                                : noise_of_passes(builds, pace, job, *reference, stage);
    add_efficiency(efficiency, statistics);
    return efficiency;
}

}  // namespace ptb
