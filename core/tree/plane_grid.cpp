#include "core/tree/plane_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace ptb::tree {
namespace {

// In grid coordinates.
constexpr double grid_begin = 0.5, grid_end = 2 - 0x1p-15;
constexpr double slack = 0x1p-23;       ///< by which a wall at the end of the grid may miss its plane
constexpr double slab_error = 0x1p-21;  ///< of a ray's way through planes, where it begins on the grid

constexpr double least_extent = 0x1p-8;  ///< of an axis, of the largest
constexpr float coarsest_room = 0.25f;   ///< a place without a child is not entered, either
constexpr std::uint32_t last_plane = 0xffff;

/// The last one that is not beyond.
std::uint32_t plane_before(double coordinate) {
    const auto at = static_cast<float>(std::clamp(coordinate, grid_begin, grid_end));
    const std::uint32_t number = (std::bit_cast<std::uint32_t>(at) - TREE_PLANE) >> 8;
    return number > 0 && plane(number) > coordinate ? number - 1 : number;
}

std::uint32_t plane_behind(double coordinate) {
    const std::uint32_t number = plane_before(coordinate);
    return number < last_plane && plane(number) < coordinate ? number + 1 : number;
}

/// What a ray's way is wrong by grows with how far from the grid it begins.
double margins(const Load& load, const Box& whole, int axis) {
    const float reach = std::max(-whole.low[axis], whole.high[axis]) * load.padding.unit();
    return load.padding.origin_most() > reach ? 5 : 3;
}

float& part(ptb_float4& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
float part(const ptb_float4& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

double plane(std::uint32_t number) { return std::bit_cast<float>(TREE_PLANE | number << 8); }

PlaneGrid::PlaneGrid(const Load& load) : unit_(load.padding.unit()) {
    const Box whole = load.binary.nodes.empty() ? Box{all(0), all(0)} : box_of(load.binary.nodes[0]);
    const double largest = std::max({extent(whole, 0), extent(whole, 1), extent(whole, 2)});
    for (int axis = 0; axis < 3; ++axis) {
        const double wide = largest > 0 ? std::max(extent(whole, axis), least_extent * largest) : 1;
        const auto cells = static_cast<float>((grid_end - grid_begin) / wide);
        part(facts_.low, axis) = static_cast<float>(whole.low[axis] * unit_);
        part(facts_.cells, axis) = cells;
        part(facts_.cell, axis) = 1 / cells;
        part(facts_.room, axis) = static_cast<float>(
            margins(load, whole, axis) * load.padding.margin() * cells + slab_error + slack);
    }
}

std::uint32_t PlaneGrid::around(const Box& box, int axis) const {
    return plane_before(seen(box.low[axis], axis) + slack) | plane_behind(seen(box.high[axis], axis) - slack)
                                                                 << 16;
}

Box PlaneGrid::rounded(const Box& box) const {
    Box larger{};
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t planes = around(box, axis);
        const auto at = [&](std::uint32_t number) {
            return static_cast<float>((plane(number) - grid_begin) / part(facts_.cells, axis) / unit_);
        };
        larger.low[axis] = at(planes & last_plane);
        larger.high[axis] = at(planes >> 16);
    }
    return larger;
}

double PlaneGrid::extent(const Box& box, int axis) const {
    return (double{box.high[axis]} - box.low[axis]) * unit_;
}

double PlaneGrid::seen(float coordinate, int axis) const {
    return (coordinate * unit_ - part(facts_.low, axis)) * part(facts_.cells, axis) + grid_begin;
}

double grid_growth(const Load& load) {
    const PlaneGrid grid(load);
    const auto sound = [](float room) { return room < coarsest_room; };  // which no NaN is
    const ptb_float4& room = grid.facts().room;
    if (!sound(room.x) || !sound(room.y) || !sound(room.z)) return std::numeric_limits<double>::infinity();
    double logarithms = 0, leaves = 0;
    for (const BinaryNode& node : load.binary.nodes) {
        const double before = half_area(box_of(node));
        if (node.count == 0 || !(before > 0)) continue;
        logarithms += std::log2(half_area(grid.rounded(box_of(node))) / before);
        ++leaves;
    }
    return leaves > 0 ? std::exp2(logarithms / leaves) : 1;
}

}  // namespace ptb::tree
