#include "bench/report/published.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "bench/plan/tuned.h"
#include "bench/record/json.h"
#include "bench/report/axes.h"
#include "bench/report/words.h"

namespace ptb {

template <>
inline constexpr auto fields<PublishedRow> =
    std::make_tuple(required("vendor", &PublishedRow::vendor), required("type", &PublishedRow::type),
                    required("device", &PublishedRow::device), required("spp", &PublishedRow::spp),
                    required("time_ms", &PublishedRow::time_ms), required("size", &PublishedRow::size),
                    required("path_length", &PublishedRow::path_length));

template <>
inline constexpr auto fields<PublishedTable> = std::make_tuple(required("year", &PublishedTable::year),
                                                               required("origin", &PublishedTable::origin),
                                                               required("kernel", &PublishedTable::kernel),
                                                               required("scene", &PublishedTable::scene),
                                                               required("rows", &PublishedTable::rows));

namespace {

/// In what a published row says nothing of.
bool is_usual(Case c) {
    c.scene = default_case().scene;
    c.path_length = default_case().path_length;
    return unusual(c, other_axes()) == 0;
}

/// The run's own times that did the work of a published row, but for the number of pixels.
std::vector<Record> like(const ResultFile& result, const PublishedTable& table, const PublishedRow& row) {
    std::vector<Record> records;
    for (const Record& record : result.cases) {
        const Case c = as_asked(record.params);
        const bool same = c.spp == row.spp && c.path_length == row.path_length && c.scene == table.scene;
        if (same && is_usual(c) && c.work_group.implicit() && timed(record)) records.push_back(record);
    }
    return records;
}

double scale(const Record& record, const PublishedRow& row) {
    return static_cast<double>(row.size.pixels()) / static_cast<double>(record.params.size.pixels());
}

std::vector<std::string> published_cells(const PublishedTable& table, const PublishedRow& row, bool scaled) {
    std::vector<std::string> cells = {row.vendor,
                                      row.type,
                                      row.device,
                                      std::to_string(row.spp),
                                      number_text(row.time_ms),
                                      table.kernel,
                                      to_string(row.size),
                                      std::to_string(table.year)};
    if (scaled) cells.emplace_back();
    return cells;
}

std::vector<std::string> own_cells(const ResultFile& result, const Record& record, const PublishedRow& row,
                                   bool scaled) {
    const DeviceInfo device = device_of(result, record.params.device);
    const double time_ms = ms(record.statistics->median_ns);
    std::vector<std::string> cells = {vendor_name(device),
                                      device.type,
                                      device_label(result, device.key),
                                      std::to_string(record.params.spp),
                                      number_text(time_ms),
                                      record.params.kernel,
                                      to_string(record.params.size),
                                      "this run"};
    const double factor = scale(record, row);
    const bool other_size = factor != 1;
    if (scaled)
        cells.push_back(other_size ? fmt::format("{} (x{:.4g})", number_text(time_ms * factor), factor) : "");
    return cells;
}

bool any_scaled(const ResultFile& result, const PublishedTable& table) {
    for (const PublishedRow& row : table.rows)
        for (const Record& record : like(result, table, row))
            if (scale(record, row) != 1) return true;
    return false;
}

std::vector<int> spps(const PublishedTable& table) {
    std::vector<int> result;
    for (const PublishedRow& row : table.rows)
        if (std::find(result.begin(), result.end(), row.spp) == result.end()) result.push_back(row.spp);
    return result;
}

void append_rows(Grid& grid, const ResultFile& result, const PublishedTable& table, int spp, bool scaled) {
    const PublishedRow* last = nullptr;
    for (const PublishedRow& row : table.rows) {
        if (row.spp != spp) continue;
        grid.rows.push_back(published_cells(table, row, scaled));
        last = &row;
    }
    if (last == nullptr) return;
    for (const Record& record : like(result, table, *last))
        grid.rows.push_back(own_cells(result, record, *last, scaled));
}

}  // namespace

PublishedTable read_published(const std::filesystem::path& file) {
    PublishedTable table;
    const std::string origin = file.string();
    decode(parse_json(read_text(file), origin), Where(origin), table);
    return table;
}

Section published_section(const ResultFile& result, const PublishedTable& table) {
    const bool scaled = any_scaled(result, table);
    Section section;
    section.title = fmt::format("beside {}", table.year);
    section.grid.columns = {{"vendor", false, 16},
                            {"type"},
                            {"device", false, 36},
                            {"SPP", true},
                            {"time ms", true},
                            {"kernel"},
                            {"size"},
                            {"when"}};
    if (scaled) section.grid.columns.push_back({"scaled ms", true});
    for (const int spp : spps(table)) append_rows(section.grid, result, table, spp, scaled);
    section.notes = {fmt::format("{}: {}", table.year, table.origin)};
    if (scaled)
        section.notes.push_back(
            "scaled: the time as it would be if it grew with the pixels to the published size; an "
            "estimate, not a measurement");
    return section;
}

}  // namespace ptb
