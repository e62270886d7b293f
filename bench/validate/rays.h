#pragma once

#include "bench/record/record.h"
#include "core/render/ray_sample.h"

namespace ptb {

/// Adds what a brute-force search in double precision says of rays, without a tree: of as many of the sample
/// as it affords. A ray's hit is wrong where the ray passes by its triangle, where the distance is another,
/// or where another triangle is met before; within what single precision rounds it may be either. A shadow
/// ray's is wrong where it found no triangle of some within its reach, or one that it does not meet.
void check_rays(Validation& validation, const RaySample& sample);

}  // namespace ptb
