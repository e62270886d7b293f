#pragma once

#include <filesystem>
#include <span>

#include <boost/interprocess/mapped_region.hpp>

#include "core/image/image.h"
#include "shared/engine.h"

namespace ptb {

/// A film's pixels in a file that a worker and its coordinator have in their memory at once.
class SharedPixels {
  public:
    /// Throws std::runtime_error where the file cannot be mapped, or is not of so many pixels.
    SharedPixels(const std::filesystem::path& file, Size size);
    std::span<FilmPixel> all() const;

    static std::uint64_t bytes(Size size) { return size.pixels() * sizeof(FilmPixel); }

  private:
    boost::interprocess::mapped_region region_;
};

}  // namespace ptb
