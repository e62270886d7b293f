#pragma once

#include <string>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// The axes that not every table has a column for: all but kernel, size, spp, work_group and lanes.
const std::vector<std::string>& other_axes();

/// Those of them that a table of `records` needs columns for: in which the records differ, or hold something
/// unusual. Scene and path length, when they are the same everywhere, are named above the table.
std::vector<std::string> axis_columns(const std::vector<Record>& records);

/// In how many of `axes` a case is not what it is where nobody says anything.
int unusual(const Case& c, const std::vector<std::string>& axes);

/// ", path_length 5": the other axes in which a case is unusual.
std::string unusual_text(const Case& c);

}  // namespace ptb
