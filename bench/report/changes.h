#pragma once

#include <string>
#include <vector>

#include "bench/compare/row.h"
#include "bench/report/grid.h"

namespace ptb {

/// The table of a comparison: a row for each case, then how many came to which state.
Section changes_section(const std::vector<Row>& rows, const std::string& title);

}  // namespace ptb
