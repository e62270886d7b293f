#include "bench/measure/cpu_time.h"

#include <fstream>

#include <gtest/gtest.h>

namespace ptb {
namespace {

namespace fs = std::filesystem;

TEST(CpuTime, stolen_time_is_read_from_the_system) {
    const CpuTicks before = parse_cpu_ticks("cpu  100 2 30 800 5 0 1 10 7 0");
    EXPECT_EQ(before.all, 948U);
    EXPECT_EQ(before.stolen, 10U);
    EXPECT_EQ(stolen_share(before, {before.all + 10, before.stolen + 1}), 0) << "one tick may be rounding";
    EXPECT_DOUBLE_EQ(stolen_share(before, {before.all + 1000, before.stolen + 20}), 0.02);
    EXPECT_EQ(parse_cpu_ticks("cpu  1 2").all, 0U);
    EXPECT_EQ(parse_cpu_ticks("").all, 0U);
    EXPECT_EQ(stolen_share({}, {}), 0);
}

TEST(CpuTime, the_schedulers_files_are_read) {
    EXPECT_EQ(parse_scheduled("296562452 898261 29\n"), (Scheduled{296562452, 898261}));
    EXPECT_EQ(parse_scheduled("1"), Scheduled{});
    EXPECT_EQ(parse_scheduled(""), Scheduled{});
}

TEST(CpuTime, a_process_is_all_of_its_threads) {
    const fs::path root = fs::path(testing::TempDir()) / "ptbench-cpu-time";
    for (const char* thread : {"7", "8"}) {
        fs::create_directories(root / "proc/self/task" / thread);
        std::ofstream(root / "proc/self/task" / thread / "schedstat") << "1000 10 3\n";
    }
    EXPECT_EQ(scheduled_process(root), (Scheduled{2000, 20}));
    fs::remove_all(root);
    EXPECT_EQ(scheduled_process(root), Scheduled{}) << "a kernel that does not count";
}

/// What others took of a process that ran and waited for so long, in 100 ns on `cpus`.
double lost(std::int64_t ran_ns, std::int64_t waited_ns, double cpus) {
    return lost_share({1000, 1000}, {1000 + ran_ns, 1000 + waited_ns}, 100, cpus);
}

TEST(CpuTime, what_others_had_of_a_process_time_is_lost) {
    EXPECT_EQ(lost(200, 0, 2), 0);
    EXPECT_DOUBLE_EQ(lost(150, 50, 2), 0.25) << "a program on one of two CPUs";
    EXPECT_DOUBLE_EQ(lost(60, 20, 2), 0.25) << "one that does not use all CPUs can lose, too";
    EXPECT_EQ(lost(60, 0, 2), 0);
}

TEST(CpuTime, threads_that_wait_for_each_other_lose_nothing) {
    EXPECT_EQ(lost(100, 100, 1), 0) << "two threads on one CPU";
    EXPECT_DOUBLE_EQ(lost(50, 150, 1), 0.5) << "and another program on it";
    EXPECT_EQ(lost(150, 6000, 1.5), 0) << "64 threads in a container of one and a half CPUs";
    EXPECT_EQ(lost(0, 0, 1), 0) << "nothing was counted";
}

}  // namespace
}  // namespace ptb
