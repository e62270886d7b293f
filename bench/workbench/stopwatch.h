#pragma once

#include <memory>
#include <optional>

#include "bench/measure/disturbance.h"
#include "bench/measure/energy.h"
#include "bench/measure/method.h"
#include "bench/measure/nvml.h"
#include "bench/plan/config.h"
#include "bench/workbench/pace.h"
#include "bench/workbench/stage.h"

namespace ptb {

/// Times jobs on one device by the method of bench/measure: knows which clock to believe, what disturbs, and
/// the energy counter.
class Stopwatch {
  public:
    Stopwatch(Builds& builds, Pace& pace, const MeasureOptions& options);

    /// Reads the device's idle power, before anything is timed. Takes its time once.
    void rest(const Stage& stage);

    /// Times a job's own work, notes passes and energy, and leaves the last sample's film in `render`. Throws
    /// Unsupported where the clock that was asked for is wrong.
    Measurement time(const CaseJob& job, Render& render, double time_left_s, const Stage& stage,
                     Record& record);

    /// Notes what was measured; an unstable case keeps its numbers, and says so.
    void summarize(const Measurement& measurement, Record& record) const;

  private:
    Method method(double render_s, double time_left_s) const;
    TakeSample samples_of(const CaseJob& job, Render& render, double render_s, const Stage& stage,
                          Work& work);
    void refuse_wrong_clock() const;
    const DeviceInfo& device() const { return builds_.device().info; }

    Builds& builds_;
    Pace& pace_;
    MeasureOptions options_;
    TimerWatch timer_;
    Disturbances disturbances_;
    std::optional<EnergyMeter> energy_;
    std::shared_ptr<const NvmlGpu> gpu_;  ///< or null
};

}  // namespace ptb
