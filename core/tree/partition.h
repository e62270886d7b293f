#pragma once

#include <iterator>

#include "core/tree/split.h"

namespace ptb::tree {

/// A node's references, and the room for duplicates that it may use, before them or behind.
struct Range {
    Reference *begin = nullptr, *end = nullptr;     ///< all that is the node's
    Reference *first = nullptr, *beyond = nullptr;  ///< its references
    Group group;

    std::span<const Reference> references() const { return {first, beyond}; }
    std::size_t room() const { return static_cast<std::size_t>((end - begin) - (beyond - first)); }
};

struct Halves {
    Range left, right;
};

/// Parts a node as the split says. One of space needs room for what it duplicates.
Halves part(const Range& range, const Split& split, const Soup* soup_of_spatial_split);

/// Half of the references left, half right, by their places on the axis on which these differ most.
Halves halve(const Range& range);

}  // namespace ptb::tree
