#include "bench/record/fingerprint.h"

#include <gmock/gmock.h>

namespace ptb {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

ResultFile run() {
    ResultFile result;
    result.host.cpu = "FX-6300";
    result.host.cores = 6;
    result.run.settings.json = R"({"name":"quick","samples":5,"timeout":120,"series":[{"spp":[1,2]}]})";
    DeviceInfo device;
    device.key = "pocl:0";
    device.name = "FX";
    device.driver_version = "3.1";
    result.devices = {device};
    Record record;
    record.params.kernel = "pt";
    record.build.emplace().kernel_hash = "abc";
    result.cases = {record};
    return result;
}

std::vector<std::string> changed(const ResultFile& other) {
    return differences(fingerprint_of(run()), "was", fingerprint_of(other), "is");
}

TEST(fingerprint, equal_runs_do_not_differ) { EXPECT_THAT(changed(run()), IsEmpty()); }

TEST(fingerprint, names_what_differs_and_both_values) {
    ResultFile other = run();
    other.host.cpu = "Z80";
    other.devices[0].driver_version = "5.0";
    other.cases[0].build->kernel_hash = "def";
    other.run.settings.json = R"({"samples":9,"series":[{"spp":[1,2]}]})";
    EXPECT_THAT(changed(other), ElementsAre("cpu (was FX-6300, 6 cores, is Z80, 6 cores)",
                                            "driver of pocl:0 (was  , 3.1, is  , 5.0)",
                                            "kernel pt (was abc, is def)", "option samples (was 5, is 9)"));
}

TEST(fingerprint, the_cpus_that_a_run_may_use_count) {
    ResultFile other = run();
    other.host.cpus_allowed = 2;
    other.host.cpu_quota = 0.5;
    EXPECT_THAT(changed(other), ElementsAre("CPU quota (was none, is 0.5)", "CPUs allowed (was 0, is 2)"));
}

TEST(fingerprint, of_long_options_the_parts_that_differ_are_shown) {
    ResultFile other = run();
    other.run.settings.json =
        R"({"samples":5,"series":[{"kernel":["pt"],"scene":["thesis"],"size":["128x128"],"spp":[1,2,3,4,5]}]})";
    ResultFile same_beginning = other;
    same_beginning.run.settings.json.replace(other.run.settings.json.find("4,5"), 3, "4,6");
    EXPECT_THAT(differences(fingerprint_of(other), "was", fingerprint_of(same_beginning), "is"),
                ElementsAre("option series (was ... 5]}], is ... 6]}])"));
}

TEST(fingerprint, a_tuned_launch_is_another_launch) {
    ResultFile other = run();
    other.run.tuned = {Case{"pocl:0", "pt", "thesis", {8, 8}, 1, 5, {64, 0}, 16}};
    EXPECT_THAT(changed(other),
                ElementsAre("tuning of pt on pocl:0 (was nothing, is lanes 16, work-group 64)"));
}

TEST(fingerprint, a_device_that_one_side_lacks_differs_unless_it_is_not_used) {
    ResultFile other = run();
    other.devices.push_back(other.devices[0]);
    other.devices[1].key = "pocl:1";
    EXPECT_EQ(changed(other).size(), 2);
    other.devices[1].excluded = "the same device as pocl:0";
    EXPECT_THAT(changed(other), IsEmpty());
}

TEST(fingerprint, patience_names_and_what_was_not_built_do_not_matter) {
    ResultFile other = run();
    other.run.settings.json =
        R"({"name":"mine","device":["all"],"max_total_time":9,"timeout":1,"samples":5,"series":[{"spp":[1,2]}]})";
    other.cases.clear();
    other.host.load_1min = 3;
    EXPECT_THAT(changed(other), IsEmpty());
}

}  // namespace
}  // namespace ptb
