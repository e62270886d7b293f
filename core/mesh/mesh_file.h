#pragma once

#include <filesystem>

#include "core/mesh/geometry.h"

namespace ptb {

/// The triangles of an OBJ, PLY, STL, glTF or GLB file, polygons cut into triangles. Throws UsageError, one
/// line that begins with what is wrong and names the file.
struct MeshFile {
    Geometry geometry;
    std::uint64_t points_and_lines = 0;  ///< which are left out
};
MeshFile read_mesh_file(const std::filesystem::path& file);

}  // namespace ptb
