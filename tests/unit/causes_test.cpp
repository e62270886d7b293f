#include "bench/measure/causes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gmock/gmock.h>

#include "bench/measure/session_clock.h"
#include "bench/measure/stop_rule.h"

namespace ptb {
namespace {

using testing::HasSubstr;

Place on_cpu() { return {true, {}}; }
Place on_virtual_cpu() {
    Place place = on_cpu();
    place.host.virtual_machine = true;
    return place;
}

struct Moment {
    double ms = 100;
    double probe_us = 30;
    std::string cause = {};
};

std::vector<TimeSample> samples_of(const std::vector<Moment>& moments) {
    std::vector<TimeSample> samples;
    for (const Moment& m : moments) {
        TimeSample& sample = samples.emplace_back();
        sample.kernel_ns = sample.host_ns = std::llround(m.ms * 1e6);
        sample.probe_ns = std::llround(m.probe_us * 1e3);
        sample.cause = m.cause;
    }
    flag_low_clock(samples);
    return samples;
}

/// `n` samples of about 100 ms with half a percent of noise, slowed as `slow` says of their number.
std::vector<TimeSample> slowed(int n, const std::function<double(int)>& slow, double probes_follow = 1) {
    std::minstd_rand random(3);
    std::vector<Moment> moments;
    for (int i = 0; i < n; ++i) {
        const double noise = static_cast<double>(random()) / std::minstd_rand::max() - 0.5;
        moments.push_back({100 * slow(i) * (1 + 0.01 * noise), 30 * (1 + probes_follow * (slow(i) - 1))});
    }
    return samples_of(moments);
}

int flagged(const std::vector<TimeSample>& samples, const std::string& why = cause::clock_low) {
    return static_cast<int>(std::count_if(samples.begin(), samples.end(),
                                          [&](const TimeSample& sample) { return sample.cause == why; }));
}

/// Why an unstable case is one.
std::string distrusted(const std::vector<TimeSample>& samples, const Place& place = on_cpu(),
                       bool host_clock = false) {
    const std::string lost = lost_time(samples, host_clock, place);
    return lost.empty() ? vague_median(samples, host_clock, 1, place) : lost;
}

TEST(Causes, a_clock_that_stays_low_is_no_flaw_of_a_case) {
    const auto low = slowed(20, [](int) { return 1.3; });
    EXPECT_EQ(flagged(low), 0);
    EXPECT_EQ(distrusted(low), "");
}

TEST(Causes, a_clock_that_falls_for_some_samples_flags_them_and_they_leave_the_statistics) {
    const auto samples = slowed(20, [](int i) { return i >= 12 ? 1.3 : 1.0; });
    const Kept kept = keep(samples, false, 1);
    EXPECT_EQ(flagged(samples), 8);
    EXPECT_EQ(kept.flagged, 8);
    EXPECT_EQ(kept.times_ns.size(), 12U);
    EXPECT_LT(*std::max_element(kept.times_ns.begin(), kept.times_ns.end()), 102e6);
    EXPECT_EQ(distrusted(samples), "");
}

TEST(Causes, a_clock_that_falls_halfway_leaves_a_median_that_nobody_knows) {
    const auto samples = slowed(20, [](int i) { return i >= 10 ? 1.3 : 1.0; });
    EXPECT_EQ(keep(samples, false, 1).times_ns.size(), 20U) << "nothing may be dropped silently";
    EXPECT_THAT(distrusted(samples), HasSubstr("the median is known to 1"));
    EXPECT_THAT(distrusted(samples), HasSubstr("% only (20 samples, flagged: clock_low 10): "));
}

TEST(Causes, a_flag_is_taken_back_when_the_state_lasts) {
    auto samples = slowed(12, [](int i) { return i < 5 ? 1.0 : 1.1; });
    EXPECT_EQ(flagged(samples), 0) << "seven of twelve are the case's usual clock";
    samples.resize(9);
    flag_low_clock(samples);
    EXPECT_EQ(flagged(samples), 4);
}

TEST(Causes, probes_that_hiccup_do_not_spoil_times_that_agree) {
    // A virtual machine of two cores of an EPYC, `thesis` in work-groups of 64: probes in us, times in ms.
    const std::vector<Moment> recorded{
        {148.3, 32.6}, {148.5, 31.6}, {155.0, 30.7}, {146.7, 31.9}, {165.2, 32.6}, {144.7, 32.6},
        {143.9, 31.6}, {140.5, 31.9}, {137.8, 32.6}, {136.4, 32.3}, {134.9, 31.6}, {136.3, 32.3},
        {134.8, 32.3}, {136.0, 36.1}, {137.1, 37.7}, {138.8, 32.6}, {137.5, 32.3}, {137.4, 31.6},
        {137.3, 39.7}, {136.2, 31.9}, {136.9, 32.6}, {137.4, 32.3}, {136.0, 31.9}, {135.9, 31.9},
        {134.7, 30.7}, {134.6, 31.6}, {136.1, 31.6}, {136.0, 32.3}, {137.0, 32.6}, {137.1, 39.7},
        {137.0, 31.9}, {134.6, 31.6}, {134.7, 32.3}, {137.2, 36.5}, {136.0, 40.4}};
    const auto samples = samples_of(recorded);
    EXPECT_EQ(flagged(samples), 6);
    EXPECT_EQ(distrusted(samples, on_virtual_cpu()), "");
}

TEST(Causes, bursts_of_a_neighbour_are_left_out_while_they_are_rare) {
    auto samples = slowed(
        20, [](int i) { return i % 5 == 0 ? 1.5 : 1.0; }, 0);
    for (std::size_t i = 0; i < samples.size(); i += 5) samples[i].cause = cause::busy;
    EXPECT_EQ(keep(samples, false, 1).times_ns.size(), 16U);
    EXPECT_EQ(distrusted(samples), "");
}

TEST(Causes, a_neighbour_that_stays_is_told_however_narrow_the_interval_is) {
    auto samples = slowed(
        20, [](int) { return 1.5; }, 0);
    for (std::size_t i = 0; i < 10; ++i) samples[2 * i].cause = cause::busy;
    EXPECT_EQ(distrusted(samples),
              "10 of 20 samples are flagged (busy 10): other programs take CPU time: end what `top` shows");
    samples[0].cause.clear();
    EXPECT_EQ(distrusted(samples), "");
}

TEST(Causes, times_that_vary_for_no_known_cause_are_told_by_their_interval) {
    const auto wide = slowed(
        11, [](int i) { return 1 + 0.03 * i; }, 0);
    EXPECT_THAT(distrusted(wide), HasSubstr("% only (11 samples): end other programs"));
    const auto narrow = slowed(
        11, [](int i) { return 1 + 0.01 * i; }, 0);
    EXPECT_EQ(distrusted(narrow), "") << "an interval of +- 3.6 % is no instability";
    EXPECT_EQ(distrusted(samples_of({{100}, {150}, {130}})), "") << "three samples have no interval";
}

TEST(Causes, advice_fits_the_machine) {
    Place laptop = on_cpu(), container = on_cpu();
    laptop.host.battery = true;
    container.host.container = true;
    const auto clock = [](const Place& place) { return advice(cause::clock_low, place); };
    EXPECT_THAT(clock({}), HasSubstr("nvidia-smi"));
    EXPECT_THAT(clock(on_virtual_cpu()), HasSubstr("ptbench ab"));
    EXPECT_THAT(clock(on_virtual_cpu()), testing::Not(HasSubstr("cool")))
        << "nobody can cool a virtual machine";
    EXPECT_THAT(clock(laptop), HasSubstr("plug"));
    EXPECT_THAT(clock(on_cpu()), HasSubstr("ptbench doctor"));
    EXPECT_THAT(advice(cause::busy, container), HasSubstr("--cpuset-cpus"));
    EXPECT_THAT(advice("", on_virtual_cpu()), HasSubstr("neighbours"));
}

TEST(Causes, faulty_event_times_are_no_flaw_of_the_hosts) {
    for (const char* why : {cause::timer_fault, cause::clocks_differ}) {
        const auto samples = samples_of({{100, 30, why}, {100, 30, why}, {100, 30, why}});
        EXPECT_THAT(distrusted(samples), HasSubstr("--timer"));
        EXPECT_EQ(distrusted(samples, on_cpu(), true), "");
        EXPECT_EQ(keep(samples, true, 1).flagged, 0);
    }
}

TEST(Causes, one_late_host_is_no_fault_of_the_device) {
    std::vector<Moment> moments(10);
    moments[4].cause = cause::clocks_differ;
    EXPECT_EQ(distrusted(samples_of(moments)), "");
    EXPECT_EQ(keep(samples_of(moments), false, 1).flagged, 1);
    const std::string of_two = distrusted(samples_of({{100}, {100, 30, cause::clocks_differ}}));
    EXPECT_THAT(of_two, HasSubstr("busy machine"));
    EXPECT_THAT(of_two, testing::Not(HasSubstr("wrong")));
}

Record probed(const std::string& device, int spp, const std::vector<Moment>& moments) {
    Record record;
    record.params.device = device;
    record.params.spp = spp;
    record.samples = samples_of(moments);
    return record;
}

TEST(SessionClock, cases_with_a_lower_clock_than_others_are_counted_by_device) {
    const std::vector<Moment> best{{100, 30}, {100, 30}, {100, 30}}, low{{120, 36}, {120, 36}, {120, 30}};
    const std::vector<Record> records{probed("a", 1, best), probed("a", 2, low), probed("a", 3, low),
                                      probed("b", 1, low), probed("b", 2, low)};
    const std::vector<LowClock> expected{{"a", 2, 3, 30.0 / 36}};
    EXPECT_EQ(low_clocks(records), expected) << "b is as slow everywhere";
}

TEST(SessionClock, single_probes_say_nothing) {
    const std::vector<Moment> hiccup{{100, 40}}, few{{100, 30}, {100, 40}},
        some{{100, 30}, {100, 40}, {100, 30}};
    EXPECT_TRUE(low_clocks({probed("a", 1, hiccup), probed("a", 2, few), probed("a", 3, some)}).empty());
}

}  // namespace
}  // namespace ptb
