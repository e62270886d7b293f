#include "core/integrator/device_lamps.h"

#include <bit>
#include <limits>
#include <numbers>

#include "core/integrator/camera.h"
#include "core/integrator/placement.h"
#include "core/scene/lamps.h"

namespace ptb {

namespace {

/// Points nearer to the centre of a sunk lamp than so many radii sample the sphere as they see it, since the
/// cap's density by area is without bound there.
constexpr double near_radii = 1.5;

/// The lamps that can be chosen.
std::vector<Lamp> lamps_of(const Scene& scene) {
    std::vector<Lamp> lamps = find_lamps(scene).lamps;
    std::erase_if(lamps, [](const Lamp& lamp) { return lamp.around_camera; });
    return lamps;
}

/// All of it but its place among the others.
SceneLamp device_lamp(const Lamp& lamp, const Sphere& sphere, const Material& material) {
    const bool free = lamp.kind == LampKind::free;
    SceneLamp row{};
    row.centre_radius = device_vector(sphere.centre, sphere.radius);
    row.axis_extent = device_vector(free ? Vec3{0, 0, 1} : lamp.axis, 1 - lamp.cos_rim);
    row.radiance_kept = device_vector(material.radiance, 1);
    row.middle_sent =
        device_vector(sphere.centre + lamp.axis * (free ? 0 : sphere.radius), lamp.area / (free ? 4 : 2));
    row.near_squared = free ? std::numeric_limits<float>::infinity()
                            : static_cast<float>(near_radii * near_radii * sphere.radius * sphere.radius);
    return row;
}

/// Where triangles lie in the leaves of a tree, by their numbers: any place of those that have several.
std::vector<std::uint32_t> places_of(const DeviceMeshes& meshes) {
    std::vector<std::uint32_t> places(meshes.triangles.size());
    std::uint32_t place = 0;
    for (const TreeTriangle& triangle : meshes.tree->triangles)
        places[std::bit_cast<std::uint32_t>(triangle.a_number.w)] = place++;
    for (const TreeBlock8& block : meshes.tree->blocks)
        for (const std::uint32_t number : block.number) {
            if (number < places.size()) places[number] = place;
            ++place;
        }
    return places;
}

/// A triangle that shines to both sides, in device coordinates.
struct FlatLamp {
    std::uint32_t number;  ///< of the triangle
    Vec3 middle, normal;
    double area;
    const Material* material;

    double power() const {
        const Vec3& radiance = material->radiance;
        return 2 * area * std::numbers::pi * (radiance.x + radiance.y + radiance.z) / 3;
    }
};

std::vector<FlatLamp> flat_lamps_of(const Scene& scene, const Vec3& origin) {
    std::vector<FlatLamp> lamps;
    std::uint32_t number = 0;
    for (const Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
        const bool shines = material.radiance != Vec3{};
        for (const auto& [a, b, c] : mesh.faces) {
            if (shines) {
                const Vec3 &u = mesh.vertices[a], &v = mesh.vertices[b], &w = mesh.vertices[c];
                const Vec3 across = cross(v - u, w - u);
                lamps.push_back({number, (u + v + w) * (1.0 / 3) - origin, normalized(across),
                                 length(across) / 2, &material});
            }
            ++number;
        }
    }
    return lamps;
}

SceneLamp device_lamp(const FlatLamp& lamp, std::uint32_t place) {
    SceneLamp row{};
    row.axis_extent = device_vector(lamp.normal, 2);
    row.radiance_kept = device_vector(lamp.material->radiance, 1);
    row.middle_sent = device_vector(lamp.middle, lamp.area);
    row.face = SCENE_TRIANGLE | lamp.number;
    row.place = place;
    return row;
}

/// Stands for the only lamp where there is none: no path meets it, and it is too small to be asked.
SceneLamp no_lamp() {
    SceneLamp row{};
    row.face = std::numeric_limits<std::uint32_t>::max();
    row.near_squared = std::numeric_limits<float>::infinity();
    return row;
}

/// By which one of all is chosen: its share, and what is left to another.
void choose_by(const AliasTable& choice, std::size_t i, double area, SceneLamp& row) {
    row.radiance_kept.w = static_cast<float>(choice.probability[i]);
    row.alias = static_cast<std::uint32_t>(choice.alias[i]);
    row.chance = static_cast<float>(choice.pdf[i]);
    row.cap_density = static_cast<float>(choice.pdf[i] / area);
}

void add_flat_lamps(DeviceScene& device, const std::vector<FlatLamp>& lamps, const AliasTable& choice) {
    if (lamps.empty()) return;
    const std::vector<std::uint32_t> places = places_of(device.meshes);
    for (const FlatLamp& lamp : lamps) {
        SceneLamp row = device_lamp(lamp, places[lamp.number]);
        choose_by(choice, device.lamps.size(), lamp.area, row);
        const auto outer = std::bit_cast<std::uint32_t>(device.meshes.triangles[lamp.number].normal_face.w);
        for (const std::uint32_t face : {outer, outer + 1}) device.surfaces[face].asked.x = row.cap_density;
        device.lamps.push_back(row);
    }
}

}  // namespace

void add_lamps(DeviceScene& device, const Scene& file_scene) {
    const Scene scene = spheres_seen_from(file_scene, device.origin);
    const std::vector<Lamp> lamps = lamps_of(scene);
    const std::vector<FlatLamp> flat_lamps = flat_lamps_of(file_scene, device.origin);
    std::vector<double> powers;
    for (const Lamp& lamp : lamps) powers.push_back(lamp.power);
    for (const FlatLamp& lamp : flat_lamps) powers.push_back(lamp.power());
    const AliasTable choice = make_alias_table(powers);
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const auto number = static_cast<std::size_t>(lamps[i].sphere);
        const Sphere& sphere = scene.spheres[number];
        SceneLamp row =
            device_lamp(lamps[i], sphere, scene.materials[static_cast<std::size_t>(sphere.material)]);
        choose_by(choice, i, lamps[i].area, row);
        row.face = device.outer_faces[number];
        device.surfaces[row.face].radiance.w = static_cast<float>(i + 1);
        device.lamps.push_back(row);
    }
    add_flat_lamps(device, flat_lamps, choice);
    device.lone_lamp = device.lamps.empty() ? no_lamp() : device.lamps.front();
}

}  // namespace ptb
