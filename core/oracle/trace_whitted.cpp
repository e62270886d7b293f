#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/oracle/path.h"

namespace ptb {
namespace {

/// A lamp as a point.
struct LampPoint {
    Surface lamp;
    Vec3 position;
    Vec3 intensity;            ///< radiant, in every direction that it lights, or along a flat lamp's normal
    std::optional<Vec3> axis;  ///< of a sunk lamp, which lights the half space before it alone
    std::optional<Vec3> normal;  ///< of a flat lamp, which lights both half spaces by the cosine
};

/// The part of a sphere on one side of a plane: its height along a unit axis, which points to its middle.
struct Cap {
    double height = 0;
    Vec3 axis;
};

/// What an opaque sphere leaves of a lamp: the cap outside of it, or inside of it if the camera is there.
Cap cap_beside(const Sphere& lamp, const Sphere& other, bool camera_inside) {
    const Vec3 away = lamp.centre - other.centre;
    const double apart = length(away), a = lamp.radius, r = other.radius;
    if (apart == 0) return {(a > r) != camera_inside ? 2 * a : 0, {}};
    // The spheres cut each other in a plane that is this far from the lamp's centre, toward the other's.
    const double to_plane = (apart * apart + a * a - r * r) / (2 * apart);
    const double outside = std::clamp(a + to_plane, 0.0, 2 * a);
    if (camera_inside) return {2 * a - outside, away * (-1 / apart)};
    return {outside, away * (1 / apart)};
}

/// What is left of a lamp by the opaque sphere that hides most of it.
Cap smallest_cap(const Scene& scene, std::size_t lamp, const InsideSet& around_camera) {
    Cap smallest = {2 * scene.spheres[lamp].radius, {}};
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
        const Material& material = scene.materials[static_cast<std::size_t>(scene.spheres[i].material)];
        if (i == lamp || material.type == MaterialType::dielectric) continue;
        const Cap cap = cap_beside(scene.spheres[lamp], scene.spheres[i], around_camera[i]);
        if (cap.height < smallest.height) smallest = cap;
    }
    return smallest;
}

/// The lamp's whole power from one point: of a free lamp from its centre in all directions, of a sunk one
/// from the middle of the cap that shows into the hemisphere around its axis.
LampPoint as_point(const Sphere& lamp, int number, const Vec3& radiance, const Cap& shown) {
    const double a = lamp.radius, area = 2 * std::numbers::pi * a * shown.height;
    if (shown.height == 2 * a) return {{number, -1}, lamp.centre, radiance * (area / 4), {}, {}};
    return {{number, -1}, lamp.centre + shown.axis * a, radiance * (area / 2), shown.axis, {}};
}

/// Each triangle that glows.
void add_flat_lamps(const Scene& scene, std::vector<LampPoint>& points) {
    int number = 0;
    for (const Facet& facet : facets_of(scene)) {
        const int i = number++;
        const Vec3& radiance = scene.materials[static_cast<std::size_t>(facet.material)].radiance;
        if (radiance == Vec3{}) continue;
        points.push_back({{-1, i}, facet.centroid(), radiance * facet.area(), {}, facet.normal});
    }
}

/// Lamps that the camera is in are seen from there, and light nothing.
std::vector<LampPoint> lamp_points(const Scene& scene) {
    const InsideSet around_camera = spheres_around(scene, scene.camera.position);
    std::vector<LampPoint> points;
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
        const Sphere& sphere = scene.spheres[i];
        const Vec3& radiance = scene.materials[static_cast<std::size_t>(sphere.material)].radiance;
        if (radiance == Vec3{} || around_camera[i]) continue;
        points.push_back(
            as_point(sphere, static_cast<int>(i), radiance, smallest_cap(scene, i, around_camera)));
    }
    add_flat_lamps(scene, points);
    return points;
}

/// What the path's matte surface sends on of a lamp's light.
Vec3 lit_by(const LampPoint& lamp, const Path& path) {
    const Vec3 way = lamp.position - path.position();
    const double cos_in = dot(normalized(way), path.normal());
    const bool behind = lamp.axis && dot(way, *lamp.axis) >= 0;
    if (cos_in <= 0 || behind || !path.sees(lamp.position, lamp.lamp)) return {};
    const double cos_out = lamp.normal ? std::abs(dot(normalized(way), *lamp.normal)) : 1;
    return path.throughput() * path.material().albedo * lamp.intensity *
           (cos_in * cos_out / (std::numbers::pi * dot(way, way)));
}

}  // namespace

OracleResult trace_whitted(const Scene& scene, const OracleJob& job) {
    const std::vector<LampPoint> lamps = lamp_points(scene);
    return sample_paths(scene, job, [&](Path& path) {
        PathSample sample;
        if (!reach_matte(path, job.path_length, sample) || sample.segments == job.path_length) return sample;
        for (const LampPoint& lamp : lamps) sample.radiance = sample.radiance + lit_by(lamp, path);
        return sample;
    });
}

}  // namespace ptb
