#include <fmt/format.h>

#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

std::vector<std::string> cells(const std::string& device, const Peak& peak) {
    const auto number = [](const std::optional<double>& value) { return value ? number_text(*value) : "-"; };
    const std::string interval =
        peak.low && peak.high ? fmt::format("{}-{}", number(peak.low), number(peak.high)) : "-";
    return {device,   peak.name,  number(peak.value),     peak.unit,
            interval, peak.timer, std::to_string(peak.n), peak.reason};
}

}  // namespace

Section peaks_section(const std::vector<DevicePeaks>& all) {
    Section section;
    section.title = "what devices can do at most";
    section.grid.columns = {{"device"},     {"peak"},  {"median", true}, {"unit"},
                            {"95 %", true}, {"timer"}, {"n", true},      {"note"}};
    for (const DevicePeaks& each : all) {
        for (const Peak& peak : each.peaks) section.grid.rows.push_back(cells(each.device, peak));
        if (!each.reason.empty()) section.notes.push_back(fmt::format("{}: {}", each.device, each.reason));
    }
    return section;
}

}  // namespace ptb
