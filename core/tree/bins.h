#pragma once

#include "core/tree/split.h"

namespace ptb::tree {

/// What lies in the bins of four axes. A reference that lies in several bins of an axis begins in one and
/// ends in another.
struct Bins {
    Box box[most_bins][4];
    Int4 begin[most_bins], end[most_bins];
    int count;

    explicit Bins(int bins) : count(bins) {
        for (int b = 0; b < count; ++b) {
            for (Box& of_axis : box[b]) of_axis = nothing;
            begin[b] = end[b] = Int4{};
        }
    }
    void take(const Bins& other) {
        for (int b = 0; b < count; ++b) {
            for (int axis = 0; axis < 4; ++axis) grow(box[b][axis], other.box[b][axis]);
            begin[b] += other.begin[b];
            end[b] += other.end[b];
        }
    }
};

/// Fills bins by `take(bins, begin, end)`; of many references, by several threads, each its chunks. Bins know
/// no order, so how they are shared out cannot be seen.
template <class Take>
void fill(Bins& bins, std::size_t references, Crew& crew, const Take& take) {
    if (references < shared_from) return take(bins, std::size_t{0}, references);
    std::mutex mutex;
    crew.for_chunks(references, chunk_size, [&](std::size_t begin, std::size_t end) {
        Bins some(bins.count);
        take(some, begin, end);
        const std::lock_guard lock(mutex);
        bins.take(some);
    });
}

/// How many references there are to part, and how many their parts may be.
struct Limits {
    std::size_t count, most;
};

/// The cut between two bins of an axis that leaves the least work, among those that leave fewer references on
/// either side, and not too many on both.
Split best_cut(const Bins& bins, const Grid& grid, const Limits& limits);

}  // namespace ptb::tree
