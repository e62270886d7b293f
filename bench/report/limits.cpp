#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

auto kernel_at_work(const Record& record) {
    const Case& c = record.params;
    return std::tie(c.device, c.kernel, c.scene, c.path_length);
}

/// The fastest counted case of each device, kernel, scene and path length.
std::vector<Record> fastest(const std::vector<Record>& records) {
    std::vector<Record> best;
    for (const Record& record : records) {
        if (!record.counted || !record.statistics) continue;
        const auto same = std::find_if(best.begin(), best.end(), [&](const Record& other) {
            return kernel_at_work(other) == kernel_at_work(record);
        });
        if (same == best.end())
            best.push_back(record);
        else if (record.statistics->msegments_per_s > same->statistics->msegments_per_s)
            *same = record;
    }
    return best;
}

std::string number(const std::optional<double>& value) { return value ? number_text(*value) : "-"; }

std::string percent(const std::optional<double>& share) {
    return share ? fmt::format("{:.1f} %", *share * 100) : "-";
}

std::vector<std::string> cells(const Record& record) {
    const Counted& c = *record.counted;
    const PeakShares& of = c.of_peak;
    return {record.params.device,
            record.params.kernel,
            record.params.scene,
            record.work ? std::to_string(record.work->lanes) : "-",
            number_text(record.statistics->msegments_per_s),
            number(c.flops_per_segment),
            number(c.roots_per_segment),
            number(c.divisions_per_segment),
            number(c.bytes_per_segment),
            percent(c.lanes_alive),
            percent(of.fma),
            percent(of.sqrt),
            percent(of.division),
            percent(of.global),
            of.limit_share ? fmt::format("{} {}", of.limit, percent(of.limit_share)) : "-"};
}

}  // namespace

Section limits_section(const std::vector<Record>& records) {
    Section section;
    section.title = "how close to the limit: work a segment, and shares of the peaks";
    section.grid.columns = {{"device"},
                            {"kernel"},
                            {"scene"},
                            {"lanes", true},
                            {"Msegments/s", true},
                            {"flops", true},
                            {"roots", true},
                            {"divisions", true},
                            {"bytes", true},
                            {"lanes alive", true},
                            {"of fma", true},
                            {"of sqrt", true},
                            {"of division", true},
                            {"of global", true},
                            {"nearest limit"}};
    for (const Record& record : fastest(records)) {
        section.grid.rows.push_back(cells(record));
        if (!record.counted->reason.empty())
            section.notes.push_back(fmt::format("{}, {}: {}", record.params.device, record.params.kernel,
                                                record.counted->reason));
    }
    return section;
}

}  // namespace ptb
