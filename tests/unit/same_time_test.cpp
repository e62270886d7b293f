#include <gmock/gmock.h>

#include "bench/compare/session.h"
#include "bench/measure/causes.h"
#include "bench/measure/statistics.h"
#include "bench/record/json.h"
#include "bench/report/csv.h"
#include "bench/report/formats/formats.h"
#include "bench/report/html/page.h"
#include "bench/report/markdown.h"
#include "bench/report/sections.h"
#include "bench/report/table.h"

namespace ptb {
namespace {

using testing::HasSubstr;
using testing::Not;

/// One case of eleven samples, of which some are flagged; its statistics are those of a run.
ResultFile run(Status status) {
    ResultFile f;
    DeviceInfo& device = f.devices.emplace_back();
    device.key = device.name = "pocl:0";
    device.vendor = "GenuineIntel";
    Record& record = f.cases.emplace_back();
    record.params = {"pocl:0", "pt", "thesis", {128, 128}, 10, 128, {}, 0};
    record.status = status;
    record.reason = status == Status::ok ? "" : "of this reason";
    record.work.emplace().samples = 163840;
    for (int i = 0; i < 11; ++i) {
        TimeSample& sample = record.samples.emplace_back();
        sample.kernel_ns = sample.host_ns = i < 5 ? 987'654'321 : 123'456'000 + 10 * i;
        sample.cause = i < 3 ? cause::busy : i < 5 ? cause::timer_fault : "";
    }
    record.statistics = describe_times(keep(record.samples, false, 1).times_ns);
    record.statistics->timer = "event";
    return f;
}

double session_median_ms(const ResultFile& f) { return session_of(f, "").cases.at(0).median_ns() / 1e6; }

TEST(SameTime, every_output_shows_the_same_time_whether_ok_or_unstable) {
    for (const Status status : {Status::ok, Status::unstable}) {
        const ResultFile f = run(status);
        EXPECT_THAT(table(f, {}), HasSubstr(" 123.5 "));
        EXPECT_THAT(to_markdown(times_section(f)), HasSubstr("| 123.5 |"));
        EXPECT_THAT(page({{f, {}}}, {}), HasSubstr("123.5 ms"));
        EXPECT_THAT(csv(f), HasSubstr(",10,123.456075,"));
        EXPECT_THAT(hyperfine(f), HasSubstr("\"median\": 0.123456"));
        EXPECT_THAT(github_action_smaller(f), HasSubstr("\"value\": 123.456"));
        EXPECT_THAT(junit(f), HasSubstr("time=\"0.123456"));
        EXPECT_THAT(step_summary(f), HasSubstr("| 123.5 |"));
        for (const auto& text : {google_benchmark(f), go_benchmark(f)})
            EXPECT_THAT(text, Not(HasSubstr("9876")));
        EXPECT_NEAR(session_median_ms(f), 123.456075, 1e-9);
    }
}

TEST(SameTime, what_people_read_has_the_word_unstable_beside_it) {
    const ResultFile f = run(Status::unstable);
    for (const auto& text :
         {table(f, {}), to_markdown(times_section(f)), page({{f, {}}}, {}), csv(f), junit(f)})
        EXPECT_THAT(text, HasSubstr("unstable"));
}

TEST(SameTime, a_vendor_has_one_name) {
    const ResultFile f = run(Status::ok);
    for (const auto& text : {table(f, {}), to_markdown(times_section(f)), csv(f)}) {
        EXPECT_THAT(text, HasSubstr("Intel"));
        EXPECT_THAT(text, Not(HasSubstr("GenuineIntel")));
    }
}

TEST(SameTime, the_hosts_clock_is_not_flawed_by_events_in_any_output) {
    ResultFile f = run(Status::ok);
    Record& record = f.cases[0];
    record.statistics = describe_times(keep(record.samples, true, 1).times_ns);
    record.statistics->timer = "host";
    EXPECT_EQ(record.statistics->n, 8);
    EXPECT_DOUBLE_EQ(session_median_ms(f), record.statistics->median_ns / 1e6);
}

}  // namespace
}  // namespace ptb
