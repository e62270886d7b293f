#include "core/integrator/placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ptb {

namespace {

constexpr double rounding = 0x1p-24;  ///< of a number in single precision, at most, as a share of it

/// A sphere from a point that may become the origin. All lengths.
struct Seen {
    double distance;  ///< of the centre
    double radius;
    double reach;  ///< rays that matter start so far from the origin: at the camera, and around the sphere
};

/// What the gap's terms, as kernels/scene/hit.h has them, do to a distance.
double gap_error(const Seen& s) {
    const double k = (s.distance - s.radius) * (s.distance + s.radius);
    return rounding * (s.reach * (2 * s.distance + s.reach) + std::abs(k)) / (2 * s.radius);
}

/// Bounds of a distance's error in each form.
double error_of(Form form, const Seen& s) {
    switch (form) {
        case Form::plain:
            return gap_error(s) + rounding * (s.distance + s.radius);
        case Form::vast:
            return gap_error(s) + rounding * s.reach;
        case Form::distant:
            break;
    }
    return 2 * rounding * (s.distance + s.radius + s.reach);
}

Form best_form(const Seen& s, double bearable) {
    if (error_of(Form::plain, s) <= bearable) return Form::plain;
    return error_of(Form::vast, s) <= error_of(Form::distant, s) ? Form::vast : Form::distant;
}

/// From a point to the surface.
double clearance(const Sphere& sphere, const Vec3& point) {
    return std::abs(length(sphere.centre - point) - sphere.radius);
}

/// The smallest ball, or how near the camera is to a surface.
double finest_detail(const Scene& scene) {
    double finest = std::numeric_limits<double>::infinity();
    for (const Sphere& sphere : scene.spheres)
        finest = std::min({finest, sphere.radius, clearance(sphere, scene.camera.position)});
    return finest;
}

Seen seen_by(const Scene& scene, const Sphere& sphere, const Vec3& origin) {
    // Not at other spheres: from where it looks small, it is hit as rarely as it is met with large errors.
    return {length(sphere.centre - origin), sphere.radius,
            std::max(length(scene.camera.position - origin), clearance(sphere, origin))};
}

/// Around all meshes, along the axes.
struct Bounds {
    Vec3 low, high;

    Vec3 middle() const { return (low + high) * 0.5; }
    /// Of its farthest corner.
    double reach_from(const Vec3& origin) const {
        const Vec3 half = (high - low) * 0.5, to = middle() - origin;
        return length({std::abs(to.x) + half.x, std::abs(to.y) + half.y, std::abs(to.z) + half.z});
    }
};

std::optional<Bounds> bounds_of_meshes(const Scene& scene) {
    std::optional<Bounds> bounds;
    for (const Mesh& mesh : scene.meshes)
        for (const Vec3& v : mesh.vertices) {
            if (!bounds) bounds = Bounds{v, v};
            Vec3 &low = bounds->low, &high = bounds->high;
            low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
            high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
        }
    return bounds;
}

/// So many times as far from the origin as they are large, corners of meshes round to other shapes.
constexpr double bearable_reach = 16;

struct Candidate {
    Placement placement;
    double error = 0;  ///< sum over the spheres, each in its form, and the meshes
    bool all_plain = true;
};

Candidate candidate_at(const Scene& scene, const std::optional<Bounds>& meshes, const Vec3& origin,
                       double detail) {
    Candidate result{{origin, {}, 0, std::nullopt}, 0};
    if (meshes) {
        const double reach = meshes->reach_from(origin);
        result.error = rounding * reach;
        result.all_plain = reach <= bearable_reach * length(meshes->high - meshes->low);
    }
    Placement& placement = result.placement;
    for (const Sphere& sphere : scene.spheres) {
        const Seen seen = seen_by(scene, sphere, origin);
        const Form form = best_form(seen, bearable_error * detail);
        const double error = error_of(form, seen);
        result.error += error;
        if (form == Form::plain) placement.plain_error = std::max(placement.plain_error, error / detail);
        if (error > sphere.radius / 2 && !placement.lost) placement.lost = placement.forms.size();
        placement.forms.push_back(form);
        result.all_plain &= form == Form::plain;
    }
    return result;
}

/// The point that has the least sum of (distance / radius)^2, which is what small spheres' errors grow with.
Vec3 middle(const Scene& scene) {
    Vec3 sum;
    double weights = 0;
    for (const Sphere& sphere : scene.spheres) {
        const double weight = 1 / (sphere.radius * sphere.radius);
        sum = sum + weight * (sphere.centre - scene.camera.position);
        weights += weight;
    }
    return scene.camera.position + sum * (1 / weights);
}

/// What may serve beside the file's own.
std::vector<Vec3> origins(const Scene& scene, const std::optional<Bounds>& meshes) {
    std::vector<Vec3> found{scene.camera.position};
    if (!scene.spheres.empty()) found.push_back(middle(scene));
    if (meshes) found.push_back(meshes->middle());
    return found;
}

}  // namespace

Placement place(const Scene& scene) {
    const double detail = finest_detail(scene);
    const std::optional<Bounds> meshes = bounds_of_meshes(scene);
    Candidate best = candidate_at(scene, meshes, {}, detail);
    if (best.all_plain) return best.placement;
    for (const Vec3& origin : origins(scene, meshes)) {
        Candidate other = candidate_at(scene, meshes, origin, detail);
        if (other.error < best.error) best = std::move(other);
    }
    return best.placement;
}

Scene spheres_seen_from(const Scene& all, const Vec3& origin) {
    Scene scene{all.name, all.camera, all.materials, all.spheres, {}, {}};
    scene.camera.position = scene.camera.position - origin;
    scene.camera.look_at = scene.camera.look_at - origin;
    for (Sphere& sphere : scene.spheres) sphere.centre = sphere.centre - origin;
    return scene;
}

}  // namespace ptb
