#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "bench/compare/row.h"
#include "bench/compare/session.h"

namespace ptb {

/// Sessions a side from which on their comparison may gate, and how many of a history count.
inline constexpr std::size_t enough_sessions = 8;
inline constexpr std::size_t most_history = 30;

/// How sessions are compared.
struct CompareRules {
    std::function<double(const SessionCase&)> tolerance;
    bool allow_cross = false;          ///< compare although fingerprints differ: ratios only
    bool gate_single_session = false;  ///< one session a side may gate
};

/// What came of it. Where fingerprints differ and that is not allowed, there are no rows.
struct Comparison {
    std::vector<Row> rows;
    std::set<std::string> differing;  ///< "driver: \"3.1\" and \"4.0\""
    std::set<std::string> notes;      ///< what differs too, and may
};

/// Compares two versions by sessions of each: one a side by their samples, else by the sessions' medians.
/// Mann-Whitney and Hodges-Lehmann on log time, Holm over cases.
Comparison compare_sessions(const std::vector<Session>& base, const std::vector<Session>& now,
                            const CompareRules& rules);

/// Compares one session with those before it: the interval of one more median by Student's t over the last
/// `most_history`, Holm over cases.
Comparison compare_history(std::vector<Session> history, const Session& now, const CompareRules& rules);

/// As JSON: schema "ptbench.compare.v1".
std::string comparison_text(const Comparison& comparison);

}  // namespace ptb
