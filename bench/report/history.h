#pragma once

#include <string>
#include <vector>

#include "bench/compare/history.h"
#include "bench/report/grid.h"

namespace ptb {

/// What changed when, the gravest first.
Section history_changes(const History& history);
/// A line for each case: from its first time to its newest, changes marked.
Section history_lines(const History& history);
/// The axis: when, of which revision, with which kernels.
Section history_runs(const History& history);
/// Files of which nothing is shown, and what keeps lines of one name apart.
Section history_apart(const History& history);

/// All of them that have something to tell.
std::vector<Section> history_sections(const History& history);

/// "2026-11-28 15:49"
std::string date_text(const HistoryRun& run);
/// The first characters of a revision or of a hash, which tell it from others.
std::string short_hash(const std::string& hash);
/// "regressed", "suspected slower", ...
std::string state_text(const Step& step);

}  // namespace ptb
