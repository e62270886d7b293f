#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/compare/row.h"
#include "bench/report/grid.h"

namespace ptb {

/// The table of a comparison: a row for each case, then how many came to which state.
Section changes_section(const std::vector<Row>& rows, const std::string& title);

/// Of a shift of log time: "1.052", and "1.041-1.063" or "-".
std::string ratio_of_shift(double shift);
std::string interval_of_shift(const std::optional<Interval>& interval);

}  // namespace ptb
