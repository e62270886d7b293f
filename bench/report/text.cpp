#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include <fmt/format.h>

#include "bench/report/grid.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

constexpr std::size_t gap = 2, narrowest = 12, bar_columns = 20;
constexpr auto bold = "1", green = "32", yellow = "33";

std::string painted(const std::string& text, const char* code, const TextStyle& style) {
    return style.colour && !text.empty() ? fmt::format("\033[{}m{}\033[0m", code, text) : text;
}

std::string bar_text(const std::string& share) {
    const double full = std::clamp(std::strtod(share.c_str(), nullptr), 0.0, 1.0);
    return std::string(static_cast<std::size_t>(std::lround(full * bar_columns)), '=');
}

std::string shown(const std::string& cell, const Column& column) {
    if (column.bar) return bar_text(cell);
    const auto text = printable(cell);
    return column.most == 0 ? text : shortened(text, column.most);
}

/// Lines of at most `columns` characters, broken at spaces where there are any.
std::vector<std::string> wrapped(std::string text, std::size_t columns) {
    std::vector<std::string> lines;
    while (width(text) > columns) {
        const std::size_t end = first_bytes(text, columns);
        const std::size_t space = text.rfind(' ', end);
        const std::size_t cut = space == std::string::npos || space == 0 ? end : space;
        lines.push_back(text.substr(0, cut));
        text.erase(0, text[cut] == ' ' ? cut + 1 : cut);
    }
    lines.push_back(text);
    return lines;
}

std::size_t total(const std::vector<std::size_t>& widths) {
    return std::accumulate(widths.begin(), widths.end(), gap * (widths.size() - 1));
}

/// The widest column that text can be wrapped in.
std::size_t widest(const Grid& grid, const std::vector<std::size_t>& widths) {
    std::size_t found = widths.size();
    for (std::size_t i = 0; i < widths.size(); ++i) {
        const bool wraps = !grid.columns[i].number && !grid.columns[i].bar && widths[i] > narrowest;
        if (wraps && (found == widths.size() || widths[i] > widths[found])) found = i;
    }
    return found;
}

std::vector<std::size_t> column_widths(const Grid& grid, const TextStyle& style) {
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < grid.columns.size(); ++i) {
        widths.push_back(width(printable(grid.columns[i].title)));
        for (const auto& row : grid.rows)
            widths[i] = std::max(widths[i], width(shown(row.at(i), grid.columns[i])));
    }
    while (style.columns > 0 && total(widths) > style.columns) {
        const std::size_t i = widest(grid, widths);
        if (i == widths.size()) break;
        --widths[i];
    }
    return widths;
}

std::string padded(const std::string& text, std::size_t to, bool right) {
    const std::string space(to - std::min(to, width(text)), ' ');
    return right ? space + text : text + space;
}

/// One row of cells that are ready to be shown, as many lines as its longest cell needs.
std::string text_row(const Grid& grid, const std::vector<std::string>& cells,
                     const std::vector<std::size_t>& widths, const char* code, const TextStyle& style) {
    std::vector<std::vector<std::string>> columns;
    std::size_t lines = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        columns.push_back(wrapped(cells[i], std::max<std::size_t>(widths[i], 1)));
        lines = std::max(lines, columns.back().size());
    }
    std::string text;
    for (std::size_t l = 0; l < lines; ++l) {
        std::vector<std::string> aligned;
        for (std::size_t i = 0; i < columns.size(); ++i)
            aligned.push_back(
                padded(l < columns[i].size() ? columns[i][l] : "", widths[i], grid.columns[i].number));
        std::string line = fmt::format("{}", fmt::join(aligned, std::string(gap, ' ')));
        line.erase(line.find_last_not_of(' ') + 1);
        text += (code == nullptr ? line : painted(line, code, style)) + "\n";
    }
    return text;
}

std::string text_grid(const Grid& grid, const TextStyle& style) {
    const auto widths = column_widths(grid, style);
    std::vector<std::string> titles, rules;
    for (std::size_t i = 0; i < widths.size(); ++i) {
        titles.push_back(printable(grid.columns[i].title));
        rules.emplace_back(widths[i], '-');
    }
    std::string text =
        text_row(grid, titles, widths, nullptr, style) + text_row(grid, rules, widths, nullptr, style);
    for (std::size_t r = 0; r < grid.rows.size(); ++r) {
        std::vector<std::string> cells;
        for (std::size_t i = 0; i < widths.size(); ++i)
            cells.push_back(shown(grid.rows[r].at(i), grid.columns[i]));
        text += text_row(grid, cells, widths, grid.best.contains(r) ? green : nullptr, style);
    }
    return text;
}

}  // namespace

std::string to_text(const Section& section, const TextStyle& style) {
    std::string text = painted(printable(section.title), bold, style) + "\n";
    if (!section.grid.rows.empty()) text += text_grid(section.grid, style);
    for (const auto& note : section.notes) {
        const std::string line = printable(note);
        text += fmt::format("  {}\n", line.starts_with("warning:") ? painted(line, yellow, style) : line);
    }
    return text;
}

}  // namespace ptb
