#include "core/integrator/device_scene.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

#include "core/integrator/camera.h"

namespace ptb {

namespace {

bool camera_inside(const Scene& scene, const Sphere& sphere) {
    return length(scene.camera.position - sphere.centre) < sphere.radius;
}

SceneSphere device_sphere(const Sphere& sphere) {
    return {device_vector(sphere.centre, dot(sphere.centre, sphere.centre) - sphere.radius * sphere.radius)};
}

float camera_gap(const Scene& scene, const Sphere& sphere) {
    const Vec3 to_centre = sphere.centre - scene.camera.position;
    return static_cast<float>(sphere.radius * sphere.radius - dot(to_centre, to_centre));
}

/// `inside`: its inner face.
SceneSurface face(const Sphere& sphere, const Material& material, bool inside) {
    const bool mirror = material.type == MaterialType::mirror;
    const bool dielectric = material.type == MaterialType::dielectric;
    const Vec3 weight = dielectric || !material.scatters ? Vec3{1, 1, 1}
                        : mirror                         ? material.reflectance
                                                         : material.albedo;
    const double outwards = (inside ? -1 : 1) / sphere.radius;
    const double eta = !dielectric ? std::numeric_limits<double>::quiet_NaN()
                       : inside    ? material.ior
                                   : 1 / material.ior;
    const double mirrored = !material.scatters ? -1 : mirror || dielectric ? 2 * outwards * outwards : 0;
    return {device_vector(sphere.centre, mirrored == 0 ? outwards : 0),
            device_vector(weight, eta * eta),
            device_vector(material.radiance),
            {static_cast<float>(mirrored), static_cast<float>(outwards * eta),
             static_cast<float>(outwards / eta), static_cast<float>(1 - eta * eta)},
            {}};
}

SceneSurface background() {
    const float nothing = std::numeric_limits<float>::quiet_NaN();
    SceneSurface surface{};
    surface.weight_eta.w = surface.traits.w = nothing;
    surface.traits.x = -1;
    return surface;
}

SceneStart start(const Scene& scene, const std::vector<Sphere>& spheres, std::uint32_t side) {
    SceneStart result{};
    const ptb_float4 position = device_vector(scene.camera.position);
    result.position_side = {position.x, position.y, position.z, std::bit_cast<float>(side)};
    for (std::size_t i = 0; i < std::min<std::size_t>(spheres.size(), SCENE_FEW_MOST); ++i)
        result.gap[i] = camera_gap(scene, spheres[i]);
    result.distance_mask = SCENE_DISTANCE_MASK;
    return result;
}

void note_zeros(const ptb_float4& centre, std::size_t i, std::array<std::uint32_t, 3>& zeros) {
    const float coordinates[3] = {centre.x, centre.y, centre.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (coordinates[axis] == 0) zeros[axis] |= 1u << i;
}

bool is_two_sided(const Scene& scene, const Sphere& sphere) {
    return scene.materials[static_cast<std::size_t>(sphere.material)].type == MaterialType::dielectric ||
           camera_inside(scene, sphere);
}

}  // namespace

DeviceScene make_device_scene(const Scene& scene) {
    DeviceScene result;
    std::vector<SceneSurface> opaque;
    std::vector<std::size_t> order(scene.spheres.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto first_two_sided = std::stable_partition(
        order.begin(), order.end(), [&](std::size_t i) { return !is_two_sided(scene, scene.spheres[i]); });
    std::vector<Sphere> spheres;
    for (const std::size_t i : order) spheres.push_back(scene.spheres[i]);
    result.opaque = static_cast<std::uint32_t>(first_two_sided - order.begin());
    result.two_sided = static_cast<std::uint32_t>(spheres.size()) - result.opaque;
    result.outer_faces.resize(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i)
        result.outer_faces[order[i]] = i < result.opaque ? 2 * result.two_sided + i : 2 * (i - result.opaque);
    const bool one_is_two_sided = result.two_sided == 1 && result.is_few();
    result.camera_sides.resize(std::max(1u, (result.two_sided + 31) / 32));
    for (std::uint32_t i = 0; i < spheres.size(); ++i) {
        const Sphere& sphere = spheres[i];
        result.spheres.push_back(device_sphere(sphere));
        if (i < SCENE_FEW_MOST) {
            result.few.sphere[i] = result.spheres.back();
            note_zeros(result.spheres.back().centre_k, i, result.zeros);
        }
        const Material& material = scene.materials[static_cast<std::size_t>(sphere.material)];
        if (i < result.opaque) {
            opaque.push_back(face(sphere, material, false));
            continue;
        }
        result.surfaces.push_back(face(sphere, material, false));
        result.surfaces.push_back(face(sphere, material, true));
        const std::uint32_t number = i - result.opaque;
        const std::uint32_t bit = one_is_two_sided ? SCENE_LONE_SIDE : 0x80000000u >> number % 32;
        if (camera_inside(scene, sphere)) result.camera_sides[number / 32] |= bit;
    }
    result.surfaces.insert(result.surfaces.end(), opaque.begin(), opaque.end());
    result.surfaces.push_back(background());
    result.surfaces.push_back(std::bit_cast<SceneSurface>(start(scene, spheres, result.camera_sides.front())));
    return result;
}

}  // namespace ptb
