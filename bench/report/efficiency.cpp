#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "bench/compare/row.h"
#include "bench/plan/config.h"
#include "bench/report/axes.h"
#include "bench/report/ladder.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"
#include "core/integrator/registry.h"

namespace ptb {
namespace {

std::string interval_text(double low, double high) {
    return fmt::format("{}-{}", number_text(low), number_text(high));
}

std::string efficiency_text(const Noise& noise) {
    return noise.efficiency ? number_text(*noise.efficiency) : "-";
}

std::string efficiency_interval(const Noise& noise) {
    return noise.low && noise.high ? interval_text(*noise.low, *noise.high) : "-";
}

/// The standard error, of the value.
std::string error_text(const Noise& noise) {
    return noise.rel_mse > 0 ? fmt::format("{:.1f}", 100 * noise.standard_error / noise.rel_mse) : "-";
}

std::string ratio_text(const Noise& noise, const Noise& base) {
    return noise.efficiency && base.efficiency ? number_text(*noise.efficiency / *base.efficiency) : "-";
}

/// Both intervals as independent ones of logarithms.
std::string ratio_interval(const Noise& noise, const Noise& base) {
    if (!noise.low || !noise.high || !base.low || !base.high) return "-";
    const double ratio = *noise.efficiency / *base.efficiency;
    const double below =
        std::hypot(std::log(*noise.efficiency / *noise.low), std::log(*base.high / *base.efficiency));
    const double above =
        std::hypot(std::log(*noise.high / *noise.efficiency), std::log(*base.efficiency / *base.low));
    return interval_text(ratio * std::exp(-below), ratio * std::exp(above));
}

/// The ladder's record of the kernel that the others are multiples of; null where it has none.
const Record* base_of(const std::vector<Record>& records, const Ladder& ladder) {
    for (const std::size_t i : ladder.cases)
        if (records[i].params.kernel == base_kernel) return &records[i];
    return nullptr;
}

std::vector<std::string> cells(const ResultFile& result, const Record& record, const Record* base,
                               const TimeUnit& unit) {
    const Noise &all = *record.efficiency->all, &best = *record.efficiency->best_99;
    const bool related = base != nullptr && base != &record;
    const std::string itself = base == &record ? "1" : "-";
    return {device_label(result, record.params.device),
            to_string(record.params.size),
            record.params.kernel,
            std::to_string(record.params.spp),
            unit.text(record.statistics->median_ns),
            number_text(all.rel_mse),
            error_text(all),
            efficiency_text(all),
            efficiency_interval(all),
            related ? ratio_text(all, *base->efficiency->all) : itself,
            related ? ratio_interval(all, *base->efficiency->all) : "-",
            number_text(best.rel_mse),
            efficiency_text(best),
            related ? ratio_text(best, *base->efficiency->best_99) : itself};
}

/// Of every ladder, in their order.
std::vector<Record> compared(const std::vector<Record>& records, const std::vector<Ladder>& all) {
    std::vector<Record> found;
    for (const Ladder& ladder : all)
        for (const std::size_t i : ladder.cases) found.push_back(records[i]);
    return found;
}

std::vector<std::string> efficiency_notes(const std::vector<Record>& records) {
    std::vector<std::string> notes{
        "relMSE: of the image, variance / (mean^2 + 0.01 median^2) of the reference; +-: its standard error; "
        "efficiency: 1 / (relMSE x s), with its 95 % interval; best 99 %: without the pixels of the largest "
        "errors, which needs many samples per pixel to mean much",
        "of each kernel the case whose time is nearest to the longest that all kernels reach; implicit "
        "work-groups"};
    const auto some_from = [&](const std::string& source) {
        return std::any_of(records.begin(), records.end(),
                           [&](const Record& record) { return record.efficiency->variance_from == source; });
    };
    if (some_from("reference"))
        notes.emplace_back("a kernel whose film holds no squares has its reference's variance");
    if (some_from("passes"))
        notes.emplace_back("a kernel whose pixels share paths has the variance of independent renders");
    return notes;
}

std::vector<Column> columns(const std::vector<std::string>& axes, const TimeUnit& unit) {
    const std::string times_base = fmt::format("x {}", base_kernel);
    std::vector<Column> all;
    for (const std::string& axis : axes) all.push_back({axis});
    for (const Column& column :
         {Column{"device", false, 36}, Column{"size"}, Column{"kernel"}, Column{"SPP", true},
          Column{unit.title("time"), true}, Column{"relMSE", true}, Column{"+- %", true},
          Column{"efficiency", true}, Column{"95 %", true}, Column{times_base, true}, Column{"95 %", true},
          Column{"best 99 %: relMSE", true}, Column{"efficiency", true}, Column{times_base, true}})
        all.push_back(column);
    return all;
}

std::vector<std::string> noise_cells(const ResultFile& result, const Record& record, const TimeUnit& unit) {
    std::vector<std::string> row{case_text(record.params), device_label(result, record.params.device),
                                 unit.text(record.statistics->median_ns)};
    for (const Noise& noise : {*record.efficiency->all, *record.efficiency->best_99})
        for (const std::string& cell : {number_text(noise.rel_mse), error_text(noise), efficiency_text(noise),
                                        efficiency_interval(noise)})
            row.push_back(cell);
    return row;
}

bool has_noise(const Record& record) {
    const auto& e = record.efficiency;
    return timed(record) && e && e->all && e->best_99;
}

}  // namespace

Section efficiency_section(const ResultFile& result) {
    const auto all = ladders(result.cases);
    const auto records = compared(result.cases, all);
    Section section;
    if (records.empty()) return section;
    auto axes = axis_columns(records);
    for (const std::string& axis : varying(records, {"lanes"})) axes.push_back(axis);
    const TimeUnit unit = unit_of(records);
    section.title = "efficiency at equal time";
    section.grid.columns = columns(axes, unit);
    for (const Ladder& ladder : all) {
        for (const std::size_t i : ladder.cases) {
            auto& row = section.grid.rows.emplace_back();
            for (const std::string& axis : axes) row.push_back(case_value(result.cases[i].params, axis));
            for (const auto& cell : cells(result, result.cases[i], base_of(result.cases, ladder), unit))
                row.push_back(cell);
            section.grid.cases.push_back(i);
        }
    }
    section.notes = efficiency_notes(records);
    return section;
}

Section noise_section(const ResultFile& result) {
    std::vector<Record> records;
    Section section;
    for (std::size_t i = 0; i < result.cases.size(); ++i) {
        if (!has_noise(result.cases[i])) continue;
        records.push_back(result.cases[i]);
        section.grid.cases.push_back(i);
    }
    const TimeUnit unit = unit_of(records);
    section.title = "relMSE over time";
    section.grid.columns = {{"case"}, {"device"}, {unit.title("time"), true}};
    for (const char* prefix : {"", "best 99 %: "})
        for (const char* title : {"relMSE", "+- %", "efficiency", "95 %"})
            section.grid.columns.push_back({fmt::format("{}{}", prefix, title), true});
    for (const Record& record : records) section.grid.rows.push_back(noise_cells(result, record, unit));
    return section;
}

}  // namespace ptb
