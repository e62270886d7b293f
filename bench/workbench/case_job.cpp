#include "bench/workbench/case_job.h"

#include <fmt/format.h>

namespace ptb {

RenderJob render_job(const Case& params, const Integrator& kernel, const DeviceInfo& device,
                     std::uint64_t seed) {
    return {params.size,
            params.spp,
            params.path_length,
            static_cast<std::uint32_t>(seed),
            params.lanes == 0 ? default_lanes(kernel, device) : params.lanes,
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
