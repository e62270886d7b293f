// Files of other tools, shortened from what those write.
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "bench/compare/gate_file.h"
#include "bench/compare/session.h"
#include "core/input/usage_error.h"

namespace ptb {
namespace {

struct Readers : testing::Test {
    std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / ("ptb-readers-" + std::to_string(::getpid()) + ".json");
    ~Readers() override { std::filesystem::remove(file); }
    Session read(const std::string& text) {
        std::ofstream(file) << text;
        return read_session(file);
    }
    std::string error_of(const std::string& text) {
        try {
            read(text);
        } catch (const UsageError& error) {
            return error.what();
        }
        return "no error";
    }
};

constexpr auto google = R"({
  "context": {"date": "2025-01-02T03:04:05+00:00", "host_name": "node7", "executable": "./bench", "num_cpus": 8,
              "mhz_per_cpu": 3000, "cpu_scaling_enabled": false, "caches": [], "load_avg": [0.5],
              "library_build_type": "release"},
  "benchmarks": [
    {"name": "BM_Copy/8", "family_index": 0, "run_name": "BM_Copy/8", "run_type": "iteration", "repetitions": 2,
     "repetition_index": 0, "threads": 1, "iterations": 1000, "real_time": 2.5, "cpu_time": 2.4, "time_unit": "us"},
    {"name": "BM_Copy/8", "run_name": "BM_Copy/8", "run_type": "iteration", "repetitions": 2,
     "repetition_index": 1, "iterations": 1000, "real_time": 3.5, "cpu_time": 3.4, "time_unit": "us"},
    {"name": "BM_Copy/8_mean", "run_name": "BM_Copy/8", "run_type": "aggregate", "aggregate_name": "mean",
     "aggregate_unit": "time", "iterations": 2, "real_time": 3.0, "cpu_time": 2.9, "time_unit": "us"},
    {"name": "BM_Broken", "run_name": "BM_Broken", "run_type": "iteration", "error_occurred": true,
     "error_message": "no file", "iterations": 0, "real_time": 0, "cpu_time": 0, "time_unit": "ns"}
  ]})";

TEST_F(Readers, google_benchmarks_repetitions_are_samples) {
    const Session session = read(google);
    ASSERT_EQ(session.cases.size(), 2u);
    EXPECT_EQ(session.cases[0].name, "BM_Copy/8");
    EXPECT_EQ(session.cases[0].times_ns, (std::vector<double>{2500, 3500}));
    EXPECT_EQ(session.cases[0].fingerprint[0], (Fact{"host", "node7"}));
    EXPECT_EQ(session.cases[1].no_time, "no file");
    EXPECT_EQ(session.started_at, "2025-01-02T03:04:05+00:00");
}

TEST_F(Readers, google_benchmarks_median_stands_in_where_there_are_aggregates_only) {
    const Session session = read(R"({"context": {}, "benchmarks": [
        {"name": "A_mean", "run_name": "A", "run_type": "aggregate", "aggregate_name": "mean", "real_time": 7,
         "time_unit": "ms"},
        {"name": "A_median", "run_name": "A", "run_type": "aggregate", "aggregate_name": "median", "real_time": 6,
         "time_unit": "ms"}]})");
    ASSERT_EQ(session.cases.size(), 1u);
    EXPECT_EQ(session.cases[0].times_ns, std::vector<double>{6e6});
}

/// A file of Google Benchmark with these rows.
std::string google_rows(const std::string& rows, const std::string& host = "node7") {
    return R"({"context": {"host_name": ")" + host + R"("}, "benchmarks": [)" + rows + "]}";
}

TEST_F(Readers, google_benchmarks_aggregates_stand_in_benchmark_by_benchmark) {
    const Session session = read(google_rows(R"(
        {"name": "trace_mean", "run_name": "trace", "run_type": "aggregate", "aggregate_name": "mean", "real_time": 7},
        {"name": "trace_median", "run_name": "trace", "run_type": "aggregate", "aggregate_name": "median",
         "real_time": 6},
        {"name": "sort", "run_name": "sort", "run_type": "iteration", "real_time": 50},
        {"name": "sort_BigO", "run_name": "sort", "run_type": "aggregate", "aggregate_name": "BigO", "cpu_coefficient": 2},
        {"name": "fit_BigO", "run_name": "fit", "run_type": "aggregate", "aggregate_name": "BigO", "cpu_coefficient": 2},
        {"name": "fit_RMS", "run_name": "fit", "run_type": "aggregate", "aggregate_name": "RMS", "rms": 0.1})"));
    ASSERT_EQ(session.cases.size(), 2u) << "the fit of a complexity is no benchmark";
    EXPECT_EQ(session.cases[0].times_ns, std::vector<double>{6});
    EXPECT_EQ(session.cases[1].times_ns, std::vector<double>{50});
}

TEST_F(Readers, google_benchmarks_numbers_that_json_has_no_words_for_are_read) {
    const Session session = read(google_rows(R"(
        {"name": "a \"NaN", "real_time": 5, "rays": NaN, "x": -NaN, "y": Infinity, "z": -Infinity},
        {"name": "b", "real_time": NaN})"));
    ASSERT_EQ(session.cases.size(), 2u);
    EXPECT_EQ(session.cases[0].name, "a \"NaN");
    EXPECT_EQ(session.cases[0].times_ns, std::vector<double>{5});
    EXPECT_EQ(session.cases[1].no_time, "its time is not above 0");
    EXPECT_NE(
        error_of(
            R"({"schema": "ptbench.v1", "run": {}, "host": {"load_1min": NaN}, "devices": [], "cases": []})")
            .find("not JSON"),
        std::string::npos)
        << "ptbench's own files are strict";
}

TEST_F(Readers, google_benchmarks_skipped_rows_and_times_of_0_say_why_there_is_no_time) {
    const Session session = read(google_rows(R"(
        {"name": "gpu", "real_time": 0, "skipped": true, "skip_message": "no device"},
        {"name": "disk", "real_time": 0, "error_occurred": true, "error_message": "no space"},
        {"name": "empty", "real_time": 0},
        {"name": "trace", "real_time": 9})"));
    ASSERT_EQ(session.cases.size(), 4u);
    EXPECT_EQ(session.cases[0].no_time, "no device");
    EXPECT_EQ(session.cases[1].no_time, "no space");
    EXPECT_EQ(session.cases[2].no_time, "its time is not above 0");
    EXPECT_EQ(session.cases[3].no_time, "");
}

TEST_F(Readers, google_benchmarks_names_of_before_2018_tell_aggregates) {
    const Session session = read(google_rows(R"(
        {"name": "trace", "real_time": 5}, {"name": "trace", "real_time": 6},
        {"name": "trace_mean", "real_time": 5.5}, {"name": "trace_stddev", "real_time": 0.7},
        {"name": "sort/8", "real_time": 3}, {"name": "sort_BigO", "real_time": 2}, {"name": "sort_RMS", "real_time": 1},
        {"name": "copy_mean", "real_time": 8}, {"name": "copy_stddev", "real_time": 1},
        {"name": "geometric_mean", "real_time": 4})"));
    std::vector<std::string> names;
    for (const SessionCase& c : session.cases) names.push_back(c.name);
    EXPECT_EQ(names, (std::vector<std::string>{"trace", "sort/8", "copy", "geometric_mean"}));
    EXPECT_EQ(session.cases.at(0).times_ns, (std::vector<double>{5, 6}));
    EXPECT_EQ(session.cases.at(2).times_ns, std::vector<double>{8}) << "where there is no median, the mean";
}

TEST_F(Readers, google_benchmarks_families_of_one_name_are_two_benchmarks) {
    const Session session = read(google_rows(R"(
        {"name": "trace", "family_index": 0, "per_family_instance_index": 0, "real_time": 5},
        {"name": "trace", "family_index": 0, "per_family_instance_index": 0, "real_time": 6},
        {"name": "trace", "family_index": 1, "per_family_instance_index": 0, "real_time": 90})"));
    ASSERT_EQ(session.cases.size(), 2u);
    EXPECT_EQ(session.cases[0].times_ns, (std::vector<double>{5, 6}));
    EXPECT_EQ(session.cases[1].name, "trace (2)");
    EXPECT_EQ(session.cases[1].times_ns, std::vector<double>{90});
}

TEST_F(Readers, google_benchmarks_host_may_differ_where_it_is_a_container) {
    for (const char* const host : {"9f86d081884c", "tracer-5d4f8c7b9-x2x7z"})
        EXPECT_TRUE(
            read(google_rows(R"({"name": "a", "real_time": 1})", host)).cases.at(0).fingerprint[0].may_differ)
            << host;
    for (const char* const host : {"node7", "fv-az123-456", "my-benchmark-hosts", ""})
        EXPECT_FALSE(
            read(google_rows(R"({"name": "a", "real_time": 1})", host)).cases.at(0).fingerprint[0].may_differ)
            << host;
}

constexpr auto nvbench = R"({
  "meta": {"argv": ["./bench"], "version": {"json": {"major": 1, "minor": 1, "patch": 0, "string": "1.1.0"}}},
  "devices": [{"id": 0, "name": "NVIDIA H200", "sm_version": 900, "ptx_version": 900}],
  "benchmarks": [{"name": "copy", "index": 0, "min_samples": 10, "devices": [0], "axes": [],
    "states": [
      {"name": "Device=0 Size=2^20", "min_samples": 10, "device": 0, "type_config_index": 0,
       "axis_values": [{"name": "Size", "type": "int64", "value": "1048576"}],
       "summaries": [
         {"tag": "nv/cold/sample_size", "name": "Samples", "hint": "sample_size",
          "data": [{"name": "value", "type": "int64", "value": "112"}]},
         {"tag": "nv/cold/time/gpu/mean", "name": "GPU Time", "hint": "duration",
          "data": [{"name": "value", "type": "float64", "value": "1.25e-05"}]}],
       "is_skipped": false},
      {"name": "Device=0 Size=2^40", "device": 0, "summaries": null, "is_skipped": true,
       "skip_reason": "out of memory"}]}]})";

TEST_F(Readers, nvbenchs_mean_is_the_one_sample) {
    const Session session = read(nvbench);
    ASSERT_EQ(session.cases.size(), 2u);
    EXPECT_EQ(session.cases[0].name, "copy Size=2^20");
    ASSERT_EQ(session.cases[0].times_ns.size(), 1u);
    EXPECT_NEAR(session.cases[0].times_ns[0], 12500, 1e-6);
    EXPECT_EQ(session.cases[0].fingerprint[0].value, "NVIDIA H200");
    EXPECT_EQ(session.cases[0].device_name, "NVIDIA H200");
    EXPECT_EQ(session.cases[1].no_time, "out of memory");
}

TEST_F(Readers, what_is_none_of_these_is_refused_in_one_line) {
    for (const char* const text :
         {"", "[]", "{}", "3", R"({"schema": "ptbench.v9"})", R"({"benchmarks": 3, "context": {}})",
          R"({"benchmarks": [], "context": 3})", R"({"benchmarks": [{}], "context": {}})",
          R"({"benchmarks": [{"name": "x", "real_time": 1, "time_unit": "years"}], "context": {}})",
          R"({"benchmarks": {}, "devices": []})", R"({"benchmarks": [{"name": 3}], "devices": []})"}) {
        const std::string error = error_of(text);
        EXPECT_NE(error, "no error") << text;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
        EXPECT_EQ(error.find(file.string()), 0u) << error;
    }
}

GateFile gate_file() {
    GateFile gate;
    GateCase c;
    c.base.device = c.now.device = "pocl:0";
    c.base.kernel = c.now.kernel = "pt";
    c.base.scene = c.now.scene = "thesis";
    c.base.size = c.now.size = {8, 8};
    c.timer = "event";
    const Round round{{100, 101, 102}, {200, 201, 202}};
    c.screen.assign(10, Block{{round, round, round, round}});
    gate.cases = {c};
    gate.base_records.resize(1);
    gate.now_records.resize(1);
    gate.base_records[0].params = gate.now_records[0].params = c.base;
    gate.findings = decide(gate.cases);
    return gate;
}

TEST_F(Readers, a_gate_reads_back_to_the_same_value) {
    const GateFile gate = gate_file();
    write_gate(file, gate);
    EXPECT_EQ(read_gate(file), gate);
    EXPECT_EQ(rows_of(gate).at(0).name, "pt thesis 8x8 spp 1 length 128");
}

TEST_F(Readers, a_gate_says_where_samples_are_too_long) {
    GateFile gate = gate_file();
    gate.findings[0].base_ns = 99e6;
    EXPECT_EQ(rows_of(gate).at(0).note, "");
    gate.findings[0].now_ns = 101e6;
    EXPECT_EQ(rows_of(gate).at(0).note, "samples over 100 ms: fewer spp see more");
}

TEST_F(Readers, a_gate_that_cannot_be_decided_is_refused) {
    const auto refused = [&](const auto& change) {
        GateFile gate = gate_file();
        change(gate);
        write_gate(file, gate);
        EXPECT_THROW(read_gate(file), UsageError);
    };
    refused([](GateFile& g) { g.cases[0].screen[3].rounds.pop_back(); });
    refused([](GateFile& g) { g.cases[0].screen[3].rounds[2].kernel_ns.clear(); });
    refused([](GateFile& g) { g.cases[0].screen[3].rounds[2].kernel_ns[0] = 0; });
    refused([](GateFile& g) { g.cases[0].screen.push_back(g.cases[0].screen[0]); });
    refused([](GateFile& g) { g.cases[0].timer = "sun"; });
    refused([](GateFile& g) { g.cases[0].tolerance = 0; });
    refused([](GateFile& g) { g.findings.clear(); });
    refused([](GateFile& g) { g.now_records.clear(); });
    read(google).cases.clear();
    EXPECT_THROW(read_gate(file), UsageError);
}

}  // namespace
}  // namespace ptb
