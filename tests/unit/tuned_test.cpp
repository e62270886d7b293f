#include "bench/plan/tuned.h"

#include <gmock/gmock.h>

#include "bench/plan/tolerance.h"
#include "bench/record/json.h"

namespace ptb {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const Case best{"a", "pt", "thesis", {512, 512}, 2, 128, {64, 0}, 16};

/// Lane width and work-group of each case, tuned ones starred.
std::vector<std::string> launches(const std::string& series, const std::string& device = "a") {
    const Config config = parse_config("{\"series\": [" + series + "]}", "test");
    DeviceInfo info;
    info.key = device;
    std::vector<std::string> texts;
    for (const Case& c : expand(config, {info}, {best}))
        texts.push_back(case_value(c, "lanes") + (c.lanes_tuned ? "* " : " ") + to_string(c.work_group) +
                        (c.work_group_tuned ? "*" : ""));
    return texts;
}

TEST(tuned, fills_what_nobody_named) { EXPECT_THAT(launches(R"({"spp": 1})"), ElementsAre("16* 64*")); }

TEST(tuned, never_changes_a_value_that_was_named) {
    EXPECT_THAT(launches(R"({"work_group": ["implicit", 256]})"), ElementsAre("16* implicit", "16* 256"));
    EXPECT_THAT(launches(R"({"lanes": "auto", "work_group": "implicit"})"), ElementsAre("auto implicit"));
    EXPECT_THAT(launches(R"j({"(spp,lanes)": [[1, "auto"]]})j"), ElementsAre("auto implicit"));
}

TEST(tuned, a_work_group_is_best_with_the_lanes_it_was_raced_with) {
    EXPECT_THAT(launches(R"({"lanes": [4, 16]})"), ElementsAre("4 implicit", "16 64*"));
}

TEST(tuned, is_of_one_device_and_one_kernel) {
    EXPECT_THAT(launches(R"({"spp": 1})", "b"), ElementsAre("auto implicit"));
    EXPECT_THAT(launches(R"({"kernel": ["thesis", "pt"]})"), ElementsAre("auto implicit", "16* 64*"));
}

TEST(tuned, a_series_that_names_an_axis_keeps_its_case_beside_one_that_does_not) {
    EXPECT_THAT(launches(R"({"spp": 1}, {"spp": 1, "lanes": "auto", "work_group": "implicit"})"),
                ElementsAre("16* 64*", "auto implicit"));
}

TEST(tuned, the_record_says_where_a_value_came_from) {
    Case c = best;
    c.lanes_tuned = true;
    const Json json = encode(c);
    EXPECT_EQ(json["lanes_from"], "tune");
    EXPECT_FALSE(json.contains("work_group_from"));
    EXPECT_EQ(json.get<Case>(), c);
    Json odd = json;
    odd["lanes_from"] = 5;
    EXPECT_THROW(odd.get<Case>(), UsageError);
}

TEST(tuned, a_tolerance_is_that_of_the_case_as_it_was_asked_for) {
    const Config config = parse_config(R"({"series": [{"spp": 1, "tolerance": "40%"}]})", "test");
    DeviceInfo info;
    info.key = "a";
    const Case c = expand(config, {info}, {best}).front();
    EXPECT_EQ(as_asked(c), expand(config, {info}).front());
    EXPECT_EQ(Tolerances(config, std::nullopt, 0.05).of(c), 0.4);
}

}  // namespace
}  // namespace ptb
