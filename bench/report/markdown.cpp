#include "bench/report/markdown.h"

#include <string_view>

#include <fmt/format.h>

#include "bench/report/grid.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

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

/// The cells of columns that are no bars.
std::vector<std::string> written(const Grid& grid, const std::vector<std::string>& cells) {
    std::vector<std::string> kept;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (!grid.columns[i].bar) kept.push_back(cells[i]);
    return kept;
}

std::string markdown_grid(const Grid& grid) {
    std::vector<std::string> titles, rules;
    for (const Column& column : grid.columns) {
        titles.push_back(column.title);
        rules.emplace_back(column.number ? "---:" : "---");
    }
    std::string text = markdown_line(written(grid, titles)) +
                       fmt::format("| {} |\n", fmt::join(written(grid, rules), " | "));
    for (const auto& row : grid.rows) text += markdown_line(written(grid, row));
    return text;
}

}  // namespace

std::string to_markdown(const Section& section) {
    std::string text = fmt::format("### {}\n\n", escaped(section.title));
    if (!section.grid.rows.empty()) text += markdown_grid(section.grid);
    if (!section.grid.rows.empty() && !section.notes.empty()) text += '\n';
    for (const auto& note : section.notes) text += fmt::format("- {}\n", escaped(note));
    return text;
}

}  // namespace ptb
