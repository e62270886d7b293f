#pragma once

#include <memory>
#include <vector>

#include "core/tree/triangle.h"
#include "shared/rays.h"

namespace ptb {

/// Some rays of a list, what a device said that they meet, and all that they might.
struct RaySample {
    std::vector<ListedRay> rays;
    std::vector<ListedHit> hits;  ///< of each ray
    bool any = false;             ///< rays were followed to any triangle within reach, not to the nearest
    std::shared_ptr<const std::vector<Triangle>> triangles;  ///< by their numbers
};

}  // namespace ptb
