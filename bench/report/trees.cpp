#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

/// What decides a tree, and the way that rays go through it.
auto search_of(const Record& record) {
    const Case& c = record.params;
    return std::tie(c.device, c.kernel, c.scene, c.path_length, c.variant.bvh, c.variant.bvh_split);
}

/// The first record of each, or the first one that was counted.
std::vector<Record> each_search(const std::vector<Record>& records) {
    std::vector<Record> found;
    for (const Record& record : records) {
        if (!record.tree) continue;
        const auto same = std::find_if(found.begin(), found.end(), [&](const Record& other) {
            return search_of(other) == search_of(record);
        });
        if (same == found.end())
            found.push_back(record);
        else if (!same->counted && record.counted)
            *same = record;
    }
    return found;
}

std::vector<std::string> tree_cells(const Record& record) {
    const TreeRecord& tree = *record.tree;
    const auto triangles = static_cast<double>(std::max<std::uint64_t>(tree.triangles, 1));
    const auto counted = [&](std::optional<double> Counted::*member) {
        const auto value = record.counted ? *record.counted.*member : std::nullopt;
        return value ? number_text(*value) : "-";
    };
    return {record.params.device,
            record.params.kernel,
            record.params.scene,
            tree.layout,
            variant_value("bvh_split", record.params.variant),
            std::to_string(tree.triangles),
            number_text(static_cast<double>(tree.references) / triangles),
            number_text(static_cast<double>(tree.bytes) / triangles),
            std::to_string(tree.depth),
            number_text(tree.build_ms),
            number_text(tree.sah_cost),
            counted(&Counted::nodes_per_ray),
            counted(&Counted::triangles_per_ray)};
}

}  // namespace

Section trees_section(const std::vector<Record>& records) {
    Section section;
    section.title = "trees of triangles";
    section.grid.columns = {{"device"},
                            {"kernel"},
                            {"scene"},
                            {"bvh"},
                            {"bvh_split"},
                            {"triangles", true},
                            {"references a triangle", true},
                            {"bytes a triangle", true},
                            {"depth", true},
                            {"build ms", true},
                            {"SAH cost", true},
                            {"nodes a ray", true},
                            {"triangles a ray", true}};
    const std::vector<Record> searches = each_search(records);
    for (const Record& record : searches) section.grid.rows.push_back(tree_cells(record));
    const bool counted = std::any_of(searches.begin(), searches.end(),
                                     [](const Record& record) { return record.counted.has_value(); });
    if (!searches.empty() && !counted)
        section.notes.push_back(
            "What a ray meets is counted with --peaks; the SAH cost is what is expected of it.");
    return section;
}

}  // namespace ptb
