#include "bench/report/table.h"

#include <filesystem>
#include <limits>
#include <locale>

#include <gmock/gmock.h>

#include "bench/report/markdown.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const PublishedTable& thesis() {
    static const auto table =
        read_published(std::filesystem::path(PTB_SOURCE_DIR) / "results/thesis-2016.json");
    return table;
}

DeviceInfo device(std::string key, std::string vendor, std::string type, std::string name) {
    DeviceInfo d;
    d.key = std::move(key);
    d.vendor = std::move(vendor);
    d.type = std::move(type);
    d.name = std::move(name);
    return d;
}

Record timed_record(std::string device_key, std::string kernel, int spp, double median_ms) {
    Record r;
    r.params = {std::move(device_key), std::move(kernel), "thesis", {128, 128}, spp, 128, {}, 0};
    r.status = Status::ok;
    r.work = Work{163840, 5'000'000, 0, 0, 8, 1, 0, 0, 0, {}};
    Statistics s;
    s.timer = "event";
    s.n = 5;
    s.median_ns = median_ms * 1e6;
    s.mad_ns = median_ms * 1e4;
    s.msamples_per_s = 12.345678;
    s.msegments_per_s = 381.04;
    r.statistics = s;
    return r;
}

Record failed_record(int work_group_x, Status status, std::string reason) {
    Record r;
    r.params = {"gpu:0", "pt", "thesis", {128, 128}, 4, 128, {work_group_x, 0}, 0};
    r.status = status;
    r.reason = std::move(reason);
    return r;
}

ResultFile two_devices() {
    ResultFile f;
    f.devices = {device("pocl:0", "AuthenticAMD", "CPU", "pthread-FX-6300"),
                 device("gpu:0", "NVIDIA Corporation", "GPU", "NVIDIA H200")};
    f.cases = {timed_record("pocl:0", "thesis", 10, 400), timed_record("pocl:0", "pt", 10, 100),
               timed_record("gpu:0", "thesis", 10, 8), timed_record("gpu:0", "pt", 10, 4)};
    return f;
}

/// Cells of a section's rows in the named column.
std::vector<std::string> column(const Section& section, const std::string& title) {
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < section.grid.columns.size(); ++i)
        if (section.grid.columns[i].title == title)
            for (const auto& row : section.grid.rows) cells.push_back(row.at(i));
    return cells;
}

TEST(Table, the_thesis_columns_come_first_and_in_its_order) {
    const auto columns = times_section(two_devices()).grid.columns;
    std::vector<std::string> titles;
    for (std::size_t i = 0; i < 5; ++i) titles.push_back(columns[i].title);
    EXPECT_THAT(titles, ElementsAre("vendor", "type", "device", "SPP", "time ms"));
}

TEST(Table, rows_show_vendor_time_spread_and_rates) {
    EXPECT_THAT(
        to_text(times_section(two_devices())),
        HasSubstr("AMD     CPU   pthread-FX-6300   10    400.0  thesis  128x128  implicit        8  ~1.0"
                  "       12.35        381.0\n"));
}

TEST(Table, spread_is_the_interval_when_there_is_one) {
    Statistics s = *timed_record("a", "pt", 1, 100).statistics;
    s.ci_low_ns = 98e6;
    s.ci_high_ns = 103e6;
    EXPECT_EQ(spread_text(s), "2.5");
    s.ci_low_ns.reset();
    s.n = 2;
    EXPECT_EQ(spread_text(s), "-") << "two samples have no spread to speak of";
}

TEST(Table, numbers_have_four_digits_or_all_before_the_point) {
    EXPECT_EQ(number_text(1405217), "1405217");
    EXPECT_EQ(number_text(1234.56), "1235");
    EXPECT_EQ(number_text(123.456), "123.5");
    EXPECT_EQ(number_text(1.23456), "1.235");
    EXPECT_EQ(number_text(0.00123), "0.0012");
    EXPECT_EQ(number_text(0), "0");
    EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "-");
}

TEST(Table, axes_that_differ_get_a_column_and_others_stand_in_the_title) {
    ResultFile f = two_devices();
    EXPECT_EQ(times_section(f).title, "times, scene thesis, path length 128");
    f.cases[1].params.path_length = 5;
    EXPECT_EQ(times_section(f).title, "times, scene thesis");
    EXPECT_THAT(column(times_section(f), "path_length"), ElementsAre("128", "5", "128", "128"));
}

TEST(Table, a_time_by_the_host_clock_says_so) {
    ResultFile f = two_devices();
    f.cases[0].statistics->timer = "host";
    f.cases[0].statistics->timer_reason = "asked for";
    f.cases[1].statistics->stop_reason = "low_n";
    EXPECT_THAT(column(times_section(f), "note"), ElementsAre("timer: host (asked for)", "low n", "", ""));
}

TEST(Table, an_image_that_is_wrong_never_has_a_time) {
    ResultFile f = two_devices();
    f.cases[0].status = Status::invalid;
    f.cases[0].reason = "block 3 is off by 9.1 standard errors";
    EXPECT_THAT(table(f, thesis()), AllOf(Not(HasSubstr("400.0")), HasSubstr("block 3 is off")));
}

TEST(Table, cases_without_a_time_share_a_line_when_they_share_a_reason) {
    ResultFile f = two_devices();
    for (const int x : {16, 32, 64, 128, 256})
        f.cases.push_back(failed_record(x, Status::skipped, "budget of 150 s"));
    f.cases.push_back(failed_record(512, Status::unsupported, "work_group 512, this kernel allows 256 here"));
    const auto section = problems_section(f);
    EXPECT_THAT(column(section, "cases"), ElementsAre("5", "1"));
    EXPECT_THAT(column(section, "which")[0],
                "gpu:0 pt 128x128 SPP 4 work-group 16; gpu:0 pt 128x128 SPP 4 work-group 32; "
                "gpu:0 pt 128x128 SPP 4 work-group 64; and 2 more");
    EXPECT_THAT(column(section, "reason")[1], "work_group 512, this kernel allows 256 here");
}

TEST(Table, devices_side_by_side_are_grouped_by_type_and_the_fastest_is_marked) {
    const auto section = devices_section(two_devices());
    EXPECT_THAT(column(section, "kernel"), ElementsAre("thesis", "thesis", "pt", "pt"));
    EXPECT_THAT(column(section, "type"), ElementsAre("CPU", "GPU", "CPU", "GPU"));
    EXPECT_THAT(column(section, "time ms"), ElementsAre("400.0", "8.000", "100.0", "4.000"));
    EXPECT_THAT(column(section, "x slowest"), ElementsAre("1.00", "50.00", "1.00", "25.00"));
    EXPECT_THAT(column(section, "speed"), ElementsAre("0.020", "1.000", "0.040", "1.000"));
    EXPECT_THAT(column(section, ""), ElementsAre("", "fastest", "", "fastest"));
    EXPECT_THAT(section.grid.best, ElementsAre(1, 3));
}

TEST(Table, a_column_of_times_has_the_unit_that_its_shortest_needs) {
    ResultFile f = two_devices();
    f.cases[3].statistics->median_ns = 4e5;
    EXPECT_THAT(column(devices_section(f), "time us"), ElementsAre("400000", "8000", "100000", "400.0"));
    for (Record& record : f.cases) record.statistics->median_ns = 2.5e9;
    EXPECT_THAT(column(devices_section(f), "time s"), ElementsAre("2.500", "2.500", "2.500", "2.500"));
}

TEST(Table, a_device_without_a_time_is_left_out_and_nobody_is_the_fastest_alone) {
    ResultFile f = two_devices();
    f.cases.pop_back();
    EXPECT_THAT(column(devices_section(f), "type"), ElementsAre("CPU", "GPU", "CPU"));
    EXPECT_THAT(column(devices_section(f), ""), ElementsAre("", "fastest", ""));
}

TEST(Table, one_device_has_nobody_beside_it) {
    ResultFile f = two_devices();
    f.cases.resize(2);
    EXPECT_THAT(devices_section(f).grid.rows, IsEmpty());
}

TEST(Table, two_equal_devices_are_told_apart) {
    ResultFile f = two_devices();
    f.devices.push_back(f.devices[1]);
    f.devices[2].key = "gpu:1";
    EXPECT_EQ(device_label(f, "gpu:1"), "[gpu:1] NVIDIA H200");
}

TEST(Table, pt_is_compared_with_thesis_on_each_device) {
    EXPECT_THAT(column(kernels_section(two_devices()), "thesis / pt"), ElementsAre("4.00x", "2.00x"));
}

TEST(Table, long_names_are_shortened_in_the_columns_of_the_terminal_only) {
    ResultFile f = two_devices();
    const std::string name = "AMD EPYC 9654 96-Core Processor with a very long name";
    f.devices[0].name = name;
    EXPECT_THAT(to_text(times_section(f)), Not(HasSubstr(name)));
    EXPECT_THAT(markdown(f, thesis()), HasSubstr("a very long name"));
}

TEST(Table, escape_codes_of_drivers_do_not_reach_the_terminal) {
    ResultFile f = two_devices();
    f.devices[0].name = "evil\x1b]0;title\x07\nname";
    f.devices[1].vendor = "\xff\xfe";
    f.cases.push_back(failed_record(8, Status::runtime, "\x1b[2J"));
    f.warnings = {"\x1b[31m"};
    f.broken_icds = {{"\x1b.icd", "\x1b"}};
    EXPECT_THAT(table(f, thesis()),
                AllOf(Not(HasSubstr("\x1b")), Not(HasSubstr("\x07")), Not(HasSubstr("\xff"))));
    EXPECT_THAT(markdown(f, thesis()), AllOf(Not(HasSubstr("\x1b")), Not(HasSubstr("\x07"))));
}

TEST(Table, what_spoils_a_run_is_remarked) {
    ResultFile f = two_devices();
    f.run.interrupted = true;
    f.warnings = {"load is 7.5"};
    f.broken_icds = {{"bad.icd", "killed by SIGSEGV (11)"}};
    f.devices[0].excluded = "the same device as gpu:0";
    EXPECT_THAT(remarks_section(f).notes, ElementsAre(HasSubstr("interrupted"), "warning: load is 7.5",
                                                      "bad.icd is not usable: killed by SIGSEGV (11)",
                                                      "pocl:0 is not used: the same device as gpu:0"));
}

TEST(Table, in_short_says_who_is_how_much_faster_and_how_sure_that_is) {
    ResultFile f = two_devices();
    EXPECT_THAT(
        summary_section(f).notes,
        ElementsAre("NVIDIA H200 (GPU) is the fastest of 2 devices: pt with 10 samples per pixel at "
                    "128x128 takes 4.000 ms.",
                    "That is 25 times as fast as pthread-FX-6300 (CPU): too few samples to say how sure "
                    "that is.",
                    "There pt is 2 times as fast as thesis: too few samples to say how sure that is.",
                    "No image was judged.", "All 4 cases ended well."));
    for (Record& record : f.cases) {
        record.statistics->ci_low_ns = 0.9 * record.statistics->median_ns;
        record.statistics->ci_high_ns = 1.2 * record.statistics->median_ns;
    }
    EXPECT_THAT(summary_section(f).notes[1], HasSubstr("18.8 to 33.3 by both medians' 95 % intervals"));
    f.cases[1].statistics->median_ns = 4.4e6;
    f.cases[1].statistics->ci_low_ns = 4e6;
    EXPECT_THAT(summary_section(f).notes[1], HasSubstr("95 % intervals do not tell apart"));
}

TEST(Table, in_short_does_not_count_how_many_times_as_fast_what_is_as_fast) {
    ResultFile f = two_devices();
    f.cases[1].statistics->median_ns = 4.004e6;
    EXPECT_THAT(summary_section(f).notes[1],
                testing::StartsWith("That is as fast as pthread-FX-6300 (CPU): "));
    f.cases[1].statistics->median_ns = 4.04e6;
    EXPECT_THAT(summary_section(f).notes[1], testing::StartsWith("That is 1.01 times as fast as "));
}

TEST(Table, in_short_counts_what_is_unstable) {
    ResultFile f = two_devices();
    f.cases[0].status = Status::unstable;
    f.cases[0].reason = "the median is known to 9.0 % only (30 samples): end other programs";
    EXPECT_THAT(
        summary_section(f).notes,
        testing::IsSupersetOf({"All 4 cases have a time.",
                               "1 of 4 cases is unstable, its time is not to be trusted: the median is "
                               "known to 9.0 % only (30 samples): end other programs."}));
    f.cases[2].status = Status::unstable;
    EXPECT_THAT(summary_section(f).notes.back(), HasSubstr("2 of 4 cases are unstable, their times are not"));
}

TEST(Table, a_clock_that_stayed_low_is_told_once) {
    ResultFile f = two_devices();
    for (Record& record : f.cases) {
        const bool low = record.params.device == "gpu:0" && record.params.kernel == "pt";
        record.samples.resize(3);
        for (TimeSample& sample : record.samples) sample.probe_ns = low ? 250'000 : 200'000;
    }
    EXPECT_THAT(
        remarks_section(f).notes,
        ElementsAre("gpu:0: its clock stayed up to 20 % below its best of this run in 1 of 2 cases, which "
                    "are timed by that clock: let it cool, or lock its clock (NVIDIA: `nvidia-smi -lgc`)"));
    f.devices[1].type = "CPU";
    EXPECT_THAT(remarks_section(f).notes, ElementsAre(HasSubstr("ptbench doctor")));
}

TEST(Table, in_short_says_which_work_group_is_the_fastest_where_none_is_implicit) {
    ResultFile f = two_devices();
    f.cases = {f.cases[3]};
    f.cases[0].params.work_group = {64, 0};
    EXPECT_EQ(
        summary_section(f).notes[0],
        "NVIDIA H200 (GPU): pt with 10 samples per pixel at 128x128 takes 4.000 ms in work-groups of 64.");
    f.cases.push_back(f.cases[0]);
    f.cases[1].params.work_group = {8, 8};
    f.cases[1].statistics->median_ns = 3e6;
    EXPECT_EQ(
        summary_section(f).notes[0],
        "NVIDIA H200 (GPU): pt with 10 samples per pixel at 128x128 takes 3.000 ms in work-groups of 8x8, "
        "the fastest of 2 sizes.");
    f.cases = {failed_record(64, Status::timeout, "slow")};
    EXPECT_EQ(summary_section(f).notes[0], "No case has a time.");
}

TEST(Table, in_short_says_what_failed_and_why) {
    ResultFile f = two_devices();
    f.cases[0].validation = Validation{};
    f.cases[0].validation->reason = "block 3 is off";
    f.cases[1].validation = Validation{};
    f.cases[1].validation->valid = true;
    f.cases.push_back(failed_record(8, Status::crash, "killed by SIGSEGV (11)"));
    EXPECT_THAT(summary_section(f).notes,
                testing::IsSupersetOf({"1 of 2 images are wrong: block 3 is off.",
                                       "1 of 5 cases have no time: 1 crash (killed by SIGSEGV (11))."}));
    f.cases.clear();
    EXPECT_THAT(summary_section(f).notes, IsEmpty());
}

TEST(Table, an_empty_result_shows_the_published_rows_alone) {
    EXPECT_THAT(table({}, thesis()), HasSubstr("Radeon R9 290X"));
    EXPECT_EQ(table({}, {}), "");
}

struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
};

TEST(Table, the_locale_changes_nothing) {
    const auto before = table(two_devices(), thesis());
    const std::locale old = std::locale::global(std::locale(std::locale::classic(), new Comma));
    const auto after = table(two_devices(), thesis());
    std::locale::global(old);
    EXPECT_EQ(after, before);
}

TEST(Table, joules_have_a_column_where_a_counter_could_be_read) {
    ResultFile f;
    f.cases = {timed_record("gpu:0", "pt", 10, 5), timed_record("gpu:0", "pt", 100, 50)};
    f.cases[0].energy = Energy{"NVML", "timed for 0.1 s", 0.1, {}, {}, 120};
    EXPECT_THAT(to_text(times_section(f)), Not(HasSubstr("samples/J")));
    f.cases[1].energy = Energy{"NVML", "", 2.5, 10, 163840, 120};
    const auto grid = times_section(f).grid;
    EXPECT_EQ(grid.columns.back().title, "ksamples/J");
    EXPECT_EQ(grid.rows[0].back(), "-");
    EXPECT_EQ(grid.rows[1].back(), "163.8");
}

TEST(Table, peaks_have_a_row_each_and_failures_say_why) {
    const Section section =
        peaks_section({{"gpu:0",
                        "",
                        {{"fma", "GFLOP/s", 65000, 64500, 65100, 12, "event", ""},
                         {"sqrt", "Groots/s", {}, {}, {}, 0, "", "wrong result: found 1, allowed: 2"}}},
                       {"gpu:1", "killed by SIGSEGV (11)", {}}});
    EXPECT_THAT(section.grid.rows,
                ElementsAre(ElementsAre("gpu:0", "fma", "65000", "GFLOP/s", "64500-65100", "event", "12", ""),
                            ElementsAre("gpu:0", "sqrt", "-", "Groots/s", "-", "", "0",
                                        "wrong result: found 1, allowed: 2")));
    EXPECT_THAT(section.notes, ElementsAre("gpu:1: killed by SIGSEGV (11)"));
}

TEST(Table, trees_have_a_row_for_each_way_of_searching_them) {
    std::vector<Record> records(4, timed_record("gpu:0", "pt", 10, 5));
    for (std::size_t i = 0; i < 3; ++i)
        records[i].tree = TreeRecord{"bvh2", 1000, 1020, 130, 300, 90'000, 7, 21.5, 3.75};
    records[2].params.variant.bvh_split = BvhSplit::sah;
    const Section uncounted = trees_section(records);
    ASSERT_EQ(uncounted.grid.rows.size(), 2u);
    EXPECT_THAT(uncounted.grid.rows[0], ElementsAre("gpu:0", "pt", "thesis", "bvh2", "spatial", "1000",
                                                    "1.020", "90.00", "7", "3.750", "21.50", "-", "-"));
    EXPECT_THAT(uncounted.notes, ElementsAre(HasSubstr("--peaks")));
    records[1].counted = Counted{};
    records[1].counted->nodes_per_ray = 12.5;
    records[1].counted->triangles_per_ray = 3.25;
    const Section counted = trees_section(records);
    EXPECT_EQ(counted.grid.rows[0][11], "12.50");
    EXPECT_EQ(counted.grid.rows[0][12], "3.250");
    EXPECT_TRUE(counted.notes.empty());
}

TEST(Table, limits_are_of_each_kernels_fastest_case) {
    std::vector<Record> records = {timed_record("gpu:0", "pt", 10, 5), timed_record("gpu:0", "pt", 100, 40),
                                   timed_record("gpu:0", "thesis", 10, 50),
                                   timed_record("gpu:1", "pt", 10, 50)};
    for (std::size_t i = 0; i < 3; ++i) records[i].counted = Counted{1000, 234.5, 10, 0, 0.125, 0.5, "", {}};
    records[0].statistics->msegments_per_s = 10;
    records[1].statistics->msegments_per_s = 12;
    records[1].counted->of_peak = {0.25, 0.5, 0.0, 0.00125, "roots", 0.5};
    records[2].counted->lanes_alive.reset();
    records[2].counted->reason = "cannot be seen";
    records[2].statistics->msegments_per_s = 2;
    const Section section = limits_section(records);
    ASSERT_EQ(section.grid.rows.size(), 2u);
    EXPECT_THAT(section.grid.rows[0],
                ElementsAre("gpu:0", "pt", "thesis", testing::_, "12.00", "234.5", "10.00", "0", "0.125",
                            "50.0 %", "25.0 %", "50.0 %", "0.0 %", "0.1 %", "roots 50.0 %"));
    EXPECT_EQ(section.grid.rows[1][9], "-");
    EXPECT_EQ(section.grid.rows[1].back(), "-");
    EXPECT_THAT(section.notes, ElementsAre("gpu:0, thesis: cannot be seen"));
}

}  // namespace
}  // namespace ptb
