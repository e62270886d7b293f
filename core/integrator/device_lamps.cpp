#include "core/integrator/device_lamps.h"

#include <limits>

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

/// Stands for the only lamp where there is none: no path meets it, and it is too small to be asked.
SceneLamp no_lamp() {
    SceneLamp row{};
    row.face = std::numeric_limits<std::uint32_t>::max();
    row.near_squared = std::numeric_limits<float>::infinity();
    return row;
}

}  // namespace

void add_lamps(DeviceScene& device, const Scene& file_scene) {
    const Scene scene = seen_from(file_scene, device.origin);
    const std::vector<Lamp> lamps = lamps_of(scene);
    std::vector<double> powers;
    for (const Lamp& lamp : lamps) powers.push_back(lamp.power);
    const AliasTable choice = make_alias_table(powers);
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const auto number = static_cast<std::size_t>(lamps[i].sphere);
        const Sphere& sphere = scene.spheres[number];
        SceneLamp row =
            device_lamp(lamps[i], sphere, scene.materials[static_cast<std::size_t>(sphere.material)]);
        row.radiance_kept.w = static_cast<float>(choice.probability[i]);
        row.alias = static_cast<std::uint32_t>(choice.alias[i]);
        row.chance = static_cast<float>(choice.pdf[i]);
        row.cap_density = static_cast<float>(choice.pdf[i] / lamps[i].area);
        row.face = device.outer_faces[number];
        device.surfaces[row.face].radiance.w = static_cast<float>(i + 1);
        device.lamps.push_back(row);
    }
    device.lone_lamp = device.lamps.empty() ? no_lamp() : device.lamps.front();
}

}  // namespace ptb
