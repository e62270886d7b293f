#include "bench/measure/statistics.h"

#include <gtest/gtest.h>

namespace ptb {
namespace {

Work work(std::uint64_t segments, std::uint64_t shadow_rays) {
    Work work;
    work.samples = 2'000'000;
    work.segments = segments;
    work.shadow_rays = shadow_rays;
    return work;
}

Statistics in_half_a_second(const Work& work) {
    Statistics statistics;
    statistics.median_ns = 5e8;
    add_rates(statistics, work);
    return statistics;
}

TEST(Statistics, rates_are_millions_a_second_of_the_median) {
    const Statistics statistics = in_half_a_second(work(8'000'000, 3'000'000));
    EXPECT_DOUBLE_EQ(statistics.msamples_per_s, 4);
    EXPECT_DOUBLE_EQ(statistics.msegments_per_s, 16);
    EXPECT_DOUBLE_EQ(statistics.mrays_per_s.value(), 22) << "segments and shadow rays";
}

TEST(Statistics, segments_of_paths_from_lamps_are_rays_too) {
    Work both_ends = work(8'000'000, 3'000'000);
    both_ends.light_segments = 5'000'000;
    EXPECT_DOUBLE_EQ(in_half_a_second(both_ends).msegments_per_s, 16);
    EXPECT_DOUBLE_EQ(in_half_a_second(both_ends).mrays_per_s.value(), 32);
}

TEST(Statistics, kernels_without_shadow_rays_have_no_rate_of_rays) {
    EXPECT_EQ(in_half_a_second(work(8'000'000, 0)).mrays_per_s, std::nullopt);
}

TEST(Statistics, rays_of_a_list_have_one) {
    Work list = work(2'000'000, 0);
    list.listed_rays = 2'000'000;
    EXPECT_DOUBLE_EQ(in_half_a_second(list).mrays_per_s.value(), 4);
}

}  // namespace
}  // namespace ptb
