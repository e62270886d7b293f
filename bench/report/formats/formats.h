#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// A format of another tool, and who reads it.
struct Format {
    std::string_view name, reader;
    std::string (*write)(const ResultFile&);
};

/// All of them.
std::span<const Format> formats();
std::vector<std::string> format_names();
/// Throws UsageError with the nearest name.
const Format& format_named(const std::string& name);

// Cases without a time are left out unless said otherwise; times are of one render, by the clock that the
// record believes; flagged samples are left out as they are of the statistics.

/// Each sample is a repetition. No entries for errors: compare.py takes the geometric mean of all times.
std::string google_benchmark(const ResultFile& result);
std::string github_action_smaller(const ResultFile& result);  ///< medians
std::string github_action_bigger(const ResultFile& result);   ///< Msamples/s
std::string bencher(const ResultFile& result);                ///< latency and throughput with their intervals
std::string go_benchmark(const ResultFile& result);           ///< a line a sample
std::string hyperfine(const ResultFile& result);
std::string nvbench(const ResultFile& result);  ///< a benchmark a kernel; a case without a time is skipped
std::string junit(const ResultFile& result);    ///< every case is a test case, by its status
std::string step_summary(const ResultFile& result);  ///< Markdown, under the MiB that GitHub shows

}  // namespace ptb
