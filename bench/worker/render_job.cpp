#include "bench/worker/render_job.h"

#include "bench/measure/sampler.h"
#include "bench/plan/data_dir.h"
#include "bench/plan/scene_file.h"
#include "bench/workbench/case_job.h"
#include "core/input/usage_error.h"

namespace ptb {

Rendered render_picture(const RenderRequest& request, const std::function<bool(double done)>& progress) {
    const Case& c = request.params;
    const Scene scene = load_scene(scene_file(c.scene, data_dir()));
    const Integrator& kernel = integrator(c.kernel);
    const ocl::Device device = ocl::open_device(c.device);
    const RenderJob job = render_job(c, kernel, device.info, request.seed);
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
