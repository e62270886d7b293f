#include "bench/report/html/html.h"

#include <gmock/gmock.h>

#include "bench/report/html/page.h"
#include "bench/report/html/parts.h"

namespace ptb {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Html, text_cannot_end_its_element_or_attribute) {
    EXPECT_EQ(html_text("</script><img onerror='x' title=\"y\">&amp;"),
              "&lt;/script&gt;&lt;img onerror=&#39;x&#39; title=&quot;y&quot;&gt;&amp;amp;");
}

TEST(Html, text_has_no_control_characters_and_does_not_turn_around) {
    EXPECT_EQ(html_text("\x1b[31m\xE2\x80\xAE\xff"), "?[31m??");
}

TEST(Html, what_is_filled_in_is_not_filled_again) {
    EXPECT_EQ(filled("a @X@ @Y@ @Z@ b@", {{"X", "@Y@"}, {"Y", "2"}}), "a @Y@ 2 @Z@ b@");
}

TEST(Html, tables_are_tables_with_captions_headings_and_links) {
    Grid grid{{{"device"}, {"ms", true}}, {{"<H200>", "10"}, {"FX", "2"}}};
    grid.best = {1};
    const auto html = html_table(grid, "times & more", {"sortable", {"r0c0", ""}, "", {}, 0});
    EXPECT_THAT(html,
                AllOf(HasSubstr("<caption>times &amp; more</caption>"), HasSubstr("<th scope=col class=n>ms"),
                      HasSubstr("<td><a href=\"#r0c0\">&lt;H200&gt;</a><td class=n>10"),
                      HasSubstr("<tr class=best><td>FX<td")));
}

TEST(Html, facts_show_every_value_of_json) {
    EXPECT_EQ(html_facts(parse_json(R"({"a": [1, "<x>"], "b": {}})", "test")),
              "<dl><dt>a<dd><dl><dt>0<dd>1<dt>1<dd>&lt;x&gt;</dl>\n<dt>b<dd>-</dl>\n");
}

Record timed_in_groups(int x, int y, double ms) {
    Record r;
    r.params = {"gpu:0", "thesis", "thesis", {64, 64}, 4, 128, {x, y}, 0};
    r.status = Status::ok;
    r.statistics = Statistics{};
    r.statistics->median_ns = ms * 1e6;
    return r;
}

TEST(Html, two_dimensional_work_groups_are_a_map_with_the_fastest_marked) {
    ResultFile f;
    f.cases = {timed_in_groups(4, 4, 8), timed_in_groups(8, 4, 4), timed_in_groups(4, 8, 5)};
    EXPECT_THAT(work_group_maps(f), AllOf(HasSubstr("<td class=\"n shade-0\">4.000 (fastest)<"),
                                          HasSubstr("<td class=\"n shade-2\">5.000<td>-"),
                                          HasSubstr("<td class=\"n shade-7\">8.000<")));
    f.cases[1].statistics->ci_high_ns = 5.2e6;
    f.cases[2].statistics->ci_low_ns = 4.9e6;
    EXPECT_THAT(work_group_maps(f), HasSubstr("5.000 (as fast)<"));
    f.cases.pop_back();
    EXPECT_EQ(work_group_maps(f), "") << "two sizes are no map";
}

TEST(Html, a_record_in_short_has_times_image_build_and_why_it_failed) {
    Record r = timed_in_groups(4, 4, 8);
    r.statistics->ci_low_ns = 7.5e6;
    r.statistics->ci_high_ns = 8.5e6;
    r.statistics->max_ns = 9e6;
    r.validation = Validation{};
    r.validation->reason = "too <bright>";
    r.build = Build{};
    r.build->kernel_hash = "c0ffee";
    r.build->log = "warning: <a>\nand more";
    r.reason = "</dl>";
    r.status = Status::compile;
    EXPECT_THAT(record_facts(r),
                AllOf(HasSubstr("<dt>reason<dd>&lt;/dl&gt;"), HasSubstr("median 8.000 (7.500 to 8.500)"),
                      HasSubstr("most 9.000"), HasSubstr("wrong: too &lt;bright&gt;"),
                      HasSubstr("kernel c0ffee"), HasSubstr("<pre>warning: &lt;a&gt;\nand more\n</pre>")));
    EXPECT_EQ(record_facts({}), "");
}

TEST(Html, a_comparison_draws_ratio_interval_and_what_is_too_small_to_see) {
    Row row{"gpu:0", "pt <case>", 0.05, {}, "", ""};
    row.finding = {State::regressed, {}, 1e6, 1.1e6, 0.04, 20};
    row.finding.evidence.shift = {0.1, Interval{0.05, 0.15}};
    const auto html = compared_page({{row}, "old; new", {"driver: base 1, new <2>"}, "{}"});
    EXPECT_THAT(
        html, AllOf(HasSubstr("regressed: pt &lt;case&gt; on gpu:0 takes 1.105 times as long as before, "
                              "95 % interval 1.051 to 1.162."),
                    HasSubstr("<circle class=\"ratio\" cx=\"163.3\""), HasSubstr("x1=\"131.7\" x2=\"195.0\""),
                    HasSubstr("new &lt;2&gt;</li>")));
    EXPECT_THAT(html, Not(HasSubstr("Chart.js")));
}

TEST(Html, an_empty_run_has_a_page) {
    EXPECT_THAT(page({PageRun{}}, {}), HasSubstr("The result file names no picture."));
}

}  // namespace
}  // namespace ptb
