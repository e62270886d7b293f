#include <algorithm>

#include "core/tree/bins.h"
#include "core/tree/split.h"

namespace ptb::tree {
namespace {

/// Whether a plane across the axis parts anything: needles side by side may all be on both sides of any
/// plane.
bool parts_anything(const Bins& bins, int axis, const Limits& limits) {
    std::size_t left = 0, right = limits.count;
    for (int b = 0; b + 1 < bins.count; ++b) {
        left += static_cast<std::size_t>(bins.begin[b][axis]);
        right -= static_cast<std::size_t>(bins.end[b][axis]);
        if (std::max(left, right) < limits.count && left + right <= limits.most) return true;
    }
    return false;
}

/// Puts the parts of a reference into the bins of an axis that it spans.
void take_parts(Bins& bins, Reference rest, int axis, Span span, const Grid& grid, const Soup& soup) {
    int bin = span.first[axis];
    for (; bin < span.last[axis]; ++bin) {
        const float plane = grid.base[axis] + static_cast<float>(bin + 1) / grid.scale[axis];
        const auto [part, beyond] = soup.cut(rest, axis, plane);
        grow(bins.box[bin][axis], part);
        rest = beyond;
    }
    grow(bins.box[bin][axis], rest);
}

}  // namespace

Split find_spatial_split(const Group& group, std::span<const Reference> references, std::size_t room,
                         const Soup& soup, const TreeSettings& settings, Crew& crew) {
    const Limits limits{references.size(), references.size() + room};
    Bins bins(settings.bins);
    const Grid grid = grid_over(group.box, bins.count);
    fill(bins, references.size(), crew, [&](Bins& some, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Span span = span_of(references[i], grid);
            for (int axis = 0; axis < 3; ++axis) {
                ++some.begin[span.first[axis]][axis];
                ++some.end[span.last[axis]][axis];
            }
        }
    });
    bool parts[3];
    for (int axis = 0; axis < 3; ++axis) parts[axis] = parts_anything(bins, axis, limits);
    if (!parts[0] && !parts[1] && !parts[2]) return {};
    fill(bins, references.size(), crew, [&](Bins& some, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Span span = span_of(references[i], grid);
            for (int axis = 0; axis < 3; ++axis)
                if (parts[axis]) take_parts(some, references[i], axis, span, grid, soup);
        }
    });
    return best_cut(bins, grid, limits);
}

}  // namespace ptb::tree
