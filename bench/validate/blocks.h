#pragma once

#include <cstdint>
#include <optional>
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

/// An image at another size: means of blocks, or pixels repeated; nothing where neither size is a multiple of
/// the other.
std::optional<Image> image_at(const Image& image, Size size);

/// Mean of a pixel, and the variance of one sample in it.
struct PixelMoments {
    Image mean, variance;
};

/// Those of an image of another size, in which a sample of a larger pixel is one of any of those it covers,
/// and a smaller pixel is taken for all of the one it lies in.
std::optional<PixelMoments> moments_at(const PixelMoments& moments, Size size);

/// Smallest power-of-two edge whose blocks hold at least `samples` samples at this many a pixel.
int block_edge(std::uint64_t samples, int spp);

}  // namespace ptb
