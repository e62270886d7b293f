#pragma once

#include <span>
#include <string_view>

namespace ptb {

struct EmbeddedFile {
    std::string_view name;  ///< relative to kernels/, "pt/pt.cl"
    std::string_view text;
};

/// The files of kernels/ as they were at build time, sorted by name (scripts/cmake/Embed.cmake makes them).
std::span<const EmbeddedFile> embedded_kernel_files();

}  // namespace ptb
