#include "bench/compare/gate_json.h"
#include "bench/compare/sessions.h"

namespace ptb {

template <>
inline constexpr auto fields<Row> = std::make_tuple(field("device", &Row::device), field("case", &Row::name),
                                                    field("tolerance", &Row::tolerance),
                                                    field("finding", &Row::finding),
                                                    field("advisory", &Row::advisory),
                                                    field("note", &Row::note),
                                                    field("efficiency_ratio", &Row::efficiency_ratio));

std::string comparison_text(const Comparison& comparison) {
    Json json = Json::object();
    json["schema"] = "ptbench.compare.v1";
    json["differing"] = comparison.differing;
    json["notes"] = comparison.notes;
    json["rows"] = encode(comparison.rows);
    return dump_json(json, 2) + "\n";
}

}  // namespace ptb
