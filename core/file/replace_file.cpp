#include "core/file/replace_file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace ptb {
namespace {

namespace fs = std::filesystem;

/// Onto the disk: a file that is renamed before its bytes are there is empty after a power cut.
std::error_code sync(const fs::path& file) {
    const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    const bool synced = fd >= 0 && (::fsync(fd) == 0 || errno == EINVAL || errno == ENOTSUP);
    const int error = errno;
    if (fd >= 0) ::close(fd);
    return synced ? std::error_code() : std::error_code(error, std::generic_category());
}

std::error_code write_all(const fs::path& file, std::string_view bytes) {
    errno = 0;
    std::ofstream stream(file, std::ios::binary | std::ios::trunc);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();  // a full disk may show only here
    if (stream.good()) return {};
    return {errno == 0 ? EIO : errno, std::generic_category()};
}

/// A file system without links can still refuse to rename onto a file.
std::error_code link_or_rename(const fs::path& temporary, const fs::path& file) {
    if (::link(temporary.c_str(), file.c_str()) == 0) return {};
    if (errno == EEXIST) return std::make_error_code(std::errc::file_exists);
    if (::renameat2(AT_FDCWD, temporary.c_str(), AT_FDCWD, file.c_str(), RENAME_NOREPLACE) == 0) return {};
    return {errno, std::generic_category()};
}

std::string name_beside(const fs::path& file) {
    static std::atomic<unsigned> counter = 0;  // two threads of a process never share a name
    std::array<char, 65> host{};               // of this process on this machine: others may share the folder
    ::gethostname(host.data(), host.size() - 1);
    return fmt::format(".{}.tmp-{}-{}-{}", file.filename().string(), host.data(), ::getpid(), counter++);
}

}  // namespace

FileBeside::FileBeside(fs::path file)
    : file_(std::move(file)), path_(file_.parent_path() / name_beside(file_)) {}

FileBeside::~FileBeside() {
    std::error_code ignored;
    fs::remove(path_, ignored);
}

std::error_code FileBeside::put_in_place() const {
    std::error_code error = sync(path_);
    if (!error) fs::rename(path_, file_, error);
    return error;
}

std::error_code make_new_file(const fs::path& file, std::string_view bytes) {
    const FileBeside beside(file);
    std::error_code error = write_all(beside.path(), bytes);
    if (!error) error = sync(beside.path());
    return error ? error : link_or_rename(beside.path(), file);
}

std::error_code replace_file(const fs::path& file, std::string_view bytes) {
    std::error_code ignored;
    if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) return write_all(file, bytes);
    const fs::path target = fs::is_symlink(file, ignored) ? fs::weakly_canonical(file, ignored) : file;
    const FileBeside beside(target);
    const std::error_code error = write_all(beside.path(), bytes);
    return error ? error : beside.put_in_place();
}

}  // namespace ptb
