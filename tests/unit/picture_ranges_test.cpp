#include "bench/together/picture_ranges.h"

#include <gtest/gtest.h>

#include "bench/plan/config.h"

namespace ptb {
namespace {

PictureRanges two_devices() {
    PictureRanges ranges;
    ranges.params = default_case();
    ranges.seed = 7;
    ranges.scene_hash = "s";
    ranges.facts = {{"kernel pt", "k"}, {"ptbench", "v"}};
    ranges.cut = {21, 512};
    ranges.part_count = 30;
    ranges.film_hash = "f";
    ranges.devices = {{"a:0", "A", "1", {{0, 10}, {20, 30}}, 0.5}, {"b:0", "B", "2", {{10, 20}}, 0.25}};
    return ranges;
}

TEST(PictureRanges, say_in_json_what_they_are) {
    const PictureRanges ranges = two_devices();
    const std::string text = to_text(ranges);
    const PictureRanges read = parse_picture_ranges(text, "x.json");
    EXPECT_EQ(to_text(read), text);
    EXPECT_EQ(read.params, ranges.params);
    EXPECT_EQ(read.cut, ranges.cut);
    EXPECT_EQ(read.devices[0].parts, ranges.devices[0].parts);
    EXPECT_NE(text.find("[[0,10],[20,30]]"), std::string::npos);
}

TEST(PictureRanges, are_of_every_part_once) {
    EXPECT_EQ(fault_of(two_devices()), "");
    PictureRanges twice = two_devices();
    twice.devices[1].parts[0].first = 9;
    EXPECT_EQ(fault_of(twice), "part 9 is there twice");
    PictureRanges gap = two_devices();
    gap.devices[1].parts[0].end = 19;
    EXPECT_EQ(fault_of(gap), "part 19 is missing");
    PictureRanges end = two_devices();
    end.devices[0].parts.pop_back();
    EXPECT_EQ(fault_of(end), "found 20 parts of 30");
    PictureRanges empty = two_devices();
    empty.devices[0].parts.push_back({5, 5});
    EXPECT_EQ(fault_of(empty), "found a range of no part, at 5");
}

TEST(PictureRanges, that_overlap_are_refused_with_their_place) {
    PictureRanges twice = two_devices();
    twice.devices[1].parts[0].first = 9;
    try {
        parse_picture_ranges(to_text(twice), "x.json");
        FAIL() << "they overlap";
    } catch (const UsageError& error) {
        EXPECT_STREQ(error.what(), "x.json: /devices: part 9 is there twice");
    }
}

TEST(PictureRanges, that_do_not_say_what_kernel_made_them_are_refused) {
    PictureRanges other = two_devices();
    other.params.kernel = "bdpt";
    try {
        parse_picture_ranges(to_text(other), "x.json");
        FAIL() << "its facts are of pt";
    } catch (const UsageError& error) {
        EXPECT_STREQ(error.what(), "x.json: /facts: there is no \"kernel bdpt\", which made the picture");
    }
}

TEST(PictureRanges, of_another_schema_are_refused) {
    for (const char* text : {"{}", "[]", R"({"schema": "ptbench.result.v1"})"})
        EXPECT_THROW(parse_picture_ranges(text, "x.json"), UsageError) << text;
}

}  // namespace
}  // namespace ptb
