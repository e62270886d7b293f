#pragma once

#include <string>
#include <vector>

#include "bench/plan/config.h"

namespace ptb {

/// What to try next, after this run: one line each, with the flag.
std::vector<std::string> hints(const Config& config, const std::vector<DeviceInfo>& all_devices,
                               const std::vector<DeviceInfo>& used, const std::vector<Record>& records);

}  // namespace ptb
