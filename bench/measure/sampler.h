#pragma once

#include <cstdint>
#include <functional>
#include <string>

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

/// One full render under both clocks.
struct TimedRender {
    TimeSample time;
    std::string timer_fault;      ///< what was wrong with the events, or nothing
    std::int64_t covered_ns = 0;  ///< of the host's time, what the events account for
    int passes = 0;
    std::int64_t longest_launch_ns = 0;
};

/// Told after every pass how much of the render is done, 0 to 1; answers whether to go on.
using Progress = std::function<bool(double done)>;

/// Renders from an empty film to the end, pass by pass. The events' own lengths steer the cutter, the host's
/// clock where they are useless.
TimedRender timed_render(Render& render, PassCutter& cutter, std::uint64_t timer_resolution_ns,
                         const Progress& progress);

}  // namespace ptb
