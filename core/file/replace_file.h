#pragma once

#include <filesystem>
#include <string_view>
#include <system_error>

namespace ptb {

/// Writes a temporary file beside `file`, then renames it, so that readers see the old file or the whole new
/// one. What exists and is no regular file (a pipe, /dev/stdout) is written in place; a link is followed.
/// Returns why it failed, and then leaves nothing behind.
[[nodiscard]] std::error_code replace_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace ptb
