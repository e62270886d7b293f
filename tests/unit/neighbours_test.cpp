#include "bench/validate/neighbours.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace ptb {
namespace {

constexpr Size size{64, 64};

Reference flat_reference() {
    Reference reference;
    reference.size = size;
    reference.mean = {size, std::vector<float>(3 * size.pixels(), 1.0f)};
    reference.variance = reference.mean;
    return reference;
}

/// Noise of one number a pixel, of which `shared(x, y)` names the one it gets: skewed like rare
/// light.
template <class Shared>
Image noise(unsigned seed, Shared shared) {
    std::minstd_rand random(seed);
    std::vector<float> numbers(size.pixels());
    for (float& n : numbers) n = -std::log(static_cast<float>(random()) / 2147483648.0f);
    Image image{size, {}};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            image.rgb.insert(image.rgb.end(), 3, numbers[static_cast<std::size_t>(shared(x, y))]);
    return image;
}

int own(int x, int y) { return y * size.width + x; }

TEST(Neighbours, independent_pixels_give_a_standard_normal_number) {
    double sum = 0, squares = 0;
    constexpr int trials = 400;
    for (unsigned seed = 1; seed <= trials; ++seed) {
        const double z = neighbour_z(noise(7919 * seed, own), flat_reference(), 1, 0);
        sum += z;
        squares += z * z;
    }
    EXPECT_NEAR(sum / trials, 0, 4 / std::sqrt(trials));
    EXPECT_NEAR(squares / trials, 1, 4 * std::sqrt(2.0 / trials));
}

TEST(Neighbours, pixels_that_share_their_numbers_are_seen_in_their_direction) {
    const Image columns = noise(1, [](int x, int y) { return own(x / 2 * 2, y); });
    EXPECT_GT(neighbour_z(columns, flat_reference(), 1, 0), 10);
    EXPECT_LT(std::abs(neighbour_z(columns, flat_reference(), 0, 1)), 4);
    const Image rows = noise(1, [](int x, int y) { return own(x, y / 2 * 2); });
    EXPECT_GT(neighbour_z(rows, flat_reference(), 0, 1), 10);
}

TEST(Neighbours, an_image_without_errors_has_none_in_common) {
    EXPECT_EQ(neighbour_z(flat_reference().mean, flat_reference(), 1, 0), 0);
}

}  // namespace
}  // namespace ptb
