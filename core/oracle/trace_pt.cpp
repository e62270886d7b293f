#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/oracle/camera_frame.h"
#include "core/oracle/oracle.h"
#include "core/oracle/pixel_tally.h"
#include "core/oracle/random.h"

namespace ptb {
namespace {

constexpr double no_hit = std::numeric_limits<double>::infinity();

/// Which spheres a path is inside of. Only transmission changes it, never a computed distance: so no
/// tolerance is needed, and rounding can neither lose a path in a wall nor let it meet the surface that it
/// just left.
using InsideSet = std::vector<bool>;

struct Ray {
    Vec3 origin, direction;  ///< direction of unit length
};

struct Hit {
    double distance = no_hit;
    int sphere = -1;
};

InsideSet spheres_around(const Scene& scene, const Vec3& point) {
    InsideSet inside;
    for (const Sphere& sphere : scene.spheres)
        inside.push_back(length(point - sphere.centre) < sphere.radius);
    return inside;
}

/// Distance to the sphere: from inside always the far root; from outside the near one, when the centre lies
/// ahead. Roots by way of the point nearest to the centre, which does not cancel for spheres much larger than
/// the scene; see "Precision Improvements for Ray/Sphere Intersection", by Haines, Günther and
/// Akenine-Möller.
double sphere_distance(const Sphere& sphere, bool inside, const Ray& ray) {
    const Vec3 to_centre = sphere.centre - ray.origin;
    const double ahead = dot(to_centre, ray.direction);
    if (!inside && ahead <= 0) return no_hit;
    const Vec3 nearest = to_centre - ray.direction * ahead;
    const double half_chord_squared = sphere.radius * sphere.radius - dot(nearest, nearest);
    if (!inside && half_chord_squared < 0) return no_hit;
    const double half_chord = std::sqrt(std::max(0.0, half_chord_squared));
    return std::max(0.0, inside ? ahead + half_chord : ahead - half_chord);
}

Hit nearest_hit(const Scene& scene, const InsideSet& inside, const Ray& ray) {
    Hit best;
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
        const double distance = sphere_distance(scene.spheres[i], inside[i], ray);
        if (distance < best.distance) best = {distance, static_cast<int>(i)};
    }
    return best;
}

/// Direction about the unit `normal` with density cos / pi over solid angle; the frame is that of "Building
/// an Orthonormal Basis, Revisited", by Duff et al.
Vec3 cosine_direction(const Vec3& normal, SplitMix64& random) {
    const double sign = std::copysign(1.0, normal.z);
    const double a = -1 / (sign + normal.z), b = normal.x * normal.y * a;
    const Vec3 tangent = {1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
    const Vec3 bitangent = {b, sign + normal.y * normal.y * a, -normal.y};
    const double sin_squared = random.uniform();
    const double phi = 2 * std::numbers::pi * random.uniform();
    const double sin_theta = std::sqrt(sin_squared);
    return normalized(tangent * (sin_theta * std::cos(phi)) + bitangent * (sin_theta * std::sin(phi)) +
                      normal * std::sqrt(1 - sin_squared));
}

Vec3 reflected(const Vec3& direction, const Vec3& normal) {
    return normalized(direction - normal * (2 * dot(direction, normal)));
}

/// Share of unpolarised light that a smooth boundary reflects; `eta` is the index before over the index
/// behind. See "Principles of Optics", by Born and Wolf, section 1.5.
double fresnel(double cos_in, double eta) {
    const double sin_out_squared = eta * eta * (1 - cos_in * cos_in);
    if (sin_out_squared >= 1) return 1;
    const double cos_out = std::sqrt(1 - sin_out_squared);
    const double across = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
    const double along = (eta * cos_out - cos_in) / (eta * cos_out + cos_in);
    return (across * across + along * along) / 2;
}

/// Follows one path at a time. Holds what a path carries from hit to hit.
class Path {
  public:
    Path(const Scene& scene, InsideSet inside, const Ray& ray, SplitMix64& random)
        : scene_(scene), inside_(std::move(inside)), ray_(ray), random_(random) {}

    PathSample trace(int path_length) {
        PathSample sample;
        while (sample.segments < path_length) {
            ++sample.segments;
            const Hit hit = nearest_hit(scene_, inside_, ray_);
            if (hit.sphere < 0) break;
            const Material& material = material_of(hit);
            sample.radiance = sample.radiance + throughput_ * material.radiance;
            if (!material.scatters) break;
            scatter(hit, material);
        }
        return sample;
    }

  private:
    const Sphere& sphere_of(const Hit& hit) const {
        return scene_.spheres[static_cast<std::size_t>(hit.sphere)];
    }
    const Material& material_of(const Hit& hit) const {
        return scene_.materials[static_cast<std::size_t>(sphere_of(hit).material)];
    }

    void scatter(const Hit& hit, const Material& material) {
        const bool inside = inside_[static_cast<std::size_t>(hit.sphere)];
        ray_.origin = ray_.origin + ray_.direction * hit.distance;
        const Vec3 outwards = normalized(ray_.origin - sphere_of(hit).centre);
        const Vec3 normal = inside ? -outwards : outwards;  // on the path's side
        if (material.type == MaterialType::dielectric) {
            pass_boundary(hit, normal, inside ? material.ior : 1 / material.ior);
        } else if (material.type == MaterialType::mirror) {
            throughput_ = throughput_ * material.reflectance;
            ray_.direction = reflected(ray_.direction, normal);
        } else {
            throughput_ = throughput_ * material.albedo;
            ray_.direction = cosine_direction(normal, random_);
        }
    }

    /// Reflects with the Fresnel probability, else refracts; either way the weight is 1.
    void pass_boundary(const Hit& hit, const Vec3& normal, double eta) {
        const double cos_in = std::min(1.0, -dot(ray_.direction, normal));
        if (random_.uniform() < fresnel(cos_in, eta)) {
            ray_.direction = reflected(ray_.direction, normal);
            return;
        }
        const double cos_out = std::sqrt(std::max(0.0, 1 - eta * eta * (1 - cos_in * cos_in)));
        ray_.direction = normalized(ray_.direction * eta + normal * (eta * cos_in - cos_out));
        inside_[static_cast<std::size_t>(hit.sphere)].flip();
    }

    const Scene& scene_;
    InsideSet inside_;
    Ray ray_;
    Vec3 throughput_ = {1, 1, 1};
    SplitMix64& random_;
};

}  // namespace

OracleResult trace_pt(const Scene& scene, const OracleJob& job) {
    const CameraFrame camera(scene.camera, job.size);
    const InsideSet around_camera = spheres_around(scene, scene.camera.position);
    return sample_pixels(job, [&](int x, int y) {
        const auto pixel = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(job.size.width) +
                           static_cast<std::uint64_t>(x);
        SplitMix64 random(pixel_seed(job.seed, pixel));
        PixelTally tally;
        for (int i = 0; i < job.spp; ++i) {
            const double u = (x + (job.pixel_centres ? 0.5 : random.uniform())) / job.size.width;
            const double v = (y + (job.pixel_centres ? 0.5 : random.uniform())) / job.size.height;
            const Ray ray = {scene.camera.position, normalized(camera.toward(u, v))};
            tally.add(Path(scene, around_camera, ray, random).trace(job.path_length), job.path_length);
        }
        return tally;
    });
}

}  // namespace ptb
