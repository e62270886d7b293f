#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace ptb {

/// 16 hexadecimal digits of a scene file's text and of all files that its meshes come from: what makes two
/// scenes the same. Throws UsageError where one cannot be read.
std::string scene_hash(const std::filesystem::path& file);

/// What of the meshes is not in the scene, a line each: "bunny.obj: left out 3 triangles without an area".
std::vector<std::string> left_out_of(const Scene& scene);

}  // namespace ptb
