#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"
#include "shared/pt.h"

namespace ptb {

/// A scene in the order and shape that the kernel `pt` wants: opaque spheres that the camera is outside of
/// first, then the two-sided ones (dielectrics, and whatever the camera is in), whose sides a path carries as
/// bits. Coordinates are those of its Placement.
struct PtScene {
    struct Numbers {
        std::uint32_t begin = 0, end = 0;
    };
    std::vector<PtSphere> spheres;
    PtFewSpheres few{};                    ///< the same spheres, up to PT_FEW_MOST of them
    std::vector<PtSurface> surfaces;       ///< one a face, the background's, and the bits of a PtStart
    std::array<std::uint32_t, 3> zeros{};  ///< x, y, z: bit i where the centre of few sphere i has a 0
    /// Bit j from the top: the camera is inside two-sided sphere j; at least one word, see pt/scene.h.
    std::vector<std::uint32_t> camera_sides;
    std::uint32_t opaque = 0, two_sided = 0;
    Numbers careful, distant;  ///< spheres that are not plain, and the distant ones among them
    double plain_error = 0;    ///< see Placement

    std::uint64_t faces() const { return opaque + 2 * two_sided; }
    bool is_few() const { return faces() <= PT_FEW_MOST; }
    bool has_careful() const { return careful.begin < careful.end; }
    std::uint64_t bytes() const {
        return spheres.size() * sizeof(PtSphere) + surfaces.size() * sizeof(PtSurface);
    }
};

/// Which spheres the camera is in is decided in double.
PtScene make_pt_scene(const Scene& scene);

}  // namespace ptb
