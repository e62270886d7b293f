#include "core/tree/partition.h"

#include <algorithm>
#include <utility>

namespace ptb::tree {
namespace {

enum class Side { near, far, both };

/// Moves references from [first, end) to both ends of [begin, end), near ones to its begin. `choose` says
/// where one goes, and cuts it into two if that is both: as often as there are places in [begin, first).
template <class Iterator, class Choose>
void part_towards_ends(Iterator begin, Iterator first, Iterator end, Group& near, Group& far,
                       const Choose& choose) {
    while (first != end) {
        Reference reference = *first, other;
        const Side side = choose(reference, other);
        if (side == Side::near) {
            ++first;
        } else {
            *first = *--end;
            *end = side == Side::far ? reference : other;
            far.take(*end);
        }
        if (side != Side::far) {
            *begin++ = reference;
            near.take(reference);
        }
    }
}

Side other_side(Side side) {
    return side == Side::near ? Side::far : side == Side::far ? Side::near : Side::both;
}

/// The room between what went left and what went right, shared out by their numbers.
Halves share_room(const Range& range, const Group& left, const Group& right) {
    Halves halves{{range.begin, nullptr, range.begin, range.begin + left.count, left},
                  {nullptr, range.end, range.end - right.count, range.end, right}};
    const auto room = static_cast<std::size_t>(halves.right.first - halves.left.beyond);
    halves.left.end = halves.left.beyond + room * left.count / (left.count + right.count);
    halves.right.begin = halves.left.end;
    return halves;
}

/// `choose(reference, other)` says whether left (near), right (far), or both: then `reference` is the left
/// part.
template <class Choose>
Halves part_by(const Range& range, const Choose& choose) {
    Group left, right;
    if (range.beyond == range.end) {
        part_towards_ends(range.begin, range.first, range.end, left, right, choose);
    } else {
        const auto mirrored = [&choose](Reference& reference, Reference& other) {
            const Side side = choose(reference, other);
            if (side == Side::both) std::swap(reference, other);
            return other_side(side);
        };
        using Backwards = std::reverse_iterator<Reference*>;
        part_towards_ends(Backwards(range.end), Backwards(range.beyond), Backwards(range.begin), right, left,
                          mirrored);
    }
    return share_room(range, left, right);
}

Halves part_objects(const Range& range, const Split& split) {
    return part_by(range, [&](const Reference& reference, Reference&) {
        return split.grid.bin_of(place_of(reference))[split.axis] <= split.bin ? Side::near : Side::far;
    });
}

/// Whether a reference that the plane cuts is better off in both children or in one, which it makes larger.
Side side_of_cut(const Reference& reference, const Split& split) {
    const auto left_n = static_cast<float>(split.left_count), right_n = static_cast<float>(split.right_count);
    const float left = half_area(split.left), right = half_area(split.right);
    const float both = left * left_n + right * right_n;
    const float only_left = half_area(join(split.left, reference)) * left_n + right * (right_n - 1);
    const float only_right = left * (left_n - 1) + half_area(join(split.right, reference)) * right_n;
    if (both < std::min(only_left, only_right)) return Side::both;
    return only_left <= only_right ? Side::near : Side::far;
}

Halves part_space(const Range& range, const Split& split, const Soup& soup) {
    const float plane = plane_of(split);
    return part_by(range, [&](Reference& reference, Reference& other) {
        const Span span = span_of(reference, split.grid);
        if (span.last[split.axis] <= split.bin) return Side::near;
        if (span.first[split.axis] > split.bin) return Side::far;
        const Side side = side_of_cut(reference, split);
        if (side != Side::both) return side;
        const auto [below, above] = soup.cut(reference, split.axis, plane);
        if (empty(above)) return Side::near;
        if (empty(below)) return Side::far;
        reference = below;
        other = above;
        return Side::both;
    });
}

}  // namespace

Halves part(const Range& range, const Split& split, const Soup* soup_of_spatial_split) {
    return soup_of_spatial_split ? part_space(range, split, *soup_of_spatial_split)
                                 : part_objects(range, split);
}

Halves halve(const Range& range) {
    const Float4 width = range.group.places.high - range.group.places.low;
    int axis = 0;
    for (int i = 1; i < 3; ++i) axis = width[i] > width[axis] ? i : axis;
    const auto before = [axis](const Reference& a, const Reference& b) {
        const float x = place_of(a)[axis], y = place_of(b)[axis];
        return x != y ? x < y : a.number() < b.number();
    };
    Reference* const middle = range.first + (range.beyond - range.first) / 2;
    std::nth_element(range.first, middle, range.beyond, before);
    Halves halves{{range.begin, middle, range.first, middle, {}},
                  {middle, range.end, middle, range.beyond, {}}};
    for (Range* half : {&halves.left, &halves.right})
        for (const Reference& reference : half->references()) half->group.take(reference);
    return halves;
}

}  // namespace ptb::tree
