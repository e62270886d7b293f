#pragma once

#include <string>

#include "bench/record/record.h"
#include "bench/report/grid.h"

namespace ptb {

/// One line a case, the thesis' columns first: vendor,type,device,spp,time_ms. Quoted as RFC 4180 says, lines
/// end in LF. `time_ms` is empty unless the status is ok. Text that a spreadsheet would take for a formula
/// gets a ' in front.
std::string csv(const ResultFile& result);

/// A table: its titles, then a line a row.
std::string csv(const Grid& grid);

/// One line for each sample, in nanoseconds of all its renders.
std::string csv_samples(const ResultFile& result);

}  // namespace ptb
