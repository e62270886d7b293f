#pragma once

#include "core/integrator/device_scene.h"

namespace ptb {

/// Gives `device` the lamps of the scene that it was made of, and its surfaces their numbers.
void add_lamps(DeviceScene& device, const Scene& scene);

}  // namespace ptb
