#include "core/integrator/splats.h"

namespace ptb {

namespace {

/// A sum of a pixel with what others add to it. Neither part leaves room for the sum to overflow.
ptb_long sum_of(ptb_long own, const Splat& splat, std::size_t channel) {
    return own == FILM_BROKEN || splat.broken > 0 ? FILM_BROKEN : own + splat.radiance[channel];
}

}  // namespace

SplatStore::SplatStore(const ocl::Device& device, Size size)
    : size_(size), splats_(device.context, CL_MEM_READ_WRITE, bytes()) {}

void SplatStore::clear(const cl::CommandQueue& queue) const {
    queue.enqueueFillBuffer(splats_, 0u, 0, bytes());
}

std::uint64_t SplatStore::add_to(std::span<FilmPixel> pixels, const cl::CommandQueue& queue,
                                 int first_row) const {
    std::vector<Splat> splats(pixels.size());
    queue.enqueueReadBuffer(splats_, CL_TRUE, Size{size_.width, first_row}.pixels() * sizeof(Splat),
                            splats.size() * sizeof(Splat), splats.data());
    std::uint64_t light_segments = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            pixels[i].radiance[c] = sum_of(pixels[i].radiance[c], splats[i], c);
        pixels[i].shadow_rays += splats[i].shadow_rays;
        light_segments += splats[i].light_segments;
    }
    return light_segments;
}

std::uint64_t SplatStore::bytes() const { return splat_bytes_of(size_); }

std::uint64_t splat_bytes_of(Size size) { return size.pixels() * sizeof(Splat); }

}  // namespace ptb
