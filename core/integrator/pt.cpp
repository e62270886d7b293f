#include "core/integrator/pt.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/integrator/camera.h"
#include "core/integrator/pt_scene.h"

namespace ptb {

namespace {

/// Of the kernel that adds tallies to the film. Fixed, since PoCL compiles once a size; every device
/// allows 32.
constexpr int add_work_group = 32;

std::uint64_t divide_up(std::uint64_t n, std::uint64_t d) { return (n + d - 1) / d; }

/// How one device is kept busy.
struct Shape {
    std::uint64_t items;           ///< work-items of a launch; they share one queue of units
    std::uint64_t max_units;       ///< of one launch: bounds the memory of their tallies
    std::uint64_t units_per_lane;  ///< a lane takes no more
    std::uint32_t
        samples_per_unit;  ///< the image depends on it, so on nothing but device, lanes, size and spp
};

std::uint64_t scene_bytes(std::uint64_t spheres) {
    return spheres * sizeof(PtSphere) + (spheres + 1) * sizeof(PtSurface);
}

constexpr std::uint64_t longest_unit = 32;  ///< samples

bool is_gpu(const ocl::Device& device) { return device.info.type != "CPU"; }

/// A GPU wants all its resident lanes busy, and a dozen units each, or the last ones to finish keep it
/// waiting. A CPU's thread takes units for as long as there are any, so a few items a core are enough.
Shape shape_of(const ocl::Device& device, const Scene& scene, const RenderJob& job) {
    const auto cores = static_cast<std::uint64_t>(std::max(device.info.compute_units, 1));
    const auto spp = static_cast<std::uint64_t>(job.spp);
    const std::uint64_t paths = paths_per_item(device, scene, job.path_length);
    const std::uint64_t busy = is_gpu(device) ? cores * 2048 : cores * static_cast<std::uint64_t>(job.lanes);
    const std::uint64_t fair = std::max<std::uint64_t>(job.size.pixels() * spp / (12 * busy), 1);
    const std::uint64_t runs = divide_up(spp, std::min({fair, longest_unit, paths}));
    Shape shape{is_gpu(device) ? busy : cores * 64, 0, 0, static_cast<std::uint32_t>(divide_up(spp, runs))};
    shape.max_units = is_gpu(device) ? 24 * shape.items : 1u << 18;
    shape.units_per_lane = std::min<std::uint64_t>(paths / shape.samples_per_unit, 0xffffffffu);
    return shape;
}

class PtRender : public Render {
  public:
    PtRender(const ocl::Device& device, const ocl::Program& program, const Scene& scene, const RenderJob& job)
        : device_(device), job_(job), shape_(shape_of(device, scene, job)), pixels_(job.size.pixels()) {
        runs_ = static_cast<std::uint32_t>(
            divide_up(static_cast<std::uint64_t>(job.spp), shape_.samples_per_unit));
        shape_.max_units = std::min<std::uint64_t>(shape_.max_units, pixels_ * runs_);
        const PtScene pt_scene = make_pt_scene(scene);
        launch_.camera = device_camera(scene.camera, job.size);
        launch_.width = static_cast<std::uint32_t>(job.size.width);
        launch_.samples_per_unit = shape_.samples_per_unit;
        launch_.spp = static_cast<std::uint32_t>(job.spp);
        launch_.path_length = static_cast<std::uint32_t>(job.path_length);
        launch_.units_per_lane = static_cast<std::uint32_t>(shape_.units_per_lane);
        launch_.seed = job.seed;
        launch_.distance_mask = ~std::uint32_t{15};
        launch_.camera_side = pt_scene.camera_sides.front();
        launch_.opaque_spheres = pt_scene.opaque;
        launch_.two_sided_spheres = pt_scene.two_sided;
        ocl::checked("pt buffers", device_.info.name, [&] {
            render_ = cl::Kernel(program.program, "pt_render");
            add_ = cl::Kernel(program.program, "pt_add");
            film_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE, pixels_ * sizeof(PtTally));
            tallies_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE, shape_.max_units * sizeof(PtTally));
            queue_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE, sizeof(std::uint32_t));
            spheres_ = upload(pt_scene.spheres);
            surfaces_ = upload(pt_scene.surfaces);
            sides_ = upload(pt_scene.camera_sides);
            few_ = pt_scene.few;
        });
        restart();
    }

    void restart() override {
        ocl::checked("pt restart", device_.info.name, [&] {
            device_.queue.enqueueFillBuffer(film_, 0u, 0, pixels_ * sizeof(PtTally));
            device_.queue.finish();
        });
        pixel_ = run_ = 0;
    }

    std::uint64_t samples_left() const override {
        const std::uint64_t done_before =
            std::min<std::uint64_t>(std::uint64_t{run_} * shape_.samples_per_unit, launch_.spp);
        const std::uint64_t in_run =
            std::min<std::uint64_t>(shape_.samples_per_unit, launch_.spp - done_before);
        return pixels_ * (launch_.spp - done_before) - pixel_ * in_run;
    }

    std::vector<LaunchTimes> advance(std::uint64_t samples) override {
        plan_launch(std::clamp<std::uint64_t>(samples / shape_.samples_per_unit, 1, shape_.max_units));
        const std::uint64_t lanes = static_cast<std::uint64_t>(job_.lanes);
        const std::uint64_t needed = launch_.units / shape_.units_per_lane + 1;
        const std::uint64_t wanted = std::min<std::uint64_t>(items(), launch_.units / lanes + 1);
        const Ranges ranges = one_dimensional(std::max(needed, wanted), job_.work_group_x);
        std::vector<cl::Event> events(2);
        ocl::checked("pt_render, " + describe(ranges), device_.info.name, [&] {
            device_.queue.enqueueFillBuffer(queue_, 0u, 0, sizeof(std::uint32_t));
            render_.setArg(0, tallies_);
            render_.setArg(1, queue_);
            render_.setArg(2, spheres_);
            render_.setArg(3, surfaces_);
            render_.setArg(4, sides_);
            render_.setArg(5, few_);
            render_.setArg(6, launch_);
            device_.queue.enqueueNDRangeKernel(render_, cl::NullRange, ranges.global, ranges.local, nullptr,
                                               &events[0]);
            add_.setArg(0, film_);
            add_.setArg(1, tallies_);
            add_.setArg(2, launch_);
            const Ranges pixels = one_dimensional(launch_.pixels, add_work_group);
            device_.queue.enqueueNDRangeKernel(add_, cl::NullRange, pixels.global, pixels.local, nullptr,
                                               &events[1]);
            device_.queue.finish();
        });
        step_on();
        return times_of(events, device_);
    }

    Film read_film() override {
        std::vector<PtTally> tallies(pixels_);
        ocl::checked("pt film", device_.info.name, [&] {
            device_.queue.enqueueReadBuffer(film_, CL_TRUE, 0, pixels_ * sizeof(PtTally), tallies.data());
        });
        Film film;
        film.mean = {job_.size, std::vector<float>(pixels_ * 3)};
        film.variance = film.mean;
        film.samples = film.full_length_paths = 0;
        for (std::size_t i = 0; i < pixels_; ++i) {
            const PtTally& tally = tallies[i];
            store_pixel(tally, &film.mean.rgb[3 * i], &film.variance->rgb[3 * i]);
            *film.samples += tally.samples;
            film.segments += tally.segments;
            *film.full_length_paths += tally.full_length_paths;
        }
        return film;
    }

    ocl::KernelFacts facts() const override { return kernel_facts(device_, render_); }
    std::uint64_t device_bytes() const override {
        return (pixels_ + shape_.max_units) * sizeof(PtTally) +
               scene_bytes(launch_.opaque_spheres + launch_.two_sided_spheres);
    }

  private:
    template <class Row>
    cl::Buffer upload(const std::vector<Row>& rows) const {
        std::vector<Row> copy = rows;
        return {device_.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, copy.size() * sizeof(Row),
                copy.data()};
    }

    static void store_pixel(const PtTally& tally, float* mean, float* variance) {
        const double n = tally.samples;
        const float sums[3] = {tally.radiance.x, tally.radiance.y, tally.radiance.z};
        const float squares[3] = {tally.squares.x, tally.squares.y, tally.squares.z};
        for (int c = 0; c < 3; ++c) {
            const double m = n > 0 ? sums[c] / n : 0;
            mean[c] = static_cast<float>(m);
            variance[c] = n > 1 ? static_cast<float>(std::max(squares[c] - n * m * m, 0.0) / (n - 1)) : 0.0f;
        }
    }

    /// At least four work-groups a compute unit: one that is alone keeps the others idle.
    std::uint64_t items() const {
        const auto group = static_cast<std::uint64_t>(std::max(job_.work_group_x, 1));
        return std::max(shape_.items, 4 * group * static_cast<std::uint64_t>(device_.info.compute_units));
    }

    /// Whole runs of the image while the budget holds one, else a band of pixels of one run.
    void plan_launch(std::uint64_t units) {
        const std::uint64_t runs = pixel_ == 0 ? std::min<std::uint64_t>(units / pixels_, runs_ - run_) : 0;
        launch_.first_pixel = static_cast<std::uint32_t>(pixel_);
        launch_.pixels = static_cast<std::uint32_t>(runs > 0 ? pixels_ : std::min(units, pixels_ - pixel_));
        launch_.first_run = run_;
        launch_.units = static_cast<std::uint32_t>(launch_.pixels * std::max<std::uint64_t>(runs, 1));
    }

    void step_on() {
        pixel_ += launch_.pixels;
        if (pixel_ < pixels_) return;
        pixel_ = 0;
        run_ += launch_.units / launch_.pixels;
    }

    ocl::Device device_;
    RenderJob job_;
    Shape shape_;
    std::uint64_t pixels_;
    std::uint64_t pixel_ = 0;  ///< first pixel of the next launch
    std::uint32_t run_ = 0;    ///< its run of samples
    std::uint32_t runs_ = 0;
    cl::Kernel render_, add_;
    cl::Buffer film_, tallies_, queue_, spheres_, surfaces_, sides_;
    PtFewSpheres few_{};
    PtLaunch launch_{};
};

/// An emitter that also scatters.
bool glows(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& m) { return m.scatters && dot(m.radiance, m.radiance) > 0; });
}

std::string options(const ocl::Device& device, const Scene& scene, int lanes) {
    const PtScene pt_scene = make_pt_scene(scene);
    const std::size_t bytes = pt_scene.surfaces.size() * (sizeof(PtSurface) + sizeof(PtSphere));
    const bool few = pt_scene.spheres.size() <= PT_FEW_MOST;
    std::string text =
        fmt::format("-cl-std=CL1.2 -DPTB_LANES={} -DPT_SIDE_WORDS={}", lanes, pt_scene.camera_sides.size());
    if (bytes > device.info.constant_bytes) text += " -DPT_SCENE_SPACE=__global";
    if (few) text += fmt::format(" -DPT_FEW={} -DPT_OPAQUE={}", pt_scene.spheres.size(), pt_scene.opaque);
    if (glows(scene)) text += " -DPT_GLOWS";
    if (is_gpu(device) && lanes == 1) text += " -DPT_BATCH=6";
    if (is_gpu(device) && lanes == 1 && few) text += " -DPT_CARRIED -DPT_LOCAL_SURFACES";
    return text;
}

Integrator::Memory memory(const ocl::Device& device, const Scene& scene, const RenderJob& job) {
    const Shape shape = shape_of(device, scene, job);
    const std::uint64_t units =
        job.size.pixels() * divide_up(static_cast<std::uint64_t>(job.spp), shape.samples_per_unit);
    const std::uint64_t film = job.size.pixels() * sizeof(PtTally);
    const std::uint64_t tallies = std::min(shape.max_units, units) * sizeof(PtTally);
    return {film + tallies + scene_bytes(scene.spheres.size()), std::max(film, tallies)};
}

std::unique_ptr<Render> make(const ocl::Device& device, const ocl::Program& program, const Scene& scene,
                             const RenderJob& job) {
    return std::make_unique<PtRender>(device, program, scene, job);
}

}  // namespace

Integrator pt_integrator() {
    return {"pt",       "physically right path tracer: no next-event estimation, no roulette",
            "pt/pt.cl", {1, 4, 8, 16, 32},
            false,      true,
            options,    memory,
            make};
}

}  // namespace ptb
