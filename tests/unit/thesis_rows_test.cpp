#include <filesystem>

#include <gmock/gmock.h>

#include "bench/report/published.h"
#include "core/input/usage_error.h"

namespace ptb {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const auto file = std::filesystem::path(PTB_SOURCE_DIR) / "results/thesis-2016.json";

Record own(Size size, int spp, double time_ms) {
    Record r;
    r.params = {"pocl:0", "thesis", "thesis", size, spp, 128, {}, 0};
    r.status = Status::ok;
    r.statistics = Statistics{};
    r.statistics->n = 1;
    r.statistics->median_ns = time_ms * 1e6;
    return r;
}

std::vector<std::string> column(const Section& section, std::size_t index) {
    std::vector<std::string> cells;
    for (const auto& row : section.grid.rows) cells.push_back(row.at(index));
    return cells;
}

TEST(ThesisRows, are_table_1) {
    const auto table = read_published(file);
    const Size size{1024, 1024};
    EXPECT_EQ(table.year, 2016);
    EXPECT_THAT(table.rows,
                ElementsAre(PublishedRow{"AMD", "GPU", "Radeon R9 290X", 10, 2589, size, 128},
                            PublishedRow{"AMD", "GPU", "Radeon R9 290X", 100, 27655, size, 128},
                            PublishedRow{"AMD", "GPU", "Radeon R9 290X", 1000, 269815, size, 128},
                            PublishedRow{"NVIDIA", "GPU", "GeForce GT 630", 10, 3492, size, 128},
                            PublishedRow{"NVIDIA", "GPU", "GeForce GT 630", 100, 33215, size, 128},
                            PublishedRow{"NVIDIA", "GPU", "GeForce GT 630", 1000, 312652, size, 128},
                            PublishedRow{"AMD", "CPU", "FX-6300 Vishera", 10, 10322, size, 128},
                            PublishedRow{"AMD", "CPU", "FX-6300 Vishera", 100, 130246, size, 128},
                            PublishedRow{"AMD", "CPU", "FX-6300 Vishera", 1000, 1405217, size, 128}));
}

TEST(ThesisRows, own_times_stand_beneath_those_of_their_spp) {
    ResultFile result;
    result.cases = {own({1024, 1024}, 100, 5000)};
    const auto section = published_section(result, read_published(file));
    EXPECT_THAT(column(section, 4), ElementsAre("2589", "3492", "10322", "27655", "33215", "130246", "5000",
                                                "269815", "312652", "1405217"));
    EXPECT_EQ(section.grid.columns.back().title, "when") << "nothing is scaled when the sizes are equal";
}

TEST(ThesisRows, times_of_another_size_are_scaled_and_marked) {
    ResultFile result;
    result.cases = {own({128, 128}, 10, 40.5)};
    const auto section = published_section(result, read_published(file));
    EXPECT_THAT(section.grid.rows[3],
                ElementsAre("", "", "pocl:0", "10", "40.50", "thesis", "128x128", "this run", "2592 (x64)"));
    EXPECT_THAT(section.notes, ElementsAre(HasSubstr("2016: Table 1"), HasSubstr("not a measurement")));
}

TEST(ThesisRows, other_work_stays_out) {
    ResultFile result;
    result.cases = {own({128, 128}, 4, 1), own({128, 128}, 10, 1), own({128, 128}, 10, 1),
                    own({128, 128}, 10, 1), own({128, 128}, 10, 1)};
    result.cases[1].params.path_length = 5;
    result.cases[2].params.scene = "furnace";
    result.cases[3].params.work_group = {64, 0};
    result.cases[4].status = Status::invalid;
    EXPECT_EQ(published_section(result, read_published(file)).grid.rows.size(), 9u);
}

TEST(ThesisRows, a_file_that_is_something_else_is_refused) {
    EXPECT_THROW(read_published(std::filesystem::path(PTB_SOURCE_DIR) / "configs/quick.json"), UsageError);
    EXPECT_THROW(read_published("/nowhere.json"), UsageError);
}

}  // namespace
}  // namespace ptb
