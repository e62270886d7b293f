#include <fmt/format.h>

#include "bench/report/formats/formats.h"
#include "bench/report/sections.h"

namespace ptb {
namespace {

constexpr std::size_t most_bytes = 1'000'000;  ///< GitHub shows no summary of more than 1 MiB

/// Rows that fit into `bytes`, with a note of what is left out.
std::string fitted(Section section, std::size_t bytes) {
    const std::size_t all = section.grid.rows.size();
    while (!section.grid.rows.empty() && to_markdown(section).size() > bytes)
        section.grid.rows.resize(section.grid.rows.size() / 2);
    if (section.grid.rows.size() < all)
        section.notes.push_back(
            fmt::format("{} of {} rows; the result file has all", section.grid.rows.size(), all));
    return to_markdown(section);
}

}  // namespace

std::string step_summary(const ResultFile& result) {
    std::string text = to_markdown(summary_section(result));
    for (const Section& section : {problems_section(result), remarks_section(result)})
        if (!section.grid.rows.empty() || !section.notes.empty())
            text += "\n" + fitted(section, most_bytes / 8);
    const Section times = times_section(result);
    if (times.grid.rows.empty()) return text;
    return text + "\n<details><summary>times</summary>\n\n" + fitted(times, most_bytes / 2) +
           "\n</details>\n";
}

}  // namespace ptb
