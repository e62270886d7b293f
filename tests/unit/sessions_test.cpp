#include "bench/compare/sessions.h"

#include <cmath>

#include <gtest/gtest.h>

namespace ptb {
namespace {

/// Ten samples about `ns`, spread by 0.1 % each, shifted a little by `session`.
SessionCase session_case(const std::string& name, double ns, int session = 0) {
    SessionCase c;
    c.device = "pocl:0";
    c.name = name;
    c.fingerprint = {{"driver", "3.1"}, {"CPU", "EPYC"}};
    for (int i = 0; i < 10; ++i) c.times_ns.push_back(ns * (1 + 0.001 * ((i * 3 + session * 7) % 10)));
    return c;
}

SessionCase without_time(const std::string& name) {
    SessionCase c;
    c.device = "pocl:0";
    c.name = name;
    c.no_time = "crashed";
    return c;
}

Session session(std::vector<SessionCase> cases, const std::string& started_at = "") {
    return {"file.json", started_at, std::move(cases)};
}

std::vector<Session> sessions(int count, double ns) {
    std::vector<Session> all;
    for (int i = 0; i < count; ++i)
        all.push_back(session({session_case("a", ns * (1 + 0.002 * (i % 5)), i)}, std::to_string(i)));
    return all;
}

CompareRules rules() {
    CompareRules made;
    made.tolerance = [](const SessionCase&) { return 0.05; };
    return made;
}

Row only(const Comparison& comparison) {
    EXPECT_EQ(comparison.rows.size(), 1u);
    return comparison.rows.at(0);
}

TEST(sessions, times_are_of_one_render_where_a_sample_holds_several) {
    Record record;
    record.status = Status::ok;
    record.statistics.emplace().timer = "event";
    record.work.emplace().renders = 4;
    record.samples.emplace_back().kernel_ns = 4000;
    ResultFile result;
    result.cases = {record};
    EXPECT_EQ(session_of(result, "a.json").cases.at(0).times_ns, std::vector{1000.0});
}

TEST(sessions, efficiencies_are_compared_where_both_sides_have_one) {
    const auto ratio = [](std::optional<double> base, std::optional<double> now) {
        SessionCase b = session_case("a", 1e6), n = session_case("a", 1e6);
        b.efficiency = base;
        n.efficiency = now;
        return only(compare_sessions({session({b})}, {session({n})}, rules())).efficiency_ratio;
    };
    EXPECT_DOUBLE_EQ(ratio(20, 30).value(), 1.5);
    EXPECT_FALSE(ratio({}, 30));
    EXPECT_FALSE(ratio(20, {}));
}

TEST(sessions, one_a_side_is_advisory_unless_asked) {
    const std::vector base{session({session_case("a", 1e6)})}, now{session({session_case("a", 1.2e6)})};
    const Row row = only(compare_sessions(base, now, rules()));
    EXPECT_EQ(row.finding.state, State::regressed);
    EXPECT_EQ(row.advisory, "single-session");
    EXPECT_NEAR(row.finding.evidence.ratio(), 1.2, 1e-3);
    EXPECT_EQ(row.finding.n, 10);
    CompareRules gating = rules();
    gating.gate_single_session = true;
    EXPECT_EQ(only(compare_sessions(base, now, gating)).advisory, "");
}

TEST(sessions, eight_a_side_gate_by_their_medians) {
    const Row row = only(compare_sessions(sessions(8, 1e6), sessions(8, 1.1e6), rules()));
    EXPECT_EQ(row.finding.state, State::regressed);
    EXPECT_EQ(row.advisory, "");
    EXPECT_EQ(row.finding.n, 8);
    EXPECT_NEAR(row.finding.evidence.p, 2.0 / 12870, 1e-9);
    EXPECT_EQ(only(compare_sessions(sessions(8, 1e6), sessions(8, 0.9e6), rules())).finding.state,
              State::improved);
    EXPECT_EQ(only(compare_sessions(sessions(8, 1e6), sessions(8, 1e6), rules())).finding.state, State::same);
}

TEST(sessions, fewer_than_eight_on_a_side_are_advisory) {
    const Row row = only(compare_sessions(sessions(7, 1e6), sessions(8, 1.1e6), rules()));
    EXPECT_EQ(row.advisory, "7 and 8 sessions, 8 a side gate");
}

TEST(sessions, few_samples_never_gate) {
    auto base = session({session_case("a", 1e6)}), now = session({session_case("a", 1.2e6)});
    now.cases[0].low_n = true;
    CompareRules gating = rules();
    gating.gate_single_session = true;
    EXPECT_EQ(only(compare_sessions({base}, {now}, gating)).advisory, "low_n");
}

TEST(sessions, what_lost_its_time_is_missing_and_what_is_new_is_not) {
    const std::vector base{session({session_case("a", 1e6), session_case("b", 1e6), without_time("c")})};
    const std::vector now{session({without_time("a"), session_case("c", 1e6), session_case("d", 1e6)})};
    const auto rows = compare_sessions(base, now, rules()).rows;
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0].finding.state, State::missing);
    EXPECT_EQ(rows[0].note, "crashed");
    EXPECT_EQ(rows[1].finding.state, State::missing);
    EXPECT_EQ(rows[1].note, "not in the file");
    EXPECT_EQ(rows[2].finding.state, State::unmeasured);
    EXPECT_EQ(rows[3].finding.state, State::unmeasured);
    EXPECT_EQ(rows[3].note, "the base has no time");
}

TEST(sessions, fingerprints_must_match) {
    const std::vector base{session({session_case("a", 1e6)})};
    auto now = session({session_case("a", 1.2e6)});
    now.cases[0].fingerprint[0].second = "4.0";
    const Comparison refused = compare_sessions(base, {now}, rules());
    EXPECT_TRUE(refused.rows.empty());
    EXPECT_EQ(refused.differing, std::set<std::string>{"driver: \"3.1\" and \"4.0\""});
    CompareRules cross = rules();
    cross.allow_cross = cross.gate_single_session = true;
    EXPECT_EQ(only(compare_sessions(base, {now}, cross)).advisory, "not comparable");
}

TEST(sessions, across_machines_the_only_devices_are_matched) {
    auto now = session({session_case("a", 2e6)});
    now.cases[0].device = "nvidia:0";
    const std::vector base{session({session_case("a", 1e6)})};
    EXPECT_EQ(compare_sessions(base, {now}, rules()).rows.size(), 2u);
    CompareRules cross = rules();
    cross.allow_cross = true;
    EXPECT_NEAR(only(compare_sessions(base, {now}, cross)).finding.evidence.ratio(), 2, 1e-9);
}

TEST(sessions, holm_counts_all_compared_cases) {
    const std::vector base{session({session_case("a", 1e6), session_case("b", 1e6)})};
    const std::vector now{session({session_case("a", 1.2e6), session_case("b", 1.2e6)})};
    const Evidence evidence = compare_sessions(base, now, rules()).rows.at(0).finding.evidence;
    EXPECT_DOUBLE_EQ(evidence.holm_p, 2 * evidence.p);
}

TEST(sessions, a_single_value_a_side_cannot_be_judged) {
    auto base = session({session_case("a", 1e6)}), now = session({session_case("a", 1.5e6)});
    base.cases[0].times_ns.resize(1);
    now.cases[0].times_ns.resize(1);
    const Row row = only(compare_sessions({base}, {now}, rules()));
    EXPECT_EQ(row.finding.state, State::inconclusive);
    EXPECT_TRUE(std::isnan(row.finding.smallest_effect));
    Rules strict;
    strict.require_mde = 0.08;
    EXPECT_TRUE(change_of({row}, strict).inconclusive) << "an unknown effect passed for a small one";
}

TEST(sessions, very_many_samples_are_compared_by_their_order_statistics) {
    auto base = session({session_case("a", 1e6)}), now = session({session_case("a", 1.1e6)});
    for (auto* const side : {&base, &now})
        for (int i = 0; i < 20'000; ++i)
            side->cases[0].times_ns.push_back(side->cases[0].times_ns[std::size_t(i) % 10]);
    const Row row = only(compare_sessions({base}, {now}, rules()));
    EXPECT_EQ(row.finding.state, State::regressed);
    EXPECT_NEAR(row.finding.evidence.ratio(), 1.1, 1e-3);
    EXPECT_EQ(row.finding.n, 1000);
}

TEST(history, a_session_far_off_regresses_and_one_within_does_not) {
    EXPECT_EQ(only(compare_history(sessions(10, 1e6), sessions(1, 1.1e6)[0], rules())).finding.state,
              State::regressed);
    const Row same = only(compare_history(sessions(10, 1e6), sessions(1, 1e6)[0], rules()));
    EXPECT_EQ(same.finding.state, State::same);
    EXPECT_EQ(same.advisory, "");
    EXPECT_EQ(same.finding.n, 10);
    EXPECT_EQ(only(compare_history(sessions(3, 1e6), sessions(1, 1e6)[0], rules())).advisory,
              "3 earlier sessions, 8 gate");
}

TEST(history, the_last_thirty_sessions_count) {
    std::vector<Session> all;
    for (int i = 0; i < 40; ++i) {
        const double ns = i < 10 ? 9e6 : 1e6 * (1 + 0.001 * (i % 3));
        all.insert(all.begin(), session({session_case("a", ns)}, std::to_string(1000 + i)));
    }
    const Row row = only(compare_history(all, session({session_case("a", 1e6)}), rules()));
    EXPECT_EQ(row.finding.n, 30);
    EXPECT_NEAR(row.finding.evidence.ratio(), 1, 0.01) << "the oldest ten, nine times as long, counted";
}

TEST(change, regressions_count_only_where_they_gate) {
    Row row = only(compare_sessions(sessions(8, 1e6), sessions(8, 1.1e6), rules()));
    EXPECT_TRUE(change_of({row}, {}).regressed);
    row.advisory = "single-session";
    const Change advised = change_of({row}, {});
    EXPECT_FALSE(advised.regressed);
    EXPECT_FALSE(advised.nothing_compared);
    EXPECT_FALSE(advised.inconclusive);
    EXPECT_TRUE(change_of({row}, {0, true, false}).inconclusive) << "--strict takes no advice for an answer";
}

TEST(change, missing_cases_lose_coverage_unless_allowed) {
    Row row;
    row.finding.state = State::missing;
    EXPECT_TRUE(change_of({row}, {}).coverage_lost);
    EXPECT_FALSE(change_of({row}, {0, false, true}).coverage_lost);
    EXPECT_TRUE(change_of({row}, {}).nothing_compared);
}

/// A result with one record of each case.
ResultFile result_of(const std::vector<Case>& cases) {
    ResultFile result;
    for (const Case& c : cases) {
        Record& record = result.cases.emplace_back();
        record.params = c;
        record.status = Status::ok;
        record.build.emplace();
        record.statistics.emplace();
        record.samples.assign(10, {1000, 1000, 1000, 0, 0, 0, ""});
    }
    return result;
}

TEST(sessions, a_tuned_launch_is_the_same_case_and_not_comparable_with_an_untuned_one) {
    const Case plain{"pocl:0", "pt", "thesis", {8, 8}, 1, 5, {}, 0};
    Case tuned = plain;
    tuned.lanes = 16;
    tuned.work_group = {64, 0};
    tuned.lanes_tuned = tuned.work_group_tuned = true;
    const std::vector base{session_of(result_of({plain}), "a")}, now{session_of(result_of({tuned}), "b")};
    EXPECT_EQ(compare_sessions(base, now, rules()).differing,
              std::set<std::string>{"tuned: \"no\" and \"lanes 16, work-group 64\""});
    EXPECT_TRUE(compare_sessions(now, now, rules()).differing.empty());
    const std::vector both{session_of(result_of({tuned, plain}), "c")};
    EXPECT_TRUE(compare_sessions(both, both, rules()).differing.empty());
    EXPECT_EQ(compare_sessions(both, both, rules()).rows.size(), 2u);
}

}  // namespace
}  // namespace ptb
