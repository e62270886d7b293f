#pragma once

#include <string>

#include "bench/measure/surroundings.h"

namespace ptb {

/// Where a device is measured, as far as advice depends on it.
struct Place {
    bool cpu_device = false;
    Surroundings host = {};
};

/// What to do about samples with this cause, here; an empty cause: about times that vary without one.
std::string advice(const std::string& cause, const Place& place);

}  // namespace ptb
