#include "bench/measure/sampler.h"

#include <algorithm>

#include "bench/measure/clock.h"
#include "bench/measure/timer.h"

namespace ptb {

void PassCutter::learn(std::uint64_t samples, std::int64_t ns) {
    const double wanted = static_cast<double>(samples) * static_cast<double>(target_ns) /
                          static_cast<double>(std::max<std::int64_t>(ns, 1));
    next_ = static_cast<std::uint64_t>(std::clamp(wanted, 1.0, static_cast<double>(samples) * 8));
}

TimedRender timed_render(Render& render, PassCutter& cutter, std::uint64_t timer_resolution_ns,
                         const Progress& progress) {
    TimedRender result;
    render.restart();
    const std::uint64_t all = render.samples_left();
    for (std::uint64_t left = all; left > 0;) {
        const std::int64_t begin = now_ns();
        const std::vector<LaunchTimes> launches = render.advance(cutter.next());
        const std::int64_t host_ns = now_ns() - begin;
        const std::string fault = timer_fault(launches, host_ns, timer_resolution_ns);
        if (result.timer_fault.empty()) result.timer_fault = fault;
        add_pass(result.time, launches, host_ns);
        result.covered_ns += covered_ns(launches);
        const std::int64_t pass_ns = fault.empty() ? union_ns(launches) : host_ns;
        cutter.learn(left - render.samples_left(), pass_ns);
        result.longest_launch_ns = std::max(result.longest_launch_ns, pass_ns);
        ++result.passes;
        left = render.samples_left();
        if (!progress(1 - static_cast<double>(left) / static_cast<double>(all))) break;
    }
    if (!result.timer_fault.empty()) result.time.cause = "timer_fault";
    return result;
}

}  // namespace ptb
