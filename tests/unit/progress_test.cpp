#include "bench/worker/progress.h"

#include <gtest/gtest.h>

namespace ptb {
namespace {

Case make_case(int spp = 100) {
    Case c;
    c.device = "pocl:0";
    c.kernel = "pt";
    c.scene = "thesis";
    c.size = {100, 100};
    c.spp = spp;
    c.work_group = {16, 16};
    return c;
}

Record ok_record(double median_ns) {
    Record record;
    record.params = make_case();
    record.status = Status::ok;
    record.statistics.emplace();
    record.statistics->median_ns = median_ns;
    return record;
}

std::string printed(ProgressStyle style) {
    char text[512] = {};
    std::FILE* const out = ::fmemopen(text, sizeof text, "w");
    RunPlan plan;
    plan.cases = {make_case()};
    ProgressPrinter printer(out, style, plan, Forecast(plan.measure), false, [] { return 0.0; });
    printer.started(0, plan.cases[0]);
    printer.finished(0, ok_record(412e6));
    std::fclose(out);
    return text;
}

TEST(progress, the_live_line_tells_case_stage_and_what_is_left) {
    EXPECT_EQ(live_line({17, 48, make_case(), "sample", 0.4, 70}, 80),
              "[17/48] pocl:0  pt spp 100 16x16   sample 40 %   ETA 1:10");
    EXPECT_EQ(live_line({1, 1, make_case(), "", 0, std::nullopt}, 80), "[1/1] pocl:0  pt spp 100 16x16");
}

TEST(progress, the_live_line_never_wraps) {
    EXPECT_EQ(live_line({17, 48, make_case(), "sample", 0.4, 70}, 20).size(), 20U);
}

TEST(progress, a_finished_case_shows_its_time_and_spread) {
    Record record = ok_record(412e6);
    EXPECT_EQ(finished_line(17, 48, record), "[17/48] pocl:0  pt spp 100 16x16   412 ms");
    record.statistics->ci_low_ns = 410.4e6;
    record.statistics->ci_high_ns = 413.6e6;
    EXPECT_EQ(finished_line(17, 48, record), "[17/48] pocl:0  pt spp 100 16x16   412 ms +- 0.4 %");
}

TEST(progress, a_case_that_failed_shows_why_and_no_time) {
    Record record = ok_record(412e6);
    record.status = Status::invalid;
    record.reason = "image too dark";
    EXPECT_EQ(finished_line(1, 2, record), "[1/2] pocl:0  pt spp 100 16x16   invalid: image too dark");
}

TEST(progress, times_have_three_digits_and_a_unit) {
    EXPECT_EQ(time_text(412e6), "412 ms");
    EXPECT_EQ(time_text(41.23e6), "41.2 ms");
    EXPECT_EQ(time_text(4.123e9), "4.12 s");
    EXPECT_EQ(time_text(999.9e3), "1.00 ms");
    EXPECT_EQ(time_text(12345e9), "12345 s");
}

TEST(progress, remaining_time_reads_like_a_clock) {
    EXPECT_EQ(eta_text(70), "1:10");
    EXPECT_EQ(eta_text(5), "0:05");
    EXPECT_EQ(eta_text(7500), "2:05:00");
    EXPECT_EQ(eta_text(-3), "0:00");
}

TEST(progress, the_rest_takes_its_forecast_plus_the_overhead_seen) {
    Forecast forecast(MeasureOptions{});
    forecast.learn(make_case(), 1000);  // 10 us a sample per pixel of the whole image: 1 s for 100 spp
    Eta eta({make_case(), make_case(), make_case()}, forecast);
    EXPECT_NEAR(eta.left_s(0), 3 * (5 + 10), 1e-9) << "warm-up and samples";
    eta.finished(0, 17);
    EXPECT_NEAR(eta.left_s(1), 2 * 17, 1e-9);
}

TEST(progress, only_a_terminal_gets_control_characters) {
    EXPECT_EQ(printed(ProgressStyle::silent), "");
    EXPECT_EQ(printed(ProgressStyle::lines), "[1/1] pocl:0  pt spp 100 16x16   412 ms\n");
    EXPECT_EQ(printed(ProgressStyle::live).substr(0, 1), "\r");
}

TEST(progress, only_what_failed_is_coloured) {
    EXPECT_EQ(coloured("line", Status::ok), "line");
    EXPECT_EQ(coloured("line", Status::skipped), "line");
    EXPECT_EQ(coloured("line", Status::crash), "\033[31mline\033[0m");
}

TEST(forecast, a_case_takes_warmup_and_samples) {
    MeasureOptions options;
    options.warmup = 1;
    Forecast forecast(options), steady(MeasureOptions{});
    forecast.learn(make_case(), 1000);
    steady.learn(make_case(), 100);
    EXPECT_NEAR(forecast.sample_s(make_case()).value(), 1, 1e-9);
    EXPECT_NEAR(forecast.case_s(make_case()).value(), 1 + 10, 1e-9);
    EXPECT_NEAR(steady.case_s(make_case()).value(), 0.1 * (6 + 10), 1e-9) << "two windows of three warm up";
}

TEST(forecast, max_time_stops_further_samples_but_one_is_taken) {
    Forecast forecast(MeasureOptions{});
    forecast.learn(make_case(), 1000);
    EXPECT_NEAR(forecast.case_s(make_case(250)).value(), 2.5 * (2 + 10), 1e-9);
    EXPECT_NEAR(forecast.case_s(make_case(1400)).value(), 14 * 2, 1e-9) << "long samples have no warm-up";
    EXPECT_NEAR(forecast.case_s(make_case(10000)).value(), 100 * 1, 1e-9);
}

TEST(forecast, nothing_is_predicted_for_what_was_not_measured) {
    EXPECT_FALSE(Forecast(MeasureOptions{}).case_s(make_case()));
    EXPECT_EQ(prediction_text(Forecast(MeasureOptions{}), {make_case()}, 0), "");
}

TEST(forecast, the_prediction_names_the_longest_sample_and_the_budget) {
    Forecast forecast(MeasureOptions{});
    forecast.learn(make_case(), 1000);
    EXPECT_EQ(prediction_text(forecast, {make_case(100), make_case(200)}, 0),
              "predicted: 41 s (longest sample: pt on pocl:0, spp 200: 2.0 s)");
    EXPECT_EQ(prediction_text(forecast, {make_case(100), make_case(200)}, 10),
              "predicted: 41 s, cut to the budget of 10 s (longest sample: pt on pocl:0, spp 200: 2.0 s)");
}

TEST(forecast, durations_read_aloud) {
    EXPECT_EQ(duration_text(0.42), "0.4 s");
    EXPECT_EQ(duration_text(12.4), "12 s");
    EXPECT_EQ(duration_text(200), "3 min 20 s");
    EXPECT_EQ(duration_text(2040), "34 min");
    EXPECT_EQ(duration_text(7500), "2 h 5 min");
}

}  // namespace
}  // namespace ptb
