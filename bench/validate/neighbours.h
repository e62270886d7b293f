#pragma once

#include "core/oracle/reference.h"

namespace ptb {

/// How much the errors of pixels `dx` to the right and `dy` below go together, in standard errors:
/// independent pixels give a standard normal number, whatever the distribution of their errors. Errors are
/// differences from the reference's mean; both images have the same size.
double neighbour_z(const Image& film, const Reference& reference, int dx, int dy);

}  // namespace ptb
