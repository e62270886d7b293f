#include "bench/validate/blocks.h"

namespace ptb {

Blocks block_means(const Image& image, int edge) {
    Blocks blocks{(image.size.width + edge - 1) / edge, (image.size.height + edge - 1) / edge, {}, {}};
    const auto count = static_cast<std::size_t>(blocks.across) * static_cast<std::size_t>(blocks.down);
    blocks.rgb.assign(3 * count, 0);
    blocks.pixels.assign(count, 0);
    std::size_t pixel = 0;
    for (int y = 0; y < image.size.height; ++y) {
        for (int x = 0; x < image.size.width; ++x, ++pixel) {
            const int number = y / edge * blocks.across + x / edge;
            const auto block = static_cast<std::size_t>(number);
            for (std::size_t c = 0; c < 3; ++c) blocks.rgb[3 * block + c] += image.rgb[3 * pixel + c];
            ++blocks.pixels[block];
        }
    }
    for (std::size_t i = 0; i < blocks.rgb.size(); ++i) blocks.rgb[i] /= blocks.pixels[i / 3];
    return blocks;
}

int block_edge(std::uint64_t samples, int spp) {
    int edge = 1;
    while (static_cast<std::uint64_t>(edge) * static_cast<std::uint64_t>(edge) *
               static_cast<std::uint64_t>(spp) <
           samples)
        edge *= 2;
    return edge;
}

}  // namespace ptb
