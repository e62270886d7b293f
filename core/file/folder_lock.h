#pragma once

#include <filesystem>

namespace ptb {

/// A folder that this process holds against others that ask. It leaves no file, and ends with the process,
/// however that ends. Where a file system knows no locks, nobody is held off.
class FolderLock {
  public:
    FolderLock() = default;
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

    /// False where another one holds it.
    [[nodiscard]] bool take(const std::filesystem::path& folder);

  private:
    int fd_ = -1;
};

}  // namespace ptb
