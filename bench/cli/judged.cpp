#include "bench/cli/judged.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/cli/outputs.h"
#include "bench/cli/tell.h"
#include "bench/record/file.h"
#include "bench/report/changes.h"

namespace ptb {
namespace {

constexpr double shared_tolerance = 0.05, dedicated_tolerance = 0.02;

std::optional<double> percent_flag(const std::string& flag, const std::string& text) {
    if (text.empty()) return std::nullopt;
    try {
        return parse_percent(text);
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("{}: {}", flag, error.what()));
    }
}

std::string name_of(const GateSide& side) {
    const std::string kernels = side.kernel_dir.empty() ? "" : ", kernels of " + side.kernel_dir;
    return fmt::format("{}, config {}{}", side.binary, side.config, kernels);
}

}  // namespace

Tolerances tolerances_of(const JudgeFlags& flags, const Config& config) {
    return {config, percent_flag("--tolerance", flags.tolerance),
            flags.profile == "dedicated" ? dedicated_tolerance : shared_tolerance};
}

Rules rules_of(const JudgeFlags& flags, const std::vector<double>& tolerances) {
    Rules rules{percent_flag("--require-mde", flags.require_mde).value_or(0), flags.strict,
                flags.allow_missing};
    const double most = tolerances.empty() ? 0 : *std::max_element(tolerances.begin(), tolerances.end());
    if (rules.require_mde > 0 && rules.require_mde <= most)
        throw UsageError(fmt::format("--require-mde: found {}; allowed: more than the tolerance of {}",
                                     percent_text(rules.require_mde), percent_text(most)));
    return rules;
}

void add_change(Outcome& outcome, const Change& change) {
    outcome.regressed |= change.regressed;
    outcome.inconclusive |= change.inconclusive;
    outcome.coverage_lost |= change.coverage_lost;
    outcome.not_comparable |= change.nothing_compared;
}

Outcome outcome_of(const GateFile& gate) {
    auto records = gate.base_records;
    records.insert(records.end(), gate.now_records.begin(), gate.now_records.end());
    Outcome outcome = outcome_of(records);
    outcome.interrupted = gate.run.interrupted;
    add_change(outcome, change_of(rows_of(gate), gate.rules));
    return outcome;
}

std::string title_of(const GateFile& gate) {
    if (gate.base == gate.now) return "A/A, both sides are " + name_of(gate.base);
    return fmt::format("base: {}; new: {}", name_of(gate.base), name_of(gate.now));
}

void add_comparison(Outcome& outcome, const Comparison& comparison, const JudgeFlags& flags) {
    std::vector<double> tolerances;
    for (const Row& row : comparison.rows) tolerances.push_back(row.tolerance);
    add_change(outcome, change_of(comparison.rows, rules_of(flags, tolerances)));
}

void show_comparison(const Comparison& comparison, const std::string& title, const JudgeFlags& flags,
                     std::FILE* out) {
    for (const std::string& field : comparison.differing)
        put(stderr, fmt::format("not comparable: {}{}\n", field,
                                comparison.rows.empty() ? "; --allow-cross shows ratios" : ""));
    for (const std::string& field : comparison.notes) put(stderr, fmt::format("note: {}\n", field));
    const std::string json = comparison_text(comparison);
    if (flags.json == "-") put(stdout, json);
    if (!flags.json.empty() && flags.json != "-") write_file(flags.json, json);
    if (!comparison.rows.empty()) show_rows(comparison.rows, title, flags, out);
    write_page({comparison.rows, title, {comparison.differing.begin(), comparison.differing.end()}, json},
               flags);
}

void write_page(const ComparedPage& compared, const JudgeFlags& flags) {
    if (flags.html == "-") put(stdout, compared_page(compared));
    if (!flags.html.empty() && flags.html != "-") write_file(flags.html, compared_page(compared));
}

void check_outputs(const JudgeFlags& flags) {
    const int taking_stdout = (flags.json == "-") + (flags.md == "-") + (flags.html == "-");
    if (taking_stdout > 1) throw UsageError("only one of --json, --md and --html can write to stdout (-)");
    for (const auto& [flag, file] :
         {std::pair("--json", flags.json), std::pair("--md", flags.md), std::pair("--html", flags.html)})
        if (!file.empty() && file != "-") check_writable(flag, file);
}

void show_rows(const std::vector<Row>& rows, const std::string& title, const JudgeFlags& flags,
               std::FILE* out) {
    const Section section = changes_section(rows, title);
    put(out, to_text(section));
    if (flags.md == "-") put(stdout, to_markdown(section));
    if (!flags.md.empty() && flags.md != "-") write_file(flags.md, to_markdown(section));
}

std::FILE* table_stream(const JudgeFlags& flags) {
    return flags.json == "-" || flags.md == "-" || flags.html == "-" ? stderr : stdout;
}

}  // namespace ptb
