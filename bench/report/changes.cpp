#include "bench/report/changes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "bench/report/words.h"

namespace ptb {
namespace {

std::string time_ms(double ns) { return ns > 0 ? number_text(ms(ns)) : "-"; }

std::string percent(double share) {
    return std::isfinite(share) ? fmt::format("{:.1f} %", 100 * share) : "-";
}

std::string joined(const std::string& one, const std::string& other) {
    return one.empty() || other.empty() ? one + other : one + "; " + other;
}

std::vector<std::string> cells(const Row& row) {
    const Finding& f = row.finding;
    const bool compared = row.compared();
    return {row.device,
            row.name,
            time_ms(f.base_ns),
            time_ms(f.now_ns),
            compared ? ratio_of_shift(f.evidence.shift.value) : "-",
            compared ? interval_of_shift(f.evidence.shift.interval) : "-",
            compared ? fmt::format("{:.2g}", f.evidence.holm_p) : "-",
            compared ? std::to_string(f.n) : "-",
            percent(row.tolerance),
            compared ? percent(f.smallest_effect) : "-",
            to_string(f.state),
            joined(row.advisory, row.note)};
}

std::string summary(const std::vector<Row>& rows) {
    std::map<State, int> count;
    for (const Row& row : rows) ++count[row.finding.state];
    std::vector<std::string> parts;
    for (const auto& [state, cases] : count) parts.push_back(fmt::format("{} {}", cases, to_string(state)));
    return fmt::format("{} cases: {}", rows.size(), fmt::join(parts, ", "));
}

/// A last column, where there is anything to show in it.
void append_efficiency(Section& section, const std::vector<Row>& rows) {
    if (std::none_of(rows.begin(), rows.end(),
                     [](const Row& row) { return row.efficiency_ratio.has_value(); }))
        return;
    section.grid.columns.push_back({"efficiency", true});
    for (std::size_t i = 0; i < rows.size(); ++i)
        section.grid.rows[i].push_back(
            rows[i].efficiency_ratio ? fmt::format("{:.3f}", *rows[i].efficiency_ratio) : "-");
    section.notes.emplace_back("efficiency: new / base of 1 / (relMSE x s); above 1 is better");
}

}  // namespace

std::string ratio_of_shift(double shift) { return fmt::format("{:.3f}", std::exp(shift)); }

std::string interval_of_shift(const std::optional<Interval>& interval) {
    if (!interval) return "-";
    return fmt::format("{}-{}", ratio_of_shift(interval->low), ratio_of_shift(interval->high));
}

Section changes_section(const std::vector<Row>& rows, const std::string& title) {
    Section section;
    section.title = title;
    section.grid.columns = {{"device", false, 24}, {"case", false, 0},  {"base ms", true, 0},
                            {"new ms", true, 0},   {"ratio", true, 0},  {"95 %", true, 0},
                            {"p", true, 0},        {"n", true, 0},      {"tolerance", true, 0},
                            {"can see", true, 0},  {"state", false, 0}, {"note", false, 60}};
    for (const Row& row : rows) section.grid.rows.push_back(cells(row));
    section.notes.push_back(summary(rows));
    section.notes.emplace_back(
        "ratio: new time / base time; p: after Holm; can see: the smallest change seen in 8 of 10 such runs");
    append_efficiency(section, rows);
    return section;
}

}  // namespace ptb
