#include "core/integrator/engine.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/integrator/camera.h"
#include "core/integrator/device_meshes.h"
#include "core/integrator/engine_options.h"
#include "core/integrator/film.h"
#include "core/integrator/gradients.h"
#include "core/integrator/large_buffer.h"
#include "core/integrator/splats.h"
#include "core/integrator/unit_cut.h"
#include "core/render/film_hash.h"

namespace ptb {

namespace {

std::uint64_t divide_up(std::uint64_t n, std::uint64_t d) { return (n + d - 1) / d; }

/// How one device is kept busy.
struct Shape {
    std::uint64_t items;           ///< work-items of a launch; they share one queue of units
    std::uint64_t max_units;       ///< of one launch: bounds the memory of their tallies
    std::uint64_t units_per_lane;  ///< a lane takes no more
    RunCut cut;                    ///< the image depends on it, so on nothing but device, lanes, size and spp
    Runs runs;
};

constexpr std::uint64_t longest_round = 512;  ///< samples
static_assert(longest_round < ENGINE_FULL_LENGTH);

std::uint64_t most_a_round(const RenderJob& job) {
    const bool asked = job.round_spp > 0;
    return asked ? std::min(longest_round, static_cast<std::uint64_t>(job.round_spp)) : longest_round;
}

/// A GPU wants all its resident lanes busy, and a dozen units each, or the last ones to finish keep it
/// waiting. A CPU's thread takes units for as long as there are any, so a few items a core are enough.
Shape shape_of(const Integrator& row, const ocl::Device& device, const Scene& scene, const RenderJob& job) {
    const auto cores = static_cast<std::uint64_t>(std::max(device.info.compute_units, 1));
    const auto spp = static_cast<std::uint64_t>(job.spp);
    const std::uint64_t paths = paths_per_item(device, scene, most_rays(row, job.path_length));
    const std::uint64_t busy =
        is_throughput_device(device) ? cores * 2048 : cores * static_cast<std::uint64_t>(job.lanes);
    const std::uint64_t fair = std::max<std::uint64_t>(job.size.pixels() * spp / (12 * busy), 1);
    const RunCut cut = job.cut.value_or(RunCut{fair, std::min(most_a_round(job), paths)});
    Shape shape{is_throughput_device(device) ? busy : cores * 64, 0, 0, cut,
                make_runs(static_cast<std::uint32_t>(spp), cut.fair, cut.most)};
    if (row.gradients) shape.runs = in_halves(static_cast<std::uint32_t>(spp), cut);
    shape.max_units = is_throughput_device(device) ? 24 * shape.items : 1u << 18;
    shape.units_per_lane = std::min<std::uint64_t>(paths / shape.runs.longest(), 0xffffffffu);
    return shape;
}

void stratify(EngineLaunch& launch, std::uint32_t spp) {
    const std::uint32_t columns = strata_columns(spp), rows = spp / columns;
    launch.strata_columns = columns;
    launch.stratum_width = 1.0f / static_cast<float>(columns);
    launch.stratum_height = 1.0f / static_cast<float>(rows);
}

template <class Row>
cl::Buffer upload(const ocl::Device& device, const std::vector<Row>& rows) {
    static const Row none{};
    const Row* first = rows.empty() ? &none : rows.data();
    return {device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
            std::max<std::size_t>(rows.size(), 1) * sizeof(Row), const_cast<Row*>(first)};
}

/// A scene on a device. No spheres or lamps are one row of zeros, since there is no empty buffer.
struct SceneBuffers {
    cl::Buffer spheres, surfaces, sides, lamps;
    std::vector<cl::Buffer> tree;  ///< nodes and leaves, where there are triangles; and
    TreeGrid grid{};
    cl::Buffer triangles;
    SceneFewSpheres few{};
    std::uint64_t bytes = 0;

    SceneBuffers(const ocl::Device& device, const DeviceScene& scene)
        : spheres(upload(device, scene.spheres)),
          surfaces(upload(device, scene.surfaces)),
          sides(upload(device, scene.camera_sides)),
          lamps(upload(device, scene.lamps)),
          few(scene.few),
          bytes(scene.bytes()) {
        if (!scene.has_meshes) return;
        tree = tree_buffers(device, *scene.meshes.tree);
        grid = scene.meshes.tree->grid;
        triangles = large_buffer(device, std::as_bytes(std::span(scene.meshes.triangles)));
    }
};

double least_chance(const DeviceScene& scene) {
    double least = 1;
    for (const SceneLamp& lamp : scene.lamps) least = std::min<double>(least, lamp.chance);
    return std::max(least, 1e-6);
}

/// What no launch of a job changes.
EngineLaunch launch_of(const Scene& scene, const DeviceScene& device_scene, const RenderJob& job,
                       const Shape& shape, const FilmScale& scale) {
    EngineLaunch launch{};
    launch.camera = device_camera(scene.camera, job.size);
    launch.width = static_cast<std::uint32_t>(job.size.width);
    launch.inverse_width = 1.0f / static_cast<float>(job.size.width);
    launch.path_length = static_cast<std::uint32_t>(job.path_length);
    launch.units_per_lane = static_cast<std::uint32_t>(shape.units_per_lane);
    launch.seed = job.seed;
    launch.opaque_spheres = device_scene.opaque;
    launch.two_sided_spheres = device_scene.two_sided;
    launch.lamps = static_cast<std::uint32_t>(device_scene.lamps.size());
    launch.lamp = device_scene.lone_lamp;
    launch.radiance_scale = std::ldexp(1.0f, scale.radiance);
    launch.squares_scale = std::ldexp(1.0f, scale.squares);
    launch.height = static_cast<std::uint32_t>(job.size.height);
    launch.picture = device_picture(scene.camera, job.size);
    stratify(launch, static_cast<std::uint32_t>(job.spp));
    return launch;
}

class EngineRender : public PartRender {
  public:
    EngineRender(const Integrator& row, const ocl::Device& device, const ocl::Program& program,
                 const Scene& scene, const RenderJob& job)
        : EngineRender(row, device, program, scene, device_scene_for(row, device, scene, job), job) {}

    void restart() override {
        ocl::checked(row_.id + " restart", device_.info.name, [&] {
            film_->clear(launcher_.queue());
            if (splats_) splats_->clear(launcher_.queue());
            if (gradients_) gradients_->clear(launcher_.queue());
            launcher_.queue().finish();
        });
        counted_.clear();
        cut_.restart();
    }

    std::uint64_t samples_left() const override { return cut_.samples_left(); }

    std::vector<LaunchTimes> advance(std::uint64_t samples) override {
        const UnitPiece piece = cut_.next(samples);
        launch_.first_pixel = piece.first_pixel;
        launch_.pixels = piece.pixels;
        launch_.inverse_pixels = 1.0f / static_cast<float>(piece.pixels);
        launch_.first_run = piece.first_run;
        launch_.units = piece.units;
        auto times = launch_units();
        cut_.step_over(piece);
        if (gradients_ && cut_.samples_left() == 0) add_reconstruction(times);
        return times;
    }

    Film read_film() override {
        Film film = empty_film(job_.size, row_.independent_pixels);
        FilmHash hash;
        std::vector<FilmPixel> room;
        for (const Band& band : bands()) {
            room.resize(band.count);
            film.light_segments += read(band, room);
            store_pixels(room, band.first, scale_, film);
            hash.add(std::span<const FilmPixel>(room));
        }
        if (gradients_) take_gradients(film, hash);
        film.hash = hash.text();
        return film;
    }

    RunCut cut() const override { return shape_.cut; }
    std::uint64_t parts() const override { return cut_.parts(); }
    void take(PartRange parts) override { cut_.take(parts); }
    PartRange parts_left() const override { return cut_.left(); }

    FilmFacts read_sums(std::span<FilmPixel> pixels) override {
        FilmFacts facts{job_.size, scale_, row_.independent_pixels};
        for (const Band& band : bands())
            facts.light_segments += read(band, pixels.subspan(band.first, band.count));
        return facts;
    }

    ocl::KernelFacts facts() const override { return kernel_facts(device_, render_); }
    std::optional<Counts> counts() const override { return counted_.read(); }
    std::uint64_t device_bytes() const override {
        return film_->bytes() + (splats_ ? splats_->bytes() : 0) + (gradients_ ? gradients_->bytes() : 0) +
               cut_.max_units() * sizeof(Tally) + scene_->bytes;
    }

  private:
    EngineRender(const Integrator& row, const ocl::Device& device, const ocl::Program& program,
                 const Scene& scene, const DeviceScene& device_scene, const RenderJob& job)
        : row_(row),
          device_(device),
          job_(job),
          shape_(shape_of(row, device, scene, job)),
          cut_(shape_.runs, job.size.pixels(), shape_.max_units),
          scale_(film_scale(scene, job, least_chance(device_scene))),
          launcher_(device, job.variant),
          counted_(device, program),
          launch_(launch_of(scene, device_scene, job, shape_, scale_)) {
        ocl::checked(row.id + " buffers", device_.info.name, [&] {
            render_ = cl::Kernel(program.program, row.kernel("render").c_str());
            counted_.give(render_);
            film_ = make_film_store(device_, program.program, row.id, job, counted_);
            if (!row.independent_pixels) splats_.emplace(device_, job.size);
            if (row.gradients) gradients_.emplace(device_, program.program, row.id, job, scale_);
            tallies_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE, cut_.max_units() * sizeof(Tally));
            counters_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE,
                                   2 * slices_of(cut_.max_units()) * sizeof(std::uint32_t));
            starts_ = upload(device_, shape_.runs.starts);
            scene_.emplace(device_, device_scene);
        });
        restart();
    }

    /// Whole rows of the film: a large one would take twice its size on the host at once.
    struct Band {
        int first_row;
        std::size_t first, count;  ///< pixels
    };
    std::vector<Band> bands() const {
        constexpr int rows_at_once = 256;
        std::vector<Band> all;
        for (int row = 0; row < job_.size.height; row += rows_at_once)
            all.push_back({row, Size{job_.size.width, row}.pixels(),
                           Size{job_.size.width, std::min(rows_at_once, job_.size.height - row)}.pixels()});
        return all;
    }

    /// Returns the segments of paths from lamps.
    std::uint64_t read(const Band& band, std::span<FilmPixel> pixels) {
        return ocl::checked(row_.id + " film", device_.info.name, [&]() -> std::uint64_t {
            film_->read(launcher_.queue(), band.first_row, pixels);
            return splats_ ? splats_->add_to(pixels, launcher_.queue(), band.first_row) : 0;
        });
    }

    std::vector<LaunchTimes> launch_units() {
        const std::uint64_t slices = slices_of(launch_.units);
        const Ranges ranges = ranges_of(launch_.units / slices);
        const std::string what = row_.kernel("render") + ", " + describe(ranges);
        return ocl::checked(what, device_.info.name, [&] {
            launcher_.queue().enqueueFillBuffer(counters_, 0u, 0, 2 * slices * sizeof(std::uint32_t));
            launcher_.barrier();
            for (std::uint64_t i = 0; i < slices; ++i) launch_slice(i, slices);
            launcher_.barrier();
            film_->add(launcher_, tallies_, launch_);
            return launcher_.finish();
        });
    }

    /// The picture is made once all samples are there; its time is theirs.
    void add_reconstruction(std::vector<LaunchTimes>& times) {
        const auto more = ocl::checked(row_.id + " reconstruction", device_.info.name, [&] {
            gradients_->reconstruct(launcher_, static_cast<std::uint32_t>(job_.spp));
            return launcher_.finish();
        });
        times.insert(times.end(), more.begin(), more.end());
    }

    /// Every pixel has as many samples, or the picture is of no use.
    void take_gradients(Film& film, FilmHash& hash) {
        const auto samples = static_cast<std::uint32_t>(*film.samples / job_.size.pixels());
        film.mean = ocl::checked(row_.id + " reconstruction", device_.info.name, [&] {
            const std::vector<GradientPixel> sums = gradients_->read_sums(launcher_.queue());
            hash.add(std::span<const GradientPixel>(sums));
            Image image = gradients_->picture(launcher_, samples, sums);
            launcher_.finish();
            return image;
        });
        const Reconstruction method = job_.variant.reconstruction;
        film.reconstructed = method != Reconstruction::none || is_of_gradients(job_.aov);
        film.biased = method == Reconstruction::l1;
    }

    void launch_slice(std::uint64_t slice, std::uint64_t slices) {
        EngineLaunch part = launch_;
        part.slice = static_cast<std::uint32_t>(slice);
        part.light_slice = static_cast<std::uint32_t>(slices + slice);
        part.first_unit = static_cast<std::uint32_t>(launch_.units * slice / slices);
        part.units = static_cast<std::uint32_t>(launch_.units * (slice + 1) / slices);
        cl_uint i = 0;
        const auto give = [&](const auto& argument) { render_.setArg(i++, argument); };
        give(tallies_), give(counters_), give(scene_->spheres), give(scene_->surfaces), give(scene_->sides);
        give(starts_), give(scene_->lamps), give(scene_->few);
        for (const cl::Buffer& each : scene_->tree) give(each);
        if (!scene_->tree.empty()) give(scene_->grid), give(scene_->triangles);
        give(part);
        if (splats_) give(splats_->buffer());
        if (gradients_) give(gradients_->sums());
        launcher_.launch(render_, ranges_of(part.units - part.first_unit));
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

    /// At least four work-groups a compute unit: one that is alone keeps the others idle.
    std::uint64_t items() const {
        const auto group = static_cast<std::uint64_t>(std::max(job_.work_group_x, 1));
        return std::max(shape_.items, 4 * group * static_cast<std::uint64_t>(device_.info.compute_units));
    }

    const Integrator& row_;
    ocl::Device device_;
    RenderJob job_;
    Shape shape_;
    UnitCut cut_;
    FilmScale scale_;
    Launcher launcher_;
    CountedRows counted_;
    cl::Kernel render_;
    std::unique_ptr<FilmStore> film_;
    std::optional<SplatStore> splats_;
    std::optional<GradientStore> gradients_;
    cl::Buffer tallies_, counters_, starts_;
    std::optional<SceneBuffers> scene_;
    EngineLaunch launch_;
};

DeviceMemory memory(const Integrator& row, const ocl::Device& device, const Scene& scene,
                    const RenderJob& job) {
    const Shape shape = shape_of(row, device, scene, job);
    const std::uint64_t units = job.size.pixels() * shape.runs.count();
    const std::uint64_t film = film_bytes_of(job.size, job.variant.film_memory) +
                               (row.independent_pixels ? 0 : splat_bytes_of(job.size));
    const std::uint64_t gradients =
        row.gradients ? GradientStore::gradient_bytes_of(job.size, job.variant.reconstruction) : 0;
    const std::uint64_t tallies = std::min(shape.max_units, units) * sizeof(Tally);
    const DeviceScene device_scene = device_scene_for(row, device, scene, job);
    const DeviceMeshes& meshes = device_scene.meshes;
    return {film + gradients + tallies + device_scene.bytes(),
            std::max({largest_film_object(job.size, job.variant.film_memory), tallies, meshes.node_bytes(),
                      meshes.leaf_bytes(), meshes.triangle_bytes(),
                      row.gradients ? GradientStore::largest_object(job.size) : 0})};
}

std::string cut_refusal(const Integrator& row, const ocl::Device& device, const Scene& scene,
                        const RenderJob& job) {
    if (!job.cut) return "";
    const std::uint64_t paths = paths_per_item(device, scene, most_rays(row, job.path_length));
    const std::uint64_t most = std::min(longest_round, paths);
    if (job.cut->fair > 0 && job.cut->most > 0 && job.cut->most <= most) return "";
    return fmt::format("an image cut into rounds of {} samples: this device takes at most {}", job.cut->most,
                       most);
}

std::string refusal(const Integrator& row, const ocl::Device& device, const Scene& scene,
                    const RenderJob& job) {
    const std::string reason = engine_refusal(row, device, scene, job);
    return reason.empty() ? cut_refusal(row, device, scene, job) : reason;
}

std::unique_ptr<Render> make(const Integrator& row, const ocl::Device& device, const ocl::Program& program,
                             const Scene& scene, const RenderJob& job) {
    return std::make_unique<EngineRender>(row, device, program, scene, job);
}

std::unique_ptr<PartRender> make_parts(const Integrator& row, const ocl::Device& device,
                                       const ocl::Program& program, const Scene& scene,
                                       const RenderJob& job) {
    return std::make_unique<EngineRender>(row, device, program, scene, job);
}

}  // namespace

const Machinery engine_machinery{engine_options, refusal, memory, make, make_parts};

}  // namespace ptb
