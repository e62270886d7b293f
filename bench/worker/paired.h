#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/compare/gate.h"
#include "bench/measure/timer.h"
#include "bench/worker/coordinator.h"

namespace ptb {

/// Two versions on one device: how their workers are reached, and with which options.
struct Side {
    std::string name;  ///< "--base" or "--new", for errors
    OpenChannel open;
    MeasureOptions measure;
};

/// One case on both sides: its records by the validation, and its blocks.
struct PairedCase {
    GateCase gate;
    Record base, now;
    TimerWatch timer = TimerWatch("auto");  ///< of all samples so far, both sides'
};

/// Feeds two workers of one device alternately.
class PairedRun {
  public:
    PairedRun(const DeviceInfo& device, const Side& base, const Side& now, Stopped stopped);

    /// Validates both sides and begins to watch the clock; what has no valid image on both is not measured.
    /// Throws std::runtime_error when a side's worker does not start, VersionMismatch when it is of another
    /// one.
    void validate(PairedCase& c);

    /// Appends a block of base, new, new, base; what fails in it loses all its blocks, what was
    /// interrupted in it keeps those before.
    void add_block(PairedCase& c, std::vector<Block> GateCase::*stage);

    bool stopped() const { return stopped_(); }

  private:
    struct Worker {
        std::string name;
        DeviceWorker worker;
    };
    Record validated(Worker& side, const Case& c);
    static void observe(PairedCase& c, const Record& record);
    static void leave_out(PairedCase& c, bool now_failed, const std::string& reason);

    Worker base_, now_;
    std::string timer_;  ///< as asked for
    Stopped stopped_;
};

/// Takes `blocks` blocks of each of `cases`, which are visited in an order that `seed` shuffles anew for each
/// block. Ends early when the run is stopped; `tell` hears of each block that is done.
void take_blocks(PairedRun& run, const std::vector<PairedCase*>& cases, std::vector<Block> GateCase::*stage,
                 int blocks, std::uint64_t seed, const std::function<void(int done)>& tell);

}  // namespace ptb
