#pragma once

#include <filesystem>
#include <string_view>

namespace ptb {

/// Writes `bytes` to a temporary name beside `file`, then renames it: readers see the old file or the whole
/// new one. Throws ImageError, and then leaves nothing behind.
void replace_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace ptb
