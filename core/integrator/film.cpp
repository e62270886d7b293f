#include "core/integrator/film.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <fmt/format.h>

namespace ptb {

namespace {

/// Of the kernels that add tallies to the film. Fixed, since PoCL compiles once a size; every device
/// allows 32.
constexpr int add_work_group = 32;

double largest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

/// The most that emitters can send into a ray: each the whole of it, and one that scatters also what it is
/// sent, and so on for as long as a path is.
double most_radiance(const Scene& scene, int path_length) {
    double radiance = 0, albedo = 0;
    for (const Material& material : scene.materials) {
        radiance = std::max(radiance, largest(material.radiance));
        if (material.scatters && largest(material.radiance) > 0)
            albedo = std::max(albedo, largest(material.albedo));
    }
    const double series = albedo < 1 ? 1 / (1 - albedo) : path_length;
    return radiance > 0 ? radiance * std::min<double>(series, path_length) : 1;
}

class BufferFilm : public FilmStore {
  public:
    BufferFilm(const ocl::Device& device, const cl::Program& program, const std::string& integrator,
               Size size, const CountedRows& counted)
        : size_(size),
          add_(program, (integrator + "_add").c_str()),
          film_(device.context, CL_MEM_READ_WRITE, bytes()) {
        counted.give(add_);
    }

    void clear(const cl::CommandQueue& queue) override { queue.enqueueFillBuffer(film_, 0u, 0, bytes()); }
    void add(Launcher& launcher, const cl::Buffer& tallies, const EngineLaunch& launch) override {
        add_.setArg(0, film_);
        add_.setArg(1, tallies);
        add_.setArg(2, launch);
        launcher.launch(add_, one_dimensional(launch.pixels, add_work_group));
    }
    void read(const cl::CommandQueue& queue, int first_row, std::span<FilmPixel> pixels) override {
        queue.enqueueReadBuffer(film_, CL_TRUE, Size{size_.width, first_row}.pixels() * sizeof(FilmPixel),
                                pixels.size_bytes(), pixels.data());
    }
    std::uint64_t bytes() const override { return film_bytes_of(size_, FilmMemory::buffer); }

  private:
    Size size_;
    cl::Kernel add_;
    cl::Buffer film_;
};

/// A kernel of OpenCL 1.2 cannot read an image that it writes: so there are two, and every launch fills the
/// other.
class ImageFilm : public FilmStore {
  public:
    ImageFilm(const ocl::Device& device, const cl::Program& program, const std::string& integrator, Size size,
              const CountedRows& counted)
        : size_(size), add_(program, (integrator + "_add_to_image").c_str()) {
        counted.give(add_);
        for (cl::Image2D& image : images_)
            image = cl::Image2D(device.context, CL_MEM_READ_WRITE,
                                cl::ImageFormat(CL_RGBA, CL_UNSIGNED_INT32), width(), height());
    }

    void clear(const cl::CommandQueue& queue) override {
        for (const cl::Image2D& image : images_)
            queue.enqueueFillImage(image, cl_uint4{{0, 0, 0, 0}}, {0, 0, 0}, {width(), height(), 1});
    }
    void add(Launcher& launcher, const cl::Buffer& tallies, const EngineLaunch& launch) override {
        add_.setArg(0, images_[0]);
        add_.setArg(1, images_[1]);
        add_.setArg(2, tallies);
        add_.setArg(3, launch);
        launcher.launch(add_, one_dimensional(size_.pixels(), add_work_group));
        std::swap(images_[0], images_[1]);
    }
    void read(const cl::CommandQueue& queue, int first_row, std::span<FilmPixel> pixels) override {
        const std::size_t rows = pixels.size() / width();
        std::array<std::vector<Texel>, FILM_LAYERS> layers;
        for (std::size_t i = 0; i < layers.size(); ++i) layers[i] = layer(queue, i, first_row, rows);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] = std::bit_cast<FilmPixel>(
                std::array<Texel, FILM_LAYERS>{layers[0][i], layers[1][i], layers[2][i], layers[3][i]});
    }
    std::uint64_t bytes() const override { return film_bytes_of(size_, FilmMemory::image); }

  private:
    using Texel = std::array<std::uint32_t, 4>;
    std::vector<Texel> layer(const cl::CommandQueue& queue, std::size_t number, int first_row,
                             std::size_t rows) const {
        std::vector<Texel> texels(width() * rows);
        const auto row =
            number * static_cast<std::size_t>(size_.height) + static_cast<std::size_t>(first_row);
        queue.enqueueReadImage(images_[0], CL_TRUE, {0, row, 0}, {width(), rows, 1}, 0, 0, texels.data());
        return texels;
    }
    std::size_t width() const { return static_cast<std::size_t>(size_.width); }
    std::size_t height() const { return static_cast<std::size_t>(size_.height) * FILM_LAYERS; }

    Size size_;
    cl::Kernel add_;
    std::array<cl::Image2D, 2> images_;  ///< the first holds the film
};

}  // namespace

FilmScale film_scale(const Scene& scene, const RenderJob& job, double least_chance) {
    const auto bits = [](double most) { return static_cast<int>(std::ceil(std::log2(most))); };
    constexpr int cost = 24;  // bits of a whole number that a float holds
    const int samples = bits(job.spp);
    const int radiance = job.aov == Aov::cost ? cost : bits(most_radiance(scene, job.path_length));
    constexpr int most_weight = 20, of_spared = 6;
    const int weight = std::min(bits(1 / least_chance), most_weight) +
                       (job.variant.roulette == Roulette::off ? 0 : of_spared);
    constexpr int room = 62, finest = 100;  // beyond, floats end
    return {std::clamp(room - 4 - samples - radiance - weight, -finest, finest),
            std::clamp(room - 6 - samples - 2 * radiance - weight, -finest, finest)};
}

std::unique_ptr<FilmStore> make_film_store(const ocl::Device& device, const cl::Program& program,
                                           const std::string& integrator, const RenderJob& job,
                                           const CountedRows& counted) {
    if (job.variant.film_memory == FilmMemory::image)
        return std::make_unique<ImageFilm>(device, program, integrator, job.size, counted);
    return std::make_unique<BufferFilm>(device, program, integrator, job.size, counted);
}

std::uint64_t largest_film_object(Size size, FilmMemory) { return size.pixels() * sizeof(FilmPixel); }

std::uint64_t film_bytes_of(Size size, FilmMemory memory) {
    return largest_film_object(size, memory) * (memory == FilmMemory::image ? 2 : 1);
}

std::string film_refusal(const ocl::Device& device, Size size, FilmMemory memory) {
    if (memory == FilmMemory::buffer) return "";
    if (!device.info.images) return "film_memory image: this device has no images";
    const std::uint64_t rows = static_cast<std::uint64_t>(size.height) * FILM_LAYERS;
    const std::uint64_t columns = static_cast<std::uint64_t>(size.width);
    const std::uint64_t most_rows = device.device.getInfo<CL_DEVICE_IMAGE2D_MAX_HEIGHT>();
    const std::uint64_t most_columns = device.device.getInfo<CL_DEVICE_IMAGE2D_MAX_WIDTH>();
    if (rows <= most_rows && columns <= most_columns) return "";
    return fmt::format("film_memory image: {}x{} pixels need an image of {}x{}, this device allows {}x{}",
                       size.width, size.height, columns, rows, most_columns, most_rows);
}

}  // namespace ptb
