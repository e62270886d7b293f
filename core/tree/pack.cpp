#include "core/tree/pack.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace ptb::tree {

namespace {

float unit_in_the_last_place(float value) {
    constexpr int least = std::numeric_limits<float>::min_exponent - 1;
    const int exponent = value > 0 ? std::max(std::ilogb(value), least) : least;
    return std::ldexp(1.0f, exponent - (std::numeric_limits<float>::digits - 1));
}

}  // namespace

Padding::Padding(const Soup& soup, const TreeSettings& settings)
    : unit_(static_cast<float>(soup.unit())),
      margin_(2 * unit_in_the_last_place(std::max(soup.largest_coordinate(), settings.origin_most))),
      origin_most_(settings.origin_most) {}

Box Padding::pad(const BinaryNode& node) const {
    const Box box = box_of(node);
    return {box.low * unit_ - all(margin_), box.high * unit_ + all(margin_)};
}

void check_leaf(std::size_t count, std::size_t most) {
    if (count > most)
        throw std::logic_error(fmt::format("a leaf of {} triangles: the layout holds {}", count, most));
}

}  // namespace ptb::tree
