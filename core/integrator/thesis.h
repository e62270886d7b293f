#pragma once

#include "core/integrator/registry.h"

namespace ptb {

/// One work-item a pixel, everything in global memory.
extern const Machinery thesis_machinery;

}  // namespace ptb
