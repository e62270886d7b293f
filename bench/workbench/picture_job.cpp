#include "bench/workbench/picture_job.h"

#include <algorithm>

#include "bench/measure/clock.h"
#include "bench/plan/config.h"

namespace ptb {
namespace {

constexpr double round_share = 0.02;  ///< of the time: so much earlier or later it may end
constexpr int most_round_spp = 512;
constexpr int most_rounds = 1 << 20;  ///< each is noted; they last for hours

/// Rounds so short that the time can be met, and more of them than it will take.
void make_endless(RenderJob& work, double time_s, double ns_per_sample) {
    const double round_s = ns_per_sample * 1e-9 * static_cast<double>(work.size.pixels());
    work.round_spp = static_cast<int>(std::clamp(round_share * time_s / round_s, 1.0, 1.0 * most_round_spp));
    work.spp = std::min(most_spp(work.path_length) / work.round_spp, most_rounds) * work.round_spp;
}

/// Seconds that it took: by the host's clock where that decides, else the device's, which compiles apart.
double render_as_asked(Render& render, const RenderJob& work, std::optional<double> time_s,
                       const Timing& timing) {
    if (!time_s) return 1e-9 * static_cast<double>(believed_ns(timed_render(render, timing)));
    const std::int64_t begin = now_ns();
    render_for(render, *time_s, work.size.pixels() * static_cast<std::uint64_t>(work.round_spp), timing);
    return seconds_since(begin);
}

}  // namespace

Rendered render_picture(Builds& builds, Pace& pace, CaseJob job, std::optional<double> time_s,
                        const Progress& progress) {
    if (time_s) make_endless(job.work, *time_s, pace.ns_per_sample(job));
    const std::uint64_t pixels = job.work.size.pixels();
    const auto render = builds.make(job);
    bool stopped = false;
    const Timing timing = pace.timing(job, [&](double done) { return !(stopped = !progress(done)); });
    const std::uint64_t all = render->samples_left();
    const double seconds = render_as_asked(*render, job.work, time_s, timing);
    const std::uint64_t left = render->samples_left();
    return {render->read_film().mean, left == 0 || !stopped,
            static_cast<double>(all - left) / static_cast<double>(pixels), seconds};
}

}  // namespace ptb
