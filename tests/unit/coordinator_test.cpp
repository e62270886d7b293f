#include "bench/worker/coordinator.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include <gmock/gmock.h>
#include <unistd.h>

#include "tests/support/variable.h"

namespace ptb {
namespace {

using std::chrono::milliseconds;

Stopped never() {
    return [] { return false; };
}

DeviceInfo device(const std::string& key = "fake:0") {
    DeviceInfo info;
    info.key = key;
    info.icd = "fake.icd";
    return info;
}

/// The scene says how the fake worker behaves.
Case make_case(const std::string& scene, int spp = 1, const std::string& key = "fake:0") {
    Case c;
    c.device = key;
    c.kernel = "pt";
    c.scene = scene;
    c.size = {100, 100};
    c.spp = spp;
    return c;
}

RunPlan plan_of(std::vector<Case> cases, std::vector<DeviceInfo> devices = {device()}) {
    RunPlan plan;
    plan.cases = std::move(cases);
    plan.devices = std::move(devices);
    return plan;
}

OpenChannel fake_channels(milliseconds silence = milliseconds(500), const Stopped& stopped = never()) {
    return process_channels({PTB_FAKE_WORKER, {}}, silence, stopped);
}

std::vector<Record> run(const RunPlan& plan, const OpenChannel& open, const Stopped& stopped = never()) {
    Coordinator coordinator(plan, open, stopped);
    return coordinator.run(Forecast(plan.measure), {});
}

std::vector<Status> statuses(const std::vector<Record>& records) {
    std::vector<Status> all;
    for (const Record& record : records) all.push_back(record.status);
    return all;
}

std::string reason_of(const std::string& scene) {
    const auto records = run(plan_of({make_case(scene)}), fake_channels());
    return records.at(0).reason;
}

std::vector<DevicePeaks> fake_peaks(const std::string& how) {
    const Variable variable("FAKE_PEAKS", how);
    return Coordinator(plan_of({}), fake_channels(), never()).peaks();
}

TEST(coordinator, peaks_come_from_each_device_or_have_a_reason) {
    const Peak fma{"fma", "GFLOP/s", 100, 99, 101, 10, "event", ""};
    EXPECT_EQ(fake_peaks(""), (std::vector<DevicePeaks>{{"fake:0", "", {fma}}}));
    const auto dead = fake_peaks("abort").at(0);
    EXPECT_NE(dead.reason.find("SIGABRT"), std::string::npos) << dead.reason;
    EXPECT_TRUE(dead.peaks.empty());
    const Variable refused("FAKE_OPEN", "refuse");
    EXPECT_EQ(fake_peaks("").at(0).reason, "fake:0 cannot be opened: no such device");
}

TEST(coordinator, a_worker_that_dies_costs_one_record) {
    const auto records =
        run(plan_of({make_case("good", 1), make_case("sigkill"), make_case("good", 2), make_case("hang"),
                     make_case("garbage"), make_case("orphan"), make_case("exit"), make_case("good", 3)}),
            fake_channels());
    EXPECT_EQ(statuses(records), (std::vector{Status::ok, Status::crash, Status::ok, Status::timeout,
                                              Status::crash, Status::crash, Status::crash, Status::ok}));
}

TEST(coordinator, a_crash_names_the_signal_and_the_last_words) {
    EXPECT_EQ(reason_of("sigkill"), "killed by SIGKILL (9)");
    EXPECT_EQ(reason_of("abort"), "killed by SIGABRT (6): assertion failed: !device->lost");
    EXPECT_EQ(reason_of("exit"), "exited with code 3");
    EXPECT_EQ(reason_of("hang"), "no sign of life for 0.5 s (--timeout)");
    EXPECT_EQ(reason_of("garbage"), "the worker answered nonsense: \"Segmentation fault (core dumped)\"");
}

TEST(coordinator, what_a_worker_said_in_an_earlier_case_is_not_why_it_died) {
    const auto records =
        run(plan_of({make_case("mutter", 1), make_case("mutter", 2), make_case("sigkill")}), fake_channels());
    EXPECT_EQ(statuses(records), (std::vector{Status::ok, Status::ok, Status::crash}));
    EXPECT_EQ(records[2].reason, "killed by SIGKILL (9)");
}

TEST(coordinator, what_a_driver_printed_is_beside_the_log_of_that_record_alone) {
    for (const Record& record :
         run(plan_of({make_case("mutter", 1), make_case("mutter", 2)}), fake_channels()))
        EXPECT_EQ(record.build->log, "printed by the driver:\nwarning: this driver is old");
}

TEST(coordinator, records_come_in_plan_order_with_the_planned_parameters) {
    const RunPlan plan = plan_of({make_case("good", 3), make_case("sigkill"), make_case("good", 1)});
    const auto records = run(plan, fake_channels());
    for (std::size_t i = 0; i < records.size(); ++i) EXPECT_EQ(records[i].params, plan.cases[i]);
}

TEST(coordinator, a_worker_is_kept_until_it_dies) {
    const auto records =
        run(plan_of({make_case("good", 1), make_case("good", 2), make_case("sigkill"), make_case("good", 3)}),
            fake_channels());
    const auto pid = [&](std::size_t i) { return records[i].statistics->n; };
    EXPECT_EQ(pid(0), pid(1));
    EXPECT_NE(pid(1), pid(3));
}

TEST(coordinator, slow_but_alive_is_not_a_timeout) {
    EXPECT_EQ(statuses(run(plan_of({make_case("slow")}), fake_channels())), std::vector{Status::ok});
}

TEST(coordinator, a_device_that_refuses_skips_its_cases) {
    const Variable open("FAKE_OPEN", "refuse");
    const auto records = run(plan_of({make_case("good", 1), make_case("good", 2)}), fake_channels());
    EXPECT_EQ(statuses(records), (std::vector{Status::skipped, Status::skipped}));
    EXPECT_EQ(records[1].reason, "fake:0 cannot be opened: no such device");
}

TEST(coordinator, a_device_whose_worker_crashes_at_open_twice_is_given_up) {
    const Variable open("FAKE_OPEN", "abort");
    int opened = 0;
    const OpenChannel real = fake_channels();
    const OpenChannel counting = [&](const DeviceInfo& info) {
        ++opened;
        return real(info);
    };
    const auto records = run(plan_of({make_case("good", 1), make_case("good", 2)}), counting);
    EXPECT_EQ(statuses(records), (std::vector{Status::skipped, Status::skipped}));
    EXPECT_EQ(records[0].reason,
              "the worker of fake:0 fails to start: killed by SIGABRT (6): assertion failed: !device->lost");
    EXPECT_EQ(opened, 2);
}

TEST(coordinator, a_launcher_that_is_missing_skips_with_its_name) {
    const auto records =
        run(plan_of({make_case("good")}),
            process_channels({PTB_FAKE_WORKER, {"no-such-launcher"}}, milliseconds(500), never()));
    EXPECT_EQ(statuses(records), std::vector{Status::skipped});
    EXPECT_NE(records[0].reason.find("no-such-launcher"), std::string::npos) << records[0].reason;
}

TEST(coordinator, one_device_that_cannot_open_leaves_the_others_alone) {
    const OpenChannel real = fake_channels();
    const OpenChannel one_broken = [&](const DeviceInfo& info) {
        if (info.key == "broken:0") throw std::runtime_error("no driver");
        return real(info);
    };
    const RunPlan plan = plan_of({make_case("good", 1, "broken:0"), make_case("good", 1, "fake:0")},
                                 {device("broken:0"), device("fake:0")});
    EXPECT_EQ(statuses(run(plan, one_broken)), (std::vector{Status::skipped, Status::ok}));
}

TEST(coordinator, a_worker_of_another_protocol_ends_the_run) {
    const Variable open("FAKE_OPEN", "other-protocol");
    EXPECT_THROW(run(plan_of({make_case("good")}), fake_channels()), VersionMismatch);
}

TEST(coordinator, an_interruption_kills_the_worker_and_skips_the_rest) {
    int asked = 0;
    const Stopped soon = [&] { return ++asked > 5; };
    const RunPlan plan = plan_of({make_case("good"), make_case("hang"), make_case("good", 2)});
    const auto records = run(plan, fake_channels(milliseconds(60000), soon), soon);
    EXPECT_EQ(statuses(records).back(), Status::skipped);
    EXPECT_EQ(records.back().reason, "interrupted");
    EXPECT_EQ(records.size(), plan.cases.size());
}

TEST(coordinator, estimates_are_asked_once_for_equal_costs) {
    const Variable ns("FAKE_NS", "500");
    Coordinator coordinator(plan_of({make_case("good", 1), make_case("good", 2), make_case("other", 1)}),
                            fake_channels(), never());
    const Forecast forecast = coordinator.estimate();
    EXPECT_DOUBLE_EQ(forecast.sample_s(make_case("good", 1000)).value(), 500e-9 * 100 * 100 * 1000);
    EXPECT_TRUE(forecast.knows(make_case("other")));
    EXPECT_FALSE(forecast.knows(make_case("third")));
}

TEST(coordinator, a_failed_estimate_does_not_spoil_the_run) {
    Coordinator coordinator(plan_of({make_case("bad-estimate"), make_case("good")}), fake_channels(),
                            never());
    const Forecast forecast = coordinator.estimate();
    EXPECT_FALSE(forecast.knows(make_case("bad-estimate")));
    EXPECT_TRUE(forecast.knows(make_case("good")));
    EXPECT_EQ(statuses(coordinator.run(forecast, {})), (std::vector{Status::ok, Status::ok}));
}

TEST(coordinator, a_case_that_does_not_fit_into_the_budget_is_skipped_with_its_prediction) {
    RunPlan plan = plan_of({make_case("good", 1000), make_case("good", 1), make_case("good", 2)});
    plan.max_total_time_s = 10;
    Forecast forecast(plan.measure);
    forecast.learn(make_case("good"), 10000);  // 0.1 s a sample per pixel
    Coordinator coordinator(plan, fake_channels(), never(), [] { return 0.0; });
    const auto records = coordinator.run(forecast, {});
    EXPECT_EQ(statuses(records), (std::vector{Status::skipped, Status::ok, Status::ok}));
    EXPECT_EQ(records[0].reason,
              "predicted 1 min 40 s a sample, 10 s are left of the budget of 10 s (--max-total-time)");
    EXPECT_NEAR(records[1].statistics->max_ns, 10 - 0.2, 1e-9)
        << "the worker was not told what is left for it: a sample of the last case must still fit";
}

TEST(coordinator, estimates_take_a_quarter_of_the_budget_at_most) {
    RunPlan plan = plan_of({make_case("good", 1), make_case("mutter", 1), make_case("slow", 1)});
    plan.max_total_time_s = 40;
    double now_s = -6;
    Coordinator coordinator(plan, fake_channels(), never(), [&] { return now_s += 6; });
    const Forecast forecast = coordinator.estimate_within_budget();
    EXPECT_TRUE(forecast.knows(make_case("good")));
    EXPECT_FALSE(forecast.knows(make_case("mutter"))) << "12 of 40 s are gone";
    EXPECT_FALSE(forecast.knows(make_case("slow")));
}

TEST(coordinator, what_is_not_forecast_is_asked_before_it_is_begun) {
    RunPlan plan = plan_of({make_case("good", 1'000'000'000)});
    plan.max_total_time_s = 10;
    Coordinator coordinator(plan, fake_channels(), never(), [] { return 0.0; });
    const auto records = coordinator.run(Forecast(plan.measure), {});
    EXPECT_EQ(statuses(records), std::vector{Status::skipped});
    EXPECT_THAT(records[0].reason, testing::StartsWith("predicted "));
}

TEST(coordinator, what_is_measured_makes_forecasts_better) {
    RunPlan plan = plan_of({make_case("good", 1), make_case("good", 1000)});
    plan.max_total_time_s = 10;
    Forecast forecast(plan.measure);
    forecast.learn(make_case("good"), 10000);  // 0.1 s a sample per pixel; it takes 0.1 ms
    Coordinator coordinator(plan, fake_channels(), never(), [] { return 0.0; });
    EXPECT_EQ(statuses(coordinator.run(forecast, {})), (std::vector{Status::ok, Status::ok}));
}

TEST(coordinator, devices_have_equal_shares_of_the_budget_and_of_what_others_leave) {
    RunPlan plan = plan_of({make_case("good", 1000), make_case("good", 1), make_case("good", 1000, "fake:1"),
                            make_case("good", 1, "fake:1")},
                           {device(), device("fake:1")});
    plan.max_total_time_s = 120;
    Forecast forecast(plan.measure);
    forecast.learn(make_case("good"), 10000);  // 100 s for 1000 SPP
    forecast.learn(make_case("good", 1, "fake:1"), 10000);
    Coordinator coordinator(plan, fake_channels(), never(), [] { return 0.0; });
    const auto records = coordinator.run(forecast, {});
    EXPECT_EQ(statuses(records), (std::vector{Status::skipped, Status::ok, Status::ok, Status::ok}));
    EXPECT_EQ(
        records[0].reason,
        "predicted 1 min 40 s a sample, 1 min 0 s are left of fake:0's share of the budget of 2 min 0 s "
        "(--max-total-time)");
    EXPECT_EQ(records[1].statistics->max_ns, 60);
}

TEST(coordinator, a_used_up_budget_skips_what_has_no_forecast_too) {
    RunPlan plan = plan_of({make_case("good")});
    plan.max_total_time_s = 10;
    double now_s = 0;
    Coordinator coordinator(plan, fake_channels(), never(), [&] { return now_s; });
    now_s = 11;
    const auto records = coordinator.run(Forecast(plan.measure), {});
    EXPECT_EQ(statuses(records), std::vector{Status::skipped});
    EXPECT_EQ(records[0].reason, "the budget of 10 s is used up (--max-total-time)");
}

/// A plan whose cases may write a picture, and what becomes of it.
struct Pictured {
    std::string file = testing::TempDir() + "ptb-picture-" + std::to_string(::getpid()) + ".pfm";
    std::vector<Record> records;
    std::vector<std::string> remarks;

    ~Pictured() { std::filesystem::remove(file); }
    /// `ranked`: numbers of the cases that may write it, the best last.
    void run(std::vector<Case> cases, const std::vector<std::size_t>& ranked) {
        RunPlan plan = plan_of(std::move(cases));
        for (std::size_t rank = 0; rank < ranked.size(); ++rank)
            plan.image_files[plan.cases[ranked[rank]]] = {file, rank};
        Coordinator coordinator(plan, fake_channels(), never());
        records = coordinator.run(Forecast(plan.measure), {});
        remarks = coordinator.remarks();
    }
    /// Samples per pixel of the case that wrote it: the fake worker's last float.
    float spp_seen() const {
        std::ifstream in(file, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(in), {}};
        if (bytes.size() < 3U * 100 * 100 * sizeof(float)) return 0;
        float last = 0;
        std::memcpy(&last, bytes.data() + bytes.size() - sizeof last, sizeof last);
        return last;
    }
};

TEST(coordinator, the_planned_case_leaves_its_picture_and_no_other) {
    Pictured pictured;
    pictured.run({make_case("good", 1), make_case("good", 2), make_case("good", 3)}, {1});
    EXPECT_EQ(statuses(pictured.records), std::vector(3, Status::ok));
    EXPECT_TRUE(pictured.remarks.empty());
    EXPECT_EQ(pictured.spp_seen(), 2);
}

TEST(coordinator, a_better_picture_stays) {
    Pictured pictured;
    pictured.run({make_case("good", 1), make_case("good", 3), make_case("good", 2)}, {0, 2, 1});
    EXPECT_EQ(pictured.spp_seen(), 3);
    pictured.run({make_case("good", 1), make_case("sigkill", 3), make_case("good", 2)}, {0, 2, 1});
    EXPECT_EQ(pictured.spp_seen(), 2) << "the best is not there";
}

TEST(coordinator, a_picture_that_cannot_be_written_costs_no_time) {
    Pictured pictured;
    pictured.file = "/proc/no/such/folder.pfm";
    pictured.run({make_case("good")}, {0});
    EXPECT_EQ(statuses(pictured.records), std::vector{Status::ok});
    EXPECT_TRUE(pictured.records[0].statistics);
    ASSERT_EQ(pictured.remarks.size(), 1U);
    EXPECT_THAT(pictured.remarks[0], testing::HasSubstr("no picture of fake:0: "));
    EXPECT_THAT(pictured.remarks[0], testing::HasSubstr("/proc/no/such/folder.pfm"));
}

TEST(coordinator, a_picture_that_does_not_arrive_costs_no_time) {
    Pictured pictured;
    pictured.run({make_case("torn-picture")}, {0});
    EXPECT_EQ(statuses(pictured.records), std::vector{Status::ok});
    EXPECT_EQ(pictured.remarks, std::vector<std::string>{"no picture of fake:0: it did not arrive whole"});
    EXPECT_FALSE(std::filesystem::exists(pictured.file));
}

TEST(coordinator, an_answer_to_something_else_is_no_time) {
    EXPECT_EQ(reason_of("stale"), "the worker answered request 1 instead of 2");
    EXPECT_EQ(reason_of("other-case"), "the worker answered for another case");
    const auto records =
        run(plan_of({make_case("stale"), make_case("other-case"), make_case("good")}), fake_channels());
    EXPECT_EQ(statuses(records), (std::vector{Status::crash, Status::crash, Status::ok}));
}

std::string mismatch(const std::string& how) {
    const Variable open("FAKE_OPEN", how);
    try {
        run(plan_of({make_case("good")}), fake_channels());
    } catch (const VersionMismatch& error) {
        return error.what();
    }
    return "none";
}

TEST(coordinator, a_worker_of_another_build_ends_the_run) {
    EXPECT_THAT(mismatch("other-build"), testing::HasSubstr("ptbench (there 0.0 of long ago, here "));
    EXPECT_THAT(mismatch("other-kernel"), testing::HasSubstr("kernel pt (there 0123456789abcdef, here "));
}

TEST(coordinator, a_device_without_a_worker_is_remarked) {
    const Variable open("FAKE_OPEN", "refuse");
    Coordinator coordinator(plan_of({make_case("good")}), fake_channels(), never());
    EXPECT_FALSE(coordinator.has_given_up());
    coordinator.run(Forecast(MeasureOptions()), {});
    EXPECT_TRUE(coordinator.has_given_up());
    EXPECT_EQ(coordinator.remarks(), std::vector<std::string>{"fake:0 cannot be opened: no such device"});
}

TEST(coordinator, observers_hear_of_each_case) {
    struct Heard : RunObserver {
        std::vector<std::string> words;
        void started(std::size_t index, const Case&) override {
            words.push_back("started " + std::to_string(index));
        }
        void finished(std::size_t index, const Record&) override {
            words.push_back("finished " + std::to_string(index));
        }
    } heard;
    const RunPlan plan = plan_of({make_case("good"), make_case("sigkill")});
    Coordinator coordinator(plan, fake_channels(), never());
    coordinator.run(Forecast(plan.measure), {&heard});
    EXPECT_EQ(heard.words, (std::vector<std::string>{"started 0", "finished 0", "started 1", "finished 1"}));
}

}  // namespace
}  // namespace ptb
