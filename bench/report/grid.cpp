#include "bench/report/grid.h"

#include <algorithm>
#include <string_view>

#include "bench/record/printable.h"

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
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i)
        line += (i == 0 ? "" : "  ") +
                padded(shown(cells[i], grid.columns[i]), widths[i], grid.columns[i].number);
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
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
    std::string line = "|";
    for (const auto& cell : cells) line += " " + escaped(cell) + " |";
    return line + "\n";
}

}  // namespace

std::string to_text(const Section& section) {
    std::string text = printable(section.title) + "\n";
    const auto& grid = section.grid;
    if (!grid.rows.empty()) {
        const auto widths = column_widths(grid);
        std::vector<std::string> rules;
        for (const auto columns : widths) rules.emplace_back(columns, '-');
        text += text_line(grid, titles(grid), widths);
        // Rules are as wide as their column already, so they are not shortened.
        for (std::size_t i = 0; i < rules.size(); ++i) text += (i == 0 ? "" : "  ") + rules[i];
        text += "\n";
        for (const auto& row : grid.rows) text += text_line(grid, row, widths);
    }
    for (const auto& note : section.notes) text += "  " + printable(note) + "\n";
    return text;
}

std::string to_markdown(const Section& section) {
    std::string text = "### " + escaped(section.title) + "\n\n";
    const auto& grid = section.grid;
    if (!grid.rows.empty()) {
        text += markdown_line(titles(grid)) + "|";
        for (const Column& column : grid.columns) text += column.number ? " ---: |" : " --- |";
        text += "\n";
        for (const auto& row : grid.rows) text += markdown_line(row);
    }
    if (!section.notes.empty() && !grid.rows.empty()) text += "\n";
    for (const auto& note : section.notes) text += "- " + escaped(note) + "\n";
    return text;
}

}  // namespace ptb
