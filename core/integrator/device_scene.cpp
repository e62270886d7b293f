#include "core/integrator/device_scene.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "core/integrator/camera.h"
#include "core/integrator/placement.h"

namespace ptb {

namespace {

bool camera_inside(const Scene& scene, const Sphere& sphere) {
    return length(scene.camera.position - sphere.centre) < sphere.radius;
}

SceneSphere device_sphere(const Sphere& sphere, Form form) {
    const double radius_squared = sphere.radius * sphere.radius;
    return {device_vector(sphere.centre, form == Form::distant
                                             ? radius_squared
                                             : dot(sphere.centre, sphere.centre) - radius_squared)};
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

void note_zeros(const ptb_float4& centre, std::size_t i, std::array<std::uint32_t, 3>& zeros) {
    const float coordinates[3] = {centre.x, centre.y, centre.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (coordinates[axis] == 0) zeros[axis] |= 1u << i;
}

bool is_two_sided(const Scene& scene, const Sphere& sphere) {
    return scene.materials[static_cast<std::size_t>(sphere.material)].type == MaterialType::dielectric ||
           camera_inside(scene, sphere);
}

/// A sphere of the scene, and where it belongs in the device's order.
struct Placed {
    Sphere sphere;
    std::size_t number;  ///< in the scene
    Form form;
    bool two_sided;

    /// Opaque ones first; careful ones in the middle, and distant ones in the middle of these.
    int rank() const {
        const int care = form == Form::distant ? 2 : form == Form::vast ? 1 : 0;
        return two_sided ? 5 - care : care;
    }
};

std::vector<Placed> placed_spheres(const Scene& scene, const std::vector<Form>& forms) {
    std::vector<Placed> placed;
    for (std::size_t i = 0; i < scene.spheres.size(); ++i)
        placed.push_back({scene.spheres[i], i, forms[i], is_two_sided(scene, scene.spheres[i])});
    std::stable_sort(placed.begin(), placed.end(),
                     [](const Placed& a, const Placed& b) { return a.rank() < b.rank(); });
    return placed;
}

SceneStart start(const Scene& scene, const std::vector<Placed>& placed, std::uint32_t side) {
    SceneStart result{};
    const ptb_float4 position = device_vector(scene.camera.position);
    result.position_side = {position.x, position.y, position.z, std::bit_cast<float>(side)};
    for (std::size_t i = 0; i < std::min<std::size_t>(placed.size(), SCENE_FEW_MOST); ++i)
        result.gap[i] = camera_gap(scene, placed[i].sphere);
    result.distance_mask = SCENE_DISTANCE_MASK;
    return result;
}

/// Spheres whose rank is within these.
DeviceScene::Numbers numbers_of(const std::vector<Placed>& placed, int first_rank, int last_rank) {
    const auto below = [&](int rank) {
        return static_cast<std::uint32_t>(
            std::partition_point(placed.begin(), placed.end(),
                                 [&](const Placed& each) { return each.rank() < rank; }) -
            placed.begin());
    };
    return {below(first_rank), below(last_rank + 1)};
}

}  // namespace

DeviceScene make_device_scene(const Scene& file_scene) {
    const Placement placement = place(file_scene);
    const Scene scene = spheres_seen_from(file_scene, placement.origin);
    const std::vector<Placed> placed = placed_spheres(scene, placement.forms);
    DeviceScene result;
    result.careful = numbers_of(placed, 1, 4);
    result.distant = numbers_of(placed, 2, 3);
    result.opaque = numbers_of(placed, 0, 2).end;
    result.two_sided = static_cast<std::uint32_t>(placed.size()) - result.opaque;
    result.plain_error = placement.plain_error;
    result.has_meshes = !file_scene.meshes.empty();
    result.origin = placement.origin;
    result.outer_faces.resize(placed.size());
    for (std::uint32_t i = 0; i < placed.size(); ++i)
        result.outer_faces[placed[i].number] =
            i < result.opaque ? 2 * result.two_sided + i : 2 * (i - result.opaque);
    std::vector<SceneSurface> opaque;
    const bool one_is_two_sided = result.two_sided == 1 && result.is_few();
    result.camera_sides.resize(std::max(1u, (result.two_sided + 31) / 32));
    for (std::uint32_t i = 0; i < placed.size(); ++i) {
        const Sphere& sphere = placed[i].sphere;
        result.spheres.push_back(device_sphere(sphere, placed[i].form));
        if (i < SCENE_FEW_MOST) result.few.sphere[i] = result.spheres.back();
        if (i < SCENE_FEW_MOST && placed[i].form != Form::distant)
            note_zeros(result.spheres.back().centre_k, i, result.zeros);
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
    result.surfaces.push_back(std::bit_cast<SceneSurface>(start(scene, placed, result.camera_sides.front())));
    result.mesh_faces = static_cast<std::uint32_t>(result.surfaces.size());
    if (result.has_meshes)
        for (const Material& material : scene.materials)
            for (const bool inside : {false, true})
                result.surfaces.push_back(face(Sphere{}, material, inside));
    return result;
}

}  // namespace ptb
