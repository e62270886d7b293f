#include <gmock/gmock.h>

#include "bench/plan/config.h"

namespace ptb {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

DeviceInfo device(std::string key, int platform, int index, std::string type, std::string name,
                  std::string excluded = "") {
    DeviceInfo d;
    d.key = std::move(key);
    d.platform_index = platform;
    d.device_index = index;
    d.type = std::move(type);
    d.name = std::move(name);
    d.excluded = std::move(excluded);
    return d;
}

const std::vector<DeviceInfo> machine = {device("pocl:0", 0, 0, "CPU", "pthread-FX-6300"),
                                         device("pocl:1", 0, 1, "CPU", "basic", "the same device as pocl:0"),
                                         device("nvidia:0", 1, 0, "GPU", "NVIDIA H200"),
                                         device("nvidia:1", 1, 1, "GPU", "NVIDIA H200")};

std::vector<std::string> selected(const std::vector<std::string>& selectors) {
    std::vector<std::string> keys;
    for (const auto& d : select_devices(selectors, machine)) keys.push_back(d.key);
    return keys;
}

std::string complaint(const std::string& selector) {
    try {
        select_devices({selector}, machine);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "(accepted)";
}

TEST(Selector, nothing_and_all_mean_every_device_that_is_not_excluded) {
    EXPECT_THAT(selected({}), ElementsAre("pocl:0", "nvidia:0", "nvidia:1"));
    EXPECT_THAT(selected({"all"}), ElementsAre("pocl:0", "nvidia:0", "nvidia:1"));
}

TEST(Selector, types_indices_positions_keys_and_patterns_select) {
    EXPECT_THAT(selected({"cpu"}), ElementsAre("pocl:0"));
    EXPECT_THAT(selected({"GPU"}), ElementsAre("nvidia:0", "nvidia:1"));
    EXPECT_THAT(selected({"2"}), ElementsAre("nvidia:0"));
    EXPECT_THAT(selected({"1:1"}), ElementsAre("nvidia:1"));
    EXPECT_THAT(selected({"nvidia:1"}), ElementsAre("nvidia:1"));
    EXPECT_THAT(selected({"/h[0-9]+/"}), ElementsAre("nvidia:0", "nvidia:1"));
    EXPECT_THAT(selected({"/^pthread/"}), ElementsAre("pocl:0"));
}

TEST(Selector, some_of_them_stand_between_commas_and_a_pattern_keeps_its_own) {
    EXPECT_THAT(selected({"cpu,nvidia:1"}), ElementsAre("pocl:0", "nvidia:1"));
    EXPECT_THAT(selected({"0,2", "3"}), ElementsAre("pocl:0", "nvidia:0", "nvidia:1"));
    EXPECT_THAT(selected({"/h[0-9]{3,3}/"}), ElementsAre("nvidia:0", "nvidia:1"));
    EXPECT_THAT(complaint("0,7"), HasSubstr("\"7\" matches none"));
    EXPECT_THAT(complaint("0,"), HasSubstr("\"\" matches none"));
}

TEST(Selector, two_equal_devices_stay_two_and_each_comes_once_in_list_order) {
    EXPECT_THAT(selected({"nvidia:1", "gpu", "0", "cpu"}), ElementsAre("pocl:0", "nvidia:0", "nvidia:1"));
}

TEST(Selector, what_matches_nothing_lists_the_devices) {
    EXPECT_THAT(complaint("accelerator"),
                AllOf(HasSubstr("matches none"), HasSubstr("nvidia:0 (GPU, NVIDIA H200)")));
    EXPECT_THAT(complaint("gpuu"), HasSubstr("did you mean gpu?"));
    for (const char* selector : {"4", "-1", "1:2", "", "/nothing/", "99999999999999999999", "0:", ":", "0x1"})
        EXPECT_THAT(complaint(selector), HasSubstr("matches none")) << selector;
}

TEST(Selector, an_excluded_device_says_why) {
    EXPECT_THAT(complaint("pocl:1"), HasSubstr("the same device as pocl:0"));
    EXPECT_THAT(complaint("1"), HasSubstr("the same device as pocl:0"));
}

TEST(Selector, bad_patterns_are_refused) {
    EXPECT_THAT(complaint("/(/"), HasSubstr("no regular expression"));
    EXPECT_THAT(complaint("/" + std::string(100'000, '(') + "/"), HasSubstr("longer than"));
}

TEST(Selector, a_machine_without_devices_selects_none) {
    EXPECT_THAT(select_devices({"gpu"}, {}), IsEmpty());
}

}  // namespace
}  // namespace ptb
