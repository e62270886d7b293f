#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "core/mesh/formats.h"

namespace ptb::mesh_formats {
namespace {

constexpr std::uintmax_t stl_header_bytes = 80, stl_triangle_bytes = 50;

bool is_control(char c) { return static_cast<unsigned char>(c) < 32 && c != '\t' && c != '\n' && c != '\r'; }

}  // namespace

void check_text(const File& file) {
    const std::string start = file.part(0, 1 << 16);
    if (std::any_of(start.begin(), start.end(), [](char c) { return c == '\0' || is_control(c); }))
        file.fail("it is no text");
}

/// Binary ones may begin with "solid" too: their size tells.
void check_stl(const File& file) {
    const std::string head = file.part(0, stl_header_bytes + 4);
    std::uint32_t triangles = 0;
    if (head.size() == stl_header_bytes + 4) std::memcpy(&triangles, &head[stl_header_bytes], 4);
    if (file.bytes == stl_header_bytes + 4 + triangles * stl_triangle_bytes) return;
    if (!head.starts_with("solid"))
        file.fail(fmt::format("it has {} bytes; an STL file of the {} triangles that it says has {}",
                              file.bytes, triangles, stl_header_bytes + 4 + triangles * stl_triangle_bytes));
    check_text(file);
    const std::uintmax_t tail_bytes = 4096;
    if (file.part(file.bytes - std::min(file.bytes, tail_bytes), tail_bytes).find("endsolid") ==
        std::string::npos)
        file.fail("it ends before \"endsolid\"");
}

}  // namespace ptb::mesh_formats
