#pragma once

#include <string>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// A device whose clock was lower throughout some cases of a session than in others: a fact of the session,
/// and no flaw of those cases, whose samples agree.
struct LowClock {
    std::string device;
    int cases = 0, of = 0;    ///< with that clock, and in which it was probed
    double lowest_share = 1;  ///< of the session's best
    bool operator==(const LowClock&) const = default;
};

/// By the probes' medians in cases of three or more: a single probe may be a hiccup. Low is over 1.05 x the
/// shortest of these medians.
std::vector<LowClock> low_clocks(const std::vector<Record>& records);

}  // namespace ptb
