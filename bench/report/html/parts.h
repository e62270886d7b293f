#pragma once

#include <string>
#include <vector>

#include "bench/report/html/page.h"

namespace ptb {

/// "2026-03-01 12:00, host"; numbered when an earlier run has that name.
std::string run_name(const std::vector<PageRun>& runs, std::size_t index);

/// The times of all runs, each row leading to its case, and the published ones.
std::string times_table(const std::vector<PageRun>& runs, const PublishedTable& published);

/// For each device, kernel and so on that was run with several two-dimensional work-groups: its times at the
/// most samples per pixel as a table, widths across, heights down, coloured by time.
std::string work_group_maps(const ResultFile& result);

/// Every case, folded; the record within is filled in by the page's script.
std::string case_list(const PageRun& run, std::size_t index);

}  // namespace ptb
