#pragma once

#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// The devices of all drivers that this process' loader sees, with keys unique among them. Calls OpenCL in
/// this process; a driver may crash or hang in it.
std::vector<DeviceInfo> probe_devices();

}  // namespace ptb
