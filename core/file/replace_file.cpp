#include "core/file/replace_file.h"

#include <atomic>
#include <cerrno>
#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

namespace ptb {
namespace {

namespace fs = std::filesystem;

fs::path temporary_beside(const fs::path& file) {
    static std::atomic<unsigned> counter = 0;  // two threads of a process never share a name
    return file.parent_path() / fmt::format(".{}.tmp-{}-{}", file.filename().string(), ::getpid(), counter++);
}

std::error_code write_all(const fs::path& file, std::string_view bytes) {
    errno = 0;
    std::ofstream stream(file, std::ios::binary | std::ios::trunc);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();  // a full disk may show only here
    if (stream.good()) return {};
    return {errno == 0 ? EIO : errno, std::generic_category()};
}

}  // namespace

std::error_code replace_file(const fs::path& file, std::string_view bytes) {
    std::error_code ignored;
    if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) return write_all(file, bytes);
    const fs::path target = fs::is_symlink(file, ignored) ? fs::weakly_canonical(file, ignored) : file;
    const fs::path temporary = temporary_beside(target);
    std::error_code error = write_all(temporary, bytes);
    if (!error) fs::rename(temporary, target, error);
    if (error) fs::remove(temporary, ignored);
    return error;
}

}  // namespace ptb
