#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/compare/session.h"
#include "bench/compare/steps.h"

namespace ptb {

/// Runs that a history shows; older ones are left out.
inline constexpr std::size_t most_runs = 100;

/// One run of a history, by the order in which they began.
struct HistoryRun {
    std::string file, started_at, revision;
    bool operator==(const HistoryRun&) const = default;
};

/// What one run found of a case.
struct HistoryPoint {
    std::size_t run = 0;
    double median_ns = 0;
    std::optional<Interval> interval_ns;  ///< of the median, 95 %
    std::string kernel_hash;              ///< or empty
    bool operator==(const HistoryPoint&) const = default;
};

/// A case on one device of one machine over the runs that have a time of it. What it runs on is the same in
/// all of them; its kernel and how that was built may change.
struct HistoryLine {
    std::string device, name;
    std::string where;  ///< "driver 3.1": in what it is unlike other lines of the same name, or empty
    double tolerance = 0;
    std::vector<HistoryPoint> points;
    std::vector<Step> steps;  ///< `at` counts points
    bool operator==(const HistoryLine&) const = default;
};

/// A file of which nothing is shown.
struct LeftOut {
    std::string file, why;
    bool operator==(const LeftOut&) const = default;
};

struct History {
    std::vector<HistoryRun> runs;
    std::vector<HistoryLine> lines;
    std::set<std::string> apart;  ///< what keeps lines of a name apart: "driver: \"3.1\" and \"4.0\""
    std::vector<LeftOut> left_out;
    bool operator==(const History&) const = default;
};

/// Of all sessions: a line for each case, and another wherever device, driver, CPU or the scene's text are
/// not the same. Changes smaller than half of the `tolerance` are not told.
History history_of(std::vector<Session> sessions, const std::function<double(const SessionCase&)>& tolerance);

/// The sessions of a folder and of those in it: its *.json files.
struct HistoryFolder {
    std::vector<Session> sessions;
    std::vector<LeftOut> left_out;  ///< no results, or the same as another
};
/// Throws UsageError unless it is a folder.
HistoryFolder read_history(const std::filesystem::path& folder);

/// As JSON: schema "ptbench.history.v1".
std::string history_text(const History& history);

}  // namespace ptb
