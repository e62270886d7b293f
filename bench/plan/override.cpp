#include <algorithm>

#include "bench/plan/config.h"

namespace ptb {
namespace {

/// Takes a name out of an axis; points that become equal stay once.
void drop_name(Axis& axis, const std::string& name) {
    const auto found = std::find(axis.names.begin(), axis.names.end(), name);
    if (found == axis.names.end()) return;
    const auto column = found - axis.names.begin();
    axis.names.erase(found);
    std::vector<std::vector<std::string>> points;
    for (auto& point : axis.points) {
        point.erase(point.begin() + column);
        if (std::find(points.begin(), points.end(), point) == points.end()) points.push_back(point);
    }
    axis.points = std::move(points);
}

}  // namespace

void override_axis(Config& config, const Axis& axis) {
    if (config.series.empty()) config.series.push_back({config.name, {}, {}});
    for (Series& series : config.series) {
        for (Axis& old : series.axes)
            for (const auto& name : axis.names) drop_name(old, name);
        std::erase_if(series.axes, [](const Axis& old) { return old.names.empty(); });
        series.axes.push_back(axis);
    }
}

}  // namespace ptb
