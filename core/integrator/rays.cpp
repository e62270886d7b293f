#include "core/integrator/rays.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <fmt/format.h>

#include "core/integrator/camera.h"
#include "core/integrator/device_meshes.h"
#include "core/integrator/engine_options.h"
#include "core/integrator/variant_support.h"
#include "core/render/film_hash.h"
#include "core/render/launcher.h"

namespace ptb {

namespace {

/// How rays of a kind come about.
struct RayOrigin {
    std::uint32_t grounds;  ///< surfaces on the way from the camera to where they start
    bool to_lamp;
};

RayOrigin origin_of(RayKind kind) {
    switch (kind) {
        case RayKind::bounce1:
            return {1, false};
        case RayKind::bounce3:
            return {3, false};
        case RayKind::shadow:
            return {1, true};
        case RayKind::primary:
            break;
    }
    return {0, false};
}

bool shines(const Scene& scene, const Mesh& mesh) {
    return scene.materials[static_cast<std::size_t>(mesh.material)].radiance != Vec3{};
}

/// Triangles that shine.
std::vector<TreeTriangle> shining_triangles(const Scene& scene, const std::vector<Triangle>& triangles) {
    std::vector<TreeTriangle> lamps;
    std::uint32_t number = 0;
    for (const Mesh& mesh : scene.meshes) {
        const auto end = number + static_cast<std::uint32_t>(mesh.faces.size());
        for (; number < end; ++number) {
            if (!shines(scene, mesh)) continue;
            const auto& [a, b, c] = triangles[number].corners;
            lamps.push_back({{a[0], a[1], a[2], std::bit_cast<float>(number)},
                             {b[0], b[1], b[2], 0},
                             {c[0], c[1], c[2], 0}});
        }
    }
    return lamps;
}

std::uint64_t shining_count(const Scene& scene) {
    std::uint64_t count = 0;
    for (const Mesh& mesh : scene.meshes) count += shines(scene, mesh) ? mesh.faces.size() : 0;
    return count;
}

Camera seen_from(Camera camera, const Vec3& origin) {
    camera.position = camera.position - origin;
    camera.look_at = camera.look_at - origin;
    return camera;
}

std::uint64_t rays_of(const RenderJob& job) {
    return job.size.pixels() * static_cast<std::uint64_t>(job.spp);
}

/// Of a list; a CPU's work-item takes a run of them.
std::uint64_t rays_per_item(const ocl::Device& device) { return is_throughput_device(device) ? 1 : 64; }

class RaysRender : public Render {
  public:
    RaysRender(const Integrator& row, const ocl::Device& device, const ocl::Program& program,
               const Scene& scene, const RenderJob& job)
        : row_(row),
          device_(device),
          job_(job),
          count_(rays_of(job)),
          nearness_(length(scene.camera.look_at - scene.camera.position)),
          launcher_(device, job.variant),
          counted_(device, program) {
        const DeviceScene device_scene = device_scene_for(row, device, scene, job);
        triangles_ = std::make_shared<std::vector<Triangle>>(device_triangles(scene, device_scene.origin));
        tree_bytes_ = device_scene.meshes.node_bytes() + device_scene.meshes.leaf_bytes();
        ocl::checked("rays buffers", device_.info.name, [&] {
            kernel_ = cl::Kernel(program.program, row.kernel(sees() ? "see" : "meet").c_str());
            counted_.give(kernel_);
            tree_ = tree_buffers(device_, *device_scene.meshes.tree);
            grid_ = device_scene.meshes.tree->grid;
            rays_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE, count_ * sizeof(ListedRay));
            hits_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE, count_ * sizeof(ListedHit));
        });
        make_list(program, scene, seen_from(scene.camera, device_scene.origin));
        restart();
    }

    void restart() override {
        counted_.clear();
        done_ = 0;
    }

    std::uint64_t samples_left() const override { return count_ - done_; }

    std::vector<LaunchTimes> advance(std::uint64_t samples) override {
        const std::uint64_t end = done_ + std::min(std::max<std::uint64_t>(samples, 1), samples_left());
        const std::uint64_t items = (end - done_ + rays_per_item(device_) - 1) / rays_per_item(device_);
        const std::uint64_t slices = launcher_.slices(items);
        const std::string what = row_.kernel("meet") + ", " + describe(ranges_of(end - done_, 1));
        const auto times = ocl::checked(what, device_.info.name, [&] {
            for (std::uint64_t i = 0; i < slices; ++i)
                launch(done_ + (end - done_) * i / slices, done_ + (end - done_) * (i + 1) / slices);
            return launcher_.finish();
        });
        done_ = end;
        return times;
    }

    Film read_film() override {
        Film film;
        film.mean = {job_.size, std::vector<float>(job_.size.pixels() * 3)};
        film.segments = done_;
        film.rays = RaySample{{}, {}, sees(), triangles_};
        FilmHash hash;
        for (std::uint64_t first = 0; first < done_; first += hits_at_once) {
            const auto hits = read<ListedHit>(hits_, first, std::min(hits_at_once, done_ - first));
            for (std::size_t i = 0; i < hits.size(); ++i) take(first + i, hits[i], film);
            hash.add(std::span<const ListedHit>(hits));
        }
        film.hash = hash.text();
        return film;
    }

    ocl::KernelFacts facts() const override { return kernel_facts(device_, kernel_); }
    std::optional<Counts> counts() const override { return counted_.read(); }
    std::uint64_t device_bytes() const override {
        return count_ * (sizeof(ListedRay) + sizeof(ListedHit)) + tree_bytes_;
    }

  private:
    static constexpr std::uint64_t hits_at_once = 1u << 20;  ///< on the host
    static constexpr std::uint64_t made_at_once = 1u << 20;  ///< by a launch
    static constexpr std::uint64_t sampled = 4096;           ///< rays that a film shows

    bool sees() const { return job_.variant.ray_kind == RayKind::shadow; }

    void make_list(const ocl::Program& program, const Scene& scene, const Camera& camera) {
        const auto [grounds, to_lamp] = origin_of(job_.variant.ray_kind);
        std::vector<TreeTriangle> lamps;
        if (to_lamp) lamps = shining_triangles(scene, *triangles_);
        RaysMaking making{};
        making.camera = device_camera(camera, job_.size);
        making.width = static_cast<std::uint32_t>(job_.size.width);
        making.pixels = static_cast<std::uint32_t>(job_.size.pixels());
        making.seed = job_.seed;
        making.run = static_cast<std::uint32_t>(rays_per_item(device_));
        making.grounds = grounds;
        making.lamps = static_cast<std::uint32_t>(lamps.size());
        if (lamps.empty()) lamps.emplace_back();  // there is no empty buffer
        const std::uint32_t missing =
            ocl::checked("rays_make", device_.info.name, [&] { return make_rays(program, lamps, making); });
        if (missing > 0)
            throw std::runtime_error(fmt::format(
                "scene {}: {} of {} rays found no surface to start from: the camera sees too few triangles",
                scene.name, missing, count_));
    }

    /// How many it could not make.
    std::uint32_t make_rays(const ocl::Program& program, std::vector<TreeTriangle>& lamps,
                            RaysMaking making) {
        const cl::Buffer lamp_rows(device_.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                                   lamps.size() * sizeof(TreeTriangle), lamps.data());
        std::uint32_t missing = 0;
        const cl::Buffer counter(device_.context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, sizeof missing,
                                 &missing);
        cl::Kernel make(program.program, row_.kernel("make").c_str());
        for (std::uint64_t first = 0; first < count_; first += made_at_once) {
            making.first = static_cast<std::uint32_t>(first);
            making.end = static_cast<std::uint32_t>(std::min(first + made_at_once, count_));
            cl_uint i = 0;
            const auto give = [&](const auto& argument) { make.setArg(i++, argument); };
            give(tree_[0]), give(tree_[1]), give(grid_), give(lamp_rows), give(rays_), give(counter),
                give(making);
            const Ranges ranges = one_dimensional((making.end - making.first - 1) / making.run + 1, 0);
            device_.queue.enqueueNDRangeKernel(make, cl::NullRange, ranges.global, ranges.local);
        }
        device_.queue.enqueueReadBuffer(counter, CL_TRUE, 0, sizeof missing, &missing);
        return missing;
    }

    Ranges ranges_of(std::uint64_t rays, std::uint64_t run) const {
        return launcher_.ranges((rays + run - 1) / run, job_.work_group_x);
    }

    void launch(std::uint64_t first, std::uint64_t end) {
        const bool task = job_.variant.dispatch == Dispatch::tasks;
        const std::uint64_t run = task ? end - first : rays_per_item(device_);
        cl_uint i = 0;
        const auto give = [&](const auto& argument) { kernel_.setArg(i++, argument); };
        give(tree_[0]), give(tree_[1]), give(grid_), give(rays_), give(hits_);
        for (const std::uint64_t number : {first, end, run}) give(static_cast<cl_uint>(number));
        launcher_.launch(kernel_, ranges_of(end - first, run));
    }

    template <class Row>
    std::vector<Row> read(const cl::Buffer& buffer, std::uint64_t first, std::uint64_t count) const {
        std::vector<Row> rows(count);
        ocl::checked("rays film", device_.info.name, [&] {
            launcher_.queue().enqueueReadBuffer(buffer, CL_TRUE, first * sizeof(Row), count * sizeof(Row),
                                                rows.data());
        });
        return rows;
    }

    /// The worth of a ray: 1 where it gets to a lamp, or more the sooner it meets something.
    double worth(const ListedHit& hit) const {
        const bool met = hit.triangle != TREE_NOTHING;
        if (sees()) return met ? 0 : 1;
        return met ? nearness_ / (nearness_ + hit.distance) : 0;
    }

    /// A ray into its pixel's mean of so far; some into the film's sample.
    void take(std::uint64_t number, const ListedHit& hit, Film& film) const {
        const std::uint64_t pixel = number % job_.size.pixels(), sample = number / job_.size.pixels();
        for (std::size_t c = 0; c < 3; ++c) {
            float& mean = film.mean.rgb[pixel * 3 + c];
            mean += (static_cast<float>(worth(hit)) - mean) / static_cast<float>(sample + 1);
        }
        if (number % ((count_ - 1) / sampled + 1) != 0) return;
        film.rays->rays.push_back(read<ListedRay>(rays_, number, 1).front());
        film.rays->hits.push_back(hit);
    }

    const Integrator& row_;
    ocl::Device device_;
    RenderJob job_;
    std::uint64_t count_, done_ = 0, tree_bytes_ = 0;
    double nearness_;  ///< the distance of what is half as bright as what is nearest
    Launcher launcher_;
    CountedRows counted_;
    cl::Kernel kernel_;
    std::vector<cl::Buffer> tree_;
    TreeGrid grid_{};
    cl::Buffer rays_, hits_;
    std::shared_ptr<const std::vector<Triangle>> triangles_;
};

std::string rays_options(const Integrator& row, const ocl::Device& device, const Scene& scene,
                         const RenderJob& job) {
    return common_options(device, job) +
           tree_options(device, *device_scene_for(row, device, scene, job).meshes.tree);
}

constexpr std::uint64_t most_listed = std::uint64_t{1} << 31;

std::string rays_refusal(const Integrator& row, const ocl::Device& device, const Scene& scene,
                         const RenderJob& job) {
    for (const auto& [axis, has] : {std::pair("scene_memory", std::vector<std::string>{"auto", "global"}),
                                    std::pair("film_memory", std::vector<std::string>{"buffer"}),
                                    std::pair("pixel_filter", std::vector<std::string>{"jitter"}),
                                    std::pair("rng", std::vector<std::string>{"auto", "hash"}),
                                    std::pair("roulette", std::vector<std::string>{"off"})})
        if (const std::string reason = choice_refusal(row.id, axis, job.variant, has); !reason.empty())
            return reason;
    if (rays_of(job) > most_listed)
        return fmt::format("size {}x{} at spp {}: {} lists at most {} rays", job.size.width, job.size.height,
                           job.spp, row.id, most_listed);
    if (origin_of(job.variant.ray_kind).to_lamp && shining_count(scene) == 0)
        return fmt::format("ray_kind shadow: scene {} has no triangle that shines", scene.name);
    return mesh_refusal(row, device, scene, job);
}

DeviceMemory rays_memory(const Integrator& row, const ocl::Device& device, const Scene& scene,
                         const RenderJob& job) {
    const DeviceMeshes meshes = device_scene_for(row, device, scene, job).meshes;
    const std::uint64_t list = rays_of(job) * sizeof(ListedRay);
    return {list + rays_of(job) * sizeof(ListedHit) + meshes.node_bytes() + meshes.leaf_bytes(),
            std::max({list, meshes.node_bytes(), meshes.leaf_bytes()})};
}

std::unique_ptr<Render> make_rays_render(const Integrator& row, const ocl::Device& device,
                                         const ocl::Program& program, const Scene& scene,
                                         const RenderJob& job) {
    return std::make_unique<RaysRender>(row, device, program, scene, job);
}

}  // namespace

const Machinery rays_machinery{rays_options, rays_refusal, rays_memory, make_rays_render};

}  // namespace ptb
