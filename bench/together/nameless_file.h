#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace ptb {

/// In memory, and where there is none to spare on a disk.
std::vector<std::filesystem::path> places_for_films();

/// A file of so many bytes, for a film on its way from a worker, in the first of these folders that has room.
/// It has no name in it, so nothing is left of it however this process ends.
class NamelessFile {
  public:
    /// Throws std::runtime_error where no folder has room.
    explicit NamelessFile(std::uint64_t bytes,
                          const std::vector<std::filesystem::path>& folders = places_for_films());
    ~NamelessFile();
    NamelessFile(const NamelessFile&) = delete;
    NamelessFile& operator=(const NamelessFile&) = delete;
    /// By which processes of this machine open it while this one has it.
    std::filesystem::path path() const;

  private:
    int fd_ = -1;
};

}  // namespace ptb
