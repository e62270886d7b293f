#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/scene/scene.h"

namespace ptb {

/// How rays are met with a sphere in single precision: see kernels/scene/hit.h.
enum class Form {
    plain,
    vast,    ///< so large that a distance would be the small difference of two large numbers
    distant  ///< so far from the origin for its size that its terms cancel
};

/// A scene as single precision bears it best. A picture depends neither on where the scene's origin is nor on
/// its unit of length: errors are judged by the scene's finest detail.
struct Placement {
    Vec3 origin;              ///< of the device's coordinates; the scene's own if all spheres are plain there
    std::vector<Form> forms;  ///< a sphere each, in the scene's order
    double plain_error = 0;   ///< of plain spheres' distances, at most, in lengths of the finest detail
    std::optional<std::size_t> lost;  ///< a sphere so small where it is that no form finds it
};

/// The largest error of that kind that a plain sphere may have.
inline constexpr double bearable_error = 1e-3;

/// In time proportional to the number of spheres.
Placement place(const Scene& scene);

/// The same scene in coordinates from another origin, its meshes left out.
Scene spheres_seen_from(const Scene& scene, const Vec3& origin);

}  // namespace ptb
