#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/report/grid.h"
#include "core/input/json.h"

namespace ptb {

/// Untrusted text as HTML, between tags or between the quotes of an attribute.
std::string html_text(std::string_view text);

/// Untrusted text whose lines are kept.
std::string html_lines(std::string_view text);

/// `<p>text</p>` for each.
std::string html_paragraphs(const std::vector<std::string>& texts);

/// What a table has beside its grid: a class, ids of this page that rows lead to, and a column of HTML before
/// the one at `place`.
struct TableExtras {
    std::string css_class;
    std::vector<std::string> links;  ///< one a row, or empty
    std::string title;               ///< of that column
    std::vector<std::string> cells;  ///< of that column, one a row, or empty
    std::size_t place = 0;
};
std::string html_table(const Grid& grid, const std::string& caption, const TableExtras& extras = {});

/// A section as a table under its title, remarks beneath it.
std::string to_html(const Section& section);

/// What is in a JSON value, as nested lists of names and values.
std::string html_facts(const Json& json);

/// `text` with each @NAME@ replaced; what is put in is not looked at again.
std::string filled(std::string_view text,
                   const std::vector<std::pair<std::string_view, std::string>>& values);

}  // namespace ptb
