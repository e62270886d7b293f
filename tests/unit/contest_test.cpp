#include "bench/tune/contest.h"

#include <gmock/gmock.h>

#include "bench/report/race.h"

namespace ptb {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

/// A contest of candidates whose scenes say how the fake worker behaves; each has a work-group of its own.
Contest contest(
    const std::vector<std::string>& scenes, const Stopped& stopped = [] { return false; }) {
    DeviceInfo device;
    device.key = "fake:0";
    device.icd = "fake.icd";
    DeviceWorker worker(device,
                        process_channels({PTB_FAKE_WORKER, {}}, std::chrono::milliseconds(500), stopped), {});
    std::vector<Case> candidates;
    for (const std::string& scene : scenes)
        candidates.push_back(
            {"fake:0", "pt", scene, {8, 8}, 1, 5, {static_cast<int>(candidates.size()), 0}, 4});
    return hold_contest(worker, candidates, {}, stopped, [](const std::string&) {});
}

TEST(contest, the_fastest_wins) {
    const Contest held = contest({"slower", "good", "slower"});
    EXPECT_EQ(held.race.leader, 1u);
    EXPECT_EQ(held.timer, "event");
}

TEST(contest, a_wrong_image_never_races) {
    const Contest held = contest({"invalid", "slower"});
    EXPECT_THAT(held.raced, ElementsAre(1u));
    EXPECT_EQ(held.race.leader, 0u);
    EXPECT_FALSE(contest({"invalid"}).race.leader);
}

TEST(contest, who_fails_in_the_race_leaves_it_and_is_recorded) {
    for (const auto& [scene, status] :
         {std::pair("wrong-in-a-round", Status::invalid), std::pair("dies-in-a-round", Status::crash)}) {
        const Contest held = contest({scene, "slower"});
        EXPECT_EQ(held.race.leader, 1u) << scene;
        EXPECT_EQ(held.records[0].status, status);
    }
}

TEST(contest, goes_by_the_host_clock_where_most_event_times_are_not_believed) {
    const Contest held = contest({"slow-by-host", "fast-by-host", "slower"});
    EXPECT_EQ(held.timer, "host");
    EXPECT_EQ(held.race.runners[0].times.front(), 6'000'000);
    EXPECT_EQ(contest({"fast-by-host", "good"}).timer, "event");
}

TEST(contest, takes_no_more_samples_when_stopped) {
    EXPECT_FALSE(contest({"good", "slower"}, [] { return true; }).race.leader);
}

TEST(contest, is_shown_best_first_with_what_tuning_gains) {
    const Contest held = contest({"slower", "good", "invalid"});
    const Section section = race_section(held, "", 4);
    ASSERT_EQ(section.grid.rows.size(), 2u);
    EXPECT_THAT(section.grid.rows[0], ElementsAre("4", "1", "1.000", "-", "-", "3", "best"));
    EXPECT_THAT(section.grid.rows[1], ElementsAre("4", "implicit", "-", "+2.0 %", "-", "3", "slower"));
    EXPECT_THAT(section.notes, Contains(HasSubstr("untuned, lanes 4, work-group implicit is taken: +2.0 %")));
}

}  // namespace
}  // namespace ptb
