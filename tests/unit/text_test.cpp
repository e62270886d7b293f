#include <gmock/gmock.h>

#include "bench/report/grid.h"
#include "bench/report/table.h"

namespace ptb {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Section two_rows() {
    Section section{
        "times",
        {{{"status"}, {"ms", true}}, {{"lost its device while it rendered", "1.5"}, {"ok", "12"}}},
        {"warning: load of 7", "a note"}};
    section.grid.best = {1};
    return section;
}

TEST(Text, is_wrapped_where_the_terminal_is_narrow) {
    EXPECT_EQ(to_text(two_rows(), {20, false}),
              "times\n"
              "status            ms\n"
              "---------------  ---\n"
              "lost its device  1.5\n"
              "while it\n"
              "rendered\n"
              "ok                12\n"
              "  warning: load of 7\n"
              "  a note\n");
}

TEST(Text, words_longer_than_a_column_are_cut_between_characters) {
    const Section section{"t",
                          {{{"name"}, {"x", true}},
                           {{"\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9"
                             "\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9zz",
                             "1"}}},
                          {}};
    EXPECT_THAT(to_text(section, {15, false}), HasSubstr("\xC3\xA9  1\nzz\n"));
}

TEST(Text, has_colour_only_when_asked_for) {
    EXPECT_THAT(to_text(two_rows()), Not(HasSubstr("\x1b")));
    EXPECT_THAT(to_text(two_rows(), {0, true}),
                AllOf(HasSubstr("\x1b[1mtimes\x1b[0m\n"), HasSubstr("\x1b[33mwarning: load of 7\x1b[0m\n"),
                      HasSubstr("\x1b[32mok "), HasSubstr("  a note\n")));
}

TEST(Text, bars_are_as_long_as_their_shares_and_not_in_markdown) {
    const Section section{
        "t", {{{"ms", true}, {"speed", false, 0, true}}, {{"1", "1.000"}, {"4", "0.25"}}}, {}};
    EXPECT_EQ(to_text(section),
              "t\nms  speed\n--  --------------------\n 1  ====================\n 4  =====\n");
    EXPECT_EQ(to_markdown(section), "### t\n\n| ms |\n| ---: |\n| 1 |\n| 4 |\n");
}

}  // namespace
}  // namespace ptb
