#pragma once

#include <cstddef>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// What kernels make of one work in one time: of each the case whose time is nearest to it.
struct Ladder {
    Case work;                       ///< what the cases share; kernel and SPP are as usual
    double time_ns = 0;              ///< the longest that every kernel reaches
    std::vector<std::size_t> cases;  ///< their places among the records, one a kernel, in the records' order
};

/// Of all timed records with implicit work-groups whose noise is known, in the order in which they begin.
std::vector<Ladder> ladders(const std::vector<Record>& records);

}  // namespace ptb
