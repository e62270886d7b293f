#include "bench/compare/history.h"

#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "bench/report/history.h"
#include "bench/report/html/page.h"

namespace ptb {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

SessionCase session_case(double ns) {
    SessionCase c;
    c.device = "gpu:0";
    c.device_name = "GPU";
    c.name = "pt thesis";
    c.fingerprint = {{"driver", "3.1"}, {"kernel hash", "aaaa"}};
    for (int i = 0; i < 9; ++i) c.times_ns.push_back(ns * (1 + 0.001 * i));
    return c;
}

Session session(int day, SessionCase c) {
    const std::string date = fmt::format("2031-01-{:02}T00:00:00Z", day);
    return {date + ".json",
            date,
            {std::move(c)},
            fmt::format("{:012x}", 0xabcdef000u + static_cast<unsigned>(day))};
}

/// 24 days, on which times are a little unlike; from the 13th on of another kernel, which is slower.
std::vector<Session> slower_from_the_13th() {
    std::vector<Session> all;
    for (int day = 1; day <= 24; ++day) {
        SessionCase c = session_case((day < 13 ? 1e6 : 1.1e6) * (1 + 0.002 * (day * 7 % 5)));
        if (day >= 13) c.fingerprint[1].value = "bbbb";
        all.push_back(session(day, c));
    }
    return all;
}

History made(std::vector<Session> sessions) {
    return history_of(std::move(sessions), [](const SessionCase&) { return 0.05; });
}

TEST(history, a_kernel_may_change_along_a_line_and_the_change_of_its_time_is_marked) {
    const History history = made(slower_from_the_13th());
    ASSERT_THAT(history.lines, SizeIs(1));
    const HistoryLine& line = history.lines[0];
    ASSERT_THAT(line.points, SizeIs(24));
    ASSERT_THAT(line.steps, SizeIs(1));
    EXPECT_EQ(line.steps[0].at, 12u);
    EXPECT_FALSE(line.steps[0].suspected);
    const auto changes = history_changes(history).grid.rows;
    ASSERT_THAT(changes, SizeIs(1));
    EXPECT_THAT(changes[0], ElementsAre("GPU", "pt thesis", "2031-01-13 00:00", "000abcdef", "13", "1.100",
                                        testing::_, testing::_, "regressed", "aaaa -> bbbb"));
    EXPECT_THAT(history_runs(history).grid.rows[12][3], "pt bbbb");
    EXPECT_THAT(history_runs(history).grid.rows[13][3], "");
}

TEST(history, runs_are_in_the_order_of_their_dates) {
    auto sessions = slower_from_the_13th();
    std::reverse(sessions.begin(), sessions.end());
    EXPECT_EQ(made(sessions), made(slower_from_the_13th()));
}

TEST(history, what_is_not_comparable_has_a_line_of_its_own_and_is_told) {
    auto sessions = slower_from_the_13th();
    for (int day = 13; day <= 24; ++day)
        sessions[static_cast<std::size_t>(day - 1)].cases[0].fingerprint[0].value = "4.0";
    const History history = made(sessions);
    ASSERT_THAT(history.lines, SizeIs(2));
    EXPECT_EQ(history.lines[0].where, "driver 3.1");
    EXPECT_EQ(history.lines[1].where, "driver 4.0");
    EXPECT_THAT(history.lines[0].points, SizeIs(12));
    EXPECT_THAT(history.lines[0].steps, IsEmpty());
    EXPECT_THAT(history.lines[1].steps, IsEmpty());
    EXPECT_THAT(history.apart, ElementsAre("driver: \"3.1\" and \"4.0\""));
    EXPECT_EQ(history_lines(history).grid.columns[2].title, "on");
}

TEST(history, another_text_of_a_scene_is_another_line) {
    auto sessions = slower_from_the_13th();
    for (std::size_t i = 0; i < sessions.size(); ++i) {
        SessionCase& c = sessions[i].cases[0];
        c.params.emplace().scene = "room";
        c.scene_hash = i < 12 ? "0123" : "4567";
    }
    const History history = made(sessions);
    ASSERT_THAT(history.lines, SizeIs(2));
    EXPECT_THAT(history.lines[0].points, SizeIs(12));
    EXPECT_THAT(history.lines[0].steps, IsEmpty());
    EXPECT_EQ(history.lines[1].where, "scene 4567");
    EXPECT_THAT(history.apart, ElementsAre("scene: \"room 0123\" and \"room 4567\""));
}

TEST(history, runs_without_a_time_leave_a_gap) {
    auto sessions = slower_from_the_13th();
    sessions[4].cases[0].no_time = "crashed";
    sessions[4].cases[0].times_ns.clear();
    const History history = made(sessions);
    EXPECT_THAT(history.runs, SizeIs(24));
    EXPECT_THAT(history.lines.at(0).points, SizeIs(23));
    EXPECT_EQ(history.lines[0].points[4].run, 5u);
}

TEST(history, shows_the_newest_hundred_runs) {
    std::vector<Session> sessions;
    for (int i = 0; i < 130; ++i)
        sessions.push_back({"x.json", fmt::format("{:03}", i), {session_case(1e6)}, ""});
    const History history = made(sessions);
    ASSERT_THAT(history.runs, SizeIs(100));
    EXPECT_EQ(history.runs.front().started_at, "030");
}

TEST(history, a_trend_has_a_bar_before_a_change) {
    const auto row = history_lines(made(slower_from_the_13th())).grid.rows.at(0);
    const std::string& trend = row.back();
    EXPECT_THAT(trend.substr(3 * 12), testing::StartsWith("|"));
    EXPECT_EQ(trend.size(), 3u * 24 + 1);
}

TEST(history, the_page_draws_every_line_and_escapes_what_files_are_called) {
    History history = made(slower_from_the_13th());
    history.left_out = {{"<broken>.json", "not JSON"}};
    const std::string html = history_page(history);
    EXPECT_THAT(html,
                HasSubstr("regressed: pt thesis on GPU takes 1.100 times as long since 2031-01-13 00:00"));
    EXPECT_THAT(html, HasSubstr("<line class=\"step slower\""));
    EXPECT_THAT(html, HasSubstr("&lt;broken&gt;.json"));
}

}  // namespace
}  // namespace ptb
