#pragma once

#include <cstddef>
#include <vector>

namespace ptb {

/// Width and height in pixels.
struct Size {
    int width = 0, height = 0;
    std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
    auto operator<=>(const Size&) const = default;
};

/// Linear RGB, three interleaved floats a pixel, rows from the top, columns from the left.
struct Image {
    Size size;
    std::vector<float> rgb;
    bool operator==(const Image&) const = default;
};

}  // namespace ptb
