#include "bench/report/grid.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "core/input/printable.h"

namespace ptb {
namespace {

std::string shown(const std::string& cell, const Column& column) {
    const auto text = printable(cell);
    return column.most == 0 ? text : shortened(text, column.most);
}

std::string padded(const std::string& text, std::size_t to, bool right) {
    const std::string space(to - std::min(to, width(text)), ' ');
    return right ? space + text : text + space;
}

std::vector<std::size_t> column_widths(const Grid& grid) {
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < grid.columns.size(); ++i) {
        widths.push_back(width(shown(grid.columns[i].title, grid.columns[i])));
        for (const auto& row : grid.rows)
            widths[i] = std::max(widths[i], width(shown(row.at(i), grid.columns[i])));
    }
    return widths;
}

std::string text_line(const Grid& grid, const std::vector<std::string>& cells,
                      const std::vector<std::size_t>& widths) {
    std::vector<std::string> aligned;
    for (std::size_t i = 0; i < cells.size(); ++i)
        aligned.push_back(padded(shown(cells[i], grid.columns[i]), widths[i], grid.columns[i].number));
    std::string line = fmt::format("{}", fmt::join(aligned, "  "));
    line.erase(line.find_last_not_of(' ') + 1);
    return line += '\n';
}

std::vector<std::string> titles(const Grid& grid) {
    std::vector<std::string> result;
    for (const Column& column : grid.columns) result.push_back(column.title);
    return result;
}

/// Text that Markdown and the HTML it allows leave as it is.
std::string escaped(const std::string& text) {
    constexpr std::string_view special = "\\|`*_[]~#";
    std::string result;
    for (const char c : printable(text)) {
        if (special.find(c) != std::string_view::npos) result += '\\';
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else
            result += c;
    }
    return result;
}

std::string markdown_line(const std::vector<std::string>& cells) {
    std::vector<std::string> safe;
    for (const auto& cell : cells) safe.push_back(escaped(cell));
    return fmt::format("| {} |\n", fmt::join(safe, " | "));
}

std::string text_grid(const Grid& grid) {
    const auto widths = column_widths(grid);
    std::vector<std::string> rules;
    for (const auto columns : widths) rules.emplace_back(columns, '-');
    std::string text = text_line(grid, titles(grid), widths) + text_line(grid, rules, widths);
    for (const auto& row : grid.rows) text += text_line(grid, row, widths);
    return text;
}

std::string markdown_grid(const Grid& grid) {
    std::vector<std::string> rules;
    for (const Column& column : grid.columns) rules.emplace_back(column.number ? "---:" : "---");
    std::string text = markdown_line(titles(grid)) + fmt::format("| {} |\n", fmt::join(rules, " | "));
    for (const auto& row : grid.rows) text += markdown_line(row);
    return text;
}

}  // namespace

std::string to_text(const Section& section) {
    std::string text = fmt::format("{}\n", printable(section.title));
    if (!section.grid.rows.empty()) text += text_grid(section.grid);
    for (const auto& note : section.notes) text += fmt::format("  {}\n", printable(note));
    return text;
}

std::string to_markdown(const Section& section) {
    std::string text = fmt::format("### {}\n\n", escaped(section.title));
    if (!section.grid.rows.empty()) text += markdown_grid(section.grid);
    if (!section.grid.rows.empty() && !section.notes.empty()) text += '\n';
    for (const auto& note : section.notes) text += fmt::format("- {}\n", escaped(note));
    return text;
}

}  // namespace ptb
