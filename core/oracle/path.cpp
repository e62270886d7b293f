#include "core/oracle/path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/oracle/camera_frame.h"

namespace ptb {
namespace {

constexpr double no_hit = std::numeric_limits<double>::infinity();

struct SphereHit {
    double distance = no_hit;
    int sphere = -1;
};

/// Distance to the sphere: from inside always the far root; from outside the near one, when the centre lies
/// ahead. Roots by way of the point nearest to the centre, which does not cancel for spheres much larger than
/// the scene; see "Precision Improvements for Ray/Sphere Intersection", by Haines, Günther and
/// Akenine-Möller.
double sphere_distance(const Sphere& sphere, bool inside, const PathRay& ray) {
    const Vec3 to_centre = sphere.centre - ray.origin;
    const double ahead = dot(to_centre, ray.direction);
    if (!inside && ahead <= 0) return no_hit;
    const Vec3 nearest = to_centre - ray.direction * ahead;
    const double half_chord_squared = sphere.radius * sphere.radius - dot(nearest, nearest);
    if (!inside && half_chord_squared < 0) return no_hit;
    const double half_chord = std::sqrt(std::max(0.0, half_chord_squared));
    return std::max(0.0, inside ? ahead + half_chord : ahead - half_chord);
}

/// `left_out` is the number of a sphere that is not there, or -1.
SphereHit nearest_sphere(const Scene& scene, const InsideSet& inside, const PathRay& ray, int left_out) {
    SphereHit best;
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
        if (static_cast<int>(i) == left_out) continue;
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

bool is_matte(const Material& material) {
    return material.type == MaterialType::matte || material.type == MaterialType::emitter;
}

}  // namespace

InsideSet spheres_around(const Scene& scene, const Vec3& point) {
    InsideSet inside;
    for (const Sphere& sphere : scene.spheres)
        inside.push_back(length(point - sphere.centre) < sphere.radius);
    return inside;
}

const Material& Path::material() const {
    const int material = surface_.facet >= 0
                             ? facets_[surface_.facet].material
                             : scene_.spheres[static_cast<std::size_t>(surface_.sphere)].material;
    return scene_.materials[static_cast<std::size_t>(material)];
}

Vec3 Path::outwards() const {
    if (surface_.facet >= 0) return facets_[surface_.facet].normal;
    return normalized(position() - scene_.spheres[static_cast<std::size_t>(surface_.sphere)].centre);
}

bool Path::is_inside() const {
    if (surface_.facet >= 0) return dot(ray_.direction, facets_[surface_.facet].normal) > 0;
    return inside_[static_cast<std::size_t>(surface_.sphere)];
}

Vec3 Path::normal() const { return is_inside() ? -outwards() : outwards(); }

bool Path::advance() {
    const SphereHit sphere = nearest_sphere(scene_, inside_, ray_, -1);
    const FacetHit facet = facets_.nearest(ray_, surface_.facet, -1);
    if (sphere.sphere < 0 && facet.facet < 0) return false;
    if (facet.distance < sphere.distance) {
        surface_ = {-1, facet.facet};
        ray_.origin = facet.position;
    } else {
        surface_ = {sphere.sphere, -1};
        ray_.origin = ray_.origin + ray_.direction * sphere.distance;
    }
    return true;
}

bool Path::sees(const Vec3& point, const Surface& lamp) const {
    const Vec3 way = point - position();
    const PathRay ray = {position(), normalized(way)};
    return std::min(nearest_sphere(scene_, inside_, ray, lamp.sphere).distance,
                    facets_.nearest(ray, surface_.facet, lamp.facet).distance) >= length(way);
}

void Path::scatter() {
    const Material& surface = material();
    if (surface.type == MaterialType::dielectric) {
        pass_boundary(normal(), is_inside() ? surface.ior : 1 / surface.ior);
    } else if (surface.type == MaterialType::mirror) {
        throughput_ = throughput_ * surface.reflectance;
        ray_.direction = reflected(ray_.direction, normal());
    } else {
        throughput_ = throughput_ * surface.albedo;
        ray_.direction = cosine_direction(normal(), random_);
    }
}

/// Reflects with the Fresnel probability, else refracts; either way the weight is 1.
void Path::pass_boundary(const Vec3& normal, double eta) {
    const double cos_in = std::min(1.0, -dot(ray_.direction, normal));
    if (random_.uniform() < fresnel(cos_in, eta)) {
        ray_.direction = reflected(ray_.direction, normal);
        return;
    }
    const double cos_out = std::sqrt(std::max(0.0, 1 - eta * eta * (1 - cos_in * cos_in)));
    ray_.direction = normalized(ray_.direction * eta + normal * (eta * cos_in - cos_out));
    if (surface_.sphere >= 0) inside_[static_cast<std::size_t>(surface_.sphere)].flip();
}

bool reach_matte(Path& path, int path_length, PathSample& sample) {
    while (sample.segments < path_length) {
        ++sample.segments;
        if (!path.advance()) return false;
        sample.radiance = sample.radiance + path.emitted();
        if (!path.material().scatters) return false;
        if (is_matte(path.material())) return true;
        path.scatter();
    }
    return false;
}

OracleResult sample_paths(const Scene& scene, const OracleJob& job,
                          const std::function<PathSample(Path&)>& gather) {
    const CameraFrame camera(scene.camera, job.size);
    const InsideSet around_camera = spheres_around(scene, scene.camera.position);
    const Facets facets(scene);
    return sample_pixels(job, [&](int x, int y) {
        const auto pixel = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(job.size.width) +
                           static_cast<std::uint64_t>(x);
        SplitMix64 random(pixel_seed(job.seed, pixel));
        PixelTally tally;
        for (int i = 0; i < job.spp; ++i) {
            const double u = (x + (job.pixel_centres ? 0.5 : random.uniform())) / job.size.width;
            const double v = (y + (job.pixel_centres ? 0.5 : random.uniform())) / job.size.height;
            Path path(scene, facets, around_camera, {scene.camera.position, normalized(camera.toward(u, v))},
                      random);
            tally.add(gather(path), job.path_length);
        }
        return tally;
    });
}

}  // namespace ptb
