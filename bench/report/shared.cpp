#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/plan/config.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

std::vector<std::string> cells_of_shared(const Record& record) {
    const Case& c = record.params;
    const SharedWork& shared = *record.shared;
    std::vector<std::string> device_times;
    for (const double ms : shared.device_ms) device_times.push_back(number_text(ms));
    return {fmt::format("{}", fmt::join(shared.devices, " ")),
            c.kernel,
            c.scene,
            to_string(c.size),
            std::to_string(c.spp),
            number_text(record.statistics->median_ns * 1e-6),
            fmt::format("{}", fmt::join(device_times, " ")),
            fmt::format("{:.2f}", shared.speedup),
            fmt::format("{:.3f}", shared.efficiency)};
}

}  // namespace

Section shared_section(const ResultFile& result) {
    Section section;
    section.title = "one picture by several devices";
    section.grid.columns = {{"devices"},         {"kernel"},   {"scene"},           {"size"},
                            {"SPP", true},       {"ms", true}, {"device ms", true}, {"speedup", true},
                            {"efficiency", true}};
    for (const Record& record : result.cases)
        if (record.shared && record.statistics) section.grid.rows.push_back(cells_of_shared(record));
    if (!section.grid.rows.empty())
        section.notes.emplace_back(
            "ms by the host's clock, from the first part handed out to the last film added; speedup over the "
            "fastest device, and share of the speed of all, each at its own parts");
    return section;
}

}  // namespace ptb
