#pragma once

#include <cstdint>
#include <vector>

#include "bench/record/record.h"
#include "core/render/counted_rows.h"

namespace ptb {

/// The counts of an instrumented render as a record has them. `segments` is what its film says: a build that
/// counts others counts wrongly, and has a reason in place of numbers.
Counted counted_of(const Counts& counts, std::uint64_t segments);

/// What these counts make of a device's peaks at so many million segments a second.
PeakShares shares_of(const Counted& counted, double msegments_per_s, const std::vector<Peak>& peaks);

/// Gives every record that has counts and a time its shares of the peaks of its device.
void add_shares(std::vector<Record>& records, const std::vector<DevicePeaks>& peaks);

}  // namespace ptb
