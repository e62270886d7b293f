#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/report/axes.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

/// What cases may differ in beyond the columns that are always there.
std::vector<std::string> optional_axes(const std::vector<Record>& records) {
    auto axes = axis_columns(records);
    for (const std::string& axis : varying(records, {"lanes"})) axes.push_back(axis);
    return axes;
}

/// Works in the order in which they first come.
std::vector<Case> works_of(const std::vector<Record>& records) {
    std::vector<Case> works;
    std::set<Case> seen;
    for (const Record& record : records)
        if (const Case work = without_device(record.params); seen.insert(work).second) works.push_back(work);
    return works;
}

using Times = std::map<Case, double>;  ///< ns

Times times_of(const std::vector<Record>& records) {
    Times times;
    for (const Record& record : records) times[record.params] = record.statistics->median_ns;
    return times;
}

std::optional<double> time_of(const Times& times, const Case& c) {
    const auto found = times.find(c);
    return found == times.end() ? std::nullopt : std::optional(found->second);
}

std::size_t varying_devices(const std::vector<Record>& records) {
    std::set<std::string> keys;
    for (const Record& record : records) keys.insert(record.params.device);
    return keys.size();
}

/// CPUs before GPUs, the faster first.
void group_by_type(const ResultFile& result, std::vector<Record>& same) {
    const auto place = [&](const Record& r) {
        return std::pair(device_of(result, r.params.device).type, r.statistics->median_ns);
    };
    std::stable_sort(same.begin(), same.end(),
                     [&](const Record& a, const Record& b) { return place(a) < place(b); });
}

void append_axes(std::vector<std::string>& cells, const Case& c, const std::vector<std::string>& axes) {
    for (const auto& axis : axes) cells.push_back(case_value(c, axis));
}

void append_work(Grid& grid, const ResultFile& result, const std::vector<Record>& same,
                 const std::vector<std::string>& axes, const TimeUnit& unit) {
    const auto [fast, slow] = std::minmax_element(same.begin(), same.end(), faster);
    const Statistics& fastest = *fast->statistics;
    const double slowest = slow->statistics->median_ns;
    for (const Record& record : same) {
        const Case& c = record.params;
        const double ns = record.statistics->median_ns;
        const std::string mark = same.size() > 1 ? mark_text(record, fastest) : "";
        if (!mark.empty()) grid.best.insert(grid.rows.size());
        auto& row = grid.rows.emplace_back(
            std::vector<std::string>{c.kernel, to_string(c.size), std::to_string(c.spp)});
        append_axes(row, c, axes);
        for (const std::string& cell :
             {device_of(result, c.device).type, device_label(result, c.device), unit.text(ns),
              fmt::format("{:.2f}", slowest / ns), fmt::format("{:.3f}", fastest.median_ns / ns), mark})
            row.push_back(cell);
    }
}

}  // namespace

Section devices_section(const ResultFile& result) {
    const auto records = comparable(result);
    const auto axes = optional_axes(records);
    if (varying_devices(records) < 2) return {};
    const TimeUnit unit = unit_of(records);
    Section section;
    section.title = "devices side by side";
    section.grid.columns = {{"kernel"}, {"size"}, {"SPP", true}};
    for (const auto& axis : axes) section.grid.columns.push_back({axis});
    for (const Column& column :
         {Column{"type"}, Column{"device", false, 36}, Column{unit.title("time"), true},
          Column{"x slowest", true}, Column{"speed", false, 0, true}, Column{""}})
        section.grid.columns.push_back(column);
    auto works = by_work(records);
    for (const Case& work : works_of(records)) {
        group_by_type(result, works[work]);
        append_work(section.grid, result, works[work], axes, unit);
    }
    section.notes = {"x slowest: times as fast as the slowest device at the same work; implicit work-groups",
                     mark_note};
    return section;
}

Section kernels_section(const ResultFile& result) {
    const auto records = comparable(result);
    const auto axes = optional_axes(records);
    const Times times = times_of(records);
    Section section;
    const TimeUnit unit = unit_of(records);
    section.title = "pt against thesis";
    section.grid.columns = {{"type"},
                            {"device", false, 36},
                            {"size"},
                            {"SPP", true},
                            {unit.title("thesis"), true},
                            {unit.title("pt"), true},
                            {"thesis / pt", true}};
    for (const auto& axis : axes) section.grid.columns.push_back({axis});
    for (const Record& record : records) {
        Case c = record.params;
        if (c.kernel != "thesis") continue;
        c.kernel = "pt";
        const auto pt = time_of(times, c);
        if (!pt) continue;
        const double thesis = record.statistics->median_ns;
        auto& row = section.grid.rows.emplace_back(std::vector<std::string>{
            device_of(result, c.device).type, device_label(result, c.device), to_string(c.size),
            std::to_string(c.spp), unit.text(thesis), unit.text(*pt), fmt::format("{:.2f}x", thesis / *pt)});
        append_axes(row, c, axes);
    }
    return section;
}

}  // namespace ptb
