#pragma once

#include "core/integrator/device_scene.h"

namespace ptb {

/// The tree that the triangles of a scene lie in on a device whose origin is there.
std::shared_ptr<const Tree> mesh_tree(const Scene& scene, const Vec3& origin, TreeLayout layout,
                                      const TreeSettings& settings);

/// Gives `device` the triangles of the scene that it was made of, in a tree of this layout.
void add_meshes(DeviceScene& device, const Scene& scene, TreeLayout layout, const TreeSettings& settings);

}  // namespace ptb
