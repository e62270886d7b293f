#include "core/tree/bins.h"

#include <algorithm>

namespace ptb::tree {
namespace {

/// What lies on one side of a cut, on four axes at once.
struct FourSides {
    Box box[4] = {nothing, nothing, nothing, nothing};
    Int4 count{};

    void take(const Box (&bin)[4], Int4 more) {
        for (int axis = 0; axis < 4; ++axis) grow(box[axis], bin[axis]);
        count += more;
    }
    Float4 work() const { return half_areas(box) * to_float(count); }
};

Int4 all_ints(std::size_t value) {
    const auto i = static_cast<std::int32_t>(value);
    return Int4{i, i, i, i};
}

struct FourCuts {
    Float4 work = all(infinity);
    Int4 bin{};
};

FourCuts best_of_each_axis(const Bins& bins, const Limits& limits) {
    const Int4 all_of_them = all_ints(limits.count), most = all_ints(limits.most);
    Float4 right_work[most_bins];
    Int4 right_count[most_bins];
    FourSides right;
    for (int b = bins.count - 1; b > 0; --b) {
        right.take(bins.box[b], bins.end[b]);
        right_work[b] = right.work();
        right_count[b] = right.count;
    }
    FourCuts best;
    FourSides left;
    for (int b = 0; b + 1 < bins.count; ++b) {
        left.take(bins.box[b], bins.begin[b]);
        const Float4 work = left.work() + right_work[b + 1];
        const Int4 more = right_count[b + 1];
        const Int4 both = left.count + more;  // none on an axis that was left out
        const Int4 allowed =
            (left.count < all_of_them) & (more < all_of_them) & (both >= all_of_them) & (both <= most);
        const Int4 better = allowed & (work < best.work);
        best.work = better ? work : best.work;
        best.bin = better ? Int4{b, b, b, b} : best.bin;
    }
    return best;
}

}  // namespace

Split best_cut(const Bins& bins, const Grid& grid, const Limits& limits) {
    const FourCuts cuts = best_of_each_axis(bins, limits);
    Split best;
    best.grid = grid;
    for (int axis = 0; axis < 4; ++axis) {
        if (cuts.work[axis] >= best.work) continue;
        best.work = cuts.work[axis];
        best.axis = axis;
        best.bin = cuts.bin[axis];
    }
    if (!best.found()) return best;
    for (int b = 0; b < bins.count; ++b) {
        const bool on_left = b <= best.bin;
        grow(on_left ? best.left : best.right, bins.box[b][best.axis]);
        if (on_left)
            best.left_count += static_cast<std::size_t>(bins.begin[b][best.axis]);
        else
            best.right_count += static_cast<std::size_t>(bins.end[b][best.axis]);
    }
    return best;
}

}  // namespace ptb::tree
