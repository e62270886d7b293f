#include "bench/report/markdown.h"

#include <gmock/gmock.h>

#include "bench/report/grid.h"

namespace ptb {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Markdown, grid_is_a_github_table) {
    const Section section{
        "times", {{{"device"}, {"SPP", true}}, {{"H200", "10"}, {"FX", "100"}}}, {"a note"}};
    EXPECT_EQ(to_markdown(section),
              "### times\n\n| device | SPP |\n| --- | ---: |\n| H200 | 10 |\n| FX | 100 |\n\n- a note\n");
}

TEST(Markdown, cells_cannot_break_the_table_or_smuggle_markup) {
    const Section section{"t", {{{"device"}}, {{"a|b\nc"}, {"<img src=x>&`*_[l](u)"}, {"back\\slash"}}}, {}};
    const auto text = to_markdown(section);
    EXPECT_THAT(text, HasSubstr("| a\\|b c |\n"));
    EXPECT_THAT(text, HasSubstr("| &lt;img src=x&gt;&amp;\\`\\*\\_\\[l\\](u) |\n"));
    EXPECT_THAT(text, HasSubstr("| back\\\\slash |\n"));
}

TEST(Grid, text_columns_are_as_narrow_as_their_cells) {
    const Section section{
        "times", {{{"device"}, {"SPP", true}}, {{"H200", "10"}, {"caf\xC3\xA9 12", "1000"}}}, {"n"}};
    EXPECT_EQ(to_text(section),
              "times\n"
              "device    SPP\n"
              "-------  ----\n"
              "H200       10\n"
              "caf\xC3\xA9 12  1000\n"
              "  n\n");
}

TEST(Grid, cells_are_shortened_where_the_column_says_so) {
    const Section section{"t", {{{"device", false, 6}, {"x"}}, {{"abcdefgh", "1"}}}, {}};
    EXPECT_THAT(to_text(section), AllOf(HasSubstr("abc...  1\n"), Not(HasSubstr("abcdefgh"))));
}

}  // namespace
}  // namespace ptb
