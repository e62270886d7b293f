#include "bench/together/nameless_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace ptb {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t left_to_others = 16 << 20;  ///< bytes of a folder

bool has_room(const fs::path& folder, std::uint64_t bytes) {
    std::error_code error;
    const fs::space_info space = fs::space(folder, error);
    return error || (space.available > left_to_others && space.available - left_to_others >= bytes);
}

/// An error, or 0.
int take_room(int fd, std::uint64_t bytes) {
    int error = EINTR;
    while (error == EINTR) error = ::posix_fallocate(fd, 0, static_cast<off_t>(bytes));
    return error;
}

/// A descriptor, or -1 and `error`. All of its bytes are there from the start: who writes into a mapped file
/// for which there is no room dies.
int open_nameless(const fs::path& folder, std::uint64_t bytes, int& error) {
    error = ENOSPC;
    if (!has_room(folder, bytes)) return -1;
    std::string name = (folder / "ptbench-film-XXXXXX").string();
    const int fd = ::mkostemp(name.data(), O_CLOEXEC);
    error = fd < 0 ? errno : 0;
    if (fd < 0) return -1;
    ::unlink(name.c_str());
    error = take_room(fd, bytes);
    if (error == 0) return fd;
    ::close(fd);
    return -1;
}

}  // namespace

std::vector<fs::path> places_for_films() { return {"/dev/shm", fs::temp_directory_path()}; }

NamelessFile::NamelessFile(std::uint64_t bytes, const std::vector<fs::path>& folders) {
    std::string why;
    for (const fs::path& folder : folders) {
        int error = 0;
        fd_ = open_nameless(folder, bytes, error);
        if (fd_ >= 0) return;
        why += fmt::format("; {}: {}", folder.string(), std::strerror(error));
    }
    throw std::runtime_error(fmt::format("no room for a film of {} bytes{}", bytes, why));
}

NamelessFile::~NamelessFile() { ::close(fd_); }

fs::path NamelessFile::path() const { return fmt::format("/proc/{}/fd/{}", ::getpid(), fd_); }

}  // namespace ptb
