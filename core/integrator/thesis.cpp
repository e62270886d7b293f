#include "core/integrator/thesis.h"

#include <algorithm>
#include <bit>

#include "core/integrator/camera.h"
#include "core/integrator/variant_support.h"
#include "core/render/film_hash.h"
#include "core/render/launcher.h"
#include "shared/thesis.h"

namespace ptb {

namespace {

ThesisMaterial device_material(const Material& material) {
    ThesisMaterial m{};
    m.colour = device_vector(material.type == MaterialType::mirror ? material.reflectance : material.albedo);
    m.radiance = device_vector(material.radiance);
    m.type = material.type == MaterialType::mirror       ? THESIS_MIRROR
             : material.type == MaterialType::dielectric ? THESIS_DIELECTRIC
             : material.type == MaterialType::emitter    ? THESIS_EMITTER
                                                         : THESIS_MATTE;
    m.ior = static_cast<float>(material.ior);
    m.scatters = material.scatters ? 1 : 0;
    return m;
}

std::vector<ThesisSphere> device_spheres(const Scene& scene) {
    std::vector<ThesisSphere> spheres;
    for (const Sphere& sphere : scene.spheres)
        spheres.push_back({device_vector(sphere.centre, sphere.radius),
                           device_material(scene.materials[static_cast<std::size_t>(sphere.material)])});
    return spheres;
}

/// A start of Park and Miller's generator in [1, 2^31 - 2], from a mixing hash (splitmix64, by S. Vigna), so
/// that neighbours' streams are unrelated.
std::int32_t start_state(std::uint64_t pixel, std::uint32_t seed) {
    std::uint64_t z = (static_cast<std::uint64_t>(seed) << 32 | pixel) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return static_cast<std::int32_t>(z % 2147483646u + 1);
}

class ThesisRender : public Render {
  public:
    ThesisRender(const ocl::Device& device, const ocl::Program& program, const Scene& scene,
                 const RenderJob& job)
        : device_(device),
          job_(job),
          pixels_(job.size.pixels()),
          samples_per_launch_(paths_per_item(device, scene, job.path_length)),
          launcher_(device, job.variant),
          counted_(device, program) {
        ocl::checked("thesis buffers", device_.info.name, [&] {
            kernel_ = cl::Kernel(program.program, "thesis_render");
            counted_.give(kernel_);
            std::vector<ThesisSphere> spheres = device_spheres(scene);
            spheres_ = cl::Buffer(device_.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                                  spheres.size() * sizeof(ThesisSphere), spheres.data());
            result_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE, pixels_ * sizeof(ptb_float4));
            states_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE, pixels_ * sizeof(std::int32_t));
            launch_.camera = device_camera(scene.camera, job.size);
            launch_.sphere_count = static_cast<std::uint32_t>(spheres.size());
        });
        launch_.width = static_cast<std::uint32_t>(job.size.width);
        launch_.spp = static_cast<std::uint32_t>(job.spp);
        launch_.path_length = static_cast<std::uint32_t>(job.path_length);
        restart();
    }

    void restart() override {
        std::vector<std::int32_t> states(pixels_);
        for (std::size_t i = 0; i < pixels_; ++i) states[i] = start_state(i, job_.seed);
        ocl::checked("thesis restart", device_.info.name, [&] {
            launcher_.queue().enqueueFillBuffer(result_, ptb_float4{0, 0, 0, 0}, 0,
                                                pixels_ * sizeof(ptb_float4));
            launcher_.queue().enqueueWriteBuffer(states_, CL_TRUE, 0, pixels_ * sizeof(std::int32_t),
                                                 states.data());
            launcher_.queue().finish();
        });
        counted_.clear();
        done_ = 0;
    }

    std::uint64_t samples_left() const override {
        return pixels_ * static_cast<std::uint64_t>(job_.spp) - done_;
    }

    std::vector<LaunchTimes> advance(std::uint64_t samples) override {
        plan_launch(samples);
        const std::uint64_t rows_or_pixels = launch_.pixels / piece();
        const std::uint64_t slices = tasks() ? rows_or_pixels : launcher_.slices(rows_or_pixels);
        const auto times =
            ocl::checked("thesis_render, " + describe(ranges_of(launch_)), device_.info.name, [&] {
                for (std::uint64_t i = 0; i < slices; ++i)
                    launch_slice(rows_or_pixels * i / slices, rows_or_pixels * (i + 1) / slices);
                return launcher_.finish();
            });
        done_ += static_cast<std::uint64_t>(launch_.pixels) * launch_.samples;
        return times;
    }

    Film read_film() override {
        std::vector<ptb_float4> result(pixels_);
        ocl::checked("thesis film", device_.info.name, [&] {
            launcher_.queue().enqueueReadBuffer(result_, CL_TRUE, 0, pixels_ * sizeof(ptb_float4),
                                                result.data());
        });
        Film film;
        FilmHash hash;
        hash.add(std::span<const ptb_float4>(result));
        film.hash = hash.text();
        film.mean = {job_.size, {}};
        film.mean.rgb.reserve(pixels_ * 3);
        for (std::size_t i = 0; i < pixels_; ++i) {
            const ptb_float4& pixel = result[i];
            const float scale = scale_of(i);
            film.mean.rgb.insert(film.mean.rgb.end(), {pixel.x * scale, pixel.y * scale, pixel.z * scale});
            film.segments += static_cast<std::uint64_t>(pixel.w);
        }
        return film;
    }

    ocl::KernelFacts facts() const override { return kernel_facts(device_, kernel_); }
    std::optional<Counts> counts() const override { return counted_.read(); }
    std::uint64_t device_bytes() const override {
        return pixels_ * (sizeof(ptb_float4) + sizeof(std::int32_t)) +
               launch_.sphere_count * sizeof(ThesisSphere);
    }

  private:
    static constexpr std::uint64_t most_tasks = 1u << 16;  ///< of a pass: each has an event

    bool tasks() const { return job_.variant.dispatch == Dispatch::tasks; }
    /// Pixels that one launch does not part: of a two-dimensional range a row.
    std::uint64_t piece() const { return job_.work_group_y == 0 ? 1 : launch_.width; }

    Ranges ranges_of(const ThesisLaunch& launch) const {
        if (job_.work_group_y == 0) return launcher_.ranges(launch.pixels, job_.work_group_x);
        return two_dimensional(job_.size.width, static_cast<int>(launch.pixels / launch.width),
                               job_.work_group_x, job_.work_group_y);
    }

    void launch_slice(std::uint64_t first, std::uint64_t end) {
        ThesisLaunch part = launch_;
        part.first_pixel = static_cast<std::uint32_t>(launch_.first_pixel + first * piece());
        part.pixels = static_cast<std::uint32_t>((end - first) * piece());
        kernel_.setArg(0, result_);
        kernel_.setArg(1, states_);
        kernel_.setArg(2, spheres_);
        kernel_.setArg(3, part);
        launcher_.launch(kernel_, ranges_of(part));
    }

    /// Whole images while the budget holds one, else a band: a power of two of rows, or of pixels where a row
    /// is too much (one dimension only). So ranges come in few sizes, and a runtime that chooses the
    /// work-group by the range, or compiles for it, does so seldom. A pixel's samples stay in order, so the
    /// cut changes nothing.
    void plan_launch(std::uint64_t samples) {
        const std::uint64_t at = done_ % pixels_;
        const bool whole = at == 0 && samples >= pixels_ && !(tasks() && pixels_ > most_tasks);
        if (tasks()) samples = std::min(samples, whole ? samples : most_tasks);
        launch_.first_pixel = static_cast<std::uint32_t>(at);
        launch_.pixels = static_cast<std::uint32_t>(whole ? pixels_ : band(std::min(samples, pixels_ - at)));
        launch_.samples = 1;
        if (whole)
            launch_.samples = static_cast<std::uint32_t>(
                std::min({samples / pixels_, samples_left() / pixels_, samples_per_launch_}));
    }

    std::uint64_t band(std::uint64_t pixels) const {
        const std::uint64_t width = launch_.width;
        if (pixels < width && job_.work_group_y == 0)
            return std::bit_floor(std::max<std::uint64_t>(pixels, 1));
        return width * std::bit_floor(std::max<std::uint64_t>(pixels / width, 1));
    }

    /// The kernel divides by the whole job's samples; a pixel that has fewer so far is scaled up.
    float scale_of(std::size_t pixel) const {
        const std::uint64_t samples = done_ / pixels_ + (pixel < done_ % pixels_ ? 1 : 0);
        return samples == 0 ? 0.0f : static_cast<float>(job_.spp) / static_cast<float>(samples);
    }

    ocl::Device device_;
    RenderJob job_;
    std::uint64_t pixels_, samples_per_launch_;
    std::uint64_t done_ = 0;
    Launcher launcher_;
    CountedRows counted_;
    cl::Kernel kernel_;
    cl::Buffer result_, states_, spheres_;
    ThesisLaunch launch_{};
};

std::string options(const Integrator&, const ocl::Device& device, const Scene&, const RenderJob& job) {
    return common_options(device, job);
}

std::string refusal(const Integrator& row, const ocl::Device&, const Scene&, const RenderJob& job) {
    for (const auto& [axis, has] : {std::pair("scene_memory", std::vector<std::string>{"auto", "global"}),
                                    std::pair("film_memory", std::vector<std::string>{"buffer"}),
                                    std::pair("pixel_filter", std::vector<std::string>{"jitter"}),
                                    std::pair("rng", std::vector<std::string>{"auto", "park_miller"}),
                                    std::pair("roulette", std::vector<std::string>{"off"})})
        if (const std::string reason = choice_refusal(row.id, axis, job.variant, has); !reason.empty())
            return reason;
    return "";
}

DeviceMemory memory(const Integrator&, const ocl::Device&, const Scene& scene, const RenderJob& job) {
    const std::uint64_t film = job.size.pixels() * sizeof(ptb_float4);
    return {film + job.size.pixels() * sizeof(std::int32_t) + scene.spheres.size() * sizeof(ThesisSphere),
            film};
}

std::unique_ptr<Render> make(const Integrator&, const ocl::Device& device, const ocl::Program& program,
                             const Scene& scene, const RenderJob& job) {
    return std::make_unique<ThesisRender>(device, program, scene, job);
}

}  // namespace

const Machinery thesis_machinery{options, refusal, memory, make, nullptr};

}  // namespace ptb
