#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/scene/vec3.h"
#include "core/tree/shelf.h"

namespace ptb {

enum class MaterialType { matte, mirror, dielectric, emitter };

/// One material of a scene. Colours are linear RGB; what a type does not use stays zero.
struct Material {
    std::string name;
    MaterialType type = MaterialType::matte;
    Vec3 albedo;           ///< matte; an emitter with an albedo also scatters like matte
    Vec3 radiance;         ///< emitter, from both faces
    Vec3 reflectance;      ///< mirror
    double ior = 1;        ///< dielectric: index of refraction inside, vacuum outside
    bool scatters = true;  ///< false for an emitter without an albedo: the path ends there
};

struct Sphere {
    Vec3 centre;
    double radius = 1;
    int material = 0;  ///< index into Scene::materials
};

/// Perspective camera. `fov_deg` is the full angle across the image's width, pixels are square, rows run from
/// the top, and the image's right is view x up (looking along +z with y up, +x lies on the left).
struct Camera {
    Vec3 position, look_at, up;
    double fov_deg = 40;
};

/// A scene as its file states it: spheres and meshes in the file's order, lengths in scene units.
struct Scene {
    std::string name;
    Camera camera;
    std::vector<Material> materials;
    std::vector<Sphere> spheres;
    std::vector<Mesh> meshes = {};
    std::shared_ptr<TreeShelf> trees = std::make_shared<TreeShelf>();  ///< of the meshes; copies share them
    std::string content = {};  ///< `scene_hash` of its file; empty where it comes from none
};

/// Of all meshes; they are numbered through, mesh by mesh.
std::size_t triangle_count(const Scene& scene);

/// How the meshes of a scene are read.
struct MeshReading {
    std::filesystem::path folder = {};          ///< files are relative to it
    std::uint64_t most_triangles = 20'000'000;  ///< of a scene
    /// Before a mesh's file is read, and while it is: its name, bytes of memory that this takes, the share
    /// that is done.
    std::function<void(const std::string& name, std::uint64_t memory_bytes, double done)> on_file = {};
};

/// Reads a scene from JSON text; `origin` names it in errors. Unknown keys are errors. Throws UsageError.
Scene parse_scene(std::string_view json_text, const std::string& origin, const MeshReading& reading = {});

/// Reads a scene file, and the files of its meshes, which are relative to its folder. Throws UsageError, also
/// when one cannot be read.
Scene load_scene(const std::filesystem::path& file, MeshReading reading = {});

}  // namespace ptb
