#include "bench/measure/statistics.h"

#include <gtest/gtest.h>

namespace ptb {
namespace {

Work work(std::uint64_t segments) {
    Work work;
    work.samples = 2'000'000;
    work.segments = segments;
    return work;
}

Statistics in_half_a_second(const Work& work) {
    Statistics statistics;
    statistics.median_ns = 5e8;
    add_rates(statistics, work);
    return statistics;
}

TEST(Statistics, rates_are_millions_a_second_of_the_median) {
    const Statistics statistics = in_half_a_second(work(8'000'000));
    EXPECT_DOUBLE_EQ(statistics.msamples_per_s, 4);
    EXPECT_DOUBLE_EQ(statistics.msegments_per_s, 16);
}

}  // namespace
}  // namespace ptb
