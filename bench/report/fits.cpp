#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/report/axes.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

const std::vector<std::string> always_shown = {"kernel", "size", "work_group"};

std::vector<Record> as_records(const std::vector<SppFit>& fits) {
    std::vector<Record> records(fits.size());
    for (std::size_t i = 0; i < fits.size(); ++i) records[i].params = fits[i].params;
    return records;
}

std::string name_of(const SppFit& fit) {
    const Case& c = fit.params;
    const std::string group = c.work_group.implicit() ? "" : ", work-group " + to_string(c.work_group);
    return fmt::format("{} {} {}{}{}", c.device, c.kernel, to_string(c.size), group, unusual_text(c));
}

}  // namespace

Section fits_section(const ResultFile& result) {
    const auto records = as_records(result.fits);
    auto axes = always_shown;
    for (const auto& more : {axis_columns(records), varying(records, {"lanes"})})
        axes.insert(axes.end(), more.begin(), more.end());
    Section section;
    section.title = "time over SPP";
    section.grid.columns = {{"device", false, 36}};
    for (const auto& axis : axes)
        section.grid.columns.push_back({axis == "work_group" ? "work-group" : axis});
    for (const char* title : {"points", "overhead ms", "ms per SPP", "R^2"})
        section.grid.columns.push_back({title, true});
    for (const SppFit& fit : result.fits) {
        auto& row = section.grid.rows.emplace_back();
        row.push_back(device_label(result, fit.params.device));
        for (const auto& axis : axes) row.push_back(case_value(fit.params, axis));
        row.insert(row.end(), {std::to_string(fit.points), number_text(fit.overhead_ms),
                               number_text(fit.ms_per_spp), fmt::format("{:.4f}", fit.r2)});
        if (!fit.warning.empty())
            section.notes.push_back(fmt::format("warning: {}: {}", name_of(fit), fit.warning));
    }
    return section;
}

}  // namespace ptb
