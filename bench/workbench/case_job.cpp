#include "bench/workbench/case_job.h"

#include <fmt/format.h>

namespace ptb {

namespace {

int lanes_of(const Case& params, const Integrator& kernel, const DeviceInfo& device, const Scene& scene) {
    const bool asked = params.lanes != 0 && !params.lanes_tuned;
    if (!scene.meshes.empty() && !asked) return 1;
    return params.lanes == 0 ? default_lanes(kernel, device) : params.lanes;
}

}  // namespace

RenderJob render_job(const Case& params, const Integrator& kernel, const DeviceInfo& device,
                     const Scene& scene, std::uint64_t seed) {
    return {params.size,
            params.spp,
            params.path_length,
            static_cast<std::uint32_t>(seed),
            lanes_of(params, kernel, device, scene),
            params.work_group.x,
            params.work_group.y,
            params.variant};
}

std::string CaseJob::key() const {
    return fmt::format("{} {} {} {} {}", params.kernel, params.scene, work.lanes, work.path_length,
                       to_string(work.variant));
}

CaseJob CaseJob::implicit() const {
    CaseJob job = *this;
    job.work.work_group_x = job.work.work_group_y = 0;
    return job;
}

CaseJob CaseJob::plain() const {
    CaseJob job = implicit();
    job.work.variant = of_image(work.variant);
    return job;
}

CaseJob CaseJob::sized(Size size, int spp) const {
    CaseJob job = *this;
    job.work.size = size;
    job.work.spp = spp;
    return job;
}

}  // namespace ptb
