#include <gmock/gmock.h>

#include "bench/report/html/pictures.h"
#include "core/image/image_io.h"

namespace ptb {
namespace {

using testing::DoubleNear;

Image grey(Size size, float value) { return {size, std::vector<float>(3 * size.pixels(), value)}; }

/// Mean 0.25 and variance 0.04 of one sample, known exactly.
Reference reference(Size size) {
    Reference r;
    r.size = size;
    r.spp = 1'000'000'000;
    r.mean = grey(size, 0.25F);
    r.variance = grey(size, 0.04F);
    return r;
}

TEST(ZMap, is_in_standard_errors_of_the_picture) {
    // The mean of 100 samples has a standard error of 0.02; rounding adds (2 * 0.5 / 255)^2 / 12 to its
    // square.
    const auto map = z_map(grey({4, 4}, 0.31F), reference({4, 4}), 100);
    ASSERT_TRUE(map);
    EXPECT_THAT(map->rms, DoubleNear(2.995, 0.001));
    EXPECT_EQ(map->beyond_4, 0);
    EXPECT_EQ(map->image.rgb[0], 1) << "too bright is red";
    EXPECT_NEAR(map->image.rgb[2], 0.4, 0.01);
}

TEST(ZMap, a_larger_picture_is_averaged) {
    const auto map = z_map(grey({8, 8}, 0.31F), reference({4, 4}), 100);
    ASSERT_TRUE(map);
    EXPECT_EQ(map->image.size, (Size{4, 4}));
    EXPECT_THAT(map->rms, DoubleNear(5.990, 0.002));
    EXPECT_EQ(map->beyond_4, 1);
}

TEST(ZMap, a_smaller_picture_has_the_variance_between_the_pixels_it_covers) {
    Reference r = reference({2, 2});
    for (std::size_t i = 0; i < 6; ++i) r.mean.rgb[i] = 0.45F;  // mean 0.35, variance between pixels 0.01
    for (std::size_t i = 6; i < 12; ++i) r.mean.rgb[i] = 0.25F;
    const auto map = z_map(grey({1, 1}, 0.35F + 0.0F), r, 100);
    ASSERT_TRUE(map);
    EXPECT_THAT(map->rms, DoubleNear(0, 1e-4));
    EXPECT_THAT(z_map(grey({1, 1}, 0.4171F), r, 100)->rms, DoubleNear(3, 0.01))
        << "0.0671 is 3 sqrt(0.05 / 100)";
}

TEST(ZMap, what_is_clamped_is_left_out_and_odd_sizes_have_none) {
    Reference r = reference({4, 4});
    r.mean = grey({4, 4}, 15);
    EXPECT_EQ(z_map(grey({4, 4}, 1), r, 100)->rms, 0);
    EXPECT_FALSE(z_map(grey({6, 4}, 1), r, 100));
    EXPECT_FALSE(z_map(grey({3, 3}, 1), r, 100));
}

TEST(Pictures, a_name_that_leads_elsewhere_is_refused) {
    ResultFile result;
    result.pictures = {{{"pocl:0", "pt", "thesis", {8, 8}, 1, 128, {}, 0}, "../secret.png"}};
    const auto shown = figures(result, ".", ".");
    ASSERT_EQ(shown.size(), 1u);
    EXPECT_EQ(shown[0].webp, "");
    EXPECT_THAT(shown[0].caption, testing::HasSubstr("../secret.png: not a name beside the result"));
}

}  // namespace
}  // namespace ptb
