#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "bench/cli/exit_code.h"
#include "bench/cli/options.h"
#include "bench/compare/gate_file.h"
#include "bench/compare/sessions.h"
#include "bench/plan/tolerance.h"
#include "bench/report/html/page.h"

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

/// Adds what a comparison of files comes to. Throws UsageError by `rules_of`.
void add_comparison(Outcome& outcome, const Comparison& comparison, const JudgeFlags& flags);

/// Shows a comparison on `out` and writes it where the flags say, or says on stderr why there is none.
void show_comparison(const Comparison& comparison, const std::string& title, const JudgeFlags& flags,
                     std::FILE* out);

/// Writes the page of a comparison where --html says.
void write_page(const ComparedPage& compared, const JudgeFlags& flags);

/// Makes sure that --json, --md and --html can be written, before there is anything to write.
void check_outputs(const JudgeFlags& flags);

/// The table to `out`, and Markdown where --md says.
void show_rows(const std::vector<Row>& rows, const std::string& title, const JudgeFlags& flags,
               std::FILE* out);

/// stdout, unless --json or --md asks for it: then the table goes to stderr.
std::FILE* table_stream(const JudgeFlags& flags);

}  // namespace ptb
