#include "core/integrator/film.h"

#include <array>
#include <bit>

#include <fmt/format.h>

namespace ptb {

namespace {

/// Of the kernels that add tallies to the film. Fixed, since PoCL compiles once a size; every device
/// allows 32.
constexpr int add_work_group = 32;

class BufferFilm : public FilmStore {
  public:
    BufferFilm(const ocl::Device& device, const cl::Program& program, Size size, const CountedRows& counted)
        : size_(size), add_(program, "pt_add"), film_(device.context, CL_MEM_READ_WRITE, bytes()) {
        counted.give(add_);
    }

    void clear(const cl::CommandQueue& queue) override { queue.enqueueFillBuffer(film_, 0u, 0, bytes()); }
    void add(Launcher& launcher, const cl::Buffer& tallies, const EngineLaunch& launch) override {
        add_.setArg(0, film_);
        add_.setArg(1, tallies);
        add_.setArg(2, launch);
        launcher.launch(add_, one_dimensional(launch.pixels, add_work_group));
    }
    std::vector<Tally> read(const cl::CommandQueue& queue, int first_row, int rows) override {
        std::vector<Tally> tallies(Size{size_.width, rows}.pixels());
        queue.enqueueReadBuffer(film_, CL_TRUE, Size{size_.width, first_row}.pixels() * sizeof(Tally),
                                tallies.size() * sizeof(Tally), tallies.data());
        return tallies;
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
    ImageFilm(const ocl::Device& device, const cl::Program& program, Size size, const CountedRows& counted)
        : size_(size), add_(program, "pt_add_to_image") {
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
    std::vector<Tally> read(const cl::CommandQueue& queue, int first_row, int rows) override {
        const auto radiance = layer(queue, 0, first_row, rows), squares = layer(queue, 1, first_row, rows),
                   counts = layer(queue, 2, first_row, rows);
        std::vector<Tally> tallies(counts.size());
        for (std::size_t i = 0; i < tallies.size(); ++i)
            tallies[i] = {as_floats(radiance[i]), as_floats(squares[i]), counts[i][0],
                          counts[i][1],           counts[i][2],          0};
        return tallies;
    }
    std::uint64_t bytes() const override { return film_bytes_of(size_, FilmMemory::image); }

  private:
    using Texel = std::array<std::uint32_t, 4>;
    static ptb_float4 as_floats(const Texel& texel) { return std::bit_cast<ptb_float4>(texel); }
    std::vector<Texel> layer(const cl::CommandQueue& queue, int number, int first_row, int rows) const {
        std::vector<Texel> texels(Size{size_.width, rows}.pixels());
        const auto row = static_cast<std::size_t>(number) * static_cast<std::size_t>(size_.height) +
                         static_cast<std::size_t>(first_row);
        queue.enqueueReadImage(images_[0], CL_TRUE, {0, row, 0}, {width(), static_cast<std::size_t>(rows), 1},
                               0, 0, texels.data());
        return texels;
    }
    std::size_t width() const { return static_cast<std::size_t>(size_.width); }
    std::size_t height() const { return static_cast<std::size_t>(size_.height) * ENGINE_FILM_LAYERS; }

    Size size_;
    cl::Kernel add_;
    std::array<cl::Image2D, 2> images_;  ///< the first holds the film
};

}  // namespace

std::unique_ptr<FilmStore> make_film_store(const ocl::Device& device, const cl::Program& program, Size size,
                                     FilmMemory memory, const CountedRows& counted) {
    if (memory == FilmMemory::image) return std::make_unique<ImageFilm>(device, program, size, counted);
    return std::make_unique<BufferFilm>(device, program, size, counted);
}

std::uint64_t largest_film_object(Size size, FilmMemory) { return size.pixels() * sizeof(Tally); }

std::uint64_t film_bytes_of(Size size, FilmMemory memory) {
    return largest_film_object(size, memory) * (memory == FilmMemory::image ? 2 : 1);
}

std::string film_refusal(const ocl::Device& device, Size size, FilmMemory memory) {
    if (memory == FilmMemory::buffer) return "";
    if (!device.info.images) return "film_memory image: this device has no images";
    const std::uint64_t rows = static_cast<std::uint64_t>(size.height) * ENGINE_FILM_LAYERS;
    const std::uint64_t columns = static_cast<std::uint64_t>(size.width);
    const std::uint64_t most_rows = device.device.getInfo<CL_DEVICE_IMAGE2D_MAX_HEIGHT>();
    const std::uint64_t most_columns = device.device.getInfo<CL_DEVICE_IMAGE2D_MAX_WIDTH>();
    if (rows <= most_rows && columns <= most_columns) return "";
    return fmt::format("film_memory image: {}x{} pixels need an image of {}x{}, this device allows {}x{}",
                       size.width, size.height, columns, rows, most_columns, most_rows);
}

}  // namespace ptb
