#pragma once

#include "core/integrator/registry.h"

namespace ptb {

/// A list of rays, made before anything is timed, and a work-item for each or for a run of them:
/// kernels/rays. The picture is of where rays end: nearness, or light where shadow rays get to their lamp.
extern const Machinery rays_machinery;

}  // namespace ptb
