#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bench/measure/causes.h"
#include "bench/measure/cpu_time.h"
#include "core/ocl/program.h"

namespace ptb {

/// A small fixed kernel that shows the device's clock.
class ClockProbe {
  public:
    explicit ClockProbe(const ocl::Device& device);
    /// Device time of the fastest of a few launches, ns; 0 where the events cannot be believed.
    std::int64_t run();
    /// What the last run took by the host's clock, seconds.
    double cost_s() const { return cost_s_; }

  private:
    ocl::Device device_;
    ocl::Program program_;
    cl::Kernel kernel_;
    cl::Buffer out_;
    double cost_s_ = 0;
};

/// Watches for what disturbs a device's samples and the samples do not show.
class Disturbances {
  public:
    explicit Disturbances(const ocl::Device& device)
        : device_(device), place_{device.info.type == "CPU", look_around()} {}
    /// A sample begins that is predicted to last so long. Short ones go unwatched.
    void begin(double predicted_s);
    /// It has ended: notes the probe's time in it, and the cause where others took its CPU time.
    void end(TimeSample& sample);
    const Place& place() const { return place_; }

  private:
    bool make_probe();
    std::string taken_by_others() const;

    ocl::Device device_;
    Place place_;
    std::unique_ptr<ClockProbe> probe_;
    bool no_probe_ = false, probing_ = false, counting_ = false, counting_ticks_ = false;
    CpuTicks ticks_;
    Scheduled scheduled_;
    std::int64_t began_ns_ = 0;
};

}  // namespace ptb
