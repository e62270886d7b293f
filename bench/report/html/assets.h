#pragma once

#include <span>

#include "core/source/embedded.h"

namespace ptb {

/// The files of page/ and Chart.js as they were at build time (scripts/cmake/Embed.cmake makes them).
std::span<const EmbeddedFile> embedded_page_files();

}  // namespace ptb
