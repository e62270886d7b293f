#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <vector>

#include "bench/cli/options.h"
#include "bench/record/record.h"

namespace ptb {

/// Runs that may not be put together or set against each other. Ends with exit code 7.
struct NotComparable : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Names the files of a run that began in another folder as they are called from `here`. `data`: of ptbench.
void see_from(const std::filesystem::path& here, ResultFile& run, const std::filesystem::path& data);

/// The run that --resume names, from its journal or its result file. Throws UsageError.
std::optional<ResultFile> earlier_run(const RunFlags& flags);

/// What it was asked for. Throws UsageError where the file does not say.
Config config_of(const ResultFile& earlier, const std::string& file);

/// Makes `now`, a run that has only begun, the continuation of `earlier`, whose records it keeps but those of
/// cases that were not tried. Throws NotComparable with what differs, kernels that `planned` needs included.
void go_on(ResultFile& now, const ResultFile& earlier, const std::vector<Case>& planned,
           const RunFlags& flags, const std::string& kernel_dir);

/// Cases of the plan without a record.
std::vector<Case> missing(const std::vector<Case>& planned, const std::vector<Record>& records);

/// The records of the plan, in its order, each once.
std::vector<Record> in_plan_order(const std::vector<Case>& planned, const std::vector<Record>& records);

}  // namespace ptb
