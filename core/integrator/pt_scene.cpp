#include "core/integrator/pt_scene.h"

#include "core/integrator/camera.h"

namespace ptb {

namespace {

bool camera_inside(const Scene& scene, const Sphere& sphere) {
    return length(scene.camera.position - sphere.centre) < sphere.radius;
}

PtSphere device_sphere(const Sphere& sphere) {
    return {device_vector(sphere.centre, dot(sphere.centre, sphere.centre) - sphere.radius * sphere.radius)};
}

PtSurface device_surface(const Sphere& sphere, const Material& material, std::uint32_t side) {
    const bool matte = material.type == MaterialType::matte || material.type == MaterialType::emitter;
    const Vec3 weight = material.type == MaterialType::dielectric ? Vec3{1, 1, 1}
                        : material.type == MaterialType::mirror   ? material.reflectance
                                                                  : material.albedo;
    PtSurface surface{};
    surface.centre_inverse_radius = device_vector(sphere.centre, 1 / sphere.radius);
    surface.weight = device_vector(weight, material.scatters ? 0 : 1);
    surface.radiance = device_vector(material.radiance, matte ? 1 : 0);
    surface.optics.x = material.type == MaterialType::dielectric ? static_cast<float>(material.ior) : 0.0f;
    surface.optics.y = static_cast<float>(side);
    return surface;
}

}  // namespace

PtScene make_pt_scene(const Scene& scene) {
    PtScene result;
    const auto add = [&](const Sphere& sphere, const Material& material) {
        result.spheres.push_back(device_sphere(sphere));
        result.surfaces.push_back(device_surface(sphere, material, result.two_sided));
    };
    for (const bool two_sided : {false, true}) {
        for (const Sphere& sphere : scene.spheres) {
            const Material& material = scene.materials[static_cast<std::size_t>(sphere.material)];
            const bool inside = camera_inside(scene, sphere);
            if ((inside || material.type == MaterialType::dielectric) != two_sided) continue;
            add(sphere, material);
            if (!two_sided) {
                ++result.opaque;
                continue;
            }
            result.camera_sides.resize(result.two_sided / 32 + 1);
            result.camera_sides.back() |= (inside ? 1u : 0u) << (result.two_sided % 32);
            ++result.two_sided;
        }
    }
    if (result.camera_sides.empty()) result.camera_sides.push_back(0);
    return result;
}

}  // namespace ptb
