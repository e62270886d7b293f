#pragma once

#include "core/integrator/device_scene.h"
#include "core/ocl/device.h"

namespace ptb {

/// The tree that the triangles of a scene lie in on a device whose origin is there. Its boxes are large
/// enough for rays from the camera and from all spheres.
std::shared_ptr<const Tree> mesh_tree(const Scene& scene, const Vec3& origin, TreeLayout layout,
                                      TreeSettings settings);

/// Gives `device` the triangles of the scene that it was made of, in a tree of this layout.
void add_meshes(DeviceScene& device, const Scene& scene, TreeLayout layout, const TreeSettings& settings);

/// All triangles of a scene by their numbers, in the coordinates of a device whose origin this is.
std::vector<Triangle> device_triangles(const Scene& scene, const Vec3& origin);

/// A tree on a device: its nodes and its leaves. Throws cl::Error.
std::vector<cl::Buffer> tree_buffers(const ocl::Device& device, const Tree& tree);

}  // namespace ptb
