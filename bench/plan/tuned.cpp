#include "bench/plan/tuned.h"

#include <algorithm>

#include <fmt/format.h>

namespace ptb {
namespace {

bool names(const Series& series, const std::string& axis) {
    return std::any_of(series.axes.begin(), series.axes.end(), [&](const Axis& each) {
        return std::find(each.names.begin(), each.names.end(), axis) != each.names.end();
    });
}

}  // namespace

void apply_tuned(Case& c, const Series& series, const std::vector<Case>& tuned) {
    const auto best = std::find_if(tuned.begin(), tuned.end(), [&](const Case& t) {
        return t.device == c.device && t.kernel == c.kernel;
    });
    if (best == tuned.end() || c.variant != best->variant) return;
    if (!names(series, "lanes")) {
        c.lanes = best->lanes;
        c.lanes_tuned = true;
    }
    if (c.lanes != best->lanes || names(series, "work_group")) return;
    c.work_group = best->work_group;
    c.work_group_tuned = true;
}

Case as_asked(Case c) {
    if (c.lanes_tuned) c.lanes = 0;
    if (c.work_group_tuned) c.work_group = {};
    c.lanes_tuned = c.work_group_tuned = false;
    return c;
}

std::string launch_text(const Case& c) {
    return fmt::format("lanes {}, work-group {}", case_value(c, "lanes"), to_string(c.work_group));
}

}  // namespace ptb
