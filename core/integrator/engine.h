#pragma once

#include "core/integrator/registry.h"

namespace ptb {

/// Units of samples, taken from a queue by lanes that never idle, and a film of whole numbers:
/// kernels/engine.
extern const Machinery engine_machinery;

}  // namespace ptb
