#pragma once

#include <vector>

#include "core/scene/node.h"

namespace ptb {

/// The meshes of a scene file's list, placed in the world. Throws UsageError.
std::vector<Mesh> read_meshes(const scene_json::Node& list, const scene_json::MaterialIndex& materials,
                              const MeshReading& reading);

}  // namespace ptb
