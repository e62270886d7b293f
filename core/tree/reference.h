#pragma once

#include <bit>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/tree/box.h"
#include "core/tree/crew.h"
#include "core/tree/triangle.h"

namespace ptb::tree {

/// A triangle, or the part of it that a split of space left, by its box. The last lane of `low` has the
/// box's size, that of `high` the bits of the triangle's number.
struct Reference : Box {
    std::uint32_t number() const { return std::bit_cast<std::uint32_t>(high[3]); }
};

/// Log2 of its area but for a constant, within 0.09; 0 where it has none.
inline float size_of(const Box& box) {
    return static_cast<float>(std::bit_cast<std::int32_t>(half_area(box))) * 0x1p-23f;
}

inline Reference make_reference(Box box, std::uint32_t number) {
    box.low[3] = size_of(box);
    box.high[3] = std::bit_cast<float>(number);
    return {box};
}

/// Twice the centre of its box, and its size: where a reference is on the four axes that splits know.
inline Float4 place_of(const Reference& reference) {
    constexpr Int4 keep_three = {-1, -1, -1, 0};
    return reference.low + std::bit_cast<Float4>(std::bit_cast<Int4>(reference.high) & keep_three);
}

/// References, and what is around them all and around their places.
struct Group {
    std::size_t count = 0;
    Box box = nothing, places = nothing;

    void take(const Reference& reference) {
        const Float4 place = place_of(reference);
        ++count;
        grow(box, reference);
        grow(places, place);
    }
    void take(const Group& other) {
        count += other.count;
        grow(box, other.box);
        grow(places, other.places);
    }
};

/// The triangles of a tree under construction, in units in which the largest coordinate is about 1: no area
/// overflows or vanishes. The unit is a power of two, so going there and back is exact.
class Soup {
  public:
    /// Throws std::invalid_argument where a corner is not finite.
    Soup(std::span<const Triangle> triangles, Crew& crew);

    std::size_t size() const { return triangles_.size(); }
    double unit() const { return unit_; }
    float largest_coordinate() const { return largest_; }

    Reference whole(std::uint32_t number) const;

    /// The parts of a reference on both sides of the plane; empty where it has none.
    std::pair<Reference, Reference> cut(const Reference& reference, int axis, float plane) const;

  private:
    Float4 corner(const Triangle& triangle, std::size_t i) const {
        const auto& c = triangle.corners[i];
        return Float4{c[0], c[1], c[2], 0} * scale_;
    }

    std::span<const Triangle> triangles_;
    float largest_ = 0;  ///< coordinate by magnitude, in scene units
    double unit_ = 1;
    float scale_ = 1;
};

}  // namespace ptb::tree
