#include "bench/measure/sampler.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/measure/causes.h"
#include "bench/measure/clock.h"
#include "bench/measure/cpu_time.h"

namespace ptb {

namespace {

/// One pass of at most `most` samples: steers the cutter and adds to what is known of the sample. Returns
/// what the events cover.
std::int64_t timed_pass(Render& render, const Timing& timing, std::uint64_t most, TimedRender& sample) {
    const std::uint64_t before = render.samples_left();
    const std::int64_t begin = now_ns();
    const std::vector<LaunchTimes> launches = render.advance(std::min(timing.cutter.next(), most));
    const std::int64_t host_ns = now_ns() - begin;
    const std::string fault = timer_fault(launches, host_ns, timing.timer_resolution_ns);
    if (sample.timer.fault.empty()) sample.timer.fault = fault;
    sample.timer.tick_ns = tick_ns(launches, sample.timer.tick_ns);
    add_pass(sample.time, launches, host_ns);
    const std::int64_t pass_ns = fault.empty() ? union_ns(launches) : host_ns;
    timing.cutter.learn(before - render.samples_left(), pass_ns);
    sample.longest_launch_ns = std::max(sample.longest_launch_ns, pass_ns);
    ++sample.passes;
    return covered_ns(launches);
}

/// Passes until nothing is left, or until `progress` ends it, which is told of the share that is done. Adds
/// what the events cover; returns whether to go on.
bool timed_passes(Render& render, const Timing& timing, const Progress& progress, TimedRender& sample,
                  std::int64_t& covered_ns) {
    const auto all = static_cast<double>(render.samples_left());
    bool going = true;
    while (going && render.samples_left() > 0) {
        covered_ns += timed_pass(render, timing, render.samples_left(), sample);
        going = progress(1 - static_cast<double>(render.samples_left()) / all);
    }
    return going;
}

/// How far a render has come that is to last `time_s`.
struct Halfway {
    std::uint64_t done = 0, left = 0, round = 1;  ///< samples
    double elapsed_s = 0, time_s = 0;
};

/// Samples that are still to be rendered; 0 at the end. A round that was begun is ended; another one is begun
/// if that comes nearer to the time.
std::uint64_t samples_in_time(const Halfway& at) {
    const std::uint64_t rest = (at.round - at.done % at.round) % at.round;
    if (at.done < at.round) return std::min(rest == 0 ? at.round : rest, at.left);
    const auto round = static_cast<double>(at.round), done = static_cast<double>(at.done);
    const double affordable = done * std::max(at.time_s / at.elapsed_s - 1, 0.0);  // at the speed so far
    const double rounds = std::max(std::round((affordable - static_cast<double>(rest)) / round), 0.0);
    const double samples = static_cast<double>(rest) + rounds * round;
    return samples < static_cast<double>(at.left) ? static_cast<std::uint64_t>(samples) : at.left;
}

}  // namespace

void PassCutter::learn(std::uint64_t samples, std::int64_t ns) {
    const double wanted = static_cast<double>(samples) * static_cast<double>(target_ns) /
                          static_cast<double>(std::max<std::int64_t>(ns, 1));
    next_ = static_cast<std::uint64_t>(std::clamp(wanted, 1.0, static_cast<double>(samples) * 8));
}

TimedRender timed_render(Render& render, const Timing& timing) {
    TimedRender sample;
    const std::int64_t waited_ns = scheduled_thread().waited_ns;
    std::int64_t covered = 0;
    bool going = true;
    for (int i = 0; i < timing.renders && going; ++i) {
        render.restart();
        const auto of_all = [&](double done) { return timing.progress((i + done) / timing.renders); };
        going = timed_passes(render, timing, of_all, sample, covered);
    }
    const std::int64_t woken_late_ns = scheduled_thread().waited_ns - waited_ns;
    sample.timer.disagrees = clocks_disagree(covered, sample.time.host_ns - woken_late_ns);
    if (sample.timer.disagrees) sample.time.cause = cause::clocks_differ;
    if (!sample.timer.fault.empty()) sample.time.cause = cause::timer_fault;
    return sample;
}

TimedRender timed_rest(Render& render, const Timing& timing) {
    TimedRender sample;
    std::int64_t covered_ns = 0;
    timed_passes(render, timing, timing.progress, sample, covered_ns);
    return sample;
}

std::int64_t believed_ns(const TimedRender& render) {
    return render.timer.fault.empty() ? render.time.kernel_ns : render.time.host_ns;
}

void render_for(Render& render, double time_s, std::uint64_t round_samples, const Timing& timing) {
    TimedRender passes;
    render.restart();
    const std::uint64_t all = render.samples_left();
    const std::int64_t begin = now_ns();
    for (bool going = true; going;) {
        const std::uint64_t left = render.samples_left();
        const std::uint64_t samples =
            samples_in_time({all - left, left, round_samples, seconds_since(begin), time_s});
        if (samples == 0) break;
        timed_pass(render, timing, samples, passes);
        going = timing.progress(std::min(seconds_since(begin) / time_s, 1.0));
    }
}

}  // namespace ptb
