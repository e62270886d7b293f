#include "bench/measure/timer.h"

#include <vector>

#include <gtest/gtest.h>

namespace ptb {
namespace {

/// One launch of 100 us that began when the clock showed a second.
LaunchTimes launch(std::uint64_t start = 1'000'000'000, std::uint64_t end = 1'000'100'000) {
    return {start - 3000, start - 1000, start, end};
}

std::string fault_of(const LaunchTimes& times, std::int64_t host_ns = 120'000,
                     std::uint64_t resolution_ns = 1) {
    return timer_fault(std::vector{times}, host_ns, resolution_ns);
}

TEST(Timer, good_times_have_no_fault) { EXPECT_EQ(fault_of(launch()), ""); }

TEST(Timer, each_rule_names_what_is_wrong) {
    EXPECT_EQ(fault_of({0, 0, 0, 0}), "the device's event times are zero");
    EXPECT_EQ(fault_of({1, 2, 3, 0}), "the device's event times are zero");
    EXPECT_EQ(fault_of(launch(1'000'000'000, 999'999'999)), "an event ends 1 ns before it starts");
    EXPECT_EQ(fault_of({10, 9, 11, 12}), "an event starts before it was submitted");
    EXPECT_EQ(fault_of({8, 12, 11, 13}), "an event starts before it was submitted");
    EXPECT_EQ(fault_of(launch(), 90'000), "an event lasts 100000 ns where the host waited 90000 ns");
}

TEST(Timer, an_unsigned_underflow_is_caught) {
    EXPECT_NE(fault_of(launch(1'000'000'000, ~std::uint64_t{0} - 5)), "");
}

TEST(Timer, two_percent_and_one_tick_are_allowed) {
    EXPECT_EQ(fault_of(launch(), 98'100), "");
    EXPECT_NE(fault_of(launch(), 98'000), "");
    EXPECT_EQ(fault_of(launch(), 90'000, 10'000), "");
}

TEST(Timer, overlapping_launches_count_once) {
    EXPECT_EQ(union_ns(std::vector{launch(5000, 5100), launch(5050, 5150), launch(5200, 5210)}), 160);
}

TEST(Timer, overlap_is_the_share_of_launches_beside_another) {
    TimeSample alone, beside;
    alone.sum_ns = alone.kernel_ns = 100;
    beside.sum_ns = 300;
    beside.kernel_ns = 200;
    EXPECT_DOUBLE_EQ(overlap_of(std::vector{alone, beside}).value(), 0.25);
    EXPECT_EQ(overlap_of(std::vector{alone}), 0);
    EXPECT_EQ(overlap_of(std::vector{TimeSample{}}), std::nullopt) << "no time at all";
}

TEST(Timer, clocks_may_differ_by_a_fifth_over_ten_milliseconds) {
    EXPECT_FALSE(clocks_disagree(10'000'000, 12'000'000));
    EXPECT_TRUE(clocks_disagree(10'000'000, 12'000'001));
    EXPECT_FALSE(clocks_disagree(1'000'000, 9'000'000)) << "too short to judge";
}

TEST(Timer, the_tick_is_what_the_timestamps_advance_by) {
    const std::vector coarse{LaunchTimes{2'000'000, 2'000'000, 3'000'000, 17'000'000},
                             LaunchTimes{17'000'000, 18'000'000, 18'000'000, 18'000'000}};
    EXPECT_EQ(tick_ns(coarse, 0), 1'000'000U);
    EXPECT_EQ(tick_ns(std::vector{LaunchTimes{1, 4, 8, 1003}}, 0), 1U);
    EXPECT_EQ(tick_ns(std::vector{LaunchTimes{5, 5, 5, 5}}, 0), 0U) << "nothing is known";
}

TEST(Timer, samples_last_a_hundred_ticks) {
    EXPECT_EQ(renders_per_sample(50'000, 1000), 2);
    EXPECT_EQ(renders_per_sample(100'000, 1000), 1);
    EXPECT_EQ(renders_per_sample(30e6, 1'000'000), 4);
    EXPECT_EQ(renders_per_sample(0, 1'000'000), 10'000) << "bounded";
}

TEST(TimerWatch, a_device_is_believed_until_it_contradicts_itself_once) {
    TimerWatch watch("auto");
    watch.observe({});
    EXPECT_FALSE(watch.host());
    watch.observe({"an event ends 1 ns before it starts", false, 0});
    EXPECT_TRUE(watch.host());
    watch.restart();
    watch.observe({});
    EXPECT_TRUE(watch.host()) << "from then on";
    EXPECT_EQ(watch.reason(), "an event ends 1 ns before it starts");
}

TEST(TimerWatch, one_sample_that_disagrees_is_a_busy_machine_and_most_are_a_fault) {
    TimerWatch watch("auto");
    for (const bool disagrees : {false, true, false}) watch.observe({"", disagrees, 0});
    EXPECT_FALSE(watch.host());
    watch.observe({"", true, 0});
    EXPECT_FALSE(watch.host());
    watch.observe({"", true, 0});
    EXPECT_TRUE(watch.host());
    EXPECT_EQ(watch.reason(), "the events miss over a sixth of the host's time in 3 of 5 samples");
    watch.restart();
    EXPECT_TRUE(watch.host()) << "a device keeps its fault";
}

TEST(TimerWatch, a_single_sample_that_disagrees_convicts_its_case_and_not_the_device) {
    TimerWatch watch("auto");
    watch.observe({"", true, 0});
    EXPECT_TRUE(watch.host());
    watch.restart();
    EXPECT_FALSE(watch.host());
}

TEST(TimerWatch, the_clock_that_is_asked_for_is_used) {
    TimerWatch event("event"), host("host");
    event.observe({"the device's event times are zero", true, 0});
    EXPECT_FALSE(event.host());
    EXPECT_EQ(event.reason(), "");
    EXPECT_TRUE(host.host());
    EXPECT_EQ(host.reason(), "asked for");
}

TEST(TimerWatch, the_resolution_is_the_coarser_of_claim_and_sight) {
    TimerWatch watch("auto");
    EXPECT_EQ(watch.resolution_ns(1), 1U);
    watch.observe({"", false, 3'000'000});
    watch.observe({"", false, 5'000'000});
    EXPECT_EQ(watch.resolution_ns(1), 1'000'000U);
    EXPECT_EQ(TimerWatch("host").resolution_ns(1), 1000U);
}

}  // namespace
}  // namespace ptb
