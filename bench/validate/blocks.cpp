#include "bench/validate/blocks.h"

#include <algorithm>

namespace ptb {

namespace {

/// How often `size` goes into `larger` on both sides; 0 when it does not.
int multiple(Size larger, Size size) {
    const int times = larger.width / size.width;
    return times * size.width == larger.width && times * size.height == larger.height ? times : 0;
}

Image as_image(const Blocks& blocks) {
    return {{blocks.across, blocks.down}, {blocks.rgb.begin(), blocks.rgb.end()}};
}

Image squared(Image image) {
    for (float& value : image.rgb) value *= value;
    return image;
}

/// The variances' mean, and the variance of the pixels' means.
Image block_variance(const PixelMoments& moments, int edge) {
    const auto means = block_means(moments.mean, edge).rgb;
    const auto squares = block_means(squared(moments.mean), edge).rgb;
    Blocks variance = block_means(moments.variance, edge);
    for (std::size_t i = 0; i < means.size(); ++i)
        variance.rgb[i] += std::max(0.0, squares[i] - means[i] * means[i]);
    return as_image(variance);
}

Image repeated(const Image& image, int times) {
    Image large{{image.size.width * times, image.size.height * times}, {}};
    large.rgb.reserve(3 * large.size.pixels());
    for (int y = 0; y < large.size.height; ++y) {
        for (int x = 0; x < large.size.width; ++x) {
            const auto pixel =
                static_cast<std::size_t>(y / times) * static_cast<std::size_t>(image.size.width) +
                static_cast<std::size_t>(x / times);
            for (std::size_t c = 0; c < 3; ++c) large.rgb.push_back(image.rgb[3 * pixel + c]);
        }
    }
    return large;
}

}  // namespace

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

std::optional<Image> image_at(const Image& image, Size size) {
    if (const int edge = multiple(image.size, size); edge > 0) return as_image(block_means(image, edge));
    if (const int times = multiple(size, image.size); times > 0) return repeated(image, times);
    return std::nullopt;
}

std::optional<PixelMoments> moments_at(const PixelMoments& moments, Size size) {
    const auto mean = image_at(moments.mean, size);
    if (!mean) return std::nullopt;
    const int edge = multiple(moments.mean.size, size);
    return PixelMoments{*mean, edge > 0 ? block_variance(moments, edge) : *image_at(moments.variance, size)};
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
