#include "core/tree/crew.h"

#include <atomic>
#include <numeric>
#include <stdexcept>

#include <gmock/gmock.h>

namespace ptb::tree {
namespace {

/// Adds tasks below tasks, and counts the last ones.
void add_below(Crew& crew, int levels, std::atomic<int>& ends) {
    if (levels == 0) {
        ++ends;
        return;
    }
    for (int i = 0; i < 2; ++i) crew.add([&crew, levels, &ends] { add_below(crew, levels - 1, ends); });
}

TEST(Crew, finishes_what_tasks_add) {
    for (const int threads : {1, 2, 5}) {
        Crew crew(threads);
        std::atomic<int> ends = 0;
        add_below(crew, 10, ends);
        crew.finish();
        EXPECT_EQ(ends, 1024) << threads << " threads";
    }
}

TEST(Crew, chunks_cover_everything_once_also_within_tasks) {
    for (const int threads : {1, 2, 5}) {
        Crew crew(threads);
        std::vector<std::vector<int>> touched(20, std::vector<int>(1001, 0));
        for (auto& row : touched)
            crew.add([&crew, &row] {
                crew.for_chunks(row.size(), 10, [&row](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i) ++row[i];
                });
            });
        crew.finish();
        for (const auto& row : touched) EXPECT_THAT(row, testing::Each(1));
    }
}

TEST(Crew, a_task_s_error_comes_out_once_and_loses_no_task) {
    for (const int threads : {1, 3}) {
        Crew crew(threads);
        std::atomic<int> done = 0;
        for (int i = 0; i < 50; ++i)
            crew.add([&done, i] {
                ++done;
                if (i == 20) throw std::runtime_error("one of fifty");
            });
        EXPECT_THROW(crew.finish(), std::runtime_error);
        EXPECT_EQ(done, 50);
        EXPECT_NO_THROW(crew.finish());
    }
}

TEST(Crew, nothing_to_do_is_no_reason_to_wait) {
    Crew crew(4);
    crew.finish();
    crew.for_chunks(0, 8, [](std::size_t, std::size_t) { FAIL() << "no chunk was there"; });
}

}  // namespace
}  // namespace ptb::tree
