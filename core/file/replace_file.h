#pragma once

#include <filesystem>
#include <string_view>
#include <system_error>

namespace ptb {

/// Makes a file that is not there yet, whole at once: of several processes that try, on one machine or on
/// many that share the folder, one does, and the others get std::errc::file_exists.
[[nodiscard]] std::error_code make_new_file(const std::filesystem::path& file, std::string_view bytes);

/// For what is too long to be held at once: the name of a file of one's own beside `file`. What is there is
/// removed on destruction, unless it came into the place of `file`.
class FileBeside {
  public:
    explicit FileBeside(std::filesystem::path file);
    ~FileBeside();
    FileBeside(const FileBeside&) = delete;
    FileBeside& operator=(const FileBeside&) = delete;
    const std::filesystem::path& path() const { return path_; }
    /// Brings it onto the disk, and into the place of `file`.
    [[nodiscard]] std::error_code put_in_place() const;

  private:
    std::filesystem::path file_, path_;
};

/// Writes a temporary file beside `file`, then renames it, so that readers see the old file or the whole new
/// one. What exists and is no regular file (a pipe, /dev/stdout) is written in place; a link is followed.
/// Returns why it failed, and then leaves nothing behind.
[[nodiscard]] std::error_code replace_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace ptb
