#include "core/integrator/device_meshes.h"

#include <algorithm>
#include <bit>
#include <thread>

#include "core/integrator/camera.h"
#include "core/integrator/large_buffer.h"

namespace ptb {

namespace {

/// A corner in the device's coordinates, rounded once.
std::array<float, 3> device_corner(const Vec3& corner, const Vec3& origin) {
    const ptb_float4 seen = device_vector(corner - origin);
    return {seen.x, seen.y, seen.z};
}

/// Outwards, of length 1. Edges are scaled, so that no unit of length makes it vanish.
Vec3 normal_of(const Mesh& mesh, const Face& face) {
    const Vec3& corner = mesh.vertices[face[0]];
    return normalized(
        cross(normalized(mesh.vertices[face[1]] - corner), normalized(mesh.vertices[face[2]] - corner)));
}

std::vector<SceneTriangle> scene_triangles(const Scene& scene, std::uint32_t first_face) {
    std::vector<SceneTriangle> triangles;
    triangles.reserve(triangle_count(scene));
    for (const Mesh& mesh : scene.meshes) {
        const std::uint32_t outer = first_face + 2 * static_cast<std::uint32_t>(mesh.material);
        for (const Face& face : mesh.faces) {
            ptb_float4 normal = device_vector(normal_of(mesh, face));
            normal.w = std::bit_cast<float>(outer);
            triangles.push_back({normal});
        }
    }
    return triangles;
}

/// The largest coordinate of where rays begin that begin on no triangle.
float farthest_start(const Scene& scene, const Vec3& origin) {
    double most = largest_coordinate(scene.camera.position - origin);
    for (const Sphere& sphere : scene.spheres)
        most = std::max(most, largest_coordinate(sphere.centre - origin) + sphere.radius);
    return static_cast<float>(most);
}

bool refracts(const Scene& scene) {
    return std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) {
        return scene.materials[static_cast<std::size_t>(mesh.material)].type == MaterialType::dielectric;
    });
}

}  // namespace

std::uint64_t DeviceMeshes::node_bytes() const { return tree ? tree->nodes().size() : 0; }

std::uint64_t DeviceMeshes::leaf_bytes() const { return tree ? tree->leaf_rows().size() : 0; }

std::vector<Triangle> device_triangles(const Scene& scene, const Vec3& origin) {
    std::vector<Triangle> triangles;
    triangles.reserve(triangle_count(scene));
    for (const Mesh& mesh : scene.meshes)
        for (const auto& [a, b, c] : mesh.faces)
            triangles.push_back(
                {{device_corner(mesh.vertices[a], origin), device_corner(mesh.vertices[b], origin),
                  device_corner(mesh.vertices[c], origin)}});
    return triangles;
}

std::vector<cl::Buffer> tree_buffers(const ocl::Device& device, const Tree& tree) {
    return {large_buffer(device, tree.nodes()), large_buffer(device, tree.leaf_rows())};
}

std::shared_ptr<const Tree> mesh_tree(const Scene& scene, const Vec3& origin, TreeLayout layout,
                                      TreeSettings settings) {
    settings.origin_most = farthest_start(scene, origin);
    const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    return scene.trees->tree(device_triangles(scene, origin), layout, settings, threads);
}

void add_meshes(DeviceScene& device, const Scene& scene, TreeLayout layout, const TreeSettings& settings) {
    if (!device.has_meshes) return;
    device.meshes.tree = mesh_tree(scene, device.origin, layout, settings);
    device.meshes.triangles = scene_triangles(scene, device.mesh_faces);
    device.meshes.refract = refracts(scene);
}

}  // namespace ptb
