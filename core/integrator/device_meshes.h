#pragma once

#include "core/integrator/device_scene.h"

namespace ptb {

/// Gives `device` the triangles of the scene that it was made of, in a tree of this layout.
void add_meshes(DeviceScene& device, const Scene& scene, TreeLayout layout, const TreeSettings& settings);

}  // namespace ptb
