#pragma once

#include <cstdint>
#include <span>

#include "core/image/image.h"
#include "core/ocl/device.h"
#include "shared/engine.h"

namespace ptb {

/// What samples add to pixels that are not their own, on a device. Methods throw cl::Error.
class SplatStore {
  public:
    SplatStore(const ocl::Device& device, Size size);

    const cl::Buffer& buffer() const { return splats_; }
    void clear(const cl::CommandQueue& queue) const;
    /// Adds what belongs to some pixels, of whole rows from `first_row` on, to their sums; returns their
    /// segments of paths from lamps.
    std::uint64_t add_to(std::span<FilmPixel> pixels, const cl::CommandQueue& queue, int first_row) const;
    std::uint64_t bytes() const;

  private:
    Size size_;
    cl::Buffer splats_;
};

/// Device memory of them, bytes.
std::uint64_t splat_bytes_of(Size size);

}  // namespace ptb
