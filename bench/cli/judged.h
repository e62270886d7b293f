#pragma once

#include <string>
#include <vector>

#include "bench/cli/exit_code.h"
#include "bench/cli/options.h"
#include "bench/compare/gate_file.h"
#include "bench/compare/sessions.h"
#include "bench/plan/tolerance.h"

namespace ptb {

/// The tolerance of each case, by flags, config and profile.
Tolerances tolerances_of(const JudgeFlags& flags, const Config& config);

/// What rows with these tolerances are held to. Throws UsageError unless --require-mde exceeds all of them.
Rules rules_of(const JudgeFlags& flags, const std::vector<double>& tolerances);

/// Adds what changed to what an exit code is made of. Nothing compared at all is not comparable.
void add_change(Outcome& outcome, const Change& change);

/// What a gate comes to: the statuses of both sides, and what changed.
Outcome outcome_of(const GateFile& gate);

/// "base: ...", "new: ..."
std::string title_of(const GateFile& gate);

/// Shows and writes a comparison of files, or says on stderr why the files cannot be compared.
Outcome conclude(const Comparison& comparison, const std::string& title, const JudgeFlags& flags);

/// Makes sure that --json and --md can be written, before there is anything to write.
void check_outputs(const JudgeFlags& flags);

/// The table to stdout, and Markdown where --md says. Only what is asked for goes to stdout when --json or
/// --md is "-"; the table then goes to stderr.
void show_rows(const std::vector<Row>& rows, const std::string& title, const JudgeFlags& flags);

}  // namespace ptb
