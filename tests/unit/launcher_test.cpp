#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <unistd.h>

#include "bench/worker/coordinator.h"
#include "tests/support/variable.h"

namespace ptb {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Launchers of one worker each, and one that starts two, as scripts of bash; "$@" is the worker's command.
constexpr auto plain = R"("$@")";
constexpr auto late = R"(sleep 0.8; "$@")";
constexpr auto never_starts = R"(echo 'job 12 queued' >&2; sleep 1000)";
constexpr auto keeps_stdin_open = R"("$@" < <(cat; sleep 1000))";
constexpr auto in_a_group_of_its_own = R"(setsid --wait "$@")";
constexpr auto both = R"("$@" < <(cat; sleep 1000) | setsid --wait cat)";
constexpr auto takes_no_sigterm = R"(trap '' TERM; "$@")";
constexpr auto two = R"({ tee >("$@" >&3) | "$@"; } 3>&1)";
constexpr auto a_second_one_late = R"({ tee >(sleep 0.4; "$@" >&3) | "$@"; } 3>&1)";

bool mentions(const std::filesystem::path& file, const std::string& text) {
    std::ifstream in(file, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}}.find(text) != std::string::npos;
}

/// Runs a plan behind a launcher, and looks for processes that it left: all have a variable of its own.
class Launcher : public testing::Test {
  protected:
    void TearDown() override {
        // what was killed is gone once a busy system has got around to it
        for (int i = 0; i < 100 && !left().empty(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        EXPECT_EQ(left(), std::vector<std::string>());
    }

    std::vector<std::string> left() const {
        std::vector<std::string> processes;
        for (const auto& entry : std::filesystem::directory_iterator("/proc"))
            if (mentions(entry.path() / "environ", mark_)) processes.push_back(entry.path());
        return processes;
    }

    Coordinator behind(
        const std::string& script, const std::vector<std::string>& scenes,
        const Stopped& stopped = [] { return false; }) {
        RunPlan plan;
        DeviceInfo device;
        device.key = "fake:0";
        plan.devices = {device};
        for (const std::string& scene : scenes) {
            Case c;
            c.device = device.key;
            c.kernel = "pt";
            c.scene = scene;
            c.size = {8, 8};
            plan.cases.push_back(c);
        }
        const WorkerLaunch launch{PTB_FAKE_WORKER,
                                  {"bash", "-c", script, "launcher"},
                                  start_timeout_,
                                  [this](const std::string& words) { heard_.push_back(words); }};
        return {plan, process_channels(launch, milliseconds(400), stopped), stopped};
    }

    static std::vector<Status> statuses(Coordinator& coordinator) {
        std::vector<Status> all;
        for (const Record& record : coordinator.run(Forecast(MeasureOptions()), {}))
            all.push_back(record.status);
        return all;
    }

    std::vector<Status> statuses(const std::string& script, const std::vector<std::string>& scenes) {
        Coordinator coordinator = behind(script, scenes);
        return statuses(coordinator);
    }

    milliseconds start_timeout_{20'000};
    std::vector<std::string> heard_;

  private:
    std::string mark_ = "PTB_TEST_MARK=" + drawn_nonce();
    Variable variable_{"PTB_TEST_MARK", mark_.substr(mark_.find('=') + 1)};
};

TEST_F(Launcher, nothing_is_left_after_a_run) {
    for (const auto* script : {plain, keeps_stdin_open, in_a_group_of_its_own, both})
        EXPECT_THAT(statuses(script, {"good", "other"}), ElementsAre(Status::ok, Status::ok)) << script;
}

TEST_F(Launcher, nothing_is_left_of_a_worker_that_hangs) {
    for (const auto* script : {plain, keeps_stdin_open, in_a_group_of_its_own, both})
        EXPECT_THAT(statuses(script, {"hang", "good"}), ElementsAre(Status::timeout, Status::ok)) << script;
}

TEST_F(Launcher, nothing_is_left_after_an_interruption) {
    for (const auto* script : {plain, keeps_stdin_open, in_a_group_of_its_own}) {
        int asked = 0;
        Coordinator coordinator = behind(script, {"good", "slow"}, [&] { return ++asked > 8; });
        EXPECT_EQ(statuses(coordinator).back(), Status::skipped) << script;
    }
}

TEST_F(Launcher, no_case_is_timed_beside_a_worker_that_may_live) {
    Coordinator coordinator = behind(takes_no_sigterm, {"hang", "good"});
    EXPECT_THAT(statuses(coordinator), ElementsAre(Status::timeout, Status::skipped));
    EXPECT_TRUE(coordinator.has_given_up());
    EXPECT_THAT(coordinator.remarks(),
                ElementsAre("an earlier worker of fake:0 may still run and would disturb"));
}

TEST_F(Launcher, two_workers_end_the_run_without_a_time) {
    for (const auto* script : {two, a_second_one_late}) {
        Coordinator coordinator = behind(script, {"slow", "good"});
        try {
            coordinator.run(Forecast(MeasureOptions()), {});
            FAIL() << script;
        } catch (const TwoWorkers& error) {
            EXPECT_THAT(error.what(), AllOf(HasSubstr("--launcher: found two workers, process "),
                                            HasSubstr("allowed: one")));
        }
    }
}

TEST_F(Launcher, one_that_takes_its_time_is_no_broken_driver) {
    EXPECT_THAT(statuses(late, {"good"}), ElementsAre(Status::ok));
}

TEST_F(Launcher, what_it_says_is_told_while_it_is_waited_for) {
    EXPECT_THAT(statuses(R"(echo 'job 12 queued' >&2; sleep 2.5; "$@")", {"good"}), ElementsAre(Status::ok));
    EXPECT_THAT(heard_, ElementsAre("job 12 queued"));
}

TEST_F(Launcher, one_that_never_starts_a_worker_is_tried_once) {
    start_timeout_ = milliseconds(1500);
    Coordinator coordinator = behind(never_starts, {"good", "other"});
    EXPECT_THAT(statuses(coordinator), ElementsAre(Status::skipped, Status::skipped));
    EXPECT_THAT(coordinator.remarks(),
                ElementsAre("the worker of fake:0 fails to start: --launcher: no worker within 1.5 s "
                            "(--start-timeout): job 12 queued"));
}

DeviceList probed(const std::string& script, milliseconds start_timeout) {
    return probe({any_icd}, {PTB_FAKE_WORKER, {"bash", "-c", script, "launcher"}, start_timeout, {}},
                 milliseconds(500));
}

TEST_F(Launcher, a_probe_waits_for_it_and_finds_devices) {
    EXPECT_EQ(probed(late, start_timeout_).devices.size(), 1U);
}

TEST_F(Launcher, a_probe_without_a_worker_says_why) {
    EXPECT_THROW(probed(never_starts, milliseconds(300)), NoWorker);
    try {
        probed("echo 'Invalid node name' >&2; exit 1", start_timeout_);
        FAIL();
    } catch (const NoWorker& error) {
        EXPECT_STREQ(error.what(), "--launcher: no worker: exited with code 1: Invalid node name");
    }
}

TEST_F(Launcher, a_probe_by_two_workers_is_refused) {
    const Variable so_that_both_are_there("FAKE_PROBE", "hang");
    EXPECT_THROW(probed(two, start_timeout_), TwoWorkers);
}

}  // namespace
}  // namespace ptb
