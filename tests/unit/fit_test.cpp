#include "bench/measure/fit.h"

#include <vector>

#include <gtest/gtest.h>

namespace ptb {
namespace {

Record timed(int spp, double ms, const std::string& kernel = "pt") {
    Record record;
    record.params = {"pocl:0", kernel, "thesis", {64, 64}, spp, 128, {}, 0};
    record.status = Status::ok;
    record.statistics.emplace().median_ns = ms * 1e6;
    return record;
}

TEST(Fit, a_straight_line_is_found) {
    const SppFit fit = fit_line(std::vector<SppPoint>{{10, 7e6}, {100, 52e6}, {1000, 502e6}});
    EXPECT_NEAR(fit.overhead_ms, 2, 1e-9);
    EXPECT_NEAR(fit.ms_per_spp, 0.5, 1e-12);
    EXPECT_NEAR(fit.r2, 1, 1e-12);
    EXPECT_EQ(fit.warning, "");
}

TEST(Fit, a_percent_on_the_longest_does_not_move_the_overhead) {
    const SppFit fit = fit_line(std::vector<SppPoint>{{10, 7e6}, {100, 52e6}, {1000, 507e6}});
    EXPECT_NEAR(fit.overhead_ms, 2, 0.1) << "unweighted it would be off by a millisecond or more";
    EXPECT_EQ(fit.warning, "");
}

TEST(Fit, a_bad_fit_warns_with_the_point_and_a_cause) {
    const SppFit fit = fit_line(std::vector<SppPoint>{{10, 5e6}, {20, 10e6}, {40, 20e6}, {80, 60e6}});
    EXPECT_NE(fit.warning.find("SPP"), std::string::npos);
    EXPECT_NE(fit.warning.find("likely the clock moved"), std::string::npos) << fit.warning;
    EXPECT_LT(fit.r2, 0.99);
    EXPECT_NE(fit_line(std::vector<SppPoint>{{1, 5e6}, {2, 5e6}, {4, 4.9e6}}).warning, "");
}

TEST(Fit, three_ok_cases_that_differ_in_spp_alone_make_a_line) {
    Record skipped = timed(1000, 1);
    skipped.status = Status::skipped;
    skipped.statistics.reset();
    const std::vector<Record> records{
        timed(10, 7), timed(1000, 502), timed(100, 52), timed(10, 70, "thesis"), timed(100, 520, "thesis"),
        skipped};
    const auto fits = fits_over_spp(records);
    ASSERT_EQ(fits.size(), 1U);
    EXPECT_EQ(fits[0].params, timed(1000, 0).params);
    EXPECT_EQ(fits[0].points, 3);
    EXPECT_NEAR(fits[0].overhead_ms, 2, 1e-6);
}

}  // namespace
}  // namespace ptb
