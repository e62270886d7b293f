#include "bench/record/file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include <unistd.h>

namespace ptb {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, int error) {
    throw std::runtime_error("cannot write " + file.string() + ": " + std::strerror(error));
}

/// 0, or the errno of what failed. A full disk may show only when the file is flushed or closed.
int try_write(const fs::path& file, std::string_view text) {
    std::FILE* stream = std::fopen(file.c_str(), "wb");
    if (stream == nullptr) return errno;
    const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    int error = written && std::fflush(stream) == 0 ? 0 : errno;
    if (std::fclose(stream) != 0 && error == 0) error = errno;
    return error;
}

fs::path temporary_beside(const fs::path& file) {
    fs::path name = ".";
    name += file.filename();
    name += ".tmp-" + std::to_string(::getpid());
    return file.parent_path() / name;
}

}  // namespace

void write_file(const fs::path& file, std::string_view text) {
    std::error_code ignored;
    const bool in_place = fs::exists(file, ignored) && !fs::is_regular_file(file, ignored);
    const fs::path target =
        fs::is_symlink(file, ignored) && !in_place ? fs::weakly_canonical(file, ignored) : file;
    const fs::path temporary = in_place ? target : temporary_beside(target);
    int error = try_write(temporary, text);
    if (error == 0 && !in_place && std::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
    if (error == 0) return;
    if (!in_place) fs::remove(temporary, ignored);
    fail(file, error);
}

}  // namespace ptb
