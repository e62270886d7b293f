// What drivers say of themselves, and what a locale does to numbers, through everything that is written.
#include <algorithm>
#include <clocale>
#include <cstdlib>
#include <locale>

#include <gmock/gmock.h>

#include "bench/plan/config.h"
#include "bench/record/json.h"
#include "bench/record/result_file.h"
#include "bench/report/csv.h"
#include "bench/report/markdown.h"
#include "bench/report/table.h"

/// LeakSanitizer asks for it: the C library keeps the folders of LOCPATH for ever.
extern "C" const char* __lsan_default_suppressions() { return "leak:argz_add_sep\n"; }

namespace ptb {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A small run with times, a failure, fits and warnings.
ResultFile small_result() {
    return read_result(std::filesystem::path(PTB_SOURCE_DIR) / "tests/fuzz/corpus/result/full");
}

ResultFile named(const std::string& name) {
    ResultFile result = small_result();
    DeviceInfo& device = result.devices[0];
    device.name = device.vendor = device.platform = device.driver_version = device.version = name;
    result.cases.back().reason = result.warnings[0] = result.broken_icds[0].reason = name;
    return result;
}

/// Cells of CSV, as RFC 4180 has it.
std::vector<std::vector<std::string>> cells_of(const std::string& text) {
    std::vector<std::vector<std::string>> rows{{""}};
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool doubled = quoted && text.substr(i, 2) == "\"\"";
        if (text[i] == '"' && !doubled)
            quoted = !quoted;
        else if (text[i] == ',' && !quoted)
            rows.back().emplace_back();
        else if (text[i] == '\n' && !quoted)
            rows.emplace_back(1);
        else
            rows.back().back() += text[i += doubled ? 1 : 0];
    }
    rows.pop_back();
    return rows;
}

std::size_t bars(std::string line) {
    for (auto at = line.find("\\|"); at != line.npos; at = line.find("\\|")) line.erase(at, 2);
    return static_cast<std::size_t>(std::count(line.begin(), line.end(), '|'));
}

bool plain(const std::string& text) {
    return std::all_of(text.begin(), text.end(),
                       [](char c) { return c == '\n' || static_cast<unsigned char>(c) >= 0x20; });
}

class Hostile : public testing::TestWithParam<std::string> {};

TEST_P(Hostile, names_come_back_from_json) {
    const std::string text = result_text(named(GetParam()));
    EXPECT_TRUE(plain(text));
    EXPECT_EQ(result_from_json(parse_json(text, "x"), "x").devices[0].name, GetParam());
}

TEST_P(Hostile, names_stay_in_their_cell_of_csv_and_are_no_formula) {
    const auto rows = cells_of(csv(named(GetParam())));
    ASSERT_EQ(rows.size(), 1 + small_result().cases.size());
    for (const auto& row : rows) {
        EXPECT_EQ(row.size(), rows[0].size());
        for (const std::string& cell : row) {
            EXPECT_TRUE(plain(cell) && cell.find('\n') == cell.npos) << cell;
            EXPECT_TRUE(cell.empty() || std::string("=+-@").find(cell[0]) == std::string::npos) << cell;
        }
    }
}

TEST_P(Hostile, names_stay_in_their_cell_of_markdown_and_are_no_html) {
    const std::string text = markdown(named(GetParam()), {});
    EXPECT_TRUE(plain(text));
    EXPECT_THAT(text, Not(HasSubstr("<")));
    std::istringstream lines(text);
    std::size_t columns = 0;
    for (std::string line; std::getline(lines, line);) {
        const bool in_table = line.starts_with("| ");
        if (in_table && columns != 0) {
            EXPECT_EQ(bars(line), columns) << line;
        }
        columns = in_table ? bars(line) : 0;
    }
}

TEST_P(Hostile, names_do_nothing_to_a_terminal) { EXPECT_TRUE(plain(table(named(GetParam()), {}))); }

INSTANTIATE_TEST_SUITE_P(Names, Hostile,
                         testing::Values("GeForce, \"Ti\" (R)", "two\nlines\r\n", "\x1b[31mred\x1b]0;t\x07",
                                         "</script><script>", "=1+1", "+1", "-1", "@x", "\t=1",
                                         "`|*_[a](b)\\", "a\\|b|"));

/// Numbers as every writer and reader of this process has them now.
std::string everything() {
    const ResultFile result = result_from_json(parse_json(result_text(small_result()), "x"), "x");
    return result_text(result) + csv(result) + csv_samples(result) + markdown(result, {}) +
           table(result, {}) + dump_config(parse_config(R"({"max_time": 1.5, "tolerance": "2.5%"})", "x"));
}

/// de_DE.UTF-8, as a driver may set it in a process that is not its own.
struct German {
    std::locale before;
    German() {
        ::setenv("LOCPATH", PTB_LOCALES, 1);
        if (std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr) std::locale::global(std::locale("de_DE.UTF-8"));
    }
    ~German() { std::locale::global(before); }
};

TEST(Locale, a_german_one_changes_nothing) {
    const std::string before = everything();
    const German german;
    ASSERT_STREQ(std::localeconv()->decimal_point, ",") << "localedef made no locale: install locales";
    EXPECT_EQ(everything(), before);
    EXPECT_THAT(before, HasSubstr("\"max_time\": 1.5"));
}

}  // namespace
}  // namespace ptb
