#include "core/file/path_lock.h"

#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace ptb {

PathLock::~PathLock() {
    if (fd_ >= 0) ::close(fd_);
}

bool PathLock::take_folder(const std::filesystem::path& folder) {
    fd_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    return lock();
}

bool PathLock::take_file(const std::filesystem::path& file) {
    fd_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC,
                 0666);  // some file systems lock only what is written
    return lock();
}

bool PathLock::lock() { return fd_ < 0 || ::flock(fd_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

}  // namespace ptb
