// tinybvh_experiment DEVICE TINYBVH SCENE...: the same diffuse rays by this project's kernels and by
// tinybvh's own OpenCL kernels (read from the folder TINYBVH), by turns, timed by their events, and all of
// `pt` beside them; prints a table (Markdown).
#define TINYBVH_IMPLEMENTATION
#include <future>
#include <utility>

#include <fmt/format.h>
#include <tiny_bvh.h>

#include "scripts/experiments/ray_lists.h"

namespace {

using namespace ptb;

constexpr int edge = 2048;  ///< of the picture whose camera rays are bounced
constexpr int rounds = 11;  ///< of all sides, by turns

/// As its kernels read it.
struct TinyRay {
    ptb_float4 origin, direction, inverse, hit;
};

TinyRay tiny_ray(const ListedRay& ray) {
    const auto &o = ray.origin_left, &d = ray.direction_reach;
    const auto inverse = [](float x) { return 1 / (std::abs(x) < 1e-18f ? std::copysign(1e-18f, x) : x); };
    return {{o.x, o.y, o.z, 1}, {d.x, d.y, d.z, 0}, {inverse(d.x), inverse(d.y), inverse(d.z), 1}, {}};
}

std::vector<tinybvh::bvhvec4> corners_of(const std::vector<Triangle>& triangles) {
    std::vector<tinybvh::bvhvec4> corners;
    for (const Triangle& triangle : triangles)
        for (const auto& [x, y, z] : triangle.corners) corners.emplace_back(x, y, z, 0.0f);
    return corners;
}

cl::Program tiny_program(const ocl::Device& device, const std::string& folder) {
    const bool nvidia = device.info.vendor.find("NVIDIA") != std::string::npos;
    const cl::Program program(device.context,
                              std::string(nvidia ? "#define ISNVIDIA\n" : "") + "#include \"traverse.cl\"\n");
    for (const std::string standard : {"CL2.0", "CL3.0", "CL1.2"}) try {
            program.build(fmt::format("-I {} -cl-std={} -cl-strict-aliasing -cl-fast-relaxed-math "
                                      "-cl-single-precision-constant{}",
                                      folder, standard, nvidia ? " -cl-nv-opt-level=9" : "")
                              .c_str());
            return program;
        } catch (const cl::Error&) {
            if (standard == "CL1.2") throw;
        }
    return program;
}

double seconds_of(const LaunchTimes& times) { return static_cast<double>(times.end - times.start) * 1e-9; }

/// One of tinybvh's trees with its kernel.
class TinyTree {
  public:
    TinyTree(const ocl::Device& device, const cl::Program& program, const std::string& kernel)
        : device_(device), kernel_(program, kernel.c_str()) {}

    void give(const void* data, std::size_t bytes) {
        buffers_.emplace_back(device_.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, bytes,
                              const_cast<void*>(data));
        kernel_.setArg(static_cast<cl_uint>(buffers_.size() - 1), buffers_.back());
    }

    void ask(const std::vector<ListedRay>& rays) {
        std::vector<TinyRay> tiny;
        for (const ListedRay& ray : rays) tiny.push_back(tiny_ray(ray));
        count_ = tiny.size() / 64 * 64;
        rays_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
                           tiny.size() * sizeof(TinyRay), tiny.data());
        kernel_.setArg(static_cast<cl_uint>(buffers_.size()), rays_);
    }

    double rays_per_s() {
        cl::Event event;
        device_.queue.enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(count_), cl::NDRange(64),
                                           nullptr, &event);
        device_.queue.finish();
        return static_cast<double>(count_) / seconds_of(times_of({event}, device_).front());
    }

    /// Rays whose distance is another.
    int differing(const std::vector<ListedHit>& hits) const {
        std::vector<TinyRay> tiny(count_);
        device_.queue.enqueueReadBuffer(rays_, CL_TRUE, 0, count_ * sizeof(TinyRay), tiny.data());
        int count = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const float ours = hits[i].triangle == TREE_NOTHING ? 1e30f : hits[i].distance;
            count += !(std::abs(tiny[i].hit.x - ours) <= 1e-3f * (1 + std::min(ours, 1e20f)));
        }
        return count;
    }

  private:
    ocl::Device device_;
    cl::Kernel kernel_;
    std::vector<cl::Buffer> buffers_;
    cl::Buffer rays_;
    std::size_t count_ = 0;
};

TinyTree two_children(const ocl::Device& device, const cl::Program& program,
                      const std::vector<tinybvh::bvhvec4>& corners) {
    tinybvh::BVH_GPU bvh;
    bvh.BuildHQ(corners.data(), static_cast<std::uint32_t>(corners.size() / 3));
    TinyTree tree(device, program, "batch_ailalaine");
    tree.give(bvh.bvhNode, bvh.usedNodes * sizeof(*bvh.bvhNode));
    tree.give(bvh.bvh.primIdx, bvh.idxCount * sizeof(std::uint32_t));
    tree.give(corners.data(), corners.size() * sizeof(corners[0]));
    return tree;
}

TinyTree eight_children(const ocl::Device& device, const cl::Program& program,
                        const std::vector<tinybvh::bvhvec4>& corners) {
    tinybvh::BVH8_CWBVH bvh;
    bvh.BuildHQ(corners.data(), static_cast<std::uint32_t>(corners.size() / 3));
    TinyTree tree(device, program, "batch_cwbvh");
    tree.give(bvh.bvh8Data, bvh.usedBlocks * sizeof(tinybvh::bvhvec4));
    tree.give(bvh.bvh8Tris, bvh.idxCount * 3 * sizeof(tinybvh::bvhvec4));
    return tree;
}

double segments_per_s(Render& render) {
    render.restart();
    double seconds = 0;
    while (render.samples_left() > 0)
        for (const LaunchTimes& times : render.advance(~std::uint64_t{0})) seconds += seconds_of(times);
    return static_cast<double>(render.read_film().segments) / seconds;
}

RenderJob path_job() {
    RenderJob job;
    job.size = {1024, 1024};
    job.spp = 32;
    job.path_length = 10;
    return job;
}

struct Speeds {
    std::vector<double> list, bvh2, cwbvh, paths;
};

/// `hits`: of all rays, by this project's kernel.
Speeds race(RayList& list, std::size_t rays, TinyTree& two, TinyTree& eight, Render& paths) {
    Speeds speeds;
    for (int i = 0; i <= rounds; ++i) {  // the first to warm up
        const double ours = static_cast<double>(rays) / seconds_of(list.meet());
        const double bvh2 = two.rays_per_s(), cwbvh = eight.rays_per_s(), all = segments_per_s(paths);
        if (i == 0) continue;
        speeds.list.push_back(ours);
        speeds.bvh2.push_back(bvh2);
        speeds.cwbvh.push_back(cwbvh);
        speeds.paths.push_back(all);
    }
    return speeds;
}

/// A scene in trees of all sides. Theirs are built by one thread each.
struct Sides {
    Subject subject;
    Tree tree;
    TinyTree two, eight;
};

Sides sides_of(const ocl::Device& device, const cl::Program& program, const std::string& file) {
    Subject subject(file);
    const auto corners = corners_of(subject.triangles);
    auto eight = std::async(std::launch::async, [&] { return eight_children(device, program, corners); });
    TinyTree two = two_children(device, program, corners);
    const TreeLayout layout = device.info.type == "CPU" ? TreeLayout::wide8 : TreeLayout::bvh2;
    Tree tree = build_tree(subject.triangles, layout, {}, 4);
    return {std::move(subject), std::move(tree), std::move(two), eight.get()};
}

/// Prints a row a bounce; returns the ratio of `pt` to tinybvh's best of bounce 1.
double run(const ocl::Device& device, Sides sides) {
    auto& [subject, tree, two, eight] = sides;
    RayList list(device, tree);
    const auto paths = path_tracer(device, subject, path_job());
    Dice dice(1);
    std::vector<ListedRay> rays = camera_rays(subject, edge);
    std::vector<ListedHit> hits = list.met(rays);
    double result = 0;
    for (int bounce = 1; bounce <= 3; ++bounce) {
        rays = bounced(rays, hits, subject, dice);
        hits = list.met(rays);
        if (bounce == 2) continue;
        two.ask(rays);
        eight.ask(rays);
        const Speeds speeds = race(list, rays.size(), two, eight, *paths);
        const double best = std::max(median(speeds.bvh2), median(speeds.cwbvh));
        fmt::print("| {} | {} | {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.2f} | {:.2f} | {}, {} |\n",
                   subject.scene.name, subject.triangles.size(), bounce, median(speeds.bvh2) * 1e-6,
                   median(speeds.cwbvh) * 1e-6, median(speeds.list) * 1e-6, median(speeds.paths) * 1e-6,
                   median(speeds.list) / best, median(speeds.paths) / best, two.differing(hits),
                   eight.differing(hits));
        std::fflush(stdout);
        if (bounce == 1) result = median(speeds.paths) / best;
    }
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        fmt::print(stderr, "usage: tinybvh_experiment DEVICE TINYBVH SCENE...\n");
        return 2;
    }
    const ocl::Device device = ocl::open_device(argv[1]);
    const cl::Program program = tiny_program(device, argv[2]);
    fmt::print(
        "| scene | triangles | bounce | tinybvh BVH2, Mrays/s | CWBVH | own list | `pt`, Msegments/s | "
        "list | `pt` over the best | differing |\n"
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    std::vector<std::future<Sides>> all;
    for (int i = 3; i < argc; ++i)
        all.push_back(std::async(std::launch::async, sides_of, device, program, std::string(argv[i])));
    double logs = 0;
    for (auto& each : all) logs += std::log(run(device, each.get()));
    fmt::print("\nGeometric mean of `pt` over tinybvh's best, bounce 1: {:.2f} ({})\n",
               std::exp(logs / (argc - 3)), device.info.name);
}
