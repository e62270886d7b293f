#include "bench/workbench/pace.h"

#include <utility>

namespace ptb {
namespace {

constexpr Size trial_size{128, 128};
constexpr int trial_spp = 2;

}  // namespace

Timing Pace::timing(const CaseJob& job, Progress progress, int renders) {
    return {cutters_[job.key()], builds_.device().info.timer_resolution_ns, std::move(progress), renders};
}

std::int64_t Pace::trial_ns(const CaseJob& job) {
    const auto render = builds_.make(job);
    const Timing timed = timing(job, [](double) { return true; });
    timed_render(*render, timed);  // may compile
    return believed_ns(timed_render(*render, timed));
}

double Pace::ns_per_sample(const CaseJob& job) {
    double& ns = ns_per_sample_[job.key()];
    if (ns <= 0)
        ns = static_cast<double>(trial_ns(job.implicit().sized(trial_size, trial_spp))) /
             static_cast<double>(trial_size.pixels() * trial_spp);
    return ns;
}

}  // namespace ptb
