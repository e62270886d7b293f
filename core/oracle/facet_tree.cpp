#include "core/oracle/facet_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace ptb {
namespace {

constexpr std::uint32_t leaf_most = 4;
constexpr std::size_t bins = 16;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr FacetBox nothing{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

double part(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

FacetBox around(const FacetBox& a, const FacetBox& b) {
    return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
            {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

double half_area(const FacetBox& box) {
    const Vec3 size = box.high - box.low;
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

double twice_middle(const FacetBox& box, int axis) { return part(box.low, axis) + part(box.high, axis); }

/// A cut of some boxes by the bins of their middles.
struct Cut {
    double cost = infinity;  ///< half areas times boxes, of both sides
    int axis = 0;
    std::size_t bin = 0;  ///< the last one of the first side
};

/// Bins of equal width between the smallest and the largest middle.
struct Bins {
    int axis;
    double least, width;

    std::size_t operator()(const FacetBox& box) const {
        const double bin = (twice_middle(box, axis) - least) / width;
        return std::min(static_cast<std::size_t>(bin), bins - 1);
    }
};

struct Bin {
    FacetBox box = nothing;
    double boxes = 0;

    void add(const FacetBox& more, double count) {
        box = around(box, more);
        boxes += count;
    }
    double cost() const { return boxes > 0 ? half_area(box) * boxes : 0; }
};

Bins bins_of(std::span<const FacetBox> boxes, std::span<const int> numbers, int axis) {
    double least = infinity, largest = -infinity;
    for (const int number : numbers) {
        const double middle = twice_middle(boxes[static_cast<std::size_t>(number)], axis);
        least = std::min(least, middle);
        largest = std::max(largest, middle);
    }
    return {axis, least, (largest - least) / bins};
}

Cut best_cut(std::span<const FacetBox> boxes, std::span<const int> numbers, const Bins& bin_of) {
    std::array<Bin, bins> filled;
    for (const int number : numbers) {
        const FacetBox& box = boxes[static_cast<std::size_t>(number)];
        filled[bin_of(box)].add(box, 1);
    }
    std::array<double, bins> first_cost{};
    Bin first;
    for (std::size_t i = 0; i < bins; ++i) {
        first.add(filled[i].box, filled[i].boxes);
        first_cost[i] = first.cost();
    }
    Cut best;
    Bin second;
    for (std::size_t i = bins - 1; i > 0; --i) {
        second.add(filled[i].box, filled[i].boxes);
        const double cost = first_cost[i - 1] + second.cost();
        if (cost < best.cost) best = {cost, bin_of.axis, i - 1};
    }
    return best;
}

/// Sorts the numbers into two sides; returns how many are on the first, and the axis of the cut.
std::pair<std::uint32_t, int> halve(std::span<const FacetBox> boxes, std::span<int> numbers,
                                    bool by_heuristic) {
    Cut best;
    std::array<Bins, 3> bins_on{};
    for (int axis = 0; axis < 3 && by_heuristic; ++axis) {
        Bins& bin_of = bins_on[static_cast<std::size_t>(axis)] = bins_of(boxes, numbers, axis);
        if (!(bin_of.width > 0)) continue;
        const Cut cut = best_cut(boxes, numbers, bin_of);
        if (cut.cost < best.cost) best = cut;
    }
    const Bins& bin_of = bins_on[static_cast<std::size_t>(best.axis)];
    const auto middle = std::partition(numbers.begin(), numbers.end(), [&](int number) {
        return bin_of.width > 0 && bin_of(boxes[static_cast<std::size_t>(number)]) <= best.bin;
    });
    const auto first = static_cast<std::uint32_t>(middle - numbers.begin());
    const bool parted = first > 0 && first < numbers.size();
    return {parted ? first : static_cast<std::uint32_t>(numbers.size() / 2), best.axis};
}

}  // namespace

FacetTree::FacetTree(std::span<const FacetBox> boxes) : numbers_(boxes.size()) {
    std::iota(numbers_.begin(), numbers_.end(), 0);
    if (!boxes.empty()) grow(boxes, 0, static_cast<std::uint32_t>(boxes.size()), 0);
}

void FacetTree::grow(std::span<const FacetBox> boxes, std::uint32_t begin, std::uint32_t end, int depth) {
    const std::size_t node = nodes_.size();
    const std::span<int> numbers = std::span(numbers_).subspan(begin, end - begin);
    FacetBox box = nothing;
    for (const int number : numbers) box = around(box, boxes[static_cast<std::size_t>(number)]);
    nodes_.push_back({box, begin, end - begin, 0});
    if (numbers.size() <= leaf_most) return;
    const auto [first, axis] = halve(boxes, numbers, depth < depth_most);
    grow(boxes, begin, begin + first, depth + 1);
    nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].count = 0;
    nodes_[node].axis = axis;
    grow(boxes, begin + first, end, depth + 1);
}

}  // namespace ptb
