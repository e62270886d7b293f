#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/scene/scene.h"
#include "shared/scene.h"

namespace ptb {

/// The triangles of a scene's meshes, none where it has none.
struct DeviceMeshes {
    std::vector<SceneTriangle> triangles;  ///< by their numbers in the scene
    std::shared_ptr<const Tree> tree;      ///< that they lie in
    bool refract = false;                  ///< some are of a dielectric

    bool any() const { return !triangles.empty(); }
    std::uint64_t node_bytes() const;
    std::uint64_t leaf_bytes() const;
    std::uint64_t triangle_bytes() const { return triangles.size() * sizeof(SceneTriangle); }
    std::uint64_t bytes() const { return node_bytes() + leaf_bytes() + triangle_bytes(); }
};

/// A scene in the order and shape that the engine's kernels want: opaque spheres that the camera is outside
/// of first, then the two-sided ones (dielectrics, and whatever the camera is in), whose sides a path carries
/// as bits. Coordinates are those of its Placement.
struct DeviceScene {
    struct Numbers {
        std::uint32_t begin = 0, end = 0;
    };
    std::vector<SceneSphere> spheres;
    SceneFewSpheres few{};                 ///< the same spheres, up to SCENE_FEW_MOST of them
    std::vector<SceneSurface> surfaces;    ///< one a face, the background's, and the bits of a SceneStart
    std::array<std::uint32_t, 3> zeros{};  ///< x, y, z: bit i where the centre of few sphere i has a 0
    /// Bit j from the top: the camera is inside two-sided sphere j; at least one word, see scene/scene.h.
    std::vector<std::uint32_t> camera_sides;
    std::uint32_t opaque = 0, two_sided = 0;
    Numbers careful, distant;  ///< spheres that are not plain, and the distant ones among them
    double plain_error = 0;    ///< see Placement
    bool has_meshes = false;
    std::uint32_t mesh_faces = 0;  ///< the row of the outer face of triangles of the scene's first material
    Vec3 origin;                   ///< where the scene has the device's origin
    std::vector<std::uint32_t> outer_faces;  ///< of the scene's spheres, in its order: rows of `surfaces`
    std::vector<SceneLamp> lamps;            ///< what can be sampled of the emitters; see add_lamps
    SceneLamp lone_lamp{};                   ///< the first one
    DeviceMeshes meshes;                     ///< see add_meshes

    std::uint64_t faces() const { return opaque + 2 * two_sided; }
    /// Rays are alone where there are meshes, and know spheres by number.
    bool is_few() const { return faces() <= SCENE_FEW_MOST && !has_meshes; }
    bool has_careful() const { return careful.begin < careful.end; }
    /// Of what may lie in constant or local memory, and of all.
    std::uint64_t read_bytes() const {
        return spheres.size() * sizeof(SceneSphere) + surfaces.size() * sizeof(SceneSurface);
    }
    std::uint64_t bytes() const { return read_bytes() + lamps.size() * sizeof(SceneLamp) + meshes.bytes(); }
};

/// Which spheres the camera is in is decided in double.
DeviceScene make_device_scene(const Scene& scene);

}  // namespace ptb
