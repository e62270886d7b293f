#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/plan/tuned.h"
#include "bench/record/status.h"
#include "bench/report/axes.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

/// Cases, by their places in the result, that differ in one axis only.
struct Sweep {
    Case rest;  ///< what they share; the axis itself is as usual
    std::vector<std::size_t> cases;
};

Case as_usual(Case c, const std::string& axis) {
    set_case_value(c, axis, case_value(default_case(), axis));
    return c;
}

/// In the order in which they begin.
std::vector<Sweep> all_sweeps(const ResultFile& result, const std::string& axis) {
    std::vector<Sweep> sweeps;
    std::map<Case, std::size_t> place;
    for (std::size_t i = 0; i < result.cases.size(); ++i) {
        const Case rest = as_usual(as_asked(result.cases[i].params), axis);
        const auto [found, added] = place.emplace(rest, sweeps.size());
        if (added) sweeps.push_back({rest, {}});
        sweeps[found->second].cases.push_back(i);
    }
    return sweeps;
}

/// Null where no case has a time.
const Record* fastest_of(const ResultFile& result, const Sweep& sweep) {
    const Record* fastest = nullptr;
    for (const std::size_t i : sweep.cases) {
        const Record& record = result.cases[i];
        if (timed(record) && (!fastest || faster(record, *fastest))) fastest = &record;
    }
    return fastest;
}

/// Lower is shown rather: few other settings changed, then many samples per pixel.
std::pair<int, int> rank(const Sweep& sweep) {
    auto axes = other_axes();
    axes.insert(axes.end(), {"work_group", "lanes"});
    return {unusual(sweep.rest, axes), -sweep.rest.spp};
}

/// Of each device, kernel and size the sweeps of the best rank.
std::vector<Sweep> shown_sweeps(const ResultFile& result, const std::string& axis) {
    using Work = std::tuple<std::string, std::string, Size>;
    const auto work = [](const Sweep& s) { return Work(s.rest.device, s.rest.kernel, s.rest.size); };
    auto sweeps = all_sweeps(result, axis);
    std::erase_if(sweeps, [&](const Sweep& s) { return s.cases.size() < 2 || !fastest_of(result, s); });
    std::map<Work, std::pair<int, int>> best;
    for (const Sweep& sweep : sweeps) {
        const auto [found, added] = best.emplace(work(sweep), rank(sweep));
        if (!added) found->second = std::min(found->second, rank(sweep));
    }
    std::erase_if(sweeps, [&](const Sweep& s) { return rank(s) > best[work(s)]; });
    return sweeps;
}

std::vector<Record> records_of(const ResultFile& result, const std::vector<Sweep>& sweeps) {
    std::vector<Record> records;
    for (const Sweep& sweep : sweeps)
        for (const std::size_t i : sweep.cases) records.push_back(result.cases[i]);
    return records;
}

std::vector<std::string> cells(const ResultFile& result, const Record& record, const Statistics& fastest,
                               const TimeUnit& unit) {
    const Case& c = record.params;
    std::vector<std::string> row = {device_label(result, c.device), c.kernel, to_string(c.size),
                                    std::to_string(c.spp)};
    const std::string outcome =
        to_string(record.status) + (record.reason.empty() ? "" : ": " + record.reason);
    if (!timed(record)) return row.insert(row.end(), {"-", "-", "0", outcome}), row;
    const double ns = record.statistics->median_ns;
    row.insert(row.end(), {unit.text(ns), fmt::format("{:.3f}", ns / fastest.median_ns),
                           fmt::format("{:.3f}", fastest.median_ns / ns),
                           record.status == Status::ok ? mark_text(record, fastest) : outcome});
    return row;
}

void append_sweep(Section& section, const ResultFile& result, const Sweep& sweep,
                  const std::vector<std::string>& axes, const TimeUnit& unit) {
    const Statistics& fastest = *fastest_of(result, sweep)->statistics;
    for (const std::size_t i : sweep.cases) {
        const Record& record = result.cases[i];
        if (timed(record) && !mark_text(record, fastest).empty())
            section.grid.best.insert(section.grid.rows.size());
        auto row = cells(result, record, fastest, unit);
        std::vector<std::string> values;
        for (const std::string& axis : axes) values.push_back(case_value(record.params, axis));
        row.insert(row.end() - 4, values.begin() + 1, values.end());
        row.insert(row.begin(), values.front());
        section.grid.rows.push_back(row);
        section.grid.cases.push_back(i);
    }
}

Section sweep_section(const ResultFile& result, const std::string& axis) {
    const auto sweeps = shown_sweeps(result, axis);
    Section section;
    if (sweeps.empty()) return section;
    auto records = records_of(result, sweeps);
    std::vector<std::string> axes = {axis};
    for (const std::string& name : axis_columns(records))
        if (name != axis) axes.push_back(name);
    for (const std::string& name : varying(records, {"lanes", "work_group"})) axes.push_back(name);
    std::erase_if(records, [](const Record& record) { return !timed(record); });
    const TimeUnit unit = unit_of(records);
    section.title = "by " + axis;
    section.grid.columns = {{axis}, {"device", false, 36}, {"kernel"}, {"size"}, {"SPP", true}};
    for (std::size_t i = 1; i < axes.size(); ++i) section.grid.columns.push_back({axes[i]});
    for (const Column& column : {Column{unit.title("time"), true}, Column{"x fastest", true},
                                 Column{"speed", false, 0, true}, Column{""}})
        section.grid.columns.push_back(column);
    for (const Sweep& sweep : sweeps) append_sweep(section, result, sweep, axes, unit);
    section.notes = {
        fmt::format(
            "x fastest: time by {0} over the shortest of cases that differ in nothing else; of each device, "
            "kernel and size those with the fewest other settings changed, at the most samples per pixel",
            axis),
        mark_note};
    return section;
}

}  // namespace

std::vector<Section> sweep_sections(const ResultFile& result) {
    std::vector<Section> sections;
    for (const std::string& axis : varying(result.cases, other_axes()))
        if (Section section = sweep_section(result, axis); !section.grid.rows.empty())
            sections.push_back(std::move(section));
    return sections;
}

}  // namespace ptb
