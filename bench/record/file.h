#pragma once

#include <filesystem>
#include <string_view>

namespace ptb {

/// Replaces `file` whole. Throws std::runtime_error with the path and the reason ("cannot write run.json: No
/// space left on device"), leaving nothing behind.
void write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace ptb
