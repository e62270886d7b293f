#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace ptb {

/// A folder for films on their way from workers, in memory where there is room. Removed on destruction.
class FilmFolder {
  public:
    explicit FilmFolder(std::uint64_t bytes);
    ~FilmFolder();
    FilmFolder(const FilmFolder&) = delete;
    FilmFolder& operator=(const FilmFolder&) = delete;
    std::filesystem::path file(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

}  // namespace ptb
