#pragma once

#include "bench/worker/coordinator.h"

namespace ptb {

/// Measures cases of several devices that make one picture: the host's time from the first part handed out to
/// the last film added, by the rules that all cases are measured by.
MeasureShared shared_measurer(const MeasureOptions& options, const OpenChannel& open, const Stopped& stopped);

}  // namespace ptb
