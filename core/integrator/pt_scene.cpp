#include "core/integrator/pt_scene.h"

#include <bit>
#include <limits>

#include "core/integrator/camera.h"

namespace ptb {

namespace {

bool camera_inside(const Scene& scene, const Sphere& sphere) {
    return length(scene.camera.position - sphere.centre) < sphere.radius;
}

PtSphere device_sphere(const Sphere& sphere) {
    return {device_vector(sphere.centre, dot(sphere.centre, sphere.centre) - sphere.radius * sphere.radius)};
}

float camera_gap(const Scene& scene, const Sphere& sphere) {
    const Vec3 to_centre = sphere.centre - scene.camera.position;
    return static_cast<float>(sphere.radius * sphere.radius - dot(to_centre, to_centre));
}

/// The bit for a side's number.
float side_bit(float number) {
    const auto side = std::bit_cast<std::uint32_t>(number);
    return std::bit_cast<float>(side == PT_OPAQUE_SIDE ? 0u : 0x80000000u >> side);
}

PtSurface device_surface(const Sphere& sphere, const Material& material, std::uint32_t side) {
    const bool mirror = material.type == MaterialType::mirror;
    const bool dielectric = material.type == MaterialType::dielectric;
    const Vec3 weight = dielectric || !material.scatters ? Vec3{1, 1, 1}
                        : mirror                         ? material.reflectance
                                                         : material.albedo;
    const double ior = dielectric ? material.ior : std::numeric_limits<double>::quiet_NaN();
    const float kind = !material.scatters ? -1.0f : mirror || dielectric ? 1.0f : 0.0f;
    return {device_vector(sphere.centre, 1 / sphere.radius),
            device_vector(weight, ior),
            device_vector(material.radiance),
            {kind, static_cast<float>(1 / ior), 0, std::bit_cast<float>(side)},
            {}};
}

PtSurface background() {
    PtSurface surface{};
    surface.traits = {-1, 0, 0, std::bit_cast<float>(PT_OPAQUE_SIDE)};
    return surface;
}

}  // namespace

PtScene make_pt_scene(const Scene& scene) {
    PtScene result;
    const auto add = [&](const Sphere& sphere, const Material& material, bool two_sided) {
        if (const std::size_t i = result.spheres.size(); i < PT_FEW_MOST) {
            result.few.sphere[i] = device_sphere(sphere);
            result.few.camera_gap[i] = camera_gap(scene, sphere);
        }
        result.spheres.push_back(device_sphere(sphere));
        result.surfaces.push_back(
            device_surface(sphere, material, two_sided ? result.two_sided : PT_OPAQUE_SIDE));
    };
    for (const bool two_sided : {false, true}) {
        for (const Sphere& sphere : scene.spheres) {
            const Material& material = scene.materials[static_cast<std::size_t>(sphere.material)];
            const bool inside = camera_inside(scene, sphere);
            if ((inside || material.type == MaterialType::dielectric) != two_sided) continue;
            add(sphere, material, two_sided);
            if (!two_sided) {
                ++result.opaque;
                continue;
            }
            result.camera_sides.resize(result.two_sided / 32 + 1);
            result.camera_sides.back() |= (inside ? 0x80000000u : 0u) >> (result.two_sided % 32);
            ++result.two_sided;
        }
    }
    result.surfaces.push_back(background());
    if (result.camera_sides.empty()) result.camera_sides.push_back(0);
    if (result.camera_sides.size() == 1)
        for (PtSurface& surface : result.surfaces) surface.traits.w = side_bit(surface.traits.w);
    return result;
}

}  // namespace ptb
