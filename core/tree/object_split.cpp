#include <algorithm>

#include "core/tree/bins.h"
#include "core/tree/split.h"

namespace ptb::tree {

Split find_object_split(const Group& group, std::span<const Reference> references,
                        const TreeSettings& settings, Crew& crew) {
    const auto few = static_cast<int>(std::min<std::size_t>(references.size(), most_bins));
    Bins bins(std::min(settings.bins, std::max(4, few)));
    Grid grid = grid_over(group.places, bins.count);
    if (!settings.size_axis) grid.scale[3] = 0;
    fill(bins, references.size(), crew, [&](Bins& some, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Int4 bin = grid.bin_of(place_of(references[i]));
            for (int axis = 0; axis < 4; ++axis) {
                grow(some.box[bin[axis]][axis], references[i]);
                ++some.begin[bin[axis]][axis];
            }
        }
    });
    std::copy(bins.begin, bins.begin + bins.count, bins.end);  // all lie in one bin
    return best_cut(bins, grid, {references.size(), references.size()});
}

}  // namespace ptb::tree
