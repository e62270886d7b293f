#pragma once

#include <string>
#include <vector>

#include "bench/report/html/page.h"
#include "bench/report/ranking.h"

namespace ptb {

/// "2026-03-01 12:00, host", after the run's own name; numbered when an earlier run has that name.
std::string run_name(const std::vector<PageRun>& runs, std::size_t index);
/// Where the verdict on a run of several is in the page.
std::string run_id(std::size_t index);
/// Several runs in a table whose rows lead to the verdicts on them; nothing for one.
std::string runs_table(const std::vector<PageRun>& runs);

/// Runs of the same devices with the same drivers.
struct RunGroup {
    std::string name;               ///< of the devices
    std::vector<std::size_t> runs;  ///< in the order of the page
};
/// Those of the devices that stand first in a ranking first.
std::vector<RunGroup> run_groups(const std::vector<PageRun>& runs, const std::vector<Ranking>& rankings);

/// Rankings to be chosen from; the first is shown. Of each run, where the part of its devices is.
std::string boards(const std::vector<Ranking>& rankings, const std::vector<std::string>& links);

/// The times of all runs, each row leading to its case, and the published ones.
std::string times_table(const std::vector<PageRun>& runs, const PublishedTable& published);

/// For each device, kernel and so on that was run with several two-dimensional work-groups: its times at the
/// most samples per pixel as a table, widths across, heights down, coloured by time.
std::string work_group_maps(const ResultFile& result);

/// Where a case is in the page: "r0c12".
std::string case_id(std::size_t run, std::size_t index);

/// A record in short, for those without JavaScript: outcome, times, work, image, build.
std::string record_facts(const Record& record);

/// Every case with its record in short, folded; the page's script puts all of the record in its place.
std::string case_list(const PageRun& run, std::size_t index);

}  // namespace ptb
