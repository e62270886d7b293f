#include "bench/measure/sampler.h"

#include <algorithm>
#include <vector>

#include "bench/measure/causes.h"
#include "bench/measure/clock.h"
#include "bench/measure/cpu_time.h"

namespace ptb {

namespace {

/// One pass: steers the cutter and adds to what is known of the sample. Returns what the events cover.
std::int64_t timed_pass(Render& render, const Timing& timing, TimedRender& sample) {
    const std::uint64_t before = render.samples_left();
    const std::int64_t begin = now_ns();
    const std::vector<LaunchTimes> launches = render.advance(timing.cutter.next());
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
        const auto all = static_cast<double>(render.samples_left());
        while (going && render.samples_left() > 0) {
            covered += timed_pass(render, timing, sample);
            const double done = 1 - static_cast<double>(render.samples_left()) / all;
            going = timing.progress((i + done) / timing.renders);
        }
    }
    const std::int64_t woken_late_ns = scheduled_thread().waited_ns - waited_ns;
    sample.timer.disagrees = clocks_disagree(covered, sample.time.host_ns - woken_late_ns);
    if (sample.timer.disagrees) sample.time.cause = cause::clocks_differ;
    if (!sample.timer.fault.empty()) sample.time.cause = cause::timer_fault;
    return sample;
}

}  // namespace ptb
