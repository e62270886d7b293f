#pragma once

#include "core/integrator/registry.h"

namespace ptb {

Integrator thesis_integrator();

}  // namespace ptb
