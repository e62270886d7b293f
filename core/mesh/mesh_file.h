#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "core/mesh/geometry.h"

namespace ptb {

struct MeshFile {
    Geometry geometry;
    std::uint64_t points_and_lines = 0;  ///< which are left out
};

struct MeshFileOptions {
    std::uint64_t most_triangles = 20'000'000;
    std::function<void(double done)> on_progress = {};  ///< a share, from 0 to 1
};

/// A mesh's file, and those of glTF's buffers beside it. Throws UsageError.
std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& file);

/// Bytes of memory that a file takes to read, as far as its size tells; 0 where there is no such file.
std::uint64_t mesh_file_memory(const std::filesystem::path& file);

/// The triangles of an OBJ, PLY, STL, glTF or GLB file, polygons cut into triangles. Throws UsageError
/// "cannot read bunny.obj: why", one line.
MeshFile read_mesh_file(const std::filesystem::path& file, const MeshFileOptions& options = {});

}  // namespace ptb
