#include <cmath>
#include <filesystem>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/fleet/claim.h"
#include "bench/fleet/judged.h"
#include "bench/fleet/lease.h"
#include "bench/fleet/merge.h"
#include "bench/fleet/nodes.h"
#include "bench/fleet/rejoin.h"
#include "bench/plan/config.h"
#include "bench/record/journal.h"
#include "bench/record/json.h"
#include "core/file/replace_file.h"
#include "tests/support/variable.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Nodes, lists_are_read_as_slurm_writes_them) {
    EXPECT_THAT(nodes_in("n1", ""), ElementsAre("n1"));
    EXPECT_THAT(nodes_in("n1,n[3-5,07],login", ""), ElementsAre("n1", "n3", "n4", "n5", "n07", "login"));
    EXPECT_THAT(nodes_in("r[1-2]n[08-10]", ""),
                ElementsAre("r1n08", "r1n09", "r1n10", "r2n08", "r2n09", "r2n10"));
    EXPECT_THAT(nodes_in("gpu[01-02]-ib", ""), ElementsAre("gpu01-ib", "gpu02-ib"));
}

TEST(Nodes, what_is_no_list_is_refused_with_the_flag) {
    for (const char* const list : {"", "n1,", ",n1", "n[", "n[]", "n[1", "n[2-1]", "n[a]", "n1]",
                                   "n[1-999999999]", "../n1", ".n", "n 1", "n[-1]"})
        EXPECT_THROW(
            try { nodes_in(list, "--expect"); } catch (const UsageError& error) {
                EXPECT_THAT(error.what(), HasSubstr("--expect: found \""));
                throw;
            },
            UsageError)
            << list;
}

TEST(Nodes, lists_are_written_short_and_read_back) {
    for (const char* const list : {"n1", "n[1,3-5]", "n[1-2],n[08-10]", "login,n[017,042]", "a,b,c"})
        EXPECT_EQ(node_list(nodes_in(list, "")), list);
}

TEST(Nodes, the_name_is_slurms) {
    const Variable name("SLURMD_NODENAME", "gpu-017");
    EXPECT_EQ(this_node(), "gpu-017");
    const Variable wrong("SLURMD_NODENAME", "../n1");
    EXPECT_THROW(this_node(), UsageError);
}

TEST(Lease, lives_as_long_as_its_process) {
    const Lease mine = this_lease();
    EXPECT_TRUE(is_living(mine));
    Lease before_a_restart = mine, another = mine, ended = mine;
    before_a_restart.boot_id = "0";
    another.started_at_tick += 1;
    ended.pid = 0x7fffffff;
    for (const Lease& lease : {before_a_restart, another, ended}) EXPECT_FALSE(is_living(lease));
}

TEST(Lease, of_a_process_that_waits_to_be_reaped_is_none) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        char byte = 0;
        ::_exit(static_cast<int>(::read(ends[0], &byte, 1)));
    }
    const Lease lease = lease_of(child);
    EXPECT_TRUE(is_living(lease));
    ASSERT_EQ(::write(ends[1], "x", 1), 1);
    siginfo_t ended{};
    ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);
    EXPECT_FALSE(is_living(lease)) << "it is a zombie now";
    ::waitpid(child, nullptr, 0);
    for (const int end : ends) ::close(end);
}

DeviceInfo gpu(const std::string& key, const std::string& uuid) {
    DeviceInfo device;
    device.key = key;
    device.name = "Card";
    device.vendor = "Maker";
    device.type = "GPU";
    device.uuid = uuid;
    device.driver_version = "1";
    return device;
}

Record record_on(const std::string& key) {
    Record record;
    record.params = default_case();
    record.params.device = key;
    record.status = Status::ok;
    return record;
}

std::vector<std::string> devices_of(const std::vector<Record>& records) {
    std::vector<std::string> keys;
    for (const Record& record : records) keys.push_back(record.params.device);
    return keys;
}

TEST(Rejoined, a_card_that_moved_is_found_by_its_uuid) {
    ResultFile earlier;
    earlier.devices = {gpu("c:0", "aa"), gpu("c:1", "bb")};
    earlier.cases = {record_on("c:0"), record_on("c:1")};
    const std::vector<DeviceInfo> now{gpu("c:0", "bb"), gpu("c:1", "aa")};
    const Rejoined parts = rejoined(earlier, now, now);
    EXPECT_THAT(devices_of(parts.earlier.cases), ElementsAre("c:1", "c:0"));
    EXPECT_THAT(parts.gone, IsEmpty());
    EXPECT_EQ(parts.devices.size(), 2u);
}

TEST(Rejoined, a_card_that_was_exchanged_keeps_its_records_under_another_key) {
    ResultFile earlier;
    earlier.devices = {gpu("c:0", "aa"), gpu("c:1", "bb")};
    earlier.cases = {record_on("c:0"), record_on("c:1")};
    const std::vector<DeviceInfo> now{gpu("c:0", "cc"), gpu("c:1", "bb")};
    const Rejoined parts = rejoined(earlier, now, now);
    EXPECT_THAT(devices_of(parts.earlier.cases), ElementsAre("c:1"));
    ASSERT_EQ(parts.gone.size(), 1u);
    EXPECT_EQ(parts.gone.front().key, "c:0~1");
    EXPECT_THAT(parts.gone.front().excluded, HasSubstr("no longer there"));
    EXPECT_THAT(devices_of(parts.of_gone), ElementsAre("c:0~1"));
    ResultFile later = parts.earlier;
    later.devices = {gpu("c:0", "cc"), gpu("c:1", "bb"), parts.gone.front()};
    later.cases = parts.of_gone;
    const std::vector<DeviceInfo> back{gpu("c:0", "cc"), gpu("c:1", "bb"), gpu("c:2", "aa")};
    EXPECT_THAT(devices_of(rejoined(later, back, back).earlier.cases), ElementsAre("c:2")) << "it came back";
}

TEST(Rejoined, equal_devices_without_a_uuid_keep_their_places) {
    ResultFile earlier;
    earlier.devices = {gpu("c:0", ""), gpu("c:1", "")};
    earlier.cases = {record_on("c:1")};
    const std::vector<DeviceInfo> now{gpu("c:0", ""), gpu("c:1", "")};
    const Rejoined parts = rejoined(earlier, now, {now[0]});
    EXPECT_THAT(devices_of(parts.earlier.cases), ElementsAre("c:1"));
    EXPECT_EQ(parts.devices.size(), 2u)
        << "what was measured is measured to its end, also when nobody chose it now";
}

/// Cards of one class, one a node, with one work.
Fleet fleet_of(const std::vector<std::string>& hashes) {
    Fleet fleet;
    fleet.works = {default_case()};
    for (std::size_t i = 0; i < hashes.size(); ++i) {
        Card card{"n" + std::to_string(i), gpu("c:0", std::to_string(i)), {}, 1, {}};
        card.cases.push_back({0, Status::ok, std::log(1e6), hashes[i]});
        fleet.cards.push_back(card);
        fleet.nodes.push_back({card.node, {}, 1, 1, true, {}, {}, true});
    }
    return fleet;
}

TEST(WrongBits, the_minority_is_wrong) {
    const Fleet fleet = fleet_of({"a", "a", "b", "a"});
    const auto wrong = wrong_bits(fleet, classes_of(fleet).front());
    ASSERT_EQ(wrong.size(), 1u);
    EXPECT_EQ(wrong.front().card, 2u);
    EXPECT_FALSE(wrong.front().in_doubt);
}

TEST(WrongBits, without_a_majority_all_are_in_doubt) {
    for (const auto& hashes : {std::vector<std::string>{"a", "b"}, {"a", "a", "b", "b"}, {"a", "b", "c"}}) {
        const Fleet fleet = fleet_of(hashes);
        const auto wrong = wrong_bits(fleet, classes_of(fleet).front());
        ASSERT_EQ(wrong.size(), hashes.size());
        for (const WrongBits& each : wrong) EXPECT_TRUE(each.in_doubt);
    }
}

TEST(WrongBits, equal_images_and_none_at_all_are_right) {
    for (const auto& hashes : {std::vector<std::string>{"a", "a"}, {"a"}, {"", "a", ""}}) {
        const Fleet fleet = fleet_of(hashes);
        EXPECT_THAT(wrong_bits(fleet, classes_of(fleet).front()), IsEmpty());
    }
}

TEST(Classes, another_driver_is_another_class_and_other_facts_are_drift) {
    Fleet fleet = fleet_of({"a", "a", "a", "a"});
    fleet.cards[1].device.driver_version = "2";
    fleet.cards[2].device.ecc = true;
    fleet.nodes[3].host.kernel = "Linux 7";
    const auto classes = classes_of(fleet);
    ASSERT_EQ(classes.size(), 2u);
    EXPECT_THAT(classes[0].cards, ElementsAre(0, 2, 3));
    const auto drift = drift_in(fleet, classes[0]);
    ASSERT_EQ(drift.size(), 2u);
    EXPECT_EQ(drift[0].fact, "ECC");
    EXPECT_EQ(drift[0].value, "on");
    EXPECT_THAT(drift[0].cards, ElementsAre(2));
    EXPECT_EQ(drift[1].fact, "kernel");
}

const double none = std::nan("");

/// Two works; the second takes ten times as long.
LogTimes times_of(const std::vector<double>& slower_by) {
    LogTimes times;
    for (const double by : slower_by)
        times.push_back({std::log(1e6) + std::log1p(by), std::log(1e7) + std::log1p(by)});
    return times;
}

std::vector<std::string> one_a_node(std::size_t cards) {
    std::vector<std::string> nodes;
    for (std::size_t i = 0; i < cards; ++i) nodes.push_back("n" + std::to_string(i));
    return nodes;
}

TEST(Screen, what_is_over_three_percent_and_three_deviations_off_is_a_candidate) {
    EXPECT_THAT(screen(times_of({0, 0.001, 0.05, -0.001, 0, 0.02}), one_a_node(6)).candidates,
                ElementsAre(2));
    EXPECT_THAT(screen(times_of({-0.04, 0.04, 0.06, -0.06, 0.05, -0.05}), one_a_node(6)).candidates,
                IsEmpty())
        << "where all differ, 6 % is nothing";
}

TEST(Screen, a_faster_card_is_none) {
    EXPECT_THAT(screen(times_of({0, 0, 0, 0, 0, -0.3}), one_a_node(6)).candidates, IsEmpty());
}

TEST(Screen, one_case_that_failed_or_is_off_says_nothing_of_a_card) {
    LogTimes times = times_of({0, 0, 0, 0, 0});
    for (auto& card : times) card.push_back(std::log(1e5));
    times[1][0] = none;
    times[2][0] += 0.5;
    times[3] = {none, none, none};
    const Screened screened = screen(times, one_a_node(5));
    EXPECT_THAT(screened.candidates, IsEmpty());
    EXPECT_TRUE(std::isnan(screened.deviation[3]));
}

TEST(Screen, fewer_than_five_are_too_few) {
    EXPECT_TRUE(screen(times_of({0, 0, 0, 0.5}), one_a_node(4)).too_few);
    EXPECT_THAT(screen(times_of({0, 0, 0, 0.5}), one_a_node(4)).candidates, IsEmpty());
    EXPECT_FALSE(screen(times_of({0, 0, 0, 0, 0.5}), one_a_node(5)).too_few);
}

TEST(Screen, all_cards_of_a_slow_node_are_candidates) {
    // Cards vary by 10 %, nodes do not: but one is 4 % slow.
    std::vector<double> slower;
    std::vector<std::string> nodes;
    for (int node = 0; node < 9; ++node)
        for (const double by : {-0.1, 0.0, 0.1}) {
            slower.push_back(by + (node == 4 ? 0.045 : 0.0));
            nodes.push_back("n" + std::to_string(node));
        }
    const Screened screened = screen(times_of(slower), nodes);
    EXPECT_THAT(screened.slow_nodes, ElementsAre("n4"));
    EXPECT_THAT(screened.candidates, ElementsAre(12, 13, 14));
}

TEST(Confirm, controls_are_of_other_nodes_and_the_same_for_all_who_ask) {
    std::vector<double> slower(40, 0.0);
    slower[5] = 0.2;
    std::vector<std::string> nodes;
    for (std::size_t i = 0; i < slower.size(); ++i) nodes.push_back("n" + std::to_string(i / 4));
    const Screened screened = screen(times_of(slower), nodes);
    const auto controls = controls_of(screened, nodes, 7);
    EXPECT_EQ(controls.size(), most_controls);
    for (const std::size_t card : controls) EXPECT_NE(nodes[card], "n1");
    EXPECT_EQ(controls, controls_of(screened, nodes, 7));
    EXPECT_NE(controls, controls_of(screened, nodes, 8));
    const auto few = controls_of(screen(times_of({0, 0, 0, 0, 0.2}), {"a", "a", "a", "a", "a"}),
                                 {"a", "a", "a", "a", "a"}, 1);
    EXPECT_THAT(few, ElementsAre(0, 1, 2, 3)) << "on one node there are no others";
}

TEST(Confirm, deviations_are_from_the_median_of_all_controls_sessions) {
    const auto deviations = session_deviations(times_of({0.1, 0.2}), times_of({-0.5, 0, 0, 0, 0.5}));
    ASSERT_EQ(deviations.size(), 2u);
    EXPECT_NEAR(deviations[0], std::log(1.1), 1e-12);
    EXPECT_NEAR(deviations[1], std::log(1.2), 1e-12);
}

// Student's t for 95 %, one-sided, of 4 degrees is 2.1318 (any table); the standard error of these five is
// 0.0070711.
TEST(Confirm, slow_is_who_is_over_three_percent_for_sure) {
    const std::vector<double> sessions{0.08, 0.09, 0.10, 0.11, 0.12};
    const auto found = confirmed({sessions});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].speed, Speed::slow);
    EXPECT_NEAR(found[0].mean, 0.1, 1e-12);
    EXPECT_NEAR(found[0].at_least, 0.1 - 2.1318 * 0.0070711, 1e-6);
    EXPECT_EQ(confirmed({{0.02, 0.03, 0.04, 0.05, 0.06}})[0].speed, Speed::suspect);
    const auto beside_one_without_times = confirmed({{}, sessions});
    EXPECT_EQ(beside_one_without_times[0].speed, Speed::suspect);
    EXPECT_EQ(beside_one_without_times[1].speed, Speed::slow);
}

TEST(Confirm, among_many_more_is_needed) {
    const std::vector<double> barely{0.03, 0.04, 0.05, 0.06, 0.07}, nothing{-0.02, -0.01, 0, 0.01, 0.02};
    EXPECT_EQ(confirmed({barely})[0].speed, Speed::slow);
    std::vector<std::vector<double>> many(20, nothing);
    many.push_back(barely);
    EXPECT_EQ(confirmed(many).back().speed, Speed::suspect);
}

/// A fleet's folder, removed at the end.
struct FleetFiles : testing::Test {
    FleetFolder folder{fs::temp_directory_path() / ("ptbench-fleet-" + std::to_string(::getpid()))};
    FleetFiles() { fs::create_directories(folder.nodes()); }
    ~FleetFiles() override { fs::remove_all(folder.path); }

    FleetPlan plan() const {
        Config config;
        config.name = "small";
        config.series = {{"one", {parse_axis("spp=[1,2]")}, {}}};
        RunInfo run;
        run.config = config.name;
        run.settings.json = dump_config(config);
        run.expected = {"n1", "n2"};
        RunFingerprint facts = asked_of(run);
        facts["kernel pt"] = "abc";
        return {run, facts};
    }

    void begin() const {
        std::vector<std::string> differing;
        join_plan(folder, plan(), differing);
    }

    /// A journal of a node with one device: SPP 2 was measured before SPP 1.
    void add_node(const std::string& name, const std::string& finished_at) const {
        ResultFile run;
        run.host.node = name;
        run.devices = {gpu("c:0", name)};
        run.run.finished_at = finished_at;
        for (const int spp : {2, 1}) {
            run.cases.push_back(record_on("c:0"));
            run.cases.back().params.spp = spp;
        }
        Journal(folder.journal(name), run);
    }
};

TEST_F(FleetFiles, the_first_writes_the_plan_and_others_are_told_what_differs) {
    std::vector<std::string> differing;
    join_plan(folder, plan(), differing);
    EXPECT_THAT(differing, IsEmpty());
    FleetPlan other = plan();
    other.facts["kernel pt"] = "def";
    const FleetPlan there = join_plan(folder, other, differing);
    EXPECT_THAT(differing, ElementsAre(HasSubstr("kernel pt (there abc, here def)")));
    EXPECT_EQ(there.facts.at("kernel pt"), "abc");
    differing.clear();
    join_plan(folder, plan(), differing);
    EXPECT_THAT(differing, IsEmpty());
}

TEST_F(FleetFiles, of_many_who_come_at_once_one_writes_the_plan) {
    std::vector<std::thread> nodes;
    std::vector<int> wrote(8, 0);
    for (std::size_t i = 0; i < wrote.size(); ++i)
        nodes.emplace_back([&, i] { wrote[i] = make_new_file(folder.plan(), std::to_string(i)) ? 0 : 1; });
    for (auto& node : nodes) node.join();
    EXPECT_EQ(std::count(wrote.begin(), wrote.end(), 1), 1);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 2) << "plan.json and nodes";
}

TEST_F(FleetFiles, records_are_merged_in_the_order_of_nodes_devices_and_plan) {
    add_node("n2", "now");
    add_node("n1", "now");
    begin();
    const Fleet fleet = merge(folder);
    EXPECT_EQ(fleet.cards.size(), 2u);
    const ResultFile merged = read_run(folder.result());
    EXPECT_THAT(devices_of(merged.cases), ElementsAre("n1/c:0", "n1/c:0", "n2/c:0", "n2/c:0"));
    EXPECT_EQ(merged.cases[0].params.spp, 1);
    EXPECT_EQ(merged.cases[1].params.spp, 2);
    EXPECT_EQ(merged.hosts.size(), 2u);
    EXPECT_EQ(merged.devices[1].key, "n2/c:0");
    EXPECT_EQ(merged.devices[1].node, "n2");
}

TEST_F(FleetFiles, a_merge_that_fails_leaves_the_result_as_it_was) {
    add_node("n1", "now");
    begin();
    ResultFile run = read_run(folder.journal("n1"));
    run.cases.back().params.spp = 3;  // of no plan
    Journal(folder.journal("n1"), run);
    EXPECT_THROW(merge(folder), UsageError);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 2) << "plan.json and nodes";
}

TEST_F(FleetFiles, is_whole_when_all_that_are_expected_have_finished) {
    add_node("n1", "now");
    EXPECT_FALSE(is_whole(folder, plan()));
    add_node("n2", "");
    EXPECT_FALSE(is_whole(folder, plan()));
    add_node("n2", "now");
    EXPECT_TRUE(is_whole(folder, plan()));
}

TEST_F(FleetFiles, records_that_are_not_of_the_plan_are_refused) {
    add_node("n1", "now");
    ResultFile run = read_run(folder.journal("n1"));
    run.cases.back().params.spp = 3;
    Journal(folder.journal("n1"), run);
    EXPECT_THROW(read_node(folder, plan(), "n1"), UsageError);
}

TEST_F(FleetFiles, a_journal_has_one_writer) {
    const NodeClaim first(folder, "n1");
    EXPECT_THROW(NodeClaim(folder, "n1"), NodeInUse);
    EXPECT_NO_THROW(NodeClaim(folder, "n2"));
}

TEST_F(FleetFiles, a_living_lease_is_respected_where_files_know_no_locks_and_a_dead_one_is_not) {
    add_node("n1", "");
    ResultFile run = read_run(folder.journal("n1"));
    run.run.lease = this_lease();
    Journal(folder.journal("n1"), run);
    EXPECT_THROW(NodeClaim(folder, "n1"), NodeInUse);
    run.run.lease->started_at_tick += 1;
    Journal(folder.journal("n1"), run);
    EXPECT_NO_THROW(NodeClaim(folder, "n1"));
}

}  // namespace
}  // namespace ptb
