#include "bench/measure/method.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "bench/measure/causes.h"

namespace ptb {
namespace {

/// A device that does not exist: each render takes what `render_ns` says of its number and of the time, and
/// the same seed gives the same times.
struct Device {
    std::function<double(int number, double now_s)> render_ns;
    std::string timer_fault = {};
    double now_s = 0;
    int warm_ups = 0, samples = 0, most_renders = 0;

    TimedRender take(const std::string& stage, int renders) {
        double ns = 0;
        for (int i = 0; i < renders; ++i) ns += render_ns(warm_ups + samples, now_s);
        (stage == "warmup" ? warm_ups : samples) += 1;
        most_renders = std::max(most_renders, renders);
        now_s += ns * 1e-9;
        TimedRender timed;
        timed.time.kernel_ns = timed.time.sum_ns = std::llround(ns);
        timed.time.host_ns = std::llround(ns * 1.001);
        timed.timer.fault = timer_fault;
        if (!timer_fault.empty()) timed.time.cause = cause::timer_fault;
        return timed;
    }
};

/// Times around `ms` with relative normal noise, of a generator of their own: std's is not the same
/// everywhere.
auto noisy(double ms, double noise) {
    return [=, random = std::minstd_rand(7)](int, double) mutable {
        double sum = 0;
        for (int i = 0; i < 12; ++i) sum += static_cast<double>(random()) / std::minstd_rand::max();
        return ms * 1e6 * (1 + noise * (sum - 6));
    };
}

struct Result {
    Measurement measured;
    Statistics statistics;
    std::string unstable;
};

Result run(Device& device, Method method = {}, const std::string& asked = "auto") {
    TimerWatch timer(asked);
    const auto measured = measure(
        method, timer, [&](const std::string& stage, int renders) { return device.take(stage, renders); },
        [&] { return device.now_s; });
    return {measured, describe(measured, timer), unstable_reason(measured, timer, {})};
}

double half_width(const Statistics& s) { return (*s.ci_high_ns - *s.ci_low_ns) / 2 / s.median_ns; }

TEST(Method, a_quiet_device_needs_the_fewest_samples) {
    Device device{noisy(10, 0.002)};
    const Result result = run(device);
    EXPECT_EQ(result.statistics.stop_reason, "precision");
    EXPECT_EQ(device.warm_ups, 6);
    EXPECT_EQ(result.statistics.n, 10);
    EXPECT_NEAR(result.statistics.median_ns, 10e6, 0.01e6);
}

TEST(Method, noise_is_answered_with_samples_until_the_median_is_known_to_one_percent) {
    Device quiet{noisy(10, 0.01)}, loud{noisy(10, 0.05)};
    const Result one = run(quiet), five = run(loud);
    for (const Result& result : {one, five}) {
        EXPECT_EQ(result.statistics.stop_reason, "precision");
        EXPECT_LE(half_width(result.statistics), 0.01);
        EXPECT_NEAR(result.statistics.median_ns, 10e6, 0.02 * 10e6);
    }
    EXPECT_GT(five.statistics.n, 5 * one.statistics.n);
    EXPECT_LE(loud.warm_ups, 10);
}

TEST(Method, the_interval_holds_the_true_median_as_often_as_it_says) {
    int held = 0;
    for (int seed = 0; seed < 200; ++seed) {
        auto times = noisy(10, 0.03);
        for (int i = 0; i < 97 * 12 * seed; ++i) times(0, 0);
        Device device{times};
        const Statistics s = run(device).statistics;
        held += *s.ci_low_ns <= 10e6 && 10e6 <= *s.ci_high_ns ? 1 : 0;
    }
    EXPECT_GE(held, 180) << "of 200: looking more often than the rule does would stop on narrow luck";
}

TEST(Method, bursts_of_neighbours_do_not_move_the_median) {
    auto quiet = noisy(10, 0.002);
    Device device{[quiet](int number, double now) mutable {
        return quiet(number, now) * (number % 20 < 4 && number > 10 ? 1.5 : 1);
    }};
    const Result result = run(device);
    EXPECT_EQ(result.statistics.stop_reason, "precision");
    EXPECT_NEAR(result.statistics.median_ns, 10e6, 0.01 * 10e6);
}

TEST(Method, a_device_that_is_still_warming_up_is_waited_for) {
    auto steady = noisy(100, 0.002);
    Device device{[steady](int number, double now) mutable {
        return steady(number, now) * (1 + 0.5 * std::exp(-now / 0.2));
    }};
    const Result result = run(device);
    EXPECT_GT(device.warm_ups, 6);
    EXPECT_NEAR(result.statistics.median_ns, 100e6, 0.02 * 100e6);
}

TEST(Method, drift_is_sampled_no_longer_than_it_may_be) {
    auto steady = noisy(10, 0.002);
    Device device{[steady](int number, double now) mutable { return steady(number, now) * (1 + 0.1 * now); }};
    Method method;
    method.stop.min_samples = 300;
    method.stop.max_time_s = 5;
    const Result result = run(device, method);
    EXPECT_EQ(result.statistics.stop_reason, "max_time");
    EXPECT_GT(half_width(result.statistics), 0.01) << "a drifting time must not look precise";
}

TEST(Method, cold_samples_are_flagged_when_they_can_be_spared) {
    Method method;
    method.warmup = 0;
    Device many{[](int number, double) { return number == 0 ? 50e6 : 10e6; }};
    const Result spared = run(many, method);
    EXPECT_EQ(spared.measured.samples.front().cause, "first");
    EXPECT_EQ(spared.statistics.max_ns, 10e6);
    EXPECT_EQ(spared.statistics.flagged, 1);
    method.stop.max_samples = 2;
    Device few{[](int, double) { return 10e6; }};
    EXPECT_EQ(run(few, method).statistics.flagged, 0);
}

TEST(Method, long_samples_are_few_and_were_warmed_up_by_the_validation) {
    struct Row {
        double sample_s;
        int samples;
        std::string reason;
    };
    for (const Row& row : {Row{4, 6, "precision"}, Row{40, 3, "low_n"}, Row{400, 1, "low_n"}}) {
        Device device{[&](int, double) { return row.sample_s * 1e9; }};
        Method method;
        method.predicted_s = row.sample_s;
        method.stop.max_time_s = 1000;
        const Result result = run(device, method);
        EXPECT_EQ(device.warm_ups, 0);
        EXPECT_EQ(result.statistics.n, row.samples) << row.sample_s;
        EXPECT_EQ(result.statistics.stop_reason, row.reason);
        EXPECT_EQ(result.statistics.ci_low_ns.has_value(), row.samples >= 6);
    }
}

TEST(Method, caps_are_kept_and_one_sample_is_always_taken) {
    Method method;
    method.warmup = 2;
    method.stop.max_samples = 3;
    Device counted{noisy(10, 0.05)};
    EXPECT_EQ(run(counted, method).statistics.stop_reason, "max_samples");
    EXPECT_EQ(counted.warm_ups, 2);
    EXPECT_EQ(counted.samples, 3);
    method.stop.max_samples = 1000;
    method.stop.time_left_s = 0;
    method.predicted_s = 0.01;
    Device broke{noisy(10, 0.05)};
    EXPECT_EQ(run(broke, method).statistics.stop_reason, "max_total_time");
    EXPECT_EQ(broke.warm_ups, 0) << "no budget, no repetitions";
    EXPECT_EQ(broke.samples, 1);
}

TEST(Method, renders_too_short_for_the_timer_are_measured_many_at_a_time) {
    Method method;
    method.resolution_ns = 1000;
    Device device{noisy(0.01, 0.002)};
    const Result result = run(device, method);
    EXPECT_EQ(result.measured.renders, device.most_renders);
    EXPECT_NEAR(result.measured.renders, 10, 1) << "100 ticks of 1 us are 10 renders of 10 us";
    EXPECT_NEAR(result.statistics.median_ns, 10'000, 100) << "the time is that of one render";
}

TEST(Method, a_clock_that_contradicts_itself_is_replaced_unless_it_is_insisted_on) {
    Device device{noisy(10, 0.002), "the device's event times are zero"};
    const Result host = run(device), event = run(device, {}, "event");
    EXPECT_EQ(host.statistics.timer, "host");
    EXPECT_EQ(host.statistics.timer_reason, "the device's event times are zero");
    EXPECT_EQ(host.statistics.flagged, 0);
    EXPECT_NEAR(host.statistics.median_ns, 10.01e6, 0.02e6);
    EXPECT_EQ(host.unstable, "");
    EXPECT_EQ(event.statistics.timer, "event");
    EXPECT_EQ(
        event.unstable,
        "10 of 10 samples are flagged (timer_fault 10): the device's event times are wrong: use --timer auto "
        "or host");
}

TEST(Warm, two_windows_of_three_must_agree) {
    const std::vector<double> falling{150, 140, 130, 101, 100, 99};
    EXPECT_FALSE(warm(falling, 1, 30));
    EXPECT_TRUE(warm(falling, 5, 30)) << "5 s are enough";
    EXPECT_TRUE(warm(falling, 1, 2)) << "half of the time for samples is enough";
    const std::vector<double> steady{150, 101, 100, 99, 100, 101, 99};
    EXPECT_TRUE(warm(steady, 1, 30));
    EXPECT_FALSE(warm(std::vector<double>(5, 100.0), 1, 30));
    EXPECT_TRUE(warm(std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, 1, 30)) << "10 samples are enough";
}

}  // namespace
}  // namespace ptb
