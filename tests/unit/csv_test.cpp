#include "bench/report/csv.h"

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>

namespace ptb {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

ResultFile one_case() {
    ResultFile f;
    DeviceInfo d;
    d.key = "pocl:0";
    d.vendor = "GenuineIntel";
    d.type = "CPU";
    d.name = "pthread";
    f.devices = {d};
    Record r;
    r.params = {"pocl:0", "pt", "thesis", {640, 480}, 10, 128, {16, 16}, 8};
    r.status = Status::ok;
    r.statistics = Statistics{};
    r.statistics->n = 3;
    r.statistics->median_ns = 1'234'567.5;
    r.samples = {{1'234'567, 1'234'567, 1'300'000, 5, 6, 7, ""}};
    f.cases = {r};
    return f;
}

std::string second_line(const std::string& text) {
    const auto start = text.find('\n') + 1;
    return text.substr(start, text.find('\n', start) - start);
}

TEST(Csv, the_thesis_columns_come_first) {
    EXPECT_THAT(csv(one_case()),
                StartsWith("vendor,type,device,spp,time_ms,kernel,scene,width,height,path_length,"
                           "work_group,lanes,status,reason,n,flagged,median_ms,"));
    EXPECT_THAT(second_line(csv(one_case())),
                StartsWith("Intel,CPU,pthread,10,1.234568,pt,thesis,640,480,128,16x16,8,ok,,3,0,1.234568,"));
}

TEST(Csv, noise_and_efficiency_come_last) {
    ResultFile f = one_case();
    EXPECT_THAT(second_line(csv(f)), testing::EndsWith(",,,,,,,,,,"));
    f.cases[0].efficiency =
        Efficiency{Noise{0.25, 0.0125, 40, 36.5, 44}, Noise{1.25e-7, 0, {}, {}, {}}, "film", ""};
    EXPECT_THAT(csv(f),
                HasSubstr(",rel_mse,rel_mse_error,efficiency,efficiency_low,efficiency_high,rel_mse_best_99,"
                          "rel_mse_error_best_99,efficiency_best_99,efficiency_low_best_99,"
                          "efficiency_high_best_99\n"));
    EXPECT_THAT(second_line(csv(f)), testing::EndsWith(",0.25,0.0125,40,36.5,44,1.25e-07,0,,,"));
}

TEST(Csv, shadow_rays_stand_beside_segments) {
    ResultFile f = one_case();
    EXPECT_THAT(csv(f), AllOf(HasSubstr(",segments,shadow_rays,light_segments,"),
                              HasSubstr(",msegments_per_s,mrays_per_s,")));
    f.cases[0].work = Work{};
    f.cases[0].work->segments = 5000;
    f.cases[0].statistics->msegments_per_s = 16;
    EXPECT_THAT(second_line(csv(f)), AllOf(HasSubstr(",16.000000,,"), HasSubstr(",5000,0,0,")));
    f.cases[0].work->shadow_rays = 300;
    f.cases[0].work->light_segments = 40;
    f.cases[0].statistics->mrays_per_s = 22;
    EXPECT_THAT(second_line(csv(f)), AllOf(HasSubstr(",16.000000,22.000000,"), HasSubstr(",5000,300,40,")));
}

TEST(Csv, commas_and_quotes_are_quoted) {
    ResultFile f = one_case();
    f.devices[0].name = R"(Intel(R) "Core", fast)";
    EXPECT_THAT(second_line(csv(f)), StartsWith(R"(Intel,CPU,"Intel(R) ""Core"", fast",10,)"));
}

TEST(Csv, formulas_and_control_characters_are_defused) {
    ResultFile f = one_case();
    f.devices[0].name = "=HYPERLINK(1)";
    f.devices[0].vendor = "@a\nb";
    f.cases[0].reason = "-1+1";
    EXPECT_THAT(second_line(csv(f)),
                AllOf(StartsWith("'@a b,CPU,'=HYPERLINK(1),10,"), HasSubstr(",ok,'-1+1,")));
}

TEST(Csv, an_unstable_case_has_its_time_and_says_so_and_others_have_none) {
    ResultFile f = one_case();
    f.cases[0].status = Status::unstable;
    f.cases[0].reason = "half of the samples are flagged";
    EXPECT_THAT(second_line(csv(f)), AllOf(StartsWith("Intel,CPU,pthread,10,1.234568,pt,"),
                                           HasSubstr(",unstable,half of the samples are flagged,")));
    f.cases[0].statistics.reset();
    f.cases[0].status = Status::ok;
    EXPECT_THAT(second_line(csv(f)), StartsWith("Intel,CPU,pthread,10,,pt,"));
}

TEST(Csv, numbers_that_are_not_finite_are_empty) {
    ResultFile f = one_case();
    f.cases[0].statistics->median_ns = std::numeric_limits<double>::quiet_NaN();
    f.cases[0].statistics->msamples_per_s = std::numeric_limits<double>::infinity();
    EXPECT_THAT(csv(f), AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
}

TEST(Csv, every_line_has_as_many_cells_as_the_header) {
    const auto text = csv(one_case());
    const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
    EXPECT_EQ(commas(second_line(text)), commas(text.substr(0, text.find('\n'))));
    const auto samples = csv_samples(one_case());
    EXPECT_EQ(commas(second_line(samples)), commas(samples.substr(0, samples.find('\n'))));
}

TEST(Csv, samples_are_integer_nanoseconds) {
    EXPECT_THAT(second_line(csv_samples(one_case())), HasSubstr(",0,1234567,1234567,1300000,5,6,"));
}

TEST(Csv, joules_are_empty_where_they_could_not_be_read) {
    ResultFile f = one_case();
    f.cases[0].energy = Energy{"NVML", "timed for 0.1 s", 0.1, {}, {}, {}};
    EXPECT_THAT(second_line(csv(f)), HasSubstr(",,,," + f.cases[0].params.device));
    f.cases[0].energy = Energy{"NVML", "", 2.5, 0.5, 163840, 120};
    EXPECT_THAT(csv(f), HasSubstr(",joules,samples_per_joule,idle_w,"));
    EXPECT_THAT(second_line(csv(f)), HasSubstr(",0.500000,163840.000000,120.000000,"));
}

TEST(Csv, trees_are_empty_where_there_are_none) {
    ResultFile f = one_case();
    EXPECT_THAT(csv(f),
                HasSubstr(",nodes_per_ray,triangles_per_ray,tree_layout,tree_triangles,tree_references,"
                          "tree_nodes,tree_leaves,tree_bytes,tree_depth,tree_sah_cost,tree_build_ms,"));
    f.cases[0].tree = TreeRecord{"wide8", 1000, 1020, 130, 300, 90'000, 7, 21.5, 3.75};
    EXPECT_THAT(second_line(csv(f)), HasSubstr(",,,wide8,1000,1020,130,300,90000,7,21.5,3.750000,"));
}

TEST(Csv, counts_and_shares_are_empty_where_there_are_none) {
    ResultFile f = one_case();
    EXPECT_THAT(second_line(csv(f)), HasSubstr(",,,,,,,,,,,,," + f.cases[0].params.device));
    f.cases[0].counted = Counted{1000, 234.5, 10, 0, 0.125, {}, "", {0.25, 0.5, {}, 0.001, "roots", 0.5}};
    EXPECT_THAT(csv(f), HasSubstr(",flops_per_segment,roots_per_segment,divisions_per_segment,"
                                  "bytes_per_segment,lanes_alive,of_peak_fma,of_peak_sqrt,of_peak_division,"
                                  "of_peak_global,limit,"));
    EXPECT_THAT(second_line(csv(f)),
                HasSubstr(",234.500000,10.000000,0.000000,0.125000,,0.250000,0.500000,,0.001000,roots,"));
}

}  // namespace
}  // namespace ptb
