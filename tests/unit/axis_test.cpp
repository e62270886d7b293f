#include <gmock/gmock.h>

#include "bench/plan/axis_text.h"
#include "bench/plan/config.h"
#include "core/input/nearest.h"

namespace ptb {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string complaint(std::string_view text) {
    try {
        parse_axis(text);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "(accepted)";
}

Axis one(const std::string& name, const std::vector<std::string>& values) {
    Axis axis{{name}, {}};
    for (const auto& value : values) axis.points.push_back({value});
    return axis;
}

TEST(Axis, list_in_brackets_keeps_its_order) {
    EXPECT_EQ(parse_axis("spp=[100,10]"), one("spp", {"100", "10"}));
    EXPECT_EQ(parse_axis(" work_group = [ implicit , 64,16x16 ] "),
              one("work_group", {"implicit", "64", "16x16"}));
}

TEST(Axis, one_value_needs_no_brackets) {
    EXPECT_EQ(parse_axis("spp=10"), one("spp", {"10"}));
    EXPECT_EQ(parse_axis("scene=my scenes/a:b.json"), one("scene", {"my scenes/a:b.json"}));
}

TEST(Axis, range_with_a_step_ends_at_or_before_its_last_value) {
    EXPECT_EQ(parse_axis("spp=[10:100:30]"), one("spp", {"10", "40", "70", "100"}));
    EXPECT_EQ(parse_axis("spp=[10:99:30]"), one("spp", {"10", "40", "70"}));
    EXPECT_EQ(parse_axis("size=[7:7:1]"), one("size", {"7"}));
}

TEST(Axis, range_with_a_factor_multiplies) {
    EXPECT_EQ(parse_axis("spp=[1:1024:x2]").points.size(), 11u);
    EXPECT_EQ(parse_axis("spp=[1:100:x10]"), one("spp", {"1", "10", "100"}));
    EXPECT_EQ(parse_axis("spp=[1073741824:2147483647:x2]"), one("spp", {"1073741824"}));
}

TEST(Axis, list_may_mix_values_and_ranges) {
    EXPECT_EQ(parse_axis("spp=[1:4:x2,100]"), one("spp", {"1", "2", "4", "100"}));
}

TEST(Axis, linked_axes_have_points) {
    const Axis expected{{"spp", "size"}, {{"10", "1024"}, {"100", "512x256"}}};
    EXPECT_EQ(parse_axis("(spp,size)=[(10,1024),(100,512x256)]"), expected);
    EXPECT_EQ(parse_axis("(spp, size)=[ (10, 1024) , (100, 512x256) ]"), expected);
    EXPECT_EQ(parse_axis("(spp,size)=(10,1024)").points.size(), 1u);
}

TEST(Axis, bad_values_name_the_axis_what_was_found_and_what_is_allowed) {
    for (const char* value :
         {"0", "-1", "1.5", "1e3", "ten", "", "+5", " ", "2147483648", "99999999999999999999", "0x10"})
        EXPECT_THAT(complaint(std::string("spp=") + value),
                    AllOf(HasSubstr("spp: found \""), HasSubstr("; allowed: ")));
    EXPECT_EQ(complaint("spp=0"), "spp: found \"0\"; allowed: an integer from 1 to 2147483647");
    EXPECT_EQ(complaint("path_length=[128,0]"),
              "path_length: found \"0\"; allowed: an integer from 1 to 2147483647");
    EXPECT_EQ(complaint("lanes=2"), "lanes: found \"2\"; allowed: auto, 1, 4, 8, 16, 32");
}

TEST(Axis, bad_sizes_and_work_groups_are_refused) {
    for (const char* value : {"0", "0x4", "4x0", "4x", "x4", "4x4x4", "-4", "65536x65536", "4 x 4"})
        EXPECT_THAT(complaint(std::string("size=") + value), HasSubstr("size: found")) << value;
    for (const char* value : {"0", "0x4", "8x8x1", "Implicit", "8*8"})
        EXPECT_THAT(complaint(std::string("work_group=") + value), HasSubstr("work_group: found")) << value;
}

TEST(Axis, bad_grammar_is_refused) {
    EXPECT_THAT(complaint("spp"), HasSubstr("NAME=VALUE"));
    EXPECT_THAT(complaint("spp=[]"), HasSubstr("at least one value"));
    EXPECT_THAT(complaint("spp=10,100"), HasSubstr("a list in brackets"));
    EXPECT_THAT(complaint("spp=[10"), HasSubstr("spp: found"));
    EXPECT_THAT(complaint("spp=[1,,2]"), HasSubstr("spp: found \"\""));
    EXPECT_THAT(complaint("(spp,size)=[10,100]"), HasSubstr("points of 2 values, like (spp,size)"));
    EXPECT_THAT(complaint("(spp,size)=[(1,2,3)]"), HasSubstr("points of 2 values"));
    EXPECT_THAT(complaint("(spp,spp)=[(1,2)]"), HasSubstr("twice"));
}

TEST(Axis, bad_ranges_are_refused) {
    for (const char* range : {"1:10", "10:1:1", "1:10:0", "1:10:x1", "1:10:-1", "0:10:1", "1:10:1:1", "a:b:c",
                              "1:9999999999:1", "::", "1:10:x"})
        EXPECT_THAT(complaint(std::string("spp=[") + range + "]"), HasSubstr("FIRST:LAST:STEP")) << range;
    EXPECT_THAT(complaint("spp=[1:2147483647:1]"), HasSubstr("at most 4096 values"));
}

TEST(Axis, unknown_axis_gets_the_nearest_name) {
    EXPECT_THAT(complaint("sppp=1"), HasSubstr("did you mean spp?"));
    EXPECT_THAT(complaint("workgroup=1"), HasSubstr("did you mean work_group?"));
    EXPECT_THAT(complaint("banana=1"),
                AllOf(HasSubstr("allowed: kernel, scene"), Not(HasSubstr("did you mean"))));
    EXPECT_THAT(complaint("device=0"), HasSubstr("choose devices with -d"));
}

TEST(Axis, escape_codes_do_not_reach_the_message) {
    EXPECT_THAT(complaint("spp=\x1b[31m"), Not(HasSubstr("\x1b")));
    EXPECT_THAT(complaint("\x1b[31m=1"), Not(HasSubstr("\x1b")));
    EXPECT_THAT(complaint("scene=a\nb"), AllOf(HasSubstr("scene: found"), Not(HasSubstr("\n"))));
}

TEST(Axis, values_written_are_values_read) {
    Case c = default_case();
    for (const auto& [axis, value] :
         std::vector<std::pair<std::string, std::string>>{{"kernel", "thesis"},
                                                          {"scene", "a.json"},
                                                          {"size", "640x480"},
                                                          {"spp", "7"},
                                                          {"path_length", "5"},
                                                          {"lanes", "auto"},
                                                          {"lanes", "16"},
                                                          {"work_group", "implicit"},
                                                          {"work_group", "64"},
                                                          {"work_group", "64x1"},
                                                          {"devices", "3"},
                                                          {"devices", "all"},
                                                          {"together", "gpus"},
                                                          {"together", "all"}}) {
        set_case_value(c, axis, value);
        EXPECT_EQ(case_value(c, axis), value);
    }
    set_case_value(c, "size", "128");
    EXPECT_EQ(c.size, (Size{128, 128}));
    EXPECT_EQ(to_string(c.size), "128x128");
}

TEST(Axis, names_are_in_nesting_order) {
    EXPECT_THAT(axis_names(), ElementsAre("kernel", "scene", "size", "spp", "path_length", "scene_memory",
                                          "film_memory", "queue", "dispatch", "pixel_filter", "rng",
                                          "roulette", "build", "bvh", "bvh_split", "ray_kind",
                                          "reconstruction", "lanes", "work_group", "devices", "together"));
}

TEST(NearestMatch, finds_typing_errors_and_nothing_else) {
    const std::vector<std::string> words = {"spp", "size", "scene", "work_group", "max-time"};
    EXPECT_EQ(nearest_match("psp", words), "spp");
    EXPECT_EQ(nearest_match("SIZE", words), "size");
    EXPECT_EQ(nearest_match("max-tmie", words), "max-time");
    EXPECT_EQ(nearest_match("work-group", words), "work_group");
    EXPECT_EQ(nearest_match("banana", words), std::nullopt);
    EXPECT_EQ(nearest_match("", words), std::nullopt);
    EXPECT_EQ(nearest_match(std::string(1'000'000, 's'), words), std::nullopt);
}

}  // namespace
}  // namespace ptb
