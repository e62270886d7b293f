#pragma once

#include <optional>
#include <string>

#include "bench/cli/options.h"
#include "bench/record/record.h"

namespace ptb {

/// The run that --resume names, from its journal or its result file. Throws UsageError.
std::optional<ResultFile> earlier_run(const RunFlags& flags);

/// What it was asked for. Throws UsageError where the file does not say.
Config config_of(const ResultFile& earlier, const std::string& file);

}  // namespace ptb
