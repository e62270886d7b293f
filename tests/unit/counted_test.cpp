#include "bench/measure/counted.h"

#include <gmock/gmock.h>

namespace ptb {
namespace {

using testing::HasSubstr;

std::vector<Peak> peaks() {
    const auto peak = [](const char* name, double value) {
        return Peak{name, "", value, value, value, 10, "event", ""};
    };
    return {peak("fma", 100), peak("sqrt", 10), peak("division", 5), peak("global", 20)};
}

TEST(Counted, work_is_a_mean_over_segments_and_lanes) {
    const Counted counted = counted_of({1000, 1600, 234000, 10500, 500, 64}, 1000);
    EXPECT_EQ(counted.reason, "");
    EXPECT_EQ(counted.segments, 1000u);
    EXPECT_DOUBLE_EQ(counted.flops_per_segment.value(), 234);
    EXPECT_DOUBLE_EQ(counted.roots_per_segment.value(), 10.5);
    EXPECT_DOUBLE_EQ(counted.divisions_per_segment.value(), 0.5);
    EXPECT_DOUBLE_EQ(counted.bytes_per_segment.value(), 0.064);
    EXPECT_DOUBLE_EQ(counted.lanes_alive.value(), 0.625);
}

TEST(Counted, steps_through_a_tree_are_means_over_rays_where_there_are_any) {
    EXPECT_EQ(counted_of({1000, 1600, 234000, 10500, 500, 64}, 1000).nodes_per_ray, std::nullopt);
    const Counted counted = counted_of({1000, 1600, 234000, 10500, 500, 64, 2000, 25000, 7000}, 1000);
    EXPECT_DOUBLE_EQ(counted.nodes_per_ray.value(), 12.5);
    EXPECT_DOUBLE_EQ(counted.triangles_per_ray.value(), 3.5);
}

TEST(Counted, lanes_that_cannot_be_seen_are_null_with_a_reason) {
    const Counted counted = counted_of({1000, 0, 234000, 10500, 500, 64}, 1000);
    EXPECT_EQ(counted.lanes_alive, std::nullopt);
    EXPECT_THAT(counted.reason, HasSubstr("one lane a work-item"));
    EXPECT_TRUE(counted.flops_per_segment.has_value());
}

TEST(Counted, segments_that_the_film_does_not_have_spoil_the_counts) {
    const Counted counted = counted_of({1000, 1600, 234000, 10500, 500, 64}, 999);
    EXPECT_EQ(counted.flops_per_segment, std::nullopt);
    EXPECT_EQ(counted.segments, 0u);
    EXPECT_EQ(counted.reason, "the instrumented build counted 1000 segments, its film has 999");
}

TEST(Counted, shares_are_rates_over_peaks_and_roots_wait_with_divisions) {
    // 100 M segments a second: 23.4 GFLOP/s, 3 Groots/s, 1 Gdivisions/s, 2 GB/s.
    const Counted counted = counted_of({1000, 1600, 234000, 30000, 10000, 20000}, 1000);
    const PeakShares shares = shares_of(counted, 100, peaks());
    EXPECT_DOUBLE_EQ(shares.fma.value(), 0.234);
    EXPECT_DOUBLE_EQ(shares.sqrt.value(), 0.3);
    EXPECT_DOUBLE_EQ(shares.division.value(), 0.2);
    EXPECT_DOUBLE_EQ(shares.global.value(), 0.1);
    EXPECT_EQ(shares.limit, "roots");
    EXPECT_DOUBLE_EQ(shares.limit_share.value(), 0.5);
}

TEST(Counted, a_peak_without_a_value_has_no_share) {
    const Counted counted = counted_of({1000, 1600, 234000, 30000, 10000, 20000}, 1000);
    auto some = peaks();
    some[1].value.reset();
    some.erase(some.begin());
    const PeakShares shares = shares_of(counted, 100, some);
    EXPECT_EQ(shares.fma, std::nullopt);
    EXPECT_EQ(shares.sqrt, std::nullopt);
    EXPECT_EQ(shares.limit, "roots");
    EXPECT_DOUBLE_EQ(shares.limit_share.value(), 0.2);
    EXPECT_EQ(shares_of(counted, 100, {}), PeakShares());
}

TEST(Counted, shares_are_of_the_device_of_the_record) {
    std::vector<Record> records(3);
    for (Record& record : records) {
        record.params.device = "b:0";
        record.counted = counted_of({1000, 1600, 234000, 30000, 10000, 20000}, 1000);
        record.statistics = Statistics();
        record.statistics->msegments_per_s = 100;
    }
    records[1].params.device = "c:0";
    records[2].statistics.reset();
    add_shares(records, {{"a:0", "", {}}, {"b:0", "", peaks()}});
    EXPECT_EQ(records[0].counted->of_peak, shares_of(*records[0].counted, 100, peaks()));
    EXPECT_EQ(records[1].counted->of_peak, PeakShares());
    EXPECT_EQ(records[2].counted->of_peak, PeakShares());
}

}  // namespace
}  // namespace ptb
