#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

const std::vector<std::string> shown_axes = {"kernel", "size", "work_group"};
const std::vector<std::string> optional_axes = {"scene", "path_length", "lanes"};

std::vector<Record> as_records(const std::vector<SppFit>& fits) {
    std::vector<Record> records(fits.size());
    for (std::size_t i = 0; i < fits.size(); ++i) records[i].params = fits[i].params;
    return records;
}

std::string name_of(const SppFit& fit) {
    return fmt::format("{} {} {}", fit.params.device, fit.params.kernel, to_string(fit.params.size));
}

}  // namespace

Section fits_section(const ResultFile& result) {
    auto axes = shown_axes;
    for (const auto& axis : varying(as_records(result.fits), optional_axes)) axes.push_back(axis);
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
