#include "bench/report/heat_map.h"

#include <gtest/gtest.h>

#include "core/image/image_io.h"

namespace ptb {
namespace {

/// Nodes in the first channel, what else is counted in the others.
Image costs(const std::vector<float>& nodes) {
    Image image{{static_cast<int>(nodes.size()), 1}, {}};
    for (const float each : nodes) image.rgb.insert(image.rgb.end(), {each, 1000, 3});
    return image;
}

TEST(HeatMap, white_is_the_power_of_two_that_nearly_all_pixels_keep_under) {
    std::vector<float> nodes(1000, 60);
    nodes[7] = 5000;
    const HeatMap map = heat_map(costs(nodes));
    EXPECT_EQ(map.white, 64);
    EXPECT_EQ(map.least, 60);
    EXPECT_EQ(map.most, 5000);
    EXPECT_DOUBLE_EQ(map.mean, 60 + 4.94);
    EXPECT_EQ(heat_map(costs({0, 0})).white, 1) << "of a picture of nothing";
}

TEST(HeatMap, more_nodes_are_lighter_in_grey_too_from_black_to_white) {
    std::vector<float> nodes;
    for (int i = 0; i <= 128; ++i) nodes.push_back(static_cast<float>(i));
    const Image image = heat_map(costs(nodes)).image;
    const auto grey = [&](std::size_t pixel) {
        const auto channel = [&](std::size_t c) { return 1.0 * encoded(image.rgb[3 * pixel + c]); };
        return 0.299 * channel(0) + 0.587 * channel(1) + 0.114 * channel(2);
    };
    EXPECT_EQ(grey(0), 0);
    EXPECT_NEAR(grey(128), 255, 1e-9);
    for (std::size_t i = 1; i < nodes.size(); ++i) EXPECT_GT(grey(i), grey(i - 1)) << i;
}

}  // namespace
}  // namespace ptb
