#include "bench/worker/shared_pixels.h"

#include <stdexcept>

#include <boost/interprocess/file_mapping.hpp>
#include <fmt/format.h>

namespace ptb {

SharedPixels::SharedPixels(const std::filesystem::path& file, Size size) try {
    namespace ipc = boost::interprocess;
    const ipc::file_mapping mapping(file.c_str(), ipc::read_write);
    region_ = ipc::mapped_region(mapping, ipc::read_write);
    if (region_.get_size() != bytes(size))
        throw std::runtime_error(
            fmt::format("{}: {} bytes in place of {}", file.string(), region_.get_size(), bytes(size)));
} catch (const boost::interprocess::interprocess_exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
}

std::span<FilmPixel> SharedPixels::all() const {
    return {static_cast<FilmPixel*>(region_.get_address()), region_.get_size() / sizeof(FilmPixel)};
}

}  // namespace ptb
