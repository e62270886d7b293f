#pragma once

#include <cstdint>
#include <filesystem>

namespace ptb {

/// A file for a film on its way from a worker, in memory where there is so much room. It has no name in any
/// folder, so nothing is left of it however this process ends.
class NamelessFile {
  public:
    explicit NamelessFile(std::uint64_t room_bytes);
    ~NamelessFile();
    NamelessFile(const NamelessFile&) = delete;
    NamelessFile& operator=(const NamelessFile&) = delete;
    /// By which processes of this machine open it while this one has it.
    std::filesystem::path path() const;

  private:
    int fd_ = -1;
};

}  // namespace ptb
