#pragma once

#include "core/integrator/registry.h"

namespace ptb {

Integrator pt_integrator();

}  // namespace ptb
