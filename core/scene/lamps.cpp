#include "core/scene/lamps.h"

#include <numbers>

namespace ptb {
namespace {

const Material& material_of(const Scene& scene, const Sphere& sphere) {
    return scene.materials[static_cast<std::size_t>(sphere.material)];
}

bool holds_camera(const Scene& scene, const Sphere& sphere) {
    return length(scene.camera.position - sphere.centre) < sphere.radius;
}

/// A cap of a sphere: its height, from nothing to the diameter, and the unit axis to its middle.
struct Cap {
    double height = 0;
    Vec3 axis;
};

/// The cap of `lamp` outside of an opaque sphere, in factors that do not cancel when that is a huge wall.
Cap cap_outside(const Sphere& lamp, const Sphere& wall) {
    const Vec3 away = lamp.centre - wall.centre;
    const double apart = length(away), a = lamp.radius, r = wall.radius;
    if (apart + r <= a || apart - r >= a) return {2 * a, {}};
    if (apart + a <= r) return {};
    return {(apart + a - r) * (apart + a + r) / (2 * apart), away * (1 / apart)};
}

/// The cap of `lamp` inside of an opaque sphere.
Cap cap_inside(const Sphere& lamp, const Sphere& room) {
    const Vec3 toward = room.centre - lamp.centre;
    const double apart = length(toward), a = lamp.radius, r = room.radius;
    if (apart + a <= r) return {2 * a, {}};
    if (apart + r <= a || apart - r >= a) return {};
    return {(r - apart + a) * (r + apart - a) / (2 * apart), toward * (1 / apart)};
}

/// What the opaque sphere that hides most leaves of the lamp.
Cap smallest_cap(const Scene& scene, std::size_t lamp) {
    Cap smallest = {2 * scene.spheres[lamp].radius, {}};
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
        const Sphere& other = scene.spheres[i];
        if (i == lamp || material_of(scene, other).type == MaterialType::dielectric) continue;
        const Cap cap = holds_camera(scene, other) ? cap_inside(scene.spheres[lamp], other)
                                                   : cap_outside(scene.spheres[lamp], other);
        if (cap.height < smallest.height) smallest = cap;
    }
    return smallest;
}

Lamp make_lamp(const Scene& scene, std::size_t number) {
    const Sphere& sphere = scene.spheres[number];
    const Vec3& radiance = material_of(scene, sphere).radiance;
    const Cap cap = smallest_cap(scene, number);
    Lamp lamp;
    lamp.sphere = static_cast<int>(number);
    lamp.kind = cap.height < 2 * sphere.radius ? LampKind::cap : LampKind::free;
    lamp.axis = cap.axis;
    lamp.cos_rim = 1 - cap.height / sphere.radius;
    lamp.area = 2 * std::numbers::pi * sphere.radius * cap.height;
    lamp.power = lamp.area * std::numbers::pi * (radiance.x + radiance.y + radiance.z) / 3;
    lamp.around_camera = holds_camera(scene, sphere);
    return lamp;
}

}  // namespace

Lamps find_lamps(const Scene& scene) {
    Lamps found;
    std::vector<double> weights;
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
        if (material_of(scene, scene.spheres[i]).radiance == Vec3{}) continue;
        const Lamp lamp = make_lamp(scene, i);
        if (!(lamp.power > 0)) continue;
        found.lamps.push_back(lamp);
        weights.push_back(lamp.around_camera ? 0 : lamp.power);
    }
    found.choice = make_alias_table(weights);
    return found;
}

}  // namespace ptb
