#pragma once

#include <string>
#include <vector>

namespace ptb {

struct Column {
    std::string title;
    bool number = false;   ///< aligned to the right
    std::size_t most = 0;  ///< characters a terminal shows of a cell; 0: all
};

/// A table of text, whatever it will be written as. Cells hold text as it came: renderers make it safe.
struct Grid {
    std::vector<Column> columns;
    std::vector<std::vector<std::string>> rows;
};

/// Part of a report: a grid under a title, and remarks beneath it.
struct Section {
    std::string title;
    Grid grid;
    std::vector<std::string> notes;
};

/// For a terminal: columns as narrow as their cells, two spaces between them.
std::string to_text(const Section& section);
/// As a GitHub-flavoured Markdown table.
std::string to_markdown(const Section& section);

}  // namespace ptb
