#pragma once

#include <cstdint>
#include <functional>

#include "bench/measure/timer.h"
#include "bench/record/record.h"
#include "core/render/render.h"

namespace ptb {

/// Chooses how many pixel samples the next pass gets, so that a launch lasts about a quarter of a second:
/// drivers kill or freeze on longer ones, and shorter ones cost launches.
class PassCutter {
  public:
    static constexpr std::int64_t target_ns = 250'000'000;
    std::uint64_t next() const { return next_; }
    /// Learns from a pass of `samples` that took `ns`. Grows at most eightfold a pass.
    void learn(std::uint64_t samples, std::int64_t ns);

  private:
    std::uint64_t next_ = 4096;
};

/// Full renders under both clocks; times are of all of them together.
struct TimedRender {
    TimeSample time;
    TimerEvidence timer;
    int passes = 0;
    std::int64_t longest_launch_ns = 0;
};

/// The time by the events, or the host's where those contradict themselves.
std::int64_t believed_ns(const TimedRender& render);

/// Told after every pass how much of the render is done, 0 to 1; answers whether to go on.
using Progress = std::function<bool(double done)>;

/// How to render: the cutter learns, and `progress` may end it early.
struct Timing {
    PassCutter& cutter;
    std::uint64_t timer_resolution_ns;
    Progress progress;
    int renders = 1;
};

/// Renders from an empty film to the end, pass by pass, `renders` times. The events' own lengths steer the
/// cutter, the host's clock where they are useless.
TimedRender timed_render(Render& render, const Timing& timing);

/// Renders what is left, pass by pass. `progress` is told of the share of it.
TimedRender timed_rest(Render& render, const Timing& timing);

/// Renders from an empty film for about `time_s` by the host's clock, to the nearest end of a round of
/// `round_samples` samples, at least one. `progress` is told of the time.
void render_for(Render& render, double time_s, std::uint64_t round_samples, const Timing& timing);

}  // namespace ptb
