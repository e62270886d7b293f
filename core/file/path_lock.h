#pragma once

#include <filesystem>

namespace ptb {

/// A folder or a file that this process holds against others that ask. It ends with the process, however that
/// ends. Where a file system knows no locks, nobody is held off.
class PathLock {
  public:
    PathLock() = default;
    ~PathLock();
    PathLock(const PathLock&) = delete;
    PathLock& operator=(const PathLock&) = delete;

    /// False where another one holds it. Leaves no file.
    [[nodiscard]] bool take_folder(const std::filesystem::path& folder);
    /// The same of a file, which is made where there is none, and stays.
    [[nodiscard]] bool take_file(const std::filesystem::path& file);

  private:
    bool lock();

    int fd_ = -1;
};

}  // namespace ptb
