#include "core/image/replace_file.h"

#include <atomic>
#include <cerrno>
#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "core/image/image_io.h"

namespace ptb {
namespace {

std::filesystem::path temporary_beside(const std::filesystem::path& file) {
    static std::atomic<unsigned> counter = 0;  // two threads of a process never share a name
    std::filesystem::path temporary = file;
    temporary += fmt::format(".{}-{}.tmp", getpid(), counter++);
    return temporary;
}

std::error_code write_all(const std::filesystem::path& file, std::string_view bytes) {
    errno = 0;
    std::ofstream stream(file, std::ios::binary | std::ios::trunc);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();  // a full disk may show only here
    if (stream.good()) return {};
    return {errno == 0 ? EIO : errno, std::generic_category()};
}

}  // namespace

void replace_file(const std::filesystem::path& file, std::string_view bytes) {
    const std::filesystem::path temporary = temporary_beside(file);
    std::error_code error = write_all(temporary, bytes);
    if (!error) std::filesystem::rename(temporary, file, error);
    if (!error) return;
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw ImageError(fmt::format("{}: cannot be written: {}", file.string(), error.message()));
}

}  // namespace ptb
