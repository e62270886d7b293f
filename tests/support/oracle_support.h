#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/shapes/shapes.h"
#include "core/mesh/transform.h"
#include "core/oracle/oracle.h"
#include "core/scene/scene.h"

namespace ptb {

inline Material matte(double albedo) {
    Material material;
    material.albedo = {albedo, albedo, albedo};
    return material;
}

inline Material mirror(const Vec3& reflectance) {
    Material material;
    material.type = MaterialType::mirror;
    material.reflectance = reflectance;
    return material;
}

inline Material glass(double ior) {
    Material material;
    material.type = MaterialType::dielectric;
    material.ior = ior;
    return material;
}

/// Ends paths; one with an albedo would not.
inline Material lamp(const Vec3& radiance) {
    Material material;
    material.type = MaterialType::emitter;
    material.radiance = radiance;
    material.scatters = false;
    return material;
}

inline Material glowing_wall(const Vec3& radiance, const Vec3& albedo) {
    Material material = lamp(radiance);
    material.albedo = albedo;
    material.scatters = true;
    return material;
}

/// Camera at the origin, looking along +z through an angle so narrow that all rays are one.
inline Scene narrow_view() {
    Scene scene;
    scene.camera = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1e-4};
    return scene;
}

inline void add(Scene& scene, const Vec3& centre, double radius, const Material& material) {
    scene.spheres.push_back({centre, radius, static_cast<int>(scene.materials.size())});
    scene.materials.push_back(material);
}

/// Triangles by their corners, counter-clockwise seen from outside.
inline void add_triangles(Scene& scene, const std::vector<std::array<Vec3, 3>>& triangles,
                          const Material& material) {
    Mesh mesh;
    mesh.material = static_cast<int>(scene.materials.size());
    for (const auto& corners : triangles) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
        mesh.faces.push_back({first, first + 1, first + 2});
    }
    scene.meshes.push_back(mesh);
    scene.materials.push_back(material);
}

/// A shape of core/mesh.
inline void add_shape(Scene& scene, const std::string& name, int detail, const Transform& transform,
                      const Material& material) {
    const Placing placed(transform);
    for (const Shape& shape : shapes()) {
        if (shape.name != name) continue;
        const Geometry geometry = shape.make(detail);
        std::vector<std::array<Vec3, 3>> triangles;
        for (const Face& face : geometry.faces()) {
            const auto corner = [&](std::size_t i) { return placed(geometry.vertices()[face[i]]); };
            triangles.push_back({corner(0), corner(1), corner(2)});
        }
        return add_triangles(scene, triangles, material);
    }
    ADD_FAILURE() << "no shape " << name;
}

/// A matte floor of albedo 1/2 in the plane y = 0, all but flat, and the camera looking at its origin from
/// one side. What is added hangs over it.
inline Scene floor_view() {
    Scene scene;
    scene.camera = {{5, 10, 0}, {0, 0, 0}, {0, 1, 0}, 1e-4};
    add(scene, {0, -1e6, 0}, 1e6, matte(0.5));
    return scene;
}

inline OracleJob job(int side, int spp, int path_length) {
    OracleJob job;
    job.size = {side, side};
    job.spp = spp;
    job.path_length = path_length;
    return job;
}

/// Mean over the image and its standard error.
struct Estimate {
    double mean = 0, standard_error = 0;
};

inline Estimate estimate(const OracleResult& result, int spp, std::size_t channel = 0) {
    double sum = 0, variance = 0;
    for (std::size_t i = channel; i < result.mean.rgb.size(); i += 3) {
        sum += static_cast<double>(result.mean.rgb[i]);
        variance += static_cast<double>(result.variance.rgb[i]) / spp;
    }
    const auto pixels = static_cast<double>(result.mean.size.pixels());
    return {sum / pixels, std::sqrt(variance) / pixels};
}

/// Within four standard errors, or a hundred thousandth for scenes whose flat things are huge balls.
inline void expect_mean(const OracleResult& result, int spp, double value) {
    const Estimate found = estimate(result, spp);
    EXPECT_NEAR(found.mean, value, 4 * found.standard_error + 1e-5 * value);
}

inline void expect_every_pixel(const Image& image, const Vec3& value) {
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        EXPECT_FLOAT_EQ(image.rgb[i], static_cast<float>(value.x));
        EXPECT_FLOAT_EQ(image.rgb[i + 1], static_cast<float>(value.y));
        EXPECT_FLOAT_EQ(image.rgb[i + 2], static_cast<float>(value.z));
    }
}

}  // namespace ptb
