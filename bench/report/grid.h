#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace ptb {

struct Column {
    std::string title;
    bool number = false;   ///< aligned to the right
    std::size_t most = 0;  ///< characters a terminal shows of a cell; 0: all
    bool bar = false;      ///< cells are shares from 0 to 1, to be drawn
};

/// A table of text, whatever it will be written as. Cells hold text as it came: renderers make it safe.
struct Grid {
    std::vector<Column> columns;
    std::vector<std::vector<std::string>> rows;
    std::vector<std::size_t> cases{};  ///< of the rows, their places in the result; or empty
    std::set<std::size_t> best{};      ///< rows to stand out
};

/// Part of a report: a grid under a title, and remarks beneath it.
struct Section {
    std::string title;
    Grid grid;
    std::vector<std::string> notes;
};

/// What a terminal can show.
struct TextStyle {
    std::size_t columns = 0;  ///< 0: no limit
    bool colour = false;
};

/// For a terminal: columns as narrow as their cells, two spaces between them. Where that is too wide, text is
/// wrapped within its columns.
std::string to_text(const Section& section, const TextStyle& style = {});
/// Section below section, each as `render` shows it.
std::string joined(const std::vector<Section>& sections,
                   const std::function<std::string(const Section&)>& render);
/// As a GitHub-flavoured Markdown table, without bars.
std::string to_markdown(const Section& section);

}  // namespace ptb
