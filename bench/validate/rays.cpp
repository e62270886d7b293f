#include "bench/validate/rays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "bench/validate/validate.h"
#include "core/scene/vec3.h"

namespace ptb {
namespace {

constexpr double affordable_tests = 6e8;  ///< of a ray and a triangle: a second or two
constexpr std::size_t fewest_rays = 64;

/// Of coordinates: what single precision may put aside a ray, a triangle, or the point where they meet.
constexpr double ray_rounding = 0x1p-20;

Vec3 corner_of(const Triangle& triangle, std::size_t i) {
    const auto& [x, y, z] = triangle.corners[i];
    return {x, y, z};
}

Vec3 part_of(const ptb_float4& v) { return {v.x, v.y, v.z}; }

/// A ball around each triangle: most are too far from a ray to be looked at.
struct Ball {
    Vec3 centre;
    double radius;
};

std::vector<Ball> balls_around(const std::vector<Triangle>& triangles) {
    std::vector<Ball> balls;
    balls.reserve(triangles.size());
    for (const Triangle& triangle : triangles) {
        const Vec3 a = corner_of(triangle, 0), b = corner_of(triangle, 1), c = corner_of(triangle, 2);
        const Vec3 centre = (a + b + c) * (1.0 / 3);
        balls.push_back({centre, std::max({length(a - centre), length(b - centre), length(c - centre)})});
    }
    return balls;
}

double largest_coordinate(const std::vector<Ball>& balls) {
    double largest = 0;
    for (const auto& [centre, radius] : balls)
        largest = std::max(largest, largest_coordinate(centre) + radius);
    return largest;
}

struct HostRay {
    Vec3 origin, direction;
    double reach;
    std::uint32_t left;

    explicit HostRay(const ListedRay& ray)
        : origin(part_of(ray.origin_left)),
          direction(part_of(ray.direction_reach)),
          reach(ray.direction_reach.w),
          left(std::bit_cast<std::uint32_t>(ray.origin_left.w)) {}
};

/// How a ray's line passes a triangle.
struct Passing {
    double inside;    ///< distance from the line to the nearest edge; negative outside
    double distance;  ///< along the ray to the triangle's plane
    double error;     ///< of the distance
};

/// Distance from the line to that of an edge: positive where the edge turns to the left around it.
double beside_edge(const Vec3& from, const Vec3& to, const Vec3& direction) {
    const Vec3 across = cross(to - from, direction);
    return dot(cross(from, to), direction) / std::max(length(across), 1e-300);
}

Passing pass(const Triangle& triangle, const HostRay& ray, double margin) {
    const Vec3 a = corner_of(triangle, 0) - ray.origin, b = corner_of(triangle, 1) - ray.origin,
               c = corner_of(triangle, 2) - ray.origin;
    const std::array<double, 3> sides{beside_edge(a, b, ray.direction), beside_edge(b, c, ray.direction),
                                      beside_edge(c, a, ray.direction)};
    const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
    const Vec3 normal = cross(b - a, c - a);
    const double along = dot(normal, ray.direction);
    const double slope = std::abs(along) / std::max(length(normal), 1e-300);
    if (slope == 0) return {-std::numeric_limits<double>::infinity(), 0, 0};
    return {std::max(*least, -*most), dot(normal, a) / along, margin * (1 + 1 / slope)};
}

std::string text_of(const Vec3& v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z); }

std::string text_of(const HostRay& ray) {
    return fmt::format("the ray from {} along {}", text_of(ray.origin), text_of(ray.direction));
}

/// All triangles, to be met one by one.
class AllTriangles {
  public:
    explicit AllTriangles(const std::vector<Triangle>& triangles)
        : triangles_(triangles),
          balls_(balls_around(triangles)),
          margin_(ray_rounding * largest_coordinate(balls_)) {}

    /// What is wrong with what was told of a ray, or nothing.
    std::string complaint(const HostRay& ray, const ListedHit& told, bool any) const {
        const double margin = margin_of(ray);
        double end = ray.reach;
        if (told.triangle != TREE_NOTHING) {
            if (told.triangle >= triangles_.size() || told.triangle == ray.left)
                return fmt::format("{} is told to meet triangle {}, which it cannot", text_of(ray),
                                   told.triangle);
            const Passing met = pass(triangles_[told.triangle], ray, margin);
            if (met.inside < -margin || met.distance < -met.error || met.distance > ray.reach + met.error)
                return fmt::format("{} is told to meet triangle {}, which it passes by", text_of(ray),
                                   told.triangle);
            if (any) return "";
            if (!(std::abs(told.distance - met.distance) <= met.error + ray_rounding * met.distance))
                return fmt::format("{} is told to meet triangle {} at {:.9g}, which is at {:.9g}",
                                   text_of(ray), told.triangle, told.distance, met.distance);
            end = std::min(end, met.distance - met.error);
        }
        const auto before = met_before(ray, end, margin);
        if (!before) return "";
        const auto& [triangle, distance] = *before;
        const std::string met = told.triangle == TREE_NOTHING
                                    ? "nothing"
                                    : fmt::format("triangle {} at {:.9g}", told.triangle, told.distance);
        return fmt::format("{} is told to meet {}, but meets triangle {} at {:.9g}", text_of(ray), met,
                           triangle, distance);
    }

  private:
    struct Met {
        std::size_t triangle;
        double distance;
    };

    double margin_of(const HostRay& ray) const {
        return margin_ + ray_rounding * largest_coordinate(ray.origin);
    }

    /// A triangle that the ray meets before `end`, whatever single precision rounds.
    std::optional<Met> met_before(const HostRay& ray, double end, double margin) const {
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            const Vec3 way = balls_[i].centre - ray.origin;
            const double along = dot(way, ray.direction), radius = balls_[i].radius + margin;
            if (dot(way, way) - along * along > radius * radius || i == ray.left) continue;
            const Passing met = pass(triangles_[i], ray, margin);
            if (met.inside > margin && met.distance > met.error && met.distance + met.error < end)
                return Met{i, met.distance};
        }
        return std::nullopt;
    }

    const std::vector<Triangle>& triangles_;
    std::vector<Ball> balls_;
    double margin_;
};

/// So far apart in the sample are rays of which as many are looked at as is affordable.
std::size_t step_of(const RaySample& sample) {
    const double affordable =
        affordable_tests / static_cast<double>(std::max<std::size_t>(sample.triangles->size(), 1));
    const auto wanted = std::max(fewest_rays, static_cast<std::size_t>(affordable));
    return (sample.rays.size() + wanted - 1) / wanted;
}

/// The first complaint about every so many rays from `first` on.
std::string first_complaint(const AllTriangles& all, const RaySample& sample, std::size_t first,
                            std::size_t step) {
    for (std::size_t i = first; i < sample.rays.size(); i += step) {
        const std::string complaint = all.complaint(HostRay(sample.rays[i]), sample.hits[i], sample.any);
        if (!complaint.empty()) return complaint;
    }
    return "";
}

}  // namespace

void check_rays(Validation& validation, const RaySample& sample) {
    const AllTriangles all(*sample.triangles);
    const std::size_t step = std::max<std::size_t>(step_of(sample), 1);
    std::array<std::string, 2> complaints;
    {
        const std::jthread other([&] { complaints[1] = first_complaint(all, sample, step, 2 * step); });
        complaints[0] = first_complaint(all, sample, 0, 2 * step);
    }
    validation.checks.push_back("rays");
    for (const std::string& complaint : complaints)
        if (!complaint.empty()) fail(validation, complaint);
}

}  // namespace ptb
