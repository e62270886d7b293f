#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "bench/plan/tuned.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

const std::vector<std::string> optional_axes = {"scene", "path_length", "lanes"};

/// Timed records with implicit work-groups: those that every device can be compared in.
std::vector<Record> comparable(const ResultFile& result) {
    std::vector<Record> records;
    for (Record record : result.cases) {
        record.params = as_asked(record.params);
        if (timed(record) && record.params.work_group.implicit()) records.push_back(record);
    }
    return records;
}

/// The work that is compared: the case without what distinguishes the compared ones.
Case without_device(Case c) {
    c.device.clear();
    return c;
}

/// Keys in the order in which they first come.
template <class Key>
std::vector<Case> distinct(const std::vector<Record>& records, Key key) {
    std::vector<Case> cases;
    for (const Record& record : records)
        if (const Case c = key(record.params); std::find(cases.begin(), cases.end(), c) == cases.end())
            cases.push_back(c);
    return cases;
}

std::vector<std::string> device_keys(const std::vector<Record>& records) {
    std::vector<std::string> keys;
    for (const Record& record : records)
        if (std::find(keys.begin(), keys.end(), record.params.device) == keys.end())
            keys.push_back(record.params.device);
    return keys;
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

/// Cells of the compared work on each device: "12.34 (2.1x)", "-" where it has no time.
std::vector<std::string> device_cells(const Times& times, Case work, const std::vector<std::string>& keys) {
    std::vector<std::optional<double>> ns;
    double slowest = 0;
    for (const auto& key : keys) {
        work.device = key;
        ns.push_back(time_of(times, work));
        slowest = std::max(slowest, ns.back().value_or(0));
    }
    std::vector<std::string> cells;
    for (const auto& time : ns)
        cells.push_back(time ? fmt::format("{} ({:.2f}x)", number_text(ms(*time)), slowest / *time) : "-");
    return cells;
}

void append_axes(std::vector<std::string>& cells, const Case& c, const std::vector<std::string>& axes) {
    for (const auto& axis : axes) cells.push_back(case_value(c, axis));
}

}  // namespace

Section devices_section(const ResultFile& result) {
    const auto records = comparable(result);
    const auto keys = device_keys(records);
    const auto axes = varying(records, optional_axes);
    if (keys.size() < 2) return {};
    Section section;
    section.title = "devices side by side, ms";
    section.grid.columns = {{"kernel"}, {"size"}, {"SPP", true}};
    for (const auto& axis : axes) section.grid.columns.push_back({axis});
    for (const auto& key : keys)
        section.grid.columns.push_back(
            {device_of(result, key).type + " " + device_label(result, key), true, 28});
    const Times times = times_of(records);
    for (const Case& work : distinct(records, without_device)) {
        auto& row = section.grid.rows.emplace_back(
            std::vector<std::string>{work.kernel, to_string(work.size), std::to_string(work.spp)});
        append_axes(row, work, axes);
        for (auto& cell : device_cells(times, work, keys)) row.push_back(std::move(cell));
    }
    section.notes = {"x: times as fast as the slowest device of the row; implicit work-groups"};
    return section;
}

Section kernels_section(const ResultFile& result) {
    const auto records = comparable(result);
    const auto axes = varying(records, optional_axes);
    const Times times = times_of(records);
    Section section;
    section.title = "pt against thesis";
    section.grid.columns = {
        {"type"},        {"device", false, 36}, {"size"}, {"SPP", true}, {"thesis ms", true},
        {"pt ms", true}, {"thesis / pt", true}};
    for (const auto& axis : axes) section.grid.columns.push_back({axis});
    for (const Record& record : records) {
        Case c = record.params;
        if (c.kernel != "thesis") continue;
        c.kernel = "pt";
        const auto pt = time_of(times, c);
        if (!pt) continue;
        const double thesis = record.statistics->median_ns;
        auto& row = section.grid.rows.emplace_back(
            std::vector<std::string>{device_of(result, c.device).type, device_label(result, c.device),
                                     to_string(c.size), std::to_string(c.spp), number_text(ms(thesis)),
                                     number_text(ms(*pt)), fmt::format("{:.2f}x", thesis / *pt)});
        append_axes(row, c, axes);
    }
    return section;
}

}  // namespace ptb
