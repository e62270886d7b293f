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
    now.cases[0].fingerprint[0].value = "4.0";
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
    now.cases[0].device_name = "H100";
    const std::vector base{session({session_case("a", 1e6)})};
    EXPECT_EQ(compare_sessions(base, {now}, rules()).rows.size(), 2u);
    CompareRules cross = rules();
    cross.allow_cross = true;
    EXPECT_NEAR(only(compare_sessions(base, {now}, cross)).finding.evidence.ratio(), 2, 1e-9);
}

/// A case of a scene whose text has this hash, on a device.
SessionCase scene_case(const std::string& scene, const std::string& hash, double ns = 1e6) {
    SessionCase c = session_case("", ns);
    c.params = Case{"pocl:0", "pt", scene, {8, 8}, 1, 5, {}, 0};
    c.name = case_text(*c.params);
    c.scene_hash = hash;
    return c;
}

Comparison compare(std::vector<SessionCase> base, std::vector<SessionCase> now) {
    return compare_sessions({session(std::move(base))}, {session(std::move(now))}, rules());
}

std::vector<std::string> states(const Comparison& comparison) {
    std::vector<std::string> states;
    for (const Row& row : comparison.rows) states.push_back(to_string(row.finding.state));
    return states;
}

using Texts = std::vector<std::string>;

TEST(sessions, an_edited_scene_is_another_under_the_same_name) {
    const Comparison edited = compare({scene_case("s.json", "f4")}, {scene_case("s.json", "c4")});
    EXPECT_EQ(edited.differing, std::set<std::string>{"scene: \"s.json f4\" and \"s.json c4\""});
    EXPECT_TRUE(edited.rows.empty());
    EXPECT_TRUE(compare({scene_case("s.json", "f4")}, {scene_case("s.json", "f4")}).differing.empty());
    EXPECT_EQ(states(compare({scene_case("s.json", "f4")}, {scene_case("s.json", "")})), Texts{"same"})
        << "what an older file does not say is no difference";
}

TEST(sessions, a_scene_is_its_text_wherever_its_file_lies) {
    const Comparison moved = compare({scene_case("a/s.json", "f4")}, {scene_case("b.json", "f4", 1.2e6)});
    EXPECT_EQ(states(moved), Texts{"regressed"});
    EXPECT_EQ(moved.rows.at(0).name, "pt a/s.json 8x8 spp 1 length 5");
    const Comparison swapped = compare({scene_case("x", "f4"), scene_case("y", "c4", 2e6)},
                                       {scene_case("x", "c4", 2e6), scene_case("y", "f4")});
    EXPECT_EQ(states(swapped), (Texts{"same", "same"}));
}

TEST(sessions, a_scene_that_took_a_name_over_from_one_that_moved_is_new) {
    const Comparison both = compare({scene_case("x", "f4")}, {scene_case("x", "c4"), scene_case("y", "f4")});
    EXPECT_TRUE(both.differing.empty());
    EXPECT_EQ(states(both), (Texts{"same", "unmeasured"}));
}

TEST(sessions, one_text_under_two_names_stays_two_cases) {
    const std::vector twice{scene_case("x", "f4"), scene_case("y", "f4")};
    EXPECT_EQ(states(compare(twice, twice)), (Texts{"same", "same"}));
}

SessionCase device_case(const std::string& key, const std::string& name, const std::string& uuid,
                        double ns = 1e6) {
    SessionCase c = session_case("a", ns);
    c.device = key;
    c.device_name = name;
    c.device_uuid = uuid;
    c.fingerprint = {{"device", name}};
    return c;
}

TEST(sessions, the_same_card_under_another_number_is_matched_by_its_uuid) {
    const Comparison swapped =
        compare({device_case("nvidia:0", "H100", "aa"), device_case("nvidia:1", "H100", "bb", 2e6)},
                {device_case("nvidia:0", "H100", "bb", 2e6), device_case("nvidia:1", "H100", "aa")});
    EXPECT_EQ(states(swapped), (Texts{"same", "same"}));
    EXPECT_EQ(swapped.rows.at(0).note, "new: device nvidia:1");
}

TEST(sessions, a_card_is_matched_by_its_name_where_that_is_the_only_one) {
    EXPECT_EQ(states(compare({device_case("nvidia:0", "H100", "")}, {device_case("nvidia:4", "H100", "")})),
              Texts{"same"});
    const Comparison doubtful =
        compare({device_case("nvidia:0", "H100", ""), device_case("nvidia:1", "H100", "")},
                {device_case("nvidia:4", "H100", "")});
    EXPECT_EQ(states(doubtful), (Texts{"missing", "missing", "unmeasured"}));
}

TEST(sessions, equal_cards_of_two_machines_are_matched_by_number) {
    const Comparison same =
        compare({device_case("nvidia:0", "H100", "aa"), device_case("nvidia:1", "H100", "bb")},
                {device_case("nvidia:1", "H100", "cc"), device_case("nvidia:0", "H100", "dd")});
    EXPECT_EQ(states(same), (Texts{"same", "same"}));
    EXPECT_EQ(same.rows.at(0).note, "");
}

TEST(sessions, another_card_in_the_same_place_differs) {
    EXPECT_EQ(
        compare({device_case("nvidia:0", "H100", "aa")}, {device_case("nvidia:0", "H200", "bb")}).differing,
        std::set<std::string>{"device: \"H100\" and \"H200\""});
}

TEST(sessions, of_long_values_the_parts_that_differ_are_shown) {
    SessionCase base = session_case("a", 1e6), now = session_case("a", 1e6);
    const std::string options = "-cl-std=CL1.2 -cl-mad-enable -cl-no-signed-zeros -DSPHERES=9 -DPATHS=128 ";
    base.fingerprint = {{"build options", options + "-DLANES=16 -DLAST"}};
    now.fingerprint = {{"build options", options + "-DLANES=8 -DLAST"}};
    EXPECT_EQ(compare({base}, {now}).differing,
              std::set<std::string>{"build options: \"... -DLANES=16 -DLAST\" and \"... -DLANES=8 -DLAST\""});
}

TEST(sessions, what_may_differ_is_noted) {
    SessionCase base = session_case("a", 1e6), now = session_case("a", 1e6);
    base.fingerprint = {{"host", "9f86d081884c", true}};
    now.fingerprint = {{"host", "7d865e959b24", true}};
    const Comparison noted = compare({base}, {now});
    EXPECT_EQ(states(noted), Texts{"same"});
    EXPECT_TRUE(noted.differing.empty());
    EXPECT_EQ(noted.notes, std::set<std::string>{"host: \"9f86d081884c\" and \"7d865e959b24\""});
}

TEST(sessions, compute_units_and_the_cpus_that_a_run_might_use_must_match) {
    Record record;
    record.params.device = "pocl:0";
    record.status = Status::ok;
    record.statistics.emplace();
    record.samples.assign(10, {1000, 1000, 1000, 0, 0, 0, ""});
    ResultFile base;
    base.cases = {record};
    base.devices.emplace_back().key = "pocl:0";
    base.devices[0].compute_units = base.host.cpus_allowed = 4;
    ResultFile now = base;
    now.devices[0].compute_units = now.host.cpus_allowed = 2;
    now.host.cpu_quota = 1.5;
    EXPECT_EQ(compare_sessions({session_of(base, "a")}, {session_of(now, "b")}, rules()).differing,
              (std::set<std::string>{"compute units: \"4\" and \"2\"", "CPUs allowed: \"4\" and \"2\"",
                                     "CPU quota: \"none\" and \"1.5\""}));
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
