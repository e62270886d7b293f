#include "core/integrator/pt.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/integrator/camera.h"
#include "core/integrator/pt_film.h"
#include "core/integrator/pt_options.h"
#include "core/integrator/pt_runs.h"
#include "core/integrator/pt_scene.h"
#include "core/render/launcher.h"

namespace ptb {

namespace {

std::uint64_t divide_up(std::uint64_t n, std::uint64_t d) { return (n + d - 1) / d; }

/// How one device is kept busy.
struct Shape {
    std::uint64_t items;           ///< work-items of a launch; they share one queue of units
    std::uint64_t max_units;       ///< of one launch: bounds the memory of their tallies
    std::uint64_t units_per_lane;  ///< a lane takes no more
    PtRuns runs;  ///< the image depends on them, so on nothing but device, lanes, size and spp
};

constexpr std::uint64_t longest_round = 512;  ///< samples
static_assert(longest_round < PT_FULL_LENGTH);

std::uint64_t most_a_round(const RenderJob& job) {
    const bool asked = job.round_spp > 0;
    return asked ? std::min(longest_round, static_cast<std::uint64_t>(job.round_spp)) : longest_round;
}

/// A GPU wants all its resident lanes busy, and a dozen units each, or the last ones to finish keep it
/// waiting. A CPU's thread takes units for as long as there are any, so a few items a core are enough.
Shape shape_of(const ocl::Device& device, const Scene& scene, const RenderJob& job) {
    const auto cores = static_cast<std::uint64_t>(std::max(device.info.compute_units, 1));
    const auto spp = static_cast<std::uint64_t>(job.spp);
    const std::uint64_t paths = paths_per_item(device, scene, job.path_length);
    const std::uint64_t busy =
        is_throughput_device(device) ? cores * 2048 : cores * static_cast<std::uint64_t>(job.lanes);
    const std::uint64_t fair = std::max<std::uint64_t>(job.size.pixels() * spp / (12 * busy), 1);
    Shape shape{is_throughput_device(device) ? busy : cores * 64, 0, 0,
                make_pt_runs(static_cast<std::uint32_t>(spp), fair, std::min(most_a_round(job), paths))};
    shape.max_units = is_throughput_device(device) ? 24 * shape.items : 1u << 18;
    shape.units_per_lane = std::min<std::uint64_t>(paths / shape.runs.longest(), 0xffffffffu);
    return shape;
}

void stratify(PtLaunch& launch, std::uint32_t spp) {
    const std::uint32_t columns = strata_columns(spp), rows = spp / columns;
    launch.strata_columns = columns;
    launch.stratum_width = 1.0f / static_cast<float>(columns);
    launch.stratum_height = 1.0f / static_cast<float>(rows);
}

class PtRender : public Render {
  public:
    PtRender(const ocl::Device& device, const ocl::Program& program, const Scene& scene, const RenderJob& job)
        : device_(device),
          job_(job),
          shape_(shape_of(device, scene, job)),
          pixels_(job.size.pixels()),
          launcher_(device, job.variant),
          counted_(device, program) {
        shape_.max_units = std::min<std::uint64_t>(shape_.max_units, pixels_ * shape_.runs.count());
        const PtScene pt_scene = make_pt_scene(scene);
        scene_bytes_ = pt_scene.bytes();
        launch_.camera = device_camera(scene.camera, job.size);
        launch_.width = static_cast<std::uint32_t>(job.size.width);
        launch_.inverse_width = 1.0f / static_cast<float>(job.size.width);
        launch_.path_length = static_cast<std::uint32_t>(job.path_length);
        launch_.units_per_lane = static_cast<std::uint32_t>(shape_.units_per_lane);
        launch_.seed = job.seed;
        launch_.opaque_spheres = pt_scene.opaque;
        launch_.two_sided_spheres = pt_scene.two_sided;
        stratify(launch_, static_cast<std::uint32_t>(job.spp));
        ocl::checked("pt buffers", device_.info.name, [&] {
            render_ = cl::Kernel(program.program, "pt_render");
            counted_.give(render_);
            film_ = make_pt_film(device_, program.program, job.size, job.variant.film_memory, counted_);
            tallies_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE, shape_.max_units * sizeof(PtTally));
            counters_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE,
                                   slices_of(shape_.max_units) * sizeof(std::uint32_t));
            spheres_ = upload(pt_scene.spheres);
            surfaces_ = upload(pt_scene.surfaces);
            sides_ = upload(pt_scene.camera_sides);
            starts_ = upload(shape_.runs.starts);
            few_ = pt_scene.few;
        });
        restart();
    }

    void restart() override {
        ocl::checked("pt restart", device_.info.name, [&] {
            film_->clear(launcher_.queue());
            launcher_.queue().finish();
        });
        counted_.clear();
        pixel_ = run_ = 0;
    }

    std::uint64_t samples_left() const override {
        const std::uint64_t left = shape_.runs.starts.back() - shape_.runs.starts[run_];
        return left == 0 ? 0 : pixels_ * left - pixel_ * shape_.runs.length(run_);
    }

    std::vector<LaunchTimes> advance(std::uint64_t samples) override {
        plan_launch(samples);
        const std::uint64_t slices = slices_of(launch_.units);
        const Ranges ranges = ranges_of(launch_.units / slices);
        const auto times = ocl::checked("pt_render, " + describe(ranges), device_.info.name, [&] {
            launcher_.queue().enqueueFillBuffer(counters_, 0u, 0, slices * sizeof(std::uint32_t));
            launcher_.barrier();
            for (std::uint64_t i = 0; i < slices; ++i) launch_slice(i, slices);
            launcher_.barrier();
            film_->add(launcher_, tallies_, launch_);
            return launcher_.finish();
        });
        step_on();
        return times;
    }

    Film read_film() override {
        Film film;
        film.mean = {job_.size, std::vector<float>(pixels_ * 3)};
        film.variance = film.mean;
        film.samples = film.full_length_paths = 0;
        for (int row = 0; row < job_.size.height; row += rows_at_once) {
            const int rows = std::min(rows_at_once, job_.size.height - row);
            const std::vector<PtTally> tallies = ocl::checked(
                "pt film", device_.info.name, [&] { return film_->read(launcher_.queue(), row, rows); });
            store_tallies(tallies, Size{job_.size.width, row}.pixels(), film);
        }
        return film;
    }

    ocl::KernelFacts facts() const override { return kernel_facts(device_, render_); }
    std::optional<Counts> counts() const override { return counted_.read(); }
    std::uint64_t device_bytes() const override {
        return film_->bytes() + shape_.max_units * sizeof(PtTally) + scene_bytes_;
    }

  private:
    template <class Row>
    cl::Buffer upload(const std::vector<Row>& rows) const {
        std::vector<Row> copy = rows;
        return {device_.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, copy.size() * sizeof(Row),
                copy.data()};
    }

    static constexpr int rows_at_once = 256;  ///< of the film, on the host

    static void store_tallies(const std::vector<PtTally>& tallies, std::size_t first_pixel, Film& film) {
        for (std::size_t i = 0; i < tallies.size(); ++i) {
            const PtTally& tally = tallies[i];
            const std::size_t at = 3 * (first_pixel + i);
            store_pixel(tally, &film.mean.rgb[at], &film.variance->rgb[at]);
            *film.samples += tally.samples;
            film.segments += tally.segments;
            *film.full_length_paths += tally.full_length_paths;
        }
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

    /// Parts of a pass that are launched for themselves. A task may hold no more units than a work-item may
    /// take.
    std::uint64_t slices_of(std::uint64_t units) const {
        const auto lanes = static_cast<std::uint64_t>(job_.lanes);
        const std::uint64_t slices = launcher_.slices(divide_up(units, lanes));
        if (job_.variant.dispatch == Dispatch::ndrange) return slices;
        return std::max(slices, divide_up(units, shape_.units_per_lane * lanes));
    }

    Ranges ranges_of(std::uint64_t units) const {
        const std::uint64_t needed = units / shape_.units_per_lane + 1;
        const std::uint64_t wanted =
            std::min<std::uint64_t>(items(), units / static_cast<std::uint64_t>(job_.lanes) + 1);
        return launcher_.ranges(std::max(needed, wanted), job_.work_group_x);
    }

    void launch_slice(std::uint64_t slice, std::uint64_t slices) {
        PtLaunch part = launch_;
        part.slice = static_cast<std::uint32_t>(slice);
        part.first_unit = static_cast<std::uint32_t>(launch_.units * slice / slices);
        part.units = static_cast<std::uint32_t>(launch_.units * (slice + 1) / slices);
        render_.setArg(0, tallies_);
        render_.setArg(1, counters_);
        render_.setArg(2, spheres_);
        render_.setArg(3, surfaces_);
        render_.setArg(4, sides_);
        render_.setArg(5, starts_);
        render_.setArg(6, few_);
        render_.setArg(7, part);
        launcher_.launch(render_, ranges_of(part.units - part.first_unit));
    }

    /// At least four work-groups a compute unit: one that is alone keeps the others idle.
    std::uint64_t items() const {
        const auto group = static_cast<std::uint64_t>(std::max(job_.work_group_x, 1));
        return std::max(shape_.items, 4 * group * static_cast<std::uint64_t>(device_.info.compute_units));
    }

    /// Whole runs of the image, if the budget holds one, else a band of pixels of one run.
    void plan_launch(std::uint64_t samples) {
        const std::uint32_t runs = pixel_ == 0 ? whole_runs(samples) : 0;
        const std::uint64_t band =
            std::clamp<std::uint64_t>(samples / shape_.runs.length(run_), 1, shape_.max_units);
        launch_.first_pixel = static_cast<std::uint32_t>(pixel_);
        launch_.pixels = static_cast<std::uint32_t>(runs > 0 ? pixels_ : std::min(band, pixels_ - pixel_));
        launch_.inverse_pixels = 1.0f / static_cast<float>(launch_.pixels);
        launch_.first_run = run_;
        launch_.units = launch_.pixels * std::max(runs, 1u);
    }

    /// As many as the budget holds, to the end of a round if there is one among them.
    std::uint32_t whole_runs(std::uint64_t samples) const {
        const auto& starts = shape_.runs.starts;
        std::uint32_t end = run_, round_end = run_;
        while (end < shape_.runs.count() && (starts[end + 1] - starts[run_]) * pixels_ <= samples &&
               (end + 1 - run_) * pixels_ <= shape_.max_units) {
            if (shape_.runs.ends_round(end)) round_end = end + 1;
            ++end;
        }
        return (round_end > run_ ? round_end : end) - run_;
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
    std::uint64_t pixels_, scene_bytes_ = 0;
    std::uint64_t pixel_ = 0;  ///< first pixel of the next launch
    std::uint32_t run_ = 0;    ///< its run of samples
    Launcher launcher_;
    CountedRows counted_;
    cl::Kernel render_;
    std::unique_ptr<PtFilm> film_;
    cl::Buffer tallies_, counters_, spheres_, surfaces_, sides_, starts_;
    PtFewSpheres few_{};
    PtLaunch launch_{};
};

Integrator::Memory memory(const ocl::Device& device, const Scene& scene, const RenderJob& job) {
    const Shape shape = shape_of(device, scene, job);
    const std::uint64_t units = job.size.pixels() * shape.runs.count();
    const std::uint64_t film = pt_film_bytes(job.size, job.variant.film_memory);
    const std::uint64_t tallies = std::min(shape.max_units, units) * sizeof(PtTally);
    return {film + tallies + make_pt_scene(scene).bytes(),
            std::max(pt_film_largest(job.size, job.variant.film_memory), tallies)};
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
            pt_options, pt_refusal,
            memory,     make};
}

}  // namespace ptb
