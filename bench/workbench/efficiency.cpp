#include "bench/workbench/efficiency.h"

#include "bench/validate/noise.h"

namespace ptb {
namespace {

/// Why an image's noise does not follow from its film, or nothing.
std::string no_noise_reason(const CaseJob& job, bool has_reference) {
    if (!has_reference)
        return "there is no stored reference of this kernel, scene, path length and pixel filter";
    if (!job.kernel->independent_pixels)
        return "pixels share paths: their errors do not follow from the variance of samples";
    if (job.work.variant.pixel_filter == PixelFilter::stratified)
        return "pixel_filter stratified: the samples of a pixel are not independent";
    return "";
}

}  // namespace

Efficiency efficiency_of(const CaseJob& job, const Film& film, const Statistics& statistics,
                         const std::optional<Reference>& reference) {
    Efficiency efficiency;
    efficiency.reason = no_noise_reason(job, reference.has_value());
    if (!efficiency.reason.empty()) return efficiency;
    efficiency = noise_of({film, job.work.size, job.work.spp, job.work.path_length}, *reference);
    add_efficiency(efficiency, statistics);
    return efficiency;
}

}  // namespace ptb
