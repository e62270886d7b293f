#include "bench/report/formats/formats.h"

#include <vector>

#include <fmt/format.h>

#include "bench/report/csv.h"
#include "core/input/nearest.h"
#include "core/input/printable.h"
#include "core/input/usage_error.h"

namespace ptb {
namespace {

constexpr Format all[] = {
    {"google-benchmark", "Google Benchmark's compare.py", google_benchmark},
    {"github-action-smaller", "github-action-benchmark, customSmallerIsBetter", github_action_smaller},
    {"github-action-bigger", "github-action-benchmark, customBiggerIsBetter", github_action_bigger},
    {"bencher", "Bencher, --adapter json", bencher},
    {"go", "benchstat", go_benchmark},
    {"hyperfine", "hyperfine's scripts", hyperfine},
    {"nvbench", "nvbench_compare", nvbench},
    {"junit", "readers of JUnit XML", junit},
    {"step-summary", "$GITHUB_STEP_SUMMARY", step_summary},
    {"long-csv", "pandas, R: a row a sample", csv_samples},
};

}  // namespace

std::span<const Format> formats() { return all; }

std::vector<std::string> format_names() {
    std::vector<std::string> names;
    for (const Format& format : all) names.emplace_back(format.name);
    return names;
}

const Format& format_named(const std::string& name) {
    for (const Format& format : all)
        if (format.name == name) return format;
    const std::vector<std::string> known = format_names();
    throw UsageError(fmt::format("--format: found {}{}; allowed: {}", printable(name),
                                 did_you_mean(name, known), fmt::join(known, ", ")));
}

}  // namespace ptb
