#include "bench/plan/config.h"

#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace ptb {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::filesystem::path configs = std::filesystem::path(PTB_SOURCE_DIR) / "configs";

std::string complaint(const std::string& json) {
    try {
        parse_config(json, "c.json");
    } catch (const UsageError& error) {
        return error.what();
    }
    return "(accepted)";
}

TEST(Config, every_key_is_read) {
    const Config config = parse_config(R"j({
        "name": "n", "description": "d", "device": ["cpu", 1], "warmup": 0, "min_samples": 6, "max_samples": 7, "max_time": 2.5,
        "max_total_time": 90, "timeout": 60, "seed": 4294967295, "timer": "host", "skip_time": true,
        "kernel_dir": "k", "pictures": "equal_time",
        "series": [{"name": "s", "kernel": "pt", "spp": [1, "2"], "size": "[1:4:x2]",
                    "(path_length,lanes)": [[5, "auto"], [128, 8]]}]
})j",
                                       "c.json");
    Config expected;
    expected.name = "n";
    expected.description = "d";
    expected.devices = {"cpu", "1"};
    expected.measure = {4294967295u, 0, 6, 7, 2.5, "host", true, "k"};
    expected.max_total_time_s = 90;
    expected.timeout_s = 60;
    expected.pictures = Pictures::equal_time;
    expected.series = {{"s",
                        {{{"kernel"}, {{"pt"}}},
                         {{"spp"}, {{"1"}, {"2"}}},
                         {{"size"}, {{"1"}, {"2"}, {"4"}}},
                         {{"path_length", "lanes"}, {{"5", "auto"}, {"128", "8"}}}},
                        {}}};
    EXPECT_EQ(config, expected);
}

TEST(Config, dumped_config_reads_back_to_the_same_value) {
    for (const char* name : {"quick", "thesis", "ci", "ladder", "tune", "doctor"}) {
        const Config config = load_config(name, configs);
        EXPECT_EQ(config.name, name);
        EXPECT_EQ(parse_config(dump_config(config), "dump"), config);
    }
    EXPECT_EQ(parse_config(dump_config(Config{}), "dump"), Config{});
}

TEST(Config, samples_fixes_their_number) {
    const Config config = parse_config(R"j({"samples": 7})j", "c.json");
    EXPECT_EQ(config.measure.min_samples, 7);
    EXPECT_EQ(config.measure.max_samples, 7);
}

TEST(Config, linked_axes_may_be_text) {
    const Config config = parse_config(R"j({"series": [{"(spp,size)": "[(10,1024),(100,512)]"}]
})j",
                                       "c.json");
    EXPECT_EQ(config.series[0].axes[0], parse_axis("(spp,size)=[(10,1024),(100,512)]"));
}

TEST(Config, unknown_keys_are_named_with_a_pointer_and_the_nearest_key) {
    EXPECT_EQ(complaint(R"j({"series": [{"sppp": 1}]})j"),
              "c.json: /series/0/sppp: unknown key; did you mean spp?");
    EXPECT_EQ(complaint(R"j({"max_tiem": 1})j"), "c.json: /max_tiem: unknown key; did you mean max_time?");
    EXPECT_THAT(complaint(R"j({"banana": 1})j"),
                AllOf(StartsWith("c.json: /banana: unknown key; allowed: "), HasSubstr("series")));
    EXPECT_THAT(complaint(R"j({"series": [{"(spp,sise)": 1
}]
})j"),
                HasSubstr("did you mean size?"));
}

TEST(Config, bad_axis_values_have_a_pointer) {
    EXPECT_EQ(complaint(R"j({"series": [{}, {"spp": [1, 0]}]})j"),
              "c.json: /series/1/spp: spp: found \"0\"; allowed: an integer from 1 to 2147483647");
    EXPECT_THAT(complaint(R"j({"series": [{"spp": [1, 1.5]}]})j"),
                StartsWith("c.json: /series/0/spp/1: found 1.5; allowed"));
    EXPECT_THAT(complaint(R"j({"series": [{"spp": []}]})j"), StartsWith("c.json: /series/0/spp: found []"));
    EXPECT_THAT(complaint(R"j({"series": [{"spp": [[1]]}]})j"),
                StartsWith("c.json: /series/0/spp/0: found an array"));
    EXPECT_THAT(complaint(R"j({"series": [{"(spp,size)": [[1]]
}]
})j"),
                HasSubstr("a list of 2 values"));
    EXPECT_THAT(complaint(R"j({"series": [{"spp": 1, "(spp,size)": [[1,2]]
}]
})j"),
                HasSubstr("already"));
}

TEST(Config, wrong_types_and_values_are_refused) {
    for (const char* member : {R"j("name": 1)j",
                               R"j("device": {})j",
                               R"j("device": [[]])j",
                               R"j("device": -1)j",
                               R"j("warmup": -1)j",
                               R"j("min_samples": 0)j",
                               R"j("max_samples": 0)j",
                               R"j("max_samples": 1.5)j",
                               R"j("max_samples": "5")j",
                               R"j("max_samples": 99999999999)j",
                               R"j("max_time": 0)j",
                               R"j("max_time": -1)j",
                               R"j("max_time": "30")j",
                               R"j("max_time": null)j",
                               R"j("timeout": 0)j",
                               R"j("max_total_time": -0.1)j",
                               R"j("max_time": 1e300)j",
                               R"j("seed": -1)j",
                               R"j("seed": 4294967296)j",
                               R"j("seed": 1.5)j",
                               R"j("timer": "clock")j",
                               R"j("timer": 1)j",
                               R"j("skip_time": 1)j",
                               R"j("kernel_dir": [])j",
                               R"j("series": {})j",
                               R"j("series": [])j",
                               R"j("series": [1])j",
                               R"j("series": [{"name": 1}])j",
                               R"j("series": [{"spp": {}}])j",
                               R"j("series": [{"spp": null}])j",
                               R"j("series": [{"spp": true}])j",
                               R"j("series": [{"device": 0}])j"})
        EXPECT_THAT(complaint(fmt::format("{{{}}}", member)), StartsWith("c.json: /")) << member;
}

TEST(Config, hostile_text_is_refused_in_one_line) {
    const auto deep_lists = fmt::format("{{\"series\":{:[<100000}", "");
    std::string deep_objects;
    for (int i = 0; i < 100'000; ++i) deep_objects += R"j({"a":)j";
    std::string many_keys = "{";
    for (int i = 0; i < 100'000; ++i) many_keys += fmt::format("\"{}\":0,", i);
    const std::string texts[] = {"",
                                 "{",
                                 "[]",
                                 "1",
                                 "null",
                                 R"j({"name": "a)j",
                                 R"j({"max_time": NaN})j",
                                 R"j({"max_time": 1e999})j",
                                 "{\"name\": \"\xff\"}",
                                 R"j({"name":"a","name":"b"})j",
                                 std::string("\0\0", 2),
                                 R"j({"name": "a"} x)j",
                                 deep_lists,
                                 deep_objects,
                                 many_keys};
    for (const auto& text : texts) {
        const auto message = complaint(text);
        EXPECT_THAT(message, StartsWith("c.json: ")) << text.substr(0, 40);
        EXPECT_EQ(message.find('\n'), std::string::npos);
        EXPECT_LT(message.size(), 400u);
    }
}

TEST(Config, every_truncation_of_a_config_is_refused_or_read) {
    const std::string whole = dump_config(load_config("quick", configs));
    for (std::size_t length = 0; length + 2 < whole.size(); ++length)
        EXPECT_THAT(complaint(whole.substr(0, length)), StartsWith("c.json: "));
}

TEST(Config, unknown_name_lists_what_there_is) {
    try {
        load_config("quik", configs);
        FAIL() << "a config that is not there was loaded";
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("did you mean quick?"),
                                        HasSubstr("cards, ci, doctor, ladder, memory, quality, queues, "
                                                  "quick, rays, speed, thesis, tune, workgroups")));
    }
    EXPECT_THROW(load_config("quick", "/nowhere"), UsageError);
    EXPECT_THROW(load_config("", configs), UsageError);
}

TEST(Config, file_is_loaded_by_its_path) {
    EXPECT_EQ(load_config((configs / "ci.json").string(), "/nowhere").name, "ci");
}

TEST(OverrideAxis, replaces_the_axis_in_every_series) {
    Config config = parse_config(R"j({"series": [{"spp": [1,2], "size": 8}, {"kernel": "pt"}]})j", "c.json");
    override_axis(config, parse_axis("spp=5"));
    EXPECT_EQ(config,
              parse_config(R"j({"series": [{"size": 8, "spp": 5}, {"kernel": "pt", "spp": 5}]})j", "c.json"));
}

TEST(OverrideAxis, takes_one_name_out_of_linked_axes) {
    Config config = parse_config(R"j({"series": [{"(spp,size)": [[1,8],[2,8],[3,16]]}]
})j",
                                 "c.json");
    override_axis(config, parse_axis("spp=5"));
    EXPECT_EQ(config, parse_config(R"j({"series": [{"size": [8,16], "spp": 5}]})j", "c.json"));
}

TEST(OverrideAxis, makes_a_series_where_there_is_none) {
    Config config;
    override_axis(config, parse_axis("spp=5"));
    ASSERT_EQ(config.series.size(), 1u);
    EXPECT_EQ(config.series[0].axes[0], parse_axis("spp=5"));
}

}  // namespace
}  // namespace ptb
