#include "bench/workbench/host_reference.h"

#include <algorithm>
#include <utility>

#include "bench/measure/clock.h"
#include "bench/validate/validate.h"
#include "core/oracle/oracle.h"

namespace ptb {
namespace {

constexpr double traced_s = 2;
constexpr Size traced_size{32, 32};
constexpr int tried_spp = 4, enough_spp = 4000;

OracleJob oracle_job(const CaseJob& job, std::uint64_t seed) {
    OracleJob work;
    work.pixel_centres = job.work.variant.pixel_filter == PixelFilter::centre;
    work.size = work.pixel_centres ? validation_size : traced_size;  // other pixels have other centres
    work.spp = tried_spp;
    work.path_length = job.work.path_length;
    work.seed = seed + 1;
    work.threads = 2;
    return work;
}

Reference as_reference(OracleResult result, const OracleJob& work) {
    const auto samples = static_cast<double>(result.samples);
    Reference reference;
    reference.size = work.size;
    reference.spp = work.spp;
    reference.segments_per_sample = static_cast<double>(result.segments) / samples;
    reference.segments_variance = result.segments_variance;
    reference.full_length_share = static_cast<double>(result.full_length_paths) / samples;
    reference.mean = std::move(result.mean);
    reference.variance = std::move(result.variance);
    return reference;
}

}  // namespace

Reference host_reference(const CaseJob& job, std::uint64_t seed) {
    const Tracer trace = tracers().at(truth_of(job.params.kernel));
    OracleJob work = oracle_job(job, seed);
    const std::int64_t begin = now_ns();
    trace(*job.scene, work);
    const double affordable = traced_s / std::max(seconds_since(begin), 1e-3) * work.spp;
    work.spp = static_cast<int>(std::clamp(affordable, 1.0 * tried_spp, 1.0 * enough_spp));
    return as_reference(trace(*job.scene, work), work);
}

}  // namespace ptb
