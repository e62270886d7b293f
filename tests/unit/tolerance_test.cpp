#include "bench/plan/tolerance.h"

#include <gtest/gtest.h>

namespace ptb {
namespace {

TEST(tolerance, is_a_percentage) {
    EXPECT_DOUBLE_EQ(parse_percent("5%"), 0.05);
    EXPECT_DOUBLE_EQ(parse_percent("2.5 %"), 0.025);
    EXPECT_EQ(percent_text(0.05), "5%");
    for (const char* const text : {"", "5", "0.05", "%", "0%", "-1%", "101%", "nan%", "5%%", "5% "})
        EXPECT_THROW(parse_percent(text), UsageError) << text;
}

TEST(tolerance, flag_before_series_before_config_before_profile) {
    const Config config = parse_config(
        R"({"tolerance": "4%", "series": [{"spp": 1, "tolerance": "3%"}, {"spp": [1, 2]}]})", "config");
    Case c = default_case();
    c.device = "pocl:0";
    c.spp = 1;
    Case other = c;
    other.spp = 2;
    const Tolerances by_config(config, std::nullopt, 0.05);
    EXPECT_DOUBLE_EQ(by_config.of(c), 0.03);
    EXPECT_DOUBLE_EQ(by_config.of(other), 0.04);
    EXPECT_DOUBLE_EQ(Tolerances(config, 0.02, 0.05).of(c), 0.02);
    EXPECT_DOUBLE_EQ(Tolerances(Config(), std::nullopt, 0.05).of(c), 0.05);
    EXPECT_EQ(parse_config(dump_config(config), "again"), config);
}

TEST(tolerance, a_bad_one_is_named_by_its_pointer) {
    try {
        parse_config(R"({"series": [{"tolerance": 5}]})", "my.json");
        FAIL() << "no error";
    } catch (const UsageError& error) {
        EXPECT_STREQ(
            error.what(),
            "my.json: /series/0/tolerance: found 5; allowed: a percentage above 0 and at most 100, as 5%");
    }
}

}  // namespace
}  // namespace ptb
