#include "bench/worker/paired.h"

#include <gtest/gtest.h>

#include "tests/support/variable.h"

namespace ptb {
namespace {

DeviceInfo device() {
    DeviceInfo info;
    info.key = "fake:0";
    info.icd = "fake.icd";
    return info;
}

Side side(const std::string& name) {
    return {name,
            process_channels({PTB_FAKE_WORKER, {}}, std::chrono::milliseconds(500), [] { return false; }),
            {}};
}

PairedRun paired(const Stopped& stopped = [] { return false; }) {
    return {device(), side("--base"), side("--new"), stopped};
}

/// The scene says how the fake worker behaves.
PairedCase paired_case(const std::string& base, const std::string& now) {
    PairedCase c;
    c.gate.base.kernel = c.gate.now.kernel = "pt";
    c.gate.base.device = c.gate.now.device = "fake:0";
    c.gate.base.size = c.gate.now.size = {8, 8};
    c.gate.base.scene = base;
    c.gate.now.scene = now;
    return c;
}

PairedCase after_a_block(const std::string& base, const std::string& now) {
    auto run = paired();
    PairedCase c = paired_case(base, now);
    run.validate(c);
    if (c.gate.not_measured.empty()) run.add_block(c, &GateCase::screen);
    return c;
}

TEST(paired, a_block_is_base_new_new_base) {
    const PairedCase c = after_a_block("good", "slower");
    ASSERT_EQ(c.gate.screen.size(), 1u);
    std::vector<std::int64_t> shortest;
    for (const Round& round : c.gate.screen[0].rounds) {
        EXPECT_EQ(round.kernel_ns.size(), 3u);
        shortest.push_back(round.kernel_ns[0]);
    }
    EXPECT_EQ(shortest, (std::vector<std::int64_t>{1'000'000, 1'020'000, 1'020'000, 1'000'000}));
    EXPECT_EQ(c.gate.timer, "event");
}

TEST(paired, each_side_has_a_worker_that_lives) {
    const PairedCase c = after_a_block("good", "good");
    EXPECT_NE(c.base.statistics->n, c.now.statistics->n) << "one process answered for both sides";
}

TEST(paired, a_faulty_timer_on_one_side_means_the_host_clock_for_both) {
    EXPECT_EQ(after_a_block("good", "faulty-timer").gate.timer, "host");
}

TEST(paired, one_sample_in_which_the_clocks_differ_is_a_busy_machine_most_are_a_faulty_timer) {
    EXPECT_EQ(after_a_block("disturbed-once", "good").gate.timer, "event");
    EXPECT_EQ(after_a_block("clocks-differ", "clocks-differ").gate.timer, "host");
}

TEST(paired, what_fails_on_one_side_is_not_measured_and_says_why) {
    const PairedCase base = after_a_block("sigkill", "good");
    EXPECT_EQ(base.gate.not_measured, "base: killed by SIGKILL (9)");
    EXPECT_EQ(base.gate.without_times, State::unmeasured);
    const PairedCase now = after_a_block("good", "sigkill");
    EXPECT_EQ(now.gate.not_measured, "new: killed by SIGKILL (9)");
    EXPECT_EQ(now.gate.without_times, State::missing);
}

TEST(paired, unstable_times_before_the_blocks_are_no_reason_to_leave_a_case_out) {
    EXPECT_EQ(after_a_block("unstable", "good").gate.screen.size(), 1u);
}

TEST(paired, what_fails_in_a_round_loses_its_blocks_and_is_recorded) {
    const PairedCase dead = after_a_block("good", "dies-in-a-round");
    EXPECT_EQ(dead.now.status, Status::crash);
    EXPECT_TRUE(dead.gate.screen.empty());
    const PairedCase wrong = after_a_block("wrong-in-a-round", "good");
    EXPECT_EQ(wrong.base.status, Status::invalid);
}

TEST(paired, a_side_that_does_not_start_ends_the_run) {
    {
        const Variable open("FAKE_OPEN", "refuse");
        EXPECT_THROW(after_a_block("good", "good"), std::runtime_error);
    }
    for (const char* how : {"other-protocol", "refuse-protocol"}) {
        const Variable open("FAKE_OPEN", how);
        EXPECT_THROW(after_a_block("good", "good"), VersionMismatch);
    }
}

TEST(paired, blocks_are_taken_of_all_cases_until_stopped) {
    bool stop = false;
    auto run = paired([&] { return stop; });
    PairedCase one = paired_case("good", "good"), two = paired_case("good", "slower");
    run.validate(one);
    run.validate(two);
    int told = 0;
    const auto count = [&](int done) { told = done; };
    take_blocks(run, {&one, &two}, &GateCase::screen, 3, 7, count);
    EXPECT_EQ(one.gate.screen.size(), 3u);
    EXPECT_EQ(two.gate.screen.size(), 3u);
    EXPECT_EQ(told, 3);
    stop = true;
    take_blocks(run, {&one, &two}, &GateCase::confirm, 3, 7, count);
    EXPECT_TRUE(one.gate.confirm.empty());
}

}  // namespace
}  // namespace ptb
