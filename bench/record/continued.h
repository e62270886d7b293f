#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// Runs that may not be put together or set against each other. Ends with exit code 7.
struct NotComparable : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Makes `now`, a run that has only begun, the continuation of `earlier`, whose records it keeps but those of
/// cases that were not tried. Throws NotComparable, beginning with `origin` ("--resume: run/journal.jsonl"),
/// with what differs, kernels that `planned` needs included.
void go_on(ResultFile& now, const ResultFile& earlier, const std::vector<Case>& planned,
           const std::string& origin, const std::string& kernel_dir);

/// Cases of the plan without a record.
std::vector<Case> missing(const std::vector<Case>& planned, const std::vector<Record>& records);

/// The records of the plan, in its order, each once.
std::vector<Record> in_plan_order(const std::vector<Case>& planned, const std::vector<Record>& records);

}  // namespace ptb
