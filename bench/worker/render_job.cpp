#include "bench/worker/render_job.h"

#include "bench/measure/sampler.h"
#include "bench/plan/data_dir.h"
#include "bench/plan/scene_file.h"
#include "core/input/usage_error.h"
#include "core/integrator/registry.h"

namespace ptb {

Rendered render_picture(const RenderRequest& request, const std::function<bool(double done)>& progress) {
    const Case& c = request.params;
    const Scene scene = load_scene(scene_file(c.scene, data_dir()));
    const Integrator& kernel = integrator(c.kernel);
    const ocl::Device device = ocl::open_device(c.device);
    const RenderJob job{c.size,
                        c.spp,
                        c.path_length,
                        static_cast<std::uint32_t>(request.seed),
                        c.lanes == 0 ? default_lanes(kernel, device.info) : c.lanes,
                        c.work_group.x,
                        c.work_group.y,
                        c.variant};
    const std::string unsupported = unsupported_reason(kernel, device, scene, job);
    if (!unsupported.empty()) throw UsageError(unsupported);
    const ocl::Program program = ocl::build(device, kernel_source(kernel.file(), request.kernel_dir),
                                            kernel.options(device, scene, job));
    const auto render = kernel.make(device, program, scene, job);
    PassCutter cutter;
    timed_render(*render, {cutter, device.info.timer_resolution_ns, progress});
    return {render->read_film().mean, render->samples_left() == 0};
}

}  // namespace ptb
