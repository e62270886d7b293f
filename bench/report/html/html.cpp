#include "bench/report/html/html.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/input/printable.h"

namespace ptb {
namespace {

/// End tags of cells, dt and dd may be left out, and there are thousands.
std::string cell(const Column& column, const std::string& text, const std::string& link) {
    if (column.bar) return fmt::format("<td><meter value=\"{0}\">{0}</meter>", html_text(text));
    const std::string safe = html_text(text);
    const std::string content =
        link.empty() ? safe : fmt::format("<a href=\"#{}\">{}</a>", html_text(link), safe);
    return fmt::format("<td{}>{}", column.number ? " class=n" : "", content);
}

std::string head(const Grid& grid, const TableExtras& extras) {
    std::string cells;
    for (std::size_t j = 0; j < grid.columns.size(); ++j) {
        if (j == extras.place && !extras.cells.empty())
            cells += fmt::format("<th scope=col>{}", html_text(extras.title));
        cells += fmt::format("<th scope=col{}>{}", grid.columns[j].number ? " class=n" : "",
                             html_text(grid.columns[j].title));
    }
    return cells;
}

std::string row(const Grid& grid, std::size_t i, const TableExtras& extras) {
    std::string cells;
    for (std::size_t j = 0; j < grid.columns.size(); ++j) {
        if (j == extras.place && !extras.cells.empty()) cells += "<td>" + extras.cells[i];
        cells +=
            cell(grid.columns[j], grid.rows[i][j], j == 0 && !extras.links.empty() ? extras.links[i] : "");
    }
    return fmt::format("<tr{}>{}</tr>\n", grid.best.contains(i) ? " class=best" : "", cells);
}

std::string value_text(const Json& json) {
    return json.is_string() ? html_text(json.get_ref<const std::string&>()) : html_text(dump_json(json));
}

}  // namespace

std::string html_text(std::string_view text) {
    std::string safe;
    for (const char c : printable(text)) {
        switch (c) {
            case '&':
                safe += "&amp;";
                break;
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '"':
                safe += "&quot;";
                break;
            case '\'':
                safe += "&#39;";
                break;
            default:
                safe += c;
        }
    }
    return safe;
}

std::string html_lines(std::string_view text) {
    std::string html;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        html += html_text(text.substr(0, end)) + "\n";
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return html;
}

std::string html_paragraphs(const std::vector<std::string>& texts) {
    std::string html;
    for (const std::string& text : texts) html += fmt::format("<p>{}</p>\n", html_text(text));
    return html;
}

std::string html_table(const Grid& grid, const std::string& caption, const TableExtras& extras) {
    std::string body;
    for (std::size_t i = 0; i < grid.rows.size(); ++i) body += row(grid, i, extras);
    return fmt::format(
        "<div class=\"scroll\" tabindex=\"0\"><table class=\"{}\"><caption>{}</caption>"
        "<thead><tr>{}</tr><tbody>\n{}</table></div>\n",
        extras.css_class, html_text(caption), head(grid, extras), body);
}

std::string to_html(const Section& section) {
    if (section.grid.rows.empty())
        return section.notes.empty()
                   ? ""
                   : fmt::format("<h3>{}</h3>\n", html_text(section.title)) + html_paragraphs(section.notes);
    return html_table(section.grid, section.title) + html_paragraphs(section.notes);
}

std::string html_facts(const Json& json) {
    if (!json.is_structured()) return value_text(json);
    if (json.empty()) return "-";
    std::string items;
    for (const auto& [key, value] : json.items())
        items += fmt::format("<dt>{}<dd>{}", html_text(key), html_facts(value));
    return fmt::format("<dl>{}</dl>\n", items);
}

std::string filled(std::string_view text,
                   const std::vector<std::pair<std::string_view, std::string>>& values) {
    std::string result;
    while (!text.empty()) {
        const auto at = text.find('@');
        result += text.substr(0, at);
        text.remove_prefix(std::min(at, text.size()));
        const std::pair<std::string_view, std::string>* found = nullptr;
        for (const auto& value : values)
            if (text.starts_with(fmt::format("@{}@", value.first))) found = &value;
        if (found != nullptr)
            result += found->second;
        else
            result += text.substr(0, 1);
        text.remove_prefix(found != nullptr ? found->first.size() + 2
                                            : std::min<std::size_t>(1, text.size()));
    }
    return result;
}

}  // namespace ptb
