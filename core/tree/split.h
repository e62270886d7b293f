#pragma once

#include <span>

#include "core/tree/crew.h"
#include "core/tree/reference.h"
#include "core/tree/settings.h"

namespace ptb::tree {

inline constexpr int most_bins = 32;
inline constexpr std::size_t shared_from = 1u << 15;  ///< references: fewer are one thread's work
inline constexpr std::size_t chunk_size = 1u << 13;

/// Even bins along four axes.
struct Grid {
    Float4 base{}, scale{};
    float last = 0;

    Int4 bin_of(Float4 place) const { return to_int(min((place - base) * scale, all(last))); }
};

inline Grid grid_over(const Box& box, int bins) {
    constexpr float too_narrow = 1e-30f;
    const Float4 width = box.high - box.low;
    const Float4 scale = all(static_cast<float>(bins)) / width;
    return {box.low, width > all(too_narrow) ? scale : all(0), static_cast<float>(bins - 1)};
}

/// A way to part a node in two. `work` is what its children cost if they are leaves: half areas times
/// references.
struct Split {
    float work = infinity;  ///< where there is no split
    int axis = 0;
    int bin = 0;  ///< the last on the left
    Grid grid;
    Box left = nothing, right = nothing;
    std::size_t left_count = 0, right_count = 0;

    bool found() const { return work < infinity; }
};

/// By where references' centres are, or their sizes: see "On fast Construction of SAH-based Bounding Volume
/// Hierarchies", by I. Wald.
Split find_object_split(const Group& group, std::span<const Reference> references,
                        const TreeSettings& settings, Crew& crew);

/// By a plane, with parts of a triangle on both sides: see "Spatial Splits in Bounding Volume Hierarchies",
/// by M. Stich, H. Friedrich and A. Dietrich.
/// `room` is for how many further references there may be.
Split find_spatial_split(const Group& group, std::span<const Reference> references, std::size_t room,
                         const Soup& soup, const TreeSettings& settings, Crew& crew);

/// Of a spatial split.
inline float plane_of(const Split& split) {
    return split.grid.base[split.axis] + static_cast<float>(split.bin + 1) / split.grid.scale[split.axis];
}

/// On which axes' bins a reference begins and ends. What touches a plane by less than rounding ends there.
struct Span {
    Int4 first, last;
};

inline Span span_of(const Reference& reference, const Grid& grid) {
    constexpr float touching = 1e-4f;
    const Float4 low = (reference.low - grid.base) * grid.scale + all(touching);
    const Float4 high = (reference.high - grid.base) * grid.scale - all(touching);
    const Int4 first = to_int(min(low, all(grid.last)));
    const Int4 last = to_int(min(high, all(grid.last)));
    return {first, last > first ? last : first};
}

}  // namespace ptb::tree
