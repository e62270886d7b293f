#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "bench/plan/config.h"

namespace ptb {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<DeviceInfo> devices(const std::vector<std::string>& keys) {
    std::vector<DeviceInfo> result;
    for (const auto& key : keys) result.emplace_back().key = key;
    return result;
}

Config config(const std::string& series) {
    return parse_config(fmt::format("{{\"series\": {}}}", series), "test");
}

std::vector<std::string> texts(const std::vector<Case>& cases, const std::vector<std::string>& axes) {
    std::vector<std::string> result;
    for (const Case& c : cases) {
        std::vector<std::string> values;
        for (const auto& axis : axes) values.push_back(case_value(c, axis));
        result.push_back(fmt::format("{}", fmt::join(values, " ")));
    }
    return result;
}

std::string complaint(const std::string& series) {
    try {
        expand(config(series), devices({"a"}));
    } catch (const UsageError& error) {
        return error.what();
    }
    return "(accepted)";
}

TEST(Expand, a_config_without_series_is_one_case_of_defaults) {
    const auto cases = expand(Config{}, devices({"a"}));
    EXPECT_THAT(cases, ElementsAre(Case{"a", "pt", "thesis", {128, 128}, 10, 128, {}, 0}));
}

TEST(Expand, sweep_order_is_device_major) {
    const auto cases =
        expand(config(R"j([{"work_group": [64, 16], "spp": [2, 1], "kernel": ["thesis", "pt"]}])j"),
               devices({"b", "a"}));
    const auto order = texts(cases, {"device", "kernel", "spp", "work_group"});
    ASSERT_EQ(order.size(), 16u);
    EXPECT_THAT(std::vector(order.begin(), order.begin() + 5),
                ElementsAre("b thesis 2 64", "b thesis 2 16", "b thesis 1 64", "b thesis 1 16", "b pt 2 64"));
    EXPECT_EQ(order[8], "a thesis 2 64");
}

TEST(Expand, linked_axes_move_together_and_nest_at_the_outermost) {
    const auto cases = expand(
        config(R"j([{"(work_group,kernel)": [[8,"pt"],[4,"thesis"]], "spp": [1, 2]}])j"), devices({"a"}));
    EXPECT_THAT(texts(cases, {"kernel", "work_group", "spp"}),
                ElementsAre("pt 8 1", "pt 8 2", "thesis 4 1", "thesis 4 2"));
}

TEST(Expand, series_follow_one_another_and_equal_cases_come_once) {
    const auto cases =
        expand(config(R"j([{"spp": [2, 1, 2]}, {"spp": [1, 3], "size": "128x128"}])j"), devices({"a"}));
    EXPECT_THAT(texts(cases, {"spp"}), ElementsAre("2", "1", "3"));
}

TEST(Expand, more_segments_than_a_pixel_counts_are_refused) {
    EXPECT_THAT(complaint(R"j([{"spp": 33554432, "path_length": 128}])j"), HasSubstr("spp x path_length"));
    EXPECT_EQ(complaint(R"j([{"spp": 33554431, "path_length": 128}])j"), "(accepted)");
    EXPECT_THAT(complaint(R"j([{"spp": 2147483647, "path_length": 2147483647}])j"),
                HasSubstr("allowed: less than 4294967296"));
}

TEST(Expand, a_sweep_without_end_is_refused) {
    EXPECT_THAT(complaint(R"j([{"spp": "[1:4000:1]", "size": "[1:4000:1]", "path_length": "[1:4000:1]"}])j"),
                HasSubstr("a series of more than 100000 cases"));
    const std::string large = R"j({"spp": "[1:4000:1]", "size": "[1:15:1]"})j";
    EXPECT_EQ(complaint("[" + large + "]"), "(accepted)");
    EXPECT_THAT(complaint("[" + large + "," + large + "]"), HasSubstr("more than 100000 cases in all"));
}

TEST(Expand, quick_config_holds_the_thesis_spps_and_both_models_of_work_groups) {
    const auto configs = std::filesystem::path(PTB_SOURCE_DIR) / "configs";
    const auto cases = expand(load_config("quick", configs), devices({"a"}));
    EXPECT_THAT(
        texts(cases, {"kernel", "size", "spp", "path_length", "work_group"}),
        ElementsAre("thesis 128x128 10 128 implicit", "thesis 128x128 100 128 implicit",
                    "thesis 128x128 1000 128 implicit", "pt 128x128 10 128 implicit",
                    "pt 128x128 100 128 implicit", "pt 128x128 1000 128 implicit",
                    "thesis 128x128 4 128 implicit", "thesis 128x128 4 128 16", "thesis 128x128 4 128 64",
                    "thesis 128x128 4 128 256", "pt 128x128 4 128 implicit", "pt 128x128 4 128 16",
                    "pt 128x128 4 128 64", "pt 128x128 4 128 256"));
}

TEST(Expand, a_picture_of_several_devices_is_planned_with_the_first_of_their_type) {
    std::vector<DeviceInfo> found = devices({"cpu", "gpu0", "gpu1", "gpu2"});
    found[0].type = "CPU";
    for (std::size_t i = 1; i < found.size(); ++i) found[i].type = "GPU";
    const Config three = config(R"([{"devices": ["all", 2, 1]}])");
    EXPECT_THAT(texts(expand(three, found), {"device", "devices"}),
                ElementsAre("cpu 1", "cpu 2", "gpu0 3", "gpu0 2", "gpu0 1", "gpu1 1", "gpu2 1"))
        << "all CPUs are one: no case of its own";
    EXPECT_THAT(texts(expand(three, {DeviceInfo()}), {"devices"}), ElementsAre("all", "2", "1"));
}

}  // namespace
}  // namespace ptb
