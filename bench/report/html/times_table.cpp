#include <algorithm>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/report/axes.h"
#include "bench/report/html/html.h"
#include "bench/report/html/parts.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

/// Rows of all, under the columns of all; a cell that a grid has no column for stays empty.
Grid merged(const std::vector<Grid>& grids) {
    Grid all;
    const auto place = [&](const Column& column) {
        const auto same = [&](const Column& other) { return other.title == column.title; };
        const auto found = std::find_if(all.columns.begin(), all.columns.end(), same);
        if (found != all.columns.end()) return static_cast<std::size_t>(found - all.columns.begin());
        all.columns.push_back(column);
        return all.columns.size() - 1;
    };
    std::vector<std::vector<std::size_t>> places;
    for (const Grid& grid : grids) {
        auto& to = places.emplace_back();
        for (const Column& column : grid.columns) to.push_back(place(column));
    }
    for (std::size_t g = 0; g < grids.size(); ++g) {
        for (const auto& row : grids[g].rows) {
            auto& cells = all.rows.emplace_back(all.columns.size());
            for (std::size_t i = 0; i < row.size(); ++i) cells[places[g][i]] = row[i];
        }
    }
    return all;
}

void append_column(Grid& grid, const std::string& title, const std::string& value) {
    grid.columns.push_back({title});
    for (auto& row : grid.rows) row.push_back(value);
}

Grid published_grid(const PublishedTable& published) {
    Grid grid{{{"vendor"}, {"type"}, {"device"}, {"SPP", true}, {"time ms", true}, {"kernel"}, {"size"}}, {}};
    for (const PublishedRow& row : published.rows)
        grid.rows.push_back({row.vendor, row.type, row.device, std::to_string(row.spp),
                             number_text(row.time_ms), published.kernel, to_string(row.size)});
    append_column(grid, "run", std::to_string(published.year));
    return grid;
}

}  // namespace

std::string times_table(const std::vector<PageRun>& runs, const PublishedTable& published) {
    std::vector<Grid> grids;
    std::vector<std::string> links, notes;
    std::vector<Record> records;
    for (const PageRun& run : runs)
        for (const Record& record : shown_records(run.result)) records.push_back(record);
    const auto axes = axis_columns(records);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const Section section = times_section(runs[i].result, axes);
        grids.push_back(section.grid);
        append_column(grids.back(), "run", runs.size() == 1 ? "this run" : run_name(runs, i));
        for (const std::size_t c : section.grid.cases) links.push_back(case_id(i, c));
        notes.push_back(fmt::format("{}: {}", run_name(runs, i), section.title));
    }
    grids.push_back(published_grid(published));
    links.resize(links.size() + published.rows.size());
    notes.push_back(fmt::format("{}: {}", published.year, published.origin));
    notes.emplace_back(
        "time: median; +-: half its 95 % interval in percent, or ~ the median absolute deviation of few "
        "samples");
    return html_table(merged(grids), "Times of every device", {"sortable", links, "", {}, 0}) +
           html_paragraphs(notes);
}

}  // namespace ptb
