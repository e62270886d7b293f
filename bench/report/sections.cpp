#include "bench/report/sections.h"

#include <fmt/format.h>

#include "bench/report/markdown.h"
#include "bench/report/table.h"

namespace ptb {

std::vector<Section> report_sections(const ResultFile& result, const PublishedTable& published) {
    std::vector<Section> sections;
    std::vector<Section> all = {times_section(result),   fits_section(result),    problems_section(result),
                                devices_section(result), kernels_section(result), efficiency_section(result)};
    for (Section& section : sweep_sections(result)) all.push_back(std::move(section));
    for (const Section& section :
         {shared_section(result), peaks_section(result.peaks), limits_section(result.cases),
          trees_section(result.cases), published_section(result, published), summary_section(result),
          remarks_section(result)})
        all.push_back(section);
    for (Section& section : all)
        if (!section.grid.rows.empty() || (section.grid.columns.empty() && !section.notes.empty()))
            sections.push_back(std::move(section));
    return sections;
}

std::string joined(const std::vector<Section>& sections,
                   const std::function<std::string(const Section&)>& render) {
    std::vector<std::string> texts;
    for (const Section& section : sections) texts.push_back(render(section));
    return fmt::format("{}", fmt::join(texts, "\n"));
}

std::string table(const ResultFile& result, const PublishedTable& published, const TextStyle& style) {
    return joined(report_sections(result, published),
                  [&](const Section& section) { return to_text(section, style); });
}

std::string markdown(const ResultFile& result, const PublishedTable& published) {
    return joined(report_sections(result, published), to_markdown);
}

}  // namespace ptb
