#include "core/tree/settings.h"

#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace ptb {
namespace {

template <class T>
void check_range(const char* name, T value, T least, T most) {
    if (value >= least && value <= most) return;  // which no NaN does
    throw std::invalid_argument(
        fmt::format("tree setting {} {}: must be {} to {}", name, value, least, most));
}

}  // namespace

void check(const TreeSettings& settings) {
    check_range("bins", settings.bins, 2, 32);
    check_range("depth_most", settings.depth_most, 30, 64);
    check_range("origin_most", settings.origin_most, 0.0f, 1e30f);
    check_range("grid_growth_most", settings.grid_growth_most, 0.0, std::numeric_limits<double>::infinity());
    check_range("spatial.alpha", settings.spatial.alpha, 0.0f, 1.0f);
    check_range("spatial.depth_most", settings.spatial.depth_most, 0, 64);
    check_range("spatial.room", settings.spatial.room, 0.0f, 3.0f);
    check_range("reinsertion.passes_most", settings.reinsertion.passes_most, 0, 100);
    check_range("reinsertion.gain_least", settings.reinsertion.gain_least, 0.0f, 1.0f);
    check_range("cost.triangle", settings.cost.triangle, 0.01f, 100.0f);
    check_range("cost.block", settings.cost.block, 0.01f, 100.0f);
}

}  // namespace ptb
