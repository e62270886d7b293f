#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/record/status.h"
#include "bench/report/axes.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

bool shown(const Record& record) { return record.status == Status::ok || timed(record); }

/// What is unusual about a row: "timer: host", "unstable: ...", "low n".
std::string note(const Record& record) {
    std::vector<std::string> parts;
    if (record.status != Status::ok) parts.push_back(to_string(record.status) + ": " + record.reason);
    if (!record.statistics) parts.push_back("validated only");
    if (record.statistics && record.statistics->timer == "host")
        parts.push_back(fmt::format("timer: host ({})", record.statistics->timer_reason));
    if (record.statistics && record.statistics->stop_reason == "low_n") parts.push_back("low n");
    if (record.statistics && record.work && record.work->overlap)
        parts.push_back(fmt::format("launches overlapped {:.0f} %", 100 * *record.work->overlap));
    if (record.statistics && record.status == Status::ok && record.statistics->flagged > 0)
        parts.push_back(fmt::format("{} flagged", record.statistics->flagged));
    return fmt::format("{}", fmt::join(parts, ", "));
}

bool any_joules(const std::vector<Record>& records) {
    return std::any_of(records.begin(), records.end(),
                       [](const Record& record) { return record.energy && record.energy->joules; });
}

bool any_listed(const std::vector<Record>& records) {
    return std::any_of(records.begin(), records.end(),
                       [](const Record& record) { return record.work && record.work->listed_rays > 0; });
}

std::string mrays_per_s(const Record& record) {
    const auto& s = record.statistics;
    return s && s->mrays_per_s ? number_text(*s->mrays_per_s) : "-";
}

std::string samples_per_joule(const Record& record) {
    const auto& energy = record.energy;
    return energy && energy->samples_per_joule ? number_text(*energy->samples_per_joule / 1e3) : "-";
}

bool any_note(const std::vector<Record>& records) {
    for (const Record& record : records)
        if (!note(record).empty()) return true;
    return false;
}

std::vector<std::string> cells(const ResultFile& result, const Record& record) {
    const DeviceInfo device = device_of(result, record.params.device);
    const auto& s = record.statistics;
    return {vendor_name(device),
            device.type,
            device_label(result, device.key),
            std::to_string(record.params.spp),
            s ? number_text(ms(s->median_ns)) : "-",
            record.params.kernel,
            to_string(record.params.size),
            to_string(record.params.work_group),
            record.work ? std::to_string(record.work->lanes) : case_value(record.params, "lanes"),
            s ? spread_text(*s) : "-",
            s ? number_text(s->msamples_per_s) : "-",
            s ? number_text(s->msegments_per_s) : "-"};
}

/// The axes that have no column of their own because they are the same everywhere.
std::string constants(const std::vector<Record>& records, const std::vector<std::string>& shown) {
    std::string text;
    for (const auto& [axis, words] : {std::pair("scene", "scene"), std::pair("path_length", "path length")}) {
        const bool column = std::find(shown.begin(), shown.end(), axis) != shown.end();
        if (!column) text += fmt::format(", {} {}", words, case_value(records.front().params, axis));
    }
    return text;
}

}  // namespace

std::vector<Record> shown_records(const ResultFile& result) {
    std::vector<Record> records;
    std::copy_if(result.cases.begin(), result.cases.end(), std::back_inserter(records), shown);
    return records;
}

Section times_section(const ResultFile& result) {
    return times_section(result, axis_columns(shown_records(result)));
}

Section times_section(const ResultFile& result, const std::vector<std::string>& axes) {
    const auto records = shown_records(result);
    if (records.empty()) return {};
    const bool notes = any_note(records), joules = any_joules(records), rays = any_listed(records);
    Section section;
    section.title = "times" + constants(records, axes);
    section.grid.columns = {{"vendor", false, 16},
                            {"type"},
                            {"device", false, 36},
                            {"SPP", true},
                            {"time ms", true},
                            {"kernel"},
                            {"size"},
                            {"work-group"},
                            {"lanes", true},
                            {"+- %", true},
                            {"Msamples/s", true},
                            {"Msegments/s", true}};
    if (rays) section.grid.columns.push_back({"Mrays/s", true});
    if (joules) section.grid.columns.push_back({"ksamples/J", true});
    for (const auto& axis : axes) section.grid.columns.push_back({axis, axis == "path_length"});
    if (notes) section.grid.columns.push_back({"note"});
    for (const Record& record : records) {
        auto& row = section.grid.rows.emplace_back(cells(result, record));
        if (rays) row.push_back(mrays_per_s(record));
        if (joules) row.push_back(samples_per_joule(record));
        for (const auto& axis : axes) row.push_back(case_value(record.params, axis));
        if (notes) row.push_back(note(record));
    }
    for (std::size_t i = 0; i < result.cases.size(); ++i)
        if (shown(result.cases[i])) section.grid.cases.push_back(i);
    section.notes = {
        "time: median; +-: half its 95 % interval, or ~ the median absolute deviation of few samples"};
    return section;
}

}  // namespace ptb
