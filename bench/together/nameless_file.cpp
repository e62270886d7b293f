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

fs::path place_for(std::uint64_t bytes) {
    const fs::path memory = "/dev/shm";
    std::error_code error;
    const fs::space_info space = fs::space(memory, error);
    const bool fits = !error && space.available >= bytes && ::access(memory.c_str(), W_OK) == 0;
    return fits ? memory : fs::temp_directory_path();
}

}  // namespace

NamelessFile::NamelessFile(std::uint64_t room_bytes) {
    std::string name = (place_for(room_bytes) / "ptbench-film-XXXXXX").string();
    fd_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (fd_ < 0) throw std::runtime_error(fmt::format("cannot create {}: {}", name, std::strerror(errno)));
    ::unlink(name.c_str());
}

NamelessFile::~NamelessFile() { ::close(fd_); }

fs::path NamelessFile::path() const { return fmt::format("/proc/{}/fd/{}", ::getpid(), fd_); }

}  // namespace ptb
