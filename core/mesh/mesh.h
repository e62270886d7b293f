#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/vec3.h"

namespace ptb {

/// Corners of a triangle, as indices into the vertices; counter-clockwise seen from outside.
using Face = std::array<std::uint32_t, 3>;

/// What a mesh had that light cannot meet, and that is therefore not in it.
struct Dropped {
    std::uint64_t triangles = 0;         ///< without an area
    std::uint64_t points_and_lines = 0;  ///< of a file
    auto operator<=>(const Dropped&) const = default;
};

/// Triangles of one material. Their normals are those of their planes. Matte ones, mirrors and emitters have
/// two equal sides; a dielectric is closed and wound outwards.
struct Mesh {
    std::string name;            ///< "bunny.obj", or "flake 3" of a shape and its detail
    int material = 0;            ///< index into Scene::materials
    std::vector<Vec3> vertices;  ///< in the world, scene units; no two are equal
    std::vector<Face> faces;     ///< each has an area
    Dropped dropped = {};
};

}  // namespace ptb
