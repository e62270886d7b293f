#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/scene.h"
#include "shared/pt.h"

namespace ptb {

/// A scene in the order and shape that the kernel `pt` wants: opaque spheres that the camera is outside of
/// first, then the two-sided ones (dielectrics, and whatever the camera is in), whose sides a path carries as
/// bits.
struct PtScene {
    std::vector<PtSphere> spheres;
    PtFewSpheres few{};               ///< the same spheres, up to PT_FEW_MOST of them
    std::vector<PtSurface> surfaces;  ///< one a sphere, and the background's
    std::vector<std::uint32_t>
        camera_sides;  ///< bit j from the top: the camera is inside two-sided sphere j; at least one word
    std::uint32_t opaque = 0, two_sided = 0;
};

/// Which spheres the camera is in is decided in double.
PtScene make_pt_scene(const Scene& scene);

}  // namespace ptb
