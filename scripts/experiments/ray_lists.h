#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/integrator/camera.h"
#include "core/integrator/device_meshes.h"
#include "core/integrator/registry.h"
#include "tests/support/rays.h"
#include "tests/support/tree_walk.h"
#include "tests/support/triangles.h"

namespace ptb {

/// The meshes of a scene, and its camera as they see it.
struct Subject {
    Scene scene;
    std::vector<Triangle> triangles;
    Camera camera;
    double margin = 0;  ///< by which rays start above triangles

    explicit Subject(const std::string& file) : scene(load_scene(file)), camera(scene.camera) {
        const Vec3 origin = make_device_scene(scene).origin;
        triangles = device_triangles(scene, origin);
        camera.position = camera.position - origin;
        camera.look_at = camera.look_at - origin;
        for (const Triangle& triangle : triangles)
            for (const auto& corner : triangle.corners)
                for (const float x : corner)
                    margin = std::max<double>(margin, std::abs(x) * double{TRIANGLE_MARGIN});
    }
};

/// Through the middles of a picture's pixels, row by row.
inline std::vector<ListedRay> camera_rays(const Subject& subject, int edge) {
    const PtbCamera camera = device_camera(subject.camera, {edge, edge});
    const auto along = [&](float ptb_float4::*axis, int x, int y) {
        return camera.corner.*axis + (x + 0.5) * camera.step_x.*axis + (y + 0.5) * camera.step_y.*axis;
    };
    const auto& [px, py, pz, pw] = camera.position;
    std::vector<ListedRay> rays;
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x)
            rays.push_back(make_ray({px, py, pz}, {along(&ptb_float4::x, x, y), along(&ptb_float4::y, x, y),
                                                   along(&ptb_float4::z, x, y)}));
    return rays;
}

/// Diffuse rays from where these met something.
inline std::vector<ListedRay> bounced(const std::vector<ListedRay>& rays, const std::vector<ListedHit>& hits,
                                      const Subject& subject, Dice& dice) {
    std::vector<ListedRay> next;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].triangle == TREE_NOTHING) continue;
        const Triangle& triangle = subject.triangles[hits[i].triangle];
        const ptb_float4& d = rays[i].direction_reach;
        Vec3 normal = normalized(normal_of(triangle));
        if (dot(normal, {d.x, d.y, d.z}) > 0) normal = -normal;
        const double z = 2 * dice.uniform() - 1, turn = 2 * std::numbers::pi * dice.uniform();
        const double radius = std::sqrt(1 - z * z);
        const Vec3 a = to_vec3(triangle.corners[0]), b = to_vec3(triangle.corners[1]),
                   c = to_vec3(triangle.corners[2]);
        const Vec3 from = a + (b - a) * hits[i].b + (c - a) * hits[i].c + normal * subject.margin;
        const Vec3 to = normal + Vec3{radius * std::cos(turn), radius * std::sin(turn), z};
        next.push_back(make_ray({from.x, from.y, from.z}, {to.x, to.y, to.z}));
        next.back().origin_left.w = std::bit_cast<float>(hits[i].triangle);
    }
    return next;
}

inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// `pt` in the subject's scene, ready to be rendered.
inline std::unique_ptr<Render> path_tracer(const ocl::Device& device, const Subject& subject,
                                           const RenderJob& job, const std::string& kernel_dir = "") {
    const Integrator& row = integrator("pt");
    const ocl::Program program =
        ocl::build(device, kernel_source(row.file(), kernel_dir), row.options(device, subject.scene, job));
    return row.make(device, program, subject.scene, job);
}

}  // namespace ptb
