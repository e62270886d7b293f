#include "bench/worker/render_job.h"

#include <algorithm>
#include <memory>

#include "bench/measure/clock.h"
#include "bench/measure/sampler.h"
#include "bench/plan/config.h"
#include "bench/plan/data_dir.h"
#include "bench/plan/scene_file.h"
#include "bench/workbench/case_job.h"
#include "core/input/usage_error.h"

namespace ptb {
namespace {

constexpr double round_share = 0.02;  ///< of the time: so much earlier or later it may end
constexpr int most_round_spp = 512;
constexpr int most_rounds = 1 << 20;  ///< each is noted; they last for hours
constexpr Size trial_size{128, 128};
constexpr int trial_spp = 2;

/// Everything that a request's render is made from.
struct Workshop {
    const Integrator& kernel;
    ocl::Device device;
    Scene scene;
    std::string kernel_dir;

    std::unique_ptr<Render> make(const RenderJob& job) const {
        const std::string unsupported = unsupported_reason(kernel, device, scene, job);
        if (!unsupported.empty()) throw UsageError(unsupported);
        const ocl::Program program =
            ocl::build(device, kernel_source(kernel.file(), kernel_dir), kernel.options(device, scene, job));
        return kernel.make(device, program, scene, job);
    }
};

/// Of a small render, the second: the first may compile.
double seconds_per_sample(const Workshop& workshop, RenderJob job) {
    job.size = {std::min(job.size.width, trial_size.width), std::min(job.size.height, trial_size.height)};
    job.spp = trial_spp;
    const auto render = workshop.make(job);
    PassCutter cutter;
    double seconds = 0;
    for (int i = 0; i < 2; ++i) {
        const std::int64_t begin = now_ns();
        timed_render(*render,
                     {cutter, workshop.device.info.timer_resolution_ns, [](double) { return true; }});
        seconds = seconds_since(begin);
    }
    return seconds / static_cast<double>(job.size.pixels() * trial_spp);
}

/// Rounds so short that the time can be met, and more of them than it will take.
RenderJob endless(RenderJob job, double time_s, double seconds_per_sample) {
    const double round_s = seconds_per_sample * static_cast<double>(job.size.pixels());
    job.round_spp = static_cast<int>(std::clamp(round_share * time_s / round_s, 1.0, 1.0 * most_round_spp));
    job.spp = std::min(most_spp(job.path_length) / job.round_spp, most_rounds) * job.round_spp;
    return job;
}

}  // namespace

Rendered render_picture(const RenderRequest& request, const std::function<bool(double done)>& progress) {
    const Workshop workshop{integrator(request.params.kernel), ocl::open_device(request.params.device),
                            load_scene(scene_file(request.params.scene, data_dir())), request.kernel_dir};
    RenderJob job =
        render_job(request.params, workshop.kernel, workshop.device.info, workshop.scene, request.seed);
    if (request.time_s) job = endless(job, *request.time_s, seconds_per_sample(workshop, job));
    const auto render = workshop.make(job);
    PassCutter cutter;
    bool stopped = false;
    const Progress watched = [&](double done) { return !(stopped = !progress(done)); };
    const Timing timing{cutter, workshop.device.info.timer_resolution_ns, watched};
    const std::uint64_t all = render->samples_left();
    const std::int64_t begin = now_ns();
    if (request.time_s)
        render_for(*render, *request.time_s, job.size.pixels() * static_cast<std::uint64_t>(job.round_spp),
                   timing);
    else
        timed_render(*render, timing);
    const double seconds = seconds_since(begin);
    const std::uint64_t left = render->samples_left();
    return {render->read_film().mean, left == 0 || !stopped,
            static_cast<double>(all - left) / static_cast<double>(job.size.pixels()), seconds};
}

}  // namespace ptb
