// rays_experiment SCENE... [-- KERNEL_DIR [KERNEL_DIR]]: rays through trees of triangles on PoCL against
// Embree's rtcIntersect1, the same rays, by turns, in CPU time, and all of `pt`; prints a table (Markdown).
// With a second folder of kernels, these against the first's.
#include <ctime>
#include <functional>

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include "scripts/experiments/ray_lists.h"

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
    float met(const ListedRay& ray) const {
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
    static float least(const ListedRay& ray) {
        return std::bit_cast<std::uint32_t>(ray.origin_left.w) == TREE_NOTHING ? 0 : 1e-7f;
    }

    RTCDevice device_;
    RTCScene scene_;
};

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

int differing(const EmbreeScene& embree, const std::vector<ListedRay>& rays,
              const std::vector<ListedHit>& hits) {
    int count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const float there = embree.met(rays[i]);
        const bool met = hits[i].triangle != TREE_NOTHING;
        count +=
            met != std::isfinite(there) || (met && std::abs(hits[i].distance - there) > 1e-4f * (1 + there));
    }
    return count;
}

/// All of `pt`, ten segments a path, against Embree's time for as many rays alike: of ten one of the camera,
/// one of its first bounce, the others of the third.
class PathRace {
  public:
    PathRace(const ocl::Device& device, const Subject& subject, const std::string& kernel_dir)
        : render_(path_tracer(device, subject, job(), kernel_dir)) {
        render_->advance(whole_);
        segments_ = static_cast<double>(render_->read_film().segments);
    }

    double segments_per_s() {
        return segments_ / timed_s([&] {
                   render_->restart();
                   while (render_->samples_left() > 0) render_->advance(whole_);
               });
    }

  private:
    static constexpr std::uint64_t whole_ = ~std::uint64_t{0};

    static RenderJob job() {
        RenderJob job;
        job.size = {edge, edge};
        job.path_length = 10;
        return job;
    }

    std::unique_ptr<Render> render_;
    double segments_ = 0;
};

struct Sides {
    std::string first, second;  ///< folders of kernels
};

/// Prints a row a list; returns the ratios of bounces 1 and 3, and that of `pt`.
std::vector<double> run(const ocl::Device& device, const std::string& file, const Sides& sides) {
    const Subject subject(file);
    const Tree tree = build_tree(subject.triangles, TreeLayout::wide8, {}, 2);
    RayList list(device, tree, "", sides.first), other(device, tree, "", sides.second);
    const EmbreeScene embree(subject.triangles);
    PathRace paths(device, subject, sides.first);
    Dice dice(1);
    std::vector<ListedRay> rays = camera_rays(subject, edge);
    std::vector<double> ratios;
    double theirs_s = 0;  // for a ray of the mix
    for (int i = 0; i <= 3; ++i) {
        const std::vector<ListedHit> hits = list.met(rays);
        if (i != 2) {
            other.met(rays);
            float sum = 0;
            const auto theirs = [&] {
                if (!sides.second.empty()) return (void)other.meet();
                for (const ListedRay& ray : rays) sum += embree.met(ray);
            };
            const Speed speed = race(
                rays.size(), [&] { list.meet(); }, theirs);
            fmt::print("| {} | {} | {} | {} | {:.2f} | {:.2f} | {} |\n", subject.scene.name,
                       subject.triangles.size(), i, rays.size(), speed.rays_per_s * 1e-6, speed.ratio,
                       differing(embree, rays, hits));
            if (i > 0) ratios.push_back(speed.ratio);
            theirs_s += (i == 3 ? 0.8 : 0.1) * speed.ratio / speed.rays_per_s;
            if (std::isnan(sum)) throw std::runtime_error("no number");
        }
        rays = bounced(rays, hits, subject, dice);
    }
    std::vector<double> speeds;
    for (int i = 0; i < rounds; ++i) speeds.push_back(paths.segments_per_s());
    ratios.push_back(median(speeds) * theirs_s);
    fmt::print("| {} | {} | `pt` | | {:.2f} | {:.2f} | |\n", subject.scene.name, subject.triangles.size(),
               median(speeds) * 1e-6, ratios.back());
    std::fflush(stdout);
    return ratios;
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    const auto dashes = std::find(words.begin(), words.end(), "--");
    const auto folder = [&](std::ptrdiff_t i) {
        return words.end() - dashes > i ? dashes[i] : std::string();
    };
    const Sides sides{folder(1), folder(2)};
    const ocl::Device device = ocl::open_device(ocl::query_devices().at(0).key);
    fmt::print(
        "| scene | triangles | bounce | rays | Mrays/s | {} | differing |\n| --- | ---: | ---: | ---: | ---: "
        "| ---: | ---: |\n",
        sides.second.empty() ? "of rtcIntersect1's speed" : "of the second's speed");
    double logs = 0, path_logs = 0;
    for (auto file = words.begin(); file != dashes; ++file) {
        const std::vector<double> ratios = run(device, *file, sides);
        logs += std::log(ratios[0]) + std::log(ratios[1]);
        path_logs += std::log(ratios[2]);
    }
    const auto scenes = static_cast<double>(dashes - words.begin());
    fmt::print("\nGeometric means: bounces 1 and 3 {:.3f}, pt {:.3f}\n", std::exp(logs / (2 * scenes)),
               std::exp(path_logs / scenes));
}
