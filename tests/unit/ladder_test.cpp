#include "bench/report/ladder.h"

#include <gmock/gmock.h>

#include "bench/report/html/parts.h"
#include "bench/report/sections.h"

namespace ptb {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A case of which an image of this relMSE is known, timed to 10 %.
Record timed_noise(const std::string& kernel, int spp, double ms, double rel_mse) {
    Record r;
    r.params = {"gpu:0", kernel, "thesis", {128, 128}, spp, 128, {}, 0};
    r.status = Status::ok;
    Statistics s;
    s.median_ns = ms * 1e6;
    s.ci_low_ns = s.median_ns / 1.1;
    s.ci_high_ns = s.median_ns * 1.1;
    r.statistics = s;
    Noise noise{rel_mse, 0, 1e3 / (rel_mse * ms), {}, {}};
    noise.low = *noise.efficiency / 1.1;
    noise.high = *noise.efficiency * 1.1;
    r.efficiency = Efficiency{noise, noise, "film", ""};
    return r;
}

/// pt doubles its time up to 400 ms, the other kernel up to 180.
ResultFile two_kernels() {
    ResultFile f;
    f.cases = {timed_noise("pt", 4, 100, 0.4), timed_noise("pt", 8, 200, 0.2),
               timed_noise("pt", 16, 400, 0.1), timed_noise("other", 4, 90, 0.1),
               timed_noise("other", 8, 180, 0.05)};
    return f;
}

std::vector<std::string> column(const Section& section, const std::string& title) {
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < section.grid.columns.size(); ++i)
        if (section.grid.columns[i].title == title)
            for (const auto& row : section.grid.rows) cells.push_back(row.at(i));
    return cells;
}

TEST(Ladder, equal_time_is_the_longest_that_every_kernel_reaches) {
    const auto all = ladders(two_kernels().cases);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].time_ns, 180e6);
    EXPECT_THAT(all[0].cases, ElementsAre(1, 4)) << "200 ms are nearer to 180 than 100 are";
}

TEST(Ladder, a_kernel_alone_is_shown_at_its_longest) {
    auto cases = two_kernels().cases;
    cases.resize(3);
    EXPECT_THAT(ladders(cases)[0].cases, ElementsAre(2));
}

TEST(Ladder, only_the_same_work_is_compared) {
    for (const auto& change : {+[](Case& c) { c.scene = "free_light"; },
                               +[](Case& c) {
                                   c.size = {64, 64};
                               },
                               +[](Case& c) { c.path_length = 5; }, +[](Case& c) { c.device = "gpu:1"; },
                               +[](Case& c) { c.variant.rng = Rng::park_miller; }}) {
        auto cases = two_kernels().cases;
        change(cases[3].params);
        change(cases[4].params);
        const auto all = ladders(cases);
        ASSERT_EQ(all.size(), 2u);
        EXPECT_THAT(all[0].cases, ElementsAre(2));
        EXPECT_THAT(all[1].cases, ElementsAre(4));
    }
}

TEST(Ladder, what_has_no_time_no_noise_or_a_work_group_of_its_own_is_left_out) {
    auto cases = two_kernels().cases;
    cases[0].status = Status::invalid;
    cases[1].params.work_group = {64, 0};
    cases[2].efficiency->all->efficiency.reset();
    cases[3].efficiency.reset();
    cases[4].statistics.reset();
    EXPECT_THAT(ladders(cases), IsEmpty());
}

TEST(Efficiency, is_told_in_multiples_of_the_base_kernel_s) {
    const auto section = efficiency_section(two_kernels());
    EXPECT_THAT(column(section, "kernel"), ElementsAre("pt", "other"));
    EXPECT_THAT(column(section, "SPP"), ElementsAre("8", "8"));
    EXPECT_THAT(column(section, "efficiency"), ElementsAre("25.00", "111.1", "25.00", "111.1"));
    EXPECT_THAT(column(section, "x pt"), ElementsAre("1", "4.444", "1", "4.444"));
    // 10 % on both sides are sqrt(2) ln 1.1 of the ratio's logarithm
    EXPECT_THAT(column(section, "95 %"), ElementsAre("22.73-27.50", "101.0-122.2", "-", "3.884-5.086"));
}

TEST(Efficiency, without_the_base_kernel_there_are_no_multiples) {
    ResultFile f = two_kernels();
    f.cases.erase(f.cases.begin(), f.cases.begin() + 3);
    EXPECT_THAT(column(efficiency_section(f), "x pt"), ElementsAre("-", "-"));
}

TEST(Efficiency, a_run_that_knows_no_noise_has_no_table) {
    ResultFile f = two_kernels();
    for (Record& record : f.cases) record.efficiency = Efficiency{{}, {}, "", "no reference"};
    EXPECT_THAT(efficiency_section(f).grid.rows, IsEmpty());
    EXPECT_THAT(noise_section(f).grid.rows, IsEmpty());
    EXPECT_THAT(record_facts(f.cases[0]), HasSubstr("<dt>noise<dd>no reference"));
}

TEST(Efficiency, every_case_is_in_the_table_of_noise_over_time) {
    const auto section = noise_section(two_kernels());
    EXPECT_THAT(column(section, "time ms"), ElementsAre("100.0", "200.0", "400.0", "90.00", "180.0"));
    EXPECT_THAT(section.grid.cases, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(
        record_facts(two_kernels().cases[0]),
        HasSubstr("relMSE 0.400 (standard error 0) of all pixels, efficiency 25.00 1/s (22.73 to 27.50)"));
}

}  // namespace
}  // namespace ptb
