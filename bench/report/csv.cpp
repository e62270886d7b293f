#include "bench/report/csv.h"

#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/record/status.h"
#include "bench/report/words.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

/// Text from drivers and files, on one line and never a formula.
std::string text(const std::string& untrusted) {
    std::string cell = printable(untrusted);
    if (!cell.empty() && std::string("=+-@").find(cell[0]) != std::string::npos)
        cell.insert(cell.begin(), '\'');
    return cell;
}

std::string real(double value, int decimals) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "";
}

std::string significant(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : ""; }

std::string ms_text(double ns) { return real(ms(ns), 6); }

std::string quoted(const std::string& cell) {
    if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
    std::string doubled;
    for (const char c : cell) doubled.append(c == '"' ? 2 : 1, c);
    return fmt::format("\"{}\"", doubled);
}

std::string line(const std::vector<std::string>& cells) {
    std::vector<std::string> quoted_cells;
    for (const auto& cell : cells) quoted_cells.push_back(quoted(cell));
    return fmt::format("{}\n", fmt::join(quoted_cells, ","));
}

/// What a column is made from.
struct Row {
    const Record& record;
    DeviceInfo device;
};
using Cell = std::function<std::string(const Row&)>;
using Columns = std::vector<std::pair<std::string, Cell>>;

Cell axis(const std::string& name) {
    return [name](const Row& r) { return text(case_value(r.record.params, name)); };
}
/// Cells that are empty when the record lacks the part they show.
Cell of_statistics(const std::function<std::string(const Statistics&)>& show) {
    return [show](const Row& r) { return r.record.statistics ? show(*r.record.statistics) : ""; };
}
Cell of_work(const std::function<std::string(const Work&)>& show) {
    return [show](const Row& r) { return r.record.work ? show(*r.record.work) : ""; };
}
Cell of_build(const std::function<std::string(const Build&)>& show) {
    return [show](const Row& r) { return r.record.build ? show(*r.record.build) : ""; };
}
Cell of_tree(const std::function<std::string(const TreeRecord&)>& show) {
    return [show](const Row& r) { return r.record.tree ? show(*r.record.tree) : ""; };
}
Cell of_tree(std::uint64_t TreeRecord::*member) {
    return of_tree([member](const TreeRecord& t) { return std::to_string(t.*member); });
}
Cell of_energy(std::optional<double> Energy::*member) {
    return [member](const Row& r) {
        const auto& energy = r.record.energy;
        return energy && *energy.*member ? real(*(*energy.*member), 6) : "";
    };
}
Cell of_noise(std::optional<Noise> Efficiency::*pixels, double Noise::*member) {
    return [=](const Row& r) {
        const auto& e = r.record.efficiency;
        return e && (*e).*pixels ? significant((*((*e).*pixels)).*member) : "";
    };
}
Cell of_noise(std::optional<Noise> Efficiency::*pixels, std::optional<double> Noise::*member) {
    return [=](const Row& r) {
        const auto& e = r.record.efficiency;
        const auto value = e && (*e).*pixels ? (*((*e).*pixels)).*member : std::nullopt;
        return value ? significant(*value) : "";
    };
}
Cell of_counted(std::optional<double> Counted::*member) {
    return [member](const Row& r) {
        const auto& counted = r.record.counted;
        return counted && *counted.*member ? real(*(*counted.*member), 6) : "";
    };
}
Cell of_peak(std::optional<double> PeakShares::*member) {
    return [member](const Row& r) {
        const auto& counted = r.record.counted;
        return counted && counted->of_peak.*member ? real(*(counted->of_peak.*member), 6) : "";
    };
}
Cell statistic_ms(double Statistics::*member) {
    return of_statistics([member](const Statistics& s) { return ms_text(s.*member); });
}
Cell statistic_ms(std::optional<double> Statistics::*member) {
    return of_statistics([member](const Statistics& s) { return s.*member ? ms_text(*(s.*member)) : ""; });
}

std::string time_ms(const Row& r) { return timed(r.record) ? ms_text(r.record.statistics->median_ns) : ""; }

Columns variant_columns() {
    Columns columns;
    for (const VariantAxis& each : variant_axes()) columns.emplace_back(each.name, axis(each.name));
    return columns;
}

Cell of_shared(double SharedWork::*member) {
    return [member](const Row& r) { return r.record.shared ? real(*r.record.shared.*member, 6) : ""; };
}

const Columns& several_columns() {
    static const Columns columns = {{"devices", axis("devices")},
                                    {"together", axis("together")},
                                    {"speedup", of_shared(&SharedWork::speedup)},
                                    {"devices_efficiency", of_shared(&SharedWork::efficiency)}};
    return columns;
}

const Columns& case_columns() {
    static const Columns columns = {
        {"kernel", axis("kernel")},
        {"scene", axis("scene")},
        {"width", [](const Row& r) { return std::to_string(r.record.params.size.width); }},
        {"height", [](const Row& r) { return std::to_string(r.record.params.size.height); }},
        {"path_length", axis("path_length")},
        {"work_group", axis("work_group")},
        {"lanes", axis("lanes")},
        {"status", [](const Row& r) { return to_string(r.record.status); }},
        {"reason", [](const Row& r) { return text(r.record.reason); }},
    };
    return columns;
}

const Columns& device_columns() {
    static const Columns columns = {
        {"vendor", [](const Row& r) { return text(vendor_name(r.device)); }},
        {"type", [](const Row& r) { return text(r.device.type); }},
        {"device", [](const Row& r) { return text(r.device.name); }},
    };
    return columns;
}

const Columns& statistics_columns() {
    using S = const Statistics&;
    static const Columns columns = {
        {"n", of_statistics([](S s) { return std::to_string(s.n); })},
        {"flagged", of_statistics([](S s) { return std::to_string(s.flagged); })},
        {"median_ms", statistic_ms(&Statistics::median_ns)},
        {"mad_ms", statistic_ms(&Statistics::mad_ns)},
        {"mean_ms", statistic_ms(&Statistics::mean_ns)},
        {"min_ms", statistic_ms(&Statistics::min_ns)},
        {"max_ms", statistic_ms(&Statistics::max_ns)},
        {"q1_ms", statistic_ms(&Statistics::q1_ns)},
        {"q3_ms", statistic_ms(&Statistics::q3_ns)},
        {"ci_low_ms", statistic_ms(&Statistics::ci_low_ns)},
        {"ci_high_ms", statistic_ms(&Statistics::ci_high_ns)},
        {"timer", of_statistics([](S s) { return text(s.timer); })},
        {"stop_reason", of_statistics([](S s) { return text(s.stop_reason); })},
        {"msamples_per_s", of_statistics([](S s) { return real(s.msamples_per_s, 6); })},
        {"msegments_per_s", of_statistics([](S s) { return real(s.msegments_per_s, 6); })},
        {"mrays_per_s", of_statistics([](S s) { return s.mrays_per_s ? real(*s.mrays_per_s, 6) : ""; })},
    };
    return columns;
}

/// Of all pixels, or of the best 99 %, whose names end so.
Columns noise_columns(const std::string& name, std::optional<Noise> Efficiency::*pixels) {
    return {{"rel_mse" + name, of_noise(pixels, &Noise::rel_mse)},
            {"rel_mse_error" + name, of_noise(pixels, &Noise::standard_error)},
            {"efficiency" + name, of_noise(pixels, &Noise::efficiency)},
            {"efficiency_low" + name, of_noise(pixels, &Noise::low)},
            {"efficiency_high" + name, of_noise(pixels, &Noise::high)}};
}

const Columns& other_columns() {
    static const Columns columns = {
        {"samples", of_work([](const Work& w) { return std::to_string(w.samples); })},
        {"segments", of_work([](const Work& w) { return std::to_string(w.segments); })},
        {"shadow_rays", of_work([](const Work& w) { return std::to_string(w.shadow_rays); })},
        {"light_segments", of_work([](const Work& w) { return std::to_string(w.light_segments); })},
        {"lanes_run", of_work([](const Work& w) { return std::to_string(w.lanes); })},
        {"renders", of_work([](const Work& w) { return std::to_string(w.renders); })},
        {"passes", of_work([](const Work& w) { return std::to_string(w.passes); })},
        {"build_ms", of_build([](const Build& b) { return real(b.build_ms, 6); })},
        {"first_launch_ms", of_build([](const Build& b) {
             return b.first_launch_ns == 0 ? "" : ms_text(static_cast<double>(b.first_launch_ns));
         })},
        {"kernel_hash", of_build([](const Build& b) { return text(b.kernel_hash); })},
        {"joules", of_energy(&Energy::joules)},
        {"samples_per_joule", of_energy(&Energy::samples_per_joule)},
        {"idle_w", of_energy(&Energy::idle_w)},
        {"flops_per_segment", of_counted(&Counted::flops_per_segment)},
        {"roots_per_segment", of_counted(&Counted::roots_per_segment)},
        {"divisions_per_segment", of_counted(&Counted::divisions_per_segment)},
        {"bytes_per_segment", of_counted(&Counted::bytes_per_segment)},
        {"lanes_alive", of_counted(&Counted::lanes_alive)},
        {"of_peak_fma", of_peak(&PeakShares::fma)},
        {"of_peak_sqrt", of_peak(&PeakShares::sqrt)},
        {"of_peak_division", of_peak(&PeakShares::division)},
        {"of_peak_global", of_peak(&PeakShares::global)},
        {"limit", [](const Row& r) { return r.record.counted ? text(r.record.counted->of_peak.limit) : ""; }},
        {"nodes_per_ray", of_counted(&Counted::nodes_per_ray)},
        {"triangles_per_ray", of_counted(&Counted::triangles_per_ray)},
        {"tree_layout", of_tree([](const TreeRecord& t) { return text(t.layout); })},
        {"tree_triangles", of_tree(&TreeRecord::triangles)},
        {"tree_references", of_tree(&TreeRecord::references)},
        {"tree_nodes", of_tree(&TreeRecord::nodes)},
        {"tree_leaves", of_tree(&TreeRecord::leaves)},
        {"tree_bytes", of_tree(&TreeRecord::bytes)},
        {"tree_depth", of_tree([](const TreeRecord& t) { return std::to_string(t.depth); })},
        {"tree_sah_cost", of_tree([](const TreeRecord& t) { return significant(t.sah_cost); })},
        {"tree_build_ms", of_tree([](const TreeRecord& t) { return real(t.build_ms, 6); })},
        {"device_key", [](const Row& r) { return text(r.record.params.device); }},
        {"platform", [](const Row& r) { return text(r.device.platform); }},
        {"driver_version", [](const Row& r) { return text(r.device.driver_version); }},
        {"node", [](const Row& r) { return text(r.device.node); }},
        {"pci", [](const Row& r) { return text(r.device.pci); }},
        {"uuid", [](const Row& r) { return text(r.device.uuid); }},
        {"serial", [](const Row& r) { return text(r.device.serial); }},
        {"film_hash", of_work([](const Work& w) { return text(w.film_hash); })},
    };
    return columns;
}

Columns joined(const std::vector<Columns>& groups) {
    Columns all;
    for (const Columns& group : groups) all.insert(all.end(), group.begin(), group.end());
    return all;
}

std::vector<std::string> header(const Columns& columns) {
    std::vector<std::string> names;
    for (const auto& [name, cell] : columns) names.push_back(name);
    return names;
}

std::vector<std::string> cells(const Columns& columns, const Row& row) {
    std::vector<std::string> result;
    for (const auto& [name, cell] : columns) result.push_back(cell(row));
    return result;
}

std::vector<std::string> sample_cells(std::size_t index, const TimeSample& s) {
    return {std::to_string(index),       std::to_string(s.kernel_ns),
            std::to_string(s.sum_ns),    std::to_string(s.host_ns),
            std::to_string(s.queued_ns), std::to_string(s.submit_ns),
            std::to_string(s.probe_ns),  text(s.cause)};
}

}  // namespace

std::string csv(const ResultFile& result) {
    static const Columns work = {{"spp", axis("spp")}, {"time_ms", time_ms}};
    const auto columns =
        joined({device_columns(), work, case_columns(), statistics_columns(), other_columns(),
                variant_columns(), several_columns(), noise_columns("", &Efficiency::all),
                noise_columns("_best_99", &Efficiency::best_99)});
    std::string output = line(header(columns));
    for (const Record& record : result.cases)
        output += line(cells(columns, {record, device_of(result, record.params.device)}));
    return output;
}

std::string csv(const Grid& grid) {
    std::vector<std::string> titles;
    for (const Column& column : grid.columns) titles.push_back(column.title);
    std::string lines = line(titles);
    for (const auto& row : grid.rows) {
        std::vector<std::string> cells;
        for (std::size_t i = 0; i < row.size(); ++i)
            cells.push_back(grid.columns[i].number ? row[i] : text(row[i]));
        lines += line(cells);
    }
    return lines;
}

std::string csv_samples(const ResultFile& result) {
    static const Columns spp = {{"spp", axis("spp")}};
    static const Columns renders = {
        {"renders", of_work([](const Work& w) { return std::to_string(w.renders); })}};
    const auto columns =
        joined({device_columns(), spp, case_columns(), renders, variant_columns(), several_columns()});
    auto names = header(columns);
    for (const char* name :
         {"sample", "kernel_ns", "sum_ns", "host_ns", "queued_ns", "submit_ns", "probe_ns", "cause"})
        names.emplace_back(name);
    std::string output = line(names);
    for (const Record& record : result.cases) {
        for (std::size_t i = 0; i < record.samples.size(); ++i) {
            auto row = cells(columns, {record, device_of(result, record.params.device)});
            for (auto& cell : sample_cells(i, record.samples[i])) row.push_back(std::move(cell));
            output += line(row);
        }
    }
    return output;
}

}  // namespace ptb
