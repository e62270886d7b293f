#pragma once

#include <filesystem>
#include <string_view>

namespace ptb {

/// Writes a temporary file beside `file`, then renames it, so that `file` is whole at every moment. What
/// exists and is no regular file (a pipe, /dev/stdout) is written in place. Throws std::runtime_error with
/// the path and the reason ("cannot write run.json: No space left on device"), leaving nothing behind.
void write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace ptb
