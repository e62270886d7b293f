// rays_experiment [KERNEL_DIR [KERNEL_DIR]]: rays through trees of triangles on PoCL against Embree's
// rtcIntersect1, the same rays, by turns, in CPU time; prints a table (Markdown). With a second folder of
// kernels, these against the first's.
#include "tests/support/rays.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <ctime>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include "tests/support/tree_walk.h"
#include "tests/support/triangles.h"

namespace {

using namespace ptb;

constexpr int edge = 256;   ///< of the picture whose camera rays are bounced
constexpr int rounds = 15;  ///< of either side, by turns

double cpu_s() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double timed_s(const std::function<void()>& work) {
    const double begin = cpu_s();
    work();
    return cpu_s() - begin;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

/// Triangles in Embree's tree.
class EmbreeScene {
  public:
    explicit EmbreeScene(const Triangles& triangles)
        : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        const std::size_t count = triangles.size();
        auto* corners = static_cast<Triangle*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(float) * 3, 3 * count));
        auto* numbers = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(unsigned) * 3, count));
        std::copy(triangles.begin(), triangles.end(), corners);
        for (unsigned i = 0; i < 3 * count; ++i) numbers[i] = i;
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
        rtcCommitScene(scene_);
    }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    ~EmbreeScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    /// The distance, or infinity.
    float met(const ProbeRay& ray) const {
        const auto &o = ray.origin_left, &d = ray.direction_reach;
        RTCRayHit hit{{o.x, o.y, o.z, least(ray), d.x, d.y, d.z, 0, INFINITY, ~0U, 0, 0}, {}};
        hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_, &context, &hit);
        return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? INFINITY : hit.ray.tfar;
    }

  private:
    /// It leaves no triangle out.
    static float least(const ProbeRay& ray) {
        return std::bit_cast<std::uint32_t>(ray.origin_left.w) == TREE_NOTHING ? 0 : 1e-7f;
    }

    RTCDevice device_;
    RTCScene scene_;
};

std::vector<ProbeRay> camera_rays() {
    std::vector<ProbeRay> rays;
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x)
            rays.push_back(make_ray({0.02, 0.5, -0.93},
                                    {1.4 * (x + 0.5) / edge - 0.7, 0.2 - 1.4 * (y + 0.5) / edge, 1}));
    return rays;
}

/// A hair above the triangle on the ray's side, where the ray met it.
Vec3 point_above(const Triangle& triangle, const ProbeHit& hit, const Vec3& normal) {
    const Vec3 a = to_vec3(triangle.corners[0]), b = to_vec3(triangle.corners[1]),
               c = to_vec3(triangle.corners[2]);
    return a + (b - a) * hit.b + (c - a) * hit.c + normal * 1e-6;
}

/// Diffuse rays from where these met something.
std::vector<ProbeRay> bounced(const std::vector<ProbeRay>& rays, const std::vector<ProbeHit>& hits,
                              const Triangles& triangles, Dice& dice) {
    std::vector<ProbeRay> next;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].triangle == TREE_NOTHING) continue;
        const Triangle& triangle = triangles[hits[i].triangle];
        const ptb_float4& d = rays[i].direction_reach;
        Vec3 normal = normalized(normal_of(triangle));
        if (dot(normal, {d.x, d.y, d.z}) > 0) normal = -normal;
        const double z = 2 * dice.uniform() - 1, turn = 2 * std::numbers::pi * dice.uniform();
        const double radius = std::sqrt(1 - z * z);
        const Vec3 to = normal + Vec3{radius * std::cos(turn), radius * std::sin(turn), z};
        const Vec3 from = point_above(triangle, hits[i], normal);
        next.push_back(make_ray({from.x, from.y, from.z}, {to.x, to.y, to.z}));
        next.back().origin_left.w = std::bit_cast<float>(hits[i].triangle);
    }
    return next;
}

struct Speed {
    double rays_per_s = 0;
    double ratio = 0;  ///< the other side's median time over this one's, by turns
};

Speed race(std::size_t rays, const std::function<void()>& ours, const std::function<void()>& theirs) {
    std::vector<double> times, ratios;
    for (int i = 0; i < rounds; ++i) {
        times.push_back(timed_s(ours));
        ratios.push_back(timed_s(theirs) / times.back());
    }
    return {static_cast<double>(rays) / median(times), median(ratios)};
}

int differing(const EmbreeScene& embree, const std::vector<ProbeRay>& rays,
              const std::vector<ProbeHit>& hits) {
    int count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const float there = embree.met(rays[i]);
        const bool met = hits[i].triangle != TREE_NOTHING;
        count +=
            met != std::isfinite(there) || (met && std::abs(hits[i].distance - there) > 1e-4f * (1 + there));
    }
    return count;
}

struct Subject {
    std::string name;
    Triangles triangles;
};

std::vector<Subject> subjects() {
    const Triangles walls = room(1);
    return {{"ball", with(walls, flake(1, 180))},
            {"flake", with(walls, flake(4, 8))},
            {"menger", with(walls, menger(3))},
            {"hair", with(walls, hair(4000, 40))},
            {"slivers", with(walls, slivers(8000))}};
}

}  // namespace

int main(int argc, char** argv) {
    const std::string first = argc > 1 ? argv[1] : "", second = argc > 2 ? argv[2] : "";
    const ocl::Device device = ocl::open_device(ocl::query_devices().at(0).key);
    fmt::print(
        "| scene | triangles | bounce | rays | Mrays/s | {} | differing |\n| --- | ---: | ---: | ---: | ---: "
        "| ---: | ---: |\n",
        second.empty() ? "of rtcIntersect1's speed" : "of the second's speed");
    double logs = 0;
    int terms = 0;
    for (const Subject& subject : subjects()) {
        const Tree tree = build_tree(subject.triangles, TreeLayout::wide8, {}, 2);
        RayList list(device, tree, "", first), other(device, tree, "", second);
        const EmbreeScene embree(subject.triangles);
        Dice dice(1);
        std::vector<ProbeRay> rays = camera_rays();
        for (int i = 0; i <= 3; ++i) {
            const std::vector<ProbeHit> hits = list.met(rays);
            if (i != 2) {
                float sum = 0;
                other.met(rays);
                const auto theirs = [&] {
                    if (!second.empty()) return other.meet();
                    for (const ProbeRay& ray : rays) sum += embree.met(ray);
                };
                const Speed speed = race(
                    rays.size(), [&] { list.meet(); }, theirs);
                fmt::print("| {} | {} | {} | {} | {:.2f} | {:.2f} | {} |\n", subject.name,
                           subject.triangles.size(), i, rays.size(), speed.rays_per_s * 1e-6, speed.ratio,
                           differing(embree, rays, hits));
                if (i > 0) logs += std::log(speed.ratio), ++terms;
                if (std::isnan(sum)) return 1;
            }
            rays = bounced(rays, hits, subject.triangles, dice);
        }
    }
    fmt::print("\nGeometric mean of bounces 1 and 3: {:.3f}\n", std::exp(logs / terms));
}
