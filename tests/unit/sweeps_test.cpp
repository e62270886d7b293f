#include <map>

#include <gmock/gmock.h>

#include "bench/compare/row.h"
#include "bench/plan/config.h"
#include "bench/report/axes.h"
#include "bench/report/csv.h"
#include "bench/report/html/page.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Record with(const std::string& axis, const std::string& value, double ms, int spp = 10) {
    Record r;
    r.params = default_case();
    r.params.device = "gpu:0";
    r.params.spp = spp;
    set_case_value(r.params, axis, value);
    r.status = Status::ok;
    r.statistics = Statistics{};
    r.statistics->median_ns = ms * 1e6;
    return r;
}

Record without_time(Record r, Status status, const std::string& reason) {
    r.status = status;
    r.reason = reason;
    r.statistics.reset();
    return r;
}

std::vector<std::string> column(const Section& section, const std::string& title) {
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < section.grid.columns.size(); ++i)
        if (section.grid.columns[i].title == title)
            for (const auto& row : section.grid.rows) cells.push_back(row.at(i));
    return cells;
}

/// A value of the axis that is not the usual one.
std::string another(const std::string& name) {
    for (const VariantAxis& axis : variant_axes())
        if (axis.name == name) return axis.values.back();
    const std::map<std::string, std::string> others{
        {"path_length", "5"}, {"devices", "77"}, {"together", "gpus"}};
    const auto found = others.find(name);
    return found == others.end() ? "other" : found->second;
}

class EachAxis : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Sweeps, EachAxis, testing::ValuesIn(other_axes()));

TEST_P(EachAxis, gets_a_table_of_relative_times_with_the_fastest_marked) {
    const std::string usual = case_value(default_case(), GetParam());
    ResultFile f;
    f.cases = {with(GetParam(), usual, 8), with(GetParam(), another(GetParam()), 4)};
    const auto sections = sweep_sections(f);
    ASSERT_EQ(sections.size(), 1u);
    EXPECT_EQ(sections[0].title, "by " + GetParam());
    EXPECT_THAT(column(sections[0], GetParam()), ElementsAre(usual, another(GetParam())));
    EXPECT_THAT(column(sections[0], "x fastest"), ElementsAre("2.000", "1.000"));
    EXPECT_THAT(column(sections[0], ""), ElementsAre("", "fastest"));
    EXPECT_THAT(sections[0].grid.cases, ElementsAre(0, 1));
    EXPECT_THAT(sections[0].grid.best, ElementsAre(1));
}

TEST(Sweeps, nobody_is_the_fastest_alone_where_intervals_overlap) {
    ResultFile f;
    f.cases = {with("path_length", "5", 8), with("path_length", "6", 4), with("path_length", "7", 4.01)};
    for (Record& record : f.cases) {
        record.statistics->ci_low_ns = record.statistics->median_ns * 0.99;
        record.statistics->ci_high_ns = record.statistics->median_ns * 1.01;
    }
    const auto sections = sweep_sections(f);
    ASSERT_EQ(sections.size(), 1u);
    EXPECT_THAT(column(sections[0], ""), ElementsAre("", "fastest", "as fast"));
    EXPECT_THAT(sections[0].grid.best, ElementsAre(1, 2));
    f.cases[2].status = Status::unstable;
    EXPECT_THAT(sweep_sections(f)[0].grid.best, ElementsAre(1)) << "its interval is wide because it is noisy";
}

TEST_P(EachAxis, is_a_column_of_tables_only_where_it_varies) {
    const std::string usual = case_value(default_case(), GetParam());
    ResultFile f;
    f.cases = {with(GetParam(), usual, 8)};
    EXPECT_THAT(column(times_section(f), GetParam()), IsEmpty());
    EXPECT_THAT(sweep_sections(f), IsEmpty());
    f.cases.push_back(with(GetParam(), another(GetParam()), 4));
    EXPECT_THAT(column(times_section(f), GetParam()), ElementsAre(usual, another(GetParam())));
}

TEST_P(EachAxis, keeps_devices_side_by_side_apart) {
    ResultFile f;
    f.cases = {with(GetParam(), case_value(default_case(), GetParam()), 8),
               with(GetParam(), another(GetParam()), 4)};
    f.cases[1].params.device = "gpu:1";
    EXPECT_THAT(column(devices_section(f), "x slowest"), ElementsAre("1.00", "1.00"))
        << "different work was compared";
    EXPECT_EQ(column(devices_section(f), GetParam()).size(), 2u);
}

TEST_P(EachAxis, is_in_the_name_of_a_case_and_in_csv) {
    const Record r = with(GetParam(), another(GetParam()), 4);
    EXPECT_THAT(case_text(r.params), HasSubstr(another(GetParam())));
    ResultFile f;
    f.cases = {r};
    EXPECT_THAT(csv(f), AllOf(HasSubstr(GetParam()), HasSubstr("," + another(GetParam()))));
}

TEST(Sweeps, what_has_no_time_says_why) {
    ResultFile f;
    f.cases = {with("path_length", "5", 8), with("path_length", "6", 4), with("path_length", "7", 2)};
    f.cases[0] = without_time(f.cases[0], Status::unsupported, "no images here");
    f.cases[2] = without_time(f.cases[2], Status::invalid, "too bright");
    const auto sections = sweep_sections(f);
    ASSERT_EQ(sections.size(), 1u);
    EXPECT_THAT(column(sections[0], "time ms"), ElementsAre("-", "4.000", "-"));
    EXPECT_THAT(column(sections[0], ""),
                ElementsAre("unsupported: no images here", "fastest", "invalid: too bright"));
}

TEST(Sweeps, an_axis_without_any_time_has_no_table) {
    ResultFile f;
    f.cases = {without_time(with("scene", "a", 1), Status::unsupported, "x"),
               without_time(with("scene", "b", 1), Status::unsupported, "x")};
    EXPECT_THAT(sweep_sections(f), IsEmpty());
}

TEST(Sweeps, the_most_samples_and_the_fewest_other_changes_are_shown) {
    ResultFile f;
    for (const char* length : {"128", "5"})
        for (const int spp : {10, 100})
            for (const char* scene : {"thesis", "free_light"}) {
                f.cases.push_back(with("path_length", length, 1, spp));
                f.cases.back().params.scene = scene;
            }
    const auto sections = sweep_sections(f);
    ASSERT_EQ(sections.size(), 2u);
    EXPECT_THAT(column(sections[0], "scene"), ElementsAre("thesis", "free_light"));
    EXPECT_THAT(column(sections[1], "path_length"), ElementsAre("128", "5"));
    for (const Section& section : sections) EXPECT_THAT(column(section, "SPP"), ElementsAre("100", "100"));
}

TEST(Sweeps, the_usual_case_is_the_headline) {
    ResultFile f;
    f.cases = {with("path_length", "128", 8), with("path_length", "5", 4)};
    EXPECT_THAT(summary_section(f).notes, Contains(HasSubstr("takes 8.000 ms")));
    f.cases.erase(f.cases.begin());
    EXPECT_THAT(summary_section(f).notes, Contains(HasSubstr("at 128x128, path_length 5 takes 4.000 ms")));
}

TEST(Sweeps, their_rows_in_a_page_lead_to_the_cases) {
    ResultFile f;
    f.cases = {with("path_length", "128", 8), with("path_length", "5", 4)};
    const std::string html = page({{f, {}, ""}}, {});
    EXPECT_THAT(html, AllOf(HasSubstr("<table class=\"sweep\">"), HasSubstr("<a href=\"#r0c1\">5</a>")));
    f.cases.pop_back();
    EXPECT_THAT(page({{f, {}, ""}}, {}), Not(HasSubstr("<table class=\"sweep\">")));
}

TEST(Sweeps, runs_of_different_values_have_a_column_where_they_share_a_table) {
    ResultFile a, b;
    a.cases = {with("path_length", "128", 8)};
    b.cases = {with("path_length", "5", 8)};
    EXPECT_THAT(page({{a, {}, ""}, {b, {}, ""}}, {}), HasSubstr(">path_length<"));
}

}  // namespace
}  // namespace ptb
