#pragma once

#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// The devices of all drivers that this process' loader sees, with keys unique among them. Calls OpenCL in
/// this process; a driver may crash or hang in it. Throws std::runtime_error with the reason when there is
/// none.
std::vector<DeviceInfo> probe_devices();

}  // namespace ptb
