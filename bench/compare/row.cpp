#include "bench/compare/row.h"

#include <fmt/format.h>

#include "bench/plan/config.h"

namespace ptb {

Change change_of(const std::vector<Row>& rows, const Rules& rules) {
    Change change;
    for (const Row& row : rows) {
        const State state = row.finding.state;
        const bool gates = row.advisory.empty();
        const bool too_noisy = rules.require_mde > 0 && !(row.finding.smallest_effect <= rules.require_mde);
        if (row.compared()) change.nothing_compared = false;
        change.regressed |= gates && state == State::regressed;
        change.coverage_lost |= state == State::missing && !rules.allow_missing;
        change.inconclusive |= row.compared() && too_noisy;
        change.inconclusive |= rules.strict && (state == State::inconclusive || !gates);
    }
    return change;
}

std::string case_text(const Case& c) {
    std::string text =
        fmt::format("{} {} {} spp {} length {}", c.kernel, c.scene, to_string(c.size), c.spp, c.path_length);
    if (!c.work_group.implicit()) text += " wg " + to_string(c.work_group);
    if (c.lanes != 0) text += fmt::format(" lanes {}", c.lanes);
    if (c.devices != 1) text += " devices " + case_value(c, "devices");
    if (c.together != Together::no) text += " together " + case_value(c, "together");
    const std::string variant = to_string(c.variant);
    return variant.empty() ? text : text + " " + variant;
}

}  // namespace ptb
