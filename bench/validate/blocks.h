#pragma once

#include <cstdint>
#include <vector>

#include "core/image/image.h"

namespace ptb {

/// Means of square blocks of pixels, RGB interleaved, blocks from the top left. An edge that does not divide
/// the image leaves smaller blocks at the right and the bottom.
struct Blocks {
    int across = 0, down = 0;
    std::vector<double> rgb;
    std::vector<int> pixels;  ///< of each block
};

Blocks block_means(const Image& image, int edge);

/// Smallest power-of-two edge whose blocks hold at least `samples` samples at this many a pixel.
int block_edge(std::uint64_t samples, int spp);

}  // namespace ptb
