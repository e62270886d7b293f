#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/oracle/camera_frame.h"
#include "core/oracle/oracle.h"
#include "core/oracle/pixel_tally.h"
#include "core/oracle/random.h"

namespace ptb {
namespace {

struct Ray {
    Vec3 origin, direction;  ///< the camera's and refracted directions are not of unit length
};

struct Hit {
    double t = 1e37;  ///< in lengths of the ray's direction; this is also the largest that counts
    const Sphere* sphere = nullptr;
};

/// Nearest hit in (0.001, 1e37); of each sphere only the nearer root, so from inside a sphere is not seen.
Hit nearest_hit(const Scene& scene, const Ray& ray) {
    Hit best;
    const double a = dot(ray.direction, ray.direction);
    for (const Sphere& sphere : scene.spheres) {
        const Vec3 from_centre = ray.origin - sphere.centre;
        const double b = dot(from_centre, ray.direction);
        const double c = dot(from_centre, from_centre) - sphere.radius * sphere.radius;
        const double discriminant = b * b - a * c;
        if (discriminant < 0) continue;
        const double t = (-b - std::sqrt(discriminant)) / a;
        if (t > 0.001 && t < best.t) best = {t, &sphere};
    }
    return best;
}

/// A point of the cube [-1, 1]^3, normalised and turned to the normal's side: neither uniform nor Lambert.
Vec3 cube_direction(const Vec3& normal, ParkMiller& random) {
    Vec3 point;
    point.x = 2 * random.uniform() - 1;
    point.y = 2 * random.uniform() - 1;
    point.z = 2 * random.uniform() - 1;
    const Vec3 direction = normalized(point);
    return dot(direction, normal) < 0 ? -direction : direction;
}

Vec3 reflected(const Vec3& direction, const Vec3& normal) {
    return direction - normal * (2 * dot(direction, normal));
}

/// The thesis' glass: directions are not normalised, and the refracted one is taken with the probability of
/// reflection. See "An Inexpensive BRDF Model for Physically-based Rendering", by Schlick, for the formula.
Vec3 glass_direction(const Vec3& direction, const Vec3& normal, double ior, ParkMiller& random) {
    const bool entering = dot(direction, normal) < 0;
    const Vec3 facing = entering ? normal : -normal;
    const double eta = entering ? 1 / ior : ior;
    const double cos_in = -dot(direction, facing);
    const double k = 1 - eta * eta * (1 - cos_in * cos_in);
    if (k < 0) return reflected(direction, facing);
    const double r0 = std::pow((1 - ior) / (1 + ior), 2);
    const double reflectance = r0 + (1 - r0) * std::pow(1 - cos_in, 5);
    if (random.uniform() < reflectance) return direction * eta + facing * (eta * cos_in - std::sqrt(k));
    return reflected(direction, facing);
}

/// Sends the ray on from a hit; returns what its throughput is multiplied with.
Vec3 scatter(const Hit& hit, const Material& material, Ray& ray, ParkMiller& random) {
    ray.origin = ray.origin + ray.direction * hit.t;
    const Vec3 normal = (ray.origin - hit.sphere->centre) * (1 / hit.sphere->radius);
    switch (material.type) {
        case MaterialType::mirror:
            ray.direction = reflected(ray.direction, normal);
            return material.reflectance;
        case MaterialType::dielectric:
            ray.direction = glass_direction(ray.direction, normal, material.ior, random);
            return {1, 1, 1};
        default:
            ray.direction = cube_direction(normal, random);
            return material.albedo;
    }
}

/// Black unless the path reaches an emitter that ends it.
PathSample trace_path(const Scene& scene, Ray ray, int path_length, ParkMiller& random) {
    Vec3 throughput = {1, 1, 1}, radiance;
    for (int segments = 1; segments <= path_length; ++segments) {
        const Hit hit = nearest_hit(scene, ray);
        if (hit.sphere == nullptr) return {{}, segments};
        const Material& material = scene.materials[static_cast<std::size_t>(hit.sphere->material)];
        radiance = radiance + throughput * material.radiance;
        if (!material.scatters) return {radiance, segments};
        throughput = throughput * scatter(hit, material, ray, random);
    }
    return {{}, path_length};
}

}  // namespace

OracleResult trace_thesis(const Scene& scene, const OracleJob& job) {
    if (!scene.meshes.empty()) throw std::invalid_argument("trace_thesis sees spheres alone");
    const CameraFrame camera(scene.camera, job.size);
    return sample_pixels(job, [&](int x, int y) {
        const auto pixel = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(job.size.width) +
                           static_cast<std::uint64_t>(x);
        ParkMiller random(pixel_seed(job.seed, pixel));
        PixelTally tally;
        for (int i = 0; i < job.spp; ++i) {
            const double u = (x + random.uniform()) / job.size.width;
            const double v = (y + random.uniform()) / job.size.height;
            const Ray ray = {scene.camera.position, camera.toward(u, v)};
            tally.add(trace_path(scene, ray, job.path_length, random), job.path_length);
        }
        return tally;
    });
}

}  // namespace ptb
